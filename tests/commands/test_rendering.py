"""`socialmind render`."""

import re
from pathlib import Path

import pytest

SEEKERS = Path(__file__).parents[1] / "worlds" / "plane" / "seekers"


@pytest.fixture(scope="module")
def sought(socialmind, tmp_path_factory):
    """A run of two robots that seek a ball, 30 ticks, interpreted."""
    out = tmp_path_factory.mktemp("sought") / "run"
    result = socialmind("run", SEEKERS, "--ticks", 30, "--interpreted", "--out", out)
    assert result.exit_code == 0, result.output
    return out


def written(socialmind, *words):
    result = socialmind("render", *words)
    assert result.exit_code == 0, result.output
    return Path(result.stdout.strip())


def test_a_picture_shows_the_last_tick(socialmind, sought):
    path = written(socialmind, sought, "--out", "pictures/last.svg")
    assert path == Path("pictures/last.svg")
    text = path.read_text()
    assert "tick 30<" in text
    assert "Ahead" not in text
    # 85 mm, in points.
    assert float(re.search(r'<svg[^>]* width="([\d.]+)pt"', text)[1]) == pytest.approx(
        240.9, abs=0.1
    )


def test_a_picture_shows_several_ticks_and_the_hierarchy(socialmind, sought):
    words = ("--tick", 20, "--tick", 0, "--mind", "--agent", "robots=1", "--width", 120)
    text = written(socialmind, sought, "--out", "two.svg", *words).read_text()
    assert re.findall(r"tick (\d+)<", text) == ["0", "20"]
    assert text.count(">Ahead<") == 2
    assert text.count(">0.75<") >= 2
    assert float(re.search(r'<svg[^>]* width="([\d.]+)pt"', text)[1]) == pytest.approx(
        340.2, abs=0.1
    )


def test_the_same_picture_is_the_same_file(socialmind, sought):
    one, other = (written(socialmind, sought, "--out", f"{name}.pdf") for name in ("a", "b"))
    assert one.read_bytes() == other.read_bytes()


def test_a_bitmap_has_the_width_asked_for(socialmind, sought):
    from PIL import Image

    path = written(socialmind, sought, "--out", "x.png", "--width", 500, "--look", "thesis")
    image = Image.open(path).convert("RGB")
    assert image.width == 500
    assert image.getpixel((250, 400)) == (0, 0, 0)
    path = written(socialmind, sought, "--out", "x.png", "--width", 500)
    assert Image.open(path).convert("RGB").getpixel((250, 400)) == (255, 255, 255)


@pytest.mark.parametrize(
    ("words", "frames"),
    [((), 31), (("--every", 7), 6), (("--from", 10, "--to", 20, "--every", 5), 3)],
)
def test_a_gif_shows_the_stretch(socialmind, sought, words, frames):
    from PIL import Image

    words += ("--width", 200, "--around", 10, "--trail", 5, "--fps", 25)
    image = Image.open(written(socialmind, sought, "--out", "x.gif", *words))
    assert image.n_frames == frames
    assert image.info["duration"] == 40
    assert image.width == 200


def test_an_mp4_is_written(socialmind, sought):
    path = written(
        socialmind, sought, "--out", "x.mp4", "--every", 10, "--mind", "--width", 401, "--quiet"
    )
    assert path.read_bytes()[4:8] == b"ftyp"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--out", "x.avi"], "--out x.avi: found '.avi'; expected a name that ends in .mp4, .gif"),
        (["--out", "x"], "--out x: found 'no ending'"),
        (["--out", "x.gif", "--tick", 3], "--tick with x.gif; only a picture (.svg, .pdf, .png)"),
        (["--out", "x.png", "--to", 3, "--fps", 9], "--to, --fps with x.png; only a film"),
        (["--out", "x.png", "--tick", 31], "tick 31; expected 0 … 30"),
        (["--out", "x.gif", "--to", 31], "to 31; expected 0 … 30"),
        (["--out", "x.gif", "--from", 9, "--to", 8], "from tick 9 to 8; expected a stretch"),
        (["--out", "x.gif", "--fps", 0], "fps 0; expected frames a second"),
        (["--out", "x.png", "--look", "dark"], "--look dark; expected thesis or paper"),
        (["--out", "x.png", "--around", 0], "--around 0; expected a distance, above 0"),
        (["--out", "x.png", "--width", 5], "--width 5; expected 20 … 8192"),
        (["--out", "x.png", "--agent", "one"], "--agent one; expected an identity, or POPULATION="),
        (["--out", "x.png", "--agent", 5], "agent 5; expected a robot at the start of seekers"),
    ],
)
def test_render_refuses_in_one_line(refused, sought, words, message):
    assert message in refused("render", sought, *words)
    assert not list(Path().iterdir())


def test_a_run_without_a_plane_is_refused(refused, done):
    line = refused("render", done, "--out", "x.png")
    assert "the model grazers has no plane to draw" in line


def test_a_folder_that_holds_no_run_is_refused(refused):
    assert "none: no such folder" in refused("render", "none", "--out", "x.png")
