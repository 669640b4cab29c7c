"""Couplings of a link that turns and a link that slides with a constant travel per revolution: racks, screws, drums.

Relative to their carrier, the travel of the sliding link is h times the angle of the turning link in revolutions: h is
the circumference pi m z of a pinion on a rack, minus the lead of a right-hand screw, because a screw that turns forward
draws its nut back, and pi D divided by the number of falls of a line on a drum. Without losses, the torque F h / (2 pi)
balances a force F. For racks and drums this torque does not contain pi.
"""

from __future__ import annotations

from fractions import Fraction
from math import atan, cos, pi, tan
from typing import Annotated, Literal

from pydantic import Field, model_validator

from geartrain.numerics.exact import PI
from geartrain.numerics.plain_values import Boolean, whole_from
from geartrain.numerics.quantity import Angle, MeasuredLength, above_zero, bad, below_right_angle, millimetres
from geartrain.teeth.contact_coefficients import DeclaredCoulombFriction, Efficiencies
from geartrain.teeth.coupling import Coupling

Number = Annotated[int, whole_from(1, 10**6, "teeth or falls")]


class TravelCoupling(Coupling):
    """Coupling of a link that turns and a link that slides: base class of racks, screws, drums and crank sliders."""

    ENDS = ("turns", "slides")
    SIDES = ("slides", "turns")
    HOLDS = True

    turns: str = Field(description="Link that turns: pinion, screw, drum or crank")
    slides: str = Field(description="Link that slides, or the link on which the carrier of the turning link slides")


class Rack(TravelCoupling):
    """Pinion and rack. The travel per revolution is the pitch multiplied by the number of teeth of the pinion."""

    kind: Literal["rack"] = Field(description="Pinion that turns on a rack")
    teeth: Number = Field(description="Tooth count of the pinion")
    module: Annotated[MeasuredLength, above_zero("give a module such as 2 mm")] | None = Field(
        None, description="Module; the pitch is pi times the module"
    )
    pitch: Annotated[MeasuredLength, above_zero("give a pitch such as 5 mm")] | None = Field(
        None, description="Pitch of the rack, instead of the module"
    )
    reversed: Boolean = Field(False, description="True if the rack moves backwards when the pinion turns forwards")

    @model_validator(mode="after")
    def _has_size(self) -> Rack:
        if (self.module is None) == (self.pitch is None):
            raise bad("travel", "a rack needs either `module` or `pitch`", "give one of them, such as `module: 2 mm`")
        return self

    @property
    def mean(self) -> Fraction:
        """Travel of the rack per revolution of the pinion [mm/turn]."""
        pitch = PI * millimetres(self.module) if self.module else millimetres(self.pitch)  # type: ignore[arg-type]
        return pitch * self.teeth * (-1 if self.reversed else 1)


class Screw(TravelCoupling):
    """Screw and nut. The travel per revolution is the lead, whether the screw or the nut turns."""

    kind: Literal["screw"] = Field(description="Screw in a nut; a right-hand screw draws its nut back")
    lead: Annotated[MeasuredLength, above_zero("give a lead such as 6 mm")] = Field(
        description="Travel per revolution, the pitch of the thread times its number of starts"
    )
    hand: Literal["right", "left"] = Field("right", description="Hand of the thread")
    friction: DeclaredCoulombFriction | None = Field(
        None, description="Coefficient of friction of the thread; requires `diameter`; default no loss"
    )
    diameter: Annotated[MeasuredLength, above_zero("give a diameter such as 18 mm")] | None = Field(
        None, description="Mean diameter of the thread"
    )
    flank_angle: Annotated[Angle, below_right_angle("give the angle of one flank, such as 15 deg")] | None = Field(
        None, description="Angle of a flank from the normal to the axis: 0 square, 15 deg trapezoidal; default 0"
    )

    @model_validator(mode="after")
    def _has_thread(self) -> Screw:
        if self.friction is None:
            return self
        if self.efficiency is not None:
            raise bad("travel", "`friction` and `efficiency` of a screw are both given", "remove one of them")
        if self.diameter is None:
            what = "the friction of a screw needs the mean diameter of its thread"
            raise bad("travel", what, "add `diameter`, such as `diameter: 18 mm`")
        if self.lead_angle + self.friction_angle >= pi / 2:
            what = f"a screw with the coefficient of friction {self.friction.sliding.text} cannot move its nut"
            raise bad("travel", what, "give a smaller coefficient, or a smaller lead")
        return self

    @property
    def mean(self) -> Fraction:
        """Travel of the nut per revolution of the screw [mm/turn]; negative for a right-hand thread."""
        return millimetres(self.lead) * (1 if self.hand == "left" else -1)

    @property
    def lead_angle(self) -> float:
        """Lead angle of the thread at the mean diameter [rad]; 0 if no diameter is declared."""
        return 0.0 if self.diameter is None else atan(self.lead.si / (pi * self.diameter.si))

    @property
    def friction_angle(self) -> float:
        """Friction angle of the inclined flanks [rad]: arctan(f / cos(flank angle)), with friction coefficient f."""
        flank = 0.0 if self.flank_angle is None else self.flank_angle.si
        return 0.0 if self.friction is None else atan(float(self.friction.sliding.value) / cos(flank))

    @property
    def losses(self) -> Efficiencies | None:
        """Declared efficiencies or, for the lead angle l and the friction angle r, tan(l) / tan(l + r) if the screw
        drives and tan(l - r) / tan(l) if the nut drives.
        """
        if self.friction is None or self.friction.sliding.value == 0:
            return self.efficiency
        lead, friction = self.lead_angle, self.friction_angle
        turning, pushed = tan(lead) / tan(lead + friction), tan(lead - friction) / tan(lead)
        # 15 digits, so that equal screws have equal fractions
        return Efficiencies.model_validate({"forward": f"{turning:.15g}", "backward": f"{pushed:.15g}"})


class Drum(TravelCoupling):
    """Line on a drum with its load on one or more falls. The travel is the circumference of the drum divided by the
    number of falls.
    """

    kind: Literal["drum"] = Field(description="Line that a drum winds, with a load that slides")
    diameter: Annotated[MeasuredLength, above_zero("give a diameter such as 40 mm")] = Field(
        description="Diameter of the drum plus the thickness of the line"
    )
    falls: Number = Field(1, description="Number of parts of the line that carry the load: 2 with one loose pulley")
    reversed: Boolean = Field(False, description="True if the load moves backwards when the drum turns forwards")

    @property
    def mean(self) -> Fraction:
        """Travel of the load per revolution of the drum [mm/turn]."""
        return PI * millimetres(self.diameter) / self.falls * (-1 if self.reversed else 1)
