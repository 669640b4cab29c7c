"""Trains put together arbor by arbor, millions at a time, as columns of arrays; and what each arbor changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.arbor_roles import RolesOfArbor, crossing_bits, in_sets, set_bits
from geartrain.synthesis.reconstruction.prime_shares import Ints, packed_powers
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys, prime_powers

States = NDArray[np.int32]
Words = NDArray[np.signedinteger[Any]]
"""Whole numbers of any length."""
_ODD = np.uint64(0x9E3779B97F4A7C15)
"""By which words are mixed."""
INPUT = -1
"""The end from which all paths start, among ends that are dials by number."""


@dataclass(frozen=True)
class TrainRows:
    """Trains of which some arbors have roles, and some of these have readings, a row each.

    sets, crossing  families of sets of dials: those below its wheels, and those that cross one of them
    turned          bits of dials that an odd number of arbors leads to
    core, shares    states: roles of special arbors; how large primes may be shared out
    powers          by large prime that several arbors have, or a dial: its packed powers in what is to be added
    keys            by dial: key of what is to be added; left out until all arbors have roles
    checked         bits of pairs of ends whose quotient was looked up
    roles, reads    by arbor: number of its role, and of the reading of that
    """

    sets: Words
    crossing: Words
    turned: NDArray[np.int8]
    core: States
    shares: States
    powers: Words
    keys: NDArray[np.uint64]
    checked: States
    roles: NDArray[np.int16]
    reads: States

    def __len__(self) -> int:
        return len(self.sets)

    def kept(self, rows: NDArray[np.bool_] | Ints | slice) -> TrainRows:
        """Some of them."""
        return TrainRows(*(getattr(self, each.name)[rows] for each in fields(self)))


@dataclass(frozen=True)
class ArborColumns:
    """What an arbor changes, by role, or by role and reading in a row.

    sets, crossing, on, pairs   by role: as in rows; pairs of ends whose quotient it changes
    first                       by role: where its readings begin, and where the last one's end
    keys, powers                by reading: what is added to those of rows
    own                         by reading: packed powers of large primes that nothing else has, 0 for none
    lost                        by reading: whether one of these is in no added wheel
    counts                      by reading: places in a table of counts, the driven wheel's first; 0 for none
    """

    sets: tuple[int, ...]
    crossing: tuple[int, ...]
    on: tuple[int, ...]
    pairs: Ints
    first: Ints
    keys: NDArray[np.uint64]
    powers: Ints
    own: Ints
    lost: NDArray[np.bool_]
    counts: Ints
    blocks: Ints

    def readings(self, role: int) -> slice:
        """Where the readings of a role are."""
        return slice(int(self.first[role]), int(self.first[role + 1]))


class CountTable:
    """Counts of surviving wheels, each with its key and the powers of its primes.

    primes   all primes in counts and in some other numbers
    large    those of which an added wheel has one at most
    shared   large ones that several arbors have, or the other numbers
    """

    def __init__(
        self, arbors: Sequence[RolesOfArbor], others: Sequence[int], least: int, greatest: int, keys: QuotientKeys
    ) -> None:
        self.greatest = greatest
        by_arbor = [{count for wheel in each.arbor.wheels for count, _ in wheel.counts} for each in arbors]
        self.values = (1, *sorted(set().union(*by_arbor) - {1}))
        self.place = {count: at for at, count in enumerate(self.values)}
        self.keys = np.array([keys.key(count) for count in self.values], dtype=np.uint64)
        known = {prime for count in (*self.values, *others) for prime, _ in prime_powers(count)}
        self.primes = tuple(sorted(known))
        self.powers = np.array([powers_of(count, self.primes) for count in self.values], dtype=np.int64)
        owners = [{prime for count in own for prime, _ in prime_powers(count)} for own in by_arbor]
        asked = {prime for number in others for prime, _ in prime_powers(number)}
        self.large = tuple(prime for prime in self.primes if prime * prime > greatest)
        self.shared = tuple(p for p in self.large if p in asked or sum(p in own for own in owners) > 1)
        self.owners = tuple(frozenset(own & set(self.large)) for own in owners)

    def columns(self, primes: Sequence[int]) -> Ints:
        """Powers of some primes, by count."""
        return self.powers[:, [self.primes.index(prime) for prime in primes]]


def powers_of(number: int, primes: Sequence[int]) -> list[int]:
    """The power of each of some primes in a number."""
    powers = dict(prime_powers(number))
    return [powers.get(prime, 0) for prime in primes]


def ratio_powers(ratio: Fraction, primes: Sequence[int]) -> list[int]:
    """The same in a quotient."""
    up, down = powers_of(ratio.numerator, primes), powers_of(ratio.denominator, primes)
    return [one - other for one, other in zip(up, down, strict=True)]


def arbor_columns(arbor: RolesOfArbor, at: int, dials: int, table: CountTable) -> ArborColumns:
    """The columns of an arbor, the input at 0."""
    every = (1 << dials) - 1
    ends = list(combinations(range(INPUT, dials), 2))
    own = sorted(table.owners[at] - {*table.shared})
    widest = max((len(role.blocks) for role in arbor.roles), default=0)
    counts, blocks, first = [], [], [0]
    for role in arbor.roles:
        reads = arbor.of(role)
        teeth = [[one.driven.teeth if one.driven else 1, *(wheel.teeth for wheel in one.drivers)] for one in reads]
        padded = [[table.place[count] for count in one] + [0] * (widest + 1 - len(one)) for one in teeth]
        counts.append(np.array(padded, dtype=np.int64).reshape(len(reads), widest + 1))
        sets = (role.on if at else 0, *role.blocks, *[0] * (widest - len(role.blocks)))
        blocks.append(np.broadcast_to(in_sets(sets, dials), (len(reads), widest + 1, dials)))
        first.append(first[-1] + len(reads))
    places, inside = np.concatenate(counts), np.concatenate(blocks)
    signs = np.array([1, *[-1] * widest])[None, :, None] * inside
    weights = _packed_weights(dials)
    packed = np.einsum("nwd,nwp,d->np", signs, table.columns(table.large)[places], weights)
    lone = [table.large.index(prime) for prime in own]
    gone = [table.large.index(prime) for prime in own if prime > table.greatest]
    return ArborColumns(
        tuple(set_bits(role.sets) for role in arbor.roles),
        tuple(crossing_bits(role.sets, every) for role in arbor.roles),
        tuple(role.on if at else 0 for role in arbor.roles),
        np.array([_changed(tuple(map(role.label, range(dials))), ends) for role in arbor.roles], dtype=np.int64),
        np.array(first, dtype=np.int64),
        (signs.astype(np.uint64) * table.keys[places][:, :, None]).sum(axis=1, dtype=np.uint64),
        packed[:, [table.large.index(prime) for prime in table.shared]],
        _squeezed(packed[:, lone]),
        (packed[:, gone] != 0).any(axis=1),
        places,
        inside,
    )


def _packed_weights(dials: int) -> Ints:
    """What a power of 1 of each dial is, packed."""
    return np.array([packed_powers([int(at == dial) for at in range(dials)]) for dial in range(dials)], dtype=np.int64)


def _changed(labels: tuple[int, ...], ends: Sequence[tuple[int, int]]) -> int:
    """Pairs of ends whose quotient an arbor changes."""
    label = {INPUT: 0, **dict(enumerate(labels))}
    return sum(1 << at for at, (one, other) in enumerate(ends) if label[one] != label[other])


def _squeezed(powers: Ints) -> Ints:
    """Entries that are not 0, in as few columns as hold them."""
    order = np.argsort(powers == 0, axis=1, kind="stable")
    found = np.take_along_axis(powers, order, axis=1)
    return found[:, : int((powers != 0).sum(axis=1).max(initial=0))]


# rows that are repeated, and rows that are alike


def repeated(often: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Numbers from 0 on, each so often; beside them numbers that rise by 1 from the first of each on."""
    which = np.repeat(np.arange(len(often)), often)
    return which, np.arange(len(which)) - np.repeat(np.cumsum(often) - often, often) + first[which]


def alike_rows(columns: Sequence[Words]) -> tuple[list[int], Ints]:
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
