"""The verdict on a train: what it does with its inputs, and the loops that hold it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from geartrain.numerics.decimal_text import abridged_text
from geartrain.numerics.plain_data import Result


@dataclass(frozen=True, slots=True)
class Loop(Result):
    """A closed loop of meshing wheels in one carrier's frame: links in order and the product of its ratios.

    `product` is the speed with which the walk round the loop comes back, as a multiple of the speed it left
    with: 1 closes (one mesh is redundant), anything else locks the loop to its carrier.
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
        pairs, product = ", ".join(self.pairs), abridged_text(self.product)
        return f"loop {' - '.join(self.links)} (pairs {pairs}; ratio product {product})"


VerdictKind = Literal["determined", "free", "locked", "contradictory"]


@dataclass(frozen=True, slots=True)
class Verdict(Result):
    """What a train does with its inputs. A verdict is an answer, never an exception.

    determined      every link's speed follows from the inputs
    free            `links` are undetermined; prescribing `fixes` too would determine them
    locked          the input cannot move: `loops`, or the brakes and clutches in `prescriptions`, hold it
    contradictory   `prescriptions` cannot hold at once
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
