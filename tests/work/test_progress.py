"""Bars: drawn where somebody looks, and what they say."""

import io
import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from socialmind.work import progress
from socialmind.work.progress import progress_bar, progress_line


class Screen(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def screen(monkeypatch):
    """A terminal in place of stderr, on which every bar is drawn at once."""
    made = Screen()
    # Not that of `sys`, in whose place pytest puts its own before each test.
    monkeypatch.setattr(progress, "sys", SimpleNamespace(stderr=made, modules=sys.modules))
    monkeypatch.setattr(progress, "WAIT", 0.0)
    monkeypatch.setattr(progress, "INTERVAL", 0.0)
    return made


def test_a_bar_says_what_is_done_and_what_is_left(screen):
    with progress_bar(None, "runs", "sweep one") as tell:
        tell(0, 4)
        tell(3, 4)
        tell(3, 6)
    drawn = screen.getvalue().split("\r")
    assert any("3 of 4 runs |" in one and " 75 %, " in one for one in drawn)
    assert any("3 of 6 runs |" in one and " 50 %, " in one for one in drawn)
    assert all("runs/s" in one and "left" in one for one in drawn if " of " in one)
    assert drawn[-1].strip() == ""  # it is taken away


def test_a_line_shows_words(screen):
    with progress_line(None, "learn one", "learning") as tell:
        tell("generation 3, best 1.5", 3, 10)
    assert "generation 3, best 1.5" in screen.getvalue()


@pytest.mark.parametrize(("wanted", "seen"), [(None, False), (False, False), (True, True)])
def test_where_nobody_looks_it_is_shown_on_request_alone(monkeypatch, wanted, seen):
    log = io.StringIO()
    monkeypatch.setattr(sys, "stderr", log)
    monkeypatch.setattr(progress, "WAIT", 0.0)
    with progress_bar(wanted, "ticks", "run one") as tell:
        if tell is not None:
            tell(1, 2)
    assert (" of 2 ticks" in log.getvalue()) == seen


def test_a_caller_that_is_told_draws_its_own(screen):
    told = []
    with progress_bar(None, "ticks", "run one", lambda *news: told.append(news)) as tell:
        tell(1, 2)
    assert told == [(1, 2)] and screen.getvalue() == ""
    with progress_bar(True, "ticks", "run one", lambda *news: told.append(news)) as tell:
        tell(2, 2)
    assert told == [(1, 2), (2, 2)] and " of 2 ticks" in screen.getvalue()


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX's")
def test_a_command_shows_one_on_a_terminal(tmp_path):
    import pty

    ours, theirs = pty.openpty()
    words = ["run", "herds", "--interpreted", "--ticks", "500", "--out", str(tmp_path / "run")]
    command = [sys.executable, "-m", "socialmind", *words]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=theirs) as process:
        os.close(theirs)
        said = b""
        while True:
            try:
                piece = os.read(ours, 1 << 16)
            except OSError:  # the other end is closed
                break
            if not piece:
                break
            said += piece
    os.close(ours)
    assert process.returncode == 0
    assert b"of 500 ticks |" in said and b" ticks/s, " in said


def test_where_no_bar_is_wanted_those_who_are_called_draw_none_either(screen):
    outer = progress_bar(False, "runs", "sweep one")
    with outer as told, progress_bar(None, "runs", "sweep one", told) as inner:
        inner(1, 4)
        inner(4, 4)
    assert screen.getvalue() == ""
