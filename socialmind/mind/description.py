"""The description of a mind: its sensors, actuators, variables and skills, checked together."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from coglogo_py.border.html_table import as_html
from coglogo_py.border.places import place as place_called
from socialmind.errors import ModelError, nearest
from socialmind.mind.modules import Actuator, Sensor, Skill, Variable
from socialmind.names import several

Module = Sensor | Actuator | Variable | Skill


class MindDescription:
    """The modules of a mind: a directed acyclic graph of skills over sensors and variables.

    It never changes; `with_modules` gives another one.

    Args:
        name: the mind's name (the agent's, as in `<Agent>.botdesc`).
        sensors: `Sensor`s, or just their names.
        actuators: `Actuator`s, or just their names.
        variables: `Variable`s, or the names of simple ones.
        skills: the skills, in any order.

    Raises:
        ModelError: a name that is used twice or unknown, or a skill that influences itself through
            others, with skill, file and line.

    >>> from socialmind.mind import Programmed
    >>> def wire(left, right):
    ...     return right, left
    >>> vehicle = MindDescription(
    ...     "vehicle",
    ...     sensors=["EyeL", "EyeR"],
    ...     actuators=["MotL", "MotR"],
    ...     skills=[
    ...         Skill("Seek", ["SE:EyeL", "SE:EyeR"], ["MO:MotL", "MO:MotR"], Programmed(wire))
    ...     ],
    ... )
    >>> vehicle.masters
    ('Seek',)
    """

    def __init__(
        self,
        name: str,
        sensors: Iterable[Sensor | str] = (),
        actuators: Iterable[Actuator | str] = (),
        variables: Iterable[Variable | str] = (),
        skills: Iterable[Skill] = (),
    ) -> None:
        self.name = name
        self.laid_out: dict[Any, Any] = {}  # its arrays, once they are made
        self.sensors: Mapping[str, Sensor] = _by_name(sensors, Sensor, "sensor")
        self.actuators: Mapping[str, Actuator] = _by_name(actuators, Actuator, "actuator")
        self.variables: Mapping[str, Variable] = _by_name(variables, Variable, "variable")
        self.skills: Mapping[str, Skill] = _by_name(skills, Skill, "skill")
        self.parents: Mapping[str, tuple[str, ...]] = self._parents()
        for skill in self.skills.values():
            self._check_links(skill)
        self.order = self._order()

    @classmethod
    def load(cls, path: str | Path) -> MindDescription:
        """Read a mind's folder or YAML file; see `socialmind.mind.files`."""
        from socialmind.mind.files.folder import load_description

        return load_description(path, cls)

    def save(self, path: str | Path) -> None:
        """Write a mind's folder, or a YAML file where the path ends in .yaml."""
        from socialmind.mind.files.folder import save_description

        save_description(self, path)

    def __eq__(self, other: object) -> bool:
        """Say whether two minds are written alike: what `save` writes of them is the same."""
        if self is other or not isinstance(other, MindDescription):
            return self is other or NotImplemented
        if (self.name, self.skills.keys()) != (other.name, other.skills.keys()):
            return False
        from socialmind.mind.files.folder import files_of

        try:
            return files_of(self) == files_of(other)
        except ModelError:  # a function without a file or text, which is like no other
            return False

    def __hash__(self) -> int:
        return hash((self.name, tuple(sorted(self.skills))))

    def __reduce__(self) -> tuple[Any, ...]:
        from socialmind.work.packing import packed

        return _unpacked_mind, (packed({**vars(self), "laid_out": {}}),)

    def __copy__(self) -> MindDescription:
        return self  # it never changes

    def __deepcopy__(self, memo: dict[int, Any]) -> MindDescription:
        return self

    def _parents(self) -> dict[str, tuple[str, ...]]:
        parents: dict[str, list[str]] = {name: [] for name in self.skills}
        for skill in self.skills.values():
            for child in skill.subskills:
                parents.setdefault(child, []).append(skill.name)
        return {name: tuple(sorted(found)) for name, found in parents.items()}

    def _check_links(self, skill: Skill) -> None:
        known: dict[str, Mapping[str, Any]] = {
            "sensor": self.sensors,
            "actuator": self.actuators,
            "variable": self.variables,
            "skill": self.skills,
        }
        for link in skill.links:
            if link.name not in known[link.module]:
                names = known[link.module]
                raise skill.refused(
                    f"with {link}, an unknown {link.module}",
                    f"one of the {len(names)} that there are" if names else f"a {link.module}",
                    nearest(link.name, names) if names else f"there is no {link.module}",
                    link.line,
                )

    def _order(self) -> tuple[str, ...]:
        """Return the skills from the top down, by name where nothing else decides."""
        waiting = {name: len(self.parents[name]) for name in self.skills}
        ready = [name for name, count in waiting.items() if count == 0]
        heapq.heapify(ready)
        order = []
        while ready:
            name = heapq.heappop(ready)
            order.append(name)
            for child in self.skills[name].subskills:
                waiting[child] -= 1
                if waiting[child] == 0:
                    heapq.heappush(ready, child)
        if len(order) < len(self.skills):
            self._refuse_cycle([name for name in sorted(self.skills) if name not in order])
        return tuple(order)

    def _refuse_cycle(self, within: list[str]) -> None:
        """Raise the error that names a cycle among skills of which each waits for another."""
        way = [within[0]]
        while True:
            parent = next(name for name in self.parents[way[-1]] if name in within)
            if parent in way:
                way = [*way[way.index(parent) :], parent]
                break
            way.append(parent)
        way.reverse()
        skill = self.skills[way[0]]
        link = next(one for one in skill.outputs if (one.module, one.name) == ("skill", way[1]))
        raise skill.refused(
            f"that influences itself: {' > '.join(way)}",
            "skills from the master down, without a way back",
            "take one of these links out",
            link.line,
        )

    @property
    def masters(self) -> tuple[str, ...]:
        """The skills that no other skill influences, by name."""
        return tuple(sorted(name for name in self.skills if not self.parents[name]))

    def below(self, *roots: str) -> tuple[str, ...]:
        """Return skills and all that they influence, directly or through others, from the top."""
        found = set(roots)
        for name in self.order:
            if name in found:
                found.update(self.skills[name].subskills)
        return tuple(name for name in self.order if name in found)

    def skill(self, name: str) -> Skill:
        """Return a skill.

        Raises:
            ModelError: there is none of this name.
        """
        if name not in self.skills:
            hint = nearest(name, self.skills) if self.skills else "it has no skills"
            raise ModelError(f"the mind {self.name!r} has no skill {name!r}", remedy=hint)
        return self.skills[name]

    def with_modules(
        self,
        sensors: Iterable[Sensor | str] = (),
        actuators: Iterable[Actuator | str] = (),
        variables: Iterable[Variable | str] = (),
        skills: Iterable[Skill] = (),
        without: Iterable[str] = (),
    ) -> MindDescription:
        """Return the mind with further modules.

        Args:
            sensors: sensors; one that is there already must be equal.
            actuators: actuators, likewise.
            variables: variables, likewise.
            skills: a skill of a name that is there takes its place.
            without: names of skills that are left out.
        """
        left = set(several(without, "without"))
        added = _by_name(skills, Skill, "skill")
        kept = [one for name, one in self.skills.items() if name not in added and name not in left]
        return MindDescription(
            self.name,
            _joined(self.sensors, _by_name(sensors, Sensor, "sensor"), "sensor"),
            _joined(self.actuators, _by_name(actuators, Actuator, "actuator"), "actuator"),
            _joined(self.variables, _by_name(variables, Variable, "variable"), "variable"),
            [*kept, *added.values()],
        )

    def on_stand_ins(self, master: str, stand_ins: Iterable[Skill]) -> MindDescription:
        """Return a skill on stand-ins for some of those below it, with all that these need alone.

        Args:
            master: the skill, which is the master of what is returned.
            stand_ins: skills in the places of those of their names; what only these influenced is
                left out.

        >>> from socialmind.mind import Perceptron, Skill
        >>> line = Perceptron(layers=0)
        >>> robot = MindDescription("robot", ["Far"], ["MotL", "MotR"], skills=[
        ...     Skill("Go", ["SE:Far"], ["SK:Turn"], line),
        ...     Skill("Turn", ["SE:Far"], ["MO:MotL", "MO:MotR"], line),
        ... ])
        >>> point = robot.on_stand_ins("Go", [Skill("Turn", ["SE:Aside"], ["MO:X"], line)])
        >>> list(point.skills), list(point.sensors), list(point.actuators)
        (['Go', 'Turn'], ['Far', 'Aside'], ['X'])
        """
        known = {**self.skills, **_by_name(stand_ins, Skill, "skill")}
        found: dict[str, Skill] = {}
        waiting = [master]
        while waiting:
            name = waiting.pop(0)
            if name in known and name not in found:
                found[name] = known[name]
                waiting += known[name].subskills
        needed: dict[str, dict[str, None]] = {"sensor": {}, "actuator": {}, "variable": {}}
        for skill in found.values():
            for link in skill.links:
                if link.module in needed:
                    needed[link.module][link.name] = None
        return MindDescription(
            self.name,
            [self.sensors.get(name, name) for name in needed["sensor"]],
            [self.actuators.get(name, name) for name in needed["actuator"]],
            [self.variables.get(name, name) for name in needed["variable"]],
            found.values(),
        )

    def _repr_html_(self) -> str:
        parts = {
            "skills": self.skills, "sensors": self.sensors,
            "variables": self.variables, "actuators": self.actuators,
        }  # fmt: skip
        rows = [(kind, ", ".join(named)) for kind, named in parts.items()]
        return as_html([("mind", self.name), *rows])

    def __repr__(self) -> str:
        return (
            f"<mind {self.name!r}: {len(self.sensors)} sensors, {len(self.variables)} variables, "
            f"{len(self.skills)} skills, {len(self.actuators)} actuators>"
        )


