"""Ways to the last contact of a tooth shape: marching, collocation with given nodes, direct search, the package's."""

from __future__ import annotations

from collections.abc import Callable
from math import asin, cos, sin, sqrt, tan
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial import Chebyshev

from geartrain.teeth.conjugate import optimal_sides as forms
from geartrain.teeth.conjugate.optimal_sides import ValueAndSlope, fitted, solved
from studies.shape_cases import ShapeCase

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

    Bend = Callable[[float, float], float]

_U = 0.15
_INWARDS = (0.3, 0.1, 0.03, 0.01, 0.003, 0.001)


def packaged(case: ShapeCase) -> float:
    """As the package solves it."""
    pitch, X = case.pitch, case.X
    if case.kind == "stress":
        side = forms.uniform_stress(pitch, pitch.A, pitch.B, X, case.amount)
    elif case.kind == "heat":
        side = forms.uniform_heat(pitch, pitch.B, case.gamma, X)
    else:
        side = forms.least_friction(pitch, pitch.B, X, case.amount, _U)
    return side.end


def nodes_of(case: ShapeCase) -> int:
    """How many nodes the package takes."""
    return len(solved(case.pitch, *_transmission(case), case.end).coef)


def _transmission(case: ShapeCase) -> tuple[ValueAndSlope, float]:
    """The equation of a criterion, and what its solution starts with."""
    pitch = case.pitch
    if case.kind == "stress":
        return forms.stress_law(pitch, pitch.A, pitch.B, case.amount), sin(case.amount)
    return forms.heat_law(pitch, pitch.B, case.gamma), (pitch.B + case.gamma) / 2


def _bend(case: ShapeCase) -> Bend:
    """w(d, psi) of a criterion, in plain floats."""
    A, B, S = case.pitch.A, case.pitch.B, sin if case.pitch.bevel else float
    if case.kind == "stress":
        k = sin(case.amount) * cos(case.amount)
        return lambda d, psi: ((B - A) * S(d) + sqrt(((A + B) * S(d)) ** 2 + 4 * k * tan(psi))) / 2
    if case.kind == "heat":
        gamma = case.gamma
        return lambda d, psi: B * S(d) + gamma * S(d) / cos(psi)
    return lambda d, psi: _U + B * S(d)


def _rates(case: ShapeCase) -> Callable[[float, Any], list[float]]:
    """d' = cos psi, psi' = (w - S' sin psi) / S over X."""
    w = _bend(case)
    S, slope = (sin, cos) if case.pitch.bevel else (float, lambda _: 1.0)

    def rates(_: float, state: Any) -> list[float]:
        d, psi = float(state[0]), float(state[1])
        return [cos(psi), (w(d, psi) - slope(d) * sin(psi)) / S(d)]

    return rates


def _begun(case: ShapeCase, start: float) -> tuple[float, list[float]]:
    """X, d and psi beside the pitch point by the series to d^2; for least friction where the ray ends."""
    A, B = case.pitch.A, case.pitch.B
    if case.kind == "friction":
        return case.last / cos(case.amount), [case.last, case.amount]
    if case.kind == "heat":
        d = start * case.X
        tilt = asin((B + case.gamma) / 2 * d)
        return d + ((B + case.gamma) / 2) ** 2 * d**3 / 6, [d, tilt]
    s0, c0 = sin(case.amount), cos(case.amount)
    s1 = (B - A) / 2 / (2 - 1 / (2 * c0**2))
    curved = s0 / 2 * case.pitch.bevel + (A + B) ** 2 / (8 * s0) + s1**2 * (6 * s0**2 - 1) / (8 * s0 * c0**4)
    s2 = curved / (3 - 1 / (2 * c0**2))
    d = start * case.X * c0
    second = s0 * s2 / c0**3 + s1**2 * (1 + 2 * s0**2) / (2 * c0**5)
    return d / c0 + s0 * s1 * d**2 / (2 * c0**3) + second * d**3 / 3, [d, asin(s0 + s1 * d + s2 * d**2)]


def _solver() -> Any:
    from scipy.integrate import solve_ivp

    return solve_ivp


def marched(case: ShapeCase, method: str, tolerance: float, start: float) -> float:
    """By one of scipy's integrators over X, from `start` of the arc to its end."""
    solve_ivp = _solver()
    X, state = _begun(case, start)
    small = tolerance * 1e-2 * state[0]
    with np.errstate(all="ignore"):
        found = solve_ivp(_rates(case), (X, case.X), state, method=method, rtol=max(tolerance, 3e-14), atol=small)
    return float(found.y[0, -1]) if found.success else float("nan")


def collocated(case: ShapeCase, nodes: int) -> float:
    """Collocation with a number of nodes, travel by Gauss's rule; its end by Newton's method."""
    pitch = case.pitch
    transmission, first = _transmission(case)
    x, weights = np.polynomial.legendre.leggauss(nodes + 8)
    end, before = 0.94 * case.X, None
    for _ in range(12):
        v: Chebyshev = fitted(pitch, transmission, first, end, 0.0, nodes, before)
        before = v

        def sine(d: Floats, v: Chebyshev = v) -> Floats:
            found: Floats = v(d) * (pitch.S(d) if case.kind == "heat" else 1.0)
            return found

        travelled = float(weights @ (1 / np.sqrt(1 - sine(end * (x + 1) / 2) ** 2))) * end / 2
        step = (travelled - case.X) * sqrt(1 - float(sine(np.array(end))) ** 2)
        end -= step
        if abs(step) < 1e-9 * end:
            break
    return end


def searched(case: ShapeCase, cells: int) -> float:
    """Least friction without theory: the best speed w in each of `cells` cells of X, by sequential quadratic programs.

    Variables are eta at the ends of the cells; U = w - B S >= u and psi <= psi_hi are held at the cells' middles.
    """
    from scipy import optimize

    minimize: Any = optimize.minimize
    h, top = case.X / cells, sin(case.amount)
    S = case.pitch.S
    B = case.pitch.B

    def path(sines: Floats) -> Floats:
        steps = h * np.sqrt(1 - sines**2)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def loss(sines: Floats) -> float:
        d = path(sines)
        return float((S((d[1:] + d[:-1]) / 2) / np.sqrt(1 - sines**2)).sum() * h)

    def room(sines: Floats) -> Floats:
        d = path(sines)
        middle = (d[1:] + d[:-1]) / 2
        eta = S(middle) * sines
        found: Floats = np.diff(eta) / np.diff(middle) - _U - B * S(d[1:-1])
        return found

    first = np.linspace(top, top / 2, cells)
    found = minimize(
        loss, first, method="SLSQP", bounds=[(0.0, top)] * cells, constraints={"type": "ineq", "fun": room},
        options={"maxiter": 60, "ftol": 1e-10},
    )  # fmt: skip
    return float(path(found.x)[-1])
