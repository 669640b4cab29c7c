"""What a fresh process imports, and how it does without what it does not need."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest
from commands import ended, without
from places import DOCS, ROOT

from geartrain.errors import MissingExtraError


def normal(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "geartrain", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("missing", "arguments"),
    [
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2", "flint"], ["report", "pennestri-2002"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["solve", "pennestri-2002"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["solve", "zf-8hp70", "--json"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["check", "freeth-2021", "zf-8hp70"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["compare", "freeth-2006", "freeth-2008"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["periods", "saros"]),
        (["scipy", "numpy", "networkx", "matplotlib", "jinja2"], ["inspect", "equations", "zf-8hp70"]),
        (["scipy", "matplotlib"], ["mesh", "48", "96", "--form", "triangular", "-p", "window=0.5"]),
    ],
    ids=lambda words: " ".join(words),
)
def test_a_command_says_the_same_without_the_libraries_it_has_no_need_of(
    missing: list[str], arguments: list[object]
) -> None:
    bare, whole = without(*missing, arguments=arguments), ended(*arguments)
    assert (bare.returncode, bare.stderr) == (0, "")
    assert bare.stdout == whole.stdout != ""


def test_a_cold_report_imports_neither_a_large_library_nor_the_html_page() -> None:
    command = [sys.executable, "-X", "importtime", "-m", "geartrain", "report", "pennestri-2002"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    names = {line.rsplit("|", 1)[1].strip() for line in done.stderr.splitlines() if line.startswith("import time:")}
    tops = {name.partition(".")[0] for name in names}
    assert {"geartrain", "pydantic", "yaml"} <= tops, "this listing shows what is imported"
    large = {"scipy", "numpy", "networkx", "matplotlib", "jinja2", "pandas", "flint", "hypothesis", "pytest"}
    assert tops & large == set()
    assert "geartrain.report.html_page" not in names


@pytest.mark.parametrize("verb", ["report", "compare"])
def test_a_page_without_jinja2_is_refused_with_the_extra_to_install(
    verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "jinja2", None)
    new, old = tmp_path / "new.html", tmp_path / "old.html"
    old.write_text("before", encoding="utf-8")
    for out in (new, old):
        done = ended(verb, "worm", "planetary", "-o", out, "--force")
        assert (done.returncode, done.stdout) == (2, "")
        assert "jinja2" in done.stderr
        assert "pip install 'jinja2>=3.1'" in done.stderr
        assert "Traceback" not in done.stderr
    assert old.read_text(encoding="utf-8") == "before"
    assert list(tmp_path.iterdir()) == [old]


@pytest.mark.parametrize("verb", ["report", "compare", "inspect bench", "motion", "torques", "montecarlo", "posterior"])
def test_a_page_that_cannot_be_made_is_refused_before_anything_is_read_or_drawn(
    verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "jinja2", None)
    done = ended(*verb.split(), tmp_path / "no such train", "-o", tmp_path / "new.html")
    assert done.returncode == 2
    assert "jinja2 is not installed" in done.stderr
    assert "no such train" not in done.stderr


PAIR = ("mesh", "24", "36", "--module", "2mm")


@pytest.mark.parametrize(
    ("missing", "package", "arguments"),
    [
        ("ezdxf", "ezdxf>=1.3", (*PAIR, "--profile", "w.dxf")),
        ("matplotlib", "matplotlib>=3.8", (*PAIR, "--plot", "w.svg")),
        ("OCP", "cadquery-ocp-novtk>=7.8", ("export", "planetary-24-18-60", "-o", "set.step")),
    ],
)
def test_a_missing_library_is_named_with_its_package(
    missing: str, package: str, arguments: tuple[str, ...], here: Path
) -> None:
    done = without(missing, arguments=[*arguments])
    assert done.returncode == 2
    assert "is not installed" in done.stderr
    assert f"pip install '{package}'" in done.stderr
    assert "Traceback" not in done.stderr
    assert list(here.iterdir()) == []


def test_what_is_missing_is_told_with_what_it_weighs() -> None:
    measured = json.loads((DOCS / "data/extras.json").read_text(encoding="utf-8"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for extra in project["optional-dependencies"].keys() - {"all", "ci", "dev", "site"}:
        (told,) = MissingExtraError("it", extra, "this").problems
        command, _, size = told.fix.partition(" # ")
        assert size == f"{max(round(measured[extra][1]), 1)} MB"
        pip, install, *packages = shlex.split(command)
        assert (pip, install) == ("pip", "install")
        needs = project["optional-dependencies"][extra]
        assert sorted(packages) == sorted(need.lower() for need in needs)  # builds write names in lower case


def test_a_copy_that_is_not_installed_is_installed_from_its_sources(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(name: str) -> list[str]:
        raise PackageNotFoundError(name)

    monkeypatch.setattr("importlib.metadata.requires", unknown)
    assert MissingExtraError("it", "plot", "this").problems[0].fix.startswith("pip install -e '.[plot]' #")


def test_every_package_that_a_page_installs_is_one_of_an_extra() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    known = {need for needs in project["optional-dependencies"].values() for need in needs}
    for page in DOCS.glob("*.md"):
        text = page.read_text(encoding="utf-8")
        assert "pip install 'geartrain" not in text, page
        assert "pip install geartrain" not in text, page
        named = {
            name for line in re.findall(r"pip install (?!-e)([^`\n]*)", text) for name in re.findall("'([^']+)'", line)
        }
        assert named <= known, page


def test_a_missing_package_skips_tests_by_name_and_fails_where_all_are_installed(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text((ROOT / "tests/conftest.py").read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "test_it.py").write_text(
        "import pytest\n\n\ndef test_it():\n    pytest.importorskip('no_such_package', reason='not there')\n"
        "@pytest.mark.slow\ndef test_more():\n    pass\n",
        encoding="utf-8",
    )
    for required, code, said in (("", 0, "1 skipped: not there"), ("1", 1, "No module named 'no_such_package'")):
        done = subprocess.run(
            [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--rootdir", tmp_path, tmp_path],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "GEARTRAIN_REQUIRE_EXTRAS": required},
            cwd=tmp_path,
        )
        assert done.returncode == code, done.stdout
        assert said in done.stdout
        assert "1 deselected" in done.stdout


def test_the_same_report_in_markdown_needs_no_extra(tmp_path: Path) -> None:
    out = tmp_path / "r.md"
    assert without("jinja2", arguments=["report", "worm", "-o", out]).returncode == 0
    assert "-1/30" in out.read_text(encoding="utf-8")


@pytest.mark.parametrize(("name", "code"), [("worm", 0), ("wrong", 1), ("missing", 2)])
def test_the_exit_code_of_the_process_is_that_of_the_finding(name: str, code: int, tmp_path: Path) -> None:
    (tmp_path / "wrong").write_text("extends: worm\noutputs: {wheel: {expect: 1/30}}\n", encoding="utf-8")
    done = normal("check", name if code == 0 else tmp_path / name)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert bool(done.stderr) == (code == 2)
