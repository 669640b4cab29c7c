"""Compliant teeth: the implicit midpoint rule for contacts with stiffness and damping.

docs/dynamics.md (15) and (18):

    P = h max(0, -k g - c dg/dt)   where g < 0,

with gap and closing speed in the middle of the step. Both are linear in the speeds at its end, because the transmission
function is evaluated at the extrapolated position. A touching pair is therefore a row with the compliance 1/s, s = h^2
k/4 + h c/2, in the equations that also solve rigid contacts. The rule is of second order and conserves the energy of
vibrations.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import ContactSystem
from geartrain.simulation.contacts.pair_tables import PairTables, value_and_slope
from geartrain.simulation.steps.contact_solution import (
    AT_ONCE,
    CHANGES,
    DIVERGED,
    FRICTION,
    IMPACT_COUNT,
    IMPACT_ENERGY,
    IMPACT_LOSS,
    IMPACT_SPEED,
    IMPACTS,
    IMPULSE,
    OPEN,
    PIVOTS,
    RUBBED,
    SAMPLES,
    STEP,
    STEPS,
    UNSOLVED,
    ContactState,
    RunRecord,
    StepEquations,
    StepRules,
    correct_guess,
    solve_guess,
)
from geartrain.simulation.steps.step_account import count_energy, count_gap, note_impact
from geartrain.simulation.steps.time_steps import add_to_sample, diverges, end_sample

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints


class CompliantTeeth(NamedTuple):
    """Data of compliant teeth by pair; torques are about the driven sides."""

    stiffness: Floats
    """Torsional stiffness [N m/rad]."""
    damping: Floats
    """Torsional damping [N m s/rad]."""
    peak: Floats
    """Maximum contact torque in the counted part [N m]; updated by the kernel."""
    impact: Ints
    """Index of the last impact of each pair, -1 for none; updated by the kernel."""
    gap: Floats
    """Gap of both flanks at the middle of a step, without the change of speed in the step [rad]; work space."""


@kernel
def run_compliant_steps(
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
    """Advance the state by `steps` time steps; the arguments are as in `run_steps`."""
    since = 0
    for _ in range(steps):
        rounds = solve_midpoint_step(system, transmissions, state, here, rules, teeth)
        if diverges(here.v, rules.step):
            record.numbers[DIVERGED] = 1
            break
        if rounds > rules.rounds:
            record.numbers[UNSOLVED] += 1
        for d in range(len(here.v)):
            here.middle[d] = (state.speed[d] + here.v[d]) / 2
        if counted:
            record.numbers[PIVOTS] += rounds - 1
            record.numbers[STEPS] += 1
            count_energy(system, state, here, record, rules, here.middle, 0.5)
            count_compliant_contacts(system, state, here, record, rules, teeth)
        for d in range(len(here.v)):
            state.speed[d] = here.v[d]
            state.angle[d] += rules.step * here.middle[d]
        state.clock[1] += 1.0
        state.clock[0] = state.clock[1] * rules.step
        if record.numbers[SAMPLES] < len(record.angles):
            since += 1
            sample = record.numbers[SAMPLES]
            add_to_sample(record.forces, record.drive, here.P, state.touching, here.drive, sample, 1)
            if since == rules.stride:
                end_sample(state, record, rules.stride * rules.step)
                since = 0


@kernel
def solve_midpoint_step(
    system: ContactSystem,
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    rules: StepRules,
    teeth: CompliantTeeth,
) -> int:
    """Solve for the speeds at the end of a step; return the number of contact states tried."""
    find_midpoint_loads(system, state, here, rules.step)
    for m in range(len(system.stiff)):
        here.before[m] = state.touching[m]
    find_midpoint_bounds(system, transmissions, state, here, teeth, rules.step)
    rounds = 0
    while True:
        solve_guess(system, state, here, rules.step, rules.creep)
        rounds += 1
        if rounds > rules.rounds:
            return rounds
        if correct_guess(system, state, here, rules.creep, rules.slack, rounds > AT_ONCE) == 0:
            return rounds


@kernel
def find_midpoint_loads(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """Compute the momentum, and the known parts of the impulses of torques, springs and drag."""
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
    transmissions: PairTables,
    state: ContactState,
    here: StepEquations,
    teeth: CompliantTeeth,
    step: float,
) -> None:
    """Compute speed ratios, lever arms and gaps at the middle of the step, and the row speeds at which P vanishes."""
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
            angle, ratio = value_and_slope(transmissions, system.tables[m, side], at)
            rate = sign * (dq - ratio * dS)
            here.ratio[m, side] = ratio
            here.arm[m, side] = ratio
            if system.rubbing[m, 2 * side + way] >= 0:
                more, _ = value_and_slope(transmissions, system.rubbing[m, 2 * side + way], at)
                here.arm[m, side] += more
            # with the row's speed r at the start and r+ at the end the gap is  gap + h/4 r+,  and P = s (bound - r+)
            teeth.gap[m, side] = sign * (q + step / 2 * dq - angle) - step / 4 * rate
            here.bound[m, side] = -(stiff * teeth.gap[m, side] + damped / 2 * rate) / system.stiff[m]
            if system.two_sided[m] == 0 and teeth.gap[m, side] + step / 4 * rate >= 0.0:
                # flanks without contact do not damp
                here.bound[m, side] = -np.inf
                if state.touching[m] == side + 1:
                    state.touching[m] = 0


@kernel
def count_compliant_contacts(
    system: ContactSystem,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    rules: StepRules,
    teeth: CompliantTeeth,
) -> None:
    """Add times in contact, losses of damping and friction, impacts and peak torques, by pair.

    The work of a contact without its damping is added to the numerical dissipation, from which the change of the stored
    energy must be subtracted.
    """
    for m in range(len(system.stiff)):
        rate_S, rate_q, mean_S, mean_q, start_S, start_q = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            rate_S += system.pair_driver[x] * here.v[o]
            rate_q += system.pair_driven[x] * here.v[o]
            mean_S += system.pair_driver[x] * here.middle[o]
            mean_q += system.pair_driven[x] * here.middle[o]
            start_S += system.pair_driver[x] * state.speed[o]
            start_q += system.pair_driven[x] * state.speed[o]
        counts = record.counts[m]
        if system.two_sided[m] == 0:
            ahead = teeth.gap[m, 0] + rules.step / 4 * (rate_q - here.ratio[m, 0] * rate_S)
            behind = teeth.gap[m, 1] + rules.step / 4 * (here.ratio[m, 1] * rate_S - rate_q)
            count_gap(counts, ahead, behind, 1.0 if state.touching[m] == OPEN else 0.0)
            for side in range(2):
                opening = (1.0 - 2.0 * side) * (start_q - here.ratio[m, side] * start_S)
                count_released_energy(state, here, record, teeth, m, side, rules.step / 4 * opening)
        now = state.touching[m]
        if now == 0:
            teeth.impact[m] = -1
            continue
        side = now - 1
        sign = 1.0 - 2.0 * side
        rate = mean_q - here.ratio[m, side] * mean_S
        damped = rules.step * teeth.damping[m] * rate * rate
        rubbed = -here.P[m] * sign * (here.ratio[m, side] - here.arm[m, side]) * mean_S
        record.energy[FRICTION] += rubbed
        record.energy[IMPACT_LOSS] += damped
        record.energy[STEP] += -here.P[m] * sign * rate - damped
        counts[RUBBED] += rubbed
        counts[IMPACT_ENERGY] += damped
        counts[IMPULSE] += here.P[m] * sign
        teeth.peak[m] = max(teeth.peak[m], abs(here.P[m]) / rules.step)
        if now != here.before[m] and system.two_sided[m] == 0:
            if here.before[m] != 0:
                counts[CHANGES] += 1.0
            counts[IMPACT_COUNT] += 1.0
            counts[IMPACT_SPEED] = max(counts[IMPACT_SPEED], -sign * rate)
            # at first contact the force is only that of damping, which decreases within the first step
            met = sign * (here.ratio[m, side] * start_S - start_q)
            teeth.peak[m] = max(teeth.peak[m], teeth.damping[m] * met)
            teeth.impact[m] = record.numbers[IMPACTS]
            note_impact(record, state.clock[0] + rules.step / 2, m, -sign * rate, 0.0, 0.0)
        if 0 <= teeth.impact[m] < len(record.impacts):
            # an impact lasts until its teeth separate
            record.impacts[teeth.impact[m], 3] += damped
            record.impacts[teeth.impact[m], 4] += here.P[m]


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
    """Add the energy stored in teeth at separation to the impact losses, because their damping dissipates it.

    opened   change of the gap from the start to the middle of the step, at the initial speeds [rad]
    """
    parted = (1 if here.before[m] == side + 1 else 0) - (1 if state.touching[m] == side + 1 else 0)
    if parted != 0:
        pressed = min(teeth.gap[m, side] - opened, 0.0)
        left = parted * teeth.stiffness[m] / 2 * pressed * pressed
        record.energy[IMPACT_LOSS] += left
        record.energy[STEP] -= left
        record.counts[m, IMPACT_ENERGY] += left
