"""A train as a co-simulation unit, run by another's importer (fmpy): it moves as it does here, bit for bit."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from math import tau
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import numpy as np
import pytest
from commands import call, without

pytest.importorskip("fmpy", reason="fmpy is not installed: no unit is run by another's importer")

import fmpy
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu

from geartrain import load
from geartrain.errors import GearTrainError
from geartrain.simulation import CoSimulationCase, fmu_file
from geartrain.train.declaration_files import write_declaration

TRAIN, STEP = "moon-triangular-inertia", 2.5e-4


@pytest.fixture(autouse=True)
def _path_as_before() -> Iterator[None]:
    """Units put their folder first in the path of the process that runs them."""
    path = list(sys.path)
    yield
    sys.path[:] = path


@pytest.fixture(scope="module")
def unit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("fmu") / "moon.fmu"
    done = call("export", TRAIN, "-o", out, "--rate", "1", "--restitution", "0.3", "--time-step", "0.00025s")
    assert done.exit_code == 0, done.output
    return out


def test_the_description_is_valid_and_names_what_goes_in_and_comes_out(unit: Path) -> None:
    assert validate_fmu(str(unit)) == []
    told = fmpy.read_model_description(str(unit), validate_variable_names=True)
    kinds = {each.name: (each.causality, each.unit, each.start) for each in told.modelVariables}
    assert kinds["drive.speed"] == ("input", "rad/s", repr(tau))
    assert kinds["loads.moon"] == ("input", "N.m", "0.0")
    assert kinds["step"] == ("parameter", "s", "0.00025")
    assert kinds["restitution.'d2~e'"] == ("parameter", None, "0.3")
    assert kinds["angles.moon"][:2] == ("output", "rad")
    assert kinds["apart.'d2~e'"][:2] == ("output", None)
    assert told.fmiVersion == "2.0"
    assert told.coSimulation.canHandleVariableCommunicationStepSize


def test_it_moves_as_the_train_does_here(unit: Path) -> None:
    run = load(TRAIN).dynamics(rate=tau, turns=0.012, skip=0, steps=2000, restitution=0.3, fast=False)
    assert run.step == STEP
    assert run.impacts.total > 0
    found = fmpy.simulate_fmu(str(unit), stop_time=0.012, output_interval=2 * STEP, start_values={"drive.speed": tau})
    assert found["time"][1:] == pytest.approx(run.time)
    assert np.array_equal(found["angles.moon"][1:], run.angles["moon"])
    assert np.array_equal(found["speeds.moon"][1:], run.speeds["moon"])
    assert np.array_equal(found["drive.torque"][1:], run.drive)
    assert np.array_equal(found["torques.'c2~d1'"][1:], run.torques["c2~d1"])


def test_it_is_stepped_unevenly_steered_reset_and_stands_beside_another(unit: Path, tmp_path: Path) -> None:
    names = {each.name: each.valueReference for each in fmpy.read_model_description(str(unit)).modelVariables}
    folder = fmpy.extract(str(unit), str(tmp_path / "unit"))
    told = fmpy.read_model_description(folder)
    first, second = (
        FMU2Slave(
            guid=told.guid,
            unzipDirectory=folder,
            modelIdentifier=told.coSimulation.modelIdentifier,
            instanceName=name,
        )
        for name in ("first", "second")
    )

    def begin(of: Any, **start: float) -> None:
        of.setupExperiment(startTime=0.0)
        of.enterInitializationMode()
        for name, value in start.items():
            of.setReal([names[name.replace("_", ".")]], [value])
        of.exitInitializationMode()

    def get(of: Any, name: str) -> float:
        return float(of.getReal([names[name]])[0])

    for each in (first, second):
        each.instantiate()
    begin(first, drive_speed=0.0)
    begin(second)
    time = 0.0
    for length in (0.003, 0.0101, 0.0007):
        for each in (first, second):
            each.doStep(time, length)
        time += length
    here = load(TRAIN).simulation(rate=tau, step=STEP, restitution=0.3)
    still = here.anew(drive=0.0)
    here.advance(time)
    still.advance(time)
    assert get(second, "angles.moon") == pytest.approx(here.angles["moon"], abs=1e-12)
    assert get(first, "angles.moon") == pytest.approx(still.angles["moon"], abs=1e-12)
    first.setReal([names["drive.speed"], names["loads.moon"]], [2.0, 1e-4])
    first.doStep(time, 0.01)
    still.set_drive(2.0)
    still.set_load("moon", 1e-4)
    still.advance(0.01)
    assert get(first, "angles.moon") == pytest.approx(still.angles["moon"], abs=1e-12)
    assert get(first, "drive.torque") == pytest.approx(still.torque, rel=1e-9)
    first.reset()
    begin(first)
    first.doStep(0.0, time)
    assert get(first, "angles.moon") == pytest.approx(here.angles["moon"], abs=1e-12)
    for each in (first, second):
        each.terminate()
        each.freeInstance()


def test_a_process_that_ran_it_twice_ends_well(unit: Path) -> None:
    code = f"import fmpy\nfor _ in range(2): print(fmpy.simulate_fmu({str(unit)!r}, stop_time=1e-3)['angles.moon'][-1])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    first, second = done.stdout.split()
    assert first == second


def test_the_same_train_is_the_same_file_and_holds_no_way_back_to_this_machine(unit: Path) -> None:
    case = CoSimulationCase(rate=tau, step=STEP, restitution=0.3)
    assert fmu_file(load(TRAIN), case) == unit.read_bytes()
    with ZipFile(unit) as archive:
        text = archive.read("resources/train.yaml").decode()
    assert "extends" not in text
    assert str(Path.home()) not in text


def test_a_declaration_written_out_is_read_back_as_it_was() -> None:
    names = ("moon-triangular-inertia", "freeth-2008-doubt", "bevel-differential", "longcase-clock-bs978")
    for own in (load(name).declaration for name in names):
        again = load(write_declaration(own)).declaration
        for field in type(own).model_fields.keys() - {"extends", "remove"}:
            assert getattr(again, field) == getattr(own, field), field


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (("planetary-24-18-60", "-o", "x.fmu"), "no input speed is declared"),
        (("moon-triangular", "-o", "x.fmu", "--rate", "1"), "inertia"),
        ((TRAIN, "-o", "x.fmu", "--rate", "1", "--bore", "2mm"), "--bore does not apply"),
        ((TRAIN, "-o", "x.fmu", "--rate", "1", "--time-step", "0s"), "the value must be greater than 0, not 0s"),
        ((TRAIN, "-o", "x.fmu", "--rate", "1", "--restitution", "2"), "'2' is not a valid restitution"),
        ((TRAIN, "-o", "x.dot", "--rate", "1"), "--rate applies only"),
    ],
)
def test_what_cannot_be_such_a_unit_is_said(
    arguments: tuple[str, ...], what: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = call("export", *arguments)
    assert isinstance(done.exception, GearTrainError), done.output
    assert what in str(done.exception)
    assert list(tmp_path.iterdir()) == []


def test_without_its_library_the_extra_is_named(tmp_path: Path) -> None:
    done = without("pythonfmu", arguments=["export", TRAIN, "-o", tmp_path / "x.fmu", "--rate", "1"])
    assert done.returncode == 2
    assert "pip install 'pythonfmu>=0.7'" in done.stderr
    assert list(tmp_path.iterdir()) == []
