"""Assembly conditions and clearances of sets of equal planets on a carrier."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain, combinations
from math import asin, atan2, ceil, cos, floor, gcd, pi, sin, sqrt, tau
from typing import TYPE_CHECKING, Any, Literal

from geartrain.errors import Problem
from geartrain.kinematics.buildability.build_findings import BuildFinding
from geartrain.kinematics.buildability.pitch_distances import SHIFT
from geartrain.kinematics.circuits import Circuit, Tree, find_circuits, find_tree
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.vectors import dot, frame, minus

if TYPE_CHECKING:
    from geartrain.kinematics.buildability.build_findings import BuildLevel
    from geartrain.kinematics.buildability.pitch_distances import PairOutline, PitchDistances
    from geartrain.train import Train

CountRef = str | int
"""Tooth count in an assembly rule: the name of a wheel with a variable tooth count, or a fixed tooth count."""

Measure = Literal["", "plain", "m"]
"""Unit of a declared module: "" if no module is declared, "plain" for a number without a unit, "m" for a length."""


@dataclass(frozen=True, slots=True)
class AssemblyMesh:
    """Gear pair relative to its carrier, with the data that the assembly rules require. If a field has two elements,
    they refer to the first and the second wheel.
    """

    name: str
    """Name of the pair."""
    carrier: str
    """Link that carries both axes of the pair."""
    wheels: tuple[str, str]
    """Names of the two wheels."""
    links: tuple[str, str]
    """Names of the links to which the two wheels belong."""
    axes: tuple[str, str]
    """Labels of the axes about which the two links turn relative to the carrier."""
    parts: tuple[CountRef, CountRef]
    """Tooth counts of the wheels: the name of a wheel with a variable tooth count, or a fixed tooth count."""
    sense: int
    """1 if the wheels turn in opposite senses relative to the carrier, -1 if they turn in the same sense."""
    ring: int | None
    """Index (0 or 1) of the wheel that is a ring; None for an external pair."""
    spur: bool
    """True if both wheels are spur wheels."""
    worm: bool
    """True if one wheel is a worm."""
    measure: Measure
    """Unit of the common module of the two wheels; empty if no module is declared."""
    module: Fraction | None
    """Common module of the two wheels [`measure`]; 1 if none is declared, None if the declared modules differ."""

    @property
    def is_free(self) -> bool:
        """True if the tooth count of at least one wheel of the pair is variable."""
        return any(isinstance(part, str) for part in self.parts)

    @property
    def terms(self) -> tuple[tuple[int, CountRef], tuple[int, CountRef]]:
        """Two terms (sign, tooth count z) with the sum z1 + z2 or z_ring - z: twice the centre distance [modules]."""
        first, second = self.parts
        return (-1 if self.ring == 1 else 1, first), (-1 if self.ring == 0 else 1, second)


@dataclass(frozen=True, slots=True)
class Planet:
    """Planet with its meshes: a node in a tree of planets that mesh with each other. The root is the first planet."""

    link: str
    inward: AssemblyMesh | None
    """Mesh with the parent planet in the tree of planets; None for the root."""
    central: tuple[AssemblyMesh, ...]
    """Meshes with wheels on the carrier's axis, sorted by the names of those wheels."""
    outward: tuple[tuple[AssemblyMesh, Planet], ...]
    """Meshes with the child planets in the tree; equal sets list corresponding meshes in the same order."""

    def walk(self) -> Iterator[Planet]:
        """Yield this planet and all its descendants in the tree."""
        yield self
        for _, planet in self.outward:
            yield from planet.walk()

    def side(self, mesh: AssemblyMesh) -> int:
        """Return the index (0 or 1) of this planet's wheel in one of its meshes."""
        return mesh.links.index(self.link)

    def own(self, mesh: AssemblyMesh) -> str:
        """Return the name of this planet's wheel in one of its meshes."""
        return mesh.wheels[self.side(mesh)]

    def mate(self, mesh: AssemblyMesh) -> str:
        """Return the name of the other wheel in one of this planet's meshes."""
        return mesh.wheels[1 - self.side(mesh)]

    @property
    def wheels(self) -> tuple[str, ...]:
        """Names of this planet's meshing wheels. Equal planets list corresponding wheels in the same order."""
        return tuple(self.mesh_of)

    @property
    def mesh_of(self) -> dict[str, AssemblyMesh]:
        """One mesh of each wheel of this planet, by wheel. If a wheel has several meshes, a mesh with a child planet is
        preferred, then a mesh with a wheel on the axis of the carrier, then the mesh with the parent planet.
        """
        inward = [self.inward] if self.inward else []
        meshes = [*inward, *self.central, *(mesh for mesh, _ in self.outward)]
        return {self.own(mesh): mesh for mesh in meshes}

    @property
    def form(self) -> object:
        """Description of the meshes of this planet and its descendants, equal for planets of equal sets."""
        wheels = self.wheels
        central = tuple((wheels.index(self.own(mesh)), self.mate(mesh)) for mesh in self.central)
        outward = tuple((wheels.index(self.own(mesh)), other.form) for mesh, other in self.outward)
        return len(wheels), central, outward


