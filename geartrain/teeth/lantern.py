"""Lantern wheels: round pins on one wheel, and conjugate teeth on the other."""

from __future__ import annotations

from math import pi, sin
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field, model_validator

from geartrain.errors import Problem, RangeError
from geartrain.numerics.quantity import Figure, Length
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, arcs_of, check_arcs, conjugate_pair_of
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import TwoFigures, check_above_0, check_one_of, number_of_wheel, refused

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.outlines.wheel_requirement import LanternPins
    from geartrain.teeth.pair_results import ToothFault

_CUT_MARGIN = 1 + 1e-8  # factor of the arc cut off by the pins: rounding must not leave less than a pitch of contact


class Lantern(ConjugateToothForm):
    """Lantern gear: round pins on one wheel, and conjugate teeth on its mate.

    The tooth profile is the parallel curve, at the distance of a pin radius, of the epicycloid of the pin centres
    (docs/shapes.md). By default all contact is on one side of the pitch point.

    See Also
    --------
    geartrain.teeth.Cycloidal : teeth of the mate in the limit of zero pin diameter.

    Examples
    --------
    >>> transmission = Lantern(form="lantern").transmission(60, 8)
    >>> transmission.verdict.text, [round(arc / transmission.path.pitch.p, 3) for arc in transmission.path.arcs]
    ('the teeth run', [0.0, 1.0])
    """

    matched: ClassVar[str] = "for a lantern the sum in recess only, beyond the part that its pins cut off"

    form: Literal["lantern"] = Field(description="Name of the tooth form")
    pins: Annotated[Literal[1, 2], BeforeValidator(number_of_wheel)] = Field(
        2, description="Number of the wheel that is the lantern"
    )
    pin_diameter: Length = Field(
        "1.5", validate_default=True, description="Diameter of the pins, in modules or with a unit"
    )
    pin_radius: Length | None = Field(
        None,
        description="Radius of the circle through the pins' centres, in modules or with a unit; default the pitch "
        "radius",
    )
    arcs: TwoFigures | None = Field(
        None,
        description="Arcs of contact in pitches, one value, or a list of two (approach, recess); default one pitch on "
        "the addendum of the pins' mate, beyond the part that the pins cut off",
    )
    addendum: Figure | None = Field(None, description="Addendum of the pins' mate in modules, instead of arcs")

    @model_validator(mode="after")
    def _check_parameters(self) -> Lantern:
        check_above_0(self, "length", "pin_diameter", "pin_radius", "addendum")
        check_one_of(self, "arcs", "arcs", "addendum")
        if self.arcs is not None:
            check_arcs(self.arcs)
        return self

    def misplaced(self, wheels: WheelPair) -> float | None:
        """Return None, or raise `RangeError` if a centre distance other than the design distance is declared."""
        if (distance := super().misplaced(wheels)) is not None:
            off = f"{distance - wheels.distance:+.6g} modules off the design distance"
            why = "the ratio is constant only at the design distance, and other distances are not modelled"
            fix = "remove `centre_distance`, or give another tooth_form"
            raise RangeError(Problem(f"the centre distance of this lantern is {off}", why, fix))
        return None

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design centre distance.

        Raises `GearTrainError` if pins do not reach the pitch circle or touch each other, `RangeError` for bevel wheels
        and for a ring of pins.
        """
        from geartrain.teeth.conjugate.closed_form_sides import flank_start, lantern, pin_angle
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        wheels.check()
        if wheels.bevel:
            raise _not_covered("a bevel lantern", "round pins on a cone have no mate in closed form")
        if wheels.internal and self.pins == 2:
            raise _not_covered("a ring of pins", "`tooth_form: pin_ring` models it, for a disc with one lobe less")
        pitch = wheels.pitch
        R, mate = (pitch.R2, pitch.R1) if self.pins == 2 else (pitch.R1, pitch.R2)
        A, B = self._sizes(R, wheels)
        start = flank_start(R, A, B, mate)
        outside, inside = self._arcs(pitch, R, A, B, mate, start)
        sides = lantern(R, A, B, outside), lantern(R, A, B, inside, inside=True)
        # on the dedendum, contact is limited to the flank that the approaching pins have not cut away
        real = outside, min(inside, -start)
        pin = pin_angle(R, A, B) * R
        # pin, tooth and backlash together are one pitch
        tooth = pitch.p / 2 - pin - self._backlash(pitch, wheels) / 2
        halves = (pin, tooth) if self.pins == 1 else (tooth, pin)
        (approach, recess), arcs = (sides, real) if self.pins == 1 else (sides[::-1], real[::-1])
        path = PathOfContact(pitch, approach, recess, (arcs[0], arcs[1]))
        cut = self._undercut(pitch, start, outside, inside)
        return ConjugatePair(path, halves, extra=cut, solid=(self.pins != 1, self.pins != 2))

    @classmethod
    def pair_of_arcs(cls, wheels: WheelPair, arcs: tuple[float, float], given: Mapping[str, object]) -> ConjugatePair:
        """Return the pair whose arc of contact is the sum of `arcs`, all in recess, with the parameters `given`.

        The arc is extended by the part of the mate's flanks that the approaching pins cut off.
        """
        usual = conjugate_pair_of(cls.declared(given), wheels)
        # a negative arc of approach is the part of the recess that the pins cut off
        lost = max(-usual.arcs[0], 0.0) / usual.path.pitch.p * _CUT_MARGIN
        return super().pair_of_arcs(wheels, (0.0, sum(arcs) + lost), given)

    def _undercut(self, pitch: PitchSurfaces, start: float, outside: float, inside: float) -> tuple[ToothFault, ...]:
        """Return a tuple with an undercut fault if the approaching pins remove a part of the mate's flank that contact
        requires, otherwise an empty tuple. The remaining flank begins at the arc `start` on the pitch circle; `outside`
        and `inside` are the required arcs on the mate's addendum and dedendum [module].
        """
        from geartrain.teeth.pair_results import ToothFault

        left = (outside + min(inside, -start)) / pitch.p
        # without an arc on the dedendum, one pitch of contact (except for rounding error) is enough
        if inside <= -start or (left >= 1 - 1e-12 and not inside):
            return ()
        mate, where = 3 - self.pins, start / pitch.p
        side = f"{abs(where):.4g} pitches {'beyond' if where > 0 else 'short of'} the pitch point"
        what = f"gear {mate} is undercut by the approaching pins"
        why = f"its remaining flanks begin {side}, with {left:.6g} pitches of contact"
        arcs = f"at most {max(-where, 0):.4g} pitches on its dedendum and of at least {1 + where:.6g} on its addendum"
        fix = f"give an arc of {arcs}, a smaller pin_diameter, or a smaller pin_radius"
        return (ToothFault("undercut", mate, -start if self.pins == 1 else start, what, why, fix),)

    def lantern_pins(self, wheels: WheelPair) -> LanternPins:
        """Return the pins of the lantern, with lengths in modules."""
        from geartrain.teeth.outlines.wheel_requirement import LanternPins

        z = wheels.z1 if self.pins == 1 else wheels.z2
        radius = z / 2 if self.pin_radius is None else wheels.modules(self.pin_radius, "pin_radius")
        return LanternPins(self.pins, radius, wheels.modules(self.pin_diameter, "pin_diameter") / 2)

    def _sizes(self, R: float, wheels: WheelPair) -> tuple[float, float]:
        """Return the distance of the pins from the lantern's axle and their radius [module], for pitch radius `R`."""
        pins = self.lantern_pins(wheels)
        A, B = pins.circle, pins.radius
        z = wheels.z1 if self.pins == 1 else wheels.z2
        # such pins do not intersect the pitch circle
        if abs(A - R) >= B:
            what = f"pins at {A:.6g} modules from the axis do not reach the pitch circle"
            sizes = f"the pitch radius is {R:.6g} modules and the radius of a pin {B:.6g}"
            limits = f"between {R - B:.6g} and {R + B:.6g} modules"
            fix = f"give a pin_radius (distance of the pin centres from the axis) {limits}"
            raise refused(what, f"{sizes}, so no contact occurs at the pitch point", fix)
        # chord between the centres of two adjacent pins
        most = 2 * A * sin(pi / z)
        if most <= 2 * B:
            what = f"pins of {2 * B:.6g} modules touch each other"
            fix = f"give a pin_diameter below {most:.6g} modules; half of that leaves space for the mate's teeth"
            raise refused(what, f"the centres of {z} pins are {most:.6g} modules apart", fix)
        return A, B

    def _arcs(
        self, pitch: PitchSurfaces, R: float, A: float, B: float, mate: float, start: float
    ) -> tuple[float, float]:
        """Return the arcs of contact on the mate's addendum and on the mate's dedendum [module on the pitch circles].

        By default the arc on the addendum is one pitch from the arc `start`, at which the mate's flank begins, and the
        arc on the dedendum is 0. R is the pitch radius of the lantern, A the distance of the pins from its axle, B the
        radius of a pin, and `mate` the pitch radius of the mate.
        """
        from geartrain.teeth.conjugate.closed_form_sides import pin_arc, pin_reach

        if self.addendum is not None:
            height = float(self.addendum.value)
            return pin_arc(R, A, B, pin_reach(R, A, B, mate, abs(mate) + (height if mate > 0 else -height))), 0.0
        if self.arcs is None:
            # slightly longer, because rounding must not leave less than a pitch of contact
            return pitch.p + max(start, 0.0) * (1 + 1e-9), 0.0
        approach, recess = arcs_of(self.arcs, pitch)
        return (approach, recess) if self.pins == 1 else (recess, approach)


def _not_covered(what: str, why: str) -> RangeError:
    return RangeError(
        Problem(f"{what} is not modelled", why, "put the pins on an external spur wheel, or give another tooth_form")
    )
