"""Paths through more and more surviving arbors, millions at a time, as columns of arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.arbor_passes import ArborPass


@dataclass(frozen=True)
class PathGrowth:
    """Paths through some of the arbors, a row each.

    codes             by arbor, which way through it is taken, from 1 on; 0 where none is
    keys, powers      of what is left to be added: its key, and the powers of large primes in it
    drivers, driven   added wheels beside surviving ones that drive, and that are driven
    added, idle       added wheels, idlers counted too, and surviving wheels that are passed by
    ended             whether the path ends at one of the arbors
    """

    codes: NDArray[np.uint16]
    keys: NDArray[np.uint64]
    powers: NDArray[np.int8]
    drivers: NDArray[np.int8]
    driven: NDArray[np.int8]
    added: NDArray[np.int8]
    idle: NDArray[np.int8]
    ended: NDArray[np.bool_]

    @staticmethod
    def start(arbors: int, key: int, powers: NDArray[np.int8]) -> PathGrowth:
        """One path, through nothing yet."""
        none = np.zeros(1, dtype=np.int8)
        return PathGrowth(
            np.zeros((1, arbors), dtype=np.uint16),
            np.array([key], dtype=np.uint64),
            powers[None, :],
            *(none,) * 4,
            np.zeros(1, dtype=bool),
        )

    def columns(self) -> tuple[NDArray[Any], ...]:
        """All of it, a row each."""
        return self.codes, self.keys, self.powers, self.drivers, self.driven, self.added, self.idle, self.ended

    @staticmethod
    def joined(parts: list[PathGrowth]) -> PathGrowth:
        """All paths of some."""
        return PathGrowth(*map(np.concatenate, zip(*(part.columns() for part in parts), strict=True)))

    def kept(self, rows: NDArray[np.bool_] | np.bool_ | slice) -> PathGrowth:
        """Some of the paths."""
        return PathGrowth(*(column[rows] for column in self.columns()))

    def through(self, at: int, code: int, each: ArborPass, key: np.uint64, powers: NDArray[np.int8]) -> PathGrowth:
        """The same paths, through one arbor more; one that has ended is not ended again."""
        found = self.kept(~self.ended) if each.driver is None else self
        codes = found.codes.copy()
        codes[:, at] = code
        return PathGrowth(
            codes,
            found.keys + key,
            found.powers + powers,
            found.drivers + np.int8(each.added_drivers),
            found.driven + np.int8(each.added_driven),
            found.added + np.int8(each.added),
            found.idle + np.int8(each.idle),
            found.ended | (each.driver is None),
        )

    def may_stand(
        self, closed: list[int], lost: NDArray[np.bool_], wheels: int, debts: int | None
    ) -> NDArray[np.bool_]:
        """Which may become a path: no more is added, and no more wheels are passed by, than may be."""
        held = self.powers[:, closed]
        need = np.abs(held).sum(axis=1)
        found: NDArray[np.bool_] = (need <= wheels) & (self.added <= wheels)
        found &= ~(held[:, lost[closed]] != 0).any(axis=1)
        if debts is not None:
            found &= self.idle <= debts
        return found
