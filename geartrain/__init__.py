"""geartrain: what does this gear train do?

>>> import geartrain
>>> train = geartrain.load("planetary-24-18-60")
>>> train.solve()["carrier"]
Fraction(2, 7)
"""

from __future__ import annotations

from geartrain.analysis import GearTrain as GearTrain
from geartrain.answer import Answer as Answer
from geartrain.errors import GearTrainError as GearTrainError
from geartrain.errors import Verdict as Verdict
from geartrain.files import load as load
from geartrain.files import shipped as shipped

__version__ = "0.1.0"
__all__ = ["Answer", "GearTrain", "GearTrainError", "Verdict", "__version__", "load", "shipped"]
