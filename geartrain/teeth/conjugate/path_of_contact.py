"""Path of contact of a gear pair: its pieces, the two sides, and the contact quantities of both gears along it.

The pieces of one side, approach or recess, follow each other in order of the distance d >= 0 from the pitch point.
Each piece is a function of d that gives the pressure angle.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, inf, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.chebyshev import ChebyshevSeries
from geartrain.numerics.results import Shown
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


class PathPiece(ABC):
    """Piece of a path of contact: sin psi as a function of the distance d from the pitch point, from `start` to `end`.

    Methods take and return arrays.
    """

    start: float
    end: float

    @abstractmethod
    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the pressure angle at distances d."""

    @abstractmethod
    def slope(self, d: Floats) -> Floats:
        """Return the derivative of sin psi with respect to d, which equals d(psi)/dX."""

    @abstractmethod
    def travel(self, d: Floats) -> Floats:
        """Return the arc X from `start` to d: the integral of 1/cos psi, docs/shapes.md (1)."""


class RayPiece(PathPiece):
    """Straight piece of constant pressure angle: the path of contact of an involute."""

    def __init__(self, psi: float, end: float, start: float = 0.0) -> None:
        self.psi, self.start, self.end = psi, start, end

    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the constant pressure angle."""
        return np.full(np.shape(d), sin(self.psi))

    def slope(self, d: Floats) -> Floats:
        """Return the derivative of sin psi with respect to d, which is zero."""
        return np.zeros(np.shape(d))

    def travel(self, d: Floats) -> Floats:
        """Return the arc X from `start` to d: (d - start) / cos psi."""
        return (np.asarray(d) - self.start) / cos(self.psi)


class CirclePiece(PathPiece):
    """Circle through the pitch point, centred on the line of centres: the path of contact of a spur pair of cycloids.

    d = 2 rho sin psi and X = 2 rho psi, where `rho` is the radius of the rolling circle (modules).
    """

    def __init__(self, rho: float, end: float) -> None:
        self.rho, self.start, self.end = rho, 0.0, end

    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the pressure angle: d / (2 rho)."""
        return np.asarray(d) / (2 * self.rho)

    def slope(self, d: Floats) -> Floats:
        """Return the derivative of sin psi with respect to d, the constant 1 / (2 rho)."""
        return np.full(np.shape(d), 1 / (2 * self.rho))

    def travel(self, d: Floats) -> Floats:
        """Return the arc X from the pitch point to d: 2 rho psi."""
        return 2 * self.rho * np.arcsin(np.asarray(d) / (2 * self.rho))


class SampledPiece(PathPiece):
    """Piece of a path of contact whose sin psi is a given function; X is an integrated Chebyshev series of 1 / cos
    psi.
    """

    def __init__(
        self,
        sin_psi: Callable[[Floats], Floats],
        slope: Callable[[Floats], Floats],
        start: float,
        end: float,
        nodes: int = 64,
    ) -> None:
        self._sin, self._slope, self.start, self.end = sin_psi, slope, start, end
        self._travel = ChebyshevSeries.of(lambda d: 1 / np.sqrt(1 - sin_psi(d) ** 2), start, end, nodes).integral()

    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the pressure angle at d from the given function."""
        return self._sin(d)

    def slope(self, d: Floats) -> Floats:
        """Return the derivative of sin psi with respect to d from the given function."""
        return self._slope(d)

    def travel(self, d: Floats) -> Floats:
        """Return the arc X from `start` to d from the integrated Chebyshev series."""
        return self._travel(d)


class SteadySpeedPiece(SampledPiece):
    """Piece of constant contact speed u along the dedendum: w - b S = u, so that sin psi = eta / S in closed form.

    By docs/shapes.md (12), eta = S(start) sin psi(start) + u (d - start) + b (integral of S). b is the curvature of the
    pitch surface of the gear whose dedendum works.
    """

    def __init__(self, pitch: PitchSurfaces, b: float, u: float, start: float, sin_start: float, end: float) -> None:
        first = float(pitch.S(start)) * sin_start
        below = float(pitch.S_integral(start))

        def sine(d: Floats) -> Floats:
            return (first + u * (d - start) + b * (pitch.S_integral(d) - below)) / pitch.S(d)

        def slope(d: Floats) -> Floats:
            S = pitch.S(d)
            found: Floats = (u + b * S - pitch.S_slope(d) * sine(d)) / S
            return found

        super().__init__(sine, slope, start, end)


def ray_end(psi: float, X: float) -> float:
    """Return the distance d at which a ray of pressure angle `psi` has the arc X."""
    return X * cos(psi)


def circle_end(rho: float, X: float) -> float:
    """Return the distance d at which a rolling circle of radius `rho` has the arc X."""
    return 2 * rho * sin(X / (2 * rho))


@dataclass(frozen=True)
class PathSide:
    """One side of a path of contact: consecutive pieces from the pitch point, or from the first contact, outwards.

    If a side begins beyond the pitch point, its X is counted from its first contact.
    """

    pieces: Sequence[PathPiece]

    @property
    def start(self) -> float:
        """Distance d of the first contact from the pitch point [module]; 0 unless the path does not reach the pitch
        point.
        """
        return self.pieces[0].start

    @property
    def end(self) -> float:
        """Distance d of the last contact from the pitch point [module]."""
        return self.pieces[-1].end

    @cached_property
    def arc(self) -> float:
        """Arc X of the whole side [module]."""
        return float(self.travel(np.array(self.end)))

    @property
    def joints(self) -> tuple[float, ...]:
        """Distances d from the pitch point at which the pieces end [module]."""
        return tuple(piece.end for piece in self.pieces)

    def sin_psi(self, d: Floats) -> Floats:
        """Return the sine of the pressure angle at distances d in [start, end]."""
        return self._by_piece(d, lambda piece, at: piece.sin_psi(at))

    def slope(self, d: Floats) -> Floats:
        """Return the derivative of sin psi with respect to d."""
        return self._by_piece(d, lambda piece, at: piece.slope(at))

    def travel(self, d: Floats) -> Floats:
        """Return the arc X from `start` to d."""
        return self._by_piece(d, lambda piece, at: self._offsets[id(piece)] + piece.travel(at))

    @cached_property
    def _offsets(self) -> dict[int, float]:
        """Arc X at the start of each piece, with the `id` of the piece as key."""
        total, starts = 0.0, {}
        for piece in self.pieces:
            starts[id(piece)] = total
            total += float(piece.travel(np.array(piece.end)))
        return starts

    def distance(self, X: Floats) -> Floats:
        """Return the distance d at the arc X, by Newton's method with dd/dX = cos psi."""
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

    def _by_piece(self, d: Floats, evaluate: Callable[[PathPiece, Floats], Floats]) -> Floats:
        d = np.asarray(d, dtype=float)
        if len(self.pieces) == 1:
            return evaluate(self.pieces[0], d)
        found = np.empty(d.shape)
        which = np.clip(np.searchsorted(self.joints[:-1], d, side="right"), 0, len(self.pieces) - 1)
        for at, piece in enumerate(self.pieces):
            here = which == at
            if here.any():
                found[here] = evaluate(piece, d[here])
        return found