def _by_name(modules: Iterable[Any], kind: type[Any], what: str) -> dict[str, Any]:
    """Return modules by their names; a text stands for a module of that name."""
    found: dict[str, Any] = {}
    for given in several(modules, f"{what}s"):
        one: Any = kind(given) if isinstance(given, str) and kind is not Skill else given
        if not isinstance(one, kind):
            raise ModelError(f"{one!r} among the {what}s", f"a {kind.__name__}")
        if one.name in found:
            before = found[one.name]
            place = "" if before.line is None else f", first in line {before.line}"
            if before.file != one.file and before.file is not None:
                place = f", first in {place_called(before.file, before.line)}"
            raise ModelError(
                f"a second {what} called {one.name!r}{place}",
                "each name once",
                file=one.file,
                line=one.line,
            )
        found[one.name] = one
    return found


def _joined(own: Mapping[str, Any], added: Mapping[str, Any], what: str) -> list[Any]:
    """Return modules with further ones; one under the same name must be the same."""
    for name, one in added.items():
        if name in own and own[name] != one:
            raise ModelError(f"the {what} {name!r} as {one}", f"{own[name]}, as in the mind")
    return [*own.values(), *(one for name, one in added.items() if name not in own)]


def _unpacked_mind(content: bytes) -> MindDescription:
    from socialmind.work.packing import unpacked

    made = MindDescription.__new__(MindDescription)
    vars(made).update(unpacked(content))
    return made
