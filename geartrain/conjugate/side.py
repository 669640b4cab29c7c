"""One side of a path of contact, approach or recess, as pieces in order of the distance from the pitch point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from geartrain.conjugate.pieces import Piece, Ray

if TYPE_CHECKING:
    from collections.abc import Callable

    from geartrain.conjugate.pitch import Floats


@dataclass(frozen=True)
class Side:
    """Pieces that follow each other outwards, from the pitch point or from the first contact beyond it.

    X of a side that begins beyond the pitch point counts from its first contact.
    """

    pieces: Sequence[Piece]

    @property
    def start(self) -> float:
        """Distance of the first contact from the pitch point; 0 but for paths that keep off it."""
        return self.pieces[0].start

    @property
    def end(self) -> float:
        """Distance of the last contact from the pitch point."""
        return self.pieces[-1].end

    @property
    def arc(self) -> float:
        """Pitch-line displacement over the whole side."""
        return float(self.travel(np.array(self.end)))

    @property
    def joints(self) -> tuple[float, ...]:
        """Distances at which a piece ends."""
        return tuple(piece.end for piece in self.pieces)

    def sin_psi(self, d: Floats) -> Floats:
        """Sine of the pressure angle at d in [0, end]."""
        return self._by_piece(d, lambda piece, at: piece.sin_psi(at))

    def slope(self, d: Floats) -> Floats:
        """d(sin psi)/dd at d."""
        return self._by_piece(d, lambda piece, at: piece.slope(at))

    def travel(self, d: Floats) -> Floats:
        """X at d, from the pitch point."""
        total = 0.0
        starts = []
        for piece in self.pieces:
            starts.append(total)
            total += float(piece.travel(np.array(piece.end)))
        offsets = dict(zip(map(id, self.pieces), starts, strict=True))
        return self._by_piece(d, lambda piece, at: offsets[id(piece)] + piece.travel(at))

    def distance(self, X: Floats) -> Floats:
        """d at X, by Newton's method on dd/dX = cos psi."""
        X = np.asarray(X, dtype=float)
        arc = self.arc
        d = self.start + (np.clip(X / arc, 0.0, 1.0) * (self.end - self.start) if arc else np.zeros(X.shape))
        for _ in range(40):
            step = (self.travel(d) - X) * np.sqrt(np.maximum(1 - self.sin_psi(d) ** 2, 0.0))
            d = np.clip(d - step, self.start, self.end)
            if np.abs(step).max(initial=0.0) <= 4e-16 * self.end:
                break
        return d

    def _by_piece(self, d: Floats, ask: Callable[[Piece, Floats], Floats]) -> Floats:
        d = np.asarray(d, dtype=float)
        if len(self.pieces) == 1:
            return ask(self.pieces[0], d)
        found = np.empty(d.shape)
        which = np.clip(np.searchsorted(self.joints[:-1], d, side="right"), 0, len(self.pieces) - 1)
        for at, piece in enumerate(self.pieces):
            here = which == at
            if here.any():
                found[here] = ask(piece, d[here])
        return found


def none(psi: float) -> Side:
    """A side without contact: the path begins or ends at the pitch point, under a pressure angle `psi` (rad)."""
    return Side((Ray(psi, 0.0),))
