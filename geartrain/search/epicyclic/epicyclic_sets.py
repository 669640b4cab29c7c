"""Types of epicyclic gear sets, results of a search, and declarations of the sets found.

Relative to the carrier, every central wheel turns `f = s P / z` times as fast as the reference wheel of the planets,
where s is the sign 1 or -1, z is the tooth count of the central wheel, and P is the tooth count of the planet wheel
with which it meshes (Willis 1841, with a fixed carrier). The signs and meshes define a type. They determine the ratio
for every fixed member, the possible positions of equal planets, and the conditions for coaxial wheels.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import permutations
from types import MappingProxyType
from typing import Any, ClassVar, Literal

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.numerics.exact import abridged_text, as_float, decimal
from geartrain.numerics.results import Key, Result, Tabular, brief, finite
from geartrain.search.search_outcome import CountSizes, Shortfall

CARRIER = "carrier"


@dataclass(frozen=True, slots=True)
class CentralWheel:
    """Sun or ring of an epicyclic set, with the planet wheel with which it meshes. `sign` and `step` determine its
    speed relative to the carrier.
    """

    link: str
    """Name of the link to which the wheel belongs."""
    wheel: str
    """Name of the wheel."""
    mesh: str
    """Name of the planet wheel that meshes with the central wheel."""
    sign: int
    """Sign of the speed of the central wheel divided by the speed of the reference planet wheel, both relative to the
    carrier: 1 or -1.
    """
    step: str = ""
    """Name of the planet wheel whose tooth count is P in the speed f = sign P / z of the central wheel; empty if P is
    the same for all central wheels, so that it cancels in the ratios.
    """
    internal: bool = False
    """True if the central wheel is a ring; False if it is a sun."""


@dataclass(frozen=True, slots=True)
class EpicyclicMode:
    """Operating mode of an epicyclic set: its driving, driven and fixed members."""

    input: str
    """Name of the driving member."""
    output: str
    """Name of the driven member."""
    held: str
    """Name of the fixed member."""

    @property
    def key(self) -> str:
        """Operating mode in the format `input:output:held`, such as `sun:carrier:ring`."""
        return f"{self.input}:{self.output}:{self.held}"

    def __str__(self) -> str:
        return f"{self.input} in, {self.output} out, {self.held} held"


def mode_key(mode: EpicyclicMode) -> str:
    """Format an operating mode as `input:output:held`."""
    return mode.key


@dataclass(frozen=True, slots=True)
class EpicyclicKind(Result):
    """Type of epicyclic gear set, such as the set of sun, planet and ring. It defines the wheels, their meshes and the
    operating modes.
    """

    KEYS = ("title", "wheels", Key("modes", to=mode_key))

    name: str
    """Name of the type, such as "planetary"."""
    title: str
    """Description of the type."""
    members: tuple[CentralWheel, ...]
    """Central wheels of this type of set."""
    planets: tuple[tuple[str, ...], ...]
    """Names of the wheels on each planet link."""
    free: tuple[str, ...]
    """Names of the wheels with independent tooth counts. The coaxial equations give the tooth counts of the other
    central wheels.
    """
    between: tuple[tuple[str, str], ...] = ()
    """Names of the planet wheels that mesh with each other, in pairs."""
    idle: tuple[str, ...] = ()
    """Names of planet wheels whose tooth counts affect neither a ratio nor a coaxial equation. The search assigns each
    of them the minimum tooth count with which the planets fit.
    """
    with_carrier: bool = True
    """True if the carrier may be the input, the output or the fixed member of a mode."""
    mirrored: tuple[tuple[str, str], ...] = ()
    """Pairs of links that can be exchanged without changing the set, so that half of the operating modes are
    sufficient.
    """
    bevel: bool = False
    """True if the axes of the planets intersect the central axis."""

    @property
    def wheels(self) -> tuple[str, ...]:
        """Names of all central wheels and planet wheels, in the order in which tooth counts are listed."""
        planets = [wheel for link in self.planets for wheel in link]
        return tuple(sorted([*(member.wheel for member in self.members), *planets], key=_ORDER.index))

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links of the central wheels, followed by the name of the carrier."""
        return (*(member.link for member in self.members), CARRIER)

    @property
    def modes(self) -> tuple[EpicyclicMode, ...]:
        """All operating modes of this type. Only one of two modes that are mirror images is included."""
        links = self.links if self.with_carrier else self.links[:-1]
        # exchange of mirrored links in both directions
        swap = {a: b for pair in self.mirrored for a, b in (pair, pair[::-1])}
        found: dict[EpicyclicMode, None] = {}
        for mode in (EpicyclicMode(*three) for three in permutations(links, 3)):
            if EpicyclicMode(*(swap.get(link, link) for link in (mode.input, mode.output, mode.held))) not in found:
                found[mode] = None
        return tuple(found)

    def member(self, link: str) -> CentralWheel | None:
        """Return the central wheel on a link; None for the carrier."""
        return next((member for member in self.members if member.link == link), None)

    def chosen(self, modes: str | Iterable[str | EpicyclicMode]) -> tuple[EpicyclicMode, ...]:
        """Return all operating modes if `modes` is "all", or the given modes, which are `EpicyclicMode` objects or
        strings in the format `input:output:held`. `QuestionError` is raised if one of them is not a mode of this type.
        """
        if modes == "all":
            return self.modes
        found = []
        for mode in [modes] if isinstance(modes, str) else modes:
            parts = [part.strip() for part in (mode if isinstance(mode, str) else mode.key).split(":")]
            if len(parts) != 3 or len(set(parts)) < 3 or not set(parts) <= set(self.links):
                raise QuestionError(
                    Problem(
                        f"'{mode}' is not a mode of the kind '{self.name}'",
                        f"a mode is input:output:held with three different members of {', '.join(self.links)}",
                        f"for example, write {self.modes[0].key}, or all",
                    )
                )
            found.append(EpicyclicMode(*parts))
        return tuple(found)


