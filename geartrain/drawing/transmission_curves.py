"""Curves of a pair of wheels: transmission functions against the driver angle, and conjugate tooth forms side by side.

`triangular_figure` shows the ideal and the real path of triangular teeth, and `transmission_figure` any pair.
`shapes_figure` shows flanks, paths of contact, and stress, heat, sliding and losses along the path of conjugate forms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import pairwise
from math import degrees, inf, pi
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    GREY,
    SMALL,
    TEXT,
    WIDTH,
    Axes,
    Figure,
    Line2D,
    MaxNLocator,
    curve_panels,
    headed,
    legend_above,
    legend_below,
    name_axes,
    note,
    plain,
)
from geartrain.drawing.tooth_contact import PHASES, pair_text, require_contact, teeth_figure
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import Dash, series_colour, series_dash
from geartrain.teeth.rubbed_transmission import RubbedTransmission, pair_friction
from geartrain.teeth.triangular.real_path import DWELL
from geartrain.teeth.triangular.tooth_pair import APPROACH, RECESS
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.conjugate.path_of_contact import PathContact, PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.form_comparison import FormComparison
    from geartrain.teeth.friction_law import PairFriction
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.transmission import TransmissionFunction


_PERIOD_SAMPLES = 1601
_LOST = 1e-12  # relative to the power: smaller losses are rounding errors
_PERIOD_LABELS = ("transmission error\n(deg, driven)", "speed ratio\nover its mean", "efficiency")


def mesh_figure(mesh: GearMesh, alpha1: float | None = None) -> Figure:
    """Return a figure of flanks, path of contact and losses of a pair, or of its transmission function.

    alpha1   angle of the driving tooth from the line of centres [rad], at which triangular teeth are drawn in contact
    """
    if isinstance(mesh, TriangularMesh):
        if alpha1 is not None:
            return teeth_figure(mesh.transmission, alpha1)
        return triangular_figure(mesh.transmission, pair_friction(mesh.wheels))
    if mesh.path is not None:
        return shapes_figure({mesh.form: mesh.path})
    driver, driven = mesh.counts
    return transmission_figure(mesh.losses, f"{mesh.tooth_form.words} teeth, {driver} drives {driven}")


def comparison_figure(found: FormComparison) -> Figure:
    """Return a figure of flanks, paths of contact and losses of the compared tooth forms that can run."""
    return shapes_figure({form.name: form.path for form in found.forms if form.path and form.runs})


def transmission_figure(transmission: TransmissionFunction, title: str) -> Figure:
    """Return a figure of transmission error, speed ratio and efficiency of the drive flanks over two periods."""
    S = np.linspace(0, 2 * transmission.period, _PERIOD_SAMPLES)
    curves = (
        np.degrees(transmission.error(S)),
        transmission.speed(S) / float(transmission.ratio),
        transmission.efficiency(S),
    )
    corners = {
        (corner % transmission.period) + k * transmission.period for corner in transmission.kinks() for k in (0, 1)
    }
    shown = len(curves) if np.abs(curves[-1] - 1).max() > _LOST else len(curves) - 1
    figure, panels = curve_panels([2.5] * shown)
    for axes, y, words in zip(panels, curves, _PERIOD_LABELS, strict=False):
        name_axes(axes, y=words)
        for corner in sorted(corners):
            axes.axvline(np.degrees(corner), color=GREY, linewidth=0.5)
        axes.plot(np.degrees(S), y, color=BLACK, linewidth=1.2)
    whole = title if shown == len(curves) else f"{title}; no friction, no losses"
    name_axes(panels[0], title=whole)
    name_axes(panels[-1], x="driver's angle (deg)")
    return figure


_SAMPLES = 401  # samples of each phase, and of each interval
_LABELS = (
    "driven angle\n$\\alpha_2$ (deg)",
    "speed ratio\n$\\tau$",
    "sliding efficiency\n$\\eta$",
    "arms of the force\n$b_i$ divided by pitch radius",
)
_EFFICIENCY = 2  # index of the panel of efficiency
_DWELL_DASHES: Any = (0, (0.7, 0.7))  # dashes of a dwell
_CENTRES = 5  # maximum number of ticks for the instant centre
_CURVES: tuple[tuple[str, Any], ...] = (("", "-"), ("driven ", (0, (1.5, 0.7))))  # the driven wheel's curve: dashed
_NEAR_RIM = 0.7  # share of the panel width beyond which a label is placed to the left of its line
_BEYOND = 4.0  # maximum extension of an axis beyond the real path, over the range of the real path


def triangular_figure(transmission: TriangularTransmission, friction: PairFriction | None = None) -> Figure:
    """Return a figure of driven angle, speed ratio, sliding efficiency and moment arms of a pair with triangular teeth
    against the angle of the driver.

    Thin lines show the ideal path of one tooth pair (docs/teeth.md, equations 2 to 11); thick lines show the real path
    of all tooth pairs. The driver angle decreases with time. A second axis next to the speed ratio gives the position
    of the instant centre. Moment arms are relative to the pitch radii of the mean ratio; the moment arm of the driven
    wheel is dashed.
    """
    require_contact(transmission)
    has_friction = transmission.friction > 0 if friction is None else True
    rows = [row for row in range(len(_LABELS)) if has_friction or row != _EFFICIENCY]
    figure, panels = curve_panels([2.5] * len(rows), 1.5)
    for row, axes in zip(rows, panels, strict=True):
        _panel(axes, transmission, row, friction)
    _matching(panels, transmission)
    _jumps(panels[1], transmission)
    # the distance of the instant centre from the driver's axis, divided by the centre distance
    signs = transmission.sizes.signs
    beside = panels[1].secondary_yaxis("right", functions=(partial(_centre_at, signs), partial(_ratio_at, signs)))
    beside.set_ylabel("instant centre\n$O_1C / D$", fontsize=TEXT)
    beside.tick_params(labelsize=SMALL)
    beside.set_yticks(_centres(signs, *panels[1].get_ylim()))  # on this scale ticks crowd where tau is near 0
    for text, (_, style) in zip(("$b_1$, driver", "$b_2$, driven"), _CURVES, strict=True):
        panels[-1].plot([], [], color=BLACK, linewidth=1.2, linestyle=style, label=text)
    legend_above(panels[-1], 2)
    _label_time(panels[-1])
    name_axes(panels[0], title=_title(transmission, friction))
    legend_below(figure, 4, list(_legend(transmission)))
    return figure


# ------------------------------------------------------------------------------------------------------------- curves


def _panel(axes: Axes, transmission: TriangularTransmission, row: int, friction: PairFriction | None) -> None:
    name_axes(axes, y=_LABELS[row])
    ideal, real = [], []
    for phase, low, high in _phases(transmission):
        x = np.linspace(low, high, _SAMPLES)
        for y, (whose, style) in zip(_values(transmission, friction, phase, x)[row], _CURVES, strict=False):
            line = {"linestyle": style, "gid": f"{whose}ideal {phase}"}
            axes.plot(np.degrees(x), y, color=PHASES[phase], linewidth=1.2, **line)
            ideal.append(y)
    for interval in transmission.intervals:
        x = np.linspace(interval.start, interval.end, _SAMPLES)
        color = PHASES[interval.phase]
        for y, (whose, style) in zip(
            _values(transmission, friction, interval.phase, x, interval.held)[row], _CURVES, strict=False
        ):
            line = {"linestyle": style if interval.held is None else _DWELL_DASHES, "solid_capstyle": "butt"}
            line |= {"dash_capstyle": "butt", "gid": f"{whose}real {interval.phase}"}
            axes.plot(np.degrees(x), y, color=color, linewidth=4.0, **line)
            real.append(y)
        axes.axvspan(degrees(interval.end), degrees(interval.start), color=color, alpha=0.08, linewidth=0)
    if row:
        axes.set_ylim(*_limits(np.concatenate(ideal), np.concatenate(real)))


def _phases(transmission: TriangularTransmission) -> Iterator[tuple[str, float, float]]:
    """Yield each phase of the ideal path with its minimum and maximum driver angle alpha_1 [rad]."""
    for phase in (RECESS, APPROACH):
        pieces = [piece for piece in transmission.contact.path.pieces if piece.phase == phase]
        if pieces:
            yield phase, min(piece.low for piece in pieces), max(piece.high for piece in pieces)


def _values(
    transmission: TriangularTransmission,
    friction: PairFriction | None,
    phase: str,
    x: Floats,
    held: float | None = None,
) -> tuple[tuple[Floats, ...], ...]:
    """Return the values of each panel (as in `_LABELS`) at the driver's angles x [rad]; NaN where undefined.

    phase   "approach" or "recess": which tooth's tip is in contact
    held    angle of the driven wheel at rest [rad]; None if it turns
    """
    if held is not None:
        none = np.full_like(x, np.nan)
        return (np.full_like(x, degrees(held)),), (np.zeros_like(x),), (none,), (none, none)
    tooth_pair, sizes = transmission.contact.path.tooth_pair, transmission.sizes
    with np.errstate(all="ignore"):  # beyond the real path a flank may be inclined by more than 90 degrees
        rub = transmission.coefficient(phase, x, friction)
        eta = tooth_pair.efficiency(phase, x, rub, np)
        eta = np.where((eta >= 0) & (eta <= 1), eta, np.nan)
        arms = tooth_pair.moment_arms(phase, x, rub, np)
        rolling = (sizes.D * z / sizes.pitch_sum for z in (sizes.z1, sizes.z2))
        relative = tuple(arm / radius for arm, radius in zip(arms, rolling, strict=True))
        return (np.degrees(tooth_pair.angle(phase, x, np)),), (tooth_pair.speed(phase, x, np),), (eta,), relative


def _limits(ideal: Floats, real: Floats) -> tuple[float, float]:
    """Return axis limits around the real path and the nearby part of the ideal path; 0 and 1 if none is finite."""
    ideal, real = ideal[np.isfinite(ideal)], real[np.isfinite(real)]
    if not len(real):
        return 0.0, 1.0
    low, high = float(real.min()), float(real.max())
    more = _BEYOND * max(high - low, 1e-3 * abs(high))  # a constant ratio has no range
    bottom, top = max(low - more, min(low, float(ideal.min()))), min(high + more, max(high, float(ideal.max())))
    rim = 0.07 * (top - bottom) or 0.05
    return bottom - rim, top + rim


# -------------------------------------------------------------------------------------------------------------- marks


def _matching(panels: list[Axes], transmission: TriangularTransmission) -> None:
    """Draw a vertical line at the driver's angle at which a flank of the driver coincides with a flank of the mate."""
    matching = transmission.sizes.matching
    if abs(matching) >= transmission.sizes.reach1:
        return
    for axes in panels:
        axes.axvline(degrees(matching), color=GREY, linewidth=1.0, linestyle="-.", gid="matching")
    left, right = panels[0].get_xlim()
    aside = -1 if degrees(matching) > left + _NEAR_RIM * (right - left) else 1
    text = r"matching $\alpha_{1m}$ = " + f"{degrees(matching):.3g}°"
    at, frame = (degrees(matching), 0.03), ("data", "axes fraction")
    note(panels[0], text, at, (5 * aside, 0), xycoords=frame, color=GREY, gid="matching")


