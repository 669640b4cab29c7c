"""The motion of whole trains in 40 digits, from the definitions of the laws: what composition is judged by."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.bench.mesh_truth import Exact, Long, Multiple
from geartrain.dynamics.motion import Motion, PairErrorSource
from geartrain.numerics.exact import LinearForm, eliminate
from geartrain.teeth.pin_transmission import PinToSlotTransmission
from geartrain.teeth.transmission import TransmissionFunction
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

Floats = NDArray[np.float64]
_SETTLED = 1e-25  # rad: far below what a float resolves, far above what 40 digits do


class Truth:
    """Errors of the outputs in 40 digits (the longest floats without mpmath).

    Teeth answer from the contact of one couple, as in the benchmark of meshes, pins from their triangle. How errors
    spread is solved exactly from all rows of the train at once. Each pair is asked at the angle that the errors of all
    pairs give its driver, again and again until nothing changes.
    """

    def __init__(self, motion: Motion) -> None:
        self.real: Any = Multiple() if find_spec("mpmath") else Long()
        self.settled = _SETTLED if find_spec("mpmath") else 1e-18
        self.motion, self.sources = motion, motion.ahead.used
        self.laws = [self._law(source.law) for source in self.sources]
        errors = self._spread()
        self.gains = [self._gain(source, errors) for source in self.sources]
        ends = motion.ahead.outputs
        self.responses = [self._terms({of: 1, base: -1}, errors) for of, base in ends]

    def _law(self, law: TransmissionFunction) -> Callable[[Any], Any]:
        if isinstance(law, TriangularTransmission) and law.direction > 0:
            return _Teeth(law.sizes, self.real).error
        assert isinstance(law, PinToSlotTransmission)
        return partial(_slot_error, self.real, self.real.number(law.r), self.real.number(law.e))

    def _spread(self) -> dict[int, LinearForm]:
        """Every link's error as a sum over the errors of the sources, by -1 less their number, exactly."""
        system, spread = self.motion.train.system, self.motion.spread
        at = {link: number for number, link in enumerate(system.links)}
        own = {source.id: number for number, source in enumerate(self.sources)}
        forms: list[LinearForm] = []
        for row in system.equations:
            form = {at[link]: Fraction(coefficient) for link, coefficient in row.terms}
            if row.label in own:
                joint = spread.joints[self.sources[own[row.label]].pair]
                form[-1 - own[row.label]] = Fraction(-joint.coefficient)
            forms.append(form)
        return dict(eliminate(forms).forms())

    def _terms(self, links: dict[int, int], errors: dict[int, LinearForm]) -> list[tuple[int, Any]]:
        """A signed sum of links' errors, as sources with their factors."""
        total: dict[int, Fraction] = {}
        for link, sign in links.items():
            for symbol, factor in errors[link].items():
                total[-1 - symbol] = total.get(-1 - symbol, Fraction(0)) + sign * factor
        number = self.real.number
        return [(at, number(each.numerator) / number(each.denominator)) for at, each in total.items() if each]

    def _gain(self, source: PairErrorSource, errors: dict[int, LinearForm]) -> list[tuple[int, Any]]:
        joint = self.motion.spread.joints[source.pair]
        links = {joint.driver: source.forward * source.driver_sense}
        links[joint.carrier] = links.get(joint.carrier, 0) - source.forward * source.carrier_sense
        return self._terms(links, errors)

    def off(self, turns: float, found: Floats) -> list[float]:
        """What errors found at some turns of the input differ by (rad), by output."""
        deltas = self._deltas(Fraction(turns))
        truth = [sum((factor * deltas[at] for at, factor in row), self.real.number(0)) for row in self.responses]
        return [float(self.real.number(float(each)) - true) for each, true in zip(found, truth, strict=True)]

    def _deltas(self, turns: Fraction) -> list[Any]:
        """Errors of all pairs, in the order of the train: where none hangs on itself one pass is enough."""
        number = self.real.number
        stands = [self._stands(source, turns) for source in self.sources]
        deltas = [number(0)] * len(stands)
        last: list[Any] = [None] * len(stands)
        changed = True
        while changed:
            changed = False
            for at, source in enumerate(self.sources):
                S = stands[at] + sum((factor * deltas[other] for other, factor in self.gains[at]), number(0))
                if last[at] is not None and abs(S - last[at]) < self.settled:
                    continue
                deltas[at], last[at], changed = source.sense * self.laws[at](S), S, True
        return deltas

    def _stands(self, source: PairErrorSource, turns: Fraction) -> Any:
        """The driver's forward angle (rad, whole turns left out) in mean motion."""
        joint, train = self.motion.spread.joints[source.pair], self.motion.train
        links = train.system.links
        part = abs(train.relative(links[joint.driver], links[joint.carrier])) * turns % 1
        number = self.real.number
        return 2 * self.real.pi * number(part.numerator) / number(part.denominator) + number(source.start)


class _Teeth(Exact):
    """The definition of the law of triangular teeth at angles of any length, kept in its own numbers."""

    def error(self, S: Any) -> Any:
        """Transmission error (rad) at driver angle S (rad)."""
        t = -(S % self.p1)
        y, _ = min(self._couple(t, k) for k in self._candidates(float(-t)))
        return -y + t * self.sizes.z1 / self.sizes.z2


def _slot_error(real: Any, r: Any, e: Any, S: Any) -> Any:
    """Angle of the slot less its mean motion (rad): the direction from its axis to the pin."""
    if r > e:
        return real.atan2(e * real.sin(S), r - e * real.cos(S))
    return -real.atan2(r * real.sin(S), e - r * real.cos(S))
