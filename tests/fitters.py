"""Epicyclic sets declared planet by planet, and tooth counts as columns, for the tests of assembly rules."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain import GearTrain
from geartrain.search import ConstraintOptions
from geartrain.search.constraints.assembly_constraints import find_constraints
from geartrain.train import Train

Central = Mapping[str, tuple[int, bool]]
"""Mapping of central wheel to (teeth, True for a ring)."""

Places = Sequence[tuple[float, float]]
"""Distance of each planet's axis from the central axis, and its azimuth [turns]."""


def epicyclic(
    central: Central,
    planets: Sequence[Mapping[str, int]],
    meshes: Sequence[tuple[str, str]],
    copies: int = 1,
    places: Places | None = None,
) -> dict[str, Any]:
    """Return a declaration with central wheels on separate links and planets on an arm; copies are evenly spaced."""
    links: dict[str, Any] = {"frame": {}, "arm": {}}
    links |= {f"L{name}": {"wheels": {name: {"teeth": z, "internal": ring}}} for name, (z, ring) in central.items()}
    revolutes = [{"pair": ["frame", link], "axis": "main"} for link in links if link != "frame"]
    axes: dict[str, Any] = {"main": {"position": ["0 mm", "0 mm", "0 mm"]}}
    gears = []
    for copy in range(copies):
        mark = "" if copy == 0 else f"-{copy}"
        for at, planet in enumerate(planets):
            links[f"P{at}{mark}"] = {"wheels": {f"{name}{mark}": z for name, z in planet.items()}}
            revolutes.append({"pair": ["arm", f"P{at}{mark}"], "axis": f"A{at}{mark}"})
            if places is not None:
                radius, turn = places[at]
                x, y = (radius * f(math.tau * (turn + copy / copies)) for f in (math.cos, math.sin))
                axes[f"A{at}{mark}"] = {"position": [f"{x:.13f} mm", f"{y:.13f} mm", "0 mm"]}
        gears += [{"pair": [name if name in central else f"{name}{mark}" for name in pair]} for pair in meshes]
    data = {"links": links, "revolutes": revolutes, "gears": gears}
    return data | ({"axes": axes} if places is not None else {})


def declared(data: Mapping[str, Any]) -> Train:
    return GearTrain.declare(data).declaration


def rules_of(train: Train | Mapping[str, Any], free: Sequence[str] | None = None, **requested: Any) -> tuple[Any, ...]:
    """Return the rules with some wheels variable, by default all."""
    found = train if isinstance(train, Train) else declared(train)
    wheels = found.wheels if free is None else free
    return find_constraints(
        found, {wheel: (found.wheels[wheel][1].count or 17,) for wheel in wheels}, ConstraintOptions(**requested)
    )


def columns(**counts: Any) -> dict[str, NDArray[np.int64]]:
    return {name: np.atleast_1d(np.array(count, dtype=np.int64)) for name, count in counts.items()}


def passed(rules: Sequence[Any], **counts: int) -> bool:
    """Return True if a set of counts satisfies all rules."""
    one = columns(**counts)
    return all(bool(rule.holds(one)[0]) for rule in rules)


def box(**ranges: Sequence[int]) -> dict[str, NDArray[np.int64]]:
    """Return all combinations of counts."""
    grids = np.meshgrid(*(np.array(counts, dtype=np.int64) for counts in ranges.values()), indexing="ij")
    return dict(zip(ranges, (grid.ravel() for grid in grids), strict=True))


SIMPLE: tuple[Central, list[dict[str, int]], list[tuple[str, str]]] = (
    {"s": (24, False), "r": (60, True)},
    [{"p": 18}],
    [("s", "p"), ("p", "r")],
)