def _jumps(axes: Axes, transmission: TriangularTransmission) -> None:
    """Draw a dotted line between the speed ratios before and after each change of the tooth pair that drives."""
    turns = zip(transmission.intervals, (*transmission.intervals[1:], transmission.intervals[0]), strict=True)
    hits = [(last, new) for last, new in turns if new.held is None]
    for (last, new), jump in zip(hits, transmission.jumps, strict=True):
        before, at = degrees(last.end), degrees(new.start)
        axes.plot([before, at, at], [jump.before, jump.before, jump.after], color=GREY, linewidth=1.0, linestyle=":")
        axes.plot([before], [jump.before], "o", color=BLACK, markerfacecolor="white", markersize=5, zorder=4)
        axes.plot([at], [jump.after], "o", color=BLACK, markersize=5, zorder=4)
        # the relative jump at its upper left, which is free of curves
        text = f"{'matching' if jump.kind == 'matching' else 'jump'} {jump.value:.4f}"
        note(axes, text, (degrees(jump.alpha1), jump.after), (-4, 5), va="bottom", color=BLACK, gid="jump")


def _centre_at(signs: tuple[int, int], tau: Any) -> Any:
    """Return the position of the instant centre on the line of centres, from 0 at O_1 to 1 at O_2, at a speed ratio.

    signs   1 for an external wheel, -1 for a ring
    """
    first, second = signs
    # the lower bound of the denominator applies to speed ratios far from the real path
    return tau / np.maximum(first + second * tau, 0.1)


