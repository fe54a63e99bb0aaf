"""Models of MetaCiv's, written as models of this toolkit."""

from socialmind.metaciv.writing.folder import write_model

__all__ = ["write_model"]
