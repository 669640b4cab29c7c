"""Options for the constraints on tooth counts in a search, and a parser of these options for the command line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any

from pydantic_core import PydanticCustomError

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.quantity import Figure, Quantity


@dataclass(frozen=True, slots=True)
class ConstraintOptions:
    """Constraints on tooth counts in addition to the required ratios. By default only the centre distances of gear
    pairs between the same two axes must be equal.

    See Also
    --------
    search_train : Search with these constraints.

    Examples
    --------
    >>> ConstraintOptions(planets=3, hunting=True).to_dict()
    {'shift': 0, 'planets': 3, 'hunting': True}
    """

    coaxial: bool | None = None
    """Requirement that spur wheels of the same module between the same two axes have equal centre distances.

    Wheels without a declared module are assumed to have the same module. With None, two pairs of wheels are exempt if
    all their tooth counts are fixed and violate the requirement, because in that case their modules differ or their
    profiles are shifted.
    """
    shift: int = 0
    """Maximum difference between the centre distances of gear pairs between the same two axes, to be compensated by
    profile shift [half modules].
    """
    planets: int | Mapping[str, int] | None = None
    """Number of equal, equally spaced planets on every carrier with planets, or a mapping from carrier to number. With
    None, the numbers declared by `copies` are used.

    The wheels on the arbors of equal planets must have the same relative orientation.
    """
    clearance: Fraction | None = None
    """Lower bound (exclusive) of the clearance between the tips of neighbouring planets [modules]."""
    minimum: int | None = None
    """Minimum tooth count of every varied wheel, inclusive; worms are exempt."""
    maximum_teeth: int | None = None
    """Maximum tooth count of every varied wheel, inclusive; worms are exempt."""
    largest_radius: Quantity | None = None
    """Maximum pitch radius of every varied wheel: a length, or a number of modules; worms are exempt."""
    different: bool = False
    """True to require that no varied wheel has the same tooth count as another wheel; equal planets are exempt."""
    hunting: bool = False
    """True to require that the tooth counts of meshing wheels are coprime."""

    def to_dict(self) -> dict[str, Any]:
        """Return the options as a dict for JSON, in which quantities are strings. Options that are None or False are
        omitted.
        """
        found = {}
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None and value is not False:
                plain = isinstance(value, bool | int)
                found[field.name] = dict(value) if isinstance(value, Mapping) else value if plain else str(value)
        return found


def read_constraint_options(
    *,
    planets: str | None = None,
    clearance: str | None = None,
    largest_radius: str | None = None,
    **others: Any,
) -> ConstraintOptions:
    """Parse the options from the strings of a command line; options that are None keep their defaults.

    planets         number of planets: "3" for every carrier, or "arm=3,inner=4"
    clearance       clearance in modules, such as "0.5" or "4/5"
    largest_radius  length, such as "60 mm", or number of modules, such as "30"
    others          values of other fields of `ConstraintOptions`

    The `QuestionError` lists all strings that cannot be parsed, each with the name of its option of `geartrain teeth
    train`.
    """
    problems = []
    for name, option, text, parse in (
        ("planets", "planets", planets, _planets),
        ("clearance", "clearance", clearance, lambda text: Figure.parse(text).value),
        ("largest_radius", "max-radius", largest_radius, lambda text: Quantity.parse(text, "length", plain=True)),
    ):
        if text is None:
            continue
        try:
            others[name] = parse(text)
        except PydanticCustomError as error:
            why, fix = (str((error.context or {}).get(part, "")) for part in ("why", "fix"))
            problems.append(Problem(error.message(), why, fix, f"--{option}"))
    if problems:
        raise QuestionError(problems)
    return ConstraintOptions(**others)


def _planets(text: str) -> int | dict[str, int]:
    """Parse a number of planets, such as `3`, or a number for each carrier, such as `arm=3,inner=4`."""
    names, found = [], []
    for piece in text.split(","):
        name, _, number = piece.rpartition("=")
        if not number.strip().isascii() or not number.strip().isdigit() or ("," in text and not name):
            raise PydanticCustomError(
                "planets",
                "'{text}' is not a number of planets",
                {"text": text, "why": "a number of planets is a positive integer", "fix": "write 3, or arm=3,inner=4"},
            )
        names.append(name.strip())
        found.append(int(number))
    return dict(zip(names, found, strict=True)) if names[0] else found[0]
