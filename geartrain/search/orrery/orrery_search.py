"""Several periods from one arbor with as few wheels as possible: arbors and wheels are shared, as in orreries."""

from __future__ import annotations

import math
import time
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
    TreeArbor,
    TreeEnumeration,
    edges,
    fewest_wheels,
    grown,
    pair_ratios,
    reach,
    read_period_targets,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Ints


_KEPT_ENTRIES = 3 * 10**7  # of remembered reaches: 240 MB of int64
_TRIED = 20  # moves of each gain that are worked out exactly
_ALIKE = 3  # trees that show the same, before others have their turn
_Key = frozenset[tuple[int, int, int]]
_WALKABLE = 2 * 10**5  # steps of a walk that is made unasked
_SEEDS_A_PART = 4  # first extra arbors for each tree that a beam keeps

Tell = Callable[[int, int], None]


@dataclass(frozen=True, slots=True)
class OrreryArbor(Result):
    """One arbor of an orrery."""

    KEYS = ("name", "period", Key("value", "period", as_float), "sense", "wheels", "shows")

    name: str
    """The period it shows, or `arbor 1`, `arbor 2`...; the caller names the first."""
    period: Fraction
    """Turns of the first arbor in one of its own, exact and positive."""
    sense: int
    """1 with the first arbor, -1 against it: every pair is external and reverses."""
    wheels: tuple[int, ...]
    """Tooth counts of its wheels, ascending, all different."""
    shows: bool
    """True if it shows a period that was asked for."""


@dataclass(frozen=True, slots=True)
class OrreryPair(Result):
    """One gear pair: teeth of the driver on arbor `parent`, and of the driven wheel on arbor `child`."""

    driver: int
    """Teeth of the driving wheel."""
    driven: int
    """Teeth of the driven wheel."""
    parent: str
    """Arbor of the driving wheel."""
    child: str
    """Arbor of the driven wheel."""


