"""The balance of torques over a turn as a kernel: docs/torques.md, sections 16 and 17.

It does what `TurnBalance` does, for the usual position: one at which one pattern of power flow balances, and flanks
agree after some rounds. Any other it leaves to `TurnBalance`, and says so. Some hundred positions at a time go through
every step, so that each table is read for all of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.turn.balance_kernel import BlockScratch, solve_blocks
from geartrain.dynamics.turn.position_balance import AT_REST, FAINT, ROUNDS
from geartrain.dynamics.turn.position_motion_kernel import InputPositions, MotionScratch, move_links
from geartrain.dynamics.turn.turn_arrays import (
    EFFICIENCY,
    PIN,
    TEETH,
    BearingArrays,
    ContactArrays,
    TurnArrays,
)
from geartrain.numerics.kernels import kernel
from geartrain.teeth.contact_kernel import ContactTables, contact_along

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Bools, Floats, Ints

BLOCK = 256
"""Positions: what a train of some fifty pairs needs of them fits into a cache."""


class TurnAnswers(NamedTuple):
    """What the kernel fills in, positions last.

    settled          where it found the one solution; `adrift`, where a link rests in the play
    values           of each column
    speed            of each link, seen from the frame
    S, turning       of each contact's driver: forward angle (rad) and speed
    loss, passed     of each contact
    slipping         of each bearing, and `rubbed`, the power it takes
    """

    settled: Bools
    adrift: Bools
    values: Floats
    speed: Floats
    S: Floats
    turning: Floats
    loss: Floats
    passed: Floats
    slipping: Floats
    rubbed: Floats


@kernel
def balance_positions(
    arrays: TurnArrays, turns: Floats, halves: tuple[Floats, Floats], plain: float, static: bool, found: TurnAnswers
) -> None:
    """Fill in what is found at each position of the input; `halves` and `plain` as of `compose`."""
    turning, contacts, tables, balance, bearings = arrays
    sources, rubbing, pairs = len(turning.flank), len(bearings.link), len(contacts.source)
    flanked = 0
    for at in range(pairs):
        flanked = max(flanked, contacts.flank[at] + 1)
    most, parts, rows = 1, 1, 1
    for step in range(len(turning.order.coupled)):
        most = max(most, turning.order.sources[step + 1] - turning.order.sources[step])
    for own in turning.order.own:
        rows = max(rows, own + 1)
    for at in range(len(tables.contacts)):
        parts = max(parts, 1 + 2 * tables.contacts[at])
    left, right, here = np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK)
    active = np.zeros(BLOCK, dtype=np.int64)
    fine, news, lost = np.zeros(BLOCK, dtype=np.bool_), np.zeros(BLOCK, dtype=np.bool_), np.zeros((2, BLOCK))
    coasting = np.zeros((flanked, BLOCK), dtype=np.bool_)
    resting, way = np.zeros((rubbing, BLOCK), dtype=np.bool_), np.zeros((rubbing, BLOCK))
    angle, speed, still = np.zeros((sources, BLOCK)), np.zeros((len(turning.mean), BLOCK)), np.zeros(BLOCK)
    S, ahead = np.zeros((pairs, BLOCK)), np.zeros((pairs, BLOCK))
    slipping, rubbed = np.zeros((rubbing, BLOCK)), np.zeros((rubbing, BLOCK))
    force, barred = np.zeros((pairs, 2, 2, BLOCK)), np.zeros((pairs, 2, BLOCK), dtype=np.bool_)
    torque, values = np.zeros((len(balance.known), BLOCK)), np.zeros((len(balance.lead), BLOCK))
    asked, u, row = np.zeros((parts, BLOCK)), np.zeros(BLOCK), np.zeros(BLOCK, dtype=np.int64)
    holds = np.zeros((2, BLOCK), dtype=np.bool_)
    of_block = BlockScratch(np.zeros((2, 2, BLOCK)), holds[0], holds[1])
    of_motion = MotionScratch(
        np.zeros((2, rows, BLOCK)),
        np.zeros((most, BLOCK)), np.zeros((most, BLOCK)), np.zeros((most, BLOCK)),
        np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK), np.zeros(BLOCK, dtype=np.int32),
    )  # fmt: skip
    for begin in range(0, len(turns), BLOCK):
        size = min(BLOCK, len(turns) - begin)
        for at in range(size):
            active[at] = begin + at
        coasting[:], resting[:] = False, False
        for round_ in range(ROUNDS + 1):
            if round_ == ROUNDS:  # where no flanks agree the drive flanks stand
                coasting[:], resting[:] = False, False
            for at in range(size):
                here[at], left[at], right[at] = turns[active[at]], halves[0][active[at]], halves[1][active[at]]
            fine[:size] = True
            positions = InputPositions(here[:size], left[:size], right[:size], plain)
            move_links(turning, positions, coasting, angle, speed, fine, of_motion)
            _rest(speed, size, still)
            _press(contacts, tables, angle, speed, still, static, size, S, ahead, force, barred, asked, u, row)
            _rub(bearings, balance.known, speed, still, static, resting, size, slipping, rubbed, torque)
            solve_blocks(balance, force, barred, size, torque, values, fine, of_block)
            _change(contacts, values, size, coasting, news)
            if round_ == ROUNDS:
                news[:size] = False
                for at in range(size):
                    found.adrift[active[at]] = True
            left_over = 0
            for at in range(size):
                if fine[at] and not news[at]:
                    _keep(found, active[at], at, values, speed, S, ahead, slipping, rubbed, resting)
            for pair in range(pairs):
                _lose(contacts, pair, values, force, speed, still, size, lost)
                for at in range(size):
                    if fine[at] and not news[at]:
                        found.loss[pair, active[at]], found.passed[pair, active[at]] = lost[0, at], lost[1, at]
            for at in range(size):
                if not (fine[at] and news[at]):
                    continue
                for bearing in range(rubbing):  # a link that would turn back on its other flanks rests in the play
                    now = np.sign(slipping[bearing, at])
                    turned = round_ > 0 and now * way[bearing, at] < 0
                    resting[bearing, left_over] = resting[bearing, at] or turned
                    way[bearing, left_over] = now
                for flank in range(flanked):
                    coasting[flank, left_over] = coasting[flank, at]
                active[left_over] = active[at]
                left_over += 1
            size = left_over
            if size == 0:
                break


@kernel
def _keep(
    found: TurnAnswers,
    into: int,
    at: int,
    values: Floats,
    speed: Floats,
    S: Floats,
    turning: Floats,
    slipping: Floats,
    rubbed: Floats,
    resting: Bools,
) -> None:
    """One position's answer."""
    found.settled[into] = True
    for column in range(len(values)):
        found.values[column, into] = values[column, at]
    for link in range(len(speed)):
        found.speed[link, into] = speed[link, at]
    for pair in range(len(S)):
        found.S[pair, into], found.turning[pair, into] = S[pair, at], turning[pair, at]
    for bearing in range(len(slipping)):
        found.slipping[bearing, into], found.rubbed[bearing, into] = slipping[bearing, at], rubbed[bearing, at]
        found.adrift[into] = found.adrift[into] or resting[bearing, at]


