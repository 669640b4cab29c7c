"""`geartrain export`: one file by its suffix, a folder of them, and what is refused."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest
from commands import LOCKED, call, without

from geartrain.errors import GearTrainError, Problem

LIGHT = "svg,graphml,dot,rexs,csv"
Write = Callable[..., Path]


def test_a_folder_holds_all_that_was_requested_for_and_a_list_of_it(tmp_path: Path) -> None:
    to = tmp_path / "deep" / "set"
    done = call("export", "planetary-24-18-60", "--to", to, "--as", LIGHT)
    assert done.exit_code == 0, done.output
    files = {str(path.relative_to(to)) for path in to.rglob("*") if path.is_file()}
    assert {"README.md", "wheels/s.svg", "wheels/ring.svg", "graph.dot", "gear-unit.rexsj"} < files
    table = re.search(r"^\| file .*?(?=\n\n|\Z)", (to / "README.md").read_text(encoding="utf-8"), re.M | re.S)
    listed = set(re.findall(r"^\| (\S+) \|", table.group(), re.M)) - {"file", "---"}
    pictures = {path for path in files if path.startswith("assembly/")}
    assert pictures
    assert listed == files - {"README.md"} - pictures | {"assembly/"}
    assert [path.name for path in to.parent.iterdir()] == ["set"], "nothing stands beside it"


def test_existing_files_are_refused_as_a_whole_and_force_writes_over_them(tmp_path: Path) -> None:
    to = tmp_path / "set"
    (to / "wheels").mkdir(parents=True)
    (to / "wheels" / "s.svg").write_text("mine", encoding="utf-8")
    (to / "own.txt").write_text("mine", encoding="utf-8")
    refused = call("export", "planetary-24-18-60", "--to", to, "--as", "svg")
    assert isinstance(refused.exception, GearTrainError)
    assert "wheels/s.svg" in str(refused.exception)
    assert "--force" in str(refused.exception)
    assert {path.name for path in to.rglob("*")} == {"wheels", "s.svg", "own.txt"}
    assert call("export", "planetary-24-18-60", "--to", to, "--as", "svg", "--force").exit_code == 0
    assert "24 teeth" in (to / "wheels" / "s.svg").read_text(encoding="utf-8")
    assert (to / "own.txt").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    ("error", "code"), [(KeyboardInterrupt(), 130), (OSError("lost"), 2), (GearTrainError(Problem("no")), 2)]
)
def test_what_stops_half_way_leaves_nothing_behind(
    error: BaseException, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(*_: object) -> str:
        raise error

    monkeypatch.setattr(import_module("geartrain.workshop.export.file_set"), "readme", stop)
    (tmp_path / "old").mkdir()
    for folder in (tmp_path / "new", tmp_path / "old"):
        done = call("export", "planetary-24-18-60", "--to", folder, "--as", LIGHT)
        assert done.exit_code == code
        assert ("no files were written" in done.stderr) == (code == 130)
    assert [path.name for path in tmp_path.rglob("*")] == ["old"]


def test_a_folder_that_is_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "x").write_text("", encoding="utf-8")
    assert "not a folder" in str(call("export", "planetary-24-18-60", "--to", tmp_path / "x", "--as", LIGHT).exception)


def test_a_module_is_refused_where_the_declaration_has_sizes(tmp_path: Path, train_file: Write) -> None:
    out = tmp_path / "x.stl"
    file = train_file(
        "links: {frame: {}, a: {wheels: {p: {teeth: 20, module: 2 mm}}}, b: {wheels: {w: {teeth: 30, module: 2 mm}}}}\n"
        "revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]\ngears: [{pair: [p, w]}]\n"
        "inputs: {a: 1}\n"
    )
    done = call("export", file, "-o", out, "--module", "1mm")
    assert "already has sizes" in str(done.exception)
    assert call("export", file, "-o", out).exit_code == 0


def test_a_locked_train_is_written_and_the_exit_code_says_so(tmp_path: Path, train_file: Write) -> None:
    done = call("export", train_file(LOCKED), "--to", tmp_path / "set", "--as", LIGHT)
    assert done.exit_code == 1, done.output
    assert (tmp_path / "set" / "wheels" / "x.svg").exists()


def test_names_and_titles_of_any_letters_are_harmless(tmp_path: Path) -> None:
    file = tmp_path / "odd.yaml"
    text = (
        LOCKED.replace(", {pair: [z, x]}", "").replace("{x: 20}", '{"../<b>&": 20}').replace("[x, y]", '["../<b>&", y]')
    )
    file.write_text('name: "<script>|"\n' + text, encoding="utf-8")
    to = tmp_path / "set"
    assert call("export", file, "--to", to, "--as", LIGHT).exit_code == 0
    (odd,) = (path for path in (to / "wheels").iterdir() if "b" in path.stem)
    assert "<b>" not in odd.read_text(encoding="utf-8")
    assert "<script>" not in (to / "README.md").read_text(encoding="utf-8")
    assert {path.name for path in tmp_path.iterdir()} == {"odd.yaml", "set"}


def test_without_any_extra_the_rest_is_written_and_what_is_missing_is_said(tmp_path: Path) -> None:
    done = without("ezdxf", "OCP", arguments=["export", "planetary-24-18-60", "--to", tmp_path / "set"])
    assert done.returncode == 0, done.stderr
    for package in ("ezdxf>=1.3", "cadquery-ocp-novtk>=7.8"):
        assert f"pip install '{package}'" in done.stderr
    suffixes = {path.suffix for path in (tmp_path / "set").rglob("*") if path.is_file()}
    assert suffixes == {".svg", ".stl", ".glb", ".graphml", ".dot", ".rexsj", ".csv", ".md"}


def test_backlash_in_mm_is_no_error_where_the_module_is_requested_for(tmp_path: Path, train_file: Write) -> None:
    train = train_file(
        "extends: planetary-24-18-60\nname: thin\n"
        "tooth_form: {form: involute, pressure_angle: 25 deg, backlash: 0.1 mm}\n"
    )
    done = call("export", train, "--to", tmp_path / "cut", "--as", "svg", "--module", "2mm")
    assert done.exit_code == 0, done.output
    assert "s~p: 0.1 mm" in (tmp_path / "cut" / "README.md").read_text(encoding="utf-8")


def test_parts_that_are_not_ready_to_cut_have_exit_code_1(tmp_path: Path, train_file: Write) -> None:
    text = """
name: planets
links:
  frame: {wheels: {r: {teeth: 45, internal: true}}}
  sun: {wheels: {s: 15}}
  planet: {wheels: {p: 15}, copies: 3}
  carrier: {}
revolutes: {main: [frame, sun, carrier], P: [carrier, planet]}
gears: [s ~ p, p ~ r]
inputs: {sun: 1}
"""
    done = call("export", train_file(text), "--to", tmp_path / "fit", "--as", "svg", "--module", "2mm")
    assert (done.exit_code, "not ready to cut" in done.output) == (0, False), done.output
    # 16 + 45 teeth are not a multiple of 3: one planet can be assembled
    train = train_file(text.replace("s: 15", "s: 16").replace("p: 15", "p: 14"))
    done = call("export", train, "--to", tmp_path / "miss", "--as", "svg", "--module", "2mm")
    assert (done.exit_code, "not ready to cut" in done.output) == (1, True), done.output
    assert (tmp_path / "miss" / "README.md").exists()
