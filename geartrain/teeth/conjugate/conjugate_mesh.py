"""Conjugate teeth of a gear pair of a train, spur, ring or bevel.

Which wheel is gear 1 of the form, why the pair does not turn, its figures (arcs and contact ratio of the design, error,
backlash, efficiency), and its design: sizes, path of contact, costs, outlines of the wheels.
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
from geartrain.teeth.conjugate.admissibility import tip_thickness
from geartrain.teeth.conjugate.path_losses import SHARED, PathMeasures, measure, sliding
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import NamedForm, PairSize
from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, SlidingEfficiency, motion_figures

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact, OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.outlines.tooth_requirement import ToothRequirement
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.outlines.wheel_requirement import LanternPins
    from geartrain.teeth.pair_results import PairVerdict

_WORDS = (
    "Conjugate teeth keep the ratio of tooth counts at every instant where their axes are as far apart as they are "
    "made for, involutes at any distance; others have an error there. Arcs of the driver's approach and recess, "
    "and contact ratio, in pitches, as designed; error and play in degrees of the driven wheel; mean efficiency "
    "at constant driver torque, exact in friction, as the pair is driven and driven back, teeth in contact sharing "
    "the load equally."
)
_HEADER = (
    *("pair", "drives", "teeth", "arcs", "contact ratio"),
    *("error p-p (deg)", "play (deg)", "efficiency", "driven back", "verdict"),
)


class ConjugateDetails(NamedForm, Protocol):
    """What such a mesh asks of its form besides the name: see the methods of the form."""

    more_contact: ClassVar[str]
    """What raises the contact ratio."""

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float | None:
        """What is free under the mate's tip (modules)."""

    def backlash_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Play of axes that stand too far apart (modules)."""

    def lantern_pins(self, wheels: WheelPair) -> LanternPins | None:
        """Round pins in place of teeth."""


@dataclass(frozen=True)
class ConjugateMesh(GearMesh):
    """A gear pair with conjugate teeth; a ring is gear 2 of its law in whichever order the pair is named.

    At another distance than they are made for, all but involutes have a law that is not rigid.
    """

    tooth_form: ConjugateDetails
    transmission: ConjugateTransmission | OffDesignTransmission

    @cached_property
    def reversed(self) -> ConjugateTransmission | OffDesignTransmission:
        """The law with the other wheel driving."""
        return self.transmission.reversed

    @property
    def verdict(self) -> PairVerdict:
        """Whether these teeth can turn."""
        return self.transmission.verdict

    @property
    def stands(self) -> float:
        """Half a tooth of both wheels: the driven angle is counted from where flanks touch."""
        pair = self.transmission.pair
        return float(sum(pair.halves) / pair.path.pitch.p)

    @property
    def gears(self) -> tuple[str, str]:
        """The wheels that are gear 1 and gear 2 of the law."""
        first, second = self.gear.pair
        return (second, first) if self.wheels.internal[0] else (first, second)

    @property
    def path(self) -> PathOfContact:
        """The path of contact at the design distance."""
        return self.transmission.path

    @property
    def separation(self) -> float:
        """Tangent of the pressure angle at the pitch point."""
        return abs(tan(float(self.path.at(np.zeros(1)).psi[0])))

    @property
    def wheel_pair(self) -> WheelPair:
        """The two wheels as the form knows them, axes taken as parallel."""
        pitch, helix = self.transmission.path.pitch, abs(self.wheels.helix[0])
        return WheelPair(pitch.z1, pitch.z2, any(self.wheels.internal), module=self.wheels.module, helix=helix)

    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """Lengths of the law are modules already."""
        del tips
        if self.transmission.path.pitch.bevel:
            return None
        return PairSize(1.0, self.transmission.distance, self.transmission.distance / self.wheels.touching)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> ToothRequirement:
        """The flank of the design, with a root that lets the mate pass."""
        from geartrain.teeth.outlines.tooth_requirement import CLEARANCE, ToothRequirement

        del scale
        gear, wheels = self.gears.index(wheel) + 1, self.wheel_pair
        free, pins = self.tooth_form.bottom_clearance(wheels, gear), self.tooth_form.lantern_pins(wheels)
        return ToothRequirement(
            self.transmission.pair, gear, tolerance, CLEARANCE if free is None else max(free, 0.0), pins
        )

    def wheel_outline(self, gear: int, cut: BlankSizes) -> WheelOutline:
        """The flank of the design over a root of the blank's sizes; by default as deep as the form says."""
        from geartrain.teeth.outlines.wheel_outline import outline

        wheels, own = self.wheel_pair, self.gears.index(self.gear.pair[gear - 1]) + 1
        free = self.tooth_form.bottom_clearance(wheels, own)
        if cut.clearance is None and free is not None:
            if free < 0:
                raise QuestionError(_shallow(own, -free))
            cut = replace(cut, clearance=free * cut.module)
        return outline(self.transmission.pair, own, cut, self.tooth_form.lantern_pins(wheels))

    def backlash_apart(self, gap: float) -> float | None:
        """As the form has it: involutes run at any distance."""
        return self.tooth_form.backlash_apart(self.wheel_pair, gap)

    @property
    def label(self) -> str:
        """The pair, with which wheel is which gear."""
        first, second = self.gears
        return f"pair '{self.name}' (gear 1 is '{first}', gear 2 '{second}')"

    @property
    def displaced_contact(self) -> DisplacedContact:
        """Of the design; axles that stand elsewhere displace all flanks alike."""
        from geartrain.teeth.conjugate.displaced_contact import displaced_contact

        pitch, transmission = self.transmission.path.pitch, self.transmission
        gap = 0.0 if pitch.bevel else transmission.distance - abs(pitch.R1 + pitch.R2)
        return displaced_contact(transmission.pair, transmission.driver, gap)

    def account(self) -> PairAccount:
        """Arcs and contact ratio of its design, error, play and efficiency."""
        figures = _figures(self)
        return PairAccount(_WORDS, (AccountTable(_HEADER, _row(self, figures), wide=True),), figures)


