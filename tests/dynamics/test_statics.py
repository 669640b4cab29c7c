"""Torques follow from equilibrium, whether speeds do or not: open differentials, loads that do not balance, locks.

Loads in equilibrium are made here by hand: any numbers for the forces between teeth, and from the rows of the naive
solver the torques they ask of every link.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from commands import call
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from models import torque_figures, torque_page
from reference_solver import echelon, is_a_linkage, rigid_rows, solve_naively, willis_rows
from strategies import Data, trains

from geartrain import GearTrain, load
from geartrain.dynamics import Torques

AXLE = """
links:
  frame: {{}}
  left: {{wheels: {{x: {{teeth: 20, kind: bevel}}}}}}
  right: {{wheels: {{y: {{teeth: 20, kind: bevel, facing: -1}}}}}}
  case: {{}}
  spider: {{wheels: {{p: {{teeth: 12, kind: bevel}}}}}}
axes: {{P: {{direction: [0, 1, 0]}}}}
revolutes: {{A: [frame, left, right, case], P: [case, spider]}}
gears: [{{id: L, pair: [x, p]{pair}}}, {{id: R, pair: [p, y]}}]
inputs: {{{inputs}}}
loads: {{{loads}}}
outputs: {{left: {{}}, right: {{}}}}
{rest}
"""


def axle(inputs: str, loads: str, rest: str = "", pair: str = "") -> GearTrain:
    return load(AXLE.format(inputs=inputs, loads=loads, rest=rest, pair=pair))


def planetary(rest: str) -> GearTrain:
    text = """
links:
  frame: {}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  ring: {wheels: {r: {teeth: 60, internal: true}}}
  arm: {}
