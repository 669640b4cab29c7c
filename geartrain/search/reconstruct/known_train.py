"""A given train as an answer to a question: what of it leads to the question's dials, in the question's names.

Wheels that survive are found in the train by their names; a wheel that the question does not know is an added one. What
leads to no dial of the question is left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.kinematics.circuits.joint_tree import find_tree
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    Arbor,
    PlacedWheel,
    ReconstructionProblem,
    SearchedDial,
)
from geartrain.search.reconstruct.spur_tree import DrivenArbor, walk_meshes
from geartrain.train import Train


@dataclass(frozen=True)
class KnownTrain:
    """A train as a candidate.

    name   of the train
    arbor  from its input on; its dials are those of the question that its meshes lead to, at whatever speed
    added  wheels that are added, by their names in the train, with their counts
    notes  what of the train plays no part, or is otherwise than a candidate can be
    """

    name: str
    arbor: Arbor
    added: Mapping[str, int]
    notes: tuple[str, ...]


def find_known_train(train: Train, problem: ReconstructionProblem, same: Mapping[str, str] | None = None) -> KnownTrain:
    """A train in the words of a question.

    Parameters
    ----------
    train : Train
    problem : ReconstructionProblem
        Its arbors turn in the frame.
    same : mapping of str to str, optional
        Names of wheels and outputs of the train that the question calls otherwise, with those that it has there.
        Others are called alike, or alike but for capitals.

    Raises
    ------
    QuestionError
        If the train has no arbor of the input, or its meshes close a loop, or a count of a wheel is not known.
    """
    return _Reading(train, problem, same or {}).known()


class _Reading:
    """A train that is read in the words of a question."""

    def __init__(self, train: Train, problem: ReconstructionProblem, same: Mapping[str, str]) -> None:
        self.train, self.problem, self.same = train, problem, same
        self._arbors = {arbor.name: arbor for arbor in (problem.input, *problem.arbors)}

    def known(self) -> KnownTrain:
        driven, shown = self._driven, self._shown
        kept = set[str]()
        for link in shown.values():
            while link in driven and link not in kept:
                kept.add(link)
                link = driven[link].parent
        arbor = self._arbor(self._source, kept)
        wheels = [name for link in kept for name in (driven[link].driving, driven[link].driven)]
        counts = {name: self._teeth(name) for name in self.train.wheels if name in wheels}
        added = {name: teeth for name, teeth in counts.items() if self._survivor(name) is None}
        return KnownTrain(self.train.name, arbor, added, tuple(self._notes()))

    # names

    @cached_property
    def _matches(self) -> dict[str, str]:
        """Wheels of the train, by those of the question."""
        wanted = [wheel.name for arbor in self._arbors.values() for wheel in arbor.wheels]
        found = {self.same[name]: name for name in self.train.wheels if self.same.get(name) in wanted}
        free = [name for name in self.train.wheels if name not in self.same]
        found = {name: name for name in wanted if name in free} | found
        for name in wanted:
            alike = [own for own in free if own.casefold() == name.casefold() and own not in found.values()]
            if name not in found and len(alike) == 1:
                found[name] = alike[0]
        return found

    @cached_property
    def _links(self) -> dict[str, str]:
        """Links of the train, by arbors of the question: that with most of its wheels, which is no other arbor's."""
        found: dict[str, str] = {}
        for arbor in self._arbors.values():
            links = [self._link(self._matches[wheel.name]) for wheel in arbor.wheels if wheel.name in self._matches]
            if not links and arbor.name in self.train.links and not arbor.wheels:
                links = [self._joined[arbor.name]]
            links = [link for link in links if link not in found.values()]
            if links:
                found[arbor.name] = max(links, key=links.count)
        return found

    def _link(self, wheel: str) -> str:
        return self._joined[self.train.wheels[wheel][0]]

    @cached_property
    def _joined(self) -> dict[str, str]:
        """Links of the train, by those that a pin in a slot on the frame makes turn with them, and by themselves."""
        tree, frame = find_tree(self.train), self.train.frame
        found = {link: link for link in self.train.links}
        for coupling in self.train.couplings:
            pair = coupling.pin, coupling.slot
            if coupling.kind == "pin_and_slot" and all(tree.bears(frame, link) for link in pair):
                one, other = (found[link] for link in pair)
                found = {link: one if of == other else of for link, of in found.items()}
        return found

    @cached_property
    def _names(self) -> dict[str, str]:
        """Arbors of the question, by links of the train."""
        return {link: arbor for arbor, link in self._links.items()}

    @cached_property
    def _survivors(self) -> dict[str, str]:
        """Wheels of the question by those of the train, each on the link that is its arbor."""
        return {
            self._matches[wheel.name]: wheel.name
            for arbor in self._arbors.values()
            for wheel in arbor.wheels
            if wheel.name in self._matches and self._link(self._matches[wheel.name]) == self._links.get(arbor.name)
        }

    def _survivor(self, wheel: str) -> str | None:
        return self._survivors.get(wheel)

    def _notes(self) -> Iterator[str]:
        for name, own in self._matches.items():
            if own not in self._survivors:
                arbor = next(each.name for each in self._arbors.values() if name in {one.name for one in each.wheels})
                yield f"{own} is not fixed to the other wheels of {arbor}, and is not taken for {name}"

    # meshes

    @cached_property
    def _source(self) -> str:
        name = self.problem.input.name
        found = self._links.get(name) or self._joined.get(name)
        if found is None:
            what = f"'{self.train.name}' has no wheel of '{name}', where a train of the question begins"
            raise QuestionError(Problem(what, "wheels are found by their names", "say `--same ITS=OURS`"))
        return found

    @cached_property
    def _driven(self) -> dict[str, DrivenArbor]:
        """How every link is driven that spur wheels on the frame lead to from the input, breadth first."""
        rings = {own for own, name in self._survivors.items() if name in self.problem.rings}
        return walk_meshes(self.train, self._source, self._joined, rings)

    def _teeth(self, wheel: str) -> int:
        count = self.train.wheels[wheel][1].count
        if count is None:
            place = self.train.place("links")
            raise QuestionError(Problem(f"the count of '{wheel}' is still to be found", "", "give it a value", place))
        return count

    # pointers

    @cached_property
    def _shown(self) -> dict[str, str]:
        """Links that show the dials, as far as meshes lead to them."""
        found = {}
        for dial in self.problem.dials:
            link = self._links.get(dial.place) if dial.place not in (None, NEW) else self._pointer(dial)
            if link is not None and link in (self._source, *self._driven):
                found[dial.name] = link
        return found

    def _pointer(self, dial: SearchedDial) -> str | None:
        """The link of a pointer whose arbor is not known: that of the output of its name, else one of its speed."""
        called = {**{name: name for name in self.train.outputs}, **self.same}
        for name, output in self.train.case(None).outputs.items():
            if called[name] == dial.name and output.relative_to in (None, self.train.frame):
                return self._joined[output.of or name]
        lost = dial.place == NEW
        return next(
            (
                link
                for link, speed in self._speeds.items()
                if dial.least <= (speed if dial.signed else abs(speed)) <= dial.greatest
                and not (lost and link in self._names)
            ),
            None,
        )

    @cached_property
    def _speeds(self) -> dict[str, Fraction]:
        found = {self._source: self.problem.input_speed}
        for link, mesh in self._driven.items():
            inside = any(self.train.wheels[name][1].internal for name in (mesh.driving, mesh.driven))
            ratio = Fraction(self._teeth(mesh.driving), self._teeth(mesh.driven))
            found[link] = found[mesh.parent] * (ratio if inside else -ratio)
        return found

    # the candidate

    def _arbor(self, link: str, kept: set[str]) -> Arbor:
        own = self._driven[link].driven if link in self._driven else None
        below: dict[str, list[Arbor]] = {}
        for child in self._driven:
            if child in kept and self._driven[child].parent == link:
                below.setdefault(self._driven[child].driving, []).append(self._arbor(child, kept))
        return Arbor(
            self._names.get(link),
            None if own is None else self._placed(own),
            tuple(sorted(name for name, at in self._shown.items() if at == link)),
            tuple((self._placed(wheel), tuple(children)) for wheel, children in below.items() if wheel != own),
            () if own is None else tuple(below.get(own, ())),
        )

    def _placed(self, wheel: str) -> PlacedWheel:
        return PlacedWheel(self._survivor(wheel), self._teeth(wheel))


def check_same(pairs: Mapping[str, str], trains: Sequence[Train], problem: ReconstructionProblem) -> None:
    """Make sure that names which are said to be the same are names. Raises `QuestionError`."""
    own = {name for train in trains for name in (*train.wheels, *train.outputs)}
    asked = {wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}
    asked |= {dial.name for dial in problem.dials}
    for name, called in pairs.items():
        if name not in own:
            what = f"'{name}' is no wheel and no output of a train that is ranked"
            raise QuestionError(Problem(what, "", suggest(name, sorted(own))))
        if called not in asked:
            what = f"'{called}' is no wheel and no dial of the evidence"
            raise QuestionError(Problem(what, "", suggest(called, sorted(asked))))
