"""How fast three classics run, beside Mesa's own examples of them by the same rules.

Wolves and sheep, flocking and Schelling's segregation, in both sizes of the public comparison of
agent-based frameworks (DOI 10.5281/zenodo.8016506). A time is that of a whole run, setup included
and compilation not. Each run has a seed of its own; Mesa runs a few of the seeds, by turns with
socialmind, and a ratio is taken within such a round. Then the lines of the models, and what a bird
costs in a step, from a thousand birds on, at constant density.

    python benchmarks/classics.py            # a hundred seeds, five of them with Mesa
    python benchmarks/classics.py --full     # up to a million birds

The results go to benchmarks/classics.json and, as a table, to benchmarks/README.md.
"""

import argparse
import ast
import io
import time
import tokenize
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mesa_classics as mesa
from harness import HERE, describe_machine, spread, write

from socialmind.catalogue import load_model

Parameters = dict[str, Any]
BLANK = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
    tokenize.ENCODING, tokenize.ENDMARKER,
}  # fmt: skip
DENSITY = 200 / 100**2
"""Birds a patch of the comparison's small size."""
BIRDS, MANY_BIRDS = (1_000, 10_000), (100_000, 1_000_000)


@dataclass(frozen=True)
class Classic:
    """A model of the comparison.

    Args:
        title: what the table calls it.
        ticks: length of a run.
        sizes: the parameters of socialmind's model, by size.
        mesa: makes Mesa's model of the same parameters and a seed.
        ark: how many times as fast as Mesa Ark.jl is as published, by size.
        lines: the fewest published.
    """

    title: str
    ticks: int
    sizes: dict[str, Parameters]
    mesa: Callable[[Parameters, int], Any]
    ark: dict[str, int]
    lines: int


CLASSICS = {
    "wolves_sheep": Classic(
        "wolves and sheep",
        100,
        {
            "small": {
                "n_sheep": 60, "n_wolves": 40, "regrowth": 20, "sheep_reproduction": 0.2,
                "wolf_reproduction": 0.1, "world_size": 25,
            },
            "large": {
                "n_sheep": 1000, "n_wolves": 500, "regrowth": 10, "sheep_reproduction": 0.4,
                "wolf_reproduction": 0.2, "world_size": 100,
            },
        },
        lambda of, seed: mesa.WolvesAndSheep(
            of["world_size"], of["n_sheep"], of["n_wolves"], of["regrowth"],
            (of["sheep_reproduction"], of["wolf_reproduction"]), seed,
        ),
        {"small": 28, "large": 23},
        73,
    ),
    "flocking": Classic(
        "flocking",
        100,
        {
            "small": {"n_birds": 200, "world_size": 100, "sight": 5.0},
            "large": {"n_birds": 400, "world_size": 150, "sight": 15.0},
        },
        lambda of, seed: mesa.Flocking(of["world_size"], of["n_birds"], of["sight"], seed),
        {"small": 218, "large": 165},
        42,
    ),
    "schelling": Classic(
        "Schelling",
        20,
        {
            "small": {"n_agents": 1000, "world_size": 40, "radius": 1, "minimum": 3},
            "large": {"n_agents": 8000, "world_size": 100, "radius": 2, "minimum": 8},
        },
        lambda of, seed: mesa.Segregation(
            of["world_size"], of["n_agents"], of["radius"], of["minimum"], seed
        ),
        {"small": 49, "large": 45},
        26,
    ),
}  # fmt: skip


