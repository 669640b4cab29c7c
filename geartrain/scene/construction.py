"""From a train to its scene: where all stands, what it looks like, how it moves."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from geartrain.analysis.gear_train import GearTrain
from geartrain.errors import Problem
from geartrain.kinematics.planet_copies import originals
from geartrain.numerics.decimal_text import fraction_text
from geartrain.scene.bodies import find_bodies, find_profiles, find_wheels
from geartrain.scene.context import SceneContext, exact
from geartrain.scene.dial_pointers import find_dials, find_pointers, with_balls, with_titles
from geartrain.scene.formula_table import find_count_formulas
from geartrain.scene.joints import find_couplings, find_elements, find_pairs, find_verdict
from geartrain.scene.layout import Layout, lay_out
from geartrain.scene.movement import find_movement
from geartrain.scene.sky import find_epoch
from geartrain.scene.strain_waves import bend
from geartrain.scene.train_scene import Scene
from geartrain.scene.wheel_phases import phase_wheels

if TYPE_CHECKING:
    from geartrain.dynamics import TimeRun
    from geartrain.scene.elements import SceneCoupling, ScenePair, SceneWheel
    from geartrain.scene.movement import MovementStart
    from geartrain.scene.scene_run import SceneRun


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
    run : TimeRun, optional
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
