"""A set of gears on a sphere: where their axes point, who meshes with whom, of which kinds they are, and as a train.

Kinds of gear and of mesh, how near gears come that do not mesh, and the declaration of a train: a link, a bevel wheel
and an axis for each gear.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from math import degrees, inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.spherical.pitch_cones import angle_between, frames, mesh_angles, separations

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class Configuration:
    """Gears with axes through one point: where they point, who meshes with whom, and of which kinds they are.

    Axes point outwards; angles about them are counterclockwise seen from outside.

    Parameters
    ----------
    names : tuple of str
        Of the gears.
    axes : array of float, (gears, 3)
        Unit vectors.
    meshes : tuple of tuple of int
        Pairs of gears by index.
    kinds : tuple of str
        Of each gear: gears of one kind are alike under the symmetries of the set, and have one tooth number.
    regular : tuple of int
        Of each gear: p where its contacts stand at multiples of a p-th of a turn from each other, exactly; 0 where
        their angles are only known in floats.
    teeth : mapping of str to int
        Tooth number of each kind, as far as they are chosen.
    title : str
        For a reader.

    Examples
    --------
    Three gears on the axes x, y and z; x meshes with the other two:

    >>> import numpy as np
    >>> found = Configuration(("x", "y", "z"), np.eye(3), ((0, 1), (0, 2)), ("x", "yz", "yz"), (4, 1, 1))
    >>> round(found.angle(0, 1) * 180 / np.pi, 12), round(abs(found.azimuth(0, 1) - found.azimuth(0, 2)) / np.pi, 12)
    (90.0, 0.5)
    """

    names: tuple[str, ...]
    axes: Floats
    meshes: tuple[tuple[int, int], ...]
    kinds: tuple[str, ...]
    regular: tuple[int, ...]
    teeth: Mapping[str, int] = field(default_factory=dict)
    title: str = ""

    def angle(self, i: int, j: int) -> float:
        """Angle between two axes [rad], 0 to pi.

        Parameters
        ----------
        i, j : int
            The gears.
        """
        return float(angle_between(self.axes[i], self.axes[j]))

    def azimuth(self, i: int, j: int) -> float:
        """Direction from one gear to another about the axis of the first [rad].

        Parameters
        ----------
        i, j : int
            The gears; directions about i are counted from the first of `frame(i)`, counterclockwise from outside.
        """
        first, second = self.frame(i)
        return float(np.arctan2(self.axes[j] @ second, self.axes[j] @ first))

    def frame(self, i: int) -> tuple[Floats, Floats]:
        """Two directions across an axis that make a right-handed frame with it, pointing outwards.

        Parameters
        ----------
        i : int
            The gear.
        """
        first, second = frames(self.axes[i : i + 1])[0]
        return first, second


def kinds_in_order(configuration: Configuration) -> tuple[str, ...]:
    """The kinds of gear, each once, in the order of their first gears."""
    return tuple(dict.fromkeys(configuration.kinds))


def mesh_kinds(configuration: Configuration) -> tuple[MeshKind, ...]:
    """Kinds of mesh, in the order of their gears' kinds; meshes are alike to 1e-9 rad."""
    order = {kind: at for at, kind in enumerate(kinds_in_order(configuration))}
    groups: dict[tuple[int, int, int], list[int]] = {}
    angles = mesh_angles(configuration.axes, configuration.meshes)
    for at, (i, j) in enumerate(configuration.meshes):
        a, b = sorted((order[configuration.kinds[i]], order[configuration.kinds[j]]))
        # the nearest slot or its neighbour: angles on a slot's edge must not be parted by rounding
        slot = round(float(angles[at]) * 1e9)
        key = next((found for near in (slot, slot - 1, slot + 1) if (found := (a, b, near)) in groups), (a, b, slot))
        groups.setdefault(key, []).append(at)
    names = tuple(order)
    return tuple(
        MeshKind(names[a], names[b], float(angles[found[0]]), tuple(found))
        for (a, b, _), found in sorted(groups.items())
    )


