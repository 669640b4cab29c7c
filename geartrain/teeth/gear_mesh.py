"""Gear pair of a train with the tooth geometry of any tooth form."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Pictured, Shown
from geartrain.teeth.meshing_wheels import DeclaredPair, MeshDriver, MeshingWheels, NamedForm, PairSize
from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.outlines.wheel_requirement import WheelRequirement
    from geartrain.teeth.pair_results import PairAccount, PairVerdict, SlidingEfficiency
    from geartrain.teeth.tooth_transmission import ToothTransmission
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True)
class GearMesh(Pictured, Shown, ABC):
    """Gear pair of a train with its tooth geometry, for any tooth form except ideal teeth. Trains, reports and
    exports access the teeth through this interface.

    See Also
    --------
    geartrain.GearTrain.meshes : the pairs of a train.

    Examples
    --------
    >>> import geartrain
    >>> mesh = geartrain.load("sorge-pairs").meshes[0]
    >>> mesh.form, mesh.counts, mesh.verdict.text, mesh.transmission.ratio
    ('triangular', (48, 96), 'the wheels turn', Fraction(1, 2))
    """

    PAGE = "report.pair_page:describe_pair"
    FIGURE = "drawing.transmission_curves:mesh_figure"

    wheels: MeshingWheels
    """The two wheels as declared, with their friction."""
    tooth_form: NamedForm
    """Tooth form of the pair."""
    who: MeshDriver
    """Name of the driving wheel, and how the driver was determined."""
    transmission: ToothTransmission
    """Transmission function of the pair while the driving wheel turns forwards.

    `coast` is the transmission function of the coast flanks, and `reversed` the transmission function with the other
    wheel driving.
    """

    def _summary(self) -> str:
        driver, driven = self.counts
        has_friction = "" if self.friction is None else f", friction {self.friction:g}"
        wheels = f"{self.driver} ({driver}) drives {self.driven} ({driven})"
        return f"{self.name}: {self.tooth_form.words} teeth, {wheels}{has_friction}"

    @property
    def gear(self) -> DeclaredPair:
        """Declared gear pair."""
        return self.wheels.gear

    @property
    def name(self) -> str:
        """Name of the pair."""
        return self.gear.name

    @property
    def form(self) -> str:
        """Name of the tooth form."""
        return self.tooth_form.form

    @property
    def place(self) -> str:
        """Location of the pair's declaration in its file."""
        return self.wheels.place

    @property
    def friction(self) -> float | None:
        """Coefficient of friction; None if none is declared, or if friction depends on speed."""
        return self.wheels.friction

    @cached_property
    def losses(self) -> TransmissionFunction:
        """Transmission function of the pair, including the friction losses of the teeth.

        The function has no losses if friction depends on a speed that is not known.
        """
        return self._with_friction(self.transmission)

    def _with_friction(self, transmission: TransmissionFunction) -> TransmissionFunction:
        if self.wheels.friction_law is None:
            return transmission
        from geartrain.teeth.rubbed_transmission import RubbedTransmission, pair_friction

        by = pair_friction(self.wheels)
        return transmission if by is None else RubbedTransmission(transmission, by)

    @property
    def pitch_radius(self) -> float | None:
        """Working pitch radius of the first wheel of the pair [m]; None if no lengths are declared."""
        module, size = self.wheels.module, self.own_size
        stretch = 1.0 if size is None else size.stretch
        return None if module is None else module * self.wheels.counts[0] / 2 * stretch

    @property
    def note(self) -> str:
        """Note on a wheel that is treated as a wheel of another kind, such as a contrate wheel; "" if there is none."""
        return self.wheels.note

    @property
    def driver(self) -> str:
        """Name of the driving wheel, or of the wheel that is assumed to drive."""
        return self.who.wheel

    @property
    def driven(self) -> str:
        """Name of the driven wheel."""
        first, second = self.gear.pair
        return second if self.driver == first else first

    @property
    def counts(self) -> tuple[int, int]:
        """Tooth numbers of the driver and of the driven wheel."""
        first, second = self.wheels.counts
        return (first, second) if self.driver == self.gear.pair[0] else (second, first)

    @property
    def gears(self) -> tuple[str, str]:
        """Names of gears 1 and 2 of the tooth form: the wheels of the pair in order, unless the form swaps them."""
        return self.gear.pair

    @property
    def coast(self) -> TransmissionFunction:
        """Transmission function of the coast flanks, which are in contact while the driver turns backwards."""
        return self.transmission.reversed_motion()

    @cached_property
    def reversed(self) -> ToothTransmission:
        """Transmission function for the case that the other wheel drives."""
        return self.transmission.reversed

    @property
    def verdict(self) -> PairVerdict:
        """Verdict on whether the teeth of the pair can run."""
        return self.transmission.verdict

    def own_faults(self) -> Iterator[Problem]:
        """Yield all faults of the teeth. The messages do not mention the pair or its file."""
        yield from (fault.problem for fault in self.verdict.faults)
        yield from self.friction_faults()

    def friction_faults(self) -> Iterator[Problem]:
        """Yield a fault if friction locks the teeth of the pair."""
        from geartrain.teeth.pair_results import friction_lock, friction_lock_at_speed

        if self.wheels.friction_law is None:
            if self.transmission.locks:
                yield friction_lock(self.transmission.friction, self.transmission.locking_friction)
        elif self.verdict and self.losses.locks:
            yield friction_lock_at_speed(self.wheels.friction_law.law, self.transmission.locking_friction)

    @abstractmethod
    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """Return the size of the pair with its centre distance.

        Parameters
        ----------
        tips : mapping of str to float
            Tip radii [module] of wheels whose size is already known. They determine the scale of teeth that have no
            declared size.

        Returns
        -------
        PairSize or None
            Size; None if the axes are not parallel.
        """

    @property
    def own_size(self) -> PairSize | None:
        """Size of the pair without regard to other pairs of its wheels; None for intersecting axes."""
        return self.size({})

    @property
    def unit_tips(self) -> Mapping[str, float]:
        """Tip radius of each wheel in the length unit of the teeth, keyed by wheel; empty if the teeth have a declared
        size.
        """
        return {}

    @abstractmethod
    def requirement(self, wheel: str, scale: float, tolerance: float) -> WheelRequirement:
        """Return the requirements of this pair for the teeth of one of its wheels.

        Parameters
        ----------
        wheel : str
            Name of the wheel.
        scale : float
            Length unit of the tooth data, in modules, as returned by `size`.
        tolerance : float
            Maximum distance of a chord from a flank [module].

        Returns
        -------
        WheelRequirement
            Required tooth data of the wheel, used for cutting and to compare the requirements of all its pairs.
        """

    @property
    def path(self) -> PathOfContact | None:
        """Path of contact of the designed teeth [module; bevel: rad]; None for forms without a path of contact."""
        return None

    @property
    def separation(self) -> float | None:
        """Separating force between the axes divided by the tangential force, without friction; None if unknown."""
        return None

    def wheel_outline(self, gear: int, cut: BlankSizes) -> WheelOutline:
        """Return the closed outline to which one wheel of the pair is cut.

        Parameters
        ----------
        gear : {1, 2}
            First or second wheel of the pair.
        cut : BlankSizes
            Module, bore and tolerance, and for conjugate teeth the sizes with which their roots are cut.

        Returns
        -------
        WheelOutline
            Outline with a tooth on the x axis. The two wheels mesh at `centre_distance` if a tooth space of gear 2
            faces a tooth of gear 1.

        Raises
        ------
        GearTrainError
            If no such wheel can be cut.
        """
        import numpy as np

        from geartrain.teeth.outlines.contour import Contour
        from geartrain.teeth.outlines.tooth_outline import repeated
        from geartrain.teeth.outlines.wheel_outline import WheelOutline, blank_contours

        size = self.own_size
        scale, tolerance = 1.0 if size is None else size.scale, cut.tolerance / cut.module
        # a step of -1 swaps the two wheels for gear 2
        tooth, mate = (self.requirement(name, scale, tolerance).cut() for name in self.gear.pair[:: 3 - 2 * gear])
        z, other = self.wheels.counts[:: 3 - 2 * gear]
        distance = self.wheels.touching if size is None else size.distance
        contours = blank_contours(Contour.of(repeated(tooth.tooth, z)), tooth.kind, tooth.root, cut)
        # the thickness at the pitch circle is interpolated on one flank of the flattened tooth
        points = Contour.of((*tooth.tooth[:-1], (*tooth.tooth[-1][:2], 0.0))).flattened(tolerance)
        side = points[points[:, 1] >= 0]
        side = side[np.argsort(np.hypot(*side.T))]
        half = float(np.interp(z / 2, np.hypot(*side.T), np.arctan2(side[:, 1], side[:, 0])))
        return WheelOutline(
            gear=gear,
            z=z,
            kind=tooth.kind,
            contours=tuple(contours),
            module=cut.module,
            pitch_radius=z / 2 * cut.module,
            tip_radius=tooth.tip * cut.module,
            root_radius=tooth.root * cut.module,
            thickness=half * z * cut.module,
            fillet=0.0,
            relief=0.0,
            clearance=(distance - mate.tip - tooth.root) * cut.module,
            backlash=self.verdict.backlash * (z if self.driven == self.gear.pair[gear - 1] else other) / 2 * cut.module,
            centre_distance=distance * cut.module,
            tolerance=cut.tolerance,
        )

    @property
    def has_cut_sizes(self) -> bool:
        """True for a tooth form whose manufacturing errors are modelled tooth by tooth."""
        return False

    @property
    def cut_sizes(self) -> Any:
        """Nominal sizes of triangular teeth, as `TriangularSizes`. Raises `RangeError` for other tooth forms."""
        why, fix = "cutting errors are modelled for triangular teeth only", "declare `tooth_form: {form: triangular}`"
        raise RangeError(Problem(f"{self.label} has no triangular teeth", why, fix))

    @property
    def displaced_contact(self) -> DisplacedContact | None:
        """Contact of displaced flanks for the given driving wheel; None if the tooth form has no such model."""
        return None

    @abstractmethod
    def account(self) -> PairAccount:
        """Return the report of the pair with its actual driver: table rows and results."""

    def backlash_apart(self, gap: float) -> float | None:
        """Return the backlash at a centre distance other than the declared one.

        Parameters
        ----------
        gap : float
            Distance by which the wheels are too far apart [module], negative if they are too close. In an internal
            pair, the wheels are too far apart if the centre distance is too short.

        Returns
        -------
        float or None
            Backlash on the pitch circle [module], negative if the teeth jam. None for teeth that run as designed only
            at their own centre distance.
        """
        del gap
        return None

    @property
    def label(self) -> str:
        """Name of the pair as used in messages."""
        return f"pair '{self.name}'"

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """All faults that prevent the teeth from running, each with its remedy; empty if the teeth can run."""
        return tuple(replace(each, what=f"{self.label}: {each.what}", place=self.place) for each in self.own_faults())

    @property
    def fault(self) -> Problem | None:
        """First of the `faults` that prevent the teeth of the pair from running; None if the teeth can run."""
        return self.faults[0] if self.faults else None

    @property
    def backlash(self) -> float:
        """Backlash of the teeth [pitch]."""
        # the driver's pitch times the ratio is the angular pitch of the driven wheel
        return self.verdict.backlash / (self.transmission.pitch * float(self.transmission.ratio))

    @property
    def has_shape(self) -> bool:
        """True if the tooth form defines the shape of the teeth; False if standard teeth are cut and drawn instead."""
        return self.tooth_form.has_shape

    @property
    def tooth_phase(self) -> float:
        """Distance [pitch] of a driven tooth past the line of centres when the angle of the driven wheel is 0."""
        return 0.0

    @property
    def rigid(self) -> bool:
        """True if the speed ratio is constant, so that only backlash makes the transmitted motion nonuniform."""
        return isinstance(self.transmission, ExactRatio)

    @property
    def has_friction(self) -> bool:
        """True if a coefficient of friction above 0 or a friction law is declared."""
        return bool(self.friction) or self.wheels.friction_law is not None

    @property
    def friction_words(self) -> str:
        """Statement of the friction of the pair, without a full stop. It gives the coefficient, or the friction law,
        its mean coefficient and the pitch-line speed if that speed is known.
        """
        declared, at = self.wheels.friction_law, self.wheels.pitch_line
        if declared is None:
            return f"Coefficient of friction {self.transmission.friction:g}"
        if at is None:
            return f"Friction by the law '{declared.law}', which needs a speed, and the speed is not known"
        return (
            f"Friction by the law '{declared.law}' at a pitch-line speed of {at:.6g} m/s, with a mean coefficient of "
            f"{self.losses.friction:.6g}"
        )

    def efficiency(self, driver: str) -> SlidingEfficiency:
        """Return the efficiency of the pair, averaged over a revolution, with one of its wheels driving.

        Parameters
        ----------
        driver : str
            Name of the driving wheel.

        Returns
        -------
        SlidingEfficiency
            Mean efficiencies, at constant torque on either side.
        """
        from geartrain.teeth.pair_results import SlidingEfficiency

        return SlidingEfficiency(self.losses if driver == self.driver else self._with_friction(self.reversed))

    @property
    def computes_losses(self) -> bool:
        """True if the friction losses of the pair can be computed.

        The computation needs a declared coefficient, or a friction law and the pitch-line speed.
        """
        return self.friction is not None or (self.has_friction and self.wheels.pitch_line is not None)

    @property
    def efficiency_texts(self) -> tuple[str, str]:
        """Texts with the mean efficiency for the actual driver and for the other wheel as driver.

        Both strings are "-" if the losses cannot be computed or the teeth cannot run.
        """
        if not self.computes_losses or not self.verdict:
            return "-", "-"
        return self.efficiency(self.driver).text, self.efficiency(self.driven).text

    def driven_by(self, driver: MeshDriver) -> Self:
        """Return the same pair with the given driving wheel.

        Parameters
        ----------
        driver : MeshDriver
            Driving wheel, and how it was determined.

        Returns
        -------
        GearMesh
            Copy with the transmission function for this driver.
        """
        transmission = self.transmission if driver.wheel == self.driver else self.reversed
        return replace(self, who=driver, transmission=transmission)

    @property
    def ways(self) -> tuple[Self, ...]:
        """Meshes to examine for faults: this mesh, or one for each wheel as the driver if the driver is not known."""
        return (self,) if self.who.known else (self, self.driven_by(replace(self.who, wheel=self.driven)))


def find_faults(ways: Sequence[GearMesh]) -> tuple[Problem, ...]:
    """Return all faults of one gear pair. `ways` are its meshes with each of the wheels that may drive.

    A fault that occurs with only one of the drivers names that driver.
    """
    said = [list(way.own_faults()) for way in ways]
    found: list[Problem] = []
    for way, faults in zip(ways, said, strict=True):
        for fault in faults:
            always = all(fault in other for other in said)
            label = way.label if always else f"{way.label}, '{way.driver}' driving"
            placed = replace(fault, what=f"{label}: {fault.what}", place=way.place)
            # a fault that occurs with both drivers has the same label twice, and is listed once
            found += [] if placed in found else [placed]
    return tuple(found)
