"""`geartrain solve`: speeds, of everything or of one output."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, VERDICT, File, Force, Json, Out, StateName, as_json, emit, sink

if TYPE_CHECKING:
    from geartrain.kinematics.answer import Answer

OutputName = Annotated[str | None, typer.Option("--output", help="An output or a link: only what drives it is solved.")]


def run(
    file: File,
    output: OutputName = None,
    state: StateName = None,
    json: Json = False,
    out: Out = None,
    method: Annotated[str, typer.Option("--method", help="auto, exact or floats.")] = "auto",
    force: Force = False,
) -> None:
    """Solve a train and print its speeds as fractions and decimals."""
    from geartrain.analysis.loader import load

    if method not in ("auto", "exact", "floats"):
        raise typer.BadParameter(f"'{method}' is not a method; use auto, exact or floats", param_hint="--method")
    to = sink(out, force)
    train = load(file)
    states = [state] if state is not None or not train.states else list(train.states)
    answers = [train.solve(name, output, method) for name in states]  # type: ignore[arg-type]
    if json or to.suffix == ".json":
        from geartrain.report.train_data import collect_answers

        emit(as_json(collect_answers(train, answers, whole=output is None)), to)
    else:
        emit("\n".join(_text(answer, output, train.bookkeeping) for answer in answers), to)
    raise typer.Exit(GOOD if all(answers) else VERDICT)


def _text(answer: Answer, output: str | None, oblique: frozenset[str]) -> str:
    from geartrain.report.document import exact, figure

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
    return "\n".join(lines)


def _marks(answer: Answer, link: str, oblique: frozenset[str]) -> str:
    return _errors(answer, link) + ("  (sum of joint speeds)" if link in oblique else "")


def _errors(answer: Answer, link: str) -> str:
    """Estimate and true error of a float, where there is one."""
    accuracy = answer.accuracy.get(link)
    if accuracy is None:
        return ""
    true = "" if accuracy.true_error is None else f", true error {accuracy.true_error:.1e}"
    return f"  estimate {accuracy.estimate:.1e}{true}"
