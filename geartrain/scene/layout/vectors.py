"""Vectors in space as three floats.

Vectors in space, as plain tuples.
"""

from __future__ import annotations

from math import atan2, sqrt

from geartrain.scene.layout.axis_places import Vector


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


def scaled(u: Vector, factor: float) -> Vector:
    """u times a number."""
    return u[0] * factor, u[1] * factor, u[2] * factor


def plus(u: Vector, v: Vector, factor: float = 1.0) -> Vector:
    """u + factor v."""
    return u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2]


def unit_or_z(u: Vector) -> Vector:
    """The same direction, of length 1; z where there is none."""
    length = size(u)
    return scaled(u, 1 / length) if length > 1e-12 else (0.0, 0.0, 1.0)


def beside(axis: Vector) -> Vector:
    """A unit vector across an axis: y for z, so that a zero mark stands upwards."""
    for way in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        flat = across(way, axis)
        if size(flat) > 0.5:
            return unit_or_z(flat)
    return (1.0, 0.0, 0.0)


def azimuth(u: Vector, axis: Vector, reference: Vector) -> float:
    """Angle (rad) of u about a unit vector, counted from a unit vector across it."""
    return atan2(dot(u, cross(axis, reference)), dot(u, reference))
