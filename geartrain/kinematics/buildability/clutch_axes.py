"""Whether brakes and clutches join links that turn on one axis."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.circuits import rigid_across_axes, rigid_place

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Tree
    from geartrain.kinematics.circuits.rigid_bodies import Rigid
    from geartrain.train import StateCase, Train


def check_clutches(train: Train, tree: Tree) -> Iterator[BuildFinding]:
    """Rules G1 (locks) and G2 (brakes), each once for all states."""
    said = set()
    for case in train.cases:
        for rigid in rigid_across_axes(train, tree, case):
            if rigid.links not in said:
                said.add(rigid.links)
                lock = len(rigid.links) == 2
                yield BuildFinding("G1" if lock else "G2", "error", _across(train, case, rigid, lock))


def _across(train: Train, case: StateCase, rigid: Rigid, lock: bool) -> Problem:
    axes = " and ".join(f"'{label}'" for label in rigid.labels)
    joints = ", ".join(f"{start} - {end}" for start, end, _ in rigid.joints)
    between = [inner for _, inner, _ in rigid.joints[:-1] if inner != train.frame]
    if lock:
        why = f"no clutch joins links of two axes: as one body they would close the joints {joints}"
        fix = "lock links that have their axis in common, or join the two by a pair of equal wheels"
    else:
        why = f"a brake on the frame holds what turns about an axis of the frame: it would close the joints {joints}"
        fix = f"hold {' or '.join(repr(link) for link in between)} too, or in its place" if between else "hold another"
    what = f"{case.says(*rigid.links)} across the axes {axes}"
    return Problem(what, why, fix, train.place(*rigid_place(train, case, rigid.links)))
