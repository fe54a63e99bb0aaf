"""Markdown: tables read and written, and pages of it as one HTML file."""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Sequence
from pathlib import Path

Row = Sequence[str]

_BORDER = re.compile(r"(?<!\\)\|")
_PICTURE = re.compile(r'<img src="([^":]+\.png)"')
_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
body {{ font: 16px/1.5 Georgia, serif; max-width: 52em; margin: 2em auto; padding: 0 1em;
       color: #222; }}
h1, h2, h3, h4 {{ font-family: Helvetica, Arial, sans-serif; line-height: 1.2; margin-top: 1.6em; }}
table {{ border-collapse: collapse; font-size: 0.85em; margin: 1em 0; }}
th, td {{ border-bottom: 1px solid #ccc; padding: 0.25em 0.7em; text-align: left;
         vertical-align: top; }}
th {{ border-bottom: 2px solid #555; }}
code {{ font-size: 0.92em; }}
img {{ max-width: 100%; }}
</style>
<body>
{body}</body>
</html>
"""


def table(header: Row, rows: Sequence[Row], keep: Sequence[str] = ()) -> str:
    r"""Return a table; columns in which nothing stands are left out.

    Args:
        header: the names of the columns.
        rows: as long as the header.
        keep: columns that stay, even if nothing stands in them.

    >>> print(table(("name", "unit", "note"), [("wheat", "|kg|", "")]))
    | name | unit |
    |---|---|
    | wheat | \|kg\| |
    """
    used = [
        column
        for column, name in enumerate(header)
        if name in keep or any(row[column] for row in rows)
    ]
    lines = [_line([header[column] for column in used]), "|" + "---|" * len(used)]
    return "\n".join([*lines, *(_line([row[column] for column in used]) for row in rows)])


def _line(cells: Row) -> str:
    escaped = (re.sub(r"\s+", " ", _BORDER.sub(r"\\|", cell)) for cell in cells)
    return "|" + "|".join(f" {cell} " if cell else " " for cell in escaped) + "|"


def tables_in(text: str) -> list[tuple[int, int, list[list[str]]]]:
    r"""Return the tables of a text: first line, line behind the last, and the cells, header first.

    >>> tables_in("One:\n\n| a | b |\n|---|---|\n| 1 | x \\| y |\n")
    [(2, 5, [['a', 'b'], ['1', 'x | y']])]
    """
    lines = text.splitlines()
    found: list[tuple[int, int, list[list[str]]]] = []
    begin = 0
    while begin < len(lines):
        end = begin
        while end < len(lines) and lines[end].startswith("|"):
            end += 1
        if end - begin > 1 and set(lines[begin + 1]) <= set("|-: "):
            rows = [lines[begin], *lines[begin + 2 : end]]
            found.append((begin, end, [_cells(row) for row in rows]))
        begin = max(end, begin + 1)
    return found


def _cells(line: str) -> list[str]:
    inner = line.strip().removeprefix("|")
    parts = _BORDER.split(inner)
    if not parts[-1].strip():
        parts.pop()
    return [part.strip().replace("\\|", "|") for part in parts]


def html_page(text: str, title: str, folder: Path) -> str:
    """Return Markdown as an HTML page that needs no other file.

    Args:
        text: the Markdown.
        title: of the page.
        folder: where the pictures stand that it names.
    """
    from markdown_it import MarkdownIt

    body = MarkdownIt("commonmark", {"html": True}).enable("table").render(text)

    def embedded(match: re.Match[str]) -> str:
        content = base64.b64encode((folder / html.unescape(match[1])).read_bytes()).decode("ascii")
        return f'<img src="data:image/png;base64,{content}"'

    return _PAGE.format(title=html.escape(title), body=_PICTURE.sub(embedded, body))
