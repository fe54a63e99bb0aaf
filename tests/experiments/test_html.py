"""Reports: HTML that holds all it shows."""

import re
import xml.etree.ElementTree as tree
from urllib.parse import unquote

from socialmind.drawing import style as paper
from socialmind.experiments import html as report

SVG = "{http://www.w3.org/2000/svg}"


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
        r'<img alt="a line" style="width: 33%" src="data:image/svg\+xml,([^"]+)">', page
    )
    assert source is not None
    drawn = tree.fromstring(unquote(source[1]))
    assert drawn.tag == f"{SVG}svg"
    assert list(drawn.iter(f"{SVG}path")) and not list(drawn.iter(f"{SVG}text"))  # type is outlines
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)
    assert "<script" not in page
    assert "<link" not in page
    assert "a &amp; b" in page
    assert '<a href="#first">first</a>' in page
    assert '<section id="first">' in page


def test_the_same_figure_gives_the_same_bytes():
    assert report.picture(figure(), "", "") == report.picture(figure(), "", "")


def test_what_a_figure_refers_to_is_kept_in_it():
    source = re.search(r"data:image/svg\+xml,([^\"]+)", report.picture(figure(), "", ""))
    drawn = tree.fromstring(unquote(source[1]))
    names = {part.get("id") for part in drawn.iter()} - {None}
    used = {part.get("{http://www.w3.org/1999/xlink}href")[1:] for part in drawn.iter(f"{SVG}use")}
    clipped = re.findall(r"url\(#([^)]+)\)", unquote(source[1]))
    assert used | set(clipped) == names


def test_what_is_seen_of_a_figure_stays_in_it():
    drawing = (
        '<svg><defs><path id="m123abc" d="M 0 0 \nL 1 1 "/></defs><g id="figure_1"><g><g class="a">'
        '<use xlink:href="#m123abc" style="fill: #222; stroke: none"/></g></g></g><g class="b"/>'
        '<path id="line2d_7" clip-path="url(#p9)" d="M 2 2"/><clipPath id="p9"/></svg>'
    )
    assert report.compact(drawing) == (
        '<svg><defs><path id="p0" d="M0 0L1 1 "/></defs><g class="a">'
        '<use xlink:href="#p0" style="fill:#222;stroke:none"/></g><g class="b"/>'
        '<path clip-path="url(#p1)" d="M2 2"/><clipPath id="p1"/></svg>'
    )


def test_what_stands_in_a_table_is_escaped_and_broken_into_lines():
    found = report.table([{"<a>": "1 < 2\n(3)"}], "`code`")
    assert "<th>&lt;a&gt;</th>" in found
    assert "<td>1 &lt; 2<br>(3)</td>" in found
    assert "<figcaption><code>code</code></figcaption>" in found


def test_matplotlib_is_left_as_it_was():
    import matplotlib as mpl

    before = dict(mpl.rcParams)
    report.picture(figure(), "", "")
    assert dict(mpl.rcParams) == before
