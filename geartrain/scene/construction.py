"""Construction of the scene of a train: positions, outlines and motion of all its elements.

The transmission function of a pair gives the angle of the driven wheel for each angle of the driver, so that a
traversal from wheel to wheel determines all angles at which teeth mesh. If a wheel has several mates, only one of its
pairs is exact; in the other pairs, the driven wheel is rotated until the driver does not interfere with it.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.formulas import Formula, Formulas, find_formulas
from geartrain.kinematics.planet_copies import originals
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.vectors import Vector, across, azimuth, cross, dot, minus, size
from geartrain.scene.bodies import as_placed, bend, find_bodies, find_profiles, find_wheels
from geartrain.scene.context import SceneContext, exact
from geartrain.scene.coupling_shapes import find_shapes
from geartrain.scene.dial_pointers import (
    angles_at_start,
    find_dials,
    find_epoch,
    find_pointers,
    with_balls,
    with_titles,
)
from geartrain.scene.displays import drive_kind, find_displays, fusee_radii, upwards
from geartrain.scene.joints import find_couplings, find_elements, find_pairs, find_verdict
from geartrain.scene.layout import Layout, lay_out
from geartrain.scene.layout.train_layout import pitch_directions
from geartrain.scene.movement import MovementStart, find_movement
from geartrain.scene.scene_run import find_run
from geartrain.scene.train_scene import CountCondition, CountFormula, Scene, SceneFormulas, TourStop
from geartrain.train import Output

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.scene.elements import SceneBody, SceneWheel
    from geartrain.scene.scene_run import TimeRun
    from geartrain.scene.train_scene import Pointer
    from geartrain.teeth.gear_mesh import GearMesh
    from geartrain.train import Train


# ----------------------------------------------------------------------------------------------------- phases of wheels


_NONE = 1e-9  # mm, or relative to a unit vector: smaller differences are rounding errors


def mesh_directions(stage: SceneContext, circuit: Circuit) -> tuple[tuple[Vector, Vector], int] | None:
    """Return the unit vectors from the axes of two wheels to their contact, and the sense of the pair.

    The sense is 1 if positive rotations of both wheels move the teeth in contact in the same direction, and -1 if they
    move them in opposite directions. The result is None for screw pairs and coaxial wheels.
    """
    one, other = (stage.train.declaration.wheels[name][1] for name in circuit.wheels)
    first, second = (stage.layout.wheels[name] for name in circuit.wheels)
    axes = stage.reference(first.axis), stage.reference(second.axis)
    parallel = size(cross(*axes)) < _NONE
    if "worm" in (one.kind, other.kind) or (not parallel and (one.is_helical or other.is_helical)):
        return None
    if parallel and size(across(minus(second.centre, first.centre), axes[0])) < _NONE:
        return None
    ways = stage.along(first.axis), stage.along(second.axis)
    contact = pitch_directions((first, second), ways, (one.internal, other.internal))
    ends = [cross(axis, n) for axis, n in zip(axes, contact, strict=True)]
    return contact, 1 if dot(*ends) > 0 else -1


_NEAR = 1e-6  # pitches: smaller phase differences are rounding errors
_ROUNDS = 4


class _Mounting:
    """Search for the angles `turns` [rad] of all wheels, from their reference directions, at which their teeth mesh."""

    def __init__(self, stage: SceneContext, moved: MovementStart) -> None:
        self.stage, self.moved = stage, moved
        self.turns: dict[str, float] = {}
        self.meetings: dict[str, tuple[tuple[Vector, Vector], int]] = {}
        self.mates: dict[str, list[Circuit]] = {}
        self.pairs: list[Circuit] = []  # gear pairs whose wheels can be aligned with each other
        self.off: list[str] = []
        self.meshes: Mapping[str, GearMesh] = {mesh.name: mesh for mesh in stage.meshes}
        self.phases = {
            gear.name: float(gear.phase.value) for gear in stage.train.declaration.gears if gear.phase is not None
        }
        for circuit in stage.train.circuits:
            meeting = mesh_directions(stage, circuit) if circuit.kind == "gear" else None
            if meeting is not None:
                self.meetings[circuit.id] = meeting
                self.pairs.append(circuit)
                for wheel in circuit.wheels:
                    self.mates.setdefault(wheel, []).append(circuit)
        # pairs with a transmission function, then pairs with a declared phase, because their angles are not free
        for circuit in sorted(self.pairs, key=lambda each: (each.id not in moved.driving, each.id not in self.phases)):
            self._spread(circuit)
        for wheel in stage.layout.wheels:
            self.turns.setdefault(wheel, as_placed(stage, wheel))

    def _spread(self, first: Circuit) -> None:
        """Rotate all wheels that meshes connect with the pair `first` into mesh, by breadth-first search."""
        if any(wheel in self.turns for wheel in first.wheels):
            return
        at, setting = self._driver(first), self.moved.driving.get(first.id)
        if setting is not None:
            self._set(first, at, setting.S / self._pitch(first.wheels[at]))
        elif first.id in self.phases:
            at = 0
            self._set(first, at, self.phases[first.id])
        wheel = first.wheels[at]
        self.turns.setdefault(wheel, as_placed(self.stage, wheel))
        queue = deque([wheel])
        while queue:
            wheel = queue.popleft()
            for circuit in self.mates[wheel]:
                own = circuit.wheels.index(wheel)
                mate = circuit.wheels[1 - own]
                if mate not in self.turns:
                    self._mesh(circuit, own)
                    queue.append(mate)

    def _mesh(self, circuit: Circuit, own: int) -> None:
        """Set the angle of a wheel's mate so that they mesh; `own` is the index (0 or 1) of the wheel in the pair."""
        position = driving = self._position(circuit, own)
        if own == self._driver(circuit):
            self._set(circuit, 1 - own, position + self._ahead(circuit, position))
        else:
            driving = position - self._ahead(circuit)
            for _ in range(_ROUNDS):  # fixed-point iteration: position and advance depend on each other
                driving = position - self._ahead(circuit, driving)
            self._set(circuit, 1 - own, driving)
        if self._shift(circuit, driving):
            self.off.append(circuit.id)

    def _shift(self, circuit: Circuit, position: float) -> float:
        """Return by how much the driver's tooth is ahead of its position in the transmission function [pitches].

        position   position of the driver's tooth, forwards from the line of centres [pitches]
        """
        setting = self.moved.driving.get(circuit.id)
        if setting is None:
            return 0.0
        # teeth repeat after a pitch, so the shift is reduced to the nearest equivalent phase
        shift = (position - setting.S / self._pitch(circuit.wheels[self._driver(circuit)]) + 0.5) % 1 - 0.5
        return shift if abs(shift) > _NEAR else 0.0

    def _ahead(self, circuit: Circuit, position: float | None = None) -> float:
        """Return by how much a tooth of the driven wheel is ahead of a tooth of the driver in mesh [pitches].

        If the driver's tooth at `position` [pitches] is not where the transmission function requires it, the driven
        tooth is advanced until the driver does not interfere with it at any position.
        """
        mesh = self.meshes.get(circuit.id)
        if mesh is None:
            return 0.5
        setting = self.moved.driving.get(circuit.id)
        # standard teeth face spaces
        phase = mesh.tooth_phase if mesh.has_shape else 0.5
        if setting is None:
            return phase or 0.5
        driver = self._driver(circuit)
        if any(self.stage.layout.wheels[wheel].cone for wheel in circuit.wheels):
            # approximate teeth of a crown have no transmission function: they are centred in spaces, on average
            middle = sum(setting.transmission.error_range()) / 2
            return 0.5 + (setting.error - middle) / self._pitch(circuit.wheels[1 - driver])
        shift = 0.0 if position is None else self._shift(circuit, position)
        error = setting.error_past(shift * self._pitch(circuit.wheels[driver])) if shift else setting.error
        return phase + error / self._pitch(circuit.wheels[1 - driver])

    def _driver(self, circuit: Circuit) -> int:
        """Return the index of the driving wheel in a pair, 0 or 1."""
        setting = self.moved.driving.get(circuit.id)
        if setting is not None:
            return int(setting.driver != circuit.i)
        mesh = self.meshes.get(circuit.id)
        return 0 if mesh is None else circuit.wheels.index(mesh.driver)

    def _position(self, circuit: Circuit, at: int) -> float:
        """Return how far the first tooth of the wheel with index `at` has passed the contact of a pair [pitches]."""
        wheel = circuit.wheels[at]
        return self._way(circuit, at) * (self.turns[wheel] - self._zero(circuit, at)) / self._pitch(wheel)

    def _set(self, circuit: Circuit, at: int, position: float) -> None:
        """Rotate a wheel so that one of its teeth is `position` pitches past the line of centres, forwards."""
        wheel = circuit.wheels[at]
        pitch = self._pitch(wheel)
        self.turns[wheel] = (self._zero(circuit, at) + self._way(circuit, at) * (position % 1) * pitch) % (2 * pi)

    def _zero(self, circuit: Circuit, at: int) -> float:
        """Return the angle of a wheel [rad] at which its first tooth is on the line of centres at the start."""
        place = self.stage.layout.wheels[circuit.wheels[at]]
        axis = self.stage.reference(place.axis)
        rest = self.moved.rest[(circuit.i, circuit.j)[at]] - self.moved.rest[circuit.carrier]
        return azimuth(self.meetings[circuit.id][0][at], axis, place.reference) - rest

    def _way(self, circuit: Circuit, at: int) -> int:
        """Return 1 if a wheel turns in the positive sense about the direction of its body, -1 if it does not."""
        driver, setting = self._driver(circuit), self.moved.driving.get(circuit.id)
        links = (circuit.i, circuit.j)[driver], circuit.carrier
        own, base = (self.stage.sense(link) * (self.stage.speed(link) or 0) for link in links)
        forward = setting.forward if setting is not None else -1 if own < base else 1
        return forward if at == driver else forward * self.meetings[circuit.id][1]

    def _pitch(self, wheel: str) -> float:
        return 2 * pi / (self.stage.train.declaration.wheels[wheel][1].count or 1)

    def notices(self) -> Iterator[Problem]:
        """Yield a warning about the pairs whose teeth are drawn out of phase."""
        if self.off:
            yield Problem(
                f"the teeth of {', '.join(self.off)} are drawn out of phase",
                "a driver with several mates can be in phase with only one of them. The other pairs are drawn without "
                "overlap, but not in correct mesh; the computed motion is not affected",
                "",
            )