def none(psi: float) -> PathSide:
    """Return a side without contact, for a path that begins or ends at the pitch point with pressure angle `psi`
    [rad].
    """
    return PathSide((RayPiece(psi, 0.0),))


# ------------------------------------------------------------------------------------------------------- the whole path


@dataclass(frozen=True)
class PathContact(Shown):
    """Geometry, speeds, stress and heat of the contact at given pitch-line displacements X. All arrays have the same
    shape; X < 0 is in approach, X > 0 in recess.

    See Also
    --------
    PathOfContact.at : Method that computes the contact quantities.
    """

    X: Floats
    """Arc along the pitch surfaces from the pitch point [module; rad for bevel gears]."""
    d: Floats
    """Signed distance of the contact from the pitch point [module; rad for bevel gears]."""
    sin_psi: Floats
    """Sine of the pressure angle psi."""
    cos_psi: Floats
    """Cosine of the pressure angle psi."""
    q: Floats
    """Derivative d(psi)/dX of the pressure angle [rad per module]."""
    w: Floats
    """Derivative d(S sin psi)/dd, where S is d, or sin d for bevel gears."""
    U1: Floats
    """Speed of the contact point along the profile of gear 1, divided by the pitch-line speed."""
    U2: Floats
    """Speed of the contact point along the profile of gear 2, divided by the pitch-line speed."""
    k1: Floats
    """Curvature of the profile of gear 1 [1/module]; positive where the profile is convex. For bevel gears, the
    geodesic curvature on the sphere.
    """
    k2: Floats
    """Curvature of the profile of gear 2 [1/module]; negative where the profile is convex. For bevel gears, the
    geodesic curvature on the sphere.
    """
    kr: Floats
    """Relative curvature k1 - k2 of the two profiles [1/module]."""
    H: Floats
    """Ratio kr / cos psi. The Hertzian pressure is proportional to the square root of this ratio."""
    Q1: Floats
    """Frictional heat per area of the profile of gear 1, divided by friction coefficient times tangential force."""
    Q2: Floats
    """Frictional heat per area of the profile of gear 2, divided by friction coefficient times tangential force."""
    flash: Floats
    """Quantity F_n^(3/4) kr^(1/4) |sqrt U1 - sqrt U2|. Blok's flash temperature of equal materials is proportional to
    it.
    """
    rub: Floats
    """Ratio |S| / cos psi, where S is d, or sin d for bevel gears. The friction loss is proportional to its integral
    over X.
    """

    @property
    def psi(self) -> Floats:
        """Pressure angle at the contact [rad]."""
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
        """Arcs X of approach and recess in which the teeth touch [module]. One of them may be negative."""
        return (self.approach.arc, self.recess.arc) if self.real is None else self.real

    def span(self, recess: bool, low: float = -inf, high: float = inf) -> tuple[float, float] | None:
        """Return the range of distances d in which the teeth touch on one side; None if the teeth do not touch on that
        side.

        Parameters
        ----------
        recess : bool
            True for the recess side, False for the approach side.
        low, high : float
            Bounds of X.
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

    @property
    def contact_ratio(self) -> float:
        """Contact ratio: arc of contact divided by pitch.

        The value is negative if the teeth do not reach each other.
        """
        return sum(self.arcs) / self.pitch.p

    def ends(self, gear: int) -> tuple[float, float]:
        """Return the arcs X at which the root end and the tip of a gear's flank are in contact [module].

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
        """Return the contact quantities at given pitch-line displacements X.

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
        """Return the contact quantities at given distances d from the pitch point.

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
        """Compute contact speeds and curvatures, docs/shapes.md (2) to (5).

        U1 = w + A S, U2 = w - B S; k_i = T_i / U_i; kr = (A + B) sin psi / (U1 U2).
        """
        pitch = self.pitch
        A, B = pitch.A, pitch.B
        S, slope = pitch.S(d), pitch.S_slope(d)
        # rounding may make a sine exceed 1 where the pressure angle is a right angle
        cosine = np.sqrt(np.maximum(1 - sine * sine, 0.0))
        w = slope * sine + S * q
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
        """Return the points of one gear's profile that are in contact at the arcs X, in the gear's position at X = 0.

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
