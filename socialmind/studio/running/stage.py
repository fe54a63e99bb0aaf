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
from pathlib import Path
from typing import Any

from coglogo_py import CogLogoError
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError, nearest
from socialmind.interventions.change import Change
from socialmind.interventions.edit import Edit
from socialmind.interventions.following import Intervention
from socialmind.interventions.shock import Shock
from socialmind.interventions.steer import Steer
from socialmind.learning.imprinting.steered import recording_of
from socialmind.model import Model
from socialmind.runs.capsule import Capsule
from socialmind.society.settings import sorted_out
from socialmind.studio.learning.acting import best_so_far
from socialmind.studio.running.hierarchies import laid_out, traced
from socialmind.studio.running.history import History
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.moment import Shown, frame_of
from socialmind.studio.running.outline import outline_of_model, outline_of_society
from socialmind.studio.running.plots import panel_of, table_of
from socialmind.studio.running.supposing import supposed
from socialmind.studio.running.turns import Turn
from socialmind.studio.running.watching import watched
from socialmind.studio.schemes.checking import Bearers, continued, runnable_of, same_minds
from socialmind.studio.schemes.document import document_of

SAID, FRAME = b"s", b"f"
"""The first byte of what is sent."""
FRAME_SECONDS = 1 / 30
EARLY_SECONDS = 1 / 200
"""How much earlier than its time a frame may go, so that it need not wait for the piece after."""
PIECE_SECONDS = 1 / 60
"""Length aimed at for one piece of ticks: commands wait for it."""
MOST_PLOTS = 8
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
        self._seen_alive = 0
        self._plots: list[dict[str, Any]] = []
        self._turn: tuple[Model, Turn] | None = None
        self._compiled = False
        self.running = self._together = False
        self._pace: int | str | None = 1
        self._piece = 1
        self._rate = 0.0
        self._wanted = False
        self._changed = False
        self._length = 0
        self._source = ""
        self._plans: dict[str, tuple[Any, dict[str, Any]]] = {}
        self._plans_due = False
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
            self.running = self._together = False
            self._say("error", of=name, text=str(error))

    def do_setup(
        self,
        model: str,
        seed: int | str = 0,
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
        self._begin(LiveRun(model_class(seed=int(seed), scheme=scheme, **(parameters or {}))))

    def do_open(self, folder: str, tick: int = 0, source: str | None = None) -> None:
        """Show the run that a folder holds, to be gone through.

        Args:
            folder: the run's.
            tick: to go to first.
            source: the name by which the model is set up again; that of the run's by default.
        """
        self.running = False
        self._say("busy", text="opening the run")
        capsule = Capsule(folder)
        run = LiveRun.of_folder(folder)
        kind = type(run.society)
        self._source = source or str(capsule.manifest.model["name"])
        self._say_model(kind)
        if tick:
            self._prepare(run)
            run.go_to(tick)
        self._begin(run, capsule.manifest.ticks_done)

    def do_reset(self) -> None:
        """Go back to the start, with the same seed and parameters and nothing done by hand."""
        self.running = False
        self._of().reset()
        self._begin(self._of())

    def _begin(self, run: LiveRun, length: int = 0) -> None:
        if run is not self._run:
            self._compiled, self._plots = False, []
        self._run = run
        self._turn = None
        self._length = length
        self._history = History()
        self._shown = Shown.of(run.society)
        self._watched = None
        self._told = run.society
        self._plans_due = bool(run.society.assemblies)
        self._note()
        self._say("society", **self._outline())
        self._changed = True

    def do_go(self) -> None:
        """Let it run until it is told otherwise."""
        self.running = True
        self._next_piece = time.perf_counter()

    def do_pause(self) -> None:
        """Let it stand."""
        self.running = self._together = False
        self._changed = self._run is not None

    def do_step(self, ticks: int = 1, together: bool = False) -> None:
        """Run some ticks, and stand.

        Args:
            ticks: how many.
            together: whether it is one of several that go on together, and more are to come.
        """
        self.running, self._together = False, together
        run = self._of()
        self._prepare(run)
        begin, before = time.perf_counter(), run.tick
        run.advance(int(ticks))
        self._turn = None
        self._pass(run.tick - before, max(time.perf_counter() - begin, FRAME_SECONDS))
        self._note()
        over = bool(run.society.stopped)
        if over:
            self._say("over", why=run.society.over)
        self._say("stood", tick=run.tick, over=over)

    def do_turn(self) -> None:
        """Let the next agent have its turn, and stand within the tick."""
        self.running = False
        self._take_turn()

    def do_pace(self, ticks: int | str | None) -> None:
        """Set the ticks between two frames; "turn", an agent's turn; None, as fast as possible."""
        self._pace = ticks if ticks is None or ticks == "turn" else max(1, int(ticks))

    def do_go_to(self, tick: int) -> None:
        """Show the society as it was at another tick, or will be."""
        self.running = False
        self._prepare(self._of())
        self._say("preparing", text="going there")
        try:
            self._of().go_to(max(0, int(tick)))
        finally:
            self._say("preparing", text="")
        self._turn = None
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
        self._seen_alive = 0
        self._changed = True

    def do_trace(self, population: str, id: int, ticks: int) -> None:
        """Say how an agent's hierarchy went in the last ticks."""
        found = traced(self._of(), population, int(id), ticks)
        self._say("trace", population=population, id=int(id), **found)

    def do_plots(self, panels: list[dict[str, Any]]) -> None:
        """Send what these panels show of the agents with each frame (`plots.Panel`)."""
        for panel in panels:
            panel_of(self._of().society, panel)  # refuses what there is not
        others = [one for one in self._plots if one not in panels]  # of other pages
        self._plots = [*others, *panels][-MOST_PLOTS:]
        self._changed = True

    def do_table(self, panel: Mapping[str, Any]) -> None:
        """Say what a panel shows as a table, whole."""
        from socialmind.documents.labels import units_recorded

        run = self._of()
        columns = table_of(run.society, panel, self._history.columns())
        kind = type(run.society)
        units = units_recorded(kind)
        self._say("table", columns=columns, model=kind.name, tick=run.tick, units=units)

    def do_suppose(self, population: str, id: int, part: str, value: Any) -> None:
        """Say what an agent would decide if a value were another; nothing changes."""
        edit = Edit(self._of().tick, population, id, part, value)
        self._say("supposed", **supposed(self._of().society, edit))

    def do_press(self, button: str) -> None:
        """Do what a button of the model's own does."""
        buttons = type(self._of().society).buttons
        if button not in buttons:
            raise SocialmindError(f"no button {button!r}; {nearest(button, buttons)}")
        self._intervene(Shock(self._of().tick, buttons[button]))

    def do_set(self, **settings: Any) -> None:
        """Change parameters, or parts of schemes by their words, from the next tick on."""
        run = self._of()
        kind, schemes = type(run.society), run.society.schemes
        sorted_settings = sorted_out(kind, settings)
        words = sorted_settings.changed(schemes, run.society.populations)
        self._intervene(Change(run.tick, sorted_settings.parameters, words))

    def do_act(self, folder: str, attempt: int, seed: int = 0) -> None:
        """Let the best that a training has found so far act in a world of its lesson."""
        self.running = False
        self._say("busy", text="loading what was learned")
        best = best_so_far(folder, attempt)
        society = best.society(seed)
        kind = type(society)
        self._source = kind.name
        self._say_model(kind)
        self._begin(LiveRun(society))
        said = {name: getattr(best, name) for name in ("attempt", "lesson", "generation", "score")}
        self._say("acting", **said, ticks=best.ticks, seed=seed)

    def do_steer(self, population: str, id: int, commands: list[float] | None) -> None:
        """Tell a robot what to do, until something else is told; None, give it back to its mind."""
        told = None if commands is None else tuple(commands)
        self._intervene(Steer(self._of().tick, population, id, told))

    def do_imprint(self, population: str, skill: str, folder: str) -> None:
        """Write what a skill was shown by steering as a table for imprinting."""
        run = self._of()
        self._say("busy", text="writing")
        society, interventions = run.repeated()
        shown, about = recording_of(society, interventions, run.tick, skill, population)
        shown.write(folder, about)
        self._say("saved", folder=folder, records=len(shown))

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
        self._turn = None
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
        made, home = self._of().save(folder, every), Path.cwd()
        self._say(
            "saved", folder=str(made.relative_to(home) if made.is_relative_to(home) else made)
        )

    def do_copy(self, folder: str) -> None:
        """Make the run up to here as a folder, for another stage to open."""
        run = self._of()
        run.save(folder)
        self._say("copied", folder=folder, tick=run.tick, source=self._source)

    def do_join(self) -> None:
        """Tell somebody new all that was said so far."""
        if self._run is not None:
            self._say_model(type(self._run.society))
            self._say("society", **self._outline())
            self._plans_due = bool(self._run.society.assemblies)
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
        if self._changed and self._wanted and now >= self._next_frame - EARLY_SECONDS:
            self._send_frame()
            self._next_frame = max(now, self._next_frame + FRAME_SECONDS)
        elif self._plans_due and not self._changed:
            self._say_plans()
        due = [self._next_piece] if self.running else []
        if self._changed and self._wanted:
            due.append(self._next_frame - EARLY_SECONDS)
        if not due:
            return 0.0 if self._plans_due and not self._changed else None
        return max(0.0, min(due) - time.perf_counter())

    def _go_piece(self, now: float) -> None:
        run = self._of()
        self._prepare(run)
        before, now = run.tick, time.perf_counter()
        try:
            if self._pace == "turn":
                self._take_turn()
            else:
                run.advance(self._piece if self._pace is None else int(self._pace))
                self._turn = None
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
        self._pass(done, took if self._pace is None else max(took, FRAME_SECONDS))
        if now >= self._next_row or self._pace is not None:
            self._note()
            self._next_row = now + ROW_SECONDS
        if run.society.stopped:
            self.running = False
            self._note()
            self._say("over", why=run.society.over)

    def _pass(self, ticks: int, seconds: float) -> None:
        """Note how fast time passes."""
        self._rate += 0.1 * (ticks / seconds - self._rate)
        self._changed = True

    def _take_turn(self) -> None:
        run = self._of()
        self._turn = run.turn()
        if self._turn is None:
            self._note()
        self._changed = True

    def _prepare(self, run: LiveRun) -> None:
        """Compile the rules before the first tick: it takes a while, which is to be said."""
        if self._compiled:
            return
        self._compiled = True
        self._say("preparing", text="compiling the rules")
        try:
            run.society.engine.compile()
        finally:
            self._say("preparing", text="")

    def _note(self) -> None:
        run = self._of()
        row = self._history.note(run.tick, run.society.series())
        if row is not None:
            self._say("row", **row)

    def _send_frame(self) -> None:
        run, self._changed = self._of(), False
        running = self.running or self._together
        said: dict[str, Any] = {
            "running": running,
            "furthest": max(run.furthest, self._length),
            "rate": self._rate if running else 0.0,
        }
        society = run.society
        if society is not self._told:  # an intervention was met, or gone back behind
            self._told = society
            self._say("changed", token=0, **self._changing())
        if self._turn is not None:
            society, turn = self._turn
            said["turn"] = vars(turn)
        if self._watched is not None:
            said["watched"] = self._look_inside(run, society, *self._watched)
        try:
            plots = [panel_of(society, one) for one in self._plots]
            frame = frame_of(society, self._shown, plots, FRAME, **said)
        except SocialmindError as error:
            self.running = False
            self._say("error", of="frame", text=str(error))
            return
        self._send(frame)
        self._wanted = False

    def _look_inside(
        self, run: LiveRun, society: Model, population: str, agent: int
    ) -> dict[str, Any]:
        """Return all that a watched agent is, or what became of it."""
        table = society.tables.get(population)
        if table is not None and table.contains(agent):
            self._seen_alive = run.tick
            return watched(society, population, agent)
        one = f"{population.replace('_', ' ')} {agent}"
        died = None
        if table is not None and self._seen_alive:
            died = run.death_of(population, agent, min(self._seen_alive, run.tick))
        if died is None:
            return {"gone": f"{one} does not live at tick {run.tick}"}
        return {"gone": f"{one} died at tick {died}; below, as it was last seen"}

    def _say_plans(self) -> None:
        """Say where hierarchies are drawn, once the society was seen: it takes its time."""
        self._plans_due = False
        society = self._of().society
        minded = {name: one for name, one in society.assemblies.items() if society.tables[name]}
        for name, assembly in minded.items():
            if self._plans.get(name, (None,))[0] is not assembly:
                self._plans[name] = assembly, laid_out(society, name)
        said = {name: self._plans[name][1] for name in minded}
        self._say("hierarchies", plans=said)

    def _outline(self) -> dict[str, Any]:
        society = self._of().society
        return {
            **outline_of_society(society),
            "seed": str(society.seed),  # a page's numbers have but 53 bits
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