@dataclass(frozen=True, slots=True)
class Orrery(Tabular, Result):
    """A tree of gear pairs that shows every period asked for.

    See Also
    --------
    find_orrery : finds it.
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
    """Name -> period asked for [turns of the first arbor]."""
    tolerances: Mapping[str, Fraction]
    """Name -> greatest relative error asked for."""
    arbors: tuple[OrreryArbor, ...]
    """The first arbor first, every other after the one that drives it."""
    pairs: tuple[OrreryPair, ...]
    """In the order of the driven arbors."""
    errors: Mapping[str, Fraction]
    """Name -> speed over wanted speed, less 1, exact; positive is fast."""
    minimum_pairs: int
    """No tree of fewer pairs shows all the periods: proved by walking all of them."""
    minimum_wheels: int
    """Fewer wheels than this are impossible: proved."""
    ended: str
    """Why the search ended."""

    def _summary(self) -> str:
        worst = max((abs(error) for error in self.errors.values()), default=0)
        return f"{len(self.pairs)} pairs for {', '.join(self.periods)}: error at most {float(worst):.3g}"

    @property
    def wheels(self) -> int:
        """Number of wheels; one that meshes with several counts once."""
        return sum(len(arbor.wheels) for arbor in self.arbors)

    @property
    def complete(self) -> bool:
        """True if it is proved that no orrery has fewer wheels."""
        return self.wheels <= self.minimum_wheels

    @property
    def worst(self) -> Fraction:
        """Greatest relative error in magnitude."""
        return max(map(abs, self.errors.values()))

    def to_train(self, name: str = "orrery", unit: str = "d") -> dict[str, Any]:
        """A declaration as plain data: the first arbor turns once a `unit`, every output expects its exact speed.

        A shared wheel is one wheel in several gear pairs. All arbors stand in one frame on axes of their own.

        Parameters
        ----------
        name : str
            Of the train.
        unit : str
            The time in which the first arbor turns once, such as "d".
        """
        places = {arbor.name: at for at, arbor in enumerate(self.arbors)}
        links: dict[str, Any] = {"frame": {}}
        for at, arbor in enumerate(self.arbors):
            links[arbor.name] = {"wheels": {_wheel(at, count): count for count in arbor.wheels}}
        gears = [
            {"pair": [_wheel(places[pair.parent], pair.driver), _wheel(places[pair.child], pair.driven)]}
            for pair in self.pairs
        ]
        outputs = {
            arbor.name: {
                "expect": str(Fraction(arbor.sense) / arbor.period),
                "targets": [
                    {
                        "period": f"{_plain(self.periods[arbor.name])} {unit}",
                        "tolerance": _plain(self.tolerances[arbor.name]),
                    }
                ],
            }
            for arbor in self.arbors
            if arbor.shows
        }
        return {
            "name": name,
            "frame": "frame",
            "unit": {"per": f"1 {unit}"},
            "links": links,
            "revolutes": [{"pair": ["frame", arbor.name], "axis": arbor.name} for arbor in self.arbors],
            "gears": gears,
            "inputs": {self.arbors[0].name: 1},
            "outputs": outputs,
        }


def _wheel(arbor: int, count: int) -> str:
    """Name of a wheel: `a3-120` has 120 teeth and sits on arbor 3."""
    return f"a{arbor}-{count}"


def _plain(value: Fraction) -> str:
    """Exact text: a decimal where it ends soon, else a fraction."""
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
    seconds: float | None = None,
    tell: Tell | None = None,
) -> Orrery:
    """The orrery with the fewest wheels that is found: branch and bound over small trees, beam search over larger ones.

    Pairs of wheels in a tree of arbors, driven from the first; every pair is external. Walked trees give proofs, wider
    beams only findings: see `Orrery.minimum_pairs`, `minimum_wheels` and `complete`. The same question has the same
    answer,
    unless time or the user ended the search.

    Parameters
    ----------
    periods : mapping of str to Fraction
        Name -> period [turns of the first arbor], positive; 30 of them at most.
    counts : sequence of int
        Admissible tooth counts, the same for all wheels.
    tolerance : Fraction, float, or mapping of str to these
        Greatest relative error of a speed, from 0 to below 1, for all or by name.
    first : str
        Name of the first arbor.
    effort : int
        Width of the widest beam; widths grow fourfold up to it, and time about as much.
    walk : int, optional
        Walk all trees with up to so many arbors that show nothing; default as far as that is short work, and always
        to 1. With 90,000 ratios of two wheels and 7 periods, 1 takes a moment and 2 a minute or two.
    seconds : float, optional
        Stop after this time [s] with what was found.
    tell : callable, optional
        Called with (done, total) of the part of the search that runs.

    Returns
    -------
    Orrery
        An interrupt from the keyboard keeps what was found.

    Raises
    ------
    QuestionError
        If nothing was found, with what was proved, and for unusable input.
    RangeError
        For ranges of teeth too wide to tabulate.

    Examples
    --------
    Jupiter in 12 years and Saturn in 30 need six wheels, and no fewer will do:

    >>> periods = {"jupiter": Fraction(12), "saturn": Fraction(30)}
    >>> found = find_orrery(periods, range(12, 61), tolerance=0, first="year")
    >>> found.wheels, found.complete, found.worst
    (6, True, Fraction(0, 1))
    """
    aims = read_period_targets(periods, tolerance)
    if first in aims.names or "frame" in (first, *aims.names):
        raise QuestionError(
            Problem("two arbors of one name", f"the first is {first!r}, what holds them is 'frame'", "rename one")
        )
    search = _Sharing(pair_ratios(counts), aims, seconds, tell)
    ended = search.run(effort, walk)
    if search.best is None:
        raise _nothing(search, ended)
    return _orrery(search, first, ended)


class _TimeUpError(Exception):
    """The time allowed is over."""


class _Sharing:
    """The state of one search: the best tree so far and what is proved."""

    def __init__(self, table: PairRatios, aims: PeriodTargets, seconds: float | None, tell: Tell | None) -> None:
        self.table, self.aims, self.tell = table, aims, tell
        self.end = None if seconds is None else time.monotonic() + seconds
        self.best: tuple[tuple[int, int, Fraction], ArborTree] | None = None
        self.sure = True
        self.walked = -1
        self.minimum_pairs = len(aims.periods)

    def run(self, effort: int, walk: int | None) -> str:
        """Search; returns why it ended."""
        try:
            for extra in self._walks(walk):
                self._walk(extra)
                if self.proved:
                    return "proved"
            # iterative widening: a beam costs about four times the one before, all narrower ones together a third of it
            width = 4
            while width // 4 < max(effort, 1):
                self._widen(min(width, max(effort, 1)))
                width *= 4
        except _TimeUpError:
            return "time"
        except KeyboardInterrupt:
            return "interrupted"
        return "proved" if self.proved else "effort"

    def _walks(self, walk: int | None) -> Iterator[int]:
        """Numbers of extra arbors worth walking: each multiplies the work by all pairs at all arbors."""
        extra, steps = 0, 1
        while extra <= (1 if walk is None else walk) or (walk is None and steps <= _WALKABLE):
            yield extra
            extra += 1
            steps *= len(self.table) * extra

    def _walk(self, extra: int) -> None:
        found = False
        for tree in TreeEnumeration(self.table, self.aims, extra, self._pulse).trees():
            found = True
            self._offer(tree)
        self.walked = extra
        if not found and self.minimum_pairs == len(self.aims.periods) + extra:
            self.minimum_pairs += 1

    def _widen(self, width: int) -> None:
        for part in BeamSearch(self.table, self.aims, self._pulse).run(width, _SEEDS_A_PART * width):
            self._offer(part.tree)

    def _pulse(self, done: int, total: int) -> None:
        if self.end is not None and time.monotonic() > self.end:
            raise _TimeUpError
        if self.tell:
            self.tell(done, total)

    def _offer(self, tree: ArborTree) -> None:
        """Keep a tree that is better: fewer wheels, then fewer pairs, then the smaller worst error."""
        wheels, _, proved = fewest_wheels(self.table, edges(tree))
        self.sure = self.sure and proved
        cost = wheels, len(tree)
        if self.best is not None and cost > self.best[0][:2]:
            return
        worst = max(abs(self.aims.error(arbor.aim, arbor.period)) for arbor in tree if arbor.aim >= 0)
        if self.best is None or (*cost, worst) < self.best[0]:
            self.best = ((*cost, worst), tree)

    @property
    def minimum_wheels(self) -> int:
        """Proved lower bound.

        Every arbor has a wheel, and in a tree with the fewest wheels every arbor that shows nothing has two: with one
        it is an idler, and its neighbours can mesh directly. Trees not walked have more extra arbors than those that
        were.
        """
        unseen = len(self.aims.periods) + 1 + 2 * (self.walked + 1)
        return unseen if self.best is None or not self.sure else min(unseen, self.best[0][0])

    @property
    def proved(self) -> bool:
        """True if no orrery has fewer wheels than the best."""
        return self.best is not None and self.best[0][0] <= self.minimum_wheels


def _orrery(search: _Sharing, first: str, ended: str) -> Orrery:
    """The best tree with names, senses and wheels."""
    assert search.best is not None
    tree, aims = search.best[1], search.aims
    _, meshes, _ = fewest_wheels(search.table, edges(tree))
    names = _names(tree, aims, first)
    pairs = tuple(
        OrreryPair(*mesh, names[arbor.parent], name)
        for arbor, name, mesh in zip(tree[1:], names[1:], meshes, strict=True)
    )
    return Orrery(
        dict(zip(aims.names, aims.periods, strict=True)),
        dict(zip(aims.names, aims.tolerances, strict=True)),
        _arbors(tree, names, pairs),
        pairs,
        {
            aims.names[arbor.aim]: aims.error(arbor.aim, arbor.period)
            for arbor in sorted(tree, key=lambda arbor: arbor.aim)
            if arbor.aim >= 0
        },
        search.minimum_pairs,
        search.minimum_wheels,
        ended,
    )


def _names(tree: ArborTree, aims: PeriodTargets, first: str) -> list[str]:
    """What the arbors show, or a number."""
    free = (name for name in map("arbor {}".format, count(1)) if name not in (first, *aims.names))
    return [first, *(aims.names[arbor.aim] if arbor.aim >= 0 else next(free) for arbor in tree[1:])]


def _arbors(tree: ArborTree, names: Sequence[str], pairs: Sequence[OrreryPair]) -> tuple[OrreryArbor, ...]:
    """The arbors with their senses and wheels."""
    wheels: dict[str, set[int]] = {name: set() for name in names}
    senses = {names[0]: 1}
    for pair in pairs:
        wheels[pair.parent].add(pair.driver)
        wheels[pair.child].add(pair.driven)
        senses[pair.child] = -senses[pair.parent]
    return tuple(
        OrreryArbor(name, arbor.period, senses[name], tuple(sorted(wheels[name])), arbor.aim >= 0)
        for name, arbor in zip(names, tree, strict=True)
    )


def _nothing(search: _Sharing, ended: str) -> QuestionError:
    """Why there is no orrery, as far as it is known."""
    table, size = search.table, len(search.aims.periods)
    minimum, most = table.counts[0], table.counts[-1]
    walked = f"all trees with up to {size + search.walked} pairs were walked; " if search.walked >= 0 else ""
    stopped = {"time": "the time allowed was over; ", "interrupted": "the search was interrupted; "}.get(ended, "")
    return QuestionError(
        Problem(
            f"no orrery found for {size} periods with wheels of {minimum} to {most} teeth",
            f"{walked}{stopped}a pair changes the speed at most {most / minimum:.3g} times and has {len(table)} ratios",
            "loosen the tolerance, allow more tooth counts, or raise effort",
        )
    )


# ------------------------------------- beam search: trees with few wheels from the best part-built ones, without proof


@dataclass(frozen=True, slots=True)
class PartialTree:
    """A part-built tree: what is left to show, and what the tree costs."""

    tree: ArborTree
    left: int
    wheels: int
    """The fewest its pairs need."""
    bulk: float
    """Sum of the logarithms of its ratios' terms: small terms have many multiples, thus more chances to share."""

    @property
    def rank(self) -> tuple[int, float]:
        """Few wheels first, then many chances."""
        return self.wheels, self.bulk

    @property
    def key(self) -> _Key:
        """What decides how it can grow: equal for trees whose arbors show the same in the same periods."""
        return frozenset((arbor.aim, arbor.n, arbor.d) for arbor in self.tree)


