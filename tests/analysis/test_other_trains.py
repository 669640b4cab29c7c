"""Trains with other counts, inputs and teeth: one by one, and a table of all combinations at once."""

from __future__ import annotations

from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from shipped import train as load

import geartrain
from geartrain.errors import GearTrainError


def test_other_counts_are_those_of_a_declaration_that_says_so() -> None:
    train = load("longcase-clock")
    assert train.with_teeth(c60=64, t8=8).solve()["third"] == Fraction(-64, 8) * train.solve()["centre"]
    assert train.with_teeth({"c60": 64}).declaration.wheels["c60"][1].count == 64
    assert train.declaration.wheels["c60"][1].count == 60, "the first one is as it was"
    with pytest.raises(GearTrainError, match="no wheel 'c6'"):
        train.with_teeth(c6=64)


def test_other_inputs_are_read_like_declared_ones() -> None:
    train = load("planetary-24-18-60")
    assert train.with_changes(inputs={"carrier": "2/7"}).solve()["sun"] == 1
    assert train.with_changes(inputs={"sun": "70 rpm"}).solve()["carrier"] == 20
    with pytest.raises(GearTrainError, match="no link 'son'"):
        train.with_changes(inputs={"son": 1})
    with pytest.raises(GearTrainError, match="inputs"):
        train.with_changes(inputs={"sun": "fast"})


def test_another_tooth_form_is_that_of_all_pairs_or_of_one() -> None:
    train = load("longcase-clock")
    assert {mesh.form for mesh in train.with_changes(tooth_form="involute").meshes} == {"involute"}
    one = train.with_changes(gears=[{"pair": ["c60", "t8"], "tooth_form": {"form": "cycloidal"}}])
    assert [mesh.name for mesh in one.meshes] == ["c60~t8"]
    with pytest.raises(GearTrainError, match="no wheel 't9'"):
        train.with_changes(gears=[{"pair": ["c60", "t9"], "tooth_form": "involute"}])
    with pytest.raises(GearTrainError, match="tooth_form"):
        train.with_changes(tooth_form="involut")


@pytest.mark.parametrize(
    ("name", "counts"),
    [
        ("planetary-24-18-60", {"s": range(20, 24), "p": (15, 18), "ring": range(58, 63)}),
        ("wolfrom-175", {"p28": range(26, 31), "r70": range(69, 73), "p30": (30,)}),
        ("freeth-2008", {"b2": range(60, 68), "e3": (222, 223), "m1": (95, 96)}),
        ("humpage", {"p24": range(22, 26), "i20": range(19, 22)}),
        ("three-planets", {"s30": (30, 32), "r78": (78, 80)}),
    ],
)
def test_a_table_has_what_solving_each_train_gives(name: str, counts: dict[str, range]) -> None:
    """The exact solver on every combination, locked ones too."""
    train = load(name)
    found = train.variants(counts)
    assert len(found) == np.prod([len(each) for each in counts.values()])
    assert found.counts.tolist() == [list(each) for each in product(*counts.values())]
    for row, chosen in enumerate(product(*counts.values())):
        answer = train.with_teeth(dict(zip(counts, chosen, strict=True))).solve()
        for output in found.outputs:
            speed = answer.outputs[output].speed if answer.verdict else None
            assert found.exact(row, output) == speed
            if speed is None:
                assert np.isnan(found[output][row])
            else:
                off = abs(Fraction(float(found[output][row])) - Fraction(speed))
                bound = found.errors[row, found.outputs.index(output)]
                assert off <= abs(Fraction(speed)) * Fraction(float(bound)) if np.isfinite(bound) else True


def test_a_table_is_a_data_frame_and_says_what_it_lacks() -> None:
    pandas = pytest.importorskip("pandas")
    found = load("planetary-24-18-60").variants({"s": range(20, 26)}, ["carrier"])
    frame = found.to_frame()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame.columns) == ["s", "carrier"]
    assert frame["carrier"].tolist() == found["carrier"].tolist()
    assert "<table>" in found._repr_html_()
    with pytest.raises(KeyError, match="no column 'sun'"):
        found["sun"]
    with pytest.raises(GearTrainError, match="unknown output 'carier'"):
        load("planetary-24-18-60").variants({"s": (20,)}, ["carier"])
    with pytest.raises(GearTrainError, match="too many"):
        load("planetary-24-18-60").variants(dict.fromkeys(("s", "p", "ring"), range(1, 1001)))


