"""Two wheels of teeth with displaced flanks on their axles: which couple drives, how far the other is off.

Couple k joins tooth k of the driver to tooth k of the driven wheel, both counted on through all turns. Its driver's
leading flank holds the driven trailing flank; the driver's trailing flank stands before the leading flank of the driven
tooth k + 1. Each couple alone would let the driven wheel lag by so much, docs/cut-by-hand.md (2); the foremost drives,
and what is left between it and the nearest couple on the other side is the play.

Teeth are numbered as they pass the line of centres while the wheel turns forward, as those of `CutWheel`. Lengths are
modules, on cones angles (rad) on the unit sphere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import gcd, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.workshop.cutting.cut_wheel import of_teeth
from geartrain.workshop.cutting.file_strokes import TightPlace
from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact


_OF_TEETH = ("place", "tip", "leading", "trailing", "leading_low", "trailing_low")
_PHASES = 4  # of a pitch at which couples are looked at, beside the ends of their paths: between, lags are smooth
_UNEVEN_PHASES = 32  # where even wheels do not lag alike along their path
_FINE = 512  # of a pitch: for the mean of a lag with a few corners


@dataclass(frozen=True, slots=True)
class DisplacedWheel:
    """Arrays (..., z), leading axes trials; `e` and `towards` one for each trial."""

    place: Floats
    """How far behind its even place a tooth stands (rad)."""
    tip: Floats
    """How far a tip stands out."""
    leading: Floats
    """By how much the flanks are flatter, turned about their pitch points (rad)."""
    trailing: Floats
    """By how much the flanks are flatter, turned about their pitch points (rad)."""
    leading_low: Floats
    """How far the flanks are lowered along their normals."""
    trailing_low: Floats
    """How far the flanks are lowered along their normals."""
    e: Any = 0.0
    """Where the middle of the teeth lies from the axle: how far, and in which direction (rad), counted from the
    first tooth against the way the wheel turns, as teeth are."""
    towards: Any = 0.0
    """Where the middle of the teeth lies from the axle: how far, and in which direction (rad), counted from the
    first tooth against the way the wheel turns, as teeth are."""

    @classmethod
    def even(cls, z: int) -> DisplacedWheel:
        """A wheel without errors."""
        return cls(*(np.zeros(z) for _ in _OF_TEETH))

    @property
    def z(self) -> int:
        """Tooth number."""
        return int(self.place.shape[-1])

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading axes: () for one wheel."""
        shapes = (getattr(self, name).shape[:-1] for name in _OF_TEETH)
        return np.broadcast_shapes(*shapes, np.shape(self.e), np.shape(self.towards))

    @property
    def tips(self) -> Floats:
        """How far tips stand out, those of an eccentric wheel with it."""
        if not np.any(self.e):
            return self.tip
        angle = np.arange(self.z) * (2 * pi / self.z) - np.asarray(self.towards)[..., None]
        found: Floats = self.tip + np.asarray(self.e)[..., None] * np.cos(angle)
        return found

    def flanks(self, trailing: bool) -> tuple[Floats, Floats]:
        """How much flatter one side of the teeth is, and how far lower."""
        return (self.trailing, self.trailing_low) if trailing else (self.leading, self.leading_low)

    @property
    def cuttable(self) -> Bools:
        """For each tooth, whether the next stands behind it."""
        found: Bools = np.roll(self.place, -1, -1) - self.place > -2 * pi / self.z
        return found

    def taken(self, part: slice | NDArray[np.int64]) -> DisplacedWheel:
        """Some wheels out of many; an array that all share stays."""
        teeth = {name: getattr(self, name) for name in _OF_TEETH}
        some = {name: each[part] if each.ndim > 1 else each for name, each in teeth.items()}
        e, towards = (each[part] if np.ndim(each) else each for each in (self.e, self.towards))
        return DisplacedWheel(**some, e=e, towards=towards)

    def mirrored(self, first: int = 0) -> DisplacedWheel:
        """The wheel seen from behind, turning the other way; tooth i is tooth `first` - i as it was."""
        order = (first - np.arange(self.z)) % self.z
        return DisplacedWheel(
            -self.place[..., order],
            self.tip[..., order],
            self.trailing[..., order],
            self.leading[..., order],
            self.trailing_low[..., order],
            self.leading_low[..., order],
            self.e,
            first * (2 * pi / self.z) - np.asarray(self.towards),
        )

    def filed(self, leading: Floats, trailing: Floats) -> DisplacedWheel:
        """The wheel with its flanks lowered further."""
        return replace(self, leading_low=self.leading_low + leading, trailing_low=self.trailing_low + trailing)


