"""`--workers` and `--workers`: the same bytes whoever works, and one line on standard error that says who does."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from clusters import PATIENCE, alive, small_cluster, until
from commands import call
from dynamics.test_uncounted_losses import PIN
from test_montecarlo_command import PAIR as ONE_ERROR

Write = Callable[..., Path]

PAIR = ONE_ERROR.replace("normal: 2 %}}", "normal: 2 %}, tip: {normal: 3 %}}")
SLIDER = PIN.replace("friction: 0.3", "friction: {sliding: 0.3, deviation: 0.05}")
MONTE_CARLO = ("--trials", "400", "--vary", "clearance_factor=1.01:1.03:2", "--sobol", "--json")


def command(*words: object) -> list[str]:
    return [sys.executable, "-m", "geartrain", *map(str, words)]


def ended(*words: object) -> tuple[str, str]:
    """What a command prints, and what it says on standard error."""
    done = subprocess.run(command(*words), capture_output=True, text=True, check=True, timeout=5 * PATIENCE)
    return done.stdout, done.stderr


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (PAIR, ("montecarlo", *MONTE_CARLO)),
        (SLIDER, ("torques", "--turns", "1", "--samples", "50", "--trials", "40", "--json")),
    ],
    ids=["montecarlo", "torques"],
)
@pytest.mark.parametrize("count", [2, pytest.param(8, marks=pytest.mark.slow)])
def test_any_number_of_workers_prints_the_same_bytes(
    train_file: Write, text: str, words: tuple[str, ...], count: int
) -> None:
    verb, *options = words
    requested = (verb, train_file(text), *options)
    (one, quiet), (many, said) = (ended(*requested, "--workers", workers) for workers in (1, count))
    assert one == many != ""
    assert quiet == ""
    assert re.fullmatch(rf"{verb}: \d+ tasks on {count} worker processes\n", said)


def test_a_small_run_starts_no_processes(train_file: Write) -> None:
    out, said = ended("montecarlo", train_file(PAIR), "--trials", 32, "--json")
    assert out
    assert said == ""


def test_a_cluster_prints_the_bytes_of_a_local_run_though_a_worker_is_killed(train_file: Write, tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    train = train_file(PAIR)
    local, _ = ended("montecarlo", train, *MONTE_CARLO, "--workers", 1)
    with small_cluster() as cluster:
        requested = command("montecarlo", train, *MONTE_CARLO, "--workers", cluster.scheduler_address)
        victim = next(iter(cluster.workers.values())).pid
        running = subprocess.Popen(requested, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path)
        until(lambda: any(tmp_path.glob("*.partial.jsonl")), "the run to begin")
        os.kill(victim, signal.SIGKILL)
        out, said = running.communicate(timeout=5 * PATIENCE)
        until(lambda: not alive(victim), "the worker to die")
    assert (running.returncode, out) == (0, local)
    assert re.fullmatch(r"montecarlo: \d+ tasks on 2 worker processes\n", said)
    assert not list(tmp_path.glob("*.partial.jsonl"))


@pytest.mark.parametrize("workers", ["0", "x", "2.5"])
def test_a_number_of_workers_is_a_positive_integer(train_file: Write, workers: str) -> None:
    done = call("montecarlo", train_file(PAIR), "--workers", workers)
    assert done.exit_code == 2
    assert "error: --workers: " in done.stderr