def test_a_train_says_its_name_its_size_and_its_verdict() -> None:
    assert repr(load("planetary-24-18-60")) == "<GearTrain planetary-24-18-60: 4 links, 3 wheels; determined>"
    assert repr(load("zf-8hp70")) == "<GearTrain zf-8hp70: 13 links, 12 wheels, 9 states; determined>"
    assert repr(load("planetary-24-18-60").with_changes(inputs={})).endswith("; free>")


FRICTIONS = (0, 0.02, 0.1)


def test_any_key_is_changed_in_one_call_as_a_declaration_that_says_so_would() -> None:
    name = "planetary-24-18-60-involute"
    train = load(name)
    for friction in FRICTIONS:
        written = geartrain.load(f"extends: {name}\nfriction: {friction}\n")
        changed = train.with_changes(friction=friction)
        assert changed.driven("carrier", "sun").efficiency == written.driven("carrier", "sun").efficiency
        assert changed.name == train.name
    assert train.declaration.friction == geartrain.load(name).declaration.friction, "the first one is as it was"


def test_parts_are_merged_by_name_replaced_unset_and_removed() -> None:
    train = load("planetary-24-18-60")
    assert train.with_changes(links={"sun": {"wheels": {"s": 30}}}).solve()["carrier"] == Fraction(1, 3)
    assert train.with_changes({"inputs": {"carrier": 2}}).solve()["sun"] == 7
    assert train.with_changes(remove={"gears": ["s~p"]}).solve().verdict.kind == "free"
    again = train.with_changes(gears=["s ~ p"], remove={"gears": ["s~p"]})
    assert again.solve()["carrier"] == Fraction(2, 7)
    assert train.with_changes(friction=0.1).with_changes(friction=None).declaration.friction is None
    assert train.with_changes(outputs={"more": {"of": "planet"}}).solve()["more"] == Fraction(-2, 3)


def test_what_is_not_changed_stays_as_it_was_declared_and_where_it_was_written() -> None:
    for name in geartrain.shipped():
        before = load(name).declaration
        after = load(name).with_changes().declaration
        # a tour describes the train that declares it
        assert after.model_dump() == before.model_dump() | {"tour": ()}
        parts = ("gears", 0) if before.gears else ("couplings", 0)
        for part in (("links", next(iter(before.links))), parts, ("outputs",)):
            assert after.place(*part) == before.place(*part)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"frction": 0.1}, "did you mean 'friction'"),
        ({"friction": "much"}, "'much' is not a number"),
        ({"inputs": {"son": 1}}, "no link 'son'"),
        ({"links": {"frame": {"wheels": {"s": 20}}}}, "write it under `sun`"),
        ({"remove": {"gears": ["zz"]}}, "the parent has no such entry in gears"),
    ],
)
def test_a_change_that_a_declaration_cannot_say_is_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        load("planetary-24-18-60").with_changes(changes)
    assert said in str(caught.value)


def test_a_changed_declaration_is_read_like_a_written_one() -> None:
    declared = load("planetary-24-18-60-involute").declaration
    found = geartrain.GearTrain(declared.changed(friction=0.1)).driven("carrier", "sun")
    other = geartrain.GearTrain(declared).with_changes(friction="0.1")
    assert found.efficiency == other.driven("carrier", "sun").efficiency
    assert declared.changed(friction=0.1).place("links") == declared.place("links")
    for changes in ({"friction": "much"}, {"frction": 0.1}, {"gears": 3}):
        with pytest.raises(GearTrainError):
            declared.changed(**changes)


def test_a_table_of_planetary_sets_is_off_by_rounding_and_by_no_more() -> None:
    """The carrier turns by s/(s + r) of the sun."""
    made = load("planetary-24-18-60").variants({"s": range(11, 38), "ring": range(47, 74)}, ["carrier"])
    assert abs(made["carrier"] / (made["s"] / (made["s"] + made["ring"])) - 1).max() < 1e-15
    assert repr(made) == "<TrainVariants 729 trains by s, ring; carrier>"
