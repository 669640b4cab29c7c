"""Sums of terms as a formula holds them: whole coefficients, powers from 0 up, exact values, and words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from geartrain.exact import written
from geartrain.synthesis.formulas.laurent import Laurent, Term, power_product


def whole(terms: Iterable[Term], point: Sequence[int]) -> int:
    """A polynomial with powers >= 0 at whole numbers."""
    total = 0
    for coefficient, exponents in terms:
        for count, power in zip(point, exponents, strict=True):
            if power:
                coefficient *= count if power == 1 else count**power
        total += coefficient
    return total


def rational(terms: Iterable[Term], monomials: Sequence[Fraction]) -> Fraction:
    """A polynomial in the groups' monomials."""
    return sum((power_product(monomials, term.exponents) * term.coefficient for term in terms), Fraction(0))


def interval(terms: Iterable[Term], sides: Sequence[tuple[Fraction, Fraction]]) -> tuple[Fraction, Fraction]:
    """Bounds of a polynomial over a box of positive monomials, term by term."""
    low = high = Fraction(0)
    for coefficient, exponents in terms:
        ends = [coefficient * power_product([side[end] for side in sides], exponents) for end in (0, 1)]
        low, high = low + min(ends), high + max(ends)
    return low, high


def linear(terms: Iterable[Term], at: int, others: Mapping[int, Any], zero: Any) -> tuple[Any, Any]:
    """Coefficients of x and of 1, where x is the monomial of one group and enters to the power 0 or 1."""
    found = [zero, zero]
    for coefficient, exponents in terms:
        value = coefficient
        for group, power in enumerate(exponents):
            if group != at and power:
                value = value * others[group] ** power
        found[exponents[at]] = found[exponents[at]] + value
    return found[1], found[0]


def substituted(
    terms: Iterable[Term], wheels: Sequence[str], left: Sequence[str], counts: Mapping[str, int]
) -> Laurent:
    """The polynomial in the wheels left over."""
    rest = [
        Term(
            whole(
                [Term(coefficient, tuple(e if w in counts else 0 for w, e in zip(wheels, exponents, strict=True)))],
                [counts.get(wheel, 1) for wheel in wheels],
            ),
            tuple(e for w, e in zip(wheels, exponents, strict=True) if w not in counts),
        )
        for coefficient, exponents in terms
    ]
    return Laurent.of(rest, len(left))


def in_words(terms: Sequence[Term], wheels: Sequence[str]) -> str:
    """A polynomial as a reader would write it: `3 a b^2 - c`."""
    words: list[str] = []
    for coefficient, exponents in terms:
        powers = [f"{w}^{e}" if e > 1 else w for w, e in zip(wheels, exponents, strict=True) if e]
        size = [] if abs(coefficient) == 1 and powers else [written(abs(coefficient))]
        sign = "-" if coefficient < 0 else "+" if words else ""
        words += [
            *([sign] if sign and words else []),
            ("-" if sign == "-" and not words else "") + " ".join(size + powers),
        ]
    return " ".join(words) or "0"
