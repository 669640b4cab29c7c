"""Sizes of a pair of wheels with triangular teeth: depth, radii, centre distance, reach.

Equations are numbered as in F. Sorge, "A note on the mechanics of ancient gear systems". Lengths are in any one unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import asin, cos, inf, pi, sin, sqrt

from geartrain.errors import Problem, RangeError

_LEAST = 1e-40  # of any unit: the fourth power of a radius is a float
_GRAZING = 1 - 1e-12  # sine of the angle between flank and driven radius: at 1 the speed ratio is infinite
_NEARLY_GRAZING = 2e-6  # rad: a little more than that sine leaves to a right angle


def depth(z: int, beta: float) -> float:
    """Tooth depth over outer radius, Eq. (1), as a product: the printed difference cancels at large z."""
    return 2 * sin(pi / (2 * z)) * cos(beta + pi / (2 * z)) / sin(beta + pi / z)


def flank(z: int, beta: float) -> float:
    """Length of a flank over outer radius, Eq. (2)."""
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
class TriangularSizes:
    """A pair whose first wheel drives: tooth numbers, outer radii, half apertures (rad) and centre distance.

    `excess` is the clearance factor less 1: D = (1 + excess) least_distance, and least_distance = R1 + R2 - (the
    smaller depth), where a tip would touch the bottom between two teeth.
    """

    z1: int
    z2: int
    R1: float
    R2: float
    beta1: float
    beta2: float
    excess: float

    def __post_init__(self) -> None:
        # without valleys there are no teeth, and radii of equal depth may come out negative: a verdict says so
        exist = min(self.z1, self.z2) >= 1 and self.has_valleys
        lengths = all(_LEAST < (radius if exist else abs(radius)) < 1 / _LEAST for radius in (self.R1, self.R2))
        angles = all(0 < beta < pi / 2 for beta in (self.beta1, self.beta2))
        if min(self.z1, self.z2) < 1 or not (lengths and angles and -1 < self.excess < inf):
            raise RangeError(
                Problem(
                    f"{self.z1} and {self.z2} teeth, outer radii {self.R1:g} and {self.R2:g}, half apertures "
                    f"{self.beta1:g} and {self.beta2:g} rad, excess {self.excess:g} are no pair of triangular teeth",
                    f"radii lie between {_LEAST:g} and {1 / _LEAST:g}, half apertures between 0 and a right angle",
                    "give at least 3 teeth, radii and half apertures above 0, and an excess above 0",
                )
            )

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
        return self.R1 * depth(self.z1, self.beta1), self.R2 * depth(self.z2, self.beta2)

    @cached_property
    def flanks(self) -> tuple[float, float]:
        """Length of the flanks of each wheel, Eq. (2)."""
        return self.R1 * flank(self.z1, self.beta1), self.R2 * flank(self.z2, self.beta2)

    @cached_property
    def least_distance(self) -> float:
        """Centre distance at clearance factor 1."""
        return self.R1 + self.R2 - min(self.depths)

    @cached_property
    def D(self) -> float:
        """Centre distance."""
        return self.R1 + self.R2 - self.delta

    @cached_property
    def delta(self) -> float:
        """Overlap of the tip circles; 0 or less where no tooth can touch."""
        # not R1 + R2 - D, which cancels at large tooth numbers
        return min(self.depths) - self.excess * self.least_distance

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
        return contact_half_angle(self.R1, self.R2, self.D, self.delta)

    @cached_property
    def reach2(self) -> float:
        """alpha_2max of Eq. (4)."""
        return contact_half_angle(self.R2, self.R1, self.D, self.delta)

    @cached_property
    def matching(self) -> float:
        """alpha_1m of Eq. (10), where flank lies on flank; for unequal apertures too.

        Both flanks lie on one line when D sin(alpha_1m + beta1) = R1 sin(beta1) + R2 sin(beta2); the sine of alpha_1m
        is written without the difference of nearly equal angles. Infinite where no such position exists.
        """
        first = sin(self.beta1)
        unlike = 2 * cos((self.beta1 + self.beta2) / 2) * sin((self.beta2 - self.beta1) / 2)
        more = (self.delta * first + self.R2 * unlike) / self.D
        line = first + more
        if line >= 1:
            return inf
        cosine = cos(self.beta1)
        return asin(more * (2 * first + more) / (line * cosine + sqrt((1 - line) * (1 + line)) * first))

    @cached_property
    def lean(self) -> tuple[bool, bool]:
        """Whether the flanks of each wheel lean beyond the perpendicular where tips meet: few, deep teeth."""
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
    def greatest_excess(self) -> float:
        """Excess beyond which tips never touch."""
        return min(self.depths) / self.least_distance

    @cached_property
    def has_valleys(self) -> bool:
        """True if beta + 180/z < 90 deg for both wheels: else two flanks never meet in a valley."""
        return self.beta1 + pi / self.z1 < pi / 2 and self.beta2 + pi / self.z2 < pi / 2

    def swapped(self) -> TriangularSizes:
        """The same pair with the second wheel driving."""
        return TriangularSizes(self.z2, self.z1, self.R2, self.R1, self.beta2, self.beta1, self.excess)

    def at(self, excess: float) -> TriangularSizes:
        """The same wheels at another clearance."""
        return TriangularSizes(self.z1, self.z2, self.R1, self.R2, self.beta1, self.beta2, excess)


def equal_depth(z1: int, z2: int, beta1: float, beta2: float) -> tuple[float, float]:
    """Outer radii of wheels with equally deep teeth, Eq. (3), with R1 = 1."""
    return 1.0, depth(z1, beta1) / depth(z2, beta2)


def pitch_true(z1: int, z2: int) -> tuple[float, float]:
    """Outer radii in the ratio of tooth numbers, with R1 = 1."""
    return 1.0, z2 / z1
