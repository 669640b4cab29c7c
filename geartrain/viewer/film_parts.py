"""What a film shows, moment by moment: one train in a state, or its states one after another, each by its name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.viewer.shot import Shot, check_length, moves, pace_of

if TYPE_CHECKING:
    from geartrain.scene import Scene

_STATE = 3.0  # s of each state, where nothing is said

Moment = tuple[Fraction, float]
"""Turns of the lead, and turns of the camera."""


@dataclass(frozen=True, slots=True)
class FilmPart:
    """A scene with its moments, and words that stand over it: a large line and a small one, or none."""

    scene: Scene
    moments: Sequence[Moment]
    words: tuple[str, str] | None = None


def film_parts(scenes: Sequence[Scene], shot: Shot) -> list[FilmPart]:
    """The parts of a film.

    Parameters
    ----------
    scenes : sequence of Scene
        One, or the states of a train in order.
    shot : Shot
        Its turns and seconds are those of each state; of several, what is left open is as long in each, at one speed
        of the lead, at which in none of them teeth seem to go backwards.

    Returns
    -------
    list of FilmPart

    Raises
    ------
    QuestionError
        If nothing moves, or there are too many pictures.
    """
    if len(scenes) == 1:
        return [FilmPart(scenes[0], list(shot.timed(scenes[0]).moments()))]
    if not any(map(moves, scenes)):
        why, fix = "it turns in none of its states", "ask for one of them, with --png or --turntable 1"
        raise QuestionError(Problem("nothing moves in this film", why, fix))
    seconds = shot.seconds or _STATE
    turns = shot.turns if shot.turns is not None else _slowest(scenes, shot.fps) * Fraction(seconds)
    each = replace(shot, seconds=seconds, turns=turns)
    check_length(each.frames * len(scenes), "--seconds for each state")
    return [
        FilmPart(scene, list(_moments(each, scene, at, len(scenes))), _words(scene)) for at, scene in enumerate(scenes)
    ]


def _slowest(scenes: Sequence[Scene], fps: int) -> Fraction:
    return min(pace_of(scene, fps) for scene in scenes if moves(scene))


def _moments(shot: Shot, scene: Scene, at: int, count: int) -> list[Moment]:
    """Those of one state: it begins as it stands at `shot.at`, and the camera goes on where it was."""
    own = shot if moves(scene) else replace(shot, turns=Fraction(0))
    return [(turns, (at * shot.turntable + orbit) / count) for turns, orbit in own.moments()]


def _words(scene: Scene) -> tuple[str, str]:
    """The state, and what is closed in it and what its outputs do; of one that does not turn, its verdict."""
    closed = ", ".join(element.id for element in scene.elements if element.closed)
    told = [f"{pointer.output} {_speed(pointer.shown, pointer.decimal)}" for pointer in scene.pointers if scene.asks][
        :2
    ]
    what = told if moves(scene) else [str(scene.verdict["kind"])]
    return f"state {scene.state}" if scene.state else scene.name, "; ".join(
        [*([f"closed: {closed}"] if closed else []), *what]
    )


def _speed(shown: str | None, decimal: str) -> str:
    if shown is None:
        return "not determined"
    return f"{shown} = {float(decimal):.4g}" if "/" in shown else shown
