"""Sides of the optimal tooth forms: uniform stress, uniform temperature and minimum friction; and the involute.

A side (approach or recess) of a path of contact gives the pressure angle psi at the distance d from the pitch point. It
depends on the curvature `a` of the pitch surface of the gear in contact at its addendum, and the curvature `b` of the
pitch surface of the gear in contact at its dedendum: a = A and b = B in recess, exchanged in approach.

Uniform stress and uniform temperature are solutions of S v' + f(d, v) = 0. Here S is d, or sin d for bevel
gears, and v is sin psi or sin psi / S. For pressure angles below 45 deg exactly one solution is bounded at the
pitch point, where S is 0. Chebyshev collocation finds that solution, because polynomials are bounded. Minimum
friction is a ray (constant pressure angle) followed by one piece of minimum contact speed. These two pieces are
optimal under the conditions in docs/shapes.md, section 15.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan, cos, degrees, inf, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.chebyshev import differentiation, points, series_through, tail
from geartrain.numerics.roots import root
from geartrain.teeth.conjugate.path_of_contact import PathPiece, PathSide, ray, sampled, steady_speed

if TYPE_CHECKING:
    from numpy.polynomial import Chebyshev

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

    Weight = Callable[[Floats], Floats]
    PieceMaker = Callable[[PitchSurfaces, "ValueAndSlope", Chebyshev, float], PathPiece]

ValueAndSlope = Callable[["Floats", "Floats"], "tuple[Floats, Floats]"]

_NODES = (24, 48, 96, 192)  # doubled until the last coefficients are small
_FALLEN = 1e-14  # fraction of the largest coefficient: smaller values are rounding error
_UNFINISHED = 1e-5  # upper bound of the last coefficients at the maximum number of nodes; exceeded above about 84 deg
_STEPS = 25  # maximum number of Newton steps
_ROUGH = 1e-9  # residuals below this are rounding error
_CHECKED, _SLACK = 400, 1e-6  # points at which the conditions are checked, and tolerance of their rounding
_NEAR = 0.05  # fraction of a side: closer to the pitch point slopes are taken from the series
# 16 nodes give rounding on usual sides; many more for pressure angles near a right angle
_GAUSS = np.polynomial.legendre.leggauss(64)
_TRIES = 60  # maximum number of solved ends
_GIVEN_UP = 1e-4  # fraction of the end: resolution at which an end counts as unreachable


def involute(X: float, psi: float) -> PathSide:
    """Return one side of the path of contact of an involute, with a constant pressure angle `psi` [rad] and an arc of
    length X on the pitch surfaces.

    If X is 0, the path of contact begins or ends at the pitch point.
    """
    return PathSide((ray(psi, X * cos(psi)),))


def uniform_stress(pitch: PitchSurfaces, a: float, b: float, X: float, psi: float) -> PathSide:
    """Return one side of a path of contact with constant Hertzian pressure and an arc of length X on the pitch
    surfaces.

    The relative curvature of the profiles divided by cos psi is then constant, where psi is the pressure angle. `a` and
    `b` are the curvatures of the pitch surfaces of the gears in contact at their addendum and at their dedendum; the
    parameter `psi` is the value psi0 at the pitch point [rad]. With the distance d from the pitch point and S = d, or
    sin d on cones, the derivative of S sin psi with respect to d is ((b - a) S + sqrt((a + b)^2 S^2 + 4 k tan psi)) /
    2, where k = sin psi0 cos psi0.
    """
    return PathSide((_piece_over_arc(_solutions(pitch, stress_law(pitch, a, b, psi), sin(psi)), X * cos(psi), X),))


def stress_law(pitch: PitchSurfaces, a: float, b: float, psi: float) -> ValueAndSlope:
    """Return the function f of the differential equation of uniform stress, S v' + f(d, v) = 0. Here v is the sine of
    the pressure angle at the distance d from the pitch point, and S is d, or sin d on cones.

    The function returns f and df/dv, docs/shapes.md (8). `a`, `b` and `psi` have the meaning as in `uniform_stress`.
    """
    k = sin(psi) * cos(psi)

    def f(d: Floats, v: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore", divide="ignore"):  # NaN beyond |v| = 1 makes Newton's method halve its step
            cosine = np.sqrt(1 - v * v)
            under = np.sqrt(((a + b) * S) ** 2 + 4 * k * v / cosine)
            w = ((b - a) * S + under) / 2
            return pitch.S_slope(d) * v - w, pitch.S_slope(d) - k / (under * cosine**3)

    return f


def _piece_over_arc(made: Callable[[float], PathPiece], guess: float, X: float, start: float = 0.0) -> PathPiece:
    """Return the piece of a path of contact that ends at the arc X on the pitch surfaces. `made` returns the piece from
    the distance `start` to any other distance. The distance of the end is found by Newton's method from `guess`;
    distances that cannot be reached are bisected towards the last one that was reached.
    """
    low, end, last = start, guess, inf
    for _ in range(_TRIES):
        try:
            piece = made(end)
        except RangeError:
            if end - low < _GIVEN_UP * end:
                raise
            end = (low + end) / 2
            continue
        # the derivative of the arc is 1 / cos psi
        step = (float(piece.travel(np.array(end))) - X) * sqrt(1 - float(piece.sin_psi(np.array(end))) ** 2)
        # rounding error, or nearly so once steps no longer decrease
        if abs(step) <= 4e-16 * end or (abs(step) < 1e-12 * end and abs(step) >= last):
            return piece
        low, end, last = end, end - step, abs(step)
    raise unreachable_end(end)


def _solutions(
    pitch: PitchSurfaces, f: ValueAndSlope, first: float, start: float = 0.0, piece_maker: PieceMaker | None = None
) -> Callable[[float], PathPiece]:
    """Return a function that solves S v' + f(d, v) = 0 from the distance `start` to a given distance from the pitch
    point, with v = `first` at `start`, and returns a piece of a path of contact. S is the distance d, or sin d on
    cones. Each solution is the initial guess of the next solution.
    """
    last: Chebyshev | None = None

    def made(end: float) -> PathPiece:
        nonlocal last
        last = solved(pitch, f, first, end, start, last)
        return (piece_maker or _sine_piece)(pitch, f, last, end)

    return made


def _sine_piece(pitch: PitchSurfaces, f: ValueAndSlope, v: Chebyshev, end: float) -> PathPiece:
    """Return the piece of a path of contact, up to the distance `end` from the pitch point, on which the pressure angle
    psi at the distance d is given by sin psi = v(d). `v` is a solution of the differential equation S v' + f(d, v) = 0.
    """
    return sampled(v, _slope(pitch, f, v), v.domain[0], end, max(len(v.coef), 64))


def _slope(pitch: PitchSurfaces, f: ValueAndSlope, v: Chebyshev) -> Callable[[Floats], Floats]:
    """Return a function for the derivative v' of a solution v of S v' + f(d, v) = 0. Close to the pitch point, where
    the differential equation gives 0/0, the derivative of the Chebyshev series is used.
    """
    steep = v.deriv()

    def slope(d: Floats) -> Floats:
        S = pitch.S(d)
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(d > _NEAR * v.domain[1], -f(d, v(d))[0] / S, steep(d))

    return slope


def uniform_heat(pitch: PitchSurfaces, beta: float, gamma: float, X: float) -> PathSide:
    """Return one side of a path of contact with uniform frictional heat per unit area of a profile, and an arc of
    length X on the pitch surfaces.

    With the distance d from the pitch point and S = d, or sin d on cones, the derivative of S sin psi with respect to d
    is beta S + gamma S / cos psi. The pressure angle psi is 0 at the pitch point. `beta` is the curvature of the pitch
    surface of the hotter profile, as interpreted in docs/shapes.md, and `gamma` is the sum of both curvatures divided
    by the heat.
    """
    f, first = heat_law(pitch, beta, gamma), (beta + gamma) / 2
    # initial guess of the end: the cycloid tangent to the path at the pitch point
    rho = 1 / (beta + gamma)
    guess = 2 * rho * sin(min(X / (2 * rho), 1.0))
    return PathSide((_piece_over_arc(_solutions(pitch, f, first, piece_maker=_quotient_piece), guess, X),))


def heat_law(pitch: PitchSurfaces, beta: float, gamma: float) -> ValueAndSlope:
    """Return the function f of the differential equation of uniform heat, S g' + f(d, g) = 0. Here g is sin psi / S for
    the pressure angle psi at the distance d from the pitch point, and S is d, or sin d on cones.

    The function returns f and df/dg, docs/shapes.md (9). `beta` and `gamma` have the same meaning as in `uniform_heat`.
    """

    def f(d: Floats, g: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore"):
            cosine = np.sqrt(1 - (S * g) ** 2)
            slope = 2 * pitch.S_slope(d) - gamma * S**2 * g / cosine**3
            return 2 * pitch.S_slope(d) * g - beta - gamma / cosine, slope

    return f


def _quotient_piece(pitch: PitchSurfaces, f: ValueAndSlope, g: Chebyshev, end: float) -> PathPiece:
    """Return the piece of a path of contact, up to the distance `end` from the pitch point, on which the pressure angle
    at the distance d has the sine S g(d). S is d, or sin d on cones, and `g` is a solution of S g' + f(d, g) = 0.
    """
    steep = _slope(pitch, f, g)
    return sampled(
        lambda d: pitch.S(d) * g(d),
        lambda d: pitch.S_slope(d) * g(d) + pitch.S(d) * steep(d),
        0.0,
        end,
        max(len(g.coef), 64),
    )


def bounded_heat(pitch: PitchSurfaces, b: float, gamma: float, X: float, psi: float) -> PathSide:
    """Return one side of a path of contact with finite stress: a piece with constant pressure angle `psi` up to the
    permitted heat, then a piece with uniform heat.

    The first piece ends at the distance d from the pitch point where S / S' = sin psi / (b + gamma / cos psi), with S =
    d, or sin d on cones, and its derivative S'. `b` and `gamma` have the meaning of `beta` and `gamma` in
    `uniform_heat`. If the first piece does not reach the permitted heat, it is the whole side.
    """
    tangent = sin(psi) / (b + gamma / cos(psi))
    first = atan(tangent) if pitch.bevel else tangent
    if first >= X * cos(psi):
        return involute(X, psi)

    def f(d: Floats, v: Floats) -> tuple[Floats, Floats]:
        S = pitch.S(d)
        with np.errstate(invalid="ignore"):
            cosine = np.sqrt(1 - v * v)
            return pitch.S_slope(d) * v - b * S - gamma * S / cosine, pitch.S_slope(d) - gamma * S * v / cosine**3

    before = first / cos(psi)
    second = _piece_over_arc(_solutions(pitch, f, sin(psi), first), X * cos(psi), X - before, first)
    return PathSide((ray(psi, first), second))


def least_friction(
    pitch: PitchSurfaces, b: float, X: float, psi: float, u: float, weight: Weight | None = None
) -> PathSide:
    """Return one side of a path of contact with minimum friction loss: first a piece with the maximum pressure angle
    `psi`, then a piece with the minimum contact speed `u` along the dedendum, as a fraction of the pitch-line speed.

    `b` is the curvature of the pitch surface of the gear whose dedendum is in contact. The length of the first piece
    makes the first variation of the loss over the second piece vanish: docs/shapes.md (12) and (13), or (19) if
    friction depends on speed. In this case, `weight` returns the friction loss at distances from the pitch point, up to
    a factor. Raises `RangeError` if the arc X is longer than teeth within both bounds can reach, or if a shape other
    than these two pieces would have less loss.
    """
    loss = pitch.S if weight is None else weight
    longest = X * cos(psi)

    def second_piece(first: float) -> PathPiece:
        return _piece_over_arc(
            lambda end: steady_speed(pitch, b, u, first, sin(psi), end), longest, X - first / cos(psi), first
        )

    def variation(first: float) -> float:
        return _first_variation(pitch, second_piece(first), loss)

    def above(first: float) -> float:
        piece = second_piece(first)
        return float(piece.sin_psi(np.array(piece.end))) - sin(psi)

    # a path below psi does not end before a ray does; the lowest one, eta = u d + b (integral of S), is tested there
    if u * longest + b * float(pitch.S_integral(longest)) > float(pitch.S(longest)) * sin(psi):
        raise _too_long_error(pitch, X, psi, u)
    # the bracket excludes pieces of zero length
    minimum, most = 1e-3 * longest, longest * (1 - 1e-6)
    if weight is not None and variation(minimum) * variation(most) > 0:
        raise other_shape_error("no length of the first piece makes the second one optimal")
    first = root(variation, minimum, most, variation(minimum), variation(most))
    if above(first) > 0:  # the maximum pressure angle is reached before the end; a shorter ray reaches it at the end
        if above(minimum) > 0:
            raise _too_long_error(pitch, X, psi, u)
        first = root(above, minimum, first, above(minimum), above(first))
    elif weight is not None:
        check_pieces(pitch, second_piece(first), weight)
    return PathSide((ray(psi, first), second_piece(first)))


def _too_long_error(pitch: PitchSurfaces, X: float, psi: float, u: float) -> RangeError:
    limits = f"a contact speed margin of {u:g} and a pressure angle of {degrees(psi):.6g} deg"
    what = f"an arc of {X / pitch.p:.6g} pitches is too long for {limits}"
    why = "even at the minimum contact speed, the pressure angle would exceed its maximum before the end of the arc"
    return RangeError(Problem(what, why, "use a shorter arc, more teeth, a smaller margin or a larger pressure angle"))


def _first_variation(pitch: PitchSurfaces, piece: PathPiece, loss: Weight) -> float:
    """Return the first variation of the friction loss over the piece of minimum contact speed, docs/shapes.md (13) or
    (19). `loss` returns the friction loss at distances from the pitch point, up to a factor.
    """
    x, weights = _GAUSS
    d = piece.start + (piece.end - piece.start) * (x + 1) / 2
    return float(weights @ variation_integrand(pitch, piece, d, loss))


# ------------------------------------------------------------------------------------------------ Chebyshev collocation


def solved(
    pitch: PitchSurfaces, f: ValueAndSlope, first: float, end: float, start: float = 0.0, near: Chebyshev | None = None
) -> Chebyshev:
    """Return the solution v(d) of S v' + f(d, v) = 0 on [start, end] with v = `first` at `start`, computed by Chebyshev
    collocation. S is d, or sin d for bevel gears.

    f      function of d, v that returns f and its derivative with respect to v; f(0, first) = 0 makes the solution
           bounded at the pitch point
    near   solution on an interval with another end, used as the initial guess; None if there is none

    The number of nodes is doubled until the last coefficients are below 1e-14 of the largest one. Raises `RangeError`
    if the solution leaves the domain of f, or comes so near to its boundary that the coefficients do not decrease.
    """
    # a constant is the involute (v = sin psi) or the cycloid (g = sin psi / S), from which Newton's method converges
    series = near or series_through(np.full(_NODES[0], first), start, end)
    for nodes in _NODES:
        if near and nodes < len(near.coef):
            continue
        series = fitted(pitch, f, first, end, start, nodes, series)
        if tail(series) < _FALLEN:
            break
    if tail(series) > _UNFINISHED:
        raise unreachable_end(end)
    return series


def fitted(
    pitch: PitchSurfaces,
    f: ValueAndSlope,
    first: float,
    end: float,
    start: float,
    nodes: int,
    near: Chebyshev | None = None,
) -> Chebyshev:
    """Return the solution of the differential equation in `solved`, with the same parameters, for a fixed number of
    Chebyshev nodes. `near` is a solution on another interval, used as the initial guess; None for the constant `first`.
    """
    x, _ = points(nodes)
    d = start + (end - start) * (x + 1) / 2
    # constant beyond its end, where a series soon diverges
    guess = near(np.minimum(d, near.domain[1])) if near else np.full(nodes, first)
    return series_through(_collocated(pitch, f, first, d, guess), start, end)


def _collocated(pitch: PitchSurfaces, f: ValueAndSlope, first: float, d: Floats, v: Floats) -> Floats:
    """Return the solution v of the differential equation in `solved` at the Chebyshev nodes d, with v = `first` at the
    first node, by damped Newton steps from the guess `v`.
    """
    matrix = pitch.S(d)[:, None] * differentiation(len(d)) * (2 / (d[-1] - d[0]))
    # the condition v = first replaces the first row, which is degenerate: S is 0 at the pitch point
    matrix[0] = 0.0

    def residual(v: Floats) -> tuple[Floats, Floats]:
        """Return the residual of the differential equation at each node, and the derivative df/dv at each node (the
        diagonal part of the Jacobian).
        """
        off, slope = f(d, v)
        off[0], slope[0] = v[0] - first, 1.0
        return matrix @ v + off, slope

    left, slope = residual(v)
    for _ in range(_STEPS):
        step = np.linalg.solve(matrix + np.diag(slope), left)
        part, size = 1.0, np.abs(left).max()
        trial, (left, slope) = v - step, residual(v - step)
        # halve a step that leaves the domain of f, or, down to a thousandth, that increases the residual
        while not np.isfinite(left).all() or (np.abs(left).max() > size and part > 1e-3 and size > _ROUGH):
            part /= 2
            # so short a step has no effect: the equation has no solution up to this end
            if part < 1e-9:
                raise unreachable_end(float(d[-1]))
            trial, (left, slope) = v - part * step, residual(v - part * step)
        # stop at rounding error, or where the residual no longer decreases
        done = np.abs(trial - v).max() <= 4e-16 * np.abs(trial).max() or not np.abs(left).max() < size
        v = trial
        if done:
            break
    if not np.abs(left).max() < _ROUGH:
        raise unreachable_end(float(d[-1]))
    return v


def unreachable_end(end: float) -> RangeError:
    """Return the error for a path of contact that cannot extend to the distance `end` from the pitch point."""
    what = f"the path of contact does not reach {end:.6g} (modules; bevel gears: rad) from the pitch point"
    why = "its pressure angle would reach 90 deg before that distance"
    return RangeError(Problem(what, why, "use shorter arcs, more teeth, or a smaller pressure angle"))


# ------------------------------------------------------------------------------------------- conditions of minimum loss


def variation_integrand(pitch: PitchSurfaces, piece: PathPiece, d: Floats, loss: Weight) -> Floats:
    """Return the integrand of the first variation of the friction loss, at distances d from the pitch point.

    The integrand is the additional loss if the path of contact is higher at d, minus the loss saved because the arc on
    the pitch surfaces becomes longer. `loss` returns the friction loss at distances, up to a factor.
    """
    S, sine = pitch.S(d), piece.sin_psi(d)
    cosine = np.sqrt(1 - sine**2)
    last = np.array(piece.end)
    won = float(loss(last)) / sqrt(1 - float(piece.sin_psi(last)) ** 2)
    found: Floats = sine / (S * cosine) * (2 * loss(d) / cosine**3 - won / cosine**2)
    return found


def check_pieces(pitch: PitchSurfaces, piece: PathPiece, weight: Weight) -> None:
    """Raise `RangeError` if a constant pressure angle followed by the given piece of minimum contact speed does not
    minimise the friction loss (conditions in docs/shapes.md, section 15). `weight` returns this loss at distances from
    the pitch point, up to a factor.
    """
    if (np.diff(weight(np.linspace(0.0, piece.end, _CHECKED))) < 0).any():
        raise other_shape_error("the friction loss decreases with increasing sliding velocity at some contacts")
    each = variation_integrand(pitch, piece, np.linspace(piece.start, piece.end, _CHECKED), weight)
    below = np.cumsum((each[1:] + each[:-1]) / 2)
    if below.max() > _SLACK * np.abs(each).sum():
        raise other_shape_error("a path whose pressure angle rises again before its end would have less loss")


def other_shape_error(why: str) -> RangeError:
    """Return the error, with the reason `why`, for a friction law whose teeth of minimum loss are not modelled."""
    shape = "a constant pressure angle and a minimum contact speed"
    what = f"with this friction law, teeth of minimum loss do not consist of {shape}"
    fix = "use another pitch_line_speed, a friction law that falls less steeply, or a smaller pressure angle"
    return RangeError(Problem(what, why, fix))