revolutes: {A: [frame, sun, ring, arm], P: [arm, planet]}
gears: [{pair: [s, p]}, {pair: [p, r]}]
"""
    return load(text + rest)


def test_an_open_differential_with_equal_loads_is_determined_though_its_wheels_are_free() -> None:
    train = axle("case: 1", "left: -10 N m, right: -10 N m")
    assert train.solve().verdict.kind == "free"
    found = train.torques()
    assert found.verdict.kind == "determined"
    assert "left, right, spider turn freely" in found.verdict.text
    assert found.external == {"left": -10, "right": -10, "case": 20}
    assert found.powers == {"case": 20}
    assert found.efficiency is found.circulating is None
    # the spider's pinion is pushed by 10 N m times 12/20 from both sides
    assert {abs(pair.torques[side]) for pair, side in zip(found.pairs.values(), (1, 0), strict=True)} == {6}


@pytest.mark.parametrize("inputs", ["case: 1, left: 1", "left: 3, right: -1"])
def test_two_inputs_and_equal_loads_are_decided_by_statics(inputs: str) -> None:
    rest = "" if "case" in inputs else "solve_for: case"
    found = axle(inputs, "left: -10 N m, right: -10 N m", rest).torques()
    assert found.verdict.kind == "determined"
    assert found.external["case"] == 20
    assert sum(found.powers.values()) == 0


def test_naming_the_link_that_is_requested_for_anyway_changes_nothing() -> None:
    loads = "left: -10 N m, right: -10 N m"
    found = axle("case: 1, left: 1", loads, "solve_for: case").torques()
    assert found == axle("case: 1, left: 1", loads).torques()


@pytest.mark.parametrize("number", [2, 3, 4])
def test_spiders_all_round_a_differential_share_its_load(number: int) -> None:
    """Also where the axes of two of them point away from each other."""
    text = AXLE.format(inputs="case: 1", loads="left: -60 N m, right: -60 N m", rest="", pair="")
    found = load(text.replace("spider: {", f"spider: {{copies: {number}, ")).torques()
    assert found.verdict.kind == "determined"
    assert found.external["case"] == 120
    assert len(found.pairs) == 2 * number
    for name, pair in found.pairs.items():
        side, spider = pair.torques[:2] if name.startswith("L") else pair.torques[1::-1]
        assert side == Fraction(60, number)
        assert abs(spider) == side * Fraction(12, 20)
        assert not pair.loose
    assert sum(pair.torques[2] for pair in found.pairs.values()) == -120


def test_where_no_torque_is_named_that_could_hold_the_loads_the_one_that_could_is() -> None:
    found = axle("left: 3, right: -1", "left: -10 N m, right: -10 N m").torques()
    assert found.verdict.kind == "undecided"
    assert found.verdict.candidates == ("case",)
    assert "20 at case" in found.verdict.text


def test_unequal_loads_set_an_open_differential_turning() -> None:
    found = axle("case: 1", "left: -10 N m, right: -9 N m").torques()
    assert found.verdict.kind == "unbalanced"
    assert not found.verdict
    assert "left, right" in found.verdict.text


def test_the_torque_that_a_free_link_would_need_is_told_and_found_when_named() -> None:
    rest = "inputs: {sun: 1}\nloads: {arm: -84 N m}\noutputs: {arm: {}}\n"
    found = planetary(rest).torques()
    assert found.verdict.kind == "unbalanced"
    assert found.verdict.candidates == ("ring",)
    assert "60 at ring" in found.verdict.text
    named = planetary(rest + "solve_for: ring\n").torques()
    assert named.verdict.kind == "determined"
    assert named.external == {"arm": -84, "sun": 24, "ring": 60}
    both = planetary(rest.replace("arm: -84 N m", "arm: -84 N m, ring: 60 N m")).torques()
    assert both.verdict.kind == "determined"
    assert both.external["sun"] == 24


def test_what_is_lost_where_speeds_are_free_is_named() -> None:
    found = axle("case: 1", "left: -10 N m, right: -10 N m", pair=", efficiency: 0.9").torques()
    assert found.verdict.kind == "incomplete"
    assert [(each.what, each.where) for each in found.neglected] == [("losses of pairs", ("L",))]
    assert found.external["case"] == 20


def test_a_bearing_that_turns_nobody_knows_which_way_is_named() -> None:
    text = AXLE.format(inputs="case: 1", loads="left: -10 N m, right: -10 N m", rest="", pair="")
    train = load(text.replace("left: {wheels:", "left: {bearing: 1 N m, wheels:"))
    found = train.torques()
    assert [(each.what, each.where) for each in found.neglected] == [("friction of bearings", ("left",))]
    known = load(text.replace("case: {}", "case: {bearing: 1 N m}")).torques()
    assert known.verdict.kind == "determined"
    assert known.external["case"] == 21
    assert known.bearing_loss == 1


def test_links_that_are_free_may_still_have_one_speed_between_them() -> None:
    """A pair on an arm that nothing drives, and a shaft locked to the arm: against it the pair does not roll."""
    text = """
