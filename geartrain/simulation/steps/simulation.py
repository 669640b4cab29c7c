"""Simulation of a contact model: allocation of the kernel arrays, and the results of a run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.simulation.contacts.contact_model import ContactModel, ContactSystem
from geartrain.simulation.contacts.pair_tables import PairTables, value_and_slope
from geartrain.simulation.steps.contact_solution import (
    COUNTS,
    DIVERGED,
    ENERGIES,
    FRONT,
    IMPACT_COLUMNS,
    IMPACTS,
    OPEN,
    SAMPLES,
    STEP,
    CompliantTeeth,
    ContactState,
    RunRecord,
    StepEquations,
    StepRules,
)
from geartrain.simulation.steps.time_steps import run_steps

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.simulation.contacts.contact_model import ToothCompliance

    _Mark = tuple[Floats, Floats, Floats]

_CREEP = 1e-10  # creep speed of a stuck bearing, relative to the fastest coordinate
_SLACK = 1e-11  # rounding error of a speed, relative to the fastest coordinate
_ROOM = 100_000  # maximum number of stored impacts
_AT_A_TIME = 1000, 40_000  # steps between two progress reports: in plain Python, and compiled
_ROUNDS = 60  # maximum number of guesses in a step, plus six for each contact and bearing


class StepPlan(NamedTuple):
    """Time steps of a run: length [s], skipped steps, counted steps, and number of steps between samples."""

    step: float
    skip: int
    steps: int
    stride: int
    block: int = 0
    """Number of steps in each block of the counted part whose results are stored; 0 if there are no blocks."""


@dataclass
class SimulatedRun:
    """Results of a simulated run, of which the first `plan.skip` steps are not evaluated.

    `start` and `end` are the kinetic energies at the start and at the end of the evaluated part [J].
    """

    plan: StepPlan
    angles: Floats
    speeds: Floats
    forces: Floats
    drive: Floats
    counts: Floats
    energy: Floats
    impacts: Floats
    numbers: tuple[int, ...]
    start: float
    end: float
    turned: Floats
    """Angles through which the coordinates turn during the counted part [rad]."""
    pressed: float = 0.0
    """Increase of the energy stored in compliant teeth [J]."""
    peaks: Floats | None = None
    """Maximum contact torque of each pair [N m]; None for rigid teeth."""
    blocks: tuple[SimulatedRun, ...] = ()
    """Parts of the run, each with `plan.block` steps. They contain counts, energies and angles."""


def simulate(
    model: ContactModel,
    plan: StepPlan,
    fast: bool = False,
    on_done: Callable[[int], object] = lambda _: None,
    yields: ToothCompliance | None = None,
) -> SimulatedRun:
    """Return the results of a simulated run. The kernels are compiled if `fast` is True.

    on_done   function that is called with the number of steps since its last call; if it returns True, the run stops,
              and `plan.steps` of the result is the number of counted steps so far
    yields    stiffness and damping of each pair; None for rigid teeth
    """
    system, n = model.system(plan.step, yields), len(model.torque)
    state = start_state(model, system)
    here = empty_equations(model)
    samples = (plan.skip + plan.steps) // plan.stride
    record = empty_record(n, len(model.pairs) + len(model.stops), samples, _ROOM)
    teeth = compliant_teeth(len(model.pairs), yields)
    # counting must start at a sample
    skip = plan.skip - plan.skip % plan.stride
    rules = step_rules(model, state, plan, plan.step * (plan.skip + plan.steps), 1.0 if yields is None else 0.5)
    run = run_steps.chosen(fast)
    # whole samples, so that no sample is divided between two calls of the kernel
    piece = max(1, _AT_A_TIME[fast] // plan.stride) * plan.stride

    def go(steps: int, counted: bool) -> int:
        """Advance by `steps` steps in pieces that end at samples, and return the number of completed steps."""
        done = 0
        while done < steps:
            own = min(piece, steps - done)
            run(system, model.transmissions, state, here, record, rules, teeth, own, counted)
            done += own
            check_convergence(state, record, plan.step)
            if on_done(own) is True:
                break
        return done

    skipped = go(skip, False)
    before = state.angle.copy()
    start, pressed = _energies(system, model.transmissions, state, yields)
    ends = [*range(0, plan.steps, plan.block or plan.steps or 1), plan.steps]
    marks, counted = [_mark(record, state)], 0
    for first, last in pairwise(ends if skipped == skip else ()):
        counted += (done := go(last - first, True))
        marks.append(_mark(record, state))
        if done < last - first:
            break
    end, elastic = _energies(system, model.transmissions, state, yields)
    # energy still stored in teeth is not dissipated
    pressed = elastic - pressed
    record.energy[STEP] -= pressed
    kept = min(int(record.numbers[IMPACTS]), _ROOM)
    done = int(record.numbers[SAMPLES])
    found = SimulatedRun(
        plan._replace(steps=counted),
        record.angles[:done],
        record.speeds[:done],
        record.forces[:done],
        record.drive[:done],
        record.counts,
        record.energy,
        record.impacts[:kept],
        tuple(int(each) for each in record.numbers),
        start,
        end,
        state.angle - before,
        pressed,
        None if yields is None else teeth.peak,
    )
    if plan.block:
        found.blocks = tuple(
            _part(found, at, *each) for at, each in enumerate(pairwise(marks[: 1 + counted // plan.block]))
        )
    return found


def _mark(record: RunRecord, state: ContactState) -> _Mark:
    """Return copies of the statistics, the energies and the coordinate angles at the present time step."""
    return record.counts.copy(), record.energy.copy(), state.angle.copy()


def _part(run: SimulatedRun, at: int, before: _Mark, after: _Mark) -> SimulatedRun:
    """Return the results of block number `at` of a run. `before` and `after` contain the counts, energies and angles
    that were recorded at the beginning and at the end of the block.
    """
    counts, energy, turned = (late - early for early, late in zip(before, after, strict=True))
    plan = run.plan._replace(skip=run.plan.skip + at * run.plan.block, steps=run.plan.block, block=0)
    return replace(run, plan=plan, counts=counts, energy=energy, turned=turned, blocks=())


def check_convergence(state: ContactState, record: RunRecord, step: float) -> None:
    """Raise `QuestionError` if the speeds of a run diverged."""
    if record.numbers[DIVERGED]:
        why = f"time steps of {step:.3g} s are too long for the stiffness of this train: speeds grow without bound"
        what = f"the simulation diverges after {state.clock[0]:.4g} s"
        raise QuestionError(Problem(what, why, "increase --steps, or reduce `step`", "--steps"))


def step_rules(
    model: ContactModel, state: ContactState, plan: StepPlan, duration: float, share: float = 1.0
) -> StepRules:
    """Return the numerical parameters of a run of the given duration [s], with tolerances above the rounding errors of
    the speeds.

    share   fraction of the step at which forces are evaluated
    """
    fastest = max(float(np.max(np.abs(model.typical), initial=0.0)), float(np.max(np.abs(state.speed), initial=0.0)))
    # a train at rest has no speed scale
    fastest = fastest or 1.0
    # rounding of angles grows with time and is divided by the step
    slack = max(_SLACK * fastest, 4 * np.finfo(float).eps * (1 + fastest * duration) / plan.step)
    rounds = _ROUNDS + 6 * (len(model.pairs) + len(model.stops) + len(model.bearings))
    return StepRules(plan.step, plan.stride, share, _CREEP * fastest, slack, rounds)


def start_state(model: ContactModel, system: ContactSystem) -> ContactState:
    """Return the initial state, in which all coordinates are 0.

    The initial speeds are those of the model. If the model has none, they are the speeds of minimum norm with all drive
    flanks in contact.
    """
    n, pairs, contacts = len(model.torque), len(model.pairs), len(system.compliance)
    ratio = np.zeros((pairs, 2))
    for m in range(pairs):
        for side in range(2):
            _, ratio[m, side] = value_and_slope(
                model.transmissions, int(system.tables[m, side]), float(system.start_driver[m])
            )
    if model.start is not None:
        speed = np.array(model.start, dtype=np.float64)
    else:
        speed = np.array([model.given.get(each, 0.0) for each in range(n)])
        free = np.flatnonzero(system.given == 0)
        rows = np.array([pair.opening_row(n, ratio[m, 0]) for m, pair in enumerate(model.pairs)]).reshape(pairs, n)
        speed[free] = np.linalg.lstsq(rows[:, free], -rows @ speed, rcond=None)[0]
    touching = np.full(contacts, OPEN, dtype=np.int64)
    touching[:pairs] = FRONT
    return ContactState(
        np.zeros(2),
        np.zeros(n),
        speed,
        touching,
        np.zeros(len(model.bearings), dtype=np.int64),
        ratio,
        np.zeros(contacts, dtype=np.int64),
        np.zeros(pairs),
        np.zeros(pairs, dtype=np.int64),
        np.zeros((len(model.stops), 2)),
    )


def empty_record(n: int, rows: int, samples: int, impacts: int) -> RunRecord:
    """Return an empty record for `n` coordinates, `rows` pairs and stops, and at most `samples` and `impacts`."""
    sampled = [(samples, n), (samples, n), (samples, rows), (samples, n)]
    shapes = [(ENERGIES,), (rows, COUNTS), *sampled, (impacts, IMPACT_COLUMNS)]
    return RunRecord._make([*map(np.zeros, shapes), np.zeros(DIVERGED + 1, dtype=np.int64)])


def empty_equations(model: ContactModel) -> StepEquations:
    """Return empty arrays for the equations of one time step of a model."""
    n, pairs, stops = len(model.torque), len(model.pairs), len(model.stops)
    contacts, flanks = pairs + stops, (pairs, 2)
    both, size = (contacts, 2), n + contacts
    shapes: list[Any] = [n, both, both, both, (size, size), size, n, contacts, n, n, n, flanks, flanks, stops]
    pressed = (0, 0) if model.loaded is None else (len(model.loaded.pair), len(model.loaded.bearing))
    loads: list[Any] = [(pressed[0], 2, 3), (pressed[1], 2, 3), (len(model.bearings), 2)]
    integers = np.zeros(contacts, dtype=np.int64)
    return StepEquations._make([*map(np.zeros, shapes), integers, *map(np.zeros, loads)])


def compliant_teeth(pairs: int, yields: ToothCompliance | None) -> CompliantTeeth:
    """Return the data of compliant teeth. Stiffness and damping are zero if the teeth are rigid (`yields` is None)."""
    stiffness, damping = (np.zeros(pairs), np.zeros(pairs)) if yields is None else yields
    return CompliantTeeth(stiffness, damping, np.zeros(pairs), np.full(pairs, -1, dtype=np.int64))


def _energies(
    system: ContactSystem, transmissions: PairTables, state: ContactState, yields: ToothCompliance | None
) -> tuple[float, float]:
    """Return the kinetic energy of a train, and the elastic energy stored in its compliant teeth [J]."""
    elastic = 0.0
    for m, stiffness in enumerate(() if yields is None else yields.stiffness):
        row = slice(system.pair_at[m], system.pair_at[m + 1])
        angle = state.angle[system.pair_of[row]]
        S = float(system.start_driver[m] + system.pair_driver[row] @ angle)
        q = float(system.start_driven[m] + system.pair_driven[row] @ angle)
        # only compressed flanks store energy; a pair without backlash is a spring in both directions
        gaps = [
            (1 - 2 * side) * (q - value_and_slope(transmissions, int(system.tables[m, side]), S)[0])
            for side in range(2)
        ]
        touches = [state.touching[m] == side + 1 for side in range(2)]
        pressed = (
            gaps[:1] if system.two_sided[m] else [min(gap, 0.0) * on for gap, on in zip(gaps, touches, strict=True)]
        )
        elastic += float(stiffness) / 2 * sum(gap**2 for gap in pressed)
    return float(state.speed @ system.mass @ state.speed / 2), elastic
