"""Conjugate gear teeth, spur and bevel, computed from their path of contact: profiles, sliding, stress, heat, loss.

The path of contact is the locus of contact in the fixed frame. A contact is at the signed distance d from the pitch
point along a normal that makes the pressure angle psi with the pitch line. The function psi(d) determines both
profiles and every result. Each tooth form is a choice of psi(d).

wheel_pair                tooth counts of a pair, position of its axes, and checks that it can exist
pitch_surfaces            cylinders, cones and rings that roll on each other
path_of_contact           pieces psi(d), sides made of pieces, and contact at every instant (velocities, curvatures)
closed_form_sides         cycloids, round pins, W. D. Smith's extremal of minimum friction
optimal_sides             uniform stress, uniform temperature, minimum friction (Chebyshev collocation, Newton's method)
involute_geometry         involute wheels cut by a rack: thickness, working pressure angle, arcs
admissibility             undercut, pointed tips, contact ratio, interference
path_losses               loss, stress, heat, flash temperature, depth; efficiency exact in friction
conjugate_form            base class of the forms, and checks of a declaration
conjugate_transmission    the pair as designed, and its transmission function
displaced_contact         displaced flanks
off_design_transmission   axles at another centre distance
conjugate_mesh            a pair of a train: figures, and its design
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from geartrain.numerics.lazy_names import public_names

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm as ConjugateToothForm
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair as ConjugatePair
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission as ConjugateTransmission
    from geartrain.teeth.conjugate.off_design_transmission import OffDesignTransmission as OffDesignTransmission
    from geartrain.teeth.conjugate.off_design_transmission import pair_outlines as pair_outlines
    from geartrain.teeth.conjugate.path_losses import PathLosses as PathLosses
    from geartrain.teeth.conjugate.path_losses import efficiency as efficiency
    from geartrain.teeth.conjugate.path_losses import measure as measure
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact as PathOfContact
    from geartrain.teeth.conjugate.wheel_pair import WheelPair as WheelPair

__getattr__, __all__ = public_names(
    __name__,
    {
        "conjugate_form": "ConjugateToothForm",
        "conjugate_transmission": "ConjugatePair ConjugateTransmission",
        "off_design_transmission": "OffDesignTransmission pair_outlines",
        "path_losses": "PathLosses efficiency measure",
        "path_of_contact": "PathOfContact",
        "wheel_pair": "WheelPair",
    },
)
