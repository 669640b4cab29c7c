"""The law of triangular teeth from its definition, in as many digits as there are."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.tooth_couple import ToothCouple

Floats = NDArray[np.float64]


def reference(sizes: TriangularSizes, S: Floats) -> tuple[Floats, Floats]:
    """Transmission error (rad) and speed ratio at driver angles S in the first pitch, from the law's definition.

    Contact of one couple from the two lines of flanks, every couple in reach asked, 40 digits if mpmath is installed,
    else the longest floats there are. Teeth past their reach hold the driven wheel where they left it.
    """
    real: Any = Multiple() if find_spec("mpmath") else Long()
    exact = Exact(sizes, real)
    answers = [exact.at(float(each)) for each in S]
    return np.array([error for error, _ in answers]), np.array([speed for _, speed in answers])


class Multiple:
    """40-digit arithmetic."""

    def __init__(self) -> None:
        context = import_module("mpmath").mp.clone()
        context.dps = 40
        self.number, self.pi = context.mpf, +context.pi
        self.sin, self.cos, self.asin, self.acos = context.sin, context.cos, context.asin, context.acos
        self.atan2, self.sqrt = context.atan2, context.sqrt


class Long:
    """The longest floats of the machine: 64 bits of mantissa on most."""

    def __init__(self) -> None:
        self.number = np.longdouble
        self.pi = 4 * np.arctan(np.longdouble(1))
        self.sin, self.cos, self.asin, self.acos = np.sin, np.cos, np.arcsin, np.arccos
        self.atan2, self.sqrt = np.arctan2, np.sqrt


class Exact:
    """The definition of the law, in whatever numbers `real` has, written as in a textbook: many digits may cancel."""

    def __init__(self, sizes: TriangularSizes, real: Any) -> None:
        self.m, self.sizes = real, sizes
        self.R1, self.R2, self.b1, self.b2, excess = (
            real.number(x) for x in (sizes.R1, sizes.R2, sizes.beta1, sizes.beta2, sizes.excess)
        )
        self.p1, self.p2 = 2 * real.pi / sizes.z1, 2 * real.pi / sizes.z2
        least = self.R1 + self.R2 - min(self._depth(self.R1, self.p1, self.b1), self._depth(self.R2, self.p2, self.b2))
        self.D = (1 + excess) * least
        self.reach = real.acos((self.D**2 + self.R1**2 - self.R2**2) / (2 * self.D * self.R1))
        self.couple = ToothCouple(sizes)

    def _depth(self, R: Any, pitch: Any, b: Any) -> Any:
        """The bottom of a space is where the flanks of two neighbouring teeth meet."""
        return R - R * self.m.sin(b) / self.m.sin(b + pitch / 2)

    def at(self, S: float) -> tuple[float, float]:
        """Error and speed ratio at driver angle S in the first pitch."""
        t = -self.m.number(S)
        y, speed = min(self._couple(t, k) for k in self._candidates(S))
        return float(-y + t * self.sizes.z1 / self.sizes.z2), float(speed)

    def _candidates(self, S: float) -> list[int]:
        """All couples in reach and the last to leave it, less those that floats show to be far from driving."""
        numbers = np.arange(
            ceil((S - float(self.reach)) / self.sizes.p1) - 2, (S + float(self.reach)) // self.sizes.p1 + 1
        )
        x = np.clip(numbers * self.sizes.p1 - S, -self.sizes.reach1, self.sizes.reach1)
        y = np.fmin(self.couple.approach_angle(x, np), self.couple.recess_angle(x, np)) - numbers * self.sizes.p2
        return [int(k) for k in numbers[y < y.min() + 1e-3 * self.sizes.p2]]

    def _couple(self, t: Any, k: int) -> tuple[Any, Any]:
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
