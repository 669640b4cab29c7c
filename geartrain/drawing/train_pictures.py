"""Selection of the picture of a train by its kind."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from fractions import Fraction
from html import escape
from typing import TYPE_CHECKING, Literal, get_args

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.drawing.style import Figure

_WIDTH, _MOST = 420, 34_000  # maximum width [pixels] and size [bytes] of a thumbnail

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
    """Return a figure of a train: plan to scale, stick diagram, kinematic graph, speed diagram or dials.

    Parameters
    ----------
    train : GearTrain
        Train to draw.
    kind : {"plan", "stick", "graph", "lever", "dials"}
        Kind of picture; "lever" is the speed diagram.
    state : str, optional
        Name of a state; by default the first state, or for "lever" all states.
    turns : Fraction
        Revolutions of the input from the pose in which all angles are 0; used by "plan" and "dials".
    labels : bool
        True to add names and numbers.
    outputs : sequence of str
        Outputs whose dials are drawn; by default all outputs. Used by "dials".

    Returns
    -------
    matplotlib.figure.Figure
        Figure for `render`, or for further drawing.

    Raises
    ------
    QuestionError
        If the kind does not apply to the train, or if a state or output does not exist.

    Examples
    --------
    >>> import geartrain
    >>> figure = picture(geartrain.load("planetary-24-18-60"), "lever")
    >>> figure.axes[0].texts[0].get_text()
    'planetary-24-18-60: A simple planetary, ring held'
    """
    if kind == "graph":
        from geartrain.drawing.kinematic_graph import graph_figure

        return graph_figure(train, state, labels)
    if kind == "lever":
        from geartrain.drawing.lever_diagram import lever_figure

        return lever_figure(train, state, labels)
    if kind == "stick":
        from geartrain.drawing.stick_diagram import stick_figure

        return stick_figure(train, labels, state)
    if kind not in KINDS:
        what, why = f"'{kind}' is not a kind of picture", f"the kinds are {', '.join(KINDS)}"
        raise QuestionError(Problem(what, why, "use one of these kinds"))
    from geartrain.scene import make_scene

    scene = make_scene(train, state)
    if kind == "plan":
        from geartrain.drawing.plan_view import plan_figure

        return plan_figure(scene, turns, labels)
    from geartrain.drawing.dial_faces import dials_figure

    return dials_figure(scene, turns, outputs, labels)


def thumbnail(train: GearTrain) -> str:
    """Return an HTML image for a notebook: a small plan of a train, or its stick diagram if it has no plan.

    Raise `MissingExtraError` if matplotlib is not installed, and `QuestionError` if neither picture can be drawn.
    """
    from geartrain.drawing.style import render

    try:
        figure = picture(train, "plan", labels=False)
    except QuestionError:
        figure = picture(train, "stick", labels=False)
    inches, width = float(figure.get_size_inches()[0]), _WIDTH
    while len(data := render(figure, ".png", width / inches)) > _MOST:
        width = int(0.95 * width * (_MOST / len(data)) ** 0.5)  # the size grows about as the area
    name = escape(train.name, quote=True)
    return f'<img alt="plan of {name}" width="{width}" src="data:image/png;base64,{b64encode(data).decode()}"/>'
