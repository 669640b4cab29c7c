"""How often 95 % intervals of trials cover the truth, which closed formulas give."""

from __future__ import annotations

from collections.abc import Callable
from math import comb, exp, sqrt
from statistics import NormalDist

import numpy as np
import pytest
import scipy.stats
from numpy.typing import NDArray

from geartrain.numerics.confidence_intervals import PERCENTILES, deviation_of, mean_of, percentile_of, wilson
from geartrain.workshop.monte_carlo.sobol_indices import saltelli_indices

TRIALS = 256
NORMAL = NormalDist()


def binomial(n: int, p: float) -> np.ndarray:
    """Probabilities of 0 to n successes."""
    return np.array([comb(n, k) * p**k * (1 - p) ** (n - k) for k in range(n + 1)])


@pytest.mark.parametrize("p", [0.05, 0.3, 0.7])
def test_wilsons_interval_covers_each_probability_as_often_as_it_says(p: float) -> None:
    ends = (wilson(count, TRIALS) for count in range(TRIALS + 1))
    held = [low <= p <= high for low, high in ends]
    assert 0.94 < binomial(TRIALS, p)[held].sum() < 0.96


@pytest.mark.parametrize(("count", "of"), [(3, 40), (0, 25), (17, 17), (500, 1000)])
def test_wilsons_interval_ends_where_the_deviation_is_z(count: int, of: int) -> None:
    low, high = wilson(count, of)
    z = 1.959963984540054
    for p in (low, high):
        if 0 < p < 1:
            assert (count / of - p) ** 2 == pytest.approx(z**2 * p * (1 - p) / of, rel=1e-9)
    assert low <= count / of <= high


@pytest.mark.parametrize("percent", PERCENTILES)
@pytest.mark.parametrize("n", [30, 100, 256, 1000])
def test_the_interval_of_a_percentile_covers_it_in_95_percent_and_hardly_more(n: int, percent: float) -> None:
    """Its ends are values k and m in order: k or more, and less than m, values lie below the percentile."""
    found = percentile_of(np.arange(1, n + 1, dtype=float), percent)
    counts = np.arange(n + 1)
    chance = binomial(n, percent / 100)[(found.low <= counts) & (counts < found.high)].sum()
    assert 0.95 <= chance < 0.97


def test_the_interval_of_a_percentile_is_open_where_too_few_values_are_beyond_it() -> None:
    few = percentile_of(np.arange(20.0), 2.5)  # all 20 values exceed it in 0.975^20 = 60 % of all cases
    assert few.low == float("-inf")
    assert few.to_dict() == [few.value, None, few.high]
    assert few.high < 5
    many = percentile_of(np.arange(10**6, dtype=float), 50)
    half = NORMAL.inv_cdf(0.975) * 1000 / 2
    assert (many.low, many.high) == pytest.approx((5e5 - half, 5e5 + half), abs=1.5)


def test_the_interval_of_a_mean_is_normal_and_that_of_a_deviation_is_bonetts() -> None:
    """The example of his paper's formula by hand: 1, 2, 3, 4, 10."""
    values = np.array([1.0, 2.0, 3.0, 4.0, 10.0])
    z = NORMAL.inv_cdf(0.975)
    # the mean is 4, and the mean trimmed by 1 / (2 sqrt(n - 4)) = 1/2 at each end is the median
    kurtosis = 5 * (2**4 + 1 + 0 + 1 + 7**4) / (9 + 4 + 1 + 0 + 36) ** 2
    c = 5 / (5 - z)
    error = c * sqrt((kurtosis - 2 / 5) / 4)
    mean, found = mean_of(values), deviation_of(values)
    half = z * sqrt(50 / 4 / 5)
    assert (mean.low, mean.value, mean.high) == pytest.approx((4 - half, 4, 4 + half))
    assert found.value == pytest.approx(sqrt(50 / 4))
    ends = [sqrt(c * 50 / 4 * exp(sign * z * error)) for sign in (-1, 1)]
    assert (found.low, found.high) == pytest.approx(ends)
    equal = np.full(12, 0.1)
    assert equal.std() > 0, "their mean is rounded"
    assert deviation_of(equal).value == 0


# --------------------------------------------------------------------------- sobol indices from two independent samples


Floats = NDArray[np.float64]


def sampled(model: Callable[[Floats], Floats], inputs: int, n: int, seed: int) -> Floats:
    """The model at A, at A with one input after the other from B, and at B, of inputs uniform from -1 to 1."""
    first, second = np.random.default_rng(seed).uniform(-1.0, 1.0, (2, n, inputs))
    mixed = [np.where(np.arange(inputs) == at, second, first) for at in range(inputs)]
    return np.stack([model(x) for x in (first, *mixed, second)], axis=1)


def ishigami(x: Floats) -> Floats:
    """Ishigami and Homma 1990 with a = 7, b = 0.1."""
    x = np.pi * x
    return np.asarray(np.sin(x[:, 0]) * (1 + 0.1 * x[:, 2] ** 4) + 7 * np.sin(x[:, 1]) ** 2)


def linear(x: Floats) -> Floats:
    """A sum without interactions, 5 off centre: the variances of its parts are as 1 to 4 to 9."""
    return np.asarray(x @ [1.0, 2.0, 3.0] + 5)


@pytest.mark.parametrize("model", [ishigami, linear])
def test_the_estimates_are_those_of_scipy(model: Callable[[Floats], Floats]) -> None:
    values = sampled(model, 3, 512, seed=2)
    ours = saltelli_indices(values, seed=1)
    outputs = {"f_A": values[None, :, 0], "f_B": values[None, :, -1], "f_AB": values[:, 1:-1].T[:, None]}
    theirs = scipy.stats.sobol_indices(func=outputs, n=512)
    # scipy centres by the mean of A and B, which scatters first-order estimates otherwise
    assert [each.value for each, _ in ours] == pytest.approx(theirs.first_order, abs=0.02)
    assert [each.value for _, each in ours] == pytest.approx(theirs.total_order, rel=1e-12)


def test_intervals_of_a_linear_model_hold_as_often_as_they_say() -> None:
    """First order and total are 1/14, 4/14 and 9/14; over 200 samples each interval contains its own."""
    true = np.array([1.0, 4.0, 9.0]) / 14
    held = np.zeros((2, 3))
    for seed in range(200):
        columns = zip(*saltelli_indices(sampled(linear, 3, 256, seed), seed), strict=True)
        held += [[each.low <= value <= each.high for each, value in zip(own, true, strict=True)] for own in columns]
    assert ((held / 200 > 0.9) & (held / 200 < 0.99)).all()


def test_the_same_seed_gives_the_same_intervals_and_a_constant_has_no_indices() -> None:
    values = sampled(linear, 3, 100, seed=3)
    assert saltelli_indices(values, seed=5) == saltelli_indices(values, seed=5)
    assert saltelli_indices(values, seed=5) != saltelli_indices(values, seed=6)
    constant = [each for pair in saltelli_indices(np.ones((9, 4)), seed=1) for each in pair]
    assert {(each.value, each.low, each.high) for each in constant} == {(0.0, 0.0, 0.0)}
