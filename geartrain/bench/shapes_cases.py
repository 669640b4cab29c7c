"""The problems of the benchmark of tooth shapes: the six, and extreme pairs."""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, inf, pi, radians, tan
from typing import Literal

from geartrain.bench.shapes_truth import TRUTH
from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

Kind = Literal["stress", "heat", "friction"]


@dataclass(frozen=True, slots=True)
class Case:
    """One side in recess over half a pitch.

    amount   stress: pressure angle at the pitch point (rad); heat: Q*, the hotter surface's; friction: the greatest
             pressure angle (rad), with a least speed of 0.15 along the dedendum
    """

    name: str
    kind: Kind
    pitch: PitchSurfaces
    amount: float

    @property
    def X(self) -> float:
        """Arc of the side."""
        return self.pitch.p / 2

    @property
    def end(self) -> float:
        """Distance of the last contact, the truth rounded to floats."""
        return float(TRUTH[self.name][0])

    @property
    def last(self) -> float:
        """Pressure angle there (rad), or for least friction the length of the ray."""
        return float(TRUTH[self.name][1])

    @property
    def gamma(self) -> float:
        """(A + B) / Q*."""
        return (self.pitch.A + self.pitch.B) / self.amount

    @property
    def exponent(self) -> float:
        """Errors go with d to this power near the pitch point; -2 for g = sin psi / S of uniform heat."""
        return {"stress": (tan(self.amount) ** 2 - 1) / 2, "heat": -1.0}.get(self.kind, inf)


def _crown(z1: int, z2: int) -> PitchSurfaces:
    """A flat crown gear: its cone a plane, B = 0."""
    return PitchSurfaces(z1, z2, asin(z1 / z2), pi / 2, True)


_SPUR, _BEVEL = PitchSurfaces.spur(24, 36), PitchSurfaces.cones(24, 36)
_SIX: tuple[tuple[Kind, float], ...] = (("stress", radians(20)), ("heat", 0.4), ("friction", radians(25)))
CASES = tuple(
    Case(f"{kind} {name}", kind, pitch, amount)
    for kind, amount in _SIX
    for name, pitch in (("spur", _SPUR), ("bevel", _BEVEL))
)

_STEEP = tuple(
    Case(f"stress spur 24/36, {tilt} deg", "stress", _SPUR, radians(float(tilt)))
    for tilt in ("0.1", "1", "5", "44", "44.9")
)
_WIDE = tuple(
    case
    for z1, z2, hot in ((5, 5, "1.2"), (5, 1000, "0.8"), (100_000, 100_000, "0.8"))
    for case in (
        Case(f"stress spur {z1}/{z2}, 20 deg", "stress", PitchSurfaces.spur(z1, z2), radians(20)),
        Case(f"heat spur {z1}/{z2}, Q {hot}", "heat", PitchSurfaces.spur(z1, z2), float(hot)),
    )
)
_CONES = tuple(
    case
    for label, pitch in (
        ("crown 24/36", _crown(24, 36)),
        ("bevel 40/40 at 176 deg", PitchSurfaces.cones(40, 40, radians(176))),
        ("bevel 5/1000 at 90 deg", PitchSurfaces.cones(5, 1000)),
    )
    for case in (
        Case(f"stress {label}, 20 deg", "stress", pitch, radians(20)),
        Case(f"heat {label}, Q 0.5", "heat", pitch, 0.5),
    )
)
EXTREMES = (*_STEEP, *_WIDE, *_CONES)
