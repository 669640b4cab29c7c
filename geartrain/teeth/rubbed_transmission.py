"""Losses of a pair whose friction depends on the sliding speed or the pitch-line speed, for any tooth form."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import inf, nan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.teeth.friction_law import PairFriction
from geartrain.teeth.transmission import ContactRubbing, DerivedTransmission, TransmissionFunction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.meshing_wheels import MeshingWheels

_GAUSS = np.polynomial.legendre.leggauss(16)  # nodes and weights on [-1, 1]
_ROUNDING = 1e-12  # periods: tolerance of the integral over an interval
_MAXIMUM_DEPTH = 40  # bisections: a coefficient may fall within a small fraction of the sliding speeds
_END = 1e-9  # of an interval: distance from its ends at which the efficiency is evaluated for its minimum


class _Nodes(NamedTuple):
    """Quadrature nodes: driver angle [rad], weight, efficiency and mean coefficient of friction of each node."""

    S: Floats
    weights: Floats
    efficiency: Floats
    coefficient: Floats


class RubbedTransmission(DerivedTransmission):
    """Transmission function of a pair whose friction coefficient depends on speed.

    The angles and the speed ratio are the same as in the given transmission function. Losses are computed at each
    contact: for the sliding speed v, the coefficient is mu(v), and the contact transmits the fraction (1 + mu out) / (1
    + mu into) of its power (docs/shapes.md, section 15). Simultaneous contacts share the driver's torque equally.

    Parameters
    ----------
    transmission : TransmissionFunction
        Transmission function of the pair. Its own friction is ignored.
    by : PairFriction
        Friction law and pitch-line speed.

    Examples
    --------
    >>> from geartrain.teeth import Involute, PairFriction, StribeckFriction
    >>> friction = StribeckFriction(law="stribeck", static="0.2", kinetic="0.08", speed="10 mm/s")
    >>> rubbed = RubbedTransmission(Involute(form="involute").transmission(24, 36), PairFriction(friction, 0.05))
    >>> round(rubbed.friction, 4), round(rubbed.efficiency_mean(), 4)
    (0.1512, 0.9811)
    """

    def __init__(self, transmission: TransmissionFunction, by: PairFriction) -> None:
        super().__init__(transmission)
        self.by = by

    # ---------------------------------------------------------------------------------------------------- kinematics

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission error of the underlying function at driver angles S [rad]."""
        return self.transmission.error(S)

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratio of the underlying function at driver angles S [rad]."""
        return self.transmission.speed(S)

    def reversed_motion(self) -> RubbedTransmission:
        """Return the transmission function of the coast flanks with the same friction law."""
        return RubbedTransmission(self.transmission.reversed_motion(), self.by)

    # ------------------------------------------------------------------------------------------------------- friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return sliding speeds and friction terms of the underlying function at driver angles S [rad]."""
        return self.transmission.rubbing(S)

    def coefficient(self, S: ArrayLike) -> Floats:
        """Return the coefficient of friction at each contact; NaN without contact.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.
        """
        return self.by(self.rubbing(S).sliding)

    def efficiency(self, S: ArrayLike) -> Floats:
        """Return the efficiency at driver angles S [rad]; NaN without contact, or if friction locks the teeth."""
        return self._contact_means(self.rubbing(S))[0]

    def _contact_means(self, rubbing: ContactRubbing) -> tuple[Floats, Floats]:
        """Return the mean efficiency and the mean coefficient of friction of simultaneous contacts.

        Both are NaN without a contact. The efficiency is NaN if one of the contacts locks.
        """
        sliding, into, out = rubbing
        mu = self.by(sliding)
        touching = ~np.isnan(out)
        with np.errstate(divide="ignore", invalid="ignore"):
            into, out = 1 + mu * into, 1 + mu * out
            # a factor of 0 or less means that friction absorbs all power of the contact
            each = np.where(touching, np.where((out > 0) & (into > 0), out / into, nan), 0.0)
            count = touching.sum(axis=0)
            return each.sum(axis=0) / count, np.where(touching, mu, 0.0).sum(axis=0) / count

    @property
    def friction(self) -> float:  # type: ignore[override]
        """Coefficient of friction, averaged over driver angle and contacts."""
        return float(self._period_nodes.weights @ self._period_nodes.coefficient)

    @property
    def locks(self) -> bool:
        """True if friction locks the pair at some driver angle."""
        # NaN of a pair that no constant friction locks is not due to friction
        return self.transmission.locking_friction < inf and bool(np.isnan(self._period_nodes.efficiency).any())

    @cached_property
    def _period_nodes(self) -> _Nodes:
        """Quadrature nodes of one period with contact; their weights sum to 1."""
        if (given := self.transmission.rubbing_nodes()) is not None:
            S, weights, rubbing = given
            parts = [_Nodes(S, weights, *self._contact_means(rubbing))]
        else:
            parts = [
                part
                for low, high in self.smooth_intervals()
                for part in self._adaptive_nodes(self._nodes(low, high), low, high)
            ]
        S, weights, efficiency, coefficient = (np.concatenate(column) for column in zip(*parts, strict=True))
        touching = ~np.isnan(coefficient)
        weights = weights[touching]
        return _Nodes(S[touching], weights / weights.sum(), efficiency[touching], coefficient[touching])

    def _adaptive_nodes(self, whole: _Nodes, low: float, high: float, depth: int = 0) -> Iterator[_Nodes]:
        """Yield quadrature nodes of one interval by adaptive Gauss-Legendre quadrature.

        The interval is bisected, at most 40 times, until the integral of 1/efficiency is accurate to 1e-12 periods.
        """
        middle = (low + high) / 2
        ends = ((low, middle), (middle, high))
        halves = [self._nodes(*each) for each in ends]
        off = sum(half.weights @ (1 / half.efficiency) for half in halves) - whole.weights @ (1 / whole.efficiency)
        # NaN at a dwell or where friction locks, which finer nodes do not change
        if not abs(off) > _ROUNDING * self.period or depth == _MAXIMUM_DEPTH:
            yield from halves
            return
        for half, each in zip(halves, ends, strict=True):
            yield from self._adaptive_nodes(half, *each, depth + 1)

    def _nodes(self, low: float, high: float) -> _Nodes:
        x, w = _GAUSS
        S = (low + high) / 2 + (high - low) / 2 * x
        return _Nodes(S, (high - low) / 2 * w, *self._contact_means(self.rubbing(S)))

    def efficiency_mean(self) -> float:
        """Return the mean efficiency over the driver angles with contact, at constant driver torque; NaN if friction
        locks the teeth.
        """
        return nan if self.locks else float(self._period_nodes.weights @ self._period_nodes.efficiency)

    def efficiency_at_constant_load(self) -> float:
        """Return work output divided by work input over one pitch at constant load torque; NaN if friction locks the
        teeth.
        """
        if self.locks:
            return nan
        speed, at = self.speed(self._period_nodes.S), self._period_nodes
        return float((at.weights @ speed) / (at.weights @ (speed / at.efficiency)))

    def efficiency_minimum(self) -> float:
        """Return the minimum efficiency at nodes and ends of all smooth intervals; NaN if friction locks the teeth."""
        if self.locks:
            return nan
        if self.transmission.rubbing_nodes() is not None:
            return float(self._period_nodes.efficiency.min())
        # at the end itself another tooth pair may be in contact, or the contact be on the other side of the pitch point
        ends = np.array(
            [low + share * (high - low) for low, high in self.smooth_intervals() for share in (_END, 1 - _END)]
        )
        return float(min(np.nanmin(self.efficiency(ends)), self._period_nodes.efficiency.min()))


def rubbed(transmission: TransmissionFunction, wheels: MeshingWheels) -> TransmissionFunction:
    """Return the transmission function with the losses of the declared friction law.

    The function is returned unchanged if no friction law is declared or the pitch-line speed is unknown.
    """
    by = pair_friction(wheels)
    return transmission if by is None else RubbedTransmission(transmission, by)


def pair_friction(wheels: MeshingWheels) -> PairFriction | None:
    """Return the friction law of a pair at its pitch-line speed; None without a friction law or if the speed is
    unknown.
    """
    declared, at = wheels.friction_law, wheels.pitch_line
    return None if declared is None or at is None else PairFriction(declared, at)
