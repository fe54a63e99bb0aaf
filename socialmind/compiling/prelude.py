"""What every compiled module begins with, as text: numbers, draws, and how arrays are reached."""

from __future__ import annotations

from socialmind.language.interpreting import RUNTIME

HEAD = '''"""Generated from a model's rules; see ARCHITECTURE.md, "One definition, two speeds"."""

import numpy as np
from numba import carray, njit

from coglogo_py import kernel as _kernel
from coglogo_py.arrays import MindArrays as _MindArrays
from coglogo_py.arrays import SchemeArrays as _SchemeArrays
from coglogo_py.compiled.machine_code import kept as _kept
from socialmind import streams as _streams
from socialmind.language import arithmetic as _arithmetic
from socialmind.compiling.memory import as_pointer as _as_pointer
from socialmind.compiling.memory import fetch_ahead as _fetch_ahead
from socialmind.compiling.memory import index as _index
from socialmind.compiling.memory import some as _some

# What only compiled code calls needs no door for Python; each would cost time to compile.
_inner = njit(no_cpython_wrapper=True, no_cfunc_wrapper=True)
_int64 = np.int64
_as_int = int
_as_float = float
_abs = abs
_len = len
_range = range
_nan = np.nan
STREAM = _streams.STREAM
_rng_random = _streams.random
_rng_uniform = _streams.uniform
_rng_integers = _streams.integers
_rng_normal = _streams.normal
_rng_exponential = _streams.exponential
_rng_gamma = _streams.gamma
_rng_poisson = _streams.poisson
_rng_weighted = _streams.weighted
_rng_permutation = _streams.permutation
_rng_shuffle = _streams.shuffle_array
_begin = _streams.begin
_shuffle = _streams.shuffle


@_inner
def _stream(_model):
    return carray(_as_pointer(_model._stream), (1,), STREAM)[0]'''


def runtime_names() -> str:
    """Return the names by which rules call the arithmetic that both speeds share."""
    builtins = (
        "_present", "_agent_there", "_perhaps", "_as_int", "_as_float", "_abs", "_len", "_range",
        "_print", "_breakpoint",
    )  # fmt: skip
    return "\n".join(f"{name} = _arithmetic.{name[1:]}" for name in RUNTIME if name not in builtins)
