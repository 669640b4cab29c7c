"""Take the stills of the diagrams that readers drag: `python docs/scripts/make_diagrams.py`. It takes a browser.

Each is the picture that the diagram itself draws when its page is opened, with the numbers under it.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from playwright.sync_api import Page
from stills import open_browser

DOCS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(DOCS / "scripts" / "site"))

import diagrams  # noqa: E402  # it is found in the folder of the site's makers

LINE = 24  # of the numbers below a picture


def main() -> None:
    """Write the stills of all kinds."""
    with open_browser() as browser:
        page = browser.new_page()
        for kind in diagrams.KINDS:
            (DOCS / "images" / f"diagram-{kind}.svg").write_text(still(page, kind), encoding="utf-8")
            print(f"wrote docs/images/diagram-{kind}.svg")


def still(page: Page, kind: str) -> str:
    """The picture of a diagram as its page opens, as SVG that stands alone."""
    script, style = (path.read_text(encoding="utf-8") for path in diagrams.files().values())
    page.goto("about:blank")  # where no element is defined yet
    page.set_content(f"<style>{style}</style>{diagrams.element(kind, '')}<script>{script}</script>")
    page.wait_for_selector(".gd-alive", state="attached")
    taken = page.evaluate((DOCS / "scripts" / "site" / "take_still.js").read_text(encoding="utf-8"), [_style(), LINE])
    return f"{taken}\n"


def _style() -> str:
    """How what is drawn looks, in few letters."""
    text = "".join((diagrams.SOURCES / name).read_text(encoding="utf-8") for name in ("light.css", "picture.css"))
    return re.sub(r"\s*([{};:,])\s*", r"\1", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)).strip()


if __name__ == "__main__":
    main()
