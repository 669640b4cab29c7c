"""What a search for tooth numbers found, and why it found no more."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from geartrain.numerics.decimal_text import fraction_text
from geartrain.numerics.exact import as_float


@dataclass(frozen=True, slots=True)
class Shortfall:
    """Where candidates went: what an empty or short list says for itself.

    considered  candidates there were before anything was asked of them
    removed     reason -> candidates it removed; each candidate is charged to the first reason that refuses it
    nearest     the nearest miss in words, with its teeth and its error; empty where something was found
    advice      what to relax, and what that would give; empty where something was found
    """

    considered: int = 0
    removed: Mapping[str, int] | None = None
    nearest: str = ""
    advice: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "considered": self.considered,
            "removed": dict(self.removed or {}),
            "nearest": self.nearest,
            "advice": self.advice,
        }


@dataclass(frozen=True, slots=True)
class GearStages:
    """Tooth numbers of one ratio: the counts on top over the counts beneath, each an unordered set.

    top, beneath  ascending, as many as there are stages
    ratio         product of `top` over product of `beneath`, exact; positive
    error         ratio over the wanted magnitude, less 1; exact
    pairs         the stages as they are best paired: (count on top, count beneath)
    """

    top: tuple[int, ...]
    beneath: tuple[int, ...]
    ratio: Fraction
    error: Fraction
    pairs: tuple[tuple[int, int], ...]

    @property
    def teeth(self) -> tuple[int, ...]:
        """All counts, those on top first."""
        return self.top + self.beneath

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "teeth": [list(self.top), list(self.beneath)],
            "ratio": fraction_text(self.ratio),
            "value": as_float(self.ratio),
            "error": float(self.error),
            "exact_error": fraction_text(self.error),
            "stages": [list(pair) for pair in self.pairs],
            "total": sum(self.teeth),
            "largest": max(self.teeth),
            "distinct": len(set(self.teeth)),
        }
