"""Sections on couplings with variable ratio and on fusees, and remarks of `solve` on swings and floats."""

from __future__ import annotations

from math import degrees

import pytest
from commands import call
from studies.train_families import grid

from geartrain import GearTrain, load
from geartrain.errors import GearTrainError
from geartrain.report import collect_report


def test_the_report_prints_swing_range_and_closed_form() -> None:
    train = load("elliptical-gears")
    page = str(train.report())
    assert "ellipses: tan(q / 2) = 1.85714 tan(S / 2)." in page
    assert "lobes: tan(q) = 1.5938 tan(S / 2)." in page
    assert "0.538462..1.857143" in page
    ellipses, lobes = collect_report(train).couplings
    assert (str(ellipses.ratio), str(lobes.ratio)) == ("-1", "-1/2")
    assert degrees(ellipses.swing) == pytest.approx(69.830412495, abs=1e-9)
    assert ellipses.to_dict()["formula"] == "tan(q / 2) = 1.85714 tan(S / 2)"


def test_formulas_contain_the_transmission_functions_of_couplings() -> None:
    text = call("inspect", "formula", "universal-joint-line").stdout
    assert "F1: tan q = tan S / cos(22.6199 deg)." in " ".join(text.split())
    found = collect_report(load("universal-joint-line"))
    # cos(22.6199 deg) = 12/13 limits the speed of a joint
    assert len(found.couplings) == 4
    for each in found.couplings:
        assert each.speed_ratio == pytest.approx((12 / 13, 13 / 12), rel=1e-12)
    assert not collect_report(load("planetary-24-18-60")).couplings


def test_solve_says_that_a_coupling_swings_about_its_mean() -> None:
    assert "coupling 'F1' swings by 4.58 deg: speeds are means" in str(load("universal-joint-line").solve())


def test_forks_in_phase_cancel_and_forks_out_of_phase_double() -> None:
    page = str(load("universal-joint-line").motion().run(turns=1.0, samples=101))
    (phased,) = (line.split() for line in page.splitlines() if line.startswith("front_axle"))
    (wrong,) = (line.split() for line in page.splitlines() if line.startswith("rear_axle"))
    assert phased[2:] == ["0", "0", "1.00000..1.00000"]
    assert wrong[4] == "0.85207..1.17361"  # (12/13)^2 and its inverse


_FUSEE = """
    links: {{frame: {{}}, great: {{inertia: 30 kg mm2}}, b: {{inertia: 3 kg mm2}}}}
    revolutes: {{A: [frame, great], B: [frame, b]}}
    couplings: [{{kind: elliptical, pair: [great, b], eccentricity: 0.1}}]
    inputs: {{great: 1}}
    rate: 1 turn/s
    drive: {{spring: {{stiffness: 0.02 N m/rad, turns: 5.5, barrel: 15 mm, fusee: {{turns: 6, {shape}}}}}}}
"""


def test_the_report_prints_the_run_of_a_fusee() -> None:
    page = str(load(_FUSEE.format(shape="radii: [6 mm, 14 mm]")).report())
    for line in ("0.330192 N m after 2.428 turns", "1.5 turns", "11.054 J"):
        assert line in page
    page = str(load(_FUSEE.format(shape="torque: 0.27 N m")).report())
    for line in ("5.8598 mm to 15.249 mm", "319.17 mm", "2.1135 turns"):
        assert line in page


def test_only_an_equalised_fusee_drives_a_train_in_time() -> None:
    found = load(_FUSEE.format(shape="torque: 0.27 N m")).dynamics()
    assert found.driven == "torque"
    with pytest.raises(GearTrainError, match="its torque varies with its angle") as refused:
        load(_FUSEE.format(shape="radii: [6 mm, 14 mm]")).dynamics()
    assert "0.293215 N m" in refused.value.problems[0].fix


def test_the_equation_clock_is_right_over_a_year() -> None:
    """Extremes of the equation of time by Smart's expansion with the elements of J2000.0, in minutes."""
    train = load("equation-clock")
    found = train.motion(outputs=["solar"]).run(turns=8765.81, samples=2001).statistics[0]
    assert -degrees(found.minimum) / 6 == pytest.approx(14.28, abs=0.005)
    assert degrees(found.most) / 6 == pytest.approx(16.47, abs=0.005)


def test_an_answer_says_why_floats_were_chosen_and_how_to_get_fractions() -> None:
    train = GearTrain.declare(grid(3000))
    answer = train.solve()
    estimate = max(answer.accuracy[link].estimate for link in answer.speeds)
    assert 0 < estimate < 1e-10
    assert "Solved in floats: the system is coupled too densely" in str(answer)
    assert f"The estimated error of every speed is at most {estimate:.1e}." in str(answer)
    assert "`geartrain solve FILE --method exact`" in str(answer)
    assert "Solved in floats" not in str(GearTrain.declare(grid(100)).solve(method="floats"))
