"""The command line: `socialmind list, run, sweep, fit, branch, learn, score, plot, check, …`.

The commands stand in `socialmind.commands`, the small ones here. What they work with is imported
when they run, so that a run starts fast. What the user can put right goes to stderr in one line,
with exit code 2.
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

from socialmind.commands import papers, running
from socialmind.commands.console.options import FROM_0, Folder, Source, Trust, is_kept
from socialmind.commands.console.terminal import (
    open_what_is_closed,
    quoted,
    silence_what_is_broken,
    write_plainly,
)
from socialmind.commands.experiments.branching import branch
from socialmind.commands.experiments.comparing import compare
from socialmind.commands.experiments.fitting import fit
from socialmind.commands.experiments.scoring import score
from socialmind.commands.experiments.sensitivity import sensitivity
from socialmind.commands.experiments.sweeping import sweep
from socialmind.commands.exporting import export_scheme
from socialmind.commands.importing import import_
from socialmind.commands.learning import learn
from socialmind.commands.plotting import plot
from socialmind.commands.rendering import render
from socialmind.commands.watching import studio
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

    app.command(name=function.__name__.rstrip("_").replace("_", "-"))(reporting)
    return reporting


def _report(error: BaseException) -> int:
    """Say what was wrong and give the exit code; raise what is no user's doing."""
    from socialmind.commands.console.stopping import exit_code_of_stop

    if isinstance(error, KeyboardInterrupt):
        return exit_code_of_stop(error)
    if isinstance(error, BrokenPipeError):
        silence_what_is_broken()
        return BROKEN_PIPE
    if isinstance(error, OSError):
        place = f"{error.filename}: " if error.filename else ""
        message = f"{place}{error.strerror or error}"
    elif isinstance(error, MemoryError):
        from socialmind.commands.console.stopping import what_memory_lacked

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


for one in (
    running.run, studio, sweep, sensitivity, fit, branch, compare, learn, score, plot, render,
    running.replay, import_, export_scheme,
):  # fmt: skip
    command(one)


for paper in (papers.odd, papers.methods, papers.export, papers.draw):
    command(paper)


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

    print_decision(folder, agent, tick, trust, is_kept(source))


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
    overview: Annotated[
        bool,
        typer.Option("--overview", help="Put the thesis's results beside ours, from kept tables."),
    ] = False,
) -> None:
    """Make figures and tables of the thesis again: PDF, PNG and the numbers as CSV."""
    from socialmind.commands.experiments import reproducing

    if list_names:
        reproducing.print_studies()
    elif overview:
        reproducing.make_overview(names or [], out, quick or kept)
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


def _as_path(folder: Path) -> str:
    """A folder as `socialmind run` takes it for a path and not for a model's name."""
    return quoted(folder if len(folder.parts) > 1 else f"./{folder}")


def _one_line(
    message: Warning | str, category: object = None, file: str = "", line: int = 0, *_: object
) -> str:
    """A warning as the command line shows it: with a line of the user's, none of the program's."""
    own = file.startswith(str(Path(__file__).parents[1])) or "site-packages" in file
    return f"socialmind: {message}\n" if own else f"socialmind: {file}:{line}: {message}\n"


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
