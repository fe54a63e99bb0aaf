"""Follows a page as its reader does: writes its files, gives its commands, runs its code.

A block with a title is a file, one of `sh` holds commands, one of `python` code that goes on from
the code before, and one of `text` after commands is what the last of them says.
"""

import re
import shlex
import shutil
from pathlib import Path

from typer.testing import CliRunner

from socialmind.cli import app

DOCS = Path(__file__).parents[1]
BLOCK = re.compile(r"^```(\w+)(?: title=\"([^\"]+)\")?[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def follow(page, shorter=None, ignored="$^"):
    """Do in the current folder what a page of docs/ tells its reader to do.

    Args:
        page: the page's path in docs/.
        shorter: a function that takes the words of a command and returns those to be given in their
            place, so that it takes less time.
        ignored: lines that a command given in fewer words need not say, as a regular expression.

    Returns:
        The names that the page's code made, and what each command said.
    """
    names, said = {"__name__": "__main__"}, {}
    last = ""
    for kind, title, text in BLOCK.findall((DOCS / page).read_text("utf-8")):
        if title:
            Path(title).parent.mkdir(parents=True, exist_ok=True)
            Path(title).write_text(text, "utf-8")
        elif kind == "sh":
            for line in text.splitlines():
                said[line] = last = give(shlex.split(line, comments=True), shorter)
        elif kind == "python":
            exec(compile(text, page, "exec"), names)
        elif kind == "text":
            told = squeezed(last)
            missing = [
                line
                for line in text.splitlines()
                if not re.match(ignored, line) and squeezed(line) not in told
            ]
            assert missing == [], (page, missing, last)
    return names, said


def give(words, shorter):
    """Give one command, and return what it says."""
    if words[0] == "cp":
        assert words[1] == "-r"
        shutil.copytree(words[2], words[3])
        return ""
    program, *words = words if shorter is None else shorter(words)
    assert program == "socialmind", words
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, (words, result.output, result.exception)
    return result.output


def squeezed(text):
    """Return a text with single blanks."""
    return " ".join(text.split())
