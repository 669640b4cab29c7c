"""Every skeleton that may explain the dials: branchings, surviving arbors between them, places of added wheels.

The search goes from the input on. At each wheel the dials below it are shared out among what it drives, at each arbor
among its wheels, in every way; and each step is taken only where every dial below still has a path in its list
(`path_lists`). Complete: a train that keeps the rules is one tree, its branchings part its dials, and between two
branchings the arbors are a set; the search takes each such choice once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, combinations
from typing import NamedTuple

import numpy as np

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.path_lists import AddedArbors, PathList, Rows
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import NEW, PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Dials, Joint, Limb, Skeleton

_ENDLESS = 1 << 20


class _Left(NamedTuple):
    """What is still to be used.

    arbors   surviving ones, a bit each
    wheels   added wheels
    new      added arbors, at most
    shown    by dial that is shown: its row in the list of its paths, and whether it turns the other way
    """

    arbors: int
    wheels: int
    new: int
    shown: tuple[tuple[str, int, bool], ...] = ()


class _Above(NamedTuple):
    """The part of the paths that the dials below share.

    arbors               surviving ones, a bit each
    wheels               added wheels beside surviving ones
    compounds, idlers    added arbors
    """

    arbors: int = 0
    wheels: int = 0
    compounds: int = 0
    idlers: int = 0


_Lists = Mapping[str, Rows]


class SkeletonSearch:
    """All skeletons of a question with a given number of added wheels."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.problem = problem
        self.every = (problem.input, *problem.arbors)
        keys = QuotientKeys(problem.additions.least, problem.additions.greatest)
        self.lists = {dial.name: PathList(dial, problem, keys) for dial in problem.dials}
        self._cover = problem.use != "some"
        first = next(iter(self.lists.values()))
        self._plain = [[each for each in passes if each.driver is not None] for passes in first.passes]

    def skeletons(self, added: int) -> Iterator[Skeleton]:
        """All skeletons with just so many added wheels."""
        lists: dict[str, Rows] = {}
        for name, paths in self.lists.items():
            lists[name] = self._affordable(name, np.arange(len(paths.codes)), _Above(), added)
            if not len(lists[name]):
                return
        new = self.problem.additions.arbors
        left = _Left((1 << len(self.problem.arbors)) - 1, added, _ENDLESS if new is None else new)
        for root, after in self._survivor_joint(0, tuple(sorted(lists)), lists, _Above(), left, True):
            if not after.wheels and not (self._cover and after.arbors):
                wanted = tuple(
                    (name, self.lists[name].wanted_quotients(row, turned)) for name, row, turned in sorted(after.shown)
                )
                yield Skeleton(root, wanted)

    # what hangs from a driving wheel

    def _forest(
        self, dials: Dials, lists: _Lists, above: _Above, left: _Left, last: bool, least: int = 1
    ) -> Iterator[tuple[tuple[Limb, ...], _Left]]:
        """Limbs that share out some dials."""
        for blocks in _partitions(dials):
            if len(blocks) >= least:
                yield from self._limbs(blocks, lists, above, left, last)

    def _limbs(
        self, blocks: Sequence[Dials], lists: _Lists, above: _Above, left: _Left, last: bool
    ) -> Iterator[tuple[tuple[Limb, ...], _Left]]:
        if not blocks:
            yield (), left
            return
        for limb, after in self._limb(blocks[0], lists, above, left, last and len(blocks) == 1):
            for others, end in self._limbs(blocks[1:], lists, above, after, last):
                yield (limb, *others), end

    def _limb(
        self, dials: Dials, lists: _Lists, above: _Above, left: _Left, last: bool
    ) -> Iterator[tuple[Limb, _Left]]:
        kept = self._viable(dials, lists, above, left)
        if kept is None:
            return
        if len(dials) == 1:
            yield from self._leg(dials[0], kept[dials[0]], above, left, last)
            return
        for through, some, there, after in self._stretches(1, dials, kept, above, left):
            for compounds in range(after.wheels // 2 + 1):
                for idlers in range(after.wheels - 2 * compounds + 1 if self.problem.idlers else 1):
                    if compounds + idlers <= after.new:
                        limb = Limb(dials, through, compounds, idlers, ())
                        yield from self._ends(limb, some, there, after, last)

    def _ends(self, limb: Limb, lists: _Lists, above: _Above, left: _Left, last: bool) -> Iterator[tuple[Limb, _Left]]:
        """What a limb with several dials may end with."""
        above = above._replace(compounds=above.compounds + limb.compounds, idlers=above.idlers + limb.idlers)
        wheels = left.wheels - 2 * limb.compounds - limb.idlers
        left = left._replace(wheels=wheels, new=left.new - limb.compounds - limb.idlers)
        kept = self._viable(limb.dials, lists, above, left)
        if kept is None:
            return
        ends: Iterator[tuple[Joint | tuple[Limb, ...], _Left]] = chain(
            self._forest(limb.dials, kept, above, left, last, 2) if limb.arbors else (),
            *(
                self._survivor_joint(at, limb.dials, kept, above, left, last)
                for at in range(1, len(self.every))
                if left.arbors >> (at - 1) & 1
            ),
            self._new_joint(limb.dials, kept, above, left, last),
        )
        for end, after in ends:
            yield Limb(limb.dials, limb.through, limb.compounds, limb.idlers, end), after

    # one dial: its list says all

    def _leg(self, dial: str, rows: Rows, above: _Above, left: _Left, last: bool) -> Iterator[tuple[Limb, _Left]]:
        paths = self.lists[dial]
        own = paths.arbors[rows] & ~above.arbors
        fits = paths.owing[rows] & ~above.arbors == 0
        if last and self._cover:
            fits &= own == left.arbors
        for row in map(int, rows[fits]):
            for bit, plan in enumerate(paths.plans):
                more = AddedArbors(plan.compounds - above.compounds, plan.idlers - above.idlers)
                cost = int(paths.wheels[row]) - above.wheels + more.wheels
                new = more.compounds + more.idlers + int(paths.ends_new[row])
                if not paths.possible[row] >> bit & 1 or min(more.compounds, more.idlers) < 0:
                    continue
                if cost > left.wheels or (last and cost < left.wheels) or new > left.new:
                    continue
                arbors = int(paths.arbors[row]) & ~above.arbors
                shown = (*left.shown, (dial, row, self._turns(dial, row, plan)))
                after = _Left(left.arbors & ~arbors, left.wheels - cost, left.new - new, shown)
                yield self._as_limb(dial, row, arbors, more), after

    def _as_limb(self, dial: str, row: int, arbors: int, more: AddedArbors) -> Limb:
        paths = self.lists[dial]
        end = Joint(None, ADDED, (dial,))
        through = []
        for at in range(1, len(self.every)):
            if arbors >> (at - 1) & 1:
                each = paths.passes[at][paths.codes[row, at] - 1]
                if each.driver is None:
                    end = Joint(self.every[at].name, each.driven, (dial,))
                else:
                    through.append((self.every[at].name, each))
        return Limb((dial,), tuple(through), more.compounds, more.idlers, end)

    def _turns(self, dial: str, row: int, plan: AddedArbors) -> bool:
        """Whether a dial turns the other way than the input."""
        paths = self.lists[dial]
        meshes = int(paths.arbors[row]).bit_count() + int(paths.ends_new[row]) + plan.compounds + plan.idlers
        return meshes % 2 == 1

    # several dials: surviving arbors in a row, in the order of their numbers

    def _stretches(
        self, start: int, dials: Dials, lists: _Lists, above: _Above, left: _Left
    ) -> Iterator[tuple[tuple[tuple[str, ArborPass], ...], _Lists, _Above, _Left]]:
        yield (), lists, above, left
        for at in range(start, len(self.every)):
            bit = 1 << (at - 1)
            if not left.arbors & bit:
                continue
            for code in self._codes(at, dials, lists):
                if code > len(self._plain[at]):
                    continue
                each = self._plain[at][code - 1]
                if (each.idle and self.problem.use == "wheels") or each.added > left.wheels:
                    continue
                there = above._replace(arbors=above.arbors | bit, wheels=above.wheels + each.added)
                after = left._replace(arbors=left.arbors & ~bit, wheels=left.wheels - each.added)
                kept = self._viable(dials, self._through(at, code, dials, lists), there, after)
                if kept is not None:
                    for through, *rest in self._stretches(at + 1, dials, kept, there, after):
                        yield ((self.every[at].name, each), *through), *rest

    def _codes(self, at: int, dials: Dials, lists: _Lists) -> list[int]:
        """The ways through an arbor that the list of one of the dials still knows."""
        short = min(dials, key=lambda dial: len(lists[dial]))
        return [int(code) for code in np.unique(self.lists[short].codes[lists[short], at]) if code]

    def _through(self, at: int, code: int, dials: Dials, lists: _Lists) -> dict[str, Rows]:
        return {dial: lists[dial][self.lists[dial].codes[lists[dial], at] == code] for dial in dials}

    # arbors at which paths end or part

    def _survivor_joint(
        self, at: int, dials: Dials, lists: _Lists, above: _Above, left: _Left, last: bool
    ) -> Iterator[tuple[Joint, _Left]]:
        """A surviving arbor that shows some of the dials, or leads to them by several wheels; or the input arbor."""
        arbor, bit = self.every[at], _bit(at)
        there = above._replace(arbors=above.arbors | bit)
        left = left._replace(arbors=left.arbors & ~bit)
        paths = self.lists[dials[0]]
        codes = np.unique(paths.codes[lists[dials[0]], at])
        for driven in dict.fromkeys(paths.passes[at][code - 1].driven for code in codes if code):
            after = left._replace(wheels=left.wheels - (driven == ADDED))
            wheels = [each.name for each in arbor.wheels if driven is None or each.name != driven.name]
            for here in _subsets(dials):
                shown = self._ending(at, driven, here, lists, there)
                rest = tuple(dial for dial in dials if dial not in here)
                if shown is None or after.wheels < 0:
                    continue
                done = after._replace(shown=(*after.shown, *shown))
                for blocks in self._shared_out(rest, wheels, beside=self.problem.additions.on == "any", idler=at > 0):
                    if not at or here or len(blocks) > 1:
                        place = _Place(at, arbor.name, driven)
                        for drives, end in self._drives(place, blocks, lists, there, done, last):
                            yield _joint(place, here, drives), end

    def _new_joint(
        self, dials: Dials, lists: _Lists, above: _Above, left: _Left, last: bool
    ) -> Iterator[tuple[Joint, _Left]]:
        """An added arbor that shows some of the dials, or leads to them by several wheels."""
        if not left.wheels or not left.new:
            return
        after = left._replace(wheels=left.wheels - 1, new=left.new - 1)
        place = _Place(-1, None, ADDED)
        for here in _subsets(dials):
            shown = self._ending_new(here, lists, above)
            rest = tuple(dial for dial in dials if dial not in here)
            if shown is None:
                continue
            done = after._replace(shown=(*after.shown, *shown))
            for blocks in self._shared_out(rest, (), beside=True, idler=True):
                if here or len(blocks) > 1:
                    for drives, end in self._drives(place, blocks, lists, above, done, last):
                        yield _joint(place, here, drives), end

    def _ending(
        self, at: int, driven: PlacedWheel | None, here: Dials, lists: _Lists, above: _Above
    ) -> list[tuple[str, int, bool]] | None:
        """Rows of the dials that a surviving arbor shows; None where it does not show them."""
        found = []
        for dial in here:
            paths, rows = self.lists[dial], lists[dial]
            ends = [
                code for code, each in enumerate(paths.passes[at], 1) if each.driver is None and each.driven == driven
            ]
            shown = self._shown(dial, rows[np.isin(paths.codes[rows, at], ends)], above)
            if shown is None:
                return None
            found.append(shown)
        return found

    def _ending_new(self, here: Dials, lists: _Lists, above: _Above) -> list[tuple[str, int, bool]] | None:
        """Rows of the dials that an added arbor shows; None where it does not show them."""
        found = []
        for dial in here:
            shown = self._shown(dial, lists[dial][self.lists[dial].ends_new[lists[dial]]], above)
            if shown is None:
                return None
            found.append(shown)
        return found

    def _shown(self, dial: str, rows: Rows, above: _Above) -> tuple[str, int, bool] | None:
        """The row that ends just here, if one does."""
        paths, plan = self.lists[dial], AddedArbors(above.compounds, above.idlers)
        if plan not in paths.plans:
            return None
        fits = paths.arbors[rows] == above.arbors
        fits &= paths.possible[rows] >> paths.plans.index(plan) & 1 == 1
        if not fits.any():
            return None
        (row,) = map(int, rows[fits])
        return dial, row, self._turns(dial, row, plan)

    def _shared_out(
        self, dials: Dials, wheels: Sequence[str], *, beside: bool, idler: bool
    ) -> Iterator[tuple[tuple[str | None, Dials], ...]]:
        """Dials by the wheel that leads to them: surviving ones by name, "" for the driven one, None for added ones."""
        if wheels:
            for block in _subsets(dials):
                if block or self.problem.use != "wheels":
                    rest = tuple(dial for dial in dials if dial not in block)
                    own = ((wheels[0], block),) if block else ()
                    for others in self._shared_out(rest, wheels[1:], beside=beside, idler=idler):
                        yield (*own, *others)
            return
        for past in _subsets(dials) if idler and self.problem.idlers else [()]:
            rest = tuple(dial for dial in dials if dial not in past)
            for blocks in _partitions(rest) if beside or not rest else ():
                yield (*((("", past),) if past else ()), *((None, block) for block in blocks))

    def _drives(
        self,
        place: _Place,
        blocks: Sequence[tuple[str | None, Dials]],
        lists: _Lists,
        above: _Above,
        left: _Left,
        last: bool,
    ) -> Iterator[tuple[tuple[_Drive, ...], _Left]]:
        """What hangs from the driving wheels of an arbor."""
        if not blocks:
            yield (), left
            return
        (wheel, dials), others = blocks[0], blocks[1:]
        for driver, some, there in self._by_wheel(place, wheel, dials, lists, above):
            cost = int(wheel is None)
            if cost > left.wheels:
                continue
            final = last and not others
            for limbs, after in self._forest(dials, some, there, left._replace(wheels=left.wheels - cost), final):
                for drives, end in self._drives(place, others, lists, above, after, last):
                    yield ((driver, limbs), *drives), end

    def _by_wheel(
        self, place: _Place, wheel: str | None, dials: Dials, lists: _Lists, above: _Above
    ) -> Iterator[tuple[PlacedWheel | None, _Lists, _Above]]:
        """A driving wheel with each of its counts, None for the driven one, and the paths that lead by it."""
        if place.at < 0:
            kinds = {"compounds": above.compounds + 1} if wheel is None else {"idlers": above.idlers + 1}
            yield ADDED if wheel is None else None, lists, above._replace(**kinds)
            return
        for code in self._codes(place.at, dials, lists):
            if code > len(self._plain[place.at]):
                continue
            each = self._plain[place.at][code - 1]
            named = "" if each.idler else each.driver.name if each.driver is not None else None
            if each.driven == place.driven and named == wheel:
                some = self._through(place.at, code, dials, lists)
                there = above._replace(wheels=above.wheels + each.added)
                yield None if each.idler else each.driver, some, there

    # what no list knows is not tried

    def _viable(self, dials: Dials, lists: _Lists, above: _Above, left: _Left) -> dict[str, Rows] | None:
        """The paths that still can be completed; None where a dial has none."""
        found = {}
        for dial in dials:
            paths, rows = self.lists[dial], lists[dial]
            rows = rows[paths.arbors[rows] & ~(above.arbors | left.arbors) == 0]
            found[dial] = self._affordable(dial, rows, above, left.wheels)
            if not len(found[dial]):
                return None
        return found

    def _affordable(self, dial: str, rows: Rows, above: _Above, wheels: int) -> Rows:
        paths = self.lists[dial]
        fits = np.zeros(len(rows), dtype=bool)
        cost = paths.wheels[rows] - above.wheels
        for bit, plan in enumerate(paths.plans):
            more = AddedArbors(plan.compounds - above.compounds, plan.idlers - above.idlers)
            if min(more.compounds, more.idlers) >= 0:
                fits |= (paths.possible[rows] >> bit & 1 == 1) & (cost + more.wheels <= wheels)
        return rows[fits]


class _Place(NamedTuple):
    """An arbor at which paths part: its number, -1 for an added one, its name, and the wheel that is driven."""

    at: int
    name: str | None
    driven: PlacedWheel | None


_Drive = tuple[PlacedWheel | None, tuple[Limb, ...]]


def _joint(place: _Place, here: Dials, drives: tuple[_Drive, ...]) -> Joint:
    driving = tuple((wheel, limbs) for wheel, limbs in drives if wheel is not None)
    passes = tuple(limb for wheel, limbs in drives if wheel is None for limb in limbs)
    return Joint(place.name, place.driven, here, driving, passes)


def _bit(at: int) -> int:
    return 1 << (at - 1) if at else 0


def _subsets(dials: Dials) -> Iterator[Dials]:
    for size in range(len(dials) + 1):
        yield from combinations(dials, size)


def _partitions(dials: Dials) -> Iterator[tuple[Dials, ...]]:
    """Each way to part dials into blocks, the first of them in the first block."""
    if not dials:
        yield ()
        return
    for others in _subsets(dials[1:]):
        rest = tuple(dial for dial in dials[1:] if dial not in others)
        for blocks in _partitions(rest):
            yield ((dials[0], *others), *blocks)
