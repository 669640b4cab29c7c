"""Gearboxes: published ratios, balance of torques and powers, and every gear that closing elements gives."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations, pairwise

import pytest
import yaml
from places import ROOT
from shipped import train as load

import geartrain
from geartrain import GearTrain
from geartrain.analysis import find_gears
from geartrain.errors import GearTrainError
from geartrain.train import State

PUBLISHED = {
    "zf-8hp70": ([4.6957, 3.1304, 2.1039, 1.6667, 1.2845, 1.0, 0.8392, 0.6667], [-3.2968], 4),
    "ford-10r80": ([4.6957, 2.9851, 2.1462, 1.7690, 1.5201, 1.2751, 1.0, 0.8536, 0.6892, 0.6357], [-4.8661], 4),
    "zf-9hp48": ([4.700, 2.842, 1.909, 1.382, 1.0, 0.808, 0.699, 0.580, 0.479], [-3.805], 3),
    "mercedes-9g-tronic": ([5.3545, 3.2432, 2.2523, 1.6356, 1.2106, 1.0, 0.8651, 0.7167, 0.6015], [-4.7983], 4),
    "gm-4t60": ([2.921, 1.568, 1.0, 0.705], [-2.385], 3),
    "simpson-set": ([2.45, 1.45, 1.0], [-2.2], 2),
    "ravigneaux-set": ([2.4, 1.47, 1.0, 0.67], [-2.0], 2),
}
"""Forward and reverse ratios as printed, and the digits past the point."""


@pytest.mark.parametrize("name", PUBLISHED)
def test_ratios_and_steps_are_the_published_ones(name: str) -> None:
    forward, backward, digits = PUBLISHED[name]
    box = load(name).gearbox()
    found = [each.ratio for each in box.states if each.ratio is not None]
    assert sorted(found, reverse=True) == pytest.approx([*forward, *backward], abs=0.6 * 10**-digits)
    one_way = [each for each in box.states if each.ratio is not None and each.ratio > 0]
    for one, other in pairwise(one_way):
        assert one.step == one.ratio / other.ratio
    assert box.spread == max(found) / min(each for each in found if each > 0)


@pytest.mark.parametrize("name", PUBLISHED)
def test_torques_of_input_output_and_brakes_balance(name: str) -> None:
    """The whole train stands still: what goes in, what comes out and what brakes hold add up to nothing."""
    train = load(name)
    box = train.gearbox()
    brakes = {each.name for each in box.elements if each.kind == "brake"}
    for state in box.states:
        held = [torque for element, torque in state.torques.items() if element in brakes]
        assert all(torque is not None for torque in held)
        assert 1 - state.ratio + sum(torque or 0 for torque in held) == 0, "no losses are declared"
        assert state.efficiency == 1


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_power_of_clutches_balances_the_links_they_join(name: str) -> None:
    """A closed element slips not, and an open one has a slip that is the difference of the links' speeds."""
    train = load(name)
    for state in train.gearbox().states:
        for element, clutch in train.declaration.clutches.items():
            one, other = clutch.locks or (clutch.fixes, None)
            slip = state.speeds[one or ""] - (state.speeds[other] if other else 0)
            assert (slip == 0) if element in state.engaged else (state.slips[element] == slip)


def test_a_simpson_set_in_low_gear_bears_what_textbooks_say() -> None:
    """11/27 in first: the low brake holds the ratio less one, the forward clutch all of the input's torque."""
    box = load("simpson-set").gearbox()
    assert box.states[0].torques == {"forward": Fraction(-1), "low": Fraction(27, 11) - 1}


def test_a_positive_recirculation_is_between_sets_and_not_inside_them() -> None:
    """In reverse the 8HP feeds half of the power back; a single planetary set has none to feed."""
    states = {each.state: each for each in load("zf-8hp70").gearbox().states}
    assert states["R"].recirculating > Fraction(1, 2)
    assert all(each.recirculating == 0 for name, each in states.items() if name != "R")
    ravigneaux = load("ravigneaux-set")
    # the number of planets does not affect the power between the sets
    three = ravigneaux.with_changes(links={planet: {"copies": 3} for planet in ("SHORT", "LONG")})
    assert all(each.recirculating == 0 for train in (ravigneaux, three) for each in train.gearbox().states)


def test_the_mesh_power_is_the_torque_times_the_speed_relative_to_the_carrier() -> None:
    """With the carrier held all power passes each mesh; as one block none does; with the carrier driving, the ring's
    torque 2/3 turns at 1/2 relative to the carrier.
    """
    states = {each.state: each.mesh_power for each in load("ravigneaux-set").gearbox().states}
    assert (states["1"], states["R"], states["3"], states["4"]) == (1, 1, 0, Fraction(1, 3))


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_search_finds_what_solving_every_combination_finds(name: str) -> None:
    """Held against states declared one by one, of every size: fewer leave it free, more hold it or say no more."""
    train = load(name)
    found = find_gears(train)
    elements = list(train.declaration.clutches)
    wanted = {}
    others: dict[str, list[tuple[str, ...]]] = {"free": [], "locked": []}
    for size in range(found.closed + 1):
        for engaged in combinations(elements, size):
            states = {"tried": State(engaged=engaged)}
            answer = GearTrain(train.declaration.model_copy(update={"states": states})).solve()
            if answer.verdict.kind == "determined":
                assert size == found.closed
                out = answer.speeds[found.output]
                wanted[engaged] = 1 / Fraction(out) if out else None
            elif size == found.closed:
                others[answer.verdict.kind].append(engaged)
    assert {gear.engaged: gear.ratio for gear in found.gears} == wanted
    assert {"free": [*found.free], "locked": [*found.locked]} == others
    assert len(found.gears) + len(found.free) + len(found.locked) == found.combinations
    declared = {name for gear in found.gears for name in gear.states}
    assert declared == set(train.states), "the shift table is among them"