def _shallow(gear: int, overlap: float) -> Problem:
    """What is said of a root that the mate's tip would run into; `overlap` in modules."""
    return Problem(
        f"the root of gear {gear} stands in the way of its mate's tip",
        f"they overlap by {overlap:.4g} modules at this centre distance",
        "give a greater --dedendum or a smaller --addendum",
        "--dedendum",
    )


# -------------------------------------------------------------------------------------------------------------- figures


@dataclass(frozen=True)
class ConjugateFigures(PairFigures):
    """Figures of a pair with conjugate teeth, with those of its path of contact as designed."""

    KEYS = (
        *PairFigures.KEYS,
        "arcs",
        "contact_ratio",
        "pressure_angle",
        "shaft_angle",
        "helix_angle",
        "overlap_ratio",
    )

    arcs: tuple[float, float]
    """Of the driver's approach and recess (pitches)."""
    contact_ratio: float
    """Length of the path of contact, in pitches."""
    pressure_angle: float
    """At the pitch point (rad)."""
    shaft_angle: float | None
    """Between the axes (rad); None where they are parallel."""
    helix_angle: float | None = None
    """Of helical wheels (rad); None of straight teeth."""
    overlap_ratio: float | None = None
    """Pitches by which helical teeth lead along their width; None where that is not known."""


def _figures(mesh: ConjugateMesh) -> ConjugateFigures:
    """Of a pair as it is driven; involutes keep their motion where they cannot run."""
    transmission, path = mesh.transmission, mesh.transmission.path
    pitch, runs = path.pitch, bool(mesh.verdict)
    approach, recess = _driver_arcs(transmission)
    return ConjugateFigures(
        mesh.counts,
        mesh.verdict,
        *motion_figures(transmission, mesh.rigid or runs),
        mesh.efficiency(mesh.driver) if runs else None,
        arcs=(approach / pitch.p, recess / pitch.p),
        contact_ratio=path.contact_ratio,
        pressure_angle=float(path.at(0.0).psi),
        shaft_angle=pitch.R1 + pitch.R2 if pitch.bevel else None,
        helix_angle=abs(mesh.wheels.helix[0]) or None,
        overlap_ratio=_overlap_ratio(mesh.wheels),
    )


def _overlap_ratio(wheels: MeshingWheels) -> float | None:
    """Width times tan helix over the transverse pitch."""
    if not wheels.helix[0] or wheels.width is None or wheels.module is None:
        return None
    return wheels.width * tan(abs(wheels.helix[0])) / (pi * wheels.module)


