"""Conversion of documents to one self-contained HTML page.

The page loads nothing from the network and executes no text of a user.
"""

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

_ON_PAPER = 110  # characters per line of a printed table on A4 or letter paper
WORDS = {"viewer": "Animation", "pictures": "Pictures", "sources": "Sources"}
_LONG = re.compile(r"(\.\d\d)\d+")  # digits of a decimal number after the second place
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; script-src "
_INTO_FRAMES = "'unsafe-inline' blob: data:; worker-src blob:; connect-src data: blob:"
"""Sources allowed on pages with a viewer, whose frame inherits the policy and has scripts of unknown hash."""


@dataclass(frozen=True, slots=True)
class _Anchors:
    """Anchor names of one of the documents on an HTML page. `contents` lists the anchor and title of each heading."""

    contents: Sequence[tuple[str, str]]
    sections: Sequence[str]
    references: Mapping[str, str]
    viewer: str
    pictures: str
    sources: str


def to_html(documents: Sequence[Document]) -> str:
    """Return documents as one self-contained HTML page, which makes no network requests.

    Parameters
    ----------
    documents : sequence of Document
        One or more documents, each with its own table of contents.

    Returns
    -------
    str
        Complete page. Texts are escaped, pictures are included as SVG, and a viewer is shown in a sandboxed frame.

    Raises
    ------
    MissingExtraError
        If jinja2 is not installed (extra `report`).

    Examples
    --------
    >>> from geartrain.report import Document
    >>> page = to_html([Document("<b>", ["One & one."], [])])
    >>> "<h1>&lt;b&gt;</h1>" in page, "One &amp; one." in page
    (True, True)
    """
    check_pages()
    from markupsafe import Markup

    script, numbers = _resource("page.js"), count(1)
    page: str = _template("page.html").render(
        documents=documents,
        # the first document has no prefix, so that a page with one document has short anchors
        anchors=[_anchors(document, f"{at}-" if at else "") for at, document in enumerate(documents)],
        drawings=[
            [{"caption": each.caption, "svg": Markup(inline(each.svg, next(numbers)))} for each in page.aside.pictures]
            for page in documents
        ],
        words=WORDS,
        # only resources of this package are marked as safe; all other text is escaped
        style=Markup(_colours() + _resource("page.css")),
        script=Markup(script),
        policy=_policy(script, framed=any(document.aside.viewer for document in documents)),
    )
    return page


def to_fragment(documents: Sequence[Document]) -> str:
    """Return documents as HTML for a notebook, without the style, script and pictures of a page."""
    check_pages()
    fragment: str = _template("fragment.html").render(documents=documents)
    return fragment


def check_pages() -> None:
    """Raise `MissingExtraError` if jinja2 is not installed. It is called before the contents of a page are computed."""
    try:
        import jinja2  # noqa: F401
    except ImportError:
        raise MissingExtraError("jinja2", "report", "a report in HTML") from None


@cache
def _template(name: str) -> Any:
    """Return a compiled template. The template is cached because compiling takes longer than rendering."""
    from jinja2 import Environment, FunctionLoader

    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, loader=FunctionLoader(_resource))
    filters: dict[str, Callable[..., Any]] = {
        "is_web": is_web,
        "is_cited": lambda cell: isinstance(cell, CitedText),
        "with_code": _with_code,
        "on_paper": _on_paper,
    }
    environment.filters |= filters
    return environment.get_template(name)


def _on_paper(table: Table) -> list[Table]:
    """Return the strips of columns in which a table that is too wide for a sheet is printed; empty if it fits."""
    parts = list(strips(table, _ON_PAPER))
    return parts if len(parts) > 1 else []


def _with_code(line: str) -> Any:
    """Return a line as HTML, with text between backticks as code and all other text escaped."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", str(escape(line))))


def is_web(url: str) -> bool:
    """Return True if an address is an http or https address with a host, which may become a link."""
    try:
        parts = urlsplit(url)
    except ValueError:
        return False
    return parts.scheme in ("http", "https") and bool(parts.netloc)


def inline(svg: str, number: int) -> str:
    """Return an SVG document as an element of a page, with ids made unique by `number` and without a fixed size.

    Lengths in paths are cut to two decimals, because no screen or printer resolves a hundredth of a point.
    """
    element = re.sub(r'(?<=\sd=")[^"]*', lambda path: _LONG.sub(r"\1", path[0]), svg[svg.index("<svg") :])
    names = set(re.findall(r'\bid="([^"]+)"', element))

    def own(found: re.Match[str]) -> str:
        return f"{found[1]}p{number}-{found[2]}{found[3]}" if found[2] in names else found[0]

    # ids and both kinds of references to them must change together
    for pattern in (r'(\bid=")([^"]+)(")', r'(href="#)([^"]+)(")', r"(url\(#)([^)]+)(\))"):
        element = re.sub(pattern, own, element)
    head, rest = element.split(">", 1)
    # without a fixed size a picture scales with the page
    head = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return f'{head} role="img">{rest}'.strip()


def _anchors(document: Document, prefix: str) -> _Anchors:
    aside = document.aside
    sections = [section.title for section in (*document.sections, *aside.sections)]
    # the first picture of a report with a badge is in its opening
    shown = {"viewer": aside.viewer, "pictures": aside.pictures[1 if aside.badge and document.sections else 0 :]}
    first = [WORDS[key] for key, content in shown.items() if content]
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
    """Yield a unique anchor for each title: its words joined by hyphens, and a number if that anchor is taken."""
    seen: dict[str, int] = {}
    for title in titles:
        name = re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "section"
        seen[name] = seen.get(name, 0) + 1
        yield f"{prefix}{name}" + (f"-{seen[name]}" if seen[name] > 1 else "")


def _policy(script: str, framed: bool) -> str:
    """Return the content security policy of a page that loads nothing and runs its own script, known by its hash."""
    if framed:
        return _POLICY + _INTO_FRAMES
    return f"{_POLICY}'sha256-{b64encode(sha256(script.encode()).digest()).decode()}'"


def _colours() -> str:
    """Return the CSS variables of the light and dark palettes. The reader's operating system selects one palette."""
    light, dark = THEMES["light"].css, THEMES["dark"].css
    return f":root {{ {light} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {dark} }} }}\n"


def _resource(name: str) -> str:
    return resources.files(__package__).joinpath(name).read_text(encoding="utf-8")
