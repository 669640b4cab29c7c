"""Result of solving for the speeds in one state: verdict with its certificate, speeds, and evaluated outputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, ClassVar, Literal, TypedDict

from geartrain.kinematics.judged_outputs import OutputResult, SpeedFigures, SpeedValue, speed_figures
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.results import Key, Result, Tabular, TrainResult, brief, finite
from geartrain.train.states import OneWayAction

MOST_NAMES = 12  # names listed in a sentence; the others are counted
_MAIN = 3  # maximum number of links in the summary of an answer


def abridged_names(names: Sequence[str], mark: str = ", ") -> str:
    """Return the names as text, separated by `mark`. If there are more than 13 names, the names after the 12th are
    replaced by the number of these names.

    >>> abridged_names(["a", "b"], " - "), abridged_names("abcdefghijklmnop")
    ('a - b', 'a, b, c, d, e, f, g, h, i, j, k, l and 4 more')
    """
    if len(names) <= MOST_NAMES + 1:
        return mark.join(names)
    return f"{mark.join(names[:MOST_NAMES])} and {len(names) - MOST_NAMES} more"


@dataclass(frozen=True, slots=True)
class Loop(Result):
    """Closed loop of meshing wheels on one carrier, with its ratio product (section 7 of docs/theory.md)."""

    carrier: str
    """Link relative to which the ratios of all pairs of the loop are measured."""
    links: tuple[str, ...]
    """Names of the links, in their order around the loop."""
    pairs: tuple[str, ...]
    """Names of the pairs, in their order around the loop; the last pair closes the loop."""
    product: Fraction
    """Product of the speed ratios around the loop, equation (20). If it is 1, the loop can turn and one of its pairs is
    redundant. If it is not 1, the links of the loop are locked to the carrier.
    """

    def _summary(self) -> str:
        return str(self).removeprefix("loop ")

    @property
    def closes(self) -> bool:
        """True if the product is 1, so that the loop can turn and one of its pairs is redundant."""
        return self.product == 1

    def __str__(self) -> str:
        pairs, product = abridged_names(self.pairs), abridged_text(self.product)
        return f"loop {abridged_names(self.links, ' - ')} (pairs {pairs}; ratio product {product})"


VerdictKind = Literal["determined", "free", "locked", "contradictory", "refused"]


@dataclass(frozen=True, slots=True)
class Verdict(Result):
    """Verdict on whether the inputs determine the motion of a train, from the exact rank of its equations. The
    equations that prove a lock or a contradiction are combined as in equation (22) of docs/theory.md.

    A verdict is a result, not an exception. Its truth value is True if its kind is `determined`.

    Examples
    --------
    >>> import geartrain
    >>> verdict = geartrain.load("planetary-24-18-60").solve().verdict
    >>> print(verdict)
    determined: every speed follows from sun
    """

    kind: VerdictKind
    """Kind of the verdict.

    determined: the inputs determine the speed of every link. free: the speeds of `links` are undetermined. locked: an
    input cannot move because of `loops` or `prescriptions`. contradictory: `prescriptions` contradict each other.
    refused: speeds cannot be calculated in this state, because its locks form a linkage or would stop a rotation.
    """
    text: str
    """Verdict and its cause as a sentence in plain text."""
    links: tuple[str, ...] = ()
    """Links whose speeds are undetermined; all links except the frame if no input turns and no link can move."""
    fixes: tuple[str, ...] = ()
    """Links whose speeds, if prescribed in addition to the inputs, would determine all other speeds; at most 12."""
    prescriptions: tuple[str, ...] = ()
    """Descriptions of the inputs, brakes and locks that cause a lock or a contradiction, such as `sun = 1`."""
    loops: tuple[Loop, ...] = ()
    """Loops with a ratio product other than 1, which lock the train or a part of the train."""

    def _summary(self) -> str:
        return str(self)

    def __bool__(self) -> bool:
        return self.kind == "determined"

    def __str__(self) -> str:
        return f"{self.kind}: {self.text}"


@dataclass(frozen=True, slots=True)
class SpeedAccuracy:
    """Error of a speed that was computed in float64 [unit of the answer]: an estimate, and the true error if the exact
    speed is known.
    """

    estimate: float
    true_error: float | None
    condition: float | None = None
    """Component-wise condition number of the speed [1], equation (25) of docs/theory.md; infinite for a link at rest,
    and None in trains of more than 400 links.
    """


class OptionalKeys(TypedDict, total=False):
    """Part of the JSON output that is written only for float speeds or only for a train with one-way clutches."""

    residual: Mapping[str, float]
    """Relative residual of each row of the Willis system, by row label: magnitude of the residual divided by the sum of
    the magnitudes of the terms of the row [1].
    """
    one_way: Sequence[OneWayAction]
    """Active one-way clutches, each with the information whether it holds or overruns."""
    notes: Sequence[str]
    """Notes on the one-way clutches, such as their behaviour when the output drives the train."""


@dataclass(frozen=True, slots=True)
class Answer(FrozenFields, Tabular, TrainResult):
    """Solution of a train in one state: speeds from the Willis equations (4) and (5) of docs/theory.md.

    The truth value is True if the verdict is as expected (`determined`, unless the train or state declares another kind
    by `expect`) and all outputs agree with their expectations. `answer[name]` is the speed of an output or a link, and
    raises `KeyError` if the speed is not determined.

    Examples
    --------
    A sun with 24 teeth turns in a fixed ring with 60; the carrier's speed is 24 / (24 + 60) of the sun's:

    >>> import geartrain
    >>> answer = geartrain.load("planetary-24-18-60").solve()
    >>> answer["carrier"], answer["planet"], bool(answer)
    (Fraction(2, 7), Fraction(-2, 3), True)
    >>> answer.ratios["carrier"]["sun"]
    Fraction(2, 7)
    """

    TEXT = "report.answers:answer_text"
    PAGE = "report.answers:answer_document"

    MEANINGS: ClassVar = {
        "link": "Link whose speed is determined.",
        "speed": "Speed of the link as a float.",
        "exact": "Speed of the link as a fraction; empty for floats.",
    }

    KEYS = ("state", "verdict", "method", Key("speeds", "speed_figures"), "outputs", Key("", "optional_keys"))

    train: str
    """Name of the train."""
    state: str | None
    """Name of the state; None for a train without states."""
    place: str
    """File and line where the state's inputs are declared; empty if the verdict is `determined` as expected."""
    unit: str
    """Unit of all speeds, such as `turns per tropical year` or `rpm`; empty for numbers without a unit."""
    verdict: Verdict
    """Verdict on the speeds: determined, or the reason why they are not determined."""
    speeds: Mapping[str, SpeedValue]
    """Speed of each link whose speed is determined [`unit`]: a Fraction or a float, depending on `method`."""
    outputs: Mapping[str, OutputResult]
    """Evaluation of each declared output, computed at the first access."""
    ratios: Mapping[str, Mapping[str, Fraction]]
    """Speed of each link divided by the speed of one input when all other inputs are at rest, as
    `ratios[link][input]`. Computed at the first access; empty for float speeds.
    """
    method: str
    """Method of solution: "exact", or "floats" for float64 speeds, which are computed by sparse LU factorisation or by
    rounding exact speeds.
    """
    accuracy: Mapping[str, SpeedAccuracy]
    """Error estimate [`unit`] and condition number of the speed of each link. Computed at the first access; empty for
    exact speeds.
    """
    work: int
    """Number of circuits whose equations were solved."""
    residual: Mapping[str, float] = field(default_factory=dict)
    """Relative residual |b - A w| / (|A| |w|) [1] of each row of `WillisSystem.matrix`, by row label. Computed at the
    first access; empty if the matrix was not used.
    """
    sliding: frozenset[str] = frozenset()
    """Links that slide; their speeds are travels [mm per `unit` of the declaration; mm per turn if no `unit` is
    declared].
    """
    contains_pi: Mapping[str, bool] = field(default_factory=dict)
    """Flag for each link and output: True if its exact speed depends on pi. It is empty if the train has no racks,
    drums or similar couplings. It is computed at the first access, from a second solution with another rational number
    for pi.
    """
    tolerances: Mapping[str, Fraction] = field(default_factory=dict)
    """Tolerance [`unit`] of the speed of each link that depends on a coupling with an approximate `ratio`. It is the
    sum of the changes in speed that result if each of these ratios in turn is changed by its tolerance. Computed at the
    first access.
    """
    expected: str = "determined"
    """Kind of verdict that `expect` of the state or of the train declares; `determined` if none is declared."""
    one_way: tuple[OneWayAction, ...] = ()
    """One-way clutches that are active in the state, each with the information whether it holds or overruns."""
    notes: tuple[str, ...] = ()
    """Notes on the one-way clutches, such as their behaviour when the output drives the train."""
    _output: str | None = field(default=None, kw_only=True, repr=False, compare=False)

    def _summary(self) -> str:
        case = None if self._declaration is None else self._declaration.case(self.state)
        inputs = {} if case is None else {link: self.speeds.get(link) for link in case.inputs}
        turning = [link for link, speed in inputs.items() if speed]
        driver = turning[0] if len(turning) == 1 else None
        shown = [link for link in self._main_links(case) if link in self.speeds]
        figures = []
        for link in shown[:_MAIN]:
            speed = self.speeds[link]
            if driver is None or driver == link or not isinstance(speed, Fraction):
                figures.append(f"{link} = {brief(speed) or speed}")
            else:  # an exact speed is given as a multiple of the speed of the only input that turns
                figures.append(f"{link} = {brief(speed / self.speeds[driver])} of {driver}")
        more = [f"{len(shown) - _MAIN} more"] if len(shown) > _MAIN else []
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.train}{state}: {', '.join([self.verdict.kind, *figures, *more])}"

    def _main_links(self, case: Any) -> Iterable[str]:
        """Return the links that the outputs report; if there are none, all links except inputs and fixed links."""
        if case is None or self._output is not None:
            return self.speeds
        outputs = [output.links(name, self._declaration.frame) for name, output in case.outputs.items()]
        known = {*case.inputs, *case.fixed, self._declaration.frame}
        shown = [of for of, base in outputs if base == self._declaration.frame and of not in known]
        return dict.fromkeys(shown or (link for link in self.speeds if link not in known))

    def __getitem__(self, name: str) -> SpeedValue:
        """Return the speed of an output or a link [`unit`]; raise `KeyError` if it is not determined."""
        result = self.outputs.get(name)
        speed = result.speed if result is not None else self.speeds.get(name)
        if speed is None:
            raise KeyError(f"'{name}' is not a determined output or link of '{self.train}'")
        return speed

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with one row for each determined link: its speed as a float, and as an exact fraction."""
        speeds = self.speeds.values()
        exact = [str(speed) if isinstance(speed, Fraction) else None for speed in speeds]
        return {"link": [*self.speeds], "speed": [float(speed) for speed in speeds], "exact": exact}

    def _meaning(self, column: str) -> str:
        text = self.MEANINGS[column]
        return text if column == "link" else f"{text[:-1]} [{self.unit or 'number without a unit'}]."

    @property
    def failures(self) -> tuple[OutputResult, ...]:
        """Outputs that differ from their `expect` or `published` value, or whose speed is outside the tolerance of a
        target. Undetermined outputs are included only if the verdict is `determined`.
        """
        # if the verdict has failed, undetermined outputs are its consequence and no further failures
        results = (result for result in self.outputs.values() if self.verdict or result.speed is not None)
        return tuple(result for result in results if not result.holds)

    def __bool__(self) -> bool:
        """Return True if the verdict is as expected, `failures` is empty, and no one-way clutch overruns that is
        required to hold.
        """
        return self.as_expected and not self.failures and not any(each.fails for each in self.one_way)

    @property
    def as_expected(self) -> bool:
        """True if the kind of the verdict equals `expected`."""
        return self.verdict.kind == self.expected

    @property
    def speed_figures(self) -> Mapping[str, SpeedFigures]:
        """Speed of each link with its error estimates [`unit`], by link, as written to JSON."""
        found = {link: speed_figures(speed, link in self.sliding) for link, speed in self.speeds.items()}
        for link, accuracy in self.accuracy.items():
            found[link]["estimate"] = accuracy.estimate
            found[link]["true_error"] = accuracy.true_error
            if accuracy.condition is not None:
                found[link]["condition"] = finite(accuracy.condition)
        for link in self.tolerances.keys() & found.keys():
            found[link]["tolerance"] = float(self.tolerances[link])
        return found

    @property
    def optional_keys(self) -> OptionalKeys:
        """Residuals of float speeds, and one-way clutches with their notes, by key of the JSON output."""
        found: OptionalKeys = {"residual": self.residual} if self.residual else {}
        return found | {"one_way": self.one_way, "notes": self.notes} if self.one_way else found
