"""Base class of conjugate tooth forms, which computes a pair and its transmission function from a declaration.

The module includes the checks that all conjugate forms share: arcs, pressure angles, kinds of wheels, and the numbering
of the gears.
"""

from __future__ import annotations

from abc import abstractmethod
from functools import lru_cache
from math import pi, tau
from typing import TYPE_CHECKING, ClassVar

from pydantic import Field, model_validator

from geartrain.errors import RangeError
from geartrain.numerics.quantity import Angle, Figure, Length, bad
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, check_above_0, refused

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair, ConjugateTransmission
    from geartrain.teeth.conjugate.off_design_transmission import OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.outlines.wheel_requirement import LanternPins
    from geartrain.teeth.pair_results import PairFigures

_DESIGN = 1e-9  # relative difference of centre distances that counts as rounding error


class ConjugateToothForm(ToothForm):
    """Base class of tooth forms that define a path of contact and a tooth thickness for any pair of wheels.

    See Also
    --------
    geartrain.teeth.Involute, geartrain.teeth.Cycloidal : Two conjugate forms.
    """

    conjugate: ClassVar[bool] = True
    own_play: ClassVar[tuple[str, ...]] = ("backlash",)
    matched: ClassVar[str] = ""
    """Names of the quantities, other than the arcs of contact, that are equal in a comparison of tooth forms."""

    backlash: Length = Field(
        "0",
        validate_default=True,
        description="Backlash on the pitch circle, in modules or with a unit; the teeth of both wheels are thinned",
    )
    centre_distance: Length | None = Field(
        None, description="Centre distance, in modules or with a unit; default the design distance"
    )

    @model_validator(mode="after")
    def _lengths_are_lengths(self) -> ConjugateToothForm:
        if self.backlash.value < 0:
            raise bad("backlash", f"backlash {self.backlash.text} would jam the teeth", "give 0 or more")
        check_above_0(self, "length", "centre_distance")
        return self

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """Return the class of the results of this tooth form, which include the path of contact."""
        from geartrain.teeth.conjugate.conjugate_mesh import ConjugateFigures

        return ConjugateFigures

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """Return the mesh of a pair with its first wheel driving. A ring gear is always gear 2 of the mesh."""
        from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh

        check_wheels(self, wheels, shaft_angle)
        ring_first = wheels.internal[0]
        if ring_first:
            check_order(self, wheels.gear.pair)
        transmission = self.transmission(
            *(wheels.counts[::-1] if ring_first else wheels.counts),
            wheels.friction or 0.0,
            2 if ring_first else 1,
            pitch_distance=wheels.distance,
            internal=any(wheels.internal),
            shaft_angle=shaft_angle_of(self, wheels, shaft_angle),
            # the hand of the helix has no effect in the transverse section
            helix=abs(wheels.helix[0]),
        )
        mesh = ConjugateMesh(wheels, self, wheels.driver, transmission)
        if not mesh.rigid:
            _ = mesh.faults  # raises if the teeth are too far apart to touch, where the pair is named in the message
        return mesh

    def slant_pressure(self, wheels: WheelPair) -> float:
        """Return the ratio of the normal force on helical teeth to its transverse component, 1 or more.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.

        Returns
        -------
        float
            Ratio; 1 for straight teeth.
        """
        del wheels
        return 1.0

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float | None:
        """Return the bottom clearance between the root of one gear and the tip of its mate.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers, arrangement of the axes, and module if it is known.
        gear : {1, 2}
            Number of the gear with the root.

        Returns
        -------
        float or None
            Bottom clearance [module]; None if the form does not define it.
        """
        del wheels, gear
        return None

    def backlash_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Return the backlash at a centre distance other than the design distance.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers, arrangement of the axes, and module if it is known.
        gap : float
            Centre distance minus design distance [module]; negative if the axes are too close.

        Returns
        -------
        float or None
            Backlash on the pitch circle [module], negative if the teeth jam. None for forms that run as designed only
            at their design distance.
        """
        del wheels, gap
        return None

    def lantern_pins(self, wheels: WheelPair) -> LanternPins | None:
        """Return the round pins of a lantern in the pair.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers, arrangement of the axes, and module if it is known.

        Returns
        -------
        LanternPins or None
            Pins; None if both wheels have teeth.
        """
        del wheels
        return None

    @abstractmethod
    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """Return the pair at its design distance, regardless of the declared centre distance.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers, arrangement of the axes, and module if it is known.

        Returns
        -------
        ConjugatePair
            Path of contact, tooth thickness, and faults that prevent the pair from running.

        Raises
        ------
        GearTrainError
            If no such pair exists.
        """

    @classmethod
    def pair_of_arcs(cls, wheels: WheelPair, arcs: tuple[float, float], given: Mapping[str, object]) -> ConjugatePair:
        """Return the pair whose arcs of approach and recess have the given lengths. Raises `GearTrainError` if no such
        pair exists.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.
        arcs : tuple of float
            Arcs of approach and recess with gear 1 driving [pitch].
        given : mapping
            Other declared parameters of the form; missing parameters have their defaults.

        Returns
        -------
        ConjugatePair
            Path of contact, tooth thickness, and faults that prevent the pair from running.
        """
        return conjugate_pair_of(cls.declared({"arcs": [repr(float(arc)) for arc in arcs], **given}), wheels)

    def path(
        self,
        z1: int,
        z2: int,
        *,
        internal: bool = False,
        shaft_angle: float | None = None,
        pitch_distance: float | None = None,
        helix: float = 0.0,
    ) -> PathOfContact:
        """Return the path of contact of a pair.

        Parameters
        ----------
        z1, z2 : int
            Tooth numbers of gear 1 and gear 2, 3 or more.
        internal : bool
            True if gear 2 is a ring gear.
        shaft_angle : float, optional
            Shaft angle of bevel gears [rad]; None for parallel axes.
        pitch_distance : float, optional
            Half the module times the sum of the tooth numbers, also for a ring gear [m]. Required only if a length has
            a unit.
        helix : float
            Helix angle of helical wheels [rad], 0 or more; their lengths are in transverse modules.

        Returns
        -------
        PathOfContact
            Path of contact with lengths in modules; for bevel gears in rad on the unit sphere.

        Raises
        ------
        GearTrainError
            If no such pair exists.
        """
        return conjugate_pair_of(self, WheelPair.of(z1, z2, internal, shaft_angle, pitch_distance, helix)).path

    def transmission(
        self,
        z1: int,
        z2: int,
        friction: float = 0.0,
        driver: int = 1,
        direction: int = 1,
        pitch_distance: float | None = None,
        internal: bool = False,
        shaft_angle: float | None = None,
        helix: float = 0.0,
    ) -> ConjugateTransmission | OffDesignTransmission:
        """Return the transmission function of a pair.

        Parameters
        ----------
        z1, z2 : int
            Tooth numbers of gear 1 and gear 2, 3 or more.
        friction : float
            Coefficient of friction, 0 or more.
        driver : {1, 2}
            Number of the driving gear.
        direction : {1, -1}
            Direction of rotation; with -1 the coast flanks are in contact.
        pitch_distance, internal, shaft_angle, helix
            Same as in `path`.

        Returns
        -------
        ConjugateTransmission or OffDesignTransmission
            Transmission function; `OffDesignTransmission` if the centre distance differs from the design distance. Its
            `verdict` reports whether the pair can run.

        Raises
        ------
        GearTrainError
            If no such pair exists.
        """
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission

        wheels = WheelPair.of(z1, z2, internal, shaft_angle, pitch_distance, helix)
        pair, distance = conjugate_pair_of(self, wheels), self.misplaced(wheels)
        # a normal force larger than its transverse component acts as a larger coefficient of friction
        friction = friction * self.slant_pressure(wheels)
        if distance is None:
            return ConjugateTransmission(pair, friction, driver, direction)
        from geartrain.teeth.conjugate.off_design_transmission import OffDesignTransmission

        return OffDesignTransmission(pair, distance, friction, driver, direction)

    def misplaced(self, wheels: WheelPair) -> float | None:
        """Return the declared centre distance if it differs from the design distance.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers, arrangement of the axes, and module if it is known.

        Returns
        -------
        float or None
            Centre distance [module]; None at the design distance.

        Raises
        ------
        GearTrainError
            If the wheels are bevel gears, which have no centre distance.
        """
        if self.centre_distance is None:
            return None
        if wheels.bevel:
            raise refused("bevel wheels have no centre distance", "their axes intersect", "omit `centre_distance`")
        given, design = wheels.modules(self.centre_distance, "centre_distance"), wheels.distance
        return given if abs(given - design) > _DESIGN * design else None

    def _standard(self, path: PathOfContact, wheels: WheelPair) -> ConjugatePair:
        """Return a pair whose teeth are equally thick on both gears: half a pitch less half the backlash."""
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

        half = path.pitch.p / 4 - self._backlash(path.pitch, wheels) / 4
        return ConjugatePair(path, (half, half))

    def _backlash(self, pitch: PitchSurfaces, wheels: WheelPair) -> float:
        """Return the declared backlash as a length on the pitch surfaces [module; rad for bevel gears].

        For a bevel pair, one module is 1 / pi of the circular pitch on the unit sphere.
        """
        return wheels.modules(self.backlash, "backlash") * pitch.p / pi


@lru_cache(maxsize=1024)
def conjugate_pair_of(form: ConjugateToothForm, wheels: WheelPair) -> ConjugatePair:
    """Return the conjugate pair of a tooth form and two wheels. It is computed once and then cached."""
    return form.pair(wheels)


# ---------------------------------------------------------------------------------------------- checks of a declaration


def arcs_of(figures: tuple[Figure, Figure], pitch: PitchSurfaces) -> tuple[float, float]:
    """Convert declared arcs of approach and recess, `figures` [pitch], to lengths on the pitch surfaces [module; bevel:
    rad].
    """
    return float(figures[0].value) * pitch.p, float(figures[1].value) * pitch.p


def check_arcs(arcs: tuple[Figure, Figure]) -> None:
    """Raise a validation error if an arc of contact is negative or if both arcs are 0."""
    if min(arc.value for arc in arcs) < 0 or sum(arc.value for arc in arcs) <= 0:
        text = ", ".join(arc.text for arc in arcs)
        fix = "give arcs of approach and recess in pitches, with a sum of at least 1"
        raise bad("arcs", f"arcs [{text}] are out of range", fix)


def check_angle(name: str, angle: Angle, below: float = 0.25) -> None:
    """Raise a validation error if the pressure angle of the field `name` is not between 0 and `below` turns."""
    turns = angle.si / tau
    if not 0 < turns < below:
        fix = f"give a pressure angle between 0 and {360 * below:g} deg; 20 deg is usual"
        raise bad("pressure_angle", f"{name} {angle.text} is outside 0 to {360 * below:g} deg", fix)


def check_wheels(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> None:
    """Raise `GearTrainError` if wheels of the declared kinds cannot have conjugate teeth of this form."""
    why, fix = "", IDEAL
    if "worm" in wheels.kinds:
        why = "the thread of a worm slides along the teeth of its wheel, so its pitch surfaces do not roll"
    elif set(wheels.kinds) >= {"bevel", "contrate"}:
        why = "a bevel and a contrate wheel have no pair of pitch cones"
    elif "helical" in wheels.kinds:
        try:
            skew = shaft_angle() is not None
        except RangeError:
            skew = True  # only helical wheels may have skew axes
        if skew:
            why = "helical teeth on skew axes have point contact and slide along each other"
        elif form.form != "involute":
            why = "its wheels are helical, and only involute teeth are supported on helical wheels"
            fix = "give the pair `tooth_form: involute`"
    if why:
        raise refused(f"these wheels cannot have {form.words} teeth", why, fix)


def check_order(form: ToothForm, pair: tuple[str, str]) -> None:
    """Raise `GearTrainError` if a pair names its ring gear first and its form declares `pins` or a parameter with
    different values for the two wheels. The form numbers the ring gear 2, so that it is unclear which wheel has which
    value.
    """
    given = {name: getattr(form, name) for name in type(form).model_fields}
    uneven = [name for name, value in given.items() if isinstance(value, tuple) and value[0].value != value[1].value]
    if uneven := uneven + [name for name in ("pins",) if name in form.model_fields_set]:
        ring, pinion = pair
        what = f"the assignment of {' and '.join(uneven)} to its wheels is ambiguous"
        why = f"the pair names its ring '{ring}' first, but this tooth form numbers the ring as its second wheel"
        raise refused(what, why, f"name the pinion first: `pair: [{pinion}, {ring}]`")


def shaft_angle_of(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> float | None:
    """Return the shaft angle [rad] of a pair of bevel wheels; None for wheels on parallel axes, contrate wheels and
    helical wheels.

    Raises `GearTrainError` if the shaft angle of bevel wheels is not declared.
    """
    if {"contrate", "helical"} & set(wheels.kinds):
        return None
    angle = shaft_angle()
    if angle is None and "bevel" in wheels.kinds:
        why = "the shaft angle of its bevel wheels is not declared"
        fix = f"declare `axes` with the `direction` of both axes, or {IDEAL}"
        raise refused(f"these wheels cannot have {form.words} teeth", why, fix)
    return angle
