"""`geartrain mesh`: what the teeth of one pair do, without a train; one file a form."""

from __future__ import annotations

from collections.abc import Callable

import typer

from geartrain.cli.mesh import any_form, conjugate
from geartrain.cli.mesh.conjugate_options import CONJUGATE, form_names
from geartrain.cli.verbs import LazyGroup, Verbs


def _of_form(name: str) -> Callable[..., None] | None:
    """The command of a tooth form; None for commands that are modules."""
    if name in CONJUGATE:
        return conjugate.command(name)
    return any_form.command(name) if name in form_names() else None


class PairGroup(LazyGroup):
    """What can be asked of one pair, and the forms of its teeth."""

    verbs = Verbs(
        __name__,
        ("triangular", "pin", "compare", *form_names()),
        make=_of_form,
    )


app = typer.Typer(
    cls=PairGroup, add_completion=False, help="What the teeth of one pair do within a pitch.", no_args_is_help=True
)


@app.callback()
def _group() -> None:
    pass
