"""Result types of the search commands that print their results as JSON."""

from __future__ import annotations

from typing import Any


def answers() -> dict[str, Any]:
    """Return the result type of each search command that prints JSON, keyed by the command without the word
    `geartrain`.

    An option that changes the result type has its own entry, such as `teeth set --kind list`.
    """
    from geartrain.search.epicyclic.epicyclic_sets import EpicyclicKind, SetFindings
    from geartrain.search.orrery.orrery_search import Orrery
    from geartrain.search.posterior.posterior_result import ToothCountPosterior
    from geartrain.search.ratio.stage_search import StageFindings
    from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer
    from geartrain.search.stern_brocot import Approximants
    from geartrain.search.train.train_findings import TrainFindings

    return {
        "posterior": ToothCountPosterior,
        "teeth ratio": StageFindings,
        "teeth approximants": Approximants,
        "teeth set": SetFindings,
        "teeth set --kind list": dict[str, EpicyclicKind],
        "teeth train": TrainFindings,
        "teeth orrery": Orrery,
        "reconstruct": ReconstructionAnswer,
    }
