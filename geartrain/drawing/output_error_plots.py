"""What real teeth and pins do to outputs while the input turns."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.drawing.backend import Figure
from geartrain.drawing.style import BLUE, GREY, RED, WIDTH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.dynamics import MotionRun
    from geartrain.numerics.arrays import Floats


_ROW = 200  # pixels of a panel, at 100 to the inch
_MOST = 6000  # points drawn in a panel: of each stretch the first, its least and its greatest
_ROUNDS = 15  # turns of a pointer beyond which its angle would be a grey block


class _Trace(NamedTuple):
    """One output over the turns of the input: angle (turns), error (rad), speed over the mean (or the input's)."""

    name: str
    turns: Floats
    angle: Floats
    mean: Floats
    error: Floats
    speed: Floats


def motion_figure(run: MotionRun, on_done: Callable[[int], None] = lambda _: None) -> Figure:
    """Of each output: its angle against its mean motion, its error and its speed; in red where it goes back.

    Parameters
    ----------
    run : MotionRun
        What to follow: outputs, turns and positions; it need not have gone.
    on_done : callable
        Called with the number of positions that have been worked out since.

    Returns
    -------
    matplotlib.figure.Figure
        Angles and errors [deg], speeds over that of the input, over turns of the input.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.dynamics import MotionRun
    >>> run = MotionRun(geartrain.load("moon-triangular").motion(), turns=0.1, samples=51)
    >>> motion_figure(run).axes[-1].get_xlabel()
    'turns of crank'
    """
    traces = _traces(run, on_done)
    panels_of = [_drawers(trace) for trace in traces]
    rows = sum(map(len, panels_of))
    figure = Figure(figsize=(WIDTH, max(2, rows) * _ROW / 100), dpi=100, layout="constrained")
    panels = iter(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])
    for trace, drawers in zip(traces, panels_of, strict=True):
        for drawer in drawers:
            panel = next(panels)
            drawer(panel, trace)
            panel.grid(color=GREY, alpha=0.25)
            panel.spines[["top", "right"]].set_visible(False)
    panel.set_xlabel(f"turns of {run.motion.train.lead}")
    return figure


def _drawers(trace: _Trace) -> list[Callable[[Any, _Trace], None]]:
    """Over few rounds the pointer's whole way; over many, only where it goes back."""
    if np.ptp(trace.mean) <= _ROUNDS:
        return [_angle, _error, _speed]
    return [_arcs, _error, _speed] if (trace.speed < 0).any() else [_error, _speed]


def _traces(run: MotionRun, on_done: Callable[[int], None]) -> list[_Trace]:
    """Every output, thinned stretch by stretch to what can be seen."""
    motion = run.motion
    parts: list[list[tuple[Floats, Floats, Floats]]] = [[] for _ in motion.outputs]
    means = [tally.mean for tally in motion.tallies()]
    for passage in motion.passages(run.turns, run.samples):
        share = max(1, round(_MOST / 3 * len(passage.turns) / run.samples))
        for at, part in enumerate(parts):
            kept = _kept(passage.error[at], means[at] + passage.rate[at], share)
            part.append((passage.turns[kept], passage.error[at][kept], passage.rate[at][kept]))
        on_done(len(passage.turns))
    found = []
    for tally, start, part in zip(motion.tallies(), motion.starts, parts, strict=True):
        turns, error, rate = (np.concatenate(column) for column in zip(*part, strict=True))
        mean = start / (2 * np.pi) + tally.mean * turns
        angle = mean + error / (2 * np.pi)
        found.append(_Trace(tally.name, turns, angle, mean, error, (tally.mean + rate) / (tally.mean or 1.0)))
    return found


def _kept(error: Floats, speed: Floats, bins: int) -> NDArray[np.intp]:
    """Of each bin the first position and those of the least and greatest error and speed; and every turning back."""
    if len(error) <= 3 * bins:
        return np.arange(len(error))
    kept: list[Any] = []
    for part in np.array_split(np.arange(len(error)), bins):
        kept += [part[0], *(part[find(y[part])] for y in (error, speed) for find in (np.argmin, np.argmax))]
    turning = np.flatnonzero(np.diff(np.signbit(speed)))
    return np.unique(np.concatenate([kept, turning[:_MOST], turning[:_MOST] + 1]))


def _angle(panel: Any, trace: _Trace) -> None:
    for values, colour, width, label in ((trace.mean, GREY, 0.8, "mean"), (trace.angle, BLUE, 1.2, "true")):
        panel.plot(*_broken(trace.turns, values), color=colour, linewidth=width, label=label)
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    if np.isfinite(back).any():
        panel.plot(*_broken(trace.turns, back), color=RED, linewidth=2, label="going back")
    _dial(panel, f"{trace.name}\nangle (deg)")
    panel.legend(loc="lower right", bbox_to_anchor=(1, 1), borderpad=0, frameon=False, fontsize="small", ncols=3)


def _arcs(panel: Any, trace: _Trace) -> None:
    back = np.where(trace.speed < 0, trace.angle, np.nan)
    panel.plot(*_broken(trace.turns, back), color=RED, linewidth=1.5)
    _dial(panel, f"{trace.name}\nwhere it goes back (deg)")


def _dial(panel: Any, label: str) -> None:
    panel.set_ylabel(label)
    panel.set_ylim(0, 360)
    panel.set_yticks(range(0, 361, 90))


def _broken(x: Floats, turns: Floats) -> tuple[Floats, Floats]:
    """Degrees round the dial, the line broken where the pointer passes 0."""
    degrees = 360 * np.mod(turns, 1)
    cuts = np.flatnonzero(np.abs(np.diff(degrees)) > 180) + 1
    return np.insert(x, cuts, np.nan), np.insert(degrees, cuts, np.nan)


def _error(panel: Any, trace: _Trace) -> None:
    panel.plot(trace.turns, np.degrees(trace.error - trace.error.mean()), color=BLUE, linewidth=0.8)
    panel.set_ylabel(f"{trace.name}\nerror less its mean (deg)")


def _speed(panel: Any, trace: _Trace) -> None:
    panel.plot(trace.turns, trace.speed, color=BLUE, linewidth=0.8)
    if (trace.speed < 0).any():
        panel.fill_between(trace.turns, trace.speed, 0, where=trace.speed < 0, color=RED, alpha=0.6, linewidth=0)
    panel.set_ylabel(f"{trace.name}\nspeed over mean")
