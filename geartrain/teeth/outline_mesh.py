"""A gear pair whose form gives the outline of both wheels and nothing else: its motion follows from their contact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from math import degrees, pi
from typing import TYPE_CHECKING

from geartrain.errors import Problem
from geartrain.teeth.gear_mesh import GearMesh, PairSize, friction_lock

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateVerdict
    from geartrain.teeth.outline_transmission import OutlineTransmission
    from geartrain.teeth.outlines.wheel_requirement import FixedTooth
    from geartrain.teeth.pair_account import PairAccount

_WORDS = (
    "Teeth whose motion is found by the contact of their outlines, each pair in its carrier's frame. Speed ratio over "
    "its mean; error peak to peak and least play in degrees of the driven wheel; mean efficiency at constant driver "
    "torque, exact in friction, one pair of teeth carrying the load, as the pair is driven and driven back."
)
_HEADER = (
    *("pair", "drives", "teeth", "speed/mean", "error p-p (deg)", "play (deg)"),
    *("efficiency", "driven back", "verdict"),
)


@dataclass(frozen=True)
class OutlineMesh(GearMesh):
    """A spur pair with any teeth; `teeth` of the first and the second wheel as they are cut, in modules."""

    law: OutlineTransmission
    teeth: tuple[FixedTooth, FixedTooth]

    @cached_property
    def reversed(self) -> OutlineTransmission:
        """The law with the other wheel driving."""
        return self.law.reversed

    @property
    def verdict(self) -> ConjugateVerdict:
        """Whether these teeth can turn."""
        return self.law.verdict

    @property
    def stands(self) -> float:
        """Half a tooth of both wheels: the driven angle is counted from where flanks touch."""
        return self.law.gears.lead / pi

    def size(self, tips: Mapping[str, float]) -> PairSize:
        """Lengths of the law are modules already."""
        del tips
        distance = self.law.gears.distance
        return PairSize(1.0, distance, distance / self.wheels.touching)

    def requirement(self, wheel: str, scale: float, tolerance: float) -> FixedTooth:
        """The tooth as the form has it, arcs and all."""
        del scale, tolerance
        return self.teeth[self.gear.pair.index(wheel)]

    def account(self) -> PairAccount:
        """Speed, error, play and efficiency, as the pair is driven and driven back."""
        from geartrain.teeth.pair_account import (
            AccountTable,
            PairAccount,
            efficiency_data,
            efficiency_text,
            error_text,
            motion_data,
        )

        law, verdict = self.law, self.verdict
        runs, known = bool(verdict), self.friction is not None and bool(verdict)
        least, most = (speed / float(law.ratio) for speed in law.speed_range())
        row = (
            self.name,
            f"{self.driver} -> {self.driven}",
            self.tooth_form.words,
            f"{least:.5f}..{most:.5f}" if runs else "-",
            error_text(law, runs),
            f"{degrees(verdict.play):.4g}",
            *(efficiency_text(way) if known else "-" for way in (law, self.reversed)),
            verdict.kind,
        )
        fault = verdict.faults[0] if verdict.faults else None
        data = {
            "teeth": list(self.wheels.counts if self.driver == self.gear.pair[0] else self.wheels.counts[::-1]),
            "verdict": {**verdict.to_dict(), "why": fault.why if fault else "", "fix": fault.fix if fault else ""},
            "gears": list(self.gear.pair),
            "note": self.note,
            "play": verdict.play,
            **motion_data(law, runs),
            "efficiency": efficiency_data(law) if runs else None,
        }
        return PairAccount(_WORDS, (AccountTable(_HEADER, row, wide=True),), data)

    def _faults(self) -> Iterator[Problem]:
        yield from (Problem(fault.what, fault.why, fault.fix) for fault in self.verdict.faults)
        if self.law.friction >= self.law.locking_friction:
            yield friction_lock(self.law.friction, self.law.locking_friction)
