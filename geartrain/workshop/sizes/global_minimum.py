"""The least value of a function of a few bounded variables that has kinks, steps and many local minima.

DIRECT (Jones, Perttunen and Stuckman, "Lipschitzian optimization without the Lipschitz constant", 1993) divides the box
where no Lipschitz constant rules out that it holds the least value. What it leaves is polished: one variable by Brent's
bounded method between the neighbours of the lowest samples, several by the method of Nelder and Mead, begun anew where
it ends until nothing is gained. Neither asks for slopes, so that neither is misled by a kink.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np
from scipy.optimize import Bounds, direct, minimize, minimize_scalar

from geartrain.numerics.arrays import Floats

Point = tuple[float, ...]
Function = Callable[[Point], float]
_DIVISIONS = (45, 250, 450, 700)  # samples of DIRECT for 1, 2, 3 and 4 variables
_BASINS = 3  # lowest samples whose surroundings are searched
_NEAR = 0.1  # of a range: samples nearer than this lie in one basin
_FINE = 1e-7  # of a range: values there differ by rounding only, where a minimum is smooth
_GAIN = 1e-5  # of the value: a round that gains less is the last
_ROUNDS = 5
_STEP = 0.05  # of a range: the first simplex


@dataclass
class SampledFunction:
    """A function of points in a box, worked out once at each of them; `seen` has them all."""

    value: Function
    bounds: Sequence[tuple[float, float]]
    seen: dict[Point, float] = field(default_factory=dict)

    def __call__(self, x: Sequence[float] | Floats) -> float:
        at = self.inside(x)
        if at not in self.seen:
            self.seen[at] = self.value(at)
        return self.seen[at]

    def inside(self, x: Sequence[float] | Floats) -> Point:
        """A point drawn into the box."""
        return tuple(min(max(float(each), low), high) for each, (low, high) in zip(x, self.bounds, strict=True))

    @property
    def best(self) -> Point:
        """The sample with the least value."""
        return min(self.seen, key=lambda at: self.seen[at])


def distance(one: Point, other: Point, bounds: Sequence[tuple[float, float]]) -> float:
    """The greatest difference of two points of a box, in ranges."""
    return max(abs(a - b) / (high - low) for a, b, (low, high) in zip(one, other, bounds, strict=True))


def minimise(value: Function, bounds: Sequence[tuple[float, float]], starts: Sequence[Point] = ()) -> SampledFunction:
    """Samples of `value` in a box, the best of which is its least value as far as is found.

    bounds   of each variable, low < high
    starts   points that are tried too: the result is never worse than they are
    """
    sampled = SampledFunction(value, bounds)
    for start in starts:
        sampled(start)
    lows, highs = zip(*bounds, strict=True)
    # neither volume nor side ends it: the number of samples does
    number = _DIVISIONS[min(len(bounds), len(_DIVISIONS)) - 1]
    direct(_plain(sampled), Bounds(lows, highs), maxfun=number, locally_biased=False, vol_tol=0, len_tol=0)
    if len(bounds) == 1:
        for end in bounds[0]:  # neither DIRECT nor Brent looks at an end
            sampled((end,))
        for low, high in _brackets(sampled):
            _search_between(sampled, low, high)
    else:
        for start in _apart(sampled):
            polish(sampled, start, rounds=2)
        polish(sampled, sampled.best)
    return sampled


def polish(sampled: SampledFunction, start: Point, rounds: int = _ROUNDS) -> None:
    """Search on from one point; what is found is among the samples."""
    if len(start) == 1:
        ((low, high),) = sampled.bounds
        _search_between(sampled, start[0] - _STEP * (high - low), start[0] + _STEP * (high - low))
        return
    step, here = _STEP, start
    for turn in range(rounds):
        before = sampled(here)
        # to the other side of the last simplex: one that has collapsed along a kink is not begun anew as it was
        corners = [here, *(_moved(sampled, here, which, step if turn % 2 else -step) for which in range(len(here)))]
        options = {"initial_simplex": np.array(corners), "maxfev": 50 * len(here), "xatol": 1e-6, "fatol": 1e-10}
        found = minimize(_plain(sampled), np.array(here), method="Nelder-Mead", options=options)  # type: ignore[call-overload]
        here = min((here, sampled.inside(found.x)), key=sampled)
        if before - sampled(here) <= _GAIN * abs(before):
            break
        step /= 2


def _plain(sampled: SampledFunction) -> Callable[[Floats], float]:
    """The function as scipy wants it."""

    def value(x: Floats) -> float:
        return sampled(x)

    return value


def _apart(sampled: SampledFunction) -> list[Point]:
    """The lowest samples, none near another."""
    found: list[Point] = []
    for at in sorted(sampled.seen, key=lambda at: sampled.seen[at]):
        if all(distance(at, other, sampled.bounds) > _NEAR for other in found):
            found.append(at)
        if len(found) == _BASINS:
            break
    return found


def _brackets(sampled: SampledFunction) -> list[tuple[float, float]]:
    """The neighbours of the lowest local minima among the samples of one variable."""
    places = sorted(at[0] for at in sampled.seen)
    values = [sampled.seen[at,] for at in places]
    around = [inf, *values, inf]
    low = [k for k, value in enumerate(values) if value <= around[k] and value <= around[k + 2]]
    low.sort(key=lambda k: values[k])
    return [(places[max(k - 1, 0)], places[min(k + 1, len(places) - 1)]) for k in low[:_BASINS]]


def _search_between(sampled: SampledFunction, low: float, high: float) -> None:
    """Brent's bounded method."""
    first, last = sampled.bounds[0]
    low, high = max(low, first), min(high, last)
    if high > low:
        tolerance = _FINE * (last - first)
        minimize_scalar(lambda x: sampled((x,)), bounds=(low, high), method="bounded", options={"xatol": tolerance})


def _moved(sampled: SampledFunction, at: Point, which: int, step: float) -> Point:
    """A point moved along one variable by a part of its range, to the side where there is room."""
    low, high = sampled.bounds[which]
    by = step * (high - low)
    place = at[which] + by if low <= at[which] + by <= high else at[which] - by
    return (*at[:which], place, *at[which + 1 :])
