"""Verdict of `geartrain check` on a train: failures and remarks as lines that begin with a location in a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError
from geartrain.kinematics.buildability import build_errors
from geartrain.kinematics.circuits import pallet_link
from geartrain.kinematics.willis_system import relative_speed
from geartrain.numerics.exact import plural
from geartrain.report.answers import expectations_met, only_sign, result_words
from geartrain.report.document import exact, figure, ppm

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain
    from geartrain.kinematics.answer import Answer
    from geartrain.kinematics.judged_outputs import OutputResult
    from geartrain.train import Train


@dataclass(frozen=True)
class Soundness:
    """Findings of `geartrain check` on a train in a file. An instance evaluates to True if its `failures` are empty."""

    train: GearTrain
    file: str
    answers: Sequence[Answer]
    failures: tuple[str, ...]
    """Lines on undetermined speeds, unmet expectations, parts that cannot be built, and teeth that cannot turn."""
    whole: bool = True
    """True if the findings include the checks of teeth, loads and closure of loops, which need numpy."""

    def __bool__(self) -> bool:
        return not self.failures

    def lines(self, quiet: bool = False) -> Iterator[str]:
        """Yield the output lines of `geartrain check`; if `quiet`, omit the remarks on a train without failures."""
        # remarks may explain a failure, so they are printed with failures
        train, whole = self.train, not quiet or not self
        yield from (f"FAIL {each}" for each in self.failures)
        if whole:
            yield from (f"note {found}" for found in train.build_findings if not found.is_error)
            yield from (f"note {self.file}: {line}" for line in train.kinematics.gridlock.lines())
        if self.whole and train.kinematics.is_placed and train.closure.kind in ("misses", "unclear"):
            yield f"note {self.file}: {train.closure.text}"
        if whole:
            for remark in train.kinematics.remarks:
                yield f"note {remark.place}: {remark.what}" + (f"; {remark.why}" if remark.why else "")
            if self.whole:
                yield from (f"note {self.file}: {line}" for line in _neglected(train))
                yield from (f"note {line}" for line in _too_fast(train))
            yield from (f"note {line}" for line in _off_beat(train, self.answers))
        if self and not quiet:
            yield f"ok   {self.file}: {_summary(train, self.answers)}{_without_findings(train, self.whole)}"


def find_soundness(train: GearTrain, file: str, whole: bool = True) -> Soundness:
    """Check every state of a train read from a file; raise `GearTrainError` if declared teeth cannot be made."""
    answers = list(train.answers())
    failures = [line for answer in answers for line in _failures(train, answer, file)]
    failures += map(str, build_errors(train.build_findings))
    if whole:
        failures += [f"{fault.place}: {fault.text}" for fault in train.mechanics.faults]
    return Soundness(train, file, answers, tuple(failures), whole)


def _summary(train: GearTrain, answers: Sequence[Answer]) -> str:
    redundant = train.mobility.redundant
    loops = f", {redundant} redundant circuit{'' if redundant == 1 else 's'}" if redundant else ""
    return f"mobility {train.mobility.by_rank}{loops}, {expectations_met(answers) or 'nothing expected'}"


def _without_findings(train: GearTrain, whole: bool) -> str:
    """Return a text that lists the checked parts without findings: equal planets and, if `whole`, declared teeth."""
    declared, rules = train.declaration, {found.rule for found in train.build_findings}
    checked = []
    if not rules & {"A1", "A2", "A3"}:
        checked += [f"{link.copies} planets '{name}'" for name, link in declared.links.items() if link.copies > 1]
    pairs = sum(declared.form_of(gear) is not None for gear in declared.gears)
    if whole and pairs and not rules & {"R2", "W3"}:
        checked.append(f"the declared teeth of {plural(pairs, 'pair')}")
    return f"; without findings: {', '.join(checked)}" if checked else ""


def _failures(train: GearTrain, answer: Answer, file: str) -> Iterator[str]:
    """Yield the failures of one state: an unexpected verdict, or each expectation that is not met."""
    state = f" state {answer.state}" if answer.state is not None else ""
    if not answer.as_expected:
        wanted = "" if answer.expected == "determined" else f", where `expect` says {answer.expected}"
        yield f"{answer.place}:{state} {answer.verdict}{wanted}"
        return
    for each in answer.one_way:
        if each.fails:
            yield f"{train.declaration.place('clutches', each.name)}:{state} {each.text(answer.unit)}"
    for result in answer.failures:
        own = answer.state is not None and result.name in train.declaration.states[answer.state].outputs
        path = ("states", str(answer.state), "outputs") if own else ("outputs",)
        place = train.declaration.place(*path, result.name)
        # a figure may be declared in a parent of the given file
        head, tail = (place, "") if place.startswith(file) else (file, f" (declared at {place})")
        yield f"{head}:{state} output '{result.name}' is {exact(result.speed)}{_wanted(result)}{tail}"


def _neglected(train: GearTrain) -> Iterator[str]:
    """Yield lines on the effects that torques neglect in each loaded state; nothing if the teeth cannot turn."""
    if train.mechanics.faults:
        return
    for state in train.kinematics.usable_states:
        if train.declaration.is_loaded(state):
            where = f"state {state}: " if state is not None else ""
            yield from (f"{where}torques do not include {each}: {each.why}" for each in train.torques(state).neglected)


def _too_fast(train: GearTrain) -> Iterator[str]:
    """Yield lines on the states in which the input is faster than the speed at which teeth first separate."""
    from geartrain.report.motion_report import separation_rates

    for state in train.kinematics.usable_states:
        rate = train.declaration.case(state).rate
        if rate is None or rate.unit is None or train.mechanics.faults:
            continue
        try:
            found = separation_rates(train, state)
        except GearTrainError:  # the cause is reported with the failures
            continue
        if found is not None and found.rate is not None and found.rate < abs(rate.base):
            where = f"state {state}: " if state is not None else ""
            at = "at any rate" if not found.rate else f"from {found.rate:.5g} turn/s of '{found.input}' on"
            what = f"{where}the rate is {rate}, but the teeth of {found.pair} separate {at}"
            yield f"{train.declaration.place('rate')}: {what}; `motion` and `torques` are valid below that rate"


def _off_beat(train: GearTrain, answers: Sequence[Answer]) -> Iterator[str]:
    """Yield lines on the states in which the escape wheel's speed relative to its pallets does not match the beat."""
    declared = train.declaration
    escapement = declared.escapement
    if escapement is None:
        return
    tree = train.kinematics.tree
    bearer = tree.reference(escapement.link, pallet_link(escapement, tree))
    seen = "" if bearer == declared.frame else f" relative to '{bearer}'"
    for answer in answers:
        # beats are in seconds, so speeds need a unit of time
        second = _turns_a_second(declared, answer)
        if not answer.verdict or second is None:
            continue
        speeds = {link: Fraction(answer[link]) for link in (escapement.link, bearer)}
        speed = abs(relative_speed(escapement.link, bearer, speeds.__getitem__, train.kinematics.signs) * second)
        if abs(speed - escapement.speed) > escapement.speed / 10**9:  # tolerance for speeds solved in floats
            state = f"state {answer.state}: " if answer.state is not None else ""
            beat = f"half a tooth of {escapement.teeth} every {escapement.beat} is {figure(escapement.speed)} turn/s"
            yield (
                f"{declared.place('escapement')}: {state}{beat}, but '{escapement.link}' turns at {figure(speed)} "
                f"turn/s{seen}, which gives "
                + (f"a beat of {figure(1 / (2 * escapement.teeth * speed))} s" if speed else "no beat")
            )


def _turns_a_second(declared: Train, answer: Answer) -> Fraction | None:
    """Return the train's unit of speed in turns per second; None if speeds have no unit and no rate is declared."""
    if declared.unit_speed is not None:
        return declared.unit_speed
    case = declared.case(answer.state)
    driving_speed = next((speed for speed in case.inputs.values() if speed), None)
    if case.rate is None or case.rate.unit is None or driving_speed is None:
        return None
    return abs(case.rate.base / driving_speed)


def _wanted(result: OutputResult) -> str:
    words, expect, published = [], result.output.expect, result.output.published
    if result.expect_holds is False and expect:
        words.append(f"expected {expect.value}")
    if result.published_holds is False and published:
        words.append(f"published {published.value} as {published.as_}, {result_words(result)}")
    # without a speed no target is evaluated
    for declared, target in zip(result.output.targets, result.targets, strict=False):
        if target.met is False:
            off = figure(target.error, 6) if target.ppm is None else f"{ppm(target.ppm)} ppm"
            words.append(f"target {target.goal.words} missed by {off} (tolerance {declared.tolerance})")
    return "; " + ", ".join(words) + only_sign(result)
