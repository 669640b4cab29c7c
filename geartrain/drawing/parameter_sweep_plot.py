"""What becomes of a pair as one or two of its parameters change."""

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
    "tau": "speed ratio,\nleast and greatest",
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
_STANDS = "dwell"  # a fault with which the pair still turns
_KNOWN = {  # ways of running: series and how strong its veil is, so that in print no two are like grey
    "approach": (0, 0.08),
    "recess": (1, 0.27),
    "astride": (2, 0.34),
    "approach+recess": (4, 0.24),
}
_VEIL = 0.2  # of other ways
_CUT = 0.8  # points: the line between two bands
_NAMES = {  # of parameters, and the unit of one that has none of its own
    "z1": ("teeth of wheel 1", ""),
    "z2": ("teeth of wheel 2", ""),
    "clearance_factor": ("clearance factor", ""),
    "excess": ("clearance factor less 1", ""),
    "backlash": ("backlash", "modules"),
    "centre_distance": ("centre distance", "modules"),
    "radii": ("R2/R1 over z2/z1", ""),
}
_FEW = 60  # samples that are marked each
_MANY = 2500  # cells of a map from which it is drawn as pixels in a vector file
_REGION = 0.01  # of a map: a lesser region is not named


def sweep_figure(
    parameters: Mapping[str, NDArray[Any]],
    columns: Mapping[str, NDArray[Any]],
    verdicts: NDArray[np.str_],
    title: str = "",
    units: Mapping[str, str] | None = None,
) -> Figure:
    """Results of a sweep over one or two parameters of a pair with triangular teeth; NaN is left out.

    One parameter: panels of mean efficiency, transmission error and speed ratios over it, before bands for the
    verdicts. Two: a map of the mean efficiency, blank where the pair does not turn, with the faults hatched. The scale
    follows the pairs that run.

    Parameters
    ----------
    parameters : mapping of str to array
        One or two: name, which stands at the axis in words, and values, of shape (n,) or, as grids with each parameter
        constant along one axis, (n, m).
    columns : mapping of str to array
        Results of the same shape: of these `efficiency_mean`, `error_pp_deg` [deg] and `tau_min` with `tau_max` are
        shown, or else all.
    verdicts : array of str
        Of the same shape: "jam", "clash", "standstill", "overhang", "no valley", "apart" or "none" of a pair that does
        not run; of one that runs any text, such as its phases.
    title : str
        What is swept, written over all.
    units : mapping of str to str, optional
        Of parameters whose values are in a unit, that unit.

    Returns
    -------
    matplotlib.figure.Figure
        Panels, or a map.

    Raises
    ------
    QuestionError
        For arrays of different shapes, and for nothing to draw.

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
        raise QuestionError(
            Problem(
                f"no sweep to draw: {len(places)} parameters, {len(values)} columns, arrays of shapes {sorted(shapes)}",
                fix="give one parameter and arrays (n,), or two and grids (n, m), and at least one column",
            )
        )
    units = units or {}
    places = {parameter_label(name, units.get(name, "")): column for name, column in places.items()}
    figure = _lines(places, values, verdicts) if len(places) == 1 else _map(places, values, verdicts)
    if title:
        headed(figure, title)
    return figure


def parameter_label(name: str, unit: str = "") -> str:
    """What stands at the axis of a parameter that is given in some unit.

    Examples
    --------
    >>> parameter_label("half_angle", "deg"), parameter_label("backlash"), parameter_label("z2")
    ('half angle (deg)', 'backlash (modules)', 'teeth of wheel 2')
    """
    unit = unit or _NAMES.get(name, ("", ""))[1]
    return f"{parameter_name(name)} ({unit})" if unit else parameter_name(name)


def parameter_name(name: str) -> str:
    """A parameter of triangular teeth in words."""
    return _NAMES[name][0] if name in _NAMES else name.replace("_", " ")


def _running(verdicts: Texts) -> list[str]:
    """The verdicts on pairs that run, in order of appearance."""
    return [kind for kind in dict.fromkeys(verdicts.ravel().tolist()) if kind not in _FAULTS]


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
                axes.axvline(low, color=GREY, linewidth=_CUT)
        _curves(axes, x, {label: values[order] for label, values in curves.items()}, verdicts)
        name_axes(axes, y=_SHOWN.get(stem, stem))
    if x[-1] > x[0]:
        rows[-1].set_xlim(x[0], x[-1])
    name_axes(rows[-1], name)
    legend_below(figure, 5, [Patch(**style, label=kind) for kind, style in styles.items()], "left")
    return figure


def _panels(columns: dict[str, Floats]) -> dict[str, dict[str, Floats]]:
    """The columns of each panel; the least and the greatest of one quantity share one."""
    found: dict[str, dict[str, Floats]] = {}
    for name, values in columns.items():
        stem, _, end = name.rpartition("_")
        paired = end in ("min", "max") and {f"{stem}_min", f"{stem}_max"} <= columns.keys()
        found.setdefault(stem if paired else name, {})[name] = values
    return {name: found[name] for name in _SHOWN if name in found} or found


def _curves(axes: Axes, x: Floats, curves: dict[str, Floats], verdicts: Texts) -> None:
    marker = "o" if len(x) <= _FEW else ""
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
    """The look of each verdict's band: coloured where the pair runs, grey and hatched where not."""
    others = count(1 + max(series for series, _ in _KNOWN.values()))
    styles: dict[str, dict[str, Any]] = {}
    for kind in dict.fromkeys(verdicts.tolist()):
        if kind in _FAULTS:
            styles[kind] = {"facecolor": (PALE, 0.35), "edgecolor": (GREY, 0.6), "hatch": _FAULTS[kind], "linewidth": 0}
        else:
            series, veil = _KNOWN[kind] if kind in _KNOWN else (next(others), _VEIL)
            styles[kind] = {"facecolor": (series_colour(series), veil), "edgecolor": "none", "linewidth": 0}
    return styles


