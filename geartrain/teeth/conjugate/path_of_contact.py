"""Path of contact of a gear pair: its pieces, the two sides, and the contact quantities of both gears along it.

The pieces of one side, approach or recess, follow each other in order of the distance d >= 0 from the pitch point.
Each piece is a function of d that gives the pressure angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, inf, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.chebyshev import points, series_through
from geartrain.numerics.results import Shown
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats, Indices

    Curve = Callable[[Floats], Floats]


@dataclass(frozen=True)
class PathPiece:
    """Piece of a path of contact, which extends from the distance `start` to the distance `end` from the pitch point.

    Its three functions return arrays of the pressure angle's sine, its derivative, and the arc at given distances.
    """

    start: float
    end: float
    sin_psi: Curve
    """Function that returns the sine of the pressure angle psi at distances d from the pitch point."""
    slope: Curve
    """Function that returns the derivative of sin psi with respect to the distance d. The derivative equals d(psi)/dX,
    where X is the arc along the pitch surfaces.
    """
    travel: Curve
    """Function that returns the arc X along the pitch surfaces between the distances `start` and d: the integral of
    1/cos psi, docs/shapes.md (1).
    """


def ray(psi: float, end: float) -> PathPiece:
    """Return the piece of a path of contact with a constant pressure angle `psi` [rad], which extends to the distance
    `end` from the pitch point. An involute has such a path.
    """
    return PathPiece(
        0.0,
        end,
        lambda d: np.full(np.shape(d), sin(psi)),
        lambda d: np.zeros(np.shape(d)),
        lambda d: np.asarray(d) / cos(psi),
    )


def sampled(sin_psi: Curve, slope: Curve, start: float, end: float, nodes: int = 64) -> PathPiece:
    """Return the piece of a path of contact, from the distance `start` to `end`, on which the sine of the pressure
    angle psi is the function `sin_psi` of the distance from the pitch point, with the derivative `slope`. The arc on
    the pitch surfaces is computed as an integrated Chebyshev series of 1 / cos psi with at least `nodes` nodes.
    """
    d = start + (end - start) * (points(nodes)[0] + 1) / 2
    travel = series_through(1 / np.sqrt(1 - sin_psi(d) ** 2), start, end).integ(lbnd=start)
    return PathPiece(start, end, sin_psi, slope, travel)


def steady_speed(pitch: PitchSurfaces, b: float, u: float, start: float, sin_start: float, end: float) -> PathPiece:
    """Return the piece of a path of contact, from the distance `start` to the distance `end` from the pitch point, on
    which the contact speed along the dedendum, divided by the pitch-line speed, has the constant value `u`.

    By docs/shapes.md (12), the sine of the pressure angle at the distance d is eta / S, with eta = S(start) sin_start +
    u (d - start) + b (integral of S). S is d, or sin d for bevel gears, and b is the curvature of the pitch surface of
    the gear whose dedendum is in contact.
    """
    first, below = float(pitch.S(start)) * sin_start, float(pitch.S_integral(start))

    def sine(d: Floats) -> Floats:
        return (first + u * (d - start) + b * (pitch.S_integral(d) - below)) / pitch.S(d)

    def slope(d: Floats) -> Floats:
        S = pitch.S(d)
        found: Floats = (u + b * S - pitch.S_slope(d) * sine(d)) / S
        return found

    return sampled(sine, slope, start, end)


@dataclass(frozen=True)
class PathSide:
    """One side (approach or recess) of a path of contact: consecutive pieces from the pitch point, or from the first
    contact, outwards.

    If the side does not reach the pitch point, the arc X is measured from the contact closest to the pitch point.
    """

    pieces: Sequence[PathPiece]

    @property
    def start(self) -> float:
        """Distance of the innermost contact from the pitch point [module]; 0 if the side begins at the pitch point."""
        return self.pieces[0].start

    @property
    def end(self) -> float:
        """Distance of the outermost contact from the pitch point [module]."""
        return self.pieces[-1].end

    @cached_property
    def arc(self) -> float:
        """Arc X on the pitch surfaces by which the gears turn while the contact moves along the whole side [module]."""
        return float(self.travel(np.array(self.end)))

    @property
    def joints(self) -> tuple[float, ...]:
        """Distances d from the pitch point at which the pieces of the side end [module]."""
        return tuple(piece.end for piece in self.pieces)

    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the pressure angle at distances d from the pitch point, from `start` to `end`."""
        return self._by_piece(d, [piece.sin_psi for piece in self.pieces])

    def slope(self, d: Floats) -> Floats:
        """Return the derivative of the sine of the pressure angle with respect to the distance d [1/module]."""
        return self._by_piece(d, [piece.slope for piece in self.pieces])

    def travel(self, d: Floats) -> Floats:
        """Return the arc on the pitch surfaces [module] by which gears turn while the contact moves to distance d."""
        found: Floats = self._offsets[self._which(d)] + self._by_piece(d, [piece.travel for piece in self.pieces])
        return found

    @cached_property
    def _offsets(self) -> Floats:
        """Arcs X on the pitch surfaces by which the gears have turned when the contact enters each piece [module]."""
        return np.cumsum([0.0, *(float(piece.travel(np.array(piece.end))) for piece in self.pieces[:-1])])

    def _which(self, d: Floats) -> Indices:
        """Return the index of the piece that contains the contact at each distance d from the pitch point; where two
        pieces meet, the index of the outer piece.
        """
        return np.searchsorted(self.joints[:-1], d, side="right")

    def distance(self, X: Floats) -> Floats:
        """Return the distance of the contact from the pitch point when the gears have turned by the arc X on the pitch
        surfaces [module]. Newton's method is used.
        """
        X = np.asarray(X, dtype=float)
        arc = self.arc
        d = self.start + (np.clip(X / arc, 0.0, 1.0) * (self.end - self.start) if arc else np.zeros(X.shape))
        # convergence is quadratic except at sharp bends; clipped, as a series is invalid beyond its end
        for _ in range(40):
            step = (self.travel(d) - X) * np.sqrt(np.maximum(1 - self.sin_psi(d) ** 2, 0.0))
            d = np.clip(d - step, self.start, self.end)
            # two rounding errors of the maximum distance
            if np.abs(step).max(initial=0.0) <= 4e-16 * self.end:
                break
        return d

    def _by_piece(self, d: Floats, curves: Sequence[Curve]) -> Floats:
        # a curve is evaluated on its own piece only, since its formula may be invalid beyond
        d, which = np.asarray(d, dtype=float), self._which(d)
        return np.piecewise(d, [which == at for at in range(len(curves))], list(curves))


