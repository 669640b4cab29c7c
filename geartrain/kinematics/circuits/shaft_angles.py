"""The angle under which the axes of a pair of bevel wheels meet, and bevels that would be in one place."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from math import atan2, sqrt

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.circuits.axes import Axes
from geartrain.kinematics.circuits.fundamental import Circuit
from geartrain.kinematics.circuits.joint_tree import Tree
from geartrain.numerics.vectors import ExactVector, Vector, cross, dot
from geartrain.train import Train

_MEET = 1e-3  # of the distance of two declared points: nearer axes meet, for positions are rounded


def shaft_angle(train: Train, tree: Tree, circuit: Circuit) -> float | None:
    """Shaft angle of a gear pair (rad, between 0 and pi); None where its axes are parallel.

    The sum of both cone angles, between the directions in which the wheels lie from the apex: an axis and its wheel's
    `facing`. Raises `RangeError` where axes with positions pass each other.
    """
    axes = Axes(train, tree)
    if axes.plain:
        return None
    labels = [tree.axis_seen_from(circuit.carrier, link) for link in (circuit.i, circuit.j)]
    u, v = (_floats(axes.direction(label)) for label in labels)
    across = cross(u, v)
    size = sqrt(dot(across, across))
    if not size:
        return None
    if passing_distance(axes, labels):
        raise RangeError(Problem("its axes do not meet", "they pass each other", "correct the positions of its axes"))
    facing = train.wheels[circuit.wheels[0]][1].facing * train.wheels[circuit.wheels[1]][1].facing
    return atan2(size, facing * dot(u, v))  # not acos, which loses half the digits near 0 and pi


def bevels_on_one_side(
    train: Train, circuits: Iterable[Circuit], is_rotation: Callable[[str, str], bool]
) -> Iterator[tuple[str, str, str]]:
    """Two bevels on parallel axes, and the bevel on another axis that both meet from the same side, by their `facing`.

    Their axes pass through its apex, so that both would be in one place. The sides follow from the senses of the two
    circuits.

    is_rotation   of two links, whether the axes between them are all parallel
    """
    mates: dict[str, list[tuple[str, str, bool]]] = {}
    for circuit in circuits:
        if circuit.kind != "gear" or any(train.wheels[wheel][1].kind != "bevel" for wheel in circuit.wheels):
            continue
        if not is_rotation(circuit.i, circuit.j):
            first, second = circuit.wheels
            mates.setdefault(second, []).append((first, circuit.i, circuit.b > 0))
            mates.setdefault(first, []).append((second, circuit.j, circuit.b > 0))
    for shared, sides in mates.items():
        for (one, link, side), (other, its, its_side) in combinations(sides, 2):
            if side == its_side and is_rotation(link, its):
                yield one, other, shared


def passing_distance(axes: Axes, labels: Sequence[str]) -> float | None:
    """How far from each other (m) two axes of different directions pass, 0 where they meet; None without positions."""
    here, there = (axes.positions.get(label) for label in labels)
    if here is None or there is None:
        return None
    across = cross(*(_floats(axes.direction(label)) for label in labels))
    apart = there[0].si - here[0].si, there[1].si - here[1].si, there[2].si - here[2].si
    offset, reach = abs(dot(apart, across)) / sqrt(dot(across, across)), sqrt(dot(apart, apart))
    return offset if offset > _MEET * reach else 0.0


def _floats(vector: ExactVector) -> Vector:
    return float(vector[0]), float(vector[1]), float(vector[2])
