"""Gears on a sphere: residual against Newton steps and time, and closure by fractions against closure by floats.

The radii of the circles by Newton's method, and by the fixed point of W. Thurston as C. Collins and K. Stephenson
iterate it (Comput. Geom. 25 (2003) 233); then axes moved to one pitch or to closed loops. The packing is judged by
its tangencies in 40 digits, closure by whole numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from geartrain.spherical.graph_set import Aim
from studies.circle_packings import fitted, packed
from studies.loop_closures import closed
from studies.measurement import Step, taken
from studies.sphere_records import SphereRecords

_SIZES = {"hull": (5, 11, 35, 101, 335), "zonohedron": (4, 6, 10, 18, 32), "trapezohedron": (4, 14, 49, 149, 499)}
_FITS: tuple[tuple[Aim, int], ...] = (("pitch", 12), ("pitch", 50), ("phases", 12))
_SOLIDS = ("icosidodecahedron", "6-antiprism", "rhombicosidodecahedron")
_POWERS, _FEW_POWERS = tuple(range(1, 16)), (1, 4, 8, 12)


def sphere(quick: bool = False) -> SphereRecords:
    """Measure all graphs and loops (`quick`: graphs of up to 32 gears, few loops)."""
    return SphereRecords.sorted_by_kind("Gears on a sphere: residual against steps and time", taken(_steps(quick)))


def _steps(quick: bool) -> Iterator[Step]:
    rounds, few, draws = (1, 2, 60) if quick else (3, 5, 1000)
    for family, sizes in _SIZES.items():
        for given in sizes[:few]:
            yield f"{family} {given}: circles", partial(packed, family, given, rounds)
            for aim, minimum in _FITS:
                yield f"{family} {given}: {aim}, {minimum} teeth", partial(fitted, family, given, aim, minimum)
    for power in _FEW_POWERS if quick else _POWERS:
        for solid in _SOLIDS:
            yield f"{solid}: 10^{power} teeth", partial(closed, solid, power, draws)
