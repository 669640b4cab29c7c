"""What try.html asks Python: a declaration as text in, all that the page shows of it out, as JSON, without numpy."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import partial
from math import cos, hypot, pi, sin
from os import chdir
from pathlib import Path
from typing import Any

import geartrain
from geartrain import Answer, GearTrain, shipped
from geartrain.errors import GearTrainError, Problem
from geartrain.report import collect_report, to_html
from geartrain.report.declaration_schema import schema
from geartrain.report.document import exact
from geartrain.report.soundness import find_soundness
from geartrain.report.train_report import describe_train
from geartrain.scene.layout.declared_geometry import Parallels, Point, read_geometry
from geartrain.scene.layout.plan_problem import PlanProblem, plan_problem
from geartrain.scene.layout.wheel_modules import size_geometry
from geartrain.teeth.coupling import COUPLINGS

TEXT = "text"
"""What the package calls a declaration that is no file."""

LEFT_OUT = "Teeth, pins, torques, strength and motion take numpy, which this page does not bring: install geartrain."
_PLACE = re.compile(rf"{TEXT}:(\d+): *")
_MOST_DIALS = 120
_DIRECTIONS = 48  # in which an axis on one circle is tried


def gather(name: str) -> None:
    """Put the shipped declarations side by side in a folder and work there, for a text may extend them by file name."""
    folder = Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    for path in shipped().values():
        (folder / path.name).write_bytes(path.read_bytes())
    chdir(folder)


def declaration_schema() -> str:
    """The JSON Schema of a declaration, for completion."""
    return json.dumps(schema())


def answer(text: str) -> str:
    """All that is shown of a declaration: its problems by line, and, where it can be read, what it does."""
    try:
        train = geartrain.load(text if "\n" in text else text + "\n")
        found = _answered(train)
    except GearTrainError as error:
        found = {"problems": [_problem(each) for each in error.problems], "verdict": "cannot be read", "sound": False}
    return json.dumps(found, default=str)


def _answered(train: GearTrain) -> dict[str, Any]:
    declared = train.declaration
    sound = find_soundness(train, TEXT, whole=False)
    answers = sound.answers
    return {
        "problems": [each for line in sound.lines() if (each := _told(line))],
        "verdict": _verdict(answers),
        "sound": bool(sound),
        "unit": declared.unit_name or "",
        "clockwise": declared.view.positive == "clockwise",
        "states": [_state(train, each) for each in answers],
        "plan": _plan(train),
        "links": [*declared.links],
        "wheels": [*declared.wheels],
        "left_out": LEFT_OUT if _takes_numpy(train) else "",
        "page": _still(to_html([describe_train(collect_report(train, whole=False))])),
    }


def _still(page: str) -> str:
    """A report without its script, which nothing runs here."""
    return page.partition("<script>")[0] + "</body>\n</html>\n"


# ----------------------------------------------------------------------------------------------------------- problems


def _problem(problem: Problem) -> dict[str, Any]:
    found = _PLACE.match(problem.place + ": ")
    line = int(found[1]) if found else 0
    what = problem.what if found or not problem.place else f"{problem.place}: {problem.what}"
    return {"line": line, "level": "error", "what": what, "why": problem.why, "fix": problem.fix}


def _told(line: str) -> dict[str, Any] | None:
    """A line of `geartrain check`; nothing of the one that says that all is well."""
    mark, _, rest = line.partition(" ")
    if mark == "ok":
        return None
    place = _PLACE.match(rest)
    said = rest[place.end() :] if place else rest.removeprefix(f"{TEXT}: ")
    level = "error" if mark == "FAIL" else "note"
    return {"line": int(place[1]) if place else 0, "level": level, "what": said, "why": "", "fix": ""}


def _verdict(answers: Any) -> str:
    told = dict.fromkeys(str(each.verdict) for each in answers)
    return "; ".join(told)


def _takes_numpy(train: GearTrain) -> bool:
    declared = train.declaration
    toothed = declared.tooth_form is not None or any(gear.tooth_form for gear in declared.gears)
    loaded = any(declared.is_loaded(state) for state in train.states or (None,))
    # a pin without dimensions has no transmission function
    varying = any(COUPLINGS[each.kind].varies and getattr(each, "pin_radius", True) for each in declared.couplings)
    return toothed or loaded or train.kinematics.is_placed or varying


# -------------------------------------------------------------------------------------------------------------- dials


def _state(train: GearTrain, found: Answer) -> dict[str, Any]:
    """Speeds of a state as texts and as turns for each turn of its first input that turns."""
    case = train.declaration.case(found.state)
    lead = next((link for link in case.inputs if found.speeds.get(link)), None)
    one = found.speeds[lead] if lead is not None else Fraction(1)
    shown = {name: (each.of, each.speed) for name, each in found.outputs.items()}
    if not shown:
        still = train.declaration.frame
        shown = {link: (link, speed) for link, speed in found.speeds.items() if link != still}
    moving = train.unfolded.solve(found.state).speeds if train.unfolded is not train else found.speeds
    dials = [
        {"name": name, "of": of, "exact": exact(speed), "turns": _turns(speed, one), **_shown(found, name)}
        for name, (of, speed) in shown.items()
        if speed is not None
    ]
    return {
        "name": found.state or "",
        "verdict": str(found.verdict),
        "lead": lead or "",
        "turns": {link: _turns(speed, one) for link, speed in moving.items() if speed is not None},
        "dials": dials[:_MOST_DIALS],
    }


def _turns(speed: Any, one: Any) -> float:
    try:
        return float(speed / one)
    except (OverflowError, TypeError):
        return 0.0


def _shown(found: Answer, name: str) -> dict[str, Any]:
    """What an output ought to be."""
    result = found.outputs.get(name)
    if result is None:
        return {"holds": None, "targets": []}
    return {"holds": result.holds, "targets": [f"{each.label}: {_off(each.ppm)}" for each in result.targets]}


def _off(ppm: float | None) -> str:
    return "" if ppm is None else f"{ppm:+.4g} ppm"


# --------------------------------------------------------------------------------------------------------------- plan


def _plan(train: GearTrain) -> dict[str, Any]:
    """Pitch circles of the most numerous parallel axes, touching where wheels mesh: a sketch, no layout."""
    train = _plain(train).unfolded
    geometry = size_geometry(read_geometry(train))
    lines = geometry.declared.lines.values()
    groups: dict[int, int] = {}
    for axis in geometry.declared.axis.values():
        if axis in geometry.declared.lines:
            group = geometry.declared.lines[axis].group
            groups[group] = groups.get(group, 0) + 1
    if not groups:
        return {"wheels": [], "axes": {}, "pivots": {}, "bearers": {}}
    main = max(groups, key=lambda group: groups[group])
    parallels = Parallels.of([line for line in lines if line.group == main])
    given = {line.label: parallels.flat(line.given) for line in parallels.lines if line.given is not None}
    problem = plan_problem(geometry, parallels, given or {next(iter(parallels.index)): (0.0, 0.0)}, {})
    points = _sketched(problem)
    wheels = [
        {
            "wheel": wheel,
            "link": train.declaration.wheels[wheel][0],
            "axis": axis,
            "x": points[axis][0],
            "y": points[axis][1],
            "radius": geometry.sizes[wheel].radius,
            "ring": train.declaration.wheels[wheel][1].internal,
        }
        for wheel, axis in geometry.declared.axis.items()
        if axis in points and wheel in train.declaration.wheels
    ]
    pivots = {label: pivot for label, pivot in problem.pivots.items() if pivot in points}
    bearers = {label: problem.bearers[label] for label in pivots}
    return {"wheels": wheels, "axes": points, "pivots": pivots, "bearers": bearers}


def _plain(train: GearTrain) -> GearTrain:
    """Without forms of teeth, some of which move their axes apart by a calculation in numpy."""
    declared = train.declaration
    return GearTrain(
        declared.changed(tooth_form=None, gears=[each.changed(tooth_form=None) for each in declared.gears])
    )


def _sketched(problem: PlanProblem) -> dict[str, Point]:
    """Points of axes, each at the distances from those that stand, with the most room round it."""
    distance: dict[str, dict[str, float]] = {label: {} for label in problem.labels}
    for (one, other), far in problem.distances.items():
        distance[one][other] = distance[other][one] = far
    points = dict(problem.fixed)
    while rest := [label for label in problem.labels if label not in points]:
        label = max(rest, key=lambda each: len(distance[each].keys() & points.keys()))
        tied = {other: far for other, far in distance[label].items() if other in points}
        choices = _choices(points, tied, problem.radius(label))
        points[label] = max(choices, key=partial(_room, problem, points, problem.radius(label)))
    return points


def _choices(points: Mapping[str, Point], tied: Mapping[str, float], radius: float) -> Iterator[Point]:
    """Where an axis could stand: at the crossings of two circles, round one, or beside all."""
    if len(tied) >= 2:
        (one, near), (other, far) = [*tied.items()][:2]
        yield from _crossings(points[one], near, points[other], far)
        return
    middle, far = next(((points[one], far) for one, far in tied.items()), ((0.0, 0.0), 0.0))
    if not tied:
        far = max((hypot(*each) for each in points.values()), default=0.0) + 2 * radius
    for at in range(_DIRECTIONS):
        turn = 2 * pi * at / _DIRECTIONS
        yield middle[0] + far * cos(turn), middle[1] + far * sin(turn)


def _crossings(a: Point, near: float, b: Point, far: float) -> Iterator[Point]:
    x, y = b[0] - a[0], b[1] - a[1]
    apart = hypot(x, y)
    if not apart:
        yield a[0] + near, a[1]
        return
    along = (apart**2 + near**2 - far**2) / (2 * apart)
    high = max(near**2 - along**2, 0.0) ** 0.5
    for side in (1, -1):
        yield a[0] + (along * x - side * high * y) / apart, a[1] + (along * y + side * high * x) / apart


def _room(problem: PlanProblem, points: Mapping[str, Point], own: float, at: Point) -> float:
    """How little a wheel covers those that stand, first; then how near it stays to them."""
    covered = sum(
        max(own + problem.radius(other) - hypot(at[0] - x, at[1] - y), 0.0) ** 2
        for other, (x, y) in points.items()
        if problem.radius(other)
    )
    return -covered - 1e-3 * hypot(*at)
