"""The shipped trains as pictures, films, pages in which they turn, and reports; the gallery's rows as cards.

Where there is a browser that draws, a card is a picture that turns under the pointer; elsewhere the train's plan.
All are made two trains at a time, and kept in build/gallery under the content they are made from: a second build makes
only what has changed. GEARTRAIN_GALLERY=NAME,NAME limits the gallery to some trains.
"""

from __future__ import annotations

import logging
import os
import re
import shutil
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from functools import cache
from hashlib import sha256
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING

ROOT = Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "docs" / "scripts"))

from stills import can_draw, pace_of, stills, webp  # noqa: E402  # it is found in the folder of the documentation's scripts

if TYPE_CHECKING:
    from geartrain.scene import Scene

KEPT = ROOT / "build" / "gallery"
WORKERS = 2
SIZE, RATE, COUNT = (320, 240), 10, 30  # of films: px, pictures a second, pictures
AT = Fraction(1, 3)  # turns of the lead where they begin: pointers stand apart then
_log = logging.getLogger("mkdocs.hooks")
_ROW = re.compile(r"^\| ([\w.-]+) \| (.*?) \| (.*?) \|$", re.MULTILINE)
_FRAME = re.compile(r"^<!-- turning: ([\w.-]+) -->\n(.*)$", re.MULTILINE)
_TABLE = re.compile(r"^\| train \| .*\n\|---.*\n((?:\|.*\n?)+)", re.MULTILINE)


@cache
def make() -> dict[str, Path]:
    """Make what is missing; files by the name they get in the site."""
    todo = {path.stem: KEPT / f"{path.stem}-{_key(path)}" for path in _trains()}
    missing = [(name, folder) for name, folder in todo.items() if not folder.is_dir()]
    if missing:
        KEPT.mkdir(parents=True, exist_ok=True)
        with ProcessPoolExecutor(WORKERS, mp_context=get_context("fork")) as pool:
            list(pool.map(_make, *zip(*missing, strict=True)))
    return {
        f"{kind.name}/{file.name}": file
        for folder in todo.values()
        for kind in folder.iterdir()
        for file in kind.iterdir()
    }


def with_cards(markdown: str) -> str:
    """Tables of trains as cards; other tables stay."""
    return _TABLE.sub(lambda found: "".join(_cards(found[1])), markdown)


def with_frames(markdown: str) -> str:
    """Return the text with the pages of marked trains in frames; a picture below a mark stays where no page is made."""
    return _FRAME.sub(lambda found: _frame(found[1]) or found[2], markdown)


def _frame(name: str) -> str:
    """A train that turns in the page; nothing where its page is not made."""
    if f"view/{name}.html" not in make():
        return ""
    from geartrain.viewer.viewer_page import frame_of

    line = frame_of(f"view/{name}.html", f"{name}, turning").replace(".html", ".html#embed", 1)
    return f'<div class="turning-frame">{line}</div>'


def _thumbnail(name: str) -> str:
    """A picture that turns under the pointer, or the plan, and opens the train's page."""
    if f"still/{name}.webp" not in make():
        return f"[![plan of {name}](plan/{name}.png){{loading=lazy}}](view/{name}.html){{title={name}}}"
    film = f" style=\"--film:url('film/{name}.webp')\"" if f"film/{name}.webp" in make() else ""
    return f"[![{name}](still/{name}.webp){{loading=lazy}}](view/{name}.html){{.turning title={name}{film}}}"


def _cards(rows: str) -> Iterator[str]:
    yield '<div class="grid cards" markdown>\n\n'
    for name, title, outputs in _ROW.findall(rows):
        if f"view/{name}.html" in make():
            files = [("plan", f"plan/{name}.png"), ("dials", f"dials/{name}.png"), ("report", f"report/{name}.html")]
            links = " · ".join(f"[{word}]({file})" for word, file in files if file in make())
            yield f"-   {_thumbnail(name)}\n\n    **{name}**: {title}\n\n    {outputs}\n\n"
            yield f"    [turn it](view/{name}.html) · {links}\n\n"
        else:
            yield f"-   **{name}**: {title}\n\n    {outputs}\n\n"
    yield "</div>\n"


def _trains() -> list[Path]:
    wanted = set(filter(None, os.environ.get("GEARTRAIN_GALLERY", "").split(",")))
    from geartrain import shipped

    paths = sorted(shipped().values())
    unknown = wanted - {path.stem for path in paths}
    if unknown:
        raise SystemExit(f"GEARTRAIN_GALLERY names no shipped train: {', '.join(sorted(unknown))}")
    return [path for path in paths if not wanted or path.stem in wanted]


def _key(path: Path) -> str:
    """A digest of the program, and of the train and all it may extend."""
    digest = sha256(_program() + Path(__file__).read_bytes() + bytes(_draws()))
    for file in sorted(path.parent.glob("*.yaml")):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


@cache
def _program() -> bytes:
    digest = sha256()
    for file in sorted((ROOT / "geartrain").rglob("*")):
        if file.is_file() and file.suffix != ".pyc" and "node_modules" not in file.parts:
            digest.update(file.read_bytes())
    return digest.digest()


def _make(name: str, folder: Path) -> None:
    """Everything of one train into its folder, which appears when it is whole."""
    unfinished = folder.with_suffix(f".{os.getpid()}")
    for file, data in _files(name):
        (unfinished / file).parent.mkdir(parents=True, exist_ok=True)
        (unfinished / file).write_bytes(data)
    for old in folder.parent.glob(f"{name}-{'?' * 16}"):
        shutil.rmtree(old)
    try:
        unfinished.rename(folder)
    except OSError:  # somebody else was faster
        shutil.rmtree(unfinished)


def _files(name: str) -> Iterator[tuple[str, bytes]]:
    """As `geartrain draw`, `view` and `report` write them; each picture is drawn once."""
    import geartrain
    from geartrain.drawing import picture, render
    from geartrain.report import Picture, collect_report, to_html
    from geartrain.report.train_report import describe_shared_page
    from geartrain.scene import build_scene
    from geartrain.viewer import page

    train = geartrain.load(name)
    captions = {"plan": "The plan, to scale"} | ({"dials": "The dials"} if train.declaration.dials else {})
    pictures = []
    for kind, caption in captions.items():
        figure = picture(train, kind)
        pictures.append(Picture(caption, render(figure, ".svg").decode("utf-8")))
        yield f"{kind}/{name}.png", render(figure, ".png", dots=72)
    yield f"report/{name}.html", to_html([describe_shared_page(collect_report(train), pictures)]).encode("utf-8")
    scenes = [build_scene(train, state) for state in train.states or (None,)]
    yield f"view/{name}.html", page(scenes).encode("utf-8")
    yield from _moving(name, next((each for each in scenes if each.movement.kind != "still"), scenes[0]))


def _moving(name: str, scene: Scene) -> Iterator[tuple[str, bytes]]:
    """A still and a film of a train, where there is what draws them; of what stands the still alone."""
    if not _draws():
        return
    moves = scene.movement.kind != "still"
    step = pace_of(scene, RATE) / RATE
    pictures = list(stills(scene, SIZE, [AT + step * n for n in range(COUNT if moves else 1)]))
    yield f"still/{name}.webp", webp(pictures[:1])
    if moves:
        yield f"film/{name}.webp", webp(pictures, RATE)


@cache
def _draws() -> bool:
    found = can_draw()
    if not found:
        _log.info("the gallery shows plans in place of turning trains: there is no browser that draws them")
    return found
