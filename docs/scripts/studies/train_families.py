"""Families of trains whose exact answer is known by construction, at any size, from a seed."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from typing import Any

Data = dict[str, Any]
TEETH = {"form": "triangular", "half_angle": "30 deg", "window": 0.5}
"""Triangular teeth in the middle of each pair's window of clearance."""


def _ordinary(teeth: list[int], meshes: list[tuple[int, int]]) -> Data:
    """Wheels on fixed axes, one a link."""
    links: Data = {"frame": {}} | {f"g{at}": {"wheels": {f"w{at}": z}} for at, z in enumerate(teeth)}
    return {
        "links": links,
        "revolutes": [{"pair": ("frame", f"g{at}"), "axis": f"A{at}"} for at in range(len(teeth))],
        "gears": [{"pair": (f"w{i}", f"w{j}")} for i, j in meshes],
        "inputs": {"g0": 1},
    }


def chain(size: int, seed: int = 1) -> Data:
    """Wheels in a row, two on each arbor, the ratio kept between 1e-6 and 1e6."""
    draw = random.Random(seed)
    pairs, log = [], 0.0
    for _ in range(1, size):
        driver, driven = draw.randint(12, 119), draw.randint(12, 119)
        if abs(log + math.log10(driver / driven)) > 6:
            driver, driven = driven, driver
        log += math.log10(driver / driven)
        pairs.append((driver, driven))
    return _in_a_row(pairs)


def drift(size: int, seed: int = 1) -> Data:
    """Wheels in a row, two on each arbor, 23 to 27 teeth on 20 to 26: the ratio drifts, to 1e36 in a thousand links."""
    draw = random.Random(seed)
    return _in_a_row([(draw.randint(23, 27), draw.randint(20, 26)) for _ in range(1, size)])


def toothed_chain(pairs: int, seed: int = 1) -> Data:
    """A chain of so many pairs with triangular teeth, the whole ratio near 1.

    Of each pair drawn, the wheel drives that brings the ratio back. Ten tooth numbers make a hundred kinds of pairs.
    """
    draw, log = random.Random(seed), 0.0
    row = []
    for _ in range(pairs):
        driver, driven = draw.randrange(40, 80, 4), draw.randrange(40, 80, 4)
        if (driver > driven) == (log > 0):
            driver, driven = driven, driver
        log += math.log(driver / driven)
        row.append((driver, driven))
    return _in_a_row(row) | {"outputs": {f"g{pairs}": {}}, "tooth_form": TEETH}


def _in_a_row(pairs: list[tuple[int, int]]) -> Data:
    """A chain of pairs, driver and driven, each on the arbor of the one before."""
    links: Data = {"frame": {}, "g0": {"wheels": {}}}
    gears = []
    for at, (driver, driven) in enumerate(pairs, 1):
        links[f"g{at - 1}"]["wheels"][f"a{at}"] = driver
        links[f"g{at}"] = {"wheels": {f"b{at}": driven}}
        gears.append({"pair": (f"a{at}", f"b{at}")})
    joints = [{"pair": ("frame", f"g{at}"), "axis": f"A{at}"} for at in range(len(pairs) + 1)]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {"g0": 1}}


def tree(size: int, seed: int = 1) -> Data:
    """A random ordinary train: every wheel meshes with a wheel drawn among those before it."""
    draw = random.Random(seed)
    teeth = [draw.randint(12, 119) for _ in range(size)]
    return _ordinary(teeth, [(draw.randrange(at), at) for at in range(1, size)])


