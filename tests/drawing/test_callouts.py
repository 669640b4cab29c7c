"""Words beside a plan: one line to all wheels of an axis, and no line over another."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shipped import train as load

pytest.importorskip("matplotlib")

from geartrain.drawing import picture
from geartrain.drawing.arrangement import Callout, CalloutMargin, find_margin
from geartrain.drawing.plan_view import PlanNames
from geartrain.drawing.projection import project_scene
from geartrain.scene import make_scene

EDGES, BOUNDS = (-0.3, 6.3), (0.0, 6.0)
SPOT = st.tuples(*2 * [st.integers(0, 600).map(lambda hundredth: hundredth / 100)])
Point = tuple[Fraction, Fraction]


def cross(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    """True where two stretches cross, exactly."""

    def turn(a: Point, b: Point, c: Point) -> Fraction:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = one, other
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def lines(margin: CalloutMargin) -> list[tuple[Point, Point]]:
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


def test_all_wheels_of_an_axis_share_a_line_and_stand_from_inside_out() -> None:
    scene = make_scene(load("freeth-2021"))
    standing = project_scene(scene, Fraction(0))
    facing = [wheel for wheel in scene.wheels if standing.faces(wheel)]
    written, callouts = PlanNames.of(standing, facing, lambda seen: 0.07 * seen[..., :2], 0.07).place()
    wheels = {f"name {wheel.id}": wheel for wheel in facing}
    told = [key for each in callouts for key, _ in each.words] + [f"name {wheel.id}" for wheel, _ in written]
    assert sorted(told) == sorted(wheels)
    places = [tuple(round(part, 3) for part in wheels[each.words[0][0]].centre[:2]) for each in callouts]
    assert len(set(places)) == len(places) < len(told) / 2
    for each, place in zip(callouts, places, strict=True):
        radii = [wheels[key].radius for key, _ in each.words]
        assert radii == sorted(radii)
        if len(radii) > 1:
            assert each.anchor == pytest.approx((0.07 * scene.front * place[0], 0.07 * place[1]), abs=1e-4)


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
