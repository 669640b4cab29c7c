"""`geartrain mesh`: analysis of one pair of wheels without a train.

All tooth forms have the same command, with the fields of their models as options. Triangular teeth have their own.
"""

from __future__ import annotations

from functools import partial

import typer

from geartrain.cli.mesh import any_form
from geartrain.cli.verbs import LazyGroup, Verbs
from geartrain.teeth.any_tooth_form import TOOTH_FORMS

_OWN = {
    "triangular": "geartrain.cli.mesh.triangular",
    "pin": "geartrain.cli.mesh.any_form:pin",
    "compare": "geartrain.cli.mesh.compare",
}
_FORMS = [name for name in TOOTH_FORMS if name not in (*_OWN, "ideal")]


class PairGroup(LazyGroup):
    """The commands for one pair of wheels, one for each tooth form."""

    verbs = Verbs(_OWN, {name: partial(any_form.command, name) for name in _FORMS})


app = typer.Typer(
    cls=PairGroup,
    add_completion=False,
    help="Analyse one pair of wheels over a pitch, without a train.",
    no_args_is_help=True,
)


@app.callback()
def _group() -> None:
    pass
