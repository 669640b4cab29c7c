"""An independent reference for triangular teeth: the closure equations of the source in 50 digits, for each tooth pair.

The equations are those of F. Sorge, "A note on the mechanics of ancient gear systems", Eqs. (1)-(19) and (28)-(33),
except for its errata: the smaller root in Eq. (16), signs and brackets in Eqs. (31) and (33). If the half angles
differ, the flank in contact is the driver's in approach and the driven wheel's in recess. Float input is treated as
exact. Nothing here is fast, or stable at low precision.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property, partial
from itertools import pairwise
from random import Random
from typing import Any, NamedTuple

import mpmath
import numpy as np

mp = mpmath.mp.clone()
mp.dps = 50

APPROACH, RECESS, DWELL = "approach", "recess", "dwell"
TINY = mp.mpf(10) ** -30  # of a pitch: ends of smooth stretches are looked at from this far within


@dataclass(frozen=True)
class Segment:
    """An interval of alpha_1 driven by one tooth pair, or (with `held`) with the driven wheel at rest at alpha_2."""

    phase: str
    start: Any
    end: Any
    k: int
    held: Any = None


class Pair:
    """One pair of wheels, the first driving. `m` is mpmath by default, or numpy for many angles in double precision."""

    def __init__(self, z1, z2, R1, R2, beta1, beta2, excess, m: Any = mp) -> None:
        self.m = m
        number = mp.mpf if m is mp else float
        self.z1, self.z2 = z1, z2
        self.R1, self.R2, self.b1, self.b2, self.excess = (number(x) for x in (R1, R2, beta1, beta2, excess))
        if m is mp:
            self.asin, self.acos, self.atan2, self.cos_sin = mp.asin, mp.acos, mp.atan2, mp.cos_sin
        else:
            self.asin, self.acos, self.atan2, self.cos_sin = np.arcsin, np.arccos, np.arctan2, _cos_sin
        (self.cos_b1, self.sin_b1), (self.cos_b2, self.sin_b2) = self.cos_sin(self.b1), self.cos_sin(self.b2)
        pi = m.pi
        h1 = self.R1 * (1 - self.sin_b1 / m.sin(self.b1 + pi / z1))
        h2 = self.R2 * (1 - self.sin_b2 / m.sin(self.b2 + pi / z2))
        self.h = min(h1, h2)
        self.minimum = self.R1 + self.R2 - self.h
        self.D = self.minimum + self.excess * self.minimum
        self.p1, self.p2 = 2 * pi / z1, 2 * pi / z2
        self.ratio = self.p2 / self.p1

    @classmethod
    def of(cls, given: Any, m: Any = mp) -> Pair:
        """Return the pair with the declared numbers of `given`, without derived values."""
        return cls(given.z1, given.z2, given.R1, given.R2, given.beta1, given.beta2, given.excess, m)

    @property
    def beta1(self) -> Any:
        """Half angle of the driver's teeth."""
        return self.b1

    @property
    def beta2(self) -> Any:
        """Half angle of the driven wheel's teeth."""
        return self.b2

    def swapped(self) -> Pair:
        """Return the pair with the second wheel driving."""
        return Pair(self.z2, self.z1, self.R2, self.R1, self.b2, self.b1, self.excess, self.m)

    # ------------------------------------------------------------------------------------------------------ one couple

    @cached_property
    def touches(self) -> bool:
        """True if the tip circles overlap."""
        return self.D < self.R1 + self.R2

    @cached_property
    def amax(self) -> Any:
        """alpha_1max, Eq. (4)."""
        return self.acos((self.D**2 + self.R1**2 - self.R2**2) / (2 * self.D * self.R1))

    @cached_property
    def tips(self) -> Any:
        """alpha_1max + alpha_2max: inclination of a flank at the ends of the reach, beyond its half angle."""
        return self.amax + self.acos((self.D**2 + self.R2**2 - self.R1**2) / (2 * self.D * self.R2))

    @cached_property
    def entry(self) -> Any:
        """Angle of the first touch: at the tips, or earlier if a leaning flank touches the driven tip circle."""
        if self.b1 + self.tips <= self.m.pi / 2:
            return self.amax
        return max(self.amax, self.asin(min(1, (self.R2 + self.R1 * self.sin_b1) / self.D)) - self.b1)

    @cached_property
    def exit(self) -> Any:
        """Angle at which driving ends: at the tips, or earlier if the driven flank leans so far that tau is 0."""
        if self.b2 + self.tips <= self.m.pi / 2:
            return -self.amax
        precise = self if self.m is mp else Pair.of(self)
        found = root(
            lambda x: precise.lean(x, RECESS) - mp.pi / 2, lambda x: -1 - precise.speed(x, RECESS), -precise.amax, 0
        )
        return found if self.m is mp else float(found)

    @cached_property
    def matching(self) -> Any:
        """alpha_1m, Eq. (10): both flanks on one line, alpha_1 + beta_1 = beta_2 - alpha_2; infinite without one."""
        sine = (self.R1 * self.sin_b1 + self.R2 * self.sin_b2) / self.D
        return self.asin(sine) - self.b1 if sine < 1 else self.m.inf

    def phase(self, x: Any) -> str:
        """Return the phase at alpha_1 = x."""
        return APPROACH if x >= self.matching else RECESS

    def approach(self, x: Any) -> tuple[Any, Any]:
        """Return alpha_2 and v, Eqs. (7) and (9)."""
        cos, sin = self.cos_sin(x + self.b1)
        sine = (self.D * sin - self.R1 * self.sin_b1) / self.R2
        y = self.asin(sine) - x - self.b1
        return y, self.R1 * self.cos_b1 - self.D * cos + self.R2 * self.m.sqrt(1 - sine**2)

    def recess(self, x: Any) -> tuple[Any, Any]:
        """Return alpha_2 and v, Eqs. (17) and (16)."""
        cos, sin = self.cos_sin(x)
        square = self.D**2 + self.R1**2 - 2 * self.D * self.R1 * cos
        v = self.R2 * self.cos_b2 - self.m.sqrt(square - (self.R2 * self.sin_b2) ** 2)
        seen = self.atan2(self.R1 * sin, self.D - self.R1 * cos)
        return seen - self.atan2(v * self.sin_b2, self.R2 - v * self.cos_b2), v

    def angle(self, x: Any, phase: str | None = None) -> Any:
        """Return alpha_2 at x."""
        return (self.approach if (phase or self.phase(x)) == APPROACH else self.recess)(x)[0]

    def speed(self, x: Any, phase: str | None = None, y: Any = None) -> Any:
        """Return tau at x, Eqs. (12) and (19), from alpha_2 if it is known."""
        m = self.m
        if (phase or self.phase(x)) == APPROACH:
            cos, sin = self.cos_sin(x + self.b1)
            root = m.sqrt(self.R2**2 - (self.D * sin - self.R1 * self.sin_b1) ** 2)
            return self.D * cos / root - 1
        y = self.recess(x)[0] if y is None else y
        arm = self.R1 * m.cos(self.b2 - x - y)
        return arm / (self.D * m.cos(self.b2 - y) - arm)

    def lean(self, x: Any, phase: str | None = None) -> Any:
        """Return the angle between flank and other tooth's axis: beta + a1 + a2, or beta - a1 - a2."""
        phase = phase or self.phase(x)
        y = self.angle(x, phase)
        return self.b1 + x + y if phase == APPROACH else self.b2 - x - y

    def arms(self, x: Any, friction: Any, phase: str | None = None) -> tuple[Any, Any]:
        """Return the moment arms b1 and b2 of the force between the teeth, Eqs. (28) to (31)."""
        return self._forced(x, friction, phase or self.phase(x))[1:]

    def _forced(self, x: Any, friction: Any, phase: str) -> tuple[Any, Any, Any]:
        """Return tau and both moment arms."""
        m = self.m
        y = self.angle(x, phase)
        tau = self.speed(x, phase, y)
        if phase == APPROACH:
            phi = m.atan(friction) * m.sign(y)
            cc = m.cos(self.b1 + x + y) * m.cos(self.b1 + x + phi)
            ss = m.sin(y) * m.sin(phi)
            scale = self.R2 / m.cos(self.b1 + x)
            return tau, scale * (tau * cc + ss), scale * (cc - ss)
        phi = m.atan(friction) * m.sign(x)
        cc = m.cos(self.b2 - x - y) * m.cos(self.b2 - y + phi)
        ss = m.sin(x) * m.sin(phi)
        scale = self.R1 / m.cos(self.b2 - y)
        return tau, scale * (cc + ss), scale * (cc / tau - ss)

    def efficiency(self, x: Any, friction: Any, phase: str | None = None) -> Any:
        """Return the efficiency tau b2 / b1, Eqs. (32) and (33)."""
        tau, b1, b2 = self._forced(x, friction, phase or self.phase(x))
        return tau * b2 / b1

    # -------------------------------------------------------------------------------------------------- every couple

    def tooth_pairs(self, t: Any) -> range:
        """Return every tooth pair whose driving tooth is within reach at position t."""
        return range(int(mp.ceil((self.exit - t) / self.p1)), int(mp.floor((self.entry - t) / self.p1)) + 1)

    def first(self, t: Any) -> Any:
        """Return U(t) = min over every tooth pair of f(t + k p1) - k p2; infinite if no tooth pair is in reach."""
        return min((self.angle(t + k * self.p1) - k * self.p2 for k in self.tooth_pairs(t)), default=mp.inf)

    @cached_property
    def envelope(self) -> list[Segment]:
        """Driving tooth pairs over the pitch of t that ends where a pair enters, by time; gaps are omitted."""
        top, tiny = self.entry, TINY * self.p1
        cuts = {(top - end) % self.p1 for end in (self.exit, self.matching) if self.exit <= end <= top}
        marks = sorted({mp.mpf(0), self.p1, *cuts})
        found: list[Segment] = []
        for early, late in pairwise(marks):
            if late - early > 4 * tiny:
                found += self._cell(top - early - tiny, top - late + tiny)
        return _joined(found, self.p1)

    def _cell(self, high: Any, low: Any) -> list[Segment]:
        """Return the intervals of a range of t in which every tooth pair remains in reach and in one phase."""
        ks = self.tooth_pairs((high + low) / 2)
        phases = {k: self.phase((high + low) / 2 + k * self.p1) for k in ks}

        def value(k: int, t: Any) -> Any:
            return self.angle(t + k * self.p1, phases[k]) - k * self.p2

        def lowest(t: Any) -> int:
            return min(ks, key=lambda k: value(k, t))

        def split(high: Any, low: Any, a: int, b: int) -> list[tuple[Any, Any, int]]:
            if a == b:
                inside = [low + (high - low) * n / 4 for n in (1, 2, 3)]
                others = [(t, k) for t in inside if (k := lowest(t)) != a]
                if not others:
                    return [(high, low, a)]
                t, k = others[0]
                return split(high, t, a, k) + split(t, low, k, b)
            t = root(
                lambda t: value(a, t) - value(b, t),
                lambda t: self.speed(t + a * self.p1, phases[a]) - self.speed(t + b * self.p1, phases[b]),
                low,
                high,
            )
            k = lowest(t)
            if k in (a, b) or value(k, t) > value(a, t) - TINY * self.p2:
                return split(high, t, a, a) + split(t, low, b, b)
            return split(high, t, a, k) + split(t, low, k, b)

        if not ks:
            return []
        return [
            Segment(phases[k], upper + k * self.p1, lower + k * self.p1, k)
            for upper, lower, k in split(high, low, lowest(high), lowest(low))
        ]

    @cached_property
    def path(self) -> list[Segment]:
        """Running minimum of U over a pitch, in order of time, with a dwell wherever it does not decrease."""
        once = self.envelope
        twice = once + [Segment(s.phase, s.start, s.end, s.k + 1) for s in once]
        y, t = mp.inf, mp.inf
        found: list[Segment] = []
        held = None
        for s in twice:
            start, turned = s.start - s.k * self.p1, s.k * self.p2
            high, low = self.angle(s.start, s.phase) - turned, self.angle(s.end, s.phase) - turned
            apart = t - start > TINY * self.p1 * 10
            if high > y + TINY * self.p2 * 10 or (apart and y < mp.inf):
                held = held or found[-1]
            if low >= y:
                t = s.end - s.k * self.p1
                continue
            x = s.start
            if high > y:
                x = root(
                    lambda x, s=s, turned=turned, y=y: self.angle(x, s.phase) - turned - y,
                    lambda x, s=s: self.speed(x, s.phase),
                    s.end,
                    s.start,
                )
            if held:
                until = x + (held.k - s.k) * self.p1
                found.append(Segment(DWELL, held.end, until, held.k, self.angle(held.end, held.phase)))
                held = None
            found.append(Segment(s.phase, x, s.end, s.k))
            y, t = low, s.end - s.k * self.p1
        lasts = [at for at, s in enumerate(found) if not s.held]
        last = found[lasts[-1]]
        since = next(at for at, s in enumerate(found) if (s.phase, s.k) == (last.phase, last.k - 1) and _near(s, last))
        return found[since + 1 : lasts[-1] + 1]

    def at(self, t: Any) -> Any:
        """Return y of the driven wheel at t: the minimum U over all earlier positions, from the segments."""
        for s in self.path:
            over = mp.floor((s.start - t) / self.p1 - s.k) + s.k
            x = t + over * self.p1
            if x >= s.end:
                y = self.angle(x, s.phase) if s.held is None else s.held
                return y - over * self.p2
        raise AssertionError("the path has a hole")

    def error(self, S: Any, direction: int = 1) -> Any:
        """Return the transmission error q - (z1/z2) S at the forward angle S."""
        t = -mp.mpf(S) * direction
        lag = self.at(t) - self.ratio * t
        return -lag if direction > 0 else self.p2 + lag

    @cached_property
    def jumps(self) -> list[tuple[Any, Any]]:
        """tau before and after each change of tooth pair, phase or dwell at which contact begins."""
        speeds = [
            (mp.mpf(0),) * 2 if s.held is not None else (self.speed(s.start, s.phase), self.speed(s.end, s.phase))
            for s in self.path
        ]
        return [(speeds[at - 1][1], speeds[at][0]) for at in range(len(speeds)) if self.path[at].held is None]

    @cached_property
    def error_range(self) -> tuple[Any, Any]:
        """Minimum and maximum transmission error."""
        lags = []
        for s in self.path:
            lags += [
                (s.held if s.held is not None else self.angle(x, s.phase)) - self.ratio * x for x in (s.start, s.end)
            ]
            if s.held is None:
                lags += [self.angle(x, s.phase) - self.ratio * x for x in self._mean_speeds(s)]
        return -max(lags), -min(lags)

    def _mean_speeds(self, s: Segment) -> list[Any]:
        """Return the angles within a segment at which tau is z1/z2, from sign changes on a grid."""
        step = TINY * (s.start - s.end)

        def value(x: Any) -> Any:
            return self.speed(x, s.phase) - self.ratio

        def slope(x: Any) -> Any:
            return (value(x) - value(x - step)) / step

        grid = [s.end + (s.start - s.end) * n / 16 for n in range(17)]
        signs = [value(x) > 0 for x in grid]
        return [
            root(value, slope, low, high)
            for low, high, a, b in zip(grid, grid[1:], signs, signs[1:], strict=False)
            if a != b
        ]

    def mean_efficiency(self, friction: Any) -> tuple[Any, Any]:
        """Return means over the driver's angle to 25 digits: of eta (Eq. 34), and tau over the mean of tau/eta."""
        eta = tau = inverse = width = mp.mpf(0)
        for s in self.path:
            if s.held is not None:
                continue
            marks = [s.end, *self._centre(s), s.start]
            # all three are asked at the same places
            speed = cache(partial(self.speed, phase=s.phase))
            efficiency = cache(partial(self.efficiency, friction=friction, phase=s.phase))
            eta += integral(efficiency, marks)
            tau += integral(speed, marks)
            inverse += integral(lambda x, tau=speed, eta=efficiency: tau(x) / eta(x), marks)
            width += s.start - s.end
        return eta / width, tau / inverse

    def _centre(self, s: Segment) -> list[Any]:
        """Return the angle at which the contact crosses the line of centres."""
        if s.phase == RECESS:
            return [mp.mpf(0)] if s.end < 0 < s.start else []
        if not self.angle(s.end, APPROACH) < 0 < self.angle(s.start, APPROACH):
            return []
        return [root(lambda x: self.angle(x, APPROACH), lambda x: self.speed(x, APPROACH), s.end, s.start)]


