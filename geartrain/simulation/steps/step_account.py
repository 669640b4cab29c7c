"""Contributions of one time step to the results of a run, for rigid and compliant teeth: energies, times in contact and
impacts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import ContactSystem
from geartrain.simulation.contacts.pair_tables import PairTables
from geartrain.simulation.steps.contact_solution import (
    BEARINGS,
    CHANGES,
    FRICTION,
    GAP,
    IMPACT_COUNT,
    IMPACT_ENERGY,
    IMPACT_LOSS,
    IMPACT_SPEED,
    IMPACTS,
    IMPULSE,
    OPEN,
    RUBBED,
    STEP,
    TIME_APART,
    TIME_COAST,
    VISCOUS,
    WORK_DRIVE,
    WORK_SPRING,
    WORK_TORQUE,
    CompliantTeeth,
    ContactState,
    RunRecord,
    StepEquations,
    StepRules,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

_ROUNDING = 1e-9  # relative to the speeds of a pair: slower closing is rounding, not an impact


@kernel
def count_energy(
    system: ContactSystem,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    rules: StepRules,
    speed: Floats,
) -> None:
    """Add the work of drives, torques and springs, and the losses due to drag, to the record. Each is an impulse times
    a mean speed of the step.

    speed   speeds at which drag and springs are evaluated [rad/s]
    """
    for d in range(len(here.middle)):
        record.energy[WORK_DRIVE] += here.drive[d] * here.middle[d]
        record.energy[WORK_TORQUE] += rules.step * system.torque[d] * here.middle[d]
        record.energy[VISCOUS] += rules.step * system.viscous[d, d] * speed[d] * here.middle[d]
        for o in range(d):
            across = speed[d] * here.middle[o] + speed[o] * here.middle[d]
            record.energy[VISCOUS] += rules.step * system.viscous[d, o] * across
    for m in range(len(system.spring_stiffness)):
        at = rules.share * rules.step
        pull = system.spring_rest[m] + system.spring_rate[m] * (state.clock[0] + at)
        rate = 0.0
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            o = system.spring_of[x]
            pull -= system.spring_c[x] * (state.angle[o] + at * speed[o])
            rate += system.spring_c[x] * here.middle[o]
        record.energy[WORK_SPRING] += rules.step * system.spring_stiffness[m] * pull * rate
    for m in range(len(system.sliding)):
        rate, end = 0.0, 0.0
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            rate += system.bearing_c[x] * here.middle[system.bearing_of[x]]
            end += system.bearing_c[x] * here.v[system.bearing_of[x]]
        torque = (system.sliding[m] + here.load_friction[m, 0]) * state.turning[m]
        if state.turning[m] == 0:
            torque = (system.sticking[m] + here.load_friction[m, 0]) * end / rules.creep
        record.energy[BEARINGS] += rules.step * torque * rate


@kernel
def count_contacts(
    system: ContactSystem,
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    rules: StepRules,
    teeth: CompliantTeeth,
) -> None:
    """Add the contact times, losses and impacts of each pair in one step to `record`, and update the peak torques.

    Work of the springs of compliant teeth is counted as numerical dissipation. The caller must subtract the increase of
    their stored energy.
    """
    step, rigid = rules.step, rules.share == 1.0
    for m in range(len(system.tables)):
        rate_S, rate_q, start_S, start_q = 0.0, 0.0, 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            rate_S += system.pair_driver[x] * here.v[o]
            rate_q += system.pair_driven[x] * here.v[o]
            start_S += system.pair_driver[x] * state.speed[o]
            start_q += system.pair_driven[x] * state.speed[o]
        mean_S, mean_q = (start_S + rate_S) / 2, (start_q + rate_q) / 2
        now, before, counts = state.touching[m], here.before[m], record.counts[m]
        if system.two_sided[m] == 0:
            ahead, behind = rate_q - here.ratio[m, 0] * rate_S, here.ratio[m, 1] * rate_S - rate_q
            if rigid:
                ahead, behind = step * (ahead - here.gap[m, 0]), step * (behind - here.gap[m, 1])
                count_gap(counts, ahead, behind, find_flight(state.touching, here, m))
            else:
                ahead, behind = here.gap[m, 0] + step / 4 * ahead, here.gap[m, 1] + step / 4 * behind
                count_gap(counts, ahead, behind, 1.0 if now == OPEN else 0.0)
                for side in range(2):
                    opening = (1.0 - 2.0 * side) * (start_q - here.ratio[m, side] * start_S)
                    count_released_energy(state, here, record, teeth, m, side, step / 4 * opening)
        if now == OPEN:
            state.steady[m] = 0.0
            state.struck[m] = 0
            teeth.impact[m] = -1
            continue
        side = now - 1
        sign = 1.0 - 2.0 * side
        rate = sign * (mean_q - here.ratio[m, side] * mean_S)
        # work against the contact: impulse times mean opening speed
        taken = -here.P[m] * rate
        # friction is the difference between the speed ratio and the lever arm of forces
        rubbed = -here.P[m] * sign * (here.ratio[m, side] - here.arm[m, side]) * mean_S
        record.energy[FRICTION] += rubbed
        counts[RUBBED] += rubbed
        counts[IMPULSE] += here.P[m] * sign
        if now != before and before != OPEN and (rigid or system.two_sided[m] == 0):
            counts[CHANGES] += 1.0
        if not rigid:
            damped = step * teeth.damping[m] * rate * rate
            record.energy[IMPACT_LOSS] += damped
            record.energy[STEP] += taken - damped
            counts[IMPACT_ENERGY] += damped
            teeth.peak[m] = max(teeth.peak[m], abs(here.P[m]) / step)
            if now != before and system.two_sided[m] == 0:
                # at first contact the force is only that of damping, which decreases within the first step
                met = sign * (here.ratio[m, side] * start_S - start_q)
                teeth.peak[m] = max(teeth.peak[m], teeth.damping[m] * met)
                teeth.impact[m] = record.numbers[IMPACTS]
                note_impact(record, state.clock[0] + step / 2, m, -rate, 0.0, 0.0)
            if 0 <= teeth.impact[m] < len(record.impacts):
                # an impact lasts until its teeth separate
                record.impacts[teeth.impact[m], 3] += damped
                record.impacts[teeth.impact[m], 4] += here.P[m]
            continue
        struck = now != before or leaps(transmissions.jump, system.tables, here.ratio, state.ratio, m, side)
        # scale of rounding errors of the closing speed
        minimum = _ROUNDING * (abs(rate_q) + abs(here.ratio[m, side] * rate_S))
        if struck and system.two_sided[m] == 0 and here.closing[m, side] > minimum:
            state.struck[m] = 1
            count_impact(record, m, taken, here.P[m], state.steady[m])
            note_impact(record, state.clock[0] + step, m, here.closing[m, side], taken, here.P[m])
        elif state.struck[m] != 0:
            # a ratio that jumps within a step is replaced by the mean of both values; the next step has the rest
            state.struck[m] = 0
            count_impact(record, m, taken, here.P[m], state.steady[m])
        else:
            record.energy[STEP] += taken
            state.steady[m] = abs(here.P[m])


@kernel
def count_released_energy(
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    teeth: CompliantTeeth,
    m: int,
    side: int,
    opened: float,
) -> None:
    """Add the energy that is stored in the teeth when they separate to the impact losses, because their damping
    dissipates it.

    opened   change of the gap from the start to the middle of the step, at the initial speeds [rad]
    """
    parted = (1 if here.before[m] == side + 1 else 0) - (1 if state.touching[m] == side + 1 else 0)
    if parted != 0:
        pressed = min(here.gap[m, side] - opened, 0.0)
        left = parted * teeth.stiffness[m] / 2 * pressed * pressed
        record.energy[IMPACT_LOSS] += left
        record.energy[STEP] -= left
        record.counts[m, IMPACT_ENERGY] += left


@kernel
def count_gap(counts: Floats, ahead: float, behind: float, flight: float) -> None:
    """Add the time without contact and the time on the coast flank in one step to the counts of a pair, and update its
    maximum gap.

    ahead, behind   gaps at the drive flank and at the coast flank [rad]
    flight          fraction of the step in which no flank touches
    """
    counts[TIME_APART] += flight
    if behind < ahead:
        counts[TIME_COAST] += 1.0 - flight
    counts[GAP] = max(counts[GAP], min(ahead, behind))


@kernel
def find_flight(touching: Ints, here: StepEquations, m: int) -> float:
    """Return the fraction of the step in which no flank of pair m touches. For a new contact, it is the fraction before
    the flanks close.
    """
    if touching[m] == OPEN:
        return 1.0
    side = touching[m] - 1
    if here.before[m] != OPEN or here.closing[m, side] <= 0.0:
        return 0.0
    if here.bound[m, side] > here.gap[m, side]:
        return 1.0  # it bounces, and separates again
    return float(min(max(-here.gap[m, side] / here.closing[m, side], 0.0), 1.0))


@kernel
def count_impact(record: RunRecord, m: int, taken: float, impulse: float, steady: float) -> None:
    """Divide the energy `taken`, which contact `m` dissipates in a step, between an impact and the steady force, in
    proportion to their impulses. `steady` is the impulse of the steady force.
    """
    share = (impulse - steady) / impulse if impulse > steady else 0.0
    record.energy[IMPACT_LOSS] += taken * share
    record.energy[STEP] += taken * (1.0 - share)
    record.counts[m, IMPACT_ENERGY] += taken * share


@kernel
def leaps(jump: Floats, tables: Ints, now: Floats, before: Floats, m: int, side: int) -> bool:
    """Return True if the speed ratio at a flank of pair m has changed discontinuously since the last step, because the
    contact has passed a kink of the transmission function.

    now, before   present and previous speed ratios of all pairs; few arrays are passed, because calls with many arrays
                  are slow
    """
    return bool(abs(now[m, side] - before[m, side]) > jump[tables[m, side]] / 2)


@kernel
def count_stops(
    system: ContactSystem, state: ContactState, here: StepEquations, record: RunRecord, step: float
) -> None:
    """Add the impacts of links against their stops to the record."""
    for stop in range(len(system.stop_pitch)):
        m = len(system.tables) + stop
        if state.touching[m] == OPEN:
            state.struck[m] = 0
            continue
        rate, start = 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            rate += system.pair_driven[x] * here.middle[system.pair_of[x]]
            start += system.pair_driven[x] * state.speed[system.pair_of[x]]
        taken = here.P[m] * rate
        # the whole dissipation of a stop belongs to its impacts
        record.energy[IMPACT_LOSS] += taken
        counts = record.counts[m]
        counts[IMPULSE] += here.P[m]
        counts[IMPACT_ENERGY] += taken
        closing = -1.0
        if state.struck[m] != 0:
            state.struck[m] = 0
        elif here.before[m] == OPEN and start > 0.0:
            # it reaches its stop in this step, and comes to rest in the next
            state.struck[m] = 1
            closing = here.stop_closing[stop]
        elif -here.bound[m, 1] * step > system.stop_pitch[stop] / 2:
            # a stop that advances and is reached again within one step; its closing speed is at least that of the step
            closing = -here.bound[m, 1]
        if closing >= 0.0:
            note_impact(record, state.clock[0], m, closing, taken, here.P[m])


@kernel
def note_impact(record: RunRecord, time: float, which: int, speed: float, energy: float, impulse: float) -> None:
    """Count an impact of a contact, and append it to the list of impacts unless the list is full."""
    counts = record.counts[which]
    counts[IMPACT_COUNT] += 1.0
    counts[IMPACT_SPEED] = max(counts[IMPACT_SPEED], speed)
    at = record.numbers[IMPACTS]
    if at < len(record.impacts):
        row = record.impacts[at]
        row[0] = time
        row[1] = which
        row[2] = speed
        row[3] = energy
        row[4] = impulse
    record.numbers[IMPACTS] = at + 1
