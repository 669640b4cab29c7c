"""Results of the strength analysis of a train in one state: forces [N], stresses [MPa], safety factors and wear.
Lengths are in mm.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

from geartrain.dynamics.torques.torque_results import NeglectedEffect, TorqueVerdict
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.results import Result, Tabular, TrainResult
from geartrain.simulation.strength.contact_pressure import YIELD_AT, ContactPlace
from geartrain.simulation.strength.iso_6336 import IsoContact, IsoRoot


class WearRange(NamedTuple):
    """Values of one wear result, computed with the minimum and with the maximum wear coefficient."""

    minimum: float
    """Value for the minimum wear coefficient, in the unit of the result."""
    maximum: float
    """Value for the maximum wear coefficient, in the unit of the result."""


NO_WEAR = WearRange(0.0, 0.0)


@dataclass(frozen=True)
class TrainStrength(FrozenFields, Tabular, TrainResult):
    """Contact pressures, stresses, safety factors and wear of the parts of a train in one state (docs/strength.md).

    See Also
    --------
    geartrain.GearTrain.strength : Returns such an object.

    Examples
    --------
    >>> import geartrain
    >>> found = geartrain.load('''
    ... links: {frame: {}, a: {wheels: {p: {teeth: 17, module: 2 mm}}}, b: {wheels: {w: 51}}}
    ... revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
    ... gears: [{pair: [p, w]}]
    ... tooth_form: {form: involute}
    ... material: steel
    ... face_width: 20 mm
    ... inputs: {a: 1}
    ... loads: {b: 60 N m}
    ... ''').strength()
    >>> pair = found.pairs["p~w"]
    >>> round(pair.tangential, 2), round(pair.iso.stress[0], 2), round(pair.wheels[0].iso.stress, 2)
    (1176.47, 706.85, 87.99)
    """

    ROW = "WheelStrength"
    MEANINGS: ClassVar = {
        "pair": "Gear pair.",
        "root_safety": "Strength divided by the stress at the root [1].",
        "contact_safety": "Pressure at which yielding begins divided by the pressure in the contact [1].",
    }

    PAGE = "simulation.strength.strength_report:strength_document"

    KEYS = (
        *("state", "verdict", "over", "forces", "pairs", "points", "pins", "arbors", "weakest", "turns"),
        *("wear_coefficients", "neglected"),
    )

    state: str | None
    """Name of the state; None for a train without states."""
    verdict: TorqueVerdict
    """Verdict on whether the loads determine the torques. If they do not, the other fields are empty."""
    pairs: Mapping[str, PairStrength] = field(default_factory=dict)
    """Strength of the loaded gear pairs, keyed by pair."""
    arbors: tuple[ArborStrength, ...] = ()
    """Strength of the arbors with declared sizes."""
    turns: float | None = None
    """Number of revolutions of the input over which wear accumulates; None if no service life is given."""
    wear_coefficients: WearRange = NO_WEAR
    """Minimum and maximum wear coefficient K [1] of Archard's law."""
    neglected: tuple[NeglectedEffect, ...] = ()
    """Pairs and arbors without results, and neglected torque variations; each has a reason."""
    forces: tuple[WheelForce, ...] = ()
    """Tooth forces of all pairs that carry a torque and whose module is known."""
    points: Mapping[str, PointContact] = field(default_factory=dict)
    """Strength of the loaded gear pairs with point contact, keyed by pair."""
    over: float | None = None
    """Number of revolutions over which the maximum torques were determined; None if the stresses are computed from mean
    torques.

    Wear is always computed from mean torques.
    """
    pins: Mapping[str, PinContact] = field(default_factory=dict)
    """Strength of the contacts between lobes and pins or between pins and holes, keyed by pair or coupling."""

    def _summary(self) -> str:
        weakest = self.weakest
        found = "" if weakest is None else f", minimum safety {weakest.safety:.4g} ({weakest.what} of {weakest.part})"
        return f"{self._named}: {self.verdict.kind}{found}, {len(self.pairs)} gear pairs".strip()

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with a row for each loaded wheel: torque [N m], stresses [MPa], safety factors."""
        rows = [(name, wheel) for name, pair in self.pairs.items() for wheel in pair.wheels]
        names = ["wheel", "material", "torque", "tip_stress", "shared_stress", "pressure"]
        names += ["root_safety", "contact_safety"]
        own = {each: [getattr(wheel, each) for _, wheel in rows] for each in names}
        return {"pair": [name for name, _ in rows]} | own

    @property
    def weakest(self) -> WeakestPart | None:
        """Part with the minimum safety factor; None if no safety factor is known."""
        candidates = [
            *((wheel.wheel, "root", wheel.root_safety) for pair in self.pairs.values() for wheel in pair.wheels),
            *((wheel.wheel, "contact", wheel.contact_safety) for pair in self.pairs.values() for wheel in pair.wheels),
            *((wheel.wheel, "root", wheel.root_safety) for pair in self.points.values() for wheel in pair.wheels),
            *((wheel.wheel, "contact", wheel.safety) for pair in self.points.values() for wheel in pair.wheels),
            *((each.disc, "contact", each.contact_safety) for each in self.pins.values()),
            *((each.name, "pin", each.pin_safety) for each in self.pins.values()),
            *((each.link, "arbor", each.safety) for each in self.arbors),
        ]
        # parts without a known strength have no safety factor
        found = [WeakestPart(part, what, safety) for part, what, safety in candidates if safety is not None]
        return min(found, key=lambda each: each.safety, default=None)


@dataclass(frozen=True)
class WeakestPart(Result):
    """Part of a train with the minimum safety factor, and its mode of failure."""

    part: str
    """Name of the wheel or link."""
    what: str
    """Mode of failure: root, contact, arbor or pin."""
    safety: float
    """Safety factor of the part."""


# ----------------------------------------------------------------------------------------------------- parts of a train


@dataclass(frozen=True)
class PairStrength(Result):
    """Strength of a gear pair under load.

    See Also
    --------
    TrainStrength : Contains such objects.
    """

    pair: str
    """Name of the pair."""
    form: str
    """Name of the tooth form of the pair."""
    module: float
    """Module of the pair [mm]."""
    face_width: float
    """Face width of the narrower wheel [mm]."""
    tangential: float
    """Tangential force at the pitch line [N]."""
    elasticity: float
    """Elasticity factor ZE of the materials of the two wheels [sqrt(MPa)]."""
    contact: tuple[ContactPlace, ...]
    """Contact pressures along the path of contact, with the highest pressure last; empty for a tooth form without a
    path of contact.
    """
    iso: IsoContact | None
    """Contact stress according to ISO 6336-2; None unless the teeth are external spur or helical involutes."""
    wheels: tuple[WheelStrength, ...]
    """Strength of both wheels, in the order of the pair."""
    notes: tuple[str, ...] = ()
    """Restrictions on the validity of the results, with reasons."""


@dataclass(frozen=True)
class ArborStrength(Result):
    """Stresses and strength of an arbor between two bearings. The stresses are upper bounds for all positions of its
    wheels, equations (16), (17) and (26) of docs/strength.md.
    """

    KEYS = (
        *("link", "material", "force", "thrust", "bending", "torsion", "stress", "pivot_pressure"),
        *("shoulder_pressure", "strength", "safety"),
    )

    link: str
    """Name of the link to which the arbor belongs."""
    material: str
    """Name of the material of the arbor."""
    force: float
    """Sum of the magnitudes of the transverse forces of all meshes on the arbor [N], as if all of them acted in one
    direction.
    """
    thrust: float
    """Resultant axial force of all meshes on the arbor, which is supported by one shoulder [N]."""
    bending: float
    """Maximum bending stress of the arbor, including the axial stress due to the thrust [MPa]."""
    torsion: float
    """Maximum torsional stress of the arbor [MPa]."""
    stress: float
    """Von Mises equivalent stress of bending and torsion [MPa]."""
    pivot_pressure: float
    """Bearing pressure on one pivot [MPa]: total force divided by the product of pivot diameter and pivot length."""
    shoulder_pressure: float | None
    """Contact pressure on one shoulder due to the thrust [MPa]; None if the pivots are as thick as the arbor."""
    strength: float | None
    """Strength of the arbor's material [MPa]: 0.2 % proof stress, or tensile strength for a material that does not
    yield; None if unknown.
    """

    @property
    def safety(self) -> float | None:
        """Safety factor: strength divided by equivalent stress; None if the strength is unknown or the stress is 0."""
        return None if self.strength is None or not self.stress else self.strength / self.stress


@dataclass(frozen=True)
class WheelStrength(Result):
    """Strength of one wheel of a loaded pair."""

    KEYS = (
        *("wheel", "material", "torque", "section", "thickness", "lewis", "tip_stress", "shared_stress", "pressure"),
        *("strength", "spread", "root_safety", "contact_safety", "iso", "wear"),
    )

    wheel: str
    """Name of the wheel."""
    material: str
    """Name of the material of the wheel."""
    torque: float
    """Torque on the wheel [N m]."""
    section: float
    """Distance of the tooth section with the maximum bending stress from the axis of the wheel [mm]; 0 for pins."""
    thickness: float
    """Thickness of the tooth at the section with the maximum bending stress [mm]; 0 for pins."""
    lewis: float
    """Lewis form factor Y of the tooth for a load at its tip [1]; 0 for pins."""
    tip_stress: float
    """Root stress if one tooth pair carries the whole load at the tip [MPa]; for pins, the bending stress of a pin."""
    shared_stress: float | None
    """Maximum root stress if tooth pairs share the load equally [MPa]; None for pins, for helical teeth, and for tooth
    forms without a path of contact.
    """
    pressure: float | None
    """Maximum contact pressure while one tooth pair is in contact [MPa]; None if the pressure is unbounded or the tooth
    form has no path of contact.
    """
    strength: float | None
    """Strength of the wheel's material [MPa]: 0.2 % proof stress, or tensile strength for a material that does not
    yield; None if unknown.
    """
    spread: float | None
    """Relative uncertainty of the material's strength; None if it is not known."""
    iso: IsoRoot | None = None
    """Root stress according to ISO 6336-3 for a wheel that is cut with a hob; None if the standard is not
    applicable.
    """
    wear: FlankWear | None = None
    """Wear of the flanks of the wheel; None if the service life or the hardness is unknown."""

    @property
    def root_safety(self) -> float | None:
        """Safety factor of the tooth root: `strength` divided by `tip_stress`; None if either value is unknown."""
        return None if self.strength is None or not self.tip_stress else self.strength / self.tip_stress

    @property
    def contact_safety(self) -> float | None:
        """Safety factor of the flank: pressure at first yield divided by `pressure`; None if one is unknown."""
        return None if self.strength is None or not self.pressure else YIELD_AT * self.strength / self.pressure


