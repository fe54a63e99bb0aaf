"""Examples in docstrings as code: what begins with >>> and what it prints."""

import re

import griffe

EXAMPLE = re.compile(r"^( *)>>> .*(?:\n\1(?=\S| +\S).*)*", re.MULTILINE)


class Examples(griffe.Extension):
    """Puts the examples of all docstrings into blocks of code, which Markdown leaves alone."""

    def on_object(self, *, obj: griffe.Object, **_: object) -> None:
        """Rewrite one docstring.

        Args:
            obj: A module, class, function or attribute that was read.
        """
        if obj.docstring is not None:
            obj.docstring.value = EXAMPLE.sub(fenced, obj.docstring.value)


def fenced(found: re.Match) -> str:
    """Return an example as a block of code.

    Args:
        found: The example, up to the next empty line.
    """
    blanks = found[1]
    return f"{blanks}```pycon\n{found[0]}\n{blanks}```"
