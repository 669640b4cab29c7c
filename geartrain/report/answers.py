"""Sections of a train's report on states, speeds, outputs, targets and uncertain tooth counts.

`speeds_text` is the output of `geartrain solve`: the speeds of one state as plain lines, exact and in decimals.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from math import isfinite

from geartrain.analysis.gear_train import GearTrain
from geartrain.kinematics.answer import Answer
from geartrain.kinematics.circuits import couplings_on_axes
from geartrain.kinematics.judged_outputs import (
    SECONDS_PER_DAY,
    OutputResult,
    Sensitivity,
    SpeedValue,
    TargetResult,
    magnitude,
)
from geartrain.numerics.exact import plural
from geartrain.report.document import (
    MOST_ROWS,
    Document,
    Section,
    Table,
    cut,
    exact,
    figure,
    filled_table,
    one_to,
    ppm,
    titled,
)
from geartrain.train import Train
from geartrain.train.outputs import looks_away

_EXACT = 1e-9  # ppm, or days: smaller errors are rounding
_YEAR = 300  # days: shorter than any year and longer than other units of time
_SPANS = {
    "d": Fraction(1),
    "h": Fraction(1, 24),
    "min": Fraction(1, 1440),
    "s": Fraction(1, SECONDS_PER_DAY),
}  # in days


def shift_table(train: GearTrain, answers: Sequence[Answer]) -> Section:
    """Return a section with a row for each state: engaged brakes and clutches, and speed and ratio of each output."""
    declared = train.declaration
    clutches = list(declared.clutches)
    names = list(dict.fromkeys(name for answer in answers for name in answer.outputs))
    rows = []
    for answer in answers:
        engaged = declared.case(answer.state).closed
        marks = [
            ("x" if declared.clutches[name].one_way is None else "*") if name in engaged else "" for name in clutches
        ]
        cells = [_speed_and_ratio(answer, name) for name in names]
        rows.append((str(answer.state), *marks, answer.verdict.kind, *cells))
    text = ("x marks an engaged clutch or brake. " if clutches else "") + "Outputs: speed, and input divided by output."
    if any(each.one_way for each in declared.clutches.values()):
        text = f"* marks a one-way clutch that holds (only while the input drives). {text}"
    return Section("States", (text,), (Table(("state", *clutches, "verdict", *names), rows),))


def _speed_and_ratio(answer: Answer, name: str) -> str:
    result = answer.outputs.get(name)
    if result is None or result.speed is None:
        return "-"
    inverse = f" (in/out {figure(1 / result.ratio, 6)})" if result.ratio else ""
    return f"{_speed(result.speed, result.tolerance, result.slides)}{inverse}"


def answer_sections(train: GearTrain, answer: Answer) -> Iterator[Section]:
    """Yield the sections on one state: first the pointers, and, as details, all outputs, targets and speeds."""
    if answer.outputs:
        yield _pointers(train, answer)
        yield replace(_outputs(train, answer), detail=True)
    if answer.one_way:
        yield Section(titled(answer.state, "one-way clutches"), [f"{each}." for each in clutch_lines(answer)])
    yield from (replace(section, detail=True) for section in _targets(train.declaration, answer))
    case = train.declaration.case(answer.state)
    given = [*map(case.given, case.inputs)]
    given += [f"{link} fixed" for link in case.fixed] + [f"{a} and {b} locked together" for a, b in case.locks]
    lines = [f"Prescribed: {', '.join(given) or 'nothing'}.", f"Verdict: {answer.verdict}."]
    if answer.method == "floats":
        lines.append(why_floats(answer) if case.exact else "Solved in floats: radians are mixed with turns.")
    detail = bool(answer.outputs and answer.verdict)
    yield Section(titled(answer.state, "speeds"), lines, tuple(_speeds(train, answer)), detail=detail)


def _pointers(train: GearTrain, answer: Answer) -> Section:
    """Return a section with the speed, period, target and error of each pointer, or of all outputs without pointers."""
    outputs, declared = list(answer.outputs.values()), train.declaration
    # a pointer has a dial, a target or a published figure; an output that fails an expectation is also shown
    pointers = [each for each in outputs if each.output.is_pointer or not each.holds] or outputs
    rows = [_pointer_row(declared, result) for result in pointers]
    second = "output/input" if declared.unit_days is None else "period"
    error = "s a day" if _is_clock(declared) else "d a century"
    table = filled_table(("output", "speed", second, "target", "ppm off", error, "fault"), rows, 3)
    others = len(outputs) - len(pointers)
    more = (f"{plural(others, 'further output')} without dial, target or printed figure: see 'All outputs'.",)
    return Section(titled(answer.state, "outputs"), more if others else (), (replace(table, rows=cut(table.rows)),))


def _pointer_row(declared: Train, result: OutputResult) -> tuple[str, ...]:
    speed = result.speed
    second = (
        _speed(result.ratio, result.tolerance)
        if declared.unit_days is None and result.ratio is not None
        else _period(declared, speed)
    )
    target = result.targets[0] if result.targets else None
    exact_speed = _speed(speed, result.tolerance, result.slides)
    return (result.name, exact_speed, "" if result.slides else second, *_target_cells(declared, target), _fault(result))


def _is_clock(declared: Train) -> bool:
    """Return True if the train's unit of time is a day or less, so that errors are shown in seconds per day."""
    return declared.unit_days is not None and declared.unit_days <= 1


