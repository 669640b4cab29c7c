"""Pair of wheels with displaced flanks: the tooth pair that drives, and the backlash to the opposite flanks.

Teeth and tooth pairs are numbered as in `cut_wheel`. The trailing flank of the driver faces the leading flank of the
driven tooth k + 1. Each tooth pair would by itself cause a certain lag of the driven wheel, equation (2) of
docs/cut-by-hand.md. The pair of drive flanks with the smallest lag drives, and its distance from the nearest pair of
coast flanks is the backlash. Lengths are in modules; for bevel gears they are angles (rad) on the unit sphere.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import gcd, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.workshop.cutting.cut_wheel import of_teeth
from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts, TightPlace, by_residue, extreme_sum

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats, Ints
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact


_OF_TEETH = ("place", "tip", "leading", "trailing", "leading_low", "trailing_low")
_PHASES = 4  # positions per pitch, besides the ends of the paths of contact: in between, lags are smooth
_UNEVEN_PHASES = 32  # positions per pitch if the lag of perfect wheels varies along their path of contact
_FINE = 512  # positions per pitch for the mean of a lag, which has a few kinks


@dataclass(frozen=True, slots=True)
class DisplacedWheel:
    """Wheel whose flanks are displaced by manufacturing errors.

    Arrays have shape (..., z) for z teeth; the leading axes index the trials. `e` and `towards` have one value for each
    trial. Lengths are in modules (bevel gears: rad).
    """

    place: Floats
    """Angle of each tooth behind its nominal position [rad]."""
    tip: Floats
    """Height of each tip above its nominal height [module]."""
    leading: Floats
    """Rotation of each leading flank about its pitch point [rad], positive if the flank becomes flatter."""
    trailing: Floats
    """Rotation of each trailing flank about its pitch point [rad], positive if the flank becomes flatter."""
    leading_low: Floats
    """Depth of material removed from each leading flank along its normal [module]."""
    trailing_low: Floats
    """Depth of material removed from each trailing flank along its normal [module]."""
    e: Any = 0.0
    """Eccentricity: distance of the centre of the teeth from the axis [module]."""
    towards: Any = 0.0
    """Direction of the eccentricity from the first tooth [rad], positive against the direction of rotation."""

    @classmethod
    def even(cls, z: int) -> DisplacedWheel:
        """Return a wheel with z teeth and without errors."""
        return cls(*(np.zeros(z) for _ in _OF_TEETH))

    @property
    def z(self) -> int:
        """Number of teeth."""
        return int(self.place.shape[-1])

    @property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading (trial) axes of the arrays; () for a single wheel."""
        shapes = (getattr(self, name).shape[:-1] for name in _OF_TEETH)
        return np.broadcast_shapes(*shapes, np.shape(self.e), np.shape(self.towards))

    @property
    def tips(self) -> Floats:
        """Height of each tip above its nominal height, including the effect of the eccentricity [module]."""
        if not np.any(self.e):
            return self.tip
        angle = np.arange(self.z) * (2 * pi / self.z) - np.asarray(self.towards)[..., None]
        # to first order in the eccentricity, as all displacements of flanks
        found: Floats = self.tip + np.asarray(self.e)[..., None] * np.cos(angle)
        return found

    def flanks(self, trailing: bool) -> tuple[Floats, Floats]:
        """Return rotations [rad] and removed depths [module] of the trailing (if `trailing`) or the leading flanks."""
        return (self.trailing, self.trailing_low) if trailing else (self.leading, self.leading_low)

    @property
    def cuttable(self) -> Bools:
        """Mask of shape (..., z): True for a tooth if pitch deviations do not exchange it with the next tooth."""
        found: Bools = np.roll(self.place, -1, -1) - self.place > -2 * pi / self.z
        return found

    def taken(self, part: slice | NDArray[np.int64]) -> DisplacedWheel:
        """Return the wheels of the selected trials."""
        teeth = {name: getattr(self, name) for name in _OF_TEETH}
        some = {name: each[part] if each.ndim > 1 else each for name, each in teeth.items()}
        e, towards = (each[part] if np.ndim(each) else each for each in (self.e, self.towards))
        return DisplacedWheel(**some, e=e, towards=towards)

    def mirrored(self, first: int = 0) -> DisplacedWheel:
        """Return the mirror image of this wheel; its tooth i is the image of tooth `first` - i."""
        # mirroring reverses the order of the teeth and exchanges their flanks
        order = (first - np.arange(self.z)) % self.z
        place, tip, leading, trailing, leading_low, trailing_low = (
            getattr(self, name)[..., order] for name in _OF_TEETH
        )
        towards = first * (2 * pi / self.z) - np.asarray(self.towards)
        return DisplacedWheel(-place, tip, trailing, leading, trailing_low, leading_low, self.e, towards)

    def filed(self, leading: Floats, trailing: Floats) -> DisplacedWheel:
        """Return this wheel with the depths `leading` and `trailing` removed from its flanks [module], (trials, z)."""
        return replace(self, leading_low=self.leading_low + leading, trailing_low=self.trailing_low + trailing)


