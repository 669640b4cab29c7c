"""Requirements of conjugate pairs on the teeth of a wheel: the flanks, and tooth spaces that clear all mates.

The mate's tooth is compared with the outline at many positions within a pitch.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import acos, cos, inf, pi, radians
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.teeth.outlines.tooth_outline import FlankCurve, ToothOutline, fillet, flank, pin_span
from geartrain.teeth.outlines.wheel_requirement import CutTooth, LanternPins, WheelRequirement

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair


_STEPS = 120  # positions of the mate in a pitch
_MARGIN = 1e-3  # modules: minimum gap at the fillet, more than a tip moves between two positions


MatePassage = tuple["Floats", "Floats"]
"""Positions of a mate's tooth within the tip circle of a wheel, in the frame of this wheel.

The two arrays are radii about the wheel's axle [module], and angles from the centre line of the nearest tooth [rad].
"""


def interference_depth(tooth: ToothOutline, mate: MatePassage) -> float:
    """Return the maximum depth to which the mate's tooth would cut into a tooth [module]; negative if there is a gap.

    `mate` contains positions of points of the mate's tooth in the tooth space. The depth is measured along the
    circumference at the flank and the fillet, and along the radius at the root circle. It is increased by `_MARGIN` at
    the fillet. The value is -inf if the mate does not enter the tip circle.
    """
    radius, aside = mate
    if not radius.size:
        return -inf
    s = tooth.flank.outward
    deep = (tooth.half_at(radius) - aside) * radius
    below = (tooth.root - radius) * s
    on_fillet = (radius - abs(tooth.fillet.start)) * s < 0
    return float(np.where(below > 0, below, deep + np.where(on_fillet, _MARGIN, 0.0)).max())


CLEARANCE = 0.25  # modules: bottom clearance of the basic rack of ISO 53 A
_FILLET = 0.38  # modules: root fillet of the basic rack of ISO 53 A
_TOLERATED_DEPTHS = (1e-9, 1e-6)  # modules: tolerated interference; flanks computed numerically need the second value
_RELIEFS = (0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 18.0)  # deg by which a root is steeper than the end of its flank
_MINIMUM_FILLET = 1e-3  # modules: a tooth that does not allow this fillet counts as impossible
_HALVINGS = 18  # bisections of less than 0.4 modules, to a resolution of 2e-6
_ALIKE = 1e-5  # modules: flanks that differ by less are equal


@dataclass(frozen=True)
class ToothRequirement(WheelRequirement):
    """Required flanks and root of gear 1 or 2 of a conjugate pair. Lengths are in modules."""

    pair: ConjugatePair
    """Conjugate pair at its design distance."""
    gear: int
    """Number of the gear whose teeth are required, 1 or 2."""
    tolerance: float
    """Maximum deviation of a chord from the flank [module]."""
    clearance: float = CLEARANCE
    """Bottom clearance between the tips of the mate and the root of this gear [module]."""
    pins: LanternPins | None = None
    """Pins of the lantern if one of the two gears is a lantern; None if neither is."""

    @property
    def internal(self) -> bool:
        """True if one of the two wheels is a ring gear."""
        return self.pair.path.pitch.R2 < 0

    @property
    def z(self) -> float:
        """Tooth number of the gear."""
        return self.pair.path.pitch.teeth_of(self.gear)

    @property
    def distance(self) -> float:
        """Centre distance of the pair [module]."""
        return abs(self.pair.path.pitch.R1 + self.pair.path.pitch.R2)

    @property
    def flank(self) -> FlankCurve:
        """Active flank of the gear."""
        return _flank(self.pair, self.gear, self.tolerance)

    @property
    def widening(self) -> float:
        """Half of the angular tooth thickness at the pitch circle [rad]."""
        return float(self.pair.halves[self.gear - 1] / self.flank.R)

    @cached_property
    def other(self) -> ToothRequirement:
        """Requirement of the same pair on its other gear."""
        return ToothRequirement(self.pair, 3 - self.gear, self.tolerance, self.clearance, self.pins)

    @property
    def has_pins(self) -> bool:
        """True if this gear is the lantern of the pair, which has round pins instead of teeth."""
        return self.pins is not None and self.pins.gear == self.gear

    @property
    def tip(self) -> float:
        """Radius of the tip circle [module]; for pins, the radius of their outermost points."""
        if self.pins is not None and self.has_pins:
            return self.pins.circle + self.pins.radius
        return self.pair.path.radii(self.gear)[1]

    def agrees(self, other: WheelRequirement) -> bool:
        """Return True if the teeth of one wheel can satisfy both requirements, or False if they cannot."""
        if not isinstance(other, ToothRequirement):
            return False
        return self.pins == other.pins if self.has_pins or other.has_pins else alike(self, other)

    def cut(self, others: Sequence[WheelRequirement] = ()) -> CutTooth:
        """Return the pins, or a tooth whose root clears all mating teeth that this requirement and the requirements in
        `others` describe.
        """
        demands = (self, *(each for each in others if isinstance(each, ToothRequirement)))
        for demand in demands:
            check_flat(demand.pair)
        if self.pins is not None and self.has_pins:
            return CutTooth("pins", self.tip, self.pins.circle - self.pins.radius, (), self.pins)
        return _cut(tuple(dict.fromkeys(demands)))

    @property
    def root(self) -> float:
        """Radius of the root circle [module]. Its depth below the pitch circle is the sum of the mate's addendum and
        the bottom clearance.

        The addendum is negative if the mate's tip does not reach its own pitch circle.
        """
        own, mate = self.flank, self.other.flank
        tip = float(mate.r[-1]) if self.pins is None else self.pins.circle + self.pins.radius
        return own.R - own.outward * (mate.outward * (tip - mate.R) + self.clearance)

    @cached_property
    def passage(self) -> MatePassage:
        """Positions of the mate's tooth or pin while it passes through a tooth space of this gear."""
        own, other = self.flank, self.other
        found = other.flank
        if self.pins is not None and other.gear == self.pins.gear:
            span = pin_span(self.pins.circle, self.pins.radius)
        else:
            half = other.widening + found.angle
            flanks = np.stack([np.tile(found.r, 2), np.concatenate((half, -half))])
            land = np.stack([np.full(9, found.r[-1]), np.linspace(-half[-1], half[-1], 9)])
            span = np.concatenate((flanks, land), axis=1)
        # both wheels are symmetric, so one side of the backlash is sufficient
        touching = span + np.array([[0.0], [self.pair.backlash / 2 / found.R]])
        distance = own.R - found.R if self.internal else own.R + found.R  # negative for a wheel in a ring gear
        # angles of the mate at which its tooth may be within the wheel's tip circle, by the law of cosines
        tip, outward = float(own.r[-1]), own.outward
        far = float(touching[0].min() if found.outward < 0 else touching[0].max())
        cosine = outward * (distance**2 + far**2 - tip**2) / (2 * abs(distance) * far) if distance else -1.0
        # margin for the width of the tooth itself
        reach = min(acos(min(max(cosine, -1.0), 1.0)) + 1.5 * pi / other.z, pi)
        turn = np.linspace(-reach, reach, 2 * int(reach * other.z * _STEPS / (2 * pi)) + 1)[:, None]
        r, angle = touching
        place = distance + r * np.exp(1j * (angle + turn + (0 if self.internal else pi)))
        radius = np.abs(place)
        inside = (radius - tip) * outward <= 0
        turned = turn * other.z / self.z * (1 if self.internal else -1)
        pitch = 2 * pi / self.z
        aside = np.abs((np.angle(place) - turned) % pitch - pitch / 2)  # a tooth space faces the mate's tooth
        return radius[inside], aside[inside]