def integral(value: Callable[[Any], Any], marks: list[Any]) -> Any:
    """Return the integral over the marks to 25 digits, more than the compared floats have."""
    with mp.workdps(25):
        return mp.quad(value, marks)


def root(value: Callable[[Any], Any], slope: Callable[[Any], Any], low: Any, high: Any) -> Any:
    """Return the root between low and high, by Newton's method with bisection where it converges slowly."""
    low, high = mp.mpf(low), mp.mpf(high)
    at_low = value(low)
    if at_low == 0:
        return low
    finest = (high - low) * mp.mpf(10) ** -42
    x, last = (low + high) / 2, high - low
    for _ in range(500):
        here = value(x)
        if here == 0:
            return x
        low, high = (x, high) if (here > 0) == (at_low > 0) else (low, x)
        steep = slope(x)
        step = x - here / steep if steep else low
        if abs(step - x) < finest or high - low < finest:
            return step
        # a step that leaves the bracket, or is more than half the one before, is no quick way to the root
        quick = low < step < high and 2 * abs(step - x) < last
        last, x = (abs(step - x), step) if quick else (high - low, (low + high) / 2)
    raise AssertionError("no root")


def _cos_sin(x: Any) -> tuple[Any, Any]:
    """Return cosine and sine like mpmath's function, for floats."""
    return np.cos(x), np.sin(x)


