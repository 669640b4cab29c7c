"""The base class of conjugate tooth forms: from a declaration to a pair of wheels and its
transmission function.

With the checks that these forms share: arcs, pressure angles, kinds of wheels, and which wheel is gear 1.
"""

from __future__ import annotations

from abc import abstractmethod
from functools import lru_cache
from math import pi, tau
from typing import TYPE_CHECKING, ClassVar, Self

from pydantic import Field, model_validator

from geartrain.errors import Problem, RangeError
from geartrain.numerics.quantity import Angle, Figure, Length, Quantity
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, bad, refused

if TYPE_CHECKING:
    from collections.abc import Mapping

    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair, ConjugateTransmission
    from geartrain.teeth.conjugate.displaced_contact import OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.outlines.wheel_requirement import LanternPins
    from geartrain.teeth.pair_results import PairFigures

_DESIGN = 1e-9  # of a centre distance: nearer to the design is at it


class ConjugateToothForm(ToothForm):
    """A conjugate tooth form: a path of contact for any two wheels, and the thickness of their teeth.

    See Also
    --------
    geartrain.teeth.Involute, geartrain.teeth.Cycloidal : two of them.
    """

    conjugate: ClassVar[bool] = True
    matched: ClassVar[str] = ""
    """How it is matched to other forms where they are compared, beyond its arcs, in words."""

    backlash: Length = Field(
        "0",
        validate_default=True,
        description="Play on the pitch circle, in modules or with a unit; both teeth thinned",
    )
    centre_distance: Length | None = Field(
        None, description="Distance of the two axes, in modules or with a unit; default that of the design"
    )

    @model_validator(mode="after")
    def _lengths_are_lengths(self) -> ConjugateToothForm:
        check_lengths(self.backlash, self.centre_distance)
        return self

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """With those of the path of contact."""
        from geartrain.teeth.conjugate.conjugate_mesh import ConjugateFigures

        return ConjugateFigures

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """The mesh of a pair, its first wheel driving; a ring is gear 2 of the form whichever the pair names first.

        Returns
        -------
        GearMesh
            What a train asks of the pair.
        """
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
            helix=abs(wheels.helix[0]),
        )
        mesh = ConjugateMesh(wheels, self, wheels.driver, transmission)
        if not mesh.rigid:
            _ = mesh.faults  # teeth too far apart to touch raise: here, where the pair is named
        return mesh

    def own_backlash(self, pair: str) -> Problem | None:
        """Why a maker's play does not hold for this pair: declared play wins.

        Returns
        -------
        Problem or None
            None where no play is declared.
        """
        if "backlash" not in self.model_fields_set:
            return None
        why = f"it declares {self.backlash.text}, and what is declared wins"
        fix = "leave --backlash out, or take the `backlash` out of the file"
        return Problem(f"pair '{pair}' has a backlash of its own", why, fix)

    def thinned(self, backlash: Quantity) -> Self:
        """The same teeth with this play.

        Returns
        -------
        ConjugateToothForm
            A copy.
        """
        return self.model_copy(update={"backlash": backlash})

    def slant_pressure(self, wheels: WheelPair) -> float:
        """Force on the teeth of helical wheels over its part across their axes.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.

        Returns
        -------
        float
            1 for straight teeth.
        """
        del wheels
        return 1.0

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float | None:
        """Room under the mate's tip at the root of one gear.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.
        gear : {1, 2}
            Whose root.

        Returns
        -------
        float or None
            Modules; None where the form does not say.
        """
        del wheels, gear
        return None

    def backlash_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Play of axes that stand too far apart.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.
        gap : float
            By how much [module]; below 0 they stand too near.

        Returns
        -------
        float or None
            On the pitch circle [module], below 0 where the teeth jam; None for forms that run as designed at their
            own distance only.
        """
        del wheels, gap
        return None

    def lantern_pins(self, wheels: WheelPair) -> LanternPins | None:
        """The round pins that one wheel has for teeth.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.

        Returns
        -------
        LanternPins or None
            None where both have teeth.
        """
        del wheels
        return None

    @abstractmethod
    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """The pair of wheels as designed, whatever their distance.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.

        Returns
        -------
        ConjugatePair
            Path of contact, thickness of the teeth, and what keeps them from running.

        Raises
        ------
        GearTrainError
            Where there is no such pair.
        """

    @classmethod
    def pair_of_arcs(cls, wheels: WheelPair, arcs: tuple[float, float], given: Mapping[str, object]) -> ConjugatePair:
        """The pair whose arcs of contact are given; raises `GearTrainError` where there is none.

        Parameters
        ----------
        wheels : WheelPair
            The two wheels.
        arcs : tuple of float
            Of approach and recess, gear 1 driving [pitch].
        given : mapping
            What else the form declares; what is left out is as by default.

        Returns
        -------
        ConjugatePair
            Path of contact, thickness of the teeth, and what keeps them from running.
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
        """The path of contact of a pair.

        Parameters
        ----------
        z1, z2 : int
            Teeth of gear 1 and gear 2, 3 or more.
        internal : bool
            Gear 2 is a ring.
        shaft_angle : float, optional
            Angle of the axes [rad], for bevels; parallel without.
        pitch_distance : float, optional
            Half the module of each wheel times its teeth, summed, for a ring too [m]; only lengths with a unit need it.
        helix : float
            Helix angle of helical wheels [rad], 0 or more; their lengths are in transverse modules.

        Returns
        -------
        PathOfContact
            Lengths in modules; of bevels rad on the unit sphere.

        Raises
        ------
        GearTrainError
            Where the form gives no such pair.
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
        """The transmission function of a pair.

        Parameters
        ----------
        z1, z2 : int
            Teeth of gear 1 and gear 2, 3 or more.
        friction : float
            Coefficient of friction, 0 or more.
        driver : {1, 2}
            Which gear drives.
        direction : {1, -1}
            -1 turns back, on the other flanks.
        pitch_distance, internal, shaft_angle, helix
            As in `path`.

        Returns
        -------
        ConjugateTransmission or OffDesignTransmission
            The second where the axes stand at another distance than the teeth are made for; the `verdict` of either
            says whether the pair can run.

        Raises
        ------
        GearTrainError
            Where the form gives no such pair.
        """
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission

        wheels = WheelPair.of(z1, z2, internal, shaft_angle, pitch_distance, helix)
        pair, distance = conjugate_pair_of(self, wheels), self.misplaced(wheels)
        friction = friction * self.slant_pressure(wheels)
        if distance is None:
            return ConjugateTransmission(pair, friction, driver, direction)
        from geartrain.teeth.conjugate.displaced_contact import OffDesignTransmission

        return OffDesignTransmission(pair, distance, friction, driver, direction)

    def misplaced(self, wheels: WheelPair) -> float | None:
        """The declared centre distance, where it is not that of the design.

        Parameters
        ----------
        wheels : WheelPair
            Tooth numbers of the two, how their axes stand, and their module if a length says it.

        Returns
        -------
        float or None
            Modules; None at the distance of the design.

        Raises
        ------
        GearTrainError
            For bevel wheels, which have none.
        """
        if self.centre_distance is None:
            return None
        if wheels.bevel:
            raise refused("bevel wheels have no centre distance", "their axes meet", "leave out centre_distance")
        given, design = wheels.modules(self.centre_distance, "centre_distance"), wheels.distance
        return given if abs(given - design) > _DESIGN * design else None

    def _standard(self, path: PathOfContact, wheels: WheelPair) -> ConjugatePair:
        """A pair whose teeth share the pitch equally, less half the backlash each."""
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

        half = path.pitch.p / 4 - self._backlash(path.pitch, wheels) / 4
        return ConjugatePair(path, (half, half))

    def _backlash(self, pitch: PitchSurfaces, wheels: WheelPair) -> float:
        """The declared backlash as X: of a bevel pair a module is p / pi on the unit sphere."""
        return wheels.modules(self.backlash, "backlash") * pitch.p / pi


@lru_cache(maxsize=1024)
def conjugate_pair_of(form: ConjugateToothForm, wheels: WheelPair) -> ConjugatePair:
    """The pair of a form, made once."""
    return form.pair(wheels)


# ---------------------------------------------------------------------------------------------- checks of a declaration


def arcs_of(figures: tuple[Figure, Figure], pitch: PitchSurfaces) -> tuple[float, float]:
    """Arcs declared in pitches, as X."""
    return float(figures[0].value) * pitch.p, float(figures[1].value) * pitch.p


def check_arcs(arcs: tuple[Figure, Figure]) -> None:
    """Raises pydantic's error for arcs below 0, or both 0."""
    if min(arc.value for arc in arcs) < 0 or sum(arc.value for arc in arcs) <= 0:
        text = ", ".join(arc.text for arc in arcs)
        raise bad("arcs", f"arcs [{text}] are none", "give those of approach and recess in pitches, a pitch in all")


