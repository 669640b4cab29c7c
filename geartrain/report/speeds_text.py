"""Speeds of one state as plain lines, exact and in decimals: what `geartrain solve` prints."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from geartrain.report.document import exact, figure

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Answer


def speeds_text(answer: Answer, output: str | None, oblique: frozenset[str]) -> str:
    """The speeds of one state, or that of one output, a line each; `oblique` links have sums of joint speeds."""
    state = f" state {answer.state}" if answer.state is not None else ""
    place = "" if answer.verdict else f" ({answer.place})"
    unit = f" ({answer.unit})" if answer.unit and answer.verdict else ""
    lines = [f"{answer.train}{state}: {answer.verdict}{place}{unit}"]
    rows = [
        (name, result.speed, _errors(answer, result.of) + ("" if result.holds else "  FAILS"))
        for name, result in answer.outputs.items()
    ]
    if output is None:
        links = [(link, speed, _marks(answer, link, oblique)) for link, speed in answer.speeds.items()]
        rows = links + [row for row in rows if row[0] not in answer.speeds or "FAILS" in row[2]]
    elif not rows:
        rows = [(output, answer.speeds.get(output), _marks(answer, output, oblique))]
    width = max((len(name) for name, _, _ in rows), default=0)
    for name, speed, mark in rows:
        lines.append(f"  {name:<{width}}  {exact(speed):>20}  {figure(speed, 12)}{mark}")
    if answer.residual:
        row, most = max(answer.residual.items(), key=lambda each: each[1])
        if any(each.true_error is None for each in answer.accuracy.values()):
            lines.append(f"  {why_floats(answer)}")
        lines.append(f"  residual: at most {most:.1e} of the terms of a row" + (f", in {row}" if most else ""))
    return "\n".join(lines)


def why_floats(answer: Answer) -> str:
    """Why a coupled system was solved in floats, how large their errors are, and how to get fractions."""
    error = max((each.estimate for each in answer.accuracy.values()), default=0.0)
    why = "the system is coupled too densely for exact elimination within about a second"
    return (
        f"Solved in floats: {why}. The estimated error of every speed is at most {error:.1e}. "
        "`geartrain solve FILE --method exact` solves it in fractions, however long it takes."
    )


def _marks(answer: Answer, link: str, oblique: frozenset[str]) -> str:
    return _errors(answer, link) + ("  (sum of joint speeds)" if link in oblique else "")


def _errors(answer: Answer, link: str) -> str:
    """Condition, estimate and true error of a float, where there is one."""
    accuracy = answer.accuracy.get(link)
    if accuracy is None:
        return ""
    true = "" if accuracy.true_error is None else f", true error {accuracy.true_error:.1e}"
    known = accuracy.condition is not None and isfinite(accuracy.condition)  # it is infinite of a link at rest
    condition = f"condition {accuracy.condition:.3g}, " if known else ""
    return f"  {condition}estimate {accuracy.estimate:.1e}{true}"
