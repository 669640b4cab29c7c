"""What collisions of one pair of teeth cost, and from what speed its quasi-static law is void.

Where the speed ratio tau falls at a rate s = max(-d tau / dS), the driven inertia J stays in contact at the driver's
speed w if the load torque is at least J w^2 s; under a load T the law is void above w = sqrt(T / (J s)).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Key, Result

if TYPE_CHECKING:
    from collections.abc import Iterable

    from geartrain.teeth.transmission import SpeedLeap, TransmissionFunction


def collision_energies(leaps: Iterable[SpeedLeap], inertia: float, omega1: float) -> tuple[float, float, float]:
    """Energies of one pitch's collisions (J): handed to the driven side, dissipated, and their sum, the driver's work.

    J w1^2 (after^2 - before^2)/2 and J w1^2 (after - before)^2/2 for inelastic blows, the driver at constant speed
    omega1 (rad/s), `inertia` J (kg m2) all that turns with the driven wheel. The source of triangular teeth counts
    the first as lost; what is lost is the second.
    """
    leaps, scale = tuple(leaps), inertia * omega1**2
    handed = sum((leap.after**2 - leap.before**2) / 2 for leap in leaps) * scale
    dissipated = sum(leap.size**2 / 2 for leap in leaps) * scale
    return handed, dissipated, handed + dissipated


@dataclass(frozen=True)
class PairOperation:
    """How a pair is run, as far as it is known: SI units, `rate` of the driver in turns per second."""

    inertia: float | None = None
    rate: float | None = None
    load: float | None = None

    @property
    def omega1(self) -> float | None:
        """Speed of the driver (rad/s)."""
        return None if self.rate is None else 2 * pi * self.rate


@dataclass(frozen=True)
class PairImpacts(Result):
    """What collisions of one pair cost, and where its law is void, as far as `PairOperation` tells; None elsewhere.

    inertia      kg m2, of all that turns with the driven wheel
    rate         of the driver (turns per second)
    handed       energy of one pitch (J) handed to the driven side; `dissipated`, and `work`, their sum
    least_load   load torque (N m) that keeps the teeth in contact at this rate
    void         driver's speed (turns per second) above which they part under the declared load
    """

    KEYS = (
        *("inertia", "rate", "handed", "dissipated", "work"),
        *(Key("load_to_stay_in_contact", "least_load"), Key("void_above", "void")),
    )

    inertia: float
    rate: float | None = None
    handed: float | None = None
    dissipated: float | None = None
    work: float | None = None
    least_load: float | None = None
    void: float | None = None


def find_pair_impacts(law: TransmissionFunction, operation: PairOperation) -> PairImpacts | None:
    """What collisions cost; None where no inertia is known, or the law has no account of its collisions."""
    inertia, load, omega1 = operation.inertia, operation.load, operation.omega1
    leaps, steepest = law.speed_leaps(), law.steepest_fall()
    if inertia is None or leaps is None or steepest is None:
        return None
    void = sqrt(load / (inertia * steepest)) / (2 * pi) if load is not None and steepest > 0 else None
    if omega1 is None:
        return PairImpacts(inertia, void=void)
    energies = collision_energies(leaps, inertia, omega1)
    return PairImpacts(inertia, operation.rate, *energies, least_load=inertia * omega1**2 * steepest, void=void)
