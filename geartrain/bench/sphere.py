"""Gears on a sphere: residual against Newton steps and time, and closure by fractions against closure by floats.

The radii of the circles by Newton's method, and by the fixed point of W. Thurston as C. Collins and K. Stephenson
iterate it (Comput. Geom. 25 (2003) 233); then axes moved to one pitch or to closed loops. The packing is judged by
its tangencies in 40 digits, closure by whole numbers.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from functools import partial
from importlib.util import find_spec
from itertools import pairwise
from math import degrees, lcm, pi
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from geartrain.bench.mesh import Long, Multiple
from geartrain.closure.accuracy import Measured, measure
from geartrain.closure.problem import judge
from geartrain.spherical import GraphSet, from_graph, from_polyhedron, size
from geartrain.spherical.graphs import Aim
from geartrain.spherical.loops import closes, loop_rules, residue
from geartrain.spherical.maps import propped, regions_of, sound
from geartrain.spherical.packing import Packing, pack
from geartrain.spherical.plane import Plane, Step, angle_excess

Floats = NDArray[np.float64]
Whole = NDArray[np.int64]
Edges = list[tuple[str, str]]
Rule = Sequence[Fraction | float]
Advance = Callable[[str], None]

TARGET = 1e-11
"""Residual of the radii (rad) to which both ways to them are timed."""
TOLERANCE = 1e-9
"""Pitches by which a float loop may miss and still counts as closed, unless a caller says otherwise."""
FIXED, NEWTON = "fixed point", "Newton"
FRACTIONS, ROUNDED, FROM_AXES = "fractions", "floats of the fractions", "floats from the axes"
_SIZES = {"hull": (5, 11, 35, 101, 335), "zonohedron": (4, 6, 10, 18, 32), "trapezohedron": (4, 14, 49, 149, 499)}
_FITS: tuple[tuple[Aim, int], ...] = (("pitch", 12), ("pitch", 50), ("phases", 12))
_SOLIDS = ("icosidodecahedron", "6-antiprism", "rhombicosidodecahedron")
_POWERS, _FEW_POWERS = tuple(range(1, 16)), (1, 4, 8, 12)
_PLANETS = 7
_PATIENCE = 60.0  # seconds of one fixed point
_QUADRATIC = (0.1, 1e-11)  # rad: residuals between which the steps are near their limit and above rounding


@dataclass(frozen=True, slots=True)
class PackRecord:
    """The circles of one graph.

    steps       seconds and largest residual (rad) after each Newton step for the radii
    seconds     of the whole packing: radii, places, centre and polish
    residual    largest error of a tangency or right angle that the packing states (rad)
    judged      the same in 40 digits, from axes and half-angles (rad)
    overlaps    pairs of gears whose circles overlap
    sweeps      of the fixed point until its residual is below `TARGET`, or patience ends
    swept       seconds of these, `left` their residual (rad)
    trace       sweeps and residuals (rad) of the fixed point on its way
    """

    family: str
    gears: int
    meshes: int
    steps: Sequence[tuple[float, float]]
    seconds: float
    residual: float
    judged: float
    overlaps: int
    sweeps: int
    swept: float
    left: float
    trace: Sequence[tuple[int, float]]

    @property
    def counted(self) -> Sequence[tuple[float, float]]:
        """The Newton steps up to the first with a residual below `TARGET`."""
        last = next((at for at, (_, residual) in enumerate(self.steps) if residual < TARGET), len(self.steps) - 1)
        return self.steps[: last + 1]

    @property
    def newton(self) -> float:
        """Seconds of the Newton steps down to `TARGET`."""
        return sum(seconds for seconds, _ in self.counted)

    @property
    def ratio(self) -> float:
        """Seconds of the fixed point over those of Newton's method, to the same residual."""
        return self.swept / self.newton

    @property
    def squares(self) -> list[float]:
        """residual after a step / (residual before it)^2 (1/rad), of the steps near the solution and above rounding."""
        near, least = _QUADRATIC
        left = [residual for _, residual in self.steps]
        return [b / a**2 for a, b in pairwise(left) if a < near and b > least]


