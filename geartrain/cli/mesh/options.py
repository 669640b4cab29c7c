"""Where a complaint about a pair of `geartrain mesh` belongs."""

from __future__ import annotations

from geartrain.errors import GearTrainError


def placed(error: GearTrainError, place: str) -> GearTrainError:
    """The error with the option it came from, where it names no place itself."""
    from dataclasses import replace

    return GearTrainError(
        replace(problem, place=problem.place or place.replace("_", "-")) for problem in error.problems
    )
