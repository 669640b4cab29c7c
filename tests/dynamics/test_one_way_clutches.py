"""One-way clutches: patterns of holding and overrunning, by exact values, Gauss' principle, and closed forms."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from commands import call, imported_by
from scipy.integrate import quad

import geartrain
from geartrain import GearTrain

# O1: a planetary set whose ring may only turn forward
SET = """
frame: f
links:
  f: {}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  carrier: {}
revolutes: {main: [f, sun, ring, carrier], P: [carrier, planet]}
gears: [s ~ p, p ~ r]
clutches: {F: {fixes: ring, one_way: forward}}
outputs: {carrier: {}}
inputs: {sun: 1}
"""
# O2: a bicycle hub with two pairs of pawls
HUB = """
frame: axle
links:
  axle: {wheels: {s: 20}}
  planet: {wheels: {p: 20}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  cage: {}
  hub: {}
revolutes: {main: [axle, ring, cage, hub], P: [cage, planet]}
gears: [s ~ p, p ~ r]
clutches: {R: {locks: [ring, hub], one_way: forward, teeth: 24}, P: {locks: [cage, hub], one_way: forward}}
outputs: {hub: {}}
states: {high: {inputs: {cage: 1}}, normal: {inputs: {ring: 1}}, low: {inputs: {ring: 1}, free: [R]}}
"""
# O3: a Simpson set whose second carrier may only turn forward
SIMPSON = """
extends: simpson-set
clutches: {F: {fixes: C2, one_way: forward}}
states:
  1: {engaged: [forward]}
  low: {engaged: [forward, low]}
  coast: {engaged: [forward], inputs: {IN: 1/2, OUT: 1}}
  pushed: {engaged: [forward], inputs: {OUT: 1}, outputs: {IN: {}}, expect: free}
  pushed low: {engaged: [forward, low], inputs: {OUT: 1}, outputs: {IN: {}}}
  required: {engaged: [forward, direct, F]}
"""
# O4: a chain drives one cog by its front and the other by its back
RETRO = """
frame: f
links: {f: {}, chain: {wheels: {c: 44}}, a: {wheels: {cog a: 18}}, b: {wheels: {cog b: 26}}, wheel: {}}
revolutes: {C: [f, chain], W: [f, a, b, wheel]}
couplings: [{kind: belt, around: [c, cog a]}, {kind: belt, around: [c, cog b], reversed: [cog b]}]
clutches: {A: {locks: [a, wheel], one_way: forward}, B: {locks: [b, wheel], one_way: forward}}
outputs: {wheel: {}}
states: {ahead: {inputs: {chain: 1}}, back: {inputs: {chain: -1}}}
"""
TWO = """
frame: f
links: {f: {}, in: {}, h: {}}
revolutes: {main: [f, in, h]}
clutches: {A: {locks: [in, h], one_way: forward}, B: {locks: [in, h], one_way: forward}}
outputs: {h: {}}
inputs: {in: 1}
"""
OPPOSED = """
frame: f
links: {f: {}, x: {}}
revolutes: {main: [f, x]}
clutches: {A: {fixes: x, one_way: forward}, B: {fixes: x, one_way: backward}}
inputs: {x: 1}
"""
ROCKER = """
frame: f
links: {f: {}, crank: {}, rocker: {}, h: {}}
revolutes: {C: [f, crank], W: [f, rocker, h]}
couplings: [{kind: pin_follower, pin: crank, slot: rocker, pin_radius: 6 mm, offset: 10 mm}]
clutches: {A: {locks: [rocker, h], one_way: forward}}
outputs: {h: {}}
inputs: {crank: 1}
"""
# both strokes of the rocker drive h, one through idlers; a dial is geared to h
BOTH_STROKES = """
frame: f
links:
  f: {}
  crank: {}
  rocker: {wheels: {r: 20}}
  a: {wheels: {a1: 20}}
  b: {wheels: {b1: 20}}
  back: {wheels: {k: 20}}
  h: {wheels: {h1: 20}}
  dial: {wheels: {d: 40}}
revolutes: {C: [f, crank], W: [f, rocker, back, h], X: [f, a], Y: [f, b], Z: [f, dial]}
gears: [r ~ a1, a1 ~ b1, b1 ~ k, h1 ~ d]
couplings: [{kind: pin_follower, pin: crank, slot: rocker, pin_radius: 6 mm, offset: 10 mm}]
clutches: {A: {locks: [rocker, h], one_way: forward}, B: {locks: [back, h], one_way: forward}}
outputs: {h: {}, dial: {}}
inputs: {crank: 1}
"""
# two followers of opposite cranks drive h
OPPOSITE = """
frame: f
links: {f: {}, crank: {}, other: {angle: 180 deg}, rocker: {}, second: {}, h: {}}
revolutes: {C: [f, crank, other], W: [f, rocker, second, h]}
locks: [[crank, other]]
couplings:
  - {kind: pin_follower, pin: crank, slot: rocker, pin_radius: 6 mm, offset: 10 mm}
  - {kind: pin_follower, pin: other, slot: second, pin_radius: 6 mm, offset: 10 mm}
clutches: {A: {locks: [rocker, h], one_way: forward}, B: {locks: [second, h], one_way: forward}}
outputs: {h: {}}
inputs: {crank: 1}
"""
# a differential: with a load on the ring the carrier drives it through F, with a load on the sun G holds the sun
DIFFERENTIAL = SET.replace("clutches: {F: {fixes: ring, one_way: forward}}", "").replace(
    "outputs: {carrier: {}}\ninputs: {sun: 1}",
    """
clutches: {F: {locks: [carrier, ring], one_way: forward}, G: {fixes: sun, one_way: forward}}
outputs: {ring: {}, sun: {}}
inputs: {carrier: 1}
""",
)


def actions(train: GearTrain, state: str | None = None) -> Mapping[str, Any]:
    return {each.name: each for each in train.declaration.case(state).one_way}


def notes(train: GearTrain, state: str | None = None) -> Sequence[str]:
    return train.declaration.case(state).notes


def test_o1_the_ring_holds_five_halves_of_the_torque_of_the_sun_or_overruns() -> None:
    train = geartrain.load(SET)
    assert train.solve()["carrier"] == Fraction(2, 7)
    held = actions(train)["F"]
    assert (held.holds, held.torque, held.slip) == (True, Fraction(5, 2), 0)
    assert notes(train) == ("driven from carrier, F lets go: no engine braking",)
    both = train.with_changes(inputs={"sun": 1, "carrier": 1})
    assert both.solve()["ring"] == 1
    free = actions(both)["F"]
    assert (free.holds, free.torque, free.slip) == (False, 0, 1)


@pytest.mark.parametrize(
    ("state", "hub", "holds", "overruns", "slip"),
    [
        ("high", Fraction(4, 3), "R", "P", Fraction(1, 3)),
        ("normal", Fraction(1), "R", "P", Fraction(1, 4)),
        ("low", Fraction(3, 4), "P", "", None),
    ],
)
def test_o2_the_faster_pawls_of_a_hub_drive_it(
    state: str, hub: Fraction, holds: str, overruns: str, slip: Fraction | None
) -> None:
    train = geartrain.load(HUB)
    found = actions(train, state)
    assert train.solve(state)["hub"] == hub
    assert [name for name, each in found.items() if each.holds] == [holds]
    assert {name: each.slip for name, each in found.items() if not each.holds} == ({overruns: slip} if overruns else {})


def test_o3_a_simpson_set_holds_in_first_gear_only_while_the_engine_drives() -> None:
    train = geartrain.load(SIMPSON)
    assert train.solve("1")["OUT"] == Fraction(11, 27)
    held = actions(train, "1")["F"]
    assert (held.holds, held.torque) == (True, Fraction(16, 11))
    driven = train.driven("OUT", "IN", "1")
    assert driven.external["C2"] / -driven.external["OUT"] == Fraction(16, 27)
    assert notes(train, "1") == ("driven from OUT, F lets go: no engine braking",)
    assert (train.solve("2")["OUT"], actions(train, "2")["F"].slip) == (Fraction(11, 16), Fraction(121, 256))
    assert (train.solve("3")["OUT"], actions(train, "3")["F"].slip) == (1, 1)


def test_o3_driven_from_the_output_the_clutch_lets_go_and_the_low_brake_holds() -> None:
    train = geartrain.load(SIMPSON)
    assert train.solve("coast")["C2"] == Fraction(43, 32)
    assert actions(train, "coast")["F"].slip == Fraction(43, 32)
    assert train.solve("pushed").verdict.kind == "free"
    assert notes(train, "pushed") == ("F lets go under this load",)
    assert train.solve("pushed low")["IN"] == Fraction(27, 11)
    # the brake takes the torque that the clutch cannot take
    assert actions(train, "pushed low")["F"].torque == 0
    assert notes(train, "low") == ("low and F both hold; how they share the torque is not known",)
    assert actions(train, "low")["F"].torque is None


@pytest.mark.parametrize(
    ("state", "wheel", "free", "slip"),
    [("ahead", Fraction(22, 9), "B", Fraction(484, 117)), ("back", Fraction(22, 13), "A", Fraction(484, 117))],
)
def test_o4_either_sense_of_the_crank_drives_the_wheel_forward(
    state: str, wheel: Fraction, free: str, slip: Fraction
) -> None:
    train = geartrain.load(RETRO)
    assert train.solve(state)["wheel"] == wheel
    assert {name: each.slip for name, each in actions(train, state).items() if not each.holds} == {free: slip}


def test_o5_two_clutches_at_one_speed_share_an_unknown_part_of_the_torque() -> None:
    train = geartrain.load(TWO)
    assert train.solve()["h"] == 1
    assert [(name, each.holds, each.torque) for name, each in actions(train).items()] == [
        ("A", True, None), ("B", True, None)
    ]  # fmt: skip
    assert "A and B both hold; how they share the torque is not known" in notes(train)


def test_o6_opposed_clutches_hold_their_link_together() -> None:
    train = geartrain.load(OPPOSED)
    verdict = train.solve().verdict
    assert verdict.kind == "locked"
    assert "'x' is fixed by B" in verdict.text
    assert notes(train) == ("A and B together hold 'x': write a brake or a clutch, such as A: {fixes: x}",)


def swing_speed(angle: float, radius: float = 6, offset: float = 10) -> float:
    """Return the speed of the follower divided by that of its pin, from the position of the pin seen from the slot's
    axis.
    """
    x, y = radius * np.cos(angle) - offset, radius * np.sin(angle)
    return float(radius * (x * np.cos(angle) + y * np.sin(angle)) / (x * x + y * y))


def advance_by_quadrature(*speeds: Callable[[float], float]) -> float:
    """Return the integral of max(0, speeds) over one turn of the pin, divided at all changes of sign and order."""
    # extremes of the swing, and the two positions at which opposite followers have the same speed
    reversal = np.arccos(0.6) / (2 * np.pi)
    ends = sorted({(at + half) % 1 for at in (reversal, -reversal, 0, 0.25) for half in (0, 0.5)} | {1.0})
    parts = (
        quad(lambda turn: max(0.0, *(speed(2 * np.pi * turn) for speed in speeds)), low, high, epsabs=1e-14)[0]
        for low, high in pairwise(ends)
    )
    return float(sum(parts))


def test_o7_a_swinging_driver_advances_the_link_behind_its_clutch() -> None:
    train = geartrain.load(ROCKER)
    answer = train.solve()
    assert (answer.verdict.kind, bool(answer), "h" in answer.speeds) == ("free", True, False)
    assert not actions(train)["A"].holds
    assert notes(train) == ("the speed of 'h' is not determined by ratios: `motion` counts it",)
    (advance,) = train.motion().advances.values()
    assert advance == pytest.approx(0.20483276470, abs=1e-11)
    assert advance == pytest.approx(np.arcsin(0.6) / np.pi, abs=1e-14)
    assert advance == pytest.approx(advance_by_quadrature(swing_speed), abs=1e-13)


def test_o7_two_clutches_take_both_strokes() -> None:
    motion = geartrain.load(BOTH_STROKES).motion()
    assert list(motion.outputs) == ["rocker", "back"]
    assert motion.advances["h"] == pytest.approx(0.40966552940, abs=1e-11)
    assert motion.advances["h"] == pytest.approx(
        advance_by_quadrature(swing_speed, lambda angle: -swing_speed(angle)), abs=1e-13
    )


@pytest.mark.parametrize(("sense", "way", "expected"), [("backward", -1, 0.40966552940), ("forward", 1, 0.34404173925)])
def test_o7_opposite_followers_add_up_unless_their_strokes_overlap(sense: str, way: int, expected: float) -> None:
    # the return stroke takes 0.295 of a turn, the other stroke 0.705, so that two of these overlap
    advance = geartrain.load(OPPOSITE.replace("forward", sense)).motion().advances["h"]
    counted = advance_by_quadrature(
        lambda angle: way * swing_speed(angle), lambda angle: way * swing_speed(angle + np.pi)
    )
    assert way * advance == pytest.approx(expected, abs=1e-11)
    assert way * advance == pytest.approx(counted, abs=1e-13)


@pytest.mark.parametrize(
    ("old", "new", "advance"),
    [
        ("[rocker, h]", "[h, rocker]", -0.2048327647),
        ("inputs: {crank: 1}", "inputs: {crank: -3}", -0.2048327647),
        ("{A: {", "{B: {fixes: h, one_way: forward}, A: {", 0.2048327647),
    ],
)
def test_the_advance_has_the_sense_of_the_clutch(old: str, new: str, advance: float) -> None:
    assert geartrain.load(ROCKER.replace(old, new)).motion().advances == {"h": pytest.approx(advance, abs=1e-10)}


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("inputs: {", "loads: {h: -1}\ninputs: {", "loads are declared"),
        ("inputs: {", "inputs: {h: 1, ", "there are several inputs"),
        (
            "{A: {",
            "{B: {fixes: rocker, one_way: backward}, A: {",
            "not every clutch is between a common and a determined link",
        ),
        ("{A: {", "{B: {fixes: h, one_way: backward}, A: {", "the clutches drive their link in both senses"),
        ("h: {}}\nr", "h: {}, k: {}}\nr", "further links are undetermined"),
        ("locks: [rocker, h]", "fixes: rocker", "not every clutch is between a common and a determined link"),
    ],
)
def test_an_advance_that_cannot_be_counted_is_refused_with_its_reason(old: str, new: str, why: str) -> None:
    text = ROCKER.replace(old, new)
    text = text.replace("rocker, h]}", "rocker, h, k]}") if ", k: {}" in text else text
    with pytest.raises(geartrain.DeclarationError, match="the advance of the link behind") as caught:
        geartrain.load(text)
    assert why in str(caught.value)


def test_motions_that_depend_on_the_steps_are_refused_by_name() -> None:
    with pytest.raises(geartrain.QuestionError, match="the motion of 'h' is not determined at every position"):
        geartrain.load(ROCKER).motion(outputs=["h"])
    unknown = geartrain.load(ROCKER.replace(", pin_radius: 6 mm, offset: 10 mm", ""))
    with pytest.raises(geartrain.QuestionError, match="the speeds of crank~rocker within a turn are not known"):
        _ = unknown.motion().advances


def test_commands_print_the_advance(tmp_path: Path) -> None:
    path = tmp_path / "both.yaml"
    path.write_text(BOTH_STROKES)
    motion, report, check = (call(verb, path) for verb in ("motion", "report", "check"))
    assert "'h' advances by 0.4096655294 turn per turn of 'crank'" in " ".join(motion.stdout.split())
    assert "Not computed: the position of dial, h within a step." in " ".join(report.stdout.split())
    (advance,) = json.loads(call("motion", path, "--json").stdout)["advances"].items()
    assert advance == ("h", pytest.approx(0.4096655294, abs=1e-10))
    assert (check.exit_code, check.stdout[:3]) == (0, "ok ")


def test_declared_loads_and_losses_give_the_torque_in_newton_metres() -> None:
    gears = [{"pair": pair, "efficiency": 0.98} for pair in (["s", "p"], ["p", "r"])]
    train = geartrain.load(SET).with_changes(gears=gears, loads={"carrier": "-10 N m"})
    # closed form: the ring takes p e of the torque of the sun, and the carrier 1 + p e, with p = 60/24
    lossy = 60 / 24 * 0.98**2
    held = actions(train)["F"]
    assert float(held.torque or 0) == pytest.approx(10 * lossy / (1 + lossy), rel=1e-12)
    assert held.text() == "F holds (7.05969 N m)"


def test_a_load_that_drives_lets_the_clutch_go() -> None:
    train = geartrain.load(SET).with_changes(loads={"carrier": 10})
    assert train.solve().verdict.kind == "free"
    assert notes(train) == ("F lets go under this load",)


def test_a_clutch_that_depends_on_the_loads_is_refused_until_they_are_declared() -> None:
    with pytest.raises(geartrain.DeclarationError) as caught:
        geartrain.load(DIFFERENTIAL)
    (problem,) = caught.value.problems
    assert problem.what == "whether F and G hold depends on the loads"
    assert problem.why == "with a load on ring: F holds; with a load on sun: G holds"
    on_ring = geartrain.load(DIFFERENTIAL + "loads: {ring: -1}")
    assert (on_ring.solve()["ring"], actions(on_ring)["F"].torque, actions(on_ring)["G"].slip) == (1, 1, 1)
    on_sun = geartrain.load(DIFFERENTIAL + "loads: {sun: -1}")
    assert (on_sun.solve()["ring"], actions(on_sun)["G"].torque) == (Fraction(7, 5), 1)
    assert actions(on_sun)["F"].slip == Fraction(2, 5)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("one_way: forward", "one_way: true", "`one_way` needs a sense of rotation"),
        ("one_way: forward", "teeth: 24", "`teeth` applies only to a one-way clutch"),
        ("fixes: ring", "fixes: planet", "the one-way clutch 'F' is not between two coaxial links"),
        ("inputs: {sun: 1}", "inputs: {sun: 1}\nstates: {a: {free: [G]}}", "no clutch 'G'"),
        ("inputs: {sun: 1}", "inputs: {sun: 1}\nstates: {a: {free: [F], engaged: [F]}}", "'F' is engaged and free"),
        (
            "F: {fixes: ring, one_way: forward}}",
            "F: {fixes: ring}}\nstates: {a: {free: [F]}}",
            "'F' is not a one-way clutch",
        ),
    ],
)
def test_mistakes_are_refused_with_their_cause(old: str, new: str, message: str) -> None:
    with pytest.raises(geartrain.DeclarationError, match=message):
        geartrain.load(SET.replace(old, new))


def test_a_clutch_that_must_hold_and_overruns_fails_the_state() -> None:
    train = geartrain.load(SIMPSON)
    answer = train.solve("required")
    assert answer.verdict
    assert not answer
    assert "F overruns at 1; FAILS: it is required to hold" in str(answer)


def test_a_shift_table_marks_one_way_clutches_that_hold() -> None:
    train = geartrain.load("torqueflite")
    box = train.gearbox()
    assert {each.state: each.one_way for each in box.states} == {"1": ("F",), "2": (), "3": (), "R": (), "low": ("F",)}
    assert box.states[0].torques["F"] == Fraction(16, 11)
    assert next(each.kind for each in box.elements if each.name == "F") == "one-way brake"
    # the clutch changes over by itself: one element opens, and one closes
    assert not any(each.is_double for each in box.shifts)
    assert box.shifts[0].applied == ("band",)


def test_torques_from_the_output_name_the_clutch_that_overruns() -> None:
    train = geartrain.load(SET)
    assert train.driven("carrier", "sun").verdict
    back = train.driven("sun", "carrier").verdict
    assert (back.kind, back.candidates) == ("overrunning", ("F",))


def test_the_decision_follows_a_change_of_loads_or_teeth() -> None:
    train = geartrain.load(DIFFERENTIAL + "loads: {ring: -1}")
    assert actions(train)["F"].holds
    changed = GearTrain(train.declaration.model_copy(update={"loads": geartrain.load(
        DIFFERENTIAL + "loads: {sun: -1}").declaration.loads}))  # fmt: skip
    assert actions(changed)["G"].holds
    assert not actions(changed)["F"].holds
    assert geartrain.load(SET).with_teeth(r=66, p=21).solve()["carrier"] == Fraction(24, 90)


def test_a_simulation_in_time_is_refused_by_name() -> None:
    with pytest.raises(geartrain.QuestionError, match="does not include the one-way clutches F"):
        geartrain.load(SET).dynamics("1 turn/s")


def test_a_train_without_one_way_clutches_does_not_import_their_solver() -> None:
    modules = imported_by("import geartrain; geartrain.load('simpson-set').solve('1')")
    assert not any(name.startswith("geartrain.dynamics") for name in modules)


def settle(
    rows: Sequence[Mapping[str, float]],
    given: Mapping[str, float],
    one_way: Mapping[str, tuple[str, str, int]],
    output: str,
    seed: int,
    close: float,
) -> tuple[dict[str, float], set[str]]:
    """Return the speeds to which bodies of random inertia settle, and the clutches whose slip is then below `close`.

    Each step minimises Gauss' constraint, 1/2 (v - u)^T M (v - u) with the speeds u that the bodies would have without
    connections, under the equations `rows`, the speeds `given` and the inequalities of the clutches. This is a problem
    of least distance, which `nnls` solves (Lawson and Hanson, Solving least squares problems, chapter 23). The output
    has a viscous load.
    """
    from scipy.linalg import null_space
    from scipy.optimize import nnls

    links = sorted({link for row in rows for link in row} | {*given} | {b for _, b, _ in one_way.values()})
    at = {link: number for number, link in enumerate(links)}
    equal = np.zeros((len(rows) + len(given), len(links)))
    right = np.zeros(len(equal))
    for number, row in enumerate(rows):
        for link, factor in row.items():
            equal[number, at[link]] += factor
    for number, (link, speed) in enumerate(given.items(), len(rows)):
        equal[number, at[link]], right[number] = 1, speed
    above = np.zeros((len(one_way), len(links)))
    for number, (a, b, sense) in enumerate(one_way.values()):
        above[number, at[b]] += sense
        if a:
            above[number, at[a]] -= sense
    inertia = np.exp(np.random.default_rng(seed).uniform(-1.5, 1.5, len(links)))
    load = np.zeros(len(links))
    load[at[output]] = 3.0
    start, free = np.linalg.lstsq(equal, right, rcond=None)[0], null_space(equal)
    speeds, step = np.zeros(len(links)), 0.2
    root = np.sqrt(inertia + step * load)
    for _ in range(400):
        wish = inertia * speeds / (inertia + step * load)
        # least distance |x| with x = Q z - f, Q = root * free, f = root * (wish - start)
        q, r = np.linalg.qr(root[:, None] * free)
        target = q.T @ (root * (wish - start))
        matrix = above @ free @ np.linalg.inv(r)
        bound = -above @ start - matrix @ target
        dual, _ = nnls(np.vstack((matrix.T, bound)), np.r_[np.zeros(matrix.shape[1]), 1.0])
        rest = np.vstack((matrix.T, bound)) @ dual - np.r_[np.zeros(matrix.shape[1]), 1.0]
        x = -rest[:-1] / rest[-1] if abs(rest[-1]) > 1e-12 else rest[:-1]
        speeds = start + free @ np.linalg.solve(r, x + target)
    slips = above @ speeds
    return dict(zip(links, speeds.tolist(), strict=True)), {
        name for name, slip in zip(one_way, slips, strict=True) if slip < close
    }


def willis(i: str, zi: int, j: str, zj: int, k: str) -> dict[str, float]:
    row = {i: float(zi), j: float(zj)}
    row[k] = row.get(k, 0.0) - zi - zj
    return row


PLANETARY = [willis("sun", 24, "planet", 18, "carrier"), willis("planet", 18, "ring", -60, "carrier")]
CYCLE = [willis("axle", 20, "planet", 20, "cage"), willis("planet", 20, "ring", -60, "cage"), {"axle": 1.0}]
PAWLS = {"R": ("ring", "hub", 1), "P": ("cage", "hub", 1)}
TWIN = [
    *(willis("SUN", 30, "P1", 18, "OUT"), willis("P1", 18, "R1", -66, "OUT")),
    *(willis("SUN", 30, "P2", 18, "C2"), willis("P2", 18, "OUT", -66, "C2")),
    {"IN": 1.0, "R1": -1.0},
]
COGS = [{"chain": 44.0, "a": -18.0}, {"chain": 44.0, "b": 26.0}]
FREEWHEELS = {"A": ("a", "wheel", 1), "B": ("b", "wheel", 1)}
CASES: dict[str, tuple[Any, ...]] = {
    "O1": (SET, None, PLANETARY, {"sun": 1}, {"F": ("", "ring", 1)}, "carrier"),
    "O2 high": (HUB, "high", CYCLE, {"cage": 1}, PAWLS, "hub"),
    "O2 normal": (HUB, "normal", CYCLE, {"ring": 1}, PAWLS, "hub"),
    "O2 low": (HUB, "low", CYCLE, {"ring": 1}, {"P": PAWLS["P"]}, "hub"),
    "O3 first": (SIMPSON, "1", TWIN, {"IN": 1}, {"F": ("", "C2", 1)}, "OUT"),
    "O3 second": (SIMPSON, "2", [*TWIN, {"SUN": 1.0}], {"IN": 1}, {"F": ("", "C2", 1)}, "OUT"),
    "O3 third": (SIMPSON, "3", [*TWIN, {"SUN": 1.0, "IN": -1.0}], {"IN": 1}, {"F": ("", "C2", 1)}, "OUT"),
    "O4 ahead": (RETRO, "ahead", COGS, {"chain": 1}, FREEWHEELS, "wheel"),
    "O4 back": (RETRO, "back", COGS, {"chain": -1}, FREEWHEELS, "wheel"),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", CASES)
def test_bodies_of_any_inertia_settle_in_the_chosen_pattern_by_gauss_least_constraint(name: str, seed: int) -> None:
    text, state, rows, given, clutches, output = CASES[name]
    train = geartrain.load(text)
    speeds, holding = settle(rows, given, clutches, output, seed, 1e-6)
    assert holding == {each.name for each in actions(train, state).values() if each.holds}
    answer = train.solve(state)
    for link, speed in speeds.items():
        assert speed == pytest.approx(float(answer.speeds[link]), abs=1e-6)


BASE = """
frame: f
links:
  f: {}
  sun: {wheels: {s: 24, s2: 30}}
  planet: {wheels: {p: 18}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  carrier: {wheels: {r2: {teeth: 54, internal: true}}}
  planet 2: {wheels: {q: 12}}
  c2: {}
revolutes: {main: [f, sun, ring, carrier, c2], P: [carrier, planet], Q: [c2, planet 2]}
gears: [s ~ p, p ~ r, s2 ~ q, q ~ r2]
"""
DOUBLE = [
    *PLANETARY,
    willis("sun", 30, "planet 2", 12, "c2"),
    willis("planet 2", 12, "carrier", -54, "c2"),
]


def is_possible(rows: Sequence[Mapping[str, float]], given: Mapping[str, float], one_way: Mapping[str, Any]) -> bool:
    """Return True if speeds satisfy the equations and the inequalities of the clutches, by linear programming."""
    from scipy.optimize import linprog

    links = sorted({link for row in rows for link in row})
    equal = [[row.get(link, 0.0) for link in links] for row in [*rows, *({link: 1.0} for link in given)]]
    above = [[sense * ((link == b) - (link == a)) for link in links] for a, b, sense in one_way.values()]
    right = [0.0] * len(rows) + [float(speed) for speed in given.values()]
    signs = -np.array(above, dtype=float)
    found = linprog([0.0] * len(links), signs, np.zeros(len(above)), equal, right, (None, None))
    return bool(found.status == 0)


@pytest.mark.parametrize("seed", range(40))
def test_random_clutches_in_two_planetary_sets_agree_with_gauss_least_constraint(seed: int) -> None:
    draw = random.Random(seed)
    main = ["sun", "ring", "carrier", "c2"]
    source, output = draw.sample(main, 2)
    speed, one_way = draw.choice((1, -1)), {}
    for name in [f"K{at}" for at in range(draw.randint(1, 4))]:
        ends = ["", draw.choice([link for link in main if link != source])]
        one_way[name] = (*(ends if draw.random() < 0.5 else draw.sample(main, 2)), draw.choice((1, -1)))
    clutches = {
        name: ({"locks": [a, b]} if a else {"fixes": b}) | {"one_way": "forward" if sense > 0 else "backward"}
        for name, (a, b, sense) in one_way.items()
    }
    base = geartrain.load(BASE)
    train = base.with_changes(clutches=clutches, outputs={output: {}}, inputs={source: speed})
    answer, close = train.solve(), 0.05
    assert (answer.verdict.kind in ("locked", "contradictory")) == (not is_possible(DOUBLE, {source: speed}, one_way))
    if answer.verdict.kind in ("locked", "contradictory"):
        return
    speeds, holding = settle(DOUBLE, {source: speed}, one_way, output, seed, close)
    if answer.verdict.kind == "free":
        # nothing drives the output, so that its load stops it
        assert abs(speeds[output]) < close
        return
    # an output that its load stops comes to rest slowly
    assert {link: float(answer.speeds[link]) for link in speeds} == pytest.approx(speeds, abs=4 * close)
    assert holding == {each.name for each in actions(train).values() if each.holds}


def test_a_speed_that_varies_within_a_turn_is_noted() -> None:
    train = geartrain.load(
        ROCKER.replace("pin_follower", "pin_and_slot").replace("pin_radius: 6 mm", "pin_radius: 20 mm")
    )
    assert train.solve()["h"] == 1
    (note,) = [each for each in notes(train) if "mean speeds" in each]
    assert note == "A is decided by mean speeds, but crank~rocker varies within a turn"


def test_more_than_twelve_clutches_in_one_state_are_refused() -> None:
    clutches = {f"K{at}": {"fixes": "ring", "one_way": "forward"} for at in range(13)}
    with pytest.raises(geartrain.DeclarationError, match="13 one-way clutches are active"):
        geartrain.load(SET).with_changes(clutches={**clutches, "F": None}).solve()
