"""Command line: one module for each command. Commands import what they need when they run.

Map: `verbs` imports the module of a command, `exit_codes` ends a run; `common` has the options that commands share, the
output of results and the loading of trains, `option_values` reads values of options, `long_runs` has progress bars and
journals, `time_runs` the options of motion in time, `theme` that of colours. `mesh` is a group of commands. Commands of
wings are in the folders of their capabilities.
"""

from __future__ import annotations

import atexit
import gc
import os
import sys
from functools import partial
from typing import Annotated

import typer

from geartrain.cli.exit_codes import EndingGroup, guarded
from geartrain.cli.verbs import LazyGroup, Verbs


class VerbGroup(EndingGroup, LazyGroup):
    """`geartrain` itself."""

    verbs = Verbs(
        {
            "report": "geartrain.cli.report",
            "view": "geartrain.cli.view",
            "watch": "geartrain.cli.watch",
            "draw": "geartrain.cli.draw",
            "export": "geartrain.workshop.export.verb",
            "compare": "geartrain.cli.compare",
            "check": "geartrain.cli.check",
            "solve": "geartrain.cli.solve",
            "equations": "geartrain.cli.equations",
            "init": "geartrain.cli.init",
            "format": "geartrain.cli.format",
            "formula": "geartrain.cli.formula",
            "gearbox": "geartrain.cli.gearbox",
            "graph": "geartrain.cli.graph",
            "torques": "geartrain.cli.torques",
            "strength": "geartrain.simulation.strength.verb",
            "motion": "geartrain.cli.motion",
            "dynamics": "geartrain.simulation.time.verb",
            "montecarlo": "geartrain.workshop.monte_carlo.verb",
            "budget": "geartrain.workshop.budget.verb",
            "sphere": "geartrain.cli.sphere",
            "teeth": "geartrain.search.teeth_verb",
            "posterior": "geartrain.search.posterior.verb",
            "optimise": "geartrain.workshop.sizes.verb",
            "reconstruct": "geartrain.search.reconstruct.verb",
            "schema": "geartrain.cli.schema",
            "list": "geartrain.cli.list",
            "periods": "geartrain.cli.periods",
            "mesh": "geartrain.cli.mesh",
            "bench": "geartrain.cli.bench",
        },
        entry_points="geartrain.wings",
    )


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


def _start_lightly() -> None:
    """Spare a short command half of its time: what collects garbage, and what looks for plugins that there are not."""
    # modules and models are a hundred thousand objects that stay until the end: to look through them at every 700 new
    # ones costs a tenth of a short command, and to look through all of them before the process goes, a quarter
    gc.set_threshold(100_000, 20, 20)
    atexit.register(gc.freeze)
    # pydantic would read the entry points of every package installed
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")


def main(name: str = "geartrain") -> None:
    """Run the command. What is wrong with the input is said on standard error, with exit code 2; a fault is code 3.

    name   by which usage and help call it: what can be typed to start it again
    """
    _start_lightly()
    sys.exit(guarded(partial(app, prog_name=name)))
