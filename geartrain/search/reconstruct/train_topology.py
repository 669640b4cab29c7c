"""Topology of a train: a rooted tree of arbors without the tooth counts of added wheels.

The arbors between two branchings form a chain and have no order. A topology is therefore an equivalence class of trains
that differ only in the order of arbors on chains and in the tooth counts of added wheels.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

from pydantic import TypeAdapter

from geartrain.search.reconstruct.reconstruction_problem import (
    PlacedWheel,
    ReconstructionProblem,
    SurvivingArbor,
)

# Passes of a path through a surviving arbor: its driven and its driving wheel.


ADDED = PlacedWheel(None, 0)
"""Added wheel whose tooth count is not yet chosen."""


@dataclass(frozen=True)
class ArborPass:
    """Pair of the driven and the driving wheel by which a path passes through one arbor."""

    driven: PlacedWheel | None
    """Driven wheel, by which the path enters the arbor; None on the input arbor."""
    driver: PlacedWheel | None
    """Driving wheel, by which the path leaves the arbor; None if the path ends at this arbor. In an idler, it is the
    driven wheel.
    """
    idle: int
    """Number of surviving wheels on the arbor that the path does not use."""
    idler: bool = False

    @property
    def added_drivers(self) -> int:
        """Number of added driving wheels on this arbor that affect the speed, 0 or 1. An idler does not affect the
        speed.
        """
        return int(self.driver == ADDED and not self.idler)

    @property
    def added_driven(self) -> int:
        """Number of added driven wheels on this arbor that affect the speed, 0 or 1."""
        return int(self.driven == ADDED and not self.idler)

    @property
    def added(self) -> int:
        """Number of added wheels on this arbor that the path uses."""
        return (self.driven == ADDED) + self.added_drivers


def arbor_passes(arbor: SurvivingArbor, problem: ReconstructionProblem) -> Iterator[ArborPass]:
    """Yield all pairs of a driven and a driving wheel by which a path can pass through a surviving arbor or end at it.

    On an arbor with surviving wheels, an added wheel can only be a driving wheel. On an arbor without surviving wheels,
    the driven wheel is added.
    """
    beside = problem.additions.on == "any" and problem.additions.wheels > 0
    is_input = arbor is problem.input
    drivens: list[PlacedWheel | None] = [None] if is_input else [ADDED] if beside else []
    if arbor.wheels and not is_input:
        drivens = [reading for wheel in arbor.wheels for reading in wheel.readings]
    for driven in drivens:
        others = [wheel for wheel in arbor.wheels if driven is None or wheel.name != driven.name]
        drivers = [reading for wheel in others for reading in wheel.readings]
        for driver in drivers:
            yield ArborPass(driven, driver, len(others) - 1)
        if beside:
            yield ArborPass(driven, ADDED, len(others))
        if problem.idlers and not is_input:
            yield ArborPass(driven, driven, len(others), idler=True)
        yield ArborPass(driven, None, len(others))


# A train without tooth counts of added wheels, whose arbors have any order between two branchings.


Dials = tuple[str, ...]
"""Sorted names of dials."""


@dataclass(frozen=True)
class Branching:
    """Arbor at which at least one path to a dial ends, or at which paths separate, or the input arbor; with the chains
    of arbors that its wheels drive.
    """

    name: str | None
    """Name of the surviving arbor; None for an added arbor."""
    driven: PlacedWheel | None
    """Driven wheel; `ADDED` if it is an added wheel, None on the input arbor."""
    here: Dials
    """Names of the dials whose pointers are on the arbor."""
    drives: tuple[tuple[PlacedWheel, tuple[Chain, ...]], ...] = ()
    """Driving wheels on the arbor, each with the chains that it drives."""
    passes: tuple[Chain, ...] = ()
    """Chains that the driven wheel also drives, as an idler."""

    def driven_chains(self) -> Iterator[tuple[PlacedWheel, Chain]]:
        """Yield each chain of arbors that this arbor drives, preceded by the wheel that drives it."""
        for wheel, chains in self.drives:
            yield from ((wheel, chain) for chain in chains)
        for chain in self.passes:
            assert self.driven is not None
            yield self.driven, chain

    def turned_dials(self, dials: Dials) -> Dials:
        """Return the given dials whose speeds depend on the tooth count of the driven wheel: all except the
        dials that this wheel drives as an idler.
        """
        passed = dials_of(self.passes)
        return tuple(dial for dial in dials if dial not in passed)


@dataclass(frozen=True)
class Chain:
    """Arbors that drive each other in series on the path to one or more dials. Paths neither end nor separate at these
    arbors; they do so at the end of the chain.
    """

    dials: Dials
    """Dials to which the chain leads."""
    through: tuple[tuple[str, ArborPass], ...]
    """Names of the surviving arbors on the chain, each with its driven and driving wheel."""
    compounds: int
    """Number of added arbors with two wheels on the chain."""
    idlers: int
    """Number of added arbors on the chain with one wheel that is both driven and driving (idlers)."""
    end: Branching | tuple[Chain, ...]
    """Branching at which the chain ends, or the chains that the last driving wheel of the chain drives."""

    @property
    def next_chains(self) -> tuple[Chain, ...]:
        """Chains that begin at the end of this chain."""
        return tuple(chain for _, chain in self.end.driven_chains()) if isinstance(self.end, Branching) else self.end


@dataclass(frozen=True)
class Topology:
    """Train without tooth counts of added wheels, with the quotient of these tooth counts that each dial requires."""

    root: Branching
    """Input arbor of the train."""
    wanted: tuple[tuple[str, Quotients], ...]
    """Pairs of a dial and the minimum and maximum quotient of the added wheels on its path."""

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """All chains in depth-first order from the input arbor."""
        found: list[Chain] = []
        waiting = [chain for _, chain in self.root.driven_chains()][::-1]
        while waiting:
            found.append(waiting.pop())
            waiting += found[-1].next_chains[::-1]
        return tuple(found)

    @cached_property
    def branchings(self) -> tuple[Branching, ...]:
        """All arbors at which paths to dials end or separate, in depth-first order from the input arbor."""
        return self.root, *(chain.end for chain in self.chains if isinstance(chain.end, Branching))

    @cached_property
    def added(self) -> AddedWheels:
        """Numbers of added wheels, grouped by the dials whose speeds they affect."""
        drivers, driven, idle = Counter[Dials](), Counter[Dials](), 0
        for chain in self.chains:
            drivers[chain.dials] += chain.compounds + sum(each.added_drivers for _, each in chain.through)
            driven[chain.dials] += chain.compounds + sum(each.added_driven for _, each in chain.through)
            idle += chain.idlers + sum(each.idler and each.driven == ADDED for _, each in chain.through)
            if isinstance(chain.end, Branching) and chain.end.driven == ADDED:
                turned = chain.end.turned_dials(chain.dials)
                driven[turned] += bool(turned)
                idle += not turned
        for branching in self.branchings:
            for wheel, chains in branching.drives:
                drivers[dials_of(chains)] += wheel == ADDED
        groups = tuple((dials, drivers[dials], driven[dials]) for dials in sorted({*drivers, *driven}))
        return AddedWheels(tuple(group for group in groups if group[1] or group[2]), idle)

    @cached_property
    def used(self) -> tuple[PlacedWheel, ...]:
        """Surviving wheels that mesh, each with its tooth count."""
        passes = (each for chain in self.chains for _, each in chain.through)
        wheels = [wheel for each in passes for wheel in (each.driven, each.driver)]
        for branching in self.branchings:
            wheels += [branching.driven, *(wheel for wheel, _ in branching.drives)]
        return tuple(wheel for wheel in dict.fromkeys(wheels) if wheel is not None and wheel != ADDED)

    @cached_property
    def added_arbors(self) -> int:
        """Number of added arbors."""
        return sum(chain.compounds + chain.idlers for chain in self.chains) + sum(
            branching.name is None for branching in self.branchings
        )


Quotients = tuple[Fraction, Fraction]
"""Minimum and maximum quotient of products of tooth counts. The two are equal if the quotient is exact."""


class AddedKind(NamedTuple):
    """Kind of added wheels. Wheels of one kind have the same effect on the speeds of dials and are interchangeable."""

    dials: Dials
    """Dials whose speeds the wheels affect; empty for wheels that affect no speed."""
    drives: bool
    """True for driving wheels on the path to these dials; False for driven wheels."""
    most: int | None = None
    """Maximum tooth count due to a mesh with a ring; None if only the general limit applies."""


@dataclass(frozen=True)
class AddedWheels:
    """Numbers of added wheels, grouped by the dials whose speeds they affect."""

    groups: tuple[tuple[Dials, int, int], ...]
    """Triples (dials, number of driving wheels, number of driven wheels)."""
    idle: int
    """Number of added wheels that affect no speed."""

    def without(self, kind: AddedKind) -> AddedWheels:
        """Return the numbers of added wheels after removal of one wheel of the given kind."""
        if not kind.dials:
            return AddedWheels(self.groups, self.idle - 1)
        left = [
            (dials, drivers - kind.drives, driven - (not kind.drives)) if dials == kind.dials else group
            for group in self.groups
            for dials, drivers, driven in [group]
        ]
        return AddedWheels(tuple(group for group in left if group[1] or group[2]), self.idle)

    @property
    def number(self) -> int:
        """Total number of added wheels."""
        return self.idle + sum(drivers + driven for _, drivers, driven in self.groups)


def dials_of(chains: tuple[Chain, ...]) -> Dials:
    """Return the sorted names of the dials to which the given chains lead."""
    return tuple(sorted(dial for chain in chains for dial in chain.dials))


TOPOLOGIES = TypeAdapter(Topology)
"""Converter of topologies to plain data and back, for transfer between processes and for journals."""
