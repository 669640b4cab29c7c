"""What `geartrain reconstruct` tells beyond counts: facts, assumptions, why nothing fits, files and a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.cli.common import Sink, as_json, tell
from geartrain.cli.long_runs import RunOptions, close_journal, long_run, progress
from geartrain.numerics.decimal_text import plural

if TYPE_CHECKING:
    from geartrain.numerics.work import Execution
    from geartrain.report.reconstruction_report import ReconstructionReport
    from geartrain.synthesis.reconstruction.candidate_findings import CandidateFindings
    from geartrain.synthesis.reconstruction.dropped_facts import ChangedCount
    from geartrain.synthesis.reconstruction.expected_cost import ExpectedCost
    from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
    from geartrain.synthesis.reconstruction.reconstruction_result import Candidate, Reconstructions
    from geartrain.train import Train

FAMILY = "family.json"
MOST_TURNING = 200
_LARGE = 15  # decimal logarithm of choices of counts above which their number is printed first
_STEPS = 1000
"""Of a progress bar."""
_PATIENCE = 2.0  # seconds before a progress bar is shown


def tell_question(problem: ReconstructionProblem, options: RunOptions) -> ExpectedCost:
    """Say what is asked, and what it will cost, before it is looked for."""
    from geartrain.synthesis.reconstruction.asked_question import AskedQuestion
    from geartrain.synthesis.reconstruction.expected_cost import count_choices, expect_cost, rough

    tell(f"asked: {AskedQuestion.of(problem)}")
    if (size := count_choices(problem)) >= _LARGE:
        tell(f"a large search: the counts of the added wheels have up to 1e{size:.0f} choices")
    expected = expect_cost(problem)
    if expected.placements is None:
        tell(f"possible paths: {', '.join(f'{paths} to {dial}' for dial, paths in expected.paths.items())}")
    else:
        ways = plural(expected.placements, "way")
        tell(f"{ways} to share out {plural(problem.additions.wheels, 'added wheel')} among the paths to dials")
    if seconds := rough(expected.whole):
        shared = f", shared by {options.workers}" if options.workers not in (None, 1) else ""
        timed = f"one part in {expected.parts} of the search was timed"
        tell(f"expected: about {_lasting(seconds)} in one process{shared}; {timed}")
    return expected


def weighted(execution: Execution, problem: ReconstructionProblem, expected: ExpectedCost) -> Execution:
    """The same, which tells what is done as a share of the time that all is expected to take."""
    from geartrain.synthesis.reconstruction.expected_cost import done_shares

    shares, said = done_shares(problem, expected), execution.tell

    def reach(done: int, _: int) -> None:
        if said is not None:
            said(round(_STEPS * shares[done]), _STEPS)

    return replace(execution, tell=reach)


def _lasting(seconds: float) -> str:
    """A rough time in the unit that fits."""
    for size, unit in ((86400, "days"), (3600, "hours"), (60, "minutes")):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} seconds"


def look_into(
    evidence: Train,
    problem: ReconstructionProblem,
    found: Reconstructions,
    options: RunOptions,
    dropped: tuple[ChangedCount, ...] = (),
    counts_only: bool = False,
) -> CandidateFindings:
    """What is told of the candidates, or why there are none; with `counts_only` no more than assumptions."""
    from geartrain.synthesis.reconstruction.candidate_findings import CandidateFindings, find_facts
    from geartrain.synthesis.reconstruction.missing_explanation import explain_missing

    if found.complete and not counts_only and not any(count.mechanisms for count in found.counts):
        missing = None
        with stoppable("why nothing fits", options) as execution:
            missing = explain_missing(problem, execution)
        return CandidateFindings(assumptions=dropped, missing=missing)
    if counts_only:
        return CandidateFindings(assumptions=dropped)
    return find_facts(evidence, problem, found, dropped)


def drop_facts(
    problem: ReconstructionProblem, folder: Path | None, options: RunOptions
) -> tuple[tuple[ChangedCount, ...], bool]:
    """The counts without each hard fact, and whether all are told or none can be taken up.

    If that is stopped, those that were counted are told, and the others can be taken up.
    """
    from geartrain.synthesis.reconstruction.dropped_facts import changed_counts, without_each_fact
    from geartrain.synthesis.reconstruction.question_digest import question_digest

    changed, dropped = without_each_fact(problem), []
    asked = {"question": question_digest(problem), "without": [each.change for each in changed]}
    with long_run("reconstruct_assumptions", asked, folder, options) as given:
        try:
            for each in changed_counts(changed, given):
                dropped.append(each)
        except KeyboardInterrupt:
            tell(f"{len(dropped)} of {plural(len(changed), 'assumption')} counted; the rest is left out")
        cut = len(dropped) < len(changed)
        kept = given.journal is not None and bool(len(given.journal))
        close_journal(given.journal, cut)
    return tuple(dropped), not (cut and kept)


@contextmanager
def stoppable(what: str, options: RunOptions) -> Iterator[Execution]:
    """How an additional question is worked on, with a progress bar; if it is interrupted, it is left out."""
    from geartrain.numerics.work import Execution

    try:
        with options.executor(what) as executor, progress(what, patience=_PATIENCE) as bar:
            yield Execution(executor, tell=bar.reach)
    except KeyboardInterrupt:
        tell(f"stopped: {what} is left out")


def family_text(report: ReconstructionReport, problem: ReconstructionProblem) -> str:
    """The family tree as JSON, with what was asked."""
    from geartrain.synthesis.reconstruction.question_digest import question_digest

    asked = {"name": report.name, "question": question_digest(problem), "counts": report.counts}
    return as_json({**asked, "family": report.findings.family}) + "\n"


def write_page(to: Sink, report: ReconstructionReport, evidence: Train, turning: Sequence[Candidate]) -> None:
    """The page, in which so many of the candidates turn."""
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.report.html_page import to_html
    from geartrain.report.reconstruction_report import describe_reconstruction
    from geartrain.scene import build_scene
    from geartrain.synthesis.reconstruction.candidate_train import candidate_train
    from geartrain.viewer import page

    with progress("scenes", len(turning), patience=_PATIENCE) as bar:
        scenes = []
        for rank, candidate in enumerate(turning, 1):
            scenes.append(build_scene(GearTrain(candidate_train(evidence, candidate.arbor, f"rank {rank}"))))
            bar.advance()
    viewer = page(scenes) if scenes else ""
    data = to_html([describe_reconstruction(report, viewer, len(scenes))]).encode("utf-8")
    to.write(data, f": {plural(len(scenes), 'train')} turning, {len(data) / 1000:,.0f} kB")
