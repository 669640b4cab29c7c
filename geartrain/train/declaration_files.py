"""Loading of declarations, with everything that they inherit, from a path, the name of a shipped train, text or plain
data.

A JSON file is read by the YAML parser, because JSON is a subset of YAML 1.2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cache
from itertools import count
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from types import MappingProxyType
from typing import Any

from geartrain.errors import DeclarationError, Problem, suggest
from geartrain.train.declaration import Train
from geartrain.train.validation import JOINTS, declare, written_out
from geartrain.train.yaml_nodes import YamlNode, as_yaml, node_from_data, parse_yaml

_MOST_BYTES = 64 * 2**20
_MOST_PARENTS = 2000


EVIDENCE = "evidence"
"""Subfolder of `trains` that contains the evidence for reconstructions; these declarations are not complete trains."""


@cache
def shipped() -> Mapping[str, Path]:
    """Return the paths of the trains that are shipped with geartrain, by name."""
    return _shipped_files(lambda path: path.parent.name != EVIDENCE)


@cache
def shipped_evidence() -> Mapping[str, Path]:
    """Return the paths of the evidence for reconstructions that is shipped with geartrain, by name."""
    return _shipped_files(lambda path: path.parent.name == EVIDENCE)


def _shipped_files(chosen: Callable[[Path], bool]) -> Mapping[str, Path]:
    package = Path(__file__).resolve().parent.parent
    home = next((folder for folder in (package / "trains", package.parent / "trains") if folder.is_dir()), None)
    files = filter(chosen, sorted(home.rglob("*.yaml"))) if home else ()
    return MappingProxyType({path.stem: path for path in files})


def read_declaration(source: str | Path | Mapping[str, Any]) -> Train:
    """Read a train from a YAML file, the name of a train shipped with geartrain, multi-line YAML text, or plain data.

    Tooth counts may be undetermined (key `search`). Raises `DeclarationError`, also if the declaration is evidence for
    a reconstruction.
    """
    train = _read_source(source, shipped())
    if train.reconstruct is not None:
        what = f"'{train.name}' is evidence, not a train"
        why = "its key `reconstruct` leaves gear pairs undetermined"
        fix = "run `geartrain reconstruct`, which finds the trains that are consistent with it"
        raise DeclarationError(Problem(what, why, fix, train.place("reconstruct")))
    return train


def read_evidence(source: str | Path | Mapping[str, Any]) -> Train:
    """Read evidence for a reconstruction: a declaration with `reconstruct`.

    Parameters
    ----------
    source : str, Path or mapping
        A YAML file, the name of shipped evidence, multi-line YAML text, or plain data.

    Returns
    -------
    Train

    Raises
    ------
    DeclarationError
        If the declaration cannot be read, or does not contain `reconstruct`.

    Examples
    --------
    >>> from geartrain.search.reconstruct import read_evidence
    >>> list(read_evidence("metonic-l-m").outputs)
    ['metonic']
    """
    evidence = _read_source(source, shipped_evidence())
    if evidence.reconstruct is None:
        what = f"'{evidence.name}' is not evidence"
        fix = "add `reconstruct:` with the parts that may be added, such as `add: {wheels: 2, teeth: [12, 225]}`"
        raise DeclarationError(Problem(what, "evidence has the key `reconstruct`", fix, evidence.place()))
    return evidence


def _read_source(source: str | Path | Mapping[str, Any], known: Mapping[str, Path]) -> Train:
    if isinstance(source, Mapping):
        if "extends" not in source and "remove" not in source:
            return declare(source)
        return _build(node_from_data(source), Path.cwd(), (), "train")
    if isinstance(source, str) and "\n" in source:
        return _build(parse_yaml(source, "text"), Path.cwd(), (), "train")
    path = _find_file(source, known)
    return _build(parse_yaml(_read(path), str(path)), path.parent, (path.resolve(),), path.stem)


def write_declaration(train: Train) -> str:
    """Return YAML text of a declaration in which everything inherited by `extends` is included."""
    data = train.model_dump(mode="json", exclude_unset=True, by_alias=True, exclude={"extends", "remove"})
    return as_yaml({"name": train.name, **data})


def formatted(path: Path, long: bool = False) -> tuple[str, str]:
    """Return the text of a file, and this text in short (or long) form, which is checked to have the same meaning."""
    from geartrain.train.declaration_style import with_long_forms, with_short_forms

    def declared(text: str) -> dict[str, Any]:
        data = _build(parse_yaml(text, str(path)), path.parent, (path.resolve(),), path.stem).model_dump()
        # short forms group the joints by axis, so their order changes
        return data | {key: sorted(map(str, data[key])) for key in JOINTS}

    text = _read(path)
    # an invalid file is refused before anything is rewritten
    before = declared(text)
    new = with_long_forms(text) if long else with_short_forms(text)
    if declared(new) != before:
        why = "the new text would declare a different train"
        raise DeclarationError(
            Problem("the file cannot be rewritten", why, "report this as a bug; the file is unchanged", str(path))
        )
    return text, new


def _build(root: YamlNode, folder: Path, chain: tuple[Path, ...], stem: str) -> Train:
    """Return the train of a declaration, merged with the chain of its parents, beginning with the oldest ancestor."""
    # short forms are expanded first, because entries are merged key by key
    line = [written_out(root), *(written_out(parent) for _, parent in _parents(root, folder, chain))]
    node = line.pop()
    if line:
        from geartrain.train.inheritance import merge_parent
    while line:
        node = merge_parent(node, line.pop())
    _complete_table_paths(node)
    data = node.plain()
    data.setdefault("name", stem)
    return declare(data, node.place_of)


def _complete_table_paths(node: YamlNode) -> None:
    """Make relative paths of measurement tables absolute; they refer to the folder of the file that contains them."""
    none = YamlNode({}, "")
    wheels = [part.mapping.get("wheels", none).mapping for part in node.mapping.get("links", none).mapping.values()]
    for wheel in (wheel for each in wheels for wheel in each.values()):
        measured = wheel.mapping.get("cutting", none).mapping.get("measured", none).mapping
        if (table := measured.get("csv")) is not None:
            folder = Path(table.place.rpartition(":")[0]).parent
            table.value = str(folder.absolute() / table.text)


def files_of(path: Path) -> tuple[Path, ...]:
    """Return a YAML file and all files that it extends, directly or indirectly."""
    child = parse_yaml(_read(path), str(path))
    return path, *(parent for parent, _ in _parents(child, path.parent, (path.resolve(),)))


def _parents(node: YamlNode, folder: Path, chain: tuple[Path, ...]) -> Iterator[tuple[Path, YamlNode]]:
    """Yield path and root node of each ancestor; raise `DeclarationError` for a cycle or for too many ancestors."""
    met = dict.fromkeys(chain)
    for at in count():
        if "extends" not in node.mapping:
            return
        place = node.place_of(("extends",))
        path = _parent(node.mapping["extends"].text, folder, place)
        if path.resolve() in met:
            loop = " -> ".join(step.name for step in (*met, path))
            raise DeclarationError(
                Problem("`extends` forms a cycle", loop, "remove `extends` from one of these files", place)
            )
        if at == _MOST_PARENTS:
            why = f"at most {_MOST_PARENTS} levels of inheritance are allowed"
            fix = "write the keys of one of the parents into its child"
            raise DeclarationError(Problem("the chain of `extends` is too long", why, fix, place))
        met[path.resolve()] = None
        folder, node = path.parent, parse_yaml(_read(path), str(path))
        yield path, node


def _parent(name: str, folder: Path, place: str) -> Path:
    if not name:
        why = "it names the file, shipped train or shipped evidence that this declaration changes"
        fix = "give a name, such as `extends: parent.yaml`, or remove the key"
        raise DeclarationError(Problem("`extends` is empty", why, fix, place))
    if _exists(folder / name):
        return folder / name
    known = {**shipped_evidence(), **shipped()}
    if name in known:
        return known[name]
    siblings = [*known, *(path.name for path in folder.glob("*.yaml"))]
    where = "the current folder" if folder == Path() else folder
    why = f"{where} contains no such file, and no shipped train or evidence has that name"
    otherwise = "`geartrain list` and `geartrain list --evidence` show the shipped names"
    fix = suggest(name, siblings, otherwise=otherwise, wide=True)
    raise DeclarationError(Problem(f"`extends` names the unknown parent '{name}'", why, fix, place))


def _exists(path: Path) -> bool:
    """Return True if the path exists; False if it does not, or if it is not a valid file name."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def _find_file(source: str | Path, known: Mapping[str, Path]) -> Path:
    path = Path(source)
    if _exists(path):
        return path
    if str(source) in known:
        return known[str(source)]
    # also a path as in the source tree, such as trains/planetary.yaml
    within = next((found for found in known.values() if str(found).endswith(f"/{str(source).lstrip('./')}")), None)
    if within is not None:
        return within
    evidence = known is shipped_evidence()
    why = f"'{path.stem}' is not the name of a shipped {'evidence' if evidence else 'train'} either"
    if path.name and _exists(path.with_name(f"{path.name}.yaml")):
        fix = f"give the name with its suffix: {path.name}.yaml"
    else:
        fix = _suggestion(path.stem, evidence)
    raise DeclarationError(Problem("the file does not exist", why, fix, str(source)))