def _target_cells(declared: Train, target: TargetResult | None) -> tuple[str, str, str]:
    """Return three strings: the target, the error in ppm, and the error in days per century (in s/day for clocks)."""
    if target is None:
        return "", "", ""
    wanted = figure(target.speed, 6) if declared.unit_days is None else _period(declared, target.speed)
    if target.ppm is None:
        return wanted or "0", "", figure(target.error)
    time = target.seconds_per_day if _is_clock(declared) else target.days_per_century
    return wanted, _error_text(target.ppm), _error_text(time)


def _period(declared: Train, speed: SpeedValue | None) -> str:
    """Return the time of one turn as a string; "" for a link at rest, or if speeds have no unit of time."""
    if not speed or declared.unit_days is None:
        return ""
    # short units, because the table has many columns
    return _span(declared, 1 / magnitude(speed), 6).replace(" years", " y").replace(" year", " y")


def _error_text(error: float | None) -> str:
    return "" if error is None else "0" if abs(error) < _EXACT else f"{error:+.4g}"


def _fault(result: OutputResult) -> str:
    """Return a description of the checks that an output fails: expected values, published values and tolerances."""
    expect, published = result.output.expect, result.output.published
    sign = only_sign(result)
    parts = []
    if published is not None and not result.published_holds:
        parts.append(f"FAILS: {published.value} {published.as_} is printed, {result_words(result)}{sign}")
    if expect is not None and not result.expect_holds:
        parts.append(f"FAILS: {expect.value} is expected{sign}")
    missed = [target.label for target in result.targets if target.met is False]
    parts += [f"FAILS: outside the tolerance of {label}" for label in missed]
    return "; ".join(parts)


_ABOUT_A_DAY = Fraction(9, 10), Fraction(11, 10)  # d: solar, sidereal and lunar days
_LONGER = 2  # d: a pointer of such a period may be off by a day


def _clock_rates(declared: Train, result: OutputResult, target: TargetResult) -> tuple[str, str, str]:
    """Return three texts: error in seconds per day, error in seconds per year, and days until the error is one day.

    The first two are empty unless the output is the hand of a clock, the third for periods of up to about a day.
    """
    if declared.unit_days is None or target.days_per_century is None:
        return "", "", ""
    days = declared.unit_days / abs(target.speed)
    is_clock = result.output.hand != "needle" or _ABOUT_A_DAY[0] <= days <= _ABOUT_A_DAY[1]
    rates = (_signed(target.seconds_per_day), _signed(target.seconds_per_year)) if is_clock else ("", "")
    late = "never" if target.days_to_one_day is None else figure(target.days_to_one_day, 6)
    return *rates, late if days > _LONGER else ""


def _targets(declared: Train, answer: Answer) -> Iterator[Section]:
    """Yield a section on the errors of outputs against their targets; yield nothing if no output has a target."""
    targets = [
        (
            name,
            target.label,
            ppm(target.ppm),
            *_clock_rates(declared, result, target),
            _signed(target.days_per_century),
            _signed(target.degrees_per_unit),
            figure(target.speed, 10),
            _COMPARED[target.compared],
            "" if target.met is None else "yes" if target.met else "NO",
        )
        for name, result in answer.outputs.items()
        for target in result.targets
    ]
    if not targets:
        return
    each = answer.unit.removeprefix("turns per ") if answer.unit.startswith("turns per ") else "unit"
    rates = ("s a day", "s a year", "days to a day off")
    errors = ("error ppm", *rates, "days a century", f"degrees per {each}")
    header = ("output", "target", *errors, "target speed", "compared", "within")
    table = filled_table(header, targets, 3)
    said = ["A positive error means that the output is fast."]
    if any(_COMPARED["magnitude"] in row for row in targets):
        said.append("Compared by magnitude: the target has no `sense`, so that either sense of rotation meets it.")
    yield Section(titled(answer.state, "against the targets"), tuple(said), (table,))


