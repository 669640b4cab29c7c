"""Equilibrium by virtual work: equations (14) to (16) of docs/torques.md.

Loads balance if they do no work in any motion that the known constraints leave. Speeds do not enter: a link may turn as
it likes and its torque be determined all the same.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from geartrain.kinematics.willis_system import WillisEquation, WillisSystem
from geartrain.numerics.elimination import LinearForm, eliminate

PRESCRIBED = -1
"""The column of a form in which prescribed numbers stand."""


@dataclass(frozen=True)
class VirtualMotion:
    """One way in which the train may be displaced, speeds by link, and the power of the loads in it."""

    speeds: Mapping[str, Fraction]
    power: Fraction


def speed_forms(system: WillisSystem) -> dict[str, LinearForm]:
    """The speed of every link in terms of those that are free; what is prescribed stands in the column `PRESCRIBED`."""
    return _forms(system.links, system.equations)


def unbalanced_motions(
    system: WillisSystem, loads: Mapping[str, Fraction], still: Collection[str]
) -> list[VirtualMotion]:
    """Independent motions in one of which at least the loads do work, equation (15); none if they balance.

    still   the links whose torque is unknown: they stand still in all these motions, and it does no work
    """
    held = [WillisEquation(f"still {link}", "fixed", ((link, 1),)) for link in still]
    forms = _forms(system.links, [*(row for row in system.equations if row.kind != "input"), *held])
    found = []
    for column in sorted({column for form in forms.values() for column in form}):
        speeds = {link: form[column] for link, form in forms.items() if form.get(column)}
        power = sum((loads.get(link, Fraction(0)) * speed for link, speed in speeds.items()), Fraction(0))
        found.append(VirtualMotion(speeds, power))
    return found if any(motion.power for motion in found) else []


def balancing_torque(motions: Sequence[VirtualMotion], link: str) -> Fraction | None:
    """The torque on one link that takes up what the loads do in every motion, equation (16); None where none does."""
    found: Fraction | None = None
    for motion in motions:
        speed = motion.speeds.get(link, Fraction(0))
        if not speed:
            if motion.power:
                return None
            continue
        torque = -motion.power / speed
        if found is not None and torque != found:
            return None
        found = torque
    return found


def _forms(links: Iterable[str], rows: Iterable[WillisEquation]) -> dict[str, LinearForm]:
    at = {link: number for number, link in enumerate(links)}
    held: list[LinearForm] = []
    for row in rows:
        form: LinearForm = {at[link]: Fraction(coefficient) for link, coefficient in row.terms}
        if row.right:
            form[PRESCRIBED] = -row.right
        held.append(form)
    found = eliminate(held).forms()
    return {link: found.get(number, {number: Fraction(1)}) for link, number in at.items()}
