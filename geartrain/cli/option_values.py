"""Parsers of option values, which check that numbers are finite and in the allowed range, and the option --theme.

An error in a pair of `geartrain mesh` is reported at the option that causes it.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import inf, tau
from typing import Annotated, Literal

import typer
from pydantic_core import PydanticCustomError

from geartrain.cli.common import option_error
from geartrain.errors import GearTrainError
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.scene.palette import ThemeName

Theme = Annotated[
    ThemeName, typer.Option("--theme", help="Colours of pictures: light, dark, or print (black and white).")
]


Minimum = Literal["0", "above 0"] | None
_MOST = 1e30  # squares and products of such numbers are floats
MOST_COUNT = 10**9
"""Maximum of any count; a run with a larger count would not end within a lifetime."""


def quantity(place: str, text: str, dimension: str, plain: bool = False, minimum: Minimum = None) -> float:
    """Parse a quantity in SI units; `minimum` is "0" for values of 0 or more, and "above 0" for positive values."""
    return read_quantity(place, text, dimension, plain, minimum).si


def read_quantity(place: str, text: str, dimension: str, plain: bool = False, minimum: Minimum = None) -> Quantity:
    """Parse a quantity and return it with the unit in which it was written. See `quantity` for the parameters."""
    try:
        found = Quantity.parse(text, dimension, plain)
    except PydanticCustomError as error:
        context = error.context or {}
        raise option_error(place, error.message(), str(context.get("fix", "")), str(context.get("why", ""))) from None
    if found.value and not dimension.startswith("fraction") and not 1 / _MOST < abs(found.si) < _MOST:
        fix = f"give a magnitude between {1 / _MOST:g} and {_MOST:g} in SI units"
        raise option_error(place, f"{text} is out of range", fix, "its square would overflow or underflow")
    if minimum == "above 0" and found.value <= 0:
        raise option_error(place, f"the value must be greater than 0, not {text}", f"give a {dimension} above 0")
    if minimum == "0" and found.value < 0:
        raise option_error(place, f"{text} is below 0", f"give a {dimension} of 0 or more")
    return found


def read_share(text: str, option: str) -> Fraction:
    """Parse an option as an exact fraction from a number, a percentage, ppm, or a clock rate in s/d."""
    return read_quantity(option, text, "fraction or clock rate", plain=True).base


def friction(text: str) -> float:
    """Parse a coefficient of friction, which must be 0 or more."""
    found = quantity("--friction", text, "fraction", plain=True)
    if found < 0:
        what = f"the coefficient of friction {text} is negative"
        raise option_error("--friction", what, "give a coefficient of 0 or more")
    return found


def restitution(text: str) -> float:
    """Parse a coefficient of restitution, which must be from 0 to 1."""
    return float(exact("--restitution", text, "restitution", "0.3", 0, 1))


def input_rate(text: str) -> float:
    """Parse an input speed and return it in rad/s. A number without a unit is in revolutions per second."""
    found = read_quantity("--rate", text, "speed", plain=True, minimum="above 0")
    # a number without a unit is in turns per second, not in rad/s
    return tau * float(found.value) if found.unit is None else found.si


def exact(place: str, text: str, what: str, such_as: str, low: float = -inf, high: float = inf) -> Fraction:
    """Parse a number from `low` to `high`. In an error, `what` is the name of the number, and `such_as` an example."""
    try:
        found = Figure.parse(text.strip()).value
    except PydanticCustomError:
        found = None
    if found is None or not low <= found <= high:
        bounds = (
            f" from {low:g} to {high:g}" if inf not in (-low, high) else f" of {low:g} or more" if low > -inf else ""
        )
        raise option_error(place, f"'{text}' is not a valid {what}", f"give a value{bounds}, such as {such_as}")
    return found


def decimal(place: str, text: str, what: str, such_as: str, low: float = 0.0) -> float:
    """Parse a number from `low` to 1e30 as a float; reject other text and numbers whose square would underflow."""
    found = float(exact(place, text, what, such_as, low, _MOST))
    if found and abs(found) < 1 / _MOST:
        fix = f"give a value such as {such_as}"
        raise option_error(place, f"'{text}' is not a valid {what}", fix, "its square would underflow")
    return found


def turns(place: str, text: str) -> Fraction:
    """Parse a number of revolutions of an input, and return it as a fraction. It may be negative."""
    from geartrain.dynamics.motion.motion_run import MOST_TURNS

    return exact(place, text, "number of turns", "4 or -1/2", -MOST_TURNS, MOST_TURNS)


def whole(place: str, text: str, what: str, such_as: str, low: int = 0) -> int:
    """Parse an integer from `low` to 10^9, both included. Raises `GearTrainError` for other values."""
    found = exact(place, text, what, such_as, low, MOST_COUNT)
    if found.denominator != 1:
        fix = f"give an integer, such as {such_as}"
        raise option_error(place, f"'{text}' is not a valid {what}", fix, "it is not an integer")
    return int(found)


def at_option(error: GearTrainError, place: str) -> GearTrainError:
    """Return an error whose problems have the option `place` as location, unless they have another location."""
    return GearTrainError(replace(each, place=each.place or place.replace("_", "-")) for each in error.problems)
