"""Names of the arbors and wheels of a candidate, and of a topology, the same in each of its trains."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from geartrain.search.reconstruct.added_counts import AddedKind
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, Branching, Chain, Dials, Topology

# A candidate in which every arbor and wheel has a name, in an order that does not depend on counts. Branches stand
# in the order of the first pointer to which each leads. An added arbor is called after the first pointer that it
# shows, as `new_sun`, else `new1`, `new2`, ...; its wheels are `new_sun1`, or `new1_1`, the driven one first. On a
# surviving arbor `m` they are `m_new1`, `m_new2`, ...: a name such as `m3` would be that of another wheel wherever
# the literature has one. So wheels that play the same part in different candidates have one name, whatever their
# counts.


_ADDED = "new"


@dataclass(frozen=True)
class NamedWheel:
    """A wheel of a candidate."""

    name: str
    teeth: int
    added: bool


@dataclass(frozen=True)
class NamedArbor:
    """An arbor of a candidate and all that it drives."""

    name: str
    added: bool
    driven: NamedWheel | None
    """The wheel that is driven; None for the input arbor."""
    dials: tuple[str, ...]
    """Names of the dials that it shows, sorted."""
    drives: tuple[tuple[NamedWheel, NamedArbor], ...]
    """Every arbor that it drives, with the wheel that drives it."""

    def arbors(self) -> Iterator[NamedArbor]:
        """This one and all below it, each before those that it drives."""
        yield self
        for _, arbor in self.drives:
            yield from arbor.arbors()

    def wheels(self) -> tuple[NamedWheel, ...]:
        """Those of this arbor that mesh, each once, the driven one first."""
        own = {self.driven.name: self.driven} if self.driven is not None else {}
        return tuple((own | {wheel.name: wheel for wheel, _ in self.drives}).values())

    def meshes(self) -> Iterator[tuple[NamedArbor, NamedWheel, NamedArbor]]:
        """Every mesh: the arbor that drives, its wheel, and the arbor that is driven, in the order of `arbors`."""
        for wheel, arbor in self.drives:
            yield self, wheel, arbor
            yield from arbor.meshes()


def name_train(arbor: Arbor, dials: Sequence[str], links: Collection[str], wheels: Collection[str]) -> NamedArbor:
    """A candidate with names.

    arbor   from its input on
    dials   all of them, in the order of the evidence
    links   names that arbors have already
    wheels  names that wheels have already
    """
    return _Naming(tuple(dials), FreeNames(set(links), set(wheels))).name(arbor)


def free_name(name: str, kind: str, taken: Container[str]) -> str:
    """The name itself, else one that says what it is."""
    if name not in taken:
        return name
    longer = f"{name}_{kind}"
    return longer if longer not in taken else numbered(f"{longer}_", taken)


def numbered(stem: str, taken: Container[str]) -> str:
    """The stem with the first number from 1 on that is free."""
    number = 1
    while f"{stem}{number}" in taken:
        number += 1
    return f"{stem}{number}"


@dataclass
class FreeNames:
    """Names for what is added, none twice."""

    links: set[str]
    """Names that are taken."""
    wheels: set[str]
    """Names that are taken."""

    def link(self, dials: tuple[str, ...] = ()) -> str:
        """The name of the next added arbor, which shows some dials."""
        name = f"{_ADDED}_{dials[0]}" if dials else numbered(_ADDED, self.links)
        link = free_name(name, "arbor", self.links)
        self.links.add(link)
        return link

    def wheel(self, link: str, survives: bool) -> str:
        """The name of the next added wheel of an arbor."""
        stem = f"{link}_{_ADDED}" if survives else f"{link}_" if link[-1].isdigit() else link
        name = numbered(stem, self.wheels)
        self.wheels.add(name)
        return name


@dataclass
class _Naming:
    """Names that are given arbor by arbor, from the input on."""

    dials: tuple[str, ...]
    free: FreeNames
    firsts: dict[int, int] = field(default_factory=dict)

    def name(self, arbor: Arbor) -> NamedArbor:
        link = arbor.name if arbor.name is not None else self._link(arbor)
        driven = self._wheel(arbor, link, arbor.driven) if arbor.driven is not None else None
        named: dict[int, NamedWheel] = {}
        below = []
        for _, at, wheel, child in sorted(self._drives(arbor), key=lambda one: one[:2]):
            if at not in named:
                same = driven is not None and (at < 0 or wheel.name == driven.name)
                named[at] = driven if same and driven is not None else self._wheel(arbor, link, wheel)
            below.append((named[at], child))
        drives = tuple((wheel, self.name(child)) for wheel, child in below)
        return NamedArbor(link, arbor.name is None, driven, arbor.dials, drives)

    def _drives(self, arbor: Arbor) -> Iterator[tuple[int, int, PlacedWheel, Arbor]]:
        """The first dial below, which of the driving wheels (-1: the driven one itself), the wheel, what it drives."""
        for child in arbor.passes:
            assert arbor.driven is not None
            yield self._first(child), -1, arbor.driven, child
        for at, (wheel, children) in enumerate(arbor.drives):
            for child in children:
                yield self._first(child), at, wheel, child

    def _first(self, arbor: Arbor) -> int:
        """Which dial is the first that the arbor shows, or leads to."""
        if id(arbor) not in self.firsts:
            below = [self._first(child) for _, children in arbor.drives for child in children]
            below += map(self._first, arbor.passes)
            self.firsts[id(arbor)] = min([*map(self.dials.index, arbor.dials), *below], default=len(self.dials))
        return self.firsts[id(arbor)]

    def _link(self, arbor: Arbor) -> str:
        return self.free.link(arbor.dials)

    def _wheel(self, arbor: Arbor, link: str, wheel: PlacedWheel) -> NamedWheel:
        if wheel.name is not None:
            return NamedWheel(wheel.name, wheel.teeth, False)
        return NamedWheel(self.free.wheel(link, arbor.name is not None), wheel.teeth, True)


# A topology in which every arbor and wheel has the name that it has in all of its trains. Added arbors of a chain
# are named by their place on it, so that names do not depend on the order of the others.


class TopologyWheel(NamedTuple):
    """A wheel by its name; of an added one the kind, None for one that survives."""

    name: str
    placed: PlacedWheel
    kind: AddedKind | None


class TopologyArbor(NamedTuple):
    """An arbor by its name, whether it is added, and the wheels by which a path passes it: in an idler the same."""

    name: str
    added: bool
    driven: TopologyWheel | None
    driver: TopologyWheel | None

    @property
    def survivor(self) -> str | None:
        """The name of a surviving arbor."""
        return None if self.added else self.name


@dataclass(frozen=True, eq=False)
class NamedChain:
    """Arbors in a row, and where they end."""

    chain: Chain
    """Without names."""
    through: tuple[TopologyArbor, ...]
    """Surviving arbors."""
    added: tuple[tuple[TopologyArbor, TopologyArbor], ...]
    """By place among the added ones, the arbor as one with two wheels and as an idler."""
    end: NamedBranching | tuple[NamedChain, ...]
    """An arbor with its wheels and what each drives, or what hangs from the last driving wheel."""

    @cached_property
    def surviving_wheels(self) -> frozenset[str]:
        """Names of the surviving wheels on it, and on all that is below."""
        wheels = [wheel for arbor in self.through for wheel in (arbor.driven, arbor.driver)]
        below = self.end
        if isinstance(below, NamedBranching):
            wheels += below.wheels()
            below = tuple(chain for _, chains in below.hanging for chain in chains)
        own = frozenset(wheel.name for wheel in wheels if wheel is not None and wheel.kind is None)
        return own.union(*(chain.surviving_wheels for chain in below))


@dataclass(frozen=True, eq=False)
class NamedBranching:
    """An arbor at which paths end or part."""

    arbor: TopologyArbor
    """With the wheel that is driven."""
    here: Dials
    """Dials that it shows."""
    hanging: tuple[tuple[TopologyWheel, tuple[NamedChain, ...]], ...]
    """Wheels, each with what it drives."""

    def wheels(self) -> Iterator[TopologyWheel]:
        """Its wheels that mesh, each once."""
        if self.arbor.driven is not None:
            yield self.arbor.driven
        yield from (wheel for wheel, _ in self.hanging if wheel != self.arbor.driven)


def name_topology(
    topology: Topology, dials: Sequence[str], links: Collection[str], wheels: Collection[str]
) -> NamedBranching:
    """A topology with names, from its input on; the other arguments are those of `name_train`."""
    return _TopologyNaming(tuple(dials), FreeNames(set(links), set(wheels))).branching(topology.root, ())


@dataclass
class _TopologyNaming:
    dials: tuple[str, ...]
    free: FreeNames

    def branching(self, branching: Branching, dials: Dials) -> NamedBranching:
        """An arbor at which paths end or part; `dials` are all below it."""
        name = self.free.link(branching.here) if branching.name is None else branching.name
        past = {dial for chain in branching.passes for dial in chain.dials}
        turned = tuple(dial for dial in dials if dial not in past)
        driven = (
            None
            if branching.driven is None
            else self._wheel((name, branching.name is None), branching.driven, AddedKind(turned, False))
        )
        hanging: list[tuple[TopologyWheel, tuple[Chain, ...]]] = []
        if branching.passes:
            assert driven is not None
            hanging.append((driven, branching.passes))
        for wheel, chains in sorted(branching.drives, key=lambda one: self._first(one[1])):
            led_to = tuple(sorted(dial for chain in chains for dial in chain.dials))
            hanging.append((self._wheel((name, branching.name is None), wheel, AddedKind(led_to, True)), chains))
        named = self._chains([chain for _, chains in hanging for chain in chains])
        below = tuple((wheel, tuple(named[id(chain)] for chain in chains)) for wheel, chains in hanging)
        return NamedBranching(TopologyArbor(name, branching.name is None, driven, None), branching.here, below)

    def _chains(self, chains: Sequence[Chain]) -> dict[int, NamedChain]:
        """Chains by identity, named in the order of the first dial of each."""
        return {id(chain): self._chain(chain) for chain in sorted(chains, key=lambda chain: self._first((chain,)))}

    def _first(self, chains: Sequence[Chain]) -> int:
        return min(self.dials.index(dial) for chain in chains for dial in chain.dials)

    def _chain(self, chain: Chain) -> NamedChain:
        through = tuple(self._arbor(name, False, each, chain.dials) for name, each in chain.through)
        added = tuple(self._added(chain.dials) for _ in range(chain.compounds + chain.idlers))
        end = chain.end
        below = self.branching(end, chain.dials) if isinstance(end, Branching) else tuple(self._chains(end).values())
        return NamedChain(chain, through, added, below)

    def _added(self, dials: Dials) -> tuple[TopologyArbor, TopologyArbor]:
        name = self.free.link()
        compound = self._arbor(name, True, ArborPass(ADDED, ADDED, 0), dials)
        assert compound.driven is not None
        driven = compound.driven._replace(kind=AddedKind((), False))
        return compound, TopologyArbor(name, True, driven, driven)

    def _arbor(self, name: str, added: bool, each: ArborPass, dials: Dials) -> TopologyArbor:
        assert each.driven is not None
        assert each.driver is not None
        driven = self._wheel((name, added), each.driven, AddedKind(() if each.idler else dials, False))
        driver = driven if each.idler else self._wheel((name, added), each.driver, AddedKind(dials, True))
        return TopologyArbor(name, added, driven, driver)

    def _wheel(self, arbor: tuple[str, bool], wheel: PlacedWheel, kind: AddedKind) -> TopologyWheel:
        if wheel != ADDED:
            return TopologyWheel(wheel.name or "", wheel, None)
        link, added = arbor
        return TopologyWheel(self.free.wheel(link, not added), wheel, kind)
