"""All tooth sets of an epicyclic kind within bounds, as columns, and their exact ratios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import pi, prod, sin
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.kinematics.buildability.equal_planets import neighbour_terms, passing_terms
from geartrain.search.constraints.decimal_sines import cosine, is_positive, sine
from geartrain.search.epicyclic.set_kinds import CentralWheel, EpicyclicKind, EpicyclicMode

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats, Ints

    Columns = Mapping[str, Ints]
    from geartrain.numerics.arrays import Ints
    from geartrain.search.tooth_count_ranges import Counts


# Whether an epicyclic set can be put together: where equal planets can stand, and how much room neighbours have.


TIPS = 2.0
"""Twice the addendum, in modules: what a wheel's tips stand out over its pitch diameter."""
_BEVEL = 1e-9  # modules; what floats may be off where room and clearance are equal
_NEAR = 1e-6  # modules; what floats say of the room is nearer than this


def places(kind: EpicyclicKind, columns: Columns) -> Ints:
    """At how many equally spaced places an identical planet can stand, for sets as columns of counts.

    n equal planets, equally spaced, can be put in exactly if n divides the number; 0 means that they can anywhere.

    Turn the carrier by 1/n with central wheel x held: wheel y turns (1 - f_y/f_x)/n, which must bring tooth to tooth
    where the next planet is put in. With both on one step of the planet that asks for (z_y -+ z_x)/n whole. On two
    steps the planet may also go in turned by whole teeth of the first, which shifts the second by P_y/P_x of a tooth
    each: (z_y P_x -+ z_x P_y)/(n gcd(P_x, P_y)) whole. The well known cases are (s + r)/n and, for stepped planets,
    (s1 p2 + r2 p1)/(n gcd(p1, p2)).
    """
    number: Ints = np.zeros_like(columns[kind.members[0].wheel])
    for x, y in combinations(kind.members, 2):
        zx, zy = columns[x.wheel], columns[y.wheel]
        if x.step != y.step:
            common = np.gcd(columns[x.step], columns[y.step])
            zx, zy = zx * (columns[y.step] // common), zy * (columns[x.step] // common)
        number = np.gcd(number, np.abs(zy - x.sign * y.sign * zx))
    return number


def fits(kind: EpicyclicKind, columns: Columns) -> NDArray[np.bool_]:
    """True where one planet (or pair of planets) has its place between the central wheels.

    Planets are smaller than their ring; planets in mesh reach from wheel to wheel and touch nothing they do not mesh
    with; cones of bevel wheels open outwards. Addendum one module; interference of flanks is not judged here.
    """
    good = np.ones(columns[kind.members[0].wheel].shape, dtype=bool)
    for member in kind.members:
        if member.internal:
            good &= columns[member.wheel] > columns[member.mesh]
    if kind.name == "meshed-planets":
        gap = columns["r"] - columns["s"]
        good &= (2 * columns["p1"] + 2 * TIPS < gap) & (gap < 2 * (columns["p1"] + columns["p2"]))
    if kind.name == "ravigneaux":
        # the long planet passes by the small sun, and the short one reaches it
        good &= (columns["s2"] - columns["s1"] > 2 * TIPS) & (columns["s1"] + 2 * columns["ps"] > columns["s2"])
    if kind.bevel:
        good &= np.abs(columns["s1"] - columns["s2"]) < 2 * columns["p"]
        good &= _side_cosine(columns, "s1", "s2") >= 0
        good &= _side_cosine(columns, "s2", "s1") >= 0
    return good


def room(kind: EpicyclicKind, columns: Columns, planets: int) -> Floats:
    """Room between the tips of neighbouring planets, equally spaced (modules); negative where they overlap.

    (s + p) sin(pi/n) - p - 2 for planets on one circle; those in mesh with each other are placed by the law of
    cosines. Infinite for one planet.
    """
    if planets == 1:
        return np.full(columns[kind.members[0].wheel].shape, np.inf)
    if kind.bevel:
        return _bevel_room(columns, planets)
    distances = [_distance(kind, columns, link).astype(np.float64) for link in kind.planets]
    tips = [np.maximum.reduce([columns[wheel] for wheel in link]) + TIPS for link in kind.planets]
    own: list[Floats] = [d * sin(pi / planets) - tip for d, tip in zip(distances, tips, strict=True)]
    if len(own) == 1:
        return own[0]
    (first, second), (a, b) = distances, kind.between[0]
    # no division by 0 where a planet would stand on the axis: such sets do not fit anyway
    cosine = (first**2 + second**2 - (columns[a] + columns[b]) ** 2) / np.maximum(2 * first * second, 1)
    angle = np.arccos(np.clip(cosine, -1, 1))
    for turn in range(1, planets):
        cosine = np.cos(2 * pi * turn / planets - angle)
        apart = np.sqrt(np.maximum(first**2 + second**2 - 2 * first * second * cosine, 0))
        own.append((apart - tips[0] - tips[1]) / 2)
    return np.asarray(np.minimum.reduce(own), dtype=np.float64)


def clears(kind: EpicyclicKind, columns: Columns, planets: int, clearance: Fraction) -> NDArray[np.bool_]:
    """True where the room between the tips of neighbouring planets is at least so many modules.

    Near ties are decided as the clearance of a declared train is, exactly; of bevel wheels, whose room is an angle, in
    floats.
    """
    found, least = room(kind, columns, planets), float(clearance)
    good = np.asarray(found >= least - _BEVEL)
    near = np.flatnonzero(np.abs(found - least) <= _NEAR)
    if len(near) and not kind.bevel:
        good[near] = _clears_exactly(kind, {w: column[near] for w, column in columns.items()}, planets, clearance)
    return good


def _clears_exactly(kind: EpicyclicKind, columns: Columns, planets: int, clearance: Fraction) -> NDArray[np.bool_]:
    # all lengths are multiplied by the denominator, so that they are whole
    unit, least = clearance.denominator, clearance.numerator
    reaches = [unit * _distance(kind, columns, link) for link in kind.planets]
    tips = [unit * (np.maximum.reduce([columns[wheel] for wheel in link]) + int(TIPS)) for link in kind.planets]
    chord, good = sine(Fraction(1, 2 * planets)), np.ones(reaches[0].shape, dtype=bool)
    for reach, tip in zip(reaches, tips, strict=True):
        good &= is_positive(neighbour_terms, [reach, tip + least], [chord], strictly=False)
    for a, b in kind.between:
        mesh, both = unit * (columns[a] + columns[b]), tips[0] + tips[1] + 2 * least
        for turn in (Fraction(step, planets) for step in range(1, planets)):
            lengths = [reaches[0], reaches[1], mesh, both]
            good &= is_positive(passing_terms, lengths, [cosine(turn), sine(turn)], strictly=False)
    return good


def _distance(kind: EpicyclicKind, columns: Columns, link: tuple[str, ...]) -> Ints:
    """From the central axis to a planet's, in half modules."""
    member = next(member for member in kind.members if member.mesh in link)
    planet = columns[member.mesh]
    return columns[member.wheel] + (-planet if member.internal else planet)


def _side_cosine(columns: Columns, own: str, other: str) -> Floats:
    """Cosine of the cone of a side wheel, where both side wheels fit one planet.

    The cones g of planet p and side wheels a, b obey sin g / z alike and g_a + g_b + 2 g_p = pi: a triangle with the
    sides a, b and 2 p cos g_p, so that cos^2 g_p = (a + b)^2 / 4(p^2 + ab).
    """
    a, b, third = columns[own], columns[other], 2 * columns["p"] * _planet_cosine(columns)
    return np.asarray((b**2 + third**2 - a**2) / (2 * b * third), dtype=np.float64)


def _planet_cosine(columns: Columns) -> Floats:
    a, b, p = columns["s1"], columns["s2"], columns["p"]
    return np.asarray(np.sqrt(np.minimum(1, (a + b) ** 2 / (4 * (p**2 + a * b)))), dtype=np.float64)


def _bevel_room(columns: Columns, planets: int) -> Floats:
    """On the sphere of the back cones: the angle between neighbouring axes less their tip cones, times its radius."""
    cone = np.arccos(_planet_cosine(columns))
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = columns["p"] / (2 * np.sin(cone))
        shaft = cone + np.arccos(np.clip(_side_cosine(columns, "s1", "s2"), -1, 1))
        between = 2 * np.arcsin(np.clip(np.sin(shaft) * sin(pi / planets), 0, 1))
        found = radius * (between - 2 * cone) - TIPS
    return np.where(np.isfinite(found), found, -np.inf)


MOST_SETS = 4 * 10**8
MOST_TEETH = 100_000
"""Numerators of third degree in the counts stay below 2^53 up to here."""

SetBounds = Mapping[str, tuple[int, ...]]
"""Admissible counts of every wheel, ascending."""


def read_bounds(kind: EpicyclicKind, counts: Counts | Mapping[str, Counts]) -> SetBounds:
    """Admissible counts of every wheel: the same for all, or by wheel. Raises `QuestionError`."""
    if isinstance(counts, Mapping):
        unknown = [wheel for wheel in counts if wheel not in kind.wheels]
        missing = [wheel for wheel in kind.wheels if wheel not in counts]
        if unknown or missing:
            what = f"'{unknown[0]}' is no wheel of" if unknown else f"wheel '{missing[0]}' has no counts in"
            why = f"its wheels are {', '.join(kind.wheels)}"
            raise QuestionError(Problem(f"{what} the kind '{kind.name}'", why, "give counts for each of them"))
        return {wheel: _usable(f"of wheel '{wheel}' ", counts[wheel]) for wheel in kind.wheels}
    return dict.fromkeys(kind.wheels, _usable("", counts))


def _usable(whose: str, counts: Counts) -> tuple[int, ...]:
    found = tuple(sorted(set(counts))) if len(counts) <= MOST_TEETH else ()
    if found and found[0] >= 1 and found[-1] <= MOST_TEETH:
        return found
    why = f"the search takes counts from 1 to {MOST_TEETH}, and at least one"
    raise QuestionError(Problem(f"the counts {whose}cannot be used", why, "give counts such as 15:120"))


def size(kind: EpicyclicKind, bounds: SetBounds, slack: int = 0) -> int:
    """How many sets there are before any constraint."""
    chosen = prod(len(bounds[wheel]) for wheel in kind.free)
    return int(chosen * (2 * slack + 1) ** len(_followers(kind)))


def blocks(
    kind: EpicyclicKind, bounds: SetBounds, planets: int, clearance: Fraction | None, slack: int = 0
) -> Iterator[tuple[int, Columns]]:
    """All sets, block by block: how many a block had, and those of them whose wheels are whole, allowed and fit.

    planets    equal planets among which an idle wheel must find room
    clearance  that room (modules), or None where it does not matter
    slack      half modules by which the other centre distances may differ from the first; profile shift bridges them

    Raises `RangeError` for more than `MOST_SETS` sets.
    """
    total = size(kind, bounds, slack)
    if total > MOST_SETS:
        why = f"the search looks at each, and takes {MOST_SETS:.0e} at most"
        raise RangeError(Problem(f"{total:.2g} tooth sets to look at", why, "narrow the counts, or ask for less slack"))
    first, *rest = (np.array(bounds[wheel], dtype=np.int64) for wheel in kind.free)
    inner = [column.ravel() for column in np.meshgrid(*rest, indexing="ij")]
    # about 20,000 sets at a time fit the processor's cache
    step = max(1, 20_000 // max(1, len(inner[0])))
    for at in range(0, len(first), step):
        head = first[at : at + step]
        columns = [np.repeat(head, len(inner[0])), *(np.tile(column, len(head)) for column in inner)]
        chosen = dict(zip(kind.free, columns, strict=True))
        for extra in product(range(-slack, slack + 1), repeat=len(_followers(kind))):
            yield len(columns[0]), _completed(kind, bounds, chosen, extra, planets, clearance)


def _followers(kind: EpicyclicKind) -> list[tuple[CentralWheel, CentralWheel]]:
    """Central wheels whose count follows from another one's: both meet the same planet link, so share a distance."""
    if kind.bevel:
        return []
    found = []
    for link in kind.planets:
        first, *others = [member for member in kind.members if member.mesh in link]
        found += [(first, other) for other in others]
    return found


def _completed(
    kind: EpicyclicKind,
    bounds: SetBounds,
    chosen: Columns,
    extra: Sequence[int],
    planets: int,
    clearance: Fraction | None,
) -> Columns:
    """The sets with their remaining wheels, without those that cannot be."""
    columns = dict(chosen)
    for (first, other), more in zip(_followers(kind), extra, strict=True):
        distance = columns[first.wheel] + (-1 if first.internal else 1) * columns[first.mesh] + more
        columns[other.wheel] = distance + (1 if other.internal else -1) * columns[other.mesh]
        columns = _kept(columns, _allowed(columns[other.wheel], bounds[other.wheel]))
    if kind.idle:
        columns = _with_idle(kind, bounds, columns, planets, clearance)
    return _kept(columns, fits(kind, columns) & _is_stepped(kind, columns))


def _is_stepped(kind: EpicyclicKind, columns: Columns) -> NDArray[np.bool_]:
    """False for equal steps of a planet that do what a plain planet does.

    They differ from one only where they meet two suns, or two rings, of different counts, which slack allows.
    """
    stepped = np.ones(len(columns[kind.free[0]]), dtype=bool)
    for one, other in ((one, other) for link in kind.planets for one, other in combinations(link, 2)):
        differ = columns[one] != columns[other]
        for first, second in combinations(kind.members, 2):
            if {first.mesh, second.mesh} == {one, other} and first.internal == second.internal:
                differ |= columns[first.wheel] != columns[second.wheel]
        stepped &= differ
    return stepped


def _with_idle(
    kind: EpicyclicKind, bounds: SetBounds, columns: Columns, planets: int, clearance: Fraction | None
) -> dict[str, Ints]:
    """The least count of the idle wheels that fits, in every set that has one."""
    # an idle wheel takes part in no ratio: the least count that fits stands for all
    common = set[int].intersection(*(set(bounds[wheel]) for wheel in kind.idle))
    found: Ints = np.zeros_like(columns[kind.free[0]])
    for count in sorted(common):
        open_ = np.flatnonzero(found == 0)
        tried = {wheel: column[open_] for wheel, column in columns.items()}
        tried |= {wheel: np.full(len(open_), count, dtype=np.int64) for wheel in kind.idle}
        at = np.flatnonzero(fits(kind, tried))
        if clearance is not None:
            at = at[clears(kind, _kept(tried, at), planets, clearance)]
        found[open_[at]] = count
    full = {**columns, **dict.fromkeys(kind.idle, found)}
    return _kept(full, found > 0)


def _allowed(column: Ints, allowed: tuple[int, ...]) -> NDArray[np.bool_]:
    if allowed[-1] - allowed[0] + 1 == len(allowed):
        return (column >= allowed[0]) & (column <= allowed[-1])
    return np.isin(column, allowed)


def _kept(columns: Columns, good: NDArray[np.bool_] | Ints) -> dict[str, Ints]:
    return {wheel: column[good] for wheel, column in columns.items()}


def ratio_terms(kind: EpicyclicKind, mode: EpicyclicMode, columns: Columns) -> tuple[Ints, Ints]:
    """Speed of the input over that of the output as numerator and denominator, exact and not reduced.

    (f_in - f_held) / (f_out - f_held) by Willis, with f = sign P / z for central wheels and 0 for the carrier.
    Where one of them is 0 the mode does not run: the output stands, or the input is locked.
    """
    (n1, d1), (n2, d2), (n0, d0) = (
        _relative(kind.member(link), columns) for link in (mode.input, mode.output, mode.held)
    )
    return np.asarray((n1 * d0 - n0 * d1) * d2, dtype=np.int64), np.asarray((n2 * d0 - n0 * d2) * d1, dtype=np.int64)


def _relative(member: CentralWheel | None, columns: Columns) -> tuple[Ints | int, Ints | int]:
    if member is None:
        return 0, 1
    return member.sign * (columns[member.step] if member.step else 1), columns[member.wheel]
