"""From a solved train to its motion: which pairs ripple, who drives, where they start, and how their errors spread.

At turn 0 every tooth and pin is where its phase says, and every pointer is set: section 3 of docs/motion.md. The angles
of drivers are counted from turn 0, so that the errors of the pairs before a pair do not move the tooth with which it
starts.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import pi
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
from geartrain.numerics.results import Key, Result, picture_maker

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
class TransmissionErrorCurve(Result):
    """The transmission error of one output, position by position.

    See Also
    --------
    Motion.ripples : what gives these.
    """

    KEYS = (Key("", "tally"),)

    name: str
    """The output."""
    ratio: Fraction
    """Exact mean speed over the input's."""
    error: Floats
    """Angle less its mean motion [rad]. Shape (n,)."""
    speed: Floats
    """Speed over the input's. Shape (n,)."""

    @property
    def mean(self) -> float:
        """Mean speed over the input's."""
        return mean_speed(self.name, self.ratio)

    @cached_property
    def tally(self) -> RunningStatistics:
        """Peaks and moments."""
        tally = RunningStatistics(self.name, self.ratio)
        tally.add(self.error, self.speed - self.mean)
        return tally

    @property
    def peak_to_peak(self) -> float:
        """Greatest less least error (rad)."""
        return self.tally.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean (rad)."""
        return self.tally.rms


class Motion:
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

    def __init__(
        self,
        train: MotionProblem,
        outputs: Mapping[str, tuple[str, str]],
        tolerance: float | None = None,
        fast: bool | None = None,
    ) -> None:
        self.train, self.outputs, self.tolerance, self.fast = train, outputs, tolerance, fast
        self._errors = PairErrors(train, tolerance, {link for ends in outputs.values() for link in ends})
        self._index = self._errors.index
        if tolerance is not None and not 0 < tolerance < 1:
            why = "a table's accuracy is a part of a pitch"
            fix = "give a part of a pitch such as 1e-9, or none"
            raise QuestionError(Problem(f"the tolerance is {tolerance!r}", why, fix))
        self._refuse_loops()

    # ----------------------------------------------------------------------------------------------- what it is made of

    @property
    def spread(self) -> ErrorPropagation:
        """The solved order of the train, as far as its outputs depend on it."""
        return self._errors.spread

    def path(self, pair: str) -> ErrorPath:
        """Where the sides of a pair or coupling stand, which says how its errors spread.

        Parameters
        ----------
        pair : str
            Its name; one that closes a loop which others close has none: `QuestionError`.
        """
        if pair in self.spread.pairs:
            return self.spread.joints[self.spread.pairs.index(pair)]
        why = "other pairs say already how its wheels turn; which of them bears how much is a matter of play and errors"
        fix = f"leave it out: --without {pair}; or declare one of equal planets, with `copies: 3`"
        raise QuestionError(Problem(f"the motion in time of '{pair}' is not worked out", why, fix))

    @cached_property
    def ahead(self) -> ErrorComposition:
        """The composition while the input turns as declared."""
        return self._compositions.composed(1)

    def with_sources(self, pairs: Collection[str]) -> ErrorComposition:
        """The composition while the input turns as declared, some pairs that keep their ratio among its sources.

        So that laws which do not keep it can be put in their place.

        Parameters
        ----------
        pairs : collection of str
            Names of pairs; others and those that ripple anyway change nothing.
        """
        return self._compositions.composed(1, pairs)

    @cached_property
    def hung(self) -> ErrorComposition:
        """The same with every link as its teeth hold it, no pointer set: what the laws themselves say."""
        return replace(self.ahead, offsets=())

    @cached_property
    def back(self) -> ErrorComposition:
        """The composition while the input turns the other way: the other flanks drive."""
        return self._compositions.composed(-1)

    @cached_property
    def _seen(self) -> tuple[SeenLink, ...]:
        index, signs = self._index, self.train.signs
        return tuple(
            SeenLink(index[of], index[base], axis_sense(of, base, signs)) for of, base in self.outputs.values()
        )

    @cached_property
    def _compositions(self) -> PointerCompositions:
        return PointerCompositions(self._errors, self._seen)

    @cached_property
    def setting(self) -> Mapping[str, float]:
        """By how much each output's pointer is turned on its wheels (rad), so that its teeth do not displace it."""
        found = self._compositions.setting
        return {name: seen.difference(found) for name, seen in zip(self.outputs, self._seen, strict=True)}

    def _refuse_loops(self) -> None:
        for loop, real in self.train.contradictions():
            path = " - ".join((*loop.links, loop.links[0]))
            raise GearTrainError(
                Problem(
                    f"the pairs {', '.join(loop.pairs)} close a loop, {path}, that real teeth do not let turn",
                    f"the loop holds in the mean, and the errors of {', '.join(real)} would have to cancel at "
                    "every instant",
                    f"leave out one of the loop's pairs: `--without {loop.pairs[-1]}` follows the rest",
                )
            )

    def at_random(self, random: Generator) -> Motion:
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
        declared = self.train.phases
        # the first pair of a planet places its teeth in the second
        free = [mesh.name for mesh in self.train.rippling if self.train.placed_by(mesh.name) is None]
        drawn = {name: float(random.random()) for name in free if name not in declared}
        return Motion(replace(self.train, phases={**drawn, **declared}), self.outputs, self.tolerance, self.fast)

    # -------------------------------------------------------------------------------------------------- what it answers

    @cached_property
    def period(self) -> Fraction | None:
        """Turns of the input after which every rippling pair stands as at the start; None where nothing ripples."""
        return common_period(self.ahead.used)

    @cached_property
    def sensitivity(self) -> Mapping[str, Mapping[str, float]]:
        """Radians of each output per radian of error of the driven side of each pair, real teeth or not."""
        found = {}
        for name, seen in zip(self.outputs, self._seen, strict=True):
            found[name] = dict(zip(self.spread.pairs, self.spread.sensitivity(*seen).tolist(), strict=True))
        return found

    def tallies(self) -> list[RunningStatistics]:
        """An empty tally for each output."""
        return [RunningStatistics(name, self.train.seen_ratio(of, base)) for name, (of, base) in self.outputs.items()]

    @property
    def starts(self) -> list[float]:
        """Starting angle of each output (rad), in the sense of the input as its motion is."""
        angles = self.train.way * np.array([self.train.angles.get(link, 0.0) for link in self.spread.links])
        return [seen.difference(angles) for seen in self._seen]

    def passages(self, turns: float, samples: int, first: int = 0) -> Iterator[ErrorSamples]:
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
        composition = self.sampler(turns, samples)
        chunk = composition.chunk
        for start in range(first, samples, chunk):
            at = np.arange(start, min(start + chunk, samples))
            # divided first: the last position is `turns` to the last bit, wherever stretches begin
            yield composition.at(turns * (at / (samples - 1)))

    def sampler(self, turns: float, samples: int) -> ErrorSampler:
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
        composition = self.ahead if turns >= 0 else self.back
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
        composition = self.sampler(1, len(turns))
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
        composition = self.ahead if end >= start else self.back
        return KinkSearch(composition).over(min(start, end), max(start, end))

    def ripples(
        self, turns: float, samples: int, on_done: Callable[[int], None] = lambda _: None
    ) -> tuple[Floats, dict[str, TransmissionErrorCurve]]:
        """The error of every output at equal steps of the input.

        Parameters
        ----------
        turns, samples : float, int
            As in `passages`.
        on_done : callable
            Called with the number of positions of each stretch that is done.

        Returns
        -------
        angle : array of float, (samples,)
            Angle of the input [rad].
        curves : dict of str to TransmissionErrorCurve
            By output.
        """
        error = np.empty((len(self.outputs), samples))
        rate = np.empty_like(error)
        angle = np.empty(samples)
        done = 0
        for passage in self.passages(turns, samples):
            part = slice(done, done + len(passage.turns))
            angle[part], error[:, part], rate[:, part] = passage[:3]
            done = part.stop
            on_done(len(passage.turns))
        angle *= 2 * pi
        found = {
            tally.name: TransmissionErrorCurve(tally.name, tally.ratio, error[at], tally.mean + rate[at])
            for at, tally in enumerate(self.tallies())
        }
        return angle, found

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
        shown = {name: self.outputs[name] for name in outputs or self.outputs}
        motion = Motion(self.train, shown, self.tolerance, self.fast)
        return picture_maker("drawing", "outputs_figure")(motion, turns, samples)
