"""Write docs/commands.md: every command with what its own `--help` says."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer.main

from geartrain.cli import app

PAGE = Path(__file__).resolve().parent / "commands.md"
HEAD = """# The commands

Written by `docs/make_commands.py` from the commands' own help texts. Every command also has `--help` (or `-h`).

Where a command takes FILE, give a YAML declaration or the name of a shipped train (`geartrain list`).

| exit code | means |
|---|---|
| 0 | determined, and every expectation holds |
| 1 | a verdict (free, locked, contradictory) or an expectation that fails, reported as a result |
| 2 | input that cannot be read or used |
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
