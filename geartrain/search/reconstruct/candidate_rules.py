"""Check of one candidate against the rules of a reconstruction problem.

The module also converts a published train to a candidate, whose surviving wheels are identified by their names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Literal

from geartrain.errors import Problem, QuestionError, suggest
from geartrain.kinematics.circuits.joint_tree import find_tree
from geartrain.numerics.exact import fraction_text
from geartrain.numerics.graphs import joined_groups
from geartrain.numerics.results import Result
from geartrain.search.reconstruct.arbor_orders import may_mesh
from geartrain.search.reconstruct.geometry_likelihood import candidate_likelihood
from geartrain.search.reconstruct.reconstruction_problem import (
    NEW,
    Arbor,
    PlacedWheel,
    ReconstructionProblem,
    SearchedDial,
)
from geartrain.search.reconstruct.spur_tree import DrivenArbor, candidate_arbor, walk_meshes
from geartrain.train import Train

Rule = Literal[
    "dial", "speed", "place", "wheel", "arbor", "count", "driven", "idler", "end", "ring", "teeth", "arbors", "beside",
    "seen", "apart", "coaxial", "distance",
]  # fmt: skip
"""Kind of a rule of a reconstruction problem. Each kind is listed with the condition that a candidate must satisfy.

dial      every dial has its pointer in the train
speed     a dial has its required speed and sense of rotation
place     the pointer of a dial is on the arbor known to carry it
wheel     every surviving wheel meshes
arbor     every surviving arbor is in the train
count     a surviving wheel has one of its possible tooth counts
driven    the driven wheel of a surviving arbor is one of its surviving wheels
idler     a driven wheel does not drive
end       an arbor that drives nothing carries a pointer
ring      a ring meshes only with wheels of fewer teeth
teeth     the tooth counts of added wheels are within their limits
arbors    the number of added arbors is within its limit
beside    wheels are added only to added arbors
seen      wheels that were seen in mesh do mesh
apart     wheels that are known not to mesh do not mesh
coaxial   arbors on one axis do not mesh
distance  the radii of meshing wheels fit the distance of their axes
"""


@dataclass(frozen=True, slots=True)
class BrokenRule(Result):
    """Rule of a reconstruction problem that is broken by a candidate, with the change of the evidence that would make
    the candidate admissible.
    """

    rule: Rule
    """Kind of the broken rule, one of `Rule`."""
    subject: tuple[str, ...]
    """Names of the dial, the wheels or the arbors that break the rule; empty if the rule concerns added parts."""
    what: str
    """Property of the candidate that breaks the rule."""
    change: str | None
    """Change of the evidence with which the candidate would satisfy this rule; None if no single change is
    sufficient.
    """


def broken_rules(candidate: Arbor, problem: ReconstructionProblem) -> tuple[BrokenRule, ...]:
    """Return all rules that a candidate breaks. The maximum number of added wheels is not checked.

    The result is empty if and only if the candidate explains the dials.

    candidate   input arbor; surviving arbors and wheels have the names of the problem, and all dials are in the problem
    """
    return (
        *_dial_rules(candidate, problem),
        *_use_rules(candidate, problem),
        *_arbor_rules(candidate, problem),
        *_addition_rules(candidate, problem),
        *_mesh_rules(candidate, problem),
    )


def _dial_rules(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    shown: dict[str, list[tuple[Arbor, Fraction]]] = {}
    for arbor, speed in _speeds(candidate, problem.input_speed, problem.rings):
        for name in arbor.dials:
            shown.setdefault(name, []).append((arbor, speed))
    for dial in problem.dials:
        if len(shown.get(dial.name, ())) != 1:
            change = f"without the dial {dial.name}"
            yield BrokenRule("dial", (dial.name,), f"{dial.name} is not shown", change)
            continue
        ((arbor, speed),) = shown[dial.name]
        if not dial.accepts(speed):
            turns = fraction_text(speed)
            what = f"{dial.name} turns at {turns}, not {speed_text(dial)}"
            yield BrokenRule("speed", (dial.name,), what, f"if {dial.name} turns at {turns}")
        if dial.place not in (None, arbor.name or NEW):
            at = "an added arbor" if arbor.name is None else arbor.name
            where = "is lost" if dial.place == NEW else f"is {dial.place}"
            change = f"without the fact that the arbor of {dial.name} {where}"
            yield BrokenRule("place", (dial.name,), f"{dial.name} is shown on {at}", change)


def speed_text(dial: SearchedDial) -> str:
    """Format the required speed of a dial [turns per unit of the input]."""
    bounds = dict.fromkeys((dial.minimum, dial.maximum))
    text = " to ".join(fraction_text(each) if dial.is_exact else f"{float(each):.7g}" for each in bounds)
    return text + ("" if dial.signed else " in either sense")


def _speeds(candidate: Arbor, speed: Fraction, rings: frozenset[str]) -> Iterator[tuple[Arbor, Fraction]]:
    """Yield every arbor of a candidate with its speed [turns per unit of the input]. `speed` is the speed of the first
    arbor.
    """
    yield candidate, speed
    for wheel, child in candidate.driven_arbors():
        assert child.driven is not None
        # an internal mesh keeps the sense of rotation
        sense = 1 if {wheel.name, child.driven.name} & rings else -1
        yield from _speeds(child, sense * speed * wheel.teeth / child.driven.teeth, rings)


def _use_rules(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    used = {wheel.name: wheel.teeth for wheel in candidate.wheels() if wheel.name is not None}
    here = {arbor.name for arbor in candidate.arbors()}
    for arbor in (problem.input, *problem.arbors):
        if arbor.name not in here and (problem.use == "arbors" or (problem.use == "wheels" and arbor.wheels)):
            yield BrokenRule("arbor", (arbor.name,), f"{arbor.name} is not in the train", f"without {arbor.name}")
            continue
        for wheel in arbor.wheels:
            if wheel.name not in used:
                if problem.use == "wheels":
                    yield BrokenRule("wheel", (wheel.name,), f"{wheel.name} is not used", f"without {wheel.name}")
            elif used[wheel.name] not in {count for count, _ in wheel.counts}:
                teeth = used[wheel.name]
                what = f"{wheel.name} has {teeth} teeth, not {counts_text(wheel.counts)}"
                change = f"if {wheel.name} has {teeth} teeth"
                yield BrokenRule("count", (wheel.name,), what, change)


def counts_text(counts: Sequence[tuple[int, Fraction]]) -> str:
    """Format possible tooth counts as a range, such as `60-63`, or as a list, such as `60/62`."""
    teeth = [count for count, _ in counts]
    if len(teeth) > 1 and teeth == list(range(teeth[0], teeth[-1] + 1)):
        return f"{teeth[0]}-{teeth[-1]}"
    return "/".join(map(str, teeth))


def _arbor_rules(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    wheels = {arbor.name: arbor.wheels for arbor in problem.arbors}
    for arbor in candidate.arbors():
        said = arbor.name or "an added arbor"
        if arbor.name in wheels and wheels[arbor.name] and arbor.driven and arbor.driven.name is None:
            what = f"{said} is driven by an added wheel of {arbor.driven.teeth} teeth"
            yield BrokenRule("driven", (said,), what, f"if {said} is lost")
        if arbor.passes and not problem.idlers:
            assert arbor.driven is not None
            idler = arbor.driven.name or f"an added wheel of {arbor.driven.teeth}"
            yield BrokenRule("idler", (said,), f"{idler} is driven and drives", "if a driven wheel may drive")
        if not arbor.dials and not any(arbor.driven_arbors()):
            yield BrokenRule("end", (said,), f"{said} leads to no pointer", None)


def _addition_rules(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    limits = problem.additions
    added = sorted({wheel.teeth for wheel in candidate.wheels() if wheel.name is None})
    beyond = [teeth for teeth in added if not limits.minimum <= teeth <= limits.maximum]
    if beyond:
        minimum, maximum = min(limits.minimum, *added), max(limits.maximum, *added)
        what = f"added wheels have {', '.join(map(str, beyond))} teeth, not {limits.minimum} to {limits.maximum}"
        yield BrokenRule("teeth", (), what, f"if added wheels may have {minimum} to {maximum} teeth")
    arbors = candidate.added_arbors
    if limits.arbors is not None and arbors > limits.arbors:
        what = f"{arbors} arbors are added, more than {limits.arbors}"
        yield BrokenRule("arbors", (), what, f"if {arbors} arbors may be added")
    beside = []
    for arbor in candidate.arbors():
        meshing = [arbor.driven, *(wheel for wheel, _ in arbor.drives)]
        if arbor.name and any(wheel is not None and wheel.name is None for wheel in meshing):
            beside.append(arbor.name)
    if limits.on == "new" and beside:
        what = f"wheels are added on {', '.join(beside)}"
        yield BrokenRule("beside", (), what, "if wheels may be added on surviving arbors")


def _mesh_rules(candidate: Arbor, problem: ReconstructionProblem) -> Iterator[BrokenRule]:
    meshes = list(candidate.meshes())
    wheels = {frozenset((wheel.name, child.driven.name)) for _, wheel, child in meshes if child.driven}
    arbors = {frozenset((parent.name, child.name)) for parent, _, child in meshes}
    rules: tuple[tuple[Rule, frozenset[frozenset[str]], str, str], ...] = (
        ("seen", problem.meshes - wheels, "{} do not mesh", "{} mesh"),
        ("apart", problem.apart & wheels, "{} mesh", "{} do not mesh"),
        ("coaxial", problem.coaxial & arbors, "wheels of the coaxial arbors {} mesh", "{} are coaxial"),
    )
    for rule, pairs, what, fact in rules:
        for pair in sorted(map(sorted, pairs)):
            said = " and ".join(pair)
            yield BrokenRule(rule, tuple(pair), what.format(said), f"without the fact that {fact.format(said)}")
    for _, wheel, child in meshes:
        if child.driven is not None and not may_mesh(wheel, child.driven, problem.rings):
            what = f"{wheel.name or wheel.teeth} and {child.driven.name or child.driven.teeth} cannot mesh in a ring"
            yield BrokenRule("ring", (), what, None)
    if problem.geometry.reach is not None and not candidate_likelihood(candidate, problem.geometry):
        what = "radii of meshing wheels do not match the distance between their axes"
        yield BrokenRule("distance", (), what, "if the distances between axes exclude no meshes")


# ----------------------------------------------------------- a given train as a candidate, in the names of the problem


@dataclass(frozen=True)
class KnownTrain:
    """Known train, converted to a candidate of a reconstruction problem."""

    arbor: Arbor
    """Input arbor of the candidate. The candidate has a pointer for every dial of the problem that is connected to the
    input by meshes, even if its speed differs from the required speed.
    """
    added: Mapping[str, int]
    """Tooth count of each added wheel, keyed by the name of the wheel in the known train."""
    notes: tuple[str, ...]
    """Descriptions of features of the train that are ignored, because a candidate cannot have them."""


def find_known_train(train: Train, problem: ReconstructionProblem, same: Mapping[str, str] | None = None) -> KnownTrain:
    """Convert a train to a candidate of a problem whose arbors turn in the frame and not on a carrier.

    same   name in the problem, keyed by name in the train, of wheels and outputs that are named differently in the
           train; the names of other parts may differ only in capitals

    `QuestionError` is raised if the train has no input arbor, if its meshes close a loop, or if the tooth count of a
    wheel is not known.
    """
    return _TrainReading(train, problem, same or {}).known()


class _TrainReading:
    """Conversion of a known train to a candidate with the names of a reconstruction problem."""

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
        leading = {link: mesh for link, mesh in driven.items() if link in kept}
        arbor = candidate_arbor(self._source, leading, self._names, shown, self._placed)
        wheels = [name for link in kept for name in (driven[link].driving, driven[link].driven)]
        counts = {name: self._teeth(name) for name in self.train.wheels if name in wheels}
        added = {name: teeth for name, teeth in counts.items() if name not in self._survivors}
        return KnownTrain(arbor, added, tuple(self._notes()))

    # names

    @cached_property
    def _matches(self) -> dict[str, str]:
        """Name of the wheel in the train, keyed by the name of the wheel in the problem."""
        wanted = [wheel.name for arbor in self._arbors.values() for wheel in arbor.wheels]
        found = {self.same[name]: name for name in self.train.wheels if self.same.get(name) in wanted}
        free = [name for name in self.train.wheels if name not in self.same]
        found = {name: name for name in wanted if name in free} | found
        for name in wanted:
            # names that differ only in capitals
            alike = [own for own in free if own.casefold() == name.casefold() and own not in found.values()]
            if name not in found and len(alike) == 1:
                found[name] = alike[0]
        return found

    @cached_property
    def _links(self) -> dict[str, str]:
        """Link of the train that corresponds to each arbor of the problem, keyed by arbor. It is the link that carries
        most wheels of the arbor.
        """
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
        """First link of the group to which each link belongs, keyed by link. The links of a group turn in the frame and
        are connected by pins and slots.
        """
        tree, frame = find_tree(self.train), self.train.frame
        pairs = ((one.pin, one.slot) for one in self.train.pin_couplings if one.kind == "pin_and_slot")
        joints = (pair for pair in pairs if all(tree.bears(frame, link) for link in pair))
        return {link: links[0] for links in joined_groups(self.train.links, joints) for link in links}

    @cached_property
    def _names(self) -> dict[str, str]:
        """Name of the arbor in the problem, keyed by the name of the link in the train."""
        return {link: arbor for arbor, link in self._links.items()}

    @cached_property
    def _survivors(self) -> dict[str, str]:
        """Name of the wheel in the problem, keyed by the name of the wheel in the train. Only wheels whose link
        corresponds to the arbor that carries them in the problem are included.
        """
        return {
            self._matches[wheel.name]: wheel.name
            for arbor in self._arbors.values()
            for wheel in arbor.wheels
            if wheel.name in self._matches and self._link(self._matches[wheel.name]) == self._links.get(arbor.name)
        }

    def _notes(self) -> Iterator[str]:
        for name, own in self._matches.items():
            if own not in self._survivors:
                arbor = next(each.name for each in self._arbors.values() if name in {one.name for one in each.wheels})
                yield f"{own} is not fixed to the other wheels of {arbor}, and is therefore not identified with {name}"

    # meshes

    @cached_property
    def _source(self) -> str:
        name = self.problem.input.name
        found = self._links.get(name) or self._joined.get(name)
        if found is None:
            what = f"'{self.train.name}' has no wheel of '{name}', the input of the evidence"
            fix = f"name a wheel of '{name}' with `--same ITS=OURS`"
            raise QuestionError(Problem(what, "wheels are identified by their names", fix))
        return found

    @cached_property
    def _driven(self) -> dict[str, DrivenArbor]:
        """Mesh that drives each link connected to the input by meshes in the frame, keyed by link in breadth-first
        order.
        """
        rings = {own for own, name in self._survivors.items() if name in self.problem.rings}
        return walk_meshes(self.train, self._source, self._joined, rings)

    def _teeth(self, wheel: str) -> int:
        count = self.train.wheels[wheel][1].count
        if count is None:
            what, why = f"the tooth count of '{wheel}' is not known", "a train is ranked by all its tooth counts"
            fix = "declare the count, such as `teeth: {value: 64}`"
            raise QuestionError(Problem(what, why, fix, self.train.place("links")))
        return count

    # pointers

    @cached_property
    def _shown(self) -> dict[str, str]:
        """Link that carries the pointer of each dial, keyed by dial. Only links connected to the input by meshes are
        included.
        """
        found = {}
        for dial in self.problem.dials:
            link = self._links.get(dial.place) if dial.place not in (None, NEW) else self._pointer(dial)
            if link is not None and link in (self._source, *self._driven):
                found[dial.name] = link
        return found

    def _pointer(self, dial: SearchedDial) -> str | None:
        """Return the link of a dial whose arbor is not known: the link of the output with the same name or, if there is
        none, a link with the same speed.
        """
        called = {**{name: name for name in self.train.outputs}, **self.same}
        for name, output in self.train.case(None).outputs.items():
            if called[name] == dial.name and output.relative_to in (None, self.train.frame):
                return self._joined[output.of or name]
        lost = dial.place == NEW
        fitting = (link for link, speed in self._speeds.items() if dial.accepts(speed))
        return next((link for link in fitting if not (lost and link in self._names)), None)

    @cached_property
    def _speeds(self) -> dict[str, Fraction]:
        found = {self._source: self.problem.input_speed}
        for link, mesh in self._driven.items():
            inside = any(self.train.wheels[name][1].internal for name in (mesh.driving, mesh.driven))
            ratio = Fraction(self._teeth(mesh.driving), self._teeth(mesh.driven))
            found[link] = found[mesh.parent] * (ratio if inside else -ratio)
        return found

    def _placed(self, wheel: str) -> PlacedWheel:
        return PlacedWheel(self._survivors.get(wheel), self._teeth(wheel))


def check_same(pairs: Mapping[str, str], trains: Sequence[Train], problem: ReconstructionProblem) -> None:
    """Raise `QuestionError` unless each pair of equivalent names consists of the name of a part in one of the trains
    and the name of a part in the problem.
    """
    own = {name for train in trains for name in (*train.wheels, *train.outputs)}
    requested = {wheel.name for arbor in (problem.input, *problem.arbors) for wheel in arbor.wheels}
    requested |= {dial.name for dial in problem.dials}
    for name, called in pairs.items():
        if name not in own:
            what = f"'{name}' is not a wheel or an output of a ranked train"
            why = "in `--same ITS=OURS`, ITS is a name in the ranked train"
            raise QuestionError(Problem(what, why, suggest(name, sorted(own))))
        if called not in requested:
            what = f"'{called}' is not a wheel or a dial of the evidence"
            why = "in `--same ITS=OURS`, OURS is a name in the evidence"
            raise QuestionError(Problem(what, why, suggest(called, sorted(requested))))
