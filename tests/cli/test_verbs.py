"""A verb is imported when it is called, with no rooms but those it needs."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from commands import call, functions

from geartrain.cli import VerbGroup
from geartrain.teeth.any_tooth_form import TOOTH_FORMS
from geartrain.wings import WINGS

BEHIND_VERSION = {"geartrain", "geartrain.cli", "geartrain.errors", "geartrain.numerics", "geartrain.wings"}
BEHIND_SOLVE = {
    *BEHIND_VERSION,
    *("geartrain.analysis", "geartrain.kinematics", "geartrain.train", "geartrain.teeth", "geartrain.numerics"),
    "geartrain.report",  # how a number is written for a reader
}
HEAVY = {"numpy", "scipy", "networkx", "matplotlib", "jinja2", "rich"}


def loaded(*arguments: str) -> set[str]:
    """The modules in a fresh interpreter after a command."""
    code = f"""
import json, sys
from geartrain.cli import main
sys.argv = ["geartrain", *{arguments!r}]
try:
    main()
except SystemExit as ended:
    assert not ended.code, ended.code
print(json.dumps(sorted(sys.modules)))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    return set(json.loads(done.stdout.splitlines()[-1]))


def rooms(modules: set[str]) -> set[str]:
    return {".".join(name.split(".")[:2]) for name in modules if name.split(".")[0] == "geartrain"}


def verbs_in(modules: set[str]) -> set[str]:
    return {name.split(".")[2] for name in modules if name.startswith("geartrain.cli.")}


def test_the_version_is_told_by_the_shell_alone() -> None:
    modules = loaded("--version")
    assert rooms(modules) <= BEHIND_VERSION
    assert {name for name in modules if name.startswith("geartrain.numerics.")} == {"geartrain.numerics.lazy_names"}
    assert not modules & {*HEAVY, "pydantic", "yaml"}
    assert verbs_in(modules) <= {"common", "verbs"}


@pytest.mark.parametrize("more", [(), ("--of", "carrier")])
def test_solve_brings_the_rooms_that_solve_and_no_other_verb(more: tuple[str, ...]) -> None:
    modules = loaded("solve", "planetary-24-18-60", *more)
    assert rooms(modules) <= BEHIND_SOLVE
    assert not modules & HEAVY
    assert verbs_in(modules) <= {"common", "verbs", "solve"}
    # 45 without the command line and the formatting of its answer
    assert sum(name.split(".")[0] == "geartrain" for name in modules) <= 52


def test_a_verb_brings_no_page_but_its_own() -> None:
    pages = {name for name in loaded("torques", "norton-planetary") if name.startswith("geartrain.report.")}
    assert "geartrain.report.torque_report" in pages
    assert not pages & {f"geartrain.report.{other}" for other in ("spherical_report", "pair_page", "motion_report")}


def test_motion_imports_only_the_tooth_forms_that_the_train_names_and_the_computations_that_are_requested() -> None:
    modules = loaded("motion", "moon-triangular", "--turns", "1", "--samples", "100")
    forms = {name for name in TOOTH_FORMS if f"geartrain.teeth.{name}" in modules}
    assert forms == {"triangular"}
    unused = ("motion.superposition", "torques.mean_efficiencies")
    assert not modules & {f"geartrain.dynamics.{name}" for name in unused}
    assert sum(name.startswith("geartrain.") for name in modules) <= 100


def test_commands_of_a_wing_are_in_the_folder_of_their_capability_and_all_others_in_the_command_line() -> None:
    homes = {name: function.__module__.split(".") for name, function in functions()}
    assert all(home[1] == "cli" or (home[1] in WINGS and home[-1].endswith("verb")) for home in homes.values())


def test_help_lists_every_verb_with_what_it_does() -> None:
    said = " ".join(call("--help").stdout.replace("│", " ").split())
    for name, function in functions():
        if " " not in name:
            assert f" {name} " in said
            assert " ".join(str(function.__doc__).split()[:3]) in said, name


def test_help_lists_every_command_under_a_heading() -> None:
    shown = call("--help").output
    headings = ("Start", "Look", "Speeds", "Teeth, losses and motion", "Search", "Make")
    places = [shown.index(f"─ {heading} ─") for heading in headings]
    assert places == sorted(places)
    assert "─ Commands ─" not in shown
    assert all(f"│ {name} " in shown for name in VerbGroup.verbs)
