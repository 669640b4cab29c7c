"""Pages drawn where nobody looks: Chromium as it is found on this machine, and pictures and films of a train in it.

No clock is read: the crank is set to the exact turns of each picture, which is drawn at once and taken as a PNG, so
that the same question gives the same frames. It takes playwright and pillow, which come with the extra `dev`.
"""

from __future__ import annotations

import io
import os
import shutil
import time
from base64 import b64decode
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from geartrain.viewer import page

if TYPE_CHECKING:
    from PIL.Image import Image
    from playwright.sync_api import Browser, Page

    from geartrain.scene import Scene

NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
REQUESTED = "GEARTRAIN_BROWSER"
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

_PATIENCE = 180  # s: software draws slowly on a busy machine
_PACE = Fraction(1, 4)  # turns a second of what turns fastest: an eye can follow its teeth
_STEP = Fraction(2, 5)  # teeth that pass from one picture to the next: from a half on they seem to go backwards
_SAMPLES, _COLOURS = 8, 256  # pictures from which the colours of a GIF are chosen

# the page's canvas alone, as large as the window, from where a reader sees it first
_BARE = """(background) => {
  const [stage] = globalThis["geartrain"].stages;
  Object.assign(stage.canvas.style, {position: 'fixed', inset: 0, width: '100%', height: '100%'});
  document.body.replaceChildren(stage.canvas);
  stage.theme({background});
  stage.resize();
}"""
# in one task: the next one finds the canvas empty
_STILL = """(turns) => {
  const {stages: [stage], setTurns} = globalThis["geartrain"];
  setTurns(turns);
  stage.render();
  return stage.canvas.toDataURL('image/png');
}"""


def find_browser() -> str | None:
    """The browser's program: that of GEARTRAIN_BROWSER, else the first on the path; None if there is none."""
    requested = os.environ.get(REQUESTED)
    return shutil.which(requested) if requested else next(filter(None, map(shutil.which, NAMES)), None)


def can_draw() -> bool:
    """Whether playwright is installed and there is a browser, on the path or playwright's own."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        return False
    if os.environ.get(REQUESTED) or find_browser():
        return find_browser() is not None
    with sync_playwright() as playwright:
        return os.path.exists(playwright.chromium.executable_path)


@contextmanager
def open_browser() -> Iterator[Browser]:
    """A running browser, playwright's own if none is on the path; it ends with the block."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=find_browser(), args=list(SWITCHES))
        try:
            yield running
        finally:
            running.close()


def visit(sheet: Page, address: str, ready: str) -> None:
    """Open a page and wait until an expression is true in it; its policy forbids playwright's own way to wait."""
    sheet.set_default_timeout(1e3 * _PATIENCE)
    sheet.goto(address)
    end = time.monotonic() + _PATIENCE
    while not sheet.evaluate(ready):
        if time.monotonic() > end:
            raise TimeoutError(address)
        time.sleep(0.05)


def stills(
    scene: Scene, size: tuple[int, int], turns: Sequence[Fraction], background: str = "#f4f1ea"
) -> Iterator[bytes]:
    """A PNG for each number of turns of the lead."""
    width, height = size
    with TemporaryDirectory() as folder, open_browser() as browser:
        path = Path(folder) / "page.html"
        path.write_text(page([scene]), encoding="utf-8")
        sheet = browser.new_page(
            viewport={"width": width, "height": height}, device_scale_factor=1, reduced_motion="reduce"
        )
        visit(sheet, path.as_uri(), "Boolean(globalThis.geartrain?.ready)")
        sheet.evaluate(_BARE, background)
        for each in turns:
            data: str = sheet.evaluate(_STILL, str(each))
            yield b64decode(data.partition(",")[2])


def pace_of(scene: Scene, fps: int) -> Fraction:
    """Turns of the lead a second at which an eye can follow what turns, and a film shows which way teeth go."""
    speeds = [abs(Fraction(body.speed or 0)) for body in scene.bodies]
    teeth = max((wheel.teeth * speeds[wheel.body] for wheel in scene.wheels), default=0)
    limits = [_PACE / max(speeds)] if any(speeds) else [_PACE]
    return min([*limits, _STEP * fps / teeth] if teeth else limits)


def gif(pictures: Sequence[bytes], fps: int) -> bytes:
    """A film that begins again at its end.

    It has one palette for all pictures, so that nothing at rest flickers, and no dither, so that what rests is stored
    once.
    """
    from PIL import Image as Images

    images = [_image(each) for each in pictures]
    some = images[:: max(1, len(images) // _SAMPLES)]
    width, height = images[0].size
    sheet = Images.new("RGB", (width, height * len(some)))
    for n, image in enumerate(some):
        sheet.paste(image, (0, n * height))
    palette = sheet.quantize(_COLOURS)
    first, *rest = (image.quantize(palette=palette, dither=Images.Dither.NONE) for image in images)
    ends = [round(100 * n / fps) for n in range(len(images) + 1)]  # a GIF counts time in hundredths of a second
    times = [10 * (end - begin) for begin, end in pairwise(ends)]
    out = io.BytesIO()
    first.save(out, "GIF", save_all=True, append_images=rest, duration=times, loop=0, optimize=True)
    return out.getvalue()


def webp(pictures: Sequence[bytes], fps: int = 1) -> bytes:
    """A picture, or a film that begins again at its end."""
    first, *rest = (_image(each) for each in pictures)
    out = io.BytesIO()
    film = {"save_all": True, "append_images": rest, "duration": round(1000 / fps), "loop": 0} if rest else {}
    first.save(out, "WEBP", quality=80, **film)
    return out.getvalue()


def _image(picture: bytes) -> Image:
    from PIL import Image as Images

    return Images.open(io.BytesIO(picture)).convert("RGB")
