"""When a set closes, in words: which tooth numbers, or sums of them, must be multiples of what."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from geartrain.numerics.plain_data import Result

Row = dict[str, int]


class DivisibilityCondition(NamedTuple):
    """`modulus` divides the sum of tooth numbers, each times its factor."""

    modulus: int
    factors: Mapping[str, int]


@dataclass(frozen=True)
class DivisibilityRule(Result):
    """Conditions on tooth numbers: `modulus` divides the sum of factor times tooth number, for each."""

    KEYS = ("text", "conditions")

    conditions: tuple[DivisibilityCondition, ...]

    @property
    def text(self) -> str:
        """In words: `3 divides za and 5 divides zb`."""
        kinds = [kind for _, terms in self.conditions for kind in terms]
        short = all(kind[:1].isdigit() or len(kind) <= 2 for kind in kinds)  # z5, z4a and ze, else z[sun]
        sums = (f"{modulus} divides {_sum(terms, short)}" for modulus, terms in self.conditions)
        return " and ".join(sums) or "always"

    def holds(self, teeth: Mapping[str, int]) -> bool:
        """True if the set closes with these tooth numbers, by kind."""
        return not any(sum(f * teeth[kind] for kind, f in terms.items()) % m for m, terms in self.conditions)


def find_divisibility_rule(forms: Iterable[Mapping[str, Fraction]]) -> DivisibilityRule:
    """The rule that all forms take whole values: sum of form[kind] z[kind] is an integer for each.

    Forms matter modulo 1, and generate a finite group; it is the sum of its parts for each prime p, and in every part
    rows modulo a power of p are brought to a triangle. Conditions on one kind alone are joined again.

    >>> find_divisibility_rule([{"a": Fraction(2, 3), "b": Fraction(-2, 5)}]).text
    '3 divides za and 5 divides zb'
    """
    rows = list({tuple(sorted((k, f % 1) for k, f in form.items() if f % 1)): None for form in forms})
    kinds = sorted({kind for row in rows for kind, _ in row})
    scale = math.lcm(*(value.denominator for row in rows for _, value in row))
    whole = [[int(dict(row).get(kind, 0) * scale) for kind in kinds] for row in rows]
    alone: dict[str, int] = {}
    mixed: list[tuple[int, Row]] = []
    for power in _prime_powers(scale):
        # the part for p of a form: a multiple that is 1 modulo the power of p and 0 modulo the rest
        lifted = [[value * pow(scale // power, -1, power) % power for value in row] for row in whole]
        for modulus, row in (_plain(row, power) for row in _needed(lifted, power)):
            terms = {kind: value for kind, value in zip(kinds, row, strict=True) if value}
            if len(terms) == 1:
                alone[next(iter(terms))] = alone.get(next(iter(terms)), 1) * modulus
            else:
                _join(mixed, modulus, terms)
    single = [(modulus, {kind: 1}) for kind, modulus in sorted(alone.items())]
    return DivisibilityRule(tuple(DivisibilityCondition(modulus, terms) for modulus, terms in (*single, *mixed)))


def _join(found: list[tuple[int, Row]], modulus: int, terms: Row) -> None:
    """Add a condition; to one of another prime where the same sum says both."""
    for at, (other, known) in enumerate(found):
        kinds = {*known, *terms}
        for says, to in ((terms, other), (known, modulus)):
            if math.gcd(other, modulus) == 1 and not any((known.get(k, 0) - terms.get(k, 0)) % to for k in kinds):
                found[at] = (other * modulus, says)
                return
    found.append((modulus, terms))


def _prime_powers(number: int) -> Iterable[int]:
    prime = 2
    while number > 1:
        # trial division: what has no divisor up to its root is prime
        if prime * prime > number:
            prime = number
        power = 1
        while number % prime == 0:
            power *= prime
            number //= prime
        if power > 1:
            yield power
        prime += 1


def _needed(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Generators of the same group without those that the others make too."""
    found = _triangle(rows, power)
    for row in found[::-1]:
        fewer = [other for other in found if other is not row]
        if _order(fewer, power) == _order(found, power):
            found = fewer
    return found


def _order(rows: Sequence[Sequence[int]], power: int) -> int:
    """The number of elements of the group."""
    firsts = (next(value for value in row if value) for row in _triangle(rows, power))
    return math.prod(power // math.gcd(first, power) for first in firsts)


def _triangle(rows: Sequence[Sequence[int]], power: int) -> list[list[int]]:
    """Rows that generate the same group modulo a prime power, in triangular (Howell) form."""
    found = []
    active = [list(row) for row in rows]
    width = len(active[0]) if active else 0
    for column in range(width):
        entries = [row for row in active if row[column] % power]
        if not entries:
            continue
        pivot = min(entries, key=lambda row: math.gcd(row[column], power))
        common = math.gcd(pivot[column], power)
        turn = pow(pivot[column] // common, -1, power)
        pivot = [value * turn % power for value in pivot]
        rest = []
        for row in active:
            times = row[column] // common
            rest.append([(a - times * b) % power for a, b in zip(row, pivot, strict=True)])
        # a multiple that clears the column may say something about the others
        rest.append([value * (power // common) % power for value in pivot])
        active = [row for row in rest if any(row)]
        found.append(pivot)
    return found


def _plain(row: Sequence[int], power: int) -> tuple[int, list[int]]:
    """The same condition in the smallest numbers."""
    common = math.gcd(*row, power)
    modulus = power // common
    row = [value // common for value in row]
    # only how the condition reads depends on the unit: past 1000 of them none is looked at
    units = [unit for unit in range(1, min(modulus, 1000) + 1) if math.gcd(unit, modulus) == 1]
    return modulus, min((_centred(row, unit, modulus) for unit in units), key=_size)


def _centred(row: Sequence[int], unit: int, modulus: int) -> list[int]:
    found = [value * unit % modulus for value in row]
    return [value - modulus if 2 * value > modulus else value for value in found]


def _size(row: Sequence[int]) -> tuple[int, int, int, list[int]]:
    """Small factors first, then few minus signs, then a plus in front."""
    first = next((value for value in row if value), 0)
    return sum(map(abs, row)), sum(value < 0 for value in row), first < 0, list(row)


def _sum(terms: Mapping[str, int], short: bool) -> str:
    words: list[str] = []
    for kind, factor in terms.items():
        size = "" if abs(factor) == 1 else f"{abs(factor)} "
        sign = "- " if factor < 0 else "+ " if words else ""
        words.append(f"{sign}{size}{f'z{kind}' if short else f'z[{kind}]'}")
    return " ".join(words)
