"""What is demanded of one output, as signs of polynomials.

|N/D - w| <= t w is one of a few cases, such as D > 0, N - (1-t) w D >= 0, N - (1+t) w D <= 0. Each is a set of halves
(sense * polynomial >= 0). Where one item is still open each case leaves one window of its values; entries that floats
cannot place are settled by exact signs.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from geartrain.synthesis.trains.items import Ints
from geartrain.synthesis.trains.reaching import Corners, Reach, find_reach
from geartrain.synthesis.trains.rows import Rows
from geartrain.synthesis.trains.signs import Polynomial, Signs
from geartrain.synthesis.trains.windows import Bools, Half, Window, find_window, spread


@dataclass(frozen=True)
class Band:
    """A demand: at least one case holds, that is, all of its halves. No two cases hold at once.

    name   what is demanded, in words
    """

    name: str
    cases: tuple[tuple[Half, ...], ...]

    @cached_property
    def items(self) -> tuple[int, ...]:
        """The items it depends on, ascending."""
        return tuple(sorted({item for half in self._halves for item in half.polynomial.items}))

    @property
    def _halves(self) -> Iterable[Half]:
        return (half for case in self.cases for half in case)

    def opens(self, item: int) -> bool:
        """True if `windows` can be found in an item: each polynomial has at most two powers of it."""
        return all(len(half.polynomial.powers(item)) <= 2 for half in self._halves)

    def holds(self, rows: Rows) -> Bools:
        """Where it is met, exactly; all its items must be set."""
        known: dict[Polynomial, Signs] = {}
        found: Bools = np.zeros(rows.size, dtype=np.bool_)
        for case in self.cases:
            found |= _case_holds(case, rows, known)
        return found

    def reaches(self, corners: Corners) -> list[list[Reach]]:
        """Its halves, case by case, with some items open; for `possible`."""
        return [[find_reach(half, corners) for half in case] for case in self.cases]

    def windows(self, rows: Rows, item: int) -> list[Window]:
        """For each case its window of the values of the one open item."""
        return [find_window(case, rows, item) for case in self.cases]

    def fringe(self, at: int, rows: Rows, item: int, window: Window) -> tuple[Ints, Ints]:
        """Row and value of all that a window of case `at` leaves in doubt and that do meet it."""
        none = window.sure_end <= window.sure_start
        starts = np.concatenate([window.start, np.where(none, window.end, window.sure_end)])
        ends = np.concatenate([np.where(none, window.end, window.sure_start), window.end])
        some = np.flatnonzero(ends > starts)
        owner, indices = spread(starts[some], ends[some])
        parents = some[owner] % rows.size if rows.size else owner
        met = _case_holds(self.cases[at], rows.plus(parents, item, indices), {})
        return parents[met], indices[met]


def _case_holds(case: Sequence[Half], rows: Rows, known: dict[Polynomial, Signs]) -> Bools:
    met: Bools = np.ones(rows.size, dtype=np.bool_)
    for half in case:
        if half.polynomial not in known:
            known[half.polynomial] = half.polynomial.signs(rows)
        met &= half.met(known[half.polynomial])
    return met


def possible(reaches: Sequence[Sequence[Reach]], rows: Rows) -> Bools:
    """False where no values of the open items meet a band; `reaches` are its."""
    found: Bools = np.zeros(rows.size, dtype=np.bool_)
    for case in reaches:
        met: Bools = np.ones(rows.size, dtype=np.bool_)
        for reach in case:
            met &= reach.possible(rows)
        found |= met
    return found
