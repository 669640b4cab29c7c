"""Error against run time of the methods there are, on one train: speeds, its variants, laws of pairs, motion, torques.

In goes a train and a number of positions; out comes a row a method with its time, the ratio of that to the cheapest
method of its stage, and its error with what it was held against. A stage that the train does not have is named with the
reason, and costs nothing. How methods do on whole families of trains is measured in docs/scripts/studies/.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial

from geartrain.analysis.gear_train import GearTrain
from geartrain.analysis.method_accuracy import (
    LAWS,
    MOTION,
    SPEEDS,
    TORQUES,
    VARIANTS,
    AbsentStageError,
    MethodAccuracy,
    Stage,
    measure_laws,
    measure_motion,
    measure_speeds,
    measure_torques,
)
from geartrain.analysis.variant_accuracy import measure_variants
from geartrain.numerics.plain_data import Result


@dataclass(frozen=True, slots=True)
class TrainAccuracy(Result):
    """All methods on one train in one state.

    Attributes
    ----------
    train : str
        Its name.
    state : str or None
        The state that was solved.
    positions : int
        Driver angles of each transmission function, and positions of the input.
    methods : tuple of MethodAccuracy
        Stage by stage.
    left_out : dict of str to str
        A stage that the train does not have -> why.

    See Also
    --------
    find_accuracy : measures it
    """

    KEYS = ("state", "positions", "methods", "left_out")

    train: str
    state: str | None
    positions: int
    methods: tuple[MethodAccuracy, ...]
    left_out: dict[str, str]


Measurement = Callable[[GearTrain, str | None], Iterator[MethodAccuracy]]
"""What yields the methods of a stage, on a train in a state; raises `AbsentStageError` where there is none."""


def find_accuracy(
    train: GearTrain,
    state: str | None = None,
    positions: int = 10_000,
    more: Mapping[Stage, Measurement] | None = None,
) -> TrainAccuracy:
    """Measure every method of every stage that the train has.

    Parameters
    ----------
    train : GearTrain
        A declared train.
    state : str, optional
        The state to solve; by default that of a train without states.
    positions : int
        Driver angles of each transmission function, and positions of the input over 20 turns; 2 or more.
    more : mapping of str to callable, optional
        Further stages, from rooms that stand above trains: name -> what yields its methods.

    Returns
    -------
    TrainAccuracy
        A row a method with its time [s] and its error, and the stages that the train does not have.

    Raises
    ------
    QuestionError
        If the train has states and none of them is named, or another one.

    Examples
    --------
    >>> train = GearTrain.declare({"links": {"frame": {}, "a": {"wheels": {"p": 20}}, "b": {"wheels": {"w": 60}}},
    ...     "revolutes": [{"pair": ["frame", "a"], "axis": "A"}, {"pair": ["frame", "b"], "axis": "B"}],
    ...     "gears": [{"pair": ["p", "w"]}], "inputs": {"a": 1}})
    >>> found = find_accuracy(train)
    >>> for row in found.methods[:2]:
    ...     print(row.method, row.error < 1e-15, "against", row.reference)
    exact True against every equation
    floats True against exact speeds
    >>> found.left_out["torques"]
    'no loads are declared'
    """
    stages: dict[Stage, Callable[[], Iterator[MethodAccuracy]]] = {
        SPEEDS: partial(measure_speeds, train, state),
        VARIANTS: partial(measure_variants, train, state),
        LAWS: partial(measure_laws, train, state, positions),
        MOTION: partial(measure_motion, train, state, positions),
        TORQUES: partial(measure_torques, train, state),
        **{stage: partial(measure, train, state) for stage, measure in (more or {}).items()},
    }
    methods: list[MethodAccuracy] = []
    left_out: dict[str, str] = {}
    for stage, measured in stages.items():
        try:
            rows = list(measured())
        except AbsentStageError as absent:
            left_out[stage] = str(absent)
            continue
        least = min(row.seconds for row in rows)
        methods += [replace(row, ratio=row.seconds / least) for row in rows]
    return TrainAccuracy(train.name, state, positions, tuple(methods), left_out)