# -------------------------------------------------------------------------------------------------------- formula table


_MOST_WHEELS = 300  # the length of formulas grows with the chain


def find_count_formulas(
    train: GearTrain,
    state: str | None,
    bodies: Sequence[SceneBody],
    wheels: Sequence[SceneWheel],
    pointers: Sequence[Pointer],
) -> SceneFormulas | None:
    """Return the speeds as functions of tooth counts; equal planets share one count.

    The result is None if no link is driven, no tooth count is known, or the formulas would be too large.
    """
    declared, unfolded = train.declaration, train.unfolded
    case = declared.case(state)
    driving_link = next((link for link, speed in case.inputs.items() if speed), None)
    free = {name: (wheel.count,) for name, (_, wheel) in declared.wheels.items() if wheel.count}
    if driving_link is None or not free or len(free) > _MOST_WHEELS:
        return None
    frame = declared.frame
    requested = [(bodies[each.body].id, bodies[each.base].id) for each in pointers]
    links = [None if body.parent is None else (body.id, frame) for body in bodies]
    own, counted = originals(declared), {}
    for wheel in wheels:  # a copied wheel and its link have the same suffix
        link = bodies[wheel.body].id
        suffix = link.removeprefix(own[link])
        counted[wheel.id] = wheel.id.removesuffix(suffix) if suffix else wheel.id
    # unfolded, as each planet is a body of the scene
    every = (*requested, *filter(None, links))
    outputs = FrozenDict({_name(each): Output(of=each[0], relative_to=each[1]) for each in every})
    states = dict(unfolded.declaration.states)
    try:
        if state in states:
            states[state] = states[state].changed(outputs=FrozenDict({}))
        changed = unfolded.declaration.changed(outputs=outputs, states=FrozenDict(states))
        found = find_formulas(changed, state, {name: free[of] for name, of in counted.items() if of in free})
    except GearTrainError:
        return None
    place = {name: at for at, name in enumerate(free)}
    table = _Table({name: place[of] for name, of in counted.items() if of in free})
    return SceneFormulas(
        wheels=tuple(free),
        count=tuple(table.place.get(wheel.id) for wheel in wheels),
        bodies=tuple(table.index(found, each) for each in links),
        pointers=tuple(table.index(found, each) for each in requested),
        conditions=_conditions(unfolded, found, table, [body.id for body in bodies]),
        formulas=tuple(table.formulas),
        input=fraction_text(case.inputs[driving_link]),
        exact=case.exact,
        parent=_parent(declared),
    )


