"""The turning pairs as a tree rooted at the frame."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

from geartrain.errors import DeclarationError, Problem
from geartrain.numerics.containers import FrozenFields, collector_paused
from geartrain.numerics.graphs import ways_to_common_ancestor
from geartrain.train import Train


@dataclass(frozen=True, slots=True)
class Tree(FrozenFields):
    """The turning pairs as a tree rooted at the frame.

    parent  link -> (link nearer the frame, axis label), as declared
    top     link -> the link of the same axis nearest the frame, which bears it
    """

    frame: str
    parent: Mapping[str, tuple[str, str]]
    top: Mapping[str, str]

    def axis(self, link: str) -> str | None:
        """The label of the joint nearest the frame; None for the frame itself."""
        return self.parent[link][1] if link in self.parent else None

    def above(self, link: str) -> str | None:
        """The next link towards the frame, as declared; None for the frame itself."""
        return self.parent[link][0] if link in self.parent else None

    def bears(self, carrier: str, link: str) -> bool:
        """True if the axis of `link` is one that the carrier bears and carries along."""
        return self.top.get(link) == carrier

    def axis_seen_from(self, carrier: str, link: str) -> str:
        """The axis on which a link of a circuit turns as seen from the circuit's carrier.

        Its own where the carrier bears it; else it is coaxial with the carrier, or bears the carrier's axis: the
        carrier's own then.
        """
        return self.parent[link if self.bears(carrier, link) else carrier][1]

    def path(self, i: str, j: str) -> tuple[list[str], list[str]]:
        """The tree path from i to j: its links, and the axis labels between them."""
        up, down = ways_to_common_ancestor(i, j, self.above)
        labels = [self.parent[link][1] for link in [*up[:-1], *down[-2::-1]]]
        return up + down[-2::-1], labels


@collector_paused()
def find_tree(train: Train) -> Tree:
    """Root the turning pairs at the frame. Raises `DeclarationError` where they form no tree."""
    if not train.revolutes and len(train.links) > 1:
        raise DeclarationError(_no_joints(train))
    joints: dict[str, list[tuple[str, str, int]]] = {link: [] for link in train.links}
    for at, joint in enumerate(train.revolutes):
        first, second = joint.pair
        joints[first].append((second, joint.axis, at))
        joints[second].append((first, joint.axis, at))
    parent: dict[str, tuple[str, str]] = {}
    top: dict[str, str] = {}
    bearer: dict[str, tuple[str, int]] = {}
    used: set[int] = set()
    problems: list[Problem] = []
    queue = deque([train.frame])
    while queue:
        link = queue.popleft()
        for other, axis, at in joints[link]:
            # by pair, not by link: two pairs that join the same two links close a cycle
            if at in used:
                continue
            used.add(at)
            if other == train.frame or other in parent:
                problems.append(_cycle(train, Tree(train.frame, parent, top), link, other, at))
                continue
            parent[other] = (link, axis)
            top[other] = top[link] if link in parent and parent[link][1] == axis else link
            first_top, first_at = bearer.setdefault(axis, (top[other], at))
            if first_top != top[other]:
                problems.append(_two_axes(train, axis, first_top, top[other], first_at, at))
            queue.append(other)
    problems += [_loose(train, link) for link in train.links if link != train.frame and link not in parent]
    if problems:
        raise DeclarationError(problems)
    return Tree(train.frame, parent, top)


def _cycle(train: Train, tree: Tree, link: str, other: str, at: int) -> Problem:
    links, _ = tree.path(link, other)
    return Problem(
        f"the turning pairs form a cycle: {' - '.join([*links, link])}",
        "turning pairs must form a tree; links on one axis are joined by one pair fewer than there are links",
        f"remove one of these turning pairs, such as [{link}, {other}]",
        train.place("revolutes", at),
    )


def _two_axes(train: Train, axis: str, first: str, second: str, first_at: int, at: int) -> Problem:
    return Problem(
        f"axis label '{axis}' names two axes",
        f"one is borne by '{first}' ({train.place('revolutes', first_at)}), one by '{second}'; "
        "joints of one label are coaxial",
        "give the second axis a label of its own",
        train.place("revolutes", at),
    )


def _no_joints(train: Train) -> Problem:
    link = next(link for link in train.links if link != train.frame)
    return Problem(
        "no turning pair is declared",
        f"every link but '{train.frame}' turns on an axis that another link carries",
        f"add `revolutes:` with an entry for each axis, such as `{{A: [{train.frame}, {link}]}}`",
        train.place("revolutes") if "revolutes" in train.model_fields_set else train.place("links"),
    )


def _loose(train: Train, link: str) -> Problem:
    return Problem(
        f"link '{link}' is not joined to the frame",
        f"no chain of turning pairs leads from it to '{train.frame}'",
        f"add a turning pair for '{link}' to `revolutes`",
        train.place("links", link),
    )
