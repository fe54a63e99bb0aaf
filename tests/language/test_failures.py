"""What fails while a rule runs fails alike at both speeds: the same error, at the same line."""

import math

import pytest

FAILURES = {
    # the body of a rule: the error that Python would raise as well, where Python has one
    "person.f = 1 / person.x": ZeroDivisionError,
    "person.f = person.i / (person.i - person.i)": ZeroDivisionError,
    "person.i = 1 // (person.i - person.i)": ZeroDivisionError,
    "person.i = 1 % (person.i - person.i)": ZeroDivisionError,
    "person.f = 1.0 // person.x": ZeroDivisionError,
    "person.f = 1.0 % person.x": ZeroDivisionError,
    "person.f /= person.x": ZeroDivisionError,
    "person.f = person.x ** -1": ZeroDivisionError,
    "person.f = person.x ** -0.5": ZeroDivisionError,
    "person.f = math.log(person.x)": ValueError,
    "person.f = math.log(-1 - person.x)": ValueError,
    "person.f = math.log10(person.x)": ValueError,
    "person.f = math.log2(person.x)": ValueError,
    "person.f = math.sqrt(person.x - 1)": ValueError,
    "person.f = math.asin(person.x + 2)": ValueError,
    "person.f = math.acos(person.x - 2)": ValueError,
    "person.f = math.sin(person.x + math.inf)": ValueError,
    "person.f = math.cos(person.x + math.inf)": ValueError,
    "person.f = math.tan(person.x - math.inf)": ValueError,
    "person.f = (person.x - 2) ** 0.3": ValueError,
    "person.f = (person.x - 2) ** 0.5": ValueError,
    "person.f = math.exp(person.x + 710)": OverflowError,
    "person.f = (person.x + 10.0) ** 400.5": OverflowError,
    "person.f = (person.x + 1e200) ** (person.x + 2)": OverflowError,
    "person.i = int(person.x + math.nan)": ValueError,
    "person.i = round(person.x + math.nan)": ValueError,
    "person.i = int(person.x + math.inf)": OverflowError,
    "person.i = int(person.x + 1e19)": OverflowError,
    "person.i = math.floor(person.x - 1e19)": OverflowError,
    "person.i = math.ceil(person.x + math.inf)": OverflowError,
    "person.i = 2 ** 62 + 2 ** 62 + person.i": OverflowError,
    "person.i = 9_223_372_036_854_775_807 + (person.i - person.i + 1)": OverflowError,
    "person.i = -9_223_372_036_854_775_807 - (person.i - person.i + 2)": OverflowError,
    "person.i = 4_000_000_000 * (person.i - person.i + 4_000_000_000)": OverflowError,
    "person.i = 9007199254740993 * (person.i - person.i + 1024)": OverflowError,
    "person.i = 10 ** (person.i - person.i + 19)": OverflowError,
    "person.i = 2 ** (person.i - person.i - 1)": ValueError,
    "person.i = sum(person.vi) * 2 ** 61 * 99": OverflowError,
    "person.i = min(h.rooms for h in model.houses if h.rooms > 99)": ValueError,
    "person.f = statistics.fmean(h.rent for h in model.houses if h.rooms > 99)": ValueError,
    "person.i = sum(2 ** 62 for h in model.houses)": OverflowError,
    "for k in range(3, 9, person.i - person.i):\n        person.f += k": ValueError,
    "person.f = person.vf[4 + person.i - person.i]": IndexError,
    "person.vf[-5 + person.i - person.i] = 1": IndexError,
    "person.vi[person.i - person.i + 5] += 1": IndexError,
    "person.oi = None\n    person.i = person.oi": ValueError,
    "person.oi = None\n    person.oi += 1": ValueError,
    "person.of = None\n    person.f = 1 + person.of": ValueError,
    "person.of = None\n    person.b = person.of < 3": ValueError,
    "person.ob = None\n    person.b = person.ob": ValueError,
    "model.last = None\n    model.count = model.last": ValueError,
    "here = model.world.patch(0, 0)\n    here.owner = None\n    person.i = here.owner": ValueError,
    "person.small = 32_000 + person.small + 900": OverflowError,
    "person.small = 0\n    person.small -= 32_769": OverflowError,
    "person.tiny = 128": OverflowError,
    "model.world.patch(0, 0).visits = 40_000": OverflowError,
    "model.persons[99].f = 1": IndexError,
    "model.persons[-1].f = 1": IndexError,
    "model.houses[0].die()\n    model.houses[0].rent = 1": IndexError,
    "for h in model.houses:\n        h.die()\n    model.houses.one_of(rng).rent = 1": ValueError,
    "person.die()\n    person.hatch()": ValueError,
    "person.die()\n    person.f = person.mind.get_cogniton_value('Hunger')": Exception,
    "person.mind.set_cogniton_value('Hunger', math.nan)": Exception,
    "person.mind.add_to_cogniton_value('Hunger', math.inf)": Exception,
    "person.mind.feed_back_from_plan('grow', math.inf)": Exception,
    "person.plan = None\n    person.mind.feed_back_from_plan(person.plan, 1)": Exception,
    "person.mind.join_group('Family', 'Child', 99)": Exception,
    "person.i = rng.integers(0)": ValueError,
    "person.i = rng.integers(5, 5)": ValueError,
    "person.i = rng.integers(-2 ** 62, 2 ** 62)": ValueError,
    "person.f = rng.normal(0, -1)": ValueError,
    "person.f = rng.exponential(-1)": ValueError,
    "person.i = rng.poisson(-1)": ValueError,
    "person.i = rng.poisson(person.x + math.nan)": ValueError,
    "person.f = rng.gamma(0, 1)": ValueError,
    "person.f = rng.gamma(1, person.x - 1)": ValueError,
    "person.i = rng.choice((1, 2), p=(0, 0))": ValueError,
    "person.vf[0] = -1\n    person.f = rng.choice(person.vf, p=person.vf)": ValueError,
    "person.i = rng.choice(person.i - person.i)": ValueError,
    "for k in rng.permutation(person.i - person.i - 1):\n        person.f += k": ValueError,
    "person.i = (1, 2, 3)[person.i - person.i + 3]": IndexError,
    "person.f = (1.5, 2)[person.i - person.i - 3]": IndexError,
    "model.world.patch(person.x + math.nan, 0).grass = 1": ValueError,
    "model.world.move_to(person, math.inf, 0)": Exception,
    "for p in model.world.in_radius(person, math.inf):\n        p.grass = 1": ValueError,
}


