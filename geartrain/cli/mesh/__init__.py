"""`geartrain mesh`: what the teeth of one pair do, without a train.

Any tooth form has the same command, with the fields of its model as options; triangular teeth have one of their own.
"""

from __future__ import annotations

from collections.abc import Callable

import typer

from geartrain.cli.mesh import any_form
from geartrain.cli.verbs import LazyGroup, Verbs
from geartrain.teeth.any_tooth_form import tooth_forms

_OWN = ("triangular", "pin", "compare")
_FORMS = {name: model for name, model in tooth_forms().items() if name not in (*_OWN, "ideal")}


def _of_form(name: str) -> Callable[..., None] | None:
    """The command of a tooth form; None for commands that are modules."""
    return any_form.command(name, _FORMS[name]) if name in _FORMS else None


class PairGroup(LazyGroup):
    """What can be asked of one pair, and the forms of its teeth."""

    verbs = Verbs(__name__, (*_OWN, *_FORMS), make=_of_form)


app = typer.Typer(
    cls=PairGroup, add_completion=False, help="What the teeth of one pair do within a pitch.", no_args_is_help=True
)


@app.callback()
def _group() -> None:
    pass
