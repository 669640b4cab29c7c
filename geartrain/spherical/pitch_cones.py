"""Pitch and base cones of pairs of gears on a sphere, and derivatives of the angles between their axes.

Equations of cones, pressure angles and limits of shape are in docs/sphere.md, sections 1 and 4. Derivatives are rows of
sparse matrices for Newton's method. All angles are in radians, and all lengths in radii of the sphere on which the
teeth are measured. Axes point outwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, radians, sin, tan
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from scipy.sparse import csr_array

    from geartrain.numerics.arrays import Floats, Ints


MEAN_PRESSURE = radians(20)


def pitch_cone(S: ArrayLike, z_i: ArrayLike, z_j: ArrayLike) -> Floats:
    """Return the half-angle of gear i's pitch cone [rad]: rho_i = atan2(sin S, cos S + z_j/z_i), docs/sphere.md
    (1).

    S is the angle between the outward axes of the meshing gears i and j [rad], 0 < S < pi, and z are the tooth numbers.
    With the speeds w, the formula follows from w_i sin rho_i = -w_j sin rho_j, w_i/w_j = -z_j/z_i and
    rho_i + rho_j = S (Willis, with the frame as carrier). A gear with a half-angle of pi/2 is a crown gear, and with a
    larger one an internal gear.
    """
    return np.asarray(np.arctan2(np.sin(S), np.cos(S) + np.divide(z_j, z_i)), dtype=float)


def operating_pitch(S: ArrayLike, z_i: ArrayLike, z_j: ArrayLike) -> Floats:
    """Return the operating pitch lambda = sin rho_i / z_i of two meshing gears [radii of the sphere],
    docs/sphere.md (1).

    It is equal for both gears: lambda = sin S / sqrt(z_i^2 + z_j^2 + 2 z_i z_j cos S), with tooth numbers z,
    half-angles rho of the pitch cones and angle S between the axes. The module is 2 lambda, and the circular pitch is
    2 pi lambda. The parameters are the same as for `pitch_cone`.
    """
    z_i, z_j = np.asarray(z_i, dtype=float), np.asarray(z_j, dtype=float)
    return np.asarray(np.sin(S) / np.sqrt(z_i**2 + z_j**2 + 2 * z_i * z_j * np.cos(S)), dtype=float)


def base_pitch(pitches: ArrayLike, mean: float = MEAN_PRESSURE) -> float:
    """Return the common base pitch c of all gears: cos(mean) times the geometric mean of the pitches,
    docs/sphere.md (3).

    The half-angle g of the base cone of a gear with z teeth satisfies sin g = c z. `mean` is the mean pressure angle
    [rad]: for two pitches, cos(mean) is the geometric mean of the cosines of their pressure angles.
    """
    return cos(mean) * float(np.exp(np.mean(np.log(pitches))))


def pressure_angle(c: float, pitch: ArrayLike) -> Floats:
    """Return the operating pressure angle of spherical involutes [rad], which is the arc cosine of the base pitch c
    divided by the operating pitch, equation (3) of docs/sphere.md.

    The result is NaN if the operating pitch is less than the base pitch, because the base cones then overlap and
    involutes cannot be in mesh.
    """
    share = c / np.asarray(pitch, dtype=float)
    # numpy evaluates both branches of `where`: without the minimum, arccos would warn
    return np.asarray(np.where(share <= 1, np.arccos(np.minimum(share, 1)), np.nan), dtype=float)


def virtual_teeth(z: ArrayLike, rho: ArrayLike) -> Floats:
    """Return the virtual tooth number of the spur gear on the back cone (Tredgold), which determines undercut.

    It is z / cos rho for a gear with z teeth and the half-angle rho of the pitch cone, and inf for crown and internal
    gears.
    """
    share = np.cos(rho)
    # the cosine of pi/2 in floats is 6e-17
    flat = share < 1e-15
    return np.asarray(np.where(flat, np.inf, np.divide(z, np.where(flat, 1, share))), dtype=float)


def undercut_limit(pressure: float = MEAN_PRESSURE) -> float:
    """Return the minimum tooth number of a gear that a rack with an addendum of one module does not undercut, 2 / sin^2
    of the pressure angle; it need not be an integer.
    """
    return 2 / sin(pressure) ** 2


def overlap_limit(S: float, between: float) -> float:
    """Return the minimum ratio z_other/z_own of tooth numbers at which two equal gears next to each other, which mesh
    with the same gear, do not overlap, docs/sphere.md (4).

    The ratio is sin S cot(between/2) - cos S, from rho_own = between/2 in `pitch_cone`, where S is the angle between
    the axes of a mesh and `between` the angle between the axes of the equal gears [rad]. The result is 0 if they do not
    overlap at any ratio.
    """
    limit = sin(S) / tan(between / 2) - cos(S)
    # axes that touch only with a crown gear have the bound 0, and rounding must not make it 1e-16
    return limit if limit > 1e-12 else 0.0


def angle_between(a: Floats, b: Floats) -> Floats:
    """Return the angle between unit vectors of shape (..., 3) [rad], 2 atan2(|a - b|, |a + b|), which is accurate near
    0 and pi (W. Kahan).
    """
    return np.asarray(2 * np.arctan2(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)), dtype=float)


def separations(axes: Floats) -> Floats:
    """Return the angles between all axes [rad], shape (gears, gears)."""
    return angle_between(axes[:, None], axes[None])


def mesh_angles(axes: Floats, meshes: Sequence[tuple[int, int]]) -> Floats:
    """Return the angle between the axes of each mesh [rad]."""
    i, j = np.array(meshes, dtype=int).reshape(-1, 2).T
    return angle_between(axes[i], axes[j])


def frames(axes: Floats) -> Floats:
    """Return two unit vectors for each axis that form a right-handed frame with it, shape (gears, 2, 3)."""
    # the cross product is taken with the coordinate axis farthest from it, so its length is at least 0.8
    minimum = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    first = np.cross(axes, minimum)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(axes, first)], axis=1)


def azimuths(axes: Floats, at: Ints, to: Ints) -> Floats:
    """Return the direction of axis `to` about axis `at` [rad], counterclockwise from the first of its `frames`."""
    across = frames(axes)[at]
    first, second = (np.einsum("px,px->p", across[:, k], axes[to]) for k in (0, 1))
    return np.asarray(np.arctan2(second, first), dtype=float)


def moved(axes: Floats, steps: Floats) -> Floats:
    """Return the axes displaced by `steps` [rad], shape (gears, 2), in the directions of their `frames`."""
    along = np.einsum("gk,gkx->gx", steps, frames(axes))
    length = np.linalg.norm(along, axis=1)[:, None]
    # sin(length) / length, also at 0
    turned = np.cos(length) * axes + np.sinc(length / np.pi) * along
    return np.asarray(turned / np.linalg.norm(turned, axis=1)[:, None], dtype=float)


def angle_rows(axes: Floats, pairs: Sequence[tuple[int, int]]) -> tuple[Floats, csr_array]:
    """Return the angle S between the axes of each pair [rad], and its derivative with respect to the displacements in
    `moved`.

    The derivative is dS = -tau_ij . dn_i - tau_ji . dn_j, where dn_i is the displacement of axis i and tau_ij the unit
    tangent at i towards j. Columns 2 i and 2 i + 1 are the derivatives with respect to the position of axis i.
    """
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    a, b = axes[i], axes[j]
    S = angle_between(a, b)
    towards = [(q - p * np.cos(S)[:, None]) / np.sin(S)[:, None] for p, q in ((a, b), (b, a))]
    return S, vector_rows(axes, (i, j), (-towards[0], -towards[1]))


def azimuth_rows(axes: Floats, at: Ints, to: Ints) -> csr_array:
    """Return the derivative of the azimuth psi of axis `to` about axis `at` for the displacements in `moved`.

    The derivative is d psi = (dn_j / sin S - dn_i cot S) . t with t = n_i x n_j / sin S. Here n_i and n_j are the axes
    `at` and `to`, dn their displacements, and S is the angle between them. The frame at i is moved by parallel
    transport, so only differences of azimuths about the same axis are meaningful.
    """
    a, b = axes[at], axes[to]
    t = np.cross(a, b)
    sine = np.linalg.norm(t, axis=1)[:, None]
    cosine = np.einsum("px,px->p", a, b)[:, None]
    t = t / sine
    return vector_rows(axes, (at, to), (-t * cosine / sine, t / sine))


def vector_rows(axes: Floats, gears: tuple[Ints, Ints], vectors: tuple[Floats, Floats]) -> csr_array:
    """Return rows of a sparse Jacobian with respect to the displacements in `moved`, each of which is the sum over two
    gears of vector . dn, where dn is the displacement of the gear's axis.
    """
    from scipy.sparse import coo_array

    across, count = frames(axes), len(gears[0])
    columns, values = [], []
    for gear, vector in zip(gears, vectors, strict=True):
        for k in (0, 1):
            columns.append(2 * gear + k)
            values.append(np.einsum("px,px->p", vector, across[gear, k]))
    at = (np.tile(np.arange(count), 4), np.concatenate(columns))
    return coo_array((np.concatenate(values), at), shape=(count, 2 * len(axes))).tocsr()
