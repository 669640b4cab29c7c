"""The front door of the library: a file, a name or plain data in, a `GearTrain` out, which answers questions.

Each part of an answer is made when it is first asked for and kept. `find_accuracy` measures what every method that the
train has costs, and how far it is off. The equations are those of the rooms below: docs/theory.md for speeds,
docs/torques.md, docs/motion.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.analysis.accuracy import TrainAccuracy as TrainAccuracy
    from geartrain.analysis.accuracy import find_accuracy as find_accuracy
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.loader import load as load
    from geartrain.analysis.method_accuracy import MethodAccuracy as MethodAccuracy

__all__ = ["GearTrain", "MethodAccuracy", "TrainAccuracy", "find_accuracy", "load"]

__getattr__ = lazy_names(
    __name__,
    {
        "GearTrain": "gear_train",
        "MethodAccuracy": "method_accuracy",
        "TrainAccuracy": "accuracy",
        "find_accuracy": "accuracy",
        "load": "loader",
    },
)