@dataclass(frozen=True)
class FlankWear(Result):
    """Wear of all flanks of one wheel in one mesh, equations (14) and (15) of docs/strength.md."""

    passages: float
    """Number of meshing cycles of each tooth."""
    volume: WearRange
    """Total volume of material that is worn from all teeth of the wheel [mm3]."""
    mean_depth: WearRange
    """Mean wear depth of the flanks [mm]."""
    depth: WearRange | None
    """Maximum wear depth of the flanks [mm]; None for helical teeth and for tooth forms without a path of contact."""


# -------------------------------------------------------------------------------------------------- contacts and forces


@dataclass(frozen=True)
class WheelForce(Result):
    """Force on a wheel from its mate at the pitch point [N], equations (18) and (19) of docs/strength.md."""

    pair: str
    """Name of the pair."""
    wheel: str
    """Name of the wheel."""
    radius: float
    """Operating pitch radius [mm]. For a bevel gear, it is the pitch radius at the middle of the declared width."""
    tangential: float
    """Tangential force at the pitch circle, with the sign of the torque [N].

    On parallel axes and for bevel gears, the force has the same magnitude on both wheels of a pair, equation (32) of
    docs/strength.md.
    """
    axial: float
    """Axial force, positive along the direction of the wheel's axis [N]."""
    radial: float | None
    """Radial force [N], positive towards the wheel's axis and negative for a ring gear; None if the pressure angle is
    unknown.
    """
    torque: float
    """Torque on the wheel [N m]."""


