"""Result of a gridlock analysis: inconsistent loops, and the meshes to disengage."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, get_args

from geartrain.kinematics.answer import MOST_NAMES, Loop, abridged_names
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.results import Result

RemovalMethod = Literal["one", "loops", "search", "greedy"]


@dataclass(frozen=True, slots=True)
class RemovalBound(Result):
    """Lower bound on the number of meshes to remove, proved by inconsistent loops.

    Each mesh belongs to at most `sharing` of the loops. The removal of one mesh therefore opens at most `sharing`
    loops.
    """

    KEYS = ("sharing", "loops")

    loops: tuple[Loop, ...]
    """Inconsistent loops (ratio product other than 1) that prove the bound."""
    sharing: int
    """Maximum number of loops to which a single mesh belongs."""

    @property
    def at_least(self) -> int:
        """Lower bound on the number of meshes to remove: number of loops divided by `sharing`, rounded up."""
        return -(-len(self.loops) // self.sharing)

    def __str__(self) -> str:
        many = len(self.loops)
        if many == 1:
            return "a loop that does not close requires one removal"
        loops = f"{many} loops that do not close"
        return f"{loops} share no mesh" if self.sharing == 1 else f"each mesh is in at most two of {loops}"


@dataclass(frozen=True, slots=True)
class MeshRemoval(Result):
    """Meshes to remove so that all locked links can move. Each mesh in the set is necessary."""

    KEYS = ("meshes", "method", "minimum", "at_least", "choices", "proofs")

    meshes: tuple[str, ...]
    """Names of the pairs whose meshes are to be removed."""
    method: RemovalMethod
    """Method by which the set of meshes was found.

    "one": the removal of a single mesh is sufficient for each component. "loops": the set is the smallest, because an
    equal number of inconsistent loops share no mesh. "search": the set is the smallest, found by exhaustive search or
    branch and bound. "greedy": the set is not proved to be the smallest.
    """
    at_least: int
    """Proved lower bound on the number of meshes to remove."""
    choices: tuple[str, ...] = ()
    """Pairs any one of which can be removed to free the train, including the pair in `meshes`; empty if several pairs
    must be removed.
    """
    proofs: tuple[RemovalBound, ...] = ()
    """Bounds that are proved by loops; empty if the lower bound follows from the search method."""

    def _summary(self) -> str:
        return str(self)

    @property
    def minimum(self) -> bool:
        """True if it is proved that no smaller set frees the train."""
        return self.at_least == len(self.meshes)

    def __str__(self) -> str:
        if len(self.meshes) == 1 and self.choices:
            one = self.choices[0]
            return f"disengage {one}" if len(self.choices) == 1 else f"disengage one of {abridged_names(self.choices)}"
        many = len(self.meshes)
        text = f"disengage {many} meshes: {abridged_names(self.meshes)}" if many > 1 else f"disengage {self.meshes[0]}"
        return f"{text}; {self._reason()}"

    def _reason(self) -> str:
        proof = ", and ".join(map(str, self.proofs)) if sum(p.at_least for p in self.proofs) == self.at_least else ""
        if not self.minimum:
            because = f", because {proof}" if proof else ""
            return (
                f"none of them is superfluous, but a smaller set may exist; at least {self.at_least} must go{because}"
            )
        exact = {
            "one": "at least one mesh must go",
            "search": "branch and bound excludes all smaller sets",
            "loops": "the same number of loops share no mesh",
            "greedy": "a smaller set does not exist",
        }
        return f"this is the minimum: {proof or exact[self.method]}"


@dataclass(frozen=True, slots=True)
class LockedSubgraph(Result):
    """Component that is locked to its carrier by its meshes, and the meshes whose removal frees it."""

    carrier: str
    """Carrier of the component, with which all its links turn as one body."""
    loop: Loop
    """One inconsistent loop of the component (ratio product other than 1)."""
    links: tuple[str, ...]
    """Names of all links of the component."""
    meshes: int
    """Number of gear pairs in the component. Couplings are not counted, because they cannot be disengaged."""
    by: Literal["sign", "ratio"]
    """Cause of the lock: "sign" if the ratio products of all inconsistent loops are -1, "ratio" if not."""
    release: MeshRemoval
    """Meshes whose removal frees this component."""

    def _summary(self) -> str:
        return str(self)

    def __str__(self) -> str:
        loop = self.loop
        if loop.product == -1:
            why = "it has an odd number of reversing meshes, so each wheel would have to turn both ways"
        elif loop.product < 0:
            why = "each wheel would have to turn both ways, at different speeds"
        else:
            why = f"each wheel would have to turn at two speeds with the ratio {abridged_text(loop.product)}"
        return f"{loop} does not close: {why}"


@dataclass(frozen=True, slots=True)
class Gridlock(Result):
    """Locked parts of a train, ignoring brakes and inputs, and the meshes whose removal frees it.

    Notes
    -----
    The number of meshes in a smallest set is the frustration index of the gain graph. The set is found by integer
    programming (section 7 of docs/theory.md).

    Examples
    --------
    Three wheels, each in mesh with the two others:

    >>> import geartrain
    >>> wheels = {name: {"wheels": {name.upper(): 20}} for name in "abc"}
    >>> train = geartrain.GearTrain.declare({"links": {"frame": {}} | wheels, "inputs": {"a": 1},
    ...     "revolutes": [{"pair": ["frame", link], "axis": link} for link in "abc"],
    ...     "gears": [{"pair": list(pair)} for pair in ("AB", "BC", "CA")]})
    >>> found = train.kinematics.gridlock
    >>> found.moves, found.jams[0].loop.product, found.release.choices
    (False, Fraction(-1, 1), ('A~B', 'B~C', 'C~A'))
    """

    KEYS = ("moves", "jams", "held", "release")

    jams: tuple[LockedSubgraph, ...] = ()
    """Components with an inconsistent loop, equation (21) of docs/theory.md."""
    held: tuple[str, ...] = ()
    """Links that are locked together by meshes on several carriers, although each loop by itself can turn."""
    release: MeshRemoval | None = None
    """Meshes whose removal frees the whole train; None if the train moves, or if no such set is known."""

    def _summary(self) -> str:
        return str(self)

    @property
    def moves(self) -> bool:
        """True if meshes do not lock any link."""
        return not self.jams and not self.held

    def __str__(self) -> str:
        return "; ".join(self.lines()) or "moves: every loop of meshes closes"

    def lines(self, most: int = MOST_NAMES) -> Iterator[str]:
        """Yield a sentence for each locked part that describes the lock and the remedy. No sentence is yielded if no
        link is locked.

        Parameters
        ----------
        most : int
            Maximum number of components that are described. For further components, only their number is given.
        """
        for jam in self.jams[:most]:
            yield f"gridlock: {jam}"
            if len(self.jams) > 1 or self.held:
                yield f"to free this part, {jam.release}"
        if len(self.jams) > most:
            yield f"gridlock: {len(self.jams) - most} more parts of the train are locked by other loops"
        if self.held:
            closing = "" if self.jams else ", although each loop closes"
            by = f"locked by meshes of several carriers together{closing}"
            yield f"gridlock: {abridged_names(self.held)} cannot move, {by}"
        if self.release is not None:
            yield f"to free the train, {self.release}"
        elif not self.moves:
            yield "no set of meshes was found to free it: couplings lock it, or there are too many meshes to try"


def join_removals(releases: Iterable[MeshRemoval]) -> MeshRemoval:
    """Return the combined removal of components that have no meshes in common."""
    parts = tuple(releases)
    # alternatives exist only for a single component
    if len(parts) == 1:
        return parts[0]
    # bounds from loops that share no mesh are added
    proofs = [proof for part in parts for proof in part.proofs]
    apart = tuple(loop for proof in proofs if proof.sharing == 1 for loop in proof.loops)
    others = (proof for proof in proofs if proof.sharing > 1)
    return MeshRemoval(
        tuple(mesh for part in parts for mesh in part.meshes),
        # the weakest proof of all parts counts: `RemovalMethod` is in that order
        max((part.method for part in parts), key=get_args(RemovalMethod).index),
        sum(part.at_least for part in parts),
        (),
        (*([RemovalBound(apart, 1)] if apart else []), *others),
    )
