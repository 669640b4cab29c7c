"""Functions that run commands for the tests, and shared declarations and numbers."""

from __future__ import annotations

import inspect
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from typing import Any
from unittest.mock import patch

import pytest
import typer.main
from typer.testing import CliRunner, Result

from geartrain.cli import app, main
from geartrain.errors import GearTrainError

LOCKED = """
links: {frame: {}, a: {wheels: {x: 20}}, b: {wheels: {y: 30}}, c: {wheels: {z: 40}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}, {pair: [frame, c], axis: C}]
gears: [{pair: [x, y]}, {pair: [y, z]}, {pair: [z, x]}]
inputs: {a: 1}
"""
WRONG = LOCKED.replace(", {pair: [z, x]}", "") + "outputs:\n  c: {expect: 1/3}\n"
RIGHT = WRONG.replace("1/3", "1/2")
HEAVY = """
links: {frame: {}, a: {}, b: {inertia: 100 g cm2, bearing: 1 N mm}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
couplings: [{kind: pin_and_slot, pin: a, slot: b, pin_radius: 10 mm, offset: 8 mm}]
inputs: {a: 1}
"""
UNUSABLE = RIGHT.replace("gears:", "geers:")

# pennestri-2002, Table 4, as fractions
TWENTY = (
    *("0", "5", "-1", "-1", "254/19", "16/9", "-1", "1/4", "-1/2", "32/19"),
    *("-64/19", "-254/19", "-197/76", "-254/19", "1", "470/19", "-235/19", "235/57", "-235/228", "-235/38"),
)


# a finder that stands before all others: the named libraries are not there
BLOCK = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {missing!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Missing())
from geartrain.cli import main
main()
"""


def call(*arguments: object) -> Result:
    """Return the result of a command run in this process; input errors have text and exit code as on a console."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if isinstance(result.exception, GearTrainError):
        said = "".join(f"error: {problem}\n" for problem in result.exception.problems).encode()
        result.exit_code = 2
        result.stderr_bytes = (result.stderr_bytes or b"") + said
        result.output_bytes += said
    return result


def ended(*arguments: object) -> subprocess.CompletedProcess[str]:
    """Return exit code, standard output and standard error of the console script run in this process."""
    words = ["geartrain", *map(str, arguments)]
    out, err, code = StringIO(), StringIO(), None
    with patch.object(sys, "argv", words), redirect_stdout(out), redirect_stderr(err):
        try:
            main()
        except SystemExit as end:
            code = end.code
    assert isinstance(code, int)
    return subprocess.CompletedProcess(words, code, out.getvalue(), err.getvalue())


def without(*missing: str, arguments: list[object]) -> subprocess.CompletedProcess[str]:
    code = BLOCK.format(missing=set(missing))
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def interrupt_after(count: int, patch: pytest.MonkeyPatch) -> list[int]:
    """Interrupt this process at the `count`-th step of a progress bar, and return the list of steps so far."""
    from geartrain.cli.long_runs import ProgressBar

    told: list[int] = []

    def advance(bar: ProgressBar, steps: int = 1) -> None:
        told.append(steps)
        if len(told) == count:
            os.kill(os.getpid(), signal.SIGINT)

    patch.setattr(ProgressBar, "advance", advance)
    return told


def imported_by(code: str) -> set[str]:
    """Return the top-level modules that are loaded in a fresh interpreter after `code`."""
    tail = "\nimport sys, json; print(json.dumps(sorted({name.split('.')[0] for name in sys.modules})))"
    done = subprocess.run([sys.executable, "-c", code + tail], capture_output=True, text=True, check=True, timeout=120)
    return set(json.loads(done.stdout.splitlines()[-1]))


def verbs() -> Iterator[tuple[str, Any]]:
    """Return every command and group of commands by its full name, read from the application."""

    def walk(name: str, command: Any) -> Iterator[tuple[str, Any]]:
        yield name, command
        for sub, child in getattr(command, "commands", {}).items():
            yield from walk(f"{name} {sub}".strip(), child)

    return walk("", typer.main.get_command(app))


def functions() -> Iterator[tuple[str, Callable[..., None]]]:
    """Return every command that is not a group, and the function that it runs."""
    return ((name, inspect.unwrap(each.callback)) for name, each in verbs() if not hasattr(each, "commands"))
