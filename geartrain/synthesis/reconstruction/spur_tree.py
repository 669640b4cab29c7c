"""A part of a train that a reconstruction can find: a tree of arbors on the frame or on one carrier.

Spur wheels and rings join its arbors; those that a pin in a slot joins are one arbor of it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

from geartrain.synthesis.reconstruction.base_link import BaseLink
from geartrain.synthesis.reconstruction.joined_arbors import Joined
from geartrain.synthesis.reconstruction.mesh_walk import DrivenArbor
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel
from geartrain.train import Train


@dataclass(frozen=True)
class SpurTree:
    """Arbors of a train from the one at which a part of it begins to its pointers.

    base      what bears the arbors, and at what speed the first of them turns
    driven    how every other arbor is driven; parents come first
    joined    by arbor that stands for several links, all of them, itself first
    pointers  name of an output, or of a link whose speed is given, -> its arbor
    counts    teeth of every wheel that meshes
    teeth     the fewest and the most that an added wheel may have
    """

    train: Train
    base: BaseLink
    driven: Mapping[str, DrivenArbor]
    joined: Joined
    pointers: Mapping[str, str]
    counts: Mapping[str, int]
    teeth: tuple[int, int]

    @property
    def source(self) -> str:
        """The arbor at which it begins."""
        return self.base.source

    @property
    def arbors(self) -> tuple[str, ...]:
        """Every arbor, the first one first."""
        return self.source, *self.driven

    @property
    def has_idlers(self) -> bool:
        """Whether a driven wheel drives."""
        driving = {mesh.driving for mesh in self.driven.values()}
        return any(mesh.driven in driving for mesh in self.driven.values())

    @cached_property
    def able(self) -> tuple[str, ...]:
        """Arbors that can be lost: all driven ones but those with a ring, for no ring is added."""
        wheels = self.train.wheels
        return tuple(link for link in self.driven if not any(wheels[name][1].internal for name in self.wheels_of(link)))

    @property
    def name(self) -> str:
        """What part of the train it is; nothing for that which begins at the input, on the frame."""
        if self.base.is_carrier:
            return f"on {self.base.name}, from {self.source}"
        return "" if self.source in self.train.case(None).inputs else f"from {self.source}"

    def links_of(self, arbor: str) -> tuple[str, ...]:
        """The links that an arbor stands for; those that stand still all are the frame."""
        if arbor == self.train.frame:
            return arbor, *self.train.fixed
        return self.joined.get(arbor, (arbor,))

    def arbor_of(self, link: str) -> str:
        """The arbor that stands for a link: mostly itself."""
        return next((arbor for arbor, links in self.joined.items() if link in links), link)

    def link_of(self, pointer: str) -> str:
        """The link whose speed a pointer shows."""
        output = self.train.case(None).outputs.get(pointer)
        return pointer if output is None else output.of or pointer

    def wheels_of(self, arbor: str) -> tuple[str, ...]:
        """The wheels of an arbor that mesh, as declared."""
        links = self.links_of(arbor)
        return tuple(name for link in links for name in self.train.links[link].wheels if name in self.counts)

    def meshes(self, lost: Collection[str] = ()) -> tuple[tuple[str, str], ...]:
        """Pairs of wheels that mesh, the driving one first, but for those of arbors that are lost."""
        return tuple(
            (mesh.driving, mesh.driven)
            for arbor, mesh in self.driven.items()
            if arbor not in lost and mesh.parent not in lost
        )

    def arbor(self, lost: Collection[str] = (), link: str | None = None) -> Arbor:
        """The tree as a candidate.

        lost   arbors that did not survive, which have no names then
        link   the arbor at which it begins; default the first
        """
        link = self.source if link is None else link
        own = self.driven[link].driven if link in self.driven else None
        below: dict[str, list[Arbor]] = {name: [] for name in self.wheels_of(link)}
        for child, mesh in self.driven.items():
            if mesh.parent == link:
                below[mesh.driving].append(self.arbor(lost, child))

        def placed(wheel: str) -> PlacedWheel:
            return PlacedWheel(None if link in lost else wheel, self.counts[wheel])

        return Arbor(
            None if link in lost else link,
            None if own is None else placed(own),
            tuple(sorted(name for name, at in self.pointers.items() if at == link)),
            tuple((placed(wheel), tuple(children)) for wheel, children in below.items() if children and wheel != own),
            () if own is None else tuple(below[own]),
        )
