"""What real teeth and pins do to outputs while the input turns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from geartrain.plot.library import Figure
from geartrain.plot.parts import BLUE, GREY, WIDTH

if TYPE_CHECKING:
    from geartrain.teeth.base import Floats

_ROW = 220  # pixels of a panel, at 100 to the inch
_MOST = 4000  # points drawn in a panel: of each stretch its least and greatest


def motion_figure(turns: Floats, errors: Mapping[str, Floats], speeds: Mapping[str, Floats]) -> Figure:
    """Transmission error and speed of each output over the input's turns.

    turns    (n,) of the input
    errors   (n,) in rad by output; `speeds` (n,) over their mean by output
    """
    rows = 2 * len(errors)
    figure = Figure(figsize=(WIDTH, max(2, rows) * _ROW / 100), dpi=100, layout="constrained")
    panels = figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]
    for at, name in enumerate(errors):
        for panel, values, label in (
            (panels[2 * at], np.degrees(errors[name] - errors[name].mean()), f"{name}\nerror less its mean (deg)"),
            (panels[2 * at + 1], speeds[name], f"{name}\nspeed over mean"),
        ):
            panel.plot(*_envelope(turns, values), color=BLUE, linewidth=0.8)
            panel.set_ylabel(label)
            panel.grid(color=GREY, alpha=0.25)
            panel.spines[["top", "right"]].set_visible(False)
    panels[-1].set_xlabel("turns of the input")
    return figure


def _envelope(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """No more points than can be seen: of each stretch the first, the least and the greatest in their order."""
    if len(x) <= _MOST:
        return x, y
    bins = np.array_split(np.arange(len(x)), _MOST // 3)
    kept = np.unique(np.concatenate([[b[0], b[np.argmin(y[b])], b[np.argmax(y[b])]] for b in bins]))
    return x[kept], y[kept]
