"""From a solved train to its motion: which pairs ripple, who drives, where they start, and how their errors spread.

At turn 0 every tooth and pin is where its phase says, and every pointer is set: section 3 of docs/motion.md. The angles
of drivers are counted from turn 0, so that the errors of the pairs before a pair do not move the tooth with which it
starts.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import islice
from math import degrees, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorSamples, SeenLink, common_period
from geartrain.dynamics.motion.kink_positions import KinkPositions, KinkSearch
from geartrain.dynamics.motion.motion_problem import MotionProblem
from geartrain.dynamics.motion.pair_errors import PairErrors
from geartrain.dynamics.motion.run_statistics import RunningStatistics, mean_speed
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.willis_system import axis_sense
from geartrain.numerics.kernels import is_fast
from geartrain.numerics.results import Key, Result, Shown, Tabular, brief, picture_maker

if TYPE_CHECKING:
    from numpy.random import Generator

    from geartrain.dynamics.motion.compiled_composition import CompiledComposition
    from geartrain.dynamics.motion.error_propagation import ErrorPath, ErrorPropagation
    from geartrain.dynamics.motion.run_statistics import ErrorSampler
    from geartrain.numerics.arrays import Floats

_PACE = 2e6  # links per second that numpy computes, in most trains


@dataclass(frozen=True)
class PointerCompositions:
    """The compositions of some outputs of a train, from the errors of its pairs."""

    errors: PairErrors
    outputs: tuple[SeenLink, ...]

    def composed(self, way: int, besides: Collection[str] = ()) -> ErrorComposition:
        """The composition while the input turns that way; `besides` as of `PairErrors.sources`."""
        backlash, (teeth, pins) = self.errors.backlash(way), self._start
        found = ErrorComposition(self.errors.spread, tuple(self.errors.sources(way, besides)), self.outputs)
        sources = tuple(
            replace(
                each,
                phase=each.phase + found.driver_shift(each, backlash),
                set_back=found.driver_shift(each, teeth + pins),
            )
            for each in found.sources
        )
        return replace(
            found, sources=sources, offsets=tuple(each.difference(backlash - teeth) for each in self.outputs)
        )

    @cached_property
    def _start(self) -> tuple[Floats, Floats]:
        """What teeth, and what pins add to the angle of each link at turn 0 (rad): linear, as all drivers are known."""
        deltas = np.zeros((len(self.errors.spread.pairs), 2))
        pins = {joint.coupling.name for joint in self.errors.train.pins}
        for each in self.errors.sources(1):
            deltas[each.pair, int(each.id in pins)] = each.sense * float(each.transmission.error(each.phase))
        teeth, slots = self.errors.spread.errors(deltas).T
        return teeth, slots

    @property
    def setting(self) -> Floats:
        """By how much each link is turned on its wheels (rad), so that its teeth do not displace it at turn 0."""
        return -self._start[0]


@dataclass(frozen=True)
class TransmissionErrorCurve(Tabular, Result):
    """The transmission error of one output, position by position.

    See Also
    --------
    Motion.transmission_error : Gives it.
    """

    KEYS = (Key("", "statistics"),)

    name: str
    """The output."""
    ratio: Fraction
    """Exact mean speed over the input's."""
    angle: Floats
    """Angle of the input [rad]. Shape (n,)."""
    error: Floats
    """Angle less its mean motion [rad]. Shape (n,)."""
    speed: Floats
    """Speed over the input's [1]. Shape (n,)."""

    def _summary(self) -> str:
        figures = f"p-p {degrees(self.peak_to_peak):.4g} deg, rms {degrees(self.rms):.4g} deg"
        return f"{self.name}: {figures}, mean ratio {brief(self.ratio)}, {len(self.angle)} positions"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each position: angle of the input, transmission error and speed."""
        return {"angle": self.angle.tolist(), "error": self.error.tolist(), "speed": self.speed.tolist()}

    @property
    def mean(self) -> float:
        """Mean speed over the input's."""
        return mean_speed(self.name, self.ratio)

    @cached_property
    def statistics(self) -> RunningStatistics:
        """Peaks and moments."""
        found = RunningStatistics(self.name, self.ratio)
        found.add(self.error, self.speed - self.mean)
        return found

    @property
    def peak_to_peak(self) -> float:
        """Maximum less minimum of the transmission error [rad]."""
        return self.statistics.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the transmission error about its mean [rad]."""
        return self.statistics.rms


_MAIN = 3  # outputs in a summary


class Motion(Shown):
    """A train's motion with real teeth and pins, as a function of the turns of its input.

    Transmission functions are composed along the solved order of the train: equations (2) and (3) of docs/motion.md. At
    turn 0 every tooth and pin is where its `phase` says, and every link where ideal teeth would have it (section 3
    there).

    Parameters
    ----------
    train : MotionProblem
        Rows, mean speeds, laws of pairs, drivers: `GearTrain.motion` gathers them.
    outputs : mapping of str to tuple of str
        Name -> the link, and the link it is seen from.
    tolerance : float, optional
        Laws are read from tables of this accuracy [pitches, between 0 and 1]; by default the laws themselves are asked.
    fast : bool, optional
        Whether compiled kernels follow the motion, the same to 1e-12; by default where numba is installed and there are
        so many positions that it pays to load it.

    Raises
    ------
    MissingExtraError
        If kernels are asked for and numba is not installed: when positions are first asked for.
    QuestionError
        If the tolerance is no part of a pitch.
    GearTrainError
        If a redundant loop has teeth that cannot turn together, or the train has no solved order.

    Examples
    --------
    The four pairs of triangular teeth before the Moon stand as at the start after 95 turns of the crank:

    >>> import geartrain
    >>> motion = geartrain.load("moon-triangular").motion(outputs=["moon"])
    >>> motion.period, round(motion.sensitivity["moon"]["d2~e"], 12)
    (Fraction(95, 1), 1.0)
    >>> found = motion.at([0.0, 0.1])
    >>> bool(abs(found.error[0, 0]) < 1e-12), float(found.error[0, 1].round(3))
    (True, -0.061)
    """

    PAGE = "report.motion_report:motion_document"

    def __init__(
        self,
        train: MotionProblem,
        outputs: Mapping[str, tuple[str, str]],
        tolerance: float | None = None,
        fast: bool | None = None,
    ) -> None:
        self._problem, self.outputs, self.tolerance, self.fast = train, outputs, tolerance, fast
        self._errors = PairErrors(train, tolerance, {link for ends in outputs.values() for link in ends})
        self._index = self._errors.index
        if tolerance is not None and not 0 < tolerance < 1:
            why = "a table's accuracy is a part of a pitch"
            fix = "give a part of a pitch such as 1e-9, or none"
            raise QuestionError(Problem(f"the tolerance is {tolerance!r}", why, fix))
        self._declaration: Any = None  # what `print` needs of the train
        self._state: str | None = None
        self._without: tuple[str, ...] = ()
        self._refuse_loops()

    def _summary(self) -> str:
        name = "" if self._declaration is None else self._declaration.name
        state = "" if self._state is None else f" state {self._state}"
        lead = self._problem.driving_link
        means = [(each, self._problem.seen_ratio(*self.outputs[each])) for each in islice(self.outputs, _MAIN)]
        shown = ", ".join(f"{each} = {brief(ratio)} of {lead}" for each, ratio in means)
        more = f", {len(self.outputs) - _MAIN} more" if len(self.outputs) > _MAIN else ""
        return f"{name}{state}: mean {shown or 'of no output'}{more}".strip()

    # ----------------------------------------------------------------------------------------------- what it is made of

    @property
    def _propagation(self) -> ErrorPropagation:
        """The solved order of the train, as far as its outputs depend on it."""
        return self._errors.spread

    def _path(self, pair: str) -> ErrorPath:
        """Where the sides of a pair or coupling stand, which says how its errors spread.

        Parameters
        ----------
        pair : str
            Its name; one that closes a loop which others close has none: `QuestionError`.
        """
        if pair in self._propagation.pairs:
            return self._propagation.joints[self._propagation.pairs.index(pair)]
        why = "other pairs say already how its wheels turn; which of them bears how much is a matter of play and errors"
        fix = f"leave it out: --without {pair}; or declare one of equal planets, with `copies: 3`"
        raise QuestionError(Problem(f"the motion in time of '{pair}' is not worked out", why, fix))

    @cached_property
    def _forward(self) -> ErrorComposition:
        """The composition while the input turns as declared."""
        return self._compositions.composed(1)

    def _with_sources(self, pairs: Collection[str]) -> ErrorComposition:
        """The composition while the input turns as declared, some pairs that keep their ratio among its sources.

        So that laws which do not keep it can be put in their place.

        Parameters
        ----------
        pairs : collection of str
            Names of pairs; others and those that ripple anyway change nothing.
        """
        return self._compositions.composed(1, pairs)

    @cached_property
    def _unset(self) -> ErrorComposition:
        """The same with every link as its teeth hold it, no pointer set: what the laws themselves say."""
        return replace(self._forward, offsets=())

    @cached_property
    def _backward(self) -> ErrorComposition:
        """The composition while the input turns the other way: the other flanks drive."""
        return self._compositions.composed(-1)

    @cached_property
    def _seen(self) -> tuple[SeenLink, ...]:
        index, signs = self._index, self._problem.signs
        return tuple(
            SeenLink(index[of], index[base], axis_sense(of, base, signs)) for of, base in self.outputs.values()
        )

    @cached_property
    def _compositions(self) -> PointerCompositions:
        return PointerCompositions(self._errors, self._seen)

    @cached_property
    def pointer_offsets(self) -> Mapping[str, float]:
        """By how much each output's pointer is turned on its wheels (rad), so that its teeth do not displace it."""
        found = self._compositions.setting
        return {name: seen.difference(found) for name, seen in zip(self.outputs, self._seen, strict=True)}

    def _refuse_loops(self) -> None:
        for loop, real in self._problem.contradictions():
            path = " - ".join((*loop.links, loop.links[0]))
            raise GearTrainError(
                Problem(
                    f"the pairs {', '.join(loop.pairs)} close a loop, {path}, that real teeth do not let turn",
                    f"the loop holds in the mean, and the errors of {', '.join(real)} would have to cancel at "
                    "every instant",
                    f"leave out one of the loop's pairs: `--without {loop.pairs[-1]}` follows the rest",
                )
            )

    def with_random_phases(self, random: Generator) -> Motion:
        """The same train with a random phase for every pair with real teeth that declares none.

        Parameters
        ----------
        random : numpy.random.Generator
            Phases are drawn from it [pitches, 0 to 1].

        Returns
        -------
        Motion
            Of the same outputs and tolerance.
        """
        declared = self._problem.phases
        # the first pair of a planet places its teeth in the second
        free = [mesh.name for mesh in self._problem.rippling if self._problem.placed_by(mesh.name) is None]
        drawn = {name: float(random.random()) for name in free if name not in declared}
        return Motion(replace(self._problem, phases={**drawn, **declared}), self.outputs, self.tolerance, self.fast)

    # -------------------------------------------------------------------------------------------------- what it answers

    @cached_property
    def period(self) -> Fraction | None:
        """Turns of the input after which every rippling pair stands as at the start; None where nothing ripples."""
        return common_period(self._forward.used)

    @cached_property
    def sensitivity(self) -> Mapping[str, Mapping[str, float]]:
        """Radians of each output per radian of error of the driven side of each pair, real teeth or not."""
        found = {}
        for name, seen in zip(self.outputs, self._seen, strict=True):
            found[name] = dict(zip(self._propagation.pairs, self._propagation.sensitivity(*seen).tolist(), strict=True))
        return found

    def _statistics(self) -> list[RunningStatistics]:
        """An empty tally for each output."""
        return [
            RunningStatistics(name, self._problem.seen_ratio(of, base)) for name, (of, base) in self.outputs.items()
        ]

    @property
    def _start_angles(self) -> list[float]:
        """Starting angle of each output (rad), in the sense of the input as its motion is."""
        angles = self._problem.way * np.array([self._problem.angles.get(link, 0.0) for link in self._propagation.links])
        return [seen.difference(angles) for seen in self._seen]

    def _stretches(self, turns: float, samples: int, first: int = 0) -> Iterator[ErrorSamples]:
        """The run in stretches that fit in memory.

        Parameters
        ----------
        turns : float
            Turns of the input from 0; negative turns go the other way, on the other flanks.
        samples : int
            Positions, 2 or more, both ends included.
        first : int
            The position to begin with.

        Yields
        ------
        ErrorSamples
            One stretch after the other.
        """
        composition = self._sampler(turns, samples)
        chunk = composition.chunk
        for start in range(first, samples, chunk):
            at = np.arange(start, min(start + chunk, samples))
            # divided first: the last position is `turns` to the last bit, wherever stretches begin
            yield composition.at(turns * (at / (samples - 1)))

    def _sampler(self, turns: float, samples: int) -> ErrorSampler:
        """What is asked for errors at some positions.

        Parameters
        ----------
        turns : float
            Turns of the input; only their sign counts.
        samples : int
            How many positions there will be.

        Returns
        -------
        ErrorSampler
            The composition, or its compiled kernel.
        """
        composition = self._forward if turns >= 0 else self._backward
        links = sum(len(step.links) for step in composition.steps)
        if not links or not is_fast(self.fast, samples * links / _PACE):
            return composition
        if (turns >= 0) not in self._compiled:
            from geartrain.dynamics.motion.compiled_composition import compiled_composition

            self._compiled[turns >= 0] = compiled_composition(composition)
        return self._compiled[turns >= 0] or composition

    @cached_property
    def _compiled(self) -> dict[bool, CompiledComposition | None]:
        """Compiled kernels of the compositions forwards (True) and backwards (False), as far as they were requested."""
        return {}

    def at(self, turns: Floats) -> ErrorSamples:
        """Errors and rates of the outputs, turning as declared.

        Parameters
        ----------
        turns : sequence of float, (n,)
            Turns of the input, in any order.

        Returns
        -------
        ErrorSamples
            Errors [rad] and rates at them.
        """
        turns = np.asarray(turns, dtype=float)
        composition = self._sampler(1, len(turns))
        chunk = composition.chunk
        parts = [composition.at(turns[start : start + chunk]) for start in range(0, len(turns), chunk)]
        error, rate = (np.concatenate([part[column] for part in parts], axis=1) for column in (1, 2))
        return ErrorSamples(turns, error, rate, frozenset().union(*(part.reversing_drivers for part in parts)))

    def kink_positions(self, start: float, end: float) -> KinkPositions:
        """Where some pair that an output depends on is at a corner of its law: between them all errors are smooth.

        A speed may jump there. To take its values on either side, ask a little before and a little after.

        Parameters
        ----------
        start, end : float
            Turns of the input; where the end is less than the start it turns back, on the other flanks.

        Returns
        -------
        KinkPositions
            Turns from the lesser to the greater of the two, both included, in ascending order, with the pair at each.

        Raises
        ------
        QuestionError
            If there are more than twenty million.

        Examples
        --------
        A pair of triangular teeth has a corner a pitch, and the driver of the first makes 45 in one turn of the crank:

        >>> import geartrain
        >>> kinks = geartrain.load("moon-triangular").motion(outputs=["moon"]).kink_positions(0, 1)
        >>> len(kinks.turns), kinks.names().count("a~b1")
        (160, 45)
        """
        composition = self._forward if end >= start else self._backward
        return KinkSearch(composition).over(min(start, end), max(start, end))

    def transmission_errors(
        self, turns: float = 1.0, samples: int = 2001, on_done: Callable[[int], None] = lambda _: None
    ) -> dict[str, TransmissionErrorCurve]:
        """Return the transmission error of every output at equal steps of the input.

        Parameters
        ----------
        turns : float
            Turns of the input from 0; negative turns go the other way, on the other flanks.
        samples : int
            Positions, 2 or more, both ends included.
        on_done : callable
            Called with the number of positions of each stretch that is done.

        Returns
        -------
        dict of str to TransmissionErrorCurve
            By output.

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
            angle[part], error[:, part], rate[:, part] = passage[:3]
            done = part.stop
            on_done(len(passage.turns))
        angle *= 2 * pi
        return {
            each.name: TransmissionErrorCurve(each.name, each.ratio, angle, error[at], each.mean + rate[at])
            for at, each in enumerate(self._statistics())
        }

    def transmission_error(self, output: str, turns: float = 1.0, samples: int = 2001) -> TransmissionErrorCurve:
        """Return the transmission error of one output at equal steps of the input.

        Parameters
        ----------
        output : str
            One of the outputs.
        turns, samples : float, int
            As of `transmission_errors`.

        Returns
        -------
        TransmissionErrorCurve
            Its peak-to-peak value, its root mean square, and its value at every position.

        Raises
        ------
        QuestionError
            For an output that is not followed.

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
        """Follow the motion over some turns of the input, and return its peaks and moments by output.

        Parameters
        ----------
        turns, samples : float, int
            As of `transmission_errors`.

        Returns
        -------
        geartrain.dynamics.MotionRun
            `print` shows the report of `geartrain motion`.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("moon-triangular").motion().run(turns=1, samples=2001)
        <MotionRun moon-triangular: 1 turn, transmission error p-p sun 0.02904 deg, moon 5.895 deg>
        """
        run = picture_maker("dynamics.motion.motion_run", "MotionRun")(self, turns, samples)
        run.run()
        return run

    @cached_property
    def _usual_run(self) -> Any:
        """The run of the command; `print` shows it."""
        return self.run()

    def _of(self, outputs: Sequence[str]) -> Motion:
        """The motion of some of the outputs."""
        shown = {name: self.outputs[name] for name in outputs}
        motion = Motion(self._problem, shown, self.tolerance, self.fast)
        motion._declaration, motion._state, motion._without = self._declaration, self._state, self._without
        return motion

    def plot(self, *outputs: str, turns: float = 1.0, samples: int = 2001) -> Any:
        """Angles, errors and speeds over turns of the input, as a figure that notebooks show.

        Parameters
        ----------
        *outputs : str
            Names of those to draw; all where none is given.
        turns : float
            Of the input, from the position where ideal teeth stand as declared [turn].
        samples : int
            Positions, 2 or more, both ends included.

        Returns
        -------
        matplotlib.figure.Figure
            As `geartrain.drawing.outputs_figure` draws it.

        Raises
        ------
        MissingExtraError
            Without matplotlib, which the extra `plot` brings.
        QuestionError
            For an output that is not followed.

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
        return picture_maker("drawing", "outputs_figure")(shown, turns, samples)
