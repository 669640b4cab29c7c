"""Symbols of a stick diagram: bearings, slides, fixed links, brakes, clutches and couplings, as in ISO 3952.

All positions and sizes are in inches. A symbol that joins two shafts is drawn in one column between them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.drawing.arrangement import text_width
from geartrain.drawing.style import BLACK, BLUE, GREY, ORANGE, PURPLE, Axes, Polygon, Rectangle

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geartrain.train.states import Clutch

LINK, WHEEL, CARRIER, COUPLING = 1.1, 2.8, 4.0, 1.8
"""Line widths of links, wheels, carriers and couplings [pt], which distinguish them without colour."""
PLATE, STEM = 2.6, 1.6
"""Line widths of a plate of a brake or clutch and of its stem [pt]."""
TICK = 0.085
"""Half-length of a tooth mark [in]."""
TOUCH = 0.032
"""Distance from the point where two wheels touch to the middle of each wheel's tooth mark [in]."""
BEARING, BAR = 0.07, 0.05
"""Half-length of the two bars of a bearing, and the distance of the bars from the shaft [in]."""
NAME = 8.0
"""Font size of the name of a brake or clutch [pt]."""
_HALF = 0.11  # half the height of a plate
_CLOSED, _OPEN, _ROLLER = 0.018, 0.045, 0.06  # half the gap between plates; of a one-way clutch in addition
_PULLEY = (0.05, 0.12)  # half the width and half the height of a pulley
_STRAND = 0.025  # from the middle of a belt to one of its strands


def draw_line(axes: Axes, xs: list[float], ys: list[float], color: str, width: float, **how: Any) -> None:
    """Draw a line with a width in points. By default, the line has butt caps."""
    axes.plot(xs, ys, color=color, linewidth=width, **{"solid_capstyle": "butt", **how})


def _box(axes: Axes, x: float, y: float, half: tuple[float, float], color: str, **how: Any) -> None:
    box = Rectangle((x - half[0], y - half[1]), 2 * half[0], 2 * half[1], **{"zorder": 4, **how})
    box.set(facecolor="white", edgecolor=color, linewidth=1.4)
    axes.add_artist(box)


def draw_ground(axes: Axes, x: float, y: float, upright: bool = False) -> None:
    """Draw the hatching of the frame around a point, on a horizontal or (`upright`) vertical surface."""
    wide, high = (0.045, 0.09) if upright else (0.09, 0.045)
    box = Rectangle((x - wide, y - high), 2 * wide, 2 * high, hatch="//////", zorder=4, gid="ground")
    box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
    axes.add_artist(box)


def draw_bearing(axes: Axes, x: float, y: float, color: str = BLACK, slides: bool = False) -> None:
    """Draw a bearing as two bars along a shaft. For a link that slides, draw the bars as the sides of a guide box."""
    if slides:
        _box(axes, x, y, (BEARING, BAR), color, gid="guide")
    for side in (-1, 1) if not slides else ():
        level = y + BAR * side
        width = WHEEL if color == ORANGE else STEM
        draw_line(axes, [x - BEARING, x + BEARING], [level, level], color, width, zorder=7, gid="bearing")


# ------------------------------------------------------------------------------------------------- brakes and clutches


def element_width(name: str) -> float:
    """Return the width [in] of a column that contains a brake or clutch and its name."""
    return max(0.46, text_width(name, NAME, "bold") + 0.12)


def draw_element(
    axes: Axes, name: str, clutch: Clutch, closed: bool, place: tuple[float, float], ends: Sequence[float | None]
) -> None:
    """Draw the plates of a brake or clutch, which are close together if it is closed.

    A one-way clutch has a triangle, which points to the plate that can overrun the other plate.

    place   middle of the plates [in]
    ends    height of the shaft of each link [in], or None for the frame
    """
    x, middle = place
    color = PURPLE if closed else GREY
    gap = (_CLOSED if closed else _OPEN) + (_ROLLER if clutch.one_way else 0.0)
    for side, foot in zip((-1, 1), ends, strict=True):
        plate = x + side * gap
        draw_line(axes, [plate] * 2, [middle - _HALF, middle + _HALF], color, PLATE, zorder=4, gid=f"element {name}")
        if foot is None:
            draw_line(axes, [plate, plate + 0.05 * side], [middle, middle], color, STEM, zorder=3)
            draw_ground(axes, plate + 0.095 * side, middle, upright=True)
        else:
            draw_line(axes, [plate] * 2, [foot, middle], color, STEM, zorder=3, gid=f"stem {name}")
    if clutch.one_way is not None:
        way = 1 if clutch.one_way == "forward" else -1
        reach, high = (gap - 0.015) * way, 0.07
        corners = [(x - reach, middle - high), (x - reach, middle + high), (x + reach, middle)]
        axes.add_artist(Polygon(corners, facecolor=color, zorder=4, gid=f"one-way {name}"))


