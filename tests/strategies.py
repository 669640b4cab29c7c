"""Random trains as plain declarations, as Hypothesis strategies.

A train grows as a tree whose axis labels are correct by construction: a new link is attached to an existing one, either
about an axis that this link bears or about a new axis. Pairs are then drawn among those whose path changes axis exactly
once. The result covers ordinary trains, planetary stages, coupled epicyclics and nested carriers, loops that close (one
wheel per link) and loops that do not (separate wheels), rings, pins and slots.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any, TypeVar

from hypothesis import assume
from hypothesis import strategies as st
from reference_solver import find_carrier, is_a_linkage, solve_naively, turning_graph

Data = dict[str, Any]
Item = TypeVar("Item")

teeth = st.integers(min_value=8, max_value=40)
# the simplest first: to them a failure is shrunk
SPEEDS = sorted(
    {Fraction(above, below) for below in range(1, 7) for above in range(-9 * below, 9 * below + 1)},
    key=lambda speed: (speed.denominator, abs(speed), speed < 0),
)
speeds = st.sampled_from(SPEEDS)
turning = st.sampled_from(SPEEDS[1:])


def choose(draw: st.DrawFn, items: Sequence[Item]) -> Item:
    """Draw one of some items by its index; Hypothesis caches strategies of indices."""
    return items[draw(st.integers(0, len(items) - 1))]


@st.composite
def skeletons(draw: st.DrawFn, most: int = 9) -> Data:
    """Draw links and turning pairs."""
    count = draw(st.integers(min_value=2, max_value=most))
    links = ["frame"]
    borne: dict[str, list[str]] = {"frame": []}
    revolutes = []
    for at in range(1, count + 1):
        link = f"L{at}"
        parent = choose(draw, links)
        fresh = not borne[parent] or draw(st.integers(0, 2)) > 0
        axis = f"A{at}" if fresh else choose(draw, borne[parent])
        if fresh:
            borne[parent].append(axis)
        borne[link] = [axis]
        links.append(link)
        pair = [parent, link] if draw(st.booleans()) else [link, parent]
        revolutes.append({"pair": pair, "axis": axis})
    return {"links": {link: {"wheels": {}} for link in links}, "revolutes": revolutes, "gears": [], "couplings": []}


@st.composite
def trains(draw: st.DrawFn, most: int = 9, couplings: bool = True, pairs: int | None = None) -> Data:
    """Draw a train without inputs: free, locked or in between."""
    data = draw(skeletons(most))
    graph = turning_graph(data)
    able = [pair for pair in combinations(data["links"], 2) if find_carrier(graph, *pair) is not None]
    assume(able)
    one_wheel = {link: draw(teeth) for link in data["links"]} if draw(st.booleans()) else {}
    for at in range(draw(st.integers(min_value=1, max_value=pairs or len(data["links"])))):
        i, j = choose(draw, able)
        if draw(st.booleans()):
            i, j = j, i
        kind = choose(draw, ["gear"] * 8 + (["pin_and_slot", "pin_follower"] if couplings else []))
        if kind == "gear":
            data["gears"].append({"id": f"G{at}", "pair": _wheels(draw, data, one_wheel, i, j, at)})
        else:
            data["couplings"].append({"id": f"C{at}", "kind": kind, "pin": i, "slot": j})
    return data


def _wheels(draw: st.DrawFn, data: Data, one_wheel: dict[str, int], i: str, j: str, at: int) -> list[str]:
    if one_wheel and draw(st.integers(0, 3)):
        for link in (i, j):
            data["links"][link]["wheels"][f"w{link}"] = one_wheel[link]
        return [f"w{i}", f"w{j}"]
    ring = choose(draw, [None, None, i, j])
    for link in (i, j):
        count = draw(teeth)
        data["links"][link]["wheels"][f"w{at}{link}"] = {"teeth": count, "internal": True} if link == ring else count
    return [f"w{at}{i}", f"w{at}{j}"]


@st.composite
def requested_trains(draw: st.DrawFn) -> Data:
    """Draw a train with random inputs: determined, free, locked or contradictory."""
    data = draw(trains())
    moving = [link for link in data["links"] if link != "frame"]
    chosen = draw(st.lists(st.sampled_from(tuple(moving)), unique=True, max_size=3))
    data["inputs"] = {link: draw(speeds) for link in chosen}
    data["fixed"] = draw(st.lists(st.sampled_from(tuple(data["links"])), unique=True, max_size=1))
    if draw(st.booleans()):
        data["locks"] = [list(draw(st.permutations(moving))[:2])]
    assume(not is_a_linkage(data))
    return data


@st.composite
def driven_trains(draw: st.DrawFn, **shape: Any) -> Data:
    """Draw a determined train: inputs are added until the naive solver finds no free speed."""
    data = draw(trains(**shape))
    data["inputs"] = {}
    if draw(st.integers(0, 3)) == 0:
        data["fixed"] = [choose(draw, [link for link in data["links"] if link != "frame"])]
        assume(not is_a_linkage(data))
    known = solve_naively(data)
    while known.kind == "free":
        link = choose(draw, sorted(known.undetermined))
        data["inputs"][link] = draw(turning)
        known = solve_naively(data)
    assume(known.kind == "determined")
    return data


@st.composite
def overdriven_trains(draw: st.DrawFn) -> Data:
    """Draw a determined train with one additional input at a contradicting speed."""
    data = draw(driven_trains())
    spare = [link for link in data["links"] if link != "frame" and link not in data["inputs"]]
    assume(spare)
    link = choose(draw, spare)
    wrong = solve_naively(data).speeds[link] + draw(turning)
    order = draw(st.permutations([*data["inputs"].items(), (link, wrong)]))
    return {**data, "inputs": dict(order)}


@st.composite
def ordinary_trains(draw: st.DrawFn, most: int = 12) -> Data:
    """Draw a train with fixed axes, each wheel driven by an earlier one: no loop, mobility 1."""
    count = draw(st.integers(min_value=2, max_value=most))
    data: Data = {"links": {"frame": {}}, "revolutes": [], "gears": [], "inputs": {"g0": Fraction(1)}}
    for at in range(count):
        data["links"][f"g{at}"] = {"wheels": {}}
        data["revolutes"].append({"pair": ["frame", f"g{at}"], "axis": f"x{at}"})
        if at:
            before = draw(st.integers(min_value=0, max_value=at - 1))
            ring = draw(st.integers(0, 4)) == 0
            data["links"][f"g{before}"]["wheels"][f"d{at}"] = draw(teeth)
            data["links"][f"g{at}"]["wheels"][f"n{at}"] = {"teeth": draw(teeth), "internal": ring}
            data["gears"].append({"pair": [f"d{at}", f"n{at}"]})
    return data


@st.composite
def planetary_sets(draw: st.DrawFn) -> Data:
    """Draw two central wheels, a carrier, and a planet with one or two wheels: two degrees of freedom."""
    first, second = draw(st.booleans()), draw(st.booleans())
    compound = draw(st.booleans())
    data: Data = {
        "links": {
            "frame": {},
            "a": {"wheels": {"a": {"teeth": draw(teeth), "internal": first}}},
            "b": {"wheels": {"b": {"teeth": draw(teeth), "internal": second}}},
            "c": {},
            "planet": {"wheels": {"p": draw(teeth), **({"q": draw(teeth)} if compound else {})}},
        },
        "revolutes": [
            {"pair": ["frame", "a"], "axis": "main"},
            {"pair": ["frame", "b"], "axis": "main"},
            {"pair": ["frame", "c"], "axis": "main"},
            {"pair": ["c", "planet"], "axis": "planet"},
        ],
        "gears": [{"pair": ["a", "p"]}, {"pair": ["b", "q" if compound else "p"]}],
    }
    return data


@st.composite
def rerooted(draw: st.DrawFn, data: Data) -> Data:
    """Return the same train with every set of coaxial links joined by another tree."""
    members: dict[str, list[str]] = {}
    for joint in data["revolutes"]:
        for link in joint["pair"]:
            if link not in members.setdefault(joint["axis"], []):
                members[joint["axis"]].append(link)
    revolutes = []
    for axis, links in members.items():
        order = draw(st.permutations(links))
        for at in range(1, len(order)):
            revolutes.append({"pair": [choose(draw, order[:at]), order[at]], "axis": axis})
    return {**data, "revolutes": revolutes}
