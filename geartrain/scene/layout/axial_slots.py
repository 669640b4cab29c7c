"""Broad wheels: two wheels that share a mate and would run into each other get slots of their own along its width.

Depth-first search with backtracking: each mesh is put into a slot; a wheel spans the slots of its meshes, and no two
wheels that overlap share one. As few slots as can be.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from geartrain.numerics.graphs import DisjointSets

_TRIES = 20_000  # slots that are tried for one group of wheels; then they stay in one level


class AxialSlots(NamedTuple):
    """The lowest and the highest slot that a wheel stands in."""

    low: int
    high: int


def find_axial_slots(meshes: Sequence[tuple[str, str]], overlap: Callable[[str, str], bool]) -> dict[str, AxialSlots]:
    """Slots of the wheels that need them; the others of their level are not named.

    meshes   pairs of wheels of parallel axes
    overlap  whether two wheels at one height would run into each other
    """
    found: dict[str, AxialSlots] = {}
    for group in _groups(meshes):
        wheels = list(dict.fromkeys(wheel for mesh in group for wheel in mesh))
        mates = {frozenset(mesh) for mesh in group}
        clashes: dict[str, list[str]] = {}
        for at, wheel in enumerate(wheels):
            for other in wheels[at + 1 :]:
                if frozenset((wheel, other)) not in mates and overlap(wheel, other):
                    clashes.setdefault(wheel, []).append(other)
                    clashes.setdefault(other, []).append(wheel)
        if clashes:
            found |= _SlotSearch(group, clashes).found()
    return found


def _groups(meshes: Sequence[tuple[str, str]]) -> list[list[tuple[str, str]]]:
    """Meshes by the wheels that are connected."""
    wheels: DisjointSets[str] = DisjointSets()
    for first, second in meshes:
        wheels.join(first, second)
    groups: dict[str, list[tuple[str, str]]] = {}
    for mesh in meshes:
        groups.setdefault(wheels.find(mesh[0]), []).append(mesh)
    return list(groups.values())


class _SlotSearch:
    """Slots of one group of wheels; `tries` are left."""

    def __init__(self, meshes: Sequence[tuple[str, str]], clashes: Mapping[str, Sequence[str]]) -> None:
        self.meshes, self.clashes = meshes, clashes
        self.tries = _TRIES

    def found(self) -> dict[str, AxialSlots]:
        """Slots by wheel; none where it cannot be done, or not be found."""
        for count in range(2, len(self.meshes) + 1):
            spans = self._try(count)
            if spans is not None:
                return spans
        return {}

    def _try(self, count: int) -> dict[str, AxialSlots] | None:
        """Depth first over the meshes in order, so many slots each; what a step changed is put back when it fails.

        A stack of its own, no recursion: a row of meshes may be longer than Python's.
        """
        spans: dict[str, AxialSlots] = {}
        choice = [0]  # the slot to try next, by mesh
        before: list[dict[str, AxialSlots | None]] = []
        while choice:
            at = len(choice) - 1
            if at == len(self.meshes):
                return spans
            slot = choice[at]
            if slot == count:
                choice.pop()
                if before:
                    _put_back(spans, before.pop())
                continue
            choice[at] += 1
            self.tries -= 1
            if self.tries < 0:
                return None
            mesh = self.meshes[at]
            was = {wheel: spans.get(wheel) for wheel in mesh}
            for wheel in mesh:
                low, high = spans.get(wheel, (slot, slot))
                spans[wheel] = AxialSlots(min(low, slot), max(high, slot))
            if all(self._is_clear(wheel, spans) for wheel in mesh):
                before.append(was)
                choice.append(0)
            else:
                _put_back(spans, was)
        return None

    def _is_clear(self, wheel: str, spans: Mapping[str, AxialSlots]) -> bool:
        own = spans[wheel]
        others = (spans[other] for other in self.clashes.get(wheel, ()) if other in spans)
        return all(own.high < other.low or other.high < own.low for other in others)


def _put_back(spans: dict[str, AxialSlots], was: Mapping[str, AxialSlots | None]) -> None:
    for wheel, span in was.items():
        if span is None:
            spans.pop(wheel, None)
        else:
            spans[wheel] = span
