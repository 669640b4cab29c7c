"""Circle packing on the sphere: each gear and each region of a planar map has a circle. Circles of meshing gears are
tangent, and circles of a gear and an adjacent region are orthogonal.

Every 3-connected planar graph has such a packing, which is unique up to Moebius transformations (Koebe, Andreev,
Thurston). The radii in the plane are computed by Newton's method on a convex function (A. Bobenko and B. Springborn,
Trans. AMS 356 (2004) 659), and the centres by a breadth-first layout. On the sphere the packing is centred by the
method of B. Springborn, Math. Z. 249 (2005) 513.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.spherical.pitch_cones import angle_rows, moved

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


# ------------------------------------------------------------------------------------------------------- planar packing


def angle_excess(u: Floats, i: Ints, j: Ints, target: Floats) -> Floats:
    """Return for every node the sum of the angles 2 atan(r_j/r_i) over its neighbours minus its target [rad]; u = log r
    are the logarithms of the radii.

    `i` and `j` are the nodes of every orthogonal pair, in both orders. The target is 2 pi, minus pi for each neighbour
    with infinite radius. The result is the gradient of a convex function of u (Bobenko and Springborn, Euclidean
    radii).
    """
    return np.asarray(np.bincount(i, 2 * np.arctan(np.exp(u[j] - u[i])), len(u)) - target, dtype=float)


def circle_vector(centre: complex, radius: float) -> Floats:
    """Return the vector (n, cos rho) / sin rho of the circle on the sphere that is the stereographic projection of a
    circle in the plane; n is its axis and rho its half-angle.

    In Minkowski space, <w, w> = 1, and <w_i, w_j> is -1 for tangent circles and 0 for orthogonal ones.
    For a plane circle with centre c and radius r, and with k = |c|^2 - r^2, it is (c, (k - 1)/2, (k + 1)/2) / r.
    """
    k = abs(centre) ** 2 - radius**2
    return np.array([centre.real, centre.imag, (k - 1) / 2, (k + 1) / 2]) / radius


class PlanarPacking:
    """Circle packing in the plane, in which the pitch point of one mesh is at infinity."""

    def __init__(self, gears: int, regions: Sequence[Sequence[int]]) -> None:
        self.gears, self.regions = gears, [tuple(region) for region in regions]
        self.left = {
            (u, v): at for at, walk in enumerate(regions) for u, v in zip(walk, [*walk[1:], walk[0]], strict=True)
        }
        self.meshes = tuple(sorted((u, v) for u, v in self.left if u < v))
        self.count = gears + len(self.regions)
        self.around = self._around()
        # the mesh with the most neighbours is placed at infinity, so that many circles touch lines
        sizes = [len(beside) for beside in self.around]
        beside = {m: [*m, *(gears + self.left[e] for e in (m, m[::-1]))] for m in self.meshes}
        a, b = max(self.meshes, key=lambda m: sum(sizes[node] for node in beside[m]))
        self.far = (a, b, gears + self.left[a, b], gears + self.left[b, a])

    def _around(self) -> list[list[int]]:
        """Return the regions around each gear, then the gears around each region, all counterclockwise, by node."""
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

    def radii(self, on_step: Callable[[], None] = lambda: None) -> tuple[Floats, tuple[float, ...]]:
        """Return the logarithms of all radii, found by Newton's method on a convex function, and the maximum residual
        after each step [rad]. The logarithm is inf for the four circles through infinity.

        on_step   function called after each step
        """
        from scipy.sparse import coo_array
        from scipy.sparse.linalg import splu

        near = np.ones(self.count, dtype=bool)
        # the four circles through infinity are straight lines
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
            w = 1 / np.cosh(u[j] - u[i])  # derivative of 2 atan(r_j/r_i) with respect to u_j
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
            # stop also when the residual no longer falls: what is left is the rounding of many angles
            stalled = residuals[-1] < 1e-11 and len(residuals) > 1 and 4 * residuals[-1] > residuals[-2]
            if stalled or np.abs(step).max() < 1e-13:
                break
        else:
            what = f"no circle packing was found: the residual of the angles is {residuals[-1]:.2g} rad"
            why = "the range of radii is too large for double precision, or the graph is not 3-connected"
            raise RangeError(Problem(what, why, "split the graph into smaller graphs"))
        full = np.full(self.count, inf)
        full[near] = u - u.max()
        return full, tuple(residuals)

    def layout(self, u: Floats) -> Floats:
        """Return the vectors of all circles on the sphere, found by breadth-first layout of the plane packing."""
        r = np.exp(u)
        # the layout starts at the largest finite circle
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
        """Return each neighbour of a node with the unit direction to it, from `first` in the direction `towards`."""
        beside = self.around[node]
        at = beside.index(first)
        beside = beside[at:] + beside[:at]
        # half the angle that an orthogonal neighbour subtends
        half = np.arctan(r[beside] / r[node])
        turns = np.concatenate([[0.0], np.cumsum(half[1:] + half[:-1])])
        return [(other, towards * complex(np.exp(1j * turn))) for other, turn in zip(beside, turns, strict=True)]

    def _on_sphere(self, r: Floats, centre: dict[int, complex], lines: dict[int, tuple[complex, complex]]) -> Floats:
        """Return the vectors of all circles after centring the rectangle of the four lines through infinity."""
        offsets = {node: (m, (m.conjugate() * p).real) for node, (m, p) in lines.items()}
        middle, scale = 0j, 0.0
        # opposite sides of the rectangle of lines
        for one, other in (self.far[:2], self.far[2:]):
            (m, d), (_, e) = offsets[one], offsets[other]
            middle += m * (d - e) / 2
            scale = max(scale, abs(d + e) / 2)
        vectors = np.empty((self.count, 4))
        for node, place in centre.items():
            vectors[node] = circle_vector((place - middle) / scale, r[node] / scale)
        for node, (m, offset) in offsets.items():
            # limit of `circle_vector` for the half-plane m.x >= distance
            distance = (offset - (m.conjugate() * middle).real) / scale
            vectors[node] = m.real, m.imag, distance, distance
        # counterclockwise in the plane is clockwise on the sphere seen from outside
        vectors[:, 2] *= -1
        return vectors


# ------------------------------------------------------------------------------------------------------- circle packing


_MOST_STEPS = 100  # Newton steps; four or five suffice on usual graphs
_MOST_POLISH = 12  # Newton steps; two or three suffice because the layout is nearly right
_LONGEST = 2.0
"""Maximum rapidity of one boost, and maximum change of the logarithm of a radius in one Newton step."""


def boost(v: Floats) -> Floats:
    """Return the matrix of the Lorentz boost of (x, t) with rapidity |v|, which moves points away from v."""
    rapidity = float(np.linalg.norm(v))
    if rapidity == 0:
        return np.eye(4)
    e = v / rapidity
    made = np.eye(4)
    made[:3, :3] += (np.cosh(rapidity) - 1) * np.outer(e, e)
    made[:3, 3] = made[3, :3] = -np.sinh(rapidity) * e
    made[3, 3] = np.cosh(rapidity)
    return made


def pack_circles(gears: int, regions: Sequence[Sequence[int]]) -> SpherePacking:
    """Return the centred circle packing of a 3-connected planar map.

    regions   gears around each region, all in the same sense; every mesh separates two regions
    """
    plane = PlanarPacking(gears, regions)
    u, residuals = plane.radii()
    vectors = _centred(plane.layout(u), plane.meshes)
    # rotation that puts the first gear of the first mesh at the top, and the second next to it in the direction of x
    axes, _ = _circles(vectors)
    top, side = (axes[gear] for gear in plane.meshes[0])
    x = side - top * (top @ side)
    x /= np.linalg.norm(x)
    turn = np.stack([x, np.cross(top, x), top])
    upright = np.concatenate([vectors[:, :3] @ turn.T, vectors[:, 3:]], axis=1)
    return _polished(upright, gears, plane, residuals)


def _circles(vectors: Floats) -> tuple[Floats, Floats]:
    """Return the axes and half-angles [rad] of circles that are given as vectors."""
    length = np.linalg.norm(vectors[:, :3], axis=1)
    # the last entry is the cotangent, accurate for small and for large circles
    return vectors[:, :3] / length[:, None], np.arctan2(1.0, vectors[:, 3])


def _centred(vectors: Floats, meshes: Sequence[tuple[int, int]]) -> Floats:
    """Return the packing in the frame in which the sum of the pitch points is 0, by damped Newton steps."""
    i, j = np.array(meshes).T
    for _ in range(_MOST_STEPS):
        touch = vectors[i] + vectors[j]
        points = touch[:, :3] / np.linalg.norm(touch[:, :3], axis=1)[:, None]
        # Newton step, a rapidity vector, to the frame in which points sum to 0: H v = sum p, H = sum (I - p p^T)
        v = np.linalg.solve(len(points) * np.eye(3) - points.T @ points, points.sum(axis=0))
        length = float(np.linalg.norm(v))
        # centred to rounding; a zero step has no direction
        if length < 1e-15:
            break
        # a long boost would lose digits
        v *= min(1.0, _LONGEST / length, _descent_fraction(points, v))
        vectors = vectors @ boost(v)
        # convergence is quadratic, so this was the last step that changes anything
        if length < 1e-14:
            break
    return vectors


def _descent_fraction(points: Floats, v: Floats) -> float:
    """Return the fraction of the step v, found by halving, for which the function sum log(-<x, (p, 1)>) over the pitch
    points p decreases. The function is convex in the vector x of Minkowski space, and its minimum corresponds to the
    centred frame.
    """
    share = 1.0
    # backtracking: the function is convex, so a short step always descends
    while share > 1e-6:
        made = boost(share * v)
        if np.log(points @ made[:3, 3] + made[3, 3]).sum() <= 1e-13 * len(points):
            break
        share /= 2
    return share


def _polished(vectors: Floats, gears: int, plane: PlanarPacking, residuals: tuple[float, ...]) -> SpherePacking:
    """Return the packing with all tangencies and right angles refined to rounding errors by Newton's method."""
    axes, cones = _circles(vectors)
    tangent = [*plane.meshes, *((gears + plane.left[m], gears + plane.left[m[::-1]]) for m in plane.meshes)]
    square = [(gear, region) for gear in range(gears) for region in plane.around[gear]]
    best = (inf, axes, cones)
    for _ in range(_MOST_POLISH):
        size, moves = _newton(axes, cones, tangent + square, len(tangent))
        # quadratic convergence ends where the residual no longer falls by a factor of 4
        better, enough = size < best[0], size < 1e-13 and size > best[0] / 4
        if better:
            best = (size, axes, cones)
        # above 1e-11 an increase of the residual is not due to rounding, and the iteration continues
        if enough or not (better or size > 1e-11):
            break
        axes = moved(axes, moves[: 2 * len(axes)].reshape(-1, 2))
        cones = cones + moves[2 * len(axes) :]
    size, axes, cones = best
    circles = axes[:gears], cones[:gears], axes[gears:], cones[gears:]
    return SpherePacking(*circles, plane.meshes, tuple(plane.regions), size, residuals)


