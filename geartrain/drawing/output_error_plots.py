"""Plots of a train over some turns of the input: errors of outputs, motion of one output, crank torque with losses."""

from __future__ import annotations

from collections.abc import Callable
from textwrap import shorten
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    DOT,
    GREEN,
    GREY,
    MOST_ROWS,
    ORANGE,
    PALE,
    RED,
    SMALL,
    TEXT,
    Axes,
    Figure,
    Row,
    curve_panels,
    draw_rows,
    figures,
    headed,
    interval_chart,
    kept_extremes,
    legend_above,
    name_axes,
    short,
)
from geartrain.dynamics.motion.motion_run import MotionRun
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics import Motion, TorqueCycle
    from geartrain.dynamics.motion.run_statistics import RunningStatistics
    from geartrain.numerics.arrays import Floats


_POINTS = 6000  # points drawn in a panel: the first of each interval, its minimum and its maximum
_TURNING_POINTS = 360  # turning points drawn of a curve that would otherwise fill its panel
_ROUNDING = 1e-12  # rad: smaller deviations are rounding errors
_MAX_TURNS = 15  # turns of a pointer beyond which its angle would fill the panel


class _Trace(NamedTuple):
    """Motion of one output against the turns of the input.

    The angle and the mean angle are in turns, and the error is in rad; for a link that slides, all are in mm. The speed
    is divided by the mean speed of the output, or by the input speed if the mean is 0.
    """

    name: str
    turns: Floats
    angle: Floats
    mean: Floats
    error: Floats
    speed: Floats
    kind: str
    """Name of the error on the axis of the plot: transmission error if the train has tooth forms, or anomaly if it has
    none.
    """
    slides: bool
    first: tuple[Floats, Floats, Floats]
    """Input turns, output error and relative output speed at the first positions of the motion run."""


def motion_figure(run: MotionRun, on_done: Callable[[int], None] = lambda _: None, title: str = "") -> Figure:
    """Return a chart of the output errors over a run, or, if there is only one output, curves of its motion.

    The chart has a row for each requested output, by default for each output with a dial (for each output with a
    target, or for all outputs, if there is none). It shows the transmission error of the teeth less its mean, without
    the anomaly of couplings; if no tooth form with variable ratio is declared, it shows the anomaly. The curves of one
    output are its angle with any backward motion, the same error, and the speed.
    """
    motion = run.motion._of(run.motion._shown)
    if len(motion.outputs) == 1:
        return headed(_curves(motion, run, on_done), title)
    errors = MotionRun(motion.without_anomaly(), run.turns, run.samples)
    errors.run(on_done)
    return _error_chart(errors, title)


def _error_chart(run: MotionRun, title: str) -> Figure:
    """Return a chart of the output errors of a computed run, without outputs that move uniformly, unless all do."""
    uneven = [tally for tally in run.statistics if tally.peak_to_peak > _ROUNDING]
    ranked = sorted(uneven or run.statistics, key=lambda tally: -tally.peak_to_peak)
    shown = ranked[:MOST_ROWS]
    days = any(run.motion._degrees_per_day(tally.name) for tally in shown)
    panels = {
        f"{_kind(run.motion)}, less its mean ({unit}): thick ± rms, thin minimum to maximum": [
            _error_row(run.motion, tally, days) for tally in shown if tally.slides == slides
        ]
        for unit, slides in (("deg", False), ("mm", True))
    }
    notes = [title, f"{len(ranked) - len(shown)} outputs with smaller errors are omitted: select them with --of"]
    notes = notes if len(ranked) > len(shown) else notes[:1]
    if not uneven:
        notes.append("every output moves uniformly")
    elif len(uneven) < len(run.statistics):
        even = [tally.name for tally in run.statistics if tally not in uneven]
        notes.append(f"uniform: {shorten(', '.join(even), 60, placeholder=' ...')}")
    return interval_chart(panels, {"mean": DOT}, ("range", *["days"] * days), "; ".join(filter(None, notes)))


def _error_row(motion: Motion, tally: RunningStatistics, days: bool) -> Row:
    factor = tally.degrees_or_mm
    low, high = (factor * (end - tally.centre) for end in (tally.minimum, tally.most))
    rms = factor * tally.rms
    unit, per_day = (" mm" if tally.slides else "°"), motion._degrees_per_day(tally.name)
    size = high - low if tally.peak_to_peak > _ROUNDING else 0.0
    time = [figures(size * (360 if tally.slides else 1) / per_day) if per_day else "-"] * days
    return Row(tally.name, {"mean": 0.0}, ((low, high), (-rms, rms)), (f"{figures(size)}{unit}", *time))


