"""The scale of a dial: where cells lie along a circle or a spiral, what they are called, what a pointer reads there.

Turns count from the zero mark along the scale, the way it is counted. Radii are over that of the dial.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import cos, floor, pi, sin
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from geartrain.train.outputs import Dial, Graduation

Point = tuple[float, float]

INNER = 0.55
"""Innermost turn of a spiral over the outermost."""
RING = 0.17
"""What a scale around another takes of the radius."""

_CELL = "cell"
_NUMERALS, _HOURS = 12, 24  # numbers to a circle: counted from 0, declared
_ROUND_STEPS = (1, 2, 5, 10, 15, 20, 30, 50, 60, 100, 200, 500)
_ROMAN = {1000: "M", 900: "CM", 500: "D", 400: "CD", 100: "C", 90: "XC", 50: "L", 40: "XL", 10: "X", 9: "IX", 5: "V"}
_ROMAN |= {4: "IV", 1: "I"}


def clock_point(radius: float, turn: float | Fraction) -> Point:
    """The point at some turns past the mark above, clockwise."""
    angle = 2 * pi * float(turn)
    return radius * sin(angle), radius * cos(angle)


def roman(number: int) -> str:
    """A number in Roman figures.

    >>> [roman(each) for each in (4, 9, 12, 60)]
    ['IV', 'IX', 'XII', 'LX']
    """
    found = ""
    for value, letters in _ROMAN.items():
        found += letters * (number // value)
        number %= value
    return found


@dataclass(frozen=True, slots=True)
class ScaleReading:
    """What a pointer shows: turn of the spiral and cell, from 1; name, empty without one, and the cell in that."""

    turn: int
    cell: int
    name: str
    within: int


@dataclass(frozen=True, slots=True)
class DialScale:
    """Cells along a circle, or along a spiral from its inner end outwards.

    Attributes
    ----------
    turns, divisions : int
        Turns of its spiral, and cells along all of them.
    inner, outer : float
        Radius of its inner end over that of its dial; and of its outer one. Equal for a circle.
    way : int
        1 if it is counted clockwise as read, -1 if counter-clockwise.
    cell : str
        What one division is.
    names : tuple of (str, Fraction, Fraction)
        Name of divisions in a row, how many are before them, and how many they are.
    numerals : tuple of (str, int)
        What is written at lines, and how many divisions lie before each.
    glyphs : tuple of (int, str)
        What is written in cells, by their numbers from 1.
    around : DialScale or None
        Another scale around it.
    radial : bool
        Whether all numerals stand with their feet to the middle, as Roman ones do, which know no 0.
    counted : int
        Where numerals are declared, the line at which they begin again; else 0: cells are counted, from 1.
    """

    turns: int
    divisions: int
    inner: float = 1.0
    outer: float = 1.0
    way: int = 1
    cell: str = _CELL
    names: tuple[tuple[str, Fraction, Fraction], ...] = ()
    numerals: tuple[tuple[str, int], ...] = ()
    glyphs: tuple[tuple[int, str], ...] = ()
    around: DialScale | None = None
    radial: bool = False
    counted: int = 0

    def radius(self, turned: float) -> float:
        """After some turns from the inner end; of a circle, always the outer one."""
        return self.inner + (self.outer - self.inner) * turned / self.turns

    def turn_of(self, cells: Fraction | int) -> Fraction:
        """Turns after some divisions, exact."""
        return Fraction(cells) * self.turns / self.divisions

    def read(self, turned: Fraction) -> ScaleReading:
        """What a pointer shows after some turns; one on a line stands in the cell after it."""
        along = turned % self.turns
        done = along / self.turns * self.divisions
        for name, first, span in self.names:
            if first <= done < first + span:
                return ScaleReading(floor(along) + 1, floor(done) + 1, name, floor(done - first) + 1)
        return ScaleReading(floor(along) + 1, floor(done) + 1, "", 0)

    def number(self, cell: int) -> int:
        """What a cell is called: its number, or with numerals that of the line before it, as on clocks."""
        if not self.counted:
            return cell
        return (cell - 2) % self.counted + 1 if self.radial else (cell - 1) % self.counted

    def told(self, turned: Fraction) -> str:
        """The same in words, such as `Leo, degree 14`, and what is engraved in that cell; empty without divisions.

        Which pointer is read on what is around it, no train says.
        """
        read, parts = self.read(turned), []
        if self.turns > 1:
            parts.append(f"turn {read.turn}")
        if read.name:
            parts.append(read.name)
        if read.name and len(self.names) < self.divisions:
            parts.append(f"{self.cell} {read.within}")
        elif not read.name and self.divisions > 1:
            parts.append(f"{self.cell} {self.number(read.cell)}")
        parts += [glyph for cell, glyph in self.glyphs if glyph and cell == read.cell]
        return ", ".join(parts)


def scale_of(dial: Dial) -> DialScale:
    """The scale of a declared dial."""
    way = 1 if dial.counted == "clockwise" else -1
    outer = 1.0 if dial.around is None else 1.0 - RING
    inner = outer * INNER if dial.turns > 1 else outer
    around = None if dial.around is None else _scale(dial.around, 1, (1.0, 1.0), way, None)
    return _scale(dial, dial.turns, (inner, outer), way, around)


def _scale(
    graduation: Graduation, turns: int, radii: tuple[float, float], way: int, around: DialScale | None
) -> DialScale:
    return DialScale(
        turns,
        graduation.divisions,
        *radii,
        way,
        graduation.cell or _CELL,
        graduation.parts,
        tuple(_numerals(graduation, turns)),
        tuple(sorted(graduation.glyphs.items())),
        around,
        graduation.numerals is not None and graduation.numerals.style == "roman",
        0 if graduation.numerals is None else graduation.numerals.to or graduation.divisions,
    )


def plain_circle() -> DialScale:
    """That of an output without a dial: twelve lines."""
    return DialScale(1, 12)


def _numerals(graduation: Graduation, turns: int) -> list[tuple[str, int]]:
    """Declared ones; without, unless it has names, about twelve to a circle from 0; of a spiral, none."""
    count, declared = graduation.divisions, graduation.numerals
    if declared is None:
        if turns > 1 or graduation.names or count == 1:
            return []
        step = _step(count, _NUMERALS)
        return [(str(line), line) for line in range(0, count, step) if not line or count - line >= step * 0.6]
    step = declared.every or _step(count, _NUMERALS if declared.style == "arabic" else _HOURS)
    lines = range(step, count + 1, step)
    numbers = [(line - 1) % (declared.to or count) + 1 for line in lines]
    write = roman if declared.style == "roman" else str
    return [(write(number), line % count) for number, line in zip(numbers, lines, strict=True)]


def _step(count: int, most: int) -> int:
    return next((step for step in _ROUND_STEPS if count / step <= most), max(count // most, 1))
