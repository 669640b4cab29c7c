"""Reconstruction: every train that explains surviving arbors and the speeds of pointers.

`reconstruct` answers a `ReconstructionRequest`. The modules in the order of the search:

The question

- `link_roles`: the link that bears the arbors, and links that couplings join to one arbor
- `surviving_geometry`: measured modules, radii and places of axes
- `reconstruction_problem`: the typed question, its size and its digest
- `evidence_question`: translation of declared evidence into the question
- `spur_tree`: parts of a complete train, trees found by breadth-first search along meshes
- `lost_arbors`: evidence of such a part without some of its arbors

The search: enumeration of trees up to the order of arbors, by paths from the input to each dial

- `train_topology`: a rooted tree without orders of arbors and counts of added wheels (an equivalence class of trains)
- `quotient_keys`: sets of quotients of added counts, looked up by additive hashing
- `path_lists`: enumeration of the paths to one dial, pruned by large primes (bit columns) and hashed quotients
- `path_choice`: backtracking over dials, pruned by joins on hashes, bit masks and a lower bound (shortest tour)
- `path_trees`: recursive enumeration of the topologies that have one given path a dial
- `added_counts`: choices of added counts, by variable elimination and tables of products; summed and drawn
- `candidate_names`: canonical names of arbors and wheels
- `arbor_orders`: orders of arbors on chains, by dynamic programming over subsets
- `search_tasks`: independent tasks, which run in any process; trains of a topology are orders times counts
- `expected_cost`: time of the search, extrapolated from a sample of its tasks
- `geometry_likelihood`: agreement with measurements; closed polygons, and layers by dynamic programming over bit masks
- `reconstruction_result`: results, prior weights, and equality up to order (bags, classes)
- `reconstruction_search`: the counts, the candidates of greatest weight, random draws

The answer

- `candidate_train`: a complete declaration of a candidate
- `explained_facts`: exact marginals of facts over all trains, and the fact of greatest entropy
- `dropped_facts`: counts without each hard fact, and why nothing fits
- `candidate_findings`: what is reported beyond counts, and the family tree, a trie over meshes
- `known_train`: a train of the literature in the names of the question
- `candidate_rules`: rules that such a train breaks, and the question that would admit it
- `known_rank`: its rank, and the smallest sets of facts that single it out (all sets of up to three)
- `reconstruction`: the request, and all of the above in one call
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer as ReconstructionAnswer
    from geartrain.search.reconstruct.reconstruction import ReconstructionRequest as ReconstructionRequest
    from geartrain.search.reconstruct.reconstruction import reconstruct as reconstruct

__all__ = ["ReconstructionAnswer", "ReconstructionRequest", "reconstruct"]

_PLACES = dict.fromkeys(__all__, "reconstruction")

__getattr__ = lazy_names(__name__, _PLACES)
