"""Sobol indices of a pointer error by wheel or by kind of error: Monte Carlo estimates from two independent samples.

All teeth of a wheel are one input variable, and so is the position of the train's input. A and B are independent
samples, and AB(i) is A with input i taken from B. The pointer error f has the variance V. Saltelli et al. (2010, table
2, rows b and f) estimate its variance shares as

    first order   S_i = mean(f(B) (f(AB(i)) - f(A))) / V        total   T_i = mean((f(A) - f(AB(i)))^2) / 2 V

`scipy.stats.sobol_indices` has the same estimators, but requires a number of samples that is a power of 2, and its
bootstrap does not accept a seed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.confidence_intervals import DEVIATIONS, IntervalEstimate
from geartrain.numerics.results import Key, Result
from geartrain.numerics.work import Execution
from geartrain.workshop.cutting.declared_errors import ERROR_KINDS
from geartrain.workshop.monte_carlo.trial_block import (
    BLOCK,
    EVERY,
    NUMBER,
    TOWARDS,
    RandomStreams,
    Streams,
    draw_trial_wheels,
    input_positions,
    trial_pointers,
)
from geartrain.workshop.monte_carlo.trial_run import check_trials, trial_tasks

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.workshop.monte_carlo.trial_plan import TrialPlan


By = Literal["wheel", "kind"]
_STREAMS = 1 << 21  # offset of the block numbers, so that the streams differ from those of trials and courses
_RESAMPLES = 200  # bootstrap samples: the standard error they give is exact to about 5 %


@dataclass(frozen=True, slots=True)
class SobolIndex(Result):
    """First-order and total Sobol index of one input variable, with 95 % bootstrap confidence intervals."""

    KEYS = (Key("of", "name"), "first", "total")

    name: str
    """Name of the input variable: a wheel, pair or kind of error, or "position"."""
    first: IntervalEstimate
    """First-order index with its 95 % confidence interval."""
    total: IntervalEstimate
    """Total index with its 95 % confidence interval."""


@dataclass(frozen=True, slots=True)
class SobolIndices(Result):
    """Sobol sensitivity indices of the pointer error of one output, by wheel or by kind of manufacturing error.

    See Also
    --------
    find_sobol_indices : Compute Sobol indices.
    """

    output: str
    """Name of the output."""
    by: By
    """Input variables: "wheel" for all errors of one wheel, "kind" for one kind of error of all wheels."""
    trials: int
    """Number of base samples in which the pointer error is finite."""
    indices: tuple[SobolIndex, ...]
    """Indices of all input variables in descending order of the total index; "position" is the position of the train's
    input.
    """


def find_sobol_indices(
    plan: TrialPlan,
    output: int,
    by: By = "wheel",
    trials: int = 1024,
    seed: int = 1,
    means: Execution | None = None,
) -> SobolIndices:
    """Estimate the Sobol indices of an output's pointer error at random positions of the input, by Saltelli's scheme.

    If a pair jams, the position of the output is determined by the drive flanks.

    Parameters
    ----------
    plan : TrialPlan
        Train with its cutting and fitting errors.
    output : int
        Index of the output in `plan.outputs`, from 0.
    by : {"wheel", "kind"}
        Grouping of errors into input variables: all errors of one wheel, or one kind of error of all wheels.
    trials : int
        Number of base samples, 1 to 10^9. Each base sample requires two trials, and one further trial for each input
        variable.
    seed : int
        Random seed.
    means : Execution, optional
        Executor and progress function; by default this process without a progress function. The journal is not used.

    Returns
    -------
    SobolIndices
        Indices in descending order of the total index.

    Raises
    ------
    QuestionError
        If the output does not depend on a wheel with errors.

    References
    ----------
    Saltelli, A. et al. 2010. Variance based sensitivity analysis of model output. Comput. Phys. Commun. 181, table 2.

    Examples
    --------
    >>> from geartrain import load
    >>> from geartrain.workshop import (find_trial_plan, read_error_overrides)
    >>> plan = find_trial_plan(load("moon-triangular"), read_error_overrides(["pitch_deviation=1 %"]), ["sun"])
    >>> sorted(index.name for index in find_sobol_indices(plan, 0, trials=16).indices)
    ['a', 'b1', 'position']
    """
    check_trials(trials)
    means, names = means or Execution(), [name for name, _ in error_groups(plan, output, by)]
    if len(names) < 2:
        what = f"no wheel or pair with errors moves '{plan.outputs[output]}'"
        why = "Sobol indices are shares of a variance, and manufacturing errors do not vary this output"
        raise QuestionError(Problem(what, why, "name another output: --of NAME"))
    rows: list[Any] = []
    # no journal: its tasks are identified by block and trials, and would be confused with those of the trials
    for part in replace(means, journal=None).run(partial(work_samples, plan, seed, output, by), trial_tasks(trials)):
        rows += part
    values = np.array(rows, dtype=float)
    # outputs are infinite in trials in which no teeth touch
    values = values[np.isfinite(values).all(axis=1)]
    indices = [SobolIndex(name, *both) for name, both in zip(names, saltelli_indices(values, seed), strict=True)]
    ordered = tuple(sorted(indices, key=lambda each: -each.total.value))
    return SobolIndices(plan.outputs[output], by, len(values), ordered)


def saltelli_indices(values: Floats, seed: int) -> list[tuple[IntervalEstimate, IntervalEstimate]]:
    """Return the first-order and total index of each input variable with bootstrap intervals.

    values   columns f(A), f(AB(1)), ..., f(AB(d)), f(B) of a model f with d variables, (samples, d + 2); A and B are
             independent samples of all variables, and AB(i) is A with variable i from B
    seed     seed of the bootstrap resamples
    """
    values = values - values.mean()  # centred values reduce the variance of the estimate of S_i
    rng, n = np.random.default_rng(seed), len(values)
    estimates = _saltelli(values)
    resampled = np.array([_saltelli(values[rng.integers(n, size=n)]) for _ in range(_RESAMPLES)])
    halves = DEVIATIONS * resampled.std(axis=0, ddof=1)
    first, total = (
        [IntervalEstimate(value, value - half, value + half) for value, half in zip(*row, strict=True)]
        for row in zip(estimates.tolist(), halves.tolist(), strict=True)
    )
    return list(zip(first, total, strict=True))


def _saltelli(values: Floats) -> Floats:
    """Return first-order and total indices, (2, d), from values as in `saltelli_indices`; 0 for constant values."""
    a, b, mixed = values[:, :1], values[:, -1:], values[:, 1:-1]
    # A and B have the same distribution, so their pooled variance is the better estimate
    variance = np.var(values[:, [0, -1]])
    if not variance:
        return np.zeros((2, mixed.shape[1]))
    indices: Floats = np.stack([np.mean(b * (mixed - a), axis=0), np.mean((a - mixed) ** 2, axis=0) / 2]) / variance
    return indices


def error_groups(plan: TrialPlan, output: int, by: By) -> list[tuple[str, Streams]]:
    """Return the input variables that can affect the output with the index `output`.

    Each has a name, and the numbers of the items and kinds of error whose random streams belong to it.
    """
    pairs = plan.reach[output]
    wheels = sorted({wheel for at in pairs for wheel in (plan.pairs[at].first, plan.pairs[at].second)})
    off = [at for at in wheels if not plan.wheels[at].true]
    fits = [at for at in pairs if plan.pairs[at].fitting]
    found: list[tuple[str, Streams]] = []
    if by == "wheel":
        found += [(plan.wheels[at].name, ((at,), EVERY)) for at in off]
        found += [(plan.pairs[at].name, ((len(plan.wheels) + at,), EVERY)) for at in fits]
    else:
        errors = [plan.wheels[at].errors for at in off] + [plan.pairs[at].fitting for at in fits]
        for kind in (each for each in ERROR_KINDS if any(each in own for own in errors)):
            # the direction of an eccentricity belongs to the same input variable as its size
            also = (TOWARDS,) if kind == "eccentricity" else ()
            found.append((kind, (EVERY, (NUMBER[kind], *also))))
    return [*found, ("position", ((plan.position,), EVERY))]


def work_samples(plan: TrialPlan, seed: int, output: int, by: By, task: Sequence[int]) -> list[list[float]]:
    """Return rows of the array of `saltelli_indices` for an output's error [rad]; `task`: first row, number of rows."""
    first, trials = task
    samples: list[Streams] = [((), ()), *(streams for _, streams in error_groups(plan, output, by)), (EVERY, EVERY)]
    columns = []
    for second in samples:
        streams = RandomStreams(seed, _STREAMS + first // BLOCK, second)
        drawn = draw_trial_wheels(plan, streams, trials, first % BLOCK)
        pointers = trial_pointers(drawn, np.arange(trials), (output,))
        columns.append(pointers.errors(input_positions(drawn))[0])
    found: list[list[float]] = np.stack(columns, axis=1).tolist()
    return found
