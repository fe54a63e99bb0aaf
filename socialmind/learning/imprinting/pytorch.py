"""PyTorch, or the error that says how to get it."""

from __future__ import annotations

from socialmind.errors import SocialmindError

__all__ = ["MissingTorchError", "torch"]


class MissingTorchError(SocialmindError, ImportError):
    """PyTorch is not installed."""


try:
    import torch
except ImportError as error:
    raise MissingTorchError(
        "supervised learning needs PyTorch, which is not installed; "
        "pip install 'socialmind[learning]'"
    ) from error
