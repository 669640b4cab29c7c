"""The play of even wheels, and a bound on how often errors of place use it up."""

from __future__ import annotations

from math import erfc, gcd, inf, sqrt
from typing import TYPE_CHECKING

from geartrain.errors import Problem, RangeError
from geartrain.uncertainty.cutting.pair import sizes_of

if TYPE_CHECKING:
    from geartrain.meshes import Mesh
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.sizes import Sizes


def nominal_play(pair: Sizes | TriangularLaw | Mesh) -> float:
    """The least play of wheels without errors, in pitches of the driven wheel; below 0 they jam."""
    from geartrain.teeth.triangular.meshing import Contact

    sizes = sizes_of(pair)
    return Contact(sizes).play / sizes.p2


def jam_bound(pair: Sizes | TriangularLaw | Mesh, sigma: float) -> float:
    """A bound on the probability that flanks jam anywhere in a cycle: 2 lcm(z1, z2) Q(j / (2 sigma)), at most 1.

    Teeth of both wheels are independently out of place by a normal error of `sigma` of their own pitch; Q is the
    normal tail and j the least play in pitches. Four teeth take part in a jam, each moving the driven wheel by about
    its own error, so the play has the deviation 2 sigma; every couple counts twice, for the space before and behind it.
    """
    sizes = sizes_of(pair)
    if not 0 <= sigma < inf:
        raise RangeError(
            Problem(f"{sigma:g} is no standard deviation", "it is a number of pitches", "give 0 or more, and finite")
        )
    play = nominal_play(sizes)
    if play < 0:
        return 1.0
    if sigma == 0:
        return 0.0
    couples = sizes.z1 * sizes.z2 // gcd(sizes.z1, sizes.z2)
    return min(1.0, 2 * couples * erfc(play / (2 * sigma) / sqrt(2)) / 2)
