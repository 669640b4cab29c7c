"""Optimisation of the triangular teeth of a train: each pair separately, then all pairs together if they interact.

The pairs that act on the output first get the sizes that are best for each pair separately. The loss of the train or
the error of the output is then minimised by coordinate descent, which changes one size of one pair at a time. It starts
from the better of the declared sizes and the separate optima, so the result is never worse than these.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain
from math import inf
from typing import Any, ClassVar

from scipy.optimize import minimize_scalar

from geartrain.analysis.gear_train import GearTrain
from geartrain.dynamics import MotionRun
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.results import Key, Pictured, Result, Tabular
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.triangular.triangular_form import Triangular
from geartrain.teeth.triangular.triangular_mesh import TriangularMesh
from geartrain.workshop.sizes.best_sizes import OutlineAgreement, confirm_by_outlines
from geartrain.workshop.sizes.size_design import AIMS, SizeLimit, ToothSizes, form_data, keeps, rounded, size_columns
from geartrain.workshop.sizes.size_search import Range, SizeSearch, checked_ranges

OnStep = Callable[[], None]
_TURNS, _SAMPLES = 20.0, 2_000
"""Number of turns of the input, and number of positions, for the error of a pointer. Its extremes are refined between
these positions.
"""

# few and short steps, because an evaluation of the train is slow and each pair is near its separate optimum
_REACH = 0.03  # half width of one step of the descent, as a fraction of the range
_TRIES = 8  # maximum evaluations of the train in one step of the descent
_SWEEPS = 4  # maximum number of sweeps over all sizes
_GAIN = 1e-3  # relative improvement below which the sweeps end
_SCAN = 7  # number of half angles in the first scan
_ANGLE_TRIES, _NEAR = 8, 1e-3  # iterations and tolerance (rad) of Brent's method around the best of them


def find_train_sizes(
    train: GearTrain,
    output: str,
    aim: str = "loss",
    free: Mapping[str, Range | None] | None = None,
    limits: Sequence[SizeLimit] = (),
    state: str | None = None,
    on_step: OnStep = lambda: None,
) -> BestTrainSizes:
    """Find the sizes of the triangular teeth of a train that optimise loss, error, impact or margin at an output.

    Parameters
    ----------
    train : GearTrain
        Train in which some pairs have triangular teeth.
    output : str
        Name of an output or a link.
    aim : str
        Objective: `loss` or `error` of the train at the output, which is minimised; `impact`, the sum of the impacts of
        the pairs on the path to the output, which is minimised; or `jam`, the minimum margin of these pairs, which is
        maximised.
    free : mapping of str to (float, float), optional
        Bounds as in `find_tooth_sizes`. Pairs with common wheels have a common half angle, which is free if all of
        these pairs are optimised.
    limits : sequence of SizeLimit
        Limits for each pair.
    state : str, optional
        Name of a declared state; by default the first declared state.
    on_step : callable
        Progress function, called after each evaluation of the train and after each pair that is optimised separately.

    Returns
    -------
    BestTrainSizes
        Sizes before and after, with a declaration that extends the train.

    Raises
    ------
    QuestionError
        If the output does not depend on a pair with triangular teeth, or if no sizes are found with which the pairs
        turn.

    Notes
    -----
    Each pair is optimised by `find_tooth_sizes`, then the train by coordinate descent; docs/teeth.md, section 12.

    Examples
    --------
    >>> import geartrain
    >>> found = find_train_sizes(geartrain.load("moon-triangular"), "moon", "jam", {"window": (0.3, 0.7)})
    >>> found.together > found.before, [round(pair.together.window, 3) for pair in found.pairs]
    (True, [0.5, 0.5, 0.5, 0.5])
    """
    if aim not in AIMS:
        what = f"'{aim}' is not an objective"
        why = "sizes are optimised for one property of the train"
        raise QuestionError(Problem(what, why, f"use one of {', '.join(AIMS)}"))
    return TrainSizeSearch(train, output, aim, free, limits, state, on_step).found()


class TrainSizeSearch:
    """Search for the sizes of the pairs that act on one output of a train."""

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
        self._done: dict[Any, ToothSizes] = {}  # cache, because equal pairs have equal separate optima

    @property
    def _is_joint(self) -> bool:
        """True if the objective depends on all pairs jointly, because losses and errors propagate through the train."""
        return self.aim in ("loss", "error")

    # -------------------------------------------------------------------------------------------------------- pairs

    @cached_property
    def _drivers(self) -> Mapping[str, str]:
        """Driving wheel of each pair that acts on the output, keyed by pair."""
        meshes = {mesh.name: mesh for mesh in self._all_meshes}
        if self.aim == "loss":
            # ideal teeth are used, because declared teeth that do not turn would give no power flow
            pairs = self._ideal.driven(self.link, self.source, self.state).pairs
            return {name: pair.driver for name, pair in pairs.items() if name in meshes and pair.driver}
        moved = self._ideal.motion(self.state, (self.output,)).sensitivity[self.output]
        return {name: mesh.driver for name, mesh in meshes.items() if moved.get(name)}

    @cached_property
    def _ideal(self) -> GearTrain:
        """Train in which the clearance factor of every pair is midway between its limits, where limits exist."""
        return self._resized({name: each for name, each in self._starts.items() if each.runs})

    @cached_property
    def _all_meshes(self) -> tuple[GearMesh, ...]:
        return self.train.mechanics.meshes_in(self.state)

    @cached_property
    def _meshes(self) -> Mapping[str, TriangularMesh]:
        """Pairs with triangular teeth whose sizes are declared as ratios instead of lengths, keyed by pair."""
        found = (mesh for mesh in self._all_meshes if isinstance(mesh, TriangularMesh))
        return {mesh.name: mesh for mesh in found if not mesh.tooth_form.has_lengths}

    @cached_property
    def _starts(self) -> Mapping[str, ToothSizes]:
        return {name: declared_sizes(mesh) for name, mesh in self._meshes.items()}

    @cached_property
    def _requested(self) -> tuple[str, ...]:
        """Names of the pairs whose sizes are optimised."""
        found = tuple(name for name in self._meshes if name in self._drivers)
        if not found:
            what = f"no pair with triangular teeth acts on '{self.output}'"
            why = "only pairs between the input and the output influence it, and only triangular teeth have free sizes"
            fix = "give another --of, or declare `tooth_form: {form: triangular}`"
            raise QuestionError(Problem(what, why, fix))
        return found

    def _unchanged(self) -> Iterator[tuple[str, str]]:
        for mesh in self._all_meshes:
            if mesh.name not in self._drivers:
                yield mesh.name, f"not on the way to '{self.output}'"
            elif not isinstance(mesh, TriangularMesh):
                yield mesh.name, f"{mesh.tooth_form.words} teeth"
            elif mesh.name not in self._meshes:
                yield mesh.name, "declared in lengths"

    @cached_property
    def _common_angle_groups(self) -> tuple[tuple[str, ...], ...]:
        """Groups of optimised pairs with common wheels, which share one half angle; empty if it is not free."""
        if "half_angle" not in self.free:
            return ()
        pairs = {mesh.name: mesh.gear.pair for mesh in self._all_meshes}
        of_wheels = [[name for name, pair in pairs.items() if wheel in pair] for wheel in chain(*pairs.values())]
        return tuple(tuple(each) for each in joined_groups(pairs, of_wheels) if {*each} <= {*self._requested})

    def _free_of(self, name: str) -> dict[str, Range]:
        """Return the bounds of a pair's free parameters, without the half angle if another pair shares a wheel."""
        own_angle = (name,) in self._common_angle_groups
        return {size: each for size, each in self.free.items() if size != "half_angle" or own_angle}

    # ----------------------------------------------------------------------------------------------------- comparison

    def _resized(self, sizes: Mapping[str, ToothSizes]) -> GearTrain:
        """Return the train in which the pairs in `sizes` have the given sizes."""
        declared = self.train.declaration
        forms = {name: {"tooth_form": Triangular.declared(form_data(each))} for name, each in sizes.items()}
        gears = tuple(gear.model_copy(update=forms.get(gear.name, {})) for gear in declared.gears)
        return GearTrain(declared.model_copy(update={"gears": gears}))

    def figure(self, sizes: Mapping[str, ToothSizes]) -> float:
        """Return the objective of the train, to be minimised; infinite if the train cannot run with these sizes."""
        self._on_step()
        if not self._is_joint:
            each = [sizes[name].merit(self.aim) for name in self._requested]
            # the smallest margin decides on a jam, and impacts add up
            return max(each) if self.aim == "jam" else sum(each)
        try:
            train = self._resized(sizes)
            if self.aim == "loss":
                found = train.driven(self.link, self.source, self.state)
                efficiency = found.efficiency if found.verdict else None
                # an efficiency of 0 or less means that the train is self-locking
                return inf if efficiency is None or efficiency <= 0 else 1 - float(efficiency)
            run = MotionRun(train.motion(self.state, (self.output,)), _TURNS, _SAMPLES)
            run.run()
            return run.statistics[0].peak_to_peak
        except GearTrainError:
            return inf

    # ---------------------------------------------------------------------------------------------------------- search

    def found(self) -> BestTrainSizes:
        """Return the best sizes of the train. The pairs are optimised separately and then together."""
        before = {name: self._starts[name] for name in self._requested}
        runs = {name: self._meshes[name].verdict.kind == "runs" for name in self._requested}
        # the train itself, because the sizes in `before` would be rounded to the digits of a declaration
        first = self.figure({}) if all(runs.values()) and self._is_joint else self.figure(before)
        apart = self._separate_optima()
        alone = self.figure(apart)
        # pairs that are best separately need not be best together
        best, together = (first, before) if first < alone and self._is_joint else (alone, apart)
        if best == inf:
            what = f"'{self.train.name}' cannot drive '{self.output}' with any sizes of its teeth"
            why = "with all evaluated sizes, friction locks the train, or it cannot turn"
            raise QuestionError(Problem(what, why, f"see `geartrain torques {self.train.name}` for the cause"))
        if self._is_joint:
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
            dict(self._unchanged()),
            self._declaration(together),
        )

    def _separate_optima(self) -> dict[str, ToothSizes]:
        """Return the sizes that are best for each pair separately, with equal half angles of common wheels."""
        found = {name: self._separate_optimum(name) for name in self._requested}
        for group in self._common_angle_groups:
            if len(group) > 1:
                start, bounds = {name: found[name] for name in group}, self.free["half_angle"]
                found |= best_shared_angle(start, self._separate_optimum, bounds, self.aim, self.limits)
        return found

    def _separate_optimum(self, name: str, half_angle: float | None = None) -> ToothSizes:
        """Return the sizes that are best for one pair separately, rounded to the digits of a declaration."""
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
        """Return the minimum objective of the train and its designs, by coordinate descent from given values."""
        alike = [group for group in self._common_angle_groups if len(group) > 1]
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
            reach /= 2  # the changes of the sizes decrease from sweep to sweep
        return best, sizes

    def _step(
        self, best: float, sizes: Mapping[str, ToothSizes], names: Sequence[str], size: str, reach: float
    ) -> tuple[float, dict[str, ToothSizes]]:
        """Return the objective of the train and the changed designs after one size of the pairs `names` is optimised.

        best    objective with the present designs `sizes`
        size    name of the free parameter, which has a common value in these pairs
        reach   maximum change of the parameter, as a fraction of its range
        """
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
            return min(figure, 1e6)  # Brent's method needs finite values

        low, high = max(lowest, here - width), min(highest, here + width)
        if high > low:
            # a tolerance of 1e-6, because sizes are declared with 6 decimals
            minimize_scalar(value, bounds=(low, high), method="bounded", options={"maxiter": _TRIES, "xatol": 1e-6})
        return found

    # ------------------------------------------------------------------------------------------------------ declaration

    def _declaration(self, sizes: Mapping[str, ToothSizes]) -> dict[str, Any]:
        """Return a declaration that extends the given train and contains the given sizes."""
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


