"""Every skeleton that may explain the dials: branchings, surviving arbors between them, places of added wheels.

The search goes from the input on. At each wheel the dials below it are shared out among what it drives, at each arbor
among its wheels, in every way; and each step is taken only where every dial below still has a path in its list
(`path_lists`). Complete: a train that keeps the rules is one tree, its branchings part its dials, and between two
branchings the arbors are a set; the search takes each such choice once.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import chain
from operator import and_
from typing import TypeVar

import numpy as np

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.dial_shares import (
    BESIDE,
    HERE,
    IDLER,
    Block,
    JointPlace,
    codes_by_way,
    partitions,
    shared_out,
)
from geartrain.synthesis.reconstruction.open_paths import Above, Left, Lists, OpenPaths, bit_of
from geartrain.synthesis.reconstruction.path_lists import Rows
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Dials, Joint, Limb, Skeleton

_Choice = TypeVar("_Choice")
_ENDLESS = 1 << 20


_Drive = tuple[PlacedWheel | None, tuple[Limb, ...]]


class SkeletonSearch:
    """All skeletons of a question with a given number of added wheels."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.problem = problem
        self.every = (problem.input, *problem.arbors)
        self.paths = OpenPaths(problem)

    def skeletons(self, added: int, part: int = 0, parts: int = 1) -> Iterator[Skeleton]:
        """All skeletons with just so many added wheels; of several parts one, by what the first limb begins with."""
        self._part, self._parts = part, parts
        dials = tuple(sorted(self.paths.lists))
        new = self.problem.additions.arbors
        left = Left((1 << len(self.problem.arbors)) - 1, added, _ENDLESS if new is None else new)
        lists = self.paths.viable(dials, self.paths.whole(added), Above(), left)
        if lists is None:
            return
        for root, after in self._survivor_joint(0, dials, lists, Above(first=True), left, None):
            if part and not root.drives:
                continue
            if not after.wheels and not (self.paths.must_cover and after.arbors):
                wanted = tuple((name, self.paths[name].wanted_quotients(row)) for name, row in sorted(after.shown))
                yield Skeleton(root, wanted)

    # what hangs from a driving wheel

    def _forest(
        self, dials: Dials, lists: Lists, above: Above, left: Left, later: int | None, least: int = 1
    ) -> Iterator[tuple[tuple[Limb, ...], Left]]:
        """Limbs that share out some dials."""
        for blocks in partitions(dials):
            if len(blocks) >= least:
                known = [self.paths.viable(block, lists, above, left) for block in blocks]
                found = [lists for lists in known if lists is not None]
                if len(found) == len(blocks) and self.paths.parted(found, above, left):
                    found.sort(key=lambda some: min(map(len, some.values())))
                    yield from self._limbs(found, above, left, later)

    def _limbs(
        self, blocks: Sequence[Lists], above: Above, left: Left, later: int | None
    ) -> Iterator[tuple[tuple[Limb, ...], Left]]:
        """Limbs to the dials of each block; what the later ones need at least is kept for them."""
        if not blocks:
            yield (), left
            return
        kept = sum(self.paths.least(some, above) for some in blocks[1:])
        if kept > left.wheels:
            return
        after_it = self.paths.later(blocks[1:], later)
        for limb, after in self._limb(blocks[0], above, left._replace(wheels=left.wheels - kept), after_it):
            rest = after._replace(wheels=after.wheels + kept)
            for others, end in self._limbs(blocks[1:], above._replace(first=False), rest, later):
                yield (limb, *others), end

    def _later(self, blocks: Sequence[Lists], later: int | None) -> int | None:
        """The arbors that some blocks, and those after them, may use; None if there are none of them."""
        found = later
        for lists in blocks:
            for dial, rows in lists.items():
                found = (found or 0) | int(np.bitwise_or.reduce(self.paths[dial].arbors[rows]))
        return found

    def _limb(self, lists: Lists, above: Above, left: Left, later: int | None) -> Iterator[tuple[Limb, Left]]:
        dials = tuple(sorted(lists))
        kept = self.paths.viable(dials, lists, above, left)
        if kept is None or not self.paths.covers(kept, left, later):
            return
        if len(dials) == 1:
            rows = self._own(above, kept[dials[0]])
            yield from self._leg(dials[0], np.array(list(rows), dtype=np.int64), above, left, later)
            return
        stretches = self._stretches(1, dials, kept, above._replace(first=False), left, later)
        for through, some, there, after in self._own(above, stretches):
            for compounds in range(after.wheels // 2 + 1):
                for idlers in range(after.wheels - 2 * compounds + 1 if self.problem.idlers else 1):
                    if compounds + idlers <= after.new:
                        limb = Limb(dials, through, compounds, idlers, ())
                        yield from self._ends(limb, some, there, after, later)

    def _own(self, above: Above, choices: Iterable[_Choice]) -> Iterator[_Choice]:
        """Of what the first limb may begin with, what belongs to this part; elsewhere all."""
        for number, choice in enumerate(choices):
            if not above.first or number % self._parts == self._part:
                yield choice

    def _ends(
        self, limb: Limb, lists: Lists, above: Above, left: Left, later: int | None
    ) -> Iterator[tuple[Limb, Left]]:
        """What a limb with several dials may end with."""
        above = above._replace(compounds=above.compounds + limb.compounds, idlers=above.idlers + limb.idlers)
        wheels = left.wheels - 2 * limb.compounds - limb.idlers
        left = left._replace(wheels=wheels, new=left.new - limb.compounds - limb.idlers)
        kept = self.paths.viable(limb.dials, lists, above, left)
        if kept is None or not self.paths.covers(kept, left, later):
            return
        everywhere = reduce(and_, (self.paths.reach(dial, rows) for dial, rows in kept.items()))
        ends: Iterator[tuple[Joint | tuple[Limb, ...], Left]] = chain(
            self._forest(limb.dials, kept, above, left, later, 2) if limb.arbors else (),
            *(
                self._survivor_joint(at, limb.dials, kept, above, left, later)
                for at in range(1, len(self.every))
                if left.arbors & bit_of(at) & everywhere
            ),
            self._new_joint(limb.dials, kept, above, left, later),
        )
        for end, after in ends:
            yield Limb(limb.dials, limb.through, limb.compounds, limb.idlers, end), after

    # one dial: its list says all

    def _leg(self, dial: str, rows: Rows, above: Above, left: Left, later: int | None) -> Iterator[tuple[Limb, Left]]:
        paths = self.paths[dial]
        fits = paths.new[rows] - above.compounds - above.idlers <= left.new
        if later is None:
            fits &= paths.wheels[rows] - above.wheels == left.wheels
            if self.paths.must_cover:
                fits &= paths.arbors[rows] & ~above.arbors == left.arbors
        for row in map(int, rows[fits]):
            arbors = int(paths.arbors[row]) & ~above.arbors
            limb = self._as_limb(dial, row, arbors, above)
            wheels = left.wheels - int(paths.wheels[row]) + above.wheels
            new = left.new - int(paths.new[row]) + above.compounds + above.idlers
            yield limb, Left(left.arbors & ~arbors, wheels, new, (*left.shown, (dial, row)))

    def _as_limb(self, dial: str, row: int, arbors: int, above: Above) -> Limb:
        paths = self.paths[dial]
        end = Joint(None, ADDED, (dial,))
        through = []
        for at in range(1, len(self.every)):
            if arbors & bit_of(at):
                each = paths.passes[at][paths.codes[row, at] - 1]
                if each.driver is None:
                    end = Joint(self.every[at].name, each.driven, (dial,))
                else:
                    through.append((self.every[at].name, each))
        compounds, idlers = int(paths.compounds[row]), int(paths.idlers[row])
        return Limb((dial,), tuple(through), compounds - above.compounds, idlers - above.idlers, end)

    # several dials: surviving arbors in a row, in the order of their numbers

    def _stretches(
        self, start: int, dials: Dials, lists: Lists, above: Above, left: Left, later: int | None
    ) -> Iterator[tuple[tuple[tuple[str, ArborPass], ...], Lists, Above, Left]]:
        yield (), lists, above, left
        for at in range(start, len(self.every)):
            bit = bit_of(at)
            if not left.arbors & bit:
                continue
            short = min(dials, key=lambda dial: len(lists[dial]))
            for code in self._codes(at, short, lists):
                each = self.paths[short].passes[at][code - 1]
                if each.driver is None or (each.idle and self.problem.use == "wheels") or each.added > left.wheels:
                    continue
                there = above._replace(arbors=above.arbors | bit, beside=above.beside + each.added)
                after = left._replace(arbors=left.arbors & ~bit, wheels=left.wheels - each.added)
                kept = self.paths.viable(dials, self._through(at, code, dials, lists), there, after)
                if kept is not None and self.paths.covers(kept, after, later):
                    own = (self.every[at].name, each)
                    for through, some, below, end in self._stretches(at + 1, dials, kept, there, after, later):
                        yield (own, *through), some, below, end

    def _codes(self, at: int, dial: str, lists: Lists) -> list[int]:
        """The ways through an arbor that the list of a dial still knows."""
        return [int(code) for code in np.unique(self.paths[dial].codes[lists[dial], at]) if code]

    def _through(self, at: int, code: int, dials: Dials, lists: Lists) -> dict[str, Rows]:
        return {dial: lists[dial][self.paths[dial].codes[lists[dial], at] == code] for dial in dials}

    # arbors at which paths end or part

    def _survivor_joint(
        self, at: int, dials: Dials, lists: Lists, above: Above, left: Left, later: int | None
    ) -> Iterator[tuple[Joint, Left]]:
        """A surviving arbor that shows some of the dials, or leads to them by several wheels; or the input arbor."""
        arbor = self.every[at]
        above = above._replace(arbors=above.arbors | bit_of(at))
        left = left._replace(arbors=left.arbors & ~bit_of(at))
        codes = {dial: self._codes(at, dial, lists) for dial in dials}
        passes = {dial: self.paths[dial].passes[at] for dial in dials}
        for driven in dict.fromkeys(passes[dials[0]][code - 1].driven for code in codes[dials[0]]):
            after = left._replace(wheels=left.wheels - (driven == ADDED))
            own = {dial: [code for code in codes[dial] if passes[dial][code - 1].driven == driven] for dial in dials}
            place = JointPlace(at, arbor.name, driven, {dial: codes_by_way(passes[dial], own[dial]) for dial in dials})
            must = [wheel.name for wheel in arbor.wheels if driven is None or wheel.name != driven.name]
            for here, blocks in shared_out(dials, place.ways, must if self.problem.use == "wheels" else ()):
                if after.wheels >= 0 and (not at or here or len(blocks) > 1):
                    yield from self._joint(place, here, blocks, lists, above, after, later)

    def _new_joint(
        self, dials: Dials, lists: Lists, above: Above, left: Left, later: int | None
    ) -> Iterator[tuple[Joint, Left]]:
        """An added arbor that shows some of the dials, or leads to them by several wheels."""
        if not left.wheels or not left.new:
            return
        after = left._replace(wheels=left.wheels - 1, new=left.new - 1)
        ways: dict[str, dict[str, list[int]]] = {}
        for dial in dials:
            paths, rows = self.paths[dial], lists[dial]
            known = {
                HERE: paths.ends_new[rows].any(),
                BESIDE: (paths.compounds[rows] > above.compounds).any(),
                IDLER: (paths.idlers[rows] > above.idlers).any(),
            }
            ways[dial] = {way: [] for way, is_known in known.items() if is_known}
        place = JointPlace(-1, None, ADDED, ways)
        for here, blocks in shared_out(dials, ways, ()):
            if here or len(blocks) > 1:
                yield from self._joint(place, here, blocks, lists, above, after, later)

    def _joint(
        self,
        place: JointPlace,
        here: Dials,
        blocks: Sequence[Block],
        lists: Lists,
        above: Above,
        left: Left,
        later: int | None,
    ) -> Iterator[tuple[Joint, Left]]:
        shown = [self._shown(place, dial, lists[dial], above) for dial in here]
        found = [each for each in shown if each is not None]
        if len(found) < len(here):
            return
        after = left._replace(shown=(*left.shown, *found))
        for drives, end in self._drives(place, blocks, lists, above, after, later):
            driving = tuple((wheel, limbs) for wheel, limbs in drives if wheel is not None)
            passes = tuple(limb for wheel, limbs in drives if wheel is None for limb in limbs)
            yield Joint(place.name, place.driven, here, driving, passes), end

    def _shown(self, place: JointPlace, dial: str, rows: Rows, above: Above) -> tuple[str, int] | None:
        """The row that ends just here, if one does."""
        paths = self.paths[dial]
        if place.at < 0:
            rows = rows[paths.ends_new[rows]]
        else:
            rows = rows[paths.codes[rows, place.at] == place.ways[dial][HERE][0]]
        fits = (paths.arbors[rows] == above.arbors) & (paths.compounds[rows] == above.compounds)
        found = rows[fits & (paths.idlers[rows] == above.idlers)]
        return (dial, int(found[0])) if len(found) else None

    def _drives(
        self,
        place: JointPlace,
        blocks: Sequence[Block],
        lists: Lists,
        above: Above,
        left: Left,
        later: int | None,
    ) -> Iterator[tuple[tuple[_Drive, ...], Left]]:
        """What hangs from the driving wheels of an arbor."""
        if not blocks:
            yield (), left
            return
        (way, dials), others = blocks[0], blocks[1:]
        rest = [{dial: lists[dial] for dial in block} for _, block in others]
        after_it = self.paths.later(rest, later)
        paid = int(place.driven == ADDED)  # what is above does not count it, and it is added once
        kept = sum(max(0, self.paths.least(some, above) - paid) for some in rest)
        cost = int(way == BESIDE)
        if cost + kept > left.wheels:
            return
        own = left._replace(wheels=left.wheels - cost - kept)
        for driver, some, there in self._by_way(place, way, dials, lists, above):
            for limbs, after in self._forest(dials, some, there, own, after_it):
                after = after._replace(wheels=after.wheels + kept)
                for drives, end in self._drives(place, others, lists, above._replace(first=False), after, later):
                    yield ((driver, limbs), *drives), end

    def _by_way(
        self, place: JointPlace, way: str, dials: Dials, lists: Lists, above: Above
    ) -> Iterator[tuple[PlacedWheel | None, Lists, Above]]:
        """A driving wheel with each of its counts, None for the driven one, and the paths that lead by it."""
        if place.at < 0:
            if way == BESIDE:
                yield ADDED, lists, above._replace(compounds=above.compounds + 1)
            else:
                yield None, lists, above._replace(idlers=above.idlers + 1)
            return
        # where the path goes on, codes are the same in all lists
        for code in set.intersection(*(set(place.ways[dial][way]) for dial in dials)):
            each = self.paths[dials[0]].passes[place.at][code - 1]
            some = self._through(place.at, code, dials, lists)
            yield None if each.idler else each.driver, some, above._replace(beside=above.beside + each.added)
