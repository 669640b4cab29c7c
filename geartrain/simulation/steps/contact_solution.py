"""Speeds and impulses at the end of a time step for an assumed set of closed contacts and sticking bearings.

    M (v+ - v) = h T + sum f_c P_c,   r_c v+ + P_c/s_c = k_c  for every c that touches        docs/dynamics.md (11)

The speeds v+ and the impulses P_c of the contacts are the solution of one system of linear equations (13), with the row
r_c of the opening speed, its bound k_c and the compliance 1/s_c, which is 0 for rigid teeth.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geartrain.numerics.kernels import kernel
from geartrain.simulation.contacts.contact_model import ContactSystem

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Ints

OPEN, FRONT, BACK = 0, 1, 2
"""Code of the flank in contact: none, the drive flank, or the coast flank."""

WORK_DRIVE, WORK_TORQUE, WORK_SPRING, BEARINGS, VISCOUS, IMPACT_LOSS, STEP, FRICTION = range(8)
"""Columns of the energy balance [J]: three kinds of input work and five kinds of losses."""

ENERGIES = 8
TIME_APART, TIME_COAST, IMPACT_COUNT, IMPACT_ENERGY, IMPACT_SPEED, IMPULSE, RUBBED, GAP, CHANGES = range(9)
"""Columns of the statistics of each pair: numbers of steps apart and on the coast flank; number, energy and maximum
speed of impacts; impulse, friction energy, maximum gap, and number of changes of flank.
"""

COUNTS = 9
SAME_FRICTION = 1e-9
"""Relative accuracy of the friction torques that increase with the loads on bearings."""

IMPACT_COLUMNS = 5
"""Number of columns in the list of impacts: time, contact (pairs, then stops), closing speed, energy, impulse."""


class ContactState(NamedTuple):
    """State of a simulated train, which the kernels modify in place. Contacts are the pairs, then the stops."""

    clock: Floats
    """Simulated time [s] and number of the time step."""
    angle: Floats
    """Angles of the coordinates [rad]. `speed` contains their speeds [rad/s]."""
    speed: Floats
    touching: Ints
    """Touching flank of each contact (`BACK` for an active stop). `turning` is -1, 0 (stuck) or 1 for each bearing."""
    turning: Ints
    ratio: Floats
    """Speed ratios of both flanks of each pair in the last step, shape (pairs, 2). `struck` is 1 for each contact
    during an impact.
    """
    struck: Ints
    steady: Floats
    """Impulse of each pair in its last step that had no impact [N m s]."""
    flown: Ints
    """Number of steps since each pair separated.

    `stop_rate`, shape (stops, 2), contains two speeds of each stopped link: one step ago, and when it last left its
    stop [rad/s].
    """
    stop_rate: Floats


class RunRecord(NamedTuple):
    """Results of a simulated run, which the kernels modify in place.

    energy         energy balance, with the columns from `WORK_DRIVE` on
    counts         statistics of pairs and stops, shape (pairs + stops, COUNTS)
    angles, speeds coordinates and their speeds at the samples, shape (samples, n)
    forces         mean torque of each pair and stop between samples, shape (samples, pairs + stops)
    drive          mean torque of each prescribed coordinate between samples, shape (samples, n)
    impacts        list of impacts, shape (capacity, IMPACT_COLUMNS)
    numbers        numbers of samples, of impacts, of steps without a solution, of changes of contacts and bearings
                   (pivots), and of counted steps; 1 if the steps diverged and the run was stopped
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
    """Data of the compliant teeth of each pair. Torques refer to the driven sides."""

    stiffness: Floats
    """Torsional stiffness [N m/rad]."""
    damping: Floats
    """Torsional damping [N m s/rad]."""
    peak: Floats
    """Maximum contact torque in the evaluated part of the run [N m], updated by the kernel."""
    impact: Ints
    """Index of the last impact of each pair, or -1 if there was none, updated by the kernel."""


