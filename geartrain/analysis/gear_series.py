"""All gears that a gearbox has, whichever elements are closed, and series of them by their steps."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from math import comb, log, sqrt
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from geartrain.analysis.gear_train import GearTrain
from geartrain.analysis.gearbox import gearbox_ends
from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.train import State

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Answer

MOST_COMBINATIONS = 20_000
_JOINER = "+"
_FIGURES = 12  # digits past the point to which sums of squares are compared


@dataclass(frozen=True)
class PossibleGear(Result):
    """What closing some elements gives."""

    engaged: tuple[str, ...]
    """Elements that are closed, in the order declared."""
    ratio: Fraction | None
    """Input over output; None where the output stands still."""
    states: tuple[str, ...]
    """Declared states in which just these are closed."""


@dataclass(frozen=True)
class GearSeries(Result):
    """Forward gears, from the lowest."""

    KEYS = ("gears", Key("steps", to=as_float), Key("spread", to=as_float), "deviation", "double_shifts")

    gears: tuple[PossibleGear, ...]
    """Ratios fall."""

    @property
    def ratios(self) -> tuple[Fraction, ...]:
        """Input over output."""
        return tuple(each.ratio for each in self.gears if each.ratio is not None)

    @property
    def steps(self) -> tuple[Fraction, ...]:
        """Each ratio over the next."""
        return tuple(a / b for a, b in zip(self.ratios, self.ratios[1:], strict=False))

    @property
    def spread(self) -> Fraction:
        """The first ratio over the last."""
        return self.ratios[0] / self.ratios[-1]

    @property
    def deviation(self) -> float:
        """How uneven the steps are: standard deviation of their logarithms."""
        logs = [log(step) for step in self.steps]
        mean = sum(logs) / len(logs)
        return sqrt(sum((each - mean) ** 2 for each in logs) / len(logs))

    @property
    def double_shifts(self) -> int:
        """Shifts in which more than one element opens, or closes."""
        return sum(not _is_single(a, b) for a, b in zip(self.gears, self.gears[1:], strict=False))


@dataclass(frozen=True)
class GearSearch(Tabular, Result):
    """All gears of a gearbox, and the series asked for.

    See Also
    --------
    find_gears : gives it.
    """

    MEANINGS: ClassVar = {
        "closed": "Engaged clutches and brakes.",
        "ratio": "Speed of the input over that of the output; empty where the output stands still [1].",
        "exact": "The ratio as a fraction [1].",
        "states": "States that engage the same elements.",
    }

    PAGE = "report.gearbox_report:describe_gear_search"

    KEYS = (
        *("name", "title", "input", "output", "closed", "combinations"),
        *("gears", "free", "locked", "requested", "series", "widest", "evenest"),
    )

    name: str
    """Name of the train."""
    title: str
    """Title of the train."""
    input: str
    """The link that drives."""
    output: str
    """The link that is driven."""
    closed: int
    """How many elements must be closed for the inputs to determine all speeds."""
    combinations: int
    """Ways to close so many."""
    gears: tuple[PossibleGear, ...]
    """Those that determine the output and let it turn, or hold it; forward from the lowest, backward, held."""
    free: tuple[tuple[str, ...], ...] = ()
    """Number of other combinations of this size that leave the train free."""
    locked: tuple[tuple[str, ...], ...] = ()
    """Number of other combinations of this size that lock the train."""
    requested: int = 0
    """Gears of the series asked for; 0 where none was."""
    series: int = 0
    """How many series there are with all steps inside the window, shifts as asked; 0 where none was asked for."""
    widest: GearSeries | None = None
    """Of these series, one with the greatest spread."""
    evenest: GearSeries | None = None
    """Of these series, one whose steps differ least."""

    def _summary(self) -> str:
        return (
            f"{self.name}: {len(self.gears)} gears of {self.combinations} combinations of {self.closed} closed elements"
        )

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each gear: what is closed, its ratio, if the output turns, and the states declared so."""
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
    """Every gear that closing elements gives, declared or not, and series of gears.

    Parameters
    ----------
    train : GearTrain
        A train with clutches.
    output : str, optional
        One of the declared outputs, by default the first that is not the input.
    gears : int
        Forward gears of a series; below 2 none is looked for.
    steps : tuple of float
        Least and greatest ratio of a gear over the next.
    single : bool
        Only shifts in which one element opens and one closes.

    Returns
    -------
    GearSearch
        Complete and exact: all ways to close as many elements as are needed, and no more.

    Raises
    ------
    QuestionError
        As of `GearTrain.gearbox`, and where there are too many ways.

    Examples
    --------
    >>> import geartrain
    >>> found = find_gears(geartrain.load("simpson-set"), gears=3, steps=(1.4, 1.8))
    >>> [round(float(ratio), 3) for ratio in found.evenest.ratios]
    [2.455, 1.455, 1.0]
    """
    source, link = gearbox_ends(train.declaration, output)
    closed, every, free, locked = _all_gears(train, source, link)
    forward = sorted((each for each in every if each.ratio is not None and each.ratio > 0), key=_falling)
    backward = sorted((each for each in every if each.ratio is not None and each.ratio < 0), key=_falling)
    still = [each for each in every if each.ratio is None]
    ways = comb(len(train.declaration.clutches), closed)
    ordered = (*forward, *backward, *still)
    found = GearSearch(train.name, train.declaration.title, source, link, closed, ways, ordered, free, locked)
    if gears < 2:
        return found
    low, high = (Fraction(str(step)) for step in steps)
    links = _links(forward, low, high, single)
    widest, evenest = _widest(forward, links, gears), _evenest(forward, links, gears)
    count = _count(forward, links, gears)
    return replace(found, requested=gears, series=count, widest=widest, evenest=evenest)


