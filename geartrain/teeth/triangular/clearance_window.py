"""Whether a pair of triangular wheels turns: verdict, backlash of the coast flanks, window of clearance."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from math import degrees, inf
from typing import Literal

from geartrain.numerics.results import Shown
from geartrain.numerics.roots import bracketed_root, root
from geartrain.teeth.pair_results import PairVerdict
from geartrain.teeth.tooth_form import refused
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DWELL, DraggedPath, DriveInterval, RealPath, drag
from geartrain.teeth.triangular.tooth_pair import APPROACH

MeshingKind = Literal["runs", "no valley", "overhang", "jam", "clash", "dwell", "apart"]
_ROUNDING = 1e-11  # of a driven pitch: play that is less below 0 is none
_NEARLY_0 = 1e-9  # of the reach


class TriangularContact:
    """A pair in contact: sizes, real path with its standstills, play, verdict."""

    def __init__(self, sizes: TriangularSizes) -> None:
        self.sizes = sizes
        self.path = RealPath(sizes)
        self._means: dict[tuple[str, float], float] = {}

    def mean(self, of: tuple[str, float], make: Callable[[], float]) -> float:
        """A mean over the contact at some friction, integrated once for all laws that share it."""
        if of not in self._means:
            self._means[of] = make()
        return self._means[of]

    @cached_property
    def dragged(self) -> DraggedPath:
        """The real path, the driven wheel standing where nothing pushes it."""
        return drag(self.path)

    @property
    def intervals(self) -> tuple[DriveInterval, ...]:
        """What drives, in order of time."""
        return self.dragged.intervals

    def lag(self, t: float) -> float:
        """y(t) - (z1/z2) t: how far the dragged wheel lags, in its own angle, at the driver's position t."""
        return self._height(*self.locate(t))

    def locate(self, t: float) -> tuple[DriveInterval, float]:
        """The interval that holds position t, and alpha_1 there."""
        return _locate(self.intervals, t, self.sizes.p1)

    def _height(self, interval: DriveInterval, x: float) -> float:
        if interval.held is None:
            return self.path.g(interval.phase, x)
        return interval.held - self.sizes.ratio * x

    def speed(self, interval: DriveInterval, x: float) -> float:
        """tau, 0 in a standstill."""
        return 0.0 if interval.held is not None else float(self.path.tooth_pair.speed(interval.phase, x))

    @cached_property
    def _bounds(self) -> list[DriveInterval]:
        """What bounds the driven wheel, pushing or not; a gap where nothing does."""
        sizes = self.sizes
        return RealPath(sizes, slips=True).envelope if any(sizes.lean) else self.path.envelope

    @cached_property
    def backlash(self) -> float:
        """The least play of the back flanks over a pitch (rad of the driven wheel); below 0 they jam.

        The sum of the law and the mirror image of the bounds is smooth between their corners, where tau differs or
        turns; within, it is least where both have the same tau.
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
        """The least play between two corners: at one of them, or where both sides have one tau."""
        pitch, middle = self.sizes.p1, (low + high) / 2
        ours, start = self.locate(middle)
        theirs, back = _locate(self._bounds, -middle, pitch)
        half = (high - low) / 2
        if back < theirs.end - _ROUNDING * pitch:
            return inf  # a gap: nothing is in reach of the back flanks
        start, back = start - half, back + half

        def backlash(step: float) -> float:
            return self._height(ours, start + step) + self.path.g(theirs.phase, back - step)

        def slope(step: float) -> float:
            return self.speed(ours, start + step) - self.speed(theirs, back - step)

        ends = min(backlash(0.0), backlash(2 * half))
        if not slope(0.0) < 0 < slope(2 * half):
            return ends
        step = bracketed_root(slope, lambda _: 0.0, 0.0, 2 * half)  # a slope of 0 makes it halve
        return min(ends, backlash(step))

    @cached_property
    def verdict(self) -> PairVerdict:
        """The first of the checks that fails: valley, reach, overhang, back flanks, entry, exit."""
        sizes = self.sizes
        if not sizes.has_valleys:
            return self._failed("no valley", _no_valley(sizes))
        if not self.intervals:
            return self._failed("apart", "the tips never touch: the wheels are too far apart")
        return PairVerdict(*self._judged(), self.backlash)

    @staticmethod
    def _failed(kind: MeshingKind, text: str) -> PairVerdict:
        return PairVerdict(kind, text, -inf)

    def _judged(self) -> tuple[MeshingKind, str]:
        if self.overhang:
            return "overhang", self.overhang
        if self.backlash < -_ROUNDING * self.sizes.p2:
            return "jam", (
                f"the back flanks jam: the teeth are {degrees(-self.backlash):.4g} deg of the driven "
                f"wheel too thick for "
                "the spaces at this clearance"
            )
        if self.dragged.clash > 0:
            return "clash", (
                f"an entering tooth meets a tip: the two overlap by {degrees(self.dragged.clash):.4g} deg of the "
                "driven wheel"
            )
        if self.dragged.arrested:
            return "dwell", (
                "the driven wheel is left standing for good: no tooth is in reach for a while, and the next one goes by"
            )
        if self.idle > 0:
            return "dwell", (
                f"the driven wheel stands still for {degrees(self.idle):.4g} deg of the driver at each pitch, and is "
                f"{degrees(self.lost):.4g} deg behind when the next tooth comes"
            )
        return "runs", "the wheels turn"

    @property
    def idle(self) -> float:
        """The driver's angle (rad) in the standstills of one pitch."""
        return sum(each.width for each in self.intervals if each.phase == DWELL)

    @property
    def lost(self) -> float:
        """The step of the driven wheel's law (rad) at the standstills of one pitch."""
        return self.dragged.lost

    @cached_property
    def overhang(self) -> str:
        """The path must not reach a flank that leans beyond the perpendicular, nor turn the driven wheel back."""
        # ends of intervals are roots, found to less than this
        sizes, small = self.sizes, 1e-9 * self.sizes.p1
        for interval in self.intervals:
            if interval.held is not None:
                continue
            lean = (sizes.lean[0] and interval.start > sizes.entry - small) or (
                sizes.lean[1] and interval.end < sizes.exit + small
            )
            back = next((x for x in (interval.start, interval.end) if not self.speed(interval, x) > 0), None)
            if lean or back is not None:
                x = interval.start if interval.phase == APPROACH else interval.end
                return (
                    f"a flank leans beyond the perpendicular at alpha_1 = {degrees(x):.4g} deg ({interval.phase}), and "
                    "cannot push there"
                )
        return ""


