"""What the sky does while a train turns: dates of turns of the lead, and what pointers should show, in mean motion."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.kinematics.judged_outputs import goal_of
from geartrain.numerics.exact import fraction_text
from geartrain.scene.context import SceneContext
from geartrain.scene.train_scene import PointerTarget, SceneEpoch

if TYPE_CHECKING:
    from geartrain.train import Output


def find_epoch(stage: SceneContext) -> SceneEpoch | None:
    """The declared date as turns of the lead; None where none is declared, or nothing is driven."""
    declared = stage.train.declaration
    epoch, unit = declared.epoch, declared.unit_days
    if epoch is None or unit is None or stage.lead is None:
        return None
    return SceneEpoch(
        julian_day=fraction_text(epoch.julian_day),
        turns=fraction_text(epoch.turns.value),
        days=fraction_text(unit / stage.step),
        calendar=epoch.calendar,
        source=epoch.source or "",
        note=epoch.note or "",
    )


def find_targets(stage: SceneContext, output: Output, speed: Fraction | None) -> tuple[PointerTarget, ...]:
    """What an output should show for each turn of the lead.

    speed   its own, in the train's unit; a target without a sense is met by either, and takes that of the output
    """
    if stage.lead is None or speed is None:
        return ()
    lead = stage.case.inputs[stage.lead]
    found = []
    for target in output.targets:
        goal = goal_of(stage.train.declaration, target)
        wanted = -goal.speed if not goal.signed and speed < 0 else goal.speed
        found.append(PointerTarget(goal.label, fraction_text(wanted / lead), target.source or ""))
    return tuple(found)
