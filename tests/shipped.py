"""Shipped trains, their reports, layouts and scenes, made once for all tests that only read them.

Layouts and scenes are also kept in pytest's cache, until a file of the package or of the trains changes.

A law that every shipped train satisfies is checked on twelve trains that differ in kind, and on all others with
`--slow`: `@pytest.mark.parametrize("name", shipped.every_train())`.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import shutil
import sys
from collections.abc import Callable, Container, Iterable
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.parse import quote
from uuid import uuid4

import pytest

import geartrain
from geartrain import GearTrain
from geartrain.report import TrainReport, collect_report
from geartrain.scene import Layout, Scene, build_scene, lay_out, make_scene

# together they have nearly every key of a declaration, every kind of wheel and coupling, and four tooth forms
KINDS = {
    "freeth-2021": "the largest: pins in slots and followers, contrate wheels, dials, an epoch, a train it extends",
    "pennestri-2002-missing": "tooth counts that are searched for, published speeds, errata",
    "longcase-clock-loaded": "a weight, an escapement, material and loads; the input is solved for",
    "bevel-differential-involute": "bevel wheels, several equal planets, involute teeth, states",
    "gm-4t60": "clutches and brakes, rings, published ratios of several states",
    "huygens-planetarium-1682": "a worm; axes with positions in space",
    "crossed-helical": "helical wheels on crossed axes",
    "cycloidal-reducer": "a pin ring with an eccentric disc, and pins in holes",
    "strain-wave": "a flexible wheel, and a coupling of parallel axes",
    "norton-compound": "a fixed link, efficiencies in both directions, a load",
    "moon-triangular-inertia": "triangular teeth, a pin in a slot, inertia, bearings",
    "lantern-mill": "a lantern with its wheel, friction",
}


def trains() -> list[str]:
    """Names of the shipped trains."""
    return list(geartrain.shipped())


def every_train(names: Iterable[str] | None = None, dear: Container[str] = ()) -> list[Any]:
    """Parameters of a test: some shipped trains, or all.

    Those outside `KINDS`, and dear ones, which take seconds each, only run with `--slow`.
    """
    known = trains() if names is None else names
    return [
        pytest.param(each, marks=[] if each in KINDS and each not in dear else [pytest.mark.slow]) for each in known
    ]


@cache
def train(name: str) -> GearTrain:
    """A shipped train."""
    return geartrain.load(name)


@cache
def report(name: str) -> TrainReport:
    """All that a report on it holds."""
    return collect_report(train(name))


class SceneCache:
    """Pickled scenes and layouts in a folder of a digest of what they are computed from.

    Workers of pytest-xdist and later runs share it. Files are replaced as a whole, so that none is read half written.
    """

    def __init__(self, folder: Path, digest: str) -> None:
        self.folder = folder / digest
        self.folder.mkdir(parents=True, exist_ok=True)
        for other in folder.iterdir():
            if other != self.folder:
                shutil.rmtree(other, ignore_errors=True)

    def get(self, key: tuple[str | None, ...], make: Callable[[], Any]) -> Any:
        """Return the object stored under a key, or else what `make` returns, which is then stored."""
        path = self.folder / quote(repr(key), safe="")
        try:
            return pickle.loads(path.read_bytes())
        except Exception:  # there is none, or it is damaged: unpickling then raises errors of any class
            made = make()
        part = path.with_name(f"{uuid4()}.part")
        with suppress(OSError):  # a later run, of changed files, has removed the folder
            part.write_bytes(pickle.dumps(made))
            part.replace(path)
        return made


def digest_of(*folders: Path) -> str:
    """Return a digest of the files in some folders, without the viewer's, and of the versions of Python and numpy."""
    found = hashlib.sha256(f"{sys.version} {version('numpy')}".encode())
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            place = path.relative_to(folder)
            if path.is_file() and not {"viewer", "__pycache__"} & set(place.parts):
                found.update(f"{place} {path.stat().st_size} ".encode() + path.read_bytes())
    return found.hexdigest()


@cache
def _disk() -> SceneCache | None:
    """The cache in the folder that conftest.py names, if pytest has a cache."""
    folder, package = os.environ.get("GEARTRAIN_SCENES"), Path(geartrain.__file__).parent
    return SceneCache(Path(folder), digest_of(package, package.parent / "trains")) if folder else None


def _stored(make: Callable[[], Any], *key: str | None) -> Any:
    disk = _disk()
    return make() if disk is None else disk.get(key, make)


@cache
def layout(name: str) -> Layout:
    """Where its axes and wheels stand."""
    found: Layout = _stored(lambda: lay_out(train(name)), "layout", name)
    return found


def scene(name: str, state: str | None = None) -> Scene:
    """Its scene in a state, by default the first."""
    return _scene(name, train(name).declaration.state_or_first(state))


def built(name: str, state: str | None = None) -> Scene:
    """Its scene as it is built, which pages show, in a state, by default the first."""
    return _built(name, train(name).declaration.state_or_first(state))


@cache
def _scene(name: str, state: str | None) -> Scene:
    found: Scene = _stored(lambda: make_scene(train(name), state, layout(name)), "scene", name, state)
    return found


@cache
def _built(name: str, state: str | None) -> Scene:
    found: Scene = _stored(lambda: build_scene(train(name), state), "built", name, state)
    return found
