"""A document: titled sections of paragraphs and tables, independent of how it is shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from geartrain.numerics.exact import abridged_text, decimal, fraction_text
from geartrain.numerics.long_float import Real
from geartrain.numerics.results import picture_maker


class ExactText(str):
    """A cell that holds an exact value; `full` is all of it where the text is shortened, and what a page copies."""

    __slots__ = ("_value",)

    _value: Fraction | Real | str

    def __new__(cls, text: str, value: Fraction | Real | None = None) -> ExactText:
        """`text` as shown, of `value`; the text itself is all there is to say where none is given."""
        made = super().__new__(cls, text)
        made._value = text if value is None else value
        return made

    @property
    def full(self) -> str:
        """The whole value; the digits of a very long one are written when they are asked for."""
        return fraction_text(self._value) if isinstance(self._value, Fraction) else str(self._value)


class CitedText(str):
    """A cell that names a source by its key; a page links it to the source."""

    __slots__ = ()


class SceneText(str):
    """A text that belongs to a scene of the page's viewer, by its number from 1 on; a page shows it when asked."""

    __slots__ = ("_scene",)

    _scene: int

    def __new__(cls, text: str, scene: int) -> SceneText:
        """`text` of the scene of this number."""
        made = super().__new__(cls, text)
        made._scene = scene
        return made

    @property
    def scene(self) -> int:
        """Its number in the viewer, from 1 on."""
        return self._scene


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of text under a header; the first column names the row.

    Attributes
    ----------
    header : sequence of str
        One title a column; "" where none is needed.
    rows : sequence of sequence of str
        Cells, as many in each row as the header has.
    wide : bool
        True for matrices, which a terminal shows in strips of columns and never wraps.

    Examples
    --------
    >>> from geartrain.report import Document, Section, to_markdown
    >>> table = Table(("wheel", "teeth"), [("sun", "24"), ("ring", "60")])
    >>> print(to_markdown([Document("Set", (), [Section("Wheels", (), [table])])]).splitlines()[4])
    | wheel | teeth |
    """

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    wide: bool = False


def filled_table(header: Sequence[str], rows: Sequence[Sequence[str]], always: int) -> Table:
    """A table without the columns in which no row says anything, but for the first so many."""
    used = [at for at in range(len(header)) if at < always or any(row[at] for row in rows)]
    return Table([header[at] for at in used], [[row[at] for at in used] for row in rows])


@dataclass(frozen=True, slots=True)
class Branch:
    """A line of a tree, with all that goes on from it.

    Attributes
    ----------
    text : str
        The line.
    below : sequence of Branch
        Lines that stand below it.
    """

    text: str
    below: Sequence[Branch] = ()


@dataclass(frozen=True, slots=True)
class Section:
    """A heading with paragraphs, a tree, then tables.

    Attributes
    ----------
    title : str
        The heading.
    paragraphs : sequence of str
        Plain text; no markup in it is obeyed.
    tables : sequence of Table
        After the paragraphs.
    branches : sequence of Branch
        A tree between paragraphs and tables.

    Examples
    --------
    >>> Section("Mobility", ["By count: 3 - 2 = 1."]).tables
    ()
    """

    title: str
    paragraphs: Sequence[str] = ()
    tables: Sequence[Table] = field(default_factory=tuple)
    branches: Sequence[Branch] = ()


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture with a caption, for pages of HTML.

    Attributes
    ----------
    caption : str
        One line below it.
    svg : str
        One whole SVG document, made by a program that escapes what users write: it stands in the page as it is.

    Examples
    --------
    >>> Picture("A line", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h9"/></svg>').caption
    'A line'
    """

    caption: str
    svg: str


@dataclass(frozen=True, slots=True)
class SourceReference:
    """A source in full. A page links `url` if it is of http or https, and shows any other as text."""

    cite: str
    url: str = ""
    note: str = ""


@dataclass(frozen=True, slots=True)
class PageExtras:
    """What only a page has room for, beside what a document says in any form.

    badge       the verdict in a word or two; `sound` if there is nothing to complain of
    notes       short remarks below the lead, such as which extra brings pictures
    viewer      a whole HTML page in which the train turns
    sections    further sections at the end
    references  sources by key
    """

    badge: str = ""
    sound: bool = True
    notes: Sequence[str] = ()
    pictures: Sequence[Picture] = ()
    viewer: str = ""
    sections: Sequence[Section] = ()
    references: Mapping[str, SourceReference] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Document:
    """A title, a lead, and sections, independent of how they are shown.

    Attributes
    ----------
    title : str
        The first heading.
    lead : sequence of str
        Paragraphs before the first section.
    sections : sequence of Section
        In the order in which they are read.
    aside : PageExtras
        Badge, pictures, viewer and sources, which only a page of HTML has room for.

    See Also
    --------
    describe_train, describe_torques, describe_motion : Make documents.
    to_markdown, to_html : Show them.

    Examples
    --------
    >>> from geartrain.report import to_markdown
    >>> print(to_markdown([Document("A title", ["A lead."], [])]).strip())
    # A title
    <BLANKLINE>
    A lead.
    """

    title: str
    lead: Sequence[str]
    sections: Sequence[Section]
    aside: PageExtras = field(default_factory=PageExtras)

    def __str__(self) -> str:
        """The document as Markdown."""
        text: str = picture_maker("report", "to_markdown")([self])
        return text

    def _repr_markdown_(self) -> str:
        return str(self)


def figure(value: Fraction | Real | None, digits: int = 8) -> str:
    """A number in decimal; a dash where there is none."""
    if value is None:
        return "-"
    return decimal(value, digits) if isinstance(value, Fraction) else f"{value:.{digits}g}"


def exact(value: Fraction | Real | None) -> str:
    """A number as a fraction, shortened where it is very long; a tilde marks a float."""
    if value is None:
        return "undetermined"
    if not isinstance(value, Fraction):
        return f"~{value:.12g}"
    return ExactText(abridged_text(value), value)


def one_to(ratio: Fraction | Real | None) -> str:
    """A ratio output over input as `1 : n`, or `n : 1` where the output is the faster."""
    if not ratio:
        return "-"
    if not -1 < ratio < 1:
        return f"{figure(ratio, 7)} : 1"
    return f"1 : {figure(1 / ratio, 7)}"


def ppm(value: float | None) -> str:
    """Parts per million with sign."""
    # less than 1e-15 of the speed is what is left of rounding
    return "-" if value is None else "0" if abs(value) < 1e-9 else f"{value:+.6g}"


MOST_ROWS = 120
"""Longer tables are cut, and say so; the JSON has everything."""


def cut(rows: Sequence[Sequence[str]], of: int | None = None) -> list[Sequence[str]]:
    """The first rows of a long table (of so many, if not all are given), and how many more there are."""
    count = len(rows) if of is None else of
    if count <= MOST_ROWS:
        return list(rows)
    return [*rows[:MOST_ROWS], (f"... {count - MOST_ROWS} more", *("" for _ in rows[0][1:]))]
