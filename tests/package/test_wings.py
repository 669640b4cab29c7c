"""The core of geartrain runs without its wings: search, workshop, simulation."""

from __future__ import annotations

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
