"""How the command ends: faults of its own, interrupts and closed pipes are never taken for a verdict."""

from __future__ import annotations

import functools
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from clusters import next_line
from commands import verbs
from places import ROOT, TESTS
from test_output_files import DOUBT, REQUESTED

from geartrain.cli import app, main
from geartrain.cli.verbs import EndingGroup

OTHERS = {
    "check": ("check", "worm"),
    "list": ("list",),
    "periods": ("periods",),
    "reconstruct": ("reconstruct", "moon-c-e"),
    "watch": ("watch", "train.yaml"),
}


def runs() -> Iterator[tuple[str, Any]]:
    """Every command that is no group."""
    return ((name, each) for name, each in verbs() if not hasattr(each, "commands"))


def requested(verb: str) -> list[str]:
    words = REQUESTED[verb, "-o"][0] if (verb, "-o") in REQUESTED else OTHERS[verb]
    return [*("worm" if word.startswith("{") else word for word in words), *(["-o", "x.dot"] * (verb == "export"))]


@pytest.fixture
def run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> Callable[..., tuple[int, str, str]]:
    """Runs `main` as the console script does; the exit code, standard output, standard error."""
    monkeypatch.chdir(tmp_path)
    here = SimpleNamespace(mkstemp=functools.partial(tempfile.mkstemp, dir=tmp_path))
    monkeypatch.setattr("geartrain.cli.verbs.tempfile", here)

    def command(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["geartrain", *arguments])
        with pytest.raises(SystemExit) as ended:
            main()
        said = capsys.readouterr()
        assert isinstance(ended.value.code, int)
        return ended.value.code, said.out, said.err

    return command


def broken(each: Any, error: BaseException) -> Callable[..., None]:
    @functools.wraps(each.callback)
    def fail(**_: object) -> None:
        raise error

    return fail


@pytest.mark.parametrize(("verb", "each"), list(runs()), ids=[name for name, _ in runs()])
def test_a_fault_of_any_command_is_exit_3_one_line_and_a_file_to_send(
    run: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, verb: str, each: Any
) -> None:
    monkeypatch.setattr(each, "callback", broken(each, RuntimeError("a \x1b[31mwheel\nfell off")))
    code, out, err = run(*requested(verb))
    assert code == 3, err
    assert out == ""
    assert len(err.splitlines()) == 1, err
    assert err.startswith("internal error: RuntimeError: a \\x1b[31mwheel; this is an error in geartrain: attach")
    (kept,) = tmp_path.glob("geartrain-error-*.txt")
    assert str(kept) in err
    text = kept.read_text(encoding="utf-8")
    assert "Traceback" in text
    assert "fell off" in text
    assert "Python" in text


@pytest.mark.parametrize(
    "error", [ValueError("x"), ZeroDivisionError(), IndexError(3), KeyError("a"), RecursionError(), OSError("lost")]
)
def test_whatever_python_raises_is_no_verdict(
    run: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    each = dict(runs())["solve"]
    monkeypatch.setattr(each, "callback", broken(each, error))
    code, _, err = run("solve", "worm")
    assert code == 3
    assert type(error).__name__ in err
    assert "Traceback" not in err
    monkeypatch.setenv("GEARTRAIN_TRACEBACK", "1")
    assert "Traceback" in run("solve", "worm")[2]


def test_a_fault_is_told_where_no_file_can_be_made(
    run: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    each = dict(runs())["solve"]
    monkeypatch.setattr(each, "callback", broken(each, RuntimeError("x")))
    nowhere = SimpleNamespace(mkstemp=functools.partial(tempfile.mkstemp, dir=tmp_path / "nowhere"))
    monkeypatch.setattr("geartrain.cli.verbs.tempfile", nowhere)
    code, _, err = run("solve", "worm")
    assert code == 3
    assert "GEARTRAIN_TRACEBACK=1" in err
    assert len(err.splitlines()) == 1


def test_a_fault_deep_inside_is_one_too(
    run: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("deep")

    monkeypatch.setattr("geartrain.analysis.gear_train.GearTrain.solve", fail)
    monkeypatch.setattr("geartrain.analysis.gear_train.load", fail)
    for verb in ("solve", "report", "check", "compare", "torques", "inspect equations", "inspect graph"):
        assert run(*verb.split(), "worm")[0] == 3, verb


def test_an_interrupt_is_exit_130_without_a_traceback(
    run: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    each = dict(runs())["solve"]
    monkeypatch.setattr(each, "callback", broken(each, KeyboardInterrupt()))
    assert run("solve", "worm") == (130, "", "stopped\n")


def test_an_interrupt_while_python_evaluates_a_string_is_exit_130(tmp_path: Path) -> None:
    lines = ("import sys", "from geartrain.cli.verbs import guarded")
    ending = "sys.exit(guarded(lambda: exec('raise KeyboardInterrupt')))"
    (tmp_path / "interrupted.py").write_text("\n".join((*lines, ending)))
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), str(ROOT)])}
    assert subprocess.run([sys.executable, "-m", "interrupted"], env=paths, check=False, timeout=120).returncode == 130


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process")
def test_ctrl_c_in_the_middle_is_exit_130() -> None:
    command = [sys.executable, "-m", "geartrain", "motion", "moon-triangular", "--samples", "9000000", "-o", "-.csv"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        next_line(process.stdout)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=120)
    assert process.returncode == 130, err
    assert "Traceback" not in err


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to another process")
def test_tests_can_interrupt_commands_though_the_shell_that_starts_them_ignores_interrupts() -> None:
    """As a shell does for its background jobs, and `nohup`; conftest.py sets the handler that commands inherit."""
    code = (
        "import conftest, signal, subprocess, sys;"
        "child = subprocess.Popen([sys.executable, '-c', 'print(1, flush=True); input()'], stdin=-1, stdout=-1);"
        "child.stdout.readline(); child.send_signal(signal.SIGINT); print(child.wait(60))"
    )
    shell = f"trap '' INT; exec {shlex.quote(sys.executable)} -W ignore -c {shlex.quote(code)}"
    paths = {**os.environ, "PYTHONPATH": os.pathsep.join([str(TESTS), str(ROOT)])}
    done = subprocess.run(["sh", "-c", shell], env=paths, capture_output=True, text=True, check=False, timeout=120)
    assert done.stdout == f"{-signal.SIGINT}\n", done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="pipes close otherwise")
