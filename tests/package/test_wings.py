"""The core of geartrain runs without its wings: search, workshop, simulation."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from places import ROOT
from sampling import first_few

from geartrain.cli import VerbGroup
from geartrain.cli.verbs import Verbs
from geartrain.wings import WINGS

CORE = """
import sys
from typer.testing import CliRunner
from geartrain.cli import app

TRAINS = sys.argv[2:]
COMMANDS = '''
report {train}
report {train} --json
report {train} -o {folder}/{train}.html --force
view {train} -o {folder}/{train}-view.html --force
draw {train} -o {folder}/{train}.svg --force
compare {train}
check --quiet {train}
solve {train} --json
inspect equations {train}
inspect formula {train}
inspect graph {train}
torques {train}
inspect schema
inspect schema --as markdown
inspect schema --as answers
list
periods
mesh 20 30 --form triangular -p window=0.5
mesh 20 30 --compare
sphere icosidodecahedron --teeth 5=20,3=12
motion moon-triangular --turns 1 --samples 500
gearbox zf-8hp70
inspect bench planetary
init planetary -o {folder}/new.yaml
format {folder}/new.yaml
--help
'''
runner, failed = CliRunner(), []
for train in TRAINS:
    for line in COMMANDS.split("\\n"):
        if line and ("{train}" in line or train == TRAINS[0]):
            done = runner.invoke(app, line.format(train=train, folder=sys.argv[1]).split())
            if done.exit_code:
                failed.append((line, train, done.exit_code, done.output[-200:], repr(done.exception)))
