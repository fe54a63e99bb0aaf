"""The command line: `socialmind list, run, learn, score, plot, render, replay, check, explain, …`.

This file says what the commands take; `socialmind.commands` does the work and is imported by the
command that needs it, so that a run starts fast. What the user can put right goes to stderr in
one line, with exit code 2.
"""

from __future__ import annotations

import sys

if __name__ == "__main__":  # `python -m socialmind.cli`: Ctrl-C may come while this is being read
    from socialmind.__main__ import main as start

    start()
    sys.exit()

import warnings
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Annotated, Any

import typer

from socialmind.commands.terminal import (
    open_what_is_closed,
    quoted,
    silence_what_is_broken,
    write_plainly,
)
from socialmind.commands.whole_option import LARGEST_SEED, whole
from socialmind.errors import IdleWarning, SocialmindError
from socialmind.version import __version__

WRONG = 2
BROKEN_PIPE = 141

app = typer.Typer(
    name="socialmind",
    help="A laboratory for societies of agents.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def _say_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"socialmind {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Say which version this is.", callback=_say_version, is_eager=True
        ),
    ] = False,
) -> None:
    """Take what stands before a command."""


Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A run's folder.", show_default=False)]
Source = Annotated[
    str | None,
    typer.Option(metavar="kept", help="Take the copies of the model's source that the run keeps."),
]
Trust = Annotated[
    bool,
    typer.Option("--trust", help="Run programs that you have neither named nor run before."),
]
FROM_0: dict[str, Any] = {"metavar": "N", "parser": whole(0)}
FROM_1: dict[str, Any] = {"metavar": "N", "parser": whole(1)}
SEED: dict[str, Any] = {"metavar": "N", "parser": whole(0, LARGEST_SEED)}
"""Options that are whole numbers, from 0, from 1, and of a seed: 0 … 2⁶⁴ − 1."""
Quiet = Annotated[bool, typer.Option("--quiet", help="Say nothing but the result.")]


def command(function: Callable[..., None]) -> Callable[..., None]:
    """Make a function a command whose errors are one line on stderr."""

    @wraps(function)
    def reporting(*args: Any, **options: Any) -> None:
        try:
            function(*args, **options)
            sys.stdout.flush()
        except (SocialmindError, ValueError, OSError, MemoryError, KeyboardInterrupt) as error:
            try:
                code = _report(error)
            except OSError:  # nobody reads messages either
                silence_what_is_broken()
                code = BROKEN_PIPE
            raise typer.Exit(code) from None

    app.command(name=function.__name__.rstrip("_"))(reporting)
    return reporting


def _report(error: BaseException) -> int:
    """Say what was wrong and give the exit code; raise what is no user's doing."""
    from socialmind.commands.stopping import exit_code_of_stop

    if isinstance(error, KeyboardInterrupt):
        return exit_code_of_stop(error)
    if isinstance(error, BrokenPipeError):
        silence_what_is_broken()
        return BROKEN_PIPE
    if isinstance(error, OSError):
        place = f"{error.filename}: " if error.filename else ""
        message = f"{place}{error.strerror or error}"
    elif isinstance(error, MemoryError):
        from socialmind.commands.stopping import what_memory_lacked

        message = what_memory_lacked(error)
    elif isinstance(error, SocialmindError) or type(error).__module__.startswith("coglogo_py"):
        message = str(error)
    else:
        raise error
    typer.echo(f"socialmind: {message}", err=True)
    return WRONG


@command
def list_(
    model: Annotated[
        str | None,
        typer.Argument(metavar="MODEL", help="A model's name, or its folder (all that ship)."),
    ] = None,
) -> None:
    """List models and their parameters; of one model also what it is made of and learns."""
    from socialmind.commands.listing import print_model, print_models

    if model is not None:
        print_model(model)
    elif not print_models():
        raise typer.Exit(WRONG)


