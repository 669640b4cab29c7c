"""Set of gears on a sphere: axes, meshes and kinds of gear, its declaration as a train, and its assembly conditions.

A train is declared with a link, a bevel wheel and an axis for each gear.

The set can be assembled if each loop of a basis contains an integer number of teeth, equation (3) of docs/closure.md.
The basis consists of the regions between the meshes, by Euler's formula, or of the fundamental loops if arcs cross.
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
    "seen from outside. Two wheels in mesh turn in opposite senses."
)
_SHORT = 1 << 20  # largest denominator of coordinates such as 3/4 that floats represent exactly


@dataclass(frozen=True)
class Configuration(Shown):
    """Set of gears whose axes pass through one point, described by unit axes, meshing pairs, and the kind of each gear.

    Axes point outwards. Angles about them are counterclockwise as seen from outside.

    Examples
    --------
    Three gears on the axes x, y and z; x meshes with the other two:

    >>> import numpy as np
    >>> found = Configuration(("x", "y", "z"), np.eye(3), ((0, 1), (0, 2)), ("x", "yz", "yz"), (4, 1, 1))
    >>> round(found.angle(0, 1) * 180 / np.pi, 12), round(abs(found.azimuth(0, 1) - found.azimuth(0, 2)) / np.pi, 12)
    (90.0, 0.5)
    """

    names: tuple[str, ...]
    """Names of the gears."""
    axes: Floats
    """Unit vectors of the axes, directed outwards, shape (gears, 3)."""
    meshes: tuple[tuple[int, int], ...]
    """Meshing pairs of gears, by index."""
    kinds: tuple[str, ...]
    """Kind of each gear. Gears of one kind are equivalent under the symmetries of the set, and have the same tooth
    number.
    """
    regular: tuple[int, ...]
    """Integer p of each gear if its contacts are exactly at multiples of 1/p of a revolution; 0 if the angles are known
    only as floats.
    """
    teeth: Mapping[str, int] = field(default_factory=dict)
    """Mapping from kind to tooth number, for the kinds whose tooth number is chosen."""
    title: str = ""
    """Title of the set for display."""

    def _summary(self) -> str:
        teeth = ", ".join(f"{kind} {count}" for kind, count in islice(self.teeth.items(), 4))
        title = self.title or f"{len(self.names)} gears, {len(self.meshes)} meshes"
        return title + (f", teeth {teeth}" if teeth else "")

    def angle(self, i: int, j: int) -> float:
        """Return the angle between two axes [rad], 0 to pi.

        Parameters
        ----------
        i, j : int
            Indices of the gears.
        """
        return float(angle_between(self.axes[i], self.axes[j]))

    def azimuth(self, i: int, j: int) -> float:
        """Return the direction from one gear to another, as an angle about the axis of the first gear [rad].

        Parameters
        ----------
        i, j : int
            Indices of the gears. The direction about i is measured from the first vector of `frame(i)`,
            counterclockwise seen from outside.
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
    """Return the kinds of gear, each once, in the order of their first gears."""
    return tuple(dict.fromkeys(configuration.kinds))


def mesh_kinds(configuration: Configuration) -> tuple[MeshKind, ...]:
    """Return the kinds of mesh in the order of their gears' kinds; angles are treated as equal within 1e-9 rad."""
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
    """Return the angles between all axes [rad]; inf for meshing gears and for a gear with itself."""
    apart = separations(configuration.axes)
    np.fill_diagonal(apart, inf)
    if configuration.meshes:
        i, j = np.array(configuration.meshes).T
        apart[i, j] = apart[j, i] = inf
    return apart


