"""A skeleton in which every arbor and wheel has the name that it has in all of its trains.

Added arbors of a limb are named by their place on it, so that names do not depend on the order of the others.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from geartrain.synthesis.reconstruction.added_count_sums import AddedKind
from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.named_train import FreeNames
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel
from geartrain.synthesis.reconstruction.skeletons import Dials, Joint, Limb, Skeleton


class SkeletonWheel(NamedTuple):
    """A wheel by its name; of an added one the kind, None for one that survives."""

    name: str
    placed: PlacedWheel
    kind: AddedKind | None


class SkeletonArbor(NamedTuple):
    """An arbor by its name, whether it is added, and the wheels by which a path passes it: in an idler the same."""

    name: str
    added: bool
    driven: SkeletonWheel | None
    driver: SkeletonWheel | None

    @property
    def survivor(self) -> str | None:
        """The name of a surviving arbor."""
        return None if self.added else self.name


@dataclass(frozen=True, eq=False)
class NamedLimb:
    """Arbors in a row, and where they end.

    limb      without names
    through   surviving arbors
    added     by place among the added ones, the arbor as one with two wheels and as an idler
    end                 an arbor with its wheels and what each drives, or what hangs from the last driving wheel
    """

    limb: Limb
    through: tuple[SkeletonArbor, ...]
    added: tuple[tuple[SkeletonArbor, SkeletonArbor], ...]
    end: NamedJoint | tuple[NamedLimb, ...]

    @cached_property
    def surviving_wheels(self) -> frozenset[str]:
        """Names of the surviving wheels on it, and on all that is below."""
        wheels = [wheel for arbor in self.through for wheel in (arbor.driven, arbor.driver)]
        below = self.end
        if isinstance(below, NamedJoint):
            wheels += below.wheels()
            below = tuple(limb for _, limbs in below.hanging for limb in limbs)
        own = frozenset(wheel.name for wheel in wheels if wheel is not None and wheel.kind is None)
        return own.union(*(limb.surviving_wheels for limb in below))


@dataclass(frozen=True, eq=False)
class NamedJoint:
    """An arbor at which paths end or part.

    arbor     with the wheel that is driven
    here      dials that it shows
    hanging   wheels, each with what it drives
    """

    arbor: SkeletonArbor
    here: Dials
    hanging: tuple[tuple[SkeletonWheel, tuple[NamedLimb, ...]], ...]

    def wheels(self) -> Iterator[SkeletonWheel]:
        """Its wheels that mesh, each once."""
        if self.arbor.driven is not None:
            yield self.arbor.driven
        yield from (wheel for wheel, _ in self.hanging if wheel != self.arbor.driven)


def name_skeleton(
    skeleton: Skeleton, dials: Sequence[str], links: Collection[str], wheels: Collection[str]
) -> NamedJoint:
    """A skeleton with names, from its input on; the other arguments are those of `name_train`."""
    return _SkeletonNaming(tuple(dials), FreeNames(set(links), set(wheels))).joint(skeleton.root, ())


@dataclass
class _SkeletonNaming:
    dials: tuple[str, ...]
    free: FreeNames

    def joint(self, joint: Joint, dials: Dials) -> NamedJoint:
        """An arbor at which paths end or part; `dials` are all below it."""
        name = self.free.link(joint.here) if joint.name is None else joint.name
        past = {dial for limb in joint.passes for dial in limb.dials}
        turned = tuple(dial for dial in dials if dial not in past)
        driven = (
            None
            if joint.driven is None
            else self._wheel((name, joint.name is None), joint.driven, AddedKind(turned, False))
        )
        hanging: list[tuple[SkeletonWheel, tuple[Limb, ...]]] = []
        if joint.passes:
            assert driven is not None
            hanging.append((driven, joint.passes))
        for wheel, limbs in sorted(joint.drives, key=lambda one: self._first(one[1])):
            led_to = tuple(sorted(dial for limb in limbs for dial in limb.dials))
            hanging.append((self._wheel((name, joint.name is None), wheel, AddedKind(led_to, True)), limbs))
        named = self._limbs([limb for _, limbs in hanging for limb in limbs])
        below = tuple((wheel, tuple(named[id(limb)] for limb in limbs)) for wheel, limbs in hanging)
        return NamedJoint(SkeletonArbor(name, joint.name is None, driven, None), joint.here, below)

    def _limbs(self, limbs: Sequence[Limb]) -> dict[int, NamedLimb]:
        """Limbs by identity, named in the order of the first dial of each."""
        return {id(limb): self._limb(limb) for limb in sorted(limbs, key=lambda limb: self._first((limb,)))}

    def _first(self, limbs: Sequence[Limb]) -> int:
        return min(self.dials.index(dial) for limb in limbs for dial in limb.dials)

    def _limb(self, limb: Limb) -> NamedLimb:
        through = tuple(self._arbor(name, False, each, limb.dials) for name, each in limb.through)
        added = tuple(self._added(limb.dials) for _ in range(limb.compounds + limb.idlers))
        end = limb.end
        below = self.joint(end, limb.dials) if isinstance(end, Joint) else tuple(self._limbs(end).values())
        return NamedLimb(limb, through, added, below)

    def _added(self, dials: Dials) -> tuple[SkeletonArbor, SkeletonArbor]:
        name = self.free.link()
        compound = self._arbor(name, True, ArborPass(ADDED, ADDED, 0), dials)
        assert compound.driven is not None
        driven = compound.driven._replace(kind=AddedKind((), False))
        return compound, SkeletonArbor(name, True, driven, driven)

    def _arbor(self, name: str, added: bool, each: ArborPass, dials: Dials) -> SkeletonArbor:
        assert each.driven is not None
        assert each.driver is not None
        driven = self._wheel((name, added), each.driven, AddedKind(() if each.idler else dials, False))
        driver = driven if each.idler else self._wheel((name, added), each.driver, AddedKind(dials, True))
        return SkeletonArbor(name, added, driven, driver)

    def _wheel(self, arbor: tuple[str, bool], wheel: PlacedWheel, kind: AddedKind) -> SkeletonWheel:
        if wheel != ADDED:
            return SkeletonWheel(wheel.name or "", wheel, None)
        link, added = arbor
        return SkeletonWheel(self.free.wheel(link, not added), wheel, kind)
