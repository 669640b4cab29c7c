"""The parts a declaration is made of. Every field's description is what `geartrain schema` prints."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    GetJsonSchemaHandler,
    Tag,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from geartrain.quantity import Angle, Figure, Inertia, Length, Share, Span, Speed, Torque
from geartrain.teeth import ToothForm

MOST_TEETH = 10**12

Status = Literal["surviving", "reconstructed", "hypothetical"]


class Declared(BaseModel):
    """What all declared parts share: frozen, no unknown keys, numbers welcome as names."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", coerce_numbers_to_str=True, populate_by_name=True, defer_build=True
    )


def _count(raw: object) -> int:
    """A tooth count: a positive integer up to 10^12."""
    try:
        number = raw if type(raw) is int else int(raw) if isinstance(raw, str) and len(raw) <= 30 else None
    except ValueError:
        number = None
    if number is not None and 0 < number <= MOST_TEETH and str(raw).isascii():
        return number
    shown = str(raw) if len(str(raw)) <= 30 else str(raw)[:27] + "..."
    raise PydanticCustomError(
        "teeth",
        "{shown} is not a tooth count",
        {"shown": shown, "fix": "a tooth count is a whole number from 1 to 10^12"},
    )


def _boolean(raw: object) -> bool:
    """true or false, as YAML 1.2 writes them; `yes` and `no` are names there."""
    if isinstance(raw, bool):
        return raw
    if isinstance(raw, str) and raw.lower() in ("true", "false"):
        return raw.lower() == "true"
    raise PydanticCustomError(
        "boolean", "'{raw}' is neither true nor false", {"raw": str(raw), "fix": "write true or false"}
    )


def _side(raw: object) -> object:
    """1 or -1, also from text."""
    return int(raw) if raw in ("1", "+1", "-1") else raw


def _short_for(key: str) -> BeforeValidator:
    """A bare value stands for `{key: value}`; nothing stands for `{}`."""

    def expand(raw: object) -> object:
        if raw is None:
            return {}
        return raw if isinstance(raw, dict | BaseModel) else {key: raw}

    return BeforeValidator(expand)


def _empty_for_nothing(raw: object) -> object:
    return {} if raw is None else raw


def _also(kind: Any, schema: dict[str, Any]) -> dict[str, Any]:
    """A JSON schema that accepts a short form too."""
    return {"anyOf": [kind, schema]}


Id = Annotated[str, WithJsonSchema({"type": ["string", "number"]})]
"""A name, as written: numbers are names too."""
Count = Annotated[int, BeforeValidator(_count)]
Boolean = Annotated[bool, BeforeValidator(_boolean)]
Nothing = BeforeValidator(_empty_for_nothing)


class Source(Declared):
    """Where facts come from."""

    cite: str = Field(description="The citation")
    url: str | None = Field(None, description="Where it can be read")
    note: str | None = Field(None, description="How it was reached, or how far it is trusted")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "string"}, handler(schema))


class Teeth(Declared):
    """A tooth count with its doubt: a best value, and a range or choices."""

    value: Count | None = Field(None, description="The count used")
    range: tuple[Count, Count] | None = Field(
        None, description="Least and greatest count the evidence allows, inclusive"
    )
    choices: tuple[Count, ...] | None = Field(None, description="The counts the evidence allows")
    weights: tuple[Figure, ...] | None = Field(None, description="Relative weight of each count in range or choices")
    source: str | None = Field(None, description="Key of the source")
    search: tuple[Count, Count] | None = Field(None, description="The count is to be found within these bounds")
    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _makes_sense(self) -> Teeth:
        bounds = self.range or self.search
        if bounds and bounds[0] > bounds[1]:
            raise PydanticCustomError(
                "teeth",
                "the range {low} to {high} is empty",
                {"low": bounds[0], "high": bounds[1], "fix": "write the least count first"},
            )
        if self.value is None and self.search is None:
            raise PydanticCustomError(
                "teeth", "the tooth count has no value", {"fix": "give `value`, or `search` bounds"}
            )
        counts = self.allowed
        if self.value is not None and counts and self.value not in counts:
            raise PydanticCustomError(
                "teeth",
                "the value {value} lies outside what its evidence allows",
                {"value": self.value, "fix": "widen the range or choices, or correct the value"},
            )
        if self.weights is not None and len(self.weights) != len(counts):
            raise PydanticCustomError(
                "teeth",
                "{given} weights for {count} counts",
                {"given": len(self.weights), "count": len(counts), "fix": "give one weight for each count"},
            )
        return self

    @property
    def allowed(self) -> tuple[int, ...]:
        """All counts the evidence allows; empty where no doubt is declared."""
        if self.choices is not None:
            return self.choices
        if self.range is None or self.range[1] - self.range[0] > 10**6:
            return ()
        return tuple(range(self.range[0], self.range[1] + 1))


def _teeth_kind(raw: object) -> str:
    return "doubt" if isinstance(raw, dict | Teeth) else "count"


