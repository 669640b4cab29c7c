"""Stress at the root of a tooth by plane finite elements on its outline: a check of Lewis's formula (extra `fem`)."""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import MissingExtraError
from geartrain.teeth.strength.triangle_mesh import triangles

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.strength.root_section import ToothLoad, ToothSide

_DEEP = 2.5  # modules under the root circle, where the rim is held
_ROOT = 0.35  # of the height of a tooth: where its root ends
_COARSE = 0.1  # modules: longest edge
_GRADE = 0.05  # by how much an edge grows with the distance from where it is fine
FINE = 0.03
"""Edges at the root [module]; coarser ones change stresses by less than 1 in 200."""


def root_stress_factor(side: ToothSide, z: float, load: ToothLoad, poisson: float, fine: float = FINE) -> float:
    """Greatest tension along the round of the loaded side, over torque/(width module^2): docs/strength.md, section 6.

    Three teeth on a rim held inside and at its ends, plane stress, quadratic triangles; Young's modulus cancels.
    Raises `MissingExtraError` without scikit-fem.
    """
    polygon, root = _sector(side, z)
    spot = load.radius * np.array([cos(half := side.half(load.radius)), sin(half)])
    # the force presses the loaded side, y > 0, down and towards the root
    way = np.array([-side.outward * sin(load.angle), -cos(load.angle)])
    force = way / (load.apex * cos(load.angle))  # of a torque of 1
    held = _Held(side, z)
    return plane_stress(polygon, spot, force, root, held, poisson, fine)


class _Held:
    """Where the rim is held: its inner circle, and both of its cuts."""

    def __init__(self, side: ToothSide, z: float) -> None:
        self.radius = side.root - side.outward * _DEEP
        self.angle = 3 * pi / z

    def __call__(self, points: Floats) -> Floats:
        """Which points (2, n) are held."""
        radius, angle = np.hypot(*points), np.arctan2(points[1], points[0])
        found = np.abs(radius - self.radius) < 1e-2
        found |= np.abs(np.abs(angle) - self.angle) * radius < 1e-6
        return np.asarray(found)


def _sector(side: ToothSide, z: float) -> tuple[Floats, Floats]:
    """Three teeth on their rim, anticlockwise, and the round at the loaded side of the middle one."""
    half = side.points[side.points[:, 1] > 1e-9]
    r, angle = np.hypot(*half.T), np.arctan2(half[:, 1], half[:, 0])
    pitch = pi / z
    r, angle = np.append(r, side.root), np.append(np.minimum(angle, pitch), pitch)
    tooth = np.concatenate((np.stack([r, -angle])[:, ::-1], np.stack([r, angle])), axis=1)
    whole = np.concatenate([tooth + np.array([[0.0], [k * 2 * pitch]]) for k in (-1, 0, 1)], axis=1)
    inner = side.root - side.outward * _DEEP
    back = np.linspace(3 * pitch, -3 * pitch, 61)
    radius, azimuth = np.append(whole[0], np.full(61, inner)), np.append(whole[1], back)
    points = np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth)], axis=1)
    apart = np.hypot(*(points - np.roll(points, 1, axis=0)).T) > 1e-6
    deep = np.abs(r - side.root) < _ROOT * abs(side.tip - side.root)
    round_ = np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)[deep]
    return points[apart], round_


def plane_stress(
    polygon: Floats, spot: Floats, force: Floats, stretch: Floats, held: Any, poisson: float, fine: float
) -> float:
    """Greatest tension along the border near `stretch` (n, 2) of a plate of unit thickness under a force at a spot.

    polygon   (k, 2); `held` says which points (2, n) do not move
    """
    try:
        import skfem
        from skfem.models.elasticity import lame_parameters, linear_elasticity
    except ImportError as error:
        raise MissingExtraError("scikit-fem", "fem", "a check by finite elements") from error
    from scipy.spatial import cKDTree

    near = cKDTree(stretch)

    def spacing(points: Floats) -> Floats:
        far = np.minimum(near.query(points)[0], 2 * np.hypot(*(points - spot).T))
        return np.asarray(np.minimum(fine + _GRADE * far, _COARSE))

    points, cells = triangles(polygon, spacing, spot[None, :])
    mesh = skfem.MeshTri(points.T, cells.T)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementTriP2()))
    lam, mu = lame_parameters(1.0, poisson)
    plane = 2 * lam * mu / (lam + 2 * mu)  # of plane stress
    stiffness = linear_elasticity(plane, mu).assemble(basis)
    load = np.zeros(basis.N)
    corner = int(np.argmin(np.hypot(*(mesh.p.T - spot).T)))
    load[basis.nodal_dofs[:, corner]] = force
    fixed = basis.get_dofs(lambda x: held(x))
    moved = skfem.solve(*skfem.condense(stiffness, load, D=fixed))
    return _tension(skfem, mesh, basis, moved, (plane, mu), near, 2 * fine)


def _tension(
    skfem: Any, mesh: Any, basis: Any, moved: Floats, lame: tuple[float, float], near: Any, reach: float
) -> float:
    """Greatest stress along the border near some points."""
    facets = mesh.boundary_facets()
    middle = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    facets = facets[near.query(middle.T)[0] < reach]
    border = skfem.FacetBasis(mesh, basis.elem, facets=facets)
    grad = border.interpolate(moved).grad
    strain = (grad + np.swapaxes(grad, 0, 1)) / 2
    plane, mu = lame
    trace = strain[0, 0] + strain[1, 1]
    stress = 2 * mu * strain
    stress[0, 0] += plane * trace
    stress[1, 1] += plane * trace
    tangent = np.stack([-border.normals[1], border.normals[0]])
    along = np.einsum("iqk,ijqk,jqk->qk", tangent, stress, tangent) if stress.ndim == 4 else None
    assert along is not None
    return float(along.max())
