"""Damaged and hostile folders: each is read, or is refused in lines, and never anything else.

The seed changes from day to day; SOCIALMIND_FUZZ_SEED sets it.
"""

import random

import pytest

from socialmind.metaciv.reading import read_folder
from socialmind.metaciv.reading.record import INT
from tests.fuzzing.faults import SEED, mutated

from .folders import FARMERS, flat, written

COUNT = 300
HOSTILE = [
    b"9" * 5000, b"-1", b"nan", b"1e999", b"\0", b"\xff\xfe", b"\xef\xbb\xbf", b"(" * 500, b",",
    b"\r", b"\r\n", b"..", b"/dev/zero", b"\x1b[31m", b"a" * 30_000, b" : ", b"\t", b"Action : ",
    b"\"\"\"\nimport os\n", b"2147483648", b"99999999", "\N{SUPERSCRIPT TWO}".encode(), b"\xe9",
    b"(Objet ", b"),", b" Constant ", b"\xe2\x80\xa8", b"\xe2\x80\xae", b"%00", b"Nom : ", b";",
]  # fmt: skip
NAMES = ["x\ny", "..", "%2e%2e%2f", "\x1b[31m", "a" * 200, ".hidden", "é", "\udcff", "con"]


def damaged(number):
    """The files of a folder with one to four files that are not as they should be."""
    chance = random.Random(SEED * 1000 + number)
    sound = FARMERS if number % 3 else flat()
    files = {file: text.encode() for file, text in sound.items()}
    for _ in range(chance.randint(1, 4)):
        file = chance.choice(sorted(files))
        match chance.randrange(8):
            case 0 if file != "parametres.metaciv":
                del files[file]
            case 1:
                home = file.rpartition("/")[0]
                files[f"{home}/{chance.choice(NAMES)}.metaciv"] = files[file]
            case _:
                files[file] = mutated(files[file], chance, HOSTILE)
    return files


def test_damaged_folders_are_read_or_refused_in_lines(tmp_path):
    whole = 0
    for number in range(COUNT):
        folder = tmp_path / str(number)
        try:
            written(folder, damaged(number))
        except OSError:  # a name that this system does not take
            continue
        reading = read_folder(folder)
        assert (reading.model is None) == bool(reading.errors), number
        for one in reading.findings:
            assert len(str(one).splitlines()) == 1 and str(one).isprintable(), number
            assert one.place.line >= 1
        whole += reading.model is not None
    assert COUNT / 20 < whole < COUNT, "damage that is noticed always, or never"


def test_bytes_of_any_kind(tmp_path):
    for number in range(20):
        chance = random.Random(SEED + number)
        files = {file: chance.randbytes(chance.randrange(400)) for file in FARMERS}
        assert read_folder(written(tmp_path / str(number), files)).model is None


@pytest.mark.parametrize(
    ("file", "old", "new", "expected"),
    [
        ("simulation/environnements/Valley.metaciv", "Largeur : 3", "Largeur : 5001", "from 1 to"),
        ("simulation/civilisations/Farmers.metaciv", "Agents : 2", "Agents : 2000000", "from 0 to"),
        ("simulation/terrains/Grass.metaciv", "25", str(INT[1] + 1), "0 or more"),
        ("simulation/effects/Fed.metaciv", "1.5", "1e999", "a number"),
        ("simulation/objets/Sack.metaciv", "Sack of corn", "x" * 201, "at most 200"),
        ("simulation/objets/Sack.metaciv", "Sack of corn", "x\x1b[31m", "printed characters"),
        ("schemasCognitifs/Farmer/plans/Work.metaciv", "\t\tA", "\t" * 9 + "A", "at most 2"),
    ],
)
def test_what_is_too_large_is_refused(tmp_path, file, old, new, expected):
    reading = read_folder(written(tmp_path, {**FARMERS, file: FARMERS[file].replace(old, new)}))
    assert any(expected in str(one) and one.place.file == file for one in reading.errors)


def test_maps_and_files_have_their_limits(tmp_path):
    large = "Nom : Valley\nLargeur : 5000\nHauteur : 5000\n"
    reading = read_folder(
        written(
            tmp_path,
            {
                **FARMERS,
                "simulation/environnements/Valley.metaciv": large,
                "simulation/objets/Sack.metaciv": b"Nom : Sack of corn\n" + b"x\n" * 2**19,
            },
        )
    )
    said = " ".join(str(one) for one in reading.errors)
    assert "5000 × 5000 cells" in said and "more than 1 MB" in said


def test_a_file_of_many_faults_is_listed_in_part(tmp_path):
    file = "schemasCognitifs/Farmer/plans/Work.metaciv"
    plan = "Nom : Work\n" + "Action : A_Sleep\n" * 2000
    reading = read_folder(written(tmp_path, {**FARMERS, file: plan}))
    assert len(reading.findings) == 101
    assert str(reading.findings[-1]).endswith("the rest is not listed")
