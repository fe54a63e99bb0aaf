"""What a method is: it is asked for trials, and told how far from the data they were."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError

Points = NDArray[np.float64]
"""(trials, dimensions), places in the unit cube."""
Distances = NDArray[np.float64]
"""(trials,), 0 or more; infinite for a trial that failed."""


class MissingMethodError(SocialmindError, ImportError):
    """The library of a method is not installed."""

    def __init__(self, library: str) -> None:
        super().__init__(f"this method needs {library}: pip install 'socialmind[fit]'")


class Method(ABC):
    """Asks for trials in generations. The same seed and distances give the same trials.

    Args:
        size: how many dimensions.
        trials: how many there will be; the last generation may be cut.
        seed: of all its draws, 0 … 2⁶³ − 1.
    """

    library: ClassVar[str] = "scipy"
    """What it stands on, whose version decides what it draws."""

    def __init__(self, size: int, trials: int, seed: int) -> None:
        self.size, self.trials, self.seed = size, trials, seed

    @abstractmethod
    def ask(self) -> Points:
        """Return the trials of the next generation."""

    @abstractmethod
    def tell(self, points: Points, distances: Distances) -> None:
        """Take up how far the trials of a generation were; of all of it, in order."""

    def sample(self) -> tuple[Points, NDArray[np.float64]] | None:
        """Return places drawn from a posterior, with weights of sum 1; None where it has none."""
        return None
