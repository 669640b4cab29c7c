"""A report as a page to share: with its verdict as a badge, pictures, wheels with their sources, and the train itself
turning."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from geartrain.report.document import (
    CitedText,
    Document,
    PageExtras,
    Picture,
    Section,
    SourceReference,
    cut,
    filled_table,
)
from geartrain.report.train_data import TrainReport
from geartrain.report.train_report import SOURCES, describe_train
from geartrain.train import Train


def describe_shared_page(
    found: TrainReport, pictures: Sequence[Picture] = (), viewer: str = "", notes: Sequence[str] = ()
) -> Document:
    """The report on a train with all that a page has room for; its sources are links.

    Parameters
    ----------
    found : TrainReport
        From `collect_report`.
    pictures : sequence of Picture
        Shown before the sections.
    viewer : str
        A whole HTML page in which the train turns, embedded as it is; "" for none.
    notes : sequence of str
        Remarks on the page, below the lead.

    Returns
    -------
    Document
        The document of `describe_train` with its `aside` filled, for `to_html`.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.report import collect_report
    >>> page = describe_shared_page(collect_report(geartrain.load("worm")), notes=["Not to scale."])
    >>> page.aside.badge, page.aside.notes
    ('determined', ('Not to scale.',))
    """
    document, declared = describe_train(found), found.train.declaration
    badge, sound = _badge(found)
    aside = PageExtras(
        badge=badge,
        sound=sound,
        notes=tuple(notes),
        pictures=tuple(pictures),
        viewer=viewer,
        sections=tuple(_wheels(declared)),
        references={
            key: SourceReference(source.cite, source.url or "", source.note or "")
            for key, source in declared.sources.items()
        },
    )
    shown = [section for section in document.sections if section.title != SOURCES]
    return replace(document, sections=shown, aside=aside)


def _badge(found: TrainReport) -> tuple[str, bool]:
    """The worst that is to be said of a train, in few words; and whether it is no complaint."""
    train, answers = found.train, found.states
    wrong = [answer for answer in answers if not answer.as_expected]
    if wrong:
        kind = wrong[0].verdict.kind
        return (f"{kind} in {len(wrong)} of {len(answers)} states" if train.states else kind), False
    if train.mechanics.faults:
        return "its teeth cannot turn", False
    failed = sum(len(answer.failures) for answer in answers)
    if failed:
        return f"{failed} expectation{'' if failed == 1 else 's'} failed", False
    kinds = dict.fromkeys(answer.verdict.kind for answer in answers)
    return " or ".join(kinds) + (" as expected" if [*kinds] != ["determined"] else ""), True


def _wheels(declared: Train) -> Iterator[Section]:
    """Every wheel with what is said of it; nothing where only teeth are."""
    rows = []
    for name, (link, wheel) in declared.wheels.items():
        doubt = wheel.teeth if not isinstance(wheel.teeth, int) else None
        source = wheel.source or (doubt.source if doubt else None) or ""
        counts = doubt.allowed if doubt else ()
        allowed = "" if not counts else f"{min(counts)}-{max(counts)}"
        note = "; ".join(filter(None, (wheel.note, doubt.note if doubt else None)))
        rows.append((name, link, str(wheel.count), allowed, wheel.status or "", CitedText(source), note))
    header = ("wheel", "link", "teeth", "allowed", "status", "source", "note")
    table = filled_table(header, rows, 3)
    if len(table.header) > 3:
        yield Section("Wheels and their sources", (), (replace(table, rows=cut(table.rows)),))
