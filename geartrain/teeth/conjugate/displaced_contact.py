"""Contact of conjugate teeth with displaced flanks.

A flank that protrudes by n along its normal at the contact turns the driven wheel ahead by n divided by the moment arm
of the normal, docs/cut-by-hand.md (1). The normal passes through the pitch point under the pressure angle psi, so the
arm is R2 cos psi on cylinders and sin R2 cos psi on cones; for an involute it is the base radius. Beyond the ends of
the path the corner of a tip still touches the mate's flank. The driven wheel then lags by an angle that follows from
the law of cosines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from math import cos, inf, pi, radians
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_NODES = 257  # of the tables along the path and beyond its ends, with linear interpolation
_SMALL = 1e-12  # rad: shorter contact beyond an end is neglected
_END_STEP = 1e-4  # fraction of the arc of contact: step of the difference quotient of the tip's radius
_BLUNT = radians(10)  # lower bound of the half aperture, by which errors are divided; it is 0 for parallel sides


Value = TypeVar("Value")


def azimuth_at(pitch: PitchSurfaces, gear: int, own: float, other: Floats) -> Floats:
    """Return the azimuths [rad, 0 or more] of points from their distances `own` from a gear's axle and `other` from the
    mate's axle.

    The azimuth is measured at the axle of `gear` from the line of centres, and computed by the plane or spherical law
    of cosines. The azimuth is NaN if no such point exists. The axle of a ring gear's mate is on the opposite side.
    """
    D = pitch.R1 + pitch.R2
    if gear == 2:
        D = abs(D)
    if pitch.bevel:
        cosine = (np.cos(other) - np.cos(own) * np.cos(D)) / (np.sin(own) * np.sin(D))
    else:
        cosine = (own * own + D * D - other * other) / (2 * own * D)
    with np.errstate(invalid="ignore"):
        found: Floats = np.arccos(cosine)
    return found


def corner_contact(path: PathOfContact, gear: int, radius: Floats, azimuth: Floats) -> tuple[Floats, Floats]:
    """Return the arcs X on the pitch surfaces by which the gears have rotated when the tip of `gear` touches points of
    the mate's flank, which have the given `radius` and `azimuth` [rad] about the mate's axle.

    The azimuth is valid for the position of the mate at X = 0. The tip of gear 1 touches beyond the recess; the tip of
    gear 2 touches before the approach.
    """
    pitch, mate = path.pitch, 3 - gear
    _, tip = path.ends(gear)
    tip_radius, tip_azimuth = (float(each) for each in pitch.polar(gear, path.flank(gear, tip)))
    turned = azimuth_at(pitch, gear, tip_radius, radius) * (1.0 if gear == 1 else -1.0)
    _, there = pitch.polar(mate, pitch.from_polar(gear, tip_radius, turned))
    own, other = pitch.reach_of(gear) * (turned - tip_azimuth), pitch.reach_of(mate) * (there - azimuth)
    return (own, other) if gear == 1 else (other, own)


def _touched_flank(pair: ConjugatePair, gear: int) -> tuple[Floats, Floats]:
    """Return radii and azimuths [rad] of the mate's flank that the tip of `gear` touches beyond the path of contact."""
    path, pitch, mate = pair.path, pair.path.pitch, 3 - gear
    last, first = path.ends(gear)
    # quadratic spacing, as the corner leaves the path along a parabola
    part = np.linspace(0, 1, _NODES) ** 2
    if pair.solid[mate - 1]:
        return pitch.polar(mate, path.flank(mate, first + (last - first) * part))
    # a round pin extends beyond its flank to its outermost point
    radius, azimuth = (float(each) for each in pitch.polar(mate, path.flank(mate, first)))
    reach = pitch.reach_of(mate)
    middle = reach * np.exp(1j * pair.halves[mate - 1] / reach * (-1 if mate == 1 else 1))
    out = middle / abs(middle)
    from_middle = (radius * np.exp(1j * azimuth) - middle) / out
    around = np.angle(from_middle) * (1 - part)
    points = middle + out * abs(from_middle) * np.exp(1j * around)
    return np.abs(points), np.angle(points)


def flank_levers(path: PathOfContact, gear: int, X: Floats) -> Floats:
    """Return the displacement of a flank, along its normal at the contacts X, per radian of rotation of the flank about
    its pitch point.

    The rotation is anticlockwise in a view with X to the right and gear 2 above. For a contact P, the pitch point P0 of
    the flank, the unit normal n and the unit vector z out of the plane, the displacement is z . ((P - P0) x n), or P0 .
    (P x n) on the sphere.
    """
    pitch, at = path.pitch, path.at(X)
    middle = np.zeros((len(X), 3 if pitch.bevel else 2))
    if pitch.bevel:
        middle[:, 2] = 1.0
    P0 = pitch.on_gear(gear, middle, -X)
    # P is on the normal (bevel: P x n is the pole of its great circle), so the values at the pitch point apply
    return np.asarray(P0[:, 1] * at.cos_psi - P0[:, 0] * at.sin_psi)


