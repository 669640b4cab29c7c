"""Levers: the elementary epicyclic sets of a train, each as points on a line.

Seen from its carrier k, a set turns all its members in fixed proportion: w_m = w_k + x_m u. So the points (x_m, w_m)
of one state lie on a straight line, the carrier's at x = 0 (Kutzbach 1927; Benford and Leising 1981, the lever
analogy).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.kinematics.components import find_components

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class Lever:
    """One epicyclic set: its carrier, and the abscissa of each member, the greatest of them 1.

    abscissae   link -> x, exact; the carrier's is 0
    """

    carrier: str
    abscissae: Mapping[str, Fraction]


def find_levers(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> list[Lever]:
    """Every elementary set of a train: what meshes in one moving carrier's frame, and turns on that carrier's axis.

    A planet is a member only where fewer than two other links are.
    """
    parts = find_components(tuple(train.links), train.frame, circuits)
    found = []
    for group, carrier in enumerate(parts.group_carrier):
        if carrier == parts.frame:
            continue
        nodes = [node for node, own in enumerate(parts.node_group) if own == group]
        if len(nodes) < 2:  # the slot of a follower, held by its pin
            continue
        relative = {parts.links[parts.node_link[node]]: parts.relative(node) for node in nodes}
        name = parts.links[carrier]
        axis = tree.axis(name)
        coaxial = {link: x for link, x in relative.items() if link == train.frame or tree.axis(link) == axis}
        members = coaxial if len(coaxial) > 1 else relative
        scale = max(members.values(), key=abs)
        found.append(Lever(name, {name: Fraction(0)} | {link: x / scale for link, x in members.items()}))
    return found
