"""Speeds link by link: where two of a circuit's three links are known, the third follows.

This settles ordinary trains and every train whose links are driven one after another, in a time proportional to its
circuits and in plain integers. Where it gets stuck (a planetary set with its ring held needs two circuits at once) it
says nothing, and the coupled system is reduced and eliminated instead.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.factored_ratios import FactoredRatios
from geartrain.train import StateCase

Terms = tuple[tuple[int, int], ...]
"""A row: pairs of link index and integer coefficient whose sum of products with the speeds vanishes."""


class PropagatedSpeeds(Mapping[str, Fraction]):
    """Exact speeds by link, each multiplied out when it is read."""

    def __init__(self, index: Mapping[str, int], products: FactoredRatios, signs: Mapping[str, int]) -> None:
        self._index, self._products, self._signs = index, products, signs

    def __getitem__(self, link: str) -> Fraction:
        speed = self._products.value(self._index[link])
        return -speed if link in self._signs else speed

    def __iter__(self) -> Iterator[str]:
        return iter(self._index)

    def __len__(self) -> int:
        return len(self._index)

    def __contains__(self, link: object) -> bool:
        return link in self._index


@collector_paused()
def propagate(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], case: StateCase, signs: Mapping[str, int]
) -> PropagatedSpeeds | None:
    """Every link's exact speed, or None where walking does not reach all, or meets a contradiction.

    signs   -1 for links whose axis points against the reference direction of its parallels
    """
    index = {link: at for at, link in enumerate(links)}
    rows = _rows(index, frame, circuits, case)
    users: list[list[int]] = [[] for _ in links]
    for at, row in enumerate(rows):
        for link, _ in row:
            users[link].append(at)
    waiting = [len(row) for row in rows]
    speeds = FactoredRatios(len(links))
    bottom = speeds.bottom  # 0: not known yet
    speeds.set_root(index[frame], 0)
    known = []
    for name, speed in _prescribed(case, signs):
        at = index[name]
        if bottom[at]:
            return None  # prescribed twice, or the frame: whether that agrees is for the diagnosis
        speeds.set_root(at, speed.numerator, speed.denominator)
        known.append(at)
    for row in rows:
        if len(row) == 1 and not bottom[row[0][0]]:
            speeds.set_root(row[0][0], 0)  # alone in its row: it stands still
            known.append(row[0][0])
    used = bytearray(len(rows))
    for here in known:
        for at in users[here]:
            waiting[at] -= 1
            if waiting[at] == 1:
                target = _solve(rows[at], speeds)
                if target >= 0:
                    used[at] = 1
                    known.append(target)
            elif waiting[at] == 0 and not used[at] and not speeds.vanishes(rows[at]):
                return None
    if not all(bottom):
        return None
    return PropagatedSpeeds(index, speeds, signs)


def _rows(index: Mapping[str, int], frame: str, circuits: Sequence[Circuit], case: StateCase) -> list[Terms]:
    """All circuits and locks as rows over the moving links."""
    rows: list[Terms] = []
    for circuit in circuits:
        rows.append(tuple([(index[link], factor) for link, factor in circuit.terms if link != frame]))
    for first, second in case.locks:
        if first != second:
            rows.append(tuple([(index[link], factor) for link, factor in ((first, 1), (second, -1)) if link != frame]))
    return rows


def _prescribed(case: StateCase, signs: Mapping[str, int]) -> list[tuple[str, Fraction]]:
    given = [(link, Fraction(0)) for link in case.fixed]
    return given + [(link, speed * signs.get(link, 1)) for link, speed in case.inputs.items()]


def _solve(row: Terms, speeds: FactoredRatios) -> int:
    """Give the one unknown link of a row its speed, and say which it was; -1 if it got one in the meantime."""
    target, lead = -1, 0
    moving = []
    for link, coefficient in row:
        if not speeds.bottom[link]:
            target, lead = link, coefficient
        elif speeds.top[link]:
            moving.append((link, coefficient))
    if target < 0:
        return -1
    if len(moving) == 1:
        link, coefficient = moving[0]
        speeds.follow(target, link, -coefficient, lead)
        return target
    speed = -sum((speeds.value(link) * coefficient for link, coefficient in moving), Fraction(0)) / lead
    speeds.set_root(target, speed.numerator, speed.denominator)
    return target
