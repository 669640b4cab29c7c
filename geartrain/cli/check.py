"""`geartrain check`: validate declarations and verify every expectation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from geartrain.cli.common import GOOD, NOT_USABLE, VERDICT, Files, complain, emit, plural
from geartrain.errors import GearTrainError

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.kinematics.judged_outputs import OutputResult


def run(
    files: Files,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing of trains that are sound.")] = False,
) -> None:
    """Validate trains and verify every `expect` and `published` figure; the worst finding is the exit code."""
    worst = GOOD
    for file in files:
        worst = max(worst, _check(file, quiet))
    raise typer.Exit(worst)


def _check(file: str, quiet: bool) -> int:
    from geartrain.analysis.loader import load
    from geartrain.report.answers import expectations_met
    from geartrain.report.document import exact

    try:
        train = load(file)
        answers = list(train.answers())
        faults = train.faults
    except GearTrainError as error:
        complain(error)
        return NOT_USABLE
    good = GOOD
    for answer in answers:
        state = f" state {answer.state}" if answer.state is not None else ""
        if not answer.verdict:
            emit(f"FAIL {answer.place}:{state} {answer.verdict}")
            good = VERDICT
            continue
        for result in answer.failures:
            place = train.declaration.place(*_place(answer.state, result.name, train.declaration.states))
            speed = exact(result.speed)
            head, tail = (place, "") if place.startswith(file) else (file, f" (declared at {place})")
            emit(f"FAIL {head}:{state} output '{result.name}' is {speed}{_wanted(result)}{tail}")
            good = VERDICT
    for fault in faults:
        emit(f"FAIL {fault.place}: " + "; ".join(filter(None, (fault.what, fault.why, fault.fix))))
        good = VERDICT
    if good != GOOD or not quiet:
        for line in train.gridlock.lines():
            emit(f"note {file}: {line}")
    if train.is_placed and train.closure.kind in ("misses", "unclear"):
        emit(f"note {file}: {train.closure.text}")
    if good != GOOD or not quiet:
        for remark in train.remarks:
            emit(f"note {remark.place}: {remark.what}" + (f"; {remark.why}" if remark.why else ""))
        for line in _left_out(train) if not faults else ():
            emit(f"note {file}: {line}")
    if good == GOOD and not quiet:
        loops = f", {plural(train.mobility.redundant, 'redundant circuit')}" if train.mobility.redundant else ""
        kept = expectations_met(answers) or "nothing expected"
        emit(f"ok   {file}: mobility {train.mobility.by_rank}{loops}, {kept}")
    return good


def _left_out(train: GearTrain) -> Iterator[str]:
    """What the torques of loaded states do not count."""
    for state in train.states or (None,):
        if train.declaration.is_loaded(state):
            where = f"state {state}: " if state is not None else ""
            yield from (f"{where}torques leave out {each}: {each.why}" for each in train.torques(state).left_out)


def _place(state: str | None, name: str, states: object) -> tuple[str, ...]:
    own = isinstance(states, dict) and state is not None and name in states[state].outputs
    return ("states", str(state), "outputs", name) if own else ("outputs", name)


def _wanted(result: OutputResult) -> str:
    from geartrain.report.answers import result_words

    words = []
    if result.expect_holds is False and result.output.expect:
        words.append(f"expected {result.output.expect.value}")
    if result.published_holds is False and result.output.published:
        published = result.output.published
        words.append(f"published {published.value} as {published.as_}, {result_words(result)}")
    return "; " + ", ".join(words)
