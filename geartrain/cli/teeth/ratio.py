"""`geartrain teeth RATIO`: stages of gear pairs, or the fractions on the way to the ratio."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geartrain.cli.long_runs import close_journal
from geartrain.cli.teeth.search_options import SearchExecution, SearchOptions

if TYPE_CHECKING:
    from geartrain.synthesis.ratio.stage_search import StageFindings
    from geartrain.synthesis.target_ratio import TargetRatio

_LONG = 100_000


def run(
    asked: SearchOptions,
    means: SearchExecution,
    text: str,
    per: str | None,
    stages: int,
    fit: dict[str, Any],
    approximants: bool,
) -> None:
    """Answer for one ratio."""
    from geartrain.report.tooth_numbers import stages_document, stages_row
    from geartrain.synthesis.ratio.stage_problem import StageConstraints
    from geartrain.synthesis.target_ratio import read_ratio

    wanted = read_ratio(text, per)
    if approximants:
        _fractions(asked, wanted)
    long = stages == 1 and max(len(asked.wheels), len(asked.pinions)) > _LONG
    if long and asked.by == "error" and StageConstraints(**fit) == StageConstraints() and wanted.sense <= 0:
        # anything else that is asked is for the search that looks at every pair
        _pairs(asked, wanted)
    found, cut = _search(asked, means, wanted, stages, fit)
    data = {**found.to_dict(), "ended": "interrupted" if cut else "whole"}
    rows = [stages_row(solution) for solution in found]
    asked.answer(data, rows, lambda: stages_document(found))


def _search(
    asked: SearchOptions, means: SearchExecution, wanted: TargetRatio, stages: int, fit: dict[str, Any]
) -> tuple[StageFindings, bool]:
    from geartrain.synthesis.ratio.stage_problem import StageConstraints
    from geartrain.synthesis.ratio.stage_search import find_stages

    question = {
        "ratio": str(wanted.value),
        "stages": stages,
        "wheels": str(asked.wheels),
        "pinions": str(asked.pinions),
        "tolerance": str(asked.tolerance),
        "best": asked.best,
        "by": asked.by,
        "fit": fit,
    }
    with means.work(question) as (executor, journal, tell):
        found = find_stages(
            wanted,
            stages,
            asked.wheels,
            asked.pinions,
            tolerance=asked.tolerance,
            best=asked.best,
            by=asked.by,
            fit=StageConstraints(**fit),
            executor=executor,
            journal=journal,
            tell=tell,
        )
        cut = not found.complete
        close_journal(journal, cut)
    return found, cut


def _pairs(asked: SearchOptions, wanted: TargetRatio) -> None:
    """One pair in long ranges: by the tree, without a list of counts."""
    from geartrain.report.tooth_numbers import pairs_document, stages_row
    from geartrain.synthesis.gear_pair_search import count_pairs, find_pairs
    from geartrain.synthesis.ratio.stage_infeasibility import OUTSIDE
    from geartrain.synthesis.ratio.stage_problem import StageConstraints
    from geartrain.synthesis.search_outcome import Shortfall

    solutions = find_pairs(wanted, asked.wheels, asked.pinions, asked.tolerance, asked.best)
    count = None if asked.tolerance is None else count_pairs(wanted, asked.wheels, asked.pinions, asked.tolerance)
    top, beneath = (asked.wheels, asked.pinions) if wanted.value >= 1 else (asked.pinions, asked.wheels)
    considered = len(top) * len(beneath)
    data = {
        "wanted": wanted.to_dict(),
        "stages": 1,
        "top": str(top),
        "beneath": str(beneath),
        "fit": StageConstraints().to_dict(),
        "order": asked.by,
        "tolerance": None if asked.tolerance is None else float(asked.tolerance),
        "complete": True,
        "count": count,
        "considered": considered,
        "solutions": [solution.to_dict() for solution in solutions],
        "shortfall": Shortfall(considered, {} if count is None else {OUTSIDE: considered - count}).to_dict(),
        "note": "",
        "ended": "whole",
    }
    rows = [stages_row(solution) for solution in solutions]
    asked.answer(data, rows, lambda: pairs_document(wanted, solutions, count))


def _fractions(asked: SearchOptions, wanted: TargetRatio) -> None:
    from geartrain.report.tooth_numbers import approximants_document
    from geartrain.synthesis.stern_brocot import approximants

    most = max(asked.wheels.most, asked.pinions.most)
    found = approximants(wanted.value, most)
    data = {"wanted": wanted.to_dict(), "most": most, "solutions": [each.to_dict() for each in found]}
    asked.answer(data, data["solutions"], lambda: approximants_document(wanted, most, found))  # type: ignore[arg-type]
