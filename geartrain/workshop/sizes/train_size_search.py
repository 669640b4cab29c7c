"""The best sizes of the triangular teeth of a whole train: pair by pair, then together where pairs act on each other.

Power to an output, and the error that reaches it, pass through some pairs only, and these are given the sizes that are
best for each by itself. What counts is the train's own figure, its loss from input to output or the error of a pointer:
from the better of the declared sizes and those of the pairs by themselves, coordinate descent changes one size of one
pair after the other until the figure gains nothing more, so that it is never worse than pair by pair.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf
from typing import Any, ClassVar

from scipy.optimize import minimize_scalar

from geartrain.analysis.gear_train import GearTrain
from geartrain.dynamics import MotionRun
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.numerics.graphs import DisjointSets
from geartrain.numerics.results import Key, Pictured, Result, Tabular
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.triangular.triangular_form import Triangular
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.workshop.sizes.best_sizes import OutlineAgreement, confirm_by_outlines
from geartrain.workshop.sizes.size_design import AIMS, SizeLimit, ToothSizes, form_data, keeps, rounded, size_columns
from geartrain.workshop.sizes.size_search import Range, SizeSearch, checked_ranges

OnStep = Callable[[], None]
_TURNS, _SAMPLES = 20.0, 2_000
"""Of the input, over which the error of a pointer is followed; its extremes do not depend on the positions."""

_REACH = 0.03  # of a range: how far one step of the descent looks
_TRIES = 8  # figures of the train in one step of the descent
_SWEEPS = 4
_GAIN = 1e-3  # of the figure: a sweep that gains less is the last
_SCAN = 7  # half angles that are tried first
_ANGLE_TRIES, _NEAR = 8, 1e-3  # of Brent's method between the neighbours of the best of them; its tolerance (rad)


def find_train_sizes(
    train: GearTrain,
    output: str,
    aim: str = "loss",
    free: Mapping[str, Range | None] | None = None,
    limits: Sequence[SizeLimit] = (),
    state: str | None = None,
    on_step: OnStep = lambda: None,
) -> BestTrainSizes:
    """The sizes of triangular teeth with which a train loses least on the way to an output, or errs least there.

    Parameters
    ----------
    train : GearTrain
        With triangular teeth on some pairs.
    output : str
        An output or a link.
    aim : str
        `loss` or `error` of the train at the output; `impact`, the sum over the pairs on the way, or `jam`, their least
        margin.
    free : mapping of str to (float, float), optional
        As in `find_tooth_sizes`; pairs that share wheels have one half angle, free where all of them are sized.
    limits : sequence of SizeLimit
        What each pair has to keep.
    state : str, optional
        A declared state, by default the first.
    on_step : callable
        Called at each figure of the train, and at each pair that is done by itself.

    Returns
    -------
    BestTrainSizes
        With a declaration that extends the train.

    Raises
    ------
    QuestionError
        Where no pair with triangular teeth acts on the output, or no sizes turn.

    Notes
    -----
    Each pair by `find_tooth_sizes`, then coordinate descent on the train's own figure; docs/teeth.md, section 12.

    Examples
    --------
    >>> import geartrain
    >>> found = find_train_sizes(geartrain.load("moon-triangular"), "moon", "jam", {"window": (0.3, 0.7)})
    >>> found.together > found.before, [round(pair.together.window, 3) for pair in found.pairs]
    (True, [0.5, 0.5, 0.5, 0.5])
    """
    if aim not in AIMS:
        raise QuestionError(Problem(f"'{aim}' is nothing to be best in", "", f"ask for one of {', '.join(AIMS)}"))
    return TrainSizeSearch(train, output, aim, free, limits, state, on_step).found()


class TrainSizeSearch:
    """The sizes of the pairs of one train that act on one output."""

    def __init__(
        self,
        train: GearTrain,
        output: str,
        aim: str,
        free: Mapping[str, Range | None] | None,
        limits: Sequence[SizeLimit],
        state: str | None,
        on_step: OnStep,
    ) -> None:
        self.train, self.aim, self.limits, self._on_step = train, aim, tuple(limits), on_step
        self.output, self.state = output, train.declaration.state_or_first(state)
        self.free = checked_ranges({"radii": None} if free is None else free)
        case = train.declaration.case(self.state)
        self.source = train.declaration.crank or next(iter(case.inputs), "")
        declared = case.outputs.get(output)
        self.link = output if declared is None else declared.of or output
        check_choice("link", self.link, tuple(train.declaration.links))
        self._done: dict[Any, ToothSizes] = {}  # the best sizes of a pair by itself, for others like it

    @property
    def _acting(self) -> bool:
        """Whether pairs act on each other in what is asked for: what passes through one passes through the next."""
        return self.aim in ("loss", "error")

    # -------------------------------------------------------------------------------------------------- which pairs

    @cached_property
    def _drivers(self) -> Mapping[str, str]:
        """The pairs that act on the output, and the wheel that drives each on the way there."""
        meshes = {mesh.name: mesh for mesh in self._all_meshes}
        if self.aim == "loss":
            # without losses: teeth that do not turn as they are declared still tell where the power goes
            pairs = self._ideal.driven(self.link, self.source, self.state).pairs
            return {name: pair.driver for name, pair in pairs.items() if name in meshes and pair.driver}
        moved = self._ideal.motion(self.state, (self.output,)).sensitivity[self.output]
        return {name: mesh.driver for name, mesh in meshes.items() if moved.get(name)}

    @cached_property
    def _ideal(self) -> GearTrain:
        """The train with every pair at the middle of its window, where it has one."""
        return self._with({name: each for name, each in self._starts.items() if each.runs})

    @cached_property
    def _all_meshes(self) -> tuple[GearMesh, ...]:
        return self.train.mechanics.meshes_in(self.state)

    @cached_property
    def _meshes(self) -> Mapping[str, TriangularMesh]:
        return sizeable_meshes(self._all_meshes)

    @cached_property
    def _starts(self) -> Mapping[str, ToothSizes]:
        return {name: declared_sizes(mesh) for name, mesh in self._meshes.items()}

    @cached_property
    def _requested(self) -> tuple[str, ...]:
        """The pairs whose sizes are looked for."""
        found = tuple(name for name in self._meshes if name in self._drivers)
        if not found:
            what = f"no pair with triangular teeth acts on '{self.output}'"
            raise QuestionError(
                Problem(what, "", "ask for another output, or declare `tooth_form: {form: triangular}`")
            )
        return found

    def _untouched(self) -> Iterator[tuple[str, str]]:
        for mesh in self._all_meshes:
            if mesh.name not in self._drivers:
                yield mesh.name, f"not on the way to '{self.output}'"
            elif not isinstance(mesh, TriangularMesh):
                yield mesh.name, f"{mesh.tooth_form.words} teeth"
            elif mesh.name not in self._meshes:
                yield mesh.name, "declared in lengths"

    @cached_property
    def _one_angle(self) -> tuple[tuple[str, ...], ...]:
        """Pairs that share wheels, and so one half angle, where that is free and all of them are sized."""
        if "half_angle" not in self.free:
            return ()
        wheels = {mesh.name: tuple(mesh.gear.pair) for mesh in self._all_meshes}
        return tuple(each for each in pairs_by_shared_wheels(wheels) if {*each} <= {*self._requested})

    def _free_of(self, name: str) -> dict[str, Range]:
        """What is free of one pair by itself: not the half angle of a wheel that has another mate."""
        return {size: each for size, each in self.free.items() if size != "half_angle" or (name,) in self._one_angle}

    # ----------------------------------------------------------------------------------------------- what is compared

    def _with(self, sizes: Mapping[str, ToothSizes]) -> GearTrain:
        """The train with other sizes of some pairs."""
        declared = self.train.declaration
        gears = tuple(
            gear.model_copy(update={"tooth_form": as_form(sizes[gear.name])}) if gear.name in sizes else gear
            for gear in declared.gears
        )
        return GearTrain(declared.model_copy(update={"gears": gears}))

    def figure(self, sizes: Mapping[str, ToothSizes]) -> float:
        """What the train is judged by, small where it is good; infinite where it does not run."""
        self._on_step()
        if not self._acting:
            each = [sizes[name].merit(self.aim) for name in self._requested]
            return max(each) if self.aim == "jam" else sum(each)
        try:
            return self._loss(self._with(sizes)) if self.aim == "loss" else self._error(self._with(sizes))
        except GearTrainError:
            return inf

    def _loss(self, train: GearTrain) -> float:
        found = train.driven(self.link, self.source, self.state)
        efficiency = found.efficiency if found.verdict else None
        return inf if efficiency is None or efficiency <= 0 else 1 - float(efficiency)

    def _error(self, train: GearTrain) -> float:
        run = MotionRun(train.motion(self.state, (self.output,)), _TURNS, _SAMPLES)
        run.run()
        return run.statistics[0].peak_to_peak

    # ------------------------------------------------------------------------------------------------------ the search

    def found(self) -> BestTrainSizes:
        """Pair by pair, then together."""
        before = {name: self._starts[name] for name in self._requested}
        runs = {name: self._meshes[name].verdict.kind == "runs" for name in self._requested}
        first = self.figure({}) if all(runs.values()) and self._acting else self.figure(before)
        apart = self._apart()
        alone = self.figure(apart)
        best, together = (first, before) if first < alone and self._acting else (alone, apart)
        if best == inf:
            what = f"'{self.train.name}' passes nothing on to '{self.output}', whatever its teeth"
            raise QuestionError(Problem(what, "no sizes of its pairs let it run", "see `geartrain torques` of it"))
        if self._acting:
            best, together = self._descend(best, dict(together))
        outlines = {name: confirm_by_outlines(each) for name, each in together.items()}
        pairs = tuple(
            PairSizes(name, self._drivers[name], before[name], apart[name], together[name], runs[name], outlines[name])
            for name in self._requested
        )
        sign = -1 if self.aim == "jam" else 1
        return BestTrainSizes(
            self.train.name,
            self.aim,
            self.output,
            self.source,
            self.free,
            self.limits,
            sign * first if first < inf else None,
            sign * alone,
            sign * best,
            pairs,
            dict(self._untouched()),
            self._declaration(together),
        )

    def _apart(self) -> dict[str, ToothSizes]:
        """The best sizes of every pair by itself; of pairs that share wheels those at their best half angle."""
        found = {name: self._alone(name) for name in self._requested}
        for group in self._one_angle:
            if len(group) > 1:
                start, bounds = {name: found[name] for name in group}, self.free["half_angle"]
                found |= best_shared_angle(start, self._alone, bounds, self.aim, self.limits)
        return found

    def _alone(self, name: str, half_angle: float | None = None) -> ToothSizes:
        """The best sizes of one pair by itself, with the digits of a declaration."""
        start, free = self._starts[name], self._free_of(name)
        driver = 1 + self._meshes[name].gear.pair.index(self._drivers[name])
        start = replace(start if half_angle is None else start.at({"half_angle": half_angle}), driver=driver)
        key = start, tuple(free.items())
        if key not in self._done:
            search = SizeSearch(start, free, self.limits)
            self._done[key] = rounded(search.minimum(self.aim, [start])) if free else start
        self._on_step()
        return self._done[key]

    def _descend(self, best: float, sizes: dict[str, ToothSizes]) -> tuple[float, dict[str, ToothSizes]]:
        """Coordinate descent on the figure of the train."""
        alike = [group for group in self._one_angle if len(group) > 1]
        steps: list[tuple[tuple[str, ...], str]] = [
            ((name,), size) for name in self._requested for size in self._free_of(name)
        ]
        steps += [(group, "half_angle") for group in alike]
        reach = _REACH
        for _ in range(_SWEEPS):
            before = best
            for names, size in steps:
                best, better = self._step(best, sizes, names, size, reach)
                sizes |= better
            if before - best <= _GAIN * before:
                break
            reach /= 2
        return best, sizes

    def _step(
        self, best: float, sizes: Mapping[str, ToothSizes], names: Sequence[str], size: str, reach: float
    ) -> tuple[float, dict[str, ToothSizes]]:
        """The best value of one size of one pair, or of pairs alike, near where it is: by Brent's bounded method."""
        lowest, highest = self.free[size]
        here, width = sizes[names[0]].parameter(size), reach * (highest - lowest)
        found: tuple[float, dict[str, ToothSizes]] = best, {}

        def value(x: float) -> float:
            nonlocal found
            designs = {name: rounded(sizes[name].at({size: x})) for name in names}
            figure = (
                self.figure({**sizes, **designs}) if all(keeps(each, self.limits) for each in designs.values()) else inf
            )
            found = min(found, (figure, designs), key=lambda each: each[0])
            return min(figure, 1e6)

        low, high = max(lowest, here - width), min(highest, here + width)
        if high > low:
            minimize_scalar(value, bounds=(low, high), method="bounded", options={"maxiter": _TRIES, "xatol": 1e-6})
        return found

    # -------------------------------------------------------------------------------------------------- the declaration

    def _declaration(self, sizes: Mapping[str, ToothSizes]) -> dict[str, Any]:
        """A train that extends the one given."""
        gears = []
        for gear in self.train.declaration.gears:
            if gear.name in sizes:
                known: dict[str, Any] = {"id": gear.id} if gear.id else {}
                gears.append(known | {"pair": list(gear.pair), "tooth_form": form_data(sizes[gear.name])})
        return {
            "extends": self.train.name,
            "name": f"{self.train.name}-best-{self.aim}",
            "title": f"{self.train.declaration.title or self.train.name}: teeth sized for {self.aim} at {self.output}",
            "gears": gears,
        }


