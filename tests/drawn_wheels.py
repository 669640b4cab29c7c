"""Wheels with cutting errors as Monte Carlo trials draw them, and the verdicts on their pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.workshop import TrialPlan
from geartrain.workshop.monte_carlo.trial_block import (
    JAM,
    RandomStreams,
    draw_trial_wheels,
    judge_trial_pairs,
    trial_pointers,
)


def drawn_wheels(plan: TrialPlan, trials: int, seed: int = 1, first: int = 0) -> Any:
    """Return the wheels of some trials, from the trial `first` on."""
    return draw_trial_wheels(plan, RandomStreams(seed, first), trials)


def judged(drawn: Any) -> tuple[NDArray[np.bool_], Any]:
    """Return which pairs jam, by trial and pair, and their minimum backlash."""
    marks, backlash = judge_trial_pairs(drawn)
    return (marks & JAM) > 0, backlash


def pointer_errors(drawn: Any, trials: NDArray[Any], turns: Any) -> Any:
    """Return the errors of all pointers at turns of the input: output, trial, turn."""
    return trial_pointers(drawn, trials).errors(turns)
