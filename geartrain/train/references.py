"""Checks of references between parts, and of combinations of wheels, pairs, prescriptions and units."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import combinations, pairwise
from math import hypot, pi, remainder
from typing import Any

from geartrain.errors import Loc, Problem, dotted, suggest
from geartrain.numerics.quantity import Quantity, as_rotation, units_of
from geartrain.train.declaration import Train
from geartrain.train.manufacturing import material_table
from geartrain.train.mechanism import Joint
from geartrain.train.outputs import Output, PrintedPeriod, Published, Target, year_seconds
from geartrain.train.periods import period_table, suggested_period
from geartrain.train.reconstruction import NEW_ARBOR
from geartrain.train.states import Drive, State

# ----------------------------------------------------------------------------------------------------- unit consistency


def mixed_inputs(train: Train) -> Iterator[Problem]:
    """Yield a problem if inputs with and without units are mixed, or have units that do not fit the train's unit."""
    inputs = [
        ((*loc, "inputs", link), speed)
        for loc, part in train.cases_declared
        for link, speed in (part.inputs or {}).items()
    ]
    named = next((each for each in inputs if as_rotation(each[1]).unit is not None), None)
    plain = next((each for each in inputs if as_rotation(each[1]).unit is None and each[1].value), None)
    if named is None:
        return
    if plain is not None:
        kind = "number without a unit" if plain[1].unit is None else "travel per `unit`, not per time"
        why = f"'{plain[1]}' is a {kind} and '{named[1]}' has a unit"
        what, fix = "inputs with and without units are mixed", "give all inputs a unit, or none"
        yield Problem(what, why, fix, train.place(*plain[0]))
    if train.unit is not None and train.unit_days is None:
        what = f"the input '{named[1]}' does not match the `unit` of the train"
        why = f"the input is a speed per time, but `unit` is one turn per {train.unit.per}, which is not a time"
        fix = "write all inputs as numbers without a unit, or give a time, such as `unit: {per: 1 h}`"
        yield Problem(what, why, fix, train.place(*named[0]))


def mixed_torques(train: Train) -> Iterator[Problem]:
    """Yield a problem if torques with and without units are mixed. Torques of 0 are accepted with or without a unit."""
    found = [
        ((*loc, "loads", link), torque)
        for loc, part in train.cases_declared
        for link, torque in (part.loads or {}).items()
    ]
    found += [(("links", name, "bearing"), part.bearing.sliding) for name, part in train.links.items() if part.bearing]
    found += [(("couplings", at), each) for at, coupling in enumerate(train.couplings) for each in coupling.torques]
    drives = [((*loc, "drive"), part.drive) for loc, part in train.cases_declared if part.drive is not None]
    found += [(loc, torque) for loc, drive in drives for torque in drive.torques]
    named = next((torque for _, torque in found if torque.unit is not None), None)
    for loc, torque in found:
        if named is not None and torque.unit is None and torque.value:
            why = f"'{named}' has a unit, but this value has none"
            fix = "give all loads, bearings and drives a unit, or none"
            yield Problem(f"torques with and without units are mixed: '{torque}'", why, fix, train.place(*loc))
            return


_TARGET_KEYS = "write a speed as `{speed: 5/19}`, a time as `{period: 365.25 d}`, turns as `{name: NAME, turns: 5}`"


