"""Names of the arbors and wheels of a candidate, and names for a topology that are common to all of its trains."""

from __future__ import annotations

from collections.abc import Container, Iterator
from dataclasses import dataclass

from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel
from geartrain.train import Train

# Canonical names of the arbors and wheels of a candidate, in an order that does not depend on tooth counts: branches
# are sorted by the first pointer to which each leads. An added arbor is named after the first pointer that it shows,
# such as `new_sun`, else `new1`, `new2`, ...; its wheels are `new_sun1` or `new1_1`, the driven wheel first. Added
# wheels on a surviving arbor `m` are `m_new1`, `m_new2`, ..., because a name such as `m3` would be confused with
# another wheel in the literature. Wheels with the same function in different candidates therefore have the same name,
# whatever their counts.


_ADDED = "new"


@dataclass(frozen=True)
class NamedWheel:
    """Wheel of a candidate: its name, its tooth count, and whether it is added."""

    name: str
    teeth: int
    added: bool


@dataclass(frozen=True)
class NamedArbor:
    """Arbor of a candidate: its name, its wheels, and the subtree that it drives."""

    name: str
    added: bool
    driven: NamedWheel | None
    """Driven wheel of the arbor; None for the input arbor."""
    dials: tuple[str, ...]
    """Sorted names of the dials whose pointers are on the arbor."""
    drives: tuple[tuple[NamedWheel, NamedArbor], ...]
    """Pairs of a driving wheel on this arbor and an arbor that it drives."""

    def arbors(self) -> Iterator[NamedArbor]:
        """Yield this arbor and all arbors of its subtree in depth-first order."""
        yield self
        for _, arbor in self.drives:
            yield from arbor.arbors()

    def wheels(self) -> tuple[NamedWheel, ...]:
        """Return the meshing wheels on this arbor without repetition, the driven wheel first."""
        own = {self.driven.name: self.driven} if self.driven is not None else {}
        return tuple((own | {wheel.name: wheel for wheel, _ in self.drives}).values())

    def added_wheels(self) -> list[NamedWheel]:
        """Return the added wheels of the subtree in depth-first order of their arbors."""
        return [wheel for arbor in self.arbors() for wheel in arbor.wheels() if wheel.added]

    def meshes(self) -> Iterator[tuple[NamedArbor, NamedWheel, NamedArbor]]:
        """Yield every mesh in the subtree as (driving arbor, driving wheel, driven arbor), in the order of `arbors`."""
        for wheel, arbor in self.drives:
            yield self, wheel, arbor
            yield from arbor.meshes()


def named_candidate(evidence: Train, arbor: Arbor) -> NamedArbor:
    """Return a candidate with the names of arbors and wheels that are used in its declaration.

    arbor   input arbor of the candidate
    """
    return _Naming(tuple(evidence.outputs), {*evidence.links, evidence.frame}, set(evidence.wheels)).name(arbor)


def free_name(name: str, kind: str, taken: Container[str]) -> str:
    """Return `name` if it is not in `taken`. If it is, return the name extended by `kind` and, if necessary, by a
    number.
    """
    if name not in taken:
        return name
    longer = f"{name}_{kind}"
    return longer if longer not in taken else numbered(f"{longer}_", taken)


def numbered(stem: str, taken: Container[str]) -> str:
    """Return `stem` followed by the smallest positive integer for which the result is not in `taken`."""
    number = 1
    while f"{stem}{number}" in taken:
        number += 1
    return f"{stem}{number}"


@dataclass
class _Naming:
    """Assignment of names to the arbors of a candidate, in depth-first order from the input arbor."""

    dials: tuple[str, ...]
    """Names of all dials, in the order of the evidence."""
    links: set[str]
    """Names of arbors that are already in use."""
    wheels: set[str]
    """Names of wheels that are already in use."""

    def name(self, arbor: Arbor) -> NamedArbor:
        """Return a copy of an arbor and of all arbors that it drives, in which every arbor and wheel has a name."""
        link = arbor.name
        if link is None:
            wanted = f"{_ADDED}_{arbor.dials[0]}" if arbor.dials else numbered(_ADDED, self.links)
            link = free_name(wanted, "arbor", self.links)
            self.links.add(link)
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
        """Return the smallest index of a dial in the subtree of an arbor."""
        shown = (self.dials.index(dial) for each in arbor.arbors() for dial in each.dials)
        return min(shown, default=len(self.dials))

    def _wheel(self, arbor: Arbor, link: str, wheel: PlacedWheel) -> NamedWheel:
        """Return a wheel with its name; `link` is the name of its arbor."""
        if wheel.name is not None:
            return NamedWheel(wheel.name, wheel.teeth, False)
        # the underscore separates two numbers, as in `new1_2`
        stem = f"{link}_{_ADDED}" if arbor.name is not None else f"{link}_" if link[-1].isdigit() else link
        name = numbered(stem, self.wheels)
        self.wheels.add(name)
        return NamedWheel(name, wheel.teeth, True)
