"""Analysis of gear trains: exact speeds, losses, motion with real teeth, and search for tooth counts.

>>> import geartrain
>>> train = geartrain.load("planetary-24-18-60")
>>> train.solve()["carrier"]
Fraction(2, 7)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.gear_train import load as load
    from geartrain.errors import DeclarationError as DeclarationError
    from geartrain.errors import GearTrainError as GearTrainError
    from geartrain.errors import MissingExtraError as MissingExtraError
    from geartrain.errors import Problem as Problem
    from geartrain.errors import QuestionError as QuestionError
    from geartrain.errors import RangeError as RangeError
    from geartrain.kinematics.answer import Answer as Answer
    from geartrain.kinematics.answer import Verdict as Verdict
    from geartrain.train.declaration_files import shipped as shipped

__version__ = "0.1.0"

__getattr__, _names = public_names(
    __name__,
    {
        "analysis.gear_train": "GearTrain load",
        "errors": "DeclarationError GearTrainError MissingExtraError Problem QuestionError RangeError",
        "kinematics.answer": "Answer Verdict",
        "train.declaration_files": "shipped",
    },
    "analysis drawing dynamics kinematics report scene search simulation spherical teeth train workshop",
)
__all__ = [*_names, "__version__"]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
