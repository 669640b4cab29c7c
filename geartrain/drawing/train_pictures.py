"""All pictures of a train by kind."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Literal, get_args

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.drawing.backend import Figure

PictureKind = Literal["plan", "stick", "graph", "lever", "dials"]
KINDS: tuple[PictureKind, ...] = get_args(PictureKind)


def picture(
    train: GearTrain,
    kind: PictureKind,
    state: str | None = None,
    turns: Fraction = Fraction(0),
    labels: bool = True,
    outputs: Sequence[str] = (),
) -> Figure:
    """A picture of a train: plan, stick, graph, lever or dials.

    state     by default the first; of lever, all
    turns     of the input since the pose where all angles are zero (plan, dials)
    labels    names and numbers beside what is drawn
    outputs   those to be drawn, by default all (dials)
    Raises `QuestionError` for a kind that does not fit the train, and for states and outputs it does not have.
    """
    if kind == "graph":
        from geartrain.drawing.kinematic_graph import graph_figure

        return graph_figure(train, state, labels)
    if kind == "lever":
        from geartrain.drawing.lever_diagram import lever_figure

        return lever_figure(train, state, labels)
    if kind == "stick":
        from geartrain.drawing.stick_diagram import stick_figure

        return stick_figure(train, labels)
    if kind not in KINDS:
        raise QuestionError(Problem(f"no kind of picture '{kind}'", "it is not known", f"use {', '.join(KINDS)}"))
    from geartrain.scene import make_scene

    scene = make_scene(train, state)
    if kind == "plan":
        from geartrain.drawing.plan_view import plan_figure

        return plan_figure(scene, turns, labels)
    from geartrain.drawing.dial_faces import dials_figure

    return dials_figure(scene, turns, outputs, labels)
