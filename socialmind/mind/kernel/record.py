"""The record that tells compiled code where the arrays of a mind are, and how it reads them there.

A function of the kernel takes a structure and a state as one address each, however many arrays
they have: `state.sensors` looks up in the record where that array is. As tuples of arrays they
would be some five hundred words in every call, and most of the time to compile it.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from llvmlite import ir  # type: ignore[import-untyped]  # it carries no types
from numba import types
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    infer_getattr,
    intrinsic,
    lower_getattr_generic,
    models,
    register_model,
)

from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.laying_out import ENGINE_ARRAYS
from socialmind.mind.kernel.layout import State, Structure, array_types

SCHEME_LISTS = {
    "cogniton": ("int64", 1),
    "plan_output": ("int64", 1),
    "weights": ("float64", 1),
    "plans": ("int64", 1),
}
"""Arrays beside a scheme's own: the cogniton of each input, the output of each plan, room."""


RECORD = (
    "itself", "agents", "evaluate", "renew", "failed_skill", "failed_agent", "names", "names_0",
    "worlds", "keys",
)  # fmt: skip
"""What the record of a mind holds beside the arrays: its own address, how many agents, where the
compiled evaluation and births are, which program of which agent runs, and the drive's names; how
many worlds the agents are in, as many in each, one after another; and where the keys of the draws
of each agent's world are, two words each, 0 where all agents have one key."""

NEW_WORLD, RESTARTED, NEW_BORN = -3, -2, -1
"""Instead of a parent, in `renew`: an agent's world begins, an agent begins anew, or a new one
begins."""
NO_SKILL, A_REGULATION = -1, -2
"""Instead of a skill, in `failed_skill`: none, or this less the variable whose regulation runs."""


def mind_arrays(schemes: int) -> dict[str, tuple[str, int]]:
    """Return the names, types and dimensions of all arrays of a hierarchy with so many schemes."""
    arrays = {f"structure_{name}": kind for name, kind in array_types(Structure).items()}
    arrays |= {f"state_{name}": kind for name, kind in array_types(State).items()}
    for number in range(schemes):
        of_scheme = {f"scheme_{name}": ENGINE_ARRAYS[name] for name in SchemeArrays._fields}
        of_minds = {f"minds_{name}": ENGINE_ARRAYS[name] for name in MindArrays._fields}
        for name, kind in {**of_scheme, **of_minds, **SCHEME_LISTS}.items():
            arrays[f"nested_{number}_{name}"] = kind
    return arrays


@cache
def mind_dtype(schemes: int) -> np.dtype[Any]:
    """Return the record that says where the arrays of a hierarchy are, and how large."""
    columns: list[Any] = [(name, "i8") for name in RECORD]
    for name, (_, dimensions) in mind_arrays(schemes).items():
        columns.append((name, "i8"))
        columns += [(f"{name}_{axis}", "i8") for axis in range(dimensions)]
    return np.dtype(columns, align=True)


class View(types.Type):
    """The type of a structure or a state in compiled code: the address of a mind's record.

    Args:
        part: "structure" or "state".
    """

    def __init__(self, part: str) -> None:
        self.part = part
        super().__init__(name=f"View({part})")


@register_model(View)
class _ViewModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, ir.IntType(64))


STRUCTURE, STATE = View("structure"), View("state")
_ARRAYS = {
    "structure": array_types(Structure),
    "state": array_types(State),
}
_PLACES = mind_dtype(0)
_KINDS = {"int64": types.int64, "float64": types.float64}


@intrinsic
def structure_at(typing_context: Any, address: Any) -> Any:
    """Return the structure of the mind whose record is at an address."""
    return STRUCTURE(types.int64), lambda context, builder, signature, arguments: arguments[0]


@intrinsic
def state_at(typing_context: Any, address: Any) -> Any:
    """Return the state of the agents of the mind whose record is at an address."""
    return STATE(types.int64), lambda context, builder, signature, arguments: arguments[0]


@infer_getattr
class _ViewAttributes(AttributeTemplate):
    key = View

    def generic_resolve(self, view: View, name: str) -> Any:
        kind, dimensions = _ARRAYS[view.part][name]
        return types.Array(_KINDS[kind], dimensions, "C")


@lower_getattr_generic(View)
def _array_of_view(context: Any, builder: Any, view: View, address: Any, name: str) -> Any:
    """Make the array of a view's attribute from where the record says that it is."""
    kind, dimensions = _ARRAYS[view.part][name]
    array_type = types.Array(_KINDS[kind], dimensions, "C")
    whole = ir.IntType(64)
    field = f"{view.part}_{name}"

    def stored(column: str) -> Any:
        offset = whole(_PLACES.fields[column][1])  # type: ignore[index]  # a record has fields
        pointer = builder.inttoptr(builder.add(address, offset), whole.as_pointer())
        return builder.load(pointer)

    array = context.make_array(array_type)(context, builder)
    shape = [stored(f"{field}_{axis}") for axis in range(dimensions)]
    itemsize = whole(8)
    strides = [itemsize]
    for length in reversed(shape[1:]):
        strides.insert(0, builder.mul(strides[0], length))
    items = whole(1)
    for length in shape:
        items = builder.mul(items, length)
    array.meminfo = context.get_constant_null(types.MemInfoPointer(types.voidptr))
    array.parent = ir.Constant(array.parent.type, None)
    array.nitems = items
    array.itemsize = itemsize
    array.data = builder.inttoptr(stored(field), array.data.type)
    array.shape = _packed(builder, array.shape.type, shape)
    array.strides = _packed(builder, array.strides.type, strides)
    return array._getvalue()


def _packed(builder: Any, kind: Any, values: list[Any]) -> Any:
    packed = ir.Constant(kind, ir.Undefined)
    for place, value in enumerate(values):
        packed = builder.insert_value(packed, value, place)
    return packed
