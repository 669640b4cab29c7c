"""Wear of flanks by Archard's law: V = (K/H) times the integral of force over the way slid (docs/strength.md)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geartrain.simulation.strength.formulas.contact_pressure import ContactLoad
    from geartrain.teeth.gear_mesh import GearMesh

WEAR_RANGE = (1e-7, 1e-3)
"""Wear coefficients K from greased metal to dry bronze or brass: four powers of ten, all of which one may meet."""

_SLIGHT = 1e-5  # friction so small that what is lost goes with it
_POSITIONS = 801


def loss_over_friction(mesh: GearMesh) -> float | None:
    """What a pair loses of the power through it, over friction, as friction goes to 0: docs/strength.md (14).

    The energy through the pair times this is the integral of force over the way slid. None for teeth that lock.
    """
    wheels = replace(mesh.wheels, friction=_SLIGHT, friction_law=None)
    path = mesh.path
    angle = None if path is None or not path.pitch.bevel else path.pitch.R1 + path.pitch.R2
    slight = mesh.tooth_form.mesh(wheels, lambda: angle).driven_by(mesh.who)  # type: ignore[attr-defined]
    mean = slight.efficiency(mesh.driver).mean
    return None if mean is None else (1 - float(mean)) / _SLIGHT


def deepest_passage(load: ContactLoad, gear: int) -> float:
    """Greatest force per width times way slid over one point of a flank while its tooth passes once [N]: (15).

    Over the hardness, and times K, it is a depth [N/mm times mm]. A point on which contact stands still is left out.
    """
    approach, recess = load.path.arcs
    X = np.linspace(-approach, recess, _POSITIONS)
    force, _ = load.forces(X)
    found = load.path.at(X)
    own = found.U1 if gear == 1 else found.U2
    with np.errstate(divide="ignore", invalid="ignore"):
        passed = force / load.width * np.abs(found.U1 - found.U2) / np.abs(own)
    return float(passed[np.isfinite(passed)].max(initial=0.0))
