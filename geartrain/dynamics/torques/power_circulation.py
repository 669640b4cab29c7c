"""Streams of power, and the part of them that runs in closed loops: cycles cancelled, the widest first."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal, NamedTuple

from geartrain.numerics.exact import as_float
from geartrain.numerics.results import Key, Result

PowerNodeKind = Literal["in", "shaft", "pair", "bearing", "out"]


class PowerNode(NamedTuple):
    """A place that power passes.

    Attributes
    ----------
    kind : {"in", "shaft", "pair", "bearing", "out"}
        What it is: power enters the train at `in` and leaves it at `out`.
    name : str
        Of the link (`in`, `out`, and a bearing, by the link that turns in it), of the pair, or of a shaft: links that
        are locked together are one, `a + b`.

    See Also
    --------
    PowerFlow.nodes : all of them.
    """

    kind: PowerNodeKind
    name: str


@dataclass(frozen=True)
class PowerStream(Result):
    """Power that flows from one node to the next.

    Attributes
    ----------
    source, target : PowerNode
        The ends.
    power : Fraction
        Above 0 [torque times the train's unit of speed].
    circling : Fraction
        The part of it that runs in closed loops.

    See Also
    --------
    PowerFlow.streams : all of them.
    """

    KEYS = (Key("from", "source"), Key("to", "target"), Key("power", to=as_float), Key("circling", to=as_float))

    source: PowerNode
    target: PowerNode
    power: Fraction
    circling: Fraction = Fraction(0)


@dataclass(frozen=True)
class RecirculatingPower(Result):
    """Nodes that feed each other in closed loops, and the power that runs round in them without leaving.

    Attributes
    ----------
    nodes : tuple of PowerNode
        The pairs and shafts of the loops.
    power : Fraction
        What runs round [torque times the train's unit of speed].
    power_in : Fraction
        What enters the train.

    See Also
    --------
    PowerFlow.loops : all of them.
    """

    KEYS = ("pairs", "shafts", Key("power", to=as_float), Key("of_power_in", to=as_float))

    nodes: tuple[PowerNode, ...]
    power: Fraction
    power_in: Fraction

    @property
    def of_power_in(self) -> Fraction | None:
        """Its power over that which enters the train; None where none does."""
        return self.power / self.power_in if self.power_in else None

    @property
    def pairs(self) -> tuple[str, ...]:
        """The pairs of the loop."""
        return tuple(node.name for node in self.nodes if node.kind == "pair")

    @property
    def shafts(self) -> tuple[str, ...]:
        """The shafts of the loop."""
        return tuple(node.name for node in self.nodes if node.kind == "shaft")


def find_circulation(
    streams: Sequence[PowerStream], power_in: Fraction
) -> tuple[list[PowerStream], list[RecirculatingPower]]:
    """Streams with the part that circles, and the loops: closed ways are taken out, the widest first."""
    left = [stream.power for stream in streams]
    rounds: list[tuple[PowerNode, Fraction]] = []
    while way := _widest(streams, left):
        least = min(left[at] for at in way)
        for at in way:
            left[at] -= least
        rounds.append((streams[way[0]].source, least))
    marked = [replace(stream, circling=stream.power - rest) for stream, rest in zip(streams, left, strict=True)]
    loops: dict[frozenset[PowerNode], Fraction] = {}
    for node, power in rounds:
        members = _mutual(streams, node)
        loops[members] = loops.get(members, Fraction(0)) + power
    order = dict.fromkeys(end for stream in streams for end in (stream.source, stream.target))
    found = [
        RecirculatingPower(tuple(node for node in order if node in members), power, power_in)
        for members, power in loops.items()
    ]
    return marked, sorted(found, key=lambda loop: -loop.power)


def _widest(streams: Sequence[PowerStream], left: Sequence[Fraction]) -> list[int]:
    """Bottleneck cycle: the closed way whose narrowest stream is widest, by bisection over widths; or none."""
    best = _closed(streams, [at for at, power in enumerate(left) if power])
    if not best:
        return []
    widths = sorted({power for power in left if power > min(left[at] for at in best)})
    low, high = 0, len(widths)
    while low < high:
        middle = (low + high) // 2
        way = _closed(streams, [at for at, power in enumerate(left) if power >= widths[middle]])
        best, low, high = (way, middle + 1, high) if way else (best, low, middle)
    return best


def _closed(streams: Sequence[PowerStream], open_: Iterable[int]) -> list[int]:
    """One closed way through the streams at these places, by depth-first search without recursion; or none."""
    after: dict[PowerNode, list[int]] = {}
    for at in open_:
        after.setdefault(streams[at].source, []).append(at)
    done: set[PowerNode] = set()
    for start in after:
        way: list[int] = []
        ahead = {start: iter(after[start])}  # the nodes of the way with what is still to be tried from each
        while ahead:
            for at in ahead[next(reversed(ahead))]:
                target = streams[at].target
                if target in ahead:
                    return [*way, at][list(ahead).index(target) :]
                if target not in done:
                    way.append(at)
                    ahead[target] = iter(after.get(target, ()))
                    break
            else:
                done.add(ahead.popitem()[0])
                way = way[:-1]
    return []


def _mutual(streams: Sequence[PowerStream], node: PowerNode) -> frozenset[PowerNode]:
    """The strongly connected component of a node: all that power from it reaches and that reach it."""
    ways: list[set[PowerNode]] = []
    for pairs in (((s.source, s.target) for s in streams), ((s.target, s.source) for s in streams)):
        after: dict[PowerNode, list[PowerNode]] = {}
        for source, target in pairs:
            after.setdefault(source, []).append(target)
        seen, todo = {node}, [node]
        while todo:
            fresh = [each for each in after.get(todo.pop(), ()) if each not in seen]
            seen.update(fresh)
            todo += fresh
        ways.append(seen)
    return frozenset(ways[0] & ways[1])
