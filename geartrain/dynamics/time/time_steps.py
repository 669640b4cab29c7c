"""Nonsmooth time stepping after Moreau and Jean: one kernel that runs a train through many steps of one length.

Contact is held at the level of positions for what does not bounce, docs/dynamics.md (12): with S* = S + h dS/dt and
F*, tau* there,

    dq/dt+ - tau* dS/dt+ >= k,   k = (F* - tau* h dS/dt - q)/h,   for a closing contact k = max(k, -e dg/dt-),

so that gaps do not drift. Which contacts touch and which bearings stick is found by turning wrong guesses round, all at
once and, should that not settle, least index first, from the guess of the step before.
"""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.time.contact_solution import StepEquations, solve_guess
from geartrain.dynamics.time.contact_system import (
    PIVOTS,
    SAMPLES,
    STEPS,
    UNSOLVED,
    ContactState,
    ContactSystem,
    RunRecord,
)
from geartrain.dynamics.time.law_tables import LawTables, value_and_slope
from geartrain.dynamics.time.step_account import count_contacts, count_energy, count_stops, leaps
from geartrain.numerics.kernels import kernel

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

_AT_ONCE = 6  # rounds in which all wrong guesses are turned round together
_AGAIN = 4  # times that laws are read anew where a blow moves their drivers on
_NEAR = 1e-9  # rad: drivers that stand so near to where their laws were read


