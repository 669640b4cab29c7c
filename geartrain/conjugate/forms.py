"""The sides of each optimal shape: uniform stress, uniform temperature, least friction; and involute and cycloid.

A side is described with the coefficient `a` of the gear whose addendum works and `b` of the one whose dedendum does:
a = A, b = B in recess, exchanged in approach.
"""

from __future__ import annotations

from math import atan, cos, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.collocation import Both, solved
from geartrain.conjugate.pieces import Circle, Piece, Ray, Sampled, Steady, circle_end, ray_end
from geartrain.conjugate.side import Side
from geartrain.roots import root

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.conjugate.chebyshev import Series
    from geartrain.conjugate.pitch import Floats, Pitch

_NEAR = 0.05  # of a side: nearer to the pitch point slopes are those of the series


def involute(X: float, psi: float) -> Side:
    """A constant pressure angle."""
    return Side((Ray(psi, ray_end(psi, X)),))


def cycloid(X: float, rho: float) -> Side:
    """The epicycloid and hypocycloid of a rolling circle of radius `rho`; spur only."""
    return Side((Circle(rho, circle_end(rho, X)),))


def uniform_stress(pitch: Pitch, a: float, b: float, X: float, psi: float) -> Side:
    """kr / cos psi constant: w = ((b - a) S + sqrt((a + b)^2 S^2 + 4 k tan psi)) / 2, k = sin psi0 cos psi0."""
    k = sin(psi) * cos(psi)

    def f(d: Floats, v: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore", divide="ignore"):
            cosine = np.sqrt(1 - v * v)
            under = np.sqrt(((a + b) * S) ** 2 + 4 * k * v / cosine)
            w = ((b - a) * S + under) / 2
            return pitch.S_slope(d) * v - w, pitch.S_slope(d) - k / (under * cosine**3)

    return Side((_to_arc(lambda end: _piece(pitch, f, sin(psi), end), ray_end(psi, X), X),))


def _piece(pitch: Pitch, f: Both, first: float, end: float, start: float = 0.0) -> Piece:
    """sin psi itself as the solution of S v' + f = 0."""
    v = solved(pitch, f, first, end, start)
    slope = _slope(pitch, f, v)
    return Sampled(v, slope, start, end, max(len(v.coefficients), 64))


def _slope(pitch: Pitch, f: Both, v: Series) -> Callable[[Floats], Floats]:
    """v' from the equation itself, but for the neighbourhood of the pitch point, where that would be 0/0."""
    steep = v.derivative()

    def slope(d: Floats) -> Floats:
        S = pitch.S(d)
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(d > _NEAR * v.end, -f(d, v(d))[0] / S, steep(d))

    return slope


def _to_arc(made: Callable[[float], Piece], guess: float, X: float) -> Piece:
    """The piece whose end has travelled X: Newton on the end, its slope being 1 / cos psi there."""
    end = guess
    piece = made(end)
    for _ in range(30):
        at = np.array(end)
        step = (float(piece.travel(at)) - X) * sqrt(1 - float(piece.sin_psi(at)) ** 2)
        if abs(step) <= 4e-16 * end:
            break
        end -= step
        piece = made(end)
    return piece


def uniform_heat(pitch: Pitch, beta: float, gamma: float, X: float) -> Side:
    """w = beta S + gamma S / cos psi with psi = 0 at the pitch point; beta = b of the hotter surface (reading b)."""
    return Side((_to_arc(lambda end: _heated(pitch, beta, gamma, end), _short(beta, gamma, X), X),))


def _short(beta: float, gamma: float, X: float) -> float:
    """A first guess of the end: the cycloid that touches the path at the pitch point."""
    rho = 1 / (beta + gamma)
    return circle_end(rho, min(X, 2 * rho))


def _heated(pitch: Pitch, beta: float, gamma: float, end: float) -> Piece:
    """g = sin psi / S solves 2 S' g + S g' = beta + gamma / cos psi."""

    def f(d: Floats, g: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore"):
            cosine = np.sqrt(1 - (S * g) ** 2)
            slope = 2 * pitch.S_slope(d) - gamma * S**2 * g / cosine**3
            return 2 * pitch.S_slope(d) * g - beta - gamma / cosine, slope

    g = solved(pitch, f, (beta + gamma) / 2, end)
    steep = _slope(pitch, f, g)
    return Sampled(
        lambda d: pitch.S(d) * g(d),
        lambda d: pitch.S_slope(d) * g(d) + pitch.S(d) * steep(d),
        0.0,
        end,
        max(len(g.coefficients), 64),
    )


def bounded_heat(pitch: Pitch, b: float, gamma: float, X: float, psi: float) -> Side:
    """A ray of pressure angle `psi` until the dedendum is as hot as allowed, then uniform heat; finite stress.

    The ray ends where S / S' = sin psi / (b + gamma / cos psi). A ray that never gets so hot is the whole side.
    """
    tangent = sin(psi) / (b + gamma / cos(psi))
    first = atan(tangent) if pitch.bevel else tangent
    if first >= ray_end(psi, X):
        return involute(X, psi)

    def f(d: Floats, v: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore"):
            cosine = np.sqrt(1 - v * v)
            return pitch.S_slope(d) * v - b * S - gamma * S / cosine, pitch.S_slope(d) - gamma * S * v / cosine**3

    def made(end: float) -> Piece:
        return _piece(pitch, f, sin(psi), end, first)

    rest = X - first / cos(psi)
    return Side((Ray(psi, first), _to_arc(made, first + rest * cos(psi), rest)))


def least_friction(pitch: Pitch, b: float, X: float, psi: float, u: float) -> Side:
    """A ray of the greatest pressure angle, then the least speed `u` along the dedendum, so that the loss is least.

    The length of the ray makes the pooled first variation vanish; see the theory page, "Least friction".
    """
    longest = ray_end(psi, X)

    def lifted(first: float) -> Steady:
        def made(end: float) -> Piece:
            return Steady(pitch, b, u, first, sin(psi), end)

        rest = X - first / cos(psi)
        piece = _to_arc(made, first + rest * cos(psi), rest)
        assert isinstance(piece, Steady)
        return piece

    def variation(first: float) -> float:
        return _variation(pitch, lifted(first))

    least, most = 1e-3 * longest, longest * (1 - 1e-6)
    first = root(variation, least, most, variation(least), variation(most))
    return Side((Ray(psi, first), lifted(first)))


def _variation(pitch: Pitch, piece: Steady) -> float:
    """The integral of eta / (S^2 cos psi) (2 S / cos^3 psi - lambda / cos^2 psi) over the lifted piece."""
    x, weights = np.polynomial.legendre.leggauss(64)
    d = piece.start + (piece.end - piece.start) * (x + 1) / 2
    S, sine = pitch.S(d), piece.sin_psi(d)
    cosine = np.sqrt(1 - sine**2)
    last = np.array(piece.end)
    pull = float(pitch.S(last)) / sqrt(1 - float(piece.sin_psi(last)) ** 2)
    return float(weights @ (sine / (S * cosine) * (2 * S / cosine**3 - pull / cosine**2)))
