"""Reconstruction: all trains that explain surviving arbors and the speeds of pointers.

`reconstruct` answers a `ReconstructionRequest` on declared evidence. Its steps are also public: `evidence_question`
converts the evidence to a `ReconstructionProblem`, `find_reconstructions` counts the trains that explain it and lists
the best, and `candidate_train` converts one of them to a train declaration. The modules are listed in the order of the
search.

The problem
- `link_roles`: the link that carries the arbors, and links that couplings join to one arbor
- `reconstruction_problem`: the problem with measured modules, radii and positions of axes, and its size and digest
- `evidence_translation`: conversion of declared evidence to the problem
- `spur_tree`: parts of a complete train, found by breadth-first search along meshes, and evidence that consists of such
  a part without some of its arbors

The search: enumeration of trees up to the order of arbors, by paths from the input to each dial
- `train_topology`: a rooted tree without the order of arbors and without tooth counts of added wheels (an equivalence
  class of trains)
- `path_lists`: enumeration of the paths to one dial, pruned by large primes (columns of powers) and tables of quotients
- `path_trees`: recursive enumeration of the topologies with one given path for each dial
- `added_counts`: number of choices of tooth counts of added wheels, by variable elimination and tables of products
- `candidate_names`: canonical names of arbors and wheels
- `arbor_orders`: enumeration of the orders of arbors on chains
- `search_tasks`: backtracking over dials, pruned by bit masks and tables of quotients, in independent tasks for any
  number of processes
- `geometry_likelihood`: likelihood of measured modules, radii and distances of axes
- `reconstruction_search`: numbers of trains, most probable candidates, and equality of trains up to the order of arbors

The answer
- `train_construction`: conversion of a candidate to a complete declaration
- `explained_facts`: exact marginals of facts over all trains, the fact of maximum entropy, and the family tree, a
  trie over meshes
- `dropped_facts`: number of trains without each hard constraint, and reasons why no train explains the evidence
- `candidate_rules`: conversion of a published train to a candidate, and the rules that it breaks
- `known_rank`: the rank of a known train, and the facts that distinguish it
- `reconstruction`: the request, and one function for all steps
- `reconstruction_report`: the reconstruction as a document
- `verb`: the command `geartrain reconstruct`
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.search.reconstruct.evidence_translation import EvidenceQuestion as EvidenceQuestion
    from geartrain.search.reconstruct.evidence_translation import evidence_question as evidence_question
    from geartrain.search.reconstruct.explained_facts import CandidateFindings as CandidateFindings
    from geartrain.search.reconstruct.explained_facts import find_facts as find_facts
    from geartrain.search.reconstruct.reconstruction import RankedTrain as RankedTrain
    from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer as ReconstructionAnswer
    from geartrain.search.reconstruct.reconstruction import ReconstructionRequest as ReconstructionRequest
    from geartrain.search.reconstruct.reconstruction import reconstruct as reconstruct
    from geartrain.search.reconstruct.reconstruction_problem import Additions as Additions
    from geartrain.search.reconstruct.reconstruction_problem import Arbor as Arbor
    from geartrain.search.reconstruct.reconstruction_problem import PlacedWheel as PlacedWheel
    from geartrain.search.reconstruct.reconstruction_problem import PriorFactors as PriorFactors
    from geartrain.search.reconstruct.reconstruction_problem import ReconstructionProblem as ReconstructionProblem
    from geartrain.search.reconstruct.reconstruction_problem import SearchedDial as SearchedDial
    from geartrain.search.reconstruct.reconstruction_problem import SurvivingArbor as SurvivingArbor
    from geartrain.search.reconstruct.reconstruction_problem import SurvivingWheel as SurvivingWheel
    from geartrain.search.reconstruct.reconstruction_search import Candidate as Candidate
    from geartrain.search.reconstruct.reconstruction_search import ExplanationCount as ExplanationCount
    from geartrain.search.reconstruct.reconstruction_search import Reconstructions as Reconstructions
    from geartrain.search.reconstruct.reconstruction_search import find_reconstructions as find_reconstructions
    from geartrain.search.reconstruct.spur_tree import find_spur_tree as find_spur_tree
    from geartrain.search.reconstruct.spur_tree import find_spur_trees as find_spur_trees
    from geartrain.search.reconstruct.spur_tree import lost_evidence as lost_evidence
    from geartrain.search.reconstruct.train_construction import candidate_train as candidate_train
    from geartrain.train.declaration_files import read_evidence as read_evidence

__getattr__, __all__ = public_names(
    __name__,
    {
        "evidence_translation": "EvidenceQuestion evidence_question",
        "explained_facts": "CandidateFindings find_facts",
        "reconstruction": "RankedTrain ReconstructionAnswer ReconstructionRequest reconstruct",
        "reconstruction_problem": "Additions Arbor PlacedWheel PriorFactors ReconstructionProblem SearchedDial "
        "SurvivingArbor SurvivingWheel",
        "reconstruction_search": "Candidate ExplanationCount Reconstructions find_reconstructions",
        "spur_tree": "find_spur_tree find_spur_trees lost_evidence",
        "train_construction": "candidate_train",
        "..train.declaration_files": "read_evidence",
    },
)
