"""Terminals without Unicode, paths with blanks, and whole numbers of the command line."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
import typer

from socialmind.commands.console.terminal import plain, quoted
from socialmind.commands.console.whole_option import LARGEST, LARGEST_SEED, whole

CHECKOUT = Path(__file__).parents[2]
LATIN = {"PYTHONIOENCODING": "latin-1"}
ASCII = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"}
TURKISH = {"LC_ALL": "tr_TR.UTF-8", "PYTHONUTF8": "0"}


def ended(words, environment, folder):
    """Run the program itself, and give its exit code, what it wrote and its errors, as bytes."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("LC_", "LANG", "PYTHON"))}
    done = subprocess.run(
        [sys.executable, "-m", "socialmind.cli", *words],
        env={**kept, "PYTHONPATH": str(CHECKOUT), **environment},
        cwd=folder,
        capture_output=True,
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("environment", [LATIN, ASCII], ids=["latin", "ascii"])
def test_what_a_terminal_lacks_is_written_in_what_it_has(environment, tmp_path):
    code, out, err = ended(["list", "farmer_artisan"], environment, tmp_path)
    assert (code, err) == (0, b"")
    assert b"share a decision      0 ... 1" in out
    assert out.isascii() or environment is LATIN
    code, out, err = ended(["run", "tutorial", "--ticks", "1.5"], environment, tmp_path)
    assert (code, out) == (2, b"")
    assert b"found '1.5'; expected a whole number, 0 ... 2**63 - 1" in err
    code, out, err = ended(["list", "s\u00f8st\u2026"], environment, tmp_path)
    assert (code, out) == (2, b"")
    assert b"Traceback" not in err


def test_a_turkish_locale(tmp_path):
    code, out, err = ended(["list", "tutorial"], TURKISH, tmp_path)
    assert (code, err) == (0, b"")
    assert "1 or more" in out.decode()


def shell(line, folder):
    """Run a line of a shell in which `socialmind` stands for the program; gives code and errors."""
    program = f'socialmind() {{ "{sys.executable}" -m socialmind.cli "$@"; }}; {line}'
    environment = {**os.environ, "PYTHONPATH": str(CHECKOUT)}
    done = subprocess.run(
        ["bash", "-c", program], cwd=folder, env=environment, capture_output=True, text=True
    )
    return done.returncode, done.stderr


def test_streams_that_are_closed(tmp_path):
    assert shell("socialmind new a >&-", tmp_path) == (0, "")
    assert shell("socialmind new b <&- >&- 2>&-", tmp_path) == (0, "")
    assert shell("socialmind new a >&- 2>&-", tmp_path) == (2, "")
    template = CHECKOUT / "socialmind" / "template"
    for file in template.glob("*.*"):  # not one of them took the output's number
        assert (tmp_path / "b" / file.name).read_bytes() == file.read_bytes()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_output_that_nobody_takes(tmp_path):
    assert shell("socialmind --version >/dev/full", tmp_path) == (
        2,
        "socialmind: No space left on device\n",
    )
    assert shell("socialmind new a >/dev/full", tmp_path)[0] == 2
    gone = "socialmind new {} 2>&1 | true; exit ${{PIPESTATUS[0]}}"
    assert shell(gone.format("b"), tmp_path) == (141, "")
    assert shell(gone.format("a"), tmp_path) == (141, "")  # what is wrong is said to nobody


def test_characters_and_what_stands_for_them():
    assert plain("1 … 5 × 10⁶ – Suró") == "1 ... 5 x 106 - Suro"
    assert plain("雪") == "?"


def test_paths_are_quoted_for_a_shell(socialmind, tmp_path):
    assert quoted("runs/one") == "runs/one"
    assert quoted("-run") == "./-run"
    for name in ("my model", "it's", "a$b", "-m"):
        said = socialmind("new", "--", name).stdout.partition("`")[2].rpartition("`")[0]
        command, verb, path = shlex.split(said)
        assert (command, verb) == ("socialmind", "run")
        assert (tmp_path / path / "model.py").is_file()


@pytest.mark.parametrize(
    ("text", "number"),
    [("100", 100), ("1e5", 100_000), ("1_000_000", 1_000_000), ("2.5e1", 25), ("0", 0), (" 7 ", 7)],
)
def test_whole_numbers(text, number):
    assert whole(0)(text) == number


@pytest.mark.parametrize(
    "text",
    ["1.5", "1e400", "-1e400", "1e-3", "9" * 401, "9" * 5000, "-3", "many", "", "nan", "inf"],
)
def test_what_is_no_whole_number(text):
    with pytest.raises(typer.BadParameter) as caught:
        whole(0)(text)
    assert caught.value.message.endswith("; expected a whole number, 0 … 2**63 - 1")
    assert len(caught.value.message) < 140
    with pytest.raises(typer.BadParameter, match="1 … 2"):
        whole(1)("0")
    assert whole(0)(str(LARGEST)) == LARGEST
    assert whole(0, LARGEST_SEED)(str(LARGEST_SEED)) == LARGEST_SEED


@pytest.mark.parametrize(
    "words",
    [
        ("run", "tutorial", "--ticks"),
        ("run", "tutorial", "--every"),
        ("run", "tutorial", "--agents-every"),
        ("run", "tutorial", "--seed"),
        ("learn", "tutorial", "--generations"),
        ("learn", "tutorial", "--ticks-budget"),
        ("score", "tutorial", "--episodes"),
        ("render", "somewhere", "--out", "x.svg", "--tick"),
        ("explain", "somewhere", "--tick", "1", "--agent"),
    ],
)
def test_every_option_that_is_a_whole_number(words, socialmind):
    for text in ("1.5", "1e400", "-2"):
        result = socialmind(*words, text)
        assert result.exit_code == 2
        last = result.stderr.splitlines()[-1]
        assert f"Invalid value for '{words[-1]}': found '{text}'" in last
    assert "Invalid value" not in socialmind(*words, "1e1").stderr


def test_a_run_of_so_many_ticks(socialmind, grazers, tmp_path):
    words = ("--ticks", "1e1", "--every", "1_0", "--interpreted", "--quiet", "--out", "run")
    result = socialmind("run", grazers, *words)
    assert result.exit_code == 0, result.output
    from socialmind.experiments import Run

    assert list(Run(tmp_path / "run").series["tick"]) == [0, 10]
