"""Real teeth and pins within trains."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest
from commands import call
from models import PAIR

from geartrain import GearTrainError, load
from geartrain.teeth import GearMesh, Triangular

TEETH = "tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.02}\nfriction: 0.1\ninputs: {a: 1}"
# 20/60 turns between 1.01031 and 1.0390 (30 deg, equal depth)


def test_a_form_of_the_train_holds_for_every_pair_without_one() -> None:
    (mesh,) = load(PAIR.format(rest=TEETH)).meshes
    assert (mesh.driver, mesh.driven) == ("p", "w")
    assert mesh.verdict.kind == "runs"
    assert mesh.fault is None
    assert mesh.friction == 0.1
    assert 1 + mesh.window.jam == pytest.approx(1.01031, abs=6e-6)
    assert 1 + mesh.window.run == pytest.approx(1.0390, abs=6e-5)


@pytest.mark.parametrize(("clearance", "kind"), [("1.001", "jam"), ("1.05", "dwell")])
def test_teeth_that_cannot_turn_fail_the_check_and_the_report(tmp_path, clearance: str, kind: str) -> None:
    path = tmp_path / "t.yaml"
    path.write_text(PAIR.format(rest=TEETH.replace("1.02", clearance)), encoding="utf-8")
    result = call("check", path)
    assert result.exit_code == 1
    assert f"FAIL {path}:" in result.output
    assert "window of this pair" in result.output
    report = call("report", path)
    assert report.exit_code == 1
    (data,) = json.loads(call("report", path, "--json").output)
    assert data["teeth"][0]["verdict"]["kind"] == kind


def test_a_pair_with_too_few_teeth_is_refused() -> None:
    train = load(PAIR.format(rest=TEETH).replace("p: 20", "p: 2"))
    with pytest.raises(GearTrainError, match="a wheel of 2 teeth cannot have triangular teeth"):
        _ = train.meshes


def test_an_ideal_pair_costs_nothing_even_among_real_ones() -> None:
    text = PAIR.format(rest=TEETH).replace("pair: [p, w]", "pair: [p, w], tooth_form: {form: ideal}")
    assert load(text).meshes == ()


@pytest.mark.parametrize("friction", ["-0.1", "much"])
def test_a_friction_that_is_none_is_refused(friction: str) -> None:
    with pytest.raises(GearTrainError, match="friction"):
        load(PAIR.format(rest=TEETH.replace("0.1", friction)))


def test_the_pairs_of_the_note_do_in_a_train_what_they_do_alone() -> None:
    (data,) = json.loads(call("report", "sorge-pairs", "--json").output)
    jumps = {mesh["pair"]: [round(jump["value"], 4) for jump in mesh["jumps"]] for mesh in data["teeth"]}
    single, double = {"3a": 0.1582, "3b": 0.1457, "4a": 0.1117}, {"5a": [0.0876, 0.0095], "5b": [0.0119, 0.0696]}
    assert jumps == {name: [jump] for name, jump in single.items()} | {"4b": [0.0316, 0.0682], **double}


def test_ideal_teeth_have_the_transmission_of_their_counts_and_import_nothing() -> None:
    code = """
import sys
from geartrain.teeth import Ideal
laws = [Ideal(form="ideal").transmission(20, 60, driver=driver) for driver in (1, 2)]
assert [str(law.ratio) for law in laws] == ['1/3', '3']
assert [law.error_range() for law in laws] == [(0.0, 0.0)] * 2
assert "numpy" not in sys.modules
print(laws[0].angle([0.0, 3.0]).tolist(), laws[1].efficiency(0.5))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[0.0, 1.0] 1.0"


UNLOADED = "extends: pennestri-2002-teeth\nname: unloaded\nloads: null\n"


@pytest.mark.parametrize(
    ("name", "output", "pairs"),
    [("pennestri-2002-teeth", "3", 1), (UNLOADED, "3", 1), (UNLOADED, "5", 4), ("moon-triangular", "d", 3)],
)
def test_motion_makes_the_teeth_that_its_outputs_depend_on(
    name: str, output: str, pairs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pairs are counted by hand along the paths from the input. As shipped, one output carries the load."""
    made: list[tuple[int, int]] = []
    mesh = Triangular.mesh

    def counted(self: Triangular, wheels: Any, shaft_angle: Any) -> GearMesh:
        made.append(wheels.counts)
        return mesh(self, wheels, shaft_angle)

    monkeypatch.setattr(Triangular, "mesh", counted)
    for way in (1.0, -1.0):
        next(load(name).motion(outputs=[output])._stretches(way, 3))
        assert len(made) == pairs
        made.clear()


def test_teeth_that_cannot_be_built_do_not_keep_other_outputs_from_moving() -> None:
    broken = load(
        f"{UNLOADED}gears:\n- id: G11\n"
        "  tooth_form: {form: triangular, half_angle: 30 deg, radii: [1 mm, 1 m], window: 0.5}\n"
    )
    with pytest.raises(GearTrainError, match="G11"):
        _ = broken.meshes
    with pytest.raises(GearTrainError, match="G11"):
        broken.motion(outputs=["moon"]).at([0.0])
    right, found = (train.motion(outputs=["3"]).at([0.1]).error for train in (load(UNLOADED), broken))
    assert (found == right).all()
