"""A train under load as plain arrays, as the kernel of its balance reads it: motion, contacts, order of solution."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.motion.composition_arrays import ComposedSources, CompositionOrder, make_composition_arrays
from geartrain.dynamics.turn.pair_contact import BasicEfficiency, NoLosses, PinFriction, ToothFriction
from geartrain.dynamics.turn.position_balance import MOST_TRIED
from geartrain.teeth.contact_kernel import ContactTable, ContactTables, join_contact_tables, make_contact_table
from geartrain.teeth.transmission_kernel import TransmissionTables, chain_transmission_tables

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.dynamics.torques.torque_balance import LoadedPair, TorqueUnknown
    from geartrain.dynamics.turn.pair_contact import PairContact
    from geartrain.dynamics.turn.turn_balance import TurnBalance
    from geartrain.numerics.arrays import Floats, Ints

NOTHING, EFFICIENCY, TEETH, PIN = 0, 1, 2, 3  # what a contact loses


class TurningArrays(NamedTuple):
    """How links and drivers turn.

    order, sources   of the composition
    laws             of all sources with drive flanks touching, then of all with coast flanks
    flank            of each source, which of the flanked pairs it is; -1 for one without play
    sense, mean      of each link: its axis' sense over the input's, and its mean speed
    """

    order: CompositionOrder
    sources: ComposedSources
    laws: TransmissionTables
    flank: Ints
    sense: Floats
    mean: Floats


class ContactArrays(NamedTuple):
    """The contacts of all pairs and couplings.

    source, table   of its law; tables of the drive flank and, next to it, of the coast flank; -1 for a constant ratio
    kind            what is lost, by `sliding` and `static` (of an efficiency: the driver driving, the driven side)
    radius, offset  of a pin
    first           1 where the law's driver is the circuit's first link
    flank           which of the flanked pairs it is; -1 for none
    end, carrier    rows of links: of the law's driver, of the carrier; `links`, the circuit's own two, (contacts, 2)
    lead, alike     the contact whose torques it has, and whether that names its links in the same order
    signs           of its torques on both links beside the lead's, (contacts, 2)
    column          of its multiplier
    """

    source: Ints
    table: Ints
    kind: Ints
    sliding: Floats
    static: Floats
    radius: Floats
    offset: Floats
    ratio: Floats
    way: Ints
    sense: Ints
    first: Ints
    flank: Ints
    end: Ints
    carrier: Ints
    links: Ints
    lead: Ints
    alike: Ints
    signs: Ints
    column: Ints


class BalanceArrays(NamedTuple):
    """The order of solution.

    lead          of each column the contact whose torques it has, or -1; `sided`, 1 where its sign matters
    entry         range of each column's entries; each is a row with its constant part, and what multiplies the torques
                  on the contact's first and second link
    row, column   of each block, between `block[k]` and `block[k + 1]`
    known         of each row, from loads
    """

    lead: Ints
    sided: Ints
    entry: Ints
    entry_row: Ints
    entry_part: Floats
    block: Ints
    row: Ints
    column: Ints
    known: Floats


class BearingArrays(NamedTuple):
    """Bearings that rub: rows of links, of balance rows (-1 for the frame), senses of their axes, and torques."""

    link: Ints
    carrier: Ints
    row: Ints
    carrier_row: Ints
    sense: Floats
    carrier_sense: Floats
    sliding: Floats
    static: Floats
    drag: Floats


class TurnArrays(NamedTuple):
    """All that the kernel reads."""

    turning: TurningArrays
    contacts: ContactArrays
    tables: ContactTables
    balance: BalanceArrays
    bearings: BearingArrays


def make_turn_arrays(train: TurnBalance) -> TurnArrays | None:
    """The arrays of a train.

    None where nothing in it is uneven, something is not read from tables, or too much would have to be tried.
    """
    balance = _balance(train) if train.motion.composition.used else None
    turning = None if balance is None else _turning(train)
    if balance is None or turning is None:
        return None
    tables: list[ContactTable | None] = []
    at: dict[str, int] = {}
    for name, contact in train.contacts.items():
        if contact.source is None:
            continue
        rubs = isinstance(contact.losses, ToothFriction)
        flanks = [contact.source.law, contact.source.law.turned_back()]
        made = [make_contact_table(law, rubs) for law in (flanks if contact.has_flanks else flanks[:1])]
        at[name] = len(tables)
        tables += [*made, *made][:2]
    whole = [table for table in tables if table is not None]
    contacts = _contacts(train, at)
    if contacts is None or len(whole) < len(tables):
        return None
    return TurnArrays(turning, contacts, join_contact_tables(whole), balance, _bearings(train))


def _turning(train: TurnBalance) -> TurningArrays | None:
    motion = train.motion
    ahead, back = (
        make_composition_arrays(each) for each in (motion.composition, motion.coasting_all_along(train.flanked))
    )
    if ahead is None or back is None or (ahead.order.coupled != back.order.coupled).any():
        return None
    names = {name: at for at, name in enumerate(train.flanked)}
    flank = [names.get(source.id, -1) for source in motion.composition.used]
    laws = chain_transmission_tables(ahead.laws, back.laws)
    return TurningArrays(ahead.order, ahead.sources, laws, _ints(flank), motion.senses, motion.means)


def _contacts(train: TurnBalance, tables: Mapping[str, int]) -> ContactArrays | None:
    sources = {source.id: at for at, source in enumerate(train.motion.composition.used)}
    flanks = {name: at for at, name in enumerate(train.flanked)}
    numbers = {name: at for at, name in enumerate(train.contacts)}
    links = train.motion.links
    losses = [contact_losses(each) for each in train.contacts.values()]
    if None in losses or any(each.source is not None and each.name not in sources for each in train.contacts.values()):
        return None
    own = list(train.contacts.values())
    columns = [train.columns[train.of_pair[each.name]] for each in own]
    leads = [numbers[column.meshes[0].id] for column in columns]
    lost = np.array([each for each in losses if each is not None]).reshape(-1, 5).T
    beside = [train.beside_lead[each.name] for each in own]
    return ContactArrays(
        source=_ints(-1 if each.source is None else sources[each.name] for each in own),
        table=_ints(tables.get(each.name, -1) for each in own),
        kind=_ints(lost[0]),
        sliding=lost[1].copy(),
        static=lost[2].copy(),
        radius=lost[3].copy(),
        offset=lost[4].copy(),
        ratio=np.array([each.ratio for each in own]),
        way=_ints(each.way for each in own),
        sense=_ints(each.sense for each in own),
        first=_ints(each.first for each in own),
        flank=_ints(flanks.get(each.name, -1) for each in own),
        end=_ints(links[each.ends[0]] for each in own),
        carrier=_ints(links[each.circuit.carrier] for each in own),
        links=np.array([[links[each.circuit.i], links[each.circuit.j]] for each in own], dtype=np.int64).reshape(-1, 2),
        lead=_ints(leads),
        alike=_ints(alike for alike, _ in beside),
        signs=np.array([signs for _, signs in beside], dtype=np.int64).reshape(-1, 2),
        column=_ints(train.of_pair[each.name] for each in own),
    )


def contact_losses(contact: PairContact) -> tuple[int, float, float, float, float] | None:
    """What a contact loses, in numbers; None for what no number tells."""
    losses = contact.losses
    if isinstance(losses, NoLosses):
        return NOTHING, 0.0, 0.0, 0.0, 0.0
    if isinstance(losses, BasicEfficiency):
        return EFFICIENCY, losses.driver, losses.driven, 0.0, 0.0
    if isinstance(losses, PinFriction):
        return PIN, losses.sliding, losses.static, losses.law.r, losses.law.e
    if isinstance(losses, ToothFriction) and not callable(losses.sliding):
        return TEETH, losses.sliding, losses.static, 0.0, 0.0
    return None


def _balance(train: TurnBalance) -> BalanceArrays | None:
    parts = train.balance.parts
    sided = [bool(each.meshes) and train.contacts[each.meshes[0].id].two_sided for each in train.columns]
    for block in parts:
        if len(block.rows) != len(block.columns) or sum(sided[at] for at in block.columns) > MOST_TRIED:
            return None
    numbers = {name: at for at, name in enumerate(train.contacts)}
    entries = [_entries(train, column) for column in train.columns]
    rows = [(row, part) for each in entries for row, part in each.items()]
    known = np.zeros(max([len(train.balance.links), *(row + 1 for row in train.balance.rows)]))
    for link, torque in train.loads.items():
        known[train.balance.links.index(link)] += torque
    return BalanceArrays(
        _ints(numbers[each.meshes[0].id] if each.meshes else -1 for each in train.columns),
        _ints(sided),
        _starts(len(each) for each in entries),
        _ints(row for row, _ in rows),
        np.array([part for _, part in rows], dtype=float).reshape(-1, 3),
        _starts(len(block.rows) for block in parts),
        _ints(row for block in parts for row in block.rows),
        _ints(column for block in parts for column in block.columns),
        known,
    )


def _entries(train: TurnBalance, column: TorqueUnknown) -> dict[int, Floats]:
    """By row the constant part of a column, and what multiplies the torques on its contact's two links."""
    found: dict[int, Floats] = {}
    if not column.meshes:
        return {row: np.array([float(value), 0.0, 0.0]) for row, value in column.pieces[0].items()}
    for mesh in column.meshes:
        first, second = _members(train, mesh)
        for row, member, factor in train.balance.places(mesh):
            part = float(factor) * np.array([0.0, first[member], second[member]])
            found[row] = found.get(row, np.zeros(3)) + part
    return found


