"""Links held to the frame or locked together, joint by joint: which turning pairs a rigid connection closes.

Two links are one body if the twist of the one against the other vanishes: the sum of joint rates times screws of the
axes on the way between them. Screws of different lines are independent, two or three of them for good; so every joint
on the way is closed, and not the sum of their rates alone (docs/theory.md, section 4). Four axes and more may make a
linkage, whose ratio varies as it turns: it is refused, unless positions are declared and show that it cannot move.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from geartrain.errors import DeclarationError, Loc, Problem
from geartrain.kinematics.circuits.joint_tree import Axes, Tree
from geartrain.numerics.elimination import eliminate
from geartrain.numerics.graphs import DisjointSets, ways_to_common_ancestor
from geartrain.train import StateCase, Train

JointOnLine = tuple[str, str, tuple[str, ...]]
"""Two links that turn about each other, and the axis between them: one label, or several that lie on one line."""


@dataclass(frozen=True, slots=True)
class Rigid:
    """One prescription that makes two links one body: what it names, and the joints on the way between them.

    links   one link that is fixed, or two that are locked together
    """

    links: tuple[str, ...]
    joints: tuple[JointOnLine, ...]

    @property
    def labels(self) -> list[str]:
        """The axes on the way."""
        return [label for _, _, labels in self.joints for label in labels]


def close_joints(train: Train, tree: Tree, cases: Sequence[StateCase]) -> list[StateCase]:
    """The cases with every fixed link on an axis of the frame, and every lock between two coaxial links.

    What was prescribed across several axes stands in them joint by joint, each with its cause in words. A case with
    linkages, or with inputs whose link has no one axis in the frame, has them as its `problems`. Raises
    `DeclarationError` where every case has some.
    """
    lines, sums = JointLines(train, tree), Axes(train, tree).joint_sums
    closed = [_closed(train, lines, sums, case) for case in cases]
    if all(case.problems for case in closed):
        raise DeclarationError({str(problem): problem for case in closed for problem in case.problems}.values())
    return closed


def _closed(train: Train, lines: JointLines, sums: frozenset[str], case: StateCase) -> StateCase:
    problems = list(_driven_sums(train, case, sums))
    across = [rigid for rigid in rigid_connections(lines, case) if len(rigid.joints) > 1]
    if across:
        stops, linkages = _Bodies(lines, case).close(across)
        problems += [_linkage(train, case, rigid) for rigid in linkages]
        case = _joint_by_joint(lines.frame, case, across, stops)
    return replace(case, problems=tuple(problems)) if problems else case


def rigid_across_axes(train: Train, tree: Tree, case: StateCase) -> Iterator[Rigid]:
    """The prescriptions of a case that a brake or clutch cannot make alone: two joints or more are left to close.

    A link whose carrier is held, or locked to what it is locked to, has one joint left, as if its axis stood still.
    """
    lines = JointLines(train, tree)
    bodies = _Bodies(lines, case)
    return (rigid for rigid in rigid_connections(lines, case) if len(bodies.open(rigid)) > 1)


class JointLines:
    """The axes of a train as lines: the way between two links, and whether axes lie on one line or may move."""

    def __init__(self, train: Train, tree: Tree) -> None:
        self.frame, self._tree, self._axes = tree.frame, tree, Axes(train, tree)

    def joints(self, a: str, b: str) -> tuple[JointOnLine, ...]:
        """The joints between two links, one for each line; each link hung on the one that bears its axis."""
        parent, top = self._tree.parent, self._tree.top
        up, down = ways_to_common_ancestor(a, b, top.get)
        steps = [(link, top[link], parent[link][1]) for link in up[:-1]]
        steps += [(top[link], link, parent[link][1]) for link in down[-2::-1]]
        found: list[JointOnLine] = []
        for start, end, label in steps:
            if found and self._alike(found[-1][2][-1], label):
                before = found.pop()
                labels = before[2] if before[2][-1] == label else (*before[2], label)
                found.append((before[0], end, labels))
            else:
                found.append((start, end, (label,)))
        return tuple(found)

    def _alike(self, one: str, other: str) -> bool:
        return one == other or self._axes.are_one_line(one, other)

    def rigid(self, labels: Sequence[str]) -> bool:
        """Whether a chain of these axes that is closed into a ring cannot move."""
        # up to three different lines have independent screws in every pose; of more only the rank in this pose tells
        if len(labels) <= 3 and not any(self._alike(one, other) for one, other in combinations(labels, 2)):
            return True
        screws = [screw for label in labels if (screw := self._axes.screw(label)) is not None]
        return len(screws) == len(labels) and eliminate(screws).rank == len(labels)


def rigid_connections(lines: JointLines, case: StateCase) -> Iterator[Rigid]:
    """Every prescription of a case that makes two links one body."""
    for link in case.fixed:
        yield Rigid((link,), lines.joints(link, lines.frame))
    for a, b in case.locks:
        yield Rigid((a, b), lines.joints(a, b))


class _Bodies:
    """Which links are one body; grows with every joint that is closed."""

    def __init__(self, lines: JointLines, case: StateCase) -> None:
        self._lines = lines
        self._bodies: DisjointSets[str] = DisjointSets()
        for rigid in rigid_connections(lines, case):
            if len(rigid.joints) == 1:
                self._bodies.join(*rigid.joints[0][:2])

    def close(self, across: Sequence[Rigid]) -> tuple[list[tuple[Rigid, JointOnLine]], list[Rigid]]:
        """The joints that must be closed, each with its cause, and the prescriptions that would make linkages."""
        closed: list[tuple[Rigid, JointOnLine]] = []
        waiting = list(across)
        while waiting:
            able = [rigid for rigid in waiting if self._lines.rigid(self._labels(rigid))]
            if not able:
                break
            rigid = able[0]
            waiting.remove(rigid)
            for joint in self.open(rigid):
                self._bodies.join(*joint[:2])
                closed.append((rigid, joint))
        return closed, waiting

    def open(self, rigid: Rigid) -> list[JointOnLine]:
        """The joints of a prescription that nothing has closed yet."""
        return [joint for joint in rigid.joints if self._bodies.are_apart(joint[0], joint[1])]

    def _labels(self, rigid: Rigid) -> list[str]:
        return [labels[0] for _, _, labels in self.open(rigid)]


def _joint_by_joint(
    frame: str, case: StateCase, across: Sequence[Rigid], stops: Sequence[tuple[Rigid, JointOnLine]]
) -> StateCase:
    """The case with its prescriptions across several axes replaced by the joints they close."""
    spread = {rigid.links for rigid in across}
    fixed = [link for link in case.fixed if (link,) not in spread]
    locks = [lock for lock in case.locks if lock not in spread]
    causes: dict[tuple[str, ...], tuple[str, ...]] = {}
    for rigid, (start, end, _) in stops:
        if frame in (start, end):
            link = end if start == frame else start
            fixed.append(link)
            causes[(link,)] = rigid.links
        else:
            locks.append((start, end))
            causes[(start, end)] = rigid.links
    return replace(case, fixed=tuple(dict.fromkeys(fixed)), locks=tuple(locks), causes=causes)


def _driven_sums(train: Train, case: StateCase, sums: frozenset[str]) -> Iterator[Problem]:
    """The inputs that prescribe a sum of joint speeds over axes in several directions."""
    for link in sums.intersection(case.inputs):
        yield Problem(
            f"the input '{link}' has no speed about one axis",
            "the axes between it and the frame are not parallel, and the sum of joint speeds over them is no rotation",
            "drive a link whose axes up to the frame are parallel",
            train.place(*case.loc, link),
        )


def _linkage(train: Train, case: StateCase, rigid: Rigid) -> Problem:
    links = [inner for _, inner, _ in rigid.joints[:-1] if inner != train.frame]
    return Problem(
        f"{case.says(*rigid.links)} across the axes {', '.join(rigid.labels)}, which makes a linkage",
        f"a ring of {len(rigid.joints)} turning pairs may move, with a ratio that varies as it turns; a gear train "
        "has none such",
        f"hold or lock a link on the way ({', '.join(links)}), or lock links that have their axis in common",
        train.place(*rigid_place(train, case, rigid.links)),
    )


def rigid_place(train: Train, case: StateCase, links: tuple[str, ...]) -> Loc:
    """Where a rigid connection is declared."""
    if links in case.clutches:
        return ("clutches", case.clutches[links])
    key = "fixed" if len(links) == 1 else "locks"
    state = train.states[case.state] if case.state is not None else None
    own = getattr(state, key) if state is not None else None
    listed = list(getattr(train, key) if own is None else own)
    at = listed.index(links[0] if len(links) == 1 else links)
    return (key, at) if own is None or case.state is None else ("states", case.state, key, at)
