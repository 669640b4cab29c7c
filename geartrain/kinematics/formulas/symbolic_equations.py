"""A train's equations in the counts that are free: what `components` collapses, written with monomials.

Seen from one carrier, the links that mesh turn at monomial multiples of one unknown. What couples these components,
and what is held, locked and driven, are rows of monomials and sums of monomials.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from geartrain.kinematics.circuits import Circuit
from geartrain.kinematics.components import Components, find_components, reduce_components
from geartrain.kinematics.formulas.laurent import Laurent
from geartrain.kinematics.formulas.symbolic_elimination import GIVEN, Row
from geartrain.numerics.elimination import add_into
from geartrain.train import StateCase


@dataclass(frozen=True, slots=True)
class Chord:
    """A circuit that closes a loop: the product of the loop's ratios, and the component it closes in."""

    circuit: int
    product: Laurent
    group: int


class SymbolicEquations:
    """The rows of one case, all of which must vanish, in unknowns numbered as in `reduce_components`.

    circuits   with any counts that make no two free wheels alike
    free       wheel -> index of its variable

    rows, origin   the equations, and in words what each of them states
    chords         loops that close for some of the free counts only
    """

    def __init__(
        self,
        links: Sequence[str],
        frame: str,
        circuits: Sequence[Circuit],
        case: StateCase,
        signs: Mapping[str, int],
        free: Mapping[str, int],
    ) -> None:
        self._free, self._signs = free, signs
        self.width = len(free)
        parts = find_components(links, frame, circuits, case.inputs)
        self._ratios = self._find_ratios(parts)
        loops = [self._chord(parts, at) for at in (*parts.closing, *parts.breaking)]
        one = Laurent.constant(1, self.width)
        never = [chord.circuit for chord in loops if chord.product.is_constant and chord.product != one]
        self.chords = tuple(chord for chord in loops if not chord.product.is_constant)
        self._reduced = reduce_components(replace(parts, breaking=never))
        self.parts = parts
        stated = [*self._coupling(), *self._held(case), *self._driven(case)]
        self.rows = [row for row, _ in stated]
        self.origin = [words for _, words in stated]

    def relative(self, link: str, base: str) -> Row:
        """The speed of a link as seen from another, about the first one's axis, as a form of the unknowns."""
        row = self._form(self.parts.index[link])
        add_into(row, self._form(self.parts.index[base]), self._number(-1))
        sign = self._number(self._signs.get(link, 1))
        return {column: entry * sign for column, entry in row.items()}

    def unknown(self, group: int) -> Row:
        """The unknown of one component."""
        return {group: self._number(1)}

    def _find_ratios(self, parts: Components) -> list[Laurent]:
        """The speed of every node relative to its carrier, over that of its component's unknown."""
        found: dict[int, Laurent] = {}
        for start in range(len(parts.node_link)):
            chain = []
            node = start
            while node not in found and parts.node_parent[node] >= 0:
                chain.append(node)
                node = parts.node_parent[node]
            found.setdefault(node, self._number(1))
            for child in reversed(chain):
                step = self._step(parts.circuits[parts.node_circuit[child]], parts.links[parts.node_link[child]])
                found[child] = found[parts.node_parent[child]] * step
        return [found[node] for node in range(len(parts.node_link))]

    def _step(self, circuit: Circuit, to: str) -> Laurent:
        """Speed of one link of a circuit over that of the other, in their carrier's frame."""
        a, b = self._side(circuit, 0), self._side(circuit, 1)
        near, far = (a, b) if to == circuit.j else (b, a)
        return -(near * far.inverse())

    def _side(self, circuit: Circuit, side: int) -> Laurent:
        """a or b of a circuit: a variable with its sign, where the wheel is free."""
        given = (circuit.a, circuit.b)[side]
        variable = self._free.get(circuit.wheels[side]) if circuit.kind == "gear" else None
        if variable is None:
            return self._number(given)
        size = Laurent.variable(variable, self.width)
        return size if given > 0 else -size

    def _chord(self, parts: Components, at: int) -> Chord:
        chord = parts.circuits[at]
        carrier = parts.index[chord.carrier]
        i, j = (parts.node(parts.index[link], carrier) for link in (chord.i, chord.j))
        around = self._step(chord, chord.j) * self._ratios[i] * self._ratios[j].inverse()
        return Chord(at, around, parts.node_group[i])

    def _form(self, link: int) -> Row:
        """The speed of a link, unsigned, as a form of the unknowns."""
        reduced = self._reduced
        if link == self.parts.frame:
            return {}
        own = reduced.own.get(link)
        return {own: self._number(1)} if own is not None else self._seen_from(self.parts.nodes_of[link][0])

    def _seen_from(self, node: int) -> Row:
        """The speed of a node's link: its carrier's plus its own relative to it."""
        parts = self.parts
        row: Row = {parts.node_group[node]: self._ratios[node]}
        carrier = parts.node_carrier[node]
        if carrier != parts.frame:
            row[self._reduced.own[carrier]] = self._number(1)
        return row

    def _coupling(self) -> Iterator[tuple[Row, str]]:
        parts = self.parts
        for (kind, subject, node), numbers in zip(self._reduced.origin, self._reduced.equations, strict=True):
            if kind == "share":
                row = self._form(subject)
                add_into(row, self._seen_from(node), self._number(-1))
                yield row, f"'{parts.links[subject]}' is driven in more than one way"
            else:  # a component that is held on its carrier, whatever the counts
                yield self.unknown(next(iter(numbers))), f"'{parts.circuits[subject].id}' holds its wheels"

    def _held(self, case: StateCase) -> Iterator[tuple[Row, str]]:
        index = self.parts.index
        for link in case.fixed:
            yield self._form(index[link]), case.says(link)
        for a, b in case.locks:
            row = self._form(index[a])
            add_into(row, self._form(index[b]), self._number(-1))
            yield row, case.says(a, b)

    def _driven(self, case: StateCase) -> Iterator[tuple[Row, str]]:
        for link, speed in case.inputs.items():
            row = self._form(self.parts.index[link])
            if speed:
                row[GIVEN] = self._number(-speed * self._signs.get(link, 1))
            yield row, f"'{link}' is an input"

    def _number(self, value: Fraction | int) -> Laurent:
        return Laurent.constant(value, self.width)