@kernel
def run_steps(
    system: ContactSystem,
    laws: LawTables,
    state: ContactState,
    here: StepEquations,
    record: RunRecord,
    step: float,
    steps: int,
    stride: int,
    creep: float,
    apart: float,
    slack: float,
    counted: bool,
) -> None:
    """Go so many steps on.

    stride    steps from one sample to the next
    creep     speed up to which a stuck bearing gives way (rad/s); `slack`, error of a speed that is none (rad/s)
    apart     gap from which teeth count as apart (rad)
    counted   whether energies, shares and impacts are counted; samples always are
    """
    n, pairs = len(here.v), len(system.stiff)
    stops = len(system.stop_stiff)
    gap = np.zeros((pairs, 2))
    closing = np.zeros((pairs, 2))
    before = np.zeros(pairs + stops, np.int64)
    middle = np.zeros(n)
    ahead = np.zeros(n)
    sample = record.numbers[SAMPLES]
    since = 0
    for _ in range(steps):
        find_loads(system, state, here, step)
        find_bounds(system, laws, state, here, state.speed, step, gap, closing)
        find_stop_bounds(system, state, here, step)
        for m in range(pairs):
            before[m] = state.touching[m]
        for m in range(stops):
            before[pairs + m] = state.stopped[m]
        rounds = 0
        again = 0
        for d in range(n):
            ahead[d] = state.speed[d]
        limit = 60 + 6 * (pairs + stops + len(system.sliding))
        while True:
            solve_guess(system, state, here, step, creep)
            rounds += 1
            if rounds > limit:
                record.numbers[UNSOLVED] += 1
                break
            if correct_guess(system, state, here, creep, slack, rounds > _AT_ONCE) == 0:
                if again == _AGAIN or not is_struck(system, laws, state, here, before):
                    break
                if find_shift(system, here, ahead) * step < _NEAR:
                    break
                again += 1
                for d in range(n):
                    ahead[d] = here.v[d]
                find_bounds(system, laws, state, here, ahead, step, gap, closing)
        for d in range(n):
            middle[d] = (state.speed[d] + here.v[d]) / 2
        if counted:
            record.numbers[PIVOTS] += rounds - 1
            record.numbers[STEPS] += 1
            count_energy(system, state, here, record, step, creep, middle)
            count_contacts(system, laws, state, here, record, step, apart, middle, before, gap, closing)
            count_stops(system, state, here, record, middle, before)
        for m in range(pairs):
            state.ratio[m, 0] = here.ratio[m, 0]
            state.ratio[m, 1] = here.ratio[m, 1]
        for d in range(n):
            state.speed[d] = here.v[d]
            state.angle[d] += step * here.v[d]
        state.clock[1] += 1.0
        state.clock[0] = state.clock[1] * step
        if sample < len(record.angles):
            since += 1
            for m in range(pairs):
                record.forces[sample, m] += here.P[m] * (3.0 - 2.0 * state.touching[m])
            for m in range(stops):
                record.forces[sample, pairs + m] += here.P[pairs + m]
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
def find_loads(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """Momentum, and impulses of torques and springs."""
    n = len(here.v)
    for d in range(n):
        here.load[d] = step * system.torque[d] + system.mass[d, d] * state.speed[d]
        for x in range(system.near_at[d], system.near_at[d + 1]):
            o = system.near[x]
            here.load[d] += system.mass[d, o] * state.speed[o]
            here.load[o] += system.mass[o, d] * state.speed[d]
    for m in range(len(system.spring_stiffness)):
        pull = system.spring_rest[m] + system.spring_rate[m] * (state.clock[0] + step)
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            pull -= system.spring_c[x] * state.angle[system.spring_of[x]]
        for x in range(system.spring_at[m], system.spring_at[m + 1]):
            here.load[system.spring_of[x]] += step * system.spring_stiffness[m] * pull * system.spring_c[x]


@kernel
def find_bounds(
    system: ContactSystem,
    laws: LawTables,
    state: ContactState,
    here: StepEquations,
    ahead: Floats,
    step: float,
    gap: Floats,
    closing: Floats,
) -> None:
    """Speed ratios, arms and bounds k of both flanks where the speeds `ahead` lead.

    gap       k without restitution; `closing`, speeds before the step
    """
    for m in range(len(system.stiff)):
        S, q, dS, dq, on = system.start_driver[m], system.start_driven[m], 0.0, 0.0, 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            S += system.pair_driver[x] * state.angle[o]
            q += system.pair_driven[x] * state.angle[o]
            dS += system.pair_driver[x] * state.speed[o]
            dq += system.pair_driven[x] * state.speed[o]
            on += system.pair_driver[x] * ahead[o]
        at = S + step * on
        way = 0 if dS >= 0 else 1
        for side in range(2):
            if state.touching[m] == 2 - side and system.two_sided[m] == 0:
                # a play away from the flank that touches: nothing of it is asked before that one is left
                here.bound[m, side] = -np.inf
                gap[m, side] = -np.inf
                continue
            sign = 1.0 - 2.0 * side
            angle, ratio = value_and_slope(laws, system.tables[m, side], at)
            lack = sign * ((angle - q) / step - ratio * on)
            rate = sign * (dq - ratio * dS)
            gap[m, side] = lack
            closing[m, side] = -rate
            bounce = -system.restitution[m] * rate
            # without restitution the position alone counts: a jump of the ratio within the step is no flight
            if bounce > 0.0 and rate < lack < bounce:
                lack = bounce
            here.bound[m, side] = lack
            here.ratio[m, side] = ratio
            here.arm[m, side] = ratio
            if system.rubbing[m, 2 * side + way] >= 0:
                more, _ = value_and_slope(laws, system.rubbing[m, 2 * side + way], at)
                here.arm[m, side] += more


@kernel
def is_struck(system: ContactSystem, laws: LawTables, state: ContactState, here: StepEquations, before: Ints) -> bool:
    """Whether a flank has come to touch in this step, or the ratio of one that touches has jumped."""
    for m in range(len(system.stiff)):
        now = state.touching[m]
        if now != 0 and (now != before[m] or leaps(system, laws, state, here, m, now - 1)):
            return True
    return False


@kernel
def find_shift(system: ContactSystem, here: StepEquations, ahead: Floats) -> float:
    """How far the speeds of drivers are from those for which the laws were read (rad/s)."""
    most = 0.0
    for m in range(len(system.stiff)):
        shift = 0.0
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            shift += system.pair_driver[x] * (here.v[o] - ahead[o])
        most = max(most, abs(shift))
    return most


@kernel
def find_stop_bounds(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """How fast each stopped link may go: to its stop, or back from it."""
    for m in range(len(system.stop_stiff)):
        beats = floor((state.clock[0] + step / 2) / system.stop_beat[m])
        room = system.stop_first[m] + (1.0 + beats) * system.stop_pitch[m]
        rate = 0.0
        for x in range(system.stop_at[m], system.stop_at[m + 1]):
            room -= system.stop_c[x] * state.angle[system.stop_of[x]]
            rate += system.stop_c[x] * state.speed[system.stop_of[x]]
        bound = room / step
        if rate > bound and rate > 0.0:
            bound = min(bound, -system.stop_restitution[m] * rate)
        here.stop_bound[m] = bound


@kernel
def correct_guess(
    system: ContactSystem, state: ContactState, here: StepEquations, creep: float, slack: float, single: bool
) -> int:
    """Turn wrong guesses round, all of them or only that of the least index; how many there were."""
    found = 0
    pairs = len(system.stiff)
    for m in range(pairs):
        now = state.touching[m]
        want = now
        if now != 0:
            if here.P[m] < 0.0:
                want = 0
                if system.two_sided[m] != 0:
                    # without friction a force may have either sign
                    want = 3 - now if system.rubbing[m, 0] >= 0 else now
        else:
            rate_S, rate_q = 0.0, 0.0
            for x in range(system.pair_at[m], system.pair_at[m + 1]):
                rate_S += system.pair_driver[x] * here.v[system.pair_of[x]]
                rate_q += system.pair_driven[x] * here.v[system.pair_of[x]]
            if rate_q - here.ratio[m, 0] * rate_S < here.bound[m, 0] - slack:
                want = 1
            elif here.ratio[m, 1] * rate_S - rate_q < here.bound[m, 1] - slack:
                want = 2
        if want != now:
            state.touching[m] = want
            found += 1
            if single:
                return found
    for m in range(len(system.sliding)):
        rate = 0.0
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            rate += system.bearing_c[x] * here.v[system.bearing_of[x]]
        now = state.turning[m]
        want = now
        if now == 0:
            if rate > creep:
                want = 1
            elif rate < -creep:
                want = -1
        elif rate * now < 0.0:
            want = 0 if single or rate * now > -creep else -now
        if want != now:
            state.turning[m] = want
            found += 1
            if single:
                return found
    for m in range(len(system.stop_stiff)):
        rate = 0.0
        for x in range(system.stop_at[m], system.stop_at[m + 1]):
            rate += system.stop_c[x] * here.v[system.stop_of[x]]
        now = state.stopped[m]
        want = now
        if now != 0 and here.P[pairs + m] < 0.0:
            want = 0
        elif now == 0 and rate > here.stop_bound[m] + slack:
            want = 1
        if want != now:
            state.stopped[m] = want
            found += 1
            if single:
                return found
    return found
