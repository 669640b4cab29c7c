"""Layouts of random trains: pitch circles touch or a notice gives the reason, independent of other declarations."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_layout import touching

from geartrain import GearTrain
from geartrain.scene import lay_out

TEETH = st.integers(8, 90)


@st.composite
def standing_trains(draw: st.DrawFn) -> dict[str, Any]:
    """Draw trains of arbors in the frame, each in mesh with an earlier one; some share the axis of an earlier one."""
    links: dict[str, Any] = {"frame": {}, "a0": {"wheels": {}}}
    revolutes = [{"pair": ["frame", "a0"], "axis": "A0"}]
    gears: list[dict[str, Any]] = []
    axis = {"a0": "A0"}
    for at in range(1, draw(st.integers(1, 7)) + 1):
        mate = draw(st.sampled_from(sorted(axis)))
        free = [label for label in dict.fromkeys(axis.values()) if label != axis[mate]]
        own = draw(st.sampled_from([f"A{at}", f"A{at}", *free]))
        link = f"a{at}"
        links[link] = {"wheels": {f"d{at}": {"teeth": draw(TEETH)}}}
        links[mate]["wheels"][f"m{at}"] = {"teeth": draw(TEETH)}
        revolutes.append({"pair": ["frame", link], "axis": own})
        gears.append({"pair": [f"m{at}", f"d{at}"]})
        axis[link] = own
    return {"links": links, "revolutes": revolutes, "gears": gears, "inputs": {"a0": 1}}


@st.composite
def planetary_trains(draw: st.DrawFn) -> dict[str, Any]:
    """Draw trains of a sun, a ring and up to four planets, stepped or plain, which may not fit into the ring."""
    sun, planet = draw(TEETH), draw(TEETH)
    ring = sun + 2 * planet + draw(st.sampled_from([0, 0, 0, 1, -1]))
    count, stepped = draw(st.integers(1, 4)), draw(st.booleans())
    links: dict[str, Any] = {
        "frame": {"wheels": {"r": {"teeth": ring, "internal": True}}},
        "sun": {"wheels": {"s": sun}},
        "carrier": {},
    }
    revolutes = [{"pair": ["frame", "sun"], "axis": "X"}, {"pair": ["frame", "carrier"], "axis": "X"}]
    gears = []
    for at in range(count):
        links[f"p{at}"] = {"wheels": {f"p{at}": planet, **({f"q{at}": draw(TEETH)} if stepped else {})}}
        revolutes.append({"pair": ["carrier", f"p{at}"], "axis": f"P{at}"})
        gears += [{"pair": ["s", f"p{at}"]}, {"pair": [f"q{at}" if stepped else f"p{at}", "r"]}]
    return {"links": links, "revolutes": revolutes, "gears": gears, "inputs": {"sun": 1}}


@given(st.one_of(standing_trains(), planetary_trains()))
@settings(max_examples=60)
def test_pitch_circles_touch_unless_a_notice_names_the_pair(data: dict[str, Any]) -> None:
    train = GearTrain.declare(data)
    layout = lay_out(train)
    told = " ".join(notice.what for notice in layout.notices)
    for gear in train.declaration.gears:
        first, second = (layout.wheels[wheel] for wheel in gear.pair)
        ring = any(train.declaration.wheels[wheel][1].internal for wheel in gear.pair)
        want = abs(first.radius - second.radius) if ring else first.radius + second.radius
        gap = math.dist(first.centre[:2], second.centre[:2]) - want
        assert first.module == second.module
        for wheel in (first, second):
            teeth = train.declaration.wheels[wheel.wheel][1].count or 0
            assert wheel.radius == pytest.approx(wheel.module * teeth / 2, rel=1e-12)
            assert wheel.centre[:2] == pytest.approx(layout.axes[wheel.axis].point[:2], abs=1e-12)
        if abs(gap) > 1e-9 * (first.radius + second.radius):
            assert f"'{first.wheel}' and '{second.wheel}'" in told
            assert layout.apart[gear.name] == pytest.approx(-gap if ring else gap, rel=1e-6)
        else:
            assert gear.name not in layout.apart
    assert lay_out(GearTrain.declare(data)) == layout


@given(standing_trains())
@settings(max_examples=25)
def test_wheels_that_share_a_height_keep_apart_unless_a_notice_says_that_wheels_collide(data: dict[str, Any]) -> None:
    train = GearTrain.declare(data)
    layout = lay_out(train)
    if any("collide" in notice.what for notice in layout.notices):
        return
    mates = {frozenset(gear.pair) for gear in train.declaration.gears}
    wheels = list(layout.wheels.values())
    for at, first in enumerate(wheels):
        for second in wheels[at + 1 :]:
            apart = abs(first.centre[2] - second.centre[2]) - (first.thickness + second.thickness) / 2
            if apart < -1e-9 and frozenset((first.wheel, second.wheel)) not in mates:
                far = math.dist(first.centre[:2], second.centre[:2])
                assert far > first.radius + second.radius + 0.9 * (first.module + second.module)


@given(standing_trains(), st.randoms(use_true_random=False))
@settings(max_examples=15)
def test_what_is_no_part_of_the_mechanism_changes_nothing(data: dict[str, Any], dice: Any) -> None:
    plain = lay_out(GearTrain.declare(data))
    outputs = list(data["links"])
    dice.shuffle(outputs)
    more = {**data, "title": "x", "outputs": {link: {} for link in outputs}, "sources": {"s": "a book"}}
    assert lay_out(GearTrain.declare(more)) == plain


@given(st.tuples(TEETH, TEETH), st.floats(0.5, 2.6), st.sampled_from([1, -1]), st.sampled_from([1, -1]), st.booleans())
@settings(max_examples=60)
def test_bevel_and_crown_pairs_roll_at_any_shaft_angle(
    teeth: tuple[int, int], angle: float, side: int, other: int, crown: bool
) -> None:
    kinds = ("contrate", "spur") if crown else ("bevel", "bevel")
    way = [repr(round(math.cos(angle), 6)), "0", repr(round(math.sin(angle), 6))]
    train = GearTrain.declare(
        {
            "links": {
                "frame": {},
                "a": {"wheels": {"i": {"teeth": teeth[0], "kind": kinds[0], "facing": side}}},
                "b": {"wheels": {"j": {"teeth": teeth[1], "kind": kinds[1], "facing": other}}},
            },
            "axes": {"A": {"direction": ["1", "0", "0"]}, "B": {"direction": way}},
            "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
            "gears": [{"pair": ["i", "j"]}],
            "inputs": {"a": 1},
        }
    )
    layout = lay_out(train)
    assert not layout.notices
    speeds = train.solve().speeds
    a, b = layout.wheels["i"], layout.wheels["j"]
    u, v = (np.array(layout.axes[label].direction) for label in "AB")
    point, miss, _ = touching(layout, a, b)
    assert miss < 1e-9 * (a.radius + b.radius)
    rolled = float(speeds["a"]) * np.cross(u, point - np.array(a.centre))
    assert rolled == pytest.approx(float(speeds["b"]) * np.cross(v, point - np.array(b.centre)), abs=1e-9 * a.radius)
    assert a.cone + b.cone == pytest.approx(math.acos(max(-1.0, min(1.0, float(side * other * (u @ v))))), abs=1e-9)


@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("worm_first", [True, False])
def test_a_worm_stands_where_its_hand_and_the_equation_agree(hand: str, worm_first: bool) -> None:
    pair = ["w", "g"] if worm_first else ["g", "w"]
    data: dict[str, Any] = {
        "links": {
            "frame": {},
            "screw": {"wheels": {"w": {"teeth": 3, "kind": "worm", "hand": hand}}},
            "wheel": {"wheels": {"g": 40}},
        },
        "axes": {"S": {"direction": ["0", "1", "0"]}},
        "revolutes": [{"pair": ["frame", "screw"], "axis": "S"}, {"pair": ["frame", "wheel"], "axis": "W"}],
        "gears": [{"pair": pair}],
        "inputs": {"screw": 1},
    }
    train = GearTrain.declare(data)
    layout = lay_out(train)
    worm, wheel = layout.wheels["w"], layout.wheels["g"]
    apart = np.array(worm.centre) - np.array(wheel.centre)
    assert np.linalg.norm(apart) == pytest.approx(worm.radius + wheel.radius)
    # with declared positions equal to the chosen ones, the pair has the same sense
    placed = {
        **data,
        "axes": {
            "S": {"direction": ["0", "1", "0"], "position": [f"{part:.6f} mm" for part in apart]},
            "W": {"position": ["0 mm", "0 mm", "0 mm"]},
        },
    }
    assert GearTrain.declare(placed).solve()["wheel"] == train.solve()["wheel"]


def test_a_chain_of_hundreds_of_wheels_is_laid_out() -> None:
    links: dict[str, Any] = {"frame": {}}
    for at in range(200):
        links[f"a{at}"] = {"wheels": {f"p{at}": 12, f"w{at}": 30}}
    data = {
        "links": links,
        "revolutes": [{"pair": ["frame", f"a{at}"], "axis": f"A{at}"} for at in range(200)],
        "gears": [{"pair": [f"w{at}", f"p{at + 1}"]} for at in range(199)],
        "inputs": {"a0": 1},
    }
    layout = lay_out(GearTrain.declare(data))
    assert not layout.apart
    assert len(layout.wheels) == 400


@pytest.mark.parametrize(
    "links",
    [
        {"frame": {}},
        {"frame": {"wheels": {"w": 10}}},
        {"frame": {}, "a": {"wheels": {"w": 10**12}}, "b": {"wheels": {"v": 1}}},
    ],
)
def test_odd_trains_have_a_layout_too(links: dict[str, Any]) -> None:
    moving = [link for link in links if link != "frame"]
    data = {
        "links": links,
        "revolutes": [{"pair": ["frame", link], "axis": link} for link in moving],
        "gears": [{"pair": ["w", "v"]}] if moving else [],
    }
    layout = lay_out(GearTrain.declare(data))
    assert set(layout.wheels) == {wheel for part in links.values() for wheel in part.get("wheels", {})}
    assert all("is not in mesh" in notice.what for notice in layout.notices)
