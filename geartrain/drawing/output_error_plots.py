"""Plots of a train over some turns of the input: deviations and speeds of outputs, crank torque with losses."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid

from geartrain.drawing.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PALE,
    RED,
    SMALL,
    TEXT,
    WIDTH,
    Axes,
    Figure,
    curve_panels,
    headed,
    kept_extremes,
    legend_above,
    name_axes,
    plain,
    short,
)
from geartrain.dynamics.motion.motion_run import MotionRun
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics import ErrorSamples, TorqueCycle
    from geartrain.numerics.arrays import Floats


_ROW = 200  # pixels: height of a panel, at 100 dots per inch
_MOST = 6000  # points drawn in a panel: the first of each interval, its minimum and its maximum
_OUTPUTS, _STACKED = 12, 4  # maximum number of outputs drawn, and of outputs in one column
_WIDE = 5.0  # inches: width of a panel next to others
_TICKS = 6  # maximum number of intervals between ticks below a panel
_TURNING_POINTS = 60  # turning points drawn of a curve that would otherwise fill its panel
_ROUNDING = 1e-12  # rad: smaller deviations are rounding errors
_MAX_TURNS = 15  # turns of a pointer beyond which its angle would fill the panel


class _Trace(NamedTuple):
    """Motion of one output against the turns of the input.

    The angle and its mean are in turns and the deviation in rad. The speed is divided by the mean speed of the output,
    or by the input speed if the mean is 0.
    """

    name: str
    turns: Floats
    angle: Floats
    mean: Floats
    error: Floats
    speed: Floats
    kind: str
    """Name of the deviation on the axis: transmission error if the train has tooth forms, otherwise anomaly."""
    first: tuple[Floats, Floats, Floats]
    """Turns, deviation [rad] and relative speed at each of the first positions."""

    @property
    def errs(self) -> bool:
        """True if the output deviates from uniform motion by more than rounding errors."""
        return bool(np.ptp(self.error) > _ROUNDING)


_Drawer = Callable[[Any, _Trace], None]


def motion_figure(run: MotionRun, on_done: Callable[[int], None] = lambda _: None, title: str = "") -> Figure:
    """Return a figure of the angle, the deviation from mean motion and the speed of outputs over a run.

    For each output that deviates from uniform motion, panels show its deviation and its speed; backward motion is red.
    A run of few turns also has a panel with the angle, and a run of many turns a panel with any backward motion.
    Outputs that move uniformly are drawn only if all outputs move uniformly, each in one panel: the angle for few
    turns, otherwise the speed.

    Parameters
    ----------
    run : MotionRun
        Run that defines outputs, turns and positions. The motion is computed again, so `run.run` need not have been
        called.
    on_done : callable
        Called with the number of positions computed since the previous call.
    title : str
        Title above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Angles and deviations [deg], and speeds divided by their means, against turns of the input. At most twelve
        outputs are drawn: those with the largest deviations, or the first twelve if all move uniformly.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.dynamics import MotionRun
    >>> run = MotionRun(geartrain.load("moon-triangular").motion(), turns=0.1, samples=51)
    >>> motion_figure(run).axes[-1].get_xlabel()
    'turns of crank'
    """
    found = _traces(run, on_done)
    erring = [trace for trace in found if trace.errs]
    ranked = sorted(erring, key=lambda trace: -float(np.ptp(trace.error))) or found
    most = {trace.name for trace in ranked[:_OUTPUTS]}
    traces = [trace for trace in found if trace.name in most]
    figure = _figure([(trace, _drawers(trace)) for trace in traces], f"turns of {run.motion._problem.driving_link}")
    omitted = _omitted(len(erring), len(found) - len(erring))
    return headed(figure, "; ".join(filter(None, (title, *omitted))))


def _omitted(erring: int, exact: int) -> Iterator[str]:
    """Yield remarks on outputs that are not drawn, given the numbers of outputs that deviate from uniform motion or do
    not.
    """
    if not erring:
        yield "every output moves uniformly"
    less = (erring or exact) - _OUTPUTS
    if less == 1:
        yield f"1 output{' with a smaller deviation' if erring else ''} is omitted: select it with --of"
    elif less > 1:
        yield f"{less} outputs{' with smaller deviations' if erring else ''} are omitted: select them with --of"
    if erring and exact:
        moves = "1 output that moves uniformly is" if exact == 1 else f"{exact} outputs that move uniformly are"
        yield f"{moves} not drawn"


def _figure(parts: Sequence[tuple[_Trace, Sequence[_Drawer]]], below: str) -> Figure:
    """Return the figure with all panels: in one column for few outputs, otherwise one row for each output."""
    across = 1 if len(parts) <= _STACKED else max(len(drawers) for _, drawers in parts)
    if across > 1:  # deviation and speed, which all outputs have, in columns of their own
        parts = [(trace, [*drawers[-2:], *drawers[:-2]]) for trace, drawers in parts]
    rows = sum(len(drawers) for _, drawers in parts) if across == 1 else len(parts)
    size = WIDTH if across == 1 else _WIDE * across, max(2, rows) * _ROW / 100 + 0.3
    figure = Figure(figsize=size, layout="constrained")
    grid = figure.subplots(rows, across, squeeze=False)
    column = iter(grid[:, 0])
    for row, (trace, drawers) in enumerate(parts):
        for drawer, panel in zip(drawers, column if across == 1 else grid[row], strict=False):
            drawer(panel, trace)
            name_axes(panel, below, size=SMALL, parse_math=False)
            panel.locator_params(axis="x", nbins=_TICKS)
            plain(panel)
        for panel in grid[row, len(drawers) :] if across > 1 else ():
            panel.set_axis_off()
    return figure


def _drawers(trace: _Trace) -> list[_Drawer]:
    """Return the functions that draw an output's panels: the angle for few turns, only backward motion for many."""
    if not trace.errs:
        return [_angle] if np.ptp(trace.mean) <= _MAX_TURNS else [_speed]
    if np.ptp(trace.mean) <= _MAX_TURNS:
        return [_angle, _error, _speed]
    return [_backward_motion, _error, _speed] if (trace.speed < 0).any() else [_error, _speed]


