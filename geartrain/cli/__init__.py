"""Command line. `VerbGroup` maps each command to its function or module, which is imported when the command runs.

verbs           groups of commands, imported on request; exit codes
common          options that commands share, loading of trains, output of results
option_values   parsers of option values; `long_runs` has progress bars, journals, and options of dynamics
declarations    `init`, `format`, `list`, `periods`; `check`, `solve`, `gearbox` have modules of their own
inspection      commands `equations`, `formula`, `graph`, `bench`, `schema`
report          `report`, `compare`; `draw` writes pictures, `view` has `view` and `watch`
torques, motion, sphere
mesh            a pair of wheels of any tooth form, with `pair_options`; `pin` in a slot

Commands of optional parts of the package are in their own folders.
"""

from __future__ import annotations

import atexit
import gc
import os
import sys
from functools import partial
from typing import Annotated

import typer

from geartrain.cli.verbs import EndingGroup, LazyGroup, Verbs, guarded


class VerbGroup(EndingGroup, LazyGroup):
    """Group of all commands of `geartrain`. The module of a command is imported when the command is used."""

    verbs = Verbs(
        {
            "init": "geartrain.cli.declarations:write_template",
            "check": "geartrain.cli.check",
            "format": "geartrain.cli.declarations:write_style",
            "list": "geartrain.cli.declarations:list_trains",
            "periods": "geartrain.cli.declarations:list_periods",
            "report": "geartrain.cli.report:report",
            "view": "geartrain.cli.view:view",
            "watch": "geartrain.cli.view:watch",
            "draw": "geartrain.cli.draw",
            "compare": "geartrain.cli.report:compare",
            "solve": "geartrain.cli.solve:solve",
            "gearbox": "geartrain.cli.gearbox",
            "inspect": "geartrain.cli.inspection",
            "sphere": "geartrain.cli.sphere",
            "mesh": "geartrain.cli.mesh",
            "pin": "geartrain.cli.pin",
            "torques": "geartrain.cli.torques",
            "motion": "geartrain.cli.motion",
            "strength": "geartrain.simulation.strength.verb",
            "dynamics": "geartrain.simulation.time.verb",
            "optimise": "geartrain.workshop.sizes.verb",
            "teeth": "geartrain.search.teeth_verb",
            "reconstruct": "geartrain.search.reconstruct.verb",
            "posterior": "geartrain.search.posterior.verb",
            "export": "geartrain.workshop.export.verb",
            "montecarlo": "geartrain.workshop.monte_carlo.verb",
            "feasibility": "geartrain.workshop.feasibility.verb",
            "budget": "geartrain.workshop.budget.verb",
        },
        entry_points="geartrain.wings",
        panels={
            "Start": ("init", "check", "format", "list", "periods"),
            "Look": ("report", "view", "watch", "draw", "compare"),
            "Speeds": ("solve", "gearbox", "sphere", "inspect"),
            "Teeth, losses and motion": ("mesh", "pin", "torques", "motion", "strength", "dynamics", "optimise"),
            "Search": ("teeth", "reconstruct", "posterior"),
            "Make": ("export", "montecarlo", "feasibility", "budget"),
        },
    )


app = typer.Typer(
    name="geartrain",
    cls=VerbGroup,
    help="Exact gear-train kinematics from a YAML file: speeds, diagnosis, losses, drawings.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Examples: `geartrain report freeth-2021`; `geartrain solve train.yaml`; `geartrain teeth ratio 235/19`. "
    "Exit codes: 0 determined and as expected; 1 not determined, or an expectation failed; 2 invalid input; "
    "3 internal error; 130 interrupted; 141 output pipe closed by its reader.",
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


def main(name: str = "geartrain") -> None:
    """Run the command line and exit. The exit code is 2 for invalid input, which is reported on standard error, and 3
    for internal errors.

    name   program name shown in usage messages and help
    """
    # modules and models are about 100,000 long-lived objects: a collection after every 700 new ones takes a tenth of
    # the time of a short command, and the final collection at exit takes a quarter
    gc.set_threshold(100_000, 20, 20)
    atexit.register(gc.freeze)
    # pydantic would otherwise read the entry points of every installed package
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    sys.exit(guarded(partial(app, prog_name=name)))
