"""What somebody who steered a robot by hand has shown, for imprinting (thesis, 5.2.3)."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from socialmind.errors import SocialmindError, nearest
from socialmind.interventions.following import Intervention, after_those_at, in_order
from socialmind.interventions.steer import Steer
from socialmind.learning.imprinting.recording import Recording, of_episodes
from socialmind.mind.description import MindDescription
from socialmind.mind.evaluation.agent_state import AgentState
from socialmind.mind.modules import Skill
from socialmind.model import Model
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.capsule import Capsule
from socialmind.runs.sources import model_of


def recording_of_run(
    folder: str | Path, skill: str, population: str | None = None, trust: bool = False
) -> Recording:
    """Return what somebody showed a skill in a run in which they steered a robot by hand.

    The run is repeated, which shows what the skill read in each tick.

    Args:
        folder: the run's.
        skill: the name of a skill of the robots' mind that commands nothing but actuators.
        population: the robots'; by default those that were steered first.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: nobody was steered by hand, or there is no such skill.

    >>> recording_of_run("runs/collect-001", "GoToObject")                # doctest: +SKIP
    <recording of 412 records in 2 episodes: 1 input, 2 outputs>
    """
    capsule = Capsule(folder)
    interventions = interventions_of(capsule, trust)
    society = model_of(capsule, trust=trust)
    ticks = capsule.manifest.ticks_done
    return recording_of(society, interventions, ticks, skill, population)[0]


def recording_of(
    society: Model,
    interventions: Iterable[Intervention],
    ticks: int,
    skill: str,
    population: str | None = None,
) -> tuple[Recording, Skill]:
    """Return what a robot's skill was shown while somebody steered it, and the skill.

    Args:
        society: before its first tick; it goes on.
        interventions: what is done to it, steering by hand (`Steer`) among it.
        ticks: for how long.
        skill: as for `recording_of_run`.
        population: likewise.

    Raises:
        SocialmindError: nobody is steered by hand, or there is no such skill.
    """
    ordered = in_order(interventions)
    names = [one.population for one in ordered if isinstance(one, Steer)]
    if not names:
        raise SocialmindError("nobody was steered by hand, so there is nothing to learn from")
    name = population or names[0]
    shown = shown_skill(society, name, skill)
    actuators = list(type(society).shape.world.robots[name].actuators)
    places = [actuators.index(output.name) for output in shown.outputs]
    episodes: list[tuple[list[Any], list[Any]]] = []
    before = None
    end = society.tick + ticks
    while society.tick < end and not society.stopped:
        society = after_those_at(society, ordered)
        robot, table = society.ground.steered(name), society.tables[name]
        shows = None
        if robot is not None and table.contains(robot) and table.minds is not None:
            slot = table[robot]._slot
            state = AgentState(table.minds, slot)
            if state.tick > 0:  # before that it has read nothing
                shows = robot
                if shows != before:
                    episodes.append(([], []))
                read = state.inputs(skill)
                episodes[-1][0].append([read[str(one)] for one in shown.inputs])
                episodes[-1][1].append(table.rows["commands"][slot][places].tolist())
        before = shows
        society.advance(1)
    if not episodes:
        raise SocialmindError(
            f"nobody of {name!r} was steered by hand in these {ticks} ticks, so there is nothing "
            "to learn from"
        )
    return of_episodes(episodes, shown), shown


def shown_skill(society: Model, population: str, skill: str) -> Skill:
    """Return the skill of a population's mind that somebody can show by steering.

    Raises:
        SocialmindError: there is none of that name, or it commands more than actuators.
    """
    known = shown_skills(society, population)
    if skill not in known:
        raise SocialmindError(
            f"the skill {skill!r} of {population!r} to be shown by steering; expected one that "
            f"commands actuators alone; {nearest(skill, known)}"
        )
    mind: MindDescription = society.assemblies[population].description
    return mind.skills[skill].changed(genome=None)


def shown_skills(society: Model, population: str) -> list[str]:
    """Return the skills of a population's mind that somebody can show by steering.

    They are evaluated, and command nothing but actuators.
    """
    assembly = society.assemblies.get(population)
    if assembly is None:
        return []
    skills = assembly.description.skills
    return [
        name
        for name in assembly.skills
        if skills[name].outputs and all(one.module == "actuator" for one in skills[name].outputs)
    ]
