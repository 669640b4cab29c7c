"""Types of numpy arrays, operations on long arrays and on named tuples of arrays, and arrays as text in JSON."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Sequence
from typing import Any, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Indices = NDArray[np.intp]


def packed(values: NDArray[Any], kind: Literal["<f8", "<f4", "<u4"] = "<f8") -> str:
    """Return an array, row by row, as lossless base64 text of little-endian numbers."""
    return b64encode(values.astype(kind).tobytes()).decode("ascii")


_BLOCK = 16384  # values whose intermediate arrays fit into the cache: formulas take a half to a third of the time


def blocks(count: int) -> Iterator[slice]:
    """Yield slices that divide `count` values into blocks whose intermediate arrays fit into the cache."""
    return (slice(start, start + _BLOCK) for start in range(0, count, _BLOCK))


def remainder(values: Floats, period: float) -> Floats:
    """Return the remainders of values divided by a period; rounding can move them slightly out of [0, `period`).

    This is four times as fast as `numpy.mod`. The period is the sum of two numbers, so that the first product is exact
    for up to 10^8 periods.
    """
    coarse = float(np.float32(period))
    whole = np.floor(values * (1 / period))
    found: Floats = values - whole * coarse - whole * (period - coarse)
    return found


NamedArrays = TypeVar("NamedArrays", bound=tuple[Any, ...])


def some(columns: NamedArrays, which: Indices | Bools) -> NamedArrays:
    """Return a named tuple of arrays that keeps only the entries of the last axis selected by an index or mask."""
    kind: Any = type(columns)
    found: NamedArrays = kind(*(each[..., which] for each in columns))
    return found


def joined(sets: Sequence[NamedArrays]) -> NamedArrays:
    """Join several named tuples of arrays along the last axis, field by field."""
    kind: Any = type(sets[0])
    found: NamedArrays = kind(*(np.concatenate(each, axis=-1) for each in zip(*sets, strict=True)))
    return found
