"""Conjugate teeth at a centre distance they were not made for: their law, from the contact of their outlines.

The flanks are those of the design, each continued straight beneath its last designed contact; tips end where the design
ends them. Only spur teeth have a centre distance.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import pairwise
from math import inf, nan, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.conjugate.admissibility import ToothFault
from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair, ConjugateVerdict
from geartrain.teeth.contact.outline_contact import contact, solve
from geartrain.teeth.contact.outline_curves import GearOutline, OutlineCurve, ToothFlanks
from geartrain.teeth.contact.transmission_fit import tabulate
from geartrain.teeth.transmission import TransmissionFunction, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.contact.piecewise_transmission import PiecewiseTransmission

_GAUSS = np.polynomial.legendre.leggauss(16)
_SAMPLES = 256  # angles of a pitch at which play is looked for
_STRAIGHT = 0.5  # modules of root beneath a flank, and not beyond a third of the way to the axle


class OffDesignTransmission(TransmissionFunction):
    """The law of a pair whose axles are `distance` modules apart; arguments and angles as in `ConjugateLaw`."""

    def __init__(
        self, pair: ConjugatePair, distance: float, friction: float = 0.0, driver: int = 1, direction: int = 1
    ) -> None:
        self.pair, self.path, self.distance = pair, pair.path, distance
        self.friction, self.driver, self.direction = check_friction(friction), driver, direction
        pitch = pair.path.pitch
        z1, z2 = (pitch.z1, pitch.z2) if driver == 1 else (pitch.z2, pitch.z1)
        self.ratio, self.period = Fraction(z1, z2), 2 * pi / z1
        driven = abs(pitch.reach2) if driver == 1 else pitch.reach
        self._offset, self._play = sum(pair.halves) / driven, pair.play / driven

    @property
    def _wheels(self) -> tuple[GearOutline, GearOutline]:
        first, second = outlines(self.pair)
        return (first, second) if self.driver == 1 else (second, first)

    @cached_property
    def table(self) -> PiecewiseTransmission:
        """The driven angle as polynomials, front flanks driving."""
        return _tabulated(self.pair, self.distance, self.driver)

    @property
    def reversed(self) -> OffDesignTransmission:
        """The law with the other wheel driving."""
        return OffDesignTransmission(self.pair, self.distance, self.friction, 3 - self.driver, self.direction)

    def turned_back(self) -> OffDesignTransmission:
        """The law of the other flanks; angles keep their sense and decrease."""
        return OffDesignTransmission(self.pair, self.distance, self.friction, self.driver, -self.direction)

    @cached_property
    def verdict(self) -> ConjugateVerdict:
        """Whether the pair can turn: what is wrong with its teeth, or the play they lack at this distance."""
        S = np.linspace(0, self.period, _SAMPLES, endpoint=False)
        plays = solve(*self._wheels, self.distance, S).play
        play = float(np.nanmin(plays, initial=inf))
        found = self.pair.faults if play >= -1e-12 else (*self.pair.faults, _jam(self.distance, play))
        if not np.isfinite(plays).all():
            found = (*found, _apart(self.distance, float(np.mean(~np.isfinite(plays)))))
        text = "; ".join(fault.what for fault in found) or "the teeth run"
        return ConjugateVerdict(found[0].kind if found else "runs", text, play, found)

    # ---------------------------------------------------------------------------------------------------- kinematics

    def _forward(self, S: ArrayLike) -> Floats:
        return self.direction * np.asarray(S, dtype=float)

    def _of(self, error: Floats | float) -> Floats:
        """Errors of the front flanks as those of this direction: turned back, the law is the mirror image."""
        ahead = np.asarray(error) - self._offset
        return ahead if self.direction > 0 else self._play - ahead

    def error(self, S: ArrayLike) -> Floats:
        """Transmission error (rad of the driven wheel) at driver angles S (rad); NaN where none touches."""
        return self._of(self.table.error(self._forward(S)))

    def speed(self, S: ArrayLike) -> Floats:
        """Speed ratio at driver angles S (rad)."""
        return self.table.speed(self._forward(S))

    def corners(self) -> list[float]:
        """Driver angles (rad) where something else begins to touch."""
        return [self.direction * float(at) for at in self.table.corners]

    def error_range(self) -> tuple[float, float]:
        """Least and greatest transmission error (rad of the driven wheel)."""
        low, high = sorted(float(self._of(each)) for each in self.table.extremes())
        return low, high

    @cached_property
    def _nodes(self) -> tuple[Floats, Floats]:
        """Driver angles and weights of a whole period, the front flanks driving."""
        x, w = _GAUSS
        edges = list(pairwise(self.table.breaks.tolist()))
        S = np.concatenate([(low + high) / 2 + (high - low) / 2 * x for low, high in edges])
        return S, np.concatenate([(high - low) / 2 * w for low, high in edges]) / self.table.period

    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio, among sixteen angles of each smooth stretch and its ends."""
        ends = self.table.breaks
        found = self.table.speed(np.concatenate([self._nodes[0], ends + 1e-12, ends - 1e-12]))
        return float(np.nanmin(found)), float(np.nanmax(found))

    def error_moments(self) -> tuple[float, float]:
        """Mean and rms of the transmission error (rad of the driven wheel)."""
        S, weights = self._nodes
        error = self._of(self.table.error(S))
        mean = float(weights @ error)
        return mean, float(weights @ (error - mean) ** 2) ** 0.5

    # ------------------------------------------------------------------------------------------------------- friction

    def efficiency(self, S: ArrayLike) -> Floats:
        """Power out over power in at driver angles S (rad); NaN where nothing touches or friction locks.

        The common normal passes through the point that parts the distance as the speeds do at that instant; with that
        point for the pitch point the contact obeys the same formulas as one of the design.
        """
        cosine, into, out = self._leans(self._forward(S))
        with np.errstate(divide="ignore", invalid="ignore"):
            into, out = cosine + self.friction * into, cosine + self.friction * out
            found: Floats = np.where(out > 0, out / into, nan)
        return found

    def _leans(self, forward: Floats) -> tuple[Floats, Floats, Floats]:
        """cos psi, and what a unit of friction adds to it in the power that enters and in that which leaves."""
        first, second = self._wheels
        at = contact(first, second, self.distance, forward)
        # a ring's axle is on its pinion's other side, and its pitch circle turns the same way
        a = self.distance * (-1 if second.ring else 1)
        R1 = a * at.speed / (at.speed + (-1 if first.ring or second.ring else 1))
        along = (at.radius1**2 - at.radius2**2 + a * a) / (2 * a)
        side = np.sqrt(np.maximum(at.radius1**2 - along**2, 0.0))
        # the side ahead of a tooth lies within half a pitch ahead of its middle
        middle = forward + (at.pair + 0.25) * first.pitch
        ahead = np.abs(np.arctan2(side, along) - middle) < np.abs(np.arctan2(-side, along) - middle)
        return _friction(np.where(ahead, side, -side), along - R1, R1, a - R1)

    @cached_property
    def locking_friction(self) -> float:
        """The least friction at which some contact locks, among those at the nodes; infinite where none does."""
        cosine, _, out = self._leans(self._nodes[0])
        steepest = float(np.nanmax(-out / cosine))
        return 1 / steepest if steepest > 0 else inf

    @cached_property
    def _sampled(self) -> tuple[Floats, Floats, Floats]:
        """Efficiency, speed and weights at the nodes where teeth touch."""
        S, weights = self._nodes
        speed = self.table.speed(S)
        touching = ~np.isnan(speed)
        found = self.efficiency(self.direction * S[touching])
        return found, speed[touching], weights[touching] / weights[touching].sum()

    def efficiency_mean(self) -> float:
        """Mean over the driver's angle in contact at constant driver torque; NaN where friction locks."""
        found, _, weights = self._sampled
        return float(weights @ found)

    def efficiency_at_constant_load(self) -> float:
        """Work done on a constant load torque over the work put in, per pitch; NaN where friction locks."""
        found, speed, weights = self._sampled
        return float((weights @ speed) / (weights @ (speed / found)))

    def efficiency_least(self) -> float:
        """Least efficiency among the nodes of all stretches; NaN where friction locks."""
        return float(self._sampled[0].min())


