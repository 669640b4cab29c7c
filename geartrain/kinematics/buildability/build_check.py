"""The one pass over a declaration that says what of it cannot be built."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from geartrain.kinematics.buildability.axis_kinds import check_kinds
from geartrain.kinematics.buildability.axis_triangles import check_triangles
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.clutch_axes import check_clutches
from geartrain.kinematics.buildability.equal_planets import check_planets
from geartrain.kinematics.buildability.idle_wheels import check_mates
from geartrain.kinematics.buildability.pitch_distances import PitchDistances
from geartrain.kinematics.buildability.pitch_pairs import PairOutline, pitch_pairs
from geartrain.kinematics.buildability.ring_mates import check_rings
from geartrain.kinematics.buildability.shared_wheels import check_shared_wheels
from geartrain.kinematics.buildability.skew_distances import check_skew
from geartrain.kinematics.circuits import find_circuits, find_tree
from geartrain.kinematics.planet_copies import has_copies, with_copies

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.train import Train


Outlines = Callable[[], Mapping[str, PairOutline]]
"""The pairs with declared teeth as they are cut, by name; called only where planets are compared."""


def check_build(
    train: Train, tree: Tree, circuits: Sequence[Circuit], outlines: Outlines = dict
) -> Iterator[BuildFinding]:
    """All that the declaration alone tells, rule by rule (docs/buildability.md)."""
    yield from check_mates(train)  # first: a wheel that a child adds without a pair changes no speed of its parent
    pairs = pitch_pairs(train, tree, circuits)
    yield from check_kinds(train, tree, circuits, pairs)
    yield from check_rings(pairs)
    sizes = PitchDistances(train, tree, circuits, pairs)
    yield from sizes.findings
    yield from check_skew(train, tree, pairs, sizes)
    yield from check_triangles(sizes)
    yield from check_shared_wheels(pairs, outlines)
    yield from _planets(train, tree, circuits, sizes, outlines)
    yield from check_clutches(train, tree)


def _planets(
    train: Train, tree: Tree, circuits: Sequence[Circuit], sizes: PitchDistances, outlines: Outlines
) -> Iterator[BuildFinding]:
    """Of all planets, also where one is declared for several."""
    if has_copies(train):
        train = with_copies(train, tree)
        tree = find_tree(train)
        circuits = find_circuits(train, tree)
        sizes = PitchDistances(train, tree, circuits, pitch_pairs(train, tree, circuits))
    yield from check_planets(train, tree, circuits, sizes, outlines)
