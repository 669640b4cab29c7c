"""Tooth counts of wheels that a maker owns, or that a construction set contains (`wheel_sets.csv`)."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Annotated

from pydantic import AfterValidator, Discriminator, Field, Tag

from geartrain.errors import suggest
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.quantity import bad
from geartrain.train.fields import Count, Declared


@cache
def wheel_sets() -> Mapping[str, tuple[int, ...]]:
    """Return the tooth counts of the wheels of each construction set in the shipped table, in ascending order.

    Examples
    --------
    >>> wheel_sets()["meccano"]
    (15, 19, 25, 38, 50, 57, 60, 95, 133)
    """
    text = files("geartrain.train").joinpath("wheel_sets.csv").read_text(encoding="utf-8")
    found: dict[str, list[int]] = {}
    for row in csv.DictReader(text.splitlines()):
        found.setdefault(row["set"], []).append(int(row["teeth"]))
    return MappingProxyType({name: tuple(sorted(counts)) for name, counts in found.items()})


def _known(name: str) -> str:
    if name not in wheel_sets():
        otherwise = f"use one of {', '.join(wheel_sets())}, or a list of tooth counts"
        raise bad("teeth", f"the set of wheels '{name}' is unknown", suggest(name, wheel_sets(), otherwise=otherwise))
    return name


def _form(raw: object) -> str:
    """Return the form of `of`: a name, numbers of wheels, or a list of counts."""
    return "name" if isinstance(raw, str) else "numbers" if isinstance(raw, Mapping) else "list"


class OwnedWheels(Declared):
    """Wheels from which a wheel of the train is chosen.

    Examples
    --------
    >>> OwnedWheels(of={15: 2, 57: 1}).counts, OwnedWheels(of="lego").counts[:3]
    ((15, 57), (8, 12, 16))

    See Also
    --------
    Teeth : its field `search`
    """

    of: Annotated[
        Annotated[str, AfterValidator(_known), Tag("name")]
        | Annotated[dict[Count, Count], Field(min_length=1), AfterValidator(FrozenDict), Tag("numbers")]
        | Annotated[tuple[Count, ...], Field(min_length=1), Tag("list")],
        Discriminator(_form),
    ] = Field(
        description="Tooth counts: a list, a mapping from tooth count to the number of such wheels, or the name of a "
        "construction set (lego, meccano). Wheels with the same mapping share its wheels"
    )

    @property
    def counts(self) -> Sequence[int]:
        """Distinct tooth counts in ascending order."""
        return tuple(sorted(set(wheel_sets()[self.of] if isinstance(self.of, str) else self.of)))

    @property
    def numbers(self) -> tuple[tuple[int, int], ...]:
        """Tooth counts with the number of wheels of each; empty if the numbers are not limited."""
        return tuple(sorted(self.of.items())) if isinstance(self.of, Mapping) else ()