@kernel
def _rest(speed: Floats, size: int, still: Floats) -> None:
    """Up to which speed something stands still at each position."""
    still[:size] = 0.0
    for link in range(len(speed)):
        for at in range(size):
            still[at] = max(still[at], abs(speed[link, at]))
    still[:size] *= AT_REST


@kernel
def _seen(speed: float, carrier: float, still: float) -> float:
    """Speed of a link seen from another; exactly 0 where it stands still."""
    found = speed - carrier
    return found if abs(found) > still else 0.0


@kernel
def _press(
    contacts: ContactArrays,
    tables: ContactTables,
    angle: Floats,
    speed: Floats,
    still: Floats,
    static: bool,
    size: int,
    S: Floats,
    turning: Floats,
    force: Floats,
    barred: Bools,
    asked: Floats,
    u: Floats,
    row: Ints,
) -> None:
    """Torques on the two links of every contact for a unit of its multiplier: (contacts, side, link, n)."""
    for pair in range(len(contacts.source)):
        source, end, carrier = contacts.source[pair], contacts.end[pair], contacts.carrier[pair]
        for at in range(size):
            S[pair, at] = angle[source, at] if source >= 0 else 0.0
            turning[pair, at] = contacts.way[pair] * _seen(speed[end, at], speed[carrier, at], still[at])
        if contacts.lead[pair] != pair:
            continue
        driver, driven = (0, 1) if contacts.first[pair] else (1, 0)
        for side in range(2):
            if side == 1 and contacts.flank[pair] < 0 and contacts.kind[pair] == 0:
                continue
            if source >= 0:
                contact_along(tables, contacts.table[pair] + side, S[pair, :size], asked, u, row)
            else:
                asked[0, :size] = contacts.ratio[pair]
            count = tables.contacts[contacts.table[pair] + side] if source >= 0 else 0
            out = force[pair, side]
            _pass(contacts, pair, side, static, count, asked, S[pair, :size], turning[pair], out, barred[pair, side])
            for at in range(size):
                gets, gives = contacts.sense[pair] * out[0, at], -contacts.way[pair] * out[1, at]
                out[driven, at], out[driver, at] = gets, gives


