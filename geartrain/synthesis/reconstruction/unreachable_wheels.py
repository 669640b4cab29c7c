"""Which surviving wheels the distances of their axes keep apart, exactly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

from geartrain.synthesis.reconstruction.reconstruction_problem import SurvivingArbor
from geartrain.synthesis.reconstruction.surviving_geometry import SurvivingGeometry


def find_unreachable(arbors: Sequence[SurvivingArbor], geometry: SurvivingGeometry) -> Iterator[frozenset[str]]:
    """Pairs of wheels of different arbors that cannot mesh, whichever of their counts they have."""
    wheels = [(arbor.name, wheel) for arbor in arbors if arbor.name in geometry.places for wheel in arbor.wheels]
    for at, (arbor, wheel) in enumerate(wheels):
        for other_arbor, other in wheels[:at]:
            counts = product((count for count, _ in wheel.counts), (count for count, _ in other.counts))
            if arbor != other_arbor and not any(
                geometry.may_mesh(arbor, (wheel.name, own), other_arbor, (other.name, mate)) for own, mate in counts
            ):
                yield frozenset((wheel.name, other.name))
