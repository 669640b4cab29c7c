"""Which arbor of one axis runs inside which.

A pipe covers the arbor inside it from its lowest wheel to its highest: no wheel of that arbor may sit there. Each pair
that leaves no choice is an edge of a graph; its topological order is the order of nesting, and a cycle is an axis whose
arbors cannot be nested.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.scene.parts.stack_discs import StackDisc


@dataclass(frozen=True, slots=True)
class CoaxialLink:
    """What one link has in one piece on an axis, and how far it reaches (to a dial, or a plate).

    hubs    heights at which something holds it or is held by it: of its discs, and of the plate that holds what stands
    discs   on it; `ends`, whether it goes out below and above the stack
    """

    link: str
    hubs: tuple[float, ...]
    low: float
    high: float
    fixed: bool = False
    discs: tuple[StackDisc, ...] = ()
    ends: tuple[bool, bool] = (False, False)

    def covers(self, other: CoaxialLink) -> bool:
        """True if a hub of the other sits where this one would be its pipe."""
        return any(self.low < height < self.high for height in other.hubs)


def nested(links: Sequence[CoaxialLink]) -> tuple[CoaxialLink, ...]:
    """Links from the innermost, each outside all before it; none if that cannot be."""
    left, order = list(links), list[CoaxialLink]()
    while left:
        # one that no other must be inside of; of several the one that reaches farthest, what does not turn last
        free = [each for each in left if not any(other is not each and other.covers(each) for other in left)]
        if not free:
            return ()
        order.append(min(free, key=lambda each: (each.fixed, each.low - each.high)))
        left.remove(order[-1])
    return tuple(order)


def clash(links: Sequence[CoaxialLink]) -> tuple[str, str] | None:
    """Two links that cannot be nested, if any."""
    if nested(links):
        return None
    both = ((a.link, b.link) for a in links for b in links if a is not b and a.covers(b) and b.covers(a))
    return next(both, (links[0].link, links[-1].link) if links else None)
