"""Enumeration of the gears of a gearbox over all sets of closed shift elements, and search for series of gears."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, pairwise
from math import comb, log
from statistics import pstdev
from typing import Any, ClassVar

from geartrain.analysis.gear_train import GearTrain
from geartrain.analysis.gearbox import gearbox_ends
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.train import State

MOST_COMBINATIONS = 20_000  # sets of closed elements, each of which is solved exactly
_JOINER = "+"  # between the names of closed elements in the name of a state
_FIGURES = 12  # decimals to which sums of squares are compared, so that rounding does not decide ties


@dataclass(frozen=True)
class PossibleGear(Result):
    """Gear of a gearbox that results from closing a set of shift elements (clutches and brakes)."""

    engaged: tuple[str, ...]
    """Names of the closed shift elements, in the order of declaration."""
    ratio: Fraction | None
    """Speed of the input divided by the speed of the output; None if the output is at rest."""
    states: tuple[str, ...]
    """Names of the declared states with exactly these elements closed; empty for an undeclared gear."""


@dataclass(frozen=True)
class GearSeries(Result):
    """Series of forward gears in descending order of ratio, with steps between gears and the spread of the ratios."""

    KEYS = ("gears", Key("steps", to=as_float), Key("spread", to=as_float), "deviation", "double_shifts")

    gears: tuple[PossibleGear, ...]
    """Gears of the series in order of decreasing ratio."""

    @property
    def ratios(self) -> tuple[Fraction, ...]:
        """Ratio of each gear, which is the speed of the input divided by the speed of the output."""
        return tuple(each.ratio for each in self.gears if each.ratio is not None)

    @property
    def steps(self) -> tuple[Fraction, ...]:
        """Step of each gear except the last: ratio of the gear divided by the ratio of the next gear."""
        return tuple(a / b for a, b in pairwise(self.ratios))

    @property
    def spread(self) -> Fraction:
        """Ratio of the first gear divided by the ratio of the last gear [1]."""
        return self.ratios[0] / self.ratios[-1]

    @property
    def deviation(self) -> float:
        """Population standard deviation of the natural logarithms of the steps [1]; 0 if all steps are equal."""
        return pstdev(map(log, self.steps))

    @property
    def double_shifts(self) -> int:
        """Number of shifts to the next gear at which two or more clutches or brakes open, or two or more close."""
        return sum(not _is_single(a, b) for a, b in pairwise(self.gears))


@dataclass(frozen=True)
class GearSearch(Tabular, Result):
    """All gears of a gearbox, with the gear series of maximum spread and the gear series of most uniform steps."""

    MEANINGS: ClassVar = {
        "closed": "Engaged clutches and brakes.",
        "ratio": "Speed of the input divided by speed of the output; empty if the output is at rest [1].",
        "exact": "The ratio as a fraction [1].",
        "states": "Declared states that engage the same elements.",
    }

    PAGE = "report.gearbox_report:describe_gear_search"

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    input: str
    """Name of the input link."""
    output: str
    """Name of the output link."""
    closed: int
    """Number of shift elements that must be closed to determine all speeds."""
    combinations: int
    """Number of combinations of `closed` shift elements. All of them were examined."""
    gears: tuple[PossibleGear, ...]
    """Forward gears, reverse gears, both by decreasing magnitude of the ratio, then gears with the output at rest."""
    free: tuple[tuple[str, ...], ...] = ()
    """Combinations of `closed` shift elements that leave some speeds undetermined."""
    locked: tuple[tuple[str, ...], ...] = ()
    """Combinations of `closed` shift elements that lock the train or contradict its inputs."""
    requested: int = 0
    """Requested number of gears in a series; 0 if no series was requested."""
    series: int = 0
    """Number of gear series whose steps and shifts satisfy the request; 0 if no series was requested."""
    widest: GearSeries | None = None
    """Gear series with the maximum spread; None if no series satisfies the request."""
    evenest: GearSeries | None = None
    """Series with the minimum standard deviation of the logarithmic steps; None without any series."""

    def _summary(self) -> str:
        ways = f"{self.combinations} combinations of {self.closed} closed elements"
        return f"{self.name}: {len(self.gears)} gears of {ways}"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with a row for each gear: closed elements, ratio (None for an output at rest), states."""
        return {
            "closed": [", ".join(gear.engaged) for gear in self.gears],
            "ratio": [None if gear.ratio is None else as_float(gear.ratio) for gear in self.gears],
            "exact": ["" if gear.ratio is None else str(gear.ratio) for gear in self.gears],
            "states": [", ".join(gear.states) for gear in self.gears],
        }


