"""Whether the kinds of wheels that mesh go together, and with the directions of their axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.circuits import Axes
from geartrain.kinematics.circuits.shaft_angles import bevels_on_one_side, passing_distance

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.pitch_pairs import PitchPair
    from geartrain.kinematics.circuits import Circuit, Tree
    from geartrain.train import Train

_MATES = ({"spur"}, {"bevel"}, {"contrate", "spur"}, {"worm", "spur"})
_NEEDS = {
    "bevel": "cones roll on each other where their axes meet",
    "contrate": "the teeth of a contrate wheel point along its axis, across that of its mate",
    "worm": "a worm's axis passes that of its wheel at a distance",
    "helical": "crossed helical wheels touch between axes that pass each other at a distance",
}


def check_kinds(
    train: Train, tree: Tree, circuits: Sequence[Circuit], pairs: Sequence[PitchPair]
) -> Iterator[BuildFinding]:
    """Rules K1, K2 and K5: kinds and axes, kinds and mates, sides of bevels."""
    axes = Axes(train, tree)
    for one, other, shared in bevels_on_one_side(train, circuits, axes.is_rotation):
        yield BuildFinding("K5", "error", _on_one_side(train, one, other, shared))
    for pair in pairs:
        shape = next((kind for kind in pair.kinds if kind != "spur"), "helical" if pair.is_crossed else "spur")
        if set(pair.kinds) not in _MATES:
            yield BuildFinding("K2", "error", _strange_mates(pair))
        elif pair.parallel and shape != "spur":
            declared = all(label in train.axes for label in pair.axes)
            yield BuildFinding("K1", "error" if declared else "note", _side_by_side(pair, shape, declared))
        elif not pair.parallel:
            problem = _crossing(pair, shape, passing_distance(axes, pair.axes))
            if problem is not None:
                yield BuildFinding("K1", "error", problem)


def _strange_mates(pair: PitchPair) -> Problem:
    first, second = (f"{kind} wheel '{wheel}'" for kind, wheel in zip(pair.kinds, pair.wheels, strict=True))
    return Problem(
        f"pair '{pair.name}': {first} meets {second}",
        "bevels mesh with bevels; contrates and worms mesh with spur wheels",
        "give both wheels kinds that mesh: both `bevel`, or one `contrate` or `worm`",
        pair.place,
    )


def _on_one_side(train: Train, one: str, other: str, shared: str) -> Problem:
    return Problem(
        f"bevels '{one}' and '{other}' of one axis meet '{shared}' from the same side",
        "their cones have one apex and one axis, so that both would be in one place",
        f"give the one on the negative side of the axis `facing: -1`, such as '{other}'",
        train.place("links", train.wheels[other][0], "wheels", other),
    )


def _side_by_side(pair: PitchPair, shape: str, declared: bool) -> Problem:
    first, second = pair.axes
    if declared:
        what = f"{shape} pair '{pair.name}' on parallel axes '{first}' and '{second}'"
        fix = f"correct the directions under `axes`, or drop `kind: {shape}`"
    else:
        what = f"{shape} pair '{pair.name}' has no declared directions of axes"
        fix = f"declare the directions of '{first}' and '{second}' under `axes`, or drop `kind: {shape}`"
    why = _NEEDS[shape] + (
        "" if declared else ", and axes without a direction count as parallel: its wheels are drawn as spur wheels"
    )
    return Problem(what, why, fix, pair.place)


def _crossing(pair: PitchPair, shape: str, offset: float | None) -> Problem | None:
    """What is wrong with a pair on axes of two directions that pass each other at `offset` (m); None if nothing is."""
    first, second = pair.axes
    if shape == "spur":
        return Problem(
            f"pair '{pair.name}': spur wheels on axes '{first}' and '{second}' that are not parallel",
            "spur teeth are parallel to their axes, and touch along their width only where axes are parallel",
            "declare both `kind: bevel`, one `contrate` or `worm`, or a `helix_angle`; or make the axes parallel",
            pair.place,
        )
    if offset is None or (shape in ("worm", "helical")) == (offset > 0):
        return None
    far = f"pass each other at {offset * 1000:.6g} mm" if offset else "meet"
    fix = "move one of the axes" + (", or declare one wheel `kind: worm`" if offset else ", or declare both `bevel`")
    return Problem(
        f"{shape} pair '{pair.name}': the axes '{first}' and '{second}' {far}", _NEEDS[shape], fix, pair.place
    )
