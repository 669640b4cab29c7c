"""Roles of declared links in a reconstruction: the link that carries the arbors, and links that together form one
arbor.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from geartrain.errors import Loc, Problem
from geartrain.numerics.graphs import joined_groups
from geartrain.search.reconstruct.reconstruction_problem import PlacedArbor, ReconstructionProblem, SurvivingArbor
from geartrain.train import Train

# The link that carries the arbors, and the link at which the train begins: the frame and the input, or a carrier of
# known speed. Relative to the carrier every mesh has fixed axes, and the frame turns. The train then begins at the
# frame with its fixed wheels, or at a link that is driven besides the carrier.


_ONE_START = "a train on a carrier begins at one link: the frame, or one other driven link"


@dataclass(frozen=True)
class BaseLink:
    """Base of a reconstruction, which is the link that carries the arbors, and input link of the train."""

    name: str
    """Name of the base, which is the frame or a carrier."""
    speed: Fraction
    """Speed of the base relative to the frame [turns per unit]."""
    source: str
    """Name of the input link of the train."""
    driven: Fraction
    """Speed of the input link `source` relative to the base [turns per unit]."""

    @property
    def is_carrier(self) -> bool:
        """True if the base is a carrier; False if it is the frame."""
        return bool(self.speed)

    def seen(self, relative_to: str) -> Fraction:
        """Return the speed of the base relative to the link `relative_to`, which is the base itself or the frame [turns
        per unit].
        """
        return Fraction(0) if relative_to == self.name else self.speed


def find_base(evidence: Train) -> BaseLink:
    """Return the link that carries the arbors of a reconstruction, with its speed, and the input link of the train.

    The evidence must be valid, that is, `base_problems` must not yield an error message.
    """
    inputs = evidence.case(None).inputs
    carrier = _carrier(evidence)
    if carrier is None:
        ((source, speed),) = inputs.items()
        return BaseLink(evidence.frame, Fraction(0), source, speed)
    source = next((link for link in inputs if link != carrier), evidence.frame)
    return BaseLink(carrier, inputs[carrier], source, inputs.get(source, Fraction(0)) - inputs[carrier])


def base_problems(evidence: Train) -> Iterator[Problem]:
    """Yield an error message for each declaration that is not supported, or that leaves open which link carries the
    arbors or which link is the input.
    """
    carrier = _carrier(evidence)
    if not evidence.case(None).exact:
        place = evidence.place("inputs")
        fix = "give the speed as a fraction in the train's unit of speed, such as `1/19`"
        yield Problem("the speed of an input is not a fraction", "a reconstruction needs exact speeds", fix, place)
    elif carrier is None:
        yield from _frame_problems(evidence)
    elif carrier == evidence.frame:
        why = "arbors turn on the frame if no carrier is named"
        fix = f"delete `carrier: {carrier}`"
        yield Problem("the frame is not a carrier", why, fix, evidence.place("reconstruct", "carrier"))
    else:
        yield from _carrier_speed_problems(evidence, carrier)
        yield from _carrier_part_problems(evidence, carrier)


def _carrier(evidence: Train) -> str | None:
    return None if evidence.reconstruct is None else evidence.reconstruct.carrier


def _frame_problems(evidence: Train) -> Iterator[Problem]:
    """Yield an error message for each unsupported declaration of evidence in which arbors turn on the frame."""
    inputs = evidence.case(None).inputs
    turning = [link for link, speed in inputs.items() if speed]
    if len(turning) != 1 or len(inputs) != 1:
        what = f"{len(turning)} links are driven" if len(inputs) == len(turning) else "the speed of an input is 0"
        why = "a reconstruction needs exactly one input, with a speed other than 0"
        yield Problem(what, why, "give one, such as `inputs: {b: 1}`", evidence.place("inputs"))
    frame = evidence.links.get(evidence.frame)
    if frame is not None and frame.wheels:
        what = "the frame has wheels, but no carrier is named"
        why = "a fixed wheel meshes only with arbors on a carrier"
        fix = "name the carrier as `carrier`, with its speed as an input, or remove the wheels of the frame"
        yield Problem(what, why, fix, evidence.place("links", evidence.frame))
    for at, joint in enumerate(evidence.revolutes):
        if evidence.frame not in joint.pair:
            one, other = joint.pair
            what = f"an arbor turns on a moving link: the turning pair of '{one}' and '{other}' omits the frame"
            why = "arbors on a moving link are reconstructed only if this link is the `carrier`"
            fix = "name the link as `carrier` with its speed as an input, or remove the turning pair"
            yield Problem(what, why, fix, evidence.place("revolutes", at))


# with a carrier


def _carrier_speed_problems(evidence: Train, carrier: str) -> Iterator[Problem]:
    inputs = evidence.case(None).inputs
    place = evidence.place("inputs")
    others = {link: speed for link, speed in inputs.items() if link != carrier}
    if carrier not in inputs:
        what = f"the speed of the carrier '{carrier}' is not given"
        why = "the speeds of dials are converted to speeds relative to the carrier"
        fix = f"give its speed, such as `inputs: {{{carrier}: 1}}`"
        yield Problem(what, why, fix, evidence.place("reconstruct", "carrier"))
    elif not inputs[carrier]:
        fix = "delete `carrier`, or correct its speed"
        yield Problem(f"the speed of the carrier '{carrier}' is 0", "a fixed carrier is part of the frame", fix, place)
    if len(others) > 1:
        fix = "remove all but one of them from `inputs`"
        yield Problem(f"{len(others)} links are driven besides the carrier", _ONE_START, fix, place)
    for link, speed in others.items():
        frame = evidence.links.get(evidence.frame)
        if frame is not None and frame.wheels:
            fix = f"remove the wheels of the frame, or remove '{link}' from `inputs`"
            yield Problem(f"'{link}' is driven, and the frame has wheels", _ONE_START, fix, place)
        elif speed == inputs.get(carrier):
            what = f"'{link}' has the same speed as the carrier"
            why = "a link that turns with the carrier cannot drive arbors on the carrier"
            yield Problem(what, why, "correct one of the two speeds in `inputs`", place)
        elif not speed:
            fix = f"remove '{link}' from `inputs`, and put its wheels on the frame"
            yield Problem(f"the speed of the input '{link}' is 0", _ONE_START, fix, place)


def _carrier_part_problems(evidence: Train, carrier: str) -> Iterator[Problem]:
    """Yield an error message for each wheel and pointer of the carrier, for each arbor that turns neither on the
    carrier nor about its axis in the frame, and for measured sizes.
    """
    for name in evidence.links[carrier].wheels:
        what = f"'{name}' is a wheel of the carrier"
        why = "a link that turns with the carrier cannot drive arbors on the carrier"
        fix = "remove it, or describe the arbors that it drives in separate evidence"
        yield Problem(what, why, fix, evidence.place("links", carrier, "wheels", name))
    axis = carrier_axis(evidence, carrier)
    for at, joint in enumerate(evidence.revolutes):
        place = evidence.place("revolutes", at)
        if evidence.frame in joint.pair and joint.axis != axis:
            (link,) = (link for link in joint.pair if link != evidence.frame)
            what = f"'{link}' turns in the frame, but not about the axis of the carrier"
            why = "arbors on the carrier would move past its wheels"
            own = f"[{evidence.frame}, {carrier}]"
            fix = f"put it on the carrier, `pair: [{carrier}, {link}]`, or on the axis of `{own}`"
            yield Problem(what, why, fix, place)
        elif not {evidence.frame, carrier} & set(joint.pair):
            one, other = joint.pair
            what = f"the turning pair of '{one}' and '{other}' is on a second moving link"
            fix = f"put the arbor on the carrier '{carrier}', or remove the turning pair"
            yield Problem(what, "a reconstruction supports one carrier", fix, place)
    for name, output in evidence.outputs.items():
        if output.of == carrier:
            what, why = f"the pointer '{name}' is on the carrier", "the speed of the carrier is already an input"
            place = evidence.place("outputs", name)
            yield Problem(what, why, "remove the output, or correct its `of`", place)
    if evidence.reconstruct is not None and evidence.reconstruct.geometry is not None:
        what, place = "`geometry` is not supported for arbors on a carrier", evidence.place("reconstruct", "geometry")
        yield Problem(
            what, "measured centre distances can be checked only if all axes are fixed", "delete `geometry`", place
        )


def carrier_axis(evidence: Train, carrier: str) -> str | None:
    """Return the label of the declared axis about which the carrier turns; None if the axis is not declared."""
    pair = {evidence.frame, carrier}
    return next((joint.axis for joint in evidence.revolutes if set(joint.pair) == pair), None)


# Arbors that a given coupling joins: they have the same mean speed, and are one arbor in the problem, with the wheels
# and pointers of all. When a candidate is written, each wheel remains on its own link, and added wheels are on the
# first link.


Joined = Mapping[str, tuple[str, ...]]
"""Links that form each arbor of the problem, keyed by arbor. The link with the name of the arbor comes first."""


def joined_arbors(evidence: Train) -> Joined:
    """Return the groups of links that declared couplings connect so that they form one arbor.

    A group is named after the input link if it contains this link. If it does not, the group is named after its first
    link with wheels.
    """
    found = {}
    for links in joined_groups(evidence.links, (pair for pair, _ in _pairs(evidence))):
        if len(links) > 1:
            links.sort(key=lambda link: (link not in evidence.inputs, not evidence.links[link].wheels))
            found[links[0]] = tuple(links)
    return found


def couplings_of(evidence: Train, links: Sequence[str]) -> Iterator[dict[str, Any]]:
    """Yield the couplings whose pin is on one of the links, in the format of a declaration."""
    requested = evidence.reconstruct
    for coupling in evidence.pin_couplings:
        if coupling.pin in links:
            yield coupling.model_dump(mode="json", exclude_unset=True, by_alias=True)
    for given in () if requested is None else requested.given:
        if given.pair[0] in links:
            yield {"kind": given.kind, "pin": given.pair[0], "slot": given.pair[1]}


def _pairs(evidence: Train) -> Iterator[tuple[tuple[str, str], Loc]]:
    assert evidence.reconstruct is not None, "no evidence"
    for at, coupling in enumerate(evidence.pin_couplings):
        yield (coupling.pin, coupling.slot), ("couplings", at)
    for at, given in enumerate(evidence.reconstruct.given):
        yield given.pair, ("reconstruct", "given", at)


def join_arbors(problem: ReconstructionProblem, joined: Joined) -> ReconstructionProblem:
    """Return the problem in which the links of each group form one arbor."""
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


# links that cannot be joined


def coupling_problems(evidence: Train) -> Iterator[Problem]:
    """Yield an error message for each declared coupling that locks an arbor, closes a loop, or connects links across a
    carrier.
    """
    assert evidence.reconstruct is not None, "no evidence"
    bearing = {evidence.frame, evidence.reconstruct.carrier}
    for at, coupling in enumerate(evidence.couplings):
        if coupling.kind != "pin_and_slot":
            what = f"the coupling '{coupling.name}' is not a pin and slot"
            why = "a reconstruction supports only couplings with a mean ratio of 1"
            fix = "remove it, and give the speed of the arbor that drives it"
            yield Problem(what, why, fix, evidence.place("couplings", at))
    joined: dict[str, set[str]] = {}
    for pair, loc in _pairs(evidence):
        place = evidence.place(*loc)
        said = " and ".join(f"'{link}'" for link in pair)
        first, second = (joined.get(link, {link}) for link in pair)
        if bearing & set(pair):
            fix = "name the two arbors that it connects"
            why = "the frame and the carrier do not turn with an arbor"
            yield Problem(f"the coupling of {said} would lock an arbor", why, fix, place)
        elif second & first:
            what = f"the coupling of {said} connects arbors that are already connected"
            yield Problem(what, "given couplings must form a tree of arbors", "remove the coupling", place)
        joined.update(dict.fromkeys(first | second, first | second))
        yield from _bearing_problems(evidence, pair, place)
    for at, gear in enumerate(evidence.gears):
        first_link, second_link = (evidence.wheels[wheel][0] for wheel in gear.pair)
        if second_link in joined.get(first_link, ()):
            what = f"the arbors of the known mesh '{gear.name}' are connected by a coupling"
            why, fix = "a mesh and a coupling of two arbors lock them", "remove the mesh or the coupling"
            yield Problem(what, why, fix, evidence.place("gears", at))


def _bearing_problems(evidence: Train, pair: tuple[str, str], place: str) -> Iterator[Problem]:
    """Yield an error message for each of two coupled links that does not turn on the base, which is the frame or the
    carrier.
    """
    assert evidence.reconstruct is not None, "no evidence"
    base = evidence.reconstruct.carrier or evidence.frame
    for link in pair:
        bearing = next(
            (other for joint in evidence.revolutes if link in joint.pair for other in joint.pair if other != link), base
        )
        if bearing in (base, link):
            continue
        if bearing == evidence.frame:
            what = f"'{link}' turns in the frame, but its coupling is on the carrier '{base}'"
            fix = f"put both on the carrier, `pair: [{base}, {link}]`"
            yield Problem(what, "the pin would leave its slot when the carrier turns", fix, place)
        else:
            what = f"the coupling of '{link}', which turns on '{bearing}', crosses a carrier"
            why = f"the speed of '{link}' depends on its carrier"
            fix = (
                f"connect the arbors before and after '{bearing}', which have the same mean speed, and remove the "
                "arbors on it"
            )
            yield Problem(what, why, fix, place)


def parted_problems(evidence: Train, problem: ReconstructionProblem, joined: Joined) -> Iterator[Problem]:
    """Yield an error message for each group of coupled links that are on different axes. Such links are not supported,
    because each axis would exclude different meshes.

    problem   reconstruction problem in which the links are not yet joined
    """
    for name, links in joined.items():
        places = {problem.geometry.places.get(link) for link in links}
        axes = {frozenset().union(*(pair for pair in problem.coaxial if link in pair)) - set(links) for link in links}
        if len(places) > 1 or len(axes) > 1:
            said = " and ".join(f"'{link}'" for link in links)
            what = f"{said} are connected, but are on different axes"
            why = "the arbor of an added wheel would be ambiguous"
            fix = f"remove the axis of '{name}', and list in `apart` the pairs of wheels that do not mesh"
            place = next(loc for pair, loc in _pairs(evidence) if name in pair)
            yield Problem(what, why, fix, evidence.place(*place))
