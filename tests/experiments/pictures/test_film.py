"""Films: frames in, frames out; and nothing left behind when it goes wrong."""

import subprocess
import sys

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.pictures import film
from socialmind.experiments.pictures.film import Film

COLOURS = [(200, 30, 30), (30, 200, 30), (30, 30, 200), (220, 220, 220), (20, 20, 20)]


def frame(colour, height=48, width=64):
    pixels = np.full((height, width, 4), 255, np.uint8)
    pixels[:, :, :3] = colour
    return pixels


def write(path, fps=25.0):
    with Film(path, fps) as written:
        for colour in COLOURS:
            written.write(frame(colour))


def test_a_gif_has_the_frames_and_lasts_as_long(tmp_path):
    from PIL import Image

    write(tmp_path / "x.gif", fps=20.0)
    image = Image.open(tmp_path / "x.gif")
    assert (image.n_frames, image.size, image.info["loop"]) == (5, (64, 48), 0)
    for number, colour in enumerate(COLOURS):
        image.seek(number)
        assert image.info["duration"] == 50
        found = image.convert("RGB").getpixel((30, 20))
        assert found == pytest.approx(colour, abs=4)


def test_an_mp4_has_the_frames(tmp_path):
    path = tmp_path / "films" / "x.mp4"
    write(path)
    command = [film.ffmpeg(path), "-loglevel", "error", "-i", path, "-f", "rawvideo"]
    command += ["-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    frames = np.frombuffer(raw, np.uint8).reshape(-1, 48, 64, 3)
    assert len(frames) == len(COLOURS)
    for found, colour in zip(frames, COLOURS, strict=True):
        assert found[20, 30].tolist() == pytest.approx(colour, abs=14)


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_what_is_broken_off_leaves_nothing(tmp_path, suffix):
    path = tmp_path / f"x{suffix}"
    path.write_text("what was there")
    with pytest.raises(KeyboardInterrupt), Film(path, 25.0) as written:
        written.write(frame(COLOURS[0]))
        raise KeyboardInterrupt
    assert [one.name for one in tmp_path.iterdir()] == [path.name]
    assert path.read_text() == "what was there"


def test_what_ffmpeg_cannot_do_is_told(tmp_path):
    with pytest.raises(SocialmindError, match="could not write the film"):  # noqa: SIM117
        with Film(tmp_path / "x.mp4", 25.0) as written:
            written.write(frame(COLOURS[0], height=47))
    assert list(tmp_path.iterdir()) == []


def test_without_ffmpeg_it_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(film.shutil, "which", lambda name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(SocialmindError, match=r"needs ffmpeg.*pip install.*\.gif"):
        Film(tmp_path / "x.mp4", 25.0)
    Film(tmp_path / "x.gif", 25.0)


def test_ffmpeg_on_the_path_comes_first(tmp_path, monkeypatch):
    monkeypatch.setattr(film.shutil, "which", lambda name: f"/somewhere/{name}")
    assert film.ffmpeg(tmp_path / "x.mp4") == "/somewhere/ffmpeg"


def test_other_kinds_of_files_are_refused(tmp_path):
    with pytest.raises(SocialmindError, match=r"found '.avi'; expected .mp4 or .gif"):
        Film(tmp_path / "x.avi", 25.0)