class StepEquations(NamedTuple):
    """Equations of one time step: data, work space and solution."""

    load: Floats
    """External impulses plus the momenta of the coordinates at the start of the step [N m s]."""
    bound: Floats
    """Lower bound k on the opening speed at both flanks of each contact [rad/s]; -inf for a flank that cannot touch."""
    ratio: Floats
    """Speed ratio at both flanks of each contact [1]; 0 for stops."""
    arm: Floats
    """Lever arm at both flanks of each contact: driver's torque divided by the driven side's torque [1]; 0
    for stops.
    """
    matrix: Floats
    """Matrix of equation (13) of docs/dynamics.md, shape (n + contacts, n + contacts). The elimination
    overwrites it.
    """
    solution: Floats
    """Right side of equation (13) of docs/dynamics.md, which is overwritten by the solution: speeds [rad/s] and
    impulses of the contacts [N m s]. For a prescribed coordinate, the solution contains the impulse of the drive
    instead of the speed.
    """
    v: Floats
    """Speeds of the coordinates at the end of the step [rad/s]."""
    P: Floats
    """Impulses of the contacts [N m s]."""
    drive: Floats
    """Impulses that maintain the speeds of prescribed coordinates [N m s]."""
    ahead: Floats
    """Speeds by which positions are extrapolated to evaluate the transmission functions [rad/s]."""
    middle: Floats
    """Mean speeds of the coordinates during the step [rad/s]."""
    gap: Floats
    """Bound on the opening speeds of both flanks without restitution [rad/s]. For compliant teeth, the gaps of both
    flanks at the middle of the step if the speeds do not change during the step [rad].
    """
    closing: Floats
    """Closing speeds of both flanks of each contact before the step [rad/s]."""
    stop_closing: Floats
    before: Ints
    """Touching flank of each contact before the step."""
    forces: Floats
    """Components `along` and `apart` of each force on a bearing for a unit torque on its carrier, shape
    (forces, 2, 3).
    """
    direction: Floats
    """Direction of the load on each support, shape (supports, 2, 3), and friction torque of each bearing due to its
    load [N m], shape (bearings, 2). Both have two values: those used in the last solution, and those that follow from
    this solution.
    """
    load_friction: Floats


class StepRules(NamedTuple):
    """Numerical parameters of the time steps of a run: step length, tolerances and limits."""

    step: float
    """Length of a time step [s]. `stride` is the number of steps between samples."""
    stride: int
    share: float
    """Fraction of the step at which forces are evaluated: 1 (implicit Euler) for rigid teeth, 1/2 (midpoint rule) for
    compliant teeth.
    """
    creep: float
    """Maximum creep speed of a stuck bearing [rad/s]. `slack` is the rounding error of a zero speed [rad/s]."""
    slack: float
    rounds: int
    """Maximum number of combinations of contact states that are tried in a time step."""


@kernel
def solve_guess(system: ContactSystem, state: ContactState, here: StepEquations, step: float, creep: float) -> None:
    """Solve the equations of a time step for speeds and impulses, and store them in `here`. Touching contacts and
    turning bearings are those in `state`.

    creep   maximum creep speed of a stuck bearing [rad/s]
    """
    assemble(system, state, here, step, creep)
    solve_linear(here.matrix, here.solution)
    n = len(here.v)
    for d in range(n):
        prescribed = system.given[d] != 0
        here.v[d] = state.speed[d] if prescribed else here.solution[d]
        here.drive[d] = here.solution[d] if prescribed else 0.0
    for m in range(len(here.P)):
        here.P[m] = here.solution[n + m]


