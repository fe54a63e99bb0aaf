"""Variables (thesis, 4.3): figures 4.6 to 4.8 tick by tick, and what becomes of commands."""

import math
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_minds import mind, wired, written

from socialmind.mind import Counter, Hierarchy, Regulated, Simple, Variable, Wave


class Writer:
    """The mind of `small_minds.written`, run tick by tick."""

    def __init__(self, variable):
        self.hierarchy = Hierarchy(written(variable), "Master")
        self.name = variable.name

    def step(self, command=0.0, influence=1.0):
        """Command the variable; return its value at this tick, before it hears the command."""
        sensors = {"command": command, "influence": influence, "one": 1.0}
        self.shown = self.hierarchy.evaluate(sensors)
        return self.hierarchy.variables()[self.name]

    def run(self, commands, influences=None):
        """Return the values over some ticks."""
        influences = influences or [1.0] * len(commands)
        return [self.step(*both) for both in zip(commands, influences, strict=True)]


# Figure 4.6: a simple variable under two skills --------------------------------------------------


def test_figure_4_6():
    skills = [
        wired("Master", {"SK:A": "SE:influence A", "SK:B": "SE:influence B", "MO:seen": "VA:V"}),
        wired("A", {"VA:V": "SE:command A"}),
        wired("B", {"VA:V": "SE:command B"}),
    ]
    hierarchy = Hierarchy(mind(skills, ["V"]), "Master")
    ticks = [  # command A, command B, influence A, influence B; the value that follows
        (0.2, 0.8, 1.0, 0.0, 0.2),
        (0.2, 0.8, 0.0, 1.0, 0.8),
        (0.2, 0.8, 1.0, 1.0, 0.5),
        (0.2, 0.8, 0.5, 1.0, 0.9 / 1.5),
        (0.2, 0.8, 0.0, 0.0, 0.9 / 1.5),  # nobody commands: it keeps its last
        (1.0, 0.0, 0.25, 0.75, 0.25),
        (1.0, 1.0, 0.1, 0.2, 1.0),
        (0.0, 0.0, 0.3, 0.1, 0.0),
    ]
    before = 0.0
    for command_a, command_b, influence_a, influence_b, after in ticks:
        motors = hierarchy.evaluate(
            {"command A": command_a, "command B": command_b,
             "influence A": influence_a, "influence B": influence_b}
        )  # fmt: skip
        assert motors["seen"] == hierarchy.variables()["V"] == pytest.approx(before)
        before = after


def test_a_command_is_heard_in_the_next_tick():
    assert Writer(Variable("V")).run([0.25, 0.5, 1.0]) == [0.0, 0.25, 0.5]


def test_a_simple_variable_keeps_its_default_until_it_is_commanded():
    found = Writer(Variable("V", Simple(), 0.5)).run([0.9, 0.9, 0.1, 0.7], [0.0, 1.0, 0.0, 0.0])
    assert found == [0.5, 0.5, 0.9, 0.9]


def test_what_a_variable_presents_to_skills():
    writer = Writer(Variable("V", Simple(), 0.5))
    seen = []
    for command in (1.0, 0.25, 0.25, 0.75):
        writer.step(command)
        seen.append(tuple(writer.shown[name] for name in ("value", "change", "before")))
    # The value, 0.5 + its change / 2 (0.5 at the first tick), and the value two ticks before, which
    # is the first value until there is one.
    assert seen == [(0.5, 0.5, 0.5), (1.0, 0.75, 0.5), (0.25, 0.125, 0.5), (0.25, 0.5, 1.0)]


# Figure 4.7: a counter ---------------------------------------------------------------------------


def test_figure_4_7():
    """The first rising edge brings 0.1, the second 0.2, the falling edge resets to 0.0."""
    commands = [0.5, 0.9, 0.9, 0.6, 0.5, 0.95, 0.6, 0.3, 0.1, 0.1, 0.5]
    expected = [0.0, 0.0, 0.1, 0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.0, 0.0]
    assert Writer(Variable("V", Counter())).run(commands) == expected


def test_thresholds_of_a_counter_are_strict():
    # 0.8 is not above 0.8 and 0.2 not below 0.2; what rises from exactly 0.8 counts, what falls
    # from exactly 0.2 resets.
    found = Writer(Variable("V", Counter())).run([0.8, 0.81, 0.8, 0.9, 0.2, 0.19, 0.0])
    assert found == [0.0, 0.0, 0.1, 0.1, 0.2, 0.2, 0.0]


