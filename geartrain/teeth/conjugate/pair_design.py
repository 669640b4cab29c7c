"""The design of a pair with conjugate teeth in figures: sizes, path of contact, what it costs, wheels cut from it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.numerics.results import Key, Result, finite
from geartrain.teeth.conjugate.admissibility import tip_thickness
from geartrain.teeth.conjugate.path_costs import SHARED, PathMeasures, measure, sliding
from geartrain.teeth.transmission_figures import SlidingEfficiency

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_mesh import ConjugateMesh
    from geartrain.teeth.conjugate.path_of_contact import PathOfContact
    from geartrain.teeth.outlines.cut_wheel import WheelOutline


@dataclass(frozen=True)
class DesignCosts(Result):
    """What a path of contact costs.

    measures           loss, stress, heat, flash, depth
    sliding            greatest sliding over the pitch-line speed
    specific_sliding   greatest sliding over the slower of the contact's speeds along the flanks; infinite where it
                       stands still
    """

    KEYS = (Key("", "measures"), "sliding", Key("specific_sliding", to=finite))

    measures: PathMeasures
    sliding: float
    specific_sliding: float


@dataclass(frozen=True)
class SharedEfficiency(Result):
    """Efficiency of sliding where pairs of teeth in contact share the load.

    assumption   the same in words
    sliding      exact in friction
    """

    KEYS = ("assumption", Key("", "sliding"))

    sliding: SlidingEfficiency
    assumption: str = SHARED


@dataclass(frozen=True)
class PairDesign(Result):
    """A pair with conjugate teeth as designed; gear 1 first, lengths in modules (bevel: rad), angles in rad.

    mesh       the pair, as it is driven
    outlines   wheels that were cut
    """

    KEYS = (
        *(Key("form", "mesh.form"), "teeth", Key("verdict", "mesh.verdict"), "pitch_radii", "flanks", "thickness"),
        *("arcs", Key("contact_ratio", "path.contact_ratio"), "pressure_angles", "costs", "efficiency", "outlines"),
    )

    mesh: ConjugateMesh
    outlines: tuple[WheelOutline, ...] = ()

    @property
    def path(self) -> PathOfContact:
        """The path of contact."""
        return self.mesh.path

    @property
    def runs(self) -> bool:
        """True if the teeth can run, be it that friction locks them."""
        return bool(self.mesh.verdict)

    @property
    def teeth(self) -> tuple[int, int]:
        """Teeth of gear 1 and of gear 2."""
        return int(self.path.pitch.z1), int(self.path.pitch.z2)

    @property
    def pitch_radii(self) -> tuple[float, float]:
        """Of both gears; negative for a ring."""
        return self.path.pitch.R1, self.path.pitch.R2

    @cached_property
    def flanks(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Radii between which the flanks of each gear work, root end first."""
        return self.path.radii(1), self.path.radii(2)

    @property
    def thickness(self) -> tuple[float, float]:
        """Of a tooth, or pin, on the pitch circle (pitches)."""
        first, second = self.mesh.law.pair.halves
        return 2 * first / self.path.pitch.p, 2 * second / self.path.pitch.p

    @cached_property
    def top_lands(self) -> tuple[float | None, float | None]:
        """Angle of the land at the tip of a tooth (rad); None for round pins."""
        pair = self.mesh.law.pair
        first, second = (
            tip_thickness(self.path, gear, pair.halves) if solid else None for gear, solid in enumerate(pair.solid, 1)
        )
        return first, second

    @property
    def arcs(self) -> tuple[float, float]:
        """Arcs of approach and recess, gear 1 driving (pitches); one may be negative."""
        approach, recess = self.path.arcs
        return approach / self.path.pitch.p, recess / self.path.pitch.p

    @property
    def pressure_angles(self) -> tuple[float, float, float]:
        """At the first contact, the pitch point and the last contact."""
        approach, recess = self.path.arcs
        first, middle, last = (float(self.path.at(X).psi) for X in (-approach, 0.0, recess))
        return first, middle, last

    @cached_property
    def costs(self) -> DesignCosts | None:
        """What the path costs; None for teeth that cannot run."""
        return DesignCosts(measure(self.path), *sliding(self.path)) if self.runs else None

    @property
    def efficiency(self) -> SharedEfficiency | None:
        """Exact in friction; None for teeth that cannot run."""
        return SharedEfficiency(self.mesh.efficiency(self.mesh.driver)) if self.runs else None

    @property
    def locks(self) -> bool:
        """True if friction locks the teeth."""
        return self.mesh.losses.locks
