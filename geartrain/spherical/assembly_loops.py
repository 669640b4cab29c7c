"""Loops of gears on a sphere, and what their teeth must satisfy to be put together: equation (3) of docs/closure.md.

Whole numbers of teeth inside each loop of a basis: the regions between the meshes, by Euler's formula, or fundamental
loops where arcs cross.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import lcm, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.graphs import tree_path
from geartrain.spherical.configuration import Configuration, kinds_in_order

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Mask = NDArray[np.bool_]


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
