"""Names of the arbors and wheels of a candidate, and of a topology with the same names in all of its trains."""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from geartrain.search.reconstruct.added_counts import AddedKind
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, Branching, Chain, Dials, Topology

# Canonical names of the arbors and wheels of a candidate, in an order that does not depend on tooth counts: branches
# are sorted by the first pointer to which each leads. An added arbor is named after the first pointer that it shows,
# such as `new_sun`, else `new1`, `new2`, ...; its wheels are `new_sun1` or `new1_1`, the driven wheel first. Added
# wheels on a surviving arbor `m` are `m_new1`, `m_new2`, ..., because a name such as `m3` would be confused with
# another wheel in the literature. Wheels with the same function in different candidates therefore have the same name,
# whatever their counts.


_ADDED = "new"


@dataclass(frozen=True)
class NamedWheel:
    """Wheel of a candidate with its name, its tooth count, and whether it is added."""

    name: str
    teeth: int
    added: bool


@dataclass(frozen=True)
class NamedArbor:
    """Arbor of a candidate with its name and the subtree that it drives."""

    name: str
    added: bool
    driven: NamedWheel | None
    """Driven wheel; None for the input arbor."""
    dials: tuple[str, ...]
    """Names of the dials that the arbor shows, sorted."""
    drives: tuple[tuple[NamedWheel, NamedArbor], ...]
    """Pairs of a driving wheel and an arbor that it drives."""

    def arbors(self) -> Iterator[NamedArbor]:
        """Yield this arbor and its subtree in depth-first order."""
        yield self
        for _, arbor in self.drives:
            yield from arbor.arbors()

    def wheels(self) -> tuple[NamedWheel, ...]:
        """Return the meshing wheels of this arbor, each once, the driven wheel first."""
        own = {self.driven.name: self.driven} if self.driven is not None else {}
        return tuple((own | {wheel.name: wheel for wheel, _ in self.drives}).values())

    def meshes(self) -> Iterator[tuple[NamedArbor, NamedWheel, NamedArbor]]:
        """Yield every mesh as (driving arbor, driving wheel, driven arbor), in the order of `arbors`."""
        for wheel, arbor in self.drives:
            yield self, wheel, arbor
            yield from arbor.meshes()


def name_train(arbor: Arbor, dials: Sequence[str], links: Collection[str], wheels: Collection[str]) -> NamedArbor:
    """Return a candidate in which all arbors and wheels have names.

    arbor   input arbor
    dials   all dials, in the order of the evidence
    links   existing names of arbors
    wheels  existing names of wheels
    """
    return _Naming(tuple(dials), FreeNames(set(links), set(wheels))).name(arbor)


def free_name(name: str, kind: str, taken: Container[str]) -> str:
    """Return `name` if it is not taken, otherwise the name extended by `kind` and, if necessary, a number."""
    if name not in taken:
        return name
    longer = f"{name}_{kind}"
    return longer if longer not in taken else numbered(f"{longer}_", taken)


def numbered(stem: str, taken: Container[str]) -> str:
    """Return `stem` with the smallest number, from 1, that is not taken."""
    number = 1
    while f"{stem}{number}" in taken:
        number += 1
    return f"{stem}{number}"


@dataclass
class FreeNames:
    """Generator of distinct names for added arbors and wheels."""

    links: set[str]
    """Names of arbors that are already used."""
    wheels: set[str]
    """Names of wheels that are already used."""

    def link(self, dials: tuple[str, ...] = ()) -> str:
        """Return the name of the next added arbor, derived from the first dial that it shows if there is one."""
        name = f"{_ADDED}_{dials[0]}" if dials else numbered(_ADDED, self.links)
        link = free_name(name, "arbor", self.links)
        self.links.add(link)
        return link

    def wheel(self, link: str, survives: bool) -> str:
        """Return the name of the next added wheel on an arbor."""
        # the underscore separates two numbers, as in `new1_2`
        stem = f"{link}_{_ADDED}" if survives else f"{link}_" if link[-1].isdigit() else link
        name = numbered(stem, self.wheels)
        self.wheels.add(name)
        return name


