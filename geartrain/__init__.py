"""geartrain: what does this gear train do?

>>> import geartrain
>>> train = geartrain.load("planetary-24-18-60")
>>> train.solve()["carrier"]
Fraction(2, 7)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.loader import load as load
    from geartrain.errors import GearTrainError as GearTrainError
    from geartrain.kinematics.answer import Answer as Answer
    from geartrain.kinematics.verdict import Verdict as Verdict
    from geartrain.train.declaration_files import shipped as shipped

__version__ = "0.1.0"
__all__ = ["Answer", "GearTrain", "GearTrainError", "Verdict", "__version__", "load", "shipped"]

_HOMES = {
    "Answer": "geartrain.kinematics.answer",
    "GearTrain": "geartrain.analysis.gear_train",
    "GearTrainError": "geartrain.errors",
    "Verdict": "geartrain.kinematics.verdict",
    "load": "geartrain.analysis.loader",
    "shipped": "geartrain.train.declaration_files",
}
"""Where each public name lives; it is imported when it is first asked for, so that no command waits for all of them."""


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    found = globals()[name] = getattr(import_module(_HOMES[name]), name)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
