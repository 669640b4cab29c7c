"""Trains whose dials are exact, arbor by arbor: added wheels first, then what each surviving arbor is to all dials.

For each way to share out added wheels the surviving arbors get roles, then readings. A train is dropped as soon as its
sets of dials are not those of a tree, or large primes cannot be shared out among its added wheels, or the quotient of
two ends is none that the few added wheels between them make. What is left is looked into exactly.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import QuestionError
from geartrain.synthesis.reconstruction.added_structures import AddedSets, AddedStructures, Core
from geartrain.synthesis.reconstruction.arbor_roles import Role, crossing_bits, roles_of, set_bits
from geartrain.synthesis.reconstruction.asked_question import too_wide
from geartrain.synthesis.reconstruction.prime_shares import NO_STATE, PrimeShares, packed_powers
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.train_rows import (
    INPUT,
    CountTable,
    Ints,
    TrainRows,
    arbor_columns,
    powers_of,
)

_MOST_DIALS = 6
"""Dials whose sets are bits of a whole number."""
_FEW_WAYS = 4
"""Readings of an arbor that are told apart at once where it has large primes; of others, when all arbors have roles."""
_ALIKE = 2000
"""Trains from which on a reading is tried once for all that are alike."""
_PIECE = 1 << 18
"""Trains that are grown at once."""
_MOST_ROWS = 3_000_000_000
"""Trains that are looked at: an hour."""
_ODD = np.uint64(0x9E3779B97F4A7C15)
_LOOKED_UP = 2
"""Added wheels between two ends up to which their quotient is looked up on the way; of one more, at the end."""


def are_whole_trees_asked(problem: ReconstructionProblem) -> bool:
    """Whether a question may be answered so: exact dials that turn, no idlers, no rings, no arbors without wheels."""
    return (
        all(dial.is_exact and dial.least for dial in problem.dials)
        and 0 < len(problem.dials) <= _MOST_DIALS
        and not (problem.idlers or problem.rings)
        and all(arbor.wheels for arbor in (problem.input, *problem.arbors))
    )


class _Asked(NamedTuple):
    """What is the same for all trains with some added wheels.

    few, more   pairs of ends, by number, with the numbers of added wheels between them that drive and are driven
    roles       by arbor, the numbers of roles that it may have
    allowed     readings that were found for trains that are alike
    """

    added: AddedSets
    cores: CoreStates
    shares: PrimeShares
    few: tuple[tuple[int, int, int], ...]
    more: tuple[tuple[int, int, int], ...]
    roles: tuple[tuple[int, ...], ...]
    allowed: dict[tuple[int, ...], tuple[Ints, Ints]]


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
        """Arbors whose readings are told apart at once, then the others, and when each large prime is in no later one."""
        ways = [arbor.ways for arbor in self.arbors]
        size = [len(arbor.roles) for arbor in self.arbors]
        wide = {at for at, own in enumerate(ways) if own > (_FEW_WAYS if self.table.owners[at] else 1)}
        self._at_once = sorted({*range(len(ways))} - wide, key=lambda at: (ways[at] > 1, size[at]))
        self._later = sorted(wide, key=lambda at: ways[at])
        # of many roles those first whose large primes rule out most
        self._roles_later = sorted(wide, key=lambda at: (size[at], -ways[at]))
        order = [*self._at_once, *self._later]
        self._closing: dict[int, list[int]] = defaultdict(list)
        for column, prime in enumerate(self.table.shared):
            owners = [at for at in order if prime in self.table.owners[at]]
            self._closing[owners[-1] if owners else INPUT].append(column)

    def found(self, added: AddedSets, cores: Sequence[Core]) -> Iterator[TrainRows]:
        """All trains with some added wheels for which counts are not ruled out."""
        asked = self._asked(added, cores)
        rows = self._closed(self._start(asked), INPUT, asked)
        for piece in self._grown(rows, 0, asked):
            yield self._looked_up(piece, asked.more, asked)

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
        return _Asked(added, CoreStates(cores), shares, few, more, tuple(self._roles(added, cores)), {})

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
        up, down = ([powers_of(part, self.table.shared) for part in parts] for parts in zip(*map(_parts, self.wanted), strict=True))
        powers = [packed_powers([one[at] - two[at] for one, two in zip(up, down, strict=True)]) for at in range(len(self.table.shared))]
        whole = [set_bits(sets), crossing_bits(sets, (1 << len(self.dials)) - 1), turned, CoreStates.start, PrimeShares.start]
        return TrainRows(
            *(np.array([each], dtype=np.int64) for each in whole),
            np.array([powers], dtype=np.int64),
            np.array([[self.keys.key(each) for each in self.wanted]], dtype=np.uint64),
            np.zeros(1, dtype=np.int64),
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
        roles = len(self._at_once) + len(self._later)
        if step < roles:
            yield from self._grown(self._with_roles(rows, step, asked), step + 1, asked)
            return
        unread = self._later[step - roles :]
        rows = self._looked_up(rows, asked.few, asked, unread)
        if not unread:
            yield rows
        else:
            yield from self._grown(self._with_readings(rows, unread[0], asked), step + 1, asked)

    def _with_roles(self, rows: TrainRows, step: int, asked: _Asked) -> TrainRows:
        """Trains in which one arbor more has a role; and a reading, if its readings are told apart at once."""
        at_once = step < len(self._at_once)
        at = self._at_once[step] if at_once else self._roles_later[step - len(self._at_once)]
        last = step + 1 == len(self.arbors)
        columns, parts = self.columns[at], []
        may_be_read = None if at_once or last or not self.table.owners[at] else self._may_be_read(rows, at, asked)
        for number in asked.roles[at]:
            role = self.arbors[at].roles[number]
            good = (rows.crossing & columns.sets[number] == 0) & (rows.sets & columns.crossing[number] == 0)
            if last:
                good &= self._senses(rows.turned ^ columns.on[number])
            if may_be_read is not None:
                good &= may_be_read(number)
            if not good.any():
                continue
            core = asked.cores.after(rows.core[good], role, at == 0)
            good[good] = done = asked.cores.are_whole(core) if last else core != NO_STATE
            some = rows.kept(good)
            some = replace(
                some,
                sets=some.sets | columns.sets[number],
                crossing=some.crossing | columns.crossing[number],
                turned=some.turned ^ columns.on[number],
                core=core[done],
            )
            parts.append(some.having(at, number, None))
        found = TrainRows.joined(parts) if parts else rows.kept(slice(0))
        return self._with_readings(found, at, asked) if at_once else found

    def _senses(self, turned: Ints) -> NDArray[np.bool_]:
        """Whether all dials turn the way they must."""
        signed = sum(1 << at for at, dial in enumerate(self.dials) if dial.signed)
        wanted = sum(
            1 << at for at, dial in enumerate(self.dials) if dial.signed and dial.least / self.problem.input_speed < 0
        )
        return np.asarray(turned & signed == wanted)

    # readings

    def _with_readings(self, rows: TrainRows, at: int, asked: _Asked) -> TrainRows:
        """Trains in which an arbor has each of the readings that leave large primes to be shared out."""
        if not len(rows):
            return rows
        columns = self.columns[at]
        if len(rows) < _ALIKE:
            return self._with_each_reading(rows, at, asked)
        closing = self._closing[at]
        kinds, kind = _alike([rows.roles[:, at], rows.shares, *(rows.powers[:, each] for each in closing)])
        allowed = [self._allowed(rows, first, int(rows.roles[first, at]), at, closing, asked) for first in kinds]
        number = np.array([len(reads) for reads, _ in allowed])
        which, place = _repeated(number[kind], (np.cumsum(number) - number)[kind])
        read = np.concatenate([reads for reads, _ in allowed])[place]
        found = self._read(rows.kept(which), at, read)
        return replace(found, shares=np.concatenate([states for _, states in allowed])[place])

    def _with_each_reading(self, rows: TrainRows, at: int, asked: _Asked) -> TrainRows:
        """The same where there are few readings."""
        columns, roles = self.columns[at], rows.roles[:, at]
        which, read = _repeated(np.diff(columns.first)[roles], np.zeros(len(rows), dtype=np.int64))
        found = self._read(rows.kept(which), at, read)
        row = columns.first[found.roles[:, at]] + read
        states = np.where(columns.lost[row], NO_STATE, found.shares)
        for powers in columns.own[row].T:
            states = asked.shares.after(states, powers)
        return self._closed(replace(found, shares=states), at, asked)

    def _read(self, rows: TrainRows, at: int, read: Ints) -> TrainRows:
        """Rows with a reading of an arbor."""
        columns = self.columns[at]
        row = columns.first[rows.roles[:, at]] + read
        powers, keys = rows.powers + columns.powers[row], rows.keys + columns.keys[row]
        return replace(rows.having(at, None, read), powers=powers, keys=keys)

    def _allowed(
        self, rows: TrainRows, row: int, role: int, at: int, closing: Sequence[int], asked: _Asked
    ) -> tuple[Ints, Ints]:
        """The readings of a role that leave primes to be shared out, each with the state after it."""
        key = at, role, int(rows.shares[row]), len(closing), *rows.powers[row, closing].tolist()
        if key in asked.allowed:
            return asked.allowed[key]
        columns = self.columns[at]
        own = columns.readings(role)
        states = np.where(columns.lost[own], NO_STATE, rows.shares[row])
        for powers in columns.own[own].T:
            states = asked.shares.after(states, powers)
        for column in closing:
            states = self._after(states, rows.powers[row, column] + columns.powers[own, column], column, asked)
        reads = np.flatnonzero(states != NO_STATE)
        asked.allowed[key] = reads, states[reads]
        return asked.allowed[key]

    def _may_be_read(self, rows: TrainRows, at: int, asked: _Asked) -> Callable[[int], NDArray[np.bool_]]:
        """By role whether an arbor has a reading left, by the primes that no other arbor has that is not read."""
        others = frozenset[int]().union(*(self.table.owners[each] for each in self._later if each != at))
        closing = [column for column in self._closing[at] if self.table.shared[column] not in others]
        kinds, kind = _alike([rows.shares, *(rows.powers[:, each] for each in closing)])

        def by_role(role: int) -> NDArray[np.bool_]:
            some = [len(self._allowed(rows, first, role, at, closing, asked)[0]) > 0 for first in kinds]
            return np.array(some, dtype=bool)[kind]

        return by_role

    def _closed(self, rows: TrainRows, at: int, asked: _Asked) -> TrainRows:
        """Rows in which the primes that no arbor has can be shared out."""
        states = rows.shares
        for column in self._closing[at]:
            states = self._after(states, rows.powers[:, column], column, asked)
        return replace(rows, shares=states).kept(states != NO_STATE)

    def _after(self, states: Ints, powers: Ints, column: int, asked: _Asked) -> Ints:
        if self.table.shared[column] > self.table.greatest:
            return np.where(powers == 0, states, NO_STATE)
        return asked.shares.after(states, powers)

    # quotients of two ends

    def _looked_up(
        self, rows: TrainRows, pairs: Sequence[tuple[int, int, int]], asked: _Asked, unread: Sequence[int] = ()
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
            rows = replace(rows, checked=np.where(ready, rows.checked | 1 << pair, rows.checked)).kept(good)
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
        return tuple(wanted * Fraction(*each) for wanted, each in zip(self.wanted, zip(top, bottom, strict=True), strict=True))

    def whole_powers(self, rows: TrainRows) -> Ints:
        """By row, dial and prime, its power in what the surviving wheels leave to be added."""
        found = np.zeros((len(rows), len(self.dials), len(self.table.primes)), dtype=np.int64)
        for at, columns in enumerate(self.columns):
            row = columns.first[rows.roles[:, at]] + rows.reads[:, at]
            for wheel in range(columns.counts.shape[1]):
                powers = self.table.powers[columns.counts[row, wheel]]
                found += (1 if not wheel else -1) * columns.blocks[row, wheel][:, :, None] * powers[:, None, :]
        return found


def _repeated(often: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Numbers from 0 on, each so often; beside them numbers that rise by 1 from the first of each on."""
    which = np.repeat(np.arange(len(often)), often)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(often) - often, often) + first[which]


