"""Whether a train is ready to cut: what is written of it, proved to turn, and what is in the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING

from geartrain.dynamics.cut_teeth import not_cut
from geartrain.errors import MissingExtraError
from geartrain.kinematics.buildability import BuildFinding, build_errors
from geartrain.numerics.results import Key, Result
from geartrain.workshop.export.proof.link_freedom import LinkFreedom, prove_freedom
from geartrain.workshop.export.proof.mesh_proof import MeshProof, paired_wheels, prove_mesh, read_wheels
from geartrain.workshop.export.proof.solid_proof import pose_count, prove_solids
from geartrain.workshop.export.proof.wave_proof import prove_waves

if TYPE_CHECKING:
    from geartrain.scene.solids.solid_assembly import SolidModel


@dataclass(frozen=True, slots=True)
class TrainProof(Result):
    """What the proof of a train found.

    Attributes
    ----------
    meshes : tuple of MeshProof
        Of every pair whose wheels are cut.
    links : tuple of LinkFreedom
        Of every link that turns.
    findings : tuple of BuildFinding
        What is in the way, errors first, and what is unwise or could not be proved.

    See Also
    --------
    prove_train : gives it.
    """

    KEYS = (Key("ready", "is_ready"), "verdict", "meshes", "links", "findings")

    meshes: tuple[MeshProof, ...]
    links: tuple[LinkFreedom, ...]
    findings: tuple[BuildFinding, ...]

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
    >>> proof.verdict, [mesh.pair for mesh in proof.meshes], round(proof.meshes[0].least, 2)
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
    return len(work.blanks.plays) + 1 + pose_count(work)


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
