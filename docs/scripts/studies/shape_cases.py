"""The problems of the study of tooth shapes, the six and extreme pairs, with their solutions."""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, inf, pi, radians, tan
from typing import Literal

from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

Kind = Literal["stress", "heat", "friction"]


@dataclass(frozen=True, slots=True)
class ShapeCase:
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
    ShapeCase(f"{kind} {name}", kind, pitch, amount)
    for kind, amount in _SIX
    for name, pitch in (("spur", _SPUR), ("bevel", _BEVEL))
)

_STEEP = tuple(
    ShapeCase(f"stress spur 24/36, {tilt} deg", "stress", _SPUR, radians(float(tilt)))
    for tilt in ("0.1", "1", "5", "44", "44.9")
)
_WIDE = tuple(
    case
    for z1, z2, hot in ((5, 5, "1.2"), (5, 1000, "0.8"), (100_000, 100_000, "0.8"))
    for case in (
        ShapeCase(f"stress spur {z1}/{z2}, 20 deg", "stress", PitchSurfaces.spur(z1, z2), radians(20)),
        ShapeCase(f"heat spur {z1}/{z2}, Q {hot}", "heat", PitchSurfaces.spur(z1, z2), float(hot)),
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
        ShapeCase(f"stress {label}, 20 deg", "stress", pitch, radians(20)),
        ShapeCase(f"heat {label}, Q 0.5", "heat", pitch, 0.5),
    )
)
EXTREMES = (*_STEEP, *_WIDE, *_CONES)

TRUTH: dict[str, tuple[str, str]] = {
    "stress spur": ("1.4789223730305230753268739", "0.3405610050799221591004142895"),
    "heat spur": ("1.544023073826428323798365578", "0.3235970102211223890034431379"),
    "friction spur": ("1.480392128830756251584872297", "0.3563150801725634547043993281"),
    "stress bevel": ("0.06845745099294365295110253705", "0.3318307392217568384009115601"),
    "heat bevel": ("0.07201308173503794394161025678", "0.2234245214278718038394431582"),
    "friction bevel": ("0.0685388123918610858263212436", "0.01673046201786650733125096872"),
    "stress spur 24/36, 0.1 deg": ("1.570284019773850101", "0.044011302260835866"),
    "stress spur 24/36, 1 deg": ("1.569998723745413890", "0.049332719881808138"),
    "stress spur 24/36, 5 deg": ("1.564687569034173246", "0.095682124582530612"),
    "stress spur 24/36, 44 deg": ("1.140206653052408696", "0.750080371597155309"),
    "stress spur 24/36, 44.9 deg": ("1.123450841973459886", "0.765132538288431833"),
    "stress spur 5/5, 20 deg": ("1.440083761750824515", "0.507640239563352648"),
    "heat spur 5/5, Q 1.2": ("1.360634921238581443", "0.994039469846062599"),
    "stress spur 5/1000, 20 deg": ("1.516424401217146961", "0.190934527113315725"),
    "heat spur 5/1000, Q 0.8": ("1.527944147162059788", "0.413485390649578797"),
    "stress spur 100000/100000, 20 deg": ("1.476065716947010271", "0.349065850955956254"),
    "heat spur 100000/100000, Q 0.8": ("1.570796326003590555", "0.000054977871467495"),
    "stress crown 24/36, 20 deg": ("0.082478857928226441", "0.316848320661755150"),
    "heat crown 24/36, Q 0.5": ("0.087127573170949315", "0.097862617744900267"),
    "stress bevel 40/40 at 176 deg, 20 deg": ("0.073754645802178464", "0.349477188265257124"),
    "heat bevel 40/40 at 176 deg, Q 0.5": ("0.078491357333429819", "0.006856084893181371"),
    "stress bevel 5/1000 at 90 deg, 20 deg": ("0.003033330277917600", "0.189353848144972036"),
    "heat bevel 5/1000 at 90 deg, Q 0.5": ("0.002908759954681040", "0.713573324528897461"),
}
"""The true ends: distance of the last contact, and pressure angle there (rad).

The six problems in 40 digits: power series at the pitch point, computed coefficient by coefficient, then Taylor
marching over X; least friction from its two closed conditions, its second number being the length of the ray. Extreme
pairs by extrapolated midpoint rules in 64-bit mantissas, with steps that grow with the distance, agreeing to 2e-16
with steps half as long, and with the 40 digits where both were made.
"""
