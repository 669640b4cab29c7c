"""Transmission function of triangular teeth over driver angles, and a table of their contact over one pitch."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from itertools import pairwise
from math import inf, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.arrays import blocks, remainder
from geartrain.numerics.results import Key, Result, finite
from geartrain.numerics.roots import bracketed_root
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing, SpeedLeap, check_friction
from geartrain.teeth.triangular.clearance_window import TriangularContact
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DriveInterval, SpeedJump, matches
from geartrain.teeth.triangular.tooth_pair import APPROACH

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.friction_law import PairFriction
    from geartrain.teeth.pair_results import PairVerdict

_USUAL = 5  # rows for each interval of the real path


@lru_cache(maxsize=4096)
def _contact(sizes: TriangularSizes) -> TriangularContact:
    """Return the contact of a pair. The result is cached, so that equal pairs of a long train share it."""
    return TriangularContact(sizes)


class TriangularTransmission(ToothTransmission):
    """Transmission function of a pair of wheels with triangular teeth.

    The function includes the dwells of the driven wheel, if any. If the pair jams or clashes, the function describes
    only the contact of the drive flanks.

    Parameters
    ----------
    sizes : TriangularSizes
        Pair with the first wheel driving.
    friction : float
        Coefficient of friction, 0 or more.
    direction : {1, -1}
        Direction of rotation. With -1, angles S and q keep their sign convention and decrease, and the coast flanks are
        in contact.

    See Also
    --------
    geartrain.teeth.Triangular : Its method `transmission` returns the function of a declared pair.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.teeth.triangular import TriangularSizes, equal_depth
    >>> radii = equal_depth(48, 96, pi / 6, pi / 6)
    >>> transmission = TriangularTransmission(TriangularSizes(48, 96, *radii, pi / 6, pi / 6, 0.01), 0.2)
    >>> transmission.verdict.kind, transmission.ratio, [round(jump.value, 4) for jump in transmission.jumps]
    ('runs', Fraction(1, 2), [0.1582])
    """

    driver = 1

    def __init__(self, sizes: TriangularSizes, friction: float = 0.0, direction: int = 1) -> None:
        self.sizes, self.friction, self.direction = sizes, check_friction(friction), direction
        self.ratio, self.period = Fraction(sizes.z1, sizes.z2), sizes.p1
        self.contact = _contact(sizes)

    @property
    def intervals(self) -> tuple[DriveInterval, ...]:
        """Intervals over one pitch, in order of time, in which one tooth pair drives, or none (dwell)."""
        return self.contact.intervals

    @property
    def verdict(self) -> PairVerdict:
        """Verdict on whether the pair can run."""
        return self.contact.verdict

    # ----------------------------------------------------------------------------------------------- values at samples

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven wheel] at driver angles S [rad]."""
        lag = self.mapped(S, self._lag)
        return -lag if self.direction > 0 else self.sizes.p2 + lag

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio tau of the driven wheel to the driver at driver angles S [rad]."""
        return self.mapped(S, self._tau)

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speed of the contact at driver angles S [rad], and the changes of its power per unit
        friction coefficient; NaN during a dwell.
        """
        return ContactRubbing(*(each[None] for each in self._map_all(S, self._friction_terms, 3)))

    def sliding(self, phase: str, x: Floats) -> Floats:
        """Return the sliding speed at given contacts, divided by the pitch-line speed.

        Parameters
        ----------
        phase : {"approach", "recess"}
            Phase of the tooth pair in contact.
        x : ndarray
            Angles alpha_1 of the tooth pair [rad].
        """
        sizes = self.sizes
        found: Floats = self.contact.path.tooth_pair.sliding(phase, x, np) * sizes.pitch_sum / (sizes.D * sizes.z1)
        return found

    def coefficient(self, phase: str, x: Floats, by: PairFriction | None) -> float | Floats:
        """Return the coefficient of friction at given contacts.

        Parameters
        ----------
        phase, x
            Same as in `sliding`.
        by : PairFriction or None
            Coefficient of friction as a function of sliding speed. If None, the constant coefficient of this
            transmission function is returned.
        """
        return self.friction if by is None else by(self.sliding(phase, x))

    def _friction_terms(self, interval: DriveInterval, x: Floats) -> tuple[Any, Any, Any]:
        """Return three quantities at driver apex angles x [rad] of an interval: the sliding speed divided by the pitch-
        line speed, the friction term of the input power, and the friction term of the output power.
        """
        if interval.held is not None:
            return nan, nan, nan
        side, tan2, tan1 = self.contact.path.tooth_pair.friction(interval.phase, x, np)
        return self.sliding(interval.phase, x), -side * tan1, -side * tan2

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return the transmission error [rad of the driven wheel] and the speed ratio tau at driver angles S [rad].
        Both are obtained from one search of the path of contact.
        """
        lag, tau = self._map_all(S, self._lag_and_tau, 2)
        return (-lag if self.direction > 0 else self.sizes.p2 + lag), tau

    def _driven(self, driver: int, direction: int) -> TriangularTransmission:
        return TriangularTransmission(
            self.sizes if driver == self.driver else self.sizes.swapped(), self.friction, direction
        )

    def alpha1(self, S: ArrayLike) -> Floats:
        """Return the angle alpha_1 [rad] between the apex of the driving tooth and the line of centres at driver angles
        S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.
        """
        return self.mapped(S, lambda interval, x: x)

    def mapped(self, S: ArrayLike, what: Callable[[DriveInterval, Floats], Any]) -> Floats:
        """Return the values of a function of the contact at driver angles S.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.
        what : callable
            Function of a drive interval and of angles alpha_1 in it [rad].
        """
        return self._map_all(S, lambda interval, x: (what(interval, x),), 1)[0]

    def _map_all(
        self, S: ArrayLike, what: Callable[[DriveInterval, Floats], tuple[Any, ...]], count: int
    ) -> list[Floats]:
        """Return at each driver angle in S the `count` values that `what` computes from an interval and alpha_1."""
        S, edges = np.asarray(S, dtype=float), self._edges
        flat = S.ravel()
        found = [np.empty_like(flat) for _ in range(count)]
        for block in blocks(len(flat)):
            gone = remainder(self.direction * flat[block], self.period) + self._start
            # both terms are within one period, so one subtraction is sufficient
            gone -= np.where(gone < self.period, 0.0, self.period)
            which = np.searchsorted(edges[1:-1], gone, side="right")
            for at, interval in enumerate(self.intervals):
                chosen = np.flatnonzero(which == at) if len(self.intervals) > 1 else slice(None)
                x = interval.start - (gone[chosen] - edges[at])
                for each, value in zip(found, what(interval, x), strict=True):
                    each[block][chosen] = value
        return [each.reshape(S.shape) for each in found]

    @cached_property
    def _drive_intervals(self) -> tuple[DriveInterval, ...]:
        """The `intervals` of the driving tooth pairs and dwells. Raises `RangeError` if the teeth never touch."""
        if not self.intervals:
            fix = "give a clearance within the clearance window of the pair, and teeth that meet in valleys"
            raise RangeError(Problem(self.verdict.text, "such teeth have no transmission function", fix))
        return self.intervals

    @cached_property
    def _start(self) -> float:
        """Angle [rad] of the driver's tooth from the line of centres at the start of `intervals`, modulo one pitch."""
        first = self._drive_intervals[0]
        return (first.start - first.tooth_pair * self.period) % self.period

    @cached_property
    def _edges(self) -> Floats:
        """Driver angles [rad] at the ends of all `intervals`, measured from the start of the first interval."""
        return np.concatenate(([0.0], np.cumsum([interval.width for interval in self._drive_intervals])))

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] at the ends of all smooth intervals of the path of contact."""
        edges = dict(zip(self.intervals, self._edges.tolist(), strict=False))
        angles = [edges[interval] + interval.start - high - self._start for interval, high, _ in self.stretches]
        return [self.direction * angle for angle in angles]

    def _lag(self, interval: DriveInterval, x: Any) -> Any:
        return self.contact.lag(interval, x, np)

    def _tau(self, interval: DriveInterval, x: Any) -> Any:
        return self.contact.speed(interval, x, np)

    def _lag_and_tau(self, interval: DriveInterval, x: Any) -> tuple[Any, Any]:
        if interval.held is not None:
            return self._lag(interval, x), 0.0
        alpha2, tau = self.contact.path.tooth_pair.angle_and_speed(interval.phase, x, np)
        return alpha2 - self.sizes.ratio * x, tau

    # ----------------------------------------------------------------------------------------- values over the pitch

    @cached_property
    def stretches(self) -> list[tuple[DriveInterval, float, float]]:
        """Smooth parts of `intervals`, each as (interval, alpha_1 at its start, alpha_1 at its end). They are divided
        at kinks, at extrema of the speed ratio and at the line of centres.
        """
        return [
            (interval, high, low)
            for interval in self._drive_intervals
            for high, low in pairwise(sorted({interval.start, interval.end, *self._kinks(interval)}, reverse=True))
        ]

    def _kinks(self, interval: DriveInterval) -> Iterator[float]:
        if interval.held is not None:
            return
        low, high = interval.end, interval.start
        yield from (piece.low for piece in self.contact.path.pieces if low < piece.low < high)
        centre = self._line_of_centres(interval.phase)
        if low < centre < high:
            yield centre

    def _line_of_centres(self, phase: str) -> float:
        """Return the angle [rad] of the driver's apex from the line of centres at which the contact itself is on the
        line of centres. There the direction of sliding reverses.
        """
        if phase != APPROACH:
            return 0.0
        tooth_pair = self.contact.path.tooth_pair
        low, high = max(self.sizes.matching, -self.sizes.reach1), self.sizes.reach1
        angle = partial(tooth_pair.angle, APPROACH)
        return bracketed_root(angle, low, high) if angle(low) < 0 < angle(high) else inf

    def _end_values(self, what: Callable[[DriveInterval, Any], Any]) -> list[float]:
        return [float(what(interval, x)) for interval, high, low in self.stretches for x in (high, low)]

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum of the speed ratio tau, which is monotonic in each smooth interval."""
        ends = self._end_values(self._tau)
        return min(ends), max(ends)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad of the driven wheel]."""
        lags = self._end_values(self._lag)
        for interval, high, low in self.stretches:
            if interval.held is None:
                lags += self.contact.path.extremes(interval.phase, low, high)
        if self.direction > 0:
            return -max(lags), -min(lags)
        return self.sizes.p2 + min(lags), self.sizes.p2 + max(lags)

    def _samples(self) -> Iterator[tuple[str, Floats]]:
        """Yield phase and 101 angles alpha_1 [rad] of the driver's apex of each smooth interval of driving teeth."""
        for interval, high, low in self.stretches:
            if interval.held is None:
                yield interval.phase, np.linspace(high, low, 101)

    @cached_property
    def locking_friction(self) -> float:
        """Minimum friction coefficient at which the pair locks at some point of the real path of contact; infinite if
        the pair never locks.

        Before the line of centres, the pair locks where f tan1 = 1, where f is the friction coefficient and tan1 is
        defined in `ToothPair.friction`.
        """
        steepest = 0.0
        for phase, x in self._samples():
            side, tan2, tan1 = self.contact.path.tooth_pair.friction(phase, x, np)
            # the middle sample of 101 gives the side, because stretches end at the line of centres
            if side[50] > 0:
                steepest = max(steepest, float(np.maximum(tan2, tan1).max()))
        return 1 / steepest if steepest else inf

    def steepest_fall(self) -> float:
        """Return the maximum rate at which the speed ratio decreases [1/rad], computed from 101 samples of each smooth
        interval; 0 if the speed ratio never decreases.

        The result is the maximum derivative of the speed ratio with respect to alpha_1, which decreases with time.
        """
        slope = self.contact.path.tooth_pair.slope
        return max(0.0, *(float(slope(phase, x, np).max()) for phase, x in self._samples()))

    @cached_property
    def jumps(self) -> list[SpeedJump]:
        """Impacts within one pitch, in order of time."""
        found = []
        intervals = self._drive_intervals
        for last, new in zip(intervals, (*intervals[1:], intervals[0]), strict=True):
            if new.held is None:
                kind = "matching" if matches(last, new, self.period) else new.phase
                before, after = self.contact.speed(last, last.end), self.contact.speed(new, new.start)
                found.append(SpeedJump(kind, new.start, before, after))
        return found

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the steps of the speed ratio, before and after, at all impacts within one pitch."""
        return tuple(SpeedLeap(jump.before, jump.after) for jump in self.jumps)


# -------------------------------------------------------------------------------------------------- rows over one pitch


@dataclass(frozen=True)
class ContactCourse(Result):
    """Table of the contact over one pitch, in order of time: a row for each sample and for each interval's end."""

    KEYS = (
        *("phases", "alpha1", "alpha2", "speed_ratio", Key("instant_centre", to=finite)),
        *(Key(name, to=finite) for name in ("driver_arm", "driven_arm", "efficiency")),
    )

    phases: tuple[str, ...]
    """Phase of contact in each row of the table."""
    alpha1: Floats
    """Angle between the driver's apex and the line of centres [rad]."""
    alpha2: Floats
    """Angle between the driven wheel's apex and the line of centres [rad]."""
    speed_ratio: Floats
    """Speed ratio tau: driven speed divided by driver speed."""
    instant_centre: Floats
    """Distance O1C from the driver's axis to the instant centre, in the length unit of the sizes.

    The distance is NaN in a dwell.
    """
    driver_arm: Floats
    """Moment arm b1 of the contact force about the driver's axis, in the length unit of the sizes; NaN in a dwell."""
    driven_arm: Floats
    """Moment arm b2 of the contact force about the driven axis, in the unit of the sizes; NaN in a dwell."""
    efficiency: Floats
    """Speed ratio times `driven_arm` divided by `driver_arm`; NaN in a dwell or where friction locks the pair."""