def _falling(gear: PossibleGear) -> Fraction:
    assert gear.ratio is not None
    return -abs(gear.ratio)


def _is_single(one: PossibleGear, other: PossibleGear) -> bool:
    return len({*one.engaged} - {*other.engaged}) <= 1 and len({*other.engaged} - {*one.engaged}) <= 1


_Choice = tuple[str, ...]


class _AllGears(NamedTuple):
    """How many elements are closed at once, every gear with so many, and what else closing so many does."""

    closed: int
    gears: list[PossibleGear]
    free: tuple[_Choice, ...] = ()
    locked: tuple[_Choice, ...] = ()


def _all_gears(train: GearTrain, source: str, link: str) -> _AllGears:
    """Every gear.

    All sets of rows that just suffice have one size, for they are the bases of a matroid.
    """
    elements = tuple(train.declaration.clutches)
    names: dict[frozenset[str], list[str]] = {}
    for name, state in train.declaration.states.items():
        names.setdefault(frozenset(state.engaged), []).append(name)
    for size in range(len(elements) + 1):
        if comb(len(elements), size) > MOST_COMBINATIONS:
            what = f"{comb(len(elements), size):,} ways to close {size} of {len(elements)} elements"
            why = f"more than {MOST_COMBINATIONS:,} are too many"
            raise QuestionError(Problem(what, why, "declare fewer `clutches`"))
        choices = list(combinations(elements, size))
        answers = _answered(train, choices)
        found = list(_gears(choices, answers, (source, link), names))
        if found:
            free = _with_verdict({"free"}, choices, answers)
            locked = _with_verdict({"locked", "contradictory"}, choices, answers)
            return _AllGears(size, found, free, locked)
    return _AllGears(len(elements), [])


def _answered(train: GearTrain, choices: Sequence[_Choice]) -> list[Answer]:
    """What the train does with each choice closed."""
    first = next(iter(train.declaration.states.values()))
    states = {_JOINER.join(each) or "none": State(engaged=each, inputs=first.inputs) for each in choices}
    return list(GearTrain(train.declaration.model_copy(update={"states": states})).answers())


