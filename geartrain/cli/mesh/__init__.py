"""`geartrain mesh`: what the teeth of one pair do, without a train; one file a form."""

from __future__ import annotations

import typer

from geartrain.cli.mesh import pin, triangular

app = typer.Typer(help="What the teeth of one pair do within a pitch.", no_args_is_help=True)
app.command("triangular")(triangular.run)
app.command("pin")(pin.run)


@app.callback()
def _group() -> None:
    pass
