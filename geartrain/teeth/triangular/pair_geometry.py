"""Sizes of a pair of wheels with triangular teeth: depth, radii, centre distance, reach.

Equations are numbered as in F. Sorge, "A note on the mechanics of ancient gear systems". Lengths are in any one unit.
Sorge treats external pairs. An internal pair follows from the same equations, with the tooth count and the radius of
the ring and the centre distance negative (docs/teeth.md, internal pairs).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import asin, copysign, cos, inf, pi, sin, sqrt
from typing import Literal

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Shown

_MINIMUM = 1e-40  # of any unit: the fourth power of a radius is a float
_GRAZING = 1 - 1e-12  # sine of the angle between flank and driven radius: at 1 the speed ratio is infinite
_NEARLY_GRAZING = 2e-6  # rad: a little more than that sine leaves to a right angle


def depth(z: int, beta: float) -> float:
    """Tooth depth over the radius of the tips, Eq. (1), as a product: the printed difference cancels at large z.

    Times a negative radius for a ring of -z teeth.
    """
    return 2 * sin(pi / (2 * z)) * cos(beta + pi / (2 * z)) / sin(beta + pi / z)


def flank(z: int, beta: float) -> float:
    """Length of a flank over the radius of the tips, Eq. (2)."""
    return sin(pi / z) / sin(beta + pi / z)


def contact_half_angle(R1: float, R2: float, D: float, delta: float) -> float:
    """Largest |alpha_1| at which tips can touch, Eq. (4), from the overlap delta = R1 + R2 - D of the tip circles."""
    # the half-angle form of the cosine rule: the cosine itself, near 1, would lose half the digits
    square = delta * (2 * R2 - delta) / (4 * D * R1)
    # 0 where tips do not overlap; above 1 they would go past the far side
    return 2 * asin(sqrt(min(1.0, max(0.0, square))))


def grazing(R1: float, R2: float, beta: float, D: float) -> tuple[float, float]:
    """Direction psi of a flank of wheel 1 that all but grazes the tips of wheel 2, and the sine of psi + alpha_2."""
    sine = min(1.0, (_GRAZING * R2 + R1 * sin(beta)) / D)
    return asin(sine), (D * sine - R1 * sin(beta)) / R2


@dataclass(frozen=True)
class TriangularSizes(Shown):
    """Geometry of a pair of wheels with triangular teeth, the first of which drives. Lengths are in any one unit.

    At `deepest_distance` a tip touches the bottom between two teeth: the minimum distance R1 + R2 - (the smaller depth)
    of an external pair, the maximum R_ring - R_pinion + (the smaller depth) of an internal one.

    Raises
    ------
    RangeError
        For values that give no teeth.

    See Also
    --------
    geartrain.teeth.Triangular : its method `sizes` gives them from a declaration.

    Examples
    --------
    Equally deep teeth, 1 per cent farther apart than where tips touch bottoms:

    >>> from math import pi
    >>> sizes = TriangularSizes(48, 96, *equal_depth(48, 96, pi / 6, pi / 6), pi / 6, pi / 6, 0.01)
    >>> round(sizes.R2, 6), round(sizes.D, 6), round(sizes.clearance_factor, 6)
    (1.881845, 2.809639, 1.01)
    """

    z1: int
    """Tooth count of the first wheel."""
    z2: int
    """Tooth count of the second wheel."""
    R1: float
    """Tip radius of the first wheel."""
    R2: float
    """Tip radius of the second wheel."""
    beta1: float
    """Half aperture of the teeth of the first wheel [rad]."""
    beta2: float
    """Half aperture of the teeth of the second wheel [rad]."""
    excess: float
    """The part of `deepest_distance` by which the wheels are apart: D = (1 + excess) deepest_distance outside, (1 -
    excess) inside, where the clearance factor is below 1."""
    ring: Literal[0, 1, 2] = 0
    """The wheel whose teeth are inside; 0 for an external pair."""

    def __post_init__(self) -> None:
        # without valleys there are no teeth, and radii of equal depth may come out negative: a verdict says so
        exist = min(self.z1, self.z2) >= 1 and self.has_valleys
        lengths = all(_MINIMUM < (radius if exist else abs(radius)) < 1 / _MINIMUM for radius in (self.R1, self.R2))
        angles = all(0 < beta < pi / 2 for beta in (self.beta1, self.beta2))
        if min(self.z1, self.z2) < 1 or not (lengths and angles and -1 < self.side * self.excess < inf):
            raise RangeError(
                Problem(
                    f"{self.z1} and {self.z2} teeth, outer radii {self.R1:g} and {self.R2:g}, half apertures "
                    f"{self.beta1:g} and {self.beta2:g} rad, excess {self.excess:g} are no pair of triangular teeth",
                    f"radii lie between {_MINIMUM:g} and {1 / _MINIMUM:g}, half apertures between 0 and a right angle",
                    "give at least 3 teeth, radii and half apertures above 0, and an excess above 0",
                )
            )

    @property
    def signs(self) -> tuple[int, int]:
        """-1 for a ring, whose count and radius are negative in the equations of external pairs; else 1."""
        return (-1 if self.ring == 1 else 1), (-1 if self.ring == 2 else 1)

    @property
    def side(self) -> int:
        """1 for an external pair, -1 for an internal one: the sign of the centre distance and of alpha_2."""
        return -1 if self.ring else 1

    @property
    def signed_radii(self) -> tuple[float, float]:
        """Tip radii, that of a ring negative."""
        return self.signs[0] * self.R1, self.signs[1] * self.R2

    @property
    def radii(self) -> tuple[float, float]:
        """Outer radii."""
        return self.R1, self.R2

    @property
    def half_angles(self) -> tuple[float, float]:
        """Half apertures (rad)."""
        return self.beta1, self.beta2

    @cached_property
    def depths(self) -> tuple[float, float]:
        """Depth of the teeth of each wheel, Eq. (1)."""
        (s1, s2), (R1, R2) = self.signs, self.signed_radii
        return R1 * depth(s1 * self.z1, self.beta1), R2 * depth(s2 * self.z2, self.beta2)

    @cached_property
    def flanks(self) -> tuple[float, float]:
        """Length of the flanks of each wheel, Eq. (2)."""
        (s1, s2), (R1, R2) = self.signs, self.signed_radii
        return R1 * flank(s1 * self.z1, self.beta1), R2 * flank(s2 * self.z2, self.beta2)

    @cached_property
    def deepest_distance(self) -> float:
        """Centre distance at clearance factor 1."""
        return self.side * (sum(self.signed_radii) - min(self.depths))

    @cached_property
    def D(self) -> float:
        """Centre distance."""
        return self.side * (sum(self.signed_radii) - self.delta)

    @property
    def pitch_sum(self) -> int:
        """z1 + z2, or the difference in an internal pair: D over it is half the module at the pitch point."""
        return abs(self.signs[0] * self.z1 + self.signs[1] * self.z2)

    @property
    def surrounds(self) -> bool:
        """True if the tips of an internal pair overlap all round: no tooth of the pinion finds a space."""
        return bool(self.ring) and sum(self.signed_radii) >= self.D

    @property
    def clearance_factor(self) -> float:
        """Centre distance over the deepest: above 1 for an external pair, below 1 for an internal one."""
        return self.factor(self.excess)

    def factor(self, excess: float) -> float:
        """The clearance factor of an excess.

        Parameters
        ----------
        excess : float
            See the class.
        """
        return 1 + self.side * excess

    @cached_property
    def delta(self) -> float:
        """Overlap of the tip circles; 0 or less where no tooth can touch."""
        # not R1 + R2 - D, which cancels at large tooth numbers
        return min(self.depths) - self.excess * self.deepest_distance

    @cached_property
    def p1(self) -> float:
        """Angular pitch of the driver."""
        return 2 * pi / self.z1

    @cached_property
    def p2(self) -> float:
        """Angular pitch of the driven wheel."""
        return 2 * pi / self.z2

    @cached_property
    def ratio(self) -> float:
        """Mean speed ratio, driven over driver, without sign."""
        return self.z1 / self.z2

    @cached_property
    def reach1(self) -> float:
        """alpha_1max of Eq. (4)."""
        return contact_half_angle(*self.signed_radii, self.side * self.D, self.delta)

    @cached_property
    def reach2(self) -> float:
        """alpha_2max of Eq. (4)."""
        return contact_half_angle(*self.signed_radii[::-1], self.side * self.D, self.delta)

    @cached_property
    def matching(self) -> float:
        """alpha_1m of Eq. (10), where flank lies on flank; for unequal apertures too.

        Both flanks lie on one line when D sin(alpha_1m + beta1) = R1 sin(beta1) + R2 sin(beta2); the sine of alpha_1m
        is written without the difference of nearly equal angles. Infinite where no such position exists.
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
        """Whether the flanks of each wheel lean beyond the perpendicular where tips meet: few, deep teeth.

        Never in an internal pair, whose flank and driven radius turn the same way.
        """
        if self.ring:
            return False, False
        most = pi / 2 - self.reach1 - self.reach2 - _NEARLY_GRAZING
        return self.beta1 > most, self.beta2 > most

    @cached_property
    def entry(self) -> float:
        """alpha_1 where a couple first touches: alpha_1max, or before, where a leaning flank grazes the driven tips."""
        if not self.lean[0]:
            return self.reach1
        return grazing(self.R1, self.R2, self.beta1, self.D)[0] - self.beta1

    @cached_property
    def exit(self) -> float:
        """alpha_1 where a couple ceases to drive: -alpha_1max, or before, where its apex slips off a leaning flank."""
        if not self.lean[1]:
            return -self.reach1
        psi, s = grazing(self.R2, self.R1, self.beta2, self.D)
        return psi - asin(s)

    @cached_property
    def maximum_excess(self) -> float:
        """Excess beyond which tips never touch, or in an internal pair the tip circles overlap all round."""
        apart = min(self.depths) / self.deepest_distance
        return apart if not self.ring else min(apart, 1 + self.side * sum(self.signed_radii) / self.deepest_distance)

    @cached_property
    def has_valleys(self) -> bool:
        """True if two flanks meet in a valley: beta + 180/z < 90 deg, for a ring beta > 180/z."""
        wheels = zip(self.signs, (self.z1, self.z2), self.half_angles, strict=True)
        return all(0 < beta + sign * pi / z < pi / 2 for sign, z, beta in wheels)

    def swapped(self) -> TriangularSizes:
        """The same pair with the second wheel driving."""
        ring: Literal[0, 1, 2] = 2 if self.ring == 1 else 1 if self.ring == 2 else 0
        return TriangularSizes(self.z2, self.z1, self.R2, self.R1, self.beta2, self.beta1, self.excess, ring)

    def at(self, excess: float) -> TriangularSizes:
        """The same wheels at another clearance.

        Parameters
        ----------
        excess : float
            See the class.
        """
        return replace(self, excess=excess)


def equal_depth(z1: int, z2: int, beta1: float, beta2: float, ring: int = 0) -> tuple[float, float]:
    """Tip radii of wheels with equally deep teeth, Eq. (3) of the source, with R1 = 1.

    Parameters
    ----------
    z1, z2 : int
        Tooth counts.
    beta1, beta2 : float
        Half apertures [rad].
    ring : {0, 1, 2}
        The wheel whose teeth are inside; 0 for an external pair.

    Returns
    -------
    tuple of float
        R1 and R2.

    Examples
    --------
    >>> from math import pi
    >>> [round(radius, 6) for radius in equal_depth(48, 96, pi / 6, pi / 6)]
    [1.0, 1.881845]
    """
    return 1.0, abs(depth(-z1 if ring == 1 else z1, beta1) / depth(-z2 if ring == 2 else z2, beta2))


def pitch_true(z1: int, z2: int) -> tuple[float, float]:
    """Tip radii in the ratio of tooth counts, with R1 = 1.

    Parameters
    ----------
    z1, z2 : int
        Tooth counts.

    Returns
    -------
    tuple of float
        R1 and R2.

    Examples
    --------
    >>> pitch_true(48, 96)
    (1.0, 2.0)
    """
    return 1.0, z2 / z1
