"""Friction that is in force at a pair or coupling, as numbers: while it slides, at rest, and how far it is in doubt."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.teeth.coulomb_friction import CoulombFriction

if TYPE_CHECKING:
    from geartrain.teeth.friction_law import FrictionLaw


@dataclass(frozen=True, slots=True)
class FrictionInForce:
    """Friction in force at a gear pair or a coupling.

    Attributes
    ----------
    sliding : float or None
        Coefficient while surfaces slide; None where it follows a law of speed.
    static : float
        Coefficient at rest; that of a law is its value at speed 0.
    deviation : float
        Standard deviation of `sliding`; `static` keeps its ratio to it.
    law : FrictionLaw or None
        The law of speed, where one is declared.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("moon-triangular").declaration
    >>> train.friction_of(train.gears[0])
    FrictionInForce(sliding=0.2, static=0.2, deviation=0.0, law=None)
    """

    sliding: float | None
    static: float
    deviation: float = 0.0
    law: FrictionLaw | None = None

    @property
    def rubs(self) -> bool:
        """True for a law, and for a coefficient above 0."""
        return self.law is not None or bool(self.sliding) or self.static > 0


def friction_in_force(declared: CoulombFriction | FrictionLaw | None) -> FrictionInForce | None:
    """A declared friction as numbers."""
    if declared is None:
        return None
    if not isinstance(declared, CoulombFriction):
        return FrictionInForce(None, declared.at_rest, law=declared)
    sliding = float(declared.sliding.value)
    static = sliding if declared.static is None else float(declared.static.value)
    return FrictionInForce(sliding, static, 0.0 if declared.deviation is None else float(declared.deviation.value))
