"""What a train does in one state: the verdict with its certificate, speeds, judged outputs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, ClassVar, Literal, TypedDict

from geartrain.kinematics.judged_outputs import OutputResult, SpeedFigures, SpeedValue, speed_figures
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.long_float import Real, as_plain
from geartrain.numerics.results import Key, Result, Tabular, TrainResult, brief, finite

MOST_NAMES = 12
_MAIN = 3  # links in the line of an answer


def abridged_names(names: Sequence[str], mark: str = ", ") -> str:
    """The first names, and how many more there are.

    >>> abridged_names(["a", "b"], " - "), abridged_names("abcdefghijklmnop")
    ('a - b', 'a, b, c, d, e, f, g, h, i, j, k, l and 4 more')
    """
    if len(names) <= MOST_NAMES + 1:
        return mark.join(names)
    return f"{mark.join(names[:MOST_NAMES])} and {len(names) - MOST_NAMES} more"


@dataclass(frozen=True, slots=True)
class Loop(Result):
    """A closed loop of meshing wheels in one carrier's frame, with the product of its ratios (docs/theory.md, 7).

    Examples
    --------
    >>> import geartrain
    >>> loop = geartrain.load("four-gear-loop").mobility.loops[0]
    >>> loop.links, loop.product, loop.closes
    (('a', 'b', 'c', 'd'), Fraction(1, 1), True)
    """

    carrier: str
    """The link from which all pairs of the loop are seen."""
    links: tuple[str, ...]
    """Links in order."""
    pairs: tuple[str, ...]
    """Ids of the pairs in order; the last one closes the loop."""
    product: Fraction
    """Speed with which a walk round the loop comes back, as a multiple of that with which it left, equation (20): 1
    closes, and one mesh is redundant; anything else locks the loop to its carrier."""

    def _summary(self) -> str:
        return str(self).removeprefix("loop ")

    @property
    def closes(self) -> bool:
        """True if the loop turns; its last mesh is then redundant."""
        return self.product == 1

    def __str__(self) -> str:
        pairs, product = abridged_names(self.pairs), abridged_text(self.product)
        return f"loop {abridged_names(self.links, ' - ')} (pairs {pairs}; ratio product {product})"


VerdictKind = Literal["determined", "free", "locked", "contradictory", "refused"]


@dataclass(frozen=True, slots=True)
class Verdict(Result):
    """What a train does with its inputs, decided by exact rank; equation (22) of docs/theory.md is its certificate.

    A verdict is an answer, never an exception. It is true if it is `determined`.

    Examples
    --------
    >>> import geartrain
    >>> verdict = geartrain.load("planetary-24-18-60").solve().verdict
    >>> print(verdict)
    determined: every speed follows from sun
    """

    kind: VerdictKind
    """Determined: every link's speed follows from the inputs. free: `links` are undetermined. locked: the input
    cannot move, for `loops` or `prescriptions` hold it. contradictory: `prescriptions` cannot hold at once. refused:
    no speed can be calculated in one of several states, for its locks make a linkage, or it drives no rotation."""
    text: str
    """The verdict in a sentence, with what it follows from."""
    links: tuple[str, ...] = ()
    """Links whose speed is not determined."""
    fixes: tuple[str, ...] = ()
    """Links which, prescribed too, would determine all."""
    prescriptions: tuple[str, ...] = ()
    """Inputs, brakes and clutches that take part in a lock or contradiction."""
    loops: tuple[Loop, ...] = ()
    """Loops that do not close and hold the train, or a part of it."""

    def _summary(self) -> str:
        return str(self)

    def __bool__(self) -> bool:
        return self.kind == "determined"

    def __str__(self) -> str:
        return f"{self.kind}: {self.text}"


@dataclass(frozen=True, slots=True)
class SpeedAccuracy:
    """How far floats are from the truth: the estimate that came with them, and the true error where it was had."""

    estimate: Real
    true_error: Real | None
    condition: float | None = None
    """Component-wise, (25) of docs/theory.md, infinite of a link at rest; None where it was not asked for."""


class RowResiduals(TypedDict, total=False):
    """What JSON has of floats only: by row of the Willis system, the part of its terms that it is off."""

    residual: Mapping[str, float]
    """Residual of each row of the Willis system over the sum of the sizes of its terms, by label."""


@dataclass(frozen=True, slots=True)
class Answer(FrozenFields, Tabular, TrainResult):
    """What a train does in one state: the solution of its Willis system, equations (4) and (5) of docs/theory.md.

    True if the verdict is as expected (`determined` unless the state's `expect` says otherwise), and so are all
    outputs. `answer[name]` is the speed of an output or a link; `KeyError` where it is not determined.

    Examples
    --------
    A sun of 24 teeth turns in a fixed ring of 60, and the carrier makes 24 / (24 + 60) of its turns:

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

    KEYS = ("state", "verdict", "method", Key("speeds", "speed_figures"), "outputs", Key("", "row_residuals"))

    train: str
    """Name of the train."""
    state: str | None
    """The state; None for a train without states."""
    place: str
    """Where the state's inputs were declared; empty where the verdict is `determined`, as expected."""
    unit: str
    """Unit of all speeds, such as `turns per tropical year` or `rpm`; empty for plain numbers."""
    verdict: Verdict
    """Whether the speeds follow from the inputs."""
    speeds: Mapping[str, SpeedValue]
    """Speed of each determined link [`unit`]: exact, or floats (`LongFloat` past 1e308) where `method` says so."""
    outputs: Mapping[str, OutputResult]
    """The declared outputs, judged when they are first read."""
    ratios: Mapping[str, Mapping[str, Fraction]]
    """Link -> input -> speed over that input, the others at rest; made when read, empty for floats."""
    method: str
    """How the speeds were found; floats by the sparse LU of the Willis system's matrix, or as exact ones rounded."""
    accuracy: Mapping[str, SpeedAccuracy]
    """Absolute error of each link's speed [`unit`] and its condition number; made when read, empty for exact speeds."""
    work: int
    """Circuits that were solved."""
    residual: Mapping[str, float] = field(default_factory=dict)
    """By row of `WillisSystem.matrix`, |b - A w| over |A| |w| [1]; made when read, empty for speeds not found by it."""
    expected: str = "determined"
    """The verdict that the state's `expect` names."""
    _output: str | None = field(default=None, kw_only=True, repr=False, compare=False)

    def _summary(self) -> str:
        case = None if self._declaration is None else self._declaration.case(self.state)
        inputs = {} if case is None else {link: self.speeds.get(link) for link in case.inputs}
        turning = [link for link, speed in inputs.items() if speed]
        shown = [link for link in self._main_links(case) if link in self.speeds]
        figures = [f"{link} = {self._figure(link, turning, inputs)}" for link in shown[:_MAIN]]
        more = [f"{len(shown) - _MAIN} more"] if len(shown) > _MAIN else []
        state = "" if self.state is None else f" state {self.state}"
        return f"{self.train}{state}: {', '.join([self.verdict.kind, *figures, *more])}"

    def _main_links(self, case: Any) -> Iterable[str]:
        """The links of the requested or declared outputs, else all that no input drives."""
        if case is None or self._output is not None:
            return self.speeds
        outputs = [output.links(name, self._declaration.frame) for name, output in case.outputs.items()]
        known = {*case.inputs, *case.fixed, self._declaration.frame}
        shown = [of for of, base in outputs if base == self._declaration.frame and of not in known]
        return dict.fromkeys(shown or (link for link in self.speeds if link not in known))

    def _figure(self, link: str, turning: Sequence[str], inputs: Mapping[str, SpeedValue | None]) -> str:
        """A speed; of a train with one input that turns, over the speed of the input."""
        speed = self.speeds[link]
        own = inputs.get(turning[0]) if len(turning) == 1 else None
        if own is None or not isinstance(speed, Fraction) or not isinstance(own, Fraction) or link == turning[0]:
            return brief(speed) or str(speed)
        return f"{brief(speed / own)} of {turning[0]}"

    def __getitem__(self, name: str) -> SpeedValue:
        """The speed of an output, or of a link."""
        result = self.outputs.get(name)
        speed = result.speed if result is not None else self.speeds.get(name)
        if speed is None:
            raise KeyError(f"'{name}' is no determined output or link of '{self.train}'")
        return speed

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for each determined link: its speed as a float, and exactly."""
        speeds = self.speeds.values()
        exact = [str(speed) if isinstance(speed, Fraction) else None for speed in speeds]
        return {"link": [*self.speeds], "speed": [float(speed) for speed in speeds], "exact": exact}

    def _meaning(self, column: str) -> str:
        text = self.MEANINGS[column]
        return text if column == "link" else f"{text[:-1]} [{self.unit or 'plain number'}]."

    @property
    def failures(self) -> tuple[OutputResult, ...]:
        """Outputs that miss their `expect`, their `published` figure or the tolerance of a target."""
        results = (result for result in self.outputs.values() if self.verdict or result.speed is not None)
        return tuple(result for result in results if not result.holds)

    def __bool__(self) -> bool:
        """True if the verdict is as expected, and so are all outputs that are determined."""
        return self.as_expected and not self.failures

    @property
    def as_expected(self) -> bool:
        """Whether the verdict is the one that the state's `expect` names, by default `determined`."""
        return self.verdict.kind == self.expected

    @property
    def speed_figures(self) -> Mapping[str, SpeedFigures]:
        """The speeds, and how far floats are off, as JSON has them."""
        found = {link: speed_figures(speed) for link, speed in self.speeds.items()}
        for link, accuracy in self.accuracy.items():
            found[link]["estimate"] = as_plain(accuracy.estimate)
            found[link]["true_error"] = as_plain(accuracy.true_error)
            if accuracy.condition is not None:
                found[link]["condition"] = finite(accuracy.condition)
        return found

    @property
    def row_residuals(self) -> RowResiduals:
        """The residuals, as JSON has them; nothing where there are none."""
        return {"residual": self.residual} if self.residual else {}
