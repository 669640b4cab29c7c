"""Strength of a train in one state: forces (N), pressures and stresses (MPa), safety factors, wear; lengths in mm."""

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
    """One figure for the least and the greatest wear coefficient."""

    minimum: float
    """With the least wear coefficient."""
    maximum: float
    """With the greatest wear coefficient."""


NO_WEAR = WearRange(0.0, 0.0)


@dataclass(frozen=True)
class TrainStrength(FrozenFields, Tabular, TrainResult):
    """Pressures, stresses, safety factors and wear of a train in one state (docs/strength.md).

    See Also
    --------
    geartrain.GearTrain.strength : Gives it.

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
        "root_safety": "Strength over the stress at the root [1].",
        "contact_safety": "Pressure at which yielding begins over the pressure in the contact [1].",
    }

    PAGE = "simulation.strength.strength_report:strength_document"

    KEYS = (
        *("state", "verdict", "over", "forces", "pairs", "points", "pins", "arbors", "weakest", "turns"),
        *("wear_coefficients", "left_out"),
    )

    state: str | None
    """The state; None for a train without states."""
    verdict: TorqueVerdict
    """Whether torques follow from the loads; without them there is nothing else."""
    pairs: Mapping[str, PairStrength] = field(default_factory=dict)
    """Loaded gear pairs by name."""
    arbors: tuple[ArborStrength, ...] = ()
    """Arbors that are declared."""
    turns: float | None = None
    """Turns of the input over which wear is counted; None where no time was given."""
    wear_coefficients: WearRange = NO_WEAR
    """K of Archard's law, least and greatest."""
    left_out: tuple[NeglectedEffect, ...] = ()
    """Pairs of which nothing is said, and why."""
    forces: tuple[WheelForce, ...] = ()
    """Of all pairs that carry a torque and whose module is known."""
    points: Mapping[str, PointContact] = field(default_factory=dict)
    """Loaded gear pairs whose teeth touch at a point, by name."""
    over: float | None = None
    """Turns of the input whose greatest torques bend and press; None where means do. Wear goes by means."""
    pins: Mapping[str, PinContact] = field(default_factory=dict)
    """Lobes on pins, and pins in holes, by pair or coupling."""

    def _summary(self) -> str:
        weakest = self.weakest
        found = "" if weakest is None else f", minimum safety {weakest.safety:.4g} ({weakest.what} of {weakest.part})"
        return f"{self._named}: {self.verdict.kind}{found}, {len(self.pairs)} gear pairs".strip()

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each wheel of a loaded pair: torque [N m], stresses [MPa], safety; None where not known."""
        rows = [(name, wheel) for name, pair in self.pairs.items() for wheel in pair.wheels]
        told = (
            "wheel",
            "material",
            "torque",
            "tip_stress",
            "shared_stress",
            "pressure",
            "root_safety",
            "contact_safety",
        )
        own = {each: [getattr(wheel, each) for _, wheel in rows] for each in told}
        return {"pair": [name for name, _ in rows]} | own

    @property
    def weakest(self) -> WeakestPart | None:
        """What has the least safety; None where no strength is known."""
        found = [
            WeakestPart(wheel.wheel, what, safety)
            for pair in self.pairs.values()
            for wheel in pair.wheels
            for what, safety in (("root", wheel.root_safety), ("contact", wheel.contact_safety))
            if safety is not None
        ]
        found += [
            WeakestPart(wheel.wheel, what, safety)
            for pair in self.points.values()
            for wheel in pair.wheels
            for what, safety in (("root", wheel.root_safety), ("contact", wheel.safety))
            if safety is not None
        ]
        found += [
            WeakestPart(part, what, safety)
            for each in self.pins.values()
            for part, what, safety in (
                (each.disc, "contact", each.contact_safety),
                (each.name, "pin", each.pin_safety),
            )
            if safety is not None
        ]
        found += [WeakestPart(each.link, "arbor", each.safety) for each in self.arbors if each.safety is not None]
        return min(found, key=lambda each: each.safety, default=None)


@dataclass(frozen=True)
class WeakestPart(Result):
    """What gives way first.

    See Also
    --------
    TrainStrength : holds it
    """

    part: str
    """The wheel or link."""
    what: str
    """By what it gives way."""
    safety: float
    """Its safety factor."""


# ----------------------------------------------------------------------------------------------------- parts of a train


@dataclass(frozen=True)
class PairStrength(Result):
    """A gear pair under load.

    See Also
    --------
    TrainStrength : holds it
    """

    pair: str
    """Name of the pair."""
    form: str
    """Form of its teeth."""
    module: float
    """Module [mm]."""
    face_width: float
    """Width of the narrower wheel [mm]."""
    tangential: float
    """Force along the pitch line [N]."""
    elasticity: float
    """ZE of both materials [sqrt(MPa)]."""
    contact: tuple[ContactPlace, ...]
    """Pressures along the path of contact, the worst last; empty where Hertz's formula gives none."""
    iso: IsoContact | None
    """Contact stress by ISO 6336-2; None but for external spur involutes."""
    wheels: tuple[WheelStrength, ...]
    """Both, as the pair names them."""
    notes: tuple[str, ...] = ()
    """What does not hold here, and why."""


