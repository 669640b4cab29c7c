"""A document as Markdown, or on a terminal."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from geartrain.errors import printable
from geartrain.report.document import Branch, Document, Table

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.text import Text
    from rich.tree import Tree


def to_markdown(documents: Sequence[Document]) -> str:
    """Documents as Markdown, one after the other.

    Parameters
    ----------
    documents : sequence of Document
        What is shown; pictures and other extras of pages are left out.

    Returns
    -------
    str
        CommonMark with tables in pipes. What a user wrote is text in it: no HTML, no further cells.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.report import collect_report, describe_train
    >>> report = collect_report(geartrain.load("planetary-24-18-60"))
    >>> [line for line in to_markdown([describe_train(report)]).splitlines() if line.startswith("| carrier | 2/7")]
    ['| carrier | 2/7   | 0.28571429  | 1 : 3.5        |']
    """
    return "\n".join(line for document in documents for line in _markdown(document))


_TAG = re.compile(r"<(?=[A-Za-z/!?])")
_ENTITY = re.compile(r"&(?=#?\w+;)")


def _plain(text: str) -> str:
    """Text that Markdown would take for HTML, as text."""
    return _TAG.sub("&lt;", _ENTITY.sub("&amp;", text))


def _line(text: str) -> str:
    """The same on one line, for a heading or a cell."""
    return " ".join(_plain(text).split())


def _markdown(document: Document) -> Iterator[str]:
    yield from (f"# {_line(document.title)}", "")
    for paragraph in document.lead:
        yield from (_plain(paragraph), "")
    for section in document.sections:
        yield from (f"## {_line(section.title)}", "")
        for paragraph in section.paragraphs:
            yield from (_plain(paragraph), "")
        if section.branches:
            yield from (*_list(section.branches), "")
        for table in section.tables:
            yield from _pipes(table)
            yield ""


def _list(branches: Sequence[Branch], depth: int = 0) -> Iterator[str]:
    """A tree as a list of lists."""
    for branch in branches:
        yield f"{'  ' * depth}- {_line(branch.text)}"
        yield from _list(branch.below, depth + 1)


def _pipes(table: Table) -> Iterator[str]:
    rows = [[_line(cell).replace("|", "\\|") for cell in row] for row in (table.header, *table.rows)]
    widths = [max(3, *(len(cell) for cell in column)) for column in zip(*rows, strict=True)]
    lines = [
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) + " |" for row in rows
    ]
    yield lines[0]
    yield "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    yield from lines[1:]


def to_terminal(documents: Sequence[Document], console: Console) -> None:
    """The documents on a terminal; matrices wider than it are shown in strips."""
    for document in documents:
        console.print(_shown(document.title, style="bold underline"))
        for paragraph in document.lead:
            console.print(_shown(paragraph))
        for section in document.sections:
            console.print()
            console.print(_shown(section.title, style="bold cyan"))
            for paragraph in section.paragraphs:
                console.print(_shown(paragraph))
            for branch in section.branches:
                console.print(_rich_tree(branch))
            strips = [strip for table in section.tables for strip in _strips(table, console.width)]
            for at, strip in enumerate(strips):
                if at:
                    console.print()
                console.print(_rich_table(strip))
        console.print()


def _shown(text: str, style: str = "") -> Text:
    """Text of a document for a terminal, which it does not steer."""
    from rich.text import Text

    return Text(printable(text), style=style)


def _rich_tree(branch: Branch) -> Tree:
    """A line with those below it, joined by strokes."""
    from rich.tree import Tree

    shown = Tree(_shown(branch.text))
    for below in branch.below:
        shown.add(_rich_tree(below))
    return shown


def _rich_table(table: Table) -> RenderableType:
    """A table without rules; failures in red."""
    from rich.table import Table as RichTable

    gap = 1 if table.wide else 2
    shown = RichTable(box=None, pad_edge=False, header_style="bold", padding=(0, gap, 0, 0))
    for name in table.header:
        shown.add_column(_shown(name), no_wrap=table.wide, overflow="fold")
    for row in table.rows:
        shown.add_row(*(_shown(cell, style="bold red" if "FAILS" in cell else "") for cell in row))
    return shown


def _strips(table: Table, width: int) -> Iterator[Table]:
    """A matrix cut into strips of columns that fit; other tables as they are."""
    if not table.wide:
        yield table
        return
    columns = [[table.header[at], *(row[at] for row in table.rows)] for at in range(len(table.header))]
    sizes = [max(map(len, column)) + 1 for column in columns]
    start = 1
    while start < len(columns):
        end, used = start + 1, sizes[0] + sizes[start]
        while end < len(columns) and used + sizes[end] <= width:
            used += sizes[end]
            end += 1
        chosen = [0, *range(start, end)]
        yield Table([table.header[at] for at in chosen], [[row[at] for at in chosen] for row in table.rows], wide=True)
        start = end