# ------------------------------------------------------------------------------------------------------- the whole path


@dataclass(frozen=True)
class PathContact(Shown):
    """Geometry, speeds, stress and heat of the contacts at given displacements X of the pitch line. All arrays have the
    same shape. Contacts with X < 0 are in approach, contacts with X > 0 in recess.
    """

    X: Floats
    """Arc along the pitch surfaces from the pitch point [module; rad for bevel gears]."""
    d: Floats
    """Signed distance of the contact from the pitch point [module; rad for bevel gears]."""
    sin_psi: Floats
    """Sines of the pressure angle psi."""
    cos_psi: Floats
    """Cosines of the pressure angle psi."""
    q: Floats
    """Derivative d(psi)/dX of the pressure angle psi with respect to the arc X [rad per module]."""
    w: Floats
    """Derivative of S sin psi with respect to the distance d, where S is d, or sin d for bevel gears."""
    U1: Floats
    """Speed of the contact point along the profile of gear 1, divided by the pitch-line speed."""
    U2: Floats
    """Speed of the contact point along the profile of gear 2, divided by the pitch-line speed."""
    k1: Floats
    """Curvature of the profile of gear 1 [1/module], positive where the profile is convex. For bevel gears, it is the
    geodesic curvature on the sphere.
    """
    k2: Floats
    """Curvature of the profile of gear 2 [1/module], negative where the profile is convex. For bevel gears, it is the
    geodesic curvature on the sphere.
    """
    kr: Floats
    """Relative curvature k1 - k2 of the two profiles [1/module]."""
    H: Floats
    """Relative curvature `kr` divided by cos psi; the Hertzian pressure is proportional to its square root."""
    Q1: Floats
    """Frictional heat per unit area of the profile of gear 1, divided by friction coefficient and tangential force."""
    Q2: Floats
    """Frictional heat per unit area of the profile of gear 2, divided by friction coefficient and tangential force."""
    flash: Floats
    """Quantity F_n^(3/4) kr^(1/4) |sqrt U1 - sqrt U2|, where F_n is the normal force at unit tangential force. Blok's
    flash temperature of equal materials is proportional to this quantity.
    """
    rub: Floats
    """Ratio |S| / cos psi, where S is d, or sin d for bevel gears. The friction loss is proportional to the integral of
    this ratio over X.
    """

    @property
    def psi(self) -> Floats:
        """Pressure angles at the contacts [rad]."""
        found: Floats = np.arctan2(self.sin_psi, self.cos_psi)
        return found


