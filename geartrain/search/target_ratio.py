"""Parser of a requested ratio: a number, a fraction, a pair of tooth counts, a quotient of periods, or a name."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from pydantic_core import PydanticCustomError

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import as_float, decimal, fraction_text
from geartrain.numerics.quantity import UNITS, Figure, Quantity
from geartrain.numerics.results import Key, Result
from geartrain.train.periods import period_table, suggested_period

TargetKind = Literal["number", "things", "time", "speed", "count"]

_MOST_CHARACTERS = 2000  # more than two numbers of 400 characters with words
_SHOWN = 60  # characters of a given text in a message
_FARTHEST = Fraction(10**30)  # about fifteen stages of 1:100
_NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d{1,3})?"
_WITH_WORD = re.compile(rf"({_NUMBER}(?:\s*[/:]\s*{_NUMBER})?)\s*(?![eE][+-]?\d)([^\W\d_].*)")
_DIVISION = re.compile(r"[/:]")
_WIDE_DIVISION = re.compile(r"\s[/:]\s")
# words for times in addition to the units of quantities
_TIMES = {
    **dict.fromkeys(("hour", "hours", "hr", "hrs"), "h"),
    **dict.fromkeys(("minute", "minutes", "mins"), "min"),
    **dict.fromkeys(("second", "seconds", "sec", "secs"), "s"),
}
_COUNTED_TIMES = ("day", "days", "hour", "hours", "minute", "minutes", "second", "seconds")
_TURNS = ("turn", "turns", "rev")
_WAYS = "235/19, 13.368267, 1:30, '235 months / 19 years', '365.2422 d / 29.53059 d' or a name from `geartrain periods`"


@dataclass(frozen=True, slots=True)
class TargetRatio(Result):
    """Requested ratio of a gear train, with an optional sense of rotation. `read_ratio` parses it from a string.

    Raises
    ------
    QuestionError
        If the value is not from 1e-30 to 1e30.

    Examples
    --------
    >>> TargetRatio(Fraction(235, 19)).value
    Fraction(235, 19)
    """

    KEYS = ("label", Key("ratio", "value"), Key("value", to=as_float), "sense", "note")

    value: Fraction
    """Exact magnitude of the ratio: product of the tooth counts in the numerator divided by the product of the tooth
    counts in the denominator.
    """
    sense: Literal[-1, 0, 1] = 0
    """Requested sense of rotation of the output: 1 for the sense of the input, -1 for the opposite sense, 0 for either.
    """
    label: str = ""
    """Text from which the ratio was parsed, with the second period if there is one."""
    note: str = ""
    """Derivation of the ratio, and the source of its data."""

    def __post_init__(self) -> None:
        if self.value <= 0:
            raise _problem(
                f"the ratio is {_short(fraction_text(self.value))}",
                "the magnitude of a ratio must be positive; a separate sign gives the sense",
                "give a number above 0",
            )
        if not 1 / _FARTHEST <= self.value <= _FARTHEST:
            raise _problem(
                f"the ratio is {_short(self.label or decimal(self.value, 6))}",
                "the ratio of a gear train must be from 1e-30 to 1e30",
                "give a ratio in this range",
            )


@dataclass(frozen=True, slots=True)
class _Term:
    """One side of a quotient that was parsed, or the whole text if there is no quotient. It contains the kind of the
    term, its exact value (times are in days), its unit or the name of what is counted, such as "months", and a note on
    its origin.
    """

    kind: TargetKind
    value: Fraction
    word: str
    note: str


def read_ratio(text: str, per: str | None = None) -> TargetRatio:
    """Parse a requested ratio from a string, as an exact fraction.

    Parameters
    ----------
    text : str
        A number, a fraction, a pair of counts, a ratio of two periods, or a name listed by `geartrain periods`; see
        Notes. A leading sign requests a sense of rotation: + the same sense as the input, - the opposite sense. Without
        a sign both senses are accepted.
    per : str, optional
        Second period, if `text` is a single period. The ratio is then the number of its revolutions in one period
        `per`.

    Returns
    -------
    TargetRatio
        Magnitude, sense of rotation and origin of the ratio.

    Raises
    ------
    QuestionError
        If the string cannot be parsed or is ambiguous, or if the ratio is not from 1e-30 to 1e30.

    Notes
    -----
    "13.368267", "235/19", "1:30"      the number, exactly as written
    "235 months / 19 years"            a pair of counts: while the second (years) makes 19 revolutions, the first
                                       (months) makes 235, so its pointer is 235/19 times as fast
    "365.2422 d / 29.53059 d"          a ratio of two periods: the number of revolutions of the second during one
    "year_julian / month_metonic"      revolution of the first, so the ratio is the speed with the second period
                                       divided by the speed with the first. Each side is a time or the name of a
                                       period.
    "metonic_months_per_year"          a name from the table of periods whose row is a speed (revolutions per year) or a
                                       count
    "month_synodic_J2000" and `per`    a single period: its number of revolutions in one period `per`

    Units of time are d, h, min, s and the like. Any other word names counted objects. For retrograde speeds in the
    table, the magnitude is used.

    Examples
    --------
    >>> ratio = read_ratio("-235 months / 19 years")
    >>> ratio.value, ratio.sense, ratio.note
    (Fraction(235, 19), -1, '235 months in the time of 19 years')
    """
    if len(text) > _MOST_CHARACTERS:
        raise _problem(
            f"the ratio has {len(text)} characters", f"at most {_MOST_CHARACTERS} are accepted", f"write {_WAYS}"
        )
    # a typographic minus sign is accepted
    label = " ".join(text.replace("−", "-").split())
    sense: Literal[-1, 0, 1] = -1 if label.startswith("-") else 1 if label.startswith("+") else 0
    terms = [_term(part, label) for part in _parts(label[abs(sense) :].strip(), label)]
    if len(terms) == 1:
        value, note = _single_term(terms[0], label, per)
    elif per is None:
        value, note = _quotient(terms[0], terms[1], label)
    else:
        raise _ratio_already(label, per)
    return TargetRatio(value, sense, label if per is None else f"{label} per {per}", note)


def _parts(text: str, label: str) -> list[str]:
    """Divide a text at its division sign, and return one or two parts. A division sign between spaces takes
    precedence.
    """
    # a term such as '1/3 d' may contain a division sign itself
    for division in (_WIDE_DIVISION, _DIVISION):
        parts = division.split(text)
        if len(parts) == 2:
            return [part.strip() for part in parts]
    if len(parts) > 2:
        raise _problem(
            f"'{_short(label)}' has more than one division sign", "a ratio is one quotient", f"write {_WAYS}"
        )
    return parts


def _term(text: str, label: str) -> _Term:
    if not text:
        raise _problem(
            f"'{_short(label)}' lacks a number", "a ratio is one number or a quotient of two terms", f"write {_WAYS}"
        )
    if re.match(r"[+-]\s*[\d.]", text):
        raise _problem(
            f"'{_short(text)}' has a sign",
            "only the whole ratio has a sign, which gives the sense of rotation",
            "write the sign in front of the ratio, such as -235/19",
        )
    match = _WITH_WORD.fullmatch(text)
    if match is not None:
        term = _with_word(match[1], match[2].strip())
    elif text in period_table():
        row = period_table()[text]
        unit = {"period": "d", "speed": f"{row.what} per year", "count": row.what}[row.kind]
        note = f"{text} = {' '.join((decimal(row.value, 12), *unit.split()))} ({row.source})"
        term = _Term("time" if row.kind == "period" else row.kind, abs(row.value), text, note)
    else:
        term = _Term("number", _figure(text), "", "")
    if not term.value:
        why = "a ratio must be positive and finite"
        raise _problem(f"'{_short(label)}' contains a zero", why, f"write {_WAYS}")
    return term


def _with_word(number: str, word: str) -> _Term:
    """Parse a number that is followed by a word. The word is a unit of time or the name of counted objects."""
    shown = f"{number} {word}"
    if word in period_table():
        raise _problem(
            f"'{_short(shown)}' is ambiguous",
            f"the number may be {number} revolutions or {number} times the period",
            f"for counts use other words, such as '{number} months'; for times write the days, such as '29.53 d'",
        )
    unit = _TIMES.get(word, word)
    try:
        quantity = Quantity.parse(f"{number} {unit}", " or ".join({kind for kind, _ in UNITS.values()}), plain=False)
    except PydanticCustomError:
        return _Term("things", _figure(number), word, shown)
    if quantity.dimension == "time":
        # [s] to [d], the unit of the table of periods
        return _Term("time", quantity.base / 86400, word, shown)
    if word in _TURNS:
        return _Term("things", quantity.value, word, shown)
    raise _problem(
        f"'{_short(shown)}' is a {quantity.dimension}",
        "a ratio is given by numbers, counts or periods",
        "write only the number, or a time such as '29.53059 d'",
    )


def _figure(text: str) -> Fraction:
    try:
        return Figure.parse(text).value
    except PydanticCustomError as error:
        what, why = f"'{_short(text)}' is not a number", error.message()
        if "why" in (context := error.context or {}):
            raise _problem(why, context["why"], context["fix"]) from None
        if text[:1].isalpha():
            raise _problem(
                what, "`geartrain periods` lists no period with this name either", suggested_period(text)
            ) from None
        if text[:1].isdigit() and "is not a number" in why:
            why = "a number has at most 400 characters, and an exponent three digits"
        raise _problem(what, why, f"write {_WAYS}") from None


def _single_term(term: _Term, label: str, per: str | None) -> tuple[Fraction, str]:
    """Return a ratio without division sign, and a note on its origin: the value of a number or of a named speed or
    count, or the number of periods `term` in one period `per`.
    """
    if term.kind == "time":
        if per is None:
            period = label.lstrip("+- ")
            year = period.startswith("year")
            pair = f"{period} / month_synodic_J2000" if year else f"year_tropical_J2000 / {period}"
            raise _problem(
                f"'{_short(label)}' is a period, not a ratio",
                "a ratio needs two periods",
                f"for example, write '{pair}'",
            )
        whole = _term(" ".join(per.split()), per)
        if whole.kind != "time":
            fix = "give a time or a name, such as year_tropical_J2000"
            raise _problem(f"`per` is '{_short(per)}'", "`per` must be a period", fix)
        return whole.value / term.value, f"{whole.note} over {term.note}"
    if term.kind == "things":
        raise _problem(
            f"'{_short(label)}' is only one count",
            "a ratio of counts needs a second count in the same time",
            f"for example, write '{'235 months' if term.word.startswith('year') else term.note} / 19 years'",
        )
    if per is not None and not (term.kind == "speed" and per.startswith("year") and per in period_table()):
        raise _ratio_already(label, per)
    return term.value, term.note or "as given"


def _quotient(first: _Term, second: _Term, label: str) -> tuple[Fraction, str]:
    """Return the quotient of two terms of the same kind, and a note on its origin."""
    kinds, both = {first.kind, second.kind}, (first, second)
    if kinds == {"number"}:
        return first.value / second.value, "as given"
    # a unit of time may also be the name of counted objects, as in '27759 days / 940 months'
    if "things" in kinds and all(term.kind == "things" or term.word in _COUNTED_TIMES for term in both):
        top, beneath = (
            _figure(term.note.removesuffix(term.word)) if term.kind == "time" else term.value for term in both
        )
        return top / beneath, f"{first.note} in the time of {second.note}"
    if len(kinds) == 1:
        # such as '24 h / 1 d', which is 1 as periods and 24 as counts
        same = first.kind == "time" and first.value == second.value and first.word != second.word
        if same and not {first.word, second.word} & set(period_table()):
            raise _problem(
                f"'{_short(label)}' has the same time on both sides",
                "a quotient of equal periods is 1, but a pair of counts may be meant",
                f"write '{first.note.split()[0]}/{second.note.split()[0]}' for counts",
            )
        return first.value / second.value, f"{first.note} over {second.note}"
    words = {"number": "a number without a unit", "things": "a count", "time": "a period"}
    quantities = " divided by ".join(
        words.get(term.kind, f"a {term.kind}") + (f" ({_short(term.note)})" if term.note else "") for term in both
    )
    raise _problem(
        f"'{_short(label)}' is a quotient of different quantities",
        f"{quantities} is not a ratio of speeds",
        "write two numbers, two counts of things, two times (d, h, min, s), or two names of one kind",
    )


def _ratio_already(label: str, per: str) -> QuestionError:
    return _problem(
        f"'{_short(label)}' is already a ratio",
        f"`per` ('{_short(per)}') is only used with a single period",
        "omit `per`, or give a single period",
    )


def _short(text: str) -> str:
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."


def _problem(what: str, why: str, fix: str) -> QuestionError:
    return QuestionError(Problem(what, why, fix))
