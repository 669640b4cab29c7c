"""Belts, and pairs and planetary sets of which only the ratio is known: speeds, torques, loops, and what is refused.

Speeds of belts are those of pulleys that roll on an inextensible cord; those of sets follow from Willis' equation.
"""

from __future__ import annotations

from fractions import Fraction
from math import cos, hypot, pi, sin
from pathlib import Path
from typing import Any

import pytest
from commands import call
from models import torque_figures

from geartrain import GearTrainError, load
from geartrain.teeth.couplings.belt import belt_length

F = Fraction
TWO = """
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {q: 30}}}
revolutes: {A: [frame, a], B: [frame, b]}
inputs: {a: 1}
"""
SET = """
links: {frame: {}, sun: {}, ring: {}, arm: {}}
revolutes: {main: [frame, sun, ring, arm]}
couplings: [{id: set, pair: [sun, ring], carrier: arm, ratio: -75/50, efficiency: 96 %}]
inputs: {sun: 1}
"""
SERPENTINE = """
links: {frame: {}, crank: {}, alternator: {}, pump: {}, idler: {}}
revolutes: {A: [frame, crank], B: [frame, alternator], C: [frame, pump], D: [frame, idler]}
couplings:
  - kind: belt
    around: {crank: 140 mm, alternator: 5.6 cm, pump: 120 mm, idler: 70 mm}
    reversed: [pump]
    efficiency: 97 %
inputs: {crank: 1}
"""
LOADED = """
links: {frame: {}, a: {}, b: {}}
axes: {A: {position: [0 mm, 0 mm, 0 mm]}, B: {position: [0 mm, 20 cm, 5 mm]}}
revolutes: {A: [frame, a], B: [frame, b]}
couplings: [{kind: belt, around: {a: 50 mm, b: 75 mm}, efficiency: 98 %}]
inputs: {a: 1}
loads: {b: -3 N m}
"""


def speeds(text: str, state: str | None = None) -> dict[str, Any]:
    return dict(load(text).solve(state).speeds)


def section(text: str, title: str) -> str:
    page = load(text).report()
    shown = [each for each in page.sections if each.title == title]
    return str(shown[0].tables[0].rows)


def test_b1_a_toothed_belt_turns_both_pulleys_the_same_way() -> None:
    assert speeds(TWO + "belts: [p ~ q]")["b"] == F(2, 3)


def test_b2_a_crossed_belt_turns_them_in_opposite_senses() -> None:
    crossed = "couplings: [{kind: belt, around: {a: 100 mm, b: 75 mm}, reversed: [b]}]"
    assert speeds(TWO + crossed)["b"] == F(-4, 3)


def test_b3_a_serpentine_belt_turns_all_pulleys_by_their_diameters() -> None:
    found = speeds(SERPENTINE)
    assert (found["alternator"], found["pump"], found["idler"]) == (F(5, 2), F(-7, 6), 2)
    assert [circuit.id for circuit in load(SERPENTINE).circuits] == ["crank~alternator", "crank~pump", "crank~idler"]


def test_b4_equal_angles_of_two_carried_belts_keep_the_direction_of_the_last_pulley() -> None:
    text = """
    links:
      frame: {wheels: {z: 40}}
      arm: {}
      p: {wheels: {p1: 20, p2: 20}}
      q: {wheels: {q1: 40}}
    revolutes: {main: [frame, arm], P: [arm, p], Q: [arm, q]}
    belts: [z ~ p1, p2 ~ q1]
    inputs: {arm: 1}
    """
    found = speeds(text)
    assert (found["p"], found["q"]) == (-1, 0)


def test_b5_two_belts_of_nearly_equal_ratio_into_a_differential() -> None:
    text = """
    links:
      frame: {}
      in: {wheels: {i1: 30, i2: 31}}
      A: {wheels: {a: 31, ga: {teeth: 20, kind: bevel}}}
      B: {wheels: {b: 32, gb: {teeth: 20, kind: bevel, facing: -1}}}
      out: {}
      planet: {wheels: {p: {teeth: 20, kind: bevel}}}
    axes: {P: {direction: [1, 0, 0]}}
    revolutes: {I: [frame, in], main: [frame, A, B, out], P: [out, planet]}
    gears: [ga ~ p, p ~ gb]
    belts: [i1 ~ a]
    couplings: [{kind: belt, around: [i2, b], reversed: [b]}]
    inputs: {in: 1}
    """
    assert speeds(text)["out"] == F(-1, 1984) == (F(30, 31) - F(31, 32)) / 2