def _traces(run: MotionRun, on_done: Callable[[int], None]) -> list[_Trace]:
    """Return the trace of every output, reduced to the resolution of the picture."""
    motion = run.motion
    parts: list[list[tuple[Floats, Floats, Floats]]] = [[] for _ in motion.outputs]
    firsts: list[tuple[Floats, Floats, Floats]] = []
    means = [tally.mean for tally in motion._statistics()]
    for passage in motion._stretches(run.turns, run.samples):
        share = max(1, round(_MOST / 3 * len(passage.turns) / run.samples))
        firsts = firsts or _first(passage, means)
        for at, part in enumerate(parts):
            kept = _thinned(passage.error[at], means[at] + passage.rate[at], share)
            part.append((passage.turns[kept], passage.error[at][kept], passage.rate[at][kept]))
        on_done(len(passage.turns))
    found = []
    kind = motion._problem.deviation
    for tally, start, part, first in zip(motion._statistics(), motion._start_angles, parts, firsts, strict=True):
        turns, error, rate = (np.concatenate(column) for column in zip(*part, strict=True))
        mean = start / (2 * np.pi) + tally.mean * turns
        angle = mean + error / (2 * np.pi)
        speed = (tally.mean + rate) / (tally.mean or 1.0)
        found.append(_Trace(tally.name, turns, angle, mean, error, speed, kind, first))
    return found


def _first(passage: ErrorSamples, means: Sequence[float]) -> list[tuple[Floats, Floats, Floats]]:
    """Return turns, deviation [rad] and relative speed of each output at all of the first positions."""
    columns = zip(passage.error[:, :_MOST], passage.rate[:, :_MOST], means, strict=True)
    return [(passage.turns[:_MOST], error, (mean + rate) / (mean or 1.0)) for error, rate, mean in columns]


