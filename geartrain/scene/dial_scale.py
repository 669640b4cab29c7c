"""Scale of a dial: divisions (cells) along a circle or a spiral, their names, readings of a pointer, and engraving.

Turns are counted from the zero mark, which is at the top, along the scale. Lengths are relative to the radius of the
dial; x points to the right and y upwards.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import cos, floor, pi, sin
from typing import TYPE_CHECKING, Literal

from geartrain.scene.stroke_letters import Stroke, curved_text, text_length
from geartrain.train.outputs import INNER, RING

if TYPE_CHECKING:
    from geartrain.train.outputs import Dial, Graduation

Point = tuple[float, float]

_CELL = "cell"
_NUMERALS, _HOURS = 12, 24  # maximum count of numerals: default, declared
_ROUND_STEPS = (1, 2, 5, 10, 15, 20, 30, 50, 60, 100, 200, 500)
_ROMAN = {1000: "M", 900: "CM", 500: "D", 400: "CD", 100: "C", 90: "XC", 50: "L", 40: "XL", 10: "X", 9: "IX", 5: "V"}
_ROMAN |= {4: "IV", 1: "I"}


def clock_point(radius: float, turn: float | Fraction) -> Point:
    """Return the point on a circle about the origin at an angle [turns] measured clockwise from the top."""
    angle = 2 * pi * float(turn)
    return radius * sin(angle), radius * cos(angle)


def roman(number: int) -> str:
    """Return a positive number in Roman numerals.

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
    """Reading of a pointer: number of the spiral turn and number of the cell, both counted from 1, name of the group
    that contains the cell, and number of the cell within this group.

    For a cell without a group name, the name is empty and `within` is 0.
    """

    turn: int
    cell: int
    name: str
    within: int


@dataclass(frozen=True, slots=True)
class DialScale:
    """Scale of a dial, divided into cells along a circle, or along a spiral that starts at its inner end."""

    turns: int
    """Number of turns of the spiral; 1 for a circle."""
    divisions: int
    """Total number of cells on all turns."""
    inner: float = 1.0
    """Radius of the inner end of the scale, divided by the radius of the dial."""
    outer: float = 1.0
    """Radius of the outer end of the scale, divided by the radius of the dial; equal to `inner` for a circle."""
    way: int = 1
    """Direction of counting, as seen by the reader: 1 for clockwise, -1 for counter-clockwise."""
    cell: str = _CELL
    """Name of one division, such as `cell` or `degree`."""
    names: tuple[tuple[str, Fraction, Fraction], ...] = ()
    """Groups of divisions: name of the group, number of divisions before it, and number of divisions in it."""
    numerals: tuple[tuple[str, int], ...] = ()
    """Numerals at division lines. Each entry is a numeral and the number of divisions before its line."""
    glyphs: tuple[tuple[int, str], ...] = ()
    """Glyphs in cells. Each entry is the number of a cell, counted from 1, and its glyph."""
    around: DialScale | None = None
    """Second scale, which surrounds this scale; None if there is only one scale."""
    radial: bool = False
    """True if the feet of all numerals point to the centre of the dial, as is usual for Roman numerals."""
    cells: tuple[str, ...] = ()
    """Name of every cell; empty if the cells have no individual names."""
    inscriptions: tuple[tuple[str, str], ...] = ()
    """Names that are engraved differently. Each entry is a name and the text that is engraved instead."""
    counted: int = 0
    """Number of divisions after which the declared numerals start again; 0 if cells are counted from 1 because no
    numerals are declared.
    """

    def radius(self, turned: float) -> float:
        """Return the radius of a spiral scale after `turned` turns from its inner end [radii of the dial]."""
        return self.inner + (self.outer - self.inner) * turned / self.turns

    def turn_of(self, cells: Fraction | int) -> Fraction:
        """Return the exact number of turns of the scale that the given number of cells occupies."""
        return Fraction(cells) * self.turns / self.divisions

    def read(self, turned: Fraction) -> ScaleReading:
        """Return the reading of a pointer after a number of turns; on a line, it reads the cell that follows."""
        along = turned % self.turns
        done = along / self.turns * self.divisions
        for name, first, span in self.names:
            if first <= done < first + span:
                return ScaleReading(floor(along) + 1, floor(done) + 1, name, floor(done - first) + 1)
        return ScaleReading(floor(along) + 1, floor(done) + 1, "", 0)

    def number(self, cell: int) -> int:
        """Return the number read in a cell: its own number or, if lines are numbered, the number of the last line."""
        if not self.counted:
            return cell
        return (cell - 2) % self.counted + 1 if self.radial else (cell - 1) % self.counted

    def reading_text(self, turned: Fraction) -> str:
        """Return the reading as text, such as `Leo, degree 14`, with the glyph of the cell; empty without divisions."""
        read, parts = self.read(turned), []
        if self.turns > 1:
            parts.append(f"turn {read.turn}")
        if read.name:
            parts.append(read.name)
        if self.cells:
            parts.append(self.cells[read.cell - 1])
        elif read.name and len(self.names) < self.divisions:
            parts.append(f"{self.cell} {read.within}")
        elif not read.name and self.divisions > 1:
            parts.append(f"{self.cell} {self.number(read.cell)}")
        parts += [glyph for cell, glyph in self.glyphs if glyph and cell == read.cell]
        return ", ".join(parts)


