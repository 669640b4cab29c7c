"""What a picture or a film of a turning train shows: its size, from where, from which turn to which, and how fast."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from math import ceil
from typing import TYPE_CHECKING, Literal

from geartrain.errors import Problem, QuestionError

if TYPE_CHECKING:
    from geartrain.scene import Scene

Look = Literal["free", "front", "back", "side"]

_PACE = Fraction(1, 4)  # turns a second of what turns fastest: an eye can follow its teeth
_STEP = Fraction(2, 5)  # teeth that pass from one picture to the next: from a half on they seem to go backwards
_LEAST, _LONGEST, _USUAL = 2.0, 40.0, 6.0  # s: of a film, of a whole period that is shown, of a part of a longer one
_MOST_SIDE, _LEAST_SIDE, _MOST_FRAMES = 4096, 16, 5000
_ORBIT = 12.0  # s of one turn of the camera


@dataclass(frozen=True, slots=True, kw_only=True)
class Shot:
    """What is shown of a scene. The options of `geartrain view` are these fields, with what they say of themselves.

    Parameters
    ----------
    size : tuple of int
        Width and height [px].
    look : {"free", "front", "back", "side"}
        From where the camera looks.
    background : str
        Colour, as CSS writes it.
    apart : float
        How far layers are pulled from each other, 0 to 1.
    at : Fraction
        Turns of the lead at the first picture.
    turns : Fraction, optional
        Turns of the lead until the film ends; default its whole period where that is short, else what can be seen in
        six seconds.
    seconds : float, optional
        How long the film lasts; default by what turns fastest.
    fps : int
        Pictures a second.
    turntable : float
        Turns of the camera about the train, while the film lasts.
    cutaway : bool, optional
        Whether a quarter is cut out of rings, drums and plates; default where rings stand before each other.
    teeth : bool
        False draws plain discs.

    Raises
    ------
    QuestionError
        For what cannot be shown.

    Examples
    --------
    >>> Shot(size=(320, 200), look="front").size
    (320, 200)
    """

    size: tuple[int, int] = field(default=(960, 640), metadata={"help": "Of a picture or film, such as 960x640."})
    look: Look = field(default="free", metadata={"help": "Where the camera of a picture or film stands."})
    background: str = field(default="#f4f1ea", metadata={"help": "Of a picture or film: a colour, as CSS writes it."})
    apart: float = field(default=0.0, metadata={"help": "Layers pulled apart in a picture or film, 0 to 1."})
    at: Fraction = field(
        default=Fraction(0), metadata={"help": "Turns of the lead in a picture, or where a film begins."}
    )
    turns: Fraction | None = None
    seconds: float | None = field(
        default=None, metadata={"help": "How long a film lasts; default by what turns fastest."}
    )
    fps: int = field(default=25, metadata={"help": "Pictures a second of a film."})
    turntable: float = field(default=0.0, metadata={"help": "Turns of the camera about the train in a film."})
    cutaway: bool | None = field(
        default=None,
        metadata={"help": "Rings, drums and plates of a picture or film cut open; default where rings hide stages."},
    )
    teeth: bool = True

    def __post_init__(self) -> None:
        _check(
            "size",
            all(_LEAST_SIDE <= side <= _MOST_SIDE for side in self.size),
            f"each side from {_LEAST_SIDE} to {_MOST_SIDE}",
        )
        _check("apart", 0 <= self.apart <= 1, "from 0 to 1")
        _check("fps", 1 <= self.fps <= 100, "from 1 to 100")
        _check("seconds", self.seconds is None or 0 < self.seconds <= 3600, "above 0, an hour at most")
        _check("turntable", abs(self.turntable) <= 100, "from -100 to 100")

    def timed(self, scene: Scene) -> Shot:
        """The same with its turns and seconds.

        Parameters
        ----------
        scene : Scene
            What is filmed.

        Returns
        -------
        Shot
            With none of them left open.

        Raises
        ------
        QuestionError
            If nothing in the film would move, or it has too many pictures.
        """
        turns, seconds = self._span(scene)
        found = replace(self, turns=turns, seconds=seconds)
        check_length(found.frames, "--seconds")
        return found

    def _span(self, scene: Scene) -> tuple[Fraction, float]:
        if scene.run is not None:
            whole = Fraction(scene.run.duration / scene.run.period) if self.turns is None else self.turns
            return whole, self.seconds or float(whole) * scene.run.period
        if not moves(scene) or self.turns == 0:
            if not self.turntable:
                why = scene.verdict.get("text", "") if self.turns != 0 else "it was asked for no turns"
                fix = "give --turntable 1, or --png for one picture"
                raise QuestionError(Problem("nothing moves in this film", str(why), fix))
            return Fraction(0), self.seconds or abs(self.turntable) * _ORBIT
        pace = pace_of(scene, self.fps)
        period = period_of(scene)
        if self.turns is not None:
            turns = self.turns
        elif period is not None and period / pace <= _LONGEST:
            turns = period
        else:
            turns = pace * Fraction(self.seconds or _USUAL)
        return turns, self.seconds or min(_LONGEST, max(_LEAST, float(abs(turns) / pace)))

    @property
    def frames(self) -> int:
        """How many pictures the film has, once it is timed."""
        return max(2, ceil((self.seconds or 0) * self.fps - 1e-9))

    def moments(self) -> Iterator[tuple[Fraction, float]]:
        """Turns of the lead and turns of the camera of each picture; the one after the last would be the end."""
        for n in range(self.frames):
            share = Fraction(n, self.frames)
            yield self.at + (self.turns or 0) * share, float(share) * self.turntable

    def closes(self, scene: Scene) -> bool:
        """True where the film ends as it began, and so can begin again without a jump; asked of what is timed.

        Parameters
        ----------
        scene : Scene
            What is filmed.

        Returns
        -------
        bool
        """
        period = period_of(scene)
        whole = not self.turns or (scene.run is None and period is not None and (self.turns / period).denominator == 1)
        return whole and float(self.turntable).is_integer()


def check_length(pictures: int, fewer: str) -> None:
    """Raises `QuestionError` where a film has too many pictures; `fewer` is what the reader may give less of."""
    if pictures > _MOST_FRAMES:
        why = f"it would have {pictures} pictures, and {_MOST_FRAMES} are the most"
        raise QuestionError(Problem("the film is too long", why, f"give fewer {fewer}, or a lower --fps"))


def moves(scene: Scene) -> bool:
    """True where something turns when the lead does."""
    return scene.lead is not None and scene.movement.kind != "still"


def pace_of(scene: Scene, fps: int) -> Fraction:
    """Turns of the lead a second at which an eye can follow what turns, and a film shows which way teeth go."""
    speeds = [abs(Fraction(body.speed or 0)) for body in scene.bodies]
    teeth = max((wheel.teeth * speeds[wheel.body] for wheel in scene.wheels), default=0)
    limits = [_PACE / max(speeds)] if any(speeds) else [_PACE]
    return min([*limits, _STEP * fps / teeth] if teeth else limits)


def period_of(scene: Scene) -> Fraction | None:
    """Turns of the lead after which everything stands as before; None where nothing moves."""
    period = scene.movement.period
    return None if period is None else Fraction(period)


def _check(name: str, holds: bool, range_: str) -> None:
    if not holds:
        raise QuestionError(Problem(f"--{name} is out of range", f"it can be {range_}", "give one within that"))
