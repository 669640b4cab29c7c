"""What a train as built has beside its wheels: parts that hold them, a pendulum, a weight; lengths in mm."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from geartrain.numerics.vectors import Vector


@dataclass(frozen=True, slots=True)
class ScenePart:
    """What holds wheels, as it is made: a turned part, or a flat one; about its own z, its middle at `place`.

    Attributes
    ----------
    body : int
        Index of the body to which it belongs.
    name, kind : str
        Of a part list: arbor, pipe, stud, collar, spacer, collet, barrel, pillar, post, foot, cock, pin, plate; frame
        for a plate of the frame, carrier for one that turns with a carrier or a ring, dial for one of dials.
    place : tuple of float
        Where it stands in the zero pose [mm].
    direction, across : tuple of float
        Unit vectors: its z and its x.
    bands : sequence of (float, float, float, float)
        Of a turned part, from below: from and to along z, outside and inside radius [mm].
    outlines : sequence of sequence of float
        Of a flat part: its edge, then its holes, as x and y in turn [mm].
    height : float
        Thickness of a flat part, half of it to either side [mm].

    See Also
    --------
    build_scene : gives it, in `Scene.parts`.
    """

    body: int
    name: str
    kind: str
    place: Vector
    direction: Vector
    across: Vector
    bands: Sequence[tuple[float, float, float, float]] = ()
    outlines: Sequence[Sequence[float]] = ()
    height: float = 0.0


@dataclass(frozen=True, slots=True)
class SceneHanger:
    """What hangs on a train: a pendulum, the line of a weight, or the weight.

    Attributes
    ----------
    kind : {"pendulum", "line", "weight"}
        A pendulum swings as its escape wheel lets it; a weight falls and its line grows as their barrel turns.
    body : int
        Index of the body by whose angle it moves.
    point : tuple of float
        Where it hangs [mm].
    direction, down : tuple of float
        Unit vectors: the axis about which it swings or turns, and the way down, across it.
    length : float
        From where it hangs to the middle of the bob, or to the weight in the zero pose [mm].
    rate : float
        Of a pendulum swings to and fro in a turn of its body; else how far a weight falls for each radian [mm].
    wide : float
        Radius of the bob, the weight or the line [mm].
    parts : sequence of ScenePart
        What is turned for it, where it hangs in the zero pose: rod and bob, or the weight.

    See Also
    --------
    build_scene : gives it, in `Scene.hangers`.
    """

    kind: Literal["pendulum", "line", "weight"]
    body: int
    point: Vector
    direction: Vector
    down: Vector
    length: float
    rate: float
    wide: float
    parts: Sequence[ScenePart] = ()
