"""Exact torque balance of every link including losses, A^T x + T = 0, where A is the matrix of the Willis system.

The equations are (1) to (7) of docs/torques.md. A mesh of links i and j with carrier k and the equation a (w_i - w_k) +
b (w_j - w_k) = 0 has one multiplier x. Without losses, its torques are a x on i, b x on j, and minus their sum on k. If
i drives relative to the carrier, the torque on j is multiplied by the efficiency eta. If j drives, the torque on i is
multiplied by eta. The loss is the driver's power relative to the carrier times 1 - eta; it is never negative.
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
"""Driving side of each mesh: 1 for the first link, -1 for the second link, 0 for a mesh without losses."""

LoadShares = tuple[str, Mapping[str, Fraction]]
"""A link, and the meshes of one of its wheels, each with the fraction of the wheel's torque that it transmits."""
_SCALES = 1_000_003, 1_414_213  # factors of the coefficients of a row, so that nothing cancels by chance


@dataclass(frozen=True)
class LoadedPair:
    """Gear pair or coupling that transmits torque: equations (1), (2), (4) and (5) of docs/torques.md."""

    id: str
    links: tuple[str, ...]
    """Names of the links i, j and k (first, second, carrier), or four if both members react on different links."""
    senses: tuple[int, ...]
    """Senses of the axes of `links` relative to the reference direction, 1 or -1."""
    a: int
    """Coefficient of the first link in the pair's Willis equation."""
    b: int
    """Coefficient of the second link in the pair's Willis equation."""
    rolling: Fraction
    """Rolling speed a (w_i - w_k) = -b (w_j - w_k), where w are angular speeds and a and b the coefficients; 0 without
    relative motion.
    """
    forward: Fraction = Fraction(1)
    """Efficiency if the first link drives, at most 1; 0 or less means self-locking. `backward` is the efficiency if the
    second link drives.
    """
    backward: Fraction = Fraction(1)

    def __post_init__(self) -> None:
        """Raise `GearTrainError` if an efficiency exceeds 1."""
        if max(self.forward, self.backward) > 1:
            what = f"pair '{self.id}' has an efficiency of {float(max(self.forward, self.backward)):g}"
            raise GearTrainError(
                Problem(what, "an efficiency above 1 would create power", "give an efficiency of at most 1")
            )

    @property
    def loses(self) -> bool:
        """True if the pair has losses, so that its torques depend on the driving side."""
        return bool(self.rolling) and (self.forward != 1 or self.backward != 1)

    @property
    def turn(self) -> int:
        """Sign of `rolling`. If the pair's multiplier has the opposite sign, power flows to the second link."""
        return (self.rolling > 0) - (self.rolling < 0)

    @property
    def sides(self) -> tuple[int, ...]:
        """Driving sides to be tried, without self-locking ones; (1,) if both sides are self-locking."""
        if not self.loses:
            return (0,)
        return tuple(side for side in (1, -1) if self.efficiency(side) > 0) or (1,)

    def efficiency(self, side: int) -> Fraction:
        """Return the efficiency if the first (`side` 1) or the second link (`side` -1) drives; 1 for side 0."""
        return self.forward if side > 0 else self.backward if side < 0 else Fraction(1)

    def torques(self, side: int) -> tuple[Fraction, ...]:
        """Return the torque on each link of `links` if the multiplier x of the pair is 1, equation (5) of
        docs/torques.md. `side` is 1 if the first link drives, -1 if the second link drives.
        """
        left = self.a * (self.backward if side < 0 else Fraction(1))
        right = self.b * (self.forward if side > 0 else Fraction(1))
        reactions = (-left - right,) if len(self.links) == 3 else (-left, -right)
        return tuple(sense * torque for sense, torque in zip(self.senses, (left, right, *reactions), strict=True))

    def power(self, multiplier: Fraction) -> Fraction:
        """Return the power that flows from the first link to the second relative to the carrier, given the multiplier x
        of the pair, equation (4) of docs/torques.md. If the first link drives, losses are not subtracted.
        """
        return -multiplier * self.rolling