@pytest.mark.parametrize("arguments", [("list",), ("--help",), ("solve", "-h"), ("report", "freeth-2021", "--json")])
def test_a_reader_that_goes_is_exit_141_in_silence(arguments: tuple[str, ...]) -> None:
    ours, theirs = os.pipe()
    os.close(ours)
    command = [sys.executable, "-m", "geartrain", *arguments]
    done = subprocess.run(command, stdout=theirs, stderr=subprocess.PIPE, text=True, check=False)
    os.close(theirs)
    assert (done.returncode, done.stderr) == (141, "")


def test_all_exit_codes_are_told_where_exit_codes_are_told() -> None:
    assert issubclass(app.info.cls, EndingGroup)  # type: ignore[arg-type]
    for page in ("docs/commands.md", "docs/json.md"):
        codes = set(re.findall(r"^\| (\d+) \|", (ROOT / page).read_text(encoding="utf-8"), re.M))
        assert {"0", "1", "2", "3", "130", "141"} <= codes, page
    assert "exit with code 3" in (ROOT / "README.md").read_text(encoding="utf-8")
    assert all(code in str(app.info.epilog) for code in ("0 ", "1 ", "2 ", "3 ", "130 ", "141 "))


# ------------------------------------------------------------------------------------------------------------- resumed

CUT = ("montecarlo", "moon-triangular", "--of", "moon", "--cutting", "pitch_deviation=2 %")


@pytest.mark.parametrize("question", [(*CUT, "--trials", "2"), DOUBT])
def test_a_run_with_nothing_to_resume_says_that_it_begins_anew(
    run: Callable[..., tuple[int, str, str]], tmp_path: Path, question: tuple[str, ...]
) -> None:
    (tmp_path / "doubt.yaml").write_text(
        "links: {frame: {}, a: {wheels: {x: 20}}, b: {wheels: {z: 40}}}\n"
        "revolutes: [{pair: [frame, a], axis: A}, {pair: [frame, b], axis: B}]\n"
        "gears: [{pair: [x, z]}]\ninputs: {a: 1}\noutputs: {b: {targets: [{speed: -1/2, tolerance: 10 %}]}}\n",
        encoding="utf-8",
    )
    words = ["doubt.yaml" if word == "{doubt}" else word for word in question]
    code, _, err = run(*words, "--resume")
    assert code == 0
    assert "nothing to resume" in err
    assert "starting a new run" in err
    assert "nothing to resume" not in run(*words)[2]


def test_a_journal_of_another_question_is_refused_and_kept(
    run: Callable[..., tuple[int, str, str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from geartrain.numerics import Journal

    finish = Journal.finish
    monkeypatch.setattr(Journal, "finish", Journal.close)
    assert run(*CUT, "--trials", "2", "--seed", "7")[0] == 0
    monkeypatch.setattr(Journal, "finish", finish)
    (kept,) = tmp_path.glob("montecarlo-*.partial.jsonl")
    text = kept.read_bytes()
    code, out, err = run(*CUT, "--trials", "2", "--seed", "8", "--resume")
    assert (code, out) == (2, "")
    assert "the journal belongs to another run" in err
    assert "seed is 7 in the journal and 8 in this run" in err
    assert kept.name in err
    assert kept.read_bytes() == text
    assert run(*CUT, "--trials", "2", "--seed", "8")[0] == 0, "begun anew without --resume"
    assert run(*CUT, "--trials", "2", "--seed", "7", "--resume")[0] == 0
    assert not kept.exists()


def test_a_table_of_motion_begins_anew_where_nothing_can_be_resumed(run: Callable[..., tuple[int, str, str]]) -> None:
    code, _, err = run("motion", "moon-triangular", "--turns", "1", "--samples", "64", "--resume", "-o", "x.csv")
    assert (code, "nothing to resume" in err) == (0, True)
