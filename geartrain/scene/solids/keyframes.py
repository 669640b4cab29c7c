"""Angles of all bodies over some turns of the lead, at as many moments as each needs."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from math import ceil, pi
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.decimal_text import read_fraction

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.scene.solids.solid_assembly import SolidModel

_A_TURN = 3  # key frames: between two of them a rotation takes the shorter way, so two would be ambiguous
_RIPPLING = 48  # of a turn, where teeth or pins add something
_LEAST_RIPPLING = 240
_MOST = 60_000  # key frames of one body: a longer period is not shown whole
_USUAL = 10  # turns of the lead, where no period is
_PACE = 1.0  # seconds in which the fastest body turns once
_LONGEST = 120.0  # seconds


@dataclass(frozen=True)
class Keyframes:
    """What turns, and for how long.

    turns     of the lead
    seconds   that they take
    speeds    of each body over its parent's, in turns of the lead, about its `direction`; None: it does not turn
    """

    work: SolidModel
    turns: Fraction
    seconds: float
    speeds: tuple[Fraction | None, ...]
    ripples: bool
    _found: dict[int, Floats] = field(default_factory=dict, repr=False, compare=False)

    @classmethod
    def of(cls, work: SolidModel, turns: Fraction | None = None) -> Keyframes | None:
        """The motion of a train over `turns`, by default its period, or ten turns where that is long; None if still."""
        scene = work.scene
        if scene.movement.kind == "still" or scene.lead is None:
            return None
        speeds = _relative(work)
        fastest = max((abs(speed) for speed in speeds if speed), default=Fraction(0))
        if not fastest:
            return None
        ripples = scene.movement.kind == "real"
        dense = _RIPPLING if ripples else _A_TURN
        if turns is None:
            period = read_fraction(scene.movement.period) if scene.movement.period else None
            turns = period if period and period * fastest * dense <= _MOST else Fraction(_USUAL)
            turns = min(turns, Fraction(_MOST) / (fastest * dense))
        elif turns <= 0 or turns * fastest * dense > _MOST:
            most = float(_MOST / (fastest * dense))
            why = f"its fastest body would need {float(turns * fastest * dense):.4g} key frames"
            fix = f"give more than 0 and at most {most:.4g}"
            raise QuestionError(Problem(f"{turns} turns are no animation", why, fix, "--turns"))
        seconds = min(max(float(turns * fastest) * _PACE, 1.0), _LONGEST)
        return cls(work, turns, seconds, speeds, ripples)

    def keys(self, body: int) -> int:
        """Steps between key frames of a body; 0 if it stands still on its parent."""
        speed = self.speeds[body]
        turned = abs(float((speed or 0) * self.turns))
        if self.ripples and self.work.scene.bodies[body].speed is not None:
            return max(ceil(_RIPPLING * turned), _LEAST_RIPPLING)
        return ceil(_A_TURN * turned)

    def angle(self, body: int, count: int) -> Floats:
        """Angle (rad) over its parent at `count` + 1 even moments, about its direction."""
        bodies = self.work.scene.bodies
        found = np.zeros(count + 1)
        for at, sign in ((body, 1), (bodies[body].parent, -1)):
            if at is not None and bodies[at].parent is not None:
                own = bodies[at]
                whole = read_fraction(own.speed or "0") * self.turns
                # parts of a turn exactly, in whole numbers, so that a body that comes home is there
                above, below = whole.numerator, whole.denominator * count
                parts = [above * k % below / below for k in range(count + 1)]
                found += sign * own.sense * (own.start + 2 * pi * np.array(parts) + self._errors(count)[at])
        return found

    def _errors(self, count: int) -> Floats:
        """What teeth and pins add to the angle of each body (rad), (bodies, count + 1)."""
        bodies = self.work.scene.bodies
        if not self.ripples:
            return np.zeros((len(bodies), count + 1))
        if count not in self._found:  # bodies of one count share it
            links = tuple(self.work.train.declaration.links)
            motion = self.work.sized.motion(self.work.scene.state, links)
            self._found[count] = motion.at(float(self.turns) * np.arange(count + 1) / count).error
        return self._found[count]


def _relative(work: SolidModel) -> tuple[Fraction | None, ...]:
    bodies = work.scene.bodies
    found: list[Fraction | None] = []
    for body in bodies:
        parent = None if body.parent is None else bodies[body.parent]
        if parent is None or body.speed is None:
            found.append(None)
            continue
        carried = read_fraction(parent.speed or "0") * parent.sense if parent.parent is not None else Fraction(0)
        found.append(read_fraction(body.speed) * body.sense - carried)
    return tuple(found)
