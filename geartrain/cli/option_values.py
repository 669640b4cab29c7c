"""Values of options: numbers that are finite and within the range of the option, and themes.

An error of a pair of `geartrain mesh` is reported at the option that it belongs to.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, tau
from typing import Annotated, Literal

import typer
from pydantic_core import PydanticCustomError

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.scene.palette import ThemeName

Theme = Annotated[ThemeName, typer.Option("--theme", help="Colours of pictures: light, dark, or print without colour.")]


Minimum = Literal["0", "above 0"] | None
_MOST = 1e30  # squares and products of such numbers are floats
MOST_COUNT = 10**9
"""More of anything than a run ends within a lifetime."""


def quantity(place: str, text: str, dimension: str, plain: bool = False, minimum: Minimum = None) -> float:
    """A quantity in SI units; `minimum` says that it must be 0 or more, or above 0. Raises `GearTrainError`."""
    return read_quantity(place, text, dimension, plain, minimum).si


def read_quantity(place: str, text: str, dimension: str, plain: bool = False, minimum: Minimum = None) -> Quantity:
    """The same as it was written."""
    try:
        found = Quantity.parse(text, dimension, plain)
    except PydanticCustomError as error:
        raise value_error(error, place) from None
    if found.value and dimension != "fraction" and not 1 / _MOST < abs(found.si) < _MOST:
        fix = f"give one between {1 / _MOST:g} and {_MOST:g} in SI units"
        raise GearTrainError(Problem(f"{text} is beyond all measure", "its square is lost in rounding", fix, place))
    if found.value < 0 and minimum is not None:
        raise GearTrainError(Problem(f"{text} is below 0", "", f"give a {dimension} of 0 or more", place))
    if found.value == 0 and minimum == "above 0":
        raise GearTrainError(Problem(f"{text} is not above 0", "", f"give a {dimension} above 0", place))
    return found


def friction(text: str) -> float:
    """A coefficient of friction."""
    found = quantity("--friction", text, "fraction", plain=True)
    if found < 0:
        raise GearTrainError(
            Problem(f"a friction of {text} would push", "", "a coefficient of friction is 0 or more", "--friction")
        )
    return found


def restitution(text: str) -> float:
    """A coefficient of restitution."""
    return float(exact("--restitution", text, "restitution", "0.3", 0, 1))


def input_rate(text: str) -> float:
    """A speed of the input (rad/s); a plain number is turns a second."""
    found = read_quantity("--rate", text, "speed", plain=True, minimum="above 0")
    return tau * float(found.value) if found.unit is None else found.si


def exact(place: str, text: str, what: str, such_as: str, low: float = -inf, high: float = inf) -> Fraction:
    """A number such as 3, -1/4 or 2.5, within a range; `what` it is, in words. Raises `GearTrainError`."""
    try:
        found = Figure.parse(text.strip()).value
    except PydanticCustomError:
        found = None
    if found is None or not low <= found <= high:
        bounds = (
            f" from {low:g} to {high:g}" if inf not in (-low, high) else f" of {low:g} or more" if low > -inf else ""
        )
        raise GearTrainError(Problem(f"'{text}' is no {what}", "", f"give one{bounds}, such as {such_as}", place))
    return found


def decimal(place: str, text: str, what: str, such_as: str, low: float = 0.0, high: float = _MOST) -> float:
    """A plain number within a range, not so small that its square is lost. Raises `GearTrainError`."""
    found = float(exact(place, text, what, such_as, low, high))
    if found and abs(found) < 1 / _MOST:
        raise GearTrainError(Problem(f"'{text}' is no {what}", "it is lost in rounding", f"give {such_as}", place))
    return found


def turns(place: str, text: str) -> Fraction:
    """Turns of an input, forwards or back."""
    from geartrain.dynamics.motion.motion_run import MOST_TURNS

    return exact(place, text, "number of turns", "4 or -1/2", -MOST_TURNS, MOST_TURNS)


def whole(place: str, text: str, what: str, such_as: str, low: int = 0, high: int = MOST_COUNT) -> int:
    """A whole number within a range. Raises `GearTrainError`."""
    found = exact(place, text, what, such_as, low, high)
    if found.denominator != 1:
        raise GearTrainError(Problem(f"'{text}' is no {what}", "it is not whole", f"give one such as {such_as}", place))
    return int(found)


def value_error(error: PydanticCustomError, place: str) -> GearTrainError:
    """What a reader of numbers complains of, as a user reads it."""
    context = error.context or {}
    return GearTrainError(Problem(error.message(), str(context.get("why", "")), str(context.get("fix", "")), place))


def at_option(error: GearTrainError, place: str) -> GearTrainError:
    """The error with the option it came from, where it names no place itself."""
    from dataclasses import replace

    return GearTrainError(
        replace(problem, place=problem.place or place.replace("_", "-")) for problem in error.problems
    )