class Wheel(Declared):
    """A wheel on a link. A bare number is its tooth count."""

    teeth: Annotated[Annotated[Count, Tag("count")] | Annotated[Teeth, Tag("doubt")], Discriminator(_teeth_kind)] = (
        Field(description="Tooth count, or a count with its range; the starts of a worm")
    )
    internal: Boolean = Field(False, description="A ring: its teeth look inwards, and a mesh with it keeps the sense")
    kind: Literal["spur", "bevel", "contrate", "worm"] = Field("spur", description="How the teeth stand")
    facing: Annotated[Literal[1, -1], BeforeValidator(_side)] = Field(
        1, description="-1 if the wheel lies on the negative side of its axis (bevel, contrate)"
    )
    hand: Literal["right", "left"] = Field("right", description="Hand of a worm's thread")
    module: Length | None = Field(None, description="Pitch diameter over tooth count")
    status: Status | None = Field(None, description="surviving, reconstructed or hypothetical")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @property
    def count(self) -> int | None:
        """The tooth count used; None while it is still to be found."""
        return self.teeth if isinstance(self.teeth, int) else self.teeth.value

    @property
    def doubt(self) -> Teeth | None:
        """The declared range or choices, where the count is uncertain."""
        return self.teeth if isinstance(self.teeth, Teeth) and len(self.teeth.allowed) > 1 else None

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "integer", "minimum": 1}, handler(schema))


class Link(Declared):
    """A rigid body: an arbor with its wheels, a carrier, the frame."""

    wheels: dict[Id, Annotated[Wheel, _short_for("teeth")]] = Field(
        {}, description="The wheels fixed on this link, by id"
    )
    inertia: Inertia | None = Field(None, description="Moment of inertia about its axis")
    bearing: Torque | None = Field(None, description="Friction torque of its bearing")
    angle: Angle | None = Field(None, description="Angle at the start")
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "null"}, handler(schema))


class Axis(Declared):
    """Where an axis lies; moving axes in the pose where all angles are zero."""

    direction: tuple[Figure, Figure, Figure] = Field(
        (Figure.parse(0), Figure.parse(0), Figure.parse(1)),
        description="Direction vector, default z; speeds are positive about it",
    )
    position: tuple[Length, Length, Length] | None = Field(None, description="A point of the axis")
    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _points_somewhere(self) -> Axis:
        if not any(figure.value for figure in self.direction):
            raise PydanticCustomError(
                "axis", "the direction is the zero vector", {"fix": "give a direction such as [0, 0, 1]"}
            )
        return self


class Revolute(Declared):
    """A turning pair of two links; joints with one axis label are coaxial."""

    pair: tuple[Id, Id] = Field(description="The two links")
    axis: Id = Field(description="Label of the axis")
    note: str | None = Field(None, description="A remark for the reader")


class Efficiencies(Declared):
    """Basic efficiency of a pair, carrier held, by the wheel that drives."""

    forward: Figure = Field(description="With the first wheel driving")
    backward: Figure = Field(description="With the second wheel driving; 0 or less locks")


def _efficiency(raw: object) -> object:
    return raw if isinstance(raw, dict | Efficiencies) else {"forward": raw, "backward": raw}


class GearPair(Declared):
    """Two wheels in mesh. The carrier is found, not declared."""

    id: str = Field("", description="Name of the pair; default first~second")
    pair: tuple[Id, Id] = Field(description="The two wheels")
    tooth_form: ToothForm | None = Field(None, description="Form of the teeth; default the train's")
    friction: Figure | None = Field(None, description="Coefficient of friction between teeth")
    efficiency: Annotated[Efficiencies, BeforeValidator(_efficiency)] | None = Field(
        None, description="Basic efficiency with the carrier held: a number, or {forward, backward}"
    )
    driver: Id | None = Field(None, description="The wheel that drives")
    phase: Figure | None = Field(
        None,
        description="Fraction of a pitch by which a tooth of the first wheel is past the line of centres at the start",
    )
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @property
    def name(self) -> str:
        """The declared id, or first~second."""
        return self.id or f"{self.pair[0]}~{self.pair[1]}"


class Target(Declared):
    """What an output should show: a name of the shipped table, a period or a speed. A bare text is a name."""

    name: str | None = Field(None, description="A row of the shipped table; `geartrain periods` lists them")
    period: Span | None = Field(None, description="Time of `turns` turns, such as 29.53059 d")
    speed: Figure | None = Field(None, description="Speed in the train's unit")
    turns: Figure = Field(Figure.parse(1), description="Turns of the pointer in the period (5 for a Metonic spiral)")
    tolerance: Share | None = Field(None, description="How far off counts as met, such as 20 ppm")
    source: str | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _is_one_thing(self) -> Target:
        given = [key for key in ("name", "period", "speed") if getattr(self, key) is not None]
        if len(given) != 1:
            raise PydanticCustomError(
                "target",
                "a target is one thing, and this gives {given}",
                {"given": " and ".join(given) or "nothing", "fix": "give exactly one of name, period, speed"},
            )
        return self

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "string"}, handler(schema))


