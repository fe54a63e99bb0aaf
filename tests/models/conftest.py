"""What the tests of models share: the states of societies, side by side, and single agents."""

from types import SimpleNamespace

import numpy as np
import pytest

from coglogo_py import kernel
from socialmind.agents import bookkeeping
from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.streams import SCHEDULE_TAG, Stream, phase_tags

LIVE = phase_tags(SCHEDULE_TAG, ["live"])[
    0
]  # the phase in which the agents of the farmer-artisan society act


def parts(state):
    """Yield the arrays of a state with their names, of records each field apart.

    Padding between the fields of a record, and columns of addresses, are nobody's.
    """
    kept = ("_tick", "_idle", "_idle_agent", "_idle_tick")
    for name, array in state.items():
        if array.dtype.names is None:
            yield name, array
            continue
        for field in array.dtype.names:
            ours = name != "context" or not field.startswith("_") or field.startswith("_has_")
            if ours or field in kept:
                yield f"{name}.{field}", array[field]


# What is stacked for births to come, and where its height stands.
STACKS = {
    "free": ("counters", bookkeeping.FREE),
    "minds.free_minds": ("minds.counters", kernel.FREE_MINDS),
    "minds.free_instances": ("minds.counters", kernel.FREE_INSTANCES),
}


def different(one, other):
    """Return the names of what differs between the states of two models, to the last bit.

    Compiled, a population has room for births before there are any: who lives there and which
    places come next is compared, not how many more there could be, nor what lies beyond the stacks.
    """
    mine, theirs = dict(parts(one.state())), dict(parts(other.state()))
    assert mine.keys() == theirs.keys()
    roomier = {
        name.removesuffix(".alive")
        for name in mine
        if name.endswith(".alive") and len(mine[name]) != len(theirs[name])
    }
    found = []
    for name in mine:
        a, b = mine[name], theirs[name]
        population, _, rest = name.partition(".")
        if rest in STACKS:
            counters, place = STACKS[rest]
            a, b = (
                stack[: state[f"{population}.{counters}"][place]][::-1]
                for stack, state in ((a, mine), (b, theirs))
            )
        if population in roomier and rest.removeprefix("minds.") == "counters":
            continue
        if population in roomier or rest == "slot_of":
            room = min(len(a), len(b))
            a, b = a[:room], b[:room]
        if not np.array_equal(a, b, equal_nan=a.dtype.kind == "f"):
            found.append(name)
    return found


@pytest.fixture(scope="session")
def differences():
    """What compares the states of two models."""
    return different


# The farmer-artisan society -----------------------------------------------------------------------


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a society of one agent, at either speed."""

    def made(n_agents=1, **parameters):
        return load_model("farmer_artisan")(
            11, compiled=request.param, n_agents=n_agents, **parameters
        )

    return made


def draws(society, agent=0):
    """Return the stream of an agent's numbers in the tick to come."""
    stream = Stream(society.seed)
    stream.begin(LIVE, agent, society.tick)
    return stream


def place(human, x, y):
    human.x, human.y = x, y


def follow(society, plan, timer=9):
    """Let the first agent go on with a plan for a tick."""
    human = society.humans[0]
    human.plan, human.timer = plan, timer
    society.advance(1)
    return human


def settle(society, x, y):
    """Give the first agent land, and put it there."""
    human = society.humans[0]
    human.land_x, human.land_y = x, y
    place(human, float(x), float(y))
    return human


def cogniton(human, name):
    return human.mind.get_cogniton_value(name)


def demands(village):
    return village.staple_demand, village.ware_demand


def trader(society, tools=10.0, wheat=1000.0, staple=8350.0, ware=40.0):
    """Put the first agent onto the village, with stocks; return the agent and the village."""
    human, village = society.humans[0], society.villages[0]
    place(human, 0.3, -0.4)
    human.tools, human.wheat = tools, wheat
    human.mind.set_cogniton_value("Farmer", 1.0)
    human.mind.set_cogniton_value("Artisan", 2.0)
    village.staple, village.ware = staple, ware
    village.staple_demand, village.ware_demand = 0.5, 0.25
    return human, village


@pytest.fixture(scope="session")
def play():
    """What puts the first agent into a case, and lets it act."""
    return SimpleNamespace(
        draws=draws,
        place=place,
        follow=follow,
        settle=settle,
        trader=trader,
        cogniton=cogniton,
        demands=demands,
    )


@pytest.fixture(scope="session")
def described():
    """Return a table of skills in a model's ODD document: what each reads, commands and weighs."""

    def table(model, title="Skills of robots"):
        text = (model_folder(model) / "ODD.md").read_text("utf-8").split(f"### {title}\n", 1)[1]
        first = text[text.index("|") :].split("\n\n", 1)[0].splitlines()
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in first[2:]]
        return {
            name.split(" (")[0]: (
                [*filter(None, reads.split(", "))], commands.split(", "), int(rest[-1]),
            )
            for name, reads, commands, *rest in rows
        }  # fmt: skip

    return table


@pytest.fixture(scope="session")
def found_in():
    """Return the same of a mind."""

    def table(mind):
        return {
            name: ([one.name for one in skill.inputs], [one.name for one in skill.outputs],
                   skill.genome_size)
            for name, skill in mind.skills.items()
        }  # fmt: skip

    return table
