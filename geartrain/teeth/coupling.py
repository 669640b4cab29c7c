"""Couplings that a train declares besides its gear pairs: base class of all kinds, and the kinds by name.

Every coupling adds one or more rows to the Willis system. A row joins a driving link j and a driven link i by an exact
mean ratio m in the frame of their carrier k: (w_i - w_k) = m (w_j - w_k). A coupling whose instantaneous ratio varies
about m also has a `TransmissionFunction`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, Self

from pydantic import BaseModel, ConfigDict, Field

from geartrain.numerics.quantity import Quantity
from geartrain.teeth.contact_coefficients import DeclaredEfficiency, Efficiencies

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction


class CouplingKind(NamedTuple):
    """Module and class that implement one kind of coupling."""

    module: str
    """Name of the module, in the package `geartrain.teeth.couplings`."""
    model: str
    """Name of the class that describes couplings of this kind."""
    varies: bool = False
    """True if the instantaneous ratio varies about its mean value."""
    travels: bool = False
    """True if the driving link turns and the driven link slides."""


COUPLINGS: Mapping[str, CouplingKind] = {
    "pin_and_slot": CouplingKind("pins", "PinAndSlot", varies=True),
    "pin_follower": CouplingKind("pins", "PinFollower", varies=True),
    "pins_in_holes": CouplingKind("pins", "PinsInHoles"),
    "parallel": CouplingKind("pins", "Parallel"),
    "rack": CouplingKind("travel", "Rack", travels=True),
    "screw": CouplingKind("travel", "Screw", travels=True),
    "drum": CouplingKind("travel", "Drum", travels=True),
    "crank_slider": CouplingKind("crank_slider", "CrankSlider", varies=True, travels=True),
    "belt": CouplingKind("belt", "Belt"),
    "ratio": CouplingKind("ratio", "Ratio"),
    "universal_joint": CouplingKind("laws", "UniversalJoint", varies=True),
    "elliptical": CouplingKind("laws", "EllipticalPair", varies=True),
    "pitch_curve": CouplingKind("laws", "PitchCurvePair", varies=True),
    "law": CouplingKind("laws", "TabledLaw", varies=True),
    "geneva": CouplingKind("steps", "Geneva", varies=True),
    "step": CouplingKind("steps", "Step", varies=True),
}
"""Kinds of couplings, keyed by the value of `kind` in declarations."""


COUPLING_ENDS = ("pin", "slot", "pair", "around", "turns", "slides")
"""Keys of declared couplings whose values name links or wheels, in the order of `Coupling.ends`."""


def coupling_model(kind: str) -> type[Coupling]:
    """Import the class of a kind of coupling, which is a key of `COUPLINGS`, and return the class."""
    found = COUPLINGS[kind]
    model: type[Coupling] = getattr(import_module(f"geartrain.teeth.couplings.{found.module}"), found.model)
    return model


class CouplingRow(NamedTuple):
    """Row of the Willis system that a coupling adds: a (w_i - w_k) + b (w_j - w_k) = 0, where w is a speed, i the
    driven link, j the driving link and k their carrier.
    """

    id: str
    """Name of the row, which is the name of the coupling unless the coupling has several rows."""
    driven: str
    """Driven link i. Relative to the carrier, its speed is the mean ratio times the speed of the driving link."""
    driver: str
    """Driving link j."""
    a: int
    """Coefficient of link i; it is positive."""
    b: int
    """Coefficient of link j, equal to -m a, where m is the mean ratio."""
    wheels: tuple[str, str] | None = None
    """Wheels of links i and j if the absolute values of a and b are their tooth counts; None if they are not."""
    carrier: str | None = None
    """Declared carrier k; None if the carrier follows from the turning pairs of links i and j."""


def ratio_row(name: str, driven: str, driver: str, mean: Fraction) -> CouplingRow:
    """Return the row `name` of a coupling whose mean ratio `mean` is the driven speed over the driver speed."""
    return CouplingRow(name, driven, driver, mean.denominator, -mean.numerator)


class Coupling(BaseModel):
    """Declared coupling of two or more links. It is the base class of all kinds of couplings."""

    model_config = ConfigDict(frozen=True, extra="forbid", coerce_numbers_to_str=True, defer_build=True)

    ENDS: ClassVar[tuple[str, ...]] = ("pair",)
    """Keys that name the links: two keys, the driver first, or one key with a list or mapping of links."""
    SIDES: ClassVar[tuple[str, str]] = ("driven", "driver")
    """Names of the driven side and of the driving side in tables."""
    FOR_COPIES: ClassVar[bool] = False
    """True if the coupling may connect each of several equal links with the same other link."""
    LOCKS_BACK: ClassVar[bool] = False
    """True if the driven side cannot drive, because the device locks in that direction."""
    PARALLEL: ClassVar[str] = "its parts must move in the same plane"
    """Reason why the axes of the links must be parallel; an empty string if they may have any directions."""
    NEEDS_DISTANCE: ClassVar[bool] = True
    """True if the links must turn about two axes at a fixed distance. False if they may be coaxial."""
    UNKNOWN: ClassVar[str] = ""
    """Properties of this kind of coupling that are not known or not modelled, as noun phrases for reports."""
    OBLIQUE: ClassVar[bool] = False
    """True if the axes of the two links need not be parallel."""
    NEGLECTED: ClassVar[tuple[str, str] | None] = None
    """Effect on torques that is not computed, and the reason; None for kinds of couplings without such an effect."""
    HOLDS: ClassVar[bool] = False
    """True if the driven side cannot separate from the driver, because the coupling holds it in both senses."""

    kind: str
    id: str = Field("", description="Name of the coupling; default `first~second`")
    efficiency: DeclaredEfficiency | None = Field(
        None,
        description="Basic efficiency with the carrier fixed, at most 1: a number or a percentage, or "
        "`{forward, backward}`, where forward means that the first link drives; default no loss",
    )
    source: str | None = Field(None, description="Key of the source of the dimensions")
    status: Literal["surviving", "reconstructed", "hypothetical"] | None = Field(
        None, description="Evidence: the device survives, is reconstructed from surviving parts, or is a hypothesis"
    )
    note: str | None = Field(None, description="Remark for the reader")

    @property
    def ends(self) -> tuple[str, ...]:
        """Names of the connected links, or of wheels if the coupling is declared by wheels; the driver first."""
        values = [getattr(self, key) for key in self.ENDS]
        return tuple(values) if len(values) > 1 else tuple(values[0])

    @property
    def by_teeth(self) -> bool:
        """True if the coupling is declared by wheels, False if it is declared by links."""
        return False

    @property
    def name(self) -> str:
        """Declared id; if none is declared, the names of the first two ends joined by `~`."""
        return self.id or "~".join(self.ends[:2])

    @property
    def row_names(self) -> tuple[str, ...]:
        """Names of the rows that the coupling adds to the Willis system."""
        return (self.name,)

    @property
    def about(self) -> str:
        """Declared sizes of the coupling, as text for reports; an empty string if no sizes are declared."""
        return ""

    def problems(self, wheels: Mapping[str, tuple[str, Any]]) -> Iterator[tuple[str, str, str]]:
        """Yield a tuple for each fault in the links and wheels of the coupling: the fault, its reason and its remedy.

        wheels   link and declaration of each wheel, keyed by wheel; all parts that the coupling names are declared
        """
        links = self.links(wheels)
        if twice := next((link for link in links if links.count(link) > 1), None):
            why = f"{' and '.join(dict.fromkeys(self.SIDES))} must be on different links"
            yield f"coupling '{self.name}' connects '{twice}' to itself", why, "name the other link"

    @property
    def mean(self) -> Fraction:
        """Exact mean ratio: speed of the driven side divided by speed of the driving side, relative to the carrier."""
        return Fraction(1)

    @property
    def bounds(self) -> tuple[Fraction, Fraction] | None:
        """Minimum and maximum of the mean ratio if it is known with a tolerance; None for an exact mean ratio."""
        return None

    @property
    def losses(self) -> Efficiencies | None:
        """Basic efficiencies with the first end driving and with the second; None without losses."""
        return self.efficiency

    @property
    def transmission(self) -> TransmissionFunction | None:
        """Transmission function if the first end drives; None if the speed ratio is constant or sizes are missing."""
        return None

    @property
    def formula(self) -> str:
        """Formula for the driven angle q in terms of the driver's angle S; an empty string if none is known."""
        return ""

    def on_axes(self, angle: float) -> Self:
        """Return a copy of the coupling that contains the angle between its axes [rad], if the coupling needs this
        angle and does not declare it.
        """
        del angle
        return self

    @property
    def periods_per_turn(self) -> Fraction:
        """Number of periods of the transmission function in one turn of the driver relative to the carrier."""
        return Fraction(1)

    @property
    def remark(self) -> str:
        """Words on the deviation from mean motion, such as "moves 1/4 of the time"; empty if there are none."""
        return ""

    @property
    def friction_torque(self) -> Fraction:
        """Mean friction torque [N m] on the driven link against its motion relative to the carrier, such as the torque
        of a jumper. The torque does not depend on the load.
        """
        return Fraction(0)

    def links(self, wheels: Mapping[str, tuple[str, Any]]) -> tuple[str, ...]:
        """Return the links that the coupling connects, the driving link first.

        wheels   link and declaration of each wheel, keyed by wheel, for a coupling declared by wheels
        """
        return tuple(wheels[name][0] for name in self.ends) if self.by_teeth else self.ends

    def rows(self, wheels: Mapping[str, tuple[str, Any]]) -> Sequence[CouplingRow]:
        """Return the rows that the coupling adds to the Willis system.

        wheels   link and declaration of each wheel, keyed by wheel, for a coupling declared by wheels
        """
        driver, driven = self.links(wheels)
        return (ratio_row(self.name, driven, driver, self.mean),)

    def references(self) -> Iterator[tuple[str, str, tuple[str | int, ...]]]:
        """Yield the kind (link or wheel), the name and the location in the declaration of each named part."""
        kind = "wheel" if self.by_teeth else "link"
        for key in self.ENDS:
            value = getattr(self, key)
            if isinstance(value, str):
                yield kind, value, (key,)
            else:
                places = value if isinstance(value, Mapping) else range(len(value))
                yield from ((kind, each, (key, place)) for each, place in zip(value, places, strict=True))

    @property
    def torques(self) -> Iterator[Quantity]:
        """Declared energies, such as the loss of a jumper. Torques of a train that has such energies need units."""
        values = (getattr(self, name) for name in type(self).model_fields)
        return (each for each in values if isinstance(each, Quantity) and each.dimension == "energy")

    @property
    def lengths(self) -> Iterator[Quantity]:
        """Declared lengths of the coupling. They must have units if any length of the train has a unit."""
        values = (getattr(self, name) for name in type(self).model_fields)
        return (each for each in values if isinstance(each, Quantity) and each.dimension in (None, "length"))

    def renamed(self, names: Mapping[str, str], name: str) -> Self:
        """Return a copy of the coupling that connects other links.

        names   new name of each link that is replaced, keyed by its old name
        name    new `id` of the coupling
        """
        changed: dict[str, Any] = {"id": name}
        for key in self.ENDS:
            value = getattr(self, key)
            if isinstance(value, str):
                changed[key] = names.get(value, value)
            elif isinstance(value, Mapping):
                changed[key] = {names.get(each, each): size for each, size in value.items()}
            else:
                changed[key] = tuple(names.get(each, each) for each in value)
        return self.model_copy(update=changed)


def unmodelled_properties(couplings: Sequence[Coupling]) -> list[str]:
    """Return the properties of couplings that are unknown or not modelled, each with the names of the couplings."""
    named: dict[str, list[str]] = {}
    for each in couplings:
        if each.UNKNOWN:
            named.setdefault(each.UNKNOWN, []).append(each.name)
    return [f"{what} of {', '.join(names)}" for what, names in named.items()]
