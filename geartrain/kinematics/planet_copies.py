"""Equal planets declared by the key `copies`, and the expanded train in which each planet is declared separately.

One planet determines all speeds, because equal planets have equal speeds. Assembly conditions, loads, drawings and
parts lists require all planets; see docs/theory.md, section 6.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import tau
from typing import TypeVar, overload

from geartrain.errors import DeclarationError, Loc, Problem
from geartrain.kinematics.circuits import Tree
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.quantity import Figure, Quantity
from geartrain.numerics.vectors import minus, plus, turned
from geartrain.teeth.coupling import Coupling
from geartrain.train import GearPair, Link, Train
from geartrain.train.mechanism import Axis, Revolute

_Part = TypeVar("_Part")


def has_copies(train: Train) -> bool:
    """Return True if a link is declared with `copies` above 1."""
    return any(part.copies > 1 for part in train.links.values())


def check_copies(train: Train, tree: Tree) -> None:
    """Raise `DeclarationError` if links with `copies` cannot be spaced around a carrier or connected to their mates."""
    if problems := tuple(_problems(train, tree)):
        raise DeclarationError(problems)


def with_copies(train: Train, tree: Tree) -> Train:
    """Return the train with every equal planet as a separate link (`p`, `p.2`, `p.3`), with its own pairs and axes.

    Loads and bearings apply to each planet. Declared positions and directions of axes are rotated about the axis of the
    carrier.
    """
    return _Expansion(train, tree).train() if has_copies(train) else train


def originals(train: Train) -> dict[str, str]:
    """Return the name of the declared link from which each link of the expanded train was copied, by link."""
    own = {link: link for link in train.links}
    return own | {_copy_name(link, at): link for link, part in train.links.items() for at in range(2, 1 + part.copies)}


def original(name: str, declared: Container[str]) -> str:
    """Return the declared name of a part of the expanded train; `declared` contains all declared names of its kind."""
    return name if name in declared else name.rpartition(".")[0]


def as_one(train: Train) -> Train:
    """Return the train in which one planet has the total mass, inertia and stiffness of all its copies."""
    if not has_copies(train):
        return train
    links = {name: _with_total_inertia(train, part) for name, part in train.links.items()}
    gears = tuple(_with_total_stiffness(train, gear) for gear in train.gears)
    states = train.states.items()
    return train.changed(
        links=FrozenDict(links),
        gears=gears,
        loads=_total_loads(train, train.loads),
        states=FrozenDict({name: state.changed(loads=_total_loads(train, state.loads)) for name, state in states}),
    )


def _with_total_inertia(train: Train, part: Link) -> Link:
    number = part.copies
    if number == 1:
        return part
    wheels = {}
    for name, wheel in part.wheels.items():
        # mass of wheels follows from their density, so it is multiplied too
        density = wheel.density or train.density
        wheels[name] = wheel.changed(density=_multiplied(density, number)) if density else wheel
    bearing = part.bearing
    if bearing is not None:
        sliding, static = _multiplied(bearing.sliding, number), _multiplied(bearing.static, number)
        bearing = bearing.changed(sliding=sliding, static=static)
    return part.changed(
        copies=1,
        wheels=FrozenDict(wheels),
        inertia=_multiplied(part.inertia, number),
        mass=_multiplied(part.mass, number),
        drag=_multiplied(part.drag, number),
        bearing=bearing,
    )


def _pair_count(train: Train, gear: GearPair) -> int:
    """Return the number of equal gear pairs that a declared pair represents."""
    return max(train.links[train.wheels[wheel][0]].copies for wheel in gear.pair)


def _with_total_stiffness(train: Train, gear: GearPair) -> GearPair:
    number = _pair_count(train, gear)
    if number == 1:
        return gear
    stiffness, damping = train.stiffness_of(gear), train.damping_of(gear)
    return gear.changed(stiffness=_multiplied(stiffness, number), damping=_multiplied(damping, number))


def _total_loads(train: Train, loads: Mapping[str, Quantity] | None) -> Mapping[str, Quantity] | None:
    if not loads:
        return loads
    return FrozenDict({link: _multiplied(torque, train.links[link].copies) for link, torque in loads.items()})


@overload
def _multiplied(quantity: Quantity, number: int) -> Quantity: ...


@overload
def _multiplied(quantity: Quantity | None, number: int) -> Quantity | None: ...


def _multiplied(quantity: Quantity | None, number: int) -> Quantity | None:
    if quantity is None or number == 1:
        return quantity
    return replace(quantity, value=quantity.value * number, text=f"{number} x {quantity.text}")


def _problems(train: Train, tree: Tree) -> Iterator[Problem]:
    for link, part in train.links.items():
        bearer = tree.top.get(link)
        if part.copies == 1:
            if bearer in train.links and (number := train.links[bearer].copies) > 1:
                what = f"'{link}' is declared once, but turns on '{bearer}' with `copies: {number}`"
                fix = (
                    f"declare `copies: {number}` for this link too; or, if all copies share one '{link}', add a link "
                    "coaxial with the carrier on which it turns, with the coupling "
                    f"`{{kind: parallel, pin: {bearer}, slot: added}}` (see `rv-reducer`)"
                )
                why = f"each of the {number} links '{bearer}' would need its own '{link}'"
                yield Problem(what, why, fix, train.place("links", link))
            continue
        if bearer is None or bearer == train.frame:
            what = f"{part.copies} links '{link}' have no carrier"
            why = "equal planets are spaced about the axis of their carrier, and the frame has no single axis"
            fix = "declare a carrier on which they turn, and fix it if it is at rest: `fixed: [carrier]`"
            yield Problem(what, why, fix, train.place("links", link))
        elif train.links[bearer].copies not in (1, part.copies):
            yield _unequal(train, link, bearer, "links", link)
    yield from _unequal_mates(train)
    yield from _name_conflicts(train)


def _name_conflicts(train: Train) -> Iterator[Problem]:
    """Yield a problem for each declared name that equals the generated name of a copy."""
    axes = {*train.axes, *(joint.axis for joint in train.revolutes)}
    ids = {gear.id for gear in train.gears}
    for link, part in train.links.items():
        mine = {joint.axis for joint in train.revolutes if train.frame not in joint.pair and link in joint.pair}
        pairs = [gear.id for gear in train.gears if gear.id and link in {train.wheels[wheel][0] for wheel in gear.pair}]
        # copy 1 has the declared name
        for at in range(2, 1 + part.copies):
            for kind, own, all_of in (
                ("link", [link], train.links),
                ("wheel", part.wheels, train.wheels),
                ("axis", mine, axes),
                ("gear pair", pairs, ids),
            ):
                for name in own:
                    if (taken := _copy_name(name, at)) in all_of:
                        what = f"{kind} '{taken}' is declared, but copy {at} of '{name}' has the same name"
                        why = f"copies of link '{link}' and of its parts have generated names, numbered from 2"
                        yield Problem(what, why, f"rename '{taken}'", train.place("links", link))


def _unequal_mates(train: Train) -> Iterator[Problem]:
    for at, gear in enumerate(train.gears):
        first, second = (train.wheels[wheel][0] for wheel in gear.pair)
        counts = {train.links[link].copies for link in (first, second)}
        # a single mate is shared by all copies
        if len(counts) > 1 and 1 not in counts:
            yield _unequal(train, first, second, "gears", at)
    for at, coupling in enumerate(train.couplings):
        links = coupling.links(train.wheels)
        # some kinds keep several equal links parallel to a single link
        allowed = coupling.FOR_COPIES and any(train.links[link].copies == 1 for link in links)
        for link in links:
            if train.links[link].copies > 1 and not allowed:
                what = f"coupling '{coupling.name}' cannot connect {train.links[link].copies} equal links '{link}'"
                fix = "declare these links one by one, each with its coupling"
                why = "copies have equal motions and equal pairs, but this coupling connects each one differently"
                yield Problem(what, why, fix, train.place("couplings", at))


def _unequal(train: Train, first: str, second: str, *loc: str | int) -> Problem:
    counts = [train.links[link].copies for link in (first, second)]
    what = f"{counts[0]} links '{first}' cannot be connected to {counts[1]} links '{second}'"
    return Problem(what, f"each '{first}' needs its own '{second}'", "give both the same `copies`", train.place(*loc))


@dataclass(frozen=True)
class _Expansion:
    """Expansion of a train in which every copy of a part becomes a separate part; copy 1 is the declared part."""

    declared: Train
    tree: Tree

    def train(self) -> Train:
        links: dict[str, Link] = {}
        for name, part in self.declared.links.items():
            links[name] = part.changed(copies=1)
            for at in self._further_copies(name):
                links[_copy_name(name, at)] = self._link(part, at)
        axes = dict(self.declared.axes)
        for joint in self.declared.revolutes:
            for at in self._further_copies(*joint.pair):
                if joint.axis in self.declared.axes:
                    axes[_copy_name(joint.axis, at)] = self._axis(joint.axis, at)
        joints = self._all_copies(self.declared.revolutes, lambda joint: joint.pair, self._joint)
        wheels = self.declared.wheels
        gears = self._all_copies(
            self.declared.gears, lambda gear: [wheels[wheel][0] for wheel in gear.pair], self._gear
        )
        couplings = self._all_copies(self.declared.couplings, lambda each: each.links(wheels), self._coupling)
        # a declared load share is the total for all copies
        shared = []
        for at, gear in gears:
            number = _pair_count(self.declared, self.declared.gears[at])
            divided = None if gear.share is None or number == 1 else Figure.parse(str(gear.share.value / number))
            shared.append(gear if divided is None else gear.changed(share=divided))
        states = self.declared.states
        made = self.declared.changed(
            links=FrozenDict(links),
            axes=FrozenDict(axes),
            revolutes=tuple(joint for _, joint in joints),
            gears=tuple(shared),
            couplings=tuple(coupling for _, coupling in couplings),
            loads=self._loads(self.declared.loads),
            states=FrozenDict({name: state.changed(loads=self._loads(state.loads)) for name, state in states.items()}),
        )
        parts: dict[str, Sequence[tuple[int, object]]]
        parts = {"revolutes": joints, "gears": gears, "couplings": couplings}
        indices = {key: [index for index, _ in copies] for key, copies in parts.items()}
        # messages about copies name the line of the declared part
        made._marks = _Places(self.declared, indices)
        return made

    # ------------------------------------------------------------------------------------------------------- one part

    def _further_copies(self, *links: str) -> range:
        """Return the numbers, from 2, of the further copies of a joint or pair between the given links."""
        return range(2, 1 + max(self.declared.links[link].copies for link in links))

    def _all_copies(
        self, parts: Sequence[_Part], links_of: Callable[[_Part], Iterable[str]], copy: Callable[[_Part, int], _Part]
    ) -> list[tuple[int, _Part]]:
        """Return each joint, pair or coupling and its further copies, with the index of the declared part."""
        found = []
        for index, part in enumerate(parts):
            copies = [copy(part, at) for at in self._further_copies(*links_of(part))]
            found += [(index, each) for each in (part, *copies)]
        return found

    def _copied_link(self, link: str, at: int) -> str:
        """Return the name of copy number `at` of a link. A link without copies keeps its name."""
        return _copy_name(link, at) if self.declared.links[link].copies > 1 else link

    def _link(self, part: Link, at: int) -> Link:
        wheels = {_copy_name(name, at): wheel for name, wheel in part.wheels.items()}
        # the angles of the teeth of copies follow from their positions
        return part.changed(copies=1, wheels=FrozenDict(wheels), angle=None)

    def _joint(self, joint: Revolute, at: int) -> Revolute:
        first, second = (self._copied_link(link, at) for link in joint.pair)
        return joint.changed(pair=(first, second), axis=_copy_name(joint.axis, at))

    def _gear(self, gear: GearPair, at: int) -> GearPair:
        own = {}
        for wheel in gear.pair:
            copied = self.declared.links[self.declared.wheels[wheel][0]].copies > 1
            own[wheel] = _copy_name(wheel, at) if copied else wheel
        driver = None if gear.driver is None else own[gear.driver]
        # without `phase`, because the phase of a copy follows from its position
        return gear.changed(pair=tuple(own.values()), driver=driver, phase=None, id=gear.id and _copy_name(gear.id, at))

    def _coupling(self, coupling: Coupling, at: int) -> Coupling:
        links = {link: self._copied_link(link, at) for link in coupling.ends}
        return coupling.renamed(links, coupling.id and _copy_name(coupling.id, at))

    def _loads(self, loads: Mapping[str, Quantity] | None) -> Mapping[str, Quantity] | None:
        """Return the loads of the expanded train, in which a torque on a planet acts on each of its copies."""
        if not loads:
            return loads
        found = dict(loads)
        for link, torque in loads.items():
            found.update((_copy_name(link, at), torque) for at in self._further_copies(link))
        return FrozenDict(found)

    # ---------------------------------------------------------------------------------------------------------- places

    def _axis(self, label: str, at: int) -> Axis:
        """Return the axis of copy number `at` of a planet: the declared axis `label`, rotated about the axis of the
        carrier.
        """
        carrier, number = self._carriers[label]
        about = self.declared.axes.get(self.tree.axis(carrier) or "", Axis())
        axis, angle = self.declared.axes[label], tau * (at - 1) / number
        changes: dict[str, object] = {
            "direction": tuple(Figure.parse(_decimal(part)) for part in turned(axis.way, about.way, angle))
        }
        if axis.point is not None:
            if about.point is None:
                what = f"the positions of copies of axis '{label}' are unknown"
                fix = f"give axis '{self.tree.axis(carrier)}' a position, or remove the position of '{label}'"
                why = "copies are spaced about the axis of their carrier, which has no position"
                raise DeclarationError([Problem(what, why, fix, self.declared.place("axes", label))])
            # rotation about the carrier's axis, which may not pass through the origin
            place = plus(about.point, turned(minus(axis.point, about.point), about.way, angle))
            changes["position"] = tuple(Quantity.parse(f"{_decimal(part)} mm", "length", plain=False) for part in place)
        return axis.changed(**changes)

    @cached_property
    def _carriers(self) -> Mapping[str, tuple[str, int]]:
        """Carrier and number of copies of the link on each axis, for the axes of links with copies."""
        found = {}
        for link, (_, axis) in self.tree.parent.items():
            number, carrier = self.declared.links[link].copies, self.tree.top[link]
            # a link on a copied planet is spaced about the carrier of the planet
            while self.declared.links[carrier].copies > 1:
                carrier = self.tree.top[carrier]
            if number > 1:
                found[axis] = carrier, number
        return found


@dataclass(frozen=True)
class _Places:
    """Function that converts the path of a part in the expanded train to the file and line of the declared part."""

    declared: Train
    indices: Mapping[str, list[int]]

    def __call__(self, loc: Loc) -> str:
        if not loc:
            return self.declared.place()
        first, *rest = loc
        if first in self.indices and rest and isinstance(rest[0], int):
            rest[0] = self.indices[str(first)][rest[0]]
        elif first in ("links", "axes"):
            rest = [part if not isinstance(part, str) else self._declared(part) for part in rest]
        return self.declared.place(first, *rest)

    def _declared(self, name: str) -> str:
        known = name in self.declared.links or name in self.declared.axes or name in self.declared.wheels
        return name if known else name.rpartition(".")[0] or name


def _copy_name(name: str, at: int) -> str:
    return f"{name}.{at}"


def _decimal(part: float) -> str:
    """Return a number as text with at most 15 digits; rounding errors are removed."""
    # lengths below 1e-9 mm are out of range
    return f"{round(part, 13):.15g}" if abs(part) >= 1e-9 else "0"
