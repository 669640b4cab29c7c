"""Circles in the plane for every gear and region of a planar map: radii by Newton's method, then their places.

Koebe, Andreev and Thurston; radii by A. Bobenko and B. Springborn, Trans. AMS 356 (2004) 659.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from math import inf, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, RangeError

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


_MOST_STEPS = 100  # six or seven on usual graphs
_LONGEST = 2.0
"""Largest change of a log radius in one step."""


def angle_excess(u: Floats, i: Ints, j: Ints, target: Floats) -> Floats:
    """Sum over neighbours of 2 atan(r_j/r_i), less what it must be, at every node (rad); u = log r.

    i, j are the ends of every orthogonal pair, in both orders; target is 2 pi less pi for each neighbour of
    infinite radius. The gradient of a convex function of u (Bobenko and Springborn, Euclidean radii).
    """
    return np.asarray(np.bincount(i, 2 * np.arctan(np.exp(u[j] - u[i])), len(u)) - target, dtype=float)


def stiffness(u: Floats, i: Ints, j: Ints) -> Floats:
    """Derivative of 2 atan(r_j/r_i) by u_j, of each pair: 1 / cosh(u_j - u_i)."""
    return np.asarray(1 / np.cosh(u[j] - u[i]), dtype=float)


def circle_vector(centre: complex, radius: float) -> Floats:
    """A circle of the plane as (n, cos rho) / sin rho on the sphere, through the pole of stereographic projection.

    Vectors of Minkowski space: <w, w> = 1, <w_i, w_j> = -1 for tangent circles, 0 for orthogonal ones. With
    k = |c|^2 - r^2 it is (c, (k - 1)/2, (k + 1)/2) / r.
    """
    k = abs(centre) ** 2 - radius**2
    return np.array([centre.real, centre.imag, (k - 1) / 2, (k + 1) / 2]) / radius


def line_vector(normal: complex, offset: float) -> Floats:
    """The half-plane normal.x >= offset as a vector like that of a circle: (m, d, d)."""
    return np.array([normal.real, normal.imag, offset, offset])


def _stalls(residuals: Sequence[float]) -> bool:
    return len(residuals) > 1 and residuals[-1] > residuals[-2] / 4


def _no_packing(residual: float) -> RangeError:
    return RangeError(
        Problem(
            f"no circle packing found: angles still miss by {residual:.2g} rad",
            "the radii differ by more than floats resolve, or the graph is not 3-connected",
            "split the graph into smaller sets",
        )
    )


class PlanarPacking:
    """The packing in the plane, with the pitch point of one mesh at infinity."""

    def __init__(self, gears: int, regions: Sequence[Sequence[int]]) -> None:
        self.gears, self.regions = gears, [tuple(region) for region in regions]
        self.left = {
            (u, v): at for at, walk in enumerate(regions) for u, v in zip(walk, [*walk[1:], walk[0]], strict=True)
        }
        self.meshes = tuple(sorted((u, v) for u, v in self.left if u < v))
        self.count = gears + len(self.regions)
        self.around = self._around()
        a, b = self._far_mesh()
        self.far = (a, b, gears + self.left[a, b], gears + self.left[b, a])

    def _around(self) -> list[list[int]]:
        """Regions round each gear and gears round each region, counterclockwise, as numbers of nodes."""
        before = {}
        for walk in self.regions:
            for at, gear in enumerate(walk):
                before[gear, walk[(at + 1) % len(walk)]] = walk[at - 1]
        around: list[list[int]] = [[] for _ in range(self.gears)]
        for first, second in sorted(before):
            if not around[first]:
                other = second
                while not around[first] or other != second:
                    around[first].append(self.gears + self.left[first, other])
                    other = before[first, other]
        return around + [list(walk) for walk in self.regions]

    def _far_mesh(self) -> tuple[int, int]:
        """The mesh with the most neighbours: what lies at infinity should have much on its rim."""
        size = [len(beside) for beside in self.around]
        return max(
            self.meshes,
            key=lambda m: size[m[0]] + size[m[1]] + sum(size[self.gears + self.left[e]] for e in (m, m[::-1])),
        )

    def radii(self, on_step: Callable[[], None] = lambda: None) -> tuple[Floats, tuple[float, ...]]:
        """Log radii of all nodes, inf for the four at infinity: sparse Newton on a convex function.

        on_step   called after each step, of which the largest residual (rad) is returned too
        """
        from scipy.sparse import coo_array
        from scipy.sparse.linalg import splu

        near = np.ones(self.count, dtype=bool)
        near[list(self.far)] = False
        place = np.cumsum(near) - 1
        pairs = [(i, j) for i in range(self.count) if near[i] for j in self.around[i]]
        i, j = np.array([pair for pair in pairs if near[pair[1]]]).T
        far_ends = [pair[0] for pair in pairs if not near[pair[1]]]
        target = np.asarray(2 * pi - pi * np.bincount(far_ends, minlength=self.count), dtype=float)[near]
        i, j, n = place[i], place[j], int(near.sum())
        u, residuals = np.zeros(n), []
        excess = angle_excess(u, i, j, target)
        for _ in range(_MOST_STEPS):
            w = stiffness(u, i, j)
            rows, columns = np.concatenate([i, np.arange(n)]), np.concatenate([j, np.arange(n)])
            matrix = coo_array((np.concatenate([-w, np.bincount(i, w, n)]), (rows, columns)), shape=(n, n)).tocsc()
            # one radius is free: the packing of the plane has no scale
            step = np.zeros(n)
            step[1:] = splu(matrix[1:, 1:].tocsc()).solve(excess[1:])
            # Newton's step may be far too long where an angle hardly depends on the radii yet
            step *= min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300))
            u = u + step
            excess = angle_excess(u, i, j, target)
            residuals.append(float(np.abs(excess).max()))
            on_step()
            # or where the residual, the rounding of many angles, no longer falls
            if np.abs(step).max() < 1e-13 or (residuals[-1] < 1e-11 and _stalls(residuals)):
                break
        else:
            raise _no_packing(residuals[-1])
        full = np.full(self.count, inf)
        full[near] = u - u.max()
        return full, tuple(residuals)

    def layout(self, u: Floats) -> Floats:
        """All circles on the sphere, from radii in the plane, walking from circle to circle."""
        r = np.exp(u)
        start = int(np.argmax(np.where(np.isinf(u), -inf, u)))
        centre: dict[int, complex] = {start: 0j}
        lines: dict[int, tuple[complex, complex]] = {}
        queue = deque([(start, self.around[start][0], 1 + 0j)])
        while queue:
            node, first, towards = queue.popleft()
            for other, direction in self._directions(r, node, first, towards):
                if np.isinf(r[other]):
                    lines[other] = (direction, centre[node])
                elif other not in centre:
                    # orthogonal circles: the radii to a crossing make a right angle
                    centre[other] = centre[node] + direction * np.hypot(r[node], r[other])
                    queue.append((other, node, -direction))
        return self._on_sphere(r, centre, lines)

    def _directions(self, r: Floats, node: int, first: int, towards: complex) -> list[tuple[int, complex]]:
        """Unit directions from a node to its neighbours, counterclockwise from the first."""
        beside = self.around[node]
        at = beside.index(first)
        beside = beside[at:] + beside[:at]
        half = np.arctan(r[beside] / r[node])
        turns = np.concatenate([[0.0], np.cumsum(half[1:] + half[:-1])])
        return [(other, towards * complex(np.exp(1j * turn))) for other, turn in zip(beside, turns, strict=True)]

    def _on_sphere(self, r: Floats, centre: dict[int, complex], lines: dict[int, tuple[complex, complex]]) -> Floats:
        """Vectors of all circles; the rectangle between the four lines is brought about the origin first."""
        offsets = {node: (m, (m.conjugate() * p).real) for node, (m, p) in lines.items()}
        middle, scale = 0j, 0.0
        for one, other in (self.far[:2], self.far[2:]):
            (m, d), (_, e) = offsets[one], offsets[other]
            middle += m * (d - e) / 2
            scale = max(scale, abs(d + e) / 2)
        vectors = np.empty((self.count, 4))
        for node, place in centre.items():
            vectors[node] = circle_vector((place - middle) / scale, r[node] / scale)
        for node, (m, offset) in offsets.items():
            vectors[node] = line_vector(m, (offset - (m.conjugate() * middle).real) / scale)
        # the plane's counterclockwise is clockwise on the sphere, seen from outside
        vectors[:, 2] *= -1
        return vectors
