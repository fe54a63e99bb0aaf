"""The page on runs names what is recorded."""

import re
from pathlib import Path

from socialmind.worlds.plane.trajectories import RECORDED

PAGE = (Path(__file__).parents[2] / "docs" / "runs.md").read_text("utf-8")


def test_the_columns_of_robots_are_those_that_runs_record():
    table = PAGE.split("| column of robots |", 1)[1].split("\n\n", 1)[0]
    named = [re.findall(r"`(\w+)`", line.split("|")[1]) for line in table.splitlines()[2:]]
    assert [one for names in named for one in names] == list(RECORDED)
