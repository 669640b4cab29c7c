"""Enumeration of all paths from the input to one dial through surviving arbors and wheels.

Most paths are impossible, because the required speed of the dial divided by the speed that the surviving wheels give
must be a quotient of a few added tooth counts. Few paths remain, and the search for trains visits only branches in
which every dial still has a path.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache, cached_property
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geartrain.errors import QuestionError
from geartrain.numerics.arrays import Bools, Floats
from geartrain.search.reconstruct.added_counts import Bounds, QuotientTables, prime_powers
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    PlacedWheel,
    ReconstructionProblem,
    SearchedDial,
    too_wide,
)
from geartrain.search.reconstruct.train_topology import ADDED, ArborPass, arbor_passes

# Restrictions of the passes of a path by known meshes. A connected component of arbors under known meshes is a subtree:
# one arbor is above all others of it, and it is the input if that belongs to the component. One of two meshing wheels
# drives the other, and its arbor is the parent. A path contains the parents of all its arbors, so the arbors of a
# component on it are consecutive, and the path uses their known meshes.


_Fits = Bools
"""Compatibility matrix of the passes of a path through two arbors, indexed by the codes of the passes. Code 0 means
that the path avoids the arbor.
"""


def seen_clusters(problem: ReconstructionProblem) -> tuple[tuple[int, ...], ...]:
    """Return the connected components that the known meshes form among the arbors, as tuples of arbor indices. The
    input arbor has index 0.

    Each arbor of a component except the first meshes with an earlier arbor of the component.
    """
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
    """Yield each known mesh as (arbor index, wheel name, arbor index, wheel name). The input arbor has index 0."""
    owner = {wheel.name: at for at, arbor in enumerate((problem.input, *problem.arbors)) for wheel in arbor.wheels}
    for one, other in sorted(map(sorted, problem.meshes)):
        yield owner[one], one, owner[other], other


class SeenMeshes:
    """Test whether a path may pass through several arbors in given ways, according to the known meshes. A pass is the
    pair of the driven and the driving wheel of an arbor on the path.

    passes   possible passes of each arbor, the input arbor first
    order    order in which paths are extended, as indices of arbors: arbors that known meshes connect are adjacent, and
             connected arbors with many passes come first
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
                [_are_compatible(mine, one, theirs, other, problem.idlers, below) for mine in (None, *passes[first])]
                for theirs in (None, *passes[second])
            ]
            self._fits[second].append((first, np.array(fits, dtype=bool)))

    def allowed(self, codes: NDArray[np.uint16], at: int, code: int) -> Bools | None:
        """Return a mask of the paths that may be extended by one pass of the arbor with index `at`; None if all paths
        may be.

        codes   number of the pass of each path through each arbor, shape (paths, arbors)
        code    number of the pass, starting with 1; 0 if the paths avoid the arbor
        """
        if not self._fits[at]:
            return None
        found = np.ones(len(codes), dtype=bool)
        for other, fits in self._fits[at]:
            found &= fits[code][codes[:, other]]
            if code:  # consecutive: if its mate is not on the path, no other arbor of the component is
                found &= (codes[:, other] > 0) | ~(codes[:, list(self._before[at])] > 0).any(axis=1)
        return found


def _are_compatible(
    mine: ArborPass | None, one: str, theirs: ArborPass | None, other: str, idlers: bool, below: bool
) -> bool:
    """Return whether one path may pass through two arbors in given ways. The wheels `one` and `other` of these arbors
    are known to mesh.

    mine, theirs   driven and driving wheel of each arbor on the path; None if the path avoids the arbor
    idlers         True if a driven wheel may also drive
    below          True if the arbor of wheel `one` must drive the arbor of wheel `other`
    """
    if mine is None or theirs is None:
        there, wheel = (mine, one) if theirs is None else (theirs, other)
        return there is None or (not (below and mine is None) and (idlers or not _is_named(there.driven, wheel)))
    if _is_named(mine.driver, one) and _is_named(theirs.driven, other):
        return True
    return not below and _is_named(theirs.driver, other) and _is_named(mine.driven, one)


def _is_named(wheel: PlacedWheel | None, name: str) -> bool:
    return wheel is not None and wheel.name == name


# Partial paths through surviving arbors as columns of arrays, millions at a time.


