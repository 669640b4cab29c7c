"""Torque balance of every link, A^T x + T = 0: the transpose of the Willis system, exact, with losses.

Equations (1) to (7) of docs/torques.md. A mesh of links i and j with carrier k and the row a (w_i - w_k) +
b (w_j - w_k) = 0 carries one multiplier x: without loss its torques are a x on i, b x on j, and minus their sum on k.
Where i drives in the carrier's frame, j gets the share eta of its torque; where j drives, i does. The loss is the
driver's power in that frame times 1 - eta: never negative.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.block_triangular import Block, dulmage_mendelsohn_blocks
from geartrain.numerics.elimination import LinearForm

DrivingSides = Mapping[str, int]
"""Mesh id -> 1 where its first link drives in the carrier's frame, -1 where the second does, 0 without loss."""

LoadShares = tuple[str, Mapping[str, Fraction]]
"""A link, and the meshes on one wheel of it with the parts of a torque that they carry."""
_SCALES = 1_000_003, 1_414_213  # of the coefficients of a row, so that nothing in it cancels by chance


@dataclass(frozen=True)
class LoadedPair:
    """One gear pair or coupling as a path of power: equations (1), (2), (4) and (5) of docs/torques.md."""

    id: str
    links: tuple[str, str, str]
    """I, j, k, and 1 or -1 for the sense of each link's axis."""
    senses: tuple[int, int, int]
    """I, j, k, and 1 or -1 for the sense of each link's axis."""
    a: int
    """Coefficients of its row."""
    b: int
    """Coefficients of its row."""
    rolling: Fraction
    """A (w_i - w_k), which is -b (w_j - w_k): 0 where the two do not roll on each other."""
    forward: Fraction = Fraction(1)
    """Efficiency with i driving, `backward` with j driving; at most 1, 0 or less locks."""
    backward: Fraction = Fraction(1)

    def __post_init__(self) -> None:
        """Raises `GearTrainError` for a pair that would give more than it takes."""
        if max(self.forward, self.backward) > 1:
            what = f"pair '{self.id}' has an efficiency of {float(max(self.forward, self.backward)):g}"
            raise GearTrainError(Problem(what, "above 1 it would create power", "give an efficiency of at most 1"))

    @property
    def loses(self) -> bool:
        """True if it matters which of the two drives."""
        return bool(self.rolling) and (self.forward != 1 or self.backward != 1)

    @property
    def turn(self) -> int:
        """Sign of the rolling: power flows from i to j where the multiplier has the other sign."""
        return (self.rolling > 0) - (self.rolling < 0)

    @property
    def sides(self) -> tuple[int, ...]:
        """The ways power may flow: one that locks can only idle, which the other way tells as well."""
        if not self.loses:
            return (0,)
        return tuple(side for side in (1, -1) if self.efficiency(side) > 0) or (1,)

    def efficiency(self, side: int) -> Fraction:
        """Efficiency with i driving (1) or j (-1)."""
        return self.forward if side > 0 else self.backward if side < 0 else Fraction(1)

    def torques(self, side: int) -> tuple[Fraction, Fraction, Fraction]:
        """Torques on i, j, k per unit of the multiplier: equation (5)."""
        left = self.a * (self.backward if side < 0 else Fraction(1))
        right = self.b * (self.forward if side > 0 else Fraction(1))
        return left * self.senses[0], right * self.senses[1], -(left + right) * self.senses[2]

    def signs_beside(self, lead: LoadedPair, alike: bool) -> tuple[int, int]:
        """Signs of the torques on both links beside those of a pair that bears as much, for one unknown of both.

        alike   both name their links in the same order; a planet whose axis points the other way has another sign
        """
        led = (lead.a, lead.b) if alike else (lead.b, lead.a)
        first, second = (-1 if own * other < 0 else 1 for own, other in zip((self.a, self.b), led, strict=True))
        return first, second

    def power(self, multiplier: Fraction) -> Fraction:
        """Power p that flows from i to j in the carrier's frame, before losses where i drives: equation (4)."""
        return -multiplier * self.rolling


