"""Transmission function of two outlines at a given centre distance, from the contact of their flanks.

The parts of the teeth in contact are computed, not assumed. Transmission error, speed and friction are obtained for any
teeth of equal pitch, conjugate or not. Only spur teeth are supported, since bevels have no centre distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import pairwise
from math import inf, nan, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.contact.outline_contact import contact, solve
from geartrain.teeth.contact.transmission_fit import tabulate
from geartrain.teeth.pair_results import PairVerdict, ToothFault, verdict_of_faults
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing, SpeedLeap, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact.gear_outline import GearOutline
    from geartrain.teeth.contact.transmission_fit import PiecewiseTransmission

_NEAR_PITCH_POINT = 1e-7  # fraction of the centre distance: uncertainty of roots of differences of squares
_FLAT = 1e-9  # smaller friction slopes against a contact are rounding error, and do not lock
_SAMPLES = 256  # angles of a pitch at which backlash is evaluated


@dataclass(frozen=True, eq=False)
class OutlineGears:
    """Outlines of two wheels at a given centre distance. Lengths are in modules."""

    first: GearOutline
    """Outline of gear 1 [module]."""
    second: GearOutline
    """Outline of gear 2 [module]."""
    distance: float
    """Centre distance of the wheels [module]."""
    half_teeth: float
    """Sum of half the tooth thicknesses of both wheels [module], which sets the position of driven angle 0."""
    backlash: float
    """Designed backlash on the pitch circles [module]."""
    faults: tuple[ToothFault, ...] = ()
    """Faults of the teeth that do not depend on the centre distance."""

    def of(self, driver: int) -> tuple[GearOutline, GearOutline]:
        """Return the driving wheel and the driven wheel."""
        return (self.first, self.second) if driver == 1 else (self.second, self.first)


class OutlineTransmission(ToothTransmission):
    """Transmission function of two outlines.

    `driver` is the number of the driving wheel, 1 or 2. A `direction` of -1 reverses the motion. At the driver angle S
    = 0, a tooth of the driver is on the line of centres, and the driven angle at which flanks touch is 0.
    """

    slow = True

    def __init__(self, gears: OutlineGears, friction: float = 0.0, driver: int = 1, direction: int = 1) -> None:
        self.gears, self.distance = gears, gears.distance
        self.friction, self.driver, self.direction = check_friction(friction), driver, direction
        driving, driven = gears.of(driver)
        self.ratio, self.period = Fraction(driving.z, driven.z), 2 * pi / driving.z
        self._offset, self._backlash = 2 * gears.half_teeth / driven.z, 2 * gears.backlash / driven.z

    @property
    def table(self) -> PiecewiseTransmission:
        """Driven angle as piecewise polynomials of the driver angle, for contact of the front flanks."""
        return _tabulated(self.gears, self.driver)

    def _driven(self, driver: int, direction: int) -> OutlineTransmission:
        return OutlineTransmission(self.gears, self.friction, driver, direction)

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict on whether the pair can run, from its tooth faults, backlash and gaps in contact."""
        backlashes = _backlashes(self.gears, self.driver)
        backlash = float(np.nanmin(backlashes, initial=inf))
        found, at = list(self.gears.faults), f"at a centre distance of {self.distance:.6g} modules"
        # rad: without backlash the teeth touch on both sides up to rounding error
        if backlash < -1e-12:
            why = f"{at} the teeth overlap by {-backlash:.4g} rad of the driven wheel"
            fix = "increase the centre distance (in a ring, reduce it), or thin the teeth with `backlash`"
            found.append(ToothFault("jam", 0, nan, "the teeth jam", why, fix))
        if not np.isfinite(backlashes).all():
            why = f"{at} no teeth touch during {np.mean(~np.isfinite(backlashes)):.1%} of a pitch"
            fix = "reduce the centre distance (in a ring, increase it), or use longer arcs"
            found.append(ToothFault("contact ratio", 0, nan, "the teeth do not reach each other", why, fix))
        return verdict_of_faults(tuple(found), backlash)

    # ---------------------------------------------------------------------------------------------------- kinematics

    def _forward(self, S: ArrayLike) -> Floats:
        return self.direction * np.asarray(S, dtype=float)

    def _in_direction(self, error: Floats | float) -> Floats:
        """Convert transmission errors [rad] of front flanks to errors of the flanks that touch in this `direction`."""
        ahead = np.asarray(error) - self._offset
        return ahead if self.direction > 0 else self._backlash - ahead

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven wheel] at driver angles S [rad]; NaN without contact."""
        return self._in_direction(self.table.error(self._forward(S)))

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio at driver angles S [rad]."""
        return self.table.speed(self._forward(S))

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio, at which the next tooth takes over."""
        return self.table.speed_leaps()

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases with the driver angle [1/rad]."""
        return self.table.steepest_fall()

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] at which the contact changes to another tooth or curve."""
        return [self.direction * float(at) for at in self.table.kinks]

    def smooth_intervals(self) -> list[tuple[float, float]]:
        """Return the intervals of the driver angle [rad] in each of which the driven angle is a single polynomial."""
        edges = sorted((self.direction * self.table.breaks).tolist())
        return list(pairwise(edges))

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad of the driven wheel]."""
        # reversed motion changes the sign and so exchanges minimum and maximum
        low, high = sorted(float(self._in_direction(each)) for each in self.table.extremes())
        return low, high

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio."""
        return self.table.speed_range()

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the transmission error and its rms deviation from the mean [rad of the driven wheel]."""
        mean, rms = self.table.moments()
        return float(self._in_direction(mean)), rms

    # ------------------------------------------------------------------------------------------------------- friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speed of the contact at driver angles S [rad], and the changes of its input and output
        power per unit friction coefficient.

        The common normal passes through the instantaneous pitch point, which divides the centre distance in the ratio
        of the speeds. If this point is taken as the pitch point, the formulas of conjugate teeth apply to the contact.
        """
        forward = self._forward(S)
        cosine, into, out = _friction_terms(self.gears, self.driver, forward)
        # the instantaneous pitch point divides the distance by speeds, the nominal pitch point by tooth numbers
        first, second = self.gears.of(self.driver)
        speed, mean = self.table.speed(forward), float(self.ratio)
        same = -1 if first.ring or second.ring else 1
        share = np.abs(speed / (speed + same) * (mean + same) / mean)
        with np.errstate(divide="ignore", invalid="ignore"):
            found = np.abs(into - out) * share, into / cosine, out / cosine
        return ContactRubbing(*(each[None] for each in found))

    @cached_property
    def locking_friction(self) -> float:
        """Minimum friction coefficient that locks a contact at a sampled driver angle; infinite if none locks."""
        steepest = float(np.nanmax(-self.rubbing(self.graded_nodes(self.speed)[0]).out))
        return 1 / steepest if steepest > _FLAT else inf


def _friction_terms(gears: OutlineGears, driver: int, forward: Floats) -> tuple[Floats, Floats, Floats]:
    """Return three quantities at driver angles `forward` [rad]: the cosine of the pressure angle, and the changes of
    input power and output power per unit friction coefficient, both multiplied by this cosine.
    """
    first, second = gears.of(driver)
    at = contact(first, second, gears.distance, forward)
    # a ring's axle is on the other side of its pinion, and both pitch circles turn the same way
    a = gears.distance * (-1 if second.ring else 1)
    R1 = a * at.speed / (at.speed + (-1 if first.ring or second.ring else 1))
    along = (at.radius1**2 - at.radius2**2 + a * a) / (2 * a)
    # on the line of centres rounding may make the square negative
    side = np.sqrt(np.maximum(at.radius1**2 - along**2, 0.0))
    # the leading flank of a tooth is within half a pitch ahead of its middle
    middle = forward + (at.pair + 0.25) * first.pitch
    ahead = np.abs(np.arctan2(side, along) - middle) < np.abs(np.arctan2(-side, along) - middle)
    off = along - R1
    # closer to the pitch point the root above is rounding error and does not determine a normal
    apart = np.hypot(side, off) >= _NEAR_PITCH_POINT * gears.distance
    # position of the contact relative to the instantaneous pitch point, at the distances R1 and R2 from the axles
    x, y, R2 = np.where(apart, np.where(ahead, side, -side), 0.0), np.where(apart, off, 0.0), a - R1
    d, way = np.hypot(x, y), np.where(x < 0, -1.0, 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        # at the pitch point itself (0/0) the flanks do not slide, and any normal is valid
        sine, cosine = np.where(d > 0, way * y / d, 0.0), np.where(d > 0, np.abs(x) / d, 1.0)
        rub = way * np.sign(1 / R1 + 1 / R2)  # a driving ring is slower than its pinion, so sliding is reversed
        return cosine, rub * (sine + way * d / R1), rub * (sine - way * d / R2)


# The contact of two outlines is expensive and does not depend on friction or direction, so it is cached.


@lru_cache(maxsize=64)
def _tabulated(gears: OutlineGears, driver: int) -> PiecewiseTransmission:
    return tabulate(*gears.of(driver), gears.distance)


@lru_cache(maxsize=64)
def _backlashes(gears: OutlineGears, driver: int) -> Floats:
    """Return the backlash [rad of the driven wheel] at equal steps of driver angle; NaN without contact."""
    first, second = gears.of(driver)
    S = np.linspace(0, 2 * pi / first.z, _SAMPLES, endpoint=False)
    return solve(first, second, gears.distance, S).backlash
