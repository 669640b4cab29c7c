"""Results to disk: whole or not at all, only where a regular file may stand, and over none that is there unasked.

Every file that geartrain makes for a user goes through here. `destination` says where it is put, or why it cannot be;
`write_bytes` and `place` put it there under one rule: what is written stands beside its place first, is safe on the
disk, and takes the name in one step, so that a reader sees the old file or the new one. `write_folder` does the same
for many files: all of them, or none.
"""

from __future__ import annotations

import os
import shutil
import stat
import tempfile
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from geartrain.errors import GearTrainError, Problem
from geartrain.numerics.exact import plural

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a FIFO (a named pipe)"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
    (stat.S_ISSOCK, "a socket"),
)


def destination(path: Path, force: bool = False) -> Path:
    """The file that a result for `path` is put into: at the end of all symbolic links, which stay as they are.

    Only a regular file is written over, only with `force`, and never one whose permissions say read-only: root is
    bound by them too. Raises `GearTrainError` for all else, before anything is worked out or touched.
    """
    try:
        real, mode = _look(path)
        trouble = _kind(path, mode) or _name(path) or _folder(path, real)
        if trouble is None and mode is not None:
            trouble = _old(path, real, mode, force)
    except (OSError, ValueError, RuntimeError) as error:
        trouble = _unnamed(path, getattr(error, "strerror", None) or str(error))
    if trouble is not None:
        raise GearTrainError(trouble)
    return real


def write_text(path: Path, text: str, force: bool = False) -> None:
    """Write `text` to `path` as UTF-8, atomically. Raises `GearTrainError`."""
    write_bytes(path, text.encode("utf-8"), force)


def write_bytes(path: Path, data: bytes, force: bool = False) -> None:
    """Write `data` to where `destination` says, atomically. Raises `GearTrainError`."""
    real = destination(path, force)
    try:
        handle, name = tempfile.mkstemp(dir=real.parent, prefix=f".{real.name[:64]}.")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            temporary.chmod(0o666 & ~umask())  # `mkstemp` lets the owner alone read what is to be a plain file
            place(temporary, path, force)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise unfinished_file(path, error) from None


def place(temporary: Path, path: Path, force: bool = False) -> None:
    """Let a finished file on the disk of `path`'s folder take that name, by the rule of `destination`.

    The permissions of a file that is written over are kept. Raises `GearTrainError`, and `OSError` as the disk does.
    """
    real = destination(path, force)
    with temporary.open("rb") as file:
        os.fsync(file.fileno())  # before it takes the name: or a power failure leaves the new name with no content
    if real.exists():
        _inherit(real, temporary)
    if force or not _link(temporary, real, path):
        os.replace(temporary, real)
    _settle(real.parent)


def unfinished_file(path: Path, error: Exception) -> GearTrainError:
    """A disk's own word on what could not be written."""
    why = getattr(error, "strerror", None) or str(error)
    fix = "make room, or check the folder and its permissions"
    return GearTrainError(Problem("the file cannot be written", why, fix, str(path)))


def umask() -> int:
    """Permissions that new files do without."""
    mask = os.umask(0)  # it can be read by setting it only
    os.umask(mask)
    return mask


# ------------------------------------------------------------------------------------------------------- what is there


def _look(path: Path) -> tuple[Path, int | None]:
    """What stands at the end of the links from a path, and its mode; None where nothing does."""
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError:
        mode = None  # or a link to a file that is still to be made
    except NotADirectoryError:
        mode = None  # the check of the folder says so
    return Path(os.path.realpath(path)), mode


def _kind(path: Path, mode: int | None) -> Problem | None:
    if mode is None or stat.S_ISREG(mode):
        return None
    kind = next((name for is_kind, name in _KINDS if is_kind(mode)), "no ordinary file")
    if stat.S_ISDIR(mode):
        fix = f"name a file in it: {path / 'NAME'}"
        return Problem("this is a folder", "a result is one file", fix, str(path))
    why = "a result takes the place of a regular file only"
    return Problem(f"this is {kind}", why, "name a file; - is standard output", str(path))


def _name(path: Path) -> Problem | None:
    if path.name in ("", "..") or not path.name.isprintable():
        return _unnamed(path, "a file has a name of printable letters")
    return None


def _folder(path: Path, real: Path) -> Problem | None:
    folder = real.parent
    if not folder.is_dir():
        return Problem(
            "there is no such folder", f"the file would stand in {folder}", "make the folder first", str(path)
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        return Problem("the folder cannot be written to", "its permissions forbid it", "name another", str(folder))
    return None


def _old(path: Path, real: Path, mode: int, force: bool) -> Problem | None:
    """What protects a file that is there."""
    if not force:
        return _exists(path)
    if not mode & 0o222 or not os.access(real, os.W_OK):
        why = f"its permissions ({stat.filemode(mode)}) forbid writing, and --force does not lift them"
        return Problem("the file is read-only", why, "make it writable, or name another", str(path))
    return None


def _exists(path: Path) -> Problem:
    return Problem("the file exists", "nothing is written over unasked", "give --force, or another name", str(path))


def _unnamed(path: Path, why: str) -> Problem:
    return Problem("this is no name for a file", why, "choose a shorter or plainer name", repr(str(path)))


# ------------------------------------------------------------------------------------------------------ taking a name


def _inherit(old: Path, new: Path) -> None:
    """Permissions, and the owner where that is allowed."""
    found = old.stat()
    if hasattr(os, "chown"):
        with suppress(OSError):
            os.chown(new, found.st_uid, found.st_gid)
    new.chmod(stat.S_IMODE(found.st_mode))


def _link(temporary: Path, real: Path, path: Path) -> bool:
    """Take a name that nothing has, in one step; False on a disk that cannot.

    Unlike renaming, this fails where another has taken the name since it was looked at.
    """
    try:
        os.link(temporary, real)
    except FileExistsError:
        raise GearTrainError(_exists(path)) from None
    except (OSError, AttributeError):
        return False
    temporary.unlink()
    return True


def _settle(folder: Path) -> None:
    """Let the disk keep the new name too, where folders can be told so."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


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
        others = len(there) - 1
        more = f" and {plural(others, 'other file')} exist" if others else " exists"
        what = f"'{there[0]}'{more} there already"
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