@kernel
def assemble(system: ContactSystem, state: ContactState, here: StepEquations, step: float, creep: float) -> None:
    """Assemble the matrix and the right side of equation (13) of docs/dynamics.md."""
    A, b, n = here.matrix, here.solution, len(here.v)
    A[:, :] = 0.0
    # a loop, because compiled copies of slices check for overlap and take longer
    for d in range(n):
        b[d] = here.load[d]
        for o in range(n):
            A[d, o] = system.matrix[d, o]
    for m in range(len(system.sliding)):
        turning = state.turning[m]
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            if turning != 0:
                b[system.bearing_of[x]] -= step * system.sliding[m] * turning * system.bearing_c[x]
            else:
                # a stuck bearing is viscous up to its sticking torque at the creep speed
                stiff = step * (system.sticking[m] + here.load_friction[m, 1]) / creep * system.bearing_c[x]
                for y in range(system.bearing_at[m], system.bearing_at[m + 1]):
                    A[system.bearing_of[x], system.bearing_of[y]] += stiff * system.bearing_c[y]
    for m in range(len(system.compliance)):
        if state.touching[m] == OPEN:
            # its equation is P = 0
            A[n + m, n + m] = 1.0
            b[n + m] = 0.0
            continue
        side = state.touching[m] - 1
        sign = 1.0 - 2.0 * side
        A[n + m, n + m] = system.compliance[m]
        b[n + m] = here.bound[m, side]
        # the row of speeds uses the ratio, the column of forces the lever arm with friction
        for x in range(system.pair_at[m], system.pair_at[m + 1]):
            o = system.pair_of[x]
            A[n + m, o] = sign * (system.pair_driven[x] - here.ratio[m, side] * system.pair_driver[x])
            A[o, n + m] = -sign * (system.pair_driven[x] - here.arm[m, side] * system.pair_driver[x])
    for support in range(len(system.loaded.bearing)):
        add_load_friction(system, state, here, step, support)
    for d in range(n):
        if system.given[d] != 0:
            # the speed is known, and the impulse of the drive is the unknown instead
            for o in range(len(b)):
                b[o] -= A[o, d] * state.speed[d]
                A[o, d] = 0.0
            A[d, d] = -1.0


@kernel
def add_load_friction(
    system: ContactSystem, state: ContactState, here: StepEquations, step: float, support: int
) -> None:
    """Add the friction of a turning bearing due to the load R on one support: rho e.R, where rho is the friction radius
    and e is the direction of R in the last solution.

    This is the linearisation of rho |R| in Newton's method: its error is of second order in the change of direction.
    """
    loaded, e, n = system.loaded, here.direction[support, 0], len(here.v)
    m, row = loaded.bearing[support], loaded.supports[support]
    if state.turning[m] == 0:
        return
    for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
        o, size = system.bearing_of[x], state.turning[m] * system.bearing_c[x] * row[6]
        here.solution[o] -= step * size * (e[0] * row[0] + e[1] * row[1] + e[2] * row[2])
        for f in range(len(loaded.pair)):
            if loaded.share[support, f] != 0.0 and state.touching[loaded.pair[f]] != OPEN:
                along, apart, torque = here.forces[f, 0], here.forces[f, 1], carrier_torque(system, state, here, f)
                # a contact without backlash may pull
                sign = -1.0 if here.P[loaded.pair[f]] < 0.0 else 1.0
                on = torque * (e[0] * along[0] + e[1] * along[1] + e[2] * along[2])
                on += sign * abs(torque) * (e[0] * apart[0] + e[1] * apart[1] + e[2] * apart[2])
                here.matrix[o, n + loaded.pair[f]] += size * loaded.share[support, f] * on


@kernel
def carrier_torque(system: ContactSystem, state: ContactState, here: StepEquations, f: int) -> float:
    """Return the torque on the carrier per unit impulse of the pair that exerts bearing force number `f`."""
    m = system.loaded.pair[f]
    side = state.touching[m] - 1
    sides = system.loaded.forces[f]
    return float((1.0 - 2.0 * side) * (sides[0] * here.arm[m, side] - sides[1]))


