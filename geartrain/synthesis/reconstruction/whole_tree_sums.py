"""How many trains the rows of a search of whole trees are, and their skeletons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import groupby
from math import prod

import numpy as np

from geartrain.synthesis.reconstruction.added_count_sums import AddedCountSums, OpenCounts
from geartrain.synthesis.reconstruction.added_structures import AddedSets
from geartrain.synthesis.reconstruction.arbor_roles import Role
from geartrain.synthesis.reconstruction.candidate_prior import added_prior, survivors_prior
from geartrain.synthesis.reconstruction.path_trees import DialPath, Paths, PathTrees
from geartrain.synthesis.reconstruction.prime_shares import Ints
from geartrain.synthesis.reconstruction.skeletons import AddedWheels, Skeleton
from geartrain.synthesis.reconstruction.train_rows import TrainRows
from geartrain.synthesis.reconstruction.whole_trees import WholeTrees


@dataclass(frozen=True)
class SolvedRows:
    """Rows of some added wheels that explain the dials, with the choices of counts and the orders of each."""

    added: AddedSets
    rows: TrainRows
    choices: Ints
    orders: Ints

    @property
    def all_choices(self) -> int:
        """Choices of counts, of all rows."""
        return sum(self.choices.tolist())


class WholeTreeSums:
    """Sums over a question's whole trees."""

    def __init__(self, trees: WholeTrees, counts: AddedCountSums) -> None:
        self.trees, self._counts = trees, counts
        self._shapes = PathTrees(trees.problem, {})
        self._orders: dict[tuple[AddedSets, Role, tuple[Role, ...]], int] = {}

    def solved(self, wheels: int, part: int = 0, parts: int = 1) -> Iterator[SolvedRows]:
        """All rows with just so many added wheels that explain the dials; of several parts one."""
        for number, (added, cores) in enumerate(self.trees.structures.of(wheels).items()):
            if number % parts == part:
                for rows in self.trees.found(added, cores):
                    yield from self._solved(added, rows)

    def skeletons(self, solved: SolvedRows) -> Iterator[tuple[Skeleton, int]]:
        """All skeletons of some rows, each with its number of choices."""
        wheels = self._wheels(solved.added)
        for row, choices in enumerate(solved.choices.tolist()):
            quotients = self.trees.wanted_quotients(solved.rows, row)
            wanted = tuple((dial.name, (one, one)) for dial, one in zip(self.trees.dials, quotients, strict=True))
            for root in self._shapes.roots(self._paths(solved.added, solved.rows, row), len(solved.added)):
                skeleton = Skeleton(root, wanted)
                if skeleton.added == wheels:
                    yield skeleton, choices

    def _solved(self, added: AddedSets, rows: TrainRows) -> Iterator[SolvedRows]:
        if not len(rows):
            return
        orders = self._orders_of(added, rows)
        rows, orders = rows.kept(orders > 0), orders[orders > 0]
        if len(rows):
            choices = self._choices_of(added, rows)
            good = choices > 0
            if good.any():
                yield SolvedRows(added, rows.kept(good), choices[good], orders[good])

    # weights

    def weights(self, solved: Iterable[SolvedRows]) -> Counter[Fraction]:
        """How many trains have each weight before their dials are looked at."""
        found = Counter[Fraction]()
        for some in solved:
            driven = sum(not wheel.drives for wheel in some.added)  # each new arbor has one
            added = added_prior(self.trees.problem, len(some.added), driven)
            kinds = np.array([of[self._reading(some.rows, at)] for at, (of, _) in enumerate(self._readings_prior)])
            several, which = np.unique(kinds, axis=1, return_inverse=True)
            trains = some.choices * some.orders
            for number, kind in enumerate(several.T.tolist()):
                weights = (own[1][one] for own, one in zip(self._readings_prior, kind, strict=True))
                found[prod(weights, start=added)] += int(trains[which.ravel() == number].sum())
        return found

    @cached_property
    def _readings_prior(self) -> list[tuple[Ints, list[Fraction]]]:
        """By arbor: for each reading of each role the number of its weight, and the weights."""
        found = []
        for arbor in self.trees.arbors:
            alone = replace(self.trees.problem, input=arbor.arbor, arbors=())
            weights = [
                survivors_prior(alone, [wheel for wheel in (one.driven, *one.drivers) if wheel is not None])
                for role in arbor.roles
                for one in arbor.of(role)
            ]
            several = list(dict.fromkeys(weights))
            number = {weight: at for at, weight in enumerate(several)}
            found.append((np.array([number[weight] for weight in weights], dtype=np.int64), several))
        return found

    def _reading(self, rows: TrainRows, at: int) -> Ints:
        """By row, the reading of an arbor among all of its roles."""
        reading: Ints = self.trees.columns[at].first[rows.roles[:, at]] + rows.reads[:, at]
        return reading

    # orders

    def _orders_of(self, added: AddedSets, rows: TrainRows) -> Ints:
        """By row, the number of orders of all its trees with these added wheels."""
        _, first, which = np.unique(rows.roles, axis=0, return_index=True, return_inverse=True)
        found = [self._orders_with(added, rows, row) for row in first.tolist()]
        return np.array(found, dtype=object)[which.ravel()]

    def _orders_with(self, added: AddedSets, rows: TrainRows, row: int) -> int:
        """The same of one row: it depends on the roles alone, whichever arbor has which."""
        root, *roles = (arbor.roles[at] for arbor, at in zip(self.trees.arbors, rows.roles[row].tolist(), strict=True))
        key = added, root, tuple(sorted(roles))
        if key not in self._orders:
            wheels = self._wheels(added)
            shapes = self._shapes.roots(self._paths(added, rows, row), len(added))
            skeletons = (Skeleton(shape, ()) for shape in shapes)
            self._orders[key] = sum(each.orders for each in skeletons if each.added == wheels)
        return self._orders[key]

    def _paths(self, added: AddedSets, rows: TrainRows, row: int) -> Paths:
        """The path to each dial."""
        found: Paths = {}
        for number, dial in enumerate(self.trees.dials):
            passes = {}
            for at, arbor in enumerate(self.trees.arbors):
                role = arbor.roles[rows.roles[row, at]]
                if role.on >> number & 1:
                    passes[at] = arbor.passed(role, arbor.of(role)[rows.reads[row, at]], number)
            ends_new = all(each.driver is not None for each in passes.values())
            driven = sum(not wheel.drives and wheel.dials >> number & 1 for wheel in added)
            compounds = driven - ends_new
            arbors = sum(1 << at - 1 for at in passes if at)
            beside = sum(each.added for each in passes.values())
            found[dial.name] = DialPath(arbors, passes, compounds, 0, beside + 2 * compounds + ends_new, ends_new)
        return found

    def _wheels(self, added: AddedSets) -> AddedWheels:
        names = [dial.name for dial in self.trees.dials]
        groups = []
        for dials, some in groupby(added, key=lambda wheel: wheel.dials):
            drives = [wheel.drives for wheel in some]
            led_to = tuple(name for at, name in enumerate(names) if dials >> at & 1)
            groups.append((led_to, sum(drives), len(drives) - sum(drives)))
        return AddedWheels(tuple(sorted(groups)), 0)

    # choices of counts

    def _choices_of(self, added: AddedSets, rows: TrainRows) -> Ints:
        """By row, in how many ways the added wheels may have counts."""
        wheels, found = self._wheels(added), []
        first, which = self._equal(rows)
        for row in first:
            wanted = self.trees.wanted_quotients(rows, row)
            found.append(self._count(wheels, wanted))
        return np.array(found, dtype=object)[which]

    def _count(self, wheels: AddedWheels, quotients: tuple[Fraction, ...]) -> int:
        wanted = tuple((dial.name, (one, one)) for dial, one in zip(self.trees.dials, quotients, strict=True))
        return self._counts.total(OpenCounts(wheels, wanted))

    def _equal(self, rows: TrainRows) -> tuple[list[int], Ints]:
        """Rows that stand for all that leave the same to be added, and by row for which of them it is."""
        _, first, which = np.unique(rows.keys, axis=0, return_index=True, return_inverse=True)
        which = which.ravel()
        powers = self.trees.whole_powers(rows)
        if not (powers == powers[first][which]).all():  # keys of two numbers were equal
            _, first, which = np.unique(powers.reshape(len(rows), -1), axis=0, return_index=True, return_inverse=True)
        return first.tolist(), which.ravel()
