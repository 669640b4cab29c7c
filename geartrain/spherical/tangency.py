"""How angles between axes, and azimuths about them, change as axes move: sparse rows for Newton's method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.sparse import csr_array

    Floats = NDArray[np.float64]
    Ints = NDArray[np.int64]


def frames(axes: Floats) -> Floats:
    """Two directions across each axis that make a right-handed frame with it, (gears, 2, 3)."""
    least = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    first = np.cross(axes, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(axes, first)], axis=1)


def moved(axes: Floats, steps: Floats) -> Floats:
    """Axes after steps along the great circles of their `frames`; steps in rad, (gears, 2)."""
    along = np.einsum("gk,gkx->gx", steps, frames(axes))
    length = np.linalg.norm(along, axis=1)[:, None]
    turned = np.cos(length) * axes + np.sinc(length / np.pi) * along
    return np.asarray(turned / np.linalg.norm(turned, axis=1)[:, None], dtype=float)


def angle_rows(axes: Floats, pairs: Sequence[tuple[int, int]]) -> tuple[Floats, csr_array]:
    """Angle S between the axes of each pair (rad), and its derivative by the steps of `moved`.

    dS = -tau_ij . dn_i - tau_ji . dn_j, tau_ij the unit tangent at i towards j. Columns: 2 i and 2 i + 1 of axis i.
    """
    i, j = np.array(pairs, dtype=int).reshape(-1, 2).T
    a, b = axes[i], axes[j]
    S = 2 * np.arctan2(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))
    towards = [(q - p * np.cos(S)[:, None]) / np.sin(S)[:, None] for p, q in ((a, b), (b, a))]
    return S, vector_rows(axes, (i, j), (-towards[0], -towards[1]))


def azimuth_rows(axes: Floats, at: Ints, to: Ints) -> csr_array:
    """Derivative of the azimuth psi of axis `to` about axis `at`, by the steps of `moved`.

    d psi = (dn_j / sin S - dn_i cot S) . t, t = n_i x n_j / sin S; the frame at i is carried along in parallel, so
    that only differences of azimuths about one axis have a meaning.
    """
    a, b = axes[at], axes[to]
    t = np.cross(a, b)
    sine = np.linalg.norm(t, axis=1)[:, None]
    cosine = np.einsum("px,px->p", a, b)[:, None]
    t = t / sine
    return vector_rows(axes, (at, to), (-t * cosine / sine, t / sine))


def vector_rows(axes: Floats, gears: tuple[Ints, Ints], vectors: tuple[Floats, Floats]) -> csr_array:
    """Rows of a sparse Jacobian: the sum over two gears of vector . dn, in the steps of `moved`."""
    from scipy.sparse import coo_array

    across = frames(axes)
    count = len(gears[0])
    rows, columns, values = [], [], []
    for gear, vector in zip(gears, vectors, strict=True):
        for k in (0, 1):
            rows.append(np.arange(count))
            columns.append(2 * gear + k)
            values.append(np.einsum("px,px->p", vector, across[gear, k]))
    at = (np.concatenate(rows), np.concatenate(columns))
    return coo_array((np.concatenate(values), at), shape=(count, 2 * len(axes))).tocsr()
