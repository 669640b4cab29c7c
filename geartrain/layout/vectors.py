"""Vectors in space as three floats."""

from __future__ import annotations

from math import sqrt

from geartrain.layout.result import Vector


def dot(u: Vector, v: Vector) -> float:
    """The scalar product."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u: Vector, v: Vector) -> Vector:
    """The vector product."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def along(point: Vector, way: Vector, far: float = 1.0) -> Vector:
    """The point that lies `far` times a way from another."""
    return point[0] + far * way[0], point[1] + far * way[1], point[2] + far * way[2]


def minus(u: Vector, v: Vector) -> Vector:
    """The way from v to u."""
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def size(v: Vector) -> float:
    """The length of a vector."""
    return sqrt(dot(v, v))


def unit(v: Vector) -> Vector:
    """The direction of a vector other than zero."""
    top = max(abs(part) for part in v)
    x, y, z = (part / top for part in v)
    length = sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def across(v: Vector, n: Vector) -> Vector:
    """The part of v across a unit vector n."""
    return along(v, n, -dot(v, n))


def frame(n: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors across n that make a right-handed frame with it: x and y where n is z."""
    start: Vector = (1.0, 0.0, 0.0) if abs(n[0]) < 0.9 else (0.0, 1.0, 0.0)
    first = unit(across(start, n))
    return first, cross(n, first)


def foot(point: Vector, way: Vector, other: Vector, cut: Vector) -> tuple[Vector, Vector]:
    """The points of two lines (a point and a unit vector each) that are nearest to each other; not for parallels."""
    apart, turn = minus(other, point), dot(way, cut)
    square = 1.0 - turn * turn
    near = (dot(apart, way) - turn * dot(apart, cut)) / square
    there = (turn * dot(apart, way) - dot(apart, cut)) / square
    return along(point, way, near), along(other, cut, there)
