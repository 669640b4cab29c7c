"""What collisions of one pair of teeth cost, and from what speed its quasi-static law is void.

Where the speed ratio tau falls at a rate s = max(-d tau / dS), the driven inertia J stays in contact at the driver's
speed w if the load torque is at least J w^2 s; under a load T the law is void above w = sqrt(T / (J s)).

In a train (Carnot's theorem, equation (7) of docs/motion.md) the input keeps its speed. A pair whose driven side jumps
by one radian a second makes every link l jump by its response g_l, so that side strikes with the inertia sum J_l g_l^2;
an inelastic blow of a speed difference v takes half of it times v^2. In an ordinary train that is the inertia of all
that turns with the driven wheel, seen from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Key, Result, Shown

if TYPE_CHECKING:
    from collections.abc import Iterable

    from geartrain.dynamics.motion.motion_model import Motion
    from geartrain.teeth.transmission import SpeedLeap, TransmissionFunction


@dataclass(frozen=True)
class ToothImpact(Shown):
    """Collisions of the teeth of one pair, where its speed ratio leaps up: equation (7) of docs/motion.md.

    See Also
    --------
    geartrain.dynamics.find_tooth_impacts : gives these, by pair.
    """

    inertia: float
    """Of all that is struck, at the driven wheel [kg m^2]."""
    rate: float
    """Pitches passed a second [1/s]."""
    jumps: tuple[float, ...]
    """Jumps of the driven wheel's speed [rad/s], those of one pitch."""

    @property
    def power(self) -> float:
        """Power dissipated (W)."""
        return self.rate * sum(self.inertia * jump**2 / 2 for jump in self.jumps)


def find_impacts(motion: Motion, inertias: Mapping[str, float], speed: float) -> dict[str, ToothImpact]:
    """The collisions of every pair whose speed ratio leaps, the input turning at `speed` (rad/s).

    inertias   of links about their own axes (kg m2); links without one count as having none
    """
    spread = motion._propagation
    weight = np.array([inertias.get(link, 0.0) for link in spread.links])
    found = {}
    for source in motion._forward.sources:
        transmission = source.transmission
        leaps = transmission.speed_leaps()
        if leaps is None:
            continue
        unit = np.zeros((len(spread.pairs), 1))
        unit[source.pair] = 1.0
        struck = float(weight @ spread.errors(unit)[:, 0] ** 2)
        driver = abs(source.mean * speed)
        jumps = tuple(leap.size * driver for leap in leaps)
        found[source.id] = ToothImpact(struck, driver / transmission.period, jumps)
    return found


def collision_energies(leaps: Iterable[SpeedLeap], inertia: float, omega1: float) -> tuple[float, float, float]:
    """Energies of one pitch's collisions (J): handed to the driven side, dissipated, and their sum, the driver's work.

    J w1^2 (after^2 - before^2)/2 and J w1^2 (after - before)^2/2 for inelastic impacts, the driver at constant speed
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
    """What collisions of one pair cost, and where its law is void, as far as `PairOperation` tells; None elsewhere."""

    KEYS = (
        *("inertia", "rate", "handed", "dissipated", "work"),
        *(Key("load_to_stay_in_contact", "minimum_load"), Key("void_above", "void")),
    )

    inertia: float
    """kg m2, of all that turns with the driven wheel."""
    rate: float | None = None
    """Of the driver (turns per second)."""
    handed: float | None = None
    """Energy of one pitch (J) handed to the driven side; `dissipated`, and `work`, their sum."""
    dissipated: float | None = None
    """Energy of one pitch dissipated by collisions [J]."""
    work: float | None = None
    """Sum of the energies handed and dissipated in one pitch [J]."""
    minimum_load: float | None = None
    """Load torque (N m) that keeps the teeth in contact at this rate."""
    void: float | None = None
    """Driver's speed (turns per second) above which they part under the declared load."""


def find_pair_impacts(transmission: TransmissionFunction, operation: PairOperation) -> PairImpacts | None:
    """What collisions cost; None where no inertia is known, or the law has no account of its collisions."""
    inertia, load, omega1 = operation.inertia, operation.load, operation.omega1
    leaps, steepest = transmission.speed_leaps(), transmission.steepest_fall()
    if inertia is None or leaps is None or steepest is None:
        return None
    void = sqrt(load / (inertia * steepest)) / (2 * pi) if load is not None and steepest > 0 else None
    if omega1 is None:
        return PairImpacts(inertia, void=void)
    energies = collision_energies(leaps, inertia, omega1)
    return PairImpacts(inertia, operation.rate, *energies, minimum_load=inertia * omega1**2 * steepest, void=void)
