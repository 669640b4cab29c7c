"""Sizes of the triangular teeth of a train: the improvement, the written declaration, and published values."""

from __future__ import annotations

from math import degrees, prod, radians
from pathlib import Path
from typing import Any

import pytest
from commands import call

import geartrain
from geartrain import GearTrain
from geartrain.dynamics import MotionRun, find_power_flow
from geartrain.errors import QuestionError
from geartrain.workshop import SizeLimit, ToothSizes, find_train_sizes

NARROW = {"radii": (0.99, 1.06)}
TWO = """
links:
  frame: {}
  a: {wheels: {a: 48}}
  b: {wheels: {b1: 24, b2: 48}}
  c: {wheels: {c: 24}}
  d: {wheels: {d: 40}}
revolutes:
  - {pair: [frame, a], axis: A}
  - {pair: [frame, b], axis: B}
  - {pair: [frame, c], axis: C}
  - {pair: [frame, d], axis: D}
gears: [{pair: [a, b1]}, {pair: [b2, c]}, {pair: [a, d]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
friction: 0.2
inputs: {a: 1}
outputs: {c: {}}
"""


def test_together_is_no_worse_than_pair_by_pair_and_both_are_better_than_declared() -> None:
    """What two pairs in a row pass on is the product of their means."""
    found = find_train_sizes(geartrain.load(TWO), "c", free=NARROW)
    assert found.before is not None
    assert found.together <= found.apart < found.before
    assert [pair.name for pair in found.pairs] == ["a~b1", "b2~c"]
    assert found.untouched == {"a~d": "not on the way to 'c'"}
    assert all(pair.outlines.turns and pair.outlines.difference < 1e-4 for pair in found.pairs)

    passed = prod(1 - pair.together.loss_at_constant_load for pair in found.pairs)
    assert 1 - found.together == pytest.approx(passed, rel=1e-9)


def test_pairs_that_name_the_driven_wheel_first_are_sized_alike() -> None:
    """The same train with its pairs named the other way round: the same gain, by radii the other way round."""
    turned = TWO.replace("[a, b1]", "[b1, a]").replace("[b2, c]", "[c, b2]")
    turned = turned.replace("window: 0.5}", "window: 0.5, radii: 0.97}")
    straight = TWO.replace("window: 0.5}", f"window: 0.5, radii: {1 / 0.97!r}}}")
    trains = (geartrain.load(text) for text in (straight, turned))
    one, other = (find_train_sizes(train, "c", free={"window": (0.4, 0.7)}) for train in trains)
    for figure in ("before", "apart", "together"):
        assert getattr(other, figure) == pytest.approx(getattr(one, figure), rel=1e-5)
    for first, second in zip(one.pairs, other.pairs, strict=True):
        assert first.driver == second.driver
        assert first.teeth == second.teeth[::-1]
        assert first.before.radii * second.before.radii == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("folder", ["", "below"])
def test_the_declaration_extends_the_train_from_wherever_it_is_written(tmp_path: Path, folder: str) -> None:
    """The value is the one that was printed; only the window is free, so the search is short."""
    source, written = tmp_path / "two.yaml", tmp_path / folder / "best.yaml"
    source.write_text(TWO, encoding="utf-8")
    written.parent.mkdir(exist_ok=True)
    done = call("optimise", source, "--of", "c", "--free", "window", "-o", written)
    assert done.exit_code == 0, done.output
    before, after = (geartrain.load(str(path)).driven("c", "a").efficiency for path in (source, written))
    assert before is not None
    assert after is not None
    said = " ".join(done.stdout.split())
    assert f"as declared {100 * (1 - float(before)):.4f} %" in said
    assert f"together {100 * (1 - float(after)):.4f} %" in said
    assert after > before


def test_a_half_angle_is_free_only_where_all_mates_are_sized() -> None:
    """The wheel `a` has another mate, off the way to the output; `b2` and `c` have each other."""
    found = find_train_sizes(geartrain.load(TWO), "c", "jam", {"window": (0.4, 0.6), "half_angle": (0.5, 0.6)})
    kept, changed = (pair.together.half_angles for pair in found.pairs)
    assert kept == pytest.approx((0.5235987755982988,) * 2)
    assert changed[0] != kept[0]


ROW = """
links: {frame: {}, a: {wheels: {a: 24}}, b: {wheels: {b: 36}}, c: {wheels: {c: 48}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [a, b]}, {pair: [b, c]}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5, radii: pitch_true}
friction: 0.2
inputs: {a: 1}
"""


