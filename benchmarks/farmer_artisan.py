"""How fast the farmer-artisan society runs, beside a plain Mesa program of the same rules.

Everything is measured in one run, socialmind and Mesa by turns, so that a busy machine slows both:

- loop: ticks of 25 agents, each program's loop alone;
- process: the whole command, start and loading of the compiled code included;
- first compilation: the command with empty caches;
- first tick: the command with `--ticks 1`, warm;
- crowd: 100,000 agents, villages and land in proportion, once the land is claimed; memory.

    python benchmarks/farmer_artisan.py            # Mesa for 20,000 ticks, the rest extrapolated
    python benchmarks/farmer_artisan.py --full     # Mesa for all ticks

The results go to benchmarks/farmer_artisan.json and, as a table, to benchmarks/README.md.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import mesa_farmer_artisan
from harness import HERE, describe_machine, spread, write
from mesa_farmer_artisan import Society

from socialmind.catalogue import load_model

MESA_PROGRAM = Path(mesa_farmer_artisan.__file__)
AGENTS = 25


def loop_seconds(ticks: int, seed: int) -> float:
    """Seconds that socialmind's compiled loop takes for some ticks."""
    model = load_model("farmer_artisan")(seed=seed)
    model.advance(1)  # loads the compiled code
    start = time.perf_counter()
    model.advance(ticks)
    return time.perf_counter() - start


def mesa_loop_seconds(ticks: int, seed: int) -> float:
    """Seconds that the Mesa program's loop takes for some ticks."""
    society = Society(n_agents=AGENTS, rng=seed)
    society.step()
    start = time.perf_counter()
    for _ in range(ticks):
        society.step()
    return time.perf_counter() - start


def command_seconds(ticks: int, seed: int, caches: Path | None = None) -> float:
    """Seconds that `socialmind run` takes, from start to end.

    Args:
        ticks: length of the run.
        seed: of the run.
        caches: a folder for compiled code in place of the usual ones.
    """
    # The console script, or what it calls where the package is not installed but on the path.
    script = shutil.which("socialmind", path=str(Path(sys.executable).parent))
    program = [script] if script else [sys.executable, "-m", "socialmind.cli"]
    environment = dict(os.environ)
    if caches is not None:
        environment["SOCIALMIND_CACHE_DIR"] = str(caches / "socialmind")
        environment["NUMBA_CACHE_DIR"] = str(caches / "numba")
    with tempfile.TemporaryDirectory() as folder:
        run = ["run", "farmer_artisan", "--ticks", str(ticks), "--seed", str(seed)]
        out = ["--quiet", "--out", str(Path(folder) / "run")]
        return _timed([*program, *run, *out], environment)[0]


def mesa_process_seconds(ticks: int, measured: int, seed: int) -> float:
    """Seconds that the whole Mesa program takes for some ticks, from a run of `measured` ticks.

    What is not loop counts once, the loop by the tick.
    """
    command = [sys.executable, str(MESA_PROGRAM), "--ticks", str(measured), "--seed", str(seed)]
    seconds, output = _timed(command, dict(os.environ))
    line = next(line for line in output.splitlines() if line.startswith("loop seconds"))
    loop = float(line.split()[-1])
    return seconds - loop + loop * ticks / measured


def _timed(command: list[str], environment: dict[str, str]) -> tuple[float, str]:
    start = time.perf_counter()
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    seconds = time.perf_counter() - start
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stderr}")
    return seconds, done.stdout


def crowd(agents: int, villages: int, size: int, stretches: int, ticks: int) -> dict[str, object]:
    """Measure many agents once nearly all have land; to be called in a process of its own.

    Args:
        agents: the number of agents.
        villages: the number of villages.
        size: patches along a side of the world.
        stretches: how many stretches to time.
        ticks: length of each.

    Returns:
        The share with land, the ticks until then, rates in agent-steps a second, bytes an agent.
    """
    model_class = load_model("farmer_artisan")
    model_class(seed=0).advance(10)  # load and compile before memory is read
    before = _resident_bytes()
    model = model_class(seed=0, n_agents=agents, n_villages=villages, world_size=size)
    with_land = 0.0
    while with_land < 0.99 and model.tick < 5000:
        model.advance(100)
        with_land = float(model.humans.holds("land_x").mean())
    settled = model.tick
    rates = []
    for _ in range(stretches):
        start = time.perf_counter()
        model.advance(ticks)
        rates.append(agents * ticks / (time.perf_counter() - start))
    after = _resident_bytes()
    state = sum(array.nbytes for array in model.state().values())
    return {
        "agents": agents,
        "villages": villages,
        "world_size": size,
        "share_with_land": with_land,
        "ticks_until_then": settled,
        "agent_steps_per_second": rates,
        "state_bytes_per_agent": state / agents,
        "resident_bytes_per_agent": (after - before) / agents if before else None,
    }


