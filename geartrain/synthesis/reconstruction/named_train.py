"""A candidate in which every arbor and wheel has a name, in an order that does not depend on counts.

Branches stand in the order of the first pointer to which each leads. An added arbor is called after the first pointer
that it shows, as `new_sun`, else `new1`, `new2`, ...; its wheels are `new_sun1`, or `new1_1`, the driven one first. On
a surviving arbor `m` they are `m_new1`, `m_new2`, ...: a name such as `m3` would be that of another wheel wherever the
literature has one. So wheels that play the same part in different candidates have one name, whatever their counts.
"""

from __future__ import annotations

from collections.abc import Collection, Container, Iterator, Sequence
from dataclasses import dataclass, field

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel

_ADDED = "new"


@dataclass(frozen=True)
class NamedWheel:
    """A wheel of a candidate."""

    name: str
    teeth: int
    added: bool


@dataclass(frozen=True)
class NamedArbor:
    """An arbor of a candidate and all that it drives.

    driven   the wheel that is driven; None for the input arbor
    dials    names of the dials that it shows, sorted
    drives   every arbor that it drives, with the wheel that drives it
    """

    name: str
    added: bool
    driven: NamedWheel | None
    dials: tuple[str, ...]
    drives: tuple[tuple[NamedWheel, NamedArbor], ...]

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
    """Names for what is added, none twice.

    links, wheels   names that are taken
    """

    links: set[str]
    wheels: set[str]

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