def nearest_unmeshed(configuration: Configuration) -> dict[tuple[str, str], float]:
    """Least angle (rad) between gears that do not mesh, for each pair of kinds, in both orders."""
    apart = unmeshed_angles(configuration)
    kinds = np.array(configuration.kinds)
    found: dict[tuple[str, str], float] = {}
    for a in kinds_in_order(configuration):
        rows = apart[kinds == a].min(axis=0)
        for b in kinds_in_order(configuration):
            least = float(rows[kinds == b].min())
            if least < inf:
                found[a, b] = least
    return found


def unmeshed_angles(configuration: Configuration) -> Floats:
    """Angles between all axes, inf for a gear and itself and for gears that mesh."""
    apart = separations(configuration.axes)
    np.fill_diagonal(apart, inf)
    if configuration.meshes:
        i, j = np.array(configuration.meshes).T
        apart[i, j] = apart[j, i] = inf
    return apart


@dataclass(frozen=True)
class MeshKind:
    """Meshes that are alike: the kinds of their two gears, the angle between the axes (rad), and which they are."""

    a: str
    b: str
    angle: float
    meshes: tuple[int, ...]

    @property
    def kinds(self) -> tuple[str, str]:
        """The kinds of its gears."""
        return self.a, self.b

    def __str__(self) -> str:
        return f"{self.a}-{self.b} at {degrees(self.angle):.6f} deg"


_NOTE = (
    "All axes go through the centre of the sphere and point outwards; a speed is positive counterclockwise, "
    "seen from outside. Two wheels in mesh turn against each other."
)

_SHORT = 1 << 20  # denominators of coordinates such as 3/4, which floats hold as they are meant


def to_train(configuration: Configuration, name: str = "") -> dict[str, Any]:
    """The configuration as plain data with the keys of a declaration, for `GearTrain.declare`.

    Links, wheels and axes have the names of the gears. With axes outwards every mesh reverses, z_i w_i + z_j w_j = 0
    (docs/sphere.md, section 1): the wheels stand on the positive sides of their axes (`facing` 1, the default). The
    first gear is the input, at speed 1. Directions are floats at full length.

    Parameters
    ----------
    configuration : Configuration
        With a tooth number for every kind.
    name : str
        Of the train; default `spherical`.

    Returns
    -------
    dict
        The declaration.

    Raises
    ------
    QuestionError
        If a tooth number is missing, or there are no gears.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.spherical import from_polyhedron
    >>> data = to_train(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    >>> geartrain.GearTrain.declare(data).solve()["3-1"]
    Fraction(-5, 3)
    """
    missing = [kind for kind in kinds_in_order(configuration) if kind not in configuration.teeth]
    if missing or not configuration.names:
        raise QuestionError(
            Problem(
                f"no tooth number for {', '.join(missing)}" if missing else "a set without gears is no train",
                "a declaration has one for every wheel",
                "choose `teeth` for every kind" if missing else "drop fewer gears",
            )
        )
    gears = list(zip(configuration.names, configuration.kinds, configuration.axes.tolist(), strict=True))
    return {
        "name": name or "spherical",
        "title": configuration.title or f"{len(gears)} gears on a sphere",
        "note": _NOTE,
        "frame": "frame",
        "links": {"frame": {}} | {gear: _link(gear, configuration.teeth[kind]) for gear, kind, _ in gears},
        "axes": {
            gear: {"direction": _direction(axis), "position": ["0 mm", "0 mm", "0 mm"]} for gear, _, axis in gears
        },
        "revolutes": [{"pair": ["frame", gear], "axis": gear} for gear, _, _ in gears],
        "gears": [{"pair": [configuration.names[i], configuration.names[j]]} for i, j in configuration.meshes],
        "inputs": {configuration.names[0]: 1},
    }


def _direction(axis: list[float]) -> list[str]:
    """Floats at full length, short ones as fractions: a decimal counts as known to its last digit only."""
    exact = [Fraction(part) for part in axis]
    return [str(part) if part.denominator < _SHORT else f"{float(part):.17g}" for part in exact]


def _link(gear: str, teeth: int) -> dict[str, Any]:
    return {"wheels": {gear: {"teeth": teeth, "kind": "bevel"}}}