def _thinned(error: Floats, speed: Floats, bins: int) -> NDArray[np.intp]:
    """Return the positions to draw: the first of each bin, its extremes of deviation and speed, and all reversals."""
    turning = np.flatnonzero(np.diff(np.signbit(speed)))[:_MOST]
    extremes = (kept_extremes(values, 3 * bins) for values in (error, speed))
    return np.unique(np.concatenate([*extremes, turning, turning + 1]))


def _angle(panel: Any, trace: _Trace) -> None:
    for values, colour, width, label in ((trace.mean, GREY, 0.8, "mean"), (trace.angle, BLUE, 1.2, "true")):
        panel.plot(*_dial_line(trace.turns, values), color=colour, linewidth=width, label=label)
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    if np.isfinite(back).any():
        panel.plot(*_dial_line(trace.turns, back), color=RED, linewidth=2, label="backward")
    _set_degrees(panel, f"{trace.name}\nangle (deg)")
    legend_above(panel, 3)


def _backward_motion(panel: Any, trace: _Trace) -> None:
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    panel.plot(*_dial_line(trace.turns, back), color=RED, linewidth=1.5)
    _set_degrees(panel, f"{trace.name}\nbackward motion (deg)")


def _set_degrees(panel: Any, label: str) -> None:
    panel.set_ylabel(label)
    panel.set_ylim(0, 360)
    panel.set_yticks(range(0, 361, 90))


def _dial_line(x: Floats, turns: Floats) -> tuple[Floats, Floats]:
    """Return the line of a pointer in degrees modulo 360, interrupted by NaN where the pointer passes 0."""
    degrees = 360 * np.mod(turns, 1)
    cuts = np.flatnonzero(np.abs(np.diff(degrees)) > 180) + 1
    return np.insert(x, cuts, np.nan), np.insert(degrees, cuts, np.nan)


def _error(panel: Any, trace: _Trace) -> None:
    middle = trace.error.mean()
    _curve(panel, trace, np.degrees(trace.error - middle), np.degrees(trace.first[1] - middle))
    panel.set_ylabel(f"{trace.name}\n{trace.kind}\nless its mean (deg)")


def _speed(panel: Any, trace: _Trace) -> None:
    turns, speed = _curve(panel, trace, trace.speed, trace.first[2])
    if (speed < 0).any():
        panel.fill_between(turns, speed, 0, where=speed < 0, color=RED, alpha=0.6, linewidth=0)
    panel.set_ylabel(f"{trace.name}\nspeed divided by mean")


def _curve(panel: Any, trace: _Trace, whole: Floats, first: Floats) -> tuple[Floats, Floats]:
    """Plot a curve and return its abscissae and values.

    If a curve oscillates so often that it would fill its panel, only its beginning is plotted, between its bounds. The
    criterion is the total variation over the range, compared with six times `_TURNING_POINTS` in a wide panel and three
    times in a narrow one.
    """
    turns, values = trace.turns, whole
    room = 6 if panel.get_gridspec().ncols == 1 else 3
    if np.abs(np.diff(whole)).sum() > room * _TURNING_POINTS * np.ptp(whole):
        turning = np.flatnonzero(np.diff(np.sign(np.diff(first))) != 0)
        end = turning[_TURNING_POINTS] if len(turning) > _TURNING_POINTS else len(first)
        turns, values = trace.first[0][:end], first[:end]
        for bound in (whole.min(), whole.max()):
            panel.axhline(bound, color=GREY, linewidth=0.8, linestyle=":")
    panel.plot(turns, values, color=BLUE, linewidth=0.8)
    return turns, values


# --------------------------------------------------------------------------------------------------- torque over a turn


