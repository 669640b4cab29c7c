"""Tooth numbers that nearly share one pitch, by exhaustive search: loops that close and tips that clear come first.

And the range of tooth ratios at which equal neighbouring gears on a sphere do not overlap.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import ceil, degrees, inf, pi
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.results import Key, Result, Shown
from geartrain.spherical.configuration import (
    Configuration,
    MeshKind,
    closes,
    divisors,
    kinds_in_order,
    loop_rules,
    mesh_kinds,
    nearest_unmeshed,
    residue,
)
from geartrain.spherical.gear_sizes import TIP_ROOM
from geartrain.spherical.pitch_cones import base_pitch, operating_pitch, overlap_limit, pitch_cone, pressure_angle

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats


Order = Literal["mismatch", "teeth", "front"]
_MOST_SETS = 2 * 10**8  # each is looked at


def suggest_tooth_counts(
    configuration: Configuration,
    most: int = 60,
    best: int = 20,
    *,
    minimum: int = 6,
    order: Order = "mismatch",
    mismatch: float = 0.01,
    tolerance: float = 1e-9,
    fixed: Mapping[str, int] | None = None,
) -> ToothCountSuggestions:
    """The best tooth numbers whose loops close and whose tips clear: an exhaustive search.

    Every set is looked at: time grows with the product of the ranges. Tips clear if gears that do not mesh leave two
    modules between their largest operating pitch cones.

    Parameters
    ----------
    configuration : Configuration
        The set; its own teeth are not asked for.
    most, minimum : int
        Bounds of the tooth numbers.
    best : int
        How many sets are given.
    order : {"mismatch", "teeth", "front"}
        `mismatch`: least |mismatch| first; `teeth`: least total first; `front`: only sets that every set of no more
        teeth exceeds in mismatch, least total first.
    mismatch : float
        Sets whose pitches differ by more (as a logarithm) are left out.
    tolerance : float
        By how much a loop may miss where its angles are only known in floats [pitches].
    fixed : mapping of str to int, optional
        Teeth of kinds that are chosen already.

    Returns
    -------
    ToothCountSuggestions
        The sets, best first, and what removed the rest.

    Raises
    ------
    QuestionError
        If no gears mesh, or an odd loop keeps the set from turning.
    RangeError
        If there are more than 2e8 sets.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron
    >>> found = suggest_tooth_counts(from_polyhedron("rhombicosidodecahedron"), most=30, best=1)
    >>> found.considered, dict(found[0].teeth), round(found[0].mismatch, 8)
    (15625, {'5': 25, '4': 14, '3': 12}, 0.00105949)
    """
    kinds, meshes = kinds_in_order(configuration), mesh_kinds(configuration)
    if not meshes:
        raise QuestionError(Problem("no gears mesh", "a pitch follows from a mesh", "declare at least one mesh"))
    rules = loop_rules(configuration)
    ranges = _ranges(kinds, rules, minimum, most, fixed or {})
    search = _Search(configuration, kinds, meshes, rules, tolerance, mismatch)
    kept = [search.kept(block) for block in _blocks(ranges)]
    rows = np.concatenate(kept) if kept else np.zeros((0, len(kinds)), dtype=np.int64)
    considered = (most - minimum + 1) ** sum(kind not in (fixed or {}) for kind in kinds)
    later = search.tips_removed + search.pitch_removed
    removed = {
        "loops that do not close": considered - later - len(rows),
        "tips that collide": search.tips_removed,
        f"pitches more than {mismatch:g} apart": search.pitch_removed,
    }
    picked = _sorted(rows, np.abs(search.mismatches(list(rows.T))), order)
    found = tuple(search.compromise(row) for row in picked[:best])
    return ToothCountSuggestions(configuration, meshes, found, considered, removed, max(len(picked) - best, 0))


def _ranges(
    kinds: Sequence[str], rules: Sequence[Sequence[Fraction | float]], minimum: int, most: int, fixed: Mapping[str, int]
) -> list[NDArray[np.int64]]:
    """The tooth numbers of each kind that the exact rules leave possible."""
    ranges = []
    for kind, divisor in zip(kinds, divisors(rules, len(kinds)), strict=True):
        first, last = (fixed[kind], fixed[kind]) if kind in fixed else (max(minimum, 1), most)
        ranges.append(np.arange(divisor * ceil(first / divisor), last + 1, divisor, dtype=np.int64))
    count = 1
    for numbers in ranges:
        count *= len(numbers)
    if count > _MOST_SETS:
        raise RangeError(
            Problem(
                f"{count:.2g} tooth sets to look at",
                f"{len(kinds)} kinds of gear up to {most} teeth, and the search looks at each set",
                f"lower most, or fix the teeth of some kinds: fixed={{{kinds[0]!r}: 20}}",
            )
        )
    return ranges


def _blocks(ranges: Sequence[NDArray[np.int64]]) -> Iterator[list[NDArray[np.int64]]]:
    """All combinations, as flat columns: the last two kinds in full, the others one combination at a time."""
    # two kinds at a time bound the memory: all sets at once may be 2e8
    tail = [column.ravel() for column in np.meshgrid(*ranges[-2:], indexing="ij")]
    if not tail[0].size:
        return
    for head in product(*(numbers.tolist() for numbers in ranges[:-2])):
        yield [np.full_like(tail[0], count) for count in head] + tail


def _sorted(rows: NDArray[np.int64], mismatches: Floats, order: Order) -> NDArray[np.int64]:
    """Rows in the order asked for; ties by the other measure."""
    totals = rows.sum(axis=1)
    # rounding must not order sets that share one pitch exactly
    rounded = np.where(mismatches < 1e-13, 0.0, mismatches)
    keys = (totals, rounded) if order == "mismatch" else (rounded, totals)
    at = np.lexsort(keys)
    if order == "front" and len(at):
        minimum = np.concatenate([[np.inf], np.minimum.accumulate(rounded[at])[:-1]])
        at = at[rounded[at] < minimum]
    return np.asarray(rows[at], dtype=np.int64)


@dataclass(frozen=True)
class ToothCountCompromise(Shown):
    """One set of tooth numbers.

    See Also
    --------
    suggest_tooth_counts : what gives these.
    """

    teeth: Mapping[str, int]
    """Of each kind."""
    mismatch: float
    """ln(pitch of the first kind of mesh / pitch of the second); with more kinds, ln(greatest / least)."""
    pitches: tuple[float, ...]
    """Operating pitch of each kind of mesh [radii of the sphere]."""
    cones: tuple[tuple[float, float], ...]
    """Operating cones of its two gears [rad], for each kind of mesh."""
    pressure: tuple[float, ...]
    """Operating pressure angle of each kind of mesh, on one base pitch [rad]."""
    room: float
    """Least room between pitch circles of gears that do not mesh [modules]."""
    residue: float
    """Largest residue of a loop [pitches]; 0 where all loops close exactly."""

    @property
    def total(self) -> int:
        """Sum of the teeth of the kinds."""
        return sum(self.teeth.values())

    def __str__(self) -> str:
        teeth = " ".join(f"{kind} {count}" for kind, count in self.teeth.items())
        angles = " ".join(f"{degrees(angle):.4f}" for angle in self.pressure)
        return f"{teeth}: mismatch {self.mismatch:+.9e}, pressure angles {angles} deg, room {self.room:.2f} modules"


@dataclass(frozen=True)
class ToothCountSuggestions(Result):
    """What a search found, best first, and what removed the rest; a sequence of `ToothCountCompromise`.

    See Also
    --------
    suggest_tooth_counts : what gives these.
    """

    PAGE = "report.spherical_report:describe_suggestions"

    KEYS = (
        "considered",
        "removed",
        Key("meshes", keys=("kinds", Key("angle", to=degrees))),
        Key(
            "solutions",
            "found",
            keys=(
                "teeth",
                "mismatch",
                Key("cones", to=degrees),
                Key("pressure_angles", "pressure", degrees),
                "room",
                "residue",
            ),
        ),
    )

    configuration: Configuration
    """The set."""
    meshes: tuple[MeshKind, ...]
    """Its kinds of mesh."""
    found: tuple[ToothCountCompromise, ...]
    """The sets."""
    considered: int
    """All tooth sets up to the bound."""
    removed: Mapping[str, int]
    """How many each condition removed, in the order in which the conditions were asked."""
    beyond: int
    """Sets that meet every condition but are worse than the last one listed."""

    def _summary(self) -> str:
        best = f", best {self.found[0]}" if self.found else ""
        return f"{len(self.found)} of {self.considered} tooth sets{best}"

    def __len__(self) -> int:
        return len(self.found)

    def __iter__(self) -> Iterator[ToothCountCompromise]:
        return iter(self.found)

    def __getitem__(self, at: int) -> ToothCountCompromise:
        return self.found[at]


class _Search:
    """The conditions on a block of tooth sets, and the count of what each one removed."""

    def __init__(
        self,
        configuration: Configuration,
        kinds: tuple[str, ...],
        meshes: tuple[MeshKind, ...],
        rules: Sequence[Sequence[Fraction | float]],
        tolerance: float,
        mismatch: float,
    ) -> None:
        self.kinds, self.rules, self.tolerance, self.limit = kinds, rules, tolerance, mismatch
        order = {kind: at for at, kind in enumerate(kinds)}
        self.meshes = [(order[mesh.a], order[mesh.b], mesh.angle) for mesh in meshes]
        near = nearest_unmeshed(configuration)
        self.strangers = [(order[a], order[b], S) for (a, b), S in near.items() if order[a] <= order[b]]
        self.tips_removed = self.pitch_removed = 0

    def kept(self, block: list[NDArray[np.int64]]) -> NDArray[np.int64]:
        """The sets of a block that meet every condition, as rows."""
        for rule in self.rules:
            good = closes(block, rule, self.tolerance)
            block = [column[good] for column in block]
        # rounding must not remove sets whose tips just clear
        clear = self.room(block) >= TIP_ROOM - 1e-9
        self.tips_removed += int((~clear).sum())
        block = [column[clear] for column in block]
        close = np.abs(self.mismatches(block)) <= self.limit
        self.pitch_removed += int((~close).sum())
        return np.stack([column[close] for column in block], axis=1)

    def pitches(self, block: Sequence[NDArray[np.int64]]) -> Floats:
        """Operating pitch of each kind of mesh (rows) and set (columns)."""
        return np.stack([operating_pitch(S, block[a], block[b]) for a, b, S in self.meshes])

    def mismatches(self, block: Sequence[NDArray[np.int64]]) -> Floats:
        """Mismatch of each set, as in `ToothCountCompromise`."""
        logs = np.log(self.pitches(block))
        return np.asarray(logs[0] - logs[1] if len(logs) == 2 else logs.max(axis=0) - logs.min(axis=0))

    def room(self, block: Sequence[NDArray[np.int64]]) -> Floats:
        """Least room between the pitch circles of gears that do not mesh, in modules."""
        outer = [np.zeros(len(block[0])) for _ in self.kinds]
        for a, b, S in self.meshes:
            outer[a] = np.maximum(outer[a], pitch_cone(S, block[a], block[b]))
            outer[b] = np.maximum(outer[b], pitch_cone(S, block[b], block[a]))
        module = 2 * np.exp(np.log(self.pitches(block)).mean(axis=0))
        room = np.full(len(block[0]), np.inf)
        for a, b, S in self.strangers:
            room = np.minimum(room, (S - outer[a] - outer[b]) / module)
        return room

    def compromise(self, row: NDArray[np.int64]) -> ToothCountCompromise:
        """All that is reported of one set."""
        block = [np.array([count]) for count in row]
        pitches = self.pitches(block)[:, 0]
        angles = pressure_angle(base_pitch(pitches), pitches)
        cones = tuple(
            (float(pitch_cone(S, row[a], row[b])), float(pitch_cone(S, row[b], row[a]))) for a, b, S in self.meshes
        )
        inexact = [rule for rule in self.rules if any(isinstance(share, float) for share in rule)]
        return ToothCountCompromise(
            dict(zip(self.kinds, row.tolist(), strict=True)),
            float(self.mismatches(block)[0]),
            tuple(pitches.tolist()),
            cones,
            tuple(angles.tolist()),
            float(self.room(block)[0]),
            max((abs(float(residue(row.tolist(), rule))) for rule in inexact), default=0.0),
        )


# ---------------------------------------------------------------------------------------------------- neighbour windows


@dataclass(frozen=True)
class NeighbourRatioWindow(Shown):
    """Range of a tooth ratio in which equal neighbours do not overlap, tips not counted.

    See Also
    --------
    ratio_windows : what gives these.
    """

    a: str
    """Kind of the first gear."""
    b: str
    """Kind of the second gear."""
    low: float
    """Lower bound of z_a / z_b."""
    high: float
    """Upper bound of z_a / z_b; `inf` where there is none."""

    def __str__(self) -> str:
        return f"{self.low:.9f} < z({self.a})/z({self.b}) < {self.high:.9f}"


def ratio_windows(configuration: Configuration) -> tuple[NeighbourRatioWindow, ...]:
    """For each kind of mesh between unlike gears, the tooth ratios at which equal neighbours do not overlap.

    With several kinds of mesh each window holds for the operating cones of its own mesh.

    Parameters
    ----------
    configuration : Configuration
        The set; its teeth are not asked for.

    Returns
    -------
    tuple of NeighbourRatioWindow
        One a kind of mesh between unlike gears.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron
    >>> print(ratio_windows(from_polyhedron("icosidodecahedron"))[0])
    0.794654472 < z(5)/z(3) < 5.330704256
    """
    nearest = nearest_unmeshed(configuration)
    found = []
    for mesh in mesh_kinds(configuration):
        if mesh.a == mesh.b:
            continue
        own, other = (nearest.get((kind, kind), pi) for kind in (mesh.a, mesh.b))
        lift = overlap_limit(mesh.angle, own)
        found.append(NeighbourRatioWindow(mesh.a, mesh.b, overlap_limit(mesh.angle, other), 1 / lift if lift else inf))
    return tuple(found)
