"""The ordinary train of each carrier frame: exact relative ratios, and its loops with their witnesses.

Seen from one carrier, the links that mesh form an ordinary train whose relative speeds are rational multiples of
one unknown. One walk finds them all; a mesh that closes a loop either agrees (it is redundant) or locks the train
to its carrier. What couples the components are the links they share, and that system is small in real trains.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.kinematics.answer import Loop
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.elimination import LinearForm, add_into
from geartrain.numerics.factored_ratios import FactoredRatios
from geartrain.numerics.graphs import chain_to_root, ways_to_common_ancestor


@dataclass(frozen=True, slots=True)
class Components:
    """All components of a train. A node is a link seen from a carrier; node arrays run in parallel."""

    links: tuple[str, ...]
    index: Mapping[str, int]
    frame: int
    circuits: Sequence[Circuit]
    node_link: Sequence[int]
    """Link and carrier of each node, as indices into `links`."""
    node_carrier: Sequence[int]
    """Link and carrier of each node, as indices into `links`."""
    node_group: Sequence[int]
    """The component each node belongs to."""
    ratios: FactoredRatios
    """Its speed relative to the carrier, over that of its component's unknown."""
    node_circuit: Sequence[int]
    """The circuit by which the walk reached it; -1 at the root."""
    group_carrier: Sequence[int]
    """Carrier of each component."""
    nodes_of: Mapping[int, Sequence[int]]
    """Link -> its nodes."""
    closing: Sequence[int]
    """Circuits that close a loop and agree: each is redundant."""
    breaking: Sequence[int]
    """Circuits that close a loop and disagree: they lock their component."""
    holding: Sequence[int]
    """Couplings of winding number 0: they hold the slot's component on its carrier."""

    @property
    def node_parent(self) -> Sequence[int]:
        """The node that each one was reached from; -1 at a root."""
        return self.ratios.parent

    def relative(self, node: int) -> Fraction:
        """Speed of the node's link relative to its carrier, over the component's unknown."""
        return self.ratios.value(node)

    def node(self, link: int, carrier: int) -> int:
        """The node of a link as seen from a carrier."""
        return next(node for node in self.nodes_of[link] if self.node_carrier[node] == carrier)

    def group_of(self, circuit: Circuit) -> int:
        """The component a circuit belongs to."""
        return self.node_group[self.node(self.index[circuit.i], self.index[circuit.carrier])]

    def loop(self, circuit: int) -> Loop:
        """The loop that a closing or breaking circuit completes, in order, with its ratio product."""
        chord = self.circuits[circuit]
        carrier = self.index[chord.carrier]
        up, down = [self.node(self.index[link], carrier) for link in (chord.i, chord.j)]
        left, right = ways_to_common_ancestor(up, down, self._above)
        # walk: common ancestor -> ... -> i, over the chord to j, and back up to the ancestor
        walk = left[::-1] + right[:-1]
        pairs = [self.node_circuit[node] for node in left[-2::-1]] + [circuit]
        pairs += [self.node_circuit[node] for node in right[:-1]]
        return Loop(
            chord.carrier,
            tuple(self.links[self.node_link[node]] for node in walk),
            tuple(self.circuits[pair].id for pair in pairs),
            self.closing_product(circuit),
        )

    def closing_product(self, circuit: int) -> Fraction:
        """The product of the ratios round the loop that a circuit completes, (20): 1 where it closes.

        It is by how much the circuit contradicts the walk through its component, from its first link to its second.
        """
        chord = self.circuits[circuit]
        carrier = self.index[chord.carrier]
        first, second = (self.relative(self.node(self.index[link], carrier)) for link in (chord.i, chord.j))
        return chord.gain * first / second

    def _above(self, node: int) -> int | None:
        above = self.node_parent[node]
        return above if above >= 0 else None

    def path(self, nodes: Iterable[int]) -> list[int]:
        """The circuits that join some nodes of one component: the part of the train that relates them."""
        wanted = list(nodes)
        chains = [chain_to_root(node, self._above) for node in wanted]
        common = set(chains[0]).intersection(*chains[1:]) if chains else set()
        used = {self.node_circuit[node]: None for chain in chains for node in chain if node not in common}
        return [circuit for circuit in used if circuit >= 0]


