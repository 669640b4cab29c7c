"""Tooth counts of the free wheels, what the outputs do with them, and by what they are put in order."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from geartrain.exact import as_float, written

By = Literal["error", "total", "largest", "distinct", "change"]
ORDERS: tuple[By, ...] = ("error", "total", "largest", "distinct", "change")


@dataclass(frozen=True, slots=True)
class Reached:
    """What an output does under an assignment.

    speed   exact, in the train's unit
    label   the demand it misses by most, such as "period 583.92 d"
    error   its relative error: |speed| / wanted - 1 against a target, speed / expected - 1 against an `expect` (the
            speed itself where 0 is expected)
    met     True if the output meets all that is demanded of it
    """

    speed: Fraction
    label: str
    error: Fraction
    met: bool

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "speed": written(self.speed),
            "value": as_float(self.speed),
            "target": self.label,
            "error": float(self.error),
            "exact_error": written(self.error),
            "met": self.met,
        }


@dataclass(frozen=True, slots=True)
class Assignment:
    """Tooth counts of the free wheels, and what the outputs do with them.

    teeth     wheel -> count, in the order declared
    outputs   output -> what it reaches; in a train with states the outputs are named "state: output"
    changed   wheels whose count is not the declared value
    """

    teeth: Mapping[str, int]
    outputs: Mapping[str, Reached]
    changed: tuple[str, ...] = ()

    @property
    def error(self) -> Fraction:
        """The largest |error| over the outputs; 0 without any."""
        return max((abs(reached.error) for reached in self.outputs.values()), default=Fraction(0))

    def measure(self, by: By) -> tuple[Fraction | int, ...]:
        """What it is ordered by: the order asked for, then error, total and largest; least is best."""
        sizes = tuple(self.teeth.values())
        total, largest = sum(sizes), max(sizes, default=0)
        first: dict[By, Fraction | int] = {
            "error": self.error,
            "total": total,
            "largest": largest,
            "distinct": len(set(sizes)),
            "change": len(self.changed),
        }
        return first[by], self.error, total, largest

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        sizes = tuple(self.teeth.values())
        return {
            "teeth": dict(self.teeth),
            "outputs": {name: reached.to_dict() for name, reached in self.outputs.items()},
            "error": float(self.error),
            "total": sum(sizes),
            "largest": max(sizes, default=0),
            "distinct": len(set(sizes)),
            "changed": list(self.changed),
        }
