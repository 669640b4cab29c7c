"""The transmission function of any pair over two pitches of its driver: error, speed ratio, efficiency."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geartrain.drawing.backend import Figure
from geartrain.drawing.style import BLACK, GREY, TEXT, WIDTH, plain

if TYPE_CHECKING:
    from geartrain.teeth.transmission import TransmissionFunction

_SAMPLES = 1601
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
        Three panels over the driver's angle [deg]; corners of the law as thin lines.

    Examples
    --------
    >>> import geartrain
    >>> law = geartrain.load("moon-triangular").meshes[0].law
    >>> transmission_figure(law, "a pair").axes[-1].get_xlabel()
    "driver's angle (deg)"
    """
    figure = Figure(figsize=(WIDTH, 7.5), layout="constrained")
    S = np.linspace(0, 2 * law.period, _SAMPLES)
    curves = (np.degrees(law.error(S)), law.speed(S) / float(law.ratio), law.efficiency(S))
    corners = {(corner % law.period) + k * law.period for corner in law.corners() for k in (0, 1)}
    panels = figure.subplots(3, 1, sharex=True)
    for axes, y, label in zip(panels, curves, _LABELS, strict=True):
        plain(axes)
        axes.set_ylabel(label, fontsize=TEXT)
        for corner in sorted(corners):
            axes.axvline(np.degrees(corner), color=GREY, linewidth=0.5)
        axes.plot(np.degrees(S), y, color=BLACK, linewidth=1.2)
    panels[0].set_title(title, fontsize=TEXT, loc="left", color=BLACK)
    panels[-1].set_xlabel("driver's angle (deg)", fontsize=TEXT)
    return figure
