"""Involute wheels cut by a rack: sizes, tooth thickness, operating pressure angle of a pair, arcs of contact. Lengths
are in modules.

The rack is shifted outwards by `shift` modules. The tooth spaces of a ring gear have the shape of the teeth of an
external wheel. A profile shift of the ring is also positive outwards, so that it widens these spaces.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, atan, atan2, cos, pi, sin, sqrt, tan

from geartrain.errors import GearTrainError, Problem, RangeError
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_ROUNDING = 1e-12  # modules: a negative arc of less counts as 0


def inv(angle: float) -> float:
    """Return the involute function tan x - x of an angle x [rad]."""
    return tan(angle) - angle


def inv_angle(value: float) -> float:
    """Return the angle [rad] whose involute function equals `value`, which must be 0 or more."""
    # the tangent is infinite at a right angle
    high = pi / 2 - 1e-9
    return root(lambda x: inv(x) - value, 0.0, high, -value, inv(high) - value) if value else 0.0


@dataclass(frozen=True, slots=True)
class InvoluteWheel:
    """Involute wheel that is cut by a rack with the pressure angle psi [rad]. Lengths are in modules."""

    z: float
    psi: float
    shift: float
    addendum: float
    dedendum: float
    cut: float
    """Depth down to which the flank of the rack is straight [module]. A larger depth causes more undercut."""
    ring: bool = False

    @property
    def r(self) -> float:
        """Radius of the reference circle [module]."""
        return self.z / 2

    @property
    def base(self) -> float:
        """Radius of the base circle [module]."""
        return self.r * cos(self.psi)

    @property
    def tip(self) -> float:
        """Radius of the tip circle [module]."""
        return self.r + self.shift + (-self.addendum if self.ring else self.addendum)

    @property
    def root(self) -> float:
        """Radius of the root circle [module]."""
        return self.r + self.shift + (self.dedendum if self.ring else -self.dedendum)

    def half(self, psi: float) -> float:
        """Return half of the angular tooth thickness [rad] on the circle at which the pressure angle is `psi` [rad]."""
        # a ring's tooth has the shape of an external wheel's tooth space, with opposite signs of shift and involute
        sign = -1 if self.ring else 1
        return (pi / 2 + sign * 2 * self.shift * tan(self.psi)) / self.z + sign * (inv(self.psi) - inv(psi))

    def undercut(self) -> float:
        """Return the radius up to which the rack's corner cuts the involute away [module]; 0 if it cuts none away."""
        u = self.cut - self.shift
        if self.ring or u <= self.r * sin(self.psi) ** 2:
            return 0.0
        # at the base circle itself rounding may make the radicand negative
        low = max(self.base, self.r - u) * (1 + 1e-12)
        at_low, at_high = self._corner_offset(low), self._corner_offset(self.r)
        return root(self._corner_offset, low, self.r, at_low, at_high) if at_low < 0 < at_high else 0.0

    def _corner_offset(self, radius: float) -> float:
        """Return the azimuth of the trochoid cut by the rack's corner minus the azimuth of the involute, at a radius
        [rad]; negative where the corner cuts into the involute.
        """
        r, psi, u = self.r, self.psi, self.cut - self.shift
        below = r - u
        X = -u * tan(psi) - sqrt(radius**2 - below**2)
        corner = atan2(u * tan(psi) + X, below) - X / r
        roll = (sqrt(radius**2 - self.base**2) - r * sin(psi)) / cos(psi)
        P = roll * cos(psi)
        return corner - (atan2(P * cos(psi), r + P * sin(psi)) - roll / r)


