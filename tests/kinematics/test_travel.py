"""Links that slide: racks, screws, drums and cranks, with their travel, forces and mistakes.

Figures of the cases are arithmetic that does not use the package: a pinion of module 2 mm and 18 teeth rolls 36 pi mm
in a turn, a nut moves by the lead, and a force does F h of work in a turn.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan, cos, degrees, pi, sin, sqrt, tan

import numpy as np
import pytest
from models import transmission_of

import geartrain
from geartrain import GearTrain
from geartrain.errors import GearTrainError
from geartrain.train.declaration_style import with_long_forms, with_short_forms

RACK = """
links: {frame: {}, pinion: {}, carriage: {}}
revolutes: {P: [frame, pinion]}
slides: {bed: [frame, carriage]}
couplings: [{kind: rack, turns: pinion, slides: carriage, teeth: 18, module: 2 mm}]
inputs: {pinion: 1}
"""


def shown(train: GearTrain, name: str) -> str:
    """Return the line of a link in the output of `geartrain solve`, with single blanks."""
    lines = (" ".join(line.split()) for line in str(train.solve()).splitlines())
    return next(line for line in lines if line.startswith(f"{name} "))


def test_a_travel_with_and_without_pi_is_marked_as_not_exact() -> None:
    train = geartrain.load("""
links: {frame: {}, a: {}, b: {}, c: {}}
revolutes: {A: [frame, a], B: [c, b]}
slides: {bed: [frame, c, d]}
couplings:
  - {kind: screw, turns: a, slides: c, lead: 1 mm}
  - {kind: rack, turns: b, slides: d, teeth: 1, module: 1 mm}
inputs: {a: 1, b: 1}
""".replace("c: {}}", "c: {}, d: {}}"))  # fmt: skip
    assert shown(train, "d") == f"d ≈ {pi - 1:.12g} mm {pi - 1:.12g} mm (not exact: contains π)"
    assert dict(train.solve().contains_pi) == {"frame": False, "a": False, "b": False, "c": False, "d": True}


def test_t1_a_rack() -> None:
    train = geartrain.load(RACK + "loads: {carriage: -100 N}\n")
    assert shown(train, "carriage") == "carriage 36 π mm 113.097335529 mm"
    assert float(train.solve()["carriage"]) == pytest.approx(113.09733553, abs=5e-9)
    # pi cancels exactly
    assert train.torques().external == {"carriage": -100, "pinion": Fraction(9, 5)}


LATHE = """
links:
  frame: {}
  spindle: {wheels: {a: 25}}
  idler: {wheels: {i: 30}}
  lead: {wheels: {b: 120}}
  carriage: {}
  pinion: {}
revolutes: {S: [frame, spindle], I: [frame, idler], L: [frame, lead], P: [carriage, pinion]}
slides: {bed: [frame, carriage]}
gears: [a ~ i, i ~ b]
couplings:
  - {kind: screw, turns: lead, slides: carriage, lead: 6 mm}
  - {kind: rack, turns: pinion, slides: frame, teeth: 16, module: 1.5 mm}
inputs: {spindle: 1}
"""


def test_t2_a_lathe() -> None:
    answer = geartrain.load(LATHE).solve()
    assert answer["lead"] == Fraction(5, 24)
    assert answer["carriage"] == Fraction(-5, 4)
    assert float(answer["pinion"]) == pytest.approx(0.016578639905, abs=5e-13)
    assert shown(geartrain.load(LATHE), "pinion") == "pinion 5/(96 π) 0.0165786399054"


def test_t3_a_differential_screw() -> None:
    train = geartrain.load("""
links: {frame: {}, c: {}, d: {}, screw: {}}
revolutes: {S: [c, screw]}
slides: {bed: [frame, c, d]}
couplings:
  - {kind: screw, turns: screw, slides: frame, lead: 1.25 mm}
  - {kind: screw, turns: screw, slides: d, lead: 1 mm}
