"""`geartrain teeth`: tooth numbers for a ratio, for the free wheels of a train, for an epicyclic set, for an orrery."""

from __future__ import annotations

import shlex
from difflib import get_close_matches
from typing import Any

import typer

from geartrain.cli.verbs import LazyGroup, Verbs


class SearchGroup(LazyGroup):
    """What tooth numbers can be searched for."""

    verbs = Verbs(
        {
            "ratio": "geartrain.search.ratio.verb",
            "approximants": "geartrain.search.approximants_verb",
            "train": "geartrain.search.train.verb",
            "set": "geartrain.search.epicyclic.verb",
            "orrery": "geartrain.search.orrery.verb",
        }
    )

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """The search that was asked for; for a question without its word, as it was asked once, the word is told."""
        if args[0] not in self.verbs and not ctx.resilient_parsing and not get_close_matches(args[0], self.verbs):
            word, rest = _word(args)
            asked = shlex.join(["geartrain", "teeth", word, *rest])
            ctx.fail(f"say what is searched for, one of {', '.join(self.verbs)}: `{asked}`")
        return super().resolve_command(ctx, args)


def _word(args: list[str]) -> tuple[str, list[str]]:
    """The search that a question without its word is meant for, and the question as that search takes it."""
    from geartrain.train.declaration_files import shipped

    if "--kind" in args:
        return "set", args
    if "--approximants" in args:
        return "approximants", [arg for arg in args if arg != "--approximants"]
    if "=" in args[0]:
        return "orrery", args
    is_train = args[0].endswith((".yaml", ".yml")) or args[0] in shipped()
    return "train" if is_train else "ratio", args


app = typer.Typer(
    cls=SearchGroup,
    add_completion=False,
    no_args_is_help=True,
    context_settings={"ignore_unknown_options": True},  # what was asked without its word may begin with an option
    help="Tooth numbers for a wanted motion: complete, exact, and with a reason where there are none.",
)


@app.callback()
def _group() -> None:
    pass