links: {frame: {}, arm: {}, a: {wheels: {x: 20}}, b: {wheels: {y: 40}}, c: {}}
revolutes: {A: [frame, arm], P: [arm, a], Q: [arm, b], C: [frame, c]}
gears: [{id: G, pair: [x, y], efficiency: 0.5}]
locks: [[a, arm]]
inputs: {c: 1}
loads: {arm: 0}
"""
    found = load(text).torques()
    assert found.verdict.kind == "determined"
    assert found.external == {"c": 0}
    assert found.pairs["G"].rolling == 0
    assert load(text.replace("locks: [[a, arm]]\n", "")).torques().pairs["G"].rolling is None


def columns(data: Data) -> dict[str, dict[str, Fraction]]:
    """By constraint the torque that a unit of it exerts on each link: its row, by the principle of virtual work."""
    rows, _ = willis_rows(data)
    found = {f"row {at}": dict(row) for at, row in enumerate(rows)}
    return found | {f"held {at}": dict(row) for at, row in enumerate(rigid_rows(data))}


def loads_of(data: Data, forces: Mapping[str, Fraction]) -> dict[str, Fraction]:
    """The torques from outside that hold these forces in equilibrium, none on the frame."""
    loads = {link: Fraction(0) for link in data["links"] if link != "frame"}
    for name, row in columns(data).items():
        for link, value in row.items():
            if link != "frame":
                loads[link] -= forces[name] * value
    return loads


def virtual_motions(data: Data, still: list[str]) -> list[dict[str, Fraction]]:
    """A basis of the motions that the constraints leave while some links stand still."""
    links = [link for link in data["links"] if link != "frame"]
    rows = [*columns(data).values(), *({link: Fraction(1)} for link in still)]
    matrix = [[row.get(link, Fraction(0)) for link in links] for row in rows]
    pivots = echelon(matrix, len(links))
    found = []
    for free in (at for at in range(len(links)) if at not in pivots):
        motion = {links[free]: Fraction(1)}
        for row, pivot in zip(matrix, pivots, strict=False):
            if row[free]:
                motion[links[pivot]] = -row[free]
        found.append(motion)
    return found


numbers = st.fractions(-9, 9, max_denominator=4)


@st.composite
def equilibria(draw: st.DrawFn) -> tuple[Data, str, dict[str, Fraction]]:
    """A train that is free or determined, one input whose torque is asked for, and loads that are in equilibrium."""
    data = draw(trains(most=7))
    moving = [link for link in data["links"] if link != "frame"]
    if draw(st.booleans()):
        data["fixed"] = [draw(st.sampled_from(moving))]
    if draw(st.booleans()) and len(moving) > 1:
        data["locks"] = [list(draw(st.permutations(moving))[:2])]
    requested = draw(st.sampled_from(moving))
    data["inputs"] = {requested: Fraction(1)}
    assume(not is_a_linkage(data))
    assume(solve_naively(data).kind in ("free", "determined"))
    loads = loads_of(data, {name: draw(numbers) for name in columns(data)})
    return data, requested, loads


def ask(data: Data, loads: Mapping[str, Fraction]) -> Torques:
    given = {**data, "loads": {link: str(torque) for link, torque in loads.items()}}
    given["inputs"] = {link: str(speed) for link, speed in data["inputs"].items()}
    return GearTrain.declare(json.loads(json.dumps(given))).torques()


@given(equilibria())
@settings(max_examples=150, deadline=None)
def test_the_torque_of_an_input_follows_from_equilibrium_whatever_is_free(found: tuple[Data, str, Any]) -> None:
    data, requested, loads = found
    known = {link: torque for link, torque in loads.items() if link != requested}
    answer = ask(data, known)
    assert answer.verdict, answer.verdict
    # a link that can move has one torque that balances; the others are as given
    assert answer.external.get(requested, 0) == loads[requested]
    braked = {held.links[0] for held in answer.held if len(held.links) == 1}
    acting = {link: torque for link, torque in answer.external.items() if torque and link not in braked}
    assert acting == {link: torque for link, torque in loads.items() if torque and link not in braked}
    # every link is in balance with its pairs, brakes and locks, where these are plain
    if answer.verdict.kind == "determined":
        rest = {link: loads[link] for link in known} | {requested: loads[requested]}
        for pair in answer.pairs.values():
            for link, torque in zip(pair.links, pair.torques, strict=True):
                rest[link] = rest.get(link, Fraction(0)) + torque
        for held in answer.held:
            for link, torque in zip(held.links, held.torques or (), strict=True):
                rest[link] = rest.get(link, Fraction(0)) + torque
        rest.pop("frame", None)
        assert not any(rest.values())


@given(equilibria(), st.data())
@settings(max_examples=100, deadline=None)
def test_loads_that_do_work_in_some_free_motion_are_unbalanced(
    found: tuple[Data, str, Any], draw: st.DataObject
) -> None:
    data, requested, loads = found
    motions = virtual_motions(data, [requested])
    moving = sorted({link for motion in motions for link in motion})
    assume(moving)
    loads = dict(loads)
    loads[draw.draw(st.sampled_from(moving))] += 1
    answer = ask(data, {link: torque for link, torque in loads.items() if link != requested})
    assert answer.verdict.kind == "unbalanced", answer.verdict
    # what it says would help does: it makes every free motion powerless
    for link in answer.verdict.candidates:
        assert any(link in motion for motion in motions)


CLUTCHED = """
links: {frame: {}, a: {}, b: {}, c: {}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: A}, {pair: [frame, c], axis: A}]
clutches: {K: {locks: [a, b]}, S: {fixes: c}}
locks: []
states: {closed: {engaged: [K, S]}}
inputs: {a: 1}
loads: {b: -200 N m, c: 30 N m}
outputs: {b: {}}
"""


def test_a_closed_clutch_and_a_brake_show_what_they_carry(tmp_path: Path) -> None:
    train = load(CLUTCHED)
    found = train.torques("closed")
    brake, lock = found.held
    assert (lock.links, lock.clutch, lock.torques) == (("a", "b"), "K", (-200, 200))
    assert (brake.links, brake.clutch, brake.torques) == (("c",), "S", (-30,))
    page = torque_page(train, found)
    assert "| lock K  | a, b | -200         | 200           |" in page
    assert "| brake S | c    | -30          |               |" in page
    assert "lock K" in str(train.report())
    data = torque_figures(train, "closed").to_dict()
    assert data["held"] == [
        {"links": ["c"], "clutch": "S", "cause": None, "torques": {"c": -30.0}},
        {"links": ["a", "b"], "clutch": "K", "cause": None, "torques": {"a": -200.0, "b": 200.0}},
    ]
    path = tmp_path / "t.yaml"
    path.write_text(CLUTCHED, encoding="utf-8")
    assert json.loads(call("torques", path, "--json").output)["states"][0]["held"] == data["held"]


def test_a_lock_on_an_axis_that_points_back_turns_its_sign_there() -> None:
    """Two shafts on axes that point against each other: what turns the one forwards is negative on the other."""
    text = CLUTCHED.replace("links: {frame: {}, a: {}, b: {}, c: {}}", "links: {frame: {}, a: {}, b: {}}")
    text = text.replace("{pair: [frame, b], axis: A}, {pair: [frame, c], axis: A}", "{pair: [frame, b], axis: B}")
    text = text.replace(", S: {fixes: c}", "").replace("[K, S]", "[K]").replace(", c: 30 N m", "")
    place = "position: [0 mm, 0 mm, 0 mm]"
    text += f"axes: {{A: {{direction: [0, 0, 1], {place}}}, B: {{direction: [0, 0, -1], {place}}}}}\n"
    train = load(text)
    assert train.solve("closed")["b"] == -1
    found = train.torques("closed")
    (lock,) = found.held
    assert lock.torques == (200, 200) == (-found.external["a"], -found.external["b"])
    assert sum(found.powers.values()) == 0


def test_two_locks_side_by_side_share_their_torque_in_no_certain_way() -> None:
    text = CLUTCHED.replace("locks: []", "locks: [[a, b], [a, b]]").replace("engaged: [K, S]", "engaged: [S]")
    found = load(text).torques("closed")
    assert found.verdict.kind == "indeterminate"
    assert [held.torques for held in found.held] == [(-30,), None, None]
    assert found.external["a"] == 200


def test_every_brake_of_a_gearbox_carries_what_the_others_leave() -> None:
    """All torques about the main axis sum to zero in every gear, the brakes' with them."""
    train = load("extends: zf-8hp70\nname: z\nloads: {OUT: -100}\n")
    for state in train.states:
        found = train.torques(state)
        if not found.verdict:
            continue
        assert sum(found.external.values()) == 0
        brakes = {held.links[0]: held for held in found.held if len(held.links) == 1}
        assert all(held.torques is not None for held in found.held)
        assert all(found.external.get(link, 0) == held.torques[0] for link, held in brakes.items() if held.torques)
        assert all(held.clutch for held in found.held)
