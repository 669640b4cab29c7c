"""What a search asks of tooth counts besides ratios, and how it is read from a command line."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any, TypeVar

from pydantic_core import PydanticCustomError

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.quantity import Figure, Quantity

Read = TypeVar("Read")


@dataclass(frozen=True, slots=True)
class ConstraintOptions:
    """Constraints on tooth counts besides ratios. By default only that wheels between the same axes fit.

    See Also
    --------
    search_train : takes them.

    Examples
    --------
    >>> ConstraintOptions(planets=3, hunting=True).to_dict()
    {'shift': 0, 'planets': 3, 'addendum': '1', 'hunting': True}
    """

    coaxial: bool | None = None
    """Spur wheels of one module between the same two axes have one centre distance; where no module is declared they
    are taken to have one. None asks for it but where declared counts, none of them to be searched for, break it
    already: then modules differ, or teeth are shifted."""
    shift: int = 0
    """Half modules by which such distances may differ, for profile shift bridges them."""
    planets: int | Mapping[str, int] | None = None
    """Equal planets, equally spaced, on every carrier that moves planets; or carrier -> number. Equal are also the
    ways in which wheels stand on their arbors."""
    clearance: Fraction | None = None
    """Room between the tips of neighbouring planets [modules]: strictly more than this."""
    undercut: Quantity | None = None
    """Pressure angle, above 0 and below 90 deg: no external spur wheel is undercut by a rack."""
    interference: Quantity | None = None
    """Pressure angle: tips of spur wheels keep to the involute of their mates, in rings to their gaps too."""
    addendum: Fraction = Fraction(1)
    """Of external wheels and of the rack [modules]."""
    ring_addendum: Fraction | None = None
    """Of rings [modules]; None for that of external wheels. Rings are often cut shorter: at 1 and 20 deg 18 teeth in
    60 interfere."""
    minimum: int | None = None
    """Least tooth count of every free wheel, inclusive; worms are exempt."""
    most_teeth: int | None = None
    """Greatest tooth count of every free wheel, inclusive; worms are exempt."""
    largest_radius: Quantity | None = None
    """Of the pitch circle of every free wheel: a length, or a plain number of modules; worms are not asked."""
    different: bool = False
    """No free wheel has as many teeth as another wheel; equal planets may."""
    hunting: bool = False
    """Teeth of wheels that mesh have no common divisor."""
    closure: bool = False
    """The teeth of every loop meet at the declared positions of axes, where wheels reach each other."""

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON, quantities as written; rules that are off are left out."""
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
    undercut: str | None = None,
    interference: str | None = None,
    addendum: str | None = None,
    ring_addendum: str | None = None,
    largest_radius: str | None = None,
    **others: Any,
) -> ConstraintOptions:
    """Options read from texts as a command line has them; what is not given stays off.

    planets         "3" on every carrier, or "arm=3,inner=4"
    clearance, addendum, ring_addendum   numbers of modules: "0.5", "4/5"
    undercut, interference               pressure angles: "20 deg"
    largest_radius                       "60 mm", or "30" modules
    others          as in `ConstraintOptions`: coaxial, shift, least, most_teeth, different, hunting, closure

    The options of a command are named likewise, with `--no-coaxial` to turn that one off. `QuestionError` for what
    cannot be read, every one of them.
    """
    problems: list[Problem] = []

    def number(option: str, text: str | None) -> Fraction | None:
        found = _read(problems, option, text, Figure.parse)
        return None if found is None else found.value

    def angle(option: str, text: str | None) -> Quantity | None:
        return _read(problems, option, text, lambda raw: Quantity.parse(raw, "angle", plain=False))

    read: dict[str, Any] = {
        "planets": _read(problems, "planets", planets, _planets),
        "clearance": number("clearance", clearance),
        "undercut": angle("undercut", undercut),
        "interference": angle("interference", interference),
        "addendum": number("addendum", addendum),
        "ring_addendum": number("ring-addendum", ring_addendum),
        "largest_radius": _read(
            problems, "largest-radius", largest_radius, lambda raw: Quantity.parse(raw, "length", plain=True)
        ),
    }
    if problems:
        raise QuestionError(problems)
    return ConstraintOptions(**others, **{name: value for name, value in read.items() if value is not None})


def _read(problems: list[Problem], option: str, text: str | None, parse: Callable[[str], Read]) -> Read | None:
    """A text parsed; what is wrong with it is collected."""
    if text is None:
        return None
    try:
        return parse(text)
    except PydanticCustomError as error:
        fix = (error.context or {}).get("fix", "")
        problems.append(Problem(f"--{option}: {error.message()}", "it is not read", str(fix)))
        return None


def _planets(text: str) -> int | dict[str, int]:
    """`3`, or `arm=3,inner=4`."""
    names, found = [], []
    for piece in text.split(","):
        name, _, number = piece.rpartition("=")
        if not number.strip().isascii() or not number.strip().isdigit() or ("," in text and not name):
            raise PydanticCustomError(
                "planets", "'{text}' is no number of planets", {"text": text, "fix": "write 3, or arm=3,inner=4"}
            )
        names.append(name.strip())
        found.append(int(number))
    return dict(zip(names, found, strict=True)) if names[0] else found[0]


def turns(angle: Quantity) -> Fraction:
    """A pressure angle in turns, above 0 and below a quarter; radians to 50 digits."""
    found = angle.base
    if angle.dimension != "angle" or not 0 < found < Fraction(1, 4):
        raise QuestionError(
            Problem(f"{angle} is no pressure angle", "it is above 0 and below 90 deg", "write for example 20 deg")
        )
    return found
