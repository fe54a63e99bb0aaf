"""The pictures of an ODD document: schemes and hierarchies, marked with what they show.

A picture differs from one version of Matplotlib to the next, so it cannot be compared byte for
byte. Each bears the hash of what it was drawn from instead, and is stale when that is another.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.sources.folders import digest
from socialmind.work.files import replace_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FOLDER = "odd_figures"
DOTS = 200
"""An inch, of the width at which journals print a column or a page."""
COLOURS = 128
"""Of a picture's palette: lines and boxes need no more, and the file is a fifth as large."""


@dataclass(frozen=True)
class Picture:
    """A picture of a document, drawn when it is written.

    Attributes:
        name: of its file, without suffix.
        caption: what it shows.
        shows: the text that says all that is drawn.
        draw: draws it.
    """

    name: str
    caption: str
    shows: str
    draw: Callable[[], Figure]

    @property
    def place(self) -> str:
        """Its file, from the document's folder."""
        return f"{FOLDER}/{self.name}.png"

    @property
    def mark(self) -> str:
        """The hash that its file bears."""
        return digest(self.shows.encode())

    def is_stale(self, folder: Path) -> bool:
        """Whether the file beside a document in a folder is missing, or shows something else."""
        from PIL import Image, UnidentifiedImageError

        try:
            with Image.open(folder / self.place) as image:
                return image.info.get("Description") != self.mark
        except (OSError, UnidentifiedImageError):
            return True

    def write(self, folder: Path) -> Path:
        """Draw it into the folder of figures beside a document; gives the file."""
        from PIL import Image
        from PIL.PngImagePlugin import PngInfo

        path = folder / self.place
        path.parent.mkdir(parents=True, exist_ok=True)
        drawn, small = BytesIO(), BytesIO()
        self.draw().savefig(drawn, format="png", dpi=DOTS)
        marks = PngInfo()
        marks.add_text("Description", self.mark)
        with Image.open(drawn) as image:
            few = image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
        few.save(small, format="png", optimize=True, pnginfo=marks, dpi=(DOTS, DOTS))
        replace_file(path, small.getvalue())
        return path