class BeamSearch:
    """Grows trees one aim further at a time and keeps the `width` best of those that show equally many aims.

    A move drives an aim directly, or adds an extra arbor together with all aims in its reach. A wheel that a new
    pair can share with pairs on the same arbor is counted while choosing, by least common multiples in numpy for
    all moves and exactly for those chosen. Everything is decided by order, nothing by chance.
    """

    def __init__(self, table: PairRatios, aims: PeriodTargets, tell: Callable[[int, int], None] | None = None) -> None:
        self.table, self.aims, self.tell = table, aims, tell
        self._reaches: dict[tuple[int, int], ReachablePeriods] = {}
        self._entries = 0
        plain = np.log(table.driven.astype(float)) + np.log(table.driver.astype(float))
        self._bulk = plain
        self._windows = np.array(aims.logs).T
        # stable: of ratios as plain as each other the least first, on every machine
        self._plainest = np.argsort(plain, kind="stable")

    def run(self, width: int, seeds: int) -> Iterator[PartialTree]:
        """Complete trees as they are found; `seeds` extra arbors driven by the first start trees of their own."""
        size = len(self.aims.periods)
        root = PartialTree((FIRST,), self.aims.everything, 0, 0.0)
        # first arbors that show nothing themselves lead to aims that two pairs from the first arbor cannot
        chosen = [root, *self._direct(root, 0), *self._blanks(root, seeds)]
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

    def _blanks(self, part: PartialTree, most: int) -> Iterator[PartialTree]:
        """Extra arbors much nearer the periods than the last arbor, with the plainest ratios."""
        side = math.copysign(1.0, sum(low for low, _ in self.aims.logs))
        nearer = self._plainest[side * self.table.logs[self._plainest] >= self.table.logs[-1] / 3]
        for at in nearer[:most].tolist():
            yield self._part((*part.tree, grown(part.tree, -1, len(part.tree) - 1, *self.table.terms(at))), part.left)

    def _part(self, tree: ArborTree, left: int) -> PartialTree:
        wheels, _, _ = fewest_wheels(self.table, edges(tree))
        bulk = sum(math.log(arbor.driven * arbor.driver) for arbor in tree)
        return PartialTree(tree, left, wheels, bulk)

    def _reach(self, arbor: TreeArbor, left: int) -> ReachablePeriods:
        """Moves from an arbor to aims left, kept for the trees that have the same arbor."""
        known = self._reaches.pop((arbor.n, arbor.d), None)
        if known is not None and left & ~known.requested:
            self._entries -= known.next.size
            known = None
        if known is None:
            known = reach(self.table, self.aims, arbor.log, left)
            self._entries += known.next.size
            while self._reaches and self._entries > _KEPT_ENTRIES:
                self._entries -= self._reaches.pop(next(iter(self._reaches))).next.size
        self._reaches[arbor.n, arbor.d] = known  # the one used last goes last
        return known

    def _children(self, part: PartialTree) -> Iterator[PartialTree]:
        """The most promising trees that one more extra arbor makes of a part-built one, and what they lead to."""
        reaches = [self._reach(arbor, part.left) for arbor in part.tree]
        rows = np.concatenate([self._moves(part, at, known) for at, known in enumerate(reaches)])
        # the best of each gain: one that shows more aims at once needs more wheels, and would lose to the others
        for gain in np.unique(rows[:, 0]):
            mine = rows[rows[:, 0] == gain]
            for row in mine[np.lexsort((mine[:, 2], mine[:, 1]))[:_TRIED]]:
                parent = int(row[3])
                child = self._built(part, parent, reaches[parent], int(row[4]))
                if child is not None:
                    yield child
                    yield from self._direct(child, len(part.tree))

    def _direct(self, part: PartialTree, fresh: int) -> Iterator[PartialTree]:
        """Trees with aims driven directly by arbors from place `fresh` on, in all numbers."""
        for parent in range(fresh, len(part.tree)):
            arbor = part.tree[parent]
            begin, end = self.table.logs.searchsorted(self._windows - arbor.log)
            for aim in np.flatnonzero(end > begin).tolist():
                if not part.left >> aim & 1:
                    continue
                for at in range(begin[aim], end[aim]):
                    new = grown(part.tree, aim, parent, *self.table.terms(at))
                    if self.aims.meets(aim, new.period):
                        child = self._part((*part.tree, new), part.left & ~(1 << aim))
                        yield child
                        yield from self._direct(child, parent)

    def _moves(
        self, part: PartialTree, parent: int, known: ReachablePeriods
    ) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
        """(moves, 5): aims gained, wheels needed, bulk, parent, row of the parent's reach."""
        sets = known.sets & part.left
        rows = np.flatnonzero(sets)
        gained = np.bitwise_count(sets[rows]).astype(np.int64)
        first = known.first[rows]
        wheels = 2 + 2 * gained - self._sharing(part.tree, parent, first)
        bulk = self._bulk[first].copy()
        for aim in range(len(self.aims.periods)):
            if not part.left >> aim & 1:
                continue
            further = known.next[rows, aim]
            good = further >= 0
            mine, own = first[good], further[good]
            wheels[good] -= self._joint(
                self.table.driven[mine], self.table.driver[mine], self.table.driver[own], self.table.driven[own]
            )
            bulk[good] += self._bulk[own]
        return np.column_stack([gained, wheels, bulk, np.full(len(rows), parent), rows]).astype(np.float64)

    def _sharing(self, tree: ArborTree, parent: int, ways: Ints) -> Ints:
        """1 where the pair to a new arbor can use a wheel that its driving arbor has."""
        able = np.zeros(len(ways), dtype=bool)
        for at, arbor in enumerate(tree):
            if at and parent in (at, arbor.parent):
                mine, other = (arbor.driven, arbor.driver) if at == parent else (arbor.driver, arbor.driven)
                own = self.table.driver[ways], self.table.driven[ways]
                able |= self._joint(*own, np.full(len(ways), mine), np.full(len(ways), other)).astype(bool)
        return able.astype(np.int64)

    def _joint(self, mine: Ints, mate: Ints, other: Ints, its_mate: Ints) -> Ints:
        """1 where two ratios have multiples with equal counts, `mine` and `other`, within the range of teeth."""
        common = np.lcm(mine, other)
        largest = np.maximum(common, np.maximum(common // mine * mate, common // other * its_mate))
        smallest = np.minimum(common, np.minimum(common // mine * mate, common // other * its_mate))
        minimum, most = self.table.counts[0], self.table.counts[-1]
        good: Ints = (most // largest * smallest >= minimum).astype(np.int64)
        return good

    def _built(self, part: PartialTree, parent: int, known: ReachablePeriods, at: int) -> PartialTree | None:
        """The tree after a move, or None where exact arithmetic refuses what floats let through."""
        tree = (*part.tree, grown(part.tree, -1, parent, *self.table.terms(int(known.first[at]))))
        extra, left = len(tree) - 1, part.left
        for aim, further in enumerate(known.next[at]):
            if further < 0 or not left >> aim & 1:
                continue
            new = grown(tree, aim, extra, *self.table.terms(int(further)))
            if self.aims.meets(aim, new.period):
                tree, left = (*tree, new), left & ~(1 << aim)
        return self._part(tree, left) if left != part.left else None


def _best(level: dict[_Key, PartialTree], width: int) -> list[PartialTree]:
    """The best part-built trees, more than a few of those alike in all that they show only where there is room."""
    kept: list[PartialTree] = []
    spare: list[PartialTree] = []
    alike: Counter[_Key] = Counter()
    for part in sorted(level.values(), key=lambda part: part.rank):
        shown = frozenset((arbor.aim, arbor.n, arbor.d) for arbor in part.tree if arbor.aim >= 0)
        alike[shown] += 1
        (kept if alike[shown] <= _ALIKE else spare).append(part)
    kept = (kept[:width] + spare)[:width]
    # trees that share arbors next to each other: what these arbors reach is then still at hand
    return sorted(kept, key=lambda part: [(arbor.n, arbor.d) for arbor in part.tree])
