"""The counting room: integers and Fractions. It knows no gears and imports the standard library only."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from decimal import MAX_EMAX, MAX_PREC, Context, Decimal, Inexact, localcontext
from fractions import Fraction
from heapq import heapify, heappop, heappush

PRIME = (1 << 61) - 1
"""A Mersenne prime: rank modulo it is a lower bound that is exact but for accidents of probability 1e-18."""

LinearForm = dict[int, Fraction]
"""A linear form: column -> coefficient. Columns >= 0 are unknowns; columns < 0 are symbols, never solved for."""


def coprime(numerator: int, denominator: int) -> Fraction:
    """A Fraction from a reduced pair with a positive denominator, without the gcd that Fraction() would take.

    The gcd of long integers costs the square of their length, and a walk along a train has reduced already.
    """
    value = Fraction()
    value._numerator = numerator  # type: ignore[attr-defined]
    value._denominator = denominator  # type: ignore[attr-defined]
    return value


def times(n: int, d: int, a: int, b: int) -> tuple[int, int]:
    """n/d times a/b, reduced, denominator positive. n/d is reduced; a and b are short, so the gcds stay cheap."""
    if b < 0:
        a, b = -a, -b
    common = math.gcd(a, b)
    if common > 1:
        a //= common
        b //= common
    left = math.gcd(n, b)
    if left > 1:
        n //= left
        b //= left
    right = math.gcd(a, d)
    if right > 1:
        a //= right
        d //= right
    return n * a, d * b


def log10(value: Fraction) -> float:
    """Decimal logarithm of |value| for numbers of any size; -inf for zero."""
    if not value:
        return -math.inf
    return math.log10(abs(value.numerator)) - math.log10(value.denominator)


def as_float(value: Fraction) -> float | None:
    """The nearest float64, or None where float64 has none: a silent 0 or infinity would be a lie."""
    try:
        number = float(value)
    except OverflowError:
        return None
    if value and abs(number) < 2.2250738585072014e-308:
        return None
    return number


def decimal(value: Fraction, digits: int = 10) -> str:
    """`value` in decimal, rounded to `digits` significant digits, for numbers of any size.

    >>> decimal(Fraction(254, 19), 6), decimal(Fraction(-1, 3) ** 700, 4)
    ('13.3684', '1.035e-334')
    """
    number = as_float(value)
    if number is not None:
        return f"{number:.{digits}g}"
    exponent = math.floor(log10(value))
    mantissa = str(_scaled(abs(value), digits - 1 - exponent, digits))
    exponent += len(mantissa) - digits
    sign = "-" if value < 0 else ""
    rest = f".{mantissa[1:digits]}" if digits > 1 else ""
    return f"{sign}{mantissa[0]}{rest}e{exponent:+d}"


def _scaled(value: Fraction, power: int, digits: int) -> int:
    """round(value * 10**power), a number of some `digits`, from the leading bits alone where they decide it."""
    with localcontext(Context(prec=digits + 30, Emax=MAX_EMAX, Emin=-MAX_EMAX)):
        near = _leading(value.numerator) / _leading(value.denominator) * Decimal(10) ** power
        off = near - near.to_integral_value()
        if abs(abs(off) - Decimal("0.5")) > Decimal("1e-10"):
            return int(near.to_integral_value())
    exact: Fraction = value * Fraction(10) ** power
    return round(exact)  # a tie, or as good as one: all digits are needed


def _leading(number: int) -> Decimal:
    """A long positive integer to the precision of the context."""
    cut = max(number.bit_length() - 1024, 0)
    return Decimal(number >> cut) * Decimal(2) ** cut


_PLAIN, _SHORT = 2000, 600
"""Bits and digits of integers that Python itself writes and reads under any limit: none is below 640 digits."""


def fraction_text(value: Fraction | int) -> str:
    """All digits of a number, as `str` gives them, for numbers of any size.

    Python refuses to write integers past 4300 digits, for it takes the square of their length. Decimals are put
    together from halves instead, in little more than linear time; the limit of the process is neither met nor moved.

    >>> fraction_text(Fraction(-254, 19)), len(fraction_text(7**20_000))
    ('-254/19', 16902)
    """
    top, bottom = value.numerator, value.denominator
    return _digits(top) if bottom == 1 else f"{_digits(top)}/{_digits(bottom)}"


def read_fraction(text: str) -> Fraction:
    """The number that `fraction_text` wrote, of any size.

    >>> read_fraction("-254/19"), read_fraction(fraction_text(7**20_000)) == 7**20_000
    (Fraction(-254, 19), True)
    """
    top, _, bottom = text.partition("/")
    if max(len(top), len(bottom)) <= _SHORT:
        return Fraction(text)
    sign, top = (-1, top[1:]) if top.startswith("-") else (1, top)
    return coprime(sign * _integer(top), _integer(bottom or "1"))


def abridged_text(value: Fraction | int, most: int = 40) -> str:
    """All digits of a number up to `most` characters, above that their count.

    >>> abridged_text(Fraction(11, 10) ** 5), abridged_text(Fraction(11, 10) ** 5000)
    ('161051/100000', '(5207 digits)/(5001 digits)')
    """
    if is_short(value, most):
        return fraction_text(value)
    top, bottom = value.numerator, value.denominator
    return f"({count_digits(top)} digits)" + (f"/({count_digits(bottom)} digits)" if bottom != 1 else "")


def is_short(value: Fraction | int, most: int) -> bool:
    """True if all digits of a number take at most so many characters."""
    bits = value.numerator.bit_length() + value.denominator.bit_length()
    return bits < 4 * most + 8 and len(fraction_text(value)) <= most


def count_digits(number: int) -> int:
    """How many decimal digits an integer has, without writing it."""
    number = abs(number)
    if number < 10:
        return 1
    power = math.log10(number)
    nearest = round(power)
    if abs(power - nearest) > 1e-9:  # the logarithm is good to 1e-15 of numbers of a million digits
        return math.floor(power) + 1
    ten: int = 10**nearest
    return nearest + (number >= ten)


def _integer(digits: str) -> int:
    if len(digits) <= _SHORT:
        return int(digits)
    half = len(digits) // 2
    ten: int = 10**half
    return _integer(digits[:-half]) * ten + _integer(digits[-half:])


def _digits(number: int) -> str:
    if number.bit_length() <= _PLAIN:
        return str(number)
    with localcontext(Context(prec=MAX_PREC, Emax=MAX_EMAX, Emin=-MAX_EMAX, traps=[Inexact])):
        return ("-" if number < 0 else "") + str(_joined(abs(number), abs(number).bit_length(), {}))


def _joined(number: int, bits: int, powers: dict[int, Decimal]) -> Decimal:
    """An integer of so many bits as a decimal, from its halves."""
    if bits <= _PLAIN:
        return Decimal(number)
    half = bits >> 1
    if half not in powers:
        powers[half] = _power_of_two(half, powers)
    upper = _joined(number >> half, bits - half, powers)
    return upper * powers[half] + _joined(number & ((1 << half) - 1), half, powers)


def _power_of_two(exponent: int, powers: dict[int, Decimal]) -> Decimal:
    if exponent <= _PLAIN:
        return Decimal(1 << exponent)
    half = exponent >> 1
    root = powers.get(half) or _power_of_two(half, powers)
    return root * root * (1 << exponent % 2)


@dataclass(frozen=True, slots=True)
class Echelon:
    """What elimination leaves: pivots in the order taken, conditions on symbols alone, redundant rows.

    pivots      (column, rest): column = -(rest), rest free of all columns taken before it
    conditions  rows without unknowns: each must vanish
    redundant   indices of the rows that became 0 = 0
    """

    pivots: tuple[tuple[int, LinearForm], ...]
    conditions: tuple[LinearForm, ...]
    redundant: tuple[int, ...]

    @property
    def rank(self) -> int:
        """Number of independent rows in the unknowns."""
        return len(self.pivots)

    def forms(self, budget: int | None = None) -> dict[int, LinearForm]:
        """Every pivot column as a linear form of symbols and unknowns that stayed free.

        Many free unknowns make long forms: past `budget` operations `TooDenseError` is raised.
        """
        solved: dict[int, LinearForm] = {}
        work = 0
        for column, rest in reversed(self.pivots):
            form: LinearForm = {}
            for other, coefficient in rest.items():
                known = solved.get(other)
                if known is None:
                    add_into(form, {other: -coefficient}, 1)
                else:
                    add_into(form, known, -coefficient)
                    work += len(known) * (1 + coefficient.numerator.bit_length() // 64)
            if budget is not None and work > budget:
                raise TooDenseError
            solved[column] = form
        return solved


class TooDenseError(Exception):
    """Elimination passed its budget of operations; the caller has another way."""


def add_into(row: LinearForm, other: Mapping[int, Fraction], factor: Fraction | int) -> None:
    """row += factor * other, dropping the entries that cancel."""
    for column, coefficient in other.items():
        value = row.get(column, 0) + factor * coefficient
        if value:
            row[column] = value
        else:
            row.pop(column, None)


def eliminate(rows: Iterable[Mapping[int, Fraction]], budget: int | None = None, modulus: int = 0) -> Echelon:
    """Sparse elimination over the rationals (or modulo a prime): shortest row first, rarest column in it.

    rows      linear forms that vanish; columns < 0 are symbols
    budget    the most operations allowed, long numbers counting more; `TooDenseError` past it
    modulus   0 for exact rationals, else a prime; coefficients must then be integers

    Rows of one or two unknowns are plain substitutions, so chains, trees and cascades cost linear time;
    fill appears only where circuits are truly coupled.
    """
    active = {index: dict(row) for index, row in enumerate(rows)}
    users: dict[int, set[int]] = {}
    for index, row in active.items():
        for column in row:
            if column >= 0:
                users.setdefault(column, set()).add(index)
    queue = [(sum(column >= 0 for column in row), index) for index, row in active.items()]
    heapify(queue)
    pivots: list[tuple[int, LinearForm]] = []
    conditions: list[LinearForm] = []
    redundant: list[int] = []
    work = 0
    while queue:
        length, index = heappop(queue)
        row = active.get(index, {})
        unknowns = [column for column in row if column >= 0]
        if index not in active or len(unknowns) != length:
            continue
        del active[index]
        if not unknowns:
            if row:
                conditions.append(row)
            else:
                redundant.append(index)
            continue
        pivot = min(unknowns, key=lambda column: (len(users[column]), column))
        lead = row.pop(pivot)
        if modulus:
            inverse = pow(int(lead), -1, modulus)
            rest: LinearForm = {column: value * inverse % modulus for column, value in row.items()}
        else:
            rest = {column: value / lead for column, value in row.items()}
        pivots.append((pivot, rest))
        cost = (len(rest) + 1) * (1 + lead.numerator.bit_length() // 64)
        for column in unknowns:
            users[column].discard(index)
        for other in users.pop(pivot):
            target = active[other]
            factor = target.pop(pivot)
            work += cost
            for column, value in rest.items():
                new = target.get(column, 0) - factor * value
                if modulus:
                    new %= modulus
                if new:
                    if column >= 0 and column not in target:
                        users[column].add(other)
                    target[column] = new
                elif column in target:
                    del target[column]
                    if column >= 0:
                        users[column].discard(other)
            heappush(queue, (sum(column >= 0 for column in target), other))
            if budget is not None and work > budget:
                raise TooDenseError
    return Echelon(tuple(pivots), tuple(conditions), tuple(redundant))


def residues(row: Mapping[int, Fraction], modulus: int = PRIME) -> LinearForm:
    """A multiple of a rational row, in integers modulo a prime."""
    scale = math.lcm(*(value.denominator for value in row.values()))
    return {c: residue for c, value in row.items() if (residue := int(value * scale) % modulus)}  # type: ignore[misc]


def rank_modulo(rows: Iterable[Mapping[int, Fraction]], modulus: int = PRIME) -> int:
    """Rank of rational rows modulo a prime: never more than the true rank, and equal but for accidents."""
    return eliminate((residues(row, modulus) for row in rows), modulus=modulus).rank


def feasible(forms: Sequence[Mapping[int, Fraction]], constant: int = -1) -> bool:
    """True if some numbers for the unknowns make every linear form 0 or more: the simplex method, its first phase.

    forms      columns >= 0 are unknowns of either sign, `constant` is the column of what is added

    Bland's rule, by which the entering and the leaving variable are those of the least number, cannot cycle.
    """
    unknowns = sorted({column for form in forms for column in form if column != constant})
    # an unknown is the difference of two variables that are not negative
    place = {column: 2 * at for at, column in enumerate(unknowns)}
    table: list[list[Fraction]] = []
    basis: list[int] = []
    first_slack = 2 * len(unknowns)
    artificial = first_slack + len(forms)
    for at, form in enumerate(forms):
        row = [Fraction(0)] * (artificial + 1)
        for column, value in form.items():
            if column != constant:
                row[place[column]], row[place[column] + 1] = value, -value
        row[first_slack + at] = Fraction(-1)
        row[-1] = -form.get(constant, Fraction(0))
        met = row[-1] <= 0  # where all unknowns are 0
        table.append([-value for value in row] if met else row)
        basis.append(first_slack + at if met else artificial + at)
    return _reaches_zero(table, basis, artificial)


def _reaches_zero(table: list[list[Fraction]], basis: list[int], artificial: int) -> bool:
    """Whether the variables from `artificial` on, in the basis only, can all be made 0."""
    while True:
        lacking = [row for row, own in zip(table, basis, strict=True) if own >= artificial]
        if not any(row[-1] for row in lacking):
            return True
        enter = next((at for at in range(artificial) if sum(row[at] for row in lacking) > 0), None)
        if enter is None:
            return False
        ratios = [(row[-1] / row[enter], own, at) for at, (row, own) in enumerate(zip(table, basis, strict=True))
                  if row[enter] > 0]  # fmt: skip
        _, _, leave = min(ratios)
        lead = table[leave][enter]
        pivot = table[leave] = [value / lead for value in table[leave]]
        basis[leave] = enter
        for at, row in enumerate(table):
            if at != leave and row[enter]:
                factor = row[enter]
                table[at] = [value - factor * other for value, other in zip(row, pivot, strict=True)]
