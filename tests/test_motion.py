"""Motion with real teeth and pins: composition by hand, published tables, conservation of mean speeds."""

from __future__ import annotations

import json
from math import asin, degrees, pi
from pathlib import Path

import numpy as np
import pytest
from commands import call
from scipy.optimize import fsolve

from geartrain import GearTrainError, load
from geartrain.pins.laws import SlotLaw
from geartrain.teeth.triangular.law import TriangularLaw


def test_along_an_ordinary_train_laws_are_composed_one_in_the_other() -> None:
    train = load("moon-triangular")
    angle, ripples = train.motion(outputs=["sun", "c", "d", "moon"]).ripples(3.0, 5001)
    laws: list[TriangularLaw] = [mesh.law for mesh in train.meshes]
    S, rate = angle, np.ones_like(angle)
    for name, law in zip(ripples, laws, strict=True):
        # each wheel's forward angle is the driven angle of the pair before
        rate = rate * law.speed(S)
        S = law.angle(S)
        ripple = ripples[name]
        sense = 1 if ripple.mean > 0 else -1
        assert np.allclose(ripple.mean * angle + ripple.error, sense * S, rtol=0, atol=1e-10)
        near_corner = np.abs(ripple.speed - sense * rate) > 1e-9
        assert near_corner.mean() < 1e-3


@pytest.mark.parametrize(
    ("turns", "samples", "peak", "rms", "least", "most"),
    [
        (20, 400_001, 5.968, 1.238, 0.634, 1.763),
        pytest.param(95, 4_000_001, 6.058, 1.2385, 0.630, 1.771, marks=pytest.mark.slow),
    ],
)
def test_the_moon_runs_as_in_the_table(
    turns: float, samples: int, peak: float, rms: float, least: float, most: float
) -> None:
    _, found = load("moon-triangular").motion(outputs=["moon"]).ripples(turns, samples)
    ripple = found["moon"]
    assert degrees(ripple.peak_to_peak) == pytest.approx(peak, rel=2e-3)
    assert degrees(ripple.rms) == pytest.approx(rms, rel=1e-3)
    assert ripple.speed.min() / ripple.mean == pytest.approx(least, abs=2e-3)
    assert ripple.speed.max() / ripple.mean == pytest.approx(most, abs=6e-3)


def test_the_error_repeats_after_the_common_period_and_speeds_keep_their_mean() -> None:
    motion = load("moon-triangular").motion(outputs=["moon"])
    # 95 turns of the crank are a whole number of pitches of every pair
    error, _ = motion.composition.motion(np.array([0.0, 1.0, 7.3]))
    later, _ = motion.composition.motion(np.array([0.0, 1.0, 7.3]) + 95 * 2 * pi)
    assert np.allclose(error, later, atol=1e-10)
    _, found = motion.ripples(95, 200_001)
    ripple = found["moon"]
    assert float(np.mean(ripple.speed[:-1])) == pytest.approx(ripple.mean, rel=1e-4)


def test_speed_is_the_derivative_of_the_angle() -> None:
    angle, found = load("freeth-2021").motion(outputs=["mars", "moon", "venus"]).ripples(2.0, 200_001)
    for ripple in found.values():
        slope = np.gradient(ripple.mean * angle + ripple.error, angle)
        assert np.allclose(slope[1:-1], ripple.speed[1:-1], atol=1e-6 * np.abs(ripple.speed).max())


def test_the_lunar_pointer_has_the_anomaly_of_its_pin() -> None:
    _, found = load("freeth-2008").motion(outputs=["moon"]).ripples(40.0, 200_001)
    assert found["moon"].peak_to_peak / 2 == pytest.approx(asin(1.1 / 9.6), rel=1e-6)


@pytest.mark.parametrize(
    ("planet", "least", "most"), [("mars", -0.369, 0.718), ("jupiter", -0.134, 0.232), ("saturn", -0.079, 0.125)]
)
def test_the_superior_planets_go_back(planet: str, least: float, most: float) -> None:
    train = load("freeth-2021")
    motion = train.motion(outputs=[planet])
    _, found = motion.ripples(100.0, 200_001)
    ripple = found[planet]
    lead = float(train.solve()[motion.train.lead])
    speeds = ripple.speed * lead * np.sign(ripple.mean * lead)
    assert speeds.min() == pytest.approx(least, abs=6e-4)
    assert speeds.max() == pytest.approx(most, abs=6e-4)
    assert speeds.min() < 0


DIFFERENTIAL = """
links:
  frame: {}
  left: {wheels: {l: 40, x: 60}}
  right: {wheels: {r: 44}}
  planet: {wheels: {p: 20, q: 18}}
  arm: {wheels: {y: 60}}
revolutes:
  - {pair: [frame, left], axis: A}
  - {pair: [frame, right], axis: A}
  - {pair: [frame, arm], axis: A}
  - {pair: [arm, planet], axis: P}
gears: [{pair: [l, p], driver: l}, {pair: [q, r], driver: q}]
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {left: 1, arm: 1/3}
outputs: {right: {}}
"""


