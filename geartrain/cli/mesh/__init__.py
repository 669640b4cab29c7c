"""`geartrain mesh`: what the teeth of one pair do, without a train; one file a form."""

from __future__ import annotations

import typer

from geartrain.cli.mesh import conjugate
from geartrain.cli.mesh.conjugate_options import FORMS
from geartrain.cli.verbs import LazyGroup, Verbs


class PairGroup(LazyGroup):
    """What can be asked of one pair, and the forms of its teeth."""

    verbs = Verbs(
        __name__,
        ("triangular", "pin", "compare", *FORMS),
        make=lambda name: conjugate.command(name) if name in FORMS else None,
    )


app = typer.Typer(
    cls=PairGroup, add_completion=False, help="What the teeth of one pair do within a pitch.", no_args_is_help=True
)


@app.callback()
def _group() -> None:
    pass
