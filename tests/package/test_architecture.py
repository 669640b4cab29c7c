"""What is imported when, who may know whom, and that everything public says what it is."""

from __future__ import annotations

import doctest
import importlib
import inspect
import json
import pkgutil
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest
from commands import call, imported_by
from places import ROOT

import geartrain

HEAVY = {"scipy", "matplotlib", "jinja2", "networkx", "numpy", "typer", "rich"}
EXACT = ("solve()", "mobility", "circuits", "equations().text()", "solve(output='moon')")


@pytest.mark.parametrize(
    ("question", "brings"),
    [("", set()), *((each, set()) for each in EXACT), ("graph", {"networkx"}), ("kinematics.floats()", {"scipy"})],
)
def test_an_answer_brings_only_the_libraries_that_it_needs(question: str, brings: set[str]) -> None:
    ask = f"; geartrain.load('pennestri-2002').{question}" if question else ""
    used = imported_by(f"import geartrain{ask}") & HEAVY
    assert brings <= used <= brings | ({"numpy"} if brings else set())


def test_a_train_built_in_python_reads_no_yaml_file() -> None:
    code = """
from geartrain import GearTrain
import builtins
def forbidden(*a, **k): raise AssertionError('a file is opened')
builtins.open = forbidden
joint = {'pair': ['frame', 'a'], 'axis': 'A'}
train = GearTrain.declare({'links': {'frame': {}, 'a': {}}, 'revolutes': [joint], 'inputs': {'a': 1}})
assert train.solve()['a'] == 1
"""
    assert "geartrain" in imported_by(code)


def modules() -> Iterator[ModuleType]:
    for found in pkgutil.walk_packages(geartrain.__path__, "geartrain."):
        if not found.name.endswith("__main__"):
            try:
                yield importlib.import_module(found.name)
            except geartrain.GearTrainError:  # an optional library is not installed
                continue


def public(module: ModuleType) -> Iterator[tuple[str, object]]:
    for name, thing in list(vars(module).items()):
        if name.startswith("_") or getattr(thing, "__module__", None) != module.__name__:
            continue
        if inspect.isclass(thing):
            yield name, thing
            for part, member in list(vars(thing).items()):
                function = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
                function = getattr(function, "func", function)
                if not part.startswith("_") and inspect.isfunction(function):
                    yield f"{name}.{part}", function
        elif inspect.isfunction(thing):
            yield name, thing


def test_every_module_class_and_function_in_sight_says_what_it_is() -> None:
    silent = []
    for module in modules():
        if not module.__doc__:
            silent.append(module.__name__)
        silent += [f"{module.__name__}.{name}" for name, thing in public(module) if not getattr(thing, "__doc__", None)]
    assert not silent, " ".join(silent)


def test_the_examples_in_docstrings_are_true() -> None:
    finder, runner = doctest.DocTestFinder(), doctest.DocTestRunner()
    # `testmod` also starts a debugger for each of the thousands of docstrings without an example
    told = [test for module in modules() for test in finder.find(module, module.__name__) if test.examples]
    assert told
    assert [test.name for test in told if runner.run(test).failed] == []


def test_every_default_of_the_schema_can_be_written_in_a_declaration() -> None:
    """Each default satisfies the schema of its own field, and each keyword is one of JSON Schema."""
    jsonschema = pytest.importorskip("jsonschema")

    found = json.loads(call("inspect", "schema").stdout)
    defaults = [
        (f"{kind}.{name}", field)
        for kind, part in [("Train", found), *found["$defs"].items()]
        for options in [part, *part.get("anyOf", ())]
        for name, field in options.get("properties", {}).items()
        if "default" in field and field["default"] is not None
    ]
    for name, field in defaults:
        validator = jsonschema.Draft202012Validator({"$defs": found["$defs"], **field})
        assert not list(validator.iter_errors(field["default"])), f"{name}: {field['default']}"
    assert dict(defaults)["Material.poisson"]["default"] == "0.3"
    assert dict(defaults)["Link.copies"]["maximum"] == 360
    keywords = {key for _, field in defaults for key in field}
    assert keywords <= {*jsonschema.Draft202012Validator.VALIDATORS, *("default", "description", "title", "examples")}


@pytest.mark.skipif(
    not (Path(sys.executable).parent / "lint-imports").exists(), reason="import-linter is not installed"
)
def test_the_corridor_runs_one_way() -> None:
    command = shutil.which("lint-imports", path=str(Path(sys.executable).parent))
    done = subprocess.run([command, "--no-cache"], cwd=ROOT, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
