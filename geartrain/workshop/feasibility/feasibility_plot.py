"""Plot of feasibility trials: probability that the train turns, by accuracy of the cutting."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.style import BLUE, GREY, Figure, curve_panels, headed, name_axes, series_look
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.workshop.feasibility.feasibility_result import FeasibilityResult


def feasibility_figure(found: FeasibilityResult) -> Figure:
    """Draw the probability that a train turns over the accuracy of its cutting, with 95 % intervals.

    Parameters
    ----------
    found : FeasibilityResult
        Result with a curve, from `run_feasibility` with accuracies.

    Returns
    -------
    matplotlib.figure.Figure
        Figure with the standard deviation of the pitches in degrees as abscissa.

    Raises
    ------
    QuestionError
        If the result has no curve.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import find_feasibility_plan, run_feasibility
    >>> plan = find_feasibility_plan(geartrain.load("moon-triangular"), outputs=("moon",))
    >>> feasibility_figure(run_feasibility(plan, 8, accuracies=(0.05, 0.2))).axes[0].get_ylabel()
    'probability that the train turns'
    """
    if not found.curve:
        fix = "give accuracies: --accuracy 0.02:0.3:6"
        raise QuestionError(Problem("the curve of the accuracies was not computed", "the plot shows this curve", fix))
    x = np.array([step.accuracy for step in found.curve])
    low, high = np.array([step.turns.interval for step in found.curve]).T
    figure, (axes,) = curve_panels([3.6])
    axes.fill_between(x, low, high, color=BLUE, alpha=0.15, linewidth=0, gid="95 %")
    look = {**series_look(0), "linewidth": 1.6, "marker": "o", "markersize": 3.5}
    axes.plot(x, [step.turns.value for step in found.curve], gid="turns", **look)
    axes.axhline(0.5, color=GREY, linewidth=0.8)
    axes.set_ylim(-0.02, 1.02)
    name_axes(
        axes, "standard deviation of the pitches (deg); shaded: 95 % interval", "probability that the train turns"
    )
    return headed(figure, f"{found.trials.plan.name}: accuracy that is needed")