@dataclass(frozen=True)
class PathOfContact(Shown):
    """Path of contact of a pair, with an approach side and a recess side. Lengths are in modules, or in rad for bevel
    gears.

    See Also
    --------
    geartrain.teeth.Involute : Like every conjugate form, it has a method `path` that returns such a path.

    Examples
    --------
    >>> from geartrain.teeth import UniformStress
    >>> path = UniformStress(form="uniform_stress").path(24, 36)
    >>> stress = path.at([-1.0, 0.5, 1.0]).H
    >>> round(path.contact_ratio, 12), bool(abs(stress / stress[0] - 1).max() < 1e-9)
    (1.0, True)
    """

    pitch: PitchSurfaces
    """Pitch surfaces of both gears: cylinders, or cones for bevel gears."""
    approach: PathSide
    """Approach side: the part of the path before the pitch point."""
    recess: PathSide
    """Recess side: the part of the path after the pitch point."""
    real: tuple[float, float] | None = None
    """Arcs X of approach and recess in which the teeth touch [module], if these arcs are shorter than the two sides.

    One of the arcs is negative if contact begins or ends beyond the pitch point. The field is None if the teeth touch
    along the whole length of both sides.
    """

    @cached_property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess on the pitch surfaces [module] in which the teeth touch. One may be negative."""
        return (self.approach.arc, self.recess.arc) if self.real is None else self.real

    @property
    def pitches(self) -> tuple[float, float]:
        """Arcs of approach and recess in which the teeth touch [pitch]. One of the two arcs may be negative."""
        approach, recess = self.arcs
        return approach / self.pitch.p, recess / self.pitch.p

    @property
    def joints(self) -> list[float]:
        """Arcs X on the pitch surfaces at which the contact passes from one piece to the next or leaves the last piece
        [module]; negative in approach.
        """
        sides = ((-1.0, self.approach), (1.0, self.recess))
        return [sign * float(side.travel(np.array(d))) for sign, side in sides for d in side.joints]

    def span(self, recess: bool, low: float = -inf, high: float = inf) -> tuple[float, float] | None:
        """Return the range of distances from the pitch point at which the teeth touch on one side of the path; None if
        they do not touch on that side.

        Parameters
        ----------
        recess : bool
            True for the recess side, False for the approach side.
        low, high : float
            Bounds of the arc X on the pitch surfaces [module].
        """
        first, last = max(-self.arcs[0], low), min(self.arcs[1], high)
        near, far = (first, last) if recess else (-last, -first)
        side = self.recess if recess else self.approach
        if far <= max(near, 0.0) or side.arc == 0:
            return None
        start = side.start if near <= 0 else float(side.distance(np.array(near)))
        # a complete side ends exactly at its end, without the rounding of an inversion
        end = side.end if far >= side.arc else float(side.distance(np.array(far)))
        return (start, end) if end > start else None

    def legs(self, low: float = -inf, high: float = inf) -> Iterator[tuple[bool, PathPiece, float, float]]:
        """Yield each piece of the path on which the teeth touch, with its side and with the first and last distance of
        contact from the pitch point.

        Parameters
        ----------
        low, high : float
            Bounds of the arc X on the pitch surfaces [module].

        Yields
        ------
        tuple
            True for the recess side, piece, and first and last distance d of contact on the piece.
        """
        for recess, side in ((False, self.approach), (True, self.recess)):
            start, end = self.span(recess, low, high) or (0.0, 0.0)
            for piece in side.pieces:
                first, last = max(piece.start, start), min(piece.end, end)
                if last > first:
                    yield recess, piece, first, last

    @property
    def contact_ratio(self) -> float:
        """Contact ratio: arc of contact divided by pitch.

        The value is negative if the teeth do not reach each other.
        """
        return sum(self.arcs) / self.pitch.p

    def ends(self, gear: int) -> tuple[float, float]:
        """Return the arcs on the pitch surfaces [module], from the pitch point, at which the root end and the tip of a
        gear's flank are in contact. They are negative in approach.

        Parameters
        ----------
        gear : {1, 2}
            Number of the gear.
        """
        approach, recess = self.arcs
        return (-approach, recess) if gear == 1 else (recess, -approach)

    def radii(self, gear: int) -> tuple[float, float]:
        """Return the radii of the active flank of a gear at its beginning (root side) and its end (tip side) [module;
        rad for bevel gears].

        Parameters
        ----------
        gear : {1, 2}
            Number of the gear.
        """
        (low, high), _ = self.pitch.polar(gear, self.flank(gear, np.array(self.ends(gear))))
        return float(low), float(high)

    def at(self, X: ArrayLike) -> PathContact:
        """Return speeds, curvatures, stress and heat of the contacts at given pitch-line displacements X.

        Parameters
        ----------
        X : array_like
            Pitch-line displacements within the arcs, any shape.

        Returns
        -------
        PathContact
            Arrays of the shape of `X`.
        """
        X = np.asarray(X, dtype=float)
        recess = X >= 0
        d = np.empty(X.shape)
        sine, q = np.empty(X.shape), np.empty(X.shape)
        for side, here, sign in ((self.approach, ~recess, -1.0), (self.recess, recess, 1.0)):
            if here.any():
                distance = side.distance(np.abs(X[here]))
                d[here] = sign * distance
                sine[here] = side.sin_psi(distance)
                q[here] = sign * side.slope(distance)
        return self._contact(X, d, sine, q)

    def along(self, d: ArrayLike, recess: bool) -> PathContact:
        """Return speeds, curvatures, stress and heat of the contacts at given distances from the pitch point.

        Parameters
        ----------
        d : array_like
            Distances, 0 or more.
        recess : bool
            True for the recess side, False for the approach side.
        """
        side, sign = (self.recess, 1.0) if recess else (self.approach, -1.0)
        d = np.asarray(d, dtype=float)
        return self._contact(sign * side.travel(d), sign * d, side.sin_psi(d), sign * side.slope(d))

    def _contact(self, X: Floats, d: Floats, sine: Floats, q: Floats) -> PathContact:
        """Return speeds, curvatures, stress and heat of contacts at arcs X on the pitch surfaces and distances d from
        the pitch point, docs/shapes.md (2) to (5). `sine` is the sine of the pressure angle, and `q` the derivative of
        this angle with respect to X.
        """
        pitch = self.pitch
        A, B = pitch.A, pitch.B
        S, slope = pitch.S(d), pitch.S_slope(d)
        # rounding may make a sine exceed 1 where the pressure angle is a right angle
        cosine = np.sqrt(np.maximum(1 - sine * sine, 0.0))
        w = slope * sine + S * q  # derivative of S sin psi with respect to d
        U1, U2 = w + A * S, w - B * S
        bend = S * sine if pitch.bevel else 0.0
        # U is 0 at a cusp, with infinite curvature and pressure, and negative beyond it, where its root is NaN
        with np.errstate(divide="ignore", invalid="ignore"):
            k1, k2 = ((q + A) * slope - bend) / U1, ((q - B) * slope - bend) / U2
            # at the pitch point psi = 0, as for a cycloid, makes U 0 too; the limit of 0/0 is infinite
            kr = np.where(sine > 0, (A + B) * sine / (U1 * U2), np.inf)
            H = kr / cosine
            rub = np.abs(S) / cosine
            Q1, Q2 = ((A + B) * rub / U for U in (U1, U2))
            flash = kr**0.25 / cosine**0.75 * np.abs(np.sqrt(U1) - np.sqrt(U2))
        return PathContact(X, d, sine, cosine, q, w, U1, U2, k1, k2, kr, H, Q1, Q2, flash, rub)

    def flank(self, gear: int, X: ArrayLike) -> Floats:
        """Return the points of one gear's profile that are in contact at the arcs X. Coordinates refer to the position
        of the gear at X = 0.

        Parameters
        ----------
        gear : {1, 2}
            Number of the gear.
        X : array_like
            Pitch-line displacements at which the points are in contact.

        Returns
        -------
        ndarray
            Points (..., 2) relative to the pitch point, or (..., 3) on the unit sphere for bevel gears.
        """
        X = np.asarray(X, dtype=float)
        contact = self.at(X)
        return self.pitch.on_gear(gear, self.pitch.point(contact.d, contact.sin_psi, contact.cos_psi), X)
