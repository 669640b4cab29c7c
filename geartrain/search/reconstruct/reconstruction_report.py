"""A reconstruction as a document: what was taken as known, how many trains explain it, and the best of them.

Further sections are on known trains, on what all candidates share, on facts to look for, and on the family tree.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import astuple

from geartrain.numerics.exact import fraction_text, plural
from geartrain.report.document import Branch, Document, PageExtras, SceneText, Section, Table, cut, figure, filled_table
from geartrain.search.reconstruct.candidate_rules import counts_text, speed_text
from geartrain.search.reconstruct.dropped_facts import MISREAD, ChangedCount, LoneDial, MissingExplanation
from geartrain.search.reconstruct.explained_facts import (
    YES,
    Fact,
    FactAnswer,
    FactKind,
    FactMarginal,
    FamilyBranch,
    FamilyTrain,
    NextFact,
)
from geartrain.search.reconstruct.known_rank import (
    MAXIMUM,
    MINIMUM,
    AdmittingQuestion,
    KnownRank,
    TellingFact,
    TellingFacts,
    TrainPlace,
)
from geartrain.search.reconstruct.reconstruction import RankedTrain, ReconstructionAnswer
from geartrain.search.reconstruct.reconstruction_problem import NEW, SearchedDial

_MOST_ANSWERS = 4
_MOST_ALIKE = 2
_MOST_MESHES = 40
_MOST_NEXT = 12
_MOST_DOUBTS = 30
_MOST_SETS = 12
_MOST_BRANCHES = 60
_MOST_TRAINS = 6

_REQUESTED: dict[FactKind, str] = {
    "pair": "whether {} mesh",
    "driver": "which arbor drives {}",
    "pointer": "which arbor carries the pointer of {}",
    "count": "the count of {}",
    "added": "the count of {}, which is added",
}
_AGREED: dict[FactKind, Callable[[FactMarginal], str]] = {
    "mesh": lambda fact: fact.subject,
    "driver": lambda fact: f"{fact.answers[0].answer} drives {fact.subject}",
    "pointer": lambda fact: f"the pointer of {fact.subject} is on {fact.answers[0].answer}",
    "count": lambda fact: f"{fact.subject} has {fact.answers[0].answer} teeth",
    "added": lambda fact: f"{fact.subject} is added with {fact.answers[0].answer} teeth",
    "used": lambda fact: f"{fact.subject} is not used",
}
_FACTS = {
    "pair": "{} mesh",
    "driver": "{1} drives {0}",
    "pointer": "the pointer of {} is on {}",
    "count": "{} has {}",
    "added": "{} has {}",
    MAXIMUM: "no added wheel has more than {1}",
    MINIMUM: "no added wheel has fewer than {1}",
}
_USE = {
    "wheels": "every surviving wheel meshes",
    "arbors": "every surviving arbor is in the train",
    "some": "surviving arbors need not be in the train",
}
_NOT_COUNTED = "not counted"
_TURNING = "A rank or an end of the family tree that is underlined shows its train turning."
_OF_KNOWN = (
    "Where each train stands by weight among all that explain the evidence, and among those with as many added wheels; "
    "and how many times the best outweighs it."
)


def describe_reconstruction(found: ReconstructionAnswer, viewer: str = "", turning: int = 0) -> Document:
    """The document of a reconstruction.

    Parameters
    ----------
    found : ReconstructionAnswer
        The answer to describe.
    viewer : str
        A whole page of HTML that shows trains turning.
    turning : int
        How many of the best it shows.

    Returns
    -------
    Document

    Examples
    --------
    >>> from geartrain.search.reconstruct import ReconstructionRequest, read_evidence, reconstruct
    >>> describe_reconstruction(reconstruct(ReconstructionRequest(read_evidence("metonic-l-m")))).title
    'Trains that explain metonic-l-m'
    """
    aside = PageExtras(viewer=viewer, notes=[_TURNING] if viewer else [])
    return Document(f"Trains that explain {found.name}", list(_summary(found)), list(_sections(found, turning)), aside)


def _summary(found: ReconstructionAnswer) -> Iterator[str]:
    problem, limits = found.problem, found.problem.additions
    where = "on any arbor" if limits.on == "any" else "on new arbors"
    arbors = "" if limits.arbors is None else f" and {plural(limits.arbors, 'arbor')}"
    idlers = "a driven wheel may drive" if problem.idlers else "a driven wheel drives nothing"
    wheels = f"{plural(limits.wheels, 'wheel')} of {limits.minimum} to {limits.maximum} teeth"
    added = f"at most {wheels}{arbors} may be added {where}"
    if not limits.wheels:
        added = "nothing may be added"
    yield f"Rules: {added}; {_USE[problem.use]}; {idlers}; every arbor at an end carries a pointer."
    some = next((count for count in found.counts if count.mechanisms), None)
    if some is None:
        yield f"No train explains it with {plural(limits.wheels, 'added wheel')} or fewer."
    else:
        said = "1 train explains it" if found.total == 1 else f"{found.total} trains explain it"
        yield f"{said}; at least {plural(some.added, 'wheel')} must be added."
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
        rows.append((rank, share_text(one.weight), *_contents(one)))
    more = [f"{len(rows)} of {found.total}."] if len(rows) < found.total else []
    if any(one.ranks[0] < one.ranks[1] for one in found.best):
        more.append("In brackets the ranks that trains of one weight share.")
    return Section("The best", more, [filled_table(("rank", "weight", *_CONTENTS), rows, 4)])


def _drawn(found: ReconstructionAnswer) -> Section:
    rows = [(str(one.rank), ranks_text(one.ranks), *_contents(one)) for one in found.drawn]
    table = filled_table(("draw", "ranks", *_CONTENTS), rows, 4)
    return Section("Drawn", ["Each with the chance of its weight among all."], [table])


_CONTENTS = ("added wheels", "meshes", "counts in doubt")


def _contents(one: RankedTrain) -> tuple[str, str, str]:
    return teeth_text(one.wheels) or "none", ", ".join(one.meshes), teeth_text(one.doubtful)


def _rank(one: RankedTrain) -> str:
    """The rank, with those of all that weigh the same."""
    return str(one.rank) if one.ranks[0] == one.ranks[1] else f"{one.rank} ({ranks_text(one.ranks)})"


def _place(dial: SearchedDial) -> str:
    return "any" if dial.place is None else "one that does not survive" if dial.place == NEW else dial.place


# -------------------------------------------------------------------------------------------------------- known trains


def known_sections(known: Sequence[KnownRank]) -> Iterator[Section]:
    """Where each stands; of one that is no explanation, which rules it breaks, and what it costs without them."""
    if not known:
        return
    header = ("train", "added wheels", "arbors", "rank", "with as many", "weight", "outweighed")
    yield Section("Known trains", [_OF_KNOWN], [Table(header, [_row(one) for one in known])])
    for one in known:
        if one.broken:
            rows = dict.fromkeys((each.what, each.change or "nothing single") for each in one.broken)
            table = Table(("what it has", "what would admit it"), list(rows))
            yield Section(f"What keeps {one.train} out", [*_noted(one), *_granted(one)], [table])
        elif one.notes:
            yield Section(f"Of {one.train}", list(_noted(one)))
        if one.telling is not None and one.place is not None:
            yield _telling(one.train, one.telling, one.place.trains)


def _telling(train: str, found: TellingFacts, trains: int) -> Section:
    """Facts that single a train out, each alone and in the smallest sets."""
    many_facts = {1: "One fact", 2: "Two facts", 3: "Three facts"}
    alone = [each for each in found.facts if each.mechanisms == 1]
    lines = ["Each fact that holds in it and not in all, and how many trains it would leave."]
    tables = [Table(("fact", f"leaves of {trains}"), _left(found.facts))]
    if not found.sets:
        lines.append("No three of them leave it alone.")
    elif not alone:
        ways = plural(len(found.sets), "way")
        lines.append(
            f"{many_facts[len(found.sets[0])]} together leave it alone, in {ways}; of facts that leave the same trains "
            "one is told."
        )
        rows = [("; ".join(map(_said, some)),) for some in found.sets]
        tables.append(Table(("together they leave it alone",), cut(rows, most=_MOST_SETS)))
    return Section(f"What singles {train} out", lines, tables)


def _left(facts: Sequence[TellingFact]) -> list[tuple[str, ...]]:
    """Facts that leave as many trains in one row."""
    rows: dict[int, list[str]] = {}
    for fact in facts:
        rows.setdefault(fact.mechanisms, []).append(_said(fact))
    return [("; ".join(said), str(left)) for left, said in rows.items()]


def _said(fact: TellingFact) -> str:
    return _FACTS[fact.kind].format(fact.subject, fact.answer)


def _row(one: KnownRank) -> tuple[str, ...]:
    begins = one.train, f"{len(one.wheels)}: {teeth_text(one.wheels)}" if one.wheels else "0", str(one.arbors)
    if one.broken:
        return (*begins, "none", "none", "", "")
    if one.place is None:
        return (*begins, "not asked", "not asked", "", "")
    place = one.place
    return (
        *begins,
        _ranks(place.ranks, place.trains),
        _ranks(place.ranks_alike, place.trains_alike),
        share_text(place.weight),
        _times(place),
    )


def _ranks(ranks: tuple[int, int], trains: int) -> str:
    return f"{ranks_text(ranks)} of {trains}"


def _times(place: TrainPlace) -> str:
    return "by none" if place.dearer == 1 else f"{figure(place.dearer)} times"


def _noted(one: KnownRank) -> Iterator[str]:
    yield from (f"{note}." for note in one.notes)


def _granted(one: KnownRank) -> Iterator[str]:
    """What a train costs in each question that takes it."""
    all_that = tuple(dict.fromkeys(each.change for each in one.broken))
    for admitted in one.admitted:
        changes = "all of this" if admitted.changes == all_that else "; ".join(admitted.changes)
        yield _cost(changes, admitted)


def _cost(changes: str, admitted: AdmittingQuestion) -> str:
    own = plural(len(admitted.wheels), "wheel") + (f" ({teeth_text(admitted.wheels)})" if admitted.wheels else "")
    begins = f"Granted {changes}, it adds {own}"
    if admitted.refused is not None:
        return f"{begins}. Not asked: {admitted.refused}."
    told = [f"{number} with {added}" for added, number in enumerate(admitted.mechanisms) if number]
    if admitted.place is None:
        trains = f"trains are {', '.join(told)}" if told else "there is no train"
        return f"{begins}, and with at most {plural(admitted.requested, 'wheel')} {trains}."
    place = admitted.place
    outweighed = "none outweighs it" if place.dearer == 1 else f"the best outweighs it {_times(place)}"
    return (
        f"{begins}. Trains by added wheels: {', '.join(told)}. It ranks {_ranks(place.ranks, place.trains)}, and "
        f"{_ranks(place.ranks_alike, place.trains_alike)} with as many; {outweighed}."
    )


# ----------------------------------------------- what candidates share and where they part, the next fact, assumptions


def shared_sections(marginals: Sequence[FactMarginal]) -> Iterator[Section]:
    """What all candidates agree in, and the weight of each answer where they do not."""
    if not marginals or marginals[0].trains < 2:
        return
    agreed = list(_agreed(marginals))
    yield Section("What all of them share", agreed or ["Nothing: there is no fact in which all of them agree."])
    parted = [fact for fact in marginals if len(fact.answers) > 1]
    tables = [table for table in (_meshes(parted), _answers(parted), _needed(parted)) if table.rows]
    if tables:
        line = "Each answer with its share of the weight, and in how many trains it is given."
        yield Section("Where they part", [line], tables)


def _agreed(marginals: Sequence[FactMarginal]) -> Iterator[str]:
    sure = [fact for fact in marginals if len(fact.answers) == 1]
    meshes = [fact.subject for fact in sure if fact.kind == "mesh"]
    if meshes:
        yield f"In all of them: {', '.join(meshes)}."
    needed = [fact.subject for fact in sure if fact.kind == "needed"]
    yield from (f"A wheel of {count} is needed in all." for count in needed)
    others = [_AGREED[fact.kind](fact) for fact in sure if fact.kind not in ("mesh", "needed", "driver")]
    if others:
        yield f"{'Besides' if meshes or needed else 'In all of them'}: {'; '.join(others)}."


def _meshes(facts: Sequence[FactMarginal]) -> Table:
    return _yes_table("mesh", [fact for fact in facts if fact.kind == "mesh"])


def _needed(facts: Sequence[FactMarginal]) -> Table:
    return _yes_table("an added wheel of", [fact for fact in facts if fact.kind == "needed"])


def _yes_table(title: str, facts: Sequence[FactMarginal]) -> Table:
    rows = [
        (fact.subject, share_text(float(answer.share)), str(answer.mechanisms))
        for fact in facts
        for answer in fact.answers
        if answer.answer == YES
    ]
    return Table((title, "weight", "trains"), cut(rows, most=_MOST_MESHES))


def _answers(facts: Sequence[FactMarginal]) -> Table:
    named = {**_REQUESTED, "used": "whether {} is used"}
    rows = [
        (named[fact.kind].format(fact.subject), _told(fact.answers), figure(fact.bits, 3))
        for fact in facts
        if fact.kind in named
    ]
    return Table(("fact", "answers", "bits"), cut(rows) if rows else rows)


def _told(answers: Sequence[FactAnswer]) -> str:
    told = [f"{one.answer}: {share_text(float(one.share))} ({one.mechanisms})" for one in answers[:_MOST_ANSWERS]]
    if len(answers) > _MOST_ANSWERS:
        rest = answers[_MOST_ANSWERS:]
        told.append(f"{len(rest)} more: {share_text(float(sum(one.share for one in rest)))}")
    return ", ".join(told)


def next_section(facts: Sequence[NextFact]) -> Iterator[Section]:
    """Facts to look for, the most telling first."""
    if not facts:
        return
    rows = [
        (_requested(one.fact), figure(one.fact.bits, 3), _told(one.fact.answers), _alike(one.same))
        for one in facts[:_MOST_NEXT]
    ]
    lines = [
        "What single further fact would divide them most. `bits` is what its answer is expected to tell: the entropy "
        "of the shares that the answers would leave."
    ]
    if len(facts) > _MOST_NEXT:
        lines.append(f"{_MOST_NEXT} of {len(facts)}.")
    header = ("fact", "bits", "what each answer would leave", "divides them alike")
    yield Section("The next fact to look for", lines, [Table(header, rows)])


def _requested(fact: FactMarginal | Fact) -> str:
    return _REQUESTED[fact.kind].format(fact.subject)


def _alike(facts: Sequence[Fact]) -> str:
    told = [_requested(fact) for fact in facts[:_MOST_ALIKE]]
    return "; ".join(told) + (f" and {len(facts) - _MOST_ALIKE} more" if len(facts) > _MOST_ALIKE else "")


def assumptions_section(given: Sequence[int], changes: Sequence[ChangedCount]) -> Iterator[Section]:
    """How many trains there would be without each hard fact; `given` are the counts with all of them."""
    if not changes:
        return
    header = ("assumption", *(f"{added} added" for added in range(len(given))), "trains")
    rows = [("all that is given", *map(str, given), str(sum(given)))]
    for one in changes:
        counts = [str(count) for count in one.mechanisms] or ["-"] * len(given)
        total = one.refused or f"{one.total}{'' if one.complete else ' or more'}"
        rows.append((one.change, *counts, total))
    line = "How many trains there would be if one thing were not known, or not ruled out: what each has carried."
    yield Section("Assumptions that carried weight", [line], [Table(header, rows)])


def missing_sections(found: MissingExplanation | None, most: int) -> Iterator[Section]:
    """Why nothing fits; `most` wheels may be added."""
    if found is None:
        return
    line = "Each dial alone, by whatever of the surviving arbors leads to it; the others then need not be used."
    rows = [(dial.dial, _alone(dial, most)) for dial in found.dials]
    yield Section("Why nothing fits", [line], [Table(("dial", "alone"), rows)])
    doubts = [(one.change, str(one.fewest), str(one.total)) for one in found.doubts]
    tried = (
        f"{plural(found.requested, 'change')} to the evidence tried, one at a time: a hard fact "
        f"dropped, or a surviving "
        f"count read otherwise by up to {plural(MISREAD, 'tooth').replace('tooths', 'teeth')}."
    )
    lines = [tried] if doubts else [tried, "None of them alone leaves an explanation."]
    if found.refused:
        lines.append(f"Could not be asked: {'; '.join(found.refused)}.")
    header = ("what is doubted", "added wheels", "trains")
    tables = [Table(header, cut(doubts, most=_MOST_DOUBTS))] if doubts else []
    yield Section("The cheapest evidence to doubt", lines, tables)


def _alone(dial: LoneDial, most: int) -> str:
    if dial.refused is not None:
        return dial.refused
    if dial.fewest is None:
        return f"fails: no train with {plural(most, 'added wheel')} or fewer"
    return f"explained with {plural(dial.fewest, 'added wheel')}"


# ----------------------------------------------------------------------------------------------------- the family tree


def family_section(tree: Sequence[FamilyBranch], turning: int = 0) -> Iterator[Section]:
    """The tree; the first so many trains turn on the page."""
    if not tree:
        return
    shown = set(sorted(range(len(tree)), key=lambda at: -tree[at].share)[:_MOST_BRANCHES])
    below: dict[int, list[int]] = {}
    for at, branch in enumerate(tree):
        if branch.parent is not None:
            below.setdefault(branch.parent, []).append(at)

    def lines(places: Sequence[int]) -> Iterator[Branch]:
        for at in places:
            if at in shown:
                yield _branch(tree[at], turning, list(lines(below.get(at, []))))
        left = [tree[at] for at in places if at not in shown]
        if left:
            share = share_text(float(sum(branch.share for branch in left)))
            trains = plural(sum(branch.mechanisms for branch in left), "train")
            yield Branch(f"{plural(len(left), 'lighter branch').replace('branchs', 'branches')}: {share}, {trains}")

    said = [
        "Meshes from the input on, the driving wheel first, along the path to each pointer in turn; a pointer stands "
        "in brackets at its arbor. Each branch has its share of the weight. Trains at one end differ in counts alone."
    ]
    yield Section("The family tree", said, branches=list(lines([0])))


def _branch(branch: FamilyBranch, turning: int, below: Sequence[Branch]) -> Branch:
    meshes = ", ".join(branch.meshes) or "the input"
    share, trains = share_text(float(branch.share)), branch.trains
    if len(trains) == 1 and not below:
        return Branch(_scene(f"{meshes}: {share}, {_train(trains[0])}", trains[0].rank, turning))
    ends = [
        Branch(_scene(f"{share_text(float(train.share))}, {_train(train)}", train.rank, turning))
        for train in trains[:_MOST_TRAINS]
    ]
    if len(trains) > _MOST_TRAINS:
        ends.append(Branch(f"{len(trains) - _MOST_TRAINS} more"))
    return Branch(f"{meshes}: {share}, {plural(branch.mechanisms, 'train')}", [*ends, *below])


def _train(train: FamilyTrain) -> str:
    counts = ", ".join(f"{wheel} {teeth}" for wheel, teeth in train.counts.items())
    return f"rank {train.rank}" + (f" with {counts}" if counts else "")


def _scene(text: str, rank: int, turning: int) -> str:
    return SceneText(text, rank) if rank <= turning else text


# --------------------------------------------------------------------------------------------------------------- words


def share_text(share: float) -> str:
    """A share of the weight, as a page tells it."""
    return f"{100 * share:.3g} %"


def teeth_text(wheels: Mapping[str, int]) -> str:
    """Wheels with their counts: `m1 96, n1 53`."""
    return ", ".join(f"{name} {teeth}" for name, teeth in wheels.items())


def ranks_text(ranks: tuple[int, int]) -> str:
    """`3`, or `1-4` of trains that weigh the same."""
    first, last = ranks
    return str(first) if first == last else f"{first}-{last}"
