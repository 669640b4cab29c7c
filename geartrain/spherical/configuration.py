"""A set of gears on a sphere: its axes, meshes and kinds of gear; as a train; and the loops that its teeth must close.

A train is declared with a link, a bevel wheel and an axis for each gear.

For the set to be assembled each loop of a basis must hold a whole number of teeth, equation (3) of docs/closure.md. The
basis is the regions between the meshes, by Euler's formula, or the fundamental loops where arcs cross.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import islice
from math import degrees, inf, lcm, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.graphs import tree_path
from geartrain.numerics.results import Shown
from geartrain.spherical.pitch_cones import angle_between, frames, mesh_angles, separations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Mask = NDArray[np.bool_]

_NOTE = (
    "All axes go through the centre of the sphere and point outwards; a speed is positive counterclockwise, "
    "seen from outside. Two wheels in mesh turn against each other."
)
_SHORT = 1 << 20  # denominators of coordinates such as 3/4, which floats hold as they are meant


@dataclass(frozen=True)
class Configuration(Shown):
    """Gears with axes through one point: where they point, who meshes with whom, and of which kinds they are.

    Axes point outwards; angles about them are counterclockwise seen from outside.

    Examples
    --------
    Three gears on the axes x, y and z; x meshes with the other two:

    >>> import numpy as np
    >>> found = Configuration(("x", "y", "z"), np.eye(3), ((0, 1), (0, 2)), ("x", "yz", "yz"), (4, 1, 1))
    >>> round(found.angle(0, 1) * 180 / np.pi, 12), round(abs(found.azimuth(0, 1) - found.azimuth(0, 2)) / np.pi, 12)
    (90.0, 0.5)
    """

    names: tuple[str, ...]
    """Of the gears."""
    axes: Floats
    """Unit vectors. Shape (gears, 3)."""
    meshes: tuple[tuple[int, int], ...]
    """Pairs of gears by index."""
    kinds: tuple[str, ...]
    """Of each gear: gears of one kind are alike under the symmetries of the set, and have one tooth number."""
    regular: tuple[int, ...]
    """Of each gear: p where its contacts stand at multiples of a p-th of a turn from each other, exactly; 0 where
    their angles are only known in floats."""
    teeth: Mapping[str, int] = field(default_factory=dict)
    """Tooth number of each kind, as far as they are chosen."""
    title: str = ""
    """For a reader."""

    def _summary(self) -> str:
        teeth = ", ".join(f"{kind} {count}" for kind, count in islice(self.teeth.items(), 4))
        title = self.title or f"{len(self.names)} gears, {len(self.meshes)} meshes"
        return title + (f", teeth {teeth}" if teeth else "")

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
            minimum = float(rows[kinds == b].min())
            if minimum < inf:
                found[a, b] = minimum
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
    """Kind of the first gear."""
    b: str
    """Kind of the second gear."""
    angle: float
    """Angle between the axes [rad]."""
    meshes: tuple[int, ...]
    """Indices of the meshes of this kind."""

    @property
    def kinds(self) -> tuple[str, str]:
        """The kinds of its gears."""
        return self.a, self.b

    def __str__(self) -> str:
        return f"{self.a}-{self.b} at {degrees(self.angle):.6f} deg"


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


# ------------------------------------------------------------------------------------------------------- assembly loops


def wrapped(turns: Floats) -> Floats:
    """`turns` less the nearest integer: in [-1/2, 1/2]."""
    return np.asarray(turns - np.round(turns), dtype=float)


def closes(teeth: Sequence[NDArray[np.int64]], rule: Sequence[Fraction | float], tolerance: float) -> Mask:
    """Whether sum z_k a_k is an integer, docs/closure.md (3): exactly where all a_k are Fractions, else to `tolerance`.

    z_k a_k is the signed number of teeth that gears of kind k have inside one loop of meshes; `tolerance` in pitches.
    """
    if all(isinstance(share, Fraction) for share in rule):
        whole = lcm(*(Fraction(share).denominator for share in rule))
        total = sum(z * int(Fraction(share) * whole) for z, share in zip(teeth, rule, strict=True))
        return np.asarray(total % whole == 0)
    return np.asarray(np.abs(residue(teeth, rule)) <= tolerance)


def residue(teeth: Sequence[Any], rule: Sequence[Fraction | float]) -> Floats:
    """How far a loop is from closing, in pitches: sum z_k a_k less the nearest integer."""
    return wrapped(np.asarray(sum(z * float(share) for z, share in zip(teeth, rule, strict=True)), dtype=float))


def divisors(rules: Sequence[Sequence[Fraction | float]], kinds: int) -> list[int]:
    """A number that divides the teeth of each kind wherever all exact rules hold.

    If sum z_k a_k is an integer, so is m a_i z_i with m the common denominator of the others.
    """
    found = [1] * kinds
    for rule in rules:
        if all(isinstance(share, Fraction) for share in rule):
            shares = [Fraction(share) for share in rule]
            for at, share in enumerate(shares):
                others = lcm(*(other.denominator for k, other in enumerate(shares) if k != at))
                found[at] = lcm(found[at], (others * share).denominator)
    return found


def loops(configuration: Configuration) -> list[list[int]]:
    """Loops of gears that span all loops: the regions between the meshes, or fundamental loops where arcs cross."""
    found = regions(configuration)
    gears, meshes = len(configuration.axes), configuration.meshes
    fundamental = list(fundamental_loops(gears, meshes))
    parts = gears - len(meshes) + len(fundamental)
    meshing = len({gear for mesh in meshes for gear in mesh})
    # Euler on the sphere; gears without a mesh bound no region
    return found if len(found) == len(meshes) - meshing + 2 * (parts - gears + meshing) else fundamental


def regions(configuration: Configuration) -> list[list[int]]:
    """Face tracing: the walks round the regions into which the arcs of the meshes cut the sphere, counterclockwise."""
    beside: dict[int, list[int]] = {}
    for i, j in configuration.meshes:
        beside.setdefault(i, []).append(j)
        beside.setdefault(j, []).append(i)
    onward: dict[tuple[int, int], tuple[int, int]] = {}
    for gear, others in beside.items():
        bearing = {other: configuration.azimuth(gear, other) for other in others}
        around = sorted(others, key=bearing.__getitem__)
        # arriving from one contact, leave by the one before it, counterclockwise
        onward.update({(other, gear): (gear, around[at - 1]) for at, other in enumerate(around)})
    found = []
    while onward:
        step, following = onward.popitem()
        walk = [step[0]]
        while following in onward:
            walk.append(following[0])
            following = onward.pop(following)
        found.append(walk)
    return found


def fundamental_loops(gears: int, meshes: Sequence[tuple[int, int]]) -> Iterator[list[int]]:
    """A loop of gears for every mesh outside a breadth-first forest: together a basis of all loops."""
    beside: list[list[int]] = [[] for _ in range(gears)]
    for i, j in meshes:
        beside[i].append(j)
        beside[j].append(i)
    parent: dict[int, int] = {}
    for root in range(gears):
        queue = deque([root] if root not in parent else [])
        parent.setdefault(root, -1)
        while queue:
            gear = queue.popleft()
            for other in beside[gear]:
                if other not in parent:
                    parent[other] = gear
                    queue.append(other)
    for i, j in meshes:
        if parent[i] != j and parent[j] != i:
            yield tree_path(i, j, lambda gear: parent[gear] if parent[gear] >= 0 else None)


def loop_rules(configuration: Configuration) -> tuple[tuple[Fraction | float, ...], ...]:
    """What must be an integer for the set to be assembled, as shares of the kinds' teeth; alike rules once.

    Round every loop of a basis, sum (-1)^k z_k alpha_k / 2 pi must be an integer, alpha_k being the angle at gear k
    from its previous to its next contact, counterclockwise. Shares are Fractions where the contacts of every gear
    of the loop are equally spaced. `QuestionError` names an odd loop: such a set cannot turn.
    """
    kinds = kinds_in_order(configuration)
    found: dict[tuple[Fraction | float, ...], None] = {}
    for loop in loops(configuration):
        if len(loop) % 2:
            names = " - ".join(configuration.names[gear] for gear in loop)
            raise QuestionError(
                Problem(f"loop {names} is odd", "gears of an odd loop hold each other fast", "leave one mesh out")
            )
        shares = _shares(configuration, loop, kinds)
        if any(shares):
            found[shares] = None
    return tuple(found)


def _shares(configuration: Configuration, loop: Sequence[int], kinds: Sequence[str]) -> tuple[Fraction | float, ...]:
    """One loop's rule, modulo integers and up to sign."""
    exact = all(configuration.regular[gear] for gear in loop)
    total: dict[str, Fraction | float] = dict.fromkeys(kinds, Fraction(0) if exact else 0.0)
    for at, gear in enumerate(loop):
        into, out = loop[at - 1], loop[(at + 1) % len(loop)]
        turn = (configuration.azimuth(gear, out) - configuration.azimuth(gear, into)) / (2 * pi) % 1
        spaced = configuration.regular[gear]
        share = Fraction(round(turn * spaced), spaced) if exact else round(turn * spaced) / spaced if spaced else turn
        total[configuration.kinds[gear]] += -share if at % 2 else share
    if exact:
        shares = [Fraction(share) % 1 for share in total.values()]
        return min(tuple(shares), tuple(-share % 1 for share in shares))
    # kinds of no part in a float loop stay 0; rounding to 1e-13 makes alike loops one rule
    around = [round(float(wrapped(np.asarray(share))), 13) for share in total.values()]
    return max(tuple(around), tuple(-share if share else 0.0 for share in around))
