"""Arrays without reference counts, inside compiled code.

numba counts references to every array that is taken out of a tuple or handed to a function. With
the twenty arrays of a society that costs ten times the arithmetic of a decision. `borrowed` gives
the same arrays uncounted: the caller keeps them alive for as long as they are used.
"""

from typing import Any, TypeVar

from numba import types
from numba.core import cgutils, ir_utils
from numba.extending import intrinsic, overload

Arrays = TypeVar("Arrays")


def borrowed(arrays: Arrays) -> Arrays:
    """Return an array, or a tuple of arrays, as it is; when compiled, without counting references.

    Use it on what a function was given, never on arrays that it makes or returns.

    Args:
        arrays: an array, or a tuple or named tuple of arrays.

    >>> borrowed((1, 2))
    (1, 2)
    """
    return arrays


def _without_count(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    array = context.make_array(kind)(context, builder, value)
    array.meminfo = cgutils.get_null_value(array.meminfo.type)
    array.parent = cgutils.get_null_value(array.parent.type)
    return array._getvalue()


@intrinsic
def _uncounted(typing_context: Any, arrays: Any) -> Any:
    """Return the arrays with the address of their reference count taken away."""
    is_tuple = isinstance(arrays, types.BaseTuple)
    kinds = tuple(arrays) if is_tuple else (arrays,)
    if not all(isinstance(kind, types.Array) for kind in kinds):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        if not is_tuple:
            return _without_count(context, builder, arrays, arguments[0])
        members = [
            _without_count(context, builder, kind, builder.extract_value(arguments[0], position))
            for position, kind in enumerate(kinds)
        ]
        return context.make_tuple(builder, arrays, members)

    return arrays(arrays), generate


@overload(borrowed)
def _borrowed(arrays: Any) -> Any:
    def compiled(arrays: Any) -> Any:
        return _uncounted(arrays)

    return compiled


def _same_arrays(result: str, arguments: Any, aliases: Any, argument_aliases: Any) -> None:
    ir_utils._add_alias(result, arguments[0].name, aliases, argument_aliases)


# Tells numba that writing to the result is writing to the argument, or it could take the writes for
# useless and drop them.
ir_utils.alias_func_extensions[("borrowed", __name__)] = _same_arrays
