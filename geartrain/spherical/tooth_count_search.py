"""Exhaustive search for tooth numbers with nearly equal pitches that satisfy the conditions of assembly and tip
clearance.

The module also computes the range of the tooth ratio in which equal neighbouring gears on a sphere do not overlap.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import ceil, degrees, inf, pi, prod
from typing import TYPE_CHECKING, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.results import Key, Result, Shown
from geartrain.spherical.assembly import closes, divisors, loop_rules, residue
from geartrain.spherical.configuration import Configuration, MeshKind, kinds_in_order, mesh_kinds, nearest_unmeshed
from geartrain.spherical.gear_sizes import TIP_ROOM
from geartrain.spherical.pitch_cones import base_pitch, operating_pitch, overlap_limit, pitch_cone, pressure_angle

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.numerics.arrays import Floats


Order = Literal["mismatch", "teeth", "front"]
_MOST_SETS = 2 * 10**8  # all sets are examined


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
    """Find the best sets of tooth numbers for which all loops close and tips have clearance, by exhaustive search.

    The run time is proportional to the product of the ranges. Tips are considered to have clearance if the largest
    operating pitch cones of gears that do not mesh are at least two modules apart.

    Parameters
    ----------
    configuration : Configuration
        Set of gears. Its tooth numbers are not used.
    most, minimum : int
        Maximum and minimum tooth number of a gear.
    best : int
        Number of sets that are returned.
    order : {"mismatch", "teeth", "front"}
        Order of the results. `mismatch`: in ascending order of |mismatch|. `teeth`: in ascending order of the total.
        `front`: only Pareto-optimal sets, which have less mismatch than every set with an equal or smaller total, in
        ascending order of the total.
    mismatch : float
        Maximum natural logarithm of the ratio of two pitches in a set.
    tolerance : float
        Tolerance of the closing error for loops whose angles are only known as floats [pitch].
    fixed : mapping of str to int, optional
        Tooth numbers that are not varied, by kind of gear.

    Returns
    -------
    ToothCountSuggestions
        Sets of tooth numbers in the requested order, and the number of sets rejected by each condition.

    Raises
    ------
    QuestionError
        If no gears mesh, or if a loop with an odd number of gears locks the set.
    RangeError
        If there are more than 2e8 sets to examine.

    Examples
    --------
    >>> from geartrain.spherical import from_polyhedron
    >>> found = suggest_tooth_counts(from_polyhedron("rhombicosidodecahedron"), most=30, best=1)
    >>> found.considered, dict(found[0].teeth), round(found[0].mismatch, 8)
    (15625, {'5': 25, '4': 14, '3': 12}, 0.00105949)
    """
    kinds, meshes = kinds_in_order(configuration), mesh_kinds(configuration)
    if not meshes:
        raise QuestionError(Problem("no gears mesh", "the pitch is a property of a mesh", "declare at least one mesh"))
    rules = loop_rules(configuration)
    ranges = _ranges(kinds, rules, minimum, most, fixed or {})
    search = _Search(configuration, kinds, meshes, rules, tolerance, mismatch)
    kept = [search.kept(block) for block in _blocks(ranges)]
    rows = np.concatenate(kept) if kept else np.zeros((0, len(kinds)), dtype=np.int64)
    # all sets, including those excluded by exact divisibility
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
    """Return the tooth numbers of each kind that can satisfy the exact rules; raise `RangeError` for too many sets."""
    ranges = []
    for kind, divisor in zip(kinds, divisors(rules, len(kinds)), strict=True):
        first, last = (fixed[kind], fixed[kind]) if kind in fixed else (max(minimum, 1), most)
        # only multiples of the divisor can satisfy the exact rules
        ranges.append(np.arange(divisor * ceil(first / divisor), last + 1, divisor, dtype=np.int64))
    count = prod(map(len, ranges))
    if count > _MOST_SETS:
        what = f"the search would examine {count:.2g} combinations of tooth numbers"
        why = f"{len(kinds)} kinds of gear have up to {most} teeth, "
        why += f"and at most {_MOST_SETS:.2g} combinations are examined"
        fix = f"lower `most`, or fix the teeth of some kinds: fixed={{{kinds[0]!r}: 20}}"
        raise RangeError(Problem(what, why, fix))
    return ranges


def _blocks(ranges: Sequence[NDArray[np.int64]]) -> Iterator[list[NDArray[np.int64]]]:
    """Yield all combinations of tooth numbers as flat columns, in blocks in which only the last two kinds vary."""
    # blocks of two kinds bound the memory: all sets at once may be 2e8
    tail = [column.ravel() for column in np.meshgrid(*ranges[-2:], indexing="ij")]
    if not tail[0].size:
        return
    for head in product(*(numbers.tolist() for numbers in ranges[:-2])):
        yield [np.full_like(tail[0], count) for count in head] + tail


def _sorted(rows: NDArray[np.int64], mismatches: Floats, order: Order) -> NDArray[np.int64]:
    """Return the sets of tooth numbers (rows) in ascending order of mismatch, with ties in order of the total, or vice
    versa for other orders. For "front", return only the Pareto-optimal sets.
    """
    totals = rows.sum(axis=1)
    # rounding must not decide the order of sets that share one pitch exactly
    rounded = np.where(mismatches < 1e-13, 0.0, mismatches)
    keys = (totals, rounded) if order == "mismatch" else (rounded, totals)
    at = np.lexsort(keys)
    if order == "front" and len(at):
        minimum = np.concatenate([[np.inf], np.minimum.accumulate(rounded[at])[:-1]])
        at = at[rounded[at] < minimum]
    return np.asarray(rows[at], dtype=np.int64)


@dataclass(frozen=True)
class ToothCountCompromise(Shown):
    """Set of tooth numbers for which all meshes have nearly the same pitch."""

    teeth: Mapping[str, int]
    """Tooth number of each kind of gear."""
    mismatch: float
    """Natural logarithm of the ratio of two pitches. If there are two kinds of mesh, it is the pitch of the first
    divided by the pitch of the second; if there are more, it is the maximum pitch divided by the minimum pitch.
    """
    pitches: tuple[float, ...]
    """Operating pitch of each kind of mesh [radii of the sphere]."""
    cones: tuple[tuple[float, float], ...]
    """Half-angles of the operating pitch cones of the two gears in each kind of mesh [rad]."""
    pressure: tuple[float, ...]
    """Operating pressure angle of each kind of mesh for a common base pitch [rad]; NaN without contact."""
    room: float
    """Minimum distance between the pitch circles of gears that do not mesh [modules]."""
    residue: float
    """Maximum closing error of the loops [pitch]; 0 if all loops close exactly."""

    @property
    def total(self) -> int:
        """Sum of the tooth numbers of all kinds."""
        return sum(self.teeth.values())

    def __str__(self) -> str:
        teeth = " ".join(f"{kind} {count}" for kind, count in self.teeth.items())
        angles = " ".join(f"{degrees(angle):.4f}" for angle in self.pressure)
        return f"{teeth}: mismatch {self.mismatch:+.9e}, pressure angles {angles} deg, room {self.room:.2f} modules"


@dataclass(frozen=True)
class ToothCountSuggestions(Result):
    """Result of a search for tooth numbers: a sequence of `ToothCountCompromise` objects in the requested order, and
    the numbers of rejected sets.
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
    """Set of gears for which tooth numbers were searched."""
    meshes: tuple[MeshKind, ...]
    """Kinds of mesh that occur in the set of gears."""
    found: tuple[ToothCountCompromise, ...]
    """Sets of tooth numbers that satisfy all conditions, in the requested order."""
    considered: int
    """Number of sets of tooth numbers within the bounds."""
    removed: Mapping[str, int]
    """Number of sets that each condition rejected, in the order in which the conditions are tested."""
    beyond: int
    """Number of further sets that satisfy all conditions but are not in `found`."""

    def _summary(self) -> str:
        best = f", best {self.found[0]}" if self.found else ""
        return f"{len(self.found)} of {self.considered} combinations of tooth numbers{best}"

    def __len__(self) -> int:
        return len(self.found)

    def __iter__(self) -> Iterator[ToothCountCompromise]:
        return iter(self.found)

    def __getitem__(self, at: int) -> ToothCountCompromise:
        return self.found[at]


