"""Remainders and blocks of long arrays, against exact arithmetic."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from geartrain.numerics.arrays import blocks, remainder


@pytest.mark.parametrize("period", [2 * np.pi / 48, 1.0, 0.1, 3e-5])
@pytest.mark.parametrize("periods", [3, 1e4, 1e8])
def test_a_remainder_agrees_with_fractions_to_rounding(period: float, periods: float) -> None:
    values = np.random.default_rng(1).uniform(-periods, periods, 500) * period
    for value, found in zip(values.tolist(), remainder(values, period).tolist(), strict=True):
        off = (Fraction(found) - Fraction(value)) / Fraction(period)
        assert abs(off - round(off)) < 4e-16, "whole periods apart"
        assert -1e-8 < found / period < 1 + 1e-8


@pytest.mark.parametrize("count", [0, 1, 16384, 16385, 100_000])
def test_blocks_cover_every_value_once(count: int) -> None:
    taken = np.zeros(count, int)
    for block in blocks(count):
        taken[block] += 1
    assert (taken == 1).all()
