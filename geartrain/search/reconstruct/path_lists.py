"""Enumeration of paths: all surviving arbors and wheels that a path from the input to one dial may use.

Most have no answer: what is left of a dial's speed when the surviving wheels on a path are taken out must be a quotient
of few added counts. So few paths remain, whichever trains they then belong to, and a search over trains goes only where
every dial still has one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import QuestionError
from geartrain.search.reconstruct.quotient_keys import Bounds, QuotientKeys, QuotientRanges, prime_powers
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    PlacedWheel,
    ReconstructionProblem,
    SearchedDial,
    too_wide,
)
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, arbor_passes

# Meshes that were seen, as what they leave of the ways of a path through arbors. Arbors that seen meshes hold
# together are a cluster, a part of the tree: one of them is above all others of it, which is the input where that
# is among them. Of two wheels in mesh one drives the other, and its arbor is the parent. A path has the parents of
# all its arbors. So the arbors of a cluster that are on it stand in a row, and it leads over their meshes.


_Fits = NDArray[np.bool_]
"""By way through an arbor, from 1 on, and way through another: whether they go together; 0 where there is none."""


def seen_clusters(problem: ReconstructionProblem) -> tuple[tuple[int, ...], ...]:
    """Arbors by number, the input at 0, that seen meshes hold together; each but the first has a mate before it."""
    mates: dict[int, list[int]] = {}
    for first, _, second, _ in _meshes(problem):
        mates.setdefault(first, []).append(second)
        mates.setdefault(second, []).append(first)
    found: list[tuple[int, ...]] = []
    for start in sorted(mates):
        if not any(start in cluster for cluster in found):
            cluster = [start]
            for at in cluster:
                cluster += [mate for mate in dict.fromkeys(mates[at]) if mate not in cluster]
            found.append(tuple(cluster))
    return tuple(found)


def _meshes(problem: ReconstructionProblem) -> Iterator[tuple[int, str, int, str]]:
    """Each mesh that was seen, as two arbors by number with their wheels."""
    owner = {wheel.name: at for at, arbor in enumerate((problem.input, *problem.arbors)) for wheel in arbor.wheels}
    for one, other in sorted(map(sorted, problem.meshes)):
        yield owner[one], one, owner[other], other


class SeenMeshes:
    """Which ways of a path through arbors go together.

    Parameters
    ----------
    passes : sequence
        By arbor the ways through it, the input first.

    Attributes
    ----------
    order : tuple of int
        The arbors, those of one cluster after each other, and those with many ways first.
    """

    def __init__(self, problem: ReconstructionProblem, passes: Sequence[Sequence[ArborPass]]) -> None:
        clusters = seen_clusters(problem)
        held = {at for cluster in clusters for at in cluster}
        groups = [*clusters, *((at,) for at in range(len(passes)) if at not in held)]
        groups.sort(key=lambda group: (0 not in group or len(group) == 1, -max(len(passes[at]) for at in group)))
        self.order = tuple(at for group in groups for at in group)
        place = {at: number for number, at in enumerate(self.order)}
        self._before = {at: cluster[:number] for cluster in clusters for number, at in enumerate(cluster)}
        self._fits: dict[int, list[tuple[int, _Fits]]] = {at: [] for at in range(len(passes))}
        for mesh in _meshes(problem):
            first, one, second, other = mesh if place[mesh[0]] < place[mesh[2]] else (*mesh[2:], *mesh[:2])
            below = next(0 in cluster for cluster in clusters if first in cluster)
            fits = [
                [_go_together(mine, one, theirs, other, problem.idlers, below) for mine in (None, *passes[first])]
                for theirs in (None, *passes[second])
            ]
            self._fits[second].append((first, np.array(fits, dtype=bool)))

    def allowed(self, codes: NDArray[np.uint16], at: int, code: int) -> NDArray[np.bool_] | None:
        """Which of some paths through the arbors before may take a way through one more; None where all may."""
        if not self._fits[at]:
            return None
        found = np.ones(len(codes), dtype=bool)
        for other, fits in self._fits[at]:
            found &= fits[code][codes[:, other]]
            if code:  # in a row: where its mate is not on the path, no other of the cluster is
                found &= (codes[:, other] > 0) | ~(codes[:, list(self._before[at])] > 0).any(axis=1)
        return found


def _go_together(
    mine: ArborPass | None, one: str, theirs: ArborPass | None, other: str, idlers: bool, below: bool
) -> bool:
    """Whether a path may have these ways through two arbors whose wheels `one` and `other` mesh.

    below   whether the second arbor must be driven by the first
    """
    if mine is None or theirs is None:
        there, wheel = (mine, one) if theirs is None else (theirs, other)
        return there is None or (not (below and mine is None) and (idlers or not _is(there.driven, wheel)))
    if _is(mine.driver, one) and _is(theirs.driven, other):
        return True
    return not below and _is(theirs.driver, other) and _is(mine.driven, one)


def _is(wheel: PlacedWheel | None, name: str) -> bool:
    return wheel is not None and wheel.name == name


# Paths through more and more surviving arbors, millions at a time, as columns of arrays.


@dataclass(frozen=True)
class PathGrowth:
    """Paths through some of the arbors, a row each."""

    codes: NDArray[np.uint16]
    """By arbor, which way through it is taken, from 1 on; 0 where none is."""
    keys: NDArray[np.uint64]
    """Of what is left to be added: its key, and the powers of large primes in it."""
    powers: NDArray[np.int8]
    """Of what is left to be added: its key, and the powers of large primes in it."""
    drivers: NDArray[np.int8]
    """Added wheels beside surviving ones that drive, and that are driven."""
    driven: NDArray[np.int8]
    """Added wheels beside surviving ones that drive, and that are driven."""
    added: NDArray[np.int8]
    """Added wheels, idlers counted too, and surviving wheels that are passed by."""
    idle: NDArray[np.int8]
    """Added wheels, idlers counted too, and surviving wheels that are passed by."""
    need: NDArray[np.int8]
    """Added wheels that must have a large prime which no later arbor has."""
    ended: NDArray[np.bool_]
    """Whether the path ends at one of the arbors."""

    @staticmethod
    def start(arbors: int, key: int, powers: NDArray[np.int8]) -> PathGrowth:
        """One path, through nothing yet."""
        none = np.zeros(1, dtype=np.int8)
        return PathGrowth(
            np.zeros((1, arbors), dtype=np.uint16),
            np.array([key], dtype=np.uint64),
            powers[None, :],
            *(none,) * 5,
            np.zeros(1, dtype=bool),
        )

    def columns(self) -> tuple[NDArray[Any], ...]:
        """All of it, a row each."""
        numbers = self.drivers, self.driven, self.added, self.idle, self.need
        return self.codes, self.keys, self.powers, *numbers, self.ended

    @staticmethod
    def joined(parts: list[PathGrowth]) -> PathGrowth:
        """All paths of some."""
        return PathGrowth(*map(np.concatenate, zip(*(part.columns() for part in parts), strict=True)))

    def kept(self, rows: NDArray[np.bool_] | np.bool_ | slice) -> PathGrowth:
        """Some of the paths."""
        return PathGrowth(*(column[rows] for column in self.columns()))

    def along(
        self,
        closing: Sequence[int],
        lost: NDArray[np.bool_],
        each: ArborPass | None,
        powers: NDArray[np.int8],
        limits: tuple[int, int | None],
    ) -> PathGrowth:
        """The paths that may go through one arbor more, or past it, with the added wheels that they need then.

        closing   columns of large primes that no later arbor has
        lost      by column, whether no added wheel has the prime
        limits    how many wheels may be added, and how many may be passed by
        """
        wheels, debts = limits
        need = self.need.copy()
        good = np.ones(len(need), dtype=bool) if each is None or each.driver is not None else ~self.ended
        for column in closing:
            left = self.powers[:, column] + powers[column]
            need += np.abs(left)
            if lost[column]:
                good &= left == 0
        good &= need <= wheels
        if each is not None:
            good &= self.added <= wheels - each.added
            if debts is not None:
                good &= self.idle <= debts - each.idle
        return replace(self, need=need).kept(good)

    def through(self, at: int, code: int, each: ArborPass, key: np.uint64, powers: NDArray[np.int8]) -> PathGrowth:
        """The same paths, through one arbor more; none of them has ended where the arbor would end it."""
        codes = self.codes.copy()
        codes[:, at] = code
        return PathGrowth(
            codes,
            self.keys + key,
            self.powers + powers,
            self.drivers + np.int8(each.added_drivers),
            self.driven + np.int8(each.added_driven),
            self.added + np.int8(each.added),
            self.idle + np.int8(each.idle),
            self.need,
            self.ended | (each.driver is None),
        )


Rows = NDArray[np.int64]
WayThrough = tuple[PlacedWheel | None, PlacedWheel | None]
"""The wheel by which a path comes into a surviving arbor and the one by which it goes on, as of `ArborPass`."""
_MOST_PATHS = 1_000_000_000
"""Paths that are looked at on the way to those that are possible: minutes."""
_PIECE = 1 << 19
"""Paths that are grown at once."""


@dataclass(frozen=True)
class AddedArbors:
    """Added arbors on a path: `compounds` with a driven and a driving wheel, `idlers` with one wheel that is both."""

    compounds: int
    idlers: int

    @property
    def wheels(self) -> int:
        """Number of their wheels."""
        return 2 * self.compounds + self.idlers


class PathList:
    """Paths to a dial, one a row.

    along   by surviving arbor the only way through it that is listed, and no other arbors; None for all paths

    codes                by row and arbor, the input first: which of `passes` is taken, from 1 on; 0 where none is
    arbors               by row: bit i - 1 for each surviving arbor i on the path
    idle                 by row: the same for those where surviving wheels are passed by that must mesh
    ends_new             by row: whether the dial's arbor is added
    compounds, idlers    by row: number of added arbors before the last
    wheels, new          by row: number of added wheels and of added arbors
    wanted               by row: key of the quotient that the added wheels must have, where it must be exact
    powers               by row and large prime, the columns of `primes`: its power in that quotient
    """

    def __init__(
        self,
        dial: SearchedDial,
        problem: ReconstructionProblem,
        keys: QuotientKeys,
        along: Mapping[str, WayThrough] | None = None,
    ) -> None:
        self.dial, self.problem, self.keys = dial, problem, keys
        self._along = along
        self.ranges = QuotientRanges(problem.additions.minimum, problem.additions.maximum)
        every = (problem.input, *problem.arbors)
        self.passes = tuple(tuple(self._passes(at)) for at in range(len(every)))
        self._seen = SeenMeshes(problem, self.passes)
        plans = tuple(_plans(problem.additions.wheels, problem.idlers))
        growth, possible = self._possible_paths(plans)
        rows, taken = np.nonzero(possible)
        bits = np.int64(1) << np.arange(len(every) - 1, dtype=np.int64)
        self.codes = growth.codes[rows]
        self.arbors = (self.codes[:, 1:] > 0) @ bits
        self.idle = self._passed_by()[:, 1:] @ bits
        self.ends_new = ~growth.ended[rows]
        self.compounds = np.array([plan.compounds for plan in plans], dtype=np.int64)[taken]
        self.idlers = np.array([plan.idlers for plan in plans], dtype=np.int64)[taken]
        self.wheels = growth.added[rows] + self.ends_new + 2 * self.compounds + self.idlers
        self.wanted = growth.keys[rows]
        self.powers = growth.powers[rows]
        self.new = self.compounds + self.idlers + self.ends_new

        self._driven = [np.array([-1, *_numbered_wheels(passes)]) for passes in self.passes]

    def driven_at(self, rows: Rows) -> NDArray[np.int64]:
        """By row and arbor, a number of the wheel that is driven, with its count; -1 where the path is elsewhere."""
        codes = self.codes[rows]
        found = np.empty(codes.shape, dtype=np.int64)
        for at, driven in enumerate(self._driven):
            found[:, at] = driven[codes[:, at]]
        return found

    def __len__(self) -> int:
        return len(self.codes)

    def _passed_by(self) -> NDArray[np.bool_]:
        found = np.zeros(self.codes.shape, dtype=bool)
        if self.problem.use == "wheels":
            for at, passes in enumerate(self.passes):
                found[:, at] = np.array([False, *(each.idle > 0 for each in passes)])[self.codes[:, at]]
        return found

    def _passes(self, at: int) -> Iterator[ArborPass]:
        problem = self.problem
        arbor = (problem.input, *problem.arbors)[at]
        # those that end come last: so the others have the same codes in the lists of all dials
        for each in sorted(arbor_passes(arbor, problem), key=lambda each: each.driver is None):
            if each.driver is None and self.dial.place not in (None, arbor.name):
                continue
            if problem.use == "wheels" and each.idle >= len(problem.dials):
                continue
            yield each

    # growth, arbor by arbor

    def _possible_paths(self, plans: tuple[AddedArbors, ...]) -> tuple[PathGrowth, NDArray[np.bool_]]:
        """Paths through all arbors for which some plan is possible, and by path and plan whether it is."""
        growth = PathGrowth.start(len(self.passes), self._wanted_key, self._wanted_powers)
        self._looked_at = 0
        found = []
        for piece in self._grown(growth, self._seen.order):
            if self.dial.place not in (None, NEW):
                piece = piece.kept(piece.ended)
            possible = self._possible(piece, plans)
            some = possible.any(axis=1)
            found.append((piece.kept(some), possible[some]))
        if not found:
            none = np.zeros(1, dtype=bool)
            return growth.kept(none), np.zeros((0, len(plans)), dtype=bool)
        return PathGrowth.joined([piece for piece, _ in found]), np.concatenate([possible for _, possible in found])

    def _grown(self, growth: PathGrowth, order: tuple[int, ...]) -> Iterator[PathGrowth]:
        """Paths through some more arbors, in pieces that fit into memory."""
        if not order:
            yield growth
            return
        later = {prime for each in order[1:] for prime in self._primes_of(each)}
        own = set(self.primes) if len(order) == len(self.passes) else self._primes_of(order[0])
        closing = [column for column, prime in enumerate(self.primes) if prime in own and prime not in later]
        growth = self._with_arbor(growth, order[0], closing)
        for start in range(0, len(growth.codes), _PIECE):
            yield from self._grown(growth.kept(slice(start, start + _PIECE)), order[1:])

    def _with_arbor(self, growth: PathGrowth, at: int, closing: Sequence[int]) -> PathGrowth:
        """Paths through one arbor more, or past it; `closing` are columns of primes that no later arbor has."""
        debts = len(self.problem.dials) - 1 if self.problem.use == "wheels" else None
        limits = self.problem.additions.wheels, debts
        parts = []
        for code, each in enumerate((None, *self.passes[at])):
            if (each is None and not at) or not self._is_listed(at, each):
                continue
            good = self._seen.allowed(growth.codes, at, code)
            own = growth if good is None else growth.kept(good)
            self._looked_at += len(own.codes)
            if each is None:
                parts.append(own.along(closing, self._lost, None, np.zeros(len(self.primes), dtype=np.int8), limits))
            else:
                key, powers = self._step(each)
                parts.append(own.along(closing, self._lost, each, powers, limits).through(at, code, each, key, powers))
        if self._looked_at > _MOST_PATHS:
            what = f"more than {_MOST_PATHS} paths to '{self.dial.name}' would have to be looked at"
            raise QuestionError(too_wide(self.problem, what))
        return PathGrowth.joined(parts) if parts else growth.kept(np.zeros(len(growth.codes), dtype=bool))

    def _is_listed(self, at: int, each: ArborPass | None) -> bool:
        """Whether a way through an arbor, or none, is one of those that are listed."""
        if self._along is None:
            return True
        arbor = (self.problem.input, *self.problem.arbors)[at]
        return self._along.get(arbor.name) == (None if each is None else (each.driven, each.driver))

    def _step(self, each: ArborPass) -> tuple[np.uint64, NDArray[np.int8]]:
        """By how much a pass changes the key, and the powers of large primes, of what is left to be added."""
        if each.idler:
            return np.uint64(0), np.zeros(len(self.primes), dtype=np.int8)
        ratio = Fraction(_sure(each.driven), _sure(each.driver))
        return np.uint64(self.keys.key(ratio)), self._powers(ratio)

    # primes of which an added wheel holds one at most

    @cached_property
    def primes(self) -> tuple[int, ...]:
        """Primes of which an added wheel has one at most, and none beside it; none where the dial has a tolerance."""
        if not self.dial.is_exact:
            return ()
        minimum = self.problem.additions.maximum
        found = {prime for at in range(len(self.passes)) for prime in self._primes_of(at)}
        found |= {
            prime for prime, _ in (*prime_powers(self._wanted.numerator), *prime_powers(self._wanted.denominator))
        }
        return tuple(sorted(prime for prime in found if prime * prime > minimum))

    @cache  # noqa: B019 -- lives as long as the list
    def _primes_of(self, at: int) -> frozenset[int]:
        counts = {_sure(wheel) for each in self.passes[at] for wheel in (each.driven, each.driver)}
        return frozenset(prime for count in counts for prime, _ in prime_powers(count))

    def _powers(self, ratio: Fraction) -> NDArray[np.int8]:
        up, down = dict(prime_powers(ratio.numerator)), dict(prime_powers(ratio.denominator))
        return np.array([up.get(prime, 0) - down.get(prime, 0) for prime in self.primes], dtype=np.int8)

    @cached_property
    def _lost(self) -> NDArray[np.bool_]:
        """Which primes no added wheel has."""
        return np.array([prime > self.problem.additions.maximum for prime in self.primes], dtype=bool)

    @cached_property
    def _wanted(self) -> Fraction:
        """Magnitude of the dial's speed over that of the input, the least where it has a tolerance."""
        minimum = self.dial.minimum
        return abs(minimum / self.problem.input_speed) if minimum else Fraction(1)

    @property
    def _wanted_key(self) -> int:
        return self.keys.key(self._wanted)

    @property
    def _wanted_powers(self) -> NDArray[np.int8]:
        return self._powers(self._wanted)

    # which added arbors may be on a path

    def _possible(self, growth: PathGrowth, plans: tuple[AddedArbors, ...]) -> NDArray[np.bool_]:
        """By path and plan, whether the plan may be the added arbors on the path."""
        new = ~growth.ended
        found = np.zeros((len(growth.codes), len(plans)), dtype=bool)
        for at, plan in enumerate(plans):
            fits = growth.added + new + plan.wheels <= self.problem.additions.wheels
            if self.problem.additions.arbors is not None:
                fits &= new + np.int64(plan.compounds + plan.idlers) <= self.problem.additions.arbors
            turned = self._turned(growth.codes, new + np.int64(plan.compounds + plan.idlers))
            fits &= np.where(turned, self._may_turn(True), self._may_turn(False))
            fits &= self._may_be_quotient(growth, plan.compounds, turned, fits)
            found[:, at] = fits
        return found

    def _ring_meshes(self, codes: NDArray[np.uint16]) -> NDArray[np.int64]:
        """By path, number of its meshes with a ring: these do not reverse the sense. A ring meshes no ring."""
        found = np.zeros(len(codes), dtype=np.int64)
        if self.problem.rings:
            for at, passes in enumerate(self.passes):
                found += np.array([0, *(each.meshes_with(self.problem.rings) for each in passes)])[codes[:, at]]
        return found

    def _may_turn(self, turned: bool) -> bool:
        """Whether the dial may turn the other way than the input, or the same way."""
        return self._magnitudes(turned)[1] > 0

    def _magnitudes(self, turned: bool) -> tuple[Fraction, Fraction]:
        """Least and greatest magnitude of the dial's speed if it turns so; the greatest is 0 where it must not."""
        low, high = self.dial.minimum, self.dial.maximum
        if self.dial.signed and (self.problem.input_speed > 0) == turned:
            low, high = -high, -low
        return max(low, Fraction(0)), max(high, Fraction(0))

    def _may_be_quotient(
        self, growth: PathGrowth, compounds: int, turned: NDArray[np.bool_], requested: NDArray[np.bool_]
    ) -> NDArray[np.bool_]:
        found = requested.copy()
        kinds = growth.drivers.astype(np.int64) * 64 + growth.driven + ~growth.ended
        for kind in np.unique(kinds[requested]):
            rows = np.flatnonzero(requested & (kinds == kind))
            drivers, driven = int(kind) // 64 + compounds, int(kind) % 64 + compounds
            if self.dial.is_exact:
                found[rows] = self.keys.may_be_quotients(growth.keys[rows], drivers, driven)
            else:
                found[rows] = self.ranges.may_hold(self._bounds(growth.codes[rows], turned[rows]), drivers, driven)
        return found

    # a path's speed

    @cached_property
    def bounds(self) -> Bounds:
        """By row, least and greatest quotient that the added wheels on a path may have, up to rounding."""
        return self._bounds(self.codes, self._turned(self.codes, self.new))

    def _bounds(self, codes: NDArray[np.uint16], turned: NDArray[np.bool_]) -> Bounds:
        known = np.full(len(codes), float(abs(self.problem.input_speed)))
        for at, passes in enumerate(self.passes):
            ratios = [1.0, *(1.0 if one.idler else _sure(one.driver) / _sure(one.driven) for one in passes)]
            known *= np.array(ratios)[codes[:, at]]
        (low, high), (turned_low, turned_high) = self._magnitudes(False), self._magnitudes(True)
        minimum = np.where(turned, float(turned_low), float(low))
        return minimum / known, np.where(turned, float(turned_high), float(high)) / known

    def known_ratio(self, row: int) -> Fraction:
        """Product of the surviving wheels that drive over that of those that are driven, on a path."""
        taken = [passes[code - 1] for passes, code in zip(self.passes, self.codes[row], strict=True) if code]
        taken = [each for each in taken if not each.idler]
        return Fraction(prod(_sure(each.driver) for each in taken), prod(_sure(each.driven) for each in taken))

    def turns(self, row: int) -> bool:
        """Whether a path's dial turns the other way than the input."""
        return bool(self._turned(self.codes[row : row + 1], self.new[row : row + 1])[0])

    def _turned(self, codes: NDArray[np.uint16], new: NDArray[np.int64]) -> NDArray[np.bool_]:
        """The same for each of some paths, with their numbers of added arbors."""
        return np.asarray(((codes[:, 1:] > 0).sum(axis=1) + new - self._ring_meshes(codes)) % 2 == 1)

    def wanted_quotients(self, row: int) -> tuple[Fraction, Fraction]:
        """Least and greatest quotient that the added wheels on a path may have."""
        known = abs(self.known_ratio(row) * self.problem.input_speed)
        low, high = self._magnitudes(self.turns(row))
        return low / known, high / known


def _plans(wheels: int, idlers: bool) -> Iterator[AddedArbors]:
    for compounds in range(wheels // 2 + 1):
        for single in range(wheels - 2 * compounds + 1 if idlers else 1):
            yield AddedArbors(compounds, single)


def _numbered_wheels(passes: tuple[ArborPass, ...]) -> Iterator[int]:
    """By pass, a number of its driven wheel that is the same in the lists of all dials."""
    numbers = dict.fromkeys(each.driven for each in passes)
    known = {wheel: number for number, wheel in enumerate(sorted(numbers, key=repr))}
    for each in passes:
        yield known[each.driven]


def _sure(wheel: object) -> int:
    """The count of a surviving wheel on a path; 1 for an added one, and for none."""
    teeth = getattr(wheel, "teeth", 1)
    return teeth if wheel is not None and wheel != ADDED else 1
