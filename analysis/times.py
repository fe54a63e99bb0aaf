"""How long the thesis's figures and tables take from what is kept.

    python -m analysis.times                 # all that the overview shows: some minutes each
    python -m analysis.times figure-6.2      # some

Each is made once, in a folder that is thrown away. Seconds are of processors, so that what else a
machine does counts little; they hold what is compiled on the way, which a second time takes less.
"""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from socialmind.experiments.overview import TIMES_FILE, commands, rows_of

TIMES = Path(__file__).parent / TIMES_FILE


def seconds_of(command: str) -> float:
    """Return the seconds of processors that a command takes."""
    with TemporaryDirectory() as folder:
        words = [sys.executable, "-m", *command.split(), "--out", folder]
        before = os.times()
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        after = os.times()
    return sum(after[2:4]) - sum(before[2:4])


def main(names: list[str]) -> None:
    known = {}
    if TIMES.is_file():
        known = {row["command"]: row["seconds"] for row in rows_of(TIMES)}
    for command in commands():
        if not names or set(names) & set(command.split()):
            known[command] = f"{seconds_of(command):.1f}"
            print(f"{command}: {known[command]} s", flush=True)
            with TIMES.open("w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(["command", "seconds"])
                writer.writerows(sorted(known.items()))


if __name__ == "__main__":
    main(sys.argv[1:])
