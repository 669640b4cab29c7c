"""Real path of contact of triangular teeth: the tooth pair that drives at each position, and collisions, dwells and
clashes.

The tooth pair k is at the driver angle alpha_1 = t + k p1 and permits the driven angle alpha_2 = f(alpha_1) - k
p2 at most, with driver position t and angular pitches p1, p2. Both angles decrease with time. The driven wheel
therefore follows U(t), the minimum over k, docs/teeth.md (10), and, with drag, y <- min(y, U(t)) as t
decreases. Without the mean motion, U is the minimum of the lag g(x) = f(x) - (z1/z2) x over the lattice x = t +
k p1. Between the matching position and the ends of contact g is convex, or concave and then convex (few teeth).
On each such piece only its ends, or the two tooth pairs next to its minimum, can drive, so the cost does not
grow with the number of tooth pairs within range.

The envelope of the tooth pairs decreases with time, but it may be discontinuous. It steps up where a pair
leaves before the next one can drive (the driven wheel dwells until one reaches it), and down where a pair
enters tip against tip (a clash). A collision is a step of the speed ratio as another tooth pair takes over.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import ceil, floor, inf, ulp

from geartrain.numerics.results import Result
from geartrain.numerics.roots import bracketed_root, sign_changes
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS, RETURN, SLIP, ToothPair

DWELL = "dwell"
_ROUNDING = 1e-11  # fraction of a pitch: shorter intervals are discarded
_SMALL = 1e-10  # fraction of a pitch: smaller steps and gaps are rounding error


@dataclass(frozen=True, slots=True)
class MonotonePiece:
    """Range of the angle alpha_1 [rad] of the driver's apex from the line of centres, within one phase of contact. The
    speed ratio is monotonic in this range, so that the driven angle is convex or concave.
    """

    phase: str
    low: float
    high: float
    convex: bool


@dataclass(frozen=True, slots=True)
class DriveInterval:
    """Range of the angle alpha_1 of the driver's apex from the line of centres, from `start` down to `end`, in which
    one tooth pair drives, or in which no tooth pair drives (dwell).

    Tooth pairs are numbered by `tooth_pair`: if the apex of the driver's tooth 0 is at the angle t, the apex of this
    pair is at alpha_1 = t + tooth_pair p1, where p1 is the driver's pitch. In a dwell, `tooth_pair` is the pair that
    has just lost contact, and `held` is the angle alpha_2 of the driven apex at which this pair left the driven wheel.
    """

    phase: str
    """Phase of contact: approach, recess or dwell, or, for contacts that cannot drive, slip or return."""
    start: float
    """Angle alpha_1 [rad] between the driver's apex and the line of centres at the start of the interval."""
    end: float
    """Angle alpha_1 [rad] between the driver's apex and the line of centres at the end of the interval."""
    tooth_pair: int
    """Number of the tooth pair that drives or, in a dwell, of the tooth pair that drove last."""
    held: float | None = None
    """Angle alpha_2 [rad] between the driven apex and the line of centres in a dwell; None while a pair drives."""

    @property
    def width(self) -> float:
        """Driver angle between the start and the end of the interval [rad]."""
        return self.start - self.end


