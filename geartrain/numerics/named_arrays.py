"""Named arrays whose last axis counts the same things: some of them, or several sets in one row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Indices

NamedArrays = TypeVar("NamedArrays", bound=tuple[Any, ...])


def some(columns: NamedArrays, which: Indices | Bools) -> NamedArrays:
    """Those that are numbered, or flagged, in `which`."""
    kind: Any = type(columns)
    found: NamedArrays = kind(*(each[..., which] for each in columns))
    return found


def joined(sets: Sequence[NamedArrays]) -> NamedArrays:
    """Several sets, one after another."""
    kind: Any = type(sets[0])
    found: NamedArrays = kind(*(np.concatenate(each, axis=-1) for each in zip(*sets, strict=True)))
    return found