class Expect(Declared):
    """The mean speed an output must have: exact, or within its tolerance. A bare number is the value."""

    value: Figure = Field(description="Integer or fraction: exact. Decimal: at the digits written")
    tolerance: Figure | None = Field(None, description="Greatest difference that still holds")

    def holds(self, speed: Any) -> bool:
        """True if the exact `speed` agrees."""
        return self.value.holds(speed, self.tolerance.value if self.tolerance else None)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": ["number", "string"]}, handler(schema))


class Published(Declared):
    """What a source prints for an output."""

    value: Figure = Field(description="The number as printed; it must hold at its digits")
    as_: Literal["speed", "input/output", "output/input"] = Field(
        "speed", alias="as", description="What the number is; ratios need one non-zero input"
    )
    tolerance: Figure | None = Field(None, description="Greatest difference that still holds")
    place: str | None = Field(None, description="Where it is printed")
    source: str | None = Field(None, description="Key of the source")


class Output(Declared):
    """A motion the train is asked for: a link, or a link relative to a link."""

    of: Id | None = Field(None, description="The link; default the output's own name")
    relative_to: Id | None = Field(None, description="The link it is seen from; default the frame")
    expect: Annotated[Expect, _short_for("value")] | None = Field(
        None, description="The speed it must have, in the train's unit"
    )
    published: Published | None = Field(None, description="What a source prints")
    targets: tuple[Annotated[Target, _short_for("name")], ...] = Field((), description="What it should show")
    dial: Id | None = Field(None, description="The dial it is read on")
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "null"}, handler(schema))


class Clutch(Declared):
    """A brake or a clutch: one of `fixes` and `locks`."""

    fixes: Id | None = Field(None, description="The link it holds to the frame")
    locks: tuple[Id, Id] | None = Field(None, description="The two links it makes turn together")

    @model_validator(mode="after")
    def _is_one_thing(self) -> Clutch:
        if (self.fixes is None) == (self.locks is None):
            raise PydanticCustomError(
                "clutch", "a clutch fixes one link or locks two", {"fix": "give exactly one of fixes, locks"}
            )
        return self


class State(Declared):
    """One way the train is run. What is given here replaces the train's; outputs merge by name."""

    engaged: tuple[Id, ...] = Field((), description="Clutches and brakes that are closed")
    fixed: tuple[Id, ...] | None = Field(None, description="Links held to the frame")
    locks: tuple[tuple[Id, Id], ...] | None = Field(None, description="Pairs of links that turn together")
    inputs: dict[Id, Speed] | None = Field(None, description="Prescribed speeds by link")
    loads: dict[Id, Torque] | None = Field(None, description="Torques on links; power into the train is positive")
    solve_for: Id | None = Field(None, description="The link whose torque is unknown")
    outputs: dict[Id, Annotated[Output, Nothing]] = Field(
        {}, description="Outputs of this state, merged with the train's by name"
    )
    note: str | None = Field(None, description="A remark for the reader")


class Unit(Declared):
    """What a speed of 1 means: one turn per this."""

    per: str = Field(description="A period of the shipped table, or a quantity such as 7 d or 18 ft")


class View(Declared):
    """From where the train is looked at, and which sense is called positive."""

    from_: str | None = Field(None, alias="from", description="The side the reader looks from, such as front")
    positive: Literal["clockwise", "counter-clockwise"] = Field(
        "counter-clockwise", description="The sense of a positive speed"
    )


class Dial(Declared):
    """A scale a pointer is read on. It stands on the link its output is relative to."""

    face: str | None = Field(None, description="The side it is read from, such as front or back")
    turns: Count = Field(1, description="Turns of a spiral")
    divisions: Count = Field(1, description="Cells along all turns")
    note: str | None = Field(None, description="A remark for the reader")

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return _also({"type": "null"}, handler(schema))


class Erratum(Declared):
    """Something a source prints that is not so."""

    place: Id = Field(description="Where it is printed")
    printed: Id = Field(description="What is printed")
    right: Id = Field(description="What is right")
    why: str = Field(description="How one knows")


class Remove(Declared):
    """What a child takes away from its parent before it adds its own."""

    links: tuple[Id, ...] = Field((), description="Links, with their wheels, joints, pairs and couplings")
    wheels: tuple[Id, ...] = Field((), description="Wheels, with their pairs")
    gears: tuple[Id, ...] = Field((), description="Gear pairs by id")
    couplings: tuple[Id, ...] = Field((), description="Couplings by id")
    revolutes: tuple[tuple[Id, Id], ...] = Field((), description="Turning pairs by their two links")
    outputs: tuple[Id, ...] = Field((), description="Outputs by name")
    dials: tuple[Id, ...] = Field((), description="Dials by name")
    states: tuple[Id, ...] = Field((), description="States by name")
    axes: tuple[Id, ...] = Field((), description="Axes by label")
