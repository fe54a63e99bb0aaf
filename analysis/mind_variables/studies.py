"""Figures 4.6 to 4.8 of the thesis: what variables make of the commands they receive."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, write_figure


def simple_variable(out: Path) -> list[Path]:
    from .figures import draw_simple_variable
    from .records import simple_variable

    rows = simple_variable()
    return write_figure("figure-4.6", draw_simple_variable(rows), rows, out)


def counter(out: Path) -> list[Path]:
    from .figures import draw_counter
    from .records import COUNTER, counter

    rows = counter()
    return write_figure("figure-4.7", draw_counter(rows, COUNTER), rows, out)


def wave_generator(out: Path) -> list[Path]:
    from .figures import draw_wave_generator
    from .records import wave_generator

    rows = wave_generator()
    return write_figure("figure-4.8", draw_wave_generator(rows), rows, out)


studies = (
    Study("figure-4.6", "a simple variable that two skills command", simple_variable),
    Study("figure-4.7", "a counter: rising edges count, a falling edge resets", counter),
    Study("figure-4.8", "a wave generator, whose input sets the wavelength", wave_generator),
)
