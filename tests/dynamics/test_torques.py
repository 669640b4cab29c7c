"""Torques and losses: exact cases, closed forms, conservation of power, self-locking, sharing."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from commands import call
from hypothesis import given
from hypothesis import strategies as st
from shipped import every_train

from geartrain import GearTrainError, load, shipped

# sun, ring and arm on one axis, one planet with two wheels: basic ratio (w_sun - w_arm)/(w_ring - w_arm)
SET = """
links:
  frame: {{}}
  sun: {{wheels: {{s: {s}}}}}
  planet: {{wheels: {{p: {p}, q: {q}}}}}
  ring: {{wheels: {{r: {r}}}}}
  arm: {{}}
revolutes: {{A: [frame, sun, ring, arm], P: [arm, planet]}}
gears: [{{pair: [s, p], efficiency: {e}}}, {{pair: [q, r], efficiency: {f}}}]
{rest}
"""


teeth = st.integers(12, 90)
shares = st.integers(80, 99).map(lambda percent: Fraction(percent, 100))


def efficiency(rest: str, numbers: tuple[int, int, int, int], e: Fraction, f: Fraction, load_at: str, at: str) -> Any:
    s, p, q, r = numbers
    return load(SET.format(s=s, p=p, q=q, r=r, e=e, f=f, rest=rest)).driven(load_at, at)


@given(st.tuples(teeth, teeth, teeth, teeth), shares, shares)
def test_a_compound_set_has_the_efficiency_of_its_closed_form(
    numbers: tuple[int, int, int, int], e: Fraction, f: Fraction
) -> None:
    s, p, q, r = numbers
    ratio, eta = Fraction(p * r, s * q), e * f  # basic ratio above 0: two external meshes
    if ratio == 1:
        return
    rest = "fixed: [ring]\ninputs: {sun: 1}"
    forward = efficiency(rest, numbers, e, f, "arm", "sun")
    back = efficiency(rest.replace("sun: 1", "arm: 1"), numbers, e, f, "sun", "arm")
    if ratio > 1:
        # sun to arm: (i e - 1)/(i - 1), locked where i e <= 1; arm to sun: (i - 1)/(i/e - 1)
        assert (forward.verdict.kind == "self-locking") == (ratio * eta <= 1)
        if forward.verdict:
            assert forward.efficiency == (ratio * eta - 1) / (ratio - 1)
        assert back.efficiency == (ratio - 1) / (ratio / eta - 1)
    else:
        # arm to sun: (1 - i)/(1 - e i); sun to arm: (1 - i/e)/(1 - i), locked where i >= e
        assert (forward.verdict.kind == "self-locking") == (ratio >= eta)
        if forward.verdict:
            assert forward.efficiency == (1 - ratio / eta) / (1 - ratio)
        assert back.efficiency == (1 - ratio) / (1 - eta * ratio)


@pytest.mark.parametrize("name", every_train(name for name in shipped() if not load(name).states))
def test_without_losses_powers_sum_to_zero_exactly(name: str) -> None:
    train = load(name)
    case = train.declaration.case(None)
    if len(case.inputs) != 1:
        pytest.skip("several inputs")
    (source,) = case.inputs
    answer = train.solve()
    plain = {gear.name for gear in train.declaration.gears if gear.efficiency is None and gear.friction is None}
    rough = train.declaration.friction is not None or any(gear.friction for gear in train.declaration.gears)
    lossy = bool(train.meshes) or len(plain) < len(train.declaration.gears)
    lossy |= any(coupling.efficiency is not None for coupling in train.declaration.couplings)
    lossy |= any(coupling.kind == "screw" and coupling.friction for coupling in train.declaration.couplings)
    for output in list(case.outputs)[:4]:
        link = answer.outputs[output].of
        if link == source or not answer.speeds[link] or link in train.kinematics.joint_sums:
            continue
        found = train.driven(link, source)
        if lossy:
            assert sum(found.powers.values()) == found.loss >= 0
            assert found.loss > 0 or not train.meshes or not rough
            continue
        assert sum(found.powers.values()) == 0
        assert found.efficiency == 1
        # torque ratio is the inverse speed ratio
        assert found.external[source] * answer.speeds[source] == 1


def test_real_teeth_lose_what_their_transmissions_say() -> None:
    train = load("sorge-pairs")
    for mesh in train.meshes:
        found = train.driven(f"fig{mesh.name}", "crank")
        # the load is given: it is the driver's torque that varies within a turn
        assert float(found.efficiency) == pytest.approx(mesh.transmission.efficiency_at_constant_load(), rel=1e-14)
        assert found.pairs[mesh.name].driver == mesh.driver
        back = train.driven("crank", f"fig{mesh.name}")
        assert float(back.efficiency) == pytest.approx(mesh.reversed.efficiency_at_constant_load(), rel=1e-14)


def three(first: str = "", second: str = "", third: str = "", more: str = "", efficiency: str = "0.9") -> str:
    """The train of three planets, each with keys of its own on the pair with the sun."""
    names = zip((first, second, third), (1, 2, 3), strict=True)
    suns = [f"{{pair: [s30, p{at}], efficiency: {efficiency}{keys}}}" for keys, at in names]
    rings = [f"{{pair: [p{at}, r78], efficiency: {efficiency}{more}}}" for at in (1, 2, 3)]
    return f"extends: three-planets\nloads: {{carrier: -18 N m}}\ngears: [{', '.join(suns + rings)}]\n"


@pytest.mark.parametrize("state", ["1", "2", "3", "4", "R"])
def test_copies_of_planets_that_mesh_with_each_other_carry_equal_loads(state: str) -> None:
    """A Ravigneaux set with three planets of each kind has the efficiency and the total mesh power of one of each."""
    pairs = ("a~ps", "ps~pl", "b~pl", "pl~r")
    gears = [{"id": name, "efficiency": "0.99"} for name in pairs]
    one = load("ravigneaux-set").with_changes(gears=gears, loads={"OUT": "-100 N m"})
    three = one.with_changes(links={planet: {"copies": 3} for planet in ("SHORT", "LONG")})
    found, single = three.torques(state), one.torques(state)
    assert found.verdict.kind == "determined"
    assert found.efficiency == single.efficiency
    for name in pairs:
        first, second = name.split("~")
        copies = [each.power for pair, each in found.pairs.items() if pair.split("~")[0].split(".")[0] == first
                  and pair.split("~")[1].split(".")[0] == second]  # fmt: skip
        assert copies == [single.pairs[name].power / 3] * 3


def test_declared_shares_override_the_equal_ones() -> None:
    found = load(three(", share: 0.5", ", share: 0.3", ", share: 0.2")).torques()
    assert found.verdict.kind == "determined"
    on_sun = [found.pairs[f"s30~p{at}"].torques[0] for at in (1, 2, 3)]
    assert [each / sum(on_sun) for each in on_sun] == [Fraction(5, 10), Fraction(3, 10), Fraction(2, 10)]
    on_ring = [found.pairs[f"p{at}~r78"].torques[1] for at in (1, 2, 3)]
    assert [each / sum(on_ring) for each in on_ring] == [Fraction(5, 10), Fraction(3, 10), Fraction(2, 10)]
    # outside nothing changes: (1 + p e)/(1 + p) with p = 78/30 and e = 0.81
    assert found.efficiency == (1 + Fraction(78, 30) * Fraction(81, 100)) / (1 + Fraction(78, 30))
    assert sum(found.external.values()) == 0


def test_shares_said_twice_must_agree() -> None:
    text = three(", share: 1", ", share: 1", ", share: 2")
    assert load(text.replace("r78], efficiency: 0.9}", "r78], efficiency: 0.9, share: 7}")).torques().verdict.kind == (
        "contradictory"
    )
    for at, share in ((1, 3), (2, 3), (3, 6)):
        text = text.replace(f"[p{at}, r78],", f"[p{at}, r78], share: {share},")
    found = load(text).torques()
    assert found.verdict.kind == "determined"
    assert found.pairs["s30~p3"].torques[0] == 2 * found.pairs["s30~p1"].torques[0]


def test_a_wheel_of_the_frame_is_no_planet_though_an_idle_wheel_is_like_it() -> None:
    """The sun turns the arm five times as fast, (w_sun - w_arm) 25 = -w_arm 20; the idle wheel hands on nothing."""
    found = load("""
    links: {frame: {wheels: {f: 20}}, arm: {}, planet: {wheels: {p: 38}}, sun: {wheels: {s: 25}},
      idle: {wheels: {i: 20}}}
    revolutes: [{pair: [frame, arm], axis: A}, {pair: [frame, sun], axis: A}, {pair: [frame, idle], axis: A},
      {pair: [arm, planet], axis: P}]
    gears: [{pair: [p, f]}, {pair: [p, s]}, {pair: [p, i]}]
    inputs: {sun: 1}
    outputs: {arm: {}}
    loads: {arm: -1}
    """).torques()
    assert found.verdict.kind == "determined"
    assert found.external["sun"] == 5
    assert found.pairs["p~i"].torques == (0, 0, 0)


def test_a_share_of_two_and_other_losses_of_one_planet_leave_the_sharing_open() -> None:
    uneven = load(three().replace("[s30, p2], efficiency: 0.9", "[s30, p2], efficiency: 0.8"))
    assert uneven.torques().verdict.kind == "indeterminate"
    found = load(three(", share: 3", ", share: 1")).torques()
    assert found.verdict.kind == "indeterminate"
    assert "s30~p3" in found.verdict.candidates


@pytest.mark.parametrize("swapped", [False, True])
def test_equal_planets_share_alike_in_whatever_order_their_wheels_are_named(swapped: bool) -> None:
    text = three()
    if swapped:
        text = text.replace("[s30, p2]", "[p2, s30]").replace("[p3, r78]", "[r78, p3]")
    text = text.replace("gears:", "remove: {gears: [s30~p2, p3~r78]}\ngears:") if swapped else text
    found = load(text).torques()
    assert found.verdict.kind == "determined"
    assert found.efficiency == (1 + Fraction(78, 30) * Fraction(81, 100)) / (1 + Fraction(78, 30))
    second = found.pairs["p2~s30"].torques[1] if swapped else found.pairs["s30~p2"].torques[0]
    assert second == found.pairs["s30~p1"].torques[0]


def test_planets_with_equal_friction_are_alike() -> None:
    bearings = "links: {" + ", ".join(f"planet{at}: {{bearing: 1 N m}}" for at in (1, 2, 3)) + "}\n"
    found = load(three() + bearings).torques()
    assert found.verdict.kind == "determined"
    # three planets turn against the carrier at -5/8 - 5/18 for a turn of the sun
    assert found.bearing_loss == 3 * (Fraction(5, 8) + Fraction(5, 18))
    assert load(three() + bearings.replace("1 N m", "2 N m", 1)).torques().verdict.kind == "indeterminate"


LOOP = "extends: four-gear-loop\nloads: {c: -12 N m}\n"


def test_a_loop_is_open_until_two_pairs_of_one_wheel_have_shares() -> None:
    open_ = load(LOOP).torques()
    assert open_.verdict.kind == "indeterminate"
    assert set(open_.verdict.candidates) == {"a20~b30", "b30~c40", "c40~d50", "d50~a20"}
    assert open_.circulating is None
    assert (open_.efficiency, open_.loss) == (1, 0)
    text = LOOP + "gears: [{pair: [a20, b30], share: 3}, {pair: [d50, a20], share: 1}]\n"
    found = load(text).torques()
    assert found.verdict.kind == "determined"
    # 6 N m at the crank: 4.5 through b and 1.5 through d, which is 9 and 3 at c
    assert found.external["a"] == 6
    assert abs(found.pairs["a20~b30"].torques[0]) == Fraction(9, 2)
    assert abs(found.pairs["d50~a20"].torques[1]) == Fraction(3, 2)
    assert abs(found.pairs["b30~c40"].torques[1]) == 9
    assert abs(found.pairs["c40~d50"].torques[0]) == 3
    lossy = load(text.replace("share: 3", "share: 3, efficiency: 0.9")).torques()
    assert lossy.pairs["a20~b30"].torques[0] == 3 * lossy.pairs["d50~a20"].torques[1]
    # at c arrive 0.9 * 2 * 3/4 T + 2 * 1/4 T
    assert lossy.external["a"] == 12 / (Fraction(9, 10) * 2 * Fraction(3, 4) + 2 * Fraction(1, 4))


def test_shares_on_an_idler_say_nothing_and_shares_that_disagree_are_named() -> None:
    idler = LOOP + "gears: [{pair: [a20, b30], share: 3}, {pair: [b30, c40], share: 1}]\n"
    assert load(idler).torques().verdict.kind == "indeterminate"
    four = (("a20", "b30", 3), ("b30", "c40", 1), ("c40", "d50", 1), ("d50", "a20", 1))
    gears = ", ".join(f"{{pair: [{one}, {other}], share: {share}}}" for one, other, share in four)
    found = load(LOOP + f"gears: [{gears}]\n").torques()
    assert found.verdict.kind == "contradictory"
    assert all(name in found.verdict.text for name in ("a20~b30", "b30~c40", "c40~d50", "d50~a20"))
    assert not found.verdict


@pytest.mark.parametrize("share", ["0", "-1", "1/0", "half"])
def test_a_share_is_a_number_above_zero(share: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        load(LOOP + f"gears: [{{pair: [a20, b30], share: {share}}}]\n")
    assert caught.value.problems[0].fix


LOADED = SET.format(s=24, p=18, q=18, r=60, e=1, f=1, rest="fixed: [ring]\ninputs: {sun: 3}\nloads: {arm: 10 N m}")


def test_a_load_decides_the_torque_of_the_input() -> None:
    found = load(LOADED).torques()
    assert found.verdict.kind == "determined"
    assert found.requested == ("sun",)
    assert sum(found.powers.values()) == 0
    # three external torques about one axis: sun, arm and the brake of the ring balance
    assert sum(found.external.values()) == 0


def test_bearings_take_their_torque_times_their_speed() -> None:
    text = LOADED.replace("arm: {}", "arm: {bearing: 1 N m}")
    free, rubbing = load(LOADED).torques(), load(text).torques()
    arm = abs(rubbing.speeds["arm"])
    assert rubbing.loss == rubbing.bearing_loss == arm
    assert sum(rubbing.powers.values()) == arm
    assert rubbing.power_in == free.power_in + arm


PAIR = """
links: {frame: {}, a: {wheels: {x: 20}}, b: {bearing: 3 N m, wheels: {y: 40}}, c: {wheels: {z: 10}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [x, y], efficiency: 0.9}, {pair: [y, z], efficiency: 0.8}]
inputs: {a: 2}
"""


def test_friction_alone_decides_what_the_crank_takes() -> None:
    found = load(PAIR).torques()
    assert found.verdict.kind == "determined"
    assert "friction" in found.verdict.text
    assert found.requested == ("a",)
    # b turns once, backwards, against 3 N m: a power of 3 in turns, through a pair that loses a tenth
    assert found.external == {"a": 3 / Fraction(9, 10) / 2}
    assert found.bearing_loss == 3
    assert found.efficiency == 0
    assert load(PAIR.replace("3 N m", "0 N m")).torques().verdict.kind == "unloaded"


def test_power_enters_at_the_crank_wherever_speeds_are_counted() -> None:
    # the same speeds, counted at b; the crank is c, which makes -4 turns for one of b
    text = PAIR.replace("inputs: {a: 2}", "inputs: {b: -1}\ncrank: c")
    found = load(text).torques()
    assert found.requested == ("c",)
    assert found.external == {"c": 3 / Fraction(8, 10) / 4}
    loaded = load(text + "loads: {a: -1 N m}\n").torques()
    assert loaded.requested == ("c",)
    # 2 leave at a through a pair that loses a tenth, 3 are rubbed away at b
    assert loaded.external == {"a": -1, "c": (2 / Fraction(9, 10) + 3) / Fraction(8, 10) / 4}
    assert sum(loaded.powers.values()) == loaded.loss
    both = load(text + "loads: {a: -1 N m, c: 3 N m}\nsolve_for: b\n").torques()
    assert both.requested == ("b",)
    assert both.external["b"] == (3 * 4 * Fraction(8, 10) - 3 - 2 / Fraction(9, 10)) * 1


def test_the_crank_of_the_antikythera_train_takes_what_its_pointers_take() -> None:
    train = load("extends: freeth-2008\nloads: {moon: -1}\n")
    found = train.torques()
    assert found.requested == (train.declaration.crank,) != tuple(train.declaration.inputs)
    crank = train.declaration.crank
    assert found.external[crank] == train.solve()["moon"] / train.solve()[crank]


def test_a_crank_that_stands_still_does_no_work() -> None:
    text = PAIR.replace("c: {wheels: {z: 10}}", "c: {}").replace(", {pair: [y, z], efficiency: 0.8}", "")
    found = load(text + "crank: c\nfixed: [c]\n").torques()
    assert found.verdict.kind == "still"
    assert "'c'" in found.verdict.text


def test_with_two_inputs_the_crank_stands_for_one_of_them() -> None:
    text = LOADED.replace("fixed: [ring]\ninputs: {sun: 3}", "inputs: {sun: 3, ring: 1}\ncrank: arm")
    text = text.replace("loads: {arm: 10 N m}", "loads: {planet: 2 N m}")
    open_ = load(text).torques()
    assert open_.verdict.kind == "undecided"
    assert open_.verdict.candidates == ("sun", "ring")
    assert "arm" in open_.verdict.text
    named = load(text + "solve_for: ring\n").torques()
    assert set(named.external) == {"planet", "arm", "ring"}
    assert sum(named.powers.values()) == 0
    assert load(text.replace("{planet: 2 N m}", "{planet: 2 N m, sun: 0}")).torques().external == named.external


# basic ratio 29*32/(30*30), a thirtieth above 1: with 0.9 a mesh the sun cannot drive the arm
NEAR_ONE = SET.format(s=30, p=29, q=30, r=32, e="0.9", f="0.9", rest="fixed: [ring]\ninputs: {sun: -1}\n")


def near_one(loads: str, bearing: str = "") -> Any:
    return load(NEAR_ONE.replace("arm: {}", f"arm: {{{bearing}}}") + loads).torques()


def test_teeth_lock_at_any_load() -> None:
    # the arm turns forwards, so -1 resists there
    assert near_one("loads: {arm: -1}\n").verdict.kind == "self-locking"
    rubbing = near_one("loads: {arm: -1}\n", "bearing: 2")
    assert rubbing.verdict.kind == "self-locking"
    assert "however large" in rubbing.verdict.text
    assert near_one("", "bearing: 2").verdict.kind == "self-locking"


def test_a_load_too_small_for_the_bearings_stalls_what_it_would_drive() -> None:
    driving = near_one("loads: {arm: 1}\n")
    assert driving.verdict.kind == "ambiguous"
    # what arrives at the sun resists there: (i0 - 1)/(i0/e - 1) of the power at the arm
    ratio, eta, speed = Fraction(29 * 32, 900), Fraction(81, 100), driving.speeds["arm"]
    out = (ratio - 1) / (ratio / eta - 1) * speed
    assert driving.powers["sun"] == -out
    given, other = driving.verdict.text.split(";")
    assert f"{float(out):.6g}" in given
    assert "leaves at sun, which resists" in given
    assert "sun drives" in other
    assert "all power is lost" in other
    stalled = near_one("loads: {arm: 1}\n", "bearing: 2")
    assert stalled.verdict.kind == "stalled"
    assert not stalled.verdict
    assert "too small" in stalled.verdict.text
    moving = near_one("loads: {arm: 3}\n", "bearing: 2")
    assert moving.powers["sun"] == -out


def test_a_load_that_drives_may_need_help_against_bearings() -> None:
    strong, weak = (load(PAIR + f"loads: {{b: -{torque} N m}}\n").torques() for torque in (10, 1))
    assert strong.verdict.kind == weak.verdict.kind == "determined"
    assert strong.external["a"] == -(10 - 3) * Fraction(9, 10) / 2
    assert "drive" not in strong.verdict.text
    assert weak.external["a"] == (3 - 1) / Fraction(9, 10) / 2
    assert "too small to overcome the friction of the bearings, so a must drive" in weak.verdict.text


def test_a_load_whose_power_the_teeth_lose_is_told_from_one_that_is_too_small() -> None:
    # driven at the sun, the set loses more than it gets: the arm must be driven as well
    found = near_one("loads: {sun: -1}\nsolve_for: arm\n")
    ratio, eta = Fraction(29 * 32, 900), Fraction(81, 100)
    assert found.powers["sun"] == 1
    assert found.powers["arm"] == -(ratio * eta - 1) / (ratio - 1) > 0
    assert "because the teeth dissipate all of its power: arm must drive as well" in found.verdict.text


def test_an_input_with_a_load_needs_a_name_for_what_is_unknown() -> None:
    text = LOADED.replace("loads: {arm: 10 N m}", "loads: {sun: 10 N m}\noutputs: {arm: {}, planet: {}}")
    found = load(text).torques()
    assert found.verdict.kind == "undecided"
    assert found.verdict.candidates == ("arm", "planet")
    named = load(text + "solve_for: arm\n").torques()
    assert named.verdict.kind == "determined"
    assert named.external["arm"] * named.speeds["arm"] == -named.external["sun"] * named.speeds["sun"]


def test_a_worm_that_cannot_be_driven_back_says_so() -> None:
    train = load("extends: worm\ngears: [{pair: [w, g], efficiency: {forward: 0.5, backward: -0.1}}]\n".replace(
        "[w, g]", str(list(load("worm").declaration.gears[0].pair)).replace("'", "")
    ))  # fmt: skip
    assert train.driven("wheel", "screw").efficiency == Fraction(1, 2)
    assert train.driven("screw", "wheel").verdict.kind == "self-locking"


def test_a_pair_may_lose_more_on_the_way_back() -> None:
    text = LOADED.replace("[s, p], efficiency: 1", "[s, p], efficiency: {forward: 0.9, backward: 0.7}")
    text = text.replace("fixed: [ring]\ninputs: {sun: 3}", "fixed: [arm]\ninputs: {sun: 3}")
    train = load(text.replace("loads: {arm: 10 N m}", ""))
    for way, efficiency in (
        (train.driven("ring", "sun"), Fraction(9, 10)),
        (train.driven("sun", "ring"), Fraction(7, 10)),
    ):
        assert way.efficiency == efficiency
        assert sum(way.powers.values()) == way.loss == way.power_in - 1


def test_the_command_prints_keys_and_verdicts(tmp_path: Path) -> None:
    path = tmp_path / "t.yaml"
    path.write_text(LOADED, encoding="utf-8")
    (data,) = json.loads(call("torques", path, "--json").output)["states"]
    assert set(data) == {
        "state", "verdict", "efficiency", "circulating", "links", "pairs", "power_in", "loss", "drives",
        "flow", "losses", "bearings", "watts_per_unit", "held", "neglected", "belt_pulls",
    }  # fmt: skip
    assert data["links"]["sun"]["requested"] is True
    assert set(data["pairs"]["s~p"]) == {"driver", "torques", "power", "loss", "shared"}
    assert data["efficiency"] == 1.0
    assert call("torques", path).exit_code == 0
    path.write_text(LOADED.replace("{arm: 10 N m}", "{sun: 10 N m}"), encoding="utf-8")
    assert call("torques", path).exit_code == 1
    assert call("torques", "worm").exit_code == 0


def test_an_efficiency_of_means_over_teeth_is_a_float_and_a_declared_one_a_fraction() -> None:
    teeth = load("planetary-24-18-60-involute")
    for friction in (0.02, 0.1):
        found = teeth.with_changes(friction=friction).driven("carrier", "sun")
        assert isinstance(found.efficiency, float)
        assert all(isinstance(pair.efficiency, float) for pair in found.pairs.values())
        # the ring held, i0 = -60/24: (1 - i0 eta0)/(1 - i0), with eta0 the product of both pairs
        eta0 = float(found.pairs["s~p"].efficiency * found.pairs["p~ring"].efficiency)
        assert found.efficiency == pytest.approx((1 + 2.5 * eta0) / 3.5, rel=1e-12)
        (ways,) = (teeth.with_changes(friction=friction).graph.edges["sun", "planet", "s~p"]["efficiency"],)
        assert all(isinstance(way, float) for way in ways)
    plain = load("planetary-24-18-60").with_changes(gears=[{"pair": ["s", "p"], "efficiency": 0.98}])
    declared = plain.driven("carrier", "sun")
    assert declared.efficiency == (1 + Fraction(5, 2) * Fraction(98, 100)) / Fraction(7, 2)


def test_teeth_of_a_pair_that_transmits_no_torque_are_not_built() -> None:
    train = load("""
links: {frame: {}, a: {wheels: {P: 20, R: 20}}, b: {wheels: {Q: 40}}, c: {wheels: {S: 30}}}
revolutes: {X: [frame, a], Y: [frame, b], Z: [frame, c]}
gears:
  - {pair: [P, Q], efficiency: 0.97}
  - {pair: [R, S], efficiency: 0.97, tooth_form: {form: involute, shift: [-3, -3]}}
inputs: {a: 1}
loads: {b: 1}
""")
    # 20/40 of the load torque, divided by the efficiency
    assert train.torques().external["a"] == Fraction(50, 97)
    with pytest.raises(GearTrainError, match="no centre distance"):
        train.with_changes({"loads": {"b": 0, "c": 1}}).torques()
