"""geartrain: what does this gear train do?

>>> import geartrain
>>> train = geartrain.load("planetary-24-18-60")
>>> train.solve()["carrier"]
Fraction(2, 7)
"""

from __future__ import annotations

from geartrain.analysis.gear_train import GearTrain as GearTrain
from geartrain.analysis.loader import load as load
from geartrain.analysis.loader import shipped as shipped
from geartrain.errors import GearTrainError as GearTrainError
from geartrain.kinematics.answer import Answer as Answer
from geartrain.kinematics.verdict import Verdict as Verdict

__version__ = "0.1.0"
__all__ = ["Answer", "GearTrain", "GearTrainError", "Verdict", "__version__", "load", "shipped"]
