"""`geartrain mesh`: what the teeth of one pair do, without a train; one file a form."""

from __future__ import annotations

import typer

from geartrain.cli.mesh import compare, pin, triangular
from geartrain.cli.mesh import conjugate as shape
from geartrain.cli.mesh.conjugate_options import FORMS

app = typer.Typer(help="What the teeth of one pair do within a pitch.", no_args_is_help=True)
app.command("triangular")(triangular.run)
app.command("pin")(pin.run)
app.command("compare")(compare.run)
for _form in FORMS:
    app.command(_form)(shape.command(_form))


@app.callback()
def _group() -> None:
    pass