# ----------------------------------------------------------------------------------------------------------- the result


@dataclass(frozen=True)
class PairSizes(Result):
    """One pair of a train, its sizes as declared, best by itself, and best in the train.

    See Also
    --------
    find_train_sizes : finds them.
    """

    KEYS = ("name", "driver", "teeth", Key("before", "declared"), "apart", "together", "outlines")

    name: str
    """The pair."""
    driver: str
    """The wheel that drives."""
    before: ToothSizes
    """Sizes as declared."""
    apart: ToothSizes
    """Best sizes for the pair by itself."""
    together: ToothSizes
    """Best sizes for the train."""
    runs: bool
    """Whether the pair turns as declared."""
    outlines: OutlineAgreement
    """What the contact of the drawn outlines says of the last."""

    @property
    def teeth(self) -> tuple[int, int]:
        """Of the first and the second wheel that the pair names."""
        return self.before.teeth

    @property
    def declared(self) -> ToothSizes | None:
        """As declared; None where the pair does not turn so."""
        return self.before if self.runs else None


@dataclass(frozen=True)
class BestTrainSizes(Tabular, Pictured, Result):
    """The sizes of the triangular teeth with which a train is best, and what they gain.

    See Also
    --------
    find_train_sizes : an example.
    """

    ROW = "ToothSizes"
    MEANINGS: ClassVar = {
        "pair": "Gear pair.",
        "design": "Name of the design.",
        "half_angle_1": "Half angle of the teeth of the first wheel [rad].",
        "half_angle_2": "Half angle of the teeth of the second wheel [rad].",
    }

    PAGE = "workshop.sizes.tooth_sizes_report:describe_train_sizes"

    FIGURE = "train_sizes_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        *("train", "aim", "output", "source", "free", "limits", "before", "apart", "together", "pairs"),
        *("untouched", "declaration"),
    )

    train: str
    """Its name."""
    aim: str
    """What was optimised."""
    output: str
    """Link or output whose figure it is."""
    source: str
    """Link at which power enters."""
    free: Mapping[str, Range]
    """Bounds of the free parameters; angles in rad."""
    limits: tuple[SizeLimit, ...]
    """What each pair has to keep."""
    before: float | None
    """Figure of the train as declared; None where it does not run. A loss, an error peak to peak [rad], the sum of
    impacts, or the least margin [module]."""
    apart: float
    """The same figure with each pair best by itself."""
    together: float
    """The same figure with all pairs best together."""
    pairs: tuple[PairSizes, ...]
    """The pairs that act on the output."""
    untouched: Mapping[str, str]
    """Pairs with real teeth that stay as they are, and why."""
    declaration: Mapping[str, Any]
    """A train that extends the one given, with the sizes best together."""

    def _summary(self) -> str:
        before = "does not turn" if self.before is None else f"{self.before:.4g}"
        return f"{self.train}: {self.aim} at {self.output} {before} -> {self.together:.4g}, {len(self.pairs)} pairs"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """By pair, a row for its sizes as declared (if it turns so), best by itself, and best for the train."""
        rows = [
            (pair.name, name, sizes)
            for pair in self.pairs
            for name, sizes in (("declared", pair.declared), ("by itself", pair.apart), ("together", pair.together))
            if sizes is not None
        ]
        told = {"pair": [pair for pair, _, _ in rows], "design": [name for _, name, _ in rows]}
        return {**told, **size_columns([sizes for _, _, sizes in rows])}


