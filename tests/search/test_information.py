"""Information in bits, against values by hand."""

from __future__ import annotations

from fractions import Fraction

import pytest

from geartrain.search.weighted_alternatives import entropy, relative_entropy


def test_halving_is_one_bit() -> None:
    assert relative_entropy([1.0, 0.0], [Fraction(1, 2), Fraction(1, 2)]) == 1
    assert relative_entropy([0.5, 0.5], [0.5, 0.5]) == 0
    assert relative_entropy([], []) == 0


@pytest.mark.parametrize(
    ("probabilities", "bits"), [([1.0], 0), ([0.5, 0.5], 1), ([0.25] * 4, 2), ([0.5, 0.25, 0.25], 1.5), ([0.0, 1.0], 0)]
)
def test_what_an_answer_is_expected_to_tell(probabilities: list[float], bits: float) -> None:
    assert entropy(probabilities) == bits