def _name(requested: tuple[str, str]) -> str:
    return " seen from ".join(requested)


def _parent(train: Train) -> str:
    """Return the value of `extends` with which a declaration can change this train: a train's name or a file name."""
    from geartrain.train.declaration_files import shipped

    file = train.place("name").rpartition(":")[0]
    if file in ("", "text"):
        return f"{train.name}.yaml"
    own = Path(file).resolve()
    return next((name for name, path in shipped().items() if path == own), own.name)


class _Table:
    """Formulas of a scene without duplicates; bodies and pointers refer to them by index."""

    def __init__(self, place: Mapping[str, int]) -> None:
        self.place = place  # index of the count of each wheel
        self.formulas: dict[CountFormula, int] = {}

    def index(self, found: Formulas, requested: tuple[str, str] | None) -> int | None:
        formula = None if requested is None else found.outputs.get(_name(requested))
        return None if formula is None else self.formulas.setdefault(self.plain(formula), len(self.formulas))

    def plain(self, formula: Formula) -> CountFormula:
        upper, lower = (
            tuple((fraction_text(term.coefficient), tuple(term.exponents)) for term in terms)
            for terms in (formula.numerator, formula.denominator)
        )
        return CountFormula(tuple(self.place[wheel] for wheel in formula.wheels), upper, lower)


