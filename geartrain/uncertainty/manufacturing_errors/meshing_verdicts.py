"""The verdict on many pairs of cut wheels at once, by the cheapest way that is right for their errors."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.errors import Problem, RangeError
from geartrain.numerics.kernels import usable
from geartrain.uncertainty.manufacturing_errors.cut_pair import CutGearPair
from geartrain.uncertainty.manufacturing_errors.meshing_cycle import CHUNK, MeshingVerdicts, chunks, cycle_verdicts
from geartrain.uncertainty.manufacturing_errors.pitch_error_verdicts import verdicts_of_pitch_errors

if TYPE_CHECKING:
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes
    from geartrain.uncertainty.manufacturing_errors.cut_wheel import CutWheel


def batch_verdicts(
    sizes: TriangularSizes,
    first: CutWheel,
    second: CutWheel,
    shift: Any = 0.0,
    chunk: int = CHUNK,
    fast: bool = False,
) -> MeshingVerdicts:
    """The verdict on each trial: wheels whose arrays are (trials, z), or (z,) where all trials share one.

    shift   by how much the centre distance is greater, as the radii: one, or (trials,)
    chunk   couples worked on at once
    fast    judge every error by the compiled kernel
    """
    whole = CutGearPair(sizes, first, second, shift)
    if (first.z, second.z) != (sizes.z1, sizes.z2):
        raise RangeError(
            Problem(
                f"wheels of {first.z} and {second.z} teeth stand for a pair of {sizes.z1} and {sizes.z2}",
                "the driver comes first",
                "give one wheel for each of the pair, in this order",
            )
        )
    if len(whole.trials) != 1 or whole.trials[0] < 1:
        raise RangeError(
            Problem(
                f"trials of shape {whole.trials} are no batch",
                "a batch has one axis of trials, and at least one of them",
                "give at least one wheel as arrays (trials, z)",
            )
        )
    if first.only_placed and second.only_placed and np.ndim(shift) == 0:
        return verdicts_of_pitch_errors(whole, chunk)
    if fast and usable():  # a worker on another machine may do without
        from geartrain.uncertainty.manufacturing_errors.compiled_verdicts import compiled_verdicts

        return compiled_verdicts(whole)
    return MeshingVerdicts.joined([cycle_verdicts(part) for part in chunks(whole, chunk // whole.count)])
