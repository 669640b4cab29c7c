"""Known trains that `geartrain reconstruct` ranks among all that explain its evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import typer

from geartrain.cli.reconstruction_findings import stoppable
from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.cli.long_runs import RunOptions
    from geartrain.numerics.work import Execution
    from geartrain.synthesis.reconstruction.evidence_question import EvidenceQuestion
    from geartrain.synthesis.reconstruction.known_rank import KnownRank
    from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem
    from geartrain.synthesis.reconstruction.reconstruction_result import Reconstructions
    from geartrain.train import Train


@dataclass(frozen=True)
class KnownTrains:
    """Trains that are to be ranked, and by which of their names the evidence calls something otherwise."""

    trains: tuple[Train, ...]
    same: Mapping[str, str]


def known_trains(files: Sequence[str], same: Sequence[str], question: EvidenceQuestion) -> KnownTrains:
    """What is to be ranked, read and made sure of before anything is searched."""
    from geartrain.synthesis.reconstruction.known_train import check_same, find_known_train
    from geartrain.train.declaration_files import read_declaration

    if same and not files:
        raise typer.BadParameter("it names what is in a train that --rank gives", param_hint="--same")
    names = {}
    for text in same:
        own, _, called = map(str.strip, text.partition("="))
        if not own or not called:
            raise typer.BadParameter(f"'{text}' is not like E4=e3", param_hint="--same")
        names[own] = called
    if files and question.base.is_carrier:
        what = "trains are not ranked where arbors turn on a carrier"
        raise QuestionError(Problem(what, "a known train is read on fixed axes", "leave --rank out"))
    trains = tuple(read_declaration(file) for file in files)
    check_same(names, trains, question.problem)
    for train in trains:
        find_known_train(train, question.problem, names)
    return KnownTrains(trains, names)


def rank_trains(
    known: KnownTrains, evidence: Train, problem: ReconstructionProblem, found: Reconstructions, options: RunOptions
) -> tuple[KnownRank, ...]:
    """What each train costs; one that is stopped is left out."""
    from geartrain.synthesis.reconstruction.known_rank import RankedQuestion, rank_known_train
    from geartrain.synthesis.reconstruction.reconstruction_search import find_reconstructions

    ranked: list[KnownRank] = []
    for train in known.trains:
        with stoppable(f"what {train.name} costs", options) as execution:

            def search(asked: ReconstructionProblem, execution: Execution = execution) -> Reconstructions:
                answer = find_reconstructions(asked, execution, listed=0)
                if not answer.complete:  # the search tells what it has when it is stopped
                    raise KeyboardInterrupt
                return answer

            ranked.append(rank_known_train(train, RankedQuestion(evidence, problem, found, search), known.same))
    return tuple(ranked)
