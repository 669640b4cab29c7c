"""Torque balance of a train at any position of the input: torques, powers and losses.

The order of solution (8) and the consistency test of a pattern (7) are the same as in the balance of mean torques; only
the coefficients depend on the position. A block with one pair is solved by division. For a block with several coupled
pairs, all patterns of power flow are enumerated, each at all positions in one array operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.turn.train_contacts import DriverState, PairForce
from geartrain.numerics.arrays import joined, some

if TYPE_CHECKING:
    from geartrain.dynamics.torques.bearing_loads import BearingLoads
    from geartrain.dynamics.torques.load_case import LoadCase
    from geartrain.dynamics.torques.torque_balance import TorqueBalance, TorqueUnknown
    from geartrain.dynamics.turn.position_motion import LinkMotion, PositionMotion
    from geartrain.dynamics.turn.train_contacts import BearingTorques, PairContact
    from geartrain.numerics.arrays import Bools, Floats, Indices
    from geartrain.numerics.block_triangular import Block

MOST_TRIED = 7  # two-sided torques of a block with exhaustive enumeration: 2^7 small systems per position
_MOST_ROUNDS = 30  # maximum iterations for blocks with more two-sided torques
_MOST_LAYERS = 16  # maximum number of solutions kept per position
NEAR = 1e-9  # [maximum torque] the sign of a smaller torque is undecided
SINGULAR = 1e-13  # [product of the row norms, Hadamard's bound] a smaller determinant counts as 0
SAME = 1e-8  # [maximum torque] solutions closer than this are equal
AT_REST = 1e-12  # [maximum speed] slower links are at rest
FAINT = 1e-9  # [maximum torque of a pair] smaller torques do not press on a flank
CONVERGED = 1e-14  # [maximum friction torque] smaller changes end the iteration of loaded bearings
_MOST_LOADED = 200  # maximum iterations of loaded bearings; one that needs more is at the limit of locking
ROUNDS = 6  # maximum iterations to find consistent flanks and speeds


@dataclass(frozen=True)
class ColumnPieces:
    """Coefficients of one unknown torque in the rows of the balance at n positions, for each sign of the torque."""

    pieces: Mapping[int, Mapping[int, Floats]]
    """Coefficients of shape (n,), by side and row. The side is the sign of the torque, or 0 if it has no effect."""
    barred: Mapping[int, Bools]
    """Boolean mask of the positions at which the torque must be 0, by side."""

    @property
    def sides(self) -> tuple[int, ...]:
        """Signs of the torque for which coefficients are given: 1 and -1, or only 0 if the sign has no effect."""
        return tuple(self.pieces)


@dataclass
class BalanceLayer:
    """One solution of the torque balance at n positions. `valid` is False at positions without this solution."""

    values: Floats
    """Torques by column, shape (columns, n). `rows` contains the sum of the torques in each row, shape (rows, n)."""
    rows: Floats
    valid: Bools
    """Boolean mask of the positions at which the torques of all rows are balanced."""

    def copy(self) -> BalanceLayer:
        """Return a copy that does not share arrays with this object."""
        return BalanceLayer(self.values.copy(), self.rows.copy(), self.valid.copy())


@dataclass(frozen=True)
class _Trial:
    """Torques of one block for assumed signs, shape (columns, n). `valid` is True at positions at which the torques
    have these signs.
    """

    layer: BalanceLayer
    sides: Sequence[int]
    values: Floats
    valid: Bools


def solve_positions(
    columns: Sequence[ColumnPieces], parts: Sequence[Block], known: Floats
) -> tuple[list[BalanceLayer], bool]:
    """Return every solution of the torque balance at every position, and True if all patterns were tried.

    known   known torque of each row, shape (rows, n)
    """
    size = known.shape[1]
    layers = [BalanceLayer(np.zeros((len(columns), size)), known.copy(), np.ones(size, bool))]
    complete = True
    for block in parts:
        trials: list[_Trial] = []
        for layer in layers:
            found, tried = _block_trials(columns, block, layer)
            trials += found
            complete &= tried
        layers = _joined(columns, block, layers, trials)
        complete &= len(layers) <= _MOST_LAYERS
        layers = layers[:_MOST_LAYERS]
    return layers, complete


def _block_trials(columns: Sequence[ColumnPieces], block: Block, layer: BalanceLayer) -> tuple[list[_Trial], bool]:
    """Return the solutions of one block in which the torques have the assumed signs, without duplicates, and True if
    all combinations of signs were tried.
    """
    own = [columns[at] for at in block.columns]
    found: list[_Trial] = []
    two_sided = sum(len(each.sides) > 1 for each in own)
    if two_sided > MOST_TRIED:
        return _iterated(own, block, layer), False
    for sides in product(*(each.sides for each in own)):
        values, valid = _solve(own, block, layer, sides)
        for other in found:
            # patterns that differ only in torques of 0 give the same solution
            if (both := valid & other.valid).any():
                near = np.abs(values - other.values) <= SAME * np.max(np.abs(values), axis=0, initial=0.0)
                valid &= ~(both & near.all(axis=0))
        if valid.any():
            found.append(_Trial(layer, sides, values, valid))
    return found, True


def _solve(
    own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer, sides: Sequence[int]
) -> tuple[Floats, Bools]:
    """Return the torques of one block for assumed signs `sides`, shape (columns, n), and a mask of the positions at
    which they have these signs.
    """
    known = layer.rows[list(block.rows)]
    if len(block.rows) == len(block.columns) == 1:
        values, valid = _divided(own[0].pieces[sides[0]].get(block.rows[0]), known)
    else:
        values, valid = _eliminated(own, block, layer, sides)
    scale = np.max(np.abs(values), axis=0, initial=0.0)
    # signs must agree with the pattern beyond rounding, and barred torques must be 0
    against = np.max(-values * np.array(sides)[:, None], axis=0, initial=0.0) > NEAR * scale
    valid = valid & layer.valid & ~against
    for each, side, value in zip(own, sides, values, strict=True):
        if (barred := each.barred.get(side)) is not None:
            valid &= ~(barred & (np.abs(value) > NEAR * scale))
    return values, valid


def _divided(coefficient: Floats | None, known: Floats) -> tuple[Floats, Bools]:
    """Return the unknown of a linear equation, and a mask of the positions at which its coefficient is not 0."""
    if coefficient is None:
        return np.zeros_like(known), known[0] == 0
    # a coefficient may be 0 at dead points; without a load the torque is 0 there too
    with np.errstate(divide="ignore", invalid="ignore"):
        values = np.where(known == 0, 0.0, -known / coefficient)
    regular = np.isfinite(values[0])
    return np.where(regular, values, 0.0), regular


def _eliminated(
    own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer, sides: Sequence[int]
) -> tuple[Floats, Bools]:
    """Return the torques of one block with several rows, of minimum norm if they are not unique, and a mask of the
    positions at which they satisfy all rows.
    """
    known = layer.rows[list(block.rows)]
    scale = np.max(np.abs(layer.values), axis=0, initial=0.0)
    size = known.shape[1]
    matrices = np.zeros((size, len(block.rows), len(block.columns)))
    for column, (each, side) in enumerate(zip(own, sides, strict=True)):
        for row, label in enumerate(block.rows):
            if (piece := each.pieces[side].get(label)) is not None:
                matrices[:, row, column] = piece
    right = -known.T[:, :, None]
    if not block.columns:
        return np.zeros((0, size)), (np.abs(known) <= NEAR * scale).all(axis=0)
    values = np.empty((size, len(block.columns), 1))
    regular = np.zeros(size, bool)
    if len(block.rows) == len(block.columns):
        # Hadamard's bound makes the test independent of the units of the rows
        lengths = np.linalg.norm(matrices, axis=2).prod(axis=1)
        regular = np.abs(np.linalg.det(matrices)) > SINGULAR * lengths
        values[regular] = np.linalg.solve(matrices[regular], right[regular])
    if not regular.all():
        # the pseudoinverse gives the minimum-norm torques where rows are missing or dependent
        values[~regular] = np.linalg.pinv(matrices[~regular]) @ right[~regular]
    missed = np.abs(matrices @ values - right).max(axis=(1, 2))
    return values[:, :, 0].T, regular | (missed <= NEAR * (np.abs(right).max(axis=(1, 2)) + scale))


def _iterated(own: Sequence[ColumnPieces], block: Block, layer: BalanceLayer) -> list[_Trial]:
    """Return solutions of one block, found by iteration: each round assumes the signs of the torques of the last."""
    patterns = {tuple(each.sides[0] for each in own): None}
    found: list[_Trial] = []
    left = layer.valid.copy()
    for _ in range(_MOST_ROUNDS):
        fresh: dict[tuple[int, ...], None] = {}
        for sides in patterns:
            values, valid = _solve(own, block, layer, sides)
            valid &= left
            if valid.any():
                found.append(_Trial(layer, sides, values, valid))
                left = left & ~valid
            # signs of the computed torques are the next patterns; one-sided torques keep side 0
            wanted = np.where(values >= 0, 1, -1) * np.array([[len(each.sides) > 1] for each in own])
            fresh |= dict.fromkeys(map(tuple, np.unique(wanted[:, left].T, axis=0).tolist()))
        patterns = {sides: None for sides in fresh if sides not in patterns}
        if not left.any() or not patterns:
            break
    return found


def _joined(
    columns: Sequence[ColumnPieces], block: Block, layers: Sequence[BalanceLayer], trials: Sequence[_Trial]
) -> list[BalanceLayer]:
    """Return the solutions `layers` of the previous blocks, completed by the solutions `trials` of one block."""
    # fast path: at most one solution at every position needs no further layers
    if len(layers) == 1 and not np.any(sum((trial.valid.astype(int) for trial in trials), np.zeros(1)) > 1):
        (layer,) = layers
        layer.valid = np.zeros_like(layer.valid)
        for trial in trials:
            _write(columns, block, trial, layer, trial.valid)
        return [layer]
    found: list[BalanceLayer] = []
    for trial in trials:
        left = trial.valid
        for layer in found:
            free = left & ~layer.valid
            if free.any():
                layer.values[:, free], layer.rows[:, free] = trial.layer.values[:, free], trial.layer.rows[:, free]
                _write(columns, block, trial, layer, free)
                left = left & ~free
        if left.any():
            layer = trial.layer.copy()
            layer.valid = np.zeros_like(left)
            _write(columns, block, trial, layer, left)
            found.append(layer)
    return found or [BalanceLayer(layers[0].values, layers[0].rows, np.zeros_like(layers[0].valid))]


def _write(columns: Sequence[ColumnPieces], block: Block, trial: _Trial, layer: BalanceLayer, where: Bools) -> None:
    """Copy the torques of a block into a solution at the positions `where`, and add them to its rows."""
    layer.valid |= where
    for column, side, value in zip(block.columns, trial.sides, trial.values, strict=True):
        layer.values[column, where] = value[where]
        for row, piece in columns[column].pieces[side].items():
            layer.rows[row, where] += piece[where] * value[where]


_CHUNK = 8192  # positions evaluated at once, to bound the memory


class PositionTorques(NamedTuple):
    """Torques and powers at n positions of the input. Powers are divided by the speed of the input."""

    turns: Floats
    """Positions of the input [revolutions], shape (n,)."""
    valid: Bools
    """Boolean mask of the positions at which a solution balances the loads. `layers` is the number of solutions."""
    unresolved: Bools
    """Boolean mask of positions at which a link rests within its backlash, or no flanks agree with the torques."""
    layers: Floats
    torque: Floats
    """Unknown torque on each requested link in the solution with minimum loss, shape (requested, n)."""
    highest: Floats
    """Unknown torque on each requested link in the solution with maximum loss, shape (requested, n)."""
    speeds: Floats
    """Speeds of the links with external torques about their own axes, divided by the speed of the input, shape
    (outside, n), where `outside` is the number of these links.
    """
    powers: Floats
    """Power of each external torque, positive into the train, shape (outside, n)."""
    losses: Floats
    """Power lost in pairs, followed by power lost in bearings, divided by the input speed, shape (parts, n). `passed`
    is the power input of each driving side.
    """
    passed: Floats
    pressed: Floats
    """Multiplier of each pair, shape (pairs, n); it is positive if the drive flanks are in contact."""
    turning: Floats
    """Speed of each pair's driver in its mean sense, divided by the input speed, shape (pairs, n)."""
    slipping: Floats
    """Speed of each bearing divided by the speed of the input, shape (bearings, n)."""
    kinks: Floats
    """Values that change sign where the torques, but no transmission function, have kinks, shape (kinks, n)."""


