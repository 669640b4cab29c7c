"""Epicyclic sets for a wanted ratio, against Willis solved in trains, loops over closed forms, and circles set down."""

from __future__ import annotations

from cmath import exp, pi
from collections.abc import Mapping
from fractions import Fraction
from itertools import product
from math import acos, asin, atan2, cos, gcd, isinf, sin
from pathlib import Path
from typing import Any

import pytest
from commands import call
from hypothesis import given, settings
from hypothesis import strategies as st

from geartrain import GearTrain, load
from geartrain.errors import QuestionError, RangeError
from geartrain.search import EpicyclicSet, find_sets, read_ratio, search_train
from geartrain.search.epicyclic import EPICYCLIC_KINDS as KINDS

F = Fraction
NAMES = list(KINDS)
FLAT = [name for name in NAMES if name != "bevel"]
ALL = range(1, 121)


def teeth(found: EpicyclicSet, *wheels: str) -> tuple[int, ...]:
    return tuple(found.teeth[wheel] for wheel in wheels)


# ratios


@pytest.mark.parametrize("name", NAMES)
def test_every_ratio_is_that_of_the_declared_train_in_every_mode(name: str) -> None:
    kind = KINDS[name]
    for mode in kind.modes:
        for found in find_sets(F(7, 2), kind, [mode], range(12, 40), best=3, spaced=False).solutions:
            train = GearTrain.declare(found.to_train())
            answer = train.solve()
            assert answer
            assert answer.failures == ()
            assert 1 / F(answer[mode.output]) == found.ratio
            assert abs(found.ratio) / F(7, 2) - 1 == found.error


@pytest.mark.parametrize("name", ["wolfrom", "3k-two-suns"])
def test_three_k_sets_may_be_requested_with_their_carrier_too(name: str) -> None:
    kind = KINDS[name]
    modes = [f"{a}:carrier:{b}" for a, b in product(kind.links[:-1], repeat=2) if a != b]
    for found in find_sets(F(4), kind, modes, range(12, 40), best=12, spaced=False).solutions:
        assert GearTrain.declare(found.to_train()).solve().failures == ()


def test_a_set_is_declared_with_its_planets(tmp_path: Path) -> None:
    path = tmp_path / "set.yaml"
    done = call(
        "teeth", "set", "3", "--kind", "ravigneaux", "--range", "12:45", "--planets", "3", "--best", "1", "-o", path
    )
    assert done.exit_code == 0
    assert {name: link.copies for name, link in load(path).declaration.links.items() if "planet" in name} == {
        "planet1": 3,
        "planet2": 3,
    }
    assert "without findings: 3 planets 'planet1', 3 planets 'planet2'" in " ".join(call("check", path).output.split())


def test_modes_are_all_choices_of_three_members_but_for_mirror_images() -> None:
    counts = {name: len(kind.modes) for name, kind in KINDS.items()}
    assert counts == {
        "planetary": 6, "stepped-suns": 3, "stepped-sun-ring": 6, "stepped-rings": 3, "meshed-planets": 6,
        "ravigneaux": 24, "bevel": 3, "wolfrom": 6, "3k-two-suns": 6,
    }  # fmt: skip


# what peers and textbooks print


def test_a_wolfrom_set_of_142_is_found_exactly() -> None:
    found = find_sets(F(142), "wolfrom", tolerance=F(0))
    assert found.count == 1
    assert teeth(found.solutions[0], "s1", "p1", "r1", "p2", "r2") == (24, 24, 72, 23, 71)
    assert found.solutions[0].mode.key == "sun:ring2:ring1"
    data = found.to_dict()
    (solution,) = data["solutions"]
    assert (solution["input/output"], solution["output/input"]) == ("142", "1/142")
    # 24 + 72 and 24 x 23 + 71 x 24 are multiples of 3
    assert (solution["planets"], solution["equally_spaced"], data["complete"]) == (3, True, True)


