"""Outline of a whole wheel: sizes of its blank, contours, and the sizes that result.

Conjugate teeth get roots that the mate's tips do not touch, and a bore or a rim as the blank specifies.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan2, cos, isfinite, pi, sin, tan
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.teeth.outlines.contour import Contour
from geartrain.teeth.outlines.tooth_outline import repeated
from geartrain.teeth.outlines.tooth_requirement import CLEARANCE, ToothRequirement, check_flat, cut_tooth
from geartrain.teeth.outlines.wheel_requirement import LanternPins

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

_THIN = 0.1  # modules: minimum wall between bore and root circle


@dataclass(frozen=True, slots=True)
class BlankSizes:
    """Manufacturing data of a wheel that its tooth form does not define. Lengths are in mm.

    Raises
    ------
    QuestionError
        If a value is not a valid size.

    See Also
    --------
    geartrain.teeth.GearMesh.wheel_outline : Method that cuts a wheel with these sizes.

    Examples
    --------
    >>> BlankSizes(module=2, bore=6).clearance is None
    True
    """

    module: float = 1.0
    """Module: pitch diameter divided by tooth number [mm], above 0."""
    clearance: float | None = None
    """Bottom clearance between a root and the mate's tip [mm], 0 or more; by default a quarter of a module."""
    fillet: float | None = None
    """Radius of the root fillet [mm], 0 or more; by default 0.38 modules, or the largest radius that fits."""
    bore: float | None = None
    """Diameter of the central hole [mm]; by default the wheel has no hole."""
    rim: float | None = None
    """Width of the rim around the roots of a ring gear, by default two modules, or around the pins of a lantern, by
    default a pin diameter [mm].
    """
    tolerance: float = 0.001
    """Maximum deviation of a chord from a flank [mm]."""

    def __post_init__(self) -> None:
        """Raise `QuestionError` if the value of a field is not a valid size."""
        problems = []
        for name in ("module", "bore", "rim", "tolerance", "fillet", "clearance"):
            value, may_be_0 = getattr(self, name), name in ("fillet", "clearance")
            if value is not None and not (isfinite(value) and (value > 0 or (may_be_0 and value == 0))):
                rule = f"the {name} must be finite and {'0 or more' if may_be_0 else 'above 0'}"
                fix = f"give a {name} such as 1"
                problems.append(Problem(f"a {name} of {value:g} mm is out of range", rule, fix, f"--blank {name}"))
        if problems:
            raise QuestionError(problems)


def _diameter(radius: float) -> float:
    return 2 * radius


@dataclass(frozen=True, slots=True)
class WheelOutline(Result):
    """Outline and sizes of a wheel at full scale (1:1). Lengths are in mm.

    See Also
    --------
    geartrain.teeth.GearMesh.wheel_outline : Method that returns the outline of a wheel.
    """

    KEYS = (
        *("gear", "z", "kind", "module", "thickness", "fillet", "relief", "clearance", "backlash"),
        *(Key(f"{name}_diameter", f"{name}_radius", _diameter) for name in ("pitch", "tip", "root")),
        *("centre_distance", "tolerance"),
    )

    gear: int
    """Number of the gear in the pair, 1 or 2."""
    z: int
    """Number of teeth or pins."""
    kind: str
    """Kind of wheel: external, ring or pins."""
    contours: tuple[Contour, ...]
    """Contours [mm]: the outer contour, then the holes. The axle is at (0, 0), and a tooth or a pin is on the x axis.
    """
    module: float
    """Module of the wheel [mm]."""
    pitch_radius: float
    """Pitch radius of the wheel [mm]."""
    tip_radius: float
    """Tip radius of the wheel [mm]."""
    root_radius: float
    """Root radius of the wheel [mm]."""
    thickness: float
    """Thickness of a tooth along the pitch circle [mm]."""
    fillet: float
    """Radius of the root fillet [mm]; 0 if the root has no fillet."""
    relief: float
    """Angle by which the root flank deviates from the tangent of the flank, for clearance to the mate's tip [rad]."""
    clearance: float
    """Bottom clearance of the pair [mm]."""
    backlash: float
    """Backlash of the pair on the pitch circle [mm]."""
    centre_distance: float
    """Centre distance of the pair [mm]."""
    tolerance: float
    """Maximum deviation of a chord from a flank [mm]."""


# ------------------------------------------------------------------------------------------ wheels with conjugate teeth


