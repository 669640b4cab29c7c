"""Enumeration of all reconstructions by growth of concrete trees that are kept in a set: slow, but simple.

This program is independent: from the package it takes only the classes that declare a problem. A tree grows by one mesh
at a time, in every way that the rules permit; an added wheel first has the count 0. Equal trees coincide in the set.
Trees that satisfy the rules get all possible tooth counts and then all possible dials, and equal trees coincide again.

A wheel is `(name, teeth)`; an added wheel has the name "". A node is `(name, driven, dials, drives)`: the name is ""
for an added arbor, driven is `()` at the input, and drives is a sorted tuple of `(wheel, sorted tuple of nodes)`. The
entry `DRIVEN` among the driving wheels denotes the driven wheel itself, where idlers are permitted.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Collection, Iterator
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from geartrain.report import Section
from geartrain.search.reconstruct import (
    Additions,
    Arbor,
    PlacedWheel,
    ReconstructionAnswer,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
    SurvivingWheel,
)
from geartrain.search.reconstruct.reconstruction_report import describe_reconstruction
from geartrain.train import Train, declare

Wheel = tuple[str, int]
Node = tuple  # (name, driven, dials, drives)

ADDED = ""
UNKNOWN = (ADDED, 0)
DRIVEN = ("=", 0)


class Counts(NamedTuple):
    """Numbers of solutions with a given number of added wheels."""

    added: int
    solutions: int
    multisets: int
    classes: int


class Found(NamedTuple):
    """All solutions with a given number of added wheels, and their numbers."""

    counts: Counts
    solutions: frozenset[Node]


def explanations(problem: ReconstructionProblem) -> tuple[Found, ...]:
    """Return all solutions with 0, 1, ... added wheels."""
    return tuple(
        Found(
            Counts(added, len(found), len({bag(tree) for tree in found}), len({ratio_class(tree) for tree in found})),
            found,
        )
        for added, found in enumerate(_by_added(problem))
    )


def _by_added(problem: ReconstructionProblem) -> list[frozenset[Node]]:
    found: list[set[Node]] = [set() for _ in range(problem.additions.wheels + 1)]
    counts = range(problem.additions.minimum, problem.additions.maximum + 1)
    trees: set[Node] = {(problem.input.name, (), (), ())}
    while trees:
        for tree in trees:
            if _keeps_rules(tree, problem):
                for teeth in itertools.product(counts, repeat=added_wheels(tree)):
                    filled = _filled(tree, iter(teeth))
                    if _turns_in_rings(filled, problem):
                        found[len(teeth)].update(_with_dials(filled, problem))
        grown = {more for tree in trees for more in _grown(tree, problem)}
        # a leaf needs a dial, so leaves are never more than dials
        trees = {tree for tree in grown if len(_ends(tree)) <= len(problem.dials)}
    return [frozenset(solutions) for solutions in found]


# growth


def _grown(tree: Node, problem: ReconstructionProblem) -> Iterator[Node]:
    """Yield the tree with one more mesh, in every way."""
    rules = problem.additions
    here = {node[0] for node in nodes(tree)}
    survivors = {arbor.name: arbor for arbor in (problem.input, *problem.arbors)}
    children: list[Node] = [(ADDED, UNKNOWN, (), ())]
    for arbor in problem.arbors:
        if arbor.name not in here:
            children += [(arbor.name, wheel, (), ()) for wheel in _readings(arbor)]
            if rules.on == "any" and not arbor.wheels:
                children.append((arbor.name, UNKNOWN, (), ()))
    for grown in _with_child(tree, children, survivors, problem):
        arbors = sum(arbor[0] == ADDED for arbor in nodes(grown))
        if added_wheels(grown) <= rules.wheels and (rules.arbors is None or arbors <= rules.arbors):
            yield grown


def _with_child(
    node: Node, children: list[Node], survivors: dict[str, SurvivingArbor], problem: ReconstructionProblem
) -> Iterator[Node]:
    """Yield the arbor and its subtree with one more mesh."""
    name, driven, dials, drives = node
    for at, (wheel, driven_arbors) in enumerate(drives):
        rest = drives[:at] + drives[at + 1 :]
        for child in children:
            yield name, driven, dials, _sorted(*rest, (wheel, _sorted(*driven_arbors, child)))
        for nth, arbor in enumerate(driven_arbors):
            others = driven_arbors[:nth] + driven_arbors[nth + 1 :]
            for grown in _with_child(arbor, children, survivors, problem):
                yield name, driven, dials, _sorted(*rest, (wheel, _sorted(*others, grown)))
    for wheel in _new_drivers(node, survivors, problem):
        for child in children:
            yield name, driven, dials, _sorted(*drives, (wheel, (child,)))


def _new_drivers(node: Node, survivors: dict[str, SurvivingArbor], problem: ReconstructionProblem) -> Iterator[Wheel]:
    """Return the wheels of an arbor that drive nothing yet, and the wheels that may be added to it."""
    name, driven, _, drives = node
    driving = {wheel[0] for wheel, _ in drives}
    if problem.idlers and driven and DRIVEN[0] not in driving:
        yield DRIVEN
    if name != ADDED:
        taken = {*driving, *driven[:1]}
        yield from (wheel for wheel in _readings(survivors[name]) if wheel[0] not in taken)
    if name == ADDED or problem.additions.on == "any":
        yield UNKNOWN


def _readings(arbor: SurvivingArbor) -> list[Wheel]:
    return [(wheel.name, teeth) for wheel in arbor.wheels for teeth, _ in wheel.counts]


def _filled(node: Node, teeth: Iterator[int]) -> Node:
    """Yield the arbor and its subtree with tooth counts for the added wheels."""
    name, driven, dials, drives = node
    wheel = (ADDED, next(teeth)) if driven == UNKNOWN else driven
    filled = []
    for driving, children in drives:
        driving = (ADDED, next(teeth)) if driving == UNKNOWN else driving
        filled.append((driving, _sorted(*(_filled(child, teeth) for child in children))))
    return name, wheel, dials, _sorted(*filled)


def _sorted(*parts: tuple) -> tuple:
    return tuple(sorted(parts))


# what a tree holds


def nodes(node: Node) -> list[Node]:
    """Yield the arbor and all arbors below it."""
    return [node, *(below for _, children in node[3] for child in children for below in nodes(child))]


def added_wheels(tree: Node) -> int:
    """Return the number of added wheels."""
    return sum((node[1][:1] == (ADDED,)) + sum(wheel[0] == ADDED for wheel, _ in node[3]) for node in nodes(tree))


def meshes(node: Node) -> list[tuple[Wheel, Wheel]]:
    """Yield driving wheels with the wheels that they drive."""
    found = []
    for wheel, children in node[3]:
        for child in children:
            found.append((node[1] if wheel == DRIVEN else wheel, child[1]))
            found += meshes(child)
    return found


def speeds(node: Node, speed: Fraction, rings: Collection[str] = ()) -> list[Fraction]:
    """Return the speeds of `nodes`, in their order; a mesh with a ring preserves the sense."""
    found = [speed]
    for wheel, children in node[3]:
        name, teeth = node[1] if wheel == DRIVEN else wheel
        for child in children:
            own, count = child[1]
            inside = name in rings or own in rings
            found += speeds(child, speed * teeth / (count if inside else -count), rings)
    return found


def rings_of(problem: ReconstructionProblem) -> set[str]:
    """Return the names of surviving rings."""
    return {wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels if wheel.internal}


def _turns_in_rings(tree: Node, problem: ReconstructionProblem) -> bool:
    """Return True if each ring meshes only with wheels that have fewer teeth."""
    rings = rings_of(problem)
    for pair in meshes(tree):
        inside = [teeth for name, teeth in pair if name not in rings]
        around = [teeth for name, teeth in pair if name in rings]
        if len(around) == 2 or (around and inside[0] >= around[0]):
            return False
    return True


def _keeps_rules(tree: Node, problem: ReconstructionProblem) -> bool:
    joined = {frozenset((node[0], child[0])) for node in nodes(tree) for _, below in node[3] for child in below}
    if joined & problem.coaxial:
        return False
    pairs = meshes(tree)
    seen = {frozenset((driving[0], driven[0])) for driving, driven in pairs}
    if not problem.meshes <= seen or problem.apart & seen:
        return False
    if problem.use == "wheels":
        meshing = {wheel[0] for pair in pairs for wheel in pair}
        return all(wheel.name in meshing for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels)
    if problem.use == "arbors":
        return {arbor.name for arbor in problem.arbors} <= {node[0] for node in nodes(tree)}
    return True


# dials


def _with_dials(tree: Node, problem: ReconstructionProblem) -> Iterator[Node]:
    """Yield the tree with dials in every way; every leaf has a dial."""
    arbors = nodes(tree)
    turning = speeds(tree, problem.input_speed, rings_of(problem))
    fitting = [
        [at for at, node in enumerate(arbors) if _at_place(node, dial) and _fits(turning[at], dial)]
        for dial in problem.dials
    ]
    for places in itertools.product(*fitting):
        shown: dict[int, list[str]] = {}
        for dial, at in zip(problem.dials, places, strict=True):
            shown.setdefault(at, []).append(dial.name)
        found = _dialled(tree, shown, itertools.count())
        if all(node[2] for node in _ends(found)):
            yield found


def _ends(tree: Node) -> list[Node]:
    return [node for node in nodes(tree) if not node[3]]


def _at_place(node: Node, dial: SearchedDial) -> bool:
    return dial.place is None or node[0] == (ADDED if dial.place == "new" else dial.place)


def _fits(speed: Fraction, dial: SearchedDial) -> bool:
    return dial.minimum <= (speed if dial.signed else abs(speed)) <= dial.maximum


def _dialled(node: Node, shown: dict[int, list[str]], numbers: Iterator[int]) -> Node:
    name, driven, _, drives = node
    dials = tuple(sorted(shown.get(next(numbers), [])))
    below = [(wheel, [_dialled(child, shown, numbers) for child in children]) for wheel, children in drives]
    return name, driven, dials, _sorted(*((wheel, _sorted(*children)) for wheel, children in below))


# when two are the same


def _paths(node: Node, before: tuple = ()) -> Iterator[tuple[str, tuple]]:
    """Return each dial with the arbors on its path: `(arbor, driven wheel, driving wheel)`, the last one with `()`."""
    for dial in node[2]:
        yield dial, (*before, (node[0], node[1], ()))
    for wheel, children in node[3]:
        for child in children:
            yield from _paths(child, (*before, (node[0], node[1], node[1] if wheel == DRIVEN else wheel)))


def bag(tree: Node) -> tuple:
    """Return, for every dial, the multiset of oriented arbors on its path."""
    return _sorted(*((dial, _sorted(*path)) for dial, path in _paths(tree)))


def ratio_class(tree: Node) -> tuple:
    """Return, for every dial, the multisets of driving and of driven wheels on its path."""
    return _sorted(
        *(
            (dial, _sorted(*(step[2] for step in path[:-1])), _sorted(*(step[1] for step in path[1:])))
            for dial, path in _paths(tree)
        )
    )


# between these trees and those of the package


def concrete(arbor: Arbor) -> Node:
    """Convert a candidate of the package to a tree of this module."""
    driven = _wheel(arbor.driven) if arbor.driven else ()
    drives = [(_wheel(wheel), _sorted(*map(concrete, children))) for wheel, children in arbor.drives]
    if arbor.passes:
        drives.append((DRIVEN, _sorted(*map(concrete, arbor.passes))))
    return arbor.name or ADDED, driven, _sorted(*arbor.dials), _sorted(*drives)


def _wheel(wheel: PlacedWheel) -> Wheel:
    return wheel.name or ADDED, wheel.teeth


def package_arbor(tree: Node) -> Arbor:
    """Convert a concrete tree to a candidate of the package."""
    name, driven, dials, drives = tree
    placed = PlacedWheel(driven[0] or None, driven[1]) if driven else None
    children = [(key, tuple(map(package_arbor, below))) for key, below in drives]
    passes = next((below for key, below in children if key[0] == "="), ())
    others = tuple((PlacedWheel(key[0] or None, key[1]), below) for key, below in children if key[0] != "=")
    return Arbor(name or None, placed, dials, others, passes)


def plain_prior(tree: Node, problem: ReconstructionProblem) -> Fraction:
    """Return the prior weight of a concrete tree, the product of the weights of its parts."""
    factors, limits = problem.factors, problem.additions
    weights = {one.name: dict(one.counts) for arbor in (problem.input, *problem.arbors) for one in arbor.wheels}
    weight, unused = Fraction(1), set(weights)
    for name, driven, _, drives in nodes(tree):
        weight /= factors.arbor if name == "" else 1
        for wheel, teeth in [one for one in (driven, *(wheel for wheel, _ in drives)) if one]:
            if wheel in weights:
                weight *= weights[wheel][teeth]
                unused.discard(wheel)
    weight /= (factors.wheel * (limits.maximum - limits.minimum + 1)) ** added_wheels(tree)
    return weight / factors.unused ** len(unused)


# questions


def sure_arbor(name: str, **teeth: int) -> SurvivingArbor:
    """Return a surviving arbor whose counts are certain."""
    wheels = (SurvivingWheel(wheel, ((count, Fraction(1)),)) for wheel, count in teeth.items())
    return SurvivingArbor(name, tuple(wheels))


def exact_dial(
    name: str, speed: Fraction | int | str, *, signed: bool = True, place: str | None = None
) -> SearchedDial:
    """Return a dial with a single speed; only the magnitude is kept if the sense is not known."""
    wanted = Fraction(speed) if signed else abs(Fraction(speed))
    return SearchedDial(name, wanted, wanted, signed, place)


def random_problem(seed: int, *, wheels: int = 2, idlers: bool = False) -> ReconstructionProblem:
    """Return a small problem that usually has a solution: a random train from which some wheels are removed.

    Parameters
    ----------
    seed : int
    wheels : int, default 2
        Maximum number of added wheels.
    idlers : bool, default False
        Whether a driven wheel may drive, in half of the problems.
    """
    chance = random.Random(seed)
    minimum = chance.randint(6, 12)
    maximum = minimum + chance.randint(1, 4)
    lost = wheels
    trees = [_Grown(0, None, None)]
    for number in range(1, chance.randint(2, 4)):
        parent = chance.choice(trees)
        wheel = parent.driver(chance, minimum, maximum)
        trees.append(_Grown(number, (parent, wheel), chance.randint(minimum, maximum)))
    speeds_of = {arbor.number: arbor.speed() for arbor in trees}
    for arbor in chance.sample(trees[1:], len(trees) - 1):
        if len(arbor.counts()) <= lost and chance.random() < 0.7:
            arbor.survives = False
            lost -= len(arbor.counts())
    for arbor in trees:
        if lost and arbor.survives and len(arbor.drivers) > 1 and chance.random() < 0.3:
            arbor.hidden = len(arbor.drivers) - 1
            lost -= 1
    leaves = [arbor for arbor in trees if not arbor.drivers]
    shown = leaves + [arbor for arbor in trees[1:] if arbor.drivers and chance.random() < 0.2]
    survivors = tuple(_survivor(arbor, chance, minimum, maximum) for arbor in trees if arbor.survives)
    dials = tuple(_random_dial(chance, arbor, speeds_of[arbor.number]) for arbor in shown[:3])
    pairs = [
        frozenset((first.name, second.name))
        for one, other in itertools.combinations(survivors, 2)
        for first in one.wheels
        for second in other.wheels
    ]
    chance.shuffle(pairs)
    return ReconstructionProblem(
        input=survivors[0],
        arbors=survivors[1:],
        dials=dials,
        additions=Additions(
            wheels,
            minimum,
            maximum,
            arbors=chance.choice((None, None, None, 1)),
            on=chance.choice(("any", "any", "new")),
        ),
        input_speed=Fraction(chance.choice((1, 1, 1, -2))) if not any(dial.place for dial in dials) else Fraction(1),
        meshes=frozenset(pairs[:1]) if chance.random() < 0.1 else frozenset(),
        apart=frozenset(pairs[1:2]) if chance.random() < 0.2 else frozenset(),
        coaxial=frozenset([frozenset(arbor.name for arbor in survivors[:2])])
        if len(survivors) > 1 and chance.random() < 0.1
        else frozenset(),
        use=chance.choice(("wheels", "wheels", "arbors", "some")),
        idlers=idlers and chance.random() < 0.5,
    )


class _Grown:
    """An arbor of a random train."""

    def __init__(self, number: int, parent: tuple[_Grown, int] | None, driven: int | None) -> None:
        self.number = number
        self.parent = parent
        self.driven = driven
        self.drivers: list[int] = []
        self.survives = True
        self.hidden = 0

    def driver(self, chance: random.Random, minimum: int, maximum: int) -> int:
        if not self.drivers or chance.random() < 0.4:
            self.drivers.append(chance.randint(minimum, maximum))
        return chance.choice(self.drivers)

    def counts(self) -> list[int]:
        return ([] if self.driven is None else [self.driven]) + self.drivers

    def speed(self) -> Fraction:
        if self.parent is None or self.driven is None:
            return Fraction(1)
        arbor, wheel = self.parent
        return -arbor.speed() * Fraction(wheel, self.driven)


def _survivor(arbor: _Grown, chance: random.Random, minimum: int, maximum: int) -> SurvivingArbor:
    counts = arbor.counts()
    if arbor.hidden:
        counts = counts[: len(counts) - arbor.hidden]
    wheels = []
    for number, teeth in enumerate(counts):
        readings = {teeth: Fraction(2)}
        if chance.random() < 0.15:
            readings[teeth + chance.choice((-1, 1))] = Fraction(1)
        wheels.append(SurvivingWheel(f"w{arbor.number}{'abcdef'[number]}", tuple(sorted(readings.items()))))
    return SurvivingArbor(f"A{arbor.number}", tuple(wheels))


def _random_dial(chance: random.Random, arbor: _Grown, speed: Fraction) -> SearchedDial:
    signed = chance.random() < 0.7
    wanted = speed if signed else abs(speed)
    slack = abs(speed) / 50 if chance.random() < 0.2 else Fraction(0)
    place = None
    if chance.random() < 0.4:
        place = f"A{arbor.number}" if arbor.survives else "new"
    return SearchedDial(f"D{arbor.number}", wanted - slack, wanted + slack, signed, place)


def with_rings(problem: ReconstructionProblem, seed: int) -> ReconstructionProblem:
    """Return the problem with some surviving wheels as rings, and with senses that one of its solutions can have."""
    chance = random.Random(seed)
    arbors = []
    for arbor in (problem.input, *problem.arbors):
        wheels = (replace(wheel, internal=chance.random() < 0.6) for wheel in arbor.wheels)
        arbors.append(SurvivingArbor(arbor.name, tuple(wheels)))
    turned = tuple(
        replace(dial, minimum=-dial.maximum, maximum=-dial.minimum) if dial.signed and chance.random() < 0.4 else dial
        for dial in problem.dials
    )
    changed = replace(problem, input=arbors[0], arbors=tuple(arbors[1:]), dials=turned)
    return replace(changed, meshes=frozenset(pair for pair in problem.meshes if not pair <= rings_of(changed)))


def declared(problem: ReconstructionProblem) -> Train:
    """Return a small problem as declared evidence, with speeds as targets, which accept either sense if permitted."""
    arbors = (problem.input, *problem.arbors)
    counts = {
        arbor.name: {
            part.name: {
                "value": part.counts[0][0],
                "choices": [count for count, _ in part.counts],
                "weights": [str(weight) for _, weight in part.counts],
            }
            for part in arbor.wheels
        }
        for arbor in arbors
    }
    links = {
        link: {"wheels": {name: {"teeth": part, "internal": name in problem.rings} for name, part in wheels.items()}}
        for link, wheels in counts.items()
    }
    outputs = {}
    for dial in problem.dials:
        middle, half = (dial.minimum + dial.maximum) / 2, (dial.maximum - dial.minimum) / 2
        said = {"expect": {"value": str(middle), "tolerance": str(half)}}
        if not dial.signed:
            share = str(half / middle)
            said = {"targets": [{"period": f"{1 / middle} d", "tolerance": share}]}
        outputs[dial.name] = {**({"of": dial.place} if dial.place else {}), **said}
    add = {"wheels": problem.additions.wheels, "on": problem.additions.on}
    add["teeth"] = [problem.additions.minimum, problem.additions.maximum]
    if problem.additions.arbors is not None:
        add["arbors"] = problem.additions.arbors
    requested = {
        "add": add,
        "use": problem.use,
        "idlers": problem.idlers,
        "apart": [sorted(pair) for pair in problem.apart],
    }
    joints = [{"pair": ["frame", arbor], "axis": "same"} for pair in problem.coaxial for arbor in sorted(pair)]
    return declare(
        {
            "unit": {"per": "1 d"},
            "revolutes": joints,
            "links": links,
            "gears": [{"pair": sorted(pair)} for pair in problem.meshes if len(pair) == 2],
            "inputs": {problem.input.name: str(problem.input_speed)},
            "outputs": outputs,
            "reconstruct": requested,
        }
    )


def sections(answer: ReconstructionAnswer) -> dict[str, Section]:
    """Return the sections of the page on an answer by their titles."""
    return {section.title: section for section in describe_reconstruction(answer).sections}