_ORDER = ("s", "s1", "p", "ps", "pl", "p1", "r", "r1", "p2", "s2", "r2")
_TWO = (("sun1", "sun2"),)

_KINDS = (
    EpicyclicKind(
        "planetary",
        "sun, planet, ring",
        (CentralWheel("sun", "s", "p", -1), CentralWheel("ring", "r", "p", 1, internal=True)),
        (("p",),),
        ("s", "p"),
    ),
    EpicyclicKind(
        "stepped-suns",
        "two suns, stepped planet",
        (CentralWheel("sun1", "s1", "p1", -1, "p1"), CentralWheel("sun2", "s2", "p2", -1, "p2")),
        (("p1", "p2"),),
        ("s1", "p1", "p2"),
        mirrored=_TWO,
    ),
    EpicyclicKind(
        "stepped-sun-ring",
        "sun and ring, stepped planet",
        (CentralWheel("sun", "s1", "p1", -1, "p1"), CentralWheel("ring", "r2", "p2", 1, "p2", internal=True)),
        (("p1", "p2"),),
        ("s1", "p1", "p2"),
    ),
    EpicyclicKind(
        "stepped-rings",
        "two rings, stepped planet",
        (
            CentralWheel("ring1", "r1", "p1", 1, "p1", internal=True),
            CentralWheel("ring2", "r2", "p2", 1, "p2", internal=True),
        ),
        (("p1", "p2"),),
        ("r1", "p1", "p2"),
        mirrored=(("ring1", "ring2"),),
    ),
    EpicyclicKind(
        "meshed-planets",
        "sun and ring, two equal planets in mesh between them",
        (CentralWheel("sun", "s", "p1", -1), CentralWheel("ring", "r", "p2", -1, internal=True)),
        (("p1",), ("p2",)),
        ("s", "r"),
        between=(("p1", "p2"),),
        idle=("p1", "p2"),
    ),
    EpicyclicKind(
        "ravigneaux",
        "small sun on short planets, large sun and ring on long ones",
        (
            CentralWheel("small", "s1", "ps", 1),
            CentralWheel("large", "s2", "pl", -1),
            CentralWheel("ring", "r", "pl", 1, internal=True),
        ),
        (("ps",), ("pl",)),
        ("s1", "s2", "pl"),
        between=(("ps", "pl"),),
        idle=("ps",),
    ),
    EpicyclicKind(
        "bevel",
        "two side wheels and a planet across them",
        (CentralWheel("sun1", "s1", "p", -1), CentralWheel("sun2", "s2", "p", 1)),
        (("p",),),
        ("s1", "s2"),
        idle=("p",),
        mirrored=_TWO,
        bevel=True,
    ),
    EpicyclicKind(
        "wolfrom",
        "3K: sun and ring on one step of the planet, a second ring on the other",
        (
            CentralWheel("sun", "s1", "p1", -1, "p1"),
            CentralWheel("ring1", "r1", "p1", 1, "p1", internal=True),
            CentralWheel("ring2", "r2", "p2", 1, "p2", internal=True),
        ),
        (("p1", "p2"),),
        ("s1", "p1", "p2"),
        with_carrier=False,
    ),
    EpicyclicKind(
        "3k-two-suns",
        "3K: sun and ring on one step of the planet, a second sun on the other",
        (
            CentralWheel("sun1", "s1", "p1", -1, "p1"),
            CentralWheel("ring", "r1", "p1", 1, "p1", internal=True),
            CentralWheel("sun2", "s2", "p2", -1, "p2"),
        ),
        (("p1", "p2"),),
        ("s1", "p1", "p2"),
        with_carrier=False,
    ),
)


