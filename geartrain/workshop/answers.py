"""Types of the results that the workshop commands print as JSON."""

from __future__ import annotations

from typing import Any


def answers() -> dict[str, Any]:
    """Return the class of the result that each command of this package prints with --json, keyed by command name."""
    from geartrain.workshop.budget.pointer_budget import TrainBudget
    from geartrain.workshop.cutting.wheel_estimate import WheelEstimate
    from geartrain.workshop.feasibility.feasibility_trials import FeasibilityResult
    from geartrain.workshop.monte_carlo.monte_carlo_result import MonteCarloResult
    from geartrain.workshop.sizes.best_sizes import BestToothSizes
    from geartrain.workshop.sizes.train_size_search import BestTrainSizes

    return {
        "montecarlo": MonteCarloResult,
        "feasibility": FeasibilityResult,
        "budget": TrainBudget,
        "optimise": BestTrainSizes,
        "inspect wheels": dict[str, WheelEstimate],
        "mesh --form triangular --objective": BestToothSizes,
    }
