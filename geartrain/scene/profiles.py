"""One tooth of every wheel: as it is cut, or a likeness of one that has no flat outline."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from geartrain.errors import Problem
from geartrain.outlines import Toothed, Toothing, find_toothing
from geartrain.scene import likeness
from geartrain.scene.result import Profile
from geartrain.scene.stage import Stage


@dataclass(frozen=True, slots=True)
class Drawn:
    """Teeth by wheel, names of forms by pair, and what could not be drawn."""

    profiles: Mapping[str, Profile]
    forms: Mapping[str, str]
    notices: tuple[Problem, ...] = ()


def find_profiles(stage: Stage) -> Drawn:
    """The tooth of every wheel, as it is cut where nothing is said of play; of others a likeness."""
    toothed = find_toothing(stage.train, stage.layout.wheels, 0.0)
    profiles = {wheel: _profile(stage, toothed, wheel) for wheel in stage.train.declaration.wheels}
    return Drawn(profiles, {mesh.name: mesh.form for mesh in stage.meshes}, tuple(_notices(toothed)))


def _profile(stage: Stage, toothed: Toothed, wheel: str) -> Profile:
    found = toothed.wheels.get(wheel) or toothed.likenesses.get(wheel)
    return _likeness(stage, wheel) if found is None else _section(found)


def _section(toothing: Toothing) -> Profile:
    return Profile(toothing.form, toothing.section(), toothing.pins is not None)


def _notices(toothed: Toothed) -> Iterator[Problem]:
    """Why wheels that lie in a plane are drawn otherwise than they could be cut, each reason once."""
    told: dict[tuple[str, str, str, bool], list[str]] = {}
    for wheel, problems in toothed.problems.items():
        if wheel in toothed.flat:
            first = problems[0]
            told.setdefault((first.what, first.why, first.fix, wheel in toothed.likenesses), []).append(wheel)
    for (what, why, fix, of_first), wheels in told.items():
        names = " and ".join(f"'{wheel}'" for wheel in wheels)
        drawn = "drawn as their first pairs have them" if of_first else "drawn as a likeness"
        yield Problem(f"the teeth of {names} are {drawn}: {what}", why, fix)


def _likeness(stage: Stage, name: str) -> Profile:
    _, wheel = stage.train.declaration.wheels[name]
    place, z = stage.layout.wheels[name], wheel.count or 1
    if wheel.internal:
        return likeness.ring(z)
    if wheel.kind == "worm":
        return likeness.worm(z, _mate_module(stage, name) / place.radius)
    return likeness.bevel(z, place.cone) if place.cone else likeness.spur(z)


def _mate_module(stage: Stage, name: str) -> float:
    for circuit in stage.train.circuits:
        if name in circuit.wheels:
            return stage.layout.wheels[circuit.wheels[1 - circuit.wheels.index(name)]].module
    return stage.layout.wheels[name].module
