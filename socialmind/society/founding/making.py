"""Making a society: the values, schemes and tables that it begins with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import shown
from coglogo_py.border.memory import check_memory
from coglogo_py.culture import Culture
from coglogo_py.society import Society
from socialmind.agents.heeding import check_conditions
from socialmind.agents.running import Running
from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.fields import Field, place_of_field, presence
from socialmind.society.connection import names_of_minds
from socialmind.society.founding.beginning import Beginning, beginning_of, is_table
from socialmind.society.founding.blueprint import Blueprint, SchemeFiles
from socialmind.society.founding.civilisations import found
from socialmind.society.messages import MessageTable
from socialmind.society.parameter import Parameter
from socialmind.society.population import Population
from socialmind.society.table import Table
from socialmind.streams import STREAM
from socialmind.worlds.contract import Ground, World

if TYPE_CHECKING:
    from socialmind.mind.population_minds import PopulationMinds
    from socialmind.mind.steering import Steering


def set_values(
    context: Any,
    parameters: Mapping[str, Parameter],
    variables: Mapping[str, Field],
    given: Mapping[str, Any],
    model: str,
) -> None:
    """Write parameters and variables into the record of a society.

    Args:
        context: the record.
        parameters: those of the model.
        variables: likewise.
        given: values of parameters that differ from the defaults.
        model: the model's name.

    Raises:
        SocialmindError: a parameter is unknown or out of range.
    """
    for name in given:
        if name not in parameters:
            raise SocialmindError(f"{model} has no parameter {name!r}; {nearest(name, parameters)}")
    for name, one in parameters.items():
        context[name] = one.stored(given.get(name, one.default))
    for field in variables.values():
        default: Any = field.default
        if field.optional:
            context[presence(field.name)] = default is not None
        context[field.name] = 0 if default is None else default


def engine_named(physics: str, engines: tuple[str, ...], model: str) -> str:
    """Return what moves bodies in a model's world.

    Raises:
        SocialmindError: the world has no such engine.
    """
    if physics not in engines:
        if len(engines) == 1:
            raise SocialmindError(f"physics={physics!r} for {model}, which has no plane")
        raise SocialmindError(f"physics: found {physics!r}; {nearest(physics, engines)}")
    return physics


def ignore(
    context: Any, interruptions: Mapping[str, Any], without: tuple[str, ...], model: str
) -> None:
    """Note in the record of a society which interruptions are not heeded, as bits.

    Raises:
        SocialmindError: there is no such interruption.
    """
    names = list(interruptions)
    for name in without:
        if name not in names:
            raise SocialmindError(
                f"no interruption called {name!r} in {model}; {nearest(name, names)}"
            )
        context["_ignored"] |= 1 << names.index(name)


def new_stream(seed: int) -> NDArray[Any]:
    """Return the state of a society's compiled draws, keyed by its seed."""
    stream = np.zeros(1, STREAM)
    stream["key_0"], stream["key_1"] = seed & 0xFFFFFFFF, seed >> 32
    return stream


def ground_of(society: Running, world: World) -> Ground:
    """Return the world of a society whose record is filled.

    Raises:
        SocialmindError: the parameter that gives its size is less than 1.
    """
    return world.ground(society, *(size_of(society.context, one, 1) for one in world.sizes))


def names_in_minds(society: Running, files: Mapping[str, Path]) -> dict[str, NDArray[np.int64]]:
    """Return where in the minds of each population the names stand that its rules write.

    Args:
        society: with its schemes and assemblies.
        files: where the schemes were read from, for errors.

    Raises:
        ModelError: a rule names what the minds do not have.
    """
    for (name, command, other), place in society.program.between_minds.items():
        if society.tables[name].society.minds is not society.tables[other].society.minds:
            raise ModelError(
                f"{command}() of minds of {other!r} by those of {name!r}, which share no groups",
                None,
                'give both populations a culture, as culture="realm"',
                *place,
            )
    found = {}
    for name in society.shape.populations:
        scheme, assembly = society.schemes.get(name), society.assemblies.get(name)
        minds = society.tables[name].society
        parts = None if minds is None else minds.names
        places = names_of_minds(society.program, name, scheme, assembly, files.get(name), parts)
        found[name] = np.array(places, np.int64)
    return found