@kernel
def _pass(
    contacts: ContactArrays,
    pair: int,
    side: int,
    static: bool,
    count: int,
    asked: Floats,
    S: Floats,
    turning: Floats,
    force: Floats,
    barred: Bools,
) -> None:
    """Torques per unit of the multiplier on the driven side and from the driver, and where no power can pass.

    asked   the ratio, and of `count` contacts what friction adds where power enters and leaves
    """
    kind, first, second = contacts.kind[pair], contacts.sliding[pair], contacts.static[pair]
    r, e = contacts.radius[pair], contacts.offset[pair]
    for at in range(len(S)):
        # 1 where the law's driver drives, -1 where the other side does, 0 where they do not turn against each other
        way, tau = np.sign(turning[at]) * (1 - 2 * side), asked[0, at]
        force[0, at], force[1, at], barred[at] = 1.0, tau, False
        if kind == EFFICIENCY:
            if way > 0:
                force[0, at], barred[at] = (first if first > 0 else 1.0), first <= 0
            elif way < 0:
                force[1, at], barred[at] = tau * (second if second > 0 else 1.0), second <= 0
        elif kind == PIN:
            half = np.sin(S[at] / 2)
            square = (r - e) * (r - e) + 4 * r * e * (half * half)
            force[1, at] = tau + way * (second if static else first) * (r * e * abs(np.sin(S[at])) / square)
        elif kind == TEETH:
            f = (second if static else first) * way
            locks, total, touching = False, 0.0, 0
            for contact in range(count):
                into, out = 1 + f * asked[1 + 2 * contact, at], 1 + f * asked[2 + 2 * contact, at]
                if np.isnan(out):
                    continue
                driving, rest = (into, out) if way > 0 else (out, into)
                given = rest / driving
                locks = locks or driving <= 0 or (way > 0 and given <= 0)
                total += given
                touching += 1
            share = total / touching if touching > 0 and not locks else 1.0
            barred[at] = locks
            if way > 0:
                force[0, at] = share
            elif way < 0:
                force[1, at] = tau * share


@kernel
def _rub(
    bearings: BearingArrays,
    known: Floats,
    speed: Floats,
    still: Floats,
    static: bool,
    resting: Bools,
    size: int,
    slipping: Floats,
    rubbed: Floats,
    torque: Floats,
) -> None:
    """Known torques of all rows: loads, and what bearings and drag do to a link and to what bears it."""
    for row in range(len(known)):
        torque[row, :size] = known[row]
    for own in range(len(bearings.link)):
        link, carrier, carrier_row = bearings.link[own], bearings.carrier[own], bearings.carrier_row[own]
        for at in range(size):
            slip = _seen(speed[link, at], speed[carrier, at], still[at])
            rubbing = bearings.static[own]
            if not static:
                rubbing = 0.0 if resting[own, at] else bearings.sliding[own] + bearings.drag[own] * abs(slip)
            slipping[own, at], rubbed[own, at] = slip, rubbing * abs(slip)
            rubbing *= np.sign(slip)
            torque[bearings.row[own], at] -= bearings.sense[own] * rubbing
            if carrier_row >= 0:
                torque[carrier_row, at] += bearings.carrier_sense[own] * rubbing


@kernel
def _change(contacts: ContactArrays, values: Floats, size: int, coasting: Bools, news: Bools) -> None:
    """Which pairs press on their coast flanks, into `coasting`; where that is news."""
    for at in range(size):
        most = 0.0
        for column in range(len(values)):
            most = max(most, abs(values[column, at]))
        news[at] = False
        for pair in range(len(contacts.source)):
            flank = contacts.flank[pair]
            if flank >= 0:
                coasts = values[contacts.column[pair], at] < -FAINT * most
                news[at] = news[at] or coasts != coasting[flank, at]
                coasting[flank, at] = coasts


@kernel
def _lose(
    contacts: ContactArrays,
    pair: int,
    values: Floats,
    force: Floats,
    speed: Floats,
    still: Floats,
    size: int,
    lost: Floats,
) -> None:
    """What a pair loses, and what its two sides put into it, in its carrier's frame: (2, n)."""
    lead, column, carrier = contacts.lead[pair], contacts.column[pair], contacts.carrier[pair]
    two_sided = contacts.flank[lead] >= 0 or contacts.kind[lead] != 0
    lost[:, :size] = 0.0
    for end in range(2):
        link, own = contacts.links[pair, end], end if contacts.alike[pair] else 1 - end
        for at in range(size):
            pressed = values[column, at]
            side = 1 if pressed < 0 and two_sided else 0
            torque = contacts.signs[pair, end] * force[lead, side, own, at] * pressed
            power = torque * _seen(speed[link, at], speed[carrier, at], still[at])
            lost[0, at] -= power
            lost[1, at] += max(-power, 0.0)
