"""Run every command that the pages show, and put its real output below it.

In a page, `<!-- file: NAME -->` above a fenced block saves the block as NAME in a scratch folder. A fenced block of
the kind `console` holds commands, each after `$ `; they run in that folder on a terminal of 100 columns, in the order
of the page. `<!-- show: A | B -->` above it keeps part of the output: lines `3-7`, the paragraphs that begin with a
text, or, after `{} `, the indented block that does.
"""

from __future__ import annotations

import os
import pty
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAMES = (
    "index",
    "tutorial",
    "for-historians",
    "for-makers",
    "for-engineers",
    "api/index",
    "library",
    "how-to",
    "json",
    "theory",
    "teeth",
    "torques",
    "strength",
    "motion",
    "dynamics",
    "buildability",
    "closure",
    "sphere",
    "which-counts",
    "reconstruction",
    "shapes",
    "reducers",
    "drawing",
    "cut-by-hand",
    "budgets",
)
PAGES = (ROOT / "README.md", *(ROOT / "docs" / f"{name}.md" for name in NAMES))
COLUMNS = "100"

_BLOCK = re.compile(r"((?:^<!-- (?:file|show): .*? -->\n)*)^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_MARK = re.compile(r"<!-- (file|show): (.*?) -->")
_ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


class _Page:
    """One page while it is refreshed: its scratch folder, and the exit status of its last command."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.status = folder, 0

    def block(self, found: re.Match[str]) -> str:
        """A fenced block with fresh outputs."""
        marks = dict(_MARK.findall(found[1]))
        if "file" in marks:
            (self.folder / marks["file"]).write_text(found[3], encoding="utf-8")
        if found[2] != "console":
            return found[0]
        body = ""
        for command in (line[2:] for line in found[3].splitlines() if line.startswith("$ ")):
            output, self.status = run(command, self.folder, self.status)
            if any(line.startswith("Traceback") or "command not found" in line for line in output):
                raise SystemExit(f"$ {command}\n" + "\n".join(output))
            body += f"$ {command}\n" + "".join(f"{line}\n" for line in _shown(output, marks.get("show")))
        return f"{found[1]}```console\n{body}```"


def refresh(page: Path) -> None:
    """Rewrite one page with fresh outputs."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("trains", "evidence"):
            (Path(folder) / name).symlink_to(ROOT / name)
        text = _BLOCK.sub(_Page(Path(folder)).block, page.read_text(encoding="utf-8"))
    page.write_text(text, encoding="utf-8")
    print(f"wrote {page.relative_to(ROOT)}")


def run(command: str, folder: Path, status: int = 0) -> tuple[list[str], int]:
    """The lines a command prints on a terminal, and its exit status; `$?` in it is `status`."""
    ours, theirs = pty.openpty()
    environment = os.environ | {
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "docs" / "scripts")]),  # a page asks a study
        "COLUMNS": COLUMNS,
        "LINES": "40",
        "TERM": "xterm",
        "NO_COLOR": "1",
    }
    script = f"(exit {status}); {command}"
    process = subprocess.Popen(
        ["bash", "-c", script], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs
    )
    os.close(theirs)
    raw = b"".join(_read(ours))
    text = _ESCAPES.sub("", raw.decode("utf-8")).replace("\r\n", "\n")
    text = text.replace(f"{folder}/", "").replace(f"{ROOT}/", "")
    # a progress bar overwrites itself, and is gone in the end; the number of processes is of the machine
    lines = [line.split("\r")[-1].rstrip() for line in text.rstrip().split("\n") if "━" not in line]
    lines = [line for line in lines if not line.endswith((" worker process", " worker processes"))]
    return lines if text.strip() else [], process.wait()


def _read(descriptor: int) -> Iterator[bytes]:
    while True:
        try:
            piece = os.read(descriptor, 65536)
        except OSError:  # a pseudo-terminal ends so on Linux
            piece = b""
        if not piece:
            os.close(descriptor)
            return
        yield piece


def _shown(lines: list[str], wanted: str | None) -> Iterator[str]:
    """The chosen lines, with `...` where some are left out."""
    if wanted is None:
        yield from lines
        return
    kept = sorted({at for item in wanted.split(" | ") for at in _positions(lines, item)})
    last = -1
    for at in kept:
        if at > last + 1:
            yield "..."
        yield lines[at]
        last = at
    if last < len(lines) - 1:
        yield "..."


def _positions(lines: list[str], item: str) -> Iterator[int]:
    if span := re.fullmatch(r"(\d+)-(\d+)", item):
        yield from range(int(span[1]) - 1, min(int(span[2]), len(lines)))
        return
    nested = item.startswith("{} ")
    text = item.removeprefix("{} ")
    starts = [at for at, line in enumerate(lines) if (line.lstrip() if nested else line).startswith(text)]
    if not starts:
        raise SystemExit(f"no line begins with '{text}' in:\n" + "\n".join(lines))
    at = starts[0]
    margin = len(lines[at]) - len(lines[at].lstrip()) if nested else -1
    yield at
    at += 1
    while at < len(lines) and lines[at]:
        yield at
        if len(lines[at]) - len(lines[at].lstrip()) == margin:
            return
        at += 1


def main() -> None:
    """Refresh all pages."""
    for page in PAGES:
        refresh(page)


if __name__ == "__main__":
    main()