def _locate(intervals: Sequence[DriveInterval], t: float, pitch: float) -> tuple[DriveInterval, float]:
    """The interval that holds position t, and alpha_1 there; in a gap the nearest one, and alpha_1 outside it."""
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
                f"{'+' if sign > 0 else '-'} 180/z is {angle:.6g} deg, and must be {bound} deg for flanks to meet in a "
                "valley"
            )
    raise AssertionError


# ------------------------------------------------------------------------------------------------------------ windows


@dataclass(frozen=True, slots=True)
class ClearanceWindow(Shown):
    """Clearances between which a pair of triangular teeth turns: above `jam`, up to `run`; each as excess.

    False where `run` is below `jam`: no clearance works. Where a pair runs in several stretches of clearance this is
    the first.

    See Also
    --------
    find_window : gives it.
    """

    jam: float
    """Clearance up to which the pair does not turn."""
    run: float
    """Clearance up to which the pair runs."""
    run_kind: Literal["clash", "dwell"]
    """What happens beyond `run`."""
    reach: float
    """Excess beyond which no tip touches."""
    jam_kind: Literal["jam", "overhang", "clash", "dwell"] = "jam"
    """What happens up to `jam`."""
    side: int = 1
    """1 for an external pair, -1 for an internal one, whose clearance factors are below 1."""

    def factor(self, excess: float) -> float:
        """The clearance factor of an excess.

        Parameters
        ----------
        excess : float
            As of `TriangularSizes`.
        """
        return 1 + self.side * excess

    @property
    def jam_factor(self) -> float:
        """Clearance factor of `jam`."""
        return self.factor(self.jam)

    @property
    def run_factor(self) -> float:
        """Clearance factor of `run`."""
        return self.factor(self.run)

    @property
    def reach_factor(self) -> float:
        """Clearance factor of `reach`."""
        return self.factor(self.reach)

    def __bool__(self) -> bool:
        return self.works

    @property
    def works(self) -> bool:
        """True if some clearance lets the pair turn."""
        return bool(self.jam < self.run)

    def at(self, fraction: float) -> float:
        """The excess at a fraction of the window.

        Parameters
        ----------
        fraction : float
            0 at the jam, 1 where contact is lost.
        """
        return self.jam + fraction * (self.run - self.jam)


def find_window(sizes: TriangularSizes) -> ClearanceWindow:
    """The window of clearance of a pair, whatever its own clearance.

    Bracketing and root finding on the backlash of the coast flanks and on the margins at entry and exit.

    Parameters
    ----------
    sizes : TriangularSizes
        The pair, whose teeth must have valleys (`sizes.has_valleys`).

    Returns
    -------
    ClearanceWindow
        The first stretch of clearance in which it turns; false if there is none.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.teeth.triangular import TriangularSizes, pitch_true
    >>> window = find_window(TriangularSizes(48, 96, *pitch_true(48, 96), pi / 6, pi / 6, 0.0))
    >>> bool(window), window.jam < window.at(0.5) < window.run < window.reach
    (True, True)
    """
    return _window(sizes.at(0.0))