@dataclass(frozen=True, slots=True)
class PlanetSet:
    """Planets of one carrier that mesh with each other; usually a set contains a single planet."""

    carrier: str
    planets: Planet | None
    """Root of the tree of planets; None if the planets mesh in a loop."""
    links: tuple[str, ...]
    """Names of the links of all planets in the set."""
    copies: tuple[PlanetSet, ...] = ()
    """Other sets of planets on the carrier that mesh in the same way with the same central wheels, if equal planets are
    declared separately.
    """

    @property
    def title(self) -> str:
        """Names of the planets, quoted and separated by commas."""
        return ", ".join(f"'{link}'" for link in self.links)


_Central = tuple[str, AssemblyMesh]  # central wheel, and its mesh with a planet


@dataclass(frozen=True)
class TrainAssembly:
    """Train with the data that the assembly rules of planets require: tooth counts, meshes and sets of planets."""

    train: Train
    free: frozenset[str]
    tree: Tree
    """Tree of turning pairs."""
    circuits: tuple[Circuit, ...]
    """Fundamental circuits of gear pairs and couplings."""

    @classmethod
    def of(cls, train: Train, free: Iterable[str]) -> TrainAssembly:
        """Return the assembly data of a train in which the wheels in `free` have variable tooth counts."""
        tree = find_tree(train)
        return cls(train, frozenset(free), tree, find_circuits(train, tree))

    def part(self, wheel: str) -> CountRef:
        """Return the tooth count of a wheel, or the wheel's name if its tooth count is variable or undeclared."""
        count = self.train.wheels[wheel][1].count
        return wheel if wheel in self.free or count is None else count

    @cached_property
    def meshes(self) -> tuple[AssemblyMesh, ...]:
        """All gear pairs relative to their carriers, in the order in which they are declared."""
        return tuple(self._mesh(circuit) for circuit in self.circuits if circuit.kind == "gear")

    def _mesh(self, circuit: Circuit) -> AssemblyMesh:
        first, second = (self.train.wheels[name][1] for name in circuit.wheels)
        measure, module = self.module(*circuit.wheels)
        return AssemblyMesh(
            circuit.id,
            circuit.carrier,
            circuit.wheels,
            (circuit.i, circuit.j),
            (
                self.tree.axis_seen_from(circuit.carrier, circuit.i),
                self.tree.axis_seen_from(circuit.carrier, circuit.j),
            ),
            (self.part(circuit.wheels[0]), self.part(circuit.wheels[1])),
            # coefficients of one sign: external pair, whose wheels turn in opposite senses
            1 if circuit.a * circuit.b > 0 else -1,
            0 if first.internal else 1 if second.internal else None,
            first.kind == second.kind == "spur",
            "worm" in (first.kind, second.kind),
            measure,
            module,
        )

    def module(self, *wheels: str) -> tuple[Measure, Fraction | None]:
        """Return the unit and the value of the common module of the given wheels. The module is declared for these
        wheels, or for other wheels that must have the same module.

        The value is 1 if no module is declared, and None if different modules are declared.
        """
        found = {one for wheel in wheels for one in self._modules.get(self.kin[wheel], ())}
        if len(found) > 1:
            found = {one for wheel in wheels for one in self._declared(wheel)}
        if not found:
            return "", Fraction(1)
        measure, module = next(iter(found))
        return measure, module if len(found) == 1 else None

    @cached_property
    def _modules(self) -> Mapping[int, frozenset[tuple[Measure, Fraction]]]:
        """Declared modules (unit and value) in each group of wheels that must have the same module, by group number."""
        found: dict[int, frozenset[tuple[Measure, Fraction]]] = {}
        for wheel, number in self.kin.items():
            found[number] = found.get(number, frozenset()) | self._declared(wheel)
        return found

    def _declared(self, wheel: str) -> frozenset[tuple[Measure, Fraction]]:
        module = self.train.wheels[wheel][1].module
        if module is None or not module.base:
            return frozenset()
        return frozenset({("m" if module.unit else "plain", module.base)})

    @cached_property
    def kin(self) -> Mapping[str, int]:
        """Group number of each wheel, by wheel. Wheels that are connected by meshes, except meshes of worms, are in the
        same group and must have the same module.
        """
        worms = {wheel for wheel, (_, kind) in self.train.wheels.items() if kind.kind == "worm"}
        pairs = [circuit.wheels for circuit in self.circuits if circuit.kind == "gear"]
        groups = joined_groups(self.train.wheels, [pair for pair in pairs if worms.isdisjoint(pair)])
        return {wheel: number for number, group in enumerate(groups) for wheel in group}

    @cached_property
    def sets(self) -> tuple[PlanetSet, ...]:
        """Sets of planets on moving carriers; the field `copies` of a set contains the later sets that equal it."""
        found: list[PlanetSet] = []
        by_carrier: dict[str, list[AssemblyMesh]] = {}
        for mesh in self.meshes:
            if mesh.carrier != self.train.frame and not mesh.worm:
                by_carrier.setdefault(mesh.carrier, []).append(mesh)
        for carrier, meshes in by_carrier.items():
            alike: dict[object, list[PlanetSet]] = {}
            planets = [[link for link in mesh.links if self.tree.bears(carrier, link)] for mesh in meshes]
            for links in joined_groups(chain(*planets), planets):
                one = self._set(carrier, links, meshes)
                # planets that mesh in a loop have no canonical form, so such a set has no copies
                alike.setdefault(one.planets.form if one.planets else one.links, []).append(one)
            for first, *others in alike.values():
                found.append(PlanetSet(carrier, first.planets, first.links, tuple(others)))
        return tuple(found)

    def _set(self, carrier: str, links: list[str], meshes: Sequence[AssemblyMesh]) -> PlanetSet:
        among = [mesh for mesh in meshes if set(mesh.links) <= set(links)]
        # a connected graph of n planets is a tree only if it has n - 1 meshes
        if len(among) != len(links) - 1:
            return PlanetSet(carrier, None, tuple(links))
        central: dict[str, list[_Central]] = {}
        for link in links:
            sides = [(mesh, 1 - mesh.links.index(link)) for mesh in meshes if link in mesh.links]
            found = [(mesh.wheels[at], mesh) for mesh, at in sides if not self.tree.bears(carrier, mesh.links[at])]
            central[link] = sorted(found, key=lambda each: each[0])
        # start at the planet whose central wheels come first, so that equal sets have isomorphic trees
        start = min(links, key=lambda link: ([wheel for wheel, _ in central[link]] or ["\uffff"], links.index(link)))
        return PlanetSet(carrier, self._planet(start, None, among, central), tuple(links))

    def _planet(
        self, link: str, inward: AssemblyMesh | None, among: list[AssemblyMesh], central: Mapping[str, list[_Central]]
    ) -> Planet:
        rest = [mesh for mesh in among if link not in mesh.links]
        outward = []
        for mesh in among:
            if link in mesh.links:
                outward.append((mesh, self._planet(mesh.links[1 - mesh.links.index(link)], mesh, rest, central)))
        outward.sort(key=lambda each: repr(each[1].form))
        return Planet(link, inward, tuple(mesh for _, mesh in central[link]), tuple(outward))


