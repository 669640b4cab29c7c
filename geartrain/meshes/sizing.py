"""How large real teeth are, and how far apart their axes want to stand, where only their shape is declared.

Triangular teeth have sizes up to a scale, and a wheel with several mates has one size: from the first pair of wheels
that hang together the others follow, each at the distance its own law asks for.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from geartrain.meshes.conjugate import ConjugateMesh
from geartrain.meshes.triangular import TriangularMesh
from geartrain.teeth import Triangular

if TYPE_CHECKING:
    from geartrain.meshes.mesh import Mesh
    from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class PairSize:
    """Of a pair with real teeth.

    scale      modules in one unit of its law's lengths
    distance   of its axes, in modules
    stretch    that distance over the one at which pitch circles touch
    """

    scale: float
    distance: float
    stretch: float


def find_sizes(train: Train, meshes: Iterable[Mesh]) -> dict[str, PairSize]:
    """The sizes of all pairs with real teeth and parallel axes, by name."""
    tips: dict[str, float] = {}
    found = {}
    for mesh in _in_order(meshes):
        if isinstance(mesh, TriangularMesh):
            found[mesh.name] = _triangular(train, mesh, tips)
        elif isinstance(mesh, ConjugateMesh) and not mesh.law.path.pitch.bevel:
            pitch = mesh.law.path.pitch
            distance = float(getattr(mesh.law, "distance", abs(pitch.R1 + pitch.R2)))
            found[mesh.name] = PairSize(1.0, distance, distance / _touching(train, mesh))
    return found


def _in_order(meshes: Iterable[Mesh]) -> Iterator[Mesh]:
    """Pairs one after another such that, where they hang together, each shares a wheel with one before it."""
    at: dict[str, list[Mesh]] = {}
    for mesh in (meshes := tuple(meshes)):
        for wheel in mesh.gear.pair:
            at.setdefault(wheel, []).append(mesh)
    done: set[str] = set()
    for first in meshes:
        waiting = deque([first])
        while waiting:
            mesh = waiting.popleft()
            if mesh.name not in done:
                done.add(mesh.name)
                waiting.extend(each for wheel in mesh.gear.pair for each in at[wheel])
                yield mesh


def _touching(train: Train, mesh: Mesh) -> float:
    """The distance (modules) at which pitch circles touch."""
    (z1, ring1), (z2, ring2) = (
        (wheel.count or 0, wheel.internal) for _, wheel in (train.wheels[name] for name in mesh.gear.pair)
    )
    return abs(z1 - z2) / 2 if ring1 or ring2 else (z1 + z2) / 2


def _triangular(train: Train, mesh: TriangularMesh, tips: dict[str, float]) -> PairSize:
    """As large as its wheel that has a size already; else as lengths declare it, or so that pitch circles touch."""
    sizes, touching = mesh.law.sizes, _touching(train, mesh)
    own = {mesh.driver: sizes.R1, mesh.driven: sizes.R2}
    form = mesh.gear.tooth_form or train.tooth_form
    module = _module(train, mesh)
    scale = touching / sizes.D
    if module is not None and _has_lengths(form):
        scale = 1 / module
    scale = next((tips[wheel] / R for wheel, R in own.items() if wheel in tips), scale)
    for wheel, R in own.items():
        tips.setdefault(wheel, R * scale)
    return PairSize(scale, sizes.D * scale, sizes.D * scale / touching)


def _has_lengths(form: object) -> bool:
    """True for teeth declared in units of length."""
    if not isinstance(form, Triangular):
        return False
    radii = () if isinstance(form.radii, str) else form.radii
    return any(length is not None and length.unit for length in (form.centre_distance, form.backlash, *radii))


def _module(train: Train, mesh: Mesh) -> float | None:
    """Mean module (m) of the wheels of a pair; None unless both declare one with a unit."""
    wheels = [train.wheels[name][1] for name in mesh.gear.pair]
    sizes = [wheel.module.si * (wheel.count or 0) for wheel in wheels if wheel.module and wheel.module.unit]
    return sum(sizes) / sum(wheel.count or 0 for wheel in wheels) if len(sizes) == 2 else None
