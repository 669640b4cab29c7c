"""One block of trials: wheels are drawn, pairs evaluated and pointer errors computed.

Random errors come from independent streams, each keyed by seed, block, wheel and kind of error. A trial therefore has
the same errors in any process, and studies of clearance factors and of scaled errors use the same random numbers.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.teeth.transmission import ExactRatio
from geartrain.workshop.cutting.cut_wheel import CutWheel
from geartrain.workshop.cutting.displaced_pair import DisplacedWheel
from geartrain.workshop.cutting.wheel_estimate import closed_steps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.workshop.cutting.declared_errors import ErrorSpecification, WheelErrors
    from geartrain.workshop.cutting.file_strokes import FilingWork
    from geartrain.workshop.cutting.trial_transmission import TrialTransmissionFunction
    from geartrain.workshop.monte_carlo.trial_plan import TrialPair, TrialPlan

    Marks = NDArray[np.uint8]

# ------------------------------------------------------------------------------------------------------- random numbers


BLOCK = 256
"""Number of trials that are drawn together. Results depend on this number, so it must never change."""

NUMBER = {
    "pitch_deviation": 0,
    "eccentricity": 1,
    "tip": 3,
    "aperture_deviation": 4,
    "centre": 5,
    "bearing": 6,
    "stepping": 9,
}
"""Number of the random stream of each kind of error. Results depend on these numbers, so they must never change."""
TOWARDS, POSITION, FRICTION, HAND, PIVOT, RADIUS, STRENGTH = 2, 7, 8, 10, 11, 12, 13
"""Numbers of the random streams of the direction of an eccentricity, the position of the input, the friction of teeth,
the torque limit at the crank, the friction of pivots, the radii of pivots, and the strength of metals.
"""
Streams = tuple[Container[int], Container[int]]
EVERY = range(1 << 31)
"""Range that contains the numbers of all wheels and pairs, or of all kinds of error."""


@dataclass(frozen=True, slots=True)
class RandomStreams:
    """Generators of random numbers for one block, which consists of 256 consecutive trials."""

    seed: int
    block: int
    """Number of the block, from 0."""
    other: Streams = ((), ())
    """Items (wheels or pairs) and kinds of error that are drawn from the second sample for Sobol indices."""

    def rng(self, item: int, kind: int) -> np.random.Generator:
        """Return the random number generator for one kind of error of one item (wheel, pair or input position)."""
        key = (self.block, item, kind, int(item in self.other[0] and kind in self.other[1]))
        # PCG64 by name: numpy's default generator may change, and results must not
        return np.random.Generator(np.random.PCG64(np.random.SeedSequence(self.seed, spawn_key=key)))

    def errors(self, item: int, kind: str, off: ErrorSpecification, shape: tuple[int, ...]) -> Floats:
        """Return random errors of the kind `kind`, as fractions of pitch, half angle or depth.

        item    number of the wheel or pair
        off     distribution of the errors
        shape   shape of the result: (trials, teeth), or (trials,) for a kind that has one value for each wheel or pair
        """
        if off.way == "value":
            return np.full(shape, off.size)
        rng = self.rng(item, NUMBER[kind])
        unit = rng.standard_normal(shape) if off.way == "normal" else rng.uniform(-1.0, 1.0, shape)
        return off.size * unit


def draw_wheel(
    wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice
) -> tuple[CutWheel | DisplacedWheel, Bools]:
    """Return one wheel with random errors in some trials of a block, and a mask of the trials in which it can be cut.

    `item` is the number of the wheel, and `rows` are the numbers of the trials in the block. Triangular wheels have tip
    radius 1, or -1 if they are internal. In trials in which a wheel cannot be cut, its teeth have no errors (displaced
    flanks: no pitch deviations), so that teeth always have tips in later computations.
    """
    # a whole block is drawn and then sliced, so that a trial does not depend on the trials computed with it
    shape, trials = (BLOCK, wheel.z), rows.stop - rows.start
    zero = np.zeros(wheel.z)

    def drawn(kind: str) -> Floats:
        found = zero + np.asarray(wheel.tables[kind]) if kind in wheel.tables else zero
        return found + streams.errors(item, kind, wheel.errors[kind], shape)[rows] if kind in wheel.errors else found

    # signs: declared errors are positive ahead and wider, the arrays of a wheel positive behind and flatter
    ahead = drawn("pitch_deviation")
    if "stepping" in wheel.errors:
        ahead = ahead + closed_steps(drawn("stepping"))
    place = np.broadcast_to(-wheel.pitch * ahead, (trials, wheel.z))
    tip = wheel.depth * drawn("tip")
    flank = wheel.half_angle * drawn("aperture_deviation")
    off_centre = "eccentricity" in wheel.errors or "eccentricity" in wheel.tables
    eccentric = _draw_eccentricity(wheel, item, streams, rows) if off_centre else None
    if wheel.displaced is not None:
        made = DisplacedWheel(place, tip, flank, flank, zero, zero, *(eccentric or (0.0, 0.0)))
        good = np.asarray(made.cuttable.all(axis=-1))
        return replace(made, place=np.where(good[:, None], place, 0.0)), good
    cut = CutWheel(-1.0 if wheel.ring else 1.0, wheel.half_angle, place, tip, flank, flank)
    if eccentric is not None:
        cut = cut.moved(*eccentric)
    good = np.asarray(cut.cuttable.all(axis=-1))
    if good.all():
        return cut, good
    # perfect teeth replace those that cannot be cut; these trials are flagged and not counted
    kept = [np.where(good[:, None], each, 0.0) for each in (cut.place, cut.tip, cut.leading, cut.trailing)]
    return CutWheel(cut.radius, wheel.half_angle, *kept), good


def _draw_eccentricity(wheel: WheelErrors, item: int, streams: RandomStreams, rows: slice) -> tuple[Floats, Floats]:
    measured = wheel.tables.get("eccentricity")
    if measured is not None:
        e = np.full(rows.stop - rows.start, wheel.depth * measured[0])
    else:
        e = wheel.depth * streams.errors(item, "eccentricity", wheel.errors["eccentricity"], (BLOCK,))[rows]
    if wheel.towards is not None:
        return e, np.full(len(e), wheel.towards)
    return e, streams.rng(item, TOWARDS).uniform(0.0, 2 * pi, BLOCK)[rows]


# ----------------------------------------------------------------------------------------------------- wheels and pairs

JAM, CLASH, DWELL, DISENGAGED, UNCUT = 1, 2, 4, 8, 16
"""Event flags of a pair in one trial, combined as a bit mask."""
STOPS, LOST = JAM | CLASH, JAM | DISENGAGED | UNCUT
"""Bit masks that select pairs that jam or clash, and pairs that are excluded from averages."""


@dataclass(frozen=True)
class TrialWheels:
    """Wheels with random errors in consecutive trials of a block."""

    plan: TrialPlan
    streams: RandomStreams
    rows: slice
    """Numbers of the trials within their block."""
    wheels: tuple[CutWheel | DisplacedWheel, ...]
    """Wheels of the plan, triangular ones with tip radius 1."""
    good: tuple[Bools, ...]
    """Mask for each wheel, True in trials in which it can be cut."""

    @property
    def trials(self) -> int:
        """Number of trials."""
        return int(self.rows.stop - self.rows.start)

    def pair(self, at: int, widest: int = 0) -> Any:
        """Return the gear pair with index `at`, with its random errors in all trials.

        widest   1 for the maximum and -1 for the minimum centre distance within the bearing clearance, 0 for a random
                 distance
        """
        pair = self.plan.pairs[at]
        if not pair.stroke:
            return pair.cut(self.wheels, self._shift(pair, at, widest))
        filed = self.filing[at].pair
        return filed if widest < 0 else replace(filed, shift=self._shift(pair, at, widest))

    @cached_property
    def filing(self) -> dict[int, FilingWork[Any]]:
        """Result of filing each pair that is filed to fit, at its minimum centre distance, keyed by pair index."""
        pairs = enumerate(self.plan.pairs)
        return {at: pair.filed(pair.cut(self.wheels, self._shift(pair, at, -1))) for at, pair in pairs if pair.stroke}

    def strokes(self) -> Floats:
        """Return numbers of file strokes (even columns) and of filed teeth (odd columns), (trials, 2 * pairs)."""
        found = np.zeros((self.trials, 2 * len(self.plan.pairs)))
        for at, work in self.filing.items():
            found[:, 2 * at], found[:, 2 * at + 1] = work.strokes, work.teeth
        return found

    def _shift(self, pair: TrialPair, at: int, widest: int) -> Floats | float:
        if not pair.fitting:
            return 0.0
        shift = np.zeros(self.trials)
        for kind, off in pair.fitting.items():
            # a whole block is drawn and then sliced, so that a trial does not depend on their number
            drawn = self.streams.errors(len(self.plan.wheels) + at, kind, off, (BLOCK,))[self.rows]
            # bearing clearance varies from tooth to tooth, so the worst case is taken
            shift = shift + (widest * np.abs(drawn) if kind == "bearing" and widest else drawn)
        return shift * pair.depth


def draw_trial_wheels(plan: TrialPlan, streams: RandomStreams, trials: int = BLOCK, start: int = 0) -> TrialWheels:
    """Return the wheels with random errors in `trials` trials of a block, from the trial with index `start`."""
    rows = slice(start, start + trials)
    found = [draw_wheel(wheel, at, streams, rows) for at, wheel in enumerate(plan.wheels)]
    return TrialWheels(plan, streams, rows, tuple(wheel for wheel, _ in found), tuple(good for _, good in found))


# ------------------------------------------------------------------------------------------------------------- verdicts


def judge_trial_pairs(drawn: TrialWheels) -> tuple[Marks, Floats]:
    """Return event flags and minimum backlash [pitch of the driven wheel] of each pair, both (trials, pairs).

    The flags are a bit mask: 1 jam, 2 clash, 4 dwell, 8 disengaged, 16 not cuttable.
    """
    columns, backlashes = [], []
    for at, pair in enumerate(drawn.plan.pairs):
        # jams are found at the smallest distance of the bearings, other events at both limits
        near = pair.verdicts(drawn.pair(at, -1))
        loose = pair.verdicts(drawn.pair(at, 1)) if pair.fitting.get("bearing") else near
        marks = (
            JAM * near.jams
            + CLASH * (near.clash | loose.clash)
            + DWELL * (near.dwell | loose.dwell)
            + DISENGAGED * (near.disengaged | loose.disengaged)
        )
        uncut = ~(drawn.good[pair.first] & drawn.good[pair.second])
        columns.append(np.where(uncut, UNCUT, marks).astype(np.uint8))
        backlashes.append(near.backlash / pair.pitches[1])
    return np.stack(columns, axis=1), np.stack(backlashes, axis=1)


# ------------------------------------------------------------------------------------------------------------- pointers


def input_positions(drawn: TrialWheels) -> Floats:
    """Return a random input position for each trial, uniform over the span of the plan [turn], shape (trials,)."""
    # a whole block is drawn and then sliced, as for all errors
    return drawn.streams.rng(drawn.plan.position, POSITION).uniform(0.0, drawn.plan.span, BLOCK)[drawn.rows]


@dataclass(frozen=True)
class TrialPointers:
    """Motion of the outputs of a train in trials with random errors of the wheels."""

    cut: ErrorComposition
    """Motion with the random errors."""
    even: ErrorComposition
    """Motion with perfect wheels."""
    transmissions: dict[str, TrialTransmissionFunction]
    """Transmission functions of the pairs with random errors, keyed by pair."""

    def errors(self, turns: Floats) -> Floats:
        """Return each output's position minus its mean position with perfect teeth [rad], shape (outputs, n)."""
        return self.cut.at(turns).error - self.even.at(turns).error

    def superposed(self, turns: Floats) -> Floats:
        """Return `errors` to first order [rad]: the sum of the transmission errors of all pairs times constants."""
        # the anomaly of the pins cancels in the difference
        return Superposition(self.cut).at(turns) - Superposition(self.even).at(turns)


