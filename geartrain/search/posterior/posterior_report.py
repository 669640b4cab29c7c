"""Report on uncertain tooth counts as documents and tables: best combinations, posteriors, and Sobol indices."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from geartrain.numerics.exact import as_float
from geartrain.report.document import Document, Section, Table, cut, figure
from geartrain.search.tooth_numbers_report import error_text

if TYPE_CHECKING:
    from geartrain.search.posterior.posterior_result import (
        ToothCountPosterior,
        VarianceShares,
        WheelPosterior,
    )

_MOST_PROBABLE = 4  # most probable counts that are printed; the JSON has all
_STRONGEST = 12  # correlations that are printed
_DECIDING = 4  # wheels that are printed for each output
_OUTPUTS = 4  # with more outputs only the maximum error of a combination is printed
_DECIDED = ("output", "mean speed", "standard deviation", "total Sobol indices")


def posterior_rows(found: ToothCountPosterior) -> list[dict[str, Any]]:
    """Return the listed combinations as rows of a table with tooth counts, speed and error of every output, and
    misfit.
    """
    return [
        {
            **one.teeth,
            **{f"speed of {name}": as_float(speed) for name, speed in one.speeds.items()},
            **{f"error of {name}": float(value) for name, value in one.errors.items()},
            "misfit": float(one.misfit),
            "probability": None if one.probability is None else float(one.probability),
        }
        for one in found.best
    ]


def describe_posterior(found: ToothCountPosterior) -> Document:
    """Return a document on uncertain tooth counts, with the evidence, the posterior of each wheel, and the Sobol
    indices of the outputs.
    """
    return Document(f"Uncertain tooth counts of {found.name}", list(_summary(found)), list(_sections(found)))


def _summary(found: ToothCountPosterior) -> Iterator[str]:
    how = {
        "exact": f"exact join in {_many(found.examined)} steps; only values with an interval are estimated",
        "sample": f"{_many(found.examined)} drawn with seed {found.seed}; intervals are 95 % intervals",
    }[found.method]
    yield f"{_many(found.combinations)} combinations of {len(found.posteriors)} wheels; {how}."
    if found.cut:
        yield "Interrupted: the values cover only the combinations drawn so far."
    if found.turning.value != 1:
        yield f"The prior probability that the train turns is {found.turning}."
    share = f"prior probability {found.evidence}"
    if not found.posteriors or not found.evidence.value:
        minimum = f" (less than {found.evidence.high:.3g})" if found.evidence.high is not None else ""
        yield f"None of them fits the observations{minimum}."
    elif found.soft:
        yield f"Mean likelihood: {found.evidence}."
    else:
        number = "1 fits" if found.fits == 1 else "Some fit" if found.fits is None else f"{_many(found.fits)} fit"
        yield f"{number} the observations: {share}."
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
    rows = [
        (one.name, "; ".join(each.label for each in one.demands), str(found.alone.get(one.name, "-")))
        for one in found.witnesses
    ]
    line = "Evidence of each output by itself: the prior mean of its likelihood."
    return Section("Observations", [line], [Table(("output", "observed", "evidence"), rows)])


def _wheels(found: ToothCountPosterior) -> Section:
    rows = [_wheel(posterior) for posterior in found.posteriors.values()]
    lines = [
        "`posterior` is the probability of the declared count. `bits` is the information from the outputs: the "
        "relative entropy of posterior and prior.",
        "A dash marks a wheel on which no observed output depends. Priors are uniform unless marked as weighted.",
    ]
    header = ("wheel", "declared", "prior", "posterior", "bits", "most probable counts")
    return Section("Wheels", lines, [Table(header, rows)])


def _wheel(posterior: WheelPosterior) -> tuple[str, ...]:
    uncertainty = posterior.uncertainty
    before = f"{_span(uncertainty.counts)}, {uncertainty.assumed}"
    declared = "-" if uncertainty.declared is None else str(uncertainty.declared)
    if posterior.idle or not posterior.probabilities:
        return uncertainty.wheel, declared, before, "-", "-", "-"
    own = "-" if uncertainty.declared is None else str(posterior.probability(uncertainty.declared))
    pairs = zip(uncertainty.counts, posterior.probabilities, strict=True)
    possible = sorted((pair for pair in pairs if pair[1].value), key=lambda pair: (-float(pair[1]), pair[0]))
    listed = ", ".join(f"{count}: {figure(float(share), 3)}" for count, share in possible[:_MOST_PROBABLE])
    if len(possible) > _MOST_PROBABLE:
        listed += f" and {len(possible) - _MOST_PROBABLE} more"
    return uncertainty.wheel, declared, before, own, figure(posterior.bits, 3), listed


def _span(counts: Sequence[int]) -> str:
    whole = counts[-1] - counts[0] + 1 == len(counts)
    return f"{counts[0]}-{counts[-1]}" if whole and len(counts) > 1 else " or ".join(map(str, counts))


def _deciding(shares: Sequence[VarianceShares]) -> Section:
    rows = []
    for one in shares:
        strongest = sorted(one.whole, key=lambda wheel: -float(one.whole[wheel]))[:_DECIDING]
        listed = ", ".join(
            f"{wheel} {figure(float(one.whole[wheel]) * 100, 3)} %" for wheel in strongest if one.whole[wheel]
        )
        rows.append((one.output, figure(one.mean), figure(one.spread, 4), listed))
    line = "Shares of the prior variance of each speed that remain if all other counts are known (total Sobol indices)."
    return Section("Sensitivity of outputs to tooth counts", [line], [Table(_DECIDED, cut(rows))])


def _correlated(found: ToothCountPosterior) -> Section:
    strongest = list(found.correlations.items())[:_STRONGEST]
    # smaller values would be printed as 0
    rows = [(" and ".join(pair), f"{value:+.3f}") for pair, value in strongest if abs(value) >= 0.0005]
    line = "Strongest posterior correlations of counts: such wheels compensate for each other."
    return Section("Correlations", [line], [Table(("wheels", "correlation"), rows)])


def _best(found: ToothCountPosterior) -> Section:
    lines = [
        "Sorted by misfit, the sum of (error / tolerance)^2, then by prior probability and number of changed counts."
    ]
    if not found.ranked:
        why = "only a sample is ranked" if found.method == "sample" or found.cut else "more have the same misfit"
        lines.append(f"Not proved to be the best: {why}.")
    outputs = list(found.best[0].errors)
    listed = outputs if len(outputs) <= _OUTPUTS else []
    header = ["changed", "misfit", "posterior", *([f"error of {name}" for name in listed] or ["maximum error"])]
    rows = []
    for one in found.best:
        changed = ", ".join(f"{wheel} {one.teeth[wheel]}" for wheel in one.changed) or "nothing"
        errors = [error_text(one.errors[name]) for name in listed]
        if not listed:
            worst = max(one.errors, key=lambda name: abs(one.errors[name]))
            errors = [f"{worst} {error_text(one.errors[worst])}"]
        rows.append([changed, figure(one.misfit, 4), "-" if one.probability is None else str(one.probability), *errors])
    return Section("Best combinations", lines, [Table(header, cut(rows))])
