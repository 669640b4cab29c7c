"""Command `geartrain reconstruct`: search for all trains that explain surviving wheels and pointers."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from geartrain.cli.common import (
    GOOD,
    INTERRUPTED,
    VERDICT,
    Force,
    Json,
    Names,
    Out,
    Sink,
    as_json,
    check_distinct_outputs,
    give,
    option_error,
    sink,
    tell,
)
from geartrain.cli.long_runs import Resume, RunOptions, Workers, close_journal, long_run, progress
from geartrain.cli.option_values import MOST_COUNT
from geartrain.numerics.exact import plural
from geartrain.numerics.work import Execution, Journal
from geartrain.search.reconstruct.reconstruction import ReconstructionRun
from geartrain.search.reconstruct.reconstruction_problem import RequestedQuestion, question_digest
from geartrain.search.reconstruct.search_tasks import log_choices

if TYPE_CHECKING:
    from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer
    from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem

Evidence = Annotated[
    str,
    typer.Argument(
        help="YAML declaration with `reconstruct`, or the name of shipped evidence (`geartrain list --evidence`); "
        "with --lost, a train.",
        metavar="FILE",
    ),
]


_EVIDENCE = "evidence.yaml"
_FAMILY = "family.json"
MOST_TURNING = 200


def run(
    evidence: Evidence,
    lost: Annotated[
        Names, typer.Option("--lost", metavar="ARBOR", help="Treat this arbor of a train as lost; may be repeated.")
    ] = None,
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            help="With --lost: link at which the part to be reconstructed begins; default: start of the first part "
            "that contains the lost arbors.",
        ),
    ] = None,
    seen: Annotated[
        bool,
        typer.Option(
            "--seen",
            help="With --lost: keep the observed meshes of the surviving wheels, and add no more arbors than "
            "--lost specifies.",
        ),
    ] = False,
    most: Annotated[
        int | None,
        typer.Option(
            "--max-added",
            "-k",
            min=0,
            max=1000,
            help="Maximum number of added wheels; default: the number in the evidence.",
        ),
    ] = None,
    count: Annotated[bool, typer.Option("--count", help="Count the trains without listing them.")] = False,
    best: Annotated[int, typer.Option("--best", min=0, max=MOST_COUNT, help="Number of trains to list.")] = 20,
    every: Annotated[bool, typer.Option("--all", help="List all trains, regardless of --best.")] = False,
    idlers: Annotated[
        bool, typer.Option("--idlers", help="Allow idlers: driven wheels that drive other wheels.")
    ] = False,
    folder: Annotated[
        Path | None,
        typer.Option("--to", metavar="FOLDER", help="Write a declaration of each listed train to this folder."),
    ] = None,
    page: Annotated[
        Path | None,
        typer.Option("--page", help="Write an HTML page with the family tree and animated trains to this file."),
    ] = None,
    turning: Annotated[
        int, typer.Option("--animated", min=1, max=MOST_TURNING, help="Number of animated trains on the page.")
    ] = 12,
    prior: Annotated[
        Literal["solution", "class"],
        typer.Option(
            "--prior",
            help="Assign equal prior weights to trains (solution), or to classes of trains with equal ratios (class).",
        ),
    ] = "solution",
    assumptions: Annotated[
        bool,
        typer.Option(
            "--assumptions",
            help="Count the trains again with each hard constraint of the evidence dropped in turn (one search per "
            "constraint).",
        ),
    ] = False,
    rank: Annotated[
        Names,
        typer.Option(
            "--rank",
            help="Report the rank of this train (a file, or the name of a shipped train) among the trains found; may "
            "be repeated.",
            metavar="TRAIN",
        ),
    ] = None,
    same: Annotated[
        Names,
        typer.Option(
            "--same",
            help="Match a wheel or output of the ranked train (--rank) to one in the evidence, such as E4=e3; may be "
            "repeated.",
            metavar="ITS=OURS",
        ),
    ] = None,
    workers: Workers = None,
    resume: Resume = False,
    out: Out = None,
    json: Json = False,
    force: Force = False,
) -> None:
    """Find all trains that explain surviving wheels and pointers. The exit code is 0 if there is such a train, and 1 if
    there is none.

    Example: `geartrain reconstruct metonic-l-m --best 5`.
    """
    from geartrain.numerics.files import check_folder
    from geartrain.search.reconstruct.reconstruction import ReconstructionRequest, reconstruct
    from geartrain.search.reconstruct.reconstruction_report import describe_reconstruction
    from geartrain.train.declaration_files import read_declaration, read_evidence

    if not lost and (seen or source is not None):
        why = "the option applies only to a train of which arbors are treated as lost"
        raise option_error("--seen" if seen else "--from", "--lost is not given", "give --lost ARBOR too", why)
    if count and folder is not None:
        raise option_error("--to", "--count lists no trains to write", "omit --to or --count")
    if count and page is not None:
        raise option_error("--page", "--count lists no trains to show", "omit --page or --count")
    if same and not rank:
        why = "the option identifies parts of a ranked train with parts of the evidence"
        raise option_error("--same", "--rank is not given", "give --rank too, such as --rank freeth-2008", why)
    to, turning_page = sink(out, force, (".md", ".html", ".json")), sink(page, force, (".html",), "--page")
    check_distinct_outputs(to, turning_page)
    if folder is not None:
        check_folder(folder, [_file(1)], force)
    request = ReconstructionRequest(
        read_declaration(evidence) if lost else read_evidence(evidence),
        lost=tuple(lost or ()),
        source=source,
        seen=seen,
        wheels=most,
        idlers=idlers,
        best=None if every else best,
        counts_only=count,
        prior_of=prior,
        assumptions=assumptions,
        known=tuple(map(read_declaration, rank or ())),
        same=dict(map(_name_pair, same or ())),
    )
    found = reconstruct(request, CommandRun(folder, RunOptions(workers, resume)))
    if folder is not None and found.candidates:
        _write(found, folder, force, with_evidence=bool(lost))
    if page is not None:
        write_page(turning_page, found, turning)
    give(to, json, lambda: found, lambda: [describe_reconstruction(found)])
    if not found.complete:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(GOOD if found.total else VERDICT)


def _name_pair(text: str) -> tuple[str, str]:
    """Parse a pair of names such as `E4=e3`: the name in a known train and the name in the evidence."""
    own, _, called = map(str.strip, text.partition("="))
    if not own or not called:
        raise option_error("--same", f"'{text}' is not a pair of names", "write it as ITS=OURS, such as E4=e3")
    return own, called


def _write(found: ReconstructionAnswer, folder: Path, force: bool, with_evidence: bool) -> None:
    """Write a declaration of each listed candidate, the family tree and, if `with_evidence` is True, the evidence."""
    from geartrain.numerics.files import check_folder, write_folder
    from geartrain.search.reconstruct.train_construction import candidate_text
    from geartrain.train.declaration_files import write_declaration

    evidence = found.evidence
    assert evidence is not None
    about = {"name": found.name, "question": question_digest(found.problem), "counts": found.counts}
    extra = {_FAMILY: as_json({**about, "family": found.findings.family}) + "\n"}
    if with_evidence:
        extra[_EVIDENCE] = write_declaration(evidence)

    def files() -> Iterator[tuple[str, bytes]]:
        for rank, candidate in enumerate(found.candidates, 1):
            name = f"{evidence.name}-{_file(rank).removesuffix('.yaml')}"
            yield _file(rank), candidate_text(evidence, candidate.arbor, name).encode("utf-8")
        yield from ((file, text.encode("utf-8")) for file, text in extra.items())

    check_folder(folder, [*(_file(rank) for rank in range(1, len(found.candidates) + 1)), *extra], force)
    tell(f"wrote {plural(write_folder(folder, files(), force), 'file')} to {folder}")


def _file(rank: int) -> str:
    return f"rank-{rank:04}.yaml"


_LARGE = 15  # decimal logarithm of the number of choices of tooth counts above which it is printed
_PATIENCE = 2.0  # seconds before a progress bar is shown


class CommandRun(ReconstructionRun):
    """Execution of a reconstruction with progress bars on standard error and journals in a folder. Ctrl-C interrupts
    only the current stage.
    """

    def __init__(self, folder: Path | None, options: RunOptions) -> None:
        self._folder, self._options = folder, options
        self._journal: Journal | None = None

    def begin(self, problem: ReconstructionProblem) -> None:
        """Print the size of the problem."""
        tell(f"problem: {RequestedQuestion.of(problem)}")
        if (size := log_choices(problem)) >= _LARGE:
            tell(f"a large search: the counts of the added wheels have up to 1e{size:.0f} combinations")

    @contextmanager
    def search(self, problem: ReconstructionProblem) -> Iterator[Execution]:
        """Yield an executor that writes a journal. The method `searched` closes the journal."""
        # tasks do not depend on the listing or on the unit of the prior
        requested = {"question": question_digest(problem)}
        with long_run("reconstruct", requested, self._folder, self._options) as given:
            self._journal = given.journal
            yield given

    def searched(self, complete: bool) -> None:
        """Remove the journal if the search is complete, or report how to resume the search if it is not."""
        close_journal(self._journal, not complete)

    @contextmanager
    def part(self, what: str) -> Iterator[Execution]:
        """Yield an executor with a progress bar for the part of a reconstruction with the name `what`. After an
        interruption, results of this part that are not yet computed are missing in the answer.
        """
        try:
            with self._options.executor(what) as executor, progress(what, patience=_PATIENCE) as bar:
                yield Execution(executor, tell=bar.reach)
        except KeyboardInterrupt:
            tell(f"interrupted: the rest of the {what} is omitted")


def write_page(to: Sink, found: ReconstructionAnswer, turning: int) -> None:
    """Write the HTML page of the reconstruction, in which the first `turning` candidates are animated."""
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
