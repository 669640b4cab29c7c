"""Rational functions of tooth counts: exact values, fast values with their accuracy, and monomial groups.

A monomial group holds wheels on which the function depends through one monomial only.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

from geartrain.kinematics.formulas.laurent import Exponents, Laurent, Term, common_divisor, divide
from geartrain.numerics.exact import fraction_text, is_short, log10
from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints


@dataclass(frozen=True, slots=True)
class MonomialGroup(Result):
    """Wheels of one class: the function sees only x, the product of their counts to the powers `exponents`."""

    KEYS = (Key("exponents", "by_wheel"), "degree")

    wheels: tuple[str, ...]
    """In the order declared."""
    exponents: Exponents
    """Not 0; usually 1 or -1, the first positive."""
    degree: int
    """Greatest power of x in the function's numerator or denominator; 1 makes it a Moebius function of x."""

    @property
    def by_wheel(self) -> dict[str, int]:
        """The exponents by wheel."""
        return dict(zip(self.wheels, self.exponents, strict=True))

    @property
    def roundings(self) -> int:
        """Roundings in one `monomials`: its relative error is below this times 2^-53, but for its square."""
        return sum(map(abs, self.exponents))

    def monomials(self, columns: Mapping[str, Any]) -> NDArray[np.float64]:
        """x of many assignments (wheel -> counts, which broadcast); see `roundings` for the error."""
        import numpy as np

        top: NDArray[np.float64] = np.ones(())
        bottom = top
        for wheel, power in zip(self.wheels, self.exponents, strict=True):
            column = np.asarray(columns[wheel]).astype(np.float64)
            for _ in range(abs(power)):
                if power > 0:
                    top = top * column
                else:
                    bottom = bottom * column
        return np.asarray(top / bottom, dtype=np.float64)


@dataclass(frozen=True, slots=True)
class MonomialGrouping:
    """Polynomials rewritten in as few monomials as they allow, up to one common monomial."""

    members: tuple[Mapping[int, int], ...]
    """For each group, variable -> its exponent in the group's monomial."""
    rewritten: tuple[Laurent, ...]
    """The polynomials in the groups' monomials, all powers >= 0."""

    def back(self, p: Laurent, width: int) -> Laurent:
        """A polynomial in the groups' monomials as one in the first variables."""

        def spread(exponents: Exponents) -> Exponents:
            full = [0] * width
            for members, power in zip(self.members, exponents, strict=True):
                for variable, step in members.items():
                    full[variable] = power * step
            return tuple(full)

        return Laurent(width, {spread(exponents): value for exponents, value in p.terms.items()})


Member = TypeVar("Member")


def proportional_classes(lists: Iterable[tuple[Member, Sequence[int]]]) -> dict[Exponents, dict[Member, int]]:
    """Keys whose lists of whole numbers are multiples of one list: that list -> each key with its multiple.

    The lists of the classes have no common divisor, and begin with a positive number beside zeros. Keys with nothing
    but zeros are in none.
    """
    classes: dict[Exponents, dict[Member, int]] = {}
    for key, steps in lists:
        # multiples of one list are the same list once divided by their common divisor and sign
        size = math.gcd(*steps)
        if size:
            size = size if next(step for step in steps if step) > 0 else -size
            classes.setdefault(tuple(step // size for step in steps), {})[key] = size
    return classes


def find_grouping(polynomials: Sequence[Laurent]) -> MonomialGrouping:
    """The coarsest classes of variables such that a quotient of the polynomials sees each through one monomial.

    Dividing all by one monomial changes no quotient, so only differences of exponents count. A monomial of a class
    stays the same along all directions that change its variables alone if and only if their differences, listed
    over all terms, are multiples of one list. For a quotient in lowest terms no coarser classes exist.
    """
    terms = [exponents for p in polynomials for exponents in p.terms]
    columns = enumerate(zip(*terms, strict=True))
    classes = proportional_classes((variable, [power - powers[0] for power in powers]) for variable, powers in columns)
    members = []
    lists = []
    for list_, found in classes.items():
        sign = 1 if next(iter(found.values())) > 0 else -1
        members.append({variable: sign * size for variable, size in found.items()})
        minimum = min(sign * step for step in list_)
        lists.append([sign * step - minimum for step in list_])
    powers_of: Iterator[Exponents] = iter(zip(*lists, strict=True) if lists else [()] * len(terms))
    rewritten = tuple(
        Laurent(len(members), {next(powers_of): value for value in p.terms.values()}) for p in polynomials
    )
    return MonomialGrouping(tuple(members), rewritten)


def whole(terms: Iterable[Term], point: Sequence[int]) -> int:
    """A polynomial with powers >= 0 at whole numbers."""
    total = 0
    for coefficient, exponents in terms:
        for count, power in zip(point, exponents, strict=True):
            if power:
                coefficient *= count if power == 1 else count**power
        total += coefficient
    return total


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


@dataclass(frozen=True, slots=True)
class Formula:
    """A rational function of tooth counts, reduced: numerator and denominator have no factor in common.

    A denominator without terms is 0: a function that has no value anywhere, which `fixed` may leave.
    """

    label: str
    """The output it gives, or what a condition comes from."""
    wheels: tuple[str, ...]
    """The free wheels it depends on, in the order declared."""
    numerator: tuple[Term, ...]
    """Terms whose exponents are parallel to `wheels`, all >= 0; coefficients are whole, with no common."""
    denominator: tuple[Term, ...]
    """Divisor over both; the first coefficient of the denominator is positive."""
    groups: tuple[MonomialGroup, ...]
    """The coarsest classes of wheels such that it depends on each class through one monomial only."""
    upper: tuple[Term, ...]
    """Numerator and denominator once more, with exponents parallel to `groups`, all >= 0."""
    lower: tuple[Term, ...]
    """Numerator and denominator once more, with exponents parallel to `groups`, all >= 0."""

    @property
    def constant(self) -> Fraction | None:
        """The value, if it depends on no wheel and has one."""
        return None if self.wheels else self.value({})

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
        return self._bounded(columns)[0]

    def accuracy(self, columns: Mapping[str, Ints]) -> Floats:
        """A bound on the relative error of `values`: |value - exact| <= accuracy |exact|, cancellation included.

        Infinite where cancellation leaves no digit, at poles, and beyond the range of float64.
        """
        import numpy as np

        value, error = self._bounded(columns)
        with np.errstate(all="ignore"):
            # the exact value is at least |value| - error in size
            found = np.where(error > 0, error / (np.abs(value) - error), 0.0)
        return np.where((found >= 0) & np.isfinite(found), found, np.inf)

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

    def _bounded(self, columns: Mapping[str, Ints]) -> tuple[Floats, Floats]:
        """Values and bounds on their absolute errors."""
        import numpy as np

        from geartrain.numerics.bounded_polynomials import BoundedQuotient, in_range, products_of

        quotient = BoundedQuotient.of(self.upper, self.lower, [group.roundings for group in self.groups])
        with np.errstate(all="ignore"):
            value, error = quotient.bounded(products_of([group.monomials(columns) for group in self.groups]))
        terms = (*self.numerator, *self.denominator)
        scale = max(abs(term.coefficient) for term in terms)
        largest = [log10(Fraction(int(np.max(columns[wheel], initial=1)))) for wheel in self.wheels]
        scaled = ((Fraction(c, scale), exponents) for c, exponents in terms)
        return value, error if in_range(scaled, largest) else np.full_like(error, np.inf)


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
