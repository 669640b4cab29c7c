"""Brakes and clutches beside a stick diagram: what each holds or joins, and which are closed."""

from __future__ import annotations

from geartrain.analysis.gear_train import GearTrain
from geartrain.drawing.backend import Axes, Rectangle
from geartrain.drawing.style import GREY, LETTER, PURPLE, write

STEP = 0.62  # inches from one to the next
PLATE, STEM = 2.6, 1.6
"""Widths of a plate and of what bears it [pt]."""
_HALF, _PLATE = 0.42, 0.11  # inches: half its height, half a plate
_CLOSED, _OPEN = 0.012, 0.045  # inches: half the gap of its plates
_NAME = 8.0  # points


def width_of(train: GearTrain) -> float:
    """Inches that they take; 0 without any."""
    count, letters = len(train.declaration.clutches), _letters(train)
    return count * max(STEP, letters * _NAME * LETTER + 0.1) + 0.2 if count else 0.0


def draw_elements(axes: Axes, train: GearTrain, state: str | None, left: float, middle: float) -> None:
    """Each as a pair of plates between a link and the frame, or two links; those closed in a state are filled.

    left     where the first begins (inches); `middle`, the height of all plates
    """
    declared = train.declaration
    closed = train.kinematics.cases[state].engaged
    step = max(STEP, _letters(train) * _NAME * LETTER + 0.1)
    for at, (name, clutch) in enumerate(declared.clutches.items()):
        x, gap = left + step * (at + 0.5), _CLOSED if name in closed else _OPEN
        color = PURPLE if name in closed else GREY
        below, above = clutch.locks or (clutch.fixes or "", declared.frame)
        for side in (-1, 1):
            plate = middle + side * gap
            axes.plot([x - _PLATE, x + _PLATE], [plate, plate], color=color, linewidth=PLATE, gid=f"element {name}")
            axes.plot([x, x], [plate, middle + side * _HALF], color=color, linewidth=STEM)
        if clutch.fixes is not None:
            box = Rectangle((x - 0.11, middle + _HALF), 0.22, 0.1, hatch="//////", zorder=4)
            box.set(facecolor="white", edgecolor=GREY, linewidth=0.7)
            axes.add_artist(box)
        else:
            write(axes, x, middle + _HALF + 0.1, above, ha="center", fontsize=_NAME, fontweight="bold")
        write(axes, x, middle - _HALF - 0.1, below, ha="center", fontsize=_NAME, fontweight="bold")
        weight = "bold" if name in closed else "normal"
        write(axes, x + _PLATE + 0.06, middle, name, color, ha="left", fontsize=_NAME, fontweight=weight)


def _letters(train: GearTrain) -> int:
    """Of the longest name in one column: a link's below or above, or twice an element's beside the plates."""
    every = train.declaration.clutches.items()
    names = [link for _, clutch in every for link in (*(clutch.locks or ()), clutch.fixes or "")]
    return max([len(link) for link in names] + [2 * len(name) + 3 for name, _ in every], default=0)