@dataclass
class _Naming:
    """Assignment of names to the arbors of a candidate, in depth-first order from the input."""

    dials: tuple[str, ...]
    free: FreeNames

    def name(self, arbor: Arbor) -> NamedArbor:
        link = arbor.name if arbor.name is not None else self.free.link(arbor.dials)
        driven = self._wheel(arbor, link, arbor.driven) if arbor.driven is not None else None
        # the driven wheel first, then the driving wheels
        drives = [arbor.passes, *(below for _, below in arbor.drives)]
        children = [(self._first(child), at, child) for at, below in enumerate(drives) for child in below]
        # the order of the dials does not depend on tooth counts
        children.sort(key=lambda one: one[:2])
        named = {} if driven is None else {0: driven}
        for _, at, _ in children:
            if at not in named:
                wheel = arbor.drives[at - 1][0]
                same = driven is not None and wheel.name == driven.name
                named[at] = driven if same and driven is not None else self._wheel(arbor, link, wheel)
        driving = tuple((named[at], self.name(child)) for _, at, child in children)
        return NamedArbor(link, arbor.name is None, driven, arbor.dials, driving)

    def _first(self, arbor: Arbor) -> int:
        """Return the index of the first dial in the subtree of an arbor."""
        shown = (self.dials.index(dial) for each in arbor.arbors() for dial in each.dials)
        return min(shown, default=len(self.dials))

    def _wheel(self, arbor: Arbor, link: str, wheel: PlacedWheel) -> NamedWheel:
        if wheel.name is not None:
            return NamedWheel(wheel.name, wheel.teeth, False)
        return NamedWheel(self.free.wheel(link, arbor.name is not None), wheel.teeth, True)


# Names of the arbors and wheels of a topology, which are valid in all of its trains. Added arbors of a chain are named
# by their position, so that their names do not depend on the order of the other arbors.


class TopologyWheel(NamedTuple):
    """Named wheel of a topology. `kind` is None for a surviving wheel."""

    name: str
    placed: PlacedWheel
    kind: AddedKind | None

    @property
    def added(self) -> bool:
        """True for an added wheel."""
        return self.kind is not None


class TopologyArbor(NamedTuple):
    """Named arbor of a topology, with its driven and driving wheel, which are the same wheel in an idler."""

    name: str
    added: bool
    driven: TopologyWheel | None
    driver: TopologyWheel | None

    @property
    def survivor(self) -> str | None:
        """Name of a surviving arbor; None for an added arbor."""
        return None if self.added else self.name


@dataclass(frozen=True, eq=False)
class NamedChain:
    """Chain of arbors in a topology, with names for its surviving and added arbors, and its end."""

    chain: Chain
    """Chain without names."""
    through: tuple[TopologyArbor, ...]
    """Surviving arbors."""
    added: tuple[tuple[TopologyArbor, TopologyArbor], ...]
    """Added arbors in order, each both as an arbor with two wheels and as an idler."""
    end: NamedBranching | tuple[NamedChain, ...]
    """Branching at which the chain ends, or the chains that its last driving wheel drives."""

    @cached_property
    def surviving_wheels(self) -> frozenset[str]:
        """Names of the surviving wheels on the chain and in its subtree."""
        wheels = [wheel for arbor in self.through for wheel in (arbor.driven, arbor.driver)]
        below = self.end
        if isinstance(below, NamedBranching):
            wheels += below.wheels()
            below = tuple(chain for _, chains in below.hanging for chain in chains)
        own = frozenset(wheel.name for wheel in wheels if wheel is not None and wheel.kind is None)
        return own.union(*(chain.surviving_wheels for chain in below))


@dataclass(frozen=True, eq=False)
class NamedBranching:
    """Arbor of a topology at which paths to dials end or separate, with names for the arbor and its wheels."""

    arbor: TopologyArbor
    """Arbor with its driven wheel."""
    here: Dials
    """Dials that the arbor shows."""
    hanging: tuple[tuple[TopologyWheel, tuple[NamedChain, ...]], ...]
    """Wheels of the arbor, each with the chains that it drives."""

    def wheels(self) -> Iterator[TopologyWheel]:
        """Yield the meshing wheels of the arbor, each once."""
        if self.arbor.driven is not None:
            yield self.arbor.driven
        yield from (wheel for wheel, _ in self.hanging if wheel != self.arbor.driven)


def name_topology(
    topology: Topology, dials: Sequence[str], links: Collection[str], wheels: Collection[str]
) -> NamedBranching:
    """Return the input arbor of a topology in which all arbors and wheels have names, as in `name_train`."""
    return _TopologyNaming(tuple(dials), FreeNames(set(links), set(wheels))).branching(topology.root, ())


@dataclass
class _TopologyNaming:
    dials: tuple[str, ...]
    free: FreeNames

    def branching(self, branching: Branching, dials: Dials) -> NamedBranching:
        """Return the named arbor of a branching with its subtree. `dials` are all dials of the subtree."""
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
        """Return the named chains by `id`. Names are given in the order of the first dial of each chain."""
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
