"""Letters as single strokes for engraving, and outlines of hands.

Letters are capitals of the Latin and Greek alphabets, digits and a few signs. The unit of the outline of a hand is the
length of the hand, which is given as a multiple of the radius of a scale.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import cos, pi, sin

# ---------------------------------------------------------------------------------------------------------------- hands


@dataclass(frozen=True, slots=True)
class HandOutline:
    """Outline of a hand along x from its axis, with the tip at x = 1."""

    reach: float
    """Length of the hand divided by the radius of the scale on which it is read."""
    stations: tuple[tuple[float, float], ...]
    """Pairs (x, half the width at x) from the tail to the tip, in units of the length of the hand."""


# reach, distances from the axis, half the width at each of them
_HANDS = {
    # slender, with a point like that of a lance
    "needle": (0.97, "-.16 -.12 0 .86 .88 1", ".024 .0272 .0176 .012 .024 .001"),
    # a spade, short and broad
    "hour": (0.74, "-.17 -.14 -.09 -.03 .3 .54 .57 .6 .64 .69 .74 .79 .85 .9 1",
             ".02 .045 .05 .034 .022 .024 .042 .03 .07 .1 .105 .09 .045 .022 .003"),
    # long, with a leaf before its point
    "minute": (0.95, "-.17 -.14 -.1 -.03 .25 .66 .68 .7 .74 .79 .84 .9 1",
               ".012 .026 .028 .02 .013 .012 .022 .014 .034 .042 .034 .014 .002"),
    # thin, with a counterpoise behind its axis
    "seconds": (0.92, "-.4 -.39 -.36 -.32 -.28 -.25 -.23 0 .9 1", ".008 .03 .048 .055 .048 .03 .012 .011 .006 .002"),
}  # fmt: skip


def _hand(reach: float, places: str, halves: str) -> HandOutline:
    stations = zip(map(float, places.split()), map(float, halves.split()), strict=True)
    return HandOutline(reach, tuple(stations))


HANDS: Mapping[str, HandOutline] = {name: _hand(*drawn) for name, drawn in _HANDS.items()}
"""Outlines of hands, by the name used in a declaration. All other hands are needles or made by `hand_with_ball`."""


def hand_with_ball(reach: float, ball: float) -> HandOutline:
    """Return the outline of an arm with a round end.

    reach   distance from the axis to the far side of the round end, divided by the radius of the scale
    ball    radius of the round end, divided by the radius of the scale
    """
    arm, radius = 0.12 * ball / reach, ball / reach
    steps = [pi * at / 12 for at in range(1, 13)]
    end = [(1 - radius - radius * cos(angle), max(radius * sin(angle), arm / 10)) for angle in steps]
    return HandOutline(reach, ((-2 * radius, arm), (1 - 2 * radius, arm), *end))


# -------------------------------------------------------------------------------------------------------------- letters


Point = tuple[float, float]
Stroke = tuple[Point, ...]

_HIGH = 8  # height of a capital in the grid below
_APART, _SPACE = 2.2, 3.0

# strokes by letter: corners as one digit each for x and y, from the base line; ~ marks a rounded stroke
_LATIN = {
    "A": "003860 1353",
    "B": "0008 ~083857553404 ~044463614000",
    "C": "~6648280602204062",
    "D": "0008 ~083866623000",
    "E": "58080050 0444",
    "F": "580800 0444",
    "G": "~6648280602204063 636434",
    "H": "0008 6068 0464",
    "I": "0008",
    "J": "4842 ~4241201001",
    "K": "0008 5803 2550",
    "L": "080050",
    "M": "0008336860",
    "N": "00086068",
    "O": "~200206284866624020",
    "P": "0008 ~083857553404",
    "Q": "~200206284866624020 3260",
    "R": "0008 ~083857553404 2450",
    "S": "~574818070524345351401001",
    "T": "0868 3038",
    "U": "0803 ~0301204061636368",
    "V": "083068",
    "W": "0820466088",
    "X": "0068 0860",
    "Y": "083468 3430",
    "Z": "08680060",
}
_GREEK = {
    "Γ": "000858",
    "Δ": "00386000",
    "Θ": "~200206284866624020 1454",
    "Λ": "003860",
    "Ξ": "0858 1444 0050",
    "Π": "00086860",
    "Σ": "6808340060",
    "Φ": "3038 ~22042646644222",
    "Ψ": "3038 ~080523436568",
    "Ϛ": "~664828060322424120",
    "Ω": "0020 ~2003062848666340 4060",
}
_FIGURES = {
    "0": "~200206283856523020",
    "1": "062820",
    "2": "~0618385754 540050",
    "3": "~07183857553424 ~24345351301001",
    "4": "40480252",
    "5": "480805 ~05355451301001",
    "6": "~4728060220305253351503",
    "7": "085820",
    "8": "~240507183857553424 ~240301203051533424",
    "9": "~1130525638280605234355",
}
_SIGNS = {
    ".": "0001",
    ",": "1100",
    "-": "0434",
    "/": "0048",
    "'": "0806",
    "°": "~0608282606",
    ":": "0102 0506",
    "+": "0444 2226",
}
_SAME = dict(zip("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ", "ABEZHIKMNOPTYX", strict=True))
_LETTERS = _LATIN | _GREEK | _FIGURES | _SIGNS
_UNKNOWN = "0008585000"
_SMALL, _SIMPLE = 0.025, 6  # relative height of letters whose strokes of over six points are drawn with half of them


@cache
def letter_strokes(letter: str) -> tuple[tuple[Stroke, ...], float]:
    """Return the strokes of a letter of height 1 with its baseline at y = 0, or of a box if unknown, and its width."""
    strokes: list[Stroke] = []
    for drawn in _LETTERS.get(_SAME.get(letter, letter), _UNKNOWN).split():
        figures = drawn.lstrip("~")
        corners = [(int(x) / _HIGH, int(y) / _HIGH) for x, y in zip(figures[::2], figures[1::2], strict=True)]
        strokes.append(tuple(_rounded(corners)) if drawn.startswith("~") else tuple(corners))
    return tuple(strokes), max(x for stroke in strokes for x, _ in stroke)


def _rounded(corners: list[Point]) -> Iterator[Point]:
    """Yield the points of a stroke after cutting its corners at a quarter of their sides (Chaikin's algorithm)."""
    closed = corners[0] == corners[-1]
    found = [] if closed else corners[:1]
    for (x, y), (u, v) in pairwise(corners):
        found += [((3 * x + u) / 4, (3 * y + v) / 4), ((x + 3 * u) / 4, (y + 3 * v) / 4)]
    yield from found
    yield found[0] if closed else corners[-1]


def capitals(text: str) -> str:
    """Return a text as it is engraved, in capitals without accents."""
    return "".join(each for each in unicodedata.normalize("NFD", text.upper()) if not unicodedata.combining(each))


def _advances(text: str) -> list[tuple[str, float]]:
    """Return the letters of a text, each with its advance (its width plus the gap after it) in letter heights."""
    gap = _APART / _HIGH
    return [(each, (_SPACE / _HIGH if each.isspace() else letter_strokes(each)[1]) + gap) for each in capitals(text)]


def text_length(text: str) -> float:
    """Return the length of a text divided by the height of its letters."""
    return max(0.0, sum(wide for _, wide in _advances(text)) - _APART / _HIGH)


def curved_text(text: str, height: float, radius: float, angle: float, inwards: bool = False) -> Iterator[Stroke]:
    """Yield the strokes of a text along a circular arc, centred at an angle measured clockwise from the top [rad].

    inwards   True if the feet of letters point outwards, so that text below the centre is readable
    """
    way = -1.0 if inwards else 1.0
    along = -text_length(text) * height / 2
    for letter, advance in _advances(text):
        wide = (advance - _APART / _HIGH) * height
        # letters are not bent: only the middle of each letter follows the arc
        turned = angle + way * (along + wide / 2) / radius
        along += advance * height
        if letter.isspace():
            continue
        out, right = (sin(turned), cos(turned)), (cos(turned), -sin(turned))
        for stroke in letter_strokes(letter)[0]:
            if height < _SMALL and len(stroke) > _SIMPLE:
                stroke = (*stroke[:-1:2], stroke[-1])
            yield tuple(
                ((radius + v) * out[0] + u * right[0], (radius + v) * out[1] + u * right[1])
                for u, v in ((way * (x * height - wide / 2), way * (y - 0.5) * height) for x, y in stroke)
            )
