"""The process in which a society runs: it hears commands, and sends frames as they are wanted.

Commands are JSON objects with a key ``do``; what is sent is JSON with a key ``said``, or a frame
behind one byte. The simulation never waits for a frame to be seen: one is made only when the last
has been asked for anew, thirty times a second at most.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any

from coglogo_py import CogLogoError
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.interventions.change import Change
from socialmind.interventions.edit import Edit
from socialmind.interventions.following import Intervention
from socialmind.model import Model
from socialmind.runs.capsule import Capsule
from socialmind.society.settings import sorted_out
from socialmind.studio.running.history import History
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.moment import Shown, frame_of
from socialmind.studio.running.outline import outline_of_model, outline_of_society
from socialmind.studio.running.watching import watched
from socialmind.studio.schemes.checking import Bearers, continued, runnable_of, same_minds
from socialmind.studio.schemes.document import document_of

SAID, FRAME = b"s", b"f"
"""The first byte of what is sent."""
FRAME_SECONDS = 1 / 30
PIECE_SECONDS = 1 / 60
"""Length aimed at for one piece of ticks: commands wait for it."""
ROW_SECONDS = 0.05
"""Seconds between two rows of the series while it runs."""


class Stage:
    """A society under command.

    Args:
        send: takes what is to be sent.
    """

    def __init__(self, send: Callable[[bytes], None]) -> None:
        self._send = send
        self._run: LiveRun | None = None
        self._history = History()
        self._shown = Shown()
        self._watched: tuple[str, int] | None = None
        self._told: Model | None = None
        """The society whose parameters and schemes were said."""
        self.running = False
        self._pace: int | None = 1
        self._piece = 1
        self._rate = 0.0
        self._wanted = False
        self._changed = False
        self._length = 0
        self._source = ""
        self._next_frame = self._next_piece = self._next_row = 0.0

    # Commands ---------------------------------------------------------------------------------

    def do(self, command: Mapping[str, Any]) -> None:
        """Carry out a command; what is wrong with it is said."""
        name = str(command.get("do"))
        try:
            action = getattr(self, f"do_{name}", None)
            if action is None:
                raise SocialmindError(f"no command {name!r}")
            action(**{key: value for key, value in command.items() if key != "do"})
        except (SocialmindError, TypeError, ValueError) as error:
            self.running = False
            self._say("error", of=name, text=str(error))

    def do_setup(
        self,
        model: str,
        seed: int = 0,
        parameters: Mapping[str, Any] | None = None,
        scheme: Any = None,
        documents: Mapping[str, Any] | None = None,
    ) -> None:
        """Begin a society, before its first tick; `documents` are edited schemes by population."""
        self.running = False
        self._say("busy", text=f"making {model}")
        model_class = load_model(model)
        self._source = model
        self._say_model(model_class)
        if documents:
            scheme = {
                name: runnable_of(one, Bearers.of(model_class, name))
                for name, one in documents.items()
            }
        self._begin(LiveRun(model_class(seed=seed, scheme=scheme, **(parameters or {}))))

    def do_open(self, folder: str) -> None:
        """Show the run that a folder holds, to be gone through."""
        self.running = False
        self._say("busy", text=f"opening {folder}")
        capsule = Capsule(folder)
        run = LiveRun.of_folder(folder)
        kind = type(run.society)
        self._source = kind.name
        self._say_model(kind)
        self._begin(run, capsule.manifest.ticks)

    def _begin(self, run: LiveRun, length: int = 0) -> None:
        self._run = run
        self._length = length
        self._history = History()
        self._shown = Shown.of(run.society)
        self._watched = None
        self._told = run.society
        self._note()
        self._say("society", **self._outline())
        self._changed = True

    def do_go(self) -> None:
        """Let it run until it is told otherwise."""
        self.running = True
        self._next_piece = time.perf_counter()

    def do_pause(self) -> None:
        """Let it stand."""
        self.running = False
        self._changed = True

    def do_step(self, ticks: int = 1) -> None:
        """Run some ticks, and stand."""
        self.running = False
        self._of().advance(int(ticks))
        self._note()
        self._changed = True

    def do_pace(self, ticks: int | None) -> None:
        """Set the ticks between two frames; None, as fast as possible."""
        self._pace = None if ticks is None else max(1, int(ticks))

    def do_go_to(self, tick: int) -> None:
        """Show the society as it was at another tick, or will be."""
        self.running = False
        self._of().go_to(max(0, int(tick)))
        self._note()
        self._changed = True

    def do_show(self, **what: Any) -> None:
        """Colour agents or patches by something else."""
        shown = Shown(**{**vars(self._shown), **what})
        frame_of(self._of().society, shown)  # refuses what there is not
        self._shown = shown
        self._changed = True

    def do_watch(self, population: str | None = None, id: int | None = None) -> None:
        """Look inside an agent from now on, or inside nobody."""
        self._watched = None if population is None or id is None else (population, int(id))
        self._changed = True

    def do_set(self, **settings: Any) -> None:
        """Change parameters, or parts of schemes by their words, from the next tick on."""
        run = self._of()
        kind, schemes = type(run.society), run.society.schemes
        sorted_settings = sorted_out(kind, settings)
        words = sorted_settings.changed(schemes, run.society.populations)
        self._intervene(Change(run.tick, sorted_settings.parameters, words))

    def do_edit(self, population: str, id: int, part: str, value: Any) -> None:
        """Change a value of an agent by hand."""
        self._intervene(Edit(self._of().tick, population, id, part, value))

    def do_rescheme(self, population: str, document: Any, token: int = 0) -> None:
        """Give the minds of a population an edited scheme; who has the same one gets it too.

        The society goes on if it does not fit: that is said with the `token` of the page.
        """
        run = self._of()
        schemes = run.society.schemes
        try:
            edited = runnable_of(document, Bearers.of(type(run.society), population))
            scheme = continued(edited, schemes[population])
            named = {name: scheme for name, one in schemes.items() if one == schemes[population]}
            if same_minds(scheme, schemes[population]):
                self._say("changed", token=token, **self._changing())
            else:
                self._intervene(Change(run.tick, {}, named), token)
        except (SocialmindError, CogLogoError) as error:
            self._say("unfit", token=token, text=str(error))

    def _intervene(self, intervention: Intervention, token: int = 0) -> None:
        run = self._of()
        run.intervene(intervention)
        self._length = 0
        self._history.forget_after(run.tick)
        self._say("forgotten", after=run.tick)
        self._told = run.society
        self._say("changed", token=token, **self._changing())
        self._changed = True

    def _changing(self) -> dict[str, Any]:
        """Return what interventions change in a society."""
        society = self._of().society
        schemes = {name: document_of(one) for name, one in society.schemes.items()}
        return {"parameters": society.parameter_values(), "schemes": schemes}

    def do_save(self, folder: str | None = None, every: int | None = None) -> None:
        """Make the run up to here as a folder."""
        self._say("busy", text="saving")
        self._say("saved", folder=str(self._of().save(folder, every)))

    def do_join(self) -> None:
        """Tell somebody new all that was said so far."""
        if self._run is not None:
            self._say_model(type(self._run.society))
            self._say("society", **self._outline())
            self._changed = True

    def do_seen(self) -> None:
        """Note that another frame is wanted."""
        self._wanted = True

    # What goes on -----------------------------------------------------------------------------

    def go_on(self) -> float | None:
        """Run a piece, and send what is due.

        Returns:
            Seconds until there is something to do again; None, until a command comes.
        """
        now = time.perf_counter()
        if self.running and now >= self._next_piece:
            self._go_piece(now)
            now = time.perf_counter()
        if self._changed and self._wanted and now >= self._next_frame:
            self._send_frame()
            self._next_frame = now + FRAME_SECONDS
        if self.running:
            return max(0.0, self._next_piece - time.perf_counter())
        if self._changed and self._wanted:
            return max(0.0, self._next_frame - time.perf_counter())
        return None

    def _go_piece(self, now: float) -> None:
        run = self._of()
        before = run.tick
        try:
            run.advance(self._piece if self._pace is None else self._pace)
        except Exception as error:  # a rule's: the society stands where it failed
            self.running = False
            self._say("error", of="go", text=str(error))
        took = max(time.perf_counter() - now, 1e-9)
        done = run.tick - before
        if self._pace is None:
            self._next_piece = now
            self._piece = max(1, min(int(done / took * PIECE_SECONDS), 4 * self._piece))
        else:
            self._next_piece = max(now, self._next_piece + FRAME_SECONDS)
        span = took if self._pace is None else max(took, FRAME_SECONDS)
        self._rate += 0.1 * (done / span - self._rate)
        if now >= self._next_row or self._pace is not None:
            self._note()
            self._next_row = now + ROW_SECONDS
        if run.society.stopped:
            self.running = False
            self._note()
            self._say("over", why=run.society.over)
        self._changed = True

    def _note(self) -> None:
        run = self._of()
        row = self._history.note(run.tick, run.society.series())
        if row is not None:
            self._say("row", **row)

    def _send_frame(self) -> None:
        run = self._of()
        said: dict[str, Any] = {
            "running": self.running,
            "furthest": max(run.furthest, self._length),
            "rate": self._rate if self.running else 0.0,
        }
        if self._watched is not None:
            try:
                said["watched"] = watched(run.society, *self._watched)
            except SocialmindError as error:
                said["watched"] = {"gone": str(error)}
        if run.society is not self._told:  # an intervention was met, or gone back behind
            self._told = run.society
            self._say("changed", token=0, **self._changing())
        self._send(FRAME + frame_of(run.society, self._shown, **said))
        self._wanted = self._changed = False

    def _outline(self) -> dict[str, Any]:
        society = self._of().society
        return {
            **outline_of_society(society),
            "seed": society.seed,
            **self._changing(),
            "shown": vars(self._shown),
            "history": self._history.columns(),
        }

    def _say_model(self, kind: type[Model]) -> None:
        """Say what a model declares, and by which name it is set up again."""
        self._say("model", **outline_of_model(kind), source=self._source)

    def _of(self) -> LiveRun:
        if self._run is None:
            raise SocialmindError("no society; set one up first")
        return self._run

    def _say(self, what: str, **said: Any) -> None:
        self._send(SAID + json.dumps({"said": what, **said}, default=str).encode())


def perform(connection: Connection) -> None:
    """Be a stage until the other end of a connection closes.

    Args:
        connection: for commands in, and what is sent out.
    """
    stage = Stage(connection.send_bytes)
    wait: float | None = None
    try:
        while True:
            while connection.poll(wait):
                stage.do(json.loads(connection.recv_bytes()))
                wait = 0.0
            wait = stage.go_on()
    except (EOFError, BrokenPipeError, ConnectionResetError, KeyboardInterrupt):
        return
