"""Motion with real teeth and pins: every mesh's error carried to every link, and back into the angles of the meshes.

With the mean motion taken out, the angles of all links are linear in the errors of the meshes: theta = mean + G delta.
Each error depends on the angle at which its own driver stands, which the errors of other meshes have moved. Along an
ordinary train those come before it, and one pass composes the laws exactly; around a differential they may hang on each
other, and are iterated until nothing changes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geartrain.teeth.base import Law

    Floats = NDArray[np.float64]

_CHUNK = 32768  # positions worked on at once
_MOST_SWEEPS = 200
_SETTLED = 1e-14  # rad
_NOTHING = 1e-14  # of the greatest influence: what is less is rounding


class DivergenceError(ArithmeticError):
    """The errors of coupled meshes do not settle: their driven sides react on their drivers too strongly."""


@dataclass(frozen=True)
class Source:
    """One mesh that ripples.

    law        of its driver's forward angle
    mean       mean relative angle of the driver per radian of the input, signed
    sense      of the driven side's mean relative motion, 1 or -1
    """

    id: str
    law: Law
    mean: float
    sense: int

    @property
    def forward(self) -> int:
        """1, or -1 where the driver turns backwards on average."""
        return -1 if self.mean < 0 else 1


@dataclass(frozen=True)
class Composition:
    """Sources in order, what each does to the drivers of the others, and to the links asked for.

    influence   (sources, sources): radians of driver m's relative angle per radian of source n's driven error
    response    (links, sources): radians of each link per radian of each source's driven error
    """

    sources: tuple[Source, ...]
    influence: Floats
    response: Floats

    def order(self) -> Iterator[list[int]]:
        """Blocks of sources, each after all it hangs on; more than one in a block are coupled."""
        hangs = np.abs(self.influence) > _NOTHING * max(1.0, float(np.max(np.abs(self.influence), initial=0.0)))
        left = list(range(len(self.sources)))
        while left:
            ready = [m for m in left if not any(hangs[m, n] for n in left)]
            block = ready[:1] or _tightest(hangs, left)
            yield block
            left = [m for m in left if m not in block]

    def errors(self, angle: Floats) -> tuple[Floats, Floats]:
        """Errors of all sources and their rates per radian of the input, both (sources, positions)."""
        delta = np.zeros((len(self.sources), len(angle)))
        rate = np.zeros_like(delta)
        for block in self.order():
            coupled = len(block) > 1 or self.influence[block[0], block[0]] != 0
            self._settle(block, angle, delta, rate, _MOST_SWEEPS if coupled else 1)
        return delta, rate

    def _settle(self, block: Sequence[int], angle: Floats, delta: Floats, rate: Floats, sweeps: int) -> None:
        for _ in range(sweeps):
            moved = 0.0
            for m in block:
                source, row = self.sources[m], self.influence[m]
                S = source.forward * (source.mean * angle + row @ delta)
                turning = source.forward * (source.mean + row @ rate)
                new = source.sense * source.law.error(S)
                new_rate = source.sense * (source.law.speed(S) - float(source.law.ratio)) * turning
                if sweeps > 1:
                    moved = max(moved, float(np.max(np.abs(new - delta[m]))), float(np.max(np.abs(new_rate - rate[m]))))
                delta[m], rate[m] = new, new_rate
            if moved <= _SETTLED:
                return
        # a corner of a law may flip between two couples of teeth for ever, by next to nothing
        if moved > 1e-9:
            names = ", ".join(self.sources[m].id for m in block)
            raise DivergenceError(f"the errors of {names} do not settle")

    def motion(self, angle: Floats, on_done: Callable[[int], None] = lambda _: None) -> tuple[Floats, Floats]:
        """Errors of the links asked for (rad) and of their speeds per radian of the input, (links, positions)."""
        error = np.empty((len(self.response), len(angle)))
        speed = np.empty_like(error)
        for start in range(0, len(angle), _CHUNK):
            part = slice(start, start + _CHUNK)
            delta, rate = self.errors(angle[part])
            error[:, part], speed[:, part] = self.response @ delta, self.response @ rate
            on_done(delta.shape[1])
        return error, speed


def _tightest(hangs: NDArray[np.bool_], left: Sequence[int]) -> list[int]:
    """The sources that hang on each other, and on nothing else that is left."""
    best = list(left)
    for m in left:
        seen, queue = {m}, [m]
        while queue:
            for n in left:
                if hangs[queue[0], n] and n not in seen:
                    seen.add(n)
                    queue.append(n)
            queue.pop(0)
        if len(seen) < len(best):
            best = sorted(seen)
    return best
