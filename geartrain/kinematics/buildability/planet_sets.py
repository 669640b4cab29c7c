"""Meshes of a train with their axes and modules, and the sets of planets on a carrier, those that are alike together.

A tooth count stands for itself, or is that of a wheel which is free, by its id: then it is to be found.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Literal

from geartrain.kinematics.circuits import Circuit, Tree, find_circuits, find_tree
from geartrain.numerics.graphs import joined_groups

if TYPE_CHECKING:
    from geartrain.train import Train

CountRef = str | int
"""A tooth count in a rule: that of a free wheel, by id, or a fixed one."""

Measure = Literal["", "plain", "m"]
"""How the size of a tooth is declared: not at all, as a plain number, as a length."""


@dataclass(frozen=True, slots=True)
class AssemblyMesh:
    """A gear pair as its carrier sees it. Pairs hold what belongs to its first and second wheel.

    name, carrier    the pair, and the link that keeps its centre distance
    wheels, links    their ids
    axes             labels of the axes they turn on, as seen from the carrier
    parts            their counts: ids of free wheels, or fixed numbers
    sense            1 where they turn against each other as seen from the carrier (about positive senses), else -1
    ring             index of the wheel that is a ring; None for an external pair
    spur, worm       both wheels are spur wheels; one is a worm
    measure, module  the module of both, 1 of no measure where none is declared; None where several are declared
    """

    name: str
    carrier: str
    wheels: tuple[str, str]
    links: tuple[str, str]
    axes: tuple[str, str]
    parts: tuple[CountRef, CountRef]
    sense: int
    ring: int | None
    spur: bool
    worm: bool
    measure: Measure
    module: Fraction | None

    @property
    def is_free(self) -> bool:
        """True if a count of it is free."""
        return any(isinstance(part, str) for part in self.parts)

    @property
    def terms(self) -> tuple[tuple[int, CountRef], tuple[int, CountRef]]:
        """Twice the centre distance of a spur pair, in modules: z1 + z2, or the ring less its mate; sign and count."""
        first, second = self.parts
        return (-1 if self.ring == 1 else 1, first), (-1 if self.ring == 0 else 1, second)


@dataclass(frozen=True, slots=True)
class Planet:
    """A planet of a set, with its meshes; those that mesh with each other form a tree whose root is the first.

    inward    the mesh with the planet inward of it; None for the first
    central   meshes with wheels on the carrier's own axis, by the names of those
    outward   meshes with planets outward of this one, in the same order for sets that are alike
    """

    link: str
    inward: AssemblyMesh | None
    central: tuple[AssemblyMesh, ...]
    outward: tuple[tuple[AssemblyMesh, Planet], ...]

    def walk(self) -> Iterator[Planet]:
        """This planet, and all outward of it."""
        yield self
        for _, planet in self.outward:
            yield from planet.walk()

    def side(self, mesh: AssemblyMesh) -> int:
        """Which wheel of a mesh of it is on this planet: 0 or 1."""
        return mesh.links.index(self.link)

    def own(self, mesh: AssemblyMesh) -> str:
        """Its wheel in a mesh of it."""
        return mesh.wheels[self.side(mesh)]

    def mate(self, mesh: AssemblyMesh) -> str:
        """The other wheel of a mesh of it."""
        return mesh.wheels[1 - self.side(mesh)]

    @property
    def wheels(self) -> tuple[str, ...]:
        """Its wheels that mesh in the set, in the same order for sets that are alike."""
        inward = [self.inward] if self.inward else []
        meshes = [*inward, *self.central, *(mesh for mesh, _ in self.outward)]
        return tuple(dict.fromkeys(self.own(mesh) for mesh in meshes))

    @property
    def form(self) -> object:
        """The same for planets that mesh with the same central wheels in the same way."""
        wheels = self.wheels
        central = tuple((wheels.index(self.own(mesh)), self.mate(mesh)) for mesh in self.central)
        outward = tuple((wheels.index(self.own(mesh)), other.form) for mesh, other in self.outward)
        return len(wheels), central, outward


@dataclass(frozen=True, slots=True)
class PlanetSet:
    """Planets of one carrier that mesh with each other; most often one.

    planets  the first of them, the root of their tree; None where they mesh in a loop
    links    all of them
    copies   further sets that mesh with the same central wheels alike: equal planets declared one by one
    """

    carrier: str
    planets: Planet | None
    links: tuple[str, ...]
    copies: tuple[PlanetSet, ...] = ()

    @property
    def title(self) -> str:
        """Its planets, for a reader."""
        return ", ".join(f"'{link}'" for link in self.links)


@dataclass(frozen=True)
class TrainAssembly:
    """A train whose free wheels have some of their allowed counts, and the counts that are free.

    tree, circuits   its turning pairs; its gear pairs and couplings
    """

    train: Train
    free: frozenset[str]
    tree: Tree
    circuits: tuple[Circuit, ...]

    @classmethod
    def of(cls, train: Train, free: Iterable[str]) -> TrainAssembly:
        """That of a train that nothing is known of yet."""
        tree = find_tree(train)
        return cls(train, frozenset(free), tree, find_circuits(train, tree))

    def part(self, wheel: str) -> CountRef:
        """The count of a wheel in a rule: its id where it is free, else its number."""
        count = self.train.wheels[wheel][1].count
        return wheel if wheel in self.free or count is None else count

    @cached_property
    def meshes(self) -> tuple[AssemblyMesh, ...]:
        """All gear pairs, in the order declared."""
        return tuple(self._mesh(circuit) for circuit in self.circuits if circuit.kind == "gear")

    def _mesh(self, circuit: Circuit) -> AssemblyMesh:
        first, second = (self.train.wheels[name][1] for name in circuit.wheels)
        measure, module = self.module(*circuit.wheels)
        return AssemblyMesh(
            circuit.id,
            circuit.carrier,
            circuit.wheels,
            (circuit.i, circuit.j),
            (
                self.tree.axis_seen_from(circuit.carrier, circuit.i),
                self.tree.axis_seen_from(circuit.carrier, circuit.j),
            ),
            (self.part(circuit.wheels[0]), self.part(circuit.wheels[1])),
            1 if circuit.a * circuit.b > 0 else -1,
            0 if first.internal else 1 if second.internal else None,
            first.kind == second.kind == "spur",
            "worm" in (first.kind, second.kind),
            measure,
            module,
        )

    def module(self, *wheels: str) -> tuple[Measure, Fraction | None]:
        """The module that wheels have in common: declared for them, or for any wheel that must share it.

        Without any it is 1 of no measure; None where several are declared.
        """
        found = {one for wheel in wheels for one in self._modules.get(self.kin[wheel], ())}
        if len(found) > 1:
            found = {one for wheel in wheels for one in self._declared(wheel)}
        if not found:
            return "", Fraction(1)
        measure, module = next(iter(found))
        return measure, module if len(found) == 1 else None

    @cached_property
    def _modules(self) -> Mapping[int, frozenset[tuple[Measure, Fraction]]]:
        """The modules declared among wheels that share one."""
        found: dict[int, frozenset[tuple[Measure, Fraction]]] = {}
        for wheel, number in self.kin.items():
            found[number] = found.get(number, frozenset()) | self._declared(wheel)
        return found

    def _declared(self, wheel: str) -> frozenset[tuple[Measure, Fraction]]:
        module = self.train.wheels[wheel][1].module
        if module is None or not module.base:
            return frozenset()
        return frozenset({("m" if module.unit else "plain", module.base)})

    @cached_property
    def kin(self) -> Mapping[str, int]:
        """Wheels that must share a module, for they mesh or mesh with wheels that do: the number of their group."""
        worms = {wheel for wheel, (_, kind) in self.train.wheels.items() if kind.kind == "worm"}
        pairs = [circuit.wheels for circuit in self.circuits if circuit.kind == "gear"]
        groups = joined_groups(self.train.wheels, [pair for pair in pairs if worms.isdisjoint(pair)])
        return {wheel: number for number, group in enumerate(groups) for wheel in group}

    @cached_property
    def sets(self) -> tuple[PlanetSet, ...]:
        """The sets of planets on carriers other than the frame; those declared alike are copies of the first."""
        found: list[PlanetSet] = []
        for carrier in dict.fromkeys(mesh.carrier for mesh in self.meshes if mesh.carrier != self.train.frame):
            alike: dict[object, list[PlanetSet]] = {}
            for links in self._groups(carrier):
                one = self._set(carrier, links)
                alike.setdefault(one.planets.form if one.planets else one.links, []).append(one)
            for first, *others in alike.values():
                found.append(PlanetSet(carrier, first.planets, first.links, tuple(others)))
        return tuple(found)

    def _groups(self, carrier: str) -> list[list[str]]:
        """Planets of a carrier, those together that mesh with each other."""
        meshing = [mesh.links for mesh in self._meshes_of(carrier)]
        planets = [[link for link in links if self.tree.bears(carrier, link)] for links in meshing]
        return joined_groups(chain(*planets), planets)

    def _meshes_of(self, carrier: str) -> list[AssemblyMesh]:
        return self._by_carrier.get(carrier, [])

    @cached_property
    def _by_carrier(self) -> Mapping[str, list[AssemblyMesh]]:
        found: dict[str, list[AssemblyMesh]] = {}
        for mesh in self.meshes:
            if not mesh.worm:
                found.setdefault(mesh.carrier, []).append(mesh)
        return found

    def _set(self, carrier: str, links: list[str]) -> PlanetSet:
        among = [mesh for mesh in self._meshes_of(carrier) if set(mesh.links) <= set(links)]
        if len(among) != len(links) - 1:
            return PlanetSet(carrier, None, tuple(links))
        # equal sets start at the planet whose central wheels come first, so that they are connected alike
        start = min(links, key=lambda link: (self._mates(carrier, link) or ["\uffff"], links.index(link)))
        return PlanetSet(carrier, self._planet(carrier, start, None, among), tuple(links))

    def _mates(self, carrier: str, link: str) -> list[str]:
        """Central wheels that a planet meets."""
        return [mesh.wheels[1 - mesh.links.index(link)] for mesh in self._central(carrier, link)]

    def _central(self, carrier: str, link: str) -> list[AssemblyMesh]:
        """Meshes of a planet with central wheels, by the names of those."""
        found = [mesh for mesh in self._meshes_of(carrier) if link in mesh.links]
        sides = [(mesh, 1 - mesh.links.index(link)) for mesh in found]
        sides = [(mesh, side) for mesh, side in sides if not self.tree.bears(carrier, mesh.links[side])]
        return [mesh for mesh, _ in sorted(sides, key=lambda each: each[0].wheels[each[1]])]

    def _planet(self, carrier: str, link: str, inward: AssemblyMesh | None, among: list[AssemblyMesh]) -> Planet:
        rest = [mesh for mesh in among if link not in mesh.links]
        outward = []
        for mesh in among:
            if link in mesh.links:
                outward.append((mesh, self._planet(carrier, mesh.links[1 - mesh.links.index(link)], mesh, rest)))
        outward.sort(key=lambda each: repr(each[1].form))
        return Planet(link, inward, tuple(self._central(carrier, link)), tuple(outward))


def corresponding(first: PlanetSet, other: PlanetSet) -> Mapping[str, str]:
    """Wheels of a set -> the wheels of a copy of it in their places."""
    assert first.planets is not None
    assert other.planets is not None
    found: dict[str, str] = {}
    for mine, its in zip(first.planets.walk(), other.planets.walk(), strict=True):
        found.update(zip(mine.wheels, its.wheels, strict=True))
    return found
