"""Where modules are drawn: read as it was written, and no part of the mind."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_mind import FILES

from socialmind.errors import ModelError
from socialmind.mind import MindDescription
from socialmind.mind.files.folder import files_of
from socialmind.mind.files.layout import SECTIONS, layout_file, lines_of, parse
from socialmind.runs.sources import hash_of, mind_files_in

names = st.sampled_from(["S1", "Go to+Avoid", "SENSORS", "SKILLS ", "é", "-"]).map(str.strip)
coordinates = st.integers(-(2**31), 2**31 - 1)
places = st.dictionaries(names, st.tuples(coordinates, coordinates), min_size=1)


@given(st.dictionaries(st.sampled_from(list(SECTIONS)), places))
def test_what_is_written_is_read_again(found):
    assert parse("\n".join(lines_of(found)) + "\n", "a.layout") == found


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("S1:1:2\n", 1, "found 'S1:1:2'; expected one of SENSORS, ACTUATORS, VARIABLES, SKILLS"),
        ("SKILLS\n\nGo:1\n", 3, "found 'Go:1'; expected name:x:y"),
        ("SKILLS\nGo:1:0.5\n", 2, "or delete the file: the modules are laid out then"),
        ("SKILLS\nGo:1:2147483648\n", 2, "whole numbers of 32 bits"),
        ("SKILLS\nGo:1:2:3\n", 2, "expected name:x:y"),
        ("SKILLS\nGo:1:2\nSENSORS\nGo:1:2\nSKILLS\nGo:1:2\n", 6, "a second place of 'Go'"),
    ],
)
def test_errors_say_the_line_and_what_to_do(text, line, message):
    with pytest.raises(ModelError) as failure:
        parse(text, "Robot.layout")
    assert str(failure.value).startswith(f"Robot.layout:{line}: ")
    assert message in str(failure.value)


def test_a_mind_and_its_hash_are_the_same_wherever_its_boxes_stand(write_files):
    folder = write_files(FILES)
    before, hashed = MindDescription.load(folder), hash_of(mind_files_in(folder))
    layout_file(folder).write_text("SKILLS\nMaster:1:2\nGone:3:4\n")
    assert layout_file(folder).name == "Robot.layout"
    assert hash_of(mind_files_in(folder)) == hashed
    after = MindDescription.load(folder)
    assert after == before
    assert files_of(after) == files_of(before)
    after.save(folder)  # which leaves it where it is
    assert layout_file(folder).read_text() == "SKILLS\nMaster:1:2\nGone:3:4\n"
    # Any other file beside counts.
    (folder / "more.txt").write_text("")
    assert hash_of(mind_files_in(folder)) != hashed