class RealPath:
    """Contact of all tooth pairs of two triangular wheels over one pitch. The pair with the smallest lag drives."""

    def __init__(self, sizes: TriangularSizes, slips: bool = False) -> None:
        """Create the path; `slips` adds contacts that the driven wheel cannot pass but that do not drive it."""
        self.sizes, self.slips = sizes, slips
        self.tooth_pair = ToothPair(sizes)
        self.pitch, self.ratio = sizes.p1, sizes.ratio

    # ------------------------------------------------------------------------------------------------- one tooth pair

    def g(self, phase: str, x: float) -> float:
        """Return the lag g(x) = f(x) - (z1/z2) x of the driven wheel behind its mean motion [rad], with the driver's
        apex at the angle x [rad] from the line of centres. Here f(x) is the angle of the driven apex.
        """
        return float(self.tooth_pair.angle(phase, x)) - self.ratio * x

    def slope(self, phase: str, x: float) -> float:
        """Return the derivative of the lag `g` of the driven wheel, which is the speed ratio minus its mean value, in a
        phase of contact and with the driver's apex at the angle x [rad] from the line of centres.
        """
        return float(self.tooth_pair.speed(phase, x)) - self.ratio

    @cached_property
    def pieces(self) -> list[MonotonePiece]:
        """Ranges of the driver's apex angle in recess and in approach, in each of which the speed ratio is monotonic.

        If `slips` is True, the contacts beyond the exit come first. The list is empty for teeth without valleys.
        """
        if not self.sizes.has_valleys:
            return []
        sizes = self.sizes
        matching = min(max(sizes.matching, sizes.exit), sizes.entry)
        ranges = [(RECESS, sizes.exit, matching), (APPROACH, matching, sizes.entry)]
        if self.slips:
            ranges = [(RETURN, -sizes.entry, -sizes.reach1), (SLIP, -sizes.reach1, sizes.exit), *ranges]
        return [piece for phase, low, high in ranges if high > low for piece in self._cut(phase, low, high)]

    def _cut(self, phase: str, low: float, high: float) -> list[MonotonePiece]:
        def slope(x: float) -> float:
            return float(self.tooth_pair.slope(phase, x))

        first, last = slope(low) > 0, slope(high) > 0
        # the curvature changes its sign at most once on such a range
        if first == last:
            return [MonotonePiece(phase, low, high, first)]
        a, b = low, high
        # bisection to neighbouring floats, as it needs only the sign of the curvature and no derivative
        while a < (middle := a + (b - a) / 2) < b:
            a, b = (middle, b) if (slope(middle) > 0) == first else (a, middle)
        return [MonotonePiece(phase, low, a, first), MonotonePiece(phase, a, high, last)]

    def extremes(self, phase: str, low: float, high: float) -> list[float]:
        """Return a list with the extremum [rad] of the lag of the driven wheel while the driver's apex is at angles
        from `low` to `high`; empty if there is none.
        """
        if (self.slope(phase, low) < 0) == (self.slope(phase, high) < 0):
            return []
        return [self.g(phase, bracketed_root(lambda x: self.slope(phase, x), low, high))]

    # ------------------------------------------------------------------------------------------------ all tooth pairs

    @cached_property
    def branches(self) -> list[MonotonePiece]:
        """Parts of `pieces`, at most one pitch long, in which a tooth pair can have a smaller lag than all others."""
        return [branch for piece in self.pieces for branch in self._branches_of(piece)]

    def _branches_of(self, piece: MonotonePiece) -> list[MonotonePiece]:
        low, high, pitch = piece.low, piece.high, self.pitch
        # only pieces longer than a pitch contain two tooth pairs in contact at the same time
        if high - low <= pitch:
            return [piece]
        left = MonotonePiece(piece.phase, low, low + pitch, piece.convex)
        right = MonotonePiece(piece.phase, high - pitch, high, piece.convex)
        # the lowest of several pairs on a concave piece is within a pitch of one of its ends
        if not piece.convex:
            return [left, right]
        # on a convex piece the rise over a pitch increases; the lowest pair is in the pitch over which the rise is 0
        if self._rise(piece.phase, low) >= 0:
            return [left]
        if self._rise(piece.phase, high - pitch) <= 0:
            return [right]
        start = bracketed_root(lambda x: self._rise(piece.phase, x), low, high - pitch)
        return [MonotonePiece(piece.phase, start, start + pitch, True)]

    def _rise(self, phase: str, x: float) -> float:
        """Return the increase of the driven wheel's lag `g` over one pitch of the driver from the angle x [rad]."""
        return float(self.tooth_pair.angle(phase, x + self.pitch) - self.tooth_pair.angle(phase, x)) - self.sizes.p2

    def lowest(self, t: float, besides: int | None = None) -> float:
        """Return the minimum of the lags [rad] at which tooth pairs other than `besides` touch at the driver position t
        [rad]; inf if there is no such pair.
        """
        minimum = inf
        for piece in self.pieces:
            first, last = ceil((piece.low - t) / self.pitch), floor((piece.high - t) / self.pitch)
            for k in range(first, last + 1):
                if k != besides:
                    x = t + k * self.pitch
                    minimum = min(minimum, self.tooth_pair.angle(piece.phase, x) - self.ratio * x)
        return minimum

    # ------------------------------------------------------------------------------------------------- the envelope

    @cached_property
    def envelope(self) -> list[DriveInterval]:
        """Intervals over one pitch, in order of time, in which one tooth pair has the smallest lag; gaps can occur."""
        base = max((branch.high for branch in self.branches), default=0.0)
        cuts = {0.0, self.pitch}
        for branch in self.branches:
            cuts |= {(base - end) % self.pitch for end in (branch.low, branch.high)}
        found: list[DriveInterval] = []
        for early, late in pairwise(sorted(cuts)):
            if late - early > _ROUNDING * self.pitch:
                found += self._cell(base - early, base - late)
        return self._with_whole_first(_join_neighbours(found))

    def _with_whole_first(self, found: list[DriveInterval]) -> list[DriveInterval]:
        """Return the drive intervals `found` of one period, shifted so that no interval is divided at its end."""
        if not found:
            return found
        first, last = found[0], found[-1]
        same = first.phase == last.phase and first.tooth_pair + 1 == last.tooth_pair
        if len(found) < 2 or not same or abs(last.end - first.start) > _ROUNDING * self.pitch:
            return found
        return [*found[1:-1], DriveInterval(last.phase, last.start, first.end, last.tooth_pair)]

    def _cell(self, high: float, low: float) -> Iterator[DriveInterval]:
        """Yield the intervals of `envelope` from driver position `high` to `low` [rad], between ends of branches."""
        middle = low + (high - low) / 2
        found = {}  # the two ends of a concave piece may belong to the same tooth pair
        for branch in self.branches:
            k = floor((branch.high - middle) / self.pitch)
            if middle + k * self.pitch >= branch.low:
                found[branch.phase, k] = branch
        active = [(branch, k) for (_, k), branch in found.items()]
        if not active:
            return
        marks = {high, low}
        for at, one in enumerate(active):
            for other in active[at + 1 :]:
                marks |= set(self._crossings(one, other, low, high))
        chosen, noise = None, 4 * ulp(self.sizes.reach2 + self.ratio * self.sizes.reach1)
        for upper, lower in pairwise(sorted(marks, reverse=True)):
            t = lower + (upper - lower) / 2
            lags = [self.g(branch.phase, t + k * self.pitch) for branch, k in active]
            # branches may coincide over a range, where rounding must not change from one to the other
            if chosen is None or lags[active.index(chosen)] > min(lags) + noise:
                chosen = active[lags.index(min(lags))]
            branch, k = chosen
            yield DriveInterval(branch.phase, upper + k * self.pitch, lower + k * self.pitch, k)

    def _crossings(
        self, one: tuple[MonotonePiece, int], other: tuple[MonotonePiece, int], low: float, high: float
    ) -> Iterator[float]:
        """Yield the driver positions [rad] from `low` to `high` at which two tooth pairs have the same lag. `one` and
        `other` each consist of an item of `branches` and the number of the tooth pair.
        """
        (a, i), (b, j) = one, other
        shift, turned = (j - i) * self.pitch, (j - i) * self.sizes.p2
        low, high = low + i * self.pitch, high + i * self.pitch
        first, second = self.tooth_pair.angle, self.tooth_pair.speed

        def difference(x: float) -> float:
            return float(first(a.phase, x) - first(b.phase, x + shift)) + turned

        def slope(x: float) -> float:
            return float(second(a.phase, x) - second(b.phase, x + shift))

        def bend(x: float) -> float:
            return float(self.tooth_pair.slope(a.phase, x) - self.tooth_pair.slope(b.phase, x + shift))

        def bounds(c: float, d: float) -> tuple[float, float]:
            # where the curvature of the difference has one sign, its slope is bounded by the ends; three samples decide
            bends = (bend(c), bend((c + d) / 2), bend(d))
            if min(bends) > 0 or max(bends) < 0:
                ends = sorted((slope(c), slope(d)))
                return ends[0], ends[1]
            ours = sorted((second(a.phase, c), second(a.phase, d)))
            theirs = sorted((second(b.phase, c + shift), second(b.phase, d + shift)))
            return ours[0] - theirs[1], ours[1] - theirs[0]

        for c, d in sign_changes(difference, bounds, low, high):
            yield bracketed_root(difference, c, d) - i * self.pitch


