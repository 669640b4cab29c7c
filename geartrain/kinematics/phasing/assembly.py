"""Closure of a declared train, and of a set of gears on a sphere."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

import numpy as np

from geartrain.errors import Problem as Trouble
from geartrain.errors import QuestionError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.components import find_components
from geartrain.kinematics.phasing.azimuths import (
    EPS,
    MOUNT,
    PitchPoints,
    contact_families,
    mount_frame_wheels,
    place_pitch_points,
)
from geartrain.kinematics.phasing.mesh_phasing import DivisibilityRule, MeshPhasing
from geartrain.kinematics.phasing.phase_system import PhaseSystem
from geartrain.train import Train

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


_FRAME = MOUNT  # no gear on a sphere has this name
_OFF = 1e-6  # turns: contacts declared regular stand nearer than this to where they should


class SphericalGears(Protocol):
    """Gears with axes through one point, as a configuration of the spherical room has them."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the gears."""

    @property
    def axes(self) -> Floats:
        """Outward unit vectors, (gears, 3)."""

    @property
    def meshes(self) -> tuple[tuple[int, int], ...]:
        """Pairs of gears by index."""

    @property
    def kinds(self) -> tuple[str, ...]:
        """Kind of each gear."""

    @property
    def regular(self) -> tuple[int, ...]:
        """p where the contacts of a gear stand at multiples of a p-th of a turn; 0 where angles are floats."""

    @property
    def teeth(self) -> Mapping[str, int]:
        """Tooth number of each kind."""


def find_phasing(
    train: Train, tree: Tree, circuits: Sequence[Circuit], plays: Mapping[str, float] | None = None
) -> MeshPhasing:
    """Closure of a declared train, in the pose in which its moving axes are declared.

    plays   pair -> play of its teeth (pitches), as far as it is known
    """
    contacts = place_pitch_points(train, tree, circuits)
    parts = find_components(_links(train, contacts.circuits), train.frame, contacts.circuits)
    unjudged = 0
    if contacts.left_out:
        every = [mount_frame_wheels(circuit, train.frame) for circuit in circuits]
        whole = find_components(_links(train, every), train.frame, every)
        unjudged = max(len(whole.closing) - len(parts.closing), 0)
    return MeshPhasing(PhaseSystem(parts, contacts), dict(plays or {}), lambda: _alike(train), unjudged)


def _links(train: Train, circuits: Sequence[Circuit]) -> tuple[str, ...]:
    """All links, and the frame's wheels as links of their own."""
    mounts = (link for circuit in circuits for link in (circuit.i, circuit.j) if MOUNT in link)
    return tuple(dict.fromkeys([*train.links, *mounts]))


def _alike(train: Train) -> dict[str, str]:
    """Wheels of one tooth count, alike and among mates that are alike, under the name of the first."""
    marks = {name: (wheel.count, wheel.internal) for name, (_, wheel) in train.wheels.items()}
    mates: dict[str, list[object]] = {name: [] for name in marks}
    for gear in train.gears:
        first, second = gear.pair
        mates[first].append(marks[second])
        mates[second].append(marks[first])
    heads: dict[object, str] = {}
    return {name: heads.setdefault((mark, tuple(sorted(map(repr, mates[name])))), name) for name, mark in marks.items()}


def spherical_phasing(configuration: SphericalGears, teeth: Mapping[str, int] | None = None) -> MeshPhasing:
    """Closure of gears with axes through one point.

    teeth   tooth number of each kind, in place of those of the configuration

    Angles of links count from the direction `configuration.frame` gives first.
    """
    counts = {**configuration.teeth, **(teeth or {})}
    missing = [kind for kind in dict.fromkeys(configuration.kinds) if kind not in counts]
    if missing:
        what = f"no tooth number for {', '.join(missing)}"
        raise QuestionError(Trouble(what, "phases count teeth", "give `teeth` for every kind, or ask for the rule"))
    return _closure(configuration, [counts[kind] for kind in configuration.kinds])


def spherical_divisibility_rule(configuration: SphericalGears) -> DivisibilityRule | None:
    """What tooth numbers must be multiples of; None where contacts do not stand at known parts of a turn."""
    return _closure(configuration, [1] * len(configuration.names)).rule


def _closure(configuration: SphericalGears, counts: Sequence[int]) -> MeshPhasing:
    names = configuration.names
    circuits = tuple(
        Circuit(
            f"{names[i]}~{names[j]}", "gear", names[i], names[j], _FRAME, counts[i], counts[j], (names[i], names[j])
        )
        for i, j in configuration.meshes
    )
    contacts = _contacts(configuration, circuits)
    parts = find_components((_FRAME, *names), _FRAME, circuits)
    return MeshPhasing(PhaseSystem(parts, contacts), {}, lambda: dict(zip(names, configuration.kinds, strict=True)))


def _contacts(configuration: SphericalGears, circuits: tuple[Circuit, ...]) -> PitchPoints:
    meshes = np.array(configuration.meshes, int).reshape(-1, 2)
    azimuth, sine = spherical_azimuths(np.asarray(configuration.axes, float), meshes)
    keys: list[tuple[object, object]] = []
    part: list[tuple[Fraction, Fraction]] = []
    first: dict[int, float] = {}
    for pair, turns in zip(meshes.tolist(), azimuth.tolist(), strict=True):
        found = []
        key: list[object] = []
        for gear, turn in zip(pair, turns, strict=True):
            parts = configuration.regular[gear]
            step = (turn - first.setdefault(gear, turn)) * parts
            if abs(step - round(step)) > _OFF * parts:
                what = f"'{configuration.names[gear]}' has contacts that are no multiples of 1/{parts} turn apart"
                raise QuestionError(Trouble(what, "it is declared regular", "declare it with `regular` 0"))
            found.append(Fraction(round(step), parts) % 1 if parts else Fraction(0))
            key.append(gear if parts else (len(keys), gear))
        part.append((found[0], found[1]))
        keys.append((key[0], key[1]))
    family, _ = contact_families(keys)
    # the smaller the angle between the axes, the more of a direction across one is rounding
    slack = 16 * EPS / sine[:, None] * np.ones(2)
    return PitchPoints(circuits, azimuth, slack, family, part)


def spherical_azimuths(axes: Floats, meshes: np.ndarray) -> tuple[Floats, Floats]:
    """Azimuths (turns) of both contacts of every mesh about outward axes, and the sine of the angle between the axes.

    They count from the first of two directions: the axis across the coordinate axis that is farthest from it.
    """
    # farthest from the axis, so that the vector product is never near 0
    least = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    first = np.cross(axes, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(axes, first)
    own, mate = axes[meshes], axes[meshes[:, ::-1]]
    x = (mate * first[meshes]).sum(axis=2)
    y = (mate * second[meshes]).sum(axis=2)
    sine = np.linalg.norm(np.cross(own[:, 0], mate[:, 0]), axis=1)
    return np.mod(np.arctan2(y, x) / math.tau, 1.0), sine
