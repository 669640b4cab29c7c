"""What every option that writes does with what stands in its way: one rule, for every command that there is."""

from __future__ import annotations

import os
import re
import socket
import stat
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin, get_type_hints

import pytest
from commands import HEAVY, RIGHT, UNUSABLE, call, functions

from geartrain.errors import GearTrainError
from geartrain.numerics.files import LongTable, check_folder, write_folder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="no FIFO, no socket in a folder")

PAIR = ("20", "30")
SIZED = (*PAIR, "--module", "1mm")
FORMS = ("involute", "cycloidal", "lantern", "circular-arc", "uniform-stress", "uniform-temperature", "least-friction")
MOTION = ("motion", "moon-triangular", "--turns", "1", "--samples", "64", "--of", "moon")
SIZED_TRAIN = ("optimise", "moon-triangular", "--of", "moon", "--objective", "jam", "--free", "window")
DOUBT = ("posterior", "{doubt}", "--free", "x=18:22", "--free", "z=38:42")
ERRORS = ("montecarlo", "moon-triangular", "--trials", "2", "--of", "moon", "--cutting", "pitch_deviation=2 %")
CURVE = ("feasibility", *ERRORS[1:], "--accuracy", "0.1:0.2:2")
IN_TIME = ("--rate", "1", "--turns", "2", "--skip", "0", "--steps", "100", "--no-fast")
BUDGET = ("budget", "moon-triangular", "--turns", "1", "--samples", "64", "--of", "moon")