inputs: {screw: 1}
loads: {d: -1000 N}
""")
    answer, torques = train.solve(), train.torques()
    assert (answer["c"], answer["d"]) == (Fraction(5, 4), Fraction(1, 4))
    # virtual work: 1000 N move by 0.25 mm in a turn
    assert float(torques.external["screw"]) == pytest.approx(0.039788735773, abs=5e-13)
    assert torques.external["screw"] == pytest.approx(1000 * 0.25e-3 / (2 * pi), rel=1e-15)
    assert torques.efficiency == 1
    # slide c is in balance: it takes 1000 N from each thread, and nothing else holds it
    first, second = torques.pairs["screw~frame"], torques.pairs["screw~d"]
    assert first.links == ("frame", "screw", "c", "frame")
    assert second.links == ("d", "screw", "c", "frame")
    assert first.torques[2] + second.torques[2] == 0
    assert second.torques[0] == 1000
    assert [float(each) for each in (first.torques[1], second.torques[1])] == pytest.approx(
        [-1000 * 1.25e-3 / (2 * pi), 1000 * 1e-3 / (2 * pi)], rel=1e-15
    )


WEIGHT = """
unit: {per: 1 d}
links: {frame: {}, barrel: {}, weight: {}}
revolutes: {B: [frame, barrel]}
slides: {rope: [frame, weight]}
couplings: [{kind: drum, turns: barrel, slides: weight, diameter: 40 mm, falls: 2, reversed: true}]
inputs: {barrel: 2}
"""


def test_t4_a_weight_on_a_drum() -> None:
    train = geartrain.load(WEIGHT + "loads: {weight: -39.2266 N}\n")
    assert shown(train, "weight") == "weight -40 π mm -125.663706144 mm"
    travel = -float(train.solve()["weight"])
    assert (travel, 8 * travel) == (pytest.approx(125.66370614, abs=5e-9), pytest.approx(1005.3096491, abs=5e-8))
    # 4 kg at half of the radius of the drum
    assert train.torques().external["barrel"] == -Fraction("0.392266")


SCREW = """
links: {frame: {}, screw: {}, nut: {}}
revolutes: {S: [frame, screw]}
slides: {post: [frame, nut]}
couplings: [{kind: screw, turns: screw, slides: nut, lead: 4 mm, hand: left, diameter: 18 mm, friction: 0.1}]
inputs: {screw: 1}
loads: {nut: -2000 N}
"""


def test_t5_friction_of_a_screw() -> None:
    train = geartrain.load(SCREW)
    (screw,) = train.declaration.couplings
    assert float(screw.losses.forward.base) == pytest.approx(0.41136826430, abs=5e-12)
    assert float(screw.losses.backward.base) == pytest.approx(-0.41081080212, abs=5e-12)
    torques = train.torques()
    assert float(torques.external["screw"]) == pytest.approx(3.0951331331, abs=5e-11)
    assert not torques.uncounted
    # forces on the mean circle: the load is raised on a plane inclined by the lead angle
    raised = 2000 * 0.009 * tan(atan(4 / (18 * pi)) + atan(0.1))
    assert float(torques.external["screw"]) == pytest.approx(raised, rel=1e-13)
    assert train.driven("screw", "nut").verdict.kind == "self-locking"


def test_a_trapezoidal_thread_has_more_friction_by_its_flanks() -> None:
    train = geartrain.load(SCREW.replace("friction: 0.1", "friction: 0.1, flank_angle: 15 deg"))
    raised = 2000 * 0.009 * tan(atan(4 / (18 * pi)) + atan(0.1 / cos(pi / 12)))
    assert float(train.torques().external["screw"]) == pytest.approx(raised, rel=1e-13)


def test_t6_two_pinions_on_one_rack() -> None:
    train = geartrain.load("""
links: {frame: {}, a: {}, b: {}, rack: {}}
revolutes: {A: [frame, a], B: [frame, b]}
slides: {R: [frame, rack]}
couplings:
  - {kind: rack, turns: a, slides: rack, teeth: 18, module: 2 mm}
  - {kind: rack, turns: b, slides: rack, teeth: 24, module: 2 mm}
