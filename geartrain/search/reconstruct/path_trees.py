"""Recursive enumeration of all topologies that have one given path for each dial. Each topology occurs once.

Surviving arbors that are common to two paths precede the branching at which the paths separate. The remaining choices
are the number of added arbors on each chain, the added arbors at which paths separate, and the added driving wheels
that are common to several paths.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from itertools import combinations, product
from operator import and_, or_
from typing import NamedTuple, TypeVar

from geartrain.numerics.graphs import joined_groups
from geartrain.search.reconstruct.path_lists import PathList
from geartrain.search.reconstruct.reconstruction_problem import PlacedWheel, ReconstructionProblem
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, Branching, Chain, Dials, Topology

# Partitions of the dials of a branching: which dials it shows, and to which its wheels lead.


HERE = "="
IDLER = "~"
BESIDE = "+"
"""Exits by which a path can leave an arbor, other than surviving driving wheels: the dial on the arbor, the driven
wheel (as an idler), or an added wheel.
"""

Block = tuple[str, Dials]
"""Exit of an arbor, and the dials to which this exit leads."""


def exit_of(each: ArborPass) -> str:
    """Return the wheel by which a path leaves an arbor, or `HERE` if the path ends at the arbor. An added wheel is
    represented by `BESIDE`, and a driven wheel that also drives by `IDLER`.
    """
    if each.driver is None:
        return HERE
    if each.idler:
        return IDLER
    return BESIDE if each.driver.name is None else each.driver.name


def dial_partitions(
    dials: Dials, ways: Mapping[str, tuple[str, ...]], arbors: Mapping[str, int]
) -> Iterator[tuple[Dials, tuple[Block, ...]]]:
    """Yield each way to divide dials among an arbor: the dials whose pointers it carries, and the dials to which each
    of its driving wheels leads. Each added wheel leads to a different set of dials.

    ways     wheels by which the path to each dial may leave the arbor, as returned by `exit_of`
    arbors   bit mask of the surviving arbors on the path to each dial; dials with a common arbor stay together
    """
    for chosen in product(*(ways[dial] for dial in dials)):
        by_way: dict[str, list[str]] = {}
        for dial, way in zip(dials, chosen, strict=True):
            by_way.setdefault(way, []).append(dial)
        named = tuple((way, tuple(block)) for way, block in by_way.items() if way not in (HERE, BESIDE))
        for blocks in partitions(tuple(by_way.get(BESIDE, ())), arbors):
            yield tuple(by_way.get(HERE, ())), (*named, *((BESIDE, block) for block in blocks))


def partitions(dials: Dials, arbors: Mapping[str, int]) -> Iterator[tuple[Dials, ...]]:
    """Yield each partition of dials into sets such that the paths to dials of different sets have no common surviving
    arbor. The first dial is in the first set.
    """
    place = {dial: at for at, dial in enumerate(dials)}
    # dials whose paths have a common arbor are in one group
    joined = (pair for pair in combinations(dials, 2) if arbors[pair[0]] & arbors[pair[1]])
    for blocks in _set_partitions(tuple(map(tuple, joined_groups(dials, joined)))):
        yield tuple(
            tuple(sorted((dial for group in block for dial in group), key=place.__getitem__)) for block in blocks
        )


def _set_partitions(groups: tuple[Dials, ...]) -> Iterator[tuple[tuple[Dials, ...], ...]]:
    if not groups:
        yield ()
        return
    # the first group is always in the first block, so that each partition occurs once
    for size in range(len(groups)):
        for others in combinations(groups[1:], size):
            rest = tuple(group for group in groups[1:] if group not in others)
            for blocks in _set_partitions(rest):
                yield ((groups[0], *others), *blocks)


_T = TypeVar("_T")
_ENDLESS = 1 << 20  # number of added arbors if it is not limited


class DialPath(NamedTuple):
    """Part of the path to a dial that is not yet represented in the tree."""

    arbors: int
    """Bit mask of the surviving arbors on the remaining part of the path."""
    passes: Mapping[int, ArborPass]
    """Driven and driving wheel of the path on each surviving arbor, keyed by the index of the arbor. Index 0 is the
    input arbor.
    """
    compounds: int
    """Number of added arbors with two wheels before the last arbor."""
    idlers: int
    """Number of added arbors with one wheel (idlers) before the last arbor."""
    wheels: int
    """Number of added wheels on the remaining part of the path."""
    ends_new: bool
    """True if the last arbor of the path is an added arbor."""

    @property
    def is_at_end(self) -> bool:
        """True if the rest of the path contains no arbor except possibly an added arbor at its end."""
        return not (self.arbors or self.compounds or self.idlers)


Paths = dict[str, DialPath]
"""Path to each dial, keyed by the name of the dial in sorted order."""


class _Budget(NamedTuple):
    """Number of added wheels that remain to be placed, and number of added arbors that are still permitted."""

    wheels: int
    new: int

    def without(self, wheels: int, new: int = 0) -> _Budget:
        return _Budget(self.wheels - wheels, self.new - new)

    @property
    def is_possible(self) -> bool:
        return self.wheels >= 0 and self.new >= 0


class PathTrees:
    """Enumeration of the topologies that have one given path for each dial.

    lists   list of the possible paths to each dial, keyed by the name of the dial in sorted order
    """

    def __init__(self, problem: ReconstructionProblem, lists: Mapping[str, PathList]) -> None:
        self.problem, self.lists = problem, lists
        self.names = (problem.input.name, *(arbor.name for arbor in problem.arbors))
        self._new = _ENDLESS if problem.additions.arbors is None else problem.additions.arbors

    def topologies(self, choice: Mapping[str, int], added: int) -> Iterator[Topology]:
        """Yield all topologies that have exactly `added` added wheels and, for each dial, the path in the chosen row of
        its list.
        """
        paths = {dial: self._path(dial, choice[dial]) for dial in self.lists}
        roots = [root for root, left in self._branching(0, paths, _Budget(added, self._new)) if not left.wheels]
        if roots:
            wanted = tuple((dial, self.lists[dial].wanted_quotients(choice[dial])) for dial in self.lists)
            yield from (Topology(root, wanted) for root in roots)

    def _path(self, dial: str, row: int) -> DialPath:
        paths = self.lists[dial]
        codes = paths.codes[row].tolist()
        passes = {at: paths.passes[at][code - 1] for at, code in enumerate(codes) if code}
        figures = (paths.arbors, paths.compounds, paths.idlers, paths.wheels)
        arbors, compounds, idlers, wheels = (int(each[row]) for each in figures)
        return DialPath(arbors, passes, compounds, idlers, wheels, bool(paths.ends_new[row]))

    # subtrees of a driving wheel

    def _forest(self, paths: Paths, left: _Budget, minimum: int = 1) -> Iterator[tuple[tuple[Chain, ...], _Budget]]:
        """Yield each set of chains of arbors that can lead to the dials of the given paths, and the numbers of added
        wheels and arbors that remain. Dials whose paths have a common surviving arbor share a chain. At least `minimum`
        chains are required.
        """
        for blocks in partitions(tuple(paths), _own_arbors(paths)):
            if len(blocks) >= minimum:
                yield from self._each_block([_restricted(paths, block) for block in blocks], left, self._chain)

    def _each_block(
        self,
        blocks: Sequence[Paths],
        left: _Budget,
        subtrees: Callable[[Paths, _Budget], Iterator[tuple[_T, _Budget]]],
    ) -> Iterator[tuple[tuple[_T, ...], _Budget]]:
        """Yield each combination of one subtree for each set of dials, and the numbers of added wheels and arbors that
        remain. The added wheels that later sets of dials require are reserved.

        blocks     paths to the dials of each set
        subtrees   function that yields the subtrees for one set of dials, within the remaining numbers
        """
        if not blocks:
            yield (), left
            return
        kept = sum(map(_needed_wheels, blocks[1:]))
        if _needed_wheels(blocks[0]) > left.wheels - kept:
            return
        for subtree, after in subtrees(blocks[0], left.without(kept)):
            for others, end in self._each_block(blocks[1:], after.without(-kept), subtrees):
                yield (subtree, *others), end

    def _chain(self, paths: Paths, left: _Budget) -> Iterator[tuple[Chain, _Budget]]:
        """Yield each chain of arbors that leads to the dials of the given paths, and the numbers of added wheels and
        arbors that remain.
        """
        if len(paths) == 1:
            ((dial, path),) = paths.items()
            yield from self._single_chain(dial, path, left)
            return
        found = self._common(paths)
        if found is None:
            return
        through, end = found
        for trunk, after, below in self._trunks(paths, through, left):
            if end is None:
                if trunk.through or trunk.compounds or trunk.idlers:
                    yield from _with_ends(trunk, self._forest(below, after, 2))
                yield from _with_ends(trunk, self._new_branching(below, after))
            else:
                yield from _with_ends(trunk, self._branching(end, below, after))
        for last in through if end is None else ():
            # the paths leave this surviving arbor by several added wheels
            each = paths_first(paths).passes[last]
            if each.driver == ADDED and not each.idler:
                others = tuple(at for at in through if at != last)
                for trunk, after, below in self._trunks(paths, others, left):
                    yield from _with_ends(trunk, self._branching(last, below, after))

    def _trunks(self, paths: Paths, through: tuple[int, ...], left: _Budget) -> Iterator[tuple[Chain, _Budget, Paths]]:
        """Yield each chain that consists of the surviving arbors `through` and of added arbors that all paths can
        share. The chain has no end yet. It is followed by the numbers of added wheels and arbors that remain, and by
        the paths without the arbors of the chain.
        """
        passes = paths_first(paths).passes
        named = tuple((self.names[at], passes[at]) for at in through)
        for compounds, idlers in product(
            range(min(path.compounds for path in paths.values()) + 1),
            range(min(path.idlers for path in paths.values()) + 1),
        ):
            wheels = sum(passes[at].added for at in through) + 2 * compounds + idlers
            after = left.without(wheels, compounds + idlers)
            if after.is_possible:
                below = {
                    dial: path._replace(
                        arbors=path.arbors & ~sum(1 << (at - 1) for at in through),
                        compounds=path.compounds - compounds,
                        idlers=path.idlers - idlers,
                        wheels=path.wheels - wheels,
                    )
                    for dial, path in paths.items()
                }
                yield Chain(tuple(paths), named, compounds, idlers, ()), after, below

    def _common(self, paths: Paths) -> tuple[tuple[int, ...], int | None] | None:
        """Return the indices of the surviving arbors at which all paths have the same driven and the same driving
        wheel, and the index of the surviving arbor at which the paths separate or end.

        This index is None if there is no such arbor. If there are two or more such arbors, no tree has these paths, and
        None is returned instead of the pair.
        """
        through, ends = [], []
        for at in _arbors(reduce(and_, (path.arbors for path in paths.values()))):
            passes = {path.passes[at] for path in paths.values()}
            if len(passes) > 1 or next(iter(passes)).driver is None:
                ends.append(at)
            else:
                through.append(at)
        return None if len(ends) > 1 else (tuple(through), ends[0] if ends else None)

    def _single_chain(self, dial: str, path: DialPath, left: _Budget) -> Iterator[tuple[Chain, _Budget]]:
        after = left.without(path.wheels, path.compounds + path.idlers + path.ends_new)
        if not after.is_possible:
            return
        through, end = [], Branching(None, ADDED, (dial,))
        for at in _arbors(path.arbors):
            each = path.passes[at]
            if each.driver is None:
                end = Branching(self.names[at], each.driven, (dial,))
            else:
                through.append((self.names[at], each))
        if path.ends_new or end.name is not None:
            yield Chain((dial,), tuple(through), path.compounds, path.idlers, end), after

    # arbors at which paths end or separate

    def _branching(self, at: int, paths: Paths, left: _Budget) -> Iterator[tuple[Branching, _Budget]]:
        """Yield each form of the surviving arbor with index `at` and of all arbors that it drives, and the numbers of
        added wheels and arbors that remain. The arbor carries pointers, or paths separate at it, or it is the input
        arbor.
        """
        first = paths_first(paths).passes[at]
        ways = {dial: (exit_of(path.passes[at]),) for dial, path in paths.items()}
        paid = int(first.driven == ADDED)
        bit = 1 << (at - 1) if at else 0
        below = {
            dial: path._replace(arbors=path.arbors & ~bit, wheels=path.wheels - path.passes[at].added)
            for dial, path in paths.items()
        }
        for here, blocks in dial_partitions(tuple(paths), ways, _own_arbors(below)):
            # an arbor with a single exit belongs to a chain
            if at and not here and len(blocks) < 2:
                continue
            if all(below[dial].is_at_end and not below[dial].ends_new for dial in here):
                drivers = [None if way == IDLER else paths[dials[0]].passes[at].driver for way, dials in blocks]
                yield from self._with_subtrees(
                    self.names[at], first.driven, here, blocks, drivers, below, left.without(paid)
                )

    def _new_branching(self, paths: Paths, left: _Budget) -> Iterator[tuple[Branching, _Budget]]:
        """Yield each form of an added arbor, at which paths end or separate, and of all arbors that it drives, and the
        numbers of added wheels and arbors that remain.
        """
        ways: dict[str, tuple[str, ...]] = {}
        for dial, path in paths.items():
            exits = ((HERE, path.is_at_end and path.ends_new), (BESIDE, path.compounds), (IDLER, path.idlers))
            ways[dial] = tuple(way for way, is_open in exits if is_open)
        after = left.without(1, 1)
        if not after.is_possible or not all(ways.values()):
            return
        for here, blocks in dial_partitions(tuple(paths), ways, _own_arbors(paths)):
            # otherwise it is an arbor on a chain, not a branching
            if not here and len(blocks) < 2:
                continue
            below = dict(paths)
            for way, dials in blocks:
                for dial in dials:
                    path = paths[dial]
                    below[dial] = (
                        path._replace(idlers=path.idlers - 1, wheels=path.wheels - 1)
                        if way == IDLER
                        else path._replace(compounds=path.compounds - 1, wheels=path.wheels - 2)
                    )
            drivers = [None if way == IDLER else ADDED for way, _ in blocks]
            yield from self._with_subtrees(None, ADDED, here, blocks, drivers, below, after)

    def _with_subtrees(
        self,
        name: str | None,
        driven: PlacedWheel | None,
        here: Dials,
        blocks: Sequence[Block],
        drivers: Sequence[PlacedWheel | None],
        paths: Paths,
        left: _Budget,
    ) -> Iterator[tuple[Branching, _Budget]]:
        """Yield an arbor with each possible choice of the arbors that it drives, and the numbers of added wheels and
        arbors that remain.

        here      dials whose pointers are on the arbor
        blocks    each wheel that drives, with the dials to which it leads
        drivers   driving wheel of each block; None if the driven wheel drives (an idler)
        paths     paths to all dials, without this arbor
        """
        masks = [reduce(or_, (paths[dial].arbors for dial in dials)) for _, dials in blocks]
        if any(one & other for one, other in combinations(masks, 2)):
            return
        after = left.without(sum(way == BESIDE for way, _ in blocks))
        for forests, end in self._each_block([_restricted(paths, dials) for _, dials in blocks], after, self._forest):
            drives = list(zip(drivers, forests, strict=True))
            driving = tuple((wheel, chains) for wheel, chains in drives if wheel is not None)
            passes = tuple(chain for wheel, chains in drives if wheel is None for chain in chains)
            yield Branching(name, driven, here, driving, passes), end


def paths_first(paths: Paths) -> DialPath:
    """Return one of the paths. It is used to read properties that are common to all paths."""
    return next(iter(paths.values()))


def _restricted(paths: Paths, dials: Dials) -> Paths:
    return {dial: paths[dial] for dial in dials}


def _own_arbors(paths: Paths) -> dict[str, int]:
    return {dial: path.arbors for dial, path in paths.items()}


def _needed_wheels(paths: Paths) -> int:
    """Return a lower bound of the number of added wheels in a tree with the given paths."""
    return max(path.wheels for path in paths.values())


def _with_ends(
    trunk: Chain, ends: Iterator[tuple[Branching, _Budget]] | Iterator[tuple[tuple[Chain, ...], _Budget]]
) -> Iterator[tuple[Chain, _Budget]]:
    yield from ((replace(trunk, end=end), after) for end, after in ends)


def _arbors(bits: int) -> Iterator[int]:
    """Yield the indices, starting with 1, of the arbors whose bits are set in a bit mask."""
    at = 1
    while bits:
        if bits & 1:
            yield at
        bits >>= 1
        at += 1
