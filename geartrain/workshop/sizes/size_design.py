"""Design of a pair with triangular teeth, and its properties: loss, error, impact, and margin before a jam."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, inf, isnan
from typing import TYPE_CHECKING, Any, Literal

from geartrain.errors import GearTrainError, check_choice
from geartrain.numerics.results import Result
from geartrain.teeth.triangular.clearance_window import ClearanceWindow, find_window
from geartrain.teeth.triangular.pair_geometry import TriangularSizes, equal_depth
from geartrain.teeth.triangular.parameter_sweep import phases_of
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction

PARAMETERS = ("radii", "window", "half_angle")
"""Names of the design parameters that can be free. `half_angle` applies to both wheels."""
AIMS = ("loss", "error", "impact", "jam")
"""Objectives of the search. The margin `jam` is maximised, and the other objectives are minimised."""
DIGITS = 6
"""Number of decimals of radii and windows in a declaration. Reported values are computed from the rounded sizes."""


def equal_depth_radii(z1: int, z2: int, half_angles: tuple[float, float]) -> float:
    """Return the ratio of the tip radii R2/R1 for teeth of equal depth, by equation (3) of Sorge, divided by z2/z1."""
    R1, R2 = equal_depth(z1, z2, *half_angles)
    return R2 / R1 * z1 / z2


def impact_of(transmission: TransmissionFunction) -> float:
    """Return the sum of (tau+ - tau-)^2 over the impacts in a pitch, divided by the square of the mean of tau [1].

    The speed ratio tau jumps from tau- to tau+ at an impact. The result is the energy that inelastic impacts dissipate
    in a pitch, equation (7) of docs/motion.md, divided by the kinetic energy of the driven side.
    """
    # energies are proportional to the square of a speed, and the mass cancels
    return float(sum(leap.size**2 for leap in transmission.speed_leaps() or ())) / float(transmission.ratio) ** 2


@dataclass(frozen=True)
class ToothSizes(Result):
    """Design of a pair with triangular teeth: radii, clearance and half angles, with its computed properties.

    See Also
    --------
    find_tooth_sizes : Find the best design.

    Examples
    --------
    >>> from math import pi
    >>> chosen = ToothSizes((48, 96), 0.98, 0.5, (pi / 6, pi / 6), 0.2)
    >>> round(chosen.loss, 5), round(chosen.loss_at_constant_load, 5), chosen.phases
    (0.00944, 0.00945, 'astride')
    """

    KEYS = (
        *("radii", "window", "half_angles", "clearance_factor"),
        *("loss", "loss_at_constant_load", "error", "impact", "jam", "backlash", "window_width", "phases"),
    )

    teeth: tuple[int, int]
    """Numbers of teeth of the first and the second wheel."""
    radii: float
    """Ratio of the tip radii R2/R1 divided by the ratio of the tooth numbers z2/z1 [1]; 1 if the tip radii are
    proportional to the tooth numbers.
    """
    window: float
    """Relative position of the clearance factor between its limits [1]: 0 at the limit where the pair jams, 1 at the
    limit where it loses contact.
    """
    half_angles: tuple[float, float]
    """Half aperture angles of the teeth of both wheels [rad]."""
    friction: float
    """Coefficient of friction of the flanks [1]."""
    driver: int = 1
    """Number of the driving wheel, 1 or 2."""
    ring: Literal[0, 1, 2] = 0
    """Number of the wheel that is a ring gear, 1 or 2; 0 for an external pair."""

    def __post_init__(self) -> None:
        # convert NumPy scalars to Python numbers, with which scalar code is faster
        z1, z2 = self.teeth
        first, second = self.half_angles
        object.__setattr__(self, "teeth", (int(z1), int(z2)))
        object.__setattr__(self, "half_angles", (float(first), float(second)))
        for name in ("radii", "window", "friction"):
            object.__setattr__(self, name, float(getattr(self, name)))

    def at(self, parameters: Mapping[str, float]) -> ToothSizes:
        """Return the design with new values of some of the `PARAMETERS`.

        Parameters
        ----------
        parameters : mapping of str to float
            Values keyed by parameter name; angles are in rad.
        """
        angle = parameters.get("half_angle")
        return replace(
            self,
            radii=parameters.get("radii", self.radii),
            window=parameters.get("window", self.window),
            half_angles=self.half_angles if angle is None else (angle, angle),
        )

    def parameter(self, name: str) -> float:
        """Return the value of one of the `PARAMETERS`; for `half_angle`, the value of the first wheel [rad].

        Parameters
        ----------
        name : str
            Name of the parameter.
        """
        return self.half_angles[0] if name == "half_angle" else float(getattr(self, name))

    @cached_property
    def _unplaced(self) -> TriangularSizes:
        z1, z2 = self.teeth
        # tip radius 1, because no property depends on the absolute size
        return TriangularSizes(z1, z2, 1.0, self.radii * z2 / z1, *self.half_angles, 0.0, self.ring)

    @cached_property
    def limits(self) -> ClearanceWindow | None:
        """Limits of the clearance factor; None if no teeth with these half angles and radii exist."""
        try:
            return find_window(self._unplaced) if self._unplaced.has_valleys else None
        except GearTrainError:
            return None

    @cached_property
    def transmission(self) -> TriangularTransmission | None:
        """Transmission function of the pair; None if the pair cannot turn at any clearance factor."""
        if self.limits is None or not self.limits:
            return None
        sizes = self._unplaced.at(self.limits.at(self.window))
        return TriangularTransmission(sizes if self.driver == 1 else sizes.swapped(), self.friction)

    @property
    def runs(self) -> bool:
        """True if the pair can turn and friction does not lock it."""
        return (
            self.transmission is not None
            and bool(self.transmission.verdict)
            and self.transmission.friction < self.transmission.locking_friction
        )

    @property
    def sizes(self) -> TriangularSizes:
        """Radii and centre distance of the pair, with the driver first. The pair must be able to turn."""
        assert self.transmission is not None
        return self.transmission.sizes

    @property
    def clearance_factor(self) -> float:
        """Centre distance divided by the distance at which a tip touches the bottom of a space [1]."""
        return self.sizes.clearance_factor

    @cached_property
    def loss(self) -> float:
        """Loss at constant driving torque: 1 minus the mean efficiency, equation (34) of Sorge [1]."""
        assert self.transmission is not None
        return 1 - self.transmission.efficiency_mean()

    @cached_property
    def loss_at_constant_load(self) -> float:
        """Loss at constant load torque: 1 minus the mean efficiency [1]."""
        assert self.transmission is not None
        return 1 - self.transmission.efficiency_at_constant_load()

    @cached_property
    def error(self) -> float:
        """Peak-to-peak transmission error of the pair [rad of the driven wheel]."""
        assert self.transmission is not None
        low, high = self.transmission.error_range()
        return high - low

    @cached_property
    def impact(self) -> float:
        """Energy dissipated by impacts within a pitch, divided by the kinetic energy of the driven side [1]."""
        assert self.transmission is not None
        return impact_of(self.transmission)

    @cached_property
    def jam(self) -> float:
        """Maximum permissible change of the centre distance before the pair jams or loses contact [module]."""
        assert self.limits is not None
        # distance to the nearer end of the window: a jam on one side, loss of contact on the other
        sizes, nearest = self.sizes, min(self.window, 1 - self.window)
        module = 2 * sizes.D / sizes.pitch_sum
        return nearest * (self.limits.run - self.limits.jam) * sizes.deepest_distance / module

    @property
    def window_width(self) -> float:
        """Maximum minus minimum clearance factor at which the pair turns [1]."""
        assert self.limits is not None
        return self.limits.run - self.limits.jam

    @property
    def backlash(self) -> float:
        """Minimum backlash of the pair [rad of the driven wheel]."""
        assert self.transmission is not None
        return self.transmission.verdict.backlash

    @property
    def phases(self) -> str:
        """Phases of contact of a tooth pair in order of time, such as "approach+recess"."""
        assert self.transmission is not None
        return phases_of(self.transmission)

    def merit(self, aim: str) -> float:
        """Return the value of an objective to be minimised; infinite if it is undefined or the pair cannot turn.

        Parameters
        ----------
        aim : str
            One of `AIMS`.
        """
        if aim == "jam":
            return inf if self.transmission is None else -self.jam
        if not self.runs:
            return inf
        found = float(getattr(self, aim))
        return inf if isnan(found) else found  # NaN would break the comparisons of the optimiser


_FIGURES = ("loss", "loss_at_constant_load", "error", "impact", "jam", "backlash", "window_width", "phases")


def size_columns(designs: Sequence[ToothSizes]) -> dict[str, Sequence[Any]]:
    """Return table columns of sizes and properties, keyed by name, with one row for each design; angles in rad."""
    names = ("radii", "window", "clearance_factor", *_FIGURES)
    angles = {f"half_angle_{at + 1}": [each.half_angles[at] for each in designs] for at in (0, 1)}
    return angles | {name: [getattr(each, name) for each in designs] for name in names}


@dataclass(frozen=True)
class SizeLimit(Result):
    """Limit on a design: a maximum of `loss`, `error` or `impact`, or a minimum of `jam`, `window_width` or `backlash`.

    See Also
    --------
    find_tooth_sizes : Find the best design within limits.
    """

    figure: str
    """Name of the property of `ToothSizes` that is limited."""
    bound: float
    """Value of the limit, in the unit of the property."""

    MINIMUM = ("jam", "window_width", "backlash")
    FIGURES = ("loss", "error", "impact", *MINIMUM)

    def __post_init__(self) -> None:
        check_choice("limit", self.figure, self.FIGURES)

    def excess(self, sizes: ToothSizes) -> float:
        """Return the amount by which a design that can turn exceeds the limit; 0 or less if the limit is satisfied.

        Parameters
        ----------
        sizes : ToothSizes
            Design that turns.
        """
        found = float(getattr(sizes, self.figure))
        return self.bound - found if self.figure in self.MINIMUM else found - self.bound


def keeps(design: ToothSizes, limits: Iterable[SizeLimit]) -> bool:
    """Return True if a design turns and satisfies all limits."""
    return design.runs and all(limit.excess(design) <= 0 for limit in limits)


def form_data(sizes: ToothSizes, exact: bool = False) -> dict[str, Any]:
    """Return the sizes as data of a declaration; with all digits if `exact` is True."""
    angles, lengths = ("", "") if exact else (".10g", f".{DIGITS}f")
    first, second = (f"{degrees(angle):{angles}} deg" for angle in sizes.half_angles)
    return {
        "form": "triangular",
        "half_angle": first if first == second else [first, second],
        "window": f"{sizes.window:{lengths}}",
        "radii": f"{sizes.radii:{lengths}}",
    }


def rounded(sizes: ToothSizes) -> ToothSizes:
    """Return the design with radii and window rounded to the number of digits in a declaration."""
    return sizes.at({"radii": round(sizes.radii, DIGITS), "window": round(sizes.window, DIGITS)})
