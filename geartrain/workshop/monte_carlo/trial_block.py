"""One block of trials: wheels are drawn, pairs evaluated and pointer errors computed, reproducibly in any process."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition
from geartrain.dynamics.motion.superposition import Superposition
from geartrain.teeth.transmission import ExactRatio
from geartrain.workshop.cutting.cut_wheel import CutWheel
from geartrain.workshop.cutting.displaced_pair import DisplacedWheel
from geartrain.workshop.monte_carlo.random_streams import BLOCK, POSITION, RandomStreams, draw_wheel

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Bools, Floats
    from geartrain.workshop.cutting.file_strokes import FilingWork
    from geartrain.workshop.cutting.trial_transmission import TrialTransmissionFunction
    from geartrain.workshop.monte_carlo.trial_plan import TrialPair, TrialPlan

    Marks = NDArray[np.uint8]

JAM, CLASH, DWELL, DISENGAGED, UNCUT = 1, 2, 4, 8, 16
"""Event flags of a pair in one trial, combined as a bit mask."""
STOPS, LOST = JAM | CLASH, JAM | DISENGAGED | UNCUT
"""Bit masks of pairs that stop with a dragging driven wheel, and of pairs that are excluded from averages."""


@dataclass(frozen=True)
class TrialWheels:
    """Wheels drawn for some trials: `wheels` by number with tip radius 1, and `good`, masks of cuttable wheels."""

    plan: TrialPlan
    streams: RandomStreams
    rows: slice
    wheels: tuple[CutWheel | DisplacedWheel, ...]
    good: tuple[Bools, ...]

    @property
    def trials(self) -> int:
        """Number of trials."""
        return int(self.rows.stop - self.rows.start)

    def pair(self, at: int, widest: int = 0) -> Any:
        """Return one pair of drawn wheels.

        widest   1 or -1 for the maximum or minimum distance within the bearing clearance, 0 for the drawn distance
        """
        pair = self.plan.pairs[at]
        if not pair.stroke:
            return pair.cut(self.wheels, self._shift(pair, at, widest))
        filed = self.filing[at].pair
        return filed if widest < 0 else replace(filed, shift=self._shift(pair, at, widest))

    @cached_property
    def filing(self) -> dict[int, FilingWork[Any]]:
        """Filing of each pair that is filed to fit, at the minimum distance of its bearings, by index of the pair."""
        pairs = enumerate(self.plan.pairs)
        return {at: pair.filed(pair.cut(self.wheels, self._shift(pair, at, -1))) for at, pair in pairs if pair.stroke}

    def strokes(self) -> Floats:
        """Return numbers of file strokes and of filed teeth in alternate columns, shape (trials, 2 * pairs)."""
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
    """Return the wheels drawn for consecutive trials of a block, beginning with its trial number `start`."""
    rows = slice(start, start + trials)
    found = [draw_wheel(wheel, at, streams, rows) for at, wheel in enumerate(plan.wheels)]
    return TrialWheels(plan, streams, rows, tuple(wheel for wheel, _ in found), tuple(good for _, good in found))


# ------------------------------------------------------------------------------------------------------------- verdicts


def judge_trial_pairs(drawn: TrialWheels) -> tuple[Marks, Floats]:
    """Return event flags and minimum backlash [pitch of the driven wheel] of each pair, shape (trials, pairs)."""
    judged = [_judged(drawn, at) for at in range(len(drawn.plan.pairs))]
    return np.stack([marks for marks, _ in judged], axis=1), np.stack([backlash for _, backlash in judged], axis=1)


def _judged(drawn: TrialWheels, at: int) -> tuple[Marks, Floats]:
    pair = drawn.plan.pairs[at]
    # jams are found at the smallest distance of the bearings, other events at both limits
    near, far = pair.verdicts(drawn.pair(at, -1)), None
    if pair.fitting.get("bearing"):
        far = pair.verdicts(drawn.pair(at, 1))
    loose = far or near
    marks = (
        JAM * near.jams
        + CLASH * (near.clash | loose.clash)
        + DWELL * (near.dwell | loose.dwell)
        + DISENGAGED * (near.disengaged | loose.disengaged)
    )
    uncut = ~(drawn.good[pair.first] & drawn.good[pair.second])
    marks = np.where(uncut, UNCUT, marks)
    return marks.astype(np.uint8), near.backlash / pair.pitches[1]


# ------------------------------------------------------------------------------------------------------------- pointers


def input_positions(drawn: TrialWheels) -> Floats:
    """Return a random input position in each trial [turn], uniform over the span of the plan, shape (trials,)."""
    # a whole block is drawn and then sliced, as for all errors
    return drawn.streams.rng(drawn.plan.position, POSITION).uniform(0.0, drawn.plan.span, BLOCK)[drawn.rows]


@dataclass(frozen=True)
class TrialPointers:
    """Composed motion of the train with drawn wheels (`cut`) and with perfect wheels (`even`)."""

    cut: ErrorComposition
    even: ErrorComposition
    transmissions: dict[str, TrialTransmissionFunction]

    def errors(self, turns: Floats) -> Floats:
        """Return the deviation of each output from its mean position with perfect teeth [rad], shape (outputs, n)."""
        return self.cut.at(turns).error - self.even.at(turns).error

    def superposed(self, turns: Floats) -> Floats:
        """Return the deviations as in `errors`, but to first order [rad]: each pair at its mean angle, each pin at its
        mean ratio.
        """
        # the anomaly of the pins cancels in the difference
        return Superposition(self.cut).at(turns) - Superposition(self.even).at(turns)


def trial_pointers(
    drawn: TrialWheels, rows: NDArray[np.int64], outputs: tuple[int, ...] | None = None
) -> TrialPointers:
    """Return the composed motion of outputs (default all) with the drawn wheels; `rows` is the trial at each position.

    The transmission functions of all pairs and pins are composed exactly, for every trial at its own position.
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
