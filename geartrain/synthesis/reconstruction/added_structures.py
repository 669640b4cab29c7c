"""Which added wheels there may be: which dials are below each, whether it drives, and beside what it stands.

An added wheel is on a new arbor, as its driven wheel or as one that drives, or it drives beside surviving ones. So all
are found by sharing out their number.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache, cached_property
from typing import NamedTuple

from geartrain.synthesis.reconstruction.arbor_roles import (
    Role,
    RolesOfArbor,
    are_nested,
    crossing_bits,
    set_bits,
    set_partitions,
    subsets,
)
from geartrain.synthesis.reconstruction.reconstruction_problem import NEW, ReconstructionProblem, SearchedDial


class PlacedSet(NamedTuple):
    """An added wheel: the dials below it, and whether it drives or is driven."""

    dials: int
    drives: bool


AddedSets = tuple[PlacedSet, ...]
"""All added wheels, sorted."""

Core = tuple[Role, tuple[Role, ...]]
"""What the input arbor is, and what those arbors are at which paths end or go on by added wheels, sorted."""


class _Part(NamedTuple):
    """A new arbor with its wheels, or a wheel beside surviving ones; `here`, dials that the arbor shows."""

    wheels: AddedSets
    here: int
    beside: int


class _Nested(NamedTuple):
    """Families of sets: those of a tree, and those that cross one of them."""

    sets: int
    crossing: int


class AddedStructures:
    """All added wheels of a question, with the surviving arbors at which they may be.

    Parameters
    ----------
    arbors : sequence of RolesOfArbor
        The input first.
    """

    def __init__(
        self, problem: ReconstructionProblem, dials: Sequence[SearchedDial], arbors: Sequence[RolesOfArbor]
    ) -> None:
        self.problem, self.arbors = problem, arbors
        self.every = (1 << len(dials)) - 1
        self._lost = sum(1 << at for at, dial in enumerate(dials) if dial.place == NEW)
        self._may_be_lost = sum(1 << at for at, dial in enumerate(dials) if dial.place in (None, NEW))
        self._cores: dict[tuple[tuple[int, ...], int], tuple[tuple[Core, int], ...]] = {}

    @cache  # noqa: B019 -- lives as long as the search
    def of(self, wheels: int) -> dict[AddedSets, tuple[Core, ...]]:
        """All with just so many added wheels, sorted; with each the cores that it may have."""
        found: dict[AddedSets, dict[Core, None]] = defaultdict(dict)
        for parts in self._shared_out(0, wheels, 0, ()):
            added = tuple(sorted(wheel for part in parts for wheel in part.wheels))
            beside = tuple(sorted(part.beside for part in parts if part.beside))
            here = sum(part.here for part in parts)
            crossing = crossing_bits(tuple({wheel.dials for wheel in added}), self.every)
            for core, sets in self._cores_of(beside, self.every & ~here):
                if not sets & crossing:
                    found[added][core] = None
        return {added: tuple(found[added]) for added in sorted(found)}

    @cached_property
    def _parts(self) -> tuple[_Part, ...]:
        return tuple(self._all_parts())

    def _all_parts(self) -> Iterator[_Part]:
        for dials in range(1, self.every + 1):
            for here in subsets(dials & self._may_be_lost, empty=True):
                for blocks in set_partitions(dials & ~here):
                    driving = tuple(PlacedSet(block, True) for block in blocks)
                    yield _Part((PlacedSet(dials, False), *driving), here, 0)
            if self.problem.additions.on == "any":
                yield _Part((PlacedSet(dials, True),), 0, dials)

    def _shared_out(self, start: int, wheels: int, here: int, parts: tuple[_Part, ...]) -> Iterator[tuple[_Part, ...]]:
        """Parts with so many wheels more, each from a place on so that none comes in another order again."""
        if not wheels:
            if not self._lost & ~here:
                yield parts
            return
        limit = self.problem.additions.arbors
        for at in range(start, len(self._parts)):
            part = self._parts[at]
            if len(part.wheels) > wheels or part.here & here:
                continue
            if not part.beside and limit is not None and sum(not one.beside for one in parts) >= limit:
                continue
            before = (wheel.dials for one in parts for wheel in one.wheels)
            if all(are_nested(wheel.dials, other) for other in before for wheel in part.wheels):
                yield from self._shared_out(at, wheels - len(part.wheels), here | part.here, (*parts, part))

    # at which surviving arbors

    def _cores_of(self, beside: tuple[int, ...], here: int) -> tuple[tuple[Core, int], ...]:
        """All ways to put wheels beside surviving ones, and to show dials at surviving arbors; with their sets."""
        key = beside, here
        if key not in self._cores:
            found: dict[Core, int] = {}
            for root in self.arbors[0].roles:
                if root.here & ~here:
                    continue
                for rest in _rests(beside, root.added):
                    tree = _Nested(set_bits(root.sets), crossing_bits(root.sets, self.every))
                    for roles, sets in self._special(0, rest, here & ~root.here, (), tree):
                        found[root, roles] = sets
            self._cores[key] = tuple(found.items())
        return self._cores[key]

    @cached_property
    def _special_roles(self) -> tuple[tuple[Role, int, _Nested], ...]:
        """Each, sorted, with the number of arbors that may have it, and its sets."""
        number: dict[Role, int] = defaultdict(int)
        for arbor in self.arbors[1:]:
            for role in arbor.roles:
                number[role] += role.is_special
        return tuple(
            (role, most, _Nested(set_bits(role.sets), crossing_bits(role.sets, self.every)))
            for role, most in sorted(number.items())
            if most
        )

    def _special(
        self, start: int, beside: tuple[int, ...], here: int, roles: tuple[Role, ...], tree: _Nested
    ) -> Iterator[tuple[tuple[Role, ...], int]]:
        if not beside and not here:
            yield roles, tree.sets
            return
        for at in range(start, len(self._special_roles)):
            role, most, own = self._special_roles[at]
            if role.here & ~here or tree.crossing & own.sets or roles.count(role) == most:
                continue
            for rest in _rests(beside, role.added):
                both = _Nested(tree.sets | own.sets, tree.crossing | own.crossing)
                yield from self._special(at, rest, here & ~role.here, (*roles, role), both)


def _rests(sets: tuple[int, ...], wanted: int) -> tuple[tuple[int, ...], ...]:
    """What is left of sorted sets when some that make up a wanted one, each dial in one of them, are taken out."""
    if not wanted:
        return (sets,)
    found: dict[tuple[int, ...], None] = {}
    first = wanted & -wanted
    for at, one in enumerate(sets):
        if one & first and not one & ~wanted:
            for rest in _rests(sets[:at] + sets[at + 1 :], wanted & ~one):
                found[rest] = None
    return tuple(found)
