"""Curricula: lessons in order, and cycles in which skills learn in turn (thesis, 6.1 and 6.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.learning.lessons.lesson import Lesson

if TYPE_CHECKING:
    from socialmind.mind.description import MindDescription


@dataclass(frozen=True, eq=False)
class Cycle:
    """Lessons that are taught in turn, over and over, each on what the others have learned.

    Attributes:
        lessons: the lessons, in order.
        cycles: how often all of them are taught, 1 or more; None for without end.
        budget: ticks after which no other generation begins; None for no such limit.

    Raises:
        ModelError: no lessons, or a number outside its range.
    """

    lessons: tuple[Lesson | str | Path, ...]
    cycles: int | None = None
    budget: int | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "lessons", tuple(self.lessons))
        if not self.lessons:
            raise ModelError("a cycle without lessons", "one or more")
        for what in ("cycles", "budget"):
            value = getattr(self, what)
            if value is not None and (not is_whole(value) or value < 1):
                raise ModelError(f"{what}={shown(value)} of a cycle", "a whole number, 1 or more")


class Position(NamedTuple):
    """A place in a curriculum: the item, which time around in a cycle (from 1), the lesson in it.

    >>> Position()
    Position(item=0, cycle=1, place=0)
    """

    item: int = 0
    cycle: int = 1
    place: int = 0


class Curriculum:
    """Lessons in order; what one has learned is frozen, and the next goes on from it.

    Args:
        items: lessons, cycles of lessons, and paths of `.simbatch` files that hold lessons,
            relative to the `lessons.py` where the curriculum stands.
        mind: the mind to begin from: a folder or YAML file, relative likewise, or a
            `MindDescription`; the hierarchy of the model's robots where none is given.

    Raises:
        ModelError: no lessons, two of one name, or something behind a cycle without end.

    >>> from socialmind import Model
    >>> class Field(Model):
    ...     pass
    >>> course = Curriculum([Lesson("Seek", Field), Cycle([Lesson("Avoid", Field)], cycles=2)])
    >>> position, names = Position(), []
    >>> while position is not None:
    ...     names.append(course.at(position).name)
    ...     position = course.next(position)
    >>> names
    ['Seek', 'Avoid', 'Avoid']
    """

    def __init__(
        self,
        items: Iterable[Lesson | Cycle | str | Path],
        mind: str | Path | MindDescription | None = None,
    ) -> None:
        self.items = tuple(items)
        self.mind = mind
        if not self.items:
            raise ModelError("a curriculum without lessons", "one or more")
        names: list[str] = []
        for number, item in enumerate(self.items):
            if not isinstance(item, Lesson | Cycle | str | Path):
                raise ModelError(
                    f"{item!r} in a curriculum", "a Lesson, a Cycle or the path of a .simbatch file"
                )
            names += [one.name for one in _lessons_of(item) if isinstance(one, Lesson)]
            if isinstance(item, Cycle) and item.cycles is None and item is not self.items[-1]:
                raise ModelError(
                    f"a cycle without end as item {number + 1} of {len(self.items)}",
                    "one at the end",
                    "give cycles=",
                )
        for name in names:
            if names.count(name) > 1:
                raise ModelError(f"two lessons called {name!r}", "a name for each")

    @property
    def lessons(self) -> tuple[Lesson, ...]:
        """All lessons, those in cycles once."""
        return tuple(
            one for item in self.items for one in _lessons_of(item) if isinstance(one, Lesson)
        )

    def at(self, position: Position) -> Lesson:
        """Return the lesson at a position."""
        return cast(Lesson, _lessons_of(self.items[position.item])[position.place])

    def cycle_at(self, position: Position) -> Cycle | None:
        """Return the cycle that a position is in; None for a lesson of its own."""
        item = self.items[position.item]
        return item if isinstance(item, Cycle) else None

    def next(self, position: Position, cycle_over: bool = False) -> Position | None:
        """Return the position behind another; None behind the last.

        Args:
            position: a position.
            cycle_over: whether the cycle that it is in ends here.
        """
        item = self.items[position.item]
        if isinstance(item, Cycle) and not cycle_over:
            if position.place + 1 < len(item.lessons):
                return position._replace(place=position.place + 1)
            if item.cycles is None or position.cycle < item.cycles:
                return position._replace(cycle=position.cycle + 1, place=0)
        return Position(position.item + 1) if position.item + 1 < len(self.items) else None

    def positions(self) -> Iterator[Position]:
        """Yield the positions from the first to the last; of a cycle without end, once around."""
        position: Position | None = Position()
        while position is not None:
            yield position
            item = self.items[position.item]
            endless = isinstance(item, Cycle) and item.cycles is None
            last = endless and position.place + 1 == len(_lessons_of(item))
            position = self.next(position, cycle_over=last)

    def with_lessons(self, change: Callable[[Any], Lesson]) -> Curriculum:
        """Return the curriculum with each lesson, or path of one, changed by a function."""
        items = [
            replace(item, lessons=tuple(change(one) for one in item.lessons))
            if isinstance(item, Cycle)
            else change(item)
            for item in self.items
        ]
        return Curriculum(items, self.mind)

    def with_cycles(self, cycles: int | None = None, budget: int | None = None) -> Curriculum:
        """Return the curriculum with other limits of its cycles, where they are given."""
        items = [
            replace(item, cycles=cycles or item.cycles, budget=budget or item.budget)
            if isinstance(item, Cycle)
            else item
            for item in self.items
        ]
        return Curriculum(items, self.mind)

    def only(self, names: Iterable[str]) -> Curriculum:
        """Return the curriculum of some lessons, in its order, without cycles.

        Raises:
            SocialmindError: there is no lesson of a name.
        """
        wanted = list(names)
        known = [one.name for one in self.lessons]
        for name in wanted:
            if name not in known:
                raise SocialmindError(f"no lesson called {name!r}; {nearest(name, known)}")
        return Curriculum([one for one in self.lessons if one.name in wanted], self.mind)

    def record(self) -> list[dict[str, Any]]:
        """Return what decides its result, as the manifest of a training keeps it."""
        items: list[dict[str, Any]] = []
        for item in self.items:
            lessons = [one.record() for one in _lessons_of(item) if isinstance(one, Lesson)]
            if isinstance(item, Cycle):
                items.append({"lessons": lessons, "cycles": item.cycles, "budget": item.budget})
            else:
                items += lessons
        return items


def _lessons_of(item: Lesson | Cycle | str | Path) -> tuple[Lesson | str | Path, ...]:
    return item.lessons if isinstance(item, Cycle) else (item,)
