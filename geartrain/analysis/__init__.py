"""The entry to the library: a file, a name or plain data in, a `GearTrain` out, which answers questions.

gear_train                   `load`, and the one class whose methods call the functions of the rooms below
gearbox, gear_series         all states of a train with clutches; all gears that its elements could give
train_graph, train_variants  the train as a graph; many tooth counts at once
accuracy                     error against run time of the methods on one train

Each part of an answer is made when it is first requested and kept. The equations are those of the rooms below:
docs/theory.md for speeds, docs/torques.md, docs/motion.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.analysis.accuracy import MethodAccuracy as MethodAccuracy
    from geartrain.analysis.accuracy import TrainAccuracy as TrainAccuracy
    from geartrain.analysis.accuracy import find_accuracy as find_accuracy
    from geartrain.analysis.gear_series import find_gears as find_gears
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.gear_train import load as load
    from geartrain.analysis.train_graph import build_train_graph as build_train_graph

__all__ = [
    "GearTrain",
    "MethodAccuracy",
    "TrainAccuracy",
    "build_train_graph",
    "find_accuracy",
    "find_gears",
    "load",
]

__getattr__ = lazy_names(
    __name__,
    {
        "GearTrain": "gear_train",
        "MethodAccuracy": "accuracy",
        "TrainAccuracy": "accuracy",
        "build_train_graph": "train_graph",
        "find_accuracy": "accuracy",
        "find_gears": "gear_series",
        "load": "gear_train",
    },
)
