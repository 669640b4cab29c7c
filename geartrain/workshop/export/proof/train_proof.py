"""Proof that a train is ready to cut: either the written parts can turn, or the errors are listed.

Meshing wheels are checked in the plane by their written outlines (`mesh_proof`). Flexible wheels are checked at several
positions of their wave generator. Solids of different links are compared in several poses of the train: if bounding
boxes overlap, the common volume of the solids is computed.
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
from geartrain.kinematics.buildability import BuildFinding, BuildLevel, build_errors
from geartrain.numerics.exact import plural
from geartrain.numerics.results import Key, Result
from geartrain.scene.pose import ScenePose, scene_pose
from geartrain.teeth.outlines.fixed_teeth import bent_line
from geartrain.workshop.export.proof.link_freedom import LinkFreedom, prove_freedom
from geartrain.workshop.export.proof.mesh_proof import MeshProof, paired_wheels, prove_mesh, read_wheels
from geartrain.workshop.export.proof.turned_pair import NOTHING, plane_geometry

if TYPE_CHECKING:
    from geartrain.scene.parts.eccentrics import Eccentric
    from geartrain.scene.solids.solid_assembly import SolidModel
    from geartrain.scene.solids.solid_part import SolidPart
    from geartrain.workshop.export.proof.mesh_proof import CutTrain


SLIVER = 1e-3
"""Maximum common volume of two parts that is ignored [mm3], due to the chords of round surfaces in contact."""

_POSITIONS = 7  # of the wave generator in a pitch of the internal wheel
_PARTS = 4  # subdivision of each chord of the wheel, because bending curves it
_POSES = tuple(Fraction(k * 41, 97) for k in range(8))  # turns of the driving link; 97 is prime, so poses do not repeat
_SHARE = 1e-6  # of the smaller part: a larger common volume is not a sliver


@dataclass(frozen=True, slots=True)
class TrainProof(Result):
    """Result of the check that a train can be made and can turn: measured values and findings."""

    KEYS = (Key("ready", "is_ready"), "verdict", "meshes", "links", "findings")

    meshes: tuple[MeshProof, ...]
    """Measured values of every pair of wheels whose teeth are cut."""
    links: tuple[LinkFreedom, ...]
    """Freedom of every link, except the frame and the inputs, while the inputs are held fixed."""
    findings: tuple[BuildFinding, ...]
    """Findings of the check: errors come first, then notes on parts that are risky or could not be checked."""

    @property
    def is_ready(self) -> bool:
        """True if the findings contain no error."""
        return not build_errors(self.findings)

    @property
    def verdict(self) -> str:
        """Verdict as one sentence: "ready to cut", or the first error and the number of further errors."""
        errors = build_errors(self.findings)
        if not errors:
            return "ready to cut"
        more = f", and {plural(len(errors) - 1, 'more error')}" if len(errors) > 1 else ""
        return f"not ready to cut: {errors[0].problem.what}{more}"


def prove_train(work: SolidModel, watch: Callable[[], None] = lambda: None) -> TrainProof:
    """Check whether the exported parts of a train can turn, first for each mesh and then for the whole train.

    work    solid model of the train
    watch   progress function, called after each of `proof_steps` steps
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
    links, freedom = prove_freedom(work, {pair: each[2] for pair, each in paired.items() if pair not in stuck}, names)
    watch()
    uncut = []
    for name, problems in work.blanks.uncut.items():
        level: BuildLevel = "error" if name in work.blanks.flat else "note"
        uncut += [BuildFinding("W3", level, not_cut(name, problem)) for problem in problems]
    # if the declaration has them as notes too, the error replaces these
    named = {found.problem.what for found in uncut}
    findings = [found for found in work.sized.build_findings if found.problem.what not in named]
    findings += [*uncut, *_frame(work), *cut.findings]
    findings += [found for mesh in meshes for found in mesh.findings]
    findings += [*prove_waves(work, cut), *freedom, *prove_solids(work, watch)]
    ranked = sorted(findings, key=lambda found: not found.is_error)  # stable, with errors first
    return TrainProof(tuple(meshes), links, tuple(ranked))


def proof_is_installed() -> bool:
    """Return True if shapely and manifold3d are installed, False otherwise."""
    return are_installed("shapely", "manifold3d")


def are_installed(*libraries: str) -> bool:
    """Return True if all modules with the given names can be imported, False otherwise."""
    try:
        return all(find_spec(name) is not None for name in libraries)
    except (ImportError, ValueError):
        return False


def proof_steps(work: SolidModel) -> int:
    """Return the number of steps of `prove_train`, which is the number of calls of its progress function."""
    return len(work.blanks.backlashes) + 1 + len(_poses(work))


def _frame(work: SolidModel) -> Iterator[BuildFinding]:
    """Yield findings on axes that the plates cannot support, on obstacles to arbors, and on cups of flexible wheels."""
    if work.frame is None:
        return
    for cup in work.frame.plan.stack.cups:
        for problem in cup.notices():
            yield BuildFinding("W3", "note", problem)
    by_hand = set(work.frame.plan.stack.omitted())
    for problem in dict.fromkeys([*work.frame.plan.notices, *work.frame.problems()]):
        yield BuildFinding("S1", "note" if problem in by_hand else "error", problem)


# -------------------------------------------------------------------------------------------- solids of different links