inputs: {a: 1}
""")
    assert train.solve()["b"] == Fraction(3, 4)
    assert shown(train, "rack") == "rack 36 π mm 113.097335529 mm"
    assert train.solve().contains_pi["rack"]
    assert not train.solve().contains_pi["b"]


CRANK = """
links: {frame: {}, crank: {}, s: {}}
revolutes: {A: [frame, crank]}
slides: {R: [frame, s]}
couplings: [{kind: crank_slider, turns: crank, slides: s, radius: 20 mm, rod: 60 mm}]
inputs: {crank: 1}
outputs: {s: {expect: 0 mm}}
"""


def test_l8_a_crank_and_slider() -> None:
    law = transmission_of(CRANK)
    low, high = (end / (2 * pi) for end in law.error_range())
    assert (low, high) == (pytest.approx(-40), 0)
    assert law.speed_range()[1] / (2 * pi) == pytest.approx(21.092790931, abs=5e-10)
    assert degrees(law.peak()) == pytest.approx(73.175297, abs=5e-7)
    motion = geartrain.load(CRANK).motion()
    assert bool(geartrain.load(CRANK).solve())
    assert motion.transmission_error("s").peak_to_peak == pytest.approx(40, abs=1e-9)


def test_a_slider_is_where_its_rod_reaches() -> None:
    law = transmission_of(CRANK)
    for S in (0.3, 2.0, 4.5):
        x = 80 + law.error(S) / (2 * pi)
        pin = 20 * np.array([cos(S), sin(S)])
        assert sqrt((x - pin[0]) ** 2 + pin[1] ** 2) == pytest.approx(60, rel=1e-14)
        slope = (law.error(S + 1e-6) - law.error(S - 1e-6)) / 2e-6
        assert law.speed(S) == pytest.approx(slope, rel=1e-8)
    S = np.linspace(0, 2 * pi, 100_001)
    assert law.steepest_fall() == pytest.approx(-np.gradient(law.speed(S), S).min(), rel=1e-6)
    assert law.error_moments()[0] == pytest.approx(law.error(S[:-1]).mean(), rel=1e-12)


def test_travel_adds_along_slides_of_one_axis() -> None:
    train = geartrain.load("""
links: {frame: {}, a: {}, b: {}, c: {}, d: {}}
revolutes: {A: [frame, a], B: [c, b]}
slides: [{pair: [frame, c], axis: bed}, {pair: [c, d], axis: bed}]
couplings:
  - {kind: screw, turns: a, slides: c, lead: 5 mm}
  - {kind: screw, turns: b, slides: d, lead: 2 mm}
inputs: {a: 1, b: 10}
outputs:
  d: {expect: -25 mm}
  on c: {of: d, relative_to: c, expect: -20 mm}
""")
    assert bool(train.solve())


@pytest.mark.parametrize(("directions", "travel"), [("[1, 0, 0]", -25), ("[-1, 0, 0]", -15), ("[0, 1, 0]", -20)])
def test_two_slides_add_up_only_along_parallel_directions(directions: str, travel: int) -> None:
    train = geartrain.load(f"""
links: {{frame: {{}}, a: {{}}, b: {{}}, c: {{}}, d: {{}}}}
revolutes: {{A: [frame, a], B: [c, b]}}
slides: {{bed: [frame, c], top: [c, d]}}
axes: {{bed: {{direction: [1, 0, 0]}}, top: {{direction: {directions}}}, A: {{direction: [1, 0, 0]}},
       B: {{direction: {directions}}}}}
couplings:
  - {{kind: screw, turns: a, slides: c, lead: 5 mm}}
  - {{kind: screw, turns: b, slides: d, lead: 2 mm}}
inputs: {{a: 1, b: 10}}
""")
    # d moves by 20 mm on c against its own direction; c moves by 5 mm against x
    assert train.solve()["d"] == travel


def test_a_planetary_set_on_a_carriage_turns_as_on_the_frame() -> None:
    train = geartrain.load("""
links:
  frame: {}
  leadscrew: {}
  carriage: {wheels: {ring: {teeth: 60, internal: true}}}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  arm: {}
revolutes: {L: [frame, leadscrew], main: [carriage, sun, arm], P: [arm, planet]}
slides: {bed: [frame, carriage]}
gears: [s ~ p, p ~ ring]
couplings: [{kind: screw, turns: leadscrew, slides: carriage, lead: 6 mm}]
inputs: {sun: 1, leadscrew: 3}
outputs:
  arm: {expect: 2/7}
  planet: {relative_to: arm, expect: -20/21}
  of the carriage: {of: arm, relative_to: carriage, expect: 2/7}
  carriage: {expect: -18 mm}
