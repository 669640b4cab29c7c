"""What candidates share and where they part, the next fact to look for, and what hard facts carried, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from geartrain.report.document import Section, Table, cut, figure
from geartrain.search.reconstruct.dropped_facts import MISREAD, ChangedCount, LoneDial, MissingExplanation
from geartrain.search.reconstruct.explained_facts import (
    YES,
    Fact,
    FactAnswer,
    FactKind,
    FactMarginal,
    NextFact,
)

_MOST_ANSWERS = 4
_MOST_ALIKE = 2
_MOST_MESHES = 40
_MOST_NEXT = 12
_MOST_DOUBTS = 30

_ASKED: dict[FactKind, str] = {
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


def share_text(share: float) -> str:
    """A share of the weight, as a page tells it."""
    return f"{100 * share:.3g} %"


def many(count: int, noun: str) -> str:
    """`1 train`, `2 trains`."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def teeth_text(wheels: Mapping[str, int]) -> str:
    """Wheels with their counts: `m1 96, n1 53`."""
    return ", ".join(f"{name} {teeth}" for name, teeth in wheels.items())


def ranks_text(ranks: tuple[int, int]) -> str:
    """`3`, or `1-4` of trains that weigh the same."""
    first, last = ranks
    return str(first) if first == last else f"{first}-{last}"


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
    return Table((title, "weight", "trains"), _first(rows, _MOST_MESHES))


def _answers(facts: Sequence[FactMarginal]) -> Table:
    named = {**_ASKED, "used": "whether {} is used"}
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
        (_asked(one.fact), figure(one.fact.bits, 3), _told(one.fact.answers), _alike(one.same))
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


def _asked(fact: FactMarginal | Fact) -> str:
    return _ASKED[fact.kind].format(fact.subject)


def _alike(facts: Sequence[Fact]) -> str:
    told = [_asked(fact) for fact in facts[:_MOST_ALIKE]]
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
        f"{many(found.asked, 'change')} to the evidence tried, one at a time: a hard fact dropped, or a surviving "
        f"count read otherwise by up to {many(MISREAD, 'tooth').replace('tooths', 'teeth')}."
    )
    lines = [tried] if doubts else [tried, "None of them alone leaves an explanation."]
    if found.refused:
        lines.append(f"Could not be asked: {'; '.join(found.refused)}.")
    header = ("what is doubted", "added wheels", "trains")
    tables = [Table(header, _first(doubts, _MOST_DOUBTS))] if doubts else []
    yield Section("The cheapest evidence to doubt", lines, tables)


def _alone(dial: LoneDial, most: int) -> str:
    if dial.refused is not None:
        return dial.refused
    if dial.fewest is None:
        return f"fails: no train with {many(most, 'added wheel')} or fewer"
    return f"explained with {many(dial.fewest, 'added wheel')}"


def _first(rows: Sequence[tuple[str, ...]], most: int) -> list[tuple[str, ...]]:
    left = len(rows) - most
    return list(rows) if left <= 0 else [*rows[:most], (f"... {left} more", *("" for _ in rows[0][1:]))]
