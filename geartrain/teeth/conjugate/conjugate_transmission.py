"""Conjugate gear pairs and their transmission function: a constant ratio with friction losses."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf, nan, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.results import Shown
from geartrain.teeth.conjugate.admissibility import faults, ring_tips
from geartrain.teeth.conjugate.path_losses import locking_friction, powers
from geartrain.teeth.pair_results import PairVerdict, ToothFault, verdict_of_faults
from geartrain.teeth.tooth_transmission import ToothTransmission
from geartrain.teeth.transmission import ContactRubbing, ExactRatio, check_friction

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.admissibility import Halves
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact

_TOUCH = 1e-12  # fraction of a pitch: smaller gaps between two contacts are rounding error


@dataclass(frozen=True, eq=False)
class ConjugatePair(Shown):
    """Conjugate gear pair at its design distance: path of contact, tooth thickness, and design faults.

    See Also
    --------
    geartrain.teeth.Involute : Like every conjugate form, it has methods `pair` and `pair_of_arcs` that return such a
    pair.
    """

    path: PathOfContact
    """Path of contact of the pair."""
    halves: Halves
    """Half-thicknesses of the teeth of gears 1 and 2, as arcs X on the pitch surface [module; rad for bevel gears]."""
    given: tuple[ToothFault, ...] | None = None
    """Complete list of design faults, if the tooth form determines this list; None if the faults follow from the path
    of contact and the tooth thickness.
    """
    extra: tuple[ToothFault, ...] = ()
    """Design faults other than those that follow from the path of contact and the tooth thickness."""
    solid: tuple[bool, bool] = (True, True)
    """Flag for gear 1 and for gear 2: True if the gear has teeth, False if it has round pins."""

    @cached_property
    def faults(self) -> tuple[ToothFault, ...]:
        """Design faults that prevent the pair from running; an empty tuple if the pair can run."""
        if self.given is not None:
            return self.given
        first, second = (half if solid else inf for half, solid in zip(self.halves, self.solid, strict=True))
        return (*self.extra, *faults(self.path, (first, second)), *ring_tips(self.path))

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess on the pitch surfaces, gear 1 driving [module; bevel: rad]; one may be < 0."""
        return self.path.arcs

    @property
    def backlash(self) -> float:
        """Circumferential backlash on the pitch surface [module; rad for bevel gears]; 0 within rounding error."""
        p = self.path.pitch.p
        found = p - 2 * sum(self.halves)
        return found if abs(found) > _TOUCH * p else 0.0


class ConjugateTransmission(ExactRatio, ToothTransmission):
    """Transmission function of a conjugate gear pair at its design distance.

    The speed ratio is constant. Tooth pairs in contact at the same time are assumed to share the driver's torque
    equally. The efficiency is therefore the mean of the efficiencies of these tooth pairs, which are exact functions of
    the friction coefficient. If the pair cannot run, the function describes the motion of the flanks without regard to
    interference. Its values are NaN where no flanks touch.

    Parameters
    ----------
    pair : ConjugatePair
        Pair at its design distance.
    friction : float
        Coefficient of friction, 0 or more.
    driver : {1, 2}
        Number of the driving gear.
    direction : {1, -1}
        Direction of rotation. With -1 the coast flanks are in contact, and the driven wheel is ahead by the backlash.

    See Also
    --------
    geartrain.teeth.Involute : Like every conjugate form, it has a method `transmission` that returns such a function.
    """

    def __init__(self, pair: ConjugatePair, friction: float = 0.0, driver: int = 1, direction: int = 1) -> None:
        self.pair, self.path, self.driver, self.direction = pair, pair.path, driver, direction
        self.friction = check_friction(friction)
        pitch = pair.path.pitch
        z1, z2 = int(pitch.teeth_of(driver)), int(pitch.teeth_of(3 - driver))
        self._backlash = pair.backlash / pitch.reach_of(3 - driver)
        # the coast flanks are ahead by the backlash
        super().__init__(Fraction(z1, z2), 2 * pi / z1, self._backlash if direction < 0 else 0.0)
        self._reach = pitch.reach_of(driver)
        self._half_tooth = pair.halves[driver - 1]

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict on the pair: either the pair runs, or a fault prevents it from running."""
        return verdict_of_faults(self.pair.faults, self._backlash)

    @property
    def distance(self) -> float:
        """Design centre distance [module]; for bevel pairs, the shaft angle [rad]."""
        return abs(self.path.pitch.R1 + self.path.pitch.R2)

    def _driven(self, driver: int, direction: int) -> ConjugateTransmission:
        return ConjugateTransmission(self.pair, self.friction, driver, direction)

    # ------------------------------------------------------------------------------------------------------- contacts

    @cached_property
    def _arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess of the driver on the pitch surfaces [module; rad for bevel gears]."""
        approach, recess = self.pair.arcs
        return (approach, recess) if self.driver == 1 else (recess, approach)

    def contacts(self, S: ArrayLike) -> Floats:
        """Return the arcs X from the pitch point to all tooth pairs in contact [module; rad for bevel gears]; negative
        in approach.

        Parameters
        ----------
        S : array_like
            Driver angles [rad], any shape.

        Returns
        -------
        ndarray
            Arcs, with an axis for the tooth pairs that can be in contact at the same time, followed by the axes of `S`;
            NaN for pairs without contact.
        """
        p, (approach, recess) = self.path.pitch.p, self._arcs
        ahead = self._half_tooth + approach + self.direction * self._reach * np.asarray(S, dtype=float)
        first = np.mod(ahead, p) - approach
        # a contact ratio that exceeds an integer only due to rounding needs no additional row
        rows = int(np.ceil((approach + recess) / p * (1 - _TOUCH)))
        X = np.stack([first + k * p for k in range(max(rows, 1))])
        # a contact just beyond the end due to rounding counts as the last contact
        slack = _TOUCH * p
        return np.where(recess + slack >= X, np.minimum(X, recess), nan)

    def kinks(self) -> list[float]:
        """Return the driver angles [rad] at which tooth pairs enter or leave contact, or pass a kink of their path."""
        sense, (approach, recess) = (1.0 if self.driver == 1 else -1.0), self._arcs
        joints = (0.0, *(sense * X for X in self.path.joints))
        cuts = {-approach, recess, *(X for X in joints if -approach < X < recess)}
        return sorted(self.direction * (X - self._half_tooth) / self._reach for X in cuts)

    # ------------------------------------------------------------------------------------------------------- friction

    def rubbing(self, S: ArrayLike) -> ContactRubbing:
        """Return the sliding speeds of all tooth pairs in contact at driver angles S [rad], and the changes of their
        input and output power per unit friction coefficient.

        The tooth pairs share the driver's torque equally.
        """
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
        """Minimum friction coefficient at which friction locks a tooth pair; infinite if no tooth pair can lock."""
        return locking_friction(self.path, self.driver)
