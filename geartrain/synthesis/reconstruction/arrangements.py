"""The orders in which the arbors of a skeleton may stand, and the trains that they and the counts make."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from geartrain.synthesis.reconstruction.added_counts import Counts
from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.ring_meshes import Rings, may_mesh, rings_mesh
from geartrain.synthesis.reconstruction.skeletons import Dials, Joint, Limb, Skeleton

_Step = tuple[str | None, ArborPass]
COMPOUND, IDLER = -1, -2
_COMPOUND: _Step = (None, ArborPass(ADDED, ADDED, 0))
_IDLER: _Step = (None, ArborPass(ADDED, ADDED, 0, idler=True))
_Driving = tuple[str | None, PlacedWheel]
"""An arbor by name, None for an added one, and the wheel on it that drives."""
_Pairs = frozenset[frozenset[str]]


@dataclass(frozen=True)
class MeshFacts:
    """What is known of meshes: pairs of wheels that mesh, that do not, pairs of arbors that do not, and rings."""

    meshes: _Pairs = frozenset()
    apart: _Pairs = frozenset()
    coaxial: _Pairs = frozenset()
    rings: Rings = frozenset()

    @staticmethod
    def of(problem: ReconstructionProblem) -> MeshFacts:
        """Those of a question."""
        return MeshFacts(problem.meshes, problem.apart, problem.coaxial, problem.rings)

    @property
    def are_any(self) -> bool:
        """Whether anything is known."""
        return bool(self.meshes or self.apart or self.coaxial or self.rings)

    def met(self, driving: _Driving, arbor: str | None, driven: PlacedWheel | None) -> _Pairs | None:
        """Which meshes that must be, a mesh is; None if it must not be."""
        assert driven is not None
        if _pair(driving[0], arbor) in self.coaxial or (pair := _pair(driving[1].name, driven.name)) in self.apart:
            return None
        if not may_mesh(driving[1], driven, self.rings):
            return None
        return frozenset({pair}) & self.meshes if pair is not None else frozenset()


def _pair(one: str | None, other: str | None) -> frozenset[str] | None:
    return None if one is None or other is None else frozenset((one, other))


# orders


def _hanging(joint: Joint) -> Iterator[tuple[PlacedWheel, tuple[Limb, ...]]]:
    yield from joint.drives
    if joint.passes:
        assert joint.driven is not None
        yield joint.driven, joint.passes


def _met_along(steps: tuple[_Step, ...], driving: _Driving, facts: MeshFacts) -> tuple[_Pairs | None, _Driving]:
    found: _Pairs = frozenset()
    for name, each in steps:
        met = facts.met(driving, name, each.driven)
        if met is None:
            return None, driving
        found |= met
        assert each.driver is not None
        driving = name, each.driver
    return found, driving


def sequences(limb: Limb) -> Iterator[tuple[_Step, ...]]:
    """The arbors of a limb in each order; added ones are told apart by their kind only."""
    yield from _sequences(limb.through, limb.compounds, limb.idlers)


def _sequences(through: tuple[_Step, ...], compounds: int, idlers: int) -> Iterator[tuple[_Step, ...]]:
    if not through and not compounds and not idlers:
        yield ()
    for at, step in enumerate(through):
        for others in _sequences(through[:at] + through[at + 1 :], compounds, idlers):
            yield (step, *others)
    if compounds:
        for others in _sequences(through, compounds - 1, idlers):
            yield (_COMPOUND, *others)
    if idlers:
        for others in _sequences(through, compounds, idlers - 1):
            yield (_IDLER, *others)


# trains


def arranged(skeleton: Skeleton, counts: Counts, idle: tuple[int, ...], facts: MeshFacts) -> Iterator[Arbor]:
    """The trains of a skeleton whose added wheels have these counts, one an order."""
    limbs = skeleton.limbs
    for chosen in product(*map(sequences, limbs)):
        orders = {id(limb): steps for limb, steps in zip(limbs, chosen, strict=True)}
        if not facts.are_any or _agrees(skeleton, orders, facts):
            arbor = _Assembly(orders, counts, idle).joint(skeleton.root, ())
            if rings_mesh(arbor, facts.rings):
                yield arbor


def in_order(skeleton: Skeleton, orders: Mapping[int, list[int]], counts: Counts, idle: tuple[int, ...]) -> Arbor:
    """The train of one order.

    orders   by `id` of a limb the arbors on it, from the driving wheel on: the number of a surviving one, `COMPOUND`
             for an added one with two wheels, or `IDLER`
    """
    added = {COMPOUND: _COMPOUND, IDLER: _IDLER}
    steps = {
        id(limb): tuple(added[at] if at in added else limb.through[at] for at in orders[id(limb)])
        for limb in skeleton.limbs
    }
    return _Assembly(steps, counts, idle).joint(skeleton.root, ())


def _agrees(skeleton: Skeleton, orders: dict[int, tuple[_Step, ...]], facts: MeshFacts) -> bool:
    found: _Pairs = frozenset()
    waiting = [(limb, (skeleton.root.name, driver)) for driver, limbs in skeleton.root.drives for limb in limbs]
    while waiting:
        limb, driving = waiting.pop()
        met, last = _met_along(orders[id(limb)], driving, facts)
        if met is None:
            return False
        found |= met
        if isinstance(limb.end, Joint):
            at_end = facts.met(last, limb.end.name, limb.end.driven)
            if at_end is None:
                return False
            found |= at_end
            end = limb.end
            waiting += [(each, (end.name, driver)) for driver, limbs in _hanging(end) for each in limbs]
        else:
            waiting += [(each, last) for each in limb.end]
    return found == facts.meshes


class _Assembly:
    """Puts counts into the added wheels of a skeleton, one after the other."""

    def __init__(self, orders: dict[int, tuple[_Step, ...]], counts: Counts, idle: tuple[int, ...]) -> None:
        self.orders = orders
        self.drivers = {dials: iter(drivers) for dials, (drivers, _) in counts.items()}
        self.driven = {dials: iter(driven) for dials, (_, driven) in counts.items()}
        self.idle = iter(idle)

    def joint(self, joint: Joint, dials: Dials) -> Arbor:
        """An arbor at which paths end or part, with all that hangs from it; `dials` are all below it."""
        past = {dial for limb in joint.passes for dial in limb.dials}
        driven = joint.driven
        if driven == ADDED:
            turned = tuple(dial for dial in dials if dial not in past)
            driven = PlacedWheel(None, next(self.driven[turned]) if turned else next(self.idle))
        drives = []
        for wheel, limbs in joint.drives:
            led_to = tuple(sorted(dial for limb in limbs for dial in limb.dials))
            driver = PlacedWheel(None, next(self.drivers[led_to])) if wheel == ADDED else wheel
            drives.append((driver, self.limbs(limbs)))
        return Arbor(joint.name, driven, joint.here, tuple(drives), self.limbs(joint.passes))

    def limbs(self, limbs: tuple[Limb, ...]) -> tuple[Arbor, ...]:
        """All that one wheel drives."""
        return tuple(arbor for limb in limbs for arbor in self.limb(limb))

    def limb(self, limb: Limb) -> tuple[Arbor, ...]:
        """The arbors of a limb, the first one with all others below it."""
        end = limb.end
        below = (self.joint(end, limb.dials),) if isinstance(end, Joint) else self.limbs(end)
        for name, each in reversed(self.orders[id(limb)]):
            if each.idler:
                driven = PlacedWheel(None, next(self.idle)) if each.driven == ADDED else each.driven
                below = (Arbor(name, driven, (), (), below),)
                continue
            driven = PlacedWheel(None, next(self.driven[limb.dials])) if each.driven == ADDED else each.driven
            driver = PlacedWheel(None, next(self.drivers[limb.dials])) if each.driver == ADDED else each.driver
            assert driver is not None
            below = (Arbor(name, driven, (), ((driver, below),)),)
        return below
