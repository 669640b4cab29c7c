"""The study of motion: its methods stand in the order of what they leave out. Times are never judged."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from studies.motion_methods import Effort, MotionCase
from studies.motion_records import MotionRecord, MotionRecords
from studies.motion_study import motion
from studies.reference_solutions import MotionTruth
from studies.time_marching import Marching
from studies.train_families import toothed_chain

from geartrain import GearTrain, load

pytestmark = pytest.mark.slow  # the script of an accuracy page, no part of the package

MOON, PRICE = "moon-triangular", "price-1974, triangular teeth"


@pytest.fixture(scope="module")
def records() -> MotionRecords:
    return motion(quick=True)


@pytest.fixture(scope="module")
def rows(records: MotionRecords) -> dict[tuple[str, str], MotionRecord]:
    return {(row.family, row.method): row for row in records.rows}


def error(rows: dict[tuple[str, str], MotionRecord], family: str, method: str) -> float:
    return rows[family, method].error


@pytest.mark.parametrize("family", [MOON, PRICE])
def test_the_more_a_method_counts_the_less_it_errs(rows: dict[tuple[str, str], MotionRecord], family: str) -> None:
    methods = ("direct", "superposition with lag")
    direct, lagged = (error(rows, family, method) for method in methods)
    assert direct < 1e-11 < lagged
    typical = [rows[family, method].rms for method in methods]
    assert all(
        rms is not None and rms <= rows[family, method].error for rms, method in zip(typical, methods, strict=True)
    )


@pytest.mark.parametrize("family", [MOON, PRICE])
def test_marching_nears_the_composition_as_its_steps_shrink(
    rows: dict[tuple[str, str], MotionRecord], family: str
) -> None:
    adaptive, fixed = (error(rows, family, method) for method in ("marching, RK45", "marching, 1 a position"))
    assert adaptive < fixed
    assert adaptive < 0.02


def test_the_moon_ripples_as_in_the_table(records: MotionRecords) -> None:
    ripple = records.trains[0].outputs["moon"]
    assert records.trains[0].turns == 95
    assert ripple["rms"] == pytest.approx(1.2385, rel=2e-3)
    assert ripple["peak_to_peak"] == pytest.approx(6.058, rel=2e-2)


def test_the_sum_of_ranges_is_above_and_independent_phases_are_near(
    records: MotionRecords, rows: dict[tuple[str, str], MotionRecord]
) -> None:
    for train in records.trains:
        bound, independent = rows[train.family, "sum of ranges"], rows[train.family, "independent rms"]
        assert bound.note.startswith("+")
        assert 0 < error(rows, train.family, "sum of ranges") < train.outputs[bound.output]["peak_to_peak"]
        assert independent.rms < 0.05 * train.outputs[independent.output]["rms"]


def test_every_pair_of_the_differential_train_has_a_transmission(records: MotionRecords) -> None:
    price = records.trains[1]
    assert price.family == PRICE
    assert list(price.ideal) == []
    assert len(price.rippling) == price.links == 17
    # what no dial depends on is not counted: the last arbor drives nothing
    assert "N~O1" not in price.rippling
    assert price.outputs["sun"]["peak_to_peak"] < 1e-10


def test_memory_is_that_of_a_stretch_of_positions() -> None:
    effort = Effort(200_000, rounds=1, marched=10, sample=1)
    case = MotionCase(MOON, MOON, ("moon",), 95.0, effort)
    case._trace()
    short, chunk, many = case.peaks.values()
    assert short < many < 16 * 2**23 / 2**20
    assert chunk == pytest.approx(many, rel=0.5)


def test_long_chains_come_back_to_their_first_ratio() -> None:
    for pairs in (10, 200):
        train = GearTrain.declare(toothed_chain(pairs))
        ratio = abs(float(train.solve()[f"g{pairs}"]))
        assert 0.5 < ratio < 2
        assert len(train.meshes) == pairs


def test_the_digits_agree_with_an_equation_solved_for_its_one_unknown() -> None:
    """The crank of Price's train drives the wheel whose angle is given: its own error stands in its own angle."""
    train = load(f"extends: price-1974\n{FORM}")
    whole = train.motion(outputs=["crank"])
    (mesh,) = (mesh for mesh in train.meshes if mesh.name == "A~B1")
    ratio = float(train.solve()["crank"])
    turns = 0.377
    given = 2 * np.pi * turns
    hung = -float(mesh.transmission.angle(0.0)) / float(
        mesh.transmission.ratio
    )  # at the start, a tooth on the line of centres

    def residue(crank: float) -> float:
        return float(mesh.transmission.angle(crank - hung)) + float(mesh.transmission.ratio) * hung - given

    crank = brentq(residue, abs(ratio) * given - 0.2, abs(ratio) * given + 0.2, xtol=1e-14)
    found = np.sign(ratio) * crank - ratio * given
    assert float(whole._unset.at(np.array([turns])).error[0, 0]) == pytest.approx(found, abs=1e-12)
    assert MotionTruth(whole).off(turns, np.array([found]))[0] == pytest.approx(0, abs=1e-12)
    # an error that is there is told
    assert MotionTruth(whole).off(turns, np.array([found + 1e-6]))[0] == pytest.approx(1e-6, rel=1e-5)


def test_marching_follows_pins_without_a_kink_to_many_digits() -> None:
    train = load("freeth-2021")
    outputs = ["mars", "moon", "venus"]
    turns = np.linspace(0, 0.1, 21)
    error = Marching(train, outputs).follow(turns, 10)
    assert np.abs(error - train.motion(outputs=outputs)._unset.at(turns).error).max() < 1e-7


FORM = "name: toothed\ntooth_form: {form: triangular, half_angle: 30 deg, window: 0.5}\n"
