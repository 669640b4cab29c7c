"""Mesh of a gear pair with triangular teeth: clearance window, reasons why a pair cannot turn, and results."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import cos, nan, pi, sin
from typing import TYPE_CHECKING, Protocol

import numpy as np

from geartrain.errors import Problem
from geartrain.numerics.results import Key, finite
from geartrain.teeth.gear_mesh import GearMesh
from geartrain.teeth.meshing_wheels import NamedForm, PairSize
from geartrain.teeth.outlines.wheel_requirement import FixedTooth
from geartrain.teeth.pair_results import AccountTable, PairAccount, PairFigures, SlidingEfficiency, motion_figures
from geartrain.teeth.triangular.clearance_window import ClearanceWindow
from geartrain.teeth.triangular.pair_geometry import TriangularSizes
from geartrain.teeth.triangular.real_path import DriveInterval, SpeedJump

if TYPE_CHECKING:
    from geartrain.numerics.arrays import Floats
    from geartrain.teeth.pair_results import PairVerdict
    from geartrain.teeth.triangular.triangular_transmission import TriangularTransmission

OTHER_SHAPES = (
    "use more teeth, a ratio nearer to 1, or another half_angle",
    "use `radii: pitch_true` (teeth of equal depth do not suit a ring), more teeth, or another half_angle",
)
_WORDS = (
    "Triangular teeth, each pair in its carrier's frame. Speed ratio divided by its mean, transmission error of the "
    "driven wheel, mean sliding efficiency at constant driver torque, relative jumps of normal velocity at collisions."
)
_CLEARANCE_HEADER = ("pair", "drives", "clearance factor", "window", "verdict")
_TRANSMISSION_HEADER = ("pair", "tau/mean", "error p-p (deg)", "efficiency", "jumps")
_WINDOW = (
    *(Key("jam", "jam_factor"), "jam_kind", Key("run", "run_factor"), "run_kind"),
    *(Key("reach", "reach_factor"), "works"),
)
_SIZES = (
    *("radii", "half_angles", "depths", Key("centre_distance", "D")),
    *(Key("reach", "reach1"), Key("matching", to=finite)),
)


class TriangularDetails(NamedForm, Protocol):
    """Methods of a triangular tooth form that the mesh of a pair uses."""

    def in_metres(self, module: float | None) -> bool:
        """Return True if the tooth form gives lengths in metres to wheels with the given module [m]."""


@dataclass(frozen=True)
class TriangularMesh(GearMesh):
    """Gear pair with triangular teeth in a train."""

    tooth_form: TriangularDetails
    transmission: TriangularTransmission

    @cached_property
    def verdict(self) -> PairVerdict:
        """Verdict on whether the teeth of the pair can run. The cause is derived from the clearance window."""
        found = self.transmission.verdict
        return found if found else found.explained(*explain_clearance(self.transmission, self.window))

    @cached_property
    def window(self) -> ClearanceWindow | None:
        """Clearance window of the pair; None if there are no teeth with these sizes."""
        from geartrain.teeth.triangular.clearance_window import find_window

        sizes = self.transmission.sizes
        return find_window(sizes) if sizes.has_valleys else None

    @property
    def unit_tips(self) -> Mapping[str, float]:
        """Tip radii of both wheels in the length unit of the teeth, keyed by wheel."""
        return {self.driver: self.transmission.sizes.R1, self.driven: self.transmission.sizes.R2}

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Return the scale and the centre distance of the pair.

        The scale follows from a wheel whose tip radius [module] is given in `tips`. If none is given, it follows from
        declared lengths, or, if no lengths are declared, from pitch circles that touch.
        """
        D, touching, module = self.transmission.sizes.D, self.wheels.touching, self.wheels.module
        scale = touching / D
        if module is not None and self.tooth_form.has_lengths:
            scale = 1 / module
        scale = next((tips[wheel] / R for wheel, R in self.unit_tips.items() if wheel in tips), scale)
        return PairSize(scale, D * scale, D * scale / touching)

    @property
    def own_size(self) -> PairSize:
        """Size of the pair from its own lengths in metres, or, without such lengths, from pitch circles that touch."""
        module = self.wheels.module
        if module is None or not self.tooth_form.in_metres(module):
            return self.size({})
        return self.size({wheel: tip / module for wheel, tip in self.unit_tips.items()})

    @property
    def pitch_radius(self) -> float | None:
        """Pitch radius of the first wheel [m]. It is computed from the centre distance if this is declared as a length,
        otherwise from the modules.
        """
        if not self.tooth_form.in_metres(self.wheels.module):
            return super().pitch_radius
        return self.transmission.sizes.D * self.wheels.counts[0] / self.transmission.sizes.pitch_sum

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """Return the required tooth of `wheel` [module]: straight lines from one tooth space to the apex and on to the
        next space. `scale` is the length unit of the teeth [module]; `tolerance` is not needed.
        """
        del tolerance
        sizes = self.transmission.sizes
        at = 0 if wheel == self.driver else 1
        half, tip = pi / (sizes.z1, sizes.z2)[at], sizes.radii[at] * scale
        sign = sizes.signs[at]  # a ring gear has its roots outside
        root, kind = tip - sign * sizes.depths[at] * scale, "ring" if sign < 0 else "external"
        # the first point equals the last point of the previous tooth and is merged with it
        vertices = ((root, -half), (tip, 0.0), (root, half))
        return FixedTooth(kind, tip, root, tuple((r * cos(turn), r * sin(turn), 0.0) for r, turn in vertices))

    @cached_property
    def separation(self) -> float:
        """Mean separating force divided by the tangential force, at constant torque on the driven wheel.

        The common normal makes the angle psi with the pitch line. The sum of its distances n1 and n2 from the two
        centres is D cos(psi), where D is the centre distance. For a ring gear, the difference of n1 and n2 replaces the
        sum: (31) of docs/strength.md.
        """
        transmission = self.transmission
        sizes, arms = transmission.sizes, transmission.contact.path.tooth_pair.normal_arms
        radius, (s1, s2) = sizes.D * sizes.z2 / sizes.pitch_sum, sizes.signs

        def ratio(interval: DriveInterval, x: Floats) -> Floats | float:
            if interval.held is not None:
                return nan
            n1, n2 = arms(interval.phase, x, np)
            found: Floats = radius / n2 * np.sqrt(1 - ((s1 * n1 + s2 * n2) / sizes.D) ** 2)
            return found

        S, weights = transmission.graded_nodes(transmission.speed)
        each = transmission.mapped(S, ratio)
        touching = ~np.isnan(each)
        return float((weights * each)[touching].sum() / weights[touching].sum())

    @property
    def has_cut_sizes(self) -> bool:
        """Always True, because manufacturing errors of triangular teeth are modelled."""
        return True

    @property
    def cut_sizes(self) -> TriangularSizes:
        """Nominal sizes of the pair, about which random manufacturing errors vary."""
        return self.transmission.sizes

    def account(self) -> PairAccount:
        """Return a report on the clearance, the transmission function and the impacts of the pair."""
        figures = triangular_figures(self.transmission, self.window, losses=self.efficiency(self.driver))
        window, where, row = self.window, "-", ("-",) * 4
        if window is not None:
            where = f"{window.jam_factor:.5f} {window.jam_kind} .. {window.run_factor:.5f} {window.run_kind}"
        if figures.speed_ratio is not None and figures.efficiency is not None:
            speeds = "{:.5f}..{:.5f}".format(*figures.speed_ratio.relative)
            lost = figures.efficiency.text if self.computes_losses else "-"
            row = speeds, figures.error_text, lost, ", ".join(f"{jump.value:.4f}" for jump in figures.jumps)
        factor, kind = f"{figures.sizes.clearance_factor:.6g}", self.transmission.verdict.kind
        clearance = AccountTable(_CLEARANCE_HEADER, (self.name, f"{self.driver} -> {self.driven}", factor, where, kind))
        return PairAccount(_WORDS, (clearance, AccountTable(_TRANSMISSION_HEADER, (self.name, *row))), figures)

    def own_faults(self) -> Iterator[Problem]:
        """Yield all faults of the teeth of the pair, each with its remedy."""
        yield from (fault.problem for fault in self.verdict.faults)
        if self.verdict:
            yield from self.friction_faults()


