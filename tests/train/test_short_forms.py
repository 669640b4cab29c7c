"""Short forms mean exactly the long ones, keep their places, and are written either way without a loss."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest
from commands import call
from hypothesis import given
from hypothesis import strategies as st
from shipped import every_train

import geartrain
from geartrain import shipped
from geartrain.errors import DeclarationError
from geartrain.train.declaration_style import with_long_forms, with_short_forms

LONG = """\
name: set
links:
  frame: {wheels: {r: {teeth: 60, internal: true}}}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  carrier: {}
revolutes:                                   # joints
  - {pair: [frame, sun], axis: main}         # the input
  # between them
  - {pair: [frame, carrier], axis: main}
  - {pair: [carrier, planet], axis: P}
gears:
  - {pair: [s, p]}
  - {pair: [p, r], efficiency: 0.98}         # measured
inputs: {sun: 1}
outputs: {carrier: {expect: 2/7}}
"""
SHORT = """\
name: set
links:
  frame: {wheels: {r: {teeth: 60, internal: true}}}
  sun: {wheels: {s: 24}}
  planet: {wheels: {p: 18}}
  carrier: {}
revolutes:  # joints
  # between them
  main: [frame, sun, carrier]  # the input
  P: [carrier, planet]
gears:
  - s ~ p
  - {pair: [p, r], efficiency: 0.98}  # measured
inputs: {sun: 1}
outputs: {carrier: {expect: 2/7}}
"""


def test_the_short_form_declares_the_same_train() -> None:
    long, short = geartrain.load(LONG), geartrain.load(SHORT)
    assert long.declaration.model_dump() == short.declaration.model_dump()
    assert short.solve()


def test_a_text_is_rewritten_either_way_with_its_comments() -> None:
    assert with_short_forms(LONG) == SHORT
    assert with_short_forms(SHORT) == SHORT
    assert with_short_forms(with_long_forms(SHORT)) == SHORT
    assert (
        geartrain.load(with_long_forms(SHORT)).declaration.model_dump() == geartrain.load(LONG).declaration.model_dump()
    )


def test_plain_data_may_be_short_too() -> None:
    data = {
        "links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
        "revolutes": {"A": ["frame", "a"], "B": ["frame", "b"]},
        "gears": ["p ~ w"],
        "inputs": {"a": 1},
    }
    assert geartrain.GearTrain.declare(data).solve()["b"] * 3 == -1


@pytest.mark.parametrize("name", every_train())
def test_every_shipped_train_is_short_and_means_what_its_long_form_means(name: str) -> None:
    path = shipped()[name]
    text = path.read_text(encoding="utf-8")
    assert with_short_forms(text) == text
    long = with_long_forms(text)
    assert sorted(_comments(long)) == sorted(_comments(text))
    assert with_short_forms(long) == text


def _comments(text: str) -> list[str]:
    return [word for line in text.splitlines() if "#" in line for word in line.partition("#")[2].split()]


def test_a_chain_of_joints_stays_long() -> None:
    text = LONG.replace("[frame, carrier], axis", "[sun, carrier], axis")
    found = with_short_forms(text)
    assert "pair: [sun, carrier]" in found
    assert "- s ~ p" in found


def test_a_pair_with_more_to_say_or_a_name_in_quotes_stays_long() -> None:
    text = LONG.replace("{pair: [s, p]}", "{pair: ['s', p], note: here}")
    assert "{pair: ['s', p], note: here}" in with_short_forms(text)


def test_problems_are_told_at_the_line_of_the_short_form(tmp_path: Path) -> None:
    file = tmp_path / "set.yaml"
    for wrong, words in {
        SHORT.replace("P: [carrier, planet]", "P: [carrier, plant]"): ":10: no link 'plant'",
        SHORT.replace("P: [carrier, planet]", "P: [carrier]"): ":10: axis 'P' has fewer than two links",
        SHORT.replace("- s ~ p", "- s ~"): ":12: 's ~' is not a gear pair",
        SHORT.replace("- s ~ p", "- sun ~ p"): "'sun' is a link, and a pair names two wheels",
        SHORT.replace("- s ~ p", "- carrier ~ p"): "'carrier' is a link without wheels",
    }.items():
        file.write_text(wrong, encoding="utf-8")
        with pytest.raises(DeclarationError) as caught:
            geartrain.load(str(file))
        assert words in str(caught.value)


def test_a_child_lays_short_forms_over_its_parent(tmp_path: Path) -> None:
    (tmp_path / "parent.yaml").write_text(SHORT, encoding="utf-8")
    child = """
extends: parent.yaml
links: {arm: {wheels: {q: 20}}}
revolutes: {Q: [frame, arm]}
gears: [{pair: [s, p], efficiency: 0.9}, s ~ q]
outputs: {arm: {expect: -6/5}}
"""
    (tmp_path / "child.yaml").write_text(child, encoding="utf-8")
    train = geartrain.load(str(tmp_path / "child.yaml"))
    assert train.solve()
    assert [gear.name for gear in train.declaration.gears] == ["s~p", "p~r", "s~q"]
    assert train.declaration.gears[0].efficiency is not None


def test_the_command_rewrites_checks_and_leaves_broken_files_alone(tmp_path: Path) -> None:
    file = tmp_path / "set.yaml"
    file.write_text(LONG, encoding="utf-8")
    assert call("format", "--check", file).exit_code == 1
    assert file.read_text(encoding="utf-8") == LONG
    assert call("format", file).exit_code == 0
    assert file.read_text(encoding="utf-8") == SHORT
    assert call("format", "--check", file).exit_code == 0
    broken = LONG.replace("[s, p]", "[s, x]")
    file.write_text(broken, encoding="utf-8")
    assert call("format", file).exit_code == 2
    assert file.read_text(encoding="utf-8") == broken
    file.write_text(LONG, encoding="utf-8")
    printed = call("format", file, "-o", "-")
    assert printed.stdout == SHORT
    assert file.read_text(encoding="utf-8") == LONG


NAMES = st.text("abcxyz0189_-. ", min_size=1, max_size=6).filter(lambda name: name.strip() == name)


@given(st.dictionaries(NAMES, st.integers(1, 99), min_size=2, max_size=6))
def test_names_of_any_kind_survive_both_ways(wheels: dict[str, int]) -> None:
    import json

    links = {"frame": {}, **{f"l{at}": {"wheels": {name: count}} for at, (name, count) in enumerate(wheels.items())}}
    names = list(wheels)
    lines = [f"links: {json.dumps(links)}", "revolutes:"]
    lines += [f"  - {{pair: [frame, l{at}], axis: {json.dumps(f'A{at}')}}}" for at in range(len(names))]
    lines += ["gears:", *(f"  - pair: [{json.dumps(a)}, {json.dumps(b)}]" for a, b in itertools.pairwise(names))]
    lines += ["inputs: {l0: 1}", ""]
    text = "\n".join(lines)
    before = geartrain.load(text).declaration.model_dump()
    for rewritten in (with_short_forms(text), with_long_forms(text), with_long_forms(with_short_forms(text))):
        assert geartrain.load(rewritten).declaration.model_dump() == before
