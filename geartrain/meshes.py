"""Real teeth and pins of a train: a law for every gear pair with a tooth form and every coupling with dimensions."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from geartrain.errors import GearTrainError, Problem
from geartrain.teeth import Triangular
from geartrain.teeth.triangular.form import COVERS, refusal
from geartrain.train import GearPair, Train

if TYPE_CHECKING:
    from geartrain.pins import Coupling
    from geartrain.pins.laws import SlotLaw
    from geartrain.teeth.triangular.law import TriangularLaw
    from geartrain.teeth.triangular.meshing import Meshing, Window


@dataclass(frozen=True)
class Mesh:
    """A gear pair with real teeth: the wheel that drives, how (`why`) that is known, and friction if it is declared."""

    gear: GearPair
    form: Triangular
    driver: str
    why: str
    place: str
    law: TriangularLaw
    friction: float | None = None
    note: str = ""

    @property
    def name(self) -> str:
        """The name of the pair."""
        return self.gear.name

    @property
    def driven(self) -> str:
        """The other wheel."""
        first, second = self.gear.pair
        return second if self.driver == first else first

    @cached_property
    def reversed(self) -> TriangularLaw:
        """The law with the other wheel driving."""
        from geartrain.teeth.triangular.law import TriangularLaw

        return TriangularLaw(self.law.sizes.swapped(), self.law.friction, self.law.direction)

    def driven_by(self, driver: Driver) -> Mesh:
        """The same teeth with this wheel driving."""
        law = self.law if driver.wheel == self.driver else self.reversed
        return replace(self, driver=driver.wheel, why=driver.why, law=law)

    @property
    def verdict(self) -> Meshing:
        """Whether these teeth can turn."""
        return self.law.verdict

    @cached_property
    def window(self) -> Window | None:
        """Clearances at which they can; None where there are no such teeth."""
        from geartrain.teeth.triangular.meshing import find_window

        sizes = self.law.sizes
        return find_window(sizes) if sizes.has_valleys else None

    @property
    def fault(self) -> Problem | None:
        """What is wrong with these teeth, with the window in which they would turn; None if they turn."""
        name = f"pair '{self.name}': "
        if not self.verdict:
            why, fix = explain(self.law, self.window)
            return Problem(name + self.verdict.text, why, fix, self.place)
        if self.law.friction >= self.law.locking_friction:
            what, why, fix = locked_by_friction(self.law)
            return Problem(name + what, why, fix, self.place)
        return None


@dataclass(frozen=True)
class Driver:
    """The wheel that drives a gear pair, and how that is known."""

    wheel: str
    why: str


@dataclass(frozen=True)
class PinJoint:
    """A coupling whose dimensions are declared, with its law."""

    coupling: Coupling
    law: SlotLaw


def explain(law: TriangularLaw, window: Window | None) -> tuple[str, str]:
    """Why a pair does not turn, and what would let it: the window of clearance, and which end was passed."""
    if window is None:
        return "", "use more teeth or a smaller half_angle"
    excess = law.sizes.excess
    if not window:
        return (
            f"up to a clearance factor of {1 + window.jam:.6g} there is {window.jam_kind}, and from "
            f"{1 + window.run:.6g} on {window.run_kind}: no clearance works",
            "use more teeth, a ratio nearer to 1, or another half_angle",
        )
    end = "below" if excess < window.jam else "above"
    return (
        f"the clearance factor {1 + excess:.6g} is {end} the window of this pair, {1 + window.jam:.6g} "
        f"({window.jam_kind}) to {1 + window.run:.6g} ({window.run_kind})",
        f"give a clearance between the two, or `window: 0.5`, which is {1 + window.at(0.5):.6g}",
    )


def locked_by_friction(law: TriangularLaw) -> tuple[str, str, str]:
    """What, why, and what to do, where friction locks."""
    return (
        f"a friction of {law.friction:g} locks these teeth",
        "before the line of centres the driver pushes the driven apex against its own sliding: friction times the "
        f"tangent of the flank's lean reaches 1 at {law.locking_friction:.6g}",
        f"give a friction below {law.locking_friction:.4g}, or let the other wheel drive",
    )


def find_meshes(train: Train) -> tuple[Mesh, ...]:
    """Every gear pair with real teeth. Raises `GearTrainError` with all pairs whose teeth cannot be built."""
    forms = {gear.name: gear.tooth_form or train.tooth_form for gear in train.gears}
    if not any(isinstance(form, Triangular) for form in forms.values()):
        return ()
    drivers = find_drivers(train)
    meshes: list[Mesh] = []
    problems: list[Problem] = []
    for at, gear in enumerate(train.gears):
        form = forms[gear.name]
        if isinstance(form, Triangular):
            try:
                meshes.append(_mesh(train, at, gear, form, drivers[gear.name]))
            except GearTrainError as error:
                problems += [replace(problem, place=train.place("gears", at)) for problem in error.problems]
    if problems:
        raise GearTrainError(problems)
    return tuple(meshes)


def find_pins(train: Train) -> tuple[PinJoint, ...]:
    """Every coupling whose dimensions are declared."""
    return tuple(
        PinJoint(coupling, coupling.law) for coupling in train.couplings if coupling.pin_radius and coupling.law
    )


def _mesh(train: Train, at: int, gear: GearPair, form: Triangular, driver: Driver) -> Mesh:
    first, second = (train.wheels[wheel][1] for wheel in gear.pair)
    kinds = (first.kind, second.kind)
    if why := refusal(kinds, first.internal or second.internal):
        fix = f"{COVERS}; give this pair `tooth_form: {{form: ideal}}`"
        raise GearTrainError(Problem(f"pair '{gear.name}' cannot have triangular teeth", why, fix))
    rubbing = gear.friction or train.friction
    friction = None if rubbing is None else float(rubbing.value)
    law = form.law(
        first.count or 0,
        second.count or 0,
        friction or 0.0,
        1 if driver.wheel == gear.pair[0] else 2,
        pitch_distance=_pitch_distance(train, gear),
    )
    note = "the contrate is taken for a spur wheel" if "contrate" in kinds else ""
    return Mesh(gear, form, driver.wheel, driver.why, train.place("gears", at), law, friction, note)


def find_drivers(train: Train) -> dict[str, Driver]:
    """Who drives each gear pair: declared, or the wheel nearer to where power enters."""
    near = _distances(train)
    far = len(near) + 1
    found = {}
    for gear in train.gears:
        if gear.driver is not None:
            found[gear.name] = Driver(gear.driver, "declared")
            continue
        first, second = (near.get(train.wheels[wheel][0], far) for wheel in gear.pair)
        found[gear.name] = Driver(gear.pair[1 if second < first else 0], "nearer to where power enters")
    return found


def _distances(train: Train) -> dict[str, int]:
    """How many pairs lie between each link and the nearest input, from link to link along pairs and couplings."""
    wheels = train.wheels
    ties = [(wheels[a][0], wheels[b][0]) for a, b in (gear.pair for gear in train.gears)]
    ties += [(coupling.pin, coupling.slot) for coupling in train.couplings]
    neighbours: dict[str, list[str]] = {}
    for a, b in ties:
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    entries = [train.crank] if train.crank is not None else [link for case in train.cases for link in case.inputs]
    found = dict.fromkeys(entries, 0)
    queue = deque(found)
    while queue:
        link = queue.popleft()
        for other in neighbours.get(link, ()):
            if other not in found:
                found[other] = found[link] + 1
                queue.append(other)
    return found


def _pitch_distance(train: Train, gear: GearPair) -> float | None:
    """Half the modules times the teeth, summed (m); None unless both wheels declare a module with a unit."""
    halves = list(_halves(train, gear))
    return sum(halves) if len(halves) == 2 else None


def _halves(train: Train, gear: GearPair) -> Iterator[float]:
    for name in gear.pair:
        wheel = train.wheels[name][1]
        if wheel.module is not None and wheel.module.unit is not None and wheel.count is not None:
            yield wheel.module.si * wheel.count / 2
