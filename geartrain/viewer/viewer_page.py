"""Conversion of scenes to a self-contained HTML page. All names of the train are escaped."""

from __future__ import annotations

import json
import zlib
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
"""Layout of the page: a whole page, a frame inside another page, or an exhibition screen."""

_AS_NUMBERS = {ord(letter): f"&#{ord(letter)};" for letter in "\n\t$\\`"}


def page(
    scenes: Sequence[Scene], compare: bool = False, title: str | None = None, teeth: bool = True, shown: Shown = "page"
) -> str:
    """Return a self-contained HTML page with animated trains. The page works as a local file and makes no network
    requests.

    Parameters
    ----------
    scenes : sequence of Scene
        Scenes to show, at least one. Without `compare`, the user selects one of them.
    compare : bool
        True to show the first two scenes side by side, driven by one crank.
    title : str, optional
        Title of the page; by default the names of the trains.
    teeth : bool
        False to draw plain discs until the user turns on the display of teeth.
    shown : {"page", "embed", "kiosk"}
        Layout: the whole page ("page"), or only the picture with three buttons, for a frame in another page ("embed")
        or for an exhibition screen ("kiosk").

    Returns
    -------
    str
        HTML document. Names in a train are escaped.

    Raises
    ------
    QuestionError
        If there are too few scenes: none, or fewer than two with `compare`.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import build_scene
    >>> html = page([build_scene(geartrain.load("planetary-24-18-60"))])
    >>> "planetary-24-18-60" in html, "connect-src" in html, 'src="http' in html
    (True, True, False)
    """
    if len(scenes) < 1 + compare:
        why = f"a page requires at least one scene, or two to compare, and the number given is {len(scenes)}"
        fix = "pass at least one scene, or at least two with compare=True"
        raise QuestionError(Problem("there are too few scenes for a page", why, fix))
    # the default layout needs no entry
    options = {"compare": compare, "teeth": teeth} | ({} if shown == "page" else {"shown": shown})
    data = {"scenes": [scene.to_dict() for scene in scenes], "options": options}
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))  # NaN is not valid JSON
    program = _built("viewer.js")
    policy = f"{own_script_only(program)}; img-src data: blob:; connect-src 'none'"  # no connections
    return Template(_part("page.html")).substitute(
        policy=escape(policy),
        title=escape(title or " and ".join(dict.fromkeys(scene.name for scene in scenes))),
        style=_built("viewer.css"),
        verdicts="\n".join(_words(scene) for scene in scenes),
        data=b64encode(zlib.compress(text.encode(), 9)).decode(),  # about a third of the length
        program=program,
    )


def train_page(train: GearTrain, state: str | None = None) -> str:
    """Return the HTML page of one train in the given state. If the state is None, the user can select any state."""
    states = (state,) if state is not None else train.states or (None,)
    return page([build_scene(train, each, formulas=True) for each in states])


@dataclass(frozen=True)
class EmbeddedPage:
    """Animated page of a train, which a notebook displays inside a frame."""

    train: GearTrain
    """Train that the page shows."""
    state: str | None = None
    """Name of the state that the page shows, or None to let the user select any state."""
    height: int = 620
    """Height of the frame [px]."""

    def _repr_html_(self) -> str:
        # the script is checked by its hash, but notebooks may join lines, expand tabs and interpret formulas
        inner = escape(train_page(self.train, self.state)).translate(_AS_NUMBERS)
        style = f"width:100%;height:{self.height}px;border:0"
        return f'<iframe title="{escape(self.train.name)}, turning" style="{style}" srcdoc="{inner}"></iframe>'


def frame_of(address: str, title: str, height: int = 480) -> str:
    """Return an HTML `iframe` element that shows the page of a train inside another page."""
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe src="{escape(quote(address))}" title="{escape(title)}" style="{style}" loading="lazy"></iframe>'


def _words(scene: Scene) -> str:
    """Return the HTML that is shown in browsers that do not run scripts: title, state and verdict of a scene."""
    state = f" ({scene.state})" if scene.state else ""
    verdict = scene.verdict.get("text", "")
    return f"<h1>{escape(scene.title or scene.name)}{escape(state)}</h1>\n<p>{escape(str(verdict))}</p>"


def own_script_only(program: str) -> str:
    """Return a content security policy that permits inline styles and one script (by its hash), but no images."""
    digest = b64encode(sha256(program.encode("utf-8")).digest()).decode("ascii")
    allowed = f"script-src 'sha256-{digest}'; style-src 'unsafe-inline'"
    return f"default-src 'none'; {allowed}; base-uri 'none'; form-action 'none'"


def _built(name: str) -> str:
    return _part(f"built/{name}").strip("\n")


def _part(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")
