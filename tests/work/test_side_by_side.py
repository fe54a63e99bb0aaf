"""Calls in other processes."""

import itertools
import os
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file
from socialmind.work.side_by_side import side_by_side


@pytest.fixture
def study(tmp_path: Path):
    path = tmp_path / "study.py"
    path.write_text(
        '"""A study."""\n\nimport os\n\n\n'
        "def doubled(number):\n    return 2 * number, os.getpid()\n\n\n"
        "def refused(number):\n    raise ValueError(number)\n"
    )
    return load_file(path)


def test_a_file_s_function_is_called_elsewhere_in_order(study):
    found = list(side_by_side(study.doubled, [(n,) for n in range(9)], workers=2))
    assert [number for number, _ in found] == list(range(0, 18, 2))
    assert os.getpid() not in {process for _, process in found}


def test_one_worker_is_this_process(study):
    assert list(side_by_side(study.doubled, [(3,)], workers=1)) == [(6, os.getpid())]
    assert list(side_by_side(study.doubled, [], workers=2)) == []


def test_a_failure_is_raised_here(study):
    with pytest.raises(ValueError, match=r"5|6"):  # whichever fails first
        list(side_by_side(study.refused, [(5,), (6,)], workers=2))


def test_calls_without_end_go_to_processes_several_at_once(study):
    calls = ((number,) for number in itertools.count())
    found = side_by_side(study.doubled, calls, workers=2, together=5)
    results = list(itertools.islice(found, 12))
    found.close()
    assert [number for number, _ in results] == list(range(0, 24, 2))
    assert len({process for _, process in results[:5]}) == 1
    assert next(calls)[0] < 100
