"""Wheels that mesh nothing."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding

if TYPE_CHECKING:
    from geartrain.train import Train


def check_mates(train: Train) -> Iterator[BuildFinding]:
    """Rule W1: a wheel is in a pair, or on a link with a pin or slot, or an escape wheel, or has a note that tells."""
    meshing = {wheel for gear in train.gears for wheel in gear.pair}
    coupled = {link for coupling in train.couplings for link in (coupling.pin, coupling.slot)}
    escapement = train.escapement
    for name, (link, wheel) in train.wheels.items():
        if name in meshing or link in coupled or wheel.note:
            continue
        if escapement is not None and escapement.has_wheel(link, wheel.count):
            continue
        problem = Problem(
            f"wheel '{name}' {wheel.count or ''}".rstrip() + " meshes nothing",
            "no pair under `gears` names it",
            "add its pair, say in its `note` what it is for, or take it away",
            train.place("links", link, "wheels", name),
        )
        yield BuildFinding("W1", "note", problem)
