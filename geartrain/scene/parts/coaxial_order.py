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


def nested(links: Sequence[CoaxialLink]) -> tuple[tuple[CoaxialLink, ...], tuple[str, str] | None]:
    """Links from the innermost, each outside all before it; if that cannot be, as given, with two that clash."""
    around = [{k for k, other in enumerate(links) if k != at and other.covers(each)} for at, each in enumerate(links)]
    left, order = list(range(len(links))), list[int]()
    while left:
        # one that no other must be inside of; of several the one that reaches farthest, what does not turn last
        free = [at for at in left if around[at].isdisjoint(left)]
        if not free:
            both = ((links[a].link, links[b].link) for a in left for b in left if a in around[b] and b in around[a])
            return tuple(links), next(both, (links[0].link, links[-1].link))
        order.append(min(free, key=lambda at: (links[at].fixed, links[at].low - links[at].high)))
        left.remove(order[-1])
    return tuple(links[at] for at in order), None