_ABOVE_LEGEND = 20  # points from the title to the upper panel
_MOST_POSITIONS = 6000  # positions drawn of the torque: the first of each interval, its minimum and its maximum
_BINS = 900  # intervals, about one per pixel, over which losses are averaged if there are more positions
_MINIMUM = 1e-9  # relative to all losses: smaller losses are rounding errors
_CUT = 1.5  # axis limit over the 98 % quantile of the torque, which is unbounded near a lock
_MOST_LOSSES = 6
"""Maximum number of parts that are drawn separately, by largest loss; the other parts are drawn as one."""
_OTHERS = 9  # series of the remaining parts, whose fill in print is used by no other part


class _Loss(NamedTuple):
    """Power (n,) lost over the turns in a pair, pin or bearing, or in all parts that are not drawn separately."""

    name: str
    power: Floats
    colour: str


def torque_cycle_figure(found: TorqueCycle, title: str = "") -> Figure:
    r"""Return a figure of the requested torque over a run, with its mean and extremes.

    A panel below the torque shows the losses of gear pairs, couplings and bearings, if there are any.

    Parameters
    ----------
    found : TorqueCycle
        Result of `GearTrain.torques` over some turns.
    title : str
        Title above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Torque, and losses as equivalent torque (power divided by the mean speed of the link) [N m, or
        dimensionless if the torque has no unit], against turns of the input. Intervals in which the train locks are
        shaded.

    Raises
    ------
    QuestionError
        If the torque is unknown at all positions.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("extends: planetary-24-18-60\nloads: {carrier: -10 N m}\nname: loaded")
    >>> torque_cycle_figure(train.torques(turns=1, samples=20)).axes[0].get_ylabel()
    'torque at sun (N m)'
    """
    if found.turns is None or found.torque is None or not np.isfinite(found.torque).any():
        what, fix = "the torque over a turn is not known", "declare loads that the input can drive"
        raise QuestionError(Problem(what, found.verdict.text, fix))
    losses = _losses(found)
    rows = 2 if losses else 1
    figure, panels = curve_panels([2.9] * rows, 0.8)
    unit = f" ({found.unit})" if found.unit else ""
    _torque(panels[0], found, unit)
    if losses:
        _stack(panels[1], found, losses, unit)
    for panel in panels:
        for start, end in found.locked:
            panel.axvspan(start.turns, end.turns, color=PALE, alpha=0.6, linewidth=0, zorder=0, gid="locked")
    panels[0].set_title(title, fontsize=TEXT, loc="left", color=BLACK, parse_math=False, pad=_ABOVE_LEGEND)
    panels[-1].set_xlim(0.0, found.span)
    name_axes(panels[-1], "turns of the input", size=SMALL)
    return figure


def _torque(panel: Axes, found: TorqueCycle, unit: str) -> None:
    assert found.turns is not None
    assert found.torque is not None
    shown = kept_extremes(found.torque, _MOST_POSITIONS)
    panel.plot(found.turns[shown], found.torque[shown], color=BLUE, linewidth=0.9)
    if found.standing is not None and not np.allclose(found.standing, found.torque, equal_nan=True):
        shown = kept_extremes(found.standing, _MOST_POSITIONS)
        panel.plot(
            found.turns[shown], found.standing[shown], color=ORANGE, linewidth=0.8, label="to start it", zorder=1
        )
    if found.mean is not None:
        panel.axhline(found.mean, color=GREY, linewidth=1.0, label=f"mean {found.mean:.5g}")
    marks = (("maximum", found.maximum, "^", RED), ("minimum", found.minimum, "v", GREEN))
    for name, extreme, marker, colour in marks:
        if extreme is not None:
            look: dict[str, Any] = {"color": colour, "markersize": 7, "clip_on": False, "zorder": 5}
            panel.plot(
                [extreme.turns], [extreme.torque], marker, label=f"{name} {extreme.torque:.5g}", gid=name, **look
            )
    if found.locked:
        panel.fill_between([], [], [], color=PALE, alpha=0.6, label=f"locked, {100 * found.locked_share:.3g} %")
    low, high = panel.get_ylim() if not found.locked else _bounds(found.turns, found.torque)
    panel.set_ylim(min(low, 0.0), max(high, 0.0))
    name_axes(panel, y=f"torque at {short(found.link)}{unit}", size=SMALL, parse_math=False)
    legend_above(panel, 5)


