"""Strength of one gear pair under its torque, computed from its declared data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import atan, cos, pi, sin, tan
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import RangeError
from geartrain.simulation.strength.contact_pressure import (
    ContactLoad,
    Elasticity,
    base_helix_angle,
    deepest_passage,
    elasticity_factor,
    loss_over_friction,
)
from geartrain.simulation.strength.iso_6336 import (
    HelixData,
    IsoContact,
    IsoRoot,
    RackPair,
    RackWheel,
    RootSection,
    ToothSide,
    contact_stress,
    helical_root_stress,
    outer_single_contact,
    pin_stress,
    root_stress,
)
from geartrain.simulation.strength.strength_results import FlankWear, PairStrength, WearRange, WheelStrength
from geartrain.teeth.involute import Involute

if TYPE_CHECKING:
    from geartrain.dynamics.wheel_teeth import WheelTeeth
    from geartrain.simulation.strength.virtual_spurs import VirtualSpurs
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.outlines.wheel_requirement import CutTooth
    from geartrain.train import Material

_MPA = 1e6
_MM = 1e3
_POSITIONS = 401


@dataclass(frozen=True)
class WheelUnderLoad:
    """Wheel of a loaded pair, with its teeth, material, design torque and revolutions."""

    name: str
    gear: int
    """Number of the wheel in the transmission function, 1 or 2."""
    z: float
    """Number of teeth. `teeth` is the geometry of the cut teeth [module]. For a bevel gear, both describe the virtual
    spur wheel.
    """
    teeth: CutTooth | WheelTeeth
    material_name: str
    material: Material
    torque: float
    """Design torque [N m]. `turns` is the number of revolutions relative to the carrier; None if no service life is
    given.
    """
    turns: float | None

    @cached_property
    def side(self) -> ToothSide:
        """Half outline of one tooth, with lengths in modules."""
        return ToothSide.of(self.teeth.tooth, -1 if self.teeth.kind == "ring" else 1)


@dataclass(frozen=True)
class PairUnderLoad:
    """Gear pair under load, for which pressures, stresses and wear are computed. Lengths are in mm."""

    mesh: GearMesh
    """Declared gear pair with its tooth form."""
    wheels: tuple[WheelUnderLoad, WheelUnderLoad]
    """Both wheels in the order of the pair."""
    module: float
    """Module [mm]."""
    width: float
    """Face width of the narrower wheel [mm]."""
    wear: WearRange
    """Minimum and maximum wear coefficient [1]."""
    spurs: VirtualSpurs | None = None
    """Virtual spur pair of a pair of bevel gears; None for other wheels."""
    swing: float = 1.0
    """Ratio of the design torque, which is used for stresses, to the mean torque, which is used for wear."""
    remarks: tuple[str, ...] = ()
    """Restrictions on the validity of the results, which follow from the wheels of the pair."""

    def strength(self) -> PairStrength:
        """Return the stresses, safety factors and wear of the pair."""
        iso, roots = self._iso()
        return PairStrength(
            self.mesh.name,
            self.mesh.form,
            self.module,
            self.width,
            self.tangential,
            self.factor,
            () if self.load is None else self.load.places(),
            iso,
            tuple(self._wheel(at, roots) for at in (0, 1)),
            tuple(self._notes()),
        )

    # ---------------------------------------------------------------------------------------------------- the load

    @property
    def factor(self) -> float:
        """Elasticity factor ZE [sqrt(MPa)]."""
        return elasticity_factor(*(Elasticity.of(each.material) for each in self.wheels))

    def _radius(self, at: int) -> float:
        """Return the operating pitch radius of wheel number `at` of the pair, 0 or 1 [mm]."""
        path = self.path
        if path is not None:
            return abs(path.pitch.axle_of(self.wheels[at].gear)) * self.module
        size = self.mesh.own_size
        return self.wheels[at].z / 2 * self.module * (1.0 if size is None else size.stretch)

    def _cone_factor(self, at: int) -> float:
        """Return the cosine of the pitch cone angle of wheel `at` of a bevel pair, which relates its radii to the
        radii of its virtual spur wheel; 1 for spur wheels.
        """
        return 1.0 if self.spurs is None else cos(self.spurs.middle.cone(self.wheels[at].gear))

    @property
    def tangential(self) -> float:
        """Tangential force at the pitch line [N].

        It is the larger of the two forces that follow from the torques on the wheels, because friction reduces one of
        the torques.
        """
        arms = (self._radius(at) * self._cone_factor(at) for at in (0, 1))
        # friction reduces the torque on one wheel, so the larger force is used for both
        return max(abs(each.torque) * _MM / arm for each, arm in zip(self.wheels, arms, strict=True))

    @property
    def path(self) -> PathOfContact | None:
        """Path of contact; None if the tooth form has no path of contact."""
        return self.mesh.path if self.spurs is None else self.spurs.pair.path

    @cached_property
    def load(self) -> ContactLoad | None:
        """Contact load along the path of contact; None if there is no path of contact."""
        path = self.path
        if path is None:
            return None
        # torque on gear 1 that gives this force, also for bevels
        torque = self.tangential * path.pitch.R1 * self.module
        return ContactLoad(path, self.module, self.width, torque, self.factor, self.lean.base, self.lean.overlap)

    @cached_property
    def lean(self) -> HelixData:
        """Helix data of involute teeth on parallel axes; zero angles for spur teeth and for other tooth forms."""
        helix, form = abs(self.mesh.wheels.helix[0]), self.mesh.tooth_form
        if not helix or not isinstance(form, Involute):
            return HelixData()
        # the declared module is transverse
        normal = self.module * cos(helix)
        return HelixData(helix, base_helix_angle(helix, form.rack_angle), self.width * sin(helix) / (pi * normal))

    def _notes(self) -> Iterator[str]:
        yield from self.remarks
        if self.load is None:
            yield "its form has no path of contact: Hertz pressure is not computed, and the load acts at the tip"
        elif self.load.has_cusp:
            yield "flanks have infinite curvature at the pitch point: Hertz pressure is unbounded there until they wear"
        if self.spurs is not None:
            counts = " and ".join(f"{each.z:.4g}" for each in self.wheels)
            yield f"its bevels are treated as virtual spur wheels of {counts} teeth, with the module at mid-width"
            if self.spurs.is_wide:
                yield "its teeth are wider than a third of the cone distance, so the load is not uniform"
        elif self.mesh.form == "involute" and self._rack_pair() is None:
            yield "ISO 6336 is applied only to external involutes with a contact ratio from 1 to 2"
        if self.lean.helix:
            yield (
                "its teeth are helical: the load is uniform along lines of contact of minimum total length; bending "
                "at the tip is that of the part of a tooth with one line of contact"
            )

    # ------------------------------------------------------------------------------------------------------- roots

    def _wheel(self, at: int, roots: tuple[IsoRoot | None, IsoRoot | None] | None) -> WheelStrength:
        own = self.wheels[at]
        torque = self.tangential * self._radius(at)
        # at a cusp the pressure is infinite, so a safety factor does not exist
        bounded = self.load is not None and not self.load.has_cusp
        pressure = self.load.single_pressure() if bounded and self.load is not None else None
        strength = own.material.strength
        tip, tip_stress, shared = self._bending(at, torque)
        return WheelStrength(
            wheel=own.name,
            material=own.material_name,
            torque=own.torque,
            section=0.0 if tip is None else tip.x * self.module * self._cone_factor(at),
            thickness=0.0 if tip is None else tip.thickness * self.module,
            lewis=0.0 if tip is None else tip.lewis_factor(self._radius(at) / self.module),
            tip_stress=tip_stress,
            shared_stress=shared,
            pressure=pressure,
            strength=None if strength is None else strength.si / _MPA,
            spread=None if strength is None else float(own.material.spread.value),
            iso=None if roots is None else roots[at],
            wear=self._wear(at),
        )

    def _bending(self, at: int, torque: float) -> tuple[RootSection | None, float, float | None]:
        """Return the weakest section of a tooth whose tip carries the whole load, the bending stress in this section
        [MPa], and the maximum bending stress if tooth pairs share the load [MPa].

        The section is None for a pin. The last stress is None if it is not computed.
        """
        own, load = self.wheels[at], self.load
        if (pins := own.teeth.pins) is not None:
            return None, pin_stress(self.tangential, self.width, 2 * pins.radius * self.module), None
        if load is None:
            tip = own.side.weakest_section(own.side.load_at_tip())
            return tip, tip.stress(torque, self.width, self.module), None
        path = load.path
        (_, radius), X = path.radii(own.gear), path.ends(own.gear)[1]
        arm = abs(path.pitch.axle_of(own.gear)) * float(path.at(np.array([X])).cos_psi[0])
        tip = own.side.weakest_section(own.side.load_at(radius, arm))
        tip_stress = tip.stress(torque, self.width, self.module)
        if self.lean.helix:
            # each width element carries the load on its part of the lines of contact; in the normal section the tooth
            # is thinner and the load larger
            return tip, tip_stress / (load.lines * cos(self.lean.helix) ** 2), None
        low, high = load.single()
        outer = high if own.gear == 1 else low
        places = np.append(np.linspace(-path.arcs[0], path.arcs[1], _POSITIONS), outer)
        # the boundary of single contact is evaluated on the side where one tooth pair carries the whole load
        places = np.where(np.abs(places - outer) < 1e-9, np.clip(places, low + 1e-7, high - 1e-7), places)
        force, _ = load.forces(places)
        radii, _ = path.pitch.polar(own.gear, path.flank(own.gear, places))
        arms = abs(path.pitch.axle_of(own.gear)) * path.at(places).cos_psi
        torques = force * arms * self.module
        stresses = own.side.bending_factors(radii, arms) * torques / (self.width * self.module**2)
        return tip, tip_stress, float(stresses.max())

    # ------------------------------------------------------------------------------------------------- ISO and wear

    def _rack_pair(self) -> RackPair | None:
        """Return both wheels in the transverse section as cut by a rack; None if ISO 6336 does not apply."""
        form, load = self.mesh.tooth_form, self.load
        if not isinstance(form, Involute) or load is None or load.path.pitch.R2 < 0 or self.spurs is not None:
            return None
        path, flat = load.path, cos(self.lean.helix)
        # in the order of the pair, which is that of gears 1 and 2 of an external pair
        wheels = [
            RackWheel(
                each.z,
                float(form.shift[at].value) * flat,
                each.z / 2 + (float(form.shift[at].value) + float(form.addendum[at].value)) * flat,
                float(form.dedendum[at].value) * flat,
            )
            for at, each in enumerate(self.wheels)
        ]
        working = float(path.at(np.zeros(1)).psi[0])
        angle = atan(tan(form.rack_angle) / flat)
        try:
            return RackPair(wheels[0], wheels[1], angle, working, path.contact_ratio, self.lean)
        except RangeError:
            return None

    def _iso(self) -> tuple[IsoContact | None, tuple[IsoRoot | None, IsoRoot | None] | None]:
        pair = self._rack_pair()
        if pair is None:
            return None, None
        # the standard uses the force at the reference circle
        force = self.tangential * cos(pair.angle) / cos(pair.working)
        form, roots = self.mesh.tooth_form, list[IsoRoot | None]()
        for at, wheel in enumerate((pair.first, pair.second)):
            if self.lean.helix and isinstance(form, Involute):
                shift, addendum = float(form.shift[at].value), float(form.addendum[at].value)
                across = RackWheel(wheel.z, shift, shift + addendum, float(form.dedendum[at].value))
                normal = self.module * cos(self.lean.helix)
                roots.append(helical_root_stress(across, form.rack_angle, pair, force, self.width, normal))
            else:
                radius = outer_single_contact(wheel, pair.angle, pair.contact_ratio)
                roots.append(root_stress(wheel, pair.angle, force, self.width, self.module, radius))
        return contact_stress(pair, self.factor, force, self.width, self.module), (roots[0], roots[1])

    def _wear(self, at: int) -> FlankWear | None:
        own = self.wheels[at]
        hardness = own.material.hardness_pressure
        loss = None if own.turns is None or hardness is None else loss_over_friction(self.mesh)
        if own.turns is None or hardness is None or loss is None:
            return None
        # wear follows from the mean torque
        slid = abs(own.torque) / self.swing * 2 * pi * own.turns * loss * _MM  # N mm
        per = slid / (hardness / _MPA)  # mm3 for K = 1
        # total area of the worn flanks, one flank of each tooth
        flank = self.mesh.wheels.counts[at] * self.width * abs(own.teeth.tip - own.teeth.root) * self.module
        deep = None
        if self.load is not None and not self.lean.helix:
            deep = deepest_passage(self.load, own.gear) / self.swing * own.turns / (hardness / _MPA)
        return FlankWear(
            own.turns, self._range(per), self._range(per / flank), None if deep is None else self._range(deep)
        )

    def _range(self, per: float) -> WearRange:
        return WearRange(self.wear.minimum * per, self.wear.maximum * per)