def target_units(train: Train, target: Target, loc: Loc) -> Iterator[Problem]:
    """Yield a problem if a target is unknown, is a count, or has another dimension than the train's unit."""
    place = train.place(*loc)
    if target.name is not None:
        row = period_table().get(target.name)
        if row is None:
            what = f"unknown astronomical period '{target.name}'"
            # a name that begins with a digit was probably meant as a speed or a period
            fix = _TARGET_KEYS if re.match(r"[\d+-]", target.name) else suggested_period(target.name)
            yield Problem(what, "a target given as a string is a name in the table of periods", fix, place)
            return
        if row.kind == "count":
            what, fix = (
                f"'{target.name}' is a count and cannot be a target",
                "choose a period or a speed listed by `geartrain periods`",
            )
            yield Problem(what, "a target is a speed or a period", fix, place)
            return
        # speeds of the table are in turns per year
        if row.kind == "speed" and not (train.unit and train.unit.per.startswith("year")):
            what, why = f"'{target.name}' is a speed in turns per year", "the train's unit is not a year"
            yield Problem(what, why, "add `unit: {per: year_tropical_J2000}`, or give a period", place)
            return
    length = train.unit_quantity is not None and train.unit_quantity.dimension == "length"
    if target.period is not None and target.period.dimension == "length":
        if not length:
            what, why = f"the target '{target.period}' is a length", "the train's unit is not a length"
            yield Problem(what, why, "for example, add `unit: {per: 18 ft}`", place)
    elif target.speed is None and train.unit_days is None:
        why = "the train's unit is not a time" if train.unit else "the train has no unit of time"
        fix = "for example, add `unit: {per: 1 d}`: a speed of 1 is then one turn per day"
        yield Problem("a period cannot be a target of this train", why, fix, place)


def published_units(train: Train, published: Published, loc: Loc) -> Iterator[Problem]:
    """Yield a problem if a published period requires a unit of time, or a length of the year, that is not declared."""
    printed = published.value
    if not isinstance(printed, PrintedPeriod):
        return
    unit = None if train.unit_speed is None else 1 / train.unit_speed
    if unit is None:
        what = f"the printed period '{printed}' needs `unit: {{per: ...}}`"
        why = "the train's unit is not a time" if train.unit else "the train has no unit of time"
        fix = "for example, add `unit: {per: 1 d}`: a speed of 1 is then one turn per day"
        yield Problem(what, why, fix, train.place(*loc))
    elif printed.years and year_seconds(unit) is None:
        what = f"the length of the years of '{printed}' is not known"
        why = "there are several kinds of year, and y is the `unit` of the train only if this unit is a year"
        yield Problem(what, why, "write the period in days, or declare `unit: {per: 365.25 d}`", train.place(*loc))


def set_outputs(train: Train) -> Iterator[Problem]:
    """Yield a problem if two outputs set one link at the epoch, or if a link is set after an output relative to it."""
    used: dict[str, str] = {}  # links that are set or referred to, with the output
    for name, output in train.outputs.items():
        of, base = output.links(name, train.frame)
        if output.at_epoch is not None and of in used:
            why = "a link has one angle at the epoch, before outputs that are relative to it"
            fix = f"remove one `at_epoch`, or move '{name}' above '{used[of]}'"
            yield Problem(f"'{used[of]}' and '{name}' both need '{of}'", why, fix, train.place("outputs", name))
        if output.at_epoch is not None:
            used = {base: name} | used | {of: name}


def _suggested_unit(train: Train, per: str) -> str:
    """Return the text of a fix for a unit that cannot be read."""
    number, name = re.fullmatch(r"([\d./ ]*)(.*)", per.strip(), re.DOTALL).groups()  # type: ignore[union-attr]
    if name in ("rpm", "turn/s", "deg/s", "rad/s"):
        link = next(iter(train.inputs), "sun")
        return f"omit `unit`, and write inputs with their unit: `inputs: {{{link}: 30 {name}}}`"
    if name in ("y", "yr", "year", "years"):
        return "years have several lengths: write `unit: {per: year_tropical_J2000}`, `year_julian` or `365.25 d`"
    otherwise = f"for example, write `unit: {{per: {number.strip() or 1} h}}`; units: {units_of('time or length')}"
    return otherwise if number.strip() else suggest(name, period_table(), otherwise=otherwise, wide=True)


