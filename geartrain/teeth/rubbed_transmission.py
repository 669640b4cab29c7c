"""Losses of a pair whose friction depends on the sliding speed or the pitch-line speed, for any tooth form."""

from __future__ import annotations

from functools import cached_property
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from geartrain.teeth.friction_law import PairFriction
from geartrain.teeth.transmission import ContactRubbing, SpeedLeap, TransmissionFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.meshing_wheels import MeshingWheels


class RubbedTransmission(TransmissionFunction):
    """Transmission function of a pair whose coefficient of friction depends on speed.

    The angles and the speed ratio are the same as in the given transmission function. Losses are computed at each
    contact: for the sliding speed v, the coefficient is mu(v), and the contact transmits the fraction (1 + mu out) / (1
    + mu into) of its power, with the friction terms of `ContactRubbing` (docs/shapes.md, section 15). Simultaneous
    contacts share the driver's torque equally.
    """

    def __init__(self, transmission: TransmissionFunction, by: PairFriction) -> None:
        self.transmission, self.by, self.ratio, self.period = transmission, by, transmission.ratio, transmission.period
        self.pitch_count, self.waves, self.slow = transmission.pitch_count, transmission.waves, transmission.slow
        self.dwell, self.at_once = transmission.dwell, transmission.at_once

    # ---------------------------------------------------------------------------------------------------- kinematics

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error of the underlying function [rad of the driven side] at angles S [rad]."""
        return self.transmission.error(S)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio of the underlying function at driver angles S [rad]."""
        return self.transmission.speed(S)

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum speed ratio of the underlying function."""
        return self.transmission.speed_range()

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and the maximum transmission error of the underlying function [rad of the driven side]."""
        return self.transmission.error_range()

    def error_moments(self) -> tuple[float, float]:
        """Return the mean and the rms deviation of the underlying transmission error [rad of the driven side]."""
        return self.transmission.error_moments()

    def kinks(self) -> list[float]:
        """Return the driver angles at which the underlying function has kinks [rad]."""
        return self.transmission.kinks()

    def smooth_intervals(self) -> list[tuple[float, float]]:
        """Return the intervals of driver angle [rad] in which the underlying function is smooth."""
        return self.transmission.smooth_intervals()

    def speed_leaps(self) -> tuple[SpeedLeap, ...] | None:
        """Return the upward steps of the speed ratio of the underlying function; None if they are not computed."""
        return self.transmission.speed_leaps()

    def steepest_fall(self) -> float | None:
        """Return the maximum rate of decrease of the underlying speed ratio [1/rad]; None if it is not known."""
        return self.transmission.steepest_fall()

    @property
    def locking_friction(self) -> float:
        """Minimum constant coefficient of friction at which the pair of the underlying function locks."""
        return self.transmission.locking_friction

    def reversed_motion(self) -> RubbedTransmission:
        """Return the transmission function of the coast flanks with the same friction law."""
        return RubbedTransmission(self.transmission.reversed_motion(), self.by)

    # ------------------------------------------------------------------------------------------------------- friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return sliding speeds and changes of power per unit friction coefficient of the underlying function."""
        return self.transmission.rubbing(S)

    def coefficient(self, S: ArrayLike) -> Floats:
        """Return the coefficient of friction at each contact; NaN where the teeth do not touch.

        S   driver angles [rad], any shape
        """
        return self.by(self.rubbing(S).sliding)

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad]; NaN where teeth do not touch or friction locks them."""
        rubbing = self.rubbing(S)
        return rubbing.efficiency(self.by(rubbing.sliding))

    @cached_property
    def friction(self) -> float:  # type: ignore[override]
        """Coefficient of friction, averaged over driver angles and contacts."""
        S, weights = self._nodes
        each = self.coefficient(S)
        touching = ~np.isnan(each).all(axis=0)
        return float(np.average(np.nanmean(each[:, touching], axis=0), weights=weights[touching]))

    @cached_property
    def locks(self) -> bool:
        """True if friction locks the pair at some driver angle."""
        S, _ = self._nodes
        # NaN without contact is not due to friction
        touching = ~np.isnan(self.rubbing(S).out).all(axis=0)
        return self.transmission.locking_friction < inf and bool(np.isnan(self.efficiency(S)[touching]).any())

    @cached_property
    def _nodes(self) -> tuple[Floats, Floats]:
        """Nodes [rad of the driver] and weights of the quadrature over one period."""
        # a coefficient that falls steeply with speed makes 1 / efficiency the most uneven integrand
        return self.graded_nodes(lambda S: 1 / self.efficiency(S))


def pair_friction(wheels: MeshingWheels) -> PairFriction | None:
    """Return the friction law of a pair at its pitch-line speed; None without a law or if the speed is unknown."""
    declared, at = wheels.friction_law, wheels.pitch_line
    return None if declared is None or at is None else PairFriction(declared, at)
