"""Roles of declared links in a question: what bears the arbors, and which links are joined to one arbor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from geartrain.errors import Loc, Problem
from geartrain.numerics.graphs import joined_groups
from geartrain.search.reconstruct.reconstruction_problem import PlacedArbor, ReconstructionProblem, SurvivingArbor
from geartrain.train import Train

# The link that bears the arbors of a train, and the one at which the train begins: the frame and the input. Or a
# carrier of known speed. Seen from it every mesh is one of fixed axes, and the frame turns: so the frame, with the
# wheels that are fixed to it, is where the train begins, or else a link that is driven besides the carrier.


_ONLY = "seen from its carrier a train begins at one link, which is the frame unless another is driven"


@dataclass(frozen=True)
class BaseLink:
    """What bears the arbors of a train, and what drives the first of them."""

    name: str
    """The frame, or a carrier."""
    speed: Fraction
    """Of that link in the frame."""
    source: str
    """The link at which the train begins."""
    driven: Fraction
    """Speed of that link, as seen from the base."""

    @property
    def is_carrier(self) -> bool:
        """Whether it turns."""
        return bool(self.speed)

    def seen(self, relative_to: str) -> Fraction:
        """How fast the base turns, seen from a link: itself, or the frame."""
        return Fraction(0) if relative_to == self.name else self.speed


def find_base(evidence: Train) -> BaseLink:
    """The base of evidence of which `base_problems` has nothing to say."""
    inputs = evidence.case(None).inputs
    carrier = _carrier(evidence)
    if carrier is None:
        ((source, speed),) = inputs.items()
        return BaseLink(evidence.frame, Fraction(0), source, speed)
    source = next((link for link in inputs if link != carrier), evidence.frame)
    return BaseLink(carrier, inputs[carrier], source, inputs.get(source, Fraction(0)) - inputs[carrier])


def base_problems(evidence: Train) -> Iterator[Problem]:
    """What leaves it open on what the arbors turn and what drives them, or cannot be asked yet."""
    carrier = _carrier(evidence)
    if not evidence.case(None).exact:
        place = evidence.place("inputs")
        yield Problem("the speed of an input is no fraction", "speeds are exact here", "give it in the unit", place)
    elif carrier is None:
        yield from _input(evidence)
        yield from _on_the_frame(evidence)
    elif carrier == evidence.frame:
        why = "arbors turn on the frame where no carrier is named"
        yield Problem("the frame is no carrier", why, "leave `carrier` out", evidence.place("reconstruct", "carrier"))
    else:
        yield from _carrier_speed(evidence, carrier)
        yield from _carrier_wheels(evidence, carrier)
        yield from _on_the_carrier(evidence, carrier)
        yield from _carrier_pointers(evidence, carrier)
        yield from _not_with_a_carrier(evidence)


def _carrier(evidence: Train) -> str | None:
    return None if evidence.reconstruct is None else evidence.reconstruct.carrier


def _input(evidence: Train) -> Iterator[Problem]:
    inputs = evidence.case(None).inputs
    turning = [link for link, speed in inputs.items() if speed]
    if len(turning) != 1 or len(inputs) != 1:
        what = f"{len(turning)} links are driven" if len(inputs) == len(turning) else "an input stands still"
        fix = "give one, such as `inputs: {b: 1}`"
        yield Problem(what, "a reconstruction has one input that turns", fix, evidence.place("inputs"))
    frame = evidence.links.get(evidence.frame)
    if frame is not None and frame.wheels:
        what = "a wheel that stands still meshes with arbors on a carrier alone"
        fix = "name that link as `carrier`, with its speed as an input, or leave the wheel out"
        yield Problem(what, "and no carrier is named", fix, evidence.place("links", evidence.frame))


def _on_the_frame(evidence: Train) -> Iterator[Problem]:
    for at, joint in enumerate(evidence.revolutes):
        if evidence.frame not in joint.pair:
            what = "an arbor on a moving arbor is not taken up unless that is the `carrier`"
            fix = "name it as `carrier` with its speed as an input, or leave it out to ask without it"
            yield Problem(what, "it would change which trains are found", fix, evidence.place("revolutes", at))


# with a carrier


def _carrier_speed(evidence: Train, carrier: str) -> Iterator[Problem]:
    inputs = evidence.case(None).inputs
    place = evidence.place("inputs")
    others = {link: speed for link, speed in inputs.items() if link != carrier}
    if carrier not in inputs:
        what = f"the speed of the carrier '{carrier}' is not given, and one that is to be found is not taken up yet"
        fix = f"give its speed, such as `inputs: {{{carrier}: 1}}`"
        yield Problem(what, "dials are seen from the carrier", fix, evidence.place("reconstruct", "carrier"))
    elif not inputs[carrier]:
        fix = "leave `carrier` out, or give its speed"
        yield Problem(f"the carrier '{carrier}' stands still", "then it is a part of the frame", fix, place)
    if len(others) > 1:
        fix = "leave one of them out"
        yield Problem(f"{len(others)} links are driven besides the carrier", _ONLY, fix, place)
    for link, speed in others.items():
        frame = evidence.links.get(evidence.frame)
        if frame is not None and frame.wheels:
            fix = "leave the wheels of the frame out, or that input"
            yield Problem(f"'{link}' is driven, and the frame has wheels", _ONLY, fix, place)
        elif speed == inputs.get(carrier):
            what = f"'{link}' turns as fast as the carrier"
            yield Problem(what, "so it drives nothing on it", "correct one of the speeds", place)
        elif not speed:
            fix = f"leave '{link}' out, and put its wheels on the frame"
            yield Problem("an input stands still", _ONLY, fix, place)


def _carrier_wheels(evidence: Train, carrier: str) -> Iterator[Problem]:
    for name in evidence.links[carrier].wheels:
        what = f"'{name}' is a wheel of the carrier, which meshes with nothing that it carries"
        why = "seen from the carrier it stands still"
        fix = "leave it out, or ask of what it drives in evidence of its own"
        yield Problem(what, why, fix, evidence.place("links", carrier, "wheels", name))


def _on_the_carrier(evidence: Train, carrier: str) -> Iterator[Problem]:
    """Arbors turn on the carrier, or in the frame about the axis of the carrier."""
    axis = carrier_axis(evidence, carrier)
    for at, joint in enumerate(evidence.revolutes):
        place = evidence.place("revolutes", at)
        if evidence.frame in joint.pair and joint.axis != axis:
            (link,) = (link for link in joint.pair if link != evidence.frame)
            what = f"'{link}' turns in the frame, and not about the axis of the carrier"
            why = "what the carrier carries would pass by its wheels"
            own = f"[{evidence.frame}, {carrier}]"
            fix = f"put it on the carrier, `pair: [{carrier}, {link}]`, or on one axis with `{own}`"
            yield Problem(what, why, fix, place)
        elif not {evidence.frame, carrier} & set(joint.pair):
            what = "an arbor on a second moving arbor is not taken up by a reconstruction yet"
            fix = "put it on the carrier, or leave it out to ask without it"
            yield Problem(what, "one carrier is", fix, place)


def carrier_axis(evidence: Train, carrier: str) -> str | None:
    """The label of the axis about which the carrier turns, where one is declared."""
    pair = {evidence.frame, carrier}
    return next((joint.axis for joint in evidence.revolutes if set(joint.pair) == pair), None)


def _carrier_pointers(evidence: Train, carrier: str) -> Iterator[Problem]:
    for name, output in evidence.outputs.items():
        if output.of == carrier:
            fix = "leave it out, or correct `of`"
            place = evidence.place("outputs", name)
            yield Problem(f"'{name}' is on the carrier, whose speed is given", "", fix, place)


def _not_with_a_carrier(evidence: Train) -> Iterator[Problem]:
    requested = evidence.reconstruct
    assert requested is not None
    if requested.geometry is not None:
        what = "`geometry` on a carrier is not taken up by a reconstruction yet"
        fix = "leave `geometry` out to ask without it"
        yield Problem(what, "axes on a carrier move", fix, evidence.place("reconstruct", "geometry"))


# Arbors that a given coupling joins: they turn as one on average, and are one arbor in the question. The one that
# they become has the wheels and pointers of all. Each wheel stays on its own arbor when a candidate is written;
# what is added is written on the first of them.


Joined = Mapping[str, tuple[str, ...]]
"""By the name of the arbor in the question, the links that it stands for, itself first."""


def joined_arbors(evidence: Train) -> Joined:
    """What the given couplings of evidence join: called after the input, else the first link with wheels."""
    found = {}
    for links in joined_groups(evidence.links, (pair for pair, _ in _pairs(evidence))):
        if len(links) > 1:
            links.sort(key=lambda link: (link not in evidence.inputs, not evidence.links[link].wheels))
            found[links[0]] = tuple(links)
    return found


def couplings_of(evidence: Train, links: Sequence[str]) -> Iterator[dict[str, Any]]:
    """The couplings of joined links with the keys of a declaration."""
    requested = evidence.reconstruct
    for coupling in evidence.couplings:
        if coupling.pin in links:
            yield coupling.model_dump(mode="json", exclude_unset=True, by_alias=True)
    for given in () if requested is None else requested.given:
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
