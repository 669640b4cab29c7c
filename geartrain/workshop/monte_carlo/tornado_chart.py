"""Which error matters most: bars, the longest on top."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from geartrain.drawing.style import BLACK, BLUE, GREY, SKY, SMALL, TEXT, WIDTH, Axes, Figure, Patch, plain
from geartrain.errors import Problem, QuestionError

MOST = 20
Interval = tuple[float, float]


@dataclass(frozen=True, slots=True)
class VarianceShare:
    """A part of the variance of a result that one cause brings.

    own        by itself, with its `own_within` interval or None
    whole      together with all it acts with, and its `whole_within`; None where causes only add
    """

    own: float
    own_within: Interval | None = None
    whole: float | None = None
    whole_within: Interval | None = None

    @property
    def rank(self) -> float:
        """By what the bars are sorted."""
        return self.own if self.whole is None else self.whole


def tornado_figure(shares: Mapping[str, VarianceShare], title: str = "", most: int = MOST) -> Figure:
    """A bar for each cause, sorted: what it brings alone, and with others; whiskers are intervals.

    Beyond `most` causes the least are not drawn, and a line says how many. Raises `QuestionError` where there is none.
    """
    if not shares or most < 1:
        raise QuestionError(Problem("no sensitivity to draw", "no cause is given", "give the share of one or more"))
    ranked = sorted(shares.items(), key=lambda each: -each[1].rank)
    shown, rest = ranked[:most], ranked[most:]
    figure = Figure(figsize=(WIDTH, 1.6 + 0.34 * len(shown)), dpi=100, layout="constrained")
    axes = figure.add_subplot()
    plain(axes)
    axes.grid(False, axis="y")
    both = any(share.whole is not None for _, share in shown)
    for at, (_, share) in enumerate(shown):
        if share.whole is not None:
            _bar(axes, at, share.whole, share.whole_within, {"color": SKY, "height": 0.72, "gid": "whole"}, 0.18)
        _bar(axes, at, share.own, share.own_within, {"color": BLUE, "height": 0.36, "gid": "own"}, -0.08)
    axes.set_yticks(range(len(shown)), [name for name, _ in shown])
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    axes.set_xlabel(f"share of the variance{_left_out(rest)}", fontsize=TEXT)
    axes.set_title(title, fontsize=TEXT, loc="left", color=BLACK)
    if both:
        handles = [Patch(color=BLUE, label="alone (first order)"), Patch(color=SKY, label="with others (total)")]
        axes.legend(handles=handles, loc="lower right", fontsize=SMALL, frameon=False)
    return figure


def _bar(axes: Axes, at: int, value: float, within: Interval | None, look: dict[str, Any], beside: float) -> None:
    axes.barh(at, value, **look)
    if within is not None:
        low, high = within
        axes.plot([low, high], [at + beside] * 2, color=BLACK, linewidth=1.2, marker="|", markersize=6, gid="within")


def _left_out(rest: list[tuple[str, VarianceShare]]) -> str:
    if not rest:
        return ""
    each = "one" if len(rest) == 1 else "each"
    return f"; {len(rest)} more, {each} {max(share.rank for _, share in rest):.2g} or less"
