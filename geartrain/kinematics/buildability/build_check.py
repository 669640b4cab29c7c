"""Rules of buildability whose implementations are short (docs/buildability.md).

The rules detect wheels without a gear pair, incompatible kinds of wheels, three axes whose distances violate the
triangle inequality, brakes and clutches between links on different axes, wheels with two coaxial mates at different
centre distances, and skew axes at a wrong distance. The other modules of this folder contain the longer rules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import cos
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.equal_planets import check_planets
from geartrain.kinematics.buildability.pitch_distances import (
    SLACK,
    PairOutline,
    PitchDistances,
    PitchPair,
    check_rings,
    pitch_pairs,
)
from geartrain.kinematics.circuits import Axes, find_circuits, find_tree, rigid_across_axes, rigid_place
from geartrain.kinematics.circuits.fundamental import bevels_on_one_side, passing_distance
from geartrain.kinematics.planet_copies import has_copies, with_copies

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.train import Train


# ----------------------------------------------------------------------------------------------------------- axis kinds


_MATES = ({"spur"}, {"bevel"}, {"contrate", "spur"}, {"worm", "spur"})
_NEEDS = {
    "bevel": "pitch cones roll on each other only if their axes intersect",
    "contrate": "a contrate wheel has teeth parallel to its axis, and its mate is on a crossing axis",
    "worm": "the axes of a worm and its wheel pass each other at a distance",
    "helical": "crossed helical wheels need axes that pass each other at a distance",
}


def check_kinds(
    train: Train, tree: Tree, circuits: Sequence[Circuit], pairs: Sequence[PitchPair]
) -> Iterator[BuildFinding]:
    """Yield findings of rules K1, K2 and K5: the kind of a wheel does not suit its axis or its mate, or two bevel
    wheels mesh with a third bevel wheel from the same side.
    """
    axes = Axes(train, tree)
    for one, other, shared in bevels_on_one_side(train, circuits, axes.is_rotation):
        problem = Problem(
            f"bevel wheels '{one}' and '{other}' on one axis mesh with '{shared}' from the same side",
            "their pitch cones have the same apex and axis, so the wheels would overlap",
            f"declare `facing: -1` for the wheel on the negative side of the axis, such as '{other}'",
            train.place("links", train.wheels[other][0], "wheels", other),
        )
        yield BuildFinding("K5", "error", problem)
    for pair in pairs:
        shape = next((kind for kind in pair.kinds if kind != "spur"), "helical" if pair.is_crossed else "spur")
        if set(pair.kinds) not in _MATES:
            first, second = (f"{kind} wheel '{wheel}'" for kind, wheel in zip(pair.kinds, pair.wheels, strict=True))
            problem = Problem(
                f"pair '{pair.name}': {first} meshes with {second}",
                "bevel wheels mesh with bevel wheels; contrate wheels and worms mesh with spur wheels",
                "declare `kind: bevel` for both wheels, or `kind: contrate` or `kind: worm` for only one of them",
                pair.place,
            )
            yield BuildFinding("K2", "error", problem)
        elif pair.parallel and shape != "spur":
            # undeclared directions may only be missing, so the finding is then a note
            declared = all(label in train.axes for label in pair.axes)
            yield BuildFinding("K1", "error" if declared else "note", _parallel_axes_problem(pair, shape, declared))
        elif not pair.parallel:
            crossing = _crossing_axes_problem(pair, shape, passing_distance(axes, pair.axes))
            if crossing is not None:
                yield BuildFinding("K1", "error", crossing)


def _parallel_axes_problem(pair: PitchPair, shape: str, declared: bool) -> Problem:
    (first, second), why = pair.axes, _NEEDS[shape]
    if declared:
        what = f"the axes '{first}' and '{second}' of the {shape} pair '{pair.name}' are parallel"
        fix = f"correct the directions under `axes`, or remove `kind: {shape}`"
    else:
        what = f"no directions are declared for the axes of the {shape} pair '{pair.name}'"
        why += ", and axes without a direction count as parallel, so its wheels are drawn as spur wheels"
        fix = f"declare the directions of '{first}' and '{second}' under `axes`, or remove `kind: {shape}`"
    return Problem(what, why, fix, pair.place)


def _crossing_axes_problem(pair: PitchPair, shape: str, offset: float | None) -> Problem | None:
    """Return a problem if a pair of the kind `shape` cannot mesh on axes at a distance `offset` [m]; None if it can."""
    first, second = pair.axes
    if shape == "spur":
        return Problem(
            f"pair '{pair.name}': the axes '{first}' and '{second}' of two spur wheels are not parallel",
            "spur teeth touch along their width only if the axes are parallel",
            "make the axes parallel, or declare `kind: bevel` for both wheels, `contrate` or `worm` for one, "
            "or a `helix_angle`",
            pair.place,
        )
    # worms and crossed helical wheels need skew axes, bevel and crown wheels intersecting axes
    if offset is None or (shape in ("worm", "helical")) == (offset > 0):
        return None
    far, remedy = "intersect", "both wheels `kind: bevel`"
    if offset:
        far, remedy = f"pass each other at a distance of {offset * 1000:.6g} mm", "one wheel `kind: worm`"
    what = f"{shape} pair '{pair.name}': the axes '{first}' and '{second}' {far}"
    return Problem(what, _NEEDS[shape], f"move one of the axes, or declare {remedy}", pair.place)


# ------------------------------------------------------------------------------------------------------- axis triangles


_EQUAL = Fraction(1, 10**6)  # tolerance relative to the longest side, because three axes may be coplanar


def check_triangles(sizes: PitchDistances) -> Iterator[BuildFinding]:
    """Yield findings of rule P3: the distances of three axes violate the triangle inequality."""
    sides = {node[1:]: pairs[0] for node, pairs in sizes.between.items()}
    near: dict[str, dict[str, PitchPair]] = {}
    for (first, second), pair in sides.items():
        near.setdefault(first, {})[second] = pair
        near.setdefault(second, {})[first] = pair
    for (first, second), pair in sides.items():
        fewer, more = sorted((near[first], near[second]), key=len)
        for third in fewer:
            # each triangle once: its third label is the first in order
            if third in more and third < first:
                yield from _triangle(sizes, (third, first, second), (pair, near[third][first], near[third][second]))


def _triangle(
    sizes: PitchDistances, axes: tuple[str, str, str], pairs: tuple[PitchPair, PitchPair, PitchPair]
) -> Iterator[BuildFinding]:
    found = [sizes.distance(pair.axis_pair) for pair in pairs]
    # multiples of unrelated lengths cannot be compared
    if len({root for root, _ in found}) > 1:
        return
    order = sorted(range(3), key=lambda at: found[at][1])
    short, middle, long = (found[at][1] for at in order)
    lack = long - short - middle
    if lack <= _EQUAL * long:
        return
    # permitted deviation of each pair from its design distance, in the same unit of length
    rooms = [
        (pair.bounds[1] - pair.distance) / pair.distance * side for pair, (_, side) in zip(pairs, found, strict=True)
    ]
    room = sum(map(abs, rooms), Fraction(0))
    last = pairs[order[2]]
    measure = sizes.measure(last)
    sums = " + ".join(measure(found[at][1]) for at in order[:2])
    names = ", ".join(f"'{axis}'" for axis in axes)
    problem = Problem(
        f"axes {names} cannot be placed: {sums} is less than {measure(long)}",
        f"pairs {', '.join(repr(pairs[at].name) for at in order)} give their distances, which violate the triangle "
        "inequality",
        "change a tooth count or a module, or remove one of the pairs",
        last.place,
    )
    yield BuildFinding("P3", "note" if lack <= room else "error", problem)


# ---------------------------------------------------------------------------------------------------------- clutch axes


def check_clutches(train: Train, tree: Tree) -> Iterator[BuildFinding]:
    """Yield findings of rules G1 and G2: a clutch between links on different axes, a brake across several axes."""
    reported = set()
    for case in train.cases:
        for rigid in rigid_across_axes(train, tree, case):
            if rigid.links not in reported:
                reported.add(rigid.links)
                axes = " and ".join(f"'{label}'" for label in rigid.labels)
                joints = ", ".join(f"{start} - {end}" for start, end, _ in rigid.joints)
                if len(rigid.links) == 2:
                    rule, device = "G1", "a clutch can only connect coaxial links"
                    fix = "lock coaxial links, or connect the two links by a pair of equal wheels"
                else:
                    rule, device = "G2", "a brake fixes a link that turns on the frame"
                    between = [repr(inner) for _, inner, _ in rigid.joints[:-1] if inner != train.frame]
                    fix = f"fix {' or '.join(between)} as well, or instead" if between else "fix another link"
                what = f"{case.says(*rigid.links)} across the axes {axes}"
                why = f"{device}, and this one would have to block the joints {joints}"
                place = train.place(*rigid_place(train, case, rigid.links))
                yield BuildFinding(rule, "error", Problem(what, why, fix, place))


# ---------------------------------------------------------------------------------------------------------- idle wheels


def check_mates(train: Train) -> Iterator[BuildFinding]:
    """Yield findings of rule W1: wheels without a gear pair.

    A wheel is exempt if it is a pulley of a belt, if its link is in another coupling, if it is the escape wheel, or if
    it has a declared note.
    """
    meshing = {wheel for gear in train.gears for wheel in gear.pair}
    named = {(kind, name) for coupling in train.couplings for kind, name, _ in coupling.references()}
    escapement = train.escapement
    for name, (link, wheel) in train.wheels.items():
        if name in meshing or wheel.note or not named.isdisjoint({("wheel", name), ("link", link)}):
            continue
        if escapement is not None and escapement.has_wheel(link, wheel.count):
            continue
        problem = Problem(
            f"wheel '{name}' is not in mesh",
            "no pair in `gears` contains it",
            "add its gear pair, give its purpose in its `note`, or remove it",
            train.place("links", link, "wheels", name),
        )
        yield BuildFinding("W1", "note", problem)


# -------------------------------------------------------------------------------------------------------- shared wheels


Outlines = Callable[[], Mapping[str, PairOutline]]
"""Function that returns the outlines of the pairs with declared teeth, by name. It is called only if equal planets, or
two pairs that share a wheel, are to be compared.
"""
_SAME = 1e-6  # relative tolerance of distances: declared lengths, radii and positions have about six digits


def check_shared_wheels(pairs: Sequence[PitchPair], outlines: Outlines) -> Iterator[BuildFinding]:
    """Yield findings of rule P2 for non-conjugate teeth, such as triangular teeth: a wheel with two mates must have the
    same pitch radius in both pairs.
    """
    free = [
        pair for pair in pairs if pair.parallel and pair.form and pair.form.any_distance and not pair.form.conjugate
    ]
    for one, other in combinations(free, 2):
        if one.axis_pair != other.axis_pair or not set(one.wheels) & set(other.wheels):
            continue
        # outlines build teeth, so they are requested only for pairs that share a wheel
        found = outlines()
        if one.name not in found or other.name not in found:
            continue
        first, second = found[one.name].distance, found[other.name].distance
        if abs(first - second) > _SAME * max(first, second):
            (wheel,) = set(one.wheels) & set(other.wheels)
            problem = Problem(
                f"pairs '{one.name}' and '{other.name}' need different centre distances: {first:.6g} and {second:.6g} "
                "modules",
                f"they connect the same two axes, and the shared wheel '{wheel}' has the same teeth in both",
                "give both pairs the same `centre_distance`, and `radii: [first, second]` as lengths, with the same "
                f"radius of '{wheel}'",
                other.place,
            )
            yield BuildFinding("P2", "error", problem)


# ------------------------------------------------------------------------------------------------------- skew distances


def check_skew(train: Train, tree: Tree, pairs: Sequence[PitchPair], sizes: PitchDistances) -> Iterator[BuildFinding]:
    """Yield findings of rule K4: the distance of two skew axes differs from the sum of the pitch radii m z/(2 cos(b)),
    where m is the normal module, z the tooth count and b the helix angle.
    """
    axes = Axes(train, tree)
    for pair in pairs:
        if pair.parallel or any(wheel.helix_angle is None for wheel in pair.declared):
            continue
        module, offset = sizes.module(pair.wheels[0]), passing_distance(axes, pair.axes)
        # intersecting axes are reported by rule K1
        if module is None or not offset:
            continue
        radii = [float(module) * (wheel.count or 0) / 2 / cos(wheel.helix) for wheel in pair.declared]
        off = 1000 * offset - sum(radii)
        if abs(off) <= _SAME * sum(radii):
            continue
        first, second = pair.axes
        sides = " and ".join(f"'{wheel}' {radius:.6g} mm" for wheel, radius in zip(pair.wheels, radii, strict=True))
        problem = Problem(
            f"pair '{pair.name}': axes '{first}' and '{second}' are {1000 * offset:.6g} mm apart, but the pair needs "
            f"{sum(radii):.6g} mm",
            f"the distance between the axes must equal the sum of the pitch radii, {sides}",
            f"move an axis by {abs(off):.6g} mm, or change a module, a tooth count or the helix angles",
            pair.place,
        )
        yield BuildFinding("K4", "note" if abs(off) <= SLACK * module else "error", problem)


# ---------------------------------------------------------------------------------------------------------- build check


def check_build(
    train: Train, tree: Tree, circuits: Sequence[Circuit], outlines: Outlines = dict
) -> Iterator[BuildFinding]:
    """Yield the findings of all rules that require only the declaration and tooth outlines (docs/buildability.md)."""
    yield from check_mates(train)  # first, because a wheel that a child adds without a pair changes no speed
    pairs = pitch_pairs(train, tree, circuits)
    yield from check_kinds(train, tree, circuits, pairs)
    yield from check_rings(pairs)
    sizes = PitchDistances(train, tree, circuits, pairs)
    yield from sizes.findings
    yield from check_skew(train, tree, pairs, sizes)
    yield from check_triangles(sizes)
    yield from check_shared_wheels(pairs, outlines)
    if any(circuit.kind == "belt" for circuit in circuits):
        from geartrain.kinematics.buildability.belt_drives import check_belts

        yield from check_belts(train, tree, circuits)
    if has_copies(train):  # planets declared by `copies` are expanded to separate links
        every = with_copies(train, tree)
        branches = find_tree(every)
        chords = find_circuits(every, branches)
        sizes = PitchDistances(every, branches, chords, pitch_pairs(every, branches, chords))
        yield from check_planets(every, branches, chords, sizes, outlines)
    else:
        yield from check_planets(train, tree, circuits, sizes, outlines)
    yield from check_clutches(train, tree)