@command
def run(
    model: Annotated[
        str | None,
        typer.Argument(metavar="MODEL", help="A model's name, or its folder."),
    ] = None,
    ticks: Annotated[int | None, typer.Option(**FROM_0, help="Length of the run.")] = None,
    seed: Annotated[int | None, typer.Option(**SEED, help="Seed of every draw (0).")] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Value of a parameter; may be repeated."),
    ] = None,
    scheme: Annotated[
        list[str] | None,
        typer.Option(metavar="[POPULATION=]FILE", help="Cognitive scheme in place of the model's."),
    ] = None,
    mind: Annotated[
        list[str] | None,
        typer.Option(
            metavar="[POPULATION=]DIR", help="Hierarchy of skills in place of the model's."
        ),
    ] = None,
    every: Annotated[
        int | None, typer.Option(**FROM_1, help="Ticks between two rows of the series (500 rows).")
    ] = None,
    agents_every: Annotated[
        int | None, typer.Option(**FROM_1, help="Ticks between two records of the agents.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Folder to make (a fresh one under runs/).")
    ] = None,
    figures: Annotated[bool, typer.Option("--figures", help="Draw the figures as well.")] = False,
    interpreted: Annotated[
        bool, typer.Option("--interpreted", help="Run in plain Python; slow, for debugging.")
    ] = False,
    engine: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="What moves bodies on a plane: compiled or pymunk (compiled)."
        ),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Go on with a run; --ticks makes a finished one longer."),
    ] = None,
    source: Source = None,
    trust: Trust = False,
    quiet: Quiet = False,
) -> None:
    """Run a model into a folder, or go on with a run."""
    from socialmind.commands import running

    if resume is None:
        if model is None:
            raise SocialmindError(
                "which model? give a name (`socialmind list` shows them) or a folder"
            )
        if source is not None:
            raise SocialmindError("--source is for --resume: a new run has no copies yet")
        folder = running.start(
            model, ticks, seed or 0, settings or [], scheme or [], mind or [],
            every, agents_every, out, compiled=not interpreted, quiet=quiet,
            engine=engine or "compiled",
        )  # fmt: skip
    else:
        fixed = {
            "MODEL": model, "--seed": seed, "--set": settings or None, "--scheme": scheme or None,
            "--mind": mind or None, "--every": every, "--agents-every": agents_every, "--out": out,
            "--engine": engine,
        }  # fmt: skip
        given = [name for name, value in fixed.items() if value is not None]
        if given:
            raise SocialmindError(
                f"--resume with {', '.join(given)}: a run keeps what it was started with; "
                "leave it out, or start another run"
            )
        folder = running.go_on(
            resume, ticks, compiled=False if interpreted else None, quiet=quiet,
            kept=_is_kept(source), trust=trust,
        )  # fmt: skip
    if figures:
        running.draw(folder, trust)
    typer.echo(folder)


@command
def learn(
    model: Annotated[
        str | None,
        typer.Argument(metavar="MODEL", help="A model's name, or its folder."),
    ] = None,
    lesson: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME|FILE", help="A lesson, or a .simbatch file (the curriculum)."),
    ] = None,
    attempts: Annotated[
        int | None, typer.Option(**FROM_1, help="Independent attempts (1).")
    ] = None,
    mind: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Mind to begin from (the model's).")
    ] = None,
    optimiser: Annotated[
        str | None, typer.Option(metavar="NAME", help="GENETIC, NEAT, ANNEALING or CMAES.")
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=NUMBER", help="Setting of optimisers; may repeat."),
    ] = None,
    generations: Annotated[
        int | None, typer.Option(**FROM_1, help="Generations of each lesson (the lesson's).")
    ] = None,
    ticks_budget: Annotated[
        int | None, typer.Option(**FROM_1, help="Ticks after which no generation begins.")
    ] = None,
    cycles: Annotated[
        int | None, typer.Option(**FROM_1, help="How often lessons in a cycle are taught.")
    ] = None,
    seed: Annotated[int | None, typer.Option(**SEED, help="Seed of every draw (0).")] = None,
    engine: Annotated[
        str | None, typer.Option(metavar="ENGINE", help="compiled (as by default) or pymunk.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option(**FROM_1, help="How many work side by side (one a core).")
    ] = None,
    cluster: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Work on a Dask cluster: tcp://HOST:8786.")
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder to make (a fresh one under trainings/)."),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Go on with a training; --attempts adds attempts."),
    ] = None,
    trust: Trust = False,
    quiet: Quiet = False,
) -> None:
    """Teach the mind of a model its lessons, or go on with a training."""
    from socialmind.commands import learning

    if resume is None:
        if model is None:
            raise SocialmindError("which model? give a name or a folder with a lessons.py")
        folder = learning.start(
            model, settings or [], quiet, lessons=lesson, mind=mind, attempts=attempts or 1,
            seed=seed or 0, out=out, engine=engine or "compiled", optimiser=optimiser,
            generations=generations, budget=ticks_budget, cycles=cycles, workers=workers,
            cluster=cluster,
        )  # fmt: skip
    else:
        fixed = {
            "MODEL": model, "--lesson": lesson or None, "--mind": mind, "--optimiser": optimiser,
            "--set": settings or None, "--generations": generations,
            "--ticks-budget": ticks_budget, "--seed": seed, "--engine": engine, "--out": out,
        }  # fmt: skip
        given = [name for name, value in fixed.items() if value is not None]
        if given:
            raise SocialmindError(
                f"--resume with {', '.join(given)}: a training keeps what it was started with; "
                "leave it out, or start another training"
            )
        folder = learning.go_on(
            resume, quiet, attempts=attempts, cycles=cycles, workers=workers, cluster=cluster,
            trust=trust,
        )  # fmt: skip
    typer.echo(folder)


