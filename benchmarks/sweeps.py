"""What a run of a sweep costs beyond its ticks, whether long sweeps stay fast, what workers bring.

- `beyond`: runs of farmer_artisan in a sweep of one worker, against a bare loop in the same process
  that makes the same societies and calls `advance`; in processor time, so that others who use the
  machine count little. With `--every 0`; and with a hundred rows of series and the agents' end,
  against a loop that stops as often and calls the model's own `series()` and `agents()`.
- `long`: a sweep of 20,000 runs of 100 ticks: runs a second, processor time of a run, memory of
  this process and its workers, and open files, in the second and in the last twentieth.
- `workers`: the whole command `socialmind sweep` for 200 runs of 300,000 ticks, with one worker and
  with two, in turns. Only a quiet machine tells something.

    python benchmarks/sweeps.py beyond long
    python benchmarks/sweeps.py workers

The results go to benchmarks/sweeps.json and, as a table, to benchmarks/README.md.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from multiprocessing import active_children
from pathlib import Path

from harness import HERE, describe_machine, spread, write

from socialmind.catalogue import load_model
from socialmind.experiments import sweep
from socialmind.learning.lessons.keys import seed_for

ROUNDS = 3
MODEL = "farmer_artisan"
DESIGN = {"tool_price": [100.0, 150.0, 200.0, 250.0]}
ROWS = 100
PARTS = ("beyond", "long", "workers")


def processor_seconds(work) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def bare(cls, seeds: int, ticks: int, every: int = 0) -> None:
    """The same societies and ticks, in a plain loop; recorded likewise, if that is wanted."""
    for point, price in enumerate(DESIGN["tool_price"]):
        for seed in range(seeds):
            society = cls(seed=seed_for("sweep", seed, point), tool_price=price)
            if not every:
                society.advance(ticks)
                continue
            rows = [society.series()]
            while society.tick < ticks:
                society.advance(every)
                rows.append(society.series())
            society.agents()


def swept(cls, seeds: int, ticks: int, every: int | None, agents: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        sweep(
            cls, DESIGN, ticks, range(seeds), every=every, agents=agents, workers=1,
            out=Path(folder) / "sweep",
        )  # fmt: skip


def beyond(seeds: int, ticks: int) -> dict[str, list[float]]:
    """Milliseconds of a run in a bare loop, and beyond it in a sweep, in rounds."""
    cls = load_model(MODEL)
    runs, every = seeds * len(DESIGN["tool_price"]), max(1, ticks // ROWS)
    found: dict[str, list[float]] = {
        name: [] for name in ("bare", "no series", "bare recorded", "series and agents")
    }
    bare(cls, 1, 10, 5)  # what compiles, or loads
    swept(cls, 1, 10, None, "last")
    for _ in range(ROUNDS):
        for loop, name, step, agents in (
            ("bare", "no series", 0, "none"), ("bare recorded", "series and agents", every, "last"),
        ):  # fmt: skip
            plain = processor_seconds(lambda k=step: bare(cls, seeds, ticks, k))
            whole = processor_seconds(lambda k=step, a=agents: swept(cls, seeds, ticks, k, a))
            found[loop].append(1000 * plain / runs)
            found[name].append(1000 * (whole - plain) / runs)
    return found


def held() -> dict[str, float]:
    """Megabytes and processor seconds of this process and its workers, and this one's files."""
    workers = active_children()
    return {
        "here": rss(os.getpid()),
        "workers": sum(rss(one.pid) for one in workers),
        "files": len(list(Path("/proc/self/fd").iterdir())),
        "seconds": time.process_time() + sum(used(one.pid) for one in workers),
    }


def rss(process: int) -> float:
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * 4096 / 1e6
    except (OSError, IndexError):
        return 0.0


