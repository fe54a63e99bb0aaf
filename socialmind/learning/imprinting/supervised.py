"""Supervised training of a twin on a recording."""

from __future__ import annotations

from collections.abc import Iterator

from socialmind.errors import ModelError
from socialmind.learning.imprinting.pytorch import torch
from socialmind.learning.imprinting.recording import Recording
from socialmind.learning.imprinting.twin import Twin

Tensor = torch.Tensor


def train(
    twin: Twin, recording: Recording, seed: int, epochs: int, rate: float, batch: int, window: int
) -> list[float]:
    """Train a twin to answer as recorded: Adam on the squared error, at a rate that falls to 0.

    Networks without memory are trained on records in a random order; those with memory on episodes
    from their beginning, side by side, the gradient going back through up to `window` ticks.

    Args:
        twin: what is trained; its genome changes.
        recording: what it is trained on.
        seed: decides the order.
        epochs: how many times each record is seen.
        rate: the learning rate at the start.
        batch: how many records make a step, without memory.
        window: how many ticks make a step, with memory.

    Returns:
        The mean squared error over each epoch, as it was while the genome changed.

    Raises:
        ModelError: the genome grew beyond all bounds.
    """
    optimiser = torch.optim.Adam([twin.genome], lr=rate)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, max(epochs, 1))
    generator = torch.Generator().manual_seed(seed)
    inputs = torch.tensor(recording.inputs, dtype=twin.genome.dtype)
    wanted = torch.tensor(recording.outputs, dtype=twin.genome.dtype)
    losses = []
    for _ in range(epochs):
        if twin.network.memory:
            squares = _by_episodes(twin, recording, inputs, wanted, window)
        else:
            squares = _in_random_order(twin, inputs, wanted, batch, generator)
        total = 0.0
        for square, count in squares:
            optimiser.zero_grad()
            (square / count).backward()
            optimiser.step()
            total += float(square.detach())
        losses.append(total / wanted.numel())
        if not torch.isfinite(twin.genome).all():
            raise ModelError(
                f"training at the rate {rate:g} made weights that are no finite numbers",
                remedy="lower the rate",
            )
        schedule.step()
    return losses


def missed(linear: Tensor, wanted: Tensor) -> Tensor:
    """Return how far outputs before clamping are from what is wanted.

    Beyond 0 and 1 an output that is to be 0 or 1 is right; any other is drawn back.

    >>> import torch
    >>> missed(torch.tensor([1.5, 1.5, -0.5]), torch.tensor([1.0, 0.5, 0.0])).tolist()
    [0.0, 1.0, 0.0]
    """
    error = linear - wanted
    right = ((wanted >= 1.0) & (error > 0.0)) | ((wanted <= 0.0) & (error < 0.0))
    return torch.where(right, 0.0, error)


def _in_random_order(
    twin: Twin, inputs: Tensor, wanted: Tensor, batch: int, generator: torch.Generator
) -> Iterator[tuple[Tensor, int]]:
    """Yield the squared error of one batch after another, and how many values it is over."""
    order = torch.randperm(len(inputs), generator=generator)
    for chosen in order.split(batch):
        error = missed(twin(inputs[chosen], clamp=False), wanted[chosen])
        yield error.square().sum(), error.numel()


def _by_episodes(
    twin: Twin, recording: Recording, inputs: Tensor, wanted: Tensor, window: int
) -> Iterator[tuple[Tensor, int]]:
    """Yield the squared error of one window of all episodes after another, and over how many."""
    episodes = recording.episodes
    lengths = torch.tensor([places.stop - places.start for places in episodes])
    starts = torch.tensor([places.start for places in episodes])
    memory = twin.start(len(episodes))
    for first in range(0, int(lengths.max()), window):
        # The gradient ends where the window begins; what is remembered goes on.
        memory = memory.detach()
        errors = []
        for tick in range(first, min(first + window, int(lengths.max()))):
            running = tick < lengths
            # Episodes that are over stay at their last record, which then counts for nothing.
            places = starts + torch.minimum(torch.tensor(tick), lengths - 1)
            given, memory = twin.step(inputs[places], memory, clamp=False)
            errors.append(missed(given, wanted[places])[running])
        error = torch.cat(errors)
        yield error.square().sum(), error.numel()