def sizeable_meshes(meshes: Iterable[GearMesh]) -> dict[str, TriangularMesh]:
    """The pairs with triangular teeth whose sizes are not declared as lengths, by name."""
    found = (mesh for mesh in meshes if isinstance(mesh, TriangularMesh))
    return {mesh.name: mesh for mesh in found if not mesh.tooth_form.has_lengths}


def as_form(sizes: ToothSizes) -> Triangular:
    """A design as the form of a pair."""
    return Triangular.declared(form_data(sizes))


def declared_sizes(mesh: TriangularMesh) -> ToothSizes:
    """The sizes of a pair as declared: the first wheel of the pair first; in mid window where it does not turn."""
    sizes, window = mesh.transmission.sizes, mesh.window
    driver = 1 + mesh.gear.pair.index(mesh.driver)
    if driver == 2:
        sizes = sizes.swapped()
    place = 0.5
    if window and mesh.verdict.kind == "runs":
        place = min(max((sizes.excess - window.jam) / (window.run - window.jam), 0.0), 1.0)
    radii = sizes.R2 / sizes.R1 * sizes.z1 / sizes.z2
    # friction by a law of speed is searched under with its mean coefficient at the speed of the pair
    friction = mesh.losses.friction if mesh.verdict else mesh.transmission.friction
    return ToothSizes((sizes.z1, sizes.z2), radii, place, sizes.half_angles, friction, driver, sizes.ring)