def _ratio_at(signs: tuple[int, int], centre: Any) -> Any:
    """Return the speed ratio for a position of the instant centre (inverse function of `_centre_at`)."""
    first, second = signs
    return centre / np.maximum(first * (1 - second * centre), 0.1)


def _centres(signs: tuple[int, int], low: float, high: float) -> list[float]:
    """Return round tick positions for the instant centre between two speed ratios, not too close together."""
    minimum, most = sorted(float(_centre_at(signs, tau)) for tau in (low, high))
    ticks: list[float] = []
    for bins in range(_CENTRES, 0, -1):
        found = MaxNLocator(nbins=bins, steps=(1, 2, 2.5, 5, 10)).tick_values(minimum, most)
        ticks = [float(at) for at in found if minimum <= at <= most]
        ratios = [float(_ratio_at(signs, at)) for at in ticks]
        if all(abs(b - a) > (high - low) / (2 * _CENTRES) for a, b in pairwise(ratios)):
            break
    return ticks


def _label_time(axes: Axes) -> None:
    """Label the abscissa and draw an arrow in the direction of time. The driver's angle decreases with time."""
    axes.set_xlabel(r"driver angle $\alpha_1$ (deg)", fontsize=TEXT)
    axes.annotate(
        "time",
        (0.0, -0.2),
        xytext=(0.16, -0.2),
        xycoords="axes fraction",
        textcoords="axes fraction",
        va="center",
        fontsize=TEXT,
        arrowprops={"arrowstyle": "-|>", "color": BLACK, "linewidth": 1.5},
    )


