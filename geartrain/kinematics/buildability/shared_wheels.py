"""Wheels with two coaxial mates whose teeth are declared by shape: one centre distance must serve both pairs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.pitch_pairs import PairOutline, PitchPair

_SAME = 1e-6  # of a distance: declared lengths and radii have some six digits


def check_shared_wheels(
    pairs: Sequence[PitchPair], outlines: Callable[[], Mapping[str, PairOutline]]
) -> Iterator[BuildFinding]:
    """Rule P2 for teeth that run at any distance, as triangular ones: the shared wheel fixes the size of both pairs."""
    free = [
        pair for pair in pairs if pair.parallel and pair.form and pair.form.any_distance and not pair.form.conjugate
    ]
    for one, other in combinations(free, 2):
        if one.axis_pair != other.axis_pair or not set(one.wheels) & set(other.wheels):
            continue
        found = outlines()
        if one.name not in found or other.name not in found:
            continue
        first, second = found[one.name].distance, found[other.name].distance
        if abs(first - second) > _SAME * max(first, second):
            (wheel,) = set(one.wheels) & set(other.wheels)
            yield BuildFinding(
                "P2",
                "error",
                Problem(
                    f"pairs '{one.name}' and '{other.name}' need two distances of their axes: {first:.6g} and "
                    f"{second:.6g} modules",
                    f"the teeth of '{wheel}' have one size in both, and two axes have one distance",
                    "give both pairs the same `centre_distance`, and `radii: [first, second]` as lengths, with one "
                    f"radius of '{wheel}'",
                    other.place,
                ),
            )
