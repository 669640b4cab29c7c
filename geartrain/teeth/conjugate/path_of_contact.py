"""A path of contact: pieces, the two sides made of them, and what follows for both gears at every instant.

Pieces of one side, approach or recess, follow each other in order of the distance d >= 0 from the pitch point. Each is
a function of d that gives the pressure angle.
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
    """sin psi as a function of d from `start` to `end`. Arrays in, arrays out; d counts from the pitch point."""

    start: float
    end: float

    @abstractmethod
    def sin_psi(self, d: Floats) -> Floats:
        """Sine of the pressure angle."""

    @abstractmethod
    def slope(self, d: Floats) -> Floats:
        """d(sin psi)/dd, which is also d(psi)/dX."""

    @abstractmethod
    def travel(self, d: Floats) -> Floats:
        """Pitch-line displacement X since `start`: the integral of 1/cos psi, docs/shapes.md (1)."""


class RayPiece(PathPiece):
    """A constant pressure angle: the involute."""

    def __init__(self, psi: float, end: float, start: float = 0.0) -> None:
        self.psi, self.start, self.end = psi, start, end

    def sin_psi(self, d: Floats) -> Floats:
        """sin psi everywhere."""
        return np.full(np.shape(d), sin(self.psi))

    def slope(self, d: Floats) -> Floats:
        """0 everywhere."""
        return np.zeros(np.shape(d))

    def travel(self, d: Floats) -> Floats:
        """(d - start) / cos psi."""
        return (np.asarray(d) - self.start) / cos(self.psi)


class CirclePiece(PathPiece):
    """A circle through the pitch point, centred on the line of centres: the cycloid of a spur pair.

    d = 2 rho sin psi, X = 2 rho psi; `rho` the radius of the rolling circle (modules).
    """

    def __init__(self, rho: float, end: float) -> None:
        self.rho, self.start, self.end = rho, 0.0, end

    def sin_psi(self, d: Floats) -> Floats:
        """d / 2 rho."""
        return np.asarray(d) / (2 * self.rho)

    def slope(self, d: Floats) -> Floats:
        """1 / 2 rho."""
        return np.full(np.shape(d), 1 / (2 * self.rho))

    def travel(self, d: Floats) -> Floats:
        """2 rho psi."""
        return 2 * self.rho * np.arcsin(np.asarray(d) / (2 * self.rho))


class SampledPiece(PathPiece):
    """sin psi given as a function, its travel as a Chebyshev series of 1 / cos psi."""

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
        """As given."""
        return self._sin(d)

    def slope(self, d: Floats) -> Floats:
        """As given."""
        return self._slope(d)

    def travel(self, d: Floats) -> Floats:
        """By the integrated series."""
        return self._travel(d)


class SteadySpeedPiece(SampledPiece):
    """A constant speed of contact along the dedendum: w - b S = u, so that sin psi = eta / S follows in closed form.

    Docs/shapes.md (12): eta = S(start) sin psi(start) + u (d - start) + b (integral of S), b being the coefficient of
    the gear whose dedendum it is.
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
    """Distance d at which a ray has travelled X."""
    return X * cos(psi)


def circle_end(rho: float, X: float) -> float:
    """Distance d at which a cycloid's circle has travelled X."""
    return 2 * rho * sin(X / (2 * rho))


@dataclass(frozen=True)
class PathSide:
    """Pieces that follow each other outwards, from the pitch point or from the first contact beyond it.

    X of a side that begins beyond the pitch point counts from its first contact.
    """

    pieces: Sequence[PathPiece]

    @property
    def start(self) -> float:
        """Distance of the first contact from the pitch point; 0 but for paths that keep off it."""
        return self.pieces[0].start

    @property
    def end(self) -> float:
        """Distance of the last contact from the pitch point."""
        return self.pieces[-1].end

    @cached_property
    def arc(self) -> float:
        """Pitch-line displacement over the whole side."""
        return float(self.travel(np.array(self.end)))

    @property
    def joints(self) -> tuple[float, ...]:
        """Distances at which a piece ends."""
        return tuple(piece.end for piece in self.pieces)

    def sin_psi(self, d: Floats) -> Floats:
        """Sine of the pressure angle at d in [0, end]."""
        return self._by_piece(d, lambda piece, at: piece.sin_psi(at))

    def slope(self, d: Floats) -> Floats:
        """d(sin psi)/dd at d."""
        return self._by_piece(d, lambda piece, at: piece.slope(at))

    def travel(self, d: Floats) -> Floats:
        """X at d, from the pitch point."""
        return self._by_piece(d, lambda piece, at: self._offsets[id(piece)] + piece.travel(at))

    @cached_property
    def _offsets(self) -> dict[int, float]:
        """X at the start of each piece, by the piece's identity."""
        total, starts = 0.0, {}
        for piece in self.pieces:
            starts[id(piece)] = total
            total += float(piece.travel(np.array(piece.end)))
        return starts

    def distance(self, X: Floats) -> Floats:
        """d at X, by Newton's method on dd/dX = cos psi."""
        X = np.asarray(X, dtype=float)
        arc = self.arc
        d = self.start + (np.clip(X / arc, 0.0, 1.0) * (self.end - self.start) if arc else np.zeros(X.shape))
        # quadratic but for sharp bends; clipped, for beyond its end a series means nothing
        for _ in range(40):
            step = (self.travel(d) - X) * np.sqrt(np.maximum(1 - self.sin_psi(d) ** 2, 0.0))
            d = np.clip(d - step, self.start, self.end)
            # two roundings of the greatest distance
            if np.abs(step).max(initial=0.0) <= 4e-16 * self.end:
                break
        return d

    def _by_piece(self, d: Floats, ask: Callable[[PathPiece, Floats], Floats]) -> Floats:
        d = np.asarray(d, dtype=float)
        if len(self.pieces) == 1:
            return ask(self.pieces[0], d)
        found = np.empty(d.shape)
        which = np.clip(np.searchsorted(self.joints[:-1], d, side="right"), 0, len(self.pieces) - 1)
        for at, piece in enumerate(self.pieces):
            here = which == at
            if here.any():
                found[here] = ask(piece, d[here])
        return found


