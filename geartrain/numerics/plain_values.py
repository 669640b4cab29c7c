"""Integers and booleans in declarations, in which YAML represents them as text."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError


def whole_number(raw: object, low: int, high: int) -> int | None:
    """Return an integer from `low` to `high`, inclusive, given as an integer or as text; None for any other value."""
    try:
        # True is an int in Python; converting thousands of digits would take minutes
        number = raw if type(raw) is int else int(raw) if isinstance(raw, str) and len(raw) <= 30 else low - 1
    except ValueError:
        return None
    # `int` also accepts digits of other scripts, which are refused
    return number if low <= number <= high and str(raw).isascii() else None


def whole_from(low: int, high: int, noun: str) -> BeforeValidator:
    """Return a validator that reads an integer from `low` to `high`; `noun` is its name in messages, in plural form."""

    def read(raw: object) -> int:
        number = whole_number(raw, low, high)
        if number is not None:
            return number
        context = {"shown": str(raw)[:30], "noun": noun, "fix": f"give a whole number from {low} to {high:,}"}
        raise PydanticCustomError("number", "{shown} is not a valid number of {noun}", context)

    return BeforeValidator(read)


def _boolean(raw: object) -> bool:
    """Parse true or false as in YAML 1.2, in which `yes` and `no` are ordinary text."""
    if isinstance(raw, bool):
        return raw
    if isinstance(raw, str) and raw.lower() in ("true", "false"):
        return raw.lower() == "true"
    raise PydanticCustomError(
        "boolean", "'{raw}' is neither true nor false", {"raw": str(raw), "fix": "write true or false"}
    )


Boolean = Annotated[bool, BeforeValidator(_boolean)]