print(*failed, sep="\\n")
sys.exit(bool(failed))
"""

SMOKE = ("tests/kinematics/test_graph.py", "tests/kinematics/test_willis_matrix.py", "tests/dynamics/test_statics.py")
"""Tests of the core that run in a copy without wings."""


def stripped(folder: Path, wings: tuple[str, ...]) -> dict[str, str]:
    """Copy the package without some wings; return the environment of a process that imports the copy."""

    def ignored(where: str, names: list[str]) -> set[str]:
        removed = {"node_modules", "__pycache__", *(wings if Path(where) == ROOT / "geartrain" else ())}
        return removed & set(names)

    shutil.copytree(ROOT / "geartrain", folder / "geartrain", ignore=ignored)
    shutil.copytree(ROOT / "trains", folder / "trains")
    return os.environ | {"PYTHONPATH": str(folder)}


def run_in(folder: Path, environment: dict[str, str], *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, *words]
    return subprocess.run(command, env=environment, cwd=folder, capture_output=True, text=True, check=False)


TRAINS = ("planetary", "moon-triangular-inertia", "longcase-clock-loaded", "zf-8hp70", "pennestri-2002-teeth")


CASES = [(WINGS, TRAINS[:2]), (WINGS, TRAINS[2:]), *(((name,), TRAINS) for name in WINGS)]


@pytest.mark.parametrize("case", first_few(1, CASES))
def test_every_command_of_the_core_runs_without(case: tuple[tuple[str, ...], tuple[str, ...]], tmp_path: Path) -> None:
    wings, trains = case
    environment = stripped(tmp_path, wings)
    (tmp_path / "out").mkdir()
    done = run_in(tmp_path, environment, "-c", CORE, str(tmp_path / "out"), *trains)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_tests_of_the_core_pass_without_all_wings(tmp_path: Path) -> None:
    environment = stripped(tmp_path, WINGS)
    shutil.copytree(ROOT / "tests", tmp_path / "tests", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    done = run_in(tmp_path, environment, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", *SMOKE)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr


def test_a_command_of_an_absent_wing_is_unknown_and_an_option_that_needs_it_names_it(tmp_path: Path) -> None:
    environment = stripped(tmp_path, WINGS)
    assert "montecarlo" not in run_in(tmp_path, environment, "-m", "geartrain", "--help").stdout
    unknown = run_in(tmp_path, environment, "-m", "geartrain", "montecarlo", "moon-triangular")
    assert unknown.returncode == 2
    assert "montecarlo: unknown command" in unknown.stderr
    words = ("mesh", "20", "30", "--form", "triangular", "--friction", "0.1", "--objective", "loss")
    sizes = run_in(tmp_path, environment, "-m", "geartrain", *words)
    assert sizes.returncode == 2
    assert "geartrain.workshop" in sizes.stderr


def test_every_listed_command_exists() -> None:
    assert len(VerbGroup.verbs) == len(list(VerbGroup.verbs))
    for name in VerbGroup.verbs:
        assert VerbGroup.verbs[name].name == name


def test_another_distribution_adds_a_command(monkeypatch: pytest.MonkeyPatch) -> None:
    added = EntryPoint("levels", "geartrain.cli.declarations:list_trains", "geartrain.wings")
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: [added] if group == "geartrain.wings" else [])
    verbs = Verbs({"report": "geartrain.cli.report:report"}, entry_points="geartrain.wings")
    assert list(verbs) == ["report", "levels"]
    assert verbs["levels"].name == "levels"
    assert verbs.get("absent") is None


FORM = '''
from typing import Literal

from pydantic import Field

from geartrain.numerics.periodic_function import HarmonicSeries
from geartrain.teeth.given_transmission import GivenTransmission, given_mesh
from geartrain.teeth.tooth_form import ToothForm


class Wavy(ToothForm):
    """Teeth with a sinusoidal transmission error."""

    has_shape = False

    form: Literal["wavy"] = Field(description="Name of the tooth form")
    size: float = Field(0.001, description="Amplitude of the error in rad")

    def mesh(self, wheels, shaft_angle):
        pitch = 6.283185307179586 / wheels.counts[0]
        return given_mesh(wheels, self, GivenTransmission(HarmonicSeries([(1, self.size, 0)], pitch), wheels.counts))
'''

TRAIN = """
name: wavy-pair
links: {frame: {}, a: {wheels: {p: 20}}, b: {wheels: {w: 60}}}
revolutes: {A: [frame, a], B: [frame, b]}
gears: [{pair: [p, w], tooth_form: {form: FORM, size: 0.002}}]
inputs: {a: 1}
outputs: {b: {}}
"""


@pytest.fixture
def with_form(tmp_path: Path) -> dict[str, str]:
    """Environment in which another distribution with a tooth form is installed."""
    (tmp_path / "wavy_teeth.py").write_text(FORM)
    info = tmp_path / "wavy_teeth-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: wavy-teeth\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[geartrain.wings]\ntooth_form.wavy = wavy_teeth:Wavy\n")
    (tmp_path / "wavy.yaml").write_text(TRAIN.replace("FORM", "wavy"))
    (tmp_path / "typo.yaml").write_text(TRAIN.replace("FORM", "wavi"))
    return {**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}


def test_another_distribution_adds_a_tooth_form(tmp_path: Path, with_form: dict[str, str]) -> None:
    def call(*words: str) -> subprocess.CompletedProcess[str]:
        return run_in(tmp_path, with_form, "-m", "geartrain", *words)

    motion = call("motion", "wavy.yaml", "--json")
    found = json.loads(motion.stdout)["outputs"]["b"]["transmission_error"]["peak_to_peak"]
    assert found == pytest.approx(0.004, rel=1e-6)
    pair = call("mesh", "20", "60", "--form", "wavy", "-p", "size=0.002", "--json", "-o", "-")
    assert json.loads(pair.stdout)["transmission_error"]["peak_to_peak"] == pytest.approx(0.004, rel=1e-6)
    schema = json.loads(call("inspect", "schema").stdout)
    assert "Wavy" in schema["$defs"]
    unknown = call("check", "typo.yaml")
    assert unknown.returncode == 2
    assert "did you mean 'wavy'?" in unknown.stderr
    assert "wavy" not in call("--help").stdout


def test_known_tooth_forms_are_read_without_a_scan_of_other_distributions() -> None:
    code = (
        "from geartrain import load; from geartrain.teeth.any_tooth_form import added_forms;"
        "load('planetary-24-18-60-involute').meshes; print(added_forms.cache_info().currsize)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "0"
