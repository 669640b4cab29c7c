"""`geartrain view` and the page it writes: one careful file, and what is refused."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import zlib
from base64 import b64decode, b64encode
from collections.abc import Callable
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from commands import HEAVY, LOCKED, RIGHT, WRONG, call, interrupt_after
from html_reader import Read

import geartrain.viewer
from geartrain import GearTrainError, load
from geartrain.errors import QuestionError
from geartrain.scene import make_scene
from geartrain.viewer import page

VIEWER = Path(geartrain.viewer.__file__).parent
EVIL = "</script><script>alert(1)</script><!-- \u2028 &amp; <img src=x onerror=alert(2)>"
Written = Callable[..., Path]


def data_of(read: Read) -> dict[str, Any]:
    """Return the scenes and options of a page."""
    data: dict[str, Any] = json.loads(zlib.decompress(b64decode(read.scripts[0])))
    return data


def test_the_page_of_the_largest_train_without_teeth_is_below_a_megabyte_and_its_program_below_750_kilobytes(
    here: Path,
) -> None:
    assert (VIEWER / "built" / "viewer.js").stat().st_size < 750_000
    done = call("view", "freeth-2021")
    written = here / "freeth-2021.html"
    assert done.exit_code == 0, done.output
    assert 100_000 < written.stat().st_size < 1_000_000
    assert f"{written.stat().st_size / 1000:,.0f} kB" in done.output
    assert [path.name for path in here.iterdir()] == ["freeth-2021.html"]


def test_the_page_carries_the_scene_unchanged_and_nothing_that_points_elsewhere() -> None:
    scene = make_scene(load("freeth-2008"))
    read = Read(page([scene]))
    assert data_of(read)["scenes"] == json.loads(json.dumps([scene.to_dict()]))
    assert len(read.scripts) == 2
    for name, attributes in read.elements:
        assert "src" not in attributes, name
        assert attributes.get("href", "data:,") == "data:,", name


def test_the_policy_of_the_page_lets_its_own_script_run_and_nothing_reach_out() -> None:
    read = Read(page([make_scene(load("planetary-24-18-60"))]))
    policy = next(each["content"] for each in read.all("meta") if "http-equiv" in each)
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    digest = b64encode(sha256(read.scripts[1].encode("utf-8")).digest()).decode()
    assert rules["script-src"] == f"'sha256-{digest}'"
    assert rules["default-src"] == rules["connect-src"] == "'none'"
    assert "unsafe-eval" not in policy


def test_names_that_look_like_html_stay_names() -> None:
    scene = replace(make_scene(load("planetary-24-18-60")), name=EVIL, title=EVIL, verdict={"text": EVIL})
    read = Read(page([scene]))
    assert (len(read.scripts), read.all("img")) == (2, [])
    assert data_of(read)["scenes"][0]["title"] == EVIL


def test_a_page_needs_a_scene_and_a_comparison_two() -> None:
    with pytest.raises(QuestionError, match="too few scenes"):
        page([])
    with pytest.raises(QuestionError, match="too few scenes"):
        page([make_scene(load("planetary-24-18-60"))], compare=True)


def scenes_of(path: Path) -> tuple[list[dict[str, object]], dict[str, object]]:
    data = data_of(Read(path.read_text(encoding="utf-8")))
    return data["scenes"], data["options"]


def test_all_states_stand_in_one_page_or_the_one_that_is_named(here: Path) -> None:
    states = load("zf-8hp70").states
    assert call("view", "zf-8hp70").exit_code == 0
    scenes, _ = scenes_of(here / "zf-8hp70.html")
    assert [scene["state"] for scene in scenes] == list(states)
    assert call("view", "zf-8hp70", "--state", states[2], "-o", "one.html").exit_code == 0
    assert [scene["state"] for scene in scenes_of(here / "one.html")[0]] == [states[2]]


def test_two_trains_stand_side_by_side(here: Path) -> None:
    assert call("view", "price-1974", "freeth-2006", "--discs").exit_code == 0
    scenes, options = scenes_of(here / "price-1974-freeth-2006.html")
    assert [scene["name"] for scene in scenes] == ["price-1974", "freeth-2006"]
    assert options == {"compare": True, "teeth": False}


def test_a_train_that_cannot_turn_is_shown_and_the_exit_code_tells(train_file: Written, here: Path) -> None:
    done = call("view", train_file(LOCKED), "-o", "locked.html")
    assert done.exit_code == 1
    scenes, _ = scenes_of(here / "locked.html")
    assert any(pair["broken"] for pair in scenes[0]["pairs"])  # type: ignore[attr-defined]


JAMMED = """
links: {frame: {}, a: {wheels: {p: 27}}, b: {wheels: {q: 45}}}
revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]
gears: [{pair: [p, q], tooth_form: {form: triangular, half_angle: 30 deg, clearance_factor: 1.001}}]
inputs: {a: 1}
"""


def test_the_exit_code_is_that_of_a_report_and_teeth_that_jam_are_named(train_file: Written, here: Path) -> None:
    for text in (WRONG, JAMMED):
        train = train_file(text)
        told, shown = call("report", train), call("view", train, "-o", "shown.html", "--force")
        assert "Verdict" in told.output
        assert told.exit_code == shown.exit_code == 1
    scene = scenes_of(here / "shown.html")[0][0]
    (named,) = scene["verdict"]["loops"]  # type: ignore[index]
    assert (named["pairs"], named["links"]) == (["p~q"], ["a", "b"])
    for part in ("jam", "clearance factor 1.001 is below the window", "window: 0.5"):  # what, why, what to do
        assert part in named["text"]


def refusal(*arguments: object) -> str:
    done = call("view", *arguments)
    assert done.exit_code != 0
    assert isinstance(done.exception, GearTrainError), done.exception
    for problem in done.exception.problems:
        assert problem.what
        assert problem.why
        assert problem.fix
    return str(done.exception)


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="there is no /proc, where nobody may write")
def test_a_folder_that_is_closed_is_said_to_be() -> None:
    assert "cannot be written" in refusal("planetary-24-18-60", "-o", "/proc/train.html")


def test_the_name_of_a_train_becomes_that_of_a_file(train_file: Written, here: Path) -> None:
    odd = train_file("name: '../a b/<c>'\n" + RIGHT)
    assert call("view", odd).exit_code == 0
    assert (here / "a-b-c.html").is_file()


def test_built_files_are_what_their_sources_build(tmp_path: Path) -> None:
    """From a clean copy, with the packages that the lock file names."""
    npm, node = shutil.which("npm"), shutil.which("node")
    if npm is None or node is None:
        pytest.skip("node and npm are not there: the built viewer is not compared with its sources")
    copy = shutil.copytree(VIEWER, tmp_path / "viewer", ignore=shutil.ignore_patterns("node_modules", "built"))
    got = subprocess.run([npm, "ci", "--prefer-offline"], cwd=copy, capture_output=True, text=True, check=False)
    if got.returncode != 0:
        pytest.skip(f"npm cannot get its packages: the built viewer is not compared with its sources: {got.stderr}")
    subprocess.run([node, "build.mjs"], cwd=copy, check=True)
    assert {path.name for path in (copy / "built").iterdir()} == {path.name for path in (VIEWER / "built").iterdir()}
    for name in ("viewer.js", "viewer.css", "diagrams.js", "diagrams.css"):
        built = (copy / "built" / name).read_bytes()
        assert built == (VIEWER / "built" / name).read_bytes(), f"{name} is stale: npm ci && node build.mjs"


def test_the_lock_file_names_exact_packages_and_no_addresses() -> None:
    wanted = json.loads((VIEWER / "package.json").read_text(encoding="utf-8"))
    for version in (wanted["dependencies"] | wanted["devDependencies"]).values():
        assert re.fullmatch(r"\d+\.\d+\.\d+", version)
    lock = (VIEWER / "package-lock.json").read_text(encoding="utf-8")
    assert "resolved" not in lock
    assert "://" not in re.sub(r'"funding": \{[^}]*\}', "", lock)


PLAYED = ("--rate", "1", "--turns", "0.5", "--skip", "0", "--steps", "1000", "--no-fast")


def test_the_motion_in_time_is_played_from_one_file_with_the_angles_of_dynamics(
    train_file: Written, here: Path
) -> None:
    done = call("view", train_file(HEAVY), "--dynamics", *PLAYED, "-o", "run.html")
    assert done.exit_code == 0, done.output
    (scene,), _ = scenes_of(here / "run.html")
    run: Any = scene["run"]
    assert {path.name for path in here.iterdir()} == {"train.yaml", "run.html"}
    assert (run["driven"], run["link"], run["complete"]) == ("rate", "a", True)
    assert run["duration"] == pytest.approx(0.5, rel=2e-3)
    assert [each["name"] for each in run["contacts"]] == ["a~b"]
    assert len(run["links"]) == len(scene["bodies"])  # type: ignore[arg-type]


def test_a_train_that_has_no_motion_in_time_is_refused_as_dynamics_refuses_it(here: Path) -> None:
    for words in (
        ("freeth-2008", "--rate", "1"),
        ("moon-triangular-inertia",),
        ("moon-triangular-inertia", "--rate", "x"),
    ):
        told = call("dynamics", *words)
        done = call("view", words[0], "--dynamics", *words[1:])
        assert str(done.exception) == str(told.exception) != ""
        assert done.exit_code == told.exit_code != 0
    assert list(here.iterdir()) == []


def test_an_interrupted_run_is_played_as_far_as_it_came(
    train_file: Written, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    interrupt_after(2, monkeypatch)
    words = ("--rate", "1", "--turns", "1", "--skip", "0", "--steps", "5000", "--no-fast")
    done = call("view", train_file(HEAVY), "--dynamics", *words, "-o", "run.html")
    assert done.exit_code == 130
    assert "stopped after" in done.stderr
    run: Any = scenes_of(here / "run.html")[0][0]["run"]
    assert run["complete"] is False
    assert 0.1 < run["duration"] < 0.9


def test_a_page_that_is_there_is_refused_before_anything_is_simulated(here: Path) -> None:
    old = here / "moon-triangular-inertia.html"
    old.write_text("mine", encoding="utf-8")
    assert "--force" in refusal("moon-triangular-inertia", "--dynamics", "--rate", "1", "--turns", "1e6")
    assert old.read_text(encoding="utf-8") == "mine"
