"""Arbors that a given coupling joins: they turn as one on average, and are one arbor in the question.

The one that they become has the wheels and pointers of all. Each wheel stays on its own arbor when a candidate is
written; what is added is written on the first of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from geartrain.errors import Loc, Problem
from geartrain.synthesis.reconstruction.reconstruction_problem import ReconstructionProblem, SurvivingArbor
from geartrain.synthesis.reconstruction.surviving_geometry import PlacedArbor
from geartrain.train import Train

Joined = Mapping[str, tuple[str, ...]]
"""By the name of the arbor in the question, the links that it stands for, itself first."""


def joined_arbors(evidence: Train) -> Joined:
    """What the given couplings of evidence join: called after the input, else the first link with wheels."""
    groups: dict[str, set[str]] = {}
    for pair, _ in _pairs(evidence):
        group = set().union(*(groups.get(link, {link}) for link in pair))
        groups.update(dict.fromkeys(group, group))
    found = {}
    for link in evidence.links:
        if link in groups:
            own = [other for other in evidence.links if other in groups[link]]
            own.sort(key=lambda other: (other not in evidence.inputs, not evidence.links[other].wheels))
            found[own[0]] = tuple(own)
    return found


def couplings_of(evidence: Train, links: Sequence[str]) -> Iterator[dict[str, Any]]:
    """The couplings of joined links with the keys of a declaration."""
    asked = evidence.reconstruct
    for coupling in evidence.couplings:
        if coupling.pin in links:
            yield coupling.model_dump(mode="json", exclude_unset=True, by_alias=True)
    for given in () if asked is None else asked.given:
        if given.pair[0] in links:
            yield {"kind": given.kind, "pin": given.pair[0], "slot": given.pair[1]}


def _pairs(evidence: Train) -> Iterator[tuple[tuple[str, str], Loc]]:
    """Links that a coupling joins, and its place in the evidence."""
    assert evidence.reconstruct is not None, "no evidence"
    for at, coupling in enumerate(evidence.couplings):
        yield (coupling.pin, coupling.slot), ("couplings", at)
    for at, given in enumerate(evidence.reconstruct.given):
        yield given.pair, ("reconstruct", "given", at)


def join_arbors(problem: ReconstructionProblem, joined: Joined) -> ReconstructionProblem:
    """The question in which the links of each group are one arbor."""
    if not joined:
        return problem
    names = {link: name for name, links in joined.items() for link in links}
    known = {arbor.name: arbor for arbor in (problem.input, *problem.arbors)}

    def whole(arbor: SurvivingArbor) -> SurvivingArbor:
        links = joined.get(arbor.name, (arbor.name,))
        return SurvivingArbor(arbor.name, tuple(wheel for link in links for wheel in known[link].wheels))

    places = {names.get(arbor.name, arbor.name): arbor.place for arbor in problem.geometry.arbors}
    coaxial = {frozenset(names.get(link, link) for link in pair) for pair in problem.coaxial}
    return replace(
        problem,
        input=whole(problem.input),
        arbors=tuple(whole(arbor) for arbor in problem.arbors if names.get(arbor.name, arbor.name) == arbor.name),
        dials=tuple(replace(dial, place=names.get(dial.place or "", dial.place)) for dial in problem.dials),
        coaxial=frozenset(pair for pair in coaxial if len(pair) > 1),
        geometry=replace(problem.geometry, arbors=tuple(PlacedArbor(*each) for each in places.items())),
    )


# what cannot be joined


def coupling_problems(evidence: Train) -> Iterator[Problem]:
    """Given couplings that hold something still, close a loop, or go over a carrier."""
    assert evidence.reconstruct is not None, "no evidence"
    bearing = {evidence.frame, evidence.reconstruct.carrier}
    for at, coupling in enumerate(evidence.couplings):
        if coupling.kind != "pin_and_slot":
            what = f"'{coupling.name}' is no pin and slot, and is not taken up by a reconstruction yet"
            fix = "leave it out, and give the speed before it"
            yield Problem(what, "only a mean ratio of 1 joins two arbors", fix, evidence.place("couplings", at))
    joined: dict[str, set[str]] = {}
    for pair, loc in _pairs(evidence):
        place = evidence.place(*loc)
        said = " and ".join(f"'{link}'" for link in pair)
        first, second = (joined.get(link, {link}) for link in pair)
        if bearing & set(pair):
            fix = "name the two arbors that it joins"
            why = "what bears the arbors does not turn with one of them"
            yield Problem(f"the coupling of {said} would hold an arbor still", why, fix, place)
        elif second & first:
            what = f"the coupling of {said} joins what is joined already"
            yield Problem(what, "given couplings join arbors to a tree", "leave it out", place)
        joined.update(dict.fromkeys(first | second, first | second))
        yield from _carried(evidence, pair, place)
    for at, gear in enumerate(evidence.gears):
        first_link, second_link = (evidence.wheels[wheel][0] for wheel in gear.pair)
        if second_link in joined.get(first_link, ()):
            what = f"'{gear.name}' was seen in mesh, and a given coupling joins its arbors"
            place = evidence.place("gears", at)
            yield Problem(what, "they would lock", "leave out the mesh or the coupling", place)


def _carried(evidence: Train, pair: tuple[str, str], place: str) -> Iterator[Problem]:
    """Joined arbors turn on what bears all: the frame, or the carrier."""
    assert evidence.reconstruct is not None, "no evidence"
    base = evidence.reconstruct.carrier or evidence.frame
    for link in pair:
        bearing = next(
            (other for joint in evidence.revolutes if link in joint.pair for other in joint.pair if other != link), base
        )
        if bearing in (base, link):
            continue
        if bearing == evidence.frame:
            what = f"'{link}' turns in the frame, and a coupling on the carrier '{base}' joins arbors on it"
            fix = f"put both on the carrier, `pair: [{base}, {link}]`"
            yield Problem(what, "else the pin would leave its slot", fix, place)
        else:
            what = f"'{link}' turns on '{bearing}', and a coupling over a carrier is not taken up by a reconstruction"
            why = f"how fast '{link}' turns depends on its carrier"
            fix = (
                f"give the arbors before and behind '{bearing}' as the pair, which turn alike, without what it carries"
            )
            yield Problem(what, why, fix, place)


def parted_problems(evidence: Train, problem: ReconstructionProblem, joined: Joined) -> Iterator[Problem]:
    """Joined links that are on different axes, where that would say which of them meshes with what.

    problem   with the links not yet joined
    """
    for name, links in joined.items():
        places = {problem.geometry.places.get(link) for link in links}
        axes = {frozenset(_beside(problem, link)) - set(links) for link in links}
        if len(places) > 1 or len(axes) > 1:
            said = " and ".join(f"'{link}'" for link in links)
            what = f"{said} are joined, but lie on different axes"
            why = "which of them an added wheel is on would have to be asked too"
            fix = f"leave out the axis of '{name}', and name wheels that do not mesh in `apart`"
            place = next(loc for pair, loc in _pairs(evidence) if name in pair)
            yield Problem(what, why, fix, evidence.place(*place))


def _beside(problem: ReconstructionProblem, link: str) -> Iterator[str]:
    """Arbors on the axis of a link."""
    for pair in problem.coaxial:
        if link in pair:
            yield from pair