def _title(transmission: TriangularTransmission, friction: PairFriction | None) -> str:
    losses = transmission if friction is None else RubbedTransmission(transmission, friction)
    low, high = transmission.speed_range()
    minimum, maximum = transmission.error_range()
    return "\n".join(
        (
            pair_text(transmission, losses.friction),
            f"speed ratio {low:.4g} to {high:.4g}, mean efficiency {losses.efficiency_mean():.4g}, "
            f"transmission error {degrees(maximum - minimum):.4g}° peak to peak",
            fill(f"{transmission.verdict.kind}: {transmission.verdict.text}", 100),
        )
    )


def _legend(transmission: TriangularTransmission) -> Iterator[Line2D]:
    driving = {interval.phase for interval in transmission.intervals}
    for phase, _, _ in _phases(transmission):
        if phase in driving:
            yield Line2D([], [], color=PHASES[phase], linewidth=4.0, label=f"{phase}, real path")
        yield Line2D([], [], color=PHASES[phase], linewidth=1.2, label=f"{phase}, ideal path")
    if DWELL in driving:
        yield Line2D([], [], color=PHASES[DWELL], linewidth=4.0, linestyle=_DWELL_DASHES, label=DWELL)


# ----------------------------------------------------------------------------------------- conjugate forms side by side


Styles = Mapping[str, tuple[str, Dash]]

_PATH_SAMPLES = 301  # samples of each side
_NEAREST = 1e-6  # share of a side: closer to the pitch point some quantities are 0/0
_MOST = 3.0  # panel height over the median of the forms' maxima; higher curves leave the panel
_SPIKE = 6.0  # panel height over the 90 % quantile of a curve; spikes of faulty teeth leave the panel
_FLAT = 0.8  # minimum over maximum beyond which a panel does not begin at 0
_STRAIGHT = 0.1  # modules: minimum width that a panel shows
_SINGULAR = 0.1  # pitches from the pitch point within which singular values do not set the panel height


def shapes_figure(paths: Mapping[str, PathOfContact]) -> Figure:
    """Return a figure of the flanks, paths of contact, stress, heat, sliding and loss of several forms for one pair."""
    if not paths:
        what, why = "no tooth form can be drawn", "no form has a path of contact for this pair"
        raise QuestionError(Problem(what, why, "change the arcs of approach and recess, or the tooth counts"))
    figure = Figure(figsize=(WIDTH, 13.0), layout="constrained")
    panels = figure.subplots(4, 2)
    for axes in panels.flat:
        plain(axes)
    pitch = next(iter(paths.values())).pitch
    unit = pitch.p / pi
    styles = {name: (series_colour(at), series_dash(at)) for at, name in enumerate(paths)}
    for name, path in paths.items():
        X = _places(path)
        # x and y from the pitch point; on the sphere, as viewed from outside above that point
        _line(panels[0, 0], name, styles, path.flank(1, X)[..., :2] / unit)
        _line(panels[0, 1], name, styles, path.flank(2, X)[..., :2] / unit)
        contact = path.at(X)
        points = pitch.point(contact.d, contact.sin_psi, contact.cos_psi)[..., :2] / unit
        _line(panels[1, 0], name, styles, points)
    for axes, text in zip(
        panels.flat,
        ("flank of gear 1, stretched", "flank of gear 2, stretched", "path of contact, stretched"),
        strict=False,
    ):
        _label_flank_panel(axes, text)
    for axes, (words, cost) in zip(panels.flat[3:], _quantities(pitch, unit), strict=True):
        _along(axes, words, cost, paths, styles)
    beyond = ""
    for axes in panels.flat[3:]:
        low, high = axes.get_ylim()
        drawn = [np.asarray(line.get_ydata(), dtype=float) for line in axes.lines if line.get_gid()]
        if any(((y < low) | (y > high)).any() for y in drawn):
            beyond = "; some curves extend beyond their panels"
    gears = f"{pitch.z1} drives {pitch.z2}"
    gears += f", axes at {degrees(pitch.R1 + pitch.R2):.6g}°" if pitch.bevel else ", a ring" if pitch.R2 < 0 else ""
    only = f"{next(iter(paths)).replace('_', ' ')} teeth" if len(paths) == 1 else "tooth forms side by side"
    headed(figure, f"{only}, {gears}{beyond}")
    if len(paths) == 1:
        return figure
    handles = [
        Line2D([], [], color=color, linestyle=dashes, linewidth=1.8, label=name.replace("_", " "))
        for name, (color, dashes) in styles.items()
    ]
    legend_below(figure, 3, handles, handlelength=4)
    return figure