def _members(train: TurnBalance, mesh: LoadedPair) -> tuple[Sequence[int], Sequence[int]]:
    """What the torques on the lead's first and second link add to the three links of a mesh."""
    i, j, k = mesh.senses
    alike, (at_first, at_second) = train.beside_lead[mesh.id]
    own = (i * at_first, 0, -k * at_first), (0, j * at_second, -k * at_second)
    return own if alike else own[::-1]


def _bearings(train: TurnBalance) -> BearingArrays:
    links, rows, tree = train.motion.links, list(train.balance.links), train.setting.tree
    frame = train.setting.train.frame
    carriers = [tree.parent[link][0] for link in train.bearings]
    own = list(train.bearings.values())
    return BearingArrays(
        _ints(links[link] for link in train.bearings),
        _ints(links[link] for link in carriers),
        _ints(rows.index(link) for link in train.bearings),
        _ints(-1 if link == frame else rows.index(link) for link in carriers),
        np.array([float(train.setting.sense(link)) for link in train.bearings]),
        np.array([0.0 if link == frame else float(train.setting.sense(link)) for link in carriers]),
        *(np.array([each[part] for each in own], dtype=float) for part in range(3)),
    )


def _ints(values: Iterable[float]) -> Ints:
    return np.array([int(value) for value in values], dtype=np.int64)


def _starts(counts: Iterable[int]) -> Ints:
    return np.cumsum([0, *counts], dtype=np.int64)