def find_gears(
    train: GearTrain,
    output: str | None = None,
    gears: int = 0,
    steps: tuple[float, float] = (1.05, 2.0),
    single: bool = False,
) -> GearSearch:
    """Find all declared and undeclared gears of a gearbox by enumerating sets of closed shift elements, and search for
    series of gears.

    Parameters
    ----------
    train : GearTrain
        Train with clutches.
    output : str, optional
        Name of an output; by default the first output that is not the input.
    gears : int
        Number of forward gears in a series. If it is less than 2, no series is searched for.
    steps : tuple of float
        Minimum and maximum step in a series; a step is the ratio of a gear divided by the ratio of the next gear.
    single : bool
        True to allow only shifts in which at most one element opens and at most one closes.

    Returns
    -------
    GearSearch
        All gears with exact ratios, and the requested series. Combinations have the minimum number of closed elements
        that determines all speeds.

    Raises
    ------
    QuestionError
        If the train is not a gearbox, has no turning input or no output, has one-way clutches, or has too many
        combinations of closed elements.

    Examples
    --------
    >>> import geartrain
    >>> found = find_gears(geartrain.load("simpson-set"), gears=3, steps=(1.4, 1.8))
    >>> [round(float(ratio), 3) for ratio in found.evenest.ratios]
    [2.455, 1.455, 1.0]
    """
    source, link = gearbox_ends(train.declaration, output)
    if one_way := [name for name, each in train.declaration.clutches.items() if each.one_way is not None]:
        what = f"the search for gears does not include the one-way clutches {', '.join(one_way)}"
        why = "they close by themselves, so that gears have different numbers of closed elements"
        raise QuestionError(Problem(what, why, "declare them without `one_way`, as clutches that hold in both senses"))
    found = _all_gears(train, source, link)
    forward = [each for each in found.gears if each.ratio is not None and each.ratio > 0]
    if gears < 2:
        return found
    # the decimal as written: 1.05 is 21/20, not the nearest float
    low, high = (Fraction(str(step)) for step in steps)
    count, widest, evenest = _series(forward, _links(forward, low, high, single), gears)
    return replace(found, requested=gears, series=count, widest=widest, evenest=evenest)


def _rank(gear: PossibleGear) -> tuple[int, Fraction]:
    """Return the sort key of a gear: forward gears precede reverse gears, and larger ratios precede smaller ratios."""
    return (2, Fraction(0)) if gear.ratio is None else (int(gear.ratio < 0), -abs(gear.ratio))


def _is_single(one: PossibleGear, other: PossibleGear) -> bool:
    return len({*one.engaged} - {*other.engaged}) <= 1 and len({*other.engaged} - {*one.engaged}) <= 1


