"""Conversion of documents to Markdown, plain text, and terminal output."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from io import StringIO
from typing import TYPE_CHECKING

from geartrain.errors import printable
from geartrain.report.document import Branch, Document, Table, aligned_rows, column_widths, gap_of, strips

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.text import Text
    from rich.tree import Tree


def to_markdown(documents: Sequence[Document]) -> str:
    """Return documents as Markdown text, one after the other.

    Parameters
    ----------
    documents : sequence of Document
        Documents to show; pictures and other elements of HTML pages are omitted.

    Returns
    -------
    str
        CommonMark with pipe tables. Text from users is escaped and cannot contain HTML or additional cells. Its only
        links are relative, http, https and mailto links.

    Examples
    --------
    >>> import geartrain
    >>> text = to_markdown([geartrain.load("planetary-24-18-60").report()])
    >>> [line for line in text.splitlines() if line.startswith("| carrier | 2/7")]
    ['| carrier | 2/7   | 0.28571429  | 1 : 3.5        |']
    """
    lines = []
    for document in documents:
        lines += [f"# {_line(document.title)}", ""]
        for paragraph in document.summary:
            lines += [markdown_text(paragraph), ""]
        for section in document.sections:
            lines += [f"## {_line(section.title)}", ""]
            for paragraph in section.paragraphs:
                lines += [markdown_text(paragraph), ""]
            if section.branches:
                lines += [*_list(section.branches), ""]
            for table in section.tables:
                lines += [*_pipes(table), ""]
    return "\n".join(lines)


def _line(text: str) -> str:
    return " ".join(markdown_text(text).split())


def _list(branches: Sequence[Branch], depth: int = 0) -> Iterator[str]:
    """Yield the lines of a nested Markdown list that represents a tree of text lines."""
    for branch in branches:
        yield f"{'  ' * depth}- {_line(branch.text)}"
        yield from _list(branch.below, depth + 1)


def _pipes(table: Table) -> Iterator[str]:
    rows = [[_line(cell).replace("|", "\\|") for cell in row] for row in (table.header, *table.rows)]
    # a Markdown table needs at least three dashes per column
    widths = [max(3, *(len(cell) for cell in column)) for column in zip(*rows, strict=True)]
    lines = [
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) + " |" for row in rows
    ]
    yield lines[0]
    yield "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    yield from lines[1:]


PIPED = 80
"""Characters per line if the width of the terminal is not known."""


def to_text(documents: Sequence[Document], width: int = PIPED) -> str:
    """Return documents as plain text with underlined headings, wrapped at a given width.

    Parameters
    ----------
    documents : sequence of Document
        Documents to show; pictures and other elements of HTML pages are omitted.
    width : int
        Characters per line. A longer word is broken.

    Returns
    -------
    str
        Lines without trailing blanks. A table that is too wide is split into groups of columns.

    Examples
    --------
    >>> from geartrain.report import Document
    >>> print(to_text([Document("A title", ["A lead."], [])]).strip())
    A title
    =======
    <BLANKLINE>
    A lead.
    """
    from rich.console import Console

    out = StringIO()
    console = Console(file=out, width=width, no_color=True, force_terminal=False, legacy_windows=False, highlight=False)
    to_terminal(documents, console, marks="=-")
    # rich pads lines to the width of the console
    return "\n".join(line.rstrip() for line in out.getvalue().splitlines()).rstrip()


def to_terminal(documents: Sequence[Document], console: Console, marks: str = "") -> None:
    """Print documents at the width of a console; `marks` underline headings if colours cannot distinguish them."""
    for document in documents:
        if document.title:
            _heading(document.title, "bold underline", console, marks[:1])
        for paragraph in document.summary:
            console.print(_shown(paragraph))
        for section in document.sections:
            console.print()
            if section.title:
                _heading(section.title, "bold cyan", console, marks[1:])
            for paragraph in section.paragraphs:
                console.print(_shown(paragraph))
            for branch in section.branches:
                console.print(_rich_tree(branch))
            # a table wider than the console becomes several tables
            shown = [strip for table in section.tables for strip in strips(table, console.width)]
            for at, strip in enumerate(shown):
                if at or (marks and section.paragraphs):
                    console.print()
                console.print(_rich_table(strip, console.width))
        console.print()


def _heading(title: str, style: str, console: Console, mark: str) -> None:
    shown = _shown(title, style=style)
    console.print(shown)
    if mark:
        # `cell_len` counts wide characters twice, as terminals do
        console.print(mark * min(console.width, shown.cell_len))
        if mark == "=":
            console.print()


def _shown(text: str, style: str = "") -> Text:
    """Return text of a document for output on a terminal, without control characters."""
    from rich.text import Text

    return Text(printable(text), style=style)


def _rich_tree(branch: Branch) -> Tree:
    from rich.tree import Tree

    shown = Tree(_shown(branch.text))
    for below in branch.below:
        shown.add(_rich_tree(below))
    return shown


def _rich_table(table: Table, width: int) -> RenderableType:
    """Return a table for a terminal, without ruled lines. Cells that report a failure are red."""
    from rich.table import Table as RichTable

    shown = RichTable(box=None, pad_edge=False, header_style="bold", padding=(0, gap_of(table), 0, 0))
    for name, size in zip(table.header, column_widths(table, width), strict=True):
        shown.add_column(_shown(name), width=size, overflow="fold")
    for row in aligned_rows(table):
        shown.add_row(*(_shown(cell, style="bold red" if "FAILS" in cell else "") for cell in row))
    return shown


_TAG = re.compile(r"<(?=[A-Za-z/!?])")
_ENTITY = re.compile(r"&(?=#?\w+;)")
_LINK = re.compile(r"\](?=(?:\(\s*<?([^)>]*)|:\s*<?(\S*)))")
"""Pattern of the closing bracket before the address of an inline link, an image or a reference definition."""
_IGNORED = re.compile(r"[\x00-\x20\\]")
"""Pattern of characters that Markdown or a browser ignores in an address: backslashes, blanks, control characters."""
_SCHEME = re.compile(r"([a-z][a-z0-9+.-]*):", re.IGNORECASE)
_FOLLOWED = {"http", "https", "mailto"}


def markdown_text(text: str) -> str:
    r"""Return the text with HTML and links escaped, except links that are relative or use http, https or mailto.

    >>> markdown_text("<b> [worn](JavaScript:alert(1)), see [the paper](https://example.org)")
    '&lt;b> [worn]\\(JavaScript:alert(1)), see [the paper](https://example.org)'
    """
    return _LINK.sub(_bracket, _TAG.sub("&lt;", _ENTITY.sub("&amp;", text)))


def _bracket(found: re.Match[str]) -> str:
    """Return the bracket before an address. A backslash precedes the bracket if the address is not allowed."""
    scheme = _SCHEME.match(_IGNORED.sub("", found[1] or found[2] or ""))
    return "]" if scheme is None or scheme[1].lower() in _FOLLOWED else "]\\"
