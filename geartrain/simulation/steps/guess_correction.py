"""What is wrong with a guess of contacts, bearings and stops, and how it is turned round (docs/dynamics.md, 4)."""

from __future__ import annotations

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_system import ContactSystem
from geartrain.simulation.steps.contact_solution import StepEquations
from geartrain.simulation.steps.run_record import BACK, FRONT, OPEN, ContactState

AT_ONCE = 6
"""Rounds in which all wrong guesses are turned round together."""


@kernel
def correct_guess(
    system: ContactSystem, state: ContactState, here: StepEquations, creep: float, slack: float, single: bool
) -> int:
    """Turn wrong guesses round, all of them or only that of the least index; how many there were."""
    found = correct_pairs(system, state, here, slack, single)
    if len(system.sliding) > 0 and (found == 0 or not single):
        found += correct_bearings(system, state, here, creep, single)
    if len(system.stop_stiff) > 0 and (found == 0 or not single):
        found += correct_stops(system, state, here, slack, single)
    return found


@kernel
def correct_pairs(system: ContactSystem, state: ContactState, here: StepEquations, slack: float, single: bool) -> int:
    """Let go of flanks that pull, and close gaps below zero."""
    found = 0
    for m in range(len(system.stiff)):
        now = state.touching[m]
        want = now
        if now == OPEN:
            driver, driven = 0.0, 0.0
            for x in range(system.pair_at[m], system.pair_at[m + 1]):
                driver += system.pair_driver[x] * here.v[system.pair_of[x]]
                driven += system.pair_driven[x] * here.v[system.pair_of[x]]
            if driven - here.ratio[m, 0] * driver < here.bound[m, 0] - slack:
                want = FRONT
            elif here.ratio[m, 1] * driver - driven < here.bound[m, 1] - slack:
                want = BACK
        elif here.P[m] < 0.0:
            want = OPEN
            if system.two_sided[m] != 0:
                # without friction a force may have either sign
                want = FRONT + BACK - now if system.rubbing[m, 0] >= 0 else now
        if want != now:
            state.touching[m] = want
            found += 1
            if single:
                return found
    return found


@kernel
def correct_bearings(
    system: ContactSystem, state: ContactState, here: StepEquations, creep: float, single: bool
) -> int:
    """Let bearings go that would creep too fast, and stick that turn against their friction."""
    found = 0
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
    return found


@kernel
def correct_stops(system: ContactSystem, state: ContactState, here: StepEquations, slack: float, single: bool) -> int:
    """Let go of stops that pull, and hold what passes one."""
    found = 0
    for m in range(len(system.stop_stiff)):
        rate = 0.0
        for x in range(system.stop_at[m], system.stop_at[m + 1]):
            rate += system.stop_c[x] * here.v[system.stop_of[x]]
        now = state.stopped[m]
        want = now
        if now != 0:
            if here.P[len(system.stiff) + m] < 0.0:
                want = 0
        elif rate > here.stop_bound[m] + slack:
            want = 1
        if want != now:
            state.stopped[m] = want
            found += 1
            if single:
                return found
    return found