def epicyclic(size: int, seed: int = 1) -> Data:
    """Coaxial shafts, each driven by a planet that an earlier shaft carries and another earlier shaft drives.

    Both are drawn at random, so every speed depends on speeds from all over the train.
    """
    draw = random.Random(seed)
    links: Data = {"frame": {"wheels": {}}, "s0": {"wheels": {}}}
    shafts, joints, gears = ["frame", "s0"], [{"pair": ("frame", "s0"), "axis": "main"}], []
    for at in range(1, max(2, size // 2)):
        carrier = shafts[draw.randrange(1, len(shafts))]
        driver = draw.choice(shafts)
        if driver == carrier:
            driver = "frame"
        links[driver]["wheels"][f"d{at}"] = draw.randint(17, 90)
        links[f"p{at}"] = {"wheels": {f"pd{at}": draw.randint(17, 90), f"ps{at}": draw.randint(17, 90)}}
        links[f"s{at}"] = {"wheels": {f"w{at}": draw.randint(17, 90)}}
        joints += [{"pair": (carrier, f"p{at}"), "axis": f"P{at}"}, {"pair": ("frame", f"s{at}"), "axis": "main"}]
        gears += [{"pair": (f"d{at}", f"pd{at}")}, {"pair": (f"ps{at}", f"w{at}")}]
        shafts.append(f"s{at}")
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {"s0": 1}}


def cascade(size: int, seed: int = 1) -> Data:
    """Planetary stages with a fixed ring, alternately reducing and increasing by the same teeth."""
    draw = random.Random(seed)
    links: Data = {"frame": {"wheels": {}}, "c0": {"wheels": {}}}
    joints, gears = [{"pair": ("frame", "c0"), "axis": "main"}], []
    for at in range(1, max(2, size // 2)):
        if at % 2:
            sun, planet = draw.randint(12, 60), draw.randint(12, 60)
        solar, carrier = (f"c{at - 1}", f"c{at}") if at % 2 else (f"c{at}", f"c{at - 1}")
        links[f"c{at}"] = {"wheels": {}}
        links[f"p{at}"] = {"wheels": {f"pw{at}": planet}}
        links[solar]["wheels"][f"s{at}"] = sun
        links["frame"]["wheels"][f"r{at}"] = {"teeth": sun + 2 * planet, "internal": True}
        joints += [{"pair": ("frame", f"c{at}"), "axis": "main"}, {"pair": (carrier, f"p{at}"), "axis": f"P{at}"}]
        gears += [{"pair": (f"s{at}", f"pw{at}")}, {"pair": (f"pw{at}", f"r{at}")}]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": {"c0": 1}}


def lattice(size: int, seed: int = 1) -> Data:
    """A square lattice of meshing wheels on fixed axes: highly redundant, and it turns."""
    draw = random.Random(seed)
    side = max(2, math.isqrt(size))
    right = [(r * side + c, r * side + c + 1) for r in range(side) for c in range(side - 1)]
    down = [(r * side + c, r * side + c + side) for r in range(side - 1) for c in range(side)]
    return _ordinary([draw.randint(17, 99) for _ in range(side * side)], right + down)


def grid(size: int, seed: int = 1) -> Data:
    """A square grid of shafts, each the carrier of a differential between two neighbours; the rim is driven.

    Shafts stand between left and right or between upper and lower neighbours in turn, so every speed depends on
    every other, as in a discrete Laplace equation: the shape in which sparse elimination fills in.
    """
    draw = random.Random(seed)
    side = max(4, math.isqrt(size // 2))
    links: Data = {"frame": {}} | {f"s{r}_{c}": {"wheels": {}} for r in range(side) for c in range(side)}
    joints = [{"pair": ("frame", f"s{r}_{c}"), "axis": "main"} for r in range(side) for c in range(side)]
    gears, rim = [], {}
    for r in range(side):
        for c in range(side):
            here = f"{r}_{c}"
            if not (0 < r < side - 1 and 0 < c < side - 1):
                rim[f"s{here}"] = 1 + (3 * r + 5 * c) % 11
                continue
            one, other = ((r, c - 1), (r, c + 1)) if (r + c) % 2 else ((r - 1, c), (r + 1, c))
            sun, planet = draw.randint(17, 60), draw.randint(17, 60)
            links[f"p{here}"] = {"wheels": {f"pw{here}": planet}}
            links[f"s{one[0]}_{one[1]}"]["wheels"][f"sun{here}"] = sun
            links[f"s{other[0]}_{other[1]}"]["wheels"][f"ring{here}"] = {"teeth": sun + 2 * planet, "internal": True}
            joints.append({"pair": (f"s{here}", f"p{here}"), "axis": f"P{here}"})
            gears += [{"pair": (f"sun{here}", f"pw{here}")}, {"pair": (f"pw{here}", f"ring{here}")}]
    return {"links": links, "revolutes": joints, "gears": gears, "inputs": rim}


FAMILIES: dict[str, Callable[[int], Data]] = {
    "chain": chain,
    "drift": drift,
    "tree": tree,
    "epicyclic": epicyclic,
    "cascade": cascade,
    "lattice": lattice,
    "grid": grid,
}
