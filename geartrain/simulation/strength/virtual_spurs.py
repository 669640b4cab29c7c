"""Virtual spur wheels, and the point contact of wheels on crossed axes.

Straight bevel gears are replaced by Tredgold's virtual spur wheels. Helical wheels on crossed axes and worms, whose
teeth have point contact, are replaced by the virtual spur wheels of their normal sections.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

from geartrain.dynamics.wheel_teeth import CHORD
from geartrain.errors import GearTrainError
from geartrain.simulation.strength.contact_pressure import (
    YIELD_AT_POINT,
    CrossedWheels,
    Elasticity,
    elasticity_factor,
)
from geartrain.simulation.strength.iso_6336 import ToothSide
from geartrain.simulation.strength.strength_results import FlankStrength, PointContact, WheelForce
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.outlines.tooth_requirement import CLEARANCE, ToothRequirement

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.involute import Involute
    from geartrain.teeth.outlines.wheel_requirement import CutTooth
    from geartrain.train import Material


_MM = 1e3
_FLATTEST = 0.01  # minimum cosine of a cone half-angle; below, the virtual spur wheel is nearly a rack
_WIDEST = 1 / 3  # usual maximum width divided by the cone distance
_SPREAD = 2.0  # width over which a point force is distributed at the root, divided by its lever arm
_MPA = 1e6
_WORDS = {
    "base": "a tip reaches below the mate's base cylinder, where the flank ends: give the smaller wheel more teeth",
    "width": "the width of a wheel limits the path of contact",
}


@dataclass(frozen=True)
class ConeMiddle:
    """Pitch cones of a bevel pair at the middle of its face width, equation (23) of docs/strength.md. All lengths have
    the same unit.
    """

    cones: PitchSurfaces
    """Pitch cones of gears 1 and 2."""
    module: float
    """Module at the large ends. `width` is the width of the teeth from the large ends towards the apex."""
    width: float

    @property
    def reach(self) -> float:
        """Cone distance: distance from the apex to the large end along a pitch cone."""
        return self.module * self.cones.z1 / 2 / sin(self.cones.R1)

    @property
    def shrunk(self) -> float:
        """Ratio of lengths at the middle of the face width to lengths at the large ends [1]."""
        return 1 - self.width / 2 / self.reach

    def cone(self, gear: int) -> float:
        """Return the half-angle of the pitch cone of one gear [rad]."""
        return abs(self.cones.axle_of(gear))

    def radius(self, gear: int) -> float:
        """Return the pitch radius of one gear at the middle of the face width."""
        return self.shrunk * self.module * self.cones.teeth_of(gear) / 2


@dataclass(frozen=True)
class VirtualSpurs:
    """Virtual spur pair of a bevel pair, and its module, both at the middle of the face width."""

    middle: ConeMiddle
    form: ConjugateToothForm

    @classmethod
    def of(cls, mesh: GearMesh, module: float, width: float) -> VirtualSpurs | None:
        """Return the virtual spurs for a module at the large ends and a face width, or None without a common apex."""
        form = mesh.tooth_form
        if mesh.path is None or not mesh.path.pitch.bevel or not isinstance(form, ConjugateToothForm):
            return None
        return cls(ConeMiddle(mesh.path.pitch, module, width), form)

    @property
    def why_not(self) -> str:
        """Reason why the virtual spur pair does not exist; empty if it exists."""
        if self.middle.shrunk <= 1 / 2:
            return "the width of its teeth exceeds the cone distance"
        # the virtual number of teeth goes to infinity for a crown wheel
        if min(cos(self.middle.cone(gear)) for gear in (1, 2)) < _FLATTEST:
            return "the cone of one wheel is flat or internal, so its virtual spur wheel does not exist"
        return ""

    @property
    def is_wide(self) -> bool:
        """True if the face width exceeds the usual limit of a third of the cone distance."""
        return self.middle.width > _WIDEST * self.middle.reach

    def count(self, gear: int) -> float:
        """Return the virtual number of teeth of one wheel, which is not an integer in general."""
        # Tredgold's approximation: the back cone is developed into a plane
        return self.middle.cones.teeth_of(gear) / cos(self.middle.cone(gear))

    @cached_property
    def wheels(self) -> WheelPair:
        """Both virtual spur wheels, scaled to the module at the large ends, to which declared lengths refer."""
        return WheelPair(self.count(1), self.count(2), module=self.middle.module)

    @cached_property
    def pair(self) -> ConjugatePair:
        """Conjugate pair of virtual spur wheels, with its path of contact.

        Raises `GearTrainError` if the tooth form has no path of contact.
        """
        return self.form.pair(self.wheels)

    def teeth(self, gear: int) -> CutTooth:
        """Return the cut tooth of one virtual wheel."""
        free = self.form.bottom_clearance(self.wheels, gear)
        clearance = CLEARANCE if free is None else max(free, 0.0)
        return ToothRequirement(self.pair, gear, CHORD, clearance, self.form.lantern_pins(self.wheels)).cut([])


@dataclass(frozen=True)
class SkewPair:
    """Pair of wheels on crossed axes, with the forces on both wheels in the order of the pair."""

    wheels: CrossedWheels
    """Geometry of both wheels. `forces` contains the forces on each wheel."""
    forces: tuple[WheelForce, WheelForce]
    materials: tuple[tuple[str, Material], tuple[str, Material]]
    """Materials of both wheels, each preceded by its name."""
    is_worm: bool
    """True if one wheel is a worm."""
    form: Involute
    """Tooth form in the normal section."""

    def contact(self) -> PointContact:
        """Return the point contact of the pair, with its pressures and root stresses."""
        # the separating force is a fixed fraction of the normal force, whatever the friction
        normal = max(abs(each.radial or 0.0) for each in self.forces) / sin(self.wheels.pressure_angle)
        factor = elasticity_factor(*(Elasticity.of(material) for _, material in self.materials))
        worst = self.wheels.worst(normal, factor)
        return PointContact(
            self.forces[0].pair,
            self.wheels.contact_ratio,
            normal,
            self.wheels.ellipse(0.0, normal, factor).pressure,
            *worst,
            tuple(self._flank(at, worst.pressure, normal) for at in (0, 1)),
            tuple(self._notes()),
        )

    def _flank(self, at: int, pressure: float, normal: float) -> FlankStrength:
        name, material = self.materials[at]
        wheel, strength = self.forces[at].wheel, material.strength
        bent = self._root_stress(at, normal)
        if strength is None:
            return FlankStrength(wheel, name, None, None, None, bent)
        # yield stress of the material
        bears = strength.si / _MPA
        return FlankStrength(wheel, name, bears, float(material.spread.value), YIELD_AT_POINT * bears / pressure, bent)

    @cached_property
    def _pair(self) -> ConjugatePair | None:
        """Pair of virtual spur wheels in the normal sections, equation (27) of docs/strength.md; None without one."""
        counts = self.wheels.normal_count(0), self.wheels.normal_count(1)
        try:
            return self.form.pair(WheelPair(*counts, module=self.wheels.module / _MM))
        except GearTrainError:
            return None

    def _root_stress(self, at: int, force: float) -> float | None:
        """Return the root stress of wheel `at` (0 or 1) under a normal force at the tip of a tooth [MPa]; None if the
        virtual wheel cannot be cut.

        The force is distributed over a length of twice its lever arm about the root, or over the tooth if that is
        shorter.
        """
        if self._pair is None:
            return None
        form, module = self.form, self.wheels.module
        # bottom clearance of the form, or the default one
        free = form.bottom_clearance(WheelPair(self._pair.path.pitch.z1, self._pair.path.pitch.z2), at + 1)
        clearance = CLEARANCE if free is None else max(free, 0.0)
        try:
            tooth = ToothRequirement(self._pair, at + 1, CHORD, clearance).cut([])
        except GearTrainError:
            return None
        side = ToothSide.of(tooth.tooth)
        # base radius of the virtual wheel in modules
        arm = self.wheels.normal_count(at) / 2 * cos(self.wheels.pressure_angle)
        load = side.load_at(tooth.tip, arm)
        section = side.weakest_section(load)
        # the load spreads at 45 degrees to both sides of the point of contact
        width = min(self.wheels.tooth_length(at), _SPREAD * (load.apex - section.x) * module)
        return section.stress(force * arm * module, width, module)

    def _notes(self) -> Iterator[str]:
        if self.is_worm:
            yield "its wheel is treated as helical with point contact, not as a throated one with line contact"
        if self.wheels.contact_ratio < 1:
            yield "its contact ratio is below 1: a tooth pair separates before the next one touches"
        if any(self._root_stress(at, 1.0) is None for at in (0, 1)):
            yield "its virtual spur wheels cannot be cut, so bending is not computed"
        yield from (_WORDS[why] for why in sorted(self.wheels.bounded_by) if why in _WORDS)