def _newton(axes: Floats, cones: Floats, pairs: Sequence[tuple[int, int]], tangent: int) -> tuple[float, Floats]:
    """Return the maximum error of the angles between circles [rad], and the minimum-norm correction of axes and
    half-angles rho. The first `tangent` pairs of circles i, j are tangent: the angle S between their axes is rho_i +
    rho_j. The other pairs are orthogonal: cos S = cos rho_i cos rho_j.
    """
    from scipy.sparse import coo_array, eye_array, hstack
    from scipy.sparse.linalg import splu

    i, j = np.array(pairs).T
    touching = np.arange(len(pairs)) < tangent
    S, slopes = angle_rows(axes, pairs)
    want = np.where(touching, cones[i] + cones[j], np.arccos(np.cos(cones[i]) * np.cos(cones[j])))
    error = S - want
    widen = [np.where(touching, 1.0, np.sin(cones[p]) * np.cos(cones[q]) / np.sin(want)) for p, q in ((i, j), (j, i))]
    at = np.tile(np.arange(len(pairs)), 2), np.concatenate([i, j])
    J: Any = hstack([slopes, coo_array((-np.concatenate(widen), at), shape=(len(pairs), len(axes)))], format="csc")
    # Moebius maps change no angle, so J is rank deficient: a little damping selects the minimum-norm step
    damped = (J.T @ J + 1e-10 * eye_array(J.shape[1])).tocsc()
    return float(np.abs(error).max()), np.asarray(splu(damped).solve(-(J.T @ error)))


