"""How often a pair jams, over its clearance and the size of its errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.style import BLACK, ORANGE, SCALE, SMALL, TEXT, WIDTH, Axes, Figure, Line2D
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.numerics.arrays import Floats


LEVELS = (0.01, 0.1, 0.5)
_DASHES: tuple[Any, ...] = ((0, (1.2, 1.2)), (0, (5, 2)), "solid")
_TICKS = (0.0, 0.1, 0.5, 1.0)
_BOUND = 0.01  # of the bound, where its line is drawn


def jam_map_figure(
    clearances: ArrayLike,
    sizes: ArrayLike,
    chances: ArrayLike,
    bound: ArrayLike | None = None,
    axis_names: tuple[str, str] = ("clearance factor", "error of place (standard deviation, % of the pitch)"),
    title: str = "",
) -> Figure:
    """Probability of a jam as shade, with lines where it is 1, 10 and 50 percent.

    clearances  (n,), rising; `sizes` of the error (m,), rising
    chances     of a jam, 0 to 1, (n, m); NaN where there is no pair
    bound       that the chance cannot exceed, (n, m): drawn where it is 1 percent
    axis_names  of clearances and sizes

    Raises `QuestionError` for arrays that are no map.
    """
    x, y, table = (np.asarray(each, dtype=float) for each in (clearances, sizes, chances))
    limit = None if bound is None else np.asarray(bound, dtype=float)
    _check(x, y, table, limit)
    figure = Figure(figsize=(WIDTH, 6.4), dpi=100, layout="constrained")
    axes = figure.add_subplot()
    shown = np.ma.masked_invalid(table.T)
    mesh = axes.pcolormesh(x, y, shown, shading="gouraud", cmap=SCALE, vmin=0.0, vmax=1.0, rasterized=True)
    mesh.set_gid("map")
    bar = figure.colorbar(mesh, ax=axes, pad=0.02, ticks=_TICKS, format=lambda tick, _: f"{tick:.0%}")
    bar.set_label("probability of a jam", fontsize=TEXT)
    bar.ax.tick_params(labelsize=SMALL)
    handles = [_line(axes, x, y, shown, *each) for each in zip(LEVELS, _DASHES, strict=True)]
    if limit is not None:
        handles.append(_bound(axes, x, y, limit))
    figure.legend(handles=handles, loc="outside lower left", ncols=4, fontsize=SMALL, frameon=False, handlelength=4)
    axes.set_xlabel(axis_names[0], fontsize=TEXT)
    axes.set_ylabel(axis_names[1], fontsize=TEXT)
    axes.tick_params(labelsize=SMALL)
    if title:
        axes.set_title(title, fontsize=TEXT, loc="left", color=BLACK)
    return figure


def _line(axes: Axes, x: Floats, y: Floats, shown: Any, level: float, dashes: Any) -> Line2D:
    # chances go from 0 to 1 in few cells: between them the arc of the root runs straighter than they do
    contour = axes.contour(x, y, _straight(shown), levels=[_straight(level)], colors=BLACK, linewidths=2.0)
    contour.set_linestyle([dashes])
    contour.set_gid(f"{level:.0%}")
    return Line2D([], [], color=BLACK, linestyle=dashes, linewidth=2.0, label=f"{level:.0%}")


def _bound(axes: Axes, x: Floats, y: Floats, limit: Floats) -> Line2D:
    """Below this line the bound alone says that a jam is rare."""
    color = ORANGE
    # a bound of 0 has no logarithm; one that is far rarer than the line is as good
    rare = np.log10(np.clip(np.ma.masked_invalid(limit.T), 1e-9, 1.0))
    contour = axes.contour(x, y, rare, levels=[np.log10(_BOUND)], colors=color, linewidths=2.0)
    contour.set_linestyle(["dashdot"])
    contour.set_gid("bound")
    return Line2D([], [], color=color, linestyle="dashdot", linewidth=2.0, label=f"bound of {_BOUND:.0%}")


def _straight(chance: Any) -> Any:
    return np.arcsin(np.sqrt(chance))


def _check(x: Floats, y: Floats, table: Floats, limit: Floats | None) -> None:
    finite = table[np.isfinite(table)]
    rising = all(each.ndim == 1 and each.size > 1 and (np.diff(each) > 0).all() for each in (x, y))
    shaped = table.shape == (x.size, y.size) and (limit is None or limit.shape == table.shape)
    if not (rising and shaped and finite.size and finite.min() >= 0 and finite.max() <= 1):
        raise QuestionError(
            Problem(
                f"no map to draw: clearances {x.shape}, sizes {y.shape}, chances {table.shape}",
                "a map has two or more rising values on each side, and a chance from 0 to 1 for each two of them",
                "give arrays (n,), (m,) and (n, m)",
            )
        )