@pytest.mark.parametrize("aim", ["loss", "jam"])
def test_pairs_that_share_a_wheel_are_given_one_half_angle(aim: str) -> None:
    """No worse than a scan of the half angle of both, in steps of half a degree."""
    low, high = radians(26), radians(38)
    found = find_train_sizes(geartrain.load(ROW), "c", aim, {"half_angle": (low, high)})
    angles = {angle for pair in found.pairs for angle in pair.together.half_angles}
    assert len(angles) == 1
    assert found.together <= found.apart if aim == "loss" else found.together >= found.apart
    scanned = []
    for angle in range(52, 77):
        train = geartrain.load(ROW.replace("30 deg", f"{angle / 2} deg"))
        if aim == "loss":
            scanned.append(1 - float(train.driven("c", "a").efficiency or 0))
        else:
            sizes = (ToothSizes(counts, 1.0, 0.5, (radians(angle / 2),) * 2, 0.2) for counts in ((24, 36), (36, 48)))
            scanned.append(-min(each.jam for each in sizes))
    assert (found.together if aim == "loss" else -found.together) <= min(scanned) + 1e-9
    declared = {gear["tooth_form"]["half_angle"] for gear in found.declaration["gears"]}
    assert declared == {f"{degrees(angles.pop()):.10g} deg"}


def test_what_cannot_be_requested_is_said() -> None:
    train = geartrain.load(TWO)
    refused = (("a", "loss", "acts on 'a'"), ("nobody", "loss", "nobody"), ("c", "speed", "not an objective"))
    for output, aim, word in refused:
        with pytest.raises(QuestionError, match=word):
            find_train_sizes(train, output, aim)
    with pytest.raises(QuestionError, match="violates a limit"):
        find_train_sizes(train, "c", "jam", {"window": (0.4, 0.6)}, [SizeLimit("impact", 1e-6)])


def pennestri(**teeth: Any) -> GearTrain:
    form = {"form": "triangular", "half_angle": "30 deg", "window": "0.5"} | teeth
    return GearTrain.declare({"extends": "pennestri-2002-teeth", "tooth_form": form})


@pytest.mark.parametrize(
    ("radii", "at_load", "at_driver", "circulating"),
    [("equal_depth", 0.5314, 0.5340, 1.0286), ("pitch_true", 0.7339, 0.7454, 1.2604)],
)
def test_the_published_train_with_both_means(radii: str, at_load: float, at_driver: float, circulating: float) -> None:
    """From crank to link 19; with the mean at constant driver torque declared as the efficiency of every pair."""
    train = pennestri(radii=radii)
    assert float(train.driven("19", "2").efficiency or 0) == pytest.approx(at_load, abs=5e-5)
    gears = []
    for mesh in train.meshes:
        forward, backward = (repr(mesh.efficiency(wheel).mean) for wheel in mesh.gear.pair)
        efficiency = {"forward": forward, "backward": backward}
        gears.append({"id": mesh.name, "pair": mesh.gear.pair, "efficiency": efficiency})
    declared = GearTrain.declare({"extends": "pennestri-2002-teeth", "gears": gears})
    found = declared.driven("19", "2")
    assert float(found.efficiency or 0) == pytest.approx(at_driver, abs=5e-5)
    (loop,) = find_power_flow(found).loops
    assert float(loop.of_power_in) == pytest.approx(circulating, abs=5e-5)


@pytest.mark.long
@pytest.mark.parametrize(("aim", "output", "most"), [("loss", "19", 0.15743), ("error", "5", 2.6063)])
def test_the_published_train_with_the_best_radii(aim: str, output: str, most: float) -> None:
    train = pennestri()
    found = find_train_sizes(train, output, aim)
    assert found.before is not None
    assert found.together <= found.apart < found.before
    assert (degrees(found.together) if aim == "error" else found.together) <= most
    better = GearTrain.declare(found.declaration | {"extends": "pennestri-2002-teeth"})
    assert not better.mechanics.faults
    if aim == "error":
        run = MotionRun(better.motion(None, (output,)), 20, 20_000)
        run.run()
        assert run.statistics[0].peak_to_peak == pytest.approx(found.together, rel=1e-9)
    else:
        assert 1 - float(better.driven(output, "2").efficiency or 0) == pytest.approx(found.together, rel=1e-9)