def declared_units(train: Train) -> Iterator[Problem]:
    """Yield a problem for an invalid unit, an epoch without a unit of time, and lengths with and without units."""
    if train.epoch is not None and train.unit_days is None:
        reason = f"{train.unit.per} is not a time" if train.unit else "none is declared"
        fix = "for example, add `unit: {per: year_tropical_J2000}`"
        place = train.place("epoch")
        yield Problem("the epoch needs a unit of time", f"`unit` converts turns to days; {reason}", fix, place)
    if train.unit is not None:
        per, quantity, place = train.unit.per, train.unit_quantity, train.place("unit")
        row = period_table().get(per)
        if row is None and quantity is None:
            why = "`per` is a time, a length, or a period listed by `geartrain periods`"
            yield Problem(f"'{per}' is not a unit", why, _suggested_unit(train, per), place)
        elif row is not None and row.kind != "period":
            why = "a speed of 1 is one turn per period, time or length"
            fix = "give a time, a length or a period listed by `geartrain periods`"
            yield Problem(f"'{per}' is not a period", why, fix, place)
        elif quantity is not None and quantity.value <= 0:
            what, why = f"a unit must be greater than 0, not '{quantity}'", "a speed of 1 means one turn per unit"
            yield Problem(what, why, "give a time or a length above 0", place)
    lengths: list[tuple[Loc, Quantity]]
    lengths = [(("axes", label), length) for label, axis in train.axes.items() for length in axis.position or ()]
    lengths += [(("couplings", at), size) for at, coupling in enumerate(train.couplings) for size in coupling.lengths]
    plain = next((loc for loc, length in lengths if length.value and length.unit is None), None)
    named = next((loc for loc, length in lengths if length.value and length.unit is not None), None)
    if plain is not None and named is not None:
        what, why = "lengths with and without units are mixed", f"`{dotted(named)}` has a unit, but this value has none"
        yield Problem(what, why, "give all lengths a unit, or none", train.place(*plain))


# ----------------------------------------------------------------------------------------------------------- references


def find_problems(train: Train) -> Iterator[Problem]:
    """Yield a problem for every unresolved reference and every invalid combination in a train."""
    if train.remove is not None and train.extends is None:
        what, why = "`remove` is given without `extends`", "it removes parts of a parent, and no parent is named"
        yield Problem(what, why, "add `extends: parent.yaml`, or delete `remove`", train.place("remove"))
    yield from _links(train)
    yield from _wheels(train)
    yield from _materials(train)
    yield from _couplings(train)
    known: dict[str, Collection[str]] = {
        "link": train.links,
        "wheel": train.wheels,
        "dial": train.dials,
        "clutch": train.clutches,
        "source": train.sources,
        "output, link, wheel, dial or coupling": train.tour_parts,
    }
    for kind, name, loc in _references(train):
        if name is not None and name not in known[kind]:
            yield _unknown(train, kind, name, known[kind], *loc)
    yield from _prescriptions(train)
    yield from _one_way(train)
    yield from _dials(train)
    yield from _reconstruction(train)
    yield from declared_units(train)
    yield from set_outputs(train)


_HOMES = {
    "link": "links: {{{}: {{}}}}",
    "clutch": "clutches: {{{}: {{fixes: {link}}}}}",
    "dial": "dials: {{{}: {{}}}}",
    "source": "sources: {{{}: author and year}}",
}
"""Templates of declarations for parts to which other parts refer by name, by the kind of the part."""


def _unknown(train: Train, kind: str, name: str, known: Iterable[str], *loc: str | int) -> Problem:
    names = list(known)
    # a long list of names would hide the fix
    few = f"use one of: {', '.join(names)}; or " if 0 < len(names) <= 12 else "correct the name, or " if names else ""
    link = next((link for link in train.links if link != train.frame), train.frame)
    if kind == "link" and name in train.wheels:
        owner = next(link for link, each in train.links.items() if name in each.wheels)
        why = f"'{name}' is a wheel of the link '{owner}'"
        return Problem(f"no link '{name}'", why, f"write '{owner}'", train.place(*loc))
    line = f"`{_HOMES[kind].format(name, link=link)}`" if kind in _HOMES else f"the {kind}"
    fix = suggest(name, names, otherwise=f"{few}declare {line}")
    return Problem(f"no {kind} '{name}'", f"`{dotted(loc)}` refers to it", fix, train.place(*loc))