def corresponding(first: PlanetSet, other: PlanetSet) -> Mapping[str, str]:
    """Return, for each wheel of the set `first`, the corresponding wheel of the equal set `other`, by name."""
    assert first.planets is not None
    assert other.planets is not None
    found: dict[str, str] = {}
    for mine, its in zip(first.planets.walk(), other.planets.walk(), strict=True):
        found.update(zip(mine.wheels, its.wheels, strict=True))
    return found


def mesh_counts(planet: Planet, mesh: AssemblyMesh, other: Planet | None = None) -> tuple[CountRef, CountRef]:
    """Return the tooth counts of a planet and of its mate in one of its meshes, as terms of the assembly rule.

    If a planet has one wheel, the assembly rule contains its tooth count z only in the product z phi, where phi is the
    angle of the planet. This z is therefore replaced by 1.

    other   the mate, if it is a child planet in the tree; None if it is not
    """
    side = planet.side(mesh)
    own = mesh.parts[side] if len(planet.wheels) > 1 else 1
    return own, 1 if other and len(other.wheels) == 1 else mesh.parts[1 - side]


@dataclass(frozen=True, slots=True)
class PhaseArithmetic:
    """Integer arithmetic for the assembly rule, on numbers or on arrays of candidate sets of tooth counts."""

    count: Callable[[CountRef], Any]
    """Function that returns the value of a tooth count term, as a number or an array."""
    gcd: Callable[[Any, Any], Any]
    """Function gcd(a, b) that returns the greatest common divisor."""
    bezout: Callable[[Any, Any], tuple[Any, Any, Any]]
    """Function for the extended Euclidean algorithm: it returns g, u, v with u a + v b = g = gcd(a, b)."""
    reduced: Callable[[Any], Any]
    """Function that reduces a number modulo the number of planets, or that returns the number unchanged."""