def trial_pointers(
    drawn: TrialWheels, rows: NDArray[np.int64], outputs: tuple[int, ...] | None = None
) -> TrialPointers:
    """Return the motion of the outputs with the given indices (None: all) in the trials `drawn`.

    rows   index of the trial for each input position
    """
    plan, whole = drawn.plan, drawn.plan.composition
    at = {pair.name: number for number, pair in enumerate(plan.pairs)}
    wanted = whole.outputs if outputs is None else tuple(whole.outputs[each] for each in outputs)
    offsets = whole.offsets and (whole.offsets if outputs is None else tuple(whole.offsets[each] for each in outputs))
    pairs = {source.id: plan.pairs[at[source.id]] for source in whole.sources if source.id in at}
    transmissions = {name: pair.transmission(drawn.pair(at[name]), rows) for name, pair in pairs.items()}
    cut, even = [], []
    for source in whole.sources:
        pair, transmission = pairs.get(source.id), transmissions.get(source.id)
        # the transmission function of cut wheels repeats after a full meshing cycle, that of perfect ones after a pitch
        cut.append(
            replace(source, transmission=transmission, cycles=source.cycles / transmission.count)
            if transmission
            else source
        )
        even.append(
            replace(source, transmission=ExactRatio(transmission.ratio, transmission.pitches[0], pair.even))
            if pair and transmission
            else source
        )
    made = [ErrorComposition(whole.spread, tuple(each), wanted, offsets) for each in (cut, even)]
    return TrialPointers(made[0], made[1], transmissions)
