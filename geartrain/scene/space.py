"""Vectors in space, as plain tuples."""

from __future__ import annotations

from math import atan2

from geartrain.layout.result import Vector
from geartrain.layout.vectors import across, cross, dot, minus, size

__all__ = ["Vector", "across", "azimuth", "beside", "cross", "dot", "minus", "plus", "scaled", "size", "unit"]


def scaled(u: Vector, factor: float) -> Vector:
    """u times a number."""
    return u[0] * factor, u[1] * factor, u[2] * factor


def plus(u: Vector, v: Vector, factor: float = 1.0) -> Vector:
    """u + factor v."""
    return u[0] + factor * v[0], u[1] + factor * v[1], u[2] + factor * v[2]


def unit(u: Vector) -> Vector:
    """The same direction, of length 1; z where there is none."""
    length = size(u)
    return scaled(u, 1 / length) if length > 1e-12 else (0.0, 0.0, 1.0)


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
