"""Torque at the crank over some turns of the input, and what is lost where meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.drawing.backend import Axes, Figure
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
    kept_extremes,
    legend_above,
    plain,
    short,
)
from geartrain.errors import Problem, QuestionError
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from geartrain.dynamics import TorqueCycle, TorqueExtreme
    from geartrain.numerics.arrays import Floats

_ABOVE_LEGEND = 20  # points from the title to the upper panel
_MOST = 6000  # positions drawn of the torque: of each stretch the first, its least and its greatest
_BINS = 900  # pixels: stretches of the run over which losses are averaged where there are more positions
_LEAST = 1e-9  # of all that is lost: less is rounding
_CUT = 1.5  # times the torque that is exceeded in a fiftieth of the run: near a lock it has no bound
_MOST_LOSSES = 6
"""Of the parts that lose most; all others are drawn as one."""
_OTHERS = 9  # their series, whose filling in print no part that is shown has


class _Loss(NamedTuple):
    """What a pair, pin or bearing, or all that are not shown by themselves, lose over the turns (n,)."""

    name: str
    power: Floats
    colour: str


def torque_cycle_figure(found: TorqueCycle, title: str = "") -> Figure:
    """Torque at the crank over the run, with its mean and extremes, and below it what is lost where.

    Parameters
    ----------
    found : TorqueCycle
        From `GearTrain.torques` over some turns.
    title : str
        What stands above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Torque, and what is lost as a share of it: power over the mean speed of the link [N m, or plain]; over turns of
        the input, shaded where the train locks.

    Raises
    ------
    QuestionError
        If the torque is known nowhere.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load("extends: planetary-24-18-60\\nloads: {carrier: -10 N m}\\nname: loaded")
    >>> torque_cycle_figure(train.torques(turns=1, samples=20)).axes[0].get_ylabel()
    'torque at sun (N m)'
    """
    if found.turns is None or found.torque is None or not np.isfinite(found.torque).any():
        raise QuestionError(
            Problem("there is no torque over a turn to draw", found.verdict.text, "declare loads that can be moved")
        )
    losses = _losses(found)
    rows = 2 if losses else 1
    figure = Figure(figsize=(WIDTH, 0.8 + 2.9 * rows), dpi=100, layout="constrained")
    panels = figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]
    unit = f" ({found.unit})" if found.unit else ""
    _torque(panels[0], found, unit)
    if losses:
        _stack(panels[1], found, losses, unit)
    for panel in panels:
        plain(panel)
        for start, end in found.locked:
            panel.axvspan(start.turns, end.turns, color=PALE, alpha=0.6, linewidth=0, zorder=0, gid="locked")
    panels[0].set_title(title, fontsize=TEXT, loc="left", color=BLACK, parse_math=False, pad=_ABOVE_LEGEND)
    panels[-1].set_xlim(0.0, found.span)
    panels[-1].set_xlabel("turns of the input", fontsize=SMALL)
    return figure


def _torque(panel: Axes, found: TorqueCycle, unit: str) -> None:
    assert found.turns is not None
    assert found.torque is not None
    shown = kept_extremes(found.torque, _MOST)
    panel.plot(found.turns[shown], found.torque[shown], color=BLUE, linewidth=0.9)
    if found.standing is not None and not np.allclose(found.standing, found.torque, equal_nan=True):
        shown = kept_extremes(found.standing, _MOST)
        panel.plot(
            found.turns[shown], found.standing[shown], color=ORANGE, linewidth=0.8, label="to start it", zorder=1
        )
    if found.mean is not None:
        panel.axhline(found.mean, color=GREY, linewidth=1.0, label=f"mean {found.mean:.5g}")
    marks = (("greatest", found.greatest, "^", RED), ("least", found.least, "v", GREEN))
    for name, extreme, marker, colour in marks:
        if extreme is not None:
            _mark(panel, name, extreme, marker, colour)
    if found.locked:
        panel.fill_between([], [], [], color=PALE, alpha=0.6, label=f"locked, {100 * found.locked_share:.3g} %")
    low, high = panel.get_ylim() if not found.locked else _bounds(found.turns, found.torque)
    panel.set_ylim(min(low, 0.0), max(high, 0.0))
    panel.set_ylabel(f"torque at {short(found.link)}{unit}", fontsize=SMALL, parse_math=False)
    legend_above(panel, 5)


def _mark(panel: Axes, name: str, extreme: TorqueExtreme, marker: str, colour: str) -> None:
    label = f"{name} {extreme.torque:.5g}"
    panel.plot(
        [extreme.turns],
        [extreme.torque],
        marker,
        color=colour,
        markersize=7,
        label=label,
        clip_on=False,
        zorder=5,
        gid=name,
    )


def _stack(panel: Axes, found: TorqueCycle, losses: list[_Loss], unit: str) -> None:
    """The losses one upon the other, that of which most is lost at the bottom."""
    assert found.turns is not None
    turns, powers = _averaged(found.turns, np.array([np.nan_to_num(loss.power) for loss in losses]))
    ratio = _mean_speed(found)
    powers = powers / (ratio or 1.0)
    panel.stackplot(
        turns,
        powers,
        colors=[loss.colour for loss in losses],
        labels=[loss.name for loss in losses],
        linewidth=0,
    )
    panel.set_ylim(0.0, _bounds(turns, powers.sum(axis=0))[1] if found.locked else None)
    of = f"as torque at {short(found.link)}" if ratio else "a radian of the input"
    panel.set_ylabel(f"lost, {of}{unit}", fontsize=SMALL, parse_math=False)
    legend_above(panel, 4)


def _mean_speed(found: TorqueCycle) -> float:
    """Turns of the link in a turn of the input; 0 where it comes back to where it was."""
    assert found.turns is not None
    if found.speeds is None or found.link not in found.speeds.labels[0]:
        return 1.0
    speed = np.asarray(found.speeds.values)[found.speeds.labels[0].index(found.link)]
    steps = np.diff(found.turns)
    forth, most = steps @ (speed[1:] + speed[:-1]) / 2, steps @ (abs(speed[1:]) + abs(speed[:-1])) / 2
    return float(abs(forth) / found.span) if abs(forth) > _LEAST * most else 0.0


def _losses(found: TorqueCycle) -> list[_Loss]:
    """What loses anything, the greatest first; what has no colour of its own is one."""
    if found.losses is None:
        return []
    names, values = found.losses.labels[0], np.asarray(found.losses.values)
    lost = sum(part.loss for part in found.parts.values())
    if not lost > 0:
        return []
    losing = [name for name in names if found.parts[name].loss > _LEAST * lost]
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
    """What is worth drawing of a course that has no bound."""
    even = np.interp(np.linspace(turns[0], turns[-1], _MOST), turns, values)
    low, high = np.nanquantile(even, (0.02, 0.98))
    return _CUT * min(low, 0.0), _CUT * max(high, 0.0)


def _averaged(turns: Floats, powers: Floats) -> tuple[Floats, Floats]:
    """Losses as they are, or their means over equal stretches of the run; powers (part, position)."""
    if len(turns) <= 2 * _BINS:
        return turns, powers
    steps = np.diff(turns)
    work = np.concatenate(
        [np.zeros((len(powers), 1)), np.cumsum(steps * (powers[:, 1:] + powers[:, :-1]) / 2, axis=1)], axis=1
    )
    edges = np.linspace(turns[0], turns[-1], _BINS + 1)
    at_edges = np.array([np.interp(edges, turns, row) for row in work])
    return (edges[1:] + edges[:-1]) / 2, np.diff(at_edges, axis=1) / np.diff(edges)
