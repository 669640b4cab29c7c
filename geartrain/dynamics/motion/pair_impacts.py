"""What collisions of one pair with triangular teeth cost, and from what speed its quasi-static law is void.

Where tau falls at a rate s = max(-d tau / d alpha_1), the driven inertia J stays in contact at the driver's speed w if
the load torque is at least J w^2 s; under a load T the law is void above w = sqrt(T / (J s)).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

from geartrain.numerics.plain_data import Key, Result

if TYPE_CHECKING:
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission


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


def find_pair_impacts(law: TriangularTransmission, operation: PairOperation) -> PairImpacts | None:
    """What collisions cost; None where no inertia is known."""
    inertia, load, omega1 = operation.inertia, operation.load, operation.omega1
    if inertia is None:
        return None
    steepest = law.steepest_fall()
    void = sqrt(load / (inertia * steepest)) / (2 * pi) if load is not None and steepest > 0 else None
    if omega1 is None:
        return PairImpacts(inertia, void=void)
    energies = law.impact(inertia, omega1)
    return PairImpacts(inertia, operation.rate, *energies, least_load=inertia * omega1**2 * steepest, void=void)
