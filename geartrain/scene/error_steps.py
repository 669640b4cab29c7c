"""How angles of a scene differ from their exact means: laws of teeth and pins as tables, and the steps of their sum."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar

from geartrain.numerics.arrays import packed
from geartrain.numerics.results import Key, Result

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats


@dataclass(frozen=True, slots=True)
class ErrorLawTable(Result):
    """The periodic error of a gear pair or a pin in a slot, as polynomials between breaks.

    Attributes
    ----------
    pair : str
        The pair, the first of those that share the law.
    period : float
        Of the driver's angle [rad].
    breaks : array of float, (n + 1,)
        Of the driver's angle, from 0 to the period [rad].
    coefficients : array of float, (n, degree + 1)
        Of the driven side's error [rad], in powers of the driver's angle less the middle of its cell.
    uncertainty : float
        Greatest error of the table [rad].

    See Also
    --------
    Movement : holds it.
    """

    KEYS: ClassVar[tuple[str | Key, ...]] = (
        "pair",
        "period",
        Key("breaks", "packed_breaks"),
        Key("coefficients", "packed_coefficients"),
        "uncertainty",
    )

    pair: str
    period: float
    breaks: Floats
    coefficients: Floats
    uncertainty: float

    @property
    def packed_breaks(self) -> str:
        """The breaks as a page carries them."""
        return packed(self.breaks)

    @property
    def packed_coefficients(self) -> str:
        """The coefficients as a page carries them, row by row."""
        return packed(self.coefficients)


@dataclass(frozen=True, slots=True)
class ErrorSource:
    """A pair whose law adds to the errors of a scene.

    After t turns of the lead the driver's forward angle is

        S = start + period frac(cycles t) + forward (driver_sense error[driver] - carrier_sense error[carrier])

    and the pair adds sense law(S) to what it drives.

    Attributes
    ----------
    pair : str
        Name of the gear pair or coupling.
    law : int
        Index of its law in the movement.
    driver, carrier : int
        Indices of bodies.
    driver_sense, carrier_sense : int
        1 or -1: how the errors of these bodies count in the pair's own sense.
    cycles : str
        Periods of the law in a turn of the lead, exact.
    start : float
        S at the start [rad].
    forward : int
        1 or -1: the sense in which the driver turns.
    sense : int
        1 or -1: the sign with which the law counts.

    See Also
    --------
    Movement : holds it.
    """

    pair: str
    law: int
    driver: int
    carrier: int
    driver_sense: int
    carrier_sense: int
    cycles: str
    start: float
    forward: int
    sense: int


@dataclass(frozen=True, slots=True)
class ErrorStep:
    """Errors of some bodies from those known: error[bodies] = from_known error[known] + from_sources delta[sources].

    Attributes
    ----------
    bodies, known : sequence of int
        Indices of bodies: those found in this step, and those it takes from steps before.
    from_known : sequence of sequence of float
        Matrix, a row a body found.
    sources : sequence of int
        Indices of sources.
    from_sources : sequence of sequence of float
        Matrix, a row a body found.
    coupled : bool
        True where sources depend on the bodies found: they are found together, by iteration.

    See Also
    --------
    Movement : holds it.
    """

    bodies: Sequence[int]
    known: Sequence[int]
    from_known: Sequence[Sequence[float]]
    sources: Sequence[int]
    from_sources: Sequence[Sequence[float]]
    coupled: bool


@dataclass(frozen=True, slots=True)
class Movement:
    """How errors of angles follow from the turns of the lead: the steps in order, then constant offsets.

    Attributes
    ----------
    kind : {"exact", "real", "mean", "still"}
        Nothing ripples; teeth or pins ripple; they would, but cannot be followed; no speed is determined.
    why : str
        Why it is mean or still.
    period : str or None
        Turns of the lead after which all stands as before, exact; None where nothing repeats.
    laws : sequence of ErrorLawTable
        Laws, those of pairs alike once.
    sources : sequence of ErrorSource
        The pairs that have them.
    steps : sequence of ErrorStep
        In the order in which they can be taken.
    offsets : mapping of str to float
        Constant errors by the index of the body [rad].

    See Also
    --------
    make_scene : gives it, in `Scene.movement`.
    """

    kind: str
    why: str = ""
    period: str | None = None
    laws: Sequence[ErrorLawTable] = ()
    sources: Sequence[ErrorSource] = ()
    steps: Sequence[ErrorStep] = ()
    offsets: Mapping[str, float] = field(default_factory=dict)
