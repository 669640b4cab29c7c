"""Extremes of piecewise polynomials, also where a slope vanishes at a sample."""

from __future__ import annotations

import numpy as np
import pytest

from geartrain.numerics.polynomial_pieces import extremes


def test_an_extreme_at_a_sample_is_found() -> None:
    """1 - u^2 has its maximum in the middle, which is a sample of the search."""
    assert extremes(np.array([[1.0], [0.0], [-1.0]])) == (0.0, 1.0)


@pytest.mark.parametrize("at", [0.1234567, -0.9, 0.5, 1 / 256])
def test_extremes_are_exact_to_rounding(at: float) -> None:
    """A quartic with the double stationary point of (u - at)^2 (u - 2)^2 at the value 0."""
    quadratic = np.polynomial.polynomial.polyfromroots([at, 2.0])
    column = np.polynomial.polynomial.polymul(quadratic, quadratic)[:, None]
    assert extremes(column)[0] == pytest.approx(0, abs=1e-15)
