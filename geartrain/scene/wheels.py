"""Wheels: where they stand, what is known of them, and one tooth of each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from geartrain.scene.result import Profile, Wheel
from geartrain.scene.stage import Stage

if TYPE_CHECKING:
    from geartrain.layout import WheelPlace
    from geartrain.train import Wheel as Declared


def find_wheels(
    stage: Stage, profiles: Mapping[str, Profile], turns: Mapping[str, float]
) -> tuple[tuple[Wheel, ...], tuple[Profile, ...]]:
    """All wheels in the order declared, and the tooth forms they share.

    profiles   tooth by wheel; turns, angle (rad) of its first tooth about the direction of its body
    """
    shared: dict[Profile, int] = {}
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
    stage: Stage,
    place: WheelPlace,
    link: str,
    wheel: Declared,
    profile: Profile,
    number: int,
    turn: float,
    circuits: list[str],
    loss: float | None,
) -> Wheel:
    radii = [place.radius * r for r, _ in profile.points]
    inner, outer = min(radii), max(radii)
    same = flip(stage, place)
    doubt = wheel.doubt
    return Wheel(
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
    )


def flip(stage: Stage, place: WheelPlace) -> int:
    """-1 where the declared axis of a wheel points against the reference direction of its parallels."""
    return 1 if stage.along(place.axis) == stage.reference(place.axis) else -1


def as_placed(stage: Stage, wheel: str) -> float:
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


def _losses(stage: Stage) -> dict[str, float]:
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
