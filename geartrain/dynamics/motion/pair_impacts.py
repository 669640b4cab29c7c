"""Energy of tooth impacts of a pair, and the speed above which its quasi-static transmission function is invalid.

If the speed of a pair's driven link jumps by 1 rad/s while the input keeps its speed, the speed of every link l jumps
by its response g_l. The effective inertia is J = sum J_l g_l^2, and an inelastic impact with the speed difference v
dissipates J v^2/2 (Carnot's theorem, equation (7) of docs/motion.md).
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
    """Impacts of the teeth of one pair where its speed ratio increases abruptly, equation (7) of docs/motion.md."""

    inertia: float
    """Effective inertia at the driven wheel [kg m^2]."""
    rate: float
    """Frequency of the periods of the transmission function [1/s]; a period is one pitch, or that of tabulated data."""
    jumps: tuple[float, ...]
    """Increase of the driven wheel's speed at each impact within one period [rad/s]."""

    @property
    def power(self) -> float:
        """Power that is dissipated by the impacts of the teeth [W]."""
        return self.rate * sum(self.inertia * jump**2 / 2 for jump in self.jumps)


def find_impacts(motion: Motion, inertias: Mapping[str, float], speed: float) -> dict[str, ToothImpact]:
    """Return the impacts of every pair whose speed ratio increases abruptly, by name, at an input speed of `speed`
    [rad/s].

    inertias   moment of inertia of links about their own axes [kg m2], by link; it is 0 for links that are not included
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
        # effective inertia: sum of J g^2 for a unit jump of the driven side
        struck = float(weight @ spread.errors(unit)[:, 0] ** 2)
        driver = abs(source.mean * speed)
        jumps = tuple(leap.size * driver for leap in leaps)
        found[source.id] = ToothImpact(struck, driver / transmission.period, jumps)
    return found


def collision_energies(leaps: Iterable[SpeedLeap], inertia: float, omega1: float) -> tuple[float, float, float]:
    """Return the energies of the impacts in one pitch [J]: the energy transferred to the driven wheel, the dissipated
    energy, and their sum.

    inertia   moment of inertia J of the driven wheel and all links that it drives [kg m2]
    omega1    constant speed of the driver [rad/s]

    For an inelastic impact with the speed ratios `before` and `after`, the transferred energy is J omega1^2 (after^2 -
    before^2)/2, and the dissipated energy is J omega1^2 (after - before)^2/2. Sorge's paper on triangular teeth uses
    the former as the lost energy, but the lost energy is the latter.
    """
    leaps, scale = tuple(leaps), inertia * omega1**2
    handed = sum((leap.after**2 - leap.before**2) / 2 for leap in leaps) * scale
    dissipated = sum(leap.size**2 / 2 for leap in leaps) * scale
    return handed, dissipated, handed + dissipated


@dataclass(frozen=True)
class PairOperation:
    """Operating data of a pair: moment of inertia [kg m2] and load torque [N m] at the driven wheel, and speed of the
    driver [revolutions/s]. Unknown values are None.
    """

    inertia: float | None = None
    rate: float | None = None
    load: float | None = None

    @property
    def omega1(self) -> float | None:
        """Speed of the driver [rad/s]; None if it is unknown."""
        return None if self.rate is None else 2 * pi * self.rate


@dataclass(frozen=True)
class PairImpacts(Result):
    """Impact energies of one pair, and limits up to which its teeth stay in contact. Values for which `PairOperation`
    lacks data are None.
    """

    KEYS = (
        *("inertia", "rate", "handed", "dissipated", "work"),
        *(Key("load_to_stay_in_contact", "minimum_load"), Key("void_above", "void")),
    )

    inertia: float
    """Moment of inertia of the driven wheel and all links that it drives [kg m2]."""
    rate: float | None = None
    """Speed of the driver [revolutions/s]."""
    handed: float | None = None
    """Energy transferred to the driven wheel by impacts in one pitch [J]."""
    dissipated: float | None = None
    """Energy dissipated by impacts in one pitch [J]."""
    work: float | None = None
    """Work of the driver in the impacts of one pitch [J], the sum of transferred and dissipated energy."""
    minimum_load: float | None = None
    """Minimum load torque at which the teeth remain in contact at the given speed [N m]."""
    void: float | None = None
    """Speed of the driver above which the teeth separate under the declared load [revolutions/s]."""


def find_pair_impacts(transmission: TransmissionFunction, operation: PairOperation) -> PairImpacts | None:
    """Return the impact energies of a pair; None if its inertia or the jumps of its speed ratio are unknown."""
    inertia, load, omega1 = operation.inertia, operation.load, operation.omega1
    leaps, steepest = transmission.speed_leaps(), transmission.steepest_fall()
    if inertia is None or leaps is None or steepest is None:
        return None
    # at this speed the inertia torque J w^2 s equals the load torque
    void = sqrt(load / (inertia * steepest)) / (2 * pi) if load is not None and steepest > 0 else None
    # the limiting speed does not depend on the speed of operation
    if omega1 is None:
        return PairImpacts(inertia, void=void)
    energies = collision_energies(leaps, inertia, omega1)
    return PairImpacts(inertia, operation.rate, *energies, minimum_load=inertia * omega1**2 * steepest, void=void)