@dataclass(frozen=True)
class ArborStrength(Result):
    """An arbor between its two bearings, wherever its wheels stand: docs/strength.md (16), (17) and (26).

    See Also
    --------
    TrainStrength : holds it
    """

    KEYS = (
        *("link", "material", "force", "thrust", "bending", "torsion", "stress", "pivot_pressure"),
        *("shoulder_pressure", "strength", "safety"),
    )

    link: str
    """The link."""
    material: str
    """Material of its arbor."""
    force: float
    """Across it, of all its meshes, as if they pulled one way [N]."""
    thrust: float
    """Along it: what all its meshes together leave for a shoulder [N]."""
    bending: float
    """Greatest bending stress [MPa], with the stress of the thrust."""
    torsion: float
    """Greatest torsional stress [MPa]."""
    stress: float
    """Both together, by von Mises [MPa]."""
    pivot_pressure: float
    """The whole force on one pivot, over its diameter times length [MPa]."""
    shoulder_pressure: float | None
    """The thrust on one shoulder [MPa]; None where the pivots are as thick as the arbor."""
    strength: float | None
    """Of the material [MPa]."""

    @property
    def safety(self) -> float | None:
        """Strength over stress."""
        return None if self.strength is None or not self.stress else self.strength / self.stress


@dataclass(frozen=True)
class WheelStrength(Result):
    """One wheel of a loaded pair.

    See Also
    --------
    PairStrength : holds it
    """

    KEYS = (
        *("wheel", "material", "torque", "section", "thickness", "lewis", "tip_stress", "shared_stress", "pressure"),
        *("strength", "spread", "root_safety", "contact_safety", "iso", "wear"),
    )

    wheel: str
    """Name of the wheel."""
    material: str
    """Name of its material."""
    torque: float
    """On it [N m]."""
    section: float
    """Distance from the axle of the section where bending is greatest [mm]."""
    thickness: float
    """Thickness of the tooth at that section [mm]."""
    lewis: float
    """Y of Lewis's formula, the load at the tip."""
    tip_stress: float
    """At the root, one couple bearing all at the tip [MPa]."""
    shared_stress: float | None
    """The greatest while couples share the load evenly [MPa]; None without a path of contact."""
    pressure: float | None
    """Greatest of the contact while one couple bears all [MPa]; None without a path of contact, or a bound."""
    strength: float | None
    """Strength of the material [MPa]; None where it is not known."""
    spread: float | None
    """Relative uncertainty of the strength; None where it is not known."""
    iso: IsoRoot | None = None
    """Root stress by ISO 6336-3 for the wheel as a hob cuts it."""
    wear: FlankWear | None = None
    """None where no time is given, or no hardness."""

    @property
    def root_safety(self) -> float | None:
        """Strength over the stress at the root, one couple bearing all at the tip."""
        return None if self.strength is None or not self.tip_stress else self.strength / self.tip_stress

    @property
    def contact_safety(self) -> float | None:
        """Pressure at which yielding begins below the flank over `pressure`."""
        return None if self.strength is None or not self.pressure else YIELD_AT * self.strength / self.pressure


@dataclass(frozen=True)
class FlankWear(Result):
    """What all flanks of one wheel lose in one mesh: docs/strength.md (14) and (15).

    See Also
    --------
    WheelStrength : holds it
    """

    passages: float
    """How often each tooth passes."""
    volume: WearRange
    """Worn off all teeth [mm3]."""
    mean_depth: WearRange
    """That, spread over their flanks [mm]."""
    depth: WearRange | None
    """At the place that loses most [mm]; None where no path of contact says where that is."""