class _State(NamedTuple):
    """Motion of the links, driver angles, and torques of pairs with the multiplier 1 on either flank, at n positions.
    Of several equal planets, only the first one is included.
    """

    motion: LinkMotion
    contacts: Mapping[str, DriverState]
    forces: Mapping[str, Mapping[int, PairForce]]
    resting: Mapping[str, Bools]
    """Boolean mask of the positions at which each link is at rest within the backlash of its pairs, by link."""
    static: bool
    loaded: Mapping[str, Floats] = {}
    """Load-dependent friction torque of each bearing, by link."""


@dataclass
class TurnBalance:
    """Train under load, for which torques can be evaluated at any position."""

    setting: LoadCase
    motion: PositionMotion
    balance: TorqueBalance
    """Balance of mean torques, whose order of solution is valid at every position."""
    contacts: Mapping[str, PairContact]
    """Contact of each pair, in the order of the circuits."""
    loads: Mapping[str, float]
    """Load on each link about its own axis, by link. `bearings` contains the friction and drag of each link's
    bearing.
    """
    bearings: Mapping[str, BearingTorques]
    bearing_loads: BearingLoads | None = None
    """Loads of the bearings whose friction depends on the load; None if there are none."""
    complete: bool = True
    """False if there were too many patterns of power flow to try all of them."""
    on_done: Callable[[int], object] | None = None
    """Progress function, called with the number of positions computed since the last call."""

    @property
    def pairs(self) -> tuple[str, ...]:
        """Names of pairs and couplings."""
        return tuple(self.contacts)

    @property
    def requested(self) -> tuple[str, ...]:
        """Names of the links whose torque is unknown."""
        return self.balance.unknown

    @cached_property
    def outside(self) -> tuple[str, ...]:
        """Names of the links with a requested torque or a load, whose external torques may do work."""
        return tuple(dict.fromkeys((*self.requested, *self.loads)))

    @cached_property
    def shared(self) -> tuple[str, ...]:
        """Names of the pairs whose torque is not determined by the balance."""
        open_ = [block for block in self.balance.parts if len(block.columns) > len(block.rows)]
        return tuple(mesh.id for block in open_ for at in block.columns for mesh in self.columns[at].meshes)

    @cached_property
    def columns(self) -> tuple[TorqueUnknown, ...]:
        """Unknown torques of the balance, one for each column of its matrix."""
        return self.balance.columns

    @cached_property
    def of_pair(self) -> Mapping[str, int]:
        """Column index of each gear pair's unknown torque in the matrix of the torque balance, by pair."""
        return {mesh.id: at for at, column in enumerate(self.columns) for mesh in column.meshes}

    @cached_property
    def starts_harder(self) -> bool:
        """True if static friction differs from sliding friction in at least one pair or bearing."""
        return any(each.losses.starts_harder for each in self.contacts.values()) or any(
            each.sliding != each.static or each.drag for each in self.bearings.values()
        )

    # ----------------------------------------------------------------------------------------------------- positions

    def at(self, turns: Floats, static: bool = False) -> PositionTorques:
        """Return the torques and powers at positions of the input [revolutions].

        static   True to use static friction instead of sliding friction
        """
        size = min(_CHUNK, self.motion.composition.chunk)
        parts = []
        # at least one chunk, so that the arrays of an empty run have the right shapes
        for start in range(0, max(len(turns), 1), size):
            parts.append(self._chunk(turns[start : start + size], static))
            if self.on_done is not None:
                self.on_done(len(parts[-1].turns))
        return joined(parts)

    @cached_property
    def flanked(self) -> tuple[str, ...]:
        """Names of the pairs with backlash, which can be in contact on their drive flanks or on their coast flanks."""
        return tuple(name for name, contact in self.contacts.items() if contact.has_flanks)

    def _chunk(self, turns: Floats, static: bool) -> PositionTorques:
        """Return the torques at a few thousand positions.

        The flanks in contact are found by iteration. It begins with the drive flanks, which are also used at positions
        at which it does not converge. A link that would turn backwards on drive flanks and forwards on coast flanks
        rests within its backlash.
        """
        left: Indices = np.arange(len(turns))
        coasting, resting = (np.zeros((len(names), len(turns)), bool) for names in (self.flanked, self.bearings))
        converged: list[tuple[Indices, PositionTorques]] = []
        way = np.zeros((len(self.bearings), len(turns)))
        for round_ in range(ROUNDS):
            touching = {name: row for name, row in zip(self.flanked, coasting, strict=True) if row.any()}
            state = self._state(self.motion.at(turns[left], touching), resting, static)
            state, layers, best = self._balanced(state)
            result = self._position_torques(state, layers, best)._replace(unresolved=np.asarray(resting.any(axis=0)))
            # coast flanks that are loaded, shape (pairs, n)
            pressed = best.values[[self.of_pair[name] for name in self.flanked]]
            found = best.valid & (pressed < -FAINT * np.max(np.abs(best.values), axis=0, initial=0.0))
            if round_ == 0:
                first = result
            changed = (found != coasting).any(axis=0)
            converged.append((left[~changed], some(result, ~changed)))
            # a link whose sense alternates with the choice of flanks rests within the backlash
            turned = np.sign(result.slipping) * way < 0
            resting = (resting | turned if round_ > 0 else resting)[:, changed]
            left, coasting, way = left[changed], found[:, changed], np.sign(result.slipping)[:, changed]
            if not len(left):
                break
        converged.append((left, some(first, left)._replace(unresolved=np.ones(len(left), bool))))
        order = np.argsort(np.concatenate([at for at, _ in converged]))
        return some(joined([part for _, part in converged]), order)

    def _state(self, motion: LinkMotion, resting: Bools, static: bool) -> _State:
        contacts = {}
        for name, each in self.contacts.items():
            turning = each.way * self._speed(motion, each.ends[0], each.bases[0])
            contacts[name] = DriverState(motion.angles.get(name, np.zeros(0)), turning)
        forces: dict[str, dict[int, PairForce]] = {}
        for column in self.columns:
            if column.meshes:
                contact = self.contacts[column.meshes[0].id]
                sides = (1, -1) if contact.two_sided else (1,)
                forces[contact.name] = {side: contact.torques(side, contacts[contact.name], static) for side in sides}
        return _State(motion, contacts, forces, dict(zip(self.bearings, resting, strict=True)), static)

    def _speed(self, motion: LinkMotion, link: str, carrier: str) -> Floats:
        """Return the speed of a link relative to `carrier` at each position, about the reference direction of parallel
        axes; 0 at rest in spite of rounding.
        """
        rows = self.motion.links
        found = motion.speeds[rows[link]] - motion.speeds[rows[carrier]]
        scale = np.max(np.abs(motion.speeds), axis=0, initial=0.0)
        return np.where(np.abs(found) <= AT_REST * scale, 0.0, found)

    def outside_speeds(self, speeds: Floats) -> Floats:
        """Return the speed of each link with an external torque, about its own axis and relative to the link on which
        the reaction acts, shape (links with external torques, positions).
        """
        setting, row = self.setting, self.motion.links
        bases = [setting.reacts_on(link) if link in self.requested else setting.train.frame for link in self.outside]
        senses = np.array([setting.sense(link) for link in self.outside], dtype=float)
        against: Floats = speeds[[row[base] for base in bases]]
        return senses[:, None] * (speeds[[row[link] for link in self.outside]] - against)

    # -------------------------------------------------------------------------------------------------- the balance

    def _balanced(self, state: _State) -> tuple[_State, list[BalanceLayer], BalanceLayer]:
        """Return the state with the load-dependent friction of bearings, all solutions of the balance, and the solution
        with minimum loss. No solution is valid at positions at which the friction does not converge.
        """
        pieces = [self._pieces(column, state) for column in self.columns]
        for round_ in range(_MOST_LOADED):
            layers = self._solved(state, pieces)
            best = self._extreme(layers, state, 1)
            if self.bearing_loads is None:
                return state, layers, best
            after = self._loaded_friction(self.bearing_loads, best, state)
            before = np.array([state.loaded.get(link, np.zeros(after.shape[1])) for link in self.bearing_loads.links])
            off = np.max(np.abs(after - before), axis=0) > CONVERGED * np.max(after, axis=0)
            if not off.any():
                break
            after = after if round_ < _MOST_LOADED / 4 else (before + after) / 2
            state = state._replace(loaded=dict(zip(self.bearing_loads.links, after, strict=True)))
        for layer in layers:
            layer.valid &= ~off
        best.valid = best.valid & ~off
        return state, layers, best

    def _loaded_friction(self, bearings: BearingLoads, best: BalanceLayer, state: _State) -> Floats:
        """Return the load-dependent friction torque of each link's bearings in one solution, shape (links, n)."""
        turns = state.motion.turns
        reactions, angles, leans = np.zeros((3, len(bearings.forces), len(turns)))
        for row, force in enumerate(bearings.forces):
            leans[row] = force.lean
            if force.links[0] is not None:
                first, second = self._member_torques(force.name, best, state)
                reactions[row] = -(first + second)
                column = self.of_pair[force.name]
                by_side = state.forces[self.columns[column].meshes[0].id]
                ahead, back = by_side[1].lean, by_side.get(-1, by_side[1]).lean
                if ahead is not None and back is not None:
                    leans[row] = np.where(best.values[column] < 0, back, ahead)
            elif force.name in self.requested:
                reactions[row] = best.values[self.requested_columns[self.requested.index(force.name)]]
            else:
                reactions[row] = self.loads.get(force.name, 0.0)
            if force.carrier != self.setting.train.frame:
                # transmission errors of the carrier do not change the directions noticeably
                link = self.motion.links[force.carrier]
                angles[row] = 2 * np.pi * turns * self.motion.senses[link] * self.motion.means[link]
        return bearings.friction(bearings.loads(reactions, angles, leans), self.balance)

    def _member_torques(self, name: str, best: BalanceLayer, state: _State) -> tuple[Floats, Floats]:
        """Return the torques of a pair on its two links, about the reference direction of parallel axes."""
        column = self.columns[self.of_pair[name]]
        pressed, forces = best.values[self.of_pair[name]], state.forces[column.meshes[0].id]
        ahead, back = (self._for_planet(name, forces.get(side, forces[1])) for side in (1, -1))
        first, second = (pressed * np.where(pressed < 0, back[end], ahead[end]) for end in (0, 1))
        return first, second

    def _solved(self, state: _State, pieces: Sequence[ColumnPieces]) -> list[BalanceLayer]:
        size = len(state.motion.turns)
        rows = self.balance.links
        known = np.zeros((max([len(rows), *(row + 1 for row in self.balance.rows)]), size))
        for link, torque in self.loads.items():
            known[rows.index(link)] += torque
        for link in self.bearings:
            for bearer, rubbing in self._friction(state, link):
                known[rows.index(bearer)] += rubbing
        layers, complete = solve_positions(pieces, self.balance.parts, known)
        self.complete &= complete
        return layers

    def _friction(self, state: _State, link: str) -> list[tuple[str, Floats]]:
        """Return the friction torques of a bearing on its link and on its carrier, each about its own axis."""
        carrier, setting = self.setting.tree.borne_by(link), self.setting
        speed = self._speed(state.motion, link, carrier)
        torque = np.sign(speed) * self._rubbing(state, link, speed)
        found = [(link, -setting.sense(link) * torque)]
        if carrier != setting.train.frame:
            found.append((carrier, setting.sense(carrier) * torque))
        return found

    def _rubbing(self, state: _State, link: str, speed: Floats) -> Floats:
        """Return the magnitude of a bearing's friction torque at each position, with viscous drag in motion."""
        own, loaded = self.bearings[link], state.loaded.get(link, np.zeros(len(speed)))
        if state.static:
            return own.static + loaded
        return np.where(state.resting[link], 0.0, own.sliding + loaded + own.drag * np.abs(speed))

    def _pieces(self, column: TorqueUnknown, state: _State) -> ColumnPieces:
        """Return the coefficients of an unknown torque in each row of the balance, for each sign of the torque."""
        if not column.meshes:
            size = len(state.motion.turns)
            rows = {row: np.full(size, float(value)) for row, value in column.pieces[0].items()}
            return ColumnPieces({0: rows}, {})
        forces = state.forces[column.meshes[0].id]
        two_sided = len(forces) > 1
        pieces = {side if two_sided else 0: self._rows(column, force) for side, force in forces.items()}
        barred = {side if two_sided else 0: force.barred for side, force in forces.items() if force.barred is not None}
        return ColumnPieces(pieces, barred)

    def _rows(self, column: TorqueUnknown, force: PairForce) -> dict[int, Floats]:
        found: dict[int, Floats] = {}
        for mesh in column.meshes:
            first, second = self._for_planet(mesh.id, force)
            reactions = (-first - second,) if len(mesh.links) == 3 else (-first, -second)
            members = [sense * each for sense, each in zip(mesh.senses, (first, second, *reactions), strict=True)]
            for row, member, factor in self.balance.places(mesh):
                found[row] = found.get(row, 0.0) + float(factor) * members[member]
        return found

    @cached_property
    def relation_to_first(self) -> Mapping[str, tuple[bool, tuple[int, int]]]:
        """Order and signs of each pair's links relative to the links of the first pair with the same unknown torque.

        The order is True if both pairs name their links in the same order. The signs, 1 or -1, relate the torques on
        the two links to the torques of the first pair.
        """
        found = {}
        for first, mesh in ((column.meshes[0], mesh) for column in self.columns for mesh in column.meshes):
            alike = self.contacts[mesh.id].first == self.contacts[first.id].first
            a, b = (first.a, first.b) if alike else (first.b, first.a)
            # a reversed axis of a planet changes the sign
            found[mesh.id] = alike, (-1 if mesh.a * a < 0 else 1, -1 if mesh.b * b < 0 else 1)
        return found

    def _for_planet(self, name: str, force: PairForce) -> tuple[Floats, Floats]:
        """Return the torques on both links of pair `name`, given `force`, the first pair with the same unknown."""
        alike, signs = self.relation_to_first[name]
        first, second = (force.first, force.second) if alike else (force.second, force.first)
        return signs[0] * first, signs[1] * second

    def _extreme(self, layers: Sequence[BalanceLayer], state: _State, way: int) -> BalanceLayer:
        """Return the solution with minimum (`way` 1) or maximum (`way` -1) power input at each position."""
        if len(layers) == 1:
            return layers[0]
        speeds = self.outside_speeds(state.motion.speeds)[: len(self.requested)]
        power = [way * (each.values[self.requested_columns] * speeds).sum(axis=0) for each in layers]
        # minimum power input means minimum loss, because loads are given
        which = np.argmin([np.where(each.valid, p, np.inf) for each, p in zip(layers, power, strict=True)], axis=0)
        found = layers[0].copy()
        for at, layer in enumerate(layers[1:], 1):
            chosen = which == at
            found.values[:, chosen], found.valid[chosen] = layer.values[:, chosen], layer.valid[chosen]
        return found

    @cached_property
    def requested_columns(self) -> list[int]:
        """Indices of the columns of the balance matrix that multiply the unknown external torques."""
        first = next(at for at, column in enumerate(self.columns) if not column.meshes)
        return list(range(first, first + len(self.requested)))

    # ------------------------------------------------------------------------------------------------------- results

    def _position_torques(self, state: _State, layers: Sequence[BalanceLayer], best: BalanceLayer) -> PositionTorques:
        motion, size = state.motion, len(state.motion.turns)
        torque = np.where(best.valid, best.values[self.requested_columns], np.nan)
        worst = self._extreme(layers, state, -1)
        speeds = self.outside_speeds(motion.speeds)
        acting = np.zeros_like(speeds)
        acting[: len(self.requested)] = torque
        for link, load in self.loads.items():
            acting[self.outside.index(link)] += load
        slipping = [self._speed(motion, link, self.setting.tree.borne_by(link)) for link in self.bearings]
        # power lost in a bearing: friction torque times speed
        rubbed = [
            self._rubbing(state, link, each) * np.abs(each) for link, each in zip(self.bearings, slipping, strict=True)
        ]
        flows = [self._flow(name, best, state) for name in self.pairs]
        kinks = [each.losses.kinks(state.contacts[name]) for name, each in self.contacts.items()]
        return PositionTorques(
            motion.turns,
            best.valid,
            np.zeros(size, bool),
            np.sum([each.valid for each in layers], axis=0).astype(float),
            torque,
            np.where(worst.valid, worst.values[self.requested_columns], np.nan),
            speeds,
            acting * speeds,
            _stack([*(loss for loss, _ in flows), *rubbed], size),
            _stack([*(passed for _, passed in flows), *rubbed], size),
            _stack([best.values[self.of_pair[name]] for name in self.pairs], size),
            _stack([state.contacts[name].turning for name in self.pairs], size),
            _stack(slipping, size),
            _stack([each for each in kinks if each is not None], size),
        )

    def _flow(self, name: str, best: BalanceLayer, state: _State) -> tuple[Floats, Floats]:
        """Return the power lost in a pair, and the power input of its driving side relative to the carrier."""
        circuit = self.contacts[name].circuit
        powers = [
            torque * self._speed(state.motion, link, base)
            for torque, link, base in zip(
                self._member_torques(name, best, state), (circuit.i, circuit.j), circuit.subtracted, strict=True
            )
        ]
        return -(powers[0] + powers[1]), np.maximum(-powers[0], 0) + np.maximum(-powers[1], 0)


def _stack(rows: Sequence[Floats], size: int) -> Floats:
    return np.array(rows) if rows else np.zeros((0, size))
