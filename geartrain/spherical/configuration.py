"""Sets of gears on a sphere: axes, meshes and kinds of gear, and declaration as a train.

The declared train has a link, a bevel wheel and an axis for each gear.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import islice
from math import degrees, inf
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Shown
from geartrain.spherical.pitch_cones import angle_between, frames, mesh_angles, separations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Mask = NDArray[np.bool_]

_NOTE = (
    "All axes go through the centre of the sphere and point outwards; a speed is positive counterclockwise, "
    "seen from outside. Two wheels in mesh turn in opposite senses."
)
_SHORT = 1 << 20  # largest denominator of coordinates such as 3/4 that floats represent exactly


@dataclass(frozen=True)
class Configuration(Shown):
    """Set of gears whose axes pass through one point, described by axes, meshing pairs, and the kind of each gear.

    Axes point outwards. Angles about them are counterclockwise as seen from outside.

    Examples
    --------
    Three gears have the axes x, y and z, and the first meshes with the other two:

    >>> import numpy as np
    >>> found = Configuration(("x", "y", "z"), np.eye(3), ((0, 1), (0, 2)), ("x", "yz", "yz"), (4, 1, 1))
    >>> round(found.angle(0, 1) * 180 / np.pi, 12), round(abs(found.azimuth(0, 1) - found.azimuth(0, 2)) / np.pi, 12)
    (90.0, 0.5)
    """

    names: tuple[str, ...]
    """Names of the gears."""
    axes: Floats
    """Unit vectors of the axes, pointing outwards, shape (gears, 3)."""
    meshes: tuple[tuple[int, int], ...]
    """Pairs of meshing gears, by index."""
    kinds: tuple[str, ...]
    """Kind of each gear; gears of a kind are equivalent by symmetry and have the same tooth number."""
    regular: tuple[int, ...]
    """Integer p of each gear for which its contacts are exactly at multiples of 1/p of a revolution; 0 if the angles
    are only known as floats.
    """
    teeth: Mapping[str, int] = field(default_factory=dict)
    """Tooth number by kind of gear, for the kinds whose tooth number was chosen."""
    title: str = ""
    """Title of the set for display."""

    def _summary(self) -> str:
        teeth = ", ".join(f"{kind} {count}" for kind, count in islice(self.teeth.items(), 4))
        title = self.title or f"{len(self.names)} gears, {len(self.meshes)} meshes"
        return title + (f", teeth {teeth}" if teeth else "")

    def angle(self, i: int, j: int) -> float:
        """Return the angle between two axes, 0 to pi [rad].

        Parameters
        ----------
        i, j : int
            Indices of the gears.
        """
        return float(angle_between(self.axes[i], self.axes[j]))

    def azimuth(self, i: int, j: int) -> float:
        """Return the direction from gear i to gear j, as an angle about the axis of gear i [rad].

        Parameters
        ----------
        i, j : int
            Indices of the gears. The angle is measured from the first vector of `frame(i)`, counterclockwise as seen
            from outside.
        """
        first, second = self.frame(i)
        return float(np.arctan2(self.axes[j] @ second, self.axes[j] @ first))

    def frame(self, i: int) -> tuple[Floats, Floats]:
        """Return two unit vectors that form a right-handed frame with the axis of a gear.

        Parameters
        ----------
        i : int
            Index of the gear.
        """
        first, second = frames(self.axes[i : i + 1])[0]
        return first, second


def kinds_in_order(configuration: Configuration) -> tuple[str, ...]:
    """Return the kinds of gear in the order of their first gears, without duplicates."""
    return tuple(dict.fromkeys(configuration.kinds))


def require_tooth_numbers(
    names: Iterable[Hashable], teeth: Mapping[Any, int], why: str, fix: str = "give the tooth number of every gear"
) -> None:
    """Raise `QuestionError` with the given cause and fix if one of the names has no tooth number in `teeth`. In `fix`,
    {} is replaced by the first of these names.
    """
    missing = [name for name in names if name not in teeth]
    if missing:
        what = f"no tooth number is given for {', '.join(map(str, missing))}"
        raise QuestionError(Problem(what, why, fix.format(repr(missing[0]))))


def mesh_kinds(configuration: Configuration) -> tuple[MeshKind, ...]:
    """Return the kinds of mesh, sorted by the kinds of gears, then by angle; angles within 1e-9 rad are equal."""
    order = {kind: at for at, kind in enumerate(kinds_in_order(configuration))}
    groups: dict[tuple[int, int, int], list[int]] = {}
    angles = mesh_angles(configuration.axes, configuration.meshes)
    for at, (i, j) in enumerate(configuration.meshes):
        a, b = sorted((order[configuration.kinds[i]], order[configuration.kinds[j]]))
        # the nearest slot or a neighbour: rounding must not separate equal angles at the edge of a slot
        slot = round(float(angles[at]) * 1e9)
        key = next((found for near in (slot, slot - 1, slot + 1) if (found := (a, b, near)) in groups), (a, b, slot))
        groups.setdefault(key, []).append(at)
    names = tuple(order)
    return tuple(
        MeshKind(names[a], names[b], float(angles[found[0]]), tuple(found))
        for (a, b, _), found in sorted(groups.items())
    )


def nearest_unmeshed(configuration: Configuration) -> dict[tuple[str, str], float]:
    """Return the minimum angle between gears that do not mesh [rad], for each pair of kinds in both orders."""
    apart = unmeshed_angles(configuration)
    kinds = np.array(configuration.kinds)
    found: dict[tuple[str, str], float] = {}
    for a in kinds_in_order(configuration):
        rows = apart[kinds == a].min(axis=0)
        for b in kinds_in_order(configuration):
            minimum = float(rows[kinds == b].min())
            if minimum < inf:
                found[a, b] = minimum
    return found


def unmeshed_angles(configuration: Configuration) -> Floats:
    """Return the angles between all axes [rad]; the angle is inf for meshing gears and for a gear with itself."""
    apart = separations(configuration.axes)
    np.fill_diagonal(apart, inf)
    if configuration.meshes:
        i, j = np.array(configuration.meshes).T
        apart[i, j] = apart[j, i] = inf
    return apart


@dataclass(frozen=True)
class MeshKind:
    """Kind of mesh: a set of equivalent meshes, with the kinds of their two gears and the angle between the axes."""

    a: str
    """Kind of the first gear."""
    b: str
    """Kind of the second gear."""
    angle: float
    """Angle between the axes [rad]."""
    meshes: tuple[int, ...]
    """Indices of the meshes of this kind."""

    @property
    def kinds(self) -> tuple[str, str]:
        """Kinds of the two gears."""
        return self.a, self.b

    def __str__(self) -> str:
        return f"{self.a}-{self.b} at {degrees(self.angle):.6f} deg"


def to_train(configuration: Configuration, name: str = "") -> dict[str, Any]:
    """Return the declaration of the set as plain data, for `GearTrain.declare`.

    Links, wheels and axes have the names of the gears. All axes point outwards, and the wheels are on the positive
    sides of their axes (`facing` is 1, the default). Every mesh therefore reverses the sense of rotation: z_i w_i + z_j
    w_j = 0 (docs/sphere.md, section 1). The first gear is the input, with speed 1. The directions are written with all
    digits.

    Parameters
    ----------
    configuration : Configuration
        Set with a tooth number for every kind.
    name : str
        Name of the train; by default `spherical`.

    Returns
    -------
    dict
        Declaration of the train.

    Raises
    ------
    QuestionError
        If a tooth number is missing, or if the set has no gears.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.spherical import from_polyhedron
    >>> data = to_train(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    >>> geartrain.GearTrain.declare(data).solve()["3-1"]
    Fraction(-5, 3)
    """
    why = "a declaration needs the tooth number of every wheel"
    require_tooth_numbers(kinds_in_order(configuration), configuration.teeth, why, "give teeth={{{}: 20, ...}}")
    if not configuration.names:
        what, why = "a set without gears is not a train", "a declaration needs at least one gear"
        raise QuestionError(Problem(what, why, "drop fewer gears"))
    gears = list(zip(configuration.names, configuration.kinds, configuration.axes.tolist(), strict=True))
    return {
        "name": name or "spherical",
        "title": configuration.title or f"{len(gears)} gears on a sphere",
        "note": _NOTE,
        "frame": "frame",
        "links": {"frame": {}}
        | {gear: {"wheels": {gear: {"teeth": configuration.teeth[kind], "kind": "bevel"}}} for gear, kind, _ in gears},
        "axes": {
            gear: {"direction": _direction(axis), "position": ["0 mm", "0 mm", "0 mm"]} for gear, _, axis in gears
        },
        "revolutes": [{"pair": ["frame", gear], "axis": gear} for gear, _, _ in gears],
        "gears": [{"pair": [configuration.names[i], configuration.names[j]]} for i, j in configuration.meshes],
        "inputs": {configuration.names[0]: 1},
    }


def _direction(axis: list[float]) -> list[str]:
    """Return the coordinates of an axis as text: fractions if they are short, otherwise decimals with all digits of the
    floats.
    """
    # a decimal would be regarded as accurate only to its last digit
    exact = [Fraction(part) for part in axis]
    return [str(part) if part.denominator < _SHORT else f"{float(part):.17g}" for part in exact]
