"""Whether a train is ready to cut: what is written of it, proved to turn, and what is in the way.

Wheels in mesh are proved flat, on their written outlines (`mesh_proof`), thin wheels bent by a wave at positions of it.
Solids of different links are compared through their turn: where bounding boxes overlap, so may solids, and their
common volume is computed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.cut_teeth import not_cut
from geartrain.errors import MissingExtraError, Problem
from geartrain.kinematics.buildability import BuildFinding, build_errors
from geartrain.numerics.results import Key, Result
from geartrain.scene.pose import ScenePose, scene_pose
from geartrain.teeth.outlines.fixed_teeth import bent_line
from geartrain.workshop.export.proof.link_freedom import LinkFreedom, prove_freedom
from geartrain.workshop.export.proof.mesh_proof import MeshProof, paired_wheels, prove_mesh, read_wheels
from geartrain.workshop.export.proof.turned_pair import NOTHING, plane_geometry

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.parts.eccentrics import Eccentric
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart
    from geartrain.workshop.export.proof.mesh_proof import CutTrain


SLIVER = 1e-3
"""Common volume (mm3) that is none: where two round surfaces of one radius touch, their chords cross."""

_POSITIONS = 7  # of the wave in a pitch of the ring
_PARTS = 4  # of each chord of the wheel, which bending makes round
_POSES = tuple(Fraction(k * 41, 97) for k in range(8))  # turns of the lead
_SHARE = 1e-6  # of the smaller part: a larger one is no sliver


@dataclass(frozen=True, slots=True)
class TrainProof(Result):
    """What the proof of a train found.

    See Also
    --------
    prove_train : gives it.
    """

    KEYS = (Key("ready", "is_ready"), "verdict", "meshes", "links", "findings")

    meshes: tuple[MeshProof, ...]
    """Of every pair whose wheels are cut."""
    links: tuple[LinkFreedom, ...]
    """Of every link that turns."""
    findings: tuple[BuildFinding, ...]
    """What is in the way, errors first, and what is unwise or could not be proved."""

    @property
    def is_ready(self) -> bool:
        """True if nothing is in the way."""
        return not build_errors(self.findings)

    @property
    def verdict(self) -> str:
        """One sentence."""
        errors = build_errors(self.findings)
        if not errors:
            return "ready to cut"
        more = f", and {len(errors) - 1} more in the way" if len(errors) > 1 else ""
        return f"not ready to cut: {errors[0].problem.what}{more}"


def prove_train(work: SolidModel, watch: Callable[[], None] = lambda: None) -> TrainProof:
    """Turn what is written of a train, mesh by mesh and as a whole.

    Parameters
    ----------
    work : SolidModel
        The train and its sizes.
    watch : callable, optional
        Called after each of `proof_steps` steps.

    Returns
    -------
    TrainProof
        All that was measured, and what is in the way.

    Raises
    ------
    MissingExtraError
        Without shapely and manifold3d, the extra `proof`.
    GearTrainError
        If the train cannot be laid out or has no sizes.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import ManufacturingSizes, SolidModel
    >>> proof = prove_train(SolidModel(geartrain.load("planetary-24-18-60"), ManufacturingSizes(module=2.0)))
    >>> proof.verdict, [mesh.pair for mesh in proof.meshes], round(proof.meshes[0].minimum, 2)
    ('ready to cut', ['s~p', 'p~ring'], 0.1)
    """
    if not proof_is_installed():
        raise MissingExtraError("shapely and manifold3d", "proof", "a proof that a train turns")
    cut = read_wheels(work)
    paired = paired_wheels(work, cut)
    meshes = []
    for each in paired.values():
        meshes.append(prove_mesh(*each))
        watch()
    stuck = {mesh.pair for mesh in meshes if build_errors(mesh.findings)}
    names = {pair: (wheels[0].wheel, wheels[1].wheel) for pair, (_, wheels, _) in paired.items()}
    freedom = prove_freedom(work, {pair: each[2] for pair, each in paired.items() if pair not in stuck}, names)
    watch()
    uncut = [*_uncut(work)]
    named = {found.problem.what for found in uncut}  # where they are notes on the declaration too, the error counts
    findings = [found for found in work.sized.build_findings if found.problem.what not in named]
    findings += [*uncut, *_frame(work), *cut.findings]
    findings += [found for mesh in meshes for found in mesh.findings]
    findings += [*prove_waves(work, cut), *freedom.findings, *prove_solids(work, watch)]
    ranked = sorted(findings, key=lambda found: not found.is_error)
    return TrainProof(tuple(meshes), freedom.links, tuple(ranked))


def proof_is_installed() -> bool:
    """Whether the libraries of plane geometry and of solids are there."""
    try:
        return all(find_spec(name) is not None for name in ("shapely", "manifold3d"))
    except (ImportError, ValueError):
        return False


def proof_steps(work: SolidModel) -> int:
    """How often `prove_train` calls its watch."""
    return len(work.blanks.backlashes) + 1 + pose_count(work)


def _uncut(work: SolidModel) -> Iterator[BuildFinding]:
    """Wheels without a drawing: errors where they are flat."""
    blanks = work.blanks
    for name, problems in blanks.uncut.items():
        flat = name in blanks.flat
        for problem in problems:
            yield BuildFinding("W3", "error" if flat else "note", not_cut(name, problem))


def _frame(work: SolidModel) -> Iterator[BuildFinding]:
    """What the plates cannot bear (notes: a bracket is made by hand), and what is in the way of arbors."""
    if work.frame is None:
        return
    for cup in work.frame.plan.stack.cups:
        for problem in cup.told():
            yield BuildFinding("W3", "note", problem)
    by_hand = set(work.frame.plan.stack.left_out())
    for problem in dict.fromkeys([*work.frame.plan.notices, *work.frame.problems()]):
        yield BuildFinding("S1", "note" if problem in by_hand else "error", problem)


# -------------------------------------------------------------------------------------------- solids of different links


def prove_solids(work: SolidModel, watch: Callable[[], None] = lambda: None) -> tuple[BuildFinding, ...]:
    """Couples of parts that stand in each other in some pose, the largest common volumes first.

    watch   called after each pose. Raises `MissingExtraError` without manifold3d.
    """
    solids = _Solids(work)
    found: dict[tuple[int, int], float] = {}
    for turns in _POSES if work.scene.driving_link is not None else _POSES[:1]:
        pose = scene_pose(work.scene, turns)
        for one, other in solids.near(pose):
            if (one, other) not in found and (common := solids.common(one, other, pose)):
                found[one, other] = common
        watch()
    ranked = sorted(found.items(), key=lambda each: -each[1])
    return tuple(_finding(work.parts[one], work.parts[other], volume) for (one, other), volume in ranked)


def pose_count(work: SolidModel) -> int:
    """How often `prove_solids` calls its watch."""
    return len(_POSES) if work.scene.driving_link is not None else 1


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
        minimum = max(SLIVER, _SHARE * min(each.volume() for each in solids))
        return volume if volume > minimum else 0.0

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


# ------------------------------------------------------------------------------------------------ wheels bent by a wave


def prove_waves(work: SolidModel, cut: CutTrain) -> Iterator[BuildFinding]:
    """What is in the way of thin wheels that are bent into their rings."""
    waves = () if work.frame is None else (each for each in work.frame.plan.stack.eccentrics if each.wave is not None)
    for each in waves:
        for gear in work.train.declaration.gears:
            if each.wheels[0] in gear.pair and set(gear.pair) <= set(cut.materials):
                ring = next(name for name in gear.pair if name != each.wheels[0])
                area = max(overlaps(work, each, cut.materials[each.wheels[0]], (ring, cut.materials[ring])))
                if area > NOTHING:
                    what = (
                        f"pair '{gear.name}': bent by its wave '{each.wheels[0]}' overlaps '{ring}' by {area:.3g} mm2"
                    )
                    yield BuildFinding("T5", "error", Problem(what, "it cannot turn", "give more backlash"))


def overlaps(work: SolidModel, wave: Eccentric, thin: Any, ring: tuple[str, Any]) -> Iterator[float]:
    """Common areas (mm2) of a bent wheel and its ring, the wave in several places of a pitch."""
    assert wave.wave is not None
    shapely = plane_geometry()
    name, material = ring
    blank, counts = work.blanks.wheels[wave.wheels[0]], work.blanks.wheels[name].teeth
    pitch, z = 2 * np.pi / counts, blank.teeth
    middle = wave.radius + wave.wave.wall / 2
    line = _divided(np.asarray(thin.exterior.coords)[:-1])
    for turn in np.arange(_POSITIONS) * pitch / _POSITIONS * counts / (counts - z):
        own = -turn * (counts - z) / z
        bent = shapely.Polygon(bent_line(line, middle, (wave.wave.rise, wave.wave.lobes), (own, turn)))
        # a tooth of the wheel stands before a space of its ring where the wave begins
        c, s = np.cos(pitch / 2), np.sin(pitch / 2)
        held = shapely.transform(material, lambda points, c=c, s=s: points @ np.array([[c, s], [-s, c]]))
        yield float(shapely.intersection(bent, held).area)


def _divided(line: Floats) -> Floats:
    """With points between its corners."""
    steps = np.arange(_PARTS)[None, :, None] / _PARTS
    after = np.roll(line, -1, axis=0)
    found: Floats = (line[:, None, :] + (after - line)[:, None, :] * steps).reshape(-1, 2)
    return found
