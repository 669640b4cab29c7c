"""Distances between the axes of the pulleys of a belt, computed from declared positions, and the length of the belt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import NamedTuple

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.pitch_distances import axis_distance
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.numerics.quantity import millimetres
from geartrain.teeth.couplings.belt import Belt, belt_length
from geartrain.train import Train


class PulleyPair(NamedTuple):
    """Two pulleys of one belt, for which the diameters and the positions of the axes are declared."""

    belt: Belt
    pulleys: tuple[str, str]
    diameters: tuple[Fraction, Fraction]
    """Pitch diameters of the two pulleys [mm]."""
    distance: Fraction
    """Distance between the axes of the two pulleys [mm]."""

    @property
    def fits(self) -> bool:
        """True if the pulleys do not overlap."""
        return 2 * self.distance > sum(self.diameters)

    @property
    def length(self) -> float | None:
        """Length of the belt [mm]; None if the belt has more than two pulleys, or if the two pulleys overlap."""
        if len(self.belt.ends) > 2 or not self.fits:
            return None
        first, second = map(float, self.diameters)
        return belt_length((first, second), float(self.distance), crossed=bool(self.belt.reversed))


def pulley_pairs(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> Iterator[PulleyPair]:
    """Yield all pairs of pulleys of each belt for which diameters and axis positions are declared."""
    carriers = {circuit.id: circuit.carrier for circuit in circuits if circuit.kind == "belt"}
    for belt in train.couplings if carriers else ():
        if not isinstance(belt, Belt) or belt.by_teeth:
            continue
        carrier = carriers[belt.row_names[0]]
        for pulleys in combinations(belt.ends, 2):
            first, second = (tree.axis_seen_from(carrier, link) for link in pulleys)
            distance = axis_distance(train, (first, second))
            if distance is not None:
                one, other = (millimetres(belt.around[link]) for link in pulleys)
                yield PulleyPair(belt, pulleys, (one, other), distance)


def check_belts(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> Iterator[BuildFinding]:
    """Yield findings of rule B1: two pulleys of a belt overlap."""
    for pair in pulley_pairs(train, tree, circuits):
        if not pair.fits:
            (first, second), apart = pair.pulleys, float(pair.distance)
            what = f"the pulleys of '{first}' and '{second}' overlap: their axes are {apart:.6g} mm apart"
            radii = float(sum(pair.diameters)) / 2
            why = f"belt '{pair.belt.name}' needs more than the sum of their radii, {radii:.6g} mm"
            place = train.place("couplings", train.couplings.index(pair.belt))
            yield BuildFinding("B1", "error", Problem(what, why, "move an axis, or correct a diameter", place))
