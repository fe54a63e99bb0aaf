"""Syntax trees from many threads at once."""

import ast
import gc
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from socialmind.language.syntax import compiled, parsed

TEXT = ("x = " + "(" * 60 + "1" + " + 1)" * 60 + "\n") * 3


def gives_way(phase, info):
    """Let other threads go on, as a collection of garbage in the middle of a tree may."""
    time.sleep(0)


@pytest.fixture
def threads_that_give_way():
    often = gc.get_threshold()
    gc.callbacks.append(gives_way)
    gc.set_threshold(50)
    yield
    gc.set_threshold(*often)
    gc.callbacks.remove(gives_way)


def test_threads_may_parse_and_compile_at_once(threads_that_give_way):
    with ThreadPoolExecutor(4) as threads:
        codes = list(threads.map(lambda _: compiled(parsed(TEXT), "here"), range(48)))
    found = {}
    exec(codes[-1], found)
    assert found["x"] == 61
    assert {code.co_filename for code in codes} == {"here"}


def test_an_expression_is_parsed_as_one():
    assert isinstance(parsed("1 + 2", "eval"), ast.Expression)
