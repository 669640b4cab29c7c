"""Ready to cut or not: the outlines that are written, turned against each other, and the solids through their turn.

In: the train at its sizes, and the files that are written of it. Out: a `TrainProof`, with the overlap, the play, the
clearance and the tips of every mesh, the freedom of every link by its teeth, and what is in the way. The outlines are
read back from the written drawings; nothing here asks a tooth form how its teeth meet.

train_proof    the proof of a train, of its solids and of wheels bent by a wave
mesh_proof     the proof of one mesh
turned_pair    two written outlines turned against each other
link_freedom   how far each link is free by its teeth
"""

from __future__ import annotations

from geartrain.workshop.export.proof.train_proof import TrainProof, proof_is_installed, proof_steps, prove_train

__all__ = ["TrainProof", "proof_is_installed", "proof_steps", "prove_train"]
