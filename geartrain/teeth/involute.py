"""Involute teeth: a constant pressure angle, and so the same ratio at any centre distance."""

from __future__ import annotations

from dataclasses import replace
from math import atan, cos, pi, sin, sqrt, tan
from typing import TYPE_CHECKING, ClassVar, Literal

from pydantic import Field, model_validator

from geartrain.numerics.quantity import Angle
from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm, check_angle
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import TwoFigures, bad, refused

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
    from geartrain.teeth.conjugate.involute_geometry import InvolutePair, InvoluteWheel
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces

_MOST_MODULES = 1_000_000
_PROPORTIONS = {"full": ("1", "1.25"), "deep": ("1", "1.4"), "stub": ("0.8", "1")}
_PAIR = "give a sum of 0, such as `shift: [0.3, -0.3]`"


class Involute(ConjugateToothForm):
    """Involute teeth as a rack cuts them, shifted or not; spherical involutes on bevels.

    The path of contact is straight, so that the ratio is exact at any centre distance (docs/shapes.md).

    See Also
    --------
    geartrain.teeth.Cycloidal : teeth that keep the ratio at one distance only.

    Examples
    --------
    >>> transmission = Involute(form="involute", backlash="0.1").transmission(24, 36, 0.1)
    >>> round(transmission.path.contact_ratio, 4), round(transmission.efficiency_mean(), 4)
    (1.6472, 0.9847)
    >>> round(transmission.verdict.backlash * 36 / 2, 12)  # backlash on a pitch radius of 36/2 modules
    0.1
    >>> Involute(form="involute").transmission(8, 60).verdict.kind
    'interference'
    """

    any_distance: ClassVar[bool] = True
    more_contact: ClassVar[str] = "take more teeth, taller ones, or a smaller pressure angle"

    form: Literal["involute"] = Field(description="The name of this form")
    pressure_angle: Angle = Field("20 deg", validate_default=True, description="Pressure angle of the rack")
    shift: TwoFigures = Field(
        "0", validate_default=True, description="How far the rack is shifted outwards, in modules; one or one a wheel"
    )
    addendum: TwoFigures = Field(
        "1", validate_default=True, description="Height of the tips over the rack's pitch line, in modules"
    )
    dedendum: TwoFigures = Field(
        "1.25", validate_default=True, description="Depth of the roots under the rack's pitch line, in modules"
    )
    proportions: Literal["full", "deep", "stub"] | None = Field(
        None,
        description="In place of addendum and dedendum, in modules: full has 1 and 1.25 (ISO 53 A), deep 1 and 1.4, "
        "stub 0.8 and 1",
    )

    @model_validator(mode="before")
    @classmethod
    def _heights_by_name(cls, given: object) -> object:
        heights = _PROPORTIONS.get(given.get("proportions", "")) if isinstance(given, dict) else None
        if heights is None or not isinstance(given, dict):
            return given
        if twice := {"addendum", "dedendum"} & given.keys():
            raise bad("height", f"{min(twice)} and proportions are both given", "give one of them")
        rest = {name: value for name, value in given.items() if name != "proportions"}
        return {**rest, "addendum": heights[0], "dedendum": heights[1]}

    @model_validator(mode="after")
    def _parameters_make_sense(self) -> Involute:
        check_angle("pressure_angle", self.pressure_angle)
        for name in ("addendum", "dedendum"):
            for height in getattr(self, name):
                if height.value <= 0:
                    raise bad("height", f"{name} {height.text} is no height", "write modules above 0")
        for name in ("shift", "addendum", "dedendum"):
            for length in getattr(self, name):
                if abs(length.value) > _MOST_MODULES:
                    raise bad(
                        "height", f"{name} {length.text} is taller than any wheel", f"write at most {_MOST_MODULES:g}"
                    )
        return self

    def misplaced(self, wheels: WheelPair) -> float | None:
        """None: these teeth run at any distance, which `pair` takes into account.

        Returns
        -------
        None
            Never another distance than that of the design.
        """
        return None

    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """The pair at its own centre distance, declared or without play.

        Raises
        ------
        GearTrainError
            Where these wheels cannot have such teeth, with what would let them.
        """
        wheels.check()
        return self._bevel(wheels) if wheels.bevel else self._spur(wheels)

    @classmethod
    def pair_of_arcs(cls, wheels: WheelPair, arcs: tuple[float, float], given: Mapping[str, object]) -> ConjugatePair:
        """The involute pair whose arcs of contact are given, whatever addenda they take.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.
        arcs : tuple of float
            Of approach and recess, gear 1 driving [pitch]; one may be negative.
        given : mapping
            What else the form declares: its pressure angle.

        Returns
        -------
        ConjugatePair
            Teeth that share the pitch equally, without play.
        """
        from geartrain.teeth.conjugate import optimal_sides as forms
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        pitch, psi = wheels.pitch, cls.declared(given).pressure_angle.si
        first, last = (arc * pitch.p for arc in arcs)
        approach, recess = (forms.involute(max(X, 0.0), psi) for X in (first, last))
        return ConjugatePair(PathOfContact(pitch, approach, recess, (first, last)), (pitch.p / 4, pitch.p / 4))

    def slant_pressure(self, wheels: WheelPair) -> float:
        """Force on the teeth of helical wheels over its part across their axes.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.

        Returns
        -------
        float
            1 over the cosine of the base helix angle, whose sine is sin helix cos pressure angle.
        """
        return 1 / sqrt(1 - (sin(wheels.helix) * cos(self.pressure_angle.si)) ** 2)

    @property
    def rack_angle(self) -> float:
        """Pressure angle of the rack (rad)."""
        return self.pressure_angle.si

    # ------------------------------------------------------------------------------------------------ parallel axes

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float:
        """What the dedendum leaves under the mate's tip.

        Returns
        -------
        float
            Modules; below 0 the root stands in the mate's way.
        """
        found = self.involutes(wheels)
        own, mate = (found.first, found.second) if gear == 1 else (found.second, found.first)
        if not found.second.ring:
            return found.distance - mate.tip - own.root
        free = own.root - mate.tip if gear == 2 else mate.tip - own.root
        return free - found.distance

    def backlash_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Play of axes that stand too far apart: involutes run there, with other play.

        Returns
        -------
        float or None
            On the pitch circle [module]; None where the base circles would not reach each other.
        """
        found = self.involutes(wheels)
        moved = replace(found, distance=found.distance + (-gap if wheels.internal else gap))
        try:
            return moved.backlash * moved.pitch.z1 / 2 / moved.pitch.R1
        except ValueError:
            return None  # nearer than the base circles touch

    def involutes(self, wheels: WheelPair) -> InvolutePair:
        """Sizes of a pair with parallel axes.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.

        Returns
        -------
        InvolutePair
            Base circles, tips, roots and operating pressure angle; lengths in modules.

        Raises
        ------
        GearTrainError
            Where the declared centre distance is too short for the base circles.
        """
        from geartrain.teeth.conjugate.involute_geometry import InvolutePair, free_distance

        first, second = self._wheel(wheels, 0), self._wheel(wheels, 1)
        if self.centre_distance is None:
            distance = free_distance(first, second)
        else:
            distance = wheels.modules(self.centre_distance, "centre_distance")
            minimum = second.base - first.base if wheels.internal else second.base + first.base
            if distance <= minimum:
                raise refused(
                    f"a centre distance of {distance:.6g} modules is too short for these involutes",
                    f"their base circles need more than {minimum:.6g}; the unshifted design has {wheels.distance:g}",
                    "give a longer centre_distance or a larger pressure_angle",
                )
        thinned = wheels.modules(self.backlash, "backlash")
        return InvolutePair(first, second, distance, thinned)

    def _wheel(self, wheels: WheelPair, at: int) -> InvoluteWheel:
        from geartrain.teeth.conjugate.involute_geometry import InvoluteWheel

        # in the transverse section a rack that leans is as high, and wider
        flat = cos(wheels.helix)
        figures = self.addendum[at], self.addendum[1 - at], self.dedendum[at], self.shift[at]
        add, mate, ded, shift = (float(figure.value) * flat for figure in figures)
        z, ring = wheels.z2 if at else wheels.z1, bool(at and wheels.internal)
        psi = atan(tan(self.pressure_angle.si) / flat)
        return InvoluteWheel(z, psi, shift, add, ded, min(mate, ded), ring)

    def _spur(self, wheels: WheelPair) -> ConjugatePair:
        from geartrain.teeth.conjugate import optimal_sides as forms
        from geartrain.teeth.conjugate.admissibility import involute_faults
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        found = self.involutes(wheels)
        approach, recess = (forms.involute(max(X, 0.0), found.psi) for X in found.arcs)
        path = PathOfContact(found.pitch, approach, recess, found.arcs)
        return ConjugatePair(path, found.halves, involute_faults(found, path))

    # ----------------------------------------------------------------------------------------------- axes that meet

    def _bevel(self, wheels: WheelPair) -> ConjugatePair:
        from geartrain.teeth.conjugate import optimal_sides as forms
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair
        from geartrain.teeth.conjugate.involute_geometry import base_cone, cone_height, spherical_arc
        from geartrain.teeth.conjugate.path_of_contact import PathOfContact

        if sum(figure.value for figure in self.shift):
            raise refused("the shifts of a bevel pair do not sum to 0", "its axes keep their pitch cones", _PAIR)
        if self.centre_distance is not None:
            raise refused("bevel wheels have no centre distance", "their axes meet", "leave out centre_distance")
        pitch, psi = wheels.pitch, self.pressure_angle.si
        arcs = []
        for at, R, z in ((1, pitch.R2, wheels.z2), (0, pitch.R1, wheels.z1)):
            height = float(self.addendum[at].value + self.shift[at].value)
            tip = R + cone_height(R, z, height)
            if not base_cone(R, psi) <= tip < pi:
                raise refused(
                    f"the tips of wheel {at + 1} do not lie beyond its base cone",
                    f"they stand {height:g} modules over its pitch cone",
                    "give it a greater addendum or a smaller shift inwards",
                )
            arcs.append(spherical_arc(R, psi, tip))
        if sum(arcs) <= 0:
            raise refused(
                "the teeth do not reach each other",
                "the tips of one wheel part from the line of action before those of the other meet it",
                "give greater addenda, or shift the wheels less far apart",
            )
        approach, recess = (forms.involute(max(X, 0.0), psi) for X in arcs)
        return ConjugatePair(
            PathOfContact(pitch, approach, recess, (arcs[0], arcs[1])), self._bevel_halves(pitch, wheels)
        )

    def _bevel_halves(self, pitch: PitchSurfaces, wheels: WheelPair) -> tuple[float, float]:
        """Half the thickness of the teeth on the pitch cones, as X; a shift thickens by 2 x tan psi modules."""
        module, thin = pitch.p / pi, self._backlash(pitch, wheels) / 4
        first, second = (
            pitch.p / 4 + float(figure.value) * tan(self.pressure_angle.si) * module - thin for figure in self.shift
        )
        return first, second