@pytest.mark.parametrize("name", PUBLISHED)
@pytest.mark.parametrize("single", [False, True])
def test_series_are_counted_and_chosen_as_by_trying_all(name: str, single: bool) -> None:
    number, window = len(PUBLISHED[name][0]), (Fraction("1.08"), Fraction("1.9"))
    train = load(name)
    found = find_gears(train, gears=number, steps=(1.08, 1.9), single=single)
    forward = [each for each in found.gears if each.ratio is not None and each.ratio > 0]
    every = []
    for chosen in combinations(forward, number):
        ratios = [each.ratio or Fraction(0) for each in chosen]
        steps = [a / b for a, b in pairwise(ratios)]
        swaps = [len({*a.engaged} ^ {*b.engaged}) for a, b in pairwise(chosen)]
        if all(window[0] <= step <= window[1] for step in steps) and (not single or max(swaps) <= 2):
            every.append((ratios[0] / ratios[-1], chosen))
    assert found.series == len(every) > 0
    assert found.widest.spread == max(spread for spread, _ in every)
    assert found.evenest.deviation == pytest.approx(min(_deviation(each) for _, each in every), abs=1e-6)


def test_a_search_of_ten_gears_finds_the_published_table_and_one_other() -> None:
    train = load("ford-10r80")
    found = find_gears(train, gears=10, steps=(1.08, 1.6), single=True)
    assert found.series == 2
    first, *others = [gear.engaged for gear in found.widest.gears]
    states = train.declaration.states
    assert others == [tuple(states[str(gear)].engaged) for gear in range(2, 11)]
    # the shaft between is held to the third carrier, or to the sun of its set: it bears nothing in first gear
    assert first in (tuple(states["1"].engaged), ("A", "B", "C", "E"))
    assert sum(gear.ratio == found.widest.ratios[0] for gear in found.gears) >= 2


def _deviation(chosen: tuple[object, ...]) -> float:
    from math import log
    from statistics import pstdev

    logs = [log(getattr(each, "ratio", 1)) for each in chosen]
    return pstdev([a - b for a, b in pairwise(logs)])


def lepelletier(name: str, r1: int, s1: int, p1: int, s2: int, s3: int, r: int) -> str:
    """Six gears of a planetary set before a Ravigneaux set."""
    return f"""
name: {name}
links:
  case: {{}}
  IN: {{wheels: {{r1: {{teeth: {r1}, internal: true}}}}}}
  S1: {{wheels: {{s1: {s1}}}}}
  C1: {{}}
  S2: {{wheels: {{s2: {s2}}}}}
  S3: {{wheels: {{s3: {s3}}}}}
  C2: {{}}
  OUT: {{wheels: {{r: {{teeth: {r}, internal: true}}}}}}
  P1: {{wheels: {{p1: {p1}}}}}
  SHORT: {{wheels: {{a: 23}}}}
  LONG: {{wheels: {{b: 23}}}}
frame: case
revolutes: {{main: [case, IN, S1, C1, S2, S3, C2, OUT], p: [C1, P1], a: [C2, SHORT], b: [C2, LONG]}}
gears: [r1 ~ p1, p1 ~ s1, s2 ~ a, a ~ b, b ~ s3, b ~ r]
fixed: [S1]
clutches: {{A: {{locks: [C1, S2]}}, B: {{locks: [C1, S3]}}, C: {{fixes: S3}}, D: {{fixes: C2}}, E: {{locks: [IN, C2]}}}}
inputs: {{IN: 1}}
outputs: {{OUT: {{}}}}
states:
  1: {{engaged: [A, D]}}
  2: {{engaged: [A, C]}}
  3: {{engaged: [A, B]}}
  4: {{engaged: [A, E]}}
  5: {{engaged: [B, E]}}
  6: {{engaged: [C, E]}}
  R: {{engaged: [B, D]}}
"""


