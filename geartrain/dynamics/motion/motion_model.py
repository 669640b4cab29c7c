"""Motion of a solved train: pairs with variable transmission errors, their drivers, starting positions, and error
propagation.

At position 0 every tooth and pin has its declared phase, and the error of every pointer is set to 0 (section 3 of
docs/motion.md). The angles of drivers are measured from position 0, so that the errors of other pairs do not change the
initial phase of a pair.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import islice
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.error_composition import (
    ErrorComposition,
    ErrorDifference,
    ErrorSamples,
    SeenLink,
    common_period,
    evaluate,
)
from geartrain.dynamics.motion.kink_positions import KinkPositions, KinkSearch
from geartrain.dynamics.motion.motion_problem import MotionProblem
from geartrain.dynamics.motion.pair_errors import PairErrors
from geartrain.dynamics.motion.run_statistics import RunningStatistics, mean_speed
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.willis_system import axis_sense
from geartrain.numerics.results import Key, Result, Shown, Tabular, brief, imported_function

if TYPE_CHECKING:
    from numpy.random import Generator

    from geartrain.dynamics.motion.error_propagation import ErrorPath, ErrorPropagation
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class TransmissionErrorCurve(Tabular, Result):
    """Transmission error of one output as a function of the input angle.

    The error of an output with a pin and slot includes the designed deviation from uniform motion (anomaly).

    See Also
    --------
    Motion.transmission_error : method that returns it
    """

    KEYS = (Key("", "statistics"),)

    name: str
    """Name of the output."""
    ratio: Fraction
    """Exact mean speed of the output divided by the speed of the input [1]."""
    angle: Floats
    """Angle of the input [rad], shape (n,)."""
    error: Floats
    """Angle of the output minus its mean motion [rad], shape (n,)."""
    speed: Floats
    """Speed of the output divided by the input speed [1], shape (n,)."""
    slides: bool = False
    """True for a sliding output link; its error is then in mm, and its speed in mm per revolution of the input."""

    def _meaning(self, column: str) -> str:
        text, unit = super()._meaning(column), {"error": "mm", "speed": "mm/turn"}.get(column)
        return f"{text.split(' [')[0]} [{unit}]." if self.slides and unit else text

    def _summary(self) -> str:
        factor, unit = self.statistics.degrees_or_mm, "mm" if self.slides else "deg"
        figures = f"p-p {factor * self.peak_to_peak:.4g} {unit}, rms {factor * self.rms:.4g} {unit}"
        return f"{self.name}: {figures}, mean ratio {brief(self.ratio)}, {len(self.angle)} positions"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each position: angle of the input, transmission error and speed."""
        return {"angle": self.angle.tolist(), "error": self.error.tolist(), "speed": self.speed.tolist()}

    @property
    def mean(self) -> float:
        """Mean speed of the output divided by the speed of the input [1]."""
        return mean_speed(self.name, self.ratio)

    @cached_property
    def statistics(self) -> RunningStatistics:
        """Extremes, mean and root mean square of the output's transmission error, and extremes of its speed."""
        found = RunningStatistics(self.name, self.ratio, slides=self.slides)
        found.add(self.error, self.speed - self.mean)
        return found

    @property
    def peak_to_peak(self) -> float:
        """Maximum minus minimum of the transmission error [rad, or mm for a link that slides]."""
        return self.statistics.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the transmission error about its mean [rad, or mm for a link that slides]."""
        return self.statistics.rms


_MAIN = 3  # outputs in a summary


class Motion(Shown):
    """Motion of a train, including the errors of its teeth and pins, as a function of the revolutions of its input.

    Transmission functions are composed in the order in which the train is solved: equations (2) and (3) of
    docs/motion.md. At position 0 every tooth and pin has its declared `phase`, and every link has the position that it
    would have with ideal teeth (section 3 of that page).

    Parameters
    ----------
    train : MotionProblem
        Equations, mean speeds, transmission functions and drivers of the pairs, as collected by `GearTrain.motion`.
    outputs : mapping of str to tuple of str
        Link and reference link of each output, by name.

    Raises
    ------
    GearTrainError
        If the real teeth of a redundant loop cannot turn together, or the train has no order of solution.

    Examples
    --------
    The four pairs of triangular teeth that drive the Moon repeat their positions after 95 revolutions of the crank:

    >>> import geartrain
    >>> motion = geartrain.load("moon-triangular").motion(outputs=["moon"])
    >>> motion.period, round(motion.sensitivity["moon"]["d2~e"], 12)
    (Fraction(95, 1), 1.0)
    >>> found = motion.at([0.0, 0.1])
    >>> bool(abs(found.error[0, 0]) < 1e-12), float(found.error[0, 1].round(3))
    (True, -0.061)
    """

    PAGE = "report.motion_report:motion_document"

    def __init__(self, train: MotionProblem, outputs: Mapping[str, tuple[str, str]]) -> None:
        self._problem, self.outputs = train, outputs
        self._errors = PairErrors(train, {link for ends in outputs.values() for link in ends})
        self._index = self._errors.index
        self._declaration: Any = None  # declaration of the train, for `print`
        self._state: str | None = None
        self._without: tuple[str, ...] = ()
        self._shown = tuple(outputs)  # outputs that a plot shows
        self._ideal: Motion | None = None  # motion whose errors are subtracted
        for loop, real in train.contradictions():
            path = " - ".join((*loop.links, loop.links[0]))
            raise GearTrainError(
                Problem(
                    f"the pairs {', '.join(loop.pairs)} form a loop, {path}, that locks with real teeth",
                    f"its mean speeds agree, but the errors of {', '.join(real)} would have to cancel at every instant",
                    f"omit a pair of the loop, such as `--without {loop.pairs[-1]}`",
                )
            )

    def _summary(self) -> str:
        name = "" if self._declaration is None else self._declaration.name
        state = "" if self._state is None else f" state {self._state}"
        driving = self._problem.driving_link
        means = [(each, self._problem.seen_ratio(*self.outputs[each])) for each in islice(self.outputs, _MAIN)]
        shown = ", ".join(f"{each} = {brief(ratio)} of {driving}" for each, ratio in means)
        more = f", {len(self.outputs) - _MAIN} more" if len(self.outputs) > _MAIN else ""
        return f"{name}{state}: mean {shown or 'of no output'}{more}".strip()

    # ----------------------------------------------------------------------------------------------- compositions

    @property
    def _propagation(self) -> ErrorPropagation:
        return self._errors.spread

    def _path(self, pair: str) -> ErrorPath:
        """Return the links of a pair that determine its error. Raise `QuestionError` for a redundant pair."""
        if pair in self._propagation.pairs:
            return self._propagation.joints[self._propagation.pairs.index(pair)]
        why = (
            "other pairs already determine the motion of its wheels, and backlash and errors decide how they share the "
            "load"
        )
        fix = f"omit it with --without {pair}, or declare equal planets as one link, with `copies: 3`"
        raise QuestionError(Problem(f"the dynamics of the redundant pair '{pair}' cannot be simulated", why, fix))

    @cached_property
    def _forward(self) -> ErrorComposition:
        """Composition of the transmission errors of all pairs while the input turns in its declared sense."""
        return self._composed(1)

    def _with_sources(self, pairs: Collection[str]) -> ErrorComposition:
        """Return the error composition for the declared sense of the input that also evaluates the given pairs."""
        return self._composed(1, pairs)

    @cached_property
    def _unset(self) -> ErrorComposition:
        """Error composition with the original output errors, which need not be 0 at position 0 of the input."""
        return replace(self._forward, offsets=())

    @cached_property
    def _backward(self) -> ErrorComposition:
        """Composition of the transmission errors of all pairs while the input turns against its declared sense and
        coast flanks are in contact.
        """
        return self._composed(-1)

    @cached_property
    def _seen(self) -> tuple[SeenLink, ...]:
        index, signs = self._index, self._problem.signs
        return tuple(
            SeenLink(
                index[of], index[base], axis_sense(of, base, signs), 1 / (2 * pi) if name in self._sliding else 1.0
            )
            for name, (of, base) in self.outputs.items()
        )

    def _composed(self, way: int, besides: Collection[str] = ()) -> ErrorComposition:
        """Return the error composition for the declared (`way` 1) or the opposite (`way` -1) sense of the input. The
        error of every output is 0 at position 0. The pairs `besides` are evaluated even if no output depends on them.
        """
        backlash, (teeth, pins) = self._errors.backlash(way), self._start
        found = ErrorComposition(self._errors.spread, tuple(self._errors.sources(way, besides)), self._seen)
        for step in found.steps:
            jumping = [found.sources[at].id for at in step.sources if found.sources[at].transmission.at_once]
            if step.coupled and jumping:
                what = f"the instantaneous step of '{jumping[0]}' turns its own driver"
                why = "an instantaneous step does not define the position of the driver during the step"
                raise GearTrainError(Problem(what, why, "give `over`, or let the driver of the coupling be the input"))
        sources = tuple(
            replace(
                each,
                # backlash displaces the driver; `set_back` is its advance at position 0 due to other pairs
                phase=each.phase + found.driver_shift(each, backlash),
                set_back=found.driver_shift(each, teeth + pins),
            )
            for each in found.sources
        )
        return replace(found, sources=sources, offsets=tuple(each.difference(backlash - teeth) for each in self._seen))

    @cached_property
    def _start(self) -> tuple[Floats, Floats]:
        """Errors of the links at position 0 of the input [rad], shape (links,): those that gear pairs cause, and those
        that couplings with a variable ratio cause.
        """
        deltas = np.zeros((len(self._errors.spread.pairs), 2))
        pins = {joint.coupling.name for joint in self._problem.couplings}
        for each in self._errors.sources(1):
            deltas[each.pair, int(each.id in pins)] = each.sense * float(each.transmission.error(each.phase))
        teeth, slots = self._errors.spread.errors(deltas).T
        return teeth, slots

    @cached_property
    def pointer_offsets(self) -> Mapping[str, float]:
        """Constant angle between the pointer of each output and its wheels [rad, or mm for a link that slides], such
        that the output's error at position 0 is 0.
        """
        return {name: seen.difference(-self._start[0]) for name, seen in zip(self.outputs, self._seen, strict=True)}

    def _with_angles(self, angles: Mapping[str, float]) -> Motion:
        """Return the motion of the same train in which some links have the given initial angles [rad], by link."""
        return Motion(replace(self._problem, angles={**self._problem.angles, **angles}), self.outputs)

    def with_random_phases(self, random: Generator) -> Motion:
        """Return the motion with random phases of the pairs that declare a tooth form but no phase.

        Parameters
        ----------
        random : numpy.random.Generator
            Generator of the phases, which are uniformly distributed in [0, 1) [pitch].

        Returns
        -------
        Motion
            Motion with the same outputs.
        """
        declared = self._problem.phases
        # the phase of a planet's second pair follows from its first pair
        free = [mesh.name for mesh in self._problem.rippling if self._problem.placed_by(mesh.name) is None]
        drawn = {name: float(random.random()) for name in free if name not in declared}
        return Motion(replace(self._problem, phases={**drawn, **declared}), self.outputs)

    # -------------------------------------------------------------------------------------------------- results

    @cached_property
    def period(self) -> Fraction | None:
        """Revolutions of the input after which all pairs repeat their positions; None if every error is constant."""
        return common_period(self._forward.used)

    @cached_property
    def sensitivity(self) -> Mapping[str, Mapping[str, float]]:
        """Change of an output's angle per unit error of the driven link of a pair [rad/rad, or mm/rad for an output
        that slides], by output and pair. Pairs with ideal teeth are included.
        """
        found = {}
        for name, seen in zip(self.outputs, self._seen, strict=True):
            changes = seen.scale * self._propagation.sensitivity(*seen[:3])
            found[name] = dict(zip(self._propagation.pairs, changes.tolist(), strict=True))
        return found

    @cached_property
    def advances(self) -> Mapping[str, float]:
        """Mean speed ratio (link to input) of each link that clutches advance in steps, by link [1]."""
        stepped = self._problem.stepped
        if stepped is None:
            return {}
        from geartrain.dynamics.motion.stepped_advance import mean_advance

        drivers = Motion(self._problem, self._problem.without_steps({}))
        return {stepped.link: mean_advance(self._problem, drivers._forward, stepped)}

    def _statistics(self) -> list[RunningStatistics]:
        return [
            RunningStatistics(name, self._problem.seen_ratio(of, base), slides=name in self._sliding)
            for name, (of, base) in self.outputs.items()
        ]

    @cached_property
    def _sliding(self) -> frozenset[str]:
        """Names of the outputs of links that slide, whose travel is in mm."""
        lines = self._problem.tree.lines if self._problem.tree is not None else {}
        return frozenset(name for name, (of, _) in self.outputs.items() if of in lines)

    @property
    def _start_angles(self) -> list[float]:
        """Declared angle of each output at position 0 [rad], positive in the sense in which the input turns."""
        angles = self._problem.way * np.array([self._problem.angles.get(link, 0.0) for link in self._propagation.links])
        return [seen.difference(angles) for seen in self._seen]

    def _stretches(self, turns: float, samples: int, first: int = 0) -> Iterator[ErrorSamples]:
        """Yield the errors at equally spaced positions from 0 to `turns`, both included, in chunks that fit in memory.

        turns   revolutions of the input; if negative, the input turns against its declared sense, on coast flanks
        first   index of the first position
        """
        sampler = self._sampler(turns)
        chunk = sampler.chunk
        for start in range(first, samples, chunk):
            at = np.arange(start, min(start + chunk, samples))
            # division first: the last position is exactly `turns`, wherever chunks begin
            yield sampler.at(turns * (at / (samples - 1)))

    def _composition(self, turns: float) -> ErrorComposition:
        """Return the error composition for a motion over `turns` revolutions of the input, which are negative if coast
        flanks are in contact.
        """
        return self._forward if turns >= 0 else self._backward

    def _sampler(self, turns: float) -> ErrorComposition | ErrorDifference:
        """Return the object that computes the output errors at given positions: an error composition, or the difference
        between two compositions if the errors of ideal teeth are subtracted.
        """
        own = self._composition(turns)
        return own if self._ideal is None else ErrorDifference(own, self._ideal._composition(turns))

    def at(self, turns: Floats) -> ErrorSamples:
        """Return the transmission errors and speed deviations of the outputs at given positions of the input, which
        turns in its declared sense.

        Parameters
        ----------
        turns : sequence of float, (n,)
            Positions of the input [revolutions], in any order.

        Returns
        -------
        ErrorSamples
            Transmission errors [rad] and speed deviations [1] at these positions.
        """
        turns = np.asarray(turns, dtype=float)
        return evaluate(self._sampler(1), turns)

    def kink_positions(self, start: float, end: float) -> KinkPositions:
        """Return the positions of the input at which a pair passes a kink of its transmission function. The errors of
        all outputs are smooth between these positions.

        Only pairs on which an output depends are included. A speed may jump at a kink; evaluate it slightly before and
        after the kink to obtain its one-sided limits.

        Parameters
        ----------
        start, end : float
            Positions of the input [revolutions]. If `end` is less than `start`, the coast flanks are in contact.

        Returns
        -------
        KinkPositions
            Positions in ascending order, each with its pair; both ends are included.

        Raises
        ------
        QuestionError
            If there are more than 20 million kinks.

        Examples
        --------
        A pair of triangular teeth has one kink per pitch, and the driver of the first pair passes 45 kinks in one
        revolution of the crank:

        >>> import geartrain
        >>> kinks = geartrain.load("moon-triangular").motion(outputs=["moon"]).kink_positions(0, 1)
        >>> len(kinks.turns), kinks.names().count("a~b1")
        (160, 45)
        """
        composition = self._composition(end - start)
        return KinkSearch(composition).over(min(start, end), max(start, end))

    def transmission_errors(
        self, turns: float = 1.0, samples: int = 2001, on_done: Callable[[int], None] = lambda _: None
    ) -> dict[str, TransmissionErrorCurve]:
        """Return the transmission error of every output at equal steps of the input.

        Parameters
        ----------
        turns : float
            Revolutions of the input from position 0. If negative, the input turns against its declared sense, and the
            coast flanks are in contact.
        samples : int
            Number of positions including both ends, 2 or more.
        on_done : callable
            Progress function, called with the number of positions computed since the last call.

        Returns
        -------
        dict of str to TransmissionErrorCurve
            Transmission error of each output.

        Examples
        --------
        >>> import geartrain
        >>> motion = geartrain.load("moon-triangular").motion()
        >>> {name: round(error.peak_to_peak, 3) for name, error in motion.transmission_errors().items()}
        {'sun': 0.001, 'moon': 0.102}
        """
        error = np.empty((len(self.outputs), samples))
        rate = np.empty_like(error)
        angle = np.empty(samples)
        done = 0
        for passage in self._stretches(turns, samples):
            part = slice(done, done + len(passage.turns))
            # `angle` has revolutions here; it is converted to radians below
            angle[part], error[:, part], rate[:, part] = passage[:3]
            done = part.stop
            on_done(len(passage.turns))
        angle *= 2 * pi
        return {
            each.name: TransmissionErrorCurve(
                each.name, each.ratio, angle, error[at], each.mean + rate[at], each.slides
            )
            for at, each in enumerate(self._statistics())
        }

    def transmission_error(self, output: str, turns: float = 1.0, samples: int = 2001) -> TransmissionErrorCurve:
        """Return the transmission error of one output at equal steps of the input.

        Parameters
        ----------
        output : str
            Name of the output.
        turns, samples : float, int
            Revolutions of the input and number of positions, as for `transmission_errors`.

        Returns
        -------
        TransmissionErrorCurve
            Transmission error at every position, with its peak-to-peak value and root mean square.

        Raises
        ------
        QuestionError
            If the output is not part of this motion.

        Examples
        --------
        >>> import geartrain
        >>> motion = geartrain.load("moon-triangular").motion()
        >>> round(motion.transmission_error("moon").peak_to_peak, 3)
        0.102
        """
        check_choice("output", output, list(self.outputs))
        return self._of((output,)).transmission_errors(turns, samples)[output]

    def run(self, turns: float = 20.0, samples: int = 200_000) -> Any:
        """Compute the motion over a number of revolutions of the input, with the extremes, mean and root mean square of
        each output's error, and the extremes of its speed.

        Parameters
        ----------
        turns, samples : float, int
            Revolutions of the input and number of positions, as for `transmission_errors`.

        Returns
        -------
        geartrain.dynamics.MotionRun
            Run with statistics of all outputs; `print` shows the report of `geartrain motion`.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("moon-triangular").motion().run(turns=1, samples=2001)
        <MotionRun moon-triangular: 1 turn, transmission error p-p sun 0.02904 deg, moon 5.895 deg>
        """
        run = imported_function("dynamics.motion.motion_run", "MotionRun")(self, turns, samples)
        run.run()
        return run

    @cached_property
    def _usual_run(self) -> Any:
        """Evaluation of the motion with the default options of `geartrain motion`, which `print` displays."""
        return self.run()

    def _with_transmissions(self, transmissions: Mapping[str, Any]) -> Motion:
        """Return the motion in which the transmission functions of some pairs are replaced, by name of the pair."""
        meshes = dict(self._problem.meshes)
        meshes |= {name: replace(meshes[name], transmission=each) for name, each in transmissions.items()}
        motion = self._of(tuple(self.outputs), replace(self._problem, meshes=meshes))
        motion._shown = self._shown
        return motion

    def _of(self, outputs: Sequence[str], problem: MotionProblem | None = None) -> Motion:
        shown = {name: self.outputs[name] for name in outputs}
        motion = Motion(problem or self._problem, shown)
        motion._declaration, motion._state, motion._without = self._declaration, self._state, self._without
        return motion

    def _turning(self, requested: Collection[str] = ()) -> Motion:
        """Return the motion restricted to the outputs that turn. Raise `QuestionError` if a requested output slides, or
        if all outputs slide.
        """
        turning = tuple(name for name in self.outputs if name not in self._sliding)
        if not turning or not self._sliding.isdisjoint(requested):
            what = f"'{min(self._sliding)}' slides, and errors of pointers are angles"
            fix = "name outputs that turn, such as `--of ARBOR`"
            raise QuestionError(Problem(what, "`geartrain motion` reports the errors of travels in mm", fix))
        motion = self._of(turning)
        motion._shown = tuple(name for name in self._shown if name in turning) or turning
        return motion

    def without_anomaly(self) -> Motion:
        """Return the motion with only the errors that are caused by the teeth. The errors of the train with ideal teeth
        and the same couplings, at the same positions of the input, are subtracted.

        Returns
        -------
        Motion
            Motion with the same outputs; self if the train has no couplings, or only teeth with a constant ratio.
        """
        if not (self._problem.couplings and self._problem.rippling):
            return self
        motion = self._of(tuple(self.outputs))
        motion._ideal = self._with_ideal_teeth()
        return motion

    def _with_ideal_teeth(self) -> Motion:
        """Return the motion of the same train and couplings with ideal teeth (constant ratio, no backlash)."""
        return Motion(replace(self._problem, meshes={}), self.outputs)

    def _degrees_per_day(self, output: str) -> float | None:
        """Return the magnitude of an output's mean speed [deg/d]; None if it is 0, or if the unit is not a time."""
        unit = None if self._declaration is None else self._declaration.unit_days
        speed = self._problem.seen_ratio(*self.outputs[output]) * self._problem.speeds[self._problem.driving_link]
        return float(360 * abs(speed) / unit) if unit and speed else None

    def plot(self, *outputs: str, turns: float = 1.0, samples: int = 2001) -> Any:
        """Draw angles, errors and speeds against the revolutions of the input as a matplotlib figure.

        Parameters
        ----------
        *outputs : str
            Names of the outputs to draw; by default all outputs.
        turns : float
            Revolutions of the input, from position 0.
        samples : int
            Number of positions including both ends, 2 or more.

        Returns
        -------
        matplotlib.figure.Figure
            Figure with a panel for each kind of curve.

        Raises
        ------
        MissingExtraError
            If matplotlib is not installed (extra `plot`).
        QuestionError
            If an output is not part of this motion.

        Examples
        --------
        >>> import geartrain
        >>> motion = geartrain.load("moon-triangular").motion()
        >>> motion.plot("moon", turns=0.1).axes[-1].get_xlabel()
        'turns of crank'
        """
        for name in outputs:
            check_choice("output", name, list(self.outputs))
        shown = self._of(outputs or tuple(self.outputs))
        run = imported_function("dynamics.motion.motion_run", "MotionRun")(shown, turns, samples)
        return run.plot()
