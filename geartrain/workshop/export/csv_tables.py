"""Every table of a train as CSV: exact values as text, a decimal beside each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.numerics.exact import decimal, fraction_text
from geartrain.numerics.files import csv_text

if TYPE_CHECKING:
    from geartrain.scene.solids.solid_assembly import SolidModel

_DIGITS = 15

Rows = Sequence[Sequence[object]]


def to_tables(work: SolidModel) -> Mapping[str, str]:
    """CSV by the name of its table: wheels, links, pairs, circuits, couplings, axes, outputs."""
    made = {
        "wheels": _wheels,
        "links": _links,
        "pairs": _pairs,
        "circuits": _circuits,
        "couplings": _couplings,
        "axes": _axes,
        "outputs": _outputs,
    }
    tables = {name: make(work) for name, make in made.items()}
    return {name: csv_text(head.split(), rows) for name, (head, rows) in tables.items()}


def _both(value: Fraction | None) -> tuple[str, str]:
    """The exact text and the decimal."""
    return ("", "") if value is None else (fraction_text(value), decimal(value, _DIGITS))


def _wheels(work: SolidModel) -> tuple[str, Rows]:
    rows = []
    for name, (link, wheel) in work.train.declaration.wheels.items():
        place = work.layout.wheels[name]
        doubt = wheel.doubt
        rows.append(
            (
                *(name, link, wheel.count, " ".join(map(str, doubt.allowed)) if doubt else "", wheel.kind),
                *("yes" if wheel.internal else "", place.axis, place.layer, f"{place.module / wheel.slant:.9g}"),
                *(f"{place.radius:.9g}", *(f"{each:.9g}" for each in place.centre), wheel.status, wheel.source),
            )
        )
    return "wheel link teeth allowed kind internal axis layer module_mm radius_mm x_mm y_mm z_mm status source", rows


def _links(work: SolidModel) -> tuple[str, Rows]:
    train = work.train
    states = train.states if work.state is None else (work.state,)
    rows = []
    for answer in (train.solve(state, method="exact") for state in states or (None,)):
        for link in train.declaration.links:
            found = answer.speeds.get(link)
            joint = train.kinematics.tree.parent.get(link)
            parent, axis = joint if joint else ("", "")
            speed = _both(None if found is None else Fraction(found))
            wheels = " ".join(train.declaration.links[link].wheels)
            rows.append((answer.state, link, parent, axis, *speed, answer.unit, wheels))
    return "state link joined_to axis speed speed_decimal unit wheels", rows


def _pairs(work: SolidModel) -> tuple[str, Rows]:
    declared = work.train.declaration
    carriers = {circuit.id: circuit.carrier for circuit in work.train.circuits}
    rows = []
    for gear in declared.gears:
        first, second = gear.pair
        form = declared.form_of(gear)
        counts = [declared.wheels[wheel][1].count for wheel in gear.pair]
        distance = work.layout.axis_distance(first, second)
        shown = "" if distance is None else f"{distance:.9g}"
        rows.append((gear.name, first, second, *counts, carriers[gear.name], form.form if form else "", shown))
    return "pair first second first_teeth second_teeth carrier form distance_mm", rows


def _circuits(work: SolidModel) -> tuple[str, Rows]:
    rows = [
        (each.id, each.kind, each.i, each.j, each.carrier, each.a, each.b, *_both(each.ratio), each.note)
        for each in work.train.circuits
    ]
    return "circuit kind i j carrier a b ratio ratio_decimal note", rows


def _couplings(work: SolidModel) -> tuple[str, Rows]:
    rows = []
    for each in work.train.declaration.couplings:
        sizes = (None if size is None else f"{size.si * 1000:.12g}" for size in (each.pin_radius, each.offset))
        rows.append((each.name, each.kind, each.pin, each.slot, *sizes, each.status))
    return "coupling kind pin slot pin_radius_mm offset_mm status", rows


def _axes(work: SolidModel) -> tuple[str, Rows]:
    rows = [
        (axis.label, axis.carrier, axis.how, *(f"{each:.9g}" for each in (*axis.point, *axis.direction)))
        for axis in work.layout.axes.values()
    ]
    return "axis carrier how x_mm y_mm z_mm dx dy dz", rows


def _outputs(work: SolidModel) -> tuple[str, Rows]:
    train = work.train
    states = train.states if work.state is None else (work.state,)
    rows = []
    for answer in (train.solve(state, method="exact") for state in states or (None,)):
        for name, result in answer.outputs.items():
            speed = _both(None if result.speed is None else Fraction(result.speed))
            rows.append(
                (
                    answer.state,
                    name,
                    result.of,
                    result.relative_to,
                    *speed,
                    answer.unit,
                    "yes" if result.holds else "no",
                )
            )
    return "state output of relative_to speed speed_decimal unit holds", rows
