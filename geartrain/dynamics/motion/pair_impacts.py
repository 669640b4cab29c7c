"""Energy of tooth impacts of a pair, and the speed above which its quasi-static transmission function is invalid.

Let the speed ratio tau fall at a rate s = max(-d tau / dS). The driven inertia J stays in contact at the driver's speed
w if the load torque is at least J w^2 s. Under a load T contact is lost above w = sqrt(T / (J s)).

In a train (Carnot's theorem, equation (7) of docs/motion.md) the input keeps its speed. If the driven side of a pair
jumps by one radian a second, every link l jumps by its response g_l, so the effective inertia of that side is
sum J_l g_l^2. An inelastic impact with the speed difference v dissipates half of it times v^2. In an ordinary train the
effective inertia is that of all that turns with the driven wheel, referred to it.
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
    """Impacts of the teeth of one pair, where its speed ratio jumps up: equation (7) of docs/motion.md.

    See Also
    --------
    geartrain.dynamics.find_tooth_impacts : Returns these by pair.
    """

    inertia: float
    """Effective inertia at the driven wheel [kg m^2]."""
    rate: float
    """Pitches per second [1/s]."""
    jumps: tuple[float, ...]
    """Jumps of the driven wheel's speed within one pitch [rad/s]."""

    @property
    def power(self) -> float:
        """Power dissipated [W]."""
        return self.rate * sum(self.inertia * jump**2 / 2 for jump in self.jumps)


def find_impacts(motion: Motion, inertias: Mapping[str, float], speed: float) -> dict[str, ToothImpact]:
    """Return the impacts of every pair whose speed ratio jumps, by name, for an input speed of `speed` [rad/s].

    inertias   of links about their own axes [kg m2], 0 for other links
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
    """Return energies of the impacts in one pitch [J]: transferred to the driven side, dissipated, and their sum.

    They are J w1^2 (after^2 - before^2)/2 and J w1^2 (after - before)^2/2 for inelastic impacts. The driver has the
    constant speed omega1 [rad/s], so the sum is its work. J is the `inertia` of all that turns with the driven wheel
    [kg m2]. The source of triangular teeth counts the first term as lost; the energy actually lost is the second.
    """
    leaps, scale = tuple(leaps), inertia * omega1**2
    handed = sum((leap.after**2 - leap.before**2) / 2 for leap in leaps) * scale
    dissipated = sum(leap.size**2 / 2 for leap in leaps) * scale
    return handed, dissipated, handed + dissipated


@dataclass(frozen=True)
class PairOperation:
    """Known operating data of a pair in SI units. `rate` is that of the driver in turns per second."""

    inertia: float | None = None
    rate: float | None = None
    load: float | None = None

    @property
    def omega1(self) -> float | None:
        """Speed of the driver [rad/s]."""
        return None if self.rate is None else 2 * pi * self.rate


@dataclass(frozen=True)
class PairImpacts(Result):
    """Impact energies of one pair and limits of its contact. Figures are None if `PairOperation` lacks their data."""

    KEYS = (
        *("inertia", "rate", "handed", "dissipated", "work"),
        *(Key("load_to_stay_in_contact", "minimum_load"), Key("void_above", "void")),
    )

    inertia: float
    """Inertia of all that turns with the driven wheel [kg m2]."""
    rate: float | None = None
    """Speed of the driver [turns per second]."""
    handed: float | None = None
    """Energy transferred to the driven side in one pitch [J]."""
    dissipated: float | None = None
    """Energy dissipated by impacts in one pitch [J]."""
    work: float | None = None
    """Work of the driver in one pitch [J]: sum of the energies transferred and dissipated."""
    minimum_load: float | None = None
    """Load torque that keeps the teeth in contact at this speed [N m]."""
    void: float | None = None
    """Driver's speed above which the teeth separate under the declared load [turns per second]."""


def find_pair_impacts(transmission: TransmissionFunction, operation: PairOperation) -> PairImpacts | None:
    """Return the impact energies of a pair, or None if its inertia or its speed jumps are unknown."""
    inertia, load, omega1 = operation.inertia, operation.load, operation.omega1
    leaps, steepest = transmission.speed_leaps(), transmission.steepest_fall()
    if inertia is None or leaps is None or steepest is None:
        return None
    void = sqrt(load / (inertia * steepest)) / (2 * pi) if load is not None and steepest > 0 else None
    if omega1 is None:
        return PairImpacts(inertia, void=void)
    energies = collision_energies(leaps, inertia, omega1)
    return PairImpacts(inertia, operation.rate, *energies, minimum_load=inertia * omega1**2 * steepest, void=void)
