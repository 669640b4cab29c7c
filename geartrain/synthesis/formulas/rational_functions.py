"""Sums of terms as a formula holds them: whole coefficients, powers from 0 up, exact values, and words.

A rational function of tooth counts: exact values, fast values with their accuracy, and bounds over boxes.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING, Any

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.decimal_text import fraction_text, is_short
from geartrain.synthesis.formulas.laurent import Laurent, Term, power_product
from geartrain.synthesis.formulas.monomial_groups import MonomialGroup, MonomialGrouping, find_grouping
from geartrain.synthesis.formulas.polynomial_gcd import common_divisor, divide

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints
    from geartrain.synthesis.formulas.float_enclosures import EnclosedQuotient


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
        size = [] if abs(coefficient) == 1 and powers else [fraction_text(abs(coefficient))]
        sign = "-" if coefficient < 0 else "+" if words else ""
        words += [
            *([sign] if sign and words else []),
            ("-" if sign == "-" and not words else "") + " ".join(size + powers),
        ]
    return " ".join(words) or "0"


Moebius = tuple[Fraction, Fraction, Fraction, Fraction]
_MOST_CORNERS = 10


@dataclass(frozen=True, slots=True)
class Formula:
    """A rational function of tooth counts, reduced: numerator and denominator have no factor in common.

    label         the output it gives, or what a condition comes from
    wheels        the free wheels it depends on, in the order declared
    numerator     terms whose exponents are parallel to `wheels`, all >= 0; coefficients are whole, with no common
    denominator   divisor over both; the first coefficient of the denominator is positive
    groups        the coarsest classes of wheels such that it depends on each class through one monomial only
    upper, lower  numerator and denominator once more, with exponents parallel to `groups`, all >= 0

    A denominator without terms is 0: a function that has no value anywhere, which `fixed` may leave.
    """

    label: str
    wheels: tuple[str, ...]
    numerator: tuple[Term, ...]
    denominator: tuple[Term, ...]
    groups: tuple[MonomialGroup, ...]
    upper: tuple[Term, ...]
    lower: tuple[Term, ...]

    @property
    def constant(self) -> Fraction | None:
        """The value, if it depends on no wheel and has one."""
        return None if self.wheels else self.value({})

    @property
    def is_moebius(self) -> bool:
        """True if it is (a x + b) / (c x + d) in the monomial of every group, the others given."""
        return all(group.is_moebius for group in self.groups)

    @property
    def has_poles(self) -> bool:
        """False if the denominator cannot vanish, because all its terms are positive."""
        return any(term.coefficient < 0 for term in self.denominator) or not self.denominator

    def value(self, counts: Mapping[str, int]) -> Fraction | None:
        """The exact value; None where the denominator vanishes: the train is locked or free there.

        counts   wheel -> count, of all `wheels` at least
        """
        point = [int(counts[wheel]) for wheel in self.wheels]  # numpy's would overflow
        bottom = whole(self.denominator, point)
        return Fraction(whole(self.numerator, point), bottom) if bottom else None

    def values(self, columns: Mapping[str, Ints]) -> Floats:
        """Values of many assignments at once, nan or infinite at poles; `accuracy` bounds their error.

        columns   wheel -> counts, arrays that broadcast against each other
        """
        return self._quotient().values([group.monomials(columns) for group in self.groups])

    def accuracy(self, columns: Mapping[str, Ints]) -> Floats:
        """A bound on the relative error of `values`: |value - exact| <= accuracy |exact|, cancellation included.

        Infinite where cancellation leaves no digit, at poles, and beyond the range of float64.
        """
        return self._quotient().accuracy([group.monomials(columns) for group in self.groups])

    def of_groups(self, monomials: Sequence[Fraction]) -> Fraction | None:
        """The exact value from the groups' monomials, in the order of `groups`; None at a pole."""
        bottom = rational(self.lower, monomials)
        return rational(self.upper, monomials) / bottom if bottom else None

    def moebius(self, at: int, others: Mapping[int, Fraction]) -> Moebius:
        """a, b, c, d of (a x + b) / (c x + d), x the monomial of group `at`, the other groups' monomials given.

        others   index of a group -> its monomial, for every group but `at`

        Exact. Raises `QuestionError` where the group's degree is above 1.
        """
        a, b = linear(self._moebius_terms(self.upper, at), at, others, Fraction(0))
        c, d = linear(self._moebius_terms(self.lower, at), at, others, Fraction(0))
        return a, b, c, d

    def moebius_columns(self, at: int, others: Mapping[int, Floats]) -> tuple[Floats, Floats, Floats, Floats]:
        """The same in float64 for many values of the others (arrays that broadcast); no bound on the error."""
        import numpy as np

        a, b = linear(self._moebius_terms(self.upper, at), at, others, np.zeros(()))
        c, d = linear(self._moebius_terms(self.lower, at), at, others, np.zeros(()))
        return a, b, c, d

    def bounds(self, box: Mapping[str, tuple[Any, Any]]) -> tuple[Floats, Floats]:
        """Bounds over boxes of counts, rounded outwards: every exact value in a box lies within them.

        box   wheel -> (least, greatest) count, whole numbers or arrays of them that broadcast

        Tight but for rounding where `is_moebius`: the function is then monotone in each monomial. A pole in a box,
        or a result beyond the range of float64, gives -inf and inf.
        """
        ends = [group.ends(box) for group in self.groups]
        lows = [group.monomials(least) for group, (least, _) in zip(self.groups, ends, strict=True)]
        highs = [group.monomials(greatest) for group, (_, greatest) in zip(self.groups, ends, strict=True)]
        quotient = self._quotient()
        return (quotient.range_at_corners if self._has_corners() else quotient.range_by_terms)(lows, highs)

    def exact_bounds(self, box: Mapping[str, tuple[int, int]]) -> tuple[Fraction | None, Fraction | None]:
        """Bounds over one box as Fractions, tight where `is_moebius`; None and None where a pole may lie in it."""
        ends = [(group, *group.ends(box)) for group in self.groups]
        sides = [(group.monomial(least), group.monomial(greatest)) for group, least, greatest in ends]
        if self._has_corners():
            corners = list(product(*sides))
            bottoms = [rational(self.lower, corner) for corner in corners]
            if not (min(bottoms) > 0 or max(bottoms) < 0):
                return None, None
            found = [rational(self.upper, corner) / b for corner, b in zip(corners, bottoms, strict=True)]
            return min(found), max(found)
        top, bottom = (interval(terms, sides) for terms in (self.upper, self.lower))
        if bottom[0] <= 0 <= bottom[1]:
            return None, None
        found = [one / other for one in top for other in bottom]
        return min(found), max(found)

    def fixed(self, counts: Mapping[str, int]) -> Formula:
        """The function of the remaining wheels when some have their counts; wheels it lacks are passed over."""
        left = tuple(wheel for wheel in self.wheels if wheel not in counts)
        if left == self.wheels:
            return self
        parts = [substituted(terms, self.wheels, left, counts) for terms in (self.numerator, self.denominator)]
        return make_formula(self.label, left, *parts)[0]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return {
            "label": self.label,
            "text": str(self),
            "wheels": list(self.wheels),
            "numerator": _listed(self.numerator),
            "denominator": _listed(self.denominator),
            "groups": [group.to_dict() for group in self.groups],
        }

    def __str__(self) -> str:
        top, bottom = (in_words(terms, self.wheels) for terms in (self.numerator, self.denominator))
        if bottom == "1":
            return top
        return " / ".join(f"({text})" if " " in text else text for text in (top, bottom))

    def _has_corners(self) -> bool:
        return self.is_moebius and len(self.groups) <= _MOST_CORNERS

    def _quotient(self) -> EnclosedQuotient:
        from geartrain.synthesis.formulas.float_enclosures import EnclosedQuotient

        return EnclosedQuotient(self.upper, self.lower, [group.roundings for group in self.groups])

    def _moebius_terms(self, terms: tuple[Term, ...], at: int) -> tuple[Term, ...]:
        group = self.groups[at]
        if not group.is_moebius:
            raise QuestionError(
                Problem(
                    f"'{self.label}' is no Moebius function of the counts of {', '.join(group.wheels)}",
                    f"they enter to the power {group.degree}",
                    "choose another group, or enumerate this one",
                )
            )
        return terms