@collector_paused()
def find_components(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], first: Iterable[str] = ()
) -> Components:
    """Walk every carrier's ordinary train once, breadth first, in short ratios: (18), (19) of docs/theory.md.

    first   links to start from where possible (the inputs): their component's unknown is then their own speed,
            and no long number is ever multiplied by another
    """
    index = {link: at for at, link in enumerate(links)}
    node_link, node_carrier, edges, holding = _nodes(index, circuits)
    nodes_of: dict[int, list[int]] = {}
    for at, link in enumerate(node_link):
        if link in nodes_of:
            nodes_of[link].append(at)
        else:
            nodes_of[link] = [at]
    count = len(node_link)
    ratios = FactoredRatios(count)
    group, reached = [-1] * count, [-1] * count
    group_carrier: list[int] = []
    closing: list[int] = []
    breaking: list[int] = []
    for root in _starts(nodes_of, [index[link] for link in first if link in index], count):
        if group[root] >= 0:
            continue
        this = len(group_carrier)
        group_carrier.append(node_carrier[root])
        group[root] = this
        ratios.set_root(root, 1)
        queue = deque([root])
        while queue:
            here = queue.popleft()
            entered = reached[here]
            for at, there, a, b in edges[here]:
                if at == entered:  # by circuit, not by node: a second mesh with the same wheel closes a loop
                    continue
                if group[there] < 0:
                    group[there], reached[there] = this, at
                    ratios.follow(there, here, a, b)
                    queue.append(there)
                elif at != reached[there] and here < there:  # each chord is looked at from one side
                    agrees = ratios.vanishes(((here, a), (there, -b)))
                    (closing if agrees else breaking).append(at)
    return Components(
        tuple(links), index, index[frame], circuits, node_link, node_carrier, group, ratios, reached,
        group_carrier, nodes_of, closing, breaking, holding,
    )  # fmt: skip


_Edge = tuple[int, int, int, int]


def _nodes(
    index: Mapping[str, int], circuits: Sequence[Circuit]
) -> tuple[list[int], list[int], list[list[_Edge]], list[int]]:
    """Nodes, and for each its edges (circuit, far node, a, b): the far wheel's speed is a/b times the near one's."""
    size = len(index)
    node_of: dict[int, int] = {}
    node_link: list[int] = []
    node_carrier: list[int] = []
    edges: list[list[_Edge]] = []
    holding: list[int] = []

    def node(link: int, carrier: int) -> int:
        key = carrier * size + link
        found = node_of.get(key)
        if found is None:
            found = node_of[key] = len(node_link)
            node_link.append(link)
            node_carrier.append(carrier)
            edges.append([])
        return found

    for at, (_, _, i, j, k, a, b, _, _) in enumerate(circuits):
        carrier = index[k]
        here = node(index[i], carrier)
        if b == 0:
            holding.append(at)
            continue
        there = node(index[j], carrier)
        edges[here].append((at, there, -a, b))
        edges[there].append((at, here, -b, a))
    return node_link, node_carrier, edges, holding


def _starts(nodes_of: Mapping[int, Sequence[int]], first: Sequence[int], count: int) -> Iterator[int]:
    for link in first:
        yield from nodes_of.get(link, ())
    yield from range(count)


