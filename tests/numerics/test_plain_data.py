"""Results as plain data: keys, exact numbers, parts, and what is refused."""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np
import pytest

from geartrain.numerics.results import Key, Result, group, plain


class Place(NamedTuple):
    """A pair of names."""

    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class Part(Result):
    """Told by all its fields."""

    ratio: Fraction
    teeth: tuple[int, ...]
    place: Place | None = None


@dataclass(frozen=True)
class Whole(Result):
    """Told by its keys."""

    KEYS = ("name", Key("output/input", "part.ratio"), Key("value", "part.ratio", float), Key("", "part"), "sizes")

    name: str
    part: Part
    hidden: object = None

    @property
    def sizes(self) -> np.ndarray:
        """An array."""
        return np.array([[1.0, 2.0], [3.0, 4.0]])


def test_fields_are_told_in_order_with_exact_numbers_as_text() -> None:
    found = Part(Fraction(254, 19), (20, 30), Place("pair", "a~b")).to_dict()
    assert list(found.items()) == [
        ("ratio", "254/19"),
        ("teeth", [20, 30]),
        ("place", {"kind": "pair", "name": "a~b"}),
    ]


def test_keys_rename_convert_and_put_parts_among_the_whole() -> None:
    found = Whole("w", Part(Fraction(1, 4), ()), object()).to_dict()
    assert found == {
        "name": "w",
        "output/input": "1/4",
        "value": 0.25,
        "ratio": "1/4",
        "teeth": [],
        "place": None,
        "sizes": [[1.0, 2.0], [3.0, 4.0]],
    }
    assert json.loads(json.dumps(found)) == found


def test_a_conversion_reaches_every_number_and_leaves_none() -> None:
    halves = {"a": Fraction(1, 2), "b": (Fraction(3, 2), None), "c": [np.array([1.0])]}
    assert plain(halves, float) == {"a": 0.5, "b": [1.5, None], "c": [[1.0]]}


@dataclass(frozen=True)
class Grouped(Result):
    """Keys in objects of their own, and numbers told in two ways."""

    KEYS = (
        group("size", "minimum", Key("most", to=float)),
        Key("errors", keys=(Key("exact", "."), Key("value", ".", float))),
    )

    minimum: Fraction
    most: Fraction
    errors: dict[str, Fraction]


def test_keys_can_stand_in_a_group_and_tell_one_number_twice() -> None:
    assert Grouped(Fraction(1, 2), Fraction(3, 2), {"a": Fraction(1, 4)}).to_dict() == {
        "size": {"minimum": "1/2", "most": 1.5},
        "errors": {"a": {"exact": "1/4", "value": 0.25}},
    }


def test_what_float64_cannot_hold_is_none_and_long_fractions_keep_their_digits() -> None:
    assert plain(Fraction(10**5000 + 1)) == "1" + "0" * 4999 + "1"


def test_an_object_without_keys_is_refused() -> None:
    with pytest.raises(TypeError, match="no plain data"):
        plain(object())
