"""Teeth that yield: the implicit midpoint rule for contacts with a stiffness and a damping.

docs/dynamics.md (15) and (18):

    P = h max(0, -k g - c dg/dt)   where g < 0,

gap and closing speed in the middle of the step. Both are linear in the speeds at its end, the law taken where the step
before leads; so a pair that touches is a row with the compliance 1/s, s = h^2 k/4 + h c/2, of the equations that rigid
contacts are solved by. The rule is of second order and takes no energy of what swings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.dynamics.time.contact_solution import StepEquations, solve_guess
from geartrain.dynamics.time.contact_system import (
    BEARINGS,
    BLOW_COUNT,
    BLOW_ENERGY,
    BLOW_SPEED,
    BLOWS,
    CHANGES,
    FRICTION,
    GAP,
    IMPACTS,
    IMPULSE,
    PIVOTS,
    RUBBED,
    SAMPLES,
    STEP,
    STEPS,
    TIME_APART,
    TIME_COAST,
    UNSOLVED,
    VISCOUS,
    WORK_DRIVE,
    WORK_SPRING,
    WORK_TORQUE,
    ContactState,
    ContactSystem,
    RunRecord,
)
from geartrain.dynamics.time.guess_correction import correct_guess
from geartrain.dynamics.time.law_tables import LawTables, value_and_slope
from geartrain.dynamics.time.step_account import note_impact
from geartrain.numerics.kernels import kernel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

_AT_ONCE = 6  # rounds in which all wrong guesses are turned round together


class YieldingTeeth(NamedTuple):
    """What teeth that yield need beside their contacts, by pair; torques are those on driven sides.

    stiffness, damping   N m/rad, N m s/rad
    peak                 greatest contact torque of what is counted (N m): changed by the kernel
    impact               the impact that each pair has last begun, -1 none: changed by the kernel
    """

    stiffness: Floats
    damping: Floats
    peak: Floats
    impact: Ints


@kernel
def run_yielding_steps(
    system: ContactSystem,
    laws: LawTables,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    teeth: YieldingTeeth,
    step: float,
    steps: int,
    stride: int,
    creep: float,
    apart: float,
    slack: float,
    counted: bool,
) -> None:
    """Go so many steps on; arguments as of `run_steps`."""
    n, pairs = len(here.v), len(system.stiff)
    gap = np.zeros((pairs, 2))
    before = np.zeros(pairs, np.int64)
    middle = np.zeros(n)
    sample = record.numbers[SAMPLES]
    since = 0
    limit = 60 + 6 * (pairs + len(system.sliding))
    for _ in range(steps):
        find_midpoint_loads(system, state, here, step)
        for m in range(pairs):
            before[m] = state.touching[m]
        find_midpoint_bounds(system, laws, state, here, teeth, step, gap)
        rounds = 0
        while True:
            solve_guess(system, state, here, step, creep)
            rounds += 1
            if rounds > limit:
                record.numbers[UNSOLVED] += 1
                break
            if correct_guess(system, state, here, creep, slack, rounds > _AT_ONCE) == 0:
                break
        for d in range(n):
            middle[d] = (state.speed[d] + here.v[d]) / 2
        if counted:
            record.numbers[PIVOTS] += rounds - 1
            record.numbers[STEPS] += 1
            count_midpoint_energy(system, state, here, record, step, creep, middle)
            count_yielding(system, state, here, record, teeth, step, apart, middle, before, gap)
        for d in range(n):
            state.speed[d] = here.v[d]
            state.angle[d] += step * middle[d]
        state.clock[1] += 1.0
        state.clock[0] = state.clock[1] * step
        if sample < len(record.angles):
            since += 1
            for m in range(pairs):
                record.forces[sample, m] += here.P[m] * (3.0 - 2.0 * state.touching[m])
            for d in range(n):
                record.drive[sample, d] += here.drive[d]
            if since == stride:
                record.angles[sample, :] = state.angle
                record.speeds[sample, :] = state.speed
                record.forces[sample, :] /= stride * step
                record.drive[sample, :] /= stride * step
                sample += 1
                since = 0
    record.numbers[SAMPLES] = sample


@kernel
def find_midpoint_loads(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """Momentum, and impulses of torques, springs and drag as far as they are known before the step."""
    n = len(here.v)
    for d in range(n):
        here.load[d] = step * system.torque[d] + (system.mass[d, d] - step / 2 * system.viscous[d, d]) * state.speed[d]
        for x in range(system.near_at[d], system.near_at[d + 1]):
            o = system.near[x]
            here.load[d] += (system.mass[d, o] - step / 2 * system.viscous[d, o]) * state.speed[o]
            here.load[o] += (system.mass[o, d] - step / 2 * system.viscous[o, d]) * state.speed[d]
    for m in range(len(system.spring_stiffness)):
        pull = system.spring_rest[m] + system.spring_rate[m] * (state.clock[0] + step / 2)
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            o = system.spring_of[x]
            pull -= system.spring_c[x] * (state.angle[o] + step / 4 * state.speed[o])
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            here.load[system.spring_of[x]] += step * system.spring_stiffness[m] * pull * system.spring_c[x]


@kernel
def find_midpoint_bounds(
    system: ContactSystem,
    laws: LawTables,
    state: ContactState,
    here: StepEquations,
    teeth: YieldingTeeth,
    step: float,
    gap: Floats,
) -> None:
    """Speed ratios and arms in the middle of the step, and the speeds of rows at which P would vanish.

    gap   of both flanks in the middle of the step, but for what the change of speeds adds
    """
    for m in range(len(system.stiff)):
        S, q, dS, dq = system.start_driver[m], system.start_driven[m], 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            S += system.pair_driver[x] * state.angle[o]
            q += system.pair_driven[x] * state.angle[o]
            dS += system.pair_driver[x] * state.speed[o]
            dq += system.pair_driven[x] * state.speed[o]
        at = S + step / 2 * dS
        way = 0 if dS >= 0 else 1
        stiff, damped = step * teeth.stiffness[m], step * teeth.damping[m]
        for side in range(2):
            sign = 1.0 - 2.0 * side
            angle, ratio = value_and_slope(laws, system.tables[m, side], at)
            rate = sign * (dq - ratio * dS)
            here.ratio[m, side] = ratio
            here.arm[m, side] = ratio
            if system.rubbing[m, 2 * side + way] >= 0:
                more, _ = value_and_slope(laws, system.rubbing[m, 2 * side + way], at)
                here.arm[m, side] += more
            # with the row's speed r at the start and r+ at the end the gap is  gap + h/4 r+,  and P = s (bound - r+)
            gap[m, side] = sign * (q + step / 2 * dq - angle) - step / 4 * rate
            here.bound[m, side] = -(stiff * gap[m, side] + damped / 2 * rate) / system.stiff[m]
            if system.two_sided[m] == 0 and gap[m, side] + step / 4 * rate >= 0.0:
                # flanks that are apart do not damp
                here.bound[m, side] = -np.inf
                if state.touching[m] == side + 1:
                    state.touching[m] = 0


@kernel
def count_midpoint_energy(
    system: ContactSystem,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    step: float,
    creep: float,
    middle: Floats,
) -> None:
    """Work of drives, torques and springs, losses by drag: each impulse times the mean speed of its step."""
    for d in range(len(middle)):
        record.energy[WORK_DRIVE] += here.drive[d] * middle[d]
        record.energy[WORK_TORQUE] += step * system.torque[d] * middle[d]
        record.energy[VISCOUS] += step * system.viscous[d, d] * middle[d] * middle[d]
        for x in range(system.near_at[d], system.near_at[d + 1]):
            record.energy[VISCOUS] += 2 * step * system.viscous[d, system.near[x]] * middle[d] * middle[system.near[x]]
    for m in range(len(system.spring_stiffness)):
        pull = system.spring_rest[m] + system.spring_rate[m] * (state.clock[0] + step / 2)
        rate = 0.0
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            o = system.spring_of[x]
            pull -= system.spring_c[x] * (state.angle[o] + step / 2 * middle[o])
            rate += system.spring_c[x] * middle[o]
        record.energy[WORK_SPRING] += step * system.spring_stiffness[m] * pull * rate
    for m in range(len(system.sliding)):
        rate, end = 0.0, 0.0
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            rate += system.bearing_c[x] * middle[system.bearing_of[x]]
            end += system.bearing_c[x] * here.v[system.bearing_of[x]]
        torque = system.sliding[m] * state.turning[m]
        if state.turning[m] == 0:
            torque = system.sticking[m] * end / creep
        record.energy[BEARINGS] += step * torque * rate


@kernel
def count_yielding(
    system: ContactSystem,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    teeth: YieldingTeeth,
    step: float,
    apart: float,
    middle: Floats,
    before: Ints,
    gap: Floats,
) -> None:
    """Shares of time, what damping and friction take, impacts and peaks, by pair.

    What a contact takes less its damping stays in the column of steps, from which the energy stored is to be taken.
    Teeth that part before they are straight again straighten by themselves, against their own damping.
    """
    for m in range(len(system.stiff)):
        rate_S, rate_q, mean_S, mean_q, start_S, start_q = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            rate_S += system.pair_driver[x] * here.v[o]
            rate_q += system.pair_driven[x] * here.v[o]
            mean_S += system.pair_driver[x] * middle[o]
            mean_q += system.pair_driven[x] * middle[o]
            start_S += system.pair_driver[x] * state.speed[o]
            start_q += system.pair_driven[x] * state.speed[o]
        counts = record.counts[m]
        if system.two_sided[m] == 0:
            ahead = gap[m, 0] + step / 4 * (rate_q - here.ratio[m, 0] * rate_S)
            behind = gap[m, 1] + step / 4 * (here.ratio[m, 1] * rate_S - rate_q)
            if ahead > apart and behind > apart:
                counts[TIME_APART] += 1.0
            elif behind < ahead:
                counts[TIME_COAST] += 1.0
            counts[GAP] = max(counts[GAP], min(ahead, behind))
        now = state.touching[m]
        if system.two_sided[m] == 0:
            for side in range(2):
                passed = (1 if before[m] == side + 1 else 0) - (1 if now == side + 1 else 0)
                if passed != 0:
                    opening = (1.0 - 2.0 * side) * (start_q - here.ratio[m, side] * start_S)
                    pressed = min(gap[m, side] - step / 4 * opening, 0.0)
                    left = passed * teeth.stiffness[m] / 2 * pressed * pressed
                    record.energy[BLOWS] += left
                    record.energy[STEP] -= left
                    counts[BLOW_ENERGY] += left
        if now == 0:
            teeth.impact[m] = -1
            continue
        side = now - 1
        sign = 1.0 - 2.0 * side
        rate = mean_q - here.ratio[m, side] * mean_S
        damped = step * teeth.damping[m] * rate * rate
        rubbed = -here.P[m] * sign * (here.ratio[m, side] - here.arm[m, side]) * mean_S
        record.energy[FRICTION] += rubbed
        record.energy[BLOWS] += damped
        record.energy[STEP] += -here.P[m] * sign * rate - damped
        counts[RUBBED] += rubbed
        counts[BLOW_ENERGY] += damped
        counts[IMPULSE] += here.P[m] * sign
        teeth.peak[m] = max(teeth.peak[m], abs(here.P[m]) / step)
        if now != before[m] and system.two_sided[m] == 0:
            if before[m] != 0:
                counts[CHANGES] += 1.0
            counts[BLOW_COUNT] += 1.0
            counts[BLOW_SPEED] = max(counts[BLOW_SPEED], -sign * rate)
            teeth.impact[m] = record.numbers[IMPACTS]
            note_impact(record, state.clock[0] + step / 2, m, -sign * rate, 0.0, 0.0)
        if 0 <= teeth.impact[m] < len(record.impacts):
            # an impact lasts until its teeth part
            record.impacts[teeth.impact[m], 3] += damped
            record.impacts[teeth.impact[m], 4] += here.P[m]