def phase_numbers(root: Planet, kind: PhaseArithmetic) -> list[Any]:
    """Return the integers E of the assembly rule. A set of planets that is rotated by t turns about the carrier's axis
    meshes again if E t is an integer for every E.

    A mesh of wheels a and b keeps z_a theta_a + z_b theta_b constant modulo 1, where z are tooth counts and theta are
    angles relative to the carrier [turn]; the sign is negative if one wheel is a ring. Rotation of a set in mesh by t
    gives the position of another set, but it also rotates the central wheels by t. They must return to their positions,
    because the sets share them. So the planets must be turned by angles phi such that

        z_p phi_p + z_c t is an integer for every central wheel c (minus for a ring),
        z_p phi_p + z_q phi_q is an integer for planets p and q in mesh.

    Planets are processed from the leaves of their tree to its root. The remaining angles of a planet satisfy D phi = b
    t (mod 1) for integers D and b. A central wheel c gives D = z_p, b = -z_c. Two such conditions are compatible if
    gcd(D1, D2) divides (D1 b2 - D2 b1) t; they combine to one condition with D = gcd(D1, D2) and b = u b1 + v b2, where
    u D1 + v D2 = D.

    A planet with one wheel gives the textbook rule: E = z_s + z_r for a sun s and a ring r, and n planets can be evenly
    spaced (t = 1/n) if n divides E. A planet with two wheels gives (z_s z_q + z_r z_p)/gcd(z_p, z_q), and two planets
    in series give z_r - z_s. Phase closure (`geartrain.kinematics.phasing`) is an independent derivation.
    """
    found: list[Any] = []
    left = _angle_conditions(root, kind, found)
    # pairwise compatible conditions are compatible together, because their solutions are multiples of one step
    found += (_compatibility_number(one, other, kind.gcd(one[0], other[0])) for one, other in combinations(left, 2))
    return found


