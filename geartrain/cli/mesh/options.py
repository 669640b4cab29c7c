"""Quantities as options of `geartrain mesh` give them."""

from __future__ import annotations

from geartrain.errors import GearTrainError, Problem


def quantity(place: str, text: str, dimension: str, plain: bool = False) -> float:
    """A quantity in SI units, as an option gives it."""
    from pydantic_core import PydanticCustomError

    from geartrain.quantity import Quantity

    try:
        found = Quantity.parse(text, dimension, plain)
    except PydanticCustomError as error:
        raise GearTrainError(Problem(error.message(), "", str((error.context or {}).get("fix", "")), place)) from None
    return found.si


def friction(text: str) -> float:
    """A coefficient of friction."""
    found = quantity("--friction", text, "fraction", plain=True)
    if found < 0:
        raise GearTrainError(
            Problem(f"a friction of {text} would push", "", "a coefficient of friction is 0 or more", "--friction")
        )
    return found


def placed(error: GearTrainError, place: str) -> GearTrainError:
    """The error with the option it came from, where it names no place itself."""
    from dataclasses import replace

    return GearTrainError(
        replace(problem, place=problem.place or place.replace("_", "-")) for problem in error.problems
    )