def _kind(motion: Motion) -> str:
    return "anomaly" if motion._problem.couplings and not motion._problem.rippling else "transmission error"


def _curves(motion: Motion, run: MotionRun, on_done: Callable[[int], None]) -> Figure:
    """Return a figure with the curves of the only output of a motion, one below the other."""
    trace = _trace(motion, run, on_done)
    uneven = np.ptp(trace.error) > _ROUNDING or np.ptp(trace.speed) > _ROUNDING
    drawers: list[Callable[[Axes, _Trace], None]] = [_error, _speed] if uneven else []
    if trace.slides or np.ptp(trace.mean) <= _MAX_TURNS:
        drawers.insert(0, _angle)
    elif (trace.speed < 0).any():  # for many turns, only backward motion
        drawers.insert(0, _backward_motion)
    drawers = drawers or [_speed]
    figure, panels = curve_panels([2.1] * len(drawers), 0.5, share=False)
    for drawer, panel in zip(drawers, panels, strict=True):
        drawer(panel, trace)
        name_axes(panel, f"turns of {motion._problem.driving_link}", size=SMALL, parse_math=False)
    return figure


def _trace(motion: Motion, run: MotionRun, on_done: Callable[[int], None]) -> _Trace:
    """Return the trace of the only output of a motion, reduced to the resolution of the picture."""
    (tally,), (start,), toothed = motion._statistics(), motion._start_angles, motion.without_anomaly()
    parts: list[tuple[Floats, Floats, Floats, Floats]] = []
    first: tuple[Floats, Floats, Floats] | None = None
    chunks = (each._stretches(run.turns, run.samples) for each in (motion, toothed))
    for passage, own in zip(*chunks, strict=True):
        share = max(1, round(_POINTS / 3 * len(passage.turns) / run.samples))
        speed = (tally.mean + passage.rate[0]) / (tally.mean or 1.0)
        first = first or (passage.turns[:_POINTS], own.error[0, :_POINTS], speed[:_POINTS])
        kept = _thinned(own.error[0], speed, share)
        parts.append((passage.turns[kept], passage.error[0][kept], own.error[0][kept], speed[kept]))
        on_done(len(passage.turns))
    assert first is not None
    turns, deviation, error, speed = (np.concatenate(column) for column in zip(*parts, strict=True))
    turn = 1.0 if tally.slides else 2 * np.pi
    mean = start / turn + tally.mean * turns
    angle = mean + deviation / turn
    return _Trace(tally.name, turns, angle, mean, error, speed, _kind(motion), tally.slides, first)


def _thinned(error: Floats, speed: Floats, bins: int) -> NDArray[np.intp]:
    """Return the indices of the positions to draw: reversals, and the extremes of error and speed in each bin."""
    turning = np.flatnonzero(np.diff(np.signbit(speed)))[:_POINTS]
    extremes = (kept_extremes(values, 3 * bins) for values in (error, speed))
    return np.unique(np.concatenate([*extremes, turning, turning + 1]))


def _angle(panel: Axes, trace: _Trace) -> None:
    def line(turns: Floats, values: Floats) -> tuple[Floats, Floats]:
        return (turns, values) if trace.slides else _dial_line(turns, values)

    looks: tuple[dict[str, Any], ...] = (
        {"color": GREY, "linewidth": 0.8, "linestyle": "--", "label": "mean"},
        {"color": BLUE, "linewidth": 1.2, "label": "true"},
    )
    for values, look in zip((trace.mean, trace.angle), looks, strict=True):
        panel.plot(*line(trace.turns, values), **look)
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    if np.isfinite(back).any():
        panel.plot(*line(trace.turns, back), color=RED, linewidth=3, label="backward")
    if trace.slides:
        panel.set_ylabel(f"{trace.name}\ntravel (mm)")
    else:
        _set_degrees(panel, f"{trace.name}\nangle (deg)")
    legend_above(panel, 3)


def _backward_motion(panel: Axes, trace: _Trace) -> None:
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    panel.plot(*_dial_line(trace.turns, back), color=RED, linewidth=1.5)
    _set_degrees(panel, f"{trace.name}\nbackward motion (deg)")


def _set_degrees(panel: Axes, label: str) -> None:
    panel.set_ylabel(label)
    panel.set_ylim(0, 360)
    panel.set_yticks(range(0, 361, 90))


