"""What is stacked: wheels as blocks, and what stands in whose way in plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Block:
    """A wheel in a stack.

    axis    index of its axis; `link`, that of its arbor
    stack   number of the wheels that keep their heights to each other: those that mesh
    offset  its height in its stack (mm); `low` and `high`, how far it reaches along the direction from there
    inner   of a ring, the radius within which all is free; `outer`, the radius that it needs
    mate    it stands across, and meshes with a wheel of this stack: `beside`, if it keeps its place, has the ends of
            its trace in plan, on both sides of which `outer` is taken
    """

    wheel: str
    axis: int
    link: str
    stack: int
    offset: float
    low: float
    high: float
    inner: float
    outer: float
    beside: tuple[tuple[float, float], tuple[float, float]] | None = None
    mate: bool = False


@dataclass(frozen=True)
class Crowd:
    """What stands in whose way, in plan.

    blocks  wheels
    clash   (blocks, blocks): two that must not share a height
    pierce  (links, blocks): wheels that an arbor would go through at their height
    links   names of arbors; `ends`, whether each runs out of the stack at its low or high end, to a dial
    plates  the wheel on which the axis of an arbor is carried round
    """

    blocks: Sequence[Block]
    clash: Flags
    pierce: Flags
    links: Sequence[str]
    ends: Mapping[str, tuple[bool, bool]]
    plates: Mapping[str, str]
