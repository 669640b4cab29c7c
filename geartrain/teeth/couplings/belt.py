"""Belts, chains and cables around two or more pulleys on parallel axes, as a train declares them.

The belt does not slip, so all pulleys have the same circumferential speed relative to their carrier k:
d_i (w_i - w_k) = s d_j (w_j - w_k). Here d are pitch diameters, or the tooth counts of toothed wheels. The sign s is 1
for pulleys that the belt turns in the same sense, and -1 for a crossed belt, or a pulley that the belt's back touches.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from math import asin, pi, sqrt
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PlainSerializer, WithJsonSchema, model_validator

from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.quantity import Quantity, bad
from geartrain.teeth.coupling import Coupling, CouplingRow, ratio_row

_BOTH_WAYS = "give all pulleys as wheels, or all as links with diameters"


def _read_pulleys(raw: object) -> object:
    """Convert the declared pulleys `raw` to a mapping from links to pitch diameters, or to a tuple of wheel names."""
    if isinstance(raw, Mapping):
        if any(size is None for size in raw.values()):
            raise bad("belt", "a pulley has no diameter", _BOTH_WAYS)
        found: Any = FrozenDict({str(link): Quantity.parse(size, "length", plain=True) for link, size in raw.items()})
        if zero := next((size for size in found.values() if size.value <= 0), None):
            raise bad("belt", f"a pulley has the diameter {zero.text}", "give pitch diameters above 0")
    elif isinstance(raw, list | tuple):
        if any(isinstance(each, Mapping | list | tuple) for each in raw):
            raise bad("belt", "wheels and diameters are mixed", _BOTH_WAYS)
        found = tuple(map(str, raw))
    else:
        raise bad("belt", "the pulleys are neither a mapping nor a list", "for example, write `around: [p, q]`")
    if len(found) < 2:
        raise bad("belt", "a belt needs at least two pulleys", "add a pulley")
    if twice := next((name for name in found if list(found).count(name) > 1), None):
        raise bad("belt", f"pulley '{twice}' is given twice", "give each pulley once")
    return found


def _written_pulleys(pulleys: Any) -> Any:
    """Return the pulleys in the form in which they are declared, for serialization."""
    return {link: str(size) for link, size in pulleys.items()} if isinstance(pulleys, Mapping) else list(pulleys)


Pulleys = Annotated[
    Any,
    BeforeValidator(_read_pulleys),
    PlainSerializer(_written_pulleys),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "object", "additionalProperties": {"type": ["string", "number"], "format": "length"}},
                {"type": "array", "items": {"type": ["string", "number"]}, "minItems": 2},
            ]
        }
    ),
]


class Belt(Coupling):
    """Belt, chain or cable that runs around two or more pulleys without slip."""

    ENDS = ("around",)
    SIDES = ("pulley", "pulley")
    PARALLEL = "a belt runs in one plane"
    HOLDS = True
    UNKNOWN = "slip, creep and stretch"

    kind: Literal["belt"] = Field(description="Belt, chain or cable: all pulleys have the same circumferential speed")
    around: Pulleys = Field(
        description="Links with the pitch diameters of their pulleys, or a list of wheels, "
        "whose tooth counts are used; the first determines the speeds of the "
        "others"
    )
    reversed: tuple[str, ...] = Field(
        (),
        description="Pulleys that turn in the opposite sense: a pulley of a crossed belt, "
        "or pulleys that the back of the belt touches",
    )

    @model_validator(mode="after")
    def _check_reversed(self) -> Belt:
        ends = self.ends
        if unknown := next((name for name in self.reversed if name not in ends), None):
            what = f"`reversed` names '{unknown}', which is not a pulley of this belt"
            raise bad("belt", what, f"choose from: {', '.join(ends[1:])}")
        if set(ends) == set(self.reversed) or (len(ends) == 2 and ends[0] in self.reversed):
            what = f"'{ends[0]}' is reversed, but the senses of the other pulleys refer to this one"
            raise bad("belt", what, f"reverse only other pulleys, such as `reversed: [{ends[1]}]`")
        return self

    @property
    def by_teeth(self) -> bool:
        """True if the pulleys are wheels with teeth, False if they are links with diameters."""
        return not isinstance(self.around, Mapping)

    @property
    def row_names(self) -> tuple[str, ...]:
        """Name of the belt if it has two pulleys; otherwise one name `first~other` for each further pulley."""
        first, *others = self.ends
        return (self.name,) if len(others) == 1 else tuple(f"{first}~{other}" for other in others)

    @property
    def about(self) -> str:
        """Text that lists the pulleys with their diameters and senses of rotation."""
        sizes = [""] * len(self.ends) if self.by_teeth else [f" {size}" for size in self.around.values()]
        marks = [" (reversed)" if name in self.reversed else "" for name in self.ends]
        return ", ".join(map("".join, zip(self.ends, sizes, marks, strict=True)))

    def problems(self, wheels: Mapping[str, tuple[str, Any]]) -> Iterator[tuple[str, str, str]]:
        """Yield the faults of the pulleys: two pulleys on one link, or a wheel around which a belt cannot run."""
        yield from super().problems(wheels)
        for name in self.ends if self.by_teeth else ():
            wheel = wheels[name][1]
            if wheel.internal or wheel.kind != "spur":
                shape = "ring" if wheel.internal else f"{wheel.kind} wheel"
                why = "a belt or chain goes around the outside of a wheel with external teeth"
                yield f"belt '{self.name}' goes around the {shape} '{name}'", why, "declare a wheel for the belt"

    @property
    def lengths(self) -> Iterator[Quantity]:
        """Pitch diameters of the pulleys."""
        return iter(() if self.by_teeth else self.around.values())

    def sense(self, pulley: str) -> int:
        """Return 1 if a pulley turns in the same sense as the first one, relative to the carrier, otherwise -1."""
        return 1 if (pulley in self.reversed) == (self.ends[0] in self.reversed) else -1

    def rows(self, wheels: Mapping[str, tuple[str, Any]]) -> Sequence[CouplingRow]:
        """Return one row for each pulley except the first pulley, which is the driving side of every row."""
        first, *others = self.ends
        links = dict(zip(self.ends, self.links(wheels), strict=True))
        found = []
        for name, other in zip(self.row_names, others, strict=True):
            ends, sense = (links[other], links[first]), self.sense(other)
            if self.by_teeth:
                # a missing count is reported with the circuits
                z, y = (wheels[wheel][1].count or 1 for wheel in (other, first))
                found.append(CouplingRow(name, *ends, z, -sense * y, (other, first)))
            else:
                mean: Fraction = sense * self.around[first].base / self.around[other].base
                found.append(ratio_row(name, *ends, mean))
        return found


def belt_length(diameters: tuple[float, float], distance: float, crossed: bool = False) -> float:
    """Return the length of a taut belt around two pulleys, in the unit of the diameters and of the axis distance.

    C is the axis distance. Half the difference (open belt) or half the sum (crossed belt) of the diameters is C
    sin(alpha). The straight parts are 2 C cos(alpha) long, and the belt wraps the angles pi - 2 alpha and pi + 2 alpha
    (open), or pi + 2 alpha on both pulleys (crossed).

    >>> round(belt_length((50.0, 75.0), 200.0), 6), round(belt_length((50.0, 75.0), 200.0, crossed=True), 6)
    (597.131045, 616.044608)
    """
    first, second = diameters
    half = (first + second if crossed else second - first) / 2
    straight, alpha = 2 * sqrt((distance - half) * (distance + half)), asin(half / distance)
    return straight + pi / 2 * (first + second) + 2 * alpha * half