def _row(mesh: ConjugateMesh, figures: ConjugateFigures) -> tuple[str, ...]:
    return (
        mesh.name,
        f"{mesh.driver} -> {mesh.driven}",
        mesh.tooth_form.words,
        " + ".join(f"{round(arc, 9):.4g}" for arc in figures.arcs),
        f"{figures.contact_ratio:.5g}",
        figures.error_text,
        f"{degrees(mesh.verdict.backlash):.4g}",
        *mesh.efficiency_texts,
        mesh.verdict.kind,
    )


def _driver_arcs(transmission: ConjugateTransmission | OffDesignTransmission) -> tuple[float, float]:
    """The driver's approach and recess (X)."""
    approach, recess = transmission.path.arcs
    return (approach, recess) if transmission.driver == 1 else (recess, approach)


# ----------------------------------------------------------------------------------------------------- design of a pair


@dataclass(frozen=True)
class DesignLosses(Result):
    """What a path of contact costs."""

    KEYS = (Key("", "measures"), "sliding", Key("specific_sliding", to=finite))

    measures: PathMeasures
    """Loss, stress, heat, flash, depth."""
    sliding: float
    """Greatest sliding over the pitch-line speed."""
    specific_sliding: float
    """Greatest sliding over the slower of the contact's speeds along the flanks; infinite where it stands still."""


@dataclass(frozen=True)
class SharedEfficiency(Result):
    """Efficiency of sliding where pairs of teeth in contact share the load."""

    KEYS = ("assumption", Key("", "sliding"))

    sliding: SlidingEfficiency
    """Exact in friction."""
    assumption: str = SHARED
    """The same in words."""


@dataclass(frozen=True)
class PairDesign(Result):
    """A pair with conjugate teeth as designed; gear 1 first, lengths in modules (bevel: rad), angles in rad."""

    KEYS = (
        *(Key("form", "mesh.form"), "teeth", Key("verdict", "mesh.verdict"), "pitch_radii", "flanks", "thickness"),
        *(
            "arcs",
            Key("contact_ratio", "path.contact_ratio"),
            "pressure_angles",
            "losses_and_stresses",
            "efficiency",
            "outlines",
        ),
    )

    mesh: ConjugateMesh
    """The pair, as it is driven."""
    outlines: tuple[WheelOutline, ...] = ()
    """Wheels that were cut."""

    @property
    def path(self) -> PathOfContact:
        """The path of contact."""
        return self.mesh.path

    @property
    def runs(self) -> bool:
        """True if the teeth can run, be it that friction locks them."""
        return bool(self.mesh.verdict)

    @property
    def teeth(self) -> tuple[int, int]:
        """Teeth of gear 1 and of gear 2."""
        return int(self.path.pitch.z1), int(self.path.pitch.z2)

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Of both gears; negative for a ring."""
        return self.path.pitch.R1, self.path.pitch.R2

    @cached_property
    def flanks(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii between which the flanks of each gear work, root end first."""
        return self.path.radii(1), self.path.radii(2)

    @property
    def thickness(self) -> tuple[float, float]:
        """Of a tooth, or pin, on the pitch circle (pitches)."""
        first, second = self.mesh.transmission.pair.halves
        return 2 * first / self.path.pitch.p, 2 * second / self.path.pitch.p

    @cached_property
    def top_lands(self) -> tuple[float | None, float | None]:
        """Angle of the land at the tip of a tooth (rad); None for round pins."""
        pair = self.mesh.transmission.pair
        first, second = (
            tip_thickness(self.path, gear, pair.halves) if solid else None for gear, solid in enumerate(pair.solid, 1)
        )
        return first, second

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess, gear 1 driving (pitches); one may be negative."""
        approach, recess = self.path.arcs
        return approach / self.path.pitch.p, recess / self.path.pitch.p

    @property
    def pressure_angles(self) -> tuple[float, float, float]:
        """At the first contact, the pitch point and the last contact."""
        approach, recess = self.path.arcs
        first, middle, last = (float(self.path.at(X).psi) for X in (-approach, 0.0, recess))
        return first, middle, last

    @cached_property
    def losses_and_stresses(self) -> DesignLosses | None:
        """What the path costs; None for teeth that cannot run."""
        return DesignLosses(measure(self.path), *sliding(self.path)) if self.runs else None

    @property
    def efficiency(self) -> SharedEfficiency | None:
        """Exact in friction; None for teeth that cannot run."""
        return SharedEfficiency(self.mesh.efficiency(self.mesh.driver)) if self.runs else None

    @property
    def locks(self) -> bool:
        """True if friction locks the teeth."""
        return self.mesh.losses.locks
