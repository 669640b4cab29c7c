"""Train with compliant teeth: the contacts of `TrainModel` with stiffness and damping, and the vibration modes.

Small vibrations satisfy M x'' + C x' + K x = 0, equation (19) of docs/dynamics.md. A stiffness k along the line of
action is k r^2 about the driven wheel's axis, with its lever arm r: the base radius of involute teeth, the pitch radius
of others. Damping is declared, or follows from restitution: equations (16) and (17).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, exp, log, sqrt
from typing import TYPE_CHECKING

import numpy as np

from geartrain.errors import Problem, QuestionError
from geartrain.simulation.contacts.contact_model import ToothCompliance
from geartrain.simulation.contacts.train_model import TrainModel
from geartrain.teeth.involute import Involute

if TYPE_CHECKING:
    from geartrain.kinematics.circuits import Circuit
    from geartrain.numerics.arrays import Floats
    from geartrain.numerics.quantity import Quantity
    from geartrain.teeth.coupling import Coupling
    from geartrain.train import GearPair


DAMPING_RATIO = 0.05
"""Damping ratio [1] of a pair without declared damping and restitution, typical of tests on spur gears."""

# minimum restitution: at large damping it falls with the square of the damping ratio and never reaches 0
_MINIMUM = 0.05
_SINGLE = 14e9
"""Stiffness of a single pair of steel teeth per unit of face width [N/m2], from ISO 6336-1, method B, simplified."""

_STEEL, _BRONZE = 206e9, 110e9  # Young's moduli [N/m2]
_DENSITIES = ((7600.0, 8000.0, _STEEL), (8200.0, 9000.0, _BRONZE))  # ranges of density [kg/m3]; brass counts as bronze


@dataclass(frozen=True)
class CompliantTrain(TrainModel):
    """Contact model of a train with compliant teeth in one state. `restitution` replaces the declared coefficients."""

    restitution: float | None = None

    def _is_contact(self, circuit: Circuit) -> bool:
        # a pair without stiffness keeps its ratio unless the rigid model makes it a contact
        return circuit.id in self.compliances or super()._is_contact(circuit)

    @property
    def assumed(self) -> tuple[str, ...]:
        """Notes on the estimates that are used for undeclared stiffness and damping."""
        found = {pair.name: self.compliances[pair.name] for pair in self.model.pairs}
        notes = [each.note for each in found.values() if each.note]
        if assumed := [name for name, each in found.items() if each.assumes_ratio]:
            notes.append(
                f"damping of {', '.join(assumed)} taken as {DAMPING_RATIO:g} of the critical damping, because none is "
                "declared"
            )
        return tuple(notes)

    @cached_property
    def yields(self) -> ToothCompliance:
        """Stiffness [N m/rad] and damping [N m s/rad] of each pair in the contact model, as arrays.

        Raises `QuestionError` if a stiffness is unknown, or if the train has an escapement.
        """
        if self.case.escapements:
            what = f"'{self.train.name}' has an escapement, which compliant teeth do not support"
            why = "the stops of an escapement are rigid"
            raise QuestionError(Problem(what, why, "use rigid teeth (`--model rigid`)"))
        if lacking := [pair.name for pair in self.model.pairs if pair.name not in self.compliances]:
            what = f"the stiffness of {', '.join(lacking)} is not known"
            why = (
                "it is estimated only for involute wheels of steel, brass or bronze with known module, thickness and "
                "density"
            )
            fix = "declare the stiffness of pairs or the train, such as `stiffness: 20 N m/rad` (pins: only N m/rad)"
            raise QuestionError(Problem(what, why, fix))
        own = [self.compliances[pair.name] for pair in self.model.pairs]
        # damping that is not declared follows from the damping ratio: c = 2 zeta sqrt(k m)
        damping = [
            2 * each.ratio * sqrt(each.stiffness * inertia) if each.damping is None else each.damping
            for each, inertia in zip(own, self._inertias, strict=True)
        ]
        return ToothCompliance(np.array([each.stiffness for each in own]), np.array(damping))

    @cached_property
    def free(self) -> list[int]:
        """Indices of the coordinates whose speed is not prescribed."""
        return [at for at in range(len(self.coordinates)) if at not in self.model.given]

    @cached_property
    def _rows(self) -> list[Floats]:
        """Coefficients by which the coordinate speeds give the separation speed of the flanks of each pair at its mean
        speed ratio, shape (coordinates,).
        """
        return [pair.opening_row(len(self.coordinates), pair.front.slope) for pair in self.model.pairs]

    @cached_property
    def _inertias(self) -> list[float]:
        """Effective inertia of each pair at its driven side [kg m2]: 1/(r M^-1 r^T) with the coefficients r in `_rows`
        and the mass matrix M; 0 if all speeds to which r applies are prescribed.
        """
        rows, mass = (row[self.free] for row in self._rows), self.mass[np.ix_(self.free, self.free)]
        return [1 / float(row @ np.linalg.solve(mass, row)) if row.any() else 0.0 for row in rows]

    @cached_property
    def matrices(self) -> tuple[Floats, Floats, Floats]:
        """Mass matrix [kg m2], damping matrix [N m s/rad] and stiffness matrix [N m/rad] of the free coordinates."""
        stiffness, damping = np.zeros_like(self.mass), np.array(self.model.viscous)
        for row, k, c in zip(self._rows, *self.yields, strict=True):
            stiffness += k * np.outer(row, row)
            damping += c * np.outer(row, row)
        for spring in self.model.springs:
            row = np.zeros(len(self.coordinates))
            for at, value in spring.angle.items():
                row[at] = value
            stiffness += spring.stiffness * np.outer(row, row)
        free = np.ix_(self.free, self.free)
        return self.mass[free], damping[free], stiffness[free]

    @cached_property
    def vibration(self) -> tuple[Floats, Floats]:
        """Squared angular frequencies of the modes in ascending order [rad2/s2], and mode shapes phi of the free
        coordinates, normalised by the mass matrix M: phi^T M phi = 1.
        """
        from scipy.linalg import eigh

        if not self.free:
            what = f"'{self.train.name}' cannot vibrate"
            why = "all its links have constant speed ratios to the drive"
            fix = "declare the stiffness of a pair or of the train, such as `stiffness: 20 N m/rad`"
            raise QuestionError(Problem(what, why, fix))
        mass, _, stiffness = self.matrices
        # the mass matrix is positive definite, as checked by `mass`
        squares, modes = eigh(stiffness, mass)
        # rigid-body rotation has frequency 0 except for rounding
        bound = 1e-12 * max(float(squares[-1]), 0.0)
        return np.where(squares > bound, squares, 0.0), modes

    @property
    def fastest(self) -> float:
        """Maximum angular frequency that time steps must resolve [rad/s].

        It is the larger of the frequency of the fastest mode and half the decay rate of the most damped pair.
        """
        # a strongly damped pair decays at the rate c/m
        rates = [float(c) / m / 2 for c, m in zip(self.yields.damping, self._inertias, strict=True) if m]
        return max([float(np.sqrt(self.vibration[0][-1])), *rates])

    # ----------------------------------------------------------------------------------- stiffness and damping of pairs

    @cached_property
    def compliances(self) -> Mapping[str, PairCompliance]:
        """Stiffness and damping of each pair whose stiffness is declared or can be estimated, by name."""
        found = {}
        for gear in self.train.gears:
            stiffness, damping = self.train.stiffness_of(gear), self.train.damping_of(gear)
            if stiffness is not None:
                estimate: tuple[float, str] | None = self._about_driven(gear, stiffness, "stiffness"), ""
            else:
                estimate = self._estimate(gear)
            if estimate is not None:
                own = None if damping is None else self._about_driven(gear, damping, "damping")
                found[gear.name] = self._compliance(gear, *estimate, own)
        stiffness, damping = self.train.stiffness, self.train.damping
        if stiffness is not None and stiffness.dimension == "torsional stiffness":
            turning = damping is not None and damping.dimension == "torsional damping"
            own = damping.si if damping is not None and turning else None
            for coupling in self.train.couplings:
                found[coupling.name] = self._compliance(coupling, stiffness.si, "", own)
        return found

    def _compliance(
        self, part: GearPair | Coupling, stiffness: float, note: str, damping: float | None
    ) -> PairCompliance:
        restitution = self.train.restitution_of(part) if self.restitution is None else self.restitution
        ratio = DAMPING_RATIO if restitution is None else damping_ratio(restitution)
        return PairCompliance(stiffness, damping, ratio, damping is None and restitution is None, note)

    def _about_driven(self, gear: GearPair, quantity: Quantity, key: str) -> float:
        """Return a declared stiffness [N m/rad] or damping [N m s/rad] about the axis of the driven wheel."""
        if quantity.dimension in ("torsional stiffness", "torsional damping"):
            return quantity.si
        arm = self._arm(gear)
        if arm is None:
            what = (
                f"the {key} of '{gear.name}', {quantity}, acts along the line of action, whose lever arm is not known"
            )
            fix = f"declare `module` of the wheels, or `{key}` in N m{'' if key == 'stiffness' else ' s'}/rad"
            raise QuestionError(Problem(what, "the lever arm follows from the module", fix))
        return quantity.si * arm**2

    def _arm(self, gear: GearPair) -> float | None:
        """Return the lever arm of the line of action about the driven wheel's axis [m]; None if it is unknown."""
        first, second = gear.pair
        driver = self.problem.drivers.get(gear.name)
        wheel = first if driver is not None and driver.wheel == second else second
        mesh = self._meshes.get(gear.name)
        own = self.train.wheels[wheel][1]
        module = (None if mesh is None else mesh.wheels.module) or own.transverse_module
        if module is None or own.count is None:
            return None
        radius = module * own.count / 2
        if mesh is not None and isinstance(mesh.tooth_form, Involute):
            return radius * cos(mesh.tooth_form.pressure_angle.si)
        return radius

    def _estimate(self, gear: GearPair) -> tuple[float, str] | None:
        """Return the stiffness of a pair of involute teeth [N m/rad], estimated from width and metal, and a note on the
        estimate; None if it cannot be estimated.
        """
        mesh, arm = self._meshes.get(gear.name), self._arm(gear)
        if mesh is None or arm is None or not isinstance(mesh.tooth_form, Involute):
            return None
        wheels = [self.train.wheels[name][1] for name in gear.pair]
        widths = [each.thickness or self.train.thickness for each in wheels]
        densities = [each.density or self.train.density for each in wheels]
        moduli = [
            None if rho is None else next((E for low, high, E in _DENSITIES if low <= rho.si <= high), None)
            for rho in densities
        ]
        if None in widths or None in moduli:
            return None
        # the narrower wheel limits the width of contact
        width = min(each.si for each in widths if each is not None)
        one, other = (each for each in moduli if each is not None)
        # harmonic mean: the compliances of both teeth add
        elastic = 2 * one * other / (one + other)
        note = (
            f"stiffness of {gear.name} estimated: 14 N/(mm um) of face width, ISO 6336-1 for steel, times "
            f"{elastic / _STEEL:.2g} by Young's modulus"
        )
        return _SINGLE * elastic / _STEEL * width * arm**2, note


