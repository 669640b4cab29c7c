"""Polynomials in tooth counts as products: one factor for each set of wheels that stand in none of the others.

Two variables i and j are in different factors of P if and only if P(i, j) P(a, b) = P(a, j) P(i, b) for values a and b
at which P(a, b) is not 0: for then P is a quotient of products of a polynomial without i and one without j. In gear
trains that is almost always the whole factorisation, since carriers with wheels of their own stand behind each other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from geartrain.kinematics.formulas.laurent import Exponents, Laurent, Term, product
from geartrain.kinematics.formulas.polynomial_gcd import divide
from geartrain.kinematics.formulas.rational_functions import whole

_VALUES = (2, 3, 5, 7, 11, 13)


@dataclass(frozen=True, slots=True)
class FactoredPolynomial:
    """A whole number times powers of variables times sums, which have no variable in common.

    content   0 for a polynomial without terms
    powers    by variable
    sums      each of two terms or more, terms of highest powers first
    """

    content: int
    powers: Exponents
    sums: tuple[tuple[Term, ...], ...]

    @classmethod
    def of(cls, terms: Sequence[Term], point: Sequence[int], known: Sequence[Laurent] = ()) -> FactoredPolynomial:
        """The factors of a polynomial with powers from 0 up; sums that are not 0 at a point are above 0 there.

        known   factors that it may have, which are tried first
        """
        width = len(point)
        given = Laurent.of(terms, width)
        if not given:
            return cls(0, (0,) * width, ())
        powers = given.lowest()
        rest = given.shifted(tuple(-power for power in powers))
        left = rest
        found: list[Laurent] = []
        for factor in known:
            while (quotient := divide(left, factor)) is not None:
                left, found = quotient, [*found, factor]
        sums = [_positive(each, point) for each in (*found, *_parted(left)) if len(each) > 1]
        back = product([Laurent.of(each, width) for each in sums], width)
        exponents = next(iter(back.terms))
        content = rest.terms[exponents] / back.terms[exponents]
        assert back.scaled(content) == rest, "factors multiply to the whole"
        return cls(int(content), powers, tuple(sums))


def _positive(p: Laurent, point: Sequence[int]) -> tuple[Term, ...]:
    terms = p.sorted_terms()
    value = whole(terms, point) or terms[0].coefficient
    found = terms if value > 0 else (-p).sorted_terms()
    return tuple(sorted(found, key=lambda term: term.coefficient < 0))  # what is added stands first


def _parted(p: Laurent) -> Iterator[Laurent]:
    """Factors without a variable in common, up to a number."""
    used = [at for at in range(p.width) if any(exponents[at] for exponents in p.terms)]
    groups = [{at} for at in used]
    for i, j in combinations(used, 2):
        one, other = (next(group for group in groups if at in group) for at in (i, j))
        if one is not other and not _are_apart(p, i, j):
            groups.remove(other)
            one |= other
    for group in groups:
        yield _alone(p, [at for at in used if at not in group]).primitive()


def _are_apart(p: Laurent, i: int, j: int) -> bool:
    for value in _VALUES:
        at_i, at_j = _with(p, i, value), _with(p, j, value + 1)
        both = _with(at_i, j, value + 1)
        if both:
            return p * both == at_i * at_j
    return False


def _alone(p: Laurent, others: Sequence[int]) -> Laurent:
    """A polynomial with some variables at values at which it is not 0."""
    for at in others:
        p = next(found for value in _VALUES if (found := _with(p, at, value)))
    return p


def _with(p: Laurent, at: int, value: int) -> Laurent:
    found: dict[Exponents, Fraction] = {}
    for exponents, coefficient in p.terms.items():
        key = (*exponents[:at], 0, *exponents[at + 1 :])
        found[key] = found.get(key, Fraction(0)) + coefficient * value ** exponents[at]
    return Laurent(p.width, {exponents: each for exponents, each in found.items() if each})
