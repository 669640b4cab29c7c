"""Several periods from one arbor with as few wheels as possible: arbors and wheels are shared, as in orreries."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import count

from geartrain.errors import Problem, QuestionError
from geartrain.synthesis.orrery.arbor_trees import ArborTree, TreeEnumeration, edges, fewest_wheels
from geartrain.synthesis.orrery.beam_search import BeamSearch
from geartrain.synthesis.orrery.orrery_result import Orrery, OrreryArbor, OrreryPair
from geartrain.synthesis.orrery.pair_ratio_table import PairRatios, pair_ratios
from geartrain.synthesis.orrery.period_targets import PeriodTargets, read_period_targets

_WALKABLE = 2 * 10**5  # steps of a walk that is made unasked
_SEEDS_A_PART = 4  # first extra arbors for each tree that a beam keeps

Tell = Callable[[int, int], None]


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
    beams only findings: see `Orrery.least_pairs`, `least_wheels` and `complete`. The same question has the same answer,
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
        self.least_pairs = len(aims.periods)

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
        if not found and self.least_pairs == len(self.aims.periods) + extra:
            self.least_pairs += 1

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
    def least_wheels(self) -> int:
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
        return self.best is not None and self.best[0][0] <= self.least_wheels


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
        search.least_pairs,
        search.least_wheels,
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
    least, most = table.counts[0], table.counts[-1]
    walked = f"all trees with up to {size + search.walked} pairs were walked; " if search.walked >= 0 else ""
    stopped = {"time": "the time allowed was over; ", "interrupted": "the search was interrupted; "}.get(ended, "")
    return QuestionError(
        Problem(
            f"no orrery found for {size} periods with wheels of {least} to {most} teeth",
            f"{walked}{stopped}a pair changes the speed at most {most / least:.3g} times and has {len(table)} ratios",
            "loosen the tolerance, allow more tooth counts, or raise effort",
        )
    )
