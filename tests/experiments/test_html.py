"""Reports: HTML that holds all it shows."""

import base64
import re

from socialmind.drawing import style as paper
from socialmind.experiments import html as report


def figure():
    with paper.style():
        drawn = paper.figure(60, 40)
        axes = drawn.subplots()
        axes.plot([0, 1, 2], [0, 1, 0])
        axes.fill_between([0, 1], [0, 0], [1, 1])
    return drawn


def test_a_page_holds_its_figures_and_asks_for_nothing():
    parts = [report.paragraph("a & b"), report.picture(figure(), "Figure 1. A line.", "a line")]
    page = report.page("A title", [], [report.section("First", parts, "first")])
    source = re.search(
        r'<img alt="a line" style="width: 33%" src="data:image/svg\+xml;base64,([^"]+)">', page
    )
    assert source is not None
    drawn = base64.b64decode(source[1]).decode()
    assert drawn.startswith("<?xml")
    assert "<text" not in drawn  # type is outlines
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)
    assert "<script" not in page
    assert "<link" not in page
    assert "a &amp; b" in page
    assert '<a href="#first">first</a>' in page
    assert '<section id="first">' in page


def test_the_same_figure_gives_the_same_bytes():
    assert report.picture(figure(), "", "") == report.picture(figure(), "", "")


def test_what_stands_in_a_table_is_escaped_and_broken_into_lines():
    found = report.table([{"<a>": "1 < 2\n(3)"}], "`code`")
    assert "<th>&lt;a&gt;</th>" in found
    assert "<td>1 &lt; 2<br>(3)</td>" in found
    assert "<caption><code>code</code></caption>" in found


def test_matplotlib_is_left_as_it_was():
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    report.picture(figure(), "", "")
    assert dict(mpl.rcParams) == before