def test_b6_load_efficiency_and_pull_of_a_belt() -> None:
    train = load(LOADED)
    torques = train.torques()
    assert torques.external["a"] == F(3) * F(2, 3) / F(98, 100)
    assert float(torques.external["a"]) == pytest.approx(2.0408163, abs=5e-8)
    figures = torque_figures(train)
    # 3 N m on a radius of 37.5 mm
    assert figures.to_dict()["belt_pulls"] == {"a~b": pytest.approx(80)}
    assert "597.131045 mm" in section(LOADED, "Couplings")
    assert "616.044608 mm, crossed" in section(LOADED.replace("75 mm}", "75 mm}, reversed: [b]"), "Couplings")


def hull_length(r: float, R: float, distance: float) -> float:
    """Return the perimeter of the convex hull of two circles, the integral of its support function (Cauchy)."""
    steps = 400_000
    angles = (2 * pi * at / steps for at in range(steps))
    return sum(max(r, R + distance * cos(angle)) for angle in angles) * 2 * pi / steps


def crossed_length(r: float, R: float, distance: float) -> float:
    """Return the length of a crossed belt from its tangent points, found by bisection of the tangency condition."""

    def lean(angle: float) -> tuple[float, float]:
        along = distance - (r + R) * cos(angle), -(r + R) * sin(angle)
        return along[0] * cos(angle) + along[1] * sin(angle), hypot(*along)

    low, high = 0.0, pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if lean(middle)[0] > 0 else (low, middle)
    return 2 * lean(low)[1] + 2 * (pi - low) * (r + R)


def test_b6_belt_lengths_follow_from_the_convex_hull_and_from_tangent_points() -> None:
    assert belt_length((50.0, 75.0), 200.0) == pytest.approx(597.13104546, abs=5e-9)
    assert belt_length((50.0, 75.0), 200.0, crossed=True) == pytest.approx(616.04460768, abs=5e-9)
    assert belt_length((50.0, 75.0), 200.0) == pytest.approx(hull_length(25.0, 37.5, 200.0), abs=1e-6)
    assert belt_length((50.0, 75.0), 200.0, crossed=True) == pytest.approx(crossed_length(25.0, 37.5, 200.0))


def test_a_belt_is_equal_in_its_long_form_and_under_a_parents_rules(tmp_path: Path) -> None:
    long, short = load(TWO + "couplings: [{kind: belt, around: [p, q]}]"), load(TWO + "belts: [p ~ q]")
    assert long.declaration.couplings == short.declaration.couplings
    (tmp_path / "short.yaml").write_text(TWO + "belts: [p ~ q]\n")
    child = "extends: short.yaml\nremove: {couplings: [p~q]}\ncouplings: [{kind: belt, around: [q, p]}]\n"
    (tmp_path / "child.yaml").write_text(child)
    assert [circuit.id for circuit in load(tmp_path / "child.yaml").circuits] == ["q~p"]
    slower = "extends: short.yaml\ncouplings: [{id: p~q, reversed: [q]}]\n"
    (tmp_path / "slower.yaml").write_text(slower)
    assert load(tmp_path / "slower.yaml").solve()["b"] == F(-2, 3)
    removed = "extends: short.yaml\nremove: {links: [b]}\n"
    (tmp_path / "removed.yaml").write_text(removed)
    assert not load(tmp_path / "removed.yaml").circuits


def test_one_tooth_more_on_a_wheel_of_a_belt_changes_the_speed() -> None:
    train = load(TWO.replace("p: 20", "p: {teeth: {value: 20, range: [20, 21]}}") + "belts: [p ~ q]\noutputs: {b: {}}")
    assert train.with_teeth({"p": 21}).solve()["b"] == F(21, 30)
    (found,) = train.kinematics.sensitivity(train.solve())
    assert found.more == pytest.approx(1e6 / 20)
    assert train.formula("b").text == "b = z_p/z_q · a"


def test_the_speeds_of_belts_are_those_of_pulleys_that_roll_on_the_cord() -> None:
    # two pulleys on a turning arm: the cord passes each pulley at one speed relative to the arm
    text = """
    links: {frame: {}, arm: {}, a: {}, b: {}, c: {}}
    revolutes: {main: [frame, arm], A: [arm, a], B: [arm, b], C: [arm, c]}
    couplings: [{kind: belt, around: {a: 3, b: 2, c: 7}, reversed: [c]}]
    inputs: {arm: 5, a: 11}
    """
    found = speeds(text)
    cord = 3 * (found["a"] - 5)
    assert 2 * (found["b"] - 5) == cord
    assert -7 * (found["c"] - 5) == cord


