"""Best sizes of a pair with triangular teeth, compared with designs by simple rules and verified by its drawn outlines.

The outlines are drawn from the sizes only, so they are an independent check of the transmission function.
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
from geartrain.workshop.sizes.size_search import ProbabilityLimit, Range, SizeSearch, best_within, checked_ranges

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.contact import GearOutline
    from geartrain.teeth.triangular.pair_geometry import TriangularSizes


_NOTHING = 1e-12  # smaller figures are rounding errors
_CELLS, _NODES = 24, 4  # cells of each smooth interval, and Gauss nodes in each; many cells reduce the effect of kinks


@dataclass(frozen=True)
class BestToothSizes(Tabular, Pictured, Result):
    """Best sizes of a pair with triangular teeth, and other designs for comparison."""

    ROW = "ToothSizes"
    MEANINGS: ClassVar = {
        "design": "Name of the design.",
        "half_angle_1": "Half angle of the teeth of the first wheel [rad].",
        "half_angle_2": "Half angle of the teeth of the second wheel [rad].",
    }

    PAGE = "workshop.sizes.tooth_sizes_report:describe_tooth_sizes"

    FIGURE = "workshop.sizes.tooth_sizes_plot:tooth_sizes_figure"

    KEYS = (
        *("teeth", "driver", "friction", "aims", "free", "limits", "best", "outlines"),
        *("equal_depth", "pitch_true", "front", "evaluations", "stops"),
    )

    aims: tuple[str, ...]
    """Objectives: one of `loss`, `error`, `impact` and `jam`, or two of them for a Pareto front."""
    free: Mapping[str, Range]
    """Bounds of the free parameters, keyed by parameter name. Angles are in rad."""
    limits: tuple[SizeLimit, ...]
    """Limits that the designs must satisfy."""
    best: ToothSizes
    """Best design for the first objective."""
    outlines: OutlineAgreement
    """Comparison of the properties of the best design with the properties computed from its drawn outlines."""
    equal_depth: ToothSizes | None
    """Initial design with the radii of teeth of equal depth; None if it cannot turn."""
    pitch_true: ToothSizes | None
    """Initial design with tip radii proportional to the tooth numbers; None if it cannot turn."""
    front: tuple[ToothSizes, ...]
    """Pareto front, from the best design for the first objective to that for the second; empty for one objective."""
    evaluations: int
    """Number of designs that the search evaluated."""
    stops: float | None
    """Probability that the best design jams or clashes, 0 to 1; None if this probability was not limited."""
    tried: tuple[ToothSizes, ...]
    """Evaluated designs that can turn and satisfy all limits."""

    def _summary(self) -> str:
        aim = self.aims[0]
        z1, z2 = self.teeth
        best = f"{aim} {getattr(self.best, aim):.4g}"
        return f"{z1}/{z2} teeth: minimum {' and '.join(self.aims)}, {best}, {self.evaluations} designs"

    @property
    def columns(self) -> Mapping[str, Sequence[Any]]:
        """Columns of a table with the best design, the rule-based designs that can turn, and the Pareto front."""
        rule = {"best": self.best, "equal depth": self.equal_depth, "pitch-true": self.pitch_true}
        rows = [(name, sizes) for name, sizes in rule.items() if sizes is not None]
        rows += [(f"front {at}", sizes) for at, sizes in enumerate(self.front, start=1)]
        return {"design": [name for name, _ in rows], **size_columns([sizes for _, sizes in rows])}

    @property
    def teeth(self) -> tuple[int, int]:
        """Numbers of teeth of the first and the second wheel."""
        return self.best.teeth

    @property
    def driver(self) -> int:
        """Number of the driving wheel, 1 or 2."""
        return self.best.driver

    @property
    def friction(self) -> float:
        """Coefficient of friction of the flanks [1]."""
        return self.best.friction


def find_tooth_sizes(
    start: ToothSizes,
    aims: Sequence[str] = ("loss",),
    free: Mapping[str, Range | None] | None = None,
    limits: Sequence[SizeLimit] = (),
    probability: ProbabilityLimit | None = None,
    on_design: Callable[[], None] = lambda: None,
) -> BestToothSizes:
    """Find the radii, clearance and half angle of a pair with triangular teeth that optimise one or two objectives.

    Parameters
    ----------
    start : ToothSizes
        Initial design; parameters that are not free keep its values.
    aims : sequence of str
        One or two of the objectives `loss`, `error` (transmission error), `impact` and `jam` (margin before a jam); two
        objectives give a Pareto front.
    free : mapping of str to (float, float), optional
        Bounds of the free parameters `radii` (tip radius ratio divided by tooth ratio), `window` (position of the
        clearance factor between its limits, 0 to 1) and `half_angle` [rad]; None for the bounds in `USUAL_RANGES`. By
        default only the radii are free.
    limits : sequence of SizeLimit
        Limits that the design must satisfy.
    probability : ProbabilityLimit, optional
        Limit on the probability that the pair with cutting errors jams or clashes. It is allowed only if there is one
        objective.
    on_design : callable
        Progress function, called after each evaluated design.

    Returns
    -------
    BestToothSizes
        Best design, verified by the contact of its drawn outlines.

    Raises
    ------
    QuestionError
        If an objective, parameter or range is invalid, or if no design can turn and satisfies the limits.

    Notes
    -----
    The search uses the DIRECT algorithm (Jones, Perttunen, Stuckman 1993), followed by Brent's bounded method or the
    Nelder-Mead method. See docs/teeth.md, section on the best sizes.

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
    # the rule-based designs are starts, so that the result is never worse than they are
    best = search.minimum(aims[0], [start, *(each for each in rules if each.runs and "radii" in ranges)])
    if probability is not None and len(aims) == 2:
        what = "a Pareto front cannot have a limit on the probability that a design jams or clashes"
        raise QuestionError(Problem(what, "trials of all its designs would take too long", "give one objective"))
    best, stops = (best, None) if probability is None else best_within(search, aims[0], probability)
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
    """Return the bounds of the free parameters. Raises `QuestionError` if objectives or bounds are invalid."""
    if not 1 <= len(set(aims)) == len(aims) <= 2 or not {*aims} <= {*AIMS}:
        what = f"'{', '.join(aims)}' does not name one objective or two different objectives"
        why = "one objective gives a best design, two give a Pareto front"
        raise QuestionError(Problem(what, why, f"give one or two of {', '.join(AIMS)}"))
    if "loss" in aims and not start.friction:
        what, why = "the loss cannot be minimised without friction", "without friction the loss is 0 for all teeth"
        raise QuestionError(Problem(what, why, "give a coefficient of friction above 0, or another objective"))
    return checked_ranges(free)


