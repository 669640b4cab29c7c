"""The periodic transmission function of two outlines: polynomials between the driver's angles at which it has a kink.

`PiecewiseTransmission` holds the polynomials; `tabulate` fits them.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev as cheb

from geartrain.errors import Problem, RangeError
from geartrain.numerics.arrays import joined, some
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.polynomial_pieces import COUNT, POWERS, ends, extremes, moments, value
from geartrain.teeth.contact.outline_contact import KINDS, OutlinePair
from geartrain.teeth.transmission import SpeedLeap

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Bools, Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline

_JUMP = 1e-6  # of the ratio: less is rounding at a corner
_NODES = -np.cos(np.pi * (np.arange(COUNT) + 0.5) / COUNT)  # inside, so that a stretch never asks beyond its corners
# between the nodes, where fits are off most, and short of the ends, beyond which something else may touch
_CHECKS = np.concatenate([[-0.999], -np.cos(np.pi * np.arange(1, COUNT) / COUNT), [0.999]])
_ALL = np.sort(np.concatenate([_NODES, _CHECKS]))
# from values to coefficients; at these nodes as well conditioned as a cosine transform
_SERIES = np.linalg.inv(cheb.chebvander(_NODES, COUNT - 1))
_PARTS = 4  # stretches of a pitch to begin with
_OFFSET = 0.1180339887498949  # of a stretch: no corner is likely to be exactly where one begins
_THIN = 1e-9  # of a pitch: a stretch is not cut again, as where a tip grazes a side and the speed is infinite
_CUTS = 17  # parts of a gap that holds a corner: one call for many angles costs little more than for one
_SAFETY = 2.0  # stated error over the greatest found
_FLAT = 1e-7  # of the ratio: corners that change the speed by less stay where they were found
_LEAP = 1e-9  # rad: a greater step of the angle is a leap of the law, and no corner
_MOST = 100_000  # stretches


@dataclass(frozen=True)
class PiecewiseTransmission:
    """The driven angle as a function of the driver's, angle = ratio phi1 + error, repeating itself after a period."""

    ratio: Fraction
    """Driven over driver, without sign."""
    period: float
    """Driver's angle (rad)."""
    breaks: Floats
    """(n + 1,): ends of the stretches, from `breaks[0]` one period on."""
    middles: Floats
    """(n,): u = (phi1 - middle) / half on each stretch, from -1 to 1 but for rounding."""
    halves: Floats
    """(n,): u = (phi1 - middle) / half on each stretch, from -1 to 1 but for rounding."""
    errors: Floats
    """(COUNT, n): coefficients of error (rad) and of d angle / d phi1 by powers of u."""
    speeds: Floats
    """(COUNT, n): coefficients of error (rad) and of d angle / d phi1 by powers of u."""
    pair: Indices
    """(n,): the driver's tooth that touches, an index into `KINDS` or -1 where none is in reach."""
    kind: Indices
    """(n,): the driver's tooth that touches, an index into `KINDS` or -1 where none is in reach."""
    kinks: Floats
    """Driver's angles where something else begins to touch."""
    uncertainty: float
    """Twice the greatest differences found between nodes (rad; none)."""
    speed_uncertainty: float
    """Twice the greatest differences found between nodes (rad; none)."""

    def error(self, phi1: ArrayLike) -> Floats:
        """Transmission error (rad of the driven wheel) at driver's angles (rad), any shape; NaN where none touches."""
        return self._of(self.errors, phi1)

    def speed(self, phi1: ArrayLike) -> Floats:
        """d angle / d phi1 at driver's angles (rad)."""
        return self._of(self.speeds, phi1)

    def angle(self, phi1: ArrayLike) -> Floats:
        """Driven angle (rad) at driver's angles (rad)."""
        return self.error(phi1) + float(self.ratio) * np.asarray(phi1, dtype=float)

    def _of(self, coefficients: Floats, phi1: ArrayLike) -> Floats:
        phi1 = np.asarray(phi1, dtype=float)
        flat = phi1.ravel()
        rest = flat - self.breaks[0]
        # quicker than %, and good enough: `searchsorted` is clipped where rounding leaves `rest` outside the period
        rest -= np.floor(rest / self.period) * self.period
        rest += self.breaks[0]
        which = np.clip(np.searchsorted(self.breaks, rest, side="right") - 1, 0, len(self.breaks) - 2)
        u = (rest - self.middles[which]) / self.halves[which]
        return value(coefficients, which, u)[0].reshape(phi1.shape)

    def extremes(self) -> tuple[float, float]:
        """Least and greatest transmission error (rad): at corners, or where its slope is 0."""
        return extremes(self.errors)

    def speed_range(self) -> tuple[float, float]:
        """Least and greatest speed ratio."""
        return extremes(self.speeds)

    def speed_leaps(self) -> tuple[SpeedLeap, ...]:
        """Where the speed ratio leaps up as one stretch follows another, but for rounding, in order of angle."""
        start, before = ends(self.speeds)
        after = np.roll(start, -1)
        leaps = after - before > _JUMP * float(self.ratio)
        return tuple(SpeedLeap(*each) for each in zip(before[leaps].tolist(), after[leaps].tolist(), strict=True))

    def steepest_fall(self) -> float:
        """Greatest -d speed / d phi1 within the stretches (1/rad), 0 if the speed never falls."""
        slopes = np.zeros_like(self.speeds)  # one degree less, in as many coefficients
        slopes[:-1] = self.speeds[1:] * np.arange(1, len(slopes))[:, None] / self.halves
        return max(0.0, -extremes(slopes)[0])

    def moments(self) -> tuple[float, float]:
        """Mean of the transmission error over a period, and its rms about that mean (rad); NaN with gaps in contact."""
        return moments(self.errors, self.halves)

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        low, high = self.extremes()
        return {
            "ratio": fraction_text(self.ratio),
            "period": self.period,
            "breaks": self.breaks.tolist(),
            "pair": self.pair.tolist(),
            "kind": np.array([*KINDS, "none"])[self.kind].tolist(),
            "kinks": self.kinks.tolist(),
            "error_min": low,
            "error_max": high,
            "uncertainty": self.uncertainty,
            "speed_uncertainty": self.speed_uncertainty,
        }


