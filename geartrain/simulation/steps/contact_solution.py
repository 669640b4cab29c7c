"""Speeds at the end of a step for one guess of the touching and sticking contacts, by elimination in a fixed order.

    M (v+ - v) = h T + sum f_c P_c,   r_c v+ = k_c  for every c that touches        docs/dynamics.md (11)

A touching pair determines its driven coordinate, v_d = sum w_o v_o + k/r_d, and (13) condenses row and column of d into
the coordinates before it. A pair without contact leaves d free, and d is eliminated by Gauss. If each coordinate
depends on one before it (a chain, a tree), the condensation is I_p += tau^2 I_c, b_p += tau (b_c - I_c k_c).

Rows that determine no coordinate (a second path between two links, stops, stuck bearings) enter the matrix with a
compliance far below that of any mass: s r^T r v = s k r.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import ContactSystem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

OPEN, FRONT, BACK = 0, 1, 2
"""Flank in contact: none, the drive flank, or the coast flank."""

WORK_DRIVE, WORK_TORQUE, WORK_SPRING, BEARINGS, VISCOUS, IMPACT_LOSS, STEP, FRICTION = range(8)
"""Columns of the energy balance [J]: three kinds of input work, and five kinds of loss."""

ENERGIES = 8
TIME_APART, TIME_COAST, IMPACT_COUNT, IMPACT_ENERGY, IMPACT_SPEED, IMPULSE, RUBBED, GAP, CHANGES = range(9)
"""Columns of the counts of each pair: steps apart and on the coast flank, impacts, their energy and maximum speed,
impulse, friction energy, maximum gap, and changes of flank."""

COUNTS = 9
IMPACT_COLUMNS = 5
"""Columns of the list of impacts: time, contact (stops after the pairs), closing speed, energy, impulse."""


class ContactState(NamedTuple):
    """State of a train; modified in place by the kernels."""

    clock: Floats
    """Time [s] and step number."""
    angle: Floats
    """Angles of the coordinates [rad]; `speed` is in rad/s."""
    speed: Floats
    touching: Ints
    """Touching flank of each pair; `turning` of each bearing: -1, 0 (stuck), 1; `stopped` of each stop: 0, 1."""
    turning: Ints
    stopped: Ints
    ratio: Floats
    """Speed ratio of each pair in the last step, shape (pairs, 2); `struck` is 1 for pairs and stops during an
    impact.
    """
    struck: Ints
    steady: Floats
    """Impulse of each pair in its last step without an impact [N m s]."""
    flown: Ints
    """Number of steps since each pair separated.

    `stop_rate`, (stops, 2), has the speed at each stop one step ago, and when it was last left.
    """
    stop_rate: Floats


class RunRecord(NamedTuple):
    """Results of a run; modified in place by the kernels.

    energy         columns `WORK_DRIVE` and following
    counts         (pairs and stops, COUNTS)
    angles, speeds samples, (samples, n); `forces` mean torques between samples, (samples, pairs + stops)
    drive          mean torque of each prescribed coordinate between samples, (samples, n)
    impacts        (capacity, IMPACT_COLUMNS); `numbers`: samples, impacts detected, unsolved steps, pivots, steps
                   counted, and 1 if the steps diverged and the run stopped
    """

    energy: Floats
    counts: Floats
    angles: Floats
    speeds: Floats
    forces: Floats
    drive: Floats
    impacts: Floats
    numbers: Ints


SAMPLES, IMPACTS, UNSOLVED, PIVOTS, STEPS, DIVERGED = range(6)


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


class StepEquations(NamedTuple):
    """Equations of one step: data, work space and solution."""

    load: Floats
    """External impulses plus the momentum at the start of the step [N m s]."""
    bound: Floats
    """Bound k of both flanks of each pair [rad/s]; `stop_bound` is the bound of each stop."""
    stop_bound: Floats
    ratio: Floats
    """Speed ratio of both flanks of each pair."""
    arm: Floats
    """Driver's torque divided by the driven side's torque, for both flanks of each pair."""
    A: Floats
    """Matrix; overwritten by the elimination."""
    b: Floats
    """Right side; overwritten by the elimination."""
    w: Floats
    """Coefficients w of the speed of each determined coordinate, which is w v + known, shape (n, n)."""
    g: Floats
    """Factors that condense the row of a determined coordinate into earlier rows."""
    known: Floats
    """Known part of the speed of a determined coordinate [rad/s]."""
    v: Floats
    """Speeds of the coordinates at the end of the step [rad/s]."""
    P: Floats
    """Impulses of pairs and stops [N m s]."""
    drive: Floats
    """Impulses that maintain the speeds of prescribed coordinates [N m s]."""
    ahead: Floats
    """Speeds with which the positions for the transmission functions are extrapolated [rad/s]."""
    middle: Floats
    """Mean speeds of the step [rad/s]."""
    gap: Floats
    """Bound k of both flanks without restitution [rad/s]."""
    closing: Floats
    """Closing speeds of both flanks before the step [rad/s]."""
    stop_closing: Floats
    before: Ints
    """Touching flanks and active stops before the step."""


class StepRules(NamedTuple):
    """Numerical parameters of the time steps of a run: length, tolerances and limits."""

    step: float
    """Time step [s]; `stride` is the number of steps between samples."""
    stride: int
    share: float
    """Fraction of the step at which forces are evaluated: 1 (implicit Euler) for rigid teeth, 1/2 (midpoint rule) for
    compliant teeth.
    """
    creep: float
    """Maximum creep speed of a stuck bearing [rad/s]; `slack` is the rounding error of a speed of 0 [rad/s]."""
    slack: float
    rounds: int
    """Maximum number of contact states tried in a step."""


@kernel
def solve_guess(system: ContactSystem, state: ContactState, here: StepEquations, step: float, creep: float) -> None:
    """Solve for speeds and impulses with the contacts that the state assumes as touching, turning and stopped.

    creep   maximum creep speed of a stuck bearing [rad/s]
    """
    assemble(system, state, here, step, creep)
    eliminate_coordinates(system, state, here)
    substitute_back(system, state, here)
    find_stiff_impulses(system, state, here)


@kernel
def assemble(system: ContactSystem, state: ContactState, here: StepEquations, step: float, creep: float) -> None:
    """Assemble matrix and right side of all coordinates, without the pairs that determine a coordinate."""
    A, b = here.A, here.b
    b[:] = here.load
    A[:, :] = system.matrix
    for m in range(len(system.sliding)):
        turning = state.turning[m]
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            if turning != 0:
                b[system.bearing_of[x]] -= step * system.sliding[m] * turning * system.bearing_c[x]
            else:
                # a stuck bearing is viscous up to its sticking torque at the creep speed
                stiff = step * system.sticking[m] / creep * system.bearing_c[x]
                for y in range(system.bearing_at[m], system.bearing_at[m + 1]):
                    A[system.bearing_of[x], system.bearing_of[y]] += stiff * system.bearing_c[y]
    for m in range(len(system.stiff)):
        if system.stiff[m] > 0.0 and state.touching[m] != 0:
            side = state.touching[m] - 1
            for x in range(system.pair_at[m], system.pair_at[m + 1]):
                push = system.stiff[m] * (system.pair_driven[x] - here.arm[m, side] * system.pair_driver[x])
                b[system.pair_of[x]] += push * (1.0 - 2.0 * side) * here.bound[m, side]
                for y in range(system.pair_at[m], system.pair_at[m + 1]):
                    row = system.pair_driven[y] - here.ratio[m, side] * system.pair_driver[y]
                    A[system.pair_of[x], system.pair_of[y]] += push * row
    for m in range(len(system.stop_stiff)):
        if state.stopped[m] != 0:
            for x in range(system.stop_at[m], system.stop_at[m + 1]):
                push = system.stop_stiff[m] * system.stop_c[x]
                b[system.stop_of[x]] += push * here.stop_bound[m]
                for y in range(system.stop_at[m], system.stop_at[m + 1]):
                    A[system.stop_of[x], system.stop_of[y]] += push * system.stop_c[y]


@kernel
def eliminate_coordinates(system: ContactSystem, state: ContactState, here: StepEquations) -> None:
    """Eliminate the coordinates from the last to the first.

    A coordinate whose pair touches is eliminated by condensation, another one by Gaussian elimination. All is done
    in one loop, because a call with this number of arrays takes as long as a coordinate.
    """
    A, b, w, g = here.A, here.b, here.w, here.g
    for d in range(len(b) - 1, -1, -1):
        if system.given[d] != 0:
            continue
        own, m = A[d, d], system.owner[d]
        if m < 0 or state.touching[m] == 0:
            for o in range(d):
                if A[o, d] != 0.0:
                    part = A[o, d] / own
                    b[o] -= part * b[d]
                    for y in range(d):
                        A[o, y] -= part * A[d, y]
            continue
        side = state.touching[m] - 1
        first = system.pair_at[m]  # the determined coordinate is first in its row
        # the row of speeds uses the ratio, that of forces the lever arm with friction
        lead = system.pair_driven[first] - here.ratio[m, side] * system.pair_driver[first]
        lead_force = system.pair_driven[first] - here.arm[m, side] * system.pair_driver[first]
        for o in range(d):
            w[d, o] = 0.0
            g[o] = 0.0
        for x in range(first + 1, system.pair_at[m + 1]):
            o = system.pair_of[x]
            w[d, o] = (here.ratio[m, side] * system.pair_driver[x] - system.pair_driven[x]) / lead
            g[o] = (here.arm[m, side] * system.pair_driver[x] - system.pair_driven[x]) / lead_force
        known = (1.0 - 2.0 * side) * here.bound[m, side] / lead
        here.known[d] = known
        rest = b[d] - own * known
        for o in range(d):
            if g[o] != 0.0 or A[o, d] != 0.0:
                b[o] += g[o] * rest - A[o, d] * known
                for y in range(d):
                    A[o, y] += g[o] * (A[d, y] + own * w[d, y]) + A[o, d] * w[d, y]


@kernel
def substitute_back(system: ContactSystem, state: ContactState, here: StepEquations) -> None:
    """Compute the speeds from the first coordinate to the last, and the impulses of pairs and drives."""
    A, v = here.A, here.v
    here.P[:] = 0.0
    here.drive[:] = 0.0
    for d in range(len(v)):
        if system.given[d] != 0:
            v[d] = state.speed[d]
            here.drive[d] += A[d, d] * v[d] - here.b[d]
            for o in range(d):  # prescribed coordinates come first, so these are prescribed too
                here.drive[d] += A[d, o] * v[o]
                here.drive[o] += A[o, d] * v[d]
            continue
        rest = -here.b[d]
        for o in range(d):
            rest += A[d, o] * v[o]
        m = system.owner[d]
        if m < 0 or state.touching[m] == 0:
            v[d] = -rest / A[d, d]
            continue
        v[d] = here.known[d]
        for o in range(d):
            v[d] += here.w[d, o] * v[o]
        first, side = system.pair_at[m], state.touching[m] - 1
        lead = system.pair_driven[first] - here.arm[m, side] * system.pair_driver[first]
        here.P[m] = (rest + A[d, d] * v[d]) / lead * (1.0 - 2.0 * side)


@kernel
def find_stiff_impulses(system: ContactSystem, state: ContactState, here: StepEquations) -> None:
    """Compute the impulses of pairs that determine no coordinate, and of stops, from their regularised rows."""
    pairs = len(system.stiff)
    for m in range(pairs):
        if system.stiff[m] > 0.0 and state.touching[m] != 0:
            side = state.touching[m] - 1
            rate = 0.0
            for x in range(system.pair_at[m], system.pair_at[m + 1]):
                row = system.pair_driven[x] - here.ratio[m, side] * system.pair_driver[x]
                rate += row * here.v[system.pair_of[x]]
            here.P[m] = system.stiff[m] * (here.bound[m, side] - (1.0 - 2.0 * side) * rate)
    for m in range(len(system.stop_stiff)):
        if state.stopped[m] != 0:
            rate = 0.0
            for x in range(system.stop_at[m], system.stop_at[m + 1]):
                rate += system.stop_c[x] * here.v[system.stop_of[x]]
            # a stop acts from ahead: r v <= k
            here.P[pairs + m] = system.stop_stiff[m] * (rate - here.stop_bound[m])


AT_ONCE = 6
"""Number of iterations in which all wrong contact states are changed together (block pivoting)."""


@kernel
def correct_guess(
    system: ContactSystem, state: ContactState, here: StepEquations, creep: float, slack: float, single: bool
) -> int:
    """Correct the wrong contact states, all or only the state of lowest index (Murty's method); return their number."""
    # with `single` the first wrong state ends the search, pairs before bearings before stops
    found = correct_pairs(system, state, here, slack, single)
    if len(system.sliding) > 0 and (found == 0 or not single):
        found += correct_bearings(system, state, here, creep, single)
    if len(system.stop_stiff) > 0 and (found == 0 or not single):
        found += correct_stops(system, state, here, slack, single)
    return found


@kernel
def correct_pairs(system: ContactSystem, state: ContactState, here: StepEquations, slack: float, single: bool) -> int:
    """Open flanks with tensile impulses, and close flanks that penetrate; return the number of changes."""
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
    """Release bearings that creep too fast, and stick bearings that turn against their friction; return the number of
    changes.
    """
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
            # a fast reversal changes the sense at once; with `single` the bearing sticks first
            want = 0 if single or rate * now > -creep else -now
        if want != now:
            state.turning[m] = want
            found += 1
            if single:
                return found
    return found


@kernel
def correct_stops(system: ContactSystem, state: ContactState, here: StepEquations, slack: float, single: bool) -> int:
    """Release stops with tensile impulses, and activate stops that a link passes; return the number of changes."""
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