def _bands(x: Floats, verdicts: Texts) -> Iterator[tuple[float, float, str]]:
    """Stretches of one verdict, cut half way between samples."""
    edges = np.concatenate((x[:1], (x[1:] + x[:-1]) / 2, x[-1:]))
    changes = (np.flatnonzero(verdicts[1:] != verdicts[:-1]) + 1).tolist()
    for start, end in zip([0, *changes], [*changes, len(x)], strict=True):
        yield float(edges[start]), float(edges[end]), str(verdicts[start])


# ------------------------------------------------------------------------------------------------------ two parameters


def _map(parameters: dict[str, Floats], columns: dict[str, Floats], verdicts: Texts) -> Figure:
    (first, x), (second, y) = parameters.items()
    name = EFFICIENCY if EFFICIENCY in columns else next(iter(columns))
    x, y, values, verdicts = _sorted(x, y, columns[name], verdicts)
    stuck = np.isin(verdicts, [kind for kind in _FAULTS if kind != _STANDS])
    shown = np.ma.masked_invalid(np.where(stuck, np.nan, values))
    figure = Figure(figsize=(WIDTH, 7.0), layout="constrained")
    axes = figure.add_subplot()
    mesh = axes.pcolormesh(x, y, shown, shading="nearest", cmap=SCALE, rasterized=shown.size > _MANY, gid="map")
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
    """The grids with both parameters rising along their axes."""
    rows = np.argsort(x[:, 0] if x[0, 0] != x[-1, 0] else y[:, 0], kind="stable")
    cells = np.argsort(x[0] if x[0, 0] != x[0, -1] else y[0], kind="stable")
    at = np.ix_(rows, cells)
    return x[at], y[at], values[at], verdicts[at]


def _regions(axes: Axes, x: Floats, y: Floats, verdicts: Texts) -> None:
    """Faults hatched; the ways of running named and marked off from each other."""
    for kind, hatch in _FAULTS.items():
        if hatch and (verdicts == kind).any():
            here = (verdicts == kind).astype(float)
            area = axes.contourf(x, y, here, levels=[0.5, 1.5], colors="none", hatches=[hatch])
            area.set_edgecolor(GREY)
            area.set_linewidth(0.0)
    running = _running(verdicts)
    faulty = np.isin(verdicts, list(_FAULTS))
    for kind in running[1:]:
        bound = np.ma.masked_array((verdicts == kind).astype(float), faulty)
        axes.contour(x, y, bound, levels=[0.5], colors=BLACK, linewidths=1.6)
    for kind in running if len(running) > 1 else []:
        _name(axes, x, y, verdicts == kind, kind)
    axes.set_xlim(x.min(), x.max())
    axes.set_ylim(y.min(), y.max())


def _name(axes: Axes, x: Floats, y: Floats, here: NDArray[np.bool_], kind: str) -> None:
    """A region's name at that of its cells which is nearest to its middle."""
    rows, cells = np.nonzero(here)
    if len(rows) < _REGION * here.size:
        return
    at = np.argmin((rows - rows.mean()) ** 2 + (cells - cells.mean()) ** 2)
    place = float(x[rows[at], cells[at]]), float(y[rows[at], cells[at]])
    axes.annotate(kind, place, ha="center", va="center", fontsize=TEXT, color=BLACK, path_effects=HALO, gid="region")
