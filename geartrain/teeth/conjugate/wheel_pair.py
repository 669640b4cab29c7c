"""Wheels of a conjugate gear pair, and checks that such a pair can exist."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, degrees, pi
from typing import TYPE_CHECKING

from geartrain.numerics.results import Shown
from geartrain.teeth.tooth_form import in_modules, refused

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

FEWEST, MOST_TEETH = 3, 10**9
_MINIMUM_ANGLE = 1e-6  # rad: axes at a smaller angle are practically parallel, and their cones vanish in rounding


@dataclass(frozen=True, slots=True)
class WheelPair(Shown):
    """Tooth numbers, arrangement of the axes, and module of a pair of wheels with conjugate teeth.

    See Also
    --------
    geartrain.teeth.Involute : Its method `pair` takes a `WheelPair`.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> pair = Involute(form="involute").pair(WheelPair(24, 36))
    >>> round(pair.path.contact_ratio, 4), pair.faults
    (1.6472, ())
    """

    z1: float
    """Tooth number of the first wheel. It is not an integer for the virtual spur wheel of a bevel wheel."""
    z2: float
    """Tooth number of the second wheel. It is not an integer for the virtual spur wheel of a bevel wheel."""
    internal: bool = False
    """True if the second wheel is a ring gear."""
    shaft_angle: float | None = None
    """Shaft angle of bevel gears [rad]; None for parallel axes."""
    module: float | None = None
    """Transverse module [m], the unit of length of the pair; None if the module is unknown."""
    helix: float = 0.0
    """Helix angle of helical wheels [rad], 0 or more; 0 for spur wheels."""

    @classmethod
    def of(
        cls,
        z1: int,
        z2: int,
        internal: bool,
        shaft_angle: float | None,
        pitch_distance: float | None,
        helix: float = 0.0,
    ) -> WheelPair:
        """Return the pair of wheels. Its module follows from the pitch distance.

        Parameters
        ----------
        z1, z2 : int
            Tooth numbers.
        internal : bool
            True if the second wheel is a ring gear.
        shaft_angle : float or None
            Shaft angle [rad]; None for parallel axes.
        pitch_distance : float or None
            Half the module times the sum of the tooth numbers, also for a ring gear [m]; None if unknown.
        helix : float
            Helix angle [rad].
        """
        module = None if pitch_distance is None or z1 + z2 < 1 else 2 * pitch_distance / (z1 + z2)
        return cls(z1, z2, internal, shaft_angle, module, helix)

    @property
    def bevel(self) -> bool:
        """True if the wheels are bevel gears, whose axes intersect."""
        return self.shaft_angle is not None

    @property
    def pitch(self) -> PitchSurfaces:
        """Pitch surfaces of both wheels at the design distance. Raises `GearTrainError` for an impossible pair."""
        from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

        self.check()
        if self.shaft_angle is None:
            return PitchSurfaces.spur(self.z1, self.z2, self.internal)
        return PitchSurfaces.cones(self.z1, self.z2, self.shaft_angle)

    @property
    def distance(self) -> float:
        """Design centre distance [module]."""
        return (self.z2 - self.z1 if self.internal else self.z1 + self.z2) / 2

    def check(self) -> None:
        """Raise `GearTrainError` if the two wheels cannot form a pair."""
        for z in (self.z1, self.z2):
            if z < FEWEST:
                what = f"a wheel of {z} {'tooth' if z == 1 else 'teeth'} cannot have conjugate teeth"
                why = "with so few teeth, a tooth pair leaves contact before the next one can engage"
                raise refused(what, why, f"give at least {FEWEST} teeth, or another tooth_form")
        if self.internal and self.z2 <= self.z1:
            what = f"a ring of {self.z2} teeth cannot contain a wheel of {self.z1} teeth"
            why = "the pitch circle of the ring must be larger than the pitch circle of the wheel"
            raise refused(what, why, f"give the ring more than {self.z1} teeth")
        if self.internal and self.bevel:
            why = "its axis is parallel to the axis of its pinion"
            raise refused("a ring cannot have a shaft angle", why, "omit the shaft angle")
        if max(self.z1, self.z2) > MOST_TEETH:
            what = f"a wheel cannot have {max(self.z1, self.z2)} conjugate teeth"
            why = "a tooth would be smaller than the rounding error of the radius"
            raise refused(what, why, f"give at most {MOST_TEETH:g} teeth")
        if self.shaft_angle is not None and not _MINIMUM_ANGLE <= self.shaft_angle <= pi - _MINIMUM_ANGLE:
            what = f"a shaft angle of {degrees(self.shaft_angle):.6g} deg is out of range"
            why = "axes of bevel wheels meet at an angle between 0 and 180 deg"
            raise refused(what, why, "give an angle in this range, or declare a spur pair on parallel axes")

    def modules(self, length: Quantity, name: str) -> float:
        """Convert a declared length to transverse modules. A number without a unit is a length in normal modules.

        Parameters
        ----------
        length : Quantity
            Length as declared.
        name : str
            Name of the field, for the error message.

        Raises
        ------
        GearTrainError
            If the length has a unit and no module is known.
        """
        # a number without a unit is in normal modules, which the helix makes smaller than transverse ones
        return in_modules(length, self.module, name) * (cos(self.helix) if length.unit is None else 1.0)
