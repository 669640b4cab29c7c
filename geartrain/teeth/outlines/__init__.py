"""Closed outline of a toothed wheel as cut: flanks, root fillets, tips, rim.

contour                   closed curves of straight edges and arcs
tooth_outline             one tooth from root to tip, with its flank from the path of contact
wheel_requirement         requirements of a pair on the teeth of one wheel; one tooth that fits all pairs of the wheel
tooth_requirement         the same for conjugate teeth: passage of the mate's teeth through the spaces
wheel_outline             blank sizes and the outline of a whole wheel
fixed_teeth               escape wheels and strain waves
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import lazy_names

if TYPE_CHECKING:
    from geartrain.teeth.outlines.contour import Contour
    from geartrain.teeth.outlines.tooth_outline import repeated
    from geartrain.teeth.outlines.wheel_outline import outline

__all__ = ["Contour", "outline", "repeated"]

_PLACES = {
    "Contour": "contour",
    "outline": "wheel_outline",
    "repeated": "tooth_outline",
}

__getattr__ = lazy_names(__name__, _PLACES)
