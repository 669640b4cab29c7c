"""Draw the picture of docs/budgets.md, with assumed teeth, friction and cutting errors."""

from __future__ import annotations

from pathlib import Path

import geartrain
from geartrain import GearTrain
from geartrain.drawing import render
from geartrain.workshop import BudgetQuestion, find_budget
from geartrain.workshop.budget.budget_report import budget_figure

PICTURE = Path(__file__).resolve().parents[1] / "images" / "budget.svg"
TRAIN = "freeth-2021"
ASSUMED = """
extends: freeth-2021
name: freeth-2021-assumed
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: 0.2
cutting: {pitch_deviation: {normal: 0.1 deg}}
"""
DRAG = "1 N mm"
"""Friction torque of the bearing of a pointer."""


def main() -> None:
    """Compute the budget and draw it."""
    text = "\n".join((ASSUMED, *bearings(geartrain.load(TRAIN))))
    question = BudgetQuestion(samples=10_000)
    PICTURE.write_bytes(render(budget_figure(find_budget(geartrain.load(text), question)), ".svg"))


def bearings(train: GearTrain) -> list[str]:
    """Return bearing friction for each pointer with a dial (each output if there is no dial) of an unloaded train."""
    declared = train.declaration
    if declared.drive is not None or any(declared.is_loaded(state) for state in train.states or (None,)):
        return []
    outputs = declared.outputs.items()
    dials = any(output.dial is not None for output in declared.outputs.values())
    shown = [output.of or name for name, output in outputs if output.dial is not None or not dials]
    links = ", ".join(f"{link}: {{bearing: {DRAG}}}" for link in dict.fromkeys(shown) if link in declared.links)
    return [f"links: {{{links}}}"] if links else []


if __name__ == "__main__":
    main()