def scale_of(dial: Dial) -> DialScale:
    """Return the scale of a declared dial, including its surrounding scale if one is declared."""
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
        graduation.cells,
        tuple(graduation.inscriptions.items()),
        0 if graduation.numerals is None else graduation.numerals.to or graduation.divisions,
    )


def plain_circle() -> DialScale:
    """Return the scale of an output without a dial: a circle of twelve divisions."""
    return DialScale(1, 12)


def _numerals(graduation: Graduation, turns: int) -> list[tuple[str, int]]:
    """Return the declared numerals, or up to twelve default numerals, each with the number of divisions before it."""
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


# ------------------------------------------------------------------------------------------------------------ engraving


_CHORDS = 90  # chords per turn
_MARKS = 400  # maximum number of divisions per turn of which each is drawn
_SHORT, _LONG = 0.032, 0.05  # lengths of borders, and of those at numerals
_TALL, _MINIMUM = 0.068, 0.03  # normal and minimum height of letters
_BAND = 0.1  # from a rim to the middle of the text along it
_FULL = 0.86  # maximum length of a name divided by that of its divisions
_LEADING = 1.35  # distance of lines of text divided by the height of letters
_APART = 0.5  # gap between numerals divided by their height

Kind = Literal["rim", "fine", "bold", "letters"]
_WIDTHS: dict[Kind, float] = {"rim": 0.005, "fine": 0.003, "bold": 0.007}
_PEN = 0.12  # line width divided by the height of letters


@dataclass(frozen=True, slots=True)
class Engraving:
    """Engraved lines of one kind and one width, in units of the dial's radius."""

    kind: Kind
    """Kind of the lines: rim, fine or bold borders, or letters."""
    width: float
    """Width of the lines, divided by the radius of the dial."""
    lines: Sequence[Stroke]
    """Points of each line, in units of the radius of the dial."""


def engrave(scale: DialScale) -> list[Engraving]:
    """Return all engraved lines of the scale of a dial, including the lines of a scale that surrounds it.

    Parameters
    ----------
    scale : DialScale
        Scale of a dial, such as `Scene.dials[0].scale`.

    Returns
    -------
    list of Engraving
        Rims, borders of cells and letters, each with its line width and its polylines, in units of the dial's radius.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import make_scene
    >>> dials = make_scene(geartrain.load("longcase-clock")).dials
    >>> sorted({part.kind for part in engrave(dials[0].scale)})
    ['bold', 'fine', 'letters', 'rim']
    """
    found = [*(_spiral(scale) if scale.turns > 1 else _circle(scale))]
    if scale.around is not None:
        found += engrave(scale.around)
    return [each for each in found if each.lines]


def _lines(kind: Kind, lines: Sequence[Stroke]) -> Engraving:
    return Engraving(kind, _WIDTHS[kind], lines)


def _letters(lines: Iterator[Stroke], height: float) -> Engraving:
    return Engraving("letters", _PEN * height, tuple(lines))


def _point(scale: DialScale, radius: float, turn: float | Fraction) -> Point:
    return clock_point(radius, scale.way * turn)