def contact_course(
    transmission: TriangularTransmission, samples: int = _USUAL, friction: PairFriction | None = None
) -> ContactCourse:
    """Return the contact of a pair in `samples` rows for each interval in which one tooth pair or none drives. The
    table is empty if the teeth never touch.

    friction   friction as a function of sliding velocity, which replaces the constant coefficient of the transmission
    """
    at = [(each, np.linspace(each.start, each.end, samples)) for each in transmission.intervals]
    tooth_pair = transmission.contact.path.tooth_pair

    def column(what: Callable[[str, Floats], Floats], held: Callable[[DriveInterval], float]) -> Floats:
        values = [what(each.phase, x) if each.held is None else np.full_like(x, held(each)) for each, x in at]
        return np.concatenate([np.empty(0), *values])

    def coefficient(phase: str, x: Floats) -> float | Floats:
        return transmission.coefficient(phase, x, friction)

    def arm(wheel: int) -> Floats:
        return column(
            lambda phase, x: tooth_pair.moment_arms(phase, x, coefficient(phase, x), np)[wheel], lambda _: nan
        )

    first, second = arm(0), arm(1)
    # the efficiency is defined only where the force acts with a positive arm on both wheels
    eta = column(lambda phase, x: tooth_pair.efficiency(phase, x, coefficient(phase, x), np), lambda _: nan)
    return ContactCourse(
        tuple(each.phase for each, x in at for _ in x),
        np.concatenate([np.empty(0), *(x for _, x in at)]),
        column(lambda phase, x: tooth_pair.angle(phase, x, np), lambda each: each.held or 0.0),
        column(lambda phase, x: tooth_pair.speed(phase, x, np), lambda _: 0.0),
        column(lambda phase, x: tooth_pair.instant_centre(phase, x, np), lambda _: nan),
        first,
        second,
        np.where((first > 0) & (second > 0), eta, nan),
    )
