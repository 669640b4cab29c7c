"""Scenes to one self-contained page: nothing is fetched, and no name in a train is ever read as HTML."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from html import escape
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Literal
from urllib.parse import quote

from geartrain.errors import Problem, QuestionError
from geartrain.scene import Scene, build_scene

if TYPE_CHECKING:
    from geartrain.analysis.gear_train import GearTrain

Shown = Literal["page", "embed", "kiosk"]
"""How a page shows a train."""

_IN_SCRIPTS: dict[str, str | int | None] = {
    "<": "\\u003c",
    ">": "\\u003e",
    "&": "\\u0026",
    "\u2028": "\\u2028",
    "\u2029": "\\u2029",
}
"""Letters that could end a script element, or start another; within JSON their escapes mean the same."""


_AS_NUMBERS = {ord(letter): f"&#{ord(letter)};" for letter in "\n\t$\\`"}


def page(
    scenes: Sequence[Scene], compare: bool = False, title: str | None = None, teeth: bool = True, shown: Shown = "page"
) -> str:
    """One self-contained page of HTML that shows trains turning; it works from a file and asks the network for nothing.

    Parameters
    ----------
    scenes : sequence of Scene
        What is shown, one or more; without `compare` the reader chooses among them.
    compare : bool
        The first two scenes side by side, with one crank.
    title : str, optional
        Of the page; default the names of the trains.
    teeth : bool
        False draws plain discs until the reader wants teeth.
    shown : {"page", "embed", "kiosk"}
        The whole page, or the picture with three buttons, for a frame in another page or for a museum's screen.

    Returns
    -------
    str
        The whole document. No name in a train is read as HTML in it.

    Raises
    ------
    QuestionError
        If there is no scene, or `compare` has fewer than two.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import build_scene
    >>> html = page([build_scene(geartrain.load("planetary-24-18-60"))])
    >>> "planetary-24-18-60" in html, "connect-src" in html, 'src="http' in html
    (True, True, False)
    """
    if len(scenes) < 1 + compare:
        raise QuestionError(Problem("too few scenes for a page", f"it was given {len(scenes)}", "give it one, or two"))
    options = {"compare": compare, "teeth": teeth} | ({} if shown == "page" else {"shown": shown})
    data = {"scenes": [scene.to_dict() for scene in scenes], "options": options}
    program = _built("viewer.js")
    return Template(_part("page.html")).substitute(
        policy=escape(_policy(program)),
        title=escape(title or _names(scenes)),
        style=_built("viewer.css"),
        verdicts="\n".join(_words(scene) for scene in scenes),
        data=json_in_script(data),
        program=program,
    )


def train_page(train: GearTrain, state: str | None = None) -> str:
    """The page of one train: in one of its states, or in all of them, to be chosen among.

    Parameters
    ----------
    train : GearTrain
        What turns.
    state : str, optional
        One of its states.

    Returns
    -------
    str
        As `page` gives it.

    Examples
    --------
    >>> import geartrain
    >>> "sun fixed" in train_page(geartrain.load("planetary"))
    True
    """
    return page(
        [
            build_scene(train, each, formulas=True)
            for each in ((state,) if state is not None else train.states or (None,))
        ]
    )


@dataclass(frozen=True)
class EmbeddedPage:
    """A page of a train that turns, within another page: a notebook shows it as it is.

    Examples
    --------
    >>> import geartrain
    >>> "<iframe" in EmbeddedPage(geartrain.load("worm"))._repr_html_()
    True
    """

    train: GearTrain
    """What turns."""
    state: str | None = None
    """One of its states; by default all, to be chosen among."""
    height: int = 620
    """Of the frame [px]."""

    def _repr_html_(self) -> str:
        # the script counts by the letter: what shows this may join lines, widen tabs and read formulas
        inner = escape(train_page(self.train, self.state)).translate(_AS_NUMBERS)
        style = f"width:100%;height:{self.height}px;border:0"
        return f'<iframe title="{escape(self.train.name)}, turning" style="{style}" srcdoc="{inner}"></iframe>'


def frame_of(address: str, title: str, height: int = 480) -> str:
    """The line of HTML that shows a page of a train within another page.

    Parameters
    ----------
    address : str
        Of the page, as seen from the one in which it is shown.
    title : str
        What it shows, for readers who do not see it.
    height : int
        Of the frame [px].

    Returns
    -------
    str
        An `iframe`.

    Examples
    --------
    >>> frame_of("worm.html", "A worm")
    '<iframe src="worm.html" title="A worm" style="width:100%;height:480px;border:0" loading="lazy"></iframe>'
    """
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe src="{escape(quote(address))}" title="{escape(title)}" style="{style}" loading="lazy"></iframe>'


def json_in_script(data: object) -> str:
    """JSON that can stand inside a script element, whatever its strings hold."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.translate(str.maketrans(_IN_SCRIPTS))


def _names(scenes: Sequence[Scene]) -> str:
    return " and ".join(dict.fromkeys(scene.name for scene in scenes))


def _words(scene: Scene) -> str:
    """What a reader without scripts is told."""
    state = f" ({scene.state})" if scene.state else ""
    verdict = scene.verdict.get("text", "")
    return f"<h1>{escape(scene.title or scene.name)}{escape(state)}</h1>\n<p>{escape(str(verdict))}</p>"


def _policy(program: str) -> str:
    """What the page may do: run its own script, be styled, and reach nothing."""
    return f"{own_script_only(program)}; img-src data: blob:; connect-src 'none'"


def own_script_only(program: str) -> str:
    """A content security policy that allows styles and one script, known by its hash; without images, connections."""
    digest = b64encode(sha256(program.encode("utf-8")).digest()).decode("ascii")
    allowed = f"script-src 'sha256-{digest}'; style-src 'unsafe-inline'"
    return f"default-src 'none'; {allowed}; base-uri 'none'; form-action 'none'"


def _built(name: str) -> str:
    """A file of the built viewer, as it stands between tags."""
    return _part(f"built/{name}").strip("\n")


def _part(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
