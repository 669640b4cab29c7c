"""Named arrays whose last axis counts the same things: some of them, or several sets in one row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

if TYPE_CHECKING:
    from geartrain.contact.polynomials import Flags, Indices

Columns = TypeVar("Columns", bound=tuple[Any, ...])


def some(columns: Columns, which: Indices | Flags) -> Columns:
    """Those that are numbered, or flagged, in `which`."""
    kind: Any = type(columns)
    found: Columns = kind(*(each[..., which] for each in columns))
    return found


def joined(sets: Sequence[Columns]) -> Columns:
    """Several sets, one after another."""
    kind: Any = type(sets[0])
    found: Columns = kind(*(np.concatenate(each, axis=-1) for each in zip(*sets, strict=True)))
    return found
