"""Tooth numbers in trains: every answer against brute force, by the exact solver or by products written out here."""

from __future__ import annotations

import json
from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import deepcopy
from fractions import Fraction
from itertools import accumulate, product
from math import gcd, prod
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from strategies import driven_trains, ordinary_trains
from yaml import safe_load

import geartrain.search.train.search_passes as passes
from geartrain import GearTrain, GearTrainError, load
from geartrain.errors import QuestionError
from geartrain.kinematics.formulas.output_formulas import find_formulas, with_counts
from geartrain.numerics import Journal, open_executor
from geartrain.search import ConstraintOptions, TrainFindings, search_train
from geartrain.train import Train

Data = dict[str, Any]
Teeth = dict[str, int]
ORDERS = ("error", "total", "largest", "distinct", "change")
FOUR = [(11, 19), (23, 31), (12, 18), (20, 26)]
"""Bounds of the four wheels of two stages."""

# ----------------------------------------------------------------------------------------------- trains and brute force


def free(low: int, high: int) -> Data:
    return {"teeth": {"search": [low, high]}}


def train(meshes: Sequence[tuple[str, str, str, str]], wheels: Data, outputs: Data, **rest: Any) -> Data:
    """An ordinary train of fixed axes: meshes are (link, wheel, link, wheel)."""
    links: Data = {"frame": {}}
    for one, first, other, second in meshes:
        for link, wheel in ((one, first), (other, second)):
            links.setdefault(link, {"wheels": {}})["wheels"][wheel] = wheels[wheel]
    joints = [{"pair": ["frame", link], "axis": f"axis of {link}"} for link in links if link != "frame"]
    gears = [{"pair": [first, second]} for _, first, _, second in meshes]
    moved = {"inputs": {meshes[0][0]: 1}, "outputs": outputs}
    return {"name": "trial", "links": links, "revolutes": joints, "gears": gears, **moved, **rest}