@dataclass(frozen=True, slots=True)
class InvolutePair:
    """Pair of involute wheels at a centre distance [module]. The second wheel may be a ring gear."""

    first: InvoluteWheel
    second: InvoluteWheel
    distance: float
    thinned: float = 0.0
    """Sum by which the teeth of both wheels are thinner than without backlash, as an arc X [module]."""

    @property
    def psi(self) -> float:
        """Operating pressure angle psi_w [rad], from cos psi_w = (sum or difference of the base radii) / distance."""
        bases = self.second.base - self.first.base if self.second.ring else self.second.base + self.first.base
        return acos(bases / self.distance)

    @property
    def pitch(self) -> PitchSurfaces:
        """Operating pitch circles of both wheels."""
        z1, z2 = self.first.z, self.second.z
        scale = self.distance / (z2 - z1 if self.second.ring else z1 + z2)
        return PitchSurfaces(z1, z2, z1 * scale, (-z2 if self.second.ring else z2) * scale)

    @property
    def halves(self) -> tuple[float, float]:
        """Half-thicknesses of the teeth of both wheels, measured along their operating pitch circles [module]."""
        pitch, psi = self.pitch, self.psi
        first, second = self.first.half(psi) * pitch.R1, self.second.half(psi) * abs(pitch.R2)
        return first - self.thinned / 4, second - self.thinned / 4

    @property
    def backlash(self) -> float:
        """Backlash, measured along the operating pitch circle [module]; negative if the teeth jam."""
        return self.pitch.p - 2 * sum(self.halves)

    def bottom_clearance(self, gear: int) -> float:
        """Return the gap from a wheel's root circle to its mate's tip circle [module]; negative if they overlap."""
        own, mate = (self.first, self.second) if gear == 1 else (self.second, self.first)
        if not self.second.ring:
            return self.distance - mate.tip - own.root
        # for a ring, tips are inside and roots outside
        free = own.root - mate.tip if gear == 2 else mate.tip - own.root
        return free - self.distance

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess on the operating pitch circles [module], which are limited by the tip circles.

        One arc is negative if the tip circle of a wheel does not reach the operating pitch circle. Contact is then on
        one side of the pitch point only. Raises `RangeError` if the teeth do not reach each other at all.
        """
        pitch, psi = self.pitch, self.psi
        found = []
        for wheel, R in ((self.second, pitch.R2), (self.first, pitch.R1)):
            sign = -1 if wheel.ring else 1
            over = sign * (sqrt(max(wheel.tip**2 - wheel.base**2, 0.0)) - abs(R) * sin(psi))
            # an arc that is 0 except for rounding must not be negative
            found.append(0.0 if -_ROUNDING < over < 0 else over / cos(psi))
        if sum(found) <= 0:
            tips = f"of radii {self.first.tip:.6g} and {self.second.tip:.6g}"
            at = f"at a centre distance of {self.distance:.6g} modules"
            why = f"{at} the tip circles, {tips}, leave no contact on the line of action"
            fix = "use larger addenda, a smaller centre distance, or profile shifts that bring the tips closer"
            raise RangeError(Problem("the teeth do not reach each other", why, fix))
        return found[0], found[1]


def free_distance(first: InvoluteWheel, second: InvoluteWheel) -> float:
    """Return the centre distance at which the pair has no backlash [module]: inv psi_w = inv psi + 2 tan psi (x1 + x2)
    / (z1 + z2).

    psi is the pressure angle of the rack, psi_w the operating pressure angle; x1 and x2 are the profile shifts
    [module], and z1 and z2 the tooth numbers. With a ring gear, z1 and x1 of the pinion have a negative sign. Raises
    `GearTrainError` if no such distance exists because the negative profile shifts are too large.
    """
    psi, sign = first.psi, -1 if second.ring else 1
    teeth, shifts = second.z + sign * first.z, second.shift + sign * first.shift
    value = inv(psi) + 2 * tan(psi) * shifts / teeth
    if value < 0:
        raise GearTrainError(
            Problem(
                f"no centre distance lets wheels of {first.z} and {second.z} teeth mesh without backlash",
                f"with profile shifts x1 = {first.shift:g} and x2 = {second.shift:g} the involute function of the "
                f"operating pressure angle would be {value:.4g}, but it cannot be negative",
                "increase the sum of the profile shifts (with a ring, x2 - x1), or give a centre_distance",
            )
        )
    return teeth * cos(psi) / (2 * cos(inv_angle(value)))


def spherical_arc(R: float, psi: float, tip: float) -> float:
    """Return the arc X of a spherical involute from the pitch cone with the half-angle `R` to the tip cone with the
    half-angle `tip` [rad on the unit sphere].

    The arc is negative if the tip cone is inside the pitch cone. The distance d of the last contact from the pitch
    point follows from cos tip = cos d cos R - sin d sin psi sin R with the pressure angle psi, where cos(base cone) =
    sqrt(cos^2 R + sin^2 psi sin^2 R).
    """
    base = sqrt(cos(R) ** 2 + (sin(psi) * sin(R)) ** 2)
    # the involute begins at the base cone, so a smaller tip cone is replaced by it
    return (acos(min(cos(tip) / base, 1.0)) - atan2(sin(psi) * sin(R), cos(R))) / cos(psi)


def cone_height(R: float, z: float, height: float) -> float:
    """Return the angle [rad on the unit sphere] between the pitch cone of a bevel gear and a point above it. `R` is the
    half-angle of the pitch cone [rad], `z` the tooth number, and `height` the height of the point in modules of the
    large end.
    """
    return atan(height * 2 * sin(R) / z)
