"""Lever analogy: the elementary epicyclic sets of a train represented as points on a line.

Relative to its carrier k, all members m of a set have fixed speed ratios: w_m = w_k + x_m u, where w are speeds, x_m is
a constant of each member, and the speed u is common to all members. The points (x_m, w_m) of one state therefore lie on
a straight line, with the carrier at x = 0 (Kutzbach 1927; Benford and Leising 1981).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.kinematics.components import find_components
from geartrain.numerics.results import Shown, brief

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class Lever(Shown):
    """Lever diagram of one epicyclic gear set: each member m is a point x_m on a line. Its speed is w_m = w_k + x_m u,
    where w_k is the speed of the carrier and u is a speed common to all members.
    """

    carrier: str
    """Name of the carrier k of the epicyclic set."""
    abscissae: Mapping[str, Fraction]
    """Exact abscissa x of each link, by link; 0 for the carrier, and at most 1 in magnitude."""

    def _summary(self) -> str:
        points = ", ".join(f"{link} {brief(x)}" for link, x in self.abscissae.items())
        return f"carrier {self.carrier}: {points}"


def find_levers(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> list[Lever]:
    """Return the lever of each epicyclic set of coaxial links that mesh relative to one moving carrier."""
    parts = find_components(tuple(train.links), train.frame, circuits)
    found = []
    for group, carrier in enumerate(parts.group_carrier):
        if carrier == parts.frame:
            continue
        nodes = [node for node, own in enumerate(parts.node_group) if own == group]
        if len(nodes) < 2:  # slot of a follower
            continue
        if any(parts.node_carrier[node] != carrier for node in nodes):  # a travel is not a speed about the axis
            continue
        relative = {parts.links[parts.node_link[node]]: parts.relative(node) for node in nodes}
        name = parts.links[carrier]
        axis = tree.axis(name)
        coaxial = {link: x for link, x in relative.items() if link == train.frame or tree.axis(link) == axis}
        members = coaxial if len(coaxial) > 1 else relative
        # exact, so that the first of two members at the same distance is reliably scaled to 1
        scale = max(members.values(), key=abs)
        found.append(Lever(name, {name: Fraction(0)} | {link: x / scale for link, x in members.items()}))
    return found
