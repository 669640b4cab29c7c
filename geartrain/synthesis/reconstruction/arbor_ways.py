"""The ways in which a path leads through a surviving arbor: which wheel is driven, which drives, which are added."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.synthesis.reconstruction.count_products import Counts
from geartrain.synthesis.reconstruction.reconstruction_problem import SurvivingArbor, SurvivingWheel


@dataclass(frozen=True)
class PathWheel:
    """A wheel on a path, by its name if it survives, and the counts it may have."""

    name: str | None
    counts: Counts

    @staticmethod
    def of(wheel: SurvivingWheel) -> PathWheel:
        """A surviving wheel."""
        return PathWheel(wheel.name, tuple(count for count, _ in wheel.counts))


@dataclass(frozen=True)
class ArborWay:
    """One way through an arbor: the wheel that is driven and the one that drives, None at the end of a path."""

    arbor: str | None
    driven: PathWheel
    driver: PathWheel | None

    @property
    def added(self) -> int:
        """How many of the two are added."""
        return (self.driven.name is None) + (self.driver is not None and self.driver.name is None)


@dataclass(frozen=True)
class Stretch:
    """Arbors between a wheel, or an arbor, and the arbor of a dial, their order left open.

    ways       through surviving arbors
    compounds  number of added arbors of two added wheels
    end        the arbor of the dial
    """

    ways: tuple[ArborWay, ...]
    compounds: int
    end: ArborWay

    @property
    def meshes(self) -> int:
        """Number of meshes."""
        return len(self.ways) + self.compounds + 1

    @cached_property
    def sure_ratio(self) -> Fraction:
        """Product of the counts that are sure: those of drivers over those of driven wheels."""
        ratio = Fraction(1)
        for way in (*self.ways, self.end):
            if len(way.driven.counts) == 1:
                ratio /= way.driven.counts[0]
            if way.driver is not None and len(way.driver.counts) == 1:
                ratio *= way.driver.counts[0]
        return ratio

    @cached_property
    def open_wheels(self) -> tuple[tuple[PathWheel, ...], tuple[PathWheel, ...]]:
        """Drivers and driven wheels of surviving arbors whose counts are open."""
        every = (*self.ways, self.end)
        drivers = tuple(way.driver for way in every if way.driver is not None and len(way.driver.counts) > 1)
        return drivers, tuple(way.driven for way in every if len(way.driven.counts) > 1)


def ways_through(arbor: SurvivingArbor, added: PathWheel | None) -> Iterator[ArborWay]:
    """All ways on which every surviving wheel meshes; with an added wheel where one may stand beside them."""
    wheels = tuple(map(PathWheel.of, arbor.wheels))
    if len(wheels) == 2:
        for driven, driver in (wheels, wheels[::-1]):
            yield ArborWay(arbor.name, driven, driver)
    elif added is not None and len(wheels) == 1:
        yield ArborWay(arbor.name, wheels[0], added)
        yield ArborWay(arbor.name, added, wheels[0])
    elif added is not None and not wheels:
        yield ArborWay(arbor.name, added, added)


def ways_to_end(arbor: SurvivingArbor, added: PathWheel | None) -> Iterator[ArborWay]:
    """All ways in which a path ends at a surviving arbor with all its wheels in mesh."""
    if len(arbor.wheels) == 1:
        yield ArborWay(arbor.name, PathWheel.of(arbor.wheels[0]), None)
    elif not arbor.wheels and added is not None:
        yield ArborWay(arbor.name, added, None)
