"""Links that are held or locked together are one body: every joint between them is closed, wherever its axis lies."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from commands import call
from test_buildability import SPIDER

from geartrain import GearTrain, GearTrainError, load

DIFFERENTIAL = SPIDER.replace("inputs: {left: 1, right: 3}\n", "")
SHAFTS = """
links: {frame: {}, a: {}, b: {}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
"""

# an arm with a planet on it, and a moon on the planet; an arm beside it
NESTED: dict[str, Any] = {
    "links": {"frame": {}, "arm": {}, "planet": {}, "moon": {}, "comet": {}, "other": {}, "far": {}},
    "revolutes": [
        {"pair": ["frame", "arm"], "axis": "main"},
        {"pair": ["arm", "planet"], "axis": "P"},
        {"pair": ["planet", "moon"], "axis": "M"},
        {"pair": ["moon", "comet"], "axis": "C"},
        {"pair": ["frame", "other"], "axis": "beside"},
        {"pair": ["other", "far"], "axis": "F"},
    ],
    "inputs": {"arm": 1},
}


def nested(**more: Any) -> GearTrain:
    return load({**NESTED, **more})


def test_a_spider_held_to_the_case_holds_the_crown() -> None:
    verdict = load(DIFFERENTIAL + "fixed: [spider]\ninputs: {left: 1}\n").solve().verdict
    assert verdict.kind == "locked"
    assert verdict.prescriptions == ("'spider' is fixed", "left = 1")
    assert "'spider' is fixed, which fixes 'crown'" in verdict.text
    assert "'spider' is fixed, which locks 'spider' and 'crown' together" in verdict.text
    free = load(DIFFERENTIAL + "fixed: [spider]\ninputs: {}\n").solve()
    assert free.verdict.kind == "locked"


def test_a_brake_says_by_which_clutch_it_holds(accepted: Callable[[str], GearTrain]) -> None:
    text = "clutches: {B: {fixes: spider}}\nstates: {held: {engaged: [B]}, open: {}}\ninputs: {left: 1, right: 3}\n"
    train = accepted(DIFFERENTIAL + text)
    assert train.solve("open")["crown"] == 2
    assert "'spider' is fixed by B, which fixes 'crown'" in train.solve("held").verdict.text


@pytest.mark.parametrize("axes", ["", "axes: {A: {direction: [1, 0, 0]}, B: {direction: [0, 0, 1]}}\n"])
def test_two_shafts_on_different_axes_that_are_locked_together_stand(axes: str) -> None:
    text = SHAFTS + axes + "locks: [[a, b]]\n"
    verdict = load(text + "inputs: {a: 1}\n").solve().verdict
    assert (verdict.kind, verdict.prescriptions) == ("locked", ("'a' and 'b' are locked together", "a = 1"))
    assert "'a' and 'b' are locked together, which fixes 'a'" in verdict.text
    assert load(text).solve().verdict.kind == "locked"
    assert "block the joints a - frame, frame - b" in load(text).build_findings[0].problem.why


def test_two_shafts_on_one_axis_that_are_locked_together_turn_as_one() -> None:
    train = load(SHAFTS.replace("axis: B", "axis: A") + "locks: [[a, b]]\ninputs: {a: 1}\n")
    assert train.solve()["b"] == 1
    assert not train.build_findings


def test_two_labels_at_one_place_are_one_axis() -> None:
    place = "{A: {position: [1 mm, 2 mm, 0 mm]}, B: {position: [1 mm, 2 mm, 7 mm], direction: [0, 0, -1]}}"
    train = load(SHAFTS + f"axes: {place}\nlocks: [[a, b]]\ninputs: {{a: 1}}\n")
    assert train.solve()["b"] == -1  # B points down, and the two turn as one


def test_a_planet_held_to_the_frame_holds_its_carrier() -> None:
    verdict = nested(fixed=["planet"]).solve().verdict
    assert verdict.kind == "locked"
    assert "'planet' is fixed, which fixes 'arm'" in verdict.text


def test_a_moon_held_to_the_frame_holds_what_carries_it() -> None:
    answer = nested(fixed=["moon"], inputs={"other": 1}).solve()
    assert {link for link, speed in answer.speeds.items() if speed == 0} == {"frame", "arm", "planet", "moon"}


def test_a_planet_locked_to_its_carrier_rides_on_it() -> None:
    assert nested(locks=[["planet", "arm"]]).solve(output="planet")["planet"] == 1


def test_what_is_held_already_does_not_count_as_an_axis() -> None:
    train = nested(fixed=["arm", "other"], locks=[["planet", "far"]], inputs={})
    assert train.solve().speeds["planet"] == 0
    with pytest.raises(GearTrainError, match="would form a linkage"):
        nested(locks=[["planet", "far"]])


@pytest.mark.parametrize("more", [{"fixed": ["comet"]}, {"locks": [["planet", "far"]]}])
def test_four_axes_in_a_ring_are_a_linkage_and_refused(more: dict[str, Any]) -> None:
    with pytest.raises(GearTrainError, match="a closed chain of 4 turning pairs may move") as refused:
        nested(**more)
    (problem,) = refused.value.problems
    assert problem.place == f"{next(iter(more))}[0]"
    assert problem.fix


def ring(*axes: tuple[list[int], list[int]]) -> dict[str, Any]:
    """A chain of links on the frame, the last one fixed, with an axis for each: direction and position in mm."""
    links = ["frame", *(f"L{at}" for at in range(len(axes)))]
    return {
        "links": {link: {} for link in links},
        "revolutes": [{"pair": list(links[at : at + 2]), "axis": f"A{at}"} for at in range(len(axes))],
        "axes": {
            f"A{at}": {"direction": direction, "position": [f"{part} mm" for part in position]}
            for at, (direction, position) in enumerate(axes)
        },
        "fixed": [links[-1]],
    }


X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def test_four_axes_whose_positions_show_that_they_cannot_move_are_rigid() -> None:
    assert load(ring((Z, [0, 0, 0]), (X, [5, 1, 2]), (Y, [1, 7, 3]), (Z, [9, 4, 0]))).solve().verdict.kind == "locked"


@pytest.mark.parametrize(
    "axes",
    [
        ((Z, [0, 0, 0]), (Z, [5, 1, 2]), (Z, [1, 7, 3]), (Z, [9, 4, 0])),  # a four-bar linkage
        ((Z, [0, 0, 0]), (X, [0, 0, 0]), (Y, [0, 0, 0]), ([1, 1, 1], [0, 0, 0])),  # one on a sphere
        ((Z, [0, 0, 0]), (Z, [5, 0, 0]), (Z, [0, 0, 3])),  # the last axis lies where the first does, in this pose
    ],
)
def test_axes_that_may_move_where_they_lie_are_refused(axes: Any) -> None:
    with pytest.raises(GearTrainError, match="would form a linkage"):
        load(ring(*axes))


def test_three_axes_in_a_row_are_a_flat_triangle_and_hold() -> None:
    assert load(ring((Z, [0, 0, 0]), (Z, [5, 0, 0]), (Z, [7, 0, 0]))).solve().verdict.kind == "locked"


@pytest.mark.parametrize("kind", ["pin_and_slot", "pin_follower"])
def test_a_pin_in_a_slot_across_axes_that_are_not_parallel_is_refused(kind: str) -> None:
    text = SHAFTS + f"couplings: [{{kind: {kind}, pin: a, slot: b}}]\ninputs: {{a: 1}}\n"
    assert load(text).solve()["b"] == (1 if kind == "pin_and_slot" else 0)
    with pytest.raises(GearTrainError, match="axes 'A' of its pin and 'B' of its slot are not parallel"):
        load(text + "axes: {A: {direction: [1, 0, 0]}}\n")


def test_what_cannot_be_built_is_told_of_all_states_at_once() -> None:
    states = {"one": {"fixed": ["comet"]}, "two": {"locks": [["planet", "far"]]}, "three": {"fixed": ["comet"]}}
    with pytest.raises(GearTrainError) as refused:
        nested(states=states)
    places = [problem.place for problem in refused.value.problems]
    assert places == ["states.one.fixed[0]", "states.two.locks[0]", "states.three.fixed[0]"]


def test_the_equations_hold_a_rigid_connection_joint_by_joint() -> None:
    train = nested(fixed=["planet"])
    rows = {row.label: row.terms for row in train.equations().equations if row.kind in ("fixed", "lock")}
    assert rows == {"fixed arm": (("arm", 1),), "lock planet arm": (("planet", 1), ("arm", -1))}


def test_a_crown_held_with_its_spider_takes_the_torque_about_both_axes() -> None:
    text = DIFFERENTIAL + "locks: [[spider, crown]]\ninputs: {left: 1}\nloads: {right: -3 N m}\n"
    train = load(text)
    assert train.solve()["right"] == 1
    assert train.torques().external["left"] == Fraction(3)


@pytest.mark.parametrize(
    "given", ["inputs: {left: 1, spider: 0}", "inputs: {left: 1}\nstates: {s: {inputs: {spider: 1}}}"]
)
def test_an_input_on_a_link_whose_axis_moves_is_refused(given: str) -> None:
    with pytest.raises(GearTrainError, match="the input 'spider' does not turn about a single axis") as refused:
        load(DIFFERENTIAL + given + "\n")
    assert refused.value.problems[0].place.startswith("text:")


def test_a_load_on_a_link_whose_axis_moves_is_not_balanced() -> None:
    text = "inputs: {left: 1, right: 3}\nloads: {crown: -2 N m, spider: 1 N m}\nsolve_for: left\n"
    verdict = load(DIFFERENTIAL + text).torques().verdict
    assert (verdict.kind, bool(verdict)) == ("undecided", False)
    assert "a torque on 'spider' has no unique axis" in verdict.text
    assert load(DIFFERENTIAL + text).driven("spider", "left").verdict.kind == "undecided"


# the frame, an arm with a planet and a moon; two shafts beside it. Locks of planet and far make a ring of four axes
STATES = """
links: {frame: {}, arm: {}, planet: {wheels: {p: 20}}, moon: {}, sun: {wheels: {s: 40}}, other: {}, far: {}}
revolutes: {main: [frame, arm, sun], P: [arm, planet], M: [planet, moon], beside: [frame, other], F: [other, far]}
gears: [s ~ p]
inputs: {arm: 1}
loads: {planet: -2 N m}
outputs: {planet: {}}
clutches:
  {A: {fixes: sun}, B: {locks: [planet, far]}, D: {fixes: other}, E: {locks: [other, far]}, N: {locks: [moon, planet]}}
states:
  good: {engaged: [A, N, D, E], outputs: {planet: {expect: 3}}}
  bad: {engaged: [A, B, N]}
  twice: {engaged: [A, N, D, E], inputs: {arm: 2}, outputs: {planet: {expect: 6}}}
"""


def test_a_state_that_makes_a_linkage_leaves_the_other_states_answered() -> None:
    train = load(STATES)
    assert [answer.verdict.kind for answer in train.answers()] == ["determined", "refused", "determined"]
    assert [train.solve(state)["planet"] for state in ("good", "twice")] == [3, 6]  # 1 + 40/20 of the arm
    refused = train.solve("bad")
    assert "would form a linkage" in refused.verdict.text
    assert "fix or lock a link in between (arm, other)" in refused.verdict.text
    assert (refused.speeds, refused.outputs["planet"].speed, bool(refused)) == ({}, None, False)
    assert train.kinematics.usable_states == ("good", "twice")
    assert train.torques("good").verdict
    with pytest.raises(GearTrainError, match="would form a linkage"):
        train.torques("bad")
    with pytest.raises(GearTrainError, match="would form a linkage"):
        load(STATES.replace("[A, N, D, E]", "[A, B]"))  # no state is left


def test_an_input_without_an_axis_of_its_own_refuses_its_state_alone() -> None:
    train = load(DIFFERENTIAL + "states: {a: {inputs: {left: 1, right: 3}}, b: {inputs: {spider: 1}}}\n")
    assert train.solve("a")["crown"] == 2
    assert train.solve("b").verdict.kind == "refused"
    assert "does not turn about a single axis" in train.solve("b").verdict.text


@pytest.mark.parametrize(
    "verb", ["check", "solve", "report", "gearbox", "torques", "inspect formula", "inspect equations", "strength"]
)
def test_every_command_judges_each_state_by_itself(verb: str, tmp_path: Path) -> None:
    path = tmp_path / "states.yaml"
    path.write_text(STATES, encoding="utf-8")
    done = call(*verb.split(), path)
    assert done.exit_code in (0, 1), done.output
    assert "would form a linkage" in " ".join(done.output.split()) or verb == "gearbox"
    if verb in ("check", "solve", "report", "gearbox"):
        assert done.exit_code == 1
    if verb != "check":
        assert "good" in done.output
        assert "twice" in done.output
