"""Broad wheels: where two wheels share a mate and a place, each gets a shelf of its own, and the mate spans both."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from geartrain.numerics.graphs import DisjointSets

AxialSlots = tuple[int, int]
"""The lowest and the highest shelf that a wheel stands on."""

_TRIES = 20_000


def find_axial_slots(meshes: Sequence[tuple[str, str]], overlap: Callable[[str, str], bool]) -> dict[str, AxialSlots]:
    """Shelves of the wheels that need them, as few as can be; the others of their level are not named.

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
            found |= _Search(group, clashes).found()
    return found


def _groups(meshes: Sequence[tuple[str, str]]) -> list[list[tuple[str, str]]]:
    wheels: DisjointSets[str] = DisjointSets()
    for first, second in meshes:
        wheels.join(first, second)
    groups: dict[str, list[tuple[str, str]]] = {}
    for mesh in meshes:
        groups.setdefault(wheels.find(mesh[0]), []).append(mesh)
    return list(groups.values())


class _Search:
    """Each mesh on a shelf; a wheel spans those of its meshes, and no wheels that overlap share one."""

    def __init__(self, meshes: Sequence[tuple[str, str]], clashes: Mapping[str, Sequence[str]]) -> None:
        self.meshes, self.clashes = meshes, clashes
        self.tries = _TRIES

    def found(self) -> dict[str, AxialSlots]:
        """Shelves by wheel; none where it cannot be done, or not be found."""
        for count in range(2, len(self.meshes) + 1):
            spans = self._try(count)
            if spans is not None:
                return spans
        return {}

    def _try(self, count: int) -> dict[str, AxialSlots] | None:
        """Depth first over the meshes in order, so many shelves each; what a step changed is put back when it fails."""
        spans: dict[str, AxialSlots] = {}
        choice = [0]  # the shelf to try next, by mesh
        before: list[dict[str, AxialSlots | None]] = []
        while choice:
            at = len(choice) - 1
            if at == len(self.meshes):
                return spans
            shelf = choice[at]
            if shelf == count:
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
                low, high = spans.get(wheel, (shelf, shelf))
                spans[wheel] = min(low, shelf), max(high, shelf)
            if all(self._clear(wheel, spans) for wheel in mesh):
                before.append(was)
                choice.append(0)
            else:
                _put_back(spans, was)
        return None

    def _clear(self, wheel: str, spans: Mapping[str, AxialSlots]) -> bool:
        low, high = spans[wheel]
        others = (spans[other] for other in self.clashes.get(wheel, ()) if other in spans)
        return all(high < under or over < low for under, over in others)


def _put_back(spans: dict[str, AxialSlots], was: Mapping[str, AxialSlots | None]) -> None:
    for wheel, span in was.items():
        if span is None:
            spans.pop(wheel, None)
        else:
            spans[wheel] = span
