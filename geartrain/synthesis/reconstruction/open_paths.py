"""Which paths to its dials a half-grown skeleton can still be completed by: what no dial's list knows is not tried."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from itertools import combinations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.path_lists import PathList, Rows
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Dials

Lists = Mapping[str, Rows]
"""By dial, the rows of its list that agree with what is above."""

_MOST_PAIRS = 1 << 22
"""Pairs of paths that are looked at to keep those that go together."""
_MOST_SHAPES = 1 << 17
"""Pairs of paths whose arbors are compared one by one."""


class Left(NamedTuple):
    """What is still to be used.

    arbors   surviving ones, a bit each
    wheels   added wheels
    new      added arbors, at most
    shown    by dial that is shown: its row in the list of its paths
    """

    arbors: int
    wheels: int
    new: int
    shown: tuple[tuple[str, int], ...] = ()


class Above(NamedTuple):
    """The part of the paths that the dials below share.

    arbors               surviving ones, a bit each
    beside               added wheels beside surviving ones
    compounds, idlers    added arbors
    first                whether nothing hangs from the input yet
    """

    arbors: int = 0
    beside: int = 0
    compounds: int = 0
    idlers: int = 0
    first: bool = False

    @property
    def wheels(self) -> int:
        """Added wheels."""
        return self.beside + 2 * self.compounds + self.idlers


def bit_of(at: int) -> int:
    """The bit of a surviving arbor; none for the input, which is on every path."""
    return 1 << (at - 1) if at else 0


class OpenPaths:
    """The lists of all dials of a question."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.keys = QuotientKeys(problem.additions.least, problem.additions.greatest)
        self.lists = {dial.name: PathList(dial, problem, self.keys) for dial in problem.dials}
        self._idlers = int(problem.idlers)
        self.must_cover = problem.use != "some"
        at = {arbor.name: number for number, arbor in enumerate(problem.arbors, 1)}
        self._places = {dial.name: bit_of(at.get(dial.place or "", 0)) for dial in problem.dials}

    def __getitem__(self, dial: str) -> PathList:
        return self.lists[dial]

    @cache  # noqa: B019 -- lives as long as the lists
    def whole(self, wheels: int) -> Lists:
        """The rows of all lists that have partners in the others with no more than so many added wheels on both.

        Looked at by their quotients alone, for all paths with one number of added wheels at once: see `_matches`.
        """
        found = {dial: np.flatnonzero(paths.wheels <= wheels) for dial, paths in self.lists.items()}
        for one, other in combinations(sorted(found), 2):
            first, second = self.lists[one], self.lists[other]
            if first.dial.is_exact and second.dial.is_exact:
                pair = self._agreeing_by_number(first, found[one], second, found[other], 2 * wheels + self._idlers)
                _keep(found, found, one, other, pair)
        return found

    def _agreeing_by_number(self, first: PathList, rows: Rows, second: PathList, others: Rows, most: int) -> _Partners:
        some, more = np.zeros(len(rows), dtype=bool), np.zeros(len(others), dtype=bool)
        for number, another in product(np.unique(first.wheels[rows]), np.unique(second.wheels[others])):
            at = np.flatnonzero(first.wheels[rows] == number)
            to = np.flatnonzero(second.wheels[others] == another)
            keys = first.wanted[rows[at]], second.wanted[others[to]]
            one, other = self.keys.agreeing(*keys, int(most - number - another))
            some[at[one]], more[to[other]] = True, True
        return some, more

    # one dial

    def viable(self, dials: Dials, lists: Lists, above: Above, left: Left) -> dict[str, Rows] | None:
        """The paths that still can be completed; None where a dial has none.

        An arbor that other dials have their place on is not for these; and each surviving wheel that a path passes by
        needs a dial of its own.
        """
        free = above.arbors | (left.arbors & ~self._taken(dials))
        found = {}
        for dial in dials:
            paths, rows = self.lists[dial], lists[dial]
            fits = (paths.arbors[rows] & ~free == 0) & (paths.wheels[rows] <= above.wheels + left.wheels)
            fits &= (paths.compounds[rows] >= above.compounds) & (paths.idlers[rows] >= above.idlers)
            fits &= np.bitwise_count(paths.idle[rows] & ~above.arbors) < len(dials)
            found[dial] = rows[fits]
            if not len(found[dial]):
                return None
        for one, other in combinations(dials, 2):
            pair = self._matches(one, found[one], other, found[other], above, left)
            if not _keep(found, found, one, other, pair):
                return None
        return found

    def _taken(self, dials: Dials) -> int:
        """Arbors on which other dials have their place, and none of these."""
        others = own = 0
        for dial, bit in self._places.items():
            if dial in dials:
                own |= bit
            else:
                others |= bit
        return others & ~own

    def least(self, lists: Lists, above: Above) -> int:
        """So many added wheels at least are needed below."""
        return max(0, *(int(self.lists[dial].wheels[rows].min()) for dial, rows in lists.items())) - above.wheels

    def reach(self, dial: str, rows: Rows) -> int:
        """All surviving arbors that some paths use, a bit each."""
        return int(np.bitwise_or.reduce(self.lists[dial].arbors[rows]))

    def later(self, blocks: Sequence[Lists], later: int | None) -> int | None:
        """The arbors that some blocks, and those after them, may use; None if there are none of them."""
        found = later
        for lists in blocks:
            for dial, rows in lists.items():
                found = (found or 0) | self.reach(dial, rows)
        return found

    def covers(self, lists: Lists, left: Left, later: int | None) -> bool:
        """Whether every surviving arbor that must be used may be."""
        return not self.must_cover or not left.arbors & ~(self.later([lists], later) or 0)

    # pairs of dials

    def parted(self, blocks: Sequence[dict[str, Rows]], above: Above, left: Left) -> bool:
        """Keep the paths of parted dials that go together; whether any are left."""
        for some, more in combinations(blocks, 2):
            for one, other in product(sorted(some), sorted(more)):
                pair = self._parted_matches(one, some[one], other, more[other], above, left)
                if not _keep(some, more, one, other, pair):
                    return False
        return True

    def _parted_matches(
        self, one: str, rows: Rows, other: str, others: Rows, above: Above, left: Left
    ) -> _Partners | None:
        """Which paths to two dials go together if they share no more than what is above."""
        if len(rows) * len(others) > _MOST_PAIRS:
            return None
        first, second = self.lists[one], self.lists[other]
        need = (first.wheels[rows] - above.wheels)[:, None] + (second.wheels[others] - above.wheels)
        fits = (need <= left.wheels) & (first.arbors[rows][:, None] & second.arbors[others] & ~above.arbors == 0)
        return _partners(self._agreeing(one, rows, other, others, need, fits))

    def _matches(self, one: str, rows: Rows, other: str, others: Rows, above: Above, left: Left) -> _Partners | None:
        """Which paths to two dials go together, wherever they part.

        If both have a and b of at most w added wheels, they share a + b - w of them at least, and at most 2 w - a - b
        are on one path alone. Where they part at an arbor that one of them passes by an idler, the other one turns with
        the count of that wheel.
        """
        if len(rows) * len(others) > _MOST_PAIRS:
            return None
        first, second = self.lists[one], self.lists[other]
        most = 2 * (above.wheels + left.wheels) + self._idlers
        own = most - first.wheels[rows][:, None] - second.wheels[others]
        fits = self._agreeing(one, rows, other, others, own, np.ones(own.shape, dtype=bool))
        at, to = np.nonzero(fits)
        if len(at) <= _MOST_SHAPES:
            codes, more = first.codes[rows[at]], second.codes[others[to]]
            both = (codes > 0) & (more > 0) & (codes != more)
            # only the arbor at which they part may be left by different wheels, never reached by different ones
            good = both.sum(axis=1) <= 1
            good &= ~(both & (first.driven_at(rows[at]) != second.driven_at(others[to]))).any(axis=1)
            fits[at, to] = good
        return _partners(fits)

    def _agreeing(
        self, one: str, rows: Rows, other: str, others: Rows, own: Rows, fits: NDArray[np.bool_]
    ) -> NDArray[np.bool_]:
        """Which pairs' quotients differ by one that as few wheels make as are not shared."""
        first, second = self.lists[one], self.lists[other]
        if not (first.dial.is_exact and second.dial.is_exact):
            return fits
        quotients = first.wanted[rows][:, None] - second.wanted[others]
        for number in range(3):
            asked = fits & (own == number)
            if asked.any():
                fits[asked] = self.keys.need_few(quotients[asked], number)
        return fits


_Partners = tuple[NDArray[np.bool_], NDArray[np.bool_]]
"""Which of some paths, and of some others, have a partner."""


def _partners(fits: NDArray[np.bool_]) -> _Partners:
    return np.asarray(fits.any(axis=1)), np.asarray(fits.any(axis=0))


def _keep(some: dict[str, Rows], more: dict[str, Rows], one: str, other: str, pair: _Partners | None) -> bool:
    """Keep rows that have a partner; whether there are any."""
    if pair is not None:
        some[one], more[other] = some[one][pair[0]], more[other][pair[1]]
    return bool(len(some[one]) and len(more[other]))
