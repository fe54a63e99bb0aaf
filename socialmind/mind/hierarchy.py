"""A hierarchy of skills that steers one agent: built, evaluated and looked into from Python."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.closed import Closed
from coglogo_py.border.numbers import whole_number
from socialmind.errors import ModelError, SocialmindError
from socialmind.mind import variants
from socialmind.mind.code.drive import AgentHierarchy
from socialmind.mind.description import MindDescription
from socialmind.mind.evaluation import state as states
from socialmind.mind.evaluation.agent_state import Readings
from socialmind.mind.evaluation.arrays import assemble, master_of
from socialmind.mind.evaluation.running_skill import RunningSkill
from socialmind.mind.evaluation.steps import Steps
from socialmind.mind.kernel.reach import ROUNDING
from socialmind.mind.links import Input
from socialmind.mind.modules import Skill
from socialmind.mind.names import unknown
from socialmind.work.packing import packed, unpacked

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from socialmind.mind.minds import Minds
    from socialmind.mind.views.explanation import Explanation


class Hierarchy(Closed, Readings):
    """A mind that runs: the skills below a master, for one agent.

    Args:
        description: the mind.
        master: the name of its master skill, which receives the influence 1.0; may be left out
            where no other skill influences exactly one.
        seed: the key of the draws of cogniton schemes, 0 … 2⁶⁴ − 1.
        drive: the drive module (thesis, 5.1.3): a function of one parameter, the mind, called in
            every evaluation before the skills; see `socialmind.mind.code.drive`.
        population: that of a model whose agents' schemes draw alike; none for a mind by itself.

    Raises:
        ModelError: there is no such master, or it is unclear which.

    >>> from socialmind.mind import MindDescription, Programmed, Skill
    >>> def seek_light(left, right):
    ...     return right, left
    >>> wiring = Skill(
    ...     "Seek", ["SE:EyeL", "SE:EyeR"], ["MO:MotL", "MO:MotR"], Programmed(seek_light)
    ... )
    >>> vehicle = Hierarchy(
    ...     MindDescription("vehicle", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=[wiring])
    ... )
    >>> vehicle.evaluate({"EyeL": 0.9, "EyeR": 0.2})
    {'MotL': 0.2, 'MotR': 0.9}
    """

    def __init__(
        self,
        description: MindDescription,
        master: str | None = None,
        seed: int = 0,
        drive: Callable[..., None] | None = None,
        population: str = "",
    ) -> None:
        if drive is not None and not callable(drive):
            raise ModelError(f"{drive!r} as a drive", "a function of one parameter, the mind")
        self.description = description
        self.master = master_of(description, master)
        self.seed = seed
        self.drive = drive
        self._population = population
        self.assembly = assemble(description, self.master, drive is not None, observed=True)
        self._genomes = {name: description.skills[name].genome for name in self.assembly.skills}
        self._record = states.Record(self.assembly, np.zeros(0, np.int64))
        self._steps = Steps(
            self.assembly,
            self._record,
            [one.function for one, _, _ in self.assembly.programs],
            [one.function for one in self.assembly.regulations],
            drive,
            lambda: self.tick,
        )
        self._required = self.assembly.required
        self.reset()
        self._closed = True

    # Evaluating -------------------------------------------------------------------------------

    def evaluate(self, sensors: Mapping[str, float]) -> dict[str, float]:
        """Evaluate the hierarchy once, in the order of figure 5.4 of the thesis.

        Args:
            sensors: the value, 0 … 1, of each sensor that the skills below the master read;
                further sensors of the mind may be given too.

        Returns:
            The command of each actuator, 0 … 1 (equation 4.3); its neutral one where no skill
            influences it.

        Raises:
            ModelError: a sensor is missing, unknown or outside [0, 1]; a genome is not set; or a
                programmed function gave no number, which leaves the evaluation half done until
                the next `reset`.
        """
        values = self._state.sensors[0, :, 0]
        for name in self._required:
            if name not in sensors:
                raise ModelError(
                    f"no value for the sensor {name!r}",
                    "one for each sensor that the skills read",
                )
        places = self._sensor_places
        checked = {name: self._checked(name, value) for name, value in sensors.items()}
        for name, value in checked.items():
            values[places[name]] = value
        if self._unset:
            raise self.description.skills[next(iter(self._unset))].without_genome()
        try:
            self._steps.evaluate(0)
        except ValueError as error:
            raise ModelError(f"the mind {self.description.name!r}: {error}") from error
        self._tick += 1
        return self.actuators()

    def _checked(self, name: str, value: Any) -> float:
        if name not in self._sensor_places:
            raise unknown("sensor", name, self._sensor_places)
        try:
            number = np.nan if isinstance(value, str | bytes) else float(value)
        except (TypeError, ValueError):
            number = np.nan
        if not -ROUNDING <= number <= 1 + ROUNDING:
            raise ModelError(f"{value!r} for the sensor {name!r}", "a number, 0 … 1")
        return min(max(number, 0.0), 1.0)

    def reset(self) -> None:
        """Put the mind back to before its first evaluation; genomes stay."""
        self._tick = 0
        self._state = states.new_state(self.assembly, 1, 1, False, 0)
        self._societies = states.societies_of(self.assembly, self.seed, 1, self._population)
        self._record.connect(1, self._state, self._societies)
        self._steps.connect(self._state, self._societies)
        self._sensor_places = {name: place for place, name in enumerate(self.description.sensors)}
        self._unset = set()
        for name, genome in self._genomes.items():
            if genome is not None:
                self._state.genome[0, self.assembly.genome_of(name), 0] = genome
            elif self.description.skills[name].genome_size:
                self._unset.add(name)

    # Looking ----------------------------------------------------------------------------------

    @property
    def _read(self) -> states.State:
        return self._state

    @property
    def tick(self) -> int:
        """How many evaluations there were since the last reset."""
        return self._tick

    def set_variable(self, name: str, value: float) -> None:
        """Set a variable, 0 … 1; skills see it in the next evaluation.

        Raises:
            ModelError: there is no such variable, or the value is outside [0, 1].
        """
        try:
            AgentHierarchy(self._steps, 0).set_variable(name, value)
        except (TypeError, ValueError):
            raise ModelError(f"{value!r} for the variable {name!r}", "a number, 0 … 1") from None

    def skill(self, name: str) -> RunningSkill:
        """Return a skill of the hierarchy, whose genome can be read and set.

        Raises:
            ModelError: there is none of this name below the master.
        """
        self.description.skill(name)
        if name not in self.skills:
            raise ModelError(
                f"the skill {name!r}, which the master {self.master!r} does not reach",
                f"one of {', '.join(self.skills)}",
            )
        return RunningSkill(self, name)

    # Genomes ----------------------------------------------------------------------------------

    def genome(self, skill: str) -> NDArray[np.float64] | None:
        """Return a skill's weights, read-only; None where they are not set or it has none.

        Raises:
            ModelError: there is no such skill below the master.
        """
        return self._genomes[self.skill(skill).name]

    def set_genome(self, skill: str, genome: Any) -> None:
        """Set a skill's weights.

        Raises:
            ModelError: no such skill, a wrong size, or a weight that is not a finite number.
        """
        weights = self.description.skills[self.skill(skill).name].fitting(genome)
        self._genomes[skill] = weights
        self._state.genome[0, self.assembly.genome_of(skill), 0] = weights
        self._unset.discard(skill)

    def randomise(self, seed: int) -> None:
        """Draw the weights of every network from [-1, 1].

        Args:
            seed: the key of the draws, 0 or more; skill by skill, in the order of their names.

        Raises:
            SocialmindError: the seed is none.
        """
        rng = np.random.default_rng(whole_number(seed, "seed", 0, error=SocialmindError))
        for name in sorted(self.skills):
            size = self.description.skills[name].genome_size
            if size:
                self.set_genome(name, rng.uniform(-1.0, 1.0, size))

    def trained(self) -> MindDescription:
        """Return the mind's description with the genomes as they are set."""
        skills = [
            self.description.skills[name].changed(genome=genome)
            for name, genome in self._genomes.items()
        ]
        return self.description.with_modules(skills=skills)

    def save(self, path: str | Path) -> None:
        """Write the mind with its genomes: a folder, or YAML where the path ends in .yaml."""
        self.trained().save(path)

    # Copies -----------------------------------------------------------------------------------

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked_hierarchy, (packed(self._parts()),)

    def __copy__(self) -> Hierarchy:
        return _remade(*self._parts())

    def __deepcopy__(self, memo: dict[int, Any]) -> Hierarchy:
        return _remade(*self._parts())

    def _parts(self) -> tuple[Any, ...]:
        """Return what the mind is made of anew: its settings, genomes, tick and state."""
        settings = (self.description, self.master, self.seed, self.drive)
        state = states.kept(self._state, self._societies)
        return settings, dict(self._genomes), self._tick, state

    def _restore(self, tick: int, state: Mapping[str, NDArray[Any]]) -> None:
        self._tick = tick
        self._state = states.restored(self._state, state)
        states.restore_societies(self._societies, state)
        self._record.connect(1, self._state, self._societies)
        self._steps.connect(self._state, self._societies)

    # Variants ---------------------------------------------------------------------------------

    def replace(self, name: str, other: Skill | Hierarchy, **modules: Any) -> Hierarchy:
        """Return a hierarchy in which another skill, or a hierarchy, stands in a skill's place.

        Args:
            name: the skill that goes.
            other: what comes; whatever influenced the old skill influences it, or its master.
            modules: `sensors`, `actuators`, `variables` that it needs beside the mind's own.

        Raises:
            ModelError: there is no such skill, or the modules do not fit together.
        """
        description, master = variants.replaced(self.trained(), self.master, name, other, **modules)
        return self._variant(description, master)

    def encapsulate(
        self, new_master: Skill, skills: Iterable[Skill] = (), **modules: Any
    ) -> Hierarchy:
        """Return a hierarchy under a further master, of which the old master is a subskill.

        The encapsulated variant of section 6.3 of the thesis.

        Args:
            new_master: the skill above; one of its outputs goes to the old master.
            skills: further skills that it influences.
            modules: `sensors`, `actuators`, `variables` that they need beside the mind's own.

        Raises:
            ModelError: the new master does not influence the old one, or does not fit.
        """
        description, master = variants.encapsulated(
            self.trained(), self.master, new_master, skills, **modules
        )
        return self._variant(description, master)

    def graft(
        self,
        skill: Skill | Hierarchy,
        under: str | None = None,
        inputs: Iterable[Input | str] = (),
        skills: Iterable[Skill] = (),
        **modules: Any,
    ) -> Hierarchy:
        """Return a hierarchy in which a complex skill has a further subskill.

        The retrained variant of section 6.3: the complex skill keeps its name and gets an output
        more, so its genome is unset and must be learned anew.

        Args:
            skill: the subskill, or a hierarchy whose master it is.
            under: the complex skill, the master unless said.
            inputs: what it reads from now on beside its inputs.
            skills: further skills that the new one influences.
            modules: `sensors`, `actuators`, `variables` that they need beside the mind's own.

        Raises:
            ModelError: there is no such skill, or the modules do not fit together.
        """
        description = variants.grafted(
            self.trained(), skill, under or self.master, inputs, skills, **modules
        )
        return self._variant(description, self.master)

    def _variant(self, description: MindDescription, master: str) -> Hierarchy:
        return Hierarchy(description, master, self.seed, self.drive)

    def many(
        self, agents: int, own_genomes: bool | Iterable[str] = False, **settings: Any
    ) -> Minds:
        """Return many agents with this hierarchy, evaluated together; see `Minds`."""
        from socialmind.mind.minds import Minds

        own: dict[str, Any] = {"seed": self.seed, "drive": self.drive}
        return Minds(self.trained(), self.master, agents, own_genomes, **(own | settings))

    # Showing ----------------------------------------------------------------------------------

    def explain(self) -> Explanation:
        """Print who influenced what in the last evaluation, and how much it counted in each motor.

        Returns:
            The same, as data.
        """
        from socialmind.mind.views.explanation import explanation_of

        explanation = explanation_of(self)
        print(explanation)
        return explanation

    def draw(self, ax: Axes | None = None) -> Axes:
        """Draw the hierarchy with its state, as in figure 5.5 of the thesis.

        Args:
            ax: matplotlib Axes to draw in; fresh ones unless given.
        """
        from socialmind.mind.views.drawing import draw_hierarchy

        return draw_hierarchy(self, ax)

    def __repr__(self) -> str:
        return (
            f"<hierarchy {self.description.name!r}: {self.master!r} over {len(self.skills)} skills>"
        )


def _unpacked_hierarchy(content: bytes) -> Hierarchy:
    return _remade(*unpacked(content))


def _remade(
    settings: tuple[Any, ...],
    genomes: Mapping[str, Any],
    tick: int,
    state: Mapping[str, NDArray[Any]],
) -> Hierarchy:
    """Return a hierarchy with genomes, in its state at a tick."""
    made = Hierarchy(*settings)
    for name, genome in genomes.items():
        if genome is not None and made.description.skills[name].genome_size:
            made.set_genome(name, genome)
    made._restore(tick, state)
    return made


def load_mind(
    path: str | Path,
    master: str | None = None,
    seed: int = 0,
    drive: Callable[..., None] | None = None,
) -> Hierarchy:
    """Read a mind's folder, or its YAML file, and make a hierarchy of it.

    Args:
        path: a folder with a `.botdesc` (thesis, appendix A), or a YAML file.
        master: the name of its master skill; may be left out where no other skill influences
            exactly one.
        seed: the key of the draws of cogniton schemes.
        drive: the drive module, as for `Hierarchy`.

    Raises:
        ModelError: a file is missing or wrong, with file and line.
    """
    return Hierarchy(MindDescription.load(path), master, seed, drive)