def none(psi: float) -> PathSide:
    """A side without contact: the path begins or ends at the pitch point, under a pressure angle `psi` (rad)."""
    return PathSide((RayPiece(psi, 0.0),))


# ------------------------------------------------------------------------------------------------------- the whole path


@dataclass(frozen=True)
class PathContact(Shown):
    """The contact at pitch-line displacements X: arrays of one shape. X < 0 is approach, X > 0 recess.

    See Also
    --------
    PathOfContact.at : gives it.
    """

    X: Floats
    """Pitch-line displacement [module; rad for bevels]."""
    d: Floats
    """Signed distance from the pitch point [module; rad]."""
    sin_psi: Floats
    """Sine of the pressure angle."""
    cos_psi: Floats
    """Cosine of the pressure angle."""
    q: Floats
    """d(psi)/dX."""
    w: Floats
    """d(S sin psi)/dd."""
    U1: Floats
    """Speed of the contact along the profile of gear 1, over the pitch-line speed."""
    U2: Floats
    """Speed of the contact along the profile of gear 2, over the pitch-line speed."""
    k1: Floats
    """(Geodesic) curvature of the profile of gear 1, which is convex where k1 > 0."""
    k2: Floats
    """(Geodesic) curvature of the profile of gear 2, which is convex where k2 < 0."""
    kr: Floats
    """Relative curvature k1 - k2."""
    H: Floats
    """Kr / cos psi: the Hertz pressure is proportional to its square root."""
    Q1: Floats
    """Frictional heat per area of the profile of gear 1, over friction times tangential force."""
    Q2: Floats
    """Frictional heat per area of the profile of gear 2, over friction times tangential force."""
    flash: Floats
    """F_n^(3/4) kr^(1/4) |sqrt U1 - sqrt U2|, to which Blok's flash temperature of like materials is proportional."""
    rub: Floats
    """|S| / cos psi; the loss is proportional to its integral over X."""

    @property
    def psi(self) -> Floats:
        """Pressure angle (rad)."""
        found: Floats = np.arctan2(self.sin_psi, self.cos_psi)
        return found


