"""One statement of a source: where, what, the value printed, the way to ours, and the verdict."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any

from sources.ways import Call, Way

REPRODUCED, DECLARED, ERRATUM, OUTSIDE = "reproduced", "declared", "erratum", "out of scope"
VERDICTS = (REPRODUCED, DECLARED, ERRATUM, OUTSIDE)
NOT_COMPUTED = (
    *("history", "a historical conjecture", "a measurement", "fits to measurements", "an astronomical datum"),
    *("the copy has no pictures", "contain no numerical values", "definitions", "a definition", "an assumption"),
    *("a method, not a result", "a proof", "local proofs", "marked as wrong in the note itself", "left open"),
    *("the cited paper is not among the sources", "neglected in the note", "lubrication is not modelled"),
    *("a qualitative argument", "outside the scope"),
)
"""How a reason begins that speaks of the source only; any other one has a `check`."""


@dataclass(frozen=True)
class Finding:
    """Whether a statement holds, and what was found."""

    holds: bool
    text: str

    def __bool__(self) -> bool:
        return bool(self.holds)


class Judge(ABC):
    """Whether a value bears out what is printed, and how the value is shown."""

    @abstractmethod
    def accepts(self, printed: str, value: Any) -> bool:
        """True if it does."""

    @abstractmethod
    def shows(self, printed: str, value: Any) -> str:
        """The value for the page."""

    def corrects(self, correct: str, value: Any) -> bool:
        """Return whether the correction of an erratum agrees with the value, as far as it can be compared."""
        return True


@dataclass(frozen=True)
class Digits(Judge):
    """A printed number: right within half a unit of its last digit."""

    more: int = 2

    def accepts(self, printed: str, value: Any) -> bool:
        """Compared as fractions; what is printed has no more digits than it shows."""
        return abs(_exact(value) - Fraction(printed)) <= Fraction(1, 2 * 10 ** _decimals(printed))

    def corrects(self, correct: str, value: Any) -> bool:
        """Return whether the correction begins with the right number."""
        return self.accepts(correct.split()[0].rstrip(",;:"), value)

    def shows(self, printed: str, value: Any) -> str:
        """A few digits more than are printed, after the fraction where there is one."""
        exact = _exact(value)
        if exact.denominator == 1:
            return str(exact)
        decimal = f"{float(exact):.{_decimals(printed) + self.more}f}"
        return f"{exact} = {decimal}" if not isinstance(value, float) and exact.denominator < 10**4 else decimal


@dataclass(frozen=True)
class Exactly(Judge):
    """A text, or a number without error: the same, letter by letter."""

    def accepts(self, printed: str, value: Any) -> bool:
        """Compared as text."""
        return str(value) == printed

    def corrects(self, correct: str, value: Any) -> bool:
        """Return whether the correction begins with the value."""
        return correct.startswith(str(value))

    def shows(self, printed: str, value: Any) -> str:
        """As it is."""
        return str(value)


@dataclass(frozen=True)
class Equal(Judge):
    """An equation: its two sides differ, in parts of their size, by no more than `bound`, at many places."""

    bound: float = 1e-12

    def accepts(self, printed: str, value: Any) -> bool:
        """The greatest difference is within the bound."""
        return float(value) <= self.bound

    def shows(self, printed: str, value: Any) -> str:
        """The bound if it is kept: rounding is not for a page."""
        if self.accepts(printed, value):
            return f"equal to {self.bound:.0e}"
        return f"differs by up to {float(value):.2g}"


@dataclass(frozen=True)
class Corrected(Judge):
    """An equation with an erratum: two values as of `Equal`, as printed and as corrected."""

    bound: float = 1e-12

    def accepts(self, printed: str, value: Any) -> bool:
        """Whether it is right as printed."""
        return float(value[0]) <= self.bound

    def corrects(self, correct: str, value: Any) -> bool:
        """Return whether the corrected equation is right."""
        return float(value[1]) <= self.bound

    def shows(self, printed: str, value: Any) -> str:
        """Both."""
        return f"relative difference {float(f'{value[0]:.2g}'):g} as printed, at most {self.bound:.0e} after correction"


@dataclass(frozen=True)
class Found(Judge):
    """A statement in words: a `Finding`."""

    def accepts(self, printed: str, value: Any) -> bool:
        """What the finding says."""
        return bool(value)

    def shows(self, printed: str, value: Any) -> str:
        """Its text."""
        return str(value.text)


def _exact(value: Any) -> Fraction:
    return value if isinstance(value, Fraction) else Fraction(str(value))


def _decimals(printed: str) -> int:
    exponent = Decimal(printed).as_tuple().exponent
    assert isinstance(exponent, int)
    return max(0, -exponent)


@dataclass(frozen=True)
class Row:
    """A statement of a source.

    place     place in the source, unique
    claim     what is said
    printed   the value as printed; empty for words and equations
    way       how ours is had; None out of scope
    judge     how the two are compared
    erratum   correct number, formula or statement; empty if what is printed is right
    why       reason why nothing is computed, or a remark
    echo      whether ours is only read off what the shipped train or table declares
    check     out of scope: gives a `Finding` that bears out the reason
    """

    place: str
    claim: str
    printed: str = ""
    way: Way | None = None
    judge: Judge = field(default_factory=Digits)
    erratum: str = ""
    why: str = ""
    echo: bool = False
    check: Way | None = None

    @cached_property
    def value(self) -> Any:
        """Ours."""
        return None if self.way is None else self.way.value()

    @property
    def verdict(self) -> str:
        """One of `VERDICTS`, as declared; `passes` checks it."""
        if self.way is None:
            return OUTSIDE
        return ERRATUM if self.erratum else DECLARED if self.echo else REPRODUCED

    @property
    def passes(self) -> bool:
        """Reproduced, declared: the value agrees; erratum: it does not; out of scope: the reason is true."""
        if self.way is None:
            return self.why.startswith(NOT_COMPUTED) if self.check is None else bool(self.check.value())
        agrees = self.judge.accepts(self.printed, self.value)
        return not agrees and self.judge.corrects(self.erratum, self.value) if self.erratum else agrees

    @property
    def ours(self) -> str:
        """The value for the page; out of scope: what bears out the reason."""
        if self.way is None:
            return "" if self.check is None else str(self.check.value().text)
        return self.judge.shows(self.printed, self.value)


def outside(place: str, claim: str, why: str, printed: str = "") -> Row:
    """A statement that nothing can be computed for, and why: one of `NOT_COMPUTED`."""
    return Row(place, claim, printed, why=why)


def declared(row: Row) -> Row:
    """A row whose value is only read off what is declared."""
    return replace(row, echo=True)


@dataclass(frozen=True)
class Statements:
    """Statements whose ways are expressions with the names of one module."""

    names: Mapping[str, Any] = field(repr=False)

    def call(self, expression: str) -> Call:
        """The way to a value."""
        return Call(expression, self.names)

    def outside(self, place: str, claim: str, why: str, check: str, printed: str = "") -> Row:
        """A statement that geartrain does not answer; the expression gives a `Finding` that bears out the reason."""
        return Row(place, claim, printed, why=why, check=self.call(check))

    def words(self, place: str, claim: str, expression: str, erratum: str = "", why: str = "") -> Row:
        """Return a statement in words; the expression gives a `Finding`."""
        return Row(place, claim, "", self.call(expression), Found(), erratum, why)

    def equation(
        self, place: str, claim: str, expression: str, judge: Judge | None = None, erratum: str = "", why: str = ""
    ) -> Row:
        """An equation; the expression gives how far its two sides differ."""
        return Row(place, claim, "", self.call(expression), judge or Equal(), erratum, why)

    def digits(
        self,
        place: str,
        claim: str,
        printed: str,
        expression: str,
        erratum: str = "",
        why: str = "",
    ) -> Row:
        """A number right at its digits."""
        return Row(place, claim, printed, self.call(expression), Digits(), erratum, why)

    def exact(
        self,
        place: str,
        claim: str,
        printed: str,
        expression: str,
        erratum: str = "",
        why: str = "",
    ) -> Row:
        """A number or text that must be the same."""
        return Row(place, claim, printed, self.call(expression), Exactly(), erratum, why)


@dataclass(frozen=True)
class Source:
    """A text and its rows."""

    name: str
    cite: str
    text: str
    rows: tuple[Row, ...]
