"""Integers and booleans in declarations, in which YAML represents them as text."""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from geartrain.numerics.quantity import bad


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
        fix = f"give a whole number from {low} to {high:,}"
        raise bad("number", f"{str(raw)[:30]} is not a valid number of {noun}", fix)

    return BeforeValidator(read)


def _boolean(raw: object) -> bool:
    """Parse true or false as in YAML 1.2, in which `yes` and `no` are ordinary text."""
    if isinstance(raw, bool):
        return raw
    if isinstance(raw, str) and raw.lower() in ("true", "false"):
        return raw.lower() == "true"
    raise bad("boolean", f"'{raw}' is neither true nor false", "write true or false")


Boolean = Annotated[bool, BeforeValidator(_boolean)]
