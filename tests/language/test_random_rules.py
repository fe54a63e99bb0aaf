"""Random rules leave the same society behind at both speeds, or fail alike.

One seed stays, the other comes with the day, so that in time many rules are tried; a failure names
its seed. `RANDOM_RULES=first:count` tries a range of seeds, as a longer campaign does.
"""

import datetime
import os
from pathlib import Path

import pytest

RULES = 16
FIXED = 11


def seeds():
    """Return the seeds that are tried: a fixed one and the day's, or those that were asked for."""
    asked = os.environ.get("RANDOM_RULES")
    if asked:
        first, count = map(int, asked.split(":"))
        return list(range(first, first + count))
    return [FIXED, datetime.datetime.now(datetime.UTC).date().toordinal()]


@pytest.mark.parametrize("seed", seeds())
def test_random_rules_run_alike(seed, society, speeds, tmp_path):
    author = speeds.load(Path(__file__).parent / "random_rules.py")
    file = tmp_path / "random_model.py"
    file.write_text(author.module_text(seed, RULES))
    persons = society.Society.persons
    schedule = (society.each(persons, society.begin), society.each(persons, speeds.load(file).at))
    cls = type("Random", (society.Society,), {"schedule": schedule})
    finished = 0
    for case in range(RULES):
        outcomes = []
        for compiled in (True, False):
            model = speeds.watched(cls(3, compiled=compiled, case=case))
            try:
                model.advance(3)
                outcomes.append((model, None))
            except Exception as error:
                outcomes.append((model, f"{type(error.__cause__).__name__}: {error}"))
        (one, failed), (other, failed_too) = outcomes
        assert failed == failed_too
        assert not speeds.differences(one, other), f"rule {case}"
        if failed is None:
            finished += 1
            assert one._met == []  # compiled code did not ask the interpreted speed
    assert finished > RULES / 3
