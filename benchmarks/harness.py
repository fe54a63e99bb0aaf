"""What the benchmarks share: the machine, medians with their ranges, tables in the README."""

import json
import os
import platform
import statistics
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

HERE = Path(__file__).parent


def describe_machine(*packages: str) -> dict[str, object]:
    """Return the processor, the system and the versions of packages."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        **{name: version(name) for name in packages},
    }


def _processor() -> str:
    """The processor's name, as well as the system tells it."""
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def spread(values: list[float], form: str, unit: str = "") -> str:
    """Return the median and the range of some rounds as two cells of a table."""
    middle, low, high = statistics.median(values), min(values), max(values)
    return f"{middle:{form}}{unit} | {low:{form}} – {high:{form}}"


def write(results: dict, table: Callable[[dict], str], name: str, folder: Path) -> None:
    """Write `<name>.json`, and the table between the README's lines of that name."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.json").write_text(json.dumps(results, indent=1) + "\n")
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    readme = folder / "README.md"
    text = readme.read_text(encoding="utf-8") if readme.exists() else f"{begin}\n{end}\n"
    if begin not in text or end not in text:
        raise SystemExit(f"{readme}: found no lines {begin} and {end} to write between")
    head, _, rest = text.partition(begin)
    tail = rest.partition(end)[2]
    readme.write_text(f"{head}{begin}\n\n{table(results)}\n\n{end}{tail}", encoding="utf-8")