EPICYCLIC_KINDS: Mapping[str, EpicyclicKind] = MappingProxyType({kind.name: kind for kind in _KINDS})
"""All types of epicyclic sets, keyed by name."""


def epicyclic_kind(name: str) -> EpicyclicKind:
    """Return the type of epicyclic set with a given name. `QuestionError` is raised if there is no such type."""
    if name not in EPICYCLIC_KINDS:
        why = "only the kinds that `geartrain teeth set --kind list` prints can be searched"
        raise QuestionError(Problem(f"'{name}' is not a kind of epicyclic set", why, suggest(name, EPICYCLIC_KINDS)))
    return EPICYCLIC_KINDS[name]


# ------------------------------------------------------------------------------------------------ sets that were found


RatioIs = Literal["input/output", "output/input"]
SetOrder = Literal["error", "total", "largest"]


@dataclass(frozen=True, slots=True)
class EpicyclicSet(CountSizes, Result):
    """Tooth counts and ratio of an epicyclic set in one operating mode.

    See Also
    --------
    find_sets : Search for epicyclic sets.
    """

    KEYS = (
        "kind",
        "mode",
        "teeth",
        Key("input/output", "ratio"),
        Key("output/input", "inverse"),
        Key("value", "ratio", as_float),
        Key("error", to=float),
        Key("exact_error", "error"),
        "planets",
        "places",
        "equally_spaced",
        Key("room", to=finite),
        "total",
        "largest",
    )

    kind: str
    """Name of the type of epicyclic set, such as "planetary"."""
    mode: EpicyclicMode
    """Operating mode: the driving, driven and fixed members."""
    teeth: Mapping[str, int]
    """Tooth count of each wheel."""
    ratio: Fraction
    """Exact input speed divided by output speed; negative if the output turns in the opposite sense to the input."""
    error: Fraction
    """Exact relative error |r| / q - 1, where r is the ratio of the set as defined by `ratio_is` and q is the requested
    ratio.
    """
    planets: int
    """Requested number of planets."""
    places: int
    """Number of equally spaced positions at which identical planets can be assembled; 0 if every position is
    possible.
    """
    room: float
    """Clearance between the tips of equally spaced neighbouring planets [modules]; negative if the planets overlap."""

    def _summary(self) -> str:
        teeth = ", ".join(f"{wheel} {count}" for wheel, count in self.teeth.items())
        return f"{teeth}, input/output {brief(self.ratio)}, error {float(self.error):.3g}"

    @property
    def counts(self) -> Collection[int]:
        """Tooth counts of all wheels."""
        return self.teeth.values()

    @property
    def inverse(self) -> Fraction:
        """Reciprocal of `ratio`: exact output speed divided by input speed."""
        return 1 / self.ratio

    @property
    def equally_spaced(self) -> bool:
        """True if the requested number of planets can be assembled with equal spacing."""
        return self.places % self.planets == 0

    def to_train(self, copies: int = 1) -> dict[str, Any]:
        """Return a declaration of the epicyclic set as plain data.

        In the declaration, the input speed is 1, and the exact output speed is the expected value.

        Parameters
        ----------
        copies : int
            Number of equal planets. `equally_spaced` reports whether `planets`, the number requested in the search, can
            be assembled.
        """
        kind, mode = epicyclic_kind(self.kind), self.mode
        several = len(kind.planets) > 1
        planets = [f"planet{at}" if several else "planet" for at in range(1, len(kind.planets) + 1)]
        revolutes = [{"pair": ["frame", link], "axis": "main"} for link in kind.links]
        revolutes += [{"pair": [CARRIER, planet], "axis": planet} for planet in planets]
        return {
            "name": f"{kind.name}-{mode.key.replace(':', '-')}",
            "title": f"{kind.title}: {mode}",
            "links": _links(kind, planets, self.teeth, copies),
            **({"axes": _AXES} if kind.bevel else {}),
            "revolutes": revolutes,
            "gears": [{"pair": [member.wheel, member.mesh]} for member in kind.members]
            + [{"pair": list(pair)} for pair in kind.between],
            "inputs": {mode.input: 1},
            "fixed": [mode.held],
            "outputs": {mode.output: {"expect": str(self.inverse)}},
        }

    def __str__(self) -> str:
        teeth = ", ".join(f"{wheel} = {count}" for wheel, count in self.teeth.items())
        return f"{teeth}: {abridged_text(self.ratio)} = {decimal(self.ratio, 7)} ({self.mode})"


