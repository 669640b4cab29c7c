"""When a train that counts time stands where: a date, and the turns of its input at that date."""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import Annotated, Any, Literal

from pydantic import Field, GetJsonSchemaHandler, model_validator
from pydantic_core import PydanticCustomError

from geartrain.numerics.calendar_dates import CalendarDate, julian_day, read_date
from geartrain.numerics.quantity import Figure
from geartrain.train.fields import Declared, Id, also, short_for


class Epoch(Declared):
    """A date, and the turns that the input has made by then since all pointers stood at the start of their scales.

    Years are astronomical: 0 is 1 BC, -204 is 205 BC. Dates before 1582-10-15 are of the Julian calendar, later ones of
    the Gregorian, unless `calendar` says otherwise. A bare text is the date.

    See Also
    --------
    Train : holds it as `epoch`

    Examples
    --------
    >>> Epoch(date="2000-01-01").julian_day
    Fraction(2451545, 1)
    """

    date: str = Field(
        description="Year, month, day, such as -204-05-12 for 12 May 205 BC, with an hour or not: `2000-01-01 18:30`; "
        "without one it is noon"
    )
    calendar: Literal["julian", "gregorian"] | None = Field(
        None, description="Calendar of the date; default Julian before 1582-10-15, Gregorian from then on"
    )
    turns: Figure = Field(
        Figure.parse(0),
        description="Turns that the input has made at the date, since all pointers stood at the start of their scales",
    )
    source: Id | None = Field(None, description="Key of the source")
    note: str | None = Field(None, description="A remark for the reader")

    @model_validator(mode="after")
    def _is_a_day(self) -> Epoch:
        try:
            self._read()
        except ValueError as error:
            raise PydanticCustomError(
                "date",
                "{problem}",
                {
                    "problem": str(error),
                    "fix": "write year-month-day, such as 2000-01-01, or -204-05-12 for 12 May 205 BC",
                },
            ) from None
        return self

    def _read(self) -> CalendarDate:
        return read_date(self.date, self.calendar)

    @cached_property
    def julian_day(self) -> Fraction:
        """Julian day of the date [d]: 0 is noon of -4712-01-01 in the Julian calendar."""
        return julian_day(self._read())

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return also({"type": "string"}, handler(schema))


DeclaredEpoch = Annotated[Epoch, short_for("date")]
"""An epoch, or its date."""
