"""`--workers`, a number or a scheduler: the same bytes whoever works, and one line on standard error says who does."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from clusters import PATIENCE, small_cluster
from commands import call
from test_montecarlo_command import PAIR as ONE_ERROR

Write = Callable[..., Path]

PAIR = ONE_ERROR.replace("normal: 2 %}}", "normal: 2 %}, tip: {normal: 3 %}}")
MONTE_CARLO = ("--trials", "400", "--vary", "clearance_factor=1.01:1.03:2", "--sobol", "--json")


def ended(*words: object) -> tuple[str, str]:
    """What a command prints, and what it says on standard error."""
    command = [sys.executable, "-m", "geartrain", *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=5 * PATIENCE)
    return done.stdout, done.stderr


def test_any_number_of_workers_prints_the_same_bytes(train_file: Write) -> None:
    requested = ("montecarlo", train_file(PAIR), *MONTE_CARLO)
    one, (many, said) = call(*requested, "--workers", 1), ended(*requested, "--workers", 2)
    assert one.stdout == many != ""
    assert one.stderr == ""
    assert re.fullmatch(r"montecarlo: \d+ tasks on 2 worker processes\n", said)


def test_a_small_run_starts_no_processes(train_file: Write) -> None:
    out, said = ended("montecarlo", train_file(PAIR), "--trials", 32, "--json")
    assert out
    assert said == ""


def test_a_cluster_prints_the_bytes_of_a_local_run(train_file: Write) -> None:
    """tests/numerics/test_parallel.py kills its workers."""
    pytest.importorskip("distributed")
    train = train_file(PAIR)
    local = call("montecarlo", train, *MONTE_CARLO, "--workers", 1).stdout
    with small_cluster() as cluster:
        out, said = ended("montecarlo", train, *MONTE_CARLO, "--workers", cluster.scheduler_address)
    assert out == local != ""
    assert re.fullmatch(r"montecarlo: \d+ tasks on 2 worker processes\n", said)
