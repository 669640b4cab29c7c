"""What a declaration says of friction, bearings, inertia, impacts and what drives a train in time."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from commands import call
from models import PAIR, refusal, torque_figures

from geartrain import load
from geartrain.errors import GearTrainError
from geartrain.train import Train


def declared(rest: str = "", link: str = "", wheel: str = "", pair: str = "") -> Train:
    text = PAIR.format(rest="inputs: {a: 2}\n" + rest)
    text = text.replace("b: {wheels: {w: 60}}", f"b: {{{link}wheels: {{w: {{teeth: 60, {wheel}}}}}}}")
    return load(text.replace("{pair: [p, w]}", f"{{pair: [p, w]{pair}}}")).declaration


def test_a_bare_friction_slides_and_rests_alike_and_is_not_in_doubt() -> None:
    train = declared("friction: 0.2")
    found = train.friction_of(train.gears[0])
    assert (found.sliding, found.static, found.deviation, found.law) == (0.2, 0.2, 0, None)
    assert declared().friction_of(train.gears[0]) is None


def test_a_friction_of_its_own_stands_before_that_of_the_train() -> None:
    train = declared("friction: 0.2", pair=", friction: {sliding: 0.1, static: 0.15, deviation: 0.02}")
    found = train.friction_of(train.gears[0])
    assert (found.sliding, found.static, found.deviation) == (0.1, 0.15, 0.02)


def test_a_law_rests_at_its_value_at_no_speed() -> None:
    at_rest = {
        "{law: stribeck, static: 0.3, kinetic: 0.1, speed: 5 mm/s}": 0.3,
        "{law: buckingham}": 0.0517,
        "{law: dokos}": 0.53,
        "{law: table, speeds: [0 m/s, 1 m/s], coefficients: [0.25, 0.1]}": 0.25,
    }
    for transmission, static in at_rest.items():
        train = declared(f"friction: {transmission}")
        found = train.friction_of(train.gears[0])
        assert found.sliding is None
        assert found.law is not None
        assert found.static == pytest.approx(static, rel=1e-14)


def test_sliding_friction_in_keys_turns_the_same_train_as_the_number() -> None:
    number, keys = (
        load(f"extends: moon-triangular\nfriction: {friction}\nloads: {{moon: -1 N mm}}\n")
        for friction in ("0.1", "{sliding: 0.1, static: 0.3, deviation: 0.05}")
    )
    assert number.torques().external == keys.torques().external
    name = load("freeth-2008").declaration.couplings[0].name
    pin = f"extends: freeth-2008\nloads: {{{{moon: -1 N mm}}}}\ncouplings: [{{{{id: {name}, friction: {{0}}}}}}]\n"
    torques = [load(pin.format(friction)).torques() for friction in ("0.1", "{sliding: 0.1, static: 0.2}")]
    assert torques[0].external == torques[1].external


def test_a_bearing_slides_and_rests() -> None:
    bearing = declared(link="bearing: {sliding: 0.5 N m, static: 0.7 N m}, ").links["b"].bearing
    assert (bearing.sliding.si, bearing.at_rest.si) == (0.5, 0.7)
    bare = declared(link="bearing: 0.5 N m, ").links["b"].bearing
    assert (bare.sliding.si, bare.at_rest.si) == (0.5, 0.5)


def test_masses_and_drag_stand_on_links_and_wheels() -> None:
    train = declared(
        "density: 8.7 g/cm3\nthickness: 2 mm",
        link="inertia: 3 g cm2, mass: 20 g, drag: 0.5 N mm s/rad, ",
        wheel="thickness: 3 mm, density: 7850 kg/m3",
    )
    link, wheel = train.links["b"], train.wheels["w"][1]
    assert [part.si for part in (link.inertia, link.mass, link.drag) if part] == [3e-7, 0.02, 0.0005]
    assert [part.si for part in (wheel.thickness, wheel.density) if part] == [0.003, 7850]
    assert [part.si for part in (train.thickness, train.density) if part] == [0.002, 8700]


def test_teeth_strike_and_yield_as_their_pair_says_else_as_the_train_does() -> None:
    train = declared("restitution: 0.3\nstiffness: 20 N/um\ndamping: 5 N s/m")
    assert train.restitution_of(train.gears[0]) == 0.3
    assert train.stiffness.si == 2e7
    own = declared("restitution: 0.3", pair=", restitution: 1/2, stiffness: 20 N m/rad, damping: 0.1 N m s/rad")
    assert own.restitution_of(own.gears[0]) == 0.5
    assert own.gears[0].stiffness.dimension == "torsional stiffness"
    assert declared().restitution_of(own.gears[0]) == 0.5
    assert declared().restitution_of(train.gears[0]) is None


def test_a_rate_is_a_drive_and_a_state_may_have_its_own() -> None:
    train = declared("rate: 3 turn/s\nstates: {run: {}, fall: {drive: {weight: 4 kg, drum: 20 mm}}}")
    run, fall = train.case("run"), train.case("fall")
    assert (run.drive.kind, fall.drive.kind) == ("rate", "weight")
    assert run.rate == fall.rate
    assert run.rate.base == 3
    driven = declared("drive: {rate: 2 turn/s}").case(None)
    assert driven.rate.base == 2
    assert declared().case(None).drive is None


def test_a_spring_runs_down_and_a_hand_yields() -> None:
    spring = declared("drive: {spring: {stiffness: 0.02 N m/rad, turns: 3.5}}").case(None).drive
    assert spring.spring.torque(0.0) == pytest.approx(0.02 * 7 * 3.141592653589793)
    assert spring.spring.torque(7 * 3.141592653589793) == pytest.approx(0, abs=1e-15)
    hand = declared("drive: {hand: {rate: 1 turn/s, stiffness: 5 N m/rad, inertia: 0.02 kg m2}}").case(None).drive
    assert hand.kind == "hand"


def test_a_rate_of_the_drive_gives_watts_as_the_rate_does() -> None:
    text = "extends: moon-triangular\nloads: {moon: -1 N mm}\n"
    trains = [load(text + said) for said in ("rate: 2 turn/s", "drive: {rate: 2 turn/s}", "")]
    found = [torque_figures(train).watts_per_unit for train in trains]
    assert found == [found[0], found[0], None]


def test_an_escapement_lets_half_a_tooth_pass_a_beat() -> None:
    escapement = declared("escapement: {link: b, teeth: 30, beat: 1 s}").escapement
    assert escapement.speed == Fraction(1, 60)


def test_a_pendulum_of_39_14_inches_beats_seconds_and_one_of_a_quarter_of_that_half_seconds() -> None:
    for length, beat in (("994.1 mm", "1 s"), ("248.5 mm", "0.5 s")):
        escapement = declared(f"escapement: {{link: b, teeth: 30, beat: {beat}, pendulum: {length}}}").escapement
        assert escapement.pendulum is not None


def test_a_child_replaces_friction_bearing_and_drive_whole(tmp_path: Path) -> None:
    rest = "inputs: {a: 1}\nfriction: {sliding: 0.1, static: 0.3}\ndrive: {torque: 2 N m}\ndensity: 1 g/cm3"
    (tmp_path / "old.yaml").write_text(PAIR.format(rest=rest), encoding="utf-8")
    child = "extends: old.yaml\nfriction: {sliding: 0.2}\ndrive: {weight: 1 kg, drum: 1 cm}\nlinks: {b: {bearing: 1}}\n"
    (tmp_path / "new.yaml").write_text(child + "density: null\n", encoding="utf-8")
    train = load(tmp_path / "new.yaml").declaration
    found = train.friction_of(train.gears[0])
    assert (found.sliding, found.static) == (0.2, 0.2)
    assert train.drive.kind == "weight"
    assert train.density is None


SLIPS = {
    "friction: -0.1": "`friction`: the coefficient of friction -0.1 is negative",
    "friction: {sliding: 0.2, static: 0.1}": "the static coefficient of friction 0.1 is below the sliding one 0.2",
    "friction: {slidign: 0.2}": "did you mean 'sliding'",
    "friction: {static: 0.2, kinetic: 0.1, speed: 1 m/s}": "add `law:`",
    "links: {a: {bearing: {sliding: 1, static: 0.5}}}": "0.5 is below the sliding friction torque 1",
    "links: {a: {bearing: {sliding: 1, static: 2 N m}}}": "mix a number without a unit and a torque with a unit",
    "links: {a: {drag: 1 N m}}": "is a torque, but a torsional damping is required",
    "restitution: 1.01": "a restitution of 1.01 is out of range",
    "stiffness: 0 N/m": "the value must be greater than 0, not 0 N/m",
    "density: 8.7": "'8.7' has no unit",
    "drive: {}": "a drive needs exactly one kind; found: nothing",
    "drive: {rate: 1, torque: 2 N m}": "found: rate and torque",
    "drive: {weight: 4 kg}": "the weight at 'a' has no `drum`",
    "drive: {torque: -2 N m}": "-2 N m is below 0",
    "drive: {wieght: 4 kg}": "did you mean 'weight'",
    "drive: {hand: {torque: 1 N m, stiffness: 2 N m/rad}}": "`stiffness` applies only to a hand with a `rate`",
    "rate: 2\ndrive: {rate: 1}": "the rate is declared twice",
    "loads: {a: 1 N m}\ndrive: {torque: 2}": "torques with and without units are mixed",
    "escapement: {link: c, teeth: 30, beat: 1 s}": "no link 'c'",
    "escapement: {link: frame, teeth: 30, beat: 1 s}": "which does not turn",
    "links: {a: {inertia: -1 kg m2}}": "-1 kg m2 is below 0",
    "escapement: {link: a, teeth: 30, beat: 1}": "'1' has no unit",
    "escapement: {link: a, teeth: 30, beat: 1 s, pendulum: 1.1 m}": "give 993.6 mm",
}


@pytest.mark.parametrize(("slip", "said"), SLIPS.items(), ids=SLIPS)
def test_what_cannot_be_is_said_with_its_line(slip: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "old.yaml").write_text(PAIR.format(rest="inputs: {a: 1}"), encoding="utf-8")
    (tmp_path / "new.yaml").write_text(f"extends: old.yaml\n{slip}\n", encoding="utf-8")
    told = refusal(str(tmp_path / "new.yaml"))
    assert said in told
    assert "new.yaml:" in told
    assert "fix:" in told


def test_a_slot_is_as_wide_as_its_pin_or_wider() -> None:
    text = "{{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 2 mm, clearance: {0}, restitution: 0.2}}"
    train = """
    links: {{frame: {{}}, a: {{}}, b: {{}}}}
    revolutes: [{{pair: [frame, a], axis: A}}, {{pair: [frame, b], axis: B}}]
    couplings: [{0}]
    inputs: {{a: 1}}
    """
    found = load(train.format(text.format("0.1 mm"))).declaration
    assert found.couplings[0].clearance.si == 1e-4
    assert found.restitution_of(found.couplings[0]) == 0.2
    assert "a clearance of -1 mm is negative" in refusal(train.format(text.format("-1 mm")))
    assert "passes the slot's axis" in refusal(train.format(text.format("16 mm")))
    assert "lengths with and without units are mixed" in refusal(train.format(text.format("1")))


def test_editors_are_told_of_every_key() -> None:
    parts = json.loads(call("inspect", "schema").stdout)["$defs"]
    assert {"drag", "inertia", "mass", "bearing"} <= set(parts["Link"]["anyOf"][1]["properties"])
    assert {"sliding", "static", "deviation", "range"} == set(parts["CoulombFriction"]["anyOf"][1]["properties"])
    assert {"rate", "torque", "weight", "drum", "falls", "drop", "spring", "hand"} == set(parts["Drive"]["properties"])


def test_teeth_yield_as_their_form_says_where_their_pair_does_not() -> None:
    form = "tooth_form: {form: involute, stiffness: 7 N m/rad, damping: 0.3 N m s/rad}"
    train = declared(f"stiffness: 20 N/um\ndamping: 5 N s/m\n{form}")
    stiffness, damping = train.stiffness_of(train.gears[0]), train.damping_of(train.gears[0])
    assert (str(stiffness), str(damping)) == ("7 N m/rad", "0.3 N m s/rad")
    # the pair's own form has nothing of the train's
    other = declared(
        f"stiffness: 20 N/um\n{form}", pair=", tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}"
    )
    assert str(other.stiffness_of(other.gears[0])) == "20 N/um"
    assert other.damping_of(other.gears[0]) is None
    own = declared(form, pair=", stiffness: 9 N m/rad")
    assert str(own.stiffness_of(own.gears[0])) == "9 N m/rad"
    assert str(own.damping_of(own.gears[0])) == "0.3 N m s/rad"
    assert declared().stiffness_of(own.gears[0]) is not None


@pytest.mark.parametrize(
    ("keys", "fix"), [("stiffness: 0 N m/rad", "above 0, such as"), ("damping: -1 N m s/rad", "0 or more")]
)
def test_a_form_that_does_not_yield_is_refused_as_a_pair_is(keys: str, fix: str) -> None:
    with pytest.raises(GearTrainError, match=fix):
        declared(f"tooth_form: {{form: involute, {keys}}}")
