"""The engine of a society: its ticks, compiled or interpreted with the same results."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NoReturn

from numba.core.errors import NumbaError

from coglogo_py.compiled.own_maker import refusal_of
from coglogo_py.decision import BUILT_IN
from socialmind.agents.events import most
from socialmind.agents.plan_steps import carry_on
from socialmind.compiling.modules import compiled_module
from socialmind.compiling.reached import fingerprint
from socialmind.engine.module_text import module_text
from socialmind.engine.ticks import run_setup, run_tick, taken
from socialmind.errors import SocialmindError
from socialmind.society.connection import connect

if TYPE_CHECKING:
    from types import ModuleType

    from coglogo_py.decision import DecisionMaker
    from socialmind.agents.running import Running

State = dict[str, Any]

CHUNK_SECONDS = 0.2
"""How long compiled code runs before Ctrl-C is heard."""
SMALL = 5_000
"""Up to so many agents and patches a first stretch is of several ticks."""
INTERPRETED_SETUP = 20_000
"""Up to so many agents and patches the first society's setup runs interpreted: faster than loading
its code."""
SNAPSHOT_BYTES = 8 * 2**20
"""The largest state of which a copy is kept, to find the line of an error in compiled code."""


_OUTGROWN = "setup outgrown"
"""Under what a program holds that its setup brings more agents than there is room for."""


class Engine:
    """Runs the setup and the ticks of one society.

    Args:
        model: the society.
        compiled: run its rules compiled, or interpreted.

    Attributes:
        careful: whether a copy of the state is kept of each stretch, so that an error in compiled
            code is told with its line; one who can repeat the run may do without.
    """

    def __init__(self, model: Running, compiled: bool) -> None:
        self.model = model
        self.compiled = compiled
        self.careful = True
        self._functions: dict[str, Callable[..., Any]] | None = None
        self._module: ModuleType | None = None
        self._ticks_per_chunk = 0  # not yet known
        self._record: Any = None
        self._sized: list[Any] | None = None
        self._size = 0

    @property
    def module(self) -> Any:
        """The compiled loops."""
        if self._module is None:
            program, loops = self.model.program, self._loops()
            if loops not in program.made:
                own = {name: maker.choose for name, maker in self._own_makers().items()}
                try:
                    text = module_text(program, frozenset(own), self.model.conditioned)
                    program.made[loops] = compiled_module(text, own)
                except NumbaError as error:
                    self._refuse_makers(error)
            self._module = program.made[loops]
            # As numba has it, in which arrays of truth values are bytes.
            self._record = self.model.contexts.view(self._module.MODEL)
            for table in self.model.tables.values():
                if table.minds is not None:
                    table.minds.compile()
        return self._module

    def _loops(self) -> tuple[tuple[str, str], ...]:
        """Return what tells the compiled loops of one program from each other."""
        makers = [(name, fingerprint(one.choose)) for name, one in self._own_makers().items()]
        return (*makers, *((name, "conditions") for name in self.model.conditioned))

    @property
    def functions(self) -> dict[str, Callable[..., Any]]:
        """The rules as interpreted Python."""
        if self._functions is None:
            program, names = self.model.program, self.model.ground.functions()
            if (
                program.sought
                or program.patches_sought
                or program.seeks_somebody
                or program.gathered
            ):
                from socialmind.worlds.neighbours.interpreted import FUNCTIONS

                names = {**FUNCTIONS, **names}
            if program.gathered:
                from socialmind.society.groups import asked

                names = {**asked.FUNCTIONS, **names}
            self._functions = program.interpreted(names)
        return self._functions

    def set_up(self, unbegun: Callable[[], State] | None = None) -> None:
        """Run the setup.

        Args:
            unbegun: gives the state before it, should it fail; a copy is made unless given.
        """
        if self.compiled and self._compiles_setup():
            connect(self.model)
            self._guarded(lambda: self.module.prepare(self._record), _run_outgrown_setup, unbegun)
        else:
            run_setup(self.model, self.functions)

    def compile(self) -> None:
        """Compile what ticks run in, or load it, and run none."""
        if self.compiled:
            self._make_room()
            connect(self.model)
            self._guarded(lambda: self.module.advance(self._record, 0), run_tick)

    def _compiles_setup(self) -> bool:
        """Whether the setup runs compiled: in large worlds, and once other societies had ticks."""
        if not self.model.program.setup or self._entities() > INTERPRETED_SETUP:
            return bool(self.model.program.setup)
        made = self.model.program.made
        module = made.get(self._loops())
        return module is not None and _OUTGROWN not in made and bool(module.advance.signatures)

    def advance(self, ticks: int) -> None:
        """Run a number of ticks.

        Raises:
            RuleError: a rule failed, with its file, line, agent and tick.
        """
        if not self.compiled:
            for _ in range(ticks):
                run_tick(self.model, self.functions)
            return
        if self.model.physics != "compiled":
            self._advance_outside(ticks)
            return
        if not self._ticks_per_chunk:
            self._ticks_per_chunk = 16 if self._entities() <= SMALL else 1
        left = ticks
        while left > 0:
            begin = time.perf_counter()
            wanted = min(left, self._ticks_per_chunk)
            self._make_room()
            connect(self.model)
            loop = functools.partial(self.module.advance, self._record, wanted)
            done = self._guarded(loop, run_tick)
            left -= done
            took = time.perf_counter() - begin
            # Many short advances say nothing of how long a stretch may be.
            if done == self._ticks_per_chunk and took < CHUNK_SECONDS / 2:
                self._ticks_per_chunk *= 16 if took < CHUNK_SECONDS / 32 else 2
            elif took > CHUNK_SECONDS and wanted > 1:
                self._ticks_per_chunk = wanted // 2

    def _advance_outside(self, ticks: int) -> None:
        """Run a number of ticks whose motion is not compiled."""
        model = self.model

        def one() -> int:
            # Within what is done again when it fails, so that nothing moves twice.
            model.ground.before_compiled_tick()
            return int(self.module.advance(self._record, 1))

        for _ in range(ticks):
            self._make_room()
            connect(model)
            self._guarded(one, run_tick)
            model.ground.after_compiled_tick()

    def connect(self) -> None:
        """Write into the society's record where its arrays are."""
        connect(self.model)

    def run_plan(self, population: str, plan: str, agent: Any, rng: Any) -> None:
        """Carry out a plan, or go on in it, in an interpreted run."""
        plans = self.model.program.plans[population]

        def called(place: int) -> int:
            call = plans.calls[place]
            taking = taken(call.takes, agent, self.model, rng).values()
            found = self.functions[call.symbol](*taking)
            return 1 if found is None else int(found)

        if plans.steps is None:
            called(plans.names.index(plan))
        else:
            carry_on(plans.steps, plan, agent, called)

    def _make_room(self) -> None:
        for name in self.model.program.births:
            if self.model.tables[name].short_of_room:
                self.model.tables[name].grow()
        counters = [self.model.tables[name].counters for name in self.model.program.eventful]
        self.model.event_log.make_room(sum(int(most(one)) for one in counters))

    def _guarded(
        self,
        run: Callable[[], Any],
        again: Callable[..., None],
        before: Callable[[], State] | None = None,
    ) -> int:
        """Run compiled code; when it fails, do its last tick again, interpreted.

        The interpreted tick fails alike, and knows the line. If it does not fail, it was room for
        births that the compiled one lacked, and the run goes on behind it.
        """
        model = self.model
        begin, events = model.tick, model.event_log.count
        # Births may outrun the room, whatever the size of the state.
        small = self.careful and self._bytes() <= SNAPSHOT_BYTES
        if before is None and (model.program.births or small):
            before = functools.partial(dict, model.state())
        try:
            return int(run() or 0)
        except NumbaError as error:
            # Nothing has run. If it is but what a maker returns, a tick in Python says who got it.
            self._refuse_makers(error, lambda: again(model, self.functions))
        except MemoryError:
            raise  # it would be too little the second time as well
        except Exception as error:
            failed = model.tick
            if before is None:
                raise SocialmindError(
                    f"{type(error).__name__} in tick {failed}: {error}; "
                    "run with --interpreted to see where"
                ) from error
            model.restore(before())
            model.event_log.forget_behind(events)
            connect(model)
            if failed > begin:
                self.module.advance(self._record, failed - begin)
            again(model, self.functions)
            return model.tick - begin

    def _own_makers(self) -> dict[str, type[DecisionMaker]]:
        """Return the decision makers of the modeller's own, by population."""
        makers = {name: type(one.decision_maker) for name, one in self.model.schemes.items()}
        return {name: maker for name, maker in makers.items() if maker not in BUILT_IN}

    def _refuse_makers(
        self, error: NumbaError, again: Callable[[], None] | None = None
    ) -> NoReturn:
        """Raise what a decision maker did that kept a loop from being compiled, else the error."""
        for maker in self._own_makers().values():
            refusal = refusal_of(maker)
            if refusal is not None:
                reason, runs = refusal
                if runs and again is not None:
                    again()
                raise reason from None
        raise error  # a fault of ours, not of a rule

    def _entities(self) -> int:
        tables = self.model.tables.values()
        return int(self.model.ground.entities) + sum(len(table) for table in tables)

    def _bytes(self) -> int:
        """Return how large the arrays of the society are, which is asked of each stretch."""
        if self._sized is not self.model.connected:
            self._sized, self._size = self.model.connected, self._counted_bytes()
        return self._size

    def _counted_bytes(self) -> int:
        tables = self.model.tables
        arrays = [table.rows.nbytes + 64 * len(table.rows) for table in tables.values()]
        arrays += [table.minds.bytes for table in tables.values() if table.minds is not None]
        arrays += [one.nbytes for one in self.model.ground.arrays().values()]
        return sum(arrays)


def _run_outgrown_setup(model: Running, functions: dict[str, Callable[..., Any]]) -> None:
    """Run a setup interpreted that failed compiled; if it does not, it was for want of room."""
    run_setup(model, functions)
    model.program.made[_OUTGROWN] = True  # as it would be for the next
