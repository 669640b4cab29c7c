"""The best sizes of a pair with triangular teeth: least loss, error or impact, or the widest margin, within limits.

The figures are continuous in the sizes, but have kinks wherever the structure of the real path changes, and several
local minima: DIRECT finds the lowest of them (`minimise`). A front between two aims holds what no design is better than
in both: the least of the one under bounds on the other (the method of epsilon constraints), and all designs on the way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, pi
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import Bounds, direct, minimize, minimize_scalar

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.arrays import Floats
from geartrain.workshop.sizes.size_design import PARAMETERS, SizeLimit, ToothSizes, form_data, keeps

if TYPE_CHECKING:
    from geartrain.workshop.cutting.declared_errors import ErrorOverride

Range = tuple[float, float]
USUAL_RANGES: Mapping[str, Range] = {
    "radii": (0.8, 1.25),
    "window": (0.1, 0.9),
    "half_angle": (pi / 12, pi / 4),
}
"""Where a free parameter is looked for if no bounds are given."""

_BEYOND = 1e3  # above every figure: designs that turn but miss a limit
_NOTHING = 1e6  # designs that do not turn
_FRONT = 9  # bounds on the second aim
_WORTH = 0.005  # of a front in its second aim: how far apart its designs are
_CLEARANCES = ("clearance_factor", "excess", "backlash", "centre_distance")  # as declarations may give it
_WIDEST = {"radii": (0.1, 10.0), "window": (0.0, 1.0), "half_angle": (0.0, pi / 2)}
_REQUESTED = 30  # designs that a costly limit refuses before it is given up
_NEAR = 0.02  # of a range: designs this near to a refused one are not asked
_HALVINGS = 5  # between the best design that is let in and one that is not


class SizeSearch:
    """Designs of one pair as points of the free parameters; each is made once, whatever is asked of it."""

    def __init__(
        self,
        start: ToothSizes,
        free: Mapping[str, Range],
        limits: Sequence[SizeLimit] = (),
        on_design: Callable[[], None] = lambda: None,
    ) -> None:
        self.start, self.free, self.limits = start, dict(free), tuple(limits)
        self._on_design = on_design
        self.designs: dict[Point, ToothSizes] = {}

    def design(self, at: Point) -> ToothSizes:
        """The design at one point."""
        if at not in self.designs:
            self.designs[at] = self.start.at(dict(zip(self.free, at, strict=True)))
            self._on_design()
        return self.designs[at]

    def place(self, design: ToothSizes) -> Point:
        """The point of a design, which may lie outside the bounds."""
        return tuple(map(design.parameter, self.free))

    @property
    def bounds(self) -> tuple[Range, ...]:
        """Of the free parameters, in their order."""
        return tuple(self.free.values())

    def keeps(self, design: ToothSizes, more: Sequence[SizeLimit] = ()) -> bool:
        """Whether a design turns and keeps all limits."""
        return keeps(design, (*self.limits, *more))

    def value(self, aim: str, more: Sequence[SizeLimit] = ()) -> Callable[[Point], float]:
        """The figure to be made small; beyond all figures where a pair does not turn or misses a limit."""

        def figure(at: Point) -> float:
            design = self.design(at)
            if not design.runs:
                return _NOTHING
            missed = sum(max(limit.excess(design), 0.0) for limit in (*self.limits, *more))
            return _BEYOND + missed if missed > 0 else min(design.merit(aim), _NOTHING)

        return figure

    def minimum(self, aim: str, starts: Sequence[ToothSizes] = ()) -> ToothSizes:
        """The best design in one aim. Raises `QuestionError` where none turns and keeps the limits."""
        sampled = minimise(self.value(aim), self.bounds, [self.place(each) for each in starts])
        best = self.design(sampled.best)
        if self.keeps(best):
            return best
        turns = any(design.runs for design in self.designs.values())
        names = ", ".join(self.free)
        why = "every one that turns misses a limit" if turns else "none of them turns"
        z1, z2 = self.start.teeth
        what = f"no {names} in the ranges asked for makes a pair of {z1} and {z2} teeth that turns"
        raise QuestionError(Problem(what, why, "widen the ranges, free more, or loosen the limits"))

    def front(self, first: str, second: str) -> tuple[ToothSizes, ...]:
        """What none is better than in both aims, from the best in the first on."""
        ends = self.minimum(first), self.minimum(second)
        low, high = (each.merit(second) for each in ends[::-1])
        for step in range(1, _FRONT + 1):
            bound = _limit(second, high + (low - high) * step / (_FRONT + 1))
            known = SampledFunction(self.value(first, [bound]), self.bounds)
            inside = [at for at, each in self.designs.items() if self.keeps(each, [bound])]
            if inside:
                polish(known, min(inside, key=lambda at: self.designs[at].merit(first)), rounds=1)
        return _spread(undominated([each for each in self.designs.values() if self.keeps(each)], first, second), second)


def undominated(designs: Sequence[ToothSizes], first: str, second: str) -> tuple[ToothSizes, ...]:
    """The Pareto front of designs in two aims, from the best in the first to the best in the second."""
    found: list[ToothSizes] = []
    for each in sorted(designs, key=lambda design: (design.merit(first), design.merit(second))):
        if not found or each.merit(second) < found[-1].merit(second):
            found.append(each)
    return tuple(found)


def _spread(front: Sequence[ToothSizes], aim: str) -> tuple[ToothSizes, ...]:
    """A front without the designs that differ by nothing worth telling from the one before; both ends are kept."""
    worth = _WORTH * (front[0].merit(aim) - front[-1].merit(aim))
    found = [front[0]]
    for each in front[1:-1]:
        if min(found[-1].merit(aim) - each.merit(aim), each.merit(aim) - front[-1].merit(aim)) >= worth:
            found.append(each)
    return (*found, *front[1:][-1:])


def _limit(aim: str, merit: float) -> SizeLimit:
    return SizeLimit(aim, -merit if aim == "jam" else merit)


def checked_ranges(free: Mapping[str, Range | None]) -> dict[str, Range]:
    """Bounds of what is free, the usual ones where none are given. Raises `QuestionError` for what cannot be."""
    found = {}
    for name, given in free.items():
        if name not in PARAMETERS:
            what = f"'{name}' is no size of triangular teeth that can be free"
            why = "the clearance is searched as its place in the window, which moves with the radii"
            fix = f"free some of {', '.join(PARAMETERS)}"
            raise QuestionError(Problem(what, why if name in _CLEARANCES else "", fix))
        low, high = USUAL_RANGES[name] if given is None else given
        minimum, most = _WIDEST[name]
        if not minimum <= low < high <= most or (name == "half_angle" and not low > 0):
            what = f"'{name}' cannot lie from {low:g} to {high:g}"
            raise QuestionError(Problem(what, "", f"give two bounds within {minimum:g} to {most:g}, the lower first"))
        found[name] = (float(low), float(high))
    if not found:
        raise QuestionError(Problem("nothing is free", "", f"free some of {', '.join(PARAMETERS)}"))
    return found


# ---------------------------------------------------------------------------------------- a limit on the chance to stop


@dataclass(frozen=True)
class ChanceLimit:
    """A limit that costs too much to be asked of every design: the chance that a pair cut with errors stops.

    See Also
    --------
    find_tooth_sizes : asks it of few designs, the best first.
    """

    bound: float
    """The greatest chance that is let in, 0 to 1."""
    chance: Callable[[ToothSizes], float]
    """The chance of a design, such as of `geartrain.workshop.PairTrials`."""


@dataclass(frozen=True)
class PairTrials:
    """Monte Carlo trials of single pairs, all with the same errors and the same seed.

    See Also
    --------
    run_trials : the same of a train.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.workshop import ToothSizes
    >>> from geartrain.workshop import read_error_overrides
    >>> trials = PairTrials(read_error_overrides(["pitch_deviation=0.1 %"]), 64)
    >>> trials.stops(ToothSizes((48, 96), 0.98, 0.5, (pi / 6, pi / 6), 0.2))
    0.0
    """

    errors: Sequence[ErrorOverride]
    """Of cutting and fitting; `read_error_overrides` reads them."""
    trials: int = 256
    """How many times each pair is cut."""
    seed: int = 1
    """The same for all pairs, so that they differ by their sizes alone."""

    def stops(self, sizes: ToothSizes) -> float:
        """The share of trials in which the pair jams or clashes.

        Parameters
        ----------
        sizes : ToothSizes
            The pair as designed.
        """
        from geartrain.analysis.gear_train import GearTrain
        from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan
        from geartrain.workshop.monte_carlo.trial_run import run_trials

        (z1, z2), driver = sizes.teeth, ("w1", "w2")[sizes.driver - 1]
        train = GearTrain.declare(
            {
                "links": {"frame": {}, "a": {"wheels": {"w1": z1}}, "b": {"wheels": {"w2": z2}}},
                "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
                "gears": [{"pair": ["w1", "w2"], "tooth_form": form_data(sizes, exact=True), "driver": driver}],
                "inputs": {("a", "b")[sizes.driver - 1]: 1},
                "outputs": {("b", "a")[sizes.driver - 1]: {}},
            }
        )
        return run_trials(find_trial_plan(train, self.errors), self.trials, self.seed).train.events["stops"].value


def best_within(search: SizeSearch, aim: str, limit: ChanceLimit) -> tuple[ToothSizes, float]:
    """The best design whose chance is let in, and that chance: asked of the best first, none near a refused one."""
    known = sorted((at for at, each in search.designs.items() if search.keeps(each)), key=search.value(aim))
    refused: list[Point] = []
    for at in known:
        if len(refused) == _REQUESTED:
            break
        if any(distance(at, other, search.bounds) < _NEAR for other in refused):
            continue
        if (chance := limit.chance(search.design(at))) <= limit.bound:
            return _narrowed(search, aim, limit, at, chance, refused)
        refused.append(at)
    what = f"of {len(refused)} designs none stops with a chance of {limit.bound:g} or less"
    raise QuestionError(Problem(what, "the errors are too great for such teeth", "allow more, or cut better"))


def _narrowed(
    search: SizeSearch, aim: str, limit: ChanceLimit, at: Point, chance: float, refused: Sequence[Point]
) -> tuple[ToothSizes, float]:
    """The limit itself, between what is let in and the refused design nearest to it: by halving."""
    if not refused:
        return search.design(at), chance
    value = search.value(aim)
    beyond = min(refused, key=lambda other: distance(at, other, search.bounds))
    for _ in range(_HALVINGS):
        middle = tuple((a + b) / 2 for a, b in zip(at, beyond, strict=True))
        better = value(middle) < value(at) and (found := limit.chance(search.design(middle))) <= limit.bound
        at, beyond, chance = (middle, beyond, found) if better else (at, middle, chance)
    return search.design(at), chance


# ------------------------------------------------------------------------------------------------------- global minimum


Point = tuple[float, ...]
Function = Callable[[Point], float]
_DIVISIONS = (45, 250, 450, 700)  # samples of DIRECT for 1, 2, 3 and 4 variables
_BASINS = 3  # lowest samples whose surroundings are searched
_CLOSE = 0.1  # of a range: samples nearer than this lie in one basin
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
        if all(distance(at, other, sampled.bounds) > _CLOSE for other in found):
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
