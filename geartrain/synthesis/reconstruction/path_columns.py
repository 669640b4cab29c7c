"""What of the paths in a list is compared with a path to another dial, in columns: fast for many paths at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.arbor_passes import ADDED, ArborPass
from geartrain.synthesis.reconstruction.path_lists import PathList, Rows
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
from geartrain.synthesis.reconstruction.seen_meshes import seen_clusters

_NEVER = 100
"""Wheels apart, of paths that differ by a prime that no wheel has."""


class PathColumns:
    """The paths of a list, by arbor.

    powers           by large prime and row: its power in what the added wheels must make
    codes            by arbor and row: the way through it, 0 where there is none
    driven, driver   by arbor and row: number of the wheel that is driven with its count, and of the one that drives by
                     its name; 0 where there is none
    ends             by row: bit of the surviving arbor that shows the dial
    passes_added     by row: whether an added wheel is an idler on it
    used             by row: bits of surviving arbors, then of wheels, that are used
    """

    def __init__(self, paths: PathList, problem: ReconstructionProblem) -> None:
        self.paths = paths
        self._clusters = [sum(1 << at - 1 for at in each) for each in seen_clusters(problem) if 0 not in each]
        names = [wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels]
        number = {name: at for at, name in enumerate(names, 1)}
        self.codes = np.ascontiguousarray(paths.codes.T)
        self.powers = {prime: np.ascontiguousarray(paths.powers[:, at]) for at, prime in enumerate(paths.primes)}
        self.driven = np.ascontiguousarray(paths.driven_at(np.arange(len(paths))).T.astype(np.int16)) + np.int16(1)
        self.driver = np.zeros(self.codes.shape, dtype=np.int16)
        self.used = paths.arbors.copy()
        self.ends = np.zeros(len(paths), dtype=np.int64)
        self.passes_added = paths.idlers > 0
        for at, passes in enumerate(paths.passes):
            taken = self.codes[at]
            drivers = [0, *(number.get((each.driver and each.driver.name) or "", 0) for each in passes)]
            self.driver[at] = np.array(drivers, dtype=np.int16)[taken]
            wheels = [0, *(_bits(each, number) << len(problem.arbors) for each in passes)]
            self.used |= np.array(wheels, dtype=np.int64)[taken]
            self.passes_added |= np.array([False, *(each.idler and each.driven == ADDED for each in passes)])[taken]
            if at:
                last = np.array([False, *(each.driver is None for each in passes)])
                self.ends |= np.where(last[taken], np.int64(1) << (at - 1), 0)

    def fit(self, rows: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Which paths may stand in one tree with a path to another dial, or each with one of several.

        Only the arbor at which they part may be left by different wheels, and none is reached by different ones. A
        wheel has one count. Where they part at the input they share no arbor.
        """
        both: Rows = np.asarray(self.paths.arbors[rows] & other.paths.arbors[row])
        good = self._end_in(rows, both, other, row)
        mine, theirs = self.paths.arbors[rows], other.paths.arbors[row]
        for cluster in self._clusters:  # all paths to it lead through the arbor that is above all others of it
            good &= (both & cluster != 0) | (mine & cluster == 0) | (theirs & cluster == 0)
        parted = np.zeros(len(rows), dtype=np.int8)
        one = isinstance(row, int)
        for at in np.flatnonzero(other.codes[:, row]).tolist() if one else range(len(self.codes)):
            codes, others = self.codes[at][rows], other.codes[at, row]
            shared = codes > 0 if one else (codes > 0) & (others > 0)
            left = shared & (codes != others)
            parted += left
            good &= ~(shared & (self.driven[at][rows] != other.driven[at, row]))
            driver = other.driver[at, row]
            if not one or driver:
                good &= ~(left & (self.driver[at][rows] == driver) & (driver > 0))
            if not at:
                good &= ~left | (both == 0)
        return good & (parted <= 1)

    def differing_primes(self, rows: Rows, other: PathColumns, row: int) -> NDArray[np.int8]:
        """How many wheels with a large prime each path and one to another dial have apart from each other, at least."""
        found = np.zeros(len(rows), dtype=np.int16)
        for prime in self.powers.keys() | other.powers.keys():
            own = self.powers[prime][rows] if prime in self.powers else np.int8(0)
            theirs = other.powers[prime][row] if prime in other.powers else np.int8(0)
            differ = np.abs(own - theirs)
            found += differ if prime <= self.paths.problem.additions.greatest else differ * np.int16(_NEVER)
        return np.minimum(found, _NEVER).astype(np.int8)

    def _end_in(self, rows: Rows, both: Rows, other: PathColumns, row: int | Rows) -> NDArray[np.bool_]:
        """Which paths keep to the rule that one which ends at an arbor of the other is a part of it."""
        mine, theirs = self.paths, other.paths
        ends, their_end = (self.ends[rows] & both) != 0, (other.ends[row] & both) != 0
        compounds = mine.compounds[rows] - theirs.compounds[row]
        idlers = mine.idlers[rows] - theirs.idlers[row]
        good = ~ends | ((both == mine.arbors[rows]) & (compounds <= 0) & (idlers <= 0))
        good &= ~their_end | ((both == theirs.arbors[row]) & (compounds >= 0) & (idlers >= 0))
        return np.asarray(good)


def all_to_use(problem: ReconstructionProblem) -> int:
    """Bits of surviving arbors and wheels that must be used, as in `PathColumns.used`."""
    if problem.use == "some":
        return 0
    arbors = (1 << len(problem.arbors)) - 1
    if problem.use == "arbors":
        return arbors
    wheels = sum(len(each.wheels) for each in (problem.input, *problem.arbors))
    return arbors | ((1 << wheels) - 1) << len(problem.arbors)


def _bits(each: ArborPass, number: dict[str, int]) -> int:
    found = 0
    for wheel in (each.driven, each.driver):
        if wheel is not None and wheel.name in number:
            found |= 1 << (number[wheel.name] - 1)
    return found
