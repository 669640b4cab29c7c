"""Cycloidal reducers: a lobed disc in a ring of round pins that has one pin more than the disc has lobes."""

from __future__ import annotations

from math import pi, sin
from typing import TYPE_CHECKING, ClassVar, Literal

from pydantic import Field, model_validator

from geartrain.errors import Problem
from geartrain.numerics.quantity import Length, Quantity, bad
from geartrain.teeth.tooth_form import IDEAL, ShaftAngle, ToothForm, check_above_0, in_modules, refused

if TYPE_CHECKING:
    from geartrain.teeth.cycloidal_disc import CycloidalDisc, DiscTransmission
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.teeth.meshing_wheels import MeshingWheels
    from geartrain.teeth.pair_results import PairFigures

_SHORTENING = 0.7  # default pitch radius of the ring divided by the radius of the pin circle
_PIN_SPACING = 1.7  # default distance between two pins divided by the diameter of a pin


class PinRing(ToothForm):
    """Lobed disc of a cycloidal reducer in a ring of round pins, which has one pin more than the disc has lobes.

    The speed ratio is constant. Half of all pins carry load, or fewer if `clearance` and `deflection` are given. The
    centre of the disc is half a module from the centre of the ring, so that the module is twice the eccentricity
    (docs/reducers.md).

    See Also
    --------
    geartrain.teeth.Lantern : pins on an external wheel.

    Examples
    --------
    >>> disc = PinRing(form="pin_ring").disc(11)
    >>> round(disc.circle, 3), round(disc.pin, 3), round(disc.maximum_load, 3)
    (8.571, 1.305, 0.335)
    """

    ringed: ClassVar[bool] = True
    own_play: ClassVar[tuple[str, ...]] = ("clearance",)

    form: Literal["pin_ring"] = Field(description="Name of the tooth form")
    pin_circle: Length | None = Field(
        None,
        description="Radius of the circle through the pins' centres, in modules or with a unit; default the ring's "
        "pitch radius divided by 0.7",
    )
    pin_diameter: Length | None = Field(
        None,
        description="Diameter of the pins, in modules or with a unit; default the distance between two pins divided "
        "by 1.7, or less if such pins would undercut the lobes",
    )
    clearance: Length = Field(
        "0",
        validate_default=True,
        description="Distance by which the disc is set back from every pin, in modules or with a unit",
    )
    deflection: Length | None = Field(
        None,
        description="Deflection of one pin under the whole force on the disc's pitch circle, in modules or with a "
        "unit; it determines the number of pins that bear load despite a clearance; default half of all pins bear "
        "load",
    )

    @model_validator(mode="after")
    def _check_lengths(self) -> PinRing:
        check_above_0(self, "length", "pin_circle", "pin_diameter", "deflection")
        if self.clearance.value < 0:
            raise bad("length", f"a clearance of {self.clearance.text} would jam the disc", "give 0 or more")
        return self

    @classmethod
    def figures(cls) -> type[PairFigures]:
        """Return the class of the results of this form, which includes the loads on the pins."""
        from geartrain.teeth.cycloidal_disc import DiscFigures

        return DiscFigures

    def disc(self, lobes: int, module: float | None = None) -> CycloidalDisc:
        """Return the lobed disc and its pins.

        Parameters
        ----------
        lobes : int
            Number of lobes of the disc, 3 or more.
        module : float, optional
            Module [m], required for lengths that are declared with a unit.

        Returns
        -------
        CycloidalDisc
            Disc, with lengths in modules.

        Raises
        ------
        GearTrainError
            If no disc with these sizes exists.
        """
        from geartrain.teeth.cycloidal_disc import CycloidalDisc

        pins = lobes + 1
        if lobes < 3:
            why = "with fewer than 3 lobes, too few pins press on the disc"
            raise refused(f"a disc of {lobes} lobes cannot run", why, "give 3 lobes or more")
        circle = pins / 2 / _SHORTENING if self.pin_circle is None else self._modules("pin_circle", module)
        if circle <= pins / 2:
            what = f"pins at {circle:.6g} modules from the axis are on or inside the pitch circle"
            why = f"its radius is {pins / 2:.6g} modules, and the path of a pin would have cusps or loops"
            raise refused(what, why, "give a larger pin_circle, or a smaller module (twice the eccentricity)")
        apart = 2 * circle * sin(pi / pins)
        # the curve of the pin centres, and so its curvature, does not depend on the pin radius
        found = CycloidalDisc(lobes, circle, 0.0)
        # a margin of 10 % keeps the default pins from undercutting the lobes
        usual = min(apart / _PIN_SPACING / 2, 0.9 * found.sharpest)
        pin = usual if self.pin_diameter is None else self._modules("pin_diameter", module) / 2
        if 2 * pin >= apart:
            what = f"pins of {2 * pin:.6g} modules touch each other"
            raise refused(
                what, f"their centres are {apart:.6g} modules apart", f"give a pin_diameter below {apart:.5g} modules"
            )
        back = self._modules("clearance", module)
        if pin + back >= found.sharpest:
            bend = f"the path of their centres has a minimum radius of curvature of {found.sharpest:.6g} modules"
            why = f"{bend}, and the pin radius and the clearance together must be smaller"
            fix = f"give a pin_diameter below {2 * (found.sharpest - back):.5g} modules, or a larger pin_circle"
            raise refused(f"pins of {2 * pin:.6g} modules undercut the lobes", why, fix)
        yielding = None if self.deflection is None else self._modules("deflection", module)
        return CycloidalDisc(lobes, circle, pin, back, yielding)

    def _modules(self, name: str, module: float | None) -> float:
        return in_modules(getattr(self, name), module, name)

    def transmission(
        self, z1: int, z2: int, friction: float = 0.0, driver: int = 1, module: float | None = None
    ) -> DiscTransmission:
        """Return the transmission function of a disc and its ring.

        Parameters
        ----------
        z1, z2 : int
            Number of lobes of the disc, and number of pins of the ring, which is larger by one.
        friction : float
            Coefficient of friction of pins that do not roll, 0 or more.
        driver : {1, 2}
            Number of the driving wheel, in the reference frame of the eccentric.
        module : float, optional
            Module [m], required for lengths that are declared with a unit.

        Returns
        -------
        DiscTransmission
            Transmission function with a constant ratio.

        Raises
        ------
        GearTrainError
            If no disc with these sizes exists.
        """
        from geartrain.teeth.cycloidal_disc import DiscTransmission

        if z2 != z1 + 1:
            rule = "the ring must have one pin more than the disc has lobes"
            why = f"{rule}, so that each turn of the eccentric advances the disc by one pin pitch"
            raise refused(f"a disc with {z1} lobes does not mesh with {z2} pins", why, f"give the ring {z1 + 1} pins")
        return DiscTransmission(self.disc(z1, module), friction, driver)

    def mesh(self, wheels: MeshingWheels, shaft_angle: ShaftAngle) -> GearMesh:
        """Return the mesh of a disc and its ring. The pair may name them in either order."""
        from geartrain.teeth.cycloidal_disc import DiscMesh

        del shaft_angle
        if set(wheels.kinds) != {"spur"} or sum(wheels.internal) != 1:
            why = "the disc is an external spur wheel and its ring an internal one"
            fix = f"declare `internal: true` for the ring, or {IDEAL}"
            raise refused("these wheels are not a disc and a ring", why, fix)
        first = 2 if wheels.internal[0] else 1
        z1, z2 = wheels.counts[:: 3 - 2 * first]
        transmission = self.transmission(z1, z2, wheels.friction or 0.0, first, wheels.module)
        return DiscMesh(wheels, self, wheels.driver, transmission)

    def own_backlash(self, pair: str) -> Problem | None:
        """Return the reason why `--backlash` does not apply to the pair: it declares a clearance above 0. None without
        one.
        """
        return super().own_backlash(pair) if self.clearance.value else None

    def thinned(self, backlash: Quantity) -> PinRing:
        """Return a copy whose `clearance` between lobes and pins is half the required backlash."""
        # both flanks are set back, so the backlash is twice the clearance
        half = f"{float(backlash.value) / 2!r} {backlash.unit or ''}".strip()
        return self.model_copy(update={"clearance": Quantity.parse(half, "length", plain=True)})
