"""The solids of different links through their turn: no two of them in one place, wheels that mesh apart.

Wheels in mesh are proved flat, on finer outlines. Of all others the boxes are held against each other first, in each of
several poses; where boxes overlap, so may solids, and their common volume is found.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import MissingExtraError, Problem
from geartrain.kinematics.buildability import BuildFinding
from geartrain.scene.pose import ScenePose, scene_pose

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart

_POSES = tuple(Fraction(k * 41, 97) for k in range(8))  # turns of the lead
SLIVER = 1e-3
"""Common volume (mm3) that is none: where two round surfaces of one radius touch, their chords cross."""
_SHARE = 1e-6  # of the smaller part: a larger one is no sliver


def prove_solids(work: SolidModel, watch: Callable[[], None] = lambda: None) -> tuple[BuildFinding, ...]:
    """Couples of parts that stand in each other in some pose, the largest common volumes first.

    watch   called after each pose. Raises `MissingExtraError` without manifold3d.
    """
    solids = _Solids(work)
    found: dict[tuple[int, int], float] = {}
    for turns in _POSES if work.scene.lead is not None else _POSES[:1]:
        pose = scene_pose(work.scene, turns)
        for one, other in solids.near(pose):
            if (one, other) not in found and (common := solids.common(one, other, pose)):
                found[one, other] = common
        watch()
    ranked = sorted(found.items(), key=lambda each: -each[1])
    return tuple(_finding(work.parts[one], work.parts[other], volume) for (one, other), volume in ranked)


def pose_count(work: SolidModel) -> int:
    """How often `prove_solids` calls its watch."""
    return len(_POSES) if work.scene.lead is not None else 1


class _Solids:
    def __init__(self, work: SolidModel) -> None:
        try:
            import manifold3d
        except ImportError:
            raise MissingExtraError("manifold3d", "proof", "a proof that solids pass each other") from None
        self.library = manifold3d
        self.parts = work.parts
        self.placed = [part.solid.vertices @ part.turn.T + part.place for part in self.parts]
        self.meshed = {frozenset(work.scene.wheels[at].id for at in pair.wheels) for pair in work.scene.pairs}
        # a thin wheel is drawn round, and stands bent
        self.bent = {name for name, (_, wheel) in work.train.declaration.wheels.items() if wheel.flexible}
        self.made: dict[int, Any] = {}

    def near(self, pose: ScenePose) -> Iterator[tuple[int, int]]:
        """Parts of different bodies, not wheels in mesh, whose boxes overlap."""
        points = [pose.point(part.body, place) for part, place in zip(self.parts, self.placed, strict=True)]
        low = np.array([each.min(axis=0) for each in points])
        high = np.array([each.max(axis=0) for each in points])
        for one, other in combinations(range(len(self.parts)), 2):
            first, second = self.parts[one], self.parts[other]
            pair = {first.name, second.name}
            if first.body == second.body or frozenset(pair) in self.meshed or pair & self.bent:
                continue
            if (low[one] < high[other]).all() and (low[other] < high[one]).all():
                yield one, other

    def common(self, one: int, other: int, pose: ScenePose) -> float:
        """The volume (mm3) that two parts share in a pose; 0 for a sliver."""
        solids = [self._made(at).transform(_matrix(pose, self.parts[at].body)) for at in (one, other)]
        volume = float((solids[0] ^ solids[1]).volume())
        least = max(SLIVER, _SHARE * min(each.volume() for each in solids))
        return volume if volume > least else 0.0

    def _made(self, at: int) -> Any:
        """A part in the zero pose."""
        if at not in self.made:
            faces = np.ascontiguousarray(self.parts[at].solid.faces, dtype=np.uint64)
            mesh = self.library.Mesh64(np.ascontiguousarray(self.placed[at], dtype=float), faces)
            self.made[at] = self.library.Manifold(mesh)
        return self.made[at]


def _matrix(pose: ScenePose, body: int) -> Floats:
    return np.column_stack([pose.turned[body], pose.moved[body]])


def _finding(one: SolidPart, other: SolidPart, volume: float) -> BuildFinding:
    what = f"'{one.name}' and '{other.name}' overlap by {volume:.3g} mm3"
    kinds = {one.kind, other.kind}
    if kinds == {"arbor"}:
        why, fix = "two arbors are in one place", "make one of them a pipe about the other, or move an axis"
    elif "arbor" in kinds:
        why, fix = "an arbor goes through a part of another link", "end the arbor before it, or give the part more room"
    elif kinds == {"plate", "wheel"}:
        why, fix = "a plate is in the way of a wheel", "cut the plate away there, or move an axis"
    else:
        why, fix = "two parts of different links are in one place", "put them in different layers, or move an axis"
    return BuildFinding("S2", "error", Problem(what, why, fix))
