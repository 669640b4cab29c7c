"""Proof that a train is ready to cut: the written outlines are rotated against each other, and the solids are checked
for overlap.

Input: the train with its sizes, and the drawings written from it. Output: a `TrainProof` with the overlap, backlash,
clearance and tip widths of every mesh, the freedom of every link, and all findings. The outlines are read back from the
written drawings, independently of the equations of the tooth forms.

train_proof    proof of a train, of its solids and of wheels bent by a wave generator
mesh_proof     proof of one mesh
turned_pair    two written outlines rotated against each other
link_freedom   range of angles of each link that the teeth allow
"""

from __future__ import annotations

from geartrain.workshop.export.proof.mesh_proof import paired_wheels, prove_mesh, read_wheels
from geartrain.workshop.export.proof.train_proof import (
    TrainProof,
    overlaps,
    proof_is_installed,
    proof_steps,
    prove_solids,
    prove_train,
)
from geartrain.workshop.export.proof.turned_pair import TurnedPair, read_material

__all__ = [
    "TrainProof",
    "TurnedPair",
    "overlaps",
    "paired_wheels",
    "proof_is_installed",
    "proof_steps",
    "prove_mesh",
    "prove_solids",
    "prove_train",
    "read_material",
    "read_wheels",
]
