"""A folder of finished files to disk: all of them, or none."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from geartrain.errors import GearTrainError, Problem
from geartrain.files.writing import destination, umask, write_bytes


def check_folder(folder: Path, names: Sequence[str], force: bool = False) -> None:
    """Raise `GearTrainError` where files of these names (`wheels/b1.svg`) cannot be put into a folder.

    Existing ones are refused unless `force`.
    """
    place = str(folder)
    if folder.exists() and not folder.is_dir():
        raise GearTrainError(Problem("this is no folder", "many files are to be written", "name a folder", place))
    nearest = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise GearTrainError(
            Problem("the folder cannot be written to", "its permissions forbid it", "name another", place)
        )
    there = [name for name in names if os.path.lexists(folder / name)]
    for name in there:
        destination(folder / name, force=True)  # what is no regular file, or read-only, is said to be that
    if there and not force:
        more = f", and {len(there) - 1} more" if len(there) > 1 else ""
        what = f"'{there[0]}'{more} exists there already"
        raise GearTrainError(
            Problem(what, "nothing is written over unasked", "give --force, or an empty folder", place)
        )


def write_folder(folder: Path, files: Iterable[tuple[str, bytes]], force: bool = False) -> int:
    """Write files by name into a folder, and say how many: they are made beside it, and put there once all are.

    Whatever stops it before leaves nothing behind; what is there already is written over only with `force`. Raises
    `GearTrainError`.
    """
    made: list[str] = []
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        beside = Path(tempfile.mkdtemp(dir=folder.parent, prefix=f".{folder.name}."))
        try:
            for name, data in files:
                path = beside / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
                made.append(name)
            _put(beside, folder, made, force)
        finally:
            shutil.rmtree(beside, ignore_errors=True)
    except OSError as error:
        why = error.strerror or str(error)
        raise GearTrainError(
            Problem("the files cannot be written", why, "check the folder and its permissions", str(folder))
        ) from None
    return len(made)


def _put(beside: Path, folder: Path, names: Iterable[str], force: bool) -> None:
    if not os.path.lexists(folder):
        beside.chmod(0o777 & ~umask())
        beside.replace(folder)
        return
    names = list(names)
    check_folder(folder, names, force)
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
    for name in names:
        write_bytes(folder / name, (beside / name).read_bytes(), force)