_COMPARED = {"speed": "with sense", "magnitude": "magnitude", "difference": "difference"}


def _signed(value: float | None) -> str:
    return "-" if value is None else f"{value:+.5g}"


def _speeds(train: GearTrain, answer: Answer) -> Iterator[Table]:
    if not answer.speeds:
        return
    moving = [speed for speed in train.declaration.case(answer.state).inputs.values() if speed]
    rows = []
    for link, speed in islice(answer.speeds.items(), MOST_ROWS):  # fractions of a long train have many digits
        mark = " (sum of joint speeds)" if link in train.kinematics.joint_sums else ""
        # a ratio needs exactly one turning input
        ratio = speed / moving[0] if len(moving) == 1 else None
        slides = link in answer.sliding
        exact_speed = _speed(speed, answer.tolerances.get(link), slides)
        decimal = figure(speed) + (" mm" if slides else "")
        rows.append((link + mark + _pi(answer, link), exact_speed, decimal, one_to(ratio)))
    yield Table(("link", "speed", "decimal", "output : input"), cut(rows, len(answer.speeds)))


def _outputs(train: GearTrain, answer: Answer) -> Section:
    rows = [_output(train, result) for result in answer.outputs.values()]
    header: tuple[str, ...] = ("output", "of", "speed", "decimal", "output/input", "period")
    header += ("expect", "published", "as read")
    if all(row[1] == row[0] for row in rows):  # every output is named after its link
        header, *rows = (row[:1] + row[2:] for row in (header, *rows))
    notes = [f"{name}: {result.output.note}." for name, result in answer.outputs.items() if result.output.note]
    # the last five columns are omitted if they are empty
    return Section(titled(answer.state, "all outputs"), notes, (filled_table(header, rows, len(header) - 5),))


def _output(train: GearTrain, result: OutputResult) -> tuple[str, ...]:
    declared = train.declaration
    of = result.of if result.relative_to == declared.frame else f"{result.of} seen from {result.relative_to}"
    expect, published = result.output.expect, result.output.published
    sign = only_sign(result)
    unit = " mm" if result.slides and result.speed is not None else ""
    return (
        result.name,
        of + (" (sum of joint speeds)" if result.bookkeeping else ""),
        _speed(result.speed, result.tolerance, result.slides),
        figure(result.speed) + unit,
        _speed(result.ratio, result.tolerance) if result.ratio is not None and result.ratio != result.speed else "",
        _period(declared, result.speed),
        "" if expect is None else "holds" if result.expect_holds else f"FAILS: {expect.value} expected{sign}",
        ""
        if published is None
        else f"{published.value} {published.as_}"
        + ("" if result.published_holds else f" FAILS: {result_words(result)}{sign}"),
        _as_read(declared, result),
    )


def result_words(result: OutputResult) -> str:
    """Return the computed value that corresponds to a published figure, as a fraction and as a decimal number."""
    published = result.output.published
    if result.found is None:
        if result.speed is None or published is None or published.as_ == "speed":
            return "undetermined"
        if published.as_ == "period":
            return "no period: the output is at rest"
        return "undefined: a ratio needs exactly one turning input, and a turning output"
    if result.found_text is not None:
        return f"found {result.found_text}"
    text, near = exact(result.found), figure(result.found)
    return f"found {text}" + (f" = {near}" if near != text else "")


def only_sign(result: OutputResult) -> str:
    """Return a remark and a remedy if an output has the expected magnitude but turns in the opposite sense; "" if it
    does not.
    """
    if not result.differs_in_sign:
        return ""
    published = result.output.published
    ignored = published is not None and published.as_ != "period" and result.published_holds is False
    return "; only the sign differs" + (" (`magnitude: true` ignores it)" if ignored else "")


def expectations_met(answers: Iterable[Answer]) -> str:
    """Return a text such as `all 3 expectations and 2 published figures hold`; "" if nothing is expected."""
    results = [result for answer in answers for result in answer.outputs.values()]
    kinds = {
        "expectation": [each.expect_holds for each in results if each.expect_holds is not None],
        "published figure": [each.published_holds for each in results if each.published_holds is not None],
        "target tolerance": [target.met for each in results for target in each.targets if target.met is not None],
        "clutch assertion": [not each.fails for answer in answers for each in answer.one_way if each.required],
    }
    each = [f"{len(held)} {kind}" + "s" * (len(held) > 1) for kind, held in kinds.items() if held]
    # commas between all kinds except the last two
    named = " and ".join(each).replace(" and ", ", ", len(each) - 2)
    total = sum(map(len, kinds.values()))
    if failed := sum(held.count(False) for held in kinds.values()):
        return f"{failed} of {named} FAIL{'S' if failed == 1 else ''}"
    return f"{named} holds" if total == 1 else f"all {named} hold" if named else ""


