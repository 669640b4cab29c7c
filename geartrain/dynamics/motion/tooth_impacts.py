"""What the collisions of teeth cost, where the speed ratio leaps up: Carnot's theorem, equation (7) of docs/motion.md.

The input keeps its speed. A pair whose driven side jumps by one radian a second makes every link l jump by its response
g_l, so that side strikes with the inertia sum J_l g_l^2; an inelastic blow of a speed difference v takes half of it
times v^2. In an ordinary train that is the inertia of all that turns with the driven wheel, seen from it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.dynamics.motion.motion_model import Motion


@dataclass(frozen=True)
class ToothImpact:
    """Collisions of the teeth of one pair, where its speed ratio leaps up: equation (7) of docs/motion.md.

    Attributes
    ----------
    inertia : float
        Of all that is struck, at the driven wheel [kg m^2].
    rate : float
        Pitches passed a second [1/s].
    blows : tuple of float
        Jumps of the driven wheel's speed [rad/s], those of one pitch.

    See Also
    --------
    geartrain.dynamics.find_tooth_impacts : gives these, by pair.
    """

    inertia: float
    rate: float
    blows: tuple[float, ...]

    @property
    def power(self) -> float:
        """Power dissipated (W)."""
        return self.rate * sum(self.inertia * blow**2 / 2 for blow in self.blows)


def find_impacts(motion: Motion, inertias: Mapping[str, float], speed: float) -> dict[str, ToothImpact]:
    """The collisions of every pair whose speed ratio leaps, the input turning at `speed` (rad/s).

    inertias   of links about their own axes (kg m2); links without one count as having none
    """
    spread = motion.spread
    weight = np.array([inertias.get(link, 0.0) for link in spread.links])
    found = {}
    for source in motion.ahead.sources:
        law = source.law
        leaps = law.speed_leaps()
        if leaps is None:
            continue
        unit = np.zeros((len(spread.pairs), 1))
        unit[source.pair] = 1.0
        struck = float(weight @ spread.errors(unit)[:, 0] ** 2)
        driver = abs(source.mean * speed)
        blows = tuple(leap.size * driver for leap in leaps)
        found[source.id] = ToothImpact(struck, driver / law.period, blows)
    return found