# ----------------------------------------------------------------------------------------------------------- properties


@dataclass(frozen=True)
class TriangularFigures(PairFigures):
    """Results of a pair with triangular teeth. Angles are in rad."""

    KEYS = (
        *PairFigures.KEYS,
        *(Key("clearance_factor", "sizes.clearance_factor"), Key("window", keys=_WINDOW), Key("sizes", keys=_SIZES)),
        *(Key("intervals", keys=("phase", "start", "end")), "jumps"),
    )

    sizes: TriangularSizes
    """Sizes of the pair. Lengths are in m, or in the unit of the declared radii."""
    window: ClearanceWindow | None
    """Clearance window of the pair; None if there are no teeth with these sizes."""
    intervals: tuple[DriveInterval, ...]
    """Intervals of the real path of contact over one pitch of the driver, in order of time."""
    jumps: tuple[SpeedJump, ...]
    """Impacts within one pitch."""


def triangular_figures(
    transmission: TriangularTransmission, window: ClearanceWindow | None, losses: SlidingEfficiency | None = None
) -> TriangularFigures:
    """Return the results of a pair with triangular teeth and the clearance window `window`.

    `losses` replaces the efficiency of the transmission function.
    """
    found, moves = transmission.verdict, bool(transmission.intervals)
    return TriangularFigures(
        (transmission.sizes.z1, transmission.sizes.z2),
        found if found else found.explained(*explain_clearance(transmission, window)),
        *motion_figures(transmission, moves),
        (losses or SlidingEfficiency(transmission)) if moves else None,
        sizes=transmission.sizes,
        window=window,
        intervals=transmission.intervals,
        jumps=tuple(transmission.jumps) if moves else (),
    )


# --------------------------------------------------------------------------------------------------------- explanations


def explain_clearance(transmission: TriangularTransmission, window: ClearanceWindow | None) -> tuple[str, str]:
    """Return cause and remedy for a pair that cannot turn, with the violated limit of the clearance window."""
    if window is None:
        return "", "use more teeth or a smaller half_angle"
    excess, jam, run = transmission.sizes.excess, window.jam_factor, window.run_factor
    if not window:
        return (
            f"up to a clearance factor of {jam:.6g} the verdict is {window.jam_kind}, and from "
            f"{run:.6g} on it is {window.run_kind}: the pair turns at no clearance",
            OTHER_SHAPES[bool(transmission.sizes.ring)],
        )
    factor = window.factor(excess)
    end = "below" if factor < min(jam, run) else "above"
    return (
        f"the clearance factor {factor:.6g} is {end} the window of this pair, {jam:.6g} "
        f"({window.jam_kind}) to {run:.6g} ({window.run_kind})",
        f"give a clearance factor between these limits, or `window: 0.5`, which is {window.factor(window.at(0.5)):.6g}",
    )
