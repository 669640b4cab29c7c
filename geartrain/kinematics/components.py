"""Ordinary trains in the frame of each carrier: exact relative ratios, and loops with their ratio products.

Relative to one carrier, the links that mesh form an ordinary train, whose relative speeds are rational multiples of one
unknown. Breadth-first search finds all these trains. A mesh that closes a loop is redundant if it is consistent with
the other meshes. If it is not, it locks the train to its carrier. The components are coupled by the links that they
share, and the resulting system is small for practical trains.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain

from geartrain.kinematics.answer import Loop
from geartrain.kinematics.circuits import Circuit
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.elimination import LinearForm, add_into
from geartrain.numerics.factored_ratios import FactoredRatios
from geartrain.numerics.graphs import chain_to_root, ways_to_common_ancestor


@dataclass(frozen=True, slots=True)
class Components:
    """Components of a train as arrays over nodes. A component is an ordinary train of links that mesh relative to one
    carrier; a node is a link relative to a carrier.
    """

    links: tuple[str, ...]
    index: Mapping[str, int]
    frame: int
    circuits: Sequence[Circuit]
    node_link: Sequence[int]
    """Link of each node, as an index into `links`."""
    node_carrier: Sequence[int]
    """Carrier of each node, as an index into `links`."""
    node_group: Sequence[int]
    """Index of the component of each node."""
    ratios: FactoredRatios
    """Speed of each node's link relative to the node's carrier, divided by the unknown speed of the component."""
    node_circuit: Sequence[int]
    """Index of the circuit through which the breadth-first search reached each node; -1 for a root."""
    group_carrier: Sequence[int]
    """Carrier of each component, as an index into `links`."""
    nodes_of: Mapping[int, Sequence[int]]
    """Indices of the nodes of each link, by index of the link; there is one node for each carrier relative to which the
    link meshes.
    """
    closing: Sequence[int]
    """Indices of the circuits that close a loop with ratio product 1; each of these circuits is redundant."""
    breaking: Sequence[int]
    """Indices of the circuits that close a loop with another ratio product and lock their component to its carrier."""
    holding: Sequence[int]
    """Indices of the couplings with winding number 0, which lock the component of the slot to its carrier."""

    @property
    def node_parent(self) -> Sequence[int]:
        """Predecessor of each node in the search tree, as a node index; -1 for a root."""
        return self.ratios.parent

    def relative(self, node: int) -> Fraction:
        """Return the relative speed of a node's link, divided by the unknown speed of its component."""
        return self.ratios.value(node)

    def node(self, link: int, carrier: int) -> int:
        """Return the index of the node of a link relative to a carrier."""
        return next(node for node in self.nodes_of[link] if self.node_carrier[node] == carrier)

    def group_of(self, circuit: Circuit) -> int:
        """Return the index of the component that contains a circuit."""
        return self.node_group[self.node(self.index[circuit.i], self.index[circuit.subtracted[0]])]

    def ends(self, circuit: Circuit) -> tuple[int, int]:
        """Return the nodes of links i and j of a circuit, relative to its carrier."""
        pairs = zip((circuit.i, circuit.j), circuit.subtracted, strict=True)
        first, second = (self.node(self.index[link], self.index[base]) for link, base in pairs)
        return first, second

    def loop(self, circuit: int) -> Loop:
        """Return the loop that is closed by a circuit in `closing` or `breaking`, with its ratio product."""
        chord = self.circuits[circuit]
        up, down = self.ends(chord)
        left, right = ways_to_common_ancestor(up, down, self._predecessor)
        # closed walk: common ancestor -> ... -> i, over the chord to j, and back to the ancestor
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
        """Return the ratio product of the loop that a circuit closes, equation (20) of docs/theory.md; 1 if the loop
        can turn.

        It is the speed ratio of the circuit divided by the ratio along the search tree between the same two links.
        """
        chord = self.circuits[circuit]
        first, second = map(self.relative, self.ends(chord))
        return chord.gain * first / second

    def _predecessor(self, node: int) -> int | None:
        above = self.node_parent[node]
        return above if above >= 0 else None

    def path(self, nodes: Iterable[int]) -> list[int]:
        """Return the indices of the circuits on the paths in the search tree between nodes of one component. These
        circuits determine the ratios of the nodes' speeds.
        """
        wanted = list(nodes)
        chains = [chain_to_root(node, self._predecessor) for node in wanted]
        common = set(chains[0]).intersection(*chains[1:]) if chains else set()
        used = {self.node_circuit[node]: None for chain in chains for node in chain if node not in common}
        return [circuit for circuit in used if circuit >= 0]