# command and writing option -> the rest of a question, and the suffixes it may be written with
REQUESTED: dict[tuple[str, str], tuple[tuple[str, ...], tuple[str, ...]]] = {
    ("report", "-o"): (("report", "worm"), (".md", ".html", ".json")),
    ("view", "-o"): (("view", "worm"), (".html",)),
    ("draw", "-o"): (("draw", "worm", "--kind", "graph"), (".svg",)),
    ("export", "-o"): (("export", "planetary-24-18-60"), (".dot",)),
    ("compare", "-o"): (("compare", "worm"), (".md", ".html", ".json")),
    ("solve", "-o"): (("solve", "worm"), (".txt", "")),
    ("inspect equations", "-o"): (("inspect", "equations", "worm"), (".txt",)),
    ("init", "-o"): (("init", "clock"), (".yaml",)),
    ("format", "-o"): (("format", "{loaded}"), (".yaml",)),
    ("inspect formula", "-o"): (("inspect", "formula", "worm"), (".md", ".html", ".json")),
    ("gearbox", "-o"): (("gearbox", "simpson-set"), (".md", ".html", ".json")),
    ("inspect graph", "-o"): (("inspect", "graph", "worm"), (".md", ".dot", ".graphml", ".json")),
    ("torques", "-o"): (("torques", "worm"), (".md", ".json")),
    ("strength", "-o"): (("strength", "worm"), (".md", ".json")),
    ("torques", "--plot"): (("torques", "{loaded}"), (".svg",)),
    ("motion", "-o"): (MOTION, (".md", ".json", ".csv")),
    ("motion", "--plot"): (MOTION, (".svg",)),
    ("dynamics", "-o"): (("dynamics", "{heavy}", *IN_TIME), (".md", ".json", ".csv")),
    ("dynamics", "--plot"): (("dynamics", "{heavy}", *IN_TIME), (".svg",)),
    ("montecarlo", "-o"): (ERRORS, (".md", ".json", ".csv", ".parquet")),
    ("montecarlo", "--plot"): (ERRORS, (".svg",)),
    ("feasibility", "-o"): (CURVE, (".md", ".html", ".json")),
    ("feasibility", "--plot"): (CURVE, (".svg",)),
    ("budget", "-o"): (BUDGET, (".md", ".json")),
    ("budget", "--plot"): (BUDGET, (".svg",)),
    ("sphere", "-o"): (("sphere", "cube"), (".md", ".json")),
    ("sphere", "--plot"): (("sphere", "cube", "--teeth", "4=12"), (".svg",)),
    ("teeth ratio", "-o"): (
        ("teeth", "ratio", "7/3", "--stages", "1", "--best", "1"),
        (".md", ".json", ".csv", ".yaml"),
    ),
    ("teeth approximants", "-o"): (("teeth", "approximants", "7/3"), (".md", ".json", ".csv")),
    ("teeth train", "-o"): (("teeth", "train", "{hands}", "--best", "1", "--workers", "1"), (".md", ".json", ".yaml")),
    ("teeth set", "-o"): (("teeth", "set", "7/2", "--kind", "planetary"), (".md", ".json", ".yaml")),
    ("teeth orrery", "-o"): (("teeth", "orrery", "a=3", "b=5/2", "--range", "12:40"), (".md", ".json", ".yaml")),
    ("reconstruct", "-o"): (("reconstruct", "metonic-l-m"), (".md", ".html", ".json")),
    ("reconstruct", "--page"): (("reconstruct", "metonic-l-m", "--animated", "1"), (".html",)),
    ("posterior", "-o"): (DOUBT, (".md", ".json", ".csv", ".parquet")),
    ("posterior", "--plot"): (DOUBT, (".svg",)),
    ("optimise", "-o"): (SIZED_TRAIN, (".md", ".html", ".json", ".yaml")),
    ("optimise", "--plot"): (SIZED_TRAIN, (".svg",)),
    ("inspect bench", "-o"): (("inspect", "bench", "worm"), (".md", ".html", ".json")),
    ("inspect wheels", "-o"): (("inspect", "wheels", "{measured}"), (".md", ".html", ".json")),
    ("inspect schema", "-o"): (("inspect", "schema"), (".json",)),
    ("mesh triangular", "-o"): (("mesh", *PAIR, "--form", "triangular", "-p", "window=0.5"), (".md", ".json")),
    ("mesh triangular", "--plot"): (("mesh", *PAIR, "--form", "triangular", "-p", "window=0.5"), (".svg",)),
    ("mesh triangular", "--profile"): (("mesh", *SIZED, "--form", "triangular", "-p", "window=0.5"), (".svg",)),
    ("pin", "-o"): (("pin", "10", "5"), (".md", ".json")),
    ("mesh compare", "-o"): (("mesh", *PAIR, "--compare", "--form", "cycloidal"), (".md", ".json")),
    ("mesh compare", "--plot"): (("mesh", *PAIR, "--compare", "--form", "cycloidal"), (".svg",)),
}
for _form, _pair in [*((form.replace("-", "_"), PAIR) for form in FORMS), ("pin_ring", ("11", "12"))]:
    _verb = "mesh" if _form == "involute" else f"mesh {_form}"
    _sized = (*_pair, *SIZED[len(PAIR) :])
    REQUESTED[_verb, "-o"] = (("mesh", *_pair, "--form", _form), (".md",))
    REQUESTED[_verb, "--plot"] = (("mesh", *_pair, "--form", _form), (".svg",))
    REQUESTED[_verb, "--profile"] = (("mesh", *_sized, "--form", _form), (".svg",))
FOLDER = ("export", "--to")
FOUND = ("reconstruct", "--to")  # tests of its own: tests/cli/test_reconstruct_command.py
TRAINS: dict[str, Path] = {}

Case = tuple[str, str, str]
TABLES = (".csv", ".parquet")  # written row by row
PARQUET = pytest.mark.needs("pyarrow")
CASES = [(command, option, suffix) for (command, option), (_, suffixes) in REQUESTED.items() for suffix in suffixes]
FIRST = [(command, option, suffixes[0]) for (command, option), (_, suffixes) in REQUESTED.items()]
OTHER_FORMS = {f"mesh {form.replace('-', '_')}" for form in FORMS} - {"mesh uniform_stress"}


def few_forms(cases: list[Case], quick: list[Case]) -> list[Any]:
    """Cases that make a result: commands of tooth forms are one function, and most forms of it wait for --slow.

    So do cases that are not among the quick ones.
    """
    slow = {case for case in cases if case[0] in OTHER_FORMS or case not in quick}
    return [
        pytest.param(*case, marks=[pytest.mark.slow] * (case in slow) + [PARQUET] * (case[2] == ".parquet"))
        for case in cases
    ]


