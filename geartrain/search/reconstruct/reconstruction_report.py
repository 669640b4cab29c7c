"""A reconstruction as a page: what was taken as known, how many trains explain it, and the best of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import astuple

from geartrain.numerics.exact import fraction_text
from geartrain.report.document import Document, PageExtras, SceneText, Section, Table, filled_table
from geartrain.search.reconstruct.candidate_rules import counts_text, speed_text
from geartrain.search.reconstruct.family_tree_report import family_section
from geartrain.search.reconstruct.known_trains_report import known_sections
from geartrain.search.reconstruct.reconstruction import RankedTrain, ReconstructionAnswer
from geartrain.search.reconstruct.reconstruction_facts import (
    assumptions_section,
    many,
    missing_sections,
    next_section,
    ranks_text,
    share_text,
    shared_sections,
    teeth_text,
)
from geartrain.search.reconstruct.reconstruction_problem import NEW, SearchedDial

_USE = {
    "wheels": "every surviving wheel meshes",
    "arbors": "every surviving arbor is in the train",
    "some": "surviving arbors need not be in the train",
}


_NOT_COUNTED = "not counted"
_TURNING = "A rank or an end of the family tree that is underlined shows its train turning."


def describe_reconstruction(found: ReconstructionAnswer, viewer: str = "", turning: int = 0) -> Document:
    """The page of a reconstruction; the viewer, a whole page of HTML, shows the first so many trains turning."""
    aside = PageExtras(viewer=viewer, notes=[_TURNING] if viewer else [])
    return Document(f"Trains that explain {found.name}", list(_lead(found)), list(_sections(found, turning)), aside)


def _lead(found: ReconstructionAnswer) -> Iterator[str]:
    problem, limits = found.problem, found.problem.additions
    where = "on any arbor" if limits.on == "any" else "on new arbors"
    arbors = "" if limits.arbors is None else f" and {many(limits.arbors, 'arbor')}"
    idlers = "a driven wheel may drive" if problem.idlers else "a driven wheel drives nothing"
    wheels = f"{many(limits.wheels, 'wheel')} of {limits.least} to {limits.greatest} teeth"
    added = f"at most {wheels}{arbors} may be added {where}"
    if not limits.wheels:
        added = "nothing may be added"
    yield f"Rules: {added}; {_USE[problem.use]}; {idlers}; every arbor at an end carries a pointer."
    some = next((count for count in found.counts if count.mechanisms), None)
    if some is None:
        yield f"No train explains it with {many(limits.wheels, 'added wheel')} or fewer."
    else:
        said = "1 train explains it" if found.total == 1 else f"{found.total} trains explain it"
        yield f"{said}; at least {many(some.added, 'wheel')} must be added."
    if found.original is not None:
        first, last = found.original
        rank = f"ranks {first}" if first == last else f"ranks {first} to {last}, for some weigh the same"
        yield f"The train of which arbors are left out is one of them; by weight it {rank}."
    if not found.complete:
        yield "Interrupted: the counts are of what had been looked at."
    if 0 < found.findings.listed < found.total:
        share = share_text(found.findings.share)
        listed = f"{found.findings.listed} trains of greatest weight, which have {share} of the weight of all"
        if found.findings.of_all:
            yield f"The family tree holds the {listed}; what trains share and the next fact are told of all."
        else:
            yield f"The family tree, what trains share and the next fact are of the {listed}; shares are of theirs."


def _sections(found: ReconstructionAnswer, turning: int) -> Iterator[Section]:
    yield from _given(found)
    findings = found.findings
    line = "Bags leave out the order of arbors on the path to a pointer, classes also which wheel on it drives which."
    counted = [
        tuple(_NOT_COUNTED if number is None else str(number) for number in astuple(each)) for each in found.counts
    ]
    yield Section("Counts", [line], [Table(("added wheels", "mechanisms", "bags", "classes"), counted)])
    yield from known_sections(found.known)
    yield from missing_sections(findings.missing, found.problem.additions.wheels)
    if found.best:
        yield _best(found, turning)
    if found.drawn:
        yield _drawn(found)
    yield from family_section(findings.family, turning)
    yield from shared_sections(findings.marginals)
    yield from next_section(findings.next_facts)
    yield from assumptions_section([each.mechanisms for each in found.counts], findings.assumptions)


def _given(found: ReconstructionAnswer) -> Iterator[Section]:
    """What was taken as known."""
    problem = found.problem
    rows = [
        (
            " and ".join(found.joined.get(each.name, (each.name,))),
            ", ".join(f"{wheel.name} {counts_text(wheel.counts)}{' (ring)' * wheel.internal}" for wheel in each.wheels)
            or "no wheels",
        )
        for each in (problem.input, *problem.arbors)
    ]
    couplings = [f"{' and '.join(links)} turn as one: a pin in a slot joins them." for links in found.joined.values()]
    yield Section("Surviving arbors", [_begins(found), *couplings], [Table(("arbor", "wheels"), rows)])
    pointers = [(dial.name, speed_text(dial), _place(dial)) for dial in problem.dials]
    base = found.base
    speed = f"speed seen from {base.name}" if base is not None and base.is_carrier else "speed"
    yield Section("Pointers", (), [Table(("pointer", speed, "on arbor"), pointers)])
    known = [f"{' and '.join(sorted(pair))} mesh." for pair in sorted(problem.meshes, key=sorted)]
    known += [f"{' and '.join(sorted(pair))} do not mesh." for pair in sorted(problem.apart, key=sorted)]
    if known:
        yield Section("Meshes that are known", known)
    if found.unused:
        yield Section("Not used", [f"{line[0].upper()}{line[1:]}." for line in found.unused])


def _begins(found: ReconstructionAnswer) -> str:
    """What drives the train, and what bears it."""
    base, source = found.base, found.problem.input.name
    if base is None or not base.is_carrier:
        return f"{source} is the input."
    turns, seen = fraction_text(base.speed), fraction_text(base.driven)
    return f"Arbors turn on {base.name}, a carrier that turns at {turns}. Seen from it, {source} turns at {seen}."


def _best(found: ReconstructionAnswer, turning: int) -> Section:
    rows = []
    for one in found.best:
        shown = _rank(one)
        rank = SceneText(shown, one.rank) if one.rank <= turning else shown
        added = teeth_text(one.wheels) or "none"
        rows.append((rank, share_text(one.weight), added, ", ".join(one.meshes), teeth_text(one.doubtful)))
    more = [f"{len(rows)} of {found.total}."] if len(rows) < found.total else []
    if any(one.ranks[0] < one.ranks[1] for one in found.best):
        more.append("In brackets the ranks that trains of one weight share.")
    header = ("rank", "weight", "added wheels", "meshes", "counts in doubt")
    return Section("The best", more, [filled_table(header, rows, 4)])


def _drawn(found: ReconstructionAnswer) -> Section:
    rows = [
        (
            str(one.rank),
            ranks_text(one.ranks),
            teeth_text(one.wheels) or "none",
            ", ".join(one.meshes),
            teeth_text(one.doubtful),
        )
        for one in found.drawn
    ]
    header = ("draw", "ranks", "added wheels", "meshes", "counts in doubt")
    return Section("Drawn", ["Each with the chance of its weight among all."], [filled_table(header, rows, 4)])


def _rank(one: RankedTrain) -> str:
    """The rank, with those of all that weigh the same."""
    return str(one.rank) if one.ranks[0] == one.ranks[1] else f"{one.rank} ({ranks_text(one.ranks)})"


def _place(dial: SearchedDial) -> str:
    return "any" if dial.place is None else "one that does not survive" if dial.place == NEW else dial.place
