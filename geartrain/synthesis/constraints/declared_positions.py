"""Declared positions of axes: which counts reach each other there, and which teeth meet around loops."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.kinematics.circuits import Circuit, Tree
from geartrain.kinematics.phasing import MeshPhasing, find_phasing
from geartrain.synthesis.constraints.count_conditions import (
    Condition,
    Divisible,
    LinearSum,
    WholeSum,
    free_of,
    teeth_of,
    whole,
)

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.planet_sets import AssemblyMesh, TrainAssembly
    from geartrain.numerics.arrays import Bools
    from geartrain.synthesis.constraints.count_conditions import CandidateColumns
    from geartrain.train import Train

PLAY = 0.05
"""Half modules by which positions may be off: they are rounded, and teeth have play."""


@dataclass(frozen=True, slots=True)
class CentreDistanceMatch:
    """A sum of teeth as near as `most` to a multiple of another: centre distances in the proportion of positions."""

    teeth: WholeSum
    other: WholeSum
    ratio: float
    most: float

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where it is, (candidates,)."""
        return np.asarray(np.abs(self.teeth.of(columns) - self.ratio * self.other.of(columns)) <= self.most)


@dataclass(frozen=True)
class LoopPhasing:
    """Loops whose teeth meet, judged for every candidate on its own (about a millisecond each).

    train, tree, circuits  with some counts; those of `wheels` are put in
    """

    train: Train
    tree: Tree
    circuits: tuple[Circuit, ...]
    wheels: tuple[str, ...]

    def __call__(self, columns: CandidateColumns) -> Bools:
        """True where no loop misses or cannot be told, (candidates,)."""
        rows = np.stack([columns[wheel] for wheel in self.wheels], axis=1)
        each, back = np.unique(rows, axis=0, return_inverse=True)
        found = [self.holds(dict(zip(self.wheels, row, strict=True))) for row in each.tolist()]
        return np.array(found, dtype=bool)[back.reshape(-1)]

    def holds(self, counts: Mapping[str, int]) -> bool:
        """True if the loops close with these counts."""
        return bool(find_phasing(self.train, self.tree, [circuit.with_counts(counts) for circuit in self.circuits]))


