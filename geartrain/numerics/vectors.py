"""Vectors in space as plain tuples of three numbers.

`dot`, `cross`, `minus`, `across_whole` and `parallel` are exact for exact numbers (integers, Fractions). Functions that
use a length or a unit vector are for floats.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, cos, hypot, sin, sqrt
from typing import TypeVar

Vector = tuple[float, float, float]
IntegerVector = tuple[int, int, int]
ExactVector = tuple[Fraction, Fraction, Fraction]

N = TypeVar("N", int, float, Fraction)

_PARALLEL = 1e-9  # [1 or mm] smaller values are rounding errors


def dot(u: tuple[N, N, N], v: tuple[N, N, N]) -> N:
    """Return the scalar product of two vectors."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u: tuple[N, N, N], v: tuple[N, N, N]) -> tuple[N, N, N]:
    """Return the vector product of two vectors."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def minus(u: tuple[N, N, N], v: tuple[N, N, N]) -> tuple[N, N, N]:
    """Return the difference u - v."""
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def parallel(u: tuple[N, N, N], v: tuple[N, N, N]) -> bool:
    """Return True if two vectors are exactly parallel or antiparallel; no tolerance is applied."""
    return not any(cross(u, v))


def across_whole(v: IntegerVector, n: IntegerVector) -> IntegerVector:
    """Return the component of v perpendicular to n, multiplied by n.n so that it remains integer."""
    square, along = dot(n, n), dot(v, n)
    return square * v[0] - along * n[0], square * v[1] - along * n[1], square * v[2] - along * n[2]


def plus(u: Vector, v: Vector, factor: float = 1.0) -> Vector:
    """Return the sum u + factor v."""
    return u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2]


def scaled(u: Vector, factor: float) -> Vector:
    """Return a vector multiplied by a number."""
    return u[0] * factor, u[1] * factor, u[2] * factor


def turned(u: Vector, way: Vector, angle: float) -> Vector:
    """Return u rotated by an angle [rad] about the unit vector `way`, by the right-hand rule (Rodrigues' formula)."""
    along = scaled(way, dot(way, u) * (1 - cos(angle)))
    return plus(plus(scaled(u, cos(angle)), scaled(cross(way, u), sin(angle))), along)


def size(v: Vector) -> float:
    """Return the length (Euclidean norm) of a vector."""
    return sqrt(dot(v, v))


def unit(v: Vector) -> Vector:
    """Return a nonzero vector scaled to length 1."""
    top = max(abs(part) for part in v)  # scale first, so that squares neither overflow nor underflow
    x, y, z = (part / top for part in v)
    length = sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def across(v: Vector, n: Vector) -> Vector:
    """Return the component of v perpendicular to a unit vector n."""
    return plus(v, n, -dot(v, n))


def frame(n: Vector) -> tuple[Vector, Vector]:
    """Return two unit vectors perpendicular to n that form a right-handed frame (first, second, n)."""
    # x, unless it is so close to n that its perpendicular component is mostly rounding
    start: Vector = (1.0, 0.0, 0.0) if abs(n[0]) < 0.9 else (0.0, 1.0, 0.0)
    first = unit(across(start, n))
    return first, cross(n, first)


def foot(point: Vector, way: Vector, other: Vector, cut: Vector) -> tuple[Vector, Vector]:
    """Return the nearest points of two lines: through `point` along `way`, and through `other` along `cut`."""
    apart, turn = minus(other, point), dot(way, cut)
    # squared sine of the angle between the lines; 0 only for parallel lines
    square = 1.0 - turn * turn
    near = (dot(apart, way) - turn * dot(apart, cut)) / square
    there = (turn * dot(apart, way) - dot(apart, cut)) / square
    return plus(point, way, near), plus(other, cut, there)


def unit_or_z(u: Vector) -> Vector:
    """Return a vector scaled to length 1; return the unit vector z for a zero vector."""
    length = size(u)
    # a shorter vector is the rounding error of a zero vector
    return scaled(u, 1 / length) if length > 1e-12 else (0.0, 0.0, 1.0)


def beside(axis: Vector) -> Vector:
    """Return a unit vector perpendicular to an axis; for the axis z it is y, so that a zero mark points upwards."""
    for way in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        flat = across(way, axis)
        # y or z has a perpendicular component of at least 0.7, so that cancellation is harmless
        if size(flat) > 0.5:
            return unit_or_z(flat)
    return (1.0, 0.0, 0.0)


def azimuth(u: Vector, axis: Vector, reference: Vector) -> float:
    """Return the angle of u about a unit vector `axis` [rad], from `reference`, a unit vector perpendicular to it."""
    return atan2(dot(u, cross(axis, reference)), dot(u, reference))  # acos would lose half of the digits near 0


def basis(normal: Vector) -> tuple[Vector, Vector]:
    """Return the unit vectors right and up, seen against the direction of `normal`; x and y for the normal z."""
    nx, ny, nz = normal
    if hypot(nx, ny) < _PARALLEL:
        return (1.0, 0.0, 0.0), (0.0, 1.0 if nz > 0 else -1.0, 0.0)
    length = hypot(nx, ny)
    right = (-ny / length, nx / length, 0.0)
    return right, (-nz * right[1], nz * right[0], nx * right[1] - ny * right[0])
