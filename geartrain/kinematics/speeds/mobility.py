"""Degrees of freedom of a train, by count and by exact rank, and the loops that make them differ."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass

from geartrain.kinematics.answer import Loop
from geartrain.kinematics.components import ReducedSystem
from geartrain.kinematics.speeds.exact_speeds import EXACT_BUDGET, eliminate_within, elimination_budget, resolve_form
from geartrain.numerics.containers import collector_paused
from geartrain.numerics.elimination import PRIME, LinearForm, TooDenseError, rank_modulo
from geartrain.numerics.results import Key, Result


@dataclass(frozen=True, slots=True)
class Mobility(Result):
    """Degrees of freedom by count and by exact rank, and what makes them differ; docs/theory.md, (16), (17), (20).

    Examples
    --------
    Four wheels in a ring, one of whose meshes is redundant:

    >>> import geartrain
    >>> found = geartrain.load("four-gear-loop").mobility
    >>> found.by_count, found.by_rank, found.redundant
    (0, 1, 1)
    """

    PAGE = "report.train_report:mobility_document"

    KEYS = (
        "by_count",
        "by_rank",
        "rank",
        "redundant",
        Key("redundant_loops", "loops"),
        Key("locked_loops", "locked"),
        "still",
        Key("never_rolling", "idle"),
    )

    links: int
    """Links, the frame among them."""
    turning_pairs: int
    """Turning pairs j_R."""
    gear_pairs: int
    """Gear pairs."""
    couplings: int
    """Pins in slots; with the gear pairs they are j_G."""
    by_rank: int
    """Links less one less the rank of all circuits: always right."""
    redundant: int
    """How many circuits add nothing."""
    loops: tuple[Loop, ...]
    """Loops of product 1 that circuits close which add nothing; the first 1000."""
    shared: tuple[str, ...]
    """Links at which components meet in equations that add nothing."""
    locked: tuple[Loop, ...]
    """Loops that do not close, and hold their component on its carrier; the first 1000."""
    still: tuple[str, ...]
    """Links that stand still whatever drives the train."""
    idle: tuple[str, ...]
    """Ids of circuits whose wheels never roll on each other."""
    certain: bool = True
    """False where the rank was taken modulo two primes (exact but for accidents of 1e-36)."""

    def _summary(self) -> str:
        locked = f", {len(self.locked)} loops that do not close" if self.locked else ""
        redundant = f", {self.redundant} redundant circuits" if self.redundant else ""
        return f"{self.by_rank} by rank, {self.by_count} by count{redundant}{locked}"

    @property
    def by_count(self) -> int:
        """j_R - j_G, couplings counted with the gear pairs; right only without redundancy."""
        return self.turning_pairs - self.gear_pairs - self.couplings

    @property
    def rank(self) -> int:
        """Rank of the circuits' rows."""
        return self.links - 1 - self.by_rank


def _idle(reduced: ReducedSystem, forms: Mapping[int, LinearForm]) -> list[str]:
    """Circuits of components whose unknown is always 0."""
    parts = reduced.components
    null = {column for column, form in forms.items() if not form and column < len(parts.group_carrier)}
    if not null:
        return []
    return [c.id for c in parts.circuits if c.b and parts.group_of(c) in null]


def _still(reduced: ReducedSystem, forms: Mapping[int, LinearForm]) -> list[str]:
    """Links that stand still in every motion: their form vanishes."""
    parts = reduced.components
    if not forms:
        return []
    null = {column for column, form in forms.items() if not form}
    found = []
    for at, name in enumerate(parts.links):
        moving = [column for column in reduced.unknowns_of(at) if column not in null]
        if at != parts.frame and (not moving or (len(moving) > 1 and not resolve_form(reduced.form(at), forms))):
            found.append(name)
    return found


@collector_paused()
def find_mobility(reduced: ReducedSystem, turning_pairs: int, budget: int | None = EXACT_BUDGET) -> Mobility:
    """Mobility of the train itself by exact rank, nothing prescribed: (16), (17) of docs/theory.md."""
    parts = reduced.components
    gears = sum(circuit.kind == "gear" for circuit in parts.circuits)
    shared: list[str] = []
    still: list[str] = []
    idle: list[str] = []
    certain = True
    try:
        budget = elimination_budget(reduced, budget)
        echelon = eliminate_within(reduced.equations, budget)
    except TooDenseError:
        certain = False
        # a prime can only lower a rank; that two do so at once is an accident of 1e-36
        rank = max(rank_modulo(reduced.equations, PRIME), rank_modulo(reduced.equations, (1 << 61) - 31))
    else:
        rank = echelon.rank
        with suppress(TooDenseError):
            forms = echelon.forms(budget)
            still, idle = _still(reduced, forms), _idle(reduced, forms)
        repeated = (reduced.origin[row] for row in echelon.redundant)
        shared = [parts.links[link] for kind, link, _ in repeated if kind == "share"]
    freedom = reduced.unknowns - rank
    redundant = len(parts.circuits) - (len(parts.links) - 1 - freedom)
    return Mobility(
        len(parts.links),
        turning_pairs,
        gears,
        len(parts.circuits) - gears,
        freedom,
        redundant,
        tuple(parts.loop(circuit) for circuit in parts.closing[:1000]),
        tuple(shared),
        tuple(parts.loop(circuit) for circuit in parts.breaking[:1000]),
        tuple(still),
        tuple(idle),
        certain,
    )
