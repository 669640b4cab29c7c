"""The laws every train obeys, on random trains; and the whole answer against the naive solver's."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from reference_solver import solve_naively, willis_rows
from sampling import few_or_many
from strategies import Data, driven_trains, overdriven_trains, planetary_sets, requested_trains

from geartrain import Answer, GearTrain

# trains from seeds (test_random_trains.py) hold most of these laws too; `--slow` draws new examples, and twice as many
some = settings(max_examples=few_or_many(30, 60))


def solved(data: Data) -> Answer:
    return GearTrain.declare(data).solve()


def same_answer(one: Answer, other: Answer) -> bool:
    return one.verdict.kind == other.verdict.kind and dict(one.speeds) == dict(other.speeds)


@some
@given(requested_trains())
def test_answer_counts_and_carriers_are_those_of_dense_elimination(data: Data) -> None:
    known, train = solve_naively(data), GearTrain.declare(data)
    answer, mobility = train.solve(), train.mobility
    assert {circuit.id: circuit.carrier for circuit in train.circuits} == known.carriers
    assert (mobility.by_rank, mobility.rank, set(mobility.still)) == (known.mobility, known.rank, known.still)
    assert mobility.redundant == len(train.circuits) - known.rank
    assert answer.verdict.kind == known.kind
    assert dict(answer.speeds) == known.speeds
    if known.kind == "free":
        assert set(answer.verdict.links) == known.undetermined


@some
@given(requested_trains())
def test_the_inputs_a_free_train_asks_for_settle_it_and_none_is_spare(data: Data) -> None:
    verdict = solved(data).verdict
    assume(verdict.kind == "free")
    given_too = {**data, "inputs": {**data["inputs"], **dict.fromkeys(verdict.fixes, Fraction(1))}}
    assert solve_naively(given_too).kind == "determined"
    one_less = {**data, "inputs": {**data["inputs"], **dict.fromkeys(verdict.fixes[1:], Fraction(1))}}
    assert solve_naively(one_less).kind in ("free", "locked")
    assert len(solve_naively(one_less).undetermined) > 0


@some
@given(overdriven_trains())
def test_an_input_at_a_wrong_speed_is_a_contradiction_unless_its_link_cannot_turn(data: Data) -> None:
    known = solve_naively(data)
    assert known.kind in ("contradictory", "locked")
    assert solved(data).verdict.kind == known.kind


@some
@given(overdriven_trains())
def test_the_prescriptions_named_in_a_contradiction_are_enough_for_it(data: Data) -> None:
    verdict = solved(data).verdict
    assert verdict.prescriptions
    named = {text.split(" = ")[0] for text in verdict.prescriptions}
    kept = {
        **data,
        "inputs": {link: speed for link, speed in data["inputs"].items() if link in named},
        "fixed": [link for link in data.get("fixed", ()) if f"'{link}' is fixed" in verdict.prescriptions],
        "locks": [
            pair
            for pair in data.get("locks", ())
            if any(f"'{pair[0]}'" in text and f"'{pair[1]}'" in text for text in verdict.prescriptions)
        ],
    }
    assert kept["inputs"]
    assert solve_naively(kept).kind in ("contradictory", "locked")


LOCKED_ON_ITS_CARRIER: Data = {
    "links": {"frame": {}, "arm": {}, "p": {"wheels": {"p": 8}}, "s": {"wheels": {"s": 8}}},
    "revolutes": [
        {"pair": ["frame", "arm"], "axis": "main"},
        {"pair": ["frame", "s"], "axis": "main"},
        {"pair": ["arm", "p"], "axis": "planet"},
    ],
    "gears": [{"pair": ["p", "s"]}],
    "couplings": [{"id": "pin", "kind": "pin_and_slot", "pin": "p", "slot": "s"}],
}


def test_a_planet_locked_on_its_carrier_turns_with_it() -> None:
    answer = solved({**LOCKED_ON_ITS_CARRIER, "inputs": {"arm": 3}})
    assert answer.verdict.kind == "determined"
    assert dict(answer.speeds) == {"frame": 0, "arm": 3, "p": 3, "s": 3}


def test_two_speeds_for_links_that_a_loop_locks_together_are_contradictory() -> None:
    verdict = solved({**LOCKED_ON_ITS_CARRIER, "inputs": {"arm": 1, "p": 2}}).verdict
    assert verdict.kind == "contradictory"


@some
@given(requested_trains())
def test_every_loop_shown_is_a_loop_of_meshes_in_one_carriers_frame(data: Data) -> None:
    train = GearTrain.declare(data)
    _, carriers = willis_rows(data)
    circuits = {circuit.id: circuit for circuit in train.circuits}
    mobility = train.mobility
    for loop in (*mobility.loops, *mobility.locked):
        assert {carriers[pair] for pair in loop.pairs} == {loop.carrier}
        here, round_trip = loop.links[0], Fraction(1)
        for at, pair in enumerate(loop.pairs):
            circuit, there = circuits[pair], loop.links[(at + 1) % len(loop.links)]
            assert {here, there} == {circuit.i, circuit.j}
            round_trip *= circuit.ratio if there == circuit.i else 1 / circuit.ratio
            here = there
        assert round_trip == loop.product
    assert all(loop.product == 1 for loop in mobility.loops)
    assert all(loop.product != 1 for loop in mobility.locked)


def renamed(data: Data, names: dict[str, str]) -> Data:
    """The same train with other link names."""
    return {
        **data,
        "frame": names["frame"],
        "links": {names[link]: part for link, part in data["links"].items()},
        "revolutes": [{**joint, "pair": [names[link] for link in joint["pair"]]} for joint in data["revolutes"]],
        "couplings": [{**c, "pin": names[c["pin"]], "slot": names[c["slot"]]} for c in data.get("couplings", ())],
        "inputs": {names[link]: speed for link, speed in data.get("inputs", {}).items()},
        "fixed": [names[link] for link in data.get("fixed", ())],
        "locks": [[names[link] for link in pair] for pair in data.get("locks", ())],
    }


@some
@given(requested_trains(), st.randoms(use_true_random=False))
def test_relabelling_the_links_changes_nothing(data: Data, random: Any) -> None:
    fresh = ["1", "01", "no", "null", "1:30", "a b", "ω", "~", "true", "frame"][: len(data["links"])]
    random.shuffle(fresh)
    names = dict(zip(data["links"], fresh, strict=True))
    before, after = solved(data), solved(renamed(data, names))
    assert after.verdict.kind == before.verdict.kind
    assert dict(after.speeds) == {names[link]: speed for link, speed in before.speeds.items()}
    assert set(after.verdict.links) == {names[link] for link in before.verdict.links}


@some
@given(requested_trains(), st.randoms(use_true_random=False))
def test_reordering_the_declaration_changes_nothing(data: Data, random: Any) -> None:
    def shuffled(items: Any) -> list[Any]:
        items = list(items)
        random.shuffle(items)
        return items

    other = {
        **data,
        "links": dict(shuffled(data["links"].items())),
        "revolutes": [{**joint, "pair": shuffled(joint["pair"])} for joint in shuffled(data["revolutes"])],
        "gears": [{**gear, "pair": shuffled(gear["pair"])} for gear in shuffled(data["gears"])],
        "couplings": shuffled(data["couplings"]),
        "inputs": dict(shuffled(data["inputs"].items())),
        "locks": [shuffled(pair) for pair in data.get("locks", ())],
    }
    assert same_answer(solved(data), solved(other))
    one, two = GearTrain.declare(data).mobility, GearTrain.declare(other).mobility
    assert (one.by_rank, one.redundant, set(one.still)) == (two.by_rank, two.redundant, set(two.still))


def basic_ratio(data: Data, a: str, b: str, c: str) -> Fraction | None:
    """i_ab^c: speed of a over that of b with c held; None where b cannot turn or a does not follow."""
    answer = solved({**data, "fixed": [c], "inputs": {b: 1}})
    return answer.speeds[a] if answer.verdict.kind == "determined" else None


@some
@given(planetary_sets())
def test_the_inversions_of_a_planetary_set_obey_their_identities(data: Data) -> None:
    i_ab = basic_ratio(data, "a", "b", "c")
    wheels = {name: wheel for part in data["links"].values() for name, wheel in part.get("wheels", {}).items()}
    assert i_ab is not None, "with the carrier held a planetary set is an ordinary train"
    teeth = {name: wheel if isinstance(wheel, int) else wheel["teeth"] for name, wheel in wheels.items()}
    (_, p), (_, q) = (gear["pair"] for gear in data["gears"])
    rings = wheels["a"]["internal"] + wheels["b"]["internal"]
    assert i_ab == (-1) ** rings * Fraction(teeth[p] * teeth["b"], teeth["a"] * teeth[q])
    assert i_ab * basic_ratio(data, "b", "a", "c") == 1
    if i_ab not in (0, 1):
        assert i_ab + basic_ratio(data, "a", "c", "b") == 1
        assert basic_ratio(data, "a", "c", "b") * basic_ratio(data, "c", "a", "b") == 1
        assert basic_ratio(data, "b", "a", "c") + basic_ratio(data, "b", "c", "a") == 1


@some
@given(driven_trains())
def test_speeds_are_the_sum_of_what_each_input_does_alone(data: Data) -> None:
    answer = solved(data)
    for link in data["links"]:
        table = answer.ratios[link]
        assert sum((table[name] * speed for name, speed in data["inputs"].items()), Fraction(0)) == answer[link]
    for name in data["inputs"]:
        alone = solve_naively({**data, "inputs": {**dict.fromkeys(data["inputs"], 0), name: 1}})
        assert {link: answer.ratios[link][name] for link in data["links"]} == alone.speeds


UNRELATED: Data = {
    "links": {"frame": {}, "a": {}, "b": {}, "c": {}},
    "revolutes": [{"pair": ["frame", link], "axis": link} for link in "abc"],
    "inputs": {"a": 1},
}


@pytest.mark.parametrize(
    ("more", "speed"), [({}, 1), ({"locks": [["b", "c"]]}, 1), ({"inputs": {}, "fixed": ["a"]}, 0)]
)
def test_an_output_that_is_determined_is_so_whatever_is_free_or_locked_together_elsewhere(
    more: Data, speed: int
) -> None:
    answer = GearTrain.declare({**UNRELATED, **more}).solve(output="a")
    assert (answer["a"], answer.verdict.kind) == (speed, "determined")