# -------------------------------------------------------------------------------------------------------------- fitting


class _Stretches(NamedTuple):
    """Fitted stretches: ends (2, n), coefficients (COUNT, n), what touches, greatest differences."""

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
    """The transmission function of one side of two wheels over its period, as polynomials between its corners.

    Parameters
    ----------
    first, second : GearOutline
        Driver and driven wheel.
    distance : float
        From axle to axle, in the outlines' unit; bevel: the shaft angle [rad].
    tolerance : float
        Greatest error [rad of the driven wheel]; where rounding keeps the law from it, the stated uncertainty is
        greater.
    side : {"front", "back"}
        The side that pushes, or the one that holds.

    Returns
    -------
    PiecewiseTransmission
        Its period is a pitch of the driver where all teeth are equal, else all its pitches until the same teeth meet
        again.

    Raises
    ------
    QuestionError, RangeError
        As `solve`; the second also where no tooth is ever in reach.

    See Also
    --------
    geartrain.teeth.contact.solve : angles one by one.

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
    meeting = OutlinePair(first, second, distance, side)
    maker = _Maker(meeting, tolerance)
    done, breaks, kinks = maker.made()
    if (done.kind < 0).all():
        raise RangeError(
            Problem(
                "the two wheels never touch",
                f"at a distance of {distance:.9g} no tooth of one is in reach of the other",
                "bring the axles nearer, or check that both outlines have one unit",
            )
        )
    return PiecewiseTransmission(
        maker.ratio,
        maker.period,
        breaks,
        done.ends.mean(axis=0),
        np.diff(done.ends, axis=0)[0] / 2,
        done.errors,
        done.speeds,
        done.pair,
        done.kind,
        kinks,
        _SAFETY * float(np.nanmax(done.off)),
        _SAFETY * float(np.nanmax(done.speed_off)),
    )


class _Maker:
    def __init__(self, meeting: OutlinePair, tolerance: float) -> None:
        self.meeting, self.tolerance = meeting, tolerance
        self.ratio = Fraction(meeting.first.z, meeting.second.z)
        self.pitch = meeting.first.pitch
        self.period = meeting.cycle * self.pitch

    def made(self) -> tuple[_Stretches, Floats, Floats]:
        """All stretches in order, their ends, and which of these are corners."""
        count = _PARTS * self.meeting.cycle
        edges = (np.arange(count + 1) + _OFFSET) * (self.period / count)
        pending, before = np.stack([edges[:-1], edges[1:]]), np.full(count, np.inf)
        done, kinks = [], [np.empty(0)]
        while pending.shape[1]:
            stretches, labels = self._fitted(pending)
            good = self._good(stretches, before)
            done.append(some(stretches, good))
            cuts = self._kinks(pending[:, ~good], labels[:, ~good])
            kinks += cuts
            pending, before = _cut(pending[:, ~good], cuts, stretches.off[~good])
            if sum(each.ends.shape[1] for each in done) + pending.shape[1] > _MOST * self.meeting.cycle:
                raise _endless(self.tolerance)
        return self._ordered(done, np.concatenate(kinks))

    def _good(self, stretches: _Stretches, before: Floats) -> Bools:
        """Within tolerance, thin, or as good as rounding lets it be."""
        thin = np.diff(stretches.ends, axis=0)[0] < _THIN * self.pitch
        # halving a stretch of a smooth law gains far more than 4: what gains less at this size is rounding
        stuck = (stretches.off > before / 4) & (before < 1e-10)
        good: Bools = (_SAFETY * stretches.off <= self.tolerance) | thin | stuck
        return good

    def _fitted(self, ends: Floats) -> tuple[_Stretches, Indices]:
        """Polynomials on stretches, and what touches at their nodes: (5, n, nodes)."""
        half, middle = np.diff(ends, axis=0)[0] / 2, ends.mean(axis=0)
        phi1 = middle[:, None] + half[:, None] * _ALL
        angle, speed, labels = self._requested(phi1)
        error = angle - float(self.ratio) * phi1
        inside = np.isin(_ALL, _NODES)
        fits = [POWERS.T @ (_SERIES @ each[:, inside].T) for each in (error, speed)]
        off = [
            np.abs(np.polynomial.polynomial.polyval(_ALL, fit) - each).max(axis=1)
            for fit, each in zip(fits, (error, speed), strict=True)
        ]
        nowhere = labels[1].max(axis=1) < 0
        off = [np.where(nowhere, 0.0, np.where(np.isnan(each), np.inf, each)) for each in off]
        pair, kind = labels[:2, :, COUNT]  # at the middle one of 2 COUNT + 1 points
        return _Stretches(ends, fits[0], fits[1], pair, kind, off[0], off[1]), labels

    def _requested(self, phi1: Floats) -> tuple[Floats, Floats, Indices]:
        """Driven angle, speed, and labels that tell what touches."""
        angle, speed, pair, kind, _, _, _, curves = self.meeting.at(phi1.ravel(), 0.0)
        labels = np.stack([pair, kind, *curves]).reshape(4, *phi1.shape)
        return angle.reshape(phi1.shape), speed.reshape(phi1.shape), labels

    def _kinks(self, ends: Floats, labels: Indices) -> list[Floats]:
        """For each stretch the driver's angles at which something else begins to touch, to rounding."""
        changed = (labels[:, :, 1:] != labels[:, :, :-1]).any(axis=0)
        stretch, at = np.nonzero(changed)
        half, middle = np.diff(ends, axis=0)[0] / 2, ends.mean(axis=0)
        low, high = (middle[stretch] + half[stretch] * _ALL[at + side] for side in (0, 1))
        left = labels[:, stretch, at]
        found = self._narrowed(low, high, left) if len(stretch) else low
        return [np.unique(found[stretch == one]) for one in range(ends.shape[1])]

    def _narrowed(self, low: Floats, high: Floats, left: Indices) -> Floats:
        """Where the labels cease to be `left`, from low to high; the gaps shrink to rounding."""
        share = np.arange(1, _CUTS) / _CUTS
        for _ in range(20):  # 17^20 is far beyond 2^53: it ends where a gap shrinks no more
            inner = low[:, None] + (high - low)[:, None] * share
            inner = np.clip(inner, low[:, None], high[:, None])
            _, _, labels = self._requested(inner)
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
        """Stretches by driver's angle, each corner moved to where the stretches on its sides cross."""
        everything = joined(done)
        everything = some(everything, np.argsort(everything.ends[0]))
        breaks = np.append(everything.ends[0], everything.ends[1, -1])
        which = np.flatnonzero(np.isin(breaks[1:-1], kinks)) + 1
        breaks[which] = [self._crossing(everything, int(at), float(breaks[at])) for at in which]
        return everything, breaks, breaks[which]

    def _crossing(self, stretches: _Stretches, at: int, kink: float) -> float:
        errors, speeds = ends(stretches.errors[:, at - 1 : at + 1]), ends(stretches.speeds[:, at - 1 : at + 1])
        # a Newton step on the difference of both fits makes the law continuous: labels place a corner no better than
        # nearly equal angles can be told apart
        step, change = float(errors[1, 0] - errors[0, 1]), float(speeds[1, 0] - speeds[0, 1])
        if not abs(change) > _FLAT * float(self.ratio) or not abs(step) < _LEAP:
            return kink
        return kink - step / change


def _cut(ends: Floats, cuts: list[Floats], off: Floats) -> tuple[Floats, Floats]:
    """Stretches cut at their corners, or halved where they have none; and how far each was off before."""
    found, before = [], []
    for (low, high), inner, last in zip(ends.T, cuts, off, strict=True):
        within = inner[(inner > low) & (inner < high)]
        points = within if len(within) else np.array([low + (high - low) / 2])
        parts = list(pairwise([low, *points.tolist(), high]))
        found += parts
        before += [np.inf if len(within) else last] * len(parts)
    return np.array(found).reshape(-1, 2).T, np.array(before)


def _endless(tolerance: float) -> RangeError:
    return RangeError(
        Problem(
            f"no table comes within {tolerance:.3g} rad of the law of these outlines",
            "it has too many corners",
            "ask for a greater tolerance, or give measured teeth by fewer points",
        )
    )
