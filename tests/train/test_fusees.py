"""Springs with a fusee: two worked cases, and the energy of the chain by quadrature."""

from __future__ import annotations

from math import pi, tau
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from models import refusal
from scipy.integrate import solve_ivp

from geartrain import load
from geartrain.train import Drive


def spring(turns: float = 5.5, **fusee: Any) -> Any:
    """The spring of both cases: 0.02 N m/rad in a barrel of 15 mm."""
    wound = {"stiffness": "0.02 N m/rad", "turns": str(turns), "barrel": "15 mm", "fusee": {"turns": 6, **fusee}}
    return Drive.model_validate({"spring": wound}).spring


def test_case_f1_an_equalised_fusee() -> None:
    drive = spring(torque="0.27 N m")
    run = drive.chained.run()
    assert [round(1000 * each, 9) for each in run.radii] == [5.859795632, 15.2490252]
    assert run.left == pytest.approx(2.1135040144, abs=1e-10)
    assert round(1000 * run.chain, 8) == 319.16972729
    assert round(run.energy, 9) == 10.178760198
    assert run.energy == pytest.approx(0.27 * 6 * tau, rel=1e-15)
    assert (run.first, run.last, run.mean, run.maximum, run.minimum) == pytest.approx((0.27,) * 5, rel=1e-14)
    assert drive.torque(3.0) == 0.27


def test_case_f2_a_straight_fusee() -> None:
    run = spring(radii=["6 mm", "14 mm"]).chained.run()
    assert round(run.first, 11) == 0.27646015352
    assert round(run.maximum, 11) == 0.33019209760
    assert round(run.maximum_at, 8) == 2.42820323  # root of the derivative
    assert round(run.last, 11) == 0.17592918860
    assert round(run.mean, 11) == 0.29321531434
    assert run.left == pytest.approx(1.5, rel=1e-14)
    assert run.minimum == run.last


@given(st.lists(st.floats(4, 16), min_size=2, max_size=6))
def test_the_torque_of_any_fusee_is_that_of_its_chain_step_by_step(radii: list[float]) -> None:
    """The barrel gives the chain that the fusee takes: integrated by Runge and Kutta from the radii."""
    drive = spring(9, radii=[f"{r:.9f} mm" for r in radii])
    run, ends = drive.chained.run(), np.linspace(0, 6 * tau, len(radii))

    def slope(phi: float, _: Any) -> Any:
        return [-np.interp(phi, ends, radii) / 15]

    angles = np.linspace(0, 6 * tau, 401)
    wound = solve_ivp(slope, (0, 6 * tau), [9 * tau], t_eval=angles, rtol=1e-10, atol=1e-10, max_step=0.1).y[0]
    torque = 0.02 * wound * np.interp(angles, ends, radii) / 15
    assert [drive.torque(float(phi)) for phi in angles] == pytest.approx(torque.tolist(), rel=1e-6)
    assert run.maximum >= torque.max() * (1 - 1e-6)
    assert run.minimum <= torque.min() * (1 + 1e-6)
    assert run.maximum == pytest.approx(torque.max(), rel=1e-2)
    assert run.left == pytest.approx(wound[-1] / tau, rel=1e-6)
    assert run.mean == pytest.approx(np.trapezoid(torque, angles) / (6 * tau), rel=1e-3)


def declared(drive: str) -> str:
    return f"""
        links: {{frame: {{}}, great: {{inertia: 30 kg mm2}}, b: {{inertia: 3 kg mm2}}}}
        revolutes: {{A: [frame, great], B: [frame, b]}}
        couplings: [{{kind: universal_joint, pair: [great, b], angle: 10 deg}}]
        inputs: {{great: 1}}
        drive: {{spring: {drive}}}
    """


_SPRING = "stiffness: 0.02 N m/rad, turns: 5.5"


@pytest.mark.parametrize(
    ("drive", "said"),
    [
        (f"{{{_SPRING}, barrel: 15 mm}}", "must be given together"),
        (f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6}}}}", "exactly one"),
        (f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6, radii: [6 mm]}}}}", "is a drum"),
        (f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6, torque: 0.4 N m}}}}", "run down after 4.7516"),
        (f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6, radii: [15 mm, 15 mm]}}}}", "run down after 5.5 of the 6"),
    ],
)
def test_a_fusee_that_does_not_fit_its_spring_is_refused(drive: str, said: str) -> None:
    assert said in refusal(declared(drive))


def test_the_turns_after_which_the_spring_has_run_down_are_exact() -> None:
    # k w0^2/2 = T phi
    assert 0.02 * (5.5 * tau) ** 2 / 2 / 0.4 / (2 * pi) == pytest.approx(4.7516, abs=1e-4)


def test_the_report_and_the_simulation_know_the_fusee() -> None:
    equal = load(declared(f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6, torque: 0.27 N m}}}}"))
    assert equal.declaration.drive.steady_torque == 0.27
    straight = load(declared(f"{{{_SPRING}, barrel: 15 mm, fusee: {{turns: 6, radii: [6 mm, 14 mm]}}}}"))
    assert straight.declaration.drive.steady_torque is None
