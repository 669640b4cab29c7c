"""Closed outlines to which toothed wheels are cut: flanks, root fillets, tips and rims.

contour                   closed curves of straight edges and arcs
tooth_outline             one tooth from root to tip, with its flank from the path of contact
wheel_requirement         requirements of a pair on the teeth of one wheel; one tooth that fits all pairs of the wheel
tooth_requirement         requirements of conjugate pairs: passage of the mate's teeth through the tooth spaces
wheel_outline             blank sizes and the outline of a whole wheel
fixed_teeth               escape wheels and strain waves
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.teeth.outlines.contour import Contour as Contour
    from geartrain.teeth.outlines.tooth_outline import repeated as repeated
    from geartrain.teeth.outlines.wheel_outline import outline as outline

__getattr__, __all__ = public_names(
    __name__, {"contour": "Contour", "tooth_outline": "repeated", "wheel_outline": "outline"}
)
