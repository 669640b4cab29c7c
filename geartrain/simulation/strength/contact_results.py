"""What wheels bear where they touch: forces of all pairs, and contacts at a point. Forces in N, lengths in mm."""

from __future__ import annotations

from dataclasses import dataclass

from geartrain.numerics.results import Result
from geartrain.simulation.strength.formulas.contact_pressure import YIELD_AT


@dataclass(frozen=True)
class WheelForce(Result):
    """What a wheel bears from its mate at the pitch point: docs/strength.md (18) and (19). Forces in N.

    Attributes
    ----------
    pair, wheel : str
        The pair, and which of its wheels.
    radius : float
        Of the circle that rolls on the mate's, of a bevel in the middle of its declared width [mm].
    tangential : float
        Along that circle, of the sign of its torque. On parallel axes and on bevels both wheels of a pair bear the
        same, that of the wheel with the greater torque over radius: friction takes part of the other's torque.
    axial : float
        Above 0 along the direction of its axis.
    radial : float or None
        Towards its axis, below 0 of a ring; None of teeth whose pressure angle at the pitch point is not known.
    torque : float
        On it [N m].

    See Also
    --------
    TrainStrength : holds it
    """

    pair: str
    wheel: str
    radius: float
    tangential: float
    axial: float
    radial: float | None
    torque: float


@dataclass(frozen=True)
class FlankStrength(Result):
    """A wheel whose teeth touch those of its mate at a point.

    Attributes
    ----------
    wheel, material : str
        Its name, and that of its material.
    strength, spread : float
        Of the material [MPa], and how far that may be off, as a part of it; None where nothing says it.
    safety : float or None
        Pressure at which yielding begins below the flank over that of the contact.
    tip_stress : float or None
        Bending at the root [MPa], one couple bearing all at the tip of a tooth; None where no such teeth are cut.

    See Also
    --------
    PointContact : holds it
    """

    KEYS = ("wheel", "material", "strength", "spread", "safety", "tip_stress", "root_safety")

    wheel: str
    material: str
    strength: float | None
    spread: float | None
    safety: float | None
    tip_stress: float | None = None

    @property
    def root_safety(self) -> float | None:
        """Strength over the stress at the root."""
        return None if self.strength is None or not self.tip_stress else self.strength / self.tip_stress


@dataclass(frozen=True)
class PointContact(Result):
    """Helical wheels on axes that cross, or a worm and its wheel, under load: docs/strength.md (24) and (25).

    Attributes
    ----------
    pair : str
        Its name.
    contact_ratio : float
        Pitches on which a couple touches, of teeth one module high.
    normal_force : float
        Across the flanks, of all couples together [N].
    pitch_pressure : float
        At the pitch point [MPa].
    pressure : float
        The greatest where as few couples touch as anywhere [MPa].
    longer, shorter : float
        Half axes of the ellipse in which they touch there [mm].
    wheels : tuple of FlankStrength
        Both, as the pair names them.
    notes : tuple of str
        What does not hold here, and why.

    See Also
    --------
    TrainStrength : holds it
    """

    pair: str
    contact_ratio: float
    normal_force: float
    pitch_pressure: float
    pressure: float
    longer: float
    shorter: float
    wheels: tuple[FlankStrength, ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class PinContact(Result):
    """Pins on lobes of a disc, or in its holes, under load: docs/strength.md (28) to (30).

    Attributes
    ----------
    name : str
        Of the pair, or of the coupling.
    disc, material : str
        The wheel with the lobes or holes, and its material.
    pins : int
        How many there are.
    width : float
        Along which they touch [mm].
    force : float
        On the pin where pressure is greatest, at any time [N].
    radius : float
        Of a cylinder on a plane that presses as much [mm].
    pressure : float
        The greatest [MPa].
    strength : float or None
        Of the weaker of both materials [MPa].
    pin_stress : float or None
        At the foot of a pin that is held at one end [MPa]; None of pins that lie in their ring.
    pin_strength : float or None
        Of the material of pins [MPa].

    See Also
    --------
    TrainStrength : holds it
    """

    KEYS = (
        *("name", "disc", "material", "pins", "width", "force", "radius", "pressure", "strength", "contact_safety"),
        *("pin_stress", "pin_strength", "pin_safety"),
    )

    name: str
    disc: str
    material: str
    pins: int
    width: float
    force: float
    radius: float
    pressure: float
    strength: float | None
    pin_stress: float | None = None
    pin_strength: float | None = None

    @property
    def contact_safety(self) -> float | None:
        """Pressure at which yielding begins below the surface over `pressure`."""
        return None if self.strength is None else YIELD_AT * self.strength / self.pressure

    @property
    def pin_safety(self) -> float | None:
        """Strength of pins over their stress."""
        return None if self.pin_strength is None or not self.pin_stress else self.pin_strength / self.pin_stress