def _alike(columns: Sequence[NDArray[np.signedinteger[Any]]]) -> tuple[list[int], Ints]:
    """Rows that stand for all that are alike in some columns, and by row for which of them it is."""
    mixed = np.zeros(len(columns[0]), dtype=np.uint64)
    for column in columns:
        mixed = (mixed ^ column.astype(np.uint64)) * _ODD
        mixed ^= mixed >> np.uint64(29)
    _, first, which = np.unique(mixed, return_index=True, return_inverse=True)
    if all((column == column[first][which]).all() for column in columns):
        return first.tolist(), which
    # two that differ were mixed to the same word
    _, first, which = np.unique(np.stack(columns, axis=1), axis=0, return_index=True, return_inverse=True)
    return first.tolist(), which.ravel()


def _parts(ratio: Fraction) -> tuple[int, int]:
    return ratio.numerator, ratio.denominator


class CoreStates:
    """Special roles that are given out, as numbered states: those that some core has still."""

    start = 1

    def __init__(self, cores: Sequence[Core]) -> None:
        self._known: list[tuple[Role | None, tuple[Role, ...], tuple[Core, ...]]] = [(None, (), ()), (None, (), tuple(cores))]
        self._numbers: dict[tuple[Role | None, tuple[Role, ...]], int] = {(None, ()): 1}
        self._steps: dict[tuple[int, Role, bool], int] = {}

    def after(self, states: Ints, role: Role, is_input: bool) -> Ints:
        """Each state once an arbor more has a role."""
        if not (is_input or role.is_special):
            return states
        known, which = np.unique(states, return_inverse=True)
        steps = [self._step(int(state), role, is_input) for state in known]
        return np.array(steps, dtype=np.int64)[which]

    def are_whole(self, states: Ints) -> NDArray[np.bool_]:
        """Whether nothing of a core is left to be given out."""
        known, which = np.unique(states, return_inverse=True)
        whole = [any(core == self._known[state][:2] for core in self._known[state][2]) for state in known]
        return np.array(whole, dtype=bool)[which]

    def _step(self, state: int, role: Role, is_input: bool) -> int:
        key = state, role, is_input
        if key not in self._steps:
            root, roles, cores = self._known[state]
            if is_input:
                root, left = role, tuple(core for core in cores if core[0] == role)
            else:
                roles = tuple(sorted((*roles, role)))
                left = tuple(core for core in cores if core[1].count(role) >= roles.count(role))
            self._steps[key] = self._number(root, roles, left) if left else NO_STATE
        return self._steps[key]

    def _number(self, root: Role | None, roles: tuple[Role, ...], cores: tuple[Core, ...]) -> int:
        known = root, roles
        if known not in self._numbers:
            self._numbers[known] = len(self._known)
            self._known.append((root, roles, cores))
        return self._numbers[known]
