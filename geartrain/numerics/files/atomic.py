"""Atomic output of results: a file is written completely or not at all, and overwrites another file only on request.

This module writes every file that geartrain creates for a user. `destination` returns the path of the file, or raises
an error if it cannot be written. `write_bytes` and `place` write a temporary file next to it, flush it to disk, and
rename it in one step, so that a reader sees either the old or the new file. `write_folder` does the same for many
files.
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
    """Return the file to which a result for `path` will be written, with symbolic links resolved.

    An existing file may only be overwritten with `force`, and only if it is a regular file whose permissions allow
    writing (also for root). Otherwise `GearTrainError` is raised. The function does not write anything.
    """
    try:
        real, mode = _target(path)
        trouble = _kind(path, mode) or _name(path) or _folder(path, real)
        if trouble is None and mode is not None:
            trouble = _protection(path, real, mode, force)
    except (OSError, ValueError, RuntimeError) as error:
        trouble = _invalid_name(path, getattr(error, "strerror", None) or str(error))
    if trouble is not None:
        raise GearTrainError(trouble)
    return real


def write_text(path: Path, text: str, force: bool = False) -> None:
    """Write `text` atomically to `path` as UTF-8, following symbolic links.

    An existing file is overwritten only with `force`. Raises `GearTrainError` if the file cannot be written.
    """
    write_bytes(path, text.encode("utf-8"), force)


def write_bytes(path: Path, data: bytes, force: bool = False) -> None:
    """Write `data` atomically to `path`, following symbolic links.

    An existing file is overwritten only with `force`. Raises `GearTrainError` if the file cannot be written.
    """
    real = destination(path, force)
    try:
        # in the same folder, because a rename is atomic only within one file system
        handle, name = tempfile.mkstemp(dir=real.parent, prefix=f".{real.name[:64]}.")
        temporary = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
            temporary.chmod(0o666 & ~umask())  # `mkstemp` makes the file readable by its owner only
            place(temporary, path, force)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise unfinished_file(path, error) from None


def place(temporary: Path, path: Path, force: bool = False) -> None:
    """Rename a finished temporary file on the same disk to `path`, after the checks of `destination`.

    The permissions of an overwritten file are kept. Raises `GearTrainError` if a check fails, and `OSError` for disk
    errors.
    """
    real = destination(path, force)
    with temporary.open("rb") as file:
        # before renaming: a power failure could otherwise leave the new name with an empty file
        os.fsync(file.fileno())
    if real.exists():
        _copy_permissions(real, temporary)
    if force or not _link(temporary, real, path):
        os.replace(temporary, real)
    _sync_folder(real.parent)


def unfinished_file(path: Path, error: Exception) -> GearTrainError:
    """Return the `GearTrainError` that reports that a disk error prevented writing a file."""
    why = getattr(error, "strerror", None) or str(error)
    fix = "free disk space, or check the folder and its permissions"
    return GearTrainError(Problem("the file cannot be written", why, fix, str(path)))


def umask() -> int:
    """Return the permission bits that are removed from new files."""
    mask = os.umask(0)  # it can only be read by setting it
    os.umask(mask)
    return mask


# ------------------------------------------------------------------------------------------------------- what is there


def _target(path: Path) -> tuple[Path, int | None]:
    """Return the target of a path with symbolic links resolved, and its mode; None if it does not exist."""
    try:
        mode = os.stat(path).st_mode
    except (FileNotFoundError, NotADirectoryError):
        mode = None  # also a link to a file that does not exist yet; `_folder` reports a path through a file
    return Path(os.path.realpath(path)), mode


def _kind(path: Path, mode: int | None) -> Problem | None:
    if mode is None or stat.S_ISREG(mode):
        return None
    kind = next((name for is_kind, name in _KINDS if is_kind(mode)), "not a regular file")
    if stat.S_ISDIR(mode):
        fix = f"give a file in it: {path / 'NAME'}"
        return Problem("this is a folder", "a result is written to one file", fix, str(path))
    why = "a result can overwrite only a regular file"
    return Problem(f"this is {kind}", why, "give a file name, or - for standard output", str(path))


def _name(path: Path) -> Problem | None:
    if path.name in ("", "..") or not path.name.isprintable():
        return _invalid_name(path, "a file name must consist of printable characters")
    return None


def _folder(path: Path, real: Path) -> Problem | None:
    folder = real.parent
    if not folder.is_dir():
        what = "the folder does not exist"
        return Problem(what, f"the file would be in {folder}", "create the folder first", str(path))
    if not os.access(folder, os.W_OK | os.X_OK):
        return _unwritable(folder)
    return None


def _unwritable(folder: Path) -> Problem:
    why = "its permissions do not allow writing"
    return Problem("the folder cannot be written to", why, "give another folder", str(folder))


def _protection(path: Path, real: Path, mode: int, force: bool) -> Problem | None:
    """Return the problem that prevents overwriting an existing file; None if it may be overwritten."""
    if not force:
        return _exists(path)
    if not mode & 0o222 or not os.access(real, os.W_OK):
        why = f"its permissions ({stat.filemode(mode)}) forbid writing, and --force does not change them"
        return Problem("the file is read-only", why, "make it writable, or give another name", str(path))
    return None


def _exists(path: Path) -> Problem:
    what = "the file exists"
    return Problem(what, "existing files are overwritten only with --force", "give --force, or another name", str(path))


def _invalid_name(path: Path, why: str) -> Problem:
    return Problem("this is not a valid file name", why, "choose a shorter or simpler name", repr(str(path)))


# ------------------------------------------------------------------------------------------------------ taking a name


def _copy_permissions(old: Path, new: Path) -> None:
    """Copy the permissions of the old file to the new file, and its owner if the system allows it."""
    found = old.stat()
    if hasattr(os, "chown"):
        with suppress(OSError):
            os.chown(new, found.st_uid, found.st_gid)
    new.chmod(stat.S_IMODE(found.st_mode))


def _link(temporary: Path, real: Path, path: Path) -> bool:
    """Give a file a new name in one step by a hard link; return False if the file system does not support hard links.

    Unlike renaming, this fails if another process has created a file with this name in the meantime.
    """
    try:
        os.link(temporary, real)
    except FileExistsError:
        raise GearTrainError(_exists(path)) from None
    except (OSError, AttributeError):
        return False
    temporary.unlink()
    return True


def _sync_folder(folder: Path) -> None:
    """Write a folder to disk (fsync) on systems that support it, so that a new name survives a power failure."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def check_folder(folder: Path, names: Sequence[str], force: bool = False) -> None:
    """Raise `GearTrainError` if files with these names, such as `wheels/b1.svg`, cannot be written to a folder.

    Without `force`, the error is also raised if a file exists.
    """
    place = str(folder)
    if folder.exists() and not folder.is_dir():
        why = "several files are written to one folder"
        raise GearTrainError(Problem("this is not a folder", why, "give the path of a folder", place))
    nearest = next(parent for parent in (folder, *folder.absolute().parents) if parent.exists())
    if not os.access(nearest, os.W_OK | os.X_OK):
        raise GearTrainError(_unwritable(folder))
    there = [name for name in names if os.path.lexists(folder / name)]
    for name in there:
        destination(folder / name, force=True)  # raises the error for a file that is not regular or is read-only
    if there and not force:
        others = len(there) - 1
        more = f" and {plural(others, 'other file')} are" if others else " is"
        what = f"'{there[0]}'{more} already in the folder"
        why = "existing files are overwritten only with --force"
        raise GearTrainError(Problem(what, why, "give --force, or an empty folder", place))


def write_folder(folder: Path, files: Iterable[tuple[str, bytes]], force: bool = False) -> int:
    """Write named files to a folder and return their number.

    The files are created in a temporary folder next to the destination and moved when all are complete, so that an
    error leaves the destination unchanged. Existing files are overwritten only with `force`. Raises `GearTrainError` if
    a file cannot be written.
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
        what = "the files cannot be written"
        raise GearTrainError(Problem(what, why, "check the folder and its permissions", str(folder))) from None
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
