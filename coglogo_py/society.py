"""A society: the minds of one scheme and the groups they form."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from coglogo_py import kernel
from coglogo_py.arrays import ASKED, STATE, MindArrays
from coglogo_py.border.closed import Closed
from coglogo_py.border.errors import CogLogoError
from coglogo_py.border.memory import check_memory
from coglogo_py.border.numbers import whole_number
from coglogo_py.laying_out import Within, grown, mind_arrays, scheme_arrays
from coglogo_py.mind import Mind
from coglogo_py.names import Names, laid_out
from coglogo_py.scheme import CognitiveScheme
from coglogo_py.state_check import oddity

FIRST_CAPACITY = 16


class Society(Closed):
    """The minds of one scheme and their group instances.

    A mind's decisions draw from its own stream: which number it gets depends on the seed, the
    stream, the mind's identity and how many decisions it has taken, on nothing else in the society.

    Args:
        scheme: what the minds have in common.
        seed: 0 … 2⁶⁴ − 1.
        stream: 0 … 65535, to keep the societies of one model apart.
        within: the culture that it shares with other breeds; `Culture` gives it.

    Raises:
        CogLogoError: `scheme` is no scheme, or seed or stream is no whole number in its range.

    >>> from coglogo_py import Cogniton
    >>> hunger = Cogniton("Hunger", start_value=3, influence={"eat": 2}, conditional=("eat",))
    >>> society = Society(CognitiveScheme("herd", (hunger,)), seed=1)
    >>> cow = society.new_mind()
    >>> cow.plan_weights()
    {'eat': 6.0}
    >>> cow.choose_next_plan()
    'eat'
    """

    def __init__(
        self, scheme: CognitiveScheme, seed: int, stream: int = 0, within: Within | None = None
    ) -> None:
        if not isinstance(scheme, CognitiveScheme):
            raise CogLogoError(
                f"a society needs a CognitiveScheme, found {scheme!r}; "
                "load one with CognitiveScheme.load(path)"
            )
        self.scheme = scheme
        self.seed = whole_number(seed, "seed of a society", 0, 2**64 - 1)
        self.stream = whole_number(stream, "stream of a society", 0, 2**16 - 1)
        if within is None:
            self.names, self.arrays = laid_out(scheme)
        else:
            self.names, self.arrays = Names(scheme, within[0]), scheme_arrays(scheme, within)
        self.breed = None if within is None else within[2]
        self.sharing: tuple[Society, ...] = ()
        self.weights_scratch = np.empty(len(scheme.plans))
        self.plans_scratch = np.empty(len(scheme.plans), np.int64)
        self.era = 0
        self.minds: MindArrays
        self._clear()
        self._closed = True

    def _clear(self) -> None:
        self._hold(mind_arrays(self.arrays, FIRST_CAPACITY, self.seed, self.stream))

    def _hold(self, minds: MindArrays) -> None:
        """Let all breeds that share groups hold these minds."""
        for one in self.sharing or (self,):
            one.minds = minds

    def _living(self) -> np.ndarray:
        """Return the slots of the living minds of this breed."""
        alive = self.minds.mind_id >= 0
        if self.breed is not None:
            alive &= self.minds.values[:, -1] == self.breed
        return np.flatnonzero(alive)

    def __repr__(self) -> str:
        return f"<Society of {len(self)} minds with scheme {self.scheme.name!r}, seed {self.seed}>"

    def __len__(self) -> int:
        """The number of living minds."""
        shared = self.breed is not None
        return len(self._living()) if shared else int(self.minds.counters[kernel.ALIVE])

    def __iter__(self) -> Iterator[Mind]:
        """The living minds, the eldest first."""
        alive = self._living()
        identities = self.minds.mind_id[alive]
        eldest_first = np.argsort(identities)
        for slot, identity in zip(
            alive[eldest_first].tolist(), identities[eldest_first].tolist(), strict=True
        ):
            # Whoever iterates may let minds die and be born meanwhile.
            if self.minds.mind_id[slot] == identity:
                yield self.mind_in(slot)

    def new_mind(self) -> Mind:
        """Make a mind with the scheme's starting cognitons, in no group."""
        self.reserve(1)
        return self.mind_in(kernel.new_mind(self.arrays, self.minds))

    def new_minds(self, count: int) -> np.ndarray:
        """Make several minds at once, as `new_mind` makes one; return where the arrays hold them.

        Args:
            count: how many, 0 or more.

        Raises:
            CogLogoError: it is no such number, or there is not memory enough.
        """
        count = whole_number(count, "minds", 0)
        self.reserve(count)
        minds = self.minds
        free = int(minds.counters[kernel.FREE_MINDS])
        slots = minds.free_minds[free - count : free][::-1].copy()
        first = int(minds.counters[kernel.NEXT_MIND])
        minds.mind_id[slots] = np.arange(first, first + count)
        minds.values[slots] = self.arrays.start
        if len(self.arrays.chances):
            for slot in slots.tolist():
                kernel.draw_at_birth(self.arrays, minds, slot, -1)
        minds.draws[slots] = 0
        minds.group_slot[slots] = -1
        minds.role[slots] = -1
        minds.participation[slots] = 0.0
        minds.asked_id[slots] = minds.asked_role[slots] = -1
        minds.counters[kernel.FREE_MINDS] -= count
        minds.counters[kernel.NEXT_MIND] += count
        minds.counters[kernel.ALIVE] += count
        return slots

    def mind_in(self, slot: int) -> Mind:
        """Return the living mind that the arrays hold in a slot.

        Raises:
            CogLogoError: no mind is there.
        """
        if not 0 <= slot < len(self.minds.mind_id) or self.minds.mind_id[slot] < 0:
            raise CogLogoError(f"no mind lives in slot {slot} of the society")
        if self.breed is not None and self.minds.values[slot, -1] != self.breed:
            raise CogLogoError(f"the mind in slot {slot} of the society is of another breed")
        return Mind(self, slot)

    def reserve(self, count: int) -> None:
        """Make room for more minds; the arrays are replaced when there is not enough.

        Args:
            count: how many more minds there shall be room for, 0 or more.
        """
        capacity = len(self.minds.mind_id)
        missing = count - int(self.minds.counters[kernel.FREE_MINDS])
        if missing > 0:
            one = sum(array.nbytes for array in mind_arrays(self.arrays, 1, seed=0))
            minds = f"{capacity + missing} minds of scheme {self.scheme.name!r}"
            check_memory((capacity + missing) * one, minds)
            larger = max(2 * capacity, capacity + missing)
            if self._untouched:
                self._hold(mind_arrays(self.arrays, larger, self.seed, self.stream))
            else:
                self._hold(grown(self.arrays, self.minds, larger))

    @property
    def _untouched(self) -> bool:
        """Whether there has been no mind and no group yet."""
        counters = self.minds.counters
        return not counters[kernel.NEXT_MIND] and not counters[kernel.NEXT_GROUP]

    def reset(self) -> None:
        """Forget all minds, groups, identities and draws: as if just made, with the same seed.

        In a culture, those of all its breeds.
        """
        for one in self.sharing or (self,):
            one.era += 1
        self._clear()

    def state(self) -> dict[str, np.ndarray]:
        """Return a copy of all that the minds and groups hold, by the names in `MindArrays`."""
        asking = (self.minds.asked_id >= 0).any()
        left_out = () if asking else ASKED
        if not len(self.minds.within):
            left_out = (*left_out, "within")
        held = (name for name in STATE if name not in left_out)
        return {name: getattr(self.minds, name).copy() for name in held}

    def restore(self, state: Mapping[str, np.ndarray]) -> None:
        """Go back to a state of a society of the same scheme; its seed and stream come along.

        A `Mind` handed out before is valid after if the mind lived then.

        Args:
            state: what `state` returned.

        Raises:
            CogLogoError: the arrays are not those of a society with this scheme; nothing changed.
        """
        unsaid = ASKED if len(self.arrays.group_within) else (*ASKED, "within")
        held = [name for name in STATE if name in state or name not in unsaid]
        missing = [name for name in held if name not in state]
        if missing:
            raise CogLogoError(f"the state of a society lacks {', '.join(missing)}")
        capacity = max(1, np.size(state["mind_id"]))
        fitting = mind_arrays(self.arrays, capacity, seed=0)
        for name in held:
            fit, found = getattr(fitting, name), np.asarray(state[name])
            if found.shape != fit.shape or found.dtype != fit.dtype:
                raise CogLogoError(
                    f"{name} in the state of a society with scheme {self.scheme.name!r}: "
                    f"expected {fit.dtype} of shape {fit.shape}, "
                    f"found {found.dtype} of shape {found.shape}; was it another scheme's?"
                )
        minds = fitting._replace(**{name: np.array(state[name], order="C") for name in held})
        arrays = self.arrays
        odd = oddity(minds, arrays.group_within, len(arrays.role_group))
        if odd is not None:
            raise CogLogoError(
                f"{odd} in the state of a society with scheme {self.scheme.name!r}: found numbers "
                "that no such society has; take what state() returned"
            )
        kernel.index_instances(minds)
        self._hold(minds)
        low, high = self.minds.counters[[kernel.SEED_LOW, kernel.SEED_HIGH]].tolist()
        for one in self.sharing or (self,):
            one.seed = high << 32 | low
            one.stream = int(self.minds.counters[kernel.STREAM])
