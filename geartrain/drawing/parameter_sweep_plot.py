"""Plots of the results of a pair against one or two of its parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    GREY,
    HALO,
    PALE,
    SCALE,
    TEXT,
    WIDTH,
    Axes,
    Figure,
    Patch,
    colour_bar,
    curve_panels,
    headed,
    legend_below,
    name_axes,
)
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats

    Texts = NDArray[np.str_]

EFFICIENCY = "efficiency_mean"
_SHOWN = {
    EFFICIENCY: "mean efficiency",
    "error_pp_deg": "transmission error\npeak to peak (deg)",
    "tau": "speed ratio,\nminimum and maximum",
}
_FAULTS = {  # hatches of the verdicts on pairs that do not run
    "jam": "xx",
    "clash": "\\\\",
    "dwell": "//",
    "overhang": "++",
    "no valley": "..",
    "apart": "--",
    "none": "",
}
_STILL_TURNS = "dwell"  # the fault with which the pair still turns
_PHASE_STYLES = {  # phases of running pairs: series and opacity, chosen so that no two have the same grey in print
    "approach": (0, 0.08),
    "recess": (1, 0.27),
    "astride": (2, 0.34),
    "approach+recess": (4, 0.24),
}
_OPACITY = 0.2  # opacity of other phases
_BAND_EDGE = 0.8  # points: the line between two bands
_NAMES = {  # names of parameters, and default units
    "z1": ("teeth of wheel 1", ""),
    "z2": ("teeth of wheel 2", ""),
    "clearance_factor": ("clearance factor", ""),
    "excess": ("clearance factor minus 1", ""),
    "backlash": ("backlash", "modules"),
    "centre_distance": ("centre distance", "modules"),
    "radii": ("(R2/R1)/(z2/z1)", ""),
}
_MAX_MARKERS = 60  # maximum number of samples with markers
_MAX_CELLS = 2500  # cells of a map beyond which it is rasterized in a vector file
_MIN_SHARE = 0.01  # share of the map below which a region is not named


def sweep_figure(
    parameters: Mapping[str, NDArray[Any]],
    columns: Mapping[str, NDArray[Any]],
    verdicts: NDArray[np.str_],
    title: str = "",
    units: Mapping[str, str] | None = None,
) -> Figure:
    """Return a figure of the results of a sweep over one or two parameters of a pair with triangular teeth.

    For one parameter, panels show mean efficiency, transmission error and speed ratios against the parameter, with a
    background band for each verdict. For two parameters, a map shows the mean efficiency; the map is blank where the
    pair does not turn, and faults are hatched. Points with NaN values are omitted.

    Parameters
    ----------
    parameters : mapping of str to array
        Values of one or two parameters by name, which labels the axis: arrays of shape (n,), or grids (n, m) in which
        each parameter is constant along one axis.
    columns : mapping of str to array
        Results of the same shape. `efficiency_mean`, `error_pp_deg` [deg] and `tau_min` with `tau_max` are shown, or
        all columns if none of these is given.
    verdicts : array of str
        Verdicts of the same shape: "jam", "clash", "dwell", "overhang", "no valley", "apart" or "none" for a pair that
        does not run; any other string, such as the phases of the pair, for a pair that runs.
    title : str
        Title above the figure.
    units : mapping of str to str, optional
        Unit of each parameter that has one.

    Returns
    -------
    matplotlib.figure.Figure
        Figure with panels for one parameter, or a map for two.

    Raises
    ------
    QuestionError
        If arrays have different shapes or contain no data, or if there are not one or two parameters.

    Examples
    --------
    >>> import numpy as np
    >>> found = sweep_figure({"half_angle": np.array([20, 30])}, {"efficiency_mean": np.array([np.nan, 0.9])},
    ...     np.array(["jam", "runs"]), units={"half_angle": "deg"})
    >>> found.axes[-1].get_xlabel()
    'half angle (deg)'
    """
    verdicts = np.asarray(verdicts).astype(str)
    values = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    places = {name: np.asarray(column, dtype=float) for name, column in parameters.items()}
    shapes = {array.shape for array in (*values.values(), *places.values(), verdicts)}
    if len(shapes) > 1 or not 1 <= len(places) == verdicts.ndim <= 2 or not values or not verdicts.size:
        given = f"{len(places)} parameters and {len(values)} columns with arrays of shapes {sorted(shapes)}"
        why = "a sweep has one or two parameters, and arrays of one shape that are not empty"
        fix = "pass one parameter with arrays (n,), or two with grids (n, m), and at least one column"
        raise QuestionError(Problem(f"cannot draw a sweep of {given}", why, fix))
    labels = {}
    for name, column in places.items():
        unit = (units or {}).get(name, "") or _NAMES.get(name, ("", ""))[1]
        labels[f"{parameter_name(name)} ({unit})" if unit else parameter_name(name)] = column
    places = labels
    figure = _lines(places, values, verdicts) if len(places) == 1 else _map(places, values, verdicts)
    if title:
        headed(figure, title)
    return figure


def parameter_name(name: str) -> str:
    """Return the name, in words, of a parameter of triangular teeth."""
    return _NAMES[name][0] if name in _NAMES else name.replace("_", " ")


# ------------------------------------------------------------------------------------------------------ one parameter


def _lines(parameters: dict[str, Floats], columns: dict[str, Floats], verdicts: Texts) -> Figure:
    ((name, x),) = parameters.items()
    order = np.argsort(x, kind="stable")
    x, verdicts = x[order], verdicts[order]
    panels = _panels(columns)
    figure, rows = curve_panels([2.4] * len(panels), 1.2)
    styles = _band_styles(verdicts)
    for axes, (stem, curves) in zip(rows, panels.items(), strict=True):
        for low, high, kind in _bands(x, verdicts):
            axes.axvspan(low, high, **styles[kind], gid=f"band {kind}")
            if low > x[0]:
                axes.axvline(low, color=GREY, linewidth=_BAND_EDGE)
        _curves(axes, x, {label: values[order] for label, values in curves.items()}, verdicts)
        name_axes(axes, y=_SHOWN.get(stem, stem))
    if x[-1] > x[0]:
        rows[-1].set_xlim(x[0], x[-1])
    name_axes(rows[-1], name)
    legend_below(figure, 5, [Patch(**style, label=kind) for kind, style in styles.items()], "left")
    return figure


def _panels(columns: dict[str, Floats]) -> dict[str, dict[str, Floats]]:
    """Return the curves of each panel, by name of the panel: a column, or the minimum and maximum of one quantity.

    If no column has a default panel, all columns are included.
    """
    found: dict[str, dict[str, Floats]] = {}
    for name, values in columns.items():
        stem, _, end = name.rpartition("_")
        paired = end in ("min", "max") and {f"{stem}_min", f"{stem}_max"} <= columns.keys()
        found.setdefault(stem if paired else name, {})[name] = values
    return {name: found[name] for name in _SHOWN if name in found} or found


def _curves(axes: Axes, x: Floats, curves: dict[str, Floats], verdicts: Texts) -> None:
    marker = "o" if len(x) <= _MAX_MARKERS else ""
    for (name, values), color in zip(curves.items(), (BLACK, BLACK), strict=False):
        axes.plot(x, values, color=color, linewidth=1.8, marker=marker, markersize=3.5, clip_on=False, gid=name)
    if len(curves) == 2:
        low, high = curves.values()
        axes.fill_between(x, low, high, color=GREY, alpha=0.25, linewidth=0)
    runs = ~np.isin(verdicts, list(_FAULTS))
    seen = np.concatenate([values[runs & np.isfinite(values)] for values in curves.values()])
    if len(seen) and seen.max() > seen.min():
        rim = 0.3 * (seen.max() - seen.min())
        axes.set_ylim(seen.min() - rim, seen.max() + rim)


def _band_styles(verdicts: Texts) -> dict[str, dict[str, Any]]:
    """Return the style of the background band of each verdict, keyed by verdict: coloured if the pair runs, grey and
    hatched if it does not.
    """
    others = count(1 + max(series for series, _ in _PHASE_STYLES.values()))
    styles: dict[str, dict[str, Any]] = {}
    for kind in dict.fromkeys(verdicts.tolist()):
        if kind in _FAULTS:
            styles[kind] = {"facecolor": (PALE, 0.35), "edgecolor": (GREY, 0.6), "hatch": _FAULTS[kind], "linewidth": 0}
        else:
            series, veil = _PHASE_STYLES[kind] if kind in _PHASE_STYLES else (next(others), _OPACITY)
            styles[kind] = {"facecolor": (series_colour(series), veil), "edgecolor": "none", "linewidth": 0}
    return styles


def _bands(x: Floats, verdicts: Texts) -> Iterator[tuple[float, float, str]]:
    """Yield each interval of x with one verdict: its start and its end, halfway between samples, and the verdict."""
    edges = np.concatenate((x[:1], (x[1:] + x[:-1]) / 2, x[-1:]))
    changes = (np.flatnonzero(verdicts[1:] != verdicts[:-1]) + 1).tolist()
    for start, end in zip([0, *changes], [*changes, len(x)], strict=True):
        yield float(edges[start]), float(edges[end]), str(verdicts[start])


# ------------------------------------------------------------------------------------------------------ two parameters


def _map(parameters: dict[str, Floats], columns: dict[str, Floats], verdicts: Texts) -> Figure:
    (first, x), (second, y) = parameters.items()
    name = EFFICIENCY if EFFICIENCY in columns else next(iter(columns))
    x, y, values, verdicts = _sorted(x, y, columns[name], verdicts)
    stuck = np.isin(verdicts, [kind for kind in _FAULTS if kind != _STILL_TURNS])
    shown = np.ma.masked_invalid(np.where(stuck, np.nan, values))
    figure = Figure(figsize=(WIDTH, 7.0), layout="constrained")
    axes = figure.add_subplot()
    mesh = axes.pcolormesh(x, y, shown, shading="nearest", cmap=SCALE, rasterized=shown.size > _MAX_CELLS, gid="map")
    colour_bar(figure, axes, mesh, _SHOWN.get(name, name))
    name_axes(axes, first, second)
    if min(verdicts.shape) > 1:
        _regions(axes, x, y, verdicts)
    faults = [kind for kind in _FAULTS if (verdicts == kind).any()]
    handles = [Patch(facecolor="none", edgecolor=GREY, hatch=_FAULTS[kind], label=kind) for kind in faults]
    if handles:
        legend_below(figure, 7, handles, "left")
    return figure


def _sorted(x: Floats, y: Floats, values: Floats, verdicts: Texts) -> tuple[Floats, Floats, Floats, Texts]:
    """Return x, y, values and verdicts sorted so that each parameter increases along its axis of the grid."""
    rows = np.argsort(x[:, 0] if x[0, 0] != x[-1, 0] else y[:, 0], kind="stable")
    cells = np.argsort(x[0] if x[0, 0] != x[0, -1] else y[0], kind="stable")
    at = np.ix_(rows, cells)
    return x[at], y[at], values[at], verdicts[at]


def _regions(axes: Axes, x: Floats, y: Floats, verdicts: Texts) -> None:
    """Draw hatching in the regions of faults, and borders and names of several regions in which the pair runs."""
    for kind, hatch in _FAULTS.items():
        if hatch and (verdicts == kind).any():
            here = (verdicts == kind).astype(float)
            area = axes.contourf(x, y, here, levels=[0.5, 1.5], colors="none", hatches=[hatch])
            area.set_edgecolor(GREY)
            area.set_linewidth(0.0)
    running = [kind for kind in dict.fromkeys(verdicts.ravel().tolist()) if kind not in _FAULTS]
    faulty = np.isin(verdicts, list(_FAULTS))
    for kind in running[1:]:
        bound = np.ma.masked_array((verdicts == kind).astype(float), faulty)
        axes.contour(x, y, bound, levels=[0.5], colors=BLACK, linewidths=1.6)
    for kind in running if len(running) > 1 else []:
        _name(axes, x, y, verdicts == kind, kind)
    axes.set_xlim(x.min(), x.max())
    axes.set_ylim(y.min(), y.max())


def _name(axes: Axes, x: Floats, y: Floats, here: NDArray[np.bool_], kind: str) -> None:
    """Write the text `kind` at the centre of a region of a map (the mask `here`), if the region is large enough."""
    rows, cells = np.nonzero(here)
    if len(rows) < _MIN_SHARE * here.size:
        return
    at = np.argmin((rows - rows.mean()) ** 2 + (cells - cells.mean()) ** 2)
    place = float(x[rows[at], cells[at]]), float(y[rows[at], cells[at]])
    axes.annotate(kind, place, ha="center", va="center", fontsize=TEXT, color=BLACK, path_effects=HALO, gid="region")