def chain(bounds: Sequence[tuple[int, int]], output: Data) -> Data:
    """Stages a0 b0, a1 b1, ... one after the other; `bounds` of a0, b0, a1, ..."""
    names = [f"{side}{at}" for at in range(len(bounds) // 2) for side in "ab"]
    meshes = [(f"L{at}", f"a{at}", f"L{at + 1}", f"b{at}") for at in range(len(bounds) // 2)]
    wheels = {name: free(*pair) for name, pair in zip(names, bounds, strict=True)}
    return train(meshes, wheels, {f"L{len(bounds) // 2}": output})


def target(speed: object, tolerance: object = None) -> Data:
    """A speed in either sense, as a period is one; all trains here count in turns a day."""
    period = {"period": f"{1 / Fraction(str(speed))} d"}
    return {"targets": [period | ({} if tolerance is None else {"tolerance": str(tolerance)})]}


def signed(speed: object, tolerance: object = None) -> Data:
    return {"targets": [{"speed": str(speed)} | ({} if tolerance is None else {"tolerance": str(tolerance)})]}


def declare(data: Data) -> GearTrain:
    return GearTrain.declare({"unit": {"per": "1 d"}} | {key: part for key, part in data.items() if key != "extends"})


def find(data: Data, **options: Any) -> TrainFindings:
    return search_train(declare(data).declaration, **options)


def boxes(data: Data) -> dict[str, range]:
    found = {}
    for link in data["links"].values():
        for name, wheel in link.get("wheels", {}).items():
            teeth = wheel["teeth"] if isinstance(wheel, dict) else wheel
            if isinstance(teeth, dict):
                found[name] = range(teeth["search"][0], teeth["search"][1] + 1)
    return found


def assignments(data: Data) -> Iterator[Teeth]:
    domains = boxes(data)
    return (dict(zip(domains, counts, strict=True)) for counts in product(*domains.values()))


def errors_by_solving(
    declared: Train, teeth: Teeth, tolerance: Fraction | None, idle: frozenset[str] = frozenset()
) -> Fraction | None:
    """The largest |error| of the outputs by the ordinary solver; None where anything asked is not met."""
    solver = GearTrain(with_counts(declared, teeth))
    errors = [Fraction(0)]
    for name in declared.outputs:
        answer = solver.solve(output=name, method="exact")
        if not answer.verdict:
            return None
        if name in idle:
            continue
        result = answer.outputs[name]
        requested = [one for one in result.targets if one.met is not None]
        figures = [one.value.value for one in (result.output.expect, result.output.published) if one is not None]
        if not result.holds or not all(one.met for one in requested):
            return None
        if not requested and result.targets and (tolerance is not None or not figures):
            requested = [result.targets[0]]
            if requested[0].compared == "speed" and result.speed * requested[0].speed < 0:
                return None  # as near as may be is on the side asked for
            if tolerance is not None and abs(Fraction(requested[0].error)) > tolerance:
                return None
        assert isinstance(result.speed, Fraction)
        errors += [abs(Fraction(one.error)) for one in requested]
        if not requested:
            errors += [abs(result.speed / value - 1) if value else abs(result.speed) for value in figures]
    return max(errors)


def by_solving(data: Data, tolerance: Fraction | None = None) -> list[tuple[Teeth, Fraction]]:
    """All solutions with their errors, in the order of the box."""
    declared = declare(data).declaration
    judged = ((teeth, errors_by_solving(declared, teeth, tolerance)) for teeth in assignments(data))
    return [(teeth, error) for teeth, error in judged if error is not None]


def ordered(found: Sequence[tuple[Teeth, Fraction]], by: str, declared: Mapping[str, int]) -> list[Teeth]:
    """Solutions as the search is to list them."""

    def key(one: tuple[Teeth, Fraction]) -> tuple[Any, ...]:
        teeth, error = one
        counts = tuple(teeth.values())
        first = {
            "error": error,
            "total": sum(counts),
            "largest": max(counts),
            "distinct": len(set(counts)),
            "change": sum(count != declared.get(wheel, count) for wheel, count in teeth.items()),
        }[by]
        return first, error, sum(counts), max(counts), counts

    return [teeth for teeth, _ in sorted(found, key=key)]


def listed(found: TrainFindings) -> list[Teeth]:
    (part,) = found.parts
    return [dict(one.teeth) for one in part.solutions]


def tallies_add_up(found: TrainFindings) -> bool:
    return all(
        sum(part.shortfall.removed.values()) + part.count == part.considered == part.shortfall.considered
        for part in found.parts
    )


# --------------------------------------------------------------------------------------------------------------- chains


def quotients_within(counts: range, size: int, wanted: Fraction, share: Fraction) -> int:
    """By hand: products of counts with their ways, and for each one beneath the run of those on top."""
    ways = Counter({1: 1})
    for _ in range(size):
        grown: Counter[int] = Counter()
        for value, count in product(ways, counts):
            grown[value * count] += ways[value]
        ways = grown
    values = sorted(ways)
    sums = list(accumulate((ways[value] for value in values), initial=0))
    low, high = wanted * (1 - share), wanted * (1 + share)
    found = 0
    for beneath in values:
        first = bisect_left(values, -(-low.numerator * beneath // low.denominator))
        last = bisect_right(values, high.numerator * beneath // high.denominator)
        found += ways[beneath] * (sums[last] - sums[first])
    return found


def test_six_free_wheels_are_counted_without_listing_their_eighty_billion_assignments() -> None:
    wanted, share = Fraction(13368267, 10**6), Fraction(1, 10**6)
    found = find(chain([(15, 80)] * 6, target("13.368267", "1e-6")))
    assert found.count == quotients_within(range(15, 81), 3, wanted, share) == 1032
    assert found.considered == 66**6
    assert found.complete
    assert found.ranked
    errors = [one.error for one in found.solutions]
    assert errors == sorted(errors)
    for one in found.solutions:
        ratio = Fraction(prod(one.teeth[f"a{at}"] for at in range(3)), prod(one.teeth[f"b{at}"] for at in range(3)))
        assert abs(ratio / wanted - 1) == one.error <= share


def test_numbers_of_assignments_beyond_a_machine_word_are_exact() -> None:
    found = find(chain([(11, 14)] * 32, target("1", "1/2")), best=1)
    assert found.count == quotients_within(range(11, 15), 16, Fraction(1), Fraction(1, 2))
    assert found.considered == 4**32 > 2**62


def test_wheels_driven_and_driving_are_idlers_whose_counts_do_not_matter() -> None:
    meshes = [("A", "a", "B", "b"), ("B", "b", "C", "c")]
    found = find(train(meshes, {"a": free(20, 30), "b": free(10, 12), "c": free(40, 60)}, {"C": target("1/2", 0)}))
    assert [part.wheels for part in found.parts] == [("a", "c"), ("b",)]
    assert [part.count for part in found.parts] == [11, 3]
    assert found.count == 33
    assert found.parts[1].demands == ()


# ------------------------------------------------------------------------------------ several outputs, epicyclic trains


def two_outputs() -> Data:
    meshes = [("A", "a", "B", "b"), ("B", "c", "C", "d"), ("B", "e", "D", "f")]
    wheels = {name: free(12, 17) for name in "abcdef"}
    return train(meshes, wheels, {"C": target("7/8", "1/50"), "D": target("10/9", "1/50")})


def test_outputs_without_wheels_in_common_are_parts_whose_counts_multiply() -> None:
    meshes = [("A", "x", "B", "y"), ("B", "a", "C", "b"), ("B", "c", "D", "d")]
    wheels = {"x": 20, "y": 40} | {name: free(12, 40) for name in "abcd"}
    found = find(train(meshes, wheels, {"C": target("1/3", "1e-3"), "D": target("2/7", 0)}), best=4)
    assert [(part.wheels, part.outputs) for part in found.parts] == [(("a", "b"), ("C",)), (("c", "d"), ("D",))]
    first = sum(abs(Fraction(3 * a, 2 * b) - 1) <= Fraction(1, 1000) for a in range(12, 41) for b in range(12, 41))
    second = sum(Fraction(c, d) == Fraction(4, 7) for c in range(12, 41) for d in range(12, 41))
    assert [part.count for part in found.parts] == [first, second]
    assert found.count == first * second
    whole = found.solutions
    assert len(whole) == 4
    assert [one.measure("error") for one in whole] == sorted(one.measure("error") for one in whole)
    assert set(whole[0].teeth) == set("abcd")


def reverted(bounds: Sequence[tuple[int, int]], output: Data) -> Data:
    """Two stages whose last arbor is on the axis of the first."""
    data = chain(bounds, output)
    data["revolutes"][2]["axis"] = data["revolutes"][0]["axis"]
    return data


def test_a_reverted_train_has_one_centre_distance() -> None:
    truth = [
        (a, b, c, d)
        for a, b, c in product(range(12, 41), repeat=3)
        if 12 <= (d := a + b - c) <= 40 and gcd(a, b) == gcd(c, d) == 1
        if abs(Fraction(6 * a * c, b * d) - 1) <= Fraction(1, 50)
    ]
    found = find(reverted([(12, 40)] * 4, target("1/6", "1/50")), rules=ConstraintOptions(hunting=True), best=10**4)
    assert sorted(tuple(one.values()) for one in listed(found)) == sorted(truth)
    assert found.count == len(truth) > 0
    assert tallies_add_up(found)
    assert list(found.parts[0].rules) == [
        "coaxial closure: a0 + b0 = a1 + b1",
        *(f"hunting tooth: 'a{at}' and 'b{at}' have no common divisor" for at in range(2)),
    ]


def test_a_loop_of_free_wheels_must_close() -> None:
    meshes = [("A", "a", "B", "b"), ("B", "c", "C", "d"), ("A", "e", "C", "f")]
    wheels = {"a": free(10, 14), "b": 20, "c": free(10, 14), "d": 12, "e": free(8, 12), "f": free(20, 24)}
    data = train(meshes[:2], wheels, {"C": target("1/2", "1/20")})
    data["links"]["A"]["wheels"]["e"] = wheels["e"]
    data["links"]["C"]["wheels"]["f"] = {**wheels["f"], "internal": True}
    data["gears"].append({"pair": ["e", "f"]})
    truth = [
        teeth
        for teeth in assignments(data)
        if Fraction(teeth["a"] * teeth["c"], 20 * 12) == Fraction(teeth["e"], teeth["f"])
        and abs(2 * Fraction(teeth["e"], teeth["f"]) - 1) <= Fraction(1, 20)
    ]
    found = find(data, rules=(), best=1000)
    assert found.count == len(truth) > 0
    assert sorted(map(str, listed(found))) == sorted(map(str, truth))


def test_a_train_that_no_counts_let_turn_is_refused() -> None:
    meshes = [("A", "a", "B", "b"), ("B", "c", "C", "d")]
    data = train(meshes, {"a": 20, "b": 20, "c": free(20, 30), "d": 20}, {"C": target(1, "1/20")})
    data["inputs"]["B"] = 1
    with pytest.raises(QuestionError, match="cannot turn"):
        find(data)


# ------------------------------------------------------------------------------------------------ demands of every kind


@pytest.mark.parametrize(
    "output",
    [
        {"expect": "-1/3"},
        {"expect": "1/3"},
        {"expect": "-0.33"},
        {"expect": {"value": "-1/3", "tolerance": "1/50"}},
        {"published": {"value": "-3.0", "as": "input/output"}},
        {"published": {"value": "-0.3", "as": "output/input", "tolerance": "0.01"}},
        {"targets": [{"speed": "-0.33", "tolerance": "1/50"}, {"speed": "-0.3", "tolerance": "1/10"}]},
        {"targets": [{"speed": "0.33", "tolerance": "1/50"}]},
        {"targets": [{"speed": "-0.33"}, {"speed": "-0.3"}], "expect": "-0.33"},
        {"targets": [{"speed": "0", "tolerance": "0.4"}]},
        {"targets": [{"period": "3 d", "tolerance": "1 %"}]},
        {"targets": [{"period": "3 d", "tolerance": "1 %", "sense": "retrograde"}]},
        {"targets": [{"period": "3 d", "tolerance": "1 %", "sense": "direct"}]},
        {"targets": [{"period": "2 d", "tolerance": "1/100"}, {"period": "3 d", "tolerance": "1/100"}]},
    ],
)
@pytest.mark.parametrize("tolerance", [None, Fraction(1, 100)])
def test_every_kind_of_demand_means_what_the_solver_means(output: Data, tolerance: Fraction | None) -> None:
    data = train([("A", "a", "B", "b")], {"a": free(8, 13), "b": free(24, 40)}, {"B": output})
    truth = by_solving(data, tolerance)
    found = find(data, tolerance=tolerance, best=1000)
    assert found.count == len(truth)
    assert listed(found) == ordered(truth, "error", {})
    assert tallies_add_up(found)
    for one in found.solutions:
        assert one.outputs["B"].met


def test_all_states_are_requested_at_once_or_one_alone() -> None:
    data = safe_load("""
links:
  frame: {}
  sun: {wheels: {s: {teeth: {search: [12, 40]}}}}
  ring: {wheels: {r: {teeth: {search: [40, 90]}, internal: true}}}
  planet: {wheels: {p: {teeth: {search: [12, 40]}}}}
  arm: {}
revolutes: {main: [frame, sun, ring, arm], planet: [arm, planet]}
gears: [s ~ p, p ~ r]
inputs: {arm: 1}
outputs: {sun: {}, ring: {}}
""")
    data["states"] = {
        "low": {"fixed": ["sun"], "outputs": {"ring": target("1.35", "1/50")}},
        "high": {"fixed": ["ring"], "outputs": {"sun": target("3.8", "1/50")}},
    }
    sets = [(s, p, s + 2 * p) for s in range(12, 41) for p in range(12, 41) if 40 <= s + 2 * p <= 90]
    low = {one for one in sets if abs((1 + Fraction(one[0], one[2])) / Fraction("1.35") - 1) <= Fraction(1, 50)}
    high = {one for one in sets if abs((1 + Fraction(one[2], one[0])) / Fraction("3.8") - 1) <= Fraction(1, 50)}
    for state, truth in (("low", low), ("high", high), (None, low & high)):
        found = find(data, state=state, rules=ConstraintOptions(coaxial=True))
        assert found.count == len(truth) > 0
    assert set(found.solutions[0].outputs) == {"low: ring", "high: sun"}
    with pytest.raises(QuestionError, match="no state 'middle'"):
        find(data, state="middle")


def test_an_output_that_no_free_wheel_moves_is_remarked_on_and_stops_nothing() -> None:
    data = chain([(12, 40)] * 2, target("1/2", 0))
    data["outputs"]["L0"] = {"expect": 2}
    found = find(data)
    assert found.count == sum(2 * a == b for a in range(12, 41) for b in range(12, 41))
    assert "no varied wheel influences 'L0', which violates its requirement" in found.remarks[0]


# -------------------------------------------------------------------------------------------------- without a tolerance


@pytest.mark.parametrize("best", [1, 7, 40])
def test_without_a_tolerance_the_best_are_proved(best: int) -> None:
    data = chain(FOUR, target("0.3183098861837907"))
    truth = by_hand(data)
    found = find(data, best=best)
    assert found.ranked
    assert found.parts[0].tolerance is not None
    assert listed(found) == ordered(truth, "error", {})[:best]
    within = [error for _, error in truth if error <= found.parts[0].tolerance]
    assert found.count == len(within) >= best
    # with few assignments all are listed
    few = chain([(11, 12), (23, 24), (12, 13), (20, 20)], target("1000"))
    every = find(few, best=100)
    assert listed(every) == ordered(by_hand(few), "error", {})
    assert every.count == every.considered == 8


def by_hand(data: Data) -> list[tuple[Teeth, Fraction]]:
    wanted = 1 / Fraction(data["outputs"]["L2"]["targets"][0]["period"].split()[0])
    return [
        (teeth, abs(Fraction(teeth["a0"] * teeth["a1"], teeth["b0"] * teeth["b1"]) / wanted - 1))
        for teeth in assignments(data)
    ]


def test_a_tolerance_of_the_call_serves_targets_that_have_none() -> None:
    data = chain(FOUR, target("0.31831"))
    within = [one for one in by_hand(data) if one[1] <= Fraction(1, 1000)]
    found = find(data, tolerance=Fraction(1, 1000), best=1000)
    assert listed(found) == ordered(within, "error", {})
    assert found.parts[0].tolerance is None


def test_more_solutions_than_can_be_brought_out_are_counted_and_the_best_still_found() -> None:
    data = chain([(30, 60)] * 6, target("1.1", "1/10"))
    found = find(data, best=3)
    assert found.count == quotients_within(range(30, 61), 3, Fraction("1.1"), Fraction(1, 10)) > 10**8
    assert found.complete
    # a ratio of 11/10 is met exactly, so often that the least totals come first
    assert [one.error for one in found.solutions] == [0, 0, 0]
    exact = [
        a + b + c + d + e + f
        for a, b, c, d in product(range(30, 41), repeat=4)
        for e, f in product(range(30, 37), repeat=2)
        if 10 * a * b * c == 11 * d * e * f
    ]
    assert sum(found.solutions[0].teeth.values()) == min(exact)


# -------------------------------------------------------------------------------------------------------- empty results


def test_an_empty_result_says_where_assignments_went_and_what_comes_nearest() -> None:
    data = chain([(15, 80)] * 2, target("254/19", "1e-4"))
    (part,) = find(data).parts
    shortfall = part.shortfall
    assert part.count == 0
    assert part.complete
    assert shortfall.removed == {"L1: period 19/254 d in either sense within 0.0001": 66 * 66}
    nearest = min(abs(Fraction(19 * a, 254 * b) - 1) for a in range(15, 81) for b in range(15, 81))
    assert "a0 80, b0 15: L1 misses period 19/254 d in either sense" in shortfall.nearest
    assert abs(Fraction(19 * 80, 254 * 15) - 1) == nearest
    assert shortfall.advice == "a relative tolerance of 0.61 includes it"
    again = find(chain([(15, 80)] * 2, target("254/19", "0.61")))
    assert again.count >= 1


def test_a_rule_that_leaves_nothing_is_named_with_what_there_would_be_without_it() -> None:
    data = reverted([(15, 20), (21, 25), (26, 30), (31, 35)], target("2/3", "1e-1"))
    found = find(data)
    without = find(data, rules=()).count
    assert found.count == 0 < without
    rule = "coaxial closure: a0 + b0 = a1 + b1"
    assert f'without the constraint "{rule}" there are {without}' in found.parts[0].shortfall.advice
    assert tallies_add_up(found)


def test_a_rule_on_one_wheel_is_charged_with_all_the_counts_it_strikes() -> None:
    data = chain([(15, 40), (31, 90)], target("1/2", 0))
    found = find(data, rules=ConstraintOptions(minimum=18), best=100)
    assert found.parts[0].shortfall.removed["'a0' has at least 18 teeth"] == 3 * 60
    assert found.count == sum(2 * a == b for a in range(18, 41) for b in range(31, 91))
    assert tallies_add_up(found)
    empty = find(data, rules=ConstraintOptions(minimum=41))
    assert empty.count == 0
    assert "without the constraint \"'a0' has at least 41 teeth\" there are 20" in empty.parts[0].shortfall.advice
    assert tallies_add_up(empty)


def test_each_of_two_outputs_says_how_near_it_comes_alone() -> None:
    data = two_outputs()
    data["outputs"] = {"C": target("7/8", "1e-9"), "D": target("1000/777", "1e-9")}
    (part,) = find(data).parts
    assert part.count == 0
    box = range(12, 18)
    nearest = min(abs(Fraction(a * e * 777, b * f * 1000) - 1) for a, b, e, f in product(box, repeat=4))
    assert f"D has an error of {float(nearest):.3g}" in part.shortfall.nearest
    assert "without the requirement on 'D' there are" in part.shortfall.advice


# -------------------------------------------------------------------------------------------- standing and declarations


def test_an_assignment_stands_where_brute_force_puts_it() -> None:
    data = chain(FOUR, target("0.3183", "1/100"))
    truth = sorted(by_hand(data), key=lambda one: one[1])
    found = find(data, best=2)
    errors = [error for _, error in truth]
    for at in (0, 3, 11, 25):
        (standing,) = found.standing(truth[at][0])
        assert not standing.refused
        assert standing.rank == 1 + bisect_left(errors, errors[at])
        assert standing.assignment is not None
        assert standing.assignment.error == errors[at]
    (far,) = found.standing(truth[-1][0])
    assert far.refused
    assert far.rank is None
    assert "period 10000/3183 d in either sense within 0.01" in far.refused[0]
    (outside,) = found.standing({"a0": 11, "b0": 23, "a1": 12, "b1": 99})
    assert "99 teeth are not admissible for 'b1'" in outside.refused
    with pytest.raises(QuestionError, match="does not contain all wheels of any part"):
        found.standing({"a0": 11})
    with pytest.raises(QuestionError, match="'z' is not in the solutions"):
        found.standing({"z": 11})


def test_a_solution_is_written_down_as_a_change_of_its_train(tmp_path: Path) -> None:
    parent = load("freeth-2008")
    found = search_train(parent.declaration, free="uncertain")
    changed = next(one for one in found.solutions if one.changed)
    plain = found.declaration(changed, "freeth-2008", "another")
    assert plain["links"]["k2"] == {"wheels": {"k2": {"teeth": changed.teeth["k2"]}}}
    path = tmp_path / "another.yaml"
    path.write_text(json.dumps(plain), encoding="utf-8")
    child = load(path)
    assert child.name == "another"
    assert {wheel: child.declaration.wheels[wheel][1].count for wheel in changed.teeth} == changed.teeth
    assert all(result.holds for result in child.solve().outputs.values())


# ---------------------------------------------------------------------------------------------------------- real trains


def varied(name: str, bounds: Callable[[int], list[int]]) -> Data:
    """A shipped train whose wheels are all searched."""
    data: Data = load(name).declaration.model_dump(mode="json", exclude_unset=True, by_alias=True)
    for link in data["links"].values():
        for wheel in link.get("wheels", {}).values():
            count = wheel["teeth"] if isinstance(wheel["teeth"], int) else wheel["teeth"]["value"]
            wheel["teeth"] = {"value": count, "search": bounds(count)}
    return data


def test_every_wheel_of_a_reconstruction_may_be_free_at_once() -> None:
    data = varied("freeth-2021", lambda count: [max(1, count - 1), count + 1])
    found = find(data, rules=(), best=3, by="change")
    assert found.complete
    assert len(found.wheels) == 69
    assert found.considered > 10**30
    assert all(part.solutions[0].changed == () for part in found.parts)  # the reconstruction itself
    assert tallies_add_up(found)
    declared = declare(data).declaration
    for one in found.solutions:
        assert all(result.holds for result in GearTrain(with_counts(declared, one.teeth)).solve().outputs.values())


def test_the_uncertain_wheels_of_the_antikythera_mechanism_have_four_settings_that_keep_every_dial() -> None:
    declared = load("freeth-2008").declaration
    found = search_train(declared, free="uncertain")
    assert found.complete
    assert found.considered == 2560896000
    # each dial fixes the ratio of the wheels it adds to those before it; the ranges are the file's
    dials = [
        sum(Fraction(b2, c1) == Fraction(64, 38) for b2 in range(64, 67) for c1 in (38, 39)),
        sum(Fraction(e4, f1) == Fraction(188, 53) for e4 in range(180, 193) for f1 in (53, 54)),
        sum(e5 == k1 for e5 in range(50, 53) for k1 in range(48, 52)),
        sum(k2 == e6 for k2 in range(48, 53) for e6 in (49, 50)),
    ]
    assert dials == [1, 1, 2, 2]
    assert found.count == prod(dials)
    for one in found.parts[1].solutions:
        answer = GearTrain(with_counts(declared, one.teeth)).solve()
        assert all(result.holds for result in answer.outputs.values())


def test_the_twelve_wheels_of_an_eight_speed_gearbox_follow_from_its_published_ratios() -> None:
    data = varied("zf-8hp70", lambda count: [count * 9 // 10, count * 11 // 10])
    for state in data["states"].values():
        state["outputs"]["OUT"].pop("expect", None)
    declared = declare(data).declaration
    found = search_train(declared, rules=ConstraintOptions(coaxial=True), best=100, by="change")
    assert found.complete
    assert found.considered > 10**12
    # gear 1 gives set 4, gear 8 set 2, gear 4 then set 1; what is left for set 3 is tried gear by gear
    sets = {number: list(coaxial_sets(data, number)) for number in "1234"}
    fourth = [one for one in sets["4"] if near(1 + Fraction(one["r4"], one["s4"]), "4.6957")]
    second = [one for one in sets["2"] if near(1 / (1 + Fraction(one["s2"], one["r2"])), "0.6667")]
    truth = []
    for d, b, a in product(fourth, second, sets["1"]):
        x1, x2 = Fraction(a["r1"], a["s1"]), Fraction(b["r2"], b["s2"])
        if near((1 + x1 + x2) / (1 + x2), "1.6667"):
            left = (
                a | b | c | d for c in sets["3"] if abs(Fraction(c["r3"], c["s3"]) * 69 / 111 - 1) < Fraction(1, 99)
            )
            truth += [teeth for teeth in left if every_gear_holds(declared, data, teeth)]
    assert found.count == len(truth) > 1
    assert sorted(sorted(teeth.items()) for teeth in listed(found)) == sorted(sorted(teeth.items()) for teeth in truth)
    assert found.solutions[0].changed == ()


def coaxial_sets(data: Data, number: str) -> Iterator[Teeth]:
    box = boxes(data)
    for sun, planet in product(box[f"s{number}"], box[f"p{number}"]):
        if sun + 2 * planet in box[f"r{number}"]:
            yield {f"s{number}": sun, f"p{number}": planet, f"r{number}": sun + 2 * planet}


def near(ratio: Fraction, printed: str) -> bool:
    return abs(ratio - Fraction(printed)) <= Fraction(1, 20000)


def every_gear_holds(declared: Train, data: Data, teeth: Teeth) -> bool:
    solver = GearTrain(with_counts(declared, teeth))
    return all(solver.solve(gear).outputs["OUT"].holds for gear in data["states"])


# -------------------------------------------------------------------------------------- work: who does it, and how much


@pytest.fixture
def many_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(passes, "_SMALL", 50.0)


@pytest.mark.usefixtures("many_tasks")
def test_any_number_of_workers_gives_the_same_findings() -> None:
    questions: list[tuple[Data, Data]] = [
        (chain([(20, 44)] * 4, target("0.7071", "1e-4")), {"best": 30}),
        (two_outputs(), {"by": "distinct", "rules": ConstraintOptions(hunting=True)}),
    ]
    with open_executor(2) as executor:
        for data, options in questions:
            told: list[tuple[int, int]] = []
            alone = find(data, **options, tell=lambda done, total, told=told: told.append((done, total)))
            assert told[-1][1] > 3
            assert told[-1][0] == told[-1][1]
            assert find(data, **options, executor=executor).to_dict() == alone.to_dict()


def test_pieces_of_the_work_add_up_to_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    data = two_outputs()
    whole = find(data, best=1000).to_dict()
    for small in (3.0, 50.0, 500.0):
        monkeypatch.setattr(passes, "_SMALL", small)
        assert find(data, best=1000).to_dict() == whole


@pytest.mark.usefixtures("many_tasks")
def test_an_interrupt_keeps_what_is_known_and_the_journal_goes_on_from_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = chain([(20, 44)] * 4, target("0.7071", "1e-2"))
    whole = find(data)
    done: list[object] = []
    real = passes.do_task

    def interrupted(packed: bytes, task: Data) -> Data:
        if len(done) == 5:
            raise KeyboardInterrupt
        done.append(task)
        return real(packed, task)

    with Journal(tmp_path / "journal", {"question": 1}) as journal:
        monkeypatch.setattr(passes, "do_task", interrupted)
        part = find(data, journal=journal).parts[0]
        assert not part.complete
        assert part.reason.startswith("interrupted")
        assert 0 < part.count < whole.count
        assert part.solutions
        assert len(done) == 5
        monkeypatch.setattr(passes, "do_task", real)
        again = find(data, journal=journal)
    assert again.to_dict() == whole.to_dict()
    assert [one.rank for one in again.standing(whole.solutions[0].teeth)] == [1]
    monkeypatch.setattr(passes, "do_task", interrupted)
    with Journal(tmp_path / "journal", {"question": 1}) as journal:  # all is kept: nothing is done again
        assert find(data, journal=journal).to_dict() == whole.to_dict()


def test_an_interrupt_at_any_time_gives_findings_that_say_so(monkeypatch: pytest.MonkeyPatch) -> None:
    data = chain([(15, 80)] * 2, target("254/19", "1e-4"))
    real = passes.find_join_problem
    for after in range(4):
        requested: list[object] = []

        def interrupted(*question: Any, after: int = after, requested: list[object] = requested) -> Any:
            requested.append(question)
            if len(requested) > after:
                raise KeyboardInterrupt
            return real(*question)

        monkeypatch.setattr(passes, "find_join_problem", interrupted)
        (part,) = find(data).parts
        assert part.complete == (after > 0)
        assert part.reason.startswith("interrupted") == (after == 0)
        assert part.shortfall.advice == ""


def test_beyond_the_limit_a_sample_is_searched_and_said_to_be_one() -> None:
    data = chain([(20, 60)] * 6, target("0.7071", "1e-5"))
    whole = find(data, best=5)
    assert whole.complete
    some = find(data, best=5, limit=8000)
    (part,) = some.parts
    assert not some.complete
    assert not some.ranked
    assert "limit" in part.reason
    assert 0 < part.count < whole.count
    assert some.to_dict() == find(data, best=5, limit=8000).to_dict()
    for one in part.solutions:
        assert abs(one.error) <= Fraction(1, 10**5)
        assert one.error >= whole.solutions[0].error


# ------------------------------------------------------------------------------------------------------ wrong questions


def test_questions_that_cannot_be_requested_are_refused_in_words() -> None:
    plain = train([("A", "a", "B", "b")], {"a": 20, "b": {"teeth": {"value": 30, "range": [29, 31]}}}, {"B": target(1)})
    nothing = train([("A", "a", "B", "b")], {"a": 20, "b": free(20, 30)}, {"A": {}})
    wide = train([("A", "a", "B", "b")], {"a": 20, "b": free(20, 30_000_000)}, {"B": target(1)})
    for data, options, said in (
        (plain, {}, "has no wheel whose tooth count is varied"),
        (plain, {"free": ["a"]}, "the tooth count of wheel 'a' cannot be varied"),
        (plain, {"free": ["x"]}, "has no wheel 'x'"),
        (plain, {"free": "uncertain", "by": "beauty"}, "solutions cannot be sorted by 'beauty'"),
        (plain, {"free": "uncertain", "state": "up"}, "no state 'up'"),
        (nothing, {"rules": ()}, "no requirement restricts"),
        (wide, {}, "too wide"),
    ):
        with pytest.raises(GearTrainError, match=said) as caught:
            find(data, **options)
        assert all(problem.what and problem.why and problem.fix for problem in caught.value.problems)
    assert find(plain, free="uncertain").count == find(plain, free=["b"]).count == 3


def test_choices_are_looked_at_and_nothing_between_them() -> None:
    wheels = {"a": 20, "b": {"teeth": {"value": 30, "choices": [30, 24, 40]}}}
    found = find(train([("A", "a", "B", "b")], wheels, {"B": target("1/2", 0)}), free="uncertain")
    assert listed(found) == [{"b": 40}]
    assert found.considered == 3
    assert found.solutions[0].changed == ("b",)


def test_counts_that_no_machine_word_holds_are_still_exact() -> None:
    big = 10**11
    data = chain([(big, big + 9)] * 4, target(1, 0))
    found = find(data, best=200)
    truth = [(a, b, c, d) for a, b, c, d in product(range(big, big + 10), repeat=4) if a * c == b * d]
    assert found.count == len(truth)
    assert sorted(tuple(one.values()) for one in listed(found)) == sorted(truth)


# ------------------------------------------------------------------------------------------------------------ any train


@st.composite
def questions(draw: st.DrawFn) -> tuple[Data, Fraction | None, str, int]:
    """A random train with some wheels free and outputs asked for what they do, or nearly."""
    data = draw(st.one_of(ordinary_trains(most=5), driven_trains(most=5, couplings=False)))
    named = {
        wheel: teeth["teeth"] if isinstance(teeth, dict) else teeth
        for link in data["links"].values()
        for wheel, teeth in link.get("wheels", {}).items()
    }
    assume(named)
    chosen = draw(st.lists(st.sampled_from(sorted(named)), min_size=1, max_size=3, unique=True))
    bounds = {wheel: (max(1, named[wheel] - draw(st.integers(0, 2))), named[wheel] + 2) for wheel in chosen}
    answer = declare(data).solve()
    assume(answer.verdict)
    links = [link for link in data["links"] if link != "frame"]
    requested = draw(st.lists(st.sampled_from(links), min_size=1, max_size=3, unique=True))
    data = deepcopy(data)
    data["outputs"] = {link: draw(requested_of(Fraction(answer.speeds[link]))) for link in requested}
    for link in data["links"].values():
        for wheel, teeth in link.get("wheels", {}).items():
            if wheel in bounds:
                rest = teeth if isinstance(teeth, dict) else {}
                link["wheels"][wheel] = {**rest, "teeth": {"value": named[wheel], "search": list(bounds[wheel])}}
    tolerance = draw(st.sampled_from([None, Fraction(1, 20)]))
    return data, tolerance, draw(st.sampled_from(ORDERS)), draw(st.sampled_from([1, 4, 1000]))


def requested_of(speed: Fraction) -> st.SearchStrategy[Data]:
    if not speed:
        return st.just({"expect": 0})
    share = st.sampled_from(["0", "0.01", "0.1"])
    return st.one_of(
        st.just({"expect": str(speed)}),
        st.just({"expect": str(-speed)}),
        st.just({"published": {"value": f"{float(speed):.1f}"}}),
        share.map(lambda tolerance: target(abs(speed), tolerance)),
        share.map(lambda tolerance: target(abs(speed) * Fraction(103, 100), tolerance)),
        st.just(target(abs(speed) * Fraction(103, 100))),
        share.map(lambda tolerance: signed(speed * Fraction(103, 100), tolerance)),
        share.map(lambda tolerance: signed(-speed, tolerance)),
        st.just(signed(speed * Fraction(103, 100))),
        st.sampled_from(["0.5", "4"]).map(lambda tolerance: signed(0, tolerance)),
    )


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(questions())
def test_any_search_finds_what_trying_everything_finds(question: tuple[Data, Fraction | None, str, int]) -> None:
    data, tolerance, by, best = question
    declared = declare(data).declaration
    formulas = find_formulas(declared, None, boxes(data))
    assume(any(formula.wheels for formula in formulas.outputs.values()))
    assume(all(condition.wheels for condition in formulas.conditions))
    found = search_train(declared, rules=(), tolerance=tolerance, by=by, best=best)
    idle = frozenset(name for name, formula in formulas.outputs.items() if not formula.wheels)
    judged = ((teeth, errors_by_solving(declared, teeth, tolerance, idle)) for teeth in assignments(data))
    truth = [(teeth, error) for teeth, error in judged if error is not None and formulas.turns(teeth)]
    assert found.complete
    assert tallies_add_up(found)
    approached = any(part.tolerance is not None for part in found.parts)
    if not approached:
        assert found.count == len(truth)
    if len(found.parts) == 1 and (by == "error" or not approached):
        counts = {wheel: count for wheel in boxes(data) if (count := declared.wheels[wheel][1].count) is not None}
        assert listed(found) == ordered(truth, by, counts)[:best]
