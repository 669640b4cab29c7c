"""What a flat train's plan shows: wheels with their teeth from the lowest layer up, arms, waves, pins and slots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb

from geartrain.drawing.backend import Circle, Path, PathPatch, Polygon
from geartrain.drawing.oblique_side_views import draw_across
from geartrain.drawing.projection import ProjectedScene, ScaledPage, arms_of, broken_wheels, coupling_spans
from geartrain.drawing.style import BLACK, BLUE, FILL, ORANGE, PURPLE, RED, SHADE
from geartrain.scene import SceneCoupling, SceneWheel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats

_FAR, _NEAR = np.array(to_rgb(SHADE)), np.array(to_rgb(FILL))  # colours of the lowest and highest layer
_ONLY = 0.7  # from the lowest layer's colour to the highest's, of a train in one layer
_CHORD, _COARSE = 0.002, 0.02  # inches and modules that an outline may leave its teeth by


def from_below(standing: ProjectedScene) -> list[SceneWheel]:
    """Wheels in the order in which they are drawn."""
    return sorted(
        standing.scene.wheels, key=lambda wheel: (float(standing.seen(standing.centre(wheel))[2]), -wheel.radius)
    )


def draw_flat(page: ScaledPage, standing: ProjectedScene) -> None:
    """All of them, on a page."""
    scene, wheels = standing.scene, from_below(standing)
    heights = sorted({round(float(standing.seen(standing.centre(wheel))[2]), 6) for wheel in wheels})
    red = broken_wheels(scene)
    for order, wheel in enumerate(wheels):
        place = heights.index(round(float(standing.seen(standing.centre(wheel))[2]), 6))
        level = place / (len(heights) - 1) if len(heights) > 1 else _ONLY
        if not standing.faces(wheel):
            draw_across(page.axes, standing, wheel, page.at, red, 2 + order / len(wheels))
            continue
        _draw_wheel(page, standing, wheel, level, 2 + order / len(wheels), wheel.id in red)
    _draw_arms(page, standing)
    _draw_waves(page, standing)
    for coupling in scene.couplings:
        _draw_coupling(page, standing, coupling)
    for spot in {tuple(np.round(page.at(standing.seen(standing.centre(wheel))), 4)) for wheel in wheels}:
        page.axes.add_artist(Circle(spot, 0.035, facecolor=BLACK, edgecolor="white", linewidth=0.5, zorder=6))


def _draw_wheel(
    page: ScaledPage, standing: ProjectedScene, wheel: SceneWheel, level: float, order: float, red: bool
) -> None:
    chord = min(_CHORD / page.scale, _COARSE * wheel.module)
    outline = page.at(standing.seen(standing.outline(wheel, chord=chord)))
    face = (*(_FAR + (_NEAR - _FAR) * level), 0.78)
    style: dict[str, Any] = {"edgecolor": RED if red else BLACK, "linewidth": 1.2 if red else 0.6, "zorder": order}
    if wheel.kind == "ring":
        rim = page.at(standing.seen(standing.circle(wheel, wheel.root * 1.1)))
        page.axes.add_artist(PathPatch(_hollow(rim, outline), facecolor=face, gid=f"wheel {wheel.id}", **style))
    elif wave := standing.wave(wheel):
        bore = page.at(standing.seen(standing.bore(wave)))
        page.axes.add_artist(PathPatch(_hollow(outline, bore), facecolor=face, gid=f"wheel {wheel.id}", **style))
    else:
        page.axes.add_artist(Polygon(outline, facecolor=face, gid=f"wheel {wheel.id}", **style))
    for pin in standing.pins(wheel):
        page.axes.add_artist(Polygon(page.at(standing.seen(pin)), facecolor="white", **style))
    centre = page.at(standing.seen(standing.centre(wheel)))
    page.axes.add_artist(
        Circle(
            (float(centre[0]), float(centre[1])),
            wheel.radius * page.scale,
            fill=False,
            edgecolor=RED if red else BLUE,
            linewidth=0.6,
            linestyle="-.",
            zorder=order,
            gid=f"pitch {wheel.id}",
        )
    )


def _hollow(outer: Floats, inner: Floats) -> Path:
    """What lies between two closed lines."""
    codes = [
        code for line in (outer, inner) for code in (Path.MOVETO, *[Path.LINETO] * (len(line) - 1), Path.CLOSEPOLY)
    ]
    return Path(np.concatenate([outer, outer[:1], inner[::-1], inner[-1:]]), codes)


def _draw_arms(page: ScaledPage, standing: ProjectedScene) -> None:
    arms = list(arms_of(standing))
    wide = 4.5 if len(arms) < 6 else 2.5
    for body, start, end in arms:
        line = page.at(standing.seen(np.array([start, end])))
        name = f"arm {standing.scene.bodies[body].id}"
        page.axes.plot(*line.T, color="white", linewidth=wide + 2, solid_capstyle="round", zorder=4)
        page.axes.plot(*line.T, color=ORANGE, linewidth=wide, solid_capstyle="round", zorder=4, gid=name)


def _draw_waves(page: ScaledPage, standing: ProjectedScene) -> None:
    """The generator, from its axis to where it presses a thin wheel out."""
    for wave in standing.scene.waves:
        name = f"wave {standing.scene.bodies[wave.by].id}"
        page.axes.add_artist(
            Polygon(page.at(standing.seen(standing.bore(wave))), fill=False, edgecolor=ORANGE, zorder=4)
        )
        hub = standing.centre(standing.scene.wheels[wave.wheel])
        for lobe in standing.lobes(wave):
            line = page.at(standing.seen(np.array([hub, lobe])))
            page.axes.plot(*line.T, color=ORANGE, linewidth=2.5, solid_capstyle="butt", zorder=4, gid=name)


def _draw_coupling(page: ScaledPage, standing: ProjectedScene, coupling: SceneCoupling) -> None:
    """The pin, and the slot as far as the pin goes; or pins in their holes."""
    if coupling.hole:
        _draw_holes(page, standing, coupling)
        return
    pin = page.at(standing.seen(standing.pose.point(coupling.pin, coupling.pin_at)))
    (ends,) = coupling_spans(standing, coupling, page.at, page.scale)
    page.axes.plot(*ends.T, color=PURPLE, linewidth=5.5, solid_capstyle="round", zorder=5, gid=f"slot {coupling.id}")
    page.axes.plot(*ends.T, color="white", linewidth=3.0, solid_capstyle="round", zorder=5)
    spot = (float(pin[0]), float(pin[1]))
    page.axes.add_artist(Circle(spot, 0.045, facecolor=PURPLE, edgecolor=BLACK, zorder=6, gid=f"pin {coupling.id}"))


def _draw_holes(page: ScaledPage, standing: ProjectedScene, coupling: SceneCoupling) -> None:
    for what, body, places, size in (
        ("hole", coupling.slot, coupling.holes_at, coupling.hole),
        ("pin", coupling.pin, coupling.pins_at, coupling.pin_diameter),
    ):
        for at, place in enumerate(places):
            x, y = page.at(standing.seen(standing.pose.point(body, place)))
            gid = f"{what} {at + 1} {coupling.id}"
            round_ = Circle((float(x), float(y)), size / 2 * page.scale, zorder=5, gid=gid)
            face, edge = ("white", PURPLE) if what == "hole" else (PURPLE, BLACK)
            round_.set(facecolor=face, edgecolor=edge, linewidth=0.8)
            page.axes.add_artist(round_)