def _unknown_wheel(train: Train, name: str, at: int) -> Problem:
    """Return the problem of a gear pair that names an unknown wheel, or a link instead of its wheel."""
    unknown = _unknown(train, "wheel", name, train.wheels, "gears", at, "pair")
    if name not in train.links:
        return unknown
    own = ", ".join(train.links[name].wheels)
    if not own:
        why, fix = f"'{name}' is a link without wheels", f"declare its wheel: `{name}: {{wheels: {{w: 20}}}}`"
    else:
        why, fix = f"'{name}' is a link, and a pair names two wheels", f"write one of its wheels: {own}"
    return Problem(unknown.what, why, fix, unknown.place)


def _links(train: Train) -> Iterator[Problem]:
    links: Collection[str] = train.links
    if train.reconstruct is not None:  # evidence need not declare the frame
        links = {train.frame, *links}
    if train.frame not in links and "frame" not in train.model_fields_set:
        why = "it is the fixed link, unless the key `frame` names another one"
        fix = f"add `frame: {{}}` to `links`, or name the fixed link: `frame: {next(iter(links), 'case')}`"
        yield Problem("no link 'frame'", why, fix, train.place("links"))
    elif train.frame not in links:
        yield _unknown(train, "link", train.frame, links, "frame")
    labels = set()
    joints: list[tuple[str, str, int, Joint]]
    joints = [("revolutes", "turning", at, joint) for at, joint in enumerate(train.revolutes)]
    joints += [("slides", "sliding", at, joint) for at, joint in enumerate(train.slides)]
    for key, kind, at, joint in joints:
        labels.add(joint.axis)
        for link in joint.pair:
            if link not in links and link != train.frame:
                yield _unknown(train, "link", link, links, key, at, "pair")
        if joint.pair[0] == joint.pair[1]:
            what, why = f"a {kind} pair connects '{joint.pair[0]}' to itself", "its two links must be different"
            yield Problem(what, why, "name the other link", train.place(key, at))
    for label in train.axes:
        if label not in labels:
            yield _unknown(train, "turning pair with the axis", label, labels, "axes", label)


def _materials(train: Train) -> Iterator[Problem]:
    """Yield a problem for each named material that is neither declared nor in the shipped table of materials."""
    named: list[tuple[str, Loc]] = [(train.material, ("material",))] if train.material is not None else []
    for link, part in train.links.items():
        if part.arbor is not None:
            named.append((part.arbor.material, ("links", link, "arbor", "material")))
        for name, wheel in part.wheels.items():
            if wheel.material is not None:
                named.append((wheel.material, ("links", link, "wheels", name, "material")))
    for name, loc in named:
        if name not in train.materials and name not in material_table():
            known = [*train.materials, *material_table()]
            otherwise = f"declare it in `materials`, or use one of: {', '.join(known)}"
            what, why = f"no material '{name}'", f"`{dotted(loc)}` refers to it"
            yield Problem(what, why, suggest(name, known, otherwise=otherwise), train.place(*loc))


def _measured(train: Train, link: str, wheel: str) -> Iterator[Problem]:
    """Yield a problem for measurements that are not one per tooth, and for measured angles that do not increase."""
    count, cutting = train.links[link].wheels[wheel].count, train.links[link].wheels[wheel].cutting
    if cutting is None or cutting.measured is None or count is None:
        return
    measured, loc = cutting.measured, ("links", link, "wheels", wheel, "cutting", "measured")
    lengths = {name: len(column) for name, column in measured.columns.items()}
    if measured.angles is not None:
        lengths["angles"] = len(measured.angles) + measured.missing
    for name, length in lengths.items():
        if length != count:
            what = f"'{name}' has {length} measured values, but wheel '{wheel}' has {count} teeth"
            why = "a table has one value for each tooth, in the order of rotation"
            fix = "complete the table, or correct the tooth count"
            fix += ", or give the number of `missing` teeth after the last angle" if name == "angles" else ""
            yield Problem(what, why, fix, train.place(*loc, name))
            return
    given = [(at, each.si) for at, each in enumerate(measured.angles or ()) if each is not None]
    for (one, before), (two, after) in pairwise(given):
        even = (two - one) * 2 * pi / count
        if not abs(remainder(after - before - even, 2 * pi)) < even:
            what = f"the measured angle of tooth {two + 1} of wheel '{wheel}' does not follow that of tooth {one + 1}"
            why = f"angles increase from tooth to tooth, by about {360 / count:.5g} deg"
            fix = "list the teeth in the order of rotation; measure angles in the sense opposite to the rotation"
            yield Problem(what, why, fix, train.place(*loc, "angles"))
            return


