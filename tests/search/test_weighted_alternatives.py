"""Sums over weighted alternatives, of single nodes and of tables, against lists of all wholes; draws by chance."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from itertools import product
from math import prod
from random import Random
from typing import Any

import numpy as np
import pytest

from geartrain.search.weighted_alternatives import Alternative, AlternativeRows, WeightedAlternatives

ANSWERS = 3


@dataclass(frozen=True, eq=False)
class Table:
    """Some alternatives, as (row that each is of, weight, answer that it tells, row in each part)."""

    size: int
    ways: tuple[tuple[int, int, int, tuple[int, ...]], ...]
    parts: tuple[Table, ...]


def random_table(chance: Random, weights: range, depth: int = 2) -> Table:
    parts = tuple(random_table(chance, weights, depth - 1) for _ in range(chance.randint(0, 2) if depth else 0))
    size = chance.randint(1, 3)

    def way() -> tuple[int, int, int, tuple[int, ...]]:
        rows = tuple(chance.randrange(part.size) for part in parts)
        return chance.randrange(size), chance.choice(weights), chance.randrange(ANSWERS), rows

    return Table(size, tuple(way() for _ in range(chance.randint(1, 5))), parts)


def wholes(table: Table, row: int) -> Iterator[tuple[int, tuple[tuple[Table, int], ...]]]:
    """Weight of each, and what it tells."""
    for owner, weight, answer, rows in table.ways:
        if owner == row:
            for below in product(*(list(wholes(part, at)) for part, at in zip(table.parts, rows, strict=True))):
                told = ((table, answer), *(one for _, told in below for one in told))
                yield weight * prod(own for own, _ in below), told


def single(node: Hashable) -> Iterator[Alternative[Hashable]]:
    table, row = node  # type: ignore[misc]
    for owner, weight, answer, rows in table.ways:
        if owner == row:
            yield Alternative(weight, ((table, answer),), tuple(zip(table.parts, rows, strict=True)))


def rows_of(table: Table, dtype: Any) -> Iterator[AlternativeRows[Table]]:
    """The alternatives of a table, in two lots."""
    for ways in (table.ways[:2], table.ways[2:]):
        columns = [[way[at] for way in ways] for at in range(3)]
        leads = [np.array([way[3][at] for way in ways], dtype=np.int64) for at in range(len(table.parts))]
        yield AlternativeRows(
            np.array(columns[1], dtype=dtype),
            table.size,
            np.array(columns[0], dtype=np.int64),
            tuple(zip(table.parts, leads, strict=True)),
            ((table, ANSWERS, np.array(columns[2], dtype=np.int64)),),
        )


@pytest.mark.parametrize(("weights", "dtype"), [(range(-3, 6), np.int64), (range(10**30, 10**30 + 9), object)])
def test_sums_over_tables_are_those_over_wholes(weights: range, dtype: Any) -> None:
    chance, told = Random(1), 0
    for _ in range(200):
        table = random_table(chance, weights)
        sums = WeightedAlternatives(table, lambda one: rows_of(one, dtype))
        every = [list(wholes(table, row)) for row in range(table.size)]
        assert sums.total.tolist() == [sum(weight for weight, _ in own) for own in every]
        expected = Counter[tuple[Table, int]]()
        for weight, tells in (one for own in every for one in own):
            expected.update(dict.fromkeys(tells, weight))
        found = {(one, at): value for one, own in sums.marginals.items() for at, value in enumerate(own) if value}
        assert found == {told: weight for told, weight in expected.items() if weight}
        told += len(found)
    assert told > 500


def test_sums_over_single_nodes_are_those_over_wholes() -> None:
    chance, told = Random(2), 0
    for _ in range(200):
        table = random_table(chance, range(5))
        sums = WeightedAlternatives((table, 0), single)
        every = list(wholes(table, 0))
        assert sums.total == sum(weight for weight, _ in every)
        expected = Counter[tuple[Table, int]]()
        for weight, tells in every:
            expected.update(dict.fromkeys(tells, weight))
        assert sums.marginals == +expected
        told += len(expected)
    assert told > 300


def test_wholes_are_drawn_by_their_weight() -> None:
    chance, number, tried = Random(3), 2000, 0
    for _ in range(90):
        table = random_table(chance, range(5))
        sums = WeightedAlternatives((table, 0), single)
        if not sums.total:
            continue
        expected = Counter[frozenset[Hashable]]()
        for weight, tells in wholes(table, 0):
            expected[frozenset(tells)] += weight
        found = Counter(frozenset(sums.draw(chance)) for _ in range(number))
        assert found.keys() <= (+expected).keys()
        for told, weight in expected.items():
            share = weight / sums.total
            # six standard deviations
            assert abs(found[told] - number * share) <= 6 * (number * share * (1 - share)) ** 0.5
        tried += len(+expected) > 1
    assert tried > 10