loads: {arm: -7 N m, carriage: 0 N}
""")
    assert bool(train.solve())
    found = train.torques()
    assert found.external["sun"] == 2
    assert found.external["leadscrew"] == 0
    assert set(found.pairs["p~ring"].links) == {"planet", "frame", "arm"}


def test_a_brake_on_a_pinion_holds_the_carriage_too_and_a_lock_on_its_carriage_does_not() -> None:
    fixed = geartrain.load(LATHE.replace("inputs: {spindle: 1}", "fixed: [pinion]\nexpect: locked"))
    assert fixed.solve().verdict.kind == "locked"
    # the pinion does not turn on its carriage, so it cannot roll on the rack
    locked = geartrain.load(LATHE.replace("inputs: {spindle: 1}", "locks: [[carriage, pinion]]\nexpect: locked"))
    assert locked.solve().verdict.kind == "locked"
    free = LATHE.replace("  - {kind: rack, turns: pinion, slides: frame, teeth: 16, module: 1.5 mm}\n", "")
    train = geartrain.load(free + "locks: [[carriage, pinion]]\n")
    assert (train.solve()["pinion"], train.solve()["carriage"]) == (0, Fraction(-5, 4))


def test_two_screws_of_one_nut_lock_unless_their_leads_agree() -> None:
    text = """
links: {{frame: {{}}, a: {{wheels: {{p: 20}}}}, b: {{wheels: {{q: 20}}}}, nut: {{}}}}
revolutes: {{A: [frame, a], B: [frame, b]}}
slides: {{post: [frame, nut]}}
gears: [p ~ q]
couplings:
  - {{kind: screw, turns: a, slides: nut, lead: 4 mm}}
  - {{kind: screw, turns: b, slides: nut, lead: {lead}, hand: left}}