@dataclass(frozen=True, slots=True)
class FitRecord:
    """Axes moved from a packing until whole teeth fit.

    least      teeth of the smallest gear, `most` those of the largest
    steps      of the fit, and `seconds` of these; `whole` of everything from the graph to the sizes; `sizing` of sizes
    residual   ln(greatest pitch / least pitch) for the aim "pitch", largest residue of a loop (pitches) for "phases"
    moved      the farthest that an axis moved (deg)
    track      residual (rad for "pitch", pitches for "phases") that each step tells of
    """

    family: str
    gears: int
    aim: Aim
    least: int
    most: int
    steps: int
    seconds: float
    whole: float
    sizing: float
    residual: float
    exact: bool
    moved: float
    track: Sequence[float] = ()

    @property
    def strayed(self) -> bool:
        """True if the steps came within 1e-9 of a solution, and then went farther than 1e-3 from it."""
        near = next((at for at, residual in enumerate(self.track) if residual < 1e-9), len(self.track))
        return any(residual > 1e-3 for residual in self.track[near:])


@dataclass(frozen=True, slots=True)
class ClosureRecord:
    """Loops with tooth numbers from 10^power up to 10^(power + 1), by one method.

    error     largest difference of a residue from the truth (pitches)
    bound     what the method itself forecasts for it (pitches); None where it forecasts nothing
    wrong     verdicts that are wrong at `TOLERANCE`
    best      those that are wrong at half the least residue a loop can have, the best tolerance there is
    own       wrong verdicts when judged by `bound`, and `unclear` ones
    seconds   for one loop
    """

    family: str
    method: str
    power: int
    loops: int
    error: float
    wrong: int
    best: int
    seconds: float
    bound: float | None = None
    own: int = 0
    unclear: int = 0


@dataclass(frozen=True, slots=True)
class SphereRecords:
    """All measurements of one run on one machine."""

    title: str
    packings: Sequence[PackRecord]
    fits: Sequence[FitRecord]
    closures: Sequence[ClosureRecord]

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> SphereRecords:
        """What `to_dict` gave."""
        return cls(
            data["title"],
            [PackRecord(**row) for row in data["packings"]],
            [FitRecord(**row) for row in data["fits"]],
            [ClosureRecord(**row) for row in data["closures"]],
        )

    def to_markdown(self) -> str:
        """Tables of packings, their Newton steps, fits and closures."""
        lines = [f"# {self.title}", "", "## Circles", "", *_pack_table(self.packings)]
        lines += ["## Residual (rad) after each Newton step", "", *_step_table(self.packings)]
        lines += ["## Axes moved", "", *_fit_table(self.fits), "## Closure", "", *_closure_table(self.closures)]
        return "\n".join(lines)


def growth(gears: Sequence[int], seconds: Sequence[float], least: int = 90) -> float:
    """The exponent p of seconds ~ gears^p, by least squares of logarithms over `least` gears and more."""
    n, s = np.log(np.array([gears, seconds], dtype=float))
    kept = np.array(gears) >= least
    return float(np.polyfit(n[kept], s[kept], 1)[0])


def _pack_table(rows: Sequence[PackRecord]) -> list[str]:
    lines = [
        "| graph | gears | meshes | Newton steps | time | sweeps | time over Newton | whole packing | residual | "
        "in 40 digits | overlaps |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        sweeps = f"{row.sweeps}" if row.left < TARGET else f"{row.sweeps}, {row.left:.0e} left"
        sort = (row.family, str(row.gears), str(row.meshes), str(len(row.counted)), _seconds(row.newton), sweeps)
        ratio = f"{'' if row.left < TARGET else 'over '}{row.ratio:.3g}"
        ends = (ratio, _seconds(row.seconds), f"{row.residual:.1e}", f"{row.judged:.1e}", str(row.overlaps))
        lines.append(f"| {' | '.join((*sort, *ends))} |")
    return [*lines, ""]


def _step_table(rows: Sequence[PackRecord]) -> list[str]:
    most = max(len(row.steps) for row in rows)
    lines = [f"| graph | gears | {' | '.join(str(at + 1) for at in range(most))} |", "|---" * (most + 2) + "|"]
    for row in rows:
        left = [f"{residual:.0e}" for _, residual in row.steps] + [""] * (most - len(row.steps))
        lines.append(f"| {row.family} | {row.gears} | {' | '.join(left)} |")
    return [*lines, ""]


def _fit_table(rows: Sequence[FitRecord]) -> list[str]:
    lines = [
        "| graph | gears | aim | teeth | steps | time | with packing | sizes | residual | exact | moved |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        sort = (row.family, str(row.gears), row.aim, f"{row.least} to {row.most}", str(row.steps))
        times = (_seconds(each) for each in (row.seconds, row.whole, row.sizing))
        ends = (f"{row.residual:.1e}", "yes" if row.exact else "no", f"{row.moved:.2g} deg")
        lines.append(f"| {' | '.join((*sort, *times, *ends))} |")
    return [*lines, ""]


def _closure_table(rows: Sequence[ClosureRecord]) -> list[str]:
    lines = [
        "| loops of | method | teeth | loops | error | forecast | wrong | at the best tolerance | by forecast | "
        "unclear | time a loop |",
        "|---" * 11 + "|",
    ]
    for row in rows:
        told = ("-", "-", "-") if row.bound is None else (f"{row.bound:.1e}", str(row.own), str(row.unclear))
        sort = (row.family, row.method, f"10^{row.power}", str(row.loops), f"{row.error:.1e}" if row.error else "0")
        ends = (told[0], str(row.wrong), str(row.best), *told[1:], _seconds(row.seconds))
        lines.append(f"| {' | '.join((*sort, *ends))} |")
    return [*lines, ""]


def _seconds(value: float) -> str:
    scale, unit = next(
        ((scale, unit) for scale, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "us")) if value >= scale), (1e-9, "ns")
    )
    return f"{value / scale:.3g} {unit}"