# -------------------------------------------------------------------------------------------------- contacts and forces


@dataclass(frozen=True)
class WheelForce(Result):
    """What a wheel bears from its mate at the pitch point: docs/strength.md (18) and (19).

    See Also
    --------
    TrainStrength : holds it
    """

    pair: str
    """Name of the pair."""
    wheel: str
    """Which of its wheels."""
    radius: float
    """Of the circle that rolls on the mate's, of a bevel in the middle of its declared width [mm]."""
    tangential: float
    """Along that circle, of the sign of its torque [N]. On parallel axes and on bevels both wheels of a pair bear the
    same, that of the wheel with the greater torque over radius: friction takes part of the other's torque."""
    axial: float
    """Above 0 along the direction of its axis [N]."""
    radial: float | None
    """Towards its axis, below 0 of a ring [N]; None of teeth whose pressure angle at the pitch point is not known."""
    torque: float
    """On it [N m]."""


@dataclass(frozen=True)
class FlankStrength(Result):
    """A wheel whose teeth touch those of its mate at a point.

    See Also
    --------
    PointContact : holds it
    """

    KEYS = ("wheel", "material", "strength", "spread", "safety", "tip_stress", "root_safety")

    wheel: str
    """Name of the wheel."""
    material: str
    """Name of its material."""
    strength: float | None
    """Strength of the material [MPa]; None where it is not known."""
    spread: float | None
    """Relative uncertainty of the strength; None where it is not known."""
    safety: float | None
    """Pressure at which yielding begins below the flank over that of the contact."""
    tip_stress: float | None = None
    """Bending at the root [MPa], one couple bearing all at the tip of a tooth; None where no such teeth are cut."""

    @property
    def root_safety(self) -> float | None:
        """Strength over the stress at the root."""
        return None if self.strength is None or not self.tip_stress else self.strength / self.tip_stress


@dataclass(frozen=True)
class PointContact(Result):
    """Helical wheels on axes that cross, or a worm and its wheel, under load: docs/strength.md (24) and (25).

    See Also
    --------
    TrainStrength : holds it
    """

    pair: str
    """Its name."""
    contact_ratio: float
    """Pitches on which a couple touches, of teeth one module high."""
    normal_force: float
    """Across the flanks, of all couples together [N]."""
    pitch_pressure: float
    """At the pitch point [MPa]."""
    pressure: float
    """The greatest where as few couples touch as anywhere [MPa]."""
    longer: float
    """Longer half axis of the contact ellipse [mm]."""
    shorter: float
    """Shorter half axis of the contact ellipse [mm]."""
    wheels: tuple[FlankStrength, ...]
    """Both, as the pair names them."""
    notes: tuple[str, ...] = ()
    """What does not hold here, and why."""


@dataclass(frozen=True)
class PinContact(Result):
    """Pins on lobes of a disc, or in its holes, under load: docs/strength.md (28) to (30).

    See Also
    --------
    TrainStrength : holds it
    """

    KEYS = (
        *("name", "disc", "material", "pins", "width", "force", "radius", "pressure", "strength", "contact_safety"),
        *("pin_stress", "pin_strength", "pin_safety"),
    )

    name: str
    """Of the pair, or of the coupling."""
    disc: str
    """The wheel with the lobes or holes."""
    material: str
    """Material of that wheel."""
    pins: int
    """How many there are."""
    width: float
    """Along which they touch [mm]."""
    force: float
    """On the pin where pressure is greatest, at any time [N]."""
    radius: float
    """Of a cylinder on a plane that presses as much [mm]."""
    pressure: float
    """The greatest [MPa]."""
    strength: float | None
    """Of the weaker of both materials [MPa]."""
    pin_stress: float | None = None
    """At the foot of a pin that is held at one end [MPa]; None of pins that lie in their ring."""
    pin_strength: float | None = None
    """Of the material of pins [MPa]."""

    @property
    def contact_safety(self) -> float | None:
        """Pressure at which yielding begins below the surface over `pressure`."""
        return None if self.strength is None else YIELD_AT * self.strength / self.pressure

    @property
    def pin_safety(self) -> float | None:
        """Strength of pins over their stress."""
        return None if self.pin_strength is None or not self.pin_stress else self.pin_strength / self.pin_stress
