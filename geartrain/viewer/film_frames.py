"""Scenes to pictures and films: a browser draws each moment by itself, so that the same question gives the same frames.

No clock is read: the crank is set to the exact turns of each picture, which is drawn at once and taken as a PNG.
"""

from __future__ import annotations

from base64 import b64decode
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from geartrain.errors import Problem, QuestionError
from geartrain.viewer.browser import open_browser, outside_of_loops
from geartrain.viewer.film_formats import FORMATS, check_format, mixed
from geartrain.viewer.film_parts import FilmPart, film_parts
from geartrain.viewer.shot import Shot
from geartrain.viewer.viewer_page import page

if TYPE_CHECKING:
    from playwright.sync_api import Page

    from geartrain.scene import Scene

OnFrame = Callable[[], object]

_FADE = 0.4  # s
_PATIENCE = 180_000  # ms: software draws slowly on a busy machine


def film(
    scene: Scene | Sequence[Scene], suffix: str, shot: Shot | None = None, on_frame: OnFrame = lambda: None
) -> bytes:
    """A picture or a film of a scene, or a film of several one after another, as the file that holds it.

    Parameters
    ----------
    scene : Scene or sequence of Scene
        What turns; several are states of one train, each shown for the shot's turns and seconds with its name.
    suffix : {".png", ".gif", ".webp", ".mp4"}
        A picture, or a film of what form; those of GIF and WebP begin again at the end.
    shot : Shot, optional
        What is shown.
    on_frame : callable
        Called after each picture.

    Returns
    -------
    bytes
        The file.

    Raises
    ------
    MissingExtraError
        Where what draws or packs is not installed.
    QuestionError
        Where there is no browser, it has no WebGL, nothing moves, or the shot does not fit the form.

    Examples
    --------
    >>> import geartrain
    >>> from geartrain.scene import make_scene
    >>> film(make_scene(geartrain.load("worm")), ".bmp")
    Traceback (most recent call last):
    ...
    geartrain.errors.QuestionError: no picture and no film
      why: the suffix says how it is packed, and '.bmp' is none
      fix: did you mean '.mp4' or '.webp'?
    """
    shot = shot or Shot()
    check_format(suffix, shot)
    scenes = scene if isinstance(scene, Sequence) else [scene]
    if suffix != ".png":
        parts = film_parts(scenes, shot)
    elif len(scenes) == 1:
        parts = [FilmPart(scenes[0], [(shot.at, shot.turntable)])]
    else:
        why = "a picture shows one moment"
        raise QuestionError(Problem(f"a picture of {len(scenes)} states", why, "make a film, or ask for one state"))

    def made() -> bytes:
        return FORMATS[suffix](_told(frames(parts, shot), on_frame), shot)

    return outside_of_loops(made)


def frames(parts: Sequence[FilmPart], shot: Shot) -> Iterator[bytes]:
    """A PNG for each moment of each part; the last one of a part fades into the next part."""
    html = page([part.scene for part in parts], teeth=shot.teeth, shown="film")
    with TemporaryDirectory() as folder, open_browser() as browser:
        path = Path(folder) / "film.html"
        path.write_text(html, encoding="utf-8")
        width, height = shot.size
        sheet = browser.new_page(viewport={"width": width, "height": height}, device_scale_factor=1)
        sheet.set_default_timeout(_PATIENCE)
        sheet.goto(path.as_uri())
        before = b""
        for at, part in enumerate(parts):
            if at:
                sheet.evaluate("(at) => geartrain.film.open(at)", at)
            _prepare(sheet, shot, part.words)
            fade = min(round(_FADE * shot.fps), len(part.moments) // 4) if at else 0
            for n, (turns, orbit) in enumerate(part.moments, 1):
                picture = _picture(sheet, str(turns), orbit)
                yield mixed(before, picture, n / (fade + 1)) if n <= fade else picture
            before = picture


def _prepare(sheet: Page, shot: Shot, words: tuple[str, str] | None) -> None:
    """The page, ready and set, with words over its pictures.

    Raises `QuestionError` where it shows no picture, or knows no such colour.
    """
    if not sheet.evaluate("Boolean(geartrain.film)"):
        why = "it has no WebGL, which draws in three dimensions"
        raise QuestionError(Problem("the browser draws no train", why, "use another one, or update it"))
    if not sheet.evaluate("(colour) => CSS.supports('color', colour)", shot.background):
        why, fix = "CSS knows no such colour", "give one such as white, #f4f1ea or rgb(20 20 20)"
        raise QuestionError(Problem(f"'{shot.background}' is no background", why, fix))
    wanted = {name: getattr(shot, name) for name in ("look", "background", "apart", "cutaway")}
    wanted |= {"turntable": bool(shot.turntable), "words": words}
    sheet.evaluate("(wanted) => geartrain.film.set(wanted)", wanted)


def _picture(sheet: Page, turns: str, orbit: float) -> bytes:
    data: str = sheet.evaluate("([turns, orbit]) => geartrain.film.still(turns, orbit)", [turns, orbit])
    return b64decode(data.partition(",")[2])


def _told(pictures: Iterator[bytes], on_frame: OnFrame) -> Iterator[bytes]:
    for each in pictures:
        yield each
        on_frame()