def _near(one: Segment, other: Segment) -> bool:
    return abs(one.end - other.end) < mp.mpf(10) ** -20


def _joined(found: list[Segment], pitch: Any) -> list[Segment]:
    """Merge neighbouring segments of one tooth pair in one phase, also across the end of the pitch."""
    near = TINY * pitch * 10
    joined: list[Segment] = []
    for s in found:
        last = joined[-1] if joined else None
        if last and (last.phase, last.k) == (s.phase, s.k) and abs(last.end - s.start) < near:
            joined[-1] = Segment(s.phase, last.start, s.end, s.k)
        else:
            joined.append(s)
    if len(joined) > 1:
        first, last = joined[0], joined[-1]
        if (first.phase, first.k + 1) == (last.phase, last.k) and abs(last.end - first.start) < near:
            joined = [*joined[1:-1], Segment(last.phase, last.start, first.end, last.k)]
    return joined


def first_of_all(pair: Pair, t: np.ndarray) -> np.ndarray:
    """Return U at many positions t over all tooth pairs in reach, in double precision (`pair` built with numpy)."""
    low = int(np.floor((pair.exit - t.max()) / pair.p1))
    high = int(np.ceil((pair.entry - t.min()) / pair.p1))
    k = np.arange(low, high + 1).reshape(-1, *[1] * np.ndim(t))
    x = t + k * pair.p1
    inside = (pair.exit <= x) & (x <= pair.entry)
    y = np.full(x.shape, np.inf)
    y[inside] = angles(pair, x[inside]) - np.broadcast_to(k, x.shape)[inside] * pair.p2
    return y.min(axis=0, initial=np.inf)