def _wheels(train: Train) -> Iterator[Problem]:
    if train.cutting is not None and train.cutting.measured is not None:
        what, why = "`measured` is declared for all wheels", "a table has one value for each tooth of one wheel"
        yield Problem(what, why, "move it to the `cutting` of its wheel", train.place("cutting", "measured"))
    owner: dict[str, str] = {}
    for link, part in train.links.items():
        for wheel in part.wheels:
            if wheel in owner:
                why, fix = f"it is on link '{owner[wheel]}' and on link '{link}'", "give one of the wheels another name"
                place = train.place("links", link, "wheels", wheel)
                yield Problem(f"wheel '{wheel}' is declared twice", why, fix, place)
            owner[wheel] = link
            yield from _measured(train, link, wheel)
    wheels, names = train.wheels, set()
    for at, gear in enumerate(train.gears):
        name, (first, second) = gear.name, gear.pair
        if name in names:
            yield _duplicate(train, "gear pair", name, "gears", at)
        names.add(name)
        if gear.driver is not None and gear.driver not in gear.pair:
            yield _unknown(train, "wheel of this pair", gear.driver, gear.pair, "gears", at, "driver")
        if first not in wheels or second not in wheels:
            for wheel in gear.pair:
                if wheel not in wheels:
                    yield _unknown_wheel(train, wheel, at)
            continue
        (link_1, wheel_1), (link_2, wheel_2) = wheels[first], wheels[second]
        # fast path for nearly all pairs: spur wheels on two links, at most one of them a ring
        if link_1 != link_2 and wheel_1.kind == wheel_2.kind == "spur" and not (wheel_1.internal and wheel_2.internal):
            continue
        place = train.place("gears", at, "pair")
        if link_1 == link_2:
            what = f"gear pair '{gear.name}' connects two wheels of the same link"
            why = f"'{first}' and '{second}' are both on link '{link_1}', so they cannot turn relative to each other"
            yield Problem(what, why, "put one of them on another link", place)
        elif wheel_1.internal and wheel_2.internal:
            what, why = f"gear pair '{gear.name}' connects two rings", "two wheels with internal teeth cannot mesh"
            yield Problem(what, why, "remove `internal: true` from one of them", place)
        elif wheel_1.kind == wheel_2.kind == "worm" or (
            "worm" in (wheel_1.kind, wheel_2.kind) and (wheel_1.internal or wheel_2.internal)
        ):
            what, why = f"gear pair '{gear.name}' is not a valid worm drive", "a worm meshes with an external wheel"
            yield Problem(what, why, "declare one worm and one external wheel", place)
    for at, coupling in enumerate(train.couplings):
        for name in dict.fromkeys((coupling.name, *coupling.row_names)):
            if name in names:
                yield _duplicate(train, "coupling", name, "couplings", at)
            names.add(name)


def _duplicate(train: Train, kind: str, name: str, *loc: str | int) -> Problem:
    why = "the ids of all pairs and couplings must be different"
    return Problem(f"{kind} '{name}' is declared twice", why, "give one of them another `id`", train.place(*loc))


def _couplings(train: Train) -> Iterator[Problem]:
    for at, coupling in enumerate(train.couplings):
        known = {"link": train.links, "wheel": train.wheels}
        # unknown names are reported as such
        if all(name in known[kind] for kind, name, _ in coupling.references()):
            yield from (Problem(*each, train.place("couplings", at)) for each in coupling.problems(train.wheels))


