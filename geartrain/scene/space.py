"""Vectors in space, as plain tuples."""

from __future__ import annotations

from math import atan2, sqrt

Vector = tuple[float, float, float]


def dot(u: Vector, v: Vector) -> float:
    """Scalar product."""
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u: Vector, v: Vector) -> Vector:
    """Vector product."""
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


def scaled(u: Vector, factor: float) -> Vector:
    """u times a number."""
    return u[0] * factor, u[1] * factor, u[2] * factor


def plus(u: Vector, v: Vector, factor: float = 1.0) -> Vector:
    """u + factor v."""
    return u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2]


def minus(u: Vector, v: Vector) -> Vector:
    """From v to u."""
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def size(u: Vector) -> float:
    """Length."""
    return sqrt(dot(u, u))


def unit(u: Vector) -> Vector:
    """The same direction, of length 1; z where there is none."""
    length = size(u)
    return scaled(u, 1 / length) if length > 1e-12 else (0.0, 0.0, 1.0)


def across(u: Vector, axis: Vector) -> Vector:
    """The part of u at right angles to a unit vector."""
    return plus(u, axis, -dot(u, axis))


def beside(axis: Vector) -> Vector:
    """A unit vector across an axis: y for z, so that a zero mark stands upwards."""
    for way in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)):
        flat = across(way, axis)
        if size(flat) > 0.5:
            return unit(flat)
    return (1.0, 0.0, 0.0)


def azimuth(u: Vector, axis: Vector, reference: Vector) -> float:
    """Angle (rad) of u about a unit vector, counted from a unit vector across it."""
    return atan2(dot(u, cross(axis, reference)), dot(u, reference))
