"""Laws of teeth and pins, and the motion of whole trains, from their definitions in as many digits as there are."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.dynamics import Motion
from geartrain.dynamics.motion.error_composition import PairErrorSource
from geartrain.numerics.elimination import LinearForm, eliminate
from geartrain.teeth import PinToSlotTransmission, TransmissionFunction
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.tooth_pair import ToothPair
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

Floats = NDArray[np.float64]
_CONVERGED = 1e-25  # rad: far below what a float resolves, far above what 40 digits do


def reference(sizes: TriangularSizes, S: Floats) -> tuple[Floats, Floats]:
    """Transmission error (rad) and speed ratio at driver angles S in the first pitch, from the law's definition.

    Contact of one couple from the two lines of flanks, every couple in reach asked, 40 digits if mpmath is installed,
    else the longest floats there are. Teeth past their reach hold the driven wheel where they left it.
    """
    real: Any = numbers()
    exact = TriangularDefinition(sizes, real)
    answers = [exact.at(float(each)) for each in S]
    return np.array([error for error, _ in answers]), np.array([speed for _, speed in answers])


def numbers() -> Any:
    """Numbers and functions in 40 digits; without mpmath, the longest floats of the machine."""
    return LongNumbers() if find_spec("mpmath") else LongestFloats()


class LongNumbers:
    """40-digit arithmetic."""

    def __init__(self) -> None:
        context = import_module("mpmath").mp.clone()
        context.dps = 40
        self.number, self.pi = context.mpf, +context.pi
        self.sin, self.cos, self.asin, self.acos = context.sin, context.cos, context.asin, context.acos
        self.atan2, self.sqrt = context.atan2, context.sqrt


class LongestFloats:
    """The longest floats of the machine: 64 bits of mantissa on most."""

    def __init__(self) -> None:
        self.number = np.longdouble
        self.pi = 4 * np.arctan(np.longdouble(1))
        self.sin, self.cos, self.asin, self.acos = np.sin, np.cos, np.arcsin, np.arccos
        self.atan2, self.sqrt = np.arctan2, np.sqrt


class TriangularDefinition:
    """The definition of the law, in whatever numbers `real` has, written as in a textbook: many digits may cancel."""

    def __init__(self, sizes: TriangularSizes, real: Any) -> None:
        self.m, self.sizes = real, sizes
        self.R1, self.R2, self.b1, self.b2, excess = (
            real.number(x) for x in (sizes.R1, sizes.R2, sizes.beta1, sizes.beta2, sizes.excess)
        )
        self.p1, self.p2 = 2 * real.pi / sizes.z1, 2 * real.pi / sizes.z2
        minimum = (
            self.R1 + self.R2 - min(self._depth(self.R1, self.p1, self.b1), self._depth(self.R2, self.p2, self.b2))
        )
        self.D = (1 + excess) * minimum
        self.reach = real.acos((self.D**2 + self.R1**2 - self.R2**2) / (2 * self.D * self.R1))
        self.tooth_pair = ToothPair(sizes)

    def _depth(self, R: Any, pitch: Any, b: Any) -> Any:
        """The bottom of a space is where the flanks of two neighbouring teeth meet."""
        return R - R * self.m.sin(b) / self.m.sin(b + pitch / 2)

    def at(self, S: float) -> tuple[float, float]:
        """Error and speed ratio at driver angle S in the first pitch."""
        t = -self.m.number(S)
        y, speed = min(self._tooth_pair(t, k) for k in self._candidates(S))
        return float(-y + t * self.sizes.z1 / self.sizes.z2), float(speed)

    def _candidates(self, S: float) -> list[int]:
        """All couples in reach and the last to leave it, less those that floats show to be far from driving."""
        numbers = np.arange(
            ceil((S - float(self.reach)) / self.sizes.p1) - 2, (S + float(self.reach)) // self.sizes.p1 + 1
        )
        x = np.clip(numbers * self.sizes.p1 - S, -self.sizes.reach1, self.sizes.reach1)
        y = (
            np.fmin(self.tooth_pair.angle("approach", x, np), self.tooth_pair.angle("recess", x, np))
            - numbers * self.sizes.p2
        )
        return [int(k) for k in numbers[y < y.min() + 1e-3 * self.sizes.p2]]

    def _tooth_pair(self, t: Any, k: int) -> tuple[Any, Any]:
        """Driven angle and speed ratio if couple k drove at position t."""
        x = t + k * self.p1
        if x > self.reach:
            return self.m.number(1e9), x
        if x < -self.reach:
            return min(self._approach(-self.reach), self._recess(-self.reach))[0] - k * self.p2, self.m.number(0)
        y, speed = min(self._approach(x), self._recess(x))
        return y - k * self.p2, speed

    def _approach(self, x: Any) -> tuple[Any, Any]:
        """R2 sin(psi + y) = D sin psi - R1 sin beta1: the driven apex on the driver's flank; and dy/dx."""
        psi = x + self.b1
        sine = (self.D * self.m.sin(psi) - self.R1 * self.m.sin(self.b1)) / self.R2
        return self.m.asin(sine) - psi, self.D * self.m.cos(psi) / (self.R2 * self.m.sqrt(1 - sine**2)) - 1

    def _recess(self, x: Any) -> tuple[Any, Any]:
        """D sin psi - R1 sin(psi - x) = R2 sin beta2, psi = beta2 - y: the driver's apex on the driven flank."""
        m = self.m
        along, across = self.D - self.R1 * m.cos(x), self.R1 * m.sin(x)
        psi = m.asin(self.R2 * m.sin(self.b2) / m.sqrt(along**2 + across**2)) - m.atan2(across, along)
        turned = self.R1 * m.cos(psi - x)
        return self.b2 - psi, turned / (self.D * m.cos(psi) - turned)