def _references(train: Train) -> Iterator[tuple[str, str | None, Loc]]:
    """Yield the kind, name (None if not given) and path of all references, except of turning and gear pairs."""
    loc: Loc
    for at, coupling in enumerate(train.couplings):
        yield from ((kind, name, ("couplings", at, *path)) for kind, name, path in coupling.references())
        yield "source", coupling.source, ("couplings", at)
    for loc, part in train.cases_declared:
        for key in ("inputs", "fixed", "loads"):
            yield from (("link", link, (*loc, key)) for link in getattr(part, key) or ())
        for at, pair in enumerate(part.locks or ()):
            yield from (("link", link, (*loc, "locks", at)) for link in pair)
        for name, output in part.outputs.items():
            yield from _output_references(train, name, output, (*loc, "outputs", name))
    if train.escapement is not None:
        yield "link", train.escapement.link, ("escapement", "link")
        yield "link", train.escapement.on, ("escapement", "on")
    for at, step in enumerate(train.tour):
        yield "output, link, wheel, dial or coupling", step.look_at, ("tour", at, "look_at")
    yield "link", train.crank, ("crank",)
    yield "link", train.solve_for, ("solve_for",)
    for name, clutch in train.clutches.items():
        yield from (("link", link, ("clutches", name)) for link in (*(clutch.locks or ()), clutch.fixes))
    for name, state in train.states.items():
        for key, named in (("engaged", state.engaged), ("free", state.free)):
            yield from (("clutch", clutch, ("states", name, key, at)) for at, clutch in enumerate(named))
    stated: list[tuple[Loc, Any]] = [((key,), getattr(train, key)) for key in ("epoch", "cutting", "fitting")]
    for link, each in train.links.items():
        for name, wheel in each.wheels.items():
            loc = ("links", link, "wheels", name)
            stated += [(loc, wheel), ((*loc, "cutting"), wheel.cutting)]
            if not isinstance(wheel.teeth, int):
                stated.append(((*loc, "teeth"), wheel.teeth))
    for at, gear in enumerate(train.gears):
        stated += [(("gears", at), gear), (("gears", at, "fitting"), gear.fitting)]
    stated += [(("dials", name), dial) for name, dial in train.dials.items()]
    stated.append((("dial_plate",), train.dial_plate))
    yield from (("source", part.source, loc) for loc, part in stated if part is not None)
    if train.reconstruct is not None:
        for at, pair in enumerate(train.reconstruct.apart):
            yield from (("wheel", wheel, ("reconstruct", "apart", at)) for wheel in pair)
        for at, given in enumerate(train.reconstruct.given):
            yield from (("link", link, ("reconstruct", "given", at, "pair")) for link in given.pair)
        if train.reconstruct.geometry is not None:
            for name in train.reconstruct.geometry.radii:
                yield "wheel", name, ("reconstruct", "geometry", "radii", name)


def _output_references(train: Train, name: str, output: Output, loc: Loc) -> Iterator[tuple[str, str | None, Loc]]:
    """Yield the references of an output. In a state or in evidence for a reconstruction, the link may be missing."""
    inherited = loc[0] == "states" and name in train.outputs and output.of is None
    to_be_found = train.reconstruct is not None and output.of in (None, NEW_ARBOR)
    if not inherited and not to_be_found:
        yield "link", output.of if output.of is not None else name, loc
    yield "link", output.relative_to, (*loc, "relative_to")
    yield "dial", output.dial, (*loc, "dial")
    if output.published:
        yield "source", output.published.source, (*loc, "published")
    yield from (("source", target.source, (*loc, "targets", at)) for at, target in enumerate(output.targets))


