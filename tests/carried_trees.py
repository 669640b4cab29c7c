"""Enumeration of all trains on a carrier by growth of concrete trees in the frame: Willis equation, mesh by mesh.

This program is independent: it reads plain data and imports nothing from the package. Trees have the form of
`concrete_trees`, so that they can be compared. All counts are chosen from the start, speeds are relative to the frame,
and a link that turns as fast as the carrier is not a special case.
"""

from __future__ import annotations

import random
from fractions import Fraction
from itertools import combinations
from typing import Any

from geartrain.search.reconstruct import (
    Additions,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
)

Evidence = dict[str, Any]

CARRIER = "c"


def problem_by_hand(evidence: Evidence) -> ReconstructionProblem:
    """Seen from the carrier, its arbors are at rest, and the train begins at the frame or at the other driven link."""
    inputs, requested = evidence["inputs"], evidence["reconstruct"]
    carrier = Fraction(inputs[CARRIER])
    source = next((link for link in inputs if link != CARRIER), "frame")

    def arbor(link: str) -> SurvivingArbor:
        found = []
        for name, wheel in evidence["links"][link].get("wheels", {}).items():
            ring = isinstance(wheel, dict)
            found.append(SurvivingWheel(name, ((wheel["teeth"] if ring else wheel, Fraction(1)),), ring))
        return SurvivingArbor(link, tuple(found))

    def dial(name: str, output: dict[str, str]) -> SearchedDial:
        speed = Fraction(output["expect"]) - (0 if output.get("relative_to") == CARRIER else carrier)
        return SearchedDial(name, speed, speed, place=output.get("of"))

    on_axis = {source} | {link for joint in evidence["revolutes"] if joint["axis"] == "main" for link in joint["pair"]}
    return ReconstructionProblem(
        arbor(source),
        tuple(arbor(link) for link in evidence["links"] if link not in ("frame", CARRIER, source)),
        tuple(dial(*each) for each in evidence["outputs"].items()),
        Additions(requested["add"]["wheels"], *requested["add"]["teeth"]),
        Fraction(inputs.get(source, 0)) - carrier,
        coaxial=frozenset(map(frozenset, combinations(on_axis - {CARRIER, "frame"} | {source}, 2))),
        use=requested["use"],
        idlers=requested["idlers"],
    )


def random_evidence(seed: int, rings: bool = False) -> Evidence:
    """Return a small problem that usually has a solution: a random train on a carrier from which some wheels are
    removed.

    seed   seed of the problem
    rings  whether some of the surviving wheels are rings
    """
    chance = random.Random(seed)
    minimum = chance.randint(5, 9)
    maximum = minimum + chance.randint(1, 2)
    speed = Fraction(chance.choice((1, 1, -1, 2, -3)), chance.choice((1, 1, 2, 3)))
    source = chance.choice(("frame", "frame", "frame", "sun"))
    inputs = {CARRIER: speed}
    if source == "sun":
        inputs[source] = chance.choice([each for each in (speed + 1, speed - 1, speed + 2) if each])
    links: dict[str, Any] = {"frame": {}, CARRIER: {}, source: {"wheels": {}}}
    order: list[str] = [source]
    driven: dict[str, tuple[str, str]] = {}
    for number in range(1, chance.randint(2, 4)):
        parent = chance.choice(order)
        drivers = [wheel for wheel in links[parent]["wheels"] if wheel != driven.get(parent, ("", ""))[1]]
        if drivers and chance.random() < 0.5:
            wheel = chance.choice(drivers)
        else:
            wheel = f"{parent}w{len(links[parent]['wheels'])}"
            links[parent]["wheels"][wheel] = chance.randint(minimum, maximum)
        name = f"a{number}"
        links[name] = {"wheels": {f"{name}d": chance.randint(minimum, maximum)}}
        driven[name] = (wheel, f"{name}d")
        order.append(name)
        if rings and chance.random() < 0.6:
            outer, inner = chance.choice(((wheel, f"{name}d"), (f"{name}d", wheel)))
            arbor = name if outer == f"{name}d" else parent
            others = [own for driving, own in driven.values() if driving == outer]
            if all(_count(links, own) > 0 for own in (inner, outer)) and len(others) < 2:
                links[arbor]["wheels"][outer] = -_count(links, inner) - chance.randint(1, 3)
    teeth = {wheel: count for link in links.values() for wheel, count in link.get("wheels", {}).items()}
    speeds = {source: inputs.get(source, Fraction(0))}
    for name, (wheel, own) in driven.items():
        parent = next(link for link in order if wheel in links[link]["wheels"])
        speeds[name] = speed - Fraction(teeth[wheel], teeth[own]) * (speeds[parent] - speed)
    leaves = [name for name in order[1:] if len(links[name]["wheels"]) == 1]
    lost, left = set(), 2
    for name in chance.sample(order[1:], len(order) - 1):
        if min(links[name]["wheels"].values()) > 0 and len(links[name]["wheels"]) <= left and chance.random() < 0.7:
            lost.add(name)
            left -= len(links[name]["wheels"])
    for link in links.values():
        turned = {
            wheel: {"teeth": -count, "internal": True} for wheel, count in link.get("wheels", {}).items() if count < 0
        }
        link.setdefault("wheels", {}).update(turned)
    if left >= len(links[source]["wheels"]) and chance.random() < 0.4:
        links[source] = {}
    outputs = {
        f"d{name}": _random_output(chance, name, name in lost, speeds[name], speed, source) for name in leaves[:2]
    }
    joints = [{"pair": ["frame", CARRIER], "axis": "main"}] if chance.random() < 0.5 else []
    for name in order[1:]:
        if name not in lost and chance.random() < 0.5:
            on_frame = bool(joints) and joints[0]["axis"] == "main" and chance.random() < 0.3
            joints.append(
                {"pair": ["frame", name], "axis": "main"} if on_frame else {"pair": [CARRIER, name], "axis": name}
            )
    return {
        "name": f"carried-{seed}",
        "links": {name: link for name, link in links.items() if name not in lost},
        "revolutes": joints,
        "inputs": {link: str(value) for link, value in inputs.items()},
        "outputs": outputs,
        "reconstruct": {
            "carrier": CARRIER,
            "add": {"wheels": max(1, 2 - left) if rings else 2, "teeth": [minimum, maximum]},
            "use": chance.choice(("wheels", "wheels", "arbors", "some")),
            "idlers": chance.random() < 0.4,
        },
    }


def _count(links: dict[str, Any], wheel: str) -> int:
    return next(link["wheels"][wheel] for link in links.values() if wheel in link.get("wheels", {}))


def _random_output(
    chance: random.Random, name: str, lost: bool, speed: Fraction, carrier: Fraction, source: str
) -> dict[str, str]:
    of = {"of": "new" if lost else name} if source == "frame" or chance.random() < 0.6 else {}
    if chance.random() < 0.5:
        return {**of, "relative_to": CARRIER, "expect": str(speed - carrier)}
    return {**of, "expect": str(speed)}