@lru_cache(maxsize=4096)
def _flank(pair: ConjugatePair, gear: int, tolerance: float) -> FlankCurve:
    # pins are full circles, whichever part of them is active
    whole = pair.path.approach.arc, pair.path.recess.arc
    return flank(pair.path, gear, pair.arcs if pair.solid[gear - 1] else whole, tolerance)


@lru_cache(maxsize=4096)
def _cut(demands: tuple[ToothRequirement, ...]) -> CutTooth:
    made, _ = cut_tooth(demands)
    kind = "ring" if made.flank.outward < 0 else "external"
    return CutTooth(kind, made.tip, made.root, tuple(made.vertices()))


def check_flat(pair: ConjugatePair) -> None:
    """Raise `QuestionError` if the wheels of a pair have no plane outline, if they have faults, or if the path of
    contact does not reach the pitch point.
    """
    path = pair.path
    if path.pitch.bevel:
        # the back cone of a crown wheel develops into a rack with infinitely many teeth
        first, second = path.pitch.z1 / cos(path.pitch.R1), path.pitch.z2 / max(cos(path.pitch.R2), 1e-9)
        why = "its teeth are on a sphere and taper towards the apex, where the axes meet"
        spur = f"the equivalent spur pair of its back cones, of {first:.4g} and {second:.4g} teeth"
        fix = f"omit --profile, or draw {spur}"
        raise QuestionError(Problem("a bevel wheel has no plane outline", why, fix, "--profile"))
    if pair.faults:
        raise QuestionError(Problem(fault.what, fault.why, fault.fix, "--profile") for fault in pair.faults)
    if path.approach.start or path.recess.start:
        what = "this path of contact does not reach the pitch point"
        why = "the tooth thickness at the ends of its flanks is undefined"
        raise QuestionError(Problem(what, why, "use another tooth form"))


