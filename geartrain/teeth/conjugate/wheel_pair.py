"""The two wheels of a pair with conjugate teeth, and whether there can be such a pair."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi
from typing import TYPE_CHECKING

from geartrain.numerics.results import Shown
from geartrain.teeth.tooth_form import refused

if TYPE_CHECKING:
    from geartrain.numerics.quantity import Quantity
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

FEWEST, MOST_TEETH = 3, 10**9
_MINIMUM_ANGLE = 1e-6  # rad: axes that meet under less are as good as parallel, and cones lost in rounding


@dataclass(frozen=True, slots=True)
class WheelPair(Shown):
    """The two wheels of a pair with conjugate teeth.

    See Also
    --------
    geartrain.teeth.Involute : its method `pair` takes them.

    Examples
    --------
    >>> from geartrain.teeth import Involute
    >>> pair = Involute(form="involute").pair(WheelPair(24, 36))
    >>> round(pair.path.contact_ratio, 4), pair.faults
    (1.6472, ())
    """

    z1: float
    """Tooth count of the first wheel; not whole for a virtual wheel that represents a bevel."""
    z2: float
    """Tooth count of the second wheel; not whole for a virtual wheel that represents a bevel."""
    internal: bool = False
    """The second is a ring."""
    shaft_angle: float | None = None
    """Angle of the axes [rad], for bevels; None for parallel axes."""
    module: float | None = None
    """Transverse module [m], as all lengths of the pair are transverse; None where no length gives it."""
    helix: float = 0.0
    """Helix angle of helical wheels [rad], 0 or more."""

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
        """Wheels whose module follows from their pitch distance.

        Parameters
        ----------
        z1, z2 : int
            Tooth counts.
        internal : bool
            The second is a ring.
        shaft_angle : float or None
            Angle of the axes [rad]; None for parallel axes.
        pitch_distance : float or None
            Half the module of each wheel times its teeth, summed, for a ring too [m]; None where nothing gives it.
        helix : float
            Helix angle [rad].
        """
        module = None if pitch_distance is None or z1 + z2 < 1 else 2 * pitch_distance / (z1 + z2)
        return cls(z1, z2, internal, shaft_angle, module, helix)

    @property
    def bevel(self) -> bool:
        """True if the axes meet."""
        return self.shaft_angle is not None

    @property
    def pitch(self) -> PitchSurfaces:
        """The pitch surfaces at the design distance. Raises `GearTrainError` where there are none."""
        from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

        self.check()
        if self.shaft_angle is None:
            return PitchSurfaces.spur(self.z1, self.z2, self.internal)
        return PitchSurfaces.cones(self.z1, self.z2, self.shaft_angle)

    @property
    def distance(self) -> float:
        """Design centre distance in modules."""
        return (self.z2 - self.z1 if self.internal else self.z1 + self.z2) / 2

    def check(self) -> None:
        """Raises `GearTrainError` for wheels that cannot be a pair."""
        for z in (self.z1, self.z2):
            if z < FEWEST:
                raise refused(
                    f"a wheel of {z} {'tooth' if z == 1 else 'teeth'} has no conjugate teeth",
                    "so few leave no arc on which one pair takes over from the last",
                    f"give at least {FEWEST} teeth, or another tooth_form",
                )
        if self.internal and self.z2 <= self.z1:
            raise refused(
                f"a ring of {self.z2} teeth does not hold a wheel of {self.z1}",
                "its pitch circle is not the larger one",
                "give the ring more teeth",
            )
        if self.internal and self.bevel:
            raise refused("a ring's axis is parallel to its pinion's", "", "give the pair no shaft angle")
        if max(self.z1, self.z2) > MOST_TEETH:
            raise refused(
                f"a wheel of {max(self.z1, self.z2)} teeth",
                "its teeth are lost in the rounding of its radius",
                f"give at most {MOST_TEETH:g} teeth",
            )
        if self.shaft_angle is not None and not _MINIMUM_ANGLE <= self.shaft_angle <= pi - _MINIMUM_ANGLE:
            raise refused(
                f"a shaft angle of {self.shaft_angle:.6g} rad is none",
                f"bevel axes meet between 0 and 180 deg, and {_MINIMUM_ANGLE:g} rad from either at least",
                "give parallel axes to a spur pair",
            )

    def modules(self, length: Quantity, name: str) -> float:
        """A declared length in transverse modules, a plain number being in normal ones.

        Parameters
        ----------
        length : Quantity
            As declared.
        name : str
            Of the field, for the error.

        Raises
        ------
        GearTrainError
            Where no module is known.
        """
        if length.unit is None:
            return float(length.value) * cos(self.helix)
        if self.module is None:
            raise refused(
                f"the {name} {length.text} has nothing to be compared with",
                "the wheels declare no module with a unit",
                f"give the `module` of both wheels, --module to `export`, or the {name} as a plain number of modules",
            )
        return length.si / self.module