@pytest.fixture(scope="module")
def failing(society, speeds, tmp_path_factory):
    """Make the model of which each case of the parameter `case` fails in tick 3."""
    lines = ["import math", "import statistics", "", ""]
    for place, body in enumerate(FAILURES):
        lines += [f"def fail_{place}(person, model, rng):", f"    {body}", ""]
    lines += ["", "def at(person, model, rng):", "    person.x = 0.0"]
    lines += ["    if model.tick == 3 and person.id == 2:"]
    for place in range(len(FAILURES)):
        lines += [
            f"        if model.case == {place}:",
            f"            fail_{place}(person, model, rng)",
        ]
    file = tmp_path_factory.mktemp("failing") / "failing.py"
    file.write_text("\n".join(lines) + "\n")
    persons = society.Society.persons
    schedule = (society.each(persons, society.begin), society.each(persons, speeds.load(file).at))
    return type("Failing", (society.Society,), {"schedule": schedule}), file


@pytest.mark.parametrize("body", FAILURES)
def test_failures_are_alike(body, failing, speeds):
    cls, file = failing
    case = list(FAILURES).index(body)
    messages = []
    for compiled in (True, False):
        model = speeds.watched(cls(7, compiled=compiled, case=case))
        model.advance(3)
        with pytest.raises(Exception) as caught:
            model.advance(2)
        error = caught.value
        messages.append((type(error), str(error)))
        cause = error.__cause__ or error
        assert isinstance(cause, FAILURES[body]), repr(cause)
        assert model.tick == 3
        assert len(model._met) == compiled
        if compiled:
            assert str(file) in str(error)
            broken = model
    assert messages[0] == messages[1]
    assert not speeds.differences(broken, model)


def test_python_fails_where_rules_do():
    """The expressions that Python refuses as well, with the same kind of error."""
    person = type("Person", (), {"x": 0.0, "i": 4, "f": 1.5})()
    for body, kind in FAILURES.items():
        expression = body.partition(" = ")[2]
        if not expression.startswith(("1 /", "math.", "1 //", "1 %", "1.0", "int(", "round(")):
            continue
        if "1e19" in expression:
            continue  # whole numbers grow in Python
        with pytest.raises(kind):
            eval(expression, {"math": math, "person": person})