def _conditions(train: GearTrain, found: Formulas, table: _Table, bodies: Sequence[str]) -> tuple[CountCondition, ...]:
    carriers = {f"loop {' - '.join(loop.links)} closes": loop.carrier for loop in train.mobility.loops}
    must = [
        CountCondition(
            table.plain(each), True, each.label, bodies.index(carriers[each.label]) if each.label in carriers else None
        )
        for each in found.conditions
    ]
    return (*must, *(CountCondition(table.plain(each), False, each.label) for each in found.exclusions))


# --------------------------------------------------------------------------------------------------------- construction


def make_scene(
    train: GearTrain,
    state: str | None = None,
    layout: Layout | None = None,
    run: TimeRun | None = None,
    formulas: bool = False,
) -> Scene:
    """Return the scene of a train in one state as plain data: positions, shapes and motion of all its elements.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared train. The scene of a train that cannot turn contains the verdict.
    state : str, optional
        State of the train; by default the first state, or the state of the run.
    layout : Layout, optional
        Positions of axes and wheels; by default `lay_out(train)`.
    run : geartrain.simulation.TimeRun, optional
        Result of `train.dynamics(...)` in that state, which replaces the exact motion of the scene.
    formulas : bool
        True to include speeds as functions of tooth counts, for pages on which the counts can be changed.

    Returns
    -------
    Scene
        Scene with lengths in mm, angles in rad and exact ratios. Its `notices` report elements that could not be placed
        and motion that could not be computed.

    Raises
    ------
    GearTrainError
        If the state does not exist, or the run is of another train or state.

    Examples
    --------
    A sun of 24 teeth drives a carrier within a fixed ring of 60: 1 + 60/24 turns of the sun per turn of the carrier.

    >>> import geartrain
    >>> scene = make_scene(geartrain.load("planetary-24-18-60"))
    >>> {body.id: body.speed for body in scene.bodies}
    {'frame': '0', 'sun': '1', 'planet': '-2/3', 'carrier': '2/7'}
    >>> scene.movement.kind
    'exact'
    """
    moves = originals(train.declaration)  # the simulation has equal planets as one link
    folded, train = train, train.unfolded
    declared = train.declaration
    state = train.declaration.state_or_first(run.state if state is None and run is not None else state)
    stage = SceneContext(train, train.solve(state, method="exact"), layout or lay_out(train))
    verdict, faults = find_verdict(stage)
    dials = find_dials(stage)
    pointers = find_pointers(stage, dials)
    faces = tuple(dials.values())
    # a simulated run has its own starting angles
    epoch = find_epoch(stage, pointers, faces) if run is None else None
    if epoch is not None:
        stage = replace(stage, set_angles=angles_at_start(stage, epoch, pointers, faces))
    moved = find_movement(stage)
    teeth, undrawn = find_profiles(stage)
    mounting = _Mounting(stage, moved)
    wheels, profiles = find_wheels(stage, teeth, mounting.turns)
    notices = (*stage.layout.notices, *moved.notices, *undrawn, *mounting.notices())
    bodies, wheels, waves = bend(stage, find_bodies(stage), wheels)
    shapes, rods = find_shapes(stage)
    pairs, couplings = find_pairs(stage, faults), find_couplings(stage, moved)
    return Scene(
        name=train.name,
        title=declared.title,
        note=declared.note or "",
        state=state,
        unit=declared.unit_name,
        positive=declared.view.positive,
        front=stage.layout.front,
        driving_link=None if stage.driving_link is None else stage.body[stage.driving_link],
        crank=None if stage.crank is None else stage.body[stage.crank],
        drive=drive_kind(stage),
        fusee=fusee_radii(stage),
        up=upwards(stage),
        step=fraction_text(stage.step),
        verdict=verdict,
        bodies=bodies,
        wheels=wheels,
        waves=waves,
        profiles=profiles,
        pairs=pairs,
        couplings=couplings,
        shapes=(*shapes, *find_displays(stage)),
        hangers=rods,
        dials=with_titles(with_balls(faces, pointers), pointers),
        pointers=pointers,
        movement=moved.movement,
        sources={
            key: {"cite": source.cite, "url": source.url or "", "note": source.note or ""}
            for key, source in declared.sources.items()
        },
        notices=tuple(_plain(notice) for notice in notices),
        back=moved.back,
        unit_days=exact(declared.unit_days),
        elements=find_elements(stage, state),
        epoch=epoch,
        tour=tuple(TourStop(declared.tour_parts[step.look_at], step.look_at, step.text) for step in declared.tour),
        formulas=find_count_formulas(folded, state, bodies, wheels, pointers) if formulas and run is None else None,
        asks=bool(stage.case.outputs),
        run=None if run is None else find_run(stage, run, moves, moved.movement, wheels, pairs, couplings),
    )


def _plain(notice: Problem) -> dict[str, str]:
    place = re.sub(r"^.*[\\/]", "", notice.place)  # a page is shown on other machines: no folders
    return {"what": notice.what, "why": notice.why, "fix": notice.fix, "place": place}