@lru_cache(maxsize=8192)
def _window(sizes: TriangularSizes) -> ClearanceWindow:
    reach = sizes.maximum_excess
    jam = _minimum_excess(sizes)
    leaning = _leaning_excess(sizes, jam)
    low = max(jam, leaning)
    clash = _stretch(lambda excess: _entry(RealPath(sizes.at(excess))), low, reach)
    still = _stretch(lambda excess: _exit(RealPath(sizes.at(excess))), low, reach)
    # equal wheels do both at once, and the driven wheel that stands lets the next tooth in
    run_kind: Literal["clash", "dwell"] = "clash" if clash[1] < still[1] * (1 - 1e-9) else "dwell"
    starts: dict[Literal["jam", "overhang", "clash", "dwell"], float]
    starts = {"jam": jam, "overhang": leaning, "clash": clash[0], "dwell": still[0]}
    jam_kind = max(starts, key=lambda kind: starts[kind])
    return ClearanceWindow(starts[jam_kind], min(clash[1], still[1]), run_kind, reach, jam_kind, sizes.side)


def _minimum_excess(sizes: TriangularSizes) -> float:
    """The excess from which back flanks have play: 0 where they always have, the reach where they never do."""
    reach = sizes.maximum_excess

    def backlash(excess: float) -> float:
        return TriangularContact(sizes.at(excess)).backlash

    if backlash(reach * _NEARLY_0) > 0:
        return 0.0
    return _first_sign_change(backlash, reach * _NEARLY_0, reach)


def _leaning_excess(sizes: TriangularSizes, jam: float) -> float:
    """The excess up to which the path reaches a leaning flank; 0 if it does not where the pair ceases to jam."""
    reach = sizes.maximum_excess
    # at the jam itself the play is 0 but for rounding
    low = max(jam * (1 + 1e-9), reach * _NEARLY_0)

    def stands(excess: float) -> float:
        return -1.0 if TriangularContact(sizes.at(excess)).overhang else 1.0  # a step: `root` halves

    if low >= reach or not any(sizes.at(low).lean) or stands(low) > 0:
        return 0.0
    return _first_sign_change(stands, low, reach)


def _stretch(margin: Callable[[float], float], low: float, reach: float) -> tuple[float, float]:
    """Where a margin first holds: from 0 or `low` if it does there, else from where it begins to; 0, 0 if never."""
    for start in (reach * _NEARLY_0, low * (1 + 1e-9)):
        if start < reach and margin(start) > 0:
            return 0.0, _first_sign_change(margin, start, reach)
    if low >= reach:
        return 0.0, 0.0
    start = _first_sign_change(margin, max(low * (1 + 1e-9), reach * _NEARLY_0), reach)
    # so near to where tips last touch the sign is that of rounding
    if start >= reach * (1 - 1e-6):
        return 0.0, 0.0
    return start, _first_sign_change(margin, start + 1e-9 * reach, reach)


def _entry(path: RealPath) -> float:
    """Below 0 where a couple comes in below the others."""
    last = path.pieces[-1]
    return path.g(last.phase, last.high) - path.lowest(last.high, besides=0)


def _exit(path: RealPath) -> float:
    """Below 0 where a couple leaves before another one can drive."""
    first = path.pieces[0]
    return path.g(first.phase, first.low) - path.lowest(first.low, besides=0)


def _first_sign_change(value: Callable[[float], float], low: float, reach: float) -> float:
    """The least excess from `low` at which `value` changes its sign; `reach` if it never does."""
    # looked at in 16 steps before `root`: a stretch shorter than one of them may be passed over
    steps, start = 16, low
    at_low = value(low)
    for step in range(1, steps + 1):
        # short of the reach, where tips barely touch and the path has no length
        high = start + (reach * (1 - _NEARLY_0) - start) * step / steps
        at_high = value(high)
        if (at_high > 0) != (at_low > 0):
            return root(value, low, high, at_low, at_high)
        low, at_low = high, at_high
    return reach


def excess_of_backlash(sizes: TriangularSizes, backlash: float, text: str) -> float:
    """The excess whose least play, on the second wheel's pitch circle, is `backlash`; play only grows with excess."""

    def backlash_at(excess: float) -> float:
        D = sizes.factor(excess) * sizes.deepest_distance
        return TriangularContact(sizes.at(excess)).backlash * D * sizes.z2 / sizes.pitch_sum

    # at the greatest excess itself tips do not touch, and there is no play
    low, high = 0.0, sizes.maximum_excess * (1 - 1e-9)
    minimum, most = backlash_at(low), backlash_at(high)
    if not minimum <= backlash <= most:
        raise refused(
            f"no clearance gives a backlash of {text}",
            f"these teeth have from {max(minimum, 0):.6g} to {most:.6g} (in m, or the plain unit)",
            "give a backlash between the two",
        )
    return root(lambda excess: backlash_at(excess) - backlash, low, high, minimum - backlash, most - backlash)
