"""Execution of `geartrain reconstruct` with progress bars, journals and interruptions, and its HTML page."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.cli.common import Sink, tell
from geartrain.cli.long_runs import RunOptions, close_journal, long_run, progress
from geartrain.numerics.exact import plural
from geartrain.numerics.work import Execution, Journal
from geartrain.search.reconstruct.reconstruction import ReconstructionRun
from geartrain.search.reconstruct.reconstruction_problem import RequestedQuestion, question_digest
from geartrain.search.reconstruct.search_tasks import count_choices

if TYPE_CHECKING:
    from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer
    from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem

_LARGE = 15  # decimal logarithm of the number of choices of tooth counts above which it is printed
_PATIENCE = 2.0  # seconds before a progress bar is shown


class CommandRun(ReconstructionRun):
    """Execution with progress bars on standard error and journals in a folder. Ctrl-C interrupts one stage at a
    time.
    """

    def __init__(self, folder: Path | None, options: RunOptions) -> None:
        self._folder, self._options = folder, options
        self._journal: Journal | None = None

    def begin(self, problem: ReconstructionProblem) -> None:
        """Print the size of the problem."""
        tell(f"problem: {RequestedQuestion.of(problem)}")
        if (size := count_choices(problem)) >= _LARGE:
            tell(f"a large search: the counts of the added wheels have up to 1e{size:.0f} combinations")

    @contextmanager
    def search(self, problem: ReconstructionProblem) -> Iterator[Execution]:
        """Yield an executor with a journal, which `searched` closes."""
        # tasks do not depend on the listing or on the unit of the prior
        requested = {"question": question_digest(problem)}
        with long_run("reconstruct", requested, self._folder, self._options) as given:
            self._journal = given.journal
            yield given

    def searched(self, complete: bool) -> None:
        """Remove the journal of a complete search, or report how to resume it."""
        close_journal(self._journal, not complete)

    @contextmanager
    def part(self, what: str) -> Iterator[Execution]:
        """Yield an executor with a progress bar for another part of the work. An interruption omits its rest from the
        answer.
        """
        try:
            with self._options.executor(what) as executor, progress(what, patience=_PATIENCE) as bar:
                yield Execution(executor, tell=bar.reach)
        except KeyboardInterrupt:
            tell(f"interrupted: the rest of the {what} is omitted")


def write_page(to: Sink, found: ReconstructionAnswer, turning: int) -> None:
    """Write the HTML page, in which the first `turning` candidates are animated."""
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.report.html_page import to_html
    from geartrain.scene import build_scene
    from geartrain.search.reconstruct.reconstruction_report import describe_reconstruction
    from geartrain.search.reconstruct.train_construction import candidate_train
    from geartrain.viewer import page

    assert found.evidence is not None
    with progress("scenes", min(turning, len(found.candidates)), patience=_PATIENCE) as bar:
        scenes = []
        for rank, candidate in enumerate(found.candidates[:turning], 1):
            scenes.append(build_scene(GearTrain(candidate_train(found.evidence, candidate.arbor, f"rank {rank}"))))
            bar.advance()
    viewer = page(scenes) if scenes else ""
    data = to_html([describe_reconstruction(found, viewer, len(scenes))]).encode("utf-8")
    to.write(data, f": {plural(len(scenes), 'train')} animated, {len(data) / 1000:,.0f} kB")
