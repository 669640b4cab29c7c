"""One side of a path of contact, approach or recess: pieces in order of the distance d >= 0 from the pitch point, each
a law of the pressure angle over d.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.chebyshev import ChebyshevSeries

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces


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
