"""Write docs/commands.md: every command with what its own `--help` says."""

from __future__ import annotations

import re
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
| 0 | determined, and every expectation is met |
| 1 | the verdict is free, locked or contradictory, or an expectation is not met; this is a result |
| 2 | invalid input; nothing is printed or written |
| 3 | internal error; standard error names a log file to attach to a bug report |
| 130 | interrupted (Ctrl-C) |
| 141 | the reader closed standard output (`geartrain ... \\| head`) |

If the environment variable `GEARTRAIN_TRACEBACK` is set, the traceback of an internal error is also printed.

All files that a command writes (`-o`, `--to`, `--plot`, `--profile`) follow the same rules. An existing file is
overwritten only with `--force`. Without it the command stops before any computation. Symbolic links are followed: the
target is replaced, and the link is kept. Only regular files are overwritten. Folders, FIFOs, devices and sockets are
refused, and so are read-only files, even for root and with `--force`. A file is written completely or not at all, and
keeps its permissions. `-o -` writes the content of the file to standard output. Partial files of an interrupted run are
continued with `--resume`, or overwritten with `--force`.
"""


def commands(group: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Yield every command with its full name; groups before their members."""
    for name, command in group.commands.items():
        yield f"{path} {name}", command
        if hasattr(command, "commands"):
            yield from commands(command, f"{path} {name}")


def section(name: str, command: Any) -> Iterator[str]:
    """Yield the lines of one command: its description, arguments and options."""
    context = typer.Context(command, info_name=name)
    yield from (f"## {name}", "", str(command.help or "").strip(), "", "```sh")
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    yield from (re.sub(r"\{(.*?)\}", r"\1", usage), "```", "")
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