# --------------------------------------------------------------------------------------------------------------- result


@dataclass(frozen=True)
class PairSizes(Result):
    """Sizes of one pair of a train: as declared, best for the pair, and best for the train."""

    KEYS = ("name", "driver", "teeth", Key("before", "declared"), "apart", "together", "outlines")

    name: str
    """Name of the pair."""
    driver: str
    """Name of the driving wheel."""
    before: ToothSizes
    """Declared sizes of the pair."""
    apart: ToothSizes
    """Tooth sizes that optimise the objective for this pair separately."""
    together: ToothSizes
    """Tooth sizes of the pair that optimise the objective for the whole train."""
    runs: bool
    """True if the pair turns with its declared sizes."""
    outlines: OutlineAgreement
    """Comparison of properties of the sizes `together` with those computed from the drawn outlines."""

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the first and the second wheel of the pair."""
        return self.before.teeth

    @property
    def declared(self) -> ToothSizes | None:
        """Declared sizes of the pair; None if the pair cannot turn with them."""
        return self.before if self.runs else None


@dataclass(frozen=True)
class BestTrainSizes(Tabular, Pictured, Result):
    """Best sizes of all triangular teeth of a train, and the value of the objective before and after the optimisation.

    See Also
    --------
    find_train_sizes : Find the best sizes, with an example.
    """

    ROW = "ToothSizes"
    MEANINGS: ClassVar = {
        "pair": "Gear pair.",
        "design": "Name of the design.",
        "half_angle_1": "Half angle of the teeth of the first wheel [rad].",
        "half_angle_2": "Half angle of the teeth of the second wheel [rad].",
    }

    PAGE = "workshop.sizes.tooth_sizes_report:describe_train_sizes"

    FIGURE = "workshop.sizes.tooth_sizes_plot:train_sizes_figure"

    train: str
    """Name of the train."""
    aim: str
    """Objective: loss, error, impact or jam."""
    output: str
    """Name of the link or output at which the objective is evaluated."""
    source: str
    """Name of the link at which power enters."""
    free: Mapping[str, Range]
    """Bounds of the free parameters, keyed by parameter name. Angles are in rad."""
    limits: tuple[SizeLimit, ...]
    """Limits that the sizes of each pair must satisfy."""
    before: float | None
    """Value of the objective with the declared sizes; None if the train does not run.

    The objective is the loss [1], the peak-to-peak transmission error [rad], the sum of impacts [1], or the minimum
    margin [module].
    """
    apart: float
    """Value of the objective with each pair optimised separately, in the unit of `before`."""
    together: float
    """Value of the objective with all pairs optimised together, in the unit of `before`."""
    pairs: tuple[PairSizes, ...]
    """Sizes of the pairs on which the output depends."""
    untouched: Mapping[str, str]
    """Mapping from each pair with a tooth form whose sizes are unchanged to the reason."""
    declaration: Mapping[str, Any]
    """Declaration with the best sizes, which extends the given train."""

    def _summary(self) -> str:
        before = "does not turn" if self.before is None else f"{self.before:.4g}"
        return f"{self.train}: {self.aim} at {self.output} {before} -> {self.together:.4g}, {len(self.pairs)} pairs"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with up to three designs of each pair: its declared sizes (only if these teeth can turn),
        the best sizes of the pair on its own, and the best sizes for the whole train.
        """
        rows = [
            (pair.name, name, sizes)
            for pair in self.pairs
            for name, sizes in (("declared", pair.declared), ("separately", pair.apart), ("together", pair.together))
            if sizes is not None
        ]
        names = {"pair": [pair for pair, _, _ in rows], "design": [name for _, name, _ in rows]}
        return {**names, **size_columns([sizes for _, _, sizes in rows])}


