"""Motion of a pair of triangular wheels: verdict, backlash of the coast flanks, and clearance window."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from math import degrees, inf
from types import ModuleType
from typing import Any, Literal

from geartrain.numerics.results import Shown
from geartrain.numerics.roots import bracketed_root, root
from geartrain.teeth.pair_results import PairVerdict
from geartrain.teeth.tooth_form import refused
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DWELL, DraggedPath, DriveInterval, RealPath, drag
from geartrain.teeth.triangular.tooth_pair import APPROACH

MeshingKind = Literal["runs", "no valley", "overhang", "jam", "clash", "dwell", "apart"]
_ROUNDING = 1e-11  # fraction of a driven pitch: backlash above minus this counts as 0
_NEARLY_0 = 1e-9  # of the maximum excess


class TriangularContact:
    """Contact of a pair of triangular wheels: sizes, sequence of driving tooth pairs, backlash and verdict."""

    def __init__(self, sizes: TriangularSizes) -> None:
        self.sizes = sizes
        self.path = RealPath(sizes)

    @cached_property
    def dragged(self) -> DraggedPath:
        """Sequence of driving tooth pairs over one pitch, with the dwells in which no tooth pushes the driven wheel."""
        return drag(self.path)

    @property
    def intervals(self) -> tuple[DriveInterval, ...]:
        """Intervals over one pitch, in order of time, in which one tooth pair drives, or none (dwell)."""
        return self.dragged.intervals

    def locate(self, t: float) -> tuple[DriveInterval, float]:
        """Return the interval of `intervals` that contains the driver position t [rad], and the angle alpha_1 [rad] of
        the driver's apex from the line of centres at t.
        """
        return _locate(self.intervals, t, self.sizes.p1)

    def lag(self, interval: DriveInterval, x: Any, m: ModuleType = math) -> Any:
        """Return the driven wheel's lag [rad] at the angle x [rad] of the driver's apex. `m` is `math` or `numpy`."""
        y = self.path.tooth_pair.angle(interval.phase, x, m) if interval.held is None else interval.held
        return y - self.sizes.ratio * x

    def speed(self, interval: DriveInterval, x: Any, m: ModuleType = math) -> Any:
        """Return the speed ratio at the angle x [rad] of the driver's apex; 0 in a dwell. `m` is `math` or `numpy`."""
        return self.path.tooth_pair.speed(interval.phase, x, m) if interval.held is None else 0.0

    @cached_property
    def _bounds(self) -> list[DriveInterval]:
        """Intervals in which contacts limit the motion of the driven wheel, including contacts that cannot drive it."""
        sizes = self.sizes
        return RealPath(sizes, slips=True).envelope if any(sizes.lean) else self.path.envelope

    @cached_property
    def backlash(self) -> float:
        """Minimum backlash at the coast flanks over a pitch [rad of the driven wheel]; negative if the coast flanks
        jam.

        The backlash is the sum of the transmission function of the drive flanks and the mirror image of the bounds of
        the coast flanks, and is smooth between their kinks. Between two kinks, the backlash is a minimum where drive
        and coast flanks have the same speed ratio.
        """
        pitch = self.sizes.p1
        kinks = {kink % pitch for interval in self.intervals for kink in self._kinks(interval)}
        kinks |= {-kink % pitch for interval in self._bounds for kink in self._kinks(interval)}
        marks = sorted(kinks)
        cells = pairwise([*marks, marks[0] + pitch])
        return min(self._minimum_within(low, high) for low, high in cells) + self.sizes.p2

    def _kinks(self, interval: DriveInterval) -> Iterator[float]:
        yield from (interval.start, interval.end)
        yield from (piece.low for piece in self.path.pieces if interval.end < piece.low < interval.start)

    def _minimum_within(self, low: float, high: float) -> float:
        """Return the minimum backlash [rad] between two kinks. It occurs at one of the kinks, or where the drive and
        the coast flanks have the same speed ratio.
        """
        pitch, middle = self.sizes.p1, (low + high) / 2
        ours, start = self.locate(middle)
        theirs, back = _locate(self._bounds, -middle, pitch)
        half = (high - low) / 2
        if back < theirs.end - _ROUNDING * pitch:
            return inf  # a gap: nothing limits the coast flanks
        start, back = start - half, back + half

        def backlash(step: float) -> float:
            return float(self.lag(ours, start + step)) + self.path.g(theirs.phase, back - step)

        def slope(step: float) -> float:
            return float(self.speed(ours, start + step) - self.speed(theirs, back - step))

        ends = min(backlash(0.0), backlash(2 * half))
        if not slope(0.0) < 0 < slope(2 * half):
            return ends
        step = bracketed_root(slope, 0.0, 2 * half)
        return min(ends, backlash(step))

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict that reports the first failed check, or "runs" if no check fails. The checks are: flanks meet in
        valleys, teeth touch, no overhanging flank touches, coast flanks do not jam, entering teeth do not meet tips,
        and a tooth always drives.
        """
        if not self.sizes.has_valleys:
            return PairVerdict("no valley", _no_valley(self.sizes), -inf)
        if not self.intervals:
            return PairVerdict("apart", "the tips never touch: the wheels are too far apart", -inf)
        kind: MeshingKind = "runs"
        text = "the wheels turn"
        if self.overhang:
            kind, text = "overhang", self.overhang
        elif self.backlash < -_ROUNDING * self.sizes.p2:
            thick = f"{degrees(-self.backlash):.4g} deg of the driven wheel too thick"
            kind, text = "jam", f"the coast flanks jam: the teeth are {thick} for the spaces at this clearance"
        elif self.dragged.clash > 0:
            overlap = f"{degrees(self.dragged.clash):.4g} deg of the driven wheel"
            kind, text = "clash", f"an entering tooth meets a tip: the two overlap by {overlap}"
        elif self.dragged.arrested:
            cause = "for a while no tooth is within range, and the next tooth does not drive it"
            kind, text = "dwell", f"the driven wheel stops permanently: {cause}"
        elif self.idle > 0:
            rest = f"{degrees(self.idle):.4g} deg of the driver in each pitch"
            lag = f"{degrees(self.lost):.4g} deg when the next tooth arrives"
            kind, text = "dwell", f"the driven wheel dwells for {rest}, and lags by {lag}"
        return PairVerdict(kind, text, self.backlash)

    @property
    def idle(self) -> float:
        """Driver angle [rad] per pitch during which no tooth pushes the driven wheel."""
        return sum(each.width for each in self.intervals if each.phase == DWELL)

    @property
    def lost(self) -> float:
        """Angle [rad] per pitch by which the driven wheel falls behind while no tooth pushes it."""
        return self.dragged.lost

    @cached_property
    def overhang(self) -> str:
        """Message on a leaning flank that touches its mate or would turn it backwards; empty if there is none."""
        # tolerance for the rounding of the limits of contact, which are roots with a smaller error
        sizes, small = self.sizes, 1e-9 * self.sizes.p1
        for interval in self.intervals:
            if interval.held is not None:
                continue
            # a leaning flank at the entry or the exit, or an end at which the driven wheel would not move forwards
            lean = (sizes.lean[0] and interval.start > sizes.entry - small) or (
                sizes.lean[1] and interval.end < sizes.exit + small
            )
            back = next((x for x in (interval.start, interval.end) if not self.speed(interval, x) > 0), None)
            if lean or back is not None:
                x = degrees(interval.start if interval.phase == APPROACH else interval.end)
                where = f"while the apex of the driver is {x:.4g} deg from the line of centres ({interval.phase})"
                return f"a flank leans beyond the perpendicular and cannot drive {where}"
        return ""


def _locate(intervals: Sequence[DriveInterval], t: float, pitch: float) -> tuple[DriveInterval, float]:
    """Return the interval that contains the driver position t [rad], and the angle alpha_1 [rad] of the driver's apex
    from the line of centres at t. If no interval contains t, return the nearest interval and an angle outside it.
    """
    for interval in intervals:
        gone = (interval.start - t) % pitch
        if gone <= interval.width:
            return interval, interval.start - gone
    nearest = min(intervals, key=lambda each: (each.start - t) % pitch - each.width)
    return nearest, nearest.start - (nearest.start - t) % pitch


def _no_valley(sizes: TriangularSizes) -> str:
    wheels = zip((sizes.z1, sizes.z2), sizes.half_angles, sizes.signs, ("driver", "driven wheel"), strict=True)
    for z, beta, sign, name in wheels:
        angle, bound = degrees(beta) + sign * 180 / z, "below 90" if sign > 0 else "above 0"
        if not 0 < angle < 90:
            return (
                f"{z} teeth of half angle {degrees(beta):.6g} deg do not exist: on the {name} half angle "
                f"{'+' if sign > 0 else '-'} 180/z is {angle:.6g} deg, but must be {bound} deg for flanks to meet in a "
                "valley"
            )
    raise AssertionError


# ------------------------------------------------------------------------------------------------------------ windows


@dataclass(frozen=True, slots=True)
class ClearanceWindow(Shown):
    """Range of clearances, from `jam` to `run`, in which a pair of triangular teeth turns. The bounds are values of
    `excess`: the relative deviation from the centre distance at which a tip touches the bottom of a tooth space.

    The truth value of a window is False if `run` is not above `jam`: the pair then does not turn at any clearance. If a
    pair turns in several ranges of clearance, the window is the first range.
    """

    jam: float
    """Lower bound of the window. If the excess is smaller, the pair cannot turn."""
    run: float
    """Upper bound of the window: the maximum excess at which the pair turns."""
    run_kind: Literal["clash", "dwell"]
    """Kind of verdict on a pair with an excess above `run`: "clash" or "dwell"."""
    reach: float
    """Excess above which the tips of the two wheels no longer touch."""
    jam_kind: Literal["jam", "overhang", "clash", "dwell"] = "jam"
    """Kind of verdict on a pair with an excess below `jam`."""
    side: int = 1
    """Sign of the pair: 1 for external, -1 for internal pairs, whose clearance factors are below 1."""

    def factor(self, excess: float) -> float:
        """Return the clearance factor, the centre distance divided by `TriangularSizes.deepest_distance`, for an
        excess.

        excess   relative deviation of the centre distance, as in `TriangularSizes.excess`
        """
        return 1 + self.side * excess

    @property
    def jam_factor(self) -> float:
        """Clearance factor at the lower bound `jam`."""
        return self.factor(self.jam)

    @property
    def run_factor(self) -> float:
        """Clearance factor at the upper bound `run`."""
        return self.factor(self.run)

    @property
    def reach_factor(self) -> float:
        """Clearance factor at the excess `reach`, at which the tips cease to reach each other."""
        return self.factor(self.reach)

    def __bool__(self) -> bool:
        return self.works

    @property
    def works(self) -> bool:
        """True if the pair turns at some clearance, False if it turns at none."""
        return bool(self.jam < self.run)

    def at(self, fraction: float) -> float:
        """Return the excess at a given relative position within the window.

        fraction   0 at `jam`, 1 at `run`
        """
        return self.jam + fraction * (self.run - self.jam)


def find_window(sizes: TriangularSizes) -> ClearanceWindow:
    """Return the clearance window of a pair. The declared clearance of the pair has no effect on the window.

    The bounds are roots of the backlash of the coast flanks and of the margins at entry and exit, found by bracketing.

    Parameters
    ----------
    sizes : TriangularSizes
        Pair, whose teeth must have valleys (`sizes.has_valleys`).

    Returns
    -------
    ClearanceWindow
        First range of clearance in which the pair turns; false if no such range exists.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.teeth.triangular import TriangularSizes, pitch_true
    >>> window = find_window(TriangularSizes(48, 96, *pitch_true(48, 96), pi / 6, pi / 6, 0.0))
    >>> bool(window), window.jam < window.at(0.5) < window.run < window.reach
    (True, True)
    """
    # without its excess, the same pair at any clearance is found in the cache
    return _window(sizes.at(0.0))


@lru_cache(maxsize=8192)
def _window(sizes: TriangularSizes) -> ClearanceWindow:
    reach = sizes.maximum_excess
    jam = _start_of_range(lambda excess: TriangularContact(sizes.at(excess)).backlash, reach * _NEARLY_0, reach)
    # at the jam limit itself the backlash is 0 except for rounding
    overhang = _overhang_excess(sizes, max(jam * (1 + 1e-9), reach * _NEARLY_0))
    low = max(jam, overhang)
    # at the entry a negative margin is a clash of tips; at the exit, a dwell before the next tooth pair drives
    clash = _first_range(lambda excess: _end_margin(RealPath(sizes.at(excess)), entry=True), low, reach)
    dwell = _first_range(lambda excess: _end_margin(RealPath(sizes.at(excess)), entry=False), low, reach)
    # equal wheels reach both limits at once, and the dwelling driven wheel admits the next tooth
    run_kind: Literal["clash", "dwell"] = "clash" if clash[1] < dwell[1] * (1 - 1e-9) else "dwell"
    starts: dict[Literal["jam", "overhang", "clash", "dwell"], float]
    starts = {"jam": jam, "overhang": overhang, "clash": clash[0], "dwell": dwell[0]}
    jam_kind = max(starts, key=lambda kind: starts[kind])
    return ClearanceWindow(starts[jam_kind], min(clash[1], dwell[1]), run_kind, reach, jam_kind, sizes.side)


def _start_of_range(margin: Callable[[float], float], low: float, reach: float) -> float:
    """Return the smallest excess of the centre distance from which the function `margin` of the excess is positive: 0
    if it is positive at `low`, and `reach` if its sign does not change up to `reach`.
    """
    return 0.0 if margin(low) > 0 else _first_sign_change(margin, low, reach)


def _overhang_excess(sizes: TriangularSizes, low: float) -> float:
    """Return the excess up to which an overhanging flank touches its mate; 0 if none touches at the excess `low`."""
    if low >= sizes.maximum_excess or not any(sizes.at(low).lean):
        return 0.0

    def margin(excess: float) -> float:
        return -1.0 if TriangularContact(sizes.at(excess)).overhang else 1.0  # a step function: `root` bisects

    return _start_of_range(margin, low, sizes.maximum_excess)


def _first_range(margin: Callable[[float], float], low: float, reach: float) -> tuple[float, float]:
    """Return the bounds of the first range of excess of the centre distance, between `low` and `reach`, in which the
    function `margin` of the excess is positive; (0, 0) if there is none. The range begins at 0 if the margin is
    positive at 0 or at `low`.
    """
    # slightly above 0 or `low`, at which rounding would decide the sign of the margin
    for start in (reach * _NEARLY_0, low * (1 + 1e-9)):
        if start < reach and margin(start) > 0:
            return 0.0, _first_sign_change(margin, start, reach)
    if low >= reach:
        return 0.0, 0.0
    start = _first_sign_change(margin, max(low * (1 + 1e-9), reach * _NEARLY_0), reach)
    # close to the excess at which tips last touch the sign is due to rounding error
    if start >= reach * (1 - 1e-6):
        return 0.0, 0.0
    return start, _first_sign_change(margin, start + 1e-9 * reach, reach)


def _end_margin(path: RealPath, entry: bool) -> float:
    """Return the lag [rad] at which a tooth pair touches at the first contact if `entry` is True, or at the last
    contact if it is False, minus the minimum lag at which another pair touches in this position.
    """
    piece = path.pieces[-1 if entry else 0]
    x = piece.high if entry else piece.low
    return path.g(piece.phase, x) - path.lowest(x, besides=0)


def _first_sign_change(value: Callable[[float], float], low: float, reach: float) -> float:
    """Return the lowest zero between `low` and `reach` of the function `value` of the excess; `reach` if none."""
    # scanned in 16 steps before `root`; a range shorter than one step may be missed
    steps, start = 16, low
    at_low = value(low)
    for step in range(1, steps + 1):
        # below the maximum excess, where tips barely touch and the path has zero length
        high = start + (reach * (1 - _NEARLY_0) - start) * step / steps
        at_high = value(high)
        if (at_high > 0) != (at_low > 0):
            return root(value, low, high, at_low, at_high)
        low, at_low = high, at_high
    return reach


def excess_of_backlash(sizes: TriangularSizes, backlash: float, text: str) -> float:
    """Return the excess of the centre distance at which the minimum backlash, measured on the pitch circle of the
    second wheel, equals `backlash`.

    The root is unique because the backlash increases with the excess. Raises `GearTrainError` if no excess gives this
    backlash; `text` is the declared backlash as shown in the error message.
    """

    def backlash_at(excess: float) -> float:
        D = sizes.factor(excess) * sizes.deepest_distance
        return TriangularContact(sizes.at(excess)).backlash * D * sizes.z2 / sizes.pitch_sum

    # at the maximum excess itself tips do not touch and the backlash is undefined
    low, high = 0.0, sizes.maximum_excess * (1 - 1e-9)
    minimum, most = backlash_at(low), backlash_at(high)
    if not minimum <= backlash <= most:
        possible = f"{max(minimum, 0):.6g} to {most:.6g} (in m, or without a unit)"
        why = f"the possible backlash of these teeth is {possible}"
        raise refused(f"no clearance gives a backlash of {text}", why, "give a backlash in this range")
    return root(lambda excess: backlash_at(excess) - backlash, low, high, minimum - backlash, most - backlash)