def _join_neighbours(cells: list[DriveInterval]) -> list[DriveInterval]:
    found: list[DriveInterval] = []
    for cell in cells:
        last = found[-1] if found else None
        if last and last.phase == cell.phase and last.tooth_pair == cell.tooth_pair:
            found[-1] = DriveInterval(last.phase, last.start, cell.end, last.tooth_pair)
        else:
            found.append(cell)
    return found


# ----------------------------------------------------------------------------------------------------------- collisions


@dataclass(frozen=True, slots=True)
class SpeedJump(Result):
    """Impact of teeth: speed ratios before and after, and jump of the normal velocity, Eqs. (22), (25) to (27)."""

    KEYS = ("kind", "alpha1", "before", "after", "value")

    kind: str
    """Phase of contact that begins, or "matching" if the flank of a tooth meets the whole flank of the other tooth."""
    alpha1: float
    """Angle alpha_1 [rad] between the driver's apex and the line of centres at the impact."""
    before: float
    """Speed ratio before the impact."""
    after: float
    """Speed ratio after the impact."""

    @property
    def value(self) -> float:
        """Relative jump 1 - before/after of the normal velocity, from the speed ratios before and after the impact."""
        return 1 - self.before / self.after


def matches(last: DriveInterval, new: DriveInterval, pitch: float) -> bool:
    """Return True if one tooth pair drives in both intervals and goes from approach in `last` to recess in `new`
    without a loss of contact, so that the contact moves from the driver's flank to the driven flank.
    """
    faces = last.held is None and new.held is None and last.phase != new.phase
    # both are the same root, computed from either side
    return faces and abs(last.end - new.start) < 1e-9 * pitch


