"""A composition that answers by its compiled kernel: the same errors to 1e-12, some ten times as fast."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.dynamics.motion.composition_arrays import make_composition_arrays
from geartrain.dynamics.motion.composition_kernel import compose
from geartrain.dynamics.motion.error_composition import PLAIN, ErrorSamples
from geartrain.numerics.kernels import is_fast

if TYPE_CHECKING:
    from geartrain.dynamics.motion.composition_arrays import CompositionArrays
    from geartrain.dynamics.motion.error_composition import ErrorComposition
    from geartrain.numerics.arrays import Floats

_PACE = 2e6  # links a second that numpy goes through, in most trains


@dataclass(frozen=True)
class CompiledComposition:
    """A composition whose laws are all in tables, and whose pairs do not depend on each other.

    Pairs that do are followed by numpy. As a kernel their Newton's method was 4 to 7 times faster at the composition
    itself (`planetary-24-18-60-triangular`, `pennestri-2002-teeth`), where others gain 9 to 27 times, and nothing in
    whole runs; in plain Python it was 13 to 20 times slower than numpy.
    """

    composition: ErrorComposition
    arrays: CompositionArrays
    fast: bool = True

    @property
    def chunk(self) -> int:
        """Positions worked on at once."""
        return self.composition.chunk

    def at(self, turns: Floats) -> ErrorSamples:
        """Errors and rates of the outputs where the input has made some turns."""
        turns = np.array(turns, dtype=float)
        farthest = max(float(np.max(turns, initial=0.0)), -float(np.min(turns, initial=0.0)))
        outputs, used = len(self.composition.outputs), self.composition.used
        error, rate = np.empty((outputs, len(turns))), np.empty((outputs, len(turns)))
        behind = np.zeros(len(used), dtype=np.int64)
        plain = PLAIN / farthest if farthest else np.inf
        compose.chosen(self.fast)(self.arrays, turns, plain, error, rate, behind)
        back = frozenset(source.id for source, positions in zip(used, behind, strict=True) if positions)
        return ErrorSamples(turns, error, rate, back)


def pays(composition: ErrorComposition, fast: bool | None, positions: int) -> bool:
    """Whether so many positions are asked of a kernel: where that pays, or as the user says.

    Raises `MissingExtraError` where kernels are asked for and numba is not installed.
    """
    links = sum(len(step.links) for step in composition.steps)
    return links > 0 and is_fast(fast, positions * links / _PACE)


def compiled_composition(composition: ErrorComposition) -> CompiledComposition | None:
    """A composition with its kernel; None where a law is not in tables, or pairs depend on each other."""
    arrays = make_composition_arrays(composition)
    return None if arrays is None else CompiledComposition(composition, arrays)
