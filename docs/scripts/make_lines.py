"""Write docs/lines.md: how many lines each shipped train takes, in short forms and in long ones."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from geartrain import shipped
from geartrain.train import with_long_forms, with_short_forms

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/lines.md"
HEAD = """# How long declarations are

A gearbox with three states [takes thirteen lines](how-to.md#write-less-or-write-it-out).

The table is written by `python docs/scripts/make_lines.py`: every shipped train with its turning pairs and gear pairs
in long forms, as `geartrain format --long` writes them, and in short ones, as `geartrain format` does. Lines of
comments count. A train that extends another is short anyway; planets declared once by `copies` spare more, which no
rewriting shows.

| train | long | short | less |
|---|---:|---:|---:|
"""


def main() -> None:
    """Count and write."""
    PAGE.write_text(HEAD + "\n".join(_rows()) + "\n", encoding="utf-8")
    print(f"wrote {PAGE.relative_to(ROOT)}")


def _rows() -> Iterator[str]:
    whole = [0, 0]
    for path in (path for _, path in sorted(shipped().items())):
        text = path.read_text(encoding="utf-8")
        counts = [len(each(text).splitlines()) for each in (with_long_forms, with_short_forms)]
        whole = [total + count for total, count in zip(whole, counts, strict=True)]
        yield _row(f"`{path.stem}`", *counts)
    yield _row("all", *whole)


def _row(name: str, long: int, short: int) -> str:
    return f"| {name} | {long:,} | {short:,} | {(long - short) / long:.0%} |"


if __name__ == "__main__":
    main()
