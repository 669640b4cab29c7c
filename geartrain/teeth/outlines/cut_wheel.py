"""A wheel that is cut: the sizes of its blank, and its outline with the sizes that came of it."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result
from geartrain.teeth.outlines.contour import Contour


@dataclass(frozen=True, slots=True)
class BlankSizes:
    """What a maker says of a wheel besides its teeth. Lengths in mm.

    Attributes
    ----------
    module : float
        Pitch diameter over teeth [mm], above 0.
    clearance : float, optional
        Between a tip and the mate's root [mm], 0 or more; default a quarter of a module.
    fillet : float, optional
        Radius of the round at the root [mm], 0 or more; default 0.38 modules, or what fits.
    bore : float, optional
        Diameter of the hole in the middle [mm]; default no hole.
    rim : float, optional
        What stands round the roots of a ring, or the pins of a lantern [mm]; default two modules, or a pin.
    tolerance : float
        How far a chord may leave a flank [mm].

    Raises
    ------
    QuestionError
        For what is no size.

    See Also
    --------
    geartrain.teeth.GearMesh.wheel_outline : takes them.

    Examples
    --------
    >>> BlankSizes(module=2, bore=6).clearance is None
    True
    """

    module: float = 1.0
    clearance: float | None = None
    fillet: float | None = None
    bore: float | None = None
    rim: float | None = None
    tolerance: float = 0.001

    def __post_init__(self) -> None:
        """Raise `QuestionError` for what is no size."""
        above = {"module": self.module, "bore": self.bore, "rim": self.rim, "tolerance": self.tolerance}
        least = {"fillet": self.fillet, "clearance": self.clearance}
        problems = [
            Problem(f"a {name} of {value:g} mm is no size", "", f"give a {name} above 0", f"--{name}")
            for name, value in above.items()
            if value is not None and not (isfinite(value) and value > 0)
        ]
        problems += [
            Problem(f"a {name} of {value:g} mm is no size", "", f"give a {name} of 0 or more", f"--{name}")
            for name, value in least.items()
            if value is not None and not (isfinite(value) and value >= 0)
        ]
        if problems:
            raise QuestionError(problems)


def _twice(radius: float) -> float:
    """The diameter."""
    return 2 * radius


@dataclass(frozen=True, slots=True)
class WheelOutline(Result):
    """A wheel's outline and sizes, to scale. Lengths in mm.

    Attributes
    ----------
    gear : int
        Which of the pair, 1 or 2.
    z : int
        Its teeth, or pins.
    kind : {"external", "ring", "pins"}
        Teeth outwards, teeth inwards, or holes for pins.
    contours : tuple of Contour
        The outer one first, then holes; the axle at (0, 0), a tooth, or a pin, on the x axis.
    module, pitch_radius, tip_radius, root_radius : float
        Of the wheel [mm].
    thickness : float
        Of a tooth along the pitch circle [mm].
    fillet : float
        Radius of the round at the root [mm]; 0 where there is none.
    relief : float
        How far the root is turned off the flank's tangent, so that the mate's tip passes [rad].
    clearance, backlash, centre_distance : float
        Of the pair [mm].
    tolerance : float
        How far a chord may leave a flank [mm].

    See Also
    --------
    geartrain.teeth.GearMesh.wheel_outline : makes one.
    """

    KEYS = (
        *("gear", "z", "kind", "module", "thickness", "fillet", "relief", "clearance", "backlash"),
        *(Key(f"{name}_diameter", f"{name}_radius", _twice) for name in ("pitch", "tip", "root")),
        *("centre_distance", "tolerance"),
    )

    gear: int
    z: int
    kind: str
    contours: tuple[Contour, ...]
    module: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    thickness: float
    fillet: float
    relief: float
    clearance: float
    backlash: float
    centre_distance: float
    tolerance: float
