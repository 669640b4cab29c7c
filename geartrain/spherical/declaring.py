"""A configuration as the declaration of a train: a link, a bevel wheel and an axis for each gear."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.spherical.configuration import Configuration

_NOTE = (
    "All axes go through the centre of the sphere and point outwards; a speed is positive counterclockwise, "
    "seen from outside. Two wheels in mesh turn against each other."
)

_SHORT = 1 << 20


def to_train(configuration: Configuration, name: str = "") -> dict[str, Any]:
    """The configuration as plain data with the keys of a declaration, for `GearTrain.declare` or `files.as_yaml`.

    Links and wheels have the names of the gears, and so have their axes. With axes outwards every mesh reverses, as
    the wheels stand on the positive sides of their axes (`facing` 1, the default): z_i w_i + z_j w_j = 0. The first
    gear is the input, at speed 1. Directions are floats at full length. Raises `GearTrainError` where a tooth number
    is missing.
    """
    missing = [kind for kind in dict.fromkeys(configuration.kinds) if kind not in configuration.teeth]
    if missing or not configuration.names:
        raise QuestionError(
            Problem(
                f"no tooth number for {', '.join(missing)}" if missing else "a set without gears is no train",
                "a declaration has one for every wheel",
                "choose `teeth` for every kind" if missing else "drop fewer gears",
            )
        )
    gears = list(zip(configuration.names, configuration.kinds, configuration.axes.tolist(), strict=True))
    return {
        "name": name or "spherical",
        "title": configuration.title or f"{len(gears)} gears on a sphere",
        "note": _NOTE,
        "frame": "frame",
        "links": {"frame": {}} | {gear: _link(gear, configuration.teeth[kind]) for gear, kind, _ in gears},
        "axes": {
            gear: {"direction": _direction(axis), "position": ["0 mm", "0 mm", "0 mm"]} for gear, _, axis in gears
        },
        "revolutes": [{"pair": ["frame", gear], "axis": gear} for gear, _, _ in gears],
        "gears": [{"pair": [configuration.names[i], configuration.names[j]]} for i, j in configuration.meshes],
        "inputs": {configuration.names[0]: 1},
    }


def _direction(axis: list[float]) -> list[str]:
    """Floats at full length, short ones as fractions: a decimal counts as known to its last digit only."""
    exact = [Fraction(part) for part in axis]
    return [str(part) if part.denominator < _SHORT else f"{float(part):.17g}" for part in exact]


def _link(gear: str, teeth: int) -> dict[str, Any]:
    return {"wheels": {gear: {"teeth": teeth, "kind": "bevel"}}}
