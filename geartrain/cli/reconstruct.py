"""`geartrain reconstruct`: from what survives and what the pointers show to every train that explains it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
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
    Seed,
    check_distinct_outputs,
    give,
    sink,
    tell,
)
from geartrain.cli.long_runs import Dask, Resume, RunOptions, Workers, close_journal, long_run
from geartrain.cli.option_values import MOST_COUNT
from geartrain.cli.ranked_trains import known_trains, rank_trains
from geartrain.cli.reconstruction_findings import (
    FAMILY,
    MOST_TURNING,
    drop_facts,
    family_text,
    look_into,
    tell_question,
    weighted,
    write_page,
)
from geartrain.numerics.decimal_text import plural

if TYPE_CHECKING:
    from geartrain.report.reconstruction_report import RankedTrain
    from geartrain.synthesis.reconstruction.reconstruction_problem import Arbor
    from geartrain.synthesis.reconstruction.reconstruction_result import Candidate
    from geartrain.train import Train

Evidence = Annotated[
    str,
    typer.Argument(
        help="A YAML declaration with `reconstruct`, or the name of shipped evidence (`geartrain list --evidence`); "
        "with --without a train.",
        metavar="FILE",
    ),
]


_EVIDENCE = "evidence.yaml"
MOST_DRAWN = 100_000
"""Trains that are drawn at most."""
_ALL = 1_000_000
_LOOKED_AT = 2000
"""Candidates whose meshes and counts are compared, also where fewer are listed."""


def run(
    evidence: Evidence,
    without: Annotated[
        Names, typer.Option("--without", help="Ask of a train as if this arbor were lost; several may be.")
    ] = None,
    source: Annotated[
        str | None,
        typer.Option(
            "--from",
            help="With --without: of several parts of the train that with this link at its beginning; default the "
            "first that has the arbors.",
        ),
    ] = None,
    seen: Annotated[
        bool,
        typer.Option(
            "--seen",
            help="With --without: the meshes of wheels that survive were seen, and no more arbors are added than are "
            "lost.",
        ),
    ] = False,
    most: Annotated[
        int | None,
        typer.Option("-k", min=0, max=1000, help="The most wheels that may be added; default what the evidence says."),
    ] = None,
    count: Annotated[bool, typer.Option("--count", help="Count only, list nothing.")] = False,
    best: Annotated[int, typer.Option("--best", min=0, max=MOST_COUNT, help="How many trains are listed.")] = 20,
    every: Annotated[bool, typer.Option("--all", help="List all of them.")] = False,
    idlers: Annotated[bool, typer.Option("--idlers", help="A driven wheel may drive.")] = False,
    folder: Annotated[
        Path | None, typer.Option("--write", help="Write what is listed into this folder, a declaration a file.")
    ] = None,
    page: Annotated[
        Path | None, typer.Option("--page", help="Write a page of HTML with the family tree and the trains turning.")
    ] = None,
    turning: Annotated[
        int, typer.Option("--turning", min=1, max=MOST_TURNING, help="How many trains turn on the page.")
    ] = 12,
    per: Annotated[
        Literal["mechanism", "class"],
        typer.Option("--per", help="What has a weight of its own: every train, or every class of equal ratios."),
    ] = "mechanism",
    sample: Annotated[
        int,
        typer.Option("--sample", min=0, max=MOST_DRAWN, help="Draw so many trains, with the chance of their weight."),
    ] = 0,
    seed: Seed = 1,
    assumptions: Annotated[
        bool, typer.Option("--assumptions", help="Drop each hard fact in turn and count again; asks once for each.")
    ] = False,
    rank: Annotated[
        Names,
        typer.Option(
            "--rank", help="Say what this train costs here: a file or a shipped train; several may be.", metavar="TRAIN"
        ),
    ] = None,
    same: Annotated[
        Names,
        typer.Option(
            "--same",
            help="A wheel or output of a ranked train, and what that is here: E4=e3.",
            metavar="ITS=OURS",
        ),
    ] = None,
    workers: Workers = None,
    dask: Dask = None,
    resume: Resume = False,
    out: Out = None,
    json: Json = False,
    force: Force = False,
) -> None:
    """Find every train that explains surviving wheels and pointers; exit 0 if there is one, 1 if none."""
    from geartrain.numerics.files import check_folder
    from geartrain.report.reconstruction_report import ReconstructionReport, describe_reconstruction
    from geartrain.synthesis.reconstruction.drawn_candidates import draw_candidates
    from geartrain.synthesis.reconstruction.evidence_question import evidence_question
    from geartrain.synthesis.reconstruction.lost_arbors import rank_of
    from geartrain.synthesis.reconstruction.question_digest import question_digest
    from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions
    from geartrain.train.declaration_files import read_evidence, write_declaration

    if not without and (seen or source is not None):
        raise typer.BadParameter("it is said of a train without some arbors", param_hint="--seen" if seen else "--from")
    if count and folder is not None:
        raise typer.BadParameter("with --count there is nothing to write", param_hint="--write")
    if count and page is not None:
        raise typer.BadParameter("with --count there is nothing to show", param_hint="--page")
    to, turning_page = sink(out, force, (".md", ".html", ".json")), sink(page, force, (".html",), "--page")
    check_distinct_outputs(to, turning_page)
    declared, original = _of_train(evidence, without, source, seen) if without else (read_evidence(evidence), None)
    question = evidence_question(declared, most, idlers)
    ranked = known_trains(rank or (), same or (), question)
    if folder is not None:
        check_folder(folder, [_file(1)], force)
    listing = 0 if count else _ALL if every else max(best, _LOOKED_AT)
    # how much is listed, and per what, changes no task; but where none is, tasks may leave out skeletons
    asked = {"question": question_digest(question.problem), "listed": bool(listing)}
    options = RunOptions(workers, dask, resume)
    expected = tell_question(question.problem, options)
    with long_run("reconstruct", asked, folder, options) as given:
        found = find_reconstructions(question.problem, weighted(given, question.problem, expected), listing, per)
    dropped, told = drop_facts(question.problem, folder, options) if assumptions and found.complete else ((), True)
    if told:  # else this journal is taken up with the other
        close_journal(given.journal, not found.complete)
    listed = () if count else found.candidates if every else found.candidates[:best]
    drawn = draw_candidates(found, question.problem, tuple(declared.outputs), sample, seed) if sample else ()
    known = rank_trains(ranked, declared, question.problem, found, options)
    report = ReconstructionReport(
        declared.name,
        question.problem,
        found.counts,
        found.complete,
        question.unused,
        tuple(_ranked(declared, listed)),
        None if original is None else rank_of(original, found),
        look_into(declared, question.problem, found, options, dropped, counts_only=count),
        question.base,
        question.joined,
        expected,
        tuple(_ranked(declared, drawn)),
        known,
    )
    if folder is not None and listed:
        extra = {FAMILY: family_text(report, question.problem)}
        if without:
            extra[_EVIDENCE] = write_declaration(declared)
        _write(declared, listed, folder, force, extra)
    if page is not None:
        write_page(turning_page, report, declared, listed[:turning])
    give(to, json, lambda: report, lambda: [describe_reconstruction(report)])
    if not found.complete:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(GOOD if report.total else VERDICT)


def _of_train(file: str, lost: Sequence[str], source: str | None, seen: bool) -> tuple[Train, Arbor]:
    """Evidence of a train whose arbors are lost, and the train itself as a candidate."""
    from geartrain.synthesis.reconstruction.lost_arbors import lost_arbors, lost_evidence
    from geartrain.synthesis.reconstruction.train_parts import find_spur_tree
    from geartrain.train.declaration_files import read_declaration

    tree = find_spur_tree(read_declaration(file), lost, source)
    return lost_evidence(tree, lost, seen), tree.arbor(lost_arbors(tree, lost))


def _ranked(evidence: Train, listed: Sequence[Candidate]) -> Iterator[RankedTrain]:
    from geartrain.report.reconstruction_report import RankedTrain
    from geartrain.synthesis.reconstruction.candidate_train import TrainConstruction

    for rank, candidate in enumerate(listed, 1):
        train = TrainConstruction.of(evidence, candidate.arbor)
        meshes = tuple(f"{driving} > {driven}" for driving, driven in train.meshes)
        yield RankedTrain(rank, candidate.ranks, candidate.added, candidate.weight, train.added, train.doubtful, meshes)


def _write(evidence: Train, listed: Sequence[Candidate], folder: Path, force: bool, extra: Mapping[str, str]) -> None:
    """Every listed candidate as a declaration of its own, and what else there is, by the name of its file."""
    from geartrain.numerics.files import check_folder, write_folder
    from geartrain.synthesis.reconstruction.candidate_train import candidate_text

    def files() -> Iterator[tuple[str, bytes]]:
        for rank, candidate in enumerate(listed, 1):
            name = f"{evidence.name}-{_file(rank).removesuffix('.yaml')}"
            yield _file(rank), candidate_text(evidence, candidate.arbor, name).encode("utf-8")
        yield from ((file, text.encode("utf-8")) for file, text in extra.items())

    check_folder(folder, [*(_file(rank) for rank in range(1, len(listed) + 1)), *extra], force)
    tell(f"wrote {plural(write_folder(folder, files(), force), 'file')} to {folder}")


def _file(rank: int) -> str:
    return f"rank-{rank:04}.yaml"