def angles(pair: Pair, x: np.ndarray) -> np.ndarray:
    """Return alpha_2 at many x within reach, in double precision."""
    y = np.empty_like(x)
    early = x >= pair.matching
    y[early] = pair.approach(x[early])[0]
    y[~early] = pair.recess(x[~early])[0]
    return y


def others(pair: Pair, x: float) -> float:
    """Return the minimum angle that any other tooth pair permits if one is at alpha_1 = x, as alpha_2 of that pair."""
    minimum = np.inf
    for k in range(int(np.floor((pair.exit - x) / pair.p1)), int(np.ceil((pair.entry - x) / pair.p1)) + 1):
        at = x + k * pair.p1
        if k and pair.exit <= at <= pair.entry:
            minimum = min(minimum, float(angles(pair, np.array([at]))[0]) - k * pair.p2)
    return minimum


def pushed(pair: Pair, t: np.ndarray) -> np.ndarray:
    """Return the angle of the driven wheel at many t: at the driving tooth pair, or where the last pair left it."""
    leaves = angles(pair, np.array([pair.exit]))[0] + np.ceil((t - pair.exit) / pair.p1) * pair.p2
    return np.minimum(first_of_all(pair, t), leaves)


def minimum_backlash(pair: Pair) -> float:
    """Return the minimum of y(t) - L(t), L(t) = -U(-t) - p2, from a grid that is refined about its lowest positions."""

    def backlash(t: np.ndarray) -> np.ndarray:
        return pushed(pair, t) + first_of_all(pair, -t) + pair.p2

    step = pair.p1 / 400
    grid = (np.arange(401) + 0.001) * step
    found = backlash(grid)
    centres, width = grid[np.argsort(found)[:4]], step
    best = np.inf
    for _ in range(8):
        t = np.linspace(centres - width, centres + width, 41)
        here = backlash(t)
        centres, width = t[here.argmin(axis=0), np.arange(4)], width / 10
        best = min(best, here.min())
    return float(best)


