"""Where nodes are placed: layers, neighbours' distances, links that go round what lies between."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.mind.views.layering import SPACE, Box, _spread, layered, layers_of

SQUARE = Box(3.0, 2.0)


def placed(names, links, widest=100.0):
    return layered(dict.fromkeys(names, SQUARE), links, layers_of(names, links), widest)


def test_the_longest_path_decides_on_the_layer():
    links = [("a", "b"), ("a", "d"), ("b", "c"), ("c", "d"), ("a", "e")]
    assert layers_of("abcde", links) == {"a": 0, "b": 1, "c": 2, "d": 3, "e": 1}


def test_a_parent_stands_over_the_middle_of_its_children():
    boxes = placed("abcd", [("a", "b"), ("a", "c"), ("a", "d")]).boxes
    children = sorted(boxes[name].x for name in "bcd")
    assert boxes["a"].x == pytest.approx(children[1])
    assert [right - left for left, right in pairwise(children)] == pytest.approx([3.0 + SPACE] * 2)
    assert len({boxes[name].y for name in "bcd"}) == 1


def test_a_wide_layer_is_spread_over_rows():
    names = ["a", *map(str, range(12))]
    links = [("a", name) for name in names[1:]]
    wide, narrow = placed(names, links), placed(names, links, widest=20.0)
    assert len({wide.boxes[name].y for name in names[1:]}) == 1
    assert len({narrow.boxes[name].y for name in names[1:]}) > 1

    def width(found):
        return max(box.x for box in found.boxes.values()) - min(
            box.x for box in found.boxes.values()
        )

    assert width(narrow) < 0.8 * width(wide)


def test_links_begin_and_end_at_their_nodes():
    found = placed("abc", [("a", "b"), ("b", "c"), ("a", "c")])
    for (source, target), points in found.routes.items():
        begin, end = found.boxes[source], found.boxes[target]
        assert points[0][1] == pytest.approx(begin.y + begin.height / 2)
        assert points[-1][1] == pytest.approx(end.y - end.height / 2)
        assert abs(points[0][0] - begin.x) < begin.width / 2
        assert abs(points[-1][0] - end.x) < end.width / 2
    # From a to c past b: two points more, beside b.
    (beside, _), (also, _) = found.routes["a", "c"][2:4]
    assert beside == also
    assert abs(beside - found.boxes["b"].x) > SQUARE.width / 2


@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(0.5, 9.0)), min_size=1, max_size=12))
def test_neighbours_are_far_enough_apart_and_no_further_than_need_be(wanted):
    places = [place for place, _ in wanted]
    apart = [distance for _, distance in wanted[1:]]
    found = _spread(places, [1.0] * len(places), apart)
    for (left, right), distance in zip(pairwise(found), apart, strict=True):
        assert right - left >= distance - 1e-9
    # Least squares: to move all of them together makes it no better.
    assert sum(found) == pytest.approx(sum(places), abs=1e-6)
    enough = all(
        right - left >= distance
        for (left, right), distance in zip(pairwise(places), apart, strict=True)
    )
    if enough:
        assert found == pytest.approx(places)
