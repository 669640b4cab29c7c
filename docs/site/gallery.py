"""The shipped trains as pictures, pages in which they turn, and reports; the gallery's rows as cards.

All are made two trains at a time, and kept in build/gallery under the content they are made from: a second build makes
only what has changed. GEARTRAIN_GALLERY=NAME,NAME limits the gallery to some trains.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from hashlib import sha256
from multiprocessing import get_context
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
KEPT = ROOT / "build" / "gallery"
WORKERS = 2
_ROW = re.compile(r"^\| ([\w.-]+) \| (.*?) \| (.*?) \| (.*?) \|$", re.MULTILINE)
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


def _cards(rows: str) -> Iterator[str]:
    yield '<div class="grid cards" markdown>\n\n'
    for name, title, verdict, outputs in _ROW.findall(rows):
        if f"view/{name}.html" in make():
            kinds = [kind for kind in ("plan", "dials") if f"{kind}/{name}.png" in make()]
            pictures = " ".join(f"[![{kind} of {name}]({kind}/{name}.png)](view/{name}.html)" for kind in kinds)
            links = f"[turn it](view/{name}.html) · [report](report/{name}.html)"
            yield f"-   {pictures}\n\n    **{name}**: {title}\n\n    {verdict}: {outputs}\n\n    {links}\n\n"
        else:
            yield f"-   **{name}**: {title}\n\n    {verdict}: {outputs}\n\n"
    yield "</div>\n"


def _trains() -> list[Path]:
    wanted = set(filter(None, os.environ.get("GEARTRAIN_GALLERY", "").split(",")))
    paths = sorted((ROOT / "trains").glob("*/*.yaml"))
    unknown = wanted - {path.stem for path in paths}
    if unknown:
        raise SystemExit(f"GEARTRAIN_GALLERY names no shipped train: {', '.join(sorted(unknown))}")
    return [path for path in paths if not wanted or path.stem in wanted]


def _key(path: Path) -> str:
    """A digest of the program, and of the train and all it may extend."""
    digest = sha256(_program())
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
    from geartrain.report.document import Picture
    from geartrain.report.html_page import to_html
    from geartrain.report.shared_page import describe_shared_page
    from geartrain.report.train_data import collect_report
    from geartrain.scene import make_scene
    from geartrain.viewer import page

    train = geartrain.load(name)
    captions = {"plan": "The plan, to scale"} | ({"dials": "The dials"} if train.declaration.dials else {})
    pictures = []
    for kind, caption in captions.items():
        figure = picture(train, kind)
        pictures.append(Picture(caption, render(figure, ".svg").decode("utf-8")))
        yield f"{kind}/{name}.png", render(figure, ".png", dots=72)
    yield f"report/{name}.html", to_html([describe_shared_page(collect_report(train), pictures)]).encode("utf-8")
    yield f"view/{name}.html", page([make_scene(train, state) for state in train.states or (None,)]).encode("utf-8")