def _friction(x: Floats, y: Floats, R1: Floats, R2: Floats) -> tuple[Floats, Floats, Floats]:
    """`_leans` of a contact at (x, y) from the instantaneous pitch point, R1 and R2 its distances from the axles."""
    d = np.hypot(x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        way = np.where(x < 0, -1.0, 1.0)
        sine, cosine = np.where(d > 0, way * y / d, 0.0), np.where(d > 0, np.abs(x) / d, 1.0)
        rub = way * np.sign(1 / R1 + 1 / R2)  # a ring that drives is slower than its pinion: it slides the other way
        return cosine, rub * (sine + way * d / R1), rub * (sine - way * d / R2)


@lru_cache(maxsize=64)
def _tabulated(pair: ConjugatePair, distance: float, driver: int) -> PiecewiseTransmission:
    wheels = outlines(pair)
    return tabulate(*(wheels if driver == 1 else wheels[::-1]), distance)


@lru_cache(maxsize=64)
def outlines(pair: ConjugatePair) -> tuple[GearOutline, GearOutline]:
    """Both wheels of a spur pair, in modules."""
    pitch = pair.path.pitch
    return _outline(pair, 1, pitch.z1, pitch.R1), _outline(pair, 2, pitch.z2, pitch.R2)


def _outline(pair: ConjugatePair, gear: int, z: int, R: float) -> GearOutline:
    """One wheel: the side that its driver, or its driven wheel, touches, and its mirror image."""
    half = pair.halves[gear - 1] / abs(R)
    turn = np.exp(-1j * half)

    def flank(X: Floats) -> Floats:
        points = _body(pair.path, gear, X)
        place = (points[:, 0] + 1j * points[:, 1]) * turn
        return np.stack([place.real, place.imag], axis=1)

    approach, recess = pair.path.arcs
    foot, tip = (-approach, recess) if gear == 1 else (recess, -approach)
    cuts = sorted({0.0, foot, tip, *_joints(pair.path)}, reverse=foot > tip)
    curves = [OutlineCurve(flank, a, b) for a, b in pairwise(cuts)]
    return GearOutline((ToothFlanks.symmetric((_straight(flank, foot, tip), *curves)),), z, ring=R < 0)


def _body(path: PathOfContact, gear: int, X: Floats) -> Floats:
    """Points of a flank from the wheel's axle: x towards the space that the tooth leads into, y outwards."""
    points = (path.flank1 if gear == 1 else path.flank2)(X)
    if gear == 1:
        return np.asarray(points + np.array([0.0, path.pitch.R1]))
    R = path.pitch.R2
    return np.stack([-points[:, 0], abs(R) - points[:, 1] * np.sign(R)], axis=1)


def _joints(path: PathOfContact) -> list[float]:
    """X at the ends of the pieces of a path."""
    ends = ((-1.0, path.approach), (1.0, path.recess))
    return [sign * float(side.travel(np.array(d))) for sign, side in ends for d in side.joints]


def _straight(flank: object, foot: float, tip: float) -> OutlineCurve:
    """The root: straight on from the foot of a flank."""
    assert callable(flank)
    start, near = flank(np.array([foot, foot + 1e-4 * (tip - foot)]))
    way = start - near
    length = min(_STRAIGHT, float(np.hypot(*start)) / 3)
    end = start + way / np.hypot(*way) * length
    return OutlineCurve(lambda t: end + t[:, None] * (start - end))


def _apart(distance: float, share: float) -> ToothFault:
    return ToothFault(
        "contact ratio",
        0,
        nan,
        "the teeth do not reach each other",
        f"at a centre distance of {distance:.6g} modules nothing touches during {share:.1%} of a pitch",
        "move the axles together, or take longer arcs",
    )


def _jam(distance: float, play: float) -> ToothFault:
    return ToothFault(
        "jam",
        0,
        nan,
        "the teeth jam",
        f"at a centre distance of {distance:.6g} modules they lack {-play:.4g} rad of the driven wheel's angle",
        "move the axles apart, or thin the teeth with `backlash`",
    )
