"""What a maker says beside the declaration, and the layout at the size asked for."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, fields, replace
from math import isfinite

from geartrain.errors import Problem, QuestionError
from geartrain.layout import AxisPlace, Layout, WheelPlace


@dataclass(frozen=True, slots=True)
class Making:
    """Sizes in mm; None leaves them to the layout.

    module      pitch diameter over teeth, where the declaration gives no sizes
    thickness   of wheels and plates
    bore        diameter of the arbors, and so of the holes in wheels and plates; 0: no holes
    backlash    play on the pitch circle of teeth whose form is not declared
    """

    module: float | None = None
    thickness: float | None = None
    bore: float | None = None
    backlash: float | None = None

    def __post_init__(self) -> None:
        """Raise `QuestionError` for what is no size."""
        problems = []
        for name in (each.name for each in fields(self)):
            value = getattr(self, name)
            zero = name in ("bore", "backlash")
            if value is not None and not (isfinite(value) and (value >= 0 if zero else value > 0)):
                fix = f"give a {name} of 0 or more" if zero else f"give a {name} above 0"
                problems.append(Problem(f"a {name} of {value:g} mm is no size", "", fix, f"--{name}"))
        if problems:
            raise QuestionError(problems)


def scale_of(layout: Layout, making: Making) -> float:
    """How many times larger everything is to be for the module asked for.

    Raises `QuestionError` where the declaration gives sizes, which always win.
    """
    if making.module is None or not layout.wheels:
        return 1.0
    given = [name for name, place in layout.wheels.items() if place.given]
    placed = [label for label, axis in layout.axes.items() if axis.how == "given"]
    if given or placed:
        named = f"the module of '{given[0]}'" if given else f"the position of axis '{placed[0]}'"
        why = f"it gives {named}, and what is declared wins"
        fix = "leave --module out, or take the sizes out of the file"
        raise QuestionError(Problem("the declaration has sizes of its own", why, fix, "--module"))
    usual, _ = Counter(round(place.module, 9) for place in layout.wheels.values()).most_common(1)[0]
    return making.module / usual


def sized(layout: Layout, making: Making) -> Layout:
    """The layout at the module and thickness asked for."""
    factor = scale_of(layout, making)
    axes = {label: _axis(axis, factor) for label, axis in layout.axes.items()}
    wheels = {name: _wheel(place, factor, making.thickness) for name, place in layout.wheels.items()}
    return replace(layout, axes=axes, wheels=wheels)


def _axis(axis: AxisPlace, factor: float) -> AxisPlace:
    x, y, z = axis.point
    return replace(axis, point=(x * factor, y * factor, z * factor))


def _wheel(place: WheelPlace, factor: float, thickness: float | None) -> WheelPlace:
    x, y, z = place.centre
    return replace(
        place,
        centre=(x * factor, y * factor, z * factor),
        radius=place.radius * factor,
        module=place.module * factor,
        thickness=place.thickness * factor if thickness is None else thickness,
    )


def bores(layout: Layout, making: Making) -> dict[str, float]:
    """Diameter (mm) of the arbor on each axis: the one asked for, or a third of the smallest wheel's, 6 at most."""
    if making.bore is not None:
        return dict.fromkeys(layout.axes, making.bore)
    found = {}
    for label in layout.axes:
        radii = [place.radius - 1.25 * place.module for place in layout.wheels.values() if place.axis == label]
        smallest = min((radius for radius in radii if radius > 0), default=3.0)
        found[label] = round(min(6.0, 2 * smallest / 3), 2)
    return found
