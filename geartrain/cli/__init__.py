"""The command: one file a verb. Verbs import what they need when they run; only this room prints and exits."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from geartrain.cli import (
    bench,
    check,
    compare,
    draw,
    equations,
    errors,
    export,
    graph,
    mesh,
    motion,
    report,
    schema,
    solve,
    sphere,
    sweep,
    teeth,
    torques,
    view,
)
from geartrain.cli import catalogue as listing
from geartrain.cli.exit_codes import VerbGroup, guarded

app = typer.Typer(
    name="geartrain",
    cls=VerbGroup,
    help="What does this gear train do? Exact speeds, named diagnoses and sources for any declared train.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit codes: 0 determined, every expectation holds; 1 a verdict or a failed expectation; 2 unusable input; "
    "3 a fault of geartrain itself; 130 interrupted; 141 nobody reads the output any more.",
)
app.command("report")(report.run)
app.command("view")(view.run)
app.command("draw")(draw.run)
app.command("export")(export.run)
app.command("compare")(compare.run)
app.command("check")(check.run)
app.command("solve")(solve.run)
app.command("equations")(equations.run)
app.command("graph")(graph.run)
app.command("torques")(torques.run)
app.command("motion")(motion.run)
app.command("errors")(errors.run)
app.command("sphere")(sphere.run)
# a negative ratio is no option
app.command("teeth", context_settings={"ignore_unknown_options": True})(teeth.run)
app.command("sweep")(sweep.run)
app.command("schema")(schema.run)
app.command("list")(listing.trains)
app.command("periods")(listing.periods)
app.add_typer(mesh.app, name="mesh")
app.add_typer(bench.app, name="bench")


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        typer.echo(f"geartrain {version('geartrain')}")
        raise typer.Exit


@app.callback()
def _root(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    pass


def main() -> None:
    """Run the command. What is wrong with the input is said on standard error, with exit code 2; a fault is code 3."""
    sys.exit(guarded(app))
