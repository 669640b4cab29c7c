"""Report of a reconstruction: the evidence, the number of trains consistent with it, and the best-ranked trains.

Further sections describe known trains, facts common to all candidates, facts to observe next, and the family tree.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple

from geartrain.numerics.exact import fraction_text, plural
from geartrain.report.document import Branch, Document, PageExtras, SceneText, Section, Table, cut, figure, filled_table
from geartrain.search.reconstruct.candidate_rules import counts_text, speed_text
from geartrain.search.reconstruct.dropped_facts import MISREAD, ChangedCount, MissingExplanation
from geartrain.search.reconstruct.explained_facts import (
    YES,
    Fact,
    FactAnswer,
    FactKind,
    FactMarginal,
    FamilyBranch,
    NextFact,
)
from geartrain.search.reconstruct.known_rank import KnownRank
from geartrain.search.reconstruct.reconstruction import ReconstructionAnswer
from geartrain.search.reconstruct.reconstruction_problem import NEW

_MOST_ANSWERS = 4
_MOST_ALIKE = 2
_MOST_MESHES = 40
_MOST_NEXT = 12
_MOST_UNCERTAINTIES = 30
_MOST_BRANCHES = 60
_MOST_TRAINS = 6

_REQUESTED: dict[FactKind, str] = {
    "pair": "whether {} mesh",
    "driver": "which arbor drives {}",
    "pointer": "which arbor carries the pointer of {}",
    "count": "the count of {}",
    "added": "the count of {}, which is added",
}
_FACTS: dict[FactKind, str] = {
    "pair": "{0} mesh",
    "driver": "{1} drives {0}",
    "pointer": "the pointer of {0} is on {1}",
    "count": "{0} has {1} teeth",
    "added": "{0} is added with {1} teeth",
    "used": "{0} is not used",
}
_USE = {
    "wheels": "every surviving wheel meshes",
    "arbors": "every surviving arbor is in the train",
    "some": "surviving arbors need not be in the train",
}
_NOT_COUNTED = "not counted"
_TURNING = "An underlined rank or end of the family tree shows its animated train."
_OF_KNOWN = (
    "Rank of each train by weight among all explanations, and among the explanations with an equal number of added "
    "wheels. The last column is the weight of the best train divided by the weight of this train."
)


def describe_reconstruction(found: ReconstructionAnswer, viewer: str = "", turning: int = 0) -> Document:
    """Return the report of a reconstruction as a document."""
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
    some = next((count for count in found.counts if count.solutions), None)
    if some is None:
        yield f"No train with at most {plural(limits.wheels, 'added wheel')} explains the evidence."
    else:
        said = "1 train explains" if found.total == 1 else f"{found.total} trains explain"
        yield f"{said} the evidence; at least {plural(some.added, 'wheel')} must be added."
    if found.original is not None:
        first, last = found.original
        rank = f"rank {first}" if first == last else f"ranks {first} to {last}, which have equal weights"
        yield f"The original train is one of them; by weight it has {rank}."
    if not found.complete:
        yield "Interrupted: the counts cover only the completed part of the search."
    if 0 < found.findings.listed < found.total:
        share = share_text(found.findings.share)
        listed = f"{found.findings.listed} trains of maximum weight, with {share} of the total weight"
        if found.findings.of_all:
            yield f"The family tree contains the {listed}. Common facts and the next fact are computed over all trains."
        else:
            yield f"The family tree, common facts and the next fact cover the {listed}. Shares are relative to them."


def _sections(found: ReconstructionAnswer, turning: int) -> Iterator[Section]:
    yield from _given(found)
    findings = found.findings
    line = (
        "Multisets ignore the order of arbors on the path to a pointer; classes (of equal ratios) also ignore which "
        "wheel on it drives which."
    )
    counted = [
        tuple(_NOT_COUNTED if number is None else str(number) for number in astuple(each)) for each in found.counts
    ]
    yield Section("Counts", [line], [Table(("added wheels", "trains", "multisets", "classes"), counted)])
    yield from known_sections(found.known)
    yield from missing_sections(findings.missing, found.problem.additions.wheels)
    if found.best:
        yield _best(found, turning)
    yield from family_section(findings.family, turning)
    yield from shared_sections(findings.marginals)
    yield from next_section(findings.next_facts)
    yield from assumptions_section([each.solutions for each in found.counts], findings.assumptions)


def _given(found: ReconstructionAnswer) -> Iterator[Section]:
    problem = found.problem
    rows = [
        (
            " and ".join(found.joined.get(each.name, (each.name,))),
            ", ".join(f"{wheel.name} {counts_text(wheel.counts)}{' (ring)' * wheel.internal}" for wheel in each.wheels)
            or "no wheels",
        )
        for each in (problem.input, *problem.arbors)
    ]
    couplings = [
        f"{' and '.join(links)} are joined by a pin and slot: they have the same mean speed."
        for links in found.joined.values()
    ]
    base, source, speed = found.base, problem.input.name, "speed"
    start = f"{source} is the input."
    if base is not None and base.is_carrier:
        start = (
            f"Arbors turn on the carrier {base.name}, whose speed is {fraction_text(base.speed)}. "
            f"The speed of {source} relative to it is {fraction_text(base.driven)}."
        )
        speed = f"speed relative to {base.name}"
    yield Section("Surviving arbors", [start, *couplings], [Table(("arbor", "wheels"), rows)])
    pointers = [
        (dial.name, speed_text(dial), "one that does not survive" if dial.place == NEW else dial.place or "any")
        for dial in problem.dials
    ]
    yield Section("Pointers", (), [Table(("pointer", speed, "on arbor"), pointers)])
    known = [f"{' and '.join(sorted(pair))} mesh." for pair in sorted(problem.meshes, key=sorted)]
    known += [f"{' and '.join(sorted(pair))} do not mesh." for pair in sorted(problem.apart, key=sorted)]
    if known:
        yield Section("Known meshes", known)
    if found.unused:
        yield Section("Not used", [f"{line[0].upper()}{line[1:]}." for line in found.unused])


def _best(found: ReconstructionAnswer, turning: int) -> Section:
    rows = []
    for one in found.best:
        rank = str(one.rank) if one.ranks[0] == one.ranks[1] else f"{one.rank} ({ranks_text(one.ranks)})"
        added, doubtful = teeth_text(one.wheels) or "none", teeth_text(one.doubtful)
        rows.append((_scene(rank, one.rank, turning), share_text(one.weight), added, ", ".join(one.meshes), doubtful))
    more = [f"{len(rows)} of {found.total} trains."] if len(rows) < found.total else []
    if any(one.ranks[0] < one.ranks[1] for one in found.best):
        more.append("Parentheses give the ranks that trains of equal weight share.")
    header = ("rank", "weight", "added wheels", "meshes", "uncertain counts")
    return Section("Most probable trains", more, [filled_table(header, rows, 4)])


# -------------------------------------------------------------------------------------------------------- known trains


def known_sections(known: Sequence[KnownRank]) -> Iterator[Section]:
    """Yield sections on the ranks of known trains and the rules that they break."""
    if not known:
        return
    header = ("train", "added wheels", "added arbors", "rank", "rank, equal wheels", "weight", "maximum / weight")
    yield Section("Known trains", [_OF_KNOWN], [Table(header, [_row(one) for one in known])])
    for one in known:
        notes = [f"{note}." for note in one.notes]
        if one.broken:
            rows = dict.fromkeys((each.what, each.change or "no single change") for each in one.broken)
            table = Table(("property of the train", "change that would admit it"), list(rows))
            yield Section(f"Rules that {one.train} breaks", notes, [table])
        elif notes:
            yield Section(f"Notes on {one.train}", notes)
        if one.telling and one.place is not None:
            line = "Facts that are true of this train but not of all, with the number of trains that each would leave."
            said: dict[int, list[str]] = {}
            for fact in one.telling:
                said.setdefault(fact.solutions, []).append(_FACTS[fact.kind].format(fact.subject, fact.answer))
            table = Table(
                ("fact", f"left of {one.place.trains}"), [("; ".join(some), str(left)) for left, some in said.items()]
            )
            yield Section(f"Facts that distinguish {one.train}", [line], [table])


def _row(one: KnownRank) -> tuple[str, ...]:
    begins = one.train, f"{len(one.wheels)}: {teeth_text(one.wheels)}" if one.wheels else "0", str(one.arbors)
    place = one.place
    if one.broken or place is None:
        ranks = "none" if one.broken else "not searched"
        return (*begins, ranks, ranks, "", "")
    among_all = f"{ranks_text(place.ranks)} of {place.trains}"
    among_alike = f"{ranks_text(place.ranks_alike)} of {place.trains_alike}"
    return (*begins, among_all, among_alike, share_text(place.weight), figure(place.dearer))


# ---------------------------------------- facts common to all candidates, facts that differ, the next fact, assumptions


def shared_sections(marginals: Sequence[FactMarginal]) -> Iterator[Section]:
    """Yield sections on facts common to all candidates, and on the probabilities of facts that differ between
    candidates.
    """
    if not marginals or marginals[0].trains < 2:
        return
    agreed = list(_agreed(marginals))
    yield Section("Facts common to all trains", agreed or ["No fact is common to all trains."])
    parted = [fact for fact in marginals if len(fact.answers) > 1]
    meshes, needed = _yes_table("mesh", "mesh", parted), _yes_table("an added wheel of", "needed", parted)
    tables = [table for table in (meshes, _answers(parted), needed) if table.rows]
    if tables:
        line = "Each answer with its share of the weight and its number of trains."
        yield Section("Facts that differ", [line], tables)


def _agreed(marginals: Sequence[FactMarginal]) -> Iterator[str]:
    sure = [fact for fact in marginals if len(fact.answers) == 1]
    meshes = [fact.subject for fact in sure if fact.kind == "mesh"]
    if meshes:
        yield f"Meshes: {', '.join(meshes)}."
    needed = [fact.subject for fact in sure if fact.kind == "needed"]
    yield from (f"All trains add a wheel of {count}." for count in needed)
    others = [
        _FACTS[fact.kind].format(fact.subject, fact.answers[0].answer)
        for fact in sure
        if fact.kind not in ("mesh", "needed", "driver")
    ]
    if others:
        yield f"{'Further facts' if meshes or needed else 'Facts'}: {'; '.join(others)}."


def _yes_table(title: str, kind: FactKind, facts: Sequence[FactMarginal]) -> Table:
    """Return the table of the facts of one kind that are true in some trains, each with the total probability and the
    number of these trains.
    """
    rows = [
        (fact.subject, share_text(float(answer.share)), str(answer.solutions))
        for fact in facts
        for answer in fact.answers
        if fact.kind == kind and answer.answer == YES
    ]
    return Table((title, "weight", "trains"), cut(rows, most=_MOST_MESHES))


def _answers(facts: Sequence[FactMarginal]) -> Table:
    named = {**_REQUESTED, "used": "whether {} is used"}
    rows = [
        (named[fact.kind].format(fact.subject), _answers_text(fact.answers), figure(fact.bits, 3))
        for fact in facts
        if fact.kind in named
    ]
    return Table(("fact", "answers", "bits"), cut(rows) if rows else rows)


def _answers_text(answers: Sequence[FactAnswer]) -> str:
    listed = [f"{one.answer}: {share_text(float(one.share))} ({one.solutions})" for one in answers[:_MOST_ANSWERS]]
    if len(answers) > _MOST_ANSWERS:
        rest = answers[_MOST_ANSWERS:]
        listed.append(f"{len(rest)} more: {share_text(float(sum(one.share for one in rest)))}")
    return ", ".join(listed)


def next_section(facts: Sequence[NextFact]) -> Iterator[Section]:
    """Yield the section on facts to observe next, in descending order of entropy."""
    if not facts:
        return
    rows = []
    for one in facts[:_MOST_NEXT]:
        alike: list[FactMarginal | Fact] = [one.fact, *one.same]
        question, *equivalent = [_REQUESTED[fact.kind].format(fact.subject) for fact in alike]
        same = "; ".join(equivalent[:_MOST_ALIKE])
        if len(equivalent) > _MOST_ALIKE:
            same += f" and {len(equivalent) - _MOST_ALIKE} more"
        rows.append((question, figure(one.fact.bits, 3), _answers_text(one.fact.answers), same))
    lines = [
        "Single facts whose observation gives the most information. `bits` is the expected information: the entropy of "
        "the shares of the answers."
    ]
    if len(facts) > _MOST_NEXT:
        lines.append(f"{_MOST_NEXT} of {len(facts)}.")
    header = ("fact", "bits", "shares of the answers", "equivalent facts")
    yield Section("The next fact to look for", lines, [Table(header, rows)])


def assumptions_section(given: Sequence[int], changes: Sequence[ChangedCount]) -> Iterator[Section]:
    """Yield the section on the numbers of trains that result without each hard constraint. `given` contains the numbers
    of trains with all constraints.
    """
    if not changes:
        return
    header = ("assumption", *(f"{added} added" for added in range(len(given))), "trains")
    rows = [("all facts", *map(str, given), str(sum(given)))]
    for one in changes:
        counts = [str(count) for count in one.solutions] or ["-"] * len(given)
        total = one.refused or f"{one.total}{'' if one.complete else ' or more'}"
        rows.append((one.change, *counts, total))
    line = "Number of trains without one fact or rule, which shows how much it excludes."
    yield Section("Effect of each assumption", [line], [Table(header, rows)])


def missing_sections(found: MissingExplanation | None, most: int) -> Iterator[Section]:
    """Yield sections on the reasons why no train explains the evidence. `most` is the maximum number of added
    wheels.
    """
    if found is None:
        return
    line = "Result for each dial by itself. Surviving arbors that do not lead to this dial need not be used."
    rows = []
    for dial in found.dials:
        result = dial.refused or f"not explained with at most {plural(most, 'added wheel')}"
        if dial.fewest is not None:
            result = f"explained with {plural(dial.fewest, 'added wheel')}"
        rows.append((dial.dial, result))
    results = Table(("dial", "result without the other dials"), rows)
    yield Section("Why no train explains the evidence", [line], [results])
    uncertainties = [(one.change, str(one.fewest), str(one.total)) for one in found.uncertainties]
    tried = (
        f"{plural(found.requested, 'change')} of the evidence tried, one at a time: a hard constraint is dropped, or "
        f"a surviving count is changed by up to {MISREAD} teeth."
    )
    lines = [tried] if uncertainties else [tried, "No single change leaves an explanation."]
    if found.refused:
        lines.append(f"Not searched: {'; '.join(found.refused)}.")
    header = ("change", "added wheels", "trains")
    tables = [Table(header, cut(uncertainties, most=_MOST_UNCERTAINTIES))] if uncertainties else []
    yield Section("Changes of the evidence that would help", lines, tables)


# ----------------------------------------------------------------------------------------------------- the family tree


def family_section(tree: Sequence[FamilyBranch], turning: int = 0) -> Iterator[Section]:
    """Yield the section on the family tree. The first `turning` trains are animated on the HTML page."""
    if not tree:
        return
    # the most probable branches
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
            trains = plural(sum(branch.solutions for branch in left), "train")
            yield Branch(f"{plural(len(left), 'lighter branch').replace('branchs', 'branches')}: {share}, {trains}")

    said = [
        "Meshes from the input along the path to each pointer in turn, the driving wheel first. Parentheses give the "
        "pointers of an arbor. Each branch has its share of the weight. Trains at one end differ only in counts."
    ]
    yield Section("The family tree", said, branches=list(lines([0])))


def _branch(branch: FamilyBranch, turning: int, below: Sequence[Branch]) -> Branch:
    title = f"{', '.join(branch.meshes) or 'the input'}: {share_text(float(branch.share))}"
    trains = branch.trains
    ends = []
    for train in trains[:_MOST_TRAINS]:
        counts = f" with {teeth_text(train.counts)}" if train.counts else ""
        begins = title if len(trains) == 1 and not below else share_text(float(train.share))
        ends.append(Branch(_scene(f"{begins}, rank {train.rank}{counts}", train.rank, turning)))
    if len(trains) == 1 and not below:
        return ends[0]
    if len(trains) > _MOST_TRAINS:
        ends.append(Branch(f"{len(trains) - _MOST_TRAINS} more"))
    return Branch(f"{title}, {plural(branch.solutions, 'train')}", [*ends, *below])


def _scene(text: str, rank: int, turning: int) -> str:
    return SceneText(text, rank) if rank <= turning else text


# -------------------------------------------------------------------------------------------------------------- formats


def share_text(share: float) -> str:
    """Format a probability in per cent with three significant digits."""
    return f"{100 * share:.3g} %"


def teeth_text(wheels: Mapping[str, int]) -> str:
    """Format wheels with their tooth counts, such as `m1 96, n1 53`."""
    return ", ".join(f"{name} {teeth}" for name, teeth in wheels.items())


def ranks_text(ranks: tuple[int, int]) -> str:
    """Format a range of ranks, such as `3`, or `1-4` if several trains are equally probable."""
    first, last = ranks
    return str(first) if first == last else f"{first}-{last}"