def declared_sizes(mesh: TriangularMesh) -> ToothSizes:
    """Return the declared sizes of a pair, with its clearance factor midway between the limits if it does not turn."""
    sizes, window = mesh.transmission.sizes, mesh.window
    driver = 1 + mesh.gear.pair.index(mesh.driver)
    if driver == 2:
        sizes = sizes.swapped()
    place = 0.5
    if window and mesh.verdict.kind == "runs":
        # rounding can put a clearance at an end of the window outside it
        place = min(max((sizes.excess - window.jam) / (window.run - window.jam), 0.0), 1.0)
    radii = sizes.R2 / sizes.R1 * sizes.z1 / sizes.z2
    # friction that depends on speed is replaced by its mean coefficient at the speed of the pair
    friction = mesh.losses.friction if mesh.verdict else mesh.transmission.friction
    return ToothSizes((sizes.z1, sizes.z2), radii, place, sizes.half_angles, friction, driver, sizes.ring)


# --------------------------------------------------------------------------------------------- pairs with common wheels


def best_shared_angle(
    start: Mapping[str, ToothSizes],
    sized: Callable[[str, float], ToothSizes],
    bounds: Range,
    aim: str,
    limits: Sequence[SizeLimit],
) -> dict[str, ToothSizes]:
    """Return the designs of several pairs at the common half angle that minimises their total objective.

    start    designs of the pairs with their present half angles, which are returned if no other angle is better
    sized    function that returns the best sizes of a pair (name) at a half angle (rad); it raises `QuestionError` if
             the pair turns with no sizes
    bounds   bounds of the half angle (rad)
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
        return min(minimum, 1e6)  # Brent's method needs finite values

    low, high = bounds
    step = (high - low) / (_SCAN - 1)
    # the scan finds the right basin; Brent's method then refines within it
    best = min((low + step * each for each in range(_SCAN)), key=value)
    around = max(low, best - step), min(high, best + step)
    minimize_scalar(value, bounds=around, method="bounded", options={"maxiter": _ANGLE_TRIES, "xatol": _NEAR})
    return found[1]
