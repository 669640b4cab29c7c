"""Mesh of a gear pair with conjugate teeth in a train: spur, internal or bevel.

The mesh numbers the wheels as gear 1 and gear 2 of the form. It computes the faults of the pair, its results (arcs,
contact ratio, transmission error, backlash, efficiency) and its design (sizes, path of contact, losses, outlines).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, pi, tan
from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result, finite
from geartrain.teeth.conjugate.admissibility import tooth_thickness
from geartrain.teeth.conjugate.path_losses import SHARED, PathMeasures, measure, sliding
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import NamedForm, PairSize
from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, SlidingEfficiency, motion_figures

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.conjugate.off_design_transmission import OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.outlines.tooth_requirement import ToothRequirement
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.outlines.wheel_requirement import LanternPins

_WORDS = (
    "Conjugate teeth have a constant speed ratio at their design centre distance, involutes at any distance; other "
    "forms have a transmission error elsewhere. Arcs of the driver's approach and recess, and contact ratio, in "
    "pitches, as designed; transmission error and backlash in degrees of the driven wheel; mean efficiency at constant "
    "driver torque, exact in friction, as the pair is driven and driven back, teeth in contact sharing the load "
    "equally."
)
_HEADER = (
    *("pair", "drives", "teeth", "arcs", "contact ratio"),
    *("error p-p (deg)", "backlash (deg)", "efficiency", "driven back", "verdict"),
)


class ConjugateDetails(NamedForm, Protocol):
    """Methods of a conjugate tooth form that the mesh of a pair uses."""

    more_contact: ClassVar[str]
    """Text that advises how to increase the contact ratio."""

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float | None:
        """Return the bottom clearance between the root of `gear` and its mate's tip [module]; None if undefined."""

    def backlash_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Return the backlash [module] if the design centre distance is increased by `gap`; None if undefined."""

    def lantern_pins(self, wheels: WheelPair) -> LanternPins | None:
        """Return the round pins that form the teeth of one wheel; None if both wheels have teeth."""


@dataclass(frozen=True)
class ConjugateMesh(GearMesh):
    """Gear pair with conjugate teeth. A ring gear is always numbered gear 2, even if the pair names it first.

    At a centre distance other than the design distance, the speed ratio varies for all forms except involutes.
    """

    tooth_form: ConjugateDetails
    transmission: ConjugateTransmission | OffDesignTransmission

    @property
    def tooth_phase(self) -> float:
        """Distance [pitch] by which a tooth of the driven wheel is past the line of centres when the driven angle is 0.

        In this position a tooth of the driver is on the line of centres, and flanks touch. The distance is the sum of
        half the tooth thicknesses of both wheels.
        """
        pair = self.transmission.pair
        return float(sum(pair.halves) / pair.path.pitch.p)

    @property
    def gears(self) -> tuple[str, str]:
        """Names of gears 1 and 2: the wheels of the pair in order, unless the first wheel is a ring gear."""
        first, second = self.gear.pair
        return (second, first) if self.wheels.internal[0] else (first, second)

    @property
    def path(self) -> PathOfContact:
        """Path of contact at the design distance."""
        return self.transmission.path

    @property
    def separation(self) -> float:
        """Tangent of the pressure angle at the pitch point, which is the radial tooth force over the tangential one."""
        return abs(tan(float(self.path.at(np.zeros(1)).psi[0])))

    @property
    def wheel_pair(self) -> WheelPair:
        """Tooth numbers, ring gear, module and helix angle of the pair, with the axes treated as parallel."""
        pitch, helix = self.transmission.path.pitch, abs(self.wheels.helix[0])
        return WheelPair(pitch.z1, pitch.z2, any(self.wheels.internal), module=self.wheels.module, helix=helix)

    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """Return the size of the pair in modules; None for a bevel pair. The tip radii `tips` are not needed."""
        del tips
        if self.transmission.path.pitch.bevel:
            return None
        return PairSize(1.0, self.transmission.distance, self.transmission.distance / self.wheels.touching)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> ToothRequirement:
        """Return the required tooth of `wheel`: its designed flank, and a root that clears the tip of the mate. The
        polyline of the flank is within `tolerance` [module]; `scale` is not used.
        """
        from geartrain.teeth.outlines.tooth_requirement import CLEARANCE, ToothRequirement

        del scale
        gear, wheels = self.gears.index(wheel) + 1, self.wheel_pair
        free, pins = self.tooth_form.bottom_clearance(wheels, gear), self.tooth_form.lantern_pins(wheels)
        return ToothRequirement(
            # a negative clearance is a fault of the pair; the root is then drawn without clearance
            self.transmission.pair,
            gear,
            tolerance,
            CLEARANCE if free is None else max(free, 0.0),
            pins,
        )

    def wheel_outline(self, gear: int, cut: BlankSizes) -> WheelOutline:
        """Return the outline of a wheel, with the designed flanks and a root cut as the sizes `cut` require. If `cut`
        has no bottom clearance, the bottom clearance of the tooth form is used.
        """
        from geartrain.teeth.outlines.wheel_outline import outline

        wheels, own = self.wheel_pair, self.gears.index(self.gear.pair[gear - 1]) + 1
        free = self.tooth_form.bottom_clearance(wheels, own)
        if cut.clearance is None and free is not None:
            if free < 0:
                what = f"the root of gear {own} interferes with its mate's tip"
                fix = "give a larger dedendum or a smaller addendum"
                why = f"they overlap by {-free:.4g} modules at this centre distance"
                raise QuestionError(Problem(what, why, fix, "dedendum"))
            cut = replace(cut, clearance=free * cut.module)
        return outline(self.transmission.pair, own, cut, self.tooth_form.lantern_pins(wheels))

    def backlash_apart(self, gap: float) -> float | None:
        """Return the backlash [module] if the centre distance is increased by `gap` [module]; None if undefined."""
        return self.tooth_form.backlash_apart(self.wheel_pair, gap)

    @property
    def label(self) -> str:
        """Name of the pair in messages, which contains the names of gear 1 and gear 2."""
        first, second = self.gears
        return f"pair '{self.name}' (gear 1 is '{first}', gear 2 '{second}')"

    @property
    def displaced_contact(self) -> DisplacedContact:
        """Contact of slightly displaced flanks, for example at a centre distance other than the designed one."""
        from geartrain.teeth.conjugate.displaced_contact import displaced_contact

        pitch, transmission = self.transmission.path.pitch, self.transmission
        gap = 0.0 if pitch.bevel else transmission.distance - abs(pitch.R1 + pitch.R2)
        return displaced_contact(transmission.pair, transmission.driver, gap)

    def account(self) -> PairAccount:
        """Return the report on the pair: arcs, contact ratio, transmission error, backlash and efficiency."""
        transmission, path, wheels = self.transmission, self.transmission.path, self.wheels
        runs, helix, overlap = bool(self.verdict), abs(wheels.helix[0]), None
        if helix and wheels.width is not None and wheels.module is not None:
            # b tan(helix angle) / p, where b is the face width and p the transverse pitch
            overlap = wheels.width * tan(helix) / (pi * wheels.module)
        figures = ConjugateFigures(
            self.counts,
            self.verdict,
            # the motion of involutes is known even if the pair cannot run
            *motion_figures(transmission, self.rigid or runs),
            self.efficiency(self.driver) if runs else None,
            arcs=path.pitches if transmission.driver == 1 else path.pitches[::-1],
            contact_ratio=path.contact_ratio,
            pressure_angle=float(path.at(0.0).psi),
            shaft_angle=path.pitch.R1 + path.pitch.R2 if path.pitch.bevel else None,
            helix_angle=helix or None,
            overlap_ratio=overlap,
        )
        row = (
            self.name,
            f"{self.driver} -> {self.driven}",
            self.tooth_form.words,
            " + ".join(f"{round(arc, 9):.4g}" for arc in figures.arcs),
            f"{figures.contact_ratio:.5g}",
            figures.error_text,
            f"{degrees(self.verdict.backlash):.4g}",
            *self.efficiency_texts,
            self.verdict.kind,
        )
        return PairAccount(_WORDS, (AccountTable(_HEADER, row, wide=True),), figures)


# ----------------------------------------------------------------------------------------------------------- properties


@dataclass(frozen=True)
class ConjugateFigures(PairFigures):
    """Results of a pair with conjugate teeth: those in `PairFigures`, arcs of contact, angles and overlap ratio."""

    KEYS = (
        *PairFigures.KEYS,
        *("arcs", "contact_ratio", "pressure_angle", "shaft_angle", "helix_angle", "overlap_ratio"),
    )

    arcs: tuple[float, float]
    """Arcs of approach and recess for the actual driver [pitch]."""
    contact_ratio: float
    """Contact ratio: arc of contact divided by pitch."""
    pressure_angle: float
    """Pressure angle at the pitch point [rad]."""
    shaft_angle: float | None
    """Shaft angle [rad]; None for parallel axes."""
    helix_angle: float | None = None
    """Helix angle of helical wheels [rad]; None for straight teeth."""
    overlap_ratio: float | None = None
    """Overlap ratio of helical teeth; None for straight teeth, or if no face width is declared."""


# ----------------------------------------------------------------------------------------------------- design of a pair


@dataclass(frozen=True)
class DesignLosses(Result):
    """Losses, stress, heat and sliding of a pair at its design distance, computed from its path of contact."""

    KEYS = (Key("", "measures"), "sliding", Key("specific_sliding", to=finite))

    measures: PathMeasures
    """Loss, contact stress, heat, flash temperature and working depth, normalised by friction and load."""
    sliding: float
    """Maximum sliding speed divided by the pitch-line speed."""
    specific_sliding: float
    """Maximum of the sliding speed divided by the lower of the two contact speeds along the flanks; infinite if the
    lower speed is 0 at a contact.
    """


@dataclass(frozen=True)
class SharedEfficiency(Result):
    """Efficiency of a gear pair whose tooth pairs in contact share the load, and the assumed load sharing."""

    KEYS = ("assumption", Key("", "sliding"))

    sliding: SlidingEfficiency
    """Efficiency with sliding friction of the teeth, as an exact function of the friction coefficient."""
    assumption: str = SHARED
    """Text that states the assumption on how tooth pairs in contact share the load."""


@dataclass(frozen=True)
class PairDesign(Result):
    """Design of a pair with conjugate teeth. Values are given first for gear 1 and then for gear 2, lengths in modules
    (in rad for bevel gears) and angles in rad.
    """

    KEYS = (
        *(Key("form", "mesh.form"), "teeth", Key("verdict", "mesh.verdict"), "pitch_radii", "flanks", "thickness"),
        *("arcs", Key("contact_ratio", "path.contact_ratio"), "pressure_angles", "losses_and_stresses"),
        *("efficiency", "outlines"),
    )

    mesh: ConjugateMesh
    """Mesh of the pair. The mesh specifies the driving wheel."""
    outlines: tuple[WheelOutline, ...] = ()
    """Outlines of the requested wheels as they are cut; empty if no outline was requested."""

    @property
    def path(self) -> PathOfContact:
        """Path of contact of the pair at its design distance."""
        return self.mesh.path

    @property
    def runs(self) -> bool:
        """True if the teeth can run without friction. Friction may still lock them."""
        return bool(self.mesh.verdict)

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers of gear 1 and gear 2."""
        return int(self.path.pitch.z1), int(self.path.pitch.z2)

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Pitch radii of gear 1 and gear 2 [module; rad for bevel gears]. The radius of a ring gear is negative."""
        return self.path.pitch.R1, self.path.pitch.R2

    @cached_property
    def flanks(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii at which the active flanks of gears 1 and 2 begin and end [module; rad for bevel gears]."""
        return self.path.radii(1), self.path.radii(2)

    @property
    def thickness(self) -> tuple[float, float]:
        """Thickness of a tooth or pin on the pitch circle, for gear 1 and gear 2 [pitch]."""
        first, second = self.mesh.transmission.pair.halves
        return 2 * first / self.path.pitch.p, 2 * second / self.path.pitch.p

    @cached_property
    def top_lands(self) -> tuple[float | None, float | None]:
        """Angular thickness of the top land of a tooth, for gear 1 and gear 2 [rad]; None for round pins."""
        pair = self.mesh.transmission.pair
        first, second = (
            tooth_thickness(self.path, gear, pair.halves, self.path.ends(gear)[1]) if solid else None
            for gear, solid in enumerate(pair.solid, 1)
        )
        return first, second

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess if gear 1 drives [pitch]. One arc may be negative."""
        return self.path.pitches

    @property
    def pressure_angles(self) -> tuple[float, float, float]:
        """Pressure angles at the first contact, the pitch point and the last contact [rad]."""
        approach, recess = self.path.arcs
        first, middle, last = (float(self.path.at(X).psi) for X in (-approach, 0.0, recess))
        return first, middle, last

    @cached_property
    def losses_and_stresses(self) -> DesignLosses | None:
        """Losses and stresses of the pair; None if the teeth cannot run."""
        return DesignLosses(measure(self.path), *sliding(self.path)) if self.runs else None

    @property
    def efficiency(self) -> SharedEfficiency | None:
        """Efficiency of the pair as an exact function of the friction coefficient; None if the teeth cannot run."""
        return SharedEfficiency(self.mesh.efficiency(self.mesh.driver)) if self.runs else None

    @property
    def locks(self) -> bool:
        """True if friction locks the teeth."""
        return self.mesh.losses.locks
