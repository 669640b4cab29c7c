"""Where a polynomial in one open item keeps its sign: a ray of the item's sorted values, found by binary search.

Divided by the item's lowest power it is A y + B, with y a power of the item, and changes its sign at -B/A. Rounding
leaves a doubt about values next to that: a window says which values surely meet its inequalities, and which may.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from geartrain.numerics.arrays import Bools, Floats, Ints
from geartrain.synthesis.join.partial_assignments import PartialAssignments
from geartrain.synthesis.join.polynomial_signs import ROUNDING, SignPolynomial, Signs
from geartrain.synthesis.join.product_lists import Item


@dataclass(frozen=True)
class PolynomialInequality:
    """sense * polynomial >= 0, or > 0 where it is strict."""

    polynomial: SignPolynomial
    sense: int
    strict: bool = False

    def met(self, signs: Signs) -> Bools:
        """Where it holds, given the polynomial's exact signs."""
        found: Bools = (signs * self.sense > 0) if self.strict else (signs * self.sense >= 0)
        return found


@dataclass(frozen=True)
class SolutionWindow:
    """For each row the run of an item's values that may meet a case, and the run within it that surely does.

    start, end             outer: values before `start` and from `end` on surely fail
    sure_start, sure_end   inner; empty where sure_end <= sure_start
    """

    start: Ints
    end: Ints
    sure_start: Ints
    sure_end: Ints

    def clipped(self, first: int, last: int) -> SolutionWindow:
        """Cut to the values from `first` up to `last`, exclusive; ends are never before starts."""
        start, end = np.maximum(self.start, first), np.minimum(self.end, last)
        end = np.maximum(start, end)
        sure_start, sure_end = np.clip(self.sure_start, start, end), np.clip(self.sure_end, start, end)
        return SolutionWindow(start, end, sure_start, np.maximum(sure_start, sure_end))


def find_window(case: Sequence[PolynomialInequality], rows: PartialAssignments, item: int) -> SolutionWindow:
    """The window of a case in the one open item: the common part of its rays."""
    start, end = np.zeros(rows.size, dtype=np.int64), np.full(rows.size, len(rows.items[item]))
    sure_start, sure_end = start.copy(), end.copy()
    for inequality in case:
        ray = _ray(inequality, rows, item)
        start, end = np.maximum(start, ray.start), np.minimum(end, ray.end)
        sure_start, sure_end = np.maximum(sure_start, ray.sure_start), np.minimum(sure_end, ray.sure_end)
    return SolutionWindow(start, end, sure_start, sure_end)


def _ray(inequality: PolynomialInequality, rows: PartialAssignments, item: int) -> SolutionWindow:
    """Where sense * (A y + B) >= 0, y the item's value to some power (after dividing by its lowest power)."""
    parts = inequality.polynomial.split(item)
    most = len(rows.items[item])
    if len(parts) < 2:
        met = inequality.met(next(iter(parts.values()), inequality.polynomial).signs(rows))
        return _all_or_nothing(met, most)
    (low, B), (high, A) = parts.items()
    scale = inequality.polynomial.scale
    a, size = A.values(rows, scale)
    # four times the rounding: then |a| less its error is at least three quarters of |a|, and its sign is sure
    known = np.abs(a) > 4 * A.rounding * size
    if known.all():
        return _bounded(inequality, rows, rows.items[item], high - low, (a, A.rounding * size), B)
    return _in_doubt(inequality, rows, item, known, (A, B))


def _bounded(
    inequality: PolynomialInequality,
    rows: PartialAssignments,
    item: Item,
    power: int,
    slope: tuple[Floats, Floats],
    rest: SignPolynomial,
) -> SolutionWindow:
    """The ray where the sign of A is sure: its end is -B/A, give or take what rounding may do."""
    a, off_a = slope
    b, size = rest.values(rows, inequality.polynomial.scale)
    end = -b / a
    # first-order bound on the error of -b/a, and what rounding does to the item's power itself
    off = (rest.rounding * size + np.abs(end) * off_a) / (np.abs(a) - off_a)
    off += np.abs(end) * (8 * power + 8) * ROUNDING
    least, greatest, y = end - off, end + off, item.powers(power)
    rising = (a > 0) == (inequality.sense > 0)
    if rising.all():
        return _rising(y, least, greatest)
    if not rising.any():
        return _falling(y, least, greatest)
    up, down = _rising(y, least, greatest), _falling(y, least, greatest)
    return SolutionWindow(
        np.where(rising, up.start, down.start),
        np.where(rising, up.end, down.end),
        np.where(rising, up.sure_start, down.sure_start),
        np.where(rising, up.sure_end, down.sure_end),
    )


def _rising(y: Floats, least: Floats, greatest: Floats) -> SolutionWindow:
    """All y from somewhere between `least` and `greatest` on."""
    start = np.searchsorted(y, least, side="left")
    end = np.full(len(start), len(y))
    sure = start.copy()
    near = np.flatnonzero((start < len(y)) & (y[np.minimum(start, len(y) - 1)] <= greatest))
    sure[near] = np.searchsorted(y, greatest[near], side="right")
    return SolutionWindow(start, end, sure, end)


def _falling(y: Floats, least: Floats, greatest: Floats) -> SolutionWindow:
    """All y up to somewhere between `least` and `greatest`."""
    end = np.searchsorted(y, greatest, side="right")
    start = np.zeros(len(end), dtype=np.int64)
    sure = end.copy()
    near = np.flatnonzero((end > 0) & (y[np.maximum(end - 1, 0)] >= least))
    sure[near] = np.searchsorted(y, least[near], side="left")
    return SolutionWindow(start, end, start, sure)


def _all_or_nothing(met: Bools, most: int) -> SolutionWindow:
    start = np.zeros(len(met), dtype=np.int64)
    end = np.where(met, most, 0)
    return SolutionWindow(start, end, start, end)


def _in_doubt(
    inequality: PolynomialInequality,
    rows: PartialAssignments,
    item: int,
    known: Bools,
    parts: tuple[SignPolynomial, SignPolynomial],
) -> SolutionWindow:
    """The ray where rounding hides the sign of A in some rows: where A is 0, B decides; else all stays in doubt."""
    A, B = parts
    found = np.zeros((4, rows.size), dtype=np.int64)
    found[1] = len(rows.items[item])
    sure = np.flatnonzero(known)
    if len(sure):
        ray = _ray(inequality, rows.pick(sure), item)
        found[:, sure] = ray.start, ray.end, ray.sure_start, ray.sure_end
    doubtful = np.flatnonzero(~known)
    flat = doubtful[A.signs(rows.pick(doubtful)) == 0]
    if len(flat):
        ray = _all_or_nothing(inequality.met(B.signs(rows.pick(flat))), len(rows.items[item]))
        found[:, flat] = ray.start, ray.end, ray.sure_start, ray.sure_end
    return SolutionWindow(*found)