def _as_read(declared: Train, result: OutputResult) -> str:
    """Return a text with the sense of rotation as seen on the dial, and the times of one turn and of one division."""
    dial = declared.dials.get(result.output.dial or "")
    if dial is None or not result.speed:
        return ""
    flipped = looks_away(dial.face, declared.view.from_)
    clockwise = ((declared.view.positive == "clockwise") == (result.speed > 0)) != flipped
    turn = 1 / magnitude(result.speed)
    words = ["clockwise" if clockwise else "counter-clockwise", f"a turn in {_span(declared, turn)}"]
    if dial.turns > 1:
        words.append(f"{dial.turns} turns in {_span(declared, turn * dial.turns)}")
    if dial.divisions > 1:
        cell = f"one {dial.cell}" if dial.cell else "a division"
        words.append(f"{cell} in {_span(declared, turn * dial.turns / dial.divisions)}")
    return ", ".join(words)


def _span(declared: Train, units: Fraction | float, digits: int = 7) -> str:
    """Return a number of the train's units of time as a string: in years if the unit is a year and the time is at least
    one year, otherwise in days, hours, minutes or seconds.
    """
    if declared.unit_days is None:
        return figure(units, 7)
    if declared.unit_days > _YEAR and units >= 1:
        return f"{figure(units, digits)} year{'' if units == 1 else 's'}"
    days = units * declared.unit_days
    name = next((name for name, each in _SPANS.items() if days >= each), "s")
    return f"{figure(days / _SPANS[name], 6)} {name}"


def doubtful_wheels(train: GearTrain, answers: Sequence[Answer]) -> Iterator[Section]:
    """Yield a section on how pointer speeds change if an uncertain wheel has one tooth more or one tooth fewer."""
    for answer in answers:
        found = list(train.kinematics.sensitivity(answer)) if answer.verdict else []
        pointers = {name for name, result in answer.outputs.items() if result.output.dial or result.targets}
        if pointers:
            found = [item for item in found if item.output in pointers]
        if not found:
            continue
        text = "Change of speed in ppm, from exact solutions; outputs with equal changes share a row."
        groups: dict[tuple[str, str, str], list[Sensitivity]] = {}
        for item in found:
            groups.setdefault((item.wheel, _shift(item.less), _shift(item.more)), []).append(item)
        rows = []
        for (wheel, less, more), items in groups.items():
            allowed = items[0].allowed
            whole = allowed == tuple(range(allowed[0], allowed[-1] + 1))
            span = f"{allowed[0]}-{allowed[-1]}" if whole else ", ".join(map(str, allowed))
            rows.append((wheel, str(items[0].teeth), span, less, more, ", ".join(item.output for item in items)))
        table = Table(("wheel", "teeth", "allowed", "one fewer", "one more", "outputs"), rows)
        yield Section(titled(answer.state, "uncertain tooth counts"), (text,), (table,), detail=True)


def _shift(value: float | None) -> str:
    return "locks or rests" if value is None else f"{value:+.6g}"


# ------------------------------------------------------------------------------------------------------ speeds as lines


