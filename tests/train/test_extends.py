"""`extends`: remove, then merge, then validate; each sentence of the rules a test, with marks into the right file."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import yaml
from commands import call

from geartrain import GearTrain, GearTrainError, load, shipped

PARENT = """\
name: parent
title: The parent
sources: {S: {cite: first, url: here}}
unit: {per: 7 d}
links:
  frame: {}
  a: {wheels: {p: 20}}
  b: {wheels: {w: {teeth: 60, source: S}, x: 10}}
  c: {wheels: {y: 40}}
axes: {A: {direction: [0, 0, 1]}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
  - {pair: [frame, c], axis: C}
gears:
  - {pair: [p, w]}
  - {id: second, pair: [x, y], source: S}
inputs: {a: 12}
dials: {d: {turns: 4, divisions: 47}}
outputs:
  b: {expect: -4}
  last: {of: c, expect: 1, dial: d}
"""

Child = Callable[[str], GearTrain]


@pytest.fixture
def child(tmp_path: Path) -> Child:
    """Loads a child of the parent above, both from files."""
    (tmp_path / "parent.yaml").write_text(PARENT, encoding="utf-8")

    def build(text: str) -> GearTrain:
        path = tmp_path / "child.yaml"
        path.write_text(f"extends: parent.yaml\n{text}\n", encoding="utf-8")
        return load(path)

    return build


def test_a_child_that_says_nothing_is_its_parent_but_for_name_and_title(child: Child) -> None:
    train = child("note: nothing changed")
    assert train.solve()["last"] == 1
    assert train.solve()
    assert train.name == "child", "the name is not inherited: it is the file's"
    assert train.declaration.title == ""


def found(train: GearTrain) -> dict[str, Any]:
    """What the cases below look at, by name."""
    declared, tree = train.declaration, train.kinematics.tree
    last = declared.outputs.get("last")
    return {
        "wheels": {name: (wheel.count, wheel.source, wheel.status) for name, (_, wheel) in declared.wheels.items()},
        "pairs": {circuit.id: circuit.wheels for circuit in train.circuits},
        "pair source": declared.gears[-1].source,
        "joints": {link: tree.parent[link] for link in declared.links if link != "frame"},
        "speeds": {link: speed for link, speed in train.solve().speeds.items() if link != "frame"},
        "inputs": list(declared.inputs),
        "outputs": list(declared.outputs),
        "failures": [output.name for output in train.solve().failures],
        "last": last and (last.of, last.dial, last.expect.value.value),
        "unit": declared.unit,
        "dials": list(declared.dials),
        "axes": list(declared.axes),
    }


SECOND = ("x", "y")


@pytest.mark.parametrize(
    ("text", "changed"),
    [
        # a short form keeps what the parent says of the wheel, and a long one merges with a short one
        (
            "links: {b: {wheels: {w: 80}}, a: {wheels: {p: {status: surviving}}}}",
            {
                "wheels": {
                    "p": (20, None, "surviving"),
                    "w": (80, "S", None),
                    "x": (10, None, None),
                    "y": (40, None, None),
                }
            },
        ),
        # outputs merge by name and key, and null removes a key or an entry
        ("outputs: {last: {expect: 5}, fresh: {of: a}}", {"last": ("c", "d", 5), "outputs": ["b", "last", "fresh"]}),
        ("unit: ~\noutputs: {b: null}", {"unit": None, "outputs": ["last"]}),
        ("outputs: {b: {expect: null}}\nlinks: {b: {wheels: {w: {teeth: 80}}}}", {"failures": ["last"]}),
        # inputs are replaced whole, gear pairs merge by name with their wheels replaced whole, turning pairs by links
        ("inputs: {c: 1}\noutputs: ~", {"inputs": ["c"], "speeds": {"a": 12, "b": -4, "c": 1}}),
        (
            "gears: [{id: second, pair: [p, y]}]\noutputs: ~",
            {"pairs": {"p~w": ("p", "w"), "second": ("p", "y")}, "pair source": "S"},
        ),
        (
            "links: {d: {wheels: {z: 10}}}\nrevolutes: [{pair: [frame, d], axis: D}]\ngears: [{pair: [y, z]}]",
            {"pairs": {"p~w": ("p", "w"), "second": SECOND, "y~z": ("y", "z")}},
        ),
        (
            "revolutes: [{pair: [c, frame], axis: A2}]",
            {"joints": {"a": ("frame", "A"), "b": ("frame", "B"), "c": ("frame", "A2")}},
        ),
        # a removed link takes its wheels, joints and pairs along, a wheel its pairs; what remains is merged afterwards
        (
            "remove: {links: [c], outputs: [last]}",
            {"pairs": {"p~w": ("p", "w")}, "joints": {"a": ("frame", "A"), "b": ("frame", "B")}},
        ),
        ("remove: {wheels: [x], outputs: [last]}", {"pairs": {"p~w": ("p", "w")}}),
        (
            "remove: {gears: [second], outputs: [last], dials: [d], axes: [A]}",
            {"pairs": {"p~w": ("p", "w")}, "dials": [], "axes": []},
        ),
        (
            "remove: {links: [c]}\nlinks: {c: {wheels: {y: 30}}}\n"
            "revolutes: [{pair: [frame, c], axis: C}]\ngears: [{pair: [x, y]}]\noutputs: {last: {expect: 4/3}}",
            {"speeds": {"a": 12, "b": -4, "c": Fraction(4, 3)}, "failures": []},
        ),
        (
            "remove: {revolutes: [[b, frame]]}\nrevolutes: [{pair: [b, a], axis: A}]\ngears: [{id: p~w, pair: [p, y]}]",
            {"joints": {"a": ("frame", "A"), "b": ("a", "A"), "c": ("frame", "C")}},
        ),
    ],
)
def test_what_a_child_says_is_merged_into_its_parent(child: Child, text: str, changed: dict[str, Any]) -> None:
    train = found(child(text))
    assert {key: train[key] for key in changed} == changed


def test_a_changed_tooth_count_changes_the_speed_and_inherited_expectations_stay_in_force(child: Child) -> None:
    answer = child("links: {b: {wheels: {w: 80}}}").solve()
    assert answer["b"] == -3
    assert {output.name for output in answer.failures} == {"b", "last"}


def test_sources_dials_and_axes_merge_by_name_and_key(child: Child) -> None:
    train = child("sources: {S: {note: seen}, T: other}\ndials: {d: {turns: 5}}\naxes: {A: {direction: [0, 0, -1]}}")
    declared = train.declaration
    assert (declared.sources["S"].cite, declared.sources["S"].url, declared.sources["S"].note) == (
        "first",
        "here",
        "seen",
    )
    assert declared.sources["T"].cite == "other"
    assert (declared.dials["d"].turns, declared.dials["d"].divisions) == (5, 47)
    assert train.solve()["b"] == 4, "the input a = 12 is now counted about the reversed axis"


def test_teeth_targets_and_fixed_are_replaced_whole(child: Child, tmp_path: Path) -> None:
    child(
        "links: {b: {wheels: {w: {teeth: {value: 60, range: [59, 61]}}}}}\n"
        "outputs: {b: {targets: [{period: 1 d}, {period: 2 d}]}}\nfixed: [frame]"
    )
    path = tmp_path / "grandchild.yaml"
    path.write_text(
        "extends: child.yaml\nlinks: {b: {wheels: {w: {teeth: {value: 60}}}}}\n"
        "outputs: {b: {targets: [{period: 3 d}]}}\nfixed: []\n",
        encoding="utf-8",
    )
    train = load(path)
    assert list(train.declaration.uncertain_wheels()) == []
    assert [str(target.period) for target in train.declaration.outputs["b"].targets] == ["3 d"]
    assert train.declaration.fixed == ()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("remove: {links: [cc]}", "child.yaml:2: `remove` names the unknown part 'cc'"),
        ("remove: {gears: [secnd]}", "did you mean 'second'"),
        ("remove: {wheels: [zz]}", "child.yaml:2: `remove` names the unknown part 'zz'"),
        ("remove: {outputs: [nothing]}", "child.yaml:2: `remove` names the unknown part 'nothing'"),
        ("remove: {revolutes: [[a, b]]}", "the unknown turning pair of a and b"),
        ("remove: {couplings: [pin]}", "child.yaml:2: `remove` names the unknown part 'pin'"),
        ("remove: {states: [s]}", "child.yaml:2: `remove` names the unknown part 's'"),
        ("remove: {colours: [red]}", "child.yaml:2: "),
        ("remove: {links: [c]}", "parent.yaml:22: no link 'c'"),  # what is left without its part is in the parent
        ("remove: {dials: [d]}", "parent.yaml:22: no dial 'd'"),
        ("links:\n  b: {wheels: {w: 0}}", "child.yaml:3: "),
        ("links: {a: {wheels: {w: 90}}}", "child.yaml:2: wheel 'w' is already on link 'b' of the parent"),
    ],
)
def test_a_mistake_is_reported_in_the_file_that_contains_it(child: Child, text: str, said: str) -> None:
    with pytest.raises(GearTrainError) as caught:
        child(text)
    assert said in str(caught.value)


def test_grandparents_are_merged_too(child: Child, tmp_path: Path) -> None:
    child("links: {b: {wheels: {w: 80}}}")
    grandchild = tmp_path / "grandchild.yaml"
    grandchild.write_text("extends: child.yaml\nlinks: {c: {wheels: {y: 20}}}\n", encoding="utf-8")
    assert load(grandchild).solve()["c"] == Fraction(12 * 20 * 10, 80 * 20)


def test_a_shipped_train_is_extended_by_its_name() -> None:
    train = load("extends: planetary-24-18-60\nlinks: {sun: {wheels: {s: 30}}}\n")
    assert train.solve()["carrier"] == Fraction(30, 90)
    assert train.solve().failures[0].name == "carrier"


def test_states_and_clutches_merge_by_name(tmp_path: Path) -> None:
    train = load(
        """
        extends: planetary
        clutches: {B: {fixes: sun}}
        states:
          two inputs: ~
          sun fixed: {fixed: [], engaged: [B]}
          half: {inputs: {sun: 1/2}, fixed: [ring], outputs: {carrier: {expect: 1/7}}}
        """
    )
    assert list(train.states) == ["ring fixed", "sun fixed", "carrier fixed", "direct drive", "half"]
    assert all(train.answers())


@pytest.mark.parametrize(
    ("name", "said"),
    [("nowhere.yaml", "no such file"), ("planetry", "did you mean 'planetary'"), ("''", "`extends` is empty")],
)
def test_a_parent_that_is_missing_is_refused(refused: Callable[..., GearTrainError], name: str, said: str) -> None:
    refused(f"title: orphan\nextends: {name}\n", said, line=2)


@pytest.mark.parametrize("length", [1, 2, 3])
def test_a_circle_of_parents_is_refused(tmp_path: Path, length: int) -> None:
    for at in range(length):
        (tmp_path / f"t{at}.yaml").write_text(f"extends: t{(at + 1) % length}.yaml\n", encoding="utf-8")
    with pytest.raises(GearTrainError, match="forms a cycle") as caught:
        load(tmp_path / "t0.yaml")
    assert "t0.yaml:1" in str(caught.value) or f"t{length - 1}.yaml:1" in str(caught.value)


@pytest.mark.parametrize("parent", ["links: [1, 2]", "gears: {a: b}", "links: {frame: 3}", "- a list", "revolutes: 7"])
@pytest.mark.parametrize(
    "text", ["links: {a: {wheels: {p: 3}}}", "remove: {links: [a]}", "gears: [{pair: [a, b]}]", "remove: 7"]
)
def test_a_parent_of_the_wrong_shape_is_refused_and_never_crashes(tmp_path: Path, parent: str, text: str) -> None:
    (tmp_path / "odd.yaml").write_text(parent + "\n", encoding="utf-8")
    path = tmp_path / "child.yaml"
    path.write_text(f"extends: odd.yaml\n{text}\n", encoding="utf-8")
    with pytest.raises(GearTrainError):
        load(path)


def test_plain_data_extend_a_train_as_a_file_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "parent.yaml").write_text(PARENT, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    text = "extends: parent.yaml\nremove: {outputs: [b]}\nlinks: {b: {wheels: {x: 20}}}\noutputs: {last: {expect: 2}}\n"
    data = yaml.safe_load(text)
    from_text, from_data = load(text), load(data)
    assert from_data.declaration.model_dump() == from_text.declaration.model_dump()
    assert from_data.solve()["last"] == from_text.solve()["last"] == 2
    assert load({"extends": "planetary-24-18-60", "inputs": {"sun": 7}}).solve()["carrier"] == 2


def test_a_mistake_in_plain_data_that_extend_a_file_has_its_path(tmp_path: Path) -> None:
    (tmp_path / "parent.yaml").write_text(PARENT, encoding="utf-8")
    with pytest.raises(GearTrainError, match=r"links\.b\.wheels\.w.*is not a tooth count"):
        load({"extends": str(tmp_path / "parent.yaml"), "links": {"b": {"wheels": {"w": 0}}}})


def test_a_removal_from_nothing_is_refused() -> None:
    with pytest.raises(GearTrainError, match="`remove` is given without `extends`"):
        load(PARENT + "remove: {outputs: [b]}\n")


def test_a_chain_of_fifteen_hundred_parents_is_read(tmp_path: Path) -> None:
    (tmp_path / "t0.yaml").write_text(PARENT, encoding="utf-8")
    for at in range(1, 1501):
        (tmp_path / f"t{at}.yaml").write_text(f"extends: t{at - 1}.yaml\ninputs: {{a: {at}}}\n", encoding="utf-8")
    assert load(tmp_path / "t1500.yaml").solve()["a"] == 1500


def test_a_chain_of_parents_without_end_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("geartrain.train.declaration_files._MOST_PARENTS", 3)
    (tmp_path / "t0.yaml").write_text(PARENT, encoding="utf-8")
    for at in range(1, 6):
        (tmp_path / f"t{at}.yaml").write_text(f"extends: t{at - 1}.yaml\n", encoding="utf-8")
    assert load(tmp_path / "t3.yaml").solve()
    with pytest.raises(GearTrainError, match="the chain of `extends` is too long"):
        load(tmp_path / "t5.yaml")


def test_the_catalogue_of_shipped_trains_cannot_be_emptied() -> None:
    with pytest.raises(AttributeError):
        shipped().clear()  # type: ignore[attr-defined]
    assert "planetary" in shipped()


def test_a_wheel_of_the_parent_declared_on_another_link_is_refused_with_the_link_to_write_it_under(
    child: Child,
) -> None:
    with pytest.raises(GearTrainError) as caught:
        child("links:\n  w: {wheels: {w: 80}}")
    message = str(caught.value)
    assert "child.yaml:3: wheel 'w' is already on link 'b' of the parent" in message
    assert "to change the parent's wheel, write it under `b`: `links: {b: {wheels: {w: ...}}}`" in message
    assert "rename" not in message
    assert child("links: {b: {wheels: {w: 80}}}").solve()["b"] == -3  # as the message says


def test_a_wheel_that_the_child_takes_from_its_parent_may_be_put_on_another_link(child: Child) -> None:
    for removal in (
        "remove: {wheels: [x]}\nlinks: {a: {wheels: {x: 15}}}",
        "links: {b: {wheels: {x: null}}, a: {wheels: {x: 15}}}",
    ):
        assert child(removal + "\ngears: [{id: second, pair: [x, y]}]").solve()["c"] == Fraction(-12 * 15, 40)


def test_an_added_wheel_that_meshes_nothing_is_the_first_line_of_check(child: Child, tmp_path: Path) -> None:
    child("links: {c: {wheels: {z: 80}}}\naxes: {A: {position: [0 mm, 0 mm, 0 mm]}}\ngears: [{id: more, pair: [p, y]}]")
    result = call("check", tmp_path / "child.yaml")
    lines = [line for line in result.output.splitlines() if not line.startswith("FAIL")]
    assert len(lines) > 1
    assert lines[0].startswith(f"note {tmp_path / 'child.yaml'}:2: wheel 'z' is not in mesh")
