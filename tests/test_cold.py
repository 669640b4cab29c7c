"""Pay for what you use: what a command imports, and what is missing without an extra."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

RUN = """
import contextlib, io, sys
from geartrain.cli import app
with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):
    app({arguments!r})
print(" ".join(sorted(name for name in {heavy!r} if name in sys.modules)))
"""
HEAVY = ("scipy", "matplotlib", "jinja2", "numpy", "networkx")


def imported(*arguments: str) -> set[str]:
    code = RUN.format(arguments=list(arguments), heavy=HEAVY)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    ("arguments", "paid"),
    [
        (["report", "pennestri-2002"], {"networkx"}),
        (["solve", "pennestri-2002"], set()),
        (["check", "freeth-2021"], set()),
        (["compare", "freeth-2006", "freeth-2008"], set()),
        (["equations", "zf-8hp70"], set()),
        (["solve", "worm", "--method", "floats"], {"numpy", "scipy"}),
    ],
)
def test_a_command_imports_only_what_it_needs(arguments: list[str], paid: set[str]) -> None:
    assert imported(*arguments) == paid


def test_a_missing_library_says_which_extra_brings_it(tmp_path: Path) -> None:
    code = "import sys; sys.modules['jinja2'] = None; from geartrain.cli import main; main()"
    out = tmp_path / "x.html"
    command = [sys.executable, "-c", code, "report", "worm", "-o", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "pip install 'geartrain[report]'" in done.stderr
    assert not out.exists()