@dataclass(frozen=True, slots=True)
class SetFindings(Tabular, Result):
    """Best epicyclic sets of one type for a requested ratio, in the order of the search criterion."""

    ROWS = "search.tooth_numbers_report:set_rows"
    MEANINGS: ClassVar = {
        "mode": "Mode as input:output:held.",
        "input/output": "Exact ratio of input to output speed [1].",
        "error": "Ratio divided by the requested ratio, minus 1 [1].",
        "places": "Number of equally spaced positions of equal planets; 0 for any.",
        "room": "Clearance between the tips of neighbouring planets [module].",
        "*": "Tooth count of the wheel.",
    }

    PAGE = "search.tooth_numbers_report:describe_sets"

    KEYS = (
        "kind",
        "wanted",
        "ratio_is",
        Key("modes", to=mode_key),
        Key("tolerance", to=float),
        "complete",
        "count",
        "solutions",
        Key("", "shortfall"),
    )

    kind: str
    """Name of the type of epicyclic set."""
    wanted: Fraction
    """Magnitude of the requested ratio."""
    ratio_is: RatioIs
    """Definition of the ratio `wanted`: input speed divided by output speed, or output speed divided by input speed."""
    modes: tuple[EpicyclicMode, ...]
    """Operating modes that the search covered."""
    tolerance: Fraction | None
    """Maximum absolute relative error; None if the error is not limited."""
    complete: bool
    """Always True, because the search examines all sets within the bounds."""
    count: int
    """Number of combinations of a set and an operating mode that satisfy all constraints, including the tolerance if it
    is given.
    """
    solutions: tuple[EpicyclicSet, ...]
    """Best sets, in the order of the search criterion."""
    shortfall: Shortfall
    """Number of rejected candidates for each reason. A candidate is a combination of a set and an operating mode."""

    def _summary(self) -> str:
        best = f", best {self.solutions[0]._summary()}" if self.solutions else ""
        return f"{self.kind}, {self.ratio_is} = {brief(self.wanted)}: {len(self.solutions)} sets{best}"

    def __bool__(self) -> bool:
        return bool(self.solutions)


# ---------------------------------------------------------------------------------------------- a set as a declaration


# a bevel planet turns about an axis across the central axis
_AXES = {"main": {"direction": [1, 0, 0]}, "planet": {"direction": [0, 1, 0]}}


def _links(kind: EpicyclicKind, planets: Sequence[str], teeth: Mapping[str, int], copies: int) -> dict[str, Any]:
    links: dict[str, Any] = {"frame": {}}
    for at, member in enumerate(kind.members):
        # the second side wheel faces the first
        facing = {"facing": -1} if kind.bevel and at else {}
        links[member.link] = {"wheels": {member.wheel: _wheel(kind, teeth[member.wheel], member.internal) | facing}}
    links[CARRIER] = {}
    for name, wheels in zip(planets, kind.planets, strict=True):
        links[name] = {"wheels": {wheel: _wheel(kind, teeth[wheel], False) for wheel in wheels}}
        if copies > 1:
            links[name]["copies"] = copies
    return links


def _wheel(kind: EpicyclicKind, teeth: int, internal: bool) -> dict[str, Any]:
    wheel: dict[str, Any] = {"teeth": teeth}
    if internal:
        wheel["internal"] = True
    if kind.bevel:
        wheel["kind"] = "bevel"
    return wheel