def _resident_bytes() -> int:
    """Memory that this process holds; 0 where the system does not say."""
    statm = Path("/proc/self/statm")
    if not statm.exists():
        return 0
    return int(statm.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def measure(arguments: argparse.Namespace) -> dict[str, object]:
    """Do all measurements."""
    ticks = arguments.ticks
    mesa_ticks = ticks if arguments.full else min(ticks, arguments.mesa_ticks)
    print("first compilation …", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        first = command_seconds(1, 0, caches=Path(folder))
    command_seconds(1, 0)  # fills the usual caches
    loop_seconds(1, 0)

    loops: list[tuple[float, float]] = []
    processes: list[tuple[float, float]] = []
    starts: list[float] = []
    for seed in range(arguments.rounds):
        print(f"round {seed + 1} of {arguments.rounds} …", flush=True)

        def mesa_loop(seed: int = seed) -> float:
            return mesa_loop_seconds(mesa_ticks, seed) * ticks / mesa_ticks

        def mesa_process(seed: int = seed) -> float:
            return mesa_process_seconds(ticks, mesa_ticks, seed)

        # By turns, and the one that goes first changes.
        if seed % 2:
            theirs = mesa_loop()
            loops.append((loop_seconds(ticks, seed), theirs))
            theirs = mesa_process()
            processes.append((command_seconds(ticks, seed), theirs))
        else:
            loops.append((loop_seconds(ticks, seed), mesa_loop()))
            processes.append((command_seconds(ticks, seed), mesa_process()))
        starts.append(command_seconds(1, seed))

    many = None
    if arguments.crowd:
        print("crowd …", flush=True)
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            many = pool.submit(
                crowd,
                arguments.crowd,
                max(1, arguments.crowd // AGENTS),
                round((33 * 33 * arguments.crowd / AGENTS) ** 0.5),
                arguments.rounds,
                200,
            ).result()
    return {
        "machine": describe_machine("numba", "numpy", "mesa"),
        "ticks": ticks,
        "mesa_ticks": mesa_ticks,
        "rounds": arguments.rounds,
        "loop_seconds": [ours for ours, _ in loops],
        "mesa_loop_seconds": [theirs for _, theirs in loops],
        "process_seconds": [ours for ours, _ in processes],
        "mesa_process_seconds": [theirs for _, theirs in processes],
        "first_compilation_seconds": first,
        "first_tick_seconds": starts,
        "crowd": many,
    }


def table(results: dict) -> str:
    """The results as a table in Markdown."""
    ticks, rounds = results["ticks"], results["rounds"]

    def ratio(ours: str, theirs: str) -> list[float]:
        return [their / our for our, their in zip(results[ours], results[theirs], strict=True)]

    def rates(seconds: str) -> list[float]:
        return [AGENTS * ticks / 1e6 / second for second in results[seconds]]

    machine = results["machine"]
    rows = [
        ("loop: times as fast as Mesa", spread(ratio("loop_seconds", "mesa_loop_seconds"), ".1f")),
        (
            "process: times as fast as Mesa",
            spread(ratio("process_seconds", "mesa_process_seconds"), ".1f"),
        ),
        ("loop, 25 agents (million agent-steps a second)", spread(rates("loop_seconds"), ".2f")),
        (
            "Mesa loop, 25 agents (million agent-steps a second)",
            spread(rates("mesa_loop_seconds"), ".3f"),
        ),
        (f"loop, {ticks:,} ticks", spread(results["loop_seconds"], ".2f", " s")),
        (f"Mesa loop, {ticks:,} ticks", spread(results["mesa_loop_seconds"], ".1f", " s")),
        (f"process, {ticks:,} ticks, warm", spread(results["process_seconds"], ".2f", " s")),
        (f"Mesa process, {ticks:,} ticks", spread(results["mesa_process_seconds"], ".1f", " s")),
        ("process to its first tick, warm", spread(results["first_tick_seconds"], ".2f", " s")),
        (
            "process to its first tick, nothing compiled yet",
            f"{results['first_compilation_seconds']:.1f} s | one run",
        ),
    ]
    many = results["crowd"]
    if many:
        steps = [rate / 1e6 for rate in many["agent_steps_per_second"]]
        rows.append(
            (
                f"loop, {many['agents']:,} agents (million agent-steps a second)",
                spread(steps, ".2f"),
            )
        )
        rows.append(("state an agent", f"{many['state_bytes_per_agent']:.0f} bytes | one run"))
        if many["resident_bytes_per_agent"] is not None:
            grown = many["resident_bytes_per_agent"]
            rows.append(("resident memory an agent", f"{grown:.0f} bytes | one run"))
    extrapolated = (
        f"Mesa ran {results['mesa_ticks']:,} ticks in each round; its loop is extrapolated to "
        f"{ticks:,}."
        if results["mesa_ticks"] < ticks
        else f"Mesa ran all {ticks:,} ticks in each round."
    )
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}, Mesa {machine['mesa']}; {rounds} rounds, "
        f"each on one core. {extrapolated}",
        "",
        "| | median | least – greatest |",
        "|---|---|---|",
        *(f"| {name} | {cells} |" for name, cells in rows),
    ]
    if many:
        lines += [
            "",
            f"With {many['agents']:,} agents: {many['villages']:,} villages in a world of "
            f"{many['world_size']:,} × {many['world_size']:,} patches, timed from tick "
            f"{many['ticks_until_then']:,}, when {100 * many['share_with_land']:.1f} % had land.",
        ]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ticks", type=int, default=500_000, help="length of a run")
    parser.add_argument("--rounds", type=int, default=5, help="how often each is measured")
    parser.add_argument("--mesa-ticks", type=int, default=20_000, help="ticks that Mesa runs")
    parser.add_argument("--full", action="store_true", help="let Mesa run all ticks")
    parser.add_argument("--crowd", type=int, default=100_000, help="agents in the crowd; 0: none")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    results = measure(arguments)
    write(results, table, "farmer_artisan", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
