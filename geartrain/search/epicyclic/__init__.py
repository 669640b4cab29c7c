"""Search for epicyclic gear sets of a given ratio in all their operating modes.

epicyclic_sets      types of epicyclic sets, results of a search, and declarations of the sets found
set_search          enumeration of all sets of one type within bounds, in every operating mode
verb                command `geartrain teeth set`
"""

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.search.epicyclic.epicyclic_sets import EPICYCLIC_KINDS as EPICYCLIC_KINDS

__getattr__, __all__ = public_names(__name__, {"epicyclic_sets": "EPICYCLIC_KINDS"})