def prove_solids(work: SolidModel, watch: Callable[[], None] = lambda: None) -> tuple[BuildFinding, ...]:
    """Return findings on parts that overlap in some pose, in descending order of their common volume.

    Raises `MissingExtraError` if manifold3d is not installed.

    watch   progress function, called after each pose
    """
    solids = _Solids(work)
    found: dict[tuple[int, int], float] = {}
    for turns in _poses(work):
        pose = scene_pose(work.scene, turns)
        for one, other in solids.near(pose):
            if (one, other) not in found and (common := solids.common(one, other, pose)):
                found[one, other] = common
        watch()
    ranked = sorted(found.items(), key=lambda each: -each[1])
    return tuple(_finding(work.parts[one], work.parts[other], volume) for (one, other), volume in ranked)


def _poses(work: SolidModel) -> tuple[Fraction, ...]:
    return _POSES if work.scene.driving_link is not None else _POSES[:1]


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
        # the solid of a flexible wheel is circular, but the wheel is bent when assembled
        self.bent = {name for name, (_, wheel) in work.train.declaration.wheels.items() if wheel.flexible}
        self.made: dict[int, Any] = {}

    def near(self, pose: ScenePose) -> Iterator[tuple[int, int]]:
        """Yield the indices of two parts of different bodies whose bounding boxes overlap, if they do not mesh."""
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
        """Return the volume that two parts have in common in a pose [mm3]; 0 if it is negligible."""
        bodies = [(at, self.parts[at].body) for at in (one, other)]
        moves = (np.column_stack([pose.turned[body], pose.moved[body]]) for _, body in bodies)
        solids = [self._made(at).transform(move) for (at, _), move in zip(bodies, moves, strict=True)]
        volume = float((solids[0] ^ solids[1]).volume())
        minimum = max(SLIVER, _SHARE * min(each.volume() for each in solids))
        return volume if volume > minimum else 0.0

    def _made(self, at: int) -> Any:
        """Return the part with index `at` in its position at the start of the motion, as a manifold."""
        if at not in self.made:
            faces = np.ascontiguousarray(self.parts[at].solid.faces, dtype=np.uint64)
            mesh = self.library.Mesh64(np.ascontiguousarray(self.placed[at], dtype=float), faces)
            self.made[at] = self.library.Manifold(mesh)
        return self.made[at]


def _finding(one: SolidPart, other: SolidPart, volume: float) -> BuildFinding:
    what = f"'{one.name}' and '{other.name}' overlap by {volume:.3g} mm3"
    kinds = {one.kind, other.kind}
    if kinds == {"arbor"}:
        why, fix = "two arbors intersect", "make one of them a pipe around the other, or move an axis"
    elif "arbor" in kinds:
        why, fix = "an arbor passes through a part of another link", "shorten the arbor, or cut a hole in the part"
    elif kinds == {"plate", "wheel"}:
        why, fix = "a plate obstructs a wheel", "cut the plate away there, or move an axis"
    else:
        why, fix = "parts of different links must not intersect", "put them in different layers, or move an axis"
    return BuildFinding("S2", "error", Problem(what, why, fix))


# ------------------------------------------------------------------------------------------------ wheels bent by a wave


def prove_waves(work: SolidModel, cut: CutTrain) -> Iterator[BuildFinding]:
    """Yield findings on flexible wheels that overlap their internal wheel when a wave generator bends them."""
    waves = () if work.frame is None else (each for each in work.frame.plan.stack.eccentrics if each.wave is not None)
    for each in waves:
        for gear in work.train.declaration.gears:
            if each.wheels[0] in gear.pair and set(gear.pair) <= set(cut.materials):
                ring = next(name for name in gear.pair if name != each.wheels[0])
                area = max(overlaps(work, each, cut.materials[each.wheels[0]], (ring, cut.materials[ring])))
                if area > NOTHING:
                    what = (
                        f"pair '{gear.name}': '{each.wheels[0]}', bent by its wave generator, overlaps '{ring}' by "
                        f"{area:.3g} mm2"
                    )
                    why = "overlapping teeth cannot turn"
                    yield BuildFinding(
                        "T5", "error", Problem(what, why, "give more backlash, such as --backlash 0.1mm")
                    )


def overlaps(work: SolidModel, wave: Eccentric, thin: Any, ring: tuple[str, Any]) -> Iterator[float]:
    """Yield the overlap of a bent flexible wheel and its internal wheel [mm2] at each position of the wave.

    wave         wave generator
    thin, ring   shape of the flexible wheel as cut; name and shape of the internal wheel
    """
    assert wave.wave is not None
    shapely = plane_geometry()
    name, material = ring
    blank, counts = work.blanks.wheels[wave.wheels[0]], work.blanks.wheels[name].teeth
    pitch, z = 2 * np.pi / counts, blank.teeth
    middle = wave.radius + wave.wave.wall / 2
    corners = np.asarray(thin.exterior.coords)[:-1]
    along = np.arange(_PARTS)[None, :, None] / _PARTS
    line = (corners[:, None, :] + (np.roll(corners, -1, axis=0) - corners)[:, None, :] * along).reshape(-1, 2)
    # over this range the wheel turns back by one of its pitches, after which the positions repeat
    for turn in np.arange(_POSITIONS) * pitch / _POSITIONS * counts / (counts - z):
        own = -turn * (counts - z) / z
        bent = shapely.Polygon(bent_line(line, middle, (wave.wave.rise, wave.wave.lobes), (own, turn)))
        # at the start of the wave, a tooth of the wheel faces a space of the internal wheel
        c, s = np.cos(pitch / 2), np.sin(pitch / 2)
        held = shapely.transform(material, lambda points, c=c, s=s: points @ np.array([[c, s], [-s, c]]))
        yield float(shapely.intersection(bent, held).area)