@collector_paused()
def find_components(
    links: Sequence[str], frame: str, circuits: Sequence[Circuit], first: Iterable[str] = ()
) -> Components:
    """Return the components of a train, found by breadth-first search: equations (18) and (19) of docs/theory.md.

    first   links from which the search starts if possible, usually the inputs; the unknown of a component is then the
            speed of an input, which avoids products of fractions with many digits
    """
    index = {link: at for at, link in enumerate(links)}
    node_link, node_carrier, edges, holding = _nodes(index, circuits)
    nodes_of: dict[int, list[int]] = {}
    for at, link in enumerate(node_link):
        nodes_of.setdefault(link, []).append(at)
    count = len(node_link)
    ratios = FactoredRatios(count)
    group, reached = [-1] * count, [-1] * count
    group_carrier: list[int] = []
    closing: list[int] = []
    breaking: list[int] = []
    starts = (node for link in first if link in index for node in nodes_of.get(index[link], ()))
    # then components that contain no input
    for root in chain(starts, range(count)):
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
                # compare circuits, not nodes, because a second mesh between the same nodes closes a loop
                if at == entered:
                    continue
                if group[there] < 0:
                    group[there], reached[there] = this, at
                    ratios.follow(there, here, a, b)
                    queue.append(there)
                elif at != reached[there] and here < there:  # each chord is tested from one side only
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
    """Return the link, the carrier and the edges of each node, and the indices of the couplings with winding number 0.
    An edge (circuit, other node, a, b) means that the other node's relative speed is a/b times the relative speed of
    this node.
    """
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

    for at, (_, _, i, j, k, a, b, _, _, _, bases) in enumerate(circuits):
        first, second = bases or (k, k)
        here = node(index[i], index[first])
        # a follower prescribes the slot's relative speed 0, and relates no two nodes
        if b == 0:
            holding.append(at)
            continue
        there = node(index[j], index[second])
        # a w_i + b w_j = 0 gives each relative speed from the other
        edges[here].append((at, there, -a, b))
        edges[there].append((at, here, -b, a))
    return node_link, node_carrier, edges, holding


@dataclass(frozen=True, slots=True)
class ReducedSystem:
    """Linear system that couples the components: unknowns, equations, and the speed of every link as a linear form.

    Unknowns 0 to g - 1 are the speeds of the g components. They are followed by one unknown for each carrier other than
    the frame, and one for each link that does not mesh. `origin` states why each equation holds: ("share", link, node)
    because a link has only one speed although it meshes relative to two carriers, ("loop", circuit, -1) because a loop
    cannot turn, ("hold", circuit, -1) because a coupling has the winding number 0.
    """

    components: Components
    unknowns: int
    own: Mapping[int, int]
    equations: tuple[LinearForm, ...]
    origin: tuple[tuple[str, int, int], ...]

    def form(self, link: int) -> LinearForm:
        """Return the speed of a link as a linear form in the unknowns."""
        parts = self.components
        if link == parts.frame:
            return {}
        unknown = self.own.get(link)
        if unknown is not None:
            return {unknown: Fraction(1)}
        return self.seen_from(parts.nodes_of[link][0])

    def unknowns_of(self, link: int) -> tuple[int, ...]:
        """Return the indices of the unknowns on which the speed of a link depends."""
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
        """Return the speed of a node's link as a linear form: the carrier's speed plus the link's relative speed."""
        parts = self.components
        row: LinearForm = {parts.node_group[node]: parts.relative(node)}
        carrier = parts.node_carrier[node]
        if carrier != parts.frame:
            row[self.own[carrier]] = Fraction(1)
        return row


