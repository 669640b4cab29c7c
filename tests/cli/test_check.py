"""What `check` says: notes when they are needed, every figure it looked at, and what it found in place of one."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from commands import RIGHT, call

from geartrain import load

Write = Callable[..., Path]
Written = Callable[[str], Path]


@pytest.fixture
def written(train_file: Write) -> Callable[[str], Path]:
    """Return a function that writes a train with some outputs."""
    return lambda outputs: train_file(RIGHT.split("outputs:")[0] + f"outputs:\n{outputs}\n")


# b turns at -2/3 of the input, c at 1/2; the wheel x meshes with y and z nowhere else
EXPECT, PUBLISHED = "  c: {expect: 1/2}", "  b: {published: {value: -1.50, as: input/output}}"


@pytest.mark.parametrize(
    ("outputs", "said"),
    [
        ("  c: {}", "nothing expected"),
        (EXPECT, "1 expectation holds"),
        (PUBLISHED, "1 published figure holds"),
        (EXPECT + "\n  b: {expect: -2/3}", "all 2 expectations hold"),
        (EXPECT + "\n" + PUBLISHED, "all 1 expectation and 1 published figure hold"),
        ("  c: {targets: [{speed: 0.4}]}", "nothing expected"),
        ("  c: {targets: [{speed: 0.501, tolerance: 0.2 %}]}", "1 target tolerance holds"),
        (
            EXPECT + "\n  b: {targets: [{speed: -2/3, tolerance: 0}, {speed: 0, tolerance: 1}]}",
            "all 1 expectation and 2 target tolerances hold",
        ),
        (
            EXPECT + "\n  b: {published: {value: -1.50, as: input/output}, targets: [{speed: -0.67, tolerance: 1 %}]}",
            "all 1 expectation, 1 published figure and 1 target tolerance hold",
        ),
    ],
)
def test_every_figure_that_was_looked_at_is_counted(written: Written, outputs: str, said: str) -> None:
    path = written(outputs)
    done = call("check", path)
    assert done.exit_code == 0
    assert done.stdout == f"ok   {path}: mobility 1, {said}\n"
    report = call("report", path).stdout
    assert f"Verdict: determined; {said}." in " ".join(report.split()) or said == "nothing expected"


@pytest.mark.parametrize(
    ("figure", "found"),
    [
        ("{value: -1.51, as: input/output}", "found -3/2 = -1.5"),
        ("{value: -0.6, as: output/input}", "found -2/3 = -0.66666667"),
        ("{value: 2, as: speed}", "found -2/3 = -0.66666667"),
    ],
)
def test_a_figure_that_fails_is_told_beside_what_was_found(written: Written, figure: str, found: str) -> None:
    path = written(f"  b: {{published: {figure}}}")
    for verb in ("check", "report"):
        done = call(verb, path)
        assert done.exit_code == 1
        assert found in " ".join(done.stdout.split()), done.stdout
    assert "1 of 1 published figure FAILS" in call("report", path).stdout
    (entry,) = json.loads(call("solve", path, "--json").stdout)["states"]
    assert entry["outputs"]["b"]["published"]["found"] == found.split()[1]


@pytest.mark.parametrize(
    ("target", "missed"),
    [
        # c turns at 1/2: 1/(2 * 0.501) - 1 = -1/501
        ("{speed: 0.501, tolerance: 0.1 %}", "target speed 0.501 missed by -1996.01 ppm (tolerance 0.1 %)"),
        ("{speed: -1/2, tolerance: 1 %}", "target speed -1/2 missed by -2e+06 ppm (tolerance 1 %)"),
        ("{speed: 0, tolerance: 0.49}", "target speed 0 missed by 0.5 (tolerance 0.49)"),
    ],
)
def test_a_missed_tolerance_of_a_target_fails_in_every_command(written: Written, target: str, missed: str) -> None:
    path = written(f"  c: {{targets: [{target}]}}")
    done = {verb: call(verb, path) for verb in ("check", "report", "solve")}
    assert [each.exit_code for each in done.values()] == [1, 1, 1]
    assert f"output 'c' is 1/2; {missed}" in done["check"].stdout
    assert "1 of 1 target tolerance FAILS" in done["report"].stdout
    assert "FAILS" in done["solve"].stdout
    assert not load(path).solve()
    relaxed = target[: target.index(", tolerance")] + "}"  # without a tolerance the target is information
    assert call("check", written(f"  c: {{targets: [{relaxed}]}}")).exit_code == 0


@pytest.mark.parametrize(
    ("outputs", "sign"),
    [
        ("b: {expect: 2/3}", True),
        ("b: {expect: 1/3}", False),
        ("b: {published: {value: 0.667, as: speed}}", True),  # within the digits printed
        ("b: {published: {value: 1.50, as: input/output}}", True),
        ("b: {published: {value: 1.51, as: input/output}}", False),
        ("b: {expect: 2/3, published: {value: -0.667, as: speed}}", True),
        ("b: {expect: 2/3, published: {value: 0.6, as: speed}}", False),
        ("frame: {expect: 1}", False),
    ],
)
def test_a_miss_of_the_sign_only_is_said_to_be_one(written: Written, outputs: str, sign: bool) -> None:
    done = call("check", written(f"  {outputs}"))
    assert done.exit_code == 1
    assert ("only the sign differs" in done.stdout) == sign


def test_a_ratio_that_there_is_not_is_said_to_be_none(train_file: Write) -> None:
    path = train_file("extends: planetary\noutputs: {ring: {published: {value: 3, as: input/output}}}\n")
    said = call("check", path).stdout
    assert "published 3 as input/output, undefined: a ratio" in said


def test_notes_are_told_when_a_figure_fails(train_file: Write) -> None:
    train = load("prague-orloj")
    assert train.build_findings
    name = next(iter(train.declaration.outputs))
    path = train_file(f"extends: prague-orloj\noutputs: {{{name}: {{expect: 77}}}}\n")
    for more in ((), ("--quiet",)):
        done = call("check", path, *more)
        assert done.exit_code == 1
        notes = [line for line in done.stdout.splitlines() if line.startswith("note")]
        assert all(any(found.text in line for line in notes) for found in load(path).build_findings)
    assert call("check", "--quiet", "prague-orloj").stdout == ""


# -------------------------------------------------------------------------------------- what motion in time contradicts


@pytest.mark.parametrize(("rate", "noted"), [("rate: 1 turn/s", True), ("drive: {rate: 1 turn/s}", True),
                                             ("rate: 0.45 turn/s", False), ("", False)])  # fmt: skip
def test_a_rate_at_which_teeth_part_is_noted(rate: str, noted: bool, train_file: Write) -> None:
    told = call("check", train_file(f"extends: moon-triangular-inertia\n{rate}\n")).stdout
    assert ("the teeth of d2~e separate from 0.48188 turn/s of 'crank' on" in told) == noted
    assert "ok " in told


@pytest.mark.parametrize(
    ("beat", "said"), [("1 s", ""), ("0.5 s", "gives a beat of 1 s"), ("61/60 s", "a beat of 1 s")]
)
def test_an_escapement_that_beats_at_another_speed_is_noted(beat: str, said: str, train_file: Write) -> None:
    escapement = f"escapement: {{link: escape, teeth: 30, beat: {beat}}}"
    told = call("check", train_file(f"extends: longcase-clock\n{escapement}\n")).stdout
    assert ("half a tooth of 30" in told) == bool(said)
    assert said in told
    # speeds are real by a rate too: the crank of this train is to make a turn a minute
    escapement = escapement.replace("escape,", "crank,")
    assert said in call("check", train_file(f"extends: moon-triangular\n{escapement}\nrate: 1 rpm\n")).stdout