def _suggestion(name: str, evidence: bool) -> str:
    """Return a suggestion for a name that is not the name of shipped evidence, or not the name of a shipped train."""
    if evidence:
        names = ", ".join(shipped_evidence())
        if name in shipped():
            return f"it is a shipped train: name lost arbors by `--lost ARBOR`, or give evidence: {names}"
        return suggest(name, shipped_evidence(), otherwise=f"give a file, or one of: {names}", wide=True)
    if name in shipped_evidence():
        return f"it is evidence: `geartrain reconstruct {name}` finds the trains that are consistent with it"
    return suggest(name, shipped(), otherwise="check the path; `geartrain list` shows the shipped trains", wide=True)


def _read(path: Path) -> str:
    place = str(path)
    try:
        status = path.stat()
        # a directory is reported by the read below
        if not S_ISREG(status.st_mode) and not S_ISDIR(status.st_mode):
            why = "a device or a pipe may be endless, and cannot be read twice"
            raise DeclarationError(Problem("this is not a regular file", why, "save the declaration as a file", place))
        if status.st_size > _MOST_BYTES:
            why = f"a declaration has at most {_MOST_BYTES >> 20} MB"
            fix = "build the train in Python with `GearTrain.declare`"
            raise DeclarationError(Problem("the file is too large", why, fix, place))
        raw = path.read_bytes()
    except IsADirectoryError:
        raise DeclarationError(
            Problem("this is a directory", "a declaration is read from a single file", "name a .yaml file in it", place)
        ) from None
    except OSError as error:
        why, fix = error.strerror or str(error), "check its path and permissions"
        raise DeclarationError(Problem("the file cannot be read", why, fix, place)) from None
    try:
        # utf-8-sig, because some editors write a byte order mark
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DeclarationError(
            Problem("this is not a text file", f"byte {error.start} is not UTF-8", "save it as UTF-8 text", place)
        ) from None
    if "\0" in text:
        raise DeclarationError(
            Problem("this is not a text file", "it contains NUL bytes", "give a YAML declaration", place)
        )
    return text
