"""Checks of links that slide: speeds, outputs and loads in units of travel, and properties of turning links only.

A link has one joint towards the frame, so that it either turns or slides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from geartrain.errors import Loc, Problem
from geartrain.numerics.quantity import Quantity
from geartrain.train.declaration import Train
from geartrain.train.states import Drive, State

_IN_TURNS = ("turn", "rpm")
"""Beginnings of units of rotation that correspond to a travel per turn."""


def sliding_problems(train: Train) -> Iterator[Problem]:
    """Yield a problem for each speed, load or property whose unit or kind does not match the motion of its link."""
    for loc, part in train.cases_declared:
        yield from _inputs(train, loc, part.inputs or {})
        yield from _loads(train, loc, part.loads or {})
        yield from _outputs(train, loc, part)
        if part.drive is not None:
            yield from _drive(train, (*loc, "drive"), part.drive)
    if train.rate is not None:
        yield from _drive(train, ("rate",), Drive(rate=train.rate))
    if train.sliding:
        yield from _links(train)


def _inputs(train: Train, loc: Loc, inputs: Mapping[str, Quantity]) -> Iterator[Problem]:
    for link, speed in inputs.items():
        place = train.place(*loc, "inputs", link)
        travels = speed.dimension in ("length", "velocity")
        if link in train.sliding and not travels and speed.value:
            number = speed.text.split()[0]
            fix = f"give a length: `{link}: {number} mm`, or a velocity: `{link}: {number} mm/s`"
            yield Problem(f"'{link}' slides, but its speed '{speed}' is not a travel", _PER_UNIT, fix, place)
        elif link not in train.sliding and travels:
            what = f"'{speed}' is a {speed.dimension}, but a speed is required, because '{link}' turns"
            fix = f"give a number or a speed of rotation, or declare '{link}' under `slides`"
            yield Problem(what, "a turning link has a speed in turns", fix, place)
        elif train.sliding and speed.unit and not travels and not speed.unit.startswith(_IN_TURNS):
            what = f"the input '{speed}' is not in turns"
            why = "travel is in mm per turn, so that a train with slides needs speeds in turns"
            yield Problem(what, why, "give the speed in turn/s, turn/min or rpm", place)


_PER_UNIT = "the speed of a sliding link is its travel per unit of the train, or per turn if the train has no unit"


def _loads(train: Train, loc: Loc, loads: Mapping[str, Quantity]) -> Iterator[Problem]:
    for link, load in loads.items():
        place, slides = train.place(*loc, "loads", link), link in train.sliding
        if slides and load.value and load.dimension != "force":
            what = f"'{link}' slides, but its load '{load}' is not a force"
            yield Problem(what, "a slide takes a force", f"give a force, such as `{link}: -100 N`", place)
        elif not slides and load.dimension == "force":
            what = f"'{link}' turns, but its load '{load}' is a force"
            fix = f"give a torque, such as `{link}: -2 N m`, or put the force on a link that slides"
            yield Problem(what, "a link that turns takes a torque", fix, place)


def _outputs(train: Train, loc: Loc, part: Train | State) -> Iterator[Problem]:
    for name, output in part.outputs.items():
        slides, place = output.links(name, train.frame)[0] in train.sliding, (*loc, "outputs", name)
        values: list[tuple[str, Any]] = [("expect", output.expect.value)] if output.expect is not None else []
        if output.published is not None and output.published.as_ == "speed":
            values.append(("published", output.published.value))
        values += [("targets", target.speed) for target in output.targets if target.speed is not None]
        for key, value in values:
            if slides and value.unit is None and value.value:
                what, fix = f"'{name}' slides, but `{key}` is the plain number {value}", f"give a length: `{value} mm`"
                yield Problem(what, _PER_UNIT, fix, train.place(*place, key))
            elif not slides and value.unit is not None:
                what = f"'{name}' turns, but `{key}` is the length {value}"
                yield Problem(what, "a turning link has a speed in turns", "give a number", train.place(*place, key))
        printed = output.published is not None and output.published.as_ == "period"
        if slides and (printed or any(target.speed is None for target in output.targets)):
            fix = "give a travel per unit of the train, such as `{speed: 5 mm}`"
            yield Problem(f"'{name}' slides and has no period", _PER_UNIT, fix, train.place(*place))
        if slides and output.dial is not None:
            what, why = f"'{name}' slides and cannot be read on a dial", "the hand of a dial turns"
            yield Problem(
                what, why, "remove `dial`, or use the link that drives the slide", train.place(*place, "dial")
            )


_TURNING_ONLY = {
    "inertia": "give its `mass`",
    "bearing": "give an `efficiency` of its coupling",
    "drag": "remove it",
    "arbor": "remove it",
    "angle": "remove it",
}
"""Properties of turning links, with the fix for a link that slides."""


def _links(train: Train) -> Iterator[Problem]:
    for link in (link for link in train.links if link in train.sliding):
        part, place = train.links[link], train.place("links", link)
        for key in (key for key in _TURNING_ONLY if getattr(part, key) is not None):
            what, why = f"'{link}' slides and has no `{key}`", f"`{key}` belongs to a link that turns"
            yield Problem(what, why, _TURNING_ONLY[key], place)
        if part.copies > 1:
            what, why = f"{part.copies} copies of '{link}', which slides", "copies are spaced about an axis"
            yield Problem(what, why, "declare them one by one", place)
    if train.escapement is not None and train.escapement.link in train.sliding:
        what, why = f"the escapement is on '{train.escapement.link}', which slides", "an escape wheel turns"
        yield Problem(what, why, "name the link of the escape wheel", train.place("escapement", "link"))


def _drive(train: Train, loc: Loc, drive: Drive) -> Iterator[Problem]:
    """Yield a problem if the drive does not match the motion of its link: the input for a rate, else the crank."""
    inputs = next((part for part in (train.inputs, *(state.inputs for state in train.states.values())) if part), {})
    source = next((link for link, speed in inputs.items() if speed.value), None)
    link = source if drive.rate is not None else train.crank or source
    if link is None:
        return
    slides, place = link in train.sliding, train.place(*loc)
    if drive.rate is not None:
        if (drive.rate.dimension == "velocity") != slides:
            does, fix = ("slides", "2 mm/s") if slides else ("turns", "1 turn/s")
            what = f"the input '{link}' {does}, but its rate is '{drive.rate}'"
            yield Problem(what, "the rate is the speed of the input in real time", f"write `rate: {fix}`", place)
    elif slides and (drive.weight is None or drive.drum is not None):
        what = f"'{link}' slides, and can only be driven by its weight"
        why = "other drives turn a link" if drive.weight is None else "`drum` would turn a link"
        yield Problem(what, why, "give `drive: {weight: 4 kg}` without `drum`", place)
    elif not slides and drive.weight is not None and drive.drum is None:
        what = f"the weight at '{link}' has no `drum`"
        why = f"'{link}' turns, and the lever arm of the weight is needed"
        fix = "give `weight: 4 kg, drum: 20 mm`, or as `crank` the link of the weight, which slides"
        yield Problem(what, why, fix, place)
