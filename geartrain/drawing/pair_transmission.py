"""The transmission function of any pair over two pitches of its driver: error, speed ratio, efficiency."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.backend import Figure
from geartrain.drawing.style import BLACK, GREY, TEXT, WIDTH, plain

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction

_SAMPLES = 1601
_LOST = 1e-12  # of the power: less is rounding
_LABELS = ("transmission error\n(deg, driven)", "speed ratio\nover its mean", "efficiency")


def transmission_figure(law: TransmissionFunction, title: str) -> Figure:
    """Any transmission function over two periods: transmission error, speed ratio and efficiency on the drive flanks.

    Parameters
    ----------
    law : TransmissionFunction
        Of a pair of any form.
    title : str
        Above the first panel.

    Returns
    -------
    matplotlib.figure.Figure
        Three panels over the driver's angle [deg], two where nothing is lost; corners of the law as thin lines.

    Examples
    --------
    >>> import geartrain
    >>> law = geartrain.load("moon-triangular").meshes[0].law
    >>> transmission_figure(law, "a pair").axes[-1].get_xlabel()
    "driver's angle (deg)"
    """
    S = np.linspace(0, 2 * law.period, _SAMPLES)
    curves = (np.degrees(law.error(S)), law.speed(S) / float(law.ratio), law.efficiency(S))
    corners = {(corner % law.period) + k * law.period for corner in law.corners() for k in (0, 1)}
    shown = len(curves) if np.abs(curves[-1] - 1).max() > _LOST else len(curves) - 1
    figure = Figure(figsize=(WIDTH, 2.5 * shown), layout="constrained")
    panels = figure.subplots(shown, 1, sharex=True)
    for axes, y, label in zip(panels, curves[:shown], _LABELS, strict=False):
        plain(axes)
        axes.set_ylabel(label, fontsize=TEXT)
        for corner in sorted(corners):
            axes.axvline(np.degrees(corner), color=GREY, linewidth=0.5)
        axes.plot(np.degrees(S), y, color=BLACK, linewidth=1.2)
    whole = title if shown == len(curves) else f"{title}; without friction nothing is lost"
    panels[0].set_title(whole, fontsize=TEXT, loc="left", color=BLACK)
    panels[-1].set_xlabel("driver's angle (deg)", fontsize=TEXT)
    return figure