@dataclass(frozen=True)
class SpherePacking:
    """Circle packing on the sphere, centred so that the sum of the pitch points of all meshes is 0."""

    axes: Floats
    """Unit vectors to the centres of the gears, shape (gears, 3)."""
    cones: Floats
    """Half-angles of the gears [rad], shape (gears,)."""
    region_axes: Floats
    """Unit vectors to the centres of the circles through the pitch points around each region, shape (regions, 3)."""
    region_cones: Floats
    """Half-angles of the circles through the pitch points around each region [rad], shape (regions,)."""
    meshes: tuple[tuple[int, int], ...]
    """Pairs of meshing gears, by index."""
    regions: tuple[tuple[int, ...], ...]
    """Gears around each region, counterclockwise as seen from outside."""
    residual: float
    """Maximum error of a tangency or right angle [rad]."""
    residuals: tuple[float, ...]
    """Maximum residual of the angle sums in the plane after each Newton step [rad]."""

    @property
    def pitch_points(self) -> Floats:
        """Unit vectors to the points at which the gears touch, shape (meshes, 3)."""
        i, j = np.array(self.meshes).T
        towards = self.axes[i] * np.sin(self.cones[j])[:, None] + self.axes[j] * np.sin(self.cones[i])[:, None]
        return np.asarray(towards / np.linalg.norm(towards, axis=1)[:, None])
