"""Mesh of a gear pair whose tooth form defines only the outlines of both wheels, from which the motion follows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees, pi
from typing import TYPE_CHECKING

from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import PairSize

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.contact.outline_transmission import OutlineTransmission
    from geartrain.teeth.outlines.wheel_requirement import FixedTooth
    from geartrain.teeth.pair_results import PairAccount

_WORDS = (
    "Teeth whose motion follows from the contact of their outlines, each pair in its carrier's frame. Speed ratio over "
    "its mean; transmission error peak to peak and minimum backlash in degrees of the driven wheel; mean efficiency at "
    "constant driver torque, exact in friction, one pair of teeth carrying the load, as the pair is driven and driven "
    "back."
)
_HEADER = (
    *("pair", "drives", "teeth", "speed/mean", "error p-p (deg)", "backlash (deg)"),
    *("efficiency", "driven back", "verdict"),
)


@dataclass(frozen=True)
class OutlineMesh(GearMesh):
    """Spur pair with teeth of any shape. `teeth` are the teeth to cut on the first and second wheel [module]."""

    transmission: OutlineTransmission
    teeth: tuple[FixedTooth, FixedTooth]

    @property
    def tooth_phase(self) -> float:
        """Distance [pitch] by which a tooth of the driven wheel is past the line of centres when the driven angle is 0.

        In this position a tooth of the driver is on the line of centres, and flanks touch. The distance is the sum of
        half the tooth thicknesses of both wheels.
        """
        return self.transmission.gears.half_teeth / pi

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Return the sizes of the pair in modules. The tip radii `tips` of other pairs are not needed."""
        del tips
        distance = self.transmission.gears.distance
        return PairSize(1.0, distance, distance / self.wheels.touching)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """Return the tooth of `wheel` exactly as the tooth form defines it, for any `scale` and `tolerance`."""
        del scale, tolerance
        return self.teeth[self.gear.pair.index(wheel)]

    @property
    def displaced_contact(self) -> DisplacedContact:
        """Contact of one tooth pair of the outlines, and the lag of the driven wheel due to displaced flanks."""
        from geartrain.teeth.contact.displaced_outlines import displaced_outlines

        return displaced_outlines(self.transmission.gears, self.transmission.driver)

    def account(self) -> PairAccount:
        """Return the report on the pair: speed ratio, transmission error, backlash and efficiencies."""
        from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, motion_figures

        runs = bool(self.verdict)
        motion, own = motion_figures(self.transmission, runs), self.efficiency(self.driver)
        figures = PairFigures(self.counts, self.verdict, *motion, own if runs else None)
        speed = figures.speed_ratio
        row = (
            self.name,
            f"{self.driver} -> {self.driven}",
            self.tooth_form.words,
            "-" if speed is None else "{:.5f}..{:.5f}".format(*speed.relative),
            figures.error_text,
            f"{degrees(self.verdict.backlash):.4g}",
            *self.efficiency_texts,
            self.verdict.kind,
        )
        return PairAccount(_WORDS, (AccountTable(_HEADER, row, wide=True),), figures)