def test_r1_a_reducer_by_its_ratio() -> None:
    text = """
    links: {frame: {}, m: {}, o: {}}
    revolutes: {main: [frame, m, o]}
    couplings: [{pair: [m, o], ratio: RATIO}]
    inputs: {m: 1}
    """
    assert [speeds(text.replace("RATIO", ratio))["o"] for ratio in ("127/2", "63.5")] == [F(2, 127)] * 2


@pytest.mark.parametrize(
    "joints", ["{H: [frame, h], M: [h, a, b]}", "{H: [frame, h], A: [h, a], B: [h, b]}", "{H: [frame, h, a, b]}"]
)
def test_r2_a_reducer_in_a_turning_housing(joints: str) -> None:
    carrier = ", carrier: h" if "h, a, b" in joints and "M" not in joints else ""
    text = f"""
    links: {{frame: {{}}, h: {{}}, a: {{}}, b: {{}}}}
    revolutes: {joints}
    couplings: [{{kind: ratio, pair: [a, b], ratio: 5{carrier}}}]
    inputs: {{h: 1, a: 11}}
    """
    assert speeds(text)["b"] == 3


def test_r3_a_set_by_its_basic_ratio_with_the_ring_held_and_with_a_closed_clutch() -> None:
    assert speeds(SET + "fixed: [ring]")["arm"] == F(2, 5)
    assert speeds(SET + "locks: [[sun, ring]]")["arm"] == 1


def test_r4_a_set_on_a_moving_arm() -> None:
    text = """
    links: {frame: {}, arm: {}, sun: {}, ring: {}, c: {}}
    revolutes: {main: [frame, arm], set: [arm, sun, ring, c]}
    couplings: [{kind: ratio, pair: [sun, ring], carrier: c, ratio: -3/2}]
    locks: [[arm, ring]]
    inputs: {arm: 10, sun: 13}
    """
    assert speeds(text)["c"] == F(56, 5)


RATIO_LOOP = """
links: {frame: {}, a: {}, b: {}, c: {}}
revolutes: {A: [frame, a], B: [frame, b], C: [frame, c]}
couplings:
  - {pair: [a, b], ratio: 3/2}
  - {pair: [b, c], ratio: -4/3}
  - {pair: [c, a], ratio: -1/2}
inputs: {a: 1}
"""


def test_r5_a_loop_of_ratios_is_redundant_or_locked_and_named() -> None:
    train = load(RATIO_LOOP)
    assert (train.mobility.by_rank, train.mobility.redundant) == (1, 1)
    (loop,) = train.mobility.loops
    assert (sorted(loop.pairs), loop.product) == (["a~b", "b~c", "c~a"], 1)
    locked = load(RATIO_LOOP.replace("-1/2", "-1/3"))
    assert (locked.mobility.by_rank, locked.solve().verdict.kind) == (0, "locked")
    assert "loop" in locked.solve().verdict.text
    assert all(name in locked.solve().verdict.text for name in ("a~b", "b~c", "c~a"))


def test_r6_torques_and_efficiency_of_a_set_by_its_basic_ratio() -> None:
    train = load(SET + "fixed: [ring]\nloads: {sun: 1}\nsolve_for: arm\noutputs: {arm: {}}")
    torques = train.torques()
    assert (torques.external["ring"], torques.external["arm"]) == (F("1.44"), F("-2.44"))
    assert torques.efficiency == F("0.976")


@pytest.mark.parametrize("way", [1, -1])
def test_the_ratio_is_that_of_the_speeds_about_declared_axes(way: int) -> None:
    text = f"""
    links: {{frame: {{}}, a: {{}}, b: {{}}}}
    axes: {{B: {{direction: [0, 0, {way}]}}}}
    revolutes: {{A: [frame, a], B: [frame, b]}}
    couplings: [{{pair: [a, b], ratio: 3}}]
    inputs: {{a: 6}}
    """
    assert speeds(text)["b"] == 2
    oblique = speeds(text.replace(f"[0, 0, {way}]", f"[{way}, 0, 0]"))
    assert oblique["b"] == 2
    # an open belt keeps the sense in space
    assert speeds(text.replace("pair: [a, b], ratio: 3", "kind: belt, around: {a: 1, b: 3}"))["b"] == 2 * way