def used(process: int) -> float:
    """Processor seconds of a process."""
    try:
        numbers = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(numbers[11]) + int(numbers[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError):
        return 0.0


def long(runs: int, ticks: int, workers: int) -> dict[str, dict[str, float]]:
    """Return what two twentieths of the runs are like, the second and the last."""
    part = runs // 20
    marks = {"first": [part, 2 * part], "last": [runs - part, runs]}
    wanted = sorted(one for several in marks.values() for one in several)
    seen: list[tuple[int, float, dict[str, float]]] = []

    def tell(done: int, total: int) -> None:
        while wanted and done >= wanted[0]:
            wanted.pop(0)
            seen.append((done, time.perf_counter(), held()))

    with tempfile.TemporaryDirectory() as folder:
        sweep(
            MODEL, DESIGN, ticks, range(runs // len(DESIGN["tool_price"])), every=0,
            workers=workers, on_progress=tell, out=Path(folder) / "sweep",
        )  # fmt: skip
    found = {}
    for name, (begin, end) in zip(marks, (seen[:2], seen[2:]), strict=True):
        count = max(1, end[0] - begin[0])
        found[name] = {
            **end[2],
            "a second": count / (end[1] - begin[1]),
            "a run": 1000 * (end[2]["seconds"] - begin[2]["seconds"]) / count,
        }
    return found


def side_by_side(runs: int, ticks: int) -> dict[str, list[float]]:
    """Seconds of the whole command with one worker and with two, in turns."""
    found: dict[str, list[float]] = {"1": [], "2": []}
    words = [sys.executable, "-m", "socialmind", "sweep", MODEL, "--ticks", ticks, "--quiet"]
    for turn in range(ROUNDS + 1):  # in the first one code is compiled, or loaded
        for workers in found:
            with tempfile.TemporaryDirectory() as folder:
                here = [*words, "--seeds", f"0:{runs if turn else 2}", "--workers", workers]
                here += ["--out", Path(folder) / "sweep"]
                begin = time.perf_counter()
                subprocess.run([str(one) for one in here], check=True, stdout=subprocess.DEVNULL)
                if turn:
                    found[workers].append(time.perf_counter() - begin)
    return found


def measure(
    parts, seeds: int, ticks: int, runs: int, workers: int, long_ticks: int = 300_000
) -> dict:
    found = {"machine": describe_machine("numba", "numpy", "pyarrow")}
    if "beyond" in parts:
        found |= {"ticks": ticks, "points": seeds, "beyond": beyond(seeds, ticks)}
    if "long" in parts:
        found |= {"runs": runs, "workers": workers, "long": long(runs, 100, workers)}
    if "workers" in parts:
        found |= {"side by side": {"ticks": long_ticks, **side_by_side(200, long_ticks)}}
    return found


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}; {ROUNDS} rounds."
    ]
    if "beyond" in results:
        found = results["beyond"]
        rows = [
            (f"a run of {results['ticks']:,} ticks in a bare loop", found["bare"]),
            ("a run of a sweep beyond that, no series", found["no series"]),
            (f"in a bare loop that calls `series()` {ROWS} times", found["bare recorded"]),
            ("a run of a sweep beyond that, with these tables", found["series and agents"]),
        ]
        lines += [
            "",
            "| farmer_artisan, processor time | median | least – greatest |",
            "|---|---|---|",
            *(f"| {what} | {spread(values, '.2f', ' ms')} |" for what, values in rows),
        ]
    if "long" in results:
        lines += [
            "",
            f"| {results['runs']:,} runs of 100 ticks, {results['workers']} workers | "
            "runs a second | processor time of a run | memory here | of workers | open files |",
            "|---|---|---|---|---|---|",
        ]
        for name, what in (("first", "second twentieth"), ("last", "last twentieth")):
            one = results["long"][name]
            lines.append(
                f"| {what} | {one['a second']:.0f} | {one['a run']:.2f} ms | {one['here']:.0f} MB "
                f"| {one['workers']:.0f} MB | {one['files']:.0f} |"
            )
    if "side by side" in results:
        found = results["side by side"]
        ratios = [one / two for one, two in zip(found["1"], found["2"], strict=True)]
        lines += [
            "",
            f"| 200 runs of {found['ticks']:,} ticks, whole command; rounds: {len(ratios)} "
            "| median | least – greatest |",
            "|---|---|---|",
            f"| one worker | {spread(found['1'], '.1f', ' s')} |",
            f"| two workers | {spread(found['2'], '.1f', ' s')} |",
            f"| times as fast with two | {spread(ratios, '.2f')} |",
        ]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "parts", nargs="*", default=[], metavar="|".join(PARTS), help="what to measure (all)"
    )
    parser.add_argument("--seeds", type=int, default=25, help="of each of four points")
    parser.add_argument("--ticks", type=int, default=1_000, help="of a run")
    parser.add_argument("--runs", type=int, default=20_000, help="of the long sweep")
    parser.add_argument("--workers", type=int, default=2, help="of the long sweep")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    parts = arguments.parts or PARTS
    if unknown := set(parts).difference(PARTS):
        parser.error(f"nothing called {', '.join(sorted(unknown))}; there is {', '.join(PARTS)}")
    results = measure(parts, arguments.seeds, arguments.ticks, arguments.runs, arguments.workers)
    before = arguments.out / "sweeps.json"
    known = json.loads(before.read_text()) if before.is_file() else {}
    results = {**known, **results}  # what was measured before stays
    print(table(results))
    write(results, table, "sweeps", arguments.out)


if __name__ == "__main__":
    main()
