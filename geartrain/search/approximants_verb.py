"""Command `geartrain teeth approximants RATIO`: list fractions that approximate a ratio."""

from __future__ import annotations

import typer

from geartrain.cli.common import Force, Json, Out
from geartrain.search.teeth_verb import (
    ANY_COUNT,
    NEGATIVE_NUMBERS,
    Per,
    Pinions,
    Range,
    Ratio,
    SearchAnswer,
    Wheels,
    check_number,
)

context_settings = NEGATIVE_NUMBERS


def run(
    context: typer.Context,
    ratio: Ratio,
    counts: Range = ANY_COUNT,
    wheels: Wheels = None,
    pinions: Pinions = None,
    per: Per = None,
    json: Json = False,
    out: Out = None,
    force: Force = False,
) -> None:
    """List fractions that approximate a ratio: the convergents of its continued fraction and intermediate fractions.

    Example: `geartrain teeth approximants 13.368267`.
    """
    from geartrain.search.stern_brocot import Approximants, approximants
    from geartrain.search.target_ratio import read_ratio
    from geartrain.search.tooth_count_ranges import read_counts

    answer = SearchAnswer.of(json, out, force)
    wanted = read_ratio(check_number(context, ratio), per)
    most = max(read_counts(text or counts).most for text in (wheels, pinions))
    found = Approximants(wanted, most, tuple(approximants(wanted.value, most)))
    answer.give(found)