def entry_margin(pair: Pair) -> float:
    """Return the distance of an entering tooth pair above the driven wheel; below 0, a tip is hit."""
    now = others(pair, pair.entry)
    if now == np.inf:
        return np.inf
    enters, leaves = angles(pair, np.array([pair.entry, pair.exit]))
    return float(enters - min(now, leaves + np.ceil((pair.entry - pair.exit) / pair.p1) * pair.p2))


def exit_margin(pair: Pair) -> float:
    """Return the distance of another tooth pair below the driven wheel at an exit; below 0, contact is lost."""
    return float(angles(pair, np.array([pair.exit]))[0]) - others(pair, pair.exit)


def verdict(pair: Pair, rounding: float = 1e-9) -> str:
    """Return the verdict of the scan for a pair whose flanks do not overhang; empty if it is within rounding error."""
    margins = minimum_backlash(pair), entry_margin(pair), exit_margin(pair)
    if any(abs(margin) < rounding * pair.p2 for margin in margins):
        return ""
    for kind, margin in zip(("jam", "clash", "dwell"), margins, strict=True):
        if margin < 0:
            return kind
    return "runs"


class Given(NamedTuple):
    """Numbers that declare a pair."""

    z1: int
    z2: int
    R1: float
    R2: float
    beta1: float
    beta2: float
    excess: float