def _places(path: PathOfContact) -> Floats:
    """Return positions along the whole path of contact, without the pitch point [modules or rad]."""
    approach, recess = path.arcs
    if min(approach, recess) < 0:
        return np.linspace(-approach, recess, _PATH_SAMPLES)
    steps = np.linspace(_NEAREST, 1.0, _PATH_SAMPLES)
    sides = [-approach * steps[::-1]] if approach else []
    return np.concatenate([*sides, *([recess * steps] if recess else [])])


def _line(axes: Axes, name: str, styles: Styles, points: Floats) -> None:
    color, dashes = styles[name]
    axes.plot(points[:, 0], points[:, 1], color=color, linestyle=dashes, linewidth=1.8, gid=name)


def _label_flank_panel(axes: Axes, text: str) -> None:
    """Label a panel of flanks. The panel is not to scale, because steep flanks would coincide if it were."""
    axes.plot([0], [0], "+", color=BLACK, markersize=9, gid="pitch point")
    axes.axhline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
    name_axes(axes, title=text)
    low, high = axes.get_xlim()
    if high - low < _STRAIGHT:  # a radial flank, on which rounding errors would be magnified
        axes.set_xlim((low + high - _STRAIGHT) / 2, (low + high + _STRAIGHT) / 2)
    axes.locator_params(axis="x", nbins=5)  # numbers with three decimals need space
    name_axes(axes, "along the pitch line (modules)", "towards gear 2 (modules)", size=SMALL)


# --------------------------------------------------------------------------------------------------------------- costs


def _quantities(pitch: PitchSurfaces, unit: float) -> Iterator[tuple[str, Callable[[PathContact], Floats]]]:
    """Yield the label and the function of each quantity of the path of contact.

    unit   length of a module in the unit of the path, so that spur and bevel gears can be compared
    """
    # H has the dimension 1/length, and the flash temperature length**(-1/4)
    yield r"Hertz pressure $\sqrt{H}$", lambda c: np.sqrt(c.H * unit)
    yield "heat per area, hotter flank $Q$", lambda c: np.maximum(c.Q1, c.Q2)
    yield r"flash temperature $\Theta$", lambda c: c.flash * unit**0.25
    yield "sliding divided by pitch-line speed", lambda c: (pitch.A + pitch.B) * np.abs(pitch.S(c.d))
    yield r"power lost over $\mu\,(A+B)\,|X|$ times power", lambda c: c.rub / np.abs(c.X)


def _along(
    axes: Axes, words: str, cost: Callable[[PathContact], Floats], paths: Mapping[str, PathOfContact], styles: Styles
) -> None:
    low, high, tops = inf, 0.0, []
    for name, path in paths.items():
        X = _places(path)
        pitches = X / path.pitch.p
        with np.errstate(invalid="ignore"):  # where a flank turns back, H has no real root
            values = cost(path.at(X))
        _line(axes, name, styles, np.stack([pitches, values], axis=1))
        away = values[(np.abs(pitches) > _SINGULAR) & np.isfinite(values)]
        top = min(float(away.max(initial=0.0)), _SPIKE * float(np.quantile(away, 0.9))) if len(away) else 0.0
        low, high = min(low, float(away.min(initial=inf))), max(high, top)
        tops.append(top)
    # one form with a singular curve must not flatten the curves of all other forms
    high = min(high, _MOST * float(np.median(tops)))
    rim = max(0.1 * (high - low), 0.02 * high)
    axes.set_ylim(low - rim if low > _FLAT * high else 0.0, high + rim or 1.0)
    axes.axvline(0.0, color=GREY, linewidth=0.8, linestyle="-.")
    name_axes(axes, title=words)
    name_axes(axes, "contact at X (pitches): approach, recess", size=SMALL)
