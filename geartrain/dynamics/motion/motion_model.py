"""Motion of a solved train: pairs with variable errors, driving sides, starting positions, and error propagation.

At turn 0 every tooth and pin has its declared phase, and every pointer is set: section 3 of docs/motion.md. The angles
of drivers are counted from turn 0, so that the errors of earlier pairs do not move the tooth with which a pair starts.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from geartrain.dynamics.motion.compiled_composition import CompiledComposition, compiled_composition, pays
from geartrain.dynamics.motion.error_composition import ErrorComposition, ErrorSamples, SeenLink, common_period
from geartrain.dynamics.motion.kink_positions import KinkPositions, KinkSearch
from geartrain.dynamics.motion.motion_problem import MotionProblem
from geartrain.dynamics.motion.pair_errors import PairErrors
from geartrain.dynamics.motion.run_statistics import RunningStatistics, mean_speed
from geartrain.errors import GearTrainError, Problem, QuestionError, check_choice
from geartrain.kinematics.willis_system import axis_sense
from geartrain.numerics.results import Key, Result, picture_maker

if TYPE_CHECKING:
    from numpy.random import Generator

    from geartrain.dynamics.motion.error_propagation import ErrorPath, ErrorPropagation
    from geartrain.dynamics.motion.run_statistics import ErrorSampler
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True)
class PointerCompositions:
    """Compositions of some outputs of a train, from the errors of its pairs."""

    errors: PairErrors
    outputs: tuple[SeenLink, ...]

    def composed(self, way: int, besides: Collection[str] = ()) -> ErrorComposition:
        """Return the composition for one direction of the input. `besides` is that of `PairErrors.sources`."""
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
        """Angles added to each link at turn 0 by teeth, and by pins [rad].

        They are linear, because all driver angles are known.
        """
        deltas = np.zeros((len(self.errors.spread.pairs), 2))
        pins = {joint.coupling.name for joint in self.errors.train.pins}
        for each in self.errors.sources(1):
            deltas[each.pair, int(each.id in pins)] = each.sense * float(each.transmission.error(each.phase))
        teeth, slots = self.errors.spread.errors(deltas).T
        return teeth, slots

    @property
    def setting(self) -> Floats:
        """Angle by which each link is turned on its wheels so that its teeth do not displace it at turn 0 [rad]."""
        return -self._start[0]


@dataclass(frozen=True)
class TransmissionErrorCurve(Result):
    """Transmission error of one output, position by position.

    With a pin and slot it includes the intended deviation from uniform motion (anomaly).

    See Also
    --------
    Motion.ripples : Method that returns these.
    """

    KEYS = (Key("", "tally"),)

    name: str
    """Name of the output."""
    ratio: Fraction
    """Exact mean speed over the input speed."""
    error: Floats
    """Angle less its mean motion [rad]. Shape (n,)."""
    speed: Floats
    """Speed over the input speed. Shape (n,)."""

    @property
    def mean(self) -> float:
        """Mean speed over the input speed."""
        return mean_speed(self.name, self.ratio)

    @cached_property
    def tally(self) -> RunningStatistics:
        """Peaks and moments."""
        tally = RunningStatistics(self.name, self.ratio)
        tally.add(self.error, self.speed - self.mean)
        return tally

    @property
    def peak_to_peak(self) -> float:
        """Peak-to-peak error [rad]."""
        return self.tally.peak_to_peak

    @property
    def rms(self) -> float:
        """Root mean square of the error about its mean [rad]."""
        return self.tally.rms


class Motion:
    """Motion of a train with real teeth and pins, as a function of the turns of its input.

    Transmission functions are composed along the order of solution of the train: equations (2) and (3) of
    docs/motion.md. At turn 0 every tooth and pin has its declared `phase`, and every link the position that ideal teeth
    would give it (section 3 there).

    Parameters
    ----------
    train : MotionProblem
        Equations, mean speeds, transmission functions and drivers, as collected by `GearTrain.motion`.
    outputs : mapping of str to tuple of str
        Link and reference link of each output, by name.
    tolerance : float, optional
        Accuracy of tables that replace the transmission functions [pitches, between 0 and 1]. By default they are
        evaluated directly.
    fast : bool, optional
        Use compiled kernels, which agree to 1e-12. By default they are used if numba is installed and there are enough
        positions to repay loading it.

    Raises
    ------
    MissingExtraError
        If kernels are requested and numba is not installed; raised when positions are first requested.
    QuestionError
        If the tolerance is not between 0 and 1.
    GearTrainError
        If the real teeth of a redundant loop cannot turn together, or the train has no order of solution.

    Examples
    --------
    The four pairs of triangular teeth before the Moon repeat their positions after 95 turns of the crank:

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
            why = "the accuracy of tables is a fraction of a pitch, between 0 and 1"
            fix = "give a fraction such as 1e-9, or omit it"
            raise QuestionError(Problem(f"the tolerance is {tolerance!r}", why, fix))
        self._refuse_loops()

    # ----------------------------------------------------------------------------------------------- compositions

    @property
    def spread(self) -> ErrorPropagation:
        """Error propagation of the train, as far as its outputs depend on it."""
        return self._errors.spread

    def path(self, pair: str) -> ErrorPath:
        """Return the links of a pair or coupling, which determine how its errors propagate.

        Parameters
        ----------
        pair : str
            Name of the pair.

        Raises
        ------
        QuestionError
            If the pair only closes a loop of other pairs, which has no unique path.
        """
        if pair in self.spread.pairs:
            return self.spread.joints[self.spread.pairs.index(pair)]
        why = (
            "other pairs already determine the motion of its wheels, and backlash and errors decide how they share the "
            "load"
        )
        fix = f"leave it out with --without {pair}, or declare one of several equal planets, with `copies: 3`"
        raise QuestionError(Problem(f"the dynamics of the redundant pair '{pair}' cannot be simulated", why, fix))

    @cached_property
    def ahead(self) -> ErrorComposition:
        """Composition while the input turns as declared."""
        return self._compositions.composed(1)

    def with_sources(self, pairs: Collection[str]) -> ErrorComposition:
        """Return the composition while the input turns as declared, with more pairs among its sources.

        Pairs of constant ratio can thus be given other transmission functions.

        Parameters
        ----------
        pairs : collection of str
            Names of pairs to include; pairs with variable errors are included anyway.
        """
        return self._compositions.composed(1, pairs)

    @cached_property
    def hung(self) -> ErrorComposition:
        """Composition without set pointers: every link at the position given by its transmission functions."""
        return replace(self.ahead, offsets=())

    @cached_property
    def back(self) -> ErrorComposition:
        """Composition while the input turns the other way, with the other flanks driving."""
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
        """Angle by which each output's pointer is turned on its wheels so that its teeth do not displace it [rad]."""
        found = self._compositions.setting
        return {name: seen.difference(found) for name, seen in zip(self.outputs, self._seen, strict=True)}

    def _refuse_loops(self) -> None:
        for loop, real in self.train.contradictions():
            path = " - ".join((*loop.links, loop.links[0]))
            raise GearTrainError(
                Problem(
                    f"the pairs {', '.join(loop.pairs)} close a loop, {path}, that locks with real teeth",
                    f"its mean speeds agree, but the errors of {', '.join(real)} would have to cancel at every instant",
                    f"leave out one of the loop's pairs, such as `--without {loop.pairs[-1]}`",
                )
            )

    def at_random(self, random: Generator) -> Motion:
        """Return the train with a random phase for every pair with real teeth that declares none.

        Parameters
        ----------
        random : numpy.random.Generator
            Source of the phases [pitches, 0 to 1].

        Returns
        -------
        Motion
            Motion with the same outputs and tolerance.
        """
        declared = self.train.phases
        # the phase of a planet's second pair follows from its first pair
        free = [mesh.name for mesh in self.train.rippling if self.train.placed_by(mesh.name) is None]
        drawn = {name: float(random.random()) for name in free if name not in declared}
        return Motion(replace(self.train, phases={**drawn, **declared}), self.outputs, self.tolerance, self.fast)

    # -------------------------------------------------------------------------------------------------- results

    @cached_property
    def period(self) -> Fraction | None:
        """Turns of the input after which every pair repeats its position; None if every error is constant."""
        return common_period(self.ahead.used)

    @cached_property
    def sensitivity(self) -> Mapping[str, Mapping[str, float]]:
        """Sensitivity of each output to the error of the driven side of each pair, real teeth or not [rad per rad]."""
        found = {}
        for name, seen in zip(self.outputs, self._seen, strict=True):
            found[name] = dict(zip(self.spread.pairs, self.spread.sensitivity(*seen).tolist(), strict=True))
        return found

    def tallies(self) -> list[RunningStatistics]:
        """Return empty statistics for each output."""
        return [RunningStatistics(name, self.train.seen_ratio(of, base)) for name, (of, base) in self.outputs.items()]

    @property
    def starts(self) -> list[float]:
        """Starting angle of each output [rad], in the sense of the input's motion."""
        angles = self.train.way * np.array([self.train.angles.get(link, 0.0) for link in self.spread.links])
        return [seen.difference(angles) for seen in self._seen]

    def passages(self, turns: float, samples: int, first: int = 0) -> Iterator[ErrorSamples]:
        """Yield the run in stretches that fit in memory.

        Parameters
        ----------
        turns : float
            Turns of the input from 0. Negative turns are in the other direction, with the other flanks driving.
        samples : int
            Number of positions including both ends, 2 or more.
        first : int
            Index of the first position.

        Yields
        ------
        ErrorSamples
            Errors of consecutive stretches.
        """
        composition = self.sampler(turns, samples)
        chunk = composition.chunk
        for start in range(first, samples, chunk):
            at = np.arange(start, min(start + chunk, samples))
            # division first: the last position is exactly `turns`, wherever stretches begin
            yield composition.at(turns * (at / (samples - 1)))

    def sampler(self, turns: float, samples: int) -> ErrorSampler:
        """Return the object that computes errors for a run.

        Parameters
        ----------
        turns : float
            Turns of the input; only their sign matters.
        samples : int
            Number of positions of the run.

        Returns
        -------
        ErrorSampler
            Composition, or its compiled kernel.
        """
        composition = self.ahead if turns >= 0 else self.back
        if not pays(composition, self.fast, samples):
            return composition
        return (self._compiled_ahead if turns >= 0 else self._compiled_back) or composition

    @cached_property
    def _compiled_ahead(self) -> CompiledComposition | None:
        return compiled_composition(self.ahead)

    @cached_property
    def _compiled_back(self) -> CompiledComposition | None:
        return compiled_composition(self.back)

    def at(self, turns: Floats) -> ErrorSamples:
        """Return errors and rates of the outputs while the input turns as declared.

        Parameters
        ----------
        turns : sequence of float, (n,)
            Turns of the input, in any order.

        Returns
        -------
        ErrorSamples
            Errors [rad] and rates at these turns.
        """
        turns = np.asarray(turns, dtype=float)
        composition = self.sampler(1, len(turns))
        chunk = composition.chunk
        parts = [composition.at(turns[start : start + chunk]) for start in range(0, len(turns), chunk)]
        error, rate = (np.concatenate([part[column] for part in parts], axis=1) for column in (1, 2))
        return ErrorSamples(turns, error, rate, frozenset().union(*(part.reversing_drivers for part in parts)))

    def kink_positions(self, start: float, end: float) -> KinkPositions:
        """Return the positions at which some pair has a kink. All errors are smooth between them.

        Only pairs that an output depends on are included.

        A speed may jump at a kink. For its one-sided values, evaluate a little before and a little after.

        Parameters
        ----------
        start, end : float
            Turns of the input. If the end is less than the start it turns back, with the other flanks driving.

        Returns
        -------
        KinkPositions
            Turns in ascending order between the two, ends included, with the pair at each.

        Raises
        ------
        QuestionError
            If there are more than twenty million.

        Examples -------- A pair of triangular teeth has one kink per pitch, and the driver of the first passes 45 in
        one turn of the crank:

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
        """Return the transmission error of every output at equal steps of the input.

        Parameters
        ----------
        turns, samples : float, int
            Turns and number of positions, as in `passages`.
        on_done : callable
            Callback, called with the number of positions of each stretch that is done.

        Returns
        -------
        angle : array of float, (samples,)
            Angle of the input [rad].
        curves : dict of str to TransmissionErrorCurve
            Curves by output.
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
        """Return a figure of angles, errors and speeds over turns of the input, for notebooks.

        Parameters
        ----------
        *outputs : str
            Names of the outputs to draw, by default all.
        turns : float
            Turns of the input, from the position where ideal teeth are as declared.
        samples : int
            Number of positions including both ends, 2 or more.

        Returns
        -------
        matplotlib.figure.Figure
            Figure drawn by `geartrain.drawing.outputs_figure`.

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
        shown = {name: self.outputs[name] for name in outputs or self.outputs}
        motion = Motion(self.train, shown, self.tolerance, self.fast)
        return picture_maker("drawing", "outputs_figure")(motion, turns, samples)