@dataclass(frozen=True)
class TorqueUnknown:
    """One unknown torque, the same in all its meshes, and what a unit of it does to each row."""

    pieces: Mapping[int, LinearForm]
    """Side of the first mesh that loses -> row -> coefficient; side 0 is without loss."""
    meshes: tuple[LoadedPair, ...] = ()
    sides: tuple[int, ...] = (0,)
    """Which of them are tried."""
    turn: int = 0
    """Sign of that mesh's rolling."""
    barred: bool = False
    """No power can pass: the torque must vanish."""

    def admits(self, side: int, torque: Fraction) -> bool:
        """True if power flows the way `side` says, or not at all."""
        if self.barred and torque:
            return False
        return side == 0 or ((torque > 0) - (torque < 0)) * side * self.turn <= 0

    def side_of(self, mesh: LoadedPair, side: int) -> int:
        """The side of one of its meshes: they have one multiplier, but may name their wheels in another order."""
        return side * mesh.turn * self.turn if mesh.loses else 0


@dataclass(frozen=True)
class TorqueBalance:
    """What is known and what is not in one case.

    links     all links but the frame
    known     external torque by link: loads and friction of bearings; links not named have none
    unknown   links whose external torque is asked for
    reactions by such a link, what takes the reaction of its torque if not the frame, and that of a torque of 1
    held      links held to the frame; `locks`, pairs of links that turn together, with the senses of both axes
    ties      groups of meshes with equal multipliers, as of equal planets
    shares    declared parts of the torque on a wheel
    """

    links: tuple[str, ...]
    meshes: tuple[LoadedPair, ...]
    known: Mapping[str, Fraction]
    unknown: tuple[str, ...]
    held: tuple[str, ...] = ()
    locks: tuple[tuple[tuple[str, int], tuple[str, int]], ...] = ()
    ties: tuple[tuple[str, ...], ...] = ()
    shares: tuple[LoadShares, ...] = ()
    reactions: Mapping[str, tuple[str, int]] = field(default_factory=dict)

    @cached_property
    def columns(self) -> tuple[TorqueUnknown, ...]:
        """All unknowns: torques of meshes, then external ones, brakes and locks."""
        tied = {name: group for group in self.ties for name in group}
        groups: dict[tuple[str, ...], list[LoadedPair]] = {}
        for mesh in self.meshes:
            groups.setdefault(tied.get(mesh.id, (mesh.id,)), []).append(mesh)
        one = Fraction(1)
        outside: list[Iterable[tuple[str, Fraction]]] = [
            ((link, one), *((base, Fraction(own)) for base, own in (self.reactions.get(link, ("", 0)),) if own))
            for link in self.unknown
        ]
        outside += [((link, one),) for link in self.held]
        outside += [((a, Fraction(s)), (b, Fraction(-t))) for (a, s), (b, t) in self.locks]
        plain = [TorqueUnknown({0: _row((self._at[link], value) for link, value in each if link in self._at)})
                 for each in outside]  # fmt: skip
        return (*(self._column(tuple(group)) for group in groups.values()), *plain)

    @cached_property
    def rows(self) -> Mapping[int, Fraction]:
        """Rows that must vanish, each with its known torque: one a link and one a share.

        Rows of equal planets are proportional: one of them is enough.
        """
        links, shared = len(self.links), sum(len(parts) - 1 for _, parts in self.shares)
        known = {row: self.known.get(link, Fraction(0)) for row, link in enumerate(self.links)}
        held: dict[int, list[tuple[int, int, Fraction]]] = {row: [] for row in range(links + shared)}
        for at, column in enumerate(self.columns):
            for side, piece in column.pieces.items():
                for row, value in piece.items():
                    held[row].append((at, side, value))
        alike: dict[tuple[int, ...], list[int]] = {}
        for row, entries in held.items():
            if entries or known.get(row):
                alike.setdefault(tuple(at for at, _, _ in entries), []).append(row)
        kept: list[int] = []
        for group in alike.values():
            said = {_direction(held[row], known.get(row, Fraction(0))): row for row in reversed(group)}
            kept += said.values() if len(group) > 1 else group
        return {row: known.get(row, Fraction(0)) for row in sorted(kept)}

    @cached_property
    def parts(self) -> Sequence[Block]:
        """Blocks of rows and columns in the order in which they can be solved, the same for every pattern."""
        held: dict[int, set[int]] = {row: set() for row in self.rows}
        for at, column in enumerate(self.columns):
            for piece in column.pieces.values():
                for row in held.keys() & piece.keys():
                    held[row].add(at)
        return dulmage_mendelsohn_blocks(held, len(self.columns))

    @property
    def whole(self) -> Block:
        """All of it as one block, for a balance in which a block leaves open what a later one needs."""
        return Block(tuple(self.rows), tuple(range(len(self.columns))))

    @cached_property
    def _at(self) -> Mapping[str, int]:
        return {link: at for at, link in enumerate(self.links)}

    @cached_property
    def _parts(self) -> Mapping[str, Sequence[tuple[int, str, Fraction]]]:
        """By mesh, the rows of shares it stands in: its torque on a link, by its share, equals that of the first."""
        found: dict[str, list[tuple[int, str, Fraction]]] = {}
        row = len(self.links)
        for link, shares in self.shares:
            (first, whole), *others = shares.items()
            for name, part in others:
                found.setdefault(first, []).append((row, link, 1 / whole))
                found.setdefault(name, []).append((row, link, -1 / part))
                row += 1
        return found

    def _column(self, meshes: tuple[LoadedPair, ...]) -> TorqueUnknown:
        lossy = [mesh for mesh in meshes if mesh.loses]
        turn = lossy[0].turn if lossy else 0
        sides = lossy[0].sides if lossy else (0,)
        blank = TorqueUnknown({}, meshes, sides, turn, bool(lossy) and lossy[0].efficiency(sides[0]) <= 0)
        pieces = {
            side: _row(entry for mesh in meshes for entry in self._entries(mesh, blank.side_of(mesh, side)))
            for side in dict.fromkeys((0, *sides))
        }
        return TorqueUnknown(pieces, meshes, sides, turn, blank.barred)

    def places(self, mesh: LoadedPair) -> Iterator[tuple[int, int, Fraction]]:
        """Where the torques of a mesh stand: the row, which of its three links it is of, and a factor."""
        yield from ((self._at[link], at, Fraction(1)) for at, link in enumerate(mesh.links) if link in self._at)
        yield from ((row, mesh.links.index(link), factor) for row, link, factor in self._parts.get(mesh.id, ()))

    def _entries(self, mesh: LoadedPair, side: int) -> Iterator[tuple[int, Fraction]]:
        torques = mesh.torques(side)
        yield from ((row, torques[at] * factor) for row, at, factor in self.places(mesh))


