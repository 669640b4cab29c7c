"""A whole path of contact: approach and recess, and what follows from it for both gears at every instant."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.conjugate.path_side import PathSide
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class PathContact:
    """The contact at pitch-line displacements X, arrays of one shape; X < 0 is approach, X > 0 recess.

    d        signed distance from the pitch point (modules; rad)
    sin_psi, cos_psi   of the pressure angle
    q        d(psi)/dX
    w        d(S sin psi)/dd
    U1, U2   speed of the contact along each profile, over the pitch-line speed
    k1, k2   (geodesic) curvature of each profile; gear 1 is convex where k1 > 0, gear 2 where k2 < 0
    kr       relative curvature k1 - k2
    H        kr / cos psi: the Hertz pressure goes with its square root
    Q1, Q2   heat of friction per area of each profile over (friction times tangential force)
    flash    F_n^(3/4) kr^(1/4) |sqrt U1 - sqrt U2|, what Blok's flash temperature of like materials goes with
    rub      |S| / cos psi, the loss going with its integral over X
    """

    X: Floats
    d: Floats
    sin_psi: Floats
    cos_psi: Floats
    q: Floats
    w: Floats
    U1: Floats
    U2: Floats
    k1: Floats
    k2: Floats
    kr: Floats
    H: Floats
    Q1: Floats
    Q2: Floats
    flash: Floats
    rub: Floats

    @property
    def psi(self) -> Floats:
        """Pressure angle (rad)."""
        found: Floats = np.arctan2(self.sin_psi, self.cos_psi)
        return found


@dataclass(frozen=True)
class PathOfContact:
    """Where contact happens: one side before the pitch point, one after.

    real   arcs of approach and recess (X) that the teeth leave of the sides'; one is negative where contact begins, or
           ends, so far beyond the pitch point. Default the sides'
    """

    pitch: PitchSurfaces
    approach: PathSide
    recess: PathSide
    real: tuple[float, float] | None = None

    @cached_property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and of recess (X) in which the teeth really touch; one may be negative."""
        return (self.approach.arc, self.recess.arc) if self.real is None else self.real

    def span(self, recess: bool, low: float = -inf, high: float = inf) -> tuple[float, float] | None:
        """Distances d on one side between which the teeth touch, X from `low` to `high`; None where they do not."""
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
        """Displacements X at which the root end of a gear's flank touches, and its tip."""
        approach, recess = self.arcs
        return (-approach, recess) if gear == 1 else (recess, -approach)

    def radii(self, gear: int) -> tuple[float, float]:
        """Radii (modules; half-angles of cones, rad) between which a gear's flank works, root end first."""
        (low, high), _ = self.pitch.polar(gear, self.flank(gear, np.array(self.ends(gear))))
        return float(low), float(high)

    def at(self, X: ArrayLike) -> PathContact:
        """The contact at displacements X within the arcs, any shape."""
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
        """The contact at distances d >= 0 from the pitch point, on one side."""
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
        """Points of gear 1's profile, by the displacement X at which they touch, in its X = 0 position."""
        X = np.asarray(X, dtype=float)
        return self.pitch.on_gear1(self._points(X), X)

    def flank2(self, X: ArrayLike) -> Floats:
        """Points of gear 2's profile, likewise."""
        X = np.asarray(X, dtype=float)
        return self.pitch.on_gear2(self._points(X), X)

    def flank(self, gear: int, X: ArrayLike) -> Floats:
        """Points of the profile of gear 1 or 2, likewise."""
        return self.flank1(X) if gear == 1 else self.flank2(X)

    def _points(self, X: Floats) -> Floats:
        contact = self.at(X)
        return self.pitch.point(contact.d, contact.sin_psi, contact.cos_psi)