@command
def score(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="A model's name, or its folder.")],
    mind: Annotated[
        list[str] | None,
        typer.Option(
            metavar="[POPULATION=]DIR", help="Hierarchy of skills in place of the model's."
        ),
    ] = None,
    episodes: Annotated[int, typer.Option(**FROM_1, help="How many, each in its own world.")] = 100,
    seed: Annotated[int, typer.Option(**SEED, help="Seed of the worlds.")] = 0,
    engine: Annotated[
        str, typer.Option(metavar="ENGINE", help="compiled or pymunk, the reference.")
    ] = "compiled",
    on_collision: Annotated[
        str | None,
        typer.Option(metavar="end|continue", help="Whether a collision ends a run (the model's)."),
    ] = None,
    ticks: Annotated[
        int | None, typer.Option(**FROM_1, help="Limit of an episode (the model's).")
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="Value of a parameter; may be repeated."),
    ] = None,
    workers: Annotated[
        int | None, typer.Option(**FROM_1, help="How many work side by side (one a core).")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
    quiet: Quiet = False,
) -> None:
    """Measure a model's minds in worlds that no training has seen, with intervals of 95 %."""
    from socialmind.commands import scoring

    scoring.print_score(
        model, mind or [], settings or [], json, quiet, episodes=episodes, seed=seed,
        engine=engine, on_collision=on_collision, ticks=ticks, workers=workers,
    )  # fmt: skip


@command
def plot(folder: Folder, trust: Trust = False) -> None:
    """Draw a run's figures, as PDF and PNG, under figures/ in its folder."""
    from socialmind.commands.running import draw

    for path in draw(folder, trust):
        typer.echo(path)


@command
def render(
    folder: Folder,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE", help="Film (.mp4, .gif) or picture (.svg, .pdf, .png) to write."
        ),
    ],
    tick: Annotated[
        list[int] | None,
        typer.Option(**FROM_0, help="Moment of a picture (the last); may be repeated, for rows."),
    ] = None,
    begin: Annotated[
        int | None, typer.Option("--from", **FROM_0, help="First tick of a film (0).")
    ] = None,
    end: Annotated[
        int | None, typer.Option("--to", **FROM_0, help="Last tick of a film (the run's).")
    ] = None,
    every: Annotated[
        int | None,
        typer.Option(**FROM_1, help="Ticks between two frames (for 900 frames, 300 of a GIF)."),
    ] = None,
    fps: Annotated[float | None, typer.Option(help="Frames a second (30, 20 for a GIF).")] = None,
    mind: Annotated[
        bool, typer.Option("--mind", help="Draw the robot's hierarchy of skills beside it.")
    ] = False,
    agent: Annotated[
        str | None,
        typer.Option(metavar="[POPULATION=]ID", help="Robot for --mind and --around (the first)."),
    ] = None,
    around: Annotated[
        float | None,
        typer.Option(metavar="DISTANCE", help="Show only what is so near to the robot."),
    ] = None,
    trail: Annotated[
        int | None,
        typer.Option(metavar="TICKS", parser=whole(0), help="Length of the path drawn (all)."),
    ] = None,
    look: Annotated[
        str | None,
        typer.Option(
            metavar="thesis|paper", help="Dark, or on white (films dark, pictures white)."
        ),
    ] = None,
    width: Annotated[
        int | None, typer.Option(**FROM_1, help="Width in pixels; of SVG and PDF in millimetres.")
    ] = None,
    source: Source = None,
    trust: Trust = False,
    quiet: Quiet = False,
) -> None:
    """Draw a run on a plane: robots, what they see, where they go; on request their minds."""
    from socialmind.commands import rendering

    path = rendering.render(
        folder, out, tick or [], begin, end, every, fps, look, mind, agent, around, trail, width,
        quiet, trust, _is_kept(source),
    )  # fmt: skip
    typer.echo(path)


