"""Conjugate teeth of a gear pair, spur, ring or bevel: which wheel is the form's first, and why they do not turn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.teeth.gear_mesh import GearMesh

if TYPE_CHECKING:
    from geartrain.teeth.conjugate.conjugate_form import ConjugateToothForm
    from geartrain.teeth.conjugate.conjugate_transmission import ConjugateTransmission, ConjugateVerdict
    from geartrain.teeth.conjugate.off_design import OffDesignTransmission

IDEAL = "give this pair `tooth_form: {form: ideal}`"


@dataclass(frozen=True)
class ConjugateMesh(GearMesh):
    """A gear pair with conjugate teeth; a ring is gear 2 of its law in whichever order the pair is named.

    At another distance than they are made for, all but involutes have a law that is not rigid.
    """

    law: ConjugateTransmission | OffDesignTransmission
    ring_first: bool = False

    @cached_property
    def reversed(self) -> ConjugateTransmission | OffDesignTransmission:
        """The law with the other wheel driving."""
        return self.law.reversed

    @property
    def verdict(self) -> ConjugateVerdict:
        """Whether these teeth can turn."""
        return self.law.verdict

    @property
    def stands(self) -> float:
        """Half a tooth of both wheels: the driven angle is counted from where flanks touch."""
        pair = self.law.pair
        return float(sum(pair.halves) / pair.path.pitch.p)

    @property
    def wheels(self) -> tuple[str, str]:
        """The wheels that are gear 1 and gear 2 of the law."""
        first, second = self.gear.pair
        return (second, first) if self.ring_first else (first, second)

    @property
    def label(self) -> str:
        """The pair, with which wheel is which gear."""
        first, second = self.wheels
        return f"pair '{self.name}' (gear 1 is '{first}', gear 2 '{second}')"

    def _faults(self) -> Iterator[Problem]:
        yield from (Problem(fault.what, fault.why, fault.fix) for fault in self.verdict.faults)
        if self.law.friction >= self.law.locking_friction:
            yield Problem(
                f"a friction of {self.law.friction:g} locks these teeth",
                f"from {self.law.locking_friction:.6g} on the driver pushes somewhere against more sliding than it "
                "can overcome",
                f"give a friction below {self.law.locking_friction:.4g}, or let the other wheel drive",
            )


def refusal(kinds: tuple[str, str]) -> str:
    """Why a pair cannot have conjugate teeth; empty if it can."""
    if "worm" in kinds:
        return "a worm's thread slides along the wheel, and rolls on no pitch surface"
    if set(kinds) >= {"bevel", "contrate"}:
        return "a bevel and a contrate wheel have no pair of pitch cones"
    return ""


def wheel_specific_parameters(form: ConjugateToothForm) -> list[str]:
    """Parameters that tell the two wheels apart."""
    given = {name: getattr(form, name) for name in type(form).model_fields}
    uneven = [name for name, value in given.items() if isinstance(value, tuple) and value[0].value != value[1].value]
    return uneven + [name for name in ("pins",) if name in form.model_fields_set]


def check_order(form: ConjugateToothForm, pair: tuple[str, str]) -> None:
    """Raises `GearTrainError` for a form whose wheels differ on a pair that names its ring first."""
    if uneven := wheel_specific_parameters(form):
        ring, pinion = pair
        raise GearTrainError(
            Problem(
                f"it is not plain whose {' and '.join(uneven)} is whose",
                f"the pair names its ring '{ring}' first, and these teeth count the ring as the second wheel",
                f"name the pinion first: `pair: [{pinion}, {ring}]`",
            )
        )
