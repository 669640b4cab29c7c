"""The sides of the teeth of one wheel cut into pieces: polynomials whose radius rises."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.polynomial_pieces import COUNT, PolynomialPiece, fitted
from geartrain.teeth.contact.flank_table import FlankTable

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact.outline_curve import OutlineCurve

_FLAT = 1e-12  # of the radius: a piece that rises less is an arc about the axle
_TURNED = 1e-9  # of the greatest slope: less is no turning point
_SMOOTH = 1e-7  # rad: curves that meet under less have no corner
_STILL = 1e-3  # of its second derivative: a slope that says nothing of the direction


def table(sides: Sequence[tuple[OutlineCurve, ...]]) -> FlankTable:
    """The sides of the teeth of a wheel, each a chain of curves. Raises `RangeError` where a curve is not smooth."""
    pieces: list[tuple[PolynomialPiece, bool, bool]] = []
    first, curves = [0], list[int]()
    for side in sides:
        for chain in _side(side):
            curves += [curves[-1] + 1 if curves else 0] * len(chain)
            pieces += chain
        first.append(len(pieces))
    coefficients = np.stack([piece.coefficients for piece, _, _ in pieces])
    radius, azimuth = np.ascontiguousarray(coefficients[:, :, 0].T), np.ascontiguousarray(coefficients[:, :, 1].T)
    rise = radius[1::2].sum(axis=0)  # half the radius at u = 1 less that at u = -1
    flat = np.abs(rise) < _FLAT * radius[0]
    falls = rise < 0
    corners = np.array([[begins, ends] for _, begins, ends in pieces]).T
    # u reversed: odd powers change their sign
    for each in (radius, azimuth):
        each[1::2, falls] *= -1
    corners[:, falls] = corners[::-1, falls]
    errors = np.stack([piece.error for piece, _, _ in pieces]).max(axis=0)
    return FlankTable(
        radius, azimuth, corners, flat, np.array(first), np.array(curves), (float(errors[0]), float(errors[1]))
    )


def _side(side: tuple[OutlineCurve, ...]) -> list[list[tuple[PolynomialPiece, bool, bool]]]:
    """The pieces of each curve of a chain, and whether each piece begins, ends, in a corner."""
    found = [
        [each for piece in fitted(curve.polar, curve.start, curve.end) for each in _rising(curve, piece)]
        for curve in side
    ]
    corner = [True, *(_corner(a[-1], b[0]) for a, b in pairwise(found)), True]
    return [
        [(piece, at == 0 and corner[i], at == len(pieces) - 1 and corner[i + 1]) for at, piece in enumerate(pieces)]
        for i, pieces in enumerate(found)
    ]


def _corner(last: PolynomialPiece, new: PolynomialPiece) -> bool:
    """Whether two curves that meet change their direction there."""
    before, after = _direction(last, 1), _direction(new, -1)
    return bool(abs(before[0] * after[1] - before[1] * after[0]) > _SMOOTH or before @ after < 0)


def _direction(piece: PolynomialPiece, end: int) -> Floats:
    """Unit vector along a curve at u = end, -1 or 1; that of its second derivative where the first one is 0."""
    powers = np.arange(COUNT)
    signs = np.where(powers % 2, 1.0, end)
    first = powers * signs @ piece.coefficients
    # just inside the piece the slope is the second derivative times the way from the end, whose sign is -end
    second = -end * (powers * (powers - 1) * signs * end @ piece.coefficients)
    # azimuth times radius is a length too
    round_ = np.array([1.0, float(piece.coefficients[0, 0])])
    chosen = first if np.hypot(*(first * round_)) > _STILL * np.hypot(*(second * round_)) else second
    found: Floats = chosen * round_ / np.hypot(*(chosen * round_))
    return found


def _rising(curve: OutlineCurve, piece: PolynomialPiece) -> list[PolynomialPiece]:
    """A piece cut where its radius turns."""
    slope = np.asarray(np.polynomial.polynomial.polyder(piece.coefficients[:, 0]), dtype=np.float64)
    u = np.linspace(-1, 1, 65)
    values = np.polynomial.polynomial.polyval(u, slope)
    small = max(_TURNED * float(np.abs(values).max()), _FLAT * float(piece.coefficients[0, 0]))
    marked = np.flatnonzero(np.abs(values) > small)
    turns = [(i, j) for i, j in pairwise(marked.tolist()) if (values[i] > 0) != (values[j] > 0)]
    if not turns:
        return [piece]
    half, middle = (piece.end - piece.start) / 2, piece.start + (piece.end - piece.start) / 2
    cuts = [piece.start, *(middle + half * _turning(slope, u[i], u[j]) for i, j in turns), piece.end]
    return [each for start, end in pairwise(cuts) for each in fitted(curve.polar, start, end)]


def _turning(slope: Floats, low: float, high: float) -> float:
    """Where a polynomial changes its sign between low and high."""
    rising = np.polynomial.polynomial.polyval(high, slope) > 0
    # bisection to neighbouring floats: the slope is that of a fit, and noise where the radius hardly turns
    while low < (middle := low + (high - low) / 2) < high:
        if (np.polynomial.polynomial.polyval(middle, slope) > 0) == rising:
            high = middle
        else:
            low = middle
    return low