@dataclass(frozen=True)
class PathOfContact(Shown):
    """Where contact happens: one side before the pitch point, one after. Lengths in modules; of bevels rad.

    See Also
    --------
    geartrain.teeth.Involute : every conjugate form has a method `path` that gives it.

    Examples
    --------
    >>> from geartrain.teeth import UniformStress
    >>> path = UniformStress(form="uniform_stress").path(24, 36)
    >>> stress = path.at([-1.0, 0.5, 1.0]).H
    >>> round(path.contact_ratio, 12), bool(abs(stress / stress[0] - 1).max() < 1e-9)
    (1.0, True)
    """

    pitch: PitchSurfaces
    """Pitch cylinders or cones of both gears."""
    approach: PathSide
    """The side before the pitch point."""
    recess: PathSide
    """The side after the pitch point."""
    real: tuple[float, float] | None = None
    """Arcs of approach and recess (X) in which the teeth touch, where they are shorter than the sides; one is
    negative where contact begins, or ends, beyond the pitch point. None for the arcs of the sides."""

    @cached_property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and of recess (X) in which the teeth really touch; one may be negative."""
        return (self.approach.arc, self.recess.arc) if self.real is None else self.real

    def span(self, recess: bool, low: float = -inf, high: float = inf) -> tuple[float, float] | None:
        """Distances d on one side between which the teeth touch; None where they do not.

        Parameters
        ----------
        recess : bool
            Which side.
        low, high : float
            Bounds of X.
        """
        first, last = max(-self.arcs[0], low), min(self.arcs[1], high)
        near, far = (first, last) if recess else (-last, -first)
        side = self.recess if recess else self.approach
        if far <= max(near, 0.0) or side.arc == 0:
            return None
        start = side.start if near <= 0 else float(side.distance(np.array(near)))
        # a whole side ends where it says, not where an inversion puts it
        end = side.end if far >= side.arc else float(side.distance(np.array(far)))
        return (start, end) if end > start else None

    @property
    def contact_ratio(self) -> float:
        """Pitches of displacement while one pair touches; below 0 where no contact is in reach."""
        return sum(self.arcs) / self.pitch.p

    def ends(self, gear: int) -> tuple[float, float]:
        """Displacements X at which the root end of a gear's flank touches, and its tip.

        Parameters
        ----------
        gear : {1, 2}
            Which gear.
        """
        approach, recess = self.arcs
        return (-approach, recess) if gear == 1 else (recess, -approach)

    def radii(self, gear: int) -> tuple[float, float]:
        """Radii (modules; half-angles of cones, rad) between which a gear's flank works, root end first.

        Parameters
        ----------
        gear : {1, 2}
            Which gear.
        """
        (low, high), _ = self.pitch.polar(gear, self.flank(gear, np.array(self.ends(gear))))
        return float(low), float(high)

    def at(self, X: ArrayLike) -> PathContact:
        """The contact at given displacements.

        Parameters
        ----------
        X : array_like
            Pitch-line displacements within the arcs, any shape.

        Returns
        -------
        PathContact
            Arrays of that shape.
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
        """The contact at given distances from the pitch point.

        Parameters
        ----------
        d : array_like
            Distances, 0 or more.
        recess : bool
            Which side.
        """
        side, sign = (self.recess, 1.0) if recess else (self.approach, -1.0)
        d = np.asarray(d, dtype=float)
        return self._contact(sign * side.travel(d), sign * d, side.sin_psi(d), sign * side.slope(d))

    def _contact(self, X: Floats, d: Floats, sine: Floats, q: Floats) -> PathContact:
        """Docs/shapes.md (2) to (5): U1 = w + A S, U2 = w - B S; k_i = T_i / U_i; kr = (A + B) sin psi / (U1 U2)."""
        pitch = self.pitch
        A, B = pitch.A, pitch.B
        S, slope = pitch.S(d), pitch.S_slope(d)
        # rounding may put a sine beyond 1 where the pressure angle is a right angle
        cosine = np.sqrt(np.maximum(1 - sine * sine, 0.0))
        w = slope * sine + S * q
        U1, U2 = w + A * S, w - B * S
        bend = S * sine if pitch.bevel else 0.0
        # U is 0 at a cusp, where curvature and pressure are infinite, and below 0 beyond it, where its root is NaN
        with np.errstate(divide="ignore", invalid="ignore"):
            k1, k2 = ((q + A) * slope - bend) / U1, ((q - B) * slope - bend) / U2
            # psi = 0 at the pitch point, as of a cycloid, makes U 0 there too: 0/0, whose limit is infinite
            kr = np.where(sine > 0, (A + B) * sine / (U1 * U2), np.inf)
            H = kr / cosine
            rub = np.abs(S) / cosine
            Q1, Q2 = ((A + B) * rub / U for U in (U1, U2))
            flash = kr**0.25 / cosine**0.75 * np.abs(np.sqrt(U1) - np.sqrt(U2))
        return PathContact(X, d, sine, cosine, q, w, U1, U2, k1, k2, kr, H, Q1, Q2, flash, rub)

    def flank1(self, X: ArrayLike) -> Floats:
        """Points of gear 1's profile in its X = 0 position.

        Parameters
        ----------
        X : array_like
            Displacements at which the points touch.

        Returns
        -------
        ndarray
            (..., 2) from the pitch point, or of bevels (..., 3) on the unit sphere.
        """
        X = np.asarray(X, dtype=float)
        return self.pitch.on_gear1(self._points(X), X)

    def flank2(self, X: ArrayLike) -> Floats:
        """Points of gear 2's profile, likewise.

        Parameters
        ----------
        X : array_like
            As of `flank1`.
        """
        X = np.asarray(X, dtype=float)
        return self.pitch.on_gear2(self._points(X), X)

    def flank(self, gear: int, X: ArrayLike) -> Floats:
        """Points of the profile of one gear, likewise.

        Parameters
        ----------
        gear : {1, 2}
            Which gear.
        X : array_like
            As of `flank1`.
        """
        return self.flank1(X) if gear == 1 else self.flank2(X)

    def _points(self, X: Floats) -> Floats:
        contact = self.at(X)
        return self.pitch.point(contact.d, contact.sin_psi, contact.cos_psi)
