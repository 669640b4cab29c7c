"""What a train does in one state: verdict, speeds, judged outputs."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from geartrain.kinematics.judged_outputs import OutputResult, SpeedValue, speed_data
from geartrain.kinematics.verdict import Verdict
from geartrain.numerics.containers import FrozenFields
from geartrain.numerics.exact import abridged_text, decimal
from geartrain.numerics.long_float import Real, as_plain


@dataclass(frozen=True, slots=True)
class SpeedAccuracy:
    """How far floats are from the truth: the estimate that came with them, and the true error where it was had."""

    estimate: Real
    true_error: Real | None

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; null beyond the range of float64."""
        return {"estimate": as_plain(self.estimate), "true_error": as_plain(self.true_error)}


@dataclass(frozen=True, slots=True)
class Answer(FrozenFields):
    """What a train does in one state.

    place     where the state's inputs were declared
    speeds    link -> speed in the train's unit: exact, or floats (`LongFloat` past 1e308) where `method` says so
    outputs   the declared outputs, judged
    ratios    link -> input -> speed over that input, exact, made when read; empty for floats
    method    "exact" or "floats"
    accuracy  link -> absolute errors of its speed; empty for exact speeds
    work      circuits that were solved
    """

    train: str
    state: str | None
    place: str
    unit: str
    verdict: Verdict
    speeds: Mapping[str, SpeedValue]
    outputs: Mapping[str, OutputResult]
    ratios: Mapping[str, Mapping[str, Fraction]]
    method: str
    accuracy: Mapping[str, SpeedAccuracy]
    work: int

    def __getitem__(self, name: str) -> SpeedValue:
        """The speed of an output, or of a link."""
        result = self.outputs.get(name)
        speed = result.speed if result is not None else self.speeds.get(name)
        if speed is None:
            raise KeyError(f"'{name}' is no determined output or link of '{self.train}'")
        return speed

    @property
    def failures(self) -> tuple[OutputResult, ...]:
        """Outputs whose `expect` or `published` figure does not hold."""
        return tuple(result for result in self.outputs.values() if not result.holds)

    def __bool__(self) -> bool:
        """True if determined and every expectation holds."""
        return bool(self.verdict) and not self.failures

    def to_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the keys are stable (docs/json.md)."""
        speeds = {link: speed_data(speed) for link, speed in self.speeds.items()}
        for link, accuracy in self.accuracy.items():
            speeds[link] |= accuracy.to_dict()
        return {
            "state": self.state,
            "verdict": self.verdict.to_dict(),
            "method": self.method,
            "speeds": speeds,
            "outputs": {name: result.to_dict() for name, result in self.outputs.items()},
        }

    def _repr_html_(self) -> str:
        shown = {name: result.speed for name, result in self.outputs.items()} or self.speeds
        rows = "".join(
            f"<tr><td>{html.escape(name)}</td><td>{_exact(speed)}</td><td>{_decimal(speed)}</td></tr>"
            for name, speed in shown.items()
        )
        head = f"<tr><th>output</th><th>exact</th><th>{html.escape(self.unit) or 'speed'}</th></tr>"
        return f"<p>{html.escape(self.train)}: {html.escape(str(self.verdict))}</p><table>{head}{rows}</table>"


def _decimal(speed: SpeedValue | None) -> str:
    return "" if speed is None else decimal(speed) if isinstance(speed, Fraction) else f"{speed:.10g}"


def _exact(speed: SpeedValue | None) -> str:
    return abridged_text(speed) if isinstance(speed, Fraction) else str(speed)
