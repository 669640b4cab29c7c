"""What stands in a scene: links with their axes and which of them bears which; every wheel, where it stands, what is
known of it, and one tooth of it, as it is cut or a likeness of one that has no flat outline.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import atan2, pi
from typing import TYPE_CHECKING

from geartrain.dynamics.train_teeth import STANDARD, TrainTeeth, find_train_teeth
from geartrain.dynamics.wheel_teeth import WheelTeeth
from geartrain.errors import Problem
from geartrain.scene import nominal_teeth as likeness
from geartrain.scene.context import SceneContext, exact, rounded
from geartrain.scene.elements import SceneBody, SceneWheel, ToothProfile
from geartrain.scene.strain_waves import bent_wheels

if TYPE_CHECKING:
    from geartrain.scene.layout import WheelPlace
    from geartrain.train import Wheel as Declared


def find_bodies(stage: SceneContext) -> tuple[SceneBody, ...]:
    """All links in the order declared."""
    return tuple(_body(stage, link) for link in stage.train.declaration.links)


def _body(stage: SceneContext, link: str) -> SceneBody:
    tree, train = stage.train.kinematics.tree, stage.train
    label = tree.axis(link) or ""
    place = stage.layout.axes.get(label)
    # coaxial links are parts of the link that bears their axis, however their joints were declared
    bearer = tree.top.get(link)
    speed = stage.speed(link)
    return SceneBody(
        id=link,
        parent=None if bearer is None else stage.body[bearer],
        axis=label,
        point=(0.0, 0.0, 0.0) if place is None else place.point,
        direction=stage.reference(label),
        sense=stage.sense(link),
        speed=exact(stage.ratio(link)),
        shown=stage.shown(speed),
        decimal=rounded(speed),
        start=stage.start(link),
        role=_role(stage, link),
        bookkeeping=link in train.kinematics.joint_sums,
        note=train.declaration.links[link].note or "",
    )


def _role(stage: SceneContext, link: str) -> str:
    if link == stage.train.declaration.frame:
        return "frame"
    return "carrier" if link in stage.train.kinematics.tree.top.values() else "arbor"


@dataclass(frozen=True, slots=True)
class ToothProfiles:
    """Teeth by wheel, names of forms by pair, and what could not be drawn."""

    profiles: Mapping[str, ToothProfile]
    forms: Mapping[str, str]
    notices: tuple[Problem, ...] = ()


def find_profiles(stage: SceneContext) -> ToothProfiles:
    """The tooth of every wheel, as it is cut where nothing is said of play; of others a likeness."""
    toothed = find_train_teeth(stage.train.mechanics, stage.layout.wheels)
    profiles = {wheel: _profile(stage, toothed, wheel) for wheel in stage.train.declaration.wheels}
    return ToothProfiles(profiles, {mesh.name: mesh.form for mesh in stage.meshes}, tuple(_notices(stage, toothed)))


def _profile(stage: SceneContext, toothed: TrainTeeth, wheel: str) -> ToothProfile:
    found = toothed.wheels.get(wheel) or toothed.likenesses.get(wheel)
    return _likeness(stage, toothed, wheel) if found is None else _section(found)


def _section(toothing: WheelTeeth) -> ToothProfile:
    return ToothProfile(toothing.form, toothing.section(), toothing.kind == "pins")


def _notices(stage: SceneContext, toothed: TrainTeeth) -> Iterator[Problem]:
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
    bent = {each.wheel for each in bent_wheels(stage.train, stage.layout)}
    for name, (_, own) in stage.train.declaration.wheels.items():
        if own.flexible and name not in bent:
            why = "no link carries its axis round within a ring of more teeth, and so no wave bends it"
            fix = "declare it as trains/engineering/strain-wave.yaml does"
            yield Problem(f"'{name}' is flexible, and drawn round", why, fix)


def _likeness(stage: SceneContext, toothed: TrainTeeth, name: str) -> ToothProfile:
    _, wheel = stage.train.declaration.wheels[name]
    place, z = stage.layout.wheels[name], wheel.count or 1
    if wheel.kind == "worm":
        return likeness.worm(z, _mate_module(stage, name) / place.radius)
    shaped = next((toothed.wheels[mate] for mate in _mates(stage, name) if mate in toothed.wheels), None)
    if place.cone and shaped is not None and shaped.form != STANDARD and shaped.pins is None:
        return likeness.crown(z, shaped.z, shaped.section())
    if place.cone:
        return likeness.bevel(z, place.cone)
    mates = [stage.train.declaration.wheels[mate][1] for mate in _mates(stage, name)]
    rooms = [likeness.room(z, mate.count or 1, wheel.internal or mate.internal) for mate in mates]
    return (likeness.ring if wheel.internal else likeness.spur)(z, *([min(rooms)] if rooms else []))


def _mate_module(stage: SceneContext, name: str) -> float:
    return stage.layout.wheels[next(_mates(stage, name), name)].module


def _mates(stage: SceneContext, name: str) -> Iterator[str]:
    """Wheels that a wheel meshes with."""
    for circuit in stage.train.circuits:
        if name in circuit.wheels:
            yield circuit.wheels[1 - circuit.wheels.index(name)]


def find_wheels(
    stage: SceneContext, profiles: Mapping[str, ToothProfile], turns: Mapping[str, float]
) -> tuple[tuple[SceneWheel, ...], tuple[ToothProfile, ...]]:
    """All wheels in the order declared, and the tooth forms they share.

    profiles   tooth by wheel; turns, angle (rad) of its first tooth about the direction of its body
    """
    shared: dict[ToothProfile, int] = {}
    circuits: dict[str, list[str]] = {}
    for circuit in stage.train.circuits:
        if circuit.kind == "gear":
            for each in circuit.wheels:
                circuits.setdefault(each, []).append(circuit.id)
    losses = _losses(stage)
    found = []
    for name, (link, wheel) in stage.train.declaration.wheels.items():
        profile = profiles[name]
        number = shared.setdefault(profile, len(shared))
        place = stage.layout.wheels[name]
        found.append(
            _wheel(stage, place, link, wheel, profile, number, turns[name], circuits.get(name, []), losses.get(name))
        )
    return tuple(found), tuple(shared)


def _wheel(
    stage: SceneContext,
    place: WheelPlace,
    link: str,
    wheel: Declared,
    profile: ToothProfile,
    number: int,
    turn: float,
    circuits: list[str],
    loss: float | None,
) -> SceneWheel:
    radii = [place.radius * r for r, _ in profile.points]
    inner, outer = min(radii), max(radii)
    same = flip(stage, place)
    doubt = wheel.doubt
    return SceneWheel(
        id=place.wheel,
        body=stage.body[link],
        teeth=wheel.count or 1,
        kind="ring" if wheel.internal else "pins" if profile.hole else wheel.kind,
        centre=place.centre,
        direction=stage.reference(place.axis),
        reference=place.reference,
        turn=turn,
        radius=place.radius,
        tip=inner if wheel.internal else outer,
        root=outer if wheel.internal else inner,
        module=place.module,
        thickness=place.thickness,
        cone=place.cone,
        facing=place.facing * same,
        profile=number,
        layer=place.layer,
        status=wheel.status or "",
        source=wheel.source or (doubt.source if doubt and doubt.source else "") or "",
        note=wheel.note or (doubt.note if doubt and doubt.note else "") or "",
        doubt=_doubt(wheel),
        circuits=tuple(circuits),
        loss=loss,
        helix=_helix(wheel, place),
    )


def _helix(wheel: Declared, place: WheelPlace) -> float:
    """Angle (rad) of its teeth from its axis, of a right hand above 0; of a worm's thread too."""
    if wheel.kind != "worm":
        return wheel.helix if wheel.is_helical else 0.0
    lead = pi * place.module * (wheel.count or 1)
    return (-1 if wheel.hand == "left" else 1) * atan2(2 * pi * place.radius, lead)