def writing() -> Iterator[tuple[str, str]]:
    """Every option of every command that names a file, from the annotations of the commands themselves."""

    for verb, function in functions():
        for hint in get_type_hints(function, include_extras=True).values():
            if get_origin(hint) is Annotated and Path in (get_args(get_args(hint)[0]) or get_args(hint)[:1]):
                option = get_args(hint)[1]
                yield verb, (option.default, *option.param_decls)[-1]


@pytest.fixture(scope="module", autouse=True)
def _trains(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Trains that no shipped one stands for."""
    folder = tmp_path_factory.mktemp("trains")
    doubt = RIGHT.replace("expect: 1/2", "targets: [{speed: 1/2, tolerance: 10 %}]")
    hands = RIGHT.replace("z: 40", "z: {teeth: {search: [30, 50]}}")
    loaded = RIGHT + "loads: {c: -1 N m}\n"
    angles = ", ".join(f"{18 * tooth} deg" for tooth in range(20))
    measured = RIGHT.replace("x: 20", f"x: {{teeth: 20, cutting: {{measured: {{angles: [{angles}]}}}}}}")
    texts = {"doubt": doubt, "hands": hands, "loaded": loaded, "heavy": HEAVY, "measured": measured}
    for name, text in texts.items():
        TRAINS[f"{{{name}}}"] = folder / f"{name}.yaml"
        TRAINS[f"{{{name}}}"].write_text(text, encoding="utf-8")


def ask(command: str, option: str, path: object, *more: object) -> Any:
    return call(*(TRAINS.get(word, word) for word in REQUESTED[command, option][0]), option, path, *more)


def test_every_option_that_names_a_file_is_tried_here() -> None:
    reads = {("sphere", "--graph"), ("init", "--from")}
    assert set(writing()) - reads == {
        (re.sub("^mesh .*", "mesh", verb), option) for verb, option in (*REQUESTED, FOLDER, FOUND)
    }


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("geartrain.analysis.accuracy._ENOUGH", 0.0)  # `bench` need not time well what it writes
    monkeypatch.setattr("geartrain.analysis.accuracy._LONG", 0.0)
    return tmp_path


def refused(done: Any) -> str:
    assert done.exit_code != 0
    assert isinstance(done.exception, GearTrainError), done.output
    assert done.stdout == ""
    for problem in done.exception.problems:
        assert problem.what
        assert problem.fix
    return str(done.exception)


@pytest.mark.parametrize(("command", "option", "suffix"), CASES)
def test_an_existing_file_is_kept_unless_forced(here: Path, command: str, option: str, suffix: str) -> None:
    (here / f"x{suffix}").write_text("mine", encoding="utf-8")
    said = refused(ask(command, option, f"x{suffix}"))
    assert "the file exists" in said
    assert "--force" in said
    assert (here / f"x{suffix}").read_text(encoding="utf-8") == "mine"
    assert [path.name for path in here.iterdir()] == [f"x{suffix}"]


@pytest.mark.parametrize("force", [(), ("--force",)])
@pytest.mark.parametrize(("command", "option", "suffix"), FIRST)
def test_what_is_no_regular_file_is_refused_by_name_and_stays_what_it_is(
    here: Path, command: str, option: str, suffix: str, force: tuple[str, ...]
) -> None:
    fifo, link, folder, plug = (here / f"{name}{suffix}" for name in ("fifo", "link", "folder", "plug"))
    os.mkfifo(fifo)
    link.symlink_to("/dev/null")
    folder.mkdir()
    server = socket.socket(socket.AF_UNIX)
    server.bind(plug.name)
    before = {path.name: (path.lstat().st_ino, path.lstat().st_mode) for path in here.iterdir()}
    device = os.stat("/dev/null")
    with server:
        assert "a FIFO" in refused(ask(command, option, fifo.name, *force))
        assert "a folder" in refused(ask(command, option, folder.name, *force))
        assert "a socket" in refused(ask(command, option, plug.name, *force))
        said = refused(ask(command, option, link.name, *force))
        assert "a device" in said
        assert "- for standard output" in said
    assert {path.name: (path.lstat().st_ino, path.lstat().st_mode) for path in here.iterdir()} == before
    assert (os.stat("/dev/null").st_mode, os.stat("/dev/null").st_ino) == (device.st_mode, device.st_ino)


@pytest.mark.parametrize(("command", "option", "suffix"), FIRST)
def test_a_read_only_file_is_refused_even_to_root_and_by_force(
    here: Path, command: str, option: str, suffix: str
) -> None:
    out = here / f"x{suffix}"
    out.write_text("mine", encoding="utf-8")
    out.chmod(0o444)
    said = refused(ask(command, option, out.name, "--force"))
    assert "read-only" in said
    assert "-r--r--r--" in said
    assert out.read_text(encoding="utf-8") == "mine"
    assert stat.S_IMODE(out.stat().st_mode) == 0o444


@pytest.mark.parametrize(
    ("command", "option", "suffix"),
    few_forms([case for case in CASES if case in FIRST or case[2] in TABLES], FIRST[::3]),
)
def test_by_force_the_file_behind_a_link_is_replaced_and_link_and_rights_are_kept(
    here: Path, command: str, option: str, suffix: str
) -> None:
    (here / "away").mkdir()
    real, link = here / "away" / f"real{suffix}", here / f"link{suffix}"
    real.write_text("mine", encoding="utf-8")
    real.chmod(0o640)
    link.symlink_to(real)
    assert "the file exists" in refused(ask(command, option, link.name))
    done = ask(command, option, link.name, "--force")
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert link.is_symlink()
    assert link.resolve() == real
    assert real.stat().st_size > 0
    assert real.read_bytes() != b"mine"
    assert stat.S_IMODE(real.stat().st_mode) == 0o640
    assert sorted(path.name for path in here.rglob("*")) == sorted(["away", link.name, real.name])


@pytest.mark.parametrize(("command", "option", "suffix"), few_forms([case for case in FIRST if case[1] == "-o"], FIRST))
def test_a_dash_is_standard_output_and_no_file(here: Path, command: str, option: str, suffix: str) -> None:
    done = ask(command, option, "-")
    if command == "export":
        assert "a train cannot be written as '-'" in refused(done)
    else:
        assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
        assert done.stdout_bytes
    assert list(here.iterdir()) == []


def test_a_picture_beside_an_answer_needs_a_file(here: Path) -> None:
    for command, option, _ in FIRST:
        if option != "-o":
            assert f"{option}" in refused(ask(command, option, "-"))
    assert list(here.iterdir()) == []


def test_two_results_of_one_command_never_share_a_file(here: Path) -> None:
    (here / "b.svg").symlink_to("a.svg")
    requested = ("mesh", *SIZED, "--form", "triangular", "--plot", "a.svg", "--profile")
    for second in ("a.svg", "b.svg", "./a.svg"):
        assert "two results are written to the same file" in refused(call(*requested, second, "--force"))
    assert [path.name for path in here.iterdir()] == ["b.svg"]


# --------------------------------------------------------------------------------------------------------- the writer

WRITTEN = ("init", "clock", "-o")


def test_a_link_to_nothing_leads_to_the_new_file(here: Path) -> None:
    (here / "link.yaml").symlink_to("new.yaml")
    assert call(*WRITTEN, "link.yaml").exit_code == 0
    assert (here / "link.yaml").is_symlink()
    assert (here / "new.yaml").is_file()
    (here / "round.yaml").symlink_to("round.yaml")
    assert "not a valid file name" in refused(call(*WRITTEN, "round.yaml", "--force"))


def test_a_file_that_appears_while_a_result_is_worked_out_is_kept(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = os.fdopen

    def late(*given: Any) -> Any:
        (here / "x.yaml").write_text("mine", encoding="utf-8")
        return write(*given)

    monkeypatch.setattr(os, "fdopen", late)
    assert "the file exists" in refused(call(*WRITTEN, "x.yaml"))
    assert (here / "x.yaml").read_text(encoding="utf-8") == "mine"
    assert [path.name for path in here.iterdir()] == ["x.yaml"]


def test_a_new_file_heeds_the_umask(here: Path) -> None:
    before = os.umask(0o027)
    try:
        call(*WRITTEN, "x.yaml")
    finally:
        os.umask(before)
    assert stat.S_IMODE((here / "x.yaml").stat().st_mode) == 0o640


def test_what_is_written_is_on_the_disk_before_it_takes_its_name(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    sync, link, replace = os.fsync, os.link, os.replace
    monkeypatch.setattr(os, "fsync", lambda handle: (done.append("sync"), sync(handle))[1])
    monkeypatch.setattr(os, "link", lambda *names: (done.append("name"), link(*names))[1])
    monkeypatch.setattr(os, "replace", lambda *names: (done.append("name"), replace(*names))[1])
    call(*WRITTEN, "x.yaml")
    call(*WRITTEN, "x.yaml", "--force")
    assert done == ["sync", "name", "sync"] * 2


def test_files_that_are_there_are_counted_in_one_sentence(here: Path) -> None:
    for names, words in (("a", "'a' is"), ("ab", "'a' and 1 other file are"), ("abcd", "'a' and 3 other files are")):
        for name in names:
            (here / name).write_text("mine", encoding="utf-8")
        with pytest.raises(GearTrainError) as found:
            check_folder(here, [*names, "z"])
        assert found.value.problems[0].what == f"{words} already in the folder"


def test_a_folder_of_results_follows_the_same_rule(here: Path) -> None:
    to = here / "set"
    (to / "wheels").mkdir(parents=True)
    (here / "away").write_text("mine", encoding="utf-8")
    (to / "graph.dot").symlink_to(here / "away")
    requested = ("export", "planetary-24-18-60", "--to", to, "--as", "dot")
    assert "'graph.dot' is already in the folder" in refused(call(*requested))
    assert call(*requested, "--force").exit_code == 0
    assert (to / "graph.dot").is_symlink()
    assert "graph" in (here / "away").read_text(encoding="utf-8")
    (to / "graph.dot").unlink()
    os.mkfifo(to / "graph.dot")
    assert "a FIFO" in refused(call(*requested, "--force"))
    (to / "graph.dot").unlink()
    (to / "graph.dot").write_text("mine", encoding="utf-8")
    (to / "graph.dot").chmod(0o444)
    assert "read-only" in refused(call(*requested, "--force"))
    with pytest.raises(GearTrainError, match="read-only"):
        write_folder(to, [("new.txt", b"new"), ("graph.dot", b"ours")], force=True)
    assert not (to / "new.txt").exists(), "all of them, or none"


def test_a_partial_table_is_no_link_and_is_begun_again_only_if_requested(here: Path) -> None:
    with suppress(KeyboardInterrupt), LongTable(here / "x.csv", "a") as table:
        table.write(["1"])
        raise KeyboardInterrupt
    with pytest.raises(GearTrainError, match="--resume"):
        LongTable(here / "x.csv", "a")
    with LongTable(here / "x.csv", "a", resume=True) as table:
        assert table.rows == 1
    with pytest.raises(GearTrainError, match="the file exists"):
        LongTable(here / "x.csv", "a", resume=True)
    (here / "away").write_text("mine", encoding="utf-8")
    (here / "y.partial.csv").symlink_to("away")
    with pytest.raises(GearTrainError, match="symbolic link"):
        LongTable(here / "y.csv", "a", force=True)
    assert (here / "away").read_text(encoding="utf-8") == "mine"


def test_what_cannot_be_written_is_said_before_anything_is_read(here: Path) -> None:
    (here / "t.yaml").write_text(UNUSABLE, encoding="utf-8")
    (here / "x.md").write_text("mine", encoding="utf-8")
    assert "the file exists" in refused(call("report", "t.yaml", "-o", "x.md"))
    (here / "t.yaml").write_text(RIGHT, encoding="utf-8")
    assert call("report", "t.yaml", "-o", "x.md", "--force").exit_code == 0


@pytest.mark.parametrize(("verb", "suffix"), [("report", ".html"), ("report", ".md"), ("compare", ".html")])
def test_a_run_that_fails_leaves_the_old_file_and_makes_no_new_one(here: Path, verb: str, suffix: str) -> None:
    (here / "bad.yaml").write_text(UNUSABLE, encoding="utf-8")
    old = here / f"old{suffix}"
    old.write_text("before", encoding="utf-8")
    for out in (old.name, f"new{suffix}"):
        done = call(verb, "worm", "bad.yaml", "pennestri-2002", "-o", out, "--force")
        assert done.exit_code != 0
        assert done.stdout == ""
    assert old.read_text(encoding="utf-8") == "before"
    assert sorted(each.name for each in here.iterdir()) == ["bad.yaml", old.name]