ZF_6HP26 = lepelletier("ZF 6HP26", 71, 37, 17, 31, 38, 85)
# counts that give the printed ratios at all their digits
GM_6L80 = lepelletier("GM 6L80", 94, 50, 22, 35, 46, 92)
AISIN_TF80 = lepelletier("Aisin TF-80SC", 90, 50, 20, 36, 44, 96)
MODEL_T = """
name: Ford model T
links:
  case: {}
  engine: {}
  shaft: {wheels: {out: 27}}
  slow: {wheels: {s: 21}}
  reverse: {wheels: {v: 30}}
  triple: {wheels: {t27: 27, t33: 33, t24: 24}}
frame: case
revolutes: {main: [case, engine, shaft, slow, reverse], pin: [engine, triple]}
gears: [t27 ~ out, t33 ~ s, t24 ~ v]
clutches: {low: {fixes: slow}, back: {fixes: reverse}, disc: {locks: [engine, shaft]}}
inputs: {engine: 1}
outputs: {shaft: {}}
states: {1: {engaged: [low]}, 2: {engaged: [disc]}, R: {engaged: [back]}}
"""
STURMEY_ARCHER_AW = """
name: Sturmey-Archer AW
links:
  axle: {wheels: {s: 20}}
  sprocket: {}
  cage: {}
  planet: {wheels: {p: 20}, copies: 4}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  hub: {}
frame: axle
revolutes: {main: [axle, sprocket, cage, ring, hub], p: [cage, planet]}
gears: [s ~ p, p ~ r]
clutches:
  cage in: {locks: [sprocket, cage]}
  ring in: {locks: [sprocket, ring]}
  ring out: {locks: [ring, hub]}
  cage out: {locks: [cage, hub]}
inputs: {sprocket: 1}
outputs: {hub: {}}
states:
  low: {engaged: [ring in, cage out]}
  normal: {engaged: [ring in, ring out]}
  high: {engaged: [cage in, ring out]}
"""


@pytest.mark.parametrize(
    ("text", "ratios", "digits"),
    [
        (ZF_6HP26, [4.171, 2.340, 1.521, 1.143, 0.867, 0.691, -3.403], 3),
        (GM_6L80, [4.027, 2.364, 1.532, 1.152, 0.852, 0.667, -3.064], 3),
        (AISIN_TF80, [4.148, 2.370, 1.556, 1.155, 0.859, 0.686, -3.394], 3),
        (MODEL_T, [2.75, 1.0, -4.0], 2),
        (STURMEY_ARCHER_AW, [1 / 0.75, 1.0, 1 / 1.333], 3),
    ],
    ids=["ZF 6HP26", "GM 6L80", "Aisin TF-80SC", "Ford model T", "Sturmey-Archer AW"],
)
def test_other_gearboxes_have_the_printed_ratios(text: str, ratios: list[float], digits: int) -> None:
    train = GearTrain.declare(yaml.safe_load(text))
    found = [state.ratio for state in train.gearbox().states]
    assert found == pytest.approx(ratios, abs=0.6 * 10**-digits)
    gears = {gear.engaged for gear in find_gears(train).gears}
    assert gears >= {tuple(state.engaged) for state in train.declaration.states.values()}


def test_a_train_without_clutches_is_no_gearbox() -> None:
    with pytest.raises(GearTrainError, match="is not a gearbox"):
        load("planetary-24-18-60").gearbox()
    with pytest.raises(GearTrainError, match="unknown output 'OTU'"):
        load("zf-8hp70").gearbox("OTU")


def test_a_state_whose_first_input_is_at_rest_has_the_speeds_that_its_other_input_gives() -> None:
    """A hub that coasts: the sprocket is at rest, the shell turns, and the open clutch slips at its speed."""
    box = geartrain.load(ROOT / "tests/data/public_cases/04-state-with-a-still-input.yaml").gearbox()
    coast = box.states[1]
    assert coast.driven_by == "shell"
    assert coast.speeds == {"axle": 0, "ring": 0, "planet": 0, "cage": 0, "sprocket": 0, "shell": 1}
    assert coast.slips == {"pawls": -1}
    assert coast.ratio is None
    assert "free" not in str(box).split()


def test_an_input_at_rest_beside_another_gives_every_link_its_speed() -> None:
    """A planetary with two inputs in one state: the carrier of 24 and 60 teeth turns at 60/84 of the ring."""
    text = """
    name: two-inputs
    links:
      frame: {}
      sun: {wheels: {s: 24}}
      ring: {wheels: {r: {teeth: 60, internal: true}}}
      planet: {wheels: {p: 18}}
      arm: {}
    revolutes: {main: [frame, sun, ring, arm], P: [arm, planet]}
    gears: [s ~ p, p ~ r]
    clutches: {brake: {fixes: ring}, lock: {locks: [sun, ring]}}
    outputs: {arm: {}}
    states:
      low: {engaged: [brake], inputs: {sun: 1}}
      sun held: {engaged: [], inputs: {sun: 0, ring: 1}}
      at rest: {engaged: [brake], inputs: {sun: 0}}
    """
    low, held, rest = GearTrain.declare(yaml.safe_load(text)).gearbox().states
    assert (low.speeds["arm"], low.ratio) == (Fraction(2, 7), Fraction(7, 2))
    assert (held.speeds["arm"], held.speeds["sun"], held.driven_by, held.ratio) == (Fraction(5, 7), 0, "ring", None)
    assert (set(rest.speeds.values()), rest.driven_by) == ({0}, "")