def speeds_text(answer: Answer, output: str | None, oblique: frozenset[str]) -> str:
    """Return lines of text with the speeds of one state, or only with the speed of the output `output`.

    oblique   links whose speeds are sums of speeds about axes that are not parallel, so that they are not rotations
    """
    state = f" state {answer.state}" if answer.state is not None else ""
    place = "" if answer.verdict else f" ({answer.place})"
    units, declared = [answer.unit] if answer.unit else [], answer._declaration
    if answer.sliding and declared is not None:
        units.append(f"slides in {declared.travel_unit}{'' if answer.unit else ' per turn'}")
    unit = f" ({', '.join(units)})" if units and answer.verdict else ""
    lines = [f"{answer.train}{state}: {answer.verdict}{place}{unit}"]
    rows: list[tuple[str, SpeedValue | None, Fraction | None, str]] = [
        (
            name,
            result.speed,
            result.tolerance,
            _errors(answer, result.of) + _pi(answer, name) + ("" if result.holds else f"  {_fault(result)}"),
        )
        for name, result in answer.outputs.items()
    ]
    if output is None:
        links: list[tuple[str, SpeedValue | None, Fraction | None, str]] = [
            (link, speed, answer.tolerances.get(link), _marks(answer, link, oblique))
            for link, speed in answer.speeds.items()
        ]
        rows = links + [row for row in rows if row[0] not in answer.speeds or "FAILS" in row[3]]
    elif not rows:
        tolerance = answer.tolerances.get(output)
        rows = [(output, answer.speeds.get(output), tolerance, _marks(answer, output, oblique))]
    width = max((len(name) for name, *_ in rows), default=0)
    for name, speed, tolerance, mark in rows:
        result = answer.outputs.get(name)
        slides = name in answer.sliding if result is None else result.slides
        unit = " mm" if slides else ""
        period = "" if answer._declaration is None or slides else _period(answer._declaration, speed)
        turn = f"  a turn in {period}" if period and result is not None else ""
        within = f" ± {figure(tolerance, 3)}" if tolerance else ""
        decimal = figure(speed, 12) + unit
        lines.append(f"  {name:<{width}}  {_speed(speed, tolerance, slides):>20}  {decimal}{within}{turn}{mark}")
    lines += [f"  {each}" for each in clutch_lines(answer)]
    if answer.residual:
        row, most = max(answer.residual.items(), key=lambda each: each[1])
        if any(each.true_error is None for each in answer.accuracy.values()):
            lines.append(f"  {why_floats(answer)}")
        lines.append(f"  residual: at most {most:.1e} of the terms of a row" + (f", in {row}" if most else ""))
    if output is None and answer._declaration is not None:
        couplings = couplings_on_axes(answer._declaration, GearTrain(answer._declaration).kinematics.tree)
        remarks = ((each.name, each.remark) for each in couplings)
        lines += [f"  coupling '{name}' {remark}: speeds are means" for name, remark in remarks if remark]
    return "\n".join(lines)


def clutch_lines(answer: Answer) -> Iterator[str]:
    """Yield a line for each one-way clutch, which holds or overruns, and then the notes on these clutches."""
    yield from (each.text(answer.unit) for each in answer.one_way)
    yield from answer.notes


def answer_text(answer: Answer) -> str:
    """Return the text that `geartrain solve` prints for one state."""
    declared = answer._declaration
    oblique = frozenset() if declared is None else GearTrain(declared).kinematics.joint_sums
    return speeds_text(answer, answer._output, oblique)


def answer_document(answer: Answer) -> Document | None:
    """Return a document on the outputs, targets and speeds of one state; None if the result has no train."""
    if answer._declaration is None:
        return None
    train = GearTrain(answer._declaration)
    return Document(answer.train, [], list(answer_sections(train, answer)))


def why_floats(answer: Answer) -> str:
    """Return sentences: why a system was solved in floats, the estimated error, and the option for exact fractions."""
    error = max((each.estimate for each in answer.accuracy.values()), default=0.0)
    why = "the system is coupled too densely for exact elimination within about a second"
    return (
        f"Solved in floats: {why}. The estimated error of every speed is at most {error:.1e}. "
        "`geartrain solve FILE --method exact` solves it in fractions, however long it takes."
    )


def _speed(speed: SpeedValue | None, tolerance: Fraction | None, slides: bool = False) -> str:
    """Return a speed as a fraction, with the mark ≈ after an approximate ratio, and with a unit if the link slides."""
    text = exact(speed) + " mm" if slides and speed is not None else exact(speed)
    return f"≈ {text.removeprefix('≈ ')}" if tolerance else text


def _marks(answer: Answer, link: str, oblique: frozenset[str]) -> str:
    return _errors(answer, link) + _pi(answer, link) + ("  (sum of joint speeds)" if link in oblique else "")


def _pi(answer: Answer, name: str) -> str:
    """Return a note that the speed of an output or link contains pi; "" if it does not, or if the printed value shows
    pi.
    """
    speed = answer.speeds.get(name) if name not in answer.outputs else answer.outputs[name].speed
    if speed is None or not answer.contains_pi.get(name) or "π" in exact(speed):
        return ""
    return "  (not exact: contains π)"


def _errors(answer: Answer, link: str) -> str:
    """Return condition number, estimated error and true error of a floating-point speed; "" for an exact speed."""
    accuracy = answer.accuracy.get(link)
    if accuracy is None:
        return ""
    true = "" if accuracy.true_error is None else f", true error {accuracy.true_error:.1e}"
    known = accuracy.condition is not None and isfinite(accuracy.condition)  # infinite for a link at rest
    condition = f"condition {accuracy.condition:.3g}, " if known else ""
    return f"  {condition}estimate {accuracy.estimate:.1e}{true}"
