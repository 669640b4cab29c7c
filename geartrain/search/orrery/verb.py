"""Command `geartrain teeth orrery moon=29.53 venus=224.7 ...`: search for a train that drives pointers of several
periods.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated

import typer

from geartrain.cli.common import Force, Json, Out, option_error
from geartrain.cli.long_runs import progress
from geartrain.search.teeth_verb import ANY_COUNT, Range, SearchAnswer, Tolerance, read_tolerance

_PLACE = "NAME=PERIOD"
_TOLERANCE = Fraction(1, 10**6)


def run(
    periods: Annotated[
        list[str],
        typer.Argument(
            help="Name of a pointer, and its period in revolutions of the first arbor.", metavar="NAME=PERIOD"
        ),
    ],
    counts: Range = ANY_COUNT,
    tolerance: Tolerance = None,
    effort: Annotated[int, typer.Option("--beam-width", min=1, help="Maximum beam width of the search.")] = 16,
    walk: Annotated[
        int | None,
        typer.Option(
            "--extra-arbors",
            min=0,
            help="Enumerate all arbor trees with at most this number of intermediate arbors, which carry no pointer.",
        ),
    ] = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """Find a train with few wheels that drives pointers of several periods from one arbor.

    Example: `geartrain teeth orrery moon=29.53 venus=224.7`.
    """
    from geartrain.search.orrery.orrery_search import find_orrery
    from geartrain.search.tooth_count_ranges import read_counts

    answer = SearchAnswer.of(json, out, force)
    wanted = _periods(periods)
    most_error = read_tolerance(tolerance)
    with progress("trees") as bar:
        found = find_orrery(
            wanted,
            read_counts(counts),
            _TOLERANCE if most_error is None else most_error,
            effort=effort,
            walk=walk,
            tell=bar.reach,
        )
    answer.give(found, lambda _: found.to_train())


def _periods(texts: list[str]) -> dict[str, Fraction]:
    """Parse texts such as `moon=29.53` to a mapping from name to period [revolutions of the first arbor]."""
    from geartrain.search.target_ratio import read_ratio
    from geartrain.train import period_table

    found: dict[str, Fraction] = {}
    for text in texts:
        name, sign, period = text.partition("=")
        if not sign or not name.strip():
            raise option_error(
                _PLACE, f"'{text}' is not a name with a period", "write NAME=PERIOD, such as moon=29.53058853"
            )
        if name.strip() in found:
            raise option_error(_PLACE, f"two periods are named '{name.strip()}'", "give each name once")
        if (row := period_table().get(period.strip())) is not None and row.kind != "period":
            why = "a period is a time, or a number of revolutions of the first arbor"
            fix = f"write the period as a number, such as {name.strip()}=462/289"
            raise option_error(_PLACE, f"'{period.strip()}' is a {row.kind}, not a period", fix, why)
        wanted = read_ratio(period)
        if wanted.sense:
            why = "the search chooses the sense of every arbor"
            raise option_error(_PLACE, f"'{text}' has a sign", "give the period without a sign", why)
        found[name.strip()] = wanted.value
    return found