# ----------------------------------------------------------------------------------------------------------- couplings


def draw_belt(axes: Axes, x: float, ends: tuple[float, float], crossed: bool, name: str) -> None:
    """Draw two pulleys at the heights `ends` [in], and both strands of the belt between them, which may cross."""
    for y in ends:
        _box(axes, x, y, _PULLEY, PURPLE, gid=f"pulley {name}")
    low, high = min(ends) + _PULLEY[1], max(ends) - _PULLEY[1]
    for side in (-_STRAND, _STRAND):
        xs = [x + side, x - side if crossed else x + side]
        draw_line(axes, xs, [low, high], PURPLE, 0.9, zorder=3, gid=f"coupling {name}")


def draw_screw(axes: Axes, x: float, screw: float, nut: float, name: str) -> None:
    """Draw a nut on the threaded shaft at the height `screw` [in], and a stem to its link at the height `nut`."""
    _stem(axes, x, nut, screw, name)
    _box(axes, x, screw, (0.11, 0.07), PURPLE, gid=f"nut {name}")
    xs = [x - 0.11 + 0.22 * at / 8 for at in range(9)]
    draw_line(axes, xs, [screw + 0.05 * (-1) ** at for at in range(9)], PURPLE, 1.0, zorder=8, gid=f"thread {name}")


def draw_rack(axes: Axes, x: float, meet: float, ends: tuple[float, float], name: str) -> None:
    """Draw a pinion and a toothed bar that touch at the height `meet`, each on a stem from a shaft at `ends` [in]."""
    side = 1 if ends[1] > meet else -1
    for foot, level, half, color in (
        (ends[0], meet - 0.032 * side, TICK, BLUE),
        (ends[1], meet + 0.032 * side, 0.24, PURPLE),
    ):
        _stem(axes, x, foot, level, name, color)
        draw_line(axes, [x - half, x + half], [level, level], color, WHEEL, zorder=4, gid="teeth")


def draw_drum(axes: Axes, x: float, drum: float, link: float, name: str) -> None:
    """Draw a drum on its shaft, and a line from the drum to the link that slides."""
    _box(axes, x, drum, _PULLEY, PURPLE, gid=f"pulley {name}")
    _stem(axes, x, link, drum + (0.12 if link > drum else -0.12), name, width=0.9)


def draw_joint(axes: Axes, x: float, meet: float, ends: tuple[float, float], kind: str, name: str) -> None:
    """Draw a universal joint as a cross in a circle, and any other kind of transmission as a box with a diagonal."""
    for foot in ends:
        _stem(axes, x, foot, meet, name)
    if kind == "universal_joint":
        axes.plot([x], [meet], "o", color="white", markeredgecolor=PURPLE, markersize=11, zorder=5, gid=f"joint {name}")
        axes.plot([x], [meet], "x", color=PURPLE, markersize=6, markeredgewidth=1.4, zorder=6)
    else:
        _box(axes, x, meet, (0.09, 0.09), PURPLE, gid=f"box {name}")
        draw_line(axes, [x - 0.09, x + 0.09], [meet - 0.09, meet + 0.09], PURPLE, 1.0, zorder=5)


def draw_pin(axes: Axes, x: float, meet: float, ends: tuple[float, float], pins: Sequence[bool], name: str) -> None:
    """Draw a pin in its slot. For links that are kept parallel, draw two bars side by side.

    pins   True for each end that carries a pin
    """
    parallel = not any(pins)
    for foot, pin, side in zip(ends, pins, (-1, 1), strict=True):
        end = meet + 0.03 * side * parallel
        _stem(axes, x, foot, end, name)
        if parallel:
            draw_line(axes, [x - TICK, x + TICK], [end, end], PURPLE, COUPLING, zorder=5)
        elif pin:
            axes.plot([x], [meet], "o", color=PURPLE, markersize=5, zorder=5)
        else:
            _box(axes, x, meet, (0.05, 0.1), PURPLE)


def _stem(
    axes: Axes, x: float, foot: float, end: float, name: str, color: str = PURPLE, width: float = COUPLING
) -> None:
    draw_line(axes, [x, x], [foot, end], color, width, zorder=3, gid=f"coupling {name}")
