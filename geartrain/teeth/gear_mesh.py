"""A gear pair with real teeth, as a train uses it, whatever the tooth form."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

from geartrain.errors import Problem, RangeError
from geartrain.numerics.results import Shown
from geartrain.teeth.meshing_wheels import DeclaredPair, MeshDriver, MeshingWheels, NamedForm, PairSize
from geartrain.teeth.transmission import ExactRatio

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.displaced_contact import DisplacedContact
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.outlines.wheel_outline import BlankSizes, WheelOutline
    from geartrain.teeth.outlines.wheel_requirement import WheelRequirement
    from geartrain.teeth.pair_results import PairAccount, PairVerdict, SlidingEfficiency
    from geartrain.teeth.transmission import TransmissionFunction


@dataclass(frozen=True)
class GearMesh(Shown, ABC):
    """A gear pair with real teeth: all that others ask of it, whatever their form.

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

    wheels: MeshingWheels
    """The two wheels as declared, with their friction."""
    tooth_form: NamedForm
    """The form that made it."""
    who: MeshDriver
    """The wheel that drives, and how that is known."""
    transmission: TransmissionFunction
    """With that wheel driving, forwards; `coast` is that of the other flanks, `reversed` with the other wheel
    driving."""

    def _summary(self) -> str:
        driver, driven = self.counts
        rubs = "" if self.friction is None else f", friction {self.friction:g}"
        wheels = f"{self.driver} ({driver}) drives {self.driven} ({driven})"
        return f"{self.name}: {self.tooth_form.words} teeth, {wheels}{rubs}"

    @property
    def gear(self) -> DeclaredPair:
        """The pair as declared."""
        return self.wheels.gear

    @property
    def name(self) -> str:
        """The name of the pair."""
        return self.gear.name

    @property
    def form(self) -> str:
        """The name of the tooth form."""
        return self.tooth_form.form

    @property
    def place(self) -> str:
        """Where the pair is declared."""
        return self.wheels.place

    @property
    def friction(self) -> float | None:
        """Coefficient of friction; None where none is declared, or a law of speed is."""
        return self.wheels.friction

    @cached_property
    def losses(self) -> TransmissionFunction:
        """The law with what its teeth lose; of friction that depends on a speed that is not known, nothing."""
        return self._rubbed(self.transmission)

    def _rubbed(self, transmission: TransmissionFunction) -> TransmissionFunction:
        if self.wheels.friction_law is None:
            return transmission
        from geartrain.teeth.rubbed_transmission import rubbed

        return rubbed(transmission, self.wheels)

    @property
    def pitch_radius(self) -> float | None:
        """Radius [m] at which the first wheel named rolls on the second; None where nothing gives the pair a size."""
        module, size = self.wheels.module, self.own_size
        stretch = 1.0 if size is None else size.stretch
        return None if module is None else module * self.wheels.counts[0] / 2 * stretch

    @property
    def note(self) -> str:
        """What the form takes the wheels for, where it is not what they are."""
        return self.wheels.note

    @property
    def driver(self) -> str:
        """The wheel that drives, or is taken to where that is not determined."""
        return self.who.wheel

    @property
    def driven(self) -> str:
        """The other wheel."""
        first, second = self.gear.pair
        return second if self.driver == first else first

    @property
    def counts(self) -> tuple[int, int]:
        """Tooth numbers of the driver and of the driven wheel."""
        first, second = self.wheels.counts
        return (first, second) if self.driver == self.gear.pair[0] else (second, first)

    @property
    def gears(self) -> tuple[str, str]:
        """The wheels that the form calls gear 1 and gear 2: as the pair names them, unless the form says otherwise."""
        return self.gear.pair

    @property
    def coast(self) -> TransmissionFunction:
        """The transmission function of the coast flanks, which push while the driver turns back."""
        return self.transmission.reversed_motion()

    @property
    @abstractmethod
    def reversed(self) -> TransmissionFunction:
        """The law with the other wheel driving."""

    @property
    @abstractmethod
    def verdict(self) -> PairVerdict:
        """Whether these teeth can turn."""

    def own_faults(self) -> Iterator[Problem]:
        """Everything that is wrong with these teeth, without pair and place."""
        yield from (fault.problem for fault in self.verdict.faults)
        yield from self.friction_faults()

    def friction_faults(self) -> Iterator[Problem]:
        """That friction locks these teeth, if it does."""
        from geartrain.teeth.pair_results import friction_lock, friction_lock_at_speed

        if self.wheels.friction_law is None:
            if self.transmission.locks:
                yield friction_lock(self.transmission.friction, self.transmission.locking_friction)
        elif self.verdict and self.losses.locks:
            yield friction_lock_at_speed(self.wheels.friction_law.law, self.transmission.locking_friction)

    @abstractmethod
    def size(self, tips: Mapping[str, float]) -> PairSize | None:
        """How large the pair is, and how far apart its axes stand.

        Parameters
        ----------
        tips : mapping of str to float
            Tip radii [module] of wheels that have a size already, for teeth that are similar at any scale.

        Returns
        -------
        PairSize or None
            None where the axes are not parallel.
        """

    @property
    def own_size(self) -> PairSize | None:
        """How large the pair is by itself, with no wheel of another pair to follow; None for axes that meet."""
        return self.size({})

    @property
    def unit_tips(self) -> Mapping[str, float]:
        """Tip radii in the unit of the law, of wheels that have a size only up to a scale; none by default."""
        return {}

    @abstractmethod
    def requirement(self, wheel: str, scale: float, tolerance: float) -> WheelRequirement:
        """The teeth that this pair asks of one of its wheels.

        Parameters
        ----------
        wheel : str
            Name of the wheel.
        scale : float
            Modules in one unit of the law's lengths, as of `size`.
        tolerance : float
            How far a chord may leave a flank [module].

        Returns
        -------
        WheelRequirement
            What can be compared with the demands of the wheel's other pairs, and cut.
        """

    @property
    def path(self) -> PathOfContact | None:
        """The path of contact by which the teeth are designed; None for those that are not designed by one."""
        return None

    @property
    def separation(self) -> float | None:
        """Force between the axes over that along the pitch circles, without friction; None where it is not known."""
        return None

    def wheel_outline(self, gear: int, cut: BlankSizes) -> WheelOutline:
        """The outline of one wheel of the pair, whole, as its form wants it cut.

        Parameters
        ----------
        gear : {1, 2}
            The first or the second wheel that the pair names.
        cut : BlankSizes
            Module, bore, tolerance, and of conjugate teeth what else their roots are cut with.

        Returns
        -------
        WheelOutline
            A tooth stands on the x axis; the two mesh at `centre_distance` where a space of gear 2 faces a tooth of
            gear 1.

        Raises
        ------
        GearTrainError
            Where no such wheel can be cut.
        """
        import numpy as np

        from geartrain.teeth.outlines.contour import Contour
        from geartrain.teeth.outlines.tooth_outline import repeated
        from geartrain.teeth.outlines.wheel_outline import WheelOutline, bore

        size = self.own_size
        scale, tolerance = 1.0 if size is None else size.scale, cut.tolerance / cut.module
        tooth, mate = (self.requirement(name, scale, tolerance).cut() for name in self.gear.pair[:: 3 - 2 * gear])
        z, other = self.wheels.counts[:: 3 - 2 * gear]
        distance = self.wheels.touching if size is None else size.distance
        teeth = Contour.of(repeated(tooth.tooth, z)).scaled(cut.module)
        if tooth.kind == "ring":
            rim = 2 * cut.module if cut.rim is None else cut.rim
            contours = [Contour.circle(tooth.root * cut.module + rim), teeth]
        else:
            contours = [teeth, *bore(cut, tooth.root * cut.module)]
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
        """True for teeth whose manufacturing errors are reckoned tooth by tooth."""
        return False

    @property
    def cut_sizes(self) -> Any:
        """The `TriangularSizes` about which errors are drawn; raises `RangeError` for teeth of another form."""
        why, fix = "these sizes are of straight flanks that meet in a point", "declare `tooth_form: {form: triangular}`"
        raise RangeError(Problem(f"{self.label} has no triangular teeth", why, fix))

    @property
    def displaced_contact(self) -> DisplacedContact | None:
        """The law of displaced flanks along the path of contact, this wheel driving; None for teeth without one."""
        return None

    @abstractmethod
    def account(self) -> PairAccount:
        """What is told of the pair, as it is driven."""

    def backlash_apart(self, gap: float) -> float | None:
        """Play of axes that stand farther apart than declared.

        Parameters
        ----------
        gap : float
            By how much [module]; below 0 they stand too near.

        Returns
        -------
        float or None
            On the pitch circle [module], below 0 where the teeth jam; None for teeth that run as designed at their
            own distance only.
        """
        del gap
        return None

    @property
    def label(self) -> str:
        """The pair as a fault names it."""
        return f"pair '{self.name}'"

    @cached_property
    def faults(self) -> tuple[Problem, ...]:
        """Everything that keeps these teeth from turning, with what would let them; empty if they turn."""
        return tuple(replace(each, what=f"{self.label}: {each.what}", place=self.place) for each in self.own_faults())

    @property
    def fault(self) -> Problem | None:
        """The first of them."""
        return self.faults[0] if self.faults else None

    @property
    def backlash(self) -> float:
        """Play of the teeth, in pitches."""
        return self.verdict.backlash / (self.transmission.period * float(self.transmission.ratio))

    @property
    def stands(self) -> float:
        """Where a tooth of the driven wheel stands when its angle is 0, in pitches past the line of centres."""
        return 0.0

    @property
    def rigid(self) -> bool:
        """True if the pair keeps its ratio at every instant: it adds nothing to any motion but its play."""
        return isinstance(self.transmission, ExactRatio)

    @property
    def rubs(self) -> bool:
        """True if something is lost between these teeth."""
        return bool(self.friction) or self.wheels.friction_law is not None

    @property
    def friction_words(self) -> str:
        """The friction of the pair in words, at the speed at which it runs."""
        declared, at = self.wheels.friction_law, self.wheels.pitch_line
        if declared is None:
            return f"Coefficient of friction {self.transmission.friction:g}"
        if at is None:
            return f"Friction by the law '{declared.law}' of speed, and no speed is known"
        return (
            f"Friction by the law '{declared.law}' at a pitch-line speed of {at:.6g} m/s, with a mean coefficient of "
            f"{self.losses.friction:.6g}"
        )

    def efficiency(self, driver: str) -> SlidingEfficiency:
        """What arrives of the power that one wheel puts in, over a turn.

        Parameters
        ----------
        driver : str
            Name of the wheel that drives.

        Returns
        -------
        SlidingEfficiency
            At constant torque of either side.
        """
        from geartrain.teeth.pair_results import SlidingEfficiency

        return SlidingEfficiency(self.losses if driver == self.driver else self._rubbed(self.reversed))

    @property
    def tells_losses(self) -> bool:
        """True where something says what these teeth lose: a coefficient, or a law and the speed it asks for."""
        return self.friction is not None or (self.rubs and self.wheels.pitch_line is not None)

    @property
    def efficiency_texts(self) -> tuple[str, str]:
        """Mean efficiency as the pair is driven, and driven back; dashes where no friction is declared, or it jams."""
        if not self.tells_losses or not self.verdict:
            return "-", "-"
        return self.efficiency(self.driver).text, self.efficiency(self.driven).text

    def driven_by(self, driver: MeshDriver) -> Self:
        """The same teeth with another wheel driving.

        Parameters
        ----------
        driver : MeshDriver
            The wheel, and how it is known that it drives.

        Returns
        -------
        GearMesh
            With the law of that way.
        """
        transmission = self.transmission if driver.wheel == self.driver else self.reversed
        return replace(self, who=driver, transmission=transmission)

    @property
    def ways(self) -> tuple[Self, ...]:
        """The mesh as it is driven; where that is not determined, both ways."""
        return (self,) if self.who.known else (self, self.driven_by(replace(self.who, wheel=self.driven)))


def find_faults(ways: Sequence[GearMesh]) -> tuple[Problem, ...]:
    """Everything wrong with one pair in the ways it is driven; what is wrong in some ways only says in which."""
    said = [list(way.own_faults()) for way in ways]
    found: list[Problem] = []
    for way, faults in zip(ways, said, strict=True):
        for fault in faults:
            always = all(fault in other for other in said)
            label = way.label if always else f"{way.label}, '{way.driver}' driving"
            placed = replace(fault, what=f"{label}: {fault.what}", place=way.place)
            found += [] if placed in found else [placed]
    return tuple(found)
