"""Vectors in space as plain tuples of three numbers.

`dot`, `cross`, `minus`, `across_whole` and `parallel` are exact where the numbers are (integers, Fractions); what takes
a length or a direction of length 1 is for floats.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan2, cos, sin, sqrt
from typing import TypeVar

Vector = tuple[float, float, float]
IntegerVector = tuple[int, int, int]
ExactVector = tuple[Fraction, Fraction, Fraction]

N = TypeVar("N", int, float, Fraction)


def dot(u: tuple[N, N, N], v: tuple[N, N, N]) -> N:
    """The scalar product."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u: tuple[N, N, N], v: tuple[N, N, N]) -> tuple[N, N, N]:
    """The vector product."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def minus(u: tuple[N, N, N], v: tuple[N, N, N]) -> tuple[N, N, N]:
    """The way from v to u."""
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def parallel(u: tuple[N, N, N], v: tuple[N, N, N]) -> bool:
    """True if two vectors have one direction or opposite ones; decided without a tolerance, so for exact numbers."""
    return not any(cross(u, v))


def across_whole(v: IntegerVector, n: IntegerVector) -> IntegerVector:
    """The part of v across n, lengthened by the square of n so that it stays whole."""
    square, along = dot(n, n), dot(v, n)
    return square * v[0] - along * n[0], square * v[1] - along * n[1], square * v[2] - along * n[2]


def plus(u: Vector, v: Vector, factor: float = 1.0) -> Vector:
    """u + factor v: the point that lies `factor` times a way v from a point u."""
    return u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2]


def scaled(u: Vector, factor: float) -> Vector:
    """u times a number."""
    return u[0] * factor, u[1] * factor, u[2] * factor


def turned(u: Vector, way: Vector, angle: float) -> Vector:
    """u turned about a unit vector by an angle (rad), right-handed: Rodrigues' formula."""
    along = scaled(way, dot(way, u) * (1 - cos(angle)))
    return plus(plus(scaled(u, cos(angle)), scaled(cross(way, u), sin(angle))), along)


def size(v: Vector) -> float:
    """The length of a vector."""
    return sqrt(dot(v, v))


def unit(v: Vector) -> Vector:
    """The direction of a vector other than zero."""
    top = max(abs(part) for part in v)  # first: squares of what is left neither overflow nor vanish
    x, y, z = (part / top for part in v)
    length = sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def across(v: Vector, n: Vector) -> Vector:
    """The part of v across a unit vector n."""
    return plus(v, n, -dot(v, n))


def frame(n: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors across n that make a right-handed frame with it: x and y where n is z."""
    # x, unless it lies so near to n that its part across n is mostly rounding
    start: Vector = (1.0, 0.0, 0.0) if abs(n[0]) < 0.9 else (0.0, 1.0, 0.0)
    first = unit(across(start, n))
    return first, cross(n, first)


def foot(point: Vector, way: Vector, other: Vector, cut: Vector) -> tuple[Vector, Vector]:
    """The points of two lines (a point and a unit vector each) that are nearest to each other; not for parallels."""
    apart, turn = minus(other, point), dot(way, cut)
    square = 1.0 - turn * turn
    near = (dot(apart, way) - turn * dot(apart, cut)) / square
    there = (turn * dot(apart, way) - dot(apart, cut)) / square
    return plus(point, way, near), plus(other, cut, there)


def unit_or_z(u: Vector) -> Vector:
    """The same direction, of length 1; z where there is none."""
    length = size(u)
    return scaled(u, 1 / length) if length > 1e-12 else (0.0, 0.0, 1.0)


def beside(axis: Vector) -> Vector:
    """A unit vector across an axis: y for z, so that a zero mark stands upwards."""
    for way in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        flat = across(way, axis)
        # across any axis y or z is left with 0.7 at least, so that nothing cancels
        if size(flat) > 0.5:
            return unit_or_z(flat)
    return (1.0, 0.0, 0.0)


def azimuth(u: Vector, axis: Vector, reference: Vector) -> float:
    """Angle (rad) of u about a unit vector, counted from a unit vector across it."""
    return atan2(dot(u, cross(axis, reference)), dot(u, reference))  # not acos, which loses half the digits near 0