@kernel
def turn_forces(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> None:
    """Rotate the forces on bearings with their carriers to the end of a step of length `step` (Rodrigues' formula)."""
    for f in range(len(system.loaded.pair)):
        angle = 0.0
        for d in range(len(here.v)):
            angle += system.loaded.turn[f, d] * (state.angle[d] + step * state.speed[d])
        c, s, k = cos(angle), sin(angle), system.loaded.about[f]
        for part in range(2):
            v = system.loaded.forces[f, 2 + 3 * part : 5 + 3 * part]
            inside = (1.0 - c) * (v[0] * k[0] + v[1] * k[1] + v[2] * k[2])
            for x in range(3):
                y, z = (x + 1) % 3, (x + 2) % 3
                here.forces[f, part, x] = v[x] * c + (k[y] * v[z] - k[z] * v[y]) * s + k[x] * inside


@kernel
def find_bearing_loads(system: ContactSystem, state: ContactState, here: StepEquations, step: float) -> bool:
    """Compute the loads on all bearings from the impulses. Return True if the resulting friction differs from the
    friction used in the solution.
    """
    loaded, differs = system.loaded, False
    for m in range(len(here.load_friction)):
        here.load_friction[m, 0] = here.load_friction[m, 1] if state.turning[m] == 0 else 0.0
        here.load_friction[m, 1] = 0.0
    size = np.zeros(len(here.load_friction))
    R = np.zeros(3)
    for support in range(len(loaded.bearing)):
        m, row, e = loaded.bearing[support], loaded.supports[support], here.direction[support]
        for x in range(3):
            R[x] = step * row[x]
            size[m] += abs(step * row[6] * row[x])
        for f in range(len(loaded.pair)):
            share = loaded.share[support, f]
            if share != 0.0 and state.touching[loaded.pair[f]] != OPEN:
                torque = share * carrier_torque(system, state, here, f) * here.P[loaded.pair[f]]
                for x in range(3):
                    own = torque * here.forces[f, 0, x] + abs(torque) * here.forces[f, 1, x] * (1 if share > 0 else -1)
                    R[x] += own
                    size[m] += abs(row[6] * own)
        inside = R[0] * row[3] + R[1] * row[4] + R[2] * row[5]
        for x in range(3):
            R[x] -= inside * row[3 + x]
        if state.turning[m] != 0:
            here.load_friction[m, 0] += row[6] * (e[0, 0] * R[0] + e[0, 1] * R[1] + e[0, 2] * R[2]) / step
        length = sqrt(R[0] * R[0] + R[1] * R[1] + R[2] * R[2])
        here.load_friction[m, 1] += row[6] * length / step
        if length > 0.0:
            for x in range(3):
                e[1, x] = R[x] / length
    for m in range(len(here.load_friction)):
        # the forces of a train at rest are not determined: stuck bearings keep the loads of the last solution
        off = abs(here.load_friction[m, 1] - here.load_friction[m, 0]) * step
        if state.turning[m] != 0 and off > SAME_FRICTION * size[m]:
            differs = True
    return differs


@kernel
def solve_linear(A: Floats, b: Floats) -> None:
    """Replace b by the solution x of A x = b, found by Gaussian elimination. A is overwritten.

    Pivoting is not needed: the mass matrix is positive definite, and contacts are eliminated after all coordinates.
    """
    for k in range(len(b)):
        for i in range(k + 1, len(b)):
            if A[i, k] != 0.0:
                part = A[i, k] / A[k, k]
                b[i] -= part * b[k]
                for j in range(k + 1, len(b)):
                    A[i, j] -= part * A[k, j]
    for k in range(len(b) - 1, -1, -1):
        for j in range(k + 1, len(b)):
            b[k] -= A[k, j] * b[j]
        b[k] /= A[k, k]


AT_ONCE = 6
"""Number of iterations in which all wrong contact states are changed at once (block pivoting)."""


@kernel
def correct_contacts(
    system: ContactSystem, state: ContactState, here: StepEquations, slack: float, single: bool
) -> int:
    """Open contacts with tensile impulses, close flanks that would penetrate, and return the number of changes.

    slack    penetration speed that is tolerated [rad/s]
    single   True to change only the contact with the lowest index (Murty's method)
    """
    found = 0
    for m in range(len(system.compliance)):
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
    """Release bearings that stick but creep faster than `creep` [rad/s], and reverse or stop bearings that turn against
    their assumed sense. Return the number of changes. If `single` is True, make at most one change (Murty's method).
    """
    found = 0
    for m in range(len(system.sliding)):
        rate = 0.0
        for x in range(system.bearing_at[m], system.bearing_at[m + 1]):
            rate += system.bearing_c[x] * here.v[system.bearing_of[x]]
        now = state.turning[m]
        want = now
        if now == 0:
            limit, used = creep, system.sticking[m] + here.load_friction[m, 0]
            if used > 0.0 and here.load_friction[m, 0] != here.load_friction[m, 1]:
                limit *= (system.sticking[m] + here.load_friction[m, 1]) / used
            if rate > limit:
                want = 1
            elif rate < -limit:
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