@dataclass(frozen=True)
class FlankStrength(Result):
    """Strength of one wheel of a pair with point contact."""

    KEYS = ("wheel", "material", "strength", "spread", "safety", "tip_stress", "root_safety")

    wheel: str
    """Name of the wheel."""
    material: str
    """Name of the material of the wheel."""
    strength: float | None
    """Strength of the wheel's material [MPa]: 0.2 % proof stress, or tensile strength for a material that does not
    yield; None if unknown.
    """
    spread: float | None
    """Relative uncertainty of the material's strength; None if it is not known."""
    safety: float | None
    """Safety factor of the flank: pressure at first yield divided by the contact pressure; None if either value is
    unknown.
    """
    tip_stress: float | None = None
    """Root stress if one tooth pair carries the whole load at the tip [MPa]; None if the virtual wheels
    cannot be cut.
    """

    @property
    def root_safety(self) -> float | None:
        """Safety factor of the tooth root: `strength` divided by `tip_stress`; None if either value is unknown."""
        return None if self.strength is None or not self.tip_stress else self.strength / self.tip_stress


@dataclass(frozen=True)
class PointContact(Result):
    """Strength of crossed helical gears or of a worm gear pair, whose flanks have point contact, equations (24) and
    (25) of docs/strength.md.
    """

    pair: str
    """Name of the pair."""
    contact_ratio: float
    """Contact ratio of the pair: mean number of tooth pairs in contact."""
    normal_force: float
    """Total normal force on the flanks of all tooth pairs in contact [N]."""
    pitch_pressure: float
    """Contact pressure at the pitch point [MPa]."""
    pressure: float
    """Maximum contact pressure while the minimum number of tooth pairs is in contact [MPa]."""
    longer: float
    """Semi-major axis of the contact ellipse [mm]."""
    shorter: float
    """Semi-minor axis of the contact ellipse [mm]."""
    wheels: tuple[FlankStrength, ...]
    """Strength of both wheels, in the order of the pair."""
    notes: tuple[str, ...] = ()
    """Restrictions on the validity of the results, with reasons."""


