"""Epicyclic sets for a wanted ratio: every tooth set of a kind within bounds, in every mode.

After the coaxial equations at most three counts are free, so all sets are looked at and the answer is complete:
integers decide the ratio, floats only choose which few are compared as Fractions.

This could be asked of the exact join of `synthesis.join`, and is not: for one mode and 12 to 120 teeth the join takes 2
to 30 times as long (Wolfrom sets 22 to 110 times), and only from about 200 teeth on is it as fast for kinds with two
central wheels. One enumeration serves all modes, and charges every set that is refused to one reason in a fixed order.

The ratio of a set is input over output, as gear makers write it (a reduction is above 1, and negative where the
output turns against the input); `ratio_is` turns the question round.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import isfinite
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import decimal
from geartrain.search.epicyclic.epicyclic_sets import EpicyclicSet, RatioIs, SetFindings, SetOrder, set_rank
from geartrain.search.epicyclic.set_enumeration import (
    SetBounds,
    blocks,
    clears,
    places,
    ratio_terms,
    read_bounds,
    room,
)
from geartrain.search.epicyclic.set_kinds import EpicyclicKind, EpicyclicMode, epicyclic_kind
from geartrain.search.search_outcome import Shortfall
from geartrain.search.target_ratio import TargetRatio

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats
    from geartrain.search.tooth_count_ranges import Counts

    Columns = Mapping[str, NDArray[np.int64]]

_MARGIN = 1e-12
"""Relative margin of float comparisons; what falls inside is compared exactly. Rounding stays below 1e-15."""

_FARTHEST = Fraction(10**18)
_FINEST = 10**6
"""Greatest denominator of a clearance: lengths in such parts of a module stay whole numbers of a machine word."""

NO_PLACE = "a wheel out of its bounds, a planet without a place, or steps that are equal"
NO_SPACING = "planets that cannot be put in equally spaced"
NO_ROOM = "neighbouring planets that touch"
NO_MOTION = "a mode that does not run"
NO_SENSE = "the output turns the other way"
NO_MATCH = "a ratio outside the tolerance"


def find_sets(
    wanted: Fraction | TargetRatio,
    kind: str | EpicyclicKind,
    modes: str | Iterable[str | EpicyclicMode] = "all",
    counts: Counts | Mapping[str, Counts] = range(12, 121),
    planets: int = 3,
    tolerance: Fraction | None = None,
    best: int = 20,
    *,
    sense: int = 0,
    ratio_is: RatioIs = "input/output",
    by: SetOrder = "error",
    spaced: bool = True,
    clearance: Fraction | float = 0.0,
    slack: int = 0,
) -> SetFindings:
    """The best tooth sets of an epicyclic kind for a ratio, over modes: every set within bounds is looked at.

    After the coaxial equations at most three counts are free (Willis 1841; Mueller, Epicyclic Drive Trains, 1982). All
    modules are equal.

    Parameters
    ----------
    wanted : Fraction or TargetRatio
        Magnitude of the ratio, above 0; or a ratio that was read, which may ask for a sense.
    kind : str or EpicyclicKind
        "planetary", "stepped-suns", "stepped-sun-ring", "stepped-rings", "meshed-planets", "ravigneaux", "bevel",
        "wolfrom" or "3k-two-suns".
    modes : str or iterable of str or EpicyclicMode
        "all", or any of `input:output:held`, such as "sun:carrier:ring".
    counts : sequence of int, or mapping of str to sequence of int
        Admissible tooth counts from 1 to 10^5, rings included: of every wheel alike, or by wheel.
    planets : int
        How many equal planets there are, 1 or more.
    tolerance : Fraction, optional
        Greatest relative error; default the best ones whatever their error.
    best : int
        How many to list, 1 or more.
    sense : {-1, 0, 1}
        1 or -1 asks for an output that turns with or against the input; 0 leaves it open.
    ratio_is : {"input/output", "output/input"}
        What `wanted` is.
    by : {"error", "total", "largest"}
        What is best: least error, fewest teeth together, or smallest largest wheel.
    spaced : bool
        Only sets whose planets can be equally spaced and clear each other; else this is only reported.
    clearance : Fraction or float
        Least room between the tips of neighbouring planets [modules], where `spaced`.
    slack : int
        Half modules by which centre distances may differ, for profile shift to bridge.

    Returns
    -------
    SetFindings
        The best sets, and where all others went.

    Raises
    ------
    QuestionError
        For what cannot be asked: no such kind, mode or order, a ratio beyond all sets.
    RangeError
        For more than 4 10^8 sets.

    Examples
    --------
    A reduction of 7/2 with four planets; ratio 1 + r/s, and 4 divides s + r:

    >>> found = find_sets(Fraction(7, 2), "planetary", "sun:carrier:ring", range(12, 61), planets=4, best=1)
    >>> dict(found.solutions[0].teeth), found.solutions[0].ratio
    ({'s': 16, 'p': 12, 'r': 40}, Fraction(7, 2))
    """
    kind = epicyclic_kind(kind) if isinstance(kind, str) else kind
    asked = wanted if isinstance(wanted, TargetRatio) else TargetRatio(Fraction(wanted))
    if tolerance is not None:
        tolerance = Fraction(tolerance)
    _check(asked.value, planets, tolerance, best, slack)
    _check_words(by, ratio_is, clearance)
    least = Fraction(clearance).limit_denominator(_FINEST)
    bounds, chosen = read_bounds(kind, counts), kind.chosen(modes)
    search = _Search(kind, asked.value, tolerance, best, ratio_is, by, planets, sense or asked.sense)
    for number, columns in blocks(kind, bounds, planets, least if spaced else None, slack):
        search.considered += number * len(chosen)
        search.charge(NO_PLACE, (number - _length(columns)) * len(chosen))
        if spaced:
            columns = search.assembled(columns, least, len(chosen))
        if _length(columns):
            for at, mode in enumerate(chosen):
                search.judge(columns, at, mode)
    return search.findings(bounds, chosen)


def _check(wanted: Fraction, planets: int, tolerance: Fraction | None, best: int, slack: int) -> None:
    for bad, what, why, fix in (
        (not _FARTHEST > wanted > 1 / _FARTHEST, "a ratio beyond all sets", "none reaches 10^18", "give a nearer one"),
        (planets < 1, f"{planets} planets", "a set has one planet at least", "give 1 or more"),
        (
            tolerance is not None and tolerance < 0,
            f"a tolerance of {tolerance}",
            "no error is below 0",
            "give 0 or more",
        ),
        (best < 1, f"the best {best}", "a list has one place at least", "give 1 or more"),
        (slack < 0, f"a slack of {slack}", "it is a number of half modules", "give 0 or more"),
    ):
        if bad:
            raise QuestionError(Problem(what, why, fix))


def _check_words(by: str, ratio_is: str, clearance: Fraction | float) -> None:
    for word, what, words in (
        (by, "order of sets", get_args(SetOrder)),
        (ratio_is, "kind of ratio", get_args(RatioIs)),
    ):
        if word not in words:
            raise QuestionError(Problem(f"'{word}' is no {what}", "there are others", f"write {' or '.join(words)}"))
    if not isfinite(clearance):
        raise QuestionError(Problem(f"a clearance of {clearance}", "it is a length", "give a number of modules"))


def _length(columns: Columns) -> int:
    return len(next(iter(columns.values())))


class _Search:
    """What is found while sets go by in blocks; rejected ones are charged to the first reason that refuses them."""

    def __init__(
        self, kind: EpicyclicKind, wanted: Fraction, tolerance: Fraction | None, best: int, ratio_is: RatioIs,
        by: SetOrder,
        planets: int, sense: int,
    ) -> None:  # fmt: skip
        self.kind, self.wanted, self.tolerance, self.best = kind, wanted, tolerance, best
        self.ratio_is, self.by, self.planets, self.sense = ratio_is, by, planets, sense
        self.considered = self.count = 0
        self.removed: dict[str, int] = {}
        self.found: list[tuple[tuple[Any, ...], EpicyclicSet]] = []
        self.nearest: EpicyclicSet | None = None

    def charge(self, reason: str, number: int) -> None:
        """Add to what a reason has removed."""
        if number:
            self.removed[reason] = self.removed.get(reason, 0) + number

    def assembled(self, columns: Columns, clearance: Fraction, modes: int) -> Columns:
        """The sets whose planets can be put in and clear each other."""
        even = places(self.kind, columns) % self.planets == 0
        self.charge(NO_SPACING, int((~even).sum()) * modes)
        columns = _rows(columns, even)
        clear = clears(self.kind, columns, self.planets, clearance)
        self.charge(NO_ROOM, int((~clear).sum()) * modes)
        return _rows(columns, clear)

    def judge(self, columns: Columns, at: int, mode: EpicyclicMode) -> None:
        """Look at all sets of a block in one mode."""
        top, beneath = ratio_terms(self.kind, mode, columns)
        runs = (top != 0) & (beneath != 0)
        right = runs if self.sense == 0 else runs & (np.sign(top) * np.sign(beneath) == self.sense)
        self.charge(NO_MOTION, int((~runs).sum()))
        self.charge(NO_SENSE, int((runs & ~right).sum()))
        if not right.any():
            return
        columns, top, beneath = _rows(columns, right), np.abs(top[right]), np.abs(beneath[right])
        ratios = top / beneath if self.ratio_is == "input/output" else beneath / top
        errors = np.abs(ratios / float(self.wanted) - 1)
        self._look(columns, at, mode, errors)

    def _look(self, columns: Columns, at: int, mode: EpicyclicMode, errors: Floats) -> None:
        inside = self._inside(columns, mode, errors)
        self.count += int(inside.sum())
        self.charge(NO_MATCH, int((~inside).sum()))
        if not self.count:
            nearest = self._set(columns, int(errors.argmin()), mode)
            # only while nothing is within the tolerance: an explanation is wanted then
            if self.nearest is None or abs(nearest.error) < abs(self.nearest.error):
                self.nearest = nearest
        if not inside.any():
            return
        columns, errors = _rows(columns, inside), errors[inside]
        first = self._first(columns, errors)
        for row in np.flatnonzero(first <= self._worst(first)):
            found = self._set(columns, int(row), mode)
            self.found.append((set_rank(found, self.by, at), found))
        self.found = sorted(self.found, key=lambda item: item[0])[: self.best]

    def _inside(self, columns: Columns, mode: EpicyclicMode, errors: Floats) -> NDArray[np.bool_]:
        """Within the tolerance: floats where they are sure, Fractions at the edge."""
        if self.tolerance is None:
            return np.ones(len(errors), dtype=bool)
        limit, margin = float(self.tolerance), _MARGIN * (1 + float(self.tolerance))
        inside = errors <= limit - margin
        for row in np.flatnonzero(np.abs(errors - limit) <= margin):
            inside[row] = abs(self._set(columns, int(row), mode).error) <= self.tolerance
        return inside

    def _first(self, columns: Columns, errors: Floats) -> Floats:
        """What sets are ordered by before anything else."""
        if self.by == "error":
            return errors
        stack = np.stack(list(columns.values()))
        return np.asarray(stack.sum(axis=0) if self.by == "total" else stack.max(axis=0), dtype=np.float64)

    def _worst(self, first: Floats) -> float:
        """What a set must not exceed to be among the best."""
        worst = np.inf if len(self.found) < self.best else float(self.found[-1][0][0])
        if len(first) > self.best:
            # the n-th best of this block bounds the n-th best of all
            worst = min(worst, float(np.partition(first, self.best - 1)[self.best - 1]))
        return worst + _MARGIN * (1 + worst) if np.isfinite(worst) else np.inf

    def _set(self, columns: Columns, row: int, mode: EpicyclicMode) -> EpicyclicSet:
        """One set with all that is reported of it, exactly."""
        one = {wheel: columns[wheel][row : row + 1] for wheel in self.kind.wheels}
        top, beneath = (int(term[0]) for term in ratio_terms(self.kind, mode, one))
        ratio = Fraction(top, beneath)
        asked = ratio if self.ratio_is == "input/output" else 1 / ratio
        return EpicyclicSet(
            self.kind.name,
            mode,
            {wheel: int(column[0]) for wheel, column in one.items()},
            ratio,
            abs(asked) / self.wanted - 1,
            self.planets,
            int(places(self.kind, one)[0]),
            float(room(self.kind, one, self.planets)[0]),
        )

    def findings(self, bounds: SetBounds, modes: tuple[EpicyclicMode, ...]) -> SetFindings:
        """All that was found, with an explanation."""
        shortfall = Shortfall(self.considered, dict(self.removed), *self._miss())
        found = tuple(item for _, item in self.found)
        return SetFindings(
            self.kind.name, self.wanted, self.ratio_is, modes, self.tolerance, True, self.count, found, shortfall
        )

    def _miss(self) -> tuple[str, str]:
        """The nearest miss and what to relax, in words; empty where something was found."""
        if self.count:
            return "", ""
        if self.nearest is None and NO_SENSE in self.removed:
            return "", "every set that runs turns the other way: ask for the other sense, for none, or for other modes"
        if self.nearest is None:
            reason = max(self.removed, key=lambda name: self.removed[name])
            return (
                "",
                f"no set came as far as its ratio, most fell to: {reason}; widen the counts or change the planets",
            )
        error = decimal(abs(self.nearest.error), 3)
        nearest = f"{self.nearest}, error {decimal(self.nearest.error, 3)}"
        return nearest, f"a tolerance of {error} keeps it; wider counts may bring a nearer one"


def _rows(columns: Columns, good: NDArray[np.bool_]) -> dict[str, NDArray[np.int64]]:
    return {wheel: column[good] for wheel, column in columns.items()}
