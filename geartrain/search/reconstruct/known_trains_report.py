"""What known trains cost in a question, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geartrain.report.document import Section, Table, figure
from geartrain.search.reconstruct.known_rank import (
    GREATEST,
    LEAST,
    AdmittingQuestion,
    KnownRank,
    TellingFact,
    TellingFacts,
    TrainPlace,
)
from geartrain.search.reconstruct.reconstruction_facts import many, ranks_text, share_text, teeth_text

_MOST_SETS = 12
_LINE = (
    "Where each train stands by weight among all that explain the evidence, and among those with as many added wheels; "
    "and how many times the best outweighs it."
)


def known_sections(known: Sequence[KnownRank]) -> Iterator[Section]:
    """Where each stands; of one that is no explanation, which rules it breaks, and what it costs without them."""
    if not known:
        return
    header = ("train", "added wheels", "arbors", "rank", "with as many", "weight", "outweighed")
    yield Section("Known trains", [_LINE], [Table(header, [_row(one) for one in known])])
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
        ways = many(len(found.sets), "way")
        lines.append(
            f"{many_facts[len(found.sets[0])]} together leave it alone, in {ways}; of facts that leave the same trains "
            "one is told."
        )
        rows = [("; ".join(map(_said, some)),) for some in found.sets[:_MOST_SETS]]
        if len(found.sets) > _MOST_SETS:
            rows.append((f"... {len(found.sets) - _MOST_SETS} more",))
        tables.append(Table(("together they leave it alone",), rows))
    return Section(f"What singles {train} out", lines, tables)


def _left(facts: Sequence[TellingFact]) -> list[tuple[str, ...]]:
    """Facts that leave as many trains in one row."""
    rows: dict[int, list[str]] = {}
    for fact in facts:
        rows.setdefault(fact.mechanisms, []).append(_said(fact))
    return [("; ".join(said), str(left)) for left, said in rows.items()]


_FACTS = {
    "pair": "{} mesh",
    "driver": "{1} drives {0}",
    "pointer": "the pointer of {} is on {}",
    "count": "{} has {}",
    "added": "{} has {}",
    GREATEST: "no added wheel has more than {1}",
    LEAST: "no added wheel has fewer than {1}",
}


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
    own = many(len(admitted.wheels), "wheel") + (f" ({teeth_text(admitted.wheels)})" if admitted.wheels else "")
    begins = f"Granted {changes}, it adds {own}"
    if admitted.refused is not None:
        return f"{begins}. Not asked: {admitted.refused}."
    told = [f"{number} with {added}" for added, number in enumerate(admitted.mechanisms) if number]
    if admitted.place is None:
        trains = f"trains are {', '.join(told)}" if told else "there is no train"
        return f"{begins}, and with at most {many(admitted.asked, 'wheel')} {trains}."
    place = admitted.place
    outweighed = "none outweighs it" if place.dearer == 1 else f"the best outweighs it {_times(place)}"
    return (
        f"{begins}. Trains by added wheels: {', '.join(told)}. It ranks {_ranks(place.ranks, place.trains)}, and "
        f"{_ranks(place.ranks_alike, place.trains_alike)} with as many; {outweighed}."
    )
