"""Films of frames: MP4 through ffmpeg, GIF through Pillow.

A film appears under its name when it is whole; one that is broken off leaves nothing.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError

Frame = NDArray[np.uint8]
"""(height, width, 4): red, green, blue, opacity."""

SUFFIXES = (".mp4", ".gif")
COLOURS = 128
"""Of each frame of a GIF."""


class Film:
    """A film that is being written; leave its `with` block to finish it.

    Args:
        path: the file, which ends in .mp4 or .gif.
        fps: frames a second; a GIF's frames last whole hundredths of a second, 2 or more.

    Raises:
        SocialmindError: it ends in something else, or there is no ffmpeg for an MP4.
    """

    def __init__(self, path: Path, fps: float) -> None:
        if path.suffix.lower() not in SUFFIXES:
            raise SocialmindError(
                f"{path}: found {path.suffix!r}; expected {' or '.join(SUFFIXES)}"
            )
        self.path = path
        self.fps = fps
        self._unfinished = path.with_name(f".{path.stem}.partial{path.suffix}")
        self._writer: _Mp4 | _Gif
        if path.suffix.lower() == ".mp4":
            self._writer = _Mp4(self._unfinished, fps, ffmpeg(path))
        else:
            self._writer = _Gif(self._unfinished, fps)

    def write(self, frame: Frame) -> None:
        """Add a frame; all have one size, of even numbers of pixels."""
        self._writer.write(frame)

    def __enter__(self) -> Film:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        try:
            if kind is None:
                self._writer.finish()
                self._unfinished.replace(self.path)
            else:
                self._writer.stop()
        finally:
            self._unfinished.unlink(missing_ok=True)


def ffmpeg(path: Path) -> str:
    """Return the program that writes MP4: the one on the PATH, or that of imageio-ffmpeg.

    Args:
        path: the film that it is for.

    Raises:
        SocialmindError: there is none.
    """
    found = shutil.which("ffmpeg")
    if found is not None:
        return found
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        raise SocialmindError(
            f"{path}: writing MP4 needs ffmpeg, and it is not here; install it, or "
            "`pip install imageio-ffmpeg`, or write a .gif"
        ) from None


@dataclass
class _Mp4:
    """H.264 in the form that every player and browser knows.

    Frames go down a pipe as they are: Matplotlib's own writer would draw the whole figure anew for
    each.
    """

    path: Path
    fps: float
    program: str
    process: Any = None
    log: Any = None

    def write(self, frame: Frame) -> None:
        if self.process is None:
            height, width = frame.shape[:2]
            command = [
                self.program, "-y", "-loglevel", "error",
                "-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}",
                "-r", f"{self.fps:g}", "-i", "-", "-an",
                "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
                str(self.path),
            ]  # fmt: skip
            self.log = tempfile.TemporaryFile()  # noqa: SIM115  # closed by finish and stop
            # In a session of its own Ctrl-C reaches us alone, who then stop it.
            self.process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=self.log, stderr=self.log,
                start_new_session=True,
            )  # fmt: skip
        try:
            self.process.stdin.write(np.ascontiguousarray(frame).data)
        except OSError:
            self._fail()

    def finish(self) -> None:
        if self.process is not None:
            self.process.communicate()
            if self.process.returncode != 0:
                self._fail()
            self.log.close()

    def stop(self) -> None:
        if self.process is not None:
            self.process.kill()
            self.process.communicate()
            self.log.close()

    def _fail(self) -> None:
        """Say what ffmpeg said."""
        self.process.communicate()
        self.log.seek(0)
        said = self.log.read().decode(errors="replace").strip().splitlines()
        self.log.close()
        reason = said[-1].strip() if said else "it ended without a word"
        raise SocialmindError(f"{self.program} could not write the film: {reason}")


class _Gif:
    """Frames with palettes of their own, shown for ever."""

    def __init__(self, path: Path, fps: float) -> None:
        self._path = path
        self._frames: list[Any] = []
        self._duration = 10 * max(round(100 / fps), 2)

    def write(self, frame: Frame) -> None:
        from PIL import Image

        image = Image.fromarray(np.ascontiguousarray(frame[:, :, :3]))
        self._frames.append(image.quantize(COLOURS, dither=Image.Dither.NONE))

    def finish(self) -> None:
        first, *others = self._frames
        first.save(self._path, save_all=True, append_images=others, duration=self._duration, loop=0)

    def stop(self) -> None:
        self._frames = []
