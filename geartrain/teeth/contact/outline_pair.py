"""All teeth of two wheels at one distance: which couples are in reach, and which of them holds the driven wheel."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, lcm, pi
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from geartrain.errors import Problem, QuestionError, RangeError
from geartrain.numerics.arrays import some
from geartrain.teeth.contact.driven_frame import AxlePlacement
from geartrain.teeth.contact.first_touch import CandidatePairs, FirstTouches, FirstTouchSearch

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats, Indices
    from geartrain.teeth.contact.gear_outline import GearOutline


_BLOCK = 60_000  # nodes worked on at once: bounds the memory of long arrays of angles
_MARGIN = 1e-5  # of a driven pitch: how far rough angles may be off
_TIE = 4e-15  # rad: of touches as near as this the later couple, and a flank before a corner, is named


class OutlinePair:
    """One side of two wheels at one distance. The back is the front seen in a mirror."""

    def __init__(
        self, first: GearOutline, second: GearOutline, distance: float, side: Literal["front", "back"]
    ) -> None:
        _check(first, second, distance)
        self.first, self.second, self.sign = first, second, 1 if side == "front" else -1
        sight = AxlePlacement(distance, first.bevel, 1 if first.ring else 2 if second.ring else 0)
        mine, theirs = (
            (first.ahead, second.behind)
            if side == "front"
            else (
                first.behind.mirrored,
                second.ahead.mirrored,
            )
        )
        self.judge = FirstTouchSearch(mine, theirs, sight)
        low, high, behind, ahead = mine.reach
        least, most, _, _ = theirs.reach
        reach = sight.bounds(low, high, least, most)
        self.window = (-reach - ahead, reach - behind) if reach >= 0 else (0.0, -1.0)

    @property
    def cycle(self) -> int:
        """Driver's pitches after which all repeats."""
        z1, z2 = self.first.z, self.second.z
        if self.first.equal and self.second.equal:
            return 1
        if self.second.equal:
            return z1
        return z2 if self.first.equal else lcm(z1, z2)

    def at(self, phi1: Floats, within: float) -> tuple[Any, ...]:
        """The fields of `FlankContact` at angles of shape (n,)."""
        period = self.cycle * self.first.pitch
        # worked out within one period, and whole periods added after: their rounding stays out of the contact
        turns = np.floor(self.sign * phi1 / period)
        rest = self.sign * phi1 - turns * period
        parts = [self._block(part, within) for part in self._blocks(rest)]
        angle, speed, pair, *others = (np.concatenate(each, axis=-1) for each in zip(*parts, strict=True))
        angle = self.sign * (angle + turns * (self.cycle * self.second.pitch))
        pair = self.sign * (pair - turns.astype(int) * self.cycle)
        return angle, speed, pair, *others

    def _blocks(self, rest: Floats) -> Iterator[Floats]:
        wide = self.window[1] - self.window[0]
        per_angle = (wide / self.first.pitch + 1) * self.judge.first.nodes[0].shape[1]
        size = max(16, int(_BLOCK / per_angle))
        return (rest[start : start + size] for start in range(0, max(len(rest), 1), size))

    def _couples(self, rest: Floats) -> tuple[CandidatePairs, Indices]:
        """All couples in reach, and the number of each one's driving tooth (in a mirror, counted backward)."""
        pitch = self.first.pitch
        slack = 2 * max(map(abs, self.first.turns), default=0.0)
        lowest = np.ceil((self.window[0] - slack - rest) / pitch).astype(int)
        number = max(0, ceil((self.window[1] - self.window[0] + 2 * slack) / pitch) + 1)
        j = (lowest[:, None] + np.arange(number)).ravel()
        position = np.repeat(np.arange(len(rest)), number)
        # in a mirror tooth j touches the tooth behind it, whose number is one more when counted backward
        mate = j if self.sign > 0 else j + 1
        tooth1, tooth2 = (self.sign * j) % self.first.z, (self.sign * mate) % self.second.z
        x = rest[position] + j * pitch + self.sign * _taken(self.first.turns, tooth1)
        place = np.asarray(mate * self.second.pitch + self.sign * _taken(self.second.turns, tooth2), dtype=np.float64)
        shape1 = tooth1 if len(self.first.teeth) > 1 else np.zeros_like(j)
        shape2 = tooth2 if len(self.second.teeth) > 1 else np.zeros_like(j)
        near = (x >= self.window[0]) & (x <= self.window[1])
        return some(CandidatePairs(x, shape1, shape2, place, position), near), j[near]

    def _block(self, rest: Floats, within: float) -> tuple[Any, ...]:
        couples, j = self._couples(rest)
        judge, count = self.judge, len(rest)
        if not len(j):
            return _nothing(count)
        margin = _MARGIN * self.second.pitch + within
        found = judge.touch(couples, judge.furthest(couples, judge.segments(couples), margin))
        position = couples.position[found.couple]
        best = np.full(count, -np.inf)
        np.maximum.at(best, position, found.angle)
        sharing = self._sharing(found, best[position] - within, couples, count)
        kind = self._kind(found)
        # of touches that tie: the later couple, then what has fewer corners, then the furthest
        ties = np.flatnonzero(found.angle >= best[position] - _TIE)
        order = ties[np.lexsort((found.angle[ties], kind[ties] == 0, j[found.couple[ties]], position[ties]))]
        last = np.flatnonzero(np.diff(position[order], append=count))
        chosen = order[last]
        where = position[chosen]
        angle, speed, pair, kinds, r1, r2, _, curves = _nothing(count)
        angle[where], speed[where], kinds[where] = best[where], found.speed[chosen], kind[chosen]
        pair[where], r1[where], r2[where] = j[found.couple[chosen]], found.radius1[chosen], found.radius2[chosen]
        curves[:, where] = judge.first.curve[found.piece1[chosen]], judge.second.curve[found.piece2[chosen]]
        return angle, speed, pair, kinds, r1, r2, sharing, curves

    def _kind(self, found: FirstTouches) -> Indices:
        """Which of the two is at a corner: 1, 2, both 3."""
        kind = np.zeros(len(found.u), int)
        for at, (table, piece, u) in enumerate(
            ((self.judge.first, found.piece1, found.u), (self.judge.second, found.piece2, found.v))
        ):
            kind += (1 + at) * ((u == -1) & table.corners[0][piece] | (u == 1) & table.corners[1][piece])
        return kind

    def _sharing(self, found: FirstTouches, least: Floats, couples: CandidatePairs, count: int) -> Indices:
        """How many couples have a touch at `least` or beyond."""
        touching = np.unique(found.couple[found.angle >= least])
        return np.bincount(couples.position[touching], minlength=count)


