"""Rational functions of tooth counts in lowest terms, with exact values and with fast float values and error bounds."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import index
from typing import TYPE_CHECKING, Any, TypeVar

from geartrain.kinematics.formulas.laurent import Exponents, Laurent, Term, common_divisor, divide_exactly
from geartrain.numerics.exact import fraction_text, integer_factors, is_short, log10

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class MonomialGrouping:
    """Polynomials that are rewritten, up to a common monomial factor, in new variables. Each new variable is a monomial
    of a group of the original variables. The number of groups is minimal.
    """

    members: tuple[Mapping[int, int], ...]
    """Exponents of the variables in the monomial of each group, by index of the variable."""
    rewritten: tuple[Laurent, ...]
    """Polynomials in the new variables (the monomials of the groups), with non-negative exponents."""

    def back(self, p: Laurent, width: int) -> Laurent:
        """Return a polynomial in the new variables as a polynomial in the `width` original variables."""

        def spread(exponents: Exponents) -> Exponents:
            full = [0] * width
            for members, power in zip(self.members, exponents, strict=True):
                for variable, step in members.items():
                    full[variable] = power * step
            return tuple(full)

        return Laurent(width, {spread(exponents): value for exponents, value in p.terms.items()})


Member = TypeVar("Member")


def proportional_classes(lists: Iterable[tuple[Member, Sequence[int]]]) -> dict[Exponents, dict[Member, int]]:
    """Group the keys whose integer vectors are multiples of a common vector. Return, for each common vector, the factor
    of each key.

    The common vectors are primitive (their entries are coprime), and their first non-zero entry is positive. Keys with
    zero vectors are omitted.
    """
    classes: dict[Exponents, dict[Member, int]] = {}
    for key, steps in lists:
        # canonical form: divide by the common divisor and the sign of the first non-zero entry
        size = math.gcd(*steps)
        if size:
            size = size if next(step for step in steps if step) > 0 else -size
            classes.setdefault(tuple(step // size for step in steps), {})[key] = size
    return classes


def find_grouping(polynomials: Sequence[Laurent]) -> MonomialGrouping:
    """Find the coarsest groups of variables for which quotients of the polynomials depend on each group only through
    one monomial.

    Division of all polynomials by one monomial changes no quotient, so only differences of exponents matter. The
    variables of a group occur in one monomial if and only if the vectors of their exponent differences, over all terms,
    are multiples of one vector. For a quotient in lowest terms no coarser groups exist.
    """
    terms = [exponents for p in polynomials for exponents in p.terms]
    columns = enumerate(zip(*terms, strict=True))
    classes = proportional_classes((variable, [power - powers[0] for power in powers]) for variable, powers in columns)
    members = []
    lists = []
    for list_, found in classes.items():
        # the first exponent of a group is positive
        sign = 1 if next(iter(found.values())) > 0 else -1
        members.append({variable: sign * size for variable, size in found.items()})
        # a common monomial factor makes the exponents non-negative
        minimum = min(sign * step for step in list_)
        lists.append([sign * step - minimum for step in list_])
    powers_of: Iterator[Exponents] = iter(zip(*lists, strict=True) if lists else [()] * len(terms))
    rewritten = tuple(
        Laurent(len(members), {next(powers_of): value for value in p.terms.values()}) for p in polynomials
    )
    return MonomialGrouping(tuple(members), rewritten)


def whole(terms: Iterable[Term], point: Sequence[int]) -> int:
    """Return the value of a polynomial with integer coefficients and non-negative exponents at an integer point."""
    total = 0
    for coefficient, exponents in terms:
        for count, power in zip(point, exponents, strict=True):
            if power:
                coefficient *= count if power == 1 else count**power
        total += coefficient
    return total


def in_words(terms: Sequence[Term], wheels: Sequence[str]) -> str:
    """Return a polynomial in tooth counts as text, such as `3 a b^2 - c`."""
    words: list[str] = []
    for coefficient, exponents in terms:
        powers = [f"{w}^{e}" if e > 1 else w for w, e in zip(wheels, exponents, strict=True) if e]
        size = integer_factors(abs(coefficient)) or ([] if powers else ["1"])
        sign = "-" if coefficient < 0 else "+" if words else ""
        words += [
            *([sign] if sign and words else []),
            ("-" if sign == "-" and not words else "") + " ".join(size + powers),
        ]
    return " ".join(words) or "0"


@dataclass(frozen=True, slots=True)
class Formula:
    """Rational function of tooth counts in lowest terms: its numerator and denominator are coprime.

    If the denominator has no terms, it is 0 and the function is undefined; `fixed` may return such a function.
    """

    label: str
    """Name of the output whose speed the function gives; if the function is a condition, the reason for it."""
    wheels: tuple[str, ...]
    """Names of the wheels on whose tooth counts the function depends, in the order of declaration."""
    numerator: tuple[Term, ...]
    """Terms of the numerator, with non-negative exponents in the order of `wheels`. The coefficients are integers; all
    coefficients of the numerator and the denominator together are coprime.
    """
    denominator: tuple[Term, ...]
    """Terms of the denominator, in the same form as `numerator`. The coefficient of the first term is positive."""

    @property
    def constant(self) -> Fraction | None:
        """Value of a function that does not depend on any wheel; None if it depends on a wheel or is undefined."""
        return None if self.wheels else self.value({})

    @property
    def has_poles(self) -> bool:
        """True if the denominator has a negative term or is 0. If it is False, the denominator cannot vanish for
        positive tooth counts.
        """
        return any(term.coefficient < 0 for term in self.denominator) or not self.denominator

    def value(self, counts: Mapping[str, int]) -> Fraction | None:
        """Return the exact value; None if the denominator is 0, which means that the train is locked or free.

        counts   tooth count of at least all `wheels`, by wheel
        """
        point = [int(counts[wheel]) for wheel in self.wheels]  # Python integers, because numpy's would overflow
        bottom = whole(self.denominator, point)
        return Fraction(whole(self.numerator, point), bottom) if bottom else None

    def values(self, columns: Mapping[str, Ints]) -> Floats:
        """Return the values of the function for many combinations of tooth counts in float64; they are NaN or infinite
        at poles. `accuracy` returns a bound on their error.

        columns   array of tooth counts by wheel; the arrays are broadcast
        """
        return self.bounded(columns)[0]

    def accuracy(self, columns: Mapping[str, Ints]) -> Floats:
        """Return a bound on the relative error of `values`, including cancellation: |value - exact| <= accuracy
        |exact|.

        The bound is infinite if cancellation leaves no correct digit, at poles, and beyond the range of float64.
        """
        import numpy as np

        value, error = self.bounded(columns)
        with np.errstate(all="ignore"):
            # |exact| is at least |value| - error
            found = np.where(error > 0, error / (np.abs(value) - error), 0.0)
        return np.where((found >= 0) & np.isfinite(found), found, np.inf)

    def fixed(self, counts: Mapping[str, int]) -> Formula:
        """Return the function of the remaining wheels that results from substituting the given tooth counts. Tooth
        counts of wheels that do not occur in the function are ignored.
        """
        left = tuple(wheel for wheel in self.wheels if wheel not in counts)
        if left == self.wheels:
            return self
        parts = []
        for terms in (self.numerator, self.denominator):
            rest = []
            for coefficient, exponents in terms:
                powers = dict(zip(self.wheels, exponents, strict=True))
                factors = (index(counts[wheel]) ** powers[wheel] for wheel in self.wheels if wheel in counts)
                rest.append(Term(math.prod(factors, start=coefficient), tuple(powers[wheel] for wheel in left)))
            parts.append(Laurent.of(rest, len(left)))
        return make_formula(self.label, left, *parts)[0]

    def to_dict(self) -> dict[str, Any]:
        """Return the function as plain data for JSON."""
        return {
            "label": self.label,
            "text": str(self),
            "wheels": list(self.wheels),
            "numerator": _listed(self.numerator),
            "denominator": _listed(self.denominator),
        }

    def __str__(self) -> str:
        top, bottom = (in_words(terms, self.wheels) for terms in (self.numerator, self.denominator))
        if bottom == "1":
            return top
        return " / ".join(f"({text})" if " " in text else text for text in (top, bottom))

    def bounded(self, columns: Mapping[str, Ints]) -> tuple[Floats, Floats]:
        """Return the values as in `values`, and bounds on their absolute errors (infinite if no digit is certain)."""
        import numpy as np

        from geartrain.numerics.bounded_polynomials import bounded_quotient, in_range, products_of

        with np.errstate(all="ignore"):
            # tooth counts up to 10^12 are exact in float64
            product = products_of([np.asarray(columns[wheel]).astype(np.float64) for wheel in self.wheels])
        value, error = bounded_quotient(self.numerator, self.denominator, [0] * len(self.wheels), product)
        terms = (*self.numerator, *self.denominator)
        scale = max(abs(term.coefficient) for term in terms)
        # the bounds are valid only without overflow and underflow
        largest = [log10(Fraction(int(np.max(columns[wheel], initial=1)))) for wheel in self.wheels]
        scaled = ((Fraction(c, scale), exponents) for c, exponents in terms)
        return value, error if in_range(scaled, largest) else np.full_like(error, np.inf)


def make_formula(
    label: str, wheels: Sequence[str], numerator: Laurent, denominator: Laurent
) -> tuple[Formula, Laurent]:
    """Return a rational function in lowest terms, and the common divisor that was cancelled (1 if only units were
    cancelled).

    wheels   names of the variables of both polynomials, by index
    """
    # 1/0 in lowest terms: the function has no value anywhere
    if not denominator:
        return Formula(label, (), (Term(1, ()),), ()), Laurent.constant(1, len(wheels))
    # in the monomials of groups of wheels, polynomials have fewer variables, and their divisor is found faster
    grouping = find_grouping([numerator, denominator])
    common = common_divisor(*grouping.rewritten)
    top, bottom = (grouping.back(divide_exactly(each, common), len(wheels)) for each in grouping.rewritten)
    # exponents are made non-negative by a common monomial factor
    lowest = tuple(map(min, top.lowest(), bottom.lowest())) if top else bottom.lowest()
    # canonical form: coprime integer coefficients, the first one of the denominator positive
    scale = (1 if max(bottom.terms.items())[1] > 0 else -1) / top.content(bottom)
    spread = [each.shifted(tuple(-power for power in lowest)).scaled(scale) for each in (top, bottom)]
    used = [at for at in range(len(wheels)) if any(exponents[at] for each in spread for exponents in each.terms)]
    parts = (
        tuple(Term(c, tuple(powers[variable] for variable in used)) for c, powers in each.sorted_terms())
        for each in spread
    )
    return Formula(label, tuple(wheels[at] for at in used), *parts), grouping.back(common, len(wheels))


def _listed(terms: Sequence[Term]) -> list[list[Any]]:
    """Return terms as lists for JSON. Coefficients with too many digits for a JSON number are converted to strings."""
    return [[c if is_short(c, 600) else fraction_text(c), list(exponents)] for c, exponents in terms]
