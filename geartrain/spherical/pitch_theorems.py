"""Sets on fixed axes of which it is proved that no tooth numbers give one pitch (docs/sphere.md, section 4)."""

from __future__ import annotations

from math import atan, pi, sqrt

import numpy as np

from geartrain.spherical.configuration import Configuration
from geartrain.spherical.pitch_cones import mesh_angles, separations

_THEOREMS = {
    "rhombicosidodecahedron": (
        "equal pitch asks 2 (z5/z4) sin 72 - (z3/z4) sqrt3 phi = 1. A rational z5/z4 other than 0 would put "
        "2 sin 72, which generates a cyclic quartic field, into the biquadratic field Q(sqrt3, sqrt5); "
        "z5 = 0 makes z3 negative. No tooth numbers satisfy it"
    ),
    "rhombicuboctahedron": (
        "equal pitch asks sqrt2 (z4a/z4b - 1) + 1 = sqrt3 z3/z4b. Squaring leaves a rational multiple of sqrt2, so "
        "z4a = z4b and 3 (z3/z4b)^2 = 1. No tooth numbers satisfy it"
    ),
    "pseudo-rhombicuboctahedron": (
        "the ring of eight equal squares has pitch cones of 22.5 deg, which asks sqrt3 z3/z4 = 1 of each triangle "
        "beside it. No tooth numbers satisfy it"
    ),
}


def impossibility_theorem(configuration: Configuration) -> str:
    """Why no tooth numbers at all give one pitch on these fixed axes; "" where no such proof is known."""
    name = _proven(configuration)
    return f"{name}: {_THEOREMS[name]}" if name else ""


def _proven(configuration: Configuration) -> str:
    """The solid whose faces the gears stand on, among those with a proof: by its counts and mesh angles."""
    counts = len(configuration.axes), len(configuration.meshes)
    phi = (1 + sqrt(5)) / 2
    angles = {(62, 120): (atan(1 / phi), atan(phi**-2)), (26, 48): (pi / 4, atan(sqrt(0.5)))}.get(counts, ())
    if not angles:
        return ""
    seen = mesh_angles(configuration.axes, configuration.meshes)
    near = [np.abs(seen - angle) < 1e-9 for angle in angles]
    if sum(int(hit.sum()) for hit in near) < len(seen) or not all(int(hit.sum()) == len(seen) // 2 for hit in near):
        return ""
    if counts == (62, 120):
        return "rhombicosidodecahedron"
    # the twisted cap leaves one ring of squares of the three
    across = np.abs(separations(configuration.axes) - pi) < 1e-9
    return "rhombicuboctahedron" if across.any(axis=1).all() else "pseudo-rhombicuboctahedron"
