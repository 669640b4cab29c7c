"""Trains whose dials are exact, arbor by arbor: added wheels first, then what each surviving arbor is to all dials.

For each way to share out added wheels the surviving arbors get roles, then readings. A train is dropped as soon as its
sets of dials are not those of a tree, or large primes cannot be shared out among its added wheels, or the quotient of
two ends is none that the few added wheels between them make. What is left is looked into exactly.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import QuestionError
from geartrain.synthesis.reconstruction.added_structures import AddedSets, AddedStructures, Core
from geartrain.synthesis.reconstruction.arbor_roles import crossing_bits, roles_of, set_bits
from geartrain.synthesis.reconstruction.asked_question import too_wide
from geartrain.synthesis.reconstruction.core_states import CoreStates
from geartrain.synthesis.reconstruction.prime_shares import NO_STATE, Ints, PrimeShares, packed_powers
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.shared_readings import Readable, SharedReadings
from geartrain.synthesis.reconstruction.train_rows import (
    INPUT,
    CountTable,
    States,
    TrainRows,
    arbor_columns,
    ratio_powers,
)

_MANY_DIALS = 6
"""Dials from which on sets and powers need 64 bits."""
_FEW_WAYS = 4
"""Readings of an arbor that are told apart at once where it has large primes; of others, when all arbors have roles."""
_PIECE = 1 << 18
"""Trains that are grown at once."""
_MOST_ROWS = 3_000_000_000
"""Trains that are looked at: an hour."""
_LOOKED_UP = 2
"""Added wheels between two ends up to which their quotient is looked up on the way; of one more, at the end."""


class _Asked(NamedTuple):
    """What is the same for all trains with some added wheels.

    few, more   pairs of ends, by number, with the numbers of added wheels between them that drive and are driven
    roles       by arbor, the numbers of roles that it may have
    readable    by arbor and role, whether it has a reading by the primes that are known
    """

    added: AddedSets
    cores: CoreStates
    shares: PrimeShares
    few: tuple[tuple[int, int, int], ...]
    more: tuple[tuple[int, int, int], ...]
    roles: tuple[tuple[int, ...], ...]
    readable: Readable


class WholeTrees:
    """All trains of a question, but for the order of their arbors and counts of added wheels."""

    def __init__(self, problem: ReconstructionProblem, keys: QuotientKeys) -> None:
        self.problem, self.keys = problem, keys
        self.dials = tuple(sorted(problem.dials, key=lambda dial: dial.name))
        self.arbors = tuple(roles_of(arbor, self.dials, problem) for arbor in (problem.input, *problem.arbors))
        self.wanted = tuple(abs(dial.least / problem.input_speed) for dial in self.dials)
        others = [part for each in self.wanted for part in (each.numerator, each.denominator)]
        limits = problem.additions
        self.table = CountTable(self.arbors, others, limits.least, limits.greatest, keys)
        self.columns = tuple(
            arbor_columns(arbor, at, len(self.dials), self.table) for at, arbor in enumerate(self.arbors)
        )
        self.structures = AddedStructures(problem, self.dials, self.arbors)
        self._ends = list(combinations(range(INPUT, len(self.dials)), 2))
        self._order()
        self._looked_at = 0

    def _order(self) -> None:
        """In which order arbors get roles and readings, and when each large prime is in no later reading."""
        ways = [arbor.ways for arbor in self.arbors]
        wide = {at for at, own in enumerate(ways) if own > (_FEW_WAYS if self.table.owners[at] else 1)}
        size = [len(arbor.roles) for arbor in self.arbors]
        # first what cores bind, then what large primes rule out most, last those that are read when all have roles
        bound = {at for at, arbor in enumerate(self.arbors) if not at or all(role.is_special for role in arbor.roles)}
        order = sorted(
            range(len(ways)),
            key=lambda at: (at not in bound, at in wide, size[at], -ways[at] if at in wide else ways[at]),
        )
        self._steps = [(at, at not in wide) for at in order]
        self._later = sorted(wide, key=lambda at: ways[at])
        read = [*(at for at in order if at not in wide), *self._later]
        closing: dict[int, list[int]] = defaultdict(list)
        for column, prime in enumerate(self.table.shared):
            owners = [at for at in read if prime in self.table.owners[at]]
            closing[owners[-1] if owners else INPUT].append(column)
        self._readings = SharedReadings(self.columns, self.table, closing, self._later)

    def found(self, added: AddedSets, cores: Sequence[Core]) -> Iterator[TrainRows]:
        """All trains with some added wheels for which counts are not ruled out."""
        asked = self._asked(added, cores)
        rows = self._closed(self._start(asked), INPUT, asked)
        for piece in self._grown(rows, 0, asked):
            yield self._looked_up(piece, asked.more)

    def _asked(self, added: AddedSets, cores: Sequence[Core]) -> _Asked:
        between = []
        for pair, (one, other) in enumerate(self._ends):
            drivers = driven = 0
            for wheel in added:
                behind = (wheel.dials >> other & 1) - (wheel.dials >> one & 1 if one != INPUT else 0)
                drivers += behind == (1 if wheel.drives else -1)
                driven += behind == (-1 if wheel.drives else 1)
            between.append((pair, drivers, driven))
        between.sort(key=lambda each: each[1] + each[2])
        few = tuple(each for each in between if each[1] + each[2] <= _LOOKED_UP)
        more = tuple(each for each in between if each[1] + each[2] == _LOOKED_UP + 1)
        shares = PrimeShares(added, len(self.dials))
        return _Asked(added, CoreStates(cores), shares, few, more, tuple(self._roles(added, cores)), defaultdict(dict))

    def _roles(self, added: AddedSets, cores: Sequence[Core]) -> Iterator[tuple[int, ...]]:
        """By arbor, the roles that go with some added wheels."""
        crossing = crossing_bits(tuple({wheel.dials for wheel in added}), (1 << len(self.dials)) - 1)
        special = [{role for role, _ in cores}, {role for _, roles in cores for role in roles}]
        for at, (arbor, columns) in enumerate(zip(self.arbors, self.columns, strict=True)):
            yield tuple(
                number
                for number, role in enumerate(arbor.roles)
                if not columns.sets[number] & crossing
                and (role in special[at > 0] if role.is_special or not at else True)
            )

    def _start(self, asked: _Asked) -> TrainRows:
        """One train in which no surviving arbor has a role."""
        sets = tuple({wheel.dials for wheel in asked.added})
        turned = 0
        for wheel in asked.added:
            turned ^= 0 if wheel.drives else wheel.dials
        by_dial = [ratio_powers(each, self.table.shared) for each in self.wanted]
        powers = [packed_powers(column) for column in zip(*by_dial, strict=True)]
        every = (1 << len(self.dials)) - 1
        family: type[np.signedinteger[Any]] = np.int32 if len(self.dials) < _MANY_DIALS else np.int64
        return TrainRows(
            np.array([set_bits(sets)], dtype=family),
            np.array([crossing_bits(sets, every)], dtype=family),
            np.array([turned], dtype=np.int8),
            np.array([CoreStates.start], dtype=np.int32),
            np.array([PrimeShares.start], dtype=np.int32),
            np.array([powers], dtype=family),
            np.zeros((1, 0), dtype=np.uint64),
            np.zeros(1, dtype=np.int32),
            np.zeros((1, len(self.arbors)), dtype=np.int16),
            np.zeros((1, len(self.arbors)), dtype=np.int32),
        )

    # growth: a step gives an arbor its role, or its reading, or both

    def _grown(self, rows: TrainRows, step: int, asked: _Asked) -> Iterator[TrainRows]:
        if not len(rows):
            return
        if len(rows) > _PIECE:
            for start in range(0, len(rows), _PIECE):
                yield from self._grown(rows.kept(slice(start, start + _PIECE)), step, asked)
            return
        self._looked_at += len(rows)
        if self._looked_at > _MOST_ROWS:
            raise QuestionError(too_wide(self.problem, f"more than {_MOST_ROWS} trains would have to be looked at"))
        if step < len(self._steps):
            yield from self._grown(self._with_roles(rows, step, asked), step + 1, asked)
            return
        if step == len(self._steps):
            rows = self._with_keys(rows)
        unread = self._later[step - len(self._steps) :]
        rows = self._looked_up(rows, asked.few, unread)
        if not unread:
            yield rows
        elif len(rows):
            yield from self._grown(self._with_readings(rows, unread[0], asked), step + 1, asked)

    def _with_roles(self, rows: TrainRows, step: int, asked: _Asked) -> TrainRows:
        """Trains in which one arbor more has a role; and a reading, if its readings are told apart at once."""
        at, at_once = self._steps[step]
        columns = self.columns[at]
        which, number, core = self._roles_for(rows, step, asked)
        if at_once and len(which):
            closing = rows.powers[which][:, self._readings.closing[at]]
            again, read, shares = self._readings.of(at, number, rows.shares[which], closing, asked.shares)
            which, number, core = which[again], number[again], core[again]
            found = rows.kept(which)
            found.reads[:, at] = read
            found.shares[:] = shares
            found.powers[:] += columns.powers[columns.first[number] + read]
        else:
            found = rows.kept(which)
        found.roles[:, at] = number
        found.core[:] = core
        found.sets[:] |= np.array(columns.sets)[number]
        found.crossing[:] |= np.array(columns.crossing)[number]
        found.turned[:] ^= np.array(columns.on)[number]
        return found

    def _roles_for(self, rows: TrainRows, step: int, asked: _Asked) -> tuple[Ints, Ints, States]:
        """Numbers of rows with the roles that an arbor may have in them, and states of cores after."""
        at, at_once = self._steps[step]
        last, columns = step + 1 == len(self._steps), self.columns[at]
        readable = (
            None
            if at_once or last or not self.table.owners[at]
            else self._readings.readable(rows, at, asked.shares, asked.readable)
        )
        parts = []
        for number in asked.roles[at]:
            role = self.arbors[at].roles[number]
            good = (rows.crossing & columns.sets[number] == 0) & (rows.sets & columns.crossing[number] == 0)
            if last:
                good &= self._senses(rows.turned ^ columns.on[number])
            if readable is not None:
                good &= readable(number)
            which = np.flatnonzero(good)
            core = asked.cores.after(rows.core[which], role, at == 0)
            done = asked.cores.are_whole(core) if last else core != NO_STATE
            parts.append((which[done], np.full(int(done.sum()), number), core[done].astype(np.int32)))
        if not parts:
            none = np.zeros(0, dtype=np.int64)
            return none, none, none.astype(np.int32)
        first, second, third = (np.concatenate(column) for column in zip(*parts, strict=True))
        return first, second, third

    def _senses(self, turned: NDArray[np.int8]) -> NDArray[np.bool_]:
        """Whether all dials turn the way they must."""
        signed = sum(1 << at for at, dial in enumerate(self.dials) if dial.signed)
        wanted = sum(
            1 << at for at, dial in enumerate(self.dials) if dial.signed and dial.least / self.problem.input_speed < 0
        )
        return np.asarray(turned & signed == wanted)

    # readings

    def _with_readings(self, rows: TrainRows, at: int, asked: _Asked) -> TrainRows:
        """Trains in which an arbor that has a role has each of the readings that leave primes to be shared out."""
        number, columns = rows.roles[:, at], self.columns[at]
        closing = rows.powers[:, self._readings.closing[at]]
        which, read, shares = self._readings.of(at, number, rows.shares, closing, asked.shares)
        found = rows.kept(which)
        row = columns.first[number[which]] + read
        found.reads[:, at] = read
        found.shares[:] = shares
        found.powers[:] += columns.powers[row]
        found.keys[:] += columns.keys[row]
        return found

    def _with_keys(self, rows: TrainRows) -> TrainRows:
        """Trains with the keys of what is left to be added, as far as arbors are read."""
        keys = np.array([[self.keys.key(each) for each in self.wanted]], dtype=np.uint64).repeat(len(rows), axis=0)
        for at, at_once in self._steps:
            if at_once:
                columns = self.columns[at]
                keys += columns.keys[columns.first[rows.roles[:, at]] + rows.reads[:, at]]
        return replace(rows, keys=keys)

    def _closed(self, rows: TrainRows, at: int, asked: _Asked) -> TrainRows:
        """Rows in which the primes that no arbor has can be shared out."""
        states: Ints = rows.shares.astype(np.int64)
        for column in self._readings.closing[at]:
            states = self._readings.after(states, rows.powers[:, column], column, asked.shares)
        return replace(rows, shares=states.astype(np.int32)).kept(np.flatnonzero(states != NO_STATE))

    # quotients of two ends

    def _looked_up(
        self, rows: TrainRows, pairs: Sequence[tuple[int, int, int]], unread: Sequence[int] = ()
    ) -> TrainRows:
        """Rows without those in which few added wheels cannot make the quotient of two ends."""
        for pair, drivers, driven in pairs:
            changed = np.zeros(len(rows), dtype=np.int64)
            for at in unread:
                changed |= self.columns[at].pairs[rows.roles[:, at]]
            ready = (changed | rows.checked) >> pair & 1 == 0
            if not ready.any():
                continue
            one, other = self._ends[pair]
            keys = rows.keys[ready, other] - (rows.keys[ready, one] if one != INPUT else np.uint64(0))
            good = ~ready
            good[ready] = self.keys.may_be_quotients(keys, drivers, driven)
            checked = np.where(ready, rows.checked | 1 << pair, rows.checked)
            rows = replace(rows, checked=checked).kept(np.flatnonzero(good))
        return rows

    # exactly

    def wanted_quotients(self, rows: TrainRows, row: int) -> tuple[Fraction, ...]:
        """By dial, what the added wheels must make."""
        top, bottom = [1] * len(self.dials), [1] * len(self.dials)
        for at, arbor in enumerate(self.arbors):
            role = arbor.roles[rows.roles[row, at]]
            reading = arbor.of(role)[rows.reads[row, at]]
            for dial in range(len(self.dials)):
                label = role.label(dial)
                if label and reading.driven is not None:
                    top[dial] *= reading.driven.teeth
                if label > 1:
                    bottom[dial] *= reading.drivers[label - 2].teeth
        return tuple(wanted * Fraction(*each) for wanted, *each in zip(self.wanted, top, bottom, strict=True))

    def whole_powers(self, rows: TrainRows) -> Ints:
        """By row, dial and prime, its power in what the surviving wheels leave to be added."""
        found = np.zeros((len(rows), len(self.dials), len(self.table.primes)), dtype=np.int64)
        for at, columns in enumerate(self.columns):
            row = columns.first[rows.roles[:, at]] + rows.reads[:, at]
            for wheel in range(columns.counts.shape[1]):
                powers = self.table.powers[columns.counts[row, wheel]]
                found += (1 if not wheel else -1) * columns.blocks[row, wheel][:, :, None] * powers[:, None, :]
        return found