@dataclass(frozen=True)
class DeclaredPositions:
    """The declared positions of a train, as facts: wheels must reach each other there, and teeth meet.

    shift   half modules that profile shift bridges
    """

    fitting: TrainAssembly
    shift: int = 0

    @cached_property
    def closure(self) -> MeshPhasing:
        """Phase closure with the stand-in counts."""
        return find_phasing(self.fitting.train, self.fitting.tree, self.fitting.circuits)

    def conditions(self) -> Iterator[Condition]:
        """Distances first, loops last. `QuestionError` where no loop has known places."""
        found = self.closure
        if found.kind == "open" and not found.rigid:
            raise QuestionError(_no_places(self.fitting.train))
        yield from self._reaching()
        yield from self._meeting()

    # ------------------------------------------------------------------------------------------------------- distances

    def _reaching(self) -> Iterator[Condition]:
        """Meshes that share a wheel, or have modules of one measure, share a unit: distances are as their teeth."""
        groups: dict[int, list[AssemblyMesh]] = {}
        for mesh in self.fitting.meshes:
            if mesh.spur and self._length(mesh):
                groups.setdefault(self.fitting.kin[mesh.wheels[0]], []).append(mesh)
        for meshes in groups.values():
            yield from self._by_module([mesh for mesh in meshes if self._is_sized(mesh)])
            yield from self._by_each_other([mesh for mesh in meshes if not self._is_sized(mesh)])

    def _by_module(self, meshes: Sequence[AssemblyMesh]) -> Iterator[Condition]:
        for mesh in meshes:
            assert mesh.module is not None
            yield from self._as(mesh, LinearSum({}).plus(2), self._length(mesh) / float(mesh.module), "its module")

    def _by_each_other(self, meshes: Sequence[AssemblyMesh]) -> Iterator[Condition]:
        fixed = [mesh for mesh in meshes if not mesh.is_free]
        for mesh in meshes:
            first = (fixed or meshes)[0]
            if mesh is not first:
                yield from self._as(mesh, teeth_of(first), self._length(mesh) / self._length(first), f"'{first.name}'")

    def _is_sized(self, mesh: AssemblyMesh) -> bool:
        """True if the module of a mesh and the positions of its axes are in one measure."""
        if not mesh.measure or mesh.module is None:
            return False
        places = [self.fitting.train.axes[label].position for label in mesh.axes]
        return {part.unit is None for place in places for part in place or () if part.value} == {
            mesh.measure == "plain"
        }

    def _as(self, mesh: AssemblyMesh, other: LinearSum, ratio: float, what: str) -> Iterator[Condition]:
        one, two = whole(teeth_of(mesh), other)
        wheels = tuple(dict.fromkeys((*one.wheels, *two.wheels)))
        if wheels:
            name = f"declared positions: '{mesh.name}' reaches as {what} says"
            yield Condition(name, wheels, CentreDistanceMatch(one, two, ratio, PLAY + self.shift))

    def _length(self, mesh: AssemblyMesh) -> float:
        """Distance of the two axes of a mesh (m, or plain); 0 where a position is not declared."""
        axes = self.fitting.train.axes
        ends = [axes[label].position for label in mesh.axes if label in axes]
        if len(ends) < 2 or ends[0] is None or ends[1] is None:
            return 0.0
        way = [float(figure.value) for figure in axes[mesh.axes[0]].direction]
        arm = [float(q.base - p.base) for p, q in zip(ends[0], ends[1], strict=True)]
        along = sum(x * y for x, y in zip(way, arm, strict=True)) ** 2 / sum(x * x for x in way)
        return sqrt(max(sum(x * x for x in arm) - along, 0.0))

    # ------------------------------------------------------------------------------------------------------------ loops

    def _meeting(self) -> Iterator[Condition]:
        """One condition on all loops: by their rule where it is known, else candidate by candidate."""
        wheels = free_of(*(self.fitting.part(wheel) for wheel in self._in_loops()))
        if not wheels:
            return
        alone = len({circuit.carrier for circuit in self.closure.problem.circuits}) == 1 and not self.closure.rigid
        # with several carriers, or loops that do not turn, which loops there are depends on the counts
        rule = replace(self.closure, alike=dict).rule if alone else None
        name = "phase closure: teeth of all loops meet at the declared positions"
        if rule is None:
            train = self.fitting.train.model_copy()
            train._marks = None  # it leads to a file, which other processes do not need
            yield Condition(name, wheels, LoopPhasing(train, self.fitting.tree, self.fitting.circuits, wheels))
            return
        sums = [(modulus, self._sum(terms)) for modulus, terms in rule.conditions]
        asked = tuple(dict.fromkeys(wheel for _, total in sums for wheel in total.wheels))
        if asked:
            yield Condition(f"{name}: {rule.text}", asked, Divisible(tuple(sums)))

    def _sum(self, terms: Mapping[str, int]) -> WholeSum:
        (total,) = whole(LinearSum.of((factor, self.fitting.part(wheel)) for wheel, factor in terms.items()))
        return total

    def _in_loops(self) -> Sequence[str]:
        """The wheels of all pairs in loops, closing and rigid ones."""
        problem = self.closure.problem
        meshes = {mesh for condition in problem.conditions for mesh in condition.row}
        pairs = {problem.circuits[mesh].id for mesh in meshes}
        pairs |= {pair for chord in problem.parts.breaking for pair in problem.parts.loop(chord).pairs}
        circuits = (circuit for circuit in self.fitting.circuits if circuit.id in pairs)
        return list(dict.fromkeys(wheel for circuit in circuits for wheel in circuit.wheels))


def _no_places(train: Train) -> Problem:
    return Problem(
        f"no loop of '{train.name}' has known places",
        "teeth meet or miss around loops of meshes, where the positions of axes are declared",
        "declare `axes` with positions, or leave phase closure out",
        train.place("axes"),
    )
