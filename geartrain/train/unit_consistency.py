"""Units of a declaration that do not go together, and targets that cannot be compared in the train's unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from geartrain.errors import Loc, Problem, dotted
from geartrain.numerics.quantity import Quantity
from geartrain.train.declaration import Train
from geartrain.train.drives import Drive
from geartrain.train.outputs import Target
from geartrain.train.periods import period_table, suggested_period


def mixed_inputs(train: Train) -> Iterator[Problem]:
    """Plain and named inputs side by side, in one state or in several; zeros go with either."""
    named: tuple[Loc, Quantity] | None = None
    plain: tuple[Loc, Quantity] | None = None
    groups: list[tuple[Loc, Mapping[str, Quantity]]] = [((), train.inputs)]
    groups += [(("states", name), state.inputs or {}) for name, state in train.states.items()]
    for loc, inputs in groups:
        for link, speed in inputs.items():
            if speed.unit is not None:
                named = named or ((*loc, "inputs", link), speed)
            elif speed.value:
                plain = plain or ((*loc, "inputs", link), speed)
    if named is None:
        return
    if plain is not None:
        why = f"'{plain[1]}' is a plain number and '{named[1]}' has a unit"
        yield Problem("inputs mix units", why, "write all inputs in one way", train.place(*plain[0]))
    if train.unit is not None and train.unit_days is None:
        why = f"the train's unit is one turn per {train.unit.per}, which is no time, and '{named[1]}' is"
        fix = "write all inputs as plain numbers, or declare `unit: {per: ...}` as a time"
        yield Problem("inputs mix units", f"{why} a speed in time", fix, train.place(*named[0]))


def mixed_torques(train: Train) -> Iterator[Problem]:
    """Plain and named torques side by side; zeros go with either."""
    groups: list[tuple[Loc, Mapping[str, Quantity]]] = [(("loads",), train.loads)]
    groups += [(("states", name, "loads"), state.loads or {}) for name, state in train.states.items()]
    found = [((*loc, link), torque) for loc, loads in groups for link, torque in loads.items()]
    found += [(("links", name, "bearing"), part.bearing.sliding) for name, part in train.links.items() if part.bearing]
    found += [(loc, torque) for loc, drive in declared_drives(train) for torque in drive.torques]
    named = next((torque for _, torque in found if torque.unit is not None), None)
    for loc, torque in found:
        if named is not None and torque.unit is None and torque.value:
            why = f"'{named}' has a unit, this has none"
            fix = "write all loads, bearings and drives in one way"
            yield Problem(f"torques mix units: '{torque}'", why, fix, train.place(*loc))
            return


def declared_drives(train: Train) -> Iterator[tuple[Loc, Drive]]:
    """The drives of the train and of its states, with where they stand."""
    if train.drive is not None:
        yield ("drive",), train.drive
    for name, state in train.states.items():
        if state.drive is not None:
            yield ("states", name, "drive"), state.drive


def rates(train: Train) -> Iterator[Problem]:
    """A rate that is said twice."""
    if train.rate is not None and train.drive is not None and train.drive.rate is not None:
        why = f"`rate` says {train.rate} and `drive` says {train.drive.rate}"
        yield Problem("the rate is declared twice", why, "leave one of them out", train.place("drive", "rate"))


def target_units(train: Train, target: Target, loc: Loc) -> Iterator[Problem]:
    """A period that no row names, or that is of another kind than the train's unit."""
    place = train.place(*loc)
    if target.name is not None:
        row = period_table().get(target.name)
        if row is None:
            yield Problem(
                f"no astronomical period '{target.name}'",
                "the shipped table has no such row",
                suggested_period(target.name),
                place,
            )
            return
        if row.kind == "count":
            yield Problem(
                f"'{target.name}' is a count",
                "a pointer shows a speed or a period",
                "choose a row of kind period or speed",
                place,
            )
            return
        if row.kind == "speed" and not (train.unit and train.unit.per.startswith("year")):
            yield Problem(
                f"'{target.name}' is a speed per year",
                "the train's unit is no year",
                "declare a year as `unit`, or give a period",
                place,
            )
            return
    length = train.unit_quantity is not None and train.unit_quantity.dimension == "length"
    if target.period is not None and target.period.dimension == "length":
        if not length:
            yield Problem(
                f"'{target.period}' is no target here",
                "the train's unit is not a length",
                "declare `unit: {per: ...}` as a length",
                place,
            )
    elif target.speed is None and train.unit_days is None:
        yield Problem(
            "a period is no target here",
            "the train's unit is not a time",
            "declare `unit: {per: ...}` as a time",
            place,
        )


def _epoch_units(train: Train) -> Iterator[Problem]:
    """A date that nothing leads away from: the train's unit is no time."""
    if train.epoch is not None and train.unit_days is None:
        yield Problem(
            "an epoch without a unit of time",
            f"turns become days by `unit`, and {f'{train.unit.per} is no time' if train.unit else 'there is none'}",
            "declare `unit: {per: ...}` as a time, such as year_tropical_J2000",
            train.place("epoch"),
        )


def declared_units(train: Train) -> Iterator[Problem]:
    """A unit of the train that is none, a date without one, and lengths with and without units side by side."""
    yield from _epoch_units(train)
    if train.unit is not None and train.unit.per not in period_table() and train.unit_quantity is None:
        yield Problem(
            f"'{train.unit.per}' is no unit",
            "it is neither a row of the shipped table nor a time or length",
            suggested_period(train.unit.per),
            train.place("unit"),
        )
    elif (
        train.unit is not None and train.unit.per in period_table() and period_table()[train.unit.per].kind != "period"
    ):
        yield Problem(
            f"'{train.unit.per}' is no period",
            "a unit is one turn per a time or a length",
            "name a row of kind period",
            train.place("unit"),
        )
    elif train.unit_quantity is not None and train.unit_quantity.value <= 0:
        yield Problem(
            f"'{train.unit_quantity}' is no unit",
            "a speed of 1 is one turn per that, and it must take something",
            "give a time or a length above 0",
            train.place("unit"),
        )
    plain: list[Loc] = []
    named: list[Loc] = []
    for label, axis in train.axes.items():
        for length in axis.position or ():
            if length.value:
                (plain if length.unit is None else named).append(("axes", label))
    for at, coupling in enumerate(train.couplings):
        for size in (coupling.pin_radius, coupling.offset, coupling.clearance, getattr(coupling, "pin_diameter", None)):
            if size is not None and size.value:
                (plain if size.unit is None else named).append(("couplings", at))
    if plain and named:
        yield Problem(
            "lengths mix plain numbers and units",
            f"`{dotted(named[0])}` has a unit, this has none",
            "write all lengths in one way",
            train.place(*plain[0]),
        )
