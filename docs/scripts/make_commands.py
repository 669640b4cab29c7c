"""Write docs/commands.md: every command with what its own `--help` says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer.main

from geartrain.cli import app

PAGE = Path(__file__).resolve().parents[1] / "commands.md"
HEAD = """# The commands

Written by `docs/scripts/make_commands.py` from the commands' own help texts. Every command also has `--help` (or `-h`).

Where a command takes FILE, give a YAML declaration or the name of a shipped train (`geartrain list`).

| exit code | means |
|---|---|
| 0 | determined, and every expectation holds |
| 1 | a verdict (free, locked, contradictory) or an expectation that fails, reported as a result |
| 2 | input that cannot be read or used; nothing is printed or written |
| 3 | a fault of geartrain itself: one line on standard error names a file with the traceback, which is to be reported |
| 130 | interrupted (Ctrl-C) |
| 141 | nobody reads standard output any more (`geartrain ... \\| head`) |

With the environment variable `GEARTRAIN_TRACEBACK` set, the traceback of a fault is printed too.

Whatever a command writes (`-o`, `--to`, `--plot`, `--profile`) follows one rule. A file that is there is
kept, and the command refuses before it works, unless `--force` is given. Symbolic links are followed: the file behind
one is replaced, the link stays. Only regular files are written over: a folder, FIFO, device or socket is refused by
name, and so is a file whose permissions say read-only, even to root and with `--force`. A file is written whole or not
at all, and keeps the permissions it had. `-o -` is standard output: what would go into a file goes there. The partial
files of an interrupted run are gone on with by `--resume`, or written over by `--force`.
"""


def commands(group: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Every command with its full name; groups before what they hold."""
    for name, command in group.commands.items():
        yield f"{path} {name}", command
        if hasattr(command, "commands"):
            yield from commands(command, f"{path} {name}")


def section(name: str, command: Any) -> Iterator[str]:
    """One command: what it does, its arguments and its options."""
    context = typer.Context(command, info_name=name)
    yield from (f"## {name}", "", str(command.help or "").strip(), "", "```sh")
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    yield from (usage.replace("{FILE...}...", "FILE...").replace("{FILE}", "FILE"), "```", "")
    rows = [row for parameter in command.params if (row := _row(parameter))]
    if rows:
        yield from ("| argument or option | what | default |", "|---|---|---|", *rows, "")


def _row(parameter: Any) -> str:
    names = ", ".join(f"`{name}`" for name in [*parameter.opts, *parameter.secondary_opts])
    if parameter.param_type_name == "argument":
        names = f"`{parameter.metavar or parameter.name}`"
    default = "" if parameter.default in (None, "", False) or callable(parameter.default) else f"`{parameter.default}`"
    if parameter.required:
        default = "required"
    return f"| {names} | {parameter.help or ''} | {default} |"


def main() -> None:
    """Write the page."""
    group = typer.main.get_command(app)
    lines = [HEAD]
    lines += section("geartrain", group)
    for name, command in commands(group, "geartrain"):
        lines += section(name, command)
    PAGE.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    print("wrote docs/commands.md")


if __name__ == "__main__":
    main()
