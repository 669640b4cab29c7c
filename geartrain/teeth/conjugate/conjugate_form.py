"""What all conjugate tooth forms share: how a declaration gives a pair of wheels, and the pair its law."""

from __future__ import annotations

from abc import abstractmethod
from functools import lru_cache
from math import pi, tau
from typing import TYPE_CHECKING, Self

from pydantic import Field, model_validator

from geartrain.errors import Problem
from geartrain.numerics.quantity import Angle, Figure, Length, Quantity
from geartrain.teeth.conjugate.wheel_pair import WheelPair
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, bad, refused

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair, ConjugateTransmission
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.conjugate.pitch_surfaces import PitchSurfaces
    from geartrain.teeth.gear_mesh import GearMesh, MeshingWheels
    from geartrain.teeth.outlines.wheel_requirement import LanternPins
    from geartrain.teeth.pair_account import PairFigures

_DESIGN = 1e-9  # of a centre distance: nearer to the design is at it


class ConjugateToothForm(ToothForm):
    """A conjugate tooth form: a path of contact for any two wheels, and the thickness of their teeth."""

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
        if self.backlash.value < 0:
            raise bad("backlash", f"backlash {self.backlash.text} would jam the teeth", "write 0 or more")
        if self.centre_distance is not None and self.centre_distance.value <= 0:
            raise bad("length", f"centre_distance {self.centre_distance.text} is no length", "write it above 0")
        return self

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """With those of the path of contact."""
        from geartrain.teeth.conjugate.conjugate_account import ConjugateFigures

        return ConjugateFigures

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """The mesh of a pair, its first wheel driving; a ring is gear 2 of the form in whichever order it is named."""
        from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh

        if why := refusal(wheels.kinds):
            raise refused(f"it cannot have {self.words} teeth", why, IDEAL)
        ring_first = wheels.internal[0]
        if ring_first:
            check_order(self, wheels.gear.pair)
        law = self.law(
            *(wheels.counts[::-1] if ring_first else wheels.counts),
            wheels.friction or 0.0,
            2 if ring_first else 1,
            pitch_distance=wheels.distance,
            internal=any(wheels.internal),
            shaft_angle=self._shaft_angle(wheels, shaft_angle),
        )
        mesh = ConjugateMesh(wheels, self, wheels.driver, law)
        if not mesh.rigid:
            _ = mesh.faults  # teeth too far apart to touch raise: here, where the pair is named
        return mesh

    def _shaft_angle(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> float | None:
        """Of a bevel pair; None for wheels that mesh as spur wheels do."""
        if "contrate" in wheels.kinds:
            return None
        angle = shaft_angle()
        if angle is None and "bevel" in wheels.kinds:
            raise refused(
                f"it cannot have {self.words} teeth",
                "nothing says how the axes of its bevels meet",
                f"declare `axes` with the `direction` of both, or {IDEAL}",
            )
        return angle

    def own_play(self, pair: str) -> Problem | None:
        """Declared play wins over a maker's."""
        if "backlash" not in self.model_fields_set:
            return None
        why = f"it declares {self.backlash.text}, and what is declared wins"
        fix = "leave --backlash out, or take the `backlash` out of the file"
        return Problem(f"pair '{pair}' has a backlash of its own", why, fix)

    def thinned(self, backlash: Quantity) -> Self:
        """The same teeth with this play."""
        return self.model_copy(update={"backlash": backlash})

    def bottom_clearance(self, wheels: WheelPair, gear: int) -> float | None:
        """Room under the mate's tip at the root of gear 1 or 2 (modules); None where the form does not say."""
        del wheels, gear
        return None

    def play_apart(self, wheels: WheelPair, gap: float) -> float | None:
        """Play on the pitch circle (modules) of axes that stand `gap` modules too far apart; below 0 they jam.

        None for forms that do not run there as they do at home.
        """
        del wheels, gap
        return None

    def lantern_pins(self, wheels: WheelPair) -> LanternPins | None:
        """The round pins that one wheel has for teeth; None where both have teeth."""
        del wheels
        return None

    @abstractmethod
    def pair(self, wheels: WheelPair) -> ConjugatePair:
        """The pair of wheels as designed, whatever their distance. Raises `GearTrainError` where there is none."""

    def path(
        self,
        z1: int,
        z2: int,
        *,
        internal: bool = False,
        shaft_angle: float | None = None,
        pitch_distance: float | None = None,
    ) -> PathOfContact:
        """The path of contact; `internal`: the second wheel is a ring; `shaft_angle` rad for bevels.

        pitch_distance   m: half the module of each wheel times its teeth, summed, for a ring too
        """
        return conjugate_pair_of(self, _wheels(z1, z2, internal, shaft_angle, pitch_distance)).path

    def law(
        self,
        z1: int,
        z2: int,
        friction: float = 0.0,
        driver: int = 1,
        direction: int = 1,
        pitch_distance: float | None = None,
        internal: bool = False,
        shaft_angle: float | None = None,
    ) -> ConjugateTransmission | OffDesignTransmission:
        """The transmission law of a pair. `driver` 2 lets the second wheel drive, `direction` -1 turns backwards.

        pitch_distance, internal, shaft_angle   as in `path`
        Raises `GearTrainError` where the form gives no such pair; the law's `verdict` says whether a pair can run.
        """
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission

        wheels = _wheels(z1, z2, internal, shaft_angle, pitch_distance)
        pair, distance = conjugate_pair_of(self, wheels), self.misplaced(wheels)
        if distance is None:
            return ConjugateTransmission(pair, friction, driver, direction)
        from geartrain.teeth.conjugate.off_design import OffDesignTransmission

        return OffDesignTransmission(pair, distance, friction, driver, direction)

    def misplaced(self, wheels: WheelPair) -> float | None:
        """The declared centre distance in modules, where it is not the design's; else None.

        Raises `GearTrainError` for bevel wheels, which have none.
        """
        if self.centre_distance is None:
            return None
        if wheels.bevel:
            raise refused("bevel wheels have no centre distance", "their axes meet", "leave out centre_distance")
        given, design = wheels.modules(self.centre_distance, "centre_distance"), wheels.distance
        return given if abs(given - design) > _DESIGN * design else None

    def standard(self, path: PathOfContact, wheels: WheelPair) -> ConjugatePair:
        """A pair whose teeth share the pitch equally, less half the backlash each."""
        from geartrain.teeth.conjugate.conjugate_transmission import ConjugatePair

        half = path.pitch.p / 4 - self.play(path.pitch, wheels) / 4
        return ConjugatePair(path, (half, half))

    def play(self, pitch: PitchSurfaces, wheels: WheelPair) -> float:
        """The declared backlash as X: of a bevel pair a module is p / pi on the unit sphere."""
        return wheels.modules(self.backlash, "backlash") * pitch.p / pi


def _wheels(z1: int, z2: int, internal: bool, shaft_angle: float | None, pitch_distance: float | None) -> WheelPair:
    module = None if pitch_distance is None or z1 + z2 < 1 else 2 * pitch_distance / (z1 + z2)
    return WheelPair(z1, z2, internal, shaft_angle, module)


@lru_cache(maxsize=1024)
def conjugate_pair_of(form: ConjugateToothForm, wheels: WheelPair) -> ConjugatePair:
    """The pair of a form, made once."""
    return form.pair(wheels)


def arcs_of(figures: tuple[Figure, Figure], pitch: PitchSurfaces) -> tuple[float, float]:
    """Arcs declared in pitches, as X."""
    return float(figures[0].value) * pitch.p, float(figures[1].value) * pitch.p


def check_arcs(arcs: tuple[Figure, Figure]) -> None:
    """Raises pydantic's error for arcs that are none."""
    if min(arc.value for arc in arcs) < 0 or sum(arc.value for arc in arcs) <= 0:
        text = ", ".join(arc.text for arc in arcs)
        raise bad("arcs", f"arcs [{text}] are none", "give those of approach and recess in pitches, a pitch in all")


def check_angle(name: str, angle: Angle, below: float = 0.25) -> None:
    """Raises pydantic's error for a pressure angle outside 0 to `below` of a turn, an eighth or a quarter."""
    turns = angle.si / tau
    if not 0 < turns < below:
        raise bad(
            "pressure_angle",
            f"{name} {angle.text} is outside 0 to {360 * below:g} deg",
            f"a pressure angle of these teeth lies between 0 and {360 * below:g} deg; 20 deg is usual",
        )


def refusal(kinds: tuple[str, str]) -> str:
    """Why a pair cannot have conjugate teeth; empty if it can."""
    if "worm" in kinds:
        return "a worm's thread slides along the wheel, and rolls on no pitch surface"
    if set(kinds) >= {"bevel", "contrate"}:
        return "a bevel and a contrate wheel have no pair of pitch cones"
    return ""


def wheel_specific_parameters(form: ConjugateToothForm) -> list[str]:
    """Parameters that tell the two wheels apart."""
    given = {name: getattr(form, name) for name in type(form).model_fields}
    uneven = [name for name, value in given.items() if isinstance(value, tuple) and value[0].value != value[1].value]
    return uneven + [name for name in ("pins",) if name in form.model_fields_set]


def check_order(form: ConjugateToothForm, pair: tuple[str, str]) -> None:
    """Raises `GearTrainError` for a form whose wheels differ on a pair that names its ring first."""
    if uneven := wheel_specific_parameters(form):
        ring, pinion = pair
        raise refused(
            f"it is not plain whose {' and '.join(uneven)} is whose",
            f"the pair names its ring '{ring}' first, and these teeth count the ring as the second wheel",
            f"name the pinion first: `pair: [{pinion}, {ring}]`",
        )