def test_a_differential_is_the_solution_of_its_two_laws() -> None:
    train = load(DIFFERENTIAL)
    angle, found = train.motion().ripples(0.5, 101)
    ripple = found["right"]
    first, second = (mesh.law for mesh in train.meshes)
    for at in (0, 13, 50, 99):
        left, arm = angle[at], angle[at] / 3

        def residue(unknown: np.ndarray, left: float = left, arm: float = arm) -> list[float]:
            planet, right = unknown
            # in the arm's frame: left drives the planet backwards, the planet drives right backwards
            one = -(planet - arm) - float(first.angle(left - arm))
            other = (right - arm) - float(second.angle(-(planet - arm)))
            return [one, other]

        mean = train.solve()
        guess = [float(mean["planet"]) * angle[at], float(mean["right"]) * angle[at]]
        solution, *_ = fsolve(residue, guess, xtol=1e-13, full_output=True)
        assert np.abs(residue(solution)).max() < 1e-12
        right = solution[1]
        assert ripple.mean * angle[at] + ripple.error[at] == pytest.approx(right, abs=1e-9)


SHUNT = """
links:
  frame: {}
  left: {wheels: {l: 40}}
  right: {wheels: {r: 44, v: 50}}
  planet: {wheels: {p: 20, q: 18}}
  arm: {wheels: {y: 60}}
  lay: {wheels: {w: 40, u: 30}}
revolutes:
  - {pair: [frame, left], axis: A}
  - {pair: [frame, right], axis: A}
  - {pair: [frame, arm], axis: A}
  - {pair: [arm, planet], axis: P}
  - {pair: [frame, lay], axis: B}
gears:
  - {pair: [l, p], driver: l}
  - {pair: [q, r], driver: q}
  - {pair: [v, w], driver: v}
  - {pair: [u, y], driver: u}
tooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}
inputs: {left: 1}
outputs: {right: {}, arm: {}, lay: {}, planet: {}}
"""


def test_pairs_that_hang_on_each_other_settle_on_the_solution_of_all_their_laws() -> None:
    """The arm is turned by the wheel that its own planet turns."""
    train = load(SHUNT)
    motion = train.motion()
    assert max(map(len, motion.composition.order())) > 1
    angle, found = motion.ripples(0.3, 61)
    laws = {mesh.name: mesh.law for mesh in train.meshes}
    pairs = (("l~p", "left", "planet", "arm"), ("q~r", "planet", "right", "arm"))
    pairs += (("v~w", "right", "lay", None), ("u~y", "lay", "arm", None))
    mean = {link: float(speed) for link, speed in train.solve().speeds.items()}
    for at in (7, 22, 41, 60):
        place = {name: ripple.mean * angle[at] + ripple.error[at] for name, ripple in found.items()}
        place["left"] = angle[at]
        for name, driver, driven, carrier in pairs:
            base, still = (place[carrier], mean[carrier]) if carrier else (0.0, 0.0)
            ahead = np.sign(mean[driver] - still)
            turned = float(laws[name].angle(ahead * (place[driver] - base)))
            assert -ahead * turned == pytest.approx(place[driven] - base, abs=1e-10), name


def test_teeth_that_close_a_redundant_loop_are_named() -> None:
    text = "extends: four-gear-loop\ntooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\n"
    with pytest.raises(GearTrainError, match="redundant"):
        load(text).motion().ripples(1.0, 11)


def test_a_train_of_ideal_teeth_has_no_ripple() -> None:
    _, found = load("pennestri-2002").motion(outputs=["moon"]).ripples(1.0, 11)
    assert found["moon"].peak_to_peak == 0
    assert (found["moon"].speed == found["moon"].mean).all()


def test_a_pin_alone_moves_its_slot_by_its_law() -> None:
    train = load("freeth-2008")
    (joint,) = train.pins
    assert isinstance(joint.law, SlotLaw)
    source = train.motion(outputs=["moon"]).composition.sources
    assert [each.id for each in source] == [joint.coupling.name]


def test_the_command_tells_errors_and_speeds(tmp_path: Path) -> None:
    arguments = ("motion", "moon-triangular", "--turns", 2, "--samples", 2001, "--output", "moon")
    data = json.loads(call(*arguments, "--json").stdout)
    assert set(data["outputs"]) == {"moon"}
    assert set(data["outputs"]["moon"]) == {"transmission_error", "speed"}
    assert set(data["outputs"]["moon"]["transmission_error"]) == {"peak_to_peak", "rms"}
    assert data["outputs"]["moon"]["speed"]["mean"] == pytest.approx(254 / 19 / 5, rel=1e-15)
    assert "error p-p (deg)" in call(*arguments).stdout
    out, picture = tmp_path / "m.csv", tmp_path / "m.png"
    assert call(*arguments, "-o", out, "--plot", picture).exit_code == 0
    rows = out.read_text(encoding="utf-8").splitlines()
    assert rows[0] == "turns,moon error (rad),moon speed"
    assert len(rows) == 2002
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert call("motion", "moon-triangular", "--output", "mooon").exit_code != 0
