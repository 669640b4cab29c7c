"""Fit of the periodic transmission function of two outlines: polynomials between its kinks.

`tabulate` computes a `PiecewiseTransmission`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev as cheb

from geartrain.errors import Problem, RangeError
from geartrain.numerics.arrays import joined, some
from geartrain.numerics.periodic_function import PeriodicPieces
from geartrain.numerics.polynomial_pieces import COUNT, POWERS, ends
from geartrain.teeth.contact.outline_contact import OutlinePair
from geartrain.teeth.transmission import SpeedLeap

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline

_JUMP = 1e-6  # fraction of the ratio: smaller steps at a kink are rounding error
# Chebyshev nodes are interior, so that a stretch is never evaluated beyond its kinks
_NODES = -np.cos(np.pi * (np.arange(COUNT) + 0.5) / COUNT)
# between the nodes, where fits have their largest errors, and inside the ends, beyond which the contact may change
_CHECKS = np.concatenate([[-0.999], -np.cos(np.pi * np.arange(1, COUNT) / COUNT), [0.999]])
_ALL = np.sort(np.concatenate([_NODES, _CHECKS]))
# from values to coefficients; at these nodes it is as well conditioned as a cosine transform
_SERIES = np.linalg.inv(cheb.chebvander(_NODES, COUNT - 1))
_PARTS = 4  # initial stretches of a pitch
_OFFSET = 0.1180339887498949  # fraction of a stretch: an irrational offset, so that a kink is unlikely to be at an end
_THIN = 1e-9  # fraction of a pitch: thinner stretches are not divided; a tip tangent to a side makes the speed infinite
_CUTS = 17  # subdivisions of a gap with a kink; one call for many angles costs little more than for one
_SAFETY = 2.0  # reported error divided by the maximum found
_FLAT = 1e-7  # fraction of the ratio: kinks with a smaller change of speed are not refined
_LEAP = 1e-9  # rad: a larger step of the angle is a discontinuity, not a kink
_MOST = 100_000  # maximum number of stretches per driver pitch


@dataclass(frozen=True)
class PiecewiseTransmission:
    """Driven angle [rad] as a function of the driver angle phi1: mean motion plus a periodic piecewise polynomial."""

    ratio: Fraction
    """Mean speed ratio: absolute value of the driven speed divided by the driver speed."""
    period: float
    """Period of the function, as a driver angle [rad]."""
    breaks: Floats
    """Ends of the intervals of the driver angle [rad], shape (n + 1,), in ascending order over one period."""
    errors: PeriodicPieces
    """Transmission error [rad], which is a polynomial in each interval."""
    speeds: PeriodicPieces
    """Speed ratio, which is a polynomial in each interval."""
    pair: Indices
    """Number of the driver's tooth in contact in each interval, shape (n,)."""
    kind: Indices
    """Kind of contact in each interval, shape (n,), as an index into `outline_contact.KINDS`; -1 for none."""
    kinks: Floats
    """Driver angles at which the contact changes to another tooth or curve [rad]."""
    uncertainty: float
    """Estimated error of the driven angle [rad]: twice the maximum difference between fit and function that was found
    between interpolation nodes.
    """
    speed_uncertainty: float
    """Estimated error of the speed ratio: twice the maximum difference between fit and function that was found between
    interpolation nodes.
    """

    def error(self, phi1: ArrayLike) -> Floats:
        """Return the transmission error [rad of the driven wheel] at driver angles phi1 [rad]; NaN without contact."""
        return self.errors(phi1)

    def speed(self, phi1: ArrayLike) -> Floats:
        """Return the speed ratio, the derivative of the driven angle, at driver angles phi1 [rad]."""
        return self.speeds(phi1)

    def angle(self, phi1: ArrayLike) -> Floats:
        """Return the driven angle [rad] at driver angles phi1 [rad]."""
        return self.error(phi1) + float(self.ratio) * np.asarray(phi1, dtype=float)

    def extremes(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error [rad], at kinks or where its slope is 0."""
        return self.errors.extremes()

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio."""
        return self.speeds.extremes()

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Return the upward steps of the speed ratio at the breakpoints, in ascending order of driver angle.

        Steps due to rounding are omitted.
        """
        before, after = self.speeds.sides(0)
        leaps = after - before > _JUMP * float(self.ratio)
        return tuple(SpeedLeap(*each) for each in zip(before[leaps].tolist(), after[leaps].tolist(), strict=True))

    def steepest_fall(self) -> float:
        """Return the maximum decrease of the speed ratio per driver angle [1/rad]; 0 if it never decreases."""
        return max(0.0, -self.speeds.extremes(1)[0])

    def moments(self) -> tuple[float, float]:
        """Return mean and rms deviation from the mean of the transmission error [rad]; NaN if contact breaks."""
        return self.errors.moments()


# -------------------------------------------------------------------------------------------------------------- fitting


class _Stretches(NamedTuple):
    """Intervals of the driver angle, n in number, with the polynomials that are fitted in them: `ends` (2, n),
    coefficients `errors` and `speeds` in n columns, tooth and kind of contact, and maximum errors `off` and `speed_off`
    of both fits.
    """

    ends: Floats
    errors: Floats
    speeds: Floats
    pair: Indices
    kind: Indices
    off: Floats
    speed_off: Floats


def tabulate(
    first: GearOutline,
    second: GearOutline,
    distance: float,
    tolerance: float = 1e-12,
    side: Literal["front", "back"] = "front",
) -> PiecewiseTransmission:
    """Return the transmission function of two wheels in contact on one flank, fitted by polynomials between its kinks.

    Parameters
    ----------
    first, second : GearOutline
        Driver and driven wheel.
    distance : float
        Centre distance, in the unit of the outlines; for bevel wheels the shaft angle [rad].
    tolerance : float
        Maximum error of the fit [rad of the driven wheel]. If rounding errors prevent this accuracy, the reported
        uncertainty is larger.
    side : {"front", "back"}
        Flank that pushes the driven wheel, or flank that prevents it from running ahead.

    Returns
    -------
    PiecewiseTransmission
        Transmission function. Its period is one pitch of the driver if all teeth are equal; otherwise the number of
        pitches after which the same teeth meet again.

    Raises
    ------
    QuestionError, RangeError
        As in `solve`; `RangeError` also if no tooth is ever within reach.

    See Also
    --------
    geartrain.teeth.contact.solve : Contact at given angles.

    Examples
    --------
    Two wheels of 10 pointed teeth with straight sides:

    >>> from geartrain.teeth.contact import GearOutline, ToothFlanks, polyline
    >>> flank = polyline([(0.75, 4.0), (0.0, 5.5)])
    >>> wheel = GearOutline((ToothFlanks.symmetric(flank),), 10)
    >>> transmission = tabulate(wheel, wheel, 10.0, 1e-6)
    >>> transmission.ratio, transmission.uncertainty < 1e-6
    (Fraction(1, 1), True)
    """
    pair_contact = OutlinePair(first, second, distance, side)
    fitter = _Fitter(pair_contact, tolerance)
    done, breaks, kinks = fitter.fit()
    if (done.kind < 0).all():
        where, change = f"a centre distance of {distance:.9g}", "change the centre distance"
        if first.bevel:
            where, change = f"a shaft angle of {distance:.9g} rad", "change the shaft angle"
        why = f"at {where} the teeth of one wheel do not reach the teeth of the other"
        fix = change if first.bevel else f"{change}, or check that both outlines have the same unit"
        raise RangeError(Problem("the two wheels never touch", why, fix))
    middles, halves = done.ends.mean(axis=0), np.diff(done.ends, axis=0)[0] / 2

    def pieces(coefficients: Floats) -> PeriodicPieces:
        scaled = coefficients / halves ** np.arange(COUNT)[:, None]
        return PeriodicPieces(breaks[:-1], scaled[::-1], fitter.period, middles)

    return PiecewiseTransmission(
        fitter.ratio,
        fitter.period,
        breaks,
        pieces(done.errors),
        pieces(done.speeds),
        done.pair,
        done.kind,
        kinks,
        _SAFETY * float(np.nanmax(done.off)),
        _SAFETY * float(np.nanmax(done.speed_off)),
    )


class _Fitter:
    """Adaptive fit of polynomials to the driven angle. Intervals are divided where the contact changes to another tooth
    or curve, or bisected, until the fit is accurate.
    """

    def __init__(self, pair_contact: OutlinePair, tolerance: float) -> None:
        self.pair_contact, self.tolerance = pair_contact, tolerance
        self.ratio = Fraction(pair_contact.first.z, pair_contact.second.z)
        self.pitch = pair_contact.first.pitch
        self.period = pair_contact.cycle * self.pitch

    def fit(self) -> tuple[_Stretches, Floats, Floats]:
        """Return all intervals in ascending order, their ends, and those ends at which the contact changes."""
        count = _PARTS * self.pair_contact.cycle
        edges = (np.arange(count + 1) + _OFFSET) * (self.period / count)
        pending, before = np.stack([edges[:-1], edges[1:]]), np.full(count, np.inf)
        done, kinks = [], [np.empty(0)]
        while pending.shape[1]:
            stretches, labels = self._fitted(pending)
            thin = np.diff(stretches.ends, axis=0)[0] < _THIN * self.pitch
            # bisection of a smooth stretch reduces the error by far more than 4; less at this size is rounding error
            stuck = (stretches.off > before / 4) & (before < 1e-10)
            good = (_SAFETY * stretches.off <= self.tolerance) | thin | stuck
            done.append(some(stretches, good))
            cuts = self._kinks(pending[:, ~good], labels[:, ~good])
            # a stretch with a kink cannot be fitted by one polynomial, whatever its length
            kinks += cuts
            pending, before = _divided(pending[:, ~good], cuts, stretches.off[~good])
            if sum(each.ends.shape[1] for each in done) + pending.shape[1] > _MOST * self.pair_contact.cycle:
                what = (
                    f"the transmission function of these outlines cannot be tabulated within {self.tolerance:.3g} rad"
                )
                why = "the function has too many kinks for a piecewise polynomial fit"
                fix = "pass a larger tolerance, or describe measured teeth with fewer points"
                raise RangeError(Problem(what, why, fix))
        return self._ordered(done, np.concatenate(kinks))

    def _fitted(self, ends: Floats) -> tuple[_Stretches, Indices]:
        """Return polynomials fitted in the intervals with the given `ends`, and four labels of the contact at each
        node: tooth, kind, and curves of both wheels, shape (4, n, nodes).
        """
        half, middle = np.diff(ends, axis=0)[0] / 2, ends.mean(axis=0)
        phi1 = middle[:, None] + half[:, None] * _ALL
        angle, speed, labels = self._evaluated(phi1)
        error = angle - float(self.ratio) * phi1
        inside = np.isin(_ALL, _NODES)
        fits = [POWERS.T @ (_SERIES @ each[:, inside].T) for each in (error, speed)]
        off = [
            np.abs(np.polynomial.polynomial.polyval(_ALL, fit) - each).max(axis=1)
            for fit, each in zip(fits, (error, speed), strict=True)
        ]
        nowhere = labels[1].max(axis=1) < 0
        off = [np.where(nowhere, 0.0, np.where(np.isnan(each), np.inf, each)) for each in off]
        pair, kind = labels[:2, :, COUNT]  # at the middle of 2 COUNT + 1 points
        return _Stretches(ends, fits[0], fits[1], pair, kind, off[0], off[1]), labels

    def _evaluated(self, phi1: Floats) -> tuple[Floats, Floats, Indices]:
        """Return driven angle [rad], speed ratio and label of the contact at driver angles phi1 [rad]."""
        angle, speed, pair, kind, _, _, _, curves = self.pair_contact.at(phi1.ravel(), 0.0)
        labels = np.stack([pair, kind, *curves]).reshape(4, *phi1.shape)
        return angle.reshape(phi1.shape), speed.reshape(phi1.shape), labels

    def _kinks(self, ends: Floats, labels: Indices) -> list[Floats]:
        """Return the driver angles [rad] at which the `labels` of the contact change, for each interval in `ends`."""
        changed = (labels[:, :, 1:] != labels[:, :, :-1]).any(axis=0)
        stretch, at = np.nonzero(changed)
        half, middle = np.diff(ends, axis=0)[0] / 2, ends.mean(axis=0)
        low, high = (middle[stretch] + half[stretch] * _ALL[at + side] for side in (0, 1))
        left = labels[:, stretch, at]
        found = self._located(low, high, left) if len(stretch) else low
        return [np.unique(found[stretch == one]) for one in range(ends.shape[1])]

    def _located(self, low: Floats, high: Floats, left: Indices) -> Floats:
        """Return the smallest angle [rad] from `low` to `high` at which the contact's label differs from `left`."""
        share = np.arange(1, _CUTS) / _CUTS
        for _ in range(20):  # 17^20 exceeds 2^53 by far, so the loop ends by the break below
            inner = low[:, None] + (high - low)[:, None] * share
            inner = np.clip(inner, low[:, None], high[:, None])
            _, _, labels = self._evaluated(inner)
            other = (labels != left[:, :, None]).any(axis=0)
            points = np.concatenate([low[:, None], inner, high[:, None]], axis=1)
            first = np.where(other.any(axis=1), other.argmax(axis=1), _CUTS - 1)
            rows = np.arange(len(low))
            new_low, new_high = points[rows, first], points[rows, first + 1]
            if ((new_high - new_low) >= (high - low)).all() or (new_high - new_low <= 2 * np.spacing(new_high)).all():
                break
            low, high = new_low, new_high
        return low + (high - low) / 2

    def _ordered(self, done: list[_Stretches], kinks: Floats) -> tuple[_Stretches, Floats, Floats]:
        """Return the intervals sorted by driver angle, their ends, and the ends that occur in `kinks`, at which the
        contact changes. The latter are moved to the intersections of the adjacent polynomials.
        """
        everything = joined(done)
        everything = some(everything, np.argsort(everything.ends[0]))
        breaks = np.append(everything.ends[0], everything.ends[1, -1])
        which = np.flatnonzero(np.isin(breaks[1:-1], kinks)) + 1
        breaks[which] = [self._crossing(everything, int(at), float(breaks[at])) for at in which]
        return everything, breaks, breaks[which]

    def _crossing(self, stretches: _Stretches, at: int, kink: float) -> float:
        errors, speeds = ends(stretches.errors[:, at - 1 : at + 1]), ends(stretches.speeds[:, at - 1 : at + 1])
        # a Newton step on the difference of both fits makes the function continuous; labels locate a kink only to
        # the resolution of nearly equal angles
        step, change = float(errors[1, 0] - errors[0, 1]), float(speeds[1, 0] - speeds[0, 1])
        if not abs(change) > _FLAT * float(self.ratio) or not abs(step) < _LEAP:
            return kink
        return kink - step / change


def _divided(ends: Floats, cuts: list[Floats], off: Floats) -> tuple[Floats, Floats]:
    """Return the intervals that result from dividing each interval at the angles in `cuts`, or from bisecting it if
    there are none. With each new interval, return the fit error `off` of the bisected one; infinite if it was divided
    at `cuts`.
    """
    found, before = [], []
    for (low, high), inner, last in zip(ends.T, cuts, off, strict=True):
        within = inner[(inner > low) & (inner < high)]
        points = within if len(within) else np.array([low + (high - low) / 2])
        parts = list(pairwise([low, *points.tolist(), high]))
        found += parts
        before += [np.inf if len(within) else last] * len(parts)
    return np.array(found).reshape(-1, 2).T, np.array(before)