def _dials(train: Train) -> Iterator[Problem]:
    """Yield a problem for each pair of dials on a face whose engravings overlap; a dial may be inside another scale."""
    for (name, dial), (other, mate) in combinations(train.dials.items(), 2):
        one, two = dial.circle, mate.circle
        if one is None or two is None or (dial.face == "back") != (mate.face == "back"):
            continue
        x, y, apart = two[0] - one[0], two[1] - one[1], hypot(two[0] - one[0], two[1] - one[1])
        beside = one[2] * dial.reach(x, y) + two[2] * mate.reach(-x, -y)
        inside = max(one[2] * dial.clear - two[2], two[2] * mate.clear - one[2])
        over = min(beside - apart, apart - inside)
        if over > 0:
            what = f"dials '{name}' and '{other}' overlap by {over:.3g} mm"
            sizes = f"{2 * one[2]:.4g} and {2 * two[2]:.4g} mm"
            why = f"their centres are {apart:.4g} mm apart, and their diameters are {sizes}"
            fix = f"move `centre`, or reduce a `diameter` by {2 * over:.3g} mm"
            yield Problem(what, why, fix, train.place("dials", other))


def _prescriptions(train: Train) -> Iterator[Problem]:
    for loc, part in train.cases_declared:
        if train.frame in (part.inputs or ()):
            what, why = f"the frame '{train.frame}' is an input", "its speed is 0 by definition"
            yield Problem(what, why, "prescribe the speed of another link", train.place(*loc, "inputs"))
        for name, output in part.outputs.items():
            for at, target in enumerate(output.targets):
                yield from target_units(train, target, (*loc, "outputs", name, "targets", at))
            if output.published is not None:
                yield from published_units(train, output.published, (*loc, "outputs", name, "published"))
    yield from mixed_inputs(train)
    yield from mixed_torques(train)
    yield from sliding_problems(train)
    if train.rate is not None and train.drive is not None and train.drive.rate is not None:
        why = f"`rate` is {train.rate}, and the rate of `drive` is {train.drive.rate}"
        yield Problem("the rate is declared twice", why, "remove one of them", train.place("drive", "rate"))
    if train.escapement is not None and train.escapement.link == train.frame in train.links:
        what = f"the escapement is on the frame '{train.frame}', which does not turn"
        why, fix = "an escapement acts on a link that turns", "name the link of the escape wheel"
        yield Problem(what, why, fix, train.place("escapement", "link"))


def _one_way(train: Train) -> Iterator[Problem]:
    """Yield a problem for each clutch in the key `free` of a state that is not one-way, or that the state engages."""
    for name, state in train.states.items():
        for at, clutch in enumerate(state.free):
            place = train.place("states", name, "free", at)
            if clutch in train.clutches and train.clutches[clutch].one_way is None:
                why = "`free` disables one-way clutches, and other clutches are open unless they are engaged"
                yield Problem(f"'{clutch}' is not a one-way clutch", why, "omit it from `free`", place)
            elif clutch in state.engaged:
                why = "a one-way clutch cannot both hold and be disabled"
                yield Problem(f"'{clutch}' is engaged and free", why, "remove it from `engaged` or `free`", place)


def _reconstruction(train: Train) -> Iterator[Problem]:
    """Yield a problem for each wheel or link that `reconstruct` names although it is not declared or not suitable."""
    requested = train.reconstruct
    if requested is None:
        return
    if NEW_ARBOR in train.links:
        what = f"'{NEW_ARBOR}' is not allowed as the name of a surviving link"
        why = f"in evidence `of: {NEW_ARBOR}` means that the arbor of a pointer does not survive"
        yield Problem(what, why, "rename the link", train.place("links", NEW_ARBOR))
    if requested.carrier is not None and requested.carrier not in (*train.links, train.frame):
        yield _unknown(train, "link", requested.carrier, train.links, "reconstruct", "carrier")
    seen = {frozenset(gear.pair) for gear in train.gears}
    for at, pair in enumerate(requested.apart):
        if frozenset(pair) in seen:
            what, why = (
                f"'{pair[0]}' and '{pair[1]}' are declared to mesh and not to mesh",
                "the pair is also in `gears`",
            )
            yield Problem(what, why, "remove it from one of the two lists", train.place("reconstruct", "apart", at))
    for wheel in requested.geometry.radii if requested.geometry is not None else ():
        if wheel in train.wheels and train.wheels[wheel][1].module is not None:
            what = f"both a module and a pitch radius are given for '{wheel}'"
            why, fix = "one follows from the other and the tooth count", "give only the one that was measured"
            yield Problem(what, why, fix, train.place("reconstruct", "geometry", "radii", wheel))