inputs: {{a: 1}}
"""
    assert geartrain.load(text.format(lead="4 mm")).mobility.redundant == 1
    verdict = geartrain.load(text.format(lead="5 mm")).solve().verdict
    assert verdict.kind == "locked"
    assert verdict.loops[0].product in (Fraction(5, 4), Fraction(4, 5))


def test_travel_per_time_follows_the_unit_of_the_inputs() -> None:
    assert geartrain.load(RACK.replace("pinion: 1", "pinion: 30 rpm")).declaration.travel_unit == "mm/min"
    train = geartrain.load(RACK.replace("pinion: 1", "carriage: 0.9 m/s"))
    # 0.9 m/s at a circumference of 36 pi mm
    assert float(train.solve()["pinion"]) == pytest.approx(25 / pi, rel=1e-15)
    assert (train.declaration.unit_name, train.declaration.travel_unit) == ("turn/s", "mm/s")
    assert train.declaration.case(None).given("carriage") == "carriage = 900 mm"
    day = geartrain.load(WEIGHT.replace("barrel: 2", "weight: -1 mm/min"))
    assert day.solve()["weight"] == -1440
    assert day.declaration.travel_unit == "mm per d"


def test_a_pitch_and_a_hand_change_the_travel() -> None:
    rack = RACK.replace("module: 2 mm", "pitch: 5 mm, reversed: true")
    assert geartrain.load(rack).solve()["carriage"] == -90
    screw = "{kind: screw, turns: pinion, slides: carriage, lead: 0.25 in, hand: %s}"
    for hand, travel in (("right", -6.35), ("left", 6.35)):
        text = RACK.replace("{kind: rack, turns: pinion, slides: carriage, teeth: 18, module: 2 mm}", screw % hand)
        assert float(geartrain.load(text).solve()["carriage"]) == travel


def test_outputs_of_slides_are_judged_as_lengths() -> None:
    for key, holds in (
        ("expect: 113.1 mm", True),
        ("expect: 11.31 cm", True),
        ("expect: 113 mm", False),
        ("expect: {value: 113 mm, tolerance: 0.1 mm}", True),
        ("published: {value: 113.097 mm, as: output/input}", True),
        ("targets: [{speed: 113 mm, tolerance: 0.1 %}]", True),
        ("targets: [{speed: 113 mm, tolerance: 0.01 %}]", False),
    ):
        assert bool(geartrain.load(f"{RACK}outputs: {{carriage: {{{key}}}}}\n").solve()) is holds, key


DRUM = "kind: drum, turns: pinion, slides: carriage, diameter: 40 mm"
RACKED = "kind: rack, turns: pinion, slides: carriage, teeth: 18, module: 2 mm"
MISTAKES = {
    "plain number for travel": ("pinion: 1}", "carriage: 1}", "give a length: `carriage: 1 mm`"),
    "speed of rotation for travel": ("pinion: 1}", "carriage: 1 rpm}", "'carriage' slides"),
    "length for a turning link": ("pinion: 1}", "pinion: 1 mm}", "because 'pinion' turns"),
    "degrees": ("pinion: 1}", "pinion: 1 deg/s}", "give the speed in turn/s"),
    "travel per turn and per time": ("pinion: 1}", "pinion: 1 rpm, carriage: 1 mm}", "mixed"),
    "plain expect": ("{pinion: 1}", "{pinion: 1}\noutputs: {carriage: {expect: 113}}", "give a length: `113 mm`"),
    "expected length": ("{pinion: 1}", "{pinion: 1}\noutputs: {pinion: {expect: 1 mm}}", "'pinion' turns"),
    "plain published": (
        "{pinion: 1}",
        "{pinion: 1}\noutputs: {carriage: {published: {value: 3}}}",
        "give a length: `3 mm`",
    ),
    "period of a slide": (
        "{pinion: 1}",
        "unit_ {pinion: 1}\noutputs: {carriage: {targets: [{period: 1 d}]}}\nunit: {per: 1 d}".replace("unit_ ", ""),
        "slides and has no period",
    ),
    "torque on a slide": ("{pinion: 1}", "{pinion: 1}\nloads: {carriage: -2 N m}", "the load of a slide is a force"),
    "force on an arbor": ("{pinion: 1}", "{pinion: 1}\nloads: {pinion: 2 N}", "the load of a turning link is a torque"),
    "inertia of a slide": ("carriage: {}}", "carriage: {inertia: 1 kg m2}}", "give its `mass`"),
    "angle of a slide": ("carriage: {}}", "carriage: {angle: 1 deg}}", "slides and has no `angle`"),
    "bearing of a slide": ("carriage: {}}", "carriage: {bearing: 1 N mm}}", "slides and has no `bearing`"),
    "copies of a slide": ("carriage: {}}", "carriage: {copies: 3}}", "declare them one by one"),
    "turns and slides": (
        "[frame, pinion]",
        "[frame, pinion, carriage]",
        "a link can turn or slide on only one other link",
    ),
    "one label for both": ("slides: {bed:", "slides: {P:", "give the slide another label"),
    "slide of one link": ("[frame, carriage]}", "[frame]}", "fewer than two links"),
    "unknown link": ("[frame, carriage]}", "[frame, cart]}", "no link 'cart'"),
    "ends exchanged": ("turns: pinion, slides: carriage", "turns: carriage, slides: pinion", "'pinion' turns on"),
    "no size": (", module: 2 mm", "", "either `module` or `pitch`"),
    "two sizes": ("module: 2 mm", "module: 2 mm, pitch: 6 mm", "either `module` or `pitch`"),
    "broken tooth": ("teeth: 18", "teeth: 18.5", "give a whole number"),
    "no teeth": ("teeth: 18", "teeth: 0", "give a whole number"),
    "neither true nor false": ("module: 2 mm", "module: 2 mm, reversed: maybe", "write true or false"),
    "lead 0": (RACKED, "kind: screw, turns: pinion, slides: carriage, lead: 0 mm", "greater than 0"),
    "lead without unit": (RACKED, "kind: screw, turns: pinion, slides: carriage, lead: 6", "'6' has no unit"),
    "friction without diameter": (
        RACKED,
        "kind: screw, turns: pinion, slides: carriage, lead: 6 mm, friction: 0.1",
        "add `diameter`",
    ),
    "friction and efficiency": (
        RACKED,
        "kind: screw, turns: pinion, slides: carriage, lead: 6 mm, friction: 0.1, diameter: 9 mm, efficiency: 0.5",
        "remove one of them",
    ),
    "friction that holds a screw": (
        RACKED,
        "kind: screw, turns: pinion, slides: carriage, lead: 60 mm, friction: 0.9, diameter: 9 mm",
        "cannot move its nut",
    ),
    "falls 0": (RACKED, f"{DRUM}, falls: 0", "give a whole number from 1"),
    "diameter without unit": (RACKED, "kind: drum, turns: pinion, slides: carriage, diameter: 40", "'40' has no unit"),
    "short rod": (
        RACKED,
        "kind: crank_slider, turns: pinion, slides: carriage, radius: 3 cm, rod: 3 cm",
        "give a longer rod",
    ),
    "rate of the wrong kind": ("{pinion: 1}", "{pinion: 1}\nrate: 2 mm/s", "write `rate: 1 turn/s`"),
    "drum of a weight that is a link": (
        "{pinion: 1}",
        "{pinion: 1}\ncrank: carriage\ndrive: {weight: 4 kg, drum: 3 mm}",
        "without `drum`",
    ),
    "torque at a slide": ("{pinion: 1}", "{pinion: 1}\ncrank: carriage\ndrive: {torque: 4 N m}", "by its weight"),
    "weight without drum": ("{pinion: 1}", "{pinion: 1}\ndrive: {weight: 4 kg}", "has no `drum`"),
    "oblique screw": (
        f"[{{{RACKED}}}]",
        "[{kind: screw, turns: pinion, slides: carriage, lead: 6 mm}]\naxes: {bed: {direction: [1, 0, 0]}, P: "
        "{direction: [0, 0, 1]}}",
        "a nut moves along the axis of its screw",
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_refused_with_its_fix(mistake: str) -> None:
    old, new, said = MISTAKES[mistake]
    assert old in RACK
    with pytest.raises(GearTrainError) as refused:
        geartrain.load(RACK.replace(old, new)).circuits  # noqa: B018
    assert said in str(refused.value)


def test_the_anomaly_of_a_pin_reaches_a_rack_in_millimetres() -> None:
    train = geartrain.load("""
