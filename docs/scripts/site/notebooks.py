"""The notebooks of docs/notebooks, run while the site is built, as pages: what a cell gives stands below it."""

from __future__ import annotations

import re
import tempfile
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parents[2] / "notebooks"
_COLOURS = re.compile(r"\x1b\[[0-9;]*m")


def pages() -> dict[str, str]:
    """Name in the site -> Markdown. Raises `CellExecutionError` where a cell fails."""
    return {f"notebooks/{path.stem}.md": _page(path) for path in sorted(FOLDER.glob("*.ipynb"))}


def run(path: Path) -> Any:
    """A notebook with its outputs, run in a folder of its own."""
    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        client = NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}})
        client.execute()
    return notebook


def _page(path: Path) -> str:
    parts: list[str] = []
    for cell in run(path).cells:
        if cell.cell_type == "markdown":
            parts.append(cell.source)
        else:
            parts.append(f"```python\n{cell.source}\n```")
            parts += [shown for output in cell.outputs for shown in _shown(output)]
    return "\n\n".join(parts) + "\n"


def _shown(output: Any) -> Iterator[str]:
    """An output in the richest form that it has."""
    if output.output_type == "stream":
        yield _fenced(output.text)
        return
    data = output.get("data", {})
    if "text/html" in data:
        yield f"<div>{data['text/html']}</div>".replace("\n", " ")
    elif "image/svg+xml" in data:
        picture = b64encode(data["image/svg+xml"].encode("utf-8")).decode("ascii")
        yield f'<p><img alt="what the cell above draws" src="data:image/svg+xml;base64,{picture}"></p>'
    elif "text/plain" in data:
        yield _fenced(data["text/plain"])


def _fenced(text: str) -> str:
    return f"```text\n{_COLOURS.sub('', text).rstrip()}\n```"