def seconds(work: Callable[[], Any]) -> float:
    """Seconds that some work takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def rounds(name: str, size: str, ticks: int, seeds: int, mesa_seeds: int) -> dict[str, Any]:
    """Time runs of a model, and some of Mesa's between them.

    Returns:
        Seconds of each run of ours, of each of Mesa's, and the ratios of their rounds.
    """
    model, classic = load_model(name), CLASSICS[name]
    parameters = classic.sizes[size]

    def ours(seed: int) -> float:
        return seconds(lambda: model(seed=seed, **parameters).advance(ticks))

    def theirs(seed: int) -> float:
        return seconds(lambda: classic.mesa(parameters, seed).run(ticks))

    for seed in range(3):  # the first societies of a class compile
        ours(seeds + seed)
    found: dict[str, Any] = {"ours": [], "mesa": [], "ratio": []}
    with_mesa = {seeds * number // mesa_seeds for number in range(mesa_seeds)}
    for seed in range(seeds):
        first = theirs(seed) if seed in with_mesa and len(found["mesa"]) % 2 else None
        found["ours"].append(ours(seed))
        if seed in with_mesa:
            found["mesa"].append(theirs(seed) if first is None else first)
            found["ratio"].append(found["mesa"][-1] / found["ours"][-1])
    return found


def lines_of(path: Path) -> int:
    """Return how many lines of code the model of a file has.

    Without blanks, comments and docstrings, and without what is for the studio alone: `looks`, and
    the functions of `buttons`. The published ones draw nothing either.
    """
    text = path.read_text(encoding="utf-8")
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type not in BLANK:
            lines.update(range(token.start[0], token.end[0] + 1))
    tree = ast.parse(text)
    pressed = {name for node in ast.walk(tree) for name in buttons_of(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(
            node
        ):
            docstring = node.body[0]
            lines.difference_update(range(docstring.lineno, (docstring.end_lineno or 0) + 1))
        shown = isinstance(node, ast.FunctionDef) and node.name in {"looks", *pressed}
        if shown or buttons_of(node):
            lines.difference_update(range(node.lineno, (node.end_lineno or 0) + 1))
    return len(lines)


def buttons_of(node: ast.AST) -> list[str]:
    """Return the names of the functions that a declaration of buttons names."""
    if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Dict):
        return []
    if [one.id for one in node.targets if isinstance(one, ast.Name)] != ["buttons"]:
        return []
    return [one.id for one in node.value.values if isinstance(one, ast.Name)]


def bird_nanoseconds(birds: int, times: int) -> list[float]:
    """Return what a bird costs in a step, in nanoseconds, of some stretches of a run."""
    size = round((birds / DENSITY) ** 0.5)
    society = load_model("flocking")(seed=0, n_birds=birds, world_size=size)
    society.advance(1)
    ticks = max(2, 200_000 // birds)
    return [1e9 * seconds(lambda: society.advance(ticks)) / (ticks * birds) for _ in range(times)]


def measure(
    seeds: int, mesa_seeds: int, birds: tuple[int, ...] = BIRDS, ticks: int | None = None
) -> dict:
    """Do all measurements.

    Args:
        seeds: runs of each model and size.
        mesa_seeds: those of them that Mesa runs as well.
        birds: numbers of birds whose cost is measured.
        ticks: length of a run; the comparison's if it is not given.
    """
    runs = {}
    for name, classic in CLASSICS.items():
        for size in classic.sizes:
            print(f"{classic.title}, {size} …", flush=True)
            length = ticks or classic.ticks
            runs[f"{name} {size}"] = rounds(name, size, length, seeds, mesa_seeds)
    print("birds …", flush=True)
    return {
        "machine": describe_machine("numba", "numpy", "mesa"),
        "seeds": seeds,
        "mesa_seeds": mesa_seeds,
        "ticks": {name: ticks or classic.ticks for name, classic in CLASSICS.items()},
        "seconds": runs,
        "lines": {name: lines_of(load_model(name).folder() / "model.py") for name in CLASSICS},
        "bird_nanoseconds": {str(count): bird_nanoseconds(count, 5) for count in birds},
    }


def table(results: dict) -> str:
    """The results as tables in Markdown."""
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, {machine['system']}; Python "
        f"{machine['python']}, numba {machine['numba']}, Mesa {machine['mesa']}; "
        f"{results['seeds']} seeds, {results['mesa_seeds']} of them with Mesa; one core. Medians, "
        "and the least – the greatest.",
        "",
        "| | socialmind (ms) | | Mesa (ms) | | times as fast as Mesa | | Ark.jl, as published |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, classic in CLASSICS.items():
        for size in classic.sizes:
            found = results["seconds"][f"{name} {size}"]
            ours, theirs = ([1000 * one for one in found[who]] for who in ("ours", "mesa"))
            cells = (spread(ours, ",.2f"), spread(theirs, ",.0f"), spread(found["ratio"], ",.0f"))
            title = f"{classic.title}, {size}, {results['ticks'][name]} steps"
            lines.append(f"| {title} | {' | '.join(cells)} | {classic.ark[size]} |")
    lines += ["", "| lines | of the model | the fewest published |", "|---|---|---|"]
    for name, classic in CLASSICS.items():
        lines.append(f"| {classic.title} | {results['lines'][name]} | {classic.lines} |")
    lines += ["", "| birds | a bird and step (ns) | least – greatest |", "|---|---|---|"]
    for count, values in results["bird_nanoseconds"].items():
        lines.append(f"| {int(count):,} | {spread(values, ',.0f')} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100, help="runs of each model and size")
    parser.add_argument("--mesa-seeds", type=int, default=5, help="those that Mesa runs as well")
    parser.add_argument("--full", action="store_true", help="up to a million birds")
    parser.add_argument("--out", type=Path, default=HERE, help="folder of README and JSON file")
    arguments = parser.parse_args()
    if not 1 <= arguments.mesa_seeds <= arguments.seeds:
        parser.error("at least one seed with Mesa, and no more than all")
    birds = BIRDS + (MANY_BIRDS if arguments.full else ())
    results = measure(arguments.seeds, arguments.mesa_seeds, birds)
    write(results, table, "classics", arguments.out)
    print(table(results))


if __name__ == "__main__":
    main()