# ---------------------------------------------------------------------------------------------------------- measuring


def sphere(quick: bool = False, advance: Advance = lambda _: None) -> SphereRecords:
    """Measure all graphs and loops (`quick`: graphs of up to 32 gears, few loops); `advance` hears of every step."""
    found: list[Any] = []
    for name, task in _tasks(quick):
        advance(name)
        found += task()
    return SphereRecords(
        "Gears on a sphere: residual against steps and time",
        [row for row in found if isinstance(row, PackRecord)],
        [row for row in found if isinstance(row, FitRecord)],
        [row for row in found if isinstance(row, ClosureRecord)],
    )


def count_sphere_steps(quick: bool = False) -> int:
    """How many steps `sphere` will tell of."""
    return sum(1 for _ in _tasks(quick))


def _tasks(quick: bool) -> Iterator[tuple[str, Callable[[], Sequence[Any]]]]:
    rounds, few, draws = (1, 2, 60) if quick else (3, 5, 1000)
    for family, sizes in _SIZES.items():
        for given in sizes[:few]:
            yield f"{family} {given}: circles", partial(_packed, family, given, rounds)
            for aim, least in _FITS:
                yield f"{family} {given}: {aim}, {least} teeth", partial(_fitted, family, given, aim, least, rounds)
    for power in _FEW_POWERS if quick else _POWERS:
        for solid in _SOLIDS:
            yield f"{solid}: 10^{power} teeth", partial(_closed, solid, power, draws)
        yield f"planetary: 10^{power} teeth", partial(_assembled, power, max(10, draws // 20))


def graph(family: str, given: int) -> Edges:
    """Who meshes with whom, in a graph of a family; see `hull`, `zonohedron` and `trapezohedron`."""
    return {"hull": hull, "zonohedron": zonohedron, "trapezohedron": trapezohedron}[family](given)


def hull(points: int) -> Edges:
    """Gears on all vertices and faces of the convex hull of random points on the sphere: 3 points - 4 gears."""
    from scipy.spatial import ConvexHull

    cloud = np.random.default_rng(points).normal(size=(points, 3))
    found = ConvexHull(cloud / np.linalg.norm(cloud, axis=1)[:, None])
    return [(f"v{vertex}", f"f{at}") for at, face in enumerate(found.simplices) for vertex in face]


def zonohedron(zones: int) -> Edges:
    """Gears on the vertices of a zonohedron with random directions: zones (zones - 1) + 2; all regions have four."""
    way = np.random.default_rng(zones).normal(size=(zones, 3))
    names: dict[tuple[int, ...], str] = {}
    edges: dict[tuple[str, str], None] = {}
    for i, j in zip(*np.triu_indices(zones, 1), strict=True):
        side = np.sign(way @ np.cross(way[i], way[j])).astype(int)
        for face in (side, -side):
            corners = []
            for face[i], face[j] in ((1, 1), (1, -1), (-1, -1), (-1, 1)):
                corners.append(names.setdefault(tuple(face.tolist()), f"v{len(names)}"))
            for k in range(4):
                a, b = sorted((corners[k - 1], corners[k]))
                edges[a, b] = None
    return list(edges)


def trapezohedron(sides: int) -> Edges:
    """Gears on the vertices of a trapezohedron: two poles, and 2 sides small ones between; all regions have four."""
    edges = []
    for k in range(sides):
        edges += [("north", f"u{k}"), ("south", f"l{k}"), (f"u{k}", f"l{k}"), (f"l{k}", f"u{(k + 1) % sides}")]
    return edges


def _timed(task: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    found = task()
    return time.perf_counter() - start, found


def _packed(family: str, given: int, rounds: int) -> list[PackRecord]:
    named = sound(graph(family, given))
    gears, regions = propped(len(named), regions_of(named), list(named))
    radii = [Plane(gears, regions).radii()[1] for _ in range(3 * rounds)]
    whole = [_timed(lambda: pack(gears, regions)) for _ in range(rounds)]
    sweeps = FixedPoint(Plane(gears, regions))
    sweeps.run(TARGET)
    packing: Packing = whole[0][1]
    record = PackRecord(
        family=family,
        gears=gears,
        meshes=len(packing.meshes),
        steps=_middle(radii),
        seconds=median(seconds for seconds, _ in whole),
        residual=packing.residual,
        judged=judged(packing),
        overlaps=overlaps(packing),
        sweeps=sweeps.sweeps,
        swept=sweeps.seconds,
        left=sweeps.trace[-1][1],
        trace=sweeps.trace,
    )
    return [record]


def _middle(rounds: Sequence[Sequence[Step]]) -> list[tuple[float, float]]:
    """Each step's median time over the rounds, and its residual, which is the same in all."""
    return [(median(step.seconds for step in each), each[0].residual) for each in zip(*rounds, strict=True)]


def _fitted(family: str, given: int, aim: Aim, least: int, rounds: int) -> list[FitRecord]:
    edges = graph(family, given)
    runs = [_timed(lambda: from_graph(edges, least, aim)) for _ in range(rounds)]
    found: GraphSet = runs[0][1]
    sized = [_timed(lambda: size(found.configuration))[0] for _ in range(rounds)]
    return [
        FitRecord(
            family=family,
            gears=len(found.configuration.names),
            aim=aim,
            least=least,
            most=max(found.configuration.teeth.values()),
            steps=len(found.steps),
            seconds=median(sum(step.seconds for step in run.steps) for _, run in runs),
            whole=median(seconds for seconds, _ in runs),
            sizing=median(sized),
            residual=found.sizing.mismatch if aim == "pitch" else found.residue,
            exact=aim in found.exact,
            moved=degrees(float(found.moved.max())),
            track=[step.residual for step in found.steps],
        )
    ]


# -------------------------------------------------------------------------------------------------------- alternative


class FixedPoint:
    """Radii by repeated correction, without derivatives: each as if all neighbours of a circle had one radius.

    A circle about which k circles subtend theta, where it should be Theta, gets r tan(theta / 2k) / tan(Theta / 2k).
    Gears and regions are corrected in turn; that is one sweep. No gear touches a gear here, so all of one sort are
    corrected at once, and each sort sees the latest radii of the other.

    sweeps, seconds   so far
    trace             sweeps and largest residuals (rad): every 10th sweep up to 100, then with steps of a tenth
    """

    def __init__(self, plane: Plane) -> None:
        near = np.ones(plane.count, dtype=bool)
        near[list(plane.far)] = False
        place = np.cumsum(near) - 1
        ends = np.array([(i, j) for i in range(plane.count) if near[i] for j in plane.around[i]])
        inner = ends[near[ends[:, 1]]]
        outer = ends[~near[ends[:, 1]], 0]
        self.i, self.j = place[inner].T
        self.target = np.asarray(2 * pi - pi * np.bincount(outer, minlength=plane.count), dtype=float)[near]
        self.u = np.zeros(int(near.sum()))
        gear = (np.arange(plane.count) < plane.gears)[near]
        self.parts = [self._part(gear), self._part(~gear)]
        self.sweeps, self.seconds = 0, 0.0
        self.trace: list[tuple[int, float]] = []

    def _part(self, chosen: NDArray[np.bool_]) -> tuple[Whole, ...]:
        """Circles of one sort; of each of their neighbours, the number within the sort, and both ends."""
        pairs = chosen[self.i]
        return np.flatnonzero(chosen), (np.cumsum(chosen) - 1)[self.i[pairs]], self.i[pairs], self.j[pairs]

    @property
    def residual(self) -> float:
        """Largest residual of an angle (rad)."""
        return float(np.abs(angle_excess(self.u, self.i, self.j, self.target)).max())

    def sweep(self) -> None:
        """Correct all gears, then all regions."""
        for at, own, i, j in self.parts:
            theta = np.bincount(own, 2 * np.arctan(np.exp(self.u[j] - self.u[i])), len(at))
            k = 2 * np.bincount(own, minlength=len(at))
            self.u[at] += np.log(np.tan(theta / k) / np.tan(self.target[at] / k))

    def run(self, target: float, patience: float = _PATIENCE) -> None:
        """Sweep until the residual is below the target (rad), or so many seconds have passed."""
        start = time.perf_counter()
        while not self.trace or (self.trace[-1][1] >= target and self.seconds < patience):
            for _ in range(max(10, self.sweeps // 10) if self.sweeps < 1000 else 100):
                self.sweep()
                self.sweeps += 1
            self.trace.append((self.sweeps, self.residual))
            self.seconds = time.perf_counter() - start
        self.trace = _thinned(self.trace)


def _thinned(trace: list[tuple[int, float]]) -> list[tuple[int, float]]:
    """Points of a trace whose sweeps grow by a tenth or more, and the last."""
    kept = trace[:1]
    for point in trace[1:-1]:
        if point[0] > 1.1 * kept[-1][0]:
            kept.append(point)
    return [*kept, trace[-1]] if len(trace) > 1 else kept


# ---------------------------------------------------------------------------------------------------------- judgement


def judged(packing: Packing) -> float:
    """Largest error of a tangency or right angle (rad): floats taken as they are, angles between them in 40 digits."""
    real: Any = Multiple() if find_spec("mpmath") else Long()
    return max(float(abs(each)) for each in _misses(packing, real))


def _misses(packing: Packing, m: Any) -> Iterator[Any]:
    gears = [_circle(m, *each) for each in zip(packing.axes, packing.cones, strict=True)]
    regions = [_circle(m, *each) for each in zip(packing.region_axes, packing.region_cones, strict=True)]
    left = {(walk[k - 1], gear): at for at, walk in enumerate(packing.regions) for k, gear in enumerate(walk)}
    for i, j in packing.meshes:
        yield _angle(m, gears[i], gears[j]) - gears[i][1] - gears[j][1]
        one, other = regions[left[i, j]], regions[left[j, i]]
        yield _angle(m, one, other) - one[1] - other[1]
    for (_, gear), region in left.items():
        a, b = gears[gear], regions[region]
        yield _angle(m, a, b) - m.acos(m.sin(m.pi / 2 - a[1]) * m.sin(m.pi / 2 - b[1]))


def _circle(m: Any, axis: Floats, cone: float) -> tuple[list[Any], Any]:
    return [m.number(float(x)) for x in axis], m.number(float(cone))


def _angle(m: Any, one: tuple[list[Any], Any], other: tuple[list[Any], Any]) -> Any:
    """Angle between two directions of any length (rad), by sine and cosine."""
    a, b = one[0], other[0]
    across = [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]
    return m.atan2(m.sqrt(sum(x * x for x in across)), sum(x * y for x, y in zip(a, b, strict=True)))


def overlaps(packing: Packing) -> int:
    """Pairs of gears whose circles overlap by more than 1e-9 rad, every pair measured in space."""
    count = 0
    for at, axis in enumerate(packing.axes[:-1], 1):
        rest = packing.axes[at:]
        apart = 2 * np.arctan2(np.linalg.norm(axis - rest, axis=1), np.linalg.norm(axis + rest, axis=1))
        count += int((apart < packing.cones[at - 1] + packing.cones[at:] - 1e-9).sum())
    return count


# ------------------------------------------------------------------------------------------------------------ closure


def _closed(solid: str, power: int, draws: int) -> list[ClosureRecord]:
    """The loop of a solid with gears on all faces: by fractions, by these in floats, and by the axes in floats."""
    configuration = from_polyhedron(solid)
    (exact,) = loop_rules(configuration)
    shares = [Fraction(share) for share in exact]
    whole = lcm(*(share.denominator for share in shares))
    teeth = draw_teeth(shares, power, draws)
    truth = [true_residue(z, shares) for z in zip(*(each.tolist() for each in teeth), strict=True)]
    loose = loop_rules(replace(configuration, regular=(0,) * len(configuration.axes)))[0]
    rules: dict[str, Rule] = {FRACTIONS: exact, ROUNDED: [float(share) for share in shares], FROM_AXES: loose}
    return [_by_rule(solid, method, power, teeth, rule, truth, whole) for method, rule in rules.items()]


def draw_teeth(shares: Sequence[Fraction], power: int, draws: int) -> list[Whole]:
    """Random teeth of each kind with power + 1 digits, of which half close the loop and half do not."""
    whole = lcm(*(share.denominator for share in shares))
    many = (len(shares), 4 * whole * draws)  # one in `whole` closes
    teeth = np.random.default_rng(power).integers(10**power, 10 ** (power + 1), many)
    parts = np.array([int(share * whole) for share in shares])
    closed = (parts @ (teeth % whole)) % whole == 0
    taken = [np.flatnonzero(each)[: draws // 2] for each in (closed, ~closed)]
    return list(teeth[:, np.concatenate(taken)])


def true_residue(teeth: Sequence[int], shares: Sequence[Fraction]) -> Fraction:
    """What a loop misses by, in whole numbers without bound (pitches)."""
    total = sum((z * share for z, share in zip(teeth, shares, strict=True)), Fraction(0))
    return total - round(total)


def _by_rule(
    solid: str, method: str, power: int, teeth: Sequence[Whole], rule: Rule, truth: Sequence[Fraction], whole: int
) -> ClosureRecord:
    closed = np.array([not each for each in truth])
    said = closes(teeth, rule, TOLERANCE)
    seconds = median(_timed(lambda: closes(teeth, rule, TOLERANCE))[0] for _ in range(9))
    error, best = 0.0, int((said != closed).sum())
    if method != FRACTIONS:
        near = [Fraction(float(each)) for each in residue(teeth, rule)]
        error = max(float(_apart(a, b)) for a, b in zip(near, truth, strict=True))
        best = int((closes(teeth, rule, 1 / (2 * whole)) != closed).sum())
    wrong = int((said != closed).sum())
    return ClosureRecord(solid, method, power, len(truth), error, wrong, best, seconds / len(truth))


def _apart(a: Fraction, b: Fraction) -> Fraction:
    off = a - b
    return abs(off - round(off))


def _assembled(power: int, suns: int) -> list[ClosureRecord]:
    """Planets equally spaced between sun and ring: the residues of the loops, as `check` finds them."""
    teeth = 14 * np.random.default_rng(power).integers(10**power // 14 + 1, 10 ** (power + 1) // 14, suns)
    teeth[1::2] += 2  # the others close: three times the sun's teeth are then a multiple of the planets
    found = measure(teeth.tolist(), _PLANETS)
    return [_of_planets(power, found, FRACTIONS), _of_planets(power, found, "floats")]


def _of_planets(power: int, found: Sequence[Measured], method: str) -> ClosureRecord:
    exact = method == FRACTIONS
    truth = [true_residue((each.teeth,), (Fraction(-3, _PLANETS),)) for each in found]
    said = [each.exact if exact else each.floats for each in found]
    bound = [0.0 if exact else each.bound for each in found]
    kinds = [judge(value, slack) for value, slack in zip(said, bound, strict=True)]
    right = ["misses" if each else "closes" for each in truth]
    errors = [
        float(_apart(Fraction(a), b)) if exact else one.error for a, b, one in zip(said, truth, found, strict=True)
    ]
    loops = (_PLANETS - 1) * len(found)
    return ClosureRecord(
        family="planetary",
        method=method,
        power=power,
        loops=len(found),
        error=max(errors),
        wrong=_wrong(said, right, 0.0 if exact else TOLERANCE),
        best=_wrong(said, right, 0.0 if exact else 1 / (2 * _PLANETS)),
        seconds=sum(each.exact_s if exact else each.floats_s for each in found) / loops,
        bound=max(bound),
        own=sum(kind not in (true, "unclear") for kind, true in zip(kinds, right, strict=True)),
        unclear=kinds.count("unclear"),
    )


def _wrong(said: Sequence[Fraction | float], right: Sequence[str], tolerance: float) -> int:
    return sum((abs(float(value)) > tolerance) != (true == "misses") for value, true in zip(said, right, strict=True))
