"""Orders of the arbors on chains, and the trains that result from these orders and from tooth counts."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from geartrain.search.reconstruct.added_counts import Counts
from geartrain.search.reconstruct.reconstruction_problem import Arbor, PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.train_topology import (
    ADDED,
    AddedKind,
    AddedWheels,
    ArborPass,
    Branching,
    Chain,
    Dials,
    Topology,
    dials_of,
)

# A ring meshes only with external wheels of fewer teeth. The order of arbors may therefore limit added tooth counts.


Rings = frozenset[str]
"""Names of the rings, which are wheels with internal teeth."""


def may_mesh(wheel: PlacedWheel, mate: PlacedWheel, rings: Rings) -> bool:
    """Return whether two wheels can mesh. At most one of them may be a ring, and the mate of a ring must have fewer
    teeth.

    An added wheel without a tooth count can mesh with any ring.
    """
    internal, mate_internal = wheel.name in rings, mate.name in rings
    if internal == mate_internal:
        return not internal
    ring, inside = (wheel, mate) if internal else (mate, wheel)
    return inside.teeth < ring.teeth


class CountTokens:
    """Negative numbers (tokens) that replace the tooth counts of added wheels. Each token identifies one wheel."""

    def __init__(self, added: AddedWheels) -> None:
        self._owners: list[tuple[Dials, bool]] = []
        self.counts = {
            dials: (self._tokens(dials, True, drivers), self._tokens(dials, False, driven))
            for dials, drivers, driven in added.groups
        }
        self.idle = self._tokens((), False, added.idle)

    def _tokens(self, dials: Dials, drives: bool, wheels: int) -> tuple[int, ...]:
        first = len(self._owners)
        self._owners += [(dials, drives)] * wheels
        return tuple(-at - 1 for at in range(first, first + wheels))

    def kinds(self, arbor: Arbor, rings: Rings, maximum: int) -> dict[int, AddedKind]:
        """Return the kind of each added wheel, keyed by the token (a negative number) that replaces its tooth count in
        the train.

        maximum   maximum tooth count of an added wheel; it is reduced for a wheel that meshes with a smaller ring
        """
        most: dict[int, int] = {}
        for pair in _meshes(arbor):
            for ring, inside in (pair, pair[::-1]):
                if ring.name in rings and inside.teeth < 0:
                    most[inside.teeth] = min(most.get(inside.teeth, maximum), ring.teeth - 1)
        limits = {token: count for token, count in most.items() if count < maximum}
        return {-at: AddedKind(*owner, limits.get(-at)) for at, owner in enumerate(self._owners, 1)}


def _meshes(arbor: Arbor) -> Iterator[tuple[PlacedWheel, PlacedWheel]]:
    for wheel, child in arbor.driven_arbors():
        assert child.driven is not None
        yield wheel, child.driven
        yield from _meshes(child)


# Orders of the arbors of a topology, and the trains that result from orders and tooth counts.


_Step = tuple[str | None, ArborPass]
_COMPOUND: _Step = (None, ArborPass(ADDED, ADDED, 0))
_IDLER: _Step = (None, ArborPass(ADDED, ADDED, 0, idler=True))
_Driving = tuple[str | None, PlacedWheel]
"""Name of an arbor (None for an added arbor), and the driving wheel on this arbor."""
_Pairs = frozenset[frozenset[str]]


def _known_pairs(
    problem: ReconstructionProblem, driving: _Driving, arbor: str | None, driven: PlacedWheel | None
) -> _Pairs | None:
    """Return the set of the known meshing pairs of wheels that a mesh forms, which contains one pair or none. Return
    None if the known facts exclude the mesh.

    arbor, driven  name of the driven arbor, and driven wheel
    """
    assert driven is not None
    if _pair(driving[0], arbor) in problem.coaxial or (pair := _pair(driving[1].name, driven.name)) in problem.apart:
        return None
    if not may_mesh(driving[1], driven, problem.rings):
        return None
    return frozenset({pair}) & problem.meshes if pair is not None else frozenset()


def _pair(one: str | None, other: str | None) -> frozenset[str] | None:
    return None if one is None or other is None else frozenset((one, other))


# orders


def _sequences(through: tuple[_Step, ...], compounds: int, idlers: int) -> Iterator[tuple[_Step, ...]]:
    """Yield each order of the arbors on a chain.

    through     surviving arbors, each with its driven and its driving wheel
    compounds   number of added arbors with two wheels, which are interchangeable
    idlers      number of added arbors with one wheel, which are interchangeable
    """
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


def arranged(
    topology: Topology, counts: Counts, idle: tuple[int, ...], problem: ReconstructionProblem | None
) -> Iterator[Arbor]:
    """Yield the trains of a topology with given tooth counts of the added wheels, one train for each order of arbors
    that agrees with the known facts about meshes. If `problem` is None, all orders are permitted.

    counts   tooth counts of the added wheels that affect speeds
    idle     tooth counts of the added wheels that affect no speed
    """
    chains = topology.chains
    for chosen in product(*(_sequences(chain.through, chain.compounds, chain.idlers) for chain in chains)):
        orders = {id(chain): steps for chain, steps in zip(chains, chosen, strict=True)}
        if problem is None or _agrees(topology, orders, problem):
            arbor = _Assembly(orders, counts, idle).branching(topology.root, ())
            # again, because added wheels have tooth counts only now
            if problem is None or all(may_mesh(wheel, mate, problem.rings) for wheel, mate in _meshes(arbor)):
                yield arbor


def _agrees(topology: Topology, orders: dict[int, tuple[_Step, ...]], problem: ReconstructionProblem) -> bool:
    """Return whether the meshes of a topology with given orders of arbors agree with the known facts."""
    found: _Pairs = frozenset()
    waiting = [(chain, (topology.root.name, driver)) for driver, chain in topology.root.driven_chains()]
    while waiting:
        chain, driving = waiting.pop()
        end = chain.end
        steps = [(name, each.driven, each.driver) for name, each in orders[id(chain)]]
        if isinstance(end, Branching):
            steps.append((end.name, end.driven, None))
        for name, driven, driver in steps:
            met = _known_pairs(problem, driving, name, driven)
            if met is None:
                return False
            found |= met
            if driver is not None:
                driving = name, driver
        if isinstance(end, Branching):
            waiting += [(each, (end.name, driver)) for driver, each in end.driven_chains()]
        else:
            waiting += [(each, driving) for each in end]
    return found == problem.meshes  # every known mesh must be in the train


class _Assembly:
    """Builder of a train, which assigns tooth counts to the added wheels of a topology one by one."""

    def __init__(self, orders: dict[int, tuple[_Step, ...]], counts: Counts, idle: tuple[int, ...]) -> None:
        self.orders = orders
        self.drivers = {dials: iter(drivers) for dials, (drivers, _) in counts.items()}
        self.driven = {dials: iter(driven) for dials, (_, driven) in counts.items()}
        self.idle = iter(idle)

    def branching(self, branching: Branching, dials: Dials) -> Arbor:
        """Return the arbor that corresponds to a branching of the topology, with all arbors that it drives. `dials`
        contains all dials to which it leads.
        """
        driven = branching.driven
        if driven == ADDED:
            turned = branching.turned_dials(dials)
            driven = PlacedWheel(None, next(self.driven[turned]) if turned else next(self.idle))
        drives = []
        for wheel, chains in branching.drives:
            driver = PlacedWheel(None, next(self.drivers[dials_of(chains)])) if wheel == ADDED else wheel
            drives.append((driver, self.chains(chains)))
        return Arbor(branching.name, driven, branching.here, tuple(drives), self.chains(branching.passes))

    def chains(self, chains: tuple[Chain, ...]) -> tuple[Arbor, ...]:
        """Return the arbors that one wheel drives, if it drives the given chains of arbors."""
        return tuple(arbor for chain in chains for arbor in self.chain(chain))

    def chain(self, chain: Chain) -> tuple[Arbor, ...]:
        """Return the first arbor of a chain, as a tuple with one element, with all arbors that it drives. If the chain
        has no arbors of its own, return the arbors at its end.
        """
        end = chain.end
        below = (self.branching(end, chain.dials),) if isinstance(end, Branching) else self.chains(end)
        # from the end, because an arbor contains the arbors that it drives
        for name, each in reversed(self.orders[id(chain)]):
            if each.idler:
                driven = PlacedWheel(None, next(self.idle)) if each.driven == ADDED else each.driven
                below = (Arbor(name, driven, (), (), below),)
                continue
            driven = PlacedWheel(None, next(self.driven[chain.dials])) if each.driven == ADDED else each.driven
            driver = PlacedWheel(None, next(self.drivers[chain.dials])) if each.driver == ADDED else each.driver
            assert driver is not None
            below = (Arbor(name, driven, (), ((driver, below),)),)
        return below
