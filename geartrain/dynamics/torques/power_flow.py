"""Power flow: powers at absolute speeds between shafts and pairs, losses of each pair, and recirculating power.

The power from a link to a pair is -T w, where T is the pair's torque on the link and w the link's absolute speed. The
powers into and out of a pair differ by its loss; the powers into and out of a shaft are equal. Links that are locked
together form one shaft. A bearing with friction is treated as a pair that connects its link and the carrier, and that
only has losses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from itertools import chain, pairwise
from typing import Literal, NamedTuple

from geartrain.dynamics.pair_speeds import radians_per_second
from geartrain.dynamics.torques.torque_results import Torques
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.results import Key, Result
from geartrain.train import StateCase, Train

PowerNodeKind = Literal["in", "shaft", "pair", "bearing", "out"]


class PowerNode(NamedTuple):
    """Node of the power flow: a pair, a shaft, a bearing, or a point at which power enters or leaves.

    See Also
    --------
    PowerFlow.nodes : all nodes
    """

    kind: PowerNodeKind
    """Kind of the node. Power enters the train at the node `in` and leaves it at the node `out`."""
    name: str
    """Name of the link, pair or shaft that the node represents.

    A bearing has the name of the link that turns in it. Links that are locked together form one shaft, `a + b`.
    """


@dataclass(frozen=True)
class PowerStream(Result):
    """Power that flows from one node of the power flow to another node."""

    KEYS = (Key("from", "source"), Key("to", "target"), Key("power", to=as_float), Key("circling", to=as_float))

    source: PowerNode
    """Node from which the power flows."""
    target: PowerNode
    """Node to which the power flows."""
    power: Fraction
    """Power of the stream, above 0 [unit of torque times the train's unit of speed]."""
    circling: Fraction = Fraction(0)
    """Part of `power` that recirculates in a closed loop [unit of torque times the train's unit of speed]."""


@dataclass(frozen=True)
class RecirculatingPower(Result):
    """Closed loop in the power flow, and the power that recirculates in it."""

    KEYS = ("pairs", "shafts", Key("power", to=as_float), Key("of_power_in", to=as_float))

    nodes: tuple[PowerNode, ...]
    """Pairs and shafts through which the recirculating power flows."""
    power: Fraction
    """Recirculating power [unit of torque times the train's unit of speed]."""
    power_in: Fraction
    """Power that enters the train [unit of torque times the train's unit of speed]."""

    @property
    def of_power_in(self) -> Fraction | None:
        """Recirculating power divided by the power that enters the train; None if no power enters."""
        return self.power / self.power_in if self.power_in else None

    @property
    def pairs(self) -> tuple[str, ...]:
        """Names of the pairs through which the power recirculates."""
        return tuple(node.name for node in self.nodes if node.kind == "pair")

    @property
    def shafts(self) -> tuple[str, ...]:
        """Names of the shafts through which the power recirculates."""
        return tuple(node.name for node in self.nodes if node.kind == "shaft")


def find_circulation(
    streams: Sequence[PowerStream], power_in: Fraction
) -> tuple[list[PowerStream], list[RecirculatingPower]]:
    """Return the streams, each with the part of its power that recirculates, and the loops in which power recirculates.

    Cycles are removed in descending order of their bottleneck power.
    """
    left = [stream.power for stream in streams]
    rounds: list[tuple[PowerNode, Fraction]] = []
    while way := _widest(streams, left):
        # subtracting the bottleneck empties at least one stream, so that the loop ends
        minimum = min(left[at] for at in way)
        for at in way:
            left[at] -= minimum
        rounds.append((streams[way[0]].source, minimum))
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
    """Return the indices of the streams in the cycle with the largest minimum of `left`; empty without a cycle."""
    best = _closed(streams, [at for at, power in enumerate(left) if power])
    if not best:
        return []
    # bisection over the widths: streams of at least this power contain a cycle or not
    widths = sorted({power for power in left if power > min(left[at] for at in best)})
    low, high = 0, len(widths)
    while low < high:
        middle = (low + high) // 2
        way = _closed(streams, [at for at, power in enumerate(left) if power >= widths[middle]])
        best, low, high = (way, middle + 1, high) if way else (best, low, middle)
    return best


def _closed(streams: Sequence[PowerStream], open_: Iterable[int]) -> list[int]:
    """Return the indices of the streams in one cycle of the streams with the indices `open_`; empty without a cycle."""
    stream_of: dict[tuple[PowerNode, PowerNode], int] = {}
    before: dict[PowerNode, list[PowerNode]] = {}
    for at in open_:
        source, target = streams[at].source, streams[at].target
        stream_of[source, target] = at
        before.setdefault(target, []).append(source)
    try:
        TopologicalSorter(before).prepare()
    except CycleError as error:
        # the second argument is the cycle, with its first node repeated at the end
        return [stream_of[ends] for ends in pairwise(error.args[1])]
    return []


def _mutual(streams: Sequence[PowerStream], node: PowerNode) -> frozenset[PowerNode]:
    # strongly connected component: nodes reached both along and against the streams
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


@dataclass(frozen=True)
class PowerLoss(Result):
    """Power loss of a pair or bearing, compared with the power input and with the total loss of the train."""

    KEYS = (
        *(Key("kind", "node.kind"), Key("name", "node.name"), Key("power", to=as_float)),
        *(Key("of_power_in", to=as_float), Key("of_loss", to=as_float)),
    )

    node: PowerNode
    """Pair or bearing in which the power is lost."""
    power: Fraction
    """Power that is lost in the pair or bearing [unit of torque times the train's unit of speed]."""
    power_in: Fraction
    """Power that enters the train [unit of torque times the train's unit of speed]."""
    loss: Fraction
    """Total power loss of the train [unit of torque times the train's unit of speed]."""

    @property
    def of_power_in(self) -> Fraction | None:
        """Power lost in this node divided by the power that enters the train; None if no power enters."""
        return self.power / self.power_in if self.power_in else None

    @property
    def of_loss(self) -> Fraction:
        """Power lost in this node divided by the total power loss of the train."""
        return self.power / self.loss


@dataclass(frozen=True)
class PowerFlow(Result):
    """Power streams of a train in one state. Power is torque times absolute speed.

    The powers into and out of a shaft are equal; the powers into and out of a pair differ by its loss.

    Examples
    --------
    >>> import geartrain
    >>> train = geartrain.load('''
    ... extends: planetary-24-18-60
    ... loads: {carrier: -84 N m}
    ... ''')
    >>> flow = find_power_flow(train.torques())
    >>> [(stream.source.name, stream.target.name, int(stream.power)) for stream in flow.streams[:4]]
    [('sun', 'sun', 24), ('sun', 's~p', 24), ('s~p', 'planet', 12), ('s~p', 'carrier', 12)]
    >>> flow.power_in == 84 * train.solve()["carrier"], flow.loss, flow.loops
    (True, Fraction(0, 1), ())
    """

    KEYS = ("streams", "loops")

    power_in: Fraction = Fraction(0)
    """Power that enters the train [unit of torque times the train's unit of speed]."""
    streams: tuple[PowerStream, ...] = ()
    """Power streams from the node `in` through shafts and pairs to the node `out`."""
    losses: Mapping[PowerNode, Fraction] = field(default_factory=dict)
    """Power lost in each pair or bearing [unit of torque times the train's unit of speed]; pairs and bearings without
    losses are omitted.
    """
    loops: tuple[RecirculatingPower, ...] = ()
    """Loops in which power recirculates, in descending order of power."""

    @property
    def nodes(self) -> tuple[PowerNode, ...]:
        """All nodes through which power flows."""
        return tuple(dict.fromkeys(end for stream in self.streams for end in (stream.source, stream.target)))

    @property
    def loss(self) -> Fraction:
        """Power lost in all pairs and bearings [unit of torque times the train's unit of speed]."""
        return sum(self.losses.values(), Fraction(0))

    @property
    def shares(self) -> tuple[PowerLoss, ...]:
        """Loss of each pair and bearing, which can be compared with the power input and the total loss."""
        return tuple(PowerLoss(node, lost, self.power_in, self.loss) for node, lost in self.losses.items())


def find_power_flow(found: Torques) -> PowerFlow:
    """Compute the power flow between shafts and pairs from the torques of a train.

    Parameters
    ----------
    found : Torques
        Result of `GearTrain.torques` or `GearTrain.driven`.

    Returns
    -------
    PowerFlow
        Power flow; empty if torques are unknown, or if redundant pairs share the load in undetermined proportions.

    Examples
    --------
    >>> import geartrain
    >>> flow = find_power_flow(geartrain.load("planetary-24-18-60").driven("carrier", "sun"))
    >>> [(stream.source.name, stream.target.name) for stream in flow.streams[:2]]
    [('sun', 'sun'), ('sun', 's~p')]
    """
    if not found.verdict or found.open_speeds or any(pair.loose or pair.power is None for pair in found.pairs.values()):
        return PowerFlow()
    locks = [held.links for held in found.held if len(held.links) == 2]
    groups = joined_groups(chain(*locks), locks)
    # locked links form one shaft, whose name contains all of them
    shafts = {link: PowerNode("shaft", " + ".join(group)) for group in groups for link in group}
    streams: list[PowerStream] = []
    losses: dict[PowerNode, Fraction] = {}
    ends = [(shafts.get(link, PowerNode("shaft", link)), link, power) for link, power in found.powers.items()]
    streams += [PowerStream(PowerNode("in", link), shaft, power) for shaft, link, power in ends if power > 0]
    for node, given in _takers(found):
        # powers of links on one shaft are added, because they are locked together
        net: dict[PowerNode, Fraction] = {}
        for link, power in given:
            shaft = shafts.get(link, PowerNode("shaft", link))
            net[shaft] = net.get(shaft, Fraction(0)) + power
        streams += [PowerStream(shaft, node, power) for shaft, power in net.items() if power > 0]
        streams += [PowerStream(node, shaft, -power) for shaft, power in net.items() if power < 0]
        if lost := sum(net.values(), Fraction(0)):
            losses[node] = lost
    streams += [PowerStream(shaft, PowerNode("out", link), -power) for shaft, link, power in ends if power < 0]
    streams, loops = find_circulation(streams, found.power_in)
    return PowerFlow(found.power_in, tuple(streams), losses, tuple(loops))


def _takers(found: Torques) -> Iterator[tuple[PowerNode, Sequence[tuple[str, Fraction]]]]:
    """Yield the node of each pair and bearing, with the power that flows into it from each of its links."""
    for pair in found.pairs.values():
        yield (
            PowerNode("pair", pair.id),
            # a link of undetermined speed has no torque
            [(link, -found.power(link, own)) for link, own in zip(pair.links, pair.torques, strict=True) if own],
        )
    for bearing in found.bearings:
        ends = ((bearing.link, bearing.torque), (bearing.carrier, bearing.reaction))
        # a bearing at rest or of undetermined speed has no torque, and its speed may be missing
        yield (
            PowerNode("bearing", bearing.link),
            [(link, -found.power(link, torque)) for link, torque in ends if torque],
        )


def watts_per_unit(train: Train, case: StateCase) -> float | None:
    """Return the unit of power, which is N m times the train's unit of speed, expressed in W; None if torques or speeds
    are numbers without a unit.

    Speeds have a unit if the train declares a `rate`, which is the speed of the first input that turns, or if its
    inputs have units.
    """
    if not train.has_torque_units(case.state):
        return None
    return radians_per_second(train, case)
