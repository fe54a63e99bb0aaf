"""What a run of a sweep costs beyond its ticks, and whether a long sweep stays fast and small.

- `beyond`: runs of farmer_artisan in a sweep of one worker, against a bare loop in the same process
  that makes the same societies and calls `advance`; in processor time, so that others who use the
  machine count little. With `--every 0`; and with a hundred rows of series and the agents' end,
  which is mostly what the model's own `series()` and `agents()` take.
- `long`: a sweep of 20,000 runs of 100 ticks: runs a second, memory of this process and its
  workers, and open files, in the second and in the last twentieth.

    python benchmarks/sweeps.py

The results go to benchmarks/sweeps.json and, as a table, to benchmarks/README.md.
"""

import argparse
import os
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


def processor_seconds(work) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def bare(cls, seeds: int, ticks: int) -> None:
    """The same societies and ticks, in a plain loop."""
    for point, price in enumerate(DESIGN["tool_price"]):
        for seed in range(seeds):
            society = cls(seed=seed_for("sweep", seed, point), tool_price=price)
            society.advance(ticks)


def swept(cls, seeds: int, ticks: int, every: int | None, agents: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        sweep(
            cls, DESIGN, ticks, range(seeds), every=every, agents=agents, workers=1,
            out=Path(folder) / "sweep",
        )  # fmt: skip


def beyond(seeds: int, ticks: int) -> dict[str, list[float]]:
    """Milliseconds of a run beyond a bare loop's, in rounds."""
    cls = load_model(MODEL)
    runs = seeds * len(DESIGN["tool_price"])
    found: dict[str, list[float]] = {"bare": [], "no series": [], "series and agents": []}
    bare(cls, 1, 10)  # what compiles, or loads
    swept(cls, 1, 10, None, "last")
    for _ in range(ROUNDS):
        plain = processor_seconds(lambda: bare(cls, seeds, ticks))
        found["bare"].append(1000 * plain / runs)
        for name, every, agents in (("no series", 0, "none"), ("series and agents", None, "last")):
            whole = processor_seconds(lambda e=every, a=agents: swept(cls, seeds, ticks, e, a))
            found[name].append(1000 * (whole - plain) / runs)
    return found


def held() -> dict[str, float]:
    """Megabytes of this process and of its workers, and this one's open files."""
    workers = sum(rss(one.pid) for one in active_children())
    files = len(list(Path("/proc/self/fd").iterdir()))
    return {"here": rss(os.getpid()), "workers": workers, "files": files}


def rss(process: int) -> float:
    try:
        return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * 4096 / 1e6
    except (OSError, IndexError):
        return 0.0


def long(runs: int, ticks: int, workers: int) -> dict[str, dict[str, float]]:
    """Return what two twentieths of the runs are like, the second and the last."""
    seen: list[tuple[int, float]] = []
    part, marks = runs // 20, {}

    def tell(done: int, total: int) -> None:
        seen.append((done, time.perf_counter()))
        for name, at in (("first", 2 * part), ("last", total)):
            if done >= at and name not in marks:
                marks[name] = held()

    with tempfile.TemporaryDirectory() as folder:
        sweep(
            MODEL, DESIGN, ticks, range(runs // len(DESIGN["tool_price"])), every=0,
            workers=workers, on_progress=tell, out=Path(folder) / "sweep",
        )  # fmt: skip
    for name, (begin, end) in {"first": (part, 2 * part), "last": (runs - part, runs)}.items():
        at = [next(one for one in seen if one[0] >= mark) for mark in (begin, end)]
        marks[name]["a second"] = (at[1][0] - at[0][0]) / (at[1][1] - at[0][1])
    return marks


def measure(seeds: int, ticks: int, runs: int, workers: int) -> dict:
    return {
        "machine": describe_machine("numba", "numpy", "pyarrow"),
        "ticks": ticks,
        "runs": runs,
        "workers": workers,
        "beyond": beyond(seeds, ticks),
        "long": long(runs, 100, workers),
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    beyond, long = results["beyond"], results["long"]
    rows = [
        (f"a run of {results['ticks']:,} ticks in a bare loop", beyond["bare"]),
        ("a run of a sweep beyond that, no series", beyond["no series"]),
        ("likewise, with 100 rows of series and the agents", beyond["series and agents"]),
    ]
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}; processor time, {ROUNDS} rounds.",
        "",
        "| farmer_artisan | median | least – greatest |",
        "|---|---|---|",
        *(f"| {what} | {spread(values, '.2f', ' ms')} |" for what, values in rows),
        "",
        f"| {results['runs']:,} runs of 100 ticks, {results['workers']} workers | runs a second | "
        "memory here | memory of workers | open files |",
        "|---|---|---|---|---|",
    ]
    for name, what in (("first", "second twentieth"), ("last", "last twentieth")):
        one = long[name]
        lines.append(
            f"| {what} | {one['a second']:.0f} | {one['here']:.0f} MB | {one['workers']:.0f} MB | "
            f"{one['files']:.0f} |"
        )
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=25, help="of each of four points")
    parser.add_argument("--ticks", type=int, default=10_000, help="of a run")
    parser.add_argument("--runs", type=int, default=20_000, help="of the long sweep")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments.seeds, arguments.ticks, arguments.runs, arguments.workers)
    write(results, table, "sweeps", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
