"""Pairs of conjugate teeth and their transmission function: the exact ratio at every instant, with friction losses."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from math import inf, nan, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown
from geartrain.teeth.conjugate.admissibility import faults, ring_tips
from geartrain.teeth.conjugate.path_losses import efficiency, locking_friction, powers
from geartrain.teeth.pair_results import PairVerdict, ToothFault, verdict_of_faults
from geartrain.teeth.transmission import ContactRubbing, ExactRatio, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.admissibility import Halves
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

# 8 nodes leave 1e-11 on usual teeth and 16 rounding: twice that for steep ones
_GAUSS = np.polynomial.legendre.leggauss(32)
_NARROW = 1e-13  # of a period: a stretch that is none
_TOUCH = 1e-12  # of a pitch: a gap between two contacts that is rounding


@dataclass(frozen=True, eq=False)
class ConjugatePair(Shown):
    """Two wheels at their design distance: path of contact, thickness of their teeth, and why they cannot run.

    See Also
    --------
    geartrain.teeth.Involute : every conjugate form has methods `pair` and `pair_of_arcs` that give it.
    """

    path: PathOfContact
    """Where they touch."""
    halves: Halves
    """Half the thickness of a tooth of each gear on its pitch surface, as X."""
    given: tuple[ToothFault, ...] | None = None
    """All faults, where they do not follow from path and thickness."""
    extra: tuple[ToothFault, ...] = ()
    """Faults besides those that follow from path and thickness."""
    solid: tuple[bool, bool] = (True, True)
    """False for a gear whose teeth are round pins."""

    @cached_property
    def faults(self) -> tuple[ToothFault, ...]:
        """All reasons why the pair cannot run; empty if it can."""
        if self.given is not None:
            return self.given
        first, second = (half if solid else inf for half, solid in zip(self.halves, self.solid, strict=True))
        return (*self.extra, *faults(self.path, (first, second)), *ring_tips(self.path))

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess (X) in which the teeth really touch; one may be negative."""
        return self.path.arcs

    @property
    def backlash(self) -> float:
        """Play as X."""
        p = self.path.pitch.p
        found = p - 2 * sum(self.halves)
        return found if abs(found) > _TOUCH * p else 0.0


