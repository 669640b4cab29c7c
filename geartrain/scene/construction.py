"""From a train to its scene: where everything is, what it looks like, how it moves.

With speeds as exact functions of tooth counts, for pages on which counts are changed; equal planets have one count.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import GearTrainError, Problem
from geartrain.kinematics.formulas import Formula, Formulas, find_formulas
from geartrain.kinematics.planet_copies import originals
from geartrain.numerics.containers import FrozenDict
from geartrain.numerics.exact import fraction_text
from geartrain.scene.bodies import find_bodies, find_profiles, find_wheels
from geartrain.scene.context import SceneContext, exact
from geartrain.scene.count_formulas import CountCondition, CountFormula, SceneFormulas
from geartrain.scene.dial_pointers import find_dials, find_pointers, with_balls, with_titles
from geartrain.scene.joints import find_couplings, find_elements, find_pairs, find_verdict
from geartrain.scene.layout import Layout, lay_out
from geartrain.scene.movement import find_movement
from geartrain.scene.sky import find_epoch
from geartrain.scene.strain_waves import bend
from geartrain.scene.train_scene import Scene
from geartrain.scene.wheel_phases import phase_wheels
from geartrain.train import Output

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from geartrain.analysis.gear_train import GearTrain
    from geartrain.scene.elements import SceneBody, SceneCoupling, ScenePair, SceneWheel
    from geartrain.scene.movement import MovementStart
    from geartrain.scene.scene_run import SceneRun, TimeRun
    from geartrain.scene.train_scene import Pointer
    from geartrain.train import Train


# -------------------------------------------------------------------------------------------------------- formula table


_MOST_WHEELS = 300  # functions of the links of a long chain are long themselves


def find_count_formulas(
    train: GearTrain,
    state: str | None,
    bodies: Sequence[SceneBody],
    wheels: Sequence[SceneWheel],
    pointers: Sequence[Pointer],
) -> SceneFormulas | None:
    """The functions of a train as declared, for the parts of its scene; None where there are none to be had.

    A train without inputs has none, nor has one that is too coupled or too large for them.
    """
    declared, unfolded = train.declaration, train.unfolded
    case = declared.case(state)
    lead = next((link for link, speed in case.inputs.items() if speed), None)
    free = {name: (wheel.count,) for name, (_, wheel) in declared.wheels.items() if wheel.count}
    if lead is None or not free or len(free) > _MOST_WHEELS:
        return None
    frame = declared.frame
    asked = [(bodies[each.body].id, bodies[each.base].id) for each in pointers]
    links = [None if body.parent is None else (body.id, frame) for body in bodies]
    own = originals(declared)
    counted = {wheel.id: _original(wheel.id, own, bodies[wheel.body].id) for wheel in wheels}
    try:
        train_asked = _asking(unfolded.declaration, state, [*asked, *filter(None, links)])
        found = find_formulas(train_asked, state, {name: free[of] for name, of in counted.items() if of in free})
    except GearTrainError:
        return None
    place = {name: at for at, name in enumerate(free)}
    table = _Table({name: place[of] for name, of in counted.items() if of in free})
    return SceneFormulas(
        wheels=tuple(free),
        count=tuple(table.place.get(wheel.id) for wheel in wheels),
        bodies=tuple(table.index(found, each) for each in links),
        pointers=tuple(table.index(found, each) for each in asked),
        conditions=_conditions(unfolded, found, table, [body.id for body in bodies]),
        formulas=tuple(table.formulas),
        input=fraction_text(case.inputs[lead]),
        exact=case.exact,
        parent=_parent(declared),
    )


def _name(asked: tuple[str, str]) -> str:
    return " seen from ".join(asked)


def _asking(train: Train, state: str | None, asked: Sequence[tuple[str, str]]) -> Train:
    """The train with other outputs: links as they are seen from links."""
    outputs = FrozenDict({_name(each): Output(of=each[0], relative_to=each[1]) for each in asked})
    states = {
        name: each.changed(outputs=FrozenDict({})) if name == state else each for name, each in train.states.items()
    }
    return train.changed(outputs=outputs, states=FrozenDict(states))


def _original(wheel: str, own: dict[str, str], link: str) -> str:
    """The declared wheel of a copy's wheel, whose name ends as that of its link does."""
    end = link.removeprefix(own[link])
    return wheel.removesuffix(end) if end else wheel


def _parent(train: Train) -> str:
    """What would extend it: a shipped train by name, else the file that it was read from."""
    from geartrain.train.declaration_files import shipped

    file = train.place("name").rpartition(":")[0]
    if file in ("", "text"):
        return f"{train.name}.yaml"
    own = Path(file).resolve()
    return next((name for name, path in shipped().items() if path == own), own.name)


