"""Motion of a train with the teeth of its wheels as they were measured, without random errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.workshop.monte_carlo.trial_block import RandomStreams, draw_trial_wheels
from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.workshop.cutting.declared_errors import ErrorSpecification


def measured_motion(
    train: GearTrain, state: str | None = None, outputs: Sequence[str] = (), without: Sequence[str] = ()
) -> Motion:
    """Return the motion of a train with the measured teeth, fixed errors and filing of its wheels.

    The arguments `state`, `outputs` and `without` are described in `GearTrain.motion`. Raises `QuestionError` if no
    wheel has measured teeth or fixed errors, and `RangeError` if a pair jams or disengages.
    """
    plan = find_trial_plan(train, (), outputs, state, without)
    # an eccentricity without a direction is random
    wheels = tuple(replace(each, errors=_fixed(each.errors, each.towards is not None)) for each in plan.wheels)
    pairs = tuple(replace(each, fitting=_fixed(each.fitting)) for each in plan.pairs)
    drawn = draw_trial_wheels(replace(plan, wheels=wheels, pairs=pairs), RandomStreams(0, 0), 1)
    found = {}
    for at, pair in enumerate(pairs):
        if not pair.fitting and wheels[pair.first].true and wheels[pair.second].true:
            continue
        cut, good = drawn.pair(at), drawn.good[pair.first][0] and drawn.good[pair.second][0]
        events = pair.verdicts(cut)
        if events.jams[0] or events.disengaged[0] or not good:
            what = f"pair '{pair.name}' cannot turn with its teeth as measured"
            why = (
                "a wheel cannot be cut" if not good else "its teeth jam" if events.jams[0] else "its teeth lose contact"
            )
            fix = "change its clearance, or let it be filed: `fitting: {filing: {stroke: 1 %}}`"
            raise RangeError(Problem(what, why, fix))
        found[pair.name] = pair.transmission(cut, np.array(0))
    if not found:
        what = f"no wheel of '{train.name}' is measured"
        why = "a motion without random errors needs measured teeth or fixed errors"
        raise QuestionError(Problem(what, why, "declare `cutting: {measured: {csv: FILE}}` for a wheel"))
    return train.motion(state, outputs, without)._with_transmissions(found)


def _fixed(errors: Mapping[str, ErrorSpecification], directed: bool = True) -> dict[str, ErrorSpecification]:
    random = {"bearing"} if directed else {"bearing", "eccentricity"}
    return {kind: off for kind, off in errors.items() if off.way == "value" and kind not in random}