def size_of(context: Any, size: int | str, least: int) -> int:
    """Return a size, which may be the name of a parameter.

    Raises:
        SocialmindError: the parameter is less than it can be.
    """
    if not isinstance(size, str):
        return size
    found = int(context[size])
    if found < least:
        raise SocialmindError(f"parameter {size}: found {found}; expected {least} or more")
    return found


def schemes_of(
    populations: Mapping[str, Population],
    folder: Callable[[], Path],
    given: Any,
    model: str,
    read: SchemeFiles,
) -> tuple[dict[str, CognitiveScheme], dict[str, Path]]:
    """Return the schemes of the populations that have minds, and the files of those in files.

    Args:
        populations: of the model.
        folder: gives the model's, if it is asked for: a class may stand in no file.
        given: schemes to use in place of its own, as `Model` takes them.
        model: the model's name.
        read: reads schemes from files.

    Raises:
        SocialmindError: it is not clear for whom a scheme is, or it cannot be read.
        ModelError: the model's own scheme lacks what the model declares.
    """
    minded = {name: one for name, one in populations.items() if one.mind is not None}
    if given is not None and not isinstance(given, Mapping):
        if len(minded) != 1:
            raise SocialmindError(
                f"a scheme for {model}, which has {len(minded)} populations with minds; "
                f"give a mapping from {', '.join(minded) or 'their names'}"
            )
        given = {next(iter(minded)): given}
    schemes: dict[str, CognitiveScheme] = {}
    files: dict[str, Path] = {}
    for name, population in minded.items():
        source: Any = (given or {}).get(name, population.mind)
        own = given is None or name not in given
        if not isinstance(source, CognitiveScheme):
            path = folder() / source if own else Path(source)
            source = read.load(path, population.decision_makers)
            files[name] = path
        schemes[name] = source
    for name, population in minded.items():
        # Another scheme may have fewer plans than the model knows how to carry out.
        if given is None or name not in given:
            _check_plans(name, population, schemes[name], files.get(name))
    return schemes, files


def conditioned(society: Running, files: Mapping[str, Path]) -> tuple[str, ...]:
    """Return the populations whose schemes have conditions.

    Args:
        society: with its schemes.
        files: where the schemes were read from, for errors.

    Raises:
        ModelError: a condition is on what the agents or the model do not have.
    """
    found = tuple(name for name, one in society.schemes.items() if one.has_conditions)
    for name in found:
        file = files.get(name)
        place = (file, None) if file is not None else place_of_field(type(society), name)
        fields = society.shape.populations[name].fields
        check_conditions(society.schemes[name], name, fields, society.shape.parameters, place)
    return found


def _check_plans(
    name: str, population: Population, scheme: CognitiveScheme, file: Path | None
) -> None:
    """Refuse functions of plans, and bounds of cognitons, that a model's own scheme has not."""
    cognitons = [one.name for one in scheme.cognitons]
    for civilisation in population.civilisations:
        for cogniton in civilisation.cognitons:
            if cogniton not in cognitons:
                raise civilisation.error(
                    f"the cogniton {cogniton!r} of {civilisation.name!r}, which the scheme "
                    f"{scheme.name!r} does not have",
                    None,
                    nearest(cogniton, cognitons),
                )
    for cogniton in population.bounds:
        if cogniton not in cognitons:
            raise ModelError(
                f"bounds of the cogniton {cogniton!r} of {name!r}, which the scheme "
                f"{scheme.name!r} does not have",
                remedy=nearest(cogniton, cognitons),
                file=file,
            )
    for plan in population.plans:
        if plan not in scheme.plans:
            raise ModelError(
                f"a function for the plan {plan!r} of {name!r}, which the scheme {scheme.name!r} "
                "does not have",
                "a function for each of its plans",
                nearest(plan, scheme.plans),
                file,
            )


def beginnings_of(
    society: Running,
    given: Mapping[str, Any],
    parameters: Mapping[str, Any],
    folder: Callable[[], Path],
) -> dict[str, Beginning]:
    """Return the tables that populations begin with; a parameter that is their size says so too.

    Args:
        society: whose record is filled.
        given: tables for some of its populations, in place of what they declare.
        parameters: what was given for parameters.
        folder: gives the model's.

    Raises:
        SocialmindError: a table cannot be read, or it is of another size than a parameter says.
    """
    found = {}
    for name, population in society.populations.items():
        source = given.get(name, population.table)
        if source is None:
            continue
        if not is_table(source):
            raise SocialmindError(
                f"{name}={shown(source)}, which is a population of {society.name}; expected a "
                "table: a CSV or Parquet file, a data frame, or columns by their names"
            )
        fields = society.shape.populations[name].fields
        found[name] = beginning_of(source, name, fields, folder if name not in given else Path)
        count, size = found[name].count, population.size
        if isinstance(size, str) and parameters.get(size, count) != count:
            raise SocialmindError(
                f"{size}={parameters[size]} where {found[name].what} has {count} rows; leave it out"
            )
        if isinstance(size, str):
            society.context[size] = type(society).parameters[size].stored(count)  # type: ignore[attr-defined]
    return found