# ---------------------------------------------------------------------------------------------- pairs that share wheels


def pairs_by_shared_wheels(wheels: Mapping[str, tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """The pairs of a train in groups that are connected by common wheels.

    wheels   of each pair, by its name

    >>> pairs_by_shared_wheels({"ab": ("a", "b"), "cd": ("c", "d"), "bd": ("b", "e")})
    (('ab', 'bd'), ('cd',))
    """
    joined: DisjointSets[str] = DisjointSets()
    for first, second in wheels.values():
        joined.join(first, second)
    groups: dict[str, list[str]] = {}
    for name, (first, _) in wheels.items():
        groups.setdefault(joined.find(first), []).append(name)
    return tuple(tuple(each) for each in groups.values())


def best_shared_angle(
    start: Mapping[str, ToothSizes],
    sized: Callable[[str, float], ToothSizes],
    bounds: Range,
    aim: str,
    limits: Sequence[SizeLimit],
) -> dict[str, ToothSizes]:
    """Pairs at the one half angle at which their figures together are best, never worse than at the start.

    start    the pairs with the half angles that they have
    sized    the best sizes of a pair at a half angle; raises `QuestionError` where none turns
    limits   that each pair has to keep
    """

    def figure(designs: Mapping[str, ToothSizes]) -> float:
        if not all(keeps(each, limits) for each in designs.values()):
            return inf
        each = [design.merit(aim) for design in designs.values()]
        return max(each) if aim == "jam" else sum(each)

    found = figure(start), dict(start)

    def value(angle: float) -> float:
        nonlocal found
        try:
            designs = {name: sized(name, angle) for name in start}
        except QuestionError:
            return 1e6
        minimum = figure(designs)
        found = min(found, (minimum, designs), key=lambda each: each[0])
        return min(minimum, 1e6)

    low, high = bounds
    step = (high - low) / (_SCAN - 1)
    best = min((low + step * each for each in range(_SCAN)), key=value)
    around = max(low, best - step), min(high, best + step)
    minimize_scalar(value, bounds=around, method="bounded", options={"maxiter": _ANGLE_TRIES, "xatol": _NEAR})
    return found[1]