@dataclass(frozen=True)
class PinContact(Result):
    """Strength of pins against the lobes or holes of a disc, equations (28) to (30) of docs/strength.md."""

    KEYS = (
        *("name", "disc", "material", "pins", "width", "force", "radius", "pressure", "strength", "contact_safety"),
        *("pin_stress", "pin_strength", "pin_safety"),
    )

    name: str
    """Name of the pair or coupling."""
    disc: str
    """Name of the wheel that has the lobes or holes."""
    material: str
    """Name of the material of the disc."""
    pins: int
    """Number of pins."""
    width: float
    """Axial width of the contact [mm]."""
    force: float
    """Force on the pin that has the maximum contact pressure, at the instant of this maximum [N]."""
    radius: float
    """Radius of the cylinder whose contact with a plane is equivalent to the contact of pin and disc [mm]."""
    pressure: float
    """Maximum contact pressure [MPa]."""
    strength: float | None
    """Strength of the weaker of the two materials [MPa]; None if it is not known."""
    pin_stress: float | None = None
    """Equivalent stress at the root of a cantilever pin [MPa]; None if a ring supports both ends of the pins."""
    pin_strength: float | None = None
    """Strength of the material of the pins [MPa]; None if it is not known."""

    @property
    def contact_safety(self) -> float | None:
        """Safety factor of the contact: pressure at first yield divided by `pressure`; None if one is unknown."""
        return None if self.strength is None else YIELD_AT * self.strength / self.pressure

    @property
    def pin_safety(self) -> float | None:
        """Safety factor of the pins: `pin_strength` divided by `pin_stress`; None if either value is unknown."""
        return None if self.pin_strength is None or not self.pin_stress else self.pin_strength / self.pin_stress