def _gears(
    choices: Sequence[_Choice],
    answers: Sequence[Answer],
    ends: tuple[str, str],
    names: Mapping[frozenset[str], Sequence[str]],
) -> Iterator[PossibleGear]:
    for choice, answer in zip(choices, answers, strict=True):
        drive, out = (answer.speeds.get(end) for end in ends)
        if answer.verdict and drive and out is not None:
            ratio = Fraction(drive) / Fraction(out) if out else None
            yield PossibleGear(choice, ratio, tuple(names.get(frozenset(choice), ())))


def _with_verdict(kinds: Collection[str], choices: Sequence[_Choice], answers: Sequence[Answer]) -> tuple[_Choice, ...]:
    return tuple(choice for choice, answer in zip(choices, answers, strict=True) if answer.verdict.kind in kinds)


# ------------------------------------------------------------------------------------------------- series, as paths

Links = Mapping[int, Sequence[int]]
"""By gear, those that may come next."""


def _links(gears: Sequence[PossibleGear], low: Fraction, high: Fraction, single: bool) -> Links:
    ratios = [each.ratio or Fraction(0) for each in gears]
    return {
        at: [
            to
            for to in range(at + 1, len(gears))
            if low <= ratios[at] / ratios[to] <= high and ratios[at] > ratios[to]
            if not single or _is_single(gears[at], gears[to])
        ]
        for at in range(len(gears))
    }


def _count(gears: Sequence[PossibleGear], links: Links, number: int) -> int:
    ways = [1] * len(gears)
    for _ in range(number - 1):
        ways = [sum(ways[to] for to in links[at]) for at in range(len(gears))]
    return sum(ways)


def _widest(gears: Sequence[PossibleGear], links: Links, number: int) -> GearSeries | None:
    """Backwards from the ends: by gear and length, the way on that ends with the least ratio."""
    ratios = [each.ratio or Fraction(0) for each in gears]
    best: list[tuple[Fraction, tuple[int, ...]] | None] = [(ratio, (at,)) for at, ratio in enumerate(ratios)]
    for _ in range(number - 1):
        best = [
            min(((end, (at, *way)) for to in links[at] for end, way in filter(None, [best[to]])), default=None)
            for at in range(len(gears))
        ]
    found = [(ratios[way[0]] / end, way) for end, way in filter(None, best)]
    return None if not found else GearSeries(tuple(gears[at] for at in max(found, key=lambda each: each[0])[1]))


def _evenest(gears: Sequence[PossibleGear], links: Links, number: int) -> GearSeries | None:
    """By ends: between two of them the mean step is given, so that the least sum of squares of steps is most even."""
    logs = [log(each.ratio or 1) for each in gears]
    best: tuple[float, int, tuple[int, ...]] | None = None
    for start in range(len(gears)):
        for end, (sum_, double, way) in _evenest_from(start, gears, links, number, logs).items():
            mean = (logs[start] - logs[end]) / (number - 1)
            found = round(max(sum_ / (number - 1) - mean**2, 0.0), _FIGURES), double, way
            best = found if best is None or found < best else best
    return None if best is None else GearSeries(tuple(gears[at] for at in best[-1]))


_Way = tuple[float, int, tuple[int, ...]]


def _evenest_from(
    start: int, gears: Sequence[PossibleGear], links: Links, number: int, logs: Sequence[float]
) -> dict[int, _Way]:
    """By end, the way with the least sum of squares; of equal ones that with the fewest double shifts."""
    reach: dict[int, _Way] = {start: (0.0, 0, (start,))}
    for _ in range(number - 1):
        after: dict[int, _Way] = {}
        for at, (sum_, double, way) in reach.items():
            for to in links[at]:
                more = not _is_single(gears[at], gears[to])
                new = round(sum_ + (logs[at] - logs[to]) ** 2, _FIGURES), double + more, (*way, to)
                after[to] = min(after.get(to, new), new)
        reach = after
    return reach
