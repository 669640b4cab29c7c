"""Kinematics of a declared train: exact speeds, mobility, loops, and a verdict.

The input is the declaration of a train with its inputs, brakes and locks. The results are fundamental circuits with
their carriers, speeds as Fractions (or floats with error estimates), the mobility, a verdict with its certificate, and
outputs compared with their expected values. `TrainKinematics` provides all results for one train and computes each of
them once.

The basic equation is Willis' equation, a (w_i - w_k) + b (w_j - w_k) = 0 for each gear pair (docs/theory.md, 3 to 9).

train_kinematics                 all results for one train; remarks on a valid declaration
circuits                         joint tree with its axes and rigid bodies; fundamental circuits
willis_system                    rows of the Willis system; relative speeds
willis_matrix                    the same rows as a sparse matrix
components                       ordinary trains relative to one carrier, and the reduced system that couples them
speeds                           propagation, exact elimination, diagnosis; mobility; floats
formulas                         outputs as rational functions of tooth counts, and as textbook formulas
levers                           lever analogy: links as points on a line
gridlock                         locked subgraphs, and the smallest set of meshes to remove
phasing                          phase closure: check whether the teeth mesh when a train is assembled
buildability                     parts of a declared train that cannot be built, or should be changed
planet_copies                    equal planets declared as one link
graph                            declared links, turning pairs and gear pairs as a networkx graph
judged_outputs, answer           results; effect of one tooth more or fewer
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Answer as Answer
    from geartrain.kinematics.answer import Verdict as Verdict
    from geartrain.kinematics.circuits.fundamental import Circuit as Circuit
    from geartrain.kinematics.circuits.fundamental import WillisEquation as WillisEquation
    from geartrain.kinematics.gridlock.removal import Gridlock as Gridlock
    from geartrain.kinematics.judged_outputs import Sensitivity as Sensitivity
    from geartrain.kinematics.phasing.mesh_phasing import MeshPhasing as MeshPhasing
    from geartrain.kinematics.speeds.float_speeds import FloatSpeeds as FloatSpeeds
    from geartrain.kinematics.speeds.mobility import Mobility as Mobility
    from geartrain.kinematics.willis_matrix import WillisMatrix as WillisMatrix
    from geartrain.kinematics.willis_system import WillisSystem as WillisSystem

__getattr__, __all__ = public_names(
    __name__,
    {
        "answer": "Answer Verdict",
        "circuits.fundamental": "Circuit WillisEquation",
        "gridlock.removal": "Gridlock",
        "judged_outputs": "Sensitivity",
        "phasing.mesh_phasing": "MeshPhasing",
        "speeds.float_speeds": "FloatSpeeds",
        "speeds.mobility": "Mobility",
        "willis_matrix": "WillisMatrix",
        "willis_system": "WillisSystem",
    },
)
