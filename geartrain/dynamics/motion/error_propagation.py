"""How the errors of pairs spread to links: equation (2) of docs/motion.md, solved block by block (its section 2).

a (e_i - e_k) + b (e_j - e_k) = c delta, with e the error of a link's angle and delta that of the pair's driven side:
the Willis system with its speeds taken out. Blocks (matching and strong components) are solved once, exactly; after
that every link is a sum over a few links before it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.block_triangular import Block, find_blocks
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.numerics.elimination import LinearForm, eliminate

if TYPE_CHECKING:
    from geartrain.kinematics.willis_system import WillisSystem
    from geartrain.numerics.arrays import Floats


class ErrorPath(NamedTuple):
    """One pair or coupling as a path of error: who drives, and the coefficient of the driven side in its row."""

    driver: int
    driven: int
    carrier: int
    coefficient: int


class PropagationBlock(NamedTuple):
    """Links solved together, from links known before and from the pairs whose rows these are.

    links, known, pairs   indices; `from_known` (links, known) and `from_pairs` (links, pairs) are their coefficients
    """

    links: tuple[int, ...]
    known: tuple[int, ...]
    pairs: tuple[int, ...]
    from_known: Floats
    from_pairs: Floats


@dataclass(frozen=True)
class ErrorPropagation:
    """The solved order of a train: `parts` in order, over `links` and `pairs` by index.

    joints   by pair, each made when it is first read
    parts    as far as the wanted links depend on them: all others have no error here
    """

    links: tuple[str, ...]
    pairs: tuple[str, ...]
    joints: Mapping[int, ErrorPath]
    parts: tuple[PropagationBlock, ...]

    @property
    def reached(self) -> frozenset[int]:
        """The pairs whose error reaches the wanted links, directly or by the angle of another pair's driver."""
        return frozenset(pair for part in self.parts for pair in part.pairs)

    def errors(self, deltas: Floats) -> Floats:
        """Errors of all links, (links, n), from those of all pairs, (pairs, n): linear, the pairs left as they are."""
        found = np.zeros((len(self.links), deltas.shape[1]))
        for part in self.parts:
            spread = part.from_known @ found[list(part.known)] + part.from_pairs @ deltas[list(part.pairs)]
            found[list(part.links)] = spread
        return found

    def sensitivity(self, link: int, base: int, sense: int = 1) -> Floats:
        """Radians of a link, seen from another, per radian of each pair's driven error, by the adjoint: one walk back.

        sense   -1 where the axes of the two point against each other

        Raises `RangeError` where one of them is beyond float64.
        """
        weight = np.zeros(len(self.links))
        weight[link] += 1.0
        weight[base] -= sense
        found = np.zeros(len(self.pairs))
        with np.errstate(over="ignore", invalid="ignore"):  # judged at the end, once
            for part in reversed(self.parts):
                own = weight[list(part.links)]
                if own.any():
                    found[list(part.pairs)] = own @ part.from_pairs
                    weight[list(part.known)] += own @ part.from_known
        if not np.isfinite(found).all():
            what = f"'{self.links[link]}' turns more than 1e308 times as far as a pair's error"
            why = "motion is followed in float64, which holds 1e-308 to 1e308"
            raise RangeError(Problem(what, why, "drive the train nearer to this output, or ask `solve`"))
        return found


def find_error_propagation(
    system: WillisSystem, ends: Mapping[str, Sequence[int]], path: Callable[[str], ErrorPath], wanted: Iterable[int]
) -> ErrorPropagation | None:
    """The solved order of a square system before some links; None where its rows do not determine them.

    ends     both sides and the carrier of each pair, by the label of its row; other rows have no error (inputs, locks)
    path     of a pair by its label: called for pairs that the wanted links depend on, and for others when they are read
    wanted   links by index
    """
    at = {link: number for number, link in enumerate(system.links)}
    rows = [{at[link]: coefficient for link, coefficient in row.terms} for row in system.equations]
    pairs = tuple(ends)
    pair_of = {label: number for number, label in enumerate(pairs)}
    own = [pair_of.get(row.label, -1) for row in system.equations]
    if len(rows) != len(at):
        return None
    # the angle of a pair depends on its driver and its carrier even where the row does not hold them
    also = [ends[pairs[pair]] if pair >= 0 else () for pair in own]
    blocks = find_blocks([tuple(row) for row in rows], also)
    if blocks is None:
        return None
    joints = ItemwiseMapping(range(len(pairs)), lambda pair: path(pairs[pair]))
    parts = []
    for block in _before(wanted, blocks, [(*row, *more) for row, more in zip(rows, also, strict=True)]):
        part = _solve(block, rows, own, joints)
        if part is None:
            return None
        parts.append(part)
    return ErrorPropagation(system.links, pairs, joints, tuple(parts))


def _before(wanted: Iterable[int], blocks: Sequence[Block], rows: Sequence[Sequence[int]]) -> list[Block]:
    """The blocks that some columns depend on, in their order; `rows` as the columns that each depends on."""
    needed, kept = set(wanted), []
    for block in reversed(blocks):
        if needed.intersection(block.columns):
            needed.update(*(rows[row] for row in block.rows))
            kept.append(block)
    return kept[::-1]


def _solve(
    block: Block, rows: Sequence[Mapping[int, int]], own: Sequence[int], joints: Mapping[int, ErrorPath]
) -> PropagationBlock | None:
    """One block, exactly: its links as forms of what is known before it and of its pairs' errors."""
    inside = {column: number for number, column in enumerate(block.columns)}
    known = tuple(dict.fromkeys(column for row in block.rows for column in rows[row] if column not in inside))
    pairs = tuple(own[row] for row in block.rows if own[row] >= 0)
    symbol = {column: -1 - number for number, column in enumerate(known)}
    forms: list[LinearForm] = []
    for row in block.rows:
        form = {
            inside[column] if column in inside else symbol[column]: Fraction(coefficient)
            for column, coefficient in rows[row].items()
        }
        if own[row] >= 0:
            form[-1 - len(known) - pairs.index(own[row])] = Fraction(-joints[own[row]].coefficient)
        forms.append(form)
    solved = eliminate(forms)
    if solved.rank < len(block.columns):
        return None
    by_column = solved.forms()
    wanted = [by_column[number] for number in range(len(block.columns))]
    return PropagationBlock(
        block.columns, known, pairs, _matrix(wanted, 0, len(known)), _matrix(wanted, len(known), len(pairs))
    )


def _matrix(forms: Sequence[LinearForm], first: int, count: int) -> Floats:
    found = np.zeros((len(forms), count))
    for at, form in enumerate(forms):
        for number in range(count):
            # exact up to here, and rounded once
            found[at, number] = float(form.get(-1 - first - number, 0))
    return found
