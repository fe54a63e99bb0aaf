"""The robots that have lived in an episode, each as it was at last."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.agents.bookkeeping import NEXT_ID

if TYPE_CHECKING:
    from socialmind.model import Model


class Lives:
    """Follows the robots of a running model, tick by tick, as others take the slots of the dead.

    Args:
        model: a model on a plane after its setup; who died in that has not lived in the episode.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        robots = model.shape.world.robots
        self._gone = {name: {one for one, _ in self._dead(name)} for name in robots}
        self._kept: dict[str, dict[int, Any]] = {name: {} for name in robots}

    def advance(self, last: bool) -> None:
        """Run a tick; in the last one of an episode robots are paid what is still due to them."""
        model = self._model
        model.advance(1)
        if last and model.over is None:
            model.ground.settle()
        for name, gone in self._gone.items():
            for identity, row in self._dead(name):
                if identity not in gone:
                    self._kept[name][identity] = row.copy()
                    gone.add(identity)

    def rows(self, name: str) -> NDArray[Any]:
        """Return the rows of the robots of a population that have lived, by identity."""
        table = self._model.tables[name]
        kept = dict(self._kept[name])
        for row in table.rows[table.slots]:
            kept[int(row["_id"])] = row
        found = np.zeros(len(kept), table.dtype)
        for place, identity in enumerate(sorted(kept)):
            found[place] = kept[identity]
        return found

    @property
    def score(self) -> float:
        """The mean of their scores, 0 where there are none."""
        scores = [one for name in self._kept for one in self.rows(name)["score"].tolist()]
        return sum(scores) / max(len(scores), 1)

    def _dead(self, name: str) -> Iterator[tuple[int, Any]]:
        """The identities and rows in the slots of the dead."""
        table = self._model.tables[name]
        born = int(table.counters[NEXT_ID])
        for slot in np.flatnonzero(~table.alive).tolist():
            row = table.rows[slot]
            if row["_slot"] == slot and row["_id"] < born:  # else nobody has been there
                yield int(row["_id"]), row
