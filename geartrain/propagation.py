"""Speeds link by link: where two of a circuit's three links are known, the third follows.

This settles ordinary trains and every train whose links are driven one after another, in a time proportional to its
circuits and in plain integers. Where it gets stuck (a planetary set with its ring held needs two circuits at once) it
says nothing, and the coupled system is reduced and eliminated instead.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import gcd

from geartrain.bulk import collector_paused
from geartrain.circuits import Circuit
from geartrain.exact import coprime, times
from geartrain.train import Case

Terms = tuple[tuple[int, int], ...]
"""A row: pairs of link index and integer coefficient whose sum of products with the speeds vanishes."""


@collector_paused()
def propagate(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], case: Case, signs: Mapping[str, int]
) -> dict[str, Fraction] | None:
    """Every link's exact speed, or None where walking does not reach all, or meets a contradiction.

    signs   -1 for links whose axis points against the reference direction of its parallels
    """
    index = {link: at for at, link in enumerate(links)}
    rows = _rows(index, index[frame], circuits, case)
    users: list[list[int]] = [[] for _ in links]
    for at, row in enumerate(rows):
        for link, _ in row:
            users[link].append(at)
    waiting = [len(row) for row in rows]
    top, bottom = [0] * len(links), [0] * len(links)  # bottom 0: not known yet
    bottom[index[frame]] = 1
    known = []
    for name, speed in _prescribed(case, signs):
        at = index[name]
        if bottom[at]:
            return None  # prescribed twice, or the frame: whether that agrees is for the diagnosis
        top[at], bottom[at] = speed.numerator, speed.denominator
        known.append(at)
    for row in rows:
        if len(row) == 1 and not bottom[row[0][0]]:
            bottom[row[0][0]] = 1  # alone in its row: it stands still
            known.append(row[0][0])
    used = bytearray(len(rows))
    for here in known:
        for at in users[here]:
            waiting[at] -= 1
            if waiting[at] == 1:
                target = _solve(rows[at], top, bottom)
                if target >= 0:
                    used[at] = 1
                    known.append(target)
            elif waiting[at] == 0 and not used[at] and not _holds(rows[at], top, bottom):
                return None
    if not all(bottom):
        return None
    return {link: coprime(-top[at] if link in signs else top[at], bottom[at]) for at, link in enumerate(links)}


def _rows(index: Mapping[str, int], frame: int, circuits: Sequence[Circuit], case: Case) -> list[Terms]:
    """All circuits and locks as rows over the moving links."""
    rows: list[Terms] = []
    for _, _, i, j, k, a, b, _, _ in circuits:
        terms = ((index[i], a), (index[j], b), (index[k], -a - b))
        rows.append(tuple(term for term in terms if term[1] and term[0] != frame))
    for first, second in case.locks:
        if first != second:
            rows.append(tuple(term for term in ((index[first], 1), (index[second], -1)) if term[0] != frame))
    return rows


def _prescribed(case: Case, signs: Mapping[str, int]) -> list[tuple[str, Fraction]]:
    given = [(link, Fraction(0)) for link in case.fixed]
    return given + [(link, speed * signs.get(link, 1)) for link, speed in case.inputs.items()]


def _solve(row: Terms, top: list[int], bottom: list[int]) -> int:
    """Give the one unknown link of a row its speed, and say which it was; -1 if it got one in the meantime."""
    target, lead = -1, 0
    moving = []
    for link, coefficient in row:
        if not bottom[link]:
            target, lead = link, coefficient
        elif top[link]:
            moving.append((link, coefficient))
    if target < 0:
        return -1
    if len(moving) == 1:
        link, coefficient = moving[0]
        top[target], bottom[target] = times(top[link], bottom[link], -coefficient, lead)
        return target
    n, d = 0, 1
    for link, coefficient in moving:
        n, d = n * bottom[link] + coefficient * top[link] * d, d * bottom[link]
    d *= -lead
    common = gcd(n, d) if d > 0 else -gcd(n, d)
    top[target], bottom[target] = n // common, d // common
    return target


def _holds(row: Terms, top: list[int], bottom: list[int]) -> bool:
    """Whether a row with all speeds known vanishes, in integers."""
    n, d = 0, 1
    for link, coefficient in row:
        n = n * bottom[link] + coefficient * top[link] * d
        d *= bottom[link]
    return n == 0
