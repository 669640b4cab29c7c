"""Large primes shared out among added wheels: a wheel has one of them at most, and that once.

For each dial a prime has a power in what the added wheels must make. Some of the wheels must have it as factor, so that
their signs sum up to these powers: +1 for one that drives to a dial, -1 for one that is driven. No wheel is given two.
What is left is a set of sets of wheels, a state; states are numbered as they are met.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.synthesis.reconstruction.added_structures import AddedSets

Ints = NDArray[np.int64]
_BITS = 6  # of a power of one dial
MOST_POWER = (1 << _BITS - 1) - 1
"""The greatest power of a prime."""
NO_STATE = 0
"""What cannot be shared out."""


def packed_powers(powers: Sequence[int]) -> int:
    """By dial the power of a prime, as one whole number; those of a product are the sum."""
    return sum(power << _BITS * at for at, power in enumerate(powers))


class PrimeShares:
    """NDArray[np.int64] of some added wheels."""

    start = 1

    def __init__(self, added: AddedSets, dials: int) -> None:
        self._sharing: dict[int, list[int]] = defaultdict(list)
        for chosen in range(1 << len(added)):
            own = [wheel for at, wheel in enumerate(added) if chosen >> at & 1]
            powers = [sum((1 if one.drives else -1) * (one.dials >> dial & 1) for one in own) for dial in range(dials)]
            self._sharing[packed_powers(powers)].append(chosen)
        whole = frozenset([(1 << len(added)) - 1])
        self._left: list[frozenset[int]] = [frozenset(), whole]
        self._numbers = {left: number for number, left in enumerate(self._left)}
        self._steps: dict[tuple[int, int], int] = {}

    def after(self, states: Ints, powers: NDArray[np.signedinteger[Any]]) -> Ints:
        """Each state once a prime more has its packed powers."""
        some = np.flatnonzero((powers != 0) & (states != NO_STATE))
        if not len(some):
            return states
        values, which = np.unique(powers[some], return_inverse=True)
        pairs, place = np.unique(states[some] * len(values) + which, return_inverse=True)
        steps = [self._step(int(pair) // len(values), int(values[int(pair) % len(values)])) for pair in pairs]
        found = states.copy()
        found[some] = np.array(steps, dtype=np.int64)[place]
        return found

    def _step(self, state: int, powers: int) -> int:
        key = state, powers
        if key not in self._steps:
            sharing = self._sharing.get(powers, ())
            left = frozenset(one & ~used for used in sharing for one in self._left[state] if not used & ~one)
            if left not in self._numbers:
                self._numbers[left] = len(self._left)
                self._left.append(left)
            self._steps[key] = self._numbers[left]
        return self._steps[key]