def test_the_wolfrom_set_of_175_has_planets_for_one_place_only_in_multiples_it_tells() -> None:
    found = find_sets(F(175), "wolfrom", "sun:ring2:ring1", tolerance=F(0), best=1000, spaced=False)
    (textbook,) = [x for x in found.solutions if teeth(x, "s1", "p1", "r1", "p2", "r2") == (12, 30, 72, 28, 70)]
    assert textbook.places == gcd(12 + 72, (12 * 28 + 70 * 30) // 2)


def test_ten_thousand_to_one_needs_a_slack_of_two_half_modules() -> None:
    counts = range(98, 103)
    tight = find_sets(F(10000), "stepped-suns", "all", counts, tolerance=F(0), spaced=False)
    assert not tight
    loose = find_sets(F(10000), "stepped-suns", "all", counts, tolerance=F(0), spaced=False, slack=2)
    assert (100, 101, 100, 99) in {teeth(x, "s1", "p1", "p2", "s2") for x in loose.solutions}
    assert all(abs(sum(teeth(x, "s1", "p1")) - sum(teeth(x, "s2", "p2"))) <= 2 for x in loose.solutions)


def test_humpages_bevels_fit_their_planet() -> None:
    counts = {"s1": (20,), "s2": (76,), "p": (56,)}
    found = find_sets(F("4.8"), "bevel", "sun1:carrier:sun2", counts, planets=2, spaced=False)
    assert found.solutions[0].ratio == F(24, 5)


# whether it goes together


def goes_together(kind: Any, counts: dict[str, int], planets: int) -> bool:
    """Put equal planets in at multiples of a turn, in every orientation, and see whether all teeth meet.

    A mesh is judged by the sum of tooth phases at its line of centres, which must be what it is at the first planet.
    """
    for at in range(1, planets):
        turn = F(at, planets)
        states = [{}]
        for link in kind.planets:
            meshes = [(m.wheel, m.mesh, m.internal) for m in kind.members if m.mesh in link]
            wheel, mesh, ring = meshes[0]
            angles = []
            for tooth in range(counts[mesh]):
                # outer mesh: z turn + p (turn - angle) is whole; ring: z turn - p (turn - angle) is whole
                angle = turn + (F(counts[wheel]) * turn + tooth) / counts[mesh] * (-1 if ring else 1)
                if all(
                    (counts[w] * turn + (-1 if r else 1) * counts[m] * (turn - angle)) % 1 == 0 for w, m, r in meshes
                ):
                    angles.append(angle)
            states = [state | dict.fromkeys(link, angle) for state in states for angle in angles]
        for a, b in kind.between:
            states = [s for s in states if (counts[a] * (turn - s[a]) + counts[b] * (turn - s[b])) % 1 == 0]
        if not states:
            return False
    return True


@pytest.mark.parametrize("name", FLAT)
@pytest.mark.parametrize("planets", [2, 3, 4])
def test_equal_planets_go_in_exactly_where_every_orientation_tried_says_so(name: str, planets: int) -> None:
    kind = KINDS[name]
    found = find_sets(F(2), kind, [kind.modes[0]], range(6, 26), planets, best=60, spaced=False, by="total")
    assert found.solutions
    for one in found.solutions:
        assert one.equally_spaced == goes_together(kind, dict(one.teeth), planets), one


def test_known_assembly_rules_hold() -> None:
    case = find_sets(F(43, 7), "planetary", counts={"s": (21,), "p": (43,), "r": (108,)}, slack=1, tolerance=F(0))
    assert case.solutions[0].places == 21 + 108
    assert find_sets(F(7, 2), "planetary", counts={"s": (24,), "p": (18,), "r": (60,)}).solutions[0].places == 84
    bevels = find_sets(F(1), "bevel", counts={"s1": (16,), "s2": (16,), "p": (10, 20)}, planets=4)
    assert {x.places for x in bevels.solutions} == {32}


def placed(kind: Any, counts: dict[str, int], planets: int) -> float:
    """Least room between tips of planets of different copies, circles set down in the plane (modules)."""
    centres = []
    for link in kind.planets:
        member = next(m for m in kind.members if m.mesh in link)
        distance = (counts[member.wheel] + (-1 if member.internal else 1) * counts[member.mesh]) / 2
        centres.append(complex(distance))
    if kind.between:
        (a, b), (x, y) = kind.between[0], (abs(c) for c in centres)
        mesh = (counts[a] + counts[b]) / 2
        centres[1] *= exp(1j * acos((x * x + y * y - mesh * mesh) / (2 * x * y)))
        assert abs(abs(centres[0] - centres[1]) - mesh) < 1e-9
    tips = [max(counts[wheel] for wheel in link) / 2 + 1 for link in kind.planets]
    return min(
        abs(a - b * exp(2j * pi * k / planets)) - s - t
        for k in range(1, planets)
        for a, s in zip(centres, tips, strict=True)
        for b, t in zip(centres, tips, strict=True)
    )


@pytest.mark.parametrize("name", FLAT)
@pytest.mark.parametrize("planets", [2, 3, 5])
def test_room_between_neighbours_is_that_of_circles_set_down_in_the_plane(name: str, planets: int) -> None:
    kind = KINDS[name]
    for one in find_sets(F(3), kind, [kind.modes[0]], range(8, 36), planets, best=40, spaced=False).solutions:
        assert one.room == pytest.approx(placed(kind, dict(one.teeth), planets), abs=1e-9)


@pytest.mark.parametrize("name", FLAT)
def test_a_clearance_keeps_exactly_the_sets_whose_circles_stand_so_far_apart(name: str) -> None:
    kind, requested = KINDS[name], {"counts": range(8, 30), "planets": 3, "best": 10**6}
    everything = find_sets(F(3), kind, [kind.modes[0]], **requested, clearance=-1000)
    kept = find_sets(F(3), kind, [kind.modes[0]], **requested, clearance=F(1, 2))
    rooms = {tuple(one.teeth.values()): placed(kind, dict(one.teeth), 3) for one in everything.solutions}
    if not kind.idle:  # other idle wheels stand where more room is asked
        assert {tuple(one.teeth.values()) for one in kept.solutions} == {
            counts for counts, room in rooms.items() if room > 0.5 - 1e-9
        }


def test_planets_that_stand_exactly_as_far_apart_as_is_requested_are_kept_and_none_nearer() -> None:
    """Six planets of 18 teeth about a sun of 24 stand 42 sin 30 degrees = 21 modules apart, tips 1 module."""
    one: dict[str, Any] = {"counts": {"s": (24,), "p": (18,), "r": (60,)}, "planets": 6}
    assert find_sets(F(7, 2), "planetary", "sun:carrier:ring", **one, clearance=1.0).count == 1
    assert find_sets(F(7, 2), "planetary", "sun:carrier:ring", **one, clearance=F(10**6 + 1, 10**6)).count == 0


def test_planets_in_mesh_touch_nothing_but_their_mates_and_are_the_smallest_that_fit() -> None:
    for one in find_sets(F(3), "meshed-planets", "sun:ring:carrier", range(10, 90), best=40).solutions:
        s, p, r = teeth(one, "s", "p1", "r")
        outer, inner = (r - p) / 2, (s + p) / 2
        assert abs(outer - inner) < p < outer + inner
        assert outer - (p / 2 + 1) > s / 2 + 1
        assert inner + (p / 2 + 1) < r / 2 - 1
        assert teeth(one, "p2") == (p,)
        smaller = [{"s": (s,), "r": (r,), "p1": (q,), "p2": (q,)} for q in range(10, p)]
        assert not any(find_sets(F(3), "meshed-planets", "sun:ring:carrier", counts) for counts in smaller)


def test_bevel_cones_of_a_set_meet_at_one_slope_found_by_bisection() -> None:
    for one in find_sets(F(3), "bevel", "sun1:sun2:carrier", range(12, 60), best=20, spaced=False).solutions:
        a, b, p = teeth(one, "s1", "s2", "p")

        def cone(shaft: float, p: int = p, other: int = a) -> float:
            return atan2(sin(shaft), other / p + cos(shaft))

        low, high = 1e-6, pi - 1e-6  # the planet's cone against each side wheel, at shaft angles that sum to pi
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (middle, high) if cone(middle, p, a) < cone(pi - middle, p, b) else (low, middle)
        first = cone(low, p, a)
        assert cone(pi - low, p, b) == pytest.approx(first, abs=1e-9)
        radius, shaft = p / (2 * sin(first)), low
        between = 2 * asin(sin(shaft) * sin(pi / 3))
        assert one.room == pytest.approx(radius * (between - 2 * first) - 2, rel=1e-6, abs=1e-6)


# the search itself


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("tolerance", [None, F(1, 200)])
def test_what_is_removed_and_what_is_left_add_up_to_what_was_considered(name: str, tolerance: Fraction | None) -> None:
    found = find_sets(F(9, 4), name, counts=range(12, 40), tolerance=tolerance, sense=1)
    short = found.shortfall
    assert sum(short.removed.values()) + found.count == short.considered
    free = KINDS[name].free
    assert short.considered == 28 ** len(free) * len(KINDS[name].modes)


@settings(max_examples=15)
@given(st.sampled_from(NAMES), st.fractions(F(1, 4), 12, max_denominator=30), st.sampled_from(["error", "total"]))
def test_a_short_list_is_the_head_of_the_long_one(name: str, wanted: Fraction, by: Any) -> None:
    counts = range(12, 27)
    whole = find_sets(wanted, name, counts=counts, best=10**6, by=by, tolerance=F(1, 5), spaced=False)
    head = find_sets(wanted, name, counts=counts, best=7, by=by, tolerance=F(1, 5), spaced=False)
    assert head.solutions == whole.solutions[:7]
    assert head.count == whole.count == len(whole.solutions)
    free = find_sets(wanted, name, counts=counts, best=7, spaced=False)
    if whole.count >= 7 and by == "error":
        assert free.solutions == head.solutions


def test_a_tolerance_is_judged_exactly_at_its_edge() -> None:
    error = F(69, 13) / F("5.31") - 1
    for tolerance, held in ((abs(error), 1), (abs(error) - F(1, 10**40), 0)):
        found = find_sets(F("5.31"), "planetary", "sun:carrier:ring", ALL, tolerance=tolerance, spaced=False)
        assert found.count == held


def test_a_ratio_that_was_read_brings_its_sense() -> None:
    read = find_sets(read_ratio("-5.31"), "planetary", counts=ALL)
    told = find_sets(F("5.31"), "planetary", counts=ALL, sense=-1)
    assert read == told
    assert all(x.ratio < 0 for x in read.solutions)


def test_output_over_input_is_the_same_question_turned_round() -> None:
    one = find_sets(F(5, 2), "stepped-suns", "carrier:sun1:sun2", range(12, 40), ratio_is="output/input")
    other = find_sets(F(5, 2), "stepped-suns", "sun1:carrier:sun2", range(12, 40))
    assert [x.teeth for x in one.solutions] == [x.teeth for x in other.solutions]
    assert [x.inverse for x in one.solutions] == [x.ratio for x in other.solutions]


def test_an_empty_answer_names_the_nearest_miss_and_the_tolerance_that_keeps_it() -> None:
    found = find_sets(F("5.31"), "planetary", "sun:carrier:ring", ALL, tolerance=F(1, 10**5), spaced=False)
    assert not found
    assert found.shortfall.nearest.startswith("s = 26, p = 43, r = 112: 69/13 = 5.307692")
    assert "0.000435" in found.shortfall.advice
    for counts, sense, said in ((range(12, 14), 0, "count out of bounds"), (range(12, 40), -1, "opposite sense")):
        nothing = find_sets(F(4), "planetary", "sun:carrier:ring", counts, sense=sense, spaced=sense == 0)
        assert nothing.count == 0
        assert said in nothing.shortfall.advice


@pytest.mark.parametrize(
    ("name", "mode", "most"),
    [
        ("planetary", "sun:carrier:ring", 80),
        ("planetary", "carrier:ring:sun", 80),
        ("wolfrom", "sun:ring2:ring1", 48),
        ("3k-two-suns", "sun1:sun2:ring", 40),
        ("stepped-sun-ring", "sun:carrier:ring", 60),
        ("stepped-suns", "sun1:carrier:sun2", 60),
        ("stepped-rings", "ring1:carrier:ring2", 60),
    ],
)
def test_the_search_in_a_declared_train_finds_the_same_sets(name: str, mode: str, most: int) -> None:
    counts, tolerance = range(12, most + 1), F(1, 200)
    near = find_sets(F("5.31"), name, mode, counts, best=1, spaced=False).solutions[0]
    own = find_sets(
        abs(near.inverse), name, mode, counts, tolerance=tolerance, best=10**5, spaced=False,
        ratio_is="output/input", sense=1 if near.ratio > 0 else -1,
    )  # fmt: skip
    data = near.to_train()
    for wheel in (wheel for link in data["links"].values() for wheel in link.get("wheels", {}).values()):
        wheel["teeth"] = {"search": [12, most]}
    data["outputs"] = {near.mode.output: {"targets": [{"speed": str(near.inverse), "tolerance": "1/200"}]}}
    found = search_train(GearTrain.declare(data).declaration, best=10**5)
    assert found.complete
    wheels = KINDS[name].wheels
    right = {
        tuple(one.teeth[wheel] for wheel in wheels)
        for one in found.solutions
        if steps_differ(one.teeth)
        if all(one.teeth[each.wheel] > one.teeth[each.mesh] for each in KINDS[name].members if each.internal)
    }
    assert {teeth(x, *wheels) for x in own.solutions} == right
    assert own.count == len(right) > 0


def steps_differ(counts: Mapping[str, int]) -> bool:
    return "p2" not in counts or counts["p1"] != counts["p2"]


def test_one_planet_between_two_rings_of_different_counts_is_found_with_slack() -> None:
    """Ferguson's: equal steps, rings of 60 and 62 teeth cut to one distance; i = (1 + r1/s)/(1 - r1/r2) = 124."""
    found = find_sets(
        F(124), "wolfrom", "sun:ring2:ring1", range(12, 80), tolerance=F(0), best=100, spaced=False, slack=2
    )
    assert (20, 20, 60, 20, 62) in {teeth(x, "s1", "p1", "r1", "p2", "r2") for x in found.solutions}


def test_a_single_planet_has_room_without_limit() -> None:
    single = find_sets(F(4), "planetary", planets=1, best=1)
    assert isinf(single.solutions[0].room)
    assert single.to_dict()["solutions"][0]["room"] is None


@pytest.mark.parametrize(
    "requested",
    [
        {"kind": "cycloid"},
        {"modes": "sun:carrier"},
        {"modes": "sun:carrier:arm"},
        {"wanted": F(-4)},
        {"wanted": F(10**400)},
        {"counts": ()},
        {"counts": range(0, 5)},
        {"counts": {"s": (12,)}},
        {"counts": {"s": (12,), "p": (12,), "r": (12,), "q": (12,)}},
        {"planets": 0},
        {"best": 0},
        {"slack": -1},
        {"tolerance": F(-1)},
        {"by": "weight"},
        {"ratio_is": "in/out"},
        {"clearance": float("nan")},
        {"kind": "wolfrom", "counts": range(12, 2000)},
    ],
)
def test_what_cannot_be_requested_is_refused_with_what_why_and_what_to_do(requested: dict[str, Any]) -> None:
    with pytest.raises((QuestionError, RangeError)) as caught:
        find_sets(**({"wanted": F(4), "kind": "planetary"} | requested))
    (problem,) = caught.value.problems
    assert all((problem.what, problem.why, problem.fix))
