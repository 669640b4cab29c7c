"""Chebyshev collocation: the regular solution of S v' + f(d, v) = 0 from the pitch point, where S is 0.

Of all solutions only one is bounded at d = 0 (for pressure angles below 45 deg), and a polynomial can be no other: so
the point needs no special care, where marching must start beside it on a series.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.chebyshev import ChebyshevSeries, differentiation, points

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

ValueAndSlope = Callable[["Floats", "Floats"], "tuple[Floats, Floats]"]

_NODES = (24, 48, 96, 192)  # doubled until the last coefficients have fallen
FALLEN = 1e-14  # of the greatest coefficient: less is rounding
_UNFINISHED = 1e-5  # coefficients that have not fallen so far with the most nodes: beyond 84 deg or so
_STEPS = 25  # of Newton's method
_ROUGH = 1e-9  # residuals below this are left to rounding


def solved(
    pitch: PitchSurfaces,
    f: ValueAndSlope,
    first: float,
    end: float,
    start: float = 0.0,
    near: ChebyshevSeries | None = None,
) -> ChebyshevSeries:
    """v on [start, end] with S v' + f = 0 and v = `first` at `start`.

    f      d, v -> f and its derivative by v; at the pitch point f(0, first) = 0 is what makes the solution bounded
    near   the solution up to another end, to begin with
    Nodes are doubled until the last coefficients have fallen to 1e-14 of the greatest. Raises `RangeError` where the
    solution leaves what f is defined for, or comes so near that the coefficients do not fall.
    """
    series = near or ChebyshevSeries.through(np.full(_NODES[0], first), start, end)
    for nodes in _NODES:
        if near and nodes < len(near.coefficients):
            continue
        series = fitted(pitch, f, first, end, start, nodes, series)
        if series.tail < FALLEN:
            break
    if series.tail > _UNFINISHED:
        raise lost(end)
    return series


def fitted(
    pitch: PitchSurfaces,
    f: ValueAndSlope,
    first: float,
    end: float,
    start: float,
    nodes: int,
    near: ChebyshevSeries | None = None,
) -> ChebyshevSeries:
    """As `solved`, with so many nodes and no more."""
    x, _ = points(nodes)
    d = start + (end - start) * (x + 1) / 2
    # held at its last value beyond its end, where a series soon grows without bound
    guess = near(np.minimum(d, near.end)) if near else np.full(nodes, first)
    return ChebyshevSeries.through(_Collocated(pitch, f, first, d).newton(guess), start, end)


class _Collocated:
    """The equation at the nodes d; the first of them holds what v starts with."""

    def __init__(self, pitch: PitchSurfaces, f: ValueAndSlope, first: float, d: Floats) -> None:
        self.f, self.first, self.d = f, first, d
        self.matrix = pitch.S(d)[:, None] * differentiation(len(d)) * (2 / (d[-1] - d[0]))
        # the first row gives way to the condition v = first: at the pitch point S is 0, and the equation says no more
        self.matrix[0] = 0.0

    def residual(self, v: Floats) -> tuple[Floats, Floats]:
        """What is left over at each node, and the diagonal that f adds to the Jacobian."""
        off, slope = self.f(self.d, v)
        off[0], slope[0] = v[0] - self.first, 1.0
        return self.matrix @ v + off, slope

    def newton(self, v: Floats) -> Floats:
        """Damped steps until rounding stops them."""
        left, slope = self.residual(v)
        for _ in range(_STEPS):
            step = np.linalg.solve(self.matrix + np.diag(slope), left)
            part, size = 1.0, np.abs(left).max()
            trial, (left, slope) = v - step, self.residual(v - step)
            # halve a step that leaves what f is defined for, or, within a thousandth, that makes the residual grow
            while not np.isfinite(left).all() or (np.abs(left).max() > size and part > 1e-3 and size > _ROUGH):
                part /= 2
                if part < 1e-9:
                    raise lost(float(self.d[-1]))
                trial, (left, slope) = v - part * step, self.residual(v - part * step)
            # at rounding, or where the residual no longer shrinks
            done = np.abs(trial - v).max() <= 4e-16 * np.abs(trial).max() or not np.abs(left).max() < size
            v = trial
            if done:
                break
        if not np.abs(left).max() < _ROUGH:
            raise lost(float(self.d[-1]))
        return v


def lost(end: float) -> RangeError:
    """What to say of an end that cannot be reached."""
    return RangeError(
        Problem(
            f"the path of contact does not reach {end:.6g} from the pitch point",
            "its pressure angle would come to a right angle before",
            "ask for shorter arcs, more teeth, or a smaller pressure angle",
        )
    )
