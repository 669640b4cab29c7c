"""Declarations corrupted at random, from a seed: shipped trains with changed values and changed structure.

A mutant of values has other scalars: zeros, very large and small numbers, names from elsewhere, units of another
dimension, and words that YAML converts to another type. A mutant of structure has parts removed, duplicated, moved,
wrapped in lists, or under other keys.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator
from functools import cache
from random import Random
from typing import Any

from geartrain import shipped
from geartrain.train.yaml_nodes import parse_yaml

Place = tuple[Any, Any]  # what holds the value, and its key or position there

NASTY: tuple[Any, ...] = (
    *("0", "-1", "1", "-0", "0.0", "1e300", "-1e300", "1e-300", "1/0", "1e999", "nan", "inf", "-inf", ".nan", ".inf"),
    *(
        "1/3",
        "-7/2",
        "1:30",
        "0x10",
        "1_000",
        "1000000000000",
        "999999999999999999999",
        "1" * 500,
        "",
        " ",
        "~",
        "null",
    ),
    *("true", "no", "0 rpm", "60 rpm", "1 rad/s", "5 mm", "0 mm", "-1 mm", "1e-300 mm", "0 d", "-7 d", "98 %", "100 %"),
    *("150 %", "0 %", "1 N m", "30 deg", "0 deg", "180 deg", "1e-300 deg", "\x1b[31m", "a,b", "=1+1", "<b>", "é" * 50),
    *(0, -1, 1.5, 1e300, 1e-300, float("nan"), float("inf"), 10**400, True, None, [], {}, [[]], {"a": {}}, ["a", "a"]),
)


@cache
def _originals() -> tuple[dict[str, Any], ...]:
    """Return the shipped trains as written, and trains that extend them."""
    found = []
    for name, path in shipped().items():
        if name.startswith("freeth-2021"):  # sixty-nine wheels take their time, and hold no key that others do not
            continue
        data = {"name": name, **parse_yaml(path.read_text(encoding="utf-8"), name).plain()}
        if "extends" in data:
            data["extends"] = data["extends"].removesuffix(".yaml")
        found.append(data)
    return tuple(found)


def mutant(seed: int) -> dict[str, Any]:
    """Return a shipped train with one to three corruptions."""
    random = Random(seed)
    data = copy.deepcopy(random.choice(_originals()))
    for _ in range(random.choice((1, 1, 2, 3))):
        places = list(_places(data))
        if places:
            random.choice((_other_value, _other_value, _other_structure))(random, places)
    return data


def _places(data: Any) -> Iterator[Place]:
    parts = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, part in parts:
        yield data, key
        yield from _places(part)


def _other_value(random: Random, places: list[Place]) -> None:
    """Replace a scalar by an invalid one, by one from elsewhere in the train, or by a plausible one."""
    scalars = [(holder, key) for holder, key in places if not isinstance(holder[key], dict | list)] or places
    holder, key = random.choice(scalars)
    alike = [(other, place) for other, place in scalars if place == key]
    kin = [(other, place) for other, place in scalars if str(other[place]).isdigit() == str(holder[key]).isdigit()]
    other, place = random.choice(random.choice((alike, kin, scalars)))
    holder[key] = copy.deepcopy(random.choice((random.choice(NASTY), other[place], other[place])))


def _other_structure(random: Random, places: list[Place]) -> None:
    """Remove, move, duplicate or wrap a part, or put it under another key."""
    holder, key = random.choice(places)
    other, place = random.choice(places)
    match random.randrange(6):
        case 0:
            del holder[key]
        case 1:
            holder[key] = copy.deepcopy(other[place])
        case 2:
            holder[key] = [holder[key]]
        case 3 if isinstance(holder, dict):
            holder[str(random.choice((place, "teeth", "form", "of", "frame", "extends", "x")))] = holder.pop(key)
        case 4 if isinstance(holder, list):
            holder.append(copy.deepcopy(holder[key]))
        case _:
            holder[key] = random.choice(({}, [], None, "x", {"x": "y"}))
