"""Every kinematic case of the collection: speeds of every link, counts, carriers, ratios; what contradicts or locks."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import pytest
from places import DATA

from geartrain import GearTrain, load

CASES = json.loads((DATA / "cases.json").read_text(encoding="utf-8"))
KINEMATIC = {case["id"]: case for case in CASES["kinematic"]}
REJECT = {case["id"]: case for case in CASES["reject"]}
STATES = [(name, state["name"]) for name, case in KINEMATIC.items() for state in case["states"]]


def declaration(case: Mapping[str, Any]) -> dict[str, Any]:
    """A case in the keys of a declaration: a wheel of its own for each end of each gear pair."""
    links: dict[str, dict[str, Any]] = {link: {"wheels": {}} for link in case["links"]}
    gears = []
    for at, gear in enumerate(case["gears"]):
        if isinstance(gear, list):
            gear = dict(zip(("i", "j", "zi", "zj", "type"), gear, strict=True))
        ring = gear["type"] == "internal"
        links[gear["i"]]["wheels"][f"i{at}"] = {"teeth": gear["zi"], "internal": ring}
        links[gear["j"]]["wheels"][f"j{at}"] = gear["zj"]
        gears.append({"id": f"G{at}", "pair": [f"i{at}", f"j{at}"]})
    return {
        "frame": case.get("frame", "0"),
        "links": links,
        "revolutes": [{"pair": [a, b], "axis": axis} for a, b, axis in case["revolutes"]],
        "gears": gears,
        "states": {
            state["name"]: {
                "fixed": state["fixed"],
                "locks": state["locks"],
                "inputs": {link: Fraction(speed) for link, speed in state["inputs"].items()},
            }
            for state in case.get("states", ())
        },
        **({"inputs": case["given"]} if "given" in case else {}),
    }


@pytest.mark.parametrize("name", KINEMATIC)
def test_mobility_rank_and_redundancy_are_those_of_the_collection(name: str) -> None:
    case = KINEMATIC[name]
    mobility = GearTrain.declare(declaration(case)).mobility
    assert mobility.by_rank == case["mobility"]
    assert mobility.rank == case["rank"]
    assert mobility.redundant == case["redundant_gear_constraints"]
    assert mobility.by_count == case["mobility_formula_jR_minus_jG"]


@pytest.mark.parametrize("name", KINEMATIC)
def test_carrier_and_signed_ratio_of_every_circuit(name: str) -> None:
    case = KINEMATIC[name]
    circuits = GearTrain.declare(declaration(case)).circuits
    assert [(c.i, c.j, c.carrier, c.ratio) for c in circuits] == [
        (gear["i"], gear["j"], gear["carrier"], Fraction(gear["tau"])) for gear in case["gears"]
    ]


def _state(name: str, state: str) -> Mapping[str, Any]:
    return next(one for one in KINEMATIC[name]["states"] if one["name"] == state)


@pytest.mark.parametrize(("name", "state"), STATES)
def test_every_link_turns_as_the_collection_says(name: str, state: str) -> None:
    given = _state(name, state)
    answer = GearTrain.declare(declaration(KINEMATIC[name])).solve(state)
    assert answer.verdict.kind == "determined"
    assert dict(answer.speeds) == {link: Fraction(speed) for link, speed in given["speeds"].items()}


def _published() -> Iterator[Any]:
    for name, state in STATES:
        given = _state(name, state)
        for link, speed in given.get("published_speeds", {}).items():
            yield pytest.param(name, state, link, Fraction(speed), Fraction(0), False, id=f"{name}-{state}-{link}")
        if "published_ratio" in given:
            ratio, bound = Fraction(str(given["published_ratio"])), Fraction(str(given["published_tol"]))
            yield pytest.param(name, state, given["output"], ratio, bound, True, id=f"{name}-{state}-ratio")


@pytest.mark.parametrize(("name", "state", "link", "value", "bound", "as_ratio"), list(_published()))
def test_published_figures_hold_at_their_digits(
    name: str, state: str, link: str, value: Fraction, bound: Fraction, as_ratio: bool
) -> None:
    speed = GearTrain.declare(declaration(KINEMATIC[name])).solve(state)[link]
    found = 1 / Fraction(speed) if as_ratio else Fraction(speed)
    assert abs(found - value) <= bound


@pytest.mark.parametrize(("name", "state"), STATES)
def test_freedom_of_each_state_is_links_less_one_less_rank_with_brakes(name: str, state: str) -> None:
    given = _state(name, state)
    data = declaration(KINEMATIC[name])
    data["inputs"], states = {}, data.pop("states")
    data |= {key: states[state][key] for key in ("fixed", "locks")}
    verdict = GearTrain.declare(data).solve().verdict
    assert verdict.kind == "free"
    assert len(verdict.fixes) == given["state_mobility"]


def test_over_specified_speeds_are_contradictory_and_the_prescriptions_are_named() -> None:
    verdict = load(declaration(REJECT["R11"])).solve().verdict
    assert verdict.kind == "contradictory"
    assert {text.split(" = ")[0] for text in verdict.prescriptions} == {"S", "C", "R"}
    # 30 S + 78 R must be 108 C: 30 + 156 - 108 leaves 78, or 13 when the common factor 6 is taken out
    assert "13" in verdict.text


def test_under_specified_speeds_leave_c_r_and_p_undetermined() -> None:
    verdict = load(declaration(REJECT["R12"])).solve().verdict
    assert verdict.kind == "free"
    assert set(verdict.links) == {"C", "R", "P"}
    assert verdict.text.startswith("1 of 2 degrees of freedom prescribed")
    assert len(verdict.fixes) == 1


@pytest.mark.parametrize("name", ["K45", "K46"])
@pytest.mark.parametrize("driven", [True, False])
def test_a_gridlocked_train_is_locked_with_its_loop_driven_or_not(name: str, driven: bool) -> None:
    data = declaration(KINEMATIC[name])
    first = KINEMATIC[name]["gears"][0]["i"]
    train = GearTrain.declare({**data, "inputs": {first: 1} if driven else {}})
    verdict = train.solve().verdict
    assert verdict.kind == "locked"
    (loop,) = verdict.loops
    # round the triangle: (-3/2)(-4/3)(-1/2) = -1; between the two meshes of the layshaft: 20/21 or its inverse
    assert loop.product in ({Fraction(-1)} if name == "K45" else {Fraction(20, 21), Fraction(21, 20)})
    assert set(train.mobility.still) == set(data["links"]) - {"0"}


def test_the_loops_that_close_are_named() -> None:
    (loop,) = GearTrain.declare(declaration(KINEMATIC["K44"])).mobility.loops
    assert set(loop.links) == {"a", "b", "c", "d"}
    assert loop.product == 1
    planets = GearTrain.declare(declaration(KINEMATIC["K43"])).mobility
    assert len(planets.loops) == 2
    assert all(loop.product == 1 and loop.carrier == "C" for loop in planets.loops)
