"""A train that is stepped by whoever looks on: the same course as in one run, and what changes of drive and load do."""

from __future__ import annotations

from math import pi, tau
from typing import Any

import numpy as np
import pytest

from geartrain import GearTrain, load
from geartrain.errors import QuestionError

# two arbors and an ideal pair: 20 teeth drive 40
PAIR: dict[str, Any] = {
    "links": {
        "frame": {},
        "a": {"wheels": {"p": 20}, "inertia": "1e-5 kg m2"},
        "b": {"wheels": {"w": 40}, "inertia": "8e-5 kg m2"},
    },
    "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    "gears": [{"pair": ["p", "w"]}],
    "inputs": {"a": 1},
    "outputs": {"b": {}},
}
REDUCED = 1e-5 + 8e-5 / 4


@pytest.mark.parametrize("restitution", [0.0, 0.3])
def test_its_course_is_that_of_a_run_wherever_it_is_looked_at(restitution: float) -> None:
    train = load("moon-triangular-inertia")
    run = train.dynamics(rate="1 turn/s", turns=0.1, skip=0, steps=2000, restitution=restitution, fast=False)
    even, uneven = (train.simulation("1 turn/s", step=run.step, restitution=restitution) for _ in range(2))
    for at, time in enumerate(run.time):
        even.advance(time - even.time)
        assert even.angles["moon"] == run.angles["moon"][at]
        assert even.torque == run.drive[at]
        assert even.torques["d2~e"] == run.torques["d2~e"][at]
    rng = np.random.default_rng(0)
    while even.time - uneven.time > 1e-9:
        uneven.advance(min(float(rng.uniform(0, 3e-3)), even.time - uneven.time))
    assert uneven.angles == pytest.approx(even.angles, abs=1e-12)
    assert uneven.unsolved == even.unsolved == 0


def test_a_crank_brought_to_a_speed_takes_the_impulse_of_all_that_turns_with_it() -> None:
    """A planet whose teeth touch a fixed sun, and a ring that is free: by energy, J = Jc + Jp n_p^2 + Jr n_r^2."""
    train = load("""
links:
  frame: {wheels: {s: {teeth: 24, module: 1 mm}}}
  c: {inertia: 1e-5 kg m2}
  p: {wheels: {q: {teeth: 18, module: 1 mm}}, inertia: 2e-6 kg m2}
  r: {wheels: {ring: {teeth: 60, internal: true}}, inertia: 4e-5 kg m2}
revolutes: {main: [frame, c, r], planet: [c, p]}
gears: [{pair: [s, q], tooth_form: {form: involute, backlash: 0.05 mm}}, {pair: [q, ring]}]
inputs: {c: 1}
""")
    made = train.simulation(rate=2.0, step=1e-4)
    made = made.anew(drive=0.0)
    made.advance(5e-4)
    assert made.torque == pytest.approx(0, abs=1e-15)
    made.set_drive(2.0)
    made.advance(1e-4)
    planet, ring = 1 + 24 / 18, 1 + 24 / 60
    assert made.speeds["r"] == pytest.approx(2.0 * ring, rel=1e-9)
    assert made.torque * 1e-4 == pytest.approx(2.0 * (1e-5 + 2e-6 * planet**2 + 4e-5 * ring**2), rel=1e-9)
    made.advance(1e-3)
    assert made.torque == pytest.approx(0, abs=1e-12)


def test_a_torque_and_a_load_that_change_accelerate_what_they_act_on() -> None:
    made = GearTrain.declare({**PAIR, "rate": "1 rad/s", "drive": {"torque": "3 N mm"}}).simulation(step=1e-3)
    made.advance(1.0)
    assert made.speed == pytest.approx(3e-3 / REDUCED, rel=1e-9)
    assert made.speeds["b"] == pytest.approx(-made.speed / 2, rel=1e-12)
    made.set_load("b", 4e-3)  # along b's positive sense, against its turning
    made.advance(1.0)
    assert made.speed == pytest.approx(3e-3 / REDUCED + (3e-3 - 2e-3) / REDUCED, rel=1e-9)
    made.set_drive(-1e-3)
    made.advance(1.0)
    assert made.speed == pytest.approx((3e-3 + 1e-3 - 3e-3) / REDUCED, rel=1e-6)
    assert made.torque == -1e-3


def test_a_hand_that_changes_its_speed_goes_on_from_where_it_is() -> None:
    """Damped by its own stepping to the mean, the train lags by nothing: the angle is that of the hand's end."""
    hand = {"hand": {"rate": "2 rad/s", "stiffness": "1 N m/rad"}}
    made = GearTrain.declare({**PAIR, "drive": hand}).simulation(step=1e-2)
    made.advance(20.0)
    assert made.angle == pytest.approx(40.0, rel=1e-3)
    made.set_drive(-1.0)
    made.advance(10.0)
    assert made.angle == pytest.approx(30.0, rel=1e-3)


def test_what_cannot_be_is_said() -> None:
    train = GearTrain.declare(PAIR)
    made = train.simulation(rate=tau, step=1e-3)
    for wrong in (
        lambda: made.advance(-1.0),
        lambda: made.set_load("c", 1.0),
        lambda: made.anew(step=0.0),
        lambda: train.simulation(rate=tau, step=-1.0),
        lambda: (
            GearTrain.declare({**PAIR, "rate": "1 rad/s", "drive": {"spring": {"stiffness": "1 N m/rad", "turns": 2}}})
            .simulation(step=1e-3)
            .set_drive(pi)
        ),
    ):
        with pytest.raises(QuestionError):
            wrong()