links: {frame: {}, a: {}, b: {}, rack: {}}
revolutes: {A: [frame, a], B: [frame, b]}
slides: {R: [frame, rack]}
couplings:
  - {kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 5 mm}
  - {kind: rack, turns: b, slides: rack, teeth: 18, module: 2 mm}
inputs: {a: 1}
outputs: {rack: {}}
loads: {rack: -100 N}
""")
    # the slot is at most arcsin(1/2) ahead or behind, on a pitch radius of 18 mm
    found = train.motion().transmission_error("rack")
    assert found.peak_to_peak == pytest.approx(2 * 18 * pi / 6, rel=1e-6)
    # the slot turns at most 10/(10 - 5) and at least 10/(10 + 5) times as fast as the pin
    run = train.torques(turns=1)
    assert (run.maximum_torque, run.minimum_torque) == (pytest.approx(1.8 * 2), pytest.approx(1.8 * 2 / 3))
    back = train.with_changes({"loads": {"a": "-1 N m"}, "solve_for": "rack"}).torques(turns=1)
    assert back.unit == "N"
    assert back.maximum_torque == pytest.approx(1 / 0.018 * 1.5, rel=1e-6)


def test_slides_have_a_short_form_that_formatting_keeps() -> None:
    long = "slides:\n  - {pair: [frame, c], axis: bed}\n  - {pair: [frame, d], axis: bed}\n"
    assert with_short_forms(long) == "slides: {bed: [frame, c, d]}\n"
    assert with_long_forms("slides: {bed: [frame, c, d]}\n") == long


def test_a_child_replaces_a_slide_by_its_links_and_keeps_the_rest() -> None:
    child = geartrain.load("""
extends: lathe-thread
slides: [{pair: [bed, carriage], axis: guide}]
outputs: {carriage: {expect: -1.25 mm}}
""")
    assert child.kinematics.tree.axis("carriage") == "guide"
    assert bool(child.solve())
    graph = child.graph
    (edge,) = (each for each in graph.edges(data=True) if each[2]["kind"] == "prismatic")
    assert edge[2]["label"] == "guide"
