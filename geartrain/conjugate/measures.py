"""What a path of contact costs: loss, greatest stress, heat and flash, depth; and how it compares with another."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.path import Contact, Path
from geartrain.conjugate.side import Side

if TYPE_CHECKING:
    from geartrain.conjugate.pitch import Floats, Pitch

_GAUSS = np.polynomial.legendre.leggauss(48)
_SCAN = 257  # points of one piece among which an extreme is looked for
_NARROWED, _ACROSS = 5, 33  # times the bracket around it is scanned again, and by how many points


@dataclass(frozen=True, slots=True)
class Measures:
    """What one path costs, friction and load taken out; lengths in modules or radians.

    loss            mean loss over friction, first order: (A + B) (J_a + J_r) / (X_a + X_r)
    stress          greatest Hertz pressure over sqrt(tangential force): sqrt(max H); infinite where psi is 0
    off_pitch       the same where |X| is more than a tenth of a pitch
    heat            greatest heat per area of either profile, over friction times tangential force: max Q
    flash           greatest flash proxy
    depth           working depth |eta_a| + eta_r
    slowest         least speed of the contact along a dedendum, over the pitch-line speed
    contact_ratio   pitches of displacement while one pair touches
    """

    loss: float
    stress: float
    off_pitch: float
    heat: float
    flash: float
    depth: float
    slowest: float
    contact_ratio: float

    def over(self, other: Measures) -> dict[str, float]:
        """Each of the quantities as a ratio to another path's."""
        names = ("loss", "stress", "off_pitch", "heat", "flash", "depth", "slowest", "contact_ratio")
        return {name: getattr(self, name) / getattr(other, name) for name in names}


def measure(path: Path) -> Measures:
    """All measures of a path."""
    pitch = path.pitch
    sides = (path.approach, path.recess)
    total = sum(rubbing(pitch, side) for side in sides)
    bound = 0.1 * pitch.p
    stress = max(greatest(path, recess, lambda c: c.H) for recess in (False, True))
    off = max(greatest(path, recess, lambda c: c.H, bound) for recess in (False, True))
    heat = max(greatest(path, recess, lambda c: np.maximum(c.Q1, c.Q2)) for recess in (False, True))
    flash = max(greatest(path, recess, lambda c: c.flash) for recess in (False, True))
    slowest = min(-greatest(path, recess, lambda c: -np.minimum(c.U1, c.U2)) for recess in (False, True))
    slowest = min(slowest, float(path.at(0.0).sin_psi))
    return Measures(
        loss=(pitch.A + pitch.B) * total / sum(path.arcs),
        stress=stress**0.5,
        off_pitch=off**0.5,
        heat=heat,
        flash=flash,
        depth=sum(height(pitch, side) for side in sides),
        slowest=slowest,
        contact_ratio=path.contact_ratio,
    )


def rubbing(pitch: Pitch, side: Side) -> float:
    """J of one side: the integral of S / cos^2 psi over d."""
    x, weights = _GAUSS
    total = 0.0
    for piece in side.pieces:
        start = piece.start
        d = start + (piece.end - start) * (x + 1) / 2
        total += float(weights @ (pitch.S(d) / (1 - piece.sin_psi(d) ** 2))) * (piece.end - start) / 2
    return total


def height(pitch: Pitch, side: Side) -> float:
    """Height of the last contact over the first, |eta|; over the pitch line but for paths that keep off it."""
    ends = np.array([side.start, side.end])
    low, high = pitch.S(ends) * side.sin_psi(ends)
    return float(high - low)


def greatest(path: Path, recess: bool, what: Callable[[Contact], Floats], beyond: float = 0.0) -> float:
    """The greatest value of a quantity on one side, where |X| >= `beyond`: scanned piece by piece, then narrowed."""
    side = path.recess if recess else path.approach
    if beyond >= side.arc:
        return -np.inf
    start = float(side.distance(np.array(beyond))) if beyond else side.start
    best = -np.inf
    for piece in side.pieces:
        if piece.end <= start:
            continue
        first, last = max(piece.start, start), np.nextafter(piece.end, 0.0)
        best = max(best, _peak(lambda d: what(path.along(d, recess)), first, float(last), side.end))
    return best


def _peak(f: Callable[[Floats], Floats], first: float, last: float, scale: float) -> float:
    """Greatest value of f on [first, last]; what is 0/0 at the pitch point itself is asked beside it."""
    d = np.linspace(first, last, _SCAN)
    if first == 0.0:
        d[0] = 1e-7 * scale
        at_pitch = f(np.zeros(1))[0]
        if np.isposinf(at_pitch):
            return float("inf")
    values = np.where(np.isnan(found := f(d)), -np.inf, found)
    best = float(values.max())
    for _ in range(_NARROWED):
        at = int(np.argmax(values))
        d = np.linspace(d[max(at - 1, 0)], d[min(at + 1, len(d) - 1)], _ACROSS)
        values = f(d)
        best = max(best, float(values.max()))
    return best
