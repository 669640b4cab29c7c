"""The interval of a mean over one long run holds the mean as often as it says."""

from __future__ import annotations

import numpy as np
import pytest

from geartrain.simulation.time import FEWEST, batch_half_width

STEPS, REPEATS = 50, 400


def batches(seed: int, correlation: float, count: int) -> np.ndarray:
    """Means over batches of a first-order autoregression about 0."""
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((REPEATS, count * STEPS))
    values = np.empty_like(noise)
    values[:, 0] = noise[:, 0] / np.sqrt(1 - correlation**2)
    for at in range(1, values.shape[1]):
        values[:, at] = correlation * values[:, at - 1] + noise[:, at]
    return values.reshape(REPEATS, count, STEPS).mean(axis=2)


# in steps of which a batch has 50: a process forgets within 1, 2 and 10 of them
@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9])
@pytest.mark.parametrize("count", [5, 10, 20])
def test_a_95_percent_interval_covers_the_true_mean_in_95_percent_of_runs(correlation: float, count: int) -> None:
    held = np.mean([abs(run.mean()) <= batch_half_width(run) for run in batches(count, correlation, count)])
    assert 0.92 <= held <= 0.985


def test_of_few_batches_nothing_is_known_and_equal_ones_leave_nothing_open() -> None:
    assert batch_half_width(np.arange(FEWEST - 1.0)) is None
    assert batch_half_width(np.full(FEWEST, 3.0)) == 0


def test_independent_batches_have_the_interval_of_student() -> None:
    # mean 3, s^2 = 2.5, t(4, 0.975) = 2.776445; of this order the lag-1 correlation is below -1/5
    assert batch_half_width(np.array([1.0, 5.0, 2.0, 4.0, 3.0])) == pytest.approx(2.776445 * np.sqrt(2.5 / 5), rel=1e-6)
