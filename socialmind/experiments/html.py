"""Reports: one HTML file that holds all it shows, for a reader with nothing but a browser.

Figures are embedded as SVG, their type as outlines, so that they look everywhere as they were
drawn. The same content gives the same bytes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOTS = 200
"""Dots an inch of what stands in a figure as pixels."""
STYLE = """
:root { color-scheme: light; }
body { margin: 0; background: #fff; color: #222; font: 16px/1.55 Georgia, Times, serif; }
main { max-width: 60rem; margin: 0 auto; padding: 2.5rem 1.25rem 4rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.3rem; margin: 2.8rem 0 .5rem; padding-top: .7rem; border-top: 1px solid #ccc; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .3rem; }
p, ul { max-width: 44rem; }
.lead { font-size: 1.08rem; }
li { margin: .3rem 0; }
nav { font: 14px/1.7 system-ui, sans-serif; margin: 1.2rem 0 0; }
nav a { color: #2564ae; margin-right: 1.1em; text-decoration: none; white-space: nowrap; }
figure { margin: 1.6rem 0; }
figure img { display: block; height: auto; }
figcaption { font: 14px/1.45 system-ui, sans-serif; color: #444; }
figcaption { margin: .5rem 0; max-width: 50rem; }
.wide { overflow-x: auto; margin: 1.4rem 0; }
figure .wide { margin: 0; }
table { border-collapse: collapse; font: 13px/1.4 system-ui, sans-serif; }
th, td { padding: .28rem .7rem .28rem 0; text-align: left; vertical-align: top; }
thead th { border-bottom: 1px solid #222; vertical-align: bottom; }
tbody tr + tr td { border-top: 1px solid #e6e6e6; }
tbody tr:last-child td { border-bottom: 1px solid #222; }
.numbers { font-size: 11px; line-height: 1.3; }
.numbers td { white-space: nowrap; }
.numbers th, .numbers td { padding-right: .4rem; }
td { font-variant-numeric: tabular-nums; }
code { font: .88em ui-monospace, Menlo, Consolas, monospace; background: #f4f4f4; padding: 0 .2em; }
pre { overflow-x: auto; background: #f4f4f4; padding: .8rem 1rem; }
pre code { padding: 0; }
@media print { main { max-width: none; padding: 0; } nav { display: none; }
  .wide { overflow: visible; } .numbers { font-size: 7px; }
  figure, tr { break-inside: avoid; } }
""".strip()


def paragraph(text: str, lead: bool = False) -> str:
    """A paragraph; what stands between `backticks` is code, and lines stay as they are broken.

    A number and its per cent sign stay together.

    >>> paragraph("a < b in `f(x)`")
    '<p>a &lt; b in <code>f(x)</code></p>'
    """
    kind = ' class="lead"' if lead else ""
    return f"<p{kind}>{_inline(text)}</p>"


def bullets(texts: Iterable[str]) -> str:
    """A list, a point each."""
    return "<ul>\n" + "\n".join(f"<li>{_inline(one)}</li>" for one in texts) + "\n</ul>"


def code(text: str) -> str:
    """Lines of code, as they are."""
    return f"<pre><code>{escape(text)}</code></pre>"


def table(rows: Sequence[Mapping[str, object]], caption: str = "", numbers: bool = False) -> str:
    """A table.

    Args:
        rows: dictionaries with the same keys, which head the columns.
        caption: what stands above it.
        numbers: whether it is one of numbers, whose lines are not broken.

    >>> print(table([{"society": "fixed", "goods": 3}]))
    <div class="wide"><table>
    <thead><tr><th>society</th><th>goods</th></tr></thead>
    <tbody>
    <tr><td>fixed</td><td>3</td></tr>
    </tbody></table></div>
    """
    head = "".join(f"<th>{_inline(str(name))}</th>" for name in rows[0]) if rows else ""
    body = "\n".join(
        "<tr>" + "".join(f"<td>{_inline(str(cell))}</td>" for cell in row.values()) + "</tr>"
        for row in rows
    )
    kind = ' class="numbers"' if numbers else ""
    drawn = (
        f'<div class="wide"><table{kind}>\n<thead><tr>{head}</tr></thead>\n'
        f"<tbody>\n{body}\n</tbody></table></div>"
    )
    if not caption:
        return drawn
    # Beside the table, not in it: it is not moved aside with a broad one, nor as narrow as a small.
    return f"<figure><figcaption>{_inline(caption)}</figcaption>\n{drawn}</figure>"


def picture(figure: Figure, caption: str, alternative: str) -> str:
    """A figure with its caption.

    Args:
        figure: what is shown; one of a page's width is as wide as the page.
        caption: what stands below it.
        alternative: what is shown, in words, for those who do not see it.
    """
    import matplotlib as mpl

    file = io.BytesIO()
    # Names of a figure's parts are made of this salt, and random without.
    fixed: dict[Any, object] = {"svg.hashsalt": "socialmind", "svg.fonttype": "path"}
    with paper.style(), mpl.rc_context(fixed):
        figure.savefig(file, format="svg", dpi=DOTS, metadata={"Date": None, "Creator": None})
    wide = min(100.0, figure.get_size_inches()[0] * 25.4 / paper.PAGE * 100)
    content = compact(file.getvalue().decode("utf-8"))
    for mark, written in {"%": "%25", "#": "%23", '"': "'"}.items():
        content = content.replace(mark, written)
    return (
        f'<figure><img alt="{escape(alternative)}" style="width: {wide:.0f}%" '
        f'src="data:image/svg+xml,{content}">\n'
        f"<figcaption>{_inline(caption)}</figcaption></figure>"
    )


def compact(drawing: str) -> str:
    r"""Return an SVG of Matplotlib's without what nobody sees, such as parts of 1/100 point.

    Groups that say nothing are opened, names that parts are referred to by are short, those of
    others left out.

    Args:
        drawing: the SVG, whose type is outlines.

    >>> compact('<svg>\n <!-- a --> <g id="patch_1">\n  <path d="M 0.12345 7 \nL 12.3456 8"/></g>')
    '<svg><path d="M0.123 7L12.35 8"/>'
    """
    without = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>|<[?!][^>]*>", "", drawing, flags=re.S)
    rounded = re.sub(r"-?\d+\.\d{3,}", lambda found: _rounded(found[0]), without)
    spaced = re.sub(r"\s+", " ", re.sub(r">\s+<", "><", _briefly_named(rounded))).strip()
    paths = re.sub(r' d="[^"]*"', lambda found: re.sub(" ?([MLQCz]) ?", r"\1", found[0]), spaced)
    styles = re.sub(r' style="[^"]*"', lambda found: re.sub("([:;]) ", r"\1", found[0]), paths)
    return _without_empty_groups(styles)


def _briefly_named(drawing: str) -> str:
    """Return a drawing whose names are numbers, of those parts alone that are referred to."""
    used = dict.fromkeys(re.findall(r'(?:href="#|url\(#)([^")]+)', drawing))
    brief = {name: f"p{place}" for place, name in enumerate(used)}
    own = re.sub(
        r' id="([^"]*)"',
        lambda found: f' id="{brief[found[1]]}"' if found[1] in brief else "",
        drawing,
    )
    return re.sub(r'(href="#|url\(#)([^")]+)', lambda found: found[1] + brief[found[2]], own)


def _without_empty_groups(drawing: str) -> str:
    """Return a drawing without groups that have no attributes; what stands in them stays."""
    open_groups: list[bool] = []

    def kept(found: re.Match[str]) -> str:
        if found[0] != "</g>":
            open_groups.append(found[0] != "<g>")
            return found[0] if open_groups[-1] else ""
        return found[0] if open_groups.pop() else ""

    return re.sub(r"<g(?: [^>]*)?(?<!/)>|</g>", kept, drawing)


def _rounded(number: str) -> str:
    digits = 3 if number.lstrip("-")[0] == "0" else 2
    return f"{float(number):.{digits}f}".rstrip("0").rstrip(".")


def section(title: str, parts: Iterable[str], name: str = "") -> str:
    """A section under a heading.

    Args:
        title: the heading.
        parts: what stands below, as the other functions here give it.
        name: what the page's contents call it; sections without do not stand there.
    """
    place = f' id="{escape(name)}"' if name else ""
    return "\n".join((f"<section{place}>", f"<h2>{_inline(title)}</h2>", *parts, "</section>"))


def page(title: str, top: Iterable[str], sections: Sequence[str]) -> str:
    """The whole file.

    Args:
        title: of the report.
        top: what stands above the sections.
        sections: as `section` gives them.
    """
    links = [
        f'<a href="#{place}">{place.replace("-", " ")}</a>'
        for place in re.findall(r'^<section id="([^"]*)">', "\n".join(sections), re.MULTILINE)
    ]
    contents = f"<nav>{''.join(links)}</nav>" if links else ""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{STYLE}\n</style>\n</head>\n<body>\n<main>\n"
        f"<h1>{_inline(title)}</h1>\n"
        + "\n".join((*top, contents, *sections))
        + "\n</main>\n</body>\n</html>\n"
    )


def _inline(text: str) -> str:
    parts = re.split(r"`([^`]*)`", escape(text, quote=False))
    parts[::2] = [_set(one) for one in parts[::2]]
    parts[1::2] = [f"<code>{one}</code>" for one in parts[1::2]]
    return "".join(parts).replace("\n", "<br>")


def _set(text: str) -> str:
    """Return prose as a printer sets it: apostrophes, and what is not to be parted by a line's end.

    >>> _set("A : B is 1 : 2 in 90 % of an attempt's worlds")
    'A&nbsp;:&nbsp;B is 1&nbsp;:&nbsp;2 in 90&nbsp;% of an attempt’s worlds'
    """
    whole = re.sub(r"(?<=\d) %", "&nbsp;%", text)
    whole = re.sub(r"(?<=\w) : (?=\w)", "&nbsp;:&nbsp;", whole)
    return re.sub(r"(?<=\w)'", "’", whole)
