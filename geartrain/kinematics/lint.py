"""Remarks on a sound declaration: conventions and means that its answers rest on, notes and never errors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.errors import Problem
from geartrain.kinematics.circuits import Circuit
from geartrain.train import GearPair, Train


def lint_train(train: Train, circuits: Sequence[Circuit]) -> Iterator[Problem]:
    """Pairs whose sense is a convention, for nothing declared fixes it, and pairs whose drive is intermittent."""
    at = {gear.name: position for position, gear in enumerate(train.gears)}
    for circuit in circuits:
        if circuit.note:
            yield Problem(f"'{circuit.id}': {circuit.note}", "", "", train.place("gears", at[circuit.id]))
    for position, gear in enumerate(train.gears):
        yield from (_intermittent(train, wheel, position) for wheel in gear.pair if _is_finger(train, gear, wheel))


def _is_finger(train: Train, gear: GearPair, name: str) -> bool:
    """True of a spur wheel of one tooth, but for helical teeth, which overlap, and for a form that shapes the tooth."""
    wheel = train.wheels[name][1]
    return wheel.count == 1 and wheel.kind == "spur" and wheel.helix_angle is None and train.form_of(gear) is None


def _intermittent(train: Train, wheel: str, position: int) -> Problem:
    what = f"wheel '{wheel}' has one tooth, which cannot drive continuously"
    why = "the mean ratio is exact; the motion is intermittent"
    return Problem(what, why, "", train.place("gears", position))