@dataclass(frozen=True)
class PairCompliance:
    """Torsional stiffness [N m/rad] and damping of a pair about its driven wheel's axis, with its driver fixed."""

    stiffness: float
    damping: float | None
    """Damping coefficient [N m s/rad]; None if it is computed from the damping ratio `ratio`."""
    ratio: float
    assumes_ratio: bool
    """True if neither damping nor restitution is declared, so that `ratio` has its default value."""
    note: str
    """Note on the estimate of the stiffness; empty if the stiffness is declared."""


def restitution_at(ratio: float) -> float:
    """Return the coefficient of restitution of an impact against a spring and a damper that cannot exert a tensile
    force.

    The damping ratio is 0 or more. The bodies separate where the contact force -k g - c dg/dt vanishes (stiffness k,
    damping c, gap g), before the spring is fully extended (Schwager and Poeschel 2007). At a damping ratio of 1 the
    coefficient is 1/e^2.

    >>> restitution_at(0.0), round(restitution_at(1.0), 6)
    (1.0, 0.135335)
    """
    # both formulas below are singular at 1
    if abs(ratio - 1) < 1e-9:
        return exp(-2)
    if ratio < 1:
        swing = sqrt(1 - ratio**2)
        return exp(-ratio / swing * atan2(2 * ratio * swing, 2 * ratio**2 - 1))
    creep = sqrt(ratio**2 - 1)
    return exp(-2 * ratio / creep * log(ratio + creep))


def damping_ratio(restitution: float) -> float:
    """Return the damping ratio that gives a coefficient of restitution. Coefficients below 0.05 are replaced by 0.05.

    >>> round(damping_ratio(0.3), 4), damping_ratio(1.0)
    (0.4972, 0.0)
    """
    from scipy.optimize import brentq

    wanted = max(restitution, _MINIMUM)
    # the root is bracketed: at a ratio of 10 the coefficient is 0.002, below the minimum
    return float(brentq(lambda ratio: restitution_at(ratio) - wanted, 0.0, 10.0, xtol=1e-14)) if wanted < 1 else 0.0
