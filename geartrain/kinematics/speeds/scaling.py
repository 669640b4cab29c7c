"""Powers of two by which the speeds of a train that leaves float64 are near 1: its rows solved roughly.

The rows are eliminated as the exact ones are, in numbers of 53 bits whose exponent has no end. What comes out may be
wrong in any digit but its size; nothing is answered by it, and the scaled rows are solved and judged as any are.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import frexp, log2
from typing import Any

from geartrain.errors import Problem, RangeError
from geartrain.kinematics.willis_equation import WillisEquation
from geartrain.numerics.elimination import TooDenseError, eliminate
from geartrain.numerics.long_float import LongFloat, split

_GIVEN = -1  # the column of what is prescribed
_LOST = 44  # bits that a sum may lose before what is left of it is taken for the rounding of a 0
_BUDGET = 4_000_000  # operations of the elimination
_TOO_DENSE = Problem(
    "speeds leave the range of float64 in a train that is coupled too densely",
    "their sizes take too long to find",
    "use the exact method, or ask for one output",
)


@dataclass(frozen=True, slots=True, eq=False)
class _Rough(LongFloat):
    """A long float at any size, whose sums are 0 where next to nothing is left of their terms."""

    @classmethod
    def make(cls, mantissa: float, exponent: int) -> Any:
        part, power = frexp(mantissa)
        return cls(part, power + exponent)

    def __add__(self, other: Any) -> Any:
        total = LongFloat.__add__(self, other)
        if isinstance(other, _Rough) and other and self:
            most = max(self.exponent, other.exponent)
            if total.exponent < most - _LOST:
                return _Rough(0.0, 0)
        return total

    __radd__ = __add__


def find_exponents(rows: Sequence[WillisEquation], given: Sequence[Fraction], links: Sequence[str]) -> list[int]:
    """An exponent of two for each link, so that its speed over that power is near 1.

    given   right-hand side of each row

    Raises `RangeError` where the rows are too dense to be eliminated in a minute or so.
    """
    at = {link: column for column, link in enumerate(links)}
    lines = [{at[link]: c for link, c in row.terms if link in at} for row in rows]
    forms: Any = [
        {column: _Rough(*split(c)) for column, c in line.items()} | ({_GIVEN: _Rough(*split(-right))} if right else {})
        for line, right in zip(lines, given, strict=True)
    ]
    found: dict[int, float] = {}
    try:
        solved = eliminate(forms, _BUDGET).forms(_BUDGET)
    except TooDenseError:
        raise RangeError(_TOO_DENSE) from None
    for column, form in solved.items():
        speed: Any = form.get(_GIVEN)
        if speed and len(form) == 1:
            # in logarithms: the speed itself may be beyond float64
            found[column] = log2(abs(speed.mantissa)) + speed.exponent
    for line, right in zip(lines, given, strict=True):
        if len(line) == 1 and not right:  # held still
            found[next(iter(line))] = 0.0
    _spread(lines, found)
    # whole powers, so that scaling by them rounds nothing
    return [round(found.get(column, 0.0)) for column in range(len(links))]


def _spread(lines: Sequence[Mapping[int, int]], found: dict[int, float]) -> None:
    """Links that stand still have no size of their own: the least that a row with others gives them.

    In a row that turns faster its entry then sinks, and says nothing there that the row did not say without it.
    """
    users: dict[int, list[int]] = {}
    for row, line in enumerate(lines):
        for column in line:
            users.setdefault(column, []).append(row)
    queue = deque(column for line in lines if found.keys() & line for column in line if column not in found)
    while queue:
        column = queue.popleft()
        if column in found:
            continue
        sizes = [
            max(found[other] + log2(abs(lines[row][other])) for other in lines[row] if other in found)
            - log2(abs(lines[row][column]))
            for row in users[column]
            if found.keys() & lines[row].keys()
        ]
        found[column] = min(sizes)
        queue.extend(other for row in users[column] for other in lines[row] if other not in found)
