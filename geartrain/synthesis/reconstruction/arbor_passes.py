"""How the path to a dial may lead through a surviving arbor: which of its wheels is driven and which one drives."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from geartrain.synthesis.reconstruction.reconstruction_problem import (
    PlacedWheel,
    ReconstructionProblem,
    SurvivingArbor,
    SurvivingWheel,
)

ADDED = PlacedWheel(None, 0)
"""An added wheel whose count is still open."""


@dataclass(frozen=True)
class ArborPass:
    """One way through an arbor.

    driven   the wheel by which the path comes in, None on the input arbor
    driver   the wheel by which it goes on, the driven one itself where that is an idler; None where the path ends
    idle     number of surviving wheels that it passes by
    """

    driven: PlacedWheel | None
    driver: PlacedWheel | None
    idle: int
    idler: bool = False

    @property
    def added_drivers(self) -> int:
        """Whether the wheel that drives is an added one: 0 or 1; an idler has no part in the speed."""
        return int(self.driver == ADDED and not self.idler)

    @property
    def added_driven(self) -> int:
        """Whether the wheel that is driven is an added one that has a part in the speed: 0 or 1."""
        return int(self.driven == ADDED and not self.idler)

    def meshes_with(self, rings: frozenset[str]) -> int:
        """Number of its meshes in which one of some wheels is; an idler is in two."""
        return sum(wheel is not None and wheel.name in rings for wheel in (self.driven, self.driver))

    @property
    def added(self) -> int:
        """Number of added wheels."""
        return (self.driven == ADDED) + self.added_drivers


def arbor_passes(arbor: SurvivingArbor, problem: ReconstructionProblem) -> Iterator[ArborPass]:
    """All ways through a surviving arbor, and those that end at it.

    An added wheel beside surviving ones only drives; where no wheel survives, one is added that is driven.
    """
    beside = problem.additions.on == "any" and problem.additions.wheels > 0
    is_input = arbor is problem.input
    for driven in _driven_wheels(arbor, problem, beside):
        others = [wheel for wheel in arbor.wheels if driven is None or wheel.name != driven.name]
        drivers = [reading for wheel in others for reading in readings(wheel)]
        for driver in drivers:
            yield ArborPass(driven, driver, len(others) - 1)
        if beside:
            yield ArborPass(driven, ADDED, len(others))
        if problem.idlers and not is_input:
            yield ArborPass(driven, driven, len(others), idler=True)
        yield ArborPass(driven, None, len(others))


def _driven_wheels(arbor: SurvivingArbor, problem: ReconstructionProblem, beside: bool) -> Iterator[PlacedWheel | None]:
    if arbor is problem.input:
        yield None
    elif arbor.wheels:
        for wheel in arbor.wheels:
            yield from readings(wheel)
    elif beside:
        yield ADDED


def readings(wheel: SurvivingWheel) -> Iterator[PlacedWheel]:
    """A surviving wheel with each count that it may have."""
    for teeth, _ in wheel.counts:
        yield PlacedWheel(wheel.name, teeth)
