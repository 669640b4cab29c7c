"""How often one pair with triangular teeth, cut with errors, stops: the trials of a train of two wheels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from geartrain.analysis.gear_train import GearTrain
from geartrain.workshop.cutting.declared_errors import ErrorOverride
from geartrain.workshop.monte_carlo.trial_plan import find_trial_plan
from geartrain.workshop.monte_carlo.trial_run import run_trials
from geartrain.workshop.sizes.size_design import ToothSizes
from geartrain.workshop.sizes.train_sizes import form_data


@dataclass(frozen=True)
class PairTrials:
    """Monte Carlo trials of single pairs, all with the same errors and the same seed.

    Attributes
    ----------
    errors : sequence of ErrorOverride
        Of cutting and fitting; `read_error_overrides` reads them.
    trials : int
        How many times each pair is cut.
    seed : int
        The same for all pairs, so that they differ by their sizes alone.

    See Also
    --------
    run_trials : the same of a train.

    Examples
    --------
    >>> from math import pi
    >>> from geartrain.workshop import ToothSizes
    >>> from geartrain.workshop import read_error_overrides
    >>> trials = PairTrials(read_error_overrides(["placement=0.1 %"]), 64)
    >>> trials.stops(ToothSizes((48, 96), 0.98, 0.5, (pi / 6, pi / 6), 0.2))
    0.0
    """

    errors: Sequence[ErrorOverride]
    trials: int = 256
    seed: int = 1

    def stops(self, sizes: ToothSizes) -> float:
        """The share of trials in which the pair jams or clashes.

        Parameters
        ----------
        sizes : ToothSizes
            The pair as designed.
        """
        (z1, z2), driver = sizes.teeth, ("w1", "w2")[sizes.driver - 1]
        train = GearTrain.declare(
            {
                "links": {"frame": {}, "a": {"wheels": {"w1": z1}}, "b": {"wheels": {"w2": z2}}},
                "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
                "gears": [{"pair": ["w1", "w2"], "tooth_form": form_data(sizes, exact=True), "driver": driver}],
                "inputs": {("a", "b")[sizes.driver - 1]: 1},
                "outputs": {("b", "a")[sizes.driver - 1]: {}},
            }
        )
        return run_trials(find_trial_plan(train, self.errors), self.trials, self.seed).train.events["stops"].value