def _dial_line(x: Floats, turns: Floats) -> tuple[Floats, Floats]:
    """Return the abscissae and angles [deg], modulo 360, of a pointer's line, with NaN where the pointer passes 0."""
    degrees = 360 * np.mod(turns, 1)
    cuts = np.flatnonzero(np.abs(np.diff(degrees)) > 180) + 1
    return np.insert(x, cuts, np.nan), np.insert(degrees, cuts, np.nan)


def _error(panel: Axes, trace: _Trace) -> None:
    unit, factor = ("mm", 1.0) if trace.slides else ("deg", 180 / np.pi)
    middle = trace.error.mean()
    _curve(panel, trace, factor * (trace.error - middle), factor * (trace.first[1] - middle))
    panel.set_ylabel(f"{trace.name}\n{trace.kind}\nless its mean ({unit})")


def _speed(panel: Axes, trace: _Trace) -> None:
    turns, speed = _curve(panel, trace, trace.speed, trace.first[2])
    if (speed < 0).any():
        panel.fill_between(turns, speed, 0, where=speed < 0, color=RED, alpha=0.6, linewidth=0)
    panel.set_ylabel(f"{trace.name}\nspeed divided by mean")


def _curve(panel: Axes, trace: _Trace, whole: Floats, first: Floats) -> tuple[Floats, Floats]:
    """Plot a curve, or only its beginning if its oscillations would be too close together, and return what is plotted.

    whole   values over the whole range
    first   values at the beginning of the range, at more positions
    """
    turns, values = trace.turns, whole
    # the total variation over the range is twice the number of oscillations
    if np.abs(np.diff(whole)).sum() > _TURNING_POINTS * np.ptp(whole):
        turning = np.flatnonzero(np.diff(np.sign(np.diff(first))) != 0)
        end = turning[_TURNING_POINTS // 6] if len(turning) > _TURNING_POINTS // 6 else len(first)
        turns, values = trace.first[0][:end], first[:end]
        for bound in (whole.min(), whole.max()):
            panel.axhline(bound, color=GREY, linewidth=0.8, linestyle=":")
    panel.plot(turns, values, color=BLUE, linewidth=0.8)
    return turns, values


# --------------------------------------------------------------------------------------------------- torque over a turn


_ABOVE_LEGEND = 20  # points from the title to the upper panel
_MINIMUM = 1e-9  # relative to all losses: smaller losses are rounding errors
_CUT = 1.5  # axis limit over the 98 % quantile of the torque, which is unbounded near a lock
_PREFIXES = ((1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"))


def torque_cycle_figure(found: TorqueCycle, title: str = "") -> Figure:
    """Return a figure of the torque over the positions in `found`, with its mean and its extremes.

    A chart below the torque shows the mean and the range of the losses of gear pairs, couplings and bearings, if there
    are any, with the largest loss at the top.
    """
    if found.turns is None or found.torque is None or not np.isfinite(found.torque).any():
        what, fix = "the torque over a turn is not known", "declare loads that the input can drive"
        raise QuestionError(Problem(what, found.verdict.text, fix))
    rows, label = _loss_rows(found)
    heights = [2.9] + ([0.9 + 0.25 * len(rows)] if rows else [])
    figure, panels = curve_panels(heights, 0.8, share=False)
    _torque(panels[0], found)
    if rows:
        draw_rows(panels[1], rows, {"mean": DOT}, ("of all losses",))
        limit = _bounds(np.array([end for row in rows for end in row.spans[0]]))[1] if found.locked else None
        panels[1].set_xlim(0.0, limit)
        name_axes(panels[1], f"{label}: dot mean, line minimum to maximum", size=SMALL, parse_math=False)
    for start, end in found.locked:
        panels[0].axvspan(start.turns, end.turns, color=PALE, alpha=0.6, linewidth=0, zorder=0, gid="locked")
    panels[0].set_title(title, fontsize=TEXT, loc="left", color=BLACK, parse_math=False, pad=_ABOVE_LEGEND)
    panels[0].set_xlim(0.0, found.span)
    name_axes(panels[0], "turns of the input", size=SMALL)
    return figure


def _prefixed(maximum: float, unit: str) -> tuple[float, str]:
    """Return the factor to a unit with a decimal prefix that suits the maximum, and this unit in parentheses."""
    if not unit:
        return 1.0, ""
    size, prefix = next((each for each in _PREFIXES if maximum >= each[0]), (1.0, "") if not maximum else _PREFIXES[-1])
    return 1 / size, f" ({prefix}{unit})"


def _torque(panel: Axes, found: TorqueCycle) -> None:
    assert found.turns is not None
    assert found.torque is not None
    factor, unit = _prefixed(float(np.nanquantile(abs(found.torque), 0.98)), found.unit)
    torque = factor * found.torque
    shown = kept_extremes(torque, _POINTS)
    panel.plot(found.turns[shown], torque[shown], color=BLUE, linewidth=0.9)
    if found.standing is not None and not np.allclose(found.standing, found.torque, equal_nan=True):
        shown = kept_extremes(found.standing, _POINTS)
        starting = factor * found.standing[shown]
        panel.plot(
            found.turns[shown], starting, color=ORANGE, linewidth=0.8, linestyle=":", label="to start it", zorder=1
        )
    if found.mean is not None:
        mean = factor * found.mean
        panel.axhline(mean, color=BLACK, linewidth=1.0, linestyle="--", label=f"mean {mean:.5g}", zorder=3)
    constant = np.ptp(torque) < _MINIMUM * abs(torque).max()
    marks = (("maximum", found.maximum, "^", RED), ("minimum", found.minimum, "v", GREEN))
    for name, extreme, marker, colour in marks:
        if extreme is not None and not constant:
            look: dict[str, Any] = {"color": colour, "markersize": 7, "clip_on": False, "zorder": 5}
            value = factor * extreme.torque
            panel.plot([extreme.turns], [value], marker, label=f"{name} {value:.5g}", gid=name, **look)
    if found.locked:
        panel.fill_between([], [], [], color=PALE, alpha=0.6, label=f"locked, {100 * found.locked_share:.3g} %")
        even = np.interp(np.linspace(found.turns[0], found.turns[-1], _POINTS), found.turns, torque)
        panel.set_ylim(*_bounds(even))
    elif constant:  # a constant torque is a line at half of the height
        panel.set_ylim(*sorted((0.0, 2 * torque[0])))
    name_axes(panel, y=f"torque at {short(found.link)}{unit}", size=SMALL, parse_math=False)
    legend_above(panel, 5)


def _mean_speed(found: TorqueCycle) -> float:
    """Return the mean turns of the output per input turn; 0 if it only oscillates, 1 if its speed is unknown."""
    assert found.turns is not None
    if found.speeds is None or found.link not in found.speeds.labels[0]:
        return 1.0
    speed = np.asarray(found.speeds.values)[found.speeds.labels[0].index(found.link)]
    forth, most = np.trapezoid(speed, found.turns), np.trapezoid(abs(speed), found.turns)
    # the mean speed of a link that swings is only a rounding error
    return float(abs(forth) / found.span) if abs(forth) > _MINIMUM * most else 0.0


def _loss_rows(found: TorqueCycle) -> tuple[list[Row], str]:
    """Return chart rows with the losses of parts in descending order, and the label of the loss axis.

    Losses beyond the maximum number of rows are combined in one row.
    """
    lost = sum(part.loss for part in found.parts.values())
    if found.losses is None or found.turns is None or not lost > 0:
        return [], ""
    names, values = found.losses.labels[0], np.asarray(found.losses.values)
    powers = dict(zip(names, values, strict=True))
    losing = [name for name in names if found.parts[name].loss > _MINIMUM * lost]
    ranked = sorted(losing, key=lambda name: -found.parts[name].loss)
    shown = ranked if len(ranked) <= MOST_ROWS else ranked[: MOST_ROWS - 1]
    groups = {short(name, 24): [name] for name in shown}
    if rest := ranked[len(shown) :]:
        groups[f"{len(rest)} others"] = rest
    speed = _mean_speed(found)
    factor, unit = _prefixed(
        max(float(np.nanquantile(powers[name], 0.98)) for name in ranked) / (speed or 1), found.unit
    )
    rows = []
    for name, parts in groups.items():
        loss = sum(found.parts[part].loss for part in parts)
        torque = factor / (speed or 1.0) * np.sum([powers[part] for part in parts], axis=0)
        mean = factor / (speed or 1.0) * loss / (2 * np.pi * found.span)
        ends = float(np.nanmin(torque)), float(np.nanmax(torque))
        rows.append(Row(name, {"mean": mean}, (ends,), (f"{100 * loss / lost:.3g} %",)))
    of = f"as torque at {short(found.link)}" if speed else "per radian of the input"
    return rows, f"losses, {of}{unit}"


def _bounds(values: Floats) -> tuple[float, float]:
    """Return axis limits for values that may diverge: their 2 % and 98 % quantiles, extended to include 0."""
    low, high = np.nanquantile(values, (0.02, 0.98))
    return _CUT * min(low, 0.0), _CUT * max(high, 0.0)
