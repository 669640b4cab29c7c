"""The triangular teeth of a train as designs: which pairs can be sized, what is declared of them, and back."""

from __future__ import annotations

from collections.abc import Iterable

from geartrain.synthesis.tooth_sizes.size_design import ToothSizes
from geartrain.synthesis.tooth_sizes.train_sizes import DIGITS, form_data
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.triangular.triangular_form import Triangular
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh


def sizeable_meshes(meshes: Iterable[GearMesh]) -> dict[str, TriangularMesh]:
    """The pairs with triangular teeth whose sizes are not declared as lengths, by name."""
    found = (mesh for mesh in meshes if isinstance(mesh, TriangularMesh))
    return {mesh.name: mesh for mesh in found if not mesh.tooth_form.has_lengths}


def as_form(sizes: ToothSizes) -> Triangular:
    """A design as the form of a pair."""
    return Triangular.declared(form_data(sizes))


def rounded(sizes: ToothSizes) -> ToothSizes:
    """With the digits that a declaration has."""
    return sizes.at({"radii": round(sizes.radii, DIGITS), "window": round(sizes.window, DIGITS)})


def declared_sizes(mesh: TriangularMesh) -> ToothSizes:
    """The sizes of a pair as declared: the first wheel of the pair first; in mid window where it does not turn."""
    sizes, window = mesh.law.sizes, mesh.window
    driver = 1 + mesh.gear.pair.index(mesh.driver)
    if driver == 2:
        sizes = sizes.swapped()
    place = 0.5
    if window and mesh.verdict.kind == "runs":
        place = min(max((sizes.excess - window.jam) / (window.run - window.jam), 0.0), 1.0)
    radii = sizes.R2 / sizes.R1 * sizes.z1 / sizes.z2
    # friction by a law of speed is searched under with its mean coefficient at the speed of the pair
    friction = mesh.losses.friction if mesh.verdict else mesh.law.friction
    return ToothSizes((sizes.z1, sizes.z2), radii, place, sizes.half_angles, friction, driver, sizes.ring)