@dataclass(frozen=True)
class CornerLag:
    """Lag of the driven wheel [rad] while the corner of a tip is in contact beyond an end of the path of contact."""

    step: float
    """Increment of the driver's angle between tabulated lags [rad]."""
    lags: Floats
    """Lags of the driven wheel [rad] at equal steps of the driver's angle, beginning with 0 at the end of the path."""

    def __call__(self, beyond: Floats) -> Floats:
        """Return the lag of the driven wheel [rad] at driver angles `beyond` the end of the path of contact [rad]; 0
        for negative angles, infinite where the corner no longer touches.
        """
        return np.interp(beyond, self.step * np.arange(len(self.lags)), self.lags, left=0.0, right=inf)

    @property
    def most(self) -> float:
        """Driver angle between the end of the path of contact and the last contact of the corner [rad]."""
        return self.step * (len(self.lags) - 1)


@dataclass(frozen=True)
class DisplacedWheelSizes:
    """Sizes of a wheel with which manufacturing errors are converted to displacements of its flanks."""

    z: int
    """Number of teeth."""
    depth: float
    """Radial extent of the active flank [module; rad for bevel gears]."""
    half_angle: float
    """Angle [rad] between the chord of the active flank and the centre line of the tooth, at least 10 degrees."""
    modules: float = 1.0
    """Number of modules in the unit in which the sizes of the wheel are given; 1 if the sizes are in modules."""

    @property
    def pitch(self) -> float:
        """Circular pitch of the wheel, in the unit in which the sizes of the wheel are given."""
        return pi / self.modules


@dataclass(frozen=True, eq=False)
class DisplacedContact:
    """Contact of one tooth pair throughout its engagement, and the lag of the driven wheel caused by displaced flanks.

    Lengths are in modules; on cones they are angles on the unit sphere. Each array contains lags of the driven wheel
    [rad] for a unit displacement, at equally spaced driver angles from `start` to `end` [rad]. In a pair of arrays, the
    first is for displacements of the driver, and the second for displacements of the driven wheel.
    """

    wheels: tuple[DisplacedWheelSizes, DisplacedWheelSizes]
    """Sizes of the driver and of the driven wheel."""
    start: float
    """Driver angle at which a tooth pair comes into contact [rad]."""
    end: float
    """Driver angle at which a tooth pair leaves contact [rad]."""
    across: tuple[Floats, Floats]
    """Lag [rad] per unit displacement of the teeth perpendicular to the line of centres, in the direction of motion."""
    along: tuple[Floats, Floats]
    """Lag [rad] per unit displacement of the teeth along the line of centres, away from the axle of their wheel."""
    tilt: tuple[Floats, Floats]
    """Lag [rad] per radian of rotation of a flank about its pitch point in the sense that makes the flank flatter."""
    apart: Floats
    """Lag [rad] per unit increase of the centre distance or shaft angle."""
    normal: Floats
    """Lag [rad] per unit of material removed along the normal of a flank: 1 divided by the arm of the normal."""
    entering: CornerLag
    """Lag [rad] while the corner of a tip is in contact before the start of the path of contact."""
    leaving: CornerLag
    """Lag [rad] while the corner of a tip is in contact beyond the end of the path of contact."""
    longer: tuple[float, float]
    """Shift of the end of contact per unit increase of the driver's tip radius, and shift of the start of contact per
    unit increase of the driven wheel's tip radius [rad of the driver].
    """
    backlash: float
    """Backlash, as an angle of the driven wheel [rad]."""
    tooth_phase: float
    """Angle by which a tooth of the driven wheel is past the line of centres when the driven angle is 0 [rad]."""
    even: Floats
    """Lag of the driven wheel [rad] for wheels without manufacturing errors, at the driver angles of the columns. The
    cause is a centre distance other than the design distance.
    """
    distance: float
    """Centre distance [module]; infinite if the axes are not parallel."""

    @property
    def ratio(self) -> Fraction:
        """Mean speed ratio: driven speed divided by driver speed."""
        return Fraction(self.wheels[0].z, self.wheels[1].z)

    @property
    def pitches(self) -> tuple[float, float]:
        """Angular pitches of the driver and of the driven wheel [rad]."""
        return 2 * pi / self.wheels[0].z, 2 * pi / self.wheels[1].z

    def apart_by(self, shift: float) -> DisplacedContact:
        """Return the contact of the same teeth if the centre distance is increased by `shift` [module]."""
        return replace(self, even=self.even + shift * self.apart, distance=self.distance + shift)


