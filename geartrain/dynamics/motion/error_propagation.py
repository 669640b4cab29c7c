"""How the errors of pairs spread to links: equation (2) of docs/motion.md, solved block by block (its section 2).

a (e_i - e_k) + b (e_j - e_k) = c delta, with e the error of a link's angle and delta that of the pair's driven side:
the Willis system with its speeds taken out. Blocks (matching and strong components) are solved once, exactly; after
that every link is a sum over a few links before it.

Pairs that depend on each other, as around a differential, are solved together by Newton's method with halved steps,
equation (5) of docs/motion.md, on delta_m = sense_m error_m(S_m + gain_m delta), at all positions at once. Laws have
corners, so a step that does not lessen the residual is halved. A pair by itself is bisected where that fails: no step
leaves a dwell, in which the driven wheel rests while its driver turns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import GearTrainError, Problem, RangeError
from geartrain.numerics.block_triangular import Block, find_blocks
from geartrain.numerics.containers import ItemwiseMapping
from geartrain.numerics.elimination import LinearForm, eliminate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.teeth.transmission import TransmissionFunction

    Flags = NDArray[np.bool_]
    from geartrain.kinematics.willis_system import WillisSystem

_MOST_STEPS = 120  # halved steps count too
_CONVERGED = 2e-15  # rad, over the scale of the angles added
_FORGIVEN = 1e-9  # rad: a residual that no step lessens any more, at a corner
_HALVINGS = 64  # of four pitches, or of four turns of cut wheels: to rounding

_NO_FIT = "no angles of theirs fit all laws at once"
_DEAD_CENTRE = "past a dead centre: one of them drives another faster than it is driven by it"


@dataclass(frozen=True)
class CoupledErrors:
    """Pairs in parallel: names, laws, senses of the driven sides, and `gain`, (pairs, pairs)."""

    names: tuple[str, ...]
    transmissions: tuple[TransmissionFunction, ...]
    senses: Floats
    gain: Floats
    """Radians of driver m's forward angle per radian of pair n's driven error."""

    def transmissions_at(self, S: Floats, columns: Ints) -> tuple[Floats, Floats]:
        """Driven errors and their slopes over the drivers' angles, both signed, (pairs, n), at some positions."""
        error, slope = np.empty_like(S), np.empty_like(S)
        for at, transmission in enumerate(self.transmissions):
            error[at], tau = transmission.picked(columns).error_and_speed(S[at])
            slope[at] = tau - float(transmission.ratio)
        error *= self.senses[:, None]
        slope *= self.senses[:, None]
        return error, slope

    def jacobian(self, slope: Floats) -> Floats:
        """J = I - slope gain of equation (5) at each position, (n, pairs, pairs)."""
        return np.eye(len(self.transmissions)) - slope.T[:, :, None] * self.gain


def solve_coupled_errors(
    pairs: CoupledErrors, base: Floats, turning: Sequence[Floats | float]
) -> tuple[Floats, Floats, list[Floats | float]]:
    """Errors, their rates, and the speeds of the drivers, from the drivers' angles and speeds without these errors.

    base      (pairs, n) rad; `turning` by pair over the input's speed
    Raises `GearTrainError` where the laws have no single solution: the train would jump or lock there.
    """
    delta, slope = _newton(pairs, base)
    jacobian = pairs.jacobian(slope)
    speed = np.stack([np.broadcast_to(w, base.shape[1:]) for w in turning])
    # 1 for ideal teeth: not positive any more means past a dead centre
    if not (_determinant(jacobian) > 0).all():
        raise _refusal(pairs.names, _DEAD_CENTRE)
    rate = _solve_coupled(jacobian, slope * speed)
    return delta, rate, list(speed + pairs.gain @ rate)


@np.errstate(invalid="ignore")  # inf - inf where nothing touches
def _newton(pairs: CoupledErrors, base: Floats) -> tuple[Floats, Floats]:
    """Errors, and the slopes of the laws there."""
    tolerance = _CONVERGED * (1 + np.max(np.abs(base), initial=0.0) + np.abs(pairs.gain).sum(axis=1).max())
    active = np.arange(base.shape[1])
    delta, slopes = pairs.transmissions_at(base, active)
    now = delta.copy()
    length, size, step = np.ones(len(active)), np.full(len(active), np.inf), np.zeros_like(now)
    for _ in range(_MOST_STEPS):
        trial = now - length * step
        # at first the step is 0 and the size infinite: the first trial is the start itself
        error, slope = pairs.transmissions_at(base[:, active] + pairs.gain @ trial, active)
        residual = trial - error
        found = np.max(np.abs(residual), axis=0)
        better = found < size
        # where nothing lessens it any more the residual is rounding, or the last of a corner
        done = (better & (found <= tolerance)) | (~better & (length < 1e-9) & (size <= _FORGIVEN))
        length = np.where(better, 1.0, length / 2)
        now, size = np.where(better, trial, now), np.where(better, found, size)
        delta[:, active] = now
        slopes[:, active[better]] = slope[:, better]
        onward = better & ~done
        if onward.any():
            step[:, onward] = _stepped(pairs.jacobian(slope[:, onward]), residual[:, onward])
        left = ~done
        if not left.any():
            return delta, slopes
        active, now, step, length, size = active[left], now[:, left], step[:, left], length[left], size[left]
    stuck = active[size > _FORGIVEN]
    if stuck.size:
        delta[:, stuck], slopes[:, stuck] = _bisected(pairs, base[:, stuck], stuck)
    return delta, slopes


