"""Callouts beside a plan: one line to all wheels of an axis, and no crossing lines."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shipped import train as load

pytest.importorskip("matplotlib")

from geartrain.drawing import picture
from geartrain.drawing.arrangement import Callout, find_margin

EDGES, BOUNDS = (-0.3, 6.3), (0.0, 6.0)
SPOT = st.tuples(*2 * [st.integers(0, 600).map(lambda hundredth: hundredth / 100)])
Point = tuple[Fraction, Fraction]


def cross(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    """Return True if two segments intersect, exactly."""

    def turn(a: Point, b: Point, c: Point) -> Fraction:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = one, other
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def lines(margin: Any) -> list[tuple[Point, Point]]:
    sides = zip((margin.left, margin.right), margin.edges, strict=True)
    ends = [((edge, y), each.anchor) for side, edge in sides for each, y in side]
    return [((Fraction(a), Fraction(b)), (Fraction(c), Fraction(d))) for (a, b), (c, d) in ends]


@settings(max_examples=40)
@given(
    st.lists(st.tuples(SPOT, st.sampled_from([1, 1, 2, 5])), min_size=9, max_size=20, unique_by=lambda each: each[0])
)
def test_no_line_crosses_another_and_no_list_stands_over_another(drawn: list[tuple[tuple[float, float], int]]) -> None:
    margin = find_margin([Callout([("", "word")] * count, spot) for spot, count in drawn], EDGES, BOUNDS)
    assert not any(cross(one, other) for one, other in combinations(lines(margin), 2))
    for side in (margin.left, margin.right):
        for (one, y), (other, v) in combinations(side, 2):
            assert abs(y - v) >= (one.height + other.height) / 2 - 1e-9


@pytest.mark.parametrize("name", ["huygens-planetarium-1682", "price-1974", "simpson-set"])
def test_no_line_passes_behind_the_name_on_a_wheel(name: str) -> None:
    figure = picture(load(name), "plan")
    figure.draw_without_rendering()
    axes = figure.axes[0]
    thin = [line for line in axes.lines if line.get_linewidth() == 0.6]
    ends = [axes.transData.transform(np.column_stack(line.get_data())) for line in thin]
    traced = np.concatenate([one + np.linspace(0, 1, 500)[:, None] * (other - one) for one, other in ends])
    names = [words for words in axes.texts if (words.get_gid() or "").startswith("name ") and "\n" in words.get_text()]
    assert names
    for words in names:
        box = words.get_window_extent()
        hit = ((traced > box.min) & (traced < box.max)).all(1).any()
        assert not hit, words.get_text()