def flip(stage: SceneContext, place: WheelPlace) -> int:
    """-1 where the declared axis of a wheel points against the reference direction of its parallels."""
    return 1 if stage.along(place.axis) == stage.reference(place.axis) else -1


def as_placed(stage: SceneContext, wheel: str) -> float:
    """The turn of a wheel as the layout has it, about the reference direction."""
    place = stage.layout.wheels[wheel]
    return place.turn * flip(stage, place)


def _doubt(wheel: Declared) -> str:
    """What the evidence allows, in words; nothing for a sure count."""
    doubt = wheel.doubt
    if doubt is None:
        return ""
    if doubt.range is not None:
        return f"{doubt.range[0]} to {doubt.range[1]} teeth"
    return f"{', '.join(map(str, doubt.allowed[:-1]))} or {doubt.allowed[-1]} teeth"


def _losses(stage: SceneContext) -> dict[str, float]:
    """Part of the power put in that is lost at each wheel's meshes, half of a pair's at either wheel."""
    declared = stage.train.declaration
    if not stage.answer.verdict or not declared.is_loaded(stage.answer.state):
        return {}
    torques = stage.train.torques(stage.answer.state)
    power = torques.power_in if torques.verdict else 0
    if not power:
        return {}
    found: dict[str, float] = {}
    for gear in declared.gears:
        pair = torques.pairs.get(gear.name)
        if pair is not None and not pair.loose:
            for wheel in gear.pair:
                found[wheel] = found.get(wheel, 0.0) + float(pair.loss / power) / 2
    return found
