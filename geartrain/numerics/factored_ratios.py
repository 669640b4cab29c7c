"""Numbers stored as a short ratio to another number, and multiplied out when they are read.

Along a train every speed is the speed of a neighbouring link times a ratio of tooth counts. If the factors do not
cancel, the speed after a thousand links has thousands of digits, and storage of all speeds takes quadratic memory. Each
number is therefore stored as a short ratio to an earlier one. Its value is a balanced product of powers of the primes
in all ratios along its path.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache
from heapq import heapify, heappop, heapreplace
from math import gcd

from geartrain.numerics.exact import coprime, times

_SHORT = 256
"""Maximum number of bits of numerator and denominator for which a number is multiplied out immediately."""

_HOPS = 64
"""Maximum number of ratios that are multiplied one after another; for longer paths the powers of primes are counted."""

_CACHE_BITS = 1 << 29
"""Capacity of the cache of long numbers [bit], 64 MB; numbers that are read one after another are usually near each
other.
"""

_SMALL = 1000  # primes up to this are divided out; the cofactor of a number below its square is prime
_MOST_ROUGH = 1000  # numbers without small primes: factor refinement takes quadratic time in their number


class FactoredRatios:
    """Numbers by index: roots with given values, and numbers defined as a ratio times an earlier number.

    parent, a, b     index of the number from which it is derived (-1 for a root), and its ratio a / b to that number
    anchor           index of the number that is multiplied by `top` / `bottom`; -1 if the quotient is the value
    top, bottom      ratio in lowest terms, bottom > 0; bottom is 0 if the number is not yet known
    """

    __slots__ = ("_bits", "_recent", "a", "anchor", "b", "bottom", "parent", "top")

    def __init__(self, count: int) -> None:
        self.parent, self.anchor = [-1] * count, [-1] * count
        self.a, self.b = [1] * count, [1] * count
        self.top, self.bottom = [0] * count, [0] * count
        self._recent: OrderedDict[int, Fraction] = OrderedDict()
        self._bits = 0

    def set_root(self, at: int, top: int, bottom: int = 1) -> None:
        """Set the value of a root, a fraction in lowest terms."""
        self.top[at], self.bottom[at] = top, bottom

    def follow(self, at: int, parent: int, a: int, b: int) -> None:
        """Define a number as a / b times a known number; a and b are short."""
        n, d = times(self.top[parent], self.bottom[parent], a, b)
        self.parent[at], self.a[at], self.b[at] = parent, a, b
        if n.bit_length() <= _SHORT and d.bit_length() <= _SHORT:
            self.anchor[at], self.top[at], self.bottom[at] = self.anchor[parent], n, d
        else:
            self.anchor[at] = parent
            self.top[at], self.bottom[at] = times(1, 1, a, b)

    def vanishes(self, terms: Iterable[tuple[int, int]]) -> bool:
        """Return whether a linear combination of numbers, given as (index, coefficient), is 0."""
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
        return coprime(*self._times(self._anchor_value(self.anchor[at]), at))

    def _anchor_value(self, at: int) -> Fraction:
        """Return the value of an anchor, and cache it for other numbers near it."""
        hops = []
        here = at
        while self.anchor[here] >= 0 and here not in self._recent:
            hops.append(here)
            here = self.anchor[here]
        if not hops:
            return self._cached(here)
        if len(hops) > _HOPS:
            value = self._value_from_powers(at)
        else:
            value = self._cached(here)
            for hop in reversed(hops):
                value = coprime(*self._times(value, hop))
        self._cache(at, value)
        return value

    def _times(self, value: Fraction, at: int) -> tuple[int, int]:
        return times(value.numerator, value.denominator, self.top[at], self.bottom[at])

    def _cached(self, at: int) -> Fraction:
        if at not in self._recent:
            return coprime(self.top[at], self.bottom[at])
        self._recent.move_to_end(at)
        return self._recent[at]

    def _cache(self, at: int, value: Fraction) -> None:
        self._recent[at] = value
        self._bits += _bits(value)
        while self._bits > _CACHE_BITS and len(self._recent) > 1:
            _, forgotten = self._recent.popitem(last=False)
            self._bits -= _bits(forgotten)

    def _value_from_powers(self, at: int) -> Fraction:
        """Return the value of a number, computed from its root and the powers of all ratios along the path."""
        counts: dict[int, int] = {}
        while (parent := self.parent[at]) >= 0:
            a, b = self.a[at], self.b[at]
            counts[a] = counts.get(a, 0) + 1
            counts[b] = counts.get(b, 0) - 1
            at = parent
        root = coprime(self.top[at], self.bottom[at])
        return root * product_of_powers(counts)


def _bits(value: Fraction) -> int:
    return value.numerator.bit_length() + value.denominator.bit_length()


def product_of_powers(powers: dict[int, int]) -> Fraction:
    """Return the product of integer powers of integers, reduced without a gcd of long numbers.

    >>> product_of_powers({6: 2, -4: -1, 15: -3})
    Fraction(-1, 375)
    """
    sign = -1 if sum(power for factor, power in powers.items() if factor < 0) % 2 else 1
    primes: dict[int, int] = {}
    rough: dict[int, int] = {}
    for factor, power in powers.items():
        if power:
            found, left = _small_primes(abs(factor))
            for prime, times_over in found:
                primes[prime] = primes.get(prime, 0) + power * times_over
            if left > 1:
                into = primes if left < _SMALL**2 else rough
                into[left] = into.get(left, 0) + power
    for factor, power in _coprime_factors(rough).items():
        primes[factor] = primes.get(factor, 0) + power
    top = _product_tree([factor**power for factor, power in primes.items() if power > 0])
    bottom = _product_tree([factor**-power for factor, power in primes.items() if power < 0])
    if len(rough) > _MOST_ROUGH:  # they were not refined, and may have common factors
        return Fraction(sign * top, bottom)
    return coprime(sign * top, bottom)


@lru_cache(maxsize=1 << 16)
def _small_primes(number: int) -> tuple[tuple[tuple[int, int], ...], int]:
    """Return the prime factors below 1000 with their exponents, and the remaining cofactor."""
    found = []
    for prime in _PRIMES:
        if prime * prime > number:
            break
        power = 0
        while number % prime == 0:
            number //= prime
            power += 1
        if power:
            found.append((prime, power))
    return tuple(found), number


_PRIMES = [n for n in range(2, _SMALL) if all(n % k for k in range(2, int(n**0.5) + 1))]


def _coprime_factors(powers: dict[int, int]) -> dict[int, int]:
    """Return powers of pairwise coprime factors with the same product as powers of large numbers (factor refinement).

    More than `_MOST_ROUGH` numbers are returned unchanged, because the refinement takes quadratic time.
    """
    if len(powers) > _MOST_ROUGH:
        return powers
    base: list[int] = []
    left = list(powers)
    while left:
        number = left.pop()
        for at, other in enumerate(base):
            if (common := gcd(number, other)) > 1:
                del base[at]
                left += [part for part in (common, number // common, other // common) if part > 1]
                break
        else:
            base.append(number)
    found: dict[int, int] = {}
    for number, power in powers.items():
        for factor in base:
            while number % factor == 0:
                number //= factor
                found[factor] = found.get(factor, 0) + power
    return found


def _product_tree(factors: list[int]) -> int:
    """Return the product of long numbers by a product tree, in which the shortest numbers are multiplied first."""
    if not factors:
        return 1
    heapify(factors)
    while len(factors) > 1:
        minimum = heappop(factors)  # factors of similar length: fast multiplication is efficient only for these
        heapreplace(factors, minimum * factors[0])
    return factors[0]
