"""Lines of points: what is left out of one is near the chords of what is kept."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from geartrain.numerics.polylines import simplified


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("tolerance", [0.0, 0.03, 0.3, 3.0])
def test_what_is_left_out_is_near_the_lines_of_what_is_kept(seed: int, tolerance: float) -> None:
    points = np.random.default_rng(seed).normal(size=(200, 2)).cumsum(axis=0)
    kept = simplified(points, tolerance)
    assert (kept[0], kept[-1]) == (0, 199)
    for first, last in pairwise(kept):
        chord = complex(*(points[last] - points[first]))
        for point in points[first + 1 : last]:
            aside = (complex(*(point - points[first])) / (chord / abs(chord))).imag
            assert abs(aside) <= tolerance * (1 + 1e-12)
    assert (len(kept) == 200) == (tolerance == 0.0)


def test_a_closed_line_keeps_what_is_far_from_its_one_end() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
    assert simplified(square, 0.1) == [0, 1, 2, 3, 4]
    assert simplified(square, 2.0) == [0, 4]
