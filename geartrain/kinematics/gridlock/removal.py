"""What a gridlock report says: the loops at fault, and the meshes to disengage."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from geartrain.kinematics.answer import MOST_NAMES, Loop, abridged_names
from geartrain.numerics.exact import abridged_text
from geartrain.numerics.results import Result

RemovalMethod = Literal["one", "loops", "matching", "search", "greedy"]
_WEAKER: tuple[RemovalMethod, ...] = ("one", "loops", "matching", "search", "greedy")


@dataclass(frozen=True, slots=True)
class RemovalBound(Result):
    """Loops that do not close, each mesh on at most `sharing` of them: one mesh frees no more than that many."""

    KEYS = ("sharing", "loops")

    loops: tuple[Loop, ...]
    """Loops that do not close."""
    sharing: int
    """The most loops to which one mesh belongs."""

    @property
    def at_least(self) -> int:
        """How many meshes must go."""
        return -(-len(self.loops) // self.sharing)

    def __str__(self) -> str:
        many = len(self.loops)
        if many == 1:
            return "a loop that does not close needs one"
        apart = "share no mesh" if self.sharing == 1 else "have each mesh in at most two of them"
        return f"{many} loops that do not close {apart}"


@dataclass(frozen=True, slots=True)
class MeshRemoval(Result):
    """Meshes to disengage so that every loop closes and all links held by them can move; none of them could stay.

    See Also
    --------
    Gridlock : an example
    """

    KEYS = ("meshes", "method", "minimum", "at_least", "choices", "proofs")

    meshes: tuple[str, ...]
    """Ids of the pairs."""
    method: RemovalMethod
    """One: a single mesh is enough (of each part). loops: as many loops that do not close share no mesh. matching,
    search: exact, by matching the odd regions of a planar set (a T-join) or by branch and bound. greedy: a good set
    without a proof that it is the least."""
    at_least: int
    """A proved lower bound on how many meshes must go."""
    choices: tuple[str, ...] = ()
    """Where one mesh is enough: all that would do."""
    proofs: tuple[RemovalBound, ...] = ()
    """Loops that prove the bound; empty where it rests on the method alone."""

    def _summary(self) -> str:
        return str(self)

    @property
    def minimum(self) -> bool:
        """True if no smaller set frees the train."""
        return self.at_least == len(self.meshes)

    def __str__(self) -> str:
        if len(self.meshes) == 1 and self.choices:
            one = self.choices[0]
            return f"disengage {one}" if len(self.choices) == 1 else f"disengage one of {abridged_names(self.choices)}"
        many = len(self.meshes)
        text = f"disengage {many} meshes: {abridged_names(self.meshes)}" if many > 1 else f"disengage {self.meshes[0]}"
        return f"{text}; {self._why()}"

    def _why(self) -> str:
        proof = ", and ".join(map(str, self.proofs)) if sum(p.at_least for p in self.proofs) == self.at_least else ""
        if not self.minimum:
            because = f", for {proof}" if proof else ""
            return f"none of them can stay, but a smaller set may do; at least {self.at_least} must go{because}"
        exact = {
            "one": "one mesh is the least",
            "matching": "the shortest way to pair the odd regions of the mesh graph, which is planar",
            "search": "all smaller sets are ruled out by branch and bound",
            "loops": "so many loops share no mesh",
            "greedy": "no smaller set does",
        }
        return f"no fewer will do: {proof or exact[self.method]}"


@dataclass(frozen=True, slots=True)
class LockedSubgraph(Result):
    """One component that its meshes lock to its carrier, and what frees it.

    See Also
    --------
    Gridlock : an example
    """

    carrier: str
    """The link from which the component is seen, and with which alone it can turn."""
    loop: Loop
    """A loop that does not close."""
    links: tuple[str, ...]
    """All links of the component."""
    meshes: int
    """How many meshes are between them."""
    by: Literal["sign", "ratio"]
    """Sign: every loop comes back at the same speed, some reversed. ratio: some at another speed."""
    release: MeshRemoval
    """What frees this component alone."""

    def _summary(self) -> str:
        return str(self)

    def __str__(self) -> str:
        loop = self.loop
        if loop.product == -1:
            why = "its reversing meshes are odd in number, so each wheel would turn against itself"
        elif loop.product < 0:
            why = "each wheel would turn against itself, and at another speed"
        else:
            why = f"each wheel would turn at two speeds, {abridged_text(loop.product)} of each other"
        return f"{loop} does not close: {why}"


@dataclass(frozen=True, slots=True)
class Gridlock(Result):
    """Whether the meshes of a train let it move, brakes and inputs left aside, and if not, how to free it.

    Notes
    -----
    The least set of meshes is the frustration index of a graph with gains; where all gains are 1 and -1 and the graph
    is planar it is a least T-join (Katai and Iwai 1978), else branch and bound; docs/theory.md, 7.

    Examples
    --------
    Three wheels, each in mesh with both others:

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
    """Components with a loop that does not close, equation (21) of docs/theory.md."""
    held: tuple[str, ...] = ()
    """Links that meshes about several carriers hold still together, though each loop closes."""
    release: MeshRemoval | None = None
    """What frees the whole train; None if it moves, or if nothing was found."""

    def _summary(self) -> str:
        return str(self)

    @property
    def moves(self) -> bool:
        """True if no mesh holds anything still."""
        return not self.jams and not self.held

    def __str__(self) -> str:
        return "; ".join(self.lines()) or "moves: every loop of meshes closes"

    def lines(self, most: int = MOST_NAMES) -> Iterator[str]:
        """What is wrong and what to do, a sentence each; nothing for a train that moves.

        Parameters
        ----------
        most : int
            Components that are described; of the others only how many there are.
        """
        for jam in self.jams[:most]:
            yield f"gridlock: {jam}"
            if len(self.jams) > 1 or self.held:
                yield f"this one turns again: {jam.release}"
        if len(self.jams) > most:
            yield f"gridlock: {len(self.jams) - most} more parts of the train are locked by loops of their own"
        if self.held:
            stand = "stands" if len(self.held) == 1 else "stand"
            closing = "" if self.jams else ", each loop of which closes"
            by = f"held by meshes about several carriers together{closing}"
            yield f"gridlock: {abridged_names(self.held)} {stand} still, {by}"
        if self.release is not None:
            yield f"to free the train, {self.release}"
        elif not self.moves:
            yield "no set of meshes is known to free it: pins in slots hold it, or there are too many meshes to try"


def weakest_method(methods: Iterable[RemovalMethod]) -> RemovalMethod:
    """The method that proves least: what was found part by part is only as good as that."""
    return max(methods, key=_WEAKER.index)


def join_removals(releases: Iterable[MeshRemoval]) -> MeshRemoval:
    """Releases of components that have no mesh in common, as one."""
    parts = tuple(releases)
    if len(parts) == 1:
        return parts[0]
    return MeshRemoval(
        tuple(mesh for part in parts for mesh in part.meshes),
        weakest_method(part.method for part in parts),
        sum(part.at_least for part in parts),
        (),
        tuple(merge_bounds(proof for part in parts for proof in part.proofs)),
    )


def merge_bounds(proofs: Iterable[RemovalBound]) -> Iterator[RemovalBound]:
    """Proofs about meshes that are not in common: loops that share no mesh are counted together."""
    every = list(proofs)
    apart = tuple(loop for proof in every if proof.sharing == 1 for loop in proof.loops)
    if apart:
        yield RemovalBound(apart, 1)
    yield from (proof for proof in every if proof.sharing > 1)
