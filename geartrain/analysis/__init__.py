"""Main classes of the library. `load` reads a file, a name or plain data, and returns a `GearTrain`.

gear_train                   `load`, and the class whose methods call the functions of the other packages
gearbox, gear_series         results for all states of a gearbox; all gears that its clutches and brakes can produce
train_graph, train_variants  the train as a networkx graph; output speeds for many tooth counts at once
accuracy                     error and run time of the computation methods for one train

Results are computed at the first request and cached. The equations are in docs/theory.md for speeds, docs/torques.md
for torques and docs/motion.md for motion.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.analysis.gear_series import find_gears as find_gears
    from geartrain.analysis.gear_train import GearTrain as GearTrain
    from geartrain.analysis.gear_train import load as load
    from geartrain.analysis.train_graph import build_train_graph as build_train_graph

__getattr__, __all__ = public_names(
    __name__,
    {
        "gear_series": "find_gears",
        "gear_train": "GearTrain load",
        "train_graph": "build_train_graph",
    },
)
