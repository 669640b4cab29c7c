"""Mobility of a train by counting and by exact rank, and the loops that cause the difference."""

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
    """Mobility of a train by counting and by exact rank, and the reasons for a difference: equations (16), (17) and
    (20) of docs/theory.md.

    Examples
    --------
    In a closed loop of four wheels, one mesh is redundant:

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
    """Number of links, including the frame."""
    turning_pairs: int
    """Number of turning pairs, j_R."""
    gear_pairs: int
    """Number of gear pairs."""
    couplings: int
    """Number of equations of couplings, such as pins in slots; j_G is the sum of `gear_pairs` and `couplings`."""
    by_rank: int
    """Mobility by rank, which is links - 1 - (rank of the equations of all circuits). It is correct for every train."""
    redundant: int
    """Number of redundant circuits, whose equations follow from the equations of other circuits."""
    loops: tuple[Loop, ...]
    """Closed loops of wheels whose product of gear ratios is 1. Each loop has one redundant pair. At most 1000 are
    listed.
    """
    shared: tuple[str, ...]
    """Links that occur in two components and for which the condition of equal speeds in both is redundant."""
    locked: tuple[Loop, ...]
    """Closed loops of wheels whose product of gear ratios is not 1. Each loop locks the wheels connected to it to their
    common carrier. At most 1000 are listed.
    """
    still: tuple[str, ...]
    """Links that cannot move, regardless of which link drives; empty if the system is too dense to determine them."""
    idle: tuple[str, ...]
    """Names of pairs whose wheels never roll on each other; empty if the system is too dense to determine them."""
    certain: bool = True
    """False if the rank was computed modulo two primes (wrong with a probability of 1e-36)."""
    sliding_pairs: int = 0
    """Number of sliding pairs."""

    def _summary(self) -> str:
        locked = f", {len(self.locked)} loops that do not close" if self.locked else ""
        redundant = f", {self.redundant} redundant circuits" if self.redundant else ""
        return f"{self.by_rank} by rank, {self.by_count} by count{redundant}{locked}"

    @property
    def by_count(self) -> int:
        """Mobility by counting: the number of turning and sliding pairs minus the number of gear pairs and couplings.
        It is correct only if no pair is redundant.
        """
        return self.turning_pairs + self.sliding_pairs - self.gear_pairs - self.couplings

    @property
    def rank(self) -> int:
        """Rank of the equations of all circuits."""
        return self.links - 1 - self.by_rank


def _stationary_links(reduced: ReducedSystem, forms: Mapping[int, LinearForm]) -> list[str]:
    """Return the links that are at rest in every motion, because their linear form is 0."""
    parts = reduced.components
    if not forms:
        return []
    null = {column for column, form in forms.items() if not form}
    found = []
    for at, name in enumerate(parts.links):
        # one moving unknown moves the link; several may cancel, which the exact form decides
        moving = [column for column in reduced.unknowns_of(at) if column not in null]
        if at != parts.frame and (not moving or (len(moving) > 1 and not resolve_form(reduced.form(at), forms))):
            found.append(name)
    return found


@collector_paused()
def find_mobility(reduced: ReducedSystem, turning_pairs: int, sliding_pairs: int = 0) -> Mobility:
    """Return the mobility from the exact rank without prescribed speeds, (16) and (17) of docs/theory.md."""
    parts = reduced.components
    gears = sum(circuit.kind == "gear" for circuit in parts.circuits)
    shared: list[str] = []
    still: list[str] = []
    idle: list[str] = []
    certain = True
    try:
        budget = elimination_budget(reduced, EXACT_BUDGET)
        echelon = eliminate_within(reduced.equations, budget)
    except TooDenseError:
        certain = False
        # reduction modulo a prime can only lower a rank; for both primes the probability is about 1e-36
        rank = max(rank_modulo(reduced.equations, PRIME), rank_modulo(reduced.equations, (1 << 61) - 31))
    else:
        rank = echelon.rank
        with suppress(TooDenseError):
            forms = echelon.forms(budget)
            still = _stationary_links(reduced, forms)
            # pairs in components whose unknown speed is always 0
            null = {column for column, form in forms.items() if not form and column < len(parts.group_carrier)}
            idle = [c.id for c in parts.circuits if null and c.b and parts.group_of(c) in null]
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