@dataclass(frozen=True)
class TorqueUnknown:
    """Unknown torque that one or more meshes have in common, with its coefficient in each row of the balance."""

    pieces: Mapping[int, LinearForm]
    """Coefficients of the torque, by driving side and row of the balance. A driving side refers to the first mesh with
    losses; side 0 is used for meshes without losses.
    """
    meshes: tuple[LoadedPair, ...] = ()
    sides: tuple[int, ...] = (0,)
    """Driving sides of the first mesh with losses that are to be tried."""
    turn: int = 0
    """Sign of the rolling speed of the first mesh with losses."""
    barred: bool = False
    """True if no power can flow through the mesh, so that the torque must be 0."""
    sense: int = 0
    """Required sign of the torque of a one-way clutch, 1 or -1; 0 if any sign is permitted."""

    def admits(self, side: int, torque: Fraction) -> bool:
        """Return True if this unknown can have the value `torque`: it transmits no power, or power from the driving
        side `side` (1 for the first link, -1 for the second link, 0 for either).
        """
        if (self.barred and torque) or self.sense * torque < 0:
            return False
        return side == 0 or ((torque > 0) - (torque < 0)) * side * self.turn <= 0

    def side_of(self, mesh: LoadedPair, side: int) -> int:
        """Return the driving side of `mesh`, one of the equal meshes with this unknown, if the driving side of the
        first of them is `side`: 1 for the first link, -1 for the second link; 0 if the mesh has no losses.
        """
        return side * mesh.turn * self.turn if mesh.loses else 0


@dataclass(frozen=True)
class TorqueBalance:
    """Known and unknown torques in one load case.

    links       all links except the frame
    meshes      gear pairs and couplings
    known       external torque, from loads and bearing friction, by link; 0 for other links
    unknown     links with unknown external torque
    held        links that are braked to the frame
    locks       pairs of links that are locked together, each link with the sense of its axis
    ties        names of the meshes in each group with one common multiplier, such as the meshes of equal planets
    shares      declared fractions of the torque of a wheel
    reactions   link on which the reaction to an unknown torque acts, if it is not the frame, and the sign of this
                reaction, by link with unknown torque
    senses      sign of the torque on the last link of a brake or lock that consists of one-way clutches, by its links
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
    senses: Mapping[tuple[str, ...], int] = field(default_factory=dict)

    @cached_property
    def columns(self) -> tuple[TorqueUnknown, ...]:
        """All unknowns in this order: torques of meshes, external torques, brakes and locks."""
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
        rows = [_row((self._at[link], value) for link, value in each if link in self._at) for each in outside]
        plain = [TorqueUnknown({0: row}, sense=sense) for row, sense in zip(rows, self._signs, strict=True)]
        return (*(self._column(tuple(group)) for group in groups.values()), *plain)

    @property
    def _signs(self) -> tuple[int, ...]:
        """Sign that each unknown external, brake and lock torque must have, 1 or -1; 0 if both are permitted."""
        held = (self.senses.get((link,), 0) for link in self.held)
        # the unknown torque of a lock acts on its first link, and with the opposite sign on the second
        locks = (-t * self.senses.get((a, b), 0) for (a, _), (b, t) in self.locks)
        return (*(0 for _ in self.unknown), *held, *locks)

    @cached_property
    def rows(self) -> Mapping[int, Fraction]:
        """Known torque of each row of the balance; there is one row for each link and for each declared share.

        Rows of equal planets are proportional, so only one of them is kept.
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
            # the first of several proportional rows is kept
            said = {_direction(held[row], known.get(row, Fraction(0))): row for row in reversed(group)}
            kept += said.values() if len(group) > 1 else group
        return {row: known.get(row, Fraction(0)) for row in sorted(kept)}

    @cached_property
    def parts(self) -> Sequence[Block]:
        """Blocks of rows and columns in an order of solution that is valid for every pattern of power flow."""
        held: dict[int, set[int]] = {row: set() for row in self.rows}
        for at, column in enumerate(self.columns):
            for piece in column.pieces.values():
                for row in held.keys() & piece.keys():
                    held[row].add(at)
        return dulmage_mendelsohn_blocks(held, len(self.columns))

    @property
    def whole(self) -> Block:
        """Whole balance as one block, for cases in which a block depends on unknowns of a later block."""
        return Block(tuple(self.rows), tuple(range(len(self.columns))))

    @cached_property
    def _at(self) -> Mapping[str, int]:
        return {link: at for at, link in enumerate(self.links)}

    @cached_property
    def _parts(self) -> Mapping[str, Sequence[tuple[int, str, Fraction]]]:
        """Coefficients of the equations for declared shares of load, by mesh: row of the balance, link of the shared
        wheel, and coefficient of the mesh's torque.
        """
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
        # sides of the other meshes refer to the first lossy one
        blank = TorqueUnknown({}, meshes, sides, turn, bool(lossy) and lossy[0].efficiency(sides[0]) <= 0)
        pieces = {}
        for side in dict.fromkeys((0, *sides)):
            torques = [mesh.torques(blank.side_of(mesh, side)) for mesh in meshes]
            entries = zip(meshes, torques, strict=True)
            pieces[side] = _row(
                (row, own[at] * factor) for mesh, own in entries for row, at, factor in self.places(mesh)
            )
        return replace(blank, pieces=pieces)

    def places(self, mesh: LoadedPair) -> Iterator[tuple[int, int, Fraction]]:
        """Yield the entries of a mesh's torques in the balance: row index, index into `links`, and factor."""
        yield from ((self._at[link], at, Fraction(1)) for at, link in enumerate(mesh.links) if link in self._at)
        yield from ((row, mesh.links.index(link), factor) for row, link, factor in self._parts.get(mesh.id, ()))