def _taken(turns: tuple[float, ...], tooth: Indices) -> Floats | float:
    return np.array(turns)[tooth] if turns else 0.0


def _nothing(count: int) -> tuple[Any, ...]:
    """The fields of `FlankContact` where no tooth is in reach."""
    nan = np.full(count, np.nan)
    none = np.full(count, -1)
    return (
        nan,
        nan.copy(),
        np.zeros(count, int),
        none,
        nan.copy(),
        nan.copy(),
        np.zeros(count, int),
        -np.ones((2, count), int),
    )


def _check(first: GearOutline, second: GearOutline, distance: float) -> None:
    """Whether two wheels can be looked at together."""
    if first.bevel != second.bevel or (first.ring and second.ring):
        raise QuestionError(
            Problem(
                "two wheels do not go together",
                "one is flat and the other on a sphere, or both are rings",
                "give two spur wheels, two bevel wheels, or a wheel and a ring",
            )
        )
    limit = pi if first.bevel else np.inf
    if not 0 < distance < limit:
        raise RangeError(
            Problem(
                f"a distance of {distance:.6g} between axles",
                "it must be above 0" + (", and a shaft angle below 180 deg" if first.bevel else ""),
                "give the distance from axle to axle (bevel: the shaft angle in rad)",
            )
        )
