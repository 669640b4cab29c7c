"""The verdict on a train: what it does with its inputs, and the loops that hold it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from geartrain.numerics.decimal_text import abridged_text
from geartrain.numerics.plain_data import Result

MOST_NAMES = 12


def abridged_names(names: Sequence[str], mark: str = ", ") -> str:
    """The first names, and how many more there are.

    >>> abridged_names(["a", "b"], " - "), abridged_names("abcdefghijklmnop")
    ('a - b', 'a, b, c, d, e, f, g, h, i, j, k, l and 4 more')
    """
    if len(names) <= MOST_NAMES + 1:
        return mark.join(names)
    return f"{mark.join(names[:MOST_NAMES])} and {len(names) - MOST_NAMES} more"


@dataclass(frozen=True, slots=True)
class Loop(Result):
    """A closed loop of meshing wheels in one carrier's frame, with the product of its ratios (docs/theory.md, 7).

    Attributes
    ----------
    carrier : str
        The link from which all pairs of the loop are seen.
    links : tuple of str
        Links in order.
    pairs : tuple of str
        Ids of the pairs in order; the last one closes the loop.
    product : Fraction
        Speed with which a walk round the loop comes back, as a multiple of that with which it left, equation (20): 1
        closes, and one mesh is redundant; anything else locks the loop to its carrier.

    Examples
    --------
    >>> import geartrain
    >>> loop = geartrain.load("four-gear-loop").mobility.loops[0]
    >>> loop.links, loop.product, loop.closes
    (('a', 'b', 'c', 'd'), Fraction(1, 1), True)
    """

    carrier: str
    links: tuple[str, ...]
    pairs: tuple[str, ...]
    product: Fraction

    @property
    def closes(self) -> bool:
        """True if the loop turns; its last mesh is then redundant."""
        return self.product == 1

    def __str__(self) -> str:
        pairs, product = abridged_names(self.pairs), abridged_text(self.product)
        return f"loop {abridged_names(self.links, ' - ')} (pairs {pairs}; ratio product {product})"


VerdictKind = Literal["determined", "free", "locked", "contradictory", "refused"]


@dataclass(frozen=True, slots=True)
class Verdict(Result):
    """What a train does with its inputs, decided by exact rank; equation (22) of docs/theory.md is its certificate.

    A verdict is an answer, never an exception. It is true if it is `determined`.

    Attributes
    ----------
    kind : {"determined", "free", "locked", "contradictory", "refused"}
        determined: every link's speed follows from the inputs. free: `links` are undetermined. locked: the input cannot
        move, for `loops` or `prescriptions` hold it. contradictory: `prescriptions` cannot hold at once. refused: no
        speed can be calculated in one of several states, for its locks make a linkage, or it drives no rotation.
    text : str
        The verdict in a sentence, with what it follows from.
    links : tuple of str
        Links whose speed is not determined.
    fixes : tuple of str
        Links which, prescribed too, would determine all.
    prescriptions : tuple of str
        Inputs, brakes and clutches that take part in a lock or contradiction.
    loops : tuple of Loop
        Loops that do not close and hold the train, or a part of it.

    Examples
    --------
    >>> import geartrain
    >>> verdict = geartrain.load("planetary-24-18-60").solve().verdict
    >>> print(verdict)
    determined: every speed follows from sun
    """

    kind: VerdictKind
    text: str
    links: tuple[str, ...] = ()
    fixes: tuple[str, ...] = ()
    prescriptions: tuple[str, ...] = ()
    loops: tuple[Loop, ...] = ()

    def __bool__(self) -> bool:
        return self.kind == "determined"

    def __str__(self) -> str:
        return f"{self.kind}: {self.text}"