@pytest.mark.parametrize("sign", [1, -1])
def test_speeds_that_depend_on_an_approximate_ratio_have_its_tolerance_and_a_mark(sign: int) -> None:
    ratio = f"ratio: {{value: {19.2 * sign}, tolerance: 0.05}}"
    text = TWO + f"couplings: [{{pair: [a, b], {ratio}}}]\noutputs: {{b: {{}}, a: {{}}}}"
    answer = load(text).solve()
    assert answer["b"] == F(10 * sign, 192)
    assert answer.tolerances == {"b": 1 / F("19.15") - 1 / F("19.2")}
    assert answer.outputs["b"].tolerance == answer.tolerances["b"]
    lines = str(answer).splitlines()
    assert [line.strip()[0] for line in lines if "≈" in line] == ["b"]
    assert "± 0.000136" in lines[-1]
    exact = load(text.replace(", tolerance: 0.05", "")).solve()
    assert not exact.tolerances
    assert "≈" not in str(exact)


@pytest.mark.parametrize(
    ("coupling", "said"),
    [
        ("kind: belt, around: {a: 1}", "a belt needs at least two pulleys"),
        ("kind: belt, around: [p, {b: 1}]", "wheels and diameters are mixed"),
        ("kind: belt, around: {a: 1, b: }", "a pulley has no diameter"),
        ("kind: belt, around: {a: 1, b: 0}", "a pulley has the diameter 0"),
        ("kind: belt, around: [p, p]", "pulley 'p' is given twice"),
        ("kind: belt, around: [p, b]", "no wheel 'b'"),
        ("kind: belt, around: {p: 1, b: 2}", "'p' is a wheel of the link 'a'"),
        ("kind: belt, around: [p, q], reversed: [p, q]", "'p' is reversed, but the senses of the other pulleys"),
        ("kind: belt, around: [p, q], reversed: [p]", "'p' is reversed, but the senses of the other pulleys"),
        ("kind: belt, around: [p, q], reversed: [x]", "`reversed` names 'x', which is not a pulley of this belt"),
        ("kind: belt, around: [p, p2]", "connects 'a' to itself"),
        ("kind: belt, around: [p, s]", "'d' and 'a' are coaxial"),
        ("kind: belt, around: [q, p, s]", "'a' and 'd' are coaxial"),
        ("kind: belt, around: [p, r]", "goes around the ring 'r'"),
        ("kind: belt, around: {a: 1 mm, b: 2}", "lengths with and without units are mixed"),
        ("kind: belt, around: {a: 1, oblique: 2}", "axes 'A' of 'a' and 'O' of 'oblique' are not parallel"),
        ("kind: belt, around: {b: 1, a: 1, planet: 2}", "has no carrier"),
        ("kind: belt, around: {d: 1, b: 1, planet: 2}", "'planet' and 'd' are coaxial"),
        ("kind: ratio, pair: [a, b], ratio: 0", "with a ratio of 0, 'a' would be at rest"),
        ("kind: ratio, pair: [a, b], ratio: 1/0", "divides by zero"),
        ("kind: ratio, pair: [a, a], ratio: 2", "connects 'a' to itself"),
        ("kind: ratio, pair: [a, d], ratio: 2, carrier: b", "'b' is not coaxial with 'a' and 'd'"),
        ("kind: ratio, pair: [a, d], ratio: 2, carrier: a", "'a' is both the carrier and one of the pair"),
        ("kind: ratio, pair: [a, d], ratio: 2, carrier: x", "no link 'x'"),
        ("kind: ratio, pair: [a, b], ratio: 2, carrier: d", "'d' is not the carrier of coupling 'a~b'"),
        ("kind: ratio, pair: [a, b], ratio: {value: 2, tolerance: 3}", "may be 0"),
        ("kind: ratio, pair: [b, planet], ratio: 2", "has no carrier"),
    ],
)
def test_what_cannot_be_a_belt_or_a_ratio_is_refused(coupling: str, said: str) -> None:
    text = f"""
    links:
      frame: {{}}
      a: {{wheels: {{p: 20, p2: 25}}}}
      b: {{wheels: {{q: 30, r: {{teeth: 90, internal: true}}}}}}
      d: {{wheels: {{s: 30}}}}
      planet: {{}}
      oblique: {{}}
    axes: {{O: {{direction: [1, 0, 0]}}}}
    revolutes: {{A: [frame, a, d], B: [frame, b], P: [d, planet], O: [frame, oblique]}}
    inputs: {{a: 1}}
    couplings: [{{{coupling}}}]
    """
    with pytest.raises(GearTrainError) as caught:
        load(text).solve()
    assert said in str(caught.value)


