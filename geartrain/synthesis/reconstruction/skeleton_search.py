"""Every skeleton that may explain the dials: branchings, surviving arbors between them, places of added wheels.

The search goes from the input on. At each wheel the dials below it are shared out among what it drives, at each arbor
among its wheels, in every way; and each step is taken only where every dial below still has a path in its list
(`path_lists`). Complete: a train that keeps the rules is one tree, its branchings part its dials, and between two
branchings the arbors are a set; the search takes each such choice once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, combinations, product
from typing import NamedTuple

import numpy as np

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.path_lists import PathList, Rows
from geartrain.synthesis.reconstruction.quotient_keys import QuotientKeys
from geartrain.synthesis.reconstruction.reconstruction_problem import PlacedWheel, ReconstructionProblem
from geartrain.synthesis.reconstruction.skeletons import Dials, Joint, Limb, Skeleton

_ENDLESS = 1 << 20
_MOST_PAIRS = 1 << 22
"""Pairs of paths that are looked at to keep those that go together."""


class _Left(NamedTuple):
    """What is still to be used.

    arbors   surviving ones, a bit each
    wheels   added wheels
    new      added arbors, at most
    shown    by dial that is shown: its row in the list of its paths
    """

    arbors: int
    wheels: int
    new: int
    shown: tuple[tuple[str, int], ...] = ()


class _Above(NamedTuple):
    """The part of the paths that the dials below share.

    arbors               surviving ones, a bit each
    beside               added wheels beside surviving ones
    compounds, idlers    added arbors
    """

    arbors: int = 0
    beside: int = 0
    compounds: int = 0
    idlers: int = 0

    @property
    def wheels(self) -> int:
        """Added wheels."""
        return self.beside + 2 * self.compounds + self.idlers


_Lists = Mapping[str, Rows]


class SkeletonSearch:
    """All skeletons of a question with a given number of added wheels."""

    def __init__(self, problem: ReconstructionProblem) -> None:
        self.problem = problem
        self.every = (problem.input, *problem.arbors)
        self.keys = keys = QuotientKeys(problem.additions.least, problem.additions.greatest)
        self.lists = {dial.name: PathList(dial, problem, keys) for dial in problem.dials}
        self._cover = problem.use != "some"
        first = next(iter(self.lists.values()))
        self._plain = [[each for each in passes if each.driver is not None] for passes in first.passes]
        at = {arbor.name: number for number, arbor in enumerate(self.every)}
        self._places = {dial.name: _bit(at.get(dial.place or "", 0)) for dial in problem.dials}

    def skeletons(self, added: int) -> Iterator[Skeleton]:
        """All skeletons with just so many added wheels."""
        dials = tuple(sorted(self.lists))
        new = self.problem.additions.arbors
        left = _Left((1 << len(self.problem.arbors)) - 1, added, _ENDLESS if new is None else new)
        lists = self._viable(dials, {name: np.arange(len(self.lists[name])) for name in dials}, _Above(), left)
        if lists is None:
            return
        for root, after in self._survivor_joint(0, dials, lists, _Above(), left, None):
            if not after.wheels and not (self._cover and after.arbors):
                wanted = tuple((name, self.lists[name].wanted_quotients(row)) for name, row in sorted(after.shown))
                yield Skeleton(root, wanted)

    # what hangs from a driving wheel

    def _forest(
        self, dials: Dials, lists: _Lists, above: _Above, left: _Left, later: int | None, least: int = 1
    ) -> Iterator[tuple[tuple[Limb, ...], _Left]]:
        """Limbs that share out some dials."""
        for blocks in _partitions(dials):
            if len(blocks) >= least:
                known = [self._viable(block, lists, above, left) for block in blocks]
                found = [lists for lists in known if lists is not None]
                if len(found) == len(blocks) and self._matched(found, above, left):
                    found.sort(key=lambda some: min(map(len, some.values())))
                    yield from self._limbs(found, above, left, later)

    def _limbs(
        self, blocks: Sequence[_Lists], above: _Above, left: _Left, later: int | None
    ) -> Iterator[tuple[tuple[Limb, ...], _Left]]:
        """Limbs to the dials of each block; what the later ones need at least is kept for them."""
        if not blocks:
            yield (), left
            return
        kept = sum(self._least(some, above) for some in blocks[1:])
        if kept > left.wheels:
            return
        after_it = self._later(blocks[1:], later)
        for limb, after in self._limb(blocks[0], above, left._replace(wheels=left.wheels - kept), after_it):
            for others, end in self._limbs(blocks[1:], above, after._replace(wheels=after.wheels + kept), later):
                yield (limb, *others), end

    def _later(self, blocks: Sequence[_Lists], later: int | None) -> int | None:
        """The arbors that some blocks, and those after them, may use; None if there are none of them."""
        found = later
        for lists in blocks:
            for dial, rows in lists.items():
                found = (found or 0) | int(np.bitwise_or.reduce(self.lists[dial].arbors[rows]))
        return found

    def _matched(self, blocks: Sequence[dict[str, Rows]], above: _Above, left: _Left) -> bool:
        """Keep the paths of parted dials that go together; whether any are left."""
        for some, more in combinations(blocks, 2):
            for one, other in product(sorted(some), sorted(more)):
                self._match(some, more, one, other, above, left.wheels, True)
                if not len(some[one]):
                    return False
        return True

    def _least(self, lists: _Lists, above: _Above) -> int:
        """So many added wheels at least are needed to some dials."""
        return max(int(self.lists[dial].wheels[rows].min()) for dial, rows in lists.items()) - above.wheels

    def _limb(self, lists: _Lists, above: _Above, left: _Left, later: int | None) -> Iterator[tuple[Limb, _Left]]:
        dials = tuple(sorted(lists))
        kept = self._viable(dials, lists, above, left)
        if kept is None or not self._covers(kept, left, later):
            return
        if len(dials) == 1:
            yield from self._leg(dials[0], kept[dials[0]], above, left, later)
            return
        for through, some, there, after in self._stretches(1, dials, kept, above, left, later):
            for compounds in range(after.wheels // 2 + 1):
                for idlers in range(after.wheels - 2 * compounds + 1 if self.problem.idlers else 1):
                    if compounds + idlers <= after.new:
                        limb = Limb(dials, through, compounds, idlers, ())
                        yield from self._ends(limb, some, there, after, later)

    def _ends(
        self, limb: Limb, lists: _Lists, above: _Above, left: _Left, later: int | None
    ) -> Iterator[tuple[Limb, _Left]]:
        """What a limb with several dials may end with."""
        above = above._replace(compounds=above.compounds + limb.compounds, idlers=above.idlers + limb.idlers)
        wheels = left.wheels - 2 * limb.compounds - limb.idlers
        left = left._replace(wheels=wheels, new=left.new - limb.compounds - limb.idlers)
        kept = self._viable(limb.dials, lists, above, left)
        if kept is None or not self._covers(kept, left, later):
            return
        ends: Iterator[tuple[Joint | tuple[Limb, ...], _Left]] = chain(
            self._forest(limb.dials, kept, above, left, later, 2) if limb.arbors else (),
            *(
                self._survivor_joint(at, limb.dials, kept, above, left, later)
                for at in range(1, len(self.every))
                if left.arbors & _bit(at)
            ),
            self._new_joint(limb.dials, kept, above, left, later),
        )
        for end, after in ends:
            yield Limb(limb.dials, limb.through, limb.compounds, limb.idlers, end), after

    # one dial: its list says all

    def _leg(self, dial: str, rows: Rows, above: _Above, left: _Left, later: int | None) -> Iterator[tuple[Limb, _Left]]:
        paths = self.lists[dial]
        fits = paths.new[rows] - above.compounds - above.idlers <= left.new
        if later is None:
            fits &= paths.wheels[rows] - above.wheels == left.wheels
            if self._cover:
                fits &= paths.arbors[rows] & ~above.arbors == left.arbors
        for row in map(int, rows[fits]):
            arbors = int(paths.arbors[row]) & ~above.arbors
            limb = self._as_limb(dial, row, arbors, above)
            wheels = left.wheels - int(paths.wheels[row]) + above.wheels
            new = left.new - int(paths.new[row]) + above.compounds + above.idlers
            yield limb, _Left(left.arbors & ~arbors, wheels, new, (*left.shown, (dial, row)))

    def _as_limb(self, dial: str, row: int, arbors: int, above: _Above) -> Limb:
        paths = self.lists[dial]
        end = Joint(None, ADDED, (dial,))
        through = []
        for at in range(1, len(self.every)):
            if arbors & _bit(at):
                each = paths.passes[at][paths.codes[row, at] - 1]
                if each.driver is None:
                    end = Joint(self.every[at].name, each.driven, (dial,))
                else:
                    through.append((self.every[at].name, each))
        compounds, idlers = int(paths.compounds[row]), int(paths.idlers[row])
        return Limb((dial,), tuple(through), compounds - above.compounds, idlers - above.idlers, end)

    # several dials: surviving arbors in a row, in the order of their numbers

    def _stretches(
        self, start: int, dials: Dials, lists: _Lists, above: _Above, left: _Left, later: int | None
    ) -> Iterator[tuple[tuple[tuple[str, ArborPass], ...], _Lists, _Above, _Left]]:
        yield (), lists, above, left
        for at in range(start, len(self.every)):
            bit = _bit(at)
            if not left.arbors & bit:
                continue
            for code in self._codes(at, dials, lists):
                if code > len(self._plain[at]):
                    continue
                each = self._plain[at][code - 1]
                if (each.idle and self.problem.use == "wheels") or each.added > left.wheels:
                    continue
                there = above._replace(arbors=above.arbors | bit, beside=above.beside + each.added)
                after = left._replace(arbors=left.arbors & ~bit, wheels=left.wheels - each.added)
                kept = self._viable(dials, self._through(at, code, dials, lists), there, after)
                if kept is not None and self._covers(kept, after, later):
                    for through, *rest in self._stretches(at + 1, dials, kept, there, after, later):
                        yield ((self.every[at].name, each), *through), *rest

    def _codes(self, at: int, dials: Dials, lists: _Lists) -> list[int]:
        """The ways through an arbor that the list of one of the dials still knows."""
        short = min(dials, key=lambda dial: len(lists[dial]))
        return [int(code) for code in np.unique(self.lists[short].codes[lists[short], at]) if code]

    def _through(self, at: int, code: int, dials: Dials, lists: _Lists) -> dict[str, Rows]:
        return {dial: lists[dial][self.lists[dial].codes[lists[dial], at] == code] for dial in dials}

    # arbors at which paths end or part

    def _survivor_joint(
        self, at: int, dials: Dials, lists: _Lists, above: _Above, left: _Left, later: int | None
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
                        for drives, end in self._drives(place, blocks, lists, there, done, later):
                            yield _joint(place, here, drives), end

    def _new_joint(
        self, dials: Dials, lists: _Lists, above: _Above, left: _Left, later: int | None
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
                    for drives, end in self._drives(place, blocks, lists, above, done, later):
                        yield _joint(place, here, drives), end

    def _ending(
        self, at: int, driven: PlacedWheel | None, here: Dials, lists: _Lists, above: _Above
    ) -> list[tuple[str, int]] | None:
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

    def _ending_new(self, here: Dials, lists: _Lists, above: _Above) -> list[tuple[str, int]] | None:
        """Rows of the dials that an added arbor shows; None where it does not show them."""
        found = []
        for dial in here:
            shown = self._shown(dial, lists[dial][self.lists[dial].ends_new[lists[dial]]], above)
            if shown is None:
                return None
            found.append(shown)
        return found

    def _shown(self, dial: str, rows: Rows, above: _Above) -> tuple[str, int] | None:
        """The row that ends just here, if one does."""
        paths = self.lists[dial]
        fits = (paths.arbors[rows] == above.arbors) & (paths.compounds[rows] == above.compounds)
        found = rows[fits & (paths.idlers[rows] == above.idlers)]
        return (dial, int(found[0])) if len(found) else None

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
        later: int | None,
    ) -> Iterator[tuple[tuple[_Drive, ...], _Left]]:
        """What hangs from the driving wheels of an arbor."""
        if not blocks:
            yield (), left
            return
        (wheel, dials), others = blocks[0], blocks[1:]
        rest = [{dial: lists[dial] for dial in block} for _, block in others]
        after_it = self._later(rest, later)
        kept = sum(max(0, self._least(some, above)) for some in rest)
        cost = int(wheel is None)
        if cost + kept > left.wheels:
            return
        own = left._replace(wheels=left.wheels - cost - kept)
        for driver, some, there in self._by_wheel(place, wheel, dials, lists, above):
            for limbs, after in self._forest(dials, some, there, own, after_it):
                after = after._replace(wheels=after.wheels + kept)
                for drives, end in self._drives(place, others, lists, above, after, later):
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
                there = above._replace(beside=above.beside + each.added)
                yield None if each.idler else each.driver, some, there

    # what no list knows is not tried

    def _viable(self, dials: Dials, lists: _Lists, above: _Above, left: _Left) -> dict[str, Rows] | None:
        """The paths that still can be completed; None where a dial has none.

        An arbor that other dials have their place on is not for these; and each surviving wheel that a path passes by
        needs a dial of its own.
        """
        free = above.arbors | (left.arbors & ~self._taken(dials))
        found = {}
        for dial in dials:
            paths, rows = self.lists[dial], lists[dial]
            fits = (paths.arbors[rows] & ~free == 0) & (paths.wheels[rows] <= above.wheels + left.wheels)
            fits &= (paths.compounds[rows] >= above.compounds) & (paths.idlers[rows] >= above.idlers)
            idle = paths.idle[rows] & ~above.arbors
            fits &= np.bitwise_count(idle) < len(dials)
            found[dial] = rows[fits]
            if not len(found[dial]):
                return None
        if left.wheels <= 2:
            for one, other in combinations(dials, 2):
                self._match(found, found, one, other, above, left.wheels, False)
                if not len(found[one]):
                    return None
        return found

    def _match(
        self, some: dict[str, Rows], more: dict[str, Rows], one: str, other: str, above: _Above, wheels: int, parted: bool
    ) -> None:
        """Keep the paths to two dials that have a partner: what is not shared needs no more than some added wheels.

        parted   whether they share nothing but what is above
        """
        first, second = self.lists[one], self.lists[other]
        rows, others = some[one], more[other]
        if len(rows) * len(others) > _MOST_PAIRS:
            return
        if parted:
            need = (first.wheels[rows] - above.wheels)[:, None] + (second.wheels[others] - above.wheels)
            fits = (need <= wheels) & (first.arbors[rows][:, None] & second.arbors[others] & ~above.arbors == 0)
        else:
            need = np.full((len(rows), len(others)), wheels)
            fits = np.ones(need.shape, dtype=bool)
        if first.dial.is_exact and second.dial.is_exact:
            quotients = first.wanted[rows][:, None] - second.wanted[others]
            for number in range(min(wheels, 2) + 1):
                asked = fits & (need == number)
                if asked.any():
                    fits[asked] = self.keys.need_few(quotients[asked], number)
        some[one] = rows[fits.any(axis=1)]
        more[other] = others[fits.any(axis=0)]


    def _covers(self, lists: _Lists, left: _Left, later: int | None) -> bool:
        """Whether every surviving arbor that must be used may be."""
        return not self._cover or not left.arbors & ~(self._later([lists], later) or 0)

    def _taken(self, dials: Dials) -> int:
        """Arbors on which other dials have their place, and none of these."""
        others = own = 0
        for dial, bit in self._places.items():
            if dial in dials:
                own |= bit
            else:
                others |= bit
        return others & ~own


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
