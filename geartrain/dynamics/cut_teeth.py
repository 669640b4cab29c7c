"""Modules and cut tooth outlines of the wheels of a train, independent of a layout."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from geartrain.dynamics.train_teeth import TrainTeeth, find_disagreements, find_train_teeth
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.buildability import BuildFinding
from geartrain.train import Train

if TYPE_CHECKING:
    from geartrain.dynamics.train_mechanics import TrainMechanics


class _Place(NamedTuple):
    module: float
    cone: float


def find_modules(declared: Train) -> Mapping[str, float]:
    """Return transverse modules [m] by name of the wheel. A wheel without a declared module has the module of the
    wheels with which it meshes; wheels of unknown module are omitted.
    """
    found = {
        name: wheel.transverse_module
        for name, (_, wheel) in declared.wheels.items()
        if wheel.transverse_module is not None
    }
    mates: dict[str, list[str]] = {}
    for gear in declared.gears:
        for one, other in (gear.pair, gear.pair[::-1]):
            mates.setdefault(one, []).append(other)
    waiting = deque(found)
    while waiting:
        name = waiting.popleft()
        for mate in mates.get(name, ()):
            if mate not in found:
                # mates have equal normal modules; the transverse module grows with the helix angle
                found[mate] = found[name] * declared.wheels[mate][1].slant / declared.wheels[name][1].slant
                waiting.append(mate)
    return found


def find_cut_teeth(train: TrainMechanics) -> TrainTeeth:
    """Return the tooth outlines [modules] of all wheels whose teeth are straight and in one plane, and the reasons why
    other wheels have no outlines.

    The result has no outlines if a declared tooth form is invalid.
    """
    places = _places(train.declaration)
    try:
        return find_train_teeth(train, places)
    except GearTrainError as error:
        return TrainTeeth({}, dict.fromkeys(places, error.problems), {}, frozenset(), ())


def find_inconsistent_wheels(train: TrainMechanics) -> Iterator[BuildFinding]:
    """Yield a note for every wheel whose pairs require different teeth (rule W3 of docs/buildability.md)."""
    declared = train.declaration
    for name, problem in find_disagreements(train, _places(declared)).items():
        place = declared.place("links", declared.wheels[name][0], "wheels", name)
        yield BuildFinding("W3", "note", replace(not_cut(name, problem), place=place))


def not_cut(wheel: str, problem: Problem) -> Problem:
    """Return a copy of a problem with a description that names the wheel and states that its teeth are not cut."""
    return replace(problem, what=f"wheel '{wheel}' is not cut: {problem.what}")


def _places(declared: Train) -> Mapping[str, _Place]:
    """Return assumed dimensions of each wheel, by name: a module of 1 mm, and a cone angle of 0 for plane teeth or 1
    rad for all other teeth.
    """
    bevels = {name for name, (_, wheel) in declared.wheels.items() if wheel.kind == "bevel"}
    meshing = {name for gear in declared.gears if not bevels.isdisjoint(gear.pair) for name in gear.pair}
    return {
        name: _Place(1.0, float(name in meshing or wheel.kind != "spur"))
        for name, (_, wheel) in declared.wheels.items()
    }
