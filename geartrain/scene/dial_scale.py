"""The scale of a dial as lines: a circle or a spiral, borders of its cells, numbers. Clockwise from the mark above."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

Point = tuple[float, float]

_CHORDS = 120  # of a turn
_MARKS = 360  # divisions of a turn that are still drawn singly
_ROUND_STEPS = (1, 2, 5, 10, 15, 20, 30, 50, 60, 100, 200, 500)
_NUMBERS = 12  # to a turn of a circle


def clock_point(radius: float, turn: float | Fraction) -> Point:
    """The point at some turns past the mark above, clockwise."""
    angle = 2 * pi * float(turn)
    return radius * sin(angle), radius * cos(angle)


@dataclass(frozen=True, slots=True)
class DialScale:
    """Cells along a circle, or along a spiral from its inner end outwards.

    outer, inner   radii of the end and of the beginning; equal for a circle
    """

    turns: int
    divisions: int
    outer: float
    inner: float

    def radius(self, turned: float) -> float:
        """After some turns from the inner end; of a circle, always the outer one."""
        return self.outer if self.turns == 1 else self.inner + (self.outer - self.inner) * turned / self.turns

    def line(self) -> Floats:
        """Along which cells lie, as chords, (n, 2)."""
        turned = np.linspace(0, self.turns, _CHORDS * self.turns + 1)
        return np.array([clock_point(self.radius(each), each) for each in turned])

    def marks(self, length: float) -> Iterator[tuple[Point, Point]]:
        """Borders of cells, inwards from the line, at most so long; of very many, every few."""
        room = length if self.turns == 1 else min(length, (self.outer - self.inner) / self.turns * 0.45)
        every = max(1, ceil(self.divisions / self.turns / _MARKS))
        for cell in range(0, self.divisions + (self.turns > 1), every):
            turn = Fraction(cell * self.turns, self.divisions)
            radius = self.radius(float(turn))
            yield clock_point(radius, turn), clock_point(radius - room, turn)

    def numbers(self) -> Iterator[tuple[int, Fraction]]:
        """Cells that are numbered, and where (turns): about twelve to a circle, the first of each turn of a spiral."""
        if self.turns > 1:
            yield from ((turn * self.divisions // self.turns, Fraction(turn)) for turn in range(self.turns))
            return
        fit = (step for step in _ROUND_STEPS if self.divisions / step <= _NUMBERS)
        step = next(fit, max(self.divisions // _NUMBERS, 1))
        for cell in range(0, self.divisions, step):
            if not cell or self.divisions - cell >= step * 0.6:
                yield cell, Fraction(cell, self.divisions)
