"""Whether three axes with known distances have a place: the triangle inequality."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.pitch_distances import PitchDistances
    from geartrain.kinematics.buildability.pitch_pairs import PitchPair

_EQUAL = Fraction(1, 10**6)  # of the longest side: three axes may stand in one plane


def check_triangles(sizes: PitchDistances) -> Iterator[BuildFinding]:
    """Rule P3, for three axes whose distances are multiples of one length, known or not."""
    sides = {node[1:]: pairs[0] for node, pairs in sizes.between.items()}
    near: dict[str, dict[str, PitchPair]] = {}
    for (first, second), pair in sides.items():
        near.setdefault(first, {})[second] = pair
        near.setdefault(second, {})[first] = pair
    for (first, second), pair in sides.items():
        fewer, more = sorted((near[first], near[second]), key=len)
        for third in fewer:
            # each triangle once, from its last two labels in order
            if third in more and third < first:
                yield from _triangle(sizes, (third, first, second), (pair, near[third][first], near[third][second]))


def _triangle(
    sizes: PitchDistances, axes: tuple[str, str, str], pairs: tuple[PitchPair, PitchPair, PitchPair]
) -> Iterator[BuildFinding]:
    found = [sizes.distance(pair.axis_pair) for pair in pairs]
    if len({root for root, _ in found}) > 1:
        return
    order = sorted(range(3), key=lambda at: found[at][1])
    short, middle, long = (found[at][1] for at in order)
    lack = long - short - middle
    if lack <= _EQUAL * long:
        return
    # how far each pair may stand from its design, in the same length
    room = sum(
        (
            abs(pair.bounds[1] - pair.distance) / pair.distance * size[1]
            for pair, size in zip(pairs, found, strict=True)
        ),
        Fraction(0),
    )
    last = pairs[order[2]]
    measure = sizes.measure(last)
    sums = " + ".join(measure(found[at][1]) for at in order[:2])
    names = ", ".join(f"'{axis}'" for axis in axes)
    problem = Problem(
        f"axes {names} have no place: {sums} is less than {measure(long)}",
        f"pairs {', '.join(repr(pairs[at].name) for at in order)} give their distances, and two sides of a triangle "
        "are together longer than the third",
        "change a tooth count or a module, or take one of the pairs away",
        last.place,
    )
    yield BuildFinding("P3", "note" if lack <= room else "error", problem)
