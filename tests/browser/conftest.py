"""Browser for the pages: headless Chromium with software WebGL, which records messages and requests of pages."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("playwright", reason="playwright is not installed: no page is tested in a browser")

from playwright.sync_api import Browser, ConsoleMessage, Error, Page, Request, sync_playwright
from stills import NAMES, SWITCHES, find_browser
from viewing import DESK, GALLERY, Opening, html_of, wait

ROOT = Path(__file__).parent.parent.parent
PATIENCE = 90_000  # ms: software rendering is slow on a busy machine


def pytest_configure(config: pytest.Config) -> None:
    # playwright closes its event loop and pipes only when the interpreter exits
    config.addinivalue_line("filterwarnings", "ignore::pytest.PytestUnraisableExceptionWarning")


@dataclass
class Shown:
    """Page in the browser, with the `errors` and warnings that it logged, and the addresses that it requested."""

    page: Page
    errors: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def run(self, script: str, argument: Any = None) -> Any:
        """Return the value of an expression, or of a function of `argument`, in the page."""
        return self.page.evaluate(script, argument)

    def angles(self, turns: Sequence[str | float], outputs: Sequence[str]) -> list[list[float]]:
        """Return the angles of outputs [rad] for each number of turns of the driving link, in one call."""
        script = """([turns, outputs]) => turns.map((each) => {
          geartrain.setTurns(each);
          return outputs.map((name) => geartrain.pointer(0, name).angle);
        })"""
        return [[float(angle) for angle in row] for row in self.run(script, [list(turns), list(outputs)])]


OpenPage = Callable[..., Shown]
OpenWindow = Callable[..., Page]


@pytest.fixture(scope="session")
def program() -> str:
    """Executable of the browser; tests that need it are skipped without it."""
    found = find_browser()
    if found is None:
        why = f"no browser: none of {', '.join(NAMES)} is on the path, and GEARTRAIN_BROWSER names none"
        if os.environ.get("GEARTRAIN_REQUIRE_BROWSER"):
            pytest.fail(why)
        pytest.skip(why)
    return found


@pytest.fixture(scope="session")
def browser(program: str) -> Iterator[Browser]:
    """One browser for all tests of a process."""
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=program, args=list(SWITCHES))
        yield running
        running.close()


@pytest.fixture
def open_window(browser: Browser) -> Iterator[OpenWindow]:
    """Function that opens an empty page in a window, which is closed after the test.

    Reduced motion is preferred unless the arguments say otherwise: software rendering of a train in motion takes the
    whole of a core.
    """
    contexts = []

    def opened(**window: Any) -> Page:
        contexts.append(browser.new_context(**({"reduced_motion": "reduce"} | window)))
        return contexts[-1].new_page()

    yield opened
    for context in contexts:
        context.close()


@pytest.fixture
def open_page(open_window: OpenWindow) -> OpenPage:
    """Function that opens a file after running a script, and sets it to 0 turns unless `opening` is True; further
    arguments are those of the window.
    """

    def show(path: Path, before: str = "", opening: bool = False, **window: Any) -> Shown:
        sheet = open_window(**({"viewport": {"width": 900, "height": 640}} | window))
        sheet.add_init_script(before)
        sheet.set_default_timeout(PATIENCE)
        shown, address = Shown(sheet), path.resolve().as_uri()
        _listen(shown, address)
        sheet.goto(address)
        wait(shown, "Boolean(globalThis.geartrain?.ready)")
        if not opening:
            shown.run("globalThis.geartrain.setTurns?.('0')")
        return shown

    return show


@pytest.fixture
def show_html(open_page: OpenPage, tmp_path: Path) -> OpenPage:
    """Function that opens a page from its HTML."""

    def opened(html: str, **window: Any) -> Shown:
        path = tmp_path / "page.html"
        path.write_text(html, encoding="utf-8")
        return open_page(path, **(DESK | window))

    return opened


@pytest.fixture
def show(show_html: OpenPage) -> Opening:
    """Function that opens the page of shipped trains, or of a declaration, in all their states."""

    def opened(
        *names: str, text: str | None = None, compare: bool = False, teeth: bool = False, **window: Any
    ) -> Shown:
        return show_html(html_of(names or (str(text),), compare, teeth), **window)

    return opened


def _listen(shown: Shown, address: str) -> None:
    def heard(message: ConsoleMessage) -> None:
        if message.type in ("error", "warning") and not _is_of_the_driver(message.text):
            shown.errors.append(message.text)

    def failed(error: Error) -> None:
        shown.errors.append(str(error))

    def requested(request: Request) -> None:
        if not request.url.startswith((address, "data:", "blob:")):
            shown.requests.append(request.url)

    shown.page.on("console", heard)
    shown.page.on("pageerror", failed)
    shown.page.on("request", requested)


def _is_of_the_driver(text: str) -> bool:
    """Return True for warnings of software rendering, which a page does not cause."""
    return "GL Driver Message" in text or "GPU stall" in text


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the site."""
    folder = tmp_path_factory.mktemp("site")
    environment = os.environ | {"GEARTRAIN_GALLERY": ",".join(GALLERY), "NO_MKDOCS_2_WARNING": "1"}
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder
