"""Time steps of constant length h: nonsmooth time stepping (Moreau and Jean) for rigid teeth, the midpoint rule for
compliant teeth.

Rigid contacts are enforced at the position level, equation (12) of docs/dynamics.md, so that gaps do not drift. The
complementarity problem of touching contacts and sticking bearings is solved by block pivoting, and by Murty's method if
that does not converge. Identical steps of a train at rest are computed together, up to the next beat of an escapement.

Compliant teeth of stiffness k and damping c have the impulse P = h max(0, -k g - c dg/dt) at the gap g < 0, equations
(15) and (18), with gap and speed in the middle of the step: a row with the compliance 1/s, s = h^2 k/4 + h c/2.
"""

from __future__ import annotations

from math import floor, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import ContactSystem
from geartrain.simulation.contacts.pair_tables import PairTables, value_and_slope
from geartrain.simulation.steps.contact_solution import (
    AT_ONCE,
    BACK,
    DIVERGED,
    IMPULSE,
    OPEN,
    PIVOTS,
    SAMPLES,
    STEPS,
    TIME_APART,
    TIME_COAST,
    UNSOLVED,
    CompliantTeeth,
    ContactState,
    RunRecord,
    StepEquations,
    StepRules,
    correct_bearings,
    correct_contacts,
    find_bearing_loads,
    solve_guess,
    turn_forces,
)
from geartrain.simulation.steps.step_account import (
    count_contacts,
    count_energy,
    count_stops,
    leaps,
)

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


FARTHEST = 1000.0  # largest rotation in one step [rad]; beyond it the solution diverges
_SHORT = 2  # flights of at most this many steps end without rebound, whatever the restitution
_AGAIN = 4  # maximum number of new evaluations of transmission functions when an impact changes their drivers' speeds
_NEAR = 1e-9  # tolerance between a driver's angle and the angle at which its function was evaluated [rad]
_IMPACT_CHANGE = 0.01  # relative change of a driver's speed within a step that counts as an impact, or the rest of one


@kernel
def fastest(speed: Floats) -> float:
    """Return the maximum magnitude of the given speeds [rad/s], or NaN if one of them is NaN."""
    found = 0.0
    for each in speed:
        if not abs(each) <= found:
            found = abs(each)
    return found


@kernel
def find_idle_steps(system: ContactSystem, state: ContactState, rules: StepRules, most: int) -> int:
    """Return the number of steps, at most `most`, before the loads on a train at rest change."""
    for m in range(len(system.spring_rate)):
        if system.spring_rate[m] != 0.0:
            return 0
    idle = most
    for m in range(len(system.stop_beat)):
        beats = floor((state.clock[0] + rules.step / 2) / system.stop_beat[m])
        # one step less, so that rounding cannot pass the time of the beat
        idle = min(idle, floor((beats + 1) * system.stop_beat[m] / rules.step - state.clock[1] - 1.5))
    return max(idle, 0)


@kernel
def repeat_counts(counts: Floats, before: Floats, times: int) -> None:
    """Add `times` times the counts of the last step to the counts of all contacts.

    before   counts before the last step
    """
    for m in range(len(counts)):
        for column in (TIME_APART, TIME_COAST, IMPULSE):
            counts[m, column] += times * (counts[m, column] - before[m, column])


@kernel
def run_steps(
    system: ContactSystem,
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    rules: StepRules,
    teeth: CompliantTeeth,
    steps: int,
    counted: bool,
) -> None:
    """Advance the state of the train by `steps` time steps.

    Samples are always recorded. Energies, times and impacts are recorded only if `counted` is True.
    """
    rigid = rules.share == 1.0
    since, done, idle = 0, 0, 0
    still = rules.creep + rules.slack
    before = np.zeros_like(record.counts)
    while done < steps:
        if idle > 1:
            before[:, :] = record.counts
        # the previous contact state is the first guess
        rounds = solve_step(system, transmissions, state, here, rules, teeth)
        most = fastest(here.v)
        if not most * rules.step < FARTHEST:
            record.numbers[DIVERGED] = 1
            break
        rests = rigid and rounds == 1 and max(most, fastest(state.speed)) <= still
        # only a step that changed nothing may be repeated
        times = idle if rests and idle > 1 else 1
        if rounds > rules.rounds:
            record.numbers[UNSOLVED] += 1
        for d in range(len(here.v)):
            # mean speeds make the work of impulses equal to the change of kinetic energy
            here.middle[d] = (state.speed[d] + here.v[d]) / 2
        if counted:
            record.numbers[PIVOTS] += rounds - 1
            record.numbers[STEPS] += times
            count_energy(system, state, here, record, rules, here.v if rigid else here.middle)
            count_contacts(system, transmissions, state, here, record, rules, teeth)
            if len(system.stop_pitch) > 0:
                count_stops(system, state, here, record, rules.step)
            if times > 1:
                repeat_counts(record.counts, before, times - 1)
        for m in range(len(system.tables)):
            state.ratio[m, 0] = here.ratio[m, 0]
            state.ratio[m, 1] = here.ratio[m, 1]
            state.flown[m] = 0 if state.touching[m] != OPEN else state.flown[m] + times
        for d in range(len(here.v)):
            state.speed[d] = here.v[d]
            state.angle[d] += rules.step * (here.v[d] if rigid else here.middle[d])
        # time is counted in steps, so that rounding does not accumulate
        state.clock[1] += times
        state.clock[0] = state.clock[1] * rules.step
        done += times
        idle = find_idle_steps(system, state, rules, steps - done) if rests else 0
        while times > 0 and record.numbers[SAMPLES] < len(record.angles):
            part = min(times, rules.stride - since)
            times -= part
            since += part
            sample = record.numbers[SAMPLES]
            add_to_sample(record.forces[sample], here.P, state.touching, len(system.tables), part)
            for d in range(len(here.drive)):
                record.drive[sample, d] += part * here.drive[d]
            if since == rules.stride:
                end_sample(state, record, rules.stride * rules.step)
                since = 0


@kernel
def solve_step(
    system: ContactSystem,
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    rules: StepRules,
    teeth: CompliantTeeth,
) -> int:
    """Solve for the speeds at the end of a step, and return the number of contact states that were tried."""
    find_loads(system, state, here, rules.step, rules.share)
    for d in range(len(here.v)):
        here.ahead[d] = state.speed[d]
    for m in range(len(here.before)):
        here.before[m] = state.touching[m]
    find_bounds(system, transmissions, state, here, rules, teeth)
    if len(system.stop_pitch) > 0:
        find_stop_bounds(system, state, here, rules.step)
    if len(system.loaded.pair) > 0:
        turn_forces(system, state, here, rules.share * rules.step)
    rounds, again, tried = 0, 0, 0
    while True:
        solve_guess(system, state, here, rules.step, rules.creep)
        rounds += 1
        tried += 1
        differs = len(system.loaded.bearing) > 0 and find_bearing_loads(system, state, here, rules.step)
        if rounds > rules.rounds:
            return rounds
        # here and not in a kernel of its own, because calls with many arrays are slow
        single = tried > AT_ONCE
        found = correct_contacts(system, state, here, rules.slack, single)
        if len(system.sliding) > 0 and (found == 0 or not single):
            found += correct_bearings(system, state, here, rules.creep, single)
        if found > 0:
            continue
        if differs:
            # Newton's method: the contact states are solved again with the directions found
            here.direction[:, 0] = here.direction[:, 1]
            tried = 0
            continue
        if rules.share != 1.0 or again == _AGAIN:
            return rounds
        struck = is_struck(state.touching, here.before, transmissions.jump, system.tables, here.ratio, state.ratio)
        if find_shift(system, here, 0.0 if struck else _IMPACT_CHANGE) * rules.step < _NEAR:
            return rounds
        again += 1
        for d in range(len(here.v)):
            here.ahead[d] = here.v[d]
        find_bounds(system, transmissions, state, here, rules, teeth)


@kernel
def add_to_sample(forces: Floats, P: Floats, touching: Ints, pairs: int, times: int) -> None:
    """Add the impulses of `times` identical steps to the current sample.

    Only a few arrays are passed, because calls with many arrays are slow.
    """
    for m in range(len(P)):
        forces[m] += times * (-P[m] if m < pairs and touching[m] == BACK else P[m])


@kernel
def end_sample(state: ContactState, record: RunRecord, time: float) -> None:
    """Record angles and speeds of a sample, and convert its impulses to mean torques over its `time` [s]."""
    sample = record.numbers[SAMPLES]
    record.angles[sample, :] = state.angle
    record.speeds[sample, :] = state.speed
    record.forces[sample, :] /= time
    record.drive[sample, :] /= time
    record.numbers[SAMPLES] = sample + 1


@kernel
def find_loads(system: ContactSystem, state: ContactState, here: StepEquations, step: float, share: float) -> None:
    """Compute the momenta of the coordinates, and the known parts of the impulses of torques, springs and drag.

    share   fraction of the step at which springs and drag are evaluated
    """
    past = (1.0 - share) * step
    for d in range(len(here.v)):
        here.load[d] = step * system.torque[d]
        for o in range(len(here.v)):
            here.load[d] += (system.mass[d, o] - past * system.viscous[d, o]) * state.speed[o]
    for m in range(len(system.spring_stiffness)):
        pull = system.spring_rest[m] + system.spring_rate[m] * (state.clock[0] + share * step)
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            o = system.spring_of[x]
            pull -= system.spring_c[x] * (state.angle[o] + share * past * state.speed[o])
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            here.load[system.spring_of[x]] += step * system.spring_stiffness[m] * pull * system.spring_c[x]


@kernel
def find_bounds(
    system: ContactSystem,
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    rules: StepRules,
    teeth: CompliantTeeth,
) -> None:
    """Compute the speed ratio, lever arm and gap of each flank at the extrapolated position of its driver, and the
    minimum separation speed at which the flank does not penetrate.
    """
    step, rigid = rules.step, rules.share == 1.0
    for m in range(len(system.tables)):
        S, q, dS, dq, on = system.start_driver[m], system.start_driven[m], 0.0, 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            S += system.pair_driver[x] * state.angle[o]
            q += system.pair_driven[x] * state.angle[o]
            dS += system.pair_driver[x] * state.speed[o]
            dq += system.pair_driven[x] * state.speed[o]
            on += system.pair_driver[x] * here.ahead[o]
        at = S + rules.share * step * on
        way = 0 if dS >= 0 else 1
        for side in range(2):
            if rigid and state.touching[m] == 2 - side and system.two_sided[m] == 0:
                # the opposite flank is a backlash away: it is inactive until the touching one separates
                here.bound[m, side] = -np.inf
                here.gap[m, side] = -np.inf
                continue
            sign = 1.0 - 2.0 * side
            angle, ratio = value_and_slope(transmissions, system.tables[m, side], at)
            rate = sign * (dq - ratio * dS)
            here.ratio[m, side] = ratio
            here.arm[m, side] = ratio
            if system.rubbing[m, 2 * side + way] >= 0:
                more, _ = value_and_slope(transmissions, system.rubbing[m, 2 * side + way], at)
                here.arm[m, side] += more
            if not rigid:
                # with the row's speed r at the start and r+ at the end, the gap is gap + h/4 r+, and P = s (bound - r+)
                gap = sign * (q + step / 2 * dq - angle) - step / 4 * rate
                torque = teeth.stiffness[m] * gap + teeth.damping[m] / 2 * rate
                here.gap[m, side] = gap
                here.bound[m, side] = -step * torque * system.compliance[m]
                if system.two_sided[m] == 0 and gap + step / 4 * rate >= 0.0:
                    # flanks without contact do not damp
                    here.bound[m, side] = -np.inf
                    if state.touching[m] == side + 1:
                        state.touching[m] = OPEN
                continue
            lack = sign * ((angle - q) / step - ratio * on)
            here.gap[m, side] = lack
            here.closing[m, side] = -rate
            bounce = -system.restitution[m] * rate
            # without restitution only the position counts: a jump of the ratio within the step is not a flight. Bounces
            # follow each other ever faster, and those as short as a step end in contact
            bounces = bounce > 0.0 and rate < lack < bounce
            long = state.flown[m] > _SHORT
            if bounces and (long or leaps(transmissions.jump, system.tables, here.ratio, state.ratio, m, side)):
                lack = bounce
            here.bound[m, side] = lack


@kernel
def is_struck(touching: Ints, before: Ints, jump: Floats, tables: Ints, ratio: Floats, last: Floats) -> bool:
    """Return True if a flank came into contact in this step, or the speed ratio at a touching flank jumped."""
    for m in range(len(last)):
        now = touching[m]
        if now != OPEN and (now != before[m] or leaps(jump, tables, ratio, last, m, now - 1)):
            return True
    return False


@kernel
def find_shift(system: ContactSystem, here: StepEquations, minimum: float) -> float:
    """Return the maximum difference between the computed speed of a driver and the speed with which its position was
    extrapolated [rad/s].

    minimum   fraction of the driver's speed; smaller differences are ignored
    """
    most = 0.0
    for m in range(len(system.tables)):
        shift, speed = 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            shift += system.pair_driver[x] * (here.v[o] - here.ahead[o])
            speed += system.pair_driver[x] * here.ahead[o]
        if abs(shift) > minimum * abs(speed):
            most = max(most, abs(shift))
    return most


@kernel
def find_stop_bounds(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """Compute the maximum speed [rad/s] of each link with stops, at which it just reaches its stop or rebounds."""
    for stop in range(len(system.stop_pitch)):
        m = len(system.tables) + stop
        beats = floor((state.clock[0] + step / 2) / system.stop_beat[stop])
        room = (1.0 + beats) * system.stop_pitch[stop]
        rate = 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            room -= system.pair_driven[x] * state.angle[system.pair_of[x]]
            rate += system.pair_driven[x] * state.speed[system.pair_of[x]]
        limit = room / step
        if state.touching[m] != OPEN:
            # reached at its position in the previous step with the speed found there, and left in this one
            back = system.stop_restitution[stop] * here.stop_closing[stop]
            if back > 0.0:
                limit = min(limit, -back)
            here.stop_closing[stop] = 0.0
            state.stop_rate[stop, 1] = rate
        else:
            # closing speed v0 under constant acceleration from the stop that was left at v0; with these steps
            # v0^2 = v^2 + a (h v + h v0 + 2 room)
            gain = rate - state.stop_rate[stop, 0]
            square = rate * rate + gain * (rate + state.stop_rate[stop, 1] + 2.0 * room / step)
            here.stop_closing[stop] = sqrt(max(square, 0.0)) if rate > 0.0 else 0.0
        state.stop_rate[stop, 0] = rate
        # a stop is a coast flank: it limits the speed from ahead, -v >= -limit
        here.bound[m, 0] = -np.inf
        here.bound[m, 1] = -limit
