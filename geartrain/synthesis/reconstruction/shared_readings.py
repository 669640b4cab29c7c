"""Which readings the arbors of many trains may have, by the large primes that are shared out among added wheels."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.prime_shares import NO_STATE, Ints, PrimeShares
from geartrain.synthesis.reconstruction.train_rows import (
    ArborColumns,
    CountTable,
    TrainRows,
    Words,
    alike_rows,
    repeated,
)

Readable = dict[tuple[int, int], dict[tuple[int, ...], bool]]
"""By arbor and role, then by state and powers: whether a reading is left."""
_ALIKE = 2000
"""Trains from which on a reading is tried once for all that are alike."""


class SharedReadings:
    """Readings of a question's arbors.

    Parameters
    ----------
    closing : mapping of int to list of int
        By arbor, the shared primes that no later arbor has.
    later : sequence of int
        Arbors that are read when all have roles.
    """

    def __init__(
        self,
        columns: Sequence[ArborColumns],
        table: CountTable,
        closing: Mapping[int, Sequence[int]],
        later: Sequence[int],
    ) -> None:
        self._columns, self._table, self.closing, self.later = columns, table, closing, later

    def of(
        self, at: int, number: Words, shares: Words, closing: Words, states_of: PrimeShares
    ) -> tuple[Ints, Ints, Ints]:
        """For trains with roles of an arbor: numbers of trains, readings that they may have, and states after.

        closing   powers of the primes that no later arbor has
        """
        columns = self._columns[at]
        if len(number) < _ALIKE:
            which, read = repeated(np.diff(columns.first)[number], np.zeros(len(number), dtype=np.int64))
            row = columns.first[number[which]] + read
            states = self._states(at, row, shares[which], closing[which], states_of, self.closing[at])
            good = np.flatnonzero(states != NO_STATE)
            return which[good], read[good], states[good]
        kinds, kind = alike_rows([number, shares, *closing.T])
        one = np.array(kinds)
        often, begin, reads, states = self._allowed(at, number[one], shares[one], closing[one], states_of)
        which, place = repeated(often[kind], begin[kind])
        return which, reads[place], states[place]

    def _allowed(
        self, at: int, number: Words, shares: Words, closing: Words, states_of: PrimeShares
    ) -> tuple[Ints, Ints, Ints, Ints]:
        """The readings of some roles that leave primes to be shared out.

        How many there are, and where those of each begin; the readings, and the states after them.
        """
        often, begin = np.zeros(len(number), dtype=np.int64), np.zeros(len(number), dtype=np.int64)
        reads, states, before = [], [], 0
        for role in np.unique(number).tolist():
            own = np.flatnonzero(number == role)
            row, alike = self._told_apart(at, role, tuple(self.closing[at]))
            same: Words = np.repeat(closing[own], len(row), axis=0)
            after = self._states(
                at, np.tile(row, len(own)), np.repeat(shares[own], len(row)), same, states_of, self.closing[at]
            )
            after = after.reshape(len(own), len(row))[:, alike]
            which, read = np.nonzero(after != NO_STATE)
            often[own] = np.bincount(which, minlength=len(own))
            begin[own] = before + np.cumsum(often[own]) - often[own]
            before += len(read)
            reads.append(read)
            states.append(after[which, read])
        return often, begin, np.concatenate(reads), np.concatenate(states)

    def _states(
        self, at: int, row: Ints, shares: Words, closing: Words, states_of: PrimeShares, closed: Sequence[int]
    ) -> Ints:
        """By reading, the state after it."""
        columns = self._columns[at]
        states: Ints = np.where(columns.lost[row], NO_STATE, shares).astype(np.int64)
        for powers in columns.own[row].T:
            states = states_of.after(states, powers)
        for place, column in enumerate(closed):
            states = self.after(states, closing[:, place] + columns.powers[row, column], column, states_of)
        return states

    def readable(
        self, rows: TrainRows, at: int, states_of: PrimeShares, known_of: Readable
    ) -> Callable[[int], NDArray[np.bool_]]:
        """By role whether an arbor has a reading left, by the primes that no other arbor has that is not read."""
        others = frozenset[int]().union(*(self._table.owners[each] for each in self.later if each != at))
        closed = [column for column in self.closing[at] if self._table.shared[column] not in others]
        closing = rows.powers[:, closed]
        kinds, kind = alike_rows([rows.shares, *closing.T])
        keys = [(int(rows.shares[one]), *closing[one].tolist()) for one in kinds]

        def by_role(role: int) -> NDArray[np.bool_]:
            known = known_of[at, role]
            new = [place for place, key in enumerate(keys) if key not in known]
            if new:
                row, own = self._told_apart(at, role, tuple(closed))[0], np.array(kinds)[new]
                shares, same = np.repeat(rows.shares[own], len(row)), np.repeat(closing[own], len(row), axis=0)
                states = self._states(at, np.tile(row, len(new)), shares, same, states_of, closed)
                some = (states != NO_STATE).reshape(len(new), len(row)).any(axis=1)
                known.update(zip((keys[place] for place in new), some.tolist(), strict=True))
            return np.array([known[key] for key in keys], dtype=bool)[kind]

        return by_role

    @cache  # noqa: B019 -- lives as long as the search
    def _told_apart(self, at: int, role: int, closed: tuple[int, ...]) -> tuple[Ints, Ints]:
        """Readings of a role that stand for all with the same large primes, and by reading for which it is."""
        columns, own = self._columns[at], self._columns[at].readings(role)
        lone = np.sort(columns.own[own], axis=1)
        told = np.concatenate([columns.lost[own][:, None], lone, columns.powers[own][:, list(closed)]], axis=1)
        _, first, which = np.unique(told, axis=0, return_index=True, return_inverse=True)
        return first + own.start, which.ravel()

    def after(self, states: Ints, powers: Words, column: int, states_of: PrimeShares) -> Ints:
        """Each state once the last arbor that has a shared prime is read."""
        if self._table.shared[column] > self._table.greatest:
            return np.where(powers == 0, states, NO_STATE)
        return states_of.after(states, powers)