def _border(scale: DialScale, radius: float, depth: float, turn: Fraction) -> Stroke:
    return _point(scale, radius, turn), _point(scale, radius - depth, turn)


def _line(scale: DialScale, height: float, turns: float, off: float = 0.0) -> Stroke:
    """Return a polyline along the scale, offset inwards by `off` times the radius of the dial."""
    steps = max(1, round(_CHORDS * turns))
    turned = (turns * each / steps for each in range(steps + 1))
    return tuple(_point(scale, scale.radius(each) - off, each) for each in turned)


# ---------------------------------------------------------------------------------------------------------- circle


def _circle(scale: DialScale) -> Iterator[Engraving]:
    """Yield the engraving of a circular scale: the rim, the borders of cells inside it, and the text inside these."""
    at = {line for _, line in scale.numerals}
    starts = {first for _, first, _ in scale.names}
    every = -(-scale.divisions // _MARKS)
    cells = range(0, scale.divisions, every) if scale.divisions > 1 else range(1)
    deep = _BAND + _TALL / 2 + 0.02
    yield _lines("rim", [_line(scale, scale.outer, 1)] + ([_line(scale, scale.outer, 1, deep)] if starts else []))
    yield _lines("bold", [_border(scale, scale.outer, _LONG, scale.turn_of(each)) for each in cells if each in at])
    plain = [each for each in cells if each not in at and each not in starts]
    depths = [_LONG if scale.divisions >= 30 and each % 5 == 0 else _SHORT for each in plain]
    borders = zip(depths, map(scale.turn_of, plain), strict=True)
    yield _lines("fine", [_border(scale, scale.outer, depth, turn) for depth, turn in borders])
    yield _lines("bold", [_border(scale, scale.outer, deep, scale.turn_of(each)) for each in sorted(starts)])
    yield from _names(scale)
    yield from _engraved_numerals(scale)
    yield from _glyphs(scale, scale.outer - _BAND)


def _names(scale: DialScale) -> Iterator[Engraving]:
    """Yield the names of groups of cells, each in the middle of its group; without space, names are omitted."""
    radius = scale.outer - _BAND
    named = [(_engraved(scale, name), first, span) for name, first, span in scale.names if name]
    # fewer names leave more space for each
    for every in range(1, 7):
        # a name may extend over its omitted neighbours; 0.9 leaves a gap to the next name
        share = 1 if every == 1 else 0.9 * every
        heights = {part: share * _fitting(part[0], radius, scale.turn_of(part[2])) for part in named[::every]}
        kept = {part: height for part, height in heights.items() if height >= _MINIMUM}
        if len(kept) >= 0.8 * len(heights):  # five days at the year's end are too few for their name
            break
    height = min([_TALL, *kept.values()])
    at = ((name, scale.turn_of(first + span / 2)) for name, first, span in kept)
    if kept:
        yield _letters((each for name, turn in at for each in _written(scale, name, radius, turn, height)), height)


def _fitting(text: str, radius: float, turn: Fraction) -> float:
    """Return the maximum letter height of a text that spans `turn` of a circle [turns], in radii of the dial."""
    return _FULL * 2 * pi * radius * float(turn) / max(text_length(text), 0.5)


def _written(
    scale: DialScale, text: str, radius: float, turn: Fraction, height: float, turned: bool = True
) -> Iterator[Stroke]:
    """Yield the strokes of a text along a circle, centred at `turn` [turns], with letters of the given height.

    turned   True to turn a text below the centre of the dial upside down, so that it can be read
    """
    angle = 2 * pi * float(scale.way * turn)
    return curved_text(text, height, radius, angle, turned and cos(angle) < -0.01)


def _engraved_numerals(scale: DialScale) -> Iterator[Engraving]:
    """Yield the numerals at their division lines, inside the cell borders and inside any names."""
    if not scale.numerals:
        return
    inside = 0.5 * _TALL + 0.075 if scale.names else 0.0
    size = 1.5 * _TALL if scale.radial and len(scale.numerals) <= 12 else _TALL
    radius = scale.outer - _BAND - inside - (size - _TALL) / 2
    room = 2 * pi * radius / len(scale.numerals)
    height = min(size, *(room / (text_length(text) + _APART) for text, _ in scale.numerals))
    strokes = (
        stroke
        for text, line in scale.numerals
        for stroke in _written(scale, text, radius, scale.turn_of(line), height, not scale.radial)
    )
    yield _letters(strokes, height)


def _glyphs(scale: DialScale, radius: float) -> Iterator[Engraving]:
    """Yield the glyphs or names of the cells in one size that fits in all cells; names are omitted if too small."""
    texts = scale.glyphs or tuple((cell, _engraved(scale, name)) for cell, name in enumerate(scale.cells, 1))
    height = min([_TALL, *(_fitting(text, radius, scale.turn_of(1)) for _, text in texts)])
    at = ((text, scale.turn_of(Fraction(2 * cell - 1, 2))) for cell, text in texts)
    if scale.glyphs or height >= _MINIMUM:
        yield _letters((each for text, turn in at for each in _written(scale, text, radius, turn, height)), height)


# ---------------------------------------------------------------------------------------------------------- spiral


def _spiral(scale: DialScale) -> Iterator[Engraving]:
    """Yield the groove of a spiral scale and its cells; the first whole cell of each turn shows its number."""
    pitch = (scale.outer - scale.inner) / scale.turns
    every = -(-scale.divisions // (scale.turns * _MARKS))
    starts = {first for _, first, _ in scale.names}
    borders = {
        each: _border(scale, scale.radius(float(scale.turn_of(each))), pitch, scale.turn_of(each))
        for each in range(0, scale.divisions + 1, every)
    }
    yield _lines("rim", [_line(scale, 0, scale.turns), _line(scale, 0, 1, pitch)])
    yield _lines("fine", [each for cell, each in borders.items() if cell not in starts])
    yield _lines("bold", [each for cell, each in borders.items() if cell in starts])
    if scale.cells:
        yield from _cell_names(scale, pitch)
        return
    written = dict(scale.glyphs)
    for coil in range(scale.turns):
        cell = -(-coil * scale.divisions // scale.turns) + 1
        written.setdefault(cell, str(cell))
    cells = [(text, Fraction(2 * cell - 1, 2), Fraction(1), 0.0) for cell, text in sorted(written.items())]
    names = [
        (_engraved(scale, name), first + span / 2, span, 0.25 * pitch) for name, first, span in scale.names if name
    ]
    for text, middle, span, readable in (*cells, *names):
        turn = scale.turn_of(middle)
        radius = scale.radius(float(turn)) - pitch / 2
        height = min(0.5 * pitch, _TALL, _fitting(text, radius, scale.turn_of(span)))
        if height >= readable:
            yield _letters(_written(scale, text, radius, turn, height), height)


def _cell_names(scale: DialScale, pitch: float) -> Iterator[Engraving]:
    """Yield the name of every cell of a spiral, on up to three lines, and the name of each group in its first cell."""
    starts = {first: name for name, first, _ in scale.names}
    glyphs = dict(scale.glyphs)
    for cell, name in enumerate(scale.cells):
        turn = scale.turn_of(Fraction(2 * cell + 1, 2))
        middle = scale.radius(float(turn)) - pitch / 2
        above = [text for text in (_engraved(scale, starts.get(Fraction(cell), "")), glyphs.get(cell + 1)) if text]
        ways, word = [], _engraved(scale, name)
        for rows in (1, 2, 3):  # parts of nearly equal length
            ends = [round(row * len(word) / rows) for row in range(rows + 1)]
            lines = [*above, *(word[first:last] for first, last in pairwise(ends) if last > first)]
            deep = _FULL * pitch / (1 + _LEADING * (len(lines) - 1))
            fitting = (_fitting(text, middle - pitch / 2, scale.turn_of(1)) for text in lines)
            ways.append((min(_TALL, deep, *fitting), lines))
        height, lines = max(ways, key=lambda way: way[0])
        # the first line is the outermost where letters are upright, else the innermost
        if cos(2 * pi * float(scale.way * turn)) < -0.01:
            lines = lines[::-1]
        for row, text in enumerate(lines):
            radius = middle + ((len(lines) - 1) / 2 - row) * _LEADING * height
            yield _letters(_written(scale, text, radius, turn, height), height)


def _engraved(scale: DialScale, name: str) -> str:
    """Return the text that is engraved on the dial for a name."""
    return dict(scale.inscriptions).get(name, name)
