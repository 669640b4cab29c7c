"""Documents as one HTML page that stands alone: it asks the network for nothing, and nothing a user wrote can run."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from importlib import resources
from itertools import count
from typing import Any
from urllib.parse import urlsplit

from geartrain.errors import MissingExtraError
from geartrain.report.document import CitedText, Document, Table, strips
from geartrain.scene.palette import THEMES

ON_PAPER = 110
"""Characters across a sheet of A4 or letter, in the type in which a page prints its tables."""
WORDS = {"viewer": "The train turning", "pictures": "Pictures", "sources": "Sources"}
_LONG = re.compile(r"(\.\d\d)\d+")
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; script-src "
_INTO_FRAMES = "'unsafe-inline' blob: data:; worker-src blob:; connect-src data: blob:"
"""A viewer in a frame obeys the page's own policy too, and its scripts are not known here."""


@dataclass(frozen=True, slots=True)
class _Anchors:
    """Names of places in one document of a page; `contents` are those of its headings, with their titles."""

    contents: Sequence[tuple[str, str]]
    sections: Sequence[str]
    references: Mapping[str, str]
    viewer: str
    pictures: str
    sources: str


def to_html(documents: Sequence[Document]) -> str:
    """Documents as one self-contained page of HTML, which asks the network for nothing.

    Parameters
    ----------
    documents : sequence of Document
        One or more, each with its own contents.

    Returns
    -------
    str
        The whole page. Texts are escaped; pictures stand in it as SVG, a viewer in a frame of its own that cannot reach
        the page.

    Raises
    ------
    MissingExtraError
        Without jinja2, which the extra `report` brings.

    Examples
    --------
    >>> from geartrain.report import Document
    >>> page = to_html([Document("<b>", ["One & one."], [])])
    >>> "<h1>&lt;b&gt;</h1>" in page, "One &amp; one." in page
    (True, True)
    """
    check_pages()
    from markupsafe import Markup

    script, numbers = _shipped("page.js"), count(1)
    page: str = _template("page.html").render(
        documents=documents,
        anchors=[_anchors(document, f"{at}-" if at else "") for at, document in enumerate(documents)],
        drawings=[
            [{"caption": each.caption, "svg": Markup(inline(each.svg, next(numbers)))} for each in page.aside.pictures]
            for page in documents
        ],
        words=WORDS,
        style=Markup(_colours() + _shipped("page.css")),
        script=Markup(script),
        policy=_policy(script, framed=any(document.aside.viewer for document in documents)),
    )
    return page


def to_fragment(documents: Sequence[Document]) -> str:
    """Return titles, paragraphs and tables of documents as on their page, without its style and script.

    Parameters
    ----------
    documents : sequence of Document
        What is shown; pictures and other extras of pages are left out.

    Returns
    -------
    str
        HTML for a notebook. Texts are escaped.

    Raises
    ------
    MissingExtraError
        Without jinja2, which the extra `report` brings.
    """
    check_pages()
    fragment: str = _template("fragment.html").render(documents=documents)
    return fragment


def check_pages() -> None:
    """Make sure that pages can be made, before what is to stand in them is worked out; else `MissingExtraError`."""
    try:
        import jinja2  # noqa: F401
    except ImportError:
        raise MissingExtraError("jinja2", "report", "a report in HTML") from None


@cache
def _template(name: str) -> Any:
    """A template, compiled once: that takes longer than to fill it."""
    from jinja2 import Environment, FunctionLoader

    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, loader=FunctionLoader(_shipped))
    filters: dict[str, Callable[..., Any]] = {
        "is_web": is_web,
        "is_cited": lambda cell: isinstance(cell, CitedText),
        "with_code": _with_code,
        "on_paper": _on_paper,
    }
    environment.filters |= filters
    return environment.get_template(name)


def _on_paper(table: Table) -> list[Table]:
    """The strips in which a table that is wider than a sheet is printed; none for others."""
    parts = list(strips(table, ON_PAPER))
    return parts if len(parts) > 1 else []


def _with_code(line: str) -> Any:
    """A line in which what stands between backticks is marked as code; everything else is escaped."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", str(escape(line))))


def is_web(url: str) -> bool:
    """Whether an address may become a link: of http or https, with a host."""
    try:
        parts = urlsplit(url)
    except ValueError:
        return False
    return parts.scheme in ("http", "https") and bool(parts.netloc)


def inline(svg: str, number: int) -> str:
    """An SVG document as an element of a page, its names made its own by `number`; sizes are left to the page.

    Lengths in paths keep two decimals: a hundredth of a point is finer than any screen or printer.
    """
    element = re.sub(r'(?<=\sd=")[^"]*', lambda path: _LONG.sub(r"\1", path[0]), svg[svg.index("<svg") :])
    names = set(re.findall(r'\bid="([^"]+)"', element))

    def own(found: re.Match[str]) -> str:
        return f"{found[1]}p{number}-{found[2]}{found[3]}" if found[2] in names else found[0]

    for pattern in (r'(\bid=")([^"]+)(")', r'(href="#)([^"]+)(")', r"(url\(#)([^)]+)(\))"):
        element = re.sub(pattern, own, element)
    head, rest = element.split(">", 1)
    head = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return f'{head} role="img">{rest}'.strip()


def _anchors(document: Document, prefix: str) -> _Anchors:
    aside = document.aside
    sections = [section.title for section in (*document.sections, *aside.sections)]
    first = [WORDS[key] for key in ("viewer", "pictures") if getattr(aside, key)]
    titles = [*first, *sections, *([WORDS["sources"]] if aside.references else [])]
    marks = list(_marks(titles, prefix))
    where = dict(zip(first, marks, strict=False))
    return _Anchors(
        contents=list(zip(marks, titles, strict=True)),
        sections=marks[len(first) : len(first) + len(sections)],
        references={key: f"{prefix}source-{at}" for at, key in enumerate(aside.references, start=1)},
        viewer=where.get(WORDS["viewer"], ""),
        pictures=where.get(WORDS["pictures"], ""),
        sources=marks[-1] if marks else "",
    )


def _marks(titles: Sequence[str], prefix: str) -> Iterator[str]:
    """A name for each title: its words with hyphens, numbered where they come again."""
    seen: dict[str, int] = {}
    for title in titles:
        name = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "section"
        seen[name] = seen.get(name, 0) + 1
        yield f"{prefix}{name}" + (f"-{seen[name]}" if seen[name] > 1 else "")


def _policy(script: str, framed: bool) -> str:
    """What the page may load: nothing; and run: the one script it carries, known by its hash."""
    if framed:
        return _POLICY + _INTO_FRAMES
    return f"{_POLICY}'sha256-{b64encode(sha256(script.encode()).digest()).decode()}'"


def _colours() -> str:
    """The palette, light and dark as the reader's system is."""
    light, dark = THEMES["light"].css, THEMES["dark"].css
    return f":root {{ {light} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n"


def _shipped(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")
