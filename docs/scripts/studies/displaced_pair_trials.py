"""Hand-cut pairs with a path of contact, judged many at once and one by one, angle by angle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import lcm, pi

import numpy as np

from geartrain.teeth import Cycloidal, Involute
from geartrain.teeth.conjugate.displaced_contact import displaced_contact
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.workshop.cutting.displaced_pair import DisplacedPair, DisplacedWheel
from geartrain.workshop.cutting.meshing_cycle import MeshingVerdicts

FORMS = {
    "involute": Involute(form="involute", backlash="0.3"),
    "cycloidal": Cycloidal(form="cycloidal", backlash="0.3"),
}
PITCH_ERROR, ECCENTRICITY = 0.01, 0.02
"""Standard deviations: of a pitch, and in modules."""
_ANGLES = 16  # of a pitch at which the loop looks


@dataclass(frozen=True)
class DisplacedBatch:
    """Wheels of one pair, drawn once and judged in two ways."""

    form: str
    z1: int
    z2: int
    trials: int
    seed: int = 1

    @property
    def name(self) -> str:
        """`involute 64/38`."""
        return f"{self.form} {self.z1}/{self.z2}"

    @property
    def pitches(self) -> int:
        """Tooth pitches of a full cycle: one trial."""
        return lcm(self.z1, self.z2)

    @cached_property
    def pair(self) -> DisplacedPair:
        """The wheels, (trials, z) each."""
        contact = displaced_contact(FORMS[self.form].pair(WheelPair(self.z1, self.z2)), 1)
        rng = np.random.default_rng(self.seed)
        wheels = [self._drawn(z, rng) for z in (self.z1, self.z2)]
        return DisplacedPair(contact, wheels[0], wheels[1])

    def _drawn(self, z: int, rng: np.random.Generator) -> DisplacedWheel:
        return replace(
            DisplacedWheel.even(z),
            place=rng.normal(0, PITCH_ERROR * 2 * pi / z, (self.trials, z)),
            e=rng.normal(0, ECCENTRICITY, self.trials),
            towards=rng.uniform(0, 2 * pi, self.trials),
        )

    def together(self) -> MeshingVerdicts:
        """All trials at once."""
        return self.pair.verdicts()

    def singly(self, trials: int) -> list[float]:
        """The least play of the first trials (rad), each by the law of every couple at many angles of the cycle."""
        S = np.arange(_ANGLES * self.pitches) * (2 * pi / self.z1 / _ANGLES)
        return [self._minimum(np.full(len(S), at), S) for at in range(trials)]

    def _minimum(self, rows: np.ndarray, S: np.ndarray) -> float:
        lag, lead = self.pair.minimum_lag(rows, S)[0], self.pair.minimum_lag(rows, S, back=True)[0]
        return float((lag + lead).min() + self.pair.contact.backlash)

    def compared(self, found: MeshingVerdicts, singly: list[float]) -> tuple[float, int]:
        """Greatest difference of a play (pitches of the driven wheel), and trials of which only one way jams."""
        backlash = np.array(singly)
        own = found.backlash[: len(singly)]
        return float(np.abs(backlash - own).max() / self.pair.contact.pitches[1]), int(
            ((backlash < 0) != (own < 0)).sum()
        )
