"""A mind: the commands of CogLogo on one agent's cognitons, decisions and groups."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py import kernel
from coglogo_py.border.errors import MindError, shown
from coglogo_py.border.numbers import number, whole_number
from coglogo_py.compiled.own_maker import checked_choice, checked_probabilities
from coglogo_py.conditions.heeding import heed, laid_out_conditions
from coglogo_py.parts import memes_of
from coglogo_py.receipts.receipt import Receipt, receipt_of

if TYPE_CHECKING:  # a circle for types alone: a mind knows its society, which makes minds
    from coglogo_py.society import Society


class Mind:
    """One mind of a society. `Society.new_mind` and `Mind.hatch` make them.

    Names are compared exactly, capitals included. A command with an unknown name, or a number that
    is NaN or infinite, raises `MindError` and changes nothing; so does any command to a dead mind.

    Args:
        society: the society it belongs to.
        slot: where the society's arrays hold it.

    >>> from coglogo_py import CognitiveScheme, Cogniton, Society
    >>> tired = Cogniton("Tired", start_value=2, influence={"rest": 3}, conditional=("rest",))
    >>> mind = Society(CognitiveScheme("humans", (tired,)), seed=1).new_mind()
    >>> mind.add_to_cogniton_value("Tired", 0.5)
    >>> mind.get_cogniton_value("Tired")
    2.5
    >>> mind.deactivate_cogniton("Tired")
    >>> print(mind.choose_next_plan())
    None
    """

    __slots__ = ("_era", "_slot", "id", "society")

    def __init__(self, society: Society, slot: int) -> None:
        self.society = society
        self.id = int(society.minds.mind_id[slot])
        self._slot = slot
        self._era = society.era

    def __repr__(self) -> str:
        state = "" if self.alive else ", dead"
        return f"<Mind {self.id} of scheme {self.society.scheme.name!r}{state}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mind):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[int, int, int]:
        return id(self.society), self._era, self.id

    @property
    def alive(self) -> bool:
        """Whether the mind is still in its society."""
        held = self.society.minds.mind_id
        return (
            self._era == self.society.era
            and self._slot < len(held)
            and bool(held[self._slot] == self.id)
        )

    @property
    def slot(self) -> int:
        """Where the society's arrays hold the mind; MindError when it is dead."""
        if not self.alive:
            raise MindError(f"mind {self.id} of scheme {self.society.scheme.name!r} is dead")
        return self._slot

    def _try(self, operation: Callable[..., Any], *arguments: Any) -> Any:
        """Carry out an operation of the kernel on the society's minds and this one's slot."""
        try:
            return operation(self.society.minds, self.slot, *arguments)
        except MindError:
            raise
        except ValueError as error:
            raise MindError(f"mind {self.id}: {error}") from None

    def _try_with_scheme(self, operation: Callable[..., Any], *arguments: Any) -> Any:
        """Carry out an operation of the kernel that needs the scheme's arrays as well."""
        arrays = self.society.arrays
        return self._try(lambda minds, slot: operation(arrays, minds, slot, *arguments))

    # ------------------------------------------------------------------- birth and death

    def hatch(self, keep_groups: bool = False) -> Mind:
        """Make a mind with this one's cogniton values, active and inactive.

        Args:
            keep_groups: make the child a member of the same groups, in the same roles and with the
                same participation; otherwise it is in no group.
        """
        slot = self.slot
        self.society.reserve(1)
        child = kernel.hatch(self.society.arrays, self.society.minds, slot, bool(keep_groups))
        return self.society.mind_in(child)

    def die(self) -> None:
        """Leave all groups and the society; the identity is not given again."""
        self._try_with_scheme(kernel.die)

    # ------------------------------------------------------------------- cognitons

    def update(self, values: Mapping[str, float]) -> None:
        """Let the conditions of the scheme make cognitons active and inactive.

        The minds of a model's agents are brought up to date whenever they are asked; one without
        an agent knows no fields, and stays as it is until it is told their values.

        Args:
            values: those of the fields, and of the parameters, that conditions name.

        Raises:
            MindError: a value is missing, or is no finite number.
        """
        conditions, sides, written = laid_out_conditions(self.society.scheme)
        for row, one in enumerate(written):
            for side, name in enumerate((one.field, one.bound)):
                if isinstance(name, str):
                    if name not in values:
                        raise MindError(f"update: no value for {name!r}, of the condition {one}")
                    what = f"update, {name!r}"
                    sides[row, side] = number(values[name], what, error=MindError)
        heed(conditions, sides, self.society.minds.values, self.slot)

    def cognitons(self) -> dict[str, float | None]:
        """Return the value of every cogniton in the scheme's order, None when inactive."""
        values = self.society.minds.values[self.slot].tolist()
        # In a culture there may be further columns, which are not this breed's.
        return {
            name: None if value != value else value
            for name, value in zip(self.society.names.cognitons, values, strict=False)
        }

    def set_cogniton_value(self, cogniton: str, value: float) -> None:
        """Set the value of a cogniton; one that is inactive stays so."""
        position = self.society.names.cogniton(cogniton)
        value = number(value, f"set_cogniton_value of {cogniton!r}", error=MindError)
        self._try(kernel.set_cogniton_value, position, value)

    def add_to_cogniton_value(self, cogniton: str, value: float) -> None:
        """Add to the value of a cogniton; one that is inactive stays so."""
        position = self.society.names.cogniton(cogniton)
        value = number(value, f"add_to_cogniton_value of {cogniton!r}", error=MindError)
        self._try(kernel.add_to_cogniton_value, position, value)

    def get_cogniton_value(self, cogniton: str) -> float:
        """Return the value of a cogniton, 0.0 when it is inactive."""
        position = self.society.names.cogniton(cogniton)
        return float(self._try(kernel.get_cogniton_value, position))

    def activate_cogniton(self, cogniton: str) -> None:
        """Make an inactive cogniton active, with value 0.0; an active one keeps its value."""
        self._try(kernel.activate_cogniton, self.society.names.cogniton(cogniton))

    def deactivate_cogniton(self, cogniton: str) -> None:
        """Make a cogniton inactive; its value is forgotten."""
        self._try(kernel.deactivate_cogniton, self.society.names.cogniton(cogniton))

    def is_active(self, cogniton: str) -> bool:
        """Return whether a cogniton is active."""
        return bool(self._try(kernel.is_active, self.society.names.cogniton(cogniton)))

    def imitate(self, cogniton: str, other: Mind) -> bool:
        """Take over a cogniton of another mind, active with its value.

        Args:
            cogniton: its name, in the schemes of both.
            other: the mind that is imitated, of any society.

        Returns:
            Whether it took effect: not where the other's is inactive.
        """
        mine = self.society.names.cogniton(cogniton)
        if not isinstance(other, Mind):
            raise MindError(f"imitate {cogniton!r}: found {shown(other)}; expected a mind")
        theirs = other.society.names.cogniton(cogniton)
        whose = other.society.minds, other.slot
        return bool(self._try(kernel.imitate, mine, *whose, theirs))

    def imitate_memes(self, other: Mind) -> int:
        """Take over all memes that another mind has active and that this one's scheme has too.

        Args:
            other: the mind that is imitated, of any society; its scheme says what is a meme.

        Returns:
            How many were taken over.
        """
        if not isinstance(other, Mind):
            raise MindError(f"imitate_memes: found {shown(other)}; expected a mind")
        # Both minds are asked once, before anything is taken over.
        minds, whose, slot = self.society.minds, (other.society.minds, other.slot), self.slot
        places = memes_of(other.society.scheme, self.society.scheme)
        return sum(kernel.imitate(minds, slot, mine, *whose, theirs) for mine, theirs in places)

    # ------------------------------------------------------------------- decisions

    def choose_next_plan(self) -> str | None:
        """Take the next decision under the scheme's decision maker.

        Returns:
            The plan, or None when none is available. The decision counts as a draw either way.
        """
        society = self.society
        if society.arrays.maker[0] == kernel.MODELLERS_OWN:
            count = self._count_available()
            position = self._position_of_choice(count)
            society.minds.draws[self.slot] += 1
            plan = -1 if position is None else int(society.plans_scratch[position])
        else:
            plan = self._try_with_scheme(
                kernel.choose_next_plan, society.weights_scratch, society.plans_scratch
            )
        return None if plan < 0 else society.scheme.plans[plan]

    def next_choice(self) -> tuple[float, str | None]:
        """Return the draw and the plan that the next decision will give, without taking it."""
        society = self.society
        draw = float(self._try(kernel.next_draw))
        position = self._position_of_choice(self._count_available())
        plan = None if position is None else society.plans_scratch[position]
        return draw, None if plan is None else society.scheme.plans[plan]

    def _count_available(self) -> int:
        """Leave the available plans and weights in the society's scratch space; how many."""
        society = self.society
        return self._try_with_scheme(
            kernel.available_weights, society.weights_scratch, society.plans_scratch
        )

    def _position_of_choice(self, count: int) -> int | None:
        """Return which of the available plans in scratch space the next draw falls on."""
        if count == 0:
            return None
        society = self.society
        maker = society.scheme.decision_maker
        weights = society.weights_scratch[:count].copy()
        draw = float(self._try(kernel.next_draw))
        if society.arrays.maker[0] != kernel.MODELLERS_OWN:
            return int(kernel.choose(int(society.arrays.maker[0]), maker.bias, weights, draw))
        return checked_choice(maker, maker.choose(weights, maker.bias, draw), count)

    def plan_weights(self) -> dict[str, float]:
        """Return the available plans and their weights (equation 3.2), in the scheme's order."""
        society = self.society
        count = self._count_available()
        return {
            society.scheme.plans[plan]: weight
            for plan, weight in zip(
                society.plans_scratch[:count].tolist(),
                society.weights_scratch[:count].tolist(),
                strict=True,
            )
        }

    def plan_probabilities(self) -> dict[str, float]:
        """Return the exact probability of each available plan under the scheme's decision maker."""
        weights = self.plan_weights()
        if not weights:
            return {}
        maker = self.society.scheme.decision_maker
        found = maker.probabilities(np.array(list(weights.values())), maker.bias)
        chances = checked_probabilities(maker, found, len(weights))
        return dict(zip(weights, chances.tolist(), strict=True))

    def explain(self, within: Mapping[str, tuple[float, float]] | None = None) -> Receipt:
        """Return the receipt of the decision that this mind takes next, without taking it.

        The draw and the choice are those that `choose_next_plan` gives if nothing changes first:
        ask before a decision to have its receipt.

        Args:
            within: the smallest and largest value that cognitons take, by name; the smallest change
                that the receipt proposes stays within them.
        """
        for name in within or {}:
            self.society.names.cogniton(name)
        return receipt_of(self, within)

    def feed_back_from_plan(self, plan: str, value: float) -> None:
        """Reinforce what is linked to a plan.

        Args:
            plan: a plan of the scheme.
            value: times the weight of its reinforcement link, it is added to every active cogniton
                and to every culturon, of all roles, of the groups this mind is in.
        """
        position = self.society.names.plan(plan)
        value = number(value, f"feed_back_from_plan of {plan!r}", error=MindError)
        self._try_with_scheme(kernel.feed_back_from_plan, position, value)

    # ------------------------------------------------------------------- groups

    def create_and_join_group(self, group: str, role: str) -> bool:
        """Create a group and join it in a role, with participation 1.

        Returns:
            Whether it took effect: not when the mind is in a group of this type already.
        """
        positions = self.society.names.role(group, role)
        return bool(self._try_with_scheme(kernel.create_and_join_group, *positions))

    def join_group(self, group: str, role: str, id: int) -> bool:
        """Join an existing group in a role, with participation 1.

        Args:
            group: its type.
            role: the role to play in it.
            id: its identity, as `get_group_id` of a member returns it.

        Returns:
            Whether it took effect: not when the mind is in a group of this type already.

        Raises:
            MindError: no living group of this type has that identity.
        """
        positions = self.society.names.role(group, role)
        identity = whole_number(id, f"join_group {group!r}, id", error=MindError)
        minds = self.society.minds
        if kernel.find_group(minds, positions[0], identity) < 0:
            living = minds.instance_id[minds.instance_group == positions[0]]
            listed = ", ".join(map(str, np.sort(living).tolist()[:20])) or "none"
            raise MindError(f"no group {group!r} with id {identity} lives; those that do: {listed}")
        return bool(self._try_with_scheme(kernel.join_group, *positions, identity))

    def change_role(self, group: str, role: str) -> bool:
        """Play another role in the group that the mind is in; its participation stays as it is.

        Returns:
            Whether it took effect: not outside the group.
        """
        positions = self.society.names.role(group, role)
        return bool(self._try_with_scheme(kernel.change_role, *positions))

    def leave_group(self, group: str) -> None:
        """Leave the group of this type, if in one; without members it dissolves."""
        self._try(kernel.leave_group, self.society.names.group(group))

    def leave_all_groups(self) -> None:
        """Leave all groups; those without members dissolve."""
        self._try(kernel.leave_all_groups)

    def get_group_id(self, group: str) -> int:
        """Return the identity of the group of this type that the mind is in, or -1."""
        return int(self._try(kernel.get_group_id, self.society.names.group(group)))

    def get_group_role_id(self, group: str, role: str) -> int:
        """Return the identity of the group in which the mind plays this very role, or -1."""
        positions = self.society.names.role(group, role)
        return int(self._try(kernel.get_group_role_id, *positions))

    def ask_to_join(self, group: str, role: str, id: int) -> bool:
        """Ask to join a group in a role; one of its members may grant it.

        A mind has one open request a type of group: a new one takes the place of the last. It ends
        when it is granted or refused, when the mind joins a group of this type or dies, and with
        the group.

        Args:
            group: its type.
            role: the role to play in it.
            id: its identity.

        Returns:
            Whether such a group lives and the mind is in none of this type.
        """
        positions = self.society.names.role(group, role)
        identity = whole_number(id, f"ask_to_join {group!r}, id", error=MindError)
        return bool(self._try_with_scheme(kernel.ask_to_join, *positions, identity))

    def get_asked_group_id(self, group: str) -> int:
        """Return the identity of the group of this type that the mind asks to join, or -1."""
        return int(self._try(kernel.get_asked_group_id, self.society.names.group(group)))

    def grant_entry(self, group: str, other: Mind) -> bool:
        """Let another mind join the group that this one is in, in the role that it asks for.

        Returns:
            Whether it took effect: not unless the other asks to join that very group.
        """
        return self._with_other(kernel.grant_entry, group, other, "grant_entry")

    def refuse_entry(self, group: str, other: Mind) -> bool:
        """End another mind's request to join the group that this one is in.

        Returns:
            Whether there was one.
        """
        return self._with_other(kernel.refuse_entry, group, other, "refuse_entry")

    def expel(self, group: str, other: Mind) -> bool:
        """Let another mind leave the group that both are in; without members it dissolves.

        Returns:
            Whether the other was in it.
        """
        return self._with_other(kernel.expel, group, other, "expel")

    def _with_other(
        self, operation: Callable[..., bool], group: str, other: object, command: str
    ) -> bool:
        """Carry out what a mind does to another of its culture."""
        position = self.society.names.group(group)
        if not isinstance(other, Mind):
            raise MindError(f"{command} {group!r}: found {shown(other)}; expected a mind")
        if other.society.minds is not self.society.minds:
            raise MindError(
                f"{command} {group!r}: {other!r} shares no groups with {self!r}; give both one "
                "society, or one culture"
            )
        return bool(self._try(operation, position, other.slot))

    def enclose_group(self, group: str, id: int) -> bool:
        """Let the group that the mind is in lie in another, whose culturons then apply in it.

        Args:
            group: its type, which the scheme has within another.
            id: the identity of the one around it.

        Returns:
            Whether it took effect: not when the mind is in none, or it lies in one already.

        Raises:
            MindError: no living group of the type around it has that identity.
        """
        position = self.society.names.group(group)
        identity = whole_number(id, f"enclose_group {group!r}, id", error=MindError)
        return bool(self._try_with_scheme(kernel.enclose_group, position, identity))

    def release_group(self, group: str) -> None:
        """Let the group that the mind is in lie in no other; the one around it may dissolve."""
        self._try(kernel.release_group, self.society.names.group(group))

    def get_enclosing_group_id(self, group: str) -> int:
        """Return the identity of what the group that the mind is in lies in, or -1."""
        return int(self._try(kernel.get_enclosing_group_id, self.society.names.group(group)))

    def set_participation(self, group: str, value: float) -> None:
        """Set the degree of participation in a group; without effect outside it."""
        position = self.society.names.group(group)
        value = number(value, f"set_participation in {group!r}", error=MindError)
        self._try(kernel.set_participation, position, value)

    def add_to_participation(self, group: str, value: float) -> None:
        """Add to the degree of participation in a group; without effect outside it."""
        position = self.society.names.group(group)
        value = number(value, f"add_to_participation in {group!r}", error=MindError)
        self._try(kernel.add_to_participation, position, value)

    def get_participation(self, group: str) -> float:
        """Return the degree of participation in a group, 0.0 outside it."""
        return float(self._try(kernel.get_participation, self.society.names.group(group)))

    def set_culturon_value(self, group: str, culturon: str, value: float) -> None:
        """Set a culturon of the group that the mind is in, of any role, for all its members."""
        positions = self.society.names.culturon(group, culturon)
        value = number(value, f"set_culturon_value of {culturon!r}", error=MindError)
        self._try_with_scheme(kernel.set_culturon_value, *positions, value)

    def add_to_culturon_value(self, group: str, culturon: str, value: float) -> None:
        """Add to a culturon of the group that the mind is in, of any role, for all its members."""
        positions = self.society.names.culturon(group, culturon)
        value = number(value, f"add_to_culturon_value of {culturon!r}", error=MindError)
        self._try_with_scheme(kernel.add_to_culturon_value, *positions, value)

    def get_culturon_value(self, group: str, culturon: str) -> float:
        """Return a culturon of the group that the mind is in, of any role; 0.0 outside it."""
        positions = self.society.names.culturon(group, culturon)
        return float(self._try_with_scheme(kernel.get_culturon_value, *positions))

    def set_group_attribute(self, group: str, attribute: str, value: float) -> None:
        """Set an attribute of the group that the mind is in, for all its members."""
        positions = self.society.names.attribute(group, attribute)
        value = number(value, f"set_group_attribute of {attribute!r}", error=MindError)
        self._try_with_scheme(kernel.set_group_attribute, *positions, value)

    def add_to_group_attribute(self, group: str, attribute: str, value: float) -> None:
        """Add to an attribute of the group that the mind is in, for all its members."""
        positions = self.society.names.attribute(group, attribute)
        value = number(value, f"add_to_group_attribute of {attribute!r}", error=MindError)
        self._try_with_scheme(kernel.add_to_group_attribute, *positions, value)

    def get_group_attribute(self, group: str, attribute: str) -> float:
        """Return an attribute of the group that the mind is in; 0.0 outside it."""
        positions = self.society.names.attribute(group, attribute)
        return float(self._try_with_scheme(kernel.get_group_attribute, *positions))
