"""Activations and aggregations over tensors: `mind.functions.activations`, with gradients."""

from __future__ import annotations

from collections.abc import Callable

from socialmind.learning.imprinting.pytorch import torch
from socialmind.mind.functions import network
from socialmind.mind.functions.activations import FINITE, LEAK, SELU_ALPHA, SELU_SCALE

Tensor = torch.Tensor


def activate(code: int, x: Tensor) -> Tensor:
    """Return neurons' values for their inputs, element by element.

    Args:
        code: one of the activations of `mind.functions.network`.
        x: the neurons' inputs, any shape.
    """
    if code in _PLAIN:
        return _PLAIN[code](x)
    bound = _bound(x)
    return _NEAT[code](torch.nan_to_num(x, nan=0.0).clamp(-bound, bound))


def aggregate(code: int, values: Tensor) -> Tensor:
    """Return neurons' weighted inputs as one number each.

    Args:
        code: one of the aggregations of `mind.functions.network`.
        values: the weighted inputs, shape (…, inputs of a neuron); of none, the product is 1 and
            all others are 0.

    Returns:
        Shape (…).
    """
    count = values.shape[-1]
    if code == network.PRODUCT:
        return values.prod(-1)
    if count == 0:
        return values.sum(-1)
    if code == network.GREATEST:
        return values.amax(-1)
    if code == network.LEAST:
        return values.amin(-1)
    if code == network.GREATEST_ABSOLUTE:
        place = values.abs().argmax(-1, keepdim=True)
        return values.gather(-1, place).squeeze(-1)
    if code == network.MEDIAN:
        ordered = values.sort(-1).values
        return (ordered[..., (count - 1) // 2] + ordered[..., count // 2]) / 2.0
    return values.mean(-1) if code == network.MEAN else values.sum(-1)


def _bound(x: Tensor) -> float:
    """Return what neurons of neat-python are held within; its cube is a number of x's type."""
    return min(FINITE, float(torch.finfo(x.dtype).max) ** (1.0 / 3.0))


def _exponential_below(x: Tensor) -> Tensor:
    """Return exp(x) − 1 where x is negative, else 0: finite, so that its gradient is."""
    return torch.expm1(x.clamp(max=0.0))


def _inverse(x: Tensor) -> Tensor:
    # The division sees no number so small that its gradient would overflow.
    bound = _bound(x)
    small = x.abs() < 1.0 / bound
    return torch.where(small, torch.sign(x) * bound, 1.0 / torch.where(small, 1.0, x))


_PLAIN: dict[int, Callable[[Tensor], Tensor]] = {
    network.LINEAR: lambda x: x,
    network.RELU: torch.relu,
    network.SIGMOID: torch.sigmoid,
    network.CLAMP: lambda x: x.clamp(0.0, 1.0),
    network.TANH: torch.tanh,
}
_NEAT: dict[int, Callable[[Tensor], Tensor]] = {
    network.NEAT_ACTIVATIONS[name]: formula
    for name, formula in {
        "sigmoid": lambda x: torch.sigmoid((5.0 * x).clamp(-60.0, 60.0)),
        "tanh": lambda x: torch.tanh((2.5 * x).clamp(-60.0, 60.0)),
        "sin": lambda x: torch.sin((5.0 * x).clamp(-60.0, 60.0)),
        "gauss": lambda x: torch.exp(-5.0 * x.clamp(-3.4, 3.4) ** 2),
        "relu": torch.relu,
        "elu": lambda x: torch.relu(x) + _exponential_below(x),
        "lelu": lambda x: torch.where(x > 0.0, x, LEAK * x),
        "selu": lambda x: SELU_SCALE * (torch.relu(x) + SELU_ALPHA * _exponential_below(x)),
        "softplus": lambda x: 0.2 * torch.log1p(torch.exp((5.0 * x).clamp(-60.0, 60.0))),
        "identity": lambda x: x,
        "clamped": lambda x: x.clamp(-1.0, 1.0),
        "inv": _inverse,
        "log": lambda x: torch.log(x.clamp(min=1e-7)),
        "exp": lambda x: torch.exp(x.clamp(-60.0, 60.0)),
        "abs": torch.abs,
        "hat": lambda x: (1.0 - x.abs()).clamp(min=0.0),
        "square": lambda x: x * x,
        "cube": lambda x: x * x * x,
    }.items()
}