class MotionTruth:
    """Errors of the outputs in 40 digits (the longest floats without mpmath).

    Teeth answer from the contact of one couple, as in the benchmark of meshes, pins from their triangle. How errors
    spread is solved exactly from all rows of the train at once. Each pair is asked at the angle that the errors of all
    pairs give its driver, again and again until nothing changes.
    """

    def __init__(self, motion: Motion) -> None:
        self.real: Any = numbers()
        self.converged = _CONVERGED if find_spec("mpmath") else 1e-18
        self.motion, self.sources = motion, motion._forward.used
        self.transmissions = [self._transmission(source.transmission) for source in self.sources]
        errors = self._spread()
        self.gains = [self._gain(source, errors) for source in self.sources]
        self.responses = [self._terms({of: 1, base: -sense}, errors) for of, base, sense, _ in motion._forward.outputs]

    def _transmission(self, transmission: TransmissionFunction) -> Callable[[Any], Any]:
        if isinstance(transmission, TriangularTransmission) and transmission.direction > 0:
            return _Teeth(transmission.sizes, self.real).error
        assert isinstance(transmission, PinToSlotTransmission)
        return partial(_slot_error, self.real, self.real.number(transmission.r), self.real.number(transmission.e))

    def _spread(self) -> dict[int, LinearForm]:
        """Every link's error as a sum over the errors of the sources, by -1 less their number, exactly."""
        system, spread = self.motion._problem.system, self.motion._propagation
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
        joint = self.motion._propagation.joints[source.pair]
        links = {joint.driver: source.forward * source.driver_sense}
        links[joint.carrier] = links.get(joint.carrier, 0) - source.forward * source.carrier_sense
        return self._terms(links, errors)

    def off(self, turns: float, found: Floats) -> list[float]:
        """What errors found at some turns of the input differ by (rad), by output."""
        deltas = self._deltas(Fraction(turns))
        truth = [sum((factor * deltas[at] for at, factor in row), self.real.number(0)) for row in self.responses]
        return [float(self.real.number(float(each)) - true) for each, true in zip(found, truth, strict=True)]

    def _deltas(self, turns: Fraction) -> list[Any]:
        """Errors of all pairs, in the order of the train: where none depends on itself one pass is enough."""
        number = self.real.number
        stands = [self._stands(source, turns) for source in self.sources]
        deltas = [number(0)] * len(stands)
        last: list[Any] = [None] * len(stands)
        changed = True
        while changed:
            changed = False
            for at, source in enumerate(self.sources):
                S = stands[at] + sum((factor * deltas[other] for other, factor in self.gains[at]), number(0))
                if last[at] is not None and abs(S - last[at]) < self.converged:
                    continue
                deltas[at], last[at], changed = source.sense * self.transmissions[at](S), S, True
        return deltas

    def _stands(self, source: PairErrorSource, turns: Fraction) -> Any:
        """The driver's forward angle (rad, whole turns left out) in mean motion."""
        joint, train = self.motion._propagation.joints[source.pair], self.motion._problem
        links = train.system.links
        part = abs(train.relative(links[joint.driver], links[joint.carrier])) * turns % 1
        number = self.real.number
        return 2 * self.real.pi * number(part.numerator) / number(part.denominator) + number(source.start)


class _Teeth(TriangularDefinition):
    """The definition of the law of triangular teeth at angles of any length, kept in its own numbers."""

    def error(self, S: Any) -> Any:
        """Transmission error (rad) at driver angle S (rad)."""
        t = -(S % self.p1)
        y, _ = min(self._tooth_pair(t, k) for k in self._candidates(float(-t)))
        return -y + t * self.sizes.z1 / self.sizes.z2


def _slot_error(real: Any, r: Any, e: Any, S: Any) -> Any:
    """Angle of the slot less its mean motion (rad): the direction from its axis to the pin."""
    if r > e:
        return real.atan2(e * real.sin(S), r - e * real.cos(S))
    return -real.atan2(r * real.sin(S), e - r * real.cos(S))