class PathGrowth(NamedTuple):
    """Partial paths through some of the arbors. Each row of the arrays represents one path."""

    codes: NDArray[np.uint16]
    """Code of the pass (pair of driven and driving wheel) of each path through each arbor, starting with 1; 0 if the
    path avoids the arbor.
    """
    ratio: Floats
    """Magnitude of the speed at the end of each path if the ratio of the added wheels is 1 [turns per unit of time]."""
    powers: NDArray[np.int8]
    """Exponents of the large primes in the quotient of tooth counts required from the added wheels, shape (paths,
    primes).
    """
    drivers: NDArray[np.int8]
    """Number of added driving wheels on the surviving arbors of each path."""
    driven: NDArray[np.int8]
    """Number of added driven wheels on the surviving arbors of each path."""
    added: NDArray[np.int8]
    """Number of added wheels on the surviving arbors of each path, including idlers."""
    idle: NDArray[np.int8]
    """Number of surviving wheels that are on the arbors of each path but are not used by the path."""
    need: NDArray[np.int8]
    """Number of added wheels whose tooth counts must be divisible by a large prime, because no later arbor has a wheel
    that contains this prime.
    """
    ended: Bools
    """True for each path that ends at one of the surviving arbors."""

    @staticmethod
    def joined(parts: list[PathGrowth]) -> PathGrowth:
        """Return the paths of several parts, joined into one set of arrays."""
        return PathGrowth(*map(np.concatenate, zip(*parts, strict=True)))

    def kept(self, rows: Bools | np.bool_ | slice) -> PathGrowth:
        """Return the selected paths with the corresponding rows of all arrays."""
        columns: tuple[Any, ...] = self
        return PathGrowth(*(column[rows] for column in columns))

    def along(
        self,
        closing: Sequence[int],
        lost: Bools,
        each: ArborPass | None,
        powers: NDArray[np.int8],
        limits: tuple[int, int | None],
    ) -> PathGrowth:
        """Return the paths that may be extended by one more arbor with the given driven and driving wheel, or that may
        avoid the arbor if `each` is None. Their numbers of added wheels that must contain a large prime are updated.

        closing   columns of the large primes that occur in no later arbor
        lost      True for each column whose prime is larger than the maximum tooth count
        powers    exponents of the large primes that the pass adds to the required quotient
        limits    maximum number of added wheels, and maximum number of unused surviving wheels (None for no limit)
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
        return self._replace(need=need).kept(good)

    def through(self, at: int, code: int, each: ArborPass, ratio: float, powers: NDArray[np.int8]) -> PathGrowth:
        """Return the paths extended by one more arbor, which has the index `at`. None of the paths may already end at
        an arbor.

        code     number of the pass, the pair of driven and driving wheel
        each     the pass itself
        ratio    factor of the speed due to the surviving wheels of the pass
        powers   exponents of the large primes that the pass adds to the required quotient
        """
        codes = self.codes.copy()
        codes[:, at] = code
        return PathGrowth(
            codes,
            self.ratio * ratio,
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
"""Driven wheel and driving wheel of a path on a surviving arbor, as in `ArborPass`."""
_MOST_PATHS = 1_000_000_000
"""Maximum number of partial paths that are examined. The examination of this number takes minutes."""
_PIECE = 1 << 19
"""Number of partial paths that are extended together."""


AddedArbors = tuple[int, int]
"""Number of added arbors with two wheels, and number of added arbors with one wheel (idlers), on a path."""


class PathList:
    """Possible paths to a dial. Each row of the arrays represents one path.

    along   driven and driving wheel of each surviving arbor through which the paths must pass, keyed by arbor; the
            paths avoid all other surviving arbors. None to list all paths

    codes                code of the pass of each arbor, the input arbor first: 1 + index in `passes`, or 0 if the path
                         avoids the arbor; shape (rows, arbors)
    arbors               bit mask of the surviving arbors on the path, with bit i - 1 for arbor i
    ends_new             True if the arbor that carries the pointer is added
    compounds, idlers    numbers of added arbors with two wheels and with one wheel; an added last arbor is not counted
    wheels, new          number of added wheels, and number of added arbors
    bounds               minimum and maximum quotient of the tooth counts of the added wheels, up to rounding errors
    """

    def __init__(
        self,
        dial: SearchedDial,
        problem: ReconstructionProblem,
        tables: QuotientTables,
        along: Mapping[str, WayThrough] | None = None,
    ) -> None:
        self.dial, self.problem, self.tables = dial, problem, tables
        self._along = along
        every = (problem.input, *problem.arbors)
        self.passes = tuple(tuple(self._passes(at)) for at in range(len(every)))
        self._seen = SeenMeshes(problem, self.passes)
        most = problem.additions.wheels
        plans: tuple[AddedArbors, ...] = tuple(
            (compounds, idlers)
            for compounds in range(most // 2 + 1)
            for idlers in range(most - 2 * compounds + 1 if problem.idlers else 1)
        )
        growth, possible = self._possible_paths(plans)
        rows, taken = np.nonzero(possible)
        bits = np.int64(1) << np.arange(len(every) - 1, dtype=np.int64)
        self.codes = growth.codes[rows]
        self.arbors = (self.codes[:, 1:] > 0) @ bits
        self.ends_new = ~growth.ended[rows]
        self.compounds, self.idlers = np.array(plans, dtype=np.int64)[taken].T
        self.wheels = growth.added[rows] + self.ends_new + 2 * self.compounds + self.idlers
        self.new = self.compounds + self.idlers + self.ends_new
        self.bounds = self._bounds(growth.ratio[rows], self._turned(self.codes, self.new))

    def _passes(self, at: int) -> Iterator[ArborPass]:
        problem = self.problem
        arbor = (problem.input, *problem.arbors)[at]
        # passes that end come last, so that the others have the same codes in the lists of all dials
        for each in sorted(arbor_passes(arbor, problem), key=lambda each: each.driver is None):
            if each.driver is None and self.dial.place not in (None, arbor.name):
                continue
            if problem.use == "wheels" and each.idle >= len(problem.dials):
                continue
            yield each

    # extension by one arbor at a time

    def _possible_paths(self, plans: tuple[AddedArbors, ...]) -> tuple[PathGrowth, Bools]:
        """Return the complete paths, and a Boolean matrix that is True for the numbers of added arbors that are
        possible with each path, shape (paths, plans). A plan is a pair (added arbors with two wheels, added arbors with
        one wheel).
        """
        # a single path through no arbor
        zero = np.zeros(1, dtype=np.int8)
        growth = PathGrowth(
            np.zeros((1, len(self.passes)), dtype=np.uint16),
            np.array([float(abs(self.problem.input_speed))]),
            self._powers(self._wanted)[None, :],
            *(zero,) * 5,
            ended=np.zeros(1, dtype=bool),
        )
        self._examined = 0
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
        """Yield the paths after extension by the arbors in `order`, in several sets of at most about `_PIECE` paths, to
        save memory.
        """
        if not order:
            yield growth
            return
        later = {prime for each in order[1:] for prime in self._primes_of(each)}
        own = set(self.primes) if len(order) == len(self.passes) else self._primes_of(order[0])
        closing = [column for column, prime in enumerate(self.primes) if prime in own and prime not in later]
        growth = self._with_arbor(growth, order[0], closing)
        # depth first, so that at most one block for each arbor is in memory
        for start in range(0, len(growth.codes), _PIECE):
            yield from self._grown(growth.kept(slice(start, start + _PIECE)), order[1:])

    def _with_arbor(self, growth: PathGrowth, at: int, closing: Sequence[int]) -> PathGrowth:
        """Return the paths extended through the arbor with index `at`, and the paths that avoid it. `closing` contains
        the columns of primes that occur in no later arbor.
        """
        # wheels unused on this path must be used on paths to the other dials
        debts = len(self.problem.dials) - 1 if self.problem.use == "wheels" else None
        limits = self.problem.additions.wheels, debts
        arbor = (self.problem.input, *self.problem.arbors)[at]
        lost = np.array([prime > self.problem.additions.maximum for prime in self.primes], dtype=bool)
        parts = []
        for code, each in enumerate((None, *self.passes[at])):
            if each is None and not at:  # every path includes the input arbor
                continue
            way = None if each is None else (each.driven, each.driver)
            if self._along is not None and self._along.get(arbor.name) != way:
                continue
            good = self._seen.allowed(growth.codes, at, code)
            own = growth if good is None else growth.kept(good)
            self._examined += len(own.codes)
            ratio = Fraction(1) if each is None else _known_ratio(each)
            powers = self._powers(1 / ratio)
            allowed = own.along(closing, lost, each, powers, limits)
            parts.append(allowed if each is None else allowed.through(at, code, each, float(ratio), powers))
        if self._examined > _MOST_PATHS:
            what = f"more than {_MOST_PATHS} paths to '{self.dial.name}' would have to be examined"
            raise QuestionError(too_wide(self.problem, what))
        return PathGrowth.joined(parts) if parts else growth.kept(np.zeros(len(growth.codes), dtype=bool))

    # large primes: an added tooth count contains at most one of them

    @cached_property
    def primes(self) -> tuple[int, ...]:
        """Primes so large that the tooth count of an added wheel is divisible by at most one of them, and not by its
        square. The result is empty if the dial has a tolerance.
        """
        if not self.dial.is_exact:
            return ()
        minimum = self.problem.additions.maximum
        found = {prime for at in range(len(self.passes)) for prime in self._primes_of(at)}
        found |= {
            prime for prime, _ in (*prime_powers(self._wanted.numerator), *prime_powers(self._wanted.denominator))
        }
        # a count below the square of a prime contains this prime at most once
        return tuple(sorted(prime for prime in found if prime * prime > minimum))

    @cache  # noqa: B019 -- lives as long as the list
    def _primes_of(self, at: int) -> frozenset[int]:
        counts = {_known_count(wheel) for each in self.passes[at] for wheel in (each.driven, each.driver)}
        return frozenset(prime for count in counts for prime, _ in prime_powers(count))

    def _powers(self, ratio: Fraction) -> NDArray[np.int8]:
        up, down = dict(prime_powers(ratio.numerator)), dict(prime_powers(ratio.denominator))
        return np.array([up.get(prime, 0) - down.get(prime, 0) for prime in self.primes], dtype=np.int8)

    @cached_property
    def _wanted(self) -> Fraction:
        """Magnitude of the speed of the dial divided by the speed of the input. If the dial has a tolerance, its
        minimum speed is used.
        """
        minimum = self.dial.minimum
        return abs(minimum / self.problem.input_speed) if minimum else Fraction(1)

    # added arbors on a path

    def _possible(self, growth: PathGrowth, plans: tuple[AddedArbors, ...]) -> Bools:
        """Return, for each path and each plan, whether the path is possible with the numbers of added arbors in the
        plan, shape (paths, plans). A plan is a pair (added arbors with two wheels, added arbors with one wheel).
        """
        new = ~growth.ended
        found = np.zeros((len(growth.codes), len(plans)), dtype=bool)
        for at, (compounds, idlers) in enumerate(plans):
            arbors = new + np.int64(compounds + idlers)
            fits = growth.added + new + 2 * compounds + idlers <= self.problem.additions.wheels
            if self.problem.additions.arbors is not None:
                fits &= arbors <= self.problem.additions.arbors
            turned = self._turned(growth.codes, arbors)
            # a sense whose maximum magnitude is 0 is excluded
            fits &= np.where(turned, self._magnitudes(True)[1] > 0, self._magnitudes(False)[1] > 0)
            # both numbers in one integer for np.unique; an added last arbor has one more driven wheel
            kinds = growth.drivers.astype(np.int64) * 64 + growth.driven + new
            for kind in np.unique(kinds[fits]):
                rows = np.flatnonzero(fits & (kinds == kind))
                drivers, driven = int(kind) // 64 + compounds, int(kind) % 64 + compounds
                fits[rows] = self.tables.may_hold(self._bounds(growth.ratio[rows], turned[rows]), drivers, driven)
            found[:, at] = fits
        return found

    def _magnitudes(self, turned: bool) -> tuple[Fraction, Fraction]:
        """Return the minimum and the maximum magnitude of the speed of the dial for one sense of rotation. The maximum
        is 0 if this sense is excluded.
        """
        low, high = self.dial.minimum, self.dial.maximum
        if self.dial.signed and (self.problem.input_speed > 0) == turned:
            low, high = -high, -low
        return max(low, Fraction(0)), max(high, Fraction(0))

    # speed of a path

    def _bounds(self, ratio: Floats, turned: Bools) -> Bounds:
        (low, high), (turned_low, turned_high) = self._magnitudes(False), self._magnitudes(True)
        minimum = np.where(turned, float(turned_low), float(low))
        return minimum / ratio, np.where(turned, float(turned_high), float(high)) / ratio

    def _turned(self, codes: NDArray[np.uint16], new: NDArray[np.int64]) -> Bools:
        """Return, for each path, whether the dial turns in the sense opposite to the input. `new` contains the number
        of added arbors of each path.
        """
        reversals = (codes[:, 1:] > 0).sum(axis=1) + new
        rings = self.problem.rings
        for at, passes in enumerate(self.passes if rings else ()):
            # a mesh with a ring does not reverse the sense; an idler has two meshes
            wheels = [(each.driven, each.driver) for each in passes]
            meshes = [0, *(sum(wheel is not None and wheel.name in rings for wheel in pair) for pair in wheels)]
            reversals -= np.array(meshes)[codes[:, at]]
        return np.asarray(reversals % 2 == 1)

    def wanted_quotients(self, row: int) -> tuple[Fraction, Fraction]:
        """Return the minimum and the maximum of the quotient that the tooth counts of the added wheels on the path in a
        given row must have: product of driving counts divided by product of driven counts.
        """
        taken = (passes[code - 1] for passes, code in zip(self.passes, self.codes[row], strict=True) if code)
        known = prod(map(_known_ratio, taken), start=abs(self.problem.input_speed))
        (turned,) = self._turned(self.codes[[row]], self.new[[row]])
        low, high = self._magnitudes(bool(turned))
        return low / known, high / known


def _known_ratio(each: ArborPass) -> Fraction:
    """Return the factor of the speed due to the surviving wheels of a pass: driving by driven tooth count. It is 1 for
    an idler, which is both.
    """
    return Fraction(_known_count(each.driver), _known_count(each.driven))


def _known_count(wheel: PlacedWheel | None) -> int:
    """Return the tooth count of a surviving wheel. Return 1 for an added wheel and for None."""
    return 1 if wheel is None or wheel == ADDED else wheel.teeth
