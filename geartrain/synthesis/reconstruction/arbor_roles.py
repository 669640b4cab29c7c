"""What a surviving arbor is to all dials at once: which paths it is on, and by which of its wheels each goes on.

Sets of dials are whole numbers, a bit each. A role says nothing of counts, nor which wheel is driven: that is its
reading.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass, readings
from geartrain.synthesis.reconstruction.reconstruction_problem import (
    PlacedWheel,
    ReconstructionProblem,
    SearchedDial,
    SurvivingArbor,
)


class Role(NamedTuple):
    """What an arbor is to all dials.

    on      dials on whose paths it is
    blocks  dials that each surviving driving wheel in use leads to, sorted
    added   dials to which added wheels beside them lead
    here    dials that it shows
    """

    on: int
    blocks: tuple[int, ...] = ()
    added: int = 0
    here: int = 0

    @property
    def is_special(self) -> bool:
        """Whether an added wheel drives beside it, or a path ends at it."""
        return bool(self.added or self.here)

    @property
    def sets(self) -> tuple[int, ...]:
        """Sets of dials that are all that is below one of its wheels, or below itself."""
        return tuple({self.on, *self.blocks} - {0})

    def label(self, dial: int) -> int:
        """The same for dials whose paths it changes by the same quotient; 0 where it is not on the path."""
        if not self.on >> dial & 1:
            return 0
        return next((at for at, block in enumerate(self.blocks, 2) if block >> dial & 1), 1)


class Reading(NamedTuple):
    """Which wheels of a role there are, with their counts: the driven one, and one for each block."""

    driven: PlacedWheel | None
    drivers: tuple[PlacedWheel, ...]


@dataclass(frozen=True)
class RolesOfArbor:
    """An arbor with all that it may be.

    roles  all of them
    reads  by number of surviving driving wheels in use, the readings
    """

    arbor: SurvivingArbor
    roles: tuple[Role, ...]
    reads: dict[int, tuple[Reading, ...]]

    def of(self, role: Role) -> tuple[Reading, ...]:
        """Readings of a role."""
        return self.reads[len(role.blocks)] if role.on else (Reading(None, ()),)

    @property
    def ways(self) -> int:
        """The most readings of a role."""
        return max(len(self.of(role)) for role in self.roles)

    def passed(self, role: Role, reading: Reading, dial: int) -> ArborPass:
        """The way of a dial's path through it."""
        others = len(self.arbor.wheels) - (reading.driven is not None)
        if role.here >> dial & 1:
            return ArborPass(reading.driven, None, others)
        if role.added >> dial & 1:
            return ArborPass(reading.driven, ADDED, others)
        return ArborPass(reading.driven, reading.drivers[role.label(dial) - 2], others - 1)


def roles_of(arbor: SurvivingArbor, dials: tuple[SearchedDial, ...], problem: ReconstructionProblem) -> RolesOfArbor:
    """All that an arbor may be to some dials."""
    roles = tuple(dict.fromkeys(_roles(arbor, dials, problem)))
    used = {len(role.blocks) for role in roles if role.on}
    return RolesOfArbor(arbor, roles, {number: tuple(_readings(arbor, problem, number)) for number in used})


def _roles(arbor: SurvivingArbor, dials: tuple[SearchedDial, ...], problem: ReconstructionProblem) -> Iterator[Role]:
    every, is_input = (1 << len(dials)) - 1, arbor is problem.input
    must = sum(1 << at for at, dial in enumerate(dials) if dial.place == arbor.name)
    may = sum(1 << at for at, dial in enumerate(dials) if dial.place in (None, arbor.name))
    drivers = len(arbor.wheels) - (not is_input)
    fewest = drivers if problem.use == "wheels" else 0
    if problem.use == "some" and not is_input and not must:
        yield Role(0)
    for on in [every] if is_input else subsets(every):
        for here in subsets(on & may, empty=True):
            if must & ~here:
                continue
            for added in subsets(on & ~here if problem.additions.on == "any" else 0, empty=True):
                for blocks in set_partitions(on & ~here & ~added):
                    if fewest <= len(blocks) <= drivers:
                        yield Role(on, tuple(sorted(blocks)), added, here)


def _readings(arbor: SurvivingArbor, problem: ReconstructionProblem, number: int) -> Iterator[Reading]:
    for driven in [None] if arbor is problem.input else arbor.wheels:
        others = [wheel for wheel in arbor.wheels if wheel is not driven]
        for chosen in permutations(others, number):
            for one in [None] if driven is None else readings(driven):
                yield from (Reading(one, drivers) for drivers in product(*map(readings, chosen)))


# sets of dials


def subsets(whole: int, empty: bool = False) -> Iterator[int]:
    """All parts of a set, the whole first; nothing only if asked for."""
    part = whole
    while part:
        yield part
        part = (part - 1) & whole
    if empty:
        yield 0


def set_partitions(whole: int) -> Iterator[tuple[int, ...]]:
    """Each way to part a set."""
    if not whole:
        yield ()
        return
    first = whole & -whole
    for others in subsets(whole ^ first, empty=True):
        for blocks in set_partitions(whole ^ first ^ others):
            yield (first | others, *blocks)


def are_nested(one: int, other: int) -> bool:
    """Whether two sets are apart, or one is in the other: as what is below two places of a tree."""
    return one & other in (0, one, other)


def set_bits(sets: tuple[int, ...]) -> int:
    """A family of sets as one whole number: bit s - 1 for the set s."""
    found = 0
    for each in sets:
        found |= 1 << (each - 1)
    return found


def crossing_bits(sets: tuple[int, ...], every: int) -> int:
    """The same of all sets that are not nested with each of some."""
    return set_bits(tuple(one for one in range(1, every + 1) if not all(are_nested(one, each) for each in sets)))


def in_sets(sets: tuple[int, ...], dials: int) -> NDArray[np.int64]:
    """By set and dial, 1 where it is in it."""
    return np.array([[each >> dial & 1 for dial in range(dials)] for each in sets], dtype=np.int64).reshape(-1, dials)
