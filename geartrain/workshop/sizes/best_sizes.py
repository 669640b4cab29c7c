"""The best sizes of a pair with triangular teeth, next to radii by rule, and judged by the contact of their outlines.

The outlines are drawn from the sizes and know nothing of the transmission function of such teeth.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import cos, sin
from typing import TYPE_CHECKING, Any, ClassVar

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.results import Pictured, Result, Tabular
from geartrain.teeth.contact.outline_transmission import OutlineGears, OutlineTransmission
from geartrain.workshop.sizes.size_design import (
    AIMS,
    SizeLimit,
    ToothSizes,
    equal_depth_radii,
    impact_of,
    size_columns,
)
from geartrain.workshop.sizes.size_search import ChanceLimit, Range, SizeSearch, best_within, checked_ranges

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact import GearOutline
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


_NOTHING = 1e-12  # figures below it are 0 but for rounding
_CELLS, _NODES = 24, 4  # of each smooth stretch of the outlines' law, and the nodes of Gauss in each


@dataclass(frozen=True)
class BestToothSizes(Tabular, Pictured, Result):
    """The best sizes of a pair with triangular teeth, and what they are better than.

    See Also
    --------
    find_tooth_sizes : an example.
    """

    ROW = "ToothSizes"
    MEANINGS: ClassVar = {
        "design": "Name of the design.",
        "half_angle_1": "Half angle of the teeth of the first wheel [rad].",
        "half_angle_2": "Half angle of the teeth of the second wheel [rad].",
    }

    PAGE = "workshop.sizes.tooth_sizes_report:describe_tooth_sizes"

    FIGURE = "tooth_sizes_figure"
    DRAWN_IN = "workshop"

    KEYS = (
        *("teeth", "driver", "friction", "aims", "free", "limits", "best", "outlines"),
        *("equal_depth", "pitch_true", "front", "evaluations", "stops"),
    )

    aims: tuple[str, ...]
    """What was asked for: one of `loss`, `error`, `impact`, `jam`, or two for a front between them."""
    free: Mapping[str, Range]
    """Bounds of the free parameters; angles in rad."""
    limits: tuple[SizeLimit, ...]
    """What had to be kept."""
    best: ToothSizes
    """The best in the first aim."""
    outlines: OutlineAgreement
    """What the contact of the drawn outlines says of it."""
    equal_depth: ToothSizes | None
    """The pair with radii of equal depth, and the window and half angles of `start`; None where it does not turn."""
    pitch_true: ToothSizes | None
    """The pair with pitch-true radii, and the window and half angles of `start`; None where it does not turn."""
    front: tuple[ToothSizes, ...]
    """With two aims, the designs that none is better than in both, from the best in the first to that in the second."""
    evaluations: int
    """Designs that were looked at."""
    stops: float | None
    """The chance that the best stops, where that was limited."""
    tried: tuple[ToothSizes, ...]
    """Those of them that turn and keep the limits."""

    def _summary(self) -> str:
        aim = self.aims[0]
        z1, z2 = self.teeth
        best = f"{aim} {getattr(self.best, aim):.4g}"
        return f"{z1}/{z2} teeth: minimum {' and '.join(self.aims)}, {best}, {self.evaluations} designs"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """A row for the best, those by rule that turn, and those of a front: sizes and figures; angles in rad."""
        rule = {"best": self.best, "equal depth": self.equal_depth, "pitch-true": self.pitch_true}
        rows = [(name, sizes) for name, sizes in rule.items() if sizes is not None]
        rows += [(f"front {at}", sizes) for at, sizes in enumerate(self.front, start=1)]
        return {"design": [name for name, _ in rows], **size_columns([sizes for _, sizes in rows])}

    @property
    def teeth(self) -> tuple[int, int]:
        """Of the first and the second wheel."""
        return self.best.teeth

    @property
    def driver(self) -> int:
        """Which wheel drives, 1 or 2."""
        return self.best.driver

    @property
    def friction(self) -> float:
        """Coefficient of friction."""
        return self.best.friction


def find_tooth_sizes(
    start: ToothSizes,
    aims: Sequence[str] = ("loss",),
    free: Mapping[str, Range | None] | None = None,
    limits: Sequence[SizeLimit] = (),
    chance: ChanceLimit | None = None,
    on_design: Callable[[], None] = lambda: None,
) -> BestToothSizes:
    """The radii, the clearance and the half angle with which a pair with triangular teeth is best.

    Parameters
    ----------
    start : ToothSizes
        The pair; what is not free stays as it is here.
    aims : sequence of str
        One or two of `loss`, `error`, `impact` and `jam`; with two there is a front between them.
    free : mapping of str to (float, float), optional
        Bounds of the free parameters, of `radii`, `window`, `half_angle` [rad]; None for those of `USUAL_RANGES`. By
        default the radii are free.
    limits : sequence of SizeLimit
        What the design has to keep.
    chance : ChanceLimit, optional
        What a pair cut with errors has to keep; with one aim only.
    on_design : callable
        Called at each design that is looked at.

    Returns
    -------
    BestToothSizes
        The best design, confirmed by the contact of its outlines.

    Raises
    ------
    QuestionError
        For aims, parameters or ranges that there are not, and where no design turns and keeps the limits.

    Notes
    -----
    DIRECT (Jones, Perttunen, Stuckman 1993), polished by Brent's bounded method or by that of Nelder and Mead;
    docs/teeth.md, section on the best sizes.

    Examples
    --------
    >>> from math import pi
    >>> found = find_tooth_sizes(ToothSizes((48, 96), 1.0, 0.5, (pi / 6, pi / 6), 0.2), free={"radii": (0.95, 1.0)})
    >>> round(found.best.radii, 3), round(found.best.loss, 4), round(found.equal_depth.loss, 4)
    (0.982, 0.0089, 0.0319)
    """
    ranges = _checked(start, tuple(aims), {"radii": None} if free is None else free)
    search = SizeSearch(start, ranges, limits, on_design)
    rules = [start.at({"radii": radii}) for radii in (equal_depth_radii(*start.teeth, start.half_angles), 1.0)]
    equal, true = (each if each.runs else None for each in rules)
    best = search.minimum(aims[0], [start, *(each for each in rules if each.runs and "radii" in ranges)])
    if chance is not None and len(aims) == 2:
        raise QuestionError(Problem("a front has no limit on a chance", "it would cost too much", "ask for one aim"))
    best, stops = (best, None) if chance is None else best_within(search, aims[0], chance)
    front = search.front(*aims) if len(aims) == 2 else ()
    tried = tuple(each for each in search.designs.values() if search.keeps(each))
    return BestToothSizes(
        tuple(aims),
        ranges,
        tuple(limits),
        best,
        confirm_by_outlines(best),
        equal,
        true,
        front,
        len(search.designs),
        stops,
        tried,
    )


def _checked(start: ToothSizes, aims: tuple[str, ...], free: Mapping[str, Range | None]) -> dict[str, Range]:
    """The ranges of what is free. Raises `QuestionError`."""
    if not 1 <= len(set(aims)) == len(aims) <= 2 or not {*aims} <= {*AIMS}:
        what = f"'{', '.join(aims)}' is nothing to be best in"
        raise QuestionError(Problem(what, "", f"ask for one or two of {', '.join(AIMS)}"))
    if "loss" in aims and not start.friction:
        what = "without friction every tooth loses nothing"
        raise QuestionError(Problem(what, "", "give a friction above 0, or another aim"))
    return checked_ranges(free)


# ---------------------------------------------------------------------------------------- contact of the drawn outlines


@dataclass(frozen=True)
class OutlineAgreement(Result):
    """What the contact of two drawn outlines says of a design, beside what its law says.

    See Also
    --------
    find_tooth_sizes : confirms its answer so.
    """

    KEYS = ("turns", "loss", "error", "impact", "backlash", "difference")

    loss: tuple[float, float]
    """Loss by the law, and by the outlines."""
    error: tuple[float, float]
    """Error by the law, and by the outlines, in the unit of `ToothSizes`."""
    impact: tuple[float, float]
    """Impact by the law, and by the outlines."""
    backlash: tuple[float, float]
    """Play by the law, and by the outlines, in the unit of `ToothSizes`."""
    turns: bool
    """The outlines turn without a jam and without losing contact."""

    @property
    def difference(self) -> float:
        """The greatest of the `differences`."""
        return max(self.differences.values())

    @property
    def differences(self) -> Mapping[str, float]:
        """By figure, the difference of the two over the greater of them."""
        pairs = {"loss": self.loss, "error": self.error, "impact": self.impact, "backlash": self.backlash}
        return {name: abs(a - b) / max(abs(a), abs(b), _NOTHING) for name, (a, b) in pairs.items()}


def outline_transmission(sizes: TriangularSizes, friction: float) -> OutlineTransmission:
    """The law of the drawn outlines of a pair, its first wheel driving."""
    first = _outline(sizes.z1, sizes.R1, sizes.beta1, sizes.flanks[0], sizes.ring == 1)
    second = _outline(sizes.z2, sizes.R2, sizes.beta2, sizes.flanks[1], sizes.ring == 2)
    # teeth drawn about their middles: the driven angle is counted from there, and nothing is added to the play
    return OutlineTransmission(OutlineGears(first, second, sizes.D, 0.0, 0.0), friction)


def confirm_by_outlines(design: ToothSizes) -> OutlineAgreement:
    """Whether the outlines of a design that turns do what its law says."""
    transmission = outline_transmission(design.sizes, design.friction)
    low, high = transmission.error_range()
    return OutlineAgreement(
        (design.loss, 1 - _mean_efficiency(transmission)),
        (design.error, high - low),
        (design.impact, impact_of(transmission)),
        (design.backlash, transmission.verdict.backlash),
        bool(transmission.verdict),
    )


def _mean_efficiency(transmission: OutlineTransmission) -> float:
    """Mean over the driver's angle, in cells so small that the corner at the line of centres is in one of many."""
    import numpy as np

    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    breaks = transmission.table.breaks
    low, high = breaks[:-1, None], breaks[1:, None]
    edges = low + (high - low) * np.linspace(0, 1, _CELLS + 1)
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, np.diff(edges) / 2
    found = transmission.efficiency((middle[..., None] + half[..., None] * nodes).ravel())
    return float(found @ (half[..., None] * weights).ravel()) / float(breaks[-1] - breaks[0])


def _outline(z: int, R: float, beta: float, length: float, ring: bool) -> GearOutline:
    """A wheel of teeth with straight flanks from tips at R, inwards or, of a ring, outwards."""
    import numpy as np

    from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks

    def points(s: Floats) -> Floats:
        return np.stack([s * sin(beta), R + (s if ring else -s) * cos(beta)], axis=1)

    return GearOutline((ToothFlanks.symmetric((OutlineCurve(points, 0.0, length),)),), z, ring=ring)