@dataclass(frozen=True)
class SideTerms:
    """One side of every tooth at one position of the driver within a pitch, by the pitches n that have passed."""

    driver: Any
    """What each wheel adds to the lag (rad of the driven wheel): (trials, z) of its own n."""
    driven: Any
    """What each wheel adds to the lag (rad of the driven wheel): (trials, z) of its own n."""
    pitches: int
    """By which the couple's own driver's tooth came earlier."""


@dataclass(frozen=True)
class DisplacedPair:
    """Two wheels, the first driving, and how much farther their axles stand than the contact has them (one or each)."""

    contact: DisplacedContact
    first: DisplacedWheel
    second: DisplacedWheel
    shift: Any = 0.0

    @property
    def count(self) -> int:
        """Couples in a full cycle of teeth."""
        return self.first.z * self.second.z // gcd(self.first.z, self.second.z)

    @property
    def teeth(self) -> tuple[int, int]:
        """Tooth numbers."""
        return self.first.z, self.second.z

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the trials: () for one pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    def taken(self, rows: Ints) -> DisplacedPair:
        """Some of the trials."""
        shift = self.shift if np.ndim(self.shift) == 0 else self.shift[rows]
        return DisplacedPair(self.contact, self.first.taken(rows), self.second.taken(rows), shift)

    @cached_property
    def widest(self) -> tuple[float, float]:
        """Angles (rad of the driver) past a tooth's place from where to where it can touch."""
        at, (leaving, entering) = self.contact, self._late
        return at.start - at.entering.most - entering, at.end + at.leaving.most + leaving

    @property
    def _uneven(self) -> bool:
        """True for teeth whose even wheels lag more here, less there."""
        even = self.contact.even
        return bool(even.any() and np.ptp(even) > 0)

    @cached_property
    def _late(self) -> tuple[float, float]:
        """How much earlier than the end of the path, and later than its start, some tooth meets a corner."""
        late = float(np.abs(self.first.place).max(initial=0.0))
        tips = (float(np.abs(each.tips).max(initial=0.0)) for each in (self.first, self.second))
        leaving, entering = (late + longer * tip for longer, tip in zip(self.contact.longer, tips, strict=True))
        return leaving, entering

    # ---------------------------------------------------------------------------------------------- couple by couple

    def side_terms(self, u: float, back: bool) -> Iterator[SideTerms]:
        """All couples that can touch on one side where the driver stands u beyond a pitch, whose lag may be least."""
        sign = -1.0 if back else 1.0
        low, high = self.widest
        pitch = self.contact.pitches[0]
        ends = (low - sign * u) / pitch, (high - sign * u) / pitch
        found = []
        for steps in range(int(np.ceil(ends[0])), int(np.floor(ends[1])) + 1):
            x = sign * u + steps * pitch
            nominal = float(self._even(np.array(x)))
            found.append((nominal, x, int(sign) * steps))
        minimum = min((nominal for nominal, _, _ in found), default=np.inf)
        for nominal, x, j in found:
            # far beyond its end a tip lags more than errors can make up for
            if nominal <= minimum + self._spread:
                yield self._side(u, x, j, back)

    @cached_property
    def _spread(self) -> float:
        """More than errors can make one couple differ from another (rad of the driven wheel)."""
        at, found = self.contact, 0.0
        for gear, wheel in enumerate((self.first, self.second)):
            flanks = np.maximum(np.abs(wheel.leading).max(initial=0.0), np.abs(wheel.trailing).max(initial=0.0))
            lowered = np.maximum(wheel.leading_low.max(initial=0.0), wheel.trailing_low.max(initial=0.0))
            moved = np.abs(wheel.place).max(initial=0.0) * (1.0 if gear else float(at.ratio))
            tips = at.longer[gear] * np.abs(wheel.tips).max(initial=0.0) * float(at.ratio)
            found += float(2 * (moved + flanks * np.abs(at.tilt[gear]).max() + tips) + lowered * at.normal.max())
        # the steepest corner, for teeth out of place meet it elsewhere
        late = np.abs(self.first.place).max(initial=0.0)
        return found + float(self._steep * late)

    @property
    def _steep(self) -> float:
        at = self.contact
        return max(float(np.diff(each.lags).max(initial=0.0)) / each.step for each in (at.entering, at.leaving))

    def _kinks(self, x: Floats, tip1: Any = 0.0, tip2: Any = 0.0) -> Floats:
        """The lag of tips beyond the ends of the path, with tips so much higher."""
        at = self.contact
        beyond = at.leaving(x - at.end - at.longer[0] * tip1)
        return np.asarray(beyond + at.entering(at.start - at.longer[1] * tip2 - x))

    def _even(self, x: Floats) -> Floats:
        """The lag of even wheels, beyond the ends of the path too."""
        return np.asarray(self._along(self.contact.even, x) + self._kinks(x))

    def _along(self, column: Floats, x: Any) -> Any:
        """One column of the contact at x, as `_columns`."""
        at, last = self.contact, len(column) - 1
        return np.interp(x, at.start + (at.end - at.start) / last * np.arange(last + 1), column)

    def _columns(self, x: Floats) -> list[Floats]:
        """Columns of the contact at x, linear between their steps, constant beyond the ends.

        Across, along and tilt of both wheels, normal, even, apart.
        """
        at = self.contact
        last = len(at.normal) - 1
        place = np.clip((x - at.start) * (last / (at.end - at.start)), 0.0, last)
        low = np.minimum(place.astype(np.int64), last - 1)
        part = place - low
        columns = (*at.across, *at.along, *at.tilt, at.normal, at.even, at.apart)
        return [each[low] + (each[low + 1] - each[low]) * part for each in columns]

    def _side(self, u: float, x: float, j: int, back: bool, late: Any = None) -> SideTerms:
        """Equation (2), apart for the two wheels: teeth of each at one x, placed by n = tooth + j.

        late    (trials, z): by how much later the driver stands for each n (rad); then tips count as even
        """
        at, sign = self.contact, -1.0 if back else 1.0
        one, two = self.first, self.second
        t1, t2, y1, y2, l1, l2, w, even, apart = (float(each) for each in self._columns(np.array(x)))
        (flank1, low1), (flank2, low2) = one.flanks(back), two.flanks(not back)
        shift = np.asarray(self.shift)[..., None] if np.ndim(self.shift) else self.shift
        ratio = float(at.ratio)
        own = sign * ratio * one.place - flank1 * l1 + low1 * w
        here = x - sign * one.place + (0.0 if late is None else np.roll(late, -j, -1))
        # a tooth out of place touches elsewhere, where even wheels may lag otherwise
        own = own + (self._along(at.even, here) if self._uneven else even) + apart * shift
        other = -sign * two.place + flank2 * l2 + low2 * w
        if late is not None:
            own = own + self._kinks(here)
        elif not at.start + self._late[1] < x < at.end - self._late[0]:
            own = own + self._kinks(here, one.tips)
            # places of the driver's teeth and heights of the driven both move where couples enter: taken one by one
            other = other + at.entering(at.start - at.longer[1] * two.tips - x) - at.entering(np.array(at.start - x))
        # a couple on the back joins the driver's tooth to the driven tooth that follows
        driver = np.roll(own, j, -1) + self._swing(one, u, 0.0, -t1 * sign, -y1)
        turned = ratio * u - sign * even
        driven = np.roll(other, j - back, -1) + self._swing(two, turned, at.stands + back * at.backlash, t2 * sign, y2)
        return SideTerms(driver, driven, j)

    @staticmethod
    def _swing(wheel: DisplacedWheel, turned: float, stands: float, across: float, along: float) -> Any:
        """What an eccentric wheel adds after each number of pitches."""
        if not np.any(wheel.e):
            return 0.0
        angle = np.arange(wheel.z) * (2 * np.pi / wheel.z) + turned + stands
        angle = angle - np.asarray(wheel.towards)[..., None]
        return np.asarray(wheel.e)[..., None] * (across * np.sin(angle) + along * np.cos(angle))

    # ------------------------------------------------------------------------------------------------ play, and jams

    def _meetings(self) -> Iterator[tuple[SideTerms, SideTerms]]:
        """A couple in front and one on the back, all that meet at some position of the driver within a pitch."""
        pitch, (start, end) = self.contact.pitches[0], (self.contact.start, self.contact.end)
        ends = np.mod([start, end, -start, -end], pitch)
        phases = _UNEVEN_PHASES if self._uneven else _PHASES
        for u in (*(np.arange(phases) * (pitch / phases)), *ends):
            yield from product(self.side_terms(u, False), self.side_terms(u, True))

    def backlash(self) -> Floats:
        """The least play over the whole cycle of teeth (rad of the driven wheel), (trials,).

        What wheels add is apart for each: over all couples that meet, the least sum is that of the least terms.
        """
        best = np.full(self.trials, np.inf)
        for front, back in self._meetings():
            best = np.minimum(best, minimum_sum(front.driver + back.driver, front.driven + back.driven))
        return best + self.contact.backlash

    def tight_place(self) -> TightPlace:
        """The same with the flank that stands out farthest of the four that are nearest there."""
        count = self.trials[0]
        best, where = np.full(count, np.inf), np.zeros((3, count), np.int64)
        gain = np.full(count, float(self.contact.normal.max()))
        for front, back in self._meetings():
            backlash, n1, n2 = minimum_sum_places(front.driver + back.driver, front.driven + back.driven, count)
            rows = np.flatnonzero(backlash < best)
            if len(rows):
                best[rows] = backlash[rows]
                where[:, rows] = self._farthest_out(front, back, rows, n1[rows], n2[rows])
        return TightPlace(best + self.contact.backlash, where[0], where[1], where[2], gain)

    def _farthest_out(self, front: SideTerms, back: SideTerms, rows: Ints, n1: Ints, n2: Ints) -> Ints:
        """Wheel, tooth and side of the flank that stands out farthest of the four that meet in some trials."""
        z1, z2 = self.teeth
        # what each of the four leaves to the play: the least stands out farthest
        left = np.stack(
            [
                terms_at(front.driver, rows, n1),
                terms_at(back.driver, rows, n1),
                terms_at(back.driven, rows, n2),
                terms_at(front.driven, rows, n2),
            ]
        )
        teeth = np.stack(
            [
                (n1 - front.pitches) % z1,
                (n1 - back.pitches) % z1,
                (n2 - back.pitches + 1) % z2,
                (n2 - front.pitches) % z2,
            ]
        )
        flank = left.argmin(axis=0)
        return np.stack([flank // 2, np.take_along_axis(teeth, flank[None], axis=0)[0], flank % 2])

    def filed(self, low: tuple[Floats, Floats]) -> DisplacedPair:
        """The pair with its flanks lowered, arrays (trials, 2 sides, z) of both wheels."""
        first, second = (
            wheel.filed(each[:, 0], each[:, 1]) for wheel, each in zip((self.first, self.second), low, strict=True)
        )
        return DisplacedPair(self.contact, first, second, self.shift)

    def verdicts(self) -> MeshingVerdicts:
        """What becomes of each trial over the whole cycle of teeth."""
        clash, dwell = self.overtaken(True), self.overtaken(False)
        return MeshingVerdicts(self.backlash(), clash, dwell, self.disengaged(), np.zeros(self.trials, bool))

    def disengaged(self) -> Bools:
        """Whether somewhere no couple is in reach (trials,)."""
        at = self.contact
        whole = (at.end + at.leaving.most) - (at.start - at.entering.most)
        gap = at.pitches[0] + np.roll(self.first.place, -1, -1) - self.first.place
        found: Bools = np.broadcast_to((gap > whole).any(axis=-1), self.trials).copy()
        return found

    def overtaken(self, entering: bool) -> Bools:
        """Whether a tip meets a tip: where a couple comes in, or where it leaves the driven wheel standing (trials,).

        So it is where the neighbour that should hold the driven wheel lets it lag more than the couple itself.
        """
        at = self.contact
        x, j = (at.start - at.entering.most, 1) if entering else (at.end + at.leaving.most, -1)
        x += 1e-9 * at.pitches[0] * (1 if entering else -1)
        other = x + j * at.pitches[0]
        nominal = float(self._even(np.array(other))), float(self._even(np.array(x)))
        if not nominal[0] + self._spread > nominal[1]:
            return np.zeros(self.trials, bool)
        # tips fall behind steeply beyond their path: each couple is looked at where its own tips meet
        late = self.first.place
        own, mate = self._side(x, x, 0, False, late), self._side(x, other, j, False, late)
        with np.errstate(invalid="ignore"):
            # own less the neighbour's, turned round: below 0 where the neighbour lags more
            margin = minimum_sum(own.driver - mate.driver, own.driven - mate.driven)
        found: Bools = np.broadcast_to(~(margin >= 0), self.trials).copy()
        return found

    # ----------------------------------------------------------------------------------------------- angle by angle

    def lag(self, rows: Ints, S: Floats, k: Ints, back: bool = False) -> Floats:
        """How far couples k let the driven wheel lag (on the back: lead) where the driver stands at S (rad)."""
        at, sign = self.contact, -1.0 if back else 1.0
        one, two, ratio = self.first, self.second, float(self.contact.ratio)
        i, j = k % one.z, (k + back) % two.z
        place = of_teeth(one.place, rows, i)
        x = sign * (S - k * at.pitches[0] - place)
        (flank1, low1), (flank2, low2) = one.flanks(back), two.flanks(not back)
        shift = self.shift if np.ndim(self.shift) == 0 else self.shift[rows]
        t1, t2, y1, y2, l1, l2, w, even, apart = self._columns(x)
        lag = sign * (ratio * place - of_teeth(two.place, rows, j)) + even + apart * shift
        lag = lag - of_teeth(flank1, rows, i) * l1 + of_teeth(flank2, rows, j) * l2
        lag = lag + (of_teeth(low1, rows, i) + of_teeth(low2, rows, j)) * w
        turned = ratio * S - sign * even + at.stands + back * at.backlash
        for wheel, angle, across, along in ((one, S, -t1, -y1), (two, turned, t2, y2)):
            if np.any(wheel.e):
                e, towards = (each[rows] if np.ndim(each) else each for each in (wheel.e, wheel.towards))
                lag = lag + e * (sign * across * np.sin(angle - towards) + along * np.cos(angle - towards))
        found: Floats = lag + self._kinks(x, of_teeth(one.tips, rows, i), of_teeth(two.tips, rows, j))
        return found

    def first_lag(self, rows: Ints, S: Floats, back: bool = False) -> tuple[Floats, Ints]:
        """The least lag over all couples at driver angles S, and which has it; infinite where nothing touches."""
        sign, pitch = -1.0 if back else 1.0, self.contact.pitches[0]
        n = np.floor(S / pitch).astype(np.int64)
        low, high = self.widest
        ends = sorted((sign * low / pitch, sign * high / pitch))
        best, which = np.full(S.shape, np.inf), n
        for j in range(int(np.floor(ends[0])) - 1, int(np.ceil(ends[1])) + 1):
            here = self.lag(rows, S, n - j, back)
            less = here < best
            best, which = np.where(less, here, best), np.where(less, n - j, which)
        return best, which


def even_backlash(contact: DisplacedContact) -> float:
    """The least play of even wheels (rad of the driven wheel)."""
    return float(DisplacedPair(contact, *(DisplacedWheel.even(wheel.z) for wheel in contact.wheels)).backlash())


def mean_lag(contact: DisplacedContact) -> float:
    """The mean lag of even wheels (rad of the driven wheel): 0 at the distance that they are made for."""
    if not contact.even.any():
        return 0.0
    pair = DisplacedPair(contact, *(DisplacedWheel.even(wheel.z) for wheel in contact.wheels))
    S = np.linspace(0.0, contact.pitches[0], _FINE, endpoint=False)
    return float(pair.first_lag(np.zeros(_FINE, np.int64), S)[0].mean())


def terms_at(terms: Any, rows: Ints, n: Ints) -> Floats:
    """Terms of some trials, each of one number."""
    return np.asarray(terms)[rows, n] if np.ndim(terms) > 1 else np.asarray(terms)[n]


def _by_rest(driver: Any, driven: Any) -> list[Floats]:
    """Terms of both wheels by the rest that their numbers leave: those of one rest meet in the cycle."""
    rests = gcd(driver.shape[-1], driven.shape[-1])
    return [each.reshape(*each.shape[:-1], -1, rests) for each in (driver, driven)]


def minimum_sum(driver: Any, driven: Any) -> Floats:
    """The least sum of a term of the driver and one of the driven wheel that meet in the cycle."""
    one, two = _by_rest(driver, driven)
    found: Floats = (one.min(axis=-2) + two.min(axis=-2)).min(axis=-1)
    return found


def minimum_sum_places(driver: Any, driven: Any, count: int) -> tuple[Floats, Ints, Ints]:
    """The same, and the numbers of both terms, (trials,)."""
    one, two = _by_rest(np.atleast_2d(driver), np.atleast_2d(driven))
    rests = one.shape[-1]
    total = one.min(axis=1) + two.min(axis=1)
    rest = np.broadcast_to(total.argmin(axis=1), count)
    own, other = (np.broadcast_to(each.argmin(axis=1), (count, rests))[np.arange(count), rest] for each in (one, two))
    return np.array(np.broadcast_to(total.min(axis=1), count)), own * rests + rest, other * rests + rest
