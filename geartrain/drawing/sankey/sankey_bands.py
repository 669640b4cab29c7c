"""What is placed: nodes in columns, bands between them, those that turn back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.dynamics import PowerNode, PowerStream

NAME = 0.46  # room above a node
DROP, BEND = 0.14, 0.05  # how far a loss falls, and the inner radius on its way down
TURN = 0.14  # inner radius of a band that turns back
_BETWEEN = 0.1  # nodes of a column
_WIDTHS = {"in": 0.0, "out": 0.0, "shaft": 0.08, "pair": 0.2, "bearing": 0.2}


@dataclass(eq=False)
class SankeySpot:
    """A node in its column, or (without one) the place where a band passes a column.

    power         that passes it; `shed`, width of what it loses
    left, right   room for words on both sides of its middle
    """

    node: PowerNode | None
    column: int
    height: float
    power: Fraction = Fraction(0)
    shed: float = 0.0
    left: float = 0.0
    right: float = 0.0
    top: float = 0.0
    before: list[BandSegment] = field(default_factory=list)
    after: list[BandSegment] = field(default_factory=list)

    @property
    def above(self) -> float:
        """Room for the name."""
        return NAME if self.node else _BETWEEN

    @property
    def below(self) -> float:
        """Room for what is lost."""
        return DROP + self.head + 0.24 if self.shed else _BETWEEN

    @property
    def head(self) -> float:
        """Length of the arrow head of what it loses."""
        return min(max(0.3 * self.shed, 0.08), 0.2)

    @property
    def width(self) -> float:
        """Of its box."""
        return _WIDTHS[self.node.kind] if self.node else 0.0


@dataclass(eq=False)
class BandSegment:
    """A band between two spots: in neighbouring columns, or back; its tops at both."""

    source: SankeySpot
    target: SankeySpot
    stream: PowerStream
    width: float
    back: bool = False
    start: float = 0.0
    end: float = 0.0

    @property
    def span(self) -> int:
        """Columns that a band runs back over; 0 of one that leads on."""
        return self.source.column - self.target.column if self.back else 0


@dataclass(frozen=True)
class ReturnBand:
    """A band that runs back: how far right of its source and left of its target it turns, and the top of its lane."""

    piece: BandSegment
    right: float
    left: float
    lane: float


@dataclass(frozen=True)
class SankeyLayout:
    """Everything in its place.

    bands   that lead on, each as its pieces from column to column; `turns`, those that run back
    x       middle of each column
    scale   inches by power
    sheds   what is lost by node
    low     least y of all parts
    """

    spots: Sequence[SankeySpot]
    bands: Sequence[Sequence[BandSegment]]
    turns: Sequence[ReturnBand]
    x: Sequence[float]
    scale: float
    sheds: Mapping[PowerNode, Fraction]
    low: float
    width: float
    height: float