def tables_of(
    society: Running,
    steerings: Mapping[str, Steering],
    beginnings: Mapping[str, Beginning],
    blueprint: Blueprint,
) -> dict[str, Table]:
    """Return the populations of a society, with the agents that it begins with.

    Args:
        society: with its ground, schemes and assemblies.
        steerings: the hierarchies of skills of those that have some.
        beginnings: the tables of those that begin with one.
        blueprint: what its tables share with those of other societies.

    Raises:
        SocialmindError: a table holds what a field cannot, or more agents than there is memory for.
    """
    sizes = {}
    peoples = {}
    for name, population in society.populations.items():
        peoples[name] = [size_of(society.context, one, 0) for one in population.sizes]
        sizes[name] = sum(peoples[name])
        if name in beginnings:
            sizes[name] = beginnings[name].count
        # Beside its row an agent has a place in five more arrays, and its mind.
        row = blueprint.tables[name].dtype.itemsize + 5 * 8
        what = f"{shown(sizes[name])} agents of {name!r} in {society.name}"
        check_memory(sizes[name] * row, what, SocialmindError)
    tables: dict[str, Any] = {}
    minds = minds_of(society.populations, society.schemes, society.seed)
    for name in society.populations:
        skills = None
        if name in society.assemblies:
            skills = partial(_skills, society, name, steerings[name].drive)
        shape = society.shape.populations[name]
        kind = Table if shape.messages_to is None else MessageTable
        form = blueprint.tables[name]
        births = name in society.program.births
        tables[name] = kind(society, shape, form, sizes[name], minds.get(name), skills, births)
        if name in beginnings:
            tables[name].begin_with(beginnings[name])
        civilisations = society.populations[name].civilisations
        if civilisations:
            found(tables[name], civilisations, peoples[name], society.seed)
    for name, network in society.networks.items():
        tables[name] = network.links_in(society, blueprint.tables[name])
        tables[name].settle_in(tables)
    return tables


def begin_networks(society: Any) -> None:
    """Make the links that a society's networks begin with.

    Raises:
        ModelError: they cannot be made, with the file and line of the network.
    """
    for name, network in society.networks.items():
        if network.start is None:
            continue
        try:
            society.tables[name].begin(network.start, type(society).folder)
        except SocialmindError as error:
            file, line = place_of_field(type(society), name)
            raise ModelError(f"{error}, for the network {name!r}", file=file, line=line) from error


def minds_of(
    populations: Mapping[str, Population], schemes: Mapping[str, CognitiveScheme], seed: int
) -> dict[str, Society]:
    """Return the minds of each population that has some.

    Populations with an equal scheme share its groups; those of a culture share theirs, whatever
    their schemes.

    Raises:
        SchemeError: the schemes of a culture disagree on a group.
    """
    found: dict[str, Society] = {}
    for place, name in enumerate(populations):
        if name not in schemes or name in found:
            continue
        culture = populations[name].culture
        sharing = [one for one in schemes if populations[one].culture == culture]
        if culture is not None:
            breeds = Culture([schemes[one] for one in sharing], seed, place).breeds
            found |= zip(sharing, breeds, strict=True)
            continue
        same = [one for one in sharing if one in found and schemes[one] == schemes[name]]
        found[name] = found[same[0]] if same else Society(schemes[name], seed, place)
    return found


def _skills(society: Running, name: str, drive: Any, capacity: int) -> PopulationMinds:
    """Return the hierarchies of a population for so many agents."""
    from socialmind.mind.population_minds import PopulationMinds

    population = society.populations[name]
    return PopulationMinds(
        society.assemblies[name],
        capacity,
        society.seed,
        name,
        population.own_genomes,
        population.instances,
        drive,
        lambda: society.tick,
    )
