"""Pictures of the pages that a reader drags: where `<!-- diagram: KIND -->` stands above a picture, the diagram that
draws it moves there in the site. Elsewhere, without scripts and in print the picture stays, which
`docs/scripts/make_diagrams.py` takes of the diagram.

A diagram is a few lines of the viewer's own program (geartrain/viewer/src/diagrams) with data of `diagram_data`.
"""

from __future__ import annotations

import json
import re
from functools import cache
from html import escape
from pathlib import Path

import diagram_data

ROOT = Path(__file__).resolve().parents[3]
BUILT = ROOT / "geartrain" / "viewer" / "built"
SOURCES = ROOT / "geartrain" / "viewer" / "src" / "diagrams"
KINDS = ("circuits", "closure", "differential", "locking", "pin", "teeth", "willis")
FILES = ("diagrams.js", "diagrams.css")
_MARK = re.compile(r"<!-- diagram: (\w+) -->\s*<p>(<img [^>]*>)</p>")


def files() -> dict[str, Path]:
    """What pages with diagrams load, by its name in the site."""
    return {f"diagrams/{name}": BUILT / name for name in FILES}


@cache
def data_text(kind: str) -> str:
    """The data of a diagram as they stand in a script element."""
    text = json.dumps(getattr(diagram_data, kind)(), ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    # signs that could end or start a script element mean the same as numbers
    return re.sub("[<>&\u2028\u2029]", lambda sign: f"\\u{ord(sign[0]):04x}", text)


def element(kind: str, still: str) -> str:
    """The element of a diagram; `still` is what it shows without scripts."""
    data = f'<script type="application/json">{data_text(kind)}</script>'
    return f'<gear-diagram kind="{escape(kind)}">{data}{still}</gear-diagram>'


def with_diagrams(html: str, base: str) -> str:
    """A page with its diagrams; `base` leads from it to the top of the site."""
    found, count = _MARK.subn(lambda mark: element(mark[1], mark[2]), html)
    if not count:
        return html
    folder = f"{base}/diagrams"
    style = f'<link rel="stylesheet" href="{folder}/diagrams.css">'
    return f'{found}{style}<script src="{folder}/diagrams.js" defer></script>'
