"""An escapement whose wheel is carried round: its pallets ride on the link that bears it (tourbillon, karrusel)."""

from __future__ import annotations

from fractions import Fraction
from math import pi
from pathlib import Path

import pytest
from commands import call

from geartrain import DeclarationError, load
from geartrain.dynamics.clock_rate import find_timekeeping
from geartrain.scene import build_scene

CASE = Path(__file__).parents[1] / "data/public_cases/02-escapement-carried-round.yaml"
# a pinion z that rolls on a fixed wheel Z turns Z/z times in a turn of its carriage, relative to that: with one turn a
# minute, 10 to 1 and N teeth the beat is 1/(2 N 10/60) s. The escape wheel turns on a sleeve on the same axis.
CARRIED = """
name: carried
unit: {per: 1 min}
frame: plate
links:
  plate: {wheels: {fixed: {teeth: FIXED}}}
  carriage: {inertia: 1e-8 kg m^2}
  sleeve: {}
  escape: {wheels: {e: PINION, points: TEETH}, inertia: 1e-10 kg m^2}
revolutes: [{pair: [plate, carriage], axis: C}, {pair: [carriage, sleeve], axis: E}, {pair: [sleeve, escape], axis: E}]
gears: [fixed ~ e]
locks: [[sleeve, carriage]]
inputs: {carriage: 1}
drive: {torque: 2 N mm}
escapement: {link: escape, teeth: TEETH, beat: BEAT}
"""


def carried(fixed: str, pinion: int, teeth: int, beat: str) -> str:
    text = CARRIED.replace("FIXED", fixed).replace("PINION", str(pinion))
    return text.replace("TEETH", str(teeth)).replace("BEAT", beat)


EXTERNAL = "70", 7, 15, "0.2 s"
INTERNAL = "120, internal: true", 12, 20, "0.15 s"


@pytest.mark.parametrize(("declared", "sense"), [(EXTERNAL, 1), (INTERNAL, -1)])
def test_a_beat_lets_half_a_tooth_pass_relative_to_the_carriage(
    declared: tuple[str, int, int, str], sense: int
) -> None:
    run = load(carried(*declared)).dynamics(turns=0.2, skip=0, fast=False)
    passed = run.angles["escape"][-1] - run.angles["carriage"][-1]
    assert passed == pytest.approx(sense * pi / declared[2] * round(run.time[-1] / float(declared[3][:-2])), rel=1e-6)
    assert run.rate == pytest.approx(2 * pi / 60, rel=1e-6)
    # pallets push the carriage back: power at the escapement is torque times relative speed
    assert run["escape"].torque == pytest.approx(2e-3 / 10, rel=1e-6)  # type: ignore[union-attr]


def test_the_centre_arbor_of_a_public_case_turns_once_an_hour() -> None:
    run = load(CASE).dynamics(turns=1 / 60, skip=0, fast=False)
    assert run.rate == pytest.approx(2 * pi / 3600, rel=1e-9)


@pytest.mark.parametrize("declared", [EXTERNAL, INTERNAL])
def test_a_rate_is_refused_from_the_speed_relative_to_the_carriage_on(declared: tuple[str, int, int, str]) -> None:
    train = load(carried(*declared))
    run = train.dynamics("0.01666 turn/s", turns=0.01, skip=0, fast=False)
    assert run.rate == pytest.approx(2 * pi * 0.01666, rel=1e-9)
    with pytest.raises(Exception, match=r"give at most 0\.0166667 turn/s for 'carriage'"):
        train.dynamics("0.01667 turn/s", turns=0.01, skip=0, fast=False)


@pytest.mark.parametrize("declared", [EXTERNAL, INTERNAL])
def test_check_compares_the_beat_with_the_speed_relative_to_the_carriage(
    declared: tuple[str, int, int, str], tmp_path: Path
) -> None:
    fixed, pinion, teeth, beat = declared
    file = tmp_path / "carried.yaml"
    file.write_text(carried(*declared), encoding="utf-8")
    assert "half a tooth" not in call("check", file).stdout
    file.write_text(carried(fixed, pinion, teeth, "0.22 s"), encoding="utf-8")
    told = call("check", file).stdout
    assert "'escape' turns at 0.16666667 turn/s relative to 'carriage'" in told
    assert f"which gives a beat of {beat}" in told


def test_the_torque_at_a_carried_escapement_acts_between_its_wheel_and_the_carriage() -> None:
    # Each of three pairs passes 9/10 in its carrier's frame, and the pallets' torque is internal to the carriage with
    # its wheel: all power of the weight arrives there but for what the pairs lose
    train = load(
        f"""
extends: {CASE}
name: by-weight
gears:
  - {{pair: [c80, t10], efficiency: 0.9}}
  - {{pair: [t75, k10], efficiency: 0.9}}
  - {{pair: [fixed70, e7], efficiency: 0.9}}
drive: {{weight: 0.1 kg, drum: 2 mm}}
"""
    )
    found = find_timekeeping(train.mechanics.load_case())
    assert found is not None
    pull = 0.1 * 9.80665 * 0.002
    assert found.torque == pytest.approx(pull, rel=1e-12)
    assert found.beat_energy == pytest.approx(0.9**3 * pull / 600 * pi / 15, rel=1e-9)
    assert found.efficiency == pytest.approx(0.9**3, rel=1e-9)


def test_no_pendulum_is_hung_on_an_escape_wheel_that_is_carried_round() -> None:
    dial = "dials: {face: {face: front}}\noutputs: {carriage: {dial: face}}\n"
    assert not build_scene(load(carried("70", 7, 15, "1 s, pendulum: 994 mm") + dial)).hangers


def test_e1_pallets_on_the_carriage_see_600_turns_an_hour() -> None:
    # 80/10 and 75/10 turn the carriage 60 times an hour; the escape pinion rolls on a fixed wheel: 70/7 turns more
    train = load(f"extends: {CASE}\nname: e1\nescapement: {{link: escape, teeth: 15, beat: 0.2 s, on: carriage}}")
    relative = train.solve()["escape"] - train.solve()["carriage"]
    assert relative == 600
    assert 3600 / (relative * 2 * 15) == Fraction(1, 5)
    assert 3600 / (train.solve()["escape"] * 2 * 15) == Fraction(2, 11)
    loads = "drive: null\nloads: {centre: 2 N mm}\nsolve_for: escape"
    torques = load(f"extends: {CASE}\nname: e1\n{loads}").torques()
    assert torques.external["escape"] == -torques.external["carriage"] == Fraction(-2, 600) / 1000
    assert (torques.power_in, torques.efficiency) == (Fraction(2, 1000), 1)


def test_e2_a_tourbillon_in_a_fixed_ring_beats_450_times_a_minute() -> None:
    train = load(carried("105, internal: true", 7, 15, "0.133333333333 s"))
    speeds = train.solve()
    assert (speeds["escape"], speeds["escape"] - speeds["carriage"]) == (-14, -15)
    assert 60 / (15 * Fraction(2 * 15)) == Fraction(2, 15)
    run = train.dynamics(turns=0.1, skip=0, fast=False)
    assert 60 * run["escape"].impact_rate == pytest.approx(450, rel=1e-6)  # type: ignore[union-attr]


def test_pallets_must_stay_beside_the_escape_wheel() -> None:
    with pytest.raises(DeclarationError, match="pallets on 'plate' do not stay beside the escape wheel 'escape'"):
        load(f"extends: {CASE}\nname: e1\nescapement: {{link: escape, teeth: 15, beat: 0.2 s, on: plate}}").solve()
