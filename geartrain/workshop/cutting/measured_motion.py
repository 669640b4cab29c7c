"""Motion of a train with the teeth of its wheels as they were measured, without random errors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.teeth.transmission import LosslessTransmission
from geartrain.workshop.cutting.declared_errors import ErrorSpecification
from geartrain.workshop.monte_carlo.trial_block import RandomStreams, draw_trial_wheels
from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.dynamics import Motion
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.trial_plan import TrialPair

_SAMPLES = 64  # positions per pitch for the range and the mean of a transmission error


class MeasuredTransmission(LosslessTransmission):
    """Transmission function of one pair of cut wheels, periodic with the cycle in which all its teeth meet."""

    measured = True

    def __init__(self, pair: TrialPair, cut: Any) -> None:
        self._pair, self._cut = pair, cut
        one = pair.transmission(cut, np.zeros(0, dtype=np.int64))
        self.ratio, self.period = one.ratio, one.period
        self.pitch_count = self.waves = one.count

    def error_and_speed(self, S: ArrayLike) -> tuple[Floats, Floats]:
        """Return transmission errors [rad of the driven wheel] and speed ratios at driver angles S [rad]."""
        S = np.asarray(S, dtype=float)
        one = self._pair.transmission(self._cut, np.zeros(S.size, dtype=np.int64))
        error, speed = one.error_and_speed(S.ravel())
        return error.reshape(S.shape), speed.reshape(S.shape)

    def error(self, S: ArrayLike) -> Floats:
        """Return the transmission errors [rad of the driven wheel] at driver angles S [rad]."""
        return self.error_and_speed(S)[0]

    def speed(self, S: ArrayLike) -> Floats:
        """Return the speed ratios at driver angles S [rad]."""
        return self.error_and_speed(S)[1]

    def _sampled(self) -> tuple[Floats, Floats]:
        count = _SAMPLES * self.pitch_count
        return self.error_and_speed(self.period * np.arange(count) / count)

    def error_range(self) -> tuple[float, float]:
        """Return the minimum and maximum sampled transmission error [rad of the driven wheel]."""
        error, _ = self._sampled()
        return float(error.min()), float(error.max())

    def speed_range(self) -> tuple[float, float]:
        """Return the minimum and maximum sampled speed ratio."""
        _, speed = self._sampled()
        return float(speed.min()), float(speed.max())

    def error_moments(self) -> tuple[float, float]:
        """Return the mean of the sampled transmission error and its rms deviation [rad of the driven wheel]."""
        error, _ = self._sampled()
        return float(error.mean()), float(error.std())

    def reversed_motion(self) -> MeasuredTransmission:
        """Raise `QuestionError`, because measured teeth are evaluated in the declared sense of rotation only."""
        what, why = "the train turns backwards", "measured teeth are evaluated in the declared sense of rotation only"
        raise QuestionError(Problem(what, why, "give positive turns, or omit the measured teeth"))


def measured_motion(
    train: GearTrain, state: str | None = None, outputs: Sequence[str] = (), without: Sequence[str] = ()
) -> Motion:
    """Compute the motion of a train with its wheels as measured: tables, fixed errors and filing, no random errors.

    Parameters
    ----------
    train : GearTrain
        Train with measured wheels.
    state, outputs, without
        State, outputs and omitted pairs, as for `GearTrain.motion`.

    Returns
    -------
    Motion
        Motion as a function of the position of the input, in its declared sense.

    Raises
    ------
    QuestionError
        If no wheel has measured teeth or fixed errors.
    RangeError
        If a pair jams or disengages, or one of its wheels cannot be cut.

    See Also
    --------
    run_course : pointer errors of wheels drawn at random
    """
    plan = find_trial_plan(train, (), outputs, state, without)
    # an eccentricity without a direction is random
    wheels = tuple(replace(each, errors=_fixed(each.errors, each.towards is not None)) for each in plan.wheels)
    pairs = tuple(replace(each, fitting=_fixed(each.fitting)) for each in plan.pairs)
    drawn = draw_trial_wheels(replace(plan, wheels=wheels, pairs=pairs), RandomStreams(0, 0), 1)
    found = {}
    for at, pair in enumerate(pairs):
        if pair.fitting or not (wheels[pair.first].true and wheels[pair.second].true):
            cut = drawn.pair(at)
            events = pair.verdicts(cut)
            if events.jams[0] or events.disengaged[0] or not (drawn.good[pair.first][0] and drawn.good[pair.second][0]):
                what, why = f"pair '{pair.name}' cannot turn with its teeth as measured", "it jams or disengages"
                fix = "change its clearance, or let it be filed: `fitting: {filing: {stroke: 1 %}}`"
                raise RangeError(Problem(what, why, fix))
            found[pair.name] = MeasuredTransmission(pair, cut)
    if not found:
        what, why = f"no wheel of '{train.name}' is measured", "random errors are omitted"
        raise QuestionError(Problem(what, why, "declare `cutting: {measured: {csv: FILE}}` for a wheel"))
    return train.motion(state, outputs, without)._with_transmissions(found)


def _fixed(errors: Mapping[str, ErrorSpecification], directed: bool = True) -> dict[str, ErrorSpecification]:
    random = {"bearing"} if directed else {"bearing", "eccentricity"}
    return {kind: off for kind, off in errors.items() if off.way == "value" and kind not in random}
