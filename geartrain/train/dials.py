"""Dials as they are declared: divisions along a circle or a spiral, their names, numerals and glyphs."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.errors import suggest
from geartrain.numerics.containers import FrozenDict
from geartrain.train.fields import AlsoShort, Declared, also, short_for

_SIGNS = "Aries Taurus Gemini Cancer Leo Virgo Libra Scorpio Sagittarius Capricorn Aquarius Pisces"
_MONTHS = "Thoth Phaophi Hathyr Choiak Tybi Mecheir Phamenoth Pharmuthi Pachon Payni Epeiph Mesore"
NAMED_SCALES: Mapping[str, tuple[str, tuple[tuple[str, int], ...]]] = {
    "zodiac": ("degree", tuple((name, 30) for name in _SIGNS.split())),
    "egyptian_months": ("day", (*((name, 30) for name in _MONTHS.split()), ("Epagomenal", 5))),
}
"""Scales that need no list: what one division is, and the names with the divisions that each spans."""

_MOST = 10**6


def _whole(raw: object) -> int:
    """A positive whole number."""
    text = str(raw)
    number = int(text) if not isinstance(raw, bool) and text.isascii() and text.isdigit() and len(text) < 10 else 0
    if 0 < number <= _MOST:
        return number
    shown = text if len(text) <= 30 else f"{text[:27]}..."
    fix = f"write `names: {text}`" if text in NAMED_SCALES else f"give a whole number from 1 to {_MOST:,}"
    raise PydanticCustomError("dial", "{shown} is no number of divisions or turns", {"shown": shown, "fix": fix})


Whole = Annotated[int, BeforeValidator(_whole)]


class DialName(Declared):
    """The name of some divisions in a row. A bare text is the name.

    See Also
    --------
    Dial : holds them as `names`
    """

    name: str = Field("", description="As it is engraved; empty for divisions without a name")
    span: Whole | None = Field(None, description="Divisions that it takes; without it all names take as many")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["string", "number", "null"]}, handler(schema))


class DialNumerals(Declared):
    """Numbers at the lines between divisions, the last one at the zero mark. A bare text is their style.

    See Also
    --------
    Dial : holds them as `numerals`
    """

    style: Literal["roman", "arabic"] = Field("arabic", description="How they are written")
    every: Whole | None = Field(None, description="Divisions from one to the next; default as many as fit")
    to: Whole | None = Field(
        None, description="Where they begin again, such as 12 on a dial of 24 hours; default all divisions"
    )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"enum": ["roman", "arabic"]}, handler(schema))


class Graduation(Declared):
    """Divisions along a scale, and what is written at them.

    See Also
    --------
    Dial : one with a pointer
    DialRing : one around a dial
    """

    divisions: Whole = Field(1, description="Cells along all turns; default as many as its names take")
    cell: str = Field("", description="What one division is, such as month; default as in a named scale, or cell")
    names: Annotated[
        tuple[Annotated[DialName, short_for("name")], ...],
        AlsoShort({"enum": [*NAMED_SCALES]}),
    ] = Field((), description="Of divisions: a named scale, a list for equal parts, or a list of {name, span}")
    numerals: Annotated[DialNumerals, short_for("style")] | None = Field(
        None, description="Numbers at the lines: roman, arabic, or {style, every, to}; default counted from 0"
    )
    glyphs: Annotated[dict[Whole, str], AfterValidator(FrozenDict)] = Field(
        {}, validate_default=True, description="What is engraved in single cells, by the cell's number from 1"
    )

    @model_validator(mode="before")
    @classmethod
    def _with_its_scale(cls, raw: Any) -> Any:
        """Writes out a named scale, and counts divisions by names where nothing else does."""
        if not isinstance(raw, dict) or not raw.get("names"):
            return raw
        names, own = raw["names"], dict(raw)
        if isinstance(names, str):
            if names not in NAMED_SCALES:
                fix = suggest(names, NAMED_SCALES, otherwise=f"one of {', '.join(NAMED_SCALES)}, or a list of names")
                raise PydanticCustomError("dial", "there is no scale '{names}'", {"names": names, "fix": fix})
            cell, parts = NAMED_SCALES[names]
            own.setdefault("divisions", sum(span for _, span in parts))
            if str(own["divisions"]) == str(sum(span for _, span in parts)):
                own.setdefault("cell", cell)
            own["names"] = [{"name": name, "span": span} for name, span in _shared(names, parts, own["divisions"])]
        elif isinstance(names, list | tuple):
            spans = [each.get("span") if isinstance(each, dict) else None for each in names]
            whole = [int(str(span)) for span in spans if str(span).isascii() and str(span).isdigit()]
            own.setdefault("divisions", sum(whole) if len(whole) == len(spans) else len(spans))
        return own

    @model_validator(mode="after")
    def _adds_up(self) -> Graduation:
        spans = [each.span for each in self.names]
        given = [span for span in spans if span is not None]
        if given and len(given) < len(spans):
            missing = next(each.name for each in self.names if each.span is None)
            fix = {"name": missing, "fix": "give every name a span, or none"}
            raise PydanticCustomError("dial", "'{name}' has no span, and other names have", fix)
        if given and sum(given) != self.divisions:
            off = sum(given) - self.divisions
            raise PydanticCustomError(
                "dial",
                "the spans of its names make {total}, {off} too {way} for {divisions} divisions",
                {
                    "total": sum(given),
                    "off": abs(off),
                    "way": "many" if off > 0 else "few",
                    "divisions": self.divisions,
                    "fix": "let spans add up to the divisions, or leave `divisions` out",
                },
            )
        for cell in self.glyphs:
            if cell > self.divisions:
                told = {"cell": cell, "divisions": self.divisions, "fix": "cells are counted from 1"}
                raise PydanticCustomError("dial", "there is no cell {cell} among {divisions}", told)
        return self

    @property
    def parts(self) -> tuple[tuple[str, Fraction, Fraction], ...]:
        """Of every name, the divisions before it and those that it spans, exact."""
        found, first = [], Fraction(0)
        for each in self.names:
            span = Fraction(self.divisions, len(self.names)) if each.span is None else Fraction(each.span)
            found.append((each.name, first, span))
            first += span
        return tuple(found)


def _shared(name: str, parts: tuple[tuple[str, int], ...], divisions: object) -> list[tuple[str, int]]:
    """The names of a scale over some other number of divisions."""
    total, count = sum(span for _, span in parts), _whole(divisions)
    shares = [(part, Fraction(span * count, total)) for part, span in parts]
    if any(share.denominator > 1 for _, share in shares):
        told = {"name": name, "divisions": count, "fix": f"give {total}, or leave `divisions` out"}
        raise PydanticCustomError("dial", "{name} cannot share {divisions} divisions", told)
    return [(part, int(share)) for part, share in shares]


class DialRing(Graduation):
    """A scale around that of a dial, read by the same pointers.

    See Also
    --------
    Dial : holds it as `around`
    """


class Dial(Graduation):
    """A scale a pointer is read on. It stands on the link its output is relative to.

    Examples
    --------
    >>> Dial(names="zodiac").parts[4]
    ('Leo', Fraction(120, 1), Fraction(30, 1))

    See Also
    --------
    Train : holds them as `dials`, by name
    """

    face: str | None = Field(None, description="The side it is read from, such as front or back")
    turns: Whole = Field(1, description="Turns of a spiral")
    counted: Literal["clockwise", "counter-clockwise"] = Field(
        "clockwise", description="The way along which its divisions are counted, as read"
    )
    around: DialRing | None = Field(None, description="Another scale around this one, read by the same pointers")
    look: Literal["scale", "ball"] = Field(
        "scale",
        description="What is drawn: a scale with a pointer, or a ball, half black, such as shows the Moon's phase",
    )
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "null"}, handler(schema))


_BEHIND = ("back", "rear", "behind")  # words for the far side; a dial that looks elsewhere looks to the front


def looks_away(face: str | None, seen_from: str | None) -> bool:
    """True where a dial of some face looks away from one who looks at the train from some side.

    Parameters
    ----------
    face, seen_from : str or None
        As `Dial.face` and `View.from_` declare them; None looks to the reader.
    """
    return face is not None and (face in _BEHIND) != (seen_from in _BEHIND)
