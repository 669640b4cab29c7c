"""The front door of the library: a file, a name or plain data in, a `GearTrain` out, which answers questions.

Each part of an answer is made when it is first asked for and kept. The equations are those of the rooms below:
docs/theory.md for speeds, docs/torques.md, docs/motion.md.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.loader import load as load

__all__ = ["GearTrain", "load"]

__getattr__ = lazy_names(__name__, {"GearTrain": "gear_train", "load": "loader"})