def _angle_conditions(planet: Planet, kind: PhaseArithmetic, found: list[Any]) -> list[tuple[Any, Any]]:
    """Return the pair (D, b) of each condition D phi = b t on a planet's angle phi [turn], where t is the rotation of
    its set [turn]. Append the integers E of the planet's descendants to `found`.
    """
    left = []
    for mesh in planet.central:
        own, mate = map(kind.count, mesh_counts(planet, mesh))
        left.append((own, kind.reduced(-mesh.sense * mate)))
    for mesh, other in planet.outward:
        further = _angle_conditions(other, kind, found)
        if not further:
            continue
        # all conditions of the child planet are combined into one; E expresses whether they are compatible
        (D, b), *rest = further
        for D2, b2 in rest:
            common, u, v = kind.bezout(D, D2)
            found.append(_compatibility_number((D, b), (D2, b2), common))
            D, b = common, kind.reduced(kind.reduced(u) * b + kind.reduced(v) * b2)
        own, mate = map(kind.count, mesh_counts(planet, mesh, other))
        # z phi of the child planet is known up to multiples of gcd(z, D)/D
        common = kind.gcd(mate, D)
        left.append((D // common * own, kind.reduced(-mesh.sense * kind.reduced(mate // common) * b)))
    return left


def _compatibility_number(one: tuple[Any, Any], other: tuple[Any, Any], common: Any) -> Any:
    return (one[0] * other[1] - other[0] * one[1]) // common


def bezout(a: int, b: int) -> tuple[int, int, int]:
    """Return the greatest common divisor g of two non-negative integers a and b, and u, v with u a + v b = g.

    The numbers are found by the extended Euclidean algorithm.

    >>> bezout(24, 18)
    (6, 1, -1)
    """
    r, s, t, r2, s2, t2 = a, 1, 0, b, 0, 1
    while r2:
        q = r // r2
        r, r2, s, s2, t, t2 = r2, r - q * r2, s2, s - q * s2, t2, t - q * t2
    return r, s, t


def neighbour_terms(root: Any, reach: Any, tips: Any, chord: Any) -> tuple[Any, ...]:
    """Return two terms whose sum is the tip clearance of n equally spaced planets, 2 a sin(pi/n) - tips [unit of
    `reach`].

    root    square root function, which is not used here: both functions of clearances have one signature
    reach   2 a, twice the distance of a planet's axis from the central axis: m (z_s + z_p), or m (z_r - z_p), with the
            module m and the tooth counts of sun, planet and ring
    tips    m (z_p + 2 h) plus the required clearance, with the addendum h [modules]
    chord   sin(pi/n)
    """
    return reach * chord, -tips


def passing_terms(root: Any, A: Any, B: Any, D: Any, tips: Any, c: Any, s: Any) -> tuple[Any, ...]:
    """Return the terms whose sum is (2 d)^2 - tips^2, where d is the distance between the axis of a planet and the axis
    of a planet in a neighbouring set. The sum is positive if the wheels of these two planets clear each other.

    root   square root function
    A, B   twice the distances of the two planets' axes from the central axis
    D      twice the centre distance of two planets in mesh, D^2 = A^2 + B^2 - 2 A B cos(delta)
    tips   sum of the tip diameters, and twice the required clearance
    c, s   cosine and sine of the angle psi between neighbouring sets; the angle between the two axes is psi - delta,
           (2 d)^2 = A^2 + B^2 - 2 A B (c cos(delta) + s sin(delta))
    """
    Q = A * A + B * B - D * D
    # 2 A B sin(delta), because Q = 2 A B cos(delta)
    sines = root(4 * A * A * B * B - Q * Q)
    return A * A, B * B, -c * Q, -s * sines, -tips * tips


_MISS, _NEGLIGIBLE = 0.1, 0.01  # phase errors (pitches): more than any backlash absorbs; less than any backlash
ON_ECCENTRIC = 0.25
"""Maximum distance between the axis of a wheel on an eccentric and the axis of its carrier [radii of the wheel]."""
_CLEAR = 0.2  # recommended clearance of neighbours (modules)
_FULL = 1.0  # addendum (modules) of undeclared teeth
_STUB = _FULL - float(SHIFT)  # smallest addendum of undeclared teeth


def check_planets(
    train: Train,
    tree: Tree,
    circuits: Sequence[Circuit],
    sizes: PitchDistances,
    outlines: Callable[[], Mapping[str, PairOutline]],
) -> Iterator[BuildFinding]:
    """Yield findings of rules A1 to A3 for each group of equal planet sets that mesh with the same wheels."""
    if len(train.gears) < 2:
        return
    teeth = {wheel: each.count for wheel, (_, each) in train.wheels.items()}
    for one in TrainAssembly(train, frozenset(), tree, tuple(circuits)).sets:
        copies = [copy for copy in one.copies if all(teeth[i] == teeth[j] for i, j in corresponding(one, copy).items())]
        if one.planets is None or not copies or not all(mesh.spur for mesh in one.planets.central):
            continue
        found = _EqualPlanets(train, tree, one, copies, sizes, outlines())
        yield from found.assembly()
        yield from found.clearance()


class _EqualPlanets:
    """Equal sets of planets on one carrier, evenly spaced unless the positions of all their axes are declared."""

    def __init__(
        self,
        train: Train,
        tree: Tree,
        one: PlanetSet,
        copies: Sequence[PlanetSet],
        sizes: PitchDistances,
        outlines: Mapping[str, PairOutline],
    ) -> None:
        assert one.planets is not None
        self.train, self.one, self.planet, self.sizes, self.outlines = train, one, one.planets, sizes, outlines
        self.tips: dict[str, float] = {}  # declared tip radii; the largest, if a wheel has different ones in its pairs
        for wheel, tip in (each for outline in outlines.values() for each in outline.tips.items()):
            self.tips[wheel] = max(tip, self.tips.get(wheel, 0.0))
        self.firsts = [self.planet.link, *(copy.planets.link for copy in copies if copy.planets is not None)]
        self.number = len(self.firsts)
        # equal sets mesh at multiples of 1/step turn; at any angle if it is 0
        exact = PhaseArithmetic(int, gcd, bezout, lambda number: number)
        self.step = gcd(*phase_numbers(self.planet, exact))
        axes = [tree.axis(link) for link in self.firsts]
        self.points = _planet_positions(train, tree.axis(one.carrier), axes)
        self.place = train.place("links", self.firsts[-1])
        self.names = ", ".join(f"'{link}'" for link in self.firsts)

    # -------------------------------------------------------------------------------------------------------- assembly

    def assembly(self) -> Iterator[BuildFinding]:
        """Yield findings of rules A1 (simple planets that mesh only with central wheels) and A2 (other planets)."""
        if not self.step:
            return
        rule = "A1" if len(self.planet.wheels) == 1 and not self.planet.outward else "A2"
        if self.points is not None:
            yield from self._check_placed(rule, self.points)
        elif self.step % self.number:
            yield self._uneven_spacing(rule)

    def _check_placed(self, rule: str, points: Sequence[tuple[float, float]]) -> Iterator[BuildFinding]:
        turns = [atan2(y, x) / tau for x, y in points]
        # planets mesh at multiples of 1/step turn from the first one: the distance to the nearest is in pitches
        misses = [self.step * (turn - turns[0]) for turn in turns]
        off = [abs(miss - round(miss)) for miss in misses]
        worst = max(off)
        if worst <= _NEGLIGIBLE:
            return
        at = off.index(worst)
        what = (
            f"planet '{self.firsts[at]}' does not mesh where it is placed: its teeth are misaligned by "
            f"{worst:.3g} pitch"
        )
        why = (
            f"relative to '{self.one.carrier}' it is {360 * ((turns[at] - turns[0]) % 1):.6g} deg from "
            f"'{self.firsts[0]}', but such planets mesh only at multiples of {self._degrees}"
        )
        moved = [
            f"'{link}' {360 * (round(miss) / self.step % 1):.6g} deg"
            for link, miss, far in zip(self.firsts, misses, off, strict=True)
            if far > _NEGLIGIBLE
        ]
        fix = f"place {', '.join(moved)} from '{self.firsts[0]}'"
        problem = Problem(what, why, self._fix(rule, fix), self.place)
        yield BuildFinding(rule, "error" if worst > _MISS and rule == "A1" else "note", problem)

    def _uneven_spacing(self, rule: str) -> BuildFinding:
        """Return the finding that planets cannot be evenly spaced: an error if uneven spacing causes collisions."""
        minimum = max((self._minimum_angle(planet, _STUB) for planet in self.planet.walk()), default=0.0)
        # 1e-9: an angle that is an integer number of steps to rounding needs no further step
        steps = max(1, ceil(minimum * self.step - 1e-9))
        fits = self.number * steps <= self.step
        whole, rest = divmod(self.step, self.number)
        even = [count for count in range(2, self._maximum_number() + 1) if self.step % count == 0]
        what = f"{self.number} equal planets {self.names} on '{self.one.carrier}' cannot be evenly spaced"
        why = f"they mesh only at multiples of {self._degrees}, and {self.step} is not a multiple of {self.number}"
        if not fits:
            why += "; with uneven spacing, planets would collide"
        fix = "change a tooth count"
        if even:
            *some, last = map(str, even)
            listed = f"{', '.join(some)} or {last}" if some else last
            fix = f"use {listed} planets, which can be evenly spaced"
        if fits:
            spread = f"{whole} or {whole + 1} of these steps ({rest} of the gaps with {whole + 1})"
            fix = f"space neighbours by {spread}, or {fix}"
        level: BuildLevel = "note" if fits or rule == "A2" else "error"
        return BuildFinding(rule, level, Problem(what, why, self._fix(rule, fix), self.place))

    @property
    def _degrees(self) -> str:
        return f"{360 / self.step:.6g} deg (1/{self.step} turn)"

    @staticmethod
    def _fix(rule: str, fix: str) -> str:
        return fix if rule == "A1" else f"{fix}; or join the wheels of each planet at a different angle"

    # ------------------------------------------------------------------------------------------------------------ room

    def clearance(self) -> Iterator[BuildFinding]:
        """Yield findings of rule A3: neighbouring planets whose tips overlap or nearly touch."""
        for planet in self.planet.walk():
            for mesh in planet.mesh_of.values():
                wheel = planet.own(mesh)
                reach, teeth = self._axis_distance(planet, wheel), self.train.wheels[wheel][1].count or 0
                # discs on eccentrics are next to each other along the axis
                if reach is not None and 0 < reach < ON_ECCENTRIC * teeth:
                    continue
                gap = self._neighbour_clearance(planet, mesh, self.number)
                if gap is not None and gap < _CLEAR:
                    yield self._small_clearance(wheel, gap)
            for mesh, other in planet.outward:
                gap = self._passing_clearance(planet, other, mesh)
                if gap is not None and gap < 0:
                    wheels = planet.own(mesh), other.own(mesh)
                    what = f"'{wheels[0]}' and '{wheels[1]}' of neighbouring planet sets collide ({self.number} sets)"
                    why = f"their tip circles overlap by {-gap:.4g} modules"
                    fix = "use fewer planets, or change their tooth counts"
                    yield self._clearance_finding(wheels, gap, what, why, fix)

    def _small_clearance(self, wheel: str, gap: float) -> BuildFinding:
        module = self._module(wheel)
        far = f"{abs(gap):.4g} modules" if module is None else f"{abs(gap) * module:.4g} mm"
        what = f"the tips of {self.number} planets '{wheel}' "
        what += f"overlap by {far}" if gap <= 0 else f"have a clearance of only {far}"
        why = "the axes of neighbours are 2 a sin(pi/n) apart, less than their tip diameter"
        if self.points is not None:
            why = "neighbours are placed at a distance less than their tip diameter"
        if gap > 0:
            why += f" plus {_CLEAR:g} modules"
        # evenly spaced planets of the declared number are too close, so fewer are suggested
        most = self._maximum_number() if self.points is not None else min(self._maximum_number(), self.number - 1)
        return self._clearance_finding((wheel, wheel), gap, what, why, f"use at most {most} planets, or smaller ones")

    def _clearance_finding(self, wheels: tuple[str, str], gap: float, what: str, why: str, fix: str) -> BuildFinding:
        """Return a finding on the tip clearance `gap` [modules]: an error if even stub teeth overlap, or a note if they
        do not.
        """
        free = sum(wheel not in self.tips for wheel in wheels)
        # addendum at which the tips just touch if all undeclared teeth are shortened equally
        fits = _FULL + gap / free if free else 0.0
        if gap <= 0 and fits >= _STUB:
            what += f" unless their addenda are at most {floor(1000 * fits) / 1000:g}"
            fix = f"declare a `tooth_form` with such an `addendum`, or {fix}"
        level: BuildLevel = "error" if gap <= 0 and fits < _STUB else "note"
        return BuildFinding("A3", level, Problem(what, why, fix, self.place))

    def _module(self, wheel: str) -> float | None:
        """Return the transverse module of a wheel [mm]; None if it is undetermined."""
        module = self.sizes.module(wheel)
        return None if module is None else float(module) * self.train.wheels[wheel][1].slant

    def _neighbour_clearance(self, planet: Planet, mesh: AssemblyMesh, number: int) -> float | None:
        """Return the tip clearance of equal wheels of `number` evenly spaced planets [modules]; None if unknown."""
        tips = self._tip_diameter(planet, mesh)
        # positions are known only for the first planet of each set
        if self.points is not None and planet is self.planet and number == self.number:
            module = self._module(planet.own(mesh))
            if module is None:
                return None
            near = min(
                sqrt((x - u) ** 2 + (y - v) ** 2) for at, (x, y) in enumerate(self.points) for u, v in self.points[:at]
            )
            return near / module - tips
        reach = self._axis_distance(planet, planet.own(mesh))
        return None if reach is None else float(sum(neighbour_terms(sqrt, reach, tips, sin(pi / number))))

    def _tip_diameter(self, planet: Planet, mesh: AssemblyMesh, addendum: float = _FULL) -> float:
        """Return the tip diameter of a planet's wheel [modules]; undeclared teeth have the given addendum [modules]."""
        wheel = planet.own(mesh)
        declared = self.tips.get(wheel)
        return (self.train.wheels[wheel][1].count or 0) + 2 * addendum if declared is None else 2 * declared

    def _mesh_distance(self, mesh: AssemblyMesh) -> float:
        """Return twice the centre distance of a pair [modules]."""
        outline = self.outlines.get(mesh.name)
        return float(sum(sign * int(part) for sign, part in mesh.terms)) if outline is None else 2 * outline.distance

    def _axis_distance(self, planet: Planet, wheel: str = "") -> float | None:
        """Return twice the distance of the axes of planet and carrier [modules of `wheel`]; None if it is unknown."""
        meshes = sorted(planet.central, key=lambda mesh: (planet.own(mesh) != wheel, mesh.ring is not None))
        if not meshes:
            return None
        own = planet.own(meshes[0])
        wheel = wheel or own
        scale = self.sizes.sizes.ratio(("wheel", own), ("wheel", wheel))
        slants = [self.train.wheels[each][1].slant for each in (own, wheel)]
        return None if scale is None else self._mesh_distance(meshes[0]) * float(scale) * slants[0] / slants[1]

    def _passing_clearance(self, planet: Planet, other: Planet, mesh: AssemblyMesh) -> float | None:
        """Return the minimum tip clearance of meshing planets from different sets [modules]; None if it is unknown, for
        a pair with a ring, and for planets with declared positions.
        """
        A, B = self._axis_distance(planet, planet.own(mesh)), self._axis_distance(other, other.own(mesh))
        if A is None or B is None or mesh.ring is not None or self.points is not None:
            return None
        D = self._mesh_distance(mesh)
        # the triangle of the three axes does not exist
        if not abs(A - B) <= D <= A + B:
            return None
        tips = self._tip_diameter(planet, mesh) + self._tip_diameter(other, mesh)
        squares = []
        for step in range(1, self.number):
            turn = tau * step / self.number
            terms = passing_terms(lambda square: sqrt(max(square, 0.0)), A, B, D, 0.0, cos(turn), sin(turn))
            squares.append(sum(terms))
        return (sqrt(max(min(squares), 0.0)) - tips) / 2

    def _minimum_angle(self, planet: Planet, addendum: float = _FULL) -> float:
        """Return the smallest angle between neighbouring planets at which their tips do not overlap [turn]."""
        found = 0.0
        for mesh in planet.mesh_of.values():
            reach = self._axis_distance(planet, planet.own(mesh))
            if reach:
                found = max(found, 2 * asin(min(self._tip_diameter(planet, mesh, addendum) / reach, 1.0)) / tau)
        return found

    def _maximum_number(self) -> int:
        """Return the maximum number of evenly spaced planets without overlap; if it is unknown, the declared number."""
        minimum = max((self._minimum_angle(planet) for planet in self.planet.walk()), default=0.0)
        # 1e-9: rounding must not reduce the number of planets whose tips just touch
        return max(1, int(1 / minimum + 1e-9)) if minimum else self.number


def _planet_positions(train: Train, centre: str | None, axes: Sequence[str | None]) -> list[tuple[float, float]] | None:
    """Return the coordinates (x, y) of planets relative to their carrier's axis [mm]; None if a position is missing."""
    places = [train.axes[label].point if label in train.axes else None for label in (centre or "", *map(str, axes))]
    spots = [place for place in places if place is not None]
    if len(spots) < len(places):
        return None
    x, y = frame(train.axes[centre or ""].way)
    return [(dot(minus(spot, spots[0]), x), dot(minus(spot, spots[0]), y)) for spot in spots[1:]]