def make_formula(
    label: str, wheels: Sequence[str], numerator: Laurent, denominator: Laurent
) -> tuple[Formula, Laurent]:
    """A formula in lowest terms, and what was cancelled beyond units (1 where nothing was).

    wheels   the variables of both polynomials, by index
    """
    if not denominator:
        return Formula(label, (), (Term(1, ()),), (), (), (Term(1, ()),), ()), Laurent.constant(1, len(wheels))
    grouping = find_grouping([numerator, denominator])
    top, bottom = grouping.rewritten
    common = common_divisor(top, bottom)
    cancelled = grouping.back(common, len(wheels))
    if not common.is_constant:
        quotients = [grouping.back(_over(each, common), len(wheels)) for each in (top, bottom)]
        grouping = find_grouping(quotients)  # what is left may fall into fewer classes
        top, bottom = grouping.rewritten
    return _formula(label, wheels, grouping, top, bottom), cancelled


def _listed(terms: Sequence[Term]) -> list[list[Any]]:
    """Terms for JSON; a coefficient too long for Python to write is text."""
    return [[c if is_short(c, 600) else fraction_text(c), list(exponents)] for c, exponents in terms]


def _formula(label: str, wheels: Sequence[str], grouping: MonomialGrouping, top: Laurent, bottom: Laurent) -> Formula:
    """The formula of two coprime polynomials in the groups' monomials."""
    used = sorted(variable for members in grouping.members for variable in members)
    spread = [grouping.back(each, len(wheels)) for each in (top, bottom)]
    lowest = list(map(min, *(each.lowest() for each in spread if each))) if top else list(spread[1].lowest())
    spread = [each.shifted(tuple(-power for power in lowest)) for each in spread]
    first = max(spread[1].terms.items())[1]
    scale = (1 if first > 0 else -1) / top.content(bottom)
    groups = tuple(
        MonomialGroup(
            tuple(wheels[variable] for variable in members),
            tuple(members.values()),
            max(exponents[at] for each in (top, bottom) for exponents in each.terms),
        )
        for at, members in enumerate(grouping.members)
    )
    numerator, denominator = (
        tuple(Term(c, tuple(powers[variable] for variable in used)) for c, powers in each.scaled(scale).sorted_terms())
        for each in spread
    )
    upper, lower = (each.scaled(scale).sorted_terms() for each in (top, bottom))
    return Formula(label, tuple(wheels[at] for at in used), numerator, denominator, groups, upper, lower)


def _over(p: Laurent, q: Laurent) -> Laurent:
    found = divide(p, q)
    assert found is not None, "a common divisor divides"
    return found