def test_a_counter_that_overflows_begins_again():
    found = Writer(Variable("V", Counter())).run([1.0, 0.5] * 12)
    assert found[1::2] == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 0.0, 0.1]
    small = Writer(Variable("V", Counter(1, 0.6, 0.4)))
    assert small.run([0.7, 0.5, 0.7, 0.5, 0.7, 0.3, 0.3]) == [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]


def test_a_counter_begins_at_its_default():
    writer = Writer(Variable("V", Counter(4), 0.75))
    assert writer.run([0.9, 0.5, 0.9, 0.5]) == [0.75, 1.0, 1.0, 0.0]


def test_a_counter_keeps_its_input():
    # Without influence the last command, 0.9, stays: what comes then is no edge.
    found = Writer(Variable("V", Counter())).run(
        [0.9, 0.0, 0.9, 0.0, 0.0], [1.0, 0.0, 1.0, 1.0, 1.0]
    )
    assert found == [0.0, 0.1, 0.1, 0.1, 0.0]


@given(
    st.lists(st.tuples(st.floats(0.0, 1.0), st.booleans()), min_size=1, max_size=12),
    st.integers(1, 3),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
)
@settings(max_examples=40)
def test_a_counter_counts_rising_edges_since_the_last_falling_one(given_now, maximum, one, two):
    low, high = sorted((one, two))
    writer = Writer(Variable("V", Counter(maximum, high, low)))
    commands, values = [0.0], []
    for command, influence in given_now:
        values.append(writer.step(command, float(influence)))
        commands.append(command if influence else commands[-1])
    for tick, value in enumerate(values):
        count = 0
        for before, after in pairwise(commands[: tick + 1]):
            count += before <= high < after
            count = 0 if before >= low > after else count
        assert value == count % (maximum + 1) / maximum


# Figure 4.8: a wave generator --------------------------------------------------------------------


def wave(phase):
    return 0.5 + math.sin(phase) / 2


def test_a_wave_that_nobody_commands_is_the_sine_of_the_tick():
    found = Writer(Variable("V", Wave())).run([0.0] * 20, [0.0] * 20)
    assert found == pytest.approx([wave(tick) for tick in range(1, 21)], abs=1e-12)


def test_figure_4_8():
    """The command sets how fast the phase grows: 0.001 to 3.0 a tick."""
    commands = [0.0, 0.0, 1.0, 0.2, 0.2, 0.5]
    steps = [1.0, 0.001, 0.001, 3.0, 0.6008, 0.6008]
    phases = [sum(steps[: tick + 1]) for tick in range(6)]
    found = Writer(Variable("V", Wave())).run(commands)
    assert found == pytest.approx([wave(phase) for phase in phases], abs=1e-12)


def test_a_wave_keeps_its_input():
    found = Writer(Variable("V", Wave())).run([0.2, 1.0, 1.0], [1.0, 0.0, 0.0])
    assert found == pytest.approx([wave(1.0), wave(1.6008), wave(2.2016)], abs=1e-12)


def test_a_wave_goes_on_for_long():
    writer = Writer(Variable("V", Wave()))
    for _ in range(3000):
        last = writer.step(1.0)
    assert last == pytest.approx(wave(1.0 + 2999 * 3.0), abs=1e-9)


# A modeller's own ------------------------------------------------------------------------------


def leaky(command, value):
    return value + 0.5 * (command - value)


def test_a_modeller_s_regulation_is_called_every_tick():
    found = Writer(Variable("V", Regulated(leaky), 0.5)).run([1.0, 0.0, 0.0], [1.0, 0.0, 1.0])
    assert found == [0.25, 0.625, 0.8125]  # the command before any is 0.0; then 1.0 is kept


def counted(command, memory, commanded):
    total = memory + 1.0 if commanded else memory
    return 3.0 * command - 1.0, total


def test_a_modeller_s_regulation_is_held_to_what_signals_are():
    writer = Writer(Variable("V", Regulated(counted)))
    assert writer.run([1.0, 0.5, 0.0, 0.0]) == [0.0, 1.0, 0.5, 0.0]


def remembering(memory, commanded):
    total = memory + 0.125 if commanded else memory
    return total, total


def test_a_modeller_s_regulation_has_a_memory_of_its_own():
    writer = Writer(Variable("V", Regulated(remembering)))
    assert writer.run([0.0] * 5, [1.0, 0.0, 1.0, 1.0, 1.0]) == [0.0, 0.125, 0.125, 0.25, 0.375]
    writer.hierarchy.reset()
    assert writer.run([0.0] * 2) == [0.0, 0.125]
