"""What is optimised once comes to the same, and is whole for callers that numba optimises."""

import numba
import pytest
from numba.core.registry import cpu_target

from coglogo_py.compiled.machine_code import kept

inner = numba.njit(no_cpython_wrapper=True, no_cfunc_wrapper=True)


@inner
def deepest(n):
    total = 0
    for one in range(n):
        if one % 7 == 3:
            raise ValueError("seven and three")
        total += one * one
    return total


@inner
def never_called(n):
    return deepest(n) + 1


@inner
def one_way(n):
    return never_called(n) if n < -5 else n


@inner
def other_way(n):
    return deepest(n) * 2


def called(n):
    return one_way(n) + other_way(n)


def kept_as(key):
    return kept(key)(called)


def test_what_functions_share_is_there_for_all_of_them(tmp_path, monkeypatch):
    monkeypatch.setenv("SOCIALMIND_CACHE_DIR", str(tmp_path / "cache"))
    before = cpu_target.target_context.codegen()._library_class
    first = kept_as("once")(3)
    again = kept_as("once")
    assert first == again(3) == 3 + 2 * 5
    assert again(-9) == 1 and again(-1) == -1
    with pytest.raises(ValueError, match="seven and three"):
        again(5)
    assert cpu_target.target_context.codegen()._library_class is before


def test_a_numba_that_was_not_tried_does_as_it_does(tmp_path, monkeypatch):
    monkeypatch.setattr("coglogo_py.compiled.optimised_once.TRIED", ())
    monkeypatch.setenv("SOCIALMIND_CACHE_DIR", str(tmp_path / "cache"))
    assert kept_as("plain")(3) == 13


def test_functions_that_waited_are_whole_for_numbas_own_callers(tmp_path, monkeypatch):
    monkeypatch.setenv("SOCIALMIND_CACHE_DIR", str(tmp_path / "cache"))
    assert kept_as("whole")(2) == 4

    @numba.njit
    def asked(n):
        return other_way(n) + never_called(n)

    assert asked(3) == 2 * 5 + 6
