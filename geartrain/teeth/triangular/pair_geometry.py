"""Sizes of a pair of wheels with triangular teeth: depth, radii, centre distance, range of contact.

Equations are numbered as in F. Sorge, "A note on the mechanics of ancient gear systems". All lengths are in one
arbitrary unit. Sorge treats external pairs. An internal pair follows from the same equations if the tooth number and
the radius of the ring gear and the centre distance are negative (docs/teeth.md, internal pairs).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import asin, copysign, cos, inf, pi, sin, sqrt
from typing import Literal

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Shown

_MINIMUM = 1e-40  # in any unit: the fourth power of a radius must not underflow
_GRAZING = 1 - 1e-12  # sine of the angle between flank and driven radius: at 1 the speed ratio is infinite
_NEARLY_GRAZING = 2e-6  # rad: slightly more than the difference of that angle from a right angle


def depth(z: int, beta: float) -> float:
    """Return the tooth depth divided by the tip radius, for z teeth with a half aperture angle `beta` [rad], Eq. (1).

    The ratio is computed as a product, because the printed difference suffers from cancellation for large z. For a ring
    gear of z teeth, pass -z and multiply the result by the negative radius.
    """
    return 2 * sin(pi / (2 * z)) * cos(beta + pi / (2 * z)) / sin(beta + pi / z)


def flank(z: int, beta: float) -> float:
    """Return the flank length divided by the tip radius for z teeth of half aperture angle `beta` [rad], Eq. (2)."""
    return sin(pi / z) / sin(beta + pi / z)


def contact_half_angle(R1: float, R2: float, D: float, delta: float) -> float:
    """Return the maximum angle [rad] between a tip of wheel 1 and the line of centres at which tips can touch, Eq. (4).

    The angle follows from the overlap delta = R1 + R2 - D of the tip circles, where R1 and R2 are the tip radii and D
    is the centre distance.
    """
    # half-angle form of the cosine rule: the cosine, near 1, would lose half the digits
    square = delta * (2 * R2 - delta) / (4 * D * R1)
    # 0 if tips do not overlap; above 1 they would pass the far side
    return 2 * asin(sqrt(min(1.0, max(0.0, square))))


def grazing(R1: float, R2: float, beta: float, D: float) -> tuple[float, float]:
    """Return the direction psi [rad] at which a flank of wheel 1 is almost tangent to the tip circle of wheel 2, and
    sin(psi + alpha_2). Here alpha_2 is the angle from the line of centres of the apex of wheel 2 that touches this
    flank. R1 and R2 are the tip radii, beta is the half aperture angle of wheel 1, and D the centre distance.
    """
    sine = min(1.0, (_GRAZING * R2 + R1 * sin(beta)) / D)
    return asin(sine), (D * sine - R1 * sin(beta)) / R2


@dataclass(frozen=True)
class TriangularSizes(Shown):
    """Geometry of a pair of wheels with triangular teeth, in which the first wheel drives. All lengths are in one
    arbitrary unit.

    At `deepest_distance` a tip touches the bottom between two teeth. For an external pair this is the minimum centre
    distance, R1 + R2 - (the smaller depth). For an internal pair it is the maximum centre distance, R_ring - R_pinion +
    (the smaller depth).

    Raises
    ------
    RangeError
        If the values do not describe a pair of triangular teeth.

    See Also
    --------
    geartrain.teeth.Triangular : Its method `sizes` returns the sizes of a declared pair.

    Examples
    --------
    Equally deep teeth, at a centre distance 1 per cent larger than the distance at which tips touch bottoms:

    >>> from math import pi
    >>> sizes = TriangularSizes(48, 96, *equal_depth(48, 96, pi / 6, pi / 6), pi / 6, pi / 6, 0.01)
    >>> round(sizes.R2, 6), round(sizes.D, 6), round(sizes.clearance_factor, 6)
    (1.881845, 2.809639, 1.01)
    """

    z1: int
    """Tooth number of the first wheel."""
    z2: int
    """Tooth number of the second wheel."""
    R1: float
    """Tip radius of the first wheel, in the common length unit."""
    R2: float
    """Tip radius of the second wheel, in the common length unit."""
    beta1: float
    """Half of the aperture angle of the teeth of the first wheel [rad]."""
    beta2: float
    """Half of the aperture angle of the teeth of the second wheel [rad]."""
    excess: float
    """Relative deviation of the centre distance from `deepest_distance`.

    D = (1 + excess) deepest_distance for an external pair. D = (1 - excess) deepest_distance for an internal pair,
    whose clearance factor is below 1.
    """
    ring: Literal[0, 1, 2] = 0
    """Number of the wheel that is a ring gear; 0 for an external pair."""

    def __post_init__(self) -> None:
        # without valleys teeth do not exist, and radii of equal depth may be negative; the verdict reports this
        exist = min(self.z1, self.z2) >= 1 and self.has_valleys
        lengths = all(_MINIMUM < (radius if exist else abs(radius)) < 1 / _MINIMUM for radius in (self.R1, self.R2))
        angles = all(0 < beta < pi / 2 for beta in (self.beta1, self.beta2))
        if min(self.z1, self.z2) < 1 or not (lengths and angles and -1 < self.side * self.excess < inf):
            raise RangeError(
                Problem(
                    f"these parameters do not describe triangular teeth: {self.z1} and {self.z2} teeth, outer radii "
                    f"{self.R1:g} and {self.R2:g}, half angles {self.beta1:g} and {self.beta2:g} rad, clearance factor "
                    f"{1 + self.side * self.excess:g}",
                    f"each wheel must have teeth, radii must be between {_MINIMUM:g} and {1 / _MINIMUM:g}, half angles "
                    "between 0 and pi/2 rad, and the clearance factor must be positive",
                    "give tooth counts, radii and half angles in these ranges, and a clearance factor such as 1.02",
                )
            )

    @property
    def signs(self) -> tuple[int, int]:
        """Signs of tooth number and radius of each wheel in the equations: -1 for a ring gear, 1 otherwise."""
        return (-1 if self.ring == 1 else 1), (-1 if self.ring == 2 else 1)

    @property
    def side(self) -> int:
        """Sign of the centre distance and of the driven angle alpha_2 in the equations: -1 for internal pairs."""
        return -1 if self.ring else 1

    @property
    def signed_radii(self) -> tuple[float, float]:
        """Tip radii of both wheels, in the common length unit. The radius of a ring gear is negative."""
        return self.signs[0] * self.R1, self.signs[1] * self.R2

    @property
    def radii(self) -> tuple[float, float]:
        """Tip radii of both wheels, in the common length unit."""
        return self.R1, self.R2

    @property
    def half_angles(self) -> tuple[float, float]:
        """Half of the aperture angle of the teeth of each wheel [rad]."""
        return self.beta1, self.beta2

    @cached_property
    def depths(self) -> tuple[float, float]:
        """Tooth depths of both wheels, in the common length unit, Eq. (1)."""
        (s1, s2), (R1, R2) = self.signs, self.signed_radii
        return R1 * depth(s1 * self.z1, self.beta1), R2 * depth(s2 * self.z2, self.beta2)

    @cached_property
    def flanks(self) -> tuple[float, float]:
        """Lengths of the flanks of both wheels, in the common length unit, Eq. (2)."""
        (s1, s2), (R1, R2) = self.signs, self.signed_radii
        return R1 * flank(s1 * self.z1, self.beta1), R2 * flank(s2 * self.z2, self.beta2)

    @cached_property
    def deepest_distance(self) -> float:
        """Centre distance at which a tip touches the bottom of a tooth space, in the common length unit."""
        return self.side * (sum(self.signed_radii) - min(self.depths))

    @cached_property
    def D(self) -> float:
        """Centre distance of the pair, in the common length unit."""
        return self.side * (sum(self.signed_radii) - self.delta)

    @property
    def pitch_sum(self) -> int:
        """Sum of the tooth numbers (difference for internal pairs): twice the centre distance over the module."""
        return abs(self.signs[0] * self.z1 + self.signs[1] * self.z2)

    @property
    def surrounds(self) -> bool:
        """True if the tip circles of an internal pair overlap at every angle, so that the pinion cannot come free."""
        return bool(self.ring) and sum(self.signed_radii) >= self.D

    @property
    def clearance_factor(self) -> float:
        """Centre distance divided by `deepest_distance`: above 1 for external, below 1 for internal pairs."""
        return self.factor(self.excess)

    def factor(self, excess: float) -> float:
        """Return the clearance factor, the centre distance divided by `deepest_distance`, for a given excess.

        Parameters
        ----------
        excess : float
            Relative deviation of the centre distance, as in the field `excess`.
        """
        return 1 + self.side * excess

    @cached_property
    def delta(self) -> float:
        """Overlap of the tip circles, in the common length unit; 0 or negative if the teeth cannot touch."""
        # R1 + R2 - D would cancel at large tooth numbers
        return min(self.depths) - self.excess * self.deepest_distance

    @cached_property
    def p1(self) -> float:
        """Angular pitch of the driver [rad]."""
        return 2 * pi / self.z1

    @cached_property
    def p2(self) -> float:
        """Angular pitch of the driven wheel [rad]."""
        return 2 * pi / self.z2

    @cached_property
    def ratio(self) -> float:
        """Mean speed ratio: absolute value of the driven speed divided by the driver speed."""
        return self.z1 / self.z2

    @cached_property
    def reach1(self) -> float:
        """Maximum angle alpha_1max [rad] from the line of centres at which a tip of the driver can touch, Eq. (4)."""
        return contact_half_angle(*self.signed_radii, self.side * self.D, self.delta)

    @cached_property
    def reach2(self) -> float:
        """Maximum angle alpha_2max [rad] from the line of centres at which a driven tip can touch, Eq. (4)."""
        return contact_half_angle(*self.signed_radii[::-1], self.side * self.D, self.delta)

    @cached_property
    def matching(self) -> float:
        """Angle alpha_1m [rad] between the driver's apex and the line of centres in the matching position, in which the
        flanks of both teeth coincide, Eq. (10). It is also defined for unequal aperture angles.

        Both flanks lie on one line when D sin(alpha_1m + beta1) = R1 sin(beta1) + R2 sin(beta2). The expression for the
        sine of alpha_1m avoids the difference of nearly equal angles. The value is infinite if no such position exists.
        """
        mirror, D, R2 = self.signs[0], self.side * self.D, self.signed_radii[1]
        first = mirror * sin(self.beta1)
        unlike = mirror * 2 * cos((self.beta1 + self.beta2) / 2) * sin((self.beta2 - self.beta1) / 2)
        more = (self.delta * first + R2 * unlike) / D
        line = first + more
        if abs(line) >= 1:
            return copysign(inf, line)
        cosine = cos(self.beta1)
        return asin(more * (2 * first + more) / (line * cosine + sqrt((1 - line) * (1 + line)) * first))

    @cached_property
    def lean(self) -> tuple[bool, bool]:
        """Flag for each wheel: True if its flanks overhang. A flank overhangs if it leans beyond the perpendicular to
        the mate's radius where tips meet.

        Flanks overhang in wheels with few, deep teeth. They never overhang in an internal pair, because flank and
        driven radius turn in the same sense.
        """
        if self.ring:
            return False, False
        most = pi / 2 - self.reach1 - self.reach2 - _NEARLY_GRAZING
        return self.beta1 > most, self.beta2 > most

    @cached_property
    def entry(self) -> float:
        """Angle alpha_1 [rad] between the driver's apex and the line of centres at which a tooth pair comes into
        contact.

        The angle is alpha_1max, or smaller if an overhanging flank is tangent to the driven tip circle before that
        position.
        """
        if not self.lean[0]:
            return self.reach1
        return grazing(self.R1, self.R2, self.beta1, self.D)[0] - self.beta1

    @cached_property
    def exit(self) -> float:
        """Angle alpha_1 [rad] between the driver's apex and the line of centres at which a tooth pair ceases to drive.

        The angle is -alpha_1max, or larger if the apex slips off an overhanging flank before that position.
        """
        if not self.lean[1]:
            return -self.reach1
        psi, s = grazing(self.R2, self.R1, self.beta2, self.D)
        return psi - asin(s)

    @cached_property
    def maximum_excess(self) -> float:
        """Maximum excess at which the teeth can touch. If the centre distance deviates more, tips never touch, or the
        tip circles of an internal pair overlap at every angle.
        """
        apart = min(self.depths) / self.deepest_distance
        return apart if not self.ring else min(apart, 1 + self.side * sum(self.signed_radii) / self.deepest_distance)

    @cached_property
    def has_valleys(self) -> bool:
        """True if neighbouring flanks of both wheels meet in a valley. The condition is: half aperture angle + 180
        deg/z < 90 deg for an external wheel, and half aperture angle > 180 deg/z for a ring gear, where z is the tooth
        number.
        """
        wheels = zip(self.signs, (self.z1, self.z2), self.half_angles, strict=True)
        return all(0 < beta + sign * pi / z < pi / 2 for sign, z, beta in wheels)

    def swapped(self) -> TriangularSizes:
        """Return the pair with the same sizes, in which the second wheel drives."""
        ring: Literal[0, 1, 2] = 2 if self.ring == 1 else 1 if self.ring == 2 else 0
        return TriangularSizes(self.z2, self.z1, self.R2, self.R1, self.beta2, self.beta1, self.excess, ring)

    def at(self, excess: float) -> TriangularSizes:
        """Return the same wheels at another centre distance.

        Parameters
        ----------
        excess : float
            Relative deviation of the centre distance, as in the field `excess`.
        """
        return replace(self, excess=excess)


def equal_depth(z1: int, z2: int, beta1: float, beta2: float, ring: int = 0) -> tuple[float, float]:
    """Return the tip radii of wheels with equally deep teeth, Eq. (3) of the source, with R1 = 1.

    Parameters
    ----------
    z1, z2 : int
        Tooth numbers.
    beta1, beta2 : float
        Half aperture angles [rad].
    ring : {0, 1, 2}
        Number of the wheel that is a ring gear; 0 for an external pair.

    Returns
    -------
    tuple of float
        Radii R1 and R2.

    Examples
    --------
    >>> from math import pi
    >>> [round(radius, 6) for radius in equal_depth(48, 96, pi / 6, pi / 6)]
    [1.0, 1.881845]
    """
    return 1.0, abs(depth(-z1 if ring == 1 else z1, beta1) / depth(-z2 if ring == 2 else z2, beta2))


def pitch_true(z1: int, z2: int) -> tuple[float, float]:
    """Return tip radii in the ratio of the tooth numbers, with R1 = 1.

    Parameters
    ----------
    z1, z2 : int
        Tooth numbers.

    Returns
    -------
    tuple of float
        Radii R1 and R2.

    Examples
    --------
    >>> pitch_true(48, 96)
    (1.0, 2.0)
    """
    return 1.0, z2 / z1
