"""Search for the best sizes of a pair with triangular teeth: minimum loss, error or impact, or maximum margin.

The objectives are continuous functions of the sizes, but they have kinks where the phases of the path of contact
change, and several local minima. DIRECT finds the lowest minimum (`minimise`). The Pareto front of two objectives is
found by the epsilon-constraint method: the first objective is minimised under bounds on the second.
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
"""Default bounds of the free parameters. Angles are in rad."""

_BEYOND = 1e3  # value above every figure, for designs that turn but violate a limit
_NOTHING = 1e6  # value of designs that cannot turn
_FRONT = 9  # number of bounds on the second objective
_WORTH = 0.005  # minimum distance of designs on a front, as a fraction of its range in the second objective
_CLEARANCES = ("clearance_factor", "excess", "backlash", "centre_distance")  # other keys of a declared clearance
_WIDEST = {"radii": (0.1, 10.0), "window": (0.0, 1.0), "half_angle": (0.0, pi / 2)}
_MOST_TRIALS = 30  # maximum number of designs evaluated for a costly limit
_NEAR = 0.02  # of a range: designs this close to a rejected one are not evaluated
_HALVINGS = 5  # bisections between the best accepted design and a rejected one


class SizeSearch:
    """Designs of one pair as points in the space of the free parameters. Each design is computed once and reused."""

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
        """Return the design at one point in the space of the free parameters."""
        if at not in self.designs:
            self.designs[at] = self.start.at(dict(zip(self.free, at, strict=True)))
            self._on_design()
        return self.designs[at]

    def place(self, design: ToothSizes) -> Point:
        """Return the coordinates of a design in the space of the free parameters. They may be outside the bounds."""
        return tuple(map(design.parameter, self.free))

    @property
    def bounds(self) -> tuple[Range, ...]:
        """Bounds of the free parameters, in the order of `free`."""
        return tuple(self.free.values())

    def keeps(self, design: ToothSizes, more: Sequence[SizeLimit] = ()) -> bool:
        """Return True if a design turns and satisfies all limits of the search and the additional limits `more`."""
        return keeps(design, (*self.limits, *more))

    def value(self, aim: str, more: Sequence[SizeLimit] = ()) -> Callable[[Point], float]:
        """Return the objective as a function of a point; infeasible designs have larger values than all others."""

        def figure(at: Point) -> float:
            design = self.design(at)
            if not design.runs:
                return _NOTHING
            missed = sum(max(limit.excess(design), 0.0) for limit in (*self.limits, *more))
            # the violation leads the search towards feasible designs
            return _BEYOND + missed if missed > 0 else min(design.merit(aim), _NOTHING)

        return figure

    def minimum(self, aim: str, starts: Sequence[ToothSizes] = ()) -> ToothSizes:
        """Return the best design for one objective. Raises `QuestionError` if no design is feasible."""
        sampled = minimise(self.value(aim), self.bounds, [self.place(each) for each in starts])
        best = self.design(sampled.best)
        if self.keeps(best):
            return best
        turns = any(design.runs for design in self.designs.values())
        names = ", ".join(self.free)
        why = "every design that can turn violates a limit" if turns else "no design in the ranges can turn"
        z1, z2 = self.start.teeth
        what = f"no values of {names} in the given ranges are feasible for a pair of {z1} and {z2} teeth"
        fix = "widen the ranges (--free NAME=LOW:HIGH), free more parameters, or relax the limits (--within)"
        raise QuestionError(Problem(what, why, fix))

    def front(self, first: str, second: str) -> tuple[ToothSizes, ...]:
        """Return the Pareto front of two objectives, from the best design for `first` to the best for `second`."""
        ends = self.minimum(first), self.minimum(second)
        low, high = (each.merit(second) for each in ends[::-1])
        for step in range(1, _FRONT + 1):
            merit = high + (low - high) * step / (_FRONT + 1)
            # the merit of `jam` is minus the margin, because merits are minimised
            bound = SizeLimit(second, -merit if second == "jam" else merit)
            known = SampledFunction(self.value(first, [bound]), self.bounds)
            inside = [at for at, each in self.designs.items() if self.keeps(each, [bound])]
            if inside:  # the best known design within the bound is the start
                polish(known, min(inside, key=lambda at: self.designs[at].merit(first)), rounds=1)
        feasible = [each for each in self.designs.values() if self.keeps(each)]
        front: list[ToothSizes] = []
        # in this order a design is dominated unless it improves the second objective
        for each in sorted(feasible, key=lambda design: (design.merit(first), design.merit(second))):
            if not front or each.merit(second) < front[-1].merit(second):
                front.append(each)
        return _spread(front, second)


def _spread(front: Sequence[ToothSizes], aim: str) -> tuple[ToothSizes, ...]:
    """Return a Pareto front without designs that differ negligibly from their neighbours in the objective `aim`."""
    worth = _WORTH * (front[0].merit(aim) - front[-1].merit(aim))
    found = [front[0]]
    for each in front[1:-1]:
        if min(found[-1].merit(aim) - each.merit(aim), each.merit(aim) - front[-1].merit(aim)) >= worth:
            found.append(each)
    return (*found, *front[1:][-1:])


def checked_ranges(free: Mapping[str, Range | None]) -> dict[str, Range]:
    """Return the bounds of the free parameters. Bounds that are None are replaced by the bounds in `USUAL_RANGES`.

    Raises `QuestionError` if a parameter or its bounds are invalid, or if no parameter is free.
    """
    found = {}
    for name, given in free.items():
        if name not in PARAMETERS:
            what = f"'{name}' is not a free parameter of triangular teeth"
            why = "all other sizes are fixed, or follow from the free parameters"
            if name in _CLEARANCES:
                why = "the clearance is optimised by its position in the clearance window, which depends on the radii"
            raise QuestionError(Problem(what, why, f"use one or more of {', '.join(PARAMETERS)}"))
        low, high = USUAL_RANGES[name] if given is None else given
        minimum, most = _WIDEST[name]
        if not minimum <= low < high <= most or (name == "half_angle" and not low > 0):
            what = f"the bounds {low:g} and {high:g} of '{name}' are not valid"
            why = "the lower bound must be below the upper bound, and both must be in the permitted range"
            raise QuestionError(Problem(what, why, f"give bounds from {minimum:g} to {most:g} (angles in rad)"))
        found[name] = (float(low), float(high))
    if not found:
        why = "with all parameters fixed, there is only one design"
        raise QuestionError(Problem("no parameter is free", why, f"free one or more of {', '.join(PARAMETERS)}"))
    return found


# ----------------------------------------------------------------------------------- limit on the probability of a stop


@dataclass(frozen=True)
class ProbabilityLimit:
    """Limit on the probability that a pair with cutting errors jams or clashes, evaluated only for the best designs.

    See Also
    --------
    find_tooth_sizes : Evaluate the limit for a few designs, beginning with the best.
    """

    bound: float
    """Maximum probability that the pair jams or clashes, 0 to 1."""
    probability: Callable[[ToothSizes], float]
    """Function that returns the probability that a given design jams or clashes, such as `PairTrials.stops`."""


@dataclass(frozen=True)
class PairTrials:
    """Monte Carlo trials of single pairs. All pairs have the same manufacturing errors and the same random seed.

    See Also
    --------
    run_trials : Trials of a whole train.

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
    """Cutting and mounting errors; `read_error_overrides` parses them from strings."""
    trials: int = 256
    """Number of trials of each pair."""
    seed: int = 1
    """Random seed of the trials. It is the same for every pair, so that results differ only because of the sizes."""

    def stops(self, sizes: ToothSizes) -> float:
        """Return the fraction of trials in which the pair jams or clashes, 0 to 1.

        Parameters
        ----------
        sizes : ToothSizes
            Design of the pair.
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


def best_within(search: SizeSearch, aim: str, limit: ProbabilityLimit) -> tuple[ToothSizes, float]:
    """Return the best design that satisfies a probability limit, and its probability of a jam or clash."""
    known = sorted((at for at, each in search.designs.items() if search.keeps(each)), key=search.value(aim))
    refused: list[Point] = []
    for at in known:
        if len(refused) == _MOST_TRIALS:
            break
        # designs near a rejected one are skipped
        if any(distance(at, other, search.bounds) < _NEAR for other in refused):
            continue
        if (probability := limit.probability(search.design(at))) <= limit.bound:
            return _bisect_to_limit(search, aim, limit, at, probability, refused)
        refused.append(at)
    what = f"all of the {len(refused)} best designs jam or clash with a probability above {limit.bound:g}"
    why = "the cutting errors are too large for the clearances of these designs"
    raise QuestionError(
        Problem(what, why, "raise the limit, such as --within stops=10%, or give smaller errors (--cutting)")
    )


def _bisect_to_limit(
    search: SizeSearch, aim: str, limit: ProbabilityLimit, at: Point, probability: float, refused: Sequence[Point]
) -> tuple[ToothSizes, float]:
    """Return a design near the probability limit, and its probability, by bisection between two points.

    at, probability   point of an accepted design, and its probability of a jam or clash
    refused           points of rejected designs, of which the nearest one is the other end
    """
    if not refused:
        return search.design(at), probability
    value = search.value(aim)
    beyond = min(refused, key=lambda other: distance(at, other, search.bounds))
    for _ in range(_HALVINGS):
        middle = tuple((a + b) / 2 for a, b in zip(at, beyond, strict=True))
        # the objective comes first, because the probability needs Monte Carlo trials
        better = value(middle) < value(at) and (found := limit.probability(search.design(middle))) <= limit.bound
        at, beyond, probability = (middle, beyond, found) if better else (at, middle, probability)
    return search.design(at), probability


# ------------------------------------------------------------------------------------------------------- global minimum


Point = tuple[float, ...]
Function = Callable[[Point], float]
_DIVISIONS = (45, 250, 450, 700)  # samples of DIRECT for 1, 2, 3 and 4 variables
_BASINS = 3  # number of lowest samples from which local searches start
_CLOSE = 0.1  # of a range: samples closer than this are in one basin
_FINE = 1e-7  # of a range: near a smooth minimum, values at this distance differ only due to rounding
_GAIN = 1e-5  # relative improvement below which the rounds end
_ROUNDS = 5  # maximum number of simplexes, each half as large as the one before
_STEP = 0.05  # size of the first simplex, as a fraction of each range


@dataclass
class SampledFunction:
    """Function of points in a box, which is evaluated once at each point. `seen` contains all computed values."""

    value: Function
    bounds: Sequence[tuple[float, float]]
    seen: dict[Point, float] = field(default_factory=dict)

    def __call__(self, x: Sequence[float] | Floats) -> float:
        at = self.inside(x)
        if at not in self.seen:
            self.seen[at] = self.value(at)
        return self.seen[at]

    def inside(self, x: Sequence[float] | Floats) -> Point:
        """Return the point whose coordinates are clipped to the box."""
        return tuple(min(max(float(each), low), high) for each, (low, high) in zip(x, self.bounds, strict=True))

    @property
    def best(self) -> Point:
        """Sampled point at which the function has its minimum sampled value."""
        return min(self.seen, key=lambda at: self.seen[at])


def distance(one: Point, other: Point, bounds: Sequence[tuple[float, float]]) -> float:
    """Return the maximum difference of two points in a coordinate, as a fraction of its range in the box [1]."""
    return max(abs(a - b) / (high - low) for a, b, (low, high) in zip(one, other, bounds, strict=True))


def minimise(value: Function, bounds: Sequence[tuple[float, float]], starts: Sequence[Point] = ()) -> SampledFunction:
    """Return all samples of a minimisation of `value` in a box. The best sample is the minimum.

    bounds   bounds of each variable, low < high
    starts   additional points at which `value` is evaluated; the result is never worse than the best of these points
    """
    sampled = SampledFunction(value, bounds)
    for start in starts:
        sampled(start)
    lows, highs = zip(*bounds, strict=True)
    # only the number of samples ends the search, not the volume or the side of a cell
    number = _DIVISIONS[min(len(bounds), len(_DIVISIONS)) - 1]
    # the original DIRECT: the locally biased variant suits functions with few local minima
    direct(sampled, Bounds(lows, highs), maxfun=number, locally_biased=False, vol_tol=0, len_tol=0)
    if len(bounds) == 1:
        for end in bounds[0]:  # neither DIRECT nor Brent's method evaluates an end
            sampled((end,))
        for low, high in _brackets(sampled):
            _search_between(sampled, low, high)
    else:
        for start in _separate_basins(sampled):
            polish(sampled, start, rounds=2)
        polish(sampled, sampled.best)
    return sampled


def polish(sampled: SampledFunction, start: Point, rounds: int = _ROUNDS) -> None:
    """Minimise the function locally from a point, with at most `rounds` simplexes; all evaluations become samples."""
    if len(start) == 1:
        ((low, high),) = sampled.bounds
        _search_between(sampled, start[0] - _STEP * (high - low), start[0] + _STEP * (high - low))
        return
    step, here = _STEP, start
    for turn in range(rounds):
        before = sampled(here)
        corners = [here]
        for which, (low, high) in enumerate(sampled.bounds):
            # alternate the sides of the simplex, so that one that collapsed along a kink is not restarted unchanged
            by = (step if turn % 2 else -step) * (high - low)
            place = here[which] + by if low <= here[which] + by <= high else here[which] - by
            corners.append((*here[:which], place, *here[which + 1 :]))
        # sizes are declared with 6 decimals
        options = {"initial_simplex": np.array(corners), "maxfev": 50 * len(here), "xatol": 1e-6, "fatol": 1e-10}
        found = minimize(sampled, np.array(here), method="Nelder-Mead", options=options)  # type: ignore[call-overload]
        here = min((here, sampled.inside(found.x)), key=sampled)
        if before - sampled(here) <= _GAIN * abs(before):
            break
        step /= 2


def _separate_basins(sampled: SampledFunction) -> list[Point]:
    """Return up to three low samples, which differ from each other by more than a tenth of the range of a variable."""
    found: list[Point] = []
    for at in sorted(sampled.seen, key=lambda at: sampled.seen[at]):
        if all(distance(at, other, sampled.bounds) > _CLOSE for other in found):
            found.append(at)
        if len(found) == _BASINS:
            break
    return found


def _brackets(sampled: SampledFunction) -> list[tuple[float, float]]:
    """Return intervals around the lowest local minima of a function of one variable, each between two samples."""
    places = sorted(at[0] for at in sampled.seen)
    values = [sampled.seen[at,] for at in places]
    around = [inf, *values, inf]
    low = [k for k, value in enumerate(values) if value <= around[k] and value <= around[k + 2]]
    low.sort(key=lambda k: values[k])
    return [(places[max(k - 1, 0)], places[min(k + 1, len(places) - 1)]) for k in low[:_BASINS]]


def _search_between(sampled: SampledFunction, low: float, high: float) -> None:
    """Minimise the function in an interval by Brent's bounded method. All evaluated points are added to the samples."""
    first, last = sampled.bounds[0]
    low, high = max(low, first), min(high, last)
    if high > low:
        tolerance = _FINE * (last - first)
        minimize_scalar(lambda x: sampled((x,)), bounds=(low, high), method="bounded", options={"xatol": tolerance})