# ---------------------------------------------------------------------------------------- contact of the drawn outlines


@dataclass(frozen=True)
class OutlineAgreement(Result):
    """Comparison of properties of a design: computed from its transmission function, and from its drawn outlines."""

    KEYS = ("turns", "loss", "error", "impact", "backlash", "difference")

    loss: tuple[float, float]
    """Loss: its values from the transmission function, and from the outlines [1]."""
    error: tuple[float, float]
    """Peak-to-peak error: values from the transmission function, and from the outlines [rad of the driven wheel]."""
    impact: tuple[float, float]
    """Impact loss, as in `ToothSizes`: its values from the transmission function, and from the outlines [1]."""
    backlash: tuple[float, float]
    """Backlash: its values from the transmission function, and from the outlines [rad of the driven wheel]."""
    turns: bool
    """True if the drawn outlines turn without a jam and without a loss of contact."""

    @property
    def difference(self) -> float:
        """Maximum over all properties of the relative difference between the two values [1]."""
        return max(self.differences.values())

    @property
    def differences(self) -> Mapping[str, float]:
        """Relative difference between the two values of each property [1], keyed by property."""
        pairs = {"loss": self.loss, "error": self.error, "impact": self.impact, "backlash": self.backlash}
        return {name: abs(a - b) / max(abs(a), abs(b), _NOTHING) for name, (a, b) in pairs.items()}


def outline_transmission(sizes: TriangularSizes, friction: float) -> OutlineTransmission:
    """Return the transmission function of the drawn outlines of a pair. The first wheel drives."""
    first = _outline(sizes.z1, sizes.R1, sizes.beta1, sizes.flanks[0], sizes.ring == 1)
    second = _outline(sizes.z2, sizes.R2, sizes.beta2, sizes.flanks[1], sizes.ring == 2)
    # teeth are drawn about their centre lines, so neither the angle nor the backlash has an offset
    return OutlineTransmission(OutlineGears(first, second, sizes.D, 0.0, 0.0), friction)


def confirm_by_outlines(design: ToothSizes) -> OutlineAgreement:
    """Compare the properties of a design, which must turn, with those computed from its drawn outlines."""
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
    """Return the mean efficiency over the driver angle, by Gauss quadrature in cells in which it is smooth."""
    import numpy as np

    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    breaks = transmission.table.breaks
    low, high = breaks[:-1, None], breaks[1:, None]
    edges = low + (high - low) * np.linspace(0, 1, _CELLS + 1)
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, np.diff(edges) / 2
    found = transmission.efficiency((middle[..., None] + half[..., None] * nodes).ravel())
    return float(found @ (half[..., None] * weights).ravel()) / float(breaks[-1] - breaks[0])


def _outline(z: int, R: float, beta: float, length: float, ring: bool) -> GearOutline:
    """Return the outline of a wheel of z teeth whose straight flanks begin at tips at the radius `R`.

    beta     half angle of the teeth (rad)
    length   length of the flanks, which extend inwards from the tips, or outwards for a `ring`
    """
    import numpy as np

    from geartrain.teeth.contact import GearOutline, OutlineCurve, ToothFlanks

    def points(s: Floats) -> Floats:
        return np.stack([s * sin(beta), R + (s if ring else -s) * cos(beta)], axis=1)

    return GearOutline((ToothFlanks.symmetric((OutlineCurve(points, 0.0, length),)),), z, ring=ring)
