"""Numbers that are stored as short ratios to other numbers and multiplied out on access.

The speed after a thousand links has thousands of digits, and storage of all speeds would take quadratic memory.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from geartrain.numerics.exact import coprime, times

_SHORT = 256
"""Maximum number of bits in numerator and denominator for which a number is multiplied out immediately."""

_KEPT = 64
"""Maximum number of long numbers that are kept, because consecutive accesses are usually near each other."""


class FactoredRatios:
    """Exact numbers in a numbered list, each either a given root or a ratio times an earlier number.

    parent           index of the number from which it is derived; -1 for a root
    anchor           index of the number by which `top`/`bottom` is multiplied to give the value; -1 for 1
    top, bottom      ratio in lowest terms, bottom > 0; bottom is 0 if the number is not yet known
    """

    __slots__ = ("_kept", "anchor", "bottom", "parent", "top")

    def __init__(self, count: int) -> None:
        self.parent, self.anchor = [-1] * count, [-1] * count
        self.top, self.bottom = [0] * count, [0] * count
        self._kept: dict[int, Fraction] = {}

    def set_root(self, at: int, top: int, bottom: int = 1) -> None:
        """Set the value of a root, which is a fraction in lowest terms."""
        self.top[at], self.bottom[at] = top, bottom

    def follow(self, at: int, parent: int, a: int, b: int) -> None:
        """Define the number with index `at` as a/b times the known number with index `parent`; a and b are short."""
        n, d = times(self.top[parent], self.bottom[parent], a, b)
        self.parent[at] = parent
        if n.bit_length() <= _SHORT and d.bit_length() <= _SHORT:
            self.anchor[at], self.top[at], self.bottom[at] = self.anchor[parent], n, d
        else:
            self.anchor[at] = parent
            self.top[at], self.bottom[at] = times(1, 1, a, b)

    def vanishes(self, terms: Iterable[tuple[int, int]]) -> bool:
        """Return True if a linear combination of numbers, given as (index, coefficient), is 0."""
        terms = list(terms)
        common = len({self.anchor[at] for at, _ in terms}) == 1  # all are relative to the same number, which is not 0
        n, d = 0, 1
        for at, coefficient in terms:
            value = coprime(self.top[at], self.bottom[at]) if common else self.value(at)
            n = n * value.denominator + coefficient * value.numerator * d
            d *= value.denominator
        return n == 0

    def value(self, at: int) -> Fraction:
        """Return the value of a number as a Fraction."""
        if self.anchor[at] < 0:
            return coprime(self.top[at], self.bottom[at])
        hops = []
        here = at
        while self.anchor[here] >= 0 and here not in self._kept:
            hops.append(here)
            here = self.anchor[here]
        value = self._kept.get(here) or coprime(self.top[here], self.bottom[here])
        for hop in reversed(hops):
            # the anchor is kept, because the number read next probably has the same one
            if hop == at:
                self._kept[self.anchor[at]] = value
                if len(self._kept) > _KEPT:
                    del self._kept[next(iter(self._kept))]
            value = coprime(*times(value.numerator, value.denominator, self.top[hop], self.bottom[hop]))
        return value
