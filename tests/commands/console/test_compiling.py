"""What is said while a command compiles."""

import numba

from coglogo_py.compiled.code_folder import CACHE_VARIABLE
from socialmind.commands.console.stopping import what_memory_lacked
from socialmind.work import compile_times as compiling


def test_compiling_is_said_and_its_time_remembered(tmp_path, monkeypatch):
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path))
    monkeypatch.setattr(compiling, "WORTH_SAYING", 0.0)
    inner = numba.njit(lambda x: x + 1)
    outer = numba.njit(lambda x: inner(x) + 1)
    said = []
    with compiling.told_of_compiling("run one", said.append):
        assert outer(1) == 3
    assert said == ["compiling once, usually 10 to 60 s", ""]
    assert compiling.usual_time("run one") in ("1 s", "2 s", "3 s", "4 s", "5 s")
    assert compiling.usual_time("run another") == compiling.TYPICAL


def test_little_memory_is_one_line_with_what_was_needed():
    said = what_memory_lacked(MemoryError("Unable to allocate 7.45 GiB for an array"))
    assert said.startswith("not enough memory: Unable to allocate 7.45 GiB")
    assert "\n" not in said
    assert what_memory_lacked(MemoryError()).startswith("not enough memory; this program had ")
