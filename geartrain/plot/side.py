"""A plan from its side: wheels as bars in their layers, arbors through them."""

from __future__ import annotations

from typing import Any

import numpy as np

from geartrain.plot.library import Rectangle
from geartrain.plot.parts import BLACK, GREY, RED
from geartrain.plot.standing import Page, Stand, broken_wheels

_FACE = np.array([0.74, 0.82, 0.89])  # colour of a bar
_FINE = 7.5  # points


class Depth:
    """Inches across the side view for heights towards the reader (mm): the reader stands on the right."""

    def __init__(self, left: float, width: float, low: float, size: float) -> None:
        self.left, self.scale, self.low = left, width / size, low

    def at(self, height: float) -> float:
        """Inches from the left for a height (mm)."""
        return self.left + (height - self.low) * self.scale


def draw_side(page: Page, standing: Stand, depth: Depth) -> None:
    """The train from its right, as high as the plan: layers side by side, the reader's side on the right."""
    red = broken_wheels(standing.scene)
    stacks: dict[tuple[float, float], list[float]] = {}
    facing = filter(standing.faces, standing.scene.wheels)
    for wheel in sorted(facing, key=lambda each: float(standing.seen(standing.centre(each))[0])):
        x, y, z = map(float, standing.seen(standing.centre(wheel)))
        half = max(wheel.tip, wheel.root) * page.scale
        middle = float(page.at(np.array([x, y, z]))[1])
        left, right = depth.at(z - wheel.thickness / 2), depth.at(z + wheel.thickness / 2)
        style: dict[str, Any] = {"edgecolor": RED if wheel.id in red else BLACK, "linewidth": 0.6, "zorder": 3}
        face = (*_FACE, 0.7)
        box = Rectangle((left, middle - half), right - left, 2 * half, facecolor=face, gid=f"side {wheel.id}", **style)
        page.axes.add_artist(box)
        stacks.setdefault((round(x, 4), round(middle, 4)), []).extend((left, right))
    for (_, middle), ends in stacks.items():
        page.axes.plot([min(ends) - 0.06, max(ends) + 0.06], [middle, middle], color=BLACK, linewidth=1.4, zorder=4)
    text = "from the right" if abs(depth.scale / page.scale - 1) < 0.01 else "from the right, layers apart"
    page.axes.text(depth.left, page.foot, text, fontsize=_FINE, color=GREY)