class ConjugateTransmission(ExactRatio):
    """The transmission function of a pair of conjugate teeth at its design distance.

    The ratio is exact at every instant. Pairs of teeth in contact at once take equal shares of the driver's torque, so
    that the efficiency is the mean of theirs, each exact in friction. The function of a pair that cannot run is what
    its flanks alone would do, NaN where none touch.

    Parameters
    ----------
    pair : ConjugatePair
        The two wheels.
    friction : float
        Coefficient of friction, 0 or more.
    driver : {1, 2}
        The gear that drives.
    direction : {1, -1}
        -1 turns backwards: the other flanks drive, mirror images of the first, and the driven wheel is ahead by the
        backlash.

    See Also
    --------
    geartrain.teeth.Involute : every conjugate form has a method `transmission` that gives it.
    """

    def __init__(self, pair: ConjugatePair, friction: float = 0.0, driver: int = 1, direction: int = 1) -> None:
        self.pair, self.path, self.driver, self.direction = pair, pair.path, driver, direction
        self.friction = check_friction(friction)
        pitch = pair.path.pitch
        z1, z2 = int(pitch.teeth_of(driver)), int(pitch.teeth_of(3 - driver))
        super().__init__(Fraction(z1, z2), 2 * pi / z1)
        self._reach = pitch.reach_of(driver)
        self._backlash = pair.backlash / pitch.reach_of(3 - driver)
        self._ahead = self._backlash if direction < 0 else 0.0
        self._lead = pair.halves[driver - 1]

    @cached_property
    def verdict(self) -> PairVerdict:
        """Whether the pair can run."""
        return verdict_of_faults(self.pair.faults, self._backlash)

    @property
    def distance(self) -> float:
        """Of the axles as designed (modules); without meaning on cones."""
        return abs(self.path.pitch.R1 + self.path.pitch.R2)

    @property
    def reversed(self) -> ConjugateTransmission:
        """The law with the other wheel driving."""
        return ConjugateTransmission(self.pair, self.friction, 3 - self.driver, self.direction)

    def reversed_motion(self) -> ConjugateTransmission:
        """The law of the other flanks; angles keep their sense and decrease."""
        return ConjugateTransmission(self.pair, self.friction, self.driver, -self.direction)

    # ---------------------------------------------------------------------------------------------------- kinematics

    def error(self, S: ArrayLike) -> Floats:
        """0 rad of the driven wheel everywhere; the play where the other flanks drive."""
        return self._constant(S, self._ahead)

    def error_range(self) -> tuple[float, float]:
        """The constant error twice."""
        return self._ahead, self._ahead

    def error_moments(self) -> tuple[float, float]:
        """The constant error, and 0."""
        return self._ahead, 0.0

    @cached_property
    def _arcs(self) -> tuple[float, float]:
        """The driver's approach and recess (X)."""
        approach, recess = self.pair.arcs
        return (approach, recess) if self.driver == 1 else (recess, approach)

    def contacts(self, S: ArrayLike) -> Floats:
        """Displacements X from the pitch point of all pairs of teeth in contact, negative in the driver's approach.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            One row for each pair that can be in contact at once, S's shape after it; NaN where there is none.
        """
        p, (approach, recess) = self.path.pitch.p, self._arcs
        ahead = self._lead + approach + self.direction * self._reach * np.asarray(S, dtype=float)
        first = np.mod(ahead, p) - approach
        # a contact ratio that is whole but for rounding needs no row more
        rows = int(np.ceil((approach + recess) / p * (1 - _TOUCH)))
        X = np.stack([first + k * p for k in range(max(rows, 1))])
        # a contact that rounding puts just beyond the last one is that one
        slack = _TOUCH * p
        return np.where(recess + slack >= X, np.minimum(X, recess), nan)

    def kinks(self) -> list[float]:
        """Driver angles (rad) at which a pair of teeth meets, parts or passes a corner of its path."""
        approach, recess = self.path.approach, self.path.recess
        if self.driver == 2:
            approach, recess = recess, approach
        joints = {0.0}
        for side, sign in ((approach, -1.0), (recess, 1.0)):
            joints |= {sign * float(side.travel(np.array(d))) for d in side.joints}
        first, last = -self._arcs[0], self._arcs[1]
        cuts = {first, last, *(X for X in joints if first < X < last)}
        return sorted(self.direction * (X - self._lead) / self._reach for X in cuts)

    # ------------------------------------------------------------------------------------------------------- friction

    def efficiency(self, S: ArrayLike) -> Floats:
        """Power out over power in at driver angles S (rad); NaN where nothing touches or friction locks."""
        X = self.contacts(S)
        touching = ~np.isnan(X)
        each = np.zeros(X.shape)
        at = X[touching] if self.driver == 1 else -X[touching]
        each[touching] = efficiency(self.path.pitch, self.path.at(at), self.friction, self.driver) if at.size else 0.0
        count = touching.sum(axis=0)
        with np.errstate(invalid="ignore"):
            found: Floats = np.where(count > 0, each.sum(axis=0) / np.maximum(count, 1), nan)
        return found

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Of all pairs of teeth in contact, which take equal shares of the driver's torque."""
        pitch, X = self.path.pitch, self.contacts(S)
        touching = ~np.isnan(X)
        found = [np.full(X.shape, nan) for _ in range(3)]
        if touching.any():
            contact = self.path.at(X[touching] if self.driver == 1 else -X[touching])
            shares = (power / contact.cos_psi - 1 for power in powers(pitch, contact, 1.0, self.driver))
            values = ((pitch.A + pitch.B) * np.abs(pitch.S(contact.d)), *shares)
            for each, value in zip(found, values, strict=True):
                each[touching] = value
        return ContactRubbing(*found)

    @cached_property
    def locking_friction(self) -> float:
        """The least friction at which some contact locks; infinite where none does."""
        return locking_friction(self.path, self.driver)

    @cached_property
    def _stretches(self) -> list[tuple[float, float]]:
        """The smooth stretches of one period, in driver angle."""
        cuts = sorted({float(np.mod(kink, self.period)) for kink in self.kinks()})
        edges = pairwise([*cuts, cuts[0] + self.period])
        return [(low, high) for low, high in edges if high - low > _NARROW * self.period]

    @cached_property
    def _sampled(self) -> tuple[Floats, Floats]:
        """Efficiency at quadrature nodes of a whole period, and their weights; without the gaps."""
        x, w = _GAUSS
        S = np.concatenate([(low + high) / 2 + (high - low) / 2 * x for low, high in self._stretches])
        weights = np.concatenate([(high - low) / 2 * w for low, high in self._stretches])
        found = self.efficiency(S)
        touching = ~np.isnan(found)
        return found[touching], weights[touching] / weights[touching].sum()

    @property
    def _locks(self) -> bool:
        return self.friction >= self.locking_friction

    def efficiency_mean(self) -> float:
        """Mean over the driver's angle in contact at constant driver torque; NaN where friction locks."""
        if self._locks:
            return nan
        found, weights = self._sampled
        return float(weights @ found)

    def efficiency_at_constant_load(self) -> float:
        """Work done on a constant load torque over the work put in, per pitch; NaN where friction locks."""
        if self._locks:
            return nan
        found, weights = self._sampled
        return 1 / float(weights @ (1 / found))

    def efficiency_minimum(self) -> float:
        """Least efficiency: at an end of a stretch, or within, looked for with two hundred samples each."""
        if self._locks:
            return nan
        # at an end itself another pair of teeth is in contact, or the other side of the pitch point
        inside = np.linspace(1e-9, 1 - 1e-9, 201)
        S = np.concatenate([low + (high - low) * inside for low, high in self._stretches])
        return float(np.nanmin(self.efficiency(S)))
