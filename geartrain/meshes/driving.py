"""Who drives each gear pair, as far as the declaration tells."""

from __future__ import annotations

from collections import deque

from geartrain.meshes.mesh import Driver
from geartrain.train import Train


def find_drivers(train: Train) -> dict[str, Driver]:
    """Who drives each gear pair: declared, or the wheel nearer to where power enters."""
    near = _distances(train)
    far = len(near) + 1
    found = {}
    for gear in train.gears:
        if gear.driver is not None:
            found[gear.name] = Driver(gear.driver, "declared")
            continue
        first, second = (near.get(train.wheels[wheel][0], far) for wheel in gear.pair)
        found[gear.name] = Driver(gear.pair[1 if second < first else 0], "nearer to where power enters")
    return found


def _distances(train: Train) -> dict[str, int]:
    """How many pairs lie between each link and the nearest input, from link to link along pairs and couplings."""
    wheels = train.wheels
    ties = [(wheels[a][0], wheels[b][0]) for a, b in (gear.pair for gear in train.gears)]
    ties += [(coupling.pin, coupling.slot) for coupling in train.couplings]
    neighbours: dict[str, list[str]] = {}
    for a, b in ties:
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    entries = [train.crank] if train.crank is not None else [link for case in train.cases for link in case.inputs]
    found = dict.fromkeys(entries, 0)
    queue = deque(found)
    while queue:
        link = queue.popleft()
        for other in neighbours.get(link, ()):
            if other not in found:
                found[other] = found[link] + 1
                queue.append(other)
    return found
