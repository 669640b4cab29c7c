"""Sizes of the gears of a set on a sphere: cones, pitches, pressure angles and tip collisions.

All angles are in radians, all lengths in radii of the sphere on which the teeth are measured, and axes point outwards.
For some sets with fixed axes it is proved that pitches cannot be equal for any tooth numbers (docs/sphere.md, section
4).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import atan, degrees, log, pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Key, Result, finite
from geartrain.spherical.configuration import (
    Configuration,
    kinds_in_order,
    mesh_kinds,
    require_tooth_numbers,
    unmeshed_angles,
)
from geartrain.spherical.pitch_cones import (
    MEAN_PRESSURE,
    base_pitch,
    mesh_angles,
    operating_pitch,
    pitch_cone,
    pressure_angle,
    separations,
    undercut_limit,
    virtual_teeth,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

_THEOREMS = {
    "rhombicosidodecahedron": (
        "equal pitch requires 2 (z5/z4) sin 72 - (z3/z4) sqrt3 phi = 1. A rational z5/z4 other than 0 would put "
        "2 sin 72, which generates a cyclic quartic field, into the biquadratic field Q(sqrt3, sqrt5); "
        "z5 = 0 makes z3 negative. No tooth numbers satisfy it"
    ),
    "rhombicuboctahedron": (
        "equal pitch requires sqrt2 (z4a/z4b - 1) + 1 = sqrt3 z3/z4b. Squaring leaves a rational multiple of sqrt2, so "
        "z4a = z4b and 3 (z3/z4b)^2 = 1. No tooth numbers satisfy it"
    ),
    "pseudo-rhombicuboctahedron": (
        "the ring of eight equal squares has pitch cones of 22.5 deg, which requires sqrt3 z3/z4 = 1 for each triangle "
        "next to it. No tooth numbers satisfy it"
    ),
}
TIP_ROOM = 2.0
"""Required distance of the pitch circles of gears that do not mesh: two addenda of one module [modules]."""
_SAME = 1e-11
"""Relative difference below which pitches are considered equal, due to the rounding of axes in floats."""


def size_gears(configuration: Configuration, mean_pressure: float = MEAN_PRESSURE) -> SphereSizing:
    """Return the operating pitch cones, pitches and pressure angles of all meshes, by equation (1) of docs/sphere.md.

    All gears have a common base pitch, so that spherical involutes have a constant ratio at any operating pitch
    (docs/sphere.md, section 4).

    Parameters
    ----------
    configuration : Configuration
        Set of gears with a tooth number for every kind of gear.
    mean_pressure : float
        Mean pressure angle of the meshes [rad]; by default 20 deg.

    Returns
    -------
    SphereSizing
        Sizes of all meshes and gears.

    Raises
    ------
    QuestionError
        If a tooth number is missing, or if no gears mesh.

    Examples
    --------
    >>> from math import degrees
    >>> from geartrain.spherical import from_polyhedron
    >>> found = size_gears(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    >>> found.exact, [round(degrees(cone), 6) for cone in found.cones[0]]
    (True, [23.522418, 13.85495])
    """
    require_tooth_numbers(
        kinds_in_order(configuration),
        configuration.teeth,
        "sizes depend on the teeth of every kind of gear",
        "give teeth={{{}: 20, ...}}, or search for teeth with suggest_tooth_counts()",
    )
    z = np.array([configuration.teeth[kind] for kind in configuration.kinds], dtype=np.int64)
    if not configuration.meshes:
        raise QuestionError(Problem("no gears mesh", "sizes depend on the meshes", "declare at least one mesh"))
    i, j = np.array(configuration.meshes).T
    S = mesh_angles(configuration.axes, configuration.meshes)
    pitches = operating_pitch(S, z[i], z[j])
    if len(mesh_kinds(configuration)) == 1:
        # meshes of one kind have one pitch by symmetry; this removes the rounding of their axes
        pitches[:] = pitches[0]
    # each mesh has its own operating cones on a common base pitch
    cones = np.stack([pitch_cone(S, z[i], z[j]), pitch_cone(S, z[j], z[i])], axis=1)
    c = base_pitch(pitches, mean_pressure)
    return SphereSizing(configuration, z, cones, pitches, c, pressure_angle(c, pitches))


@dataclass(frozen=True)
class TipCollision:
    """Two gears that do not mesh but may collide, because their pitch circles are less than two modules apart."""

    gears: tuple[str, str]
    """Names of the two gears."""
    room: float
    """Distance between the pitch circles of the two gears [modules]; negative if the pitch circles overlap."""
    short: float
    """Distance by which the two gears are too close [modules]: the required distance minus `room`."""

    def __str__(self) -> str:
        return f"{self.gears[0]} and {self.gears[1]}: {self.room:.2f} modules apart, {self.short:.2f} modules too close"


class MeshSize(NamedTuple):
    """Sizes of one mesh: the operating cones of its gears, its pitch and its pressure angle."""

    gears: tuple[str, str]
    """Names of the two gears."""
    cones: tuple[float, float]
    """Half-angles of the operating pitch cones of the two gears [deg]."""
    pitch: float
    """Operating pitch lambda, which is half the module [radii of the sphere]."""
    pressure_angle: float | None
    """Operating pressure angle [deg]; None if involutes with the common base pitch cannot be in mesh."""


@dataclass(frozen=True)
class SphereSizing(Result):
    """Sizes of the gears of a set on a sphere, for chosen tooth numbers. Arrays have one row for each mesh or gear.

    See Also
    --------
    size_gears : function that returns it
    """

    KEYS = (
        Key("teeth", "by_gear"),
        "module",
        "exact",
        "mismatch",
        Key("meshes", "mesh_sizes"),
        "collisions",
        "undercut",
    )

    configuration: Configuration
    """Set of gears whose sizes these are."""
    teeth: NDArray[np.int64]
    """Tooth number of each gear, shape (gears,)."""
    cones: Floats
    """Half-angles of the operating pitch cones of the two gears of each mesh [rad], shape (meshes, 2)."""
    pitches: Floats
    """Operating pitch lambda (half the module) of each mesh [radii of the sphere], shape (meshes,)."""
    base: float
    """Common base pitch c of all gears [radii of the sphere]. The half-angle g of a base cone satisfies sin g = c z."""
    pressure: Floats
    """Operating pressure angle of each mesh [rad], shape (meshes,); NaN if involutes with the common base pitch cannot
    be in mesh.
    """

    def _summary(self) -> str:
        return self.configuration._summary()

    @property
    def exact(self) -> bool:
        """True if all meshes have the same pitch, within the rounding errors of the axes."""
        return self.mismatch <= _SAME

    @cached_property
    def mismatch(self) -> float:
        """Natural logarithm of the maximum pitch divided by the minimum pitch [1]."""
        return log(float(self.pitches.max()) / float(self.pitches.min()))

    @cached_property
    def pitch(self) -> float:
        """Geometric mean of the operating pitches [radii of the sphere]."""
        return float(np.exp(np.log(self.pitches).mean())) if self.mismatch else float(self.pitches[0])

    @property
    def module(self) -> float:
        """Mean module of the meshes, which is twice the geometric mean of the pitches [radii of the sphere]."""
        return 2 * self.pitch

    @cached_property
    def outer(self) -> Floats:
        """Half-angle of each gear's largest operating pitch cone [rad], shape (gears,). The cones of two gears that do
        not mesh must not overlap.
        """
        # a gear without a mesh has the cone of the mean pitch
        alone = np.arcsin(np.minimum(self.teeth * self.pitch, 1))
        largest = np.zeros(len(self.teeth))
        for side in (0, 1):
            np.maximum.at(largest, [mesh[side] for mesh in self.configuration.meshes], self.cones[:, side])
        return np.where(largest > 0, largest, alone)

    @property
    def by_gear(self) -> dict[str, int]:
        """Tooth number of each gear, by name."""
        return dict(zip(self.configuration.names, self.teeth.tolist(), strict=True))

    @property
    def mesh_sizes(self) -> list[MeshSize]:
        """Operating sizes of every mesh."""
        names = self.configuration.names
        cones, pressure = np.degrees(self.cones).tolist(), np.degrees(self.pressure).tolist()
        return [
            MeshSize((names[i], names[j]), tuple(cones[at]), float(self.pitches[at]), finite(pressure[at]))
            for at, (i, j) in enumerate(self.configuration.meshes)
        ]

    @cached_property
    def collisions(self) -> tuple[TipCollision, ...]:
        """Pairs of gears that do not mesh and whose pitch circles are less than two modules apart, in ascending order
        of this distance.
        """
        room = (unmeshed_angles(self.configuration) - self.outer[:, None] - self.outer[None]) / self.module
        # each pair once; the tolerance keeps gears that just clear
        rows, columns = np.nonzero(np.triu(room < TIP_ROOM - 1e-9, 1))
        names = self.configuration.names
        found = [
            TipCollision((names[i], names[j]), float(room[i, j]), TIP_ROOM - float(room[i, j]))
            for i, j in zip(rows, columns, strict=True)
        ]
        return tuple(sorted(found, key=lambda collision: collision.room))

    @property
    def virtual(self) -> Floats:
        """Virtual tooth number of each gear, shape (gears,)."""
        return virtual_teeth(self.teeth, self.outer)

    @property
    def undercut(self) -> dict[str, float]:
        """Virtual tooth number of each kind of gear that a rack with the mean pressure angle would undercut."""
        # pressure angle at the mean pitch: cos alpha = c / lambda
        limit = undercut_limit(float(np.arccos(self.base / self.pitch)))
        pairs = zip(self.configuration.kinds, self.virtual, strict=True)
        return {kind: float(count) for kind, count in pairs if count < limit}

    def label(self, mesh: int) -> str:
        """Return the names of the two gears of a mesh, joined by a hyphen.

        Parameters
        ----------
        mesh : int
            Index of the mesh.
        """
        i, j = self.configuration.meshes[mesh]
        return f"{self.configuration.names[i]}-{self.configuration.names[j]}"

    def __str__(self) -> str:
        head = "one pitch" if self.exact else f"pitches differ by {100 * self.mismatch:.4g} %"
        lines = [f"{self.configuration.title or 'set'}: {head}, module {self.module:.9g} of the sphere's radius"]
        for kind in mesh_kinds(self.configuration):
            mesh = kind.meshes[0]
            first, second = (degrees(cone) for cone in self.cones[mesh])
            lines.append(
                f"  {kind}: cones {first:.6f} and {second:.6f} deg ({self.label(mesh)}), "
                f"pressure angle {degrees(self.pressure[mesh]):.4f} deg"
            )
        if self.collisions:
            lines.append(f"  {len(self.collisions)} pairs collide, worst {self.collisions[0]}")
        lines += [f"  {kind} is undercut: {count:.1f} virtual teeth" for kind, count in self.undercut.items()]
        return "\n".join(lines)


# ----------------------------------------------------------------------------------------------- impossibility theorems


def impossibility_theorem(configuration: Configuration) -> str:
    """Return the proof that no tooth numbers give equal pitches on the fixed axes of a set; return an empty string if
    no proof is known. The solid is recognised by its numbers of gears and meshes, and by the angles of its meshes.
    """
    counts = len(configuration.axes), len(configuration.meshes)
    phi = (1 + sqrt(5)) / 2
    # counts of gears and meshes, and the two angles between adjacent faces
    angles = {(62, 120): (atan(1 / phi), atan(phi**-2)), (26, 48): (pi / 4, atan(sqrt(0.5)))}.get(counts, ())
    if not angles:
        return ""
    seen = mesh_angles(configuration.axes, configuration.meshes)
    near = [np.abs(seen - angle) < 1e-9 for angle in angles]
    if sum(int(hit.sum()) for hit in near) < len(seen) or not all(int(hit.sum()) == len(seen) // 2 for hit in near):
        return ""
    name = "rhombicosidodecahedron"
    if counts == (26, 48):
        # with the twisted cap of J37, not every face has an opposite face
        across = np.abs(separations(configuration.axes) - pi) < 1e-9
        name = "rhombicuboctahedron" if across.any(axis=1).all() else "pseudo-rhombicuboctahedron"
    return f"{name}: {_THEOREMS[name]}"
