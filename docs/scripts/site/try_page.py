"""What try.html loads: its scripts, Pyodide, and the package with what it imports, all kept under their content.

npm brings the scripts' libraries, pip the one compiled wheel; everything else is taken from this environment. It all
lies in build/try under the content it is made from: a second build makes nothing.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from importlib.metadata import files, version
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import yaml

from geartrain import shipped
from geartrain.train.declaration_files import read_declaration, write_declaration

ROOT = Path(__file__).resolve().parents[3]
SOURCES = Path(__file__).resolve().parent / "try"
KEPT = ROOT / "build" / "try"
PLATFORM, PYTHON = "pyemscripten_2026_0_wasm32", "3.14"
"""Of the Pyodide that package.json names."""

PURE = (
    *("annotated-types", "jinja2", "markupsafe", "networkx", "pydantic"),
    *("pyyaml", "typing-extensions", "typing-inspection"),
)
"""What a report without numpy imports, as plain Python; of those with a compiled part, the part in Python."""

COMPILED = "pydantic-core"
_LEFT_OUT = re.compile(r"(^|/)(tests?|__pycache__)/|\.(pyc|pyi|so|pyd)$|^\.\.")


@cache
def make() -> dict[str, Path]:
    """Make what is missing; files by the name they get in the site."""
    folder = KEPT / _key()
    if not folder.is_dir():
        KEPT.mkdir(parents=True, exist_ok=True)
        coming = Path(tempfile.mkdtemp(dir=KEPT))
        _make(coming)
        shutil.rmtree(folder, ignore_errors=True)
        coming.rename(folder)
    return {f"try/{path.relative_to(folder)}": path for path in sorted(folder.rglob("*")) if path.is_file()}


def _make(folder: Path) -> None:
    _bundle(folder)
    _pack(folder / "packages.zip")
    trains = {name: _example(path) for name, path in shipped().items()}
    (folder / "examples.json").write_text(json.dumps(trains), encoding="utf-8")
    fetched = [folder / "packages.zip", *(folder / "pyodide").glob("*.wasm"), *(folder / "pyodide").glob("*.zip")]
    sizes = {"total": sum(path.stat().st_size for path in fetched)}
    (folder / "sizes.json").write_text(json.dumps(sizes), encoding="utf-8")


def _key() -> str:
    digest = sha256()
    for path in _sources():
        digest.update(str(path.relative_to(ROOT)).encode())
        digest.update(path.read_bytes())
    digest.update(" ".join(version(name) for name in (*PURE, COMPILED)).encode())
    return digest.hexdigest()[:16]


def _sources() -> Iterator[Path]:
    found = [path for path in SOURCES.rglob("*") if path.is_file() and "node_modules" not in path.parts]
    yield from sorted([*found, Path(__file__), *_package(), *(ROOT / "trains").glob("*/*.yaml")])


def _package() -> Iterator[Path]:
    for path in (ROOT / "geartrain").rglob("*"):
        if path.is_file() and "__pycache__" not in path.parts and "viewer" not in path.parts:
            yield path


def _bundle(folder: Path) -> None:
    """Scripts and Pyodide, by npm in a folder of its own."""
    npm = shutil.which("npm")
    if npm is None:
        raise FileNotFoundError("it takes npm, which is not on the path")
    with tempfile.TemporaryDirectory() as name:
        work = Path(name) / "try"
        shutil.copytree(SOURCES, work, ignore=shutil.ignore_patterns("node_modules", "*.py", "__pycache__"))
        _run([npm, "ci", "--no-audit", "--no-fund", "--loglevel=error"], work)
        _run([npm, "run", "--silent", "build", "--", str(folder)], work)


def _pack(target: Path) -> None:
    """All that Python imports, as one archive."""
    with tempfile.TemporaryDirectory() as name, ZipFile(target, "w", ZIP_DEFLATED, compresslevel=9) as archive:
        wanted = [
            "--platform",
            PLATFORM,
            "--python-version",
            PYTHON,
            "--only-binary=:all:",
            "--no-deps",
            "--dest",
            name,
        ]
        wheel = f"{COMPILED}=={version(COMPILED)}"
        _run([sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", *wanted, wheel], ROOT)
        (found,) = Path(name).glob("*.whl")
        with ZipFile(found) as compiled:
            for each in compiled.namelist():
                archive.writestr(each, compiled.read(each))
        for package in PURE:
            for own in files(package) or ():
                if not _LEFT_OUT.search(str(own)):
                    archive.write(str(own.locate()), str(own))
        for path in _package():
            archive.write(path, path.relative_to(ROOT))
        for path in (ROOT / "trains").rglob("*.yaml"):
            archive.write(path, Path("geartrain") / path.relative_to(ROOT))
        archive.write(SOURCES / "try_answer.py", "try_answer.py")


def _example(path: Path) -> dict[str, str]:
    """Return an example of the page; a train that extends another is written out in full."""
    text = path.read_text(encoding="utf-8")
    data = yaml.safe_load(text)
    if "extends" in data:
        text = write_declaration(read_declaration(path))
    return {"folder": path.parent.name, "title": data.get("title") or "", "text": text}


def _run(command: list[str], folder: Path) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command[:4])}: {(done.stderr or done.stdout).strip()[-800:]}")
