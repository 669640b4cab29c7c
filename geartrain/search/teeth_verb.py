"""Command `geartrain teeth`: search for the tooth counts of gear stages with a given ratio, of a train, of an epicyclic
set or of an orrery.

Each search is a command in a separate module, which is listed in `SearchGroup`. This module contains the options and
output formats common to the searches.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from pathlib import Path
from typing import Annotated, Any

import typer

from geartrain.cli.common import (
    GOOD,
    INTERRUPTED,
    STANDARD,
    VERDICT,
    Sink,
    as_json,
    emit,
    option_error,
    show,
    sink,
    table_text,
)
from geartrain.cli.option_values import read_share
from geartrain.cli.verbs import LazyGroup, Verbs
from geartrain.numerics.results import imported_function


class SearchGroup(LazyGroup):
    """Command group `geartrain teeth`, with one command for each kind of search."""

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
        """Return the name of the search command, its function, and the remaining arguments. If the name of the search
        is missing, `QuestionError` is raised with a suggestion.
        """
        if args[0] not in self.verbs and not ctx.resilient_parsing and not get_close_matches(args[0], self.verbs):
            word, rest = _word(args)
            requested = shlex.join(["geartrain", "teeth", word, *rest])
            what, why = "the kind of search is missing", f"the kinds are {', '.join(self.verbs)}"
            raise option_error(args[0], what, f"did you mean `{requested}`?", why)
        return super().resolve_command(ctx, args)


def _word(args: list[str]) -> tuple[str, list[str]]:
    """Return the name of the search that was probably intended, if the command line lacks it, and the arguments of this
    search. `args` are the arguments after `geartrain teeth`.
    """
    from geartrain.train.declaration_files import shipped

    if args[0] == "epicyclic":
        return "set", args[1:]
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
    context_settings={"ignore_unknown_options": True},  # arguments without a command name may begin with an option
    help="Find tooth counts for a ratio, a train, an epicyclic set or an orrery.\n\n"
    "Example: `geartrain teeth ratio 235/19`.",
)


@app.callback()
def _group() -> None:
    pass


# -------------------------------------------- options of several searches, each written once, and how a search answers


Ratio = Annotated[
    str,
    typer.Argument(
        help="Requested ratio: 13.368, 235/19, 'A / B' for two periods A and B, or the name of a period.",
        metavar="RATIO",
    ),
]
Range = Annotated[
    str,
    typer.Option(
        "--range", help="Admissible tooth counts: a range (15:120), a list (30,36,48), or a set (lego, meccano)."
    ),
]
Wheels = Annotated[
    str | None,
    typer.Option("--wheels", help="Admissible tooth counts of the larger wheel of each pair; default: --range."),
]
Pinions = Annotated[
    str | None,
    typer.Option("--pinions", help="Admissible tooth counts of the smaller wheel of each pair; default: --range."),
]
Per = Annotated[
    str | None,
    typer.Option("--per", help="Second period, if RATIO is a single period; the requested ratio is then PER / RATIO."),
]
Tolerance = Annotated[
    str | None, typer.Option("--tolerance", help="Maximum relative error, such as 1e-6, 20 ppm or 0.001 %.")
]
Clearance = Annotated[
    str | None,
    typer.Option("--clearance", help="Minimum clearance between the tips of neighbouring planets, in modules."),
]
Shift = Annotated[
    int,
    typer.Option(
        "--centre-tolerance",
        min=0,
        help="Maximum difference between the centre distances of coaxial pairs, in half modules.",
    ),
]
Hunting = Annotated[bool, typer.Option("--hunting", help="Require coprime tooth counts in every pair.")]
Different = Annotated[bool, typer.Option("--different", help="Require distinct tooth counts.")]
Best = Annotated[int, typer.Option("--best", min=1, max=100_000, help="Number of solutions to list.")]
Pick = Annotated[
    int, typer.Option("--pick", min=1, help="With -o x.yaml: number of the listed solution to write as a declaration.")
]

ANY_COUNT = "12:120"
NEGATIVE_NUMBERS = {"ignore_unknown_options": True}
"""Settings of a command that takes a number as argument, so that a negative number is not parsed as an option."""
_YAML = (".yaml", ".yml")
_FORMS = (".md", ".html", ".json", ".csv", *_YAML)
_WIDEST = 10**12


def check_number(ctx: typer.Context, text: str) -> str:
    """Return an argument unchanged. `QuestionError` is raised if it begins with a minus sign but is not a number."""
    if text.startswith("-") and not text[1:2].isdigit() and text[1:2] != ".":
        raise option_error(text, "unknown option", f"`{ctx.command_path} --help` lists the options")
    return text


def read_tolerance(text: str | None) -> Fraction | None:
    """Parse the value of `--tolerance` and return it as a maximum relative error; None if the option is not given."""
    if text is None:
        return None
    found = read_share(text, "--tolerance")
    if not 0 <= found <= _WIDEST:
        raise option_error("--tolerance", f"{text} is out of range", f"give a relative error from 0 to {_WIDEST:.0e}")
    return found


@dataclass(frozen=True)
class SearchAnswer:
    """Destination and output format of the solutions of a search."""

    json: bool
    """True to print the solutions as JSON."""
    out: Sink
    pick: int = 1
    """Number of the listed solution that is written as a declaration, starting with 1."""

    @classmethod
    def of(cls, json: bool, out: Path | None, force: bool, pick: int = 1) -> SearchAnswer:
        """Return the answer object for the command-line options `--json`, `-o`, `--force` and `--pick`. `QuestionError`
        is raised before the search if the output file cannot be written.
        """
        return cls(json, sink(out, force, _FORMS), pick)

    def give(self, found: Any, declared: Callable[[int], Mapping[str, Any]] | None = None) -> None:
        """Print or write the solutions and exit. The exit code is 0 if there are solutions, 1 if there are none, and
        130 after an interruption.

        found      result of a search; its class names the functions that build its table and its document
        declared   function that returns the declaration of the solution with a given index
        """
        table, describe = (imported_function(*name.split(":")) for name in (found.ROWS, found.PAGE))
        rows = table(found)
        suffix = self.out.suffix
        if suffix in _YAML:
            self._declare(declared, len(rows))
        form = suffix or (".json" if self.json else ".md")
        requested = {form} if self.out != STANDARD and form not in _YAML else set[str]()
        requested |= {".json"} if self.json else set()
        for each in sorted(requested or {""}):
            out = self.out if each == form else STANDARD
            if each == ".json":
                emit(as_json(found), out)
            elif each == ".csv":
                emit(table_text(rows), out)
            else:
                show([describe(found)], out, each)
        if getattr(found, "ended", "") == "interrupted":
            raise typer.Exit(INTERRUPTED)
        raise typer.Exit(GOOD if rows else VERDICT)

    def _declare(self, declared: Callable[[int], Mapping[str, Any]] | None, found: int) -> None:
        from geartrain.train.yaml_nodes import as_yaml

        if declared is None:
            what = "the solutions of this search cannot be written as a declaration"
            raise option_error("-o", what, "use .md, .html, .json or .csv")
        if self.pick <= found:
            emit(as_yaml(declared(self.pick - 1)), self.out)
        elif found:
            raise option_error("--pick", f"the list has {found} solutions", f"give a number from 1 to {found}")
