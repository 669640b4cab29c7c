"""Sobol indices from two independent samples: closed forms, scipy's estimators, and coverage of the intervals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import scipy.stats
from numpy.typing import NDArray

from geartrain.workshop.monte_carlo.sobol_indices import saltelli_indices

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


def ishigami_indices() -> tuple[Floats, Floats]:
    """First-order and total indices in closed form."""
    a, b = 7.0, 0.1
    own, second = (1 + b * np.pi**4 / 5) ** 2 / 2, a**2 / 8
    joint = b**2 * np.pi**8 * (1 / 18 - 1 / 50)
    return np.array([own, second, 0.0]) / (whole := own + second + joint), np.array(
        [own + joint, second, joint]
    ) / whole


def linear(x: Floats) -> Floats:
    """A sum without interactions, 5 off centre: the variances of its parts are as 1 to 4 to 9."""
    return np.asarray(x @ [1.0, 2.0, 3.0] + 5)


def test_the_indices_of_ishigamis_function_are_those_of_the_closed_form() -> None:
    found = saltelli_indices(sampled(ishigami, 3, 1 << 15, seed=1), seed=1)
    first, total = ishigami_indices()
    assert [each.value for each, _ in found] == pytest.approx(first, abs=0.02)
    assert [each.value for _, each in found] == pytest.approx(total, abs=0.02)


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
        found = saltelli_indices(sampled(linear, 3, 256, seed), seed)
        held += [
            [each.low <= value <= each.high for each, value in zip(column, true, strict=True)]
            for column in zip(*found, strict=True)
        ]
    assert ((held / 200 > 0.9) & (held / 200 < 0.99)).all()


def test_the_same_seed_gives_the_same_intervals_and_a_constant_has_no_indices() -> None:
    values = sampled(linear, 3, 100, seed=3)
    assert saltelli_indices(values, seed=5) == saltelli_indices(values, seed=5)
    assert saltelli_indices(values, seed=5) != saltelli_indices(values, seed=6)
    assert {
        (each.value, each.low, each.high) for pair in saltelli_indices(np.ones((9, 4)), seed=1) for each in pair
    } == {(0.0, 0.0, 0.0)}
