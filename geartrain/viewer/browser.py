"""The browser that draws pages where nobody looks: Chromium, as it is found on this machine."""

from __future__ import annotations

import asyncio
import os
import shutil
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

from geartrain.errors import MissingExtraError, Problem, QuestionError

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserType

Made = TypeVar("Made")

NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
ASKED = "GEARTRAIN_BROWSER"
"""The variable of the environment that names another program."""

SWITCHES = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-gpu-compositing",  # only what a page draws in 3D needs the software GPU
    "--disable-extensions",
)


def find_browser() -> str | None:
    """The browser's program: that of GEARTRAIN_BROWSER, else the first on the path; None where there is none."""
    asked = os.environ.get(ASKED)
    return shutil.which(asked) if asked else next(filter(None, map(shutil.which, NAMES)), None)


def check_browser() -> None:
    """Make sure that pages can be drawn, before anything is worked out.

    Raises
    ------
    MissingExtraError
        Where playwright is not installed.
    QuestionError
        Where there is no browser.
    """
    if not outside_of_loops(_is_there):
        raise _no_browser()


def outside_of_loops(make: Callable[[], Made]) -> Made:
    """What drives the browser waits in its own way, and may not where a notebook's loop runs: then elsewhere."""
    try:
        asyncio.get_running_loop()
        inside = True
    except RuntimeError:
        inside = False
    if not inside:
        return make()
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(make).result()


def _is_there() -> bool:
    with _playwright() as (chromium, program):
        return os.path.exists(program or chromium.executable_path)


@contextmanager
def open_browser() -> Iterator[Browser]:
    """A running browser, which ends with the block. Raises as `check_browser` does."""
    from playwright.sync_api import Error

    with _playwright() as (chromium, program):
        try:
            running = chromium.launch(executable_path=program, args=list(SWITCHES))
        except Error as error:
            raise _no_browser(str(error).strip().partition("\n")[0]) from None
        try:
            yield running
        finally:
            running.close()


@contextmanager
def _playwright() -> Iterator[tuple[BrowserType, str | None]]:
    """What starts browsers, and the program that this machine or its user names."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise MissingExtraError("playwright", "film", "a picture of the turning train") from None
    program = find_browser()
    if program is None and os.environ.get(ASKED):
        raise _no_browser(f"{ASKED} names '{os.environ[ASKED]}', and there is no such program")
    with sync_playwright() as found:
        yield found.chromium, program


def _no_browser(why: str = "") -> QuestionError:
    looked = f"none of {', '.join(NAMES)} is on the path, {ASKED} names none, and playwright has none of its own"
    fix = f"playwright install chromium, or name one: {ASKED}=/path/to/chromium"
    return QuestionError(Problem("no browser draws the train", why or looked, fix))