# ----------------------------------------------------------------------------------------------------- links that slide

_IN_TURNS = ("turn", "rpm")
"""Prefixes of the units of rotation for which a travel per turn is defined."""


def sliding_problems(train: Train) -> Iterator[Problem]:
    """Yield a problem for each speed, load or property in turns or torques of a link that slides, and vice versa."""
    for loc, part in train.cases_declared:
        yield from _sliding_inputs(train, loc, part.inputs or {})
        yield from _sliding_loads(train, loc, part.loads or {})
        yield from _sliding_outputs(train, loc, part)
        if part.drive is not None:
            yield from _sliding_drive(train, (*loc, "drive"), part.drive)
    if train.rate is not None:
        yield from _sliding_drive(train, ("rate",), Drive(rate=train.rate))
    if train.sliding:
        yield from _sliding_links(train)


def _sliding_inputs(train: Train, loc: Loc, inputs: Mapping[str, Quantity]) -> Iterator[Problem]:
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


_PER_UNIT = "the speed of a sliding link is its travel per `unit`, or per turn if the train declares no `unit`"


def _sliding_loads(train: Train, loc: Loc, loads: Mapping[str, Quantity]) -> Iterator[Problem]:
    for link, load in loads.items():
        place, slides = train.place(*loc, "loads", link), link in train.sliding
        if slides and load.value and load.dimension != "force":
            what = f"'{link}' slides, but its load '{load}' is not a force"
            yield Problem(what, "the load of a slide is a force", f"give a force, such as `{link}: -100 N`", place)
        elif not slides and load.dimension == "force":
            what = f"'{link}' turns, but its load '{load}' is a force"
            fix = f"give a torque, such as `{link}: -2 N m`, or put the force on a link that slides"
            yield Problem(what, "the load of a turning link is a torque", fix, place)


def _sliding_outputs(train: Train, loc: Loc, part: Train | State) -> Iterator[Problem]:
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
            fix = "give a travel per `unit`, such as `{speed: 5 mm}`"
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
"""Properties that only turning links have, each with the fix that is reported for a sliding link."""


def _sliding_links(train: Train) -> Iterator[Problem]:
    for link in (link for link in train.links if link in train.sliding):
        part, place = train.links[link], train.place("links", link)
        for key in (key for key in _TURNING_ONLY if getattr(part, key) is not None):
            what, why = f"'{link}' slides and has no `{key}`", f"`{key}` belongs to a link that turns"
            yield Problem(what, why, _TURNING_ONLY[key], place)
        if part.copies > 1:
            what, why = f"'{link}' slides, but has {part.copies} copies", "copies are spaced about an axis"
            yield Problem(what, why, "declare them one by one", place)
    if train.escapement is not None and train.escapement.link in train.sliding:
        what, why = f"the escapement is on '{train.escapement.link}', which slides", "an escape wheel must turn"
        yield Problem(what, why, "name the link of the escape wheel", train.place("escapement", "link"))


def _sliding_drive(train: Train, loc: Loc, drive: Drive) -> Iterator[Problem]:
    """Yield a problem if a link that slides has a drive for links that turn, or vice versa."""
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
        why = "other drives turn a link" if drive.weight is None else "a weight on a drum turns a link"
        yield Problem(what, why, "give `drive: {weight: 4 kg}` without `drum`", place)
    elif not slides and drive.weight is not None and drive.drum is None:
        what = f"the weight at '{link}' has no `drum`"
        why = f"'{link}' turns, and the lever arm of the weight is needed"
        fix = "give `weight: 4 kg, drum: 20 mm`, or as `crank` the link of the weight, which slides"
        yield Problem(what, why, fix, place)
