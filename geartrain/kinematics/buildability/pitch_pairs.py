"""Gear pairs as whoever lays them out sees them: axes, kinds, and the distance at which their pitch circles touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from geartrain.errors import GearTrainError
from geartrain.kinematics.circuits import Axes, Circuit, Tree
from geartrain.numerics.quantity import millimetres

if TYPE_CHECKING:
    from geartrain.teeth.tooth_form import ToothForm
    from geartrain.train import Train, Wheel

SLACK = Fraction(1, 50)
"""Modules by which a distance may be off in any mesh: less than the play of any teeth that are cut."""

SHIFT = Fraction(1, 2)
"""Modules that shifted profiles gain or take without spoiling a pair of involute wheels."""

_FREE = Fraction(
    1, 40
)  # of a distance: what wheels of no declared size may differ by, as if cut at pitches of their own
_LOOSE = Fraction(1, 20)  # of a distance: teeth that run at any distance and have sizes of their own


class PairOutline(NamedTuple):
    """A pair with declared teeth as it is cut: distance of its axes, tip radius by wheel (transverse modules)."""

    distance: float
    tips: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class PitchPair:
    """A gear pair with what its declaration says of sizes. Pairs hold what belongs to the first and the second wheel.

    axes      labels, as the carrier sees them
    parallel  True if those have one direction
    ring      index of the wheel that is a ring; None for an external pair
    form      its teeth, its own or the train's; None where none are declared, or ideal ones
    """

    name: str
    place: str
    wheels: tuple[str, str]
    declared: tuple[Wheel, Wheel]
    axes: tuple[str, str]
    parallel: bool
    ring: int | None
    form: ToothForm | None

    @property
    def counts(self) -> tuple[int, int]:
        """Tooth counts."""
        return self.declared[0].count or 0, self.declared[1].count or 0

    @property
    def kinds(self) -> tuple[str, str]:
        """How the teeth of the two stand."""
        return self.declared[0].kind, self.declared[1].kind

    @property
    def is_crossed(self) -> bool:
        """True for spur wheels on axes that are not parallel, one at least with a helix angle: crossed helical ones."""
        return not self.parallel and any(wheel.is_helical for wheel in self.declared)

    @property
    def modules(self) -> tuple[Fraction | None, Fraction | None]:
        """Declared modules (mm)."""
        first, second = (None if wheel.module is None else millimetres(wheel.module) for wheel in self.declared)
        return first, second

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Its axes, the same for all pairs between them."""
        return min(self.axes), max(self.axes)

    @property
    def has_distance(self) -> bool:
        """True for spur wheels on parallel axes: module and tooth counts give the distance of these."""
        return self.parallel and self.kinds == ("spur", "spur") and self.touching > 0

    @property
    def touching(self) -> Fraction:
        """Distance (modules) at which pitch circles touch: (z1 + z2)/2, or the ring's z less its mate's, over 2.

        Over the cosine of the helix angle, where there is one.
        """
        first, second = (Fraction(wheel.count or 0, 2) for wheel in self.declared)
        if self.declared[0].is_helical:  # a module is that of the section across the teeth
            first, second = (half * Fraction(self.declared[0].slant) for half in (first, second))
        if self.ring is None:
            return first + second
        return first - second if self.ring == 0 else second - first

    @property
    def distance(self) -> Fraction:
        """Distance (modules) that the teeth are designed for: where they touch, unless their form says another."""
        form = self.form
        own = getattr(form, "centre_distance", None) if form is not None and form.conjugate else None
        module = self.modules[0] or self.modules[1]
        if own is not None and (own.unit is None or module):
            return own.value if own.unit is None else millimetres(own) / (module or 1)
        return self.touching if form is None else _shifted(self, form)

    @property
    def bounds(self) -> tuple[Fraction, Fraction]:
        """Least and greatest distance (modules) at which such teeth can be made to run, if not as well.

        Where no teeth are declared, their profiles may be shifted; and where no size is declared either, wheels of
        nearly one size have been cut at pitches of their own. Declared involutes run where they have more play.
        """
        wanted, form = self.distance, self.form
        low = high = SLACK
        if form is None:
            sized = self.modules != (None, None)
            low = high = low + (SHIFT if sized else max(SHIFT, _FREE * wanted))
        elif form.any_distance and form.conjugate:
            low, high = (low + SHIFT, high) if self.ring is not None else (low, high + SHIFT)
        elif form.any_distance:
            low = high = _LOOSE * wanted
        return wanted - low, wanted + high


def _shifted(pair: PitchPair, form: ToothForm) -> Fraction:
    """Distance (modules) without play: that of the pitch circles, but for involutes whose profiles are shifted."""
    from geartrain.teeth.involute import Involute

    if not isinstance(form, Involute) or not any(figure.value for figure in form.shift):
        return pair.touching
    from geartrain.teeth.conjugate.wheel_pair import WheelPair

    lean = pair.declared[0].helix if pair.declared[0].is_helical else 0.0
    counts = pair.counts[::-1] if pair.ring == 0 else pair.counts
    unplaced = form.model_copy(update={"centre_distance": None})
    try:
        wheels, slant = WheelPair(*counts, internal=pair.ring is not None, helix=abs(lean)), pair.declared[0].slant
        return Fraction(unplaced.involutes(wheels).distance * slant)
    except GearTrainError:  # there are no such teeth, as is said of them
        return pair.touching


def pitch_pairs(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> tuple[PitchPair, ...]:
    """All gear pairs, in the order declared."""
    axes = Axes(train, tree)
    gears = {gear.name: (at, gear) for at, gear in enumerate(train.gears)}
    found = []
    for circuit in circuits:
        if circuit.kind != "gear":
            continue
        at, gear = gears[circuit.id]
        first, second = (train.wheels[wheel][1] for wheel in circuit.wheels)
        form = train.form_of(gear)
        labels = tree.axis_seen_from(circuit.carrier, circuit.i), tree.axis_seen_from(circuit.carrier, circuit.j)
        found.append(
            PitchPair(
                circuit.id,
                train.place("gears", at),
                circuit.wheels,
                (first, second),
                labels,
                axes.are_parallel(labels),
                0 if first.internal else 1 if second.internal else None,
                None if form is None or form.form == "ideal" else form,
            )
        )
    return tuple(found)