def outline(pair: ConjugatePair, gear: int, cut: BlankSizes, pins: LanternPins | None = None) -> WheelOutline:
    """Return the outline of one wheel of a pair with conjugate teeth.

    If gear 2 is rotated so that a space faces a tooth of gear 1, the two wheels mesh at `centre_distance` with half the
    backlash on either side.

    Parameters
    ----------
    pair : ConjugatePair
        Spur pair at its design distance.
    gear : {1, 2}
        Number of the gear.
    cut : BlankSizes
        Module, bore, tolerance, and sizes of the roots.
    pins : LanternPins, optional
        Pins if one of the gears is a lantern.

    Returns
    -------
    WheelOutline
        Outline at full scale (1:1).

    Raises
    ------
    QuestionError
        If no such wheel can be cut.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> from geartrain.teeth.conjugate import WheelPair
    >>> from geartrain.teeth import BlankSizes
    >>> wheel = outline(Involute(form="involute").pair(WheelPair(24, 36)), 1, BlankSizes(module=2.0))
    >>> wheel.tip_radius, wheel.centre_distance
    (26.0, 60.0)
    """
    check_flat(pair)
    scale = cut.module
    clearance = CLEARANCE if cut.clearance is None else cut.clearance / scale
    demand = ToothRequirement(pair, gear, cut.tolerance / scale, clearance, pins)
    if pins is not None and demand.has_pins:
        kind, root, fillet, relief = "pins", pins.circle - pins.radius, 0.0, 0.0
        rim = 2 * pins.radius * scale if cut.rim is None else cut.rim
        contours = [*lantern(pins, int(demand.z), scale, rim), *bore(cut, root * scale)]
    else:
        wanted = None if cut.fillet is None else cut.fillet / scale
        tooth, relief = cut_tooth([demand], wanted)
        kind, root, fillet = "ring" if tooth.flank.outward < 0 else "external", tooth.root, tooth.fillet.radius
        if cut.fillet is not None and wanted is not None and fillet < wanted:
            what = f"a fillet of {cut.fillet:g} mm does not fit the root of gear {gear}"
            why = "a larger fillet would touch the mate's tips or the next tooth"
            fix = f"give at most {fillet * scale:.4g} mm, or more clearance"
            raise QuestionError(Problem(what, why, fix, "--blank fillet"))
        contours = blank_contours(tooth.whole(), kind, root, cut)
    return WheelOutline(
        gear=gear,
        z=int(demand.z),
        kind=kind,
        contours=tuple(contours),
        module=scale,
        pitch_radius=demand.flank.R * scale,
        tip_radius=demand.tip * scale,
        root_radius=root * scale,
        thickness=2 * pair.halves[gear - 1] * scale,
        fillet=fillet * scale,
        relief=relief,
        clearance=clearance * scale,
        backlash=pair.backlash * scale,
        centre_distance=demand.distance * scale,
        tolerance=cut.tolerance,
    )


def lantern(pins: LanternPins, z: int, module: float, rim: float | None = None) -> list[Contour]:
    """Return the contours of a lantern disc [mm]: a hole for each of the z pins, and a circle at the distance `rim`
    outside the pin holes.

    The default width of the rim is the diameter of a pin. `module` is in mm.
    """
    R, radius = pins.circle * module, pins.radius * module
    turns = [2 * pi * k / z for k in range(z)]
    holes = (Contour.circle(radius, (R * cos(t), R * sin(t))) for t in turns)
    return [Contour.circle(R + radius + (2 * radius if rim is None else rim)), *holes]


def pin_seats(pins: LanternPins, z: int, root: float, module: float, wider: float = 0.0) -> Contour:
    """Return the inner contour [mm] of a ring with a round seat for each of its z pins.

    root    inner radius of the ring [module]
    wider   diameter of a seat minus the diameter of its pin [mm]
    """
    R, radius, inside = pins.circle * module, pins.radius * module + wider / 2, root * module
    if not abs(R - radius) < inside < R + radius:
        return Contour.circle(inside)
    half = acos((R**2 + inside**2 - radius**2) / (2 * R * inside))
    x, y = inside * cos(half), inside * sin(half)
    # bulges are tangents of a quarter of each arc: of the seat, and of the ring up to the next seat
    seat = (x, -y, tan(atan2(y, x - R) / 2)), (x, y, tan((2 * pi / z - 2 * half) / 4))
    return Contour.of(repeated(seat, z))


def blank_contours(teeth: Contour, kind: str, root: float, cut: BlankSizes) -> list[Contour]:
    """Return the contours of a toothed wheel [mm]: teeth and bore, or, for a ring gear, rim and teeth.

    teeth, root   contour of the teeth and radius of the root circle [module]
    kind          kind of the wheel, "ring" for a ring gear; `cut` contains module, bore and rim
    """
    teeth = teeth.scaled(cut.module)
    if kind != "ring":
        if cut.rim is not None:
            what = "--blank rim does not apply to an external wheel with teeth"
            why = "only rings and lanterns have a rim of declared width"
            raise QuestionError(Problem(what, why, "omit --blank rim", "--blank rim"))
        return [teeth, *bore(cut, root * cut.module)]
    if cut.bore is not None:
        raise QuestionError(Problem("a ring has no bore", "its middle is open", "omit --blank bore", "--blank bore"))
    return [Contour.circle(root * cut.module + (2 * cut.module if cut.rim is None else cut.rim)), teeth]


def bore(cut: BlankSizes, root: float) -> list[Contour]:
    """Return a list with the contour of the bore in `cut`, empty without a bore. `root` is the root radius [mm]."""
    if cut.bore is None:
        return []
    most = 2 * (root - _THIN * cut.module)
    if cut.bore >= most:
        what = f"a bore of {cut.bore:g} mm does not fit"
        why = f"the wheel's root circle has a diameter of {2 * root:.4g} mm"
        raise QuestionError(Problem(what, why, f"give a bore below {most:.4g} mm", "--blank bore"))
    return [Contour.circle(cut.bore / 2)]
