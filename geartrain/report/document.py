"""Document: titled sections of paragraphs and tables, independent of the output format.

Tables are fitted to a given width: text in cells wraps at word boundaries, and a table that is still too wide is split
into strips of columns.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import islice, zip_longest
from typing import Any

from geartrain.errors import Problem, QuestionError
from geartrain.numerics.exact import abridged_text, decimal, fraction_text, pi_text, touches_pi
from geartrain.numerics.results import Shown, field_docs, imported_function, summary_line

MOST_ROWS = 120
"""Maximum number of table rows in a document; JSON output contains all rows."""


class ExactText(str):
    """Table cell that shows an exact value in abridged form. `full` is the complete text, which an HTML page copies."""

    __slots__ = ("_value",)

    _value: Fraction | float | str

    def __new__(cls, text: str, value: Fraction | float | None = None) -> ExactText:
        """Return a cell that shows `text` for the exact `value`. If `value` is None, the text itself is complete."""
        made = super().__new__(cls, text)
        made._value = text if value is None else value
        return made

    @property
    def full(self) -> str:
        """Complete value as a string. The string is computed on access only, because it may have very many digits."""
        return fraction_text(self._value) if isinstance(self._value, Fraction) else str(self._value)


class CitedText(str):
    """Table cell that contains the key of a source. An HTML page links the cell to the source."""

    __slots__ = ()


class SceneText(str):
    """Text that refers to a numbered scene of the viewer in an HTML page. A click on the text shows the scene."""

    __slots__ = ("_scene",)

    _scene: int

    def __new__(cls, text: str, scene: int) -> SceneText:
        """Return text that refers to scene number `scene` of the viewer."""
        made = super().__new__(cls, text)
        made._scene = scene
        return made

    @property
    def scene(self) -> int:
        """Number of the scene in the viewer, from 1."""
        return self._scene


@dataclass(frozen=True, slots=True)
class Table(Shown):
    """Table of text cells with a header. The cells of the first column name the rows.

    Examples
    --------
    >>> from geartrain.report import Document, Section, to_markdown
    >>> table = Table(("wheel", "teeth"), [("sun", "24"), ("ring", "60")])
    >>> print(to_markdown([Document("Set", (), [Section("Wheels", (), [table])])]).splitlines()[4])
    | wheel | teeth |
    """

    header: Sequence[str]
    """Title of each column; "" for a column without a title."""
    rows: Sequence[Sequence[str]]
    """Cells by row; each row has one cell for each column."""
    wide: bool = False
    """True for a matrix, which a terminal shows in several groups of columns without wrapping cells."""


def table_document(columns: Mapping[str, Sequence[object]], most: int) -> Document:
    """Return a document with a table of the first `most` rows of a result, and the number of omitted rows."""
    count = len(next(iter(columns.values()), ()))
    rows = [
        ["" if value is None else f"{value:.8g}" if isinstance(value, float) else str(value) for value in row]
        for row in islice(zip(*columns.values(), strict=True), most)
    ]
    more = [f"{count - most:,} more rows."] if count > most else []
    return Document("", [], [Section("", more, [Table(list(columns), rows)])] if columns else [])


def filled_table(header: Sequence[str], rows: Sequence[Sequence[str]], always: int, wide: bool = False) -> Table:
    """Return a table without its empty columns. The first `always` columns are kept even if they are empty."""
    used = [at for at in range(len(header)) if at < always or any(row[at] for row in rows)]
    return _chosen(Table(header, rows, wide), used)


_UNIT = re.compile(r"\[(.+?)\]")
"""Regular expression that finds the unit in the docstring of a field."""
_CellColumn = tuple[str, Callable[[Any], str]]
"""Header of a column, and the function that returns the cell of a result in this column."""


def result_table(results: Iterable[Any], *columns: str | _CellColumn, wide: bool = False) -> Table:
    """Return a table with one row for each result. All results have the same class.

    columns   name of a field; `field:digits` for a number; or `head=field:digits` with the head of the column, which is
              otherwise the name with the unit in the field's docstring. A column can also be a pair of a head and a
              function that returns the cell of a result.
    """
    rows = list(results)
    kind: type = type(rows[0]) if rows else object
    heads, cells = zip(*(_field_column(each, field_docs(kind)) for each in columns), strict=True)
    return Table(heads, [tuple(cell(row) for cell in cells) for row in rows], wide)


def _field_column(column: str | _CellColumn, docs: Mapping[str, str]) -> _CellColumn:
    if not isinstance(column, str):
        return column
    # without `=` the whole string is the field, and `head` and `given` are empty
    head, given, field = column.rpartition("=")
    name, _, digits = field.partition(":")
    unit = _UNIT.search(docs.get(name, ""))
    head = head if given else f"{name.replace('_', ' ')} ({unit[1]})" if unit else name.replace("_", " ")

    def cell(result: Any) -> str:
        value = getattr(result, name)
        return "-" if value is None else figure(value, int(digits)) if digits else str(value)

    return head, cell


@dataclass(frozen=True, slots=True)
class Branch:
    """Text line with further lines below it, which form a tree.

    See Also
    --------
    Section : its field `branches` is a tree.
    """

    text: str
    """Text of the line at this node."""
    below: Sequence[Branch] = ()
    """Child nodes of this node."""


@dataclass(frozen=True, slots=True)
class Section(Shown):
    """Section of a document: a heading with paragraphs, a tree, and tables.

    Examples
    --------
    >>> Section("Mobility", ["By count: 3 - 2 = 1."]).tables
    ()
    """

    title: str
    """Heading of the section."""
    paragraphs: Sequence[str] = ()
    """Paragraphs of plain text; markup in them has no effect."""
    tables: Sequence[Table] = field(default_factory=tuple)
    """Tables after the paragraphs."""
    branches: Sequence[Branch] = ()
    """Roots of the trees that are shown between paragraphs and tables."""
    detail: bool = False
    """True for a detail section. Text reports omit it unless it is requested, and an HTML page shows it folded."""


@dataclass(frozen=True, slots=True)
class Picture(Shown):
    """Picture with a caption for HTML pages.

    Examples
    --------
    >>> Picture("A line", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h9"/></svg>').caption
    'A line'
    """

    caption: str
    """Text below the picture."""
    svg: str
    """Complete SVG document, included unchanged in the page; text from users must be escaped in it."""


@dataclass(frozen=True, slots=True)
class SourceReference:
    """Bibliographic reference. On an HTML page, `url` becomes a link if it is an http or https address, and plain text
    if it is not.
    """

    cite: str
    url: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True)
class PageExtras:
    """Contents that are shown only on an HTML page, in addition to the document."""

    badge: str = ""
    """Verdict in one or two words. `sound` is True if the verdict is favourable."""
    sound: bool = True
    notes: Sequence[str] = ()
    """Short remarks below the summary, such as the name of an extra to install for pictures."""
    pictures: Sequence[Picture] = ()
    viewer: str = ""
    """Complete HTML page with the animated train; an empty string if there is no animation."""
    sections: Sequence[Section] = ()
    """Sections that follow the sections of the document."""
    references: Mapping[str, SourceReference] = field(default_factory=dict)
    """Bibliographic references, keyed by source."""


@dataclass(frozen=True, slots=True, repr=False)
class Document:
    """Document with title, summary and sections, independent of the output format.

    See Also
    --------
    describe_train, describe_torques, describe_motion : Return documents.
    to_markdown, to_html : Convert documents.

    Examples
    --------
    >>> from geartrain.report import to_markdown
    >>> print(to_markdown([Document("A title", ["A lead."], [])]).strip())
    # A title
    <BLANKLINE>
    A lead.
    """

    title: str
    """Title of the document, shown as its first heading."""
    summary: Sequence[str]
    """Paragraphs before the first section."""
    sections: Sequence[Section]
    """Sections in reading order."""
    aside: PageExtras = field(default_factory=PageExtras)
    """Badge, pictures, viewer and references, which are shown only on an HTML page."""

    def __repr__(self) -> str:
        count = len(self.sections)
        return summary_line("Document", f"{self.title}: {count} section{'' if count == 1 else 's'}")

    def __str__(self) -> str:
        """Return the document as Markdown."""
        text: str = imported_function("report", "to_markdown")([self])
        return text

    def _repr_markdown_(self) -> str:
        return str(self)


def titled(state: str | None, words: str) -> str:
    """Return a section title, such as `Speeds`, or, if the train has several states, `State 1: speeds`."""
    return words[0].upper() + words[1:] if state is None else f"State {state}: {words}"


def without_details(document: Document, requested: Sequence[str] = ()) -> Document:
    """Return a document without its detail sections, or only the sections whose titles contain a requested word.

    Without requested words, a last section lists the omitted titles. A word in no title raises `QuestionError`.
    """
    titles = [section.title for section in document.sections]
    for word in requested:
        if not any(word.lower() in title.lower() for title in titles):
            what, why = f"the report has no section '{word}'", f"its sections are {', '.join(titles)}"
            raise QuestionError(Problem(what, why, "use a word from one of these titles"))
    if requested:
        kept = [each for each in document.sections if any(word.lower() in each.title.lower() for word in requested)]
        return replace(document, summary=(), sections=kept)
    kept = [each for each in document.sections if not each.detail]
    omitted = dict.fromkeys(each.title for each in document.sections if each.detail)
    if omitted:
        kept.append(Section("More", (f"{', '.join(omitted)}: with `--section NAME`, or `--all`.",)))
    return replace(document, sections=kept)


def figure(value: Fraction | float | None, digits: int = 8) -> str:
    """Return a string with a number in decimal notation, with at most `digits` significant digits; a dash for None."""
    if value is None:
        return "-"
    return decimal(value, digits) if isinstance(value, Fraction) else f"{value:.{digits}g}"


def exact(value: Fraction | float | None) -> str:
    """Return a string with a number as a fraction, abridged if it is very long. A float is preceded by a tilde."""
    if value is None:
        return "undetermined"
    if not isinstance(value, Fraction):
        return f"~{value:.12g}"
    return pi_text(value) if touches_pi(value) else ExactText(abridged_text(value), value)


def one_to(ratio: Fraction | float | None) -> str:
    """Return the ratio of output to input as `1 : n`, or as `n : 1` if the output is faster; "-" for None or 0."""
    if not ratio:
        return "-"
    if not -1 < ratio < 1:
        return f"{figure(ratio, 7)} : 1"
    return f"1 : {figure(1 / ratio, 7)}"


def ppm(value: float | None) -> str:
    """Return a text with a sign and a value in parts per million; a dash for None."""
    # a relative error below 1e-15 is rounding
    return "-" if value is None else "0" if abs(value) < 1e-9 else f"{value:+.6g}"


def cut(rows: Sequence[Sequence[str]], of: int | None = None, most: int = MOST_ROWS) -> list[Sequence[str]]:
    """Return the first `most` rows and a row with the number of omitted rows, of `of` rows in all (default: `rows`)."""
    count = len(rows) if of is None else of
    if count <= most:
        return list(rows)
    return [*rows[:most], (f"... {count - most} more", *("" for _ in rows[0][1:]))]


# ------------------------------------------------------------------------------------------------ tables within a width


def gap_of(table: Table) -> int:
    """Return the number of spaces between two columns of a table: one in a matrix, two in other tables."""
    return 1 if table.wide else 2


def strips(table: Table, width: int) -> Iterator[Table]:
    """Yield the strips of columns, each with the first column, into which a table is divided to fit a width.

    A word is broken only if it is wider than `width`, the number of characters per line.
    """
    minimum = [_minimum(column, table.wide) for column in _columns(table)]
    gap, start = gap_of(table), 1
    if len(minimum) < 2:
        yield table
        return
    while start < len(minimum):
        end, used = start + 1, minimum[0] + gap + minimum[start]
        while end < len(minimum) and used + gap + minimum[end] <= width:
            used += gap + minimum[end]
            end += 1
        yield table if end - start == len(minimum) - 1 else _chosen(table, [0, *range(start, end)])
        start = end


def column_widths(table: Table, width: int) -> list[int]:
    """Return the width of each column in characters, at most that of its longest cell.

    The sum exceeds `width` only if the longest words do not fit.
    """
    columns = _columns(table)
    full = [max(map(len, column)) for column in columns]
    minimum = [_minimum(column, table.wide) for column in columns]
    free = width - gap_of(table) * (len(columns) - 1)
    if sum(full) <= free:
        return full
    spare, sizes = max(0, free - sum(minimum)), list(minimum)
    left = len(columns)
    for at in sorted(range(len(columns)), key=lambda each: full[each] - minimum[each]):
        # columns that need few characters get all of them, because rows take one line only if no column wraps
        given = min(full[at] - minimum[at], spare if left == 1 else max(spare // 2, spare // left))
        sizes[at] += given
        spare, left = spare - given, left - 1
    return sizes


# a tilde marks a number solved in floats; both minus signs occur
_NUMBER = re.compile(r"[+\-−~]?\d[\d ]*(\.\d*)?(e[+-]?\d+)?")


def aligned_rows(table: Table) -> list[list[str]]:
    """Return the rows of a table, with the decimal points of each column of numbers aligned by spaces."""
    if table.wide:
        return [list(row) for row in table.rows]
    columns = [_aligned(column) for column in zip_longest(*table.rows, fillvalue="")]
    return [list(row) for row in zip(*columns, strict=True)]


def _aligned(column: Sequence[str]) -> Sequence[str]:
    numbers = [cell for cell in column if cell not in ("", "-")]
    # a single number needs no alignment
    if len(numbers) < 2 or not all(_NUMBER.fullmatch(cell) for cell in numbers):
        return column
    # characters before the decimal point or exponent
    widths = [len(re.split(r"[.e]", cell)[0]) for cell in column]
    widest = max(width for width, cell in zip(widths, column, strict=True) if cell in numbers)
    return [" " * (widest - width) + cell if cell else cell for width, cell in zip(widths, column, strict=True)]


def _columns(table: Table) -> list[tuple[str, ...]]:
    return list(zip_longest(table.header, *aligned_rows(table), fillvalue=""))


def _minimum(column: Sequence[str], whole: bool) -> int:
    """Return the minimum width of a column: the length of its longest word or, if `whole`, of its longest cell."""
    pieces = column if whole else [word for cell in column for word in cell.split()]
    return max(1, *(len(piece) for piece in pieces), 0)


def _chosen(table: Table, at: Sequence[int]) -> Table:
    rows = [[row[each] for each in at] for row in table.rows]
    return replace(table, header=[table.header[each] for each in at], rows=rows)