@collector_paused()
def reduce_components(parts: Components) -> ReducedSystem:
    """Return the system that couples the components, each with one unknown speed (section 8 of docs/theory.md)."""
    groups = len(parts.group_carrier)
    # a component that contains a travel has several carriers
    carriers = dict.fromkeys(each for each in (*parts.group_carrier, *parts.node_carrier) if each != parts.frame)
    idle = (link for link in range(len(parts.links)) if link not in parts.nodes_of and link != parts.frame)
    own = {link: groups + at for at, link in enumerate(dict.fromkeys([*carriers, *idle]))}
    shell = ReducedSystem(parts, groups + len(own), own, (), ())
    equations: list[LinearForm] = []
    origin: list[tuple[str, int, int]] = []
    for link, nodes in parts.nodes_of.items():
        # without an own unknown, the first node of a link defines its speed and needs no equation
        loose = nodes if link in own or link == parts.frame else nodes[1:]
        for node in loose:
            row = shell.form(link)
            add_into(row, shell.seen_from(node), -1)
            equations.append(row)
            origin.append(("share", link, node))
    still: set[int] = set()  # components that are already locked
    for kind, chords in (("loop", parts.breaking), ("hold", parts.holding)):
        for circuit in chords:
            group = parts.group_of(parts.circuits[circuit])
            if group not in still:  # a second equation for a locked component would be redundant
                still.add(group)
                equations.append({group: Fraction(1)})
                origin.append((kind, circuit, -1))
    return ReducedSystem(parts, shell.unknowns, own, tuple(equations), tuple(origin))


@dataclass(frozen=True)
class SolvedPart:
    """Links and circuits of a whole train, or of the part of it that affects the requested links. Components are
    computed on first use.
    """

    links: tuple[str, ...]
    frame: str
    circuits: Sequence[Circuit]
    first: tuple[str, ...]
    """Links from which the search of components starts if possible (the inputs)."""

    @cached_property
    def reduced(self) -> ReducedSystem:
        """Reduced system, with one unknown for each component and the equations that couple the components."""
        return reduce_components(find_components(self.links, self.frame, self.circuits, self.first))


def relevant_circuits(circuits: Sequence[Circuit], keep: Iterable[str]) -> list[Circuit]:
    """Return the circuits that can affect the speeds of the links in `keep`, by repeated removal of leaves
    (section 10 of docs/theory.md).

    If a link is not in `keep` and occurs in only one circuit, this circuit only determines the speed of that link and
    is removed. This is repeated until no such circuit remains. Loops have no leaves, so a locked train stays locked.
    """
    wanted = set(keep)
    users: dict[str, set[int]] = {}
    members: list[tuple[str, ...]] = []
    for at, circuit in enumerate(circuits):
        # only links with a non-zero coefficient: such a link can always satisfy its row
        links = tuple(link for link, _ in circuit.terms)
        members.append(links)
        for link in links:
            users.setdefault(link, set()).add(at)
    gone = set()
    queue = deque(link for link, used in users.items() if len(used) == 1 and link not in wanted)
    while queue:
        link = queue.popleft()
        # another leaf may have removed the last circuit of this link since it was queued
        if len(users[link]) != 1:
            continue
        (at,) = users[link]
        gone.add(at)
        for other in members[at]:
            users[other].discard(at)
            if len(users[other]) == 1 and other not in wanted:
                queue.append(other)
    return [circuit for at, circuit in enumerate(circuits) if at not in gone]