def _stack(panel: Axes, found: TorqueCycle, losses: list[_Loss], unit: str) -> None:
    """Draw the losses as a stacked area plot, the largest loss at the bottom."""
    assert found.turns is not None
    turns, powers = _averaged(found.turns, np.array([np.nan_to_num(loss.power) for loss in losses]))
    ratio = _mean_speed(found)
    powers = powers / (ratio or 1.0)
    panel.stackplot(
        turns, powers, colors=[loss.colour for loss in losses], labels=[loss.name for loss in losses], linewidth=0
    )
    panel.set_ylim(0.0, _bounds(turns, powers.sum(axis=0))[1] if found.locked else None)
    of = f"as torque at {short(found.link)}" if ratio else "per radian of the input"
    name_axes(panel, y=f"losses, {of}{unit}", size=SMALL, parse_math=False)
    legend_above(panel, 4)


def _mean_speed(found: TorqueCycle) -> float:
    """Return the mean turns of a link per turn of the input: 0 if the link only swings, 1 if its speed is not known."""
    assert found.turns is not None
    if found.speeds is None or found.link not in found.speeds.labels[0]:
        return 1.0
    speed = np.asarray(found.speeds.values)[found.speeds.labels[0].index(found.link)]
    forth, most = np.trapezoid(speed, found.turns), np.trapezoid(abs(speed), found.turns)
    # the mean speed of a link that swings is only a rounding error
    return float(abs(forth) / found.span) if abs(forth) > _MINIMUM * most else 0.0


def _losses(found: TorqueCycle) -> list[_Loss]:
    """Return the losses of parts in descending order; the parts that are not drawn separately are one loss."""
    if found.losses is None:
        return []
    names, values = found.losses.labels[0], np.asarray(found.losses.values)
    lost = sum(part.loss for part in found.parts.values())
    if not lost > 0:
        return []
    losing = [name for name in names if found.parts[name].loss > _MINIMUM * lost]
    ranked = sorted(losing, key=lambda name: -found.parts[name].loss)
    rows = {name: values[names.index(name)] for name in names}
    shown = ranked[:_MOST_LOSSES] if len(ranked) <= _MOST_LOSSES else ranked[: _MOST_LOSSES - 1]
    losses = [_Loss(short(name, 24), rows[name], series_colour(at)) for at, name in enumerate(shown)]
    if rest := ranked[len(shown) :]:
        losses.append(
            _Loss(f"{len(rest)} others", np.sum([rows[name] for name in rest], axis=0), series_colour(_OTHERS))
        )
    return losses


def _bounds(turns: Floats, values: Floats) -> tuple[float, float]:
    """Return the axis limits of an unbounded curve, from its 2 % and 98 % quantiles; they include 0."""
    even = np.interp(np.linspace(turns[0], turns[-1], _MOST_POSITIONS), turns, values)
    low, high = np.nanquantile(even, (0.02, 0.98))
    return _CUT * min(low, 0.0), _CUT * max(high, 0.0)


def _averaged(turns: Floats, powers: Floats) -> tuple[Floats, Floats]:
    """Return turns and power losses (part, position), averaged over equal intervals if there are many positions."""
    if len(turns) <= 2 * _BINS:
        return turns, powers
    # averages of the integral conserve the energy, whatever the spacing of positions
    work = cumulative_trapezoid(powers, turns, initial=0)
    edges = np.linspace(turns[0], turns[-1], _BINS + 1)
    at_edges = np.array([np.interp(edges, turns, row) for row in work])
    return (edges[1:] + edges[:-1]) / 2, np.diff(at_edges, axis=1) / np.diff(edges)
