"""Search for a gear train with few wheels that drives pointers of several periods from one arbor."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import as_float, fraction_text
from geartrain.numerics.results import Key, Result, Tabular
from geartrain.search.orrery.arbor_trees import (
    FIRST,
    ArborTree,
    PairRatios,
    PeriodTargets,
    ReachablePeriods,
    TreeEnumeration,
    edges,
    fewest_wheels,
    grown,
    pair_ratios,
    reach,
    read_period_targets,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


_TRIED = 20  # number of moves of each gain that are evaluated exactly
_ALIKE = 3  # number of trees with the same targets and periods that are selected before other trees
_Key = frozenset[tuple[int, int, int]]
_WALKABLE = 2 * 10**5  # maximum number of steps of an enumeration by default
_SEEDS_A_PART = 4  # initial intermediate arbors for each tree of the beam

Tell = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class OrreryArbor(Result):
    """Arbor of an orrery, with its period, its sense of rotation and its wheels."""

    KEYS = ("name", "period", Key("value", "period", as_float), "sense", "wheels", "shows")

    name: str
    """Name of the requested period of the arbor. Intermediate arbors are named `arbor 1`, `arbor 2` and so on, and the
    caller gives the name of the first arbor.
    """
    period: Fraction
    """Exact period [revolutions of the first arbor], positive."""
    sense: int
    """Sense of rotation relative to the first arbor: 1 for the same sense, -1 for the opposite sense. Every pair is
    external and reverses the sense.
    """
    wheels: tuple[int, ...]
    """Distinct tooth counts of the wheels on the arbor, in ascending order."""
    shows: bool
    """True if the arbor carries the pointer of a requested period."""


@dataclass(frozen=True, slots=True)
class OrreryPair(Result):
    """Gear pair between a driving wheel on arbor `parent` and a driven wheel on arbor `child`."""

    driver: int
    """Tooth count of the driving wheel."""
    driven: int
    """Tooth count of the driven wheel."""
    parent: str
    """Name of the arbor that carries the driving wheel."""
    child: str
    """Name of the arbor that carries the driven wheel."""


@dataclass(frozen=True, slots=True)
class Orrery(Tabular, Result):
    """Tree of gear pairs that drives a pointer for each requested period.

    See Also
    --------
    find_orrery : Search for an orrery.
    """

    ROWS = "search.tooth_numbers_report:orrery_rows"
    ROW = "OrreryPair"

    PAGE = "search.tooth_numbers_report:describe_orrery"

    KEYS = (
        "wheels",
        "pairs",
        "arbors",
        Key("errors", keys=(Key("value", ".", float), Key("exact", "."))),
        "minimum_pairs",
        "minimum_wheels",
        "complete",
        "ended",
    )

    periods: Mapping[str, Fraction]
    """Requested periods, keyed by name [revolutions of the first arbor]."""
    tolerances: Mapping[str, Fraction]
    """Maximum absolute relative error of the speed of each pointer, keyed by the name of its period."""
    arbors: tuple[OrreryArbor, ...]
    """Arbors in topological order: the first arbor first, and every other arbor after the arbor that drives it."""
    pairs: tuple[OrreryPair, ...]
    """Gear pairs in the order of their driven arbors."""
    errors: Mapping[str, Fraction]
    """Exact relative error of the speed of each pointer, keyed by the name of its period: speed divided by requested
    speed, minus 1. It is positive if the arbor is too fast.
    """
    minimum_pairs: int
    """Proved lower bound on the number of gear pairs. All trees with fewer pairs were enumerated."""
    minimum_wheels: int
    """Proved lower bound on the number of wheels."""
    ended: str
    """Reason why the search ended: "proved", "effort" (the maximum width of the beam was reached) or "interrupted"."""

    def _summary(self) -> str:
        worst = max((abs(error) for error in self.errors.values()), default=0)
        return f"{len(self.pairs)} pairs for {', '.join(self.periods)}: error at most {float(worst):.3g}"

    @property
    def wheels(self) -> int:
        """Number of wheels. A wheel that meshes with several wheels is counted once."""
        return sum(len(arbor.wheels) for arbor in self.arbors)

    @property
    def complete(self) -> bool:
        """True if the search proved that no orrery has fewer wheels."""
        return self.wheels <= self.minimum_wheels

    @property
    def worst(self) -> Fraction:
        """Maximum absolute relative error of the speeds of all pointers."""
        return max(map(abs, self.errors.values()))

    def to_train(self, name: str = "orrery", unit: str = "d") -> dict[str, Any]:
        """Return a declaration of the orrery as plain data. The first arbor turns once per `unit`. Each output has its
        exact speed as expected value and its requested period as target.

        A shared wheel is declared as one wheel in several gear pairs. All arbors are mounted in one frame on separate
        axes.

        Parameters
        ----------
        name : str
            Name of the train.
        unit : str
            Unit of time in which the first arbor turns once, such as "d".
        """
        places = {arbor.name: at for at, arbor in enumerate(self.arbors)}
        links: dict[str, Any] = {"frame": {}}
        for at, arbor in enumerate(self.arbors):
            links[arbor.name] = {"wheels": {_wheel(at, count): count for count in arbor.wheels}}
        gears = [
            {"pair": [_wheel(places[pair.parent], pair.driver), _wheel(places[pair.child], pair.driven)]}
            for pair in self.pairs
        ]
        outputs = {}
        for arbor in self.arbors:
            if arbor.shows:
                period = f"{_plain(self.periods[arbor.name])} {unit}"
                target = {"period": period, "tolerance": _plain(self.tolerances[arbor.name])}
                outputs[arbor.name] = {"expect": str(Fraction(arbor.sense) / arbor.period), "targets": [target]}
        pointers = ", ".join(f"{pointer} in {_plain(period)} {unit}" for pointer, period in self.periods.items())
        return {
            "name": name,
            "title": f"Pointers from one arbor: {pointers}",
            "frame": "frame",
            "unit": {"per": f"1 {unit}"},
            "links": links,
            "revolutes": [{"pair": ["frame", arbor.name], "axis": arbor.name} for arbor in self.arbors],
            "gears": gears,
            "inputs": {self.arbors[0].name: 1},
            "outputs": outputs,
        }


def _wheel(arbor: int, count: int) -> str:
    """Return the name of a wheel from the index of its arbor and its tooth count. For example, `a3-120` has 120 teeth
    and is on arbor 3.
    """
    return f"a{arbor}-{count}"


def _plain(value: Fraction) -> str:
    """Format a fraction exactly: as a decimal number if the decimal terminates within 18 digits, and as a quotient of
    integers if it does not.
    """
    for digits in range(19):
        scaled = value * 10**digits
        if scaled.denominator == 1:
            whole = str(scaled.numerator).rjust(digits + 1, "0")
            return f"{whole[:-digits]}.{whole[-digits:]}" if digits else whole
    return fraction_text(value)


def find_orrery(
    periods: Mapping[str, Fraction],
    counts: Sequence[int],
    tolerance: Fraction | float | Mapping[str, Fraction | float],
    *,
    first: str = "day",
    effort: int = 16,
    walk: int | None = None,
    tell: Tell | None = None,
) -> Orrery:
    """Find an orrery with few wheels, by branch and bound over small trees and beam search over larger trees.

    The orrery is a tree of arbors with external gear pairs, driven from the first arbor. The enumeration proves lower
    bounds. Wider beams can find better solutions, but do not prove bounds; see `Orrery.minimum_pairs`, `minimum_wheels`
    and `complete`. The result is deterministic unless the user interrupts the search.

    Parameters
    ----------
    periods : mapping of str to Fraction
        Name -> period [revolutions of the first arbor], above 0; at most 30 periods.
    counts : sequence of int
        Admissible tooth counts of every wheel.
    tolerance : Fraction, float, or mapping of str to these
        Maximum absolute relative error of a speed, at least 0 and below 1; one value for all periods, or a value for
        each name.
    first : str
        Name of the first arbor.
    effort : int
        Maximum width of the beam. The width is quadrupled from search to search, up to this value. The run time is
        nearly proportional to the width.
    walk : int, optional
        Maximum number of intermediate arbors, which carry no pointer, in the trees that are enumerated. By default 1,
        or more if the enumeration is fast.
    tell : callable, optional
        Progress function, called with (done, total) for the current stage of the search.

    Returns
    -------
    Orrery
        Best orrery that was found; after a keyboard interrupt, the best one found until then.

    Raises
    ------
    QuestionError
        If no orrery was found (the message reports the proved bounds), or if the input is invalid.
    RangeError
        If the range of tooth counts is too large for a table.

    Examples
    --------
    Jupiter with 12 years and Saturn with 30 need six wheels, which is the minimum:

    >>> periods = {"jupiter": Fraction(12), "saturn": Fraction(30)}
    >>> found = find_orrery(periods, range(12, 61), tolerance=0, first="year")
    >>> found.wheels, found.complete, found.worst
    (6, True, Fraction(0, 1))
    """
    targets = read_period_targets(periods, tolerance)
    if first in targets.names:
        what = f"the first arbor and a period are both named {first!r}"
        why = "arbors are named after their periods, and names of arbors must be unique"
        raise QuestionError(Problem(what, why, f"give the period another name, such as '{first} hand'"))
    if "frame" in (first, *targets.names):
        what, why = "an arbor is named 'frame'", "this name is reserved for the link that carries the arbors"
        raise QuestionError(Problem(what, why, "give the period or the first arbor another name"))
    search = _OrrerySearch(pair_ratios(counts), targets, tell)
    ended = search.run(effort, walk)
    if search.best is None:
        raise _not_found(search, ended)
    return _orrery(search, first, ended)


class _OrrerySearch:
    """State of a search: the best tree found so far, and the lower bounds proved so far."""

    def __init__(self, table: PairRatios, targets: PeriodTargets, tell: Tell | None) -> None:
        self.table, self.targets, self.tell = table, targets, tell
        self.best: tuple[tuple[int, int, Fraction], ArborTree] | None = None
        self.sure = True
        self.walked = -1
        self.minimum_pairs = len(targets.periods)

    def run(self, effort: int, walk: int | None) -> str:
        try:
            extra, steps = 0, 1
            while extra <= (1 if walk is None else walk) or (walk is None and steps <= _WALKABLE):
                self._walk(extra)
                if self.proved:
                    return "proved"
                extra += 1
                # each intermediate arbor multiplies the work by the number of ratios times the number of arbors
                steps *= len(self.table) * extra
            # iterative widening: each beam costs about four times the previous one, all narrower ones together a third
            width = 4
            while width // 4 < max(effort, 1):
                beam = min(width, max(effort, 1))
                for part in BeamSearch(self.table, self.targets, self.tell).run(beam, _SEEDS_A_PART * beam):
                    self._offer(part.tree)
                width *= 4
        except KeyboardInterrupt:
            return "interrupted"
        return "proved" if self.proved else "effort"

    def _walk(self, extra: int) -> None:
        """Enumerate all trees with `extra` intermediate arbors."""
        found = False
        for tree in TreeEnumeration(self.table, self.targets, extra, self.tell).trees():
            found = True
            self._offer(tree)
        self.walked = extra
        # no tree of this size exists, so the bound is raised
        if not found and self.minimum_pairs == len(self.targets.periods) + extra:
            self.minimum_pairs += 1

    def _offer(self, tree: ArborTree) -> None:
        """Keep a tree if it is better than the best tree found so far. Trees are compared by the number of wheels, then
        by the number of pairs, then by the maximum error.
        """
        wheels, _, proved = fewest_wheels(self.table, edges(tree))
        # an unproved number of wheels is only an upper bound, so it proves nothing
        self.sure = self.sure and proved
        cost = wheels, len(tree)
        if self.best is not None and cost > self.best[0][:2]:
            return
        worst = max(abs(self.targets.error(arbor.target, arbor.period)) for arbor in tree if arbor.target >= 0)
        if self.best is None or (*cost, worst) < self.best[0]:
            self.best = ((*cost, worst), tree)

    @property
    def minimum_wheels(self) -> int:
        """Proved lower bound on the number of wheels.

        Every arbor has at least one wheel. In a tree with the minimum number of wheels, every intermediate arbor has
        two or more wheels, because an arbor with one wheel is an idler, whose neighbours can mesh directly. Trees that
        were not enumerated have more intermediate arbors than the enumerated trees.
        """
        unseen = len(self.targets.periods) + 1 + 2 * (self.walked + 1)
        return unseen if self.best is None or not self.sure else min(unseen, self.best[0][0])

    @property
    def proved(self) -> bool:
        """True if it is proved that no orrery has fewer wheels than the best orrery found."""
        return self.best is not None and self.best[0][0] <= self.minimum_wheels


def _orrery(search: _OrrerySearch, first: str, ended: str) -> Orrery:
    assert search.best is not None
    tree, targets = search.best[1], search.targets
    free = (name for name in map("arbor {}".format, count(1)) if name not in (first, *targets.names))
    names = [first, *(targets.names[arbor.target] if arbor.target >= 0 else next(free) for arbor in tree[1:])]
    _, meshes, _ = fewest_wheels(search.table, edges(tree))
    pairs = tuple(
        OrreryPair(*mesh, names[arbor.parent], name)
        for arbor, name, mesh in zip(tree[1:], names[1:], meshes, strict=True)
    )
    wheels: dict[str, set[int]] = {name: set() for name in names}
    senses = {first: 1}
    for pair in pairs:
        wheels[pair.parent].add(pair.driver)
        wheels[pair.child].add(pair.driven)
        senses[pair.child] = -senses[pair.parent]
    arbors = (
        OrreryArbor(name, arbor.period, senses[name], tuple(sorted(wheels[name])), arbor.target >= 0)
        for name, arbor in zip(names, tree, strict=True)
    )
    return Orrery(
        dict(zip(targets.names, targets.periods, strict=True)),
        dict(zip(targets.names, targets.tolerances, strict=True)),
        tuple(arbors),
        pairs,
        {
            targets.names[arbor.target]: targets.error(arbor.target, arbor.period)
            for arbor in sorted(tree, key=lambda arbor: arbor.target)
            if arbor.target >= 0
        },
        search.minimum_pairs,
        search.minimum_wheels,
        ended,
    )


def _not_found(search: _OrrerySearch, ended: str) -> QuestionError:
    table, size = search.table, len(search.targets.periods)
    minimum, most = table.counts[0], table.counts[-1]
    walked = f"all trees with up to {size + search.walked} pairs were enumerated. " if search.walked >= 0 else ""
    stopped = "the search was interrupted. " if ended == "interrupted" else ""
    what = f"no orrery was found for {size} periods with wheels of {minimum} to {most} teeth"
    why = f"{walked}{stopped}with these tooth counts one pair has {len(table)} ratios, at most {most / minimum:.3g}"
    fix = "increase the tolerance, the number of intermediate arbors or the beam width, or allow more tooth counts"
    return QuestionError(Problem(what, why, fix))


# ------------------------------------- beam search: trees with few wheels, without proof


@dataclass(frozen=True, slots=True)
class PartialTree:
    """Partial tree of a beam search, its cost, and the targets that it does not yet drive."""

    tree: ArborTree
    left: int
    wheels: int
    """Minimum number of wheels in the gear pairs of the tree."""
    bulk: float
    """Sum of the natural logarithms of the numerators and denominators of all ratios in the tree.

    Small numerators and denominators have many admissible multiples, so wheels can be shared more often.
    """

    @property
    def rank(self) -> tuple[int, float]:
        """Sort key of the tree, lower is better: its number of wheels, then the sum of the logarithms of the numerators
        and denominators of its ratios.
        """
        return self.wheels, self.bulk

    @property
    def key(self) -> _Key:
        """Set of (index of the requested period, numerator and denominator of the period) of all arbors. Trees with
        equal sets are duplicates.
        """
        return frozenset((arbor.target, arbor.n, arbor.d) for arbor in self.tree)


class BeamSearch:
    """Beam search that adds targets to trees. Among trees with the same number of targets, it keeps the `width` best
    trees.

    A move drives a target directly from an arbor, or adds an intermediate arbor with all targets that one pair can
    drive from it. The rank of a move takes into account the wheels that a new pair can share with pairs on the same
    arbor. They are counted approximately for all moves, by common multiples, and exactly for selected moves. The search
    is deterministic.
    """

    def __init__(
        self, table: PairRatios, targets: PeriodTargets, tell: Callable[[int, int], None] | None = None
    ) -> None:
        self.table, self.targets, self.tell = table, targets, tell
        self._bulk = np.log(table.driven.astype(float)) + np.log(table.driver.astype(float))
        self._windows = np.array(targets.logs).T
        # stable sort: ties are ordered by ratio, on every machine
        self._plainest = np.argsort(self._bulk, kind="stable")

    def run(self, width: int, seeds: int) -> Iterator[PartialTree]:
        """Yield complete trees in the order in which they are found.

        seeds   number of further initial trees, each with one intermediate arbor driven from the first arbor
        """
        size = len(self.targets.periods)
        root = PartialTree((FIRST,), self.targets.everything, 0, 0.0)
        # initial intermediate arbors lead to targets that two pairs from the first arbor cannot reach
        chosen = [root, *self._direct(root, 0), *self._seed_trees(root, seeds)]
        levels: list[dict[_Key, PartialTree]] = [{} for _ in range(size)]
        for shown in range(size):
            for at, part in enumerate(chosen):
                if self.tell:
                    self.tell(shown * len(chosen) + at, size * len(chosen))
                for child in self._children(part) if part.left else (part,):
                    if not child.left:
                        yield child
                    elif (level := levels[size - child.left.bit_count()]).get(child.key, child).rank >= child.rank:
                        level[child.key] = child
            if shown + 1 < size:
                chosen = _best(levels[shown + 1], width)

    def _seed_trees(self, part: PartialTree, most: int) -> Iterator[PartialTree]:
        """Yield at most `most` trees that extend a tree by one intermediate arbor, which is driven from its last arbor
        with a large speed change towards the requested periods. Trees whose new ratio has the smallest numerator and
        denominator come first.
        """
        # periods are mostly longer, or mostly shorter, than a turn of the first arbor
        side = math.copysign(1.0, sum(low for low, _ in self.targets.logs))
        # ratios of at least the cube root of the largest ratio
        nearer = self._plainest[side * self.table.logs[self._plainest] >= self.table.logs[-1] / 3]
        for at in nearer[:most].tolist():
            yield self._part((*part.tree, grown(part.tree, -1, len(part.tree) - 1, *self.table.terms(at))), part.left)

    def _part(self, tree: ArborTree, left: int) -> PartialTree:
        wheels, _, _ = fewest_wheels(self.table, edges(tree))
        bulk = sum(math.log(arbor.driven * arbor.driver) for arbor in tree)
        return PartialTree(tree, left, wheels, bulk)

    def _children(self, part: PartialTree) -> Iterator[PartialTree]:
        """Yield the best extensions of a partial tree. Each extension adds an intermediate arbor and the arbors of all
        requested periods that it drives, and then drives further requested periods from the new arbors, if one pair is
        sufficient.
        """
        reaches = [reach(self.table, self.targets, arbor.log, part.left) for arbor in part.tree]
        rows = np.concatenate([self._moves(part, at, known) for at, known in enumerate(reaches)])
        # separately for each gain: moves with more targets need more wheels, and would always be ranked lower
        for gain in np.unique(rows[:, 0]):
            mine = rows[rows[:, 0] == gain]
            for row in mine[np.lexsort((mine[:, 2], mine[:, 1]))[:_TRIED]]:
                parent = int(row[3])
                child = self._built(part, parent, reaches[parent], int(row[4]))
                if child is not None:
                    yield child
                    yield from self._direct(child, len(part.tree))

    def _direct(self, part: PartialTree, fresh: int) -> Iterator[PartialTree]:
        """Yield the trees in which arbors with index `fresh` and above drive one or more further targets directly."""
        for parent in range(fresh, len(part.tree)):
            arbor = part.tree[parent]
            begin, end = self.table.logs.searchsorted(self._windows - arbor.log)
            for target in np.flatnonzero(end > begin).tolist():
                if not part.left >> target & 1:
                    continue
                for at in range(begin[target], end[target]):
                    new = grown(part.tree, target, parent, *self.table.terms(at))
                    if self.targets.meets(target, new.period):
                        child = self._part((*part.tree, new), part.left & ~(1 << target))
                        yield child
                        yield from self._direct(child, parent)

    def _moves(self, part: PartialTree, parent: int, known: ReachablePeriods) -> Floats:
        """Return a table of the possible extensions of a tree by an intermediate arbor that arbor `parent` drives,
        shape (extensions, 5).

        Its columns are: number of requested periods that the new arbor drives, number of added wheels, sum of the
        logarithms of numerators and denominators of the added ratios, index `parent`, and index of the intermediate
        arbor in the arrays of `known`.
        """
        gained, first = (known.next >= 0).sum(axis=1), known.first
        # two wheels per pair, minus those that can be shared
        wheels = 2 + 2 * gained - self._sharing(part.tree, parent, first)
        bulk = self._bulk[first].copy()
        for further in known.next.T:
            good = further >= 0
            mine, own = first[good], further[good]
            wheels[good] -= self._joint(
                self.table.driven[mine], self.table.driver[mine], self.table.driver[own], self.table.driven[own]
            )
            bulk[good] += self._bulk[own]
        rows = np.arange(len(first))
        return np.column_stack([gained, wheels, bulk, np.full(len(rows), parent), rows])

    def _sharing(self, tree: ArborTree, parent: int, ways: Ints) -> Ints:
        """Return, for each ratio with an index in `ways`, 1 if its pair can use a wheel that is already on the driving
        arbor, and 0 if it cannot.
        """
        able = np.zeros(len(ways), dtype=bool)
        for at, arbor in enumerate(tree):
            if at and parent in (at, arbor.parent):
                mine, other = (arbor.driven, arbor.driver) if at == parent else (arbor.driver, arbor.driven)
                own = self.table.driver[ways], self.table.driven[ways]
                able |= self._joint(*own, np.full(len(ways), mine), np.full(len(ways), other)).astype(bool)
        return able.astype(np.int64)

    def _joint(self, mine: Ints, mate: Ints, other: Ints, its_mate: Ints) -> Ints:
        """Return 1 if two gear pairs can share a wheel, and 0 if they cannot. The wheel can be shared if the terms
        `mine` and `other` of the two ratios have a common multiple for which all four tooth counts are admissible;
        `mate` and `its_mate` are the other terms of the two ratios.
        """
        common = np.lcm(mine, other)
        largest = np.maximum(common, np.maximum(common // mine * mate, common // other * its_mate))
        smallest = np.minimum(common, np.minimum(common // mine * mate, common // other * its_mate))
        minimum, most = self.table.counts[0], self.table.counts[-1]
        # the largest admissible multiple must keep the smallest count above the minimum
        good: Ints = (most // largest * smallest >= minimum).astype(np.int64)
        return good

    def _built(self, part: PartialTree, parent: int, known: ReachablePeriods, at: int) -> PartialTree | None:
        """Return the tree extended by intermediate arbor `at` of `known`, driven from arbor `parent`, and by the arbors
        that it drives. Return None if no requested period is within its tolerance in exact arithmetic.
        """
        tree = (*part.tree, grown(part.tree, -1, parent, *self.table.terms(int(known.first[at]))))
        extra, left = len(tree) - 1, part.left
        for target, further in enumerate(known.next[at]):
            if further < 0:
                continue
            new = grown(tree, target, extra, *self.table.terms(int(further)))
            if self.targets.meets(target, new.period):
                tree, left = (*tree, new), left & ~(1 << target)
        return self._part(tree, left) if left != part.left else None


def _best(level: dict[_Key, PartialTree], width: int) -> list[PartialTree]:
    """Return the `width` best partial trees of a mapping in which all trees drive the same number of requested periods.

    Only a few trees whose arbors have the same requested periods and exact periods are selected before other trees.
    """
    kept: list[PartialTree] = []
    spare: list[PartialTree] = []
    alike: Counter[_Key] = Counter()
    for part in sorted(level.values(), key=lambda part: part.rank):
        shown = frozenset((arbor.target, arbor.n, arbor.d) for arbor in part.tree if arbor.target >= 0)
        alike[shown] += 1
        (kept if alike[shown] <= _ALIKE else spare).append(part)
    return (kept[:width] + spare)[:width]