@command
def replay(
    folder: Folder, source: Source = None, trust: Trust = False, quiet: Quiet = False
) -> None:
    """Run a run again and compare: exit code 0 when it comes out equal, 1 when not."""
    from socialmind.commands.running import again

    if not again(folder, quiet, _is_kept(source), trust):
        raise typer.Exit(1)


@command
def check(
    file: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="A scheme's file, a mind's folder or YAML, or a model's folder."
        ),
    ],
    trust: Annotated[
        bool, typer.Option("--trust", help="Check rules and programs as well, which runs them.")
    ] = False,
) -> None:
    """Check a scheme, a mind or a model: exit code 0 when nothing is odd, 1 when something is."""
    from socialmind.commands.checking import print_findings

    if print_findings(file, trust):
        raise typer.Exit(1)


@command
def explain(
    folder: Folder,
    agent: Annotated[
        int, typer.Option(**FROM_0, help="Identity of the agent.", show_default=False)
    ],
    tick: Annotated[int, typer.Option(**FROM_0, help="Tick of the decision.", show_default=False)],
    source: Source = None,
    trust: Trust = False,
) -> None:
    """Say how an agent of a run came to a decision."""
    from socialmind.commands.checking import print_decision

    print_decision(folder, agent, tick, trust, _is_kept(source))


@command
def reproduce(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]...", help="Figures, tables, or a whole topic."),
    ] = None,
    out: Annotated[Path, typer.Option(metavar="DIR", help="Folder for what is made.")] = Path(
        "figures"
    ),
    quick: Annotated[
        bool, typer.Option("--quick", help="Make a smaller version of what takes long.")
    ] = False,
    kept: Annotated[
        bool,
        typer.Option("--kept", help="Make what takes long from the results that are kept of it."),
    ] = False,
    list_names: Annotated[
        bool, typer.Option("--list", help="List what can be made, and make nothing.")
    ] = False,
) -> None:
    """Make figures and tables of the thesis again: PDF, PNG and the numbers as CSV."""
    from socialmind.commands import reproducing

    if list_names:
        reproducing.print_studies()
    else:
        reproducing.make(names or [], out, quick, kept)


@command
def new(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder to make.")],
) -> None:
    """Write a small model to start from."""
    from socialmind.commands.starting import write_model

    write_model(folder)
    typer.echo(f"{folder}: run it with `socialmind run {_as_path(folder)}`")


def _is_kept(source: str | None) -> bool:
    """Whether a run's own copies are asked for."""
    if source not in (None, "kept"):
        raise SocialmindError(f"--source {source}; expected kept, the run's own copies")
    return source == "kept"


def _as_path(folder: Path) -> str:
    """A folder as `socialmind run` takes it for a path and not for a model's name."""
    return quoted(folder if len(folder.parts) > 1 else f"./{folder}")


def _one_line(message: Warning | str, *_: object) -> str:
    """A warning as the command line shows it, without a line of the program's own."""
    return f"socialmind: {message}\n"


def main() -> None:
    """Entry point of the console script."""
    open_what_is_closed()
    write_plainly()
    # A run says at its end what its agents could not do, once for all of them.
    warnings.simplefilter("ignore", IdleWarning)
    warnings.formatwarning = _one_line  # type: ignore[assignment]
    try:
        app()
    except OSError as error:  # what `--help` and `--version` say found no room
        sys.exit(_report(error))
