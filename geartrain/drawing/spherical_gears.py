"""Picture of gears on a sphere in orthographic projection: near gears over far gears, teeth at their angles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb

from geartrain.drawing.projection import screen_of
from geartrain.drawing.style import BLACK, GREY, PALE, SMALL, WHITE, Circle, Figure, Patch, Polygon, headed
from geartrain.numerics.exact import plural
from geartrain.scene.palette import series_colour

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.spherical import Configuration


_SIZE = 7.5  # inches: side of the figure
_VIEW = (0.32, -0.43, 0.84)  # direction towards the reader
_TOOTH = np.array([-0.30, -0.17, 0.17, 0.30])  # foot, tip, tip, foot, in pitches from the middle of a tooth
_STRONG = 0.55  # opacity of a face
_TIP, _FOOT = 0.9, -1.1  # modules from the pitch cone


def sphere_figure(
    configuration: Configuration, cones: Floats, phases: Sequence[float], view: tuple[float, float, float] = _VIEW
) -> Figure:
    """Return a figure of all gears of a set on their common sphere, in orthographic projection.

    Parameters
    ----------
    configuration : Configuration
        Axes, kinds, tooth numbers and meshes of the set.
    cones : array of shape (gears,)
        Half angle of each pitch cone [rad] (docs/sphere.md, equation 1).
    phases : sequence of float
        Phase of each gear [pitch]: angle of a tooth from the reference direction of the gear.
    view : tuple of three floats
        Direction from the sphere to the viewer.

    Returns
    -------
    matplotlib.figure.Figure
        Picture of the sphere; gears on the far side are pale.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron
    >>> from geartrain.spherical.gear_sphere import GearSphere
    >>> found = GearSphere(from_polyhedron("cube", teeth=12), 1.0)
    >>> len(sphere_figure(*found.pose()).axes)
    1
    """
    figure = Figure(figsize=(_SIZE, _SIZE), dpi=100, layout="constrained")
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_xlim(-1.12, 1.12)
    axes.set_ylim(-1.12, 1.12)
    screen = screen_of(np.asarray(view, dtype=float))
    kinds = list(dict.fromkeys(configuration.kinds))
    towards = configuration.axes @ screen[2]
    axes.add_patch(Circle((0.0, 0.0), 1.0, fill=False, edgecolor=GREY, linewidth=0.8))
    # painter's algorithm, by the height of the plane of each pitch circle towards the reader
    for i in np.argsort(towards * np.cos(cones)):
        near = towards[i] > 0
        face = _face(kinds.index(configuration.kinds[i])) if near else (*to_rgb(PALE), 0.5)
        ring = _outline(configuration, int(i), float(cones[i]), float(phases[i])) @ screen.T
        if near:
            axes.add_patch(Polygon(ring[:, :2], facecolor=WHITE, edgecolor="none"))
        edge = (*to_rgb(BLACK), 1.0 if near else 0.5)
        axes.add_patch(Polygon(ring[:, :2], facecolor=face, edgecolor=edge, linewidth=0.5))
        if near:
            x, y, _ = configuration.axes[i] @ screen.T
            axes.plot(x, y, marker="o", markersize=2.5, color=BLACK)
    _legend(axes, configuration, kinds)
    return headed(figure, configuration.title)


def _face(kind: int) -> tuple[float, float, float, float]:
    """Return the face colour (RGBA) of a kind of gear, translucent so that overlapping teeth of mates are visible."""
    return (*to_rgb(series_colour(kind)), _STRONG)


def _outline(configuration: Configuration, i: int, cone: float, phase: float) -> Floats:
    """Return the outline of a gear, including its teeth, as points (n, 3) on the unit sphere."""
    count = configuration.teeth[configuration.kinds[i]]
    module = 2 * np.sin(cone) / count
    polar = cone + module * np.tile([_FOOT, _TIP, _TIP, _FOOT], count)
    azimuth = 2 * np.pi / count * (phase + np.repeat(np.arange(count), len(_TOOTH)) + np.tile(_TOOTH, count))
    first, second = configuration.frame(i)
    around = np.cos(azimuth)[:, None] * first + np.sin(azimuth)[:, None] * second
    ring: Floats = np.cos(polar)[:, None] * configuration.axes[i] + np.sin(polar)[:, None] * around
    return ring


def _legend(axes: Any, configuration: Configuration, kinds: list[str]) -> None:
    handles = []
    for at, kind in enumerate(kinds):
        number = configuration.kinds.count(kind)
        text = f"{kind}: {plural(number, 'gear')} of {configuration.teeth[kind]} teeth"
        handles.append(Patch(facecolor=_face(at), edgecolor=BLACK, linewidth=0.5, label=text))
    axes.legend(handles=handles, loc="lower left", frameon=False, fontsize=SMALL)
