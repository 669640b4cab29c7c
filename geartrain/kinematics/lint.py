"""Remarks on a sound declaration: conventions that its answers rest on, notes and never errors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.errors import Problem
from geartrain.kinematics.circuits import Circuit
from geartrain.train import Train


def lint_train(train: Train, circuits: Sequence[Circuit]) -> Iterator[Problem]:
    """Where the sense of a pair is a convention, for nothing declared fixes it."""
    at = {gear.name: position for position, gear in enumerate(train.gears)}
    for circuit in circuits:
        if circuit.note:
            yield Problem(f"'{circuit.id}': {circuit.note}", "", "", train.place("gears", at[circuit.id]))
