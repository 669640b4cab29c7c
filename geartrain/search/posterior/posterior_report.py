"""Counts in doubt as pages and tables: what fits, how likely each count is then, and which wheel decides what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from geartrain.numerics.exact import as_float
from geartrain.numerics.long_float import rounded
from geartrain.report.document import Document, Section, Table, cut, figure
from geartrain.search.tooth_numbers_report import error_text

if TYPE_CHECKING:
    from geartrain.search.posterior.posterior_result import (
        CountCombination,
        CountProbability,
        ToothCountPosterior,
        VarianceShares,
        WheelPosterior,
    )

_LIKELIEST = 4  # counts told of one wheel; the JSON has all
_STRONGEST = 12
_DECIDING = 4
_OUTPUTS = 4
_DECIDED = ("output", "mean speed", "standard deviation", "decided by")


def posterior_rows(found: ToothCountPosterior) -> list[dict[str, Any]]:
    """The combinations listed, as a flat table: counts, then the speed and the error of every output."""
    return [
        {
            **one.teeth,
            **{f"speed of {name}": as_float(speed) for name, speed in one.speeds.items()},
            **{f"error of {name}": float(value) for name, value in one.errors.items()},
            "misfit": float(one.misfit),
            "chance": None if one.chance is None else float(one.chance),
        }
        for one in found.best
    ]


def describe_posterior(found: ToothCountPosterior) -> Document:
    """What is known of counts in doubt: evidence, the posterior of each count, and what decides the outputs.

    Parameters
    ----------
    found : ToothCountPosterior
        From `geartrain.search.infer_counts`.

    Returns
    -------
    Document
        Assumptions first; probabilities with their intervals of 95 % where they are estimates.

    Examples
    --------
    Of five counts of a sun one gives the declared speeds:

    >>> from geartrain.train.declaration_files import read_declaration
    >>> from geartrain.search import infer_counts
    >>> found = infer_counts(read_declaration("planetary-24-18-60"), free={"s": (22, 23, 24, 25, 26)})
    >>> describe_posterior(found).summary[1]
    '1 fit: a share of 0.2 of the weight they have before.'
    """
    return Document(f"Counts in doubt of {found.name}", list(_summary(found)), list(_sections(found)))


def _summary(found: ToothCountPosterior) -> Iterator[str]:
    how = {
        "exact": f"all were taken together, in {_many(found.examined)} steps; only what has an interval is estimated",
        "sample": f"{_many(found.examined)} were drawn, seed {found.seed}; intervals are of 95 %",
    }[found.method]
    yield f"{_many(found.combinations)} combinations of {len(found.posteriors)} wheels; {how}."
    if found.cut:
        yield "Interrupted: the figures are of what had been looked at."
    if found.turning.value != 1:
        yield f"The train turns with a share of {found.turning} of them, by their weight."
    share = f"a share of {found.evidence} of the weight they have before"
    if not found.posteriors or not found.evidence.value:
        minimum = f" (less than {found.evidence.high:.3g})" if found.evidence.high is not None else ""
        yield f"None of them fits what the outputs are known to do{minimum}."
    elif found.soft:
        yield f"Mean agreement: {found.evidence}."
    else:
        yield f"{'Those that fit' if found.fits is None else f'{_many(found.fits)} fit'}: {share}."
    yield from found.assumed


def _many(count: int) -> str:
    return str(count) if count < 10**9 else figure(Fraction(count), 4)


def _sections(found: ToothCountPosterior) -> Iterator[Section]:
    if found.remarks:
        yield Section("Remarks", [f"{remark[0].upper()}{remark[1:]}." for remark in found.remarks])
    yield _known(found)
    yield _wheels(found)
    if found.shares:
        yield _deciding(list(found.shares.values()))
    if found.correlations:
        yield _correlated(found)
    if found.best:
        yield _best(found)


def _known(found: ToothCountPosterior) -> Section:
    rows = [(one.name, one.text, str(found.alone.get(one.name, "-"))) for one in found.witnesses]
    line = "How much of the weight each output would leave if it were known alone."
    return Section("What is known", [line], [Table(("output", "known", "fits alone"), rows)])


def _wheels(found: ToothCountPosterior) -> Section:
    rows = [_wheel(posterior) for posterior in found.posteriors.values()]
    lines = [
        "`bits` is what the outputs tell of a wheel: the relative entropy of its chances now and before.",
        "A dash stands for a wheel on which nothing known depends. Before, all its counts are as likely, unless it is "
        "said that they are weighted.",
    ]
    header = ("wheel", "declared", "before", "chance now", "bits", "likeliest now")
    return Section("Wheels", lines, [Table(header, rows)])


def _wheel(posterior: WheelPosterior) -> tuple[str, ...]:
    doubt = posterior.doubt
    before = f"{_span(doubt.counts)}, {doubt.assumed}"
    declared = "-" if doubt.declared is None else str(doubt.declared)
    if posterior.idle or not posterior.chances:
        return doubt.wheel, declared, before, "-", "-", "-"
    own = "-" if doubt.declared is None else str(posterior.chance(doubt.declared))
    return doubt.wheel, declared, before, own, figure(posterior.bits, 3), _likeliest(posterior)


def _span(counts: Sequence[int]) -> str:
    whole = counts[-1] - counts[0] + 1 == len(counts)
    return f"{counts[0]}-{counts[-1]}" if whole and len(counts) > 1 else " or ".join(map(str, counts))


def _likeliest(posterior: WheelPosterior) -> str:
    """The likeliest counts with their chances; those that have none are not told."""
    pairs = zip(posterior.doubt.counts, posterior.chances, strict=True)
    some = sorted((pair for pair in pairs if pair[1].value), key=lambda pair: (-float(pair[1]), pair[0]))
    told = ", ".join(f"{count}: {_short(chance)}" for count, chance in some[:_LIKELIEST])
    return told + (f" and {len(some) - _LIKELIEST} more" if len(some) > _LIKELIEST else "")


def _short(chance: CountProbability) -> str:
    return figure(float(chance), 3)


def _deciding(shares: Sequence[VarianceShares]) -> Section:
    rows = []
    for one in shares:
        strongest = sorted(one.whole, key=lambda wheel: -float(one.whole[wheel]))[:_DECIDING]
        told = ", ".join(f"{wheel} {_percent(one.whole[wheel])}" for wheel in strongest if one.whole[wheel])
        told = told if one.exact else f"about {told}"
        mean = rounded(one.mean) if isinstance(one.mean, Fraction) else one.mean
        rows.append((one.output, figure(mean), figure(one.spread, 4), told))
    line = (
        "Shares of the variance of each speed that stay if all other counts are known, over the counts as they are "
        "before anything is known of the outputs."
    )
    return Section("Which wheel decides which output", [line], [Table(_DECIDED, cut(rows))])


def _percent(share: Fraction | float) -> str:
    return f"{figure(float(share) * 100, 3)} %"


def _correlated(found: ToothCountPosterior) -> Section:
    strongest = list(found.correlations.items())[:_STRONGEST]
    rows = [(" and ".join(pair), f"{value:+.3f}") for pair, value in strongest if abs(value) >= 0.0005]  # shown as 0
    line = "Wheels that make up for each other in what fits: the strongest correlations of their counts."
    return Section("Correlations", [line], [Table(("wheels", "correlation"), rows)])


def _best(found: ToothCountPosterior) -> Section:
    lines = [
        "Ordered by misfit, the sum of (error / tolerance)^2; of equals the likelier before, then the nearer to what "
        "is declared.",
    ]
    if not found.ranked:
        why = "of those looked at" if found.method == "sample" or found.cut else "more have the same misfit"
        lines.append(f"Not shown to be the best: {why}.")
    some = found.best[0]
    header = ["changed", "misfit", "chance"]
    told = list(some.errors) if len(some.errors) <= _OUTPUTS else []
    header += [f"error of {name}" for name in told] or ["greatest error"]
    rows = [[*_told(one), *_errors(one, told)] for one in found.best]
    return Section("Combinations that agree best", lines, [Table(header, cut(rows))])


def _told(one: CountCombination) -> tuple[str, str, str]:
    changed = ", ".join(f"{wheel} {one.teeth[wheel]}" for wheel in one.changed) or "nothing"
    return changed, figure(one.misfit, 4), "-" if one.chance is None else str(one.chance)


def _errors(one: CountCombination, told: Sequence[str]) -> list[str]:
    if told:
        return [error_text(one.errors[name]) for name in told]
    worst = max(one.errors, key=lambda name: abs(one.errors[name]))
    return [f"{worst} {error_text(one.errors[worst])}"]
