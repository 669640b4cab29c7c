"""Where power flows: absolute powers from shaft to pair to shaft, what each pair sheds, and what runs in circles.

The power that a link gives to a pair is minus its torque there times its absolute speed. A pair takes in what it gives
on and what it loses; a shaft gives on all it takes in. Links that are locked together are one shaft. A friction of a
bearing stands between its link and the carrier like a pair that only loses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import chain
from typing import Literal, NamedTuple

from geartrain.dynamics.pair_speeds import radians_per_second
from geartrain.dynamics.torques.torque_results import Torques
from geartrain.numerics.exact import as_float
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.results import Key, Result
from geartrain.train import StateCase, Train

PowerNodeKind = Literal["in", "shaft", "pair", "bearing", "out"]


class PowerNode(NamedTuple):
    """A place that power passes.

    See Also
    --------
    PowerFlow.nodes : all of them.
    """

    kind: PowerNodeKind
    """What it is: power enters the train at `in` and leaves it at `out`."""
    name: str
    """Of the link (`in`, `out`, and a bearing, by the link that turns in it), of the pair, or of a shaft: links that
    are locked together are one, `a + b`."""


@dataclass(frozen=True)
class PowerStream(Result):
    """Power that flows from one node to the next.

    See Also
    --------
    PowerFlow.streams : all of them.
    """

    KEYS = (Key("from", "source"), Key("to", "target"), Key("power", to=as_float), Key("circling", to=as_float))

    source: PowerNode
    """Where the power comes from."""
    target: PowerNode
    """Where the power goes."""
    power: Fraction
    """Above 0 [torque times the train's unit of speed]."""
    circling: Fraction = Fraction(0)
    """The part of it that runs in closed loops."""


@dataclass(frozen=True)
class RecirculatingPower(Result):
    """Nodes that feed each other in closed loops, and the power that runs round in them without leaving.

    See Also
    --------
    PowerFlow.loops : all of them.
    """

    KEYS = ("pairs", "shafts", Key("power", to=as_float), Key("of_power_in", to=as_float))

    nodes: tuple[PowerNode, ...]
    """The pairs and shafts of the loops."""
    power: Fraction
    """What runs round [torque times the train's unit of speed]."""
    power_in: Fraction
    """What enters the train."""

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


@dataclass(frozen=True)
class PowerLoss(Result):
    """What a pair or bearing loses, beside what enters the train and what is lost in all.

    See Also
    --------
    PowerFlow.shares : all of them.
    """

    KEYS = (
        *(Key("kind", "node.kind"), Key("name", "node.name"), Key("power", to=as_float)),
        *(Key("of_power_in", to=as_float), Key("of_loss", to=as_float)),
    )

    node: PowerNode
    """The pair, or the bearing."""
    power: Fraction
    """What it loses [torque times the train's unit of speed]."""
    power_in: Fraction
    """What enters the train."""
    loss: Fraction
    """What is lost in all."""

    @property
    def of_power_in(self) -> Fraction | None:
        """Over the power that enters; None where none does."""
        return self.power / self.power_in if self.power_in else None

    @property
    def of_loss(self) -> Fraction:
        """Over all that is lost."""
        return self.power / self.loss


@dataclass(frozen=True)
class PowerFlow(Result):
    """All streams of power of a train in one state: power is torque times absolute speed.

    So every shaft gives on all it takes in, and every pair all but what it loses.

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
    """What enters the train [torque times the train's unit of speed]."""
    streams: tuple[PowerStream, ...] = ()
    """From `in` through shafts and pairs to `out`."""
    losses: Mapping[PowerNode, Fraction] = field(default_factory=dict)
    """By pair and bearing, only where something is lost."""
    loops: tuple[RecirculatingPower, ...] = ()
    """Circulating power, the greatest first."""

    @property
    def nodes(self) -> tuple[PowerNode, ...]:
        """Every node that power passes."""
        return tuple(dict.fromkeys(end for stream in self.streams for end in (stream.source, stream.target)))

    @property
    def loss(self) -> Fraction:
        """Power lost in all pairs and bearings."""
        return sum(self.losses.values(), Fraction(0))

    @property
    def shares(self) -> tuple[PowerLoss, ...]:
        """The losses, with their shares of the whole."""
        return tuple(PowerLoss(node, lost, self.power_in, self.loss) for node, lost in self.losses.items())

    def surplus(self, node: PowerNode) -> Fraction:
        """What a node takes in and neither gives on nor loses: 0 everywhere but at the ends.

        Parameters
        ----------
        node : PowerNode
            The node asked for.

        Returns
        -------
        Fraction
            Power in less power out and losses [torque times the train's unit of speed].
        """
        taken = sum((stream.power for stream in self.streams if stream.target == node), Fraction(0))
        given = sum((stream.power for stream in self.streams if stream.source == node), Fraction(0))
        return taken - given - self.losses.get(node, Fraction(0))


def find_power_flow(found: Torques) -> PowerFlow:
    """The streams of power under some torques.

    Parameters
    ----------
    found : Torques
        As `GearTrain.torques` and `GearTrain.driven` give them.

    Returns
    -------
    PowerFlow
        Empty where no torques were found, or some are shared in no certain way.

    Examples
    --------
    >>> import geartrain
    >>> flow = find_power_flow(geartrain.load("planetary-24-18-60").driven("carrier", "sun"))
    >>> [(stream.source.name, stream.target.name) for stream in flow.streams[:2]]
    [('sun', 'sun'), ('sun', 's~p')]
    """
    if not found.verdict or found.open_speeds or any(pair.loose or pair.power is None for pair in found.pairs.values()):
        return PowerFlow()
    shafts = _shafts(held.links for held in found.held if len(held.links) == 2)
    streams: list[PowerStream] = []
    losses: dict[PowerNode, Fraction] = {}
    ends = [(shafts.get(link, PowerNode("shaft", link)), link, power) for link, power in found.powers.items()]
    streams += [PowerStream(PowerNode("in", link), shaft, power) for shaft, link, power in ends if power > 0]
    for node, given in _takers(found):
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


def _shafts(locks: Iterable[tuple[str, ...]]) -> dict[str, PowerNode]:
    """The shaft of every link that is locked to another one, named by all its links."""
    pairs = list(locks)
    groups = joined_groups(chain(*pairs), pairs)
    return {link: PowerNode("shaft", " + ".join(group)) for group in groups for link in group}


def _takers(found: Torques) -> Iterator[tuple[PowerNode, Sequence[tuple[str, Fraction]]]]:
    """Pairs and bearings with the power that each of their links gives them."""
    speed = found.speeds
    for pair in found.pairs.values():
        yield (
            PowerNode("pair", pair.id),
            [(link, -torque * speed[link]) for link, torque in zip(pair.links, pair.torques, strict=True)],
        )
    for bearing in found.bearings:
        ends = ((bearing.link, bearing.torque), (bearing.carrier, bearing.reaction))
        # a bearing that rests, or whose speed is open, has no torque, and need have no speed
        yield PowerNode("bearing", bearing.link), [(link, -torque * speed[link]) for link, torque in ends if torque]


def has_torque_units(train: Train, state: str | None) -> bool:
    """True if the loads and bearings of one state are given in units."""
    return train.has_torque_units(state)


def watts_per_unit(train: Train, case: StateCase) -> float | None:
    """Watts in one unit of power: N m times the train's unit of speed; None where torques or speeds are plain numbers.

    Speeds are real where the train has a `rate`, that of the first input that turns, or its inputs have units.
    """
    if not has_torque_units(train, case.state):
        return None
    return radians_per_second(train, case)
