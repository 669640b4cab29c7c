"""Trains of which arbors are lost: the evidence that is left, and that the train itself is always found again."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import pytest
from concrete_trees import concrete, explanations, nodes, speeds
from shipped import every_train

from geartrain import GearTrainError, load
from geartrain.search.reconstruct import (
    Arbor,
    PlacedWheel,
    ReconstructionRequest,
    Reconstructions,
    evidence_question,
    find_reconstructions,
    find_spur_tree,
    find_spur_trees,
    lost_evidence,
    reconstruct,
)

# a > b > c is the Moon's train, a > s the Sun's; d leads to no pointer, e is driven by a contrate wheel
SAMPLE = """\
name: sample
title: A sample
unit: {per: year_tropical_J2000}
links:
  frame: {}
  a: {wheels: {a1: 10, a2: 12, a3: 9, a4: {teeth: 15, kind: contrate}}}
  b: {wheels: {b1: 20, b2: {teeth: {value: 14, range: [13, 15]}, status: surviving, note: worn}, b3: 40}}
  c: {wheels: {c1: 7}}
  s: {wheels: {s1: 24}}
  d: {wheels: {d1: 18}}
  e: {wheels: {e1: 30}}
axes: {E: {direction: [1, 0, 0]}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
  - {pair: [frame, c], axis: C}
  - {pair: [frame, s], axis: S}
  - {pair: [frame, d], axis: D}
  - {pair: [frame, e], axis: E}
gears:
  - {pair: [b1, a1]}
  - {pair: [b2, c1]}
  - {pair: [a2, s1]}
  - {pair: [a3, d1]}
  - {pair: [a4, e1]}
inputs: {a: 1}
dials: {zodiac: {}}
outputs:
  b:    {expect: -1/2}
  moon: {of: c, dial: zodiac, expect: 1, targets: [{period: 365 d}]}
  sun:  {of: s, targets: [{speed: -1/2, tolerance: 1/100}, {period: 700 d}]}
"""


def sample(old: str = "", new: str = "") -> Any:
    assert not old or SAMPLE.count(old) == 1, old
    return find_spur_tree(load(SAMPLE.replace(old, new) if old else SAMPLE).declaration)


def evidence_data(tree: Any, lost: Sequence[str]) -> dict[str, Any]:
    """The evidence that is left, as plain data."""
    return lost_evidence(tree, lost).model_dump(mode="json", exclude_unset=True, by_alias=True)


def wheel(teeth: int, name: str | None = None) -> PlacedWheel:
    return PlacedWheel(name, teeth)


def test_evidence_is_what_the_other_arbors_and_all_pointers_tell() -> None:
    assert evidence_data(sample(), ["b"]) == {
        "name": "sample-without-b",
        "title": "A sample, without b",
        "unit": {"per": "year_tropical_J2000"},
        "frame": "frame",
        "links": {
            "frame": {},
            "a": {"wheels": {"a1": {"teeth": 10}, "a2": {"teeth": 12}}},
            "c": {"wheels": {"c1": {"teeth": 7}}},
            "s": {"wheels": {"s1": {"teeth": 24}}},
        },
        "inputs": {"a": "1"},
        "outputs": {
            "moon": {"of": "c", "expect": {"value": "1"}},
            "sun": {"of": "s", "targets": [{"speed": "-1/2", "tolerance": "1/100"}]},
        },
        "reconstruct": {"add": {"wheels": 2, "teeth": [7, 24]}},
    }
    found = evidence_data(sample(), ["s", "c"])
    assert found["links"] == {
        "frame": {},
        "a": {"wheels": {"a1": {"teeth": 10}, "a2": {"teeth": 12}}},
        "b": {"wheels": {"b1": {"teeth": 20}, "b2": {"teeth": 14, "status": "surviving", "note": "worn"}}},
    }
    assert {name: output["of"] for name, output in found["outputs"].items()} == {"moon": "new", "sun": "new"}
    assert found["reconstruct"]["add"]["wheels"] == 2


def test_the_train_as_a_candidate() -> None:
    tree = sample()
    sun = Arbor("s", wheel(24, "s1"), ("sun",), ())
    moon = Arbor("c", wheel(7, "c1"), ("moon",), ())
    b = Arbor("b", wheel(20, "b1"), (), ((wheel(14, "b2"), (moon,)),))
    whole = Arbor("a", None, (), ((wheel(10, "a1"), (b,)), (wheel(12, "a2"), (sun,))))
    assert tree.arbor() == whole
    lost = Arbor(None, wheel(20), (), ((wheel(14), (moon,)),))
    assert tree.arbor(["b"]) == Arbor("a", None, (), ((wheel(10, "a1"), (lost,)), (wheel(12, "a2"), (sun,))))
    assert not {"d", "e"} & {*tree.arbors}
    assert not lost_evidence(tree, ["b"]).reconstruct.idlers


def test_the_last_arbor_whose_speed_is_known_is_a_pointer() -> None:
    """c then has no target, and so its speed is not taken: but nothing follows it."""
    tree = sample(", targets: [{period: 365 d}]", "")
    assert dict(tree.pointers) == {"sun": "s", "moon": "c"}
    tree = sample("of: c, dial: zodiac, expect: 1, targets: [{period: 365 d}]", "of: e")
    assert dict(tree.pointers) == {"sun": "s", "b": "b"}
    assert tree.wheels_of("b") == ("b1",)
    assert not {"c", "d", "e"} & {*tree.arbors}


def test_a_wheel_that_is_driven_and_drives_is_an_idler() -> None:
    tree = sample("[b2, c1]", "[b1, c1]")
    moon = Arbor("c", wheel(7, "c1"), ("moon",), ())
    drives, _ = tree.arbor().drives
    assert drives == (wheel(10, "a1"), (Arbor("b", wheel(20, "b1"), (), (), (moon,)),))
    assert lost_evidence(tree, ["s"]).reconstruct.idlers


def test_only_trees_of_spur_wheels_with_one_input_are_taken() -> None:
    assert "moon" not in sample("inputs: {a: 1}", "inputs: {a: 1}\nfixed: [c]").pointers
    with pytest.raises(GearTrainError, match="has 2 inputs that turn"):
        sample("inputs: {a: 1}", "inputs: {a: 1, b: 2}")


def test_a_ring_turns_with_what_drives_it_and_is_not_lost() -> None:
    tree = sample("c1: 7}}", "c1: {teeth: 27, internal: true}}}")
    assert tree.pointers["moon"] == "c"
    assert tree.able == ("b", "s")
    assert evidence_data(tree, ["b"])["links"]["c"] == {"wheels": {"c1": {"teeth": 27, "internal": True}}}


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("four-gear-loop", "close a loop"),
        ("gm-4t60", "has several states"),
        ("lantern-mill", "it has contrate wheels"),
        ("rv-reducer", "it has couplings other than pin and slot"),
    ],
)
def test_a_train_that_is_not_taken_says_why(name: str, why: str) -> None:
    with pytest.raises(GearTrainError, match=why):
        find_spur_tree(load(name).declaration)


@pytest.mark.parametrize("name", every_train())
def test_pointers_of_every_part_turn_as_the_whole_train_turns_them(name: str) -> None:
    """Also where a part is on a carrier, or begins behind one, and where it has rings and pins in slots."""
    try:
        trees = find_spur_trees(load(name).declaration)
    except GearTrainError:
        return
    solved = load(name).solve()
    for tree in trees:
        first = concrete(tree.arbor())
        rings = [wheel for wheel in tree.counts if tree.train.wheels[wheel][1].internal]
        turning = zip(nodes(first), speeds(first, tree.base.driven, rings), strict=True)
        shown = {dial: tree.base.speed + speed for node, speed in turning for dial in node[2]}
        assert shown == {pointer: solved[tree.link_of(pointer)] for pointer in tree.pointers}
        assert all(node[2] for node in nodes(first) if not node[3])


def parts_of(name: str) -> dict[str, set[str]]:
    return {tree.name: set(tree.able) for tree in find_spur_trees(load(name).declaration)}


def test_what_is_borne_by_a_carrier_is_a_part_and_so_is_what_it_drives() -> None:
    """By hand, from the declarations: the links are those whose arbors a reader finds between two known speeds."""
    back = parts_of("freeth-2008")
    assert list(back) == ["", "on e_table, from e_pipe", "from e_inner"]
    assert back["on e_table, from e_pipe"] == {"k1", "e_inner"}
    assert back["from e_inner"] == {"moon"}
    jones = parts_of("freeth-jones-2012")["on b, from frame"]
    assert jones == {"sun_idler", "sun40", "me33", "ve64", "ma79", "mars", "ju83", "jupiter", "sa59", "saturn"}
    assert len(parts_of("freeth-2021")["on b, from frame"]) == 20
    assert parts_of("price-1974")["on turntable, from e1"] == {"k", "j", "e2"}
    assert parts_of("price-1974")["from turntable"] == {"f", "g", "h", "i"}
    # the sun and the planet of a train whose ring stands still; an arbor with a ring of its own is not lost
    assert parts_of("planetary-24-18-60") == {"on carrier, from frame": {"planet", "sun"}}
    assert "F" not in parts_of("norton-compound")["on arm, from ground"]


def test_links_that_a_pin_in_a_slot_joins_are_lost_together() -> None:
    tree = find_spur_tree(load("freeth-2008").declaration, ["k2"])
    assert (tree.source, tree.joined["k1"], tree.wheels_of("k1")) == ("e_pipe", ("k1", "k2"), ("k1", "k2"))
    data = evidence_data(tree, ["e_inner"])
    assert data["inputs"] == {"e_table": "-477/4237", "e_pipe": "-254/19"}
    assert data["links"] == {
        "frame": {},
        "e_table": {},
        "e_pipe": {"wheels": {"e5": data["links"]["e_pipe"]["wheels"]["e5"]}},
        "k1": {"wheels": {"k1": data["links"]["k1"]["wheels"]["k1"]}},
        "k2": {"wheels": {"k2": data["links"]["k2"]["wheels"]["k2"]}},
    }
    assert data["reconstruct"] == {
        "carrier": "e_table",
        "add": {"wheels": 1, "teeth": [12, 223]},
        "given": [{"pair": ["k1", "k2"]}],
    }
    assert data["outputs"]["lunar anomaly"] == {
        "of": "k1",
        "relative_to": "e_table",
        "expect": {"value": "56165/4237"},
    }
    without = evidence_data(tree, ["k2"])
    assert without["reconstruct"]["add"] == {"wheels": 2, "teeth": [12, 223]}
    assert "given" not in without["reconstruct"]


@pytest.mark.parametrize(
    ("name", "source", "lost", "why"),
    [
        ("freeth-2008", None, ["a"], "the link has contrate wheels"),
        ("freeth-2008", None, ["frame"], "the link does not turn"),
        ("freeth-2008", None, ["x"], "'x' cannot be lost(.|\\n)*no such link"),
        ("freeth-2021", None, ["venus"], "mean ratio is 0"),
        ("freeth-2021", "frame", ["frame"], "a reconstruction begins at the input"),
        ("norton-compound", "ground", ["F"], "the arbor has a ring"),
        ("freeth-2008-doubt", None, ["c"], "the link leads to no pointer of known speed"),
        ("freeth-2008", None, ["k1", "k2"], "'k1' is lost twice"),
        ("longcase-clock", None, ["third", "third"], "'third' is lost twice"),
        ("freeth-2008", None, ["c", "k1"], "'c' and 'k1' belong to different parts"),
    ],
)
def test_what_cannot_be_lost_is_told_with_the_reason(name: str, source: str | None, lost: list[str], why: str) -> None:
    with pytest.raises(GearTrainError, match=why):
        lost_evidence(find_spur_tree(load(name).declaration, lost, source), lost)


def is_found(tree: Any, lost: Sequence[str], found: Reconstructions) -> bool:
    """True if the train without its lost arbors is among the candidates."""
    return concrete(tree.arbor(lost)) in {concrete(one.arbor) for one in found.candidates}


IN_PARTS = {
    "freeth-2008": ("e_pipe", "e_inner"),
    "planetary-24-18-60": ("frame",),
    "wolfrom-175": ("case",),
    "nrel-grc-750": ("housing", "low"),
    "price-1974": ("e1", "turntable"),
}


@pytest.mark.parametrize("name", IN_PARTS)
def test_an_arbor_of_a_later_part_is_found_again(name: str) -> None:
    for source in IN_PARTS[name]:
        tree = find_spur_tree(load(name).declaration, (), source)
        for link in tree.able:
            problem = evidence_question(lost_evidence(tree, [link])).problem
            if problem.additions.wheels < 3:
                assert is_found(tree, [link], find_reconstructions(problem)), (source, link)


@pytest.mark.parametrize("name", ["freeth-2008", "freeth-2021", "price-1974", "clock-10000-years-exact"])
def test_where_meshes_were_seen_the_search_of_a_large_train_is_small(name: str) -> None:
    """In the first part and in those on carriers; none of these ends within minutes where no mesh is told."""
    trees = find_spur_trees(load(name).declaration)
    for tree in trees:
        link = tree.able[0]
        evidence = lost_evidence(tree, [link], seen=True)
        assert {frozenset(gear.pair) for gear in evidence.gears} == set(map(frozenset, tree.meshes([link])))
        assert is_found(tree, [link], find_reconstructions(evidence_question(evidence).problem))


QUICK = {
    "vitruvius-hodometer": 1,
    "watch-going-train": 2,
    "isfahan-astrolabe-1221": 1,
    "al-biruni-box-of-the-moon": 2,
    "moon-triangular": 1,
    "longcase-clock": 1,
}


@pytest.mark.parametrize("name", QUICK)
def test_a_train_is_found_again_whatever_is_lost(name: str) -> None:
    """And is read as a known train where it turns in the frame: it breaks no rule, and has the rank of the original."""
    train = load(name).declaration
    tree = find_spur_tree(train)
    for many in range(1, QUICK[name] + 1):
        for lost in combinations(tree.driven, many):
            if evidence_question(lost_evidence(tree, lost)).problem.additions.wheels > 2:
                continue
            known = () if tree.base.is_carrier else (train,)
            found = reconstruct(ReconstructionRequest(train, lost, known=known))
            assert found.original is not None, lost
            for one in found.known:
                assert (one.broken, one.place and one.place.ranks) == ((), found.original)
                assert {*one.wheels} == {wheel for link in lost for wheel in tree.wheels_of(link)}


def test_an_added_arbor_may_lead_on_by_two_wheels() -> None:
    """13 > 22, 18 > 23 and 12 > 29 from 13, 23 and 29 alone; plain growth finds no other."""
    text = """\
name: fork
links:
  frame: {}
  a: {wheels: {a1: 13}}
  b: {wheels: {b1: 22, b2: 18, b3: 12}}
  c: {wheels: {c1: 23}}
  d: {wheels: {d1: 29}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
  - {pair: [frame, c], axis: C}
  - {pair: [frame, d], axis: D}
gears: [{pair: [a1, b1]}, {pair: [b2, c1]}, {pair: [b3, d1]}]
inputs: {a: 1}
outputs: {c: {expect: 117/253}, d: {expect: 78/319}}
"""
    tree = find_spur_tree(load(text).declaration)
    found = find_reconstructions(evidence_question(lost_evidence(tree, ["b"])).problem)
    assert [count.solutions for count in found.counts] == [0, 0, 0, 1]
    assert is_found(tree, ["b"], found)


@pytest.mark.parametrize("lost", [["b"], ["c"], ["s"], ["c", "s"]])
def test_plain_growth_finds_the_train_and_as_many_others(lost: list[str]) -> None:
    tree = sample("targets: [{speed: -1/2, tolerance: 1/100}, {period: 700 d}]", "expect: -1/2")
    problem = evidence_question(lost_evidence(tree, lost)).problem
    right = explanations(problem)
    assert concrete(tree.arbor(lost)) in right[-1].solutions
    assert [count.solutions for count in find_reconstructions(problem).counts] == [
        each.counts.solutions for each in right
    ]