def check_lengths(backlash: Quantity, centre_distance: Quantity | None) -> None:
    """Raises pydantic's error for a backlash below 0, or a distance not above 0."""
    if backlash.value < 0:
        raise bad("backlash", f"backlash {backlash.text} would jam the teeth", "write 0 or more")
    if centre_distance is not None and centre_distance.value <= 0:
        raise bad("length", f"centre_distance {centre_distance.text} is no length", "write it above 0")


def check_angle(name: str, angle: Angle, below: float = 0.25) -> None:
    """Raises pydantic's error for a pressure angle outside 0 to `below` of a turn, an eighth or a quarter."""
    turns = angle.si / tau
    if not 0 < turns < below:
        raise bad(
            "pressure_angle",
            f"{name} {angle.text} is outside 0 to {360 * below:g} deg",
            f"a pressure angle of these teeth lies between 0 and {360 * below:g} deg; 20 deg is usual",
        )


def check_wheels(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> None:
    """Raises `GearTrainError` for wheels of kinds that cannot have conjugate teeth of this form."""
    why, fix = _refusal(wheels.kinds), IDEAL
    if "helical" in wheels.kinds:
        if _are_skew(shaft_angle):
            why = "helical teeth on skew axes touch at a point, and slide along each other"
        elif form.form != "involute":
            why = "its wheels are helical, and only involutes are known to work there"
            fix = "give it `tooth_form: involute`"
    if why:
        raise refused(f"it cannot have {form.words} teeth", why, fix)


def _refusal(kinds: tuple[str, str]) -> str:
    if "worm" in kinds:
        return "a worm's thread slides along the wheel, and rolls on no pitch surface"
    if set(kinds) >= {"bevel", "contrate"}:
        return "a bevel and a contrate wheel have no pair of pitch cones"
    return ""


def wheel_specific_parameters(form: ToothForm) -> list[str]:
    """Parameters that tell the two wheels apart."""
    given = {name: getattr(form, name) for name in type(form).model_fields}
    uneven = [name for name, value in given.items() if isinstance(value, tuple) and value[0].value != value[1].value]
    return uneven + [name for name in ("pins",) if name in form.model_fields_set]


def check_order(form: ToothForm, pair: tuple[str, str]) -> None:
    """Raises `GearTrainError` for a form whose wheels differ on a pair that names its ring first."""
    if uneven := wheel_specific_parameters(form):
        ring, pinion = pair
        raise refused(
            f"it is not plain whose {' and '.join(uneven)} is whose",
            f"the pair names its ring '{ring}' first, and these teeth count the ring as the second wheel",
            f"name the pinion first: `pair: [{pinion}, {ring}]`",
        )


def _are_skew(shaft_angle: ShaftAngle) -> bool:
    """Whether the axes of two helical wheels are not parallel."""
    try:
        return shaft_angle() is not None
    except RangeError:
        return True  # they pass each other, as those of helical wheels may


def shaft_angle_of(form: ToothForm, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> float | None:
    """The angle of a bevel pair (rad); None for wheels that mesh as spur wheels do."""
    if {"contrate", "helical"} & set(wheels.kinds):
        return None
    angle = shaft_angle()
    if angle is None and "bevel" in wheels.kinds:
        raise refused(
            f"it cannot have {form.words} teeth",
            "nothing says how the axes of its bevels meet",
            f"declare `axes` with the `direction` of both, or {IDEAL}",
        )
    return angle
