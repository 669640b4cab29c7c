"""When two candidates are the same: altogether, but for the order of arbors on a path, or but for what drives what."""

from __future__ import annotations

from collections.abc import Iterator

from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor, PlacedWheel

_Wheel = tuple[str, int]
_Step = tuple[str, _Wheel, _Wheel]
"""An arbor on a path: its name, the wheel by which it is driven and the one by which the path goes on."""

_NONE: _Wheel = ("", 0)


def mechanism(arbor: Arbor) -> tuple[object, ...]:
    """All of a candidate, in whatever order its parts were found."""
    passed = tuple(sorted(map(mechanism, arbor.passes)))
    drives = tuple(sorted((_wheel(wheel), tuple(sorted(map(mechanism, below)))) for wheel, below in arbor.drives))
    return arbor.name or "", _wheel(arbor.driven), arbor.dials, drives, passed


def bag(arbor: Arbor) -> tuple[object, ...]:
    """For every dial, which arbors are on its path and through which wheels, without their order."""
    return tuple(sorted((dial, tuple(sorted(path))) for dial, path in _paths(arbor)))


def ratio_class(arbor: Arbor) -> tuple[object, ...]:
    """For every dial, which wheels drive and which are driven on its path."""
    return tuple(
        sorted(
            (dial, tuple(sorted(step[2] for step in path[:-1])), tuple(sorted(step[1] for step in path[1:])))
            for dial, path in _paths(arbor)
        )
    )


def _paths(arbor: Arbor, before: tuple[_Step, ...] = ()) -> Iterator[tuple[str, tuple[_Step, ...]]]:
    name, driven = arbor.name or "", _wheel(arbor.driven)
    for dial in arbor.dials:
        yield dial, (*before, (name, driven, _NONE))
    for child in arbor.passes:
        yield from _paths(child, (*before, (name, driven, driven)))
    for wheel, children in arbor.drives:
        for child in children:
            yield from _paths(child, (*before, (name, driven, _wheel(wheel))))


def _wheel(wheel: PlacedWheel | None) -> _Wheel:
    return _NONE if wheel is None else (wheel.name or "", wheel.teeth)