# --------------------------------------------------------------------------------------------------- dwells and clashes


@dataclass(frozen=True, slots=True)
class DraggedPath:
    """Real path of contact with dwells, and the angle by which entering tips overlap [rad of the driven wheel]."""

    intervals: tuple[DriveInterval, ...]
    clash: float
    lost: float  # driven angle lost in dwells per pitch (rad)
    arrested: bool = False  # the driven wheel stops for good


def drag(path: RealPath) -> DraggedPath:
    """Return the real path of contact, with a dwell of the driven wheel wherever no tooth pair drives.

    The driven wheel is followed over one pitch, from the position of minimum lag to the next such position. The first
    interval of the result begins after the last dwell.
    """
    envelope, angle = path.envelope, path.tooth_pair.angle
    if not envelope:
        return DraggedPath((), 0.0, inf)
    small, wide = _SMALL * path.sizes.p2, _SMALL * path.pitch
    # start at the minimum of g, which the driven wheel reaches whatever its earlier position: at the last of two,
    # which equal wheels have
    minima = [_minimum(path, each) for each in envelope]
    first = max(at for at, each in enumerate(minima) if each <= min(minima) + small)
    following = (replace(each, tooth_pair=each.tooth_pair + 1) for each in envelope[: first + 1])
    done, arrested, clash, lost = [envelope[first]], False, 0.0, 0.0
    held: DriveInterval | None = None  # the interval whose tooth pair let go
    for interval in (*envelope[first + 1 :], *following):
        last = held or done[-1]
        let_go = float(angle(last.phase, last.end))
        # angle at which `last` left the driven wheel, as alpha_2 of the tooth pair of `interval`
        y = let_go + (interval.tooth_pair - last.tooth_pair) * path.sizes.p2
        step = angle(interval.phase, interval.start) - y
        gap = last.end - interval.start + (interval.tooth_pair - last.tooth_pair) * path.pitch
        if step < -small:
            # a tooth that enters ahead of its mate while no other touches passes it, and its push ends
            arrested |= gap > wide
            clash = clash if gap > wide else max(clash, -step)
        if held is None and (step > small or gap > wide):
            held = last
            lost += max(step, 0.0)
        if held is not None:
            if step > small:
                # an interval that ends above the driven wheel never reaches it
                if angle(interval.phase, interval.end) >= y:
                    continue
                interval = replace(interval, start=_arrival(path, interval, y))
            end = interval.start + (last.tooth_pair - interval.tooth_pair) * path.pitch
            done.append(DriveInterval(DWELL, last.end, end, last.tooth_pair, let_go))
            held = None
        done.append(interval)
    closing = done.pop()
    opening = replace(closing, end=envelope[first].end, tooth_pair=closing.tooth_pair - 1)
    return DraggedPath((opening, *done[1:]), clash, lost, arrested)


def _minimum(path: RealPath, interval: DriveInterval) -> float:
    """Return the minimum lag of the driven wheel over an interval [rad]. There the tooth pair pushes the driven wheel,
    whatever the lag of this wheel was before.
    """
    phase, low, high = interval.phase, interval.end, interval.start
    return min(path.g(phase, low), path.g(phase, high), *path.extremes(phase, low, high))


def _arrival(path: RealPath, interval: DriveInterval, y: float) -> float:
    """Return the angle alpha_1 [rad] of the driver's apex at which a tooth pair of the interval meets the driven wheel,
    which rests with its apex at the angle alpha_2 = y [rad].
    """
    return bracketed_root(lambda x: path.tooth_pair.angle(interval.phase, x) - y, interval.end, interval.start)
