"""What the train is asked for, and from where it is read: targets, expectations, outputs, units."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.quantity import Figure, Quantity, Share, Span
from geartrain.train.fields import Declared, Id, also, short_for


def _lasts(period: Quantity) -> Quantity:
    if period.value <= 0:
        raise PydanticCustomError(
            "target",
            "a period of {text} is none",
            {"text": period.text, "fix": "give a period above 0; `sense: retrograde` says that it runs backwards"},
        )
    return period


def _turns(figure: Figure) -> Figure:
    if figure.value <= 0:
        raise PydanticCustomError(
            "target",
            "{text} turns show no period",
            {"text": figure.text, "fix": "give a number above 0; `sense: retrograde` says that it runs backwards"},
        )
    return figure


def _no_tolerance(text: str) -> PydanticCustomError:
    fix = {"text": text, "fix": "a tolerance is a distance: give 0 or more"}
    return PydanticCustomError("tolerance", "a tolerance of {text} is met by nothing", fix)


def _not_negative(figure: Figure) -> Figure:
    if figure.value < 0:
        raise _no_tolerance(figure.text)
    return figure


class Target(Declared):
    """What an output should show: a name of the shipped table, a period or a speed. A bare text is a name.

    A `speed` carries its sign. A name or a period is a magnitude, which either sense meets, unless `sense` signs it.

    See Also
    --------
    Output : holds them as `targets`
    geartrain.kinematics.TargetResult : an output held against one
    """

    name: str | None = Field(None, description="A row of the shipped table; `geartrain periods` lists them")
    period: Annotated[Span, AfterValidator(_lasts)] | None = Field(
        None, description="Time of `turns` turns, such as 29.53059 d; above 0"
    )
    speed: Figure | None = Field(
        None, description="Speed in the train's unit, with its sign; 0 is compared by difference"
    )
    sense: Literal["direct", "retrograde"] | None = Field(
        None, description="Sense of a name or period, positive or negative speed; without it either will do"
    )
    turns: Annotated[Figure, AfterValidator(_turns)] = Field(
        Figure.parse(1), description="Turns of the pointer in the period (5 for a Metonic spiral); above 0"
    )
    tolerance: Share | None = Field(
        None,
        description="How far off counts as met, such as 20 ppm of the target; of a speed of 0, a plain number of "
        "units. `check` fails where it is missed; a target without a tolerance is information",
    )
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

    @model_validator(mode="after")
    def _has_one_sign(self) -> Target:
        if self.sense is not None and self.speed is not None:
            raise PydanticCustomError(
                "target",
                "the speed {speed} has a sign, and `sense` gives it another",
                {"speed": self.speed.text, "fix": "leave `sense` out, and write a retrograde speed with a minus"},
            )
        return self

    @model_validator(mode="after")
    def _is_near_something(self) -> Target:
        tolerance = self.tolerance
        if tolerance is None:
            return self
        if tolerance.value < 0:
            raise _no_tolerance(tolerance.text)
        if self.speed is not None and not self.speed.value and tolerance.unit is not None:
            raise PydanticCustomError(
                "target",
                "{tolerance} of a speed of 0 is 0",
                {"tolerance": tolerance.text, "fix": "give the difference allowed, a plain number in the train's unit"},
            )
        return self

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "string"}, handler(schema))


class Expect(Declared):
    """The mean speed an output must have: exact, or within its tolerance. A bare number is the value.

    Examples
    --------
    >>> from fractions import Fraction
    >>> Expect(value="254/19").holds(Fraction(254, 19)), Expect(value="13.37").holds(Fraction(254, 19))
    (True, True)
    >>> Expect(value="13.37", tolerance=0).holds(Fraction(254, 19))
    False
    """

    value: Figure = Field(description="Integer or fraction: exact. Decimal: at the digits written")
    tolerance: Annotated[Figure, AfterValidator(_not_negative)] | None = Field(
        None, description="Greatest difference that still holds"
    )

    def holds(self, speed: Any) -> bool:
        """True if a speed agrees.

        Parameters
        ----------
        speed : Fraction
            Exact [the train's unit].
        """
        return self.value.holds(speed, self.tolerance.value if self.tolerance else None)

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": ["number", "string"]}, handler(schema))


class Published(Declared):
    """What a source prints for an output.

    See Also
    --------
    Output : holds it as `published`
    """

    value: Figure = Field(description="The number as printed; it must hold at its digits")
    as_: Literal["speed", "input/output", "output/input"] = Field(
        "speed", alias="as", description="What the number is; ratios need one non-zero input"
    )
    tolerance: Annotated[Figure, AfterValidator(_not_negative)] | None = Field(
        None, description="Greatest difference that still holds"
    )
    place: str | None = Field(None, description="Where it is printed")
    source: str | None = Field(None, description="Key of the source")

    @model_validator(mode="after")
    def _can_be(self) -> Published:
        exact = self.value.half is None and (self.tolerance is None or not self.tolerance.value)
        if self.as_ == "input/output" and not self.value.value and exact:
            raise PydanticCustomError(
                "published",
                "an input over an output of 0 is no motion",
                {"fix": "an output that stands still is 0 as `output/input`"},
            )
        return self


class Output(Declared):
    """A motion the train is asked for: a link, or a link relative to a link.

    Examples
    --------
    >>> output = Output(of="planet", relative_to="carrier", expect="-20/21")
    >>> output.expect.value.value
    Fraction(-20, 21)
    """

    of: Id | None = Field(None, description="The link; default the output's own name")
    relative_to: Id | None = Field(None, description="The link it is seen from; default the frame")
    expect: Annotated[Expect, short_for("value")] | None = Field(
        None, description="The speed it must have, in the train's unit"
    )
    published: Published | None = Field(None, description="What a source prints")
    targets: tuple[Annotated[Target, short_for("name")], ...] = Field((), description="What it should show")
    dial: Id | None = Field(None, description="The dial it is read on")
    hand: Literal["needle", "hour", "minute", "seconds"] = Field(
        "needle", description="How its hand is made: slender, a spade, a long leaf, or thin with a counterpoise"
    )
    note: str | None = Field(None, description="A remark for the reader")

    def links(self, name: str, frame: str) -> tuple[str, str]:
        """The link that turns, and the link it is seen from.

        Parameters
        ----------
        name : str
            The output's own name, which is that of its link by default.
        frame : str
            The train's frame.
        """
        return self.of or name, self.relative_to or frame

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "null"}, handler(schema))


class SpeedUnit(Declared):
    """What a speed of 1 means: one turn per this.

    See Also
    --------
    Train : holds it as `unit`
    """

    per: str = Field(description="A period of the shipped table, or a quantity such as 7 d or 18 ft")


class View(Declared):
    """From where the train is looked at, and which sense is called positive.

    See Also
    --------
    Train : holds it as `view`
    """

    from_: str | None = Field(None, alias="from", description="The side the reader looks from, such as front")
    positive: Literal["clockwise", "counter-clockwise"] = Field(
        "counter-clockwise", description="The sense of a positive speed"
    )
