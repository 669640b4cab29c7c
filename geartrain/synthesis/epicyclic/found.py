"""What a search for epicyclic sets found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from geartrain.exact import abridged, as_float, decimal, written
from geartrain.synthesis.epicyclic.kinds import Mode
from geartrain.synthesis.result import Shortfall

RatioIs = Literal["input/output", "output/input"]
Order = Literal["error", "total", "largest"]


@dataclass(frozen=True, slots=True)
class EpicyclicSet:
    """Tooth counts of a set in one mode.

    teeth    by wheel
    ratio    speed of the input over that of the output, exact; negative where they turn against each other
    error    magnitude of the ratio, as it was asked for, over the wanted one, less 1; exact
    planets  the number asked for
    places   at how many equally spaced places identical planets can stand; 0 for anywhere
    room     between the tips of neighbouring planets, equally spaced (modules); negative where they overlap
    """

    kind: str
    mode: Mode
    teeth: Mapping[str, int]
    ratio: Fraction
    error: Fraction
    planets: int
    places: int
    room: float

    @property
    def inverse(self) -> Fraction:
        """Speed of the output over that of the input."""
        return 1 / self.ratio

    @property
    def equally_spaced(self) -> bool:
        """True if the planets can be put in at equal distances."""
        return self.places % self.planets == 0

    @property
    def clears(self) -> bool:
        """True if neighbouring planets do not touch."""
        return self.room >= -1e-9

    def __str__(self) -> str:
        teeth = ", ".join(f"{wheel} = {count}" for wheel, count in self.teeth.items())
        return f"{teeth}: {abridged(self.ratio)} = {decimal(self.ratio, 7)} ({self.mode})"

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "kind": self.kind,
            "mode": {"input": self.mode.input, "output": self.mode.output, "held": self.mode.held},
            "teeth": dict(self.teeth),
            "input/output": written(self.ratio),
            "output/input": written(self.inverse),
            "value": as_float(self.ratio),
            "error": float(self.error),
            "exact_error": written(self.error),
            "planets": self.planets,
            "places": self.places,
            "equally_spaced": self.equally_spaced,
            "room": None if self.room in (float("inf"), float("-inf")) else self.room,
            "total": sum(self.teeth.values()),
            "largest": max(self.teeth.values()),
        }


@dataclass(frozen=True, slots=True)
class SetFindings:
    """The best sets of a kind, best first.

    complete   True: all sets within the bounds were looked at
    count      sets within the tolerance, over all modes; all that run where no tolerance was asked
    solutions  the best of them
    shortfall  what became of the others; a set in each mode counts as one candidate
    """

    kind: str
    wanted: Fraction
    ratio_is: RatioIs
    modes: tuple[Mode, ...]
    tolerance: Fraction | None
    complete: bool
    count: int
    solutions: tuple[EpicyclicSet, ...]
    shortfall: Shortfall

    def __bool__(self) -> bool:
        return bool(self.solutions)

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "kind": self.kind,
            "wanted": str(self.wanted),
            "ratio_is": self.ratio_is,
            "modes": [mode.key for mode in self.modes],
            "tolerance": None if self.tolerance is None else float(self.tolerance),
            "complete": self.complete,
            "count": self.count,
            "solutions": [found.to_dict() for found in self.solutions],
            **self.shortfall.to_dict(),
        }


def rank(found: EpicyclicSet, by: Order, mode: int) -> tuple[Any, ...]:
    """The exact key of an order: its own measure first, then error, total, largest wheel, mode, counts."""
    counts = tuple(found.teeth.values())
    measures: dict[Order, Any] = {"error": abs(found.error), "total": sum(counts), "largest": max(counts)}
    return (measures[by], *measures.values(), mode, counts)
