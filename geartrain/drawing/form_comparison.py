"""Conjugate tooth forms side by side: flanks, paths of contact, and each cost along the path."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from math import degrees, inf, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.backend import Axes, Figure, Line2D
from geartrain.drawing.style import BLACK, GREY, SMALL, TEXT, WIDTH, headed, plain
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import Dash, series_colour, series_dash

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

Styles = Mapping[str, tuple[str, Dash]]

_SAMPLES = 301  # of each side
_BESIDE = 1e-6  # of a side: nearer to the pitch point costs may be 0/0
_MOST = 3.0  # of the greatest value of a middling form: what exceeds it leaves its panel
_SPIKE = 6.0  # of what nine tenths of a curve stay below: a spike of teeth with a fault leaves its panel
_FLAT = 0.8  # of the greatest value: where the least is above it, a panel does not begin at 0
_STRAIGHT = 0.1  # modules: the least that a panel shows across
_AWAY = 0.1  # of a pitch: infinite costs are followed up to what they are this far from the pitch point


def shapes_figure(paths: Mapping[str, PathOfContact]) -> Figure:
    """Tooth forms of one pair side by side: flanks, path of contact, stress, heat, flash, sliding and loss.

    Parameters
    ----------
    paths : mapping of str to PathOfContact
        The path of contact of each form (docs/shapes.md, equation 1), by its name.

    Returns
    -------
    matplotlib.figure.Figure
        Eight panels; lengths in modules, costs as in docs/shapes.md.

    Raises
    ------
    QuestionError
        Where there is none to draw.

    Examples
    --------
    >>> import geartrain
    >>> law = geartrain.load("planetary-24-18-60-involute").meshes[0].law
    >>> len(shapes_figure({"involute": law.path}).axes)
    8
    """
    if not paths:
        raise QuestionError(Problem("no form can be drawn", "none of them can run", "change the arcs or the teeth"))
    figure = Figure(figsize=(WIDTH, 13.0), layout="constrained")
    panels = figure.subplots(4, 2)
    for axes in panels.flat:
        plain(axes)
    pitch = next(iter(paths.values())).pitch
    unit = pitch.p / pi
    styles = {name: (series_colour(at), series_dash(at)) for at, name in enumerate(paths)}
    for name, path in paths.items():
        X = _places(path)
        _line(panels[0, 0], name, styles, _flat(path.flank1(X)) / unit)
        _line(panels[0, 1], name, styles, _flat(path.flank2(X)) / unit)
        contact = path.at(X)
        points = _flat(pitch.point(contact.d, contact.sin_psi, contact.cos_psi)) / unit
        _line(panels[1, 0], name, styles, points)
    for axes, text in zip(
        panels.flat,
        ("flank of gear 1, stretched", "flank of gear 2, stretched", "path of contact, stretched"),
        strict=False,
    ):
        _drawn(axes, text)
    for axes, (label, cost) in zip(panels.flat[3:], _costs(pitch, unit), strict=True):
        _along(axes, label, cost, paths, styles)
    beyond = "; curves that leave a panel go on beyond it" if any(map(_left, panels.flat[3:])) else ""
    headed(figure, f"{_form_text(paths)}, {_title(pitch)}{beyond}")
    if len(paths) == 1:
        return figure
    handles = [
        Line2D([], [], color=color, linestyle=dashes, linewidth=1.8, label=name.replace("_", " "))
        for name, (color, dashes) in styles.items()
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=SMALL, frameon=False, handlelength=4)
    return figure


def _form_text(paths: Mapping[str, PathOfContact]) -> str:
    only = next(iter(paths)).replace("_", " ")
    return f"{only} teeth" if len(paths) == 1 else "tooth forms side by side"


def _left(axes: Axes) -> bool:
    """True if a curve goes over the rim of its panel."""
    low, high = axes.get_ylim()
    drawn = [np.asarray(line.get_ydata(), dtype=float) for line in axes.lines if line.get_gid()]
    return any(bool(((y < low) | (y > high)).any()) for y in drawn)


def _title(pitch: PitchSurfaces) -> str:
    if pitch.bevel:
        return f"{pitch.z1} drives {pitch.z2}, axes at {degrees(pitch.R1 + pitch.R2):.6g}°"
    return f"{pitch.z1} drives {pitch.z2}{', a ring' if pitch.R2 < 0 else ''}"


def _places(path: PathOfContact) -> Floats:
    """X along the whole path, no sample on the pitch point itself."""
    approach, recess = path.arcs
    if min(approach, recess) < 0:
        return np.linspace(-approach, recess, _SAMPLES)
    steps = np.linspace(_BESIDE, 1.0, _SAMPLES)
    sides = [-approach * steps[::-1]] if approach else []
    return np.concatenate([*sides, *([recess * steps] if recess else [])])


def _flat(points: Floats) -> Floats:
    """x and y from the pitch point; on the sphere as seen from outside over it."""
    return points[..., :2]


def _line(axes: Axes, name: str, styles: Styles, points: Floats) -> None:
    color, dashes = styles[name]
    axes.plot(points[:, 0], points[:, 1], color=color, linestyle=dashes, linewidth=1.8, gid=name)


def _drawn(axes: Axes, text: str) -> None:
    """Not to scale: steep flanks would lie on each other."""
    axes.plot([0], [0], "+", color=BLACK, markersize=9, gid="pitch point")
    axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
    axes.set_title(text, fontsize=TEXT, loc="left", color=BLACK)
    low, high = axes.get_xlim()
    if high - low < _STRAIGHT:  # a radial flank, whose rounding would be drawn as a comb
        axes.set_xlim((low + high - _STRAIGHT) / 2, (low + high + _STRAIGHT) / 2)
    axes.locator_params(axis="x", nbins=5)  # numbers of three decimals need room
    axes.set_xlabel("along the pitch line (modules)", fontsize=SMALL)
    axes.set_ylabel("towards gear 2 (modules)", fontsize=SMALL)


# --------------------------------------------------------------------------------------------------------------- costs


def _costs(pitch: PitchSurfaces, unit: float) -> Iterator[tuple[str, Callable[[PathContact], Floats]]]:
    """Each cost with its label; lengths in modules, so that spur and bevel can be set side by side."""
    yield r"Hertz pressure $\sqrt{H}$", lambda c: np.sqrt(c.H * unit)
    yield "heat per area, hotter flank $Q$", lambda c: np.maximum(c.Q1, c.Q2)
    yield r"flash temperature $\Theta$", lambda c: c.flash * unit**0.25
    yield "sliding over pitch-line speed", lambda c: (pitch.A + pitch.B) * np.abs(pitch.S(c.d))
    yield r"power lost over $\mu\,(A+B)\,|X|$ times power", lambda c: c.rub / np.abs(c.X)


def _along(
    axes: Axes,
    label: str,
    cost: Callable[[PathContact], Floats],
    paths: Mapping[str, PathOfContact],
    styles: Styles,
) -> None:
    low, high, tops = inf, 0.0, []
    for name, path in paths.items():
        X = _places(path)
        pitches = X / path.pitch.p
        with np.errstate(invalid="ignore"):  # where a flank turns round there is no pressure to take the root of
            values = cost(path.at(X))
        _line(axes, name, styles, np.stack([pitches, values], axis=1))
        away = values[(np.abs(pitches) > _AWAY) & np.isfinite(values)]
        top = min(float(away.max(initial=0.0)), _SPIKE * float(np.quantile(away, 0.9))) if len(away) else 0.0
        low, high = min(low, float(away.min(initial=inf))), max(high, top)
        tops.append(top)
    high = min(high, _MOST * float(np.median(tops)))
    rim = max(0.1 * (high - low), 0.02 * high)
    axes.set_ylim(low - rim if low > _FLAT * high else 0.0, high + rim or 1.0)
    axes.axvline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
    axes.set_title(label, fontsize=TEXT, loc="left", color=BLACK)
    axes.set_xlabel("contact at X (pitches): approach, recess", fontsize=SMALL)
