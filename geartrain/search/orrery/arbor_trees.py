"""Trees of arbors with requested periods: minimum number of wheels, and enumeration up to a given size.

A table contains the distinct ratios of two wheels. The number of wheels of a tree is minimised by branch and bound over
the tooth counts, which are multiples of the terms of its ratios. Trees are enumerated up to a number of intermediate
arbors, which have no requested period.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.exact import times

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

ROUNDING = 1e-12
"""Upper bound of the rounding error of the logarithms of periods and ratios, for logarithms with a magnitude below
100.
"""
_MOST_PAIRS = 2 * 10**7  # maximum number of pairs of counts in the table
_MOST_STEPS = 4000  # maximum for one tree; a first complete assignment is always found


@dataclass(frozen=True)
class PeriodTargets:
    """Requested periods [revolutions of the first arbor] and their tolerances."""

    names: tuple[str, ...]
    """Names of the requested periods."""
    periods: tuple[Fraction, ...]
    """Exact positive periods that are requested [revolutions of the first arbor]."""
    tolerances: tuple[Fraction, ...]
    """Exact maximum absolute relative error of the speed of each requested period, below 1."""

    @cached_property
    def bounds(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """Minimum and maximum admissible value of each period [revolutions of the first arbor]."""
        # tolerances apply to speeds, the reciprocals of periods
        both = zip(self.periods, self.tolerances, strict=True)
        return tuple((period / (1 + slack), period / (1 - slack)) for period, slack in both)

    @cached_property
    def logs(self) -> tuple[tuple[float, float], ...]:
        """Natural logarithms of the bounds of each period, (minimum, maximum). Both are moved outwards by `ROUNDING`,
        so that rounding errors exclude no admissible period.
        """
        return tuple((math.log(low) - ROUNDING, math.log(high) + ROUNDING) for low, high in self.bounds)

    @property
    def everything(self) -> int:
        """Bit mask in which the bits of all requested periods are set."""
        return (1 << len(self.periods)) - 1

    def meets(self, target: int, ratio: Fraction) -> bool:
        """Return whether an arbor whose period is `ratio` meets the requested period with index `target` within its
        tolerance, by exact comparison.
        """
        low, high = self.bounds[target]
        return low <= ratio <= high

    def error(self, target: int, ratio: Fraction) -> Fraction:
        """Return the relative speed error of an arbor whose period is `ratio`: its speed divided by the requested
        speed, minus 1. The error is positive if the arbor is too fast.
        """
        return self.periods[target] / ratio - 1


def read_period_targets(
    periods: Mapping[str, Fraction], tolerance: Fraction | float | Mapping[str, Fraction | float]
) -> PeriodTargets:
    """Build the targets from periods keyed by name, and from one relative tolerance for all periods or one for each
    period.
    """
    if not periods:
        fix = "give a period, such as moon=29.53"
        raise QuestionError(Problem("no periods are given", "an orrery has at least one pointer", fix))
    if len(periods) > 30:
        what, why = f"{len(periods)} periods are too many", "one search accepts at most 30 periods"
        raise RangeError(Problem(what, why, "split the periods between several searches"))
    slack = tolerance if isinstance(tolerance, Mapping) else dict.fromkeys(periods, tolerance)
    problems = [
        Problem(f"period {name!r} is {value}", "a period must be positive", "give a number above 0")
        for name, value in periods.items()
        if value <= 0
    ]
    for name in periods:
        if not 0 <= slack.get(name, -1) < 1:
            what = f"the tolerance of {name!r} is {slack.get(name)}"
            why = "a relative tolerance must be at least 0 and below 1"
            problems.append(Problem(what, why, "give a tolerance such as 1e-6"))
    if problems:
        raise QuestionError(problems)
    return PeriodTargets(
        tuple(periods),
        tuple(Fraction(value) for value in periods.values()),
        # the shortest decimal of a float, so that 1e-6 is exactly 1/1000000
        tuple(Fraction(str(slack[name])) for name in periods),
    )


def members(bits: int) -> Iterator[int]:
    """Yield the indices of the bits that are set in a bit mask."""
    at = 0
    while bits >> at:
        if bits >> at & 1:
            yield at
        at += 1


# ------------------------------------------------------------------------------------------- ratios of one gear pair


@dataclass(frozen=True)
class PairRatios:
    """Table of the distinct ratios of two wheels (driven tooth count divided by driver tooth count), in ascending
    order.
    """

    counts: tuple[int, ...]
    """Admissible tooth counts, in ascending order."""
    driven: Ints
    """Numerators of the ratios in lowest terms, shape (n,), where n is the number of ratios."""
    driver: Ints
    """Denominators of the ratios in lowest terms, shape (n,), where n is the number of ratios."""
    logs: Floats
    """Natural logarithms of the ratios, shape (n,), where n is the number of ratios."""
    _choices: dict[tuple[int, int], tuple[tuple[int, int], ...]] = field(default_factory=dict, repr=False)

    def __len__(self) -> int:
        return len(self.logs)

    def terms(self, at: int) -> tuple[int, int]:
        """Return the numerator (driven) and the denominator (driver) of the ratio with index `at`, in lowest terms."""
        return int(self.driven[at]), int(self.driver[at])

    def choices(self, driven: int, driver: int) -> tuple[tuple[int, int], ...]:
        """Return all pairs of admissible tooth counts (driven, driver) that have a given ratio. The arguments are the
        numerator and the denominator of the ratio in lowest terms. Pairs with the fewest teeth come first.
        """
        found = self._choices.get((driven, driver))
        if found is None:
            # largest multiple of the ratio within the admissible counts
            most = self.counts[-1] // max(driven, driver)
            admissible = set(self.counts)
            wheels = ((driven * times, driver * times) for times in range(1, most + 1))
            found = tuple(pair for pair in wheels if admissible.issuperset(pair))
            self._choices[driven, driver] = found
        return found

    def between(self, low: Fraction, high: Fraction) -> list[int]:
        """Return the indices of the ratios between `low` and `high`, both inclusive, by exact comparison."""
        first = int(np.searchsorted(self.logs, math.log(low) - ROUNDING))
        last = int(np.searchsorted(self.logs, math.log(high) + ROUNDING))
        return [at for at in range(first, last) if low <= Fraction(*self.terms(at)) <= high]


def pair_ratios(counts: Sequence[int]) -> PairRatios:
    """Return the table of ratios of two wheels. Time and memory grow with the square of the number of tooth counts."""
    admissible = tuple(sorted(set(counts)))
    if not admissible or admissible[0] < 1:
        what = "no tooth counts are given, or some are below 1"
        why = "at least one count is needed, and all counts must be positive"
        raise QuestionError(Problem(what, why, "give a range such as 12:400"))
    # terms below 2^31, because both terms of a ratio are packed into one integer below
    if admissible[-1] >= 2**31:
        what, why = f"the tooth count {admissible[-1]} is too large", "tooth counts are limited to 2^31 - 1"
        raise RangeError(Problem(what, why, "reduce the upper end of the range"))
    if len(admissible) ** 2 > _MOST_PAIRS:
        what = f"{len(admissible)} tooth counts are too many"
        why = f"the table of ratios is limited to {_MOST_PAIRS:.0e} entries, one for each pair of counts"
        raise RangeError(Problem(what, why, "narrow the range of tooth counts"))
    teeth = np.array(admissible, dtype=np.int64)
    over, under = (part.ravel() for part in np.meshgrid(teeth, teeth))
    common = np.gcd(over, under)
    # a ratio in lowest terms packed into one integer below 2^62, for np.unique
    shift = admissible[-1] + 1
    keys = np.unique(over // common * shift + under // common)
    over, under = keys // shift, keys % shift
    logs = np.log(over / under)
    # ratios with equal rounded logarithms are ordered by their terms, so that the order is deterministic
    order = np.lexsort((under, logs))
    return PairRatios(admissible, over[order], under[order], logs[order])


@dataclass(frozen=True)
class ReachablePeriods:
    """Intermediate arbors, m in number, from which one gear pair can drive at least one requested period. Another gear
    pair drives each intermediate arbor from a common arbor.
    """

    first: Ints
    """Index of the ratio of the pair that drives the intermediate arbor, shape (m,)."""
    next: Ints
    """Index of the ratio of the pair that drives each target from the intermediate arbor, shape (m, targets); -1 if no
    pair can drive the target.
    """


def reach(table: PairRatios, targets: PeriodTargets, log_period: float, requested: int) -> ReachablePeriods:
    """Return all intermediate arbors, driven by one gear pair, from which a second gear pair can drive at least one
    requested period.

    log_period   natural logarithm of the period of the arbor that drives the intermediate arbors
    requested    bit mask of the requested periods that are considered; the bit of the period with index i is 2^i

    If several ratios lead to a period, one of them is returned. Ratios are selected in floating point with a margin, so
    the caller must check the periods exactly.
    """
    logs, size = table.logs, len(table)
    found = np.full((len(targets.periods), size), -1, dtype=np.int32)
    # remainders after a first pair, up to a constant, in ascending order
    falling = -logs[::-1]
    for target in members(requested):
        low, high = targets.logs[target][0] - log_period - ROUNDING, targets.logs[target][1] - log_period + ROUNDING
        # ratios from which no single pair reaches the target are skipped
        begin, end = np.searchsorted(falling, [logs[0] - high, logs[-1] - low + ROUNDING])
        start = np.searchsorted(logs, falling[begin:end] + low)
        good = np.append(logs, np.inf)[start] <= falling[begin:end] + high
        found[target, size - 1 - begin - np.flatnonzero(good)] = start[good]
    first = np.flatnonzero((found >= 0).any(axis=0))
    return ReachablePeriods(first, found[:, first].T.astype(np.int64))


# ----------------------------------------------------------------------------------------- the fewest wheels of a tree


Edge = tuple[int, int, int, int]
"""Gear pair: index of the driving arbor, index of the driven arbor, and the numerator (driven) and denominator (driver)
of the ratio in lowest terms.
"""
Meshes = tuple[tuple[int, int], ...]
"""Pairs of tooth counts (driving wheel, driven wheel), one for each gear pair."""


def fewest_wheels(table: PairRatios, edges: Sequence[Edge]) -> tuple[int, Meshes, bool]:
    """Return the minimum number of wheels of a tree, the tooth counts of each pair, and whether the number is proved to
    be minimal.

    Pairs with equal tooth counts on one arbor share one wheel, and a wheel may mesh with any number of wheels. The
    search is branch and bound over the tooth counts that can coincide. If the search reaches its maximum number of
    steps, the returned number is only an upper bound.
    """
    choices = [[(driver, driven) for driven, driver in table.choices(*edge[2:])] for edge in edges]
    users: dict[tuple[int, int], int] = {}
    for edge, pairs in zip(edges, choices, strict=True):
        for pair in pairs:
            for wheel in zip(edge[:2], pair, strict=True):
                users[wheel] = users.get(wheel, 0) + 1
    options, hopes = [], []
    for (parent, child, *_), pairs in zip(edges, choices, strict=True):
        # of the choices that cannot be shared with another pair, one is sufficient
        fresh = [(users[parent, driver] == 1) + (users[child, driven] == 1) for driver, driven in pairs]
        shared = [pair for pair, new in zip(pairs, fresh, strict=True) if new < 2]
        options.append(shared or pairs[:1])
        hopes.append(min(fresh))
    # lower bound of the wheels of the pairs from each index on
    rest = [sum(hopes[at:]) for at in range(len(edges) + 1)]
    used: Counter[tuple[int, int]] = Counter()
    best: tuple[int, Meshes] = 2 * len(edges) + 1, ()
    steps = 0

    def descend(at: int, wheels: int, taken: Meshes) -> None:
        """Assign tooth counts to the pairs with index `at` and above. `wheels` is the number of wheels already in
        use.
        """
        nonlocal best, steps
        if at == len(edges):
            best = min(best, (wheels, taken), key=lambda found: found[0])
            return
        parent, child = edges[at][:2]
        # choices that share most wheels first, so that good bounds are found early
        ranked = sorted(
            (int(not used[parent, driver]) + int(not used[child, driven]), driver + driven, driver, driven)
            for driver, driven in options[at]
        )
        for fresh, _, *pair in ranked:
            steps += 1
            if steps > _MOST_STEPS and best[1]:
                return
            # the remaining pairs need at least `rest` further wheels
            if wheels + fresh + rest[at + 1] < best[0]:
                own = (parent, pair[0]), (child, pair[1])
                used.update(own)
                descend(at + 1, wheels + fresh, (*taken, (pair[0], pair[1])))
                used.subtract(own)

    descend(0, 0, ())
    return *best, steps <= _MOST_STEPS


# ----------------------------------------------------------------------------------------------------------- all trees


@dataclass(frozen=True, slots=True)
class TreeArbor:
    """Arbor of a tree, with the ratio of the gear pair that drives it."""

    target: int
    """Index of the requested period of the arbor; -1 for the first arbor and for an intermediate arbor."""
    parent: int
    """Index of the arbor that drives this arbor; -1 for the first arbor."""
    driven: int
    """Numerator of the ratio of the pair that drives the arbor, in lowest terms."""
    driver: int
    """Denominator of the ratio of the pair that drives the arbor, in lowest terms."""
    n: int
    """Numerator of the period of the arbor [revolutions of the first arbor], in lowest terms."""
    d: int
    """Denominator of the period of the arbor [revolutions of the first arbor], in lowest terms."""

    @property
    def period(self) -> Fraction:
        """Period of the arbor [revolutions of the first arbor]."""
        return Fraction(self.n, self.d)

    @property
    def log(self) -> float:
        """Natural logarithm of the period of the arbor."""
        return math.log(self.n) - math.log(self.d)


ArborTree = tuple[TreeArbor, ...]

FIRST = TreeArbor(-1, -1, 1, 1, 1, 1)


def grown(tree: ArborTree, target: int, parent: int, driven: int, driver: int) -> TreeArbor:
    """Return a new arbor that is driven from arbor `parent` of the tree by a pair with the ratio driven / driver.

    target   index of the requested period of the new arbor; -1 for an intermediate arbor
    """
    n, d = times(tree[parent].n, tree[parent].d, driven, driver)
    return TreeArbor(target, parent, driven, driver, n, d)


def edges(tree: ArborTree) -> list[Edge]:
    """Return the gear pairs of a tree of arbors."""
    return [(arbor.parent, at, arbor.driven, arbor.driver) for at, arbor in enumerate(tree) if at]


class TreeEnumeration:
    """Enumeration of every tree of arbors that has exactly `extra` intermediate arbors and one arbor for each requested
    period.

    A period that one pair can drive from an arbor is driven from this arbor, or else from a later arbor; both are
    tried. Each tree is visited once for each order in which its intermediate arbors can be added.
    """

    def __init__(
        self, table: PairRatios, targets: PeriodTargets, extra: int, tell: Callable[[int, int], None] | None = None
    ) -> None:
        self.table, self.targets, self.extra, self.tell = table, targets, extra, tell

    def trees(self) -> Iterator[ArborTree]:
        """Yield all trees of arbors that have exactly `extra` intermediate arbors and drive all requested periods."""
        yield from self._with_targets((FIRST,), self.targets.everything, self.extra, 0)

    def _with_targets(
        self, tree: ArborTree, left: int, extra: int, requested: int, blank: bool = True
    ) -> Iterator[ArborTree]:
        """Yield all complete trees that extend a tree by new arbors. Arbors with an index below `requested` drive no
        further arbors with a requested period.

        left        bit mask of the requested periods that no arbor has yet
        extra       number of intermediate arbors that are still to be added
        requested   index of the arbor for which driven arbors are chosen next
        blank       False if the arbor with index `requested` must drive at least one arbor with a requested period
        """
        if requested == len(tree):
            if left:
                yield from self._with_extra_arbor(tree, left, extra)
            elif not extra:
                driving = {arbor.parent for arbor in tree}
                # an intermediate arbor must drive another arbor
                if all(arbor.target >= 0 or at in driving for at, arbor in enumerate(tree)):
                    yield tree
            return
        from_here = []
        for target in members(left):
            low, high = self.targets.bounds[target]
            period = tree[requested].period
            found = self.table.between(low / period, high / period)
            if found:
                from_here.append([None, *(grown(tree, target, requested, *self.table.terms(at)) for at in found)])
        for taken in product(*from_here):
            arbors = tuple(arbor for arbor in taken if arbor is not None)
            if not arbors and not blank:
                continue
            # targets that are not driven yet
            rest = left & ~sum(1 << arbor.target for arbor in arbors)
            yield from self._with_targets(tree + arbors, rest, extra, requested + 1)

    def _with_extra_arbor(self, tree: ArborTree, left: int, extra: int) -> Iterator[ArborTree]:
        """Yield all complete trees in which one more intermediate arbor is driven from any arbor of the tree. The bit
        mask `left` selects the periods without an arbor; `extra` intermediate arbors are to be added in total.
        """
        if not extra:
            return
        for parent, arbor in enumerate(tree):
            ways: Sequence[int] = range(len(self.table))
            # with one or two arbors left, a new arbor must have targets in reach
            if extra <= 2:
                ways = reach(self.table, self.targets, arbor.log, left).first.tolist()
            for done, at in enumerate(ways):
                if self.tell and extra == self.extra:
                    self.tell(parent * len(ways) + done, len(tree) * len(ways))
                new = grown(tree, -1, parent, *self.table.terms(at))
                yield from self._with_targets((*tree, new), left, extra - 1, len(tree), blank=extra > 2)
            # the pairs above omit a first arbor that drives only the second
            if extra == 2:
                yield from self._with_extra_chain(tree, left, parent)

    def _with_extra_chain(self, tree: ArborTree, left: int, parent: int) -> Iterator[ArborTree]:
        """Yield the trees with two more intermediate arbors in a chain: arbor `parent` drives the first of them, which
        drives only the second.

        The second arbor drives at least one target, so its period is determined from the targets.
        """
        logs, start = self.table.logs, tree[parent].log
        seen: set[tuple[int, int]] = set()
        for target in members(left):
            low, high = self.targets.logs[target]
            for last in logs.tolist():
                first = np.searchsorted(logs, low - last - start - logs - ROUNDING)
                end = np.searchsorted(logs, high - last - start - logs + ROUNDING)
                for one in np.flatnonzero(end > first).tolist():
                    seen.update((one, two) for two in range(first[one], end[one]))
        for one, two in sorted(seen):
            inner = (*tree, grown(tree, -1, parent, *self.table.terms(one)))
            outer = (*inner, grown(inner, -1, len(tree), *self.table.terms(two)))
            yield from self._with_targets(outer, left, 0, len(inner))