class _Table:
    """Functions by index, each once."""

    def __init__(self, place: Mapping[str, int]) -> None:
        self.place = place  # of each wheel, that of its count
        self.formulas: dict[CountFormula, int] = {}

    def index(self, found: Formulas, asked: tuple[str, str] | None) -> int | None:
        formula = None if asked is None else found.outputs.get(_name(asked))
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
    """The scene of a train in one state: where all stands, what it looks like and how it moves, as plain data.

    Parameters
    ----------
    train : GearTrain
        Loaded or declared. One that cannot turn has a scene too, with the verdict.
    state : str, optional
        One of its states; by default the first, or that of the run.
    layout : Layout, optional
        Where it stands; by default `lay_out(train)`.
    run : geartrain.simulation.TimeRun, optional
        What `train.dynamics(...)` gave in that state: then this is what moves.
    formulas : bool
        True: with speeds as functions of tooth counts, which a page needs on which counts are changed.

    Returns
    -------
    Scene
        Lengths in mm, angles in rad, ratios exact. Its `notices` tell what could not be placed or followed.

    Raises
    ------
    GearTrainError
        If there is no such state, or the run is of another train or state.

    Examples
    --------
    A sun of 24 teeth drives a carrier within a fixed ring of 60: 1 + 60/24 turns to one.

    >>> import geartrain
    >>> scene = make_scene(geartrain.load("planetary-24-18-60"))
    >>> {body.id: body.speed for body in scene.bodies}
    {'frame': '0', 'sun': '1', 'planet': '-2/3', 'carrier': '2/7'}
    >>> scene.movement.kind
    'exact'
    """
    moves = originals(train.declaration)  # what was simulated moves equal planets as one
    folded, train = train, train.unfolded
    declared = train.declaration
    state = train.declaration.state_or_first(run.state if state is None and run is not None else state)
    stage = SceneContext(train, train.solve(state, method="exact"), layout or lay_out(train))
    verdict, faults = find_verdict(stage)
    moved = find_movement(stage)
    drawn = find_profiles(stage)
    mounted = phase_wheels(stage, moved)
    wheels, profiles = find_wheels(stage, drawn.profiles, mounted.turns)
    dials = find_dials(stage)
    notices = (*stage.layout.notices, *moved.notices, *drawn.notices, *mounted.notices)
    pointers = find_pointers(stage, dials)
    bodies, wheels, waves = bend(stage, find_bodies(stage), wheels)
    pairs, couplings = find_pairs(stage, drawn.forms, faults), find_couplings(stage, moved)
    return Scene(
        name=train.name,
        title=declared.title,
        note=declared.note or "",
        state=state,
        unit=declared.unit_name,
        positive=declared.view.positive,
        front=stage.layout.front,
        lead=None if stage.lead is None else stage.body[stage.lead],
        crank=None if stage.crank is None else stage.body[stage.crank],
        step=fraction_text(stage.step),
        verdict=verdict,
        bodies=bodies,
        wheels=wheels,
        waves=waves,
        profiles=profiles,
        pairs=pairs,
        couplings=couplings,
        dials=with_titles(with_balls(tuple(dials.values()), pointers), pointers),
        pointers=pointers,
        movement=moved.movement,
        sources=_sources(train),
        notices=tuple(_plain(notice) for notice in notices),
        back=moved.back,
        unit_days=exact(declared.unit_days),
        elements=find_elements(stage, state),
        epoch=find_epoch(stage),
        formulas=find_count_formulas(folded, state, bodies, wheels, pointers) if formulas and run is None else None,
        asks=bool(stage.case.outputs),
        run=None if run is None else _played(stage, run, moves, moved, wheels, pairs, couplings),
    )


def _played(
    stage: SceneContext,
    run: TimeRun,
    moves: Mapping[str, str],
    moved: MovementStart,
    wheels: Sequence[SceneWheel],
    pairs: Sequence[ScenePair],
    couplings: Sequence[SceneCoupling],
) -> SceneRun:
    from geartrain.scene.run_courses import find_run  # needs numpy

    return find_run(stage, run, moves, moved.movement, wheels, pairs, couplings)


def _sources(train: GearTrain) -> dict[str, dict[str, str]]:
    return {
        key: {"cite": source.cite, "url": source.url or "", "note": source.note or ""}
        for key, source in train.declaration.sources.items()
    }


def _plain(notice: Problem) -> dict[str, str]:
    place = re.sub(r"^.*[\\/]", "", notice.place)  # a page is shown where nobody has the writer's folders
    return {"what": notice.what, "why": notice.why, "fix": notice.fix, "place": place}
