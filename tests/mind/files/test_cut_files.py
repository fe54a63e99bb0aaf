"""Files that were cut off or scrambled: they load, or there is one clear error, never another."""

import warnings
from functools import partial

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from small_mind import FILES, YAML_MIND
from thesis_examples import AVOID_CNN, TASK

from socialmind.errors import ModelError
from socialmind.mind import MindDescription
from socialmind.mind.files import yaml_reader
from socialmind.mind.files.evoagents import ades, botdesc, genome_file, simbatch, vardesc
from socialmind.mind.files.folder import load_tasks

PARSERS = {
    ".botdesc": botdesc.parse,
    ".vardesc": vardesc.parse,
    ".ades": ades.parse,
    ".simbatch": simbatch.parse,
    ".yaml": partial(yaml_reader.parse, kind=MindDescription),
}
TEXTS = {
    **{path: text for path, text in FILES.items() if path.endswith(tuple(PARSERS))},
    "Skills/Avoid/Avoid.ades": AVOID_CNN,
    "Tasks/Avoid.simbatch": TASK,
    "robot.yaml": YAML_MIND,
}
del TEXTS["Skills/Think/think.yaml"]


@pytest.fixture
def parse(write_files):
    """Parse a text as one of the small mind's files, or refuse it in one line."""
    folder = write_files(FILES)
    see = MindDescription.load(folder).skill("See").changed(genome=None)

    def parsed(path, text):
        try:
            if path.endswith(".genome"):
                return genome_file.parse(text, folder / path, see)
            return PARSERS["." + path.rpartition(".")[2]](text, folder / path)
        except ModelError as error:
            assert "\n" not in str(error)
            assert str(error).startswith(str(folder))
            return None

    return parsed


@pytest.mark.parametrize("path", TEXTS)
def test_a_text_cut_off_anywhere(parse, path):
    text = TEXTS[path]
    assert parse(path, text) is not None
    refused = [length for length in range(len(text)) if parse(path, text[:length]) is None]
    # A list without end, of variables or tasks, may stop after any of its lines.
    assert refused or path.endswith(".vardesc")


@pytest.mark.parametrize("path", TEXTS)
def test_a_text_without_one_of_its_lines(parse, path):
    lines = TEXTS[path].splitlines(keepends=True)
    for left_out in range(len(lines)):
        parse(path, "".join(lines[:left_out] + lines[left_out + 1 :]))


def test_weights_cut_off_anywhere_are_refused(parse):
    text = FILES["Skills/See/See.genome"]
    assert parse("See.genome", text).genome is not None
    assert parse("See.genome", text.rstrip("\n")).genome is not None
    for length in range(len(text) - 1):
        assert parse("See.genome", text[:length]) is None


@pytest.mark.parametrize("path", FILES)
def test_a_folder_with_a_file_cut_off_at_any_line(write_files, path):
    lines = FILES[path].encode().splitlines(keepends=True)
    for length in range(len(lines)):
        folder = write_files(FILES | {path: b"".join(lines[:length])})
        try:
            MindDescription.load(folder)
            load_tasks(folder)
        except ModelError as error:
            assert "\n" not in str(error)


@settings(max_examples=300, suppress_health_check=list(HealthCheck))
@given(
    path=st.sampled_from([*TEXTS, "Skills/See/See.genome"]),
    place=st.floats(0, 1),
    length=st.integers(0, 4),
    put=st.text(max_size=3) | st.sampled_from([":", "\n", "#", "9" * 6000, "-1", "[", "&a ", "*a"]),
)
def test_a_scrambled_text(parse, path, place, length, put):
    text = {**FILES, **TEXTS}[path]
    at = int(place * len(text))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        parse(path, text[:at] + put + text[at + length :])


def test_deeply_nested_yaml(parse):
    assert parse("robot.yaml", "[" * 5000) is None