def _direction(entries: Sequence[tuple[int, int, Fraction]], known: Fraction) -> tuple[object, ...]:
    """A row up to a factor."""
    lead = entries[0][2] if entries else known
    return (known / lead, *((at, side, value / lead) for at, side, value in entries))


def _row(entries: Iterable[tuple[int, Fraction]]) -> LinearForm:
    """Entries of one row summed up, zeros left out."""
    row: LinearForm = {}
    for at, value in entries:
        row[at] = row.get(at, Fraction(0)) + value
    return {at: value for at, value in row.items() if value}


@dataclass(frozen=True)
class SolvedTorques:
    """Torques under one pattern: multipliers by mesh, external torques asked for, and on brakes and locks."""

    multipliers: Mapping[str, Fraction]
    external: Mapping[str, Fraction]
    brakes: Mapping[str, Fraction]
    locks: tuple[Fraction | None, ...]
    """By lock, the torque it exerts on its first link about the direction of the parallels; None where it is open."""
    loose: tuple[str, ...]
    """Meshes whose torque is not determined, as between planets; they count 0."""
    open: tuple[str, ...]
    """Links asked for or held whose external torque is not determined for that; left out."""


def idle_pairs(balance: TorqueBalance) -> set[str]:
    """The pairs through which no torque passes at any position: nothing beyond them asks for one."""
    rows = {row for row, torque in balance.rows.items() if torque}
    idle: set[str] = set()
    for block in balance.parts:
        columns = [balance.columns[at] for at in block.columns]
        if rows.isdisjoint(block.rows):
            idle.update(mesh.id for column in columns for mesh in column.meshes)
        else:
            rows.update(row for column in columns for row in column.pieces[0])
    return idle


def without_pairs(balance: TorqueBalance, names: set[str]) -> TorqueBalance:
    """The balance of the rest."""
    return replace(
        balance,
        meshes=tuple(mesh for mesh in balance.meshes if mesh.id not in names),
        ties=tuple(tied for tied in balance.ties if names.isdisjoint(tied)),
    )


def generic_balance(balance: TorqueBalance) -> TorqueBalance:
    """The balance with numbers of which nothing cancels by chance, as at single positions: for the order in it."""
    group = {name: at for at, names in enumerate(balance.ties, 1) for name in names}
    meshes = tuple(
        replace(
            mesh,
            a=_SCALES[0] * mesh.a + group.get(mesh.id, len(balance.ties) + at),
            b=_SCALES[1] * (mesh.b or -1),
            forward=Fraction(1),
            backward=Fraction(1),
        )
        for at, mesh in enumerate(balance.meshes, 1)
    )
    return replace(balance, meshes=meshes)
