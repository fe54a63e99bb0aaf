"""`socialmind studio`: a local page that shows a society while it runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from socialmind.commands.console import options
from socialmind.errors import SocialmindError


def studio(
    what: Annotated[
        str | None,
        typer.Argument(
            metavar="[MODEL|DIR]",
            help="A model to run, its folder or file, or a run's folder to go through.",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(**options.FROM_0, help="Key of all random draws.")] = 0,
    set_: options.Parameters = None,
    scheme: Annotated[
        Path | None, typer.Option(metavar="FILE", help="A scheme in place of the model's own.")
    ] = None,
    host: Annotated[
        str, typer.Option(help="Where to listen; elsewhere than here a token is asked for.")
    ] = "127.0.0.1",
    port: Annotated[
        int | None, typer.Option(min=0, max=65535, help="Port to listen at (8765, or a free one).")
    ] = None,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address, and open nothing.")
    ] = False,
) -> None:
    """Show a society while it runs, in the browser: press go, click an agent, look inside."""
    from socialmind.studio.launching import launch

    launch(_first(what, seed, set_ or [], scheme), host, port, browser=not no_browser)


def _first(
    what: str | None, seed: int, settings: list[str], scheme: Path | None
) -> dict[str, Any] | None:
    """Return the command by which the first page has something to show."""
    from socialmind.runs import folders
    from socialmind.society.settings import pair

    if what is None:
        return None
    if (Path(what) / folders.MANIFEST).is_file():
        if settings or scheme is not None or seed:
            raise SocialmindError(f"{what} is a run, which has its seed, parameters and schemes")
        return {"do": "open", "folder": what}
    if Path(what).is_file() and Path(what).suffix != ".py":
        raise SocialmindError(f"{what} is a file; expected a model (socialmind list) or a run")
    from socialmind.catalogue import load_model
    from socialmind.society.settings import sorted_out

    kind = load_model(what)
    parameters = sorted_out(kind, [pair(one) for one in settings]).parameters
    chosen = None if scheme is None else str(scheme)
    return {
        "do": "setup", "model": what, "seed": seed, "parameters": parameters, "scheme": chosen
    }  # fmt: skip
