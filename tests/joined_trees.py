"""Every explanation where couplings join arbors, by plain growth of trees in which they are arbors of their own.

An independent program beside `concrete_trees`: a coupling is an edge of the tree between two arbors, written as a mesh
of two wheels `COUPLING` that keeps speed and sense. Whichever of the joined arbors is driven, the others hang from it.
At the end joined arbors fall together: which of them an added wheel or a pointer is on makes no other train.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator
from dataclasses import replace

import concrete_trees as plain
from concrete_trees import ADDED, DRIVEN, UNKNOWN, Node, Wheel

from geartrain.search.reconstruct import ReconstructionProblem, SurvivingArbor

COUPLING: Wheel = ("-", 1)
Pairs = tuple[tuple[str, str], ...]
"""Names of arbors that a coupling joins."""


def explanations_with_couplings(problem: ReconstructionProblem, pairs: Pairs) -> list[frozenset[Node]]:
    """Mechanisms with 0, 1, ... added wheels; joined arbors are called after the first of them in the question."""
    names = [arbor.name for arbor in (problem.input, *problem.arbors)]
    first = {name: min(group(name, pairs), key=names.index) for name in names}
    found: list[set[Node]] = [set() for _ in range(problem.additions.wheels + 1)]
    counts = range(problem.additions.minimum, problem.additions.maximum + 1)
    trees: set[Node] = {coupled(problem.input.name, (), pairs)}
    while trees:
        for tree in trees:
            if plain._keeps_rules(tree, problem):
                for teeth in itertools.product(counts, repeat=plain.added_wheels(tree)):
                    filled = plain._filled(tree, iter(teeth))
                    if plain._turns_in_rings(filled, problem):
                        found[len(teeth)].update(_shown(filled, problem, first))
        grown = {more for tree in trees for more in _grown(tree, problem, pairs)}
        trees = {tree for tree in grown if len(_ends(_together(tree, first))) <= len(problem.dials)}
    return [frozenset(solutions) for solutions in found]


def group(name: str, pairs: Pairs) -> set[str]:
    """An arbor with all that couplings join to it."""
    found = {name}
    for _ in pairs:
        found.update(*(pair for pair in pairs if found & set(pair)))
    return found


def coupled(name: str, driven: tuple, pairs: Pairs, by: str = "") -> Node:
    """An arbor with those that couplings hang from it, but for the one by which it is driven itself."""
    others = [next(iter({*pair} - {name})) for pair in pairs if name in pair and by not in pair]
    children = tuple(sorted(coupled(other, COUPLING, pairs, name) for other in others))
    return name, driven, (), ((COUPLING, children),) if children else ()


def _grown(tree: Node, problem: ReconstructionProblem, pairs: Pairs) -> Iterator[Node]:
    here = {node[0] for node in plain.nodes(tree)}
    survivors = {arbor.name: arbor for arbor in (problem.input, *problem.arbors)}
    children: list[Node] = [(ADDED, UNKNOWN, (), ())]
    for arbor in problem.arbors:
        if arbor.name not in here:
            children += [coupled(arbor.name, wheel, pairs) for wheel in plain._readings(arbor)]
            bare = not any(survivors[name].wheels for name in group(arbor.name, pairs))
            if problem.additions.on == "any" and bare:
                children.append(coupled(arbor.name, UNKNOWN, pairs))
    for grown in _with_child(tree, children, survivors, problem):
        arbors = plain.nodes(grown)
        most = problem.additions.arbors
        if plain.added_wheels(grown) <= problem.additions.wheels and (
            most is None or sum(arbor[0] == ADDED for arbor in arbors) <= most
        ):
            yield grown


def _with_child(
    node: Node, children: list[Node], survivors: dict[str, SurvivingArbor], problem: ReconstructionProblem
) -> Iterator[Node]:
    """The arbor and all below it with one mesh more; a coupling drives what it joins, and nothing else."""
    name, driven, dials, drives = node
    for at, (wheel, driven_arbors) in enumerate(drives):
        rest = drives[:at] + drives[at + 1 :]
        for child in children if wheel != COUPLING else ():
            yield name, driven, dials, plain._sorted(*rest, (wheel, plain._sorted(*driven_arbors, child)))
        for nth, arbor in enumerate(driven_arbors):
            others = driven_arbors[:nth] + driven_arbors[nth + 1 :]
            for grown in _with_child(arbor, children, survivors, problem):
                yield name, driven, dials, plain._sorted(*rest, (wheel, plain._sorted(*others, grown)))
    for wheel in plain._new_drivers(node, survivors, problem):
        for child in children if (wheel, driven) != (DRIVEN, COUPLING) else ():
            yield name, driven, dials, plain._sorted(*drives, (wheel, (child,)))


def _shown(tree: Node, problem: ReconstructionProblem, first: dict[str, str]) -> Iterator[Node]:
    """The tree with dials in every way, joined arbors together; no end of it without a dial."""
    arbors = plain.nodes(tree)
    turning = plain.speeds(tree, problem.input_speed, {COUPLING[0], *plain.rings_of(problem)})
    fitting = [
        [at for at, node in enumerate(arbors) if plain._at_place(node, dial) and plain._fits(turning[at], dial)]
        for dial in problem.dials
    ]
    for places in itertools.product(*fitting):
        shown: dict[int, list[str]] = {}
        for dial, at in zip(problem.dials, places, strict=True):
            shown.setdefault(at, []).append(dial.name)
        found = _together(plain._dialled(tree, shown, itertools.count()), first)
        if all(node[2] for node in _ends(found)):
            yield found


def _ends(tree: Node) -> list[Node]:
    return [node for node in plain.nodes(tree) if not node[3]]


def _together(node: Node, first: dict[str, str]) -> Node:
    name, driven, dials, drives = node
    kept = []
    for wheel, children in drives:
        below = [_together(child, first) for child in children]
        if wheel == COUPLING:
            dials = plain._sorted(*dials, *(dial for child in below for dial in child[2]))
            kept += [drive for child in below for drive in child[3]]
        else:
            kept.append((wheel, plain._sorted(*below)))
    return first.get(name, name), driven, dials, plain._sorted(*kept)


def parted(problem: ReconstructionProblem, seed: int) -> tuple[ReconstructionProblem, Pairs]:
    """The question with some of its arbors in two or three that couplings join, in any order; wheels are shared out.

    Facts of axes are left out, and so are meshes of wheels that are now joined.
    """
    chance = random.Random(seed)
    arbors: list[SurvivingArbor] = []
    pairs: list[tuple[str, str]] = []
    homes: dict[str, list[str]] = {}
    for arbor in (problem.input, *problem.arbors):
        names = [arbor.name]
        if chance.random() < 0.7:
            names += [f"{arbor.name}{end}" for end in "xy"[: chance.randint(1, 2)]]
        homes[arbor.name] = names
        wheels = {name: [] for name in names}
        for wheel in arbor.wheels:
            wheels[chance.choice(names)].append(wheel)
        arbors += [SurvivingArbor(name, tuple(some)) for name, some in wheels.items()]
        pairs += [(names[chance.randrange(at)], names[at]) for at in range(1, len(names))]
    dials = tuple(
        replace(dial, place=chance.choice(homes[dial.place])) if dial.place in homes else dial for dial in problem.dials
    )
    changed = replace(problem, input=arbors[0], arbors=tuple(arbors[1:]), dials=dials, coaxial=frozenset())
    return changed, tuple(pairs)