@dataclass(frozen=True, slots=True)
class ReducedSystem:
    """What couples the components: unknown numbers, the form of every link in them, and the equations left.

    Unknowns 0..g-1 are the components' own; above them, one for each carrier but the frame, and one for each link
    that meshes with nothing. `origin` says what each equation states, for diagnoses: ("share", link, node) a link
    seen from two carriers, ("loop", circuit, -1) a loop that does not close, ("hold", circuit, -1) a follower.
    """

    components: Components
    unknowns: int
    own: Mapping[int, int]
    equations: tuple[LinearForm, ...]
    origin: tuple[tuple[str, int, int], ...]

    def form(self, link: int) -> LinearForm:
        """The speed of a link as a linear form of the unknowns."""
        parts = self.components
        if link == parts.frame:
            return {}
        unknown = self.own.get(link)
        if unknown is not None:
            return {unknown: Fraction(1)}
        return self.seen_from(parts.nodes_of[link][0])

    def unknowns_of(self, link: int) -> tuple[int, ...]:
        """The unknowns in a link's form, without their coefficients, which may be long."""
        parts = self.components
        if link == parts.frame:
            return ()
        unknown = self.own.get(link)
        if unknown is not None:
            return (unknown,)
        node = parts.nodes_of[link][0]
        carrier = parts.node_carrier[node]
        return (parts.node_group[node], *(() if carrier == parts.frame else (self.own[carrier],)))

    def seen_from(self, node: int) -> LinearForm:
        """The speed of a node's link: its carrier's plus its own relative to it."""
        parts = self.components
        row: LinearForm = {parts.node_group[node]: parts.relative(node)}
        carrier = parts.node_carrier[node]
        if carrier != parts.frame:
            row[self.own[carrier]] = Fraction(1)
        return row


@collector_paused()
def reduce_components(parts: Components) -> ReducedSystem:
    """Collapse every component to its one unknown and write what remains to be solved: docs/theory.md, 8."""
    groups = len(parts.group_carrier)
    carriers = dict.fromkeys(carrier for carrier in parts.group_carrier if carrier != parts.frame)
    idle = (link for link in range(len(parts.links)) if link not in parts.nodes_of and link != parts.frame)
    own = {link: groups + at for at, link in enumerate(dict.fromkeys([*carriers, *idle]))}
    shell = ReducedSystem(parts, groups + len(own), own, (), ())
    equations: list[LinearForm] = []
    origin: list[tuple[str, int, int]] = []
    for link, nodes in parts.nodes_of.items():
        loose = nodes if link in own or link == parts.frame else nodes[1:]
        for node in loose:
            row = shell.form(link)
            add_into(row, shell.seen_from(node), -1)
            equations.append(row)
            origin.append(("share", link, node))
    still: set[int] = set()  # components that are stopped already
    for kind, chords in (("loop", parts.breaking), ("hold", parts.holding)):
        for circuit in chords:
            group = parts.group_of(parts.circuits[circuit])
            if group not in still:  # a component that stands still cannot be stopped again
                still.add(group)
                equations.append({group: Fraction(1)})
                origin.append((kind, circuit, -1))
    return ReducedSystem(parts, shell.unknowns, own, tuple(equations), tuple(origin))


@dataclass(frozen=True)
class SolvedPart:
    """A train, or the part of it that matters, ready to be solved; its components are made when first needed."""

    links: tuple[str, ...]
    frame: str
    circuits: Sequence[Circuit]
    first: tuple[str, ...]
    """Links to walk from where possible (the inputs)."""

    @cached_property
    def reduced(self) -> ReducedSystem:
        """Components collapsed to one unknown each, and the equations left."""
        return reduce_components(find_components(self.links, self.frame, self.circuits, self.first))


def relevant_circuits(circuits: Sequence[Circuit], keep: Iterable[str]) -> list[Circuit]:
    """The circuits that can matter to the links in `keep`: loose ends come off one by one (docs/theory.md, 10).

    A circuit with a link that is in no other circuit and not wanted only serves to move that link: it goes,
    and so on until none is left. Loops have no such end, so a locked train stays locked.
    """
    wanted = set(keep)
    users: dict[str, set[int]] = {}
    members: list[tuple[str, ...]] = []
    for at, circuit in enumerate(circuits):
        # only links whose coefficient is not 0: such a link alone can always meet its row
        links = tuple(link for link, _ in circuit.terms)
        members.append(links)
        for link in links:
            users.setdefault(link, set()).add(at)
    gone = set()
    queue = deque(link for link, used in users.items() if len(used) == 1 and link not in wanted)
    while queue:
        link = queue.popleft()
        if len(users[link]) != 1:
            continue
        (at,) = users[link]
        gone.add(at)
        for other in members[at]:
            users[other].discard(at)
            if len(users[other]) == 1 and other not in wanted:
                queue.append(other)
    return [circuit for at, circuit in enumerate(circuits) if at not in gone]