class _Search:
    """Conditions that are applied to blocks of tooth numbers, and the number of sets that each of them rejected."""

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
        self.unmeshed = [(order[a], order[b], S) for (a, b), S in near.items() if order[a] <= order[b]]
        self.tips_removed = self.pitch_removed = 0

    def kept(self, block: list[NDArray[np.int64]]) -> NDArray[np.int64]:
        """Return the sets of tooth numbers in a block that satisfy all conditions, one per row."""
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
        """Return the operating pitch [radii of the sphere] of each kind of mesh (rows) for each set of teeth."""
        return np.stack([operating_pitch(S, block[a], block[b]) for a, b, S in self.meshes])

    def mismatches(self, block: Sequence[NDArray[np.int64]]) -> Floats:
        """Return the mismatch of each set, as defined in `ToothCountCompromise`."""
        logs = np.log(self.pitches(block))
        return np.asarray(logs[0] - logs[1] if len(logs) == 2 else logs.max(axis=0) - logs.min(axis=0))

    def room(self, block: Sequence[NDArray[np.int64]]) -> Floats:
        """Return the minimum distance between the pitch circles of gears that do not mesh, for each set [modules]."""
        # largest operating cone of each kind over its meshes
        outer = [np.zeros(len(block[0])) for _ in self.kinds]
        for a, b, S in self.meshes:
            outer[a] = np.maximum(outer[a], pitch_cone(S, block[a], block[b]))
            outer[b] = np.maximum(outer[b], pitch_cone(S, block[b], block[a]))
        module = 2 * np.exp(np.log(self.pitches(block)).mean(axis=0))
        room = np.full(len(block[0]), np.inf)
        for a, b, S in self.unmeshed:
            room = np.minimum(room, (S - outer[a] - outer[b]) / module)
        return room

    def compromise(self, row: NDArray[np.int64]) -> ToothCountCompromise:
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
    """Range of the ratio of two tooth numbers in which neighbouring pitch circles of a kind do not overlap."""

    a: str
    """Kind of the first gear."""
    b: str
    """Kind of the second gear."""
    low: float
    """Lower limit of the tooth ratio z_a / z_b."""
    high: float
    """Upper limit of the tooth ratio z_a / z_b; `inf` if there is none."""

    def __str__(self) -> str:
        return f"{self.low:.9f} < z({self.a})/z({self.b}) < {self.high:.9f}"


def ratio_windows(configuration: Configuration) -> tuple[NeighbourRatioWindow, ...]:
    """Return the range of the tooth ratio in which neighbouring gears of the same kind do not overlap, for each kind of
    mesh between different kinds of gear.

    If there are several kinds of mesh, each range is valid for the operating cones of its own mesh.

    Parameters
    ----------
    configuration : Configuration
        Set of gears; its tooth numbers are not used.

    Returns
    -------
    tuple of NeighbourRatioWindow
        One range for each kind of mesh between different kinds of gear.

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
        # nearest equal neighbours of each gear
        own, other = (nearest.get((kind, kind), pi) for kind in (mesh.a, mesh.b))
        # neighbours of kind a limit z_b / z_a from below, and therefore z_a / z_b from above
        lift = overlap_limit(mesh.angle, own)
        found.append(NeighbourRatioWindow(mesh.a, mesh.b, overlap_limit(mesh.angle, other), 1 / lift if lift else inf))
    return tuple(found)
