"""Enumeration of all trains on a carrier by growth of concrete trees in the frame: Willis equation, mesh by mesh.

This program is independent: it reads plain data and imports nothing from the package. Trees have the form of
`concrete_trees`, so that they can be compared. All counts are chosen from the start, speeds are relative to the frame,
and a link that turns as fast as the carrier is not a special case.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

Node = tuple  # (name, driven wheel, dials, ((driving wheel, nodes), ...)), an added arbor or wheel has the name ""
Evidence = dict[str, Any]

CARRIER = "c"
DRIVEN = ("=", 0)


def carried_trains(evidence: Evidence) -> list[set[Node]]:
    """Return all trains with 0, 1, ... added wheels."""
    requested = evidence["reconstruct"]
    root = _source(evidence)
    found: list[set[Node]] = [set() for _ in range(requested["add"]["wheels"] + 1)]
    trees: set[Node] = {(root, (), (), ())}
    while trees:
        for tree in trees:
            if _complete(tree, evidence):
                found[_added(tree)].update(_dialled(tree, evidence))
        trees = {grown for tree in trees for grown in _grown(tree, evidence) if _allowed(grown, evidence)}
    return found


def _source(evidence: Evidence) -> str:
    return next((link for link in evidence["inputs"] if link != CARRIER), "frame")


def _grown(tree: Node, evidence: Evidence) -> Iterator[Node]:
    """Yield the tree with one more mesh: on every arbor, by every wheel that may drive, to every wheel that may be
    driven.
    """
    here = {node[0] for node in _nodes(tree)}
    minimum, maximum = evidence["reconstruct"]["add"]["teeth"]
    counts = range(minimum, maximum + 1)
    children: list[Node] = [("", ("", teeth), (), ()) for teeth in counts]
    for link in _survivors(evidence) - here:
        wheels = _wheels(evidence, link)
        children += [(link, (name, teeth), (), ()) for name, teeth in wheels.items()]
        children += [(link, ("", teeth), (), ()) for teeth in counts if not wheels]
    yield from _beneath(tree, children, evidence, counts)


def _wheels(evidence: Evidence, link: str) -> dict[str, int]:
    """Return the tooth counts of the surviving wheels of an arbor, negative for rings."""
    given = evidence["links"].get(link, {}).get("wheels", {})
    return {name: -of["teeth"] if isinstance(of, dict) else of for name, of in given.items()}


def _survivors(evidence: Evidence) -> set[str]:
    return set(evidence["links"]) - {"frame", CARRIER, _source(evidence)}


def _beneath(node: Node, children: list[Node], evidence: Evidence, counts: range) -> Iterator[Node]:
    name, driven, dials, drives = node
    wheels = _wheels(evidence, name)
    free = [(wheel, teeth) for wheel, teeth in wheels.items() if (wheel, teeth) != driven]
    free += [("", teeth) for teeth in counts]
    if driven and evidence["reconstruct"]["idlers"]:
        free.append(DRIVEN)
    for wheel in free:
        if wheel[0] and wheel in dict(drives):
            continue
        for child in children:
            yield name, driven, dials, _sorted((*drives, (wheel, (child,))))
    for at, (wheel, below) in enumerate(drives):
        rest = drives[:at] + drives[at + 1 :]
        for child in children:
            yield name, driven, dials, _sorted((*rest, (wheel, _sorted((*below, child)))))
        for nth, node_below in enumerate(below):
            others = below[:nth] + below[nth + 1 :]
            for grown in _beneath(node_below, children, evidence, counts):
                yield name, driven, dials, _sorted((*rest, (wheel, _sorted((*others, grown)))))


def _sorted(parts: tuple) -> tuple:
    return tuple(sorted(parts))


def _nodes(node: Node) -> list[Node]:
    return [node, *(each for _, below in node[3] for child in below for each in _nodes(child))]


def _added(tree: Node) -> int:
    return sum((node[1][:1] == ("",)) + sum(wheel[0] == "" for wheel, _ in node[3]) for node in _nodes(tree))


def _allowed(tree: Node, evidence: Evidence) -> bool:
    """Return True if further meshes may still complete the train. A leaf needs a dial."""
    joined = [{node[0], child[0]} for node in _nodes(tree) for _, below in node[3] for child in below]
    return (
        _added(tree) <= evidence["reconstruct"]["add"]["wheels"]
        and sum(not node[3] for node in _nodes(tree)) <= len(evidence["outputs"])
        and not any(pair <= _on_main_axis(evidence) for pair in joined)
        and all(max(pair) > 0 and sum(pair) * min(pair) > 0 for pair in _mates(tree) if min(pair) < 0)
    )


def _mates(tree: Node) -> list[tuple[int, int]]:
    """Yield the tooth counts of both wheels of each mesh."""
    drives = [(node, wheel, child) for node in _nodes(tree) for wheel, below in node[3] for child in below]
    return [(node[1][1] if wheel == DRIVEN else wheel[1], child[1][1]) for node, wheel, child in drives]


def _on_main_axis(evidence: Evidence) -> set[str]:
    return {link for joint in evidence["revolutes"] if joint["axis"] == "main" for link in joint["pair"]} | {
        _source(evidence)
    } - {CARRIER}


def _complete(tree: Node, evidence: Evidence) -> bool:
    use = evidence["reconstruct"]["use"]
    nodes = _nodes(tree)
    if use == "wheels":
        meshing = {node[1][0] for node in nodes if node[1]} | {wheel[0] for node in nodes for wheel, _ in node[3]}
        return all(name in meshing for link in evidence["links"].values() for name in link.get("wheels", {}))
    return use == "some" or _survivors(evidence) <= {node[0] for node in nodes}


def frame_speeds(tree: Node, evidence: Evidence) -> list[Fraction]:
    """Return the speeds of all arbors in the frame.

    Every mesh satisfies z_i (w_i - w_c) + z_j (w_j - w_c) = 0, where z is negative for a ring.
    """
    carrier = Fraction(evidence["inputs"][CARRIER])

    def beneath(node: Node, speed: Fraction) -> list[Fraction]:
        found = [speed]
        for wheel, below in node[3]:
            teeth = node[1][1] if wheel == DRIVEN else wheel[1]
            for child in below:
                found += beneath(child, (child[1][1] * carrier + teeth * carrier - teeth * speed) / child[1][1])
        return found

    return beneath(tree, Fraction(evidence["inputs"].get(_source(evidence), 0)))


def _dialled(tree: Node, evidence: Evidence) -> Iterator[Node]:
    nodes, speeds = _nodes(tree), frame_speeds(tree, evidence)
    carrier = Fraction(evidence["inputs"][CARRIER])
    fitting = []
    for output in evidence["outputs"].values():
        seen = carrier if output.get("relative_to") == CARRIER else Fraction(0)
        place = {"new": ""}.get(output.get("of", "?"), output.get("of"))
        fitting.append(
            [
                at
                for at, speed in enumerate(speeds)
                if speed - seen == Fraction(output["expect"]) and place in (None, nodes[at][0])
            ]
        )
    for places in itertools.product(*fitting):
        if {at for at, node in enumerate(nodes) if not node[3]} <= set(places):
            numbers = itertools.count()
            yield _shown(tree, dict(zip(evidence["outputs"], places, strict=True)), numbers)


def _shown(node: Node, places: dict[str, int], numbers: Iterator[int]) -> Node:
    own = next(numbers)
    dials = _sorted(tuple(dial for dial, at in places.items() if at == own))
    drives = tuple(
        (_plain(wheel), _sorted(tuple(_shown(one, places, numbers) for one in below))) for wheel, below in node[3]
    )
    return node[0], _plain(node[1]), dials, _sorted(drives)


def _plain(wheel: tuple) -> tuple:
    return wheel and (wheel[0], abs(wheel[1]))


# questions


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