@dataclass(frozen=True)
class SideTerms:
    """Lags of the driven wheel [rad] due to the tooth pairs on one side of the teeth, at a driver angle plus n pitches.

    The lag is driver[n mod z1] + driven[n mod z2], where z1 and z2 are the tooth numbers. Both arrays have the shape
    (trials, z).
    """

    driver: Any
    """Terms of the lag that depend on the driver."""
    driven: Any
    """Terms of the lag that depend on the driven wheel."""
    pitches: int
    """Offset of the tooth numbers: entry n of `driver` is the term of driver tooth n - `pitches`."""


@dataclass(frozen=True)
class DisplacedPair:
    """Pair of wheels with displaced flanks. The first wheel drives.

    `shift` is the increase of the centre distance [module]: a scalar, or an array with a value for each trial.
    """

    contact: DisplacedContact
    first: DisplacedWheel
    second: DisplacedWheel
    shift: Any = 0.0

    @property
    def count(self) -> int:
        """Number of tooth pairs in a full meshing cycle."""
        return self.first.z * self.second.z // gcd(self.first.z, self.second.z)

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the driver and of the driven wheel."""
        return self.first.z, self.second.z

    @cached_property
    def trials(self) -> tuple[int, ...]:
        """Shape of the leading (trial) axes of both wheels; () for a single pair."""
        return np.broadcast_shapes(self.first.trials, self.second.trials, np.shape(self.shift))

    def taken(self, rows: Ints) -> DisplacedPair:
        """Return the gear pairs of the trials with the given indices."""
        shift = self.shift if np.ndim(self.shift) == 0 else self.shift[rows]
        return DisplacedPair(self.contact, self.first.taken(rows), self.second.taken(rows), shift)

    @cached_property
    def widest(self) -> tuple[float, float]:
        """First and last driver angle at which a tooth can touch its mate, relative to its nominal position [rad]."""
        at, (leaving, entering) = self.contact, self._end_margins
        return at.start - at.entering.most - entering, at.end + at.leaving.most + leaving

    @property
    def _lag_varies(self) -> bool:
        """True if the lag of the driven wheel of a perfect pair varies along the path of contact."""
        even = self.contact.even
        return bool(even.any() and np.ptp(even) > 0)

    @cached_property
    def _end_margins(self) -> tuple[float, float]:
        """Maximum angles by which errors extend contact beyond its end, and before its start [rad of the driver]."""
        late = float(np.abs(self.first.place).max(initial=0.0))
        tips = (float(np.abs(each.tips).max(initial=0.0)) for each in (self.first, self.second))
        leaving, entering = (late + longer * tip for longer, tip in zip(self.contact.longer, tips, strict=True))
        return leaving, entering

    # ------------------------------------------------------------------------------------------------- pair by pair

    def side_terms(self, u: float, back: bool) -> Iterator[SideTerms]:
        """Yield the lag of the driven wheel that each possible tooth contact would cause at the driver angle u, 0 <= u
        < pitch [rad], as two terms: one depends on the driver, the other on the driven wheel.

        back   True for the coast flanks, False for the drive flanks
        """
        sign = -1.0 if back else 1.0
        low, high = self.widest
        pitch = self.contact.pitches[0]
        ends = (low - sign * u) / pitch, (high - sign * u) / pitch
        for steps in range(int(np.ceil(ends[0])), int(np.floor(ends[1])) + 1):
            x = sign * u + steps * pitch
            # infinite beyond the reach of nominal tips, which errors of tips hardly extend
            if np.isfinite(self._tip_lag(np.array(x))):
                yield self._side(u, x, int(sign) * steps, back)

    def _tip_lag(self, x: Floats, tip1: Any = 0.0, tip2: Any = 0.0) -> Floats:
        """Return the lag [rad] due to tips in contact beyond the path of contact, at driver angles x [rad].

        tip1, tip2   errors of the tip heights [module]
        """
        at = self.contact
        beyond = at.leaving(x - at.end - at.longer[0] * tip1)
        return np.asarray(beyond + at.entering(at.start - at.longer[1] * tip2 - x))

    def _along(self, column: Floats, x: Any) -> Any:
        """Return a quantity at the driver angle x [rad]; `column` has its values along the path of contact."""
        at, last = self.contact, len(column) - 1
        return np.interp(x, at.start + (at.end - at.start) / last * np.arange(last + 1), column)

    def _columns(self, x: Any) -> list[Any]:
        """Return `across`, `along`, `tilt` (2 each), `normal`, `even`, `apart` of the contact at driver angle x."""
        at = self.contact
        return [self._along(each, x) for each in (*at.across, *at.along, *at.tilt, at.normal, at.even, at.apart)]

    def _side(self, u: float, x: float, j: int, back: bool, late: Any = None) -> SideTerms:
        """Return the lag of the driven wheel [rad] as one term for each wheel, by equation (2) of docs/cut-by-hand.md.

        u      angle of the driver within a pitch (rad)
        x      driver angle at which the contact of these tooth pairs is evaluated (rad)
        j      number of pitches from u to x; entry n of the terms belongs to driver tooth n - j
        back   True for the coast flanks, False for the drive flanks
        late   angles added to x for each n (rad), shape (trials, z); tips are then assumed to be nominal
        """
        at, sign = self.contact, -1.0 if back else 1.0
        one, two = self.first, self.second
        t1, t2, y1, y2, l1, l2, w, even, apart = map(float, self._columns(x))
        (flank1, low1), (flank2, low2) = one.flanks(back), two.flanks(not back)
        shift = np.asarray(self.shift)[..., None] if np.ndim(self.shift) else self.shift
        ratio = float(at.ratio)
        own = sign * ratio * one.place - flank1 * l1 + low1 * w
        here = x - sign * one.place + (0.0 if late is None else np.roll(late, -j, -1))
        # a tooth with a pitch deviation touches at another position, where the lag of perfect wheels may differ
        own = own + (self._along(at.even, here) if self._lag_varies else even) + apart * shift
        other = -sign * two.place + flank2 * l2 + low2 * w
        if late is not None:
            own = own + self._tip_lag(here)
        elif not at.start + self._end_margins[1] < x < at.end - self._end_margins[0]:
            own = own + self._tip_lag(here, one.tips)
            # pitch deviations of the driver and tip heights of the driven wheel both move the entry; taken separately
            other = other + at.entering(at.start - at.longer[1] * two.tips - x) - at.entering(np.array(at.start - x))
        # a back pair joins the driver's tooth to the next driven tooth
        driver = np.roll(own, j, -1) + self._eccentric_terms(one, u, 0.0, -t1 * sign, -y1)
        turned = ratio * u - sign * even
        driven = np.roll(other, j - back, -1) + self._eccentric_terms(
            two, turned, at.tooth_phase + back * at.backlash, t2 * sign, y2
        )
        return SideTerms(driver, driven, j)

    @staticmethod
    def _eccentric_terms(wheel: DisplacedWheel, turned: float, phase: float, across: float, along: float) -> Any:
        """Return the lag due to the eccentricity of a wheel [rad], for each number n of pitches passed.

        turned, phase   two terms of the angle by which the first tooth is past the line of centres (rad)
        across, along   lag per unit displacement of the teeth across and along the line of centres (rad/module)
        """
        if not np.any(wheel.e):
            return 0.0
        angle = np.arange(wheel.z) * (2 * np.pi / wheel.z) + turned + phase
        angle = angle - np.asarray(wheel.towards)[..., None]
        return np.asarray(wheel.e)[..., None] * (across * np.sin(angle) + along * np.cos(angle))

    # --------------------------------------------------------------------------------------------- backlash, and jams

    def _opposite_pairs(self) -> Iterator[tuple[SideTerms, SideTerms]]:
        """Yield the lags of the driven wheel caused by drive flanks and by coast flanks, for all combinations of tooth
        pairs that can touch simultaneously.
        """
        pitch, (start, end) = self.contact.pitches[0], (self.contact.start, self.contact.end)
        ends = np.mod([start, end, -start, -end], pitch)
        phases = _UNEVEN_PHASES if self._lag_varies else _PHASES
        for u in (*(np.arange(phases) * (pitch / phases)), *ends):
            yield from product(self.side_terms(u, False), self.side_terms(u, True))

    def backlash(self) -> Floats:
        """Return the minimum backlash over the whole meshing cycle [rad of the driven wheel], shape (trials,)."""
        best = np.full(self.trials, np.inf)
        for front, back in self._opposite_pairs():
            best = np.minimum(best, extreme_sum(front.driver + back.driver, front.driven + back.driven, np.minimum))
        return best + self.contact.backlash

    def tight_place(self) -> TightPlace:
        """Return the minimum backlash of each trial, and the most protruding of the four flanks in contact there."""
        count = self.trials[0]
        best, where = np.full(count, np.inf), np.zeros((3, count), np.int64)
        gain = np.full(count, float(self.contact.normal.max()))
        for front, back in self._opposite_pairs():
            backlash, n1, n2 = minimum_sum_places(front.driver + back.driver, front.driven + back.driven, count)
            rows = np.flatnonzero(backlash < best)
            if len(rows):
                best[rows] = backlash[rows]
                where[:, rows] = self._most_protruding(front, back, rows, n1[rows], n2[rows])
        return TightPlace(best + self.contact.backlash, where[0], where[1], where[2], gain)

    def _most_protruding(self, front: SideTerms, back: SideTerms, rows: Ints, n1: Ints, n2: Ints) -> Ints:
        """Return wheel, tooth and side of the one of four flanks in contact that reduces backlash most, (3, rows)."""
        z1, z2 = self.teeth
        # contribution of each of the four to the backlash: the smallest belongs to the most protruding flank
        terms = (front.driver, n1), (back.driver, n1), (back.driven, n2), (front.driven, n2)
        count = self.trials[0]
        left = np.stack([np.broadcast_to(each, (count, each.shape[-1]))[rows, n] for each, n in terms])
        f, b = front.pitches, back.pitches
        teeth = np.stack([(n1 - f) % z1, (n1 - b) % z1, (n2 - b + 1) % z2, (n2 - f) % z2])
        flank = left.argmin(axis=0)
        return np.stack([flank // 2, np.take_along_axis(teeth, flank[None], axis=0)[0], flank % 2])

    def filed(self, depths: tuple[Floats, Floats]) -> DisplacedPair:
        """Return this pair with filed flanks.

        depths   depth removed from each flank of each wheel (module), shape (trials, 2, z); the second index is 0
                 for leading and 1 for trailing flanks
        """
        wheels = zip((self.first, self.second), depths, strict=True)
        first, second = (wheel.filed(each[:, 0], each[:, 1]) for wheel, each in wheels)
        return DisplacedPair(self.contact, first, second, self.shift)

    def verdicts(self) -> MeshingVerdicts:
        """Return the events (jam, clash, dwell, loss of contact) of each trial over the whole meshing cycle."""
        clash, dwell = self.tip_contacts(True), self.tip_contacts(False)
        return MeshingVerdicts(self.backlash(), clash, dwell, self.disengaged())

    def disengaged(self) -> Bools:
        """Return a mask of the trials in which no tooth pair can touch at some position (loss of contact)."""
        at = self.contact
        whole = (at.end + at.leaving.most) - (at.start - at.entering.most)
        gap = at.pitches[0] + np.roll(self.first.place, -1, -1) - self.first.place
        found: Bools = np.broadcast_to((gap > whole).any(axis=-1), self.trials).copy()
        return found

    def tip_contacts(self, entering: bool) -> Bools:
        """Return a mask of the trials in which tips meet at an entry (`entering`: clash) or at an exit (dwell).

        At the first (last) contact of a tooth pair, the preceding (next) pair should drive. Tips meet if that pair lets
        the driven wheel lag more.
        """
        at = self.contact
        x, j = (at.start - at.entering.most, 1) if entering else (at.end + at.leaving.most, -1)
        # just inside the limit, so that rounding does not put the pair out of reach
        x += 1e-9 * at.pitches[0] * (1 if entering else -1)
        other = x + j * at.pitches[0]
        # the lag of tips is steep beyond their path, so each pair is evaluated where its own tips meet
        late = self.first.place
        own, mate = self._side(x, x, 0, False, late), self._side(x, other, j, False, late)
        with np.errstate(invalid="ignore"):
            # negative if the lag of the neighbour is larger
            margin = extreme_sum(own.driver - mate.driver, own.driven - mate.driven, np.minimum)
        found: Bools = np.broadcast_to(~(margin >= 0), self.trials).copy()
        return found

    # ----------------------------------------------------------------------------------------------- angle by angle

    def lag(self, rows: Ints, S: Floats, k: Ints, back: bool = False) -> Floats:
        """Return the lag of the driven wheel due to tooth pairs k at driver angles S, in the trials `rows` [rad].

        back   True for the lead of the driven wheel due to the coast flanks
        """
        at, sign = self.contact, -1.0 if back else 1.0
        one, two, ratio = self.first, self.second, float(self.contact.ratio)
        i, j = k % one.z, (k + back) % two.z
        place = of_teeth(one.place, rows, i)
        # position in the path of contact; the back flanks use the mirrored path
        x = sign * (S - k * at.pitches[0] - place)
        (flank1, low1), (flank2, low2) = one.flanks(back), two.flanks(not back)
        shift = self.shift if np.ndim(self.shift) == 0 else self.shift[rows]
        t1, t2, y1, y2, l1, l2, w, even, apart = self._columns(x)
        # to first order, the contributions of pitch, flank, depth and eccentricity add up
        lag = sign * (ratio * place - of_teeth(two.place, rows, j)) + even + apart * shift
        lag = lag - of_teeth(flank1, rows, i) * l1 + of_teeth(flank2, rows, j) * l2
        lag = lag + (of_teeth(low1, rows, i) + of_teeth(low2, rows, j)) * w
        turned = ratio * S - sign * even + at.tooth_phase + back * at.backlash
        for wheel, angle, across, along in ((one, S, -t1, -y1), (two, turned, t2, y2)):
            if np.any(wheel.e):
                e, towards = (each[rows] if np.ndim(each) else each for each in (wheel.e, wheel.towards))
                lag = lag + e * (sign * across * np.sin(angle - towards) + along * np.cos(angle - towards))
        found: Floats = lag + self._tip_lag(x, of_teeth(one.tips, rows, i), of_teeth(two.tips, rows, j))
        return found

    def minimum_lag(self, rows: Ints, S: Floats, back: bool = False) -> tuple[Floats, Ints]:
        """Return the minimum lag at driver angles S [rad], inf if no teeth touch, and the number of its tooth pair.

        rows   indices of the trials, one for each angle
        back   True for the lead of the driven wheel due to the coast flanks
        """
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
    """Return the minimum backlash of wheels without errors [rad of the driven wheel]."""
    return float(DisplacedPair(contact, *(DisplacedWheel.even(wheel.z) for wheel in contact.wheels)).backlash())


def mean_lag(contact: DisplacedContact) -> float:
    """Return the mean lag of the driven wheel of a perfect pair [rad]; 0 for conjugate flanks at nominal distance."""
    if not contact.even.any():
        return 0.0
    pair = DisplacedPair(contact, *(DisplacedWheel.even(wheel.z) for wheel in contact.wheels))
    # without the end of the pitch, which would count the same position twice
    S = np.linspace(0.0, contact.pitches[0], _FINE, endpoint=False)
    return float(pair.minimum_lag(np.zeros(_FINE, np.int64), S)[0].mean())


def minimum_sum_places(driver: Any, driven: Any, count: int) -> tuple[Floats, Ints, Ints]:
    """Return the minimum of `extreme_sum` in each trial, and the indices of its driver term and its driven term."""
    one, two = by_residue(np.atleast_2d(driver), np.atleast_2d(driven))
    rests = one.shape[-1]
    total = one.min(axis=1) + two.min(axis=1)
    rest = np.broadcast_to(total.argmin(axis=1), count)
    own, other = (np.broadcast_to(each.argmin(axis=1), (count, rests))[np.arange(count), rest] for each in (one, two))
    return np.array(np.broadcast_to(total.min(axis=1), count)), own * rests + rest, other * rests + rest