@lru_cache(maxsize=256)
def displaced_contact(pair: ConjugatePair, driver: int, gap: float = 0.0) -> DisplacedContact:
    """Return the contact of a conjugate pair that is driven by gear `driver`, at a centre distance that exceeds the
    design distance by `gap` [module].
    """
    path, pitch, gears = pair.path, pair.path.pitch, (driver, 3 - driver)
    if sum(path.arcs) <= 0:
        what, why = "these teeth do not reach each other", "their arcs of approach and recess sum to 0 or less"
        raise RangeError(Problem(what, why, "use longer arcs"))
    # with gear 2 driving, the same contacts occur in reverse order
    sense = 1.0 if driver == 1 else -1.0
    first, last = path.ends(driver)
    X = np.linspace(first, last, _NODES)
    at = path.at(X)
    own, other = (pitch.reach_of(gear) for gear in gears)
    normal = 1 / (other * at.cos_psi)
    tangent, radial = normal * at.cos_psi, normal * at.sin_psi
    # direction from the axle of a gear to the pitch point; for a ring that of the other wheel
    ring = not pitch.bevel and pitch.R2 < 0
    up = {1: sense, 2: sense if ring else -sense}
    # cones: a displaced axis moves the teeth across by the cosine of the pitch cone, docs/cut-by-hand.md (3)
    lean = {1: cos(pitch.R1), 2: cos(pitch.R2)} if pitch.bevel else {1: 1.0, 2: 1.0}
    half_tooth = pair.halves[driver - 1]
    found = DisplacedContact(
        wheels=_for_both(gears, lambda gear: _sizes(pair, gear)),
        start=(sense * first - half_tooth) / own,
        end=(sense * last - half_tooth) / own,
        across=_for_both(gears, lambda gear: tangent * lean[gear]),
        along=_for_both(gears, lambda gear: radial * up[gear]),
        tilt=_for_both(gears, lambda gear: sense * normal * flank_levers(path, gear, X)),
        # with a ring, a larger centre distance brings the teeth together
        apart=-radial if ring else radial,
        normal=normal,
        entering=_corner_lag(pair, 3 - driver, driver),
        leaving=_corner_lag(pair, driver, driver),
        longer=_for_both(gears, lambda gear: _end_shift(path, gear) / own),
        backlash=pair.backlash / other,
        tooth_phase=sum(pair.halves) / other,
        even=np.zeros(_NODES),
        distance=inf if pitch.bevel else abs(pitch.R1 + pitch.R2),
    )
    return found.apart_by(gap) if gap else found


def _for_both(gears: tuple[int, int], value: Callable[[int], Value]) -> tuple[Value, Value]:
    return value(gears[0]), value(gears[1])


def _corner_lag(pair: ConjugatePair, gear: int, driver: int) -> CornerLag:
    """Return the lag of the driven wheel while the tip of `gear` is in contact beyond an end of the path of contact:
    the driver's tip while teeth leave contact, or the driven tip while they enter it.
    """
    path, pitch = pair.path, pair.path.pitch
    _, first = path.ends(gear)
    turned = corner_contact(path, gear, *_touched_flank(pair, gear))
    lag = (turned[0] - turned[1]) / pitch.reach_of(3 - driver)
    beyond = (turned[driver - 1] - first) / pitch.reach_of(driver) * (1.0 if gear == 1 else -1.0)
    good = np.isfinite(beyond) & np.isfinite(lag) & (beyond >= 0)
    beyond, lag = np.append(0.0, beyond[good]), np.append(0.0, lag[good])
    # up to the first reversal of the corner, where it has left the flank
    rising = np.flatnonzero(np.diff(beyond) < 0)
    stop = int(rising[0]) + 1 if len(rising) else len(beyond)
    beyond, lag = beyond[:stop], np.maximum.accumulate(lag[:stop])
    most = max(float(beyond[-1]), _SMALL)
    even = np.linspace(0.0, most, _NODES)
    return CornerLag(most / (_NODES - 1), np.interp(even, beyond, lag))


def _end_shift(path: PathOfContact, gear: int) -> float:
    """Return the increase of the arc of contact on the pitch surfaces per unit increase of the tip radius of `gear`."""
    # a one-sided difference, because the path is undefined beyond the tip
    foot, tip = path.ends(gear)
    step = _END_STEP * (foot - tip)
    radius, _ = path.pitch.polar(gear, path.flank(gear, np.array([tip, tip + step])))
    rise = abs(float(radius[0] - radius[1]))
    return abs(step) / rise if rise else 0.0


def _sizes(pair: ConjugatePair, gear: int) -> DisplacedWheelSizes:
    path, pitch = pair.path, pair.path.pitch
    radius, azimuth = pitch.polar(gear, path.flank(gear, np.array(path.ends(gear))))
    reach = pitch.reach_of(gear)
    half = pair.halves[gear - 1] / reach
    width = (np.sin(radius) if pitch.bevel else radius) * ((azimuth if gear == 1 else -azimuth) + half)
    depth = abs(float(radius[1] - radius[0]))
    lean = float(np.arctan2(width[0] - width[1], depth))
    z = int(pitch.teeth_of(gear))
    return DisplacedWheelSizes(z, depth, max(lean, _BLUNT), z / (2 * reach))