def drawn(random: Random, most: float, shape: str = "any") -> Given:
    """Return a pair of 3 to `most` teeth, ratios up to 1000, any half angle with a valley, any clearance with
    overlapping tips.

    `shape` "near" keeps the radii within half of pitch-true, the half angles within 80 deg and 0.98 of the valley.
    """
    while True:
        z1 = round(_spread(random, 3, most))
        z2 = round(z1 * _spread(random, 1e-3, 1e3) if random.random() < 0.5 else z1 * _spread(random, 0.1, 10))
        if not 3 <= z2 <= most:
            continue
        b1, b2 = (_aperture(random, z, shape) for z in (z1, z2))
        if random.random() < 0.5:
            b1 = b2 = min(b1, b2)
        rule = random.choice(["equal depth", "pitch-true", "any"])
        R1, R2 = 1.0, z2 / z1
        if rule == "equal depth":
            h1, h2 = (1 - mp.sin(b) / mp.sin(b + mp.pi / z) for z, b in ((z1, b1), (z2, b2)))
            R2 = float(h1 / h2)
        elif rule == "any":
            R1 = random.uniform(0.1, 30)
            R2 = R1 * z2 / z1 * _spread(random, 0.8, 1.25)
        if shape == "near" and not 0.67 < R2 * z1 / (R1 * z2) < 1.5:
            continue
        pair = Pair(z1, z2, R1, R2, b1, b2, 0.0)
        most_excess = float(pair.h / pair.minimum)
        share = random.uniform(0.001, 0.999) if random.random() < 0.7 else _spread(random, 1e-6, 0.999)
        return Given(z1, z2, R1, R2, b1, b2, most_excess * share)


def _spread(random: Random, low: float, high: float) -> float:
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _aperture(random: Random, z: int, shape: str) -> float:
    valley = 90 - 180 / z
    top = min(80.0, 0.98 * valley) if shape == "near" else 0.999 * valley
    return math.radians(random.uniform(min(1.0, top / 3), top))