def alike(one: ToothRequirement, other: ToothRequirement) -> bool:
    """Return True if one tooth satisfies both requirements: equal tip radii, and equal flanks at common radii."""
    first, second = one.flank, other.flank
    if first.outward != second.outward or abs(first.r[-1] - second.r[-1]) > _ALIKE:
        return False
    # in order of increasing radius
    (r1, a1), (r2, a2) = (each.curve[:, :: each.outward] for each in (first, second))
    low, high = max(r1[0], r2[0]), min(r1[-1], r2[-1])
    r = np.linspace(low, high, 65)
    off = np.interp(r, r1, a1) + one.widening - np.interp(r, r2, a2) - other.widening
    return bool(np.abs(off * r).max() <= _ALIKE)


def cut_tooth(demands: Sequence[ToothRequirement], wanted: float | None = None) -> tuple[ToothOutline, float]:
    """Return the tooth that fits all pairs of a wheel, and the angle [rad] between its root flank and the tangent at
    the end of its active flank.

    The flank extends as deep as the tips of all mates need, and the root circle clears these tips. The fillet radius is
    the largest up to `wanted` [module], 0.38 by default, with which the tooth clears all mates. The flanks of all
    requirements must be equal where they are active. Raises `QuestionError` if no such tooth exists.
    """
    s = demands[0].flank.outward
    deepest = min(demands, key=lambda each: float(each.flank.r[0]) * s)
    # the deepest required root circle clears the tips of every mate
    root = min((each.root for each in demands), key=lambda radius: radius * s)
    own = deepest.flank
    if fillet(own, deepest.widening, root, _MINIMUM_FILLET, deepest.z) is None:
        what = f"gear {deepest.gear} cannot have a root circle"
        at = f"with a clearance of {deepest.clearance:.4g} modules"
        why = f"{at}, the flanks of neighbouring teeth meet before they reach it"
        fix = "reduce the clearance, or increase the backlash, which makes the teeth thinner"
        raise QuestionError(Problem(what, why, fix, "--blank clearance"))
    passages = [each.passage for each in demands]
    # every relief is tried at the strict tolerance before the loose one
    for most, degree in ((most, degree) for most in _TOLERATED_DEPTHS for degree in _RELIEFS):
        found = _largest_fillet(deepest, root, passages, radians(degree), most, _FILLET if wanted is None else wanted)
        if found is not None:
            return found, radians(degree)
    what = f"no root profile of gear {deepest.gear} clears the mate's tips"
    why = "the tips would cut the flanks below their active part, or touch teeth outside the path of contact"
    fix = "shorten the arcs, or use more teeth, backlash or clearance"
    raise QuestionError(Problem(what, why, fix, "--profile"))


def _largest_fillet(
    own: ToothRequirement, root: float, mates: Sequence[MatePassage], relief: float, most: float, wanted: float
) -> ToothOutline | None:
    """Return the tooth of `own` with the largest fillet radius up to `wanted` [module] for which no mate cuts deeper
    than `most` [module], found by bisection; None without one. `root` and `relief` are defined in `fillet`.
    """

    def made(radius: float) -> ToothOutline | None:
        root_fillet = fillet(own.flank, own.widening, root, radius, own.z, relief)
        if root_fillet is None:
            return None
        tooth = ToothOutline(own.z, own.flank, root_fillet, own.widening, root)
        return tooth if all(interference_depth(tooth, mate) <= most for mate in mates) else None

    low, high = _MINIMUM_FILLET, wanted
    if (largest := made(wanted)) is not None:
        return largest
    if (found := made(low)) is None or wanted <= low:
        return found
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if (better := made(middle)) is None:
            high = middle
        else:
            low, found = middle, better
    return found