def _direction(entries: Sequence[tuple[int, int, Fraction]], known: Fraction) -> tuple[object, ...]:
    """Return the entries of a row and its known torque divided by its first entry, equal for proportional rows."""
    scale = entries[0][2] if entries else known
    return (known / scale, *((at, side, value / scale) for at, side, value in entries))


def _row(entries: Iterable[tuple[int, Fraction]]) -> LinearForm:
    """Return one row of the balance, by column, in which entries of the same column are added and zeros are omitted."""
    row: LinearForm = {}
    for at, value in entries:
        row[at] = row.get(at, Fraction(0)) + value
    return {at: value for at, value in row.items() if value}


@dataclass(frozen=True)
class SolvedTorques:
    """Solution of the torque balance for one pattern of power flow: multiplier of each pair, external torque of each
    link, and torques of brakes and locks.
    """

    multipliers: Mapping[str, Fraction]
    external: Mapping[str, Fraction]
    brakes: Mapping[str, Fraction]
    locks: tuple[Fraction | None, ...]
    """Torque of each lock on its first link, about the reference direction of parallel axes; None if undetermined."""
    loose: tuple[str, ...]
    """Names of the meshes with undetermined torque, such as those of several planets. Their multiplier is set to 0."""
    open: tuple[str, ...]
    """Requested or braked links whose torque is undetermined. They are omitted from `external` and `brakes`."""


def idle_pairs(balance: TorqueBalance) -> set[str]:
    """Return the names of the pairs that transmit no torque at any position of the input, because no torque acts on the
    links that they could drive.
    """
    rows = {row for row, torque in balance.rows.items() if torque}
    idle: set[str] = set()
    for block in balance.parts:
        columns = [balance.columns[at] for at in block.columns]
        if rows.isdisjoint(block.rows):
            idle.update(mesh.id for column in columns for mesh in column.meshes)
        else:
            rows.update(row for column in columns for row in column.pieces[0])
    return idle


def generic_balance(balance: TorqueBalance) -> TorqueBalance:
    """Return the balance with arbitrary coefficients that do not cancel by chance, from which the order of solution
    follows.
    """
    group = {name: at for at, names in enumerate(balance.ties, 1) for name in names}
    meshes = tuple(
        replace(
            mesh,
            # equal planets get equal coefficients, other meshes different ones
            a=_SCALES[0] * mesh.a + group.get(mesh.id, len(balance.ties) + at),
            # b = 0 is a follower, which transmits torque at single positions, but not on average
            b=_SCALES[1] * (mesh.b or -1),
            forward=Fraction(1),
            backward=Fraction(1),
        )
        for at, mesh in enumerate(balance.meshes, 1)
    )
    return replace(balance, meshes=meshes)


def equal_planets(balance: TorqueBalance) -> dict[str, tuple[str, ...]]:
    """Return, for each planet, the names of all planets equal to it, including its own name."""
    ends = {mesh.id: mesh.links[:2] for mesh in balance.meshes}
    found: dict[str, tuple[str, ...]] = {}
    for group in balance.ties:
        common = set.intersection(*(set(ends[name]) for name in group))
        if not common:  # of two kinds of planets, which mesh with each other
            continue
        planets = tuple(sorted(link for name in group for link in ends[name] if link not in common))
        found |= dict.fromkeys(planets, planets)
    return found
