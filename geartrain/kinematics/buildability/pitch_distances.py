"""Checks of modules and centre distances: wheels in mesh have the same module, and two axes have one centre distance.

Modules and distances are stored as multiples of each other. Wheels in mesh have the same module (relation 1). The
distance between two axes is k times the module of each pair between them, where k = (z1 + z2)/2 or (z_ring - z)/2 and z
are tooth counts (relation 2). Declared modules, positions and offsets give values in mm. These relations are stored in
a weighted union-find structure with exact fractions. A relation between quantities that are already related is compared
with the known relation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import count
from math import acos, asin, atan, cos, inf, radians, sqrt, tan
from typing import TYPE_CHECKING, NamedTuple

from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding, BuildLevel
from geartrain.kinematics.circuits import Axes, Circuit, Tree
from geartrain.numerics.graphs import RatioSets
from geartrain.numerics.quantity import millimetres
from geartrain.numerics.vectors import cross, dot

if TYPE_CHECKING:
    from geartrain.teeth.tooth_form import ToothForm
    from geartrain.train import Train, Wheel

PRESSURE = radians(20)
"""Pressure angle of standard teeth [rad], used if none is declared."""


@lru_cache(maxsize=4096)
def tip_margin(z1: int, z2: int, pressure: float, h1: float, h2: float) -> float:
    """Return the angle about the ring's axis between the tip corners of a planet's tooth and a ring's tooth [rad].

    z1, z2     tooth counts of the planet and the ring; z2 > z1
    pressure   pressure angle [rad]
    h1, h2     addenda [modules]

    Teeth have no backlash. The angle is negative if the corners collide: trochoid interference (Elements of Metric Gear
    Technology, SDP/SI, equations 5-6 and 5-7). When the planet's corner is on the ring's tip circle, at the angle
    theta1 about its own axis and theta2 about the ring's axis (both from the line of centres), the planet has turned
    from the position in which its flank met the pitch point by phi = theta1 + inv(alpha_a1) - inv(alpha), because the
    tooth is thinner at its tip, and the ring by phi z1/z2. The corner of the ring's next tooth is then at phi z1/z2 +
    inv(alpha) - inv(alpha_a2).

    The result is inf if the planet's tips never reach the ring's tip circle, and -inf if the ring's tip circle lies
    within its base circle or within the planet's tip circle, or z2 <= z1. For full-depth teeth with a pressure angle of
    20 degrees, a ring with 34 to 77 teeth requires 9 teeth more than the planet, and a larger ring 8; the source states
    "larger than 9".
    """
    r1, r2, a = z1 / 2 + h1, z2 / 2 - h2, (z2 - z1) / 2
    if a <= 0:
        return -inf
    out = (r2 * r2 - r1 * r1 - a * a) / (2 * a * r1)
    if out > 1:  # the planet's tips never reach the ring's tip circle
        return inf
    if r2 <= r1 - a or 2 * r2 < z2 * cos(pressure):
        return -inf
    # law of cosines in the triangle of both centres and the corner; rounding may leave [-1, 1]
    theta1 = acos(max(out, -1.0))
    theta2 = acos(max(-1.0, min((a * a + r2 * r2 - r1 * r1) / (2 * a * r2), 1.0)))
    tip1, tip2 = acos(z1 * cos(pressure) / (2 * r1)), acos(min(z2 * cos(pressure) / (2 * r2), 1.0))
    phi = theta1 + _involute(tip1) - _involute(pressure)
    return phi * z1 / z2 + _involute(pressure) - _involute(tip2) - theta2


@lru_cache(maxsize=4096)
def radial_margin(z1: int, z2: int, pressure: float, h1: float, h2: float) -> float:
    """Return the angle about the planet's axis by which its teeth clear the ring's teeth during radial assembly [rad].

    The parameters are as in `tip_margin`. The angle is negative if tips collide during assembly (trimming interference,
    SDP/SI equations 5-9 to 5-11). For full-depth teeth with a pressure angle of 20 degrees, a ring requires 17 teeth
    more than the planet, or 16 if it has 80 or 100 teeth.
    """
    # a tip circle of the ring within its base circle is treated as the base circle
    tip1, tip2 = (acos(min(z * cos(pressure) / (z + 2 * h), 1.0)) for z, h in ((z1, h1), (z2, -h2)))
    lean = cos(tip2) / cos(tip1)
    outer = asin(sqrt(min(max((1 - lean**-2) / (1 - (z1 / z2) ** 2), 0.0), 1.0)))
    inner = asin(sqrt(min(max((lean**2 - 1) / ((z2 / z1) ** 2 - 1), 0.0), 1.0)))
    start = _involute(pressure)
    return outer + _involute(tip1) - start - z2 / z1 * (inner + _involute(tip2) - start)


def _involute(angle: float) -> float:
    return tan(angle) - angle


def minimum_ring(planet: int) -> int:
    """Return the minimum tooth count (34 or more) of a ring without trochoid interference with a planet."""
    # the tip circle of a ring with fewer than 34 teeth lies within its base circle
    first = max(planet + 1, 34)
    return next(z for z in count(first) if tip_margin(planet, z, PRESSURE, 1.0, 1.0) > 0)


def check_rings(pairs: Sequence[PitchPair]) -> Iterator[BuildFinding]:
    """Yield findings of rules R1 to R3: a ring smaller than its mate, trochoid interference, trimming interference."""
    for pair in pairs:
        if pair.ring is None or set(pair.kinds) != {"spur"}:
            continue
        ring, planet = pair.counts[pair.ring], pair.counts[1 - pair.ring]
        name, mate = pair.wheels[pair.ring], pair.wheels[1 - pair.ring]
        # the teeth of a flexible wheel engage radially, and clear the ring's at its minor axis
        judged = pair.form is None and not pair.declared[1 - pair.ring].flexible
        if ring <= planet:
            why = f"the centre distance of ({ring} - {planet})/2 modules is not positive"
            fix = f"make the other wheel the ring, or use a ring of at least {minimum_ring(planet)} teeth"
            what = f"pair '{pair.name}': ring '{name}' ({ring} teeth) is too small for wheel '{mate}' ({planet} teeth)"
            yield BuildFinding("R1", "error", Problem(what, why, fix, pair.place))
        elif judged and 33 < ring < minimum_ring(planet):
            what = (
                f"pair '{pair.name}': the tips of '{mate}' ({planet} teeth) collide with the tips of the ring '{name}' "
                f"({ring} teeth)"
            )
            why = "standard teeth of 20 degrees collide outside the mesh (trochoid interference)"
            fix = (
                "declare a tooth form with shorter addenda or a larger pressure angle, or use a ring of at least "
                f"{minimum_ring(planet)} teeth"
            )
            yield BuildFinding("R2", "note", Problem(what, why, fix, pair.place))
        elif judged and ring > 33 and radial_margin(planet, ring, PRESSURE, 1.0, 1.0) < 0:
            what = (
                f"pair '{pair.name}': '{mate}' ({planet} teeth) can be inserted into the ring '{name}' ({ring} teeth) "
                "only axially"
            )
            why = "in radial assembly the tips of standard teeth collide (trimming interference)"
            larger = count(minimum_ring(planet))
            wide = next(z for z in larger if radial_margin(planet, z, PRESSURE, 1.0, 1.0) >= 0)
            fix = f"leave space for axial assembly, or use a ring of at least {wide} teeth"
            yield BuildFinding("R3", "note", Problem(what, why, fix, pair.place))


SLACK = Fraction(1, 50)
"""Maximum accepted difference between the declared and the required centre distance of a mesh [modules]; it is less
than the backlash of cut teeth.
"""

SHIFT = Fraction(1, 2)
"""Maximum change of the centre distance that is accepted because profile shift can compensate it [modules]."""

# relative difference of distance of wheels without declared size, as if cut with different pitches
_FREE = Fraction(1, 40)
_LOOSE = Fraction(1, 20)  # relative difference of distance of teeth with their own sizes that run at any distance


class PairOutline(NamedTuple):
    """Dimensions of a pair with declared teeth: centre distance and tip radius of each wheel [transverse modules]."""

    distance: float
    tips: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class PitchPair:
    """Gear pair with its declared dimensions; fields with two elements refer to the first and the second wheel."""

    name: str
    place: str
    wheels: tuple[str, str]
    declared: tuple[Wheel, Wheel]
    axes: tuple[str, str]
    """Labels of the axes about which the two wheels turn relative to the carrier."""
    parallel: bool
    """True if the two axes are parallel."""
    ring: int | None
    """Index (0 or 1) of the wheel that is a ring; None for an external pair."""
    form: ToothForm | None
    """Tooth form declared for the pair, or for the train if the pair declares none; None if no form is declared or the
    form is ideal.
    """

    @property
    def counts(self) -> tuple[int, int]:
        """Tooth counts of the two wheels."""
        return self.declared[0].count or 0, self.declared[1].count or 0

    @property
    def kinds(self) -> tuple[str, str]:
        """Kinds of the two wheels, such as `spur` or `bevel`."""
        return self.declared[0].kind, self.declared[1].kind

    @property
    def is_crossed(self) -> bool:
        """True for crossed helical wheels: spur wheels on non-parallel axes, of which at least one is helical."""
        return not self.parallel and any(wheel.is_helical for wheel in self.declared)

    @property
    def modules(self) -> tuple[Fraction | None, Fraction | None]:
        """Declared module of each wheel [mm]; None if it is not declared."""
        first, second = (None if wheel.module is None else millimetres(wheel.module) for wheel in self.declared)
        return first, second

    @property
    def axis_pair(self) -> tuple[str, str]:
        """Labels of the two axes in alphabetical order, which are equal for all pairs between the same axes."""
        return min(self.axes), max(self.axes)

    @property
    def has_distance(self) -> bool:
        """True if the centre distance follows from module and tooth counts: the axes are parallel, both wheels are spur
        wheels, and a ring has more teeth than its mate.
        """
        return self.parallel and self.kinds == ("spur", "spur") and self.touching > 0

    @property
    def touching(self) -> Fraction:
        """Centre distance at which the pitch circles touch [modules]: (z1 + z2)/2, or (z_ring - z)/2, where z are tooth
        counts.

        For helical teeth, this value is divided by the cosine of the helix angle.
        """
        first, second = (Fraction(wheel.count or 0, 2) for wheel in self.declared)
        if self.declared[0].is_helical:  # the declared module of helical wheels is the normal module
            first, second = (half * Fraction(self.declared[0].slant) for half in (first, second))
        if self.ring is None:
            return first + second
        return first - second if self.ring == 0 else second - first

    @property
    def distance(self) -> Fraction:
        """Design centre distance [modules]: the distance that the tooth form declares, or, if it declares none, the
        distance at which the pitch circles touch.
        """
        form = self.form
        own = getattr(form, "centre_distance", None) if form is not None and form.conjugate else None
        module = self.modules[0] or self.modules[1]
        if own is not None and (own.unit is None or module):
            return own.value if own.unit is None else millimetres(own) / (module or 1)
        return self.touching if form is None else _distance_without_backlash(self, form)

    @property
    def bounds(self) -> tuple[Fraction, Fraction]:
        """Minimum and maximum centre distance at which these teeth can mesh [modules]; the backlash at the maximum may
        be larger than at `distance`.

        If no tooth form is declared, the profiles may be shifted; if no size is declared either, the wheels may have
        been cut with slightly different pitches. Declared involute teeth also mesh at larger distances, with more
        backlash.
        """
        wanted, form = self.distance, self.form
        low = high = SLACK
        if form is None:
            sized = self.modules != (None, None)
            low = high = low + (SHIFT if sized else max(SHIFT, _FREE * wanted))
        elif form.any_distance and form.conjugate:
            # involutes run with more backlash: closer together with a ring, farther apart otherwise
            low, high = (low + SHIFT, high) if self.ring is not None else (low, high + SHIFT)
        elif form.any_distance:
            low = high = _LOOSE * wanted
        return wanted - low, wanted + high


def _distance_without_backlash(pair: PitchPair, form: ToothForm) -> Fraction:
    """Return the centre distance without backlash [modules]; the pitch circles touch there unless teeth are shifted."""
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
    except GearTrainError:  # invalid teeth are reported by their own check
        return pair.touching


def pitch_pairs(train: Train, tree: Tree, circuits: Sequence[Circuit]) -> tuple[PitchPair, ...]:
    """Return all gear pairs with their dimensions, in the order of declaration."""
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
                form if form is not None and form.has_shape else None,
            )
        )
    return tuple(found)


_EQUAL = Fraction(1, 10**6)  # relative tolerance of distances: written positions are rounded
_MM = ("mm",)
Node = tuple[str, ...]


def axis_distance(train: Train, axes: tuple[str, str]) -> Fraction | None:
    """Return the distance between two parallel axes [mm]; None unless the positions of both axes are declared."""
    declared = [train.axes[label] for label in axes if label in train.axes]
    if len(declared) < 2 or declared[0].position is None or declared[1].position is None:
        return None
    here, there = (tuple(map(millimetres, axis.position or ())) for axis in declared)
    x, y, z = (figure.value for figure in declared[0].direction)
    apart = there[0] - here[0], there[1] - here[1], there[2] - here[2]
    # component of the offset normal to the direction of the axes
    across = cross(apart, (x, y, z))
    return Fraction(sqrt(dot(across, across) / dot((x, y, z), (x, y, z))))


class PitchDistances:
    """Modules and centre distances of one train that follow from its declaration."""

    def __init__(self, train: Train, tree: Tree, circuits: Sequence[Circuit], pairs: Sequence[PitchPair]) -> None:
        self.train, self.pairs = train, pairs
        self.sizes: RatioSets[Node] = RatioSets()
        self.placed: dict[Node, str] = {}
        self.between: dict[Node, list[PitchPair]] = {}
        self.findings = [*self._modules(), *self._offsets(tree, circuits), *self._distances()]

    def module(self, wheel: str) -> Fraction | None:
        """Return the module of a wheel [mm], declared or implied by its mates and axes; None if it is undetermined."""
        return self.sizes.ratio(("wheel", wheel), _MM)

    def distance(self, axes: tuple[str, str]) -> tuple[Node, Fraction]:
        """Return a reference quantity (a module or a distance), and the ratio of the distance between two axes to it.
        Distances with the same reference quantity can be compared.
        """
        return self.sizes.root(("axes", *axes))

    def measure(self, pair: PitchPair) -> Callable[[Fraction], str]:
        """Return a function that formats a length as text, given the length as a multiple of the reference quantity of
        a pair's distance. The text is in mm if the reference quantity is known in mm, and in modules if it is not.
        """
        root, _ = self.distance(pair.axis_pair)
        known, module = self.sizes.ratio(root, _MM), self.sizes.ratio(root, ("wheel", pair.wheels[0])) or Fraction(1)
        return lambda size: _modules(size * module) if known is None else _mm(size * known)

    # --------------------------------------------------------------------------------------------------------- modules

    def _modules(self) -> Iterator[BuildFinding]:
        for name, (_, wheel) in self.train.wheels.items():
            if wheel.module is not None:
                self.sizes.join(_MM, ("wheel", name), millimetres(wheel.module))
        for pair in self.pairs:
            first, second = (("wheel", wheel) for wheel in pair.wheels)
            # a contradiction is reported at the pair that would join different modules
            ratio = self.sizes.ratio(first, second)
            if ratio is not None and ratio != 1:
                sides = []
                for side, own in zip(pair.wheels, pair.modules, strict=True):
                    whose = "" if own is not None else " through its other mates"
                    sides.append(f"'{side}' has module {_mm(self.module(side))}{whose}")
                what = f"the wheels of pair '{pair.name}' have different modules"
                why = f"{sides[0]} and {sides[1]}, and teeth of different pitches cannot mesh"
                fix = "give both wheels the same `module`"
                yield BuildFinding("M1", "error", Problem(what, why, fix, pair.place))
            self.sizes.join(first, second, Fraction(1))

    # ------------------------------------------------------------------------------------------------------- distances

    def _offsets(self, tree: Tree, circuits: Sequence[Circuit]) -> Iterator[BuildFinding]:
        """Add the axis distances that follow from declared positions and offsets of pins to `sizes`, and yield a
        finding for each contradiction.
        """
        offsets = {each.name: each.offset for each in self.train.pin_couplings if each.offset is not None}
        for pair in self.pairs:
            if pair.parallel:
                self._record_positions(pair.axis_pair)
        at = {coupling.name: number for number, coupling in enumerate(self.train.couplings)}
        for circuit in circuits:
            if circuit.id not in offsets:
                continue
            labels = [tree.axis_seen_from(circuit.carrier, link) for link in (circuit.i, circuit.j)]
            axes, offset = (min(labels), max(labels)), millimetres(offsets[circuit.id])
            node = ("axes", *axes)
            self._record_positions(axes)
            apart = self.sizes.ratio(node, _MM)
            if apart is not None and abs(apart - offset) > _EQUAL * max(apart, offset):
                what = f"axes {_named(axes)} are {_mm(apart)} apart, but the offset of '{circuit.id}' is {_mm(offset)}"
                why = "the offset of a pin is the distance between the two axes"
                fix = f"move an axis, or declare `offset: {_mm(apart)}`"
                place = self.train.place("couplings", at[circuit.id])
                yield BuildFinding("P1", "error", Problem(what, why, fix, place))
            # the offset determines the distance if no positions are declared
            elif apart is None:
                self.sizes.join(_MM, node, offset)
                self.placed[node] = f"the offset of '{circuit.id}'"

    def _record_positions(self, axes: tuple[str, str]) -> None:
        """Add the distance between two parallel axes to `sizes` and `placed` if their positions are declared."""
        node = ("axes", *axes)
        if node in self.placed or axes[0] == axes[1]:
            return
        if far := axis_distance(self.train, axes):
            self.placed[node] = "the positions"
            self.sizes.join(_MM, node, far)

    def _distances(self) -> Iterator[BuildFinding]:
        for pair in self.pairs:
            if not pair.has_distance:
                continue
            node, wheel = ("axes", *pair.axis_pair), ("wheel", pair.wheels[0])
            # the first pair between two axes defines their distance, others are compared with it
            found = self.sizes.ratio(node, wheel)
            if found is None:
                self.sizes.join(wheel, node, pair.distance)
            elif node in self.placed:
                yield from self._misplaced(pair, found, self.placed[node])
            elif node in self.between:
                yield from self._coaxial(pair)
            self.between.setdefault(node, []).append(pair)

    def _misplaced(self, pair: PitchPair, found: Fraction, by: str) -> Iterator[BuildFinding]:
        """Yield a finding if the required centre distance of a pair differs from the declared distance `found`
        [modules]; `by` names the declaration of this distance.
        """
        wanted, off = pair.distance, found - pair.distance
        if abs(off) <= _EQUAL * sum(pair.counts) / 2:
            return
        low, high = pair.bounds
        shifts = _needed_shifts(pair, found)
        # if only one wheel declares a module, the distance may be right and the module wrong
        rule = "M2" if pair.modules.count(None) == 1 else "P1"
        module = self.module(pair.wheels[0]) or Fraction(1)
        first, second = (f"'{wheel}' ({count} teeth)" for wheel, count in zip(pair.wheels, pair.counts, strict=True))
        what = (
            f"pair '{pair.name}': axes {_named(pair.axis_pair)} are {_mm(found * module)} apart according to {by}, "
            f"but {first} and {second} of module {_mm(module)} need {_mm(wanted * module)}"
        )
        gap = _mm(abs(off) * module)
        move, shift = f"move an axis by {gap}", f", or {shifts}" if shifts else ""
        if low <= found <= high or (shifts and pair.form is None):
            why = _backlash_effect(pair, off, module)
            yield BuildFinding("P1", "note", Problem(what, why, move + shift, pair.place))
            return
        why = f"their pitch circles {f'are {gap} apart' if off > 0 else f'overlap by {gap}'}"
        # module with which the wheels have the given distance
        fits = _mm(found / wanted * module)
        remedy = f"remove the module, which must be {fits} at this distance"
        if rule == "P1":
            remedy = f"give both wheels module {fits}"
        yield BuildFinding(rule, "error", Problem(what, why, f"{move}, or {remedy}{shift}", pair.place))

    def _coaxial(self, pair: PitchPair) -> Iterator[BuildFinding]:
        """Yield a finding if a pair and another pair on the same two axes require different centre distances. The
        finding names the other pair whose required distance differs most.
        """
        wheel = ("wheel", pair.wheels[0])
        best: tuple[Fraction, PitchPair, Fraction] | None = None
        for other in self.between[("axes", *pair.axis_pair)][:_MOST]:
            scale = self.sizes.ratio(("wheel", other.wheels[0]), wheel)
            if scale is None:
                continue
            off = abs(other.distance * scale - pair.distance)
            if best is None or off > best[0]:
                best = off, other, scale
        if best is None or best[0] <= _EQUAL * sum(pair.counts) / 2:
            return
        off, other, scale = best
        low, high = pair.bounds
        minimum, most = (bound * scale for bound in other.bounds)
        # a distance at which both pairs run: the ranges overlap
        level: BuildLevel = "note" if max(low, minimum) <= min(high, most) else "error"
        yield BuildFinding("P2", level, self._two_distances(pair, other, scale, off, level == "error"))

    def _two_distances(
        self, pair: PitchPair, other: PitchPair, scale: Fraction, off: Fraction, is_error: bool
    ) -> Problem:
        module = self.module(pair.wheels[0])
        wants = [self._length(each, module) for each in (other.distance * scale, pair.distance)]
        shared = set(pair.wheels) & set(other.wheels)
        what = (
            f"pairs '{other.name}' and '{pair.name}' need different centre distances between axes "
            f"{_named(pair.axis_pair)}: {wants[0]} and {wants[1]}"
        )
        if not is_error:
            why = f"two axes have one centre distance, and the teeth must compensate for {self._length(off, module)}"
            return Problem(what, why, _COMPENSATE, pair.place)
        why = f"two axes have one centre distance, but these two differ by {self._length(off, module)}"
        # the distance is half of the sum of the tooth counts
        teeth = 2 * off
        fix = "change tooth counts" + (f", their sum by {teeth}" if teeth.denominator == 1 else "")
        fix += ", or give each pair its own pinion and module" if shared else ", or give one pair another module"
        return Problem(what, why, fix, pair.place)

    @staticmethod
    def _length(modules: Fraction, module: Fraction | None) -> str:
        return _modules(modules) if module is None else _mm(modules * module)


_MOST = 50  # pairs between two axes with which a further one is compared; bounds the cost for many coaxial pairs
_SHIFTS = (-1.0, 2.0)  # range of the sum of shifts (modules) for full-depth teeth of 20 degrees, about 20 and 40 teeth
_COMPENSATE = "shift profiles, give the pairs different modules, or change a tooth count"


def _needed_shifts(pair: PitchPair, distance: Fraction) -> str:
    """Return advice to declare profile shifts for which involute teeth have no backlash at a distance [modules].

    The shifts x satisfy inv a_w = inv a_t + 2 tan a_n (x1 + x2)/(z1 + z2), with the tooth counts z, the normal pressure
    angle a_n, the transverse pressure angle a_t, tan a_t = tan a_n / cos(helix), and the operating pressure angle a_w,
    cos a_w = cos a_t touching/distance. In a pair with a ring, z and x of the mate are negative. The advice is "" if
    the required sum of the shifts is outside the limits `_SHIFTS`.
    """
    from geartrain.teeth.conjugate.involute_geometry import inv

    normal = PRESSURE if pair.form is None else pair.form.rack_angle
    if normal is None:
        return ""
    slant = pair.declared[0].slant if pair.declared[0].is_helical else 1.0
    # transverse pressure angle of helical teeth
    across = atan(tan(normal) * slant)
    cosine = cos(across) * float(pair.touching / distance)
    if cosine >= 1:
        return ""
    # sum of the tooth counts, with a ring their difference
    teeth = float(2 * pair.touching) / slant
    total = (inv(acos(cosine)) - inv(across)) * teeth / (2 * tan(normal))
    if not _SHIFTS[0] <= total <= _SHIFTS[1]:
        return ""
    first, second, what = total / 2, total / 2, "the sum of the shifts"
    if pair.ring is not None:
        ring, mate = pair.wheels[pair.ring], pair.wheels[1 - pair.ring]
        # only the difference of the shifts matters in a pair with a ring
        first, second, what = 0.0, total, f"the shift of '{ring}' minus that of '{mate}', which `pair` names first,"
    key = f"shift: [{first:.4g}, {second:.4g}]"
    key = key if pair.form is not None else f"tooth_form: {{form: involute, {key}}}"
    return f"declare `{key}`: {what} must be {total:.4g}"


def _backlash_effect(pair: PitchPair, off: Fraction, module: Fraction) -> str:
    """Return a text on the change of backlash if a centre distance deviates by `off` [modules]: 2 |off| tan(alpha)."""
    tight = (off < 0) != (pair.ring is not None)
    if abs(off) <= SLACK and tight:
        return f"they are {_mm(abs(off) * module)} closer than teeth without backlash allow"
    if tight:
        return "standard teeth jam at this distance"
    angle = getattr(pair.form, "rack_angle", None) or PRESSURE
    return f"standard teeth have {_mm(2 * abs(off) * module * Fraction(tan(angle)))} more backlash at this distance"


def _named(axes: Sequence[str]) -> str:
    return " and ".join(f"'{label}'" for label in axes)


def _mm(length: Fraction | None) -> str:
    return "unknown" if length is None else f"{_shown(length)} mm"


def _modules(size: Fraction) -> str:
    return "1 module" if size == 1 else f"{_shown(size)} modules"


def _shown(number: Fraction) -> str:
    return f"{float(number):.6g}"