def _all_gears(train: GearTrain, source: str, link: str) -> GearSearch:
    """Return all gears, each with the smallest number of closed elements for which the speeds are determined."""
    declared = train.declaration
    names: dict[frozenset[str], list[str]] = {}
    for name, state in declared.states.items():
        names.setdefault(frozenset(state.engaged), []).append(name)
    inputs = next(iter(declared.states.values())).inputs
    # smallest size first: further closed elements would be redundant or lock the train
    for size in range(len(declared.clutches) + 1):
        if (number := comb(len(declared.clutches), size)) > MOST_COMBINATIONS:
            what = f"{size} of {len(declared.clutches)} shift elements have too many combinations: {number:,}"
            why = f"at most {MOST_COMBINATIONS:,} combinations are enumerated"
            raise QuestionError(Problem(what, why, "declare fewer `clutches`"))
        choices = list(combinations(declared.clutches, size))
        states = {_JOINER.join(each) or "none": State(engaged=each, inputs=inputs) for each in choices}
        answers = list(GearTrain(declared.model_copy(update={"states": states})).answers())
        gears: list[PossibleGear] = []
        for choice, answer in zip(choices, answers, strict=True):
            drive, out = answer.speeds.get(source), answer.speeds.get(link)
            if answer.verdict and drive and out is not None:
                ratio = Fraction(drive) / Fraction(out) if out else None
                gears.append(PossibleGear(choice, ratio, tuple(names.get(frozenset(choice), ()))))
        if gears:
            kinds = [(choice, answer.verdict.kind) for choice, answer in zip(choices, answers, strict=True)]
            free = tuple(choice for choice, kind in kinds if kind == "free")
            locked = tuple(choice for choice, kind in kinds if kind in ("locked", "contradictory"))
            gears.sort(key=_rank)
            return GearSearch(train.name, declared.title, source, link, size, number, tuple(gears), free, locked)
    return GearSearch(train.name, declared.title, source, link, len(declared.clutches), 1, ())


# ------------------------------------------------------------------------------------------------- series, as paths

Links = Mapping[int, Sequence[int]]
"""Indices of the gears that may follow a gear in a series, keyed by the index of the gear (adjacency list)."""


def _links(gears: Sequence[PossibleGear], low: Fraction, high: Fraction, single: bool) -> Links:
    ratios = [each.ratio or Fraction(0) for each in gears]
    return {
        at: [
            to
            for to in range(at + 1, len(gears))
            # different elements can give the same ratio, which is not a step even if `low` is 1
            if low <= ratios[at] / ratios[to] <= high and ratios[at] > ratios[to]
            if not single or _is_single(gears[at], gears[to])
        ]
        for at in range(len(gears))
    }


_Found = tuple[int, GearSeries | None, GearSeries | None]
"""Number of series, and the series of maximum spread and of minimum deviation, both None without a series."""
_Way = tuple[float, int, tuple[int, ...]]
"""Sum of squares or variance of the logarithmic steps, double shifts, and indices of the gears of a series."""


def _series(gears: Sequence[PossibleGear], links: Links, number: int) -> _Found:
    """Return the number of gear series, the one of maximum spread and the one of most uniform steps, or 0 and None."""
    # for a given first and last gear, the mean logarithmic step is fixed, so that the minimum sum of squares gives the
    # minimum variance
    ratios = [each.ratio or Fraction(1) for each in gears]
    count, found = 0, list[tuple[Fraction, _Way]]()
    for start, first in enumerate(ratios):
        for end, ((sum_, double, way), ways) in _series_from(start, gears, links, number).items():
            variance = sum_ / (number - 1) - (log(first / ratios[end]) / (number - 1)) ** 2
            # rounding can make the variance of equal steps slightly negative
            found.append((-first / ratios[end], (round(max(variance, 0.0), _FIGURES), double, way)))
            count += ways
    if not found:
        return 0, None, None
    chosen = (min(found)[1][-1], min(each for _, each in found)[-1])
    widest, evenest = (GearSeries(tuple(gears[at] for at in way)) for way in chosen)
    return count, widest, evenest


def _series_from(start: int, gears: Sequence[PossibleGear], links: Links, number: int) -> dict[int, tuple[_Way, int]]:
    """Return, for each possible last gear, the series with the most uniform steps, and the number of all series."""
    logs = [log(each.ratio or 1) for each in gears]
    reach: dict[int, tuple[_Way, int]] = {start: ((0.0, 0, (start,)), 1)}
    for _ in range(number - 1):
        after: dict[int, tuple[_Way, int]] = {}
        for at, ((sum_, double, way), ways) in reach.items():
            for to in links[at]:
                more = not _is_single(gears[at], gears[to])
                # tuples are compared: sum of squares, double shifts, then order of gears
                new = round(sum_ + (logs[at] - logs[to]) ** 2, _FIGURES), double + more, (*way, to)
                best, known = after.get(to, (new, 0))
                after[to] = min(best, new), known + ways
        reach = after
    return reach
