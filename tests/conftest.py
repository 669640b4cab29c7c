"""Shared parts of all tests: the marker `slow`, Hypothesis without time limits, and fixtures that load declarations."""

from __future__ import annotations

import gc
import os
import signal
from collections import Counter
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from textwrap import dedent

import pytest
from hypothesis import HealthCheck, settings

from geartrain import GearTrain, GearTrainError, load

# none of the above loads numpy; matrices here are small, and threads waiting for each other cost four times their work
for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# pytest keeps a few hundred thousand objects: to look through them at every 700 new ones takes a sixth of the time
gc.set_threshold(100_000, 50, 100)

PASSED = "geartrain/passed"  # key of pytest's cache
SAMPLES = {"--trains": (300, 1000), "--mutants": (150, 500)}  # random samples without and with --slow

# a shell that starts tests in the background has interrupts ignored, and so would commands that tests interrupt
signal.signal(signal.SIGINT, signal.default_int_handler)

# the same examples in every run, so that a change is judged by itself; with --slow new ones, and more
_CLOCKLESS = [HealthCheck.too_slow, HealthCheck.data_too_large]
settings.register_profile("hunt", deadline=None, max_examples=60, suppress_health_check=_CLOCKLESS)
settings.register_profile("more", settings.get_profile("hunt"), derandomize=True)
settings.register_profile("transmissions", settings.get_profile("more"), max_examples=30)
settings.load_profile("transmissions")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--long", action="store_true", help="also run the tests marked long")
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")
    parser.addoption("--rest", action="store_true", help="leave out what passed in the last run without --rest")
    parser.addoption("--trains", type=int, help="number of random trains for each law (300; with --slow 1000)")
    parser.addoption("--first-train", type=int, default=0, help="the seed of the first random train (0)")
    parser.addoption("--mutants", type=int, help="number of corrupted declarations (150; with --slow 500)")
    parser.addoption("--first-mutant", type=int, default=0, help="the seed of the first spoilt declaration (0)")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: more than a few seconds; runs with --slow only")
    config.addinivalue_line("markers", "long: minutes; runs with --long only, not in .ci/run")
    config.addinivalue_line("markers", "needs(*modules): skipped where one of these cannot be imported")
    if config.getoption("--slow"):
        settings.load_profile("more" if config.getoption("--rest") else "hunt")
    if os.environ.get("GEARTRAIN_REQUIRE_EXTRAS"):  # all of `.[ci]` is installed: what cannot be imported is a failure
        pytest.importorskip = lambda name, *_, **__: import_module(name)
    if getattr(config, "cache", None) and not config.getoption("--rest") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Passed(config))


class Passed:
    """Plugin that records in pytest's cache which tests passed, for `--rest`."""

    def __init__(self, config: pytest.Config) -> None:
        self.config, self.names = config, set[str]()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.when == "call" and report.passed:
            self.names.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        assert self.config.cache is not None
        self.config.cache.set(PASSED, sorted(self.names))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print how many tests were skipped, by reason."""
    skipped = terminalreporter.stats.get("skipped", [])
    reasons = Counter(str(report.longrepr[2]).removeprefix("Skipped: ") for report in skipped)
    for reason, count in reasons.most_common():
        terminalreporter.write_line(f"{count} skipped: {reason}")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object | None:
    """Let each worker run whole files, so that data shared by the tests of a file are computed once."""
    if config.getoption("dist") != "load":
        return None
    from xdist.scheduler import LoadFileScheduling

    return LoadFileScheduling(config, log)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests marked slow unless `--slow` is given, and tests that passed before if `--rest` is given."""
    slow, rest = config.getoption("--slow"), config.getoption("--rest")
    passed = set(config.cache.get(PASSED, ())) if rest and config.cache else set()
    done = [item for item in items if item.nodeid in passed and not (slow and has_more_samples(item))]
    left = [*done, *(item for item in items if "slow" in item.keywords and not slow)]
    left += [item for item in items if "long" in item.keywords and not config.getoption("--long")]
    if left:
        config.hook.pytest_deselected(items=left)
        out = {item.nodeid for item in left}
        items[:] = [item for item in items if item.nodeid not in out]
    for item in items:
        if "slow" in item.keywords or "long" in item.keywords:
            item.add_marker(pytest.mark.timeout(3600))


def has_more_samples(item: pytest.Item) -> bool:
    """Return True if a test uses more random samples with `--slow`."""
    drawn = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
    return drawn or not {"seeds", "mutant_seeds"}.isdisjoint(getattr(item, "fixturenames", ()))


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip a test that needs a library which is not installed."""
    for mark in item.iter_markers("needs"):
        for module in mark.args:
            pytest.importorskip(module, reason=f"{module} is not installed")


@pytest.fixture(scope="session", autouse=True)
def one_core() -> Iterator[None]:
    """Prevent commands that run in the test process from starting other processes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("geartrain.numerics.work.task_runner.cores", lambda: 1)
        yield


@pytest.fixture
def seeds(request: pytest.FixtureRequest) -> range:
    """Return the seeds of the random trains, from `--first-train` on."""
    return _seeds(request.config, "--first-train", "--trains")


@pytest.fixture
def mutant_seeds(request: pytest.FixtureRequest) -> range:
    """Return the seeds of the corrupted declarations, from `--first-mutant` on."""
    return _seeds(request.config, "--first-mutant", "--mutants")


def _seeds(config: pytest.Config, first: str, number: str) -> range:
    """Return seeds from the value of one option on; another option gives their number, by default that of `SAMPLES`.

    With `--slow --rest`, only the seeds are returned that a run without `--slow` leaves out.
    """
    start, slow = config.getoption(first), config.getoption("--slow")
    few, many = SAMPLES[number]
    stop = start + (config.getoption(number) or (many if slow else few))
    ran = few if slow and config.getoption("--rest") else 0
    return range(min(start + ran, stop), stop)


@pytest.fixture
def train_file(tmp_path: Path) -> Callable[..., Path]:
    """Return a function that writes YAML to a new file and returns its path."""

    def write(text: str, name: str = "train.yaml") -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(dedent(text).lstrip("\n"), encoding="utf-8")
        return path

    return write


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder, which is the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def refused(train_file: Callable[..., Path]) -> Callable[..., GearTrainError]:
    """Return a function that loads invalid YAML and requires place, what and fix of each problem."""

    def refuse(text: str, *said: str, line: int | None = None, name: str = "train.yaml") -> GearTrainError:
        path = train_file(text, name)
        with pytest.raises(GearTrainError) as caught:
            load(path)
        message = str(caught.value)
        for problem in caught.value.problems:
            assert problem.what, "a problem says what is wrong"
            assert problem.fix, f"a problem says what to do: {problem.what}"
            assert problem.place.startswith(str(path)), f"a problem has a place in its file: {problem}"
        for words in said:
            assert words in message, f"{words!r} is not said in: {message}"
        if line is not None:
            places = [problem.place for problem in caught.value.problems]
            assert f"{path}:{line}" in places, f"line {line} is not among {places}: {message}"
        return caught.value

    return refuse


@pytest.fixture
def accepted(train_file: Callable[..., Path]) -> Callable[[str], GearTrain]:
    """Return a function that loads YAML from a file."""
    return lambda text: load(train_file(text))