def test_a_belt_whose_pulleys_are_on_two_carriers_is_refused() -> None:
    text = """
    links: {frame: {}, sun: {}, arm: {}, planet: {}, b: {}}
    revolutes: {main: [frame, sun, arm], P: [arm, planet], B: [frame, b]}
    couplings: [{kind: belt, around: {sun: 1, planet: 2, b: 3}}]
    inputs: {sun: 1}
    """
    with pytest.raises(GearTrainError, match="distance between 'planet' and 'b' changes, and a belt keeps its length"):
        load(text).solve()


def test_check_finds_pulleys_that_overlap_and_a_coaxial_ratio_of_1() -> None:
    near = LOADED.replace("20 cm", "60 mm").replace("5 mm]", "0 mm]")
    (found,) = load(near).build_findings
    assert (found.rule, found.level) == ("B1", "error")
    assert "62.5 mm" in found.problem.text
    locked = SET.replace("-75/50", "1")
    (remark,) = load(locked).kinematics.remarks
    assert "that is a lock" in remark.what


HEAVY_BELT = """
links: {frame: {}, a: {}, b: {inertia: 1 kg m2}}
revolutes: {A: [frame, a], B: [frame, b]}
couplings: [{kind: belt, around: {a: 50 mm, b: 75 mm}, REVERSED efficiency: {forward: 98 %, backward: 50 %}}]
inputs: {a: 1}
loads: {b: LOAD N m}
"""
HEAVY_SET = """
links: {frame: {}, sun: {}, ring: {inertia: 1 kg m2}, arm: {inertia: 1 kg m2}}
revolutes: {main: [frame, sun, ring, arm]}
couplings: [{pair: [PAIR], carrier: arm, ratio: RATIO, efficiency: {forward: 90 %, backward: 80 %}}]
inputs: {INPUT: 1}
fixed: [FIXED]
loads: {OUT: -2 N m}
"""


@pytest.mark.parametrize(
    ("turned", "load_"), [("", "-3"), ("", "3"), ("reversed: [b],", "3"), ("reversed: [b],", "-3")]
)
def test_a_belt_in_time_has_the_torque_of_the_balance(turned: str, load_: str) -> None:
    train = load(HEAVY_BELT.replace("REVERSED", turned).replace("LOAD", load_))
    driving = (load_ == "-3") == (turned == "")
    wanted = 2 / 0.98 if driving else -1.0
    assert float(train.torques().external["a"]) == pytest.approx(wanted)
    run = train.dynamics("1 turn/s", turns=1, skip=0, steps=400)
    assert run.torque == pytest.approx(wanted, rel=1e-9)
    assert "slip, creep and stretch of a~b" in str(run)


@pytest.mark.parametrize(
    ("pair", "ratio", "driving", "fixed", "out", "wanted"),
    [
        # the sun drives the ring in the arm's frame: ring -3/2 0.9, arm the rest
        ("sun, ring", "-3/2", "sun", "ring", "arm", 2 / (1 + 1.5 * 0.9)),
        ("ring, sun", "-2/3", "sun", "ring", "arm", 2 / (1 + 1.5 * 0.8)),
        ("sun, ring", "-3/2", "sun", "arm", "ring", -2 / 1.5 * 0.8),
        ("ring, sun", "2/3", "sun", "ring", "arm", None),
        ("sun, ring", "-3/2", "ring", "sun", "arm", None),
    ],
)
def test_a_set_in_time_has_the_torque_of_the_balance(
    pair: str, ratio: str, driving: str, fixed: str, out: str, wanted: float | None
) -> None:
    values = {"PAIR": pair, "RATIO": ratio, "INPUT": driving, "FIXED": fixed, "OUT": out}
    text = HEAVY_SET
    for key, value in values.items():
        text = text.replace(key, value)
    train = load(text)
    balance = float(train.torques().external[driving])
    assert wanted is None or balance == pytest.approx(wanted)
    assert train.dynamics("1 turn/s", turns=1, skip=0, steps=400).torque == pytest.approx(balance, rel=1e-9)


def test_the_rated_power_of_the_reference_turbine_is_its_published_one() -> None:
    found = call("torques", "nrel-5mw", "--state", "rated")
    # 5 MW of electricity at a generator efficiency of 94.4 %
    assert "Power in 5.297 MW" in found.stdout
    assert pytest.approx(5.29661, abs=1e-5) == 5 / 0.944
