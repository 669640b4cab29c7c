"""Rational functions of tooth counts in textbook notation, which are factored and given as text, LaTeX or SymPy
expressions.

Polynomials in tooth counts are written as products in which no two factors have a wheel in common. Two variables i and
j belong to different factors of P if and only if P(i, j) P(a, b) = P(a, j) P(i, b) for fixed values a and b with P(a,
b) not 0, because P is then, up to a constant, the product of a polynomial without i and one without j. For gear trains,
this factorisation is almost always complete, because epicyclic sets in series have different wheels.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING, Any

from geartrain.errors import MissingExtraError
from geartrain.kinematics.formulas.laurent import Exponents, Laurent, Term, divide, product
from geartrain.kinematics.formulas.rational_functions import Formula, make_formula, whole
from geartrain.numerics.exact import integer_factors
from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from sympy import Expr


# -------------------------------------------------------------------------------------------------------------- factors


_VALUES = (2, 3, 5, 7, 11, 13)  # primes: sums of their products rarely vanish


@dataclass(frozen=True, slots=True)
class FactoredPolynomial:
    """Factored polynomial: an integer, times powers of variables, times sums that have no variable in common."""

    content: int
    """Integer factor; 0 for the zero polynomial."""
    powers: Exponents
    """Exponent of each variable, by index."""
    sums: tuple[tuple[Term, ...], ...]
    """Factors that have two or more terms. The terms of each factor are sorted by descending exponents."""

    @classmethod
    def of(cls, terms: Sequence[Term], point: Sequence[int], known: Sequence[Laurent] = ()) -> FactoredPolynomial:
        """Factor a polynomial with non-negative exponents. The sign of each sum is chosen so that the sum is positive
        at `point`, unless it is 0 there.

        known   candidates for factors, which are tried first
        """
        width = len(point)
        given = Laurent.of(terms, width)
        if not given:
            return cls(0, (0,) * width, ())
        # the monomial factor is split off first, then known factors, then separable ones
        powers, rest = given.lowest(), given.lowered()
        left = rest
        found: list[Laurent] = []
        for factor in known:
            while (quotient := divide(left, factor)) is not None:
                left, found = quotient, [*found, factor]
        sums = [_positive_at_point(each, point) for each in (*found, *_separate_factors(left)) if len(each) > 1]
        back = product([Laurent.of(each, width) for each in sums], width)
        exponents = next(iter(back.terms))
        # one coefficient determines the integer factor, because the product is known up to it
        content = rest.terms[exponents] / back.terms[exponents]
        assert back.scaled(content) == rest, "factors multiply to the whole"
        return cls(int(content), powers, tuple(sums))


def _positive_at_point(p: Laurent, point: Sequence[int]) -> tuple[Term, ...]:
    terms = p.sorted_terms()
    # a sum that is 0 at the point gets the sign of its first term
    value = whole(terms, point) or terms[0].coefficient
    found = terms if value > 0 else (-p).sorted_terms()
    return tuple(sorted(found, key=lambda term: term.coefficient < 0))  # positive terms first


def _separate_factors(p: Laurent) -> Iterator[Laurent]:
    """Yield the factors of a polynomial, no two of which have a variable in common, each up to a constant factor."""
    used = [at for at in range(p.width) if any(exponents[at] for exponents in p.terms)]
    groups = [{at} for at in used]
    for i, j in combinations(used, 2):
        one, other = (next(group for group in groups if at in group) for at in (i, j))
        # inseparable variables are in one factor: their groups are merged
        if one is not other and not _are_separable(p, i, j):
            groups.remove(other)
            one |= other
    for group in groups:
        factor = p
        for at in used:
            # other variables are replaced by primes at which the polynomial does not vanish
            if at not in group:
                factor = next(found for value in _VALUES if (found := _substitute(factor, at, value)))
        yield factor.primitive()


def _are_separable(p: Laurent, i: int, j: int) -> bool:
    for value in _VALUES:
        at_i, at_j = _substitute(p, i, value), _substitute(p, j, value + 1)
        both = _substitute(at_i, j, value + 1)
        if both:
            # criterion of the module's docstring with (a, b) = (value, value + 1)
            return p * both == at_i * at_j
    return False


def _substitute(p: Laurent, at: int, value: int) -> Laurent:
    found: dict[Exponents, Fraction] = {}
    for exponents, coefficient in p.terms.items():
        key = (*exponents[:at], 0, *exponents[at + 1 :])
        found[key] = found.get(key, Fraction(0)) + coefficient * value ** exponents[at]
    return Laurent(p.width, {exponents: each for exponents, each in found.items() if each})


# --------------------------------------------------------------------------------------------------------- closed forms


_PLAIN = re.compile(r"\w+")
_MOST_SPLIT = 3
"""Maximum number of terms of a sum that is divided term by term, as in 1 + z_r/z_s = (z_s + z_r)/z_s."""


@dataclass(frozen=True)
class _Style:
    """Notation of symbols, powers, quotients and brackets in text or in LaTeX."""

    symbol: Callable[[str], str]
    power: Callable[[str, int], str]
    over: Callable[[str, str], str]
    bracketed: Callable[[str], str]
    pi: str


_TEXT = _Style(
    lambda wheel: f"z_{wheel}" if _PLAIN.fullmatch(wheel) else f"z[{wheel}]",
    lambda base, power: f"{base}^{power}",
    lambda top, bottom: f"{_in_brackets(top)}/{_in_brackets(bottom)}",
    lambda text: f"({text})",
    "π",
)
_LATEX = _Style(
    lambda wheel: "z_{\\mathrm{" + wheel.replace("_", r"\_") + "}}",
    lambda base, power: f"{base}^{{{power}}}",
    lambda top, bottom: rf"\frac{{{top}}}{{{bottom}}}",
    lambda text: rf"\left({text}\right)",
    r"\pi",
)


@dataclass(frozen=True)
class ClosedForm(Result):
    """Rational function of tooth counts in lowest terms, and its value at the declared tooth counts.

    See Also
    --------
    OutputFormula : speed of an output as a sum of such functions times input speeds
    """

    KEYS = ("text", "latex", "value", Key("wheels", "formula.wheels"))

    formula: Formula
    """Formula as exact numerator and denominator."""
    counts: Mapping[str, int] = field(repr=False)
    """Declared tooth counts by wheel, for at least all wheels in the formula."""
    known: tuple[tuple[tuple[str, ...], tuple[Term, ...]], ...] = field(default=(), repr=False)
    """Candidates for factors, which are tried first: each consists of a list of wheels, and of terms whose exponents
    refer to these wheels.
    """

    def __str__(self) -> str:
        """Return the formula as text."""
        return self.text

    _repr_html_ = None  # type: ignore[assignment]  # notebooks show the formula

    def _repr_latex_(self) -> str:
        return f"${self.latex}$"

    @property
    def value(self) -> Fraction | None:
        """Value of the formula at the declared tooth counts; None if the denominator is 0."""
        return self.formula.value(self.counts)

    @cached_property
    def text(self) -> str:
        """Formula as text, such as `z_s/(z_s + z_r)`, or `1 + z_r/z_s`."""
        return self._format(_TEXT)

    @cached_property
    def latex(self) -> str:
        """Formula in LaTeX."""
        return self._format(_LATEX)

    def sympy(self) -> Expr:
        """Return the formula as a SymPy expression, the factored numerator divided by the factored denominator. Symbols
        are named `z_` plus the name of the wheel.

        Raises
        ------
        MissingExtraError
            If SymPy (extra `sympy`) is not installed.
        """
        try:
            import sympy
        except ImportError:
            raise MissingExtraError("sympy", "sympy", "an expression for symbolic calculation") from None
        symbols = [sympy.Symbol(f"z_{wheel}", positive=True, integer=True) for wheel in self.formula.wheels]

        def summed(terms: Iterable[Term]) -> Any:
            return sympy.Add(
                *(c * sympy.Mul(*(s**e for s, e in zip(symbols, powers, strict=True))) for c, powers in terms)
            )

        parts = (self._factored(terms) for terms in (self.formula.numerator, self.formula.denominator))
        top, bottom = (
            each.content * summed([Term(1, each.powers)]) * sympy.Mul(*map(summed, each.sums)) for each in parts
        )
        return top / bottom

    @property
    def inverse(self) -> ClosedForm:
        """Reciprocal of the formula, whose denominator is 0 if the formula is 0."""
        width, wheels = len(self.formula.wheels), self.formula.wheels
        top, bottom = (Laurent.of(terms, width) for terms in (self.formula.denominator, self.formula.numerator))
        return ClosedForm(make_formula(self.formula.label, wheels, top, bottom)[0], self.counts, self.known)

    def elasticity(self, wheel: str) -> ClosedForm:
        """Return the elasticity (z/f) df/dz, where f is this function and z the tooth count of one wheel. It is the
        relative change of f per relative change of z.

        Parameters
        ----------
        wheel : str
            Name of a wheel. The elasticity is 0 if the wheel is not in the formula.
        """
        width, wheels = len(self.formula.wheels), self.formula.wheels
        top, bottom = (Laurent.of(terms, width) for terms in (self.formula.numerator, self.formula.denominator))
        if wheel not in wheels:
            top, bottom = Laurent.constant(0, width), Laurent.constant(1, width)
        else:
            at = wheels.index(wheel)
            # z dp/dz: every term times its exponent of z
            steep, flat = (Laurent(width, {e: c * e[at] for e, c in p.terms.items() if e[at]}) for p in (top, bottom))
            top, bottom = steep * bottom - top * flat, top * bottom
        found, _ = make_formula(f"elasticity of {self.formula.label} in {wheel}", wheels, top, bottom)
        parts = (self._factored(terms) for terms in (self.formula.numerator, self.formula.denominator))
        return ClosedForm(found, self.counts, tuple((wheels, terms) for part in parts for terms in part.sums))

    @property
    def poles(self) -> tuple[str, ...]:
        """Conditions under which the denominator is 0, as equations between products of tooth counts; empty if the
        denominator cannot be 0.
        """
        return self._zeros_of(self.formula.denominator)

    @property
    def zeros(self) -> tuple[str, ...]:
        """Conditions under which the numerator is 0, as equations between products of tooth counts; empty if the
        numerator cannot be 0.
        """
        return self._zeros_of(self.formula.numerator)

    def _zeros_of(self, terms: Sequence[Term]) -> tuple[str, ...]:
        """Return the equations between products of tooth counts under which a polynomial is 0, one for each factor."""
        found = []
        for factor in self._factored(terms).sums:
            added = [term for term in factor if term.coefficient > 0]
            taken = [Term(-term.coefficient, term.exponents) for term in factor if term.coefficient < 0]
            if added and taken:  # a sum of terms of one sign cannot vanish
                sides = (_sum(side, self.formula.wheels, _TEXT) for side in (added, taken))
                found.append(" = ".join(sides))
        return tuple(found)

    def _factored(self, terms: Sequence[Term]) -> FactoredPolynomial:
        own, known = self.formula.wheels, []
        for wheels, factor in self.known:
            used = {wheels[at] for _, powers in factor for at, power in enumerate(powers) if power}
            if used.issubset(own):
                place = {wheel: at for at, wheel in enumerate(wheels)}
                spread = [
                    Term(coefficient, tuple(powers[place[wheel]] if wheel in place else 0 for wheel in own))
                    for coefficient, powers in factor
                ]
                known.append(Laurent.of(spread, len(own)))
        return FactoredPolynomial.of(terms, [self.counts[wheel] for wheel in own], known)

    def _format(self, style: _Style) -> str:
        top, bottom = (self._factored(terms) for terms in (self.formula.numerator, self.formula.denominator))
        split = self._format_split(style, top, bottom)
        if split:
            return split
        sign = "-" if top.content * bottom.content < 0 else ""
        above, below = (_product(each, self.formula.wheels, style) for each in (top, bottom))
        return sign + (above if below == "1" else style.over(above, below))

    def _format_split(self, style: _Style, top: FactoredPolynomial, bottom: FactoredPolynomial) -> str:
        """Return a quotient in the form 1 + z_r/z_s as text. Return "" if the numerator is not a short sum (at most
        `_MOST_SPLIT` terms) with a term that equals the denominator up to a factor.
        """
        # only a short sum over a monomial that is one of its terms
        if bottom.sums or len(top.sums) != 1 or any(top.powers) or len(top.sums[0]) > _MOST_SPLIT:
            return ""
        one = next((term for term in top.sums[0] if term.exponents == bottom.powers), None)
        if one is None or one.coefficient * top.content % bottom.content:
            return ""
        words: list[str] = []
        # the term that cancels comes first, as the 1 in 1 + z_r/z_s
        for term in sorted(top.sums[0], key=lambda each: each is not one):
            value = Fraction(term.coefficient * top.content, bottom.content)
            powers = tuple(a - b for a, b in zip(term.exponents, bottom.powers, strict=True))
            above, below = (
                FactoredPolynomial(abs(part), tuple(max(sign * power, 0) for power in powers), ())
                for part, sign in ((value.numerator, 1), (value.denominator, -1))
            )
            written = [_product(each, self.formula.wheels, style) for each in (above, below)]
            text = written[0] if written[1] == "1" else style.over(*written)
            words.append(f"{'-' if value < 0 else '+' if words else ''}{' ' if words else ''}{text}")
        return " ".join(words)


def _product(p: FactoredPolynomial, wheels: Sequence[str], style: _Style) -> str:
    parts = integer_factors(abs(p.content), style.pi)
    for wheel, power in zip(wheels, p.powers, strict=True):
        if power:
            parts.append(style.symbol(wheel) if power == 1 else style.power(style.symbol(wheel), power))
    sums = [_sum(terms, wheels, style) for terms in p.sums]
    alone = len(sums) == 1 and not parts
    parts += sums if alone else [style.bracketed(each) for each in sums]
    return " ".join(parts) or "1"


def _sum(terms: Sequence[Term], wheels: Sequence[str], style: _Style) -> str:
    words: list[str] = []
    for coefficient, exponents in terms:
        text = _product(FactoredPolynomial(coefficient, exponents, ()), wheels, style)
        words.append(("- " if words else "-") + text if coefficient < 0 else ("+ " if words else "") + text)
    return " ".join(words)


def _in_brackets(text: str) -> str:
    return f"({text})" if " " in text else text