@dataclass(frozen=True)
class MeshKind:
    """Kind of mesh: equivalent meshes, with the kinds of their two gears and the angle between the axes."""

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

    Links, wheels and axes have the names of the gears. All axes point outwards and the wheels are on the positive sides
    of their axes (`facing` 1, the default). Every mesh therefore reverses the sense of rotation: z_i w_i + z_j w_j = 0
    (docs/sphere.md, section 1). The first gear is the input, at speed 1. The directions are floats with all digits.

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
        If a tooth number is missing, or the set has no gears.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.spherical import from_polyhedron
    >>> data = to_train(from_polyhedron("icosidodecahedron", teeth={"5": 20, "3": 12}))
    >>> geartrain.GearTrain.declare(data).solve()["3-1"]
    Fraction(-5, 3)
    """
    missing = [kind for kind in kinds_in_order(configuration) if kind not in configuration.teeth]
    if missing:
        what = f"no tooth number is given for {', '.join(missing)}"
        fix = f"give teeth={{{missing[0]!r}: 20, ...}}"
        raise QuestionError(Problem(what, "a declaration needs the tooth number of every wheel", fix))
    if not configuration.names:
        what, why = "a set without gears is not a train", "a declaration needs at least one gear"
        raise QuestionError(Problem(what, why, "drop fewer gears"))
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
    """Return floats with all digits, or as fractions if these are short, because a decimal is taken as accurate only to
    its last digit.
    """
    exact = [Fraction(part) for part in axis]
    return [str(part) if part.denominator < _SHORT else f"{float(part):.17g}" for part in exact]


def _link(gear: str, teeth: int) -> dict[str, Any]:
    return {"wheels": {gear: {"teeth": teeth, "kind": "bevel"}}}


# ------------------------------------------------------------------------------------------------------- assembly loops


def wrapped(turns: Floats) -> Floats:
    """Return `turns` minus the nearest integer, -1/2 to 1/2."""
    return np.asarray(turns - np.round(turns), dtype=float)


def closes(teeth: Sequence[NDArray[np.int64]], rule: Sequence[Fraction | float], tolerance: float) -> Mask:
    """Return a mask of the tooth numbers for which sum z_k a_k is an integer, docs/closure.md (3).

    The test is exact if all a_k are Fractions, otherwise with `tolerance` [pitch]. z_k a_k is the signed number of
    teeth that gears of kind k have inside one loop of meshes.
    """
    if all(isinstance(share, Fraction) for share in rule):
        # integer arithmetic over the common denominator
        whole = lcm(*(Fraction(share).denominator for share in rule))
        total = sum(z * int(Fraction(share) * whole) for z, share in zip(teeth, rule, strict=True))
        return np.asarray(total % whole == 0)
    return np.asarray(np.abs(residue(teeth, rule)) <= tolerance)


def residue(teeth: Sequence[Any], rule: Sequence[Fraction | float]) -> Floats:
    """Return the closing error of a loop [pitch]: sum z_k a_k minus the nearest integer."""
    return wrapped(np.asarray(sum(z * float(share) for z, share in zip(teeth, rule, strict=True)), dtype=float))


def divisors(rules: Sequence[Sequence[Fraction | float]], kinds: int) -> list[int]:
    """Return for each kind an integer that divides its tooth number if all exact rules are satisfied.

    If sum z_k a_k is an integer, m a_i z_i is an integer too, where m is the common denominator of the other a_k.
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
    """Return a basis of all loops of gears: the regions between the meshes, or fundamental loops if mesh arcs cross."""
    found = regions(configuration)
    gears, meshes = len(configuration.axes), configuration.meshes
    fundamental = list(fundamental_loops(gears, meshes))
    # connected components by the cycle rank
    parts = gears - len(meshes) + len(fundamental)
    meshing = len({gear for mesh in meshes for gear in mesh})
    # Euler on the sphere; gears without a mesh bound no region
    return found if len(found) == len(meshes) - meshing + 2 * (parts - gears + meshing) else fundamental


def regions(configuration: Configuration) -> list[list[int]]:
    """Return the boundary walks of the regions between the arcs of the meshes, counterclockwise, by face tracing."""
    beside: dict[int, list[int]] = {}
    for i, j in configuration.meshes:
        # adjacency of the meshes
        beside.setdefault(i, []).append(j)
        beside.setdefault(j, []).append(i)
    onward: dict[tuple[int, int], tuple[int, int]] = {}
    for gear, others in beside.items():
        bearing = {other: configuration.azimuth(gear, other) for other in others}
        around = sorted(others, key=bearing.__getitem__)
        # a walk that arrives from one contact leaves by the one before it, counterclockwise
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
    """Yield one loop of gears for every mesh outside a breadth-first spanning forest: a basis of all loops."""
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
    """Return the assembly conditions as factors a_k of the kinds' tooth numbers, each distinct condition once.

    Around every loop of a basis, sum (-1)^k z_k alpha_k / 2 pi must be an integer, where alpha_k is the angle at gear k
    from its previous to its next contact, counterclockwise. The factors are Fractions if the contacts of every gear in
    the loop are equally spaced. Raises `QuestionError` if a loop is odd, because such a set cannot turn.
    """
    kinds = kinds_in_order(configuration)
    found: dict[tuple[Fraction | float, ...], None] = {}
    for loop in loops(configuration):
        if len(loop) % 2:
            names = " - ".join(configuration.names[gear] for gear in loop)
            raise QuestionError(
                Problem(
                    f"loop {names} has an odd number of gears",
                    "meshing gears turn in opposite senses, so an odd loop locks",
                    "remove one mesh of the loop",
                )
            )
        shares = _shares(configuration, loop, kinds)
        if any(shares):
            found[shares] = None
    return tuple(found)


def _shares(configuration: Configuration, loop: Sequence[int], kinds: Sequence[str]) -> tuple[Fraction | float, ...]:
    """Return the factors of the kinds' tooth numbers in the condition of one loop, modulo integers and up to sign."""
    # one irregular gear makes the whole condition inexact
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
        # a loop traversed backwards gives the same condition
        return min(tuple(shares), tuple(-share % 1 for share in shares))
    # kinds outside a float loop stay 0; rounding to 1e-13 merges equal loops into one rule
    around = [round(float(wrapped(np.asarray(share))), 13) for share in total.values()]
    return max(tuple(around), tuple(-share if share else 0.0 for share in around))
