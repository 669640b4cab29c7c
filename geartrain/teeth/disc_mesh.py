"""A disc of lobes in its ring of pins, as a train asks of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import degrees
from typing import TYPE_CHECKING

from geartrain.teeth.cycloidal_disc import DiscTransmission
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import PairSize
from geartrain.teeth.pair_account import AccountTable, PairAccount, PairFigures, motion_figures

if TYPE_CHECKING:
    from geartrain.teeth.outlines.wheel_requirement import FixedTooth
    from geartrain.teeth.pair_verdict import PairVerdict

_WORDS = (
    "Discs of lobes in rings of pins, each in the frame of its eccentric. Shortening is the ring's pitch radius over "
    "that of the pins' circle; bearing, how many pins bear at once, which are fewer where a clearance and the "
    "`deflection` of a pin are given; the greatest load is that of one pin over the force on the disc's pitch circle, "
    "pins equally stiff; play in degrees of the driven wheel; efficiency of pins that do not roll, as the pair is "
    "driven, and driven back."
)
_HEADER = (
    *("pair", "drives", "lobes", "pins", "shortening", "pin radius", "bearing", "greatest load", "play (deg)"),
    *("efficiency", "driven back"),
)


def _counted(fewest: int, most: int) -> str:
    return str(most) if fewest == most else f"{fewest} to {most}"


@dataclass(frozen=True)
class DiscFigures(PairFigures):
    """Of a disc in its ring of pins.

    shortening      the ring's pitch radius over that of the pins' circle
    pin_radius      in modules
    greatest_load   of one pin over the force on the disc's pitch circle
    bearing         fewest and most pins that bear at once
    """

    KEYS = (*PairFigures.KEYS, "shortening", "pin_radius", "greatest_load", "bearing")

    shortening: float
    pin_radius: float
    greatest_load: float
    bearing: tuple[int, int]


@dataclass(frozen=True)
class DiscMesh(GearMesh):
    """A disc and its ring of pins; gear 1 is the disc."""

    law: DiscTransmission

    @cached_property
    def reversed(self) -> DiscTransmission:
        """The law with the other wheel driving."""
        return self.law.reversed

    @property
    def verdict(self) -> PairVerdict:
        """Whether these teeth can turn."""
        return self.law.verdict

    @property
    def gears(self) -> tuple[str, str]:
        """The disc and its ring."""
        first, second = self.gear.pair
        return (second, first) if self.wheels.internal[0] else (first, second)

    @property
    def stands(self) -> float:
        """A lobe stands between two pins, less half the play."""
        return (1 - self.play) / 2

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Lengths of the law are modules already."""
        del tips
        return PairSize(1.0, 0.5, 1.0)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """A lobe, or a pin."""
        del scale
        return self.law.disc.lobe(tolerance) if wheel == self.gears[0] else self.law.disc.pin_tooth()

    def account(self) -> PairAccount:
        """Sizes, the greatest load, play and efficiency."""
        disc = self.law.disc
        figures = DiscFigures(
            self.counts,
            self.verdict,
            *motion_figures(self.law),
            self.efficiency(self.driver),
            disc.shortening,
            disc.pin,
            disc.greatest_load,
            disc.bearing_pins,
        )
        row = (
            *(self.name, f"{self.driver} -> {self.driven}", str(disc.lobes), str(disc.pins)),
            *(f"{disc.shortening:.4g}", f"{disc.pin:.4g}", _counted(*disc.bearing_pins)),
            f"{disc.greatest_load:.4g}",
            *(f"{degrees(self.verdict.play):.4g}", *self.efficiency_texts),
        )
        return PairAccount(_WORDS, (AccountTable(_HEADER, row, wide=True),), figures)