@np.errstate(invalid="ignore")
def _bisected(pairs: CoupledErrors, base: Floats, columns: Ints) -> tuple[Floats, Floats]:
    """Errors of a pair by itself, and the slopes of its law there: short of a dead centre, delta - error grows.

    A law may jump past the error, as that of cut teeth that clash: the error is then where the law jumps, its slope 0.
    Where nothing touches, the error is that of the law, infinite.
    """
    if len(pairs.transmissions) > 1:
        raise _refusal(pairs.names, _NO_FIT)
    high = np.full_like(base, 2 * float(pairs.transmissions[0].ratio) * pairs.transmissions[0].period)
    low = -high
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        error, slope = pairs.transmissions_at(base + pairs.gain * middle, columns)
        if (slope * pairs.gain > 1 + _FORGIVEN).any():
            raise _refusal(pairs.names, _DEAD_CENTRE)
        low, high = np.where(middle < error, middle, low), np.where(middle < error, high, middle)
    slope[np.abs(middle - error) > _FORGIVEN] = 0.0
    return np.where(np.isfinite(error), middle, error), slope


def _stepped(matrices: Floats, right: Floats) -> Floats:
    """Newton's step; none from a place where the pairs stand at a dead centre, and which no step leaves."""
    dead = _determinant(matrices) == 0
    if not dead.any():
        return _solve_coupled(matrices, right)
    step = np.zeros_like(right)
    if not dead.all():
        step[:, ~dead] = _solve_coupled(matrices[~dead], right[:, ~dead])
    return step


def _solve_coupled(matrices: Floats, right: Floats) -> Floats:
    """Solutions (pairs, n) of n small systems; by Cramer's rule for two, the usual number around a differential."""
    if matrices.shape[1] == 1:
        return np.asarray(right / matrices[:, 0, 0])
    if matrices.shape[1] == 2:
        # all positions in a few array operations, where LAPACK would be called once a position
        (a, b), (c, d) = matrices[:, 0].T, matrices[:, 1].T
        whole = a * d - b * c
        return np.stack([(right[0] * d - b * right[1]) / whole, (a * right[1] - c * right[0]) / whole])
    return np.ascontiguousarray(np.linalg.solve(matrices, right.T[:, :, None])[:, :, 0].T)


def _determinant(matrices: Floats) -> Floats:
    if matrices.shape[1] == 1:
        return np.asarray(matrices[:, 0, 0])
    return np.asarray(np.linalg.det(matrices))


def _refusal(pairs: Sequence[str], why: str) -> GearTrainError:
    """The error that says which pairs cannot be followed, and why."""
    names = ", ".join(pairs)
    if len(pairs) == 1:
        what = f"the driver of pair {names} is moved by what it drives, and cannot be followed"
        return GearTrainError(Problem(what, why, "give it ideal teeth, or say who drives it with `driver`"))
    return GearTrainError(
        Problem(f"the pairs {names} depend on each other and cannot be followed", why, "give some of them ideal teeth")
    )


class ErrorPath(NamedTuple):
    """One pair or coupling as a path of error: who drives, and the coefficient of the driven side in its row."""

    driver: int
    driven: int
    carrier: int
    coefficient: int


class PropagationBlock(NamedTuple):
    """Links solved together, from links known before and from the pairs whose rows these are."""

    links: tuple[int, ...]
    """Indices; `from_known` (links, known) and `from_pairs` (links, pairs) are their coefficients."""
    known: tuple[int, ...]
    """Indices; `from_known` (links, known) and `from_pairs` (links, pairs) are their coefficients."""
    pairs: tuple[int, ...]
    """Indices; `from_known` (links, known) and `from_pairs` (links, pairs) are their coefficients."""
    from_known: Floats
    from_pairs: Floats


@dataclass(frozen=True)
class ErrorPropagation:
    """The solved order of a train: `parts` in order, over `links` and `pairs` by index."""

    links: tuple[str, ...]
    pairs: tuple[str, ...]
    joints: Mapping[int, ErrorPath]
    """By pair, each made when it is first read."""
    parts: tuple[PropagationBlock, ...]
    """As far as the wanted links depend on them: all others have no error here."""

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
