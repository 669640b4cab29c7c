"""Bar charts of error budgets: a bar of stacked causes for each pointer, or for one pointer a bar for each cause."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.drawing.style import (
    BLACK,
    SMALL,
    WHITE,
    Axes,
    Figure,
    Patch,
    bar_panel,
    draw_interval,
    legend_below,
    name_axes,
    short,
)
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from geartrain.workshop.budget.pointer_budget import PointerBudget, TrainBudget

COLOURS = {cause: series_colour(at) for at, cause in enumerate(("ratio", "theory", "teeth", "lost motion", "cutting"))}
MOST = 8
"""Maximum number of pointers in a figure; pointers with the largest sum of causes are drawn."""
_HIGH, _LOW = 0.7, 0.42  # heights of bars relative to their distance: fully declared, and declared in part
_ON_A_BAR: dict[str, Any] = {
    "ha": "center",
    "va": "center",
    "fontsize": SMALL,
    "color": BLACK,
    "zorder": 8,
    "bbox": {"boxstyle": "round,pad=0.15", "facecolor": WHITE, "linewidth": 0},
}
_SIZED, _NAMED = 0.055, 0.2  # minimum shares of a bar for the size, and for size and name, to fit in it


def budget_figure(found: TrainBudget, most: int = MOST) -> Figure:
    """Draw a stacked bar for each pointer, with the contribution of each cause to its error. The pointer with the
    largest error is at the top.

    If there is only one pointer, the figure has a bar in degrees for each cause, with the largest at the top.

    Parameters
    ----------
    found : TrainBudget
        Result of `find_budget`.
    most : int
        Maximum number of pointers to draw. The axis label gives the number of omitted pointers.

    Returns
    -------
    matplotlib.figure.Figure
        Figure with shares of the sum, sizes [deg] in the bars, and the sum [deg] and missing causes next to the bars.
        For one pointer, sizes [deg] with their 95 % confidence intervals.

    Raises
    ------
    QuestionError
        If no cause of any pointer is known, or all known causes are 0.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.workshop import (BudgetQuestion, find_budget)
    >>> figure = budget_figure(find_budget(geartrain.load("freeth-2008"), BudgetQuestion(outputs=("moon", "saros"))))
    >>> [text.get_text() for text in figure.axes[0].get_yticklabels()]
    ['moon', 'saros']
    """
    ranked = sorted((each for each in found.pointers if each.total > 0), key=lambda each: -each.total)
    if not ranked:
        why = "no cause of any pointer's error is declared, or all are 0"
        what = f"the budget of '{found.name}' has nothing to draw"
        raise QuestionError(Problem(what, why, "declare targets of outputs, or `tooth_form` of pairs"))
    if len(found.pointers) == 1:
        return _causes(found, ranked[0])
    shown = ranked[:most]
    figure, axes = bar_panel([short(each.name, 24) for each in shown], 1.7 + 0.55 * len(shown), 11.0)
    for at, pointer in enumerate(shown):
        _bar(axes, at, pointer)
    axes.set_xlim(0.0, 1.0)
    axes.set_xlabel(_axis_note(len(found.pointers), len(shown), len(ranked)), fontsize=SMALL, loc="left")
    name_axes(axes, title=f"{_train_name(found)}: causes of each pointer's error")
    handles = [Patch(color=colour, label=_legend(cause, found)) for cause, colour in COLOURS.items()]
    legend_below(figure, 5, handles, columnspacing=1.2)
    return figure


def _train_name(found: TrainBudget) -> str:
    return found.name if found.state is None else f"{found.name}, {found.state}"


def _causes(found: TrainBudget, pointer: PointerBudget) -> Figure:
    """Draw one bar for each cause of one pointer's error, the largest at the top, and a row for each unknown cause."""
    ranked = [*pointer.ranked, *pointer.undeclared]
    figure, axes = bar_panel([cause.name for cause in ranked], 3.6)
    for at, cause in enumerate(ranked):
        size = cause.degrees or 0.0
        high = _LOW if cause.declared == "part" else _HIGH
        axes.barh(at, size, height=high, color=COLOURS[cause.name], edgecolor=WHITE, gid=cause.name)
        draw_interval(axes, at, cause.interval)
        _, most = cause.interval or (size, size)
        words = "not declared" if cause.degrees is None else f"{_size(size, 3)}°"
        words += ", declared in part" if cause.declared == "part" else ""
        axes.annotate(words, (max(size, most), at), xytext=(6, 0), textcoords="offset points", va="center",
                      fontsize=SMALL, color=BLACK, annotation_clip=False, gid="size")  # fmt: skip
    axes.set_xlim(left=0.0)
    title = f"{_train_name(found)}: causes of the error of {short(pointer.name, 24)}, sum {_size(pointer.total, 3)}°"
    name_axes(axes, "size (deg)", title=title, parse_math=False)
    return figure


def _legend(cause: str, found: TrainBudget) -> str:
    missing = found.not_declared[cause]
    return cause if not missing else f"{cause} (unknown for {missing})"


def _axis_note(pointers: int, shown: int, erring: int) -> str:
    words = "share of the sum of all declared causes; thin bars: declared in part"
    still = pointers - erring
    left = [f"pointers with smaller errors, not drawn: {erring - shown}"] if erring > shown else []
    left += [f"pointers without a known error: {still} of {pointers}"] if still else []
    return words + ("\n" + "; ".join(left) if left else "")


def _size(value: float, digits: int) -> str:
    """Return a value as a string with `digits` significant digits; large values as integers, without a power of ten."""
    return f"{value:.{digits}g}" if value < 10**digits else f"{value:.0f}"


def _bar(axes: Axes, at: int, pointer: PointerBudget) -> None:
    left = 0.0
    for cause in pointer.ranked:
        share = (cause.degrees or 0.0) / pointer.total
        if not share:
            continue
        high = _LOW if cause.declared == "part" else _HIGH
        axes.barh(
            at, share, left=left, height=high, color=COLOURS[cause.name], edgecolor=WHITE, gid=cause.name, clip_on=False
        )
        if share > _SIZED:
            name = f"{cause.name} " if share > _NAMED else ""
            axes.text(left + share / 2, at, f"{name}{_size(cause.degrees or 0.0, 2)}°", **_ON_A_BAR)
        left += share
    missing = ", ".join(cause.name for cause in pointer.undeclared)
    beside = f"sum {_size(pointer.total, 3)}°" + (f"\nnot declared: {missing}" if missing else "")
    axes.annotate(beside, (1.0, at), xytext=(6, 0), textcoords="offset points", va="center", fontsize=SMALL,
                  color=BLACK, annotation_clip=False, gid="sum")  # fmt: skip
