"""A society that runs for pages: it goes on, and sends frames as they are wanted.

The simulation never waits for a frame to be seen: one is made only when the last has been asked for
anew, thirty times a second at most.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.interventions.following import Intervention
from socialmind.model import Model
from socialmind.studio.running.hierarchies import laid_out
from socialmind.studio.running.history import History
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.moment import Shown, frame_of
from socialmind.studio.running.outline import outline_of_model, outline_of_society
from socialmind.studio.running.plots import panel_of
from socialmind.studio.running.turns import Turn
from socialmind.studio.running.watching import watched
from socialmind.studio.schemes.document import document_of

SAID, FRAME = b"s", b"f"
"""The first byte of what is sent."""
FRAME_SECONDS = 1 / 30
EARLY_SECONDS = 1 / 200
"""How much earlier than its time a frame may go, so that it need not wait for the piece after."""
PIECE_SECONDS = 1 / 60
"""Length aimed at for one piece of ticks: commands wait for it."""
ROW_SECONDS = 0.05
"""Seconds between two rows of the series while it runs."""


class Stage:
    """A society under command; the commands are functions of it (`commands`).

    Args:
        send: takes what is to be sent.

    Attributes:
        source: the name by which the model is set up again.
        running: whether it goes on by itself.
        together: whether it goes on with others, by commands.
        pace: ticks between two frames; "turn", an agent's turn; None, as fast as possible.
        shown: what agents and patches are coloured by.
        plots: what panels of plots show, of all pages.
        history: the series so far.
        wanted: whether a page waits for a frame.
    """

    def __init__(self, send: Callable[[bytes], None]) -> None:
        self._send = send
        self.source = ""
        self.running = self.together = False
        self.pace: int | str | None = 1
        self.shown = Shown()
        self.plots: list[dict[str, Any]] = []
        self.history = History()
        self.wanted = False
        self._run: LiveRun | None = None
        self._length = 0
        """Ticks of the run that was opened, which may lie ahead."""
        self._compiled = False
        self._turn: tuple[Model, Turn] | None = None
        self._watched: tuple[str, int] | None = None
        self._seen_alive = 0
        self._told: Model | None = None
        """The society whose parameters and schemes were said."""
        self._plans: dict[str, tuple[Any, dict[str, Any]]] = {}
        self._plans_due = False
        self._changed = False
        """Whether there is something else to see than in the last frame."""
        self._piece = 1
        self._rate = 0.0
        self._next_frame = self._next_piece = self._next_row = 0.0

    @property
    def run(self) -> LiveRun:
        """What runs.

        Raises:
            SocialmindError: nothing does yet.
        """
        if self._run is None:
            raise SocialmindError("no society; set one up first")
        return self._run

    def begin(self, run: LiveRun, length: int = 0) -> None:
        """Show a run from now on.

        Args:
            run: where it is to be seen.
            length: how far it goes, if that is known.
        """
        if run is not self._run:
            self._compiled, self.plots = False, []
        self._run = run
        self._turn = None
        self._length = length
        self.history = History()
        self.shown = Shown.of(run.society)
        self._watched = None
        self._told = run.society
        self._note()
        self._say_society()

    def intervene(self, intervention: Intervention, token: int = 0) -> None:
        """Do something to the society; what lay ahead is forgotten.

        Args:
            intervention: at the tick where it stands.
            token: of the page that wants it.
        """
        run = self.run
        run.intervene(intervention)
        self._turn = None
        self._length = 0
        self.history.forget_after(run.tick)
        self.say("forgotten", after=run.tick)
        self._told = run.society
        self.say_changed(token)
        self._changed = True

    def watch(self, agent: tuple[str, int] | None) -> None:
        """Look inside an agent, by population and identity, or inside nobody."""
        self._watched = agent
        self._seen_alive = 0
        self._changed = True

    def show(self) -> None:
        """Send a frame when one is wanted: something looks otherwise."""
        self._changed = self._run is not None

    # What goes on -----------------------------------------------------------------------------

    def go(self) -> None:
        """Let it run until it is told otherwise."""
        self.running = True
        self._next_piece = time.perf_counter()

    def stand(self) -> None:
        """Let it run no longer."""
        self.running = self.together = False

    def step(self, ticks: int) -> None:
        """Run some ticks."""
        run = self.run
        self.prepare(run)
        begin, before = time.perf_counter(), run.tick
        run.advance(ticks)
        self._pass(run.tick - before, max(time.perf_counter() - begin, FRAME_SECONDS))
        self.moved()

    def moved(self) -> None:
        """Show that the society stands at another tick."""
        self._turn = None
        self._note()
        self._changed = True

    def go_on(self) -> float | None:
        """Run a piece, and send what is due.

        Returns:
            Seconds until there is something to do again; None, until a command comes.
        """
        now = time.perf_counter()
        if self.running and now >= self._next_piece:
            self._go_piece(now)
            now = time.perf_counter()
        if self._changed and self.wanted and now >= self._next_frame - EARLY_SECONDS:
            self._send_frame()
            self._next_frame = max(now, self._next_frame + FRAME_SECONDS)
        elif self._plans_due and not self._changed:
            self._say_plans()
        due = [self._next_piece] if self.running else []
        if self._changed and self.wanted:
            due.append(self._next_frame - EARLY_SECONDS)
        if not due:
            return 0.0 if self._plans_due and not self._changed else None
        return max(0.0, min(due) - time.perf_counter())

    def _go_piece(self, now: float) -> None:
        run = self.run
        self.prepare(run)
        before, now = run.tick, time.perf_counter()
        try:
            if self.pace == "turn":
                self.take_turn()
            else:
                run.advance(self._piece if self.pace is None else int(self.pace))
                self._turn = None
        except Exception as error:  # a rule's: the society stands where it failed
            self.running = False
            self.say("error", of="go", text=str(error))
        took = max(time.perf_counter() - now, 1e-9)
        done = run.tick - before
        if self.pace is None:
            self._next_piece = now
            self._piece = max(1, min(int(done / took * PIECE_SECONDS), 4 * self._piece))
        else:
            self._next_piece = max(now, self._next_piece + FRAME_SECONDS)
        self._pass(done, took if self.pace is None else max(took, FRAME_SECONDS))
        if now >= self._next_row or self.pace is not None:
            self._note()
            self._next_row = now + ROW_SECONDS
        if run.society.stopped:
            self.running = False
            self._note()
            self.say("over", why=run.society.over)

    def _pass(self, ticks: int, seconds: float) -> None:
        """Note how fast time passes."""
        self._rate += 0.1 * (ticks / seconds - self._rate)
        self._changed = True

    def take_turn(self) -> None:
        """Let the next agent have its turn."""
        run = self.run
        self._turn = run.turn()
        if self._turn is None:
            self._note()
        self._changed = True

    def prepare(self, run: LiveRun) -> None:
        """Compile the rules before the first tick: it takes a while, which is to be said."""
        if self._compiled:
            return
        self._compiled = True
        self.say("preparing", text="compiling the rules")
        try:
            run.society.engine.compile()
        finally:
            self.say("preparing", text="")

    def _note(self) -> None:
        run = self.run
        row = self.history.note(run.tick, run.society.series())
        if row is not None:
            self.say("row", **row)

    def _send_frame(self) -> None:
        run, self._changed = self.run, False
        running = self.running or self.together
        said: dict[str, Any] = {
            "running": running,
            "furthest": max(run.furthest, self._length),
            "rate": self._rate if running else 0.0,
        }
        society = run.society
        if society is not self._told:  # an intervention was met, or gone back behind
            self._told = society
            self.say_changed()
        if self._turn is not None:
            society, turn = self._turn
            said["turn"] = vars(turn)
        if self._watched is not None:
            said["watched"] = self._look_inside(run, society, *self._watched)
        try:
            plots = [panel_of(society, one) for one in self.plots]
            frame = frame_of(society, self.shown, plots, FRAME, **said)
        except SocialmindError as error:
            self.running = False
            self.say("error", of="frame", text=str(error))
            return
        self._send(frame)
        self.wanted = False

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

    # What is said -----------------------------------------------------------------------------

    def say(self, what: str, **said: Any) -> None:
        """Send something that is not to be lost."""
        self._send(SAID + json.dumps({"said": what, **said}, default=str).encode())

    def say_model(self, kind: type[Model]) -> None:
        """Say what a model declares, and by which name it is set up again."""
        self.say("model", **outline_of_model(kind), source=self.source)

    def say_changed(self, token: int = 0) -> None:
        """Say what interventions change in a society: parameters and schemes."""
        self.say("changed", token=token, **self._changing())

    def say_all(self) -> None:
        """Say all that somebody new must know."""
        if self._run is not None:
            self.say_model(type(self._run.society))
            self._say_society()

    def _say_society(self) -> None:
        society = self.run.society
        self.say(
            "society",
            **outline_of_society(society),
            seed=str(society.seed),  # a page's numbers have but 53 bits
            **self._changing(),
            shown=vars(self.shown),
            history=self.history.columns(),
        )
        self._plans_due = bool(society.assemblies)
        self._changed = True

    def _changing(self) -> dict[str, Any]:
        society = self.run.society
        schemes = {name: document_of(one) for name, one in society.schemes.items()}
        return {"parameters": society.parameter_values(), "schemes": schemes}

    def _say_plans(self) -> None:
        """Say where hierarchies are drawn, once the society was seen: it takes its time."""
        self._plans_due = False
        society = self.run.society
        minded = {name: one for name, one in society.assemblies.items() if society.tables[name]}
        for name, assembly in minded.items():
            if self._plans.get(name, (None,))[0] is not assembly:
                self._plans[name] = assembly, laid_out(society, name)
        said = {name: self._plans[name][1] for name in minded}
        self.say("hierarchies", plans=said)
